/* currents_region: currents that hold for a part of the motions only. */
#include <math.h>

#include "count/one_side.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "integrals/continued.h"
#include "search/counted.h"
#include "search/currents.h"

static nh_region region_of(nh_current_checker *checker, nh_ex phi, double digits)
{
    nh_analysis *result = checker->result;
    if (!checker->searched)
        checker->terrain = nh_terrain_of(result->question->model, &result->question->options, result->arena);
    checker->searched = true;
    return nh_region_of(result->question->model, &checker->terrain, phi, digits, &result->question->options,
                        result->arena);
}

const char *nh_currents_region(nh_current_checker *checker, nh_ex phi, double digits, bool *to_the_end)
{
    nh_region region = region_of(checker, phi, digits);
    if (to_the_end) *to_the_end = nh_region_to_the_end(&region);
    return nh_region_text(checker->result->question->model->dag, &region, checker->result->arena);
}

/* e with |u| and sign(u) as on the side of the wall u = 0 on which the region lies. */
static nh_ex on_its_side(nh_dag *d, const nh_region *region, nh_ex e)
{
    nh_ex from[4 * NH_MOST_WALLS], to[4 * NH_MOST_WALLS];
    size_t n = 0;
    for (size_t i = 0; i < region->count; i++) {
        if (region->kind[i] != NH_REGION_ABOVE && region->kind[i] != NH_REGION_BELOW) continue;
        for (int side = -1; side <= 1; side += 2) {
            int sign = (region->kind[i] == NH_REGION_ABOVE ? 1 : -1) * side;
            nh_ex u = nh_mul(d, nh_int(d, side), region->wall[i]);
            from[n] = nh_call(d, NH_ABS, u);
            to[n++] = nh_mul(d, nh_int(d, sign), u);
            from[n] = nh_call(d, NH_SIGN, u);
            to[n++] = nh_int(d, sign);
        }
    }
    return nh_substitute(d, e, n, from, to);
}

const char *nh_currents_hold(nh_current_checker *checker, nh_current *f)
{
    const nh_model *model = checker->result->question->model;
    const nh_options *options = &checker->result->question->options;
    bool everywhere = f->proof.proved && !f->proof.sided;
    /* a formula that cancels to fewer digits as printed cannot be required to do better */
    nh_region region = region_of(checker, f->phi,
                                 everywhere ? 0 : fmax(NH_LEAST_ALMOST, fmin(f->printed_digits, options->digits) / 2));
    if (f->proof.sided && region.count) region = nh_region_of_pairs(model);
    if (region.count && !f->proof.proved) {
        size_t n = 1 + model->m + model->n;
        nh_ex *term = nh_alloc_array(n, sizeof *term);
        nh_rate_terms(model, f->phi, term);
        for (size_t j = 0; j < n; j++) term[j] = on_its_side(model->dag, &region, term[j]);
        nh_proof proof = nh_prove_zero(model, n, term, f->exact, options);
        if (proof.proved) f->proof = proof;
        nh_free(term);
    }
    f->to_the_end = nh_region_to_the_end(&region);
    f->counted = nh_one_side_within(model, &region);
    return nh_region_text(model->dag, &region, checker->result->arena);
}

/* Can the same current be written so that it passes through its walls?  Then it must be proved again, and hold
 * everywhere; perhaps for more parameter values, because it has no roots and arctangents whose branches must agree. */
static bool goes_through(nh_current_checker *checker, nh_current *f, nh_ex phi)
{
    nh_model *model = checker->result->question->model;
    nh_claim claim = {.free = f->exact, .fixed = f->proof.fixed};
    if (phi == f->phi) return false;
    nh_proof proof = nh_prove_claim(model, phi, claim, &checker->result->question->options);
    if (!proof.proved || nh_currents_region(checker, phi, 0, NULL)) return false;
    f->phi = nh_simplify_short(model->dag, phi, 0);
    f->proof = proof;
    return true;
}

bool nh_currents_continue(nh_current_checker *checker, nh_current *f)
{
    nh_model *model = checker->result->question->model;
    if (!f->proof.proved) return false;
    if (goes_through(checker, f,
                     nh_continued_roots(model, f->phi, (uint64_t)checker->result->question->options.seed)) ||
        goes_through(checker, f, nh_continued_arctangents(model, f->phi)))
        return true;
    /* a polynomial in the velocities, such as the energy in a potential atan(y/x), is counted as one */
    return isinf(nh_counted_degree_of(model, f->phi)) && goes_through(checker, f, nh_continued_turns(model, f->phi));
}
