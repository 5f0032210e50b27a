/* papers_by: computations of single rows: both sides of an equation, by what the program prints. */
#ifndef NH_TESTS_PAPERS_BY_H
#define NH_TESTS_PAPERS_BY_H

#include <cjson/cJSON.h>

/* ---- small parts ---- */

static nh_ex coefficient(const document *d, const char *section, const char *label, const char *of) { return parsed(d, shown(d, section, label, of)); }

static double differ(const document *d, nh_ex got, nh_ex want)
{
    double a[points], b[points];
    evaluate(d, got, a);
    evaluate(d, want, b);
    return apart(a, b);
}

/* sum of products of pairs */
static nh_ex dot(const document *d, size_t n, const nh_ex *a, const nh_ex *b)
{
    nh_ex sum = nh_int(d->system->dag, 0);
    for (size_t i = 0; i < n; i++) sum = nh_add(d->system->dag, sum, nh_mul(d->system->dag, a[i], b[i]));
    return sum;
}

/* e on the constraint submanifold: the velocity of `name` replaced by its normal form. */
static nh_ex inserted(const document *d, nh_ex e, const char *velocity)
{
    nh_ex v = parsed(d, velocity), g = coefficient(d, "normal_form", velocity, "");
    return nh_substitute(d->system->dag, e, 1, &v, &g);
}

/* Gamma(e), Gamma as printed. */
static nh_ex rate(const document *d, nh_ex e)
{
    nh_dag *g = d->system->dag;
    nh_ex sum = nh_int(g, 0);
    for (size_t i = 0; i < d->symbols; i++) {
        char of[80];
        snprintf(of, sizeof of, "d/d%s", nh_name_of(g, d->symbol[i]));
        sum = nh_add(g, sum, nh_mul(g, coefficient(d, "semispray", "Gamma", of), nh_diff(g, e, d->symbol[i])));
    }
    return sum;
}

/* ---- the sleigh ---- */

static const char *const FREE[2] = {"phi", "x"};

static double euler(const document *d)
{
    static const char *const factor[3] = {"", "phi''", "x''"};
    double worst = 0;
    nh_dag *g = d->system->dag;
    for (size_t l = 0; l < 2; l++)
        for (size_t r = 0; r < 3; r++) {
            char first[40], second[40], A[20], B[20];
            snprintf(first, sizeof first, "eps_%s(Lbar)", FREE[l]);
            snprintf(second, sizeof second, "eps_%s(g^y)", FREE[l]);
            snprintf(A, sizeof A, "Abar_%s", FREE[l]);
            snprintf(B, sizeof B, "Bbar_%s,%s", FREE[l], r ? FREE[r - 1] : "");
            nh_ex left = nh_sub(g, coefficient(d, "euler_expressions", first, factor[r]),
                                nh_mul(g, coefficient(d, "lagrangian", "Lbar_y", ""), coefficient(d, "euler_expressions", second, factor[r])));
            worst = fmax(worst, differ(d, left, coefficient(d, "reduced_equations", r ? B : A, "")));
        }
    return worst;
}

/* Abar_s = A_s + A_y g_s + (B_sy + B_yy g_s) d'_c g/dt, all on the submanifold. */
static double projection(const document *d)
{
    nh_dag *g = d->system->dag;
    nh_ex normal = coefficient(d, "normal_form", "y'", ""), turn = along(d, "d'_c/dt", normal);
    double worst = 0;
    for (size_t l = 0; l < 2; l++) {
        char line[4] = {'#', (char)('0' + l), 0}, label[20], velocity[20];
        snprintf(label, sizeof label, "Abar_%s", FREE[l]);
        snprintf(velocity, sizeof velocity, "%s'", FREE[l]);
        nh_ex slope = nh_diff(g, normal, parsed(d, velocity)), inner = nh_add(g, coefficient(d, "chetaev_equations", line, "y''"), nh_mul(g, coefficient(d, "chetaev_equations", "#2", "y''"), slope));
        nh_ex e = nh_add(g, coefficient(d, "chetaev_equations", line, ""), nh_mul(g, coefficient(d, "chetaev_equations", "#2", ""), slope));
        e = nh_add(g, e, nh_mul(g, inner, turn));
        worst = fmax(worst, differ(d, inserted(d, e, "y'"), coefficient(d, "reduced_equations", label, "")));
    }
    return worst;
}

static double chetaev(const document *d)
{
    static const char *const names[3] = {"phi", "x", "y"};
    nh_dag *g = d->system->dag;
    double worst = 0;
    for (size_t i = 0; i < 3; i++) {
        char line[4] = {'#', (char)('0' + i), 0};
        nh_ex left = coefficient(d, "chetaev_equations", line, ""), right = nh_mul(g, coefficient(d, "chetaev_equations", line, "=mu"), coefficient(d, "chetaev_equations", "mu", "")), size;
        for (size_t r = 0; r < 3; r++) {
            char of[20], velocity[20];
            snprintf(of, sizeof of, "%s''", names[r]);
            snprintf(velocity, sizeof velocity, "%s'", names[r]);
            left = nh_add(g, left, nh_mul(g, coefficient(d, "chetaev_equations", line, of), rate(d, r == 2 ? coefficient(d, "normal_form", "y'", "") : parsed(d, velocity))));
        }
        size = parsed(d, "m*phi'*x'");
        worst = fmax(worst, differ(d, nh_add(g, inserted(d, left, "y'"), size), nh_add(g, right, size)));
    }
    return worst;
}

static double chetaev_field(const document *d)
{
    nh_dag *g = d->system->dag;
    nh_ex normal = coefficient(d, "normal_form", "y'", ""), e = nh_mul(g, normal, unknown(d, "Z^0"));
    e = nh_add(g, e, nh_mul(g, nh_diff(g, normal, parsed(d, "x'")), unknown(d, "zeta^x")));
    return differ(d, component(d, "y"), e);
}

