#include "document/scan.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/escape.h"
#include "base/json.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "commands/analyze.h"
#include "document/analysis.h"
#include "document/reduction.h"

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

/* ---- any number of a document ---- */

typedef struct {
    nh_request request;
    char *(*document)(const nh_request *q, bool generic, nh_error *error);
    size_t names;
    const char **name;
} numbers;

/* ---- documents ---- */

static char *count_json(const nh_count *c, size_t degree)
{
    nh_json *root = nh_json_object();
    const nh_count_row *last = c->rows && !c->obstacle ? &c->row[c->rows - 1] : NULL;
    bool reached = last && last->degree == degree && last->bounded;
    nh_json_put_number(root, "dimension", reached ? (double)last->bound : NAN);
    nh_json_put_number(root, "independent", reached ? (double)last->rank : NAN);
    nh_json_put_number(root, "degree", last ? (double)last->degree : NAN);
    nh_json_put_number(root, "order", last ? (double)last->order : NAN);
    nh_json_put_bool(root, "settled", last && last->settled);
    nh_json *list = nh_json_put_array(root, "degrees");
    for (size_t d = 0; d < c->rows && last; d++) {
        nh_json *item = nh_json_add_object(list);
        nh_json_put_number(item, "degree", (double)c->row[d].degree);
        nh_json_put_number(item, "dimension", c->row[d].bounded ? (double)c->row[d].bound : NAN);
        nh_json_put_number(item, "independent", c->row[d].bounded ? (double)c->row[d].rank : NAN);
    }
    return nh_json_finish(root);
}

static size_t chosen_degree(const nh_request *q, const nh_model *model)
{
    enum { few = 4, high = 4, low = 2 };
    if (q->options.degree > 0) return (size_t)q->options.degree;
    return model->m <= few ? high : low;
}

static char *count_document(const nh_request *q, bool generic, nh_error *error)
{
    nh_system *system = nh_system_read(q->system_path, q->settings, q->setting, error);
    nh_chart *chart = system ? nh_chart_create(system, NH_CHART_AUTO, (uint64_t)q->options.seed, error) : NULL;
    nh_model *model = chart ? nh_model_create(system, chart, error) : NULL;
    char *text = NULL;
    if (model) {
        size_t degree = chosen_degree(q, model);
        nh_count_question question = {.degree = degree,
                                      .work = q->options.count_work,
                                      .threads = nh_threads(q->options.threads),
                                      .generic = generic};
        nh_count c = nh_count_integrals(model, &question);
        text = count_json(&c, degree);
        if (c.obstacle) nh_fail(error, NH_NUMERIC, "", "%s", c.obstacle);
        else if (c.rows < degree)
            nh_fail(error, NH_LIMIT, "", "counting at degree %zu needs more than the option `count_work`", degree);
    }
    nh_model_free(model);
    nh_system_free(system);
    return text;
}

static char *analysis_document(const nh_request *q, bool generic, nh_error *error)
{
    (void)generic;
    nh_analysis *result = nh_analysis_create(q, error);
    char *text = result ? nh_analysis_json(result) : NULL;
    nh_analysis_free(result);
    return text;
}

static char *reduction_document(const nh_request *q, bool generic, nh_error *error)
{
    (void)generic;
    nh_reduction *r = nh_reduction_create(q, error);
    char *text = r ? nh_reduction_json(r, NULL) : NULL;
    nh_reduction_free(r);
    return text;
}

/* The first name is the leading number; the others are shown when the user names none. */
static const struct {
    const char *of, *name[3];
    char *(*document)(const nh_request *, bool, nh_error *);
    bool spectra;
} commands[] = {
    {"count", {"dimension", "independent"}, count_document, true},
    {"analyze", {"independent_currents", "currents"}, analysis_document, true},
    {"reduce", {"group.dimension", "stages"}, reduction_document, false},
};
enum { command_count = sizeof commands / sizeof *commands };

/* ---- paths ---- */

/* The entry with that name or number; *last: its name. */
static const nh_json *step(const nh_json *from, const char *word, size_t length)
{
    char key[200];
    if (!from || length == 0 || length >= sizeof key) return NULL;
    memcpy(key, word, length);
    key[length] = 0;
    if (isdigit((unsigned char)key[0]))
        return nh_json_count(from) > strtoul(key, NULL, 10) ? nh_json_entry(from, strtoul(key, NULL, 10)) : NULL;
    return nh_json_get(from, key);
}

static const nh_json *follow(const nh_json *from, const char *path)
{
    while (from && *path) {
        size_t length = strcspn(path, ".");
        from = step(from, path, length);
        path += length + (path[length] == '.');
    }
    return from;
}

static bool is_time(const char *path)
{
    static const char *const words[] = {"seconds", "speedup", "times", "effort"};
    const char *last = strrchr(path, '.') ? strrchr(path, '.') + 1 : path;
    size_t length = strlen(last);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (!strcmp(last, words[i])) return true;
    return !strncmp(path, "timing", 6) || (length > 2 && !strcmp(last + length - 2, "_s"));
}

