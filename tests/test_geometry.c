/* Every identity of the geometry, for every kind of constraint, in every chart: closed forms against the general formulas. */
#include "sheet.h"
#include "sweep.h"

#include <stdio.h>

#include "exact/normal.h"
#include "geometry/distribution.h"
#include "graph/dag.h"

static const double TIGHT = 1e-12; /* relative to the sum of the magnitudes of the terms */

/* ---- the systems ---- */

typedef struct {
    const char *name, *text; /* text NULL: systems/sleigh.yaml */
    bool chart;              /* has quasi-velocities */
    bool conservative;       /* homogeneous constraints, no forces, no explicit time: the energy is conserved */
    bool exact;              /* the normal form can prove its identities */
} subject;

static const subject SUBJECTS[] = {
    {"sleigh", NULL, true, true, true},
    {"driven", DRIVEN, false, false, true},
    {"affine", AFFINE, true, false, true},
    {"turntable", TURNTABLE, false, false, true},
    {"projectile", PROJECTILE_EXPLICIT, true, false, true},
    {"quadratic projectile", PROJECTILE_QUADRATIC, true, false, true},
    {"implicit projectile", PROJECTILE_IMPLICIT, true, false, false},
    {"Appell-Hamel", APPELL_HAMEL, false, true, false},
    {"coupled", COUPLED, false, false, false},
    {"rheonomic", RHEONOMIC, false, false, true},
    {"relativistic", RELATIVISTIC, false, true, true},
    {"disk", DISK, false, true, true},
};
enum { SUBJECT_COUNT = sizeof SUBJECTS / sizeof *SUBJECTS, POINTS = 24 };

static mechanics open(const subject *s, bool quasi)
{
    nh_chart_choice choice = quasi ? NH_CHART_QUASI : NH_CHART_COORDINATES;
    return s->text ? mechanics_of_text(s->text, choice) : mechanics_of_file("systems/sleigh.yaml", choice, 0, NULL);
}

typedef void check(const subject *s, mechanics *x);

/* Run a check on every system in every chart it has. */
static void everywhere(check *c)
{
    for (size_t i = 0; i < SUBJECT_COUNT; i++)
        for (int quasi = 0; quasi <= SUBJECTS[i].chart; quasi++) {
            if (!sweep_tries(i + (size_t)quasi, 2, 4)) continue;
            mechanics x = open(&SUBJECTS[i], quasi);
            c(&SUBJECTS[i], &x);
            mechanics_clear(&x);
        }
}

typedef void check_at(sheet *s);

static void at_points(mechanics *x, check_at *c)
{
    sheet *s = sheet_of(x->model);
    nh_points *points = points_of(x->model, POINTS, 20);
    double *z = nh_alloc_array(points->width, sizeof *z);
    for (size_t p = 0; p < points->count; p++) {
        point_of(points, p, z);
        sheet_at(s, z);
        c(s);
    }
    nh_free(z);
    nh_points_free(points);
    sheet_free(s);
}

static void near(const sheet *s, double got, double want, double size, const char *what, size_t i, size_t j)
{
    cr_assert(fabs(got - want) <= TIGHT * (size + fabs(want)), "%s in %s: %s_%zu%zu is %.17g, wanted %.17g (terms of %.3g)", s->model->system->name,
              s->model->chart->name, what, i, j, got, want, size);
}

/* ---- Omega on the canonical distribution ---- */

/* What Omega(A, B) must be for kinds A < B of sheet_field. */
static double closed_form(const sheet *s, size_t a, size_t b)
{
    size_t n = s->n;
    double force = 0; /* R^s_i Q_s is in A_i, not in Omega */
    for (size_t q = 0; q < s->m && b >= 1 && b <= n; q++) force += s->R[q * n + b - 1] * s->Q[q];
    if (a == 0 && b >= 1 && b <= n) return -(s->A[b - 1] - force);       /* Omega(X_0, X_j) = -A_j */
    if (a == 0) return 0;                                      /* Omega(X_0, Y_j) */
    if (a <= n && b <= n) return s->G[(a - 1) * n + b - 1];    /* Omega(X_i, X_j) */
    if (a <= n) return -s->M[(b - n - 1) * n + a - 1];         /* Omega(X_i, Y_j) = -M_ji */
    return 0;                                                  /* Omega(Y_i, Y_j) */
}

