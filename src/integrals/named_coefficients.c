/* named_coefficients: from words to currents with named functions. [docs/method.md, sec. 10, (31), (32)]
 *
 *     nh_named_blocks    g' = A g, f = T g                                    (named_system.h)
 *     find_equation      y = g_j:  (y, y', .., y^(n))^T = V g, V_0 = e_j, V_(r+1) = V_r' + V_r A; Cramer's rule gives c
 *     find_root          order 3: is y = u v?  P = p/3, Q = (q - P' + 2 P^2)/4, and r must be 2 Q' - 4 P Q
 *     nh_named_match     u with a name, in s or another variable              (named_variable.h, named_match.h)
 *     keep_current       the other g from y, y', .. by Cramer's rule; Phi = sum_i f_i b_i, kept where Gamma(Phi) = 0 */
#include "integrals/named_coefficients.h"

#include <math.h>
#include <string.h>

#include "evaluate/tape.h"
#include "exact/normal.h"
#include "exact/solve.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"
#include "graph/print.h"

enum { most_forms = 5, longest_form = 60, longest_shown = 250, three = NH_NAMED_ORDER };
enum { longest_of_two = 1200, longest_of_many = 300 }; /* complexities of coefficients, of two words and of many */

typedef struct {
    const nh_model *o;
    nh_dag *d;
    nh_ex s;
    size_t words; /* at hand: two, or all */
    const nh_ex *word;
    nh_arena *arena;
    size_t count;
    nh_ex *out;
    const char *open; /* the first equation without a match */
} seeker;

/* The equation of the unknown y of a block of order n. */
typedef struct {
    const nh_named_block *block;
    size_t order, y;
    nh_ex V[(three + 1) * three]; /* y, y', .. in g: (n + 1) x n */
    nh_ex det;                    /* of the first n rows */
    nh_ex c[three];               /* y^(n) = sum_k c_k y^(k) */
    nh_ex lead[2];                /* what y is multiplied by, and for n = 2 the other unknown */
    bool second;                  /* of order two, or y = u v and u and v satisfy */
    nh_named_equation root, tidy; /* tidy: the same, shorter where common factors cancel */
    size_t length;
} candidate;

/* Currents of one equation, and the complexity of their formulas together. */
typedef struct {
    size_t count, length;
    nh_ex phi[three];
} found_currents;

/* The value of a function of s at the middle of its sampling interval, with the parameters' values. */
static double typical_value(void *context, nh_ex e)
{
    const seeker *x = context;
    const nh_model *model = x->o;
    size_t at = 0;
    while (model->chart->symbol[at] != x->s) at++;
    double middle = 0.52 * model->chart->low[at] + 0.48 * model->chart->high[at], out;
    nh_tape *tape = nh_tape_create(model->dag, 1, &x->s, 1, &e, model->system->parameters, model->parameter,
                                   model->parameter_value);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, &middle, &out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return out;
}

/* ---- the equation ---- */

static nh_ex shortened(const seeker *x, nh_ex e) { return nh_simplify_short(x->d, e, 0); }

/* sum_i T_ij b_i: what g_j is multiplied by in Phi. */
static nh_ex lead_of(const seeker *x, const nh_named_block *b, size_t j)
{
    nh_ex lead = nh_int(x->d, 0);
    for (size_t i = 0; i < x->words; i++) lead = nh_add(x->d, lead, nh_mul(x->d, b->T[i][j], x->word[i]));
    return shortened(x, lead);
}

