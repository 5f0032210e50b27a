/* `reduce` on systems whose groups, closed forms and measures are known independently: by construction, or by hand.
 *
 * A system is built from a group that is known, from a small coupling that breaks a symmetry however small it is, with forces, with
 * indefinite metrics, or on slices at poles of its coordinates.  Every equation that is printed is compared with the true accelerations. */
#include "oracle.h"

#include <stdio.h>

#include "commands/reduce.h"
#include "scratch.h"
#include "sweep.h"

typedef enum { NO_MEASURE = -1, UNTESTED, A_MEASURE } measure;

typedef struct {
    const char *coordinates; /* "x y a:angle" */
    const char *lagrangian, *rest; /* rest: other keys of the file, a line each, or NULL */
    const char *group;       /* its name */
    size_t dimension, closed;
    measure measure;         /* of the first stage */
    bool weak;
    const char *fields;      /* --group */
} known;

/* L of plane points and turns */
#define POINT2 "(x'^2 + y'^2)/2"
#define POINT3 "(x'^2 + y'^2 + z'^2)/2"
#define MINKOWSKI "(x'^2 + y'^2 + z'^2 - s'^2)/2"
#define SLEIGH(a) "7/10*((x' - " a "*h'*sin(h))^2 + (y' + " a "*h'*cos(h))^2) + h'^2/4", "constraints: [\"y'*cos(h) = x'*sin(h)\"]"
#define THRUST "forces: [\"x = cos(h)\", \"y = sin(h)\"]"
#define SPHERE "(a'^2 + sin(a)^2*b'^2)/2"

#define SIX "(a'^2 + b'^2 + c'^2 + d'^2 + e'^2 + f'^2)/2"
#define TOP(I, K) "(" I "*(h'^2 + sin(h)^2*p'^2) + " K "*(s' + p'*cos(h))^2)/2"
#define UPRIGHT "domain: {h: [0.5, 2.5]}"
#define RING5 "(a'^2 + b'^2 + c'^2 + d'^2 + e'^2)/2 - ((a - b)^2 + (b - c)^2 + (c - d)^2 + (d - e)^2 + (e - a)^2)/2"
/* in the plane, of masses 1, 2, 3, 4: the centre of mass, and all about it, may be turned each for itself */
#define PAIR(x, y, u, w) "((" x " - " u ")^2 + (" y " - " w ")^2)^2"
#define FOUR_BODIES \
    POINT2 " + u'^2 + w'^2 + 3*(p'^2 + q'^2)/2 + 2*(r'^2 + s'^2) - " PAIR("x", "y", "u", "w") "/9 - 2*" \
    PAIR("x", "y", "p", "q") "/9 - " PAIR("x", "y", "r", "s") "/3 - " PAIR("u", "w", "p", "q") "/3 - 4*" \
    PAIR("u", "w", "r", "s") "/9 - 5*" PAIR("p", "q", "r", "s") "/9"

