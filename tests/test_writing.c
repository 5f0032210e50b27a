/* Whatever writes a file writes it whole or not at all: a full disk, a folder that may not be written to and an interruption leave the old one, and say so. */
#include <dirent.h>

#include "program.h"
#include "sweep.h"

/* %s: the file */
static const char *const WRITERS[] = {
    "analyze free_particle --quiet --json %s",
    "analyze free_particle --quiet --html %s",
    "analyze free_particle --quiet --tex %s",
    "verify free_particle --current x --quiet --json %s",
    "simulate free_particle --initial x=1 --until 1 --json %s",
    "benchmark free_particle --initial x=1 --until 1 --budget 100ms --quiet --json %s",
    "benchmark free_particle --initial x=1 --until 1 --budget 100ms --quiet --svg %s",
    "reduce vertical_disk --quiet --json %s",
    "verify free_particle --current x --quiet --html %s",
    "simulate free_particle --initial x=1 --until 1 --quiet --html %s",
    "benchmark free_particle --initial x=1 --until 1 --budget 100ms --quiet --html %s",
    "reduce vertical_disk --quiet --html %s",
};
enum { writers = sizeof WRITERS / sizeof *WRITERS };

static finished run_writer(const place *p, size_t i, const manner *how, const char *file)
{
    char line[300], environment[PATH_MAX + 30];
    snprintf(environment, sizeof environment, "NHSYM_PATH=%s", p->project);
    snprintf(line, sizeof line, WRITERS[i], file);
    manner with = *how;
    with.environment = (const char *const[]){environment, NULL};
    return run_so(p, &with, line);
}

static size_t files_in(const place *p, const char *folder)
{
    char path[PATH_MAX + 300];
    snprintf(path, sizeof path, "%s/%s", p->folder, folder);
    DIR *d = opendir(path);
    size_t n = 0;
    for (struct dirent *e; d && (e = readdir(d));) n += e->d_name[0] != '.' || (e->d_name[1] && e->d_name[1] != '.');
    if (d) closedir(d);
    return n;
}

static void expect_old(const place *p, size_t i, const finished *f, const char *file)
{
    char *text = read_here(p, file);
    cr_expect_eq(f->code, 4, "%s: exit code %d", WRITERS[i], f->code);
    cr_expect(strstr(f->err, file) && strstr(f->err, "is unchanged"), "%s: %s", WRITERS[i], f->err);
    cr_expect_str_eq(text, "an older report", "%s", WRITERS[i]);
    free(text);
}

Test(writing, a_full_disk_leaves_the_old_file, PLAIN_ONLY)
{
    for (size_t i = 0; i < writers; i++) {
        place p = place_make();
        folder_here(&p, "out", 0755);
        write_here(&p, "out/report", "an older report");
        finished f = run_writer(&p, i, &(manner){.file_limit = 400}, "out/report");
        expect_old(&p, i, &f, "out/report");
        cr_expect_eq(files_in(&p, "out"), 1u, "%s leaves a temporary file", WRITERS[i]);
        finished_clear(&f);
        place_clear(&p);
    }
}

Test(writing, a_folder_that_is_read_only_keeps_the_old_file)
{
    static const char *const systems[] = {"free_particle", "vertical_disk"};
    place p = place_make();
    copy_program(&p);
    folder_here(&p, "systems", 0755);
    for (size_t i = 0; i < 2; i++) {
        char from[2 * PATH_MAX], to[60];
        snprintf(from, sizeof from, "%s/systems/%s.yaml", p.project, systems[i]);
        snprintf(to, sizeof to, "systems/%s.yaml", systems[i]);
        copy_here(&p, from, to);
    }
    snprintf(p.project, sizeof p.project, "%s", p.folder);
    for (size_t i = 0; i < writers; i++) {
        folder_here(&p, "out", 0755);
        write_here(&p, "out/report", "an older report");
        folder_here(&p, "out", 0555);
        finished f = run_writer(&p, i, &(manner){.powerless = true}, "out/report");
        expect_old(&p, i, &f, "out/report");
        finished_clear(&f);
    }
    folder_here(&p, "out", 0755);
    place_clear(&p);
}

