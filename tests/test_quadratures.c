/* quadratures: integration of one equation after another completes systems that have no more integrals in an ansatz, and gives their motions as
 * formulas.  Both are compared with motions that this file computes itself, from the equations of motion alone. */
#include "mechanics.h"
#include "scratch.h"

#include <math.h>

#include "commands/analyze.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"
#include "graph/print.h"
#include "integrals/real_where.h"
#include "problem/analysis_file.h"
#include "search/explicit_motion.h"
#include "search/motion_series.h"
#include "sweep.h"

/* ---- asking ---- */

static nh_analysis *ask_file_until(const char *path, double until)
{
    nh_error error = {0};
    nh_request request = {.system_path = path, .until_given = until > 0};
    nh_options_default(&request.options);
    if (until > 0) request.options.until = until;
    nh_analysis *r = nh_analysis_create(&request, &error);
    cr_assert_not_null(r, "%s: %s", path, error.what);
    return r;
}

static nh_analysis *ask_file(const char *path) { return ask_file_until(path, 0); }

static nh_analysis *ask_until(const char *text, double until)
{
    char path[SCRATCH];
    cr_assert(scratch_text(path, text));
    nh_analysis *r = ask_file_until(path, until);
    remove(path);
    return r;
}

static nh_analysis *ask(const char *text) { return ask_until(text, 0); }

/* ---- motions of our own ---- */

enum { most_states = 16, most_letters = 48, most_values = most_states + most_letters, steps = 400 };
static const double step = 2.5e-4;

/* What is integrated: z' = (1, rho, a), and the named integrals J' = integrand s'; and the formulas, in the states and the letters C, R, J. */
typedef struct {
    const nh_explicit_motion *m;
    size_t n, letters;
    nh_tape *rate, *formula, *start; /* rho, a; squares, integrands, states in the letters; constants and roots in the states */
    nh_tape_work *rate_work, *formula_work, *start_work;
    double letter[most_letters], sign[most_letters];
} flow;

static flow flow_of(const nh_analysis *r)
{
    const nh_model *o = r->question->model;
    const nh_explicit_motion *m = r->motion;
    flow f = {.m = m, .n = 1 + o->m + o->n, .letters = m->constants + m->roots + m->integrals};
    nh_ex e[most_values], symbol[most_values];
    size_t count = 0, values = 0;
    for (size_t i = 0; i + 1 < f.n; i++) e[i] = i < o->m ? o->rho[i] : o->a[i - o->m];
    f.rate = nh_model_tape(o, f.n - 1, e);
    for (size_t i = 0; i < m->states; i++) symbol[count++] = m->state[i];
    for (size_t j = 0; j < m->constants; j++) symbol[count++] = m->constant[j].symbol, e[values++] = m->constant[j].value;
    for (size_t j = 0; j < m->roots; j++) symbol[count++] = m->root[j].symbol, e[values++] = m->root[j].value;
    f.start = nh_tape_create(o->dag, count, symbol, values, e, o->system->parameters, o->parameter, o->parameter_value);
    for (size_t j = 0; j < m->integrals; j++) symbol[count++] = m->integral[j].symbol;
    values = 0;
    for (size_t j = 0; j < m->roots; j++) e[values++] = m->root[j].square;
    for (size_t j = 0; j < m->integrals; j++) e[values++] = m->integral[j].integrand;
    for (size_t i = 0; i < m->states; i++) e[values++] = m->value[i];
    f.formula = nh_tape_create(o->dag, count, symbol, values, e, o->system->parameters, o->parameter, o->parameter_value);
    f.rate_work = nh_tape_work_create(f.rate);
    f.start_work = nh_tape_work_create(f.start);
    f.formula_work = nh_tape_work_create(f.formula);
    return f;
}

static void flow_free(flow *f)
{
    nh_tape_work_free(f->rate_work), nh_tape_work_free(f->start_work), nh_tape_work_free(f->formula_work);
    nh_tape_free(f->rate), nh_tape_free(f->start), nh_tape_free(f->formula);
}

/* Constants and roots at a state, from its formulas; every other letter is 0. */
static void letters_at(const flow *f, const double *z, double *out)
{
    double in[most_values] = {0};
    memcpy(in, z, f->n * sizeof *in);
    for (size_t j = 0; j < f->m->roots + 1; j++) { /* roots contain constants and earlier roots */
        nh_tape_eval(f->start, f->start_work, in, out);
        memcpy(in + f->n, out, (f->m->constants + f->m->roots) * sizeof *in);
    }
}

/* Squares, integrands and states by the formulas, at y = (z, J): with the constants of the start, and roots of their squares with its signs. */
static void formulas(const flow *f, const double *y, double *out)
{
    const nh_explicit_motion *m = f->m;
    double in[most_values] = {0};
    memcpy(in, y, f->n * sizeof *in);
    memcpy(in + f->n, f->letter, m->constants * sizeof *in);
    memcpy(in + f->n + m->constants + m->roots, y + f->n, m->integrals * sizeof *in);
    for (size_t j = 0; j < m->roots + 1; j++) {
        nh_tape_eval(f->formula, f->formula_work, in, out);
        for (size_t k = 0; k < m->roots; k++) in[f->n + m->constants + k] = f->sign[k] * sqrt(fabs(out[k]));
    }
}

static void rates(const flow *f, const double *y, double *out)
{
    double value[most_values];
    out[0] = 1;
    nh_tape_eval(f->rate, f->rate_work, y, out + 1);
    if (f->m->integrals) formulas(f, y, value);
    for (size_t j = 0; j < f->m->integrals; j++) out[f->n + j] = value[f->m->roots + j] * out[f->m->parameter];
}

