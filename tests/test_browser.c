/* The page in a browser: headless Chromium, where it is installed (`apt-get install chromium`); without it these tests are skipped. */
#include "program.h"
#include "report/html_internal.h"

static place place_with_page(const char *line)
{
    place p = place_make();
    char environment[PATH_MAX + 30];
    snprintf(environment, sizeof environment, "NHSYM_PATH=%s", p.project);
    finished f = run_so(&p, &(manner){.environment = (const char *const[]){environment, NULL}}, line);
    cr_assert_eq(f.code, 0, "%s", f.err);
    finished_clear(&f);
    return p;
}

/* The document after its scripts have run, or NULL without a browser. */
static char *document_of(const place *p, const char *page)
{
    char command[2 * PATH_MAX];
    snprintf(command, sizeof command,
             "command -v chromium >/dev/null || exit 3\n"
             "HOME='%.3000s' timeout 100 chromium --headless --no-sandbox --disable-gpu --virtual-time-budget=3000 --user-data-dir='%.3000s/browser' --dump-dom 'file://%.1000s/%s' 2>/dev/null",
             p->folder, p->folder, p->folder, page);
    char *argument[] = {"sh", "-c", command, NULL};
    finished f = run_vector(p, &(manner){0}, argument);
    char *out = f.code == 3 ? NULL : f.out;
    if (out) cr_assert_eq(f.code, 0, "the browser ended with %d", f.code);
    else free(f.out);
    free(f.err);
    return out;
}

/* The value of an attribute of the first element that begins with `element`. */
static double attribute(const char *text, const char *element, const char *name)
{
    const char *at = strstr(text, element), *end = at ? strchr(at, '>') : NULL, *value = at ? strstr(at, name) : NULL;
    cr_assert(value && value < end, "%s has no %s", element, name);
    return strtod(value + strlen(name), NULL);
}

/* This one needs no browser: what stands in the page as CDATA may hold no end of it, nor of the element for readers of HTML. */
Test(browser, script_and_style_may_stand_in_a_page)
{
    const char *const parts[] = {nh_html_script, nh_html_style};
    for (size_t i = 0; i < 2; i++) {
        cr_expect_gt(strlen(parts[i]), 1000u);
        cr_expect_null(strpbrk(parts[i], "<&"));
        cr_expect_null(strstr(parts[i], "]]>"));
    }
}

/* The slider at its end: the clock, the cursors of all plots and the drawing are there, too. */
Test(browser, slider_plots_and_drawing_move_together)
{
    place p = place_with_page("analyze sleigh --quiet --html page.html");
    char *page = read_here(&p, "page.html"), *end = strstr(page, "</body>"), *moved = malloc(strlen(page) + 400);
    sprintf(moved, "%.*s<script>var b=document.getElementById('when');b.value=b.max;b.dispatchEvent(new Event('input'));</script>%s", (int)(end - page), page, end);
    write_here(&p, "moved.html", moved);
    char *start = document_of(&p, "page.html"), *last = start ? document_of(&p, "moved.html") : NULL;
    free(page), free(moved);
    if (start) {
        cr_expect_not_null(strstr(start, ">t = 0.000</output>"), "the clock at the start");
        cr_expect_not_null(strstr(last, ">t = 10.00</output>"), "and at the end");
        cr_expect_null(strstr(start, "id=\"player\" hidden"), "the player is shown when scripts run");
        size_t cursors = 0;
        for (const char *c = last; (c = strstr(c, "data-x1=\"")); c++, cursors++) {
            double x1 = strtod(c + 9, NULL), now = attribute(c, "<line class=\"now\"", "x1=\"");
            cr_expect_float_eq(now, x1, 0.06, "cursor %zu at %g of %g", cursors, now, x1);
        }
        cr_expect_gt(cursors, 6u);
        /* The blade's drawing: from behind to before (x, y), and far from where it began. */
        const char *scene = strstr(start, "id=\"scene\""), *later = strstr(last, "id=\"scene\"");
        double x = attribute(scene, "<line", "x1=\""), to = attribute(later, "<line", "x1=\"");
        cr_expect_gt(x - to, 300.0, "from %g to %g", x, to);
    }
    bool skipped = !start;
    free(start), free(last);
    place_clear(&p);
    if (skipped) cr_skip_test("no chromium");
}

Test(browser, a_hostile_title_stays_text)
{
    place p = place_make();
    write_here(&p, "h.yaml", "name: h\ntitle: \"<img src=x onerror=document.body.id='pwned'></title><script>document.body.id='pwned'</script>\"\n"
                             "coordinates:\n  - {name: x, type: length, doc: \"<svg onload=document.body.id='pwned'>\"}\nlagrangian: x'^2\n");
    finished f = run_expecting(&p, "analyze h.yaml --quiet --html page.html", 0);
    finished_clear(&f);
    char *page = document_of(&p, "page.html");
    if (page) {
        cr_expect_null(strstr(page, "id=\"pwned\""));
        cr_expect_not_null(strstr(page, "&lt;script&gt;document.body.id"), "the title is on the page, as text");
    }
    bool skipped = !page;
    free(page);
    place_clear(&p);
    if (skipped) cr_skip_test("no chromium");
}
