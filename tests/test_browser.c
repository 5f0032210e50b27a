/* The page in a browser: headless Chromium, which `make check` installs; where there is none these tests are skipped.
 * tests/browser/look.js measures a page from within, and axe-core looks for what keeps people out. */
#include <cjson/cJSON.h>
#include <math.h>

#include "program.h"
#include "sweep.h"
#include "document/html_internal.h"

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

/* The document after its scripts have run, or NULL without a browser.  What the page says on the console goes to the file console.log. */
static char *document_in(const place *p, const char *page, const char *flags)
{
    char command[2 * PATH_MAX];
    snprintf(command, sizeof command,
             "command -v chromium >/dev/null || exit 3\n"
             "HOME='%.3000s' timeout 100 chromium --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --disable-background-networking --enable-logging=stderr --log-level=0 "
             "%s --user-data-dir='%.3000s/browser' --dump-dom 'file://%.1000s/%s' 2>browser.log\n"
             "code=$?\ngrep -a ':CONSOLE' browser.log >console.log\nexit $code",
             p->folder, flags, p->folder, p->folder, page);
    char *argument[] = {"sh", "-c", command, NULL};
    finished f = run_vector(p, &(manner){0}, argument);
    char *out = f.code == 3 ? NULL : f.out;
    if (out) cr_assert_eq(f.code, 0, "the browser ended with %d", f.code);
    else free(f.out);
    free(f.err);
    return out;
}

/* Timers and animations run ahead of the clock, to their end. */
static const char *const ahead = "--virtual-time-budget=9000";

static char *document_of(const place *p, const char *page) { return document_in(p, page, ahead); }

/* A copy of the page with scripts at its end. */
static void write_with(const place *p, const char *page, const char *copy, size_t scripts, const char *const *script)
{
    char *text = read_here(p, page), *end = strstr(text, "</body>");
    size_t size = strlen(text) + 100;
    for (size_t i = 0; i < scripts; i++) size += strlen(script[i]) + 20;
    char *all = malloc(size), *at = all + sprintf(all, "%.*s", (int)(end - text), text);
    for (size_t i = 0; i < scripts; i++) at += sprintf(at, "<script>%s</script>", script[i]);
    strcpy(at, end);
    write_here(p, copy, all);
    free(all);
    free(text);
}

static char *project_file(const char *path)
{
    FILE *file = fopen(path, "r");
    cr_assert(file, "%s", path);
    char *text = read_stream(file);
    fclose(file);
    return text;
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
    const char *const parts[] = {nh_html_script, nh_html_space, nh_html_style};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        cr_expect_gt(strlen(parts[i]), 1000u);
        cr_expect_null(strpbrk(parts[i], "<&"));
        cr_expect_null(strstr(parts[i], "]]>"));
    }
}

/* The slider at its end: the clock, the cursors of all plots and the drawing are there, too. */
Test(browser, slider_plots_and_drawing_move_together, PLAIN_ONLY)
{
    place p = place_with_page("analyze sleigh --quiet --html page.html");
    write_with(&p, "page.html", "moved.html", 1, (const char *const[]){"var b=document.getElementById('when');b.value=b.max;b.dispatchEvent(new Event('input'));"});
    char *start = document_of(&p, "page.html"), *last = start ? document_of(&p, "moved.html") : NULL;
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

/* A tumbling box: at every time at most three of its faces are seen, the others are outlines without a fill; all of it stays in the picture, and moves. */
Test(browser, bodies_in_space, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "box.yaml", "name: box\nbodies: [{name: box, mass: 2, inertia: [0.3, 0.5, 0.7]}]\njoints: [{type: free, child: box, coordinates: [x, y, z, a, b, c]}]\ngravity: [0, 0, -1]\n");
    finished_clear((finished[]){run_expecting(&p, "simulate box.yaml --initial a=0.3,b=1,a'=1,b'=0.4,c'=2,x'=1 --until 2 --quiet --html page.html", 0)});
    static const char *const LOOK =
        "var out=[],b=document.getElementById('when');for(var i=0;b.max>=i;i+=10){b.value=i;b.dispatchEvent(new Event('input'));"
        "var n=[0,0,0],d='';document.querySelectorAll('#scene path').forEach(function(e){if(e.getAttribute('visibility')==='hidden')return;var f=e.getAttribute('fill'),p=e.getAttribute('d');"
        "if(p.slice(-1)!=='Z')return;n[f==='none'?1:0]++;d=p;p.match(/-?[0-9.]+/g).forEach(function(v,j){if(!(v>=0)||v>(j%2?420:640))n[2]++;});});out.push(n.concat([d]));}"
        "var e=document.createElement('pre');e.id='seen';e.textContent=JSON.stringify(out);document.body.appendChild(e);";
    write_with(&p, "page.html", "looked.html", 1, &LOOK);
    char *seen = document_of(&p, "looked.html"), *at = seen ? strstr(seen, "<pre id=\"seen\">") : NULL;
    if (seen) {
        cr_assert_not_null(at);
        cJSON *list = cJSON_Parse(at + strlen("<pre id=\"seen\">"));
        const cJSON *time, *before = NULL;
        cr_assert_geq(cJSON_GetArraySize(list), 5);
        cJSON_ArrayForEach(time, list) {
            int front = cJSON_GetArrayItem(time, 0)->valueint, behind = cJSON_GetArrayItem(time, 1)->valueint;
            cr_expect(front >= 1 && front <= 3 && front + behind == 6, "%d faces are seen, %d are hidden", front, behind);
            cr_expect_eq(cJSON_GetArrayItem(time, 2)->valueint, 0, "outside of the picture");
            if (before) cr_expect_str_neq(cJSON_GetArrayItem(time, 3)->valuestring, cJSON_GetArrayItem(before, 3)->valuestring);
            before = time;
        }
        cJSON_Delete(list);
    }
    bool skipped = !seen;
    free(seen);
    place_clear(&p);
    if (skipped) cr_skip_test("no chromium");
}

