/* The page of an analysis: what it says is what the JSON says, it is well-formed, and no file can make it run anything. */
#include <cjson/cJSON.h>
#include <ctype.h>
#include <math.h>

#include "document/typeset.h"
#include "graph/parse.h"
#include "numbers.h"
#include "program.h"
#include "sweep.h"
#include "document/formula.h"
#include "graph/dag.h"

/* ---- a reader of XML, as strict as a parser: tags match, attributes are quoted and distinct from text, entities are known ---- */

typedef struct {
    const char *at;
    char open[200][40];
    int depth;
    char fault[200];
} reader;

static bool fail(reader *r, const char *why)
{
    snprintf(r->fault, sizeof r->fault, "%s at: %.80s", why, r->at);
    return false;
}

static bool entity(reader *r)
{
    static const char *const known[] = {"&lt;", "&gt;", "&amp;", "&quot;", "&#39;"};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (!strncmp(r->at, known[i], strlen(known[i]))) return r->at += strlen(known[i]), true;
    return fail(r, "unknown entity");
}

static bool attribute(reader *r)
{
    size_t name = strspn(r->at, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ-0123456789");
    if (!name || strncmp(r->at + name, "=\"", 2)) return fail(r, "attribute");
    for (r->at += name + 2; *r->at != '"';) {
        if (!*r->at || *r->at == '<') return fail(r, "attribute value");
        if (*r->at == '&' ? !entity(r) : !r->at++) return false;
    }
    r->at++;
    return true;
}

static bool tag(reader *r)
{
    bool closing = r->at[1] == '/';
    r->at += 1 + closing;
    size_t n = strspn(r->at, "abcdefghijklmnopqrstuvwxyz0123456789");
    if (!n || n >= sizeof r->open[0]) return fail(r, "tag");
    const char *name = r->at;
    r->at += n;
    if (closing) {
        if (r->depth == 0 || strlen(r->open[r->depth - 1]) != n || strncmp(r->open[r->depth - 1], name, n)) return fail(r, "closing tag");
        r->depth--;
        return *r->at++ == '>' || fail(r, "closing tag");
    }
    while (isspace((unsigned char)*r->at)) {
        while (isspace((unsigned char)*r->at)) r->at++;
        if (*r->at != '>' && *r->at != '/' && !attribute(r)) return false;
    }
    if (*r->at == '/') return r->at++, *r->at++ == '>' || fail(r, "empty tag");
    if (*r->at++ != '>' || r->depth == 200) return fail(r, "tag");
    snprintf(r->open[r->depth++], sizeof r->open[0], "%.*s", (int)n, name);
    return true;
}

static bool well_formed(reader *r, const char *page)
{
    *r = (reader){.at = page};
    if (strncmp(page, "<!DOCTYPE html>", 15)) return fail(r, "no doctype");
    for (r->at += 15; *r->at;) {
        unsigned char c = (unsigned char)*r->at;
        if (!strncmp(r->at, "<![CDATA[", 9)) {
            const char *end = strstr(r->at, "]]>");
            if (!end) return fail(r, "CDATA");
            r->at = end + 3;
        } else if (c == '<') {
            if (!tag(r)) return false;
        } else if (c == '&') {
            if (!entity(r)) return false;
        } else if (c < 0x20 && c != '\n' && c != '\t') {
            return fail(r, "control character");
        } else {
            r->at++;
        }
    }
    return r->depth == 0 || fail(r, "open tags at the end");
}

/* ---- pages ---- */

/* Is this place of the page within a script? */
static bool in_script(const char *page, const char *at)
{
    const char *open = NULL, *close = page;
    for (const char *c = page; (c = strstr(c, "<script")) && c < at; c++) open = c;
    if (open) close = strstr(open, "</script>");
    return open && close > at;
}

static char *page_of(const place *p, const char *line, int code)
{
    char all[600];
    snprintf(all, sizeof all, "%s --quiet --html page.html --json page.json", line);
    finished f = run_expecting(p, all, code);
    cr_assert_str_empty(f.out, "--quiet prints nothing");
    finished_clear(&f);
    char *page = read_here(p, "page.html");
    cr_assert_not_null(page);
    reader r;
    cr_assert(well_formed(&r, page), "%s", r.fault);
    cr_expect_lt(strlen(page), 1500000u);
    return page;
}

static const char *const SYSTEMS[] = {"sleigh", "euler_disk --option work=900", "contact_oscillator --option work=300", "perpendicular_velocities --option work=300", "rolling_ball --option work=900", "heisenberg_particle", "appell_hamel", "kepler --option work=900", "free_particle", "spherical_pendulum"};

/* The whole page, number by number: <data value="x"> is in the JSON, to the last digit, and what is shown is x rounded.  Returns how many. */
static size_t compare_numbers(const char *page, const cJSON *json, const char *line)
{
    size_t numbers = 0;
    all_numbers known = numbers_of_json(json);
    for (const char *c = page; (c = strstr(c, "<data value=\"")); c++, numbers++) {
        const char *text = strchr(c, '>') + 1, *power = strstr(c, "<sup>"), *end = strstr(c, "</data>");
        bool minus = !strncmp(text, "\u2212", 3);
        double shown = strtod(text + (minus ? 3 : 0), NULL);
        if (power && power < end && !strncmp(text + (minus ? 3 : 0), "10<sup>", 7)) shown = 1; /* 10^-9, without a factor */
        if (power && power < end) shown *= pow(10, strncmp(power + 5, "\u2212", 3) ? strtod(power + 5, NULL) : -strtod(power + 8, NULL));
        expect_number(&known, strtod(c + 13, NULL), minus ? -shown : shown, 0.35, line);
    }
    free(known.value);
    return numbers;
}

/* A page that is not well-formed, or shows a formula as code, is refused here; besides, the page and the JSON of a command. */
static char *both(const place *p, const char *command, const char *const *also, cJSON **json)
{
    char line[400];
    snprintf(line, sizeof line, "%s --quiet --html page.html --json page.json", command);
    finished f;
    unlink_here(p, "page.html"), unlink_here(p, "page.json"); /* an older page would do */
    if (also) { /* with words that hold blanks */
        char *argument[12] = {(char *)p->program, "verify", "sleigh", (char *)also[0], (char *)also[1], "--quiet", "--html", "page.html", "--json", "page.json", NULL};
        f = run_vector(p, &(manner){0}, argument);
    } else {
        f = run(p, line);
    }
    char *page = read_here(p, "page.html"), *text = read_here(p, "page.json");
    cr_assert(page && text, "%s: %s", line, f.err);
    finished_clear(&f);
    reader r;
    cr_assert(well_formed(&r, page), "%s: %s", line, r.fault);
    cr_expect_null(strstr(page, "<div class=\"formula\"><code>"), "%s: a formula as code", line);
    for (const char *c = page; (c = strstr(c, "NaN")); c++) cr_expect(in_script(page, c), "%s", line);
    *json = cJSON_Parse(text);
    cr_assert_not_null(*json, "%s", line);
    free(text);
    return page;
}

/* Summary, page and LaTeX ask this: coefficients that were recognised need no word about how they were computed. */
Test(html, a_current_without_proof_says_why)
{
    nh_current f = {.exact = true, .asked = true, .refined = 60, .proof = {.digits = 60}};
    cr_expect_str_eq(nh_formula_doubt(&f), " (not proved)");
    f.exact = false;
    cr_expect_str_eq(nh_formula_doubt(&f), " with its coefficients refined");
    f.refined = 20;
    cr_expect_str_eq(nh_formula_doubt(&f), " (coefficients fitted in double precision)");
}

static bool any_name(void *context, const char *name, nh_ex *out, nh_parse_fault *fault)
{
    (void)fault;
    *out = nh_symbol(context, name);
    return true;
}

/* Sums that are equal, or minus each other, are written the same way, at every depth; others are left alone. */
Test(html, equal_sums_in_formulas_are_written_once)
{
    static const struct {
        const char *a, *b;
        bool same;
    } cases[] = {{"x/(5*m*(90*m + 2*(30*m + 25*m*l*c + 21)*c) + 623)", "x/(5*m*(90*m + 2*(5*m*(5*l*c + 6) + 21)*c) + 623)", true},
                 {"x*exp(sin(c)^2 + cos(l)^2 - 1)", "x*exp(cos(l)^2 - cos(c)^2)", true},
                 {"x*(l*m + 3*c*(m + l))", "-x*(-l*m - 3*c*m - 3*c*l)", true},
                 {"x*(l*m + 3*c*(m + l))", "x*(l*m + 3*c*(m + 1.000000001*l))", false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        nh_dag *d = nh_dag_create();
        nh_parse_fault fault;
        nh_ex e[2], before[2];
        cr_assert(nh_parse(d, cases[i].a, any_name, d, &e[0], &fault) && nh_parse(d, cases[i].b, any_name, d, &e[1], &fault), "%s", fault.what);
        memcpy(before, e, sizeof e);
        cr_assert_neq(e[0], e[1]);
        nh_formula_unify(d, 2, e);
        cr_expect_eq(e[0] == e[1], cases[i].same, "%s, %s", cases[i].a, cases[i].b);
        if (!cases[i].same) cr_expect(e[0] == before[0] && e[1] == before[1]);
        nh_dag_free(d);
    }
}

Test(html, every_number_is_in_the_json)
{
    place p = place_with_systems();
    for (size_t s = 0; s < sizeof SYSTEMS / sizeof *SYSTEMS; s++) {
        if (!sweep_tries(s + 1, 8, 16)) continue;
        char line[200];
        cJSON *json;
        snprintf(line, sizeof line, "analyze %s", SYSTEMS[s]);
        char *page = both(&p, line, NULL, &json);
        size_t numbers = compare_numbers(page, json, line);
        cr_expect_gt(numbers, 15u, "%s: %zu numbers", line, numbers);
        int currents = 0, cards = 0;
        for (size_t k = 0; k < 3; k++) currents += cJSON_GetArraySize(cJSON_GetObjectItem(json, ((const char *const[]){"currents", "currents_in_regions", "further_integrals"})[k]));
        for (const char *c = page; (c = strstr(c, "<article class=\"card\">")); c++) cards++;
        cr_expect_eq(cards, currents, "%s: %d cards, %d currents", line, cards, currents);
        cJSON_Delete(json);
        free(page);
    }
    place_clear(&p);
}

/* The pages of the other commands, in the same way; each answers first and ends with what it takes to repeat it. */
Test(html, every_command_has_its_page, PLAIN_ONLY)
{
    static const struct {
        const char *line, *also[2], *answer;
    } cases[] = {
        {"simulate sleigh", {NULL}, "A motion from t = "},
        {"simulate sleigh --ensemble 3 --until 1", {NULL}, " motions from t = "},
        {"simulate kepler --initial x=1,y'=1 --until 1", {NULL}, "A motion from t = "},
        {"simulate sleigh --accuracy 1e-6 --until 1", {NULL}, "A motion from t = "},
        {"benchmark isotropic_oscillator --budget 200ms", {NULL}, "Fastest with an error below"},
        {"reduce car_with_trailer", {NULL}, "Symmetry group: "},
        {"benchmark sleigh --budget 200ms --robustness", {NULL}, "Fastest with an error below"},
        {"reduce vertical_disk", {NULL}, "Symmetry group: "},
        {"reduce henon_heiles", {NULL}, "No symmetry"},
        {"verify", {"--current", "m*v*sin(phi/k) + m*a*k*omega*cos(phi/k)"}, "Yes: this is conserved, proved for all parameter values."},
        {"verify", {"--current", "v"}, "No: this is not conserved."},
        {"verify", {"--field", "Z0=1; phi=phi'; x=x'"}, "constraint symmetry"},
    };
    place p = place_with_systems();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        if (!sweep_tries(i, 1, 5)) continue;
        cJSON *json;
        char *page = both(&p, cases[i].line, cases[i].also[0] ? cases[i].also : NULL, &json);
        const char *line = cases[i].also[1] ? cases[i].also[1] : cases[i].line, *answer = strstr(page, "<p class=\"answer");
        cr_expect_gt(compare_numbers(page, json, line), 1u, "%s", line);
        cr_expect(answer && strstr(answer, cases[i].answer), "%s: %.200s", line, answer ? answer : "no answer");
        cr_expect_not_null(strstr(page, "<h2>Repeat it</h2>"), "%s", line);
        cr_expect_not_null(cJSON_GetObjectItem(json, "run"), "%s", line);
        cr_expect_lt(strlen(page), 1500000u, "%s", line);
        for (const char *c = page; (c = strstr(c, "href=\"#")); c++) {
            char id[80];
            snprintf(id, sizeof id, "id=\"%.*s\"", (int)strcspn(c + 7, "\""), c + 7);
            cr_expect_not_null(strstr(page, id), "%s: a link to %s, which is not there", line, id);
        }
        cJSON_Delete(json);
        free(page);
    }
    place_clear(&p);
}

/* Is every name of a repeated part, A_1 or S_12, defined on a line of its own? */
static void expect_defined(const char *text, const char *line)
{
    for (const char *c = text; *c; c++) {
        size_t digits = c[1] == '_' ? strspn(c + 2, "0123456789") : 0;
        bool begins = c == text || !(isalnum((unsigned char)c[-1]) || c[-1] == '_');
        char definition[40];
        if (!isupper((unsigned char)*c) || !digits || !begins || isalpha((unsigned char)c[2 + digits])) continue;
        snprintf(definition, sizeof definition, "\n  %.*s = ", (int)digits + 2, c);
        cr_expect_not_null(strstr(text, definition), "%s: %.*s is not defined", line, (int)digits + 2, c);
    }
}

/* Text, page and LaTeX leave no formula out; with less room they do, with all that only it needs, and the option that is named shows it. */
Test(html, what_is_left_out_is_named_with_the_option_that_shows_it, WHOLE_ONLY)
{
    static const char *const lines[] = {"analyze car_trailers_3 --option work=1", "reduce car_trailers_3", "analyze crane --option work=1"};
    place p = place_with_systems();
    for (size_t i = 0; i < 3; i++) {
        if (!sweep_tries(i, 3, 3)) continue;
        char again[200];
        snprintf(again, sizeof again, "%s --html=page.html --tex=paper.tex", lines[i]);
        finished f = run(&p, again);
        char *page = read_here(&p, "page.html"), *paper = read_here(&p, "paper.tex");
        double most = 0;
        expect_defined(f.out, lines[i]);
        cr_expect(i != 0 || strstr(page, "long formula"), "%s: the page folds nothing", again);
        cr_expect(!strstr(page, "long to be shown") && !strstr(page, "(too long") && !strstr(paper, "long to be shown") && !strstr(paper, "(\\text{too long") && !strstr(f.out, "long to be shown") && !strstr(f.out, "(too long"), "%s: they have room for it", again);
        finished_clear(&f);
        free(page);
        free(paper);
        snprintf(again, sizeof again, "%s --option shown=20", lines[i]);
        f = run(&p, again);
        expect_defined(f.out, again);
        for (const char *c = f.out; (c = strstr(c, "shown=")); c++) most = fmax(most, strtod(c + 6, NULL));
        cr_expect_gt(most, 20, "%s: nothing is left out, so this tries nothing", again);
        finished_clear(&f);
        snprintf(again, sizeof again, "%s --option shown=%.0f", lines[i], most);
        f = run(&p, again);
        cr_expect_null(strstr(f.out, "too long to be shown"), "%s", again);
        expect_defined(f.out, again);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* The words at the ticks of a figure, one after the other. */
static void ticks_of(const char *figure, const char *end, char *out, size_t size)
{
    size_t n = 0;
    out[0] = 0;
    for (const char *c = figure; (c = strstr(c, "class=\"tick\"")) && c < end;) {
        c = strchr(c, '>') + 1;
        n += (size_t)snprintf(out + n, size - n, "%.*s ", (int)strcspn(c, "<"), c);
    }
}

/* Its figures under `caption`: how many, and that the ticks of all are those of the first. */
static size_t plots_with_the_same_ticks(const char *page, const char *caption)
{
    char first[800] = "", ticks[800];
    size_t plots = 0;
    for (const char *c = page; (c = strstr(c, "<figure>")); c++) {
        const char *end = strstr(c, "</svg>"), *found = strstr(c, "<figcaption>");
        if (strncmp(found + strlen("<figcaption>"), caption, strlen(caption))) continue;
        ticks_of(c, end, ticks, sizeof ticks);
        if (plots++) cr_expect_str_eq(ticks, first);
        else snprintf(first, sizeof first, "%s", ticks);
    }
    return plots;
}

/* Plots of seconds against error, of all methods and of those with a fixed step, are compared: their axes are the same.  Beside other programs a
 * short budget may end before there is a plot. */
Test(html, plots_that_are_compared_have_the_same_axes, PLAIN_ONLY)
{
    static const char *const budgets[] = {"300ms", "2s", "30s"};
    place p = place_with_systems();
    size_t motions = 0, fits = 0;
    for (size_t k = 0; k < sizeof budgets / sizeof *budgets && (motions < 2 || !fits); k++) {
        char line[80];
        snprintf(line, sizeof line, "benchmark sleigh --budget %s", budgets[k]);
        cJSON *json;
        char *page = both(&p, line, NULL, &json);
        motions = plots_with_the_same_ticks(page, "Seconds against error: ");
        fits = plots_with_the_same_ticks(page, "Distance of the known currents against seconds.");
        cJSON_Delete(json);
        free(page);
    }
    cr_expect_geq(motions, 2u, "%zu plots of motions", motions);
    cr_expect_geq(fits, 1u, "%zu plots of the discrete problem", fits);
    place_clear(&p);
}

static const double *numbers_of(const cJSON *array, size_t *count, double *out, size_t most)
{
    *count = 0;
    for (const cJSON *v = array->child; v && *count < most; v = v->next) out[(*count)++] = v->valuedouble;
    return out;
}

/* Figures 2 to 7 of Cech and Musilova 2014: the heading is k asin tanh t, the energies are E0 tanh^2 t and E0 / cosh^2 t (eq. 37 and 38 with omega0 = k), the
 * path is symmetric in time about the cusp; and the frequency's scan falls at 1/k. */
Test(html, figures_of_the_paper_are_computed, PLAIN_ONLY)
{
    enum { most = 2000 };
    place p = place_with_systems();
    cJSON *json;
    char *page = both(&p, "analyze sleigh", NULL, &json);
    const cJSON *figures = cJSON_GetObjectItem(json, "figures");
    size_t paths = 0, headings = 0, energies = 0, scans = 0, gaps = 0;
    static double x[most], y[most];
    for (const cJSON *f = figures->child; f; f = f->next)
        for (const cJSON *c = cJSON_GetObjectItem(f, "curves")->child; c; c = c->next) {
            const char *kind = cJSON_GetObjectItem(f, "kind")->valuestring, *name = cJSON_GetObjectItem(c, "name")->valuestring;
            double k = cJSON_GetObjectItem(c, "value")->valuedouble, e0 = k * k * k * k;
            size_t n;
            numbers_of(cJSON_GetObjectItem(c, "x"), &n, x, most);
            numbers_of(cJSON_GetObjectItem(c, "y"), &n, y, most);
            bool gap = !strcmp(kind, "samples"), null = gap && !strncmp(name, "largest null", 12);
            cr_expect_gt(n, gap ? 5u : 100u);
            for (size_t i = 0; i < n && gap; i++) cr_expect(null ? y[i] < 1e-13 : y[i] > 1e-3, "%s at %g: %g", name, x[i], y[i]);
            gaps += gap;
            for (size_t i = 0; i < n && !strcmp(kind, "path"); i++) {
                cr_expect_float_eq(x[i], x[n - 1 - i], 1e-6, "%s: %g, %g", name, x[i], x[n - 1 - i]);
                cr_expect_float_eq(y[i], -y[n - 1 - i], 1e-6, "%s", name);
            }
            for (size_t i = 0; i < n && !strncmp(name, "phi, ", 5); i++) cr_expect_float_eq(y[i], k * asin(tanh(x[i])), 1e-6, "%s at %g", name, x[i]);
            for (size_t i = 0; i < n && !strncmp(name, "E_T, ", 5); i++) cr_expect_float_eq(y[i], e0 * pow(tanh(x[i]), 2), 1e-6 * e0, "%s at %g", name, x[i]);
            for (size_t i = 0; i < n && !strncmp(name, "E_RC, ", 6); i++) cr_expect_float_eq(y[i], e0 * (1 - 1 / (k * k)) / pow(cosh(x[i]), 2), 1e-6 * e0, "%s at %g", name, x[i]);
            size_t low = 0;
            for (size_t i = 0; i < n && !strcmp(kind, "scan"); i++) low = y[i] < y[low] ? i : low;
            if (!strcmp(kind, "scan")) cr_expect_float_eq(x[low], 0.5, 0.01);
            paths += !strcmp(kind, "path");
            scans += !strcmp(kind, "scan");
            headings += !strncmp(name, "phi, ", 5);
            energies += !strncmp(name, "E_", 2);
        }
    cr_expect(paths == 4 && headings == 4 && energies == 6 && scans == 1 && gaps == 2, "%zu, %zu, %zu, %zu, %zu", paths, headings, energies, scans, gaps);
    cr_expect_not_null(strstr(page, "<section id=\"figures\">"));
    cJSON_Delete(json);
    free(page);
    place_clear(&p);
}

/* Titles, documentation, units and file names come from files that anyone may have written. */
Test(html, a_hostile_file_runs_nothing)
{
    place p = place_make();
    write_here(&p, "a&b<img src=x>.yaml",
               "name: x\ntitle: \"<script>alert(1)</script> & ]]> \\\" onload='alert(2)'\"\nsource: \"</p><iframe src='http://x.invalid'>\"\n"
               "parameters:\n  - {name: m, value: 1.25, unit: kg, doc: \"</table><svg onload=alert(4)>\"}\n"
               "coordinates:\n  - {name: x, type: length, doc: \"<!-- <script>\"}\n  - {name: y, type: length}\nlagrangian: m/2*(x'^2 + y'^2)\n"
               "draw: [{point: [x, y], name: \"<script>alert(5)\"}, {point: [0, y]}]\n");
    char *argument[] = {p.program, "analyze", "a&b<img src=x>.yaml", "--quiet", "--html", "page.html", NULL};
    finished f = run_vector(&p, &(manner){0}, argument);
    cr_assert_eq(f.code, 0, "%s", f.err);
    char *page = read_here(&p, "page.html");
    reader r;
    cr_assert(page && well_formed(&r, page), "%s", r.fault);
    cr_expect_null(strstr(page, "<script>alert"));
    cr_expect_null(strstr(page, "<iframe"));
    cr_expect_null(strstr(page, "<b onclick"));
    cr_expect_null(strstr(page, "<img"));
    cr_expect_null(strstr(page, "<svg onload"));
    cr_expect_not_null(strstr(page, "&lt;script&gt;alert(1)"));
    cr_expect_not_null(strstr(page, "default-src 'none'"), "the page itself forbids the network");
    size_t scripts = 0;
    for (const char *c = page; (c = strstr(c, "<script")); c++) scripts++;
    cr_expect_eq(scripts, 2u, "the data and the script of the page");
    free(page);
    finished_clear(&f);
    place_clear(&p);
}

/* No reference to anything outside the file; namespaces and the meta element are not fetched. */
Test(html, the_page_needs_nothing_else, PLAIN_ONLY)
{
    place p = place_with_systems();
    char *page = page_of(&p, "analyze sleigh", 0);
    cr_expect_null(strstr(page, "src="));
    for (const char *c = page; (c = strstr(c, "url(")); c++) /* the font of formulas; parts of the page's own pictures */
        cr_expect(!strncmp(c, "url(data:font/woff2;base64,", 27) || !strncmp(c, "url(#", 5), "%.60s", c);
    cr_expect_null(strstr(page, "@import"));
    cr_expect_null(strstr(page, "https:"));
    for (const char *c = page; (c = strstr(c, "http:")); c++) cr_expect(!strncmp(c, "http://www.w3.org/", 18), "%.60s", c);
    for (const char *c = page; (c = strstr(c, "href=\"")); c++) cr_expect_eq(c[6], '#');
    for (const char *c = page; (c = strstr(c, "<svg ")); c++) cr_expect(!strncmp(strstr(c, "role="), "role=\"img\"", 10), "%.100s", c);
    cr_expect_not_null(strstr(page, "All 5 conserved quantities that can exist were found and proved."));
    free(page);
    place_clear(&p);
}

/* Units of coordinates label the axes, where all of one kind have the same. */
Test(html, units_are_on_the_axes, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "u.yaml", "coordinates:\n  - {name: phi, type: angle}\n  - {name: x, type: length, unit: km}\n  - {name: y, type: length, unit: km}\n  - {name: u, unit: A}\n"
                             "  - {name: w, unit: V}\nlagrangian: phi'^2 + x'^2 + y'^2 + u'^2 + w'^2 - x^2\n");
    finished f = run_expecting(&p, "analyze u.yaml --quiet --option work=300 --html page.html", 0);
    finished_clear(&f);
    char *page = read_here(&p, "page.html");
    cr_expect_not_null(strstr(page, ">\u03c6 / rad</text>"), "a curve alone names its axis");
    cr_expect_not_null(strstr(page, ">length / km</text>"));
    cr_expect_not_null(strstr(page, ">coordinate</text>"), "two units, none on the axis");
    free(page);
    place_clear(&p);
}

/* A disk that is full leaves the page that was there. */
Test(html, a_page_is_written_whole_or_not_at_all, PLAIN_ONLY)
{
    place p = place_with_systems();
    write_here(&p, "page.html", "an older page");
    finished f = run_so(&p, &(manner){.file_limit = 20000}, "analyze sleigh --quiet --html page.html");
    cr_expect_eq(f.code, 4, "code %d: %s", f.code, f.err);
    cr_expect_not_null(strstr(f.err, "page.html"));
    finished_clear(&f);
    char *page = read_here(&p, "page.html");
    cr_expect_str_eq(page, "an older page");
    free(page);
    place_clear(&p);
}

/* ---- formulas ---- */

static const struct {
    const char *text, *latex;
} FORMULAS[] = {
    {"a + b*c", "a + b\\,c"},
    {"-x^2/(2*k_12)", " - \\frac{x^{2}}{2\\,k_{12}}"},
    {"m/2*(x' + y'')", "\\frac{m}{2}\\,{\\left(\\dot{x} + \\ddot{y}\\right)}"},
    {"sqrt(phi)*sin(omega)^3", "\\sqrt{\\varphi }\\,\\sin^{3} \\omega "},
    {"log(abs(u - 1))", "\\ln\\left(\\left|u - 1\\right|\\right)"},
    {"a/b/c", "\\frac{a}{b\\,c}"},
    {"a/(b/c)", "\\frac{a}{\\frac{b}{c}}"},
    {"(a/b)^2", "{\\left(\\frac{a}{b}\\right)}^{2}"},
    {"a*(-b)", "a\\,{\\left( - b\\right)}"},
    {"2.5e-7*q1", "2.5\\cdot 10^{ - 7}\\,q_{1}"},
    {"y' = x'*tan(phi)", "\\dot{y} = \\dot{x}\\,\\tan \\varphi "},
    {"2^-n", "2^{ - n}"},
    {"atan2(y, x)", "\\operatorname{atan2}\\left(y, x\\right)"},
    {"p_psi1' + jx2", "\\dot{p}_{\\psi _{1}} + \\mathrm{jx}_{2}"},
    {"psi1'", "\\dot{\\psi }_{1}"},
    {"cos(p)*cos(a)*a'", "\\cos p\\,\\cos\\left(a\\right)\\,\\dot{a}"},
    {"sin(a)^2*x + cos(a)", "\\sin^{2}\\left(a\\right)\\,x + \\cos a"},
    {"E_TC - mass", "E_{\\mathrm{TC}} - \\mathrm{mass}"},
};

/* The capital upsilon of the almost-symplectic form has hooks: the other letter is a Y to the eye. */
Test(html, upsilon_is_no_y)
{
    nh_text mathml;
    nh_text_init(&mathml);
    cr_assert(nh_typeset("Upsilon", NH_MATHML, &mathml));
    cr_expect_not_null(strstr(nh_text_string(&mathml), "\u03d2"), "%s", nh_text_string(&mathml));
    nh_text_clear(&mathml);
}

/* Behind a factor a bar without its form is an infix operator, and only the other grows with what is between them. */
/* Names of robots have several underscores, and characters by their numbers. */
Test(html, words_of_names_stand_together)
{
    static const struct {
        const char *name, *mathml, *latex, *legend;
    } cases[] = {
        {"wheel_left_joint", "<mrow><mi mathvariant=\"normal\">left_joint</mi></mrow></msub>", "\\mathrm{wheel}_{\\mathrm{left\\_joint}}", "wheel_left_joint"},
        {"p_phi_1", "<mrow><msub><mrow><mi>\u03c6</mi></mrow><mrow><mn>1</mn></mrow></msub></mrow>", "p_{\\varphi _{1}}", "p_phi_1"},
        {"x_2", "<msub><mrow><mi>x</mi></mrow><mrow><mn>2</mn></mrow></msub>", "x_{2}", "x\u2082"},
        {"uni80A9", "<mi mathvariant=\"normal\">\u80a9</mi>", "\\mathrm{uni80A9}", "\u80a9"},
        {"uni8098", "<mi mathvariant=\"normal\">\u8098</mi>", "\\mathrm{uni8098}", "\u8098"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        nh_text mathml, latex, legend;
        nh_text_init(&mathml), nh_text_init(&latex), nh_text_init(&legend);
        cr_assert(nh_typeset(cases[i].name, NH_MATHML, &mathml) && nh_typeset(cases[i].name, NH_LATEX, &latex), "%s", cases[i].name);
        nh_typeset_plain(cases[i].name, &legend);
        cr_expect(strstr(nh_text_string(&mathml), cases[i].mathml), "%s: %s", cases[i].name, nh_text_string(&mathml));
        cr_expect_str_eq(nh_text_string(&latex), cases[i].latex, "%s: %s", cases[i].name, nh_text_string(&latex));
        cr_expect_str_eq(nh_text_string(&legend), cases[i].legend, "%s: %s", cases[i].name, nh_text_string(&legend));
        nh_text_clear(&mathml), nh_text_clear(&latex), nh_text_clear(&legend);
    }
}

Test(html, both_bars_have_one_size)
{
    nh_text mathml;
    nh_text_init(&mathml);
    cr_assert(nh_typeset("c*th'^2*abs(th')", NH_MATHML, &mathml));
    const char *left = strstr(nh_text_string(&mathml), "<mrow><mo form=\"prefix\">|</mo>");
    cr_expect(left && strstr(left, "<mo form=\"postfix\">|</mo></mrow>"), "%s", nh_text_string(&mathml));
    nh_text_clear(&mathml);
}

Test(html, formulas_are_set_as_they_are_written)
{
    for (size_t i = 0; i < sizeof FORMULAS / sizeof *FORMULAS; i++) {
        nh_text latex, mathml;
        nh_text_init(&latex);
        nh_text_init(&mathml);
        cr_expect(nh_typeset(FORMULAS[i].text, NH_LATEX, &latex) && nh_typeset(FORMULAS[i].text, NH_MATHML, &mathml), "%s", FORMULAS[i].text);
        cr_expect_str_eq(nh_text_string(&latex), FORMULAS[i].latex, "%s: %s", FORMULAS[i].text, nh_text_string(&latex));
        char page[4000];
        snprintf(page, sizeof page, "<!DOCTYPE html><math>%s</math>", nh_text_string(&mathml));
        reader r;
        cr_expect(well_formed(&r, page), "%s: %s", FORMULAS[i].text, r.fault);
        nh_text_clear(&mathml);
        nh_text_clear(&latex);
    }
}

static void join(void *context, const char *piece, nh_typeset_follows follows)
{
    (void)follows;
    nh_text_add(context, piece);
    nh_text_add(context, " | ");
}

static void kinds_of_breaks(void *context, const char *piece, nh_typeset_follows follows)
{
    (void)piece;
    nh_text_add(context, follows == NH_FOLLOWS_FACTOR ? "*" : follows == NH_FOLLOWS_TERM ? "+" : ".");
}

/* A product that goes on in the next line shows an operator at the end of this one; a sum's next line has its own. */
Test(html, products_that_go_on)
{
    static const char *const cases[][2] = {
        {"(a1 + a2 + a3 + a4 + a5)*(b1 + b2 + b3 + b4 + b5)", "++++*++++."},
        {"a1 + a2 + a3", "++."},
        {"(a1 + a2 + a3 + a4 + a5)/(b1 + b2 + b3 + b4 + b5)", "+++++++++."},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        nh_text out;
        nh_text_init(&out);
        nh_typeset_pieces(cases[i][0], NH_MATHML, 6, kinds_of_breaks, &out);
        cr_expect_str_eq(nh_text_string(&out), cases[i][1], "%s", cases[i][0]);
        nh_text_clear(&out);
    }
}

static void widest_piece(void *context, const char *piece, nh_typeset_follows follows)
{
    (void)follows;
    size_t *most = context, symbols = 0;
    for (const char *c = piece; (c = strstr(c, "<m")); c++) symbols += c[2] == 'i' || c[2] == 'n';
    if (symbols > *most) *most = symbols;
    cr_expect_null(strstr(piece, "<mrow></mrow>"), "an empty box in %s", piece);
}

/* What has one term only breaks inside: products, fractions, powers, arguments. */
Test(html, a_long_term_is_opened)
{
    static const char *const cases[] = {
        "(a1 + a2 + a3 + a4 + a5 + a6 + a7 + a8)*(b1 + b2 + b3 + b4 + b5 + b6 + b7 + b8)*(c1 + c2 + c3 + c4 + c5)",
        "(a1 + a2 + a3 + a4 + a5 + a6 + a7 + a8 + a9)/(b1 + b2 + b3 + b4 + b5 + b6 + b7 + b8 + b9)",
        "-m*sqrt(a1*a2*a3 + b1*b2*b3 + c1*c2*c3 + d1*d2*d3)*sin(a1 + a2 + a3 + a4 + a5 + a6 + a7 + a8)/(2*k)",
        "(a1 + a2 + a3 + a4 + a5 + a6 + a7 + a8 + a9)^2*abs(b1 + b2 + b3 + b4 + b5 + b6 + b7 + b8 + b9)",
        "x' = log((a1 + a2*(b1 + b2*(c1 + c2*(d1 + d2*(e1 + e2*(f1 + f2)))))) + g1 + g2 + g3 + g4)",
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        size_t most = 0, pieces = nh_typeset_pieces(cases[i], NH_MATHML, 12, widest_piece, &most);
        cr_expect_gt(pieces, 3u, "%s", cases[i]);
        cr_expect_leq(most, 30u, "%s: a piece of %zu symbols", cases[i], most); /* an index counts here, not there */
        nh_text all;
        nh_text_init(&all);
        nh_text_add(&all, "<!DOCTYPE html><math>");
        nh_typeset_pieces(cases[i], NH_MATHML, 12, join, &all);
        nh_text_add(&all, "</math>");
        reader r;
        cr_expect(well_formed(&r, nh_text_string(&all)), "%s: %s", cases[i], r.fault);
        size_t open = 0, closed = 0;
        for (const char *c = nh_text_string(&all); (c = strstr(c, ">(<")); c++) open++;
        for (const char *c = nh_text_string(&all); (c = strstr(c, ">)<")); c++) closed++;
        cr_expect(open == closed && open > 0, "%s: %zu and %zu parentheses", cases[i], open, closed);
        nh_text_clear(&all);
    }
}

Test(html, what_is_no_formula_is_refused)
{
    static const char *const bad[] = {"", "a +", "(a", "a b", "a = b = c", "<b>", "a*/b", "sin(", "...", "a..."};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        nh_text out;
        nh_text_init(&out);
        cr_expect_not(nh_typeset(bad[i], NH_MATHML, &out), "%s", bad[i]);
        cr_expect_eq(out.length, 0u);
        nh_text_clear(&out);
    }
    char deep[2001];
    memset(deep, '(', 1000);
    memset(deep + 1000, ')', 1000);
    deep[2000] = 0;
    nh_text out;
    nh_text_init(&out);
    cr_expect_not(nh_typeset(deep, NH_MATHML, &out));
    nh_text_clear(&out);
}

/* A page explains the words that stand on it, and no others; it has no column in which nothing stands; rules of joints are told. */
Test(html, words_and_columns_that_are_needed, PLAIN_ONLY)
{
    place p = place_with_systems();
    write_here(&p, "crane.yaml", "name: crane\nbodies: [{name: column, mass: 2, inertia: 0.4}, {name: arm, mass: 1, inertia: 0.2, center: [0.5, 0, 0]}]\n"
                                 "joints: [{type: helical, child: column, axis: z, pitch: 0.1, coordinates: [q]}, {type: revolute, parent: column, child: arm, axis: x, coordinates: [w]}]\ngravity: 9.81\n");
    cJSON *json;
    char *page = both(&p, "reduce crane.yaml", NULL, &json);
    cr_expect_null(strstr(page, "<dt>nonholonomic</dt>"), "there is no constraint");
    cr_expect_not_null(strstr(page, "<dt>group</dt>"));
    cr_expect_null(strstr(page, ">meaning<"), "no coordinate has one");
    cr_expect_not_null(strstr(page, "AP1: a displacement of space"));
    cJSON_Delete(json);
    free(page);
    page = both(&p, "reduce vertical_disk", NULL, &json);
    cr_expect_not_null(strstr(page, "<dt>Chaplygin</dt>"));
    cJSON_Delete(json);
    free(page);
    page = both(&p, "simulate skate_on_belt --until 1", NULL, &json);
    cr_expect_not_null(strstr(page, ">meaning<"));
    cJSON_Delete(json);
    free(page);
    place_clear(&p);
}

/* Letters of the theory are set as formulas wherever they stand; no line begins with the sign behind a formula; a heading has something below it. */
Test(html, letters_in_sentences_are_formulas, PLAIN_ONLY)
{
    place p = place_with_systems();
    write_here(&p, "slope.yaml", "name: slope\nparameters: [{name: r, value: 0.5}, {name: g, value: 2.1}]\ncoordinates: [x, y, {name: p, type: angle}, {name: h, type: angle}]\n"
                                 "lagrangian: (x'^2 + y'^2)/2 + 3/10*h'^2 + p'^2/5 + g*x\nconstraints: [\"x' = r*h'*cos(p)\", \"y' = r*h'*sin(p)\"]\n");
    cJSON *json;
    char *page = both(&p, "analyze slope.yaml --equations --degree 2", NULL, &json), *text = page;
    cr_expect_not_null(strstr(page, "conjugate to <math displaystyle=\"true\"><mi>p</mi></math></a>"));
    for (; (text = strstr(text, "</math>")); text += strlen("</math>")) {
        size_t signs = strspn(text + strlen("</math>"), ".,;:)");
        cr_expect(!signs || !strncmp(text + strlen("</math>") + signs, "</span>", strlen("</span>")), "%.60s", text);
    }
    static const char *const plain[] = {"on Phi1 to Phi", "= a \u0393", "L_Z(", "near 10^-16", ">Z is ", "p are the momenta", "is L with", "Fields S with"};
    for (size_t i = 0; i < sizeof plain / sizeof *plain; i++) cr_expect_null(strstr(page, plain[i]), "%s", plain[i]);
    cJSON_Delete(json);
    free(page);
    write_here(&p, "pendulum.yaml", "name: pendulum\ncoordinates: [{name: p, type: angle}, {name: h, type: angle}]\nlagrangian: (h'^2 + sin(h)^2*p'^2)/2 + cos(h)\ndomain: {h: [0.5, 1.4]}\n");
    page = both(&p, "reduce pendulum.yaml --equations", NULL, &json);
    cr_expect_not_null(strstr(page, "Vertical equations by stages"));
    cr_expect_not_null(strstr(page, "All parts vanish."));
    cr_expect_null(strstr(page, "2014]"), "a key of a bibliography that the page has not");
    cJSON_Delete(json);
    free(page);
    place_clear(&p);
}
