/* docs/schema: the JSON of analyze, show, verify, classify, scan, export, benchmark, simulate, reduce and linearize is checked by the part of JSON Schema
 * that these files use. */
#include <cjson/cJSON.h>

#include "base/text.h"
#include "program.h"
#include "sweep.h"

typedef struct {
    char fault[400];
} verdict;

static const char *type_of(const cJSON *v)
{
    return cJSON_IsNull(v) ? "null" : cJSON_IsBool(v) ? "boolean" : cJSON_IsNumber(v) ? "number" : cJSON_IsString(v) ? "string" : cJSON_IsArray(v) ? "array" : "object";
}

static bool is_type(const cJSON *type, const char *name)
{
    if (cJSON_IsString(type)) return !strcmp(type->valuestring, name);
    for (const cJSON *t = type->child; t; t = t->next)
        if (!strcmp(t->valuestring, name)) return true;
    return false;
}

static bool no(verdict *out, const char *where, const char *why, const char *detail)
{
    snprintf(out->fault, sizeof out->fault, "%s: %s %s", where, why, detail);
    return false;
}

static bool fits(const cJSON *schema, const cJSON *v, const char *where, verdict *out);

static bool members_fit(const cJSON *schema, const cJSON *v, const char *where, verdict *out)
{
    const cJSON *properties = cJSON_GetObjectItemCaseSensitive(schema, "properties"), *others = cJSON_GetObjectItemCaseSensitive(schema, "additionalProperties");
    for (const cJSON *m = v->child; m; m = m->next) {
        char path[300];
        snprintf(path, sizeof path, "%.200s.%.80s", where, m->string);
        const cJSON *own = cJSON_GetObjectItemCaseSensitive(properties, m->string);
        if (!own && cJSON_IsFalse(others)) return no(out, path, "is not in the schema", "");
        if (own || cJSON_IsObject(others)) {
            if (!fits(own ? own : others, m, path, out)) return false;
        }
    }
    const cJSON *required = cJSON_GetObjectItemCaseSensitive(schema, "required");
    for (const cJSON *k = required ? required->child : NULL; k; k = k->next)
        if (!cJSON_GetObjectItemCaseSensitive(v, k->valuestring)) return no(out, where, "lacks", k->valuestring);
    return true;
}

/* "#/$defs/NAME": of the document that holds the schema. */
static cJSON *whole;
static const cJSON *named(const char *reference)
{
    static const char begin[] = "#/$defs/";
    cr_assert(!strncmp(reference, begin, sizeof begin - 1), "%s", reference);
    const cJSON *all = cJSON_GetObjectItemCaseSensitive(whole, "$defs"),
                *own = cJSON_GetObjectItemCaseSensitive(all, reference + sizeof begin - 1);
    cr_assert_not_null(own, "%s", reference);
    return own;
}

/* Exactly one of the forms. */
static bool fits_one(const cJSON *forms, const cJSON *v, const char *where, verdict *out)
{
    int count = 0;
    nh_text all;
    nh_text_init(&all);
    for (const cJSON *form = forms->child; form; form = form->next) {
        verdict of = {""};
        if (fits(form, v, where, &of)) count++;
        else nh_text_addf(&all, "; %s", of.fault);
    }
    if (count != 1) no(out, where, count ? "has several forms" : "has no form", nh_text_string(&all));
    nh_text_clear(&all);
    return count == 1;
}

static bool fits(const cJSON *schema, const cJSON *v, const char *where, verdict *out)
{
    const cJSON *reference = cJSON_GetObjectItemCaseSensitive(schema, "$ref"),
                *forms = cJSON_GetObjectItemCaseSensitive(schema, "oneOf");
    if (reference) return fits(named(reference->valuestring), v, where, out);
    if (forms && !fits_one(forms, v, where, out)) return false;
    const cJSON *type = cJSON_GetObjectItemCaseSensitive(schema, "type"), *items = cJSON_GetObjectItemCaseSensitive(schema, "items");
    const cJSON *fixed = cJSON_GetObjectItemCaseSensitive(schema, "const"), *choices = cJSON_GetObjectItemCaseSensitive(schema, "enum");
    if (type && !is_type(type, type_of(v))) return no(out, where, "is a", type_of(v));
    if (fixed && !cJSON_Compare(fixed, v, true)) return no(out, where, "is another value", "");
    bool chosen = !choices;
    for (const cJSON *c = choices ? choices->child : NULL; c; c = c->next) chosen |= cJSON_Compare(c, v, true);
    if (!chosen) return no(out, where, "is none of the values", cJSON_IsString(v) ? v->valuestring : "");
    if (cJSON_IsObject(v)) return members_fit(schema, v, where, out);
    for (const cJSON *e = cJSON_IsArray(v) && cJSON_IsObject(items) ? v->child : NULL; e; e = e->next)
        if (!fits(items, e, where, out)) return false;
    return true;
}