/* F_1 = Z(Lbar_y) + (Lbar - pbar v) dZ^0/dy + pbar_l dZ^l/dy; g does not depend on y. */
static double lie_form(const document *d)
{
    nh_dag *g = d->system->dag;
    nh_ex sum = nh_int(g, 0), y = parsed(d, "y"), La = coefficient(d, "lagrangian", "Lbar_y", ""), inner = coefficient(d, "lagrangian", "Lbar", "");
    for (size_t i = 0; i < d->symbols; i++) {
        const char *name = nh_name_of(g, d->symbol[i]);
        char velocity[60];
        snprintf(velocity, sizeof velocity, "Z_%s", name);
        if (line_of(d, "symmetry", velocity)) sum = nh_add(g, sum, nh_mul(g, component(d, name), nh_diff(g, La, d->symbol[i])));
    }
    for (size_t l = 0; l < 2; l++) {
        char velocity[20], label[40];
        snprintf(velocity, sizeof velocity, "%s'", FREE[l]);
        snprintf(label, sizeof label, "dLbar/d%s", velocity);
        nh_ex p = coefficient(d, "lagrangian", label, "");
        inner = nh_sub(g, inner, nh_mul(g, p, parsed(d, velocity)));
        sum = nh_add(g, sum, nh_mul(g, p, nh_diff(g, component(d, FREE[l]), y)));
    }
    sum = nh_add(g, sum, nh_mul(g, inner, nh_diff(g, component(d, "t"), y)));
    return differ(d, coefficient(d, "currents", "F_1(Phi)", ""), sum);
}

static double current_of_field(const document *d)
{
    nh_dag *g = d->system->dag;
    nh_ex sum = nh_mul(g, coefficient(d, "lagrangian", "Lbar", ""), unknown(d, "Z^0"));
    for (size_t l = 0; l < 2; l++) {
        char label[20], name[20];
        snprintf(label, sizeof label, "dLbar/d%s'", FREE[l]);
        snprintf(name, sizeof name, "zeta^%s", FREE[l]);
        sum = nh_add(g, sum, nh_mul(g, coefficient(d, "lagrangian", label, ""), unknown(d, name)));
    }
    return differ(d, sum, parsed(d, shown(d, "question", "Phi", "")));
}

/* (15) as printed has X_l(g_s - X_s(g_l)) for X_l(g_s) - X_s(g_l) in the bracket of Z^0. */
static double equation_15(const document *d)
{
    nh_dag *g = d->system->dag;
    nh_ex normal = coefficient(d, "normal_form", "y'", ""), slope[2], more[2], factor = nh_mul(g, unknown(d, "Z^0"), coefficient(d, "lagrangian", "Lbar_y", ""));
    static const char *const label[2] = {"d_c/dphi", "d_c/dx"}, *const velocity[2] = {"phi'", "x'"};
    for (size_t s = 0; s < 2; s++) slope[s] = nh_diff(g, normal, parsed(d, velocity[s]));
    for (size_t l = 0; l < 2; l++) {
        more[l] = nh_int(g, 0);
        for (size_t s = 0; s < 2; s++) {
            nh_ex turn = along(d, label[s], slope[l]);
            more[l] = nh_add(g, more[l], nh_mul(g, parsed(d, velocity[s]), nh_sub(g, along(d, label[l], turn), turn)));
        }
        more[l] = nh_mul(g, factor, more[l]);
    }
    return violation(d, "15", more);
}

/* The determining equations as they are printed for a constraint with eps'_l(g) = 0: the largest left side beside its terms. */
static double semiholonomic(const document *d)
{
    enum { terms = 8 };
    nh_dag *g = d->system->dag;
    nh_ex Lbar = coefficient(d, "lagrangian", "Lbar", ""), time = component(d, "t"), energy = nh_neg(g, Lbar), v[2], p[2], Z[2], slide[2];
    double worst = 0;
    for (size_t l = 0; l < 2; l++) {
        char name[40];
        snprintf(name, sizeof name, "%s'", FREE[l]);
        v[l] = parsed(d, name);
        p[l] = nh_diff(g, Lbar, v[l]);
        Z[l] = component(d, FREE[l]);
        slide[l] = nh_sub(g, Z[l], nh_mul(g, v[l], time));
        energy = nh_add(g, energy, nh_mul(g, p[l], v[l]));
    }
    for (size_t k = 0; k < 5; k++) { /* one; two for l; two for l */
        nh_ex term[terms];
        size_t n = 0, l = (k + 1) % 2;
        char by[40];
        snprintf(by, sizeof by, k ? "d_c/d%s" : "d'_c/dt", FREE[l]);
        if (k < 3) {
            term[n++] = nh_mul(g, along(d, "d'_c/dt", k ? p[l] : Lbar), time);
            term[n++] = nh_neg(g, nh_mul(g, energy, along(d, by, time)));
        } else {
            term[n++] = nh_neg(g, nh_mul(g, energy, nh_diff(g, time, v[l])));
        }
        for (size_t s = 0; s < 2; s++) {
            char over[40], velocity[40];
            snprintf(over, sizeof over, "d_c/d%s", FREE[s]);
            snprintf(velocity, sizeof velocity, "%s'", FREE[s]);
            if (k < 3) term[n++] = nh_mul(g, along(d, over, k ? p[l] : Lbar), slide[s]);
            if (k == 1 || k == 2) term[n++] = nh_mul(g, component(d, velocity), nh_diff(g, p[l], v[s]));
            term[n++] = nh_mul(g, p[s], k < 3 ? along(d, by, Z[s]) : nh_diff(g, Z[s], v[l]));
        }
        double sum[points] = {0}, size[points] = {0}, value[points];
        for (size_t i = 0; i < n; i++) {
            evaluate(d, term[i], value);
            for (size_t q = 0; q < points; q++) sum[q] += value[q], size[q] += fabs(value[q]);
        }
        for (size_t q = 0; q < points; q++) worst = fmax(worst, fabs(sum[q]) / size[q]);
    }
    return worst;
}

static void equation_24(const document *d, double *printed, double *meant)
{
    nh_dag *g = d->system->dag;
    nh_ex time = nh_add(g, coefficient(d, "currents", "[Gamma,Z(Phi)]", "d/dt"), coefficient(d, "currents", "[Gamma,Z(Phi)]", "Gamma")), turned = rate(d, component(d, "t"));
    *printed = differ(d, time, nh_neg(g, turned));
    *meant = differ(d, time, turned);
}

static void equation_32(const document *d, double *printed, double *meant)
{
    nh_dag *g = d->system->dag;
    nh_ex rest = parsed(d, "m*sin(phi)*phi'*x'/cos(phi)^3"), mass = parsed(d, "-m/cos(phi)^2"), force = parsed(d, "m*a*phi'^2/cos(phi)");
    *printed = differ(d, nh_mul(g, mass, rate(d, parsed(d, "phi'"))), rest);
    *meant = differ(d, nh_mul(g, mass, rate(d, parsed(d, "x'"))), nh_sub(g, rest, force));
}