static void omega_at(sheet *s)
{
    double *b = nh_alloc_array(s->width, sizeof *b), size;
    for (size_t i = 0; i <= 2 * s->n; i++)
        for (size_t j = 0; j <= 2 * s->n; j++) {
            sheet_field(s, i, s->field);
            sheet_field(s, j, b);
            double got = sheet_omega(s, s->field, b, &size), want = i <= j ? closed_form(s, i, j) : -closed_form(s, j, i);
            near(s, got, want, size, "Omega", i, j);
        }
    nh_free(b);
}

/* Basis fields as expressions, kinds as in sheet_field, then d/dt and the d/dq^s. */
static nh_field field_of(const nh_model *o, size_t kind, nh_ex *space, nh_ex *velocity)
{
    nh_dag *d = o->dag;
    size_t n = o->n;
    nh_field f = {nh_int(d, kind == 0 || kind == 2 * n + 1), space, velocity};
    for (size_t s = 0; s < o->m; s++) {
        space[s] = nh_int(d, kind == 2 * n + 2 + s);
        if (kind == 0) space[s] = o->rho[s];
        else if (kind <= n) space[s] = o->R[s * n + kind - 1];
    }
    for (size_t i = 0; i < n; i++) velocity[i] = nh_int(d, kind == n + 1 + i);
    return f;
}

static void numbers_of(const nh_model *o, const nh_field *f, const double *z, double *out)
{
    out[0] = value_at(o, f->time, z);
    values_at(o, o->m, f->space, z, out + 1);
    values_at(o, o->n, f->velocity, z, out + 1 + o->m);
}

/* nh_model_omega against Omega from the gradients, also for fields that are not in the distribution. */
static void general_omega(const subject *which, mechanics *x)
{
    (void)which;
    const nh_model *o = x->model;
    size_t m = o->m, n = o->n, kinds = 2 * n + 2 + m;
    nh_ex e[40];
    double a[20], b[20], z[20], size;
    nh_points *points = points_of(o, 2, 21);
    sheet *s = sheet_of(o);
    for (size_t i = 0; i < kinds; i++)
        for (size_t j = 0; j < kinds; j++) {
            nh_field A = field_of(o, i, e, e + m), B = field_of(o, j, e + m + n, e + 2 * m + n);
            nh_ex omega = nh_model_omega(o, &A, &B);
            for (size_t p = 0; p < points->count; p++) {
                point_of(points, p, z);
                sheet_at(s, z);
                numbers_of(o, &A, z, a);
                numbers_of(o, &B, z, b);
                double want = sheet_omega(s, a, b, &size);
                near(s, value_at(o, omega, z), want, size, "nh_model_omega", i, j);
            }
        }
    sheet_free(s);
    nh_points_free(points);
}

Test(geometry, the_general_formula_of_omega, PLAIN_ONLY) { everywhere(general_omega); }

static void zero(const mechanics *x, nh_ex e, const char *what, size_t i, size_t j)
{
    cr_assert_eq(nh_normal_is_zero(x->model->dag, e, 0), NH_ZERO, "%s in %s: %s_%zu%zu is not identically zero", x->system->name, x->model->chart->name, what,
                 i, j);
}

