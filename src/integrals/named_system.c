/* named_system: Gamma(Phi) = 0, sorted by products of states, as P f' + Q f = 0; then elimination.
 *
 *     read_rates        rows: one for each product of states; P_i from Gamma(s) b_i, Q_i from Gamma(b_i)
 *     use_algebraic     a row with P = 0 gives one unknown by the others, put into all rows with its derivative
 *     use_derivative    a row becomes the only one with g_p'
 *     drop_free         an unknown without an equation is 0
 *     connected         blocks of what is left: g_i' = - sum_j Q_ij g_j
 *
 * T keeps what each f_i is in the unknowns that are left. */
#include "integrals/named_coefficients.h"

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"
#include "graph/num.h"

enum { most = NH_NAMED_WORDS, longest_rate = 3000 };

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
    size_t longest; /* complexity of an entry */
    size_t words;
    const nh_ex *word;
    size_t rows, capacity;
    row *row;
    bool live[most];     /* is the unknown still to be found? */
    nh_ex T[most][most]; /* f_i = sum_j T_ij g_j */
    bool good;
} linear_system;

static nh_ex shortened(linear_system *x, nh_ex e)
{
    if (nh_kind_of(x->d, e) != NH_NUMBER) e = nh_simplify_short(x->d, e, 0);
    if (nh_complexity(x->d, e) > x->longest) x->good = false;
    return e;
}

static bool is_none(const linear_system *x, nh_ex e) { return nh_is_zero(x->d, e); }

/* ---- the linear system ---- */

static bool depends_on_states(const linear_system *x, nh_ex e)
{
    for (size_t j = 0; j < x->o->width; j++)
        if (x->o->chart->symbol[j] != x->s && nh_depends(x->d, e, x->o->chart->symbol[j])) return true;
    return false;
}

/* The row of this product of states; a new one is zero. */
static row *row_of(linear_system *x, nh_ex product)
{
    for (size_t r = 0; r < x->rows; r++)
        if (x->row[r].product == product) return &x->row[r];
    nh_grow(&x->row, &x->capacity, x->rows + 1, sizeof *x->row);
    row *out = &x->row[x->rows++];
    *out = (row){.product = product};
    for (size_t j = 0; j < most; j++) out->P[j] = out->Q[j] = x->zero;
    return out;
}

/* A product of states and a function of s. */
typedef struct {
    nh_ex product, in_s;
    bool monomial; /* the product is one of powers of symbols */
} split_term;

/* c e as (a product of states) times (a function of s). */
static split_term split(const linear_system *x, nh_num c, nh_ex e)
{
    nh_dag *d = x->d;
    split_term out = {nh_int(d, 1), nh_number(d, c), true};
    bool many = nh_kind_of(d, e) == NH_PRODUCT;
    if (many) out.in_s = nh_mul(d, out.in_s, nh_number(d, nh_constant_of(d, e)));
    for (size_t k = 0; k < (many ? nh_arity(d, e) : 1); k++) {
        nh_ex base = many ? nh_child(d, e, k) : e, exponent = many ? nh_exponent_of(d, e, k) : nh_int(d, 1);
        nh_ex factor = nh_pow(d, base, exponent), *to = depends_on_states(x, factor) ? &out.product : &out.in_s;
        *to = nh_mul(d, *to, factor);
        if (to == &out.in_s) continue;
        nh_num n = nh_kind_of(d, exponent) == NH_NUMBER ? nh_number_of(d, exponent) : nh_num_int(-1);
        out.monomial &= nh_kind_of(d, base) == NH_SYMBOL && nh_num_short(n) && n.q == 1 && n.p > 0;
    }
    return out;
}

/* The coefficient of a monomial in e, a polynomial in the states, by derivatives: nothing is expanded for it. */
static nh_ex coefficient_of(const linear_system *x, nh_ex monomial, nh_ex e)
{
    nh_dag *d = x->d;
    size_t width = x->o->width;
    nh_ex *zero = nh_alloc_array(width + 1, sizeof *zero);
    for (size_t j = 0; j < width; j++) {
        nh_ex state = x->o->chart->symbol[j], m = monomial;
        zero[j] = state == x->s ? state : x->zero;
        for (int k = 1; state != x->s && nh_depends(d, m, state); k++) {
            m = nh_diff(d, m, state);
            e = nh_div(d, nh_diff(d, e, state), nh_int(d, k));
        }
    }
    e = nh_substitute(d, e, width, x->o->chart->symbol, zero);
    nh_free(zero);
    return nh_simplify(d, e);
}

