/* cli, JSON: standard output is JSON and nothing else, has every key of schema 1 (FORMAT.md), and files are replaced whole or not. */
#include <cjson/cJSON.h>
#include <ctype.h>
#include <dirent.h>
#include <math.h>

#include "program.h"
#include "sweep.h"

static const char FREE[] = "name: free\nparameters: [{name: m, value: 2.385}]\ncoordinates: [x, y]\nlagrangian: m/2*(x'^2 + y'^2)\n";
static const char DAMPED[] = "name: damped\nparameters: [{name: c, value: 0.385}]\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                             "forces:\n  - x = -c*x' + y^2*x\n  - y = -2*c*y' - x^3\n";
static const char CONE[] = "name: cone\nparameters: [{name: k, value: 1.385}]\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\n"
                           "constraints: [\"z'^2 = k^2*(x'^2 + y'^2)\"]\ndependent: [z]\n";
static const char IMPLICIT[] = "name: implicit\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\n"
                               "constraints: [\"z'^3 + 2*z' = x'*y'\"]\ndependent: [z]\n";

/* ---- running and reading ---- */

/* A place from which the project's systems and analyses are seen. */
static place place_with_project(void)
{
    place p = place_make();
    static const char *const kinds[] = {"systems", "analyses"};
    for (size_t i = 0; i < 2; i++) {
        char from[2 * PATH_MAX], to[2 * PATH_MAX];
        snprintf(from, sizeof from, "%s/%s", p.project, kinds[i]);
        snprintf(to, sizeof to, "%s/%s", p.folder, kinds[i]);
        cr_assert_eq(symlink(from, to), 0);
    }
    return p;
}

/* The JSON that a run prints, which must be all that it prints. */
static cJSON *json_of(const place *p, const char *line, int code)
{
    const char *end = NULL;
    finished f = run_expecting(p, line, code);
    cJSON *root = cJSON_ParseWithOpts(f.out, &end, 0);
    cr_assert_not_null(root, "nhsym %s printed\n%s", line, f.out);
    cr_expect_eq(f.out[0], '{');
    cr_expect_str_eq(end, "\n", "behind the JSON of nhsym %s stands\n%s", line, end);
    cr_expect_str_eq(f.err, "");
    finished_clear(&f);
    return root;
}

/* "a.b.0.c" */
static const cJSON *find(const cJSON *root, const char *path)
{
    char copy[200];
    snprintf(copy, sizeof copy, "%s", path);
    for (char *word = strtok(copy, "."); word && root; word = strtok(NULL, "."))
        root = isdigit((unsigned char)word[0]) ? cJSON_GetArrayItem(root, atoi(word)) : cJSON_GetObjectItemCaseSensitive(root, word);
    return root;
}

static bool is_of(const cJSON *item, char type)
{
    switch (type) {
    case 'n': return cJSON_IsNumber(item);
    case 's': return cJSON_IsString(item);
    case 'b': return cJSON_IsBool(item);
    case 'a': return cJSON_IsArray(item);
    case 'o': return cJSON_IsObject(item);
    default: return cJSON_IsNull(item);
    }
}

/* Each line: a path, and the letters of the types it may have (n s b a o, 0 for null). */
typedef struct {
    const char *path, *types;
} key;

static void check_keys(const cJSON *root, const char *under, size_t n, const key *keys)
{
    for (size_t i = 0; i < n; i++) {
        char path[200];
        bool good = false;
        snprintf(path, sizeof path, "%s%s", under, keys[i].path);
        const cJSON *item = find(root, path);
        cr_expect_not_null(item, "%s is missing", path);
        for (const char *t = keys[i].types; *t && item; t++) good |= is_of(item, *t);
        cr_expect(good || !item, "%s is not of the type %s", path, keys[i].types);
    }
}

/* ---- schema 1 ---- */

