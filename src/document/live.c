#include "document/live.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/escape.h"
#include "document/export_code.h"
#include "document/page.h"
#include "graph/dag.h"
#include "integrals/fixed.h"

const char *nh_live_js_lacks(const nh_dag *dag, nh_ex e) { return nh_source_lacks(&nh_source_js, dag, e); }

void nh_live_js_text(const char *text, nh_text *out)
{
    nh_text mended;
    nh_text_init(&mended);
    nh_utf8_mend(text, &mended);
    nh_text_add(out, "\"");
    for (const char *c = nh_text_string(&mended); *c; c++) {
        if ((unsigned char)*c < ' ') nh_text_addf(out, "\\u%04x", (unsigned char)*c);
        else if (strchr("\"\\", *c)) nh_text_addf(out, "\\%c", *c);
        else if (strchr("<>&]", *c)) nh_text_addf(out, "\\u%04x", (unsigned char)*c); /* ends no script */
        else nh_text_add_n(out, c, 1);
    }
    nh_text_add(out, "\"");
    nh_text_clear(&mended);
}

static void put_number(double value, nh_text *out)
{
    char text[40];
    nh_text_number(value, text, sizeof text);
    nh_text_add(out, isfinite(value) ? text : "NaN");
}

/* ---- bodies ---- */

static void begin(nh_export_body *b)
{
    nh_text_addf(b->out, "  %s(%s", b->f->name, b->time);
    for (size_t i = 0; i < b->f->arguments; i++) nh_text_addf(b->out, ", %s", b->argument[i]);
    nh_text_addf(b->out, ", %s", b->parameters);
    for (size_t i = 0; i < b->f->results; i++) nh_text_addf(b->out, ", %s", b->result[i]);
    nh_text_add(b->out, ") {\n");
}

static void unpack(nh_export_body *b, const char *name, const char *array, size_t index)
{
    nh_text_addf(b->out, "%sconst %s = %s[%zu];\n", b->indent, name, array, index);
}

static void parameter(nh_export_body *b, const char *name, const char *member)
{
    nh_text_addf(b->out, "    const %s = %s.%s;\n", name, b->parameters, member);
}

static void fill(nh_export_body *b, const char *array, size_t rows, size_t columns, const nh_ex *e)
{
    size_t n = rows * (columns ? columns : 1);
    nh_text_addf(b->out, "%sconst %s = [", b->indent, array);
    for (size_t i = 0; i < n; i++) {
        if (i) nh_text_add(b->out, ", ");
        nh_source_put(b->code, e[i]);
    }
    nh_text_add(b->out, "];\n");
}

static void solve(nh_export_body *b, size_t i)
{
    nh_text_addf(b->out, "    nhsymLinear(%zu, %s, %s);\n", b->f->solve[i].n, b->matrix[i], b->right[i]);
    b->unknown[i] = b->right[i];
}

static void end(nh_export_body *b)
{
    for (size_t i = 0; i < b->f->results; i++)
        for (size_t k = 0; k < b->f->result[i].rows; k++) {
            nh_text_addf(b->out, "    %s[%zu] = ", b->result[i], k);
            nh_source_put(b->code, b->f->result[i].e[k]);
            nh_text_add(b->out, ";\n");
        }
    nh_text_add(b->out, "  },\n");
}

/* No function of a motion contains an iteration. */
static const nh_export_form form = {&nh_source_js, begin, unpack, parameter, fill, solve, NULL, NULL, end};

/* ---- the model ---- */

static void put_list(const char *key, size_t n, const double *value, nh_text *out)
{
    nh_text_addf(out, "  %s: [", key);
    for (size_t i = 0; i < n; i++) {
        if (i) nh_text_add(out, ", ");
        put_number(value[i], out);
    }
    nh_text_add(out, "],\n");
}

static void put_parameters(const nh_system *system, nh_text *out)
{
    nh_text_add(out, "  parameters: {");
    for (size_t i = 0; i < system->parameters; i++) {
        nh_text_addf(out, "%s%s: ", i ? ", " : "", system->parameter[i].name);
        put_number(system->parameter[i].value, out);
    }
    nh_text_add(out, "},\n");
}

