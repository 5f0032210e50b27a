/* own_bodies: the chains and the bodies about a fixed point of tests/own.h: equations and integrals by hand. */
#ifndef NH_TESTS_OWN_BODIES_H
#define NH_TESTS_OWN_BODIES_H

#include "own.h"

/* ---- chains of three point masses on two massless rods ----
 *
 * With the unit vectors f1, f2 along the rods, tensions S, T and a common acceleration `fall`:
 *
 *     m1 r1'' = m1 fall + S f1,   m2 r2'' = m2 fall - S f1 + T f2,   m3 r3'' = m3 fall - T f2,
 *     (r2'' - r1'').f1 = -l1 a'^2,   (r3'' - r2'').f2 = -l2 b'^2    (the lengths are constant),
 *
 * and l a'' is the rest across a rod.  On a rail along x only the first component of r1'' is not 0. */
typedef struct {
    double m[3], l[2], fall[2];
    bool rail;
} own_chain;

static inline double own_dot(const double a[2], const double b[2]) { return a[0] * b[0] + a[1] * b[1]; }

/* angle[2] from the x axis, and their rates: the acceleration of the first mass, and of the angles. */
static inline void own_chain_rates(const own_chain *c, const double angle[2], const double turn[2], double first[2],
                                   double turned[2])
{
    const double *m = c->m, free = c->rail ? 0 : 1;
    double f[2][2], n[2][2], r[3][2];
    for (int k = 0; k < 2; k++) {
        f[k][0] = cos(angle[k]), f[k][1] = sin(angle[k]);
        n[k][0] = -f[k][1], n[k][1] = f[k][0];
    }
    /* two linear equations for S, T; g: what gravity gives to the first rod where the rail holds the first mass */
    double cosine = own_dot(f[0], f[1]), g = c->rail ? c->fall[1] * f[0][1] : 0;
    double a = 1 / m[1] + (f[0][0] * f[0][0] + free * f[0][1] * f[0][1]) / m[0], d = 1 / m[1] + 1 / m[2],
           b = -cosine / m[1];
    double p = c->l[0] * turn[0] * turn[0] + g, q = c->l[1] * turn[1] * turn[1];
    double S = (p * d - b * q) / (a * d - b * b), T = (a * q - b * p) / (a * d - b * b);
    for (int i = 0; i < 2; i++) {
        r[0][i] = (i == 0 || !c->rail) ? c->fall[i] + S * f[0][i] / m[0] : 0;
        r[1][i] = c->fall[i] + (T * f[1][i] - S * f[0][i]) / m[1];
        r[2][i] = c->fall[i] - T * f[1][i] / m[2];
        first[i] = r[0][i];
    }
    for (int k = 0; k < 2; k++) turned[k] = (own_dot(r[k + 1], n[k]) - own_dot(r[k], n[k])) / c->l[k];
}

/* Positions and velocities of the three masses. */
static inline void own_chain_masses(const own_chain *c, const double first[2], const double speed[2],
                                    const double angle[2], const double turn[2], double r[3][2], double v[3][2])
{
    for (int i = 0; i < 2; i++) r[0][i] = first[i], v[0][i] = speed[i];
    for (int k = 0; k < 2; k++) {
        r[k + 1][0] = r[k][0] + c->l[k] * cos(angle[k]), r[k + 1][1] = r[k][1] + c->l[k] * sin(angle[k]);
        v[k + 1][0] = v[k][0] - c->l[k] * turn[k] * sin(angle[k]),
              v[k + 1][1] = v[k][1] + c->l[k] * turn[k] * cos(angle[k]);
    }
}

/* Sums over the masses: momentum, mass times position, angular momentum about the origin, energy. */
typedef struct {
    double mass, p[2], centre[2], turning, energy;
} own_sums;

static inline own_sums own_chain_sums(const own_chain *c, double r[3][2], double v[3][2])
{
    own_sums s = {0};
    for (int k = 0; k < 3; k++) {
        s.mass += c->m[k];
        for (int i = 0; i < 2; i++) s.p[i] += c->m[k] * v[k][i], s.centre[i] += c->m[k] * r[k][i];
        s.turning += c->m[k] * (r[k][0] * v[k][1] - r[k][1] * v[k][0]);
        s.energy += c->m[k] * (own_dot(v[k], v[k]) / 2 - own_dot(c->fall, r[k]));
    }
    return s;
}

/* -- afloat; z = x, y, a, b, their rates; b is the angle between the rods -- */

static const own_chain AFLOAT = {.m = {1.2, 0.7, 0.9}, .l = {0.8, 0.6}};

