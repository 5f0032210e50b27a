/* LaTeX: formulas come in pieces that fit, numbers are those of the JSON, and where pdflatex is installed it sets the document without an error
 * and without a formula that runs over the margin. */
#include <cjson/cJSON.h>
#include <ctype.h>
#include <math.h>

#include "base/memory.h"
#include "graph/print.h"
#include "document/typeset.h"
#include "graph/dag.h"
#include "numbers.h"
#include "program.h"
#include "random_expression.h"
#include "sweep.h"

/* ---- pieces ---- */

static void join(void *context, const char *piece, nh_typeset_follows follows)
{
    (void)follows;
    nh_text_add(context, piece);
    nh_text_add(context, " | ");
}

/* Sums break between their terms; what is wide is opened; what is short stays as it is. */
Test(tex, long_formulas_come_in_pieces)
{
    static const char *const cases[][2] = {
        {"x^2 - y", "x^{2} | \\penalty0  - y | "},
        {"a*b = c/d", "a\\,b | \\penalty0  = \\frac{c}{d} | "},
        {"-m*(a + b - c)/(2*k)", "- \\frac{m\\,{\\left(a + b - c\\right)}}{2\\,k} | "},
        {"-m*(alpha*beta*x*y*z*x*y*z + x*y*z*x*y*z*gamma*delta - x^2*y^2*z^2*x*y*z*u*v*w + u*v*w*u*v*w*u*v*w*u*v)/(2*k)",
         "- \\frac{m}{2\\,k}\\, | \\penalty300 \\bigl(\\alpha \\,\\beta \\,x\\,y\\,z\\,x\\,y\\,z | \\penalty60  + x\\,y\\,z\\,x\\,y\\,z\\,\\gamma \\,\\delta  | "
         "\\penalty60  - x^{2}\\,y^{2}\\,z^{2}\\,x\\,y\\,z\\,u\\,v\\,w | \\penalty60  + u\\,v\\,w\\,u\\,v\\,w\\,u\\,v\\,w\\,u\\,v\\bigr) | "},
        {"sqrt(aaaaaaaaaaaaaaaaaaaa + bbbbbbbbbbbbbbbbbbbb + cccccccccccc)",
         "\\bigl(\\mathrm{aaaaaaaaaaaaaaaaaaaa} | \\penalty60  + \\mathrm{bbbbbbbbbbbbbbbbbbbb} | \\penalty60  + \\mathrm{cccccccccccc}\\bigr)^{1\\big/2} | "},
        {"k*(aaaaaaaaaaaaaaaaaaaa + bbbbbbbbbbbbbbbbbbbb*(c + d/e))", /* parentheses are as high as the fraction between them */
         "k\\, | \\penalty300 \\biggl(\\mathrm{aaaaaaaaaaaaaaaaaaaa} | \\penalty60  + \\mathrm{bbbbbbbbbbbbbbbbbbbb}\\,{\\left(c + \\frac{d}{e}\\right)}\\biggr) | "},
        {"sin(aaaaaaaaaaaaaaaaaaaa + bbbbbbbbbbbbbbbbbbbb + cccccccccccc)/x",
         "\\frac{1}{x}\\, | \\penalty300 \\sin\\bigl(\\mathrm{aaaaaaaaaaaaaaaaaaaa} | \\penalty60  + \\mathrm{bbbbbbbbbbbbbbbbbbbb} | \\penalty60  + \\mathrm{cccccccccccc}\\bigr) | "},
        {"x/(aaaaaaaaaaaaaaaaaaaa + bbbbbbbbbbbbbbbbbbbb + cccccccccccc)",
         "x | \\penalty300 \\big/\\bigl(\\mathrm{aaaaaaaaaaaaaaaaaaaa} | \\penalty60  + \\mathrm{bbbbbbbbbbbbbbbbbbbb} | \\penalty60  + \\mathrm{cccccccccccc}\\bigr) | "},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        nh_text out;
        nh_text_init(&out);
        cr_expect_gt(nh_typeset_pieces(cases[i][0], NH_LATEX, 46, join, &out), 0u);
        const char *got = nh_text_string(&out);
        cr_expect_str_eq(got + strspn(got, " "), cases[i][1], "%s: %s", cases[i][0], got);
        nh_text_clear(&out);
    }
}