static double equation_34(const document *d)
{
    nh_dag *g = d->system->dag;
    nh_ex e = coefficient(d, "determining_equations", "(18, phi)", "Z^0");
    e = nh_sub(g, e, nh_mul(g, parsed(d, "x'"), coefficient(d, "determining_equations", "(18, phi)", "zeta^x")));
    e = nh_sub(g, e, nh_mul(g, parsed(d, "phi'"), coefficient(d, "determining_equations", "(18, phi)", "zeta^phi")));
    return differ(d, e, parsed(d, "m*x'^2*tan(phi)/cos(phi)^2"));
}

static double parameter_of(const document *d, const char *name)
{
    for (size_t i = 0; i < d->system->parameters; i++)
        if (!strcmp(d->system->parameter[i].name, name)) return d->system->parameter[i].value;
    return NAN;
}

static size_t place_of_symbol(const document *d, const char *name)
{
    nh_ex e = parsed(d, name);
    for (size_t i = 0; i < d->symbols; i++)
        if (d->symbol[i] == e) return i;
    stop("no symbol", name);
    return 0;
}

static void set(document *d, size_t p, const char *name, double value)
{
    nh_ex e = parsed(d, name);
    for (size_t i = 0; i < d->symbols; i++)
        if (d->symbol[i] == e) d->value[p][i] = value;
}

/* Gamma along (33): phi = k asin tanh tau, v = x'/cos phi = a k omega_0 tanh tau, tau = omega_0 t/k. */
static double motion(const document *from)
{
    static document d;
    double a = parameter_of(from, "a"), k = parameter_of(from, "k"), w0 = 1.3, got[2][points], want[2][points];
    d = *from;
    for (size_t p = 0; p < points; p++) {
        double tau = 0.05 + 0.06 * (double)p, ch = cosh(tau), phi = k * asin(tanh(tau)), w = w0 / ch, v = a * k * w0 * tanh(tau);
        set(&d, p, "phi", phi);
        set(&d, p, "phi'", w);
        set(&d, p, "x'", v * cos(phi));
        want[0][p] = -w0 * w0 / k * sinh(tau) / (ch * ch);
        want[1][p] = a * w0 * w0 * cos(phi) / (ch * ch) - v * sin(phi) * w;
    }
    evaluate(&d, coefficient(&d, "semispray", "Gamma", "d/dphi'"), got[0]);
    evaluate(&d, coefficient(&d, "semispray", "Gamma", "d/dx'"), got[1]);
    return fmax(apart(got[0], want[0]), apart(got[1], want[1]));
}

/* ---- (25)-(27) ---- */

/* |sum of terms| / sum of |terms| */
static double residual(const document *d, size_t n, const nh_ex *term)
{
    double sum[points] = {0}, size[points] = {0}, value[points], worst = 0;
    for (size_t i = 0; i < n; i++) {
        evaluate(d, term[i], value);
        for (size_t p = 0; p < points; p++) sum[p] += value[p], size[p] += fabs(value[p]);
    }
    for (size_t p = 0; p < points; p++) worst = fmax(worst, size[p] > 0 ? fabs(sum[p]) / size[p] : 0);
    return worst;
}

/* Of f Gamma with f = 1/Lbar, which is a constraint symmetry of case 1; or of d/dt, the field of minus the energy. */
typedef struct {
    nh_ex zero, place[2], velocity[2], v[2], rise[2]; /* Z^0, Z^l, Ztilde^l; rise: (B A)^l = -Gamma^l */
} case_1;

static case_1 motion_or_time(const document *d, bool time)
{
    nh_dag *g = d->system->dag;
    case_1 z = {.zero = nh_pow(g, coefficient(d, "lagrangian", "Lbar", ""), nh_int(g, -1))};
    if (time) z.zero = nh_int(g, 1);
    for (size_t l = 0; l < 2; l++) {
        char name[20];
        snprintf(name, sizeof name, "%s'", FREE[l]);
        z.v[l] = parsed(d, name);
        z.rise[l] = nh_neg(g, rate(d, z.v[l]));
        z.place[l] = time ? nh_int(g, 0) : nh_mul(g, z.zero, z.v[l]);
        z.velocity[l] = time ? nh_int(g, 0) : nh_neg(g, nh_mul(g, z.zero, z.rise[l]));
    }
    return z;
}

/* (d'_c/dt - (BA)^s d/dv^s)(Z^l - v^l Z^0) - (BA)^l Z^0 - Ztilde^l */
static double equation_25(const document *d)
{
    nh_dag *g = d->system->dag;
    double worst = 0;
    for (size_t k = 0; k < 2; k++)
        for (size_t l = 0; l < 2; l++) {
            case_1 z = motion_or_time(d, k);
            nh_ex slide = nh_sub(g, z.place[l], nh_mul(g, z.v[l], z.zero));
            worst = fmax(worst, residual(d, 3, (nh_ex[]){rate(d, slide), nh_neg(g, nh_mul(g, z.rise[l], z.zero)), nh_neg(g, z.velocity[l])}));
        }
    return worst;
}

/* -d'_c((BA)^l Z^0)/dt - (Z^s - v^s Z^0) d_c(BA)^l/dq^s + Ztilde^s d(BA)^l/dv^s - d'_c Ztilde^l/dt + (BA)^s dZtilde^l/dv^s
 * + (BA)^l (BA)^s dZ^0/dv^s; right is -Ztilde^s d(BA)^l/dv^s. */