static const known table[] = {
    /* small couplings: what they break is broken, at 1 as at 1e-12 */
    {"x y", POINT2 " - (x^2 + y^2)/2", NULL, "SO(2)", 1, 1, UNTESTED, false, NULL},
    {"x y", POINT2 " - (x^2 + y^2)/2 - 1e-3*x^2", NULL, "trivial", 0, 0, UNTESTED, false, NULL},
    {"x y", POINT2 " - (x^2 + y^2)/2 - 1e-8*x^2/2", NULL, "trivial", 0, 0, UNTESTED, false, NULL},
    {"x y", POINT2 " - (x^2 + y^2)/2 - 1e-12*x^2/2", NULL, "trivial", 0, 0, UNTESTED, false, NULL},
    {"x y", POINT2 " - 1e-8*x*(1 + y^2)", NULL, "trivial", 0, 0, UNTESTED, false, NULL},
    {"x y", POINT2 " - 1e-12*x*(1 + y^2)", NULL, "trivial", 0, 0, UNTESTED, false, NULL},
    {"x y", POINT2 " - 1e-12*x", NULL, "R", 1, 1, UNTESTED, false, NULL},
    {"x y z", POINT3 " + 1/sqrt(x^2 + y^2 + z^2)", "domain: {x: [1, 2]}", "SO(3)", 3, 3, UNTESTED, false, NULL},
    {"x y z", POINT3 " + 1/sqrt(x^2 + y^2 + z^2)*(1 - 1e-3*(3*z^2/(x^2 + y^2 + z^2) - 1))", "domain: {x: [1, 2]}", "SO(2)", 1, 1, UNTESTED, false, NULL},
    {"x y z", POINT3 " + 1/sqrt(x^2 + y^2 + z^2)*(1 - 1e-8*(3*z^2/(x^2 + y^2 + z^2) - 1))", "domain: {x: [1, 2]}", "SO(2)", 1, 1, UNTESTED, false, NULL},
    {"x y z", POINT3 " + 1/sqrt(x^2 + y^2 + z^2)*(1 - 1e-10*(3*z^2/(x^2 + y^2 + z^2) - 1))", "domain: {x: [1, 2]}", "SO(2)", 1, 1, UNTESTED, false, NULL},
    /* the axis of the perturbation is (1, 1, 0): the symmetry is a combination of those that are broken */
    {"x y z", POINT3 " - (x^2 + y^2 + z^2)/2 - 1e-9*(x + y)^4", NULL, "SO(2)", 1, 1, UNTESTED, false, NULL},
    {"x y z", POINT3 " - (x^2 + y^2 + z^2)/2 - 1e-9*(3*x + 4*z)^4", NULL, "SO(2)", 1, 1, UNTESTED, false, NULL},
    {"x y z", POINT3 " - (x^2 + y^2 + z^2)/2 - 1e-11*(x + 2*y - z)^4", NULL, "SO(2)", 1, 1, UNTESTED, false, NULL},
    {"x y", POINT2 " + 1e-10*x'*y'", NULL, "SE(2)", 3, 3, UNTESTED, false, NULL},
    {"x y", "(x'^2 + (1 + 1e-9*x^2)*y'^2)/2", NULL, "R", 1, 1, UNTESTED, false, NULL},
    /* near 1/3; a curvature of 1e-8 */
    {"x y", POINT2 " - x^2/2 - 3*0.3333333333*y^2/2", NULL, "trivial", 0, 0, UNTESTED, false, NULL},
    {"x y", "2*(x'^2 + y'^2)/(2 + 1e-8*(x^2 + y^2))^2", NULL, "SO(3)", 3, 3, UNTESTED, false, NULL},
    {"x y", "2*(x'^2 + y'^2)/(2 - 1e-8*(x^2 + y^2))^2", NULL, "SL(2,R)", 3, 3, UNTESTED, false, NULL},
    /* measures */
    {"x y h:angle", SLEIGH("0.3"), "SE(2)", 3, 3, NO_MEASURE, false, NULL},
    {"x y h:angle", SLEIGH("1e-5"), "SE(2)", 3, 3, NO_MEASURE, false, NULL},
    {"x y h:angle", SLEIGH("1e-8"), "SE(2)", 3, 3, NO_MEASURE, false, NULL},
    {"x y h:angle", SLEIGH("1e-12"), "SE(2)", 3, 3, NO_MEASURE, false, NULL},
    {"x y h:angle", SLEIGH("0"), "SE(2)", 3, 3, A_MEASURE, false, NULL},
    {"x y z", POINT3, "constraints: [\"z' = y*x'\"]", "R^2", 2, 2, A_MEASURE, false, NULL},
    {"x y z", POINT3, "constraints: [\"z' = x*y' + (1 + 1e-8)*y*x'\"]", "R", 1, 1, NO_MEASURE, false, NULL},
    /* forces belong to the fit */
    {"x y h:angle", "(x'^2 + y'^2 + h'^2)/2", THRUST, "SE(2)", 3, 3, UNTESTED, false, NULL},
    {"x y h:angle", "(x'^2 + y'^2)*13/10 + h'^2/4", "forces: [\"x = cos(h) - x'\", \"y = sin(h) - y'\", \"h = -h'/3\"]", "SE(2)", 3, 3, UNTESTED, false, NULL},
    {"x y h:angle", "(x'^2 + y'^2)*13/10 + h'^2/4", "forces: [\"x = cos(h) - y\", \"y = sin(h) + x\"]", "SO(2)", 1, 1, UNTESTED, false, NULL},
    {"x y", POINT2, "forces: [\"x = -x'/5\", \"y = -y'/5\"]", "SE(2)", 3, 3, UNTESTED, false, NULL},
    {"x y", POINT2, "forces: [\"x = -y\", \"y = x\"]", "SO(2)", 1, 1, UNTESTED, false, NULL},
    {"x y", POINT2, "forces: [\"x = -x'/5\", \"y = -x'*1e-9\"]", "R^2", 2, 2, UNTESTED, false, NULL},
    {"x y z", POINT3, "forces: [\"x = -y'\", \"y = x'\"]", "SE(2) x R", 4, 4, UNTESTED, false, NULL},
    {"x y h:angle", "(x'^2 + y'^2 + h'^2)/2", "constraints: [\"y'*cos(h) = x'*sin(h)\"]\nforces: [\"x = cos(h)\", \"y = sin(h)\"]", "SE(2)", 3, 3, UNTESTED, false, NULL},
    /* magnetic: a translation changes L by a total derivative */
    {"x y", POINT2 " + (x*y' - y*x')/3", NULL, "SO(2)", 1, 1, UNTESTED, false, NULL},
    {"x y", POINT2 " + (x*y' - y*x')/3", NULL, "SE(2)", 3, 3, UNTESTED, true, NULL},
    {"x y u w", POINT2 " + (u'^2 + w'^2)*17/20 + 9/20*(x*y' - y*x' - 4/5*(u*w' - w*u')) + 4/5/sqrt((x - u)^2 + (y - w)^2)", "domain: {x: [1, 2], u: [-1, 0]}", "SE(2)", 3, 3, UNTESTED, true, NULL},
    {"x y", POINT2 " - y", NULL, "R^2", 2, 2, UNTESTED, true, NULL},
    /* indefinite metrics */
    {"x s", "(x'^2 - s'^2)/2", NULL, "E(1,1)", 3, 3, UNTESTED, false, NULL},
    {"x s", "x'*s'", NULL, "E(1,1)", 3, 3, UNTESTED, false, NULL},
    {"s x", "(x'^2 - x^2*s'^2)/2", "domain: {x: [0.6, 2]}", "E(1,1)", 3, 3, UNTESTED, false, NULL},
    {"a b", "exp(3*a)*(b'^2 - a'^2)/2", NULL, "E(1,1)", 3, 3, UNTESTED, false, NULL},
    {"a b", "exp(a)*(b'^2 - a'^2)/2", NULL, "E(1,1)", 3, 3, UNTESTED, false, NULL},
    {"x s", "(x'^2 - s'^2)/2 - x^2/2", NULL, "R", 1, 1, UNTESTED, false, NULL},
    {"x s", "(x'^2 - s'^2)/2 - (x^2 - s^2)/2", NULL, "R", 1, 1, UNTESTED, false, NULL},
    {"x s", "(x'^2 - s'^2)/2 - (x^2 - s^2)/2 - 1e-9*x^4", NULL, "trivial", 0, 0, UNTESTED, false, NULL},
    {"x y s", "(x'^2 + y'^2 - s'^2)/2", NULL, "ISO(2,1)", 6, 6, UNTESTED, false, NULL},
    {"x y z s", MINKOWSKI, NULL, "ISO(3,1)", 10, 10, UNTESTED, false, NULL},
    {"x y z s", MINKOWSKI " - (x^2 + y^2 + z^2 - s^2)^2", NULL, "SO(3,1)", 6, 6, UNTESTED, false, NULL},
    {"x y z s", MINKOWSKI " - s", NULL, "SE(3)", 6, 6, UNTESTED, false, NULL},
    /* spaces whose groups are known */
    {"x y", POINT2, NULL, "SE(2)", 3, 3, UNTESTED, false, NULL},
    {"x y z", POINT3, NULL, "SE(3)", 6, 6, UNTESTED, false, NULL},
    {"x y z w", POINT3 " + w'^2/2", NULL, "SE(4)", 10, 10, UNTESTED, false, NULL},
    {"a:angle b:angle", SPHERE, "domain: {a: [0.4, 2.6]}", "SO(3)", 3, 3, UNTESTED, false, NULL},
    {"x y", "(x'^2 + y'^2)/(2*y^2)", "domain: {y: [0.4, 1.2]}", "SL(2,R)", 3, 3, UNTESTED, false, NULL},
    {"r f:angle", "(r'^2 + sinh(r)^2*f'^2)/2", "domain: {r: [0.4, 1.2]}", "SL(2,R)", 3, 3, UNTESTED, false, NULL},
    {"x y", "2*(x'^2 + y'^2)/(1 - x^2 - y^2)^2", "domain: {x: [-0.5, 0.5], y: [-0.5, 0.5]}", "SL(2,R)", 3, 3, UNTESTED, false, NULL},
    {"x y z", "(x'^2 + y'^2 + z'^2)/(2*z^2)", "domain: {z: [0.5, 2]}", "SO(3,1)", 6, 6, UNTESTED, false, NULL},
    {"x y z", "(x'^2 + y'^2 + (z' - x*y')^2)/2", NULL, "(Heisenberg x| SO(2))", 4, 4, UNTESTED, false, NULL},
    {"x y z", "(x'^2 + 2*y'^2 + 3*(z' - x*y')^2 + x'*y')/2", NULL, "(Heisenberg x| SO(2))", 4, 4, UNTESTED, false, NULL},
    {"x y z", "(exp(2*z)*x'^2 + exp(-2*z)*y'^2 + z'^2)/2", NULL, "E(1,1)", 3, 3, UNTESTED, false, NULL},
    {"x y z", "(exp(2*z)*x'^2 + exp(4*z)*y'^2 + z'^2)/2", NULL, "Bianchi VI", 3, 3, UNTESTED, false, NULL},
    {"x y z", "(exp(2*z)*(x'^2 + y'^2) + z'^2)/2", NULL, "SO(3,1)", 6, 6, UNTESTED, false, NULL},
    {"a:angle b:angle c:angle", "(a'^2 + sin(a)^2*b'^2 + cos(a)^2*c'^2)/2", "domain: {a: [0.4, 1.2]}", "SO(3)^2", 6, 6, UNTESTED, false, NULL},
    {"r f:angle", "(r'^2 + r^2*f'^2)/2", "domain: {r: [0.6, 2]}", "SE(2)", 3, 3, UNTESTED, false, NULL},
    {"x y f:angle", "(x'^2 + y'^2 + f'^2)/2", NULL, "SE(3)", 6, 6, UNTESTED, false, NULL},
    /* many coordinates: a potential gives one condition a place, of which there must be as many as of fields */
    {"a b c d e f", SIX " - a^2 - 2*b^2 - 3*c^2 - 4*d^2 - 5*e^2 - 6*f^2", NULL, "trivial", 0, 0, UNTESTED, false, NULL},
    {"a b c d e f", SIX " - a^2 - a*b - 2*b^2 - 3*c^2 - 4*d^2 - 5*e^2 - e*f/9 - 6*f^2", NULL, "trivial", 0, 0, UNTESTED, false, NULL},
    {"a b c d e f", SIX " - a^2 - b^2 - 3*c^2 - 3*d^2 - 5*e^2 - 6*f^2", NULL, "SO(2)^2", 2, 2, UNTESTED, false, NULL},
    {"a b c d e f", SIX " - a^2 - b^2 - c^2 - 4*d^2 - 5*e^2", NULL, "SO(3) x R", 4, 4, UNTESTED, false, NULL},
    {"a b c d e f g", SIX " + g'^2/2 - a^2 - 2*b^2 - 3*c^2 - 4*d^2 - 5*e^2 - 6*f^2 - 7*g^2", NULL, "trivial", 0, 0, UNTESTED, false, NULL},
    {"a b c d e f g", SIX " + g'^2/2 - a^4 - b^4 - c^4 - d^4 - e^4 - f^4 - g^4", NULL, "trivial", 0, 0, UNTESTED, false, NULL},
    {"a b c d e f g h", SIX " + g'^2/2 + h'^2/2 - a^2 - b^2 - 2*c^2 - 2*d^2 - 3*e^2 - 3*f^2 - 4*g^2 - 4*h^2", NULL, "SO(2)^4", 4, 4, UNTESTED, false, NULL},
    {"x y u w p q r s", FOUR_BODIES, NULL, "SE(2) x SO(2)", 4, 4, UNTESTED, false, NULL},
    /* circles that are no generator's: modes that turn each for itself at rates in the ratio of the golden section, .. */
    {"a b c d e", RING5, NULL, "SO(2)^2 x R", 3, 3, UNTESTED, false, NULL},
    {"a b c d e", RING5 " - (a^2 + b^2 + c^2 + d^2 + e^2)/7", NULL, "SO(2)^2", 2, 2, UNTESTED, false, NULL},
    {"a b c d", "(a'^2 + b'^2 + c'^2 + d'^2)/2 - ((a - b)^2 + (b - c)^2 + (c - d)^2 + (d - a)^2)/2", NULL, "SO(2) x R", 2, 2, UNTESTED, false, NULL},
    {"x y u w", POINT2 " + (u'^2 + w'^2)/2 - (x + u)^2 - (y + w)^2 - 3*(x - u)^2 - 3*(y - w)^2", NULL, "SO(2)^2", 2, 2, UNTESTED, false, NULL},
    {"x y u w", POINT2 " + (u'^2 + w'^2)/2 - (x + u)^2 - (y + w)^2", NULL, "SE(2) x SO(2)", 4, 4, UNTESTED, false, NULL},
    {"x y z", POINT3 " - (x^2 + y^2)/2", NULL, "SO(2) x R", 2, 2, UNTESTED, false, NULL},
    {"x y z", POINT3 " - (x - z)^2 - (y - 2*z)^2", NULL, "R", 1, 1, UNTESTED, false, NULL},
    /* tops, arms, wheels, and spaces of the literature */
    {"p:angle h:angle s:angle", TOP("1", "2") " - cos(h)", UPRIGHT, "SO(2)^2", 2, 2, UNTESTED, false, NULL},
    {"p:angle h:angle s:angle", TOP("1", "2") " - 1e-9*cos(h)", UPRIGHT, "SO(2)^2", 2, 2, UNTESTED, false, NULL},
    {"p:angle h:angle s:angle", TOP("1", "2"), UPRIGHT, "SO(3) x SO(2)", 4, 4, UNTESTED, false, NULL},
    {"p:angle h:angle s:angle", TOP("1", "(1 + 1e-9)"), UPRIGHT, "SO(3) x SO(2)", 4, 4, UNTESTED, false, NULL},
    {"p:angle h:angle s:angle", TOP("1", "1"), UPRIGHT, "SO(3)^2", 6, 6, UNTESTED, false, NULL},
    {"a:angle b:angle", "a'^2 + b'^2/2 + a'*b'*cos(a - b)", NULL, "SO(2)", 1, 1, UNTESTED, false, NULL},
    {"a:angle b:angle", "a'^2 + b'^2/2 + a'*b'*cos(a - b) + 1e-10*cos(a)", NULL, "trivial", 0, 0, UNTESTED, false, NULL},
    {"x a:angle", "x'^2 + a'^2/2 + x'*a'*cos(a) - cos(a)", NULL, "R", 1, 1, UNTESTED, false, NULL},
    {"x y z", "(x'^2 + y'^2 + (z' + (x*y' - y*x')/2)^2)/2", NULL, "(Heisenberg x| SO(2))", 4, 4, UNTESTED, false, NULL},
    {"x y h:angle s:angle", POINT2 " + h'^2/4 + s'^2/3", "constraints: [\"x' = s'*cos(h)\", \"y' = s'*sin(h)\"]", "SE(2) x SO(2)", 4, 4, A_MEASURE, false, NULL},
    {"x y z", POINT3, "constraints: [\"z' = x*y' - y*x'\"]", "SO(2) x R", 2, 2, A_MEASURE, false, NULL},
    {"s r f:angle", "(r'^2/(1 - 2/r) - (1 - 2/r)*s'^2 + r^2*f'^2)/2", "domain: {r: [3, 6]}", "SO(2) x R", 2, 2, UNTESTED, false, NULL},
    /* slices at poles of the coordinates */
    {"a:angle b:angle", SPHERE, "domain: {a: [0.4, 2.6]}", "SO(2)", 1, 1, UNTESTED, false, "a=cos(b), b=-cos(a)*sin(b)/sin(a)"},
    {"a:angle b:angle", SPHERE, "domain: {a: [0.4, 2.6]}", "SO(2)", 1, 1, UNTESTED, false, "a=sin(b), b=cos(a)*cos(b)/sin(a)"},
    {"a:angle b:angle z", SPHERE " + z'^2/2 - z^2*cos(z)", "domain: {a: [0.4, 2.6]}", "SO(2)", 1, 1, UNTESTED, false, "a=cos(b), b=-cos(a)*sin(b)/sin(a)"},
    {"r f:angle", "(r'^2 + r^2*f'^2)/2", "domain: {r: [0.6, 2]}", "R", 1, 1, UNTESTED, false, "r=cos(f), f=-sin(f)/r"},
    {"r f:angle", "(r'^2 + sinh(r)^2*f'^2)/2", "domain: {r: [0.4, 1.2]}", "R", 1, 1, UNTESTED, false, "r=cos(f), f=-cosh(r)*sin(f)/sinh(r)"},
    {"a:angle b:angle z", "(a'^2 + sin(a)^2*b'^2)/2 + z'^2/2", "domain: {a: [0.4, 2.6]}\nconstraints: [\"z' = cos(a)*b'\"]", "SO(2) x R", 2, 2, A_MEASURE, false, NULL},
};