typedef struct {
    size_t most;    /* letters of a piece, about */
    int open;       /* wide parentheses not yet closed */
    bool unbalanced;
} seen;

/* Groups begin and end within a piece, so that TeX may break between any two. */
static void look(void *context, const char *piece, nh_typeset_follows follows)
{
    (void)follows;
    seen *s = context;
    int depth = 0;
    size_t letters = 0;
    for (const char *c = piece; *c; c++) {
        depth += (*c == '{') - (*c == '}');
        s->unbalanced |= depth < 0;
        s->open += !strncmp(c, "\\bigl(", 6) - !strncmp(c, "\\bigr)", 6);
        s->unbalanced |= s->open < 0;
        letters += isalnum((unsigned char)*c) != 0;
        if (*c == '\\')
            while (isalpha((unsigned char)c[1])) c++;
    }
    s->unbalanced |= depth != 0;
    if (letters > s->most) s->most = letters;
}

Test(tex, no_piece_is_wide_and_all_are_whole)
{
    size_t wide = 0;
    for (uint64_t i = 0; i < 400; i++) {
        source random = source_create(i);
        nh_dag *d = random.dag;
        nh_ex e = random_expression(&random, 6);
        char *text = nh_print_string(d, e);
        seen s = {0};
        size_t n = nh_typeset_pieces(text, NH_LATEX, 46, look, &s);
        cr_expect_gt(n, 0u, "%s", text);
        wide += nh_typeset_width(text) > 80;
        cr_expect(!s.unbalanced && !s.open, "%s", text);
        cr_expect_leq(s.most, 110u, "%zu letters in one piece of %s", s.most, text); /* fractions count both of their floors */
        nh_free(text);
        nh_dag_free(d);
    }
    cr_expect_gt(wide, 40u);
}

/* ---- documents ---- */

static const char *const SYSTEMS[] = {"sleigh", "euler_disk --option work=900", "contact_oscillator --option work=300", "snakeboard --option work=600", "heisenberg_particle", "kepler --option work=600", "car_with_trailer --option work=10", "free_particle"};

/* \nhnumber{all digits}{as shown}: the JSON has it to the last digit, and what is shown is it, rounded. */
Test(tex, every_number_is_in_the_json, PLAIN_ONLY)
{
    place p = place_with_systems();
    for (size_t s = 0; s < sizeof SYSTEMS / sizeof *SYSTEMS; s++) {
        if (!sweep_tries(s, 8, 16)) continue;
        char line[200];
        snprintf(line, sizeof line, "analyze %s --quiet --tex a.tex --json a.json", SYSTEMS[s]);
        finished f = run(&p, line);
        finished_clear(&f);
        char *tex = read_here(&p, "a.tex"), *text = read_here(&p, "a.json");
        cr_assert(tex && text, "%s", line);
        cJSON *json = cJSON_Parse(text);
        size_t numbers = 0;
        all_numbers known = numbers_of_json(json);
        for (const char *c = strstr(tex, "\\begin{document}"); (c = strstr(c, "\\nhnumber{")); c++, numbers++) {
            double value = strtod(c + 10, NULL), shown = strtod(strchr(c, '}') + 2, NULL);
            const char *power = strstr(c, "\\cdot 10^{"), *end = strchr(strchr(c, '}') + 1, '}');
            if (!strncmp(strchr(c, '}') + 1, "{10^{", 5)) shown = pow(10, strtod(strchr(c, '}') + 6, NULL)); /* without a factor */
            if (power && power < end) shown *= pow(10, strtod(power + 10, NULL));
            expect_number(&known, value, shown, 0.05, line);
        }
        cr_expect_gt(numbers, 15u, "%s: %zu numbers", line, numbers);
        free(known.value);
        cJSON_Delete(json);
        free(text);
        free(tex);
    }
    place_clear(&p);
}

/* ---- pdflatex ---- */

