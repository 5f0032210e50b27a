#include "report/motion.h"

#include <math.h>

#include "base/json.h"
#include "base/memory.h"

static void put(nh_text *out, double x)
{
    char text[40];
    nh_text_number(x, text, sizeof text);
    nh_text_add(out, isfinite(x) ? text : ""); /* an empty field: it has no value there */
}

void nh_motion_csv(const nh_simulation *s, nh_text *out)
{
    nh_text_add(out, "t");
    for (size_t k = 0; k < s->columns; k++) nh_text_addf(out, ",%s", s->column[k].name);
    nh_text_add(out, "\n");
    for (size_t i = 0; i < s->motion->count; i++) {
        put(out, s->motion->time[i]);
        for (size_t k = 0; k < s->columns; k++) {
            nh_text_add(out, ",");
            put(out, s->value[i * s->columns + k]);
        }
        nh_text_add(out, "\n");
    }
}

char *nh_motion_json(const nh_simulation *s)
{
    static const char *const groups[] = {"states", "currents", "multipliers", "energies", "watch"};
    nh_json *root = nh_json_object();
    nh_json_put_number(root, "schema", 1);
    nh_json_put_text(root, "method", s->method);
    nh_json_put_text(root, "formulation", s->formulation);
    nh_json_put_text(root, "scene", s->scene);
    nh_json_put_number(root, "tolerance", s->tolerance);
    nh_json_put_bool(root, "complete", s->motion->complete);
    nh_json_put_numbers(root, "time", s->motion->count, s->motion->time, 1);
    for (int kind = NH_COLUMN_STATE; kind <= NH_COLUMN_WATCH; kind++) {
        nh_json *group = nh_json_put_object(root, groups[kind]);
        for (size_t k = 0; k < s->columns; k++)
            if ((int)s->column[k].kind == kind) nh_json_put_numbers(group, s->column[k].name, s->motion->count, s->value + k, s->columns);
    }
    nh_json *stats = nh_json_put_object(root, "stats");
    nh_json_put_number(stats, "evaluations", (double)s->motion->evaluations);
    nh_json_put_number(stats, "steps", (double)s->motion->steps);
    nh_json_put_number(stats, "seconds", s->motion->seconds);
    nh_json *warnings = nh_json_put_array(root, "warnings");
    if (s->motion->note[0]) nh_json_add_text(warnings, s->motion->note);
    return nh_json_finish(root);
}
