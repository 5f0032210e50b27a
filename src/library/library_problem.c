/* library_problem: contexts and problems of the public interface.  A problem is a question whose names and numbers have
   been read. */
#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "base/text.h"
#include "exact/normal.h"
#include "library/library_internal.h"
#include "problem/places.h"

const char *nh_version_text(void) { return NH_VERSION; }

/* ---- contexts ---- */

void nh_context_on_progress(nh_context *context, void (*tell)(void *, const char *, double), void *data)
{
    nh_context *before = nh_context_enter(context);
    nh_progress_set(tell, data);
    nh_context_enter(before);
}

void nh_context_interrupt(nh_context *context) { nh_interrupt_context(context); }

void nh_problem_enter(nh_problem *p)
{
    p->before = nh_context_enter(p->context);
    nh_files_swap(&p->files);
    nh_files_begin();
    nh_interrupt_clear();
    nh_limit_set(p->limited ? p->options.max_seconds : INFINITY); /* as on the command line */
    nh_limit_memory_set(p->options.max_memory * NH_MEGABYTE);
}

void nh_problem_leave(nh_problem *p)
{
    nh_limit_set(INFINITY);
    nh_limit_memory_set(0);
    nh_files_swap(&p->files);
    nh_context_enter(p->before);
}

/* ---- questions ---- */

static const char *copied(nh_arena *arena, const char *text) { return text ? nh_arena_strdup(arena, text) : NULL; }

static nh_question copy_of(nh_arena *arena, const nh_question *q)
{
    nh_question c = *q;
    c.system = copied(arena, q->system);
    c.system_text = copied(arena, q->system_text);
    c.analysis = copied(arena, q->analysis);
    c.analysis_text = copied(arena, q->analysis_text);
    c.set = copied(arena, q->set);
    c.velocities = copied(arena, q->velocities);
    c.initial = copied(arena, q->initial);
    c.watch = copied(arena, q->watch);
    c.method = copied(arena, q->method);
    c.options = copied(arena, q->options);
    return c;
}

/* The next "name = value" of a list with commas or semicolons between; false at its end, or with a message where there
   is none. */
static bool next_pair(nh_arena *arena, const char **at, const char *what, const char **name, const char **value,
                      nh_error *error)
{
    static const char blank[] = " \t\n";
    *at += strspn(*at, " \t\n,;");
    if (!**at) return false;
    size_t length = strcspn(*at, ",;"), equal = strcspn(*at, "=");
    if (equal == 0 || equal >= length)
        return nh_fail(error, NH_USAGE, "", "%s: expected name=value, found `%.*s`", what, (int)length, *at);
    size_t end = equal, begin = equal + 1, last = length;
    while (end && strchr(blank, (*at)[end - 1])) end--;
    while (begin < last && strchr(blank, (*at)[begin])) begin++;
    while (last > begin && strchr(blank, (*at)[last - 1])) last--;
    *name = nh_arena_strndup(arena, *at, end);
    *value = nh_arena_strndup(arena, *at + begin, last - begin);
    *at += length;
    return true;
}

static bool read_parameters(nh_problem *p, nh_error *error)
{
    const char *at = p->question.set, *name, *value;
    p->setting = nh_arena_alloc(p->arena, (at ? strlen(at) : 1) * sizeof *p->setting);
    while (at && next_pair(p->arena, &at, "set", &name, &value, error)) {
        double x;
        if (!nh_text_to_number(value, &x))
            return nh_fail(error, NH_USAGE, "", "set: `%s` needs a number, found `%s`", name, value);
        p->setting[p->settings++] = (nh_setting){.name = name, .value = x};
    }
    return error->code == NH_OK;
}

