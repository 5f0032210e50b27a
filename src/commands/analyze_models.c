#include "commands/analyze_models.h"

#include "geometry/distribution.h"
#include "integrals/points.h"
#include "motion/dynamics.h"
#include "problem/time_scale.h"

static nh_model *model_of(const nh_analysis_question *question, nh_chart_choice choice, nh_error *error)
{
    return nh_model_create(question->system,
                           nh_chart_create(question->system, choice, (uint64_t)question->options.seed, error), error);
}

/* An initial state on the other branch of a quadratic constraint chooses that branch. */
static bool turn_to_initial(nh_analysis_question *question, nh_chart_choice choice, const nh_request *q,
                            nh_error *error)
{
    if (!question->analysis || !nh_analysis_file_resolve(question->analysis, question->model, error))
        return !question->analysis;
    if (!question->analysis->has_initial || !nh_dynamics_other_branch(question->model, &question->analysis->initial))
        return true;
    question->system->branch = -question->model->chart->branch;
    nh_model_free(question->model);
    nh_analysis_file_free(question->analysis);
    question->model = NULL;
    question->analysis = nh_analysis_file_read(q->analysis_path, error);
    if (question->analysis) question->model = model_of(question, choice, error);
    return question->model && nh_analysis_file_resolve(question->analysis, question->model, error);
}

/* A system that moves much faster than its units suggest is sampled and followed on its own time scale. */
static bool set_pace(nh_analysis *result, nh_analysis_question *question, nh_chart_choice choice, nh_error *error)
{
    double Omega = nh_time_scale_set(question->system, question->model);
    if (Omega == 1) return true;
    nh_model_free(question->model);
    question->model = model_of(question, choice, error);
    question->pace = Omega;
    nh_analysis_warn(result,
                     "the forces act within %.1e units of time: without `domain:`, the samples of t extend to this "
                     "time, and the velocities are scaled with it",
                     1 / Omega);
    return question->model != NULL;
}

static bool can_be_sampled(const nh_analysis_question *question)
{
    enum { few = 64, one_in = 20 };
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_points *points = nh_points_create(question->model, few, 1, (uint64_t)question->options.seed, &ignored);
    bool good = points && points->tried <= one_in * few;
    nh_points_free(points);
    return good;
}

/* A constraint such as x'^2 + y'^2 = c^2 says how large velocities are: without `domain:` others are tried where the
 * usual ones hardly ever fulfil it. */
static bool set_speeds(nh_analysis *result, nh_analysis_question *question, nh_chart_choice choice, nh_error *error)
{
    static const double factors[] = {0.25, 4, 0.03, 30, 1e-3, 1e3};
    size_t given = question->system->intervals;
    if (!question->system->constraints || can_be_sampled(question)) return true;
    for (size_t i = 0; i < sizeof factors / sizeof *factors; i++) {
        question->system->intervals = given;
        if (!nh_time_scale_velocities(question->system, question->model, factors[i])) return true;
        nh_error ignored;
        nh_error_clear(&ignored);
        nh_model *other = model_of(question, choice, &ignored);
        if (!other) continue;
        nh_model_free(question->model);
        question->model = other;
        if (!can_be_sampled(question)) continue;
        nh_analysis_warn(result,
                         "the constraints have hardly any solutions with velocities of the usual size: without "
                         "`domain:`, those of the samples are %g times as large",
                         factors[i]);
        return true;
    }
    question->system->intervals = given;
    nh_model_free(question->model);
    question->model = model_of(question, choice, error);
    return question->model != NULL;
}

bool nh_analyze_models(nh_analysis *result, nh_analysis_question *question, const nh_request *q, nh_error *error)
{
    nh_chart_choice choice = q->chart != NH_CHART_AUTO || !question->analysis ? q->chart : question->analysis->chart;
    question->model = model_of(question, choice, error);
    bool sized =
        question->model && set_pace(result, question, choice, error) && set_speeds(result, question, choice, error);
    if (!sized || !turn_to_initial(question, choice, q, error)) return false;
    if (question->model->chart->replaced)
        nh_analysis_warn(result,
                         "the constraints barely determine the dependent velocities of the system file on the sampling "
                         "domain (pivots below %g): the program uses the chart %s instead",
                         nh_chart_least_pivot, question->model->chart->name);
    nh_error ignored;
    nh_error_clear(&ignored);
    /* beside angular velocities the coordinates of an orientation have no velocities worth printing */
    if (question->model->chart->quasi && question->system->constraints && !question->system->orientations)
        question->other = model_of(question, NH_CHART_COORDINATES, &ignored);
    if (ignored.code != NH_OK) nh_analysis_warn(result, "the chart of coordinate velocities: %s", ignored.what);
    question->local_maximum = 2 * question->model->m - question->model->k;
    question->constraint = nh_distribution_of(question->model);
    return true;
}