static void afloat_rates(double t, const double *z, double *rate)
{
    (void)t;
    double turned[2];
    own_chain_rates(&AFLOAT, (double[]){z[2], z[2] + z[3]}, (double[]){z[6], z[6] + z[7]}, rate + 4, turned);
    for (int i = 0; i < 4; i++) rate[i] = z[4 + i];
    rate[6] = turned[0];
    rate[7] = turned[1] - turned[0];
}

static void own_split(size_t n, const double *z, double *q, double *v)
{
    for (size_t i = 0; i < n; i++) q[i] = z[i], v[i] = z[n + i];
}

static void afloat_place(double t, const double *z, double *q, double *v) { (void)t, own_split(4, z, q, v); }

static own_sums afloat(const double *z)
{
    double r[3][2], v[3][2];
    own_chain_masses(&AFLOAT, z, z + 4, (double[]){z[2], z[2] + z[3]}, (double[]){z[6], z[6] + z[7]}, r, v);
    return own_chain_sums(&AFLOAT, r, v);
}

static double afloat_px(double t, const double *z) { return (void)t, afloat(z).p[0]; }
static double afloat_py(double t, const double *z) { return (void)t, afloat(z).p[1]; }
static double afloat_x(double t, const double *z)
{
    own_sums s = afloat(z);
    return s.centre[0] - t * s.p[0];
}
static double afloat_y(double t, const double *z)
{
    own_sums s = afloat(z);
    return s.centre[1] - t * s.p[1];
}
static double afloat_turning(double t, const double *z) { return (void)t, afloat(z).turning; }
static double afloat_energy(double t, const double *z) { return (void)t, afloat(z).energy; }

/* -- hung from a bead on an inclined rail; x downhill, y off the rail; z = s, a, b, their rates; a, b from -y -- */

#define SLOPE 0.3
static const own_chain *rail(void)
{
    static own_chain c = {.m = {1.5, 0.8, 0.5}, .l = {0.7, 0.4}, .rail = true};
    c.fall[0] = 9.81 * sin(SLOPE), c.fall[1] = -9.81 * cos(SLOPE);
    return &c;
}

static void rail_rates(double t, const double *z, double *rate)
{
    (void)t;
    double first[2];
    own_chain_rates(rail(), (double[]){z[1] - acos(0), z[2] - acos(0)}, z + 4, first, rate + 4);
    for (int i = 0; i < 3; i++) rate[i] = z[3 + i];
    rate[3] = first[0];
}

static void rail_place(double t, const double *z, double *q, double *v) { (void)t, own_split(3, z, q, v); }

static own_sums hung(const double *z)
{
    double r[3][2], v[3][2];
    own_chain_masses(rail(), (double[]){z[0], 0}, (double[]){z[3], 0}, (double[]){z[1] - acos(0), z[2] - acos(0)},
                     z + 4, r, v);
    return own_chain_sums(rail(), r, v);
}

/* Along the rail there is gravity alone: P' = M g sin(slope). */
static double rail_energy(double t, const double *z) { return (void)t, hung(z).energy; }
static double rail_momentum(double t, const double *z)
{
    own_sums s = hung(z);
    return s.p[0] - s.mass * rail()->fall[0] * t;
}
static double rail_centre(double t, const double *z)
{
    own_sums s = hung(z);
    return s.centre[0] - t * s.p[0] + s.mass * rail()->fall[0] * t * t / 2;
}

/* ---- bodies about a fixed point, in Euler's angles phi, theta, psi ----
 *
 * M' = M x w + torque, in axes of the body; a rotor on an axle of the body has the momentum J (w_i + u') about it, which
 * nothing changes: the axle has no friction. */

static void own_angles(const double angle[3], const double w[3], double rate[3])
{
    double s = sin(angle[2]), c = cos(angle[2]);
    rate[0] = (w[0] * s + w[1] * c) / sin(angle[1]);
    rate[1] = w[0] * c - w[1] * s;
    rate[2] = w[2] - rate[0] * cos(angle[1]);
}

static void own_cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++) out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* The components in space of a vector that the body sees as u: turned about z by psi, x by theta, z by phi. */
static void own_in_space(const double angle[3], const double u[3], double out[3])
{
    double x = u[0] * cos(angle[2]) - u[1] * sin(angle[2]), y = u[0] * sin(angle[2]) + u[1] * cos(angle[2]), z = u[2];
    double across = y * cos(angle[1]) - z * sin(angle[1]);
    out[2] = y * sin(angle[1]) + z * cos(angle[1]);
    out[0] = x * cos(angle[0]) - across * sin(angle[0]);
    out[1] = x * sin(angle[0]) + across * cos(angle[0]);
}