static double equation_27(const document *d, bool printed)
{
    static const char *const X[2] = {"d_c/dphi", "d_c/dx"};
    nh_dag *g = d->system->dag;
    case_1 z = motion_or_time(d, false);
    double worst = 0;
    for (size_t l = 0; l < 2; l++) {
        nh_ex term[10];
        size_t n = 0;
        term[n++] = nh_neg(g, along(d, "d'_c/dt", nh_mul(g, z.rise[l], z.zero)));
        term[n++] = nh_neg(g, along(d, "d'_c/dt", z.velocity[l]));
        for (size_t s = 0; s < 2; s++) {
            nh_ex bend = nh_mul(g, z.velocity[s], nh_diff(g, z.rise[l], z.v[s])), slide = nh_sub(g, z.place[s], nh_mul(g, z.v[s], z.zero));
            term[n++] = nh_neg(g, nh_mul(g, slide, along(d, X[s], z.rise[l])));
            term[n++] = printed ? bend : nh_neg(g, bend);
            term[n++] = nh_mul(g, z.rise[s], nh_diff(g, z.velocity[l], z.v[s]));
            term[n++] = nh_mul(g, z.rise[l], nh_mul(g, z.rise[s], nh_diff(g, z.zero, z.v[s])));
        }
        worst = fmax(worst, residual(d, n, term));
    }
    return worst;
}

/* Before (25): Xi = a Gamma with Xi^0 = a, and along velocities -B A, where a factor a is missing: of Gamma/Lbar. */
static double before_25(const document *d, bool printed)
{
    nh_dag *g = d->system->dag;
    case_1 z = motion_or_time(d, false);
    nh_ex a = rate(d, z.zero);
    double worst = 0;
    for (size_t l = 0; l < 2; l++) {
        /* [Gamma, f Gamma]~^l = Gamma(f Gamma^l) - f Gamma(Gamma^l) */
        nh_ex speed = nh_neg(g, z.rise[l]), right = printed ? speed : nh_mul(g, a, speed);
        worst = fmax(worst, residual(d, 3, (nh_ex[]){rate(d, z.velocity[l]), nh_neg(g, nh_mul(g, z.zero, rate(d, speed))), nh_neg(g, right)}));
    }
    return worst;
}

/* (24), last line: [Z,Gamma]~^l = Z^0 d'_c(-BA)^l/dt + (Z^s - v^s Z^0) d_c(-BA)^l/dq^s + Ztilde^s d(-BA)^l/dv^s - d'_c Ztilde^l/dt
 * + (BA)^s dZtilde^l/dv^s; printed has the second derivative by a velocity. */
static double last_of_24(const document *d, bool printed)
{
    static const char *const X[2] = {"d_c/dphi", "d_c/dx"};
    nh_dag *g = d->system->dag;
    double worst = 0;
    for (size_t l = 0; l < 2; l++) {
        char name[20], of[20];
        snprintf(name, sizeof name, "%s'", FREE[l]);
        snprintf(of, sizeof of, "d/d%s'", FREE[l]);
        nh_ex speed = rate(d, parsed(d, name)), sum = nh_mul(g, unknown(d, "Z^0"), along(d, "d'_c/dt", speed));
        for (size_t s = 0; s < 2; s++) {
            snprintf(name, sizeof name, "zeta^%s", FREE[s]);
            nh_ex slide = unknown(d, name);
            snprintf(name, sizeof name, "%s'", FREE[s]);
            nh_ex v = parsed(d, name);
            sum = nh_add(g, sum, nh_mul(g, slide, printed ? nh_diff(g, speed, v) : along(d, X[s], speed)));
            sum = nh_add(g, sum, nh_mul(g, component(d, name), nh_diff(g, speed, v)));
        }
        snprintf(name, sizeof name, "%s'", FREE[l]);
        sum = nh_sub(g, sum, rate(d, component(d, name)));
        nh_ex got = coefficient(d, "currents", "[Gamma,Z(Phi)]", of), motion = coefficient(d, "currents", "[Gamma,Z(Phi)]", "Gamma");
        got = nh_add(g, got, nh_mul(g, motion, speed));
        worst = fmax(worst, differ(d, nh_neg(g, sum), got));
    }
    return worst;
}

/* (26), and the third line of (24): (Z^l - v^l Z^0) eps'_l(g) - v^l Z^0 (BA)^s g_ls, where [Gamma,Z] lies in the canonical distribution; right is
 * (Z^l - v^l Z^0) (eps'_l(g) + g_ls (BA)^s). */
static double equation_26(const document *d, const char *const *q, const char *root, const char *dependent, bool printed)
{
    nh_dag *g = d->system->dag;
    nh_ex term[8];
    size_t n = 0;
    for (size_t l = 0; l < 2; l++) {
        char name[40], label[40];
        snprintf(name, sizeof name, "zeta^%s", q[l]);
        nh_ex slide = unknown(d, name);
        snprintf(label, sizeof label, "eps_%s(g^%s)", q[l], dependent);
        term[n++] = nh_mul(g, slide, coefficient(d, "euler_expressions", label, ""));
        for (size_t s = 0; s < 2; s++) {
            snprintf(name, sizeof name, "%s''", q[s]);
            nh_ex bend = nh_neg(g, coefficient(d, "euler_expressions", label, name));
            snprintf(name, sizeof name, "d/d%s'", q[s]);
            nh_ex rise = nh_neg(g, coefficient(d, "semispray", "Gamma", name));
            snprintf(name, sizeof name, "%s'", q[l]);
            nh_ex before = printed ? nh_neg(g, nh_mul(g, parsed(d, name), unknown(d, "Z^0"))) : slide;
            term[n++] = nh_mul(g, before, nh_mul(g, rise, bend));
        }
    }
    if (root)
        for (size_t i = 0; i < n; i++) term[i] = inserted(d, term[i], root);
    return residual(d, n, term);
}

static void both_26(const document *d, double *printed, double *meant)
{
    static const char *const q[2] = {"y", "z"};
    *printed = equation_26(d, q, "x'", "x", true);
    *meant = equation_26(d, q, "x'", "x", false);
}

/* ---- the nonlinear constraint: y and z are free, x' a root ---- */

