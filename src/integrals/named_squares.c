#include "integrals/named_squares.h"

#include <math.h>
#include <string.h>

#include "exact/normal.h"
#include "exact/solve.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/print.h"
#include "integrals/named_match.h"

enum {
    most = 32,
    longest = 3000, /* largest complexity of a rate */
    longest_entry = 300,
    longest_shown = 250,
    three = 3
};

typedef struct {
    nh_ex product;          /* a product of states */
    nh_ex P[most], Q[most]; /* sum_i P_i g_i' + Q_i g_i = 0 */
    bool used;
    size_t pivot;
} row;

typedef struct {
    const nh_model *o;
    nh_dag *d;
    nh_ex s, zero;
    size_t words;
    const nh_ex *word;
    size_t rows, capacity;
    row *row;
    bool live[most];     /* is the unknown still to be found? */
    nh_ex T[most][most]; /* f_i = sum_j T_ij g_j */
    bool good;
    nh_arena *arena;
    size_t count;
    nh_ex *out;
} seeker;

static nh_ex simple(seeker *x, nh_ex e)
{
    if (nh_kind_of(x->d, e) != NH_NUMBER) e = nh_simplify_short(x->d, e, 0);
    if (nh_complexity(x->d, e) > longest_entry) x->good = false;
    return e;
}

static bool none(const seeker *x, nh_ex e) { return nh_is_zero(x->d, e); }

/* ---- the linear system ---- */

static bool depends_on_states(const seeker *x, nh_ex e)
{
    for (size_t j = 0; j < x->o->width; j++)
        if (x->o->chart->symbol[j] != x->s && nh_depends(x->d, e, x->o->chart->symbol[j])) return true;
    return false;
}

static row *row_of(seeker *x, nh_ex product)
{
    for (size_t r = 0; r < x->rows; r++)
        if (x->row[r].product == product) return &x->row[r];
    nh_grow(&x->row, &x->capacity, x->rows + 1, sizeof *x->row);
    row *out = &x->row[x->rows++];
    *out = (row){.product = product};
    for (size_t j = 0; j < most; j++) out->P[j] = out->Q[j] = x->zero;
    return out;
}

/* Splits c times e into a product of states and a function of s. */
static void add_term(seeker *x, size_t i, bool rate, nh_num c, nh_ex e)
{
    nh_dag *d = x->d;
    nh_ex in_s = nh_number(d, c), product = nh_int(d, 1);
    bool many = nh_kind_of(d, e) == NH_PRODUCT;
    if (many) in_s = nh_mul(d, in_s, nh_number(d, nh_constant_of(d, e)));
    for (size_t k = 0; k < (many ? nh_arity(d, e) : 1); k++) {
        nh_ex factor = many ? nh_pow(d, nh_child(d, e, k), nh_exponent_of(d, e, k)) : e;
        if (depends_on_states(x, factor)) product = nh_mul(d, product, factor);
        else in_s = nh_mul(d, in_s, factor);
    }
    row *r = row_of(x, product);
    nh_ex *to = rate ? &r->P[i] : &r->Q[i];
    *to = nh_add(d, *to, in_s);
}

static void add_terms(seeker *x, size_t i, bool rate, nh_ex e)
{
    nh_dag *d = x->d;
    if (nh_complexity(d, e) > longest) x->good = false;
    if (!x->good) return;
    nh_num c = nh_num_int(1);
    e = nh_canonical_sum(d, e);
    if (nh_kind_of(d, e) == NH_PRODUCT && nh_arity(d, e) == 1 && nh_is_number(d, nh_exponent_of(d, e, 0), 1)) {
        c = nh_constant_of(d, e);
        e = nh_child(d, e, 0);
    }
    if (nh_kind_of(d, e) != NH_SUM) {
        add_term(x, i, rate, c, e);
        return;
    }
    add_term(x, i, rate, nh_num_mul(c, nh_constant_of(d, e)), nh_int(d, 1));
    for (size_t k = 0; k < nh_arity(d, e); k++)
        add_term(x, i, rate, nh_num_mul(c, nh_coefficient_of(d, e, k)), nh_child(d, e, k));
}

static void fill(seeker *x)
{
    nh_ex pace = nh_model_gamma(x->o, x->s);
    for (size_t i = 0; i < x->words && x->good; i++) {
        add_terms(x, i, true, nh_mul(x->d, pace, x->word[i]));
        add_terms(x, i, false, nh_model_gamma(x->o, x->word[i]));
    }
    for (size_t r = 0; r < x->rows; r++)
        for (size_t j = 0; j < x->words && x->good; j++) {
            x->row[r].P[j] = simple(x, x->row[r].P[j]);
            x->row[r].Q[j] = simple(x, x->row[r].Q[j]);
        }
    for (size_t i = 0; i < x->words; i++) {
        x->live[i] = true;
        for (size_t j = 0; j < x->words; j++) x->T[i][j] = i == j ? nh_int(x->d, 1) : x->zero;
    }
}