/* -- Suslov: w3 = 0, torque lambda about the third axis; z = phi, theta, psi, u, w1, w2, u' --
 * With M = (A w1 + J u', B w2, M3), M3 = D w1 + F w2, and p = J (w1 + u') constant:
 * (A - J) w1' = -M3 w2, B w2' = M3 w1. */

enum { SUSLOV_W = 4 };
#define SUSLOV_A 1.4
#define SUSLOV_B 1.1
#define SUSLOV_D 0.2
#define SUSLOV_F 0.15
#define SUSLOV_J 0.3

static void suslov_rates(double t, const double *z, double *rate)
{
    (void)t;
    const double *w = z + SUSLOV_W;
    double M3 = SUSLOV_D * w[0] + SUSLOV_F * w[1];
    own_angles(z, (double[]){w[0], w[1], 0}, rate);
    rate[3] = z[6];
    rate[4] = -M3 * w[1] / (SUSLOV_A - SUSLOV_J);
    rate[5] = M3 * w[0] / SUSLOV_B;
    rate[6] = -rate[4];
}

static void suslov_place(double t, const double *z, double *q, double *v)
{
    (void)t;
    own_angles(z, (double[]){z[4], z[5], 0}, v);
    for (int i = 0; i < 4; i++) q[i] = z[i];
    v[3] = z[6];
}

static double suslov_rotor(double t, const double *z) { return (void)t, SUSLOV_J * (z[4] + z[6]); }
static double suslov_energy(double t, const double *z)
{
    return (void)t, (SUSLOV_A * z[4] * z[4] + SUSLOV_B * z[5] * z[5]) / 2 + SUSLOV_J * z[6] * (z[4] + z[6] / 2);
}

/* With a = sqrt(A - J), b = sqrt(B), (a w1, b w2) = rho (cos k, sin k): rho is constant, k' = M3/(a b), which is
 * rho N cos(k - k0)/(a b) with N (cos k0, sin k0) = (D/a, F/b).  So artanh(sin(k - k0)) grows at the rate rho N/(a b). */
typedef struct {
    double a, b, rho, k, N, k0;
} suslov_turn;

static suslov_turn suslov_turning(const double *z)
{
    suslov_turn s = {.a = sqrt(SUSLOV_A - SUSLOV_J), .b = sqrt(SUSLOV_B)};
    s.rho = hypot(s.a * z[4], s.b * z[5]), s.k = atan2(s.b * z[5], s.a * z[4]);
    s.N = hypot(SUSLOV_D / s.a, SUSLOV_F / s.b), s.k0 = atan2(SUSLOV_F / s.b, SUSLOV_D / s.a);
    return s;
}

static double suslov_time(double t, const double *z)
{
    suslov_turn s = suslov_turning(z);
    return atanh(sin(s.k - s.k0)) - s.rho * s.N / (s.a * s.b) * t;
}

/* u' = p/J - w1, and w1 dt = b cos(k)/(N cos(k - k0)) dk with cos k = cos(k0) cos(k - k0) - sin(k0) sin(k - k0). */
static double suslov_angle(double t, const double *z)
{
    suslov_turn s = suslov_turning(z);
    return z[3] - suslov_rotor(t, z) / SUSLOV_J * t +
           s.b / s.N * (cos(s.k0) * s.k + sin(s.k0) * log(fabs(cos(s.k - s.k0))));
}

/* -- Veselova: w.g = 0 for the vertical g, torque lambda g; z = phi, theta, psi, u, theta', psi', u' --
 * phi' = -psi' cos(theta).  The torque is vertical: the horizontal momenta are constant. */

static const double VESELOVA[3] = {1.1, 1.7, 2.3};
#define VESELOVA_J 0.4

static void veselova_turn(const double *z, double w[3], double M[3])
{
    double st = sin(z[1]), ct = cos(z[1]), phi = -z[5] * ct;
    w[0] = phi * st * sin(z[2]) + z[4] * cos(z[2]);
    w[1] = phi * st * cos(z[2]) - z[4] * sin(z[2]);
    w[2] = phi * ct + z[5];
    for (int i = 0; i < 3; i++) M[i] = VESELOVA[i] * w[i];
    M[2] += VESELOVA_J * (w[2] + z[6]);
}

