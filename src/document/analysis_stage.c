#include "document/analysis_stage.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "document/analysis_answer.h"
#include "document/current_words.h"
#include "document/live.h"

enum { room = 24 }; /* characters, for the names of parameters */

/* The tracks of the analysis, then the multipliers: the lines of its time series. */
static const nh_observables *with_multipliers(const nh_analysis *r)
{
    nh_observables *t = nh_arena_alloc(r->arena, sizeof *t);
    *t = r->tracks;
    t->track = nh_arena_alloc(r->arena, (t->count + r->model->k + 1) * sizeof *t->track);
    memcpy(t->track, r->tracks.track, t->count * sizeof *t->track);
    for (size_t a = 0; a < r->model->k; a++)
        t->track[t->count++] =
            (nh_track){nh_arena_printf(r->arena, "c%zu", a + 1), NH_TRACK_MULTIPLIER, r->model->mu[a]};
    return t;
}

/* Without the sign of equality, or the full stop, at its end. */
static const char *without_end(nh_arena *arena, const char *text, const char *end)
{
    size_t n = strlen(text);
    while (n && strchr(end, text[n - 1])) n--;
    return nh_arena_strndup(arena, text, n);
}

static const char *joined(nh_arena *arena, const char *a, const char *b)
{
    return nh_arena_printf(arena, "%s%s%s", a, *b ? " " : "", b);
}

/* "for all m, k", and under which conditions; many names are not told. */
static const char *brief_proof(const nh_analysis *r, const nh_current *f)
{
    static const char *const conditions[] = {" with ", ", real where "};
    static const char all[] = " for all ";
    const char *sure = nh_analysis_answer_proof(r, f), *rest = sure + strlen(sure);
    for (size_t i = 0; i < sizeof conditions / sizeof *conditions; i++) {
        const char *at = strstr(sure, conditions[i]);
        if (at && at < rest) rest = at;
    }
    bool listed = f->proof.all_parameters && !strncmp(sure, all, sizeof all - 1);
    if (!listed || (size_t)(rest - sure) <= room) return sure;
    return nh_arena_printf(r->arena, "for all parameter values%s", rest);
}

static nh_stage_row row_of(const nh_analysis *r, const nh_current *f)
{
    nh_current_words words = nh_current_words_of(r, f, true, NULL);
    const char *sure = brief_proof(r, f);
    nh_stage_row row = {.name = joined(r->arena, words.name, words.of),
                        .doc = f->independence == NH_DEPENDENT ? "follows from the others" : words.doc,
                        .from = joined(r->arena, words.how, words.what),
                        .sure = *sure == ' ' ? sure + 1 : sure,
                        .anchor = nh_arena_printf(r->arena, "q-%s", f->name),
                        .label = without_end(r->arena, nh_current_label(r, f), "= "),
                        .value = nh_analysis_answer_shown(r, f),
                        .proved = f->proof.proved,
                        .series = f->series != NULL,
                        .drift = f->drift.drift[NH_DRIFT_RUNS - 1]};
    return row;
}

nh_stage *nh_analysis_stage(const nh_analysis *r, const nh_run *run)
{
    const nh_validation *v = r->validation;
    if (!v || v->count < 2) return NULL;
    nh_stage *s = nh_arena_alloc(r->arena, sizeof *s);
    nh_stage_row *row = nh_arena_alloc(r->arena, (r->count + 1) * sizeof *row);
    for (size_t k = 0; k < r->count; k++) row[k] = row_of(r, &r->found[k]);
    const nh_observables *tracks = with_multipliers(r);
    *s = (nh_stage){.series = nh_time_series_of_analysis(r),
                    .tracks = tracks,
                    .live = nh_live_of_analysis(r, tracks),
                    .command = nh_live_command(r->arena, run, r->system),
                    .rows = r->count,
                    .row = row};
    return s;
}
