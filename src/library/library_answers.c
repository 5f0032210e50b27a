/* library_answers: the commands of the public interface, and what they found as documents. */
#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "commands/analyze.h"
#include "commands/benchmark.h"
#include "commands/classify.h"
#include "commands/reduce.h"
#include "commands/simulate.h"
#include "commands/verify.h"
#include "document/analysis_json.h"
#include "document/benchmark.h"
#include "document/classification.h"
#include "document/analysis_outline.h"
#include "document/reduction.h"
#include "document/simulation.h"
#include "document/verification.h"
#include "library/library_internal.h"

/* ---- commands ---- */

nh_analysis *nh_analyze(nh_problem *p, nh_error *error)
{
    nh_analyze_request request = {.system_path = p->system_path,
                                  .analysis_path = p->analysis_path,
                                  .settings = p->settings,
                                  .setting = p->setting,
                                  .chart = p->chart,
                                  .options = p->options,
                                  .accuracy = p->question.accuracy,
                                  .seed_given = p->seed_given,
                                  .samples_given = p->samples_given,
                                  .tolerance_given = p->tolerance_given,
                                  .until_given = p->question.until > 0};
    nh_error_clear(error);
    nh_problem_enter(p);
    nh_analysis *a = nh_analysis_create(&request, error);
    nh_problem_leave(p);
    return a;
}

static nh_simulate_request motion_of(const nh_problem *p)
{
    return (nh_simulate_request){.system_path = p->system_path,
                                 .analysis_path = p->analysis_path,
                                 .settings = p->settings,
                                 .setting = p->setting,
                                 .chart = p->chart,
                                 .initial = p->question.initial,
                                 .from = "initial",
                                 .watch = p->question.watch,
                                 .step = p->question.step,
                                 .accuracy = p->question.accuracy,
                                 .method = p->method,
                                 .tolerance_given = p->tolerance_given,
                                 .until_given = p->question.until > 0,
                                 .options = p->options};
}

nh_simulation *nh_simulate(nh_problem *p, nh_error *error) { return nh_simulate_zeros(p, NULL, NULL, error); }

nh_simulation *nh_simulate_zeros(nh_problem *p, const char *events, const char *section, nh_error *error)
{
    nh_simulate_request request = motion_of(p);
    request.event = events;
    request.section = section;
    nh_error_clear(error);
    nh_problem_enter(p);
    nh_simulation *s = nh_simulation_create(&request, error);
    nh_problem_leave(p);
    return s;
}

nh_reduction *nh_reduce(nh_problem *p, nh_error *error)
{
    nh_reduce_request request = {.system_path = p->system_path,
                                 .settings = p->settings,
                                 .setting = p->setting,
                                 .chart = p->chart,
                                 .initial = p->question.initial,
                                 .accuracy = p->question.accuracy,
                                 .options = p->options};
    nh_error_clear(error);
    nh_problem_enter(p);
    nh_reduction *r = nh_reduction_create(&request, error);
    nh_problem_leave(p);
    return r;
}

static nh_verification *verify(nh_problem *p, const char *current, const char *field, nh_error *error)
{
    nh_error_clear(error);
    nh_problem_enter(p);
    nh_system *system = nh_system_read(p->system_path, p->settings, p->setting, error); /* the verification's own */
    nh_verification *v = !system   ? NULL
                         : current ? nh_verification_of_current(system, p->chart, current, &p->options, error)
                                   : nh_verification_of_field(system, p->chart, field, &p->options, error);
    nh_problem_leave(p);
    return v;
}

nh_verification *nh_verify_current(nh_problem *p, const char *current, nh_error *error)
{
    return verify(p, current, NULL, error);
}

nh_verification *nh_verify_field(nh_problem *p, const char *field, nh_error *error)
{
    return verify(p, NULL, field, error);
}

bool nh_verification_holds(const nh_verification *v) { return v->conserved; }

bool nh_verification_proved(const nh_verification *v) { return v->proof.proved; }