/* Runge and Kutta's method of order four, `count` steps. */
static void run(const flow *f, double *y, size_t count, double h)
{
    size_t n = f->n + f->m->integrals;
    double k[4][most_values], at[most_values];
    for (size_t s = 0; s < count; s++) {
        for (int stage = 0; stage < 4; stage++) {
            double part = stage == 0 ? 0 : stage == 3 ? h : h / 2;
            for (size_t i = 0; i < n; i++) at[i] = y[i] + (stage ? part * k[stage - 1][i] : 0);
            rates(f, at, k[stage]);
        }
        for (size_t i = 0; i < n; i++) y[i] += h / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
    }
}

/* From one state: the constants stay what they are, and the formulas give what our own integration gives.  1 where all can be evaluated. */
static size_t follow(const nh_analysis *r, const char *name, const double *start)
{
    const nh_explicit_motion *m = r->motion;
    flow f = flow_of(r);
    double y[most_values] = {0}, fine[most_values], last[most_letters] = {0}, value[most_values];
    bool good = true;
    memcpy(y, start, f.n * sizeof *y);
    letters_at(&f, y, f.letter);
    for (size_t j = 0; j < m->roots; j++) f.sign[j] = f.letter[m->constants + j] < 0 ? -1 : 1;
    memcpy(fine, y, sizeof fine);
    run(&f, y, steps, step);
    run(&f, fine, 2 * steps, step / 2);
    for (size_t i = 0; i < f.n + m->integrals; i++) good &= fabs(fine[i] - y[i]) <= 1e-10 * (1 + fabs(y[i])); /* near the end of a chart, or a turning point, we are no reference */
    if (good) letters_at(&f, y, last);
    for (size_t j = 0; j < m->constants + m->roots; j++) good &= isfinite(f.letter[j]) && isfinite(last[j]);
    for (size_t j = 0; j < m->roots && !m->integrals; j++) good &= f.sign[j] * last[m->constants + j] >= 0;
    if (good) formulas(&f, y, value);
    for (size_t j = 0; j < m->constants && good; j++)
        cr_expect(m->constant[j].at_start || fabs(last[j] - f.letter[j]) <= 1e-6 * (1 + fabs(f.letter[j])), "%s: %s changes from %g to %g", name,
                  nh_name_of(r->question->model->dag, m->constant[j].symbol), f.letter[j], last[j]);
    for (size_t i = 0; i < m->states && good; i++) {
        double formula = value[m->roots + m->integrals + i];
        cr_expect(!m->is_known[i] || fabs(formula - y[i]) <= 1e-6 * (1 + fabs(y[i])), "%s: %s is %g, its formula %g", name, nh_name_of(r->question->model->dag, m->state[i]), y[i], formula);
    }
    flow_free(&f);
    return good;
}

/* As many currents as can exist, each proved or certified; so many states in closed form; and both on motions. */
static void check(nh_analysis *r, const char *name, size_t independent, size_t known)
{
    enum { starts = 12 };
    cr_expect_eq(r->list->independent, independent, "%s: %zu independent currents", name, r->list->independent);
    for (size_t k = 0; k < r->list->count; k++) cr_expect(r->list->found[k].proof.proved || r->list->found[k].proof.digits >= r->question->options.digits, "%s: %s", name, r->list->found[k].name);
    cr_assert_not_null(r->motion, "%s", name);
    cr_expect_eq(r->motion->known, known, "%s: %zu states", name, r->motion->known);
    nh_error error = {0};
    nh_points *points = nh_points_create(r->question->model, starts, 1, 7, &error);
    size_t followed = 0;
    cr_assert_not_null(points, "%s", error.what);
    for (size_t p = 0; p < starts; p++) {
        double z[most_states];
        for (size_t i = 0; i < r->motion->states; i++) z[i] = points->column[i][p];
        followed += follow(r, name, z);
    }
    cr_expect(followed > starts / 2, "%s: only %zu motions followed", name, followed);
    nh_points_free(points);
    nh_analysis_free(r);
}

static void check_integrals(nh_analysis *r, const char *name, size_t independent, size_t known, size_t integrals)
{
    cr_assert_not_null(r->motion, "%s", name);
    cr_expect_eq(r->motion->integrals, integrals, "%s: %zu integrals", name, r->motion->integrals);
    check(r, name, independent, known);
}

/* ---- systems that ship ---- */

Test(quadratures, sleigh, PLAIN_ONLY)
{
    check(ask_file("systems/sleigh.yaml"), "sleigh", 5, 6);
}

Test(quadratures, constant_speed, PLAIN_ONLY)
{
    check(ask_file("systems/constant_speed.yaml"), "constant speed", 5, 6);
}
Test(quadratures, skate_on_belt, WHOLE_ONLY)
{
    check(ask_file("systems/skate_on_belt.yaml"), "skate on a belt", 5, 6);
}
Test(quadratures, knife_edge, PLAIN_ONLY) { check(ask_file("systems/knife_edge.yaml"), "knife edge", 5, 6); }
Test(quadratures, free_particle, PLAIN_ONLY) { check(ask_file("systems/free_particle.yaml"), "free particle", 6, 7); }

/* The sleigh's third current [CechMusilova2014, sec. 4.2] for all values of the parameters, although its position needs k = 2. */
Test(quadratures, time_of_the_sleigh, PLAIN_ONLY)
{
    nh_analysis *r = ask_file("systems/sleigh.yaml");
    bool found = false;
    for (size_t k = 0; k < r->list->count; k++) {
        const nh_current *f = &r->list->found[k];
        found |= nh_depends(r->question->model->dag, f->phi, r->question->system->t) && f->proof.all_parameters && !f->local;
    }
    cr_expect(found);
    nh_analysis_free(r);
}

/* ---- others ---- */

static void all_proved(nh_analysis *r, size_t count)
{
    size_t proved = 0;
    for (size_t k = 0; k < r->list->count; k++) proved += r->list->found[k].independence == NH_INDEPENDENT && r->list->found[k].proof.all_parameters;
    cr_expect_eq(proved, count, "%zu", proved);
    nh_analysis_free(r);
}

