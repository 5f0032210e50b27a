/* The page in a browser: headless Chromium, which `make check` installs; where there is none these tests are skipped.
 * tests/browser/look.js measures a page from within, and axe-core looks for what keeps people out. */
#include <cjson/cJSON.h>
#include <math.h>

#include "program.h"
#include "sweep.h"
#include "document/page.h"

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

/* This one needs no browser: what stands in the page as CDATA may hold no end of it, nor of the element for readers of HTML. */
Test(browser, script_and_style_may_stand_in_a_page)
{
    const char *const parts[] = {nh_page_script, nh_page_scene, nh_page_solver, nh_page_special, nh_page_style};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        cr_expect_gt(strlen(parts[i]), 1000u);
        cr_expect_null(strstr(parts[i], "</script"));
        cr_expect_null(strstr(parts[i], "]]>"));
    }
}

/* Readers without scripts, and paper, have the picture and the plots as they are in the file. */
Test(browser, a_page_without_scripts_has_its_pictures)
{
    place p = place_with_page("analyze kepler --quiet --html page.html");
    char *text = read_here(&p, "page.html"), *still = strstr(text, "<div class=\"still\"><figure><svg "), *plots = strstr(text, "<div class=\"plots\">");
    size_t n = 0;
    for (const char *c = plots; c && (c = strstr(c, "<figure class=\"plot\"")); c++) n += strstr(c, "<svg ") < strstr(c, "</figure>");
    cr_expect(still && plots && n >= 3, "%zu plots", n);
    free(text);
    place_clear(&p);
}

/* The page of a reduction, and of a question, shows the motion with the same formulas as that of `simulate`. */
Test(browser, the_motion_of_other_pages)
{
    static const char *const lines[] = {"simulate crane --quiet --html page.html", "reduce crane --quiet --html page.html", "verify crane --current theta --quiet --html page.html"};
    char *row[3] = {NULL};
    for (size_t i = 0; i < 3; i++) {
        place p = place_with_systems();
        finished_clear((finished[]){run(&p, lines[i])});
        char *text = read_here(&p, "page.html"), *at = strstr(text, "<tr data-quantity=\"0\""), *end = at ? strstr(at, "</tr>") : NULL;
        cr_assert(end, "%s has no table of quantities", lines[i]);
        row[i] = strndup(at, (size_t)(end - at));
        cr_expect_str_eq(row[i], row[0], "%s", lines[i]);
        free(text);
        place_clear(&p);
    }
    for (size_t i = 0; i < 3; i++) free(row[i]);
}

/* ---- the page at work: what a script leaves in it as JSON ---- */

static const cJSON *of(const cJSON *object, const char *key) { return cJSON_GetObjectItem(object, key); }

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

/* The page after a script, which calls leave(value). */
static cJSON *page_after(const place *p, const char *script)
{
    static const char *const LEAVE = "function leave(value){var e=document.createElement('pre');e.id='seen';e.textContent=JSON.stringify(value);document.body.appendChild(e);}"
                                     "function slide(e,v){e.value=v;e.dispatchEvent(new Event('input'));}var $=function(s){return document.querySelector(s);};";
    write_with(p, "page.html", "after.html", 2, (const char *const[]){LEAVE, script});
    return seen_in(p, "after.html", ahead);
}

/* The slider of the time at its end: the clock, the cursors of all plots and the picture are there, too. */
Test(browser, slider_plots_and_drawing_move_together, PLAIN_ONLY)
{
    place p = place_with_page("analyze sleigh --quiet --html page.html");
    cJSON *seen = page_after(&p, "nhsymLive.play(false);var scene=function(){return $('.scene g:nth-of-type(4)').innerHTML;};slide($('#time'),0);var first=scene();slide($('#time'),1000);"
                                 "leave({clock:$('#clock').textContent,cursors:[...document.querySelectorAll('svg.live')].map(function(s){var l=s.querySelector('line.now');return s.viewBox.baseVal.width-l.getAttribute('x1');}),"
                                 "moved:first!==scene()});");
    if (seen) {
        cr_expect_str_eq(cJSON_GetStringValue(of(seen, "clock")), "t = 10.00");
        cr_expect_geq(cJSON_GetArraySize(of(seen, "cursors")), 6);
        for (const cJSON *c = of(seen, "cursors")->child; c; c = c->next) cr_expect_float_eq(c->valuedouble, 8, 0.01, "a cursor %g from the right edge", c->valuedouble);
        cr_expect(cJSON_IsTrue(of(seen, "moved")));
    }
    bool skipped = !seen;
    cJSON_Delete(seen);
    place_clear(&p);
    if (skipped) cr_skip_test("no chromium");
}

