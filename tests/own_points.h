/* own_points: the skates, wheels and points of tests/own.h: equations and integrals by hand. */
#ifndef NH_TESTS_OWN_POINTS_H
#define NH_TESTS_OWN_POINTS_H

#include "own.h"

/* ---- on a turntable ----
 *
 * r' = v e + W ez x r and r'' = v' e + v h' n + W ez x r', so r''.e = v' - W r'.n = v' - W^2 r.e.  With a = r.e, b = r.n
 * and d = h' - W: a' = v + d b, b' = -d a.  Where v' = -k a with a constant k, and h' is constant too,
 *
 *     d v - k b is constant, a'' = -(k + d^2) a. */

typedef struct {
    double a, b, d, v;
} own_table;

static inline own_table own_table_at(double x, double y, double h, double d, double v)
{
    return (own_table){x * cos(h) + y * sin(h), y * cos(h) - x * sin(h), d, v};
}

/* Of a'' = -square a, with the rate of a: a cos(wt) - a'/w sin(wt), also where square is negative. */
static inline double own_phase(double t, double a, double rate, double square)
{
    double w = sqrt(fabs(square));
    return square > 0 ? a * cos(w * t) - rate / w * sin(w * t) : a * cosh(w * t) - rate / w * sinh(w * t);
}

/* -- a skate, tied to the axle; z = x, y, h, v, h'; m r'' = lambda n - k r, J h'' = 0 -- */

#define SKATE_M 1.3
#define SKATE_J 0.4
#define SKATE_W 0.6
#define SKATE_K 2.1

static void skate_place(double t, const double *z, double *q, double *v)
{
    (void)t;
    for (int i = 0; i < 3; i++) q[i] = z[i];
    v[0] = z[3] * cos(z[2]) - SKATE_W * z[1];
    v[1] = z[3] * sin(z[2]) + SKATE_W * z[0];
    v[2] = z[4];
}

static own_table skate_table(const double *z) { return own_table_at(z[0], z[1], z[2], z[4] - SKATE_W, z[3]); }
static double skate_pull(void) { return SKATE_K / SKATE_M - SKATE_W * SKATE_W; } /* k above */

static void skate_rates(double t, const double *z, double *rate)
{
    double q[3];
    skate_place(t, z, q, rate);
    rate[3] = -skate_pull() * skate_table(z).a;
    rate[4] = 0;
}

static double skate_turn(double t, const double *z) { return (void)t, z[4]; }
static double skate_heading(double t, const double *z) { return z[2] - t * z[4]; }
/* Energy less W times the angular momentum: in axes that turn with the table nothing depends on time. */
static double skate_energy(double t, const double *z)
{
    double q[3], v[3];
    skate_place(t, z, q, v);
    return SKATE_M / 2 * (v[0] * v[0] + v[1] * v[1]) + SKATE_J / 2 * v[2] * v[2] +
           SKATE_K / 2 * (q[0] * q[0] + q[1] * q[1]) -
           SKATE_W * (SKATE_M * (q[0] * v[1] - q[1] * v[0]) + SKATE_J * v[2]);
}
static double skate_across(double t, const double *z)
{
    own_table s = skate_table(z);
    return (void)t, s.d * s.v - skate_pull() * s.b;
}
static double skate_phase(double t, const double *z)
{
    own_table s = skate_table(z);
    return own_phase(t, s.a, s.v + s.d * s.b, skate_pull() + s.d * s.d);
}

/* -- a wheel that rolls upright; z = x, y, h, p, h', p'; v = R p' --
 * m r'' = f, I p'' = -R f.e, J h'' = 0: (I + m R^2) p'' = m R W^2 a, so k = -c W^2 with c = m R^2/(I + m R^2). */

#define WHEEL_M 1.1
#define WHEEL_I 0.3
#define WHEEL_J 0.2
#define WHEEL_R 0.5
#define WHEEL_W 0.8
#define WHEEL_C (WHEEL_M * WHEEL_R * WHEEL_R / (WHEEL_I + WHEEL_M * WHEEL_R * WHEEL_R))

static void wheel_place(double t, const double *z, double *q, double *v)
{
    (void)t;
    for (int i = 0; i < 4; i++) q[i] = z[i];
    v[0] = WHEEL_R * z[5] * cos(z[2]) - WHEEL_W * z[1];
    v[1] = WHEEL_R * z[5] * sin(z[2]) + WHEEL_W * z[0];
    v[2] = z[4];
    v[3] = z[5];
}