/* Drag with the square of the speed: x' |x'| has a sign. */
Test(quadratures, drag, PLAIN_ONLY)
{
    check(ask("name: drag\nparameters: [{name: m, value: 2}, {name: d, value: 0.3}]\n"
              "coordinates: [{name: x, type: length}, {name: y, type: length}]\nlagrangian: m/2*(x'^2 + y'^2)\n"
              "forces: [\"x = -d*x'*sqrt(x'^2 + y'^2)\", \"y = -d*y'*sqrt(x'^2 + y'^2)\"]\n"
              "domain: {\"x'\": [0.2, 1], \"y'\": [0.2, 1]}\n"), "drag", 4, 5);
    /* without parameters the radicand y'^2/x'^2 + 1 is written as a sum: over x'^2 it is proved, too */
    all_proved(ask("name: drag\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
                   "forces: [\"x = -x'*sqrt(x'^2 + y'^2)\", \"y = -y'*sqrt(x'^2 + y'^2)\"]\ndomain: {\"x'\": [0.4, 1], \"y'\": [0.4, 1]}\n"), 4);
}

/* Appell's and Hamel's constraint where it is a root of velocities: sqrt(x'^4 + x'^2 y'^2) is x' z', and x + x' z' is conserved on either branch. */
Test(quadratures, a_root_of_velocities, PLAIN_ONLY)
{
    all_proved(ask("name: cone\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - z\nconstraints: [\"z'^2 = x'^2 + y'^2\"]\n"
                   "domain: {\"x'\": [0.3, 1], \"z'\": [0.4, 1]}\n"), 5);
}

/* Area functions in place of logarithms, without a current below a fraction bar: integrals that are polynomial in the velocities, so that all are
 * polynomials in those found.  log(x'^2 (2 y (y + sqrt(1 + y^2)) + 1)) is 2 arsinh(y) and a constant of the motion. */
Test(quadratures, polynomials_with_area_functions, PLAIN_ONLY)
{
    static const struct {
        const char *constraint, *area;
    } known[] = {{"z' = y*x'", "asinh(y)"}, {"z' = sqrt(y)*x'", "asinh(sqrt(y))"}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        char text[300];
        snprintf(text, sizeof text,
                 "name: particle\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\nconstraints: [\"%s\"]\ndomain: {y: [0.3, 2]}\n",
                 known[i].constraint);
        nh_analysis *r = ask(text);
        bool found = false;
        for (size_t k = 0; k < r->list->count; k++) {
            char *phi = nh_print_string(r->question->model->dag, r->list->found[k].phi);
            found |= strstr(phi, known[i].area) && r->list->found[k].proof.all_parameters;
            cr_expect_not(strstr(phi, "log("), "%s", phi);
            cr_expect_not(strstr(phi, "/x'") || strstr(phi, "/y'"), "%s", phi);
            nh_free(phi);
        }
        cr_expect(found, "%s", known[i].constraint);
        const nh_completeness *c = &r->completeness[NH_COMPLETE_IN_COORDINATES];
        cr_expect(c->degree >= 4 && c->linear, "%s: degree %zu", known[i].constraint, c->degree);
        nh_analysis_free(r);
    }
}

/* The radicand x'^2 (1 + C^2) is a square times a constant: nothing is left to series, and the signs go into the roots again. */
Test(quadratures, drag_along_the_path)
{
    nh_analysis *r = ask("name: drag\nparameters: [{name: m, value: 1.3}, {name: c, value: 0.2}]\n"
                         "coordinates: [{name: x, type: length}, {name: y, type: length}]\nlagrangian: m/2*(x'^2 + y'^2)\n"
                         "forces: [\"x = -c*x'*sqrt(x'^2 + y'^2)\", \"y = -c*y'*sqrt(x'^2 + y'^2)\"]\n");
    cr_assert_not_null(r);
    cr_expect_eq(r->list->independent, 4);
    for (size_t k = 0; k < r->list->count; k++) {
        char *phi = nh_print_string(r->question->model->dag, r->list->found[k].phi);
        cr_expect(r->list->found[k].proof.all_parameters, "%s", phi);
        cr_expect_null(strstr(phi, "sign"), "%s", phi);
        nh_free(phi);
    }
    nh_analysis_free(r);
}

/* A skate with friction that a slope pulls: linear equations one after another. */
Test(quadratures, skate_on_slope, WHOLE_ONLY)
{
    check(ask("name: slope\nparameters: [{name: m, value: 2}, {name: J, value: 1}, {name: d, value: 0.3}, {name: b, value: 0.6}]\n"
              "coordinates: [{name: phi, type: angle}, {name: x, type: length}, {name: y, type: length}]\n"
              "lagrangian: m/2*(x'^2 + y'^2) + J/2*phi'^2 + m*b*x\nconstraints: [\"y'*cos(phi) = x'*sin(phi)\"]\n"
              "velocities: {names: [w, v], map: [\"phi' = w\", \"x' = v*cos(phi)\", \"y' = v*sin(phi)\"]}\n"
              "forces: [\"x = -d*x'\", \"y = -d*y'\"]\n"), "skate on a slope", 5, 6);
}

/* A surface on which only the energy and one momentum are polynomials. */
Test(quadratures, surface, PLAIN_ONLY)
{
    check(ask("name: surface\nparameters: [{name: m, value: 2}]\ncoordinates: [{name: x, type: length}, {name: y, type: length}]\n"
              "lagrangian: m/2*(1 + x^2)*(x'^2 + y'^2)\n"), "surface", 4, 5);
}

/* Falling with drag: the speed tends to a limit, with the area tangent below it. */
Test(quadratures, fall)
{
    check(ask("name: fall\nparameters: [{name: m, value: 2}, {name: d, value: 0.3}, {name: g, value: 9}]\n"
              "coordinates: [{name: z, type: length}]\nlagrangian: m/2*z'^2 - m*g*z\nforces: [\"z = d*z'^2\"]\n"
              "domain: {\"z'\": [-3, -1]}\n"), "fall", 2, 3);
}

