/* answer_motion: one motion, an ensemble, or the motions of a table one by one. */
#include <string.h>

#include "base/files.h"
#include "base/progress.h"
#include "commands/scan.h"
#include "document/simulation.h"
#include "library/answer_internal.h"

/* Motions that are computed one by one: a table or a JSON document, and their picture. */
typedef struct {
    nh_text table;
    nh_json *root; /* or NULL */
    nh_motion_plot picture;
} series;

nh_simulation *nh_answer_motion_of_page(const nh_request *q)
{
    nh_error ignored = {0};
    nh_request request = *q;
    request.analysis_path = NULL;
    request.draw = request.picture = true;
    request.accuracy = 0;
    return nh_simulation_create(&request, &ignored);
}

/* Motions that ended early or missed the requested accuracy. */
static void complain_of_motion(const nh_simulation *s, nh_error *error)
{
    if (s->ensemble && s->ensemble->incomplete)
        nh_fail(error, NH_NUMERIC, "", "%zu members did not reach the end; %s", s->ensemble->incomplete,
                s->ensemble->note);
    bool unsure = s->checked && !s->held && (s->ensemble || s->motion->complete);
    if (unsure) nh_fail(error, NH_NUMERIC, "", "%s", s->why);
    if (s->ensemble) return;
    if (unsure && s->columns.count > 1)
        nh_error_hint(error, "`%s` is the least certain of %zu columns; choose the wanted columns by --watch",
                      s->columns.track[s->accuracy.quantity].name, s->columns.count);
    if (!s->motion->complete)
        nh_fail(error, s->motion->limited ? NH_LIMIT : NH_NUMERIC, "", "the motion ended at t = %g: %s",
                s->motion->end_time, s->checked && nh_interrupted() ? s->why : s->motion->note);
}

/* ---- several motions ---- */

static bool run_row(const nh_answer *a, nh_request q, size_t index, const nh_simulate_row *row, series *all,
                    bool *complete, nh_error *error)
{
    nh_setting *setting = nh_arena_alloc(a->request->arena, (q.settings + row->settings + 1) * sizeof *setting);
    if (q.settings) memcpy(setting, q.setting, q.settings * sizeof *setting);
    memcpy(setting + q.settings, row->setting, row->settings * sizeof *setting);
    q.setting = setting;
    q.settings += row->settings;
    if (row->initial) q.initial = row->initial, q.from = row->from;
    nh_simulation *s = nh_simulation_create(&q, error);
    if (s) nh_motion_plot_add(&all->picture, s, row->name);
    if (s && all->root) nh_member_json(s, row, &a->run, all->root), *complete = *complete && s->motion->complete;
    if (s && (!all->root || a->request->csv)) nh_member_csv(s, index, row, &all->table);
    if (s) complain_of_motion(s, error);
    nh_simulate_row_blame(row, error);
    nh_simulation_free(s);
    return s != NULL;
}

static bool run_series(nh_answer *a, const nh_request *q, const nh_simulate_rows *rows, nh_error *error)
{
    series *all = nh_alloc(sizeof *all);
    *all = (series){.root = a->request->json ? nh_json_object() : NULL};
    nh_text_init(&all->table);
    bool complete = true;
    size_t done = 0;
    while (done < rows->count && !nh_interrupted() && run_row(a, *q, done, &rows->row[done], all, &complete, error))
        done++;
    a->failed = done < rows->count && !nh_interrupted();
    if (done < rows->count && nh_interrupted()) {
        nh_error_clear(error);
        nh_fail_ended(error, "when %zu of %zu motions were computed", done, rows->count);
    }
    if (all->root) nh_json_put_bool(all->root, "complete", complete && done == rows->count);
    if (all->root) nh_json_put_bool(all->root, "partial", nh_interrupted());
    return (a->part[1] = all) != NULL;
}