/* Sets NAME.tex; false without pdflatex.  What the sanitized program writes, the plain one writes too. */
static bool set_in_type(const place *p, const char *name)
{
    if (sweep_sanitized() && !sweep_whole()) return true;
    char command[400];
    snprintf(command, sizeof command,
             "command -v pdflatex >/dev/null && kpsewhich pgfplots.sty >/dev/null || exit 3\n"
             "timeout 100 pdflatex -interaction=nonstopmode -halt-on-error %s.tex >set.log 2>&1 || { tail -n 20 set.log; exit 1; }\n"
             "grep -a -A 3 '^Overfull .hbox' set.log && exit 2 || exit 0", name);
    char *argument[] = {"sh", "-c", command, NULL};
    finished f = run_vector(p, &(manner){.environment = (const char *const[]){"max_print_line=1000", NULL}}, argument);
    int code = f.code;
    cr_expect(code == 0 || code == 3, "%s: %s", name, f.out);
    finished_clear(&f);
    return code != 3;
}

static const char *const REDUCED[] = {"crane", "vertical_disk", "kepler", "constant_speed", "skate_with_friction"};

Test(tex, documents_are_set_without_a_fault, PLAIN_ONLY)
{
    place p = place_with_systems();
    bool installed = true;
    for (size_t s = 0; installed && s < sizeof SYSTEMS / sizeof *SYSTEMS; s++) {
        if (!sweep_tries(s, 2, 2)) continue;
        char line[200];
        snprintf(line, sizeof line, "analyze %s --quiet --tex a.tex", SYSTEMS[s]);
        finished f = run(&p, line);
        finished_clear(&f);
        installed = set_in_type(&p, "a");
    }
    for (size_t i = 0; installed && i < sizeof REDUCED / sizeof *REDUCED; i++) {
        if (!sweep_tries(i, 2, 2)) continue;
        char line[200];
        snprintf(line, sizeof line, "reduce %s --equations --quiet --tex r.tex", REDUCED[i]);
        finished f = run(&p, line);
        finished_clear(&f);
        installed = set_in_type(&p, "r");
    }
    place_clear(&p);
    if (!installed) cr_skip_test("no pdflatex with pgfplots");
}

/* Are the braces of a document balanced, those that are escaped left out? */
static bool balanced(const char *tex)
{
    int depth = 0;
    for (const char *c = tex; *c && depth >= 0; c++) {
        if (*c == '\\' && c[1]) c++;
        else depth += (*c == '{') - (*c == '}');
    }
    return depth == 0;
}

static size_t times(const char *text, const char *word)
{
    size_t n = 0;
    for (const char *c = text; (c = strstr(c, word)); c++) n++;
    return n;
}

/* The objects of all stages that the JSON has are formulas of the document, with the reduced equations and the group besides. */
Test(tex, reductions_are_documents, PLAIN_ONLY)
{
    place p = place_with_systems();
    for (size_t i = 0; i < sizeof REDUCED / sizeof *REDUCED; i++) {
        if (!sweep_tries(i, 3, 6)) continue;
        char line[200];
        snprintf(line, sizeof line, "reduce %s --equations --quiet --tex r.tex --json r.json", REDUCED[i]);
        finished f = run_expecting(&p, line, 0);
        finished_clear(&f);
        char *tex = read_here(&p, "r.tex"), *text = read_here(&p, "r.json");
        cJSON *json = cJSON_Parse(text), *stage, *section, *item;
        size_t formulas = 0, stages = 0;
        cJSON_ArrayForEach(stage, cJSON_GetObjectItem(json, "stages")) {
            formulas += (size_t)cJSON_GetArraySize(cJSON_GetObjectItem(stage, "equations"));
            stages++;
            cJSON_ArrayForEach(section, cJSON_GetObjectItem(stage, "geometry"))
                cJSON_ArrayForEach(item, section) formulas += !cJSON_GetObjectItem(item, "words");
        }
        cr_expect(balanced(tex), "%s", REDUCED[i]);
        cr_expect_geq(times(tex, "\\nhformula{"), formulas, "%s: %zu formulas, the JSON has %zu", REDUCED[i], times(tex, "\\nhformula{"), formulas);
        cr_expect_eq(times(tex, "\\subsection*{Stage "), stages, "%s", REDUCED[i]);
        cr_expect_null(strstr(tex, "nan"));
        cJSON_Delete(json);
        free(text);
        free(tex);
    }
    place_clear(&p);
}