static char *file_of(const known *k)
{
    char *text = malloc(4000), *at = text, names[200], *save = NULL;
    strcpy(names, k->coordinates);
    at += sprintf(at, "name: known\ncoordinates:\n");
    for (char *word = strtok_r(names, " ", &save); word; word = strtok_r(NULL, " ", &save)) {
        char *type = strchr(word, ':');
        if (type) *type++ = 0;
        at += sprintf(at, "  - {name: %s, type: %s}\n", word, type ? type : "number");
    }
    sprintf(at, "lagrangian: \"%s\"\n%s\n", k->lagrangian, k->rest ? k->rest : "");
    return text;
}

static nh_reduction *reduced(const known *k)
{
    char path[SCRATCH], *text = file_of(k);
    nh_error error = {0};
    cr_assert(scratch_text(path, text));
    nh_request q = {.system_path = path, .weak = k->weak, .group = k->fields};
    nh_options_default(&q.options);
    nh_reduction *r = nh_reduction_create(&q, &error);
    must(r != NULL, &error, text);
    remove(path);
    free(text);
    return r;
}

static void check(size_t i)
{
    const known *k = &table[i];
    char *text = file_of(k);
    nh_reduction *r = reduced(k);
    const nh_group *g = r->all ? r->all : r->group;
    cr_expect_str_eq(g->name, k->group, "%zu: the group is %s\n%s", i, g->name, text);
    cr_expect_eq(g->action.d + g->missing, k->dimension, "%zu: dimension %zu\n%s", i, g->action.d + g->missing, text);
    cr_expect_eq(g->action.d, k->closed, "%zu: %zu closed forms\n%s", i, g->action.d, text);
    cr_expect(!g->jets || g->jets->exact, "%zu: counted by numbers\n%s", i, text);
    if (k->measure != UNTESTED) {
        cr_assert(r->stages && r->stage[0].measure.tested, "%zu: no measure was sought\n%s", i, text);
        cr_expect(r->stage[0].measure.exact && r->stage[0].measure.measure == (k->measure == A_MEASURE), "%zu: measure %d\n%s", i, r->stage[0].measure.measure, text);
    }
    for (size_t s = 0; s < r->stages; s++)
        cr_expect(r->stage[s].printed_states && r->stage[s].printed < 1e-8, "%zu, stage %zu: as printed %g at %zu states\n%s", i, s + 1, r->stage[s].printed, r->stage[s].printed_states, text);
    if (k->fields) cr_expect(r->stages > 0, "%zu: no stage\n%s", i, text);
    nh_reduction_free(r);
    free(text);
}