/* A car whose steering wheel turns evenly: v^2 is given by the energy and the angle ph, the velocity along the chart by v and th.  Its heading is an
 * integral of sin(ph)/sqrt(Q(cos(ph))), a logarithm or an arctangent as the sign of m l^2 - I is. */
static nh_analysis *ask_car(const char *inertia, const char *function)
{
    char text[1024];
    snprintf(text, sizeof text,
             "name: car\nparameters: [{name: m, value: 1.2}, {name: I, value: %s}, {name: J, value: 0.2}, {name: l, value: 1.1}]\n"
             "coordinates: [{name: x, type: length}, {name: y, type: length}, {name: th, type: angle}, {name: ph, type: angle}]\ndomain: {ph: [-0.7, 0.7]}\n"
             "lagrangian: m*(x'^2 + y'^2)/2 + I*th'^2/2 + J*ph'^2/2\n"
             "constraints: [\"x'*sin(th) - y'*cos(th) = 0\", \"x'*sin(th + ph) - y'*cos(th + ph) - l*th'*cos(ph) = 0\"]\n", inertia);
    nh_analysis *r = ask(text);
    size_t seen = 0;
    for (size_t k = 0; k < r->list->count; k++) {
        char *phi = nh_print_string(r->question->model->dag, r->list->found[k].phi);
        bool has = strstr(phi, function) != NULL;
        nh_ex positive[NH_MOST_REAL_WHERE];
        size_t wheres = nh_real_where(r->question->model, r->list->found[k].phi, positive);
        cr_expect(!has || (r->list->found[k].proof.all_parameters && wheres), "%s", phi);
        cr_expect(has || !wheres, "%s", phi);
        seen += has;
        nh_free(phi);
    }
    cr_expect_eq(seen, 1);
    cr_expect_geq(r->completeness[NH_COMPLETE_IN_COORDINATES].degree, 2); /* its roots of numbers have residues, modulo primes chosen for that */
    return r;
}

/* x is found from C2 = x/sin(t) - .., and has no pole where sin(t) = 0, t = 0 for one. */
Test(quadratures, a_formula_has_no_poles_of_its_derivation)
{
    nh_analysis *r = ask("name: forced\nparameters: [{name: m, value: 1.3}, {name: k, value: 2.1}, {name: F, value: 0.7}, {name: w, value: 0.9}]\n"
                         "coordinates: [x]\nlagrangian: m*x'^2/2 - k*x^2/2 + F*x*cos(w*t)\n");
    const nh_explicit_motion *m = r->motion;
    cr_assert(m && m->proved && m->known == 3 && m->constants == 2);
    nh_ex symbol[3] = {r->question->model->system->t, m->constant[0].symbol, m->constant[1].symbol};
    double start[3] = {0, 0.4, 0.3}, x;
    nh_tape *tape = nh_tape_create(r->question->model->dag, 3, symbol, 1, &m->value[1], 4, r->question->model->parameter, r->question->model->parameter_value);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, start, &x);
    cr_expect(isfinite(x), "x is %g at t = 0", x);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_analysis_free(r);
}

Test(quadratures, car, WHOLE_ONLY)
{
    check_integrals(ask_car("0.4", "log("), "car", 4, 7, 2);
    check_integrals(ask_car("3", "atan("), "car of large inertia", 4, 7, 2);
}

/* In the half plane the motions end at its border, where the area tangent of nearly 1 has no digits left in doubles: the drift is that of the formula
 * evaluated with more digits, and the program says so. */
Test(quadratures, digits_that_are_lost)
{
    nh_analysis *r = ask_until("name: half_plane\nparameters: [{name: k, value: 1.1}]\ncoordinates: [{name: x, type: length}, {name: y, type: length}]\n"
                               "domain: {y: [0.5, 1.5]}\nlagrangian: (x'^2 + y'^2)/(2*y^2) - k*y\n", 8);
    size_t lost = 0, said = 0;
    for (size_t k = 0; k < r->list->count; k++) {
        const nh_drift *d = &r->list->found[k].drift;
        cr_expect(d->explained, "%s drifts by %g", r->list->found[k].name, d->drift[NH_DRIFT_RUNS - 1]);
        lost += d->in_doubles > 100 * d->drift[NH_DRIFT_RUNS - 1] && d->drift[NH_DRIFT_RUNS - 1] < d->drift[0] / 100;
    }
    for (size_t i = 0; i < r->warnings; i++) said += strstr(r->warning[i], "loses digits") != NULL;
    cr_expect(lost == 1 && said == 1, "%zu currents lose digits, %zu warnings", lost, said);
    nh_analysis_free(r);
}

/* ---- systems that are integrated to the end ---- */

/* All integrals, each proved, and constant along the checked motion. */
static void complete(const char *text, size_t independent)
{
    nh_analysis *r = ask(text);
    cr_expect_eq(r->list->independent, independent, "%s: %zu instead of %zu", text, r->list->independent, independent);
    for (size_t k = 0; k < r->list->count; k++) {
        double drift = r->list->found[k].drift.drift[NH_DRIFT_RUNS - 1];
        char *phi = nh_print_string(r->question->model->dag, r->list->found[k].phi);
        cr_expect(r->list->found[k].proof.proved, "%s: %s", text, phi);
        cr_expect_lt(drift, 1e-6, "%s: %s drifts by %g", text, phi, drift);
        nh_free(phi);
    }
    for (size_t i = 0; i < r->warnings; i++) cr_expect(!strstr(r->warning[i], "bug"), "%s: %s", text, r->warning[i]);
    nh_analysis_free(r);
}

/* A particle in potentials of one coordinate: the time is an elementary function of the place.  Where the motion is bound, its phase turns round and
 * round: sin and cos of it are constants, the time from a turning point is none. */
