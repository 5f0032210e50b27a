/* ordinary_input: what people write as on paper is read, with its meaning, or refused with the text to write, which then is read. */
#include <criterion/criterion.h>

#include <stdio.h>
#include <string.h>

#include "base/files.h"
#include "base/memory.h"
#include "graph/dag.h"
#include "graph/parse.h"
#include "graph/print.h"
#include "program.h"
#include "system/system.h"

/* ---- expressions ---- */

/* As written, and in the canonical form.  One that is refused has its canonical form in the hint. */
static const struct {
    const char *written, *means;
} READ[] = {
    {"x**2", "x^2"},
    {"θ", "theta"},
    {"m θ'^2", "m*theta'^2"},
    {"½ m l² θ̇²", "1/2*m*l^2*theta'^2"},
    {"½m θ̇² + ¼", "m*theta'^2/2 + 1/4"},
    {"m/2 (ẋ² + ẏ²)", "m/2*(x'^2 + y'^2)"},
    {"ẋ_1 + ẋ₁", "2*x_1' + x1' - x_1'"},
    {"2·x×y − y÷2", "2*x*y - y/2"},
    {"x’ + y‘ + x′", "2*x' + y'"},
    {"x⁻² + y¹²", "x^-2 + y^12"},
    {"cos θ", "cos(theta)"},
    {"−m g l cos θ", "-m*g*l*cos(theta)"},
    {"m g l (1 - cos θ)", "m*g*l*(1 - cos(theta))"},
    {"2(x + 1)", "2*(x + 1)"},
    {"2x + 3.5y", "2*x + 3.5*y"},
    {"2 m l", "2*m*l"},
    {"V (x + 1) + m (t) + l (x)", "V*(x + 1) + m*t + l*x"},
    {"2 m x y x' y'", "2*m*x*y*x'*y'"},
    {"m l^2 θ'^2/2", "m*l^2*theta'^2/2"},
    {"1/2 m x'^2", "1/2*m*x'^2"},
    {"x'y'", "x'*y'"},
    {"sin(x)cos(y)", "sin(x)*cos(y)"},
    {"cos θ cos φ", "cos(theta)*cos(phi)"},
    {"sin^2(x) + cos^2 x", "sin(x)^2 + cos(x)^2"},
    {"sin² θ φ̇²", NULL},
    {"sin²(θ) φ̇²", "sin(theta)^2*phi'^2"},
    {"√x + √(x + y) + sqrt 2", "sqrt(x) + sqrt(x + y) + sqrt(2)"},
    {"theta_dot + thetadot", "2*theta'"},
    {"dtheta/dt", "theta'"},
    {"m/2 (dx/dt)^2", "m/2*x'^2"},
    {"dθ/dt + dx(t)/dt", "theta' + x'"},
    {"diff(theta, t) + diff(theta(t), t)", "2*theta'"},
    {"Derivative(x, t)^2 + Derivative(x(t),t)", "x'^2 + x'"},
    {"theta(t) + x'(t)", "theta + x'"},
    {"90deg + 90° + 90 deg", "3*pi/2"},
    {"π x", "pi*x"},
    {"2π", "2*pi"},
    {"\\dot{\\theta}^2 + \\dot\\phi", "theta'^2 + phi'"},
    {"\\frac{1}{2} m l^2 \\dot{\\theta}^{2}", "1/2*m*l^2*theta'^2"},
    {"\\frac{m}{2}\\left(\\dot x^2 + \\dot{y}^2\\right)", "m/2*(x'^2 + y'^2)"},
    {"m g l \\cos\\theta - m\\,g\\,x", "m*g*l*cos(theta) - m*g*x"},
    {"\\frac{d\\theta}{dt}", "theta'"},
    {"\\sin^2\\theta", "sin(theta)^2"},
    {"\\dot{x}_1", "x_1'"},
    {"x^{2}", "x^2"},
    {"x\ty", "x*y"},
}, REFUSED[] = {
    {"m(x + 1)", "m*(x + 1)"},
    {"(x + 1)(y + 2)", "(x + 1)*(y + 2)"},
    {"x^2y", "x^2*y"},
    {"x 2", "x*2"},
    {"(x)2", "(x)*2"},
    {"1/2m", "1/2*m"},
    {"g/l x", "g/l*x"},
    {"1/2(x + y)", "1/2*(x + y)"},
    {"sin 2x", "sin(2*x)"},
    {"sin x^2", "sin(x^2)"},
    {"cos x*y", "cos(x*y)"},
    {"mgl", "m*g*l"},
    {"mgl cos θ", "m*g*l*cos(theta)"},
    {"costheta", "cos(theta)"},
    {"sinθ", "sin(theta)"},
    {"m*9,81", "m*9.81"},
    {"1½", "1+1/2"},
    {"m*x(y)", "m*x*(y)"},
    {"V(x)", "V"},
    {"2 V(x) + 1", "2*V + 1"},
    {"V (x) + 1", "V + 1"},
    {"m theta (t)", "m*theta"},
    {"V(x + 1)", "V*(x + 1)"},
    {"|x| + 1", "abs(x) + 1"},
    {"m*[x + y]", "m*(x + y)"},
    {"1 000 x", "1000*x"},
    {"lθ̇", "l*theta'"},
};

