/* mechanics: small systems as text, their models, and values of expressions at points, for the tests. */
#ifndef NH_TESTS_MECHANICS_H
#define NH_TESTS_MECHANICS_H

#include <criterion/criterion.h>

#include <math.h>
#include <string.h>

#include "base/text.h"
#include "geometry/model.h"
#include "integrals/points.h"
#include "problem/analysis_file.h"

typedef struct {
    nh_system *system;
    nh_model *model;
} mechanics;

/* Stop the test with the message of an error. */
static inline void must(bool good, const nh_error *error, const char *what)
{
    char text[2600] = "";
    if (!good && error) nh_error_format(error, text, sizeof text);
    cr_assert(good, "%s: %s", what, text);
}

static inline mechanics mechanics_make(nh_system *system, nh_chart_choice choice, nh_error *error)
{
    must(system != NULL, error, "the system");
    mechanics x = {system, nh_model_create(system, nh_chart_create(system, choice, 1, error), error)};
    must(x.model != NULL, error, system->name);
    return x;
}

static inline mechanics mechanics_of_text(const char *text, nh_chart_choice choice)
{
    nh_error error = {0};
    return mechanics_make(nh_system_parse("test.yaml", text, 0, NULL, &error), choice, &error);
}

static inline mechanics mechanics_of_file(const char *path, nh_chart_choice choice, size_t settings, const nh_setting *setting)
{
    nh_error error = {0};
    return mechanics_make(nh_system_read(path, settings, setting, &error), choice, &error);
}

static inline void mechanics_clear(mechanics *x)
{
    nh_model_free(x->model);
    nh_system_free(x->system);
}

/* A formula in the names of the system file, as a function of the model's chart. */
static inline nh_ex formula(const nh_model *model, const char *text)
{
    nh_error error = {0};
    nh_ex e = 0, out = 0;
    nh_named energy = {.name = "E", .value = model->E};
    must(nh_system_expression_text(model->system, "test", text, 1, &energy, &e, &error), &error, text);
    must(nh_analysis_file_to_chart(model, e, &out, &error), &error, text);
    return out;
}

static inline void values_at(const nh_model *model, size_t n, const nh_ex *e, const double *z, double *out)
{
    nh_tape *tape = nh_model_tape(model, n, e);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, z, out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
}

static inline double value_at(const nh_model *model, nh_ex e, const double *z)
{
    double out;
    values_at(model, 1, &e, z, &out);
    return out;
}

static inline nh_points *points_of(const nh_model *model, size_t count, uint64_t seed)
{
    nh_error error = {0};
    nh_points *points = nh_points_create(model, count, 1, seed, &error);
    must(points != NULL, &error, "the points");
    return points;
}

static inline void point_of(const nh_points *points, size_t p, double *z)
{
    for (size_t j = 0; j < points->width; j++) z[j] = points->column[j][p];
}

/* How far `phi` is from a constant multiple of `expected` over the points: max |phi - c expected| / max |phi|. */
static inline double off_multiple(const nh_model *model, const nh_points *points, nh_ex phi, nh_ex expected)
{
    nh_ex pair[2] = {phi, expected};
    size_t n = points->count;
    double *value = nh_alloc_array(2 * n, sizeof *value), xy = 0, yy = 0, worst = 0, size = 0;
    nh_points_evaluate(points, model, 2, pair, value);
    for (size_t p = 0; p < n; p++) {
        xy += value[p] * value[n + p];
        yy += value[n + p] * value[n + p];
        size = fmax(size, fabs(value[p]));
    }
    for (size_t p = 0; p < n; p++) worst = fmax(worst, fabs(value[p] - xy / yy * value[n + p]));
    nh_free(value);
    return size > 0 && isfinite(xy / yy) && xy != 0 ? worst / size : INFINITY;
}

/* ---- systems ---- */

#define PARTICLE(title, coordinates_beyond_y) \
    "name: " title "\n" \
    "coordinates:\n" \
    "  - {name: x, type: length}\n" \
    "  - {name: y, type: length}\n" coordinates_beyond_y
#define AND_Z "  - {name: z, type: length}\n"
#define FREE_IN_SPACE "lagrangian: m/2*(x'^2 + y'^2 + z'^2)\n"
#define MASS "parameters: [{name: m, value: 1.3}]\n"

