/* bad: every wrong file of the tables in tests/bad is refused with exactly the message that stands below it.
 *
 * A table is a sequence of cases, "=== NAME", the lines of the file, "=== message", the lines that a person should read; analyses.txt holds
 * analysis files (of the system that they name), the others system files.  To add one: write the file and the message, then make the program
 * say it. */
#include <criterion/criterion.h>

#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/files.h"
#include "base/memory.h"
#include "geometry/model.h"
#include "scratch.h"
#include "problem/analysis_file.h"

enum { least_systems = 250, least_analyses = 70, most_cases = 1000, most_table = 1 << 20 };

/* ---- the tables ---- */

typedef struct bad_case { /* parts of the text of its table */
    char *name, *file, *message;
    bool  analysis;
} bad_case;

typedef struct bad_tables {
    size_t   cases, tables;
    bad_case at[most_cases];
    char    *text[16];
} bad_tables;

/* The line after the next line that begins with `mark`, whose rest is in *rest; that line ends the text before it.  NULL at the end. */
static char *after_mark(char *text, const char *mark, char **rest)
{
    char *at = text;
    while (at && strncmp(at, mark, strlen(mark)) != 0) {
        at = strchr(at, '\n');
        if (at) at++;
    }
    if (!at) return NULL;
    char *end = strchr(at, '\n');
    cr_assert_not_null(end);
    *at = *end = 0;
    *rest = at + strlen(mark);
    return end + 1;
}

static void read_table(bad_tables *tables, const char *path)
{
    nh_error error;
    size_t   length;
    nh_error_clear(&error);
    char *rest, *next, *text, *bytes = nh_files_read(path, most_table, &length, &error);
    cr_assert_not_null(bytes, "%s cannot be read", path);
    tables->text[tables->tables++] = text = nh_alloc_array(length + 1, 1);
    memcpy(text, bytes, length);
    nh_free(bytes);
    cr_assert_eq(strncmp(text, "=== ", 4), 0, "%s is not a table of cases", path);
    for (text = after_mark(text, "=== ", &rest); text; text = next) {
        bad_case *c = &tables->at[tables->cases++];
        cr_assert_lt(tables->cases, (size_t)most_cases);
        *c = (bad_case){.name = rest, .file = text, .analysis = strstr(path, "analyses") != NULL};
        c->message = after_mark(c->file, "=== message", &rest);
        cr_assert_not_null(c->message, "%s has no message", c->name);
        next = after_mark(c->message, "=== ", &rest);
    }
}

static bad_tables *read_tables(void)
{
    bad_tables *tables = nh_alloc(sizeof *tables);
    glob_t      found;
    *tables = (bad_tables){0};
    cr_assert_eq(glob("tests/bad/*.txt", 0, NULL, &found), 0, "run the tests from the top folder of the project");
    for (size_t i = 0; i < found.gl_pathc; i++) read_table(tables, found.gl_pathv[i]);
    globfree(&found);
    return tables;
}

static void forget(bad_tables *tables)
{
    for (size_t i = 0; i < tables->tables; i++) nh_free(tables->text[i]);
    nh_free(tables);
}

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
    nh_analysis_file *analysis = nh_analysis_file_read(path, error);
    if (!analysis) return;
    char system_path[300];
    snprintf(system_path, sizeof system_path, "systems/%s.yaml", analysis->system ? analysis->system : "sleigh");
    nh_system *system = nh_system_read(system_path, analysis->settings, analysis->setting, error);
    nh_model *model = model_of(system, analysis->chart, error);
    if (model) nh_analysis_file_resolve(analysis, model, error);
    nh_model_free(model);
    nh_system_free(system);
    nh_analysis_file_free(analysis);
}

/* Each "FOLDER/" of the text away: where the file lies is not part of the message. */
static void without_folder(char *text, const char *folder)
{
    size_t n = strlen(folder) + 1;
    for (char *at; (at = strstr(text, folder));) memmove(at, at + n, strlen(at + n) + 1);
}

/* What the program says of the bytes as the file NAME.yaml in this folder. */
static nh_code judge(const char *folder, const char *name, bool analysis, const char *bytes, size_t n, char *message, size_t size)
{
    nh_error error;
    char path[SCRATCH + 100];
    nh_error_clear(&error);
    cr_assert_lt(snprintf(path, sizeof path, "%s/%s.yaml", folder, name), (int)sizeof path);
    FILE *file = fopen(path, "w");
    cr_assert(file && fwrite(bytes, 1, n, file) == n && fclose(file) == 0, "%s cannot be written", path);
    (analysis ? judge_analysis : judge_system)(path, &error);
    cr_assert_eq(remove(path), 0);
    nh_error_format(&error, message, size - 1);
    strcat(message, "\n");
    without_folder(message, folder);
    return error.code;
}

Test(bad, every_bad_file_is_refused_with_its_message)
{
    bad_tables *tables = read_tables();
    char folder[SCRATCH], message[4096];
    size_t analyses = 0;
    scratch_name(folder);
    cr_assert_not_null(mkdtemp(folder));
    for (size_t i = 0; i < tables->cases; i++) {
        const bad_case *c = &tables->at[i];
        nh_code code = judge(folder, c->name, c->analysis, c->file, strlen(c->file), message, sizeof message);
        analyses += c->analysis;
        cr_expect_eq(code, NH_INPUT, "%s: code %d", c->name, (int)code);
        cr_expect_str_eq(message, c->message, "%s\n-- expected\n%s-- said\n%s", c->name, c->message, message);
    }
    cr_expect_eq(rmdir(folder), 0);
    cr_expect_geq(tables->cases - analyses, (size_t)least_systems, "only %zu system files", tables->cases - analyses);
    cr_expect_geq(analyses, (size_t)least_analyses, "only %zu analysis files", analyses);
    forget(tables);
}

Test(bad, no_two_cases_have_one_name)
{
    bad_tables *tables = read_tables();
    for (size_t i = 0; i < tables->cases; i++)
        for (size_t j = 0; j < i; j++) cr_expect_str_neq(tables->at[i].name, tables->at[j].name);
    forget(tables);
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
    bad_tables *tables = read_tables();
    for (size_t i = 0; i < tables->cases; i++) check_place(tables->at[i].name, tables->at[i].message, tables->at[i].file);
    cr_expect_gt(tables->cases, (size_t)0);
    forget(tables);
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
    cr_assert_null(nh_analysis_file_read("tests/bad", &error));
    nh_error_format(&error, message, sizeof message);
    cr_expect_str_eq(message, "tests/bad: this is a directory, not a file");
    cr_expect_eq(error.code, NH_INPUT);
}

/* A file that no table can hold: its bytes are not text. */
Test(bad, a_file_in_another_encoding)
{
    static const char utf16[] = "\xff\xfen\0a\0m\0e\0:\0 \0w\0\n\0";
    char folder[SCRATCH], message[4096];
    scratch_name(folder);
    cr_assert_not_null(mkdtemp(folder));
    cr_expect_eq(judge(folder, "bytes_utf16", false, utf16, sizeof utf16 - 1, message, sizeof message), NH_INPUT);
    cr_expect_str_eq(message, "bytes_utf16.yaml: the encoding of this file is UTF-16\nhint: save the file in the encoding UTF-8\n");
    cr_expect_eq(rmdir(folder), 0);
}
