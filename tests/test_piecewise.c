/* Piecewise systems: what is FOUND stays constant along motions that cross the kinks, what only holds in parts of the motions is told apart, with the part,
 * and the true continuous currents are found. */
#include <criterion/criterion.h>

#include <unistd.h>

#include "catalogue.h"
#include "document/analysis.h"
#include "document/facts.h"
#include "graph/diff.h"
#include "graph/print.h"
#include "integrals/prove.h"
#include "integrals/region.h"
#include "scratch.h"
#include "search/explicit_motion.h"
#include "commands/verify.h"
#include "graph/dag.h"
#include "system/sample.h"
#include "sweep.h"

typedef struct {
    const char *name, *text;
    size_t independent; /* how many there are to be found, and no more */
    const char *region; /* a piece that holds here is listed; NULL: none is looked for */
} piecewise;

static const piecewise PIECEWISE[] = {
    {"a wall of velocities to which both sides lead",
     "parameters: [{name: a, value: 0.5}]\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - a*abs(x'*y - y'*x)\n"
     "known: {currents: [{name: energy, expr: x'^2 + y'^2}]}\n",
     1, "on each side of y*x' - x*y' = 0, where it jumps"},
    {"|x|", "coordinates: [{name: x, type: length}]\nlagrangian: x'^2/2 - abs(x)\nknown: {currents: [{name: energy, expr: x'^2/2 + abs(x)}]}\n", 1, NULL},
    {"root of a square of a difference",
     "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - sqrt((x - y)^2)\n"
     "known: {currents: [{name: momentum, expr: x' + y'}, {name: centre, expr: x + y - t*(x' + y')}, {name: energy, expr: (x'^2 + y'^2)/2 + abs(x - y)}]}\n",
     3, "on each side of x - y = 0, where it jumps"},
    {"the same, multiplied out",
     "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - sqrt(x^2 - 2*x*y + y^2)\n"
     "known: {currents: [{name: momentum, expr: x' + y'}, {name: centre, expr: x + y - t*(x' + y')}]}\n",
     3, "on each side of x - y = 0, where it jumps"},
    {"|t - 2|, a kink beyond the default interval",
     "coordinates: [x]\nlagrangian: x'^2/2 - x*abs(t - 2)\n"
     "known: {currents: [{name: momentum, expr: x' + (t - 2)*abs(t - 2)/2}, {name: start, expr: x - (t - 2)*x' - abs(t - 2)^3/3}]}\n",
     2, NULL},
    {"root of a square of t",
     "parameters: [{name: c, value: 1.3}]\ncoordinates: [x]\nlagrangian: x'^2/2 - x*sqrt((t - c)^2)\n"
     "known: {currents: [{name: momentum, expr: x' + (t - c)*abs(t - c)/2}]}\n",
     2, NULL},
    {"a force that changes its sign at t = 0",
     "coordinates: [x]\nlagrangian: x'^2/2 - x*sign(t)\n"
     "known: {currents: [{name: momentum, expr: x' + abs(t)}, {name: start, expr: x - t*x' - t*abs(t)/2}]}\n",
     2, NULL},
    {"the polar angle as potential: its cut",
     "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - atan2(y, x)\nknown: {currents: [{name: turning, expr: \"x*y' - y*x' + t\"}]}\n",
     1, "on each side of y = 0, where it jumps"},
    {"a saw tooth",
     "coordinates: [{name: x, type: length}]\nlagrangian: x'^2/2 - atan(tan(x))\nknown: {currents: [{name: momentum, expr: x' + t}, {name: place, expr: x + x'^2/2}]}\n",
     2, NULL},
    {"a triangle wave", "coordinates: [{name: x, type: length}]\nlagrangian: x'^2/2 - acos(cos(x))\nknown: {currents: [{name: energy, expr: x'^2/2 + acos(cos(x))}]}\n", 1, NULL},
    {"two kinks",
     "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - abs(x) - abs(y)\n"
     "known: {currents: [{name: one, expr: x'^2/2 + abs(x)}, {name: other, expr: y'^2/2 + abs(y)}]}\n",
     2, "on each side of y = 0, where it jumps"},
    {"one kink",
     "coordinates: [x]\nlagrangian: x'^2/2 - abs(x)\nknown: {currents: [{name: energy, expr: x'^2/2 + abs(x)}]}\n", 1, "on each side of x = 0, where it jumps"},
    {"two slanted kinks",
     "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - abs(x - y) - abs(x + y)\n"
     "known: {currents: [{name: one, expr: (x' + y')^2/4 + abs(x + y)}, {name: other, expr: (x' - y')^2/4 + abs(x - y)}]}\n",
     2, NULL},
    {"|sin t|: no elementary integral is continuous", "coordinates: [x]\nlagrangian: x'^2/2 - x*abs(sin(t))\n", 0, "on each side of sin(t) = 0, where it jumps"},
    {"|x'|: an invariant wall, which is not crossed",
     "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + abs(x') - y\n"
     "known: {currents: [{name: momentum, expr: x' + sign(x')}, {name: fall, expr: y' + t}]}\n",
     4, NULL},
    {"a magnetic field that changes its sign",
     "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + abs(x)*y'\nknown: {currents: [{name: momentum, expr: y' + abs(x)}, {name: energy, expr: x'^2 + y'^2}]}\n", 2, NULL},
    {"a constraint with a kink",
     "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\nconstraints: [\"y' = abs(x)*x'\"]\nknown: {currents: [{name: hidden, expr: y - x*abs(x)/2}, {name: speed, expr: x'^2 + y'^2}]}\n", 3, NULL},
    {"a Lagrangian that jumps, by a derivative in time and a kink",
     "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + x'*y*sign(x)\nknown: {currents: [{name: momentum, expr: y' - abs(x)}, {name: energy, expr: x'^2 + y'^2}]}\n", 2,
     "on each side of x = 0, where it jumps"},
    {"a force that turns with the side",
     "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\nforces: [\"x = y'*sign(x)\", \"y = -x'*sign(x)\"]\nknown: {currents: [{name: momentum, expr: y' + abs(x)}]}\n", 2,
     "on each side of x = 0, where it jumps"},
    {"a step that the sampling box does not see: y'*(step - pi) is constant in two of the cells",
     "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (x/2 - atan(tan(x/2)))*y\nknown: {currents: [{name: momentum, expr: x'}, {name: place, expr: x - t*x'}]}\n", 2,
     "on each side of cos(x/2) = 0, where it jumps"},
    {"steps in time",
     "coordinates: [x]\nlagrangian: x'^2/2 - x*(t - atan(tan(pi*t))/pi)\n", 0, "on each side of cos(pi*t) = 0, where it jumps"},
    {"the domain knows one side only",
     "coordinates: [{name: x, type: length}]\nlagrangian: x'^2/2 - abs(x)\ndomain: {x: [0.5, 2]}\nknown: {currents: [{name: energy, expr: x'^2/2 + abs(x)}]}\n", 1, "for x > 0"},
};
enum { COUNT = sizeof PIECEWISE / sizeof *PIECEWISE };