/* The rows of V and the coefficients c; false where they are long, or y satisfies an equation of lower order. */
static bool find_equation(const seeker *x, candidate *e)
{
    nh_dag *d = x->d;
    size_t n = e->order, longest = x->words == 2 ? longest_of_two : longest_of_many;
    for (size_t k = 0; k < n; k++) e->V[k] = nh_int(d, k == e->y);
    for (size_t r = 0; r < n; r++)
        for (size_t k = 0; k < n; k++) {
            nh_ex v = nh_diff(d, e->V[r * n + k], x->s);
            for (size_t i = 0; i < n; i++) v = nh_add(d, v, nh_mul(d, e->V[r * n + i], e->block->A[i][k]));
            e->V[(r + 1) * n + k] = v = shortened(x, v);
            if (nh_complexity(d, v) > longest) return false;
        }
    e->det = shortened(x, nh_solve_determinant(d, n, e->V));
    if (nh_complexity(d, e->det) > longest || nh_normal_is_zero(d, e->det, 0) != NH_NONZERO) return false;
    for (size_t k = 0; k < n; k++) {
        nh_ex m[three * three];
        memcpy(m, e->V, n * n * sizeof *m);
        memcpy(m + k * n, e->V + n * n, n * sizeof *m);
        e->c[k] = shortened(x, nh_div(d, shortened(x, nh_solve_determinant(d, n, m)), e->det));
        if (nh_complexity(d, e->c[k]) > longest) return false;
    }
    return true;
}

/* (31), or (32): is it a symmetric square? */
static void find_root(const seeker *x, candidate *e)
{
    nh_dag *d = x->d;
    nh_ex P = e->c[1], Q = e->c[0];
    e->second = true;
    if (e->order == three) {
        P = shortened(x, nh_mul(d, e->c[2], nh_ratio(d, 1, three)));
        nh_ex twice = nh_mul(d, nh_int(d, 2), nh_powi(d, P, 2));
        Q = nh_add(d, nh_sub(d, e->c[1], nh_diff(d, P, x->s)), twice);
        Q = shortened(x, nh_mul(d, nh_ratio(d, 1, 4), Q));
        nh_ex product = nh_product(d, three, (nh_ex[]){nh_int(d, 4), P, Q});
        nh_ex r = nh_sub(d, nh_mul(d, nh_int(d, 2), nh_diff(d, Q, x->s)), product);
        e->second = nh_normal_is_zero(d, nh_sub(d, r, e->c[0]), 0) == NH_ZERO;
    }
    e->root = (nh_named_equation){x->s, P, Q, x->s};
    e->tidy = (nh_named_equation){x->s, nh_named_tidy(d, P, x->s), nh_named_tidy(d, Q, x->s), x->s};
}

/* The equation of unknown y of this block, and how long it is. */
static bool make_candidate(const seeker *x, const nh_named_block *b, size_t y, candidate *e)
{
    nh_dag *d = x->d;
    *e = (candidate){.block = b, .order = b->order, .y = y};
    if (!find_equation(x, e)) return false;
    find_root(x, e);
    e->lead[0] = lead_of(x, b, y);
    if (e->order == 2) e->lead[1] = lead_of(x, b, 1 - y);
    e->length = nh_complexity(d, e->lead[0]);
    if (e->order == 2) e->length += nh_complexity(d, e->tidy.p) + nh_complexity(d, e->tidy.q);
    for (size_t k = 0; k < e->order && e->order > 2; k++) e->length += nh_complexity(d, e->c[k]);
    return true;
}

/* ---- currents ---- */

/* The current in which the unknown is y; kept when it is proved. */
static void keep_current(const seeker *x, const candidate *e, nh_ex y, found_currents *f)
{
    nh_dag *d = x->d;
    size_t n = e->order;
    nh_ex Y[three] = {y}, phi = nh_int(d, 0);
    for (size_t k = 1; k < n; k++) Y[k] = nh_diff(d, Y[k - 1], x->s);
    for (size_t k = 0; k < n; k++) {
        nh_ex m[three * three], g = y;
        memcpy(m, e->V, n * n * sizeof *m);
        for (size_t i = 0; i < n; i++) m[i * n + k] = Y[i];
        if (k != e->y) g = shortened(x, nh_div(d, nh_solve_determinant(d, n, m), e->det));
        if (!isfinite(typical_value((void *)x, g))) return;
        for (size_t i = 0; i < x->words; i++)
            phi = nh_add(d, phi, nh_product(d, 3, (nh_ex[]){e->block->T[i][k], g, x->word[i]}));
    }
    if (f->count == three || (f->count && f->phi[0] == phi)) return;
    if (nh_normal_is_zero(d, nh_model_gamma(x->o, phi), 0) != NH_ZERO) return;
    f->length += nh_complexity(d, phi);
    f->phi[f->count++] = phi;
}