static cJSON *read_json(const char *path)
{
    FILE *file = fopen(path, "r");
    cr_assert_not_null(file, "%s", path);
    char *text = read_stream(file);
    fclose(file);
    cJSON *root = cJSON_Parse(text);
    cr_assert_not_null(root, "%s", path);
    free(text);
    return root;
}

/* With and without constraints, unknowns, stages, a drawing, a second chart, a motion, nearly conserved quantities, series. */
static const char *const LINES[] = {
    "sleigh --equations", "sleigh --no-analysis --option work=600", "free_particle", "heisenberg_particle --option work=600", "appell_hamel --option work=600", "lagrange_top --option work=600",
    "routh_sphere --option work=1200", "henon_heiles --option work=600", "spherical_pendulum --option work=600", "rolling_disk --option work=1200", "contact_oscillator --option work=600",
};

Test(schema, what_analyze_writes_fits, PLAIN_ONLY)
{
    cJSON *schema = read_json("docs/schema/analyze.json");
    place p = place_make();
    for (size_t i = 0; i < sizeof LINES / sizeof *LINES; i++) {
        if (!sweep_tries(i, 8, 16)) continue;
        char line[300], environment[PATH_MAX + 30], path[PATH_MAX + 30];
        snprintf(environment, sizeof environment, "NHSYM_PATH=%s", p.project);
        snprintf(line, sizeof line, "analyze %s --quiet --json r.json", LINES[i]);
        finished f = run_so(&p, &(manner){.environment = (const char *const[]){environment, NULL}}, line);
        cr_assert(f.code == 0 || f.code == 5, "%s: %s", line, f.err);
        snprintf(path, sizeof path, "%s/r.json", p.folder);
        cJSON *root = read_json(path);
        verdict v = {""};
        cr_expect(fits(schema, root, "", &v), "%s: %s", LINES[i], v.fault);
        /* the check can fail: a key too many, a key too few, another type */
        cJSON_AddNumberToObject(cJSON_GetObjectItem(root, "samples"), "more", 1);
        cr_expect_not(fits(schema, root, "", &v), "an unknown key");
        cJSON_DeleteItemFromObject(cJSON_GetObjectItem(root, "samples"), "more");
        cJSON *seed = cJSON_DetachItemFromObject(cJSON_GetObjectItem(root, "samples"), "seed");
        cr_expect_not(fits(schema, root, "", &v), "a missing key");
        cJSON_Delete(seed);
        cJSON_AddStringToObject(cJSON_GetObjectItem(root, "samples"), "seed", "one");
        cr_expect_not(fits(schema, root, "", &v), "a text for a number");
        cJSON_Delete(root);
        finished_clear(&f);
    }
    cJSON_Delete(schema);
    place_clear(&p);
}

Test(schema, what_classify_writes_fits, PLAIN_ONLY)
{
    static const char *const lines[] = {"classify/henon_heiles.yaml --over eps", "classify/atwood.yaml --over mu --degree 2", "classify/knife.yaml --over b --degree 1 --shape",
                                        "classify/quartic.yaml --over mu,b --degree 2"};
    cJSON *schema = read_json("docs/schema/classification.json");
    place p = place_make();
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        char line[600], path[PATH_MAX + 30];
        snprintf(line, sizeof line, "classify %.300s/tests/data/%s --quiet --json c.json", p.project, lines[i]);
        finished f = run(&p, line);
        cr_assert(f.code == 0, "%s: %s", line, f.err);
        snprintf(path, sizeof path, "%s/c.json", p.folder);
        cJSON *root = read_json(path);
        verdict v = {""};
        cr_expect(fits(schema, root, "", &v), "%s: %s", lines[i], v.fault);
        cr_expect(cJSON_GetArraySize(cJSON_GetObjectItem(root, "degrees")) > 0);
        cJSON_AddNumberToObject(cJSON_GetArrayItem(cJSON_GetObjectItem(root, "degrees"), 0), "more", 1);
        cr_expect_not(fits(schema, root, "", &v), "an unknown key");
        cJSON_Delete(root);
        finished_clear(&f);
    }
    cJSON_Delete(schema);
    place_clear(&p);
}