/* A device cannot be replaced, and is told to be full when it is; so is what a pipe or a disk behind standard output does not take. */
Test(writing, a_full_device_is_told, PLAIN_ONLY)
{
    if (access("/dev/full", W_OK)) cr_skip_test("no /dev/full");
    for (size_t i = 0; i < writers; i++) {
        place p = place_make();
        finished f = run_writer(&p, i, &(manner){0}, "/dev/full");
        cr_expect_eq(f.code, 4, "%s: exit code %d", WRITERS[i], f.code);
        cr_expect_not_null(strstr(f.err, "/dev/full"), "%s: %s", WRITERS[i], f.err);
        finished_clear(&f);
        place_clear(&p);
    }
    place p = place_make();
    char command[PATH_MAX + 40];
    snprintf(command, sizeof command, "'%s' explain >/dev/full", p.program);
    finished f = run_vector(&p, &(manner){0}, (char *[]){"sh", "-c", command, NULL});
    cr_expect_eq(f.code, 4);
    cr_expect_not_null(strstr(f.err, "could not be written"));
    finished_clear(&f);
    place_clear(&p);
}

/* Interrupted in the midst of it all, a result is still written whole. */
Test(writing, an_interrupted_run_leaves_a_whole_file)
{
    place p = place_make();
    write_here(&p, "report.html", "an older report");
    char command[2 * PATH_MAX];
    snprintf(command, sizeof command,
             "NHSYM_PATH='%.3900s' '%.3900s' analyze crane --no-analysis --max-seconds 600 --progress always --html report.html >out 2>err & p=$!\n"
             "until grep -q ' left' err || ! kill -0 $p; do sleep 0.02; done\nkill -INT $p\nwait $p", p.project, p.program);
    finished f = run_vector(&p, &(manner){0}, (char *[]){"sh", "-c", command, NULL});
    cr_expect_eq(f.code, 130, "exit code %d: %s", f.code, f.err);
    char *page = read_here(&p, "report.html");
    size_t length = strlen(page);
    cr_expect(length > 1000 && !strcmp(page + length - 8, "</html>\n"), "%zu bytes", length);
    cr_expect_not_null(strstr(page, "interrupted"));
    free(page);
    finished_clear(&f);
    place_clear(&p);
}

/* ---- many files, and new ones ---- */

static const char *const OLD[] = {"out/summary.txt", "out/result.json", "out/report.html", "out/report.tex", "out/figure1.svg"};
enum { olds = sizeof OLD / sizeof *OLD };

static place place_with_reports(void)
{
    place p = place_with_systems();
    folder_here(&p, "out", 0755);
    for (size_t i = 0; i < olds; i++) write_here(&p, OLD[i], "an older report");
    return p;
}

static void expect_all_old(const place *p, const finished *f)
{
    cr_expect_eq(f->code, 4, "exit code %d: %s", f->code, f->err);
    cr_expect(strstr(f->err, "out/") && strstr(f->err, "is unchanged"), "%s", f->err);
    for (size_t i = 0; i < olds; i++) {
        char *text = read_here(p, OLD[i]);
        cr_expect_str_eq(text, "an older report", "%s is another", OLD[i]);
        free(text);
    }
    cr_expect_eq(files_in(p, "out"), (size_t)olds, "%zu files", files_in(p, "out"));
}