/* The same identities for all points and all parameters, by the normal form. */
static void exact_omega(const subject *which, mechanics *x)
{
    const nh_model *o = x->model;
    nh_dag *d = o->dag;
    size_t m = o->m, n = o->n;
    nh_ex e[40];
    for (size_t i = 0; i <= 2 * n && which->exact; i++)
        for (size_t j = i + 1; j <= 2 * n; j++) {
            nh_field A = field_of(o, i, e, e + m), B = field_of(o, j, e + m + n, e + 2 * m + n);
            nh_ex rest = nh_model_omega(o, &A, &B);
            if (i == 0 && j <= n) { /* + A_j - R^s_j Q_s */
                rest = nh_add(d, rest, o->A[j - 1]);
                for (size_t s = 0; s < m; s++)
                    rest = nh_sub(d, rest, nh_mul(d, o->R[s * n + j - 1], nh_model_compose(o, x->system->force[s])));
            }
            if (i > 0 && j <= n) rest = nh_sub(d, rest, nh_model_G(o)[(i - 1) * n + j - 1]);
            if (i > 0 && i <= n && j > n) rest = nh_add(d, rest, o->M[(j - n - 1) * n + i - 1]);
            zero(x, rest, "Omega", i, j);
        }
}

Test(geometry, omega_has_the_closed_forms_identically, PLAIN_ONLY) { everywhere(exact_omega); }

/* M from second derivatives of L, not from the momenta. */
static void mass_matrix(const subject *which, mechanics *x)
{
    (void)which;
    const nh_model *o = x->model;
    nh_dag *d = o->dag;
    nh_points *points = points_of(o, POINTS, 22);
    double z[20];
    for (size_t i = 0; i < o->n; i++)
        for (size_t j = 0; j < o->n; j++) {
            nh_ex want = nh_int(d, 0);
            for (size_t s = 0; s < o->m; s++)
                for (size_t r = 0; r < o->m; r++) {
                    const nh_coordinate *c = x->system->coordinate;
                    nh_ex second = nh_model_compose(o, nh_diff(d, nh_diff(d, x->system->lagrangian, c[s].v), c[r].v));
                    want = nh_add(d, want, nh_mul(d, second, nh_mul(d, o->R[s * o->n + i], o->R[r * o->n + j])));
                }
            for (size_t p = 0; p < points->count; p++) {
                point_of(points, p, z);
                double a = value_at(o, o->M[i * o->n + j], z), b = value_at(o, want, z);
                cr_assert(fabs(a - b) <= 1e-11 * (1 + fabs(b)), "%s: M_%zu%zu is %g, wanted %g", x->system->name, i, j, a, b);
            }
        }
    nh_points_free(points);
}

Test(geometry, the_mass_matrix_is_the_projected_hessian, PLAIN_ONLY) { everywhere(mass_matrix); }

/* ---- alpha and Gamma ---- */

static void momenta_at(sheet *s)
{
    double all = 0; /* Lbar adds them up: one of them cannot be better than its share in the others */
    for (size_t i = 0; i < s->n; i++) all += fabs(s->pbar[i]);
    for (size_t i = 0; i < s->n; i++) {
        double sum = 0, size = all;
        for (size_t q = 0; q < s->m; q++) {
            sum += s->p[q] * s->R[q * s->n + i];
            size += fabs(s->p[q] * s->R[q * s->n + i]);
        }
        near(s, s->pbar[i], sum, size, "pbar", i, 0);
        near(s, s->dL[i], sum, size, "dLbar/dw", i, 0);
    }
}

/* i_Gamma Omega vanishes on the distribution, up to the applied forces. */
static void kernel_at(sheet *s)
{
    double *b = nh_alloc_array(s->width, sizeof *b), size;
    sheet_field(s, 2 * s->n + 1, s->field);
    for (size_t j = 0; j <= 2 * s->n; j++) {
        double want = 0;
        sheet_field(s, j, b);
        for (size_t q = 0; q < s->m && j >= 1 && j <= s->n; q++) want += s->R[q * s->n + j - 1] * s->Q[q];
        double got = sheet_omega(s, s->field, b, &size);
        near(s, got, want, size, "Omega(Gamma, .)", j, 0);
    }
    nh_free(b);
}

