/* library_problem: contexts and problems of the public interface.  A problem is a question whose names and numbers have
   been read. */
#include <math.h>
#include <pthread.h>
#include <string.h>

#include "base/foreign_memory.h"
#include "base/progress.h"
#include "base/recovery.h"
#include "base/text.h"
#include "library/catalogue.h"
#include "library/library_internal.h"

const char *nh_version_text(void) { return NH_VERSION; }

/* ---- contexts ---- */

void nh_context_on_progress(nh_context *context, void (*tell)(void *, const char *, double), void *data)
{
    nh_context *before = nh_context_enter(context);
    nh_progress_set(tell, data);
    nh_context_enter(before);
}

void nh_context_interrupt(nh_context *context) { nh_interrupt_context(context); }

static void enter(nh_problem *p)
{
    p->before = nh_context_enter(p->context);
    nh_files_swap(&p->files);
    nh_files_begin();
    nh_interrupt_clear();
    nh_limit_set(p->request.limited ? p->request.options.max_seconds : INFINITY);
    nh_limit_memory_set(p->request.options.max_memory * NH_MEGABYTE);
}

static void leave(nh_problem *p)
{
    nh_limit_set(INFINITY);
    nh_limit_memory_set(0);
    nh_files_swap(&p->files);
    nh_context_enter(p->before);
}

/* ---- without memory ---- */

typedef struct {
    nh_problem *problem;
    void (*job)(void *);
    void *data;
    bool done;
} task;

static void do_task(void *argument)
{
    task *t = argument;
    if (t->problem) enter(t->problem);
    t->done = nh_recovery_run(t->job, t->data);
    if (t->problem) leave(t->problem);
}

static void *do_apart(void *argument) { return do_task(argument), NULL; }

static bool run(task t)
{
    pthread_t apart;
    if (!nh_recovery_lost()) do_task(&t);
    else if (!pthread_create(&apart, NULL, do_apart, &t)) pthread_join(apart, NULL);
    return t.done;
}

static bool try(task t, nh_error *error)
{
    nh_error_clear(error);
    if (run(t)) return true;
    nh_error_clear(error);
    nh_fail(error, NH_LIMIT, "", "out of memory");
    return nh_error_hint(error, "ask for less (a lower degree, fewer motions or times), or give memory back");
}

bool nh_library_run(void (*job)(void *), void *data) { return run((task){NULL, job, data, false}); }

bool nh_library_try(void (*job)(void *), void *data, nh_error *error)
{
    return try((task){NULL, job, data, false}, error);
}

bool nh_problem_run(nh_problem *p, void (*job)(void *), void *data, nh_error *error)
{
    return try((task){p, job, data, false}, error);
}

/* ---- systems ---- */

static void list_systems(void *argument)
{
    char **out = argument;
    nh_text text;
    nh_error none;
    nh_text_init(&text);
    nh_error_clear(&none);
    nh_catalogue_systems(NULL, &text, &none);
    *out = nh_strdup(nh_text_string(&text));
    nh_text_clear(&text);
}

char *nh_systems(nh_error *error)
{
    NH_OWN_ERROR(error);
    char *out = NULL;
    return nh_library_try(list_systems, &out, error) ? out : NULL;
}

/* ---- questions ---- */

static const char *copied(nh_arena *arena, const char *text) { return text ? nh_arena_strdup(arena, text) : NULL; }

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

static bool read_parameters(nh_request *r, const char *set, nh_error *error)
{
    const char *name, *value;
    while (set && next_pair(r->arena, &set, "set", &name, &value, error)) {
        double x;
        if (!nh_request_number(value, &x)) {
            nh_fail(error, NH_USAGE, "", "set: `%s` needs a number, found `%s`", name, value);
            return nh_error_hint_number(error, value);
        }
        nh_request_setting(r, (nh_setting){.name = name, .value = x});
    }
    return error->code == NH_OK;
}

static bool read_options(nh_request *r, const nh_question *q, nh_error *error)
{
    const char *at = q->options, *name, *value;
    nh_options_default(&r->options);
    while (at && next_pair(r->arena, &at, "options", &name, &value, error))
        if (!nh_request_option(r, name, value, error)) return false;
    if (q->until > 0) r->until_given = true, r->options.until = q->until;
    return error->code == NH_OK;
}