/* Sliders of a parameter and of the state: the end of the motion that the page computes is that of the command which the page offers, and the table says
 * which quantities need other values. */
Test(browser, a_slider_recomputes_the_motion, PLAIN_ONLY)
{
    static const struct {
        const char *system, *slide;
        int gone; /* quantities that the new values do not conserve */
    } pages[] = {
        {"sleigh", "set('k',3);set('omega',1.5);", 2},
        {"sleigh", "set('v',-1);", 0},
        {"pendulum", "set('theta',2);set('l',0.5);", 0},
        {"rolling_disk", "set('h',1.2);set(\"s'\",2);", 0},
        {"car_with_trailer", "set('x',0.4);", 0},
    };
    bool skipped = false;
    for (size_t i = 0; i < sizeof pages / sizeof *pages && !skipped; i++) {
        if (!sweep_tries(i, 1, 2)) continue;
        char line[100], script[900];
        snprintf(line, sizeof line, "analyze %s --quiet --html page.html", pages[i].system);
        place p = place_with_page(line);
        snprintf(script, sizeof script,
                 "nhsymLive.play(false);function set(name,v){slide(document.querySelector('.sl[data-name=\"'+name+'\"] input'),v);}%s"
                 "setTimeout(function(){slide($('#time'),1000);var m=nhsymModel,l=nhsymLive.motion,s=[...l.state(l.end)];"
                 "leave({command:$('#command').textContent,names:m.state,state:s,ms:+document.documentElement.dataset.milliseconds,gone:document.querySelectorAll('tr.off').length,told:$('#told').textContent});},500);",
                 pages[i].slide);
        cJSON *seen = page_after(&p, script);
        skipped = !seen;
        if (seen) {
            const char *command = cJSON_GetStringValue(of(seen, "command"));
            cr_expect_eq((int)cJSON_GetNumberValue(of(seen, "gone")), pages[i].gone, "%s %s", pages[i].system, pages[i].slide);
            char shell[3 * PATH_MAX];
            cr_assert_eq(strncmp(command, "nhsym simulate ", 15), 0, "%s", command);
            snprintf(shell, sizeof shell, "NHSYM_PATH='%.2000s' '%.2000s' %.2000s --json end.json --quiet >/dev/null", p.project, p.program, command + 6);
            finished f = run_vector(&p, &(manner){0}, (char *[]){"sh", "-c", shell, NULL});
            cr_assert_eq(f.code, 0, "%s: %s", shell, f.err);
            finished_clear(&f);
            char *text = read_here(&p, "end.json");
            cJSON *json = cJSON_Parse(text);
            for (int k = 0; k < cJSON_GetArraySize(of(seen, "names")); k++) {
                const char *name = cJSON_GetStringValue(cJSON_GetArrayItem(of(seen, "names"), k));
                const cJSON *values = of(of(json, "states"), name);
                cr_assert(values, "%s has no %s", text, name);
                double there = cJSON_GetNumberValue(cJSON_GetArrayItem(values, cJSON_GetArraySize(values) - 1)), here = cJSON_GetNumberValue(cJSON_GetArrayItem(of(seen, "state"), k));
                cr_expect_float_eq(here, there, 2e-6 * fmax(1, fabs(there)), "%s, %s: %s ends at %.12g, in the page at %.12g (%s)", pages[i].system, pages[i].slide, name, there, here,
                                   cJSON_GetStringValue(of(seen, "told")));
            }
            fprintf(stderr, "measured: %s redrawn in %.1f ms\n", pages[i].system, cJSON_GetNumberValue(of(seen, "ms")));
            cJSON_Delete(json);
            free(text);
        }
        cJSON_Delete(seen);
        place_clear(&p);
    }
    if (skipped) cr_skip_test("no chromium");
}