static nh_analysis *analysed(const char *text)
{
    char path[SCRATCH];
    nh_error error = {0};
    FILE *out = scratch_open(path);
    cr_assert_not_null(out);
    fprintf(out, "name: piecewise\n%s", text);
    fclose(out);
    nh_request q = {.system_path = path, .seed_given = true};
    nh_options_default(&q.options);
    q.options.max_seconds = 1e6; /* the same on every machine */
    nh_analysis *r = nh_analysis_create(&q, &error);
    remove(path);
    cr_assert_not_null(r, "%s", error.what);
    return r;
}

/* ---- along motions of its own: Runge and Kutta with steps that no kink can hide between ---- */

enum { STEPS = 16000, STATES = 12 };
static const double LENGTH = 8;

static void advance(const nh_tape *tape, nh_tape_work *work, size_t n, double *z, double h)
{
    double k[4][16], at[16];
    for (int stage = 0; stage < 4; stage++) {
        double part = stage == 0 ? 0 : stage == 3 ? h : h / 2;
        for (size_t j = 0; j < n; j++) at[j] = z[j] + (stage ? part * k[stage - 1][j] : 0);
        k[stage][0] = 1; /* t */
        nh_tape_eval(tape, work, at, k[stage] + 1);
    }
    for (size_t j = 0; j < n; j++) z[j] += h / 6 * (k[0][j] + 2 * k[1][j] + 2 * k[2][j] + k[3][j]);
}