static own_table wheel_table(const double *z) { return own_table_at(z[0], z[1], z[2], z[4] - WHEEL_W, WHEEL_R * z[5]); }

static void wheel_rates(double t, const double *z, double *rate)
{
    double q[4];
    wheel_place(t, z, q, rate);
    rate[4] = 0;
    rate[5] = WHEEL_C * WHEEL_W * WHEEL_W * wheel_table(z).a / WHEEL_R;
}

static double wheel_turn(double t, const double *z) { return (void)t, z[4]; }
static double wheel_heading(double t, const double *z) { return z[2] - t * z[4]; }
static double wheel_energy(double t, const double *z)
{
    double q[4], v[4];
    wheel_place(t, z, q, v);
    return WHEEL_M / 2 * (v[0] * v[0] + v[1] * v[1]) + WHEEL_J / 2 * v[2] * v[2] + WHEEL_I / 2 * v[3] * v[3] -
           WHEEL_W * (WHEEL_M * (q[0] * v[1] - q[1] * v[0]) + WHEEL_J * v[2]);
}
static double wheel_across(double t, const double *z)
{
    own_table s = wheel_table(z);
    return (void)t, s.d * s.v + WHEEL_C * WHEEL_W * WHEEL_W * s.b;
}
static double wheel_phase(double t, const double *z)
{
    own_table s = wheel_table(z);
    return own_phase(t, s.a, s.v + s.d * s.b, s.d * s.d - WHEEL_C * WHEEL_W * WHEEL_W);
}
/* R d p' = C - c W^2 b with the constant C, and a' = v + d b gives the integral of b. */
static double wheel_roll(double t, const double *z)
{
    own_table s = wheel_table(z);
    double C = wheel_across(t, z), g = WHEEL_C * WHEEL_W * WHEEL_W;
    return WHEEL_R * s.d * z[3] - C * t + g * (s.a - C * t / s.d) / (s.d - g / s.d);
}

/* ---- a disk that rolls upright on an inclined belt; z = x, y, h, p, h', p'; x downhill, the belt runs uphill ----
 *
 * x' + V = R p' cos(h), y' = R p' sin(h).  m r'' = F + m f ex, I p'' = -R F.e, J h'' = 0, f = g sin(slope):
 * (I + m R^2) p'' = m f R cos(h).  So p' = A + B sin(h) with A constant, B = m f R/((I + m R^2) h'). */

#define DISK_M 1.3
#define DISK_I 0.3
#define DISK_J 0.2
#define DISK_R 0.5
#define DISK_V 0.7
#define DISK_F (9.81 * sin(0.2))
#define DISK_B (DISK_M * DISK_F * DISK_R / (DISK_I + DISK_M * DISK_R * DISK_R)) /* times 1/h' */

static void disk_place(double t, const double *z, double *q, double *v)
{
    (void)t;
    for (int i = 0; i < 4; i++) q[i] = z[i];
    v[0] = DISK_R * z[5] * cos(z[2]) - DISK_V;
    v[1] = DISK_R * z[5] * sin(z[2]);
    v[2] = z[4];
    v[3] = z[5];
}

static void disk_rates(double t, const double *z, double *rate)
{
    double q[4];
    disk_place(t, z, q, rate);
    rate[4] = 0;
    rate[5] = DISK_B * cos(z[2]);
}

static double disk_turn(double t, const double *z) { return (void)t, z[4]; }
static double disk_heading(double t, const double *z) { return z[2] - t * z[4]; }
static double disk_product(double t, const double *z) { return (void)t, z[5] * z[4] - DISK_B * sin(z[2]); }
/* The energy that the belt sees. */
static double disk_energy(double t, const double *z)
{
    double q[4], v[4], along;
    disk_place(t, z, q, v);
    along = v[0] + DISK_V;
    return DISK_M / 2 * (along * along + v[1] * v[1]) + DISK_J / 2 * v[2] * v[2] + DISK_I / 2 * v[3] * v[3] -
           DISK_M * DISK_F * (q[0] + DISK_V * t);
}
/* p, y and x by quadratures over h = h0 + h' t. */
static double disk_roll(double t, const double *z)
{
    double w = z[4], B = DISK_B / w, A = z[5] - B * sin(z[2]);
    return z[3] - A * t + B * cos(z[2]) / w;
}
static double disk_y(double t, const double *z)
{
    double w = z[4], B = DISK_B / w, A = z[5] - B * sin(z[2]);
    return (void)t, z[1] + DISK_R / w * (A * cos(z[2]) - B * (z[2] / 2 - sin(2 * z[2]) / 4));
}
static double disk_x(double t, const double *z)
{
    double w = z[4], B = DISK_B / w, A = z[5] - B * sin(z[2]);
    return z[0] + DISK_V * t - DISK_R / w * (A * sin(z[2]) + B * sin(z[2]) * sin(z[2]) / 2);
}

