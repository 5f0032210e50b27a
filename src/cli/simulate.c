#include <string.h>

#include "base/files.h"
#include "base/progress.h"
#include "cli/cli.h"
#include "commands/scan.h"
#include "document/simulation.h"

bool nh_cli_motion_request(nh_cli *cli, const char *example, nh_simulate_request *q, nh_error *error)
{
    if (!nh_cli_one_system(cli, example, error)) return false;
    const char *name = cli->operand[0];
    *q = (nh_simulate_request){.settings = cli->settings,
                               .setting = cli->setting,
                               .chart = cli->velocities,
                               .initial = cli->initial,
                               .step = cli->step,
                               .watch = cli->watch,
                               .event = cli->event,
                               .section = cli->section,
                               .axes = cli->axes,
                               .scene = cli->scene,
                               .method = cli->methods ? cli->method[0] : NULL,
                               .methods = cli->methods,
                               .only = cli->method,
                               .accuracy = cli->accuracy,
                               .ensemble = cli->ensemble,
                               .spread = cli->spread > 0 ? cli->spread : 0.1,
                               .project = cli->project,
                               .draw = cli->html || cli->tex,
                               .until_given = cli->until_given,
                               .tolerance_given = cli->tolerance_given,
                               .options = cli->options};
    q->system_path = nh_cli_system(cli, name, error);
    if (!q->system_path) return false;
    if (cli->analysis) return (q->analysis_path = nh_places_find(cli->arena, "analyses", cli->analysis, error)) != NULL;
    if (!cli->no_analysis && !nh_places_is_path(name)) q->analysis_path = nh_places_look(cli->arena, "analyses", name);
    return true;
}

/* The model that was chosen, what never matters, and the measured cost against the whole model. */
static void put_scene(const nh_simulation *s)
{
    fprintf(stderr, "nhsym: %s\n", s->scene);
    if (s->idle && s->idle[0]) fprintf(stderr, "nhsym: %s\n", s->idle);
    if (s->compared)
        fprintf(stderr,
                "nhsym: %.3g ms and %ld evaluations; the whole model takes %.3g ms and %ld, and differs by %.0e\n",
                1e3 * s->scene_seconds, s->motion->evaluations, 1e3 * s->whole_seconds, s->whole_evaluations,
                s->whole_difference);
}

/* What happened when, the first few of it. */
static void put_events(const nh_simulation *s)
{
    enum { most = 20 };
    size_t shown = 0, all = s->motion->events - (s->has_section ? nh_events_of(s, s->events - 1) : 0);
    for (size_t i = 0; i < s->motion->events && shown < most; i++) {
        const nh_event_found *found = &s->motion->event[i];
        if (s->event[found->which].section) continue;
        bool end = s->motion->stopped && i + 1 == s->motion->events;
        fprintf(stderr, "nhsym: %s at t = %.15g, %s%s\n", s->event[found->which].name, found->time,
                nh_direction_word(found->direction), end ? ": the motion ends" : "");
        shown++;
    }
    if (shown < all) fprintf(stderr, "nhsym: and %zu more; --json and -o write all of them\n", all - shown);
    for (size_t i = 0; i < s->events; i++)
        if (!nh_events_of(s, i))
            fprintf(stderr, "nhsym: %s has no zero along this motion (%s)\n", s->event[i].name,
                    nh_direction_word(s->event[i].event.direction));
}

static void put_notes(const nh_cli *cli, const nh_simulation *s)
{
    if (s->begin) fprintf(stderr, "nhsym: no initial state is given: --initial \"%s\"\n", s->begin);
    if (s->scene && (cli->watch || cli->scene)) put_scene(s);
    if (cli->verbose && s->trajectory)
        fprintf(stderr, "nhsym: %s, %s, %ld evaluations in %.3g s; %s\n", s->method, s->formulation,
                s->motion->evaluations, s->motion->seconds, s->trajectory->machine);
    if (s->events) put_events(s);
    if (s->motion && s->motion->complete && s->motion->note[0]) fprintf(stderr, "nhsym: %s\n", s->motion->note);
    if (s->held) fprintf(stderr, "nhsym: %s\n", s->why);
    if (s->ensemble && s->ensemble->alone && !s->checked)
        fprintf(stderr, "nhsym: %zu of %zu members were computed alone\n", s->ensemble->alone, s->ensemble->members);
}