/* Adds e, the coefficient of f_i' (rate) or f_i, to the rows of its products of states. */
static void add_terms(linear_system *x, size_t i, bool rate, nh_ex e)
{
    nh_dag *d = x->d;
    if (nh_complexity(d, e) > longest_rate) x->good = false;
    if (!x->good) return;
    nh_num c = nh_num_int(1);
    nh_ex sum = nh_canonical_sum(d, e);
    if (nh_kind_of(d, sum) == NH_PRODUCT && nh_arity(d, sum) == 1 && nh_is_number(d, nh_exponent_of(d, sum, 0), 1)) {
        c = nh_constant_of(d, sum);
        sum = nh_child(d, sum, 0);
    }
    bool many = nh_kind_of(d, sum) == NH_SUM, polynomial = true;
    size_t n = many ? nh_arity(d, sum) + 1 : 1;
    split_term *term = nh_alloc_array(n, sizeof *term);
    for (size_t k = 0; k < n; k++) {
        if (!many) term[k] = split(x, c, sum);
        else if (k == 0) term[k] = split(x, nh_num_mul(c, nh_constant_of(d, sum)), nh_int(d, 1));
        else term[k] = split(x, nh_num_mul(c, nh_coefficient_of(d, sum, k - 1)), nh_child(d, sum, k - 1));
        polynomial &= term[k].monomial;
    }
    for (size_t k = 0; k < n; k++) {
        row *r = row_of(x, term[k].product);
        nh_ex *to = rate ? &r->P[i] : &r->Q[i];
        if (!polynomial) *to = nh_add(d, *to, term[k].in_s);
        else if (is_none(x, *to)) *to = coefficient_of(x, term[k].product, e);
    }
    nh_free(term);
}

static void read_rates(linear_system *x)
{
    nh_ex pace = nh_model_gamma(x->o, x->s);
    for (size_t i = 0; i < x->words && x->good; i++) {
        add_terms(x, i, true, nh_mul(x->d, pace, x->word[i]));
        add_terms(x, i, false, nh_model_gamma(x->o, x->word[i]));
    }
    for (size_t r = 0; r < x->rows; r++)
        for (size_t j = 0; j < x->words && x->good; j++) {
            x->row[r].P[j] = shortened(x, x->row[r].P[j]);
            x->row[r].Q[j] = shortened(x, x->row[r].Q[j]);
        }
    for (size_t i = 0; i < x->words; i++) {
        x->live[i] = true;
        for (size_t j = 0; j < x->words; j++) x->T[i][j] = i == j ? nh_int(x->d, 1) : x->zero;
    }
}

/* ---- elimination ---- */

/* How many of the unknowns' coefficients are not zero. */
static size_t entries_of(const linear_system *x, const nh_ex *e)
{
    size_t n = 0;
    for (size_t j = 0; j < x->words; j++) n += !is_none(x, e[j]);
    return n;
}

/* The shortest entry as a divisor; one that depends on s only if all do. */
static size_t pivot_in(const linear_system *x, const nh_ex *e)
{
    size_t best = most, cost = 0;
    for (size_t j = 0; j < x->words; j++) {
        if (is_none(x, e[j])) continue;
        size_t here = nh_complexity(x->d, e[j]) + (nh_depends(x->d, e[j], x->s) ? x->longest : 0);
        if (best == most || here < cost) best = j, cost = here;
    }
    return best;
}

static void add_multiple(linear_system *x, nh_ex *to, nh_ex c, nh_ex e)
{
    if (is_none(x, c) || is_none(x, e)) return;
    *to = shortened(x, nh_add(x->d, *to, nh_mul(x->d, c, e)));
}

