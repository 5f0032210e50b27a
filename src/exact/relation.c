/* The relation sum_j c_j e_j = 0 with c_j in Q(parameters) (relation.h): from expressions to a linear system and
 * back.
 *
 *      e_j  -- rewrite_all -->  canonical arguments              inexact numbers end it here
 *           -- collect_kernels -->  generators of one field      constants first, radicands before their roots
 *                r = A^(1/n), s = B^(1/n) with a constant A/B:   r = (A/B)^(1/n) s
 *           -- evaluate_all -->  N_j, polynomials                times a common denominator, which c does not feel
 *           -- nh_relation_solve -->  c_j in the field           one equation per monomial of the variable kernels
 *           -- emit_all -->  c_j as expressions
 *
 * It is tried with the expressions straightened (straighten.h), as they are, and with sines and cosines as
 * exponentials, in this order, until the sizes stay below the bounds. */
#include "exact/relation.h"

#include <string.h>

#include "exact/print_quotient.h"
#include "exact/form.h"
#include "exact/normal.h"
#include "exact/relation_internal.h"
#include "exact/straighten.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"

enum { default_terms = 20000, most_kernels = 300 };

typedef nh_relation_question question;

/* ---- kernels ---- */

/* Contains e parameters only? */
static bool is_constant(const question *q, nh_ex e)
{
    NH_LIST(symbol);
    size_t n = nh_symbols_in(q->dag, e, &symbol);
    for (size_t i = 0; i < n; i++) {
        bool found = false;
        for (size_t j = 0; j < q->parameters && !found; j++) found = symbol[i] == q->parameter[j];
        if (!found) return false;
    }
    return true;
}

static bool constant_kernel(const question *q, const nh_kernel *k)
{
    return is_constant(q, k->atom) && (k->kind != NH_KERNEL_POWER || is_constant(q, k->base));
}

/* A quotient of constants? */
static bool constant_quotient(const question *q, const nh_quotient *a)
{
    for (size_t g = 0; g < q->form.kernels.count; g++)
        if (!q->constant[g] && nh_quotient_has(q->form.field, a, g)) return false;
    return true;
}

/* A kernel for radicand^(1/order); the field has spare ones. */
static size_t add_root(question *q, nh_ex radicand, const nh_quotient *value, nh_num unit)
{
    nh_kernels *k = &q->form.kernels;
    size_t kernel = k->count++;
    nh_grow(&k->item, &k->capacity, k->count, sizeof *k->item);
    k->item[kernel] = (nh_kernel){.kind = NH_KERNEL_ROOT, .atom = radicand, .unit = unit};
    q->constant[kernel] = true;
    nh_quotient_field_relate(q->form.field, kernel, (unsigned)unit.q, value);
    return kernel;
}

/* value^(1/order) for a constant value: a power of an existing kernel, or a new kernel; NULL when it cannot be
 * expressed. */
static const nh_quotient *root_of(question *q, const nh_quotient *value, nh_num unit)
{
    nh_kernels *k = &q->form.kernels;
    nh_pieces pieces;
    nh_arena *arena = nh_arena_create();
    bool fits = nh_pieces_make(q->form.field, arena, value, false, &pieces);
    nh_ex radicand = fits ? nh_print_quotient_terms(k, &pieces) : 0;
    nh_arena_free(arena);
    if (!fits) return NULL;
    for (size_t i = 0; i < k->count; i++)
        if (k->item[i].kind == NH_KERNEL_ROOT && k->item[i].atom == radicand && k->item[i].unit.q % unit.q == 0)
            return nh_quotient_power_of(q->form.field, i, k->item[i].unit.q / unit.q);
    return nh_quotient_power_of(q->form.field, add_root(q, radicand, value, unit), 1);
}