/* ---- a point of constant speed c that a charged line attracts; z = x, y, h, the direction of its velocity ----
 *
 * The force -k r/r^2 turns the velocity, m c h' = F.n, and the motor or thermostat along it does the rest. */

#define STEADY_M 1.3
#define STEADY_C 1.2
#define STEADY_K 0.7

static void steady_rates(double t, const double *z, double *rate)
{
    (void)t;
    rate[0] = STEADY_C * cos(z[2]);
    rate[1] = STEADY_C * sin(z[2]);
    rate[2] = STEADY_K * (z[0] * sin(z[2]) - z[1] * cos(z[2])) / (STEADY_M * STEADY_C * (z[0] * z[0] + z[1] * z[1]));
}

static void steady_place(double t, const double *z, double *q, double *v)
{
    double rate[3];
    steady_rates(t, z, rate);
    for (int i = 0; i < 2; i++) q[i] = z[i], v[i] = rate[i];
}

/* F has no torque; the force -(F.v/c^2) v that keeps the speed has the torque U'/(m c^2) L: L exp(-U/(m c^2)), U = k log r. */
static double steady_turning(double t, const double *z)
{
    double q[2], v[2];
    steady_place(t, z, q, v);
    return (q[0] * v[1] - q[1] * v[0]) * pow(hypot(q[0], q[1]), -STEADY_K / (STEADY_M * STEADY_C * STEADY_C));
}
/* The angle s from the position to the velocity: h' = k sin(s)/(m c r), and the position turns at the rate c sin(s)/r. */
static double steady_direction(double t, const double *z)
{
    return (void)t, z[2] - STEADY_K / (STEADY_M * STEADY_C * STEADY_C) * atan2(z[1], z[0]);
}

/* ---- a point whose slope is given, z'^2 = c^2 (x'^2 + y'^2), on a spring along z; z = x, y, z, h, u ----
 *
 * x' + i y' = u exp(ih), z' = c u: u changes its sign where the point stops and goes back.  The reaction is along the
 * gradient (-c e, 1) of the constraint in the velocities: m u' = -c N, m u h' = 0, m c u' = -k z + N. */

#define SLOPED_M 1.3
#define SLOPED_C 0.8
#define SLOPED_K 2.0

static void sloped_place(double t, const double *z, double *q, double *v)
{
    (void)t;
    for (int i = 0; i < 3; i++) q[i] = z[i];
    v[0] = z[4] * cos(z[3]);
    v[1] = z[4] * sin(z[3]);
    v[2] = SLOPED_C * z[4];
}

static double sloped_square(void) { return SLOPED_K / SLOPED_M * SLOPED_C * SLOPED_C / (1 + SLOPED_C * SLOPED_C); }

static void sloped_rates(double t, const double *z, double *rate)
{
    double q[3];
    sloped_place(t, z, q, rate);
    rate[3] = 0;
    rate[4] = -sloped_square() / SLOPED_C * z[2];
}

static double sloped_energy(double t, const double *z)
{
    return (void)t, (SLOPED_M * (1 + SLOPED_C * SLOPED_C) * z[4] * z[4] + SLOPED_K * z[2] * z[2]) / 2;
}
static double sloped_direction(double t, const double *z) { return (void)t, z[3]; }
static double sloped_across(double t, const double *z) { return (void)t, z[0] * sin(z[3]) - z[1] * cos(z[3]); }
static double sloped_along(double t, const double *z)
{
    return (void)t, z[0] * cos(z[3]) + z[1] * sin(z[3]) - z[2] / SLOPED_C;
}
static double sloped_phase(double t, const double *z) { return own_phase(t, z[2], SLOPED_C * z[4], sloped_square()); }

#endif