/* M is symmetric, and M a = A. */
static void equations_at(sheet *s)
{
    for (size_t i = 0; i < s->n; i++) {
        double sum = 0, size = 0;
        for (size_t j = 0; j < s->n; j++) {
            sum += s->M[i * s->n + j] * s->a[j];
            size += fabs(s->M[i * s->n + j] * s->a[j]);
            near(s, s->M[i * s->n + j], s->M[j * s->n + i], 0, "M", i, j);
        }
        near(s, sum, s->A[i], size, "M a", i, 0);
    }
}

/* ---- multipliers ---- */

/* c_s = dL/dq^s + Q_s - Gamma(p_s) for every s, against mu_a nu^a_s; nu R = 0; the reaction is -c. */
static void multipliers_at(sheet *s)
{
    sheet_field(s, 2 * s->n + 1, s->field);
    for (size_t q = 0; q < s->m; q++) {
        double size = fabs(s->Lq[q]) + fabs(s->Q[q]), want = 0;
        double c = s->Lq[q] + s->Q[q] - sheet_along(s, s->field, s->dp + q * s->width, 1, &size);
        for (size_t a = 0; a < s->k; a++) {
            want += s->mu[a] * s->nu[a * s->m + q];
            size += fabs(s->mu[a] * s->nu[a * s->m + q]);
        }
        near(s, c, want, size, "c", q, 0);
        near(s, s->reaction[q], -c, size, "reaction", q, 0);
    }
    for (size_t a = 0; a < s->k; a++)
        for (size_t i = 0; i < s->n; i++) {
            double sum = 0, size = 0;
            for (size_t q = 0; q < s->m; q++) {
                sum += s->nu[a * s->m + q] * s->R[q * s->n + i];
                size += fabs(s->nu[a * s->m + q] * s->R[q * s->n + i]);
            }
            near(s, sum, 0, size, "nu R", a, i);
        }
}

/* ---- energy ---- */

/* Gamma(E) = (Q_s + reaction_s) v^s - dL/dt */
static void energy_at(sheet *s)
{
    double size = fabs(s->Lt[0]), want = -s->Lt[0];
    sheet_field(s, 2 * s->n + 1, s->field);
    for (size_t q = 0; q < s->m; q++) {
        want += (s->Q[q] + s->reaction[q]) * s->rho[q];
        size += fabs(s->Q[q] * s->rho[q]) + fabs(s->reaction[q] * s->rho[q]);
    }
    double got = sheet_along(s, s->field, s->dE, 1, &size);
    near(s, got, want, size, "Gamma(E)", 0, 0);
}

/* Conserved exactly where it should be, and visibly not where it should not. */
static void energy(const subject *which, mechanics *x)
{
    const nh_model *o = x->model;
    nh_ex rate = nh_model_gamma(o, o->E);
    if (which->conservative && which->exact) zero(x, rate, "Gamma(E)", 0, 0);
    nh_points *points = points_of(o, POINTS, 23);
    double z[20], worst = 0;
    for (size_t p = 0; p < points->count; p++) {
        point_of(points, p, z);
        worst = fmax(worst, fabs(value_at(o, rate, z)));
    }
    cr_assert(which->conservative ? worst < 1e-11 : worst > 1e-3, "%s: the energy changes at a rate of up to %g", x->system->name, worst);
    nh_points_free(points);
}

/* All of the above at points, in one pass: making the models takes longer than checking them.
 *     omega_at        Omega has the closed forms M, A, G             momenta_at      pbar_i = p_s R^s_i = dLbar/dw^i
 *     kernel_at       i_Gamma Omega vanishes, up to forces           equations_at    M is symmetric, M a = A
 *     multipliers_at  c_s = mu_a nu_as for all s, nu R = 0           energy_at       the balance of the energy */