Test(quadratures, potentials_of_one_coordinate)
{
    static const char *const potential[] = {
        "k*exp(a*x)",     "k*exp(-3*x)", "k*x^(2/3)", "k*tan(x)^2",    "k/sin(x)^2", "k*(1 - exp(-a*x))^2",
        "k*(exp(-2*x) - 2*exp(-x))", "-k/x",        "k/x",       "k/x^2 - a/x",   "k*tanh(x)"};
    enum { count = sizeof potential / sizeof *potential };
    for (size_t i = 0; i < count; i++) {
        if (!sweep_tries(i, 6, count)) continue;
        char text[400];
        snprintf(text, sizeof text, "name: one\nparameters: {k: 1.1, a: 0.7}\ncoordinates: [x]\ndomain: {x: [0.5, 1]}\nlagrangian: x'^2/2 - (%s)\n",
                 potential[i]);
        complete(text, 2);
    }
}

/* Forces that depend on the coordinates, or on a coordinate and the time, through one sum of them. */
Test(quadratures, combined_coordinates, PLAIN_ONLY)
{
    static const struct {
        const char *text;
        size_t independent;
    } row[] = {
        {"name: two bodies\nparameters: {k: 1.1}\ncoordinates: [x, y]\ndomain: {x: [1, 2], y: [-1, 0]}\n"
         "lagrangian: (x'^2 + 2*y'^2)/2 - k*exp(x - y)\n", 4},
        {"name: repulsion\nparameters: {k: 1.1}\ncoordinates: [x, y]\ndomain: {x: [1, 2], y: [-1, 0]}\n"
         "lagrangian: (x'^2 + 2*y'^2)/2 - k/(x - y)\n", 4},
        {"name: plane wave\nparameters: {c: 1.6, k: 1.1}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - k*exp(x + y - c*t)\n", 4},
        {"name: goldfish\ncoordinates: [u, r]\ndomain: {r: [20, 30], u': [1, 2], r': [0, 0.5]}\n"
         "lagrangian: (u' + r')*log(u' + r') + (u' - r')*log(u' - r') - 2*u'*log(r)\n", 4},
        {"name: cylinder\nparameters: {m: 1.1, a: 0.8, g: 9.81}\ncoordinates: [x, y, z]\nlagrangian: m/2*(x'^2 + y'^2 + z'^2) - m*g*z\n"
         "constraints: [\"x^2 + y^2 = a^2\"]\n", 5},
    };
    for (size_t i = 0; i < sizeof row / sizeof *row; i++)
        if (sweep_tries(i, 3, sizeof row / sizeof *row)) complete(row[i].text, row[i].independent);
}

/* A potential that is an angle: the energy stays as it is, a polynomial in the velocities, and is counted as such. */
Test(quadratures, an_energy_that_jumps_stays_one)
{
    nh_analysis *r = ask("name: angle\nparameters: {a: 2}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + a*atan(y/x)\n");
    cr_expect_eq(r->list->independent, 1);
    cr_expect_geq(r->completeness[NH_COMPLETE_IN_COORDINATES].degree, 4);
    nh_analysis_free(r);
}

/* Bound and unbound motions have different constants: the formula says for which it is real. */
Test(quadratures, real_where_the_motion_is_bound)
{
    nh_analysis *r = ask("name: fall\nparameters: {k: 1.1}\ncoordinates: [x]\ndomain: {x: [0.5, 1], x': [-3, 3]}\nlagrangian: x'^2/2 + k/x\n");
    nh_ex positive[NH_MOST_REAL_WHERE];
    size_t bound = 0;
    for (size_t k = 0; k < r->list->count; k++) bound += nh_real_where(r->question->model, r->list->found[k].phi, positive) > 0;
    cr_expect_eq(bound, 1);
    cr_assert_not_null(r->motion);
    cr_expect(r->motion->region && strstr(r->motion->region, "where ") && strstr(r->motion->region, " > 0"), "%s", r->motion->region);
    nh_analysis_free(r);
}

/* ---- integrals without closed form ---- */

/* cos of an exponential has no elementary integral: the skate that turns ever slower keeps three currents, and no false one; its place is an integral. */
Test(quadratures, skate_that_turns_slower, PLAIN_ONLY)
{
    check_integrals(ask_file("systems/skate_with_friction.yaml"), "skate with friction", 3, 6, 2);
}

/* One integral below another: the speed on a slope, and the place. */
Test(quadratures, skate_on_slope_that_turns_slower, PLAIN_ONLY)
{
    check_integrals(ask("name: slope\nparameters: [{name: m, value: 1.2}, {name: J, value: 0.4}, {name: d, value: 0.3}, {name: b, value: 0.6}]\n"
                        "coordinates: [{name: phi, type: angle}, {name: x, type: length}, {name: y, type: length}]\n"
                        "lagrangian: m/2*(x'^2 + y'^2) + J/2*phi'^2 + m*b*x\nconstraints: [\"y'*cos(phi) = x'*sin(phi)\"]\n"
                        "velocities: {names: [w, v], map: [\"phi' = w\", \"x' = v*cos(phi)\", \"y' = v*sin(phi)\"]}\n"
                        "forces: [\"x = -d*x'\", \"y = -d*y'\", \"phi = -d*phi'\"]\n"), "skate on a slope", 2, 6, 3);
}

/* Time as an integral of a genus above one; as an elliptic integral of an angle, which has a name; of more than one. */
Test(quadratures, one_dimension, PLAIN_ONLY)
{
    check_integrals(ask("name: well\nparameters: [{name: m, value: 1.3}]\ncoordinates: [{name: x, type: length}]\nlagrangian: m/2*x'^2 - x^4/4 - x^6/6\n"), "well", 1, 3, 1);
    check_integrals(ask("name: pendulum\nparameters: [{name: m, value: 1.3}, {name: g, value: 2}]\ncoordinates: [{name: h, type: angle}]\nlagrangian: m/2*h'^2 + m*g*cos(h)\n"), "pendulum", 1, 3, 0);
    check_integrals(ask("name: central\nparameters: [{name: m, value: 1.3}, {name: k, value: 0.4}]\ncoordinates: [{name: r, type: length}, {name: p, type: angle}]\n"
                        "domain: {r: [0.5, 1.5]}\nlagrangian: m/2*(r'^2 + r^2*p'^2) - k*r^3\n"), "central force", 2, 5, 2);
}