/* Subgroups that act freely are sought among all combinations of the generators, not only among these: of the whole
 * group, of the second stage, and on level sets of the momentum. */
Test(reduce_table, a_free_subgroup_of_combinations)
{
    static const struct {
        known system;
        const char *group[3]; /* of each stage */
    } known_ones[] = {
        {{"r f:angle", "(r'^2 + sinh(r)^2*f'^2)/2", "domain: {r: [0.4, 1.2]}", "", 0, 0, UNTESTED, false, NULL}, {"Aff(1)", "Aff(1)"}},
        {{"a:angle b:angle c:angle", "(a'^2 + sin(a)^2*b'^2 + cos(a)^2*c'^2)/2", "domain: {a: [0.4, 1.2]}", "", 0, 0, UNTESTED, false, NULL}, {"SO(3)", "SO(3)"}},
        {{"x y", "2*(x'^2 + y'^2)/(1 - x^2 - y^2)^2", "domain: {x: [-0.5, 0.5], y: [-0.5, 0.5]}", "", 0, 0, UNTESTED, false, NULL}, {"Aff(1)", "Aff(1)"}},
        {{"a:angle b:angle c:angle z", "(a'^2 + sin(a)^2*b'^2 + cos(a)^2*c'^2)/2 + z'^2/2", "domain: {a: [0.4, 1.2]}\nconstraints: [\"z' = 0\"]", "", 0, 0, UNTESTED, false, NULL}, {"R", "SO(3)", "SO(3) x R"}},
        {{"r f:angle z", "(r'^2 + sinh(r)^2*f'^2)/2 + z'^2/2", "domain: {r: [0.4, 1.2]}\nconstraints: [\"z' = 0\"]", "", 0, 0, UNTESTED, false, NULL}, {"R", "Aff(1)", "Aff(1) x R"}},
        {{"r f:angle z", "(r'^2 + sinh(r)^2*f'^2)/2 + z'^2/2 - z^2", "domain: {r: [0.4, 1.2]}", "", 0, 0, UNTESTED, false, NULL}, {"Aff(1)", "Aff(1)"}},
        {{"r f:angle z", "(r'^2 + sinh(r)^2*f'^2)/2 + z'^2/2", "domain: {r: [0.4, 1.2]}", "", 0, 0, UNTESTED, false, NULL}, {"Aff(1) x R", "Aff(1) x R"}},
    };
    for (size_t i = 0; i < sizeof known_ones / sizeof *known_ones; i++) {
        if (!sweep_tries(i, 2, 7)) continue;
        nh_reduction *r = reduced(&known_ones[i].system);
        for (size_t k = 0; k < r->stages; k++) {
            cr_expect_str_eq(r->stage[k].group, known_ones[i].group[k], "%zu, stage %zu: %s", i, k + 1, r->stage[k].group);
            cr_expect(r->stage[k].printed < 1e-8, "%zu, stage %zu: as printed %g", i, k + 1, r->stage[k].printed);
        }
        cr_assert(r->stages >= 2 && (r->stages == 3 || !known_ones[i].group[2]), "%zu: %zu stages", i, r->stages);
        nh_reduction_free(r);
    }
}

