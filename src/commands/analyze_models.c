#include "commands/analyze_models.h"

#include "geometry/distribution.h"
#include "integrals/points.h"
#include "motion/dynamics.h"
#include "problem/time_scale.h"

static nh_model *model_of(const nh_analysis *r, nh_chart_choice choice, nh_error *error)
{
    return nh_model_create(r->system, nh_chart_create(r->system, choice, (uint64_t)r->options.seed, error), error);
}

/* An initial state on the other branch of a quadratic constraint chooses that branch. */
static bool turn_to_initial(nh_analysis *r, nh_chart_choice choice, const nh_request *q, nh_error *error)
{
    if (!r->analysis || !nh_analysis_file_resolve(r->analysis, r->model, error)) return !r->analysis;
    if (!r->analysis->has_initial || !nh_dynamics_other_branch(r->model, &r->analysis->initial)) return true;
    r->system->branch = -r->model->chart->branch;
    nh_model_free(r->model);
    nh_analysis_file_free(r->analysis);
    r->model = NULL;
    r->analysis = nh_analysis_file_read(q->analysis_path, error);
    if (r->analysis) r->model = model_of(r, choice, error);
    return r->model && nh_analysis_file_resolve(r->analysis, r->model, error);
}

/* A system that moves much faster than its units suggest is sampled and followed on its own time scale. */
static bool set_pace(nh_analysis *r, nh_chart_choice choice, nh_error *error)
{
    double Omega = nh_time_scale_set(r->system, r->model);
    if (Omega == 1) return true;
    nh_model_free(r->model);
    r->model = model_of(r, choice, error);
    r->pace = Omega;
    nh_analysis_warn(r,
                     "the forces act within %.1e units of time: without `domain:`, the samples of t extend to this "
                     "time, and the velocities are scaled with it",
                     1 / Omega);
    return r->model != NULL;
}

static bool can_be_sampled(const nh_analysis *r)
{
    enum { few = 64, one_in = 20 };
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_points *points = nh_points_create(r->model, few, 1, (uint64_t)r->options.seed, &ignored);
    bool good = points && points->tried <= one_in * few;
    nh_points_free(points);
    return good;
}

/* A constraint such as x'^2 + y'^2 = c^2 says how large velocities are: without `domain:` others are tried where the
 * usual ones hardly ever fulfil it. */
static bool set_speeds(nh_analysis *r, nh_chart_choice choice, nh_error *error)
{
    static const double factors[] = {0.25, 4, 0.03, 30, 1e-3, 1e3};
    size_t given = r->system->intervals;
    if (!r->system->constraints || can_be_sampled(r)) return true;
    for (size_t i = 0; i < sizeof factors / sizeof *factors; i++) {
        r->system->intervals = given;
        if (!nh_time_scale_velocities(r->system, r->model, factors[i])) return true;
        nh_error ignored;
        nh_error_clear(&ignored);
        nh_model *other = model_of(r, choice, &ignored);
        if (!other) continue;
        nh_model_free(r->model);
        r->model = other;
        if (!can_be_sampled(r)) continue;
        nh_analysis_warn(r,
                         "the constraints have hardly any solutions with velocities of the usual size: without "
                         "`domain:`, those of the samples are %g times as large",
                         factors[i]);
        return true;
    }
    r->system->intervals = given;
    nh_model_free(r->model);
    r->model = model_of(r, choice, error);
    return r->model != NULL;
}

bool nh_analyze_models(nh_analysis *r, const nh_request *q, nh_error *error)
{
    nh_chart_choice choice = q->chart != NH_CHART_AUTO || !r->analysis ? q->chart : r->analysis->chart;
    r->model = model_of(r, choice, error);
    bool sized = r->model && set_pace(r, choice, error) && set_speeds(r, choice, error);
    if (!sized || !turn_to_initial(r, choice, q, error)) return false;
    if (r->model->chart->replaced)
        nh_analysis_warn(r,
                         "the constraints barely determine the dependent velocities of the system file on the sampling "
                         "domain (pivots below %g): the program uses the chart %s instead",
                         nh_chart_least_pivot, r->model->chart->name);
    nh_error ignored;
    nh_error_clear(&ignored);
    /* beside angular velocities the coordinates of an orientation have no velocities worth printing */
    if (r->model->chart->quasi && r->system->constraints && !r->system->orientations)
        r->other = model_of(r, NH_CHART_COORDINATES, &ignored);
    if (ignored.code != NH_OK) nh_analysis_warn(r, "the chart of coordinate velocities: %s", ignored.what);
    r->local_maximum = 2 * r->model->m - r->model->k;
    r->constraint = nh_distribution_of(r->model);
    return true;
}