/* A system of one coordinate, and t - int dx/x' times something that is constant. */
typedef struct {
    const char *lagrangian, *domain, *time;
    bool all_parameters;
    const char *jump; /* it jumps there, beside x' = 0 */
} motion_in_time;

/* Of a pendulum sin(x/2)^2 is below E/(2 g), E = x'^2/2 + g (1 - cos x); measured from the top, or about a place at a quarter turn, the amplitude begins there.  Of x'^2 = k_0 + k_2 x^2 + k_4 x^4 the double of the amplitude's half has the tangent
 * D^(1/4) x/x' [D = k_2^2 - 4 k_0 k_4] or (k_4/k_0)^(1/4) x.  The first one holds while k_0 k_4 < 0, which depends on the values of g and k.
 * In two wells, and above the hill between them, the amplitude has the tangent (sqrt(D) + k_2 + 2 k_4 x^2)/(2 sqrt(-k_4) x'). */
static const motion_in_time in_time[] = {
    {"m*x'^2/2 + m*g*cos(x)", "", "t*sqrt(x'^2 - 2*g*(cos(x) - 1)) - 2*elliptic_f(x/2, 4*g/(x'^2 - 2*g*(cos(x) - 1)))*sign(x')", true, "x\'"},
    {"m*x'^2/2 - m*g*cos(x)", "domain: {x: [2, 4]}\n", "t*sqrt(x'^2 + 2*g*(cos(x) + 1)) - 2*elliptic_f((x - pi)/2, 4*g/(x'^2 + 2*g*(cos(x) + 1)))*sign(x')", true, "x\'"},
    {"m*x'^2/2 + m*g*sin(x)^2/2", "domain: {x: [1, 2]}\n", "t*sqrt(x'^2 + g*cos(x)^2) - elliptic_f(x - pi/2, g/(x'^2 + g*cos(x)^2))*sign(x')", true, "x\'"},
    {"m*x'^2/2 - m*g*x^2/2 - m*k*x^4/4", "",
     "2*t - elliptic_f(2*atan(sqrt(k)*x*(x^4 + g^2/k^2 + 2*g*x^2/k + 2*x'^2/k)^(1/4)/x'), (1 - g/sqrt(g^2 + k*(2*x'^2 + 2*g*x^2 + k*x^4)))/2)/(sqrt(k)*(x^4 + g^2/k^2 + 2*g*x^2/k + 2*x'^2/k)^(1/4))", false, "x\'"},
    {"m*x'^2/2 - m*k*x^4/4", "", "2*t - sqrt(k)*(x^4 + 2*x'^2/k)^(3/4)*elliptic_f(2*atan(sqrt(k)*x*(x^4 + 2*x'^2/k)^(1/4)/x'), 1/2)/(2*x'^2 + k*x^4)", false, "x\'"},
    {"m*x'^2/2 - m*g*x^2/2 + m*k*x^4/4", "domain: {x: [-0.3, 0.3], x': [2, 3]}\n",
     "2*t - sqrt(2)*sqrt(2*x'^2 + 2*g*x^2 - k*x^4)*(k/(2*x'^2 + 2*g*x^2 - k*x^4))^(3/4)*sign(x')*elliptic_f(2*atan(x*(k/(2*x'^2 + 2*g*x^2 - k*x^4))^(1/4)), (g/(sqrt(k)*sqrt(2*x'^2 + 2*g*x^2 - k*x^4)) + 1)/2)/k", true, "x\'"},
    {"m*x'^2/2 - m*g*cos(x)", "", "t*sqrt(x'^2 + 2*g*(cos(x) + 1)) + 2*elliptic_f(atan(cos(x/2)/sin(x/2)), 4*g/(x'^2 + 2*g*(cos(x) + 1)))*sign(x')", true, "sin(x/2)"},
    {"m*x'^2/2 - m*g*sin(x)^2/2", "", "t*sqrt(x'^2 + g*sin(x)^2) - elliptic_f(atan(sin(x)/cos(x)), g/(x'^2 + g*sin(x)^2))*sign(x')", true, "cos(x)"},
    {"m*x'^2/2 + m*g*x^2/2 - m*k*x^4/4", "",
     "t*sqrt(g + sqrt(g^2 + k*(2*x'^2 - 2*g*x^2 + k*x^4))) + sqrt(2)*sign(x)*elliptic_f(atan((g - k*x^2 + sqrt(g^2 + k*(2*x'^2 - 2*g*x^2 + k*x^4)))/(sqrt(2*k)*x')), "
     "2*sqrt(g^2 + k*(2*x'^2 - 2*g*x^2 + k*x^4))/(g + sqrt(g^2 + k*(2*x'^2 - 2*g*x^2 + k*x^4))))", true, "x"},
};

Test(quadratures, times_that_are_elliptic_integrals)
{
    for (size_t i = 0; i < sizeof in_time / sizeof *in_time; i++) {
        if (!sweep_tries(i, 1, 3)) continue;
        const motion_in_time *x = &in_time[i];
        char text[500];
        nh_error error = {0};
        nh_ex e, claim;
        snprintf(text, sizeof text, "name: time\nparameters: [{name: m, value: 1.3}, {name: g, value: 2}, {name: k, value: 0.7}]\ncoordinates: [{name: x, type: %s}]\nlagrangian: %s\n%s", strstr(x->lagrangian, "(x)") ? "angle" : "length", x->lagrangian, x->domain);
        nh_analysis *r = ask(text);
        nh_dag *d = r->question->model->dag;
        cr_assert_eq(r->list->pieces, 1, "%s: %zu", x->lagrangian, r->list->pieces);
        const nh_current *f = &r->list->piece[0];
        cr_expect(f->proof.proved && f->proof.all_parameters == x->all_parameters, "%s", x->lagrangian);
        char jump[80];
        snprintf(jump, sizeof jump, "on each side of %s = 0, where it jumps", x->jump);
        size_t length = strcmp(x->jump, "x'") ? strlen("on each side of x' = 0, where it jumps, ") + strlen(jump) : strlen(jump);
        cr_expect(strstr(f->region, "on each side of x' = 0, where it jumps") && strstr(f->region, jump) && strlen(f->region) == length, "%s: %s", x->lagrangian, f->region);
        cr_assert(nh_system_expression_text(r->question->system, "test", x->time, 0, NULL, &e, &error) && nh_analysis_file_to_chart(r->question->model, e, &claim, &error), "%s: %s", x->lagrangian, error.what);
        nh_ex ratio = nh_simplify(d, nh_div(d, nh_diff(d, f->phi, r->question->system->t), nh_diff(d, claim, r->question->system->t)));
        cr_expect(nh_model_is_constant(r->question->model, ratio), "%s", x->lagrangian);
        cr_expect_eq(nh_normal_is_zero(d, nh_sub(d, f->phi, nh_mul(d, ratio, claim)), 0), NH_ZERO, "%s", x->lagrangian);
        nh_analysis_free(r);
    }
}