/* A row of a legend has at most as many letters as fit into a line.  The number of figures; `several`: of those with rows of a given length. */
static size_t legends_that_fit(const char *tex, size_t *several)
{
    size_t figures = 0;
    *several = 0;
    for (const char *c = tex; (c = strstr(c, "legend columns=")); figures++) {
        int columns = atoi(c + strlen("legend columns="));
        const char *end = strstr(c, "\\end{axis}");
        size_t longest = 0, all = 0;
        while ((c = strstr(c, "\\addlegendentry{")) && c < end) {
            size_t length = strcspn(c += strlen("\\addlegendentry{"), "}");
            all += length;
            if (length > longest) longest = length;
        }
        cr_expect(columns < 0 ? all < 100 : columns == 1 || (size_t)columns * longest < 100, "%d columns, %zu, %zu", columns, longest, all);
        *several += columns > 0;
        c = end;
    }
    return figures;
}

/* Tables of many columns fill the line, and have their caption.  A short budget may end before there is a figure. */
Test(tex, benchmarks_fit_the_page)
{
    static const char *const budgets[] = {"200ms", "2s", "30s"};
    place p = place_with_systems();
    size_t figures = 0, several = 0;
    char *tex = NULL;
    for (size_t k = 0; k < sizeof budgets / sizeof *budgets && (figures <= 2 || !several); k++) {
        char line[80];
        free(tex);
        snprintf(line, sizeof line, "benchmark sleigh --budget %s --quiet --tex b.tex", budgets[k]);
        finished f = run_expecting(&p, line, 0);
        finished_clear(&f);
        tex = read_here(&p, "b.tex");
        figures = legends_that_fit(tex, &several);
    }
    cr_expect(figures > 2 && several > 0, "%zu %zu", figures, several);
    cr_expect_gt(times(tex, "\\scriptsize\\tabcolsep=2pt\\begin{longtable}{*{9}{p{\\dimexpr\\linewidth/9-2\\tabcolsep\\relax}}}\n\\multicolumn{9}"), 0u);
    cr_expect_eq(times(tex, "\\begin{longtable}"), times(tex, "\\endfirsthead"));
    free(tex);
    place_clear(&p);
}

/* The next number behind `before` is this one: where it begins; else NULL. */
static const char *next_number(const char *at, const char *before, double number)
{
    at = strstr(at, before);
    return at && strtod(at + strlen(before), NULL) == number ? at + strlen(before) : NULL;
}

/* A current without closed form is of use only with the coefficients of its series: document and page have all that the JSON has, row by row. */
Test(tex, coefficients_of_a_series_are_told)
{
    place p = place_with_systems();
    bool small = sweep_sanitized() && !sweep_whole(); /* then Airy's equation */
    char line[200];
    write_here(&p, "airy.yaml", "name: airy\ncoordinates: [x]\nlagrangian: x'^2/2 - t*x^2/2\n");
    snprintf(line, sizeof line, "analyze %s --option named=0 --quiet --tex a.tex --json a.json --html a.html", small ? "airy.yaml" : "rolling_disk");
    finished f = run_expecting(&p, line, 0);
    finished_clear(&f);
    char *tex = read_here(&p, "a.tex"), *page = read_here(&p, "a.html"), *text = read_here(&p, "a.json");
    cJSON *json = cJSON_Parse(text), *current;
    const char *in_tex = tex, *in_page = page;
    size_t told = 0;
    cJSON_ArrayForEach(current, cJSON_GetObjectItem(json, "currents"))
    {
        const cJSON *series = cJSON_GetObjectItem(current, "series"), *rows = cJSON_GetObjectItem(series, "coefficients");
        if (!cJSON_IsObject(series)) continue;
        int degree = (int)cJSON_GetNumberValue(cJSON_GetObjectItem(series, "degree")), words = cJSON_GetArraySize(rows);
        cr_assert(degree > 5 && words > 1);
        in_tex = strstr(in_tex, "without closed form");
        in_page = strstr(in_page, "Chebyshev coefficients");
        cr_assert(in_tex && in_page);
        in_tex = next_number(in_tex, "\\nhnumber{", cJSON_GetNumberValue(cJSON_GetObjectItem(series, "low")));
        cr_assert_not_null(in_tex);
        in_tex = next_number(in_tex, "\\nhnumber{", cJSON_GetNumberValue(cJSON_GetObjectItem(series, "high")));
        for (int k = 0; k <= degree; k++)
            for (int i = 0; i < words; i++, told++) {
                double c = cJSON_GetNumberValue(cJSON_GetArrayItem(cJSON_GetArrayItem(rows, i), k));
                cr_assert(in_tex && (in_tex = next_number(in_tex, "\\nhnumber{", c)), "coefficient %d of %d: %.17g", k, i, c);
                cr_assert_not_null(in_page = next_number(in_page, "<data value=\"", c), "coefficient %d of %d: %.17g", k, i, c);
            }
    }
    cr_expect_gt(told, 40u);
    cJSON_Delete(json);
    free(text), free(page), free(tex);
    bool installed = set_in_type(&p, "a");
    place_clear(&p);
    if (!installed) cr_skip_test("no pdflatex with pgfplots");
}

