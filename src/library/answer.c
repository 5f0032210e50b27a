#include "library/answer.h"

#include <math.h>
#include <string.h>

#include "base/foreign_memory.h"
#include "base/progress.h"
#include "document/html.h"
#include "document/unfinished.h"
#include "evaluate/machine.h"
#include "library/answer_internal.h"

const nh_answer_kind *nh_answer_kind_of(const char *command)
{
#define X(name)                                                                                                        \
    if (!strcmp(command, #name)) return &nh_answer_##name;
    NH_ANSWER_TABLE(X)
#undef X
    return NULL;
}

static nh_answer begun(const nh_answer_kind *kind, const nh_request *q)
{
    return (nh_answer){
        .kind = kind,
        .request = q,
        .run = {q->line, q->system_path, q->analysis_path, q->options.seed, q->options.shown, NAN, q->system_words}};
}

bool nh_answer_create(nh_answer *a, const nh_request *q, nh_error *error)
{
    *a = begun(nh_answer_kind_of(q->command), q);
    return a->kind->create(a, error);
}

void nh_answer_free(nh_answer *a) { a->kind->free(a); }

int nh_answer_code(bool partial, const nh_error *error)
{
    return nh_interrupted() ? (int)nh_ended_code() : partial ? NH_LIMIT : (int)error->code;
}

void nh_answer_cleanup(void)
{
    nh_machine_cleanup();
    nh_foreign_memory_end();
}

/* ---- a run that was ended before it had a result ---- */

/* Parts: what is known, in the arena of the request; the system. */
static void unfinished_free(nh_answer *a) { nh_system_free(a->part[1]); }

static void unfinished_write(const nh_answer *a, nh_pen_style style, nh_text *out)
{
    nh_unfinished_write(a->part[0], &a->run, style, out);
}

static char *unfinished_json(const nh_answer *a) { return nh_unfinished_json(a->part[0], &a->run); }

bool nh_answer_unfinished(nh_answer *a, const nh_request *q)
{
    static const nh_answer_kind kind = {.free = unfinished_free, .write = unfinished_write, .json = unfinished_json};
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_system *system = q->system_path ? nh_system_read(q->system_path, q->settings, q->setting, &ignored) : NULL;
    if (!system) return false;
    char doing[80], why[80];
    nh_progress_last(doing, sizeof doing);
    nh_ended_words(why, sizeof why);
    nh_unfinished *u = nh_arena_alloc(q->arena, sizeof *u);
    *u = (nh_unfinished){system, nh_arena_strdup(q->arena, doing), nh_arena_strdup(q->arena, why),
                         !strcmp(q->command, "analyze")};
    *a = begun(&kind, q);
    a->part[0] = u;
    a->part[1] = system;
    return true;
}

/* ---- figures ---- */

bool nh_answer_figure(const char **page, const char **figure, size_t *length)
{
    return (*figure = nh_html_next_figure(page, length)) != NULL;
}

bool nh_answer_is_figure(const char *text, size_t number) { return nh_html_is_figure(text, number); }