static void equation_22(const document *d, double *printed, double *meant)
{
    static const char *const q[2] = {"y", "z"}, *const X[2] = {"d_c/dy", "d_c/dz"};
    nh_dag *g = d->system->dag;
    nh_ex inverse[4], bend[4], G[4], turn[2], A[2], slope[2], zeta[2], w[2], Phi = parsed(d, shown(d, "question", "Phi", "")), sum = nh_int(g, 0), right = sum;
    Phi = inserted(d, Phi, "x'");
    for (size_t l = 0; l < 2; l++) {
        char label[40], of[20];
        snprintf(of, sizeof of, "%s'", q[l]);
        w[l] = parsed(d, of);
        slope[l] = nh_diff(g, Phi, w[l]);
        snprintf(label, sizeof label, "Abar_%s", q[l]);
        A[l] = coefficient(d, "reduced_equations", label, "");
        snprintf(label, sizeof label, "eps_%s(g^x)", q[l]);
        turn[l] = coefficient(d, "euler_expressions", label, "");
        for (size_t s = 0; s < 2; s++) {
            snprintf(of, sizeof of, "%s''", q[s]);
            bend[2 * l + s] = nh_neg(g, coefficient(d, "euler_expressions", label, of));
            char name[40];
            snprintf(name, sizeof name, "(Bbar^-1)_%s,%s", q[l < s ? l : s], q[l < s ? s : l]);
            inverse[2 * l + s] = coefficient(d, "reduced_equations", name, "");
            G[2 * l + s] = nh_int(g, 0);
        }
    }
    G[1] = coefficient(d, "reduced_equations", "G_y,z", "");
    G[2] = nh_neg(g, G[1]);
    for (size_t l = 0; l < 2; l++) zeta[l] = nh_neg(g, dot(d, 2, inverse + 2 * l, slope));
    for (size_t l = 0; l < 2; l++)
        for (size_t s = 0; s < 2; s++) {
            nh_ex inner = nh_mul(g, turn[l], slope[s]), lift = along(d, X[s], Phi);
            for (size_t r = 0; r < 2; r++) lift = nh_add(g, lift, nh_mul(g, zeta[r], G[2 * r + s])); /* - dPhi/dq'^v B^rv = zeta^r */
            for (size_t p = 0; p < 2; p++) inner = nh_add(g, inner, nh_mul(g, nh_mul(g, w[p], bend[2 * p + l]), lift));
            sum = nh_add(g, sum, nh_mul(g, inverse[2 * l + s], inner));
        }
    for (size_t l = 0; l < 2; l++) {
        nh_ex inner = turn[l];
        for (size_t r = 0; r < 2; r++) inner = nh_add(g, inner, nh_mul(g, bend[2 * l + r], dot(d, 2, inverse + 2 * r, A)));
        right = nh_sub(g, right, nh_mul(g, zeta[l], inner));
    }
    nh_ex form = inserted(d, coefficient(d, "currents", "i_[Gamma,Z(Phi)]phi^1", ""), "x'");
    *printed = differ(d, inserted(d, sum, "x'"), form);
    *meant = differ(d, inserted(d, right, "x'"), form);
}

/* ---- the crane ---- */

static double crane_hamiltonian(const document *d)
{
    static const char *const q[4] = {"psi1", "phi1", "psi2", "phi2"};
    nh_dag *g = d->system->dag;
    nh_ex p[4], v[4], twice, H = nh_int(g, 0);
    char label[60];
    for (size_t i = 0; i < 4; i++) {
        p[i] = nh_int(g, 0);
        for (size_t j = 0; j < 4; j++) {
            snprintf(label, sizeof label, "%s'", q[j]);
            v[j] = parsed(d, label);
            snprintf(label, sizeof label, "Khat_%s,%s", q[i < j ? i : j], q[i < j ? j : i]);
            p[i] = nh_add(g, p[i], nh_mul(g, coefficient(d, "1.hamiltonian", label, ""), v[j]));
        }
    }
    twice = dot(d, 4, p, v);
    for (size_t i = 0; i < 4; i++)
        for (size_t j = i; j < 4; j++) {
            snprintf(label, sizeof label, i == j ? "p_%s^2" : "p_%s p_%s", q[i], q[j]);
            H = nh_add(g, H, nh_mul(g, coefficient(d, "1.hamiltonian", "Hhat", label), nh_mul(g, p[i], p[j])));
        }
    return differ(d, nh_mul(g, nh_int(g, 2), H), twice);
}

/* x' = dH/dp and p' = -dH/dx + Upsilon x', with the printed H, Upsilon and rates, at p = Khat x'. */
static double crane_equations(const document *d)
{
    static const char *const q[4] = {"psi1", "phi1", "psi2", "phi2"};
    nh_dag *g = d->system->dag;
    nh_ex p[4], v[4], c[4][4];
    double worst = 0;
    char label[60];
    for (size_t i = 0; i < 4; i++) {
        p[i] = nh_int(g, 0);
        for (size_t j = 0; j < 4; j++) {
            snprintf(label, sizeof label, "%s'", q[j]);
            v[j] = parsed(d, label);
            snprintf(label, sizeof label, "Khat_%s,%s", q[i < j ? i : j], q[i < j ? j : i]);
            p[i] = nh_add(g, p[i], nh_mul(g, coefficient(d, "1.hamiltonian", label, ""), v[j]));
            snprintf(label, sizeof label, i == j ? "p_%s^2" : "p_%s p_%s", q[i < j ? i : j], q[i < j ? j : i]);
            c[i][j] = coefficient(d, "1.hamiltonian", "Hhat", label);
        }
    }
    for (size_t i = 0; i < 4; i++) {
        nh_ex slope = nh_int(g, 0), force = nh_int(g, 0);
        for (size_t j = 0; j < 4; j++) {
            slope = nh_add(g, slope, nh_mul(g, nh_mul(g, nh_int(g, i == j ? 2 : 1), c[i][j]), p[j]));
            for (size_t k = j; k < 4; k++)
                force = nh_sub(g, force, nh_mul(g, nh_diff(g, c[j][k], parsed(d, q[i])), nh_mul(g, p[j], p[k])));
        }
        for (size_t k = 0; k < 4 && i % 2 == 0; k++) { /* Upsilon_psi1,psi2: psi1 is 0, psi2 is 2 */
            nh_ex part = nh_mul(g, coefficient(d, "1.gyroscopic_form", "Upsilon_psi1,psi2", nh_name_of(g, v[k])), nh_mul(g, v[k], v[2 - i]));
            force = i == 0 ? nh_add(g, force, part) : nh_sub(g, force, part);
        }
        snprintf(label, sizeof label, "p_%s'", q[i]);
        nh_ex size = nh_mul(g, p[0], v[0]), rate = coefficient(d, "1.stage", label, "");
        worst = fmax(worst, fmax(differ(d, slope, v[i]), differ(d, nh_add(g, force, size), nh_add(g, rate, size))));
    }
    return worst;
}

