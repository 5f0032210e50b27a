/* scales_cases: motions with closed forms at any amplitude and in any units, for test_scales, which takes a sample, and bench_scales, which takes all. */
#ifndef NH_TESTS_SCALES_CASES_H
#define NH_TESTS_SCALES_CASES_H

#include <math.h>
#include <stdio.h>

#include "mechanics.h"
#include "motion/accuracy.h"

enum { scales_outputs = 7, scales_most = 5, scales_systems = 6 };

/* Units: lengths, masses and times are multiplied by these; `amplitude` is that of the motion, in its unit. */
typedef struct {
    double amplitude, length, mass, time;
} scales_of;

typedef struct {
    const char *name;
    size_t m;                    /* coordinates */
    double until;                /* before times are scaled */
    void (*text)(const scales_of *s, char *out, size_t size);
    void (*start)(const scales_of *s, double *q, double *v);
    void (*truth)(const scales_of *s, double t, double *value); /* q, then v */
} scales_case;

/* x = a cos(t) */
static inline void oscillator_text(const scales_of *s, char *out, size_t size)
{
    snprintf(out, size, "name: test\ncoordinates: [{name: x}]\nlagrangian: %.17g*x'^2/2 - %.17g*x^2/2\n", s->mass, s->mass / s->time / s->time);
}
static inline void oscillator_truth(const scales_of *s, double t, double *value)
{
    double a = s->amplitude * s->length;
    value[0] = a * cos(t / s->time);
    value[1] = -a / s->time * sin(t / s->time);
}
static inline void oscillator_start(const scales_of *s, double *q, double *v)
{
    q[0] = s->amplitude * s->length;
    v[0] = 0;
}

/* Beside one of size 1 another, which is not coupled with it. */
static inline void two_text(const scales_of *s, char *out, size_t size)
{
    double k = s->mass / s->time / s->time;
    snprintf(out, size, "name: test\ncoordinates: [{name: x}, {name: y}]\nlagrangian: %.17g*(x'^2 + y'^2)/2 - %.17g*(x^2 + 2*y^2)/2\n", s->mass, k);
}
static inline void two_truth(const scales_of *s, double t, double *value)
{
    double w = sqrt(2), a = s->amplitude * s->length;
    value[0] = s->length * sin(t / s->time);
    value[1] = a * cos(w * t / s->time);
    value[2] = s->length / s->time * cos(t / s->time);
    value[3] = -a * w / s->time * sin(w * t / s->time);
}
static inline void two_start(const scales_of *s, double *q, double *v)
{
    double value[4];
    two_truth(s, 0, value);
    q[0] = value[0], q[1] = value[1], v[0] = value[2], v[1] = value[3];
}

/* Kepler's ellipse of eccentricity 1/2 and half axis a, from the perihelion: E - e sin(E) = n t. */
static inline double kepler_mu(const scales_of *s) { return pow(s->amplitude * s->length, 3) / pow(s->time, 2); }
static inline void kepler_text(const scales_of *s, char *out, size_t size)
{
    snprintf(out, size, "name: test\ncoordinates: [{name: x}, {name: y}]\nlagrangian: %.17g*(x'^2 + y'^2)/2 + %.17g/sqrt(x^2 + y^2)\ndomain: {x: [%.17g, %.17g], y: [%.17g, %.17g]}\n", s->mass,
             s->mass * kepler_mu(s), s->amplitude * s->length / 2, s->amplitude * s->length, s->amplitude * s->length / 2, s->amplitude * s->length);
}
static inline void kepler_truth(const scales_of *s, double t, double *value)
{
    double e = 0.5, a = s->amplitude * s->length, b = a * sqrt(1 - e * e), M = t / s->time, E = M;
    for (int i = 0; i < 60; i++) E -= (E - e * sin(E) - M) / (1 - e * cos(E));
    double rate = 1 / s->time / (1 - e * cos(E));
    value[0] = a * (cos(E) - e);
    value[1] = b * sin(E);
    value[2] = -a * sin(E) * rate;
    value[3] = b * cos(E) * rate;
}
static inline void kepler_start(const scales_of *s, double *q, double *v)
{
    double value[4];
    kepler_truth(s, 0, value);
    q[0] = value[0], q[1] = 0, v[0] = 0, v[1] = value[3];
}

/* Chaplygin's sleigh, J = 3 m a^2: phi = 4 atan(tanh(A t/4)) from phi' = A; y moves off zero by a great amount.  [its heading only; the place is a quadrature] */
static inline void sleigh_text(const scales_of *s, char *out, size_t size)
{
    double m = 2 * s->mass, a = s->length;
    snprintf(out, size, "name: test\ncoordinates: [{name: phi, type: angle}, {name: x}, {name: y}]\n"
             "lagrangian: %.17g/2*((x' - %.17g*phi'*sin(phi))^2 + (y' + %.17g*phi'*cos(phi))^2) + %.17g/2*phi'^2\nconstraints: [\"y'*cos(phi) = x'*sin(phi)\"]\n"
             "velocities: {names: [omega, v], map: [\"phi' = omega\", \"x' = v*cos(phi)\", \"y' = v*sin(phi)\"]}\n", m, a, a, m * a * a * 3);
}
static inline void sleigh_truth(const scales_of *s, double t, double *value)
{
    double A = 2 * s->amplitude / s->time, u = A * t / 2;
    value[0] = 4 * atan(tanh(u / 2));
    value[1] = value[2] = value[4] = value[5] = NAN;
    value[3] = A / cosh(u);
}
static inline void sleigh_start(const scales_of *s, double *q, double *v)
{
    q[0] = q[1] = q[2] = v[1] = v[2] = 0;
    v[0] = 2 * s->amplitude / s->time;
}