/* No constraint, potential, explicit time, a term linear in the velocities, forces that depend on the velocities. */
static const char DRIVEN[] = PARTICLE("driven", "")
    "parameters: [{name: m, value: 1.3}, {name: b, value: 0.7}, {name: c, value: 0.45}, {name: d, value: 0.21}]\n"
    "lagrangian: m/2*(x'^2 + (1 + x^2)*y'^2) - c*x^2*y*cos(t) + b*t*x*y'\n"
    "forces:\n"
    "  - x = -d*x' + y'\n"
    "  - y = -d*y'*x'^2\n";

/* Affine, not integrable, with a potential; the chart mixes the velocities. */
static const char AFFINE[] = PARTICLE("affine", AND_Z)
    "parameters: [{name: m, value: 1.3}, {name: W, value: 0.8}, {name: g, value: 0.9}]\n"
    "lagrangian: m/2*(x'^2 + y'^2 + z'^2) - m*g*z - x^2*y\n"
    "constraints: [\"z' = y*x' + W*x\"]\n"
    "velocities:\n"
    "  names: [u, s]\n"
    "  map:\n"
    "    - x' = u + y*s\n"
    "    - y' = s - x*u\n"
    "    - z' = y*(u + y*s) + W*x\n"
    "domain: {x: [-0.8, 0.8], y: [-0.8, 0.8]}\n";

/* A ball on a turntable: two affine constraints, written implicitly, and a chart of its own. */
static const char TURNTABLE[] =
    "name: ball on a turntable\n"
    "parameters: [{name: m, value: 1.3}, {name: J, value: 0.4}, {name: r, value: 0.6}, {name: W, value: 0.8}]\n"
    "coordinates:\n"
    "  - {name: x, type: length}\n"
    "  - {name: y, type: length}\n"
    "  - {name: p, type: angle}\n"
    "  - {name: h, type: angle}\n"
    "  - {name: s, type: angle}\n"
    "lagrangian: \"J/2*(h'^2 + p'^2 + s'^2 + 2*p'*s'*cos(h)) + m*(x'^2 + y'^2)/2\"\n"
    "constraints:\n"
    "  - W*y - r*(h'*sin(p) - s'*sin(h)*cos(p)) + x' = 0\n"
    "  - -W*x + r*(h'*cos(p) + s'*sin(h)*sin(p)) + y' = 0\n"
    "dependent: [x, y]\n"
    "domain: {x: [-0.7, 0.7], y: [-0.7, 0.7], p: [-0.7, 0.7], h: [0.6, 2.0], s: [-0.7, 0.7]}\n";

/* Constant speed under gravity, the paper's nonlinear constraint: solved for y', with a root to be chosen, and implicit; the chart is the
 * direction. */
#define PROJECTILE \
    PARTICLE("uniform projectile", "") \
    "parameters: [{name: m, value: 1.3}, {name: g, value: 9.81}, {name: v0, value: 3}]\n" \
    "lagrangian: m/2*(x'^2 + y'^2) - m*g*y\n" \
    "dependent: [y]\n" \
    "domain: {x': [0.4, 2.8], y': [0.4, 2.8], b: [0.2, 1.4]}\n"
#define DIRECTION "velocities: {names: [b], map: [\"x' = v0*cos(b)\", \"y' = v0*sin(b)\"]}\n"
static const char PROJECTILE_EXPLICIT[] = PROJECTILE "constraints: [\"y' = sqrt(v0^2 - x'^2)\"]\n" DIRECTION;
static const char PROJECTILE_QUADRATIC[] = PROJECTILE "constraints: [\"x'^2 + y'^2 = v0^2\"]\n" DIRECTION;
static const char PROJECTILE_IMPLICIT[] = PROJECTILE "constraints: [\"sqrt(x'^2 + y'^2) = v0\"]\n" DIRECTION;

/* The same in space. */
#define PROJECTILE_IN_SPACE \
    PARTICLE("uniform projectile in space", AND_Z) \
    "parameters: [{name: m, value: 1.3}, {name: g, value: 9.81}, {name: v0, value: 3}]\n" \
    "lagrangian: m/2*(x'^2 + y'^2 + z'^2) - m*g*z\n" \
    "dependent: [z]\n" \
    "domain: {x': [0.4, 1.7], y': [0.4, 1.7], z': [0.4, 2.8]}\n"