/* (A/B)^(1/n) as it is or as 1/(B/A)^(1/n), whichever has no denominator; NULL when A/B is not constant. */
static const nh_quotient *constant_root(question *q, const nh_quotient *a, const nh_quotient *b, nh_num unit)
{
    nh_quotient_field *field = q->form.field;
    const nh_quotient *ratio = nh_quotient_mul(field, a, nh_quotient_inv(field, b));
    if (nh_quotient_field_state_of(field) != NH_FIELD_FINE || !constant_quotient(q, ratio)) return NULL;
    const nh_quotient *inverse = nh_quotient_inv(field, ratio);
    bool upside_down = nh_relation_is_polynomial(field, inverse) && !nh_relation_is_polynomial(field, ratio);
    const nh_quotient *root = root_of(q, upside_down ? inverse : ratio, unit);
    return root && upside_down ? nh_quotient_inv(field, root) : root;
}

/* Where there are r = A^(1/n) and s = B^(1/n) with a constant A/B: r = (A/B)^(1/n) s.  As roots are positive where they
 * are real, this needs no assumption on signs. */
static bool relate_to_earlier(question *q, size_t root, const nh_quotient *radicand, const size_t *earlier,
                              size_t count)
{
    nh_form *f = &q->form;
    nh_num unit = f->kernels.item[root].unit;
    for (size_t i = 0; i < count; i++) {
        nh_kernel other = f->kernels.item[earlier[i]];
        if (other.unit.q != unit.q) continue;
        const nh_quotient *factor = constant_root(q, radicand, nh_form_eval(f, other.atom), unit);
        if (!factor) continue;
        nh_quotient_field_relate(f->field, root, 1,
                                 nh_quotient_mul(f->field, factor, nh_quotient_power_of(f->field, earlier[i], 1)));
        return true;
    }
    return false;
}

/* Is the kernel a sine that is replaced by exponentials? */
static bool in_exponentials(const question *q, size_t kernel)
{
    return q->exponentials && !q->constant[kernel] && q->form.kernels.item[kernel].kind == NH_KERNEL_SIN;
}

/* Generators of the field from `first` on: i, then exp(i u) of each. */
static void relate_to_exponentials(question *q, size_t first)
{
    nh_quotient_field *field = q->form.field;
    nh_num half = nh_num_ratio(1, 2), minus = nh_num_int(-1);
    q->constant[first] = false;
    nh_quotient_field_relate(field, first, 2, nh_quotient_number(field, minus));
    const nh_quotient *minus_i = nh_quotient_scale(field, nh_quotient_power_of(field, first, 1), minus);
    for (size_t i = 0; i < q->form.kernels.count; i++) {
        if (!in_exponentials(q, i)) continue;
        q->constant[++first] = false;
        const nh_quotient *z = nh_quotient_scale(field, nh_quotient_power_of(field, first, 1), half),
                          *inverse = nh_quotient_scale(field, nh_quotient_power_of(field, first, -1), half),
                          *less = nh_quotient_add(field, z, nh_quotient_scale(field, inverse, minus));
        nh_quotient_field_relate(field, i, 1, nh_quotient_mul(field, minus_i, less));
        nh_quotient_field_relate(field, q->form.kernels.item[i].partner, 1, nh_quotient_add(field, z, inverse));
    }
}

/* Adds the kernels in order, radicands before their roots.  Returns whether the kernel is a root of variables that is
 * not expressed by another. */
static bool relate_kernel(question *q, size_t kernel, const size_t *earlier, size_t count)
{
    nh_form *f = &q->form;
    nh_kernel k = f->kernels.item[kernel]; /* a copy: roots may be added */
    if (k.kind == NH_KERNEL_SIN && !in_exponentials(q, kernel))
        nh_quotient_field_relate_pair(f->field, kernel, k.partner, false);
    if (k.kind == NH_KERNEL_ABS) nh_form_relate_abs(f, kernel);
    if (k.kind != NH_KERNEL_ROOT) return false;
    const nh_quotient *radicand = nh_form_eval(f, k.atom);
    if (!q->constant[kernel] && relate_to_earlier(q, kernel, radicand, earlier, count)) return false;
    nh_quotient_field_relate(f->field, kernel, (unsigned)k.unit.q, radicand);
    return !q->constant[kernel];
}