/* What a file says is text, whatever it means to TeX, and in whatever script. */
Test(tex, a_hostile_file_is_set_as_text)
{
    place p = place_make();
    write_here(&p, "h.yaml", "name: h\ntitle: \"\\\\input{/etc/passwd} 100% $x^2$ #1 & ~ {\\\\end{document} \\\"quoted\\\" a|b <c> \u4e2d \u0105 \u00e9\u03c9 -- ''\"\n"
                             "source: \"\\\\immediate\\\\write18{touch pwned} ^^M\"\nparameters:\n  - {name: m, value: 1e-300, unit: kg^2, doc: \"% }{\"}\n"
                             "coordinates:\n  - {name: x_1_long_name, type: length}\nlagrangian: x_1_long_name'^2\n");
    finished f = run_expecting(&p, "analyze h.yaml --quiet --tex a.tex", 0);
    finished_clear(&f);
    char *tex = read_here(&p, "a.tex");
    cr_expect_null(strstr(tex, "\\input{/etc"));
    cr_expect_null(strstr(tex, "\\write18"));
    cr_expect_not_null(strstr(tex, "[U+4E2D] [U+0105] \u00e9$\\omega$"));
    free(tex);
    bool installed = set_in_type(&p, "a");
    place_clear(&p);
    if (!installed) cr_skip_test("no pdflatex with pgfplots");
}

/* The body alone, within another document; and the reduced equations, too; and what is exported. */
Test(tex, a_fragment_is_read_by_another_document)
{
    place p = place_with_systems();
    finished f = run_expecting(&p, "analyze sleigh --quiet --tex body.tex --fragment", 0);
    finished_clear(&f);
    f = run_expecting(&p, "reduce vertical_disk --to latex", 0);
    write_here(&p, "reduced.tex", f.out);
    finished_clear(&f);
    char *body = read_here(&p, "body.tex");
    cr_expect_null(strstr(body, "\\documentclass"));
    cr_expect_null(strstr(body, "{document}"));
    free(body);
    write_here(&p, "paper.tex", "\\documentclass{article}\\usepackage{amsmath,amssymb,longtable,pgfplots}\\pgfplotsset{compat=1.16}\n"
                                "\\begin{document}\\section{Ours}\\input{body}\\section{Theirs}\\input{reduced}\\end{document}\n");
    f = run_expecting(&p, sweep_sanitized() && !sweep_whole() ? "export sleigh --to latex --of equations,submanifold,reduced"
                                                            : "export crane --to latex --of equations,submanifold,reduced", 0);
    write_here(&p, "exported.tex", f.out);
    finished_clear(&f);
    bool installed = set_in_type(&p, "paper") && set_in_type(&p, "exported");
    place_clear(&p);
    if (!installed) cr_skip_test("no pdflatex with pgfplots");
}
