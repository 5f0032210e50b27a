/* bad: every file tests/bad/NAME.yaml is refused with exactly the words of tests/bad/NAME.txt.
 *
 * analysis_*.yaml are analysis files (of the system they name), the others system files.  To add one: write the file and the
 * message a person should read, then make the program say it. */
#include <criterion/criterion.h>

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "geometry/model.h"
#include "study/analysis.h"

static const char FOLDER[] = "tests/bad";
enum { least_systems = 40, least_analyses = 10, most_files = 1000 };

/* ---- the files ---- */

static bool ends_with(const char *text, const char *end)
{
    size_t n = strlen(text), k = strlen(end);
    return n > k && !strcmp(text + n - k, end);
}

static int by_name(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }

/* The names in the folder that end with `end`, without it, sorted. */
static size_t names_with(const char *end, char **out)
{
    DIR *folder = opendir(FOLDER);
    size_t n = 0;
    cr_assert_not_null(folder, "%s cannot be read: run the tests from the top folder of the project", FOLDER);
    for (struct dirent *entry; (entry = readdir(folder));) {
        if (!ends_with(entry->d_name, end)) continue;
        cr_assert_lt(n, (size_t)most_files);
        out[n] = nh_strdup(entry->d_name);
        out[n++][strlen(entry->d_name) - strlen(end)] = 0;
    }
    closedir(folder);
    qsort(out, n, sizeof *out, by_name);
    return n;
}

static void forget(char **names, size_t n)
{
    for (size_t i = 0; i < n; i++) nh_free(names[i]);
}

/* A whole file as a string, or NULL. */
static char *contents(const char *name, const char *end)
{
    char path[300];
    snprintf(path, sizeof path, "%s/%s%s", FOLDER, name, end);
    FILE *file = fopen(path, "r");
    if (!file) return NULL;
    char *text = nh_alloc(1 << 16);
    size_t n = fread(text, 1, (1 << 16) - 1, file);
    text[n] = 0;
    fclose(file);
    return text;
}

static bool is_analysis(const char *name) { return !strncmp(name, "analysis_", strlen("analysis_")); }

/* ---- what the program says ---- */

/* The model in the chart that `analyze` would choose; systems that are refused are refused until here. */
static nh_model *model_of(nh_system *system, nh_chart_choice choice, nh_error *error)
{
    nh_chart *chart = system ? nh_chart_create(system, choice, 1, error) : NULL;
    return chart ? nh_model_create(system, chart, error) : NULL;
}

static void judge_system(const char *path, nh_error *error)
{
    nh_system *system = nh_system_read(path, 0, NULL, error);
    nh_model *model = model_of(system, NH_CHART_AUTO, error);
    nh_model_free(model);
    nh_system_free(system);
}

static void judge_analysis(const char *path, nh_error *error)
{
    nh_analysis *analysis = nh_analysis_read(path, error);
    if (!analysis) return;
    char system_path[300];
    snprintf(system_path, sizeof system_path, "systems/%s.yaml", analysis->system ? analysis->system : "sleigh");
    nh_system *system = nh_system_read(system_path, analysis->settings, analysis->setting, error);
    nh_model *model = model_of(system, analysis->chart, error);
    if (model) nh_analysis_resolve(analysis, model, error);
    nh_model_free(model);
    nh_system_free(system);
    nh_analysis_free(analysis);
}

static nh_code judge(const char *name, char *message, size_t size)
{
    nh_error error;
    char path[300];
    nh_error_clear(&error);
    snprintf(path, sizeof path, "%s/%s.yaml", FOLDER, name);
    (is_analysis(name) ? judge_analysis : judge_system)(path, &error);
    nh_error_format(&error, message, size - 1);
    strcat(message, "\n");
    return error.code;
}