static void frame(const char *expression, char *text, size_t size)
{
    cr_assert_lt(snprintf(text, size,
                          "parameters: {m: 1, g: 9.81, l: 2}\n"
                          "coordinates: [theta, phi, x, y, x_1, x1]\n"
                          "definitions:\n  - V = x^2\n  - |-\n    u = %s\n"
                          "lagrangian: theta'^2 + phi'^2 + x'^2 + y'^2 + x_1'^2 + x1'^2 + u\n",
                          expression),
                 (int)size);
}

/* What a system says: its coordinates, parameters, Lagrangian, constraints and forces. */
static char *meaning(const char *text, nh_error *error)
{
    nh_text out;
    nh_error_clear(error);
    nh_system *s = nh_system_parse("test.yaml", text, 0, NULL, error);
    if (!s) return NULL;
    nh_text_init(&out);
    for (size_t i = 0; i < s->coordinates; i++) nh_text_addf(&out, "%s, ", s->coordinate[i].name);
    for (size_t i = 0; i < s->parameters; i++)
        nh_text_addf(&out, "%s = %.17g, ", s->parameter[i].name, s->parameter[i].value);
    char *lagrangian = nh_print_string(s->dag, s->lagrangian);
    nh_text_addf(&out, "L = %s", lagrangian);
    nh_free(lagrangian);
    for (size_t i = 0; i < s->constraints + s->coordinates; i++) {
        nh_ex e = i < s->constraints ? nh_sub(s->dag, s->constraint[i].lhs, s->constraint[i].rhs)
                                     : s->force[i - s->constraints];
        char *one = nh_print_string(s->dag, e);
        nh_text_addf(&out, "; %s", one);
        nh_free(one);
    }
    nh_system_free(s);
    return out.data;
}

static char *meaning_of_expression(const char *expression, nh_error *error)
{
    char text[2000];
    frame(expression, text, sizeof text);
    return meaning(text, error);
}

/* The first text in `...` behind "write " in the hint. */
static bool proposed(const nh_error *error, const char *before, char *out, size_t size)
{
    const char *begin = strstr(error->hint, before), *end;
    if (!begin) return false;
    begin += strlen(before);
    end = strchr(begin, '`');
    return end && snprintf(out, size, "%.*s", (int)(end - begin), begin) < (int)size;
}

Test(ordinary_input, expressions_are_read)
{
    for (size_t i = 0; i < sizeof READ / sizeof *READ; i++) {
        nh_error error, other;
        if (!READ[i].means) continue;
        char *found = meaning_of_expression(READ[i].written, &error), *wanted = meaning_of_expression(READ[i].means, &other);
        cr_expect(found, "%s: %s; %s", READ[i].written, error.what, error.hint);
        cr_assert(wanted, "%s: %s", READ[i].means, other.what);
        if (found) cr_expect_str_eq(found, wanted, "%s: %s, not %s", READ[i].written, found, wanted);
        nh_free(found);
        nh_free(wanted);
    }
}