/* The largest change of phi along motions from several states of a box around zero, relative to 1 + |phi|. */
static double largest_change(const nh_model *o, nh_ex phi)
{
    size_t n = 1 + o->m + o->n;
    nh_ex rate[16];
    double z[16], worst = 0;
    uint64_t seed = 5;
    for (size_t j = 0; j + 1 < n; j++) rate[j] = j < o->m ? o->rho[j] : o->a[j - o->m];
    nh_tape *motion = nh_model_tape(o, n - 1, rate), *value = nh_model_tape(o, 1, &phi);
    nh_tape_work *motion_work = nh_tape_work_create(motion), *value_work = nh_tape_work_create(value);
    for (int k = 0; k < STATES; k++) {
        double first, now;
        z[0] = -1;
        for (size_t j = 1; j < n; j++) z[j] = 3 * nh_random(&seed) - 1.5;
        nh_tape_eval(value, value_work, z, &first);
        for (int i = 0; i < STEPS; i++) {
            advance(motion, motion_work, n, z, LENGTH / STEPS);
            nh_tape_eval(value, value_work, z, &now);
            if (isfinite(now) && isfinite(first)) worst = fmax(worst, fabs(now - first) / (1 + fabs(first)));
        }
    }
    nh_tape_work_free(motion_work);
    nh_tape_work_free(value_work);
    nh_tape_free(motion);
    nh_tape_free(value);
    return worst;
}

Test(piecewise, currents_are_continuous_along_motions, PLAIN_ONLY)
{
    for (size_t i = 0; i < COUNT; i++) {
        if (!sweep_tries(i, 9, 18)) continue;
        const piecewise *p = &PIECEWISE[i];
        nh_analysis *r = analysed(p->text);
        row o = {.rate = -INFINITY};
        compare(r, &o);
        cr_expect_eq(o.missing + o.wrong, 0, "%s: %s", p->name, o.names);
        cr_expect_eq(r->list->independent, p->independent, "%s: %zu independent", p->name, r->list->independent);
        cr_expect_eq(r->verdict, p->independent ? NH_FOUND : NH_UNDECIDED, "%s", p->name);
        for (size_t k = 0; k < r->list->count; k++) {
            double change = largest_change(r->question->model, r->list->found[k].phi);
            cr_expect(change < 5e-3, "%s: %s changes by %.1e", p->name, r->list->found[k].name, change);
        }
        bool listed = !p->region;
        for (size_t k = 0; k < r->list->pieces; k++) {
            double change = largest_change(r->question->model, r->list->piece[k].phi);
            listed |= p->region && !strcmp(p->region, r->list->piece[k].region);
            cr_expect(change > 0.02, "%s: the piece %s, %s, changes by %.1e only", p->name, r->list->piece[k].name, r->list->piece[k].region, change);
        }
        cr_expect(listed, "%s: nothing holds %s", p->name, p->region);
        for (size_t j = 0; r->motion && j < r->motion->constants && !r->motion->region; j++) {
            double change = r->motion->constant[j].at_start ? 0 : largest_change(r->question->model, r->motion->constant[j].value);
            cr_expect(change < 5e-3, "%s: constant %zu of the explicit motion changes by %.1e", p->name, j + 1, change);
        }
        nh_analysis_free(r);
    }
}

/* ---- where the chart's velocities end ---- */

/* x'^2 + y'^2 + z'^2 = 2 T under constraints f = 0, in all velocities: v' = g - F^T (F F^T)^-1 (df/dt + df/dq v + F g) with F = df/dv, g = -dU/dq. */
typedef struct {
    size_t m;
    nh_tape *tape; /* F (m), df/dt + df/dq v, g (m), f as functions of (t, q, v) */
    nh_tape_work *work;
    nh_ex in[16];
} bound_motion;