static void identities(const subject *which, mechanics *x)
{
    check_at *const each[] = {omega_at, momenta_at, kernel_at, equations_at, multipliers_at, energy_at};
    for (size_t i = 0; i < sizeof each / sizeof *each; i++) at_points(x, each[i]);
    energy(which, x);
}

Test(geometry, identities, PLAIN_ONLY) { everywhere(identities); }

/* Linear constraints do no work: the energy changes by the power of the applied forces, identically. */
Test(geometry, energy_changes_by_the_power_of_the_forces)
{
    char text[4000] = PARTICLE("forced", AND_Z) MASS "lagrangian: m/2*(x'^2 + y'^2 + z'^2) - x^2*z\nconstraints: [\"z' = y*x'\"]\n"
                      "forces: [\"x = -0.01*x'*z\", \"z = 0.3*y'\"]\n";
    mechanics x = mechanics_of_text(text, NH_CHART_AUTO);
    const nh_model *o = x.model;
    nh_ex power = formula(o, "-0.01*x'^2*z + 0.3*y'*z'");
    zero(&x, nh_sub(o->dag, nh_model_gamma(o, o->E), power), "Gamma(E) - power", 0, 0);
    cr_assert_neq(nh_normal_is_zero(o->dag, power, 0), NH_ZERO);
    mechanics_clear(&x);
}

/* ---- charts ---- */

/* A point of the quasi-velocity chart in the chart of coordinate velocities. */
static void convert(const nh_model *quasi, const nh_model *coordinate, const double *z, double *out)
{
    double v[10];
    const nh_chart *c = coordinate->chart;
    values_at(quasi, quasi->m, quasi->rho, z, v);
    memcpy(out, z, (1 + quasi->m) * sizeof *out);
    for (size_t i = 0; i < c->n; i++)
        for (size_t s = 0; s < quasi->m; s++)
            if (c->w[i] == quasi->system->coordinate[s].v) out[1 + quasi->m + i] = v[s];
    for (size_t a = 0; a < c->implicit; a++) out[1 + quasi->m + c->n + a] = v[c->dependent[a]];
}

/* Functions of (t, q, q') have the same rates in both charts, and the multipliers are the same. */
static void compare_charts(const subject *which)
{
    static const char *const functions[] = {"%s'", "%s*cos(%s') + t", "E*%s'", "%s'*x' + y"};
    mechanics a = open(which, true);
    nh_model *o = a.model, *c = nh_model_create(a.system, nh_chart_create(a.system, NH_CHART_COORDINATES, 1, NULL), NULL);
    nh_points *points = points_of(o, POINTS, 24);
    double z[20], y[20], worst = 0;
    cr_assert_not_null(c);
    for (size_t p = 0; p < points->count; p++) {
        point_of(points, p, z);
        convert(o, c, z, y);
        for (size_t i = 0; i < o->k; i++) {
            double u = value_at(o, o->mu[i], z), v = value_at(c, c->mu[i], y);
            worst = fmax(worst, fabs(u - v) / (1 + fabs(u)));
        }
        for (size_t f = 0; f < 4 * o->m; f++) {
            char text[200];
            const char *q = a.system->coordinate[f / 4].name;
            snprintf(text, sizeof text, functions[f % 4], q, q);
            double u = value_at(o, nh_model_gamma(o, formula(o, text)), z), v = value_at(c, nh_model_gamma(c, formula(c, text)), y);
            worst = fmax(worst, fabs(u - v) / (1 + fabs(u)));
        }
    }
    cr_assert(worst < 2e-11, "%s: the charts differ by %.2e", which->name, worst);
    nh_points_free(points);
    nh_model_free(c);
    mechanics_clear(&a);
}

Test(geometry, gamma_and_multipliers_do_not_depend_on_the_chart)
{
    for (size_t i = 0; i < SUBJECT_COUNT; i++)
        if (SUBJECTS[i].chart) compare_charts(&SUBJECTS[i]);
}