/* Events and section as files of the folder. */
static bool put_zeros(nh_cli *cli, const nh_simulation *s, nh_error *error)
{
    nh_text text;
    nh_text_init(&text);
    if (s->events > s->has_section) nh_events_csv(s, &text);
    if (text.length && !nh_cli_write(cli, nh_cli_in_folder(cli, "events.csv"), &text, error)) return false;
    if (s->has_section) nh_section_csv(s, &text);
    return !text.length || nh_cli_write(cli, nh_cli_in_folder(cli, "section.csv"), &text, error);
}

/* The table, and with it the notes on standard error: --quiet leaves them out, and the table as well where a file holds
   the result. */
static bool put_table(nh_cli *cli, const nh_simulation *s, nh_error *error)
{
    const char *file = cli->csv ? cli->csv : cli->folder ? nh_cli_in_folder(cli, "motion.csv") : "-";
    if (!cli->folder && !cli->csv && (cli->json || !nh_cli_delivers(cli))) return true;
    nh_text text;
    nh_text_init(&text);
    if (s->ensemble) nh_ensemble_csv(s, &text);
    else if (s->has_section && !cli->folder) nh_section_csv(s, &text);
    else nh_motion_csv(s, &text);
    if (!nh_cli_write(cli, file, &text, error)) return false;
    if (cli->folder && !put_zeros(cli, s, error)) return false;
    if (!cli->quiet) put_notes(cli, s);
    return true;
}

/* Motions that ended early or missed the requested accuracy. */
static void complain(const nh_simulation *s, nh_error *error)
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

/* The sections of all motions in one picture. */
static bool put_section_picture(nh_cli *cli, const nh_section_plot *section, nh_error *error)
{
    nh_text picture;
    nh_plot plot = nh_section_plot_of(section);
    nh_text_init(&picture);
    nh_svg_plot(&plot, &picture);
    return nh_cli_write_picture(cli, &picture, error);
}

/* The motions of a table one by one, as a table or as JSON. */
static int one_by_one(nh_cli *cli, const nh_simulate_request *request, const nh_simulate_rows *rows, nh_error *error)
{
    nh_text text;
    nh_section_plot section = {0};
    nh_json *root = cli->json ? nh_json_object() : NULL;
    nh_run run = nh_cli_run(cli, request->system_path, request->analysis_path);
    bool good = true, complete = true;
    size_t done = 0;
    nh_text_init(&text);
    for (size_t i = 0; i < rows->count && good && !nh_interrupted(); i++) {
        const nh_simulate_row *row = &rows->row[i];
        nh_simulate_request q = *request;
        nh_setting *all = nh_arena_alloc(cli->arena, (q.settings + row->settings + 1) * sizeof *all);
        if (q.settings) memcpy(all, q.setting, q.settings * sizeof *all);
        memcpy(all + q.settings, row->setting, row->settings * sizeof *all);
        q.setting = all;
        q.settings += row->settings;
        if (row->initial) q.initial = row->initial, q.from = row->from;
        nh_simulation *s = nh_simulation_create(&q, error);
        good = s != NULL;
        if (good && q.section) nh_section_plot_add(&section, s);
        if (good && root) nh_member_json(s, row, &run, root), complete = complete && s->motion->complete;
        if (good && (!root || cli->csv)) nh_member_csv(s, i, row, &text);
        if (good) complain(s, error);
        nh_simulate_row_blame(row, error);
        nh_simulation_free(s);
        done += good;
    }
    nh_cli_progress_end();
    if (good && (cli->csv || nh_cli_delivers(cli)))
        good = nh_cli_write(cli, cli->csv ? cli->csv : "-", &text, error);
    nh_text_clear(&text);
    if (root) nh_json_put_bool(root, "complete", complete && done == rows->count);
    if (root) nh_json_put_bool(root, "partial", nh_interrupted());
    if (root) good = nh_cli_write_json(cli, nh_json_finish(root), error) && good;
    if (good && (cli->svg || cli->pdf)) good = put_section_picture(cli, &section, error);
    nh_section_plot_clear(&section);
    good = nh_cli_written(cli, good, error);
    return good && nh_interrupted() ? (int)nh_ended_code() : (int)error->code;
}