static bound_motion bound_motion_make(const nh_model *o)
{
    const nh_system *s = o->system;
    nh_dag *d = o->dag;
    nh_ex out[16], still[16], f = nh_sub(d, s->constraint[0].lhs, s->constraint[0].rhs), rate;
    bound_motion b = {.m = s->coordinates};
    b.in[0] = s->t;
    for (size_t i = 0; i < b.m; i++) b.in[1 + i] = s->coordinate[i].q, b.in[1 + b.m + i] = s->coordinate[i].v, still[i] = nh_int(d, 0);
    nh_ex U = nh_neg(d, nh_substitute(d, s->lagrangian, b.m, b.in + 1 + b.m, still));
    rate = nh_diff(d, f, s->t);
    for (size_t i = 0; i < b.m; i++) {
        out[i] = nh_diff(d, f, b.in[1 + b.m + i]);
        rate = nh_add(d, rate, nh_mul(d, nh_diff(d, f, b.in[1 + i]), b.in[1 + b.m + i]));
        out[b.m + 1 + i] = nh_neg(d, nh_diff(d, U, b.in[1 + i]));
    }
    out[b.m] = rate;
    out[2 * b.m + 1] = f;
    b.tape = nh_tape_create(d, 1 + 2 * b.m, b.in, 2 * b.m + 2, out, s->parameters, o->parameter, o->parameter_value);
    b.work = nh_tape_work_create(b.tape);
    return b;
}

static void bound_rate(const bound_motion *b, const double *z, double *rate)
{
    double out[16], FF = 0, right;
    size_t m = b->m;
    nh_tape_eval(b->tape, b->work, z, out);
    right = out[m];
    for (size_t i = 0; i < m; i++) FF += out[i] * out[i], right += out[i] * out[m + 1 + i];
    rate[0] = 1;
    for (size_t i = 0; i < m; i++) rate[1 + i] = z[1 + m + i], rate[1 + m + i] = out[m + 1 + i] - out[i] * right / FF;
}

static double change_under_constraint(const nh_model *o, nh_ex in_velocities)
{
    enum { steps = 4000, starts = 6 };
    bound_motion b = bound_motion_make(o);
    size_t width = 1 + 2 * b.m;
    double z[16], at[16], k[4][16], worst = 0, first, now;
    uint64_t seed = 5;
    nh_tape *value = nh_tape_create(o->dag, width, b.in, 1, &in_velocities, o->system->parameters, o->parameter, o->parameter_value);
    nh_tape_work *work = nh_tape_work_create(value);
    for (int start = 0; start < starts; start++) {
        for (size_t j = 0; j < width; j++) z[j] = j ? 3 * nh_random(&seed) - 1.5 : -1;
        for (int newton = 0; newton < 20; newton++) { /* onto the constraint */
            double out[16], FF = 0;
            nh_tape_eval(b.tape, b.work, z, out);
            for (size_t i = 0; i < b.m; i++) FF += out[i] * out[i];
            for (size_t i = 0; i < b.m; i++) z[1 + b.m + i] -= out[i] * out[2 * b.m + 1] / FF;
        }
        nh_tape_eval(value, work, z, &first);
        for (int i = 0; i < steps; i++) {
            double h = 4.0 / steps;
            for (int stage = 0; stage < 4; stage++) {
                double part = stage == 0 ? 0 : stage == 3 ? h : h / 2;
                for (size_t j = 0; j < width; j++) at[j] = z[j] + (stage ? part * k[stage - 1][j] : 0);
                bound_rate(&b, at, k[stage]);
            }
            for (size_t j = 0; j < width; j++) z[j] += h / 6 * (k[0][j] + 2 * k[1][j] + 2 * k[2][j] + k[3][j]);
            nh_tape_eval(value, work, z, &now);
            if (isfinite(now) && isfinite(first)) worst = fmax(worst, fabs(now - first) / (1 + fabs(first)));
        }
    }
    nh_tape_work_free(work);
    nh_tape_free(value);
    nh_tape_work_free(b.work);
    nh_tape_free(b.tape);
    return worst;
}