static double upsilon(const document *d)
{
    static const char *const q[4] = {"psi1'", "phi1'", "psi2'", "phi2'"};
    static const char *const vector[4] = {"-b*(c - l*sin(psi1))", "0", "-2*c*cos(psi1)", "-b*cos(psi1)"}; /* of x, y, psi3, theta */
    nh_dag *g = d->system->dag;
    nh_ex left = nh_int(g, 0), right = left;
    for (size_t k = 0; k < 4; k++) {
        left = nh_add(g, left, nh_mul(g, coefficient(d, "1.gyroscopic_form", "Upsilon_psi1,psi2", q[k]), parsed(d, q[k])));
        for (size_t a = 0; a < 4; a++) {
            char label[10];
            snprintf(label, sizeof label, "J_%zu", a + 1);
            nh_ex J = nh_mul(g, coefficient(d, "1.gyroscopic_form", label, q[k]), parsed(d, q[k]));
            right = nh_add(g, right, nh_mul(g, J, nh_mul(g, parsed(d, vector[a]), parsed(d, "l/" DELTA "^2"))));
        }
    }
    return differ(d, left, right);
}

static cJSON *reference(const char *name)
{
    char path[120];
    snprintf(path, sizeof path, "tests/data/%s", name);
    FILE *file = fopen(path, "rb");
    if (!file) stop("cannot read", path);
    fseek(file, 0, SEEK_END);
    size_t length = (size_t)ftell(file);
    rewind(file);
    char *text = calloc(length + 1, 1);
    if (!text || fread(text, 1, length, file) != length) stop("cannot read", path);
    fclose(file);
    cJSON *root = cJSON_Parse(text);
    free(text);
    return root;
}

/* Numbers, or lists of them, or texts: flat. */
static size_t flat(const cJSON *item, double *out)
{
    size_t n = 0;
    if (!cJSON_IsArray(item)) return *out = cJSON_IsNumber(item) ? item->valuedouble : strtod(item->valuestring, NULL), 1;
    for (const cJSON *each = item->child; each; each = each->next) n += flat(each, out + n);
    return n;
}

/* The metric of the shipped crane, minus the coefficients of accelerations in Lagrange's equations, against independent values. */
static double crane_metric(const document *from)
{
    cJSON *data = reference("crane_oracle.json");
    const cJSON *one = cJSON_GetArrayItem(cJSON_GetObjectItem(data, "sets"), 0), *names = cJSON_GetObjectItem(data, "joint_coordinates"), *parameter;
    const cJSON *place = cJSON_GetObjectItem(one, "points");
    static document d;
    d = *from;
    double worst = 0, q[8], K[64], got[points];
    cJSON_ArrayForEach(parameter, cJSON_GetObjectItem(one, "params")) if (parameter_of(from, parameter->string) != parameter->valuedouble) stop("another value of", parameter->string);
    for (size_t i = 0; i < 8; i++)
        for (size_t j = 0; j < 8; j++) {
            char line[4] = {'#', (char)('0' + i), 0}, of[40];
            snprintf(of, sizeof of, "%s''", cJSON_GetArrayItem(names, (int)j)->valuestring);
            for (size_t k = 0; k < 8; k++)
                if (!strcmp(d.system->coordinate[k].name, cJSON_GetArrayItem(names, (int)i)->valuestring)) line[1] = (char)('0' + k);
            for (size_t p = 0; p < points; p++) {
                flat(cJSON_GetObjectItem(cJSON_GetArrayItem(place, (int)p), "q_full"), q);
                for (size_t k = 0; k < 8; k++) set(&d, p, cJSON_GetArrayItem(names, (int)k)->valuestring, q[k]);
            }
            evaluate(&d, coefficient(&d, "chetaev_equations", line, of), got);
            for (size_t p = 0; p < points; p++) {
                flat(cJSON_GetObjectItem(cJSON_GetArrayItem(place, (int)p), "K_full"), K);
                worst = fmax(worst, fabs(got[p] + K[i * 8 + j]) / (1 + fabs(K[i * 8 + j])));
            }
        }
    cJSON_Delete(data);
    return worst;
}

/* The printed momenta on the constraint submanifold, against K q' with independent values of K, and q' by the normal form. */
static double legendre(const document *from)
{
    cJSON *data = reference("crane_oracle.json");
    const cJSON *one = cJSON_GetArrayItem(cJSON_GetObjectItem(data, "sets"), 0), *names = cJSON_GetObjectItem(data, "joint_coordinates");
    static document d;
    d = *from;
    double worst = 0, q[8], K[64], got[points], v[8][points];
    char label[60];
    for (size_t p = 0; p < points; p++) {
        flat(cJSON_GetObjectItem(cJSON_GetArrayItem(cJSON_GetObjectItem(one, "points"), (int)p), "q_full"), q);
        for (size_t k = 0; k < 8; k++) set(&d, p, cJSON_GetArrayItem(names, (int)k)->valuestring, q[k]);
    }
    for (size_t k = 0; k < 8; k++) {
        snprintf(label, sizeof label, "%s'", cJSON_GetArrayItem(names, (int)k)->valuestring);
        evaluate(&d, line_of(&d, "normal_form", label) ? coefficient(&d, "normal_form", label, "") : parsed(&d, label), v[k]);
    }
    for (size_t i = 0; i < 8; i++) {
        double want[points];
        snprintf(label, sizeof label, "p_%s", cJSON_GetArrayItem(names, (int)i)->valuestring);
        if (!line_of(&d, "lagrangian", label)) stop("no momentum", label);
        evaluate(&d, coefficient(&d, "lagrangian", label, ""), got);
        for (size_t p = 0; p < points; p++) {
            flat(cJSON_GetObjectItem(cJSON_GetArrayItem(cJSON_GetObjectItem(one, "points"), (int)p), "K_full"), K);
            want[p] = 0;
            for (size_t k = 0; k < 8; k++) want[p] += K[i * 8 + k] * v[k][p];
        }
        worst = fmax(worst, apart(got, want));
    }
    cJSON_Delete(data);
    return worst;
}

/* ---- Euler's disk ---- */