/* The Chaplygin sleigh with k = 1 has no inertia about its centre of mass: d2L/dv dv is singular, M is not. */
Test(geometry, a_singular_mass_matrix_may_be_regular_on_the_submanifold)
{
    nh_setting k = {.name = "k", .value = 1};
    for (int quasi = 0; quasi < 2; quasi++) {
        mechanics x = mechanics_of_file("systems/sleigh.yaml", quasi ? NH_CHART_QUASI : NH_CHART_COORDINATES, 1, &k);
        double z[6] = {0.1, 0.7, -0.3, 0.2, 1.1, -0.8};
        cr_assert_float_eq(value_at(x.model, x.model->mu[0], z), 0, 1e-14);
        cr_assert_gt(fabs(value_at(x.model, x.model->a[0], z)), 0.1);
        mechanics_clear(&x);
    }
}

Test(geometry, a_lagrangian_that_is_singular_on_the_submanifold_is_refused)
{
    nh_error error = {0};
    nh_system *s = nh_system_parse("flat.yaml", PARTICLE("flat", AND_Z) MASS "lagrangian: m/2*(x'^2 + z'^2)\nconstraints: [\"z' = y*x'\"]\n", 0, NULL, &error);
    cr_assert_not_null(s, "%s", error.what);
    cr_assert_null(nh_model_create(s, nh_chart_create(s, NH_CHART_AUTO, 1, &error), &error));
    cr_assert_eq(error.code, NH_INPUT);
    cr_assert(strstr(error.what, "singular") && strstr(error.what, "rank 1 of 2") && strstr(error.what, "y'"), "%s", error.what);
    nh_system_free(s);
}