/* x' = x z'/y: at y = 0 the chart ends, and motions go through. sqrt(x^2/y^2 + 1) z' changes its sign there, sqrt(x^2 + y^2) z'/y does not. */
Test(piecewise, motions_go_through_where_the_chart_ends, WHOLE_ONLY)
{
    static const struct {
        const char *text, *smooth; /* a current that has to be listed */
    } of[] = {
        {"lagrangian: (x'^2+y'^2+z'^2)/2\nconstraints: [\"x*z' = y*x'\"]\n", "z'*sqrt(x^2 + y^2)/y"},
        {"lagrangian: (x'^2+y'^2+z'^2)/2 - y\nconstraints: [\"(y-1)*z' = (x+y)*x'\"]\n", "z'*sqrt(x^2 + 2*y*(x + y - 1) + 1)/(x + y)"},
        {"lagrangian: (x'^2+y'^2+z'^2)/2\nconstraints: [\"t*z' = x*x'\"]\n", "z'*sqrt(t^2 + x^2)/x"},
        {"lagrangian: (x'^2+y'^2+z'^2)/2\nconstraints: [\"x*z' = y*x' + y\"]\n", "z'*sqrt(x^2 + y^2)/y"},
        {"lagrangian: (x'^2+y'^2+z'^2)/2 + y^2/2\nconstraints: [\"x*z' = y*x'\"]\n", "z'*sqrt(y^2 + x^2)/y"},
    };
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        if (!sweep_tries(i, 2, 5)) continue;
        char text[300];
        bool listed = false;
        snprintf(text, sizeof text, "coordinates: [x, y, z]\n%s", of[i].text);
        nh_analysis *r = analysed(text);
        for (size_t k = 0; k < r->list->count + r->list->furthers; k++) {
            const nh_current *f = k < r->list->count ? &r->list->found[k] : &r->list->further[k - r->list->count].current;
            cr_assert(f->has_in_velocities);
            double change = f->region ? 0 : change_under_constraint(r->question->model, f->in_velocities);
            char *printed = nh_print_string(r->question->model->dag, f->in_velocities);
            listed |= !strcmp(printed, of[i].smooth);
            nh_free(printed);
            cr_expect(change < 5e-3, "%s: %s changes by %.1e", of[i].text, f->name, change);
        }
        cr_expect(listed, "%s: %s is not listed", of[i].text, of[i].smooth);
        nh_analysis_free(r);
    }
}

/* At the top z' = 0 the root of z'^2 = v^2 - x'^2 - y'^2 changes its sign: an arctangent with z' below is constant on both branches, and jumps. */
Test(piecewise, motions_pass_from_branch_to_branch, PLAIN_ONLY)
{
    static const char projectile[] =
        "parameters: [{name: m, value: 1}, {name: v, value: 1.5}, {name: g, value: 2}]\n"
        "coordinates: [x, y, z]\nlagrangian: m/2*(x'^2+y'^2+z'^2) - m*g*z\nconstraints: [\"x'^2+y'^2+z'^2 = v^2\"]\n";
    static const struct {
        const char *current;
        bool conserved;
    } asked[] = {{"v^2*x'*atan(sqrt(x'^2+y'^2)/z')/sqrt(x'^2+y'^2) - g*x", false}, {"v^2*x'*atan(z'/sqrt(x'^2+y'^2))/sqrt(x'^2+y'^2) + g*x", true}};
    nh_analysis *r = analysed(projectile);
    size_t independent = 0;
    for (size_t k = 0; k < r->list->count; k++) {
        const nh_current *f = &r->list->found[k];
        cr_assert(f->has_in_velocities);
        independent += f->independence == NH_INDEPENDENT;
        double change = change_under_constraint(r->question->model, f->in_velocities);
        cr_expect_lt(change, 1e-7, "%s changes by %.1e", f->name, change);
        cr_expect(f->on_both, "%s", f->name);
    }
    cr_expect_eq(independent, 5);
    nh_analysis_free(r);
    for (size_t i = 0; i < 2; i++) {
        nh_error error = {0};
        nh_options options;
        nh_options_default(&options);
        char text[400];
        snprintf(text, sizeof text, "name: projectile\n%s", projectile);
        nh_verification *v = nh_verification_of_current(nh_system_parse("projectile.yaml", text, 0, NULL, &error), NH_CHART_AUTO, asked[i].current, &options, &error);
        cr_assert_not_null(v, "%s", error.what);
        cr_expect_eq(v->conserved, asked[i].conserved);
        if (asked[i].conserved) cr_expect_null(v->region);
        else cr_expect_str_eq(v->region, "on each side of z' = 0, where it jumps");
        nh_verification_free(v);
    }
}