static void veselova_rates(double t, const double *z, double *rate)
{
    (void)t;
    double w[3], M[3], torque[3], dw[3], over = 0, under = 0, st = sin(z[1]), ct = cos(z[1]), s = sin(z[2]),
                                         c = cos(z[2]);
    double g[3] = {st * s, st * c, ct};
    veselova_turn(z, w, M);
    own_cross(M, w, torque);
    for (int i = 0; i < 3; i++) over += g[i] * torque[i] / VESELOVA[i], under += g[i] * g[i] / VESELOVA[i];
    for (int i = 0; i < 3; i++) dw[i] = (torque[i] - over / under * g[i]) / VESELOVA[i]; /* g' is across w: w'.g = 0 */
    rate[0] = -z[5] * ct;
    for (int i = 1; i < 4; i++) rate[i] = z[3 + i];
    rate[4] = dw[0] * c - dw[1] * s - z[5] * (w[0] * s + w[1] * c); /* theta' = w1 cos(psi) - w2 sin(psi) */
    rate[5] = (dw[2] - 2 * z[5] * z[4] * st * ct) / (st * st);      /* w3 = psi' sin(theta)^2 */
    rate[6] = -dw[2];
}

static void veselova_place(double t, const double *z, double *q, double *v)
{
    (void)t;
    for (int i = 0; i < 4; i++) q[i] = z[i];
    v[0] = -z[5] * cos(z[1]);
    for (int i = 1; i < 4; i++) v[i] = z[3 + i];
}

static double veselova_in_space(const double *z, int i)
{
    double w[3], M[3], space[3];
    veselova_turn(z, w, M);
    own_in_space(z, M, space);
    return space[i];
}
static double veselova_mx(double t, const double *z) { return (void)t, veselova_in_space(z, 0); }
static double veselova_my(double t, const double *z) { return (void)t, veselova_in_space(z, 1); }
static double veselova_rotor(double t, const double *z)
{
    double w[3], M[3];
    veselova_turn(z, w, M);
    return (void)t, VESELOVA_J * (w[2] + z[6]);
}
static double veselova_energy(double t, const double *z)
{
    double w[3], M[3], rotor = veselova_rotor(t, z), e = rotor * rotor / VESELOVA_J;
    veselova_turn(z, w, M);
    for (int i = 0; i < 3; i++) e += VESELOVA[i] * w[i] * w[i];
    return e / 2;
}

/* -- gyrostat with rotors on the first and third axis; z = phi, theta, psi, u, s, w1, w2, w3, u', s' --
 * No torque: the momentum in space is constant. */

static const double GYROSTAT[3] = {1.1, 1.6, 2.1};
#define GYROSTAT_J 0.3
#define GYROSTAT_K 0.4

static void gyrostat_momentum(const double *z, double M[3])
{
    for (int i = 0; i < 3; i++) M[i] = GYROSTAT[i] * z[5 + i];
    M[0] += GYROSTAT_J * (z[5] + z[8]);
    M[2] += GYROSTAT_K * (z[7] + z[9]);
}

static void gyrostat_rates(double t, const double *z, double *rate)
{
    (void)t;
    double M[3];
    gyrostat_momentum(z, M);
    own_angles(z, z + 5, rate);
    rate[3] = z[8];
    rate[4] = z[9];
    own_cross(M, z + 5, rate + 5);
    for (int i = 0; i < 3; i++) rate[5 + i] /= GYROSTAT[i];
    rate[8] = -rate[5];
    rate[9] = -rate[7];
}

static void gyrostat_place(double t, const double *z, double *q, double *v)
{
    (void)t;
    own_angles(z, z + 5, v);
    for (int i = 0; i < 5; i++) q[i] = z[i];
    v[3] = z[8];
    v[4] = z[9];
}

static double gyrostat_in_space(const double *z, int i)
{
    double M[3], space[3];
    gyrostat_momentum(z, M);
    own_in_space(z, M, space);
    return space[i];
}
static double gyrostat_mx(double t, const double *z) { return (void)t, gyrostat_in_space(z, 0); }
static double gyrostat_my(double t, const double *z) { return (void)t, gyrostat_in_space(z, 1); }
static double gyrostat_mz(double t, const double *z) { return (void)t, gyrostat_in_space(z, 2); }
static double gyrostat_rotor1(double t, const double *z) { return (void)t, z[5] + z[8]; }
static double gyrostat_rotor3(double t, const double *z) { return (void)t, z[7] + z[9]; }
static double gyrostat_square(double t, const double *z) /* a function of those in space */
{
    double M[3];
    gyrostat_momentum(z, M);
    return (void)t, M[0] * M[0] + M[1] * M[1] + M[2] * M[2];
}
static double gyrostat_energy(double t, const double *z)
{
    double e = GYROSTAT_J * pow(z[5] + z[8], 2) + GYROSTAT_K * pow(z[7] + z[9], 2);
    for (int i = 0; i < 3; i++) e += GYROSTAT[i] * z[5 + i] * z[5 + i];
    return (void)t, e / 2;
}

#endif
