/* The number of integrals at one value of the parameters, counted as for one system (count.h), at one point modulo
 * one prime: N of degree d is what the orders r = 1, 2, .. settle at, as an upper bound. The value is random (almost
 * all), a root of a polynomial modulo the prime, or infinite; a prime without such a root is passed over. */
#include <string.h>

#include "base/progress.h"
#include "classify/classify_internal.h"

enum { most_points = 60, steps_beyond = 1, first_beyond = 2, root_primes = 40 };

typedef nh_classify_search search;
typedef nh_classify_place place;

void nh_classify_open(search *s, const nh_model *model, const nh_classify_question *q)
{
    *s = (search){
        .model = model,
        .q = *q,
        .count = {.generic = true, .degree = q->degree, .work = q->work, .known = q->known, .current = q->current}};
    nh_parametric_open(&s->family, model, q->parameters, q->parameter, q->shape, q->linear, &s->count);
    s->family.held = nh_classify_free(s) == 1;
}

void nh_classify_hold(search *s, int v, int64_t top, int64_t bottom)
{
    s->q.top[v] = top;
    s->q.bottom[v] = bottom;
    s->family.held = nh_classify_free(s) == 1;
}

int nh_classify_free(const search *s)
{
    int count = 0;
    for (size_t k = 0; k < s->q.parameters; k++) count += s->q.bottom[k] == 0;
    return count;
}

/* ---- points ---- */

nh_prime nh_classify_prime(const search *s, size_t index)
{
    return nh_jet_point_prime(s->family.counter.equations->point, index);
}

/* Gives the parameters that are held the residues of their values; false: one has none. */
static bool hold_values(search *s, nh_prime f)
{
    bool good = true;
    for (size_t k = 0; k < s->q.parameters && good; k++)
        if (s->q.bottom[k]) good = nh_residue_ratio(f, s->q.top[k], s->q.bottom[k], &s->family.value[k]);
    return good;
}

nh_parametric_series *nh_classify_series(search *s, nh_prime f, uint64_t seed, size_t order)
{
    nh_parametric_series *x = NULL;
    bool regular = false;
    if (!hold_values(s, f)) return NULL;
    for (uint64_t attempt = 0; attempt < most_points && !regular && !s->family.obstacle && !nh_late(); attempt++)
        if (nh_parametric_choose(&s->family, f, seed + 1000 * attempt))
            x = nh_parametric_series_create(&s->family, order, &regular);
    return x;
}

/* ---- how many integrals at one value ---- */

/* Gives the parameters that vary residues modulo this prime at the place; false where it has none. */
static bool take_residues(search *s, const place *p, nh_prime f)
{
    uint64_t random = f.p;
    nh_residue at[NH_MOST_PARAMETERS];
    for (size_t k = 0; k < s->q.parameters; k++) at[k] = nh_residue_random(f, &random);
    if (p->on && !nh_special_point(p->on, f, f.p, at)) return false;
    for (size_t k = 0; k < s->q.parameters; k++)
        if (!s->q.bottom[k]) s->family.value[k] = at[k];
    return true;
}

/* N for each order. */
static bool totals(search *s, const nh_parametric_series *x, const nh_residue *values, size_t degree, size_t *total,
                   nh_classify_number *out)
{
    nh_parametric *f = &s->family;
    size_t order = x->ring->order, from = 0, n = f->counter.equations->n;
    bool good = true;
    uint64_t random = 31337;
    nh_differentials d = {.n = n, .kept = x->ring->variables, .w = nh_alloc_array(n + 1, sizeof(nh_residue))};
    for (size_t i = 0; i < n; i++) d.w[i] = nh_residue_random(x->ring->field, &random);
    memset(total, 0, (order + 1) * sizeof *total);
    for (int part = 0; part < (x->split ? 2 : 1) && good; part++) {
        nh_graded_problem p = nh_parametric_problem(f, x, values, degree,
                                                    !x->split ? NH_ALL_DEGREES
                                                    : part    ? NH_ODD_DEGREES
                                                              : NH_EVEN_DEGREES);
        nh_graded_count *g = nh_graded_solve(&p);
        good = g->solved;
        if (!g->injective) from = SIZE_MAX;
        else if (from < g->injective_at) from = g->injective_at;
        f->counter.work += g->work;
        for (size_t k = 0; k <= order; k++) total[k] += g->total[k];
        if (good) nh_count_solutions_differ(g, x->ring->field, &d);
        nh_graded_count_clear(g);
    }
    size_t same = order, step = nh_parametric_step(f);
    while (same > 0 && total[same - 1] == total[order]) same--;
    bool bounded = good && from <= order;
    if (bounded && same < from) same = from;
    *out = (nh_classify_number){.bound = total[order],
                                .order = order,
                                .rank = nh_count_rank(&d, x->ring->field),
                                .counted = good,
                                .bounded = bounded,
                                .settled = bounded && order - same >= step + steps_beyond};
    nh_free(d.row);
    nh_free(d.w);
    return good;
}