Test(schema, what_classify_of_absence_writes_fits)
{
    cJSON *schema = read_json("docs/schema/classification.json");
    place p = place_make();
    char line[600], path[PATH_MAX + 30];
    snprintf(line, sizeof line, "classify %.300s/tests/data/classify/henon_heiles.yaml --over eps=1,2 --of absence --set B=1 --degree 2 --quiet --json c.json", p.project);
    finished f = run(&p, line);
    cr_assert(f.code == 0, "%s: %s", line, f.err);
    snprintf(path, sizeof path, "%s/c.json", p.folder);
    cJSON *root = read_json(path);
    verdict v = {""};
    cr_expect(fits(schema, root, "", &v), "%s", v.fault);
    cr_expect_eq(cJSON_GetArraySize(cJSON_GetObjectItem(root, "values")), 2);
    cJSON_AddNumberToObject(cJSON_GetArrayItem(cJSON_GetObjectItem(root, "values"), 0), "more", 1);
    cr_expect_not(fits(schema, root, "", &v), "an unknown key");
    cJSON_Delete(root);
    finished_clear(&f);
    cJSON_Delete(schema);
    place_clear(&p);
}

Test(schema, what_scan_writes_fits)
{
    static const char *const lines[] = {"henon_heiles.yaml --over B=1,2 --over eps=0.1:2.1:5", "atwood.yaml --over mu=1,3/2 --of reduce"};
    cJSON *schema = read_json("docs/schema/scan.json");
    place p = place_make();
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        char line[600], path[PATH_MAX + 30];
        snprintf(line, sizeof line, "scan %.300s/tests/data/classify/%s --quiet -o s%zu", p.project, lines[i], i);
        finished f = run(&p, line);
        cr_assert(f.code == 0, "%s: %s", line, f.err);
        snprintf(path, sizeof path, "%s/s%zu/scan.json", p.folder, i);
        cJSON *root = read_json(path);
        verdict v = {""};
        cr_expect(fits(schema, root, "", &v), "%s: %s", lines[i], v.fault);
        cJSON_AddStringToObject(cJSON_GetArrayItem(cJSON_GetObjectItem(root, "points"), 0), "more", "one");
        cr_expect_not(fits(schema, root, "", &v), "an unknown key that is no number");
        cJSON_Delete(root);
        finished_clear(&f);
    }
    cJSON_Delete(schema);
    place_clear(&p);
}

/* Linear systems, an iteration, no parameters, inputs. */
Test(schema, what_export_writes_fits, PLAIN_ONLY)
{
    static const char *const lines[] = {"sleigh", "snakeboard --of equations,reduced", "constant_speed --of submanifold", "implicit.yaml --of submanifold", "skate_with_friction --of equations --input c"};
    static const char implicit[] = "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\nconstraints: [\"z'^5 + z' = x'*y'\"]\n";
    cJSON *schema = read_json("docs/schema/export.json");
    place p = place_make();
    write_here(&p, "implicit.yaml", implicit);
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        if (!sweep_tries(i + 1, 2, 4)) continue;
        char line[300], environment[PATH_MAX + 30];
        snprintf(environment, sizeof environment, "NHSYM_PATH=%s", p.project);
        snprintf(line, sizeof line, "export %s --to json", lines[i]);
        finished f = run_so(&p, &(manner){.environment = (const char *const[]){environment, NULL}}, line);
        cr_assert(f.code == 0, "%s: %s", line, f.err);
        cJSON *root = cJSON_Parse(f.out);
        verdict v = {""};
        cr_expect(fits(schema, root, "", &v), "%s: %s", lines[i], v.fault);
        cJSON *functions = cJSON_GetObjectItem(root, "functions");
        cr_expect(cJSON_GetArraySize(functions) > 2);
        cJSON_AddNumberToObject(cJSON_GetArrayItem(cJSON_GetObjectItem(cJSON_GetArrayItem(functions, 0), "results"), 0), "more", 1);
        cr_expect_not(fits(schema, root, "", &v), "an unknown key");
        cJSON_Delete(root);
        finished_clear(&f);
    }
    cJSON_Delete(schema);
    place_clear(&p);
}

