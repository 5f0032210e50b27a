/* Whatever writes a file writes it whole or not at all: a full disk, a folder that may not be written to and an interruption leave the old one, and say so. */
#include <dirent.h>

#include "program.h"

/* %s: the file */
static const char *const WRITERS[] = {
    "analyze free_particle --quiet --json %s",
    "analyze free_particle --quiet --html %s",
    "analyze free_particle --quiet --tex %s",
    "verify free_particle --current x --quiet --json %s",
    "simulate free_particle --initial x=1 --until 1 --json %s",
    "chart free_particle --initial x=1 --until 1 --budget 100ms --quiet --json %s",
    "chart free_particle --initial x=1 --until 1 --budget 100ms --quiet --svg %s",
    "reduce vertical_disk --quiet --json %s",
    "verify free_particle --current x --quiet --html %s",
    "simulate free_particle --initial x=1 --until 1 --quiet --html %s",
    "chart free_particle --initial x=1 --until 1 --budget 100ms --quiet --html %s",
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

Test(writing, a_full_disk_leaves_the_old_file)
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
Test(writing, a_full_device_is_told)
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