static const key SCHEMA[] = {
    {"schema", "n"}, {"version", "s"}, {"system", "s"}, {"parameters", "o"},
    {"dimension.coordinates", "n"}, {"dimension.constraints", "n"}, {"dimension.submanifold", "n"},
    {"constraint.type", "s"}, {"constraint.semiholonomic", "b0"}, {"constraint.branch", "o0"}, {"constraint.holonomic", "b"}, {"constraint.rheonomic", "b"}, {"constraint.homogeneous", "b"}, {"constraint.integrability", "s"},
    {"constraint.growth_proved", "b"}, {"constraint.growth_space", "s"}, {"constraint.hidden_holonomic.count", "n"}, {"constraint.hidden_holonomic.without_closed_form", "n"},
    {"reduced_equations", "a"}, {"reduced_equations.0.velocity", "s"}, {"reduced_equations.0.rate", "s"}, {"multipliers", "a"},
    {"nullspace.columns", "n"}, {"nullspace.rows", "n"}, {"nullspace.spectrum", "a"}, {"nullspace.gap", "n0"}, {"nullspace.dimension", "n"},
    {"explicit_motion", "o0"}, {"counted_space", "o0"}, {"unknowns", "o"}, {"currents", "a"}, {"absence", "o0"}, {"almost_conserved", "a"}, {"independent_currents", "n"}, {"local_maximum", "n"},
    {"validation", "o0"}, {"timing.total_s", "n"}, {"warnings", "a"},
    {"stages", "a"}, {"partial", "b"}, {"run.command", "s"}, {"run.system_file", "s"}, {"run.machine", "s"}, {"run.libraries.FLINT", "s"},
};
static const key CURRENT[] = {
    {"name", "s"}, {"expression", "s"}, {"in_velocities", "s0"}, {"latex", "s0"}, {"residual", "n"}, {"heldout_residual", "n"},
    {"certified_digits", "n"}, {"proved", "b"}, {"independent", "b"}, {"drift", "n0"}, {"drift_order_ok", "b0"}, {"printed_digits", "n"}, {"series", "o0"},
    {"symmetry.Z0", "s"}, {"symmetry.zeta", "a"}, {"symmetry.W", "a"}, {"symmetry.components.t", "s"}, {"symmetry.components_with_gamma", "o0"},
    {"bracket_in_distribution", "b"}, {"case", "n0"}, {"projectable", "b"},
};
#define COUNT(list) (sizeof list / sizeof *list)

/* A word of its own: "nan" but not "finance". */
static void check_no_word(const char *text, const char *word)
{
    size_t n = strlen(word);
    for (const char *at = text; (at = strcasestr(at, word)); at += n)
        cr_expect((at > text && isalnum((unsigned char)at[-1])) || isalnum((unsigned char)at[n]), "the JSON contains %.*s", (int)n + 20, at);
}

/* "Numbers that could not be computed are null with a reason in warnings": numbers only, the texts may be absent. */
static size_t null_numbers(const cJSON *item)
{
    static const char *const texts[] = {"relation", "recognised", "in_velocities", "validation", "routes", "multiplier_form", "symmetry", "components_with_gamma", "symmetry_route",
                                        "chart_crossing", "nullspace", "gap", "series", "latex", "command", "analysis_file", "accuracy",
                                        "semiholonomic", "branch", "on_both_branches",
                                        "completeness", "in_time", "absence", "class", "at_most", "decided_by", "curve", "variable", "p", "q", "regular", "certificate", "monodromy", "residues", "darboux", "point", "eigenvalue", "factor", "residue", "contradiction", "obstacle", "of", "proved", "missing_at", "equations",
                                        "explicit_motion", "intervals", "fixed", "region", "where", "counted_space", "known",
                                        "tried", "state", "rate", "digits"};
    size_t n = 0;
    if (cJSON_IsNull(item)) {
        for (size_t i = 0; i < COUNT(texts); i++)
            if (item->string && !strcmp(item->string, texts[i])) return 0;
        return 1;
    }
    if (cJSON_IsString(cJSON_GetObjectItem(item, "obstacle"))) return 0; /* why there are no numbers */
    for (const cJSON *child = item->child; child; child = child->next) n += null_numbers(child);
    if (cJSON_IsNull(cJSON_GetObjectItem(item, "parameter"))) { /* a figure in which nothing is varied: no curve has a value of it */
        const cJSON *curve;
        n--;
        cJSON_ArrayForEach(curve, cJSON_GetObjectItem(item, "curves")) n -= cJSON_IsNull(cJSON_GetObjectItem(curve, "value"));
    }
    return n;
}