Test(ordinary_input, refused_expressions_come_with_the_one_to_write)
{
    for (size_t i = 0; i < sizeof REFUSED / sizeof *REFUSED; i++) {
        nh_error error, other;
        char text[300];
        char *found = meaning_of_expression(REFUSED[i].written, &error);
        cr_expect_null(found, "%s is read as %s", REFUSED[i].written, found);
        nh_free(found);
        if (!proposed(&error, "write `", text, sizeof text)) {
            cr_expect(false, "%s: %s; %s", REFUSED[i].written, error.what, error.hint);
            continue;
        }
        char *mended = meaning_of_expression(text, &error), *wanted = meaning_of_expression(REFUSED[i].means, &other);
        cr_assert(wanted, "%s: %s", REFUSED[i].means, other.what);
        cr_expect(mended && !strcmp(mended, wanted), "%s: %s is proposed, not %s", REFUSED[i].written, text, REFUSED[i].means);
        nh_free(mended);
        nh_free(wanted);
    }
}

/* ---- files ---- */

/* The text up to the next line that begins with "=== ", whose rest is in *rest; NULL at the end. */
static char *part(char **at, char **rest)
{
    char *begin = *at, *end = strncmp(begin, "=== ", 4) ? strstr(begin, "\n=== ") : begin - 1;
    if (end) {
        *rest = end + 5;
        *at = strchr(*rest, '\n') + 1;
        (*at)[-1] = 0;
        if (end >= begin) end[1] = 0;
    } else {
        *rest = NULL;
        *at = begin + strlen(begin);
    }
    return begin;
}

/* Does the file mean the same as the other one, or is it refused with a line that stands in the other one? */
static void check_file(const char *name, const char *file, const char *refused, const char *means)
{
    nh_error error, other;
    char *found = meaning(file, &error), *wanted = meaning(means, &other);
    cr_expect(wanted, "%s: %s; %s", name, other.what, other.hint);
    if (refused) {
        char line[200];
        snprintf(line, sizeof line, "%.*s", (int)strcspn(refused, "\n"), refused);
        cr_expect_null(found, "%s is read", name);
        cr_expect(strstr(error.hint, line) || strstr(error.what, line), "%s: %s; %s", name, error.what, error.hint);
        cr_expect(strstr(means, line) || !strstr(error.hint, line), "%s: the line `%s` is not what the mended file has", name, line);
    } else {
        cr_expect(found, "%s: %s; %s", name, error.what, error.hint);
        if (found && wanted) cr_expect_str_eq(found, wanted, "%s: %s, not %s", name, found, wanted);
    }
    nh_free(found);
    nh_free(wanted);
}

Test(ordinary_input, files_are_read_or_refused_with_the_line_to_write)
{
    nh_error error;
    size_t length, cases = 0;
    char *bytes = nh_files_read("tests/data/ordinary_input.txt", 1 << 20, &length, &error), *at = bytes, *name, *rest;
    cr_assert_not_null(bytes);
    part(&at, &name);
    while (name) {
        char *file = part(&at, &rest), *refused = NULL;
        cr_assert_not_null(rest, "%s", name);
        if (!strcmp(rest, "refused")) refused = part(&at, &rest);
        cr_assert(rest && !strcmp(rest, "is"), "%s", name);
        char *means = part(&at, &rest);
        check_file(name, file, refused, means);
        cases++;
        name = rest;
    }
    cr_expect_geq(cases, 30, "%zu", cases);
    nh_free(bytes);
}