/* The summary fits, and the larger ones do not: none takes the place of an old one, so that they go on belonging together. */
Test(writing, a_folder_is_written_whole_or_not_at_all)
{
    static const long limits[] = {400, 5000, 60000};
    place p = place_with_reports();
    for (size_t i = 0; i < 3; i++) {
        if (!sweep_tries(i + 1, 1, 3)) continue;
        finished f = run_so(&p, &(manner){.file_limit = limits[i]}, "analyze sleigh --quiet -o out");
        expect_all_old(&p, &f);
        finished_clear(&f);
    }
    finished f = run_expecting(&p, "analyze sleigh --quiet -o out", 0);
    char *page = read_here(&p, "out/report.html"), *summary = read_here(&p, "out/summary.txt");
    cr_expect(strstr(page, "</html>") && strstr(summary, "FOUND"));
    free(page), free(summary);
    finished_clear(&f);
    place_clear(&p);
}

/* Figures that an older run wrote into the folder and the new one does not have would be taken for its own; what nhsym did not write is not its to remove. */
Test(writing, figures_of_an_older_run_go_with_it, PLAIN_ONLY)
{
    place p = place_with_systems();
    char name[60], to[PATH_MAX + 60], *text;
    finished f = run_expecting(&p, "analyze sleigh --quiet -o out", 0);
    size_t before = files_in(&p, "out") - 4, own = 0;
    cr_assert_gt(before, 15u, "%zu figures", before);
    write_here(&p, "out/notes.txt", "mine"), own++;
    snprintf(name, sizeof name, "out/figure%zu.svg", before + 1);
    write_here(&p, name, "<svg xmlns=\"http://www.w3.org/2000/svg\">mine</svg>"), own++;
    text = read_here(&p, "out/figure15.svg");
    write_here(&p, "out/figure015.svg", text), own++;
    write_here(&p, "out/figure15.svg.svg", text), own++;
    write_here(&p, "precious.svg", text);
    snprintf(to, sizeof to, "%s/out/figure15.svg", p.folder);
    cr_assert(remove(to) == 0 && symlink("../precious.svg", to) == 0);
    own++;
    free(text);
    finished_clear(&f);
    f = run_so(&p, &(manner){.file_limit = 400}, "analyze free_particle --quiet -o out");
    cr_expect_eq(f.code, 4);
    cr_expect_eq(files_in(&p, "out"), 4 + before - 1 + own, "a run that wrote nothing removed something");
    finished_clear(&f);
    f = run_expecting(&p, "analyze free_particle --quiet -o out", 0);
    char *page = read_here(&p, "out/report.html");
    size_t after = 0;
    for (const char *c = page; (c = strstr(c, "<svg xmlns=")); c++) after++;
    cr_assert(after > 0 && after < 15, "%zu figures", after);
    cr_expect_eq(files_in(&p, "out"), 4 + after + own, "%zu files, not %zu figures and %zu others", files_in(&p, "out"), after, 4 + own);
    free(page);
    text = read_here(&p, "precious.svg");
    cr_expect_not_null(text);
    free(text);
    finished_clear(&f);
    place_clear(&p);
}

/* A disk of 300 kB, where this is permitted. */
Test(writing, a_disk_without_room_keeps_the_old_folder)
{
    place p = place_with_systems();
    char command[3 * PATH_MAX];
    snprintf(command, sizeof command,
             "mkdir out && unshare -m true 2>/dev/null && exec unshare -m sh -c 'mount -t tmpfs -o size=300k none out || exit 99\n"
             "echo older >out/result.json\n%.3900s analyze sleigh --quiet -o out; code=$?\ncat out/result.json; ls out | wc -l; exit $code'\nexit 99", p.program);
    finished f = run_vector(&p, &(manner){0}, (char *[]){"sh", "-c", command, NULL});
    if (f.code != 99) {
        cr_expect_eq(f.code, 4, "exit code %d: %s", f.code, f.err);
        cr_expect(strstr(f.err, "No space left") && strstr(f.err, "is unchanged"), "%s", f.err);
        cr_expect_str_eq(f.out, "older\n1\n");
    }
    bool skipped = f.code == 99;
    finished_clear(&f);
    place_clear(&p);
    if (skipped) cr_skip_test("no mounting");
}