/* The currents of one equation, in the first variable in which it matches. */
static found_currents match_equation(seeker *x, const candidate *e, const nh_named_equation *equation)
{
    nh_named_equation changed[NH_MOST_EQUATIONS];
    nh_ex u[2];
    found_currents f = {0};
    size_t n = nh_named_variables(x->d, equation, changed);
    for (size_t k = 0; k < n && !f.count; k++) {
        size_t solutions = nh_named_match(x->d, &changed[k], typical_value, x, u);
        if (e->order == 2)
            for (size_t i = 0; i < solutions; i++) keep_current(x, e, u[i], &f);
        else if (solutions == 2)
            for (size_t i = 0; i < three; i++) keep_current(x, e, nh_mul(x->d, u[i / 2], u[(i + 1) / 2]), &f);
    }
    return f;
}

static found_currents match_candidate(seeker *x, const candidate *e)
{
    found_currents f = {0};
    if (!e->second) return f;
    f = match_equation(x, e, &e->root);
    if (!f.count && (e->tidy.p != e->root.p || e->tidy.q != e->root.q)) f = match_equation(x, e, &e->tidy);
    return f;
}

/* ---- the equation in words ---- */

/* " = (p)*f'' + .." */
static void put_right(const seeker *x, size_t count, const nh_ex *c, const char *const *of, nh_text *out)
{
    const char *between = " = ";
    for (size_t k = count; k-- > 0;) {
        if (nh_is_zero(x->d, c[k])) continue;
        char *e = nh_print_string(x->d, c[k]);
        nh_text_addf(out, "%s(%s)*%s", between, e, of[k]);
        between = " + ";
        nh_free(e);
    }
}