Test(schema, what_chart_writes_fits, PLAIN_ONLY)
{
    static const char *const lines[] = {"sleigh --budget 500ms", "ball_on_turntable --until 3 --budget 500ms", "lagrange_top --until 2 --budget 300ms"};
    cJSON *schema = read_json("docs/schema/benchmark.json");
    place p = place_make();
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        if (!sweep_tries(i + 1, 1, 3)) continue;
        char line[300], environment[PATH_MAX + 30], path[PATH_MAX + 30];
        snprintf(environment, sizeof environment, "NHSYM_PATH=%s", p.project);
        snprintf(line, sizeof line, "benchmark %s --quiet --json c.json", lines[i]);
        finished f = run_so(&p, &(manner){.environment = (const char *const[]){environment, NULL}}, line);
        cr_assert(f.code == 0, "%s: %s", line, f.err);
        snprintf(path, sizeof path, "%s/c.json", p.folder);
        cJSON *root = read_json(path);
        verdict v = {""};
        cr_expect(fits(schema, root, "", &v), "%s: %s", lines[i], v.fault);
        cr_expect(cJSON_GetArraySize(cJSON_GetObjectItem(root, "discrete")) > 0);
        cJSON_AddNumberToObject(cJSON_GetObjectItem(root, "reference"), "more", 1);
        cr_expect_not(fits(schema, root, "", &v), "an unknown key");
        cJSON_Delete(root);
        finished_clear(&f);
    }
    cJSON_Delete(schema);
    place_clear(&p);
}

/* One motion, a scene, zeros, motions together and one by one, a drawing, and what is left when there is no time. */
Test(schema, what_simulate_writes_fits)
{
    static const struct {
        const char *words, *part; /* a key of this form */
        int code;
    } lines[] = {
        {"sleigh --step 5 --accuracy 1e-8", "states", 0},
        {"sleigh --scene --step 5", "whole_model", 0},
        {"sleigh --event phi-1 --event x=0,falling --html m.html", "drawing", 0},
        {"henon_heiles --initial x'=0.4 --section x --until 20", "section", 0},
        {"sleigh --ensemble 3 --step 5", "members", 0},
        {"sleigh --ensemble 3 --step 5 --accuracy 1e-6", "members", 0},
        {"sleigh --over k=1,2 --over omega=1,2 --step 5 --watch phi", "motions", 0},
        {"snakeboard --method midpoint-4 --step 0.1 --until 1", "multipliers", 0},
        {"sleigh --option steps=10", "states", 5}, /* a limit of work */
        {"sleigh --max-seconds 1e-9", "unfinished", 5},
    };
    place p = place_make();
    whole = read_json("docs/schema/simulate.json");
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        char line[300], environment[PATH_MAX + 30], path[PATH_MAX + 30];
        snprintf(environment, sizeof environment, "NHSYM_PATH=%s", p.project);
        snprintf(line, sizeof line, "simulate %s --quiet --json m.json", lines[i].words);
        finished f = run_so(&p, &(manner){.environment = (const char *const[]){environment, NULL}}, line);
        cr_assert_eq(f.code, lines[i].code, "%s: %s", line, f.err);
        snprintf(path, sizeof path, "%s/m.json", p.folder);
        cJSON *root = read_json(path);
        verdict v = {""};
        cr_expect(fits(whole, root, "", &v), "%s: %s", lines[i].words, v.fault);
        cr_expect_not_null(cJSON_GetObjectItemCaseSensitive(root, lines[i].part), "%s: %s", line, lines[i].part);
        const cJSON *partial = cJSON_GetObjectItemCaseSensitive(root, "partial");
        cr_expect_eq(cJSON_IsTrue(partial), lines[i].code == 5, "%s", line);
        cJSON_AddNumberToObject(cJSON_GetObjectItem(root, "run"), "more", 1);
        cr_expect_not(fits(whole, root, "", &v), "an unknown key");
        cJSON_DeleteItemFromObject(cJSON_GetObjectItem(root, "run"), "more");
        cJSON_DeleteItemFromObject(root, lines[i].part);
        bool optional = !strcmp(lines[i].part, "whole_model") || !strcmp(lines[i].part, "drawing")
                        || !strcmp(lines[i].part, "section");
        cr_expect_eq(fits(whole, root, "", &v), optional, "without %s", lines[i].part);
        cJSON_Delete(root);
        finished_clear(&f);
    }
    cJSON_Delete(whole);
    place_clear(&p);
}