/* Where L jumps, or the constraints give other velocities, the equations of motion contain an impulse: velocities that go through unchanged are no
 * motion, and what they conserve is no current.  What is left of L = d/dt (x |x|) and so on is none. */
Test(piecewise, an_impulse_is_no_passage, PLAIN_ONLY)
{
    static const struct {
        const char *text, *region;
    } of[] = {
        {"coordinates: [x, y]\nlagrangian: (1 + sign(x)/2)*(x'^2 + y'^2)/2\n", "on each side of x = 0, where the motion has an impulse"},
        {"coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - sign(x - y)*y'\n", "on each side of x - y = 0, where the motion has an impulse"},
        {"coordinates: [x]\nlagrangian: x'^2/2 - sign(x)\n", "on each side of x = 0, where the motion has an impulse"},
        {"coordinates: [x]\nlagrangian: (2 + sign(t - 2))*x'^2/2\n", "on each side of t = 2, where the motion has an impulse"},
        {"coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\nconstraints: [\"y' = sign(x)*x'\"]\n", "on each side of x = 0, where the motion has an impulse"},
        {"coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + x'*sign(x) + (t*x' + x)*sign(t*x)\n", NULL},
        {"coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + 1e-9*sign(x)*x'\n", NULL},
    };
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        nh_analysis *r = analysed(of[i].text);
        cr_expect_eq(r->list->independent > 0, !of[i].region, "%s: %zu", of[i].text, r->list->independent);
        cr_expect_eq(r->list->pieces > 0, of[i].region != NULL, "%s: %zu", of[i].text, r->list->pieces);
        cr_expect_eq(nh_analysis_to_the_end(r), r->list->pieces, "%s: motions end at the wall", of[i].text);
        cr_expect_eq(r->verdict, NH_FOUND, "%s", of[i].text);
        for (size_t k = 0; k < r->list->pieces; k++) cr_expect(of[i].region && !strcmp(r->list->piece[k].region, of[i].region), "%s: %s", of[i].text, r->list->piece[k].region);
        nh_analysis_free(r);
    }
}

/* P. Winternitz, J. A. Smorodinsky, M. Uhlir and I. Fris, Yad. Fiz. 4 (1966) 625, their fourth potential in Cartesian coordinates: of its integrals one holds
 * everywhere, the other on the side of y = 0 on which sqrt(r + x) sqrt(r - x) is y, or -y. */
Test(piecewise, roots_whose_product_has_none, WHOLE_ONLY)
{
    static const char *const domain[2] = {"[0.4, 1]", "[-1, -0.4]"}, *const region[2] = {"for y > 0", "for y < 0"};
    for (size_t i = 0; i < 2; i++) {
        char text[400];
        snprintf(text, sizeof text,
                 "parameters: {a: 0.4, b: 0.3, c: 0.2}\ncoordinates: [x, y]\ndefinitions: [r = sqrt(x^2 + y^2)]\n"
                 "lagrangian: (x'^2 + y'^2)/2 + a/r - b*sqrt(r + x)/r - c*sqrt(r - x)/r\ndomain: {x: [0.4, 1], y: %s}\n", domain[i]);
        nh_analysis *r = analysed(text);
        size_t proved = 0;
        for (size_t k = 0; k < r->list->count; k++) proved += r->list->found[k].proof.all_parameters && !r->list->found[k].region;
        cr_expect_eq(proved, 2);
        cr_assert_eq(r->list->pieces, 1);
        cr_expect(r->list->piece[0].proof.all_parameters && r->list->piece[0].proof.sided && !strcmp(r->list->piece[0].region, region[i]), "%s", r->list->piece[0].region);
        cr_expect_eq(r->completeness[0].missing_at, 0);
        nh_analysis_free(r);
    }
}