/* --over, each: a table whose rows are all combinations, the last name changing first. */
static const char *write_combinations(const nh_request *q, nh_error *error)
{
    static const char name[] = "--over";
    const size_t most = 1000000;
    nh_scan_axis *axis = nh_arena_alloc(q->arena, q->overs * sizeof *axis);
    size_t rows = 1;
    nh_text text;
    nh_text_init(&text);
    bool good = true;
    for (size_t i = 0; i < q->overs && good; i++) {
        good = nh_scan_read_axis(q->arena, q->over_list[i], &axis[i], error);
        if (good && axis[i].count > most / rows)
            good = nh_fail(error, NH_USAGE, "", "--over: there are more than %zu combinations", most);
        if (good) rows *= axis[i].count, nh_text_addf(&text, "%s%s", i ? "," : "", axis[i].name);
    }
    for (size_t row = 0; row < rows && good; row++) {
        size_t stride = rows;
        for (size_t i = 0; i < q->overs; i++) {
            char number[32];
            stride /= axis[i].count;
            nh_text_number(axis[i].value[row / stride % axis[i].count].value, number, sizeof number);
            nh_text_addf(&text, "%s%s", i ? "," : "\n", number);
        }
    }
    if (good) nh_files_add(name, nh_text_string(&text), text.length);
    nh_text_clear(&text);
    return good ? name : NULL;
}

/* The motions of a table together, as an ensemble, or one by one where they differ in more than the initial state. */
static bool run_table(nh_answer *a, nh_request *request, const char *table, nh_error *error)
{
    nh_simulate_rows *rows = nh_arena_alloc(a->request->arena, sizeof *rows);
    if (!table || !nh_simulate_rows_read(a->request->arena, request, table, rows, error)) return false;
    if (rows->parameters || request->methods || request->event || request->section || rows->count == 1)
        return run_series(a, request, rows, error);
    request->ensemble = rows->count;
    request->rows = rows;
    request->initial = rows->row[0].initial;
    request->from = rows->row[0].from;
    return (a->part[0] = nh_simulation_create(request, error)) != NULL;
}

static bool simulate_check(const nh_request *q, nh_error *error)
{
    if (q->methods < 2) return true;
    nh_fail(error, NH_USAGE, "", "--method takes one integrator, found %zu", q->methods);
    return nh_error_hint(error, "`nhsym benchmark` compares several");
}

static bool simulation_create(nh_answer *a, nh_error *error)
{
    const nh_request *q = a->request;
    nh_request request = *q;
    if (q->table || q->overs) return run_table(a, &request, q->table ? q->table : write_combinations(q, error), error);
    return (a->part[0] = nh_simulation_create(q, error)) != NULL;
}

static void simulation_free(nh_answer *a)
{
    series *all = a->part[1];
    if (a->part[0]) nh_simulation_free(a->part[0]);
    if (!all) return;
    nh_text_clear(&all->table);
    nh_motion_plot_clear(&all->picture);
    nh_free(all);
}

/* ---- what is written ---- */

static void simulation_write(const nh_answer *a, nh_pen_style style, nh_text *out)
{
    nh_simulation_write(a->part[0], &a->run, style, out);
}

static char *simulation_json(const nh_answer *a)
{
    series *all = a->part[1];
    const nh_simulation *s = a->part[0];
    return all ? nh_json_finish(all->root) : s->ensemble ? nh_ensemble_json(s, &a->run) : nh_motion_json(s, &a->run);
}

/* In a folder the section is a file of its own. */
static void simulation_table(const nh_answer *a, nh_text *csv)
{
    const series *all = a->part[1];
    const nh_simulation *s = a->part[0];
    if (all) nh_text_add_n(csv, nh_text_string(&all->table), all->table.length);
    else if (s->ensemble) nh_ensemble_csv(s, csv);
    else if (s->has_section && !a->request->folder) nh_section_csv(s, csv);
    else nh_motion_csv(s, csv);
}

static bool simulation_print(const nh_answer *a, nh_text *out) { return simulation_table(a, out), true; }

static nh_text *next_file(nh_answer_file *file, size_t *n, const char *name)
{
    file[*n].name = name;
    nh_text_init(&file[*n].text);
    return &file[(*n)++].text;
}

/* Events and section. */
static size_t simulation_files(const nh_answer *a, nh_answer_file file[NH_ANSWER_FILES])
{
    const nh_simulation *s = a->part[0];
    size_t n = 0;
    if (!s) return 0;
    if (s->events > s->has_section) nh_events_csv(s, next_file(file, &n, "events.csv"));
    if (s->has_section) nh_section_csv(s, next_file(file, &n, "section.csv"));
    return n;
}

/* The motion; all motions in one picture. */
static void simulation_picture(const nh_answer *a, nh_text *svg)
{
    const series *all = a->part[1];
    if (!all) {
        nh_motion_svg(a->part[0], svg);
        return;
    }
    nh_plot plot = nh_motion_plot_of(&all->picture);
    nh_svg_plot(&plot, svg);
}