/* A vertical disk that rolls and spins, from a heading of -pi/2: a circle; phi = -pi/2 + w t, psi = p t. */
static inline void disk_text(const scales_of *s, char *out, size_t size)
{
    double m = s->mass, R = s->length;
    snprintf(out, size, "name: test\ncoordinates: [{name: x}, {name: y}, {name: phi, type: angle}, {name: psi, type: angle}]\n"
             "lagrangian: %.17g/2*(x'^2 + y'^2) + %.17g/2*psi'^2 + %.17g/2*phi'^2\nconstraints: [\"x' = %.17g*cos(phi)*psi'\", \"y' = %.17g*sin(phi)*psi'\"]\n"
             "velocities: {names: [w, p], map: [\"x' = %.17g*cos(phi)*p\", \"y' = %.17g*sin(phi)*p\", \"phi' = w\", \"psi' = p\"]}\n", m, m * R * R / 2, m * R * R / 4, R, R, R, R);
}
static inline void disk_truth(const scales_of *s, double t, double *value)
{
    double w = 0.7 / s->time, p = 1.3 * s->amplitude / s->time, phi = 0.3 + w * t, r = s->length * p / w;
    value[0] = r * (sin(phi) - sin(0.3));
    value[1] = -r * (cos(phi) - cos(0.3));
    value[2] = phi;
    value[3] = p * t;
    value[4] = s->length * p * cos(phi);
    value[5] = s->length * p * sin(phi);
    value[6] = w;
    value[7] = p;
}
static inline void disk_start(const scales_of *s, double *q, double *v)
{
    double value[8];
    disk_truth(s, 0, value);
    for (int i = 0; i < 4; i++) q[i] = value[i], v[i] = value[4 + i];
}

/* The same disk straight on, at a heading of pi/2: x = 0 but for rounding. */
static inline void straight_truth(const scales_of *s, double t, double *value)
{
    double p = 1.3 * s->amplitude / s->time;
    for (int i = 0; i < 8; i++) value[i] = 0;
    value[1] = s->length * p * t;
    value[2] = acos(0);
    value[3] = p * t;
    value[5] = s->length * p;
    value[7] = p;
}
static inline void straight_start(const scales_of *s, double *q, double *v)
{
    double value[8];
    straight_truth(s, 0, value);
    for (int i = 0; i < 4; i++) q[i] = value[i], v[i] = value[4 + i];
    v[0] = s->length * v[3] * cos(q[2]);
}

static const scales_case scales_all[scales_systems] = {
    {"oscillator", 1, 11, oscillator_text, oscillator_start, oscillator_truth}, {"two oscillators", 2, 11, two_text, two_start, two_truth}, {"Kepler", 2, 11, kepler_text, kepler_start, kepler_truth},
    {"sleigh", 3, 6, sleigh_text, sleigh_start, sleigh_truth},                  {"disk", 4, 8, disk_text, disk_start, disk_truth},          {"disk straight on", 4, 8, disk_text, straight_start, straight_truth},
};

typedef struct {
    bool held, wrong;
    double error;     /* the largest of the quantities whose truth is known and is not zero, relative to their largest values */
    char why[512];
} scales_result;

/* All of (q, v) to eps.  What is zero must be small beside rounding of what it is made of, which is seen in x of the disk straight on. */
static inline scales_result scales_try(const scales_case *c, const scales_of *s, double eps)
{
    scales_result out = {.held = false};
    char text[1024];
    c->text(s, text, sizeof text);
    mechanics x = mechanics_of_text(text, NH_CHART_AUTO);
    const nh_model *o = x.model;
    size_t m = c->m, n = 2 * m;
    double q[8], v[8], times[scales_outputs], truth[scales_outputs][16], until = c->until * s->time / (c->start == sleigh_start ? s->amplitude : 1);
    nh_ex e[16];
    nh_options options;
    nh_error error = {0};
    nh_options_default(&options);
    c->start(s, q, v);
    for (int i = 0; i < scales_outputs; i++) {
        times[i] = until * i / (scales_outputs - 1);
        c->truth(s, times[i], truth[i]);
    }
    for (size_t k = 0; k < m; k++) e[k] = o->system->coordinate[k].q, e[m + k] = o->rho[k];
    nh_state initial = {.q = q, .v = v};
    nh_trajectory_request r = {.model = o, .initial = &initial, .count = scales_outputs, .times = times, .options = &options, .n = n, .e = e};
    nh_accuracy a;
    nh_trajectory *t = nh_trajectory_accurate(&r, eps, NULL, &a, &error);
    must(t != NULL, &error, c->name);
    for (size_t k = 0; k < n && t->motion->complete; k++) {
        double size = 0, off = 0;
        for (int i = 0; i < scales_outputs; i++) {
            size = fmax(size, fabs(truth[i][k]));
            off = fmax(off, fabs(t->value[i * (int)n + (int)k] - truth[i][k]));
        }
        if (size > 0 && off > 0) out.error = fmax(out.error, off / size);
        if (!(size > 0) && !isnan(truth[scales_outputs - 1][k])) out.error = fmax(out.error, off > 1e-14 * s->length * fmax(1, s->amplitude / s->time) * fmax(1, until) ? INFINITY : 0);
    }
    out.held = a.held;
    out.wrong = a.held && !(out.error < eps);
    snprintf(out.why, sizeof out.why, "%s", a.why);
    nh_trajectory_free(t);
    mechanics_clear(&x);
    return out;
}

#endif