/* Hover shows values, a drag zooms, a name switches its curve off, a key turns the bodies; the address has what was changed. */
Test(browser, plots_and_bodies_answer, PLAIN_ONLY)
{
    place p = place_with_page("analyze lagrange_top --quiet --html page.html");
    cJSON *seen = page_after(&p, "nhsymLive.play(false);var s=$('svg.live'),b=s.getBoundingClientRect();s.setPointerCapture=function(){};"
                                 "function at(type,x){s.dispatchEvent(new PointerEvent(type,{clientX:b.left+x,clientY:b.top+50,pointerId:1,bubbles:true}));}"
                                 "at('pointermove',100);var hover=s.querySelector('line.hover').getAttribute('visibility');"
                                 "at('pointerdown',100);at('pointermove',200);at('pointerup',200);var zoomed=!$('#unzoom').hidden;$('#unzoom').click();"
                                 "var curves=function(){return $('svg.live g[clip-path]').children.length;},all=curves();$('button.lg').click();"
                                 "var fewer=curves();slide($('.sl input'),1.5);setTimeout(function(){leave({hover:hover,zoomed:zoomed,unzoomed:$('#unzoom').hidden,all:all,fewer:fewer,hash:location.hash,"
                                 "frames:new DOMParser().parseFromString(nhsymLive.movie(),'image/svg+xml').querySelectorAll('svg>g>animate').length});},300);");
    if (seen) {
        cr_expect_str_eq(cJSON_GetStringValue(of(seen, "hover")), "visible");
        cr_expect(cJSON_IsTrue(of(seen, "zoomed")) && cJSON_IsTrue(of(seen, "unzoomed")));
        cr_expect_eq((int)cJSON_GetNumberValue(of(seen, "fewer")), (int)cJSON_GetNumberValue(of(seen, "all")) - 1);
        cr_expect_str_eq(cJSON_GetStringValue(of(seen, "hash")), "#A=1.5");
        cr_expect_eq((int)cJSON_GetNumberValue(of(seen, "frames")), 80, "the picture as an animation");
    }
    bool skipped = !seen;
    cJSON_Delete(seen);
    place_clear(&p);
    if (skipped) cr_skip_test("no chromium");
}

/* A tumbling box: at every time at most three of its faces are seen, the others are outlines without a fill; all of it stays in the picture, moves, and turns
 * under the arrow keys. */
Test(browser, bodies_in_space, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "box.yaml", "name: box\nbodies: [{name: box, mass: 2, inertia: [0.3, 0.5, 0.7]}]\njoints: [{type: free, child: box, coordinates: [x, y, z, a, b, c]}]\ngravity: [0, 0, -1]\n");
    finished_clear((finished[]){run_expecting(&p, "simulate box.yaml --initial a=0.3,b=1,a'=1,b'=0.4,c'=2,x'=1 --until 2 --quiet --html page.html", 0)});
    cJSON *seen = page_after(&p, "nhsymLive.play(false);var box=$('.scene').viewBox.baseVal;function look(){var n=[0,0,0],d='';document.querySelectorAll('.scene g:nth-of-type(4) path').forEach(function(e){"
                                 "var f=e.getAttribute('fill'),p=e.getAttribute('d');if(p.slice(-1)!=='Z')return;n[f==='none'?1:0]++;d=p;"
                                 "p.match(/-?[0-9.]+/g).forEach(function(v,j){if(!(v>=0)||v>(j%2?box.height:box.width))n[2]++;});});return n.concat([d]);}"
                                 "var out=[];for(var i=0;i<=1000;i+=50){slide($('#time'),i);out.push(look());}"
                                 "$('.scene').dispatchEvent(new KeyboardEvent('keydown',{key:'ArrowLeft'}));out.push(look());leave(out);");
    const cJSON *before = NULL;
    if (seen) cr_assert_eq(cJSON_GetArraySize(seen), 22);
    for (const cJSON *time = seen ? seen->child : NULL; time; before = time, time = time->next) {
        int front = cJSON_GetArrayItem(time, 0)->valueint, behind = cJSON_GetArrayItem(time, 1)->valueint;
        cr_expect(front >= 1 && front <= 3 && front + behind == 6, "%d faces are seen, %d are hidden", front, behind);
        cr_expect_eq(cJSON_GetArrayItem(time, 2)->valueint, 0, "outside of the picture");
        if (before) cr_expect_str_neq(cJSON_GetArrayItem(time, 3)->valuestring, cJSON_GetArrayItem(before, 3)->valuestring);
    }
    bool skipped = !seen;
    cJSON_Delete(seen);
    place_clear(&p);
    if (skipped) cr_skip_test("no chromium");
}