/* The energy of the motion along x, which the whole energy gives with the currents of the fall, has the time of x. */
Test(quadratures, parts_that_move_by_themselves)
{
    nh_analysis *r = ask("name: parts\nparameters: [{name: m, value: 1.3}, {name: g, value: 2}]\ncoordinates: [x, z]\nlagrangian: m*(x'^2 + z'^2)/2 - m*x^4/4 - m*g*z\n");
    cr_expect_eq(r->list->independent, 3);
    cr_assert_eq(r->list->pieces, 1);
    const nh_current *f = &r->list->piece[0];
    cr_expect(f->proof.proved && nh_depends(r->question->model->dag, f->phi, r->question->system->t));
    cr_expect(!nh_depends(r->question->model->dag, f->phi, r->question->system->coordinate[1].q) && !nh_depends(r->question->model->dag, f->phi, r->question->model->chart->w[1]));
    cr_expect_str_eq(f->region, "on each side of x' = 0, where it jumps");
    nh_analysis_free(r);
}

/* The same with the tangent of half an angle and the area tangent: a bead on a hoop that turns, and a spring whose force is a sine of the area. */
Test(quadratures, times_by_half_arguments, WHOLE_ONLY)
{
    check_integrals(ask("name: hoop\nparameters: [{name: m, value: 0.3}, {name: R, value: 0.5}, {name: W, value: 2}, {name: g, value: 9.8}]\ncoordinates: [{name: h, type: angle}]\n"
                        "domain: {h: [-0.6, 0.6], \"h'\": [-0.8, 0.8]}\nlagrangian: m*R^2*(h'^2 + W^2*sin(h)^2)/2 + m*g*R*cos(h)\n"), "hoop", 1, 3, 0);
    check_integrals(ask("name: spring\nparameters: [{name: a, value: 1.1}]\ncoordinates: [x]\nlagrangian: x'^2/2 - a*cosh(x)\n"), "spring", 1, 3, 0);
}

/* h'^2 of a bead on a hoop that turns slowly. */
static double square_of_speed(double energy, double h) { return energy + 4 * pow(sin(h), 2) + 28 * cos(h); }

