#include "commands/analyze_known.h"

#include <math.h>

#include "base/progress.h"
#include "base/text.h"
#include "commands/verify_internal.h"
#include "graph/node.h"
#include "integrals/gradient_rank.h"
#include "search/currents.h"
#include "search/dependence.h"

enum { points_of_rank = 24, digits_of_a_number = 6 };

/* Is it a function of the currents found, or constant? */
static nh_independence beside_the_found(const nh_analysis *result, nh_ex phi)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_points *points = nh_points_create(result->question->model, points_of_rank, 1,
                                         (uint64_t)result->question->options.seed + 202, &ignored);
    if (!points) return NH_DOUBTFUL;
    nh_independence out = nh_currents_beside(result, points, phi, true, result->question->options.doubt);
    nh_points_free(points);
    return out;
}

/* The state, "x = 1, y = 2". */
static const char *state_in_words(const nh_analysis *result, const double *z)
{
    nh_model *model = result->question->model;
    nh_text text;
    nh_text_init(&text);
    for (size_t j = 0; j < model->width; j++)
        nh_text_addf(&text, "%s%s = %.6g", j ? ", " : "", nh_name_of(model->dag, model->chart->symbol[j]), z[j]);
    const char *out = nh_arena_strdup(result->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

static void refute(nh_analysis *result, nh_stated *s, const nh_verification *v)
{
    s->verdict = NH_STATED_FALSE;
    s->state = v->has_counterexample ? v->counterexample : NULL;
    s->rate = v->rate;
    if (s->denied) return;
    bool rounded = v->proof.digits >= digits_of_a_number;
    nh_analysis_warn(
        result, "the system file calls `%s` a current: it is none%s%s%s%s", s->name,
        s->state ? nh_arena_printf(result->arena, ", its rate is %.6g in the state ", s->rate) : "",
        s->state ? state_in_words(result, s->state) : "", s->state ? "" : ", its rate cancels to few digits",
        rounded ? nh_arena_printf(result->arena, "; its rate cancels to %.0f digits: are its numbers rounded?",
                                  floor(v->proof.digits))
                : "");
}

static void confirm(nh_analysis *result, nh_stated *s, const nh_verification *v)
{
    nh_independence kind = beside_the_found(result, v->current);
    s->proved = v->proof.proved;
    s->digits = v->proof.digits;
    s->region = v->region;
    s->verdict = kind == NH_CONSTANT    ? NH_STATED_CONSTANT
                 : !v->conserved        ? NH_STATED_REGIONAL
                 : kind == NH_DEPENDENT ? NH_STATED_FOUND
                                        : NH_STATED_MISSED;
    if (s->verdict == NH_STATED_FOUND) s->relation = nh_dependence_on_found(result, s->name, v->current);
    if (s->denied && v->conserved)
        nh_analysis_warn(result, "the system file says that `%s` is not conserved: it is%s", s->name,
                         s->proved ? ", proved" : "");
    else if (s->verdict == NH_STATED_CONSTANT && !s->denied)
        nh_analysis_warn(result, "the system file calls `%s` a current: it is a constant, whatever the motion is",
                         s->name);
}

static void judge(nh_analysis *result, nh_stated *s, nh_ex value)
{
    nh_error trouble;
    nh_error_clear(&trouble);
    nh_verification v = {.arena = result->arena, .system = result->question->system, .model = result->question->model};
    s->verdict = NH_STATED_OPEN;
    if (!nh_analysis_file_to_chart(result->question->model, value, &v.current, &trouble) ||
        !nh_verification_decide(&v, &result->question->options, &trouble))
        s->obstacle = nh_arena_printf(result->arena, "%s", trouble.what);
    else if (v.conserved || v.region) confirm(result, s, &v);
    else refute(result, s, &v);
}

void nh_analyze_known(nh_analysis *result)
{
    const nh_system *system = result->question->system;
    result->stated =
        nh_arena_alloc(result->arena, (system->currents + system->not_conserved + 1) * sizeof *result->stated);
    for (size_t k = 0; k < system->currents + system->not_conserved && !nh_interrupted(); k++) {
        const nh_named *it = k < system->currents ? &system->current[k] : &system->trap[k - system->currents];
        nh_stated s = {.name = it->name[0] ? it->name : it->text,
                       .text = it->text,
                       .out_of_reach = it->out_of_reach,
                       .denied = k >= system->currents};
        judge(result, &s, it->value);
        if (!nh_interrupted()) result->stated[result->stateds++] = s; /* else it is not decided */
    }
}