/* A current, a false one, fields of both kinds, a branch, the geometry. */
/* At a state, along a family, and where one value has no equations. */
Test(schema, what_linearize_writes_fits)
{
    static const char *const asked[] = {"double_pendulum --at p=pi", "rolling_disk --over h=0,1"};
    cJSON *schema = read_json("docs/schema/linearize.json");
    place p = place_with_systems();
    for (size_t i = 0; i < sizeof asked / sizeof *asked; i++) {
        char line[300];
        snprintf(line, sizeof line, "linearize %s --json -", asked[i]);
        finished f = run(&p, line);
        cr_assert(f.code == 0, "%s: %s", line, f.err);
        cJSON *root = cJSON_Parse(f.out);
        verdict v = {""};
        cr_expect(fits(schema, root, "", &v), "%s: %s", asked[i], v.fault);
        cJSON *rows = cJSON_GetObjectItem(root, "rows");
        cJSON_AddNumberToObject(rows ? cJSON_GetArrayItem(rows, 1) : root, "more", 1);
        cr_expect_not(fits(schema, root, "", &v), "an unknown key");
        cJSON_Delete(root);
        finished_clear(&f);
    }
    cJSON_Delete(schema);
    place_clear(&p);
}

Test(schema, what_verify_writes_fits)
{
    static const struct {
        const char *words;
        int code;
    } lines[] = {
        {"sleigh --current m*v^2+m*a^2*k^2*omega^2", 0},
        {"sleigh --current m*v", 1},
        {"sleigh --field x=1", 1},
        {"sleigh --field Z0=1", 0},
        {"sleigh --field Z0=1 --of equations --equations", 0},
        {"appell_hamel --current x'", 1},
        {"appell_hamel --current sin(pi*z)", 1},
    };
    cJSON *schema = read_json("docs/schema/verify.json");
    place p = place_make();
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        char line[300], environment[PATH_MAX + 30], path[PATH_MAX + 30];
        snprintf(environment, sizeof environment, "NHSYM_PATH=%s", p.project);
        snprintf(line, sizeof line, "verify %s --quiet --json v.json", lines[i].words);
        finished f = run_so(&p, &(manner){.environment = (const char *const[]){environment, NULL}}, line);
        cr_expect_eq(f.code, lines[i].code, "%s: %d %s", line, f.code, f.err);
        snprintf(path, sizeof path, "%s/v.json", p.folder);
        cJSON *root = read_json(path);
        verdict v = {""};
        cr_expect(fits(schema, root, "", &v), "%s: %s", lines[i].words, v.fault);
        cJSON_AddNumberToObject(root, "more", 1);
        cr_expect_not(fits(schema, root, "", &v), "an unknown key");
        cJSON_DeleteItemFromObject(root, "more");
        cJSON_DeleteItemFromObject(root, "counterexample");
        cr_expect_not(fits(schema, root, "", &v), "a missing key");
        cJSON_Delete(root);
        finished_clear(&f);
    }
    cJSON_Delete(schema);
    place_clear(&p);
}

/* With quasi-velocities, coordinate velocities, a root, none. */
Test(schema, what_show_writes_fits)
{
    static const char *const lines[] = {"sleigh", "sleigh --velocities coordinates", "constant_speed", "kepler", "rolling_ball"};
    cJSON *schema = whole = read_json("docs/schema/show.json");
    place p = place_with_systems();
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        char line[300];
        snprintf(line, sizeof line, "show %s --equations --json -", lines[i]);
        finished f = run(&p, line);
        cr_assert(f.code == 0, "%s: %s", line, f.err);
        cJSON *root = cJSON_Parse(f.out);
        verdict v = {""};
        cr_expect(fits(schema, root, "", &v), "%s: %s", lines[i], v.fault);
        cJSON_AddNumberToObject(cJSON_GetObjectItem(root, "overview"), "more", 1);
        cr_expect_not(fits(schema, root, "", &v), "an unknown key");
        cJSON_DeleteItemFromObject(cJSON_GetObjectItem(root, "overview"), "more");
        cJSON_DeleteItemFromObject(cJSON_GetObjectItem(root, "equations"), "semispray");
        cr_expect_not(fits(schema, root, "", &v), "a missing key");
        cJSON_Delete(root);
        finished_clear(&f);
    }
    cJSON_Delete(schema);
    place_clear(&p);
}