static void check_schema(const cJSON *root)
{
    check_keys(root, "", COUNT(SCHEMA), SCHEMA);
    cr_expect_eq(cJSON_GetNumberValue(find(root, "schema")), 1.0);
    for (int k = 0; k < cJSON_GetArraySize(find(root, "currents")); k++) {
        char under[30];
        snprintf(under, sizeof under, "currents.%d.", k);
        check_keys(root, under, COUNT(CURRENT), CURRENT);
    }
    char *text = cJSON_Print(root);
    check_no_word(text, "nan");
    check_no_word(text, "inf");
    cr_expect(null_numbers(root) == 0 || cJSON_GetArraySize(find(root, "warnings")) > 0, "a number is null without a reason in\n%s", text);
    free(text);
}

Test(cli_json, the_sleigh_has_every_key)
{
    static const key more[] = {{"parameters.m", "n"}, {"parameters.k", "n"}, {"multipliers.0.constraint", "s"}, {"multipliers.0.expression", "s"},
                               {"unknowns.nu.0.value", "n"}, {"unknowns.nu.0.recognised", "s"}, {"currents.0.symmetry.components.phi", "s"}};
    place p = place_with_project();
    cJSON *root = json_of(&p, "analyze sleigh --json -", 0);
    check_schema(root);
    check_keys(root, "", COUNT(more), more);
    cr_expect_str_eq(cJSON_GetStringValue(find(root, "system")), "sleigh");
    cr_expect_eq(cJSON_GetNumberValue(find(root, "dimension.submanifold")), 6.0);
    cr_expect_str_eq(cJSON_GetStringValue(find(root, "constraint.type")), "linear");
    cr_expect_str_eq(cJSON_GetStringValue(find(root, "unknowns.nu.0.recognised")), "1/k");
    cr_expect_eq(cJSON_GetArraySize(find(root, "currents")), 6);
    cr_expect_eq(cJSON_GetNumberValue(find(root, "independent_currents")), 5.0);
    cr_expect_eq(cJSON_GetNumberValue(find(root, "local_maximum")), 5.0);
    cr_expect_eq(cJSON_GetArraySize(find(root, "nullspace.spectrum")), (int)cJSON_GetNumberValue(find(root, "nullspace.rank")));
    cJSON_Delete(root);
    place_clear(&p);
}

/* Systems that stress the numbers: everything conserved, nothing conserved, no constraint, roots, implicit velocities, no inertia to drift. */
Test(cli_json, other_systems_have_every_key, PLAIN_ONLY)
{
    static const char *const texts[] = {FREE, DAMPED, CONE, IMPLICIT};
    place p = place_make();
    for (size_t i = 0; i < COUNT(texts); i++) {
        write_here(&p, "mine.yaml", texts[i]);
        cJSON *root = json_of(&p, "analyze mine.yaml --json -", 0);
        check_schema(root);
        cJSON_Delete(root);
    }
    place_clear(&p);
}

/* Names of the file are copied as they are; the numbers too. */
Test(cli_json, texts_and_numbers_are_exact)
{
    place p = place_make();
    write_here(&p, "mine.yaml", "name: \"čtyři \\\"\\\\ \\u0007x\"\nparameters: [{name: m, value: 0.1}, {name: big, value: 123456789012345.67}]\n"
                                "coordinates: [x]\nlagrangian: m*x'^2 + big\n");
    finished bad = run_expecting(&p, "analyze mine.yaml --json -", 3); /* a bell in a name */
    write_here(&p, "mine.yaml", "name: \"čtyři \\\"\\\\ x\"\nparameters: [{name: m, value: 0.1}, {name: big, value: 123456789012345.67}]\n"
                                "coordinates: [x]\nlagrangian: m*x'^2 + big\n");
    cJSON *root = json_of(&p, "analyze mine.yaml --json - --set m=0.30000000000000004", 0);
    cr_expect_str_eq(cJSON_GetStringValue(find(root, "system")), "čtyři \"\\ x");
    cr_expect_eq(cJSON_GetNumberValue(find(root, "parameters.m")), 0.1 + 0.2);
    cr_expect_eq(cJSON_GetNumberValue(find(root, "parameters.big")), 123456789012345.67);
    cJSON_Delete(root);
    finished_clear(&bad);
    place_clear(&p);
}