/* --over, each: a table whose rows are all combinations, the last name changing first. */
static bool write_combinations(nh_cli *cli, nh_error *error)
{
    static const char name[] = "--over";
    const size_t most = 1000000;
    nh_scan_axis *axis = nh_arena_alloc(cli->arena, cli->overs * sizeof *axis);
    size_t rows = 1;
    nh_text text;
    nh_text_init(&text);
    bool good = true;
    for (size_t i = 0; i < cli->overs && good; i++) {
        good = nh_scan_read_axis(cli->arena, cli->over_list[i], &axis[i], error);
        if (good && axis[i].count > most / rows)
            good = nh_fail(error, NH_USAGE, "", "--over: there are more than %zu combinations", most);
        if (good) rows *= axis[i].count, nh_text_addf(&text, "%s%s", i ? "," : "", axis[i].name);
    }
    for (size_t row = 0; row < rows && good; row++) {
        size_t stride = rows;
        for (size_t i = 0; i < cli->overs; i++) {
            char number[32];
            stride /= axis[i].count;
            nh_text_number(axis[i].value[row / stride % axis[i].count].value, number, sizeof number);
            nh_text_addf(&text, "%s%s", i ? "," : "\n", number);
        }
    }
    if (good) nh_files_add(name, nh_text_string(&text), text.length);
    nh_text_clear(&text);
    cli->table = name;
    return good;
}

/* --initial-table: its motions together, as an ensemble, or one by one where they differ in more than the initial
   state.  False: see the code. */
static bool together(nh_cli *cli, nh_simulate_request *q, nh_simulate_rows *rows, int *code, nh_error *error)
{
    *code = NH_OK;
    if (!cli->table && !cli->overs) return true;
    const char *option = cli->overs ? "over" : "initial-table";
    if (cli->table && cli->overs) {
        nh_fail(error, NH_USAGE, "", "--initial-table, and --over as well");
        return nh_error_hint(error, "write the values of --over into the table"), *code = NH_USAGE, false;
    }
    if (cli->overs && !write_combinations(cli, error)) return *code = (int)error->code, false;
    const char *document = nh_cli_wants_document(cli);
    const char *other = cli->ensemble  ? "ensemble"
                        : cli->folder  ? "output"
                        : document     ? document
                        : cli->section ? NULL
                        : cli->svg     ? "svg"
                        : cli->pdf     ? "pdf"
                                       : NULL;
    bool good = !other;
    if (!good) {
        nh_fail(error, NH_USAGE, "", "--%s, and --%s as well", option, other);
        nh_error_hint(error, "several motions are one table, or JSON");
    }
    good = good && nh_simulate_rows_read(cli->arena, q, cli->table, rows, error);
    if (good && (rows->parameters || q->method || q->event || q->section || rows->count == 1))
        return *code = one_by_one(cli, q, rows, error), false;
    if (!good) return *code = (int)error->code, false;
    q->ensemble = rows->count;
    q->table = rows;
    q->initial = rows->row[0].initial;
    q->from = rows->row[0].from;
    return true;
}

static void render(const void *result, const nh_run *run, nh_pen_style style, nh_text *out)
{
    nh_simulation_write(result, run, style, out);
}

int nh_cli_simulate(nh_cli *cli, nh_error *error)
{
    static const char *const example = "nhsym simulate sleigh --initial \"omega=2\" --until 10";
    nh_simulate_request request;
    nh_simulate_rows rows;
    int code;
    nh_cli_progress_begin(cli);
    if (!nh_cli_motion_request(cli, example, &request, error) || !nh_cli_can_write(cli, error)) return error->code;
    if (cli->input)
        return nh_fail(error, NH_USAGE, "", "--input needs NAME=EXPR, found `%s`", cli->input),
               nh_error_hint(error, "for example: --input \"%s=sin(t)\"", cli->input), NH_USAGE;
    if (cli->methods > 1)
        return nh_fail(error, NH_USAGE, "", "--method takes one integrator, found %zu", cli->methods),
               nh_error_hint(error, "`nhsym benchmark` compares several"), NH_USAGE;
    if (!together(cli, &request, &rows, &code, error)) return code;
    if (!nh_cli_use_folder(cli, error) || !nh_cli_can_write(cli, error)) return error->code;
    nh_simulation *s = nh_simulation_create(&request, error);
    nh_cli_progress_end();
    nh_run run = nh_cli_run(cli, request.system_path, request.analysis_path);
    if (!s) return nh_cli_failed(cli, &run, error);
    bool good = put_table(cli, s, error);
    if (cli->json && good)
        good = nh_cli_write_json(cli, s->ensemble ? nh_ensemble_json(s, &run) : nh_motion_json(s, &run), error);
    good = good && nh_cli_write_documents(cli, render, s, &run, error);
    if ((cli->svg || cli->pdf) && good) {
        nh_text picture;
        nh_text_init(&picture);
        nh_motion_svg(s, &picture);
        good = nh_cli_write_picture(cli, &picture, error);
    }
    good = nh_cli_written(cli, good, error);
    if (s->astray && !cli->quiet) fprintf(stderr, "warning: %s\n", s->astray);
    if (good) complain(s, error);
    nh_simulation_free(s);
    return good && nh_interrupted() ? (int)nh_ended_code() : (int)error->code;
}
