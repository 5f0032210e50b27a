#include "integrals/named_coefficients.h"

#include <math.h>

#include "evaluate/tape.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"
#include "graph/print.h"
#include "integrals/named_match.h"

enum {
    most_words = 32,
    most_forms = 5,
    longest_entry = 300,
    longest = 3000,
    longest_form = 60,
    longest_shown = 250
}; /* longest: largest complexity of a rate */

typedef struct {
    const nh_model *o;
    nh_ex s, pace; /* the variable and Gamma of it */
    size_t n;
    nh_ex word[most_words];
    nh_ex whole[most_words];          /* velocities w, positions q as q pace: of the same degree in the velocities */
    nh_ex A[most_words * most_words]; /* Gamma(whole i) = pace sum_j A[i most_words
                                         + j] whole j */
    bool closed[most_words];          /* there is such a row */
    size_t forms;
    const nh_ex *form;
    nh_arena *arena;
    size_t count;
    nh_ex *out;
    const char *open; /* the first equation without a match */
} seeker;

static nh_ex simple(const seeker *x, nh_ex e) { return nh_simplify_short(x->o->dag, e, 0); }

double nh_named_typical(const nh_model *o, nh_ex s, nh_ex e)
{
    size_t at = 0;
    while (o->chart->symbol[at] != s) at++;
    double middle = 0.52 * o->chart->low[at] + 0.48 * o->chart->high[at], out;
    nh_tape *tape = nh_tape_create(o->dag, 1, &s, 1, &e, o->system->parameters, o->parameter, o->parameter_value);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, &middle, &out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return out;
}

static double value_of(void *context, nh_ex e)
{
    const seeker *x = context;
    return nh_named_typical(x->o, x->s, e);
}

static bool depends_on_s_alone(const seeker *x, nh_ex e)
{
    for (size_t j = 0; j < x->o->width; j++)
        if (x->o->chart->symbol[j] != x->s && nh_depends(x->o->dag, e, x->o->chart->symbol[j])) return false;
    return true;
}

/* Row i of A, where Gamma(whole i) is pace times something linear in the words:
 * its derivatives at pace = 1 say what. */
static bool row(seeker *x, size_t i)
{
    nh_dag *d = x->o->dag;
    nh_ex rate = nh_model_gamma(x->o, x->whole[i]), rest = rate, one = nh_int(d, 1);
    if (x->word[i] == x->pace || nh_complexity(d, rate) > longest) return false;
    for (size_t j = 0; j < x->n; j++) {
        nh_ex *a = &x->A[i * most_words + j], slope = nh_diff(d, rate, x->word[j]);
        if (nh_kind_of(d, x->pace) == NH_SYMBOL) slope = nh_substitute(d, slope, 1, &x->pace, &one);
        *a = nh_is_zero(d, slope) || x->word[j] == x->pace ? nh_int(d, 0) : nh_simplify(d, slope);
        if (!depends_on_s_alone(x, *a) || nh_complexity(d, *a) > longest_entry) return false;
        rest = nh_sub(d, rest, nh_product(d, 3, (nh_ex[]){x->pace, *a, x->whole[j]}));
    }
    return nh_normal_is_zero(d, rest, 0) == NH_ZERO;
}

/* Are the rates of words i and j combinations of these two, at least one of them with the other word? */
static bool is_pair(const seeker *x, size_t i, size_t j)
{
    const nh_dag *d = x->o->dag;
    if (!x->closed[i] || !x->closed[j]) return false;
    for (size_t k = 0; k < x->n; k++)
        if (k != i && k != j && !(nh_is_zero(d, x->A[i * most_words + k]) && nh_is_zero(d, x->A[j * most_words + k])))
            return false;
    return !nh_is_zero(d, x->A[i * most_words + j]) || !nh_is_zero(d, x->A[j * most_words + i]);
}

/* A form e[0] a + e[1] b of two words. */
typedef struct {
    nh_ex e[2], whole;
} linear_form;

typedef struct {
    nh_ex entry[2][2];
} square;

static nh_ex times(nh_dag *d, nh_ex a, nh_ex b, nh_ex c, nh_ex e)
{
    return nh_add(d, nh_mul(d, a, b), nh_mul(d, c, e));
}

/* A of the words i and j for the forms u = F_0, v = F_1 instead of them: (F' +
 * F A) F^-1. */