/* It swings, or turns over the top, where the formula jumps: here between, with t(h) by Simpson's rule. */
Test(quadratures, a_bead_that_swings_or_turns_over, PLAIN_ONLY)
{
    nh_analysis *r = ask("name: hoop\ncoordinates: [{name: h, type: angle}]\nlagrangian: (h'^2 + 4*sin(h)^2)/2 + 14*cos(h)\n");
    const nh_model *o = r->question->model;
    cr_assert_eq(r->list->pieces, 1);
    const nh_current *f = &r->list->piece[0];
    cr_expect(strstr(f->region, "on each side of cos(h/2) = 0, where it jumps") && strstr(f->region, "on each side of h' = 0, where it jumps"), "%s", f->region);
    nh_ex in[] = {r->question->system->t, o->system->coordinate[0].q, o->chart->w[0]};
    nh_tape *tape = nh_tape_create(o->dag, 3, in, 1, &f->phi, 0, NULL, NULL);
    nh_tape_work *work = nh_tape_work_create(tape);
    for (int turns = 0; turns < 2; turns++) {
        enum { parts = 200 };
        double energy = turns ? 60 : 0, part = 2.0 / parts, z[3] = {0, -1, sqrt(square_of_speed(energy, -1))}, first, last;
        nh_tape_eval(tape, work, z, &first);
        for (int i = 0; i < parts; i++) {
            double middle = sqrt(square_of_speed(energy, z[1] + part / 2)), end = sqrt(square_of_speed(energy, z[1] + part));
            z[0] += part / 6 * (1 / z[2] + 4 / middle + 1 / end);
            z[1] += part;
            z[2] = end;
        }
        nh_tape_eval(tape, work, z, &last);
        cr_expect_float_eq(last, first, 1e-7 * (1 + fabs(first)), "%g, then %g", first, last);
        cr_expect(fabs(z[0]) > 0.1 && isfinite(last));
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_analysis_free(r);
}

/* ---- their series ---- */

/* From the start of the checked motion: z = (t, q, w). */
static nh_motion_series *series_of(const nh_analysis *r, double *z, double low, double high)
{
    const nh_validation *v = r->validation;
    cr_assert(r->motion && v && v->count);
    z[0] = v->time[0];
    memcpy(z + 1, v->state, (r->question->model->m + r->question->model->n) * sizeof *z);
    double start = z[r->motion->parameter];
    nh_motion_series *out = nh_motion_series_from(r->arena, r->question->model, r->motion, z, start + low, start + high);
    cr_assert_not_null(out);
    cr_assert_eq(out->link[out->first].centre, start);
    for (size_t i = 0; i < out->links; i++) {
        const nh_motion_series_link *l = &out->link[i];
        if (i) cr_expect_float_eq(l->centre - l->half, l[-1].centre + l[-1].half, 1e-14);
        for (size_t j = 0; j < out->integrals; j++) cr_expect(l->integral[j].bound > 0 && l->integral[j].bound < 2e-12 * (1 + fabs(l->integral[j].coefficient[0])));
    }
    return out;
}

/* 1/h' of the magnetic pendulum that starts with z, where h' keeps its sign. */
static double pace(const double *z, double h) { return 1 / copysign(sqrt(z[2] * z[2] + 4 * (cos(h) - cos(z[1])) + 0.5 * (cos(2 * h) - cos(2 * z[1]))), z[2]); }

/* Its integral, by Simpson's rule. */
static double time_between(const double *z, double from, double to)
{
    enum { pieces = 300 };
    double width = (to - from) / pieces, sum = 0;
    for (int k = 0; k <= pieces; k++) sum += (k == 0 || k == pieces ? 1 : k % 2 ? 4 : 2) * pace(z, from + k * width);
    return sum * width / 3;
}

/* The time of a pendulum with a magnet, t' = 1/h', h'^2 = h'_0^2 + 2 g (cos h - cos h_0) + 2 b (cos 2 h - cos 2 h_0), on either side of the start nearly to where it turns:
 * at cos h = c, 2 g (c - c_0) + 4 b (c^2 - c_0^2) = -h'_0^2. */
Test(quadratures, series_of_the_pendulum)
{
    nh_analysis *r = ask("name: pendulum\nparameters: [{name: m, value: 1.3}, {name: g, value: 2}, {name: b, value: 0.25}]\ncoordinates: [{name: h, type: angle}]\nlagrangian: m/2*h'^2 + m*g*cos(h) + m*b*cos(2*h)\n");
    cr_expect(r->motion->proved);
    double z[8];
    nh_motion_series *v = series_of(r, z, -3, 3);
    cr_assert(r->motion->parameter == 1 && v->integrals == 1);
    double turns = acos(sqrt(pow(2 + cos(z[1]), 2) - z[2] * z[2]) - 2), value = 0, h = z[1];
    cr_expect_lt(nh_motion_series_begin(v), -0.95 * turns, "%g of %g", nh_motion_series_begin(v), turns);
    cr_expect_gt(nh_motion_series_end(v), 0.95 * turns, "%g of %g", nh_motion_series_end(v), turns);
    for (int side = -1; side <= 1; side += 2, value = 0, h = z[1])
        for (size_t i = v->first; i < v->links; i += (size_t)side) {
            const nh_motion_series_link *l = &v->link[i];
            for (int k = -2; k <= 2; k++) {
                double to = l->centre + side * k * l->half / 2;
                value += time_between(z, h, to);
                h = to;
                cr_expect_float_eq(nh_motion_series_value(l, 0, h), value, 5e-14 * (1 + fabs(value)) + l->integral[0].bound, "interval %zu at %g", i, h);
            }
        }
    nh_analysis_free(r);
}

/* The skate on a slope that turns ever slower, its motion computed from m v' = m b cos phi - d v, J w' = -d w, by Runge and Kutta's method. */
static void skate(const double *y, double *out)
{
    const double m = 1.2, J = 0.4, d = 0.3, b = 0.6; /* y: phi, x, y, w, v */
    out[0] = y[3], out[1] = y[4] * cos(y[0]), out[2] = y[4] * sin(y[0]), out[3] = -d / J * y[3], out[4] = b * cos(y[0]) - d / m * y[4];
}

Test(quadratures, series_of_a_skate, PLAIN_ONLY)
{
    enum { states = 5, pieces = 200 };
    nh_analysis *r = ask("name: slope\nparameters: [{name: m, value: 1.2}, {name: J, value: 0.4}, {name: d, value: 0.3}, {name: b, value: 0.6}]\n"
                         "coordinates: [{name: phi, type: angle}, {name: x, type: length}, {name: y, type: length}]\n"
                         "lagrangian: m/2*(x'^2 + y'^2) + J/2*phi'^2 + m*b*x\nconstraints: [\"y'*cos(phi) = x'*sin(phi)\"]\n"
                         "velocities: {names: [w, v], map: [\"phi' = w\", \"x' = v*cos(phi)\", \"y' = v*sin(phi)\"]}\n"
                         "forces: [\"x = -d*x'\", \"y = -d*y'\", \"phi = -d*phi'\"]\n");
    double z[8], y[states], k[4][states], at[states];
    nh_motion_series *v = series_of(r, z, 0, 6);
    cr_assert(r->motion->proved && r->motion->parameter == 0 && v->integrals == 3);
    cr_expect(v->links > 3 && v->first == 0 && nh_motion_series_end(v) >= z[0] + 6);
    memcpy(y, z + 1, sizeof y);
    double t = z[0];
    for (size_t i = 0; i < v->links; i++) {
        const nh_motion_series_link *l = &v->link[i];
        double width = (l->centre + l->half - t) / pieces;
        for (int p = 0; p <= pieces; p++) {
            double rate = exp(0.25 * t) * y[4] - exp(0.25 * z[0]) * z[5];
            cr_expect_float_eq(nh_motion_series_value(l, 0, t), rate, 1e-12 * (1 + fabs(rate)));
            cr_expect_float_eq(nh_motion_series_value(l, 1, t), y[1] - z[2], 2e-12);
            cr_expect_float_eq(nh_motion_series_value(l, 2, t), y[2] - z[3], 2e-12);
            for (int stage = 0; stage < 4 && p < pieces; stage++) {
                for (int j = 0; j < states; j++) at[j] = y[j] + (stage ? (stage == 3 ? 1 : 0.5) * width * k[stage - 1][j] : 0);
                skate(at, k[stage]);
            }
            for (int j = 0; j < states && p < pieces; j++) y[j] += width / 6 * (k[0][j] + 2 * k[1][j] + 2 * k[2][j] + k[3][j]);
            t += p < pieces ? width : 0;
        }
    }
    nh_analysis_free(r);
}
