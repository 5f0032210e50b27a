/* counted: is a stage worth its time?
 *
 *     degree of the ansatz in the velocities -> count of that degree (count/count.h) -> nothing new: leave it out
 *
 * Answers are kept: `covered` up to a degree, `open` while the number of independent currents stays, `beyond` for
 * what cannot be counted. [docs/method.md, sec. 10] */
#include "search/counted.h"

#include <math.h>
#include <string.h>

#include "base/parallel.h"
#include "base/progress.h"
#include "exact/walls.h"
#include "graph/diff.h"
#include "graph/node.h"
#include "graph/num.h"

static const double no_degree = INFINITY; /* not polynomial in the velocities */

/* ---- degrees ---- */

bool nh_counted_has_velocities(const nh_model *model, nh_ex e)
{
    bool has = false;
    for (size_t i = 0; i < model->n && !has; i++) has = nh_depends(model->dag, e, model->chart->w[i]);
    return has;
}

/* 0 without velocities, 1 of a velocity; of a sum the largest, of a product the sum of degree times power; else
 * infinite. */
double nh_counted_degree_of(const nh_model *model, nh_ex e)
{
    nh_dag *d = model->dag;
    double degree = 0;
    if (!nh_counted_has_velocities(model, e)) return 0;
    if (nh_kind_of(d, e) == NH_SYMBOL) return 1;
    if (nh_kind_of(d, e) != NH_SUM && nh_kind_of(d, e) != NH_PRODUCT) return no_degree;
    for (size_t k = 0; k < nh_arity(d, e); k++) {
        double own = nh_counted_degree_of(model, nh_child(d, e, k));
        if (nh_kind_of(d, e) == NH_SUM) {
            degree = fmax(degree, own);
            continue;
        }
        nh_ex exponent = nh_exponent_of(d, e, k);
        nh_num n = nh_kind_of(d, exponent) == NH_NUMBER ? nh_number_of(d, exponent) : nh_num_int(-1);
        bool whole = nh_num_short(n) && n.q == 1 && n.p > 0;
        if (own > 0) degree += whole ? own * (double)n.p : no_degree;
    }
    return degree;
}

static double highest(const nh_model *model, size_t count, const nh_ex *e)
{
    double degree = 0;
    for (size_t i = 0; i < count && degree < no_degree; i++) degree = fmax(degree, nh_counted_degree_of(model, e[i]));
    return degree;
}

static bool depends_on_time(const nh_model *model, size_t count, const nh_ex *e)
{
    bool depends = false;
    for (size_t i = 0; i < count && !depends; i++) depends = nh_depends(model->dag, e[i], model->system->t);
    return depends;
}

/* A product of functions of the velocities that are none, such as a wave in them, has no degree. */
static double degree_of_family(const nh_model *model, const nh_family *f, bool *timely)
{
    double degree = 0, own;
    *timely |= depends_on_time(model, f->in_count, f->in) || depends_on_time(model, f->terms, f->term);
    switch (f->kind) {
    case NH_TERMS: return highest(model, f->terms, f->term);
    case NH_POLYNOMIAL: return highest(model, f->in_count, f->in) * (double)f->degree;
    case NH_FAMILY_PRODUCT:
        for (size_t i = 0; i < f->parts; i++) degree += degree_of_family(model, &f->part[i], timely);
        return degree;
    default: own = highest(model, f->in_count, f->in); return own > 0 ? no_degree : 0;
    }
}

double nh_counted_degree(const nh_model *model, size_t families, const nh_family *family, bool *timely)
{
    double degree = 0;
    for (size_t i = 0; i < families; i++) degree = fmax(degree, degree_of_family(model, &family[i], timely));
    return degree;
}

/* ---- the count ---- */

size_t nh_counted_proved(const nh_analysis *result, nh_ex *phi, bool *general, size_t *independent)
{
    const nh_current_list *list = result->list;
    size_t n = 0;
    *general = true;
    *independent = 0;
    for (size_t k = 0; k < list->furthers; k++) {
        phi[n++] = list->further[k].current.phi;
        *general &= list->further[k].current.proof.all_parameters;
    }
    for (size_t k = 0; k < list->count; k++) {
        if (!list->found[k].proof.proved || list->found[k].series) continue;
        phi[n++] = list->found[k].phi;
        *general &= list->found[k].proof.all_parameters;
        *independent += list->found[k].independence == NH_INDEPENDENT;
    }
    return n;
}

