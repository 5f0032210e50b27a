/* Null vectors against products of currents, by their values. */
#include "search/search.h"

#include <math.h>
#include <string.h>

#include "graph/dag.h"
#include "search/counted.h"
#include "search/spans.h"

void nh_agreement_keep(nh_analysis *result, size_t families, const nh_family *family, const nh_ansatz *a,
                       const nh_nullspace *s, bool fields)
{
    nh_sampled_space *x = nh_arena_alloc(result->arena, sizeof *x);
    bool timely = false;
    double degree = nh_counted_degree(result->question->model, families, family, &timely);
    if (degree < 1 || degree > NH_COUNT_HIGHEST_DEGREE) return;
    *x = (nh_sampled_space){
        .degree = (size_t)degree, .timely = timely, .columns = a->columns, .dimension = s->dimension, .fields = fields};
    x->column = nh_arena_alloc(result->arena, (a->columns + 1) * sizeof *x->column);
    x->vector = nh_arena_alloc(result->arena, (a->columns * s->dimension + 1) * sizeof *x->vector);
    for (size_t j = 0; j < a->columns; j++) x->column[j] = nh_ansatz_column(a, j);
    memcpy(x->vector, s->vector, a->columns * s->dimension * sizeof *x->vector);
    result->sampled = x;
}

/* The products of degree at most this; 0: there are more than `most`. */
static size_t list_products(const nh_analysis *result, size_t n, const nh_ex *phi, const size_t *degree, size_t highest,
                            size_t most, nh_ex *out)
{
    nh_dag *d = result->question->model->dag;
    size_t count = 0, *sum = nh_alloc_array(most + 1, sizeof *sum);
    out[count++] = nh_int(d, 1);
    for (size_t k = 0; k < n && count; k++)
        /* the list grows: the powers of phi_k are products with it of earlier entries */
        for (size_t i = 0; i < count; i++) {
            if (!degree[k] || sum[i] + degree[k] > highest) continue;
            if (count == most) {
                nh_free(sum);
                return 0;
            }
            sum[count] = sum[i] + degree[k];
            out[count++] = nh_mul(d, out[i], phi[k]);
        }
    nh_free(sum);
    return count;
}

/* Do products of currents give as many integrals of this degree as there are? */
static const nh_completeness *complete_to(const nh_analysis *result, const nh_sampled_space *x)
{
    /* a system that depends on time is counted with time in the coefficients */
    bool in_time = x->timely || !result->completeness[NH_COMPLETE_IN_COORDINATES].counted;
    const nh_completeness *c = &result->completeness[in_time ? NH_COMPLETE_IN_TIME : NH_COMPLETE_IN_COORDINATES];
    bool everywhere = c->counted && !c->count.obstacle && !c->count.leaf && !c->regional && !c->count.where,
         complete = everywhere && x->degree <= c->count.rows && c->count.row[x->degree - 1].complete;
    return complete ? c : NULL;
}

void nh_agreement_find(nh_analysis *result)
{
    nh_model *model = result->question->model;
    enum { most = 400, spare = 64 };
    const nh_sampled_space *x = result->sampled;
    const nh_completeness *c = x && x->dimension ? complete_to(result, x) : NULL;
    if (!c) return;
    nh_error ignored;
    nh_error_clear(&ignored);
    bool general;
    size_t independent, room = result->list->count + result->list->furthers + 1,
                        *degree = nh_alloc_array(room, sizeof *degree);
    nh_ex *phi = nh_alloc_array(room, sizeof *phi), *product = nh_alloc_array(most + 1, sizeof *product);
    size_t n = nh_counted_proved(result, phi, &general, &independent), kept = 0;
    for (size_t k = 0; k < n; k++) {
        bool timely = false;
        double own = nh_counted_degree(model, 1, &(nh_family){.kind = NH_TERMS, .terms = 1, .term = &phi[k]}, &timely);
        if (own < 1 || own > (double)x->degree || (timely && !c->count.time)) continue;
        phi[kept] = phi[k];
        degree[kept++] = (size_t)own;
    }
    size_t products = list_products(result, kept, phi, degree, x->degree, most, product);
    nh_points *p = products ? nh_points_create(model, 2 * products + spare, 1,
                                               (uint64_t)result->question->options.seed + 7, &ignored)
                            : NULL;
    if (p) {
        double *one = nh_alloc_array(products * products, sizeof *one);
        for (size_t i = 0; i < products; i++) one[i * products + i] = 1;
        double *all = nh_span_values(model, p, products, product, products, one),
               *sampled = nh_span_values(model, p, x->columns, x->column, x->dimension, x->vector);
        result->counted_space =
            (nh_counted_space){.compared = true,
                               .fields = x->fields,
                               .degree = x->degree,
                               .products = products,
                               .angle = nh_span_distance(p->count, products, all, x->dimension, sampled)};
        result->counted_space.agrees = result->counted_space.angle <= result->question->options.agreement;
        if (!result->counted_space.agrees)
            nh_analysis_warn(
                result,
                "the sampled problem and the count of degree %zu disagree, angle %.1e: this is a bug, please report it",
                x->degree, result->counted_space.angle);
        nh_free(sampled);
        nh_free(all);
        nh_free(one);
    }
    nh_points_free(p);
    nh_free(product);
    nh_free(phi);
    nh_free(degree);
}