/* The direction without inertia is told, also when it is no coordinate's, and however the rank falls: none, or in places only. */
Test(geometry, a_direction_without_inertia_is_named)
{
    static const struct {
        const char *lagrangian, *says[3];
    } cases[] = {
        {"(x' + 2*y')^2/2 + z'^2", {"rank 2 of 3", "x' : y' = 1 : -0.5", "needs inertia"}},
        {"(x' + y')^2 + (y' - z')^2*exp(x)", {"rank 2 of 3", "x' : y' : z' = 1 : -1 : -1", ""}},
        {"x*y*z", {"rank 0 of 3", "singular on the constraint submanifold", ""}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[300], said[2600];
        nh_error error = {0};
        snprintf(text, sizeof text, "name: flat\ncoordinates: [x, y, z]\nlagrangian: %s\n", cases[i].lagrangian);
        nh_system *s = nh_system_parse("flat.yaml", text, 0, NULL, &error);
        cr_assert_not_null(s, "%s", error.what);
        cr_assert_null(nh_model_create(s, nh_chart_create(s, NH_CHART_AUTO, 1, &error), &error));
        nh_error_format(&error, said, sizeof said);
        for (size_t j = 0; j < 3; j++) cr_expect_not_null(strstr(said, cases[i].says[j]), "%s: no \"%s\" in %s", cases[i].lagrangian, cases[i].says[j], said);
        nh_system_free(s);
    }
}

/* ---- kinds of constraints ---- */

typedef struct {
    const char *name, *text;
    nh_constraint_type type;
    bool rheonomic, holonomic;
    size_t length, growth[NH_MOST_GROWTH], hidden;
} kind;

#define IN_SPACE(constraint) PARTICLE("particle", AND_Z) MASS FREE_IN_SPACE "constraints: [\"" constraint "\"]\n"
#define BODY(more, lagrangian) \
    PARTICLE("body", "  - {name: p, type: angle}\n" more) \
    "parameters: [{name: c, value: 0.4}, {name: r, value: 0.3}]\nlagrangian: x'^2 + y'^2 + p'^2" lagrangian "\n" \
    "domain: {p: [-1, 1]}\nconstraints:\n"

static const char CAR[] = BODY("  - {name: s, type: angle}\n", " + s'^2 + p'*s'")
    "  - x'*sin(p) - y'*cos(p) = 0\n"
    "  - x'*sin(p + s) - y'*cos(p + s) - c*p'*cos(s) = 0\n";

static const char CARRIAGE[] = BODY("  - {name: a, type: angle}\n  - {name: b, type: angle}\n", " + a'^2 + b'^2")
    "  - x'*sin(p) - y'*cos(p) = 0\n"
    "  - a'*r + c*p' + x'*cos(p) + y'*sin(p) = 0\n"
    "  - b'*r - c*p' + x'*cos(p) + y'*sin(p) = 0\n";

static const char ENGEL[] = PARTICLE("Engel", AND_Z "  - {name: u, type: length}\n") "lagrangian: x'^2 + y'^2 + z'^2 + u'^2\n"
    "constraints: [\"z' = y*x'\", \"u' = z*x'\"]\n";

/* Growth vectors by hand: D, then its brackets.  Disk: d_theta, d_varphi, d_psi - r(cos d_1 + sin d_2), whose brackets with d_varphi turn the last
 * part by a right angle, twice.  Car: drive, steer; their bracket turns, its bracket with drive slips sideways.  Carriage: the wheels'
 * angles add up to the heading, one combination never leaves its level. */
static const kind KINDS[] = {
    {"sleigh", NULL, NH_LINEAR, false, false, 2, {2, 3}, 0},
    {"disk", DISK, NH_LINEAR, false, false, 3, {3, 4, 5}, 0},
    {"car", CAR, NH_LINEAR, false, false, 3, {2, 3, 4}, 0},
    {"carriage", CARRIAGE, NH_LINEAR, false, false, 3, {2, 3, 4}, 1},
    {"Engel", ENGEL, NH_LINEAR, false, false, 3, {2, 3, 4}, 0},
    {"Heisenberg", IN_SPACE("z' = y*x' - x*y'"), NH_LINEAR, false, false, 2, {2, 3}, 0},
    {"Martinet", IN_SPACE("z' = y^2*x'"), NH_LINEAR, false, false, 2, {2, 3}, 0},
    {"integrable", IN_SPACE("z' = y*x' + x*y'"), NH_LINEAR, false, true, 1, {2}, 1},
    {"not really moving", IN_SPACE("exp(t)*z' = exp(t)*(y*x' + x*y')"), NH_LINEAR, false, true, 1, {2}, 1},
    {"not really curved", IN_SPACE("(z' - y*x')*(1 + x'^2) = 0"), NH_LINEAR, false, false, 2, {2, 3}, 0},
    {"integrable, factor", IN_SPACE("exp(x)*z' = exp(x)*(y*x' + x*y')"), NH_LINEAR, false, true, 1, {2}, 1},
    {"position", IN_SPACE("z = sin(x)*y"), NH_LINEAR, false, true, 1, {2}, 0},
    {"moving position", IN_SPACE("z = t + x"), NH_AFFINE, true, true, 1, {3}, 0},
    {"affine", AFFINE, NH_AFFINE, false, false, 2, {3, 4}, 0},
    {"affine in space", IN_SPACE("z' = m*x + x'"), NH_AFFINE, false, false, 2, {3, 4}, 0},
    {"conveyor", IN_SPACE("z' = m"), NH_AFFINE, false, true, 1, {3}, 1},
    {"turntable", TURNTABLE, NH_AFFINE, false, false, 2, {4, 6}, 0},
    {"rheonomic", RHEONOMIC, NH_LINEAR, true, false, 2, {3, 4}, 0},
    {"moving surface", IN_SPACE("z' = t*x' + x"), NH_AFFINE, true, true, 1, {3}, 1},
    {"projectile", PROJECTILE_EXPLICIT, NH_NONLINEAR, false, false, 2, {3, 4}, 0},
    {"quadratic projectile", PROJECTILE_QUADRATIC, NH_NONLINEAR, false, false, 2, {3, 4}, 0},
    {"implicit projectile", PROJECTILE_IMPLICIT, NH_NONLINEAR, false, false, 2, {3, 4}, 0},
    {"Appell-Hamel", APPELL_HAMEL, NH_NONLINEAR, false, false, 2, {5, 6}, 0},
    {"coupled", COUPLED, NH_NONLINEAR, false, false, 3, {5, 6, 7}, 0},
    {"unconstrained", DRIVEN, NH_UNCONSTRAINED, false, false, 0, {0}, 0},
};

static void check_kind(const kind *k, bool quasi)
{
    subject s = {.name = k->name, .text = k->text};
    mechanics x = open(&s, quasi);
    nh_distribution d = nh_distribution_of(x.model);
    cr_assert_eq(d.type, k->type, "%s is %s", k->name, nh_constraint_type_name(d.type));
    cr_assert_eq(d.rheonomic, k->rheonomic, "%s: rheonomic", k->name);
    cr_assert_eq(d.holonomic, k->holonomic, "%s: holonomic %d", k->name, d.holonomic);
    cr_assert_eq(d.growth.length, k->length, "%s: growth vector of length %zu", k->name, d.growth.length);
    for (size_t i = 0; i < k->length; i++) cr_assert_eq(d.growth.rank[i], k->growth[i], "%s: growth_%zu is %zu", k->name, i, d.growth.rank[i]);
    cr_assert_eq(d.hidden, k->hidden, "%s: %zu hidden constraints", k->name, d.hidden);
    mechanics_clear(&x);
}

Test(geometry, kinds_of_constraints, PLAIN_ONLY)
{
    for (size_t i = 0; i < sizeof KINDS / sizeof *KINDS; i++) check_kind(&KINDS[i], false);
    for (size_t i = 0; i < sizeof KINDS / sizeof *KINDS; i++) /* the kind does not depend on the chart */
        if (KINDS[i].text == NULL || KINDS[i].text == AFFINE || KINDS[i].text == PROJECTILE_EXPLICIT || KINDS[i].text == PROJECTILE_IMPLICIT)
            check_kind(&KINDS[i], true);
}

/* A mass on a floor: the floor pushes upward, whatever the sign of its multiplier. */
Test(geometry, the_reaction_is_minus_the_multiplier_times_the_slope_of_its_constraint)
{
    static const char *const constraint[] = {"y' = 0", "-y' = 0", "2*y' + x' = 0"};
    for (size_t i = 0; i < 3; i++) {
        char text[400];
        snprintf(text, sizeof text, "parameters: {m: 2, g: 9.81}\ncoordinates: [x, y]\nlagrangian: \"m/2*(x'^2 + y'^2) - m*g*y\"\nconstraints: [\"%s\"]\n", constraint[i]);
        mechanics x = mechanics_of_text(text, NH_CHART_AUTO);
        nh_dag *d = x.model->dag;
        const nh_constraint *c = &x.system->constraint[0];
        for (size_t s = 0; s < 2; s++) {
            nh_ex slope = nh_diff(d, nh_sub(d, c->lhs, c->rhs), x.system->coordinate[s].v);
            nh_ex sum = nh_add(d, x.model->reaction[s], nh_mul(d, x.model->mu[0], slope));
            cr_expect(nh_is_number(d, nh_canonical_sum(d, sum), 0), "%s, coordinate %zu", constraint[i], s);
        }
        if (i < 2) cr_expect_eq(nh_canonical_sum(d, nh_sub(d, x.model->reaction[1], formula(x.model, "m*g"))), nh_int(d, 0), "%s", constraint[i]);
        mechanics_clear(&x);
    }
}