static square in_forms(const seeker *x, size_t i, size_t j, const linear_form *u, const linear_form *v)
{
    nh_dag *d = x->o->dag;
    const nh_ex A[2][2] = {{x->A[i * most_words + i], x->A[i * most_words + j]},
                           {x->A[j * most_words + i], x->A[j * most_words + j]}};
    const nh_ex F[2][2] = {{u->e[0], u->e[1]}, {v->e[0], v->e[1]}};
    nh_ex det = nh_sub(d, nh_mul(d, F[0][0], F[1][1]), nh_mul(d, F[0][1], F[1][0]));
    const nh_ex inverse[2][2] = {{F[1][1], nh_neg(d, F[0][1])}, {nh_neg(d, F[1][0]), F[0][0]}};
    square out;
    nh_ex left[2][2];
    for (int k = 0; k < 2; k++)
        for (int l = 0; l < 2; l++)
            left[k][l] = nh_add(d, nh_diff(d, F[k][l], x->s), times(d, F[k][0], A[0][l], F[k][1], A[1][l]));
    for (int k = 0; k < 2; k++)
        for (int l = 0; l < 2; l++)
            out.entry[k][l] = simple(x, nh_div(d, times(d, left[k][0], inverse[0][l], left[k][1], inverse[1][l]), det));
    return out;
}

/* (31) for f, the coefficient of the first form, with h that of the second: f'
 * = a f + b h. */
typedef struct {
    nh_named_equation equation, tidy; /* tidy: the same, shorter where common factors cancel */
    nh_ex a, b;
    const linear_form *first, *second;
} elimination;

/* False where f satisfies an equation of first order alone. */
static bool eliminate(const seeker *x, size_t i, size_t j, elimination *out)
{
    nh_dag *d = x->o->dag;
    square A = in_forms(x, i, j, out->first, out->second);
    nh_ex a = nh_neg(d, A.entry[0][0]), b = nh_neg(d, A.entry[1][0]), c = nh_neg(d, A.entry[0][1]),
          e = nh_neg(d, A.entry[1][1]);
    if (nh_is_zero(d, b)) return false;
    nh_ex ratio = nh_div(d, nh_diff(d, b, x->s), b); /* f'' = (a + e + b'/b) f' + (a' - a b'/b + b c - a e) f */
    nh_ex q =
        nh_add(d, nh_sub(d, nh_diff(d, a, x->s), nh_mul(d, a, ratio)), nh_sub(d, nh_mul(d, b, c), nh_mul(d, a, e)));
    nh_ex p = simple(x, nh_add(d, nh_add(d, a, e), ratio));
    q = simple(x, q);
    out->equation = (nh_named_equation){x->s, p, q, x->s};
    out->tidy = (nh_named_equation){x->s, nh_named_tidy(d, p, x->s), nh_named_tidy(d, q, x->s), x->s};
    if (nh_complexity(d, p) > 2 * longest_entry || nh_complexity(d, q) > 4 * longest_entry) return false;
    out->a = a;
    out->b = b;
    return true;
}

/* Currents of one equation. */
typedef struct {
    size_t count, length; /* complexity of their formulas together */
    nh_ex phi[2];
} found;

/* Keeps a current when it is proved. */
static void keep(const seeker *x, found *f, nh_ex phi)
{
    nh_dag *d = x->o->dag;
    if (f->count == 2 || (f->count && f->phi[0] == phi) ||
        nh_normal_is_zero(d, nh_model_gamma(x->o, phi), 0) != NH_ZERO)
        return;
    f->length += nh_complexity(d, phi);
    f->phi[f->count++] = phi;
}

/* The currents of one equation, in the first variable in which it matches. */
static found match(seeker *x, const elimination *e, const nh_named_equation *equation)
{
    nh_dag *d = x->o->dag;
    nh_named_equation changed[NH_MOST_EQUATIONS];
    nh_ex u[2];
    found f = {0};
    size_t n = nh_named_variables(d, equation, changed);
    for (size_t k = 0; k < n && !f.count; k++) {
        size_t solutions = nh_named_match(d, &changed[k], value_of, x, u);
        for (size_t i = 0; i < solutions; i++) {
            nh_ex slope = nh_diff(d, u[i], x->s),
                  h = simple(x, nh_div(d, nh_sub(d, slope, nh_mul(d, e->a, u[i])), e->b));
            if (isfinite(value_of(x, u[i])) && isfinite(value_of(x, h)))
                keep(x, &f, times(d, u[i], e->first->whole, h, e->second->whole));
        }
    }
    return f;
}

static size_t length_of(const seeker *x, const elimination *e)
{
    return nh_complexity(x->o->dag, e->tidy.p) + nh_complexity(x->o->dag, e->tidy.q) +
           nh_complexity(x->o->dag, e->first->whole);
}