/* Letters T, P, S, and 1, 2 behind @: accelerations of theta, varphi, psi; rates of the two components of eta = r psi' u. */
static nh_ex with_accelerations(const document *d, const char *text)
{
    static char whole[100000];
    static const char *const coordinate[3] = {"d/dtheta'", "d/dvarphi'", "d/dpsi'"};
    char *out = whole;
    for (const char *c = text; *c; c++) {
        const char *letter = *c == '@' ? strchr("TPS12", c[1]) : NULL;
        size_t room = sizeof whole - (size_t)(out - whole);
        if (!letter) *out++ = *c;
        else if (*letter == '1') out += snprintf(out, room, "(-r*((%s)*cos(varphi) - psi'*varphi'*sin(varphi)))", shown(d, "semispray", "Gamma", coordinate[2]));
        else if (*letter == '2') out += snprintf(out, room, "(-r*((%s)*sin(varphi) + psi'*varphi'*cos(varphi)))", shown(d, "semispray", "Gamma", coordinate[2]));
        else out += snprintf(out, room, "(%s)", shown(d, "semispray", "Gamma", coordinate[*letter == 'T' ? 0 : *letter == 'P' ? 1 : 2]));
        c += letter != NULL;
    }
    *out = 0;
    return parsed(d, whole);
}

#define FIRST(inertia) inertia "*(@S + @P*cos(theta) - theta'*varphi'*sin(theta)) + M*r^2*@S + M*r^2*(@P*cos(theta) - 2*theta'*varphi'*sin(theta))" \
    " - M*e*r^2/2*(@P*sin(theta) + 2*theta'*varphi'*cos(theta))"
#define SECOND "2*(M*r^2 + I3 - I1)*theta'*varphi'*sin(theta)*cos(theta) - (I1*sin(theta)^2 + (I3 + M*r^2)*cos(theta)^2)*@P" \
    " + M*r*cos(theta)*(@1*cos(varphi) + @2*sin(varphi)) + I3*(theta'*psi'*sin(theta) - @S*cos(theta))" \
    " - M*r*e/2*(r*e/2*(2*theta'*varphi'*sin(theta)*cos(theta) + @P*sin(theta)^2) + sin(theta)*(@1*cos(varphi) + @2*sin(varphi))" \
    " + 2*r*theta'*varphi'*(sin(theta)^2 - cos(theta)^2) - 2*r*@P*sin(theta)*cos(theta))"
#define THIRD "(I1 - I3 - M*r^2)*varphi'^2*sin(theta)*cos(theta) - I3*psi'*varphi'*sin(theta) - (I1 + M*r^2)*@T" \
    " + M*r*sin(theta)*(@2*cos(varphi) - @1*sin(varphi)) - M*g*r*cos(theta) + M*r*e/2*(r*e/2*varphi'^2*sin(theta)*cos(theta)" \
    " + r*varphi'^2*(sin(theta)^2 - cos(theta)^2) + cos(theta)*(@2*cos(varphi) - @1*sin(varphi)) + g*sin(theta) - r*e/2*@T)"

static double vanishes(const document *d, const char *text)
{
    nh_ex size = parsed(d, "M*r^2*theta'*varphi'"), e = with_accelerations(d, text);
    return differ(d, nh_add(d->system->dag, e, size), size);
}

/* A current that solves (51), by its accelerations: its rate, beside the largest of its terms. */
static double solves(const document *analyzed, const char *function)
{
    static const char *const coordinate[3][3] = {{"theta", "theta'", "@T"}, {"varphi", "varphi'", "@P"}, {"psi", "psi'", "@S"}};
    const document *d = document_of(D_ROLLING);
    nh_dag *g = d->system->dag;
    double worst = INFINITY;
    for (size_t i = 0; i < analyzed->lines; i++) {
        const char *text = analyzed->line[i].text;
        if (strncmp(text, "Phi", 3) || !strstr(text, " = ") || !strstr(text, function)) continue;
        nh_ex phi = parsed(d, text_with_names(analyzed, i)), sum = nh_int(g, 0), term = sum;
        for (size_t k = 0; k < 3; k++) {
            nh_ex v = parsed(d, coordinate[k][1]), by_q = nh_diff(g, phi, parsed(d, coordinate[k][0]));
            nh_ex by_v = nh_diff(g, phi, v);
            sum = nh_add(g, sum, nh_add(g, nh_mul(g, by_q, v), nh_mul(g, by_v, with_accelerations(d, coordinate[k][2]))));
            if (k == 0) term = nh_mul(g, by_q, v);
        }
        worst = differ(d, nh_add(g, sum, term), term);
    }
    return worst;
}

#define DISK_LAGRANGIAN "-M*g*r*sin(theta) + (I1 + M*r^2*e^2/4)/2*(theta'^2 + varphi'^2*sin(theta)^2) + M/2*(x1'^2 + x2'^2) + M*r^2*theta'^2/2" \
    " + M*r^2*varphi'^2*cos(theta)^2/2 + M*r*x1'*(theta'*sin(theta)*sin(varphi) - varphi'*cos(theta)*cos(varphi))" \
    " - M*r*x2'*(theta'*cos(varphi)*sin(theta) + varphi'*cos(theta)*sin(varphi)) + I3/2*(varphi'*cos(theta) + psi')^2" \
    " + M*r*e/2*(x1'*(varphi'*cos(varphi)*sin(theta) + theta'*sin(varphi)*cos(theta)) + x2'*(varphi'*sin(varphi)*sin(theta) - theta'*cos(theta)*cos(varphi))" \
    " - r*cos(theta)*sin(theta)*varphi'^2) - M*g*r*e/2*cos(theta)"

/* Lines of the form beside that of psi1, psi2. */
static double other_upsilon(const document *d)
{
    double count = line_of(d, "1.gyroscopic_form", "Upsilon_psi1,psi2") ? 0 : INFINITY;
    for (size_t i = 0; i < d->lines; i++)
        if (in_section(&d->line[i], heading_of("gyroscopic_form"), 1))
            count += !strncmp(d->line[i].text, "Upsilon_", 8) && !strncmp(strchr(d->line[i].text, ' '), " = ", 3) &&
                     strncmp(d->line[i].text, "Upsilon_psi1,psi2 = ", 20);
    return count;
}