/* ---- elimination ---- */

static size_t entries(const seeker *x, const nh_ex *e)
{
    size_t n = 0;
    for (size_t j = 0; j < x->words; j++) n += !none(x, e[j]);
    return n;
}

/* The shortest entry as a divisor; one that depends on s only if all do. */
static size_t pivot_in(const seeker *x, const nh_ex *e)
{
    size_t best = most, cost = 0;
    for (size_t j = 0; j < x->words; j++) {
        if (none(x, e[j])) continue;
        size_t here = nh_complexity(x->d, e[j]) + (nh_depends(x->d, e[j], x->s) ? longest_entry : 0);
        if (best == most || here < cost) best = j, cost = here;
    }
    return best;
}

static void add_multiple(seeker *x, nh_ex *to, nh_ex c, nh_ex e)
{
    if (none(x, c) || none(x, e)) return;
    *to = simple(x, nh_add(x->d, *to, nh_mul(x->d, c, e)));
}

/* g_p = sum_j c_j g_j, c_p = 0 */
static void substitute(seeker *x, size_t p, const nh_ex *c)
{
    for (size_t j = 0; j < x->words && x->good; j++) {
        if (none(x, c[j])) continue;
        nh_ex slope = simple(x, nh_diff(x->d, c[j], x->s));
        for (size_t r = 0; r < x->rows && x->good; r++) {
            row *at = &x->row[r];
            add_multiple(x, &at->P[j], at->P[p], c[j]);
            add_multiple(x, &at->Q[j], at->P[p], slope);
            add_multiple(x, &at->Q[j], at->Q[p], c[j]);
        }
        for (size_t i = 0; i < x->words && x->good; i++) add_multiple(x, &x->T[i][j], x->T[i][p], c[j]);
    }
    for (size_t r = 0; r < x->rows; r++) {
        x->row[r].P[p] = x->row[r].Q[p] = x->zero;
        x->row[r].used = false;
    }
    for (size_t i = 0; i < x->words; i++) x->T[i][p] = x->zero;
    x->live[p] = false;
}

/* An equation without derivatives: false where there is none. */
static bool use_algebraic(seeker *x)
{
    row *best = NULL;
    for (size_t r = 0; r < x->rows; r++) {
        row *at = &x->row[r];
        if (entries(x, at->P) || !entries(x, at->Q)) continue;
        if (!best || entries(x, at->Q) < entries(x, best->Q)) best = at;
    }
    if (!best) return false;
    size_t p = pivot_in(x, best->Q);
    nh_ex c[most], by = best->Q[p];
    for (size_t j = 0; j < x->words; j++)
        c[j] = j == p || none(x, best->Q[j]) ? x->zero : simple(x, nh_neg(x->d, nh_div(x->d, best->Q[j], by)));
    if (x->good) substitute(x, p, c);
    return true;
}

/* One more derivative g_p' in its own row alone: false where there is none. */
static bool use_derivative(seeker *x)
{
    row *best = NULL;
    for (size_t r = 0; r < x->rows; r++) {
        row *at = &x->row[r];
        if (at->used || !entries(x, at->P)) continue;
        if (!best || entries(x, at->P) < entries(x, best->P)) best = at;
    }
    if (!best) return false;
    size_t p = best->pivot = pivot_in(x, best->P);
    nh_ex by = best->P[p];
    best->used = true;
    for (size_t j = 0; j < x->words; j++) {
        if (!none(x, best->P[j])) best->P[j] = simple(x, nh_div(x->d, best->P[j], by));
        if (!none(x, best->Q[j])) best->Q[j] = simple(x, nh_div(x->d, best->Q[j], by));
    }
    for (size_t r = 0; r < x->rows && x->good; r++) {
        row *at = &x->row[r];
        if (at == best || none(x, at->P[p])) continue;
        nh_ex c = nh_neg(x->d, at->P[p]);
        for (size_t j = 0; j < x->words; j++) {
            add_multiple(x, &at->P[j], c, best->P[j]);
            add_multiple(x, &at->Q[j], c, best->Q[j]);
        }
    }
    return true;
}

/* Words that depend on each other leave an unknown without an equation: it is set to 0. */
static bool drop_free(seeker *x)
{
    bool found[most] = {false};
    nh_ex c[most];
    for (size_t r = 0; r < x->rows; r++)
        if (x->row[r].used) found[x->row[r].pivot] = true;
    for (size_t j = 0; j < x->words; j++) c[j] = x->zero;
    for (size_t p = 0; p < x->words; p++)
        if (x->live[p] && !found[p]) {
            substitute(x, p, c);
            return true;
        }
    return false;
}

