#include "commands/scan.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/json.h"
#include "base/progress.h"
#include "commands/scan_internal.h"

typedef struct {
    nh_scan *scan;
    const nh_scan_request *request;
    size_t jumps;
    nh_scan_jump *jump;
} work;

/* ---- the question ---- */

/* Options that change how an answer is found, and not the answer. */
static bool without_effect(const char *option) { return !strcmp(option, "threads") || !strncmp(option, "max_", 4); }

static void put_options(const nh_options *options, nh_text *out)
{
    nh_options usual;
    nh_options_default(&usual);
    for (size_t i = 0; i < nh_option_count(); i++) {
        const double *mine = (const double *)options + i, *theirs = (const double *)&usual + i;
        char value[40];
        if (*mine == *theirs || without_effect(nh_option_at(i).name)) continue;
        nh_text_number(*mine, value, sizeof value);
        nh_text_addf(out, " --option %s=%s", nh_option_at(i).name, value);
    }
}

/* The question as a command line that gives the same answer. */
static const char *question_of(const nh_scan *x, const nh_scan_request *q)
{
    nh_text text;
    char value[40];
    nh_text_init(&text);
    nh_text_addf(&text, "nhsym scan %s --of %s", x->system->name, q->source->of);
    for (size_t i = 0; i < q->axes; i++) {
        nh_text_add(&text, " --over ");
        for (const char *c = q->over[i]; *c; c++) nh_text_add_n(&text, c, *c != ' ');
    }
    for (size_t i = 0; i < q->source->count && !q->source->usual; i++)
        nh_text_addf(&text, " --number %s", q->source->name[i]);
    for (size_t i = 0; i < q->settings; i++) {
        nh_text_number(q->setting[i].value, value, sizeof value);
        nh_text_addf(&text, " --set %s=%s", q->setting[i].name, value);
    }
    put_options(&q->options, &text);
    const char *out = nh_arena_strdup(x->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

/* ---- points ---- */

static double rounded(double value)
{
    char text[40];
    snprintf(text, sizeof text, "%.6g", value); /* further digits may differ between processors */
    return strtod(text, NULL);
}

static void write_row(const nh_scan *x, const double *number, const double *smallest, const size_t *vanishing,
                      const char *why, nh_text *line)
{
    nh_json *to = nh_json_object(), *list;
    nh_json_put_numbers(to, "n", x->source->count, number, 1);
    list = nh_json_put_array(to, "s");
    for (size_t i = 0; i < x->spaces; i++) nh_json_add_number(list, rounded(smallest[i]));
    list = nh_json_put_array(to, "v");
    for (size_t i = 0; i < x->spaces; i++) nh_json_add_number(list, (double)vanishing[i]);
    if (why) nh_json_put_text(to, "w", why);
    char *text = nh_json_line(to);
    nh_text_add(line, text);
    nh_free(text);
}

static bool compute_point(void *context, size_t point, nh_text *line)
{
    const work *w = context;
    const nh_scan *x = w->scan;
    nh_arena *arena = nh_arena_create();
    double number[NH_SCAN_MOST_NUMBERS], smallest[NH_SCAN_MOST_SPACES];
    size_t vanishing[NH_SCAN_MOST_SPACES], settings;
    const char *why = NULL;
    nh_setting *setting = nh_scan_settings(x, w->request, arena, point, true, &settings);
    bool good = x->source->at(x->source->context, arena, settings, setting, false, number, &why);
    setting = nh_scan_settings(x, w->request, arena, point, false, &settings);
    if (good) nh_scan_spectra(x, w->request, settings, setting, SIZE_MAX, SIZE_MAX, smallest, vanishing);
    good = good && !nh_interrupted();
    if (good) write_row(x, number, smallest, vanishing, why, line);
    nh_arena_free(arena);
    return good;
}

static double seconds_of_a_point(void *context)
{
    const work *w = context;
    nh_text line;
    nh_text_init(&line);
    double start = nh_clock();
    nh_progress("a first point, for the size of units", -1);
    compute_point(context, w->scan->points / 2, &line);
    nh_text_clear(&line);
    return nh_clock() - start;
}

static void read_row(nh_scan *x, const char *line, nh_scan_row *row)
{
    nh_json *from = line ? nh_json_parse(line) : NULL;
    const nh_json *numbers = nh_json_get(from, "n"), *smallest = nh_json_get(from, "s"),
                  *vanishing = nh_json_get(from, "v");
    row->number = nh_arena_alloc(x->arena, (x->source->count + 1) * sizeof *row->number);
    row->smallest = nh_arena_alloc(x->arena, (x->spaces + 1) * sizeof *row->smallest);
    row->vanishing = nh_arena_alloc(x->arena, (x->spaces + 1) * sizeof *row->vanishing);
    row->done = from != NULL;
    for (size_t i = 0; i < x->source->count; i++) row->number[i] = nh_json_number_at(numbers, i);
    for (size_t i = 0; i < x->spaces; i++) {
        row->smallest[i] = nh_json_number_at(smallest, i);
        row->vanishing[i] = (size_t)fmax(0, nh_json_number_at(vanishing, i));
    }
    if (nh_json_text(from, "w")) row->why = nh_arena_strdup(x->arena, nh_json_text(from, "w"));
    nh_json_free(from);
}

/* ---- jumps ---- */

static bool compute_jump(void *context, size_t index, nh_text *line)
{
    const work *w = context;
    return nh_scan_refine(w->scan, w->request, &w->jump[index], line);
}

static double coordinate(const nh_scan *x, const nh_scan_special *s, size_t axis)
{
    return axis == s->axis ? s->value : nh_scan_at(x, s->place, axis)->value;
}

static const double one_place = 1e-9;

/* The largest modulus of the values on an axis, to which the distance of two places is relative. */
static double size_along(const nh_scan_axis *a)
{
    double size = 0;
    for (size_t i = 0; i < a->count; i++) size = fmax(size, fabs(a->value[i].value));
    return size;
}

/* Is it the same place, found by two dips or along two axes? */
static bool known(const nh_scan *x, const nh_scan_special *s)
{
    for (size_t i = 0; i < x->specials; i++) {
        bool same = true;
        for (size_t a = 0; a < x->axes; a++) {
            double u = coordinate(x, &x->special[i], a), v = coordinate(x, s, a);
            same = same && fabs(u - v) <= one_place * size_along(&x->axis[a]);
        }
        if (same) return true;
    }
    return false;
}

/* ---- both sweeps ---- */

static nh_sweep sweep_of(const work *w, const char *fingerprint)
{
    const nh_scan_request *q = w->request;
    return (nh_sweep){.folder = nh_arena_printf(w->scan->arena, "%s/units", q->folder),
                      .fingerprint = fingerprint,
                      .workers = q->workers,
                      .team = q->team,
                      .begin_worker = q->begin_worker,
                      .context = (void *)w};
}

static bool run_sweep(nh_scan *x, const nh_sweep *s, nh_sweep_state *state, const char ***line, nh_error *error)
{
    *line = nh_arena_alloc(x->arena, (s->items + 1) * sizeof **line);
    bool good = nh_sweep_run(s, state, error);
    x->deaths += state->deaths;
    if (state->deaths) x->death = nh_arena_strdup(x->arena, state->death);
    nh_sweep_read(s, x->arena, *line);
    return good;
}

/* The value at most points. */
static size_t most_common(const nh_scan *x, size_t space)
{
    size_t best = 0, times = 0;
    for (size_t n = 0; n <= x->columns[space]; n++) {
        size_t k = 0;
        for (size_t i = 0; i < x->points; i++)
            k += x->row[i].done && isfinite(x->row[i].smallest[space]) && x->row[i].vanishing[space] == n;
        if (k > times) times = k, best = n;
    }
    return best;
}

double nh_scan_sigma(const nh_scan *x, size_t point, size_t space)
{
    const nh_scan_row *r = &x->row[point];
    if (!r->done || r->vanishing[space] < x->usual[space]) return NAN;
    return r->vanishing[space] > x->usual[space] ? 0 : r->smallest[space];
}

static bool scan_points(work *w, nh_sweep s, size_t per_unit, nh_error *error)
{
    nh_scan *x = w->scan;
    nh_sweep_state state;
    const char **line;
    s.name = "points";
    s.doing = nh_arena_printf(x->arena, "%zu points", x->points);
    s.items = x->points;
    s.per_unit = per_unit;
    s.item = compute_point;
    s.chunk = w->request->chunk;
    s.chunks = w->request->chunks;
    bool good = run_sweep(x, &s, &state, &line, error);
    x->units = state.units;
    x->finished = state.finished;
    x->row = nh_arena_alloc(x->arena, (x->points + 1) * sizeof *x->row);
    for (size_t i = 0; i < x->points; i++) {
        read_row(x, line[i], &x->row[i]);
        x->partial |= !x->row[i].done;
    }
    x->usual = nh_arena_alloc(x->arena, (x->spaces + 1) * sizeof *x->usual);
    for (size_t k = 0; k < x->spaces; k++) x->usual[k] = most_common(x, k);
    return good;
}

static bool scan_jumps(work *w, nh_sweep s, nh_error *error)
{
    nh_scan *x = w->scan;
    nh_sweep_state state;
    const char **line;
    s.name = "jumps";
    s.doing = nh_arena_printf(x->arena, "%zu jumps, looked at more closely", w->jumps);
    s.items = w->jumps;
    s.per_unit = 1;
    s.item = compute_jump;
    bool good = !w->jumps || run_sweep(x, &s, &state, &line, error);
    x->special = nh_arena_alloc(x->arena, (w->jumps + 1) * sizeof *x->special);
    for (size_t i = 0; i < w->jumps; i++) {
        nh_scan_special *next = &x->special[x->specials];
        x->unrefined += !line[i];
        if (line[i] && nh_scan_read_special(x, line[i], &w->jump[i], next) && !known(x, next)) x->specials++;
    }
    x->partial |= x->unrefined > 0;
    return good;
}

static bool compute(nh_scan *x, const nh_scan_request *q, nh_error *error)
{
    work w = {.scan = x, .request = q};
    size_t per_unit;
    const char *fingerprint;
    bool first = !q->team || q->team->rank == 0, alone = !q->team || q->team->size < 2;
    if (!first) q->team->meet(q->team->context); /* the first process writes the manifest */
    bool good = nh_scan_manifest(x, q, seconds_of_a_point, &w, &per_unit, &fingerprint, error);
    if (first && !alone) q->team->meet(q->team->context);
    if (!good) return false;
    int hold;
    good = nh_sweep_hold(q->folder, &hold, error);
    nh_sweep s = sweep_of(&w, fingerprint);
    good = good && scan_points(&w, s, per_unit, error);
    x->chunked = q->chunks > 1;
    if (!alone) q->team->meet(q->team->context);
    if (good && !x->chunked && !x->partial) {
        w.jumps = nh_scan_jumps(x, &w.jump);
        good = scan_jumps(&w, s, error);
    }
    /* all processes meet as often as those that have jumps to examine */
    if (!alone && !w.jumps) q->team->meet(q->team->context);
    x->silent = !first;
    if (nh_sweep_is_alone(hold)) nh_sweep_tidy(s.folder, "");
    nh_sweep_release(hold);
    return good;
}

nh_scan *nh_scan_create(const nh_scan_request *q, nh_error *error)
{
    nh_arena *arena = nh_arena_create();
    nh_scan *x = nh_arena_alloc(arena, sizeof *x);
    *x = (nh_scan){.arena = arena, .source = q->source};
    x->system = nh_system_read(q->system_path, q->settings, q->setting, error);
    bool good = x->system && nh_system_needs_values(x->system, "a scan", error) && nh_scan_read_grid(x, q, error) &&
                nh_scan_list_spaces(x, q, error);
    if (good) x->question = question_of(x, q);
    if (good && compute(x, q, error)) return x;
    nh_scan_free(x);
    return NULL;
}

void nh_scan_free(nh_scan *x)
{
    if (!x) return;
    nh_system_free(x->system);
    nh_arena_free(x->arena);
}