/* Without a kink nothing is cut, and what has poles is no piece. */
Test(piecewise, smooth_and_rational_currents_hold_everywhere)
{
    static const char *const text[] = {
        "name: free\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n",
        "name: kepler\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + 1/sqrt(x^2 + y^2)\n",
    };
    static const char *const current[][3] = {{"y'/x'", "(x*y' - y*x')/x'", "x' + y'*abs(x')"}, {"x*y' - y*x'", "x'^2 + y'^2 - 2/sqrt(x^2 + y^2)", "(x'^2 + y'^2 - 2/sqrt(x^2 + y^2))/(x*y' - y*x')"}};
    for (size_t i = 0; i < 2; i++) {
        nh_error error = {0};
        nh_system *system = nh_system_parse("smooth.yaml", text[i], 0, NULL, &error);
        cr_assert_not_null(system, "%s", error.what);
        nh_model *model = nh_model_create(system, nh_chart_create(system, NH_CHART_AUTO, 1, &error), &error);
        cr_assert_not_null(model, "%s", error.what);
        nh_options options;
        nh_options_default(&options);
        nh_arena *arena = nh_arena_create();
        nh_terrain terrain = nh_terrain_of(model, &options, arena);
        for (size_t k = 0; k < 3; k++) {
            nh_ex e = 0, phi = 0;
            cr_assert(nh_system_expression_text(system, "test", current[i][k], 0, NULL, &e, &error) && nh_analysis_file_to_chart(model, e, &phi, &error), "%s", error.what);
            nh_region region = nh_region_of(model, &terrain, phi, 20, false, &options, arena);
            cr_expect_eq(region.count, 0, "%s: %s", current[i][k], nh_region_text(model->dag, &region, arena));
        }
        nh_arena_free(arena);
        nh_model_free(model);
        nh_system_free(system);
    }
}

/* Geodesics of a sphere of Berger's: t - atan(..)/sqrt(A) is proved for the given a, because its roots have branches; as a sine and a cosine of t sqrt(A), with
 * which it goes on where the arctangent jumps, it is proved for all. */
Test(piecewise, angles_are_proved_for_all_parameters, WHOLE_ONLY)
{
    nh_analysis *r = analysed("parameters: {a: 0.4}\ncoordinates: [{name: p, type: angle}, {name: h, type: angle}, {name: s, type: angle}]\n"
                              "lagrangian: (h'^2 + p'^2*sin(h)^2 + a*(s' + p'*cos(h))^2)/2\ndomain: {h: [0.6, 1.3]}\n");
    cr_expect_eq(r->list->independent, 5);
    for (size_t k = 0; k < r->list->count; k++) cr_expect(r->list->found[k].proof.all_parameters, "%s", r->list->found[k].name);
    nh_analysis_free(r);
}

/* With sign(u) as a parameter the equations have no kink; what is found there holds on each side: drag of the square of the speed, dry friction. */
Test(piecewise, the_sides_of_a_kink_are_searched)
{
    static const struct {
        const char *text;
        size_t independent, pieces;
        const char *known; /* is constant on each side */
    } side[] = {
        {"parameters: {c: 0.3}\ncoordinates: [x]\nlagrangian: x'^2/2 - x^2/2\nforces: [\"x = -c*x'*abs(x')\"]\n", 0, 1,
         "(2*c*(c*x'^2 + x*sign(x')) - 1)*exp(2*c*x*sign(x'))"},
        {"parameters: {c: 0.3, g: 9.8, l: 0.7}\ncoordinates: [{name: a, type: angle}]\nlagrangian: l^2*a'^2/2 + g*l*cos(a)\nforces: [\"a = -c*a'*abs(a')\"]\n", 0, 1,
         "(a'^2/2 - g*(cos(a) - 2*c/l^2*sign(a')*sin(a))/l/(1 + 4*c^2/l^4))*exp(2*c/l^2*a*sign(a'))"},
        {"parameters: {f: 0.3, k: 2}\ncoordinates: [x]\nlagrangian: x'^2/2 - k*x^2/2\nforces: [\"x = -f*sign(x')\"]\n", 0, 2,
         "(k*x + f*sign(x'))*cos(sqrt(k)*t) - sqrt(k)*x'*sin(sqrt(k)*t)"},
        {"parameters: {k: 0.7}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - k*abs(x*y)\n", 1, 1, "x'*y' + k*(x^2 + y^2)*sign(x*y)/2"},
    };
    for (size_t i = 0; i < sizeof side / sizeof *side; i++) {
        if (!sweep_tries(i, 1, 4)) continue;
        nh_analysis *r = analysed(side[i].text);
        nh_error error = {0};
        nh_ex e, phi;
        cr_expect_eq(r->list->independent, side[i].independent, "%zu: %zu", i, r->list->independent);
        nh_text words;
        nh_text_init(&words);
        nh_analysis_answer_headline(r, &words);
        if (!r->list->independent) cr_expect(strstr(nh_text_string(&words), "Nothing was found that is conserved along all motions."), "%s", nh_text_string(&words));
        nh_text_clear(&words);
        cr_assert_eq(r->list->pieces, side[i].pieces, "%zu: %zu pieces", i, r->list->pieces);
        cr_expect(r->completeness[NH_COMPLETE_IN_COORDINATES].degree == 6 && !r->completeness[NH_COMPLETE_IN_COORDINATES].missing_at, "%zu", i);
        for (size_t k = 0; k < r->list->pieces; k++)
            cr_expect(r->list->piece[k].proof.proved && r->list->piece[k].proof.all_parameters, "%s", r->list->piece[k].name);
        cr_assert(nh_system_expression_text(r->question->system, "test", side[i].known, 0, NULL, &e, &error) && nh_analysis_file_to_chart(r->question->model, e, &phi, &error), "%s", error.what);
        cr_expect_geq(nh_prove_digits(r->question->model, phi, &r->question->options), r->question->options.digits, "%s", side[i].known);
        nh_analysis_free(r);
    }
}