static void eliminate(seeker *x)
{
    do {
        while (x->good && use_algebraic(x)) {
        }
        while (x->good && use_derivative(x)) {
        }
        bool again = false;
        for (size_t r = 0; r < x->rows; r++) again |= !entries(x, x->row[r].P) && entries(x, x->row[r].Q);
        if (again) continue;
        if (!drop_free(x)) return;
    } while (x->good);
}

/* ---- three unknowns ---- */

typedef struct {
    size_t g[three];
    nh_ex A[three][three];     /* g' = A g */
    nh_ex V[three + 1][three]; /* y, y', y'', y''' in g, y being one of these */
    nh_ex det, p, q, r;
    nh_ex lead;  /* what y is multiplied by */
    bool square; /* y = u v, and u and v satisfy */
    nh_named_equation root;
} block;

static const row *row_for(const seeker *x, size_t p)
{
    for (size_t r = 0; r < x->rows; r++)
        if (x->row[r].used && x->row[r].pivot == p) return &x->row[r];
    return NULL;
}

/* The unknowns that are coupled with p; returns their number, and marks them in `seen`. */
static size_t connected(const seeker *x, size_t p, bool *seen, size_t *out)
{
    size_t n = 1;
    out[0] = p;
    seen[p] = true;
    for (size_t k = 0; k < n; k++)
        for (size_t j = 0; j < x->words; j++) {
            if (seen[j] || !x->live[j]) continue;
            if (none(x, row_for(x, out[k])->Q[j]) && none(x, row_for(x, j)->Q[out[k]])) continue;
            seen[j] = true;
            out[n++] = j;
        }
    return n;
}

static nh_ex determinant(seeker *x, const nh_ex *a) { return simple(x, nh_solve_determinant(x->d, three, a)); }

/* The equation of third order for the unknown j. */
static bool equation(seeker *x, size_t j, block *b)
{
    nh_dag *d = x->d;
    for (size_t k = 0; k < three; k++) b->V[0][k] = nh_int(d, k == j);
    for (size_t n = 0; n < three; n++)
        for (size_t k = 0; k < three; k++) {
            nh_ex e = nh_diff(d, b->V[n][k], x->s);
            for (size_t i = 0; i < three; i++) e = nh_add(d, e, nh_mul(d, b->V[n][i], b->A[i][k]));
            b->V[n + 1][k] = simple(x, e);
        }
    b->det = determinant(x, b->V[0]);
    if (!x->good || nh_normal_is_zero(d, b->det, 0) != NH_NONZERO) return false;
    nh_ex *to[three] = {&b->r, &b->q, &b->p};
    for (size_t n = 0; n < three; n++) {
        nh_ex m[three][three];
        memcpy(m, b->V, sizeof m);
        memcpy(m[n], b->V[three], sizeof m[n]);
        *to[n] = simple(x, nh_div(d, determinant(x, m[0]), b->det));
    }
    nh_ex lead = x->zero;
    for (size_t i = 0; i < x->words; i++) lead = nh_add(d, lead, nh_mul(d, x->T[i][b->g[j]], x->word[i]));
    b->lead = nh_simplify_short(d, lead, 0);
    return x->good;
}

/* (32): is it a symmetric square? */
static void find_root(seeker *x, block *b)
{
    nh_dag *d = x->d;
    nh_ex P = simple(x, nh_mul(d, b->p, nh_ratio(d, 1, three)));
    nh_ex twice = nh_mul(d, nh_int(d, 2), nh_powi(d, P, 2));
    nh_ex Q = simple(x, nh_mul(d, nh_ratio(d, 1, 4), nh_add(d, nh_sub(d, b->q, nh_diff(d, P, x->s)), twice)));
    nh_ex r =
        nh_sub(d, nh_mul(d, nh_int(d, 2), nh_diff(d, Q, x->s)), nh_product(d, three, (nh_ex[]){nh_int(d, 4), P, Q}));
    b->root = (nh_named_equation){x->s, P, Q, x->s};
    b->square = x->good && nh_normal_is_zero(d, nh_sub(d, r, b->r), 0) == NH_ZERO;
}

static double value_of(void *context, nh_ex e)
{
    const seeker *x = context;
    return nh_named_typical(x->o, x->s, e);
}