/* A force along a field, however small, conserves no momentum of it: condition (ii) of a second stage, and momenta of
 * systems that are reduced directly. */
Test(reduce_table, small_forces_conserve_nothing)
{
    static const struct {
        known system;
        size_t stages, momenta;
    } known_ones[] = { /* y' is conserved where d/dy lies in D: the reaction has no part along it */
        {{"x y z u", POINT3 " + u'^2/2", "constraints: [\"z' = y*x' + y^2*u'\"]", "", 0, 0, UNTESTED, false, NULL}, 2, 1},
        {{"x y z u", POINT3 " + u'^2/2", "constraints: [\"z' = y*x' + 1e-9*y^2*u'\"]", "", 0, 0, UNTESTED, false, NULL}, 2, 1},
        {{"x y z u", POINT3 " + u'^2/2", "constraints: [\"z' = y*x' + 1e-12*y^2*u'\"]", "", 0, 0, UNTESTED, false, NULL}, 2, 1},
        /* here that of d/du - d/dx/10^9 is conserved */
        {{"x y z u", POINT3 " + u'^2/2", "constraints: [\"z' = y*x' + 1e-9*y*u'\"]", "", 0, 0, UNTESTED, false, NULL}, 3, 2},
        {{"x y z u", POINT3 " + u'^2/2", "constraints: [\"z' = y*x'\"]", "", 0, 0, UNTESTED, false, NULL}, 3, 2},
        {{"x y", POINT2 " + (x'^2 + y'^2)^2/9", "forces: [\"x = -x'/5\"]", "", 0, 0, UNTESTED, false, NULL}, 1, 1},
        {{"x y", POINT2 " + (x'^2 + y'^2)^2/9", "forces: [\"x = -1e-9*x'\"]", "", 0, 0, UNTESTED, false, NULL}, 1, 1},
        {{"x y", POINT2 " + (x'^2 + y'^2)^2/9", "forces: [\"x = -1e-9*x'\", \"y = -1e-9*y'*cos(t)\"]", "", 0, 0, UNTESTED, false, NULL}, 1, 0},
    };
    for (size_t i = 0; i < sizeof known_ones / sizeof *known_ones; i++) {
        nh_reduction *r = reduced(&known_ones[i].system);
        cr_expect_eq(r->stages, known_ones[i].stages, "%zu: %zu stages", i, r->stages);
        cr_expect_eq(r->momenta.count, known_ones[i].momenta, "%zu: %zu momenta", i, r->momenta.count);
        nh_reduction_free(r);
    }
}