/* The values that parameters must have: {k: p => 2}. */
static void put_needs(const nh_live *l, const nh_live_quantity *q, nh_text *out)
{
    const nh_system *system = l->model->system;
    nh_text_addf(out, ", proved: %s", q->proved ? "true" : "false");
    if (!q->proved || q->all_parameters) return;
    nh_text_add(out, ", needs: {");
    for (size_t i = 0, n = 0; i < system->parameters; i++) {
        if (q->fixed && !nh_fixed_has(l->model, q->fixed, i)) continue;
        nh_text_addf(out, "%s%s: p => ", n++ ? ", " : "", system->parameter[i].name);
        nh_source *code = nh_source_create(&nh_source_js, l->model->dag, out);
        for (size_t k = 0; k < system->parameters; k++)
            nh_source_set(code, system->parameter[k].symbol,
                          nh_arena_printf(l->code->arena, "p.%s", system->parameter[k].name));
        nh_source_whole(code);
        if (q->fixed) nh_source_put(code, q->fixed[i]);
        else put_number(system->parameter[i].value, out);
        nh_source_free(code);
    }
    nh_text_add(out, "}");
}

static void put_quantities(const nh_live *l, nh_text *out)
{
    nh_text_add(out, "  currents: [");
    for (size_t i = 0; i < l->quantities; i++) {
        nh_text_add(out, i ? ",\n    {name: " : "\n    {name: ");
        nh_live_js_text(l->quantity[i].name, out);
        if (l->why || l->without[i]) nh_text_add(out, ", without: true");
        put_needs(l, &l->quantity[i], out);
        nh_text_add(out, "}");
    }
    nh_text_add(out, "],\n");
}

/* Each shape with the place of its first number among the tracks, where it has all of them. */
static void put_shapes(const nh_live *l, const nh_observables *t, nh_text *out)
{
    size_t first = 0, shown = 0;
    while (first < t->count && t->track[first].kind != NH_TRACK_SHAPE) first++;
    nh_text_add(out, "  shapes: [");
    for (size_t i = 0; i < t->shapes; first += nh_shape_numbers(t->shape[i++].kind)) {
        const nh_shape *shape = &t->shape[i];
        size_t n = nh_shape_numbers(shape->kind), at = 0, found = 0;
        for (size_t k = 0; k < l->tracks; k++) {
            if (l->track[k] == first) at = k;
            found += l->track[k] >= first && l->track[k] < first + n;
        }
        if (found < n) continue;
        nh_text_addf(out, "%s{kind: \"%s\", at: %zu", shown++ ? ", " : "", nh_shape_name(shape->kind), at);
        if (shape->flat) nh_text_add(out, ", flat: true");
        if (shape->name) nh_text_add(out, ", name: "), nh_live_js_text(shape->name, out);
        nh_text_add(out, "}");
    }
    nh_text_add(out, "],\n");
}

static void put_tracks(const nh_live *l, const nh_observables *t, nh_text *out)
{
    static const char *const kind[] = {
        [NH_TRACK_STATE] = "state",   [NH_TRACK_CURRENT] = "current", [NH_TRACK_MULTIPLIER] = "multiplier",
        [NH_TRACK_ENERGY] = "energy", [NH_TRACK_WATCH] = "watch",     [NH_TRACK_SHAPE] = "shape"};
    nh_text_add(out, "  tracks: [");
    for (size_t i = 0; i < l->tracks; i++) {
        const nh_track *track = &t->track[l->track[i]];
        nh_text_add(out, i ? ", {name: " : "{name: ");
        nh_live_js_text(track->name, out);
        nh_text_addf(out, ", kind: \"%s\"}", kind[track->kind]);
    }
    nh_text_add(out, "],\n");
}

static void put_model(const nh_live *l, const nh_observables *t, nh_text *out)
{
    const nh_system *system = l->model->system;
    nh_text_add(out, "var nhsymModel = {\n  name: ");
    nh_live_js_text(system->name, out);
    nh_text_add(out, ",\n  title: ");
    nh_live_js_text(system->title, out);
    nh_text_add(out, ",\n");
    put_parameters(system, out);
    nh_text_add(out, "  state: [");
    for (size_t i = 0; i < l->states; i++) {
        if (i) nh_text_add(out, ", ");
        nh_live_js_text(l->state[i], out);
    }
    nh_text_add(out, "],\n");
    put_list("initial", l->states, l->initial, out);
    put_list("floor", l->states, l->floor, out);
    put_list("time", 2, (double[]){l->begin, l->end}, out);
    put_quantities(l, out);
    put_tracks(l, t, out);
    put_shapes(l, t, out);
    const char **member = nh_arena_alloc(l->code->arena, (system->parameters + 1) * sizeof *member);
    for (size_t i = 0; i < system->parameters; i++) member[i] = system->parameter[i].name;
    for (size_t i = 0; i < l->code->functions && !l->why; i++)
        nh_export_put_body(&form, l->code, &l->code->function[i], "", member, out);
    nh_text_add(out, "};\n");
}