/* The current in which this unknown is y; kept when it is proved. */
static void keep(seeker *x, const block *b, nh_ex y)
{
    nh_dag *d = x->d;
    nh_ex slope = nh_diff(d, y, x->s), Y[three] = {y, slope, nh_diff(d, slope, x->s)}, phi = x->zero;
    for (size_t k = 0; k < three; k++) {
        nh_ex m[three][three];
        for (size_t i = 0; i < three; i++)
            for (size_t j = 0; j < three; j++) m[i][j] = j == k ? Y[i] : b->V[i][j];
        nh_ex g = nh_simplify_short(d, nh_div(d, nh_solve_determinant(d, three, m[0]), b->det), 0);
        if (!isfinite(value_of(x, g))) return;
        for (size_t i = 0; i < x->words; i++)
            phi = nh_add(d, phi, nh_product(d, three, (nh_ex[]){x->T[i][b->g[k]], g, x->word[i]}));
    }
    if (x->count == NH_MOST_NAMED || nh_normal_is_zero(d, nh_model_gamma(x->o, phi), 0) != NH_ZERO) return;
    x->out[x->count++] = phi;
}

static bool match(seeker *x, const block *b)
{
    nh_named_equation changed[NH_MOST_EQUATIONS];
    nh_ex u[2];
    size_t before = x->count;
    if (!b->square) return false;
    size_t n = nh_named_variables(x->d, &b->root, changed);
    for (size_t k = 0; k < n && x->count == before; k++)
        if (nh_named_match(x->d, &changed[k], value_of, x, u) == 2)
            for (size_t i = 0; i < three; i++) keep(x, b, nh_mul(x->d, u[i / 2], u[(i + 1) / 2]));
    return x->count > before;
}

static size_t length_of(const seeker *x, const block *b)
{
    return nh_complexity(x->d, b->p) + nh_complexity(x->d, b->q) + nh_complexity(x->d, b->r) +
           nh_complexity(x->d, b->lead);
}

/* " = (p)*f'' + .." */
static void put_right(const seeker *x, size_t count, const nh_ex *c, const char *const *of, nh_text *out)
{
    const char *between = " = ";
    for (size_t k = 0; k < count; k++) {
        if (none(x, c[k])) continue;
        char *e = nh_print_string(x->d, c[k]);
        nh_text_addf(out, "%s(%s)*%s", between, e, of[k]);
        between = " + ";
        nh_free(e);
    }
}

static const char *text_of(const seeker *x, const block *b)
{
    nh_text text;
    if (length_of(x, b) > longest_shown) return NULL;
    nh_text_init(&text);
    char *lead = nh_print_string(x->d, b->lead);
    nh_text_addf(&text, "f(%s)*(%s) + ..", nh_name_of(x->d, x->s), lead);
    nh_free(lead);
    if (b->square) {
        nh_text_add(&text, ", f = u*v with solutions u and v of u''");
        put_right(x, 2, (nh_ex[]){b->root.p, b->root.q}, (const char *const[]){"u'", "u"}, &text);
    } else {
        nh_text_add(&text, ", f'''");
        put_right(x, three, (nh_ex[]){b->p, b->q, b->r}, (const char *const[]){"f''", "f'", "f"}, &text);
    }
    const char *out = nh_arena_strdup(x->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

/* The equations of the three unknowns, the shortest first. */
static void seek(seeker *x, const size_t *g, const char **open)
{
    block list[three];
    size_t n = 0;
    for (size_t j = 0; j < three; j++) {
        block b = {.g = {g[0], g[1], g[2]}};
        for (size_t i = 0; i < three; i++)
            for (size_t k = 0; k < three; k++) b.A[i][k] = nh_neg(x->d, row_for(x, g[i])->Q[g[k]]);
        x->good = true;
        if (!equation(x, j, &b)) continue;
        find_root(x, &b);
        size_t at = n++;
        for (; at > 0 && length_of(x, &b) < length_of(x, &list[at - 1]); at--) list[at] = list[at - 1];
        list[at] = b;
    }
    x->good = true;
    for (size_t k = 0; k < n; k++)
        if (match(x, &list[k])) return;
    if (n && !*open) *open = text_of(x, &list[0]);
    x->good = true;
}

size_t nh_named_squares(const nh_model *o, nh_ex variable, size_t words, const nh_ex *word, nh_arena *arena,
                        nh_ex out[NH_MOST_NAMED], const char **open)
{
    seeker *x = nh_alloc(sizeof *x);
    bool seen[most] = {false};
    size_t g[most];
    *x = (seeker){.o = o,
                  .d = o->dag,
                  .s = variable,
                  .zero = nh_int(o->dag, 0),
                  .words = words,
                  .word = word,
                  .good = words <= most,
                  .arena = arena,
                  .out = out};
    *open = NULL;
    if (x->good) fill(x);
    if (x->good) eliminate(x);
    for (size_t p = 0; p < words && x->good; p++)
        if (x->live[p] && !seen[p] && connected(x, p, seen, g) == three) seek(x, g, open);
    size_t n = x->count;
    nh_free(x->row);
    nh_free(x);
    return n;
}
