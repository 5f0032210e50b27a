/* What is written about the program is true: the house is as docs/modules.md says, the pages quote what the program prints, and
 * the commands on them work.
 *
 * Markers in README.md and docs/ *.md, each directly before a fenced block:
 *     <!-- file: NAME -->   the block is a file of that name in the temporary folder of the page
 *     <!-- run -->          the block is run there by sh -e, with the program on PATH
 *     <!-- shows -->        every line of the block occurs in what the block run last printed (see `normalise`)
 *
 * NHSYM names the program (build/nhsym by default). */
#include <criterion/criterion.h>
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"
#include "base/option.h"
#include "base/text.h"

#include "sweep.h"

enum { most_path = 4096 };

/* ---- files and commands ---- */

static const char *program(void)
{
    const char *given = getenv("NHSYM");
    return given && *given ? given : "build/nhsym";
}

/* The folder of the program, absolute. */
static void program_folder(char out[most_path])
{
    cr_assert(realpath(program(), out), "%s is not there: set NHSYM", program());
    *strrchr(out, '/') = 0;
}

static void read_stream(FILE *file, nh_text *out)
{
    char buffer[4096];
    for (size_t n; (n = fread(buffer, 1, sizeof buffer, file)) > 0;) nh_text_add_n(out, buffer, n);
}

static void read_page(const char *path, nh_text *out)
{
    nh_text_init(out);
    FILE *file = fopen(path, "r");
    cr_assert(file, "%s cannot be read", path);
    read_stream(file, out);
    fclose(file);
}

/* Standard output and error of a shell command; returns its exit status as pclose does. */
static int run(const char *command, nh_text *out)
{
    nh_text_init(out);
    fflush(stdout);
    FILE *pipe = popen(command, "r");
    cr_assert(pipe);
    read_stream(pipe, out);
    return pclose(pipe);
}

/* ---- the house ---- */

Test(docs, house_is_in_order, PLAIN_ONLY)
{
    char folder[most_path], command[most_path + 64];
    nh_text said;
    program_folder(folder);
    snprintf(command, sizeof command, "sh tests/check_layers.sh '%s' 2>&1", folder);
    int status = run(command, &said);
    cr_expect(status == 0, "tests/check_layers.sh finds:\n%s", nh_text_string(&said));
    nh_text_clear(&said);
    if (system("command -v clang-format-14 >/dev/null"))
        cr_log_warn("skipped: there is no clang-format-14, the style of the sources is not compared");
}

/* ---- docs/options.md ends with what the program prints ---- */

Test(docs, options_are_current)
{
    char command[most_path];
    nh_text page, table;
    snprintf(command, sizeof command, "'%s' explain options | sed 's/^/    /'", program());
    cr_assert_eq(run(command, &table), 0);
    read_page("docs/options.md", &page);
    cr_assert_gt(table.length, 500);
    cr_assert_geq(page.length, table.length);
    cr_expect_str_eq(page.data + page.length - table.length, table.data, "docs/options.md is out of date; its head says how to write it again");
    size_t rows = 0;
    for (const char *at = table.data; (at = strchr(at, '\n')); at++) rows++;
    cr_expect_eq(rows, nh_option_count());
    nh_text_clear(&page);
    nh_text_clear(&table);
}

/* ---- commands on a page ---- */

typedef struct {
    const char *page;
    char folder[64]; /* temporary */
    nh_text printed; /* by the block run last */
    bool    skipped; /* that block needs Python, which is not there */
    size_t ran, shown;
} walk;

/* One line at a time without its end; NULL at the end of the text. */
static char *next_line(char **at)
{
    char *line = *at;
    if (!line || !*line) return NULL;
    char *end = strchr(line, '\n');
    *at = end ? end + 1 : NULL;
    if (end) *end = 0;
    return line;
}

/* Rounding is not the same everywhere: 1.3e-16 becomes #.  Runs of blanks become one, those at the ends are removed. */
static void normalise(const char *line, nh_text *out)
{
    nh_text_init(out);
    nh_text_add(out, "");
    for (const char *c = line; *c;) {
        size_t digits = strspn(c, "0123456789."), tail = digits && c[digits] == 'e' && strchr("+-", c[digits + 1]) ? 2 : 0;
        size_t number = tail ? digits + tail + strspn(c + digits + tail, "0123456789") : 0;
        size_t blanks = strspn(c, " \t\r");
        if (number > digits + tail) nh_text_add(out, "#");
        else if (blanks && c[blanks] && out->length) nh_text_add(out, " ");
        else if (!blanks) nh_text_add_n(out, c, digits ? digits : 1);
        c += number > digits + tail ? number : blanks ? blanks : digits ? digits : 1;
    }
}

static bool was_printed(const walk *w, const char *wanted)
{
    char *copy = strdup(nh_text_string(&w->printed)), *at = copy, *line;
    bool found = false;
    while (!found && (line = next_line(&at))) {
        nh_text plain;
        normalise(line, &plain);
        found = !strcmp(nh_text_string(&plain), wanted);
        nh_text_clear(&plain);
    }
    free(copy);
    return found;
}

