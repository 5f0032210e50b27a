/* The picture of --svg as PDF, where rsvg-convert is installed; without it a message that names the package, and no file. */
#include <string.h>

#include "program.h"

static bool has_converter(void)
{
    if (system("command -v rsvg-convert >/dev/null 2>&1") == 0) return true;
    printf("skipped: no rsvg-convert (Debian: librsvg2-bin)\n");
    return false;
}

Test(pdf, is_written_beside_the_svg_and_the_same_each_time)
{
    if (!has_converter()) return;
    place p = place_with_systems();
    finished f = run_expecting(&p, "simulate sleigh --initial omega=2 --until 3 --quiet --svg a.svg --pdf a.pdf", 0), g;
    char *svg = read_here(&p, "a.svg"), *pdf = read_here(&p, "a.pdf");
    cr_expect(svg && strstr(svg, "<svg"));
    cr_expect(pdf && !strncmp(pdf, "%PDF-", 5), "%.20s", pdf ? pdf : "no file");
    cr_expect_str_empty(f.out);
    g = run_expecting(&p, "simulate sleigh --initial omega=2 --until 3 --pdf -", 0);
    cr_expect(!strncmp(g.out, "%PDF-", 5), "--pdf - prints it and nothing else: %.40s", g.out);
    cr_expect_str_eq(g.out, pdf);
    free(svg);
    free(pdf);
    finished_clear(&f);
    finished_clear(&g);
    place_clear(&p);
}

Test(pdf, without_the_converter_the_package_is_named)
{
    static const char *const nowhere[] = {"PATH=/nowhere", NULL};
    place p = place_with_systems();
    finished f = run_so(&p, &(manner){.environment = nowhere}, "simulate sleigh --initial omega=2 --until 3 --quiet --svg a.svg --pdf a.pdf");
    cr_expect_eq(f.code, 4, "%d %s", f.code, f.err);
    cr_expect(strstr(f.err, "no program rsvg-convert") && strstr(f.err, "librsvg2-bin"), "%s", f.err);
    char path[PATH_MAX + 10];
    snprintf(path, sizeof path, "%s/a.pdf", p.folder);
    cr_expect_neq(access(path, F_OK), 0);
    snprintf(path, sizeof path, "%s/a.svg", p.folder);
    cr_expect_neq(access(path, F_OK), 0, "it is said before anything is computed");
    finished_clear(&f);
    place_clear(&p);
}