size_t nh_counted_regional(const nh_analysis *result, nh_ex *phi, bool *general)
{
    const nh_current_list *list = result->list;
    size_t n = 0;
    *general = true;
    for (size_t k = 0; k < list->pieces; k++) {
        if (!list->piece[k].proof.proved || list->piece[k].series || !list->piece[k].counted) continue;
        phi[n++] = list->piece[k].phi;
        *general &= list->piece[k].proof.all_parameters;
    }
    return n;
}

bool nh_counted_has_walls(const nh_model *model)
{
    nh_ex *e = nh_arena_alloc(model->arena, (model->m + model->n) * sizeof *e), wall[NH_MOST_WALLS];
    memcpy(e, model->rho, model->m * sizeof *e);
    memcpy(e + model->m, model->a, model->n * sizeof *e);
    return nh_walls_between(model->dag, model->m + model->n, e, model->width, model->chart->symbol, wall) > 0;
}

typedef enum { NOTHING, SOMETHING, UNKNOWN } news;

/* On leaves of integrable constraints not all functions are counted, and across a kink or a jump of the equations
   others are conserved on either side. */
static news look_for_news(nh_counted *x, size_t degree, size_t kind)
{
    nh_analysis *r = x->r;
    bool general;
    if (nh_counted_has_walls(r->question->model)) return UNKNOWN;
    nh_ex *phi = nh_alloc_array(r->list->count + r->list->furthers + 1, sizeof *phi);
    nh_count_question q = {.time = kind == NH_COMPLETE_IN_TIME,
                           .alone = true,
                           .degree = degree,
                           .work = r->question->options.count_work,
                           .memory = r->counted,
                           .threads = nh_threads(r->question->options.threads),
                           .current = phi};
    q.known = nh_counted_proved(r, phi, &general, &q.independent);
    nh_count c = nh_count_integrals(r->question->model, &q);
    nh_free(phi);
    if (c.obstacle || !c.rows || c.leaf || c.time != q.time) return UNKNOWN;
    return c.row[0].functions ? NOTHING : SOMETHING;
}

/* Beyond a few coordinates the count takes longer than the stages that it may spare. */
static bool is_cheap(const nh_analysis *result)
{
    enum { few_coordinates = 5 };
    return result->counted && result->question->model->m <= few_coordinates;
}

bool nh_counted_covers(nh_counted *x, size_t degree, bool timely)
{
    const nh_analysis *r = x->r;
    size_t kind = timely ? NH_COMPLETE_IN_TIME : NH_COMPLETE_IN_COORDINATES;
    if (!x->on || !is_cheap(r) || degree < 1 || degree > nh_completeness_degree(r->question->model, timely))
        return false;
    for (size_t k = kind; k < NH_COMPLETENESS_KINDS; k++)
        if (degree <= x->covered[k]) return true;
    if ((x->open[kind] && degree >= x->open[kind] && x->open_at[kind] == r->list->independent) ||
        (x->beyond[kind] && degree >= x->beyond[kind]))
        return false;
    news found = nh_late() ? UNKNOWN : look_for_news(x, degree, kind);
    if (found == NOTHING) x->covered[kind] = degree;
    if (found == UNKNOWN) x->beyond[kind] = degree;
    if (found == SOMETHING) x->open[kind] = degree, x->open_at[kind] = r->list->independent;
    return found == NOTHING;
}

bool nh_counted_superfluous(nh_counted *x, size_t families, const nh_family *family, bool timely)
{
    if (!x->on || !is_cheap(x->r)) return false;
    double degree = nh_counted_degree(x->r->question->model, families, family, &timely);
    return degree <= NH_COUNT_HIGHEST_DEGREE && nh_counted_covers(x, degree < 1 ? 1 : (size_t)degree, timely);
}