/* The current is written in the names of the system file; in_velocities in its coordinates only. */
Test(cli_json, in_velocities_has_no_quasi_velocity, PLAIN_ONLY)
{
    place p = place_with_project();
    cJSON *root = json_of(&p, "analyze sleigh --json - --set k=3", 0);
    const cJSON *currents = find(root, "currents"), *c;
    cJSON_ArrayForEach(c, currents)
    {
        const char *own = cJSON_GetStringValue(find(c, "expression")), *plain = cJSON_GetStringValue(find(c, "in_velocities"));
        cr_assert(own && plain);
        cr_expect(strstr(own, "omega") || strstr(own, "v"), "%s", own);
        cr_expect_null(strstr(plain, "omega"), "%s", plain);
        cr_expect_not_null(strstr(plain, "phi'"), "%s", plain);
    }
    cJSON_Delete(root);
    place_clear(&p);
}

/* ---- the same again ---- */

static char *without_timing(cJSON *root)
{
    cr_assert_not_null(find(root, "timing"));
    cJSON_DeleteItemFromObjectCaseSensitive(root, "timing");
    cJSON_DeleteItemFromObjectCaseSensitive(cJSON_GetObjectItemCaseSensitive(root, "run"), "command"); /* the lines differ */
    char *text = cJSON_Print(root);
    cJSON_Delete(root);
    return text;
}

Test(cli_json, the_same_inputs_give_the_same_output)
{
    static const char *const lines[] = {"analyze sleigh --json -", "analyze sleigh --json - --seed 77 --samples 300", "analyze mine.yaml --json -",
                                        "analyze sleigh --velocities coordinates --json -"};
    place p = place_with_project();
    write_here(&p, "mine.yaml", DAMPED);
    for (size_t i = 0; i < COUNT(lines); i++) {
        if (!sweep_tries(i + 2, 2, 4)) continue;
        char *a = without_timing(json_of(&p, lines[i], 0)), *b = without_timing(json_of(&p, lines[i], 0));
        cr_expect_str_eq(a, b, "nhsym %s differs from run to run", lines[i]);
        free(a);
        free(b);
    }
    place_clear(&p);
}

Test(cli_json, threads_do_not_change_the_output, PLAIN_ONLY)
{
    place p = place_with_project();
    char *a = without_timing(json_of(&p, "analyze vertical_disk --threads 1 --max-seconds 1000 --json -", 0)), *b = without_timing(json_of(&p, "analyze vertical_disk --threads 3 --max-seconds 1000 --json -", 0));
    cr_expect_str_eq(a, b);
    free(a);
    free(b);
    place_clear(&p);
}

Test(cli_json, seed_and_samples_reach_the_result, PLAIN_ONLY)
{
    place p = place_with_project();
    cJSON *root = json_of(&p, "analyze sleigh --json - --seed 77 --samples 300", 0);
    cr_expect_eq(cJSON_GetNumberValue(find(root, "samples.seed")), 77.0);
    cr_expect_eq(cJSON_GetNumberValue(find(root, "samples.used")), 300.0);
    cJSON_Delete(root);
    place_clear(&p);
}