void nh_live_js(nh_live *l, const nh_observables *t, size_t most, nh_text *out)
{
    nh_text text;
    nh_text_init(&text);
    put_model(l, t, &text);
    if (!l->why && text.length > most) {
        nh_live_leave(l, t, nh_arena_printf(l->code->arena, "its equations are %zu characters long", text.length));
        nh_text_clear(&text);
        put_model(l, t, &text);
    }
    if (strstr(nh_text_string(&text), "nhsymSpecial.")) nh_text_add(out, nh_page_special);
    nh_text_add(out, nh_text_string(&text));
    nh_text_clear(&text);
}

/* ---- of an analysis ---- */

nh_live *nh_live_of_analysis(const nh_analysis *result, const nh_observables *tracks)
{
    const nh_current_list *list = result->list;
    const nh_validation *v = result->validation;
    if (!v || v->count < 2) return NULL;
    nh_dag *d = result->question->model->dag;
    nh_live_quantity *quantity = nh_arena_alloc(result->arena, (list->count + 1) * sizeof *quantity);
    for (size_t k = 0; k < list->count; k++) {
        const nh_current *f = &list->found[k];
        bool minus = !strncmp(f->meaning, "minus", 5); /* as readers know it: E, not -E */
        nh_ex in_velocities = f->has_in_velocities ? f->in_velocities : 0;
        quantity[k] = (nh_live_quantity){.name = f->name,
                                         .value = minus ? nh_neg(d, f->phi) : f->phi,
                                         .in_velocities = minus ? nh_neg(d, in_velocities) : in_velocities,
                                         .proved = f->proof.proved,
                                         .all_parameters = f->proof.all_parameters,
                                         .fixed = f->proof.fixed};
    }
    nh_live_request request = {.model = result->question->model,
                               .tracks = tracks,
                               .first = v->watch,
                               .begin = v->time[0],
                               .end = v->time[v->count - 1],
                               .quantities = list->count,
                               .quantity = quantity};
    return nh_live_create(&request, nh_live_js_lacks);
}

bool nh_live_possible(const nh_analysis *result, nh_error *error)
{
    nh_live *live = nh_live_of_analysis(result, &result->tracks);
    bool good = live && !live->why;
    if (!live) nh_fail(error, NH_NUMERIC, "--to js", "no motion of this system was computed");
    else if (!good) nh_fail(error, NH_NUMERIC, "--to js", "the motion cannot be written in JavaScript: %s", live->why);
    nh_live_free(live);
    return good || nh_error_hint(error, "--to c and --to python write the equations of all systems");
}

void nh_live_js_file(const nh_analysis *result, nh_text *out)
{
    nh_live *live = nh_live_of_analysis(result, &result->tracks);
    nh_text_addf(out, "// %s.  Exported by nhsym " NH_VERSION ": a model and an integrator (docs/export.md).\n",
                 result->question->system->title);
    nh_live_js(live, &result->tracks, SIZE_MAX, out);
    nh_text_add(out, nh_page_solver);
    nh_text_add(out, "if (typeof module === \"object\") module.exports = {model: nhsymModel, solve: nhsymSolve};\n");
    nh_live_free(live);
}

const char *nh_live_command(nh_arena *arena, const nh_run *run, const nh_system *system)
{
    const char *words = run->system_words ? run->system_words : run->system_path ? run->system_path : system->name;
    words = nh_arena_printf(arena, "nhsym simulate %s", words);
    for (size_t i = 0; i < system->parameters; i++) {
        char number[40];
        nh_text_number(system->parameter[i].value, number, sizeof number);
        if (system->parameter[i].set)
            words = nh_arena_printf(arena, "%s --set %s=%s", words, system->parameter[i].name, number);
    }
    return words;
}