/* The part of a local group that is single-valued on all angles: translations of an angle, not turns that mix it with others. */
Test(reduce_table, what_is_single_valued)
{
    static const struct {
        known system;
        const char *global;
    } known_ones[] = {
        {{"a:angle b:angle", "(a'^2 + b'^2)/2", NULL, "", 0, 0, UNTESTED, false, NULL}, "SO(2)^2"},
        {{"x f:angle", "(x'^2 + f'^2)/2", NULL, "", 0, 0, UNTESTED, false, NULL}, "SO(2) x R"},
        {{"x y f:angle", POINT2 " + f'^2/2", NULL, "", 0, 0, UNTESTED, false, NULL}, "SE(2) x SO(2)"},
        {{"r f:angle", "(r'^2 + r^2*f'^2/4)/2", "domain: {r: [1, 2]}", "", 0, 0, UNTESTED, false, NULL}, "SO(2)"},
        {{"r f:angle", "(r'^2 + r^2*f'^2)/2", "domain: {r: [1, 2]}", "", 0, 0, UNTESTED, false, NULL}, NULL},
    };
    for (size_t i = 0; i < sizeof known_ones / sizeof *known_ones; i++) {
        nh_reduction *r = reduced(&known_ones[i].system);
        const nh_group *g = r->all ? r->all : r->group;
        cr_expect(known_ones[i].global ? g->local && g->global_name && !strcmp(g->global_name, known_ones[i].global) : !g->local, "%zu: %s", i, g->global_name ? g->global_name : "none");
        nh_reduction_free(r);
    }
}