/* From now on the name stands for this text. */
static const char *named_text(nh_arena *arena, const char *name, const char *usual, const char *text)
{
    name = nh_arena_strdup(arena, name ? name : usual);
    nh_files_add(name, text, strlen(text));
    return name;
}

static bool find_files(nh_request *r, const nh_question *q, nh_error *error)
{
    if (q->system_text) r->system_path = named_text(r->arena, q->system, "system", q->system_text);
    else if (!nh_request_system(r, q->system, error)) return false;
    if (q->no_analysis) return true;
    if (q->analysis_text) r->analysis_path = named_text(r->arena, q->analysis, "analysis", q->analysis_text);
    else if (q->analysis) return nh_request_analysis(r, q->analysis, error);
    else if (!q->system_text) nh_request_usual_analysis(r, q->system);
    return true;
}

static bool open_problem(nh_problem *p, const nh_question *q, nh_error *error)
{
    nh_request *r = &p->request;
    if (!q->system && !q->system_text) {
        nh_fail(error, NH_USAGE, "", "the question names no system");
        return nh_error_hint(error, "give a name, a path, or the text of a system file");
    }
    if (!read_parameters(r, q->set, error) || (q->velocities && !nh_request_velocities(r, q->velocities, error)) ||
        (q->method && !nh_request_method(r, q->method, error)) || !find_files(r, q, error))
        return false;
    p->system = nh_system_read(r->system_path, r->settings, r->setting, error);
    return p->system != NULL;
}

typedef struct {
    nh_context *context;
    const nh_question *question;
    nh_error *error;
    nh_problem *problem;
    bool good;
} opening;

static void begin_problem(void *argument)
{
    opening *o = argument;
    const nh_question *q = o->question;
    nh_arena *arena = nh_arena_create();
    nh_problem *p = nh_arena_alloc(arena, sizeof *p);
    *p = (nh_problem){.context = o->context, .arena = arena};
    p->request = (nh_request){.arena = arena,
                              .initial = copied(arena, q->initial),
                              .from = "initial",
                              .watch = copied(arena, q->watch),
                              .step = q->step,
                              .accuracy = q->accuracy,
                              .project = q->project};
    o->good = read_options(&p->request, q, o->error);
    o->problem = p;
}

static void read_problem(void *argument)
{
    opening *o = argument;
    o->good = open_problem(o->problem, o->question, o->error);
}

nh_problem *nh_problem_open(nh_context *context, const nh_question *question, nh_error *error)
{
    NH_OWN_ERROR(error);
    nh_error ignored;
    opening o = {.context = context, .question = question, .error = error ? error : &ignored};
    if (nh_library_try(begin_problem, &o, o.error) && o.good && nh_problem_run(o.problem, read_problem, &o, o.error) &&
        o.good)
        return o.problem;
    nh_problem_free(o.problem);
    return NULL;
}

void nh_problem_free(nh_problem *p)
{
    if (!p) return;
    nh_system_free(p->system);
    nh_files_free(p->files);
    nh_arena_free(p->arena);
    if (!nh_recovery_lost()) nh_foreign_memory_end(); /* FLINT keeps memory for each thread */
}

typedef struct {
    nh_problem *problem;
    const char *parameter, *input;
    nh_error *error;
    bool good;
} driving;

static void drive(void *argument)
{
    driving *d = argument;
    nh_problem *p = d->problem;
    nh_request *r = &p->request;
    const nh_setting *before = r->setting;
    const char *words = r->system_words;
    size_t count = r->settings;
    nh_system *system =
        nh_request_input(r, nh_arena_strdup(p->arena, d->parameter), nh_arena_strdup(p->arena, d->input), d->error)
            ? nh_system_read(r->system_path, r->settings, r->setting, d->error)
            : NULL;
    d->good = system != NULL;
    if (!system) {
        r->setting = before, r->settings = count, r->system_words = words;
        return;
    }
    nh_system_free(p->system);
    p->system = system;
}

bool nh_problem_input(nh_problem *p, const char *parameter, const char *input, nh_error *error)
{
    NH_OWN_ERROR(error);
    driving d = {.problem = p, .parameter = parameter, .input = input, .error = error};
    return nh_problem_run(p, drive, &d, error) && d.good;
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