/* The picture for paper shows the faces that the script draws at the end of the motion, and stands in the page's way on paper only. */
Test(browser, the_still_picture_is_the_last_one, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "box.yaml", "name: box\nbodies: [{name: box, mass: 2, inertia: [0.3, 0.5, 0.7]}]\njoints: [{type: free, child: box, coordinates: [x, y, z, a, b, c]}]\ngravity: [0, 0, -1]\n");
    finished_clear((finished[]){run_expecting(&p, "simulate box.yaml --initial a=0.3,b=1,a'=1,b'=0.4,c'=2,x'=1 --until 2 --quiet --html page.html", 0)});
    static const char *const LOOK =
        "var b=document.getElementById('when');b.value=b.max;b.dispatchEvent(new Event('input'));"
        "function faces(of){var o=[];document.querySelectorAll(of+' path').forEach(function(e){if(e.getAttribute('visibility')==='hidden'||e.getAttribute('fill')==='none')return;"
        "o=o.concat(e.getAttribute('d').match(/-?[0-9.]+/g).map(Number));});return o;}"
        "var s=faces('#scene'),t=faces('.still svg'),far=0;s.forEach(function(v,i){far=Math.max(far,Math.abs(v-t[i]));});"
        "var e=document.createElement('pre');e.id='seen';e.textContent=s.length+' '+t.length+' '+far.toFixed(2)+' '+getComputedStyle(document.querySelector('.still')).display;document.body.appendChild(e);";
    write_with(&p, "page.html", "looked.html", 1, &LOOK);
    char *seen = document_of(&p, "looked.html"), *at = seen ? strstr(seen, "<pre id=\"seen\">") : NULL, shown[16] = "";
    if (seen) {
        int moving = 0, still = 0;
        double far = 1e9;
        cr_assert_not_null(at);
        cr_assert_eq(sscanf(at, "<pre id=\"seen\">%d %d %lf %15[a-z]", &moving, &still, &far, shown), 4, "%.80s", at);
        cr_expect(moving >= 8 && moving == still, "%d and %d numbers", moving, still);
        cr_expect_lt(far, 0.3, "%g pixels apart", far);
        cr_expect_str_eq(shown, "none");
    }
    bool skipped = !seen;
    free(seen);
    place_clear(&p);
    if (skipped) cr_skip_test("no chromium");
}

/* Played to its end the motion stays there, or with `loop` it begins again; at four times the speed it takes two seconds, of three that are
 * shown in frames of a tenth. */
