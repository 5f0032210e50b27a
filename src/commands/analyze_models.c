#include "commands/analyze_models.h"

#include "geometry/distribution.h"
#include "integrals/points.h"
#include "motion/dynamics.h"
#include "problem/time_scale.h"

static nh_model *model_of(const nh_analysis *result, nh_chart_choice choice, nh_error *error)
{
    return nh_model_create(result->system,
                           nh_chart_create(result->system, choice, (uint64_t)result->options.seed, error), error);
}

/* An initial state on the other branch of a quadratic constraint chooses that branch. */
static bool turn_to_initial(nh_analysis *result, nh_chart_choice choice, const nh_request *q, nh_error *error)
{
    if (!result->analysis || !nh_analysis_file_resolve(result->analysis, result->model, error))
        return !result->analysis;
    if (!result->analysis->has_initial || !nh_dynamics_other_branch(result->model, &result->analysis->initial))
        return true;
    result->system->branch = -result->model->chart->branch;
    nh_model_free(result->model);
    nh_analysis_file_free(result->analysis);
    result->model = NULL;
    result->analysis = nh_analysis_file_read(q->analysis_path, error);
    if (result->analysis) result->model = model_of(result, choice, error);
    return result->model && nh_analysis_file_resolve(result->analysis, result->model, error);
}

/* A system that moves much faster than its units suggest is sampled and followed on its own time scale. */
static bool set_pace(nh_analysis *result, nh_chart_choice choice, nh_error *error)
{
    double Omega = nh_time_scale_set(result->system, result->model);
    if (Omega == 1) return true;
    nh_model_free(result->model);
    result->model = model_of(result, choice, error);
    result->pace = Omega;
    nh_analysis_warn(result,
                     "the forces act within %.1e units of time: without `domain:`, the samples of t extend to this "
                     "time, and the velocities are scaled with it",
                     1 / Omega);
    return result->model != NULL;
}

static bool can_be_sampled(const nh_analysis *result)
{
    enum { few = 64, one_in = 20 };
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_points *points = nh_points_create(result->model, few, 1, (uint64_t)result->options.seed, &ignored);
    bool good = points && points->tried <= one_in * few;
    nh_points_free(points);
    return good;
}

/* A constraint such as x'^2 + y'^2 = c^2 says how large velocities are: without `domain:` others are tried where the
 * usual ones hardly ever fulfil it. */
static bool set_speeds(nh_analysis *result, nh_chart_choice choice, nh_error *error)
{
    static const double factors[] = {0.25, 4, 0.03, 30, 1e-3, 1e3};
    size_t given = result->system->intervals;
    if (!result->system->constraints || can_be_sampled(result)) return true;
    for (size_t i = 0; i < sizeof factors / sizeof *factors; i++) {
        result->system->intervals = given;
        if (!nh_time_scale_velocities(result->system, result->model, factors[i])) return true;
        nh_error ignored;
        nh_error_clear(&ignored);
        nh_model *other = model_of(result, choice, &ignored);
        if (!other) continue;
        nh_model_free(result->model);
        result->model = other;
        if (!can_be_sampled(result)) continue;
        nh_analysis_warn(result,
                         "the constraints have hardly any solutions with velocities of the usual size: without "
                         "`domain:`, those of the samples are %g times as large",
                         factors[i]);
        return true;
    }
    result->system->intervals = given;
    nh_model_free(result->model);
    result->model = model_of(result, choice, error);
    return result->model != NULL;
}

bool nh_analyze_models(nh_analysis *result, const nh_request *q, nh_error *error)
{
    nh_chart_choice choice = q->chart != NH_CHART_AUTO || !result->analysis ? q->chart : result->analysis->chart;
    result->model = model_of(result, choice, error);
    bool sized = result->model && set_pace(result, choice, error) && set_speeds(result, choice, error);
    if (!sized || !turn_to_initial(result, choice, q, error)) return false;
    if (result->model->chart->replaced)
        nh_analysis_warn(result,
                         "the constraints barely determine the dependent velocities of the system file on the sampling "
                         "domain (pivots below %g): the program uses the chart %s instead",
                         nh_chart_least_pivot, result->model->chart->name);
    nh_error ignored;
    nh_error_clear(&ignored);
    /* beside angular velocities the coordinates of an orientation have no velocities worth printing */
    if (result->model->chart->quasi && result->system->constraints && !result->system->orientations)
        result->other = model_of(result, NH_CHART_COORDINATES, &ignored);
    if (ignored.code != NH_OK) nh_analysis_warn(result, "the chart of coordinate velocities: %s", ignored.what);
    result->local_maximum = 2 * result->model->m - result->model->k;
    result->constraint = nh_distribution_of(result->model);
    return true;
}