/* P at one value, for series of one order. */
static bool dimension_at(search *s, nh_prime f, size_t level, size_t order, const place *p, nh_residue lambda,
                         size_t *out)
{
    nh_parametric_series *x = nh_classify_series(s, f, 7 + level, order);
    if (!x) return false;
    nh_residue *values = nh_alloc_array(x->length, sizeof *values);
    nh_parametric_at(x, lambda, p->infinite, values);
    bool good =
        nh_parametric_linear_dimension(&s->family, x, values, level, s->count.work - s->family.counter.work, out);
    nh_free(values);
    nh_parametric_series_free(x);
    return good;
}

/* P for growing orders.  Brackets of length k take effect one order above k. */
static void dimension(search *s, nh_prime f, size_t level, const place *p, nh_residue lambda, size_t least,
                      nh_classify_number *out)
{
    const nh_linear_family *l = s->q.linear;
    size_t seen = l->low + l->step + 1, number;
    for (size_t order = l->low + 1, same = 0; !nh_late(); order++) {
        if (!dimension_at(s, f, level, order, p, lambda, &number)) break;
        same = out->bounded && number == out->bound ? same + 1 : 0;
        *out = (nh_classify_number){.bound = number,
                                    .order = order,
                                    .counted = true,
                                    .bounded = true,
                                    .settled = same >= steps_beyond && order > seen};
        if (number == least || out->settled) break;
    }
    out->settled |= out->bounded && out->bound == 0;
}

/* The first prime modulo which the values, and those of the other parameters, have residues, where the equations have
 * no roots. */
static bool prime_of(search *s, const place *p, nh_prime *f, nh_residue *lambda)
{
    const nh_jet_point *point = s->family.counter.equations->point;
    bool roots = point->pieces > 0;
    for (size_t k = 0; k < point->kernels; k++) roots |= point->kernel[k].kind == NH_JET_ROOT;
    for (size_t i = 0; i < (roots ? 1 : 2) * (size_t)root_primes; i++) {
        *f = i < root_primes ? nh_classify_prime(s, i) : nh_prime_with_units(i - root_primes);
        if (!take_residues(s, p, *f)) continue;
        *lambda = s->family.value[0];
        return true;
    }
    return false;
}

bool nh_classify_singular(search *s, const place *p)
{
    nh_prime f;
    nh_residue lambda;
    return prime_of(s, p, &f, &lambda) && hold_values(s, f) && nh_parametric_singular(&s->family, f);
}

bool nh_classify_count(search *s, size_t degree, const place *p, size_t least, size_t *known, nh_classify_number *out)
{
    size_t step = 1;
    nh_prime f;
    nh_residue lambda;
    bool held = s->family.held;
    *out = (nh_classify_number){0};
    if (!prime_of(s, p, &f, &lambda)) return false;
    s->family.held = true;
    s->family.counter.work = 0;
    if (s->q.linear) {
        if (known) least = *known = s->q.linear->known;
        dimension(s, f, degree, p, lambda, least, out);
        s->family.held = held;
        return out->bounded;
    }
    for (size_t order = degree + first_beyond; s->family.counter.work < s->count.work && !nh_late();
         order += step + 1) {
        nh_parametric_series *x = nh_classify_series(s, f, 7 + degree, order);
        if (!x) break;
        if (step != nh_parametric_step(&s->family)) { /* the order is known only now */
            step = nh_parametric_step(&s->family);
            order = degree * step - step + first_beyond - 1;
            nh_parametric_series_free(x);
            continue;
        }
        size_t *total = nh_alloc_array(order + 1, sizeof *total);
        nh_residue *values = nh_alloc_array(x->length, sizeof *values);
        nh_count_row row = {0};
        nh_classify_number number;
        nh_parametric_at(x, lambda, p->infinite, values);
        bool good = totals(s, x, values, degree, total, &number);
        if (good && known && nh_count_products(&s->family.counter, x->ring, x->coordinate, degree, SIZE_MAX, &row))
            least = *known = row.known;
        nh_free(values);
        nh_free(total);
        nh_parametric_series_free(x);
        if (!good) break;
        *out = number;
        if (number.bounded && (number.bound == least || number.settled)) break;
    }
    s->family.held = held;
    return out->bounded;
}