Test(browser, a_motion_ends_or_loops, PLAIN_ONLY)
{
#define FRAMES "var n=0;window.requestAnimationFrame=function(f){return n++<30?setTimeout(function(){f(100*n);},1):0;};"
    static const char *const SCRIPT[] = {
        FRAMES "document.getElementById('speed').value='4';document.getElementById('play').click();",
        FRAMES "document.getElementById('speed').value='4';document.getElementById('loop').checked=true;document.getElementById('play').click();",
    };
    place p = place_with_page("analyze sleigh --quiet --html page.html");
    bool skipped = false;
    for (size_t i = 0; i < 2 && !skipped; i++) {
        write_with(&p, "page.html", "played.html", 1, &SCRIPT[i]);
        char *seen = document_of(&p, "played.html");
        skipped = !seen;
        if (seen) {
            cr_expect_eq(strstr(seen, ">t = 10.00</output>") != NULL, i == 0, "%s", SCRIPT[i]);
            cr_expect_eq(strstr(seen, ">Pause</button>") != NULL, i == 1, "%s", SCRIPT[i]);
        }
        free(seen);
    }
    place_clear(&p);
    if (skipped) cr_skip_test("no chromium");
}

/* The pages of a document of Chromium's, whose objects for pages are not compressed. */
static size_t printed_pages(const char *pdf, size_t length)
{
    static const char word[] = "/Type /Page";
    size_t n = 0;
    for (size_t i = 0; i + sizeof word < length; i++) n += !memcmp(pdf + i, word, sizeof word - 1) && pdf[i + sizeof word - 1] != 's';
    return n;
}

Test(browser, the_sleigh_is_few_pages_on_paper, PLAIN_ONLY)
{
    place p = place_with_page("analyze sleigh --quiet --html page.html");
    char *seen = document_in(&p, "page.html", "--no-pdf-header-footer --print-to-pdf=page.pdf"), path[PATH_MAX];
    bool skipped = !seen;
    snprintf(path, sizeof path, "%.4000s/page.pdf", p.folder);
    FILE *file = skipped ? NULL : fopen(path, "rb");
    if (file) {
        enum { most = 1 << 23 };
        char *pdf = malloc(most);
        size_t length = fread(pdf, 1, most, file), pages = printed_pages(pdf, length);
        cr_expect(pages >= 2 && pages <= 8, "%zu pages", pages);
        free(pdf);
        fclose(file);
    }
    cr_expect(skipped || file);
    free(seen);
    place_clear(&p);
    if (skipped) cr_skip_test("no chromium");
}

Test(browser, a_hostile_title_stays_text, PLAIN_ONLY)
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

/* ---- a page looked at from within ---- */

/* What a script left in the document as JSON, or NULL without a browser. */
static cJSON *seen_in(const place *p, const char *page, const char *flags)
{
    char *document = document_in(p, page, flags), *seen = document ? strstr(document, "<pre id=\"seen\">") : NULL;
    cr_assert(!document || seen, "the page was not looked at");
    cJSON *json = NULL;
    if (seen) {
        char *text = seen + 15, *to = text;
        *strstr(text, "</pre>") = 0;
        for (const char *from = text; *from; to++) { /* entities that the browser writes within text */
            static const char *const entity[][2] = {{"&amp;", "&"}, {"&lt;", "<"}, {"&gt;", ">"}};
            size_t taken = 0;
            for (size_t i = 0; i < 3 && !taken; i++)
                if (!strncmp(from, entity[i][0], strlen(entity[i][0]))) *to = *entity[i][1], taken = strlen(entity[i][0]);
            if (!taken) *to = *from, taken = 1;
            from += taken;
        }
        *to = 0;
        json = cJSON_Parse(text);
        cr_assert(json, "%.300s", text);
    }
    free(document);
    return json;
}

/* What look.js saw. */
static cJSON *look_at(const place *p, const char *page, const char *flags)
{
    char *axe = project_file("tests/browser/axe.min.js"), *look = project_file("tests/browser/look.js");
    write_with(p, page, "looked.html", 2, (const char *const[]){axe, look});
    free(axe), free(look);
    return seen_in(p, "looked.html", flags);
}

static const cJSON *of(const cJSON *object, const char *key) { return cJSON_GetObjectItem(object, key); }

static void expect_no_fault(const cJSON *seen, const char *line)
{
    cr_expect_gt(cJSON_GetNumberValue(of(seen, "rules")), 15, "%s: axe-core tried its rules", line);
    for (const cJSON *f = of(seen, "faults")->child; f; f = f->next) {
        const char *impact = cJSON_GetStringValue(of(f, "impact"));
        cr_expect(impact && strcmp(impact, "serious") && strcmp(impact, "critical"), "%s: %s (%s), %g times, first at %s", line, cJSON_GetStringValue(of(f, "id")), impact,
                  cJSON_GetNumberValue(of(f, "nodes")), cJSON_GetStringValue(of(f, "where")));
    }
}