static bool numbers_at(void *context, nh_arena *arena, size_t settings, const nh_setting *setting, bool generic,
                       double *number, const char **why)
{
    const numbers *x = context;
    nh_error error;
    nh_error_clear(&error);
    *why = NULL;
    nh_request q = x->request;
    q.settings = settings, q.setting = setting;
    char *text = x->document(&q, generic, &error);
    nh_json *root = text ? nh_json_parse(text) : NULL;
    for (size_t i = 0; i < x->names; i++) number[i] = nh_json_size(follow(root, x->name[i]));
    if (error.code != NH_OK) *why = nh_arena_strdup(arena, error.what);
    else if (!isfinite(number[0])) *why = "the command gives no such number there";
    nh_json_free(root);
    nh_free(text);
    return !nh_interrupted();
}

/* ---- the request ---- */

static bool choose(const nh_request *q, size_t *command, nh_error *error)
{
    const char *names[command_count];
    for (*command = 0; *command < command_count; ++*command) {
        names[*command] = commands[*command].of;
        if (!q->of || !strcmp(q->of, names[*command])) return true;
    }
    nh_fail(error, NH_USAGE, "", "--of does not know `%s`", q->of);
    return nh_error_hint_near(error, q->of, names, command_count, "--of takes count, analyze or reduce");
}

/* Where a path leaves the document: an error with the nearest of the existing names. */
static bool no_number(const nh_json *root, const char *path, const char *of, nh_error *error)
{
    const nh_json *at = root;
    const char *word = path;
    for (const nh_json *next; *word && (next = step(at, word, strcspn(word, "."))); at = next) {
        word += strcspn(word, ".");
        word += *word == '.';
    }
    if (!*word) return nh_fail(error, NH_USAGE, "", "--number %s: this is not a number in the JSON of %s", path, of);
    const char *names[200];
    size_t n = nh_json_names(at, sizeof names / sizeof *names, names);
    nh_fail(error, NH_USAGE, "", "--number %s: there is no `%.*s` in the JSON of %s", path, (int)strcspn(word, "."),
            word, of);
    const char *near = nh_text_nearest(word, names, n);
    if (near) return nh_error_hint(error, "did you mean `%.*s%s`?", (int)(word - path), path, near);
    return nh_error_hint(error, "a number is named by its path, as in group.dimension or currents.0.drift");
}

/* Does the document have the names, for the values of the file?  Entries of lists may be missing. */
static bool are_there(const numbers *x, const char *of, nh_error *error)
{
    nh_error failure;
    nh_error_clear(&failure);
    nh_progress("which numbers there are", -1);
    char *text = x->document(&x->request, false, &failure);
    nh_json *root = text ? nh_json_parse(text) : NULL;
    bool good = true;
    for (size_t i = 0; good && root && i < x->request.numbers; i++) {
        const char *path = x->request.number[i];
        const nh_json *found = follow(root, path);
        bool listed = path[strcspn(path, "0123456789")] != 0;
        if (!listed && (!found || nh_json_is_text(found))) good = no_number(root, path, of, error);
    }
    nh_json_free(root);
    nh_free(text);
    return good;
}

bool nh_scan_numbers(nh_arena *arena, const nh_request *q, nh_scan_source *out, nh_error *error)
{
    size_t k;
    if (!choose(q, &k, error)) return false;
    if (q->numbers >= NH_SCAN_MOST_NUMBERS)
        return nh_fail(error, NH_USAGE, "", "--number is given %zu times, but a scan has at most %d numbers",
                       q->numbers, NH_SCAN_MOST_NUMBERS - 1);
    numbers *x = nh_arena_alloc(arena, sizeof *x);
    *x = (numbers){.request = *q, .document = commands[k].document};
    x->request.documents = false;
    x->request.options.max_seconds = INFINITY; /* counted work ends a computation, and not the clock */
    x->name = nh_arena_alloc(arena, (q->numbers + 3) * sizeof *x->name);
    x->name[x->names++] = commands[k].name[0];
    if (!q->numbers) x->name[x->names++] = commands[k].name[1];
    for (size_t i = 0; i < q->numbers; i++) {
        if (is_time(q->number[i])) {
            nh_fail(error, NH_USAGE, "", "--number %s: this is a time, which is not the same twice", q->number[i]);
            return nh_error_hint(error, "`nhsym benchmark` measures times");
        }
        if (strcmp(q->number[i], x->name[0])) x->name[x->names++] = q->number[i];
    }
    *out = (nh_scan_source){.of = commands[k].of,
                            .count = x->names,
                            .name = x->name,
                            .usual = !q->numbers,
                            .spectra = commands[k].spectra,
                            .at = numbers_at,
                            .context = x};
    return !q->numbers || are_there(x, commands[k].of, error);
}
