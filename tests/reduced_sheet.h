/* reduced_sheet: a stage of `reduce --equations` as it is printed, read back, and evaluated at numbers. */
#ifndef NH_TESTS_REDUCED_SHEET_H
#define NH_TESTS_REDUCED_SHEET_H

#include "oracle.h"
#include "program.h"

#include "graph/dag.h"
#include "graph/node.h"

static inline const char *text_of(const cJSON *item, const char *key)
{
    const cJSON *value = cJSON_GetObjectItem(item, key);
    return cJSON_IsString(value) ? value->valuestring : "";
}


/* A stage of `reduce --equations` as JSON, and how its expressions are evaluated: at (q, q', w, nu). */
typedef struct {
    place p;
    nh_system *system;
    cJSON *root;
    const cJSON *stage, *geometry;
    size_t names;
    nh_named name[80];      /* velocities of the group and of S: symbols of their own */
    size_t symbols;
    nh_ex symbol[80];
    double value[80];
} reduced_sheet;

/* file: of the project, or the name of `text`. */
static inline reduced_sheet reduced_from(const char *file, const char *text, size_t settings, const nh_setting *setting, const char *line, size_t stage)
{
    reduced_sheet s = {.p = place_make()};
    nh_error error = {0};
    char whole[2 * PATH_MAX], command[2000], number[24][60], *argument[96] = {s.p.program};
    size_t count = 1;
    snprintf(whole, sizeof whole, "%s/%s", s.p.project, file);
    if (text) write_here(&s.p, "system.yaml", text);
    else copy_here(&s.p, whole, "system.yaml");
    snprintf(command, sizeof command, "reduce system.yaml --equations --until 0.01 --quiet --json=r.json%s", line);
    cut_words(command, argument, count);
    while (argument[count]) count++;
    for (size_t i = 0; i < settings; i++) {
        snprintf(number[i], sizeof number[i], "%s=%.17g", setting[i].name, setting[i].value);
        argument[count++] = "--set";
        argument[count++] = number[i];
    }
    finished f = run_vector(&s.p, &(manner){0}, argument);
    cr_assert_eq(f.code, 0, "%s: %s%s", file, f.out, f.err);
    finished_clear(&f);
    char *json = read_here(&s.p, "r.json");
    s.root = cJSON_Parse(json);
    free(json);
    s.stage = cJSON_GetArrayItem(oracle_get(s.root, "stages"), (int)stage);
    s.geometry = oracle_get(s.stage, "geometry");
    s.system = text ? nh_system_parse(file, text, settings, setting, &error) : nh_system_read(file, settings, setting, &error);
    must(s.system != NULL, &error, file);
    for (size_t i = 0; i < s.system->coordinates; i++) {
        s.symbol[s.symbols++] = s.system->coordinate[i].q;
        s.symbol[s.symbols++] = s.system->coordinate[i].v;
        /* the value on a slice of a coordinate that the group moves */
        char slice[2][80];
        snprintf(slice[0], sizeof slice[0], "%s_s", s.system->coordinate[i].name);
        snprintf(slice[1], sizeof slice[1], "%s_s'", s.system->coordinate[i].name);
        for (size_t k = 0; k < 2; k++)
            s.name[s.names++] = (nh_named){.name = nh_name_of(s.system->dag, nh_symbol(s.system->dag, slice[k])),
                                           .value = k ? s.system->coordinate[i].v : s.system->coordinate[i].q};
    }
    return s;
}

static inline reduced_sheet reduced_of(const char *file, size_t settings, const nh_setting *setting, const char *line, size_t stage)
{
    return reduced_from(file, NULL, settings, setting, line, stage);
}

static inline void reduced_clear(reduced_sheet *s)
{
    cJSON_Delete(s->root);
    nh_system_free(s->system);
    place_clear(&s->p);
}

/* A name that the system file does not have. */
static inline size_t own_name(reduced_sheet *s, const char *text)
{
    nh_ex e = nh_symbol(s->system->dag, text);
    s->name[s->names++] = (nh_named){.name = nh_name_of(s->system->dag, e), .value = e};
    s->symbol[s->symbols] = e;
    return s->symbols++;
}

static inline double value_of(const reduced_sheet *s, const char *text)
{
    nh_error error = {0};
    nh_ex e;
    const nh_ex *parameter;
    const double *numbers;
    double out;
    must(nh_system_expression_text(s->system, "test", text, s->names, s->name, &e, &error), &error, text);
    nh_system_bindings(s->system, &parameter, &numbers);
    nh_tape *tape = nh_tape_create(s->system->dag, s->symbols, s->symbol, 1, &e, s->system->parameters, parameter, numbers);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, s->value, &out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return out;
}

/* The coefficient of a factor in the line with this label; 0 where there is none. */
static inline double shown_value(const reduced_sheet *s, const char *section, const char *label, const char *of)
{
    const cJSON *line, *term;
    cJSON_ArrayForEach(line, cJSON_GetObjectItem(s->geometry, section)) {
        if (strcmp(text_of(line, "label"), label)) continue;
        if (!of[0] && cJSON_GetObjectItem(line, "expression")) return value_of(s, text_of(line, "expression"));
        cJSON_ArrayForEach(term, cJSON_GetObjectItem(line, "terms"))
            if (!strcmp(text_of(term, "of"), of)) return value_of(s, text_of(term, "coefficient"));
    }
    return 0;
}

static inline void set_state(reduced_sheet *s, const double *q, const double *v)
{
    for (size_t i = 0; i < s->system->coordinates; i++) s->value[2 * i] = q[i], s->value[2 * i + 1] = v[i];
}

#endif