/* The motion of an analysis is as accurate as was asked for, or the exit code says that it is not. */
Test(cli_json, accuracy_reaches_the_result, PLAIN_ONLY)
{
    place p = place_with_project();
    cJSON *root = json_of(&p, "analyze sleigh --json - --accuracy 1e-8", 0);
    cr_expect(cJSON_IsTrue(find(root, "validation.accuracy.held")));
    cr_expect_eq(cJSON_GetNumberValue(find(root, "validation.accuracy.wanted")), 1e-8);
    cr_expect_lt(cJSON_GetNumberValue(find(root, "validation.accuracy.estimate")), 1e-8);
    const cJSON *tolerances = find(root, "validation.tolerances");
    cr_expect_lt(cJSON_GetNumberValue(cJSON_GetArrayItem(tolerances, 2)), 1e-8);
    cJSON_Delete(root);
    finished f = run_expecting(&p, "analyze sleigh --json - --accuracy 1e-15", 4);
    cr_expect(strstr(f.err, "the accuracy 1.0e-15 was not reached") && strstr(f.err, "is the least certain"), "%s", f.err);
    root = cJSON_Parse(f.out);
    cr_expect(cJSON_IsFalse(find(root, "validation.accuracy.held")));
    cJSON_Delete(root);
    finished_clear(&f);
    root = json_of(&p, "simulate sleigh --initial omega=2 --json - --ensemble 20 --accuracy 1e-6 --step 5", 0);
    cr_expect(cJSON_IsTrue(find(root, "accuracy.held")));
    cr_expect(cJSON_IsBool(find(root, "accuracy.all_alone")) && cJSON_IsString(find(root, "accuracy.method_alone")) && cJSON_IsString(find(root, "accuracy.choice")));
    cr_expect_gt(cJSON_GetNumberValue(find(root, "accuracy.ratio")), 0);
    cJSON_Delete(root);
    place_clear(&p);
}

/* ---- files ---- */

static size_t entries(const place *p, const char *name)
{
    char path[PATH_MAX + 300];
    size_t n = 0;
    snprintf(path, sizeof path, "%s/%s", p->folder, name);
    DIR *folder = opendir(path);
    cr_assert_not_null(folder);
    for (struct dirent *e; (e = readdir(folder));) n += strcmp(e->d_name, ".") && strcmp(e->d_name, "..");
    closedir(folder);
    return n;
}

Test(cli_json, a_file_is_written_beside_the_summary, PLAIN_ONLY)
{
    static const char *const lines[] = {"analyze mine.yaml --json out/result.json", "analyze --json=out/result.json mine.yaml", "analyze mine.yaml --json out/result",
                                        "analyze --json out/result.json mine.yaml --quiet"};
    static const char *const names[] = {"out/result.json", "out/result.json", "out/result", "out/result.json"};
    place p = place_make();
    write_here(&p, "mine.yaml", FREE);
    folder_here(&p, "out", 0755);
    for (size_t i = 0; i < COUNT(lines); i++) {
        finished f = run_expecting(&p, lines[i], 0);
        char *text = read_here(&p, names[i]);
        cr_assert_not_null(text, "nhsym %s wrote no %s", lines[i], names[i]);
        cJSON *root = cJSON_Parse(text);
        cr_assert_not_null(root, "%s", text);
        check_schema(root);
        cr_expect_eq(strlen(f.out) > 0, i < 3, "a summary unless --quiet: %s", f.out);
        cJSON_Delete(root);
        free(text);
        finished_clear(&f);
    }
    cr_expect_eq(entries(&p, "out"), (size_t)2, "nothing else is left in the folder");
    place_clear(&p);
}

Test(cli_json, an_option_without_file_prints, PLAIN_ONLY)
{
    static const char *const lines[] = {"analyze mine.yaml --json", "analyze --json mine.yaml", "analyze mine.yaml --json --seed 3", "analyze --json - mine.yaml"};
    place p = place_make();
    write_here(&p, "mine.yaml", FREE);
    for (size_t i = 0; i < COUNT(lines); i++) cJSON_Delete(json_of(&p, lines[i], 0));
    place_clear(&p);
}

/* What is there stays there, whole, and nothing is left beside it. */
static void check_untouched(const place *p, const manner *how, const char *line, const char *name, const char *folder, size_t files)
{
    finished f = run_so(p, how, line);
    char *text = name ? read_here(p, name) : NULL;
    cr_expect_eq(f.code, 4, "nhsym %s: exit code %d\n%s%s", line, f.code, f.out, f.err);
    cr_expect_not_null(strstr(f.err, "could not be written: "), "%s", f.err);
    cr_expect_not_null(strstr(f.err, name ? "the previous file is unchanged" : "its folder must exist"), "%s", f.err);
    if (name) cr_expect_str_eq(text ? text : "(gone)", "old\n");
    cr_expect_eq(entries(p, folder), files, "%s holds %zu entries", folder, entries(p, folder));
    free(text);
    finished_clear(&f);
}

