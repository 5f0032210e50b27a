#include "exact/parameter_zeros.h"

#include <string.h>

#include "exact/kernel.h"
#include "exact/normal.h"
#include "exact/print_quotient.h"
#include "exact/relation_internal.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "graph/num.h"

enum { most_polynomials = 12 };

nh_ex nh_parameter_zeros_polynomial(nh_dag *dag, nh_ex e)
{
    for (int turn = 0; turn < 2; turn++) {
        if (nh_kind_of(dag, e) == NH_PRODUCT) e = nh_mul(dag, nh_number(dag, nh_num_inv(nh_constant_of(dag, e))), e);
        if (turn == 0) e = nh_simplify(dag, e);
    }
    return e;
}

typedef struct {
    nh_arena *arena;
    nh_relation_question question;
    nh_parameter_zeros *out;
} work;

static nh_ex product_of(work *w, const nh_pieces *pieces)
{
    const nh_kernels *k = &w->question.form.kernels;
    return nh_simplify(w->question.dag, nh_print_quotient_product(k, pieces, false));
}

static void add_way(work *w, size_t count, const nh_ex *polynomial)
{
    nh_parameter_zeros *v = w->out;
    nh_parameter_zeros_way *way = nh_arena_alloc(w->arena, (v->ways + 1) * sizeof *way);
    if (v->ways) memcpy(way, v->way, v->ways * sizeof *way);
    way[v->ways] =
        (nh_parameter_zeros_way){.count = count, .polynomial = nh_arena_alloc(w->arena, (count + 1) * sizeof(nh_ex))};
    if (count) memcpy(way[v->ways++].polynomial, polynomial, count * sizeof *polynomial);
    v->way = way;
}

static bool same_variables(const work *w, const nh_pieces *p, const nh_factor *f, size_t a, size_t b)
{
    for (size_t g = 0; g < p->generators; g++)
        if (!w->question.constant[g] && f->exponent[a * p->generators + g] != f->exponent[b * p->generators + g])
            return false;
    return true;
}

/* The coefficient of the monomial that term `first` has, as an expression. */
static nh_ex coefficient(work *w, const nh_pieces *p, const nh_factor *f, size_t first)
{
    size_t n = p->generators;
    nh_factor part = {.power = 1,
                      .coefficient = nh_arena_alloc(w->arena, (f->terms + 1) * sizeof *part.coefficient),
                      .exponent = nh_arena_alloc(w->arena, (f->terms * n + 1) * sizeof *part.exponent)};
    int64_t *none = nh_arena_alloc(w->arena, (n + 1) * sizeof *none);
    memset(none, 0, n * sizeof *none);
    for (size_t i = first; i < f->terms; i++) {
        if (!same_variables(w, p, f, first, i)) continue;
        part.coefficient[part.terms] = f->coefficient[i];
        for (size_t g = 0; g < n; g++)
            part.exponent[part.terms * n + g] = w->question.constant[g] ? f->exponent[i * n + g] : 0;
        part.terms++;
    }
    nh_pieces all = {
        .generators = n, .factors = 1, .constant = (nh_num){.p = 1, .q = 1}, .exponent = none, .factor = &part};
    return product_of(w, &all);
}

/* One factor: the coefficients of its monomials; it vanishes nowhere where one of them is a number. */
static bool add_factor(work *w, const nh_pieces *p, const nh_factor *f)
{
    nh_ex polynomial[most_polynomials];
    size_t count = 0;
    for (size_t i = 0; i < f->terms; i++) {
        bool seen = false;
        for (size_t j = 0; j < i && !seen; j++) seen = same_variables(w, p, f, i, j);
        if (seen) continue;
        nh_ex e = nh_parameter_zeros_polynomial(w->question.dag, coefficient(w, p, f, i));
        if (nh_kind_of(w->question.dag, e) == NH_NUMBER) return true;
        for (size_t j = 0; j < count && !seen; j++)
            seen = polynomial[j] == e || polynomial[j] == nh_neg(w->question.dag, e);
        if (seen) continue;
        if (count == most_polynomials) return false;
        polynomial[count++] = e;
    }
    add_way(w, count, polynomial);
    return true;
}

/* A power of one constant kernel: another way. */
static void add_monomial(work *w, const nh_pieces *p)
{
    for (size_t g = 0; g < p->generators; g++) {
        if (!w->question.constant[g] || p->exponent[g] <= 0) continue;
        nh_ex kernel = nh_kernel_power(&w->question.form.kernels, g, 1);
        add_way(w, 1, &kernel);
    }
}

static bool find(work *w, nh_ex e)
{
    nh_pieces pieces;
    if (!nh_relation_question_read(&w->question, &e)) return false;
    for (size_t i = 0; i < w->question.form.kernels.count; i++) w->question.form.kernels.item[i].length = 1;
    const nh_quotient *value = w->question.value[0];
    if (nh_quotient_is_zero(w->question.form.field, value)) {
        add_way(w, 0, NULL);
        w->out->ways = 1;
        return true;
    }
    bool good = nh_pieces_make(w->question.form.field, w->arena, value, true, &pieces);
    if (good) add_monomial(w, &pieces);
    for (size_t j = 0; j < pieces.factors && good; j++)
        if (pieces.factor[j].power > 0) good = add_factor(w, &pieces, &pieces.factor[j]);
    return good;
}

bool nh_parameter_zeros_find(nh_arena *arena, nh_dag *dag, nh_ex e, size_t parameters, const nh_ex *parameter,
                             nh_parameter_zeros *out)
{
    enum { most_terms = 4000 };
    work w = {.arena = arena, .out = out};
    *out = (nh_parameter_zeros){0};
    nh_relation_question_init(&w.question, dag, 1, parameters, parameter, most_terms);
    bool good = find(&w, e);
    nh_relation_question_clear(&w.question);
    return good;
}

/* Is it nonzero for all positive values of its symbols: a sum of monomials in these with coefficients of one sign? */
static bool of_one_sign(nh_dag *dag, nh_ex e)
{
    enum { most_terms = 4000 };
    nh_forms forms;
    nh_form form;
    nh_pieces pieces;
    nh_arena *arena = nh_arena_create();
    nh_forms_init(&forms, dag, false, most_terms);
    bool good = nh_form_make(&forms, e, true, &form) == NH_FIELD_FINE &&
                nh_pieces_make(form.field, arena, form.value, false, &pieces);
    for (size_t g = 0; g < form.kernels.count && good; g++) good = form.kernels.item[g].kind == NH_KERNEL_PLAIN;
    for (size_t j = 0; good && j < pieces.factors; j++)
        for (size_t i = 1; i < pieces.factor[j].terms && good; i++)
            good = nh_num_value(pieces.factor[j].coefficient[i]) * nh_num_value(pieces.factor[j].coefficient[0]) > 0;
    nh_form_clear(&form);
    nh_forms_clear(&forms);
    nh_arena_free(arena);
    return good;
}

bool nh_parameter_zeros_may_be_positive(nh_dag *dag, const nh_parameter_zeros *zeros)
{
    for (size_t i = 0; i < zeros->ways; i++) {
        bool never = false;
        for (size_t k = 0; k < zeros->way[i].count && !never; k++)
            never = of_one_sign(dag, zeros->way[i].polynomial[k]);
        if (!never) return true;
    }
    return false;
}