/* Marks the kernels that are coefficients, spare ones included.  Returns the number of roots of variables. */
static size_t sort_out(question *q)
{
    const nh_kernels *k = &q->form.kernels;
    size_t roots = 0;
    for (size_t i = 0; i < k->count; i++) roots += k->item[i].kind == NH_KERNEL_ROOT;
    q->constant = nh_alloc_array(2 * k->count + roots + 2, sizeof *q->constant);
    for (size_t i = 0; i < k->count; i++) {
        q->constant[i] = constant_kernel(q, &k->item[i]);
        if (q->constant[i] && k->item[i].kind == NH_KERNEL_ROOT) roots--;
    }
    for (size_t i = 0; i <= roots; i++) q->constant[k->count + i] = true;
    return roots;
}

/* The kernels of all expressions, and their relations. */
static bool collect_kernels(question *q)
{
    nh_kernels *k = &q->form.kernels;
    nh_kernels_init(k, q->dag, false, true);
    k->coarse = true;
    for (size_t j = 0; j < q->n; j++) nh_kernels_collect(k, q->e[j]);
    if (k->broken || k->too_deep) return false;
    nh_kernels_settle(k);
    if (k->count > most_kernels) return false;
    size_t count = k->count, roots = sort_out(q), *earlier = nh_alloc_array(roots + 1, sizeof *earlier);
    size_t exponentials = 0, first = count + (roots ? roots - 1 : 0);
    for (size_t i = 0; i < count; i++) exponentials += in_exponentials(q, i);
    q->form.field = nh_quotient_field_create(first + exponentials + 1, q->forms.max_terms);
    if (exponentials) relate_to_exponentials(q, first);
    nh_form_relate_signs(&q->form);
    roots = 0;
    for (int pass = 0; pass < 2; pass++) /* constants first: the others may turn out to be multiples of their roots */
        for (size_t i = 0; i < count; i++) {
            size_t kernel = k->order[i];
            if (q->constant[kernel] == (pass == 0) && relate_kernel(q, kernel, earlier, roots))
                earlier[roots++] = kernel;
        }
    nh_free(earlier);
    return nh_quotient_field_state_of(q->form.field) == NH_FIELD_FINE;
}

/* ---- coefficients as expressions ---- */

static nh_ex shortest(nh_dag *dag, size_t n, const nh_ex *candidate)
{
    size_t best = 0;
    for (size_t i = 1; i < n; i++)
        if (nh_complexity(dag, candidate[i]) < nh_complexity(dag, candidate[best])) best = i;
    return candidate[best];
}

static bool emit(question *q, const nh_quotient *value, nh_ex *out)
{
    nh_ex candidate[3];
    nh_pieces factored, whole;
    nh_arena *arena = nh_arena_create();
    const nh_kernels *k = &q->form.kernels;
    bool fits = nh_pieces_make(q->form.field, arena, value, false, &whole) &&
                nh_pieces_make(q->form.field, arena, value, true, &factored);
    if (fits) {
        candidate[0] = nh_print_quotient_product(k, &factored, false);
        candidate[1] = nh_print_quotient_product(k, &whole, true);
        candidate[2] = nh_print_quotient_terms(k, &whole);
        *out = shortest(q->dag, 3, candidate);
    }
    nh_arena_free(arena);
    return fits && nh_is_short(q->dag, *out);
}

static bool emit_all(question *q, nh_ex *coefficient)
{
    for (size_t j = 0; j < q->n; j++) {
        coefficient[j] = nh_int(q->dag, 0);
        if (q->c[j] && !nh_relation_question_emit(q, q->c[j], &coefficient[j])) return false;
    }
    return true;
}

/* ---- the whole ---- */

/* False when inexact numbers occur, or arise when arguments are made canonical. */
static bool rewrite_all(question *q, const nh_ex *e)
{
    for (size_t j = 0; j < q->n; j++) {
        q->e[j] = nh_form_rewrite(&q->forms, e[j]);
        if (!nh_is_short(q->dag, q->e[j])) return false;
    }
    return true;
}

/* value[j] = N_j, n of them, without denominators. */
static bool evaluate_all(question *q)
{
    nh_quotient_field *field = q->form.field;
    for (size_t j = 0; j < q->n; j++) {
        q->value[j] = nh_form_eval(&q->form, q->e[j]);
        if (nh_quotient_field_state_of(field) != NH_FIELD_FINE) return false;
    }
    return nh_relation_clear_denominators(field, q->n, q->value);
}