/* A motion that the page cannot compute, here by its many states, is shown as it was computed, and the page says why. */
Test(browser, a_large_motion_is_shown, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "chain.yaml", "name: chain\ncoordinates: [a, b, c, d, e, f, g, h, i, j, k]\nlagrangian: (a'^2+b'^2+c'^2+d'^2+e'^2+f'^2+g'^2+h'^2+i'^2+j'^2+k'^2)/2 - ((a-b)^2+(b-c)^2+(c-d)^2+(d-e)^2+(e-f)^2+(f-g)^2+(g-h)^2+(h-i)^2+(i-j)^2+(j-k)^2)/2\n");
    finished_clear((finished[]){run_expecting(&p, "simulate chain.yaml --initial a=1 --until 3 --json m.json --quiet --html page.html", 0)});
    cJSON *seen = page_after(&p, "nhsymLive.play(false);slide($('#time'),1000);leave({told:$('#told').textContent,sliders:document.querySelectorAll('.sl').length,a:nhsymLive.motion.at(3)[0]});");
    if (seen) {
        char *text = read_here(&p, "m.json");
        cJSON *json = cJSON_Parse(text);
        const cJSON *a = of(of(json, "states"), "a");
        cr_expect_float_eq(cJSON_GetNumberValue(of(seen, "a")), cJSON_GetNumberValue(cJSON_GetArrayItem(a, cJSON_GetArraySize(a) - 1)), 1e-4);
        cr_expect(strstr(cJSON_GetStringValue(of(seen, "told")), "22 states"), "%s", cJSON_GetStringValue(of(seen, "told")));
        cr_expect_eq((int)cJSON_GetNumberValue(of(seen, "sliders")), 0);
        cJSON_Delete(json);
        free(text);
    }
    bool skipped = !seen;
    cJSON_Delete(seen);
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

/* What look.js saw. */
static cJSON *look_at(const place *p, const char *page, const char *flags)
{
    char *axe = project_file("tests/browser/axe.min.js"), *look = project_file("tests/browser/look.js");
    write_with(p, page, "looked.html", 2, (const char *const[]){axe, look});
    free(axe), free(look);
    return seen_in(p, "looked.html", flags);
}

static void expect_no_fault(const cJSON *seen, const char *line)
{
    cr_expect_gt(cJSON_GetNumberValue(of(seen, "rules")), 15, "%s: axe-core tried its rules", line);
    for (const cJSON *f = of(seen, "faults")->child; f; f = f->next) {
        const char *impact = cJSON_GetStringValue(of(f, "impact"));
        cr_expect(impact && strcmp(impact, "serious") && strcmp(impact, "critical"), "%s: %s (%s), %g times, first at %s", line, cJSON_GetStringValue(of(f, "id")), impact,
                  cJSON_GetNumberValue(of(f, "nodes")), cJSON_GetStringValue(of(f, "where")));
    }
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
    cr_expect_eq(cJSON_GetNumberValue(of(seen, "hyphens")), 0, "%s: a product is broken at a hyphen", line);
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
        snprintf(line, sizeof line, "analyze %s --quiet --html page.html", SYSTEMS[i]);
        cJSON *seen = page_looked_at(&p, line, i % 2 ? narrow_dark : wide_window);
        skipped = !seen;
        if (seen) {
            expect_sound(&p, seen, line);
            cr_expect_gt(cJSON_GetNumberValue(of(seen, "formulas")), 10, "%s", line);
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

/* The long curve of Euler's disk stands in a narrow cell of a table. */
Test(browser, products_break_at_a_dot, PLAIN_ONLY)
{
    place p;
    cJSON *seen = page_looked_at(&p, "analyze euler_disk --option work=200 --quiet --html page.html", wide_window);
    if (seen) cr_expect_eq(cJSON_GetNumberValue(of(seen, "hyphens")), 0);
    bool skipped = !seen;
    cJSON_Delete(seen);
    place_clear(&p);
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
Test(browser, the_page_of_every_system)
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