static const char SPACE_EXPLICIT[] = PROJECTILE_IN_SPACE "constraints: [\"z' = sqrt(v0^2 - x'^2 - y'^2)\"]\n";
static const char SPACE_QUADRATIC[] = PROJECTILE_IN_SPACE "constraints: [\"x'^2 + y'^2 + z'^2 = v0^2\"]\n";
static const char SPACE_IMPLICIT[] = PROJECTILE_IN_SPACE "constraints: [\"sqrt(x'^2 + y'^2 + z'^2) = v0\"]\n";

/* Nonlinear and homogeneous in the velocities: the energy is conserved. */
static const char APPELL_HAMEL[] = PARTICLE("Appell-Hamel", AND_Z)
    "parameters: [{name: m, value: 1.3}, {name: g, value: 0.9}, {name: k, value: 0.8}]\n"
    "lagrangian: m*(x'^2 + y'^2 + z'^2)/2 - g*m*z\n"
    "constraints: [\"z'^2 = k^2*(x'^2 + y'^2)\"]\n";

/* Two coupled nonlinear constraints that only Newton's method solves, with coordinates in them. */
static const char COUPLED[] = PARTICLE("coupled", AND_Z)
    "  - {name: u, type: length}\n"
    "parameters: [{name: m, value: 1.3}, {name: k, value: 0.3}]\n"
    "lagrangian: m/2*(x'^2 + 2*y'^2 + z'^2 + u'^2) - x*z + k*u*y\n"
    "constraints:\n"
    "  - z' + k*z'^3 + k*u' = x' + y*y'\n"
    "  - u' + k*sin(z') = y' + x*x'\n"
    "dependent: [z, u]\n";

/* Linear, with explicit time, and friction. */
static const char RHEONOMIC[] = PARTICLE("rheonomic", AND_Z)
    "parameters: [{name: m, value: 1.3}, {name: d, value: 0.21}]\n"
    "lagrangian: m/2*(x'^2 + y'^2 + z'^2) - x*z\n"
    "constraints: [\"z' = (y + t)*x'\"]\n"
    "forces: [\"x = -d*x'\", \"z = -d*z'*x\"]\n";

/* A Lagrangian that is not quadratic in the velocities. */
static const char RELATIVISTIC[] = PARTICLE("relativistic", AND_Z) MASS
    "lagrangian: -m*sqrt(1 - x'^2 - y'^2 - z'^2) - x*y\n"
    "constraints: [\"z' = y*x'\"]\n"
    "domain: {x': [-0.4, 0.4], y': [-0.4, 0.4], z': [-0.4, 0.4]}\n";

/* Euler's disk of radius r and thickness r e on a plane; (x1, x2) is where it touches. */
static const char DISK[] =
    "name: disk\n"
    "parameters:\n"
    "  - {name: r, value: 0.8}\n"
    "  - {name: e, value: 0.3}\n"
    "  - {name: M, value: 1.3}\n"
    "  - {name: I1, value: 0.25}\n"
    "  - {name: I3, value: 0.45}\n"
    "  - {name: g, value: 9.81}\n"
    "coordinates:\n"
    "  - {name: theta, type: angle}\n"
    "  - {name: varphi, type: angle}\n"
    "  - {name: psi, type: angle}\n"
    "  - {name: x1, type: length}\n"
    "  - {name: x2, type: length}\n"
    "definitions:\n"
    "  - h = r*e/2\n"
    "  - b = r*cos(theta) - h*sin(theta)\n"
    "  - z = r*sin(theta) + h*cos(theta)\n"
    "lagrangian: >-\n"
    "  M/2*((x1' + z*theta'*sin(varphi) - b*varphi'*cos(varphi))^2 + (x2' - z*theta'*cos(varphi) - b*varphi'*sin(varphi))^2 + b^2*theta'^2)\n"
    "  + I1/2*(theta'^2 + varphi'^2*sin(theta)^2) + I3/2*(psi' + varphi'*cos(theta))^2 - M*g*z\n"
    "constraints:\n"
    "  - x1' = -r*psi'*cos(varphi)\n"
    "  - x2' = -r*psi'*sin(varphi)\n"
    "domain: {theta: [0.4, 1.3]}\n";

#endif