Test(bad, every_bad_file_is_refused_with_its_message)
{
    char *names[most_files], message[4096];
    size_t n = names_with(".yaml", names), systems = 0, analyses = 0;
    for (size_t i = 0; i < n; i++) {
        char *expected = contents(names[i], ".txt");
        *(is_analysis(names[i]) ? &analyses : &systems) += 1;
        nh_code code = judge(names[i], message, sizeof message);
        cr_expect_not_null(expected, "%s.txt is missing; the program says:\n%s", names[i], message);
        cr_expect_eq(code, NH_INPUT, "%s.yaml: code %d", names[i], (int)code);
        if (expected) cr_expect_str_eq(message, expected, "%s.yaml\n-- expected\n%s-- said\n%s", names[i], expected, message);
        nh_free(expected);
    }
    forget(names, n);
    cr_expect_geq(systems, (size_t)least_systems, "only %zu system files", systems);
    cr_expect_geq(analyses, (size_t)least_analyses, "only %zu analysis files", analyses);
}

Test(bad, every_message_belongs_to_a_file)
{
    char *names[most_files];
    size_t n = names_with(".txt", names);
    for (size_t i = 0; i < n; i++) {
        char *text = contents(names[i], ".yaml");
        cr_expect_not_null(text, "%s.txt has no %s.yaml", names[i], names[i]);
        nh_free(text);
    }
    forget(names, n);
    cr_expect_gt(n, (size_t)0);
}

/* ---- are the places true? ---- */

/* The `line`-th line of a text, tabs as blanks, without its end. */
static void line_of(const char *text, size_t line, char *out, size_t size)
{
    for (; line > 1 && text; line--) {
        text = strchr(text, '\n');
        if (text) text++;
    }
    size_t n = text ? strcspn(text, "\n") : 0;
    cr_assert_lt(n, size);
    memcpy(out, text ? text : "", n);
    out[n] = 0;
    for (char *c = out; *c; c++)
        if (*c == '\t') *c = ' ';
}

/* "file:LINE:COLUMN: what\n  source\n  <COLUMN - 1 blanks>^": the source is line LINE of the file. */
static void check_place(const char *name, const char *message, const char *source)
{
    size_t line = 0, column = 0;
    char wanted[1000], shown[1000], caret[1000];
    const char *place = strstr(message, ".yaml:");
    if (!place || sscanf(place, ".yaml:%zu:%zu: ", &line, &column) != 2) return; /* about the file as a whole */
    line_of(source, line, wanted, sizeof wanted);
    line_of(message, 2, shown, sizeof shown);
    line_of(message, 3, caret, sizeof caret);
    cr_expect_eq(caret[strlen(caret) - 1], '^', "%s: no caret in\n%s", name, message);
    if (strstr(shown, "…")) return; /* a part of a long line */
    cr_expect_str_eq(shown + 2, wanted, "%s: line %zu is\n%s\nbut the message shows\n%s", name, line, wanted, shown);
    cr_expect_eq(strlen(caret), column + 2, "%s: the caret stands in column %zu, the message says %zu", name, strlen(caret) - 2, column);
}

Test(bad, messages_show_the_line_they_name)
{
    char *names[most_files];
    size_t n = names_with(".txt", names);
    for (size_t i = 0; i < n; i++) {
        char *message = contents(names[i], ".txt"), *source = contents(names[i], ".yaml");
        if (source) check_place(names[i], message, source);
        nh_free(message);
        nh_free(source);
    }
    forget(names, n);
    cr_expect_gt(n, (size_t)0);
}

/* ---- files that are no text files ---- */

Test(bad, files_that_cannot_be_read)
{
    nh_error error;
    char message[4096];
    nh_error_clear(&error);
    cr_assert_null(nh_system_read("tests/bad/there_is_none.yaml", 0, NULL, &error));
    nh_error_format(&error, message, sizeof message);
    cr_expect_str_eq(message, "tests/bad/there_is_none.yaml: this file cannot be opened: No such file or directory");
    cr_expect_eq(error.code, NH_INPUT);
    nh_error_clear(&error);
    cr_assert_null(nh_analysis_read("tests/bad", &error));
    nh_error_format(&error, message, sizeof message);
    cr_expect_str_eq(message, "tests/bad: this is a directory, not a file");
    cr_expect_eq(error.code, NH_INPUT);
}