/* alpha_theta = theta (dphi1 + a_1 dpsi1 + a_2 dpsi2): d a_2/dpsi1 - d a_1/dpsi2 = Xi, with a_i functions of the shape alone. */
static double basic(const document *d)
{
    nh_dag *g = d->system->dag;
    nh_ex a1 = coefficient(d, "2.level_set", "phat_psi1", "theta_1"), a2 = coefficient(d, "2.level_set", "phat_psi2", "theta_1");
    nh_ex phi1 = parsed(d, "phi1"), xi = coefficient(d, "2.magnetic_form", "Xi_psi1,psi2", "theta_1");
    if (nh_depends(g, a1, phi1) || nh_depends(g, a2, phi1)) return INFINITY;
    return differ(d, nh_sub(g, nh_diff(g, a2, parsed(d, "psi1")), nh_diff(g, a1, parsed(d, "psi2"))), xi);
}

/* Helmholtz's condition dF_i/dq'_j + dF_j/dq'_i = 0 of a force without accelerations, for i = j = x: by what it is violated. */
static double helmholtz(const document *d)
{
    nh_dag *g = d->system->dag;
    nh_ex slope = nh_diff(g, coefficient(d, "chetaev_equations", "F_x", ""), parsed(d, "x'"));
    return differ(d, nh_mul(g, nh_int(g, 2), slope), parsed(d, "-2*(k^2 - 1)/k^2*m*phi'*tan(phi)"));
}

#include "papers_figures.h"
#include "papers_variation.h"

#include "papers_stages.h"

/* ---- by name ---- */

/* (26): mu_3' of the sleigh whose group is the whole plane.  As printed only <mu_0, [omega_0, e_3]> = 0; right are <mu_1, -b_0(e_3, omega_1)>, too. */
static void equation_26_by_stages(const document *from, double *printed, double *meant)
{
    static document d;
    d = *from;
    nh_dag *g = d.system->dag;
    chained c = read_chain(&d);
    nh_ex sum = nh_int(g, 0), got = parsed(&d, shown(&d, "2.stage", "mu_3'", ""));
    for (size_t q = 0; q < c.n; q++)
        for (size_t k = 0; k < c.n; k++) {
            char omega[40], mu[40];
            if (c.b[2][q][k] == 0) continue;
            snprintf(omega, sizeof omega, "omega_%zu", q + 1);
            snprintf(mu, sizeof mu, "mu_%zu", k + 1);
            nh_ex turn = parsed(&d, shown(&d, "2.momenta_of_S", omega, "")), p = parsed(&d, shown(&d, "2.momenta_of_S", mu, ""));
            sum = nh_sub(g, sum, nh_mul(g, nh_int(g, (int64_t)c.b[2][q][k]), nh_mul(g, turn, p)));
        }
    for (size_t p = 0; p < points; p++) /* chi_1 = e_1, chi_2 = e_3 */
        set(&d, p, "nu_1", d.value[p][place_of_symbol(&d, "zeta1")]), set(&d, p, "nu_2", d.value[p][place_of_symbol(&d, "zeta3")]);
    bool same = !strcmp(shown(&d, "2.nonholonomic_connection", "chi_1", "e_1"), "1") && !strcmp(shown(&d, "2.nonholonomic_connection", "chi_2", "e_3"), "1");
    *printed = differ(&d, nh_int(g, 0), got);
    *meant = same ? differ(&d, sum, got) : INFINITY;
}

static void by(const row *r, const document *d, double *printed, double *meant)
{
    const char *what = r->by;
    if (!strcmp(what, "euler")) *printed = euler(d);
    else if (!strcmp(what, "helmholtz")) *printed = helmholtz(d);
    else if (!strcmp(what, "projection")) *printed = projection(d);
    else if (!strcmp(what, "chetaev")) *printed = chetaev(d);
    else if (!strcmp(what, "chetaev field")) *printed = chetaev_field(d);
    else if (!strcmp(what, "F")) *printed = lie_form(d);
    else if (!strcmp(what, "current")) *printed = current_of_field(d);
    else if (!strcmp(what, "15")) *printed = equation_15(d), *meant = violation(d, "15", NULL);
    else if (!strcmp(what, "semiholonomic")) *printed = semiholonomic(d);
    else if (!strcmp(what, "22")) equation_22(d, printed, meant);
    else if (!strcmp(what, "24")) equation_24(d, printed, meant);
    else if (!strcmp(what, "24 last")) *printed = last_of_24(d, true), *meant = last_of_24(d, false);
    else if (!strcmp(what, "before 25")) *printed = before_25(d, true), *meant = before_25(d, false);
    else if (!strcmp(what, "25")) *printed = equation_25(d);
    else if (!strcmp(what, "26")) *printed = equation_26(d, FREE, NULL, "y", true);
    else if (!strcmp(what, "26 nonlinear")) both_26(d, printed, meant);
    else if (!strcmp(what, "27")) *printed = equation_27(d, true), *meant = equation_27(d, false);
    else if (!strcmp(what, "32")) equation_32(d, printed, meant);
    else if (!strcmp(what, "34")) *printed = equation_34(d);
    else if (!strcmp(what, "33")) *printed = motion(d);
    else if (!strcmp(what, "crane metric")) *printed = crane_metric(d);
    else if (!strcmp(what, "crane hamiltonian")) *printed = crane_hamiltonian(d);
    else if (!strcmp(what, "crane equations")) *printed = crane_equations(d);
    else if (!strcmp(what, "legendre")) *printed = legendre(d);
    else if (!strcmp(what, "upsilon")) *printed = upsilon(d);
    else if (!strcmp(what, "other upsilon")) *printed = other_upsilon(d);
    else if (!strcmp(what, "basic")) *printed = basic(d);
    else if (!strcmp(what, "figure")) *printed = figure(d, r->part);
    else if (!strcmp(what, "stages")) by_stages(d, r->part, printed, meant);
    else if (!strcmp(what, "euler-poincare")) *printed = euler_poincare(d, 1);
    else if (!strcmp(what, "26 by stages")) equation_26_by_stages(d, printed, meant);
    else if (!strcmp(what, "solves")) *printed = solves(d, r->part);
    else if (!strcmp(what, "disk lagrangian")) *printed = differ(d, parsed(d, DISK_LAGRANGIAN), parsed(d, shown(d, "free", "L", "")));
    else if (!strcmp(what, "disk") && r->part[0] == '1') *printed = vanishes(d, FIRST("r*I3")), *meant = vanishes(d, FIRST("I3"));
    else if (!strcmp(what, "disk")) *printed = vanishes(d, r->part[0] == '2' ? SECOND : THIRD);
    else if (!by_variation(r, d, printed)) stop("no computation", what);
}

#endif