/* g_p = sum_j c_j g_j, c_p = 0 */
static void substitute(linear_system *x, size_t p, const nh_ex *c)
{
    for (size_t j = 0; j < x->words && x->good; j++) {
        if (is_none(x, c[j])) continue;
        nh_ex slope = shortened(x, nh_diff(x->d, c[j], x->s));
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
static bool use_algebraic(linear_system *x)
{
    row *best = NULL;
    for (size_t r = 0; r < x->rows; r++) {
        row *at = &x->row[r];
        if (entries_of(x, at->P) || !entries_of(x, at->Q)) continue;
        if (!best || entries_of(x, at->Q) < entries_of(x, best->Q)) best = at;
    }
    if (!best) return false;
    size_t p = pivot_in(x, best->Q);
    nh_ex c[most], by = best->Q[p];
    for (size_t j = 0; j < x->words; j++)
        c[j] = j == p || is_none(x, best->Q[j]) ? x->zero : shortened(x, nh_neg(x->d, nh_div(x->d, best->Q[j], by)));
    if (x->good) substitute(x, p, c);
    return true;
}

/* One more derivative g_p' in its own row alone: false where there is none. */
static bool use_derivative(linear_system *x)
{
    row *best = NULL;
    for (size_t r = 0; r < x->rows; r++) {
        row *at = &x->row[r];
        if (at->used || !entries_of(x, at->P)) continue;
        if (!best || entries_of(x, at->P) < entries_of(x, best->P)) best = at;
    }
    if (!best) return false;
    size_t p = best->pivot = pivot_in(x, best->P);
    nh_ex by = best->P[p];
    best->used = true;
    for (size_t j = 0; j < x->words; j++) {
        if (!is_none(x, best->P[j])) best->P[j] = shortened(x, nh_div(x->d, best->P[j], by));
        if (!is_none(x, best->Q[j])) best->Q[j] = shortened(x, nh_div(x->d, best->Q[j], by));
    }
    for (size_t r = 0; r < x->rows && x->good; r++) {
        row *at = &x->row[r];
        if (at == best || is_none(x, at->P[p])) continue;
        nh_ex c = nh_neg(x->d, at->P[p]);
        for (size_t j = 0; j < x->words; j++) {
            add_multiple(x, &at->P[j], c, best->P[j]);
            add_multiple(x, &at->Q[j], c, best->Q[j]);
        }
    }
    return true;
}

/* Words that depend on each other leave an unknown without an equation: it is set to 0. */
static bool drop_free(linear_system *x)
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

/* A row that loses its derivatives is algebraic, so that all begins again. */
static void eliminate_unknowns(linear_system *x)
{
    do {
        while (x->good && use_algebraic(x)) {
        }
        while (x->good && use_derivative(x)) {
        }
        bool again = false;
        for (size_t r = 0; r < x->rows; r++) again |= !entries_of(x, x->row[r].P) && entries_of(x, x->row[r].Q);
        if (again) continue;
        if (!drop_free(x)) return;
    } while (x->good);
}

/* ---- blocks ---- */

/* The row with g_p' alone. */
static const row *row_for(const linear_system *x, size_t p)
{
    for (size_t r = 0; r < x->rows; r++)
        if (x->row[r].used && x->row[r].pivot == p) return &x->row[r];
    return NULL;
}

/* The unknowns that are coupled with p; returns their number, and marks them in `seen`. */
static size_t connected(const linear_system *x, size_t p, bool *seen, size_t *out)
{
    size_t n = 1;
    out[0] = p;
    seen[p] = true;
    for (size_t k = 0; k < n; k++)
        for (size_t j = 0; j < x->words; j++) {
            if (seen[j] || !x->live[j]) continue;
            if (is_none(x, row_for(x, out[k])->Q[j]) && is_none(x, row_for(x, j)->Q[out[k]])) continue;
            seen[j] = true;
            out[n++] = j;
        }
    return n;
}

/* A and T of the unknowns g. */
static void read_block(const linear_system *x, size_t order, const size_t *g, nh_named_block *out)
{
    *out = (nh_named_block){.order = order};
    for (size_t j = 0; j < order; j++) {
        for (size_t i = 0; i < order; i++) out->A[i][j] = nh_neg(x->d, row_for(x, g[i])->Q[g[j]]);
        for (size_t i = 0; i < x->words; i++) out->T[i][j] = x->T[i][g[j]];
    }
}

size_t nh_named_blocks(const nh_model *model, nh_ex s, size_t words, const nh_ex *word, size_t longest,
                       nh_named_block out[NH_NAMED_WORDS])
{
    linear_system *x = nh_alloc(sizeof *x);
    bool seen[most] = {false};
    size_t g[most], count = 0;
    *x = (linear_system){.o = model,
                         .d = model->dag,
                         .s = s,
                         .zero = nh_int(model->dag, 0),
                         .longest = longest,
                         .words = words,
                         .word = word,
                         .good = words <= most};
    if (x->good) read_rates(x);
    if (x->good) eliminate_unknowns(x);
    for (size_t p = 0; p < words && x->good; p++) {
        if (!x->live[p] || seen[p]) continue;
        size_t order = connected(x, p, seen, g);
        if (order > 1 && order <= NH_NAMED_ORDER) read_block(x, order, g, &out[count++]);
    }
    nh_free(x->row);
    nh_free(x);
    return count;
}