nh_classified *nh_classify_over(nh_problem *p, const char *parameter, bool shape, nh_error *error)
{
    nh_classify_request request = {.system_path = p->system_path, .settings = p->settings, .setting = p->setting,
                                   .over = parameter, .shape = shape, .options = p->options};
    nh_error_clear(error);
    nh_problem_enter(p);
    nh_classified *c = nh_classify_system(&request, error);
    nh_problem_leave(p);
    return c;
}

nh_benchmark *nh_benchmark_methods(nh_problem *p, double seconds, nh_error *error)
{
    static const double usual = 5; /* seconds, as on the command line */
    nh_simulate_request request = motion_of(p);
    nh_error_clear(error);
    nh_problem_enter(p);
    nh_benchmark *b = nh_benchmark_run(&request, seconds > 0 ? seconds : usual, error);
    nh_problem_leave(p);
    return b;
}

/* ---- documents ---- */

static const double shown = 600; /* symbols of the longest formula on a page, as by default */

static char *taken(nh_text *text)
{
    char *out = nh_strdup(nh_text_string(text));
    nh_text_clear(text);
    return out;
}

static nh_run run_of(double seed) { return (nh_run){.seed = seed, .shown = shown, .seconds = NAN}; }

static nh_pen_style style_of(nh_format format)
{
    nh_pen_form form = format == NH_FORMAT_HTML ? NH_PEN_PAGE : format == NH_FORMAT_LATEX ? NH_PEN_LATEX : NH_PEN_TEXT;
    return (nh_pen_style){.form = form, .verbose = form == NH_PEN_TEXT};
}

/* Every format exists: the error stays as it is. */
char *nh_analysis_document(const nh_analysis *a, nh_format format, nh_error *error)
{
    nh_text text;
    nh_text_init(&text);
    (void)error;
    if (format == NH_FORMAT_JSON) return nh_analysis_json(a);
    nh_analysis_write(a, style_of(format), &text);
    return taken(&text);
}

char *nh_simulation_document(const nh_simulation *s, nh_format format, nh_error *error)
{
    nh_run  run = run_of(1);
    nh_text text;
    nh_text_init(&text);
    (void)error;
    if (format == NH_FORMAT_JSON) return nh_motion_json(s, &run);
    if (format == NH_FORMAT_TEXT) nh_motion_csv(s, &text);
    else nh_simulation_write(s, &run, style_of(format), &text);
    return taken(&text);
}

char *nh_reduction_document(const nh_reduction *r, nh_format format, nh_error *error)
{
    nh_run  run = run_of(r->options.seed);
    nh_text text;
    nh_text_init(&text);
    (void)error;
    if (format == NH_FORMAT_JSON) return nh_reduction_json(r, &run);
    if (format == NH_FORMAT_LATEX) nh_reduction_latex(r, &text);
    else nh_reduction_write(r, &run, style_of(format), &text);
    return taken(&text);
}

char *nh_verification_document(const nh_verification *v, nh_format format, nh_error *error)
{
    nh_run  run = run_of(1);
    nh_text text;
    nh_text_init(&text);
    (void)error;
    if (format == NH_FORMAT_JSON) return nh_verification_json(v, &run);
    nh_verification_write(v, &run, style_of(format), &text);
    return taken(&text);
}

char *nh_classified_document(const nh_classified *c, nh_format format, nh_error *error)
{
    nh_run  run = run_of(1);
    nh_text text;
    nh_text_init(&text);
    (void)error;
    if (format == NH_FORMAT_JSON) return nh_classification_json(c, &run);
    nh_classification_write(c, NULL, NULL, &run, style_of(format), &text);
    return taken(&text);
}

char *nh_benchmark_document(const nh_benchmark *b, nh_format format, nh_error *error)
{
    nh_run  run = run_of(1);
    nh_text text;
    nh_text_init(&text);
    (void)error;
    if (format == NH_FORMAT_JSON) return nh_benchmark_json(b, NULL, &run);
    nh_benchmark_write(b, NULL, &run, style_of(format), &text);
    return taken(&text);
}

void nh_string_free(char *string) { nh_free(string); }