static bool read_options(nh_problem *p, nh_error *error)
{
    const char *at = p->question.options, *name, *value;
    nh_options_default(&p->options);
    while (at && next_pair(p->arena, &at, "options", &name, &value, error)) {
        if (!nh_options_set(&p->options, name, value, error)) return false;
        p->limited |= !strcmp(name, "max_seconds");
        p->seed_given |= !strcmp(name, "seed");
        p->samples_given |= !strcmp(name, "samples");
        p->tolerance_given |= !strcmp(name, "tolerance");
    }
    if (p->question.until > 0) p->options.until = p->question.until;
    return error->code == NH_OK;
}

static bool read_velocities(nh_problem *p, nh_error *error)
{
    static const char *const names[] = {"auto", "quasi", "coordinates"};
    const char *given = p->question.velocities;
    for (int i = 0; i < 3; i++) {
        if (given && strcmp(given, names[i])) continue;
        p->chart = (nh_chart_choice)i;
        return true;
    }
    nh_fail(error, NH_USAGE, "", "there are no velocities `%s`", given);
    return nh_error_hint(error, "velocities takes auto, quasi or coordinates");
}

/* The name of a text or the path of a file, of a system or an analysis; the text is from then on what that name stands
   for. */
static const char *source(nh_problem *p, const char *kind, const char *name, const char *text, nh_error *error)
{
    if (!text) return name ? nh_places_find(p->arena, kind, name, error) : NULL;
    if (!name) name = strcmp(kind, "systems") ? "analysis" : "system";
    nh_files_add(name, text, strlen(text));
    return name;
}

static bool open_problem(nh_problem *p, nh_error *error)
{
    const nh_question *q = &p->question;
    if (!q->system && !q->system_text) {
        nh_fail(error, NH_USAGE, "", "the question names no system");
        return nh_error_hint(error, "give a name, a path, or the text of a system file");
    }
    if (!read_parameters(p, error) || !read_velocities(p, error) ||
        (q->method && !nh_method_given(q->method, &p->method, error)))
        return false;
    p->system_path = source(p, "systems", q->system, q->system_text, error);
    if (!p->system_path) return false;
    bool named = !q->system_text && !nh_places_is_path(q->system);
    if (q->no_analysis) p->analysis_path = NULL;
    else if (q->analysis || q->analysis_text)
        p->analysis_path = source(p, "analyses", q->analysis, q->analysis_text, error);
    else if (named) p->analysis_path = nh_places_look(p->arena, "analyses", q->system);
    if (error->code != NH_OK) return false;
    p->system = nh_system_read(p->system_path, p->settings, p->setting, error);
    return p->system != NULL;
}

nh_problem *nh_problem_open(nh_context *context, const nh_question *question, nh_error *error)
{
    nh_error ignored;
    nh_error *told = error ? error : &ignored;
    nh_error_clear(told);
    nh_arena   *arena = nh_arena_create();
    nh_problem *p = nh_arena_alloc(arena, sizeof *p);
    *p = (nh_problem){.context = context, .arena = arena, .question = copy_of(arena, question)};
    bool good = read_options(p, told);
    nh_problem_enter(p);
    good = good && open_problem(p, told);
    nh_problem_leave(p);
    if (good) return p;
    nh_problem_free(p);
    return NULL;
}

void nh_problem_free(nh_problem *p)
{
    if (!p) return;
    nh_system_free(p->system);
    nh_files_free(p->files);
    nh_arena_free(p->arena);
    nh_normal_cleanup(); /* FLINT keeps memory for each thread */
}

const char *nh_problem_name(const nh_problem *p) { return p->system->name; }

size_t nh_problem_coordinates(const nh_problem *p) { return p->system->coordinates; }

const char *nh_problem_coordinate(const nh_problem *p, size_t i)
{
    return i < p->system->coordinates ? p->system->coordinate[i].name : NULL;
}

size_t nh_problem_parameters(const nh_problem *p) { return p->system->parameters; }

const char *nh_problem_parameter(const nh_problem *p, size_t i, double *value)
{
    if (i >= p->system->parameters) return NULL;
    if (value) *value = p->system->parameter[i].value;
    return p->system->parameter[i].name;
}