/* The ends of lines and a mark at the beginning do not matter, nor a tab between the words of an expression. */
Test(ordinary_input, files_of_other_editors)
{
    static const char *const files[] = {"coordinates: [x]\r\nlagrangian: x'^2/2 - x^4\r\n", "\xEF\xBB\xBF" "coordinates: [x]\nlagrangian: x'^2/2 - x^4",
                                        "coordinates: [x]\nlagrangian: x'^2/2\t-\tx^4\n", "coordinates: [x]\rlagrangian: x'^2/2 - x^4\r"};
    nh_error error;
    char *wanted = meaning("coordinates: [x]\nlagrangian: x'^2/2 - x^4\n", &error);
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char *found = meaning(files[i], &error);
        cr_expect(found && !strcmp(found, wanted), "%zu: %s; %s", i, error.what, error.hint);
        nh_free(found);
    }
    nh_free(wanted);
}

/* ---- the command line ---- */

Test(ordinary_input, numbers_of_options_are_expressions)
{
    static const char *const pairs[][2] = {
        {"--initial theta=90deg --until 2pi --step pi/4", "--initial theta=pi/2 --until 6.283185307179586 --step 0.7853981633974483"},
        {"--initial θ=90°,θ̇=0 --until 1 --step 1/2", "--initial theta=pi/2,theta'=0 --until 1 --step 0.5"},
        {"--initial theta_dot=1 --until 1 --step 1", "--initial theta'=1 --until 1 --step 1"},
        {"--initial θ(0)=1,θ̇(0)=2 --until 1 --step 1", "--initial theta=1,theta'=2 --until 1 --step 1"},
        {"--initial {theta:1,theta':2} --until 1 --step 1", "--initial theta=1,theta'=2 --until 1 --step 1"},
        {"--initial θ=1 --until 1 --step 1 --watch θ̇²,a=2θ", "--initial theta=1 --until 1 --step 1 --watch theta'^2,a=2*theta"},
        {"--initial θ=1 --until 1 --step 1 --axes θ,θ̇ --svg a.svg", "--initial theta=1 --until 1 --step 1 --axes theta,theta' --svg b.svg"},
        {"--initial dtheta/dt=1 --until 1 --step 1", "--initial theta'=1 --until 1 --step 1"},
        {"--initial thetadot:1 --until 1 --step 1", "--initial theta'=1 --until 1 --step 1"},
        {"--initial theta=1 --set g=2*pi --until 1 --step 1", "--initial theta=1 --set g=6.283185307179586 --until 1 --step 1"},
        {"--initial theta=1 --set g=sqrt(3) --until 1 --step 1", "--initial theta=1 --set g=1.7320508075688772 --until 1 --step 1"},
        {"--initial theta=1 --tolerance 10^-8 --until 1 --step 1", "--initial theta=1 --tolerance 1e-8 --until 1 --step 1"},
        {"--over theta=0:pi/2:3 --until 1 --step 1", "--over theta=0:1.570796327:3 --until 1 --step 1"},
        {"--over g=1,π --until 1 --step 1 --initial theta=1", "--over g=1,3.141592654 --until 1 --step 1 --initial theta=1"},
    };
    place p = place_make();
    write_here(&p, "swing.yaml", "parameters: {g: 9.81}\ncoordinates: [theta]\nlagrangian: θ̇²/2 + g cos θ\n");
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        char line[2][400];
        for (int k = 0; k < 2; k++) snprintf(line[k], sizeof line[k], "simulate swing.yaml -q %s", pairs[i][k]);
        finished a = run(&p, line[0]), b = run(&p, line[1]);
        cr_expect(a.code == 0 && b.code == 0 && !strcmp(a.out, b.out), "%s: %s %s", pairs[i][0], a.err, b.err);
        finished_clear(&a);
        finished_clear(&b);
    }
    finished comma = run(&p, "simulate swing.yaml --initial theta=0,5"), set = run(&p, "simulate swing.yaml --set g=9,81");
    cr_expect(comma.code == 2 && strstr(comma.err, "theta=0.5"), "%s", comma.err);
    cr_expect(set.code == 2 && strstr(set.err, "--set g=9.81"), "%s", set.err);
    finished_clear(&comma);
    finished_clear(&set);
    place_clear(&p);
}

/* ---- the kind: random formulas, each in the canonical form and as on paper ---- */

typedef struct {
    unsigned long seed;
    size_t proposals;
} chance;