/* Writes the chosen model, the parameters and bodies without influence, and the measured cost relative to the whole
 * model. */
static void put_scene(const nh_simulation *s, nh_text *out)
{
    nh_text_addf(out, "nhsym: %s\n", s->scene);
    if (s->idle && s->idle[0]) nh_text_addf(out, "nhsym: %s\n", s->idle);
    if (s->compared)
        nh_text_addf(
            out, "nhsym: computed in %.3g ms (%ld evaluations); all states take %.3g ms (%ld), and differ by %.0e\n",
            1e3 * s->scene_seconds, s->motion->evaluations, 1e3 * s->whole_seconds, s->whole_evaluations,
            s->whole_difference);
}

/* Writes the first few events. */
static void put_events(const nh_simulation *s, nh_text *out)
{
    enum { most = 20 };
    size_t shown = 0, all = s->motion->events - (s->has_section ? nh_events_of(s, s->events - 1) : 0);
    for (size_t i = 0; i < s->motion->events && shown < most; i++) {
        const nh_event_found *found = &s->motion->event[i];
        if (s->event[found->which].section) continue;
        bool end = s->motion->stopped && i + 1 == s->motion->events;
        nh_text_addf(out, "nhsym: %s at t = %.15g, %s%s\n", s->event[found->which].name, found->time,
                     nh_direction_word(found->direction), end ? ": the motion ends" : "");
        shown++;
    }
    if (shown < all) nh_text_addf(out, "nhsym: and %zu more; --json and -o write all of them\n", all - shown);
    for (size_t i = 0; i < s->events; i++)
        if (!nh_events_of(s, i))
            nh_text_addf(out, "nhsym: %s has no %szero along this motion\n", s->event[i].name,
                         nh_direction_before(s->event[i].event.direction));
}

static void put_notes(const nh_request *q, const nh_simulation *s, bool verbose, nh_text *out)
{
    if (s->begin) nh_text_addf(out, "nhsym: no initial state is given: --initial \"%s\"\n", s->begin);
    if (s->chosen) nh_text_addf(out, "nhsym: %s\n", s->chosen);
    if (s->scene && (q->watch || q->scene)) put_scene(s, out);
    if (verbose && s->trajectory)
        nh_text_addf(out, "nhsym: %s, %s, %ld evaluations in %.3g s; %s\n", s->method, s->formulation,
                     s->motion->evaluations, s->motion->seconds, s->trajectory->machine);
    if (s->events) put_events(s, out);
    if (s->fixed_step > 0)
        nh_text_addf(out, "nhsym: fixed steps of %g (the output spacing divided by the option fixed_steps)\n",
                     s->fixed_step);
    if (s->motion && s->motion->complete && s->motion->note[0]) nh_text_addf(out, "nhsym: %s\n", s->motion->note);
    if (s->held) nh_text_addf(out, "nhsym: %s\n", s->why);
    if (s->ensemble && s->ensemble->alone && !s->checked)
        nh_text_addf(out, "nhsym: %zu of %zu members were computed alone\n", s->ensemble->alone, s->ensemble->members);
}

static void simulation_notes(const nh_answer *a, bool verbose, bool printed, nh_text *out)
{
    const nh_simulation *s = a->part[0];
    if (s && printed) put_notes(a->request, s, verbose, out);
    if (s && s->assembled) nh_text_addf(out, "nhsym: %s\n", s->assembled);
    if (s && s->violation) nh_text_addf(out, "warning: %s\n", s->violation);
}

static int simulation_code(const nh_answer *a, nh_error *error)
{
    if (a->part[0]) complain_of_motion(a->part[0], error);
    return nh_answer_code(false, error);
}

const nh_answer_kind nh_answer_simulate = {.name = "simulate",
                                           .analysis = true,
                                           .check = simulate_check,
                                           .create = simulation_create,
                                           .free = simulation_free,
                                           .write = simulation_write,
                                           .json = simulation_json,
                                           .print = simulation_print,
                                           .tabular = true,
                                           .table = simulation_table,
                                           .table_name = "motion.csv",
                                           .files = simulation_files,
                                           .picture = simulation_picture,
                                           .notes = simulation_notes,
                                           .code = simulation_code};