static void check_shown(walk *w, char *block)
{
    nh_text missing;
    nh_text_init(&missing);
    for (char *line; (line = next_line(&block));) {
        nh_text plain;
        normalise(line, &plain);
        const char *wanted = nh_text_string(&plain);
        if (*wanted && !strstr(wanted, "...") && !was_printed(w, wanted)) nh_text_addf(&missing, "%s\n", line);
        w->shown++;
        nh_text_clear(&plain);
    }
    cr_expect(!missing.length, "%s: these lines are not printed:\n%s\nbut this is:\n%s", w->page, nh_text_string(&missing), nh_text_string(&w->printed));
    nh_text_clear(&missing);
}

static void write_file(const walk *w, const char *name, const char *text)
{
    char path[most_path];
    cr_assert(!strchr(name, '/'), "%s: a file with a folder: %s", w->page, name);
    snprintf(path, sizeof path, "%s/%s", w->folder, name);
    FILE *file = fopen(path, "w");
    cr_assert(file && fputs(text, file) >= 0 && fclose(file) == 0, "%s cannot be written", path);
}

static bool has_python(void)
{
    static int found = -1;
    if (found < 0) found = system("sh tests/python.sh -c pass 2>/dev/null") == 0;
    return found;
}

static void run_block(walk *w, const char *block)
{
    w->skipped = strstr(block, "tests/python.sh") && !has_python();
    if (w->skipped) {
        cr_log_warn("%s: skipped, there is no Python with NumPy, SymPy and pytest:\n%s", w->page, block);
        return;
    }
    char tools[most_path], here[most_path], command[3 * most_path];
    program_folder(tools);
    cr_assert(getcwd(here, sizeof here));
    write_file(w, "block.sh", block);
    snprintf(command, sizeof command, "cd %s && PATH='%s':$PATH NHSYM_PATH='%s' sh -e block.sh 2>&1", w->folder, tools, here);
    nh_text_clear(&w->printed);
    int status = run(command, &w->printed);
    cr_expect(status == 0, "%s: these commands fail:\n%s\n%s", w->page, block, nh_text_string(&w->printed));
    w->ran++;
}

/* The block after the marker: the lines between two fences. */
static char *take_block(const walk *w, char **at, const char *marker)
{
    nh_text text;
    char *line = next_line(at);
    cr_assert(line && !strncmp(line, "```", 3), "%s: no block after %s", w->page, marker);
    nh_text_init(&text);
    nh_text_add(&text, "");
    while ((line = next_line(at)) && strncmp(line, "```", 3)) nh_text_addf(&text, "%s\n", line);
    char *copy = strdup(nh_text_string(&text));
    nh_text_clear(&text);
    return copy;
}

static void obey(walk *w, const char *line, char **at)
{
    char name[128];
    bool file = sscanf(line, "<!-- file: %127[^ ] -->", name) == 1;
    bool commands = !strcmp(line, "<!-- run -->"), shows = !strcmp(line, "<!-- shows -->");
    if (!file && !commands && !shows) return;
    char *block = take_block(w, at, line);
    if (file) write_file(w, name, block);
    if (commands) run_block(w, block);
    if (shows && !w->skipped) check_shown(w, block);
    free(block);
}

/* A block of commands that no marker runs is a promise that nobody keeps. */
static void no_block_unmarked(const char *page, const char *text)
{
    const char *before = "";
    for (const char *line = text, *end; (end = strchr(line, '\n')); line = end + 1) {
        if (!strncmp(line, "```sh", 5)) cr_expect(!strncmp(before, "<!-- run -->", 12), "%s: commands that are not run: %.60s", page, end + 1);
        if (end > line) before = line;
    }
}

static walk walk_page(const char *path)
{
    walk w = {.page = path, .folder = "/tmp/nhsym-docs-XXXXXX"};
    nh_text page, ignored;
    char command[128];
    read_page(path, &page);
    no_block_unmarked(path, nh_text_string(&page));
    nh_text_init(&w.printed);
    cr_assert(mkdtemp(w.folder));
    char *at = page.data;
    for (char *line; (line = next_line(&at));) obey(&w, line, &at);
    snprintf(command, sizeof command, "rm -rf %s", w.folder);
    run(command, &ignored);
    nh_text_clear(&ignored);
    nh_text_clear(&page);
    nh_text_clear(&w.printed);
    return w;
}

Test(docs, readme_is_true, PLAIN_ONLY)
{
    walk w = walk_page("README.md");
    cr_expect_geq(w.ran, 3);
    cr_expect_geq(w.shown, 20);
}

Test(docs, pages_are_true, PLAIN_ONLY)
{
    DIR *folder = opendir("docs");
    size_t pages = 0, ran = 0;
    cr_assert(folder);
    for (struct dirent *entry; (entry = readdir(folder));) {
        char path[300];
        if (!strstr(entry->d_name, ".md")) continue;
        snprintf(path, sizeof path, "docs/%s", entry->d_name);
        ran += walk_page(path).ran;
        pages++;
    }
    closedir(folder);
    cr_expect_geq(pages, 6);
    cr_expect_geq(ran, 1);
}