static unsigned pick(chance *c, unsigned n)
{
    c->seed = c->seed * 6364136223846793005UL + 1442695040888963407UL;
    return (unsigned)(c->seed >> 33) % n;
}

static bool known_name(void *context, const char *name, nh_ex *out, nh_parse_fault *fault)
{
    static const char *const names[] = {"m", "g", "l", "x", "theta", "x'", "theta'", "x_1", "x_1'"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (!strcmp(name, names[i])) return *out = nh_symbol(context, name), true;
    snprintf(fault->what, sizeof fault->what, "unknown name `%s`", name);
    return false;
}

static void put_sum(chance *c, unsigned depth, nh_text *plain, nh_text *paper);

/* A name, a velocity, a power of one, a call or a sum in parentheses; `last`: the argument may have no parentheses. */
static void put_factor(chance *c, unsigned depth, bool last, nh_text *plain, nh_text *paper)
{
    static const char *const names[][4] = {{"m", "m", "m", "m"}, {"g", "g", "g", "g"}, {"l", "l", "l", "l"}, {"theta", "θ", "\\theta", "theta"},
                                           {"x", "x", "x(t)", "x"}, {"x_1", "x_1", "x_{1}", "x_1"}},
                             *const rates[][6] = {{"x'", "ẋ", "x’", "dx/dt", "diff(x, t)", "\\dot{x}"}, {"theta'", "θ̇", "θ′", "dθ/dt", "\\dot\\theta", "diff(θ(t), t)"},
                                                  {"x_1'", "ẋ_1", "\\dot{x}_1", "x_1'", "x_1'", "x_1'"}};
    static const char *const powers[][4] = {{"^2", "^2", "²", "**2"}, {"^3", "^{3}", "³", "^3"}};
    static const char *const calls[][2] = {{"sin", "sin"}, {"cos", "\\cos"}, {"sqrt", "√"}};
    unsigned kind = pick(c, depth ? 6 : 4);
    if (kind < 2) {
        unsigned n = pick(c, 6);
        nh_text_add(plain, names[n][0]);
        nh_text_add(paper, names[n][pick(c, 4)]);
    } else if (kind < 4) {
        unsigned n = pick(c, 3), how = pick(c, 6), p = pick(c, 3);
        bool quotient = strchr(rates[n][how], '/') != NULL;
        nh_text_addf(plain, "%s%s", rates[n][0], p < 2 ? powers[p][0] : "");
        nh_text_addf(paper, quotient ? "(%s)%s" : "%s%s", rates[n][how], p < 2 ? powers[p][pick(c, 4)] : "");
    } else if (kind == 4) {
        unsigned f = pick(c, 3), n = pick(c, 6);
        bool bare = last && pick(c, 2);
        nh_text_addf(plain, "%s(", calls[f][0]);
        nh_text_add(paper, calls[f][pick(c, 2)]);
        nh_text_addf(paper, bare ? " %s" : "(", names[n][pick(c, 2)]);
        if (bare) nh_text_add(plain, names[n][0]);
        else put_sum(c, depth - 1, plain, paper);
        nh_text_add(plain, ")");
        if (!bare) nh_text_add(paper, ")");
    } else {
        nh_text_add(plain, "(");
        nh_text_add(paper, "(");
        put_sum(c, depth - 1, plain, paper);
        nh_text_add(plain, ")");
        nh_text_add(paper, ")");
    }
}

static void put_term(chance *c, unsigned depth, nh_text *plain, nh_text *paper)
{
    static const char *const numbers[][4] = {{"1/2*", "½ ", "1/2 ", "1/2"}, {"2*", "2", "2 ", "2·"}, {"3.5*", "3.5", "3.5 ", "3.5×"}, {"", "", "", ""}};
    static const char *const between[] = {" ", "*", "·", "×", " ", " * ", "\\cdot ", ""};
    unsigned n = pick(c, 4), factors = 1 + pick(c, 3);
    nh_text_add(plain, numbers[n][0]);
    nh_text_add(paper, numbers[n][pick(c, 4)]);
    for (unsigned i = 0; i < factors; i++) {
        const char *sign = between[pick(c, 8)];
        nh_text factor;
        nh_text_init(&factor);
        if (i) nh_text_add(plain, "*");
        put_factor(c, depth, i + 1 == factors, plain, &factor);
        bool ends = i && (strchr(")'", paper->data[paper->length - 1]) || factor.data[0] == '(');
        if (!*sign && !ends) sign = " "; /* mx is a name of two letters */
        if (i) nh_text_add(paper, sign);
        nh_text_add(paper, factor.data);
        nh_text_clear(&factor);
    }
}

static void put_sum(chance *c, unsigned depth, nh_text *plain, nh_text *paper)
{
    unsigned terms = 1 + pick(c, 3);
    for (unsigned i = 0; i < terms; i++) {
        bool minus = pick(c, 2);
        if (i) nh_text_add(plain, minus ? " - " : " + "), nh_text_add(paper, !minus ? "+" : pick(c, 2) ? " − " : "-");
        put_term(c, depth, plain, paper);
    }
}

/* Read with the same meaning; or refused, as `mx'` and `m(x + 1)` are: then the text that is proposed is read so, or the next one. */
static void check_formula(chance *c, const char *plain, const char *paper)
{
    enum { rounds = 12 };
    nh_dag *d = nh_dag_create();
    nh_parse_fault fault;
    nh_ex wanted, found;
    char text[600], next[600], *end;
    snprintf(text, sizeof text, "%s", paper);
    cr_assert(nh_parse(d, plain, known_name, d, &wanted, &fault), "%s: %s", plain, fault.what);
    for (int i = 0; i < rounds; i++) {
        if (nh_parse(d, text, known_name, d, &found, &fault)) {
            cr_expect_eq(found, wanted, "%s, as %s, is not %s", paper, text, plain);
            break;
        }
        bool proposal = !strncmp(fault.hint, "write `", 7) && (end = strchr(fault.hint + 7, '`'));
        cr_expect(proposal && i + 1 < rounds, "%s, as %s: %s; %s", paper, text, fault.what, fault.hint);
        if (!proposal) break;
        snprintf(next, sizeof next, "%.*s", (int)(end - fault.hint - 7), fault.hint + 7);
        if (strlen(text) > 90) break; /* a part of the text is shown */
        strcpy(text, next);
        c->proposals++;
    }
    nh_dag_free(d);
}

Test(ordinary_input, random_formulas_mean_the_same_on_paper)
{
    chance c = {.seed = 7};
    for (int i = 0; i < 3000; i++) {
        nh_text plain, paper;
        nh_text_init(&plain);
        nh_text_init(&paper);
        put_sum(&c, 2, &plain, &paper);
        if (paper.length < 500) check_formula(&c, plain.data, paper.data);
        nh_text_clear(&plain);
        nh_text_clear(&paper);
    }
    cr_expect_gt(c.proposals, 50, "%zu", c.proposals);
}

/* Outputs have the canonical form; what is written so stays as it is written. */
Test(ordinary_input, texts_for_outputs_are_canonical)
{
    static const char file[] = "parameters: m = 2\ncoordinates: [x, y, φ]\nT: ½ m (ẋ² + ẏ²) + φ̇²/2\ndefinitions: [\"w = 2*m\"]\n"
                               "constraints: [\"ẋ sin φ = ẏ cos φ\", \"phi'  = 0*x'\"]\n";
    nh_error error;
    nh_error_clear(&error);
    nh_system *s = nh_system_parse("test.yaml", file, 0, NULL, &error);
    cr_assert(s, "%s; %s", error.what, error.hint);
    cr_expect_str_eq(s->constraint[0].text, "x'*sin(phi) = y'*cos(phi)");
    cr_expect_str_eq(s->constraint[1].text, "phi'  = 0*x'");
    cr_expect_str_eq(s->definition[0].text, "w = 2*m");
    cr_expect_str_eq(s->definition[1].text, "T = (phi'^2 + m*(x'^2 + y'^2))/2");
    nh_system_free(s);
}

/* Whatever is written is read or refused, with a place within it. */
Test(ordinary_input, pieces_in_any_order)
{
    static const char *const pieces[] = {"\\frac", "\\dot", "\\ddot", "\\sqrt", "\\left(", "\\sin", "{", "}", "²", "⁻", "½", "°", "√", "θ", "ẋ", "\u0307", "\u0308", "_", "(t)", "(", ")",
                                         "diff(", "x", "m", "'", "^", "/dt", "d", ", t)", "2", ".", " ", "|", "[", "]", "sin", "atan2", "deg", "−", "·", "\xc3", "\xff", "1e", "\\", "=", ","};
    chance c = {.seed = 3};
    for (int i = 0; i < 20000; i++) {
        nh_dag *d = nh_dag_create();
        nh_parse_fault fault;
        nh_ex e;
        nh_text text;
        nh_text_init(&text);
        for (unsigned n = 1 + pick(&c, 12); n; n--) nh_text_add(&text, pieces[pick(&c, sizeof pieces / sizeof *pieces)]);
        if (!nh_parse(d, text.data, known_name, d, &e, &fault))
            cr_expect(fault.what[0] && fault.offset <= text.length, "%s: %s at %zu", text.data, fault.what, fault.offset);
        nh_text_clear(&text);
        nh_dag_free(d);
    }
}

/* Tables of spreadsheets: other separators, decimal commas, marks, and names in every spelling. */
Test(ordinary_input, tables)
{
    static const char *const tables[] = {"\xEF\xBB\xBFθ;θ̇;g\r\n0,5;0;9,81\r\n1;0,25;9,81\r\n", "theta\ttheta_dot\tg\n1/2\t0\t9.81\n1\t0.25\t9.81\n",
                                         "theta, dtheta/dt, g\n0.5, 0, 9.81\n1, .25, 9.81\n", "g,θ(0),thetadot\n9.81,0.5,0\n9.81,1,0.25\n"};
    place p = place_make();
    write_here(&p, "swing.yaml", "parameters: {g: 9.81}\ncoordinates: [θ]\nL: θ̇²/2 + g cos θ\n");
    write_here(&p, "plain.csv", "theta,theta',g\n0.5,0,9.81\n1,0.25,9.81\n");
    finished wanted = run_expecting(&p, "simulate swing.yaml -q --until 1 --step 1 --initial-table plain.csv", 0);
    for (size_t i = 0; i < sizeof tables / sizeof *tables; i++) {
        write_here(&p, "table.csv", tables[i]);
        finished found = run_expecting(&p, "simulate swing.yaml -q --until 1 --step 1 --initial-table table.csv", 0);
        cr_expect_str_eq(found.out, wanted.out, "%s", tables[i]);
        finished_clear(&found);
    }
    finished_clear(&wanted);
    place_clear(&p);
}

/* Every notation of a rate, of every kind of name that has one; and of those that have none, the reason. */
Test(ordinary_input, rates_of_all_names_in_all_notations)
{
    static const struct {
        const char *name, *dotted, *definitions, *refused; /* refused: what is said */
    } of[] = {{"x", "ẋ", "", NULL},
              {"xc", NULL, "xc: x + a*cos(phi)", NULL},
              {"x_c", "ẋ_c", "x_c: x + a*cos(phi)", NULL},
              {"x_1", "ẋ_1", "x_1: 2*x", NULL},
              {"h", "ḣ", "h0: x + t, h: h0^2", NULL},
              {"θ", "θ̇", "θ: sin(t)", NULL},
              {"w", "ẇ", "w: a*x'", "contains accelerations"},
              {"a", "ȧ", "", "`a` is neither"},
              {"zeta", "ζ̇", "", "under `definitions:`"}};
    static const char *const how[] = {"%s'", "%s_dot", "%sdot", "\\dot{%s}", "d%s/dt", "diff(%s, t)", "Derivative(%s(t), t)", ""};
    place p = place_make();
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        finished wanted = {.out = NULL};
        for (size_t k = 0; k < sizeof how / sizeof *how; k++) {
            char rate[64], file[400];
            if (!*how[k] && !of[i].dotted) continue;
            if (!strcmp(of[i].name, "zeta") && k == 2) continue; /* zetadot may be a name of its own */
            snprintf(rate, sizeof rate, *how[k] ? how[k] : of[i].dotted, of[i].name);
            snprintf(file, sizeof file, "parameters: {a: 0.3}\ncoordinates: [x, y, phi]\ndefinitions: {%s}\n"
                     "L: x'^2/2 + y'^2 + phi'^2 + (%s)^2\nforces:\n  - y = -(%s)\n", of[i].definitions, rate, rate);
            write_here(&p, "rates.yaml", file);
            finished found = run_expecting(&p, "simulate rates.yaml -q --until 0.2 --step 0.1 --initial x=1,x'=2", of[i].refused ? 3 : 0);
            if (of[i].refused) cr_expect(strstr(found.err, of[i].refused), "%s: %s", rate, found.err);
            else if (k) cr_expect_str_eq(found.out, wanted.out, "%s", rate);
            if (k) finished_clear(&found);
            else wanted = found;
        }
        finished_clear(&wanted);
    }
    place_clear(&p);
}