/* What is the momentum of a symmetry is called that, and what others and constraints determine is not listed: a group
 * that is a part of the whole, generators whose fields are dependent on leaves, symmetries along which reactions do no
 * work. */
Test(reduce_table, momenta_of_symmetries_are_no_gauge_momenta)
{
    static const struct {
        known system;
        size_t horizontal, gauge, others;
    } known_ones[] = {
        {{"x y", POINT2, NULL, "", 0, 0, UNTESTED, false, "x=1; y=1"}, 3, 0, 0},
        {{"x y u w", POINT2 " + u'^2 + w'^2 - " PAIR("x", "y", "u", "w"), NULL, "", 0, 0, UNTESTED, false, "x=1, u=1; y=1, w=1; x=-y, y=x, u=-w, w=u"}, 4, 0, 0},
        {{"x y z", POINT3, "constraints: [\"z' = x'\"]", "", 0, 0, UNTESTED, false, NULL}, 3, 0, 0},
        {{"x y z", POINT3, "constraints: [\"z' = 2*x' - y'\"]", "", 0, 0, UNTESTED, false, NULL}, 3, 0, 0},
        {{"x y z", POINT3, "constraints: [\"x*x' + y*y' + z*z' = 0\"]\ndomain: {x: [1, 2], y: [1, 2], z: [1, 2]}", "", 0, 0, UNTESTED, false, NULL}, 3, 0, 0},
        /* a wheel: its spin is the momentum of d/ds; the angular momentum of its heading is one of a field with x, y */
        {{"x y h:angle s:angle", POINT2 " + h'^2/4 + s'^2/3", "constraints: [\"x' = s'*cos(h)\", \"y' = s'*sin(h)\"]", "", 0, 0, UNTESTED, false, NULL}, 0, 1, 1},
        {{"x y h:angle", POINT2 " + h'^2/4", "constraints: [\"y'*cos(h) = x'*sin(h)\"]", "", 0, 0, UNTESTED, false, NULL}, 0, 2, 0},
    };
    for (size_t i = 0; i < sizeof known_ones / sizeof *known_ones; i++) {
        nh_reduction *r = reduced(&known_ones[i].system);
        size_t horizontal = 0, gauge = 0, others = 0;
        for (size_t j = 0; j < r->momenta.count; j++) {
            const nh_momentum *p = &r->momenta.momentum[j];
            horizontal += p->horizontal;
            gauge += p->gauge;
            others += !p->horizontal && !p->gauge;
            cr_expect(p->proof.proved, "%zu: momentum %zu is not proved", i, j);
        }
        cr_expect(horizontal == known_ones[i].horizontal && gauge == known_ones[i].gauge && others == known_ones[i].others,
                  "%zu: %zu horizontal, %zu gauge, %zu others", i, horizontal, gauge, others);
        nh_reduction_free(r);
    }
}

/* With NHSYM_SWEEPS=all the whole table; else one system in three, under sanitizers one in fifteen. */
Test(reduce_table, groups_forms_and_measures_are_the_known_ones)
{
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        if (sweep_tries(i, 3, 15)) check(i);
}