Test(cli_json, a_folder_that_cannot_be_written_keeps_its_file)
{
    place p = place_make();
    write_here(&p, "mine.yaml", FREE);
    folder_here(&p, "out", 0755);
    write_here(&p, "out/result.json", "old\n");
    folder_here(&p, "out", 0555);
    copy_program(&p);
    check_untouched(&p, &(manner){.powerless = true}, "analyze mine.yaml --json out/result.json", "out/result.json", "out", 1);
    folder_here(&p, "out", 0755);
    place_clear(&p);
}

/* As on a full disk: the new file cannot be finished. */
Test(cli_json, a_file_that_cannot_be_finished_leaves_the_old_one, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "mine.yaml", FREE);
    folder_here(&p, "out", 0755);
    write_here(&p, "out/result.json", "old\n");
    check_untouched(&p, &(manner){.file_limit = 1000}, "analyze mine.yaml --quiet --json out/result.json", "out/result.json", "out", 1);
    check_untouched(&p, &(manner){0}, "analyze mine.yaml --json no/folder/result.json", NULL, "out", 1);
    check_untouched(&p, &(manner){0}, "analyze mine.yaml --json=out", "out/result.json", "out", 1);
    place_clear(&p);
}

/* The file keeps its rights; a symbolic link to nothing, a device and a pipe are written as they are. */
Test(cli_json, files_keep_their_rights_and_devices_work)
{
    place p = place_make();
    char path[PATH_MAX + 20];
    struct stat info;
    write_here(&p, "mine.yaml", FREE);
    write_here(&p, "result.json", "old\n");
    snprintf(path, sizeof path, "%.4000s/result.json", p.folder);
    cr_assert_eq(chmod(path, 0640), 0);
    finished f = run_expecting(&p, "analyze mine.yaml --json result.json", 0), g = run_expecting(&p, "analyze mine.yaml --quiet --json=/dev/null", 0);
    char *text = read_here(&p, "result.json");
    cr_expect_eq(stat(path, &info), 0);
    cr_expect_eq(info.st_mode & 0777, (mode_t)0640);
    cr_expect_eq(text[0], '{');
    cr_expect(!stat("/dev/null", &info) && S_ISCHR(info.st_mode), "/dev/null is still a device");
    free(text);
    finished_clear(&f);
    finished_clear(&g);
    place_clear(&p);
}

/* Errors leave standard output and the file alone. */
Test(cli_json, a_failed_question_writes_no_json)
{
    place p = place_make();
    write_here(&p, "mine.yaml", "name: mine\ncoordinates: [x]\nlagrangian: m*x'^2\n");
    write_here(&p, "result.json", "old\n");
    finished f = run_expecting(&p, "analyze mine.yaml --json -", 3), g = run_expecting(&p, "analyze mine.yaml --json result.json", 3);
    char *text = read_here(&p, "result.json");
    cr_expect_str_eq(f.out, "");
    cr_expect_str_eq(text, "old\n");
    free(text);
    finished_clear(&f);
    finished_clear(&g);
    place_clear(&p);
}

/* How far Kepler's problem is counted with so much work. */
static double counted_degree(const place *p, const char *work, const char *asked)
{
    char line[200];
    snprintf(line, sizeof line, "analyze kepler --no-analysis --until 1 --option count_work=%s %s --json -", work, asked);
    cJSON *root = json_of(p, line, 0);
    double degree = find(root, "completeness.degree")->valuedouble;
    cJSON_Delete(root);
    return degree;
}

/* --degree: a count may take ten times the work, and no more: it comes as far as another one with ten times as much. */
Test(cli_json, a_degree_that_is_asked_for_may_cost_ten_times_the_work, WHOLE_ONLY)
{
    static const char *const works[] = {"1e4", "1e5", "1e6"};
    place p = place_with_project();
    for (size_t i = 0; i + 1 < COUNT(works); i++) {
        double usual = counted_degree(&p, works[i], ""), asked = counted_degree(&p, works[i], "--degree 6"),
               tenfold = counted_degree(&p, works[i + 1], "");
        cr_expect(usual < asked && asked == tenfold && asked < 6, "work %s: to degree %g, with --degree 6 to %g, with ten times as much to %g", works[i], usual, asked, tenfold);
    }
    place_clear(&p);
}