/* Reads, solves, and writes the coefficients as expressions. */
static nh_relation_verdict ask(question *q, const nh_ex *e, nh_ex *coefficient)
{
    if (!nh_relation_question_read(q, e)) return NH_RELATION_TOO_LARGE;
    nh_relation_system system = nh_relation_question_system(q);
    nh_relation_verdict verdict = nh_relation_solve(&system, q->c);
    if (verdict == NH_RELATION_UNIQUE && !emit_all(q, coefficient)) verdict = NH_RELATION_TOO_LARGE;
    return verdict;
}

void nh_relation_question_init(question *q, nh_dag *dag, size_t n, size_t parameters, const nh_ex *parameter,
                               size_t max_terms)
{
    *q = (question){.dag = dag, .n = n, .parameters = parameters, .parameter = parameter};
    nh_forms_init(&q->forms, dag, false, max_terms ? max_terms : default_terms);
    q->e = nh_alloc_array(n, sizeof *q->e);
    q->value = nh_alloc_array(n, sizeof *q->value);
    q->c = nh_alloc_array(n, sizeof *q->c);
}

bool nh_relation_question_read(question *q, const nh_ex *e)
{
    return rewrite_all(q, e) && collect_kernels(q) && evaluate_all(q);
}

nh_relation_system nh_relation_question_system(const question *q)
{
    return (nh_relation_system){.field = q->form.field, .constant = q->constant, .n = q->n, .value = q->value};
}

bool nh_relation_question_emit(question *q, const nh_quotient *value, nh_ex *out)
{
    /* most kernels are symbols */
    for (size_t i = 0; i < q->form.kernels.count; i++) q->form.kernels.item[i].length = 1;
    return emit(q, value, out);
}

void nh_relation_question_clear(question *q)
{
    nh_form_clear(&q->form);
    nh_forms_clear(&q->forms);
    nh_free(q->e);
    nh_free(q->constant);
    nh_free(q->value);
    nh_free(q->c);
}

static nh_relation_verdict find(nh_dag *dag, size_t n, const nh_ex *e, size_t parameters, const nh_ex *parameter,
                                size_t max_terms, bool exponentials, nh_ex *coefficient)
{
    question q;
    nh_relation_question_init(&q, dag, n, parameters, parameter, max_terms);
    q.exponentials = exponentials;
    nh_relation_verdict verdict = ask(&q, e, coefficient);
    nh_relation_question_clear(&q);
    return verdict;
}

static bool any_sine(const nh_dag *dag, size_t n, const nh_ex *e)
{
    NH_LIST(call);
    for (size_t j = 0; j < n; j++) {
        size_t count = nh_functions_in(dag, e[j], &call);
        for (size_t i = 0; i < count; i++)
            if (nh_function_of(dag, call[i]) == NH_SIN || nh_function_of(dag, call[i]) == NH_COS) return true;
    }
    return false;
}

nh_relation_verdict nh_relation_find(nh_dag *dag, size_t n, const nh_ex *e, size_t parameters, const nh_ex *parameter,
                                     size_t max_terms, nh_ex *coefficient)
{
    if (n == 0) return NH_RELATION_NONE;
    nh_relation_verdict verdict = NH_RELATION_TOO_LARGE;
    nh_ex *straight = nh_alloc_array(n, sizeof *straight);
    memcpy(straight, e, n * sizeof *straight);
    if (nh_straighten(dag, n, straight, parameters, parameter))
        verdict = find(dag, n, straight, parameters, parameter, max_terms, false, coefficient);
    nh_free(straight);
    if (verdict == NH_RELATION_TOO_LARGE)
        verdict = find(dag, n, e, parameters, parameter, max_terms, false, coefficient);
    if (verdict == NH_RELATION_TOO_LARGE && any_sine(dag, n, e))
        verdict = find(dag, n, e, parameters, parameter, max_terms, true, coefficient);
    return verdict;
}