/* Curves over time have a point for every time in the JSON, or for every second one, ... when these are many. */
static void expect_points(const cJSON *seen, const cJSON *result, const char *line)
{
    enum { most_points = 801 };
    const cJSON *motion = of(of(result, "validation"), "motion");
    int times = cJSON_GetArraySize(of(motion, "time")), step = times / most_points + 1, expected = (times + step - 1) / step, curves = 0;
    for (const cJSON *plot = of(seen, "plots")->child; plot; plot = plot->next) {
        if (!cJSON_IsTrue(of(plot, "timed"))) continue;
        for (const cJSON *n = of(plot, "points")->child; n; n = n->next, curves++)
            cr_expect_eq((int)n->valuedouble, expected, "%s: a curve of %s has %d points of %d", line, cJSON_GetStringValue(of(plot, "title")), (int)n->valuedouble, expected);
    }
    cr_expect_gt(curves, 2, "%s: %d curves over time", line, curves);
}

static const char *const SYSTEMS[] = {"sleigh", "car_with_trailer --option work=600", "three_bodies --option work=600", "kepler --option work=600"};

/* Nothing said on the console, nothing fetched, no formula without a box, nothing wider than the window, nobody kept out. */
static void expect_sound(const place *p, const cJSON *seen, const char *line)
{
    char *console = read_here(p, "console.log");
    cr_expect_str_empty(console, "%s: the console says %s", line, console);
    cr_expect_eq(cJSON_GetNumberValue(of(seen, "resources")), 0, "%s: something was fetched", line);
    cr_expect_eq(cJSON_GetArraySize(of(seen, "empty")), 0, "%s: %s has no box", line, cJSON_GetStringValue(cJSON_GetArrayItem(of(seen, "empty"), 0)));
    cr_expect_leq(cJSON_GetNumberValue(of(seen, "width")), cJSON_GetNumberValue(of(seen, "room")), "%s: the page is wider than the window", line);
    expect_no_fault(seen, line);
    free(console);
}

/* The page of a command line that writes page.html; its place is the caller's. */
static cJSON *page_looked_at(place *p, const char *line, const char *flags)
{
    *p = place_make();
    char environment[PATH_MAX + 30];
    snprintf(environment, sizeof environment, "NHSYM_PATH=%s", p->project);
    finished f = run_so(p, &(manner){.environment = (const char *const[]){environment, NULL}}, line);
    finished_clear(&f);
    return look_at(p, "page.html", flags);
}

static const char *const wide_window = "--virtual-time-budget=9000 --window-size=1200,900", *const narrow_dark = "--virtual-time-budget=9000 --window-size=390,844 --force-dark-mode --enable-features=WebContentsForceDark";

Test(browser, pages_are_as_they_should_be, PLAIN_ONLY)
{
    bool skipped = false;
    for (size_t i = 0; !skipped && i < sizeof SYSTEMS / sizeof *SYSTEMS; i++) {
        if (!sweep_tries(i, 18, 18)) continue;
        char line[200];
        place p;
        snprintf(line, sizeof line, "analyze %s --quiet --html page.html --json page.json", SYSTEMS[i]);
        cJSON *seen = page_looked_at(&p, line, i % 2 ? narrow_dark : wide_window);
        skipped = !seen;
        if (seen) {
            char *json = read_here(&p, "page.json");
            cJSON *result = cJSON_Parse(json);
            expect_sound(&p, seen, line);
            cr_expect_gt(cJSON_GetNumberValue(of(seen, "formulas")), 10, "%s", line);
            expect_points(seen, result, line);
            cJSON_Delete(result);
            free(json);
        }
        cJSON_Delete(seen);
        place_clear(&p);
    }
    if (skipped) cr_skip_test("no chromium");
}

Test(browser, so_are_those_of_the_other_commands, PLAIN_ONLY)
{
    static const char *const LINES[] = {
        "verify sleigh --current m*v --quiet --html page.html",
        "simulate sleigh --initial omega=2 --until 5 --quiet --html page.html",
        "benchmark sleigh --budget 500ms --quiet --html page.html",
        "reduce vertical_disk --quiet --html page.html",
    };
    bool skipped = false;
    for (size_t i = 0; !skipped && i < sizeof LINES / sizeof *LINES; i++) {
        if (!sweep_tries(i + 1, 2, 4)) continue;
        place p;
        cJSON *seen = page_looked_at(&p, LINES[i], i % 2 ? narrow_dark : wide_window);
        skipped = !seen;
        if (seen) expect_sound(&p, seen, LINES[i]);
        cJSON_Delete(seen);
        place_clear(&p);
    }
    if (skipped) cr_skip_test("no chromium");
}