Test(piecewise, a_single_current_is_told_its_region)
{
    static const struct {
        const char *lagrangian, *current, *region;
        bool ends; /* there the motion ends */
    } asked[] = {
        {"x'^2/2 - sign(x)", "x'", "on each side of x = 0, where the motion has an impulse", true},
        {"x'^2/2 - sign(x) - abs(x)", "x' + t*sign(x)", "on each side of x = 0, where the motion has an impulse", true},
        {"x'^2/2 - abs(x)", "x'^2/2 + abs(x)", NULL, false},
        {"x'^2/2 - abs(x)", "x' + t*sign(x)", "on each side of x = 0, where it jumps", false},
        {"x'^2/2 - x*abs(t - 2)", "x' + (t - 2)*abs(t - 2)/2", NULL, false},
        {"x'^2/2 - x*abs(t - 2)", "x' + (t - 2)*abs(t - 2)/2 + sign(t - 2)", "on each side of t = 2, where it jumps", false},
        {"x'^2/2 - acos(cos(x))", "x'^2/2 + acos(cos(x))", NULL, false},
        /* x'' = t^2 x: t U(3/4, 3/2, t^2) jumps at t = 0, t M(3/4, 3/2, t^2) does not */
        {"x'^2/2 + t^2*x^2/2", "exp(-t^2/2)*((x - t*(x' + t*x))*hyperu(3/4, 3/2, t^2) + 2*t^2*x*hyperu_prime(3/4, 3/2, t^2))", "on each side of t = 0, where it jumps", false},
        {"x'^2/2 + t^2*x^2/2", "exp(-t^2/2)*((x - t*(x' + t*x))*hyp1f1(3/4, 3/2, t^2) + 2*t^2*x*hyp1f1_prime(3/4, 3/2, t^2))", NULL, false},
    };
    for (size_t i = 0; i < sizeof asked / sizeof *asked; i++) {
        char text[400];
        nh_error error = {0};
        nh_options options;
        nh_options_default(&options);
        snprintf(text, sizeof text, "name: asked\ncoordinates: [{name: x, type: length}]\nlagrangian: %s\n", asked[i].lagrangian);
        nh_verification *v = nh_verification_of_current(nh_system_parse("asked.yaml", text, 0, NULL, &error), NH_CHART_AUTO, asked[i].current, &options, &error);
        cr_assert_not_null(v, "%s: %s", asked[i].current, error.what);
        cr_expect_eq(v->conserved, !asked[i].region || asked[i].ends, "%s", asked[i].current);
        if (asked[i].region) cr_expect_str_eq(v->region, asked[i].region);
        else cr_expect_null(v->region, "%s: %s", asked[i].current, v->region);
        nh_verification_free(v);
    }
}