/* The equation in words where no name is known; NULL where that is too long. */
static const char *text_of(const seeker *x, const elimination *e)
{
    nh_dag *d = x->o->dag;
    const char *out = NULL, *s = nh_name_of(d, x->s);
    if (length_of(x, e) > longest_shown) return NULL;
    char *p = nh_print_string(d, e->tidy.p), *q = nh_print_string(d, e->tidy.q),
         *first = nh_print_string(d, e->first->whole), *second = nh_print_string(d, e->second->whole);
    bool slope = !nh_is_zero(d, e->tidy.p);
    out = nh_arena_printf(x->arena, "f(%s)*(%s) + h(%s)*(%s), f'' = %s%s%s(%s)*f", s, first, s, second,
                          slope ? "(" : "", slope ? p : "", slope ? ")*f' + " : "", q);
    nh_free(p);
    nh_free(q);
    nh_free(first);
    nh_free(second);
    return out;
}

/* The words i and j, and the given forms of these two words, none a multiple of another. */
static size_t forms_of(const seeker *x, size_t i, size_t j, linear_form *out)
{
    nh_dag *d = x->o->dag;
    const nh_ex one = nh_int(d, 1), zero = nh_int(d, 0), a = x->word[i], b = x->word[j];
    size_t n = 2;
    bool velocities = x->whole[i] == a && x->whole[j] == b;
    out[0] = (linear_form){{one, zero}, x->whole[i]};
    out[1] = (linear_form){{zero, one}, x->whole[j]};
    for (size_t k = 0; k < x->forms && n < most_forms && velocities; k++) {
        nh_ex whole = x->form[k];
        if (!nh_depends(d, whole, a) || !nh_depends(d, whole, b) || nh_complexity(d, whole) > longest_form) continue;
        linear_form f = {{simple(x, nh_diff(d, whole, a)), simple(x, nh_diff(d, whole, b))}, whole};
        bool good = depends_on_s_alone(x, f.e[0]) && depends_on_s_alone(x, f.e[1]);
        good = good && nh_normal_is_zero(d, nh_sub(d, whole, times(d, f.e[0], a, f.e[1], b)), 0) == NH_ZERO;
        for (size_t l = 2; l < n && good; l++)
            good = nh_normal_is_zero(d, nh_sub(d, nh_mul(d, f.e[0], out[l].e[1]), nh_mul(d, f.e[1], out[l].e[0])), 0) !=
                   NH_ZERO;
        if (good) out[n++] = f;
    }
    return n;
}

/* Takes the form whose equation gives more currents, or as many with shorter formulas. */
static void seek(seeker *x, size_t i, size_t j)
{
    linear_form list[most_forms];
    size_t n = forms_of(x, i, j, list);
    found best = {0};
    elimination shortest = {0};
    for (size_t u = 0; u < n; u++)
        for (size_t v = 0; v < n; v++) {
            elimination e = {.first = &list[u], .second = &list[v]};
            if (u == v || !eliminate(x, i, j, &e)) continue;
            found f = match(x, &e, &e.equation);
            if (!f.count && (e.tidy.p != e.equation.p || e.tidy.q != e.equation.q)) f = match(x, &e, &e.tidy);
            if (f.count > best.count || (f.count && f.count == best.count && f.length < best.length)) best = f;
            if (!shortest.first || length_of(x, &e) < length_of(x, &shortest)) shortest = e;
        }
    if (!best.count && shortest.first && !x->open) x->open = text_of(x, &shortest);
    for (size_t k = 0; k < best.count && x->count < NH_MOST_NAMED; k++) x->out[x->count++] = best.phi[k];
}

static bool is_position(const nh_model *o, nh_ex symbol)
{
    size_t s = 0;
    while (s < o->m && symbol != o->system->coordinate[s].q) s++;
    return s < o->m;
}

size_t nh_named_coefficients(const nh_model *o, nh_ex variable, size_t words, const nh_ex *word, size_t forms,
                             const nh_ex *form, nh_arena *arena, nh_ex out[NH_MOST_NAMED], const char **open)
{
    seeker *x = nh_alloc(sizeof *x);
    *x = (seeker){.o = o,
                  .s = variable,
                  .pace = nh_model_gamma(o, variable),
                  .forms = forms,
                  .form = form,
                  .arena = arena,
                  .out = out};
    for (size_t i = 0; i < words && x->n < most_words; i++)
        if (nh_kind_of(o->dag, word[i]) == NH_SYMBOL && word[i] != variable) {
            x->whole[x->n] = is_position(o, word[i]) ? nh_mul(o->dag, word[i], x->pace) : word[i];
            x->word[x->n++] = word[i];
        }
    for (size_t i = 0; i < x->n; i++) x->closed[i] = row(x, i);
    for (size_t i = 0; i < x->n; i++)
        for (size_t j = i + 1; j < x->n; j++)
            if (is_pair(x, i, j)) seek(x, i, j);
    size_t n = x->count;
    *open = x->open;
    nh_free(x);
    return n;
}