/* NULL where it is too long. */
static const char *text_of(const seeker *x, const candidate *e)
{
    nh_text text;
    const char *s = nh_name_of(x->d, x->s);
    const nh_ex of_two[2] = {e->tidy.q, e->tidy.p};
    if (e->length > longest_shown) return NULL;
    nh_text_init(&text);
    char *lead = nh_print_string(x->d, e->lead[0]), *other = e->order == 2 ? nh_print_string(x->d, e->lead[1]) : NULL;
    nh_text_addf(&text, "f(%s)*(%s) + ", s, lead);
    if (other) nh_text_addf(&text, "h(%s)*(%s), f''", s, other);
    else nh_text_addf(&text, "..%s", e->second ? ", f = u*v with solutions u and v of u''" : ", f'''");
    if (other) put_right(x, 2, of_two, (const char *const[]){"f", "f'"}, &text);
    else if (e->second) put_right(x, 2, (nh_ex[]){e->root.q, e->root.p}, (const char *const[]){"u", "u'"}, &text);
    else put_right(x, three, e->c, (const char *const[]){"f", "f'", "f''"}, &text);
    nh_free(lead);
    nh_free(other);
    const char *out = nh_arena_strdup(x->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

/* ---- which words ---- */

/* Of the equations tried for the same words: the currents, more of them first, then those with shorter formulas; and
 * the shortest equation. */
typedef struct {
    found_currents best;
    size_t length;
    const char *text;
} choice;

/* The currents by the equation of unknown y, where they are more, or shorter, than those of the choice so far. */
static void try_unknown(seeker *x, const nh_named_block *b, size_t y, choice *c)
{
    candidate e;
    if (!make_candidate(x, b, y, &e)) return;
    found_currents f = match_candidate(x, &e);
    if (f.count > c->best.count || (f.count && f.count == c->best.count && f.length < c->best.length)) c->best = f;
    if (c->length && e.length >= c->length) return;
    c->length = e.length;
    c->text = text_of(x, &e);
}

/* The currents of the best equation; where there are none, the shortest equation as a text. */
static void take_choice(seeker *x, const choice *c)
{
    if (!c->best.count && !x->open) x->open = c->text;
    for (size_t k = 0; k < c->best.count && x->count < NH_MOST_NAMED; k++) x->out[x->count++] = c->best.phi[k];
}

/* No state but s and the symbols a and b. */
static bool is_form_of(const seeker *x, nh_ex e, nh_ex a, nh_ex b)
{
    const nh_chart *c = x->o->chart;
    for (size_t j = 0; j < x->o->width; j++)
        if (c->symbol[j] != x->s && c->symbol[j] != a && c->symbol[j] != b && nh_depends(x->d, e, c->symbol[j]))
            return false;
    return nh_depends(x->d, e, a) && nh_depends(x->d, e, b) && nh_complexity(x->d, e) <= longest_form;
}

/* The currents with two of the words and their forms, in each order: the equation is that of the first one's
 * coefficient. */
static void try_pair(seeker *x, size_t count, const nh_ex *list, nh_named_block *block)
{
    choice c = {0};
    x->words = 2;
    for (size_t u = 0; u < count; u++)
        for (size_t v = 0; v < count; v++) {
            nh_ex pair[2] = {list[u], list[v]};
            x->word = pair;
            if (u != v && nh_named_blocks(x->o, x->s, 2, pair, longest_of_two, block) == 1)
                try_unknown(x, block, 0, &c);
        }
    take_choice(x, &c);
}

static bool is_position(const nh_model *model, nh_ex symbol)
{
    size_t s = 0;
    while (s < model->m && symbol != model->system->coordinate[s].q) s++;
    return s < model->m;
}

/* Pairs of symbols at least one of whose rates contains the other, and none of which is the rate of s. */
static void try_pairs(seeker *x, size_t words, const nh_ex *word, size_t forms, const nh_ex *form,
                      nh_named_block *block)
{
    nh_ex pace = nh_model_gamma(x->o, x->s), whole[NH_NAMED_WORDS], symbol[NH_NAMED_WORDS], rate[NH_NAMED_WORDS];
    size_t n = 0;
    for (size_t i = 0; i < words && n < NH_NAMED_WORDS; i++) {
        if (nh_kind_of(x->d, word[i]) != NH_SYMBOL || word[i] == x->s || word[i] == pace) continue;
        symbol[n] = word[i];
        whole[n] = is_position(x->o, word[i]) ? nh_mul(x->d, word[i], pace) : word[i];
        rate[n] = nh_model_gamma(x->o, whole[n]);
        n++;
    }
    for (size_t i = 0; i < n; i++)
        for (size_t j = i + 1; j < n; j++) {
            nh_ex list[most_forms] = {whole[i], whole[j]};
            size_t count = 2;
            if (!nh_depends(x->d, rate[i], symbol[j]) && !nh_depends(x->d, rate[j], symbol[i])) continue;
            for (size_t k = 0; k < forms && count < most_forms; k++)
                if (whole[i] == symbol[i] && whole[j] == symbol[j] && is_form_of(x, form[k], symbol[i], symbol[j]))
                    list[count++] = form[k];
            try_pair(x, count, list, block);
        }
}

size_t nh_named_coefficients(const nh_model *o, nh_ex variable, size_t words, const nh_ex *word, size_t forms,
                             const nh_ex *form, nh_arena *arena, nh_ex out[NH_MOST_NAMED], const char **open)
{
    seeker x = {.o = o, .d = o->dag, .s = variable, .arena = arena, .out = out};
    nh_named_block *block = nh_alloc_array(NH_NAMED_WORDS, sizeof *block);
    try_pairs(&x, words, word, forms, form, block);
    if (!x.count && !x.open) {
        x.words = words;
        x.word = word;
        size_t blocks = nh_named_blocks(o, variable, words, word, longest_of_many, block);
        for (size_t k = 0; k < blocks; k++) {
            choice c = {0};
            for (size_t y = 0; y < block[k].order; y++) try_unknown(&x, &block[k], y, &c);
            take_choice(&x, &c);
        }
    }
    nh_free(block);
    *open = x.open;
    return x.count;
}
