#include "document/scan.h"

#include <math.h>
#include <string.h>

const char *const nh_scan_caution =
    "A scan is a search by numbers: it misses special values between points whose dip is narrower than the grid, and those of integrals "
    "outside of its ansatz spaces. nhsym classify excludes values by proof where the parameter allows it.";

/* ---- words ---- */

static bool alike(const nh_scan_special *a, const nh_scan_special *b)
{
    return a->axis == b->axis && a->exact && b->exact && !strcmp(a->exact, b->exact) && a->confirmed == b->confirmed
           && a->generic == b->generic && a->number[0] == b->number[0];
}

size_t nh_scan_alike(const nh_scan *x, size_t special)
{
    size_t n = 0;
    for (size_t i = 0; i < x->specials; i++) {
        if (i != special && !alike(&x->special[i], &x->special[special])) continue;
        if (i < special) return 0;
        n++;
    }
    return n;
}

const char *nh_scan_where(const nh_scan *x, size_t special)
{
    const nh_scan_special *s = &x->special[special];
    nh_text text;
    size_t lines = nh_scan_alike(x, special);
    nh_text_init(&text);
    if (!s->exact) nh_text_addf(&text, "%s = %.10g", x->axis[s->axis].name, s->value);
    else if (strspn(s->exact, "-0123456789/") == strlen(s->exact)) nh_text_addf(&text, "%s = %s", x->axis[s->axis].name, s->exact);
    else nh_text_addf(&text, "%s = %s = %.10g", x->axis[s->axis].name, s->exact, s->value);
    for (size_t a = 0; a < x->axes && lines < 2; a++)
        if (a != s->axis) nh_text_addf(&text, ", %s = %s", x->axis[a].name, nh_scan_at(x, s->place, a)->text);
    if (lines > 1) nh_text_addf(&text, ", for %zu of the other values", lines);
    const char *out = nh_arena_strdup(x->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

const char *nh_scan_what(const nh_scan *x, const nh_scan_special *s)
{
    const char *name = x->source->name[0];
    double here = s->number[0];
    if (s->kind == NH_SCAN_STEP && isfinite(here))
        return nh_arena_printf(x->arena, "%s is %g below, %g there and %g above", name, s->below, here, s->above);
    if (s->kind == NH_SCAN_STEP) return nh_arena_printf(x->arena, "%s is %g below and %g above; %s", name, s->below, s->above, s->why);
    if (s->confirmed) return nh_arena_printf(x->arena, "%s is %g instead of %g: confirmed with the exact value", name, here, s->generic);
    if (s->space) return nh_arena_printf(x->arena, "not confirmed: one more current in the space `%s`, but %s", s->space, s->why);
    return nh_arena_printf(x->arena, "not confirmed: %s", s->why);
}

/* "dimension: 2 at 60 points, 3 at 1" */
static void put_counts(const nh_scan *x, size_t number, nh_text *out)
{
    double *value = nh_alloc_array(x->points + 1, sizeof *value);
    size_t *times = nh_alloc_array(x->points + 1, sizeof *times), n = 0, missing = 0;
    enum { most = 12 };
    for (size_t i = 0; i < x->points; i++) {
        double v = x->row[i].done ? x->row[i].number[number] : NAN;
        size_t k = 0;
        if (!isfinite(v)) {
            missing++;
            continue;
        }
        while (k < n && value[k] != v) k++;
        if (k == n) value[n++] = v;
        times[k]++;
    }
    nh_text_addf(out, "  %s: ", x->source->name[number]);
    if (n > most) {
        double low = INFINITY, high = -INFINITY;
        for (size_t k = 0; k < n; k++) low = fmin(low, value[k]), high = fmax(high, value[k]);
        nh_text_addf(out, "from %.6g to %.6g", low, high);
    }
    for (size_t k = 0; k < n && n <= most; k++) nh_text_addf(out, "%s%.6g at %zu point%s", k ? ", " : "", value[k], times[k], times[k] == 1 ? "" : "s");
    if (missing) nh_text_addf(out, "%snone at %zu point%s", n ? ", " : "", missing, missing == 1 ? "" : "s");
    nh_text_add(out, "\n");
    nh_free(value);
    nh_free(times);
}

static const char *reason(const nh_scan *x)
{
    for (size_t i = 0; i < x->points; i++)
        if (x->row[i].done && x->row[i].why) return x->row[i].why;
    return NULL;
}

static void put_grid(const nh_scan *x, nh_text *out)
{
    nh_text_addf(out, "%s\nnumbers of `%s` over ", x->system->title, x->source->of);
    for (size_t a = 0; a < x->axes; a++) {
        const nh_scan_axis *p = &x->axis[a];
        nh_text_addf(out, "%s%s = %s .. %s (%zu)", a ? ", " : "", p->name, p->value[0].text, p->value[p->count - 1].text, p->count);
    }
    nh_text_addf(out, ": %zu point%s\n\n", x->points, x->points == 1 ? "" : "s");
}

static void put_specials(const nh_scan *x, nh_text *out)
{
    for (int kind = 0; kind < 2; kind++) {
        bool headed = false;
        for (size_t i = 0; i < x->specials; i++) {
            const nh_scan_special *s = &x->special[i];
            bool sure = s->confirmed || s->kind == NH_SCAN_STEP;
            if (sure != (kind == 0) || !nh_scan_alike(x, i)) continue;
            if (!headed) nh_text_add(out, kind == 0 ? "\nSpecial values\n" : "\nPerhaps special\n");
            headed = true;
            nh_text_addf(out, "  %s\n    %s\n", nh_scan_where(x, i), nh_scan_what(x, s));
        }
    }
    if (!x->specials && !x->partial) nh_text_add(out, "\nNo special value was found.\n");
}

void nh_scan_text(const nh_scan *x, bool verbose, nh_text *out)
{
    put_grid(x, out);
    if (x->chunked) {
        nh_text_addf(out, "This part: %zu of %zu units are finished. When all parts are, the same command without --chunk writes the result.\n", x->finished, x->units);
        return;
    }
    for (size_t i = 0; i < x->source->count; i++) put_counts(x, i, out);
    if (reason(x)) nh_text_addf(out, "  at some points: %s\n", reason(x));
    if (x->partial && x->finished < x->units)
        nh_text_addf(out, "\nNot finished: %zu of %zu units. The same command continues.\n", x->finished, x->units);
    else if (x->partial) nh_text_addf(out, "\nNot finished: %zu jumps remain to be looked at. The same command continues.\n", x->unrefined);
    put_specials(x, out);
    for (size_t i = 0; verbose && i < x->spaces; i++)
        if (x->columns[i]) nh_text_addf(out, "%s  %3zu functions: %s\n", i ? "" : "\nAnsatz spaces\n", x->columns[i], x->space[i]);
    nh_text_addf(out, "\n%s\n", nh_scan_caution);
}

/* ---- JSON ---- */

static bool taken(const char *name)
{
    static const char *const keys[] = {"at", "numbers", "dimension", "spectrum", "generic", "exact", "along", "kind", "confirmed", "why", "below", "above"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (!strcmp(name, keys[i])) return true;
    return false;
}

/* The parameters as members of their own, and all of them, exact, in `at`. */
static void put_place(const nh_scan *x, size_t point, const nh_scan_special *s, nh_json *to)
{
    for (size_t a = 0; a < x->axes; a++)
        if (!taken(x->axis[a].name)) nh_json_put_number(to, x->axis[a].name, s && s->axis == a ? s->value : nh_scan_at(x, point, a)->value);
    nh_json *at = nh_json_put_object(to, "at");
    for (size_t a = 0; a < x->axes; a++) nh_json_put_text(at, x->axis[a].name, s && s->axis == a ? s->exact : nh_scan_at(x, point, a)->text);
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

/* RFC 4180 */
static void put_quoted(nh_text *out, const char *text)
{
    nh_text_add(out, "\"");
    for (; *text; text++) nh_text_add(out, *text == '"' ? "\"\"" : (const char[]){*text, 0});
    nh_text_add(out, "\"");
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
        if (r->why) put_quoted(out, r->why);
        nh_text_add(out, "\n");
    }
}