/* A page of every shipped system of the sweep, two at a time; their names as a script.  The search is ended early, unless NHSYM_TEST_SECONDS gives it more. */
static void write_every_page(const place *p)
{
    const char *seconds = getenv("NHSYM_TEST_SECONDS");
    char *system[most_files], names[most_files * 60] = "";
    size_t n = list("systems", system), length = 0;
    for (size_t i = 0; i < n; free(system[i++]))
        if (sweep_tries(i + 3, 18, 18)) length += (size_t)snprintf(names + length, sizeof names - length, "%.50s\n", system[i]);
    write_here(p, "names", names);
    char *argument[] = {"sh", "-c", (char[6 * PATH_MAX]){0}, NULL};
    snprintf(argument[2], 6 * PATH_MAX,
             "xargs -P 2 -I @ sh -c \"'%.4000s' analyze @ --quiet %s%.20s %s --html page-@.html; test \\$? = 0 -o \\$? = 5\" <names || exit 1\n"
             "{ echo '<!DOCTYPE html><html><head><title>every page</title></head><body><script>var PAGES = ['; sed 's/.*/\"page-&.html\",/' names; echo '];</script><script>'; "
             "cat '%.4000s/tests/browser/sweep.js'; echo '</script></body></html>'; } >every.html", p->program, seconds ? "--max-seconds " : "--option work=",
             seconds ? seconds : "100", seconds ? "" : "--until 2", p->project);
    finished f = run_vector(p, &(manner){0}, argument);
    cr_assert_eq(f.code, 0, "%s", f.err);
    finished_clear(&f);
}

/* Of every shipped system, as wide as a phone: small, soon there, without a formula that has no box, and no wider than the window. */
Test(browser, the_page_of_every_system, .timeout = 300)
{
    if (sweep_sanitized()) cr_skip_test("the pages are the same, and take very much longer");
    place p = place_with_systems();
    double slowest = 0, sum = 0, largest = 0, ready = 0;
    write_every_page(&p);
    cJSON *every = seen_in(&p, "every.html", "--allow-file-access-from-files");
    char *names = read_here(&p, "names"), *console = every ? read_here(&p, "console.log") : NULL;
    int systems = 0;
    for (const char *c = names; *c; c++) systems += *c == '\n';
    if (console) cr_expect_str_empty(console, "the console says %s", console);
    if (every) cr_expect_eq(cJSON_GetArraySize(every), systems);
    for (const cJSON *s = every ? every->child : NULL; s; s = s->next) {
        const char *name = cJSON_GetStringValue(of(s, "name"));
        char *page = read_here(&p, name);
        largest = fmax(largest, (double)strlen(page));
        slowest = fmax(slowest, ready = cJSON_GetNumberValue(of(s, "ready")));
        sum += ready;
        cr_expect_lt(strlen(page), 1500000u, "%s", name);
        cr_expect_lt(ready, 30000, "%s was ready after %g ms: thirty times what is wanted", name, ready);
        cr_expect_lt(cJSON_GetNumberValue(of(s, "nodes")), 50000, "%s has so many elements that no browser is quick with it", name);
        cr_expect_eq(cJSON_GetNumberValue(of(s, "fetched")), 0, "%s: something was fetched", name);
        cr_expect_gt(cJSON_GetNumberValue(of(s, "formulas")), 3, "%s", name);
        cr_expect_eq(cJSON_GetArraySize(of(s, "empty")), 0, "%s: %s has no box", name, cJSON_GetStringValue(cJSON_GetArrayItem(of(s, "empty"), 0)));
        cr_expect_leq(cJSON_GetNumberValue(of(s, "wide")), cJSON_GetNumberValue(of(s, "room")), "%s is wider than the window", name);
        free(page);
    }
    if (every) fprintf(stderr, "measured: pages of %d systems, ready after %.0f ms on average and %.0f ms at most, %.0f kB at most\n", systems, sum / systems, slowest, largest / 1000);
    bool skipped = !every;
    free(names), free(console);
    cJSON_Delete(every);
    place_clear(&p);
    if (skipped) cr_skip_test("no chromium");
}