static void reduce_fits(const place *p, const char *words)
{
    char line[300], environment[PATH_MAX + 30], path[PATH_MAX + 30];
    snprintf(environment, sizeof environment, "NHSYM_PATH=%s", p->project);
    snprintf(line, sizeof line, "reduce %s --quiet --json r.json", words);
    finished f = run_so(p, &(manner){.environment = (const char *const[]){environment, NULL}}, line);
    cr_assert(f.code == 0 || f.code == 5, "%s: %d %s", line, f.code, f.err);
    snprintf(path, sizeof path, "%s/r.json", p->folder);
    cJSON *root = read_json(path), *group = cJSON_GetObjectItem(root, "group");
    verdict v = {""};
    cr_expect(fits(whole, root, "", &v), "%s: %s", words, v.fault);
    cJSON_AddNumberToObject(group, "more", 1);
    cr_expect_not(fits(whole, root, "", &v), "an unknown key");
    cJSON_DeleteItemFromObject(group, "more");
    cJSON_DeleteItemFromObject(group, "name");
    cr_expect_not(fits(whole, root, "", &v), "a missing key");
    cJSON_Delete(root);
    finished_clear(&f);
}

/* Every shipped system; the other forms: an accuracy, chosen generators, a chain, the theory's objects, a limit. */
Test(schema, what_reduce_writes_fits, PLAIN_ONLY)
{
    static const char *const lines[] = {"vertical_disk --accuracy 1e-8", "vertical_disk --group 1,2 --equations", "vertical_disk --chain 3;4;1,2",
                                        "rolling_ball --weak", "rolling_disk --option work=100"};
    place p = place_make();
    whole = read_json("docs/schema/reduce.json");
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) reduce_fits(&p, lines[i]);
    char *name[most_files];
    size_t n = list("systems", name);
    cr_assert_gt(n, 60);
    for (size_t i = 0; i < n; free(name[i++]))
        if (sweep_tries(i, 18, 36)) reduce_fits(&p, name[i]);
    cJSON_Delete(whole);
    place_clear(&p);
}

/* What is left when there was no time for anything is a form of each schema, and no other document is taken for it. */
Test(schema, what_is_left_of_a_run_fits)
{
    static const char *const lines[][2] = {
        {"analyze", "analyze sleigh"}, {"verify", "verify sleigh --current v"}, {"benchmark", "benchmark sleigh"}, {"export", "export sleigh"}, {"simulate", "simulate sleigh"}, {"reduce", "reduce sleigh"}, {"show", "show sleigh --equations"}};
    place p = place_make();
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        char line[300], environment[PATH_MAX + 30], path[PATH_MAX + 30];
        snprintf(path, sizeof path, "docs/schema/%s.json", lines[i][0]);
        cJSON *schema = whole = read_json(path);
        snprintf(environment, sizeof environment, "NHSYM_PATH=%s", p.project);
        snprintf(line, sizeof line, "%s --max-seconds 1e-9 --quiet --json u.json", lines[i][1]);
        finished f = run_so(&p, &(manner){.environment = (const char *const[]){environment, NULL}}, line);
        cr_expect_eq(f.code, 5, "%s: %d %s", line, f.code, f.err);
        snprintf(path, sizeof path, "%s/u.json", p.folder);
        cJSON *root = read_json(path);
        verdict v = {""};
        cr_expect(fits(schema, root, "", &v), "%s: %s", line, v.fault);
        cJSON_DeleteItemFromObject(root, "unfinished");
        cr_expect_not(fits(schema, root, "", &v), "%s: without unfinished", line);
        cJSON_Delete(root);
        cJSON_Delete(schema);
        finished_clear(&f);
    }
    place_clear(&p);
}