/* The column of the time has its usual names; a motion with an input begins at rest at t = 0, and its page says how. */
Test(ordinary_input, an_input_begins_at_zero_and_comes_back_as_command)
{
    static const char *const names[] = {"t", "time", "Time", "TIME [s]", "t (s)", "time_s"};
    place p = place_make();
    write_here(&p, "driven.yaml", "parameters: {u: 0}\ncoordinates: {q: angle}\nL: q'^2/2 + cos(q)\nforces: {q: u}\n");
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char table[100];
        snprintf(table, sizeof table, "%s,force\n0,0\n1,0.5\n2,0\n", names[i]);
        write_here(&p, "u.csv", table);
        finished found = run_expecting(&p, "simulate driven.yaml --until 1 --step 1 --input u=u.csv:force --html page.html", 0);
        char *page = read_here(&p, "page.html");
        cr_expect(strstr(found.out, "\n0,") && strstr(found.out, ",0,"), "%s: %s", names[i], found.out);
        cr_expect(strstr(page, "No initial state was given. The program chose this one: q="), "%s", names[i]);
        cr_expect(strstr(page, "nhsym simulate driven.yaml --input \\\"u=u.csv:force\\\""), "%s", names[i]);
        nh_free(page);
        finished_clear(&found);
    }
    write_here(&p, "u.csv", "clock,force\n0,0\n1,0.5\n");
    finished found = run_expecting(&p, "simulate driven.yaml --until 1 --step 1 --input u=u.csv:force", 3);
    cr_expect(strstr(found.err, "there is no column `t`"), "%s", found.err);
    finished_clear(&found);
    place_clear(&p);
}

/* A radius begins at 1, where r = 0 is a pole of the equations and the file gives no interval, however wide; a length without a pole is rounded only. */
Test(ordinary_input, a_radius_begins_at_one)
{
    place p = place_make();
    write_here(&p, "polar.yaml", "coordinates: r, a\nL: r'^2/2 + r^2*a'^2/2 - r^2\n");
    write_here(&p, "wide.yaml", "coordinates: r, a\nL: r'^2/2 + r^2*a'^2/2 - r^2\ndomain: {r: [-5, 5]}\n");
    write_here(&p, "plain.yaml", "coordinates: r, a\nL: r'^2/2 + a'^2/2 - r^2\n");
    static const struct { const char *file; bool one; } cases[] = {{"polar", true}, {"wide", false}, {"plain", false}};
    for (size_t i = 0; i < 3; i++) {
        char line[100];
        snprintf(line, sizeof line, "simulate %s.yaml --until 1 --step 1", cases[i].file);
        finished found = run_expecting(&p, line, 0);
        cr_expect_eq(strstr(found.err, "\"r=1, ") != NULL, cases[i].one, "%s: %s", cases[i].file, found.err);
        finished_clear(&found);
    }
    place_clear(&p);
}
