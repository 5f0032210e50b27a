#include "document/scan.h"

#include <math.h>
#include <string.h>

#include "base/escape.h"

/* ---- JSON ---- */

static bool taken(const char *name)
{
    static const char *const keys[] = {"at",    "numbers", "dimension", "spectrum", "generic", "exact",
                                       "along", "kind",    "confirmed", "why",      "below",   "above"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (!strcmp(name, keys[i])) return true;
    return false;
}

/* The parameters as members of their own, and all of them, exact, in `at`. */
static void put_place(const nh_scan *x, size_t point, const nh_scan_special *s, nh_json *to)
{
    for (size_t a = 0; a < x->axes; a++)
        if (!taken(x->axis[a].name))
            nh_json_put_number(to, x->axis[a].name, s && s->axis == a ? s->value : nh_scan_at(x, point, a)->value);
    nh_json *at = nh_json_put_object(to, "at");
    for (size_t a = 0; a < x->axes; a++)
        nh_json_put_text(at, x->axis[a].name, s && s->axis == a ? s->exact : nh_scan_at(x, point, a)->text);
}

static void put_numbers(const nh_scan *x, const double *number, nh_json *to)
{
    nh_json_put_number(to, "dimension", number[0]);
    nh_json *list = nh_json_put_object(to, "numbers");
    for (size_t i = 0; i < x->source->count; i++) nh_json_put_number(list, x->source->name[i], number[i]);
}

static void put_points(const nh_scan *x, nh_json *root)
{
    nh_json *list = nh_json_put_array(root, "points");
    for (size_t i = 0; i < x->points; i++) {
        if (!x->row[i].done) continue;
        nh_json *item = nh_json_add_object(list);
        put_place(x, i, NULL, item);
        put_numbers(x, x->row[i].number, item);
        nh_json *spectrum = nh_json_put_array(item, "spectrum");
        for (size_t k = 0; k < x->spaces; k++)
            if (x->columns[k]) nh_json_add_number(spectrum, nh_scan_sigma(x, i, k));
        nh_json_put_text(item, "why", x->row[i].why);
    }
}

static void put_special_list(const nh_scan *x, nh_json *root)
{
    static const char *const kinds[] = {"hit", "step", "dip"};
    nh_json *list = nh_json_put_array(root, "special");
    for (size_t i = 0; i < x->specials; i++) {
        const nh_scan_special *s = &x->special[i];
        nh_json *item = nh_json_add_object(list);
        put_place(x, s->place, s, item);
        nh_json_put_text(item, "along", x->axis[s->axis].name);
        nh_json_put_text(item, "kind", kinds[s->kind]);
        put_numbers(x, s->number, item);
        nh_json_put_number(item, "generic", s->generic);
        nh_json_put_number(item, "below", s->below);
        nh_json_put_number(item, "above", s->above);
        nh_json_put_bool(item, "confirmed", s->confirmed);
        nh_json_put_text(item, "why", s->why);
    }
}

char *nh_scan_json(const nh_scan *x, const nh_run *run)
{
    nh_json *root = nh_json_object(), *list;
    nh_json_put_number(root, "schema", 1);
    nh_json_put_text(root, "version", NH_VERSION);
    nh_json_put_text(root, "system", x->system->name);
    nh_json_put_text(root, "of", x->source->of);
    list = nh_json_put_array(root, "over");
    for (size_t a = 0; a < x->axes; a++) nh_json_add_text(list, x->axis[a].name);
    list = nh_json_put_array(root, "numbers");
    for (size_t i = 0; i < x->source->count; i++) nh_json_add_text(list, x->source->name[i]);
    list = nh_json_put_array(root, "spaces");
    for (size_t k = 0; k < x->spaces; k++) {
        if (!x->columns[k]) continue;
        nh_json *item = nh_json_add_object(list);
        nh_json_put_text(item, "name", x->space[k]);
        nh_json_put_number(item, "columns", (double)x->columns[k]);
    }
    put_points(x, root);
    put_special_list(x, root);
    nh_json_put_bool(root, "partial", x->partial);
    nh_run_json(run, x->system, root);
    return nh_json_finish(root);
}

/* ---- CSV ---- */

static void put_field(nh_text *out, double value)
{
    char text[40];
    nh_text_number(value, text, sizeof text);
    nh_text_addf(out, ",%s", isfinite(value) ? text : "");
}

void nh_scan_csv(const nh_scan *x, nh_text *out)
{
    for (size_t a = 0; a < x->axes; a++) nh_text_addf(out, "%s%s", a ? "," : "", x->axis[a].name);
    for (size_t i = 0; i < x->source->count; i++) nh_text_addf(out, ",%s", x->source->name[i]);
    for (size_t k = 0; k < x->spaces; k++)
        if (x->columns[k]) nh_text_addf(out, ",sigma%zu", k + 1);
    nh_text_add(out, ",why\n");
    for (size_t i = 0; i < x->points; i++) {
        const nh_scan_row *r = &x->row[i];
        if (!r->done) continue;
        for (size_t a = 0; a < x->axes; a++) {
            char text[40];
            nh_text_number(nh_scan_at(x, i, a)->value, text, sizeof text);
            nh_text_addf(out, "%s%s", a ? "," : "", text);
        }
        for (size_t k = 0; k < x->source->count; k++) put_field(out, r->number[k]);
        for (size_t k = 0; k < x->spaces; k++)
            if (x->columns[k]) put_field(out, nh_scan_sigma(x, i, k));
        nh_text_add(out, ",");
        if (r->why) nh_escape_csv(r->why, out);
        nh_text_add(out, "\n");
    }
}