/* Told before the work is begun: this one would take a minute. */
Test(writing, a_read_only_folder_is_told_at_once)
{
    place p = place_with_reports();
    copy_program(&p);
    unlink_here(&p, "systems");
    unlink_here(&p, "analyses");
    char from[2 * PATH_MAX];
    snprintf(from, sizeof from, "%s/systems/crane.yaml", p.project);
    copy_here(&p, from, "crane.yaml");
    folder_here(&p, "out", 0555);
    finished f = run_so(&p, &(manner){.powerless = true}, "analyze crane.yaml --progress always -o out");
    expect_all_old(&p, &f);
    cr_expect_null(strstr(f.err, "stage"), "the work was begun: %s", f.err);
    cr_expect_str_empty(f.out);
    finished_clear(&f);
    f = run_so(&p, &(manner){.powerless = true}, "analyze crane.yaml --html nowhere/report.html");
    cr_expect_eq(f.code, 4);
    cr_expect_not_null(strstr(f.err, "nowhere/report.html"), "%s", f.err);
    finished_clear(&f);
    folder_here(&p, "out", 0755);
    place_clear(&p);
}

Test(writing, a_new_file_is_whole_or_not_there)
{
    place p = place_make();
    copy_program(&p);
    finished f = run_so(&p, &(manner){.file_limit = 100}, "new mine");
    cr_expect_eq(f.code, 4, "exit code %d", f.code);
    cr_expect(strstr(f.err, "mine.yaml: could not be written: File too large") && strstr(f.err, "hint: "), "%s", f.err);
    cr_expect_null(read_here(&p, "mine.yaml"));
    finished_clear(&f);
    folder_here(&p, ".", 0555);
    f = run_so(&p, &(manner){.powerless = true}, "new mine");
    cr_expect_eq(f.code, 3, "exit code %d", f.code);
    cr_expect(strstr(f.err, "mine.yaml") && strstr(f.err, "Permission denied") && strstr(f.err, "hint: "), "%s", f.err);
    finished_clear(&f);
    folder_here(&p, ".", 0755);
    write_here(&p, "mine.yaml", "mine");
    f = run(&p, "new mine");
    char *text = read_here(&p, "mine.yaml");
    cr_expect_str_eq(text, "mine");
    cr_expect_not_null(strstr(f.err, "it was not changed"), "%s", f.err);
    free(text);
    finished_clear(&f);
    place_clear(&p);
}

/* A line for a shell; the program is $N. */
static finished run_shell(const place *p, const char *line)
{
    char command[4096];
    snprintf(command, sizeof command, "N='%.400s'; %.3500s", p->program, line);
    return run_vector(p, &(manner){0}, (char *[]){"sh", "-c", command, NULL});
}

/* What a run reads it does not replace, whatever name it is given; two results do not share a file. */
Test(writing, inputs_stay)
{
    static const char *const lines[] = {"$N verify a.yaml --current x --html a.yaml", "$N simulate a.yaml --until 1 --csv ./a.yaml", "$N simulate - --until 1 --svg a.yaml <a.yaml",
                                        "$N simulate a.yaml --initial-table t.csv --csv t.csv", "ln -s a.yaml b.yaml; $N export a.yaml --to c --json b.yaml",
                                        "ln -f t.csv u.svg; $N simulate a.yaml --until 1 --csv t.csv --svg u.svg"};
    place p = place_make();
    write_here(&p, "a.yaml", "name: a\ncoordinates: [x]\nlagrangian: x'^2/2\n");
    write_here(&p, "t.csv", "x\n1\n2\n");
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        finished f = run_shell(&p, lines[i]);
        char *text = read_here(&p, "a.yaml"), *table = read_here(&p, "t.csv");
        cr_expect(f.code == 2 && (strstr(f.err, "which is read") || strstr(f.err, "would write one file")), "%s: %d %s", lines[i], f.code, f.err);
        cr_expect(text && table && !strncmp(text, "name: a", 7) && !strncmp(table, "x\n1", 3), "%s", lines[i]);
        free(text);
        free(table);
        finished_clear(&f);
    }
    place_clear(&p);
}
