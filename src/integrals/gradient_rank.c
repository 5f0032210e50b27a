/* gradient_rank: the rank of n + 1 gradients by elimination in balls, at a few exact points.
 *
 * What is left of the last one excludes 0 at one point: it is independent, which is a proof for the given parameters.
 * At three points it is 0 to 30 digits: dependent. [docs/method.md, sec. 5, "Independence"] */
#include "integrals/gradient_rank.h"

#include <math.h>

#include "exact/ball_matrix.h"
#include "graph/diff.h"
#include "exact/normal.h"
#include "integrals/exact_points.h"

enum { bits = 320, wanted = 3, most_tries = 12, digits_of_nothing = 30, own_seed = 909 };

/* The rank does not depend on the scale, but the remaining parts do: half widths of the sampling box. */
static nh_ex *gradients(const nh_model *model, size_t n, const nh_ex *phi, size_t width, double *scale, bool *exact)
{
    nh_ex *e = nh_alloc_array(n * width + 1, sizeof *e);
    for (size_t k = 0; k < n; k++) {
        *exact = *exact && nh_is_exact(model->dag, phi[k]);
        for (size_t j = 0; j < width; j++) e[k * width + j] = nh_diff(model->dag, phi[k], model->chart->symbol[j]);
    }
    for (size_t j = 0; j < width; j++) scale[j] = (model->chart->high[j] - model->chart->low[j]) / 2;
    return e;
}

nh_rank nh_rank_decide(const nh_model *model, size_t n, const nh_ex *phi, double doubt)
{
    size_t width = 1 + model->m + model->n, points = 0;
    double *scale = nh_alloc_array(width, sizeof *scale), digits = INFINITY;
    uint64_t state = own_seed;
    bool exact = true;
    nh_ex *e = gradients(model, n + 1, phi, width, scale, &exact);
    nh_ball *ball = nh_ball_create(model->dag, bits);
    nh_rank out = {.answer = NH_RANK_UNDECIDED};
    nh_exact_parameters(model, ball);
    for (int tries = 0; tries < most_tries && points < wanted && out.answer != NH_RANK_GROWS; tries++) {
        double lower, upper;
        if (!nh_exact_point(model, ball, &state) || !nh_ball_rank_left(ball, n + 1, width, e, scale, &lower, &upper))
            continue;
        points++;
        digits = fmin(digits, -upper);
        if (exact ? isfinite(lower) : lower > log10(doubt)) out = (nh_rank){.answer = NH_RANK_GROWS, .proved = exact};
    }
    bool nothing = points == wanted && digits >= (exact ? digits_of_nothing : -log10(doubt));
    if (out.answer != NH_RANK_GROWS && nothing) out = (nh_rank){.answer = NH_RANK_STAYS, .digits = digits};
    nh_ball_free(ball);
    nh_free(e);
    nh_free(scale);
    return out;
}
