/* What `reduce --equations` prints of systems of many kinds, against a second computation from the Lagrangian and the constraints alone.
 *
 * The metric comes from values of L (it is quadratic in the velocities), the forms from values of the constraints, derivatives from differences; the
 * structure constants from differences of the printed fields.  Of the program nothing is used but the reader of expressions and their evaluation. */
#include "reduced_object.h"
#include "sweep.h"

/* hor(d/dx^i) = d/dx^i - A_i^a e_a */
static void check_lifts(const object *o, const char *section, const double *A)
{
    for (size_t i = 0; i < o->n; i++) {
        char of[100];
        snprintf(of, sizeof of, "d/d%s", name_of(o, i));
        same(o, "hor", line_value(o, section, of, "hor(d/d%s)", name_of(o, i)), 1, 1e-12);
        for (size_t a = 0; a < o->d; a++) {
            snprintf(of, sizeof of, "e_%zu", a + 1);
            same(o, "hor", line_value(o, section, of, "hor(d/d%s)", name_of(o, i)), -A[a + i * o->d], 1e-9);
        }
    }
}

/* ---- the first stage ---- */

static void chaplygin_connection(object *o, const double *q, double *A)
{
    double frame[most * most];
    connection(o, 0, o->n, o->x, q, A, frame);
}

static void check_chaplygin(object *o)
{
    size_t n = o->n, d = o->d;
    double A[most * most], lift[most * most], Khat[most * most], J[most * most], inv[most * most], *B = nh_alloc_array(d * n * n + 1, sizeof *B);
    chaplygin_connection(o, o->q, A);
    lifted(o, 0, n, o->x, o->q, lift, Khat, J);
    curvature(o, n, d, o->x, chaplygin_connection, B);
    check_lifts(o, "connection", A);
    for (size_t a = 0; a < d; a++)
        for (size_t i = 0; i < n; i++) {
            char speed[100];
            snprintf(speed, sizeof speed, "%s'", name_of(o, i));
            same(o, "Ahat", line_value(o, "connection", "", "Ahat_%s^%zu", name_of(o, i), a + 1), A[a + i * d], 1e-9);
            same(o, "J", line_value(o, "gyroscopic_form", speed, "J_%zu", a + 1), J[a + i * d], 1e-9);
            for (size_t j = i + 1; j < n; j++) same(o, "B", line_value(o, "connection", "", "B_%s,%s^%zu", name_of(o, i), name_of(o, j), a + 1), B[(a * n + i) * n + j], 1e-6);
        }
    for (size_t i = 0; i < n; i++)
        for (size_t j = i; j < n; j++) {
            same(o, "Khat", line_value(o, "hamiltonian", "", "Khat_%s,%s", name_of(o, i), name_of(o, j)), Khat[i + j * n], 1e-9);
            for (size_t k = 0; k < n && i < j; k++) {
                char speed[100];
                double upsilon = 0;
                for (size_t a = 0; a < d; a++) upsilon += J[a + k * d] * B[(a * n + i) * n + j];
                snprintf(speed, sizeof speed, "%s'", name_of(o, k));
                same(o, "Upsilon", line_value(o, "gyroscopic_form", speed, "Upsilon_%s,%s", name_of(o, i), name_of(o, j)), upsilon, 1e-6);
            }
        }
    quadratic(o, "Lhat", 1, n, Khat, "%s'^2", "%s' %s'", false);
    inverse(n, Khat, inv);
    quadratic(o, "Hhat", 1, n, inv, "p_%s^2", "p_%s p_%s", false);
    double V = potential(o, o->q);
    set_place(o);
    same(o, "V in Lhat", line_value(o, "hamiltonian", "", "Lhat"), -V, 1e-9);
    nh_free(B);
}

/* ---- the second stage, or level sets of a momentum ---- */

/* The metric on the coordinates `of` (h of them) at q, and the fields in these. */
static size_t base_metric(object *o, size_t stage, const double *q, double *K, double *E)
{
    size_t of[most], h = around(o, of), m = o->m, d;
    double all[most * most], lift[most * most], J[most * most];
    if (o->first == SIZE_MAX) metric(o, q, K);
    else lifted(o, o->first, h, of, q, lift, K, J);
    d = fields(o, stage, q, all);
    for (size_t a = 0; a < d; a++)
        for (size_t i = 0; i < h; i++) E[i + a * h] = all[of[i] + a * m];
    return h;
}

static size_t second_index;

/* The locked inertia (d x d) and the whole spatial connection I^-1 E^T K (d x h) at q. */
static size_t spatial(object *o, const double *q, double *I, double *connected)
{
    double K[most * most], E[most * most], a[most * most], rcond;
    size_t h = base_metric(o, second_index, q, K, E), d = o->d;
    for (size_t r = 0; r < d; r++) {
        for (size_t i = 0; i < h; i++) {
            connected[r + i * d] = 0;
            for (size_t s = 0; s < h; s++) connected[r + i * d] += E[s + r * h] * K[s + i * h];
        }
    }
    for (size_t r = 0; r < d; r++)
        for (size_t c = 0; c < d; c++) {
            I[r + c * d] = 0;
            for (size_t i = 0; i < h; i++) I[r + c * d] += connected[r + i * d] * E[i + c * h];
        }
    memcpy(a, I, d * d * sizeof *a);
    cr_assert(nh_solve(d, a, h, connected, &rcond));
    return h;
}

/* Of it the columns of the shape: on the slice the spatial connection is that of the body frame. */
static void mechanical(object *o, const double *q, double *Av)
{
    double I[most * most], all[most * most];
    size_t of[most], h = around(o, of);
    spatial(o, q, I, all);
    for (size_t i = 0; i < o->n; i++)
        for (size_t s = 0; s < h; s++)
            if (of[s] == o->x[i]) memcpy(Av + i * o->d, all + s * o->d, o->d * sizeof *Av);
}

/* d alpha on two vectors u, w of the coordinates, alpha = theta . connected, by differences. */
static double exterior(object *o, const double *theta, size_t h, const size_t *of, const double *u, const double *w)
{
    double sum = 0, I[most * most], A[2][most * most], q[most];
    for (size_t r = 0; r < h; r++) {
        if (u[r] == 0 && w[r] == 0) continue;
        for (int side = 0; side < 2; side++) {
            memcpy(q, o->q, sizeof q);
            q[of[r]] += side ? step : -step;
            spatial(o, q, I, A[side]);
        }
        for (size_t s = 0; s < h; s++)
            for (size_t a = 0; a < o->d; a++) sum += theta[a] * (A[1][a + s * o->d] - A[0][a + s * o->d]) / (2 * step) * (u[r] * w[s] - w[r] * u[s]);
    }
    set_place(o);
    return sum;
}

/* The dimension of { xi : theta([xi, .]) = 0 }: d less the rank of theta_k c_ab^k, by elimination. */
static size_t fixing(const object *o, const double *theta)
{
    size_t d = o->d, rank = 0;
    double M[most][most] = {{0}};
    for (size_t a = 0; a < d; a++)
        for (size_t b = 0; b < d; b++)
            for (size_t k = 0; k < d; k++) M[a][b] += o->c[(a * d + b) * d + k] * theta[k];
    for (size_t b = 0; b < d && rank < d; b++) {
        size_t pivot = rank;
        for (size_t a = rank; a < d; a++)
            if (fabs(M[a][b]) > fabs(M[pivot][b])) pivot = a;
        if (fabs(M[pivot][b]) < 1e-6) continue;
        for (size_t k = 0; k < d; k++) {
            double swap = M[pivot][k];
            M[pivot][k] = M[rank][k], M[rank][k] = swap;
        }
        for (size_t a = rank + 1; a < d; a++)
            for (size_t k = d; k-- > b;) M[a][k] -= M[a][b] / M[rank][b] * M[rank][k];
        rank++;
    }
    return d - rank;
}

/* Xi_theta as printed is d alpha_theta on lifts and fields; N_theta as printed leaves theta alone. */
static void check_magnetic(object *o, const double *Av)
{
    size_t n = o->n, d = o->d, of[most], h = around(o, of), isotropy = 0;
    double theta[most], E[most * most], K[most * most], vector[2 * most][most];
    for (size_t a = 0; a < d; a++) {
        theta[a] = 0.7 + 0.31 * (double)(a * a) - 0.2 * (double)a;
        char name[32];
        snprintf(name, sizeof name, "theta_%zu", a + 1);
        o->s.value[own_name(&o->s, name)] = theta[a];
    }
    base_metric(o, second_index, o->q, K, E);
    set_place(o);
    for (size_t a = 0; a < d; a++) memcpy(vector[n + a], E + a * h, h * sizeof(double));
    for (size_t i = 0; i < n; i++)
        for (size_t r = 0; r < h; r++) {
            vector[i][r] = of[r] == o->x[i];
            for (size_t a = 0; a < d; a++) vector[i][r] -= Av[a + i * d] * E[r + a * h];
        }
    for (size_t i = 0; i < n + d; i++)
        for (size_t j = i + 1; j < n + d; j++) {
            double want = exterior(o, theta, h, of, vector[i], vector[j]), got = 0;
            for (size_t a = 0; a < d && j < n; a++) {
                char factor[30];
                snprintf(factor, sizeof factor, "theta_%zu", a + 1);
                got += theta[a] * line_value(o, "magnetic_form", factor, "Xi_%s,%s", name_of(o, i), name_of(o, j));
            }
            if (i >= n) got = line_value(o, "magnetic_form", "", "Xi(e_%zu,e_%zu)", i - n + 1, j - n + 1);
            same(o, "Xi_theta", got, want, 1e-5);
        }
    const cJSON *line;
    cJSON_ArrayForEach(line, oracle_get(o->s.geometry, "magnetic_form")) isotropy += !strncmp(text_of(line, "label"), "xi_", 3);
    for (size_t p = 0; p < isotropy; p++)
        for (size_t b = 0; b < d; b++) {
            double sum = 0;
            for (size_t a = 0; a < d; a++) {
                char e[30];
                snprintf(e, sizeof e, "e_%zu", a + 1);
                double xi = line_value(o, "magnetic_form", e, "xi_%zu", p + 1);
                for (size_t k = 0; k < d; k++) sum += xi * o->c[(a * d + b) * d + k] * theta[k];
            }
            same(o, "theta([xi, .])", sum, 0, 1e-6);
        }
    size_t dimension = fixing(o, theta);
    cr_expect_eq(dimension, (size_t)oracle_number(o->s.stage, "isotropy"), "%s: N_theta has dimension %zu", o->name, dimension);
    if (!cJSON_IsTrue(oracle_get(o->s.stage, "abelian"))) cr_expect_eq(isotropy, dimension, "%s: %zu", o->name, isotropy);
}

static void check_second(object *o, size_t stage)
{
    size_t n = o->n, d = o->d, of[most], h = around(o, of);
    double I[most * most], all[most * most], K[most * most], E[most * most], Av[most * most], Kt[most * most], inv[most * most], *B = nh_alloc_array(d * n * n + 1, sizeof *B);
    second_index = stage;
    spatial(o, o->q, I, all);
    base_metric(o, stage, o->q, K, E);
    mechanical(o, o->q, Av);
    curvature(o, n, d, o->x, mechanical, B);
    check_lifts(o, "mechanical_connection", Av);
    for (size_t a = 0; a < d; a++) {
        for (size_t b = a; b < d; b++) same(o, "I", line_value(o, "mechanical_connection", "", "I_%zu,%zu", a + 1, b + 1), I[a + b * d], 1e-9);
        for (size_t i = 0; i < n; i++) {
            char momentum[30];
            snprintf(momentum, sizeof momentum, "theta_%zu", a + 1);
            same(o, "Abreve", line_value(o, "mechanical_connection", "", "Abreve_%s^%zu", name_of(o, i), a + 1), Av[a + i * d], 1e-9);
            same(o, "phat", line_value(o, "hamiltonian", momentum, "phat_%s", name_of(o, i)), Av[a + i * d], 1e-9);
            for (size_t j = i + 1; j < n; j++) same(o, "B", line_value(o, "mechanical_connection", "", "B_%s,%s^%zu", name_of(o, i), name_of(o, j), a + 1), B[(a * n + i) * n + j], 1e-6);
        }
    }
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) { /* K on lifts */
            Kt[i + j * n] = 0;
            for (size_t r = 0; r < h; r++)
                for (size_t s = 0; s < h; s++) {
                    double u = of[r] == o->x[i], w = of[s] == o->x[j];
                    for (size_t a = 0; a < d; a++) u -= Av[a + i * d] * E[r + a * h], w -= Av[a + j * d] * E[s + a * h];
                    Kt[i + j * n] += u * K[r + s * h] * w;
                }
            if (i <= j) set_place(o);
        }
    for (size_t i = 0; i < n; i++)
        for (size_t j = i; j < n; j++) same(o, "Kbreve", line_value(o, "hamiltonian", "", "Kbreve_%s,%s", name_of(o, i), name_of(o, j)), Kt[i + j * n], 1e-8);
    quadratic(o, "R_theta", 1, n, Kt, "%s'^2", "%s' %s'", false);
    inverse(n, Kt, inv);
    quadratic(o, "Hbreve", 1, n, inv, "p_%s^2", "p_%s p_%s", false);
    inverse(d, I, inv);
    quadratic(o, "Hbreve", 1, d, inv, "theta_%zu^2", "theta_%zu theta_%zu", true);
    quadratic(o, "R_theta", -1, d, inv, "theta_%zu^2", "theta_%zu theta_%zu", true);
    check_magnetic(o, Av);
    nh_free(B);
}

/* ---- the whole group ---- */

static double chi_of(const object *o, size_t p, size_t a)
{
    char e[30];
    snprintf(e, sizeof e, "e_%zu", a + 1);
    return line_value(o, "connection", e, "chi_%zu", p + 1);
}

static void printed_connection(object *o, const double *q, double *A)
{
    for (size_t i = 0; i < o->m; i++) o->s.value[2 * i] = q[i];
    for (size_t a = 0; a < o->d; a++)
        for (size_t i = 0; i < o->n; i++) A[a + i * o->d] = line_value(o, "connection", "", "A_%s^%zu", name_of(o, i), a + 1);
}

/* An inner product of the first three generators in which they are not orthogonal. */
#define INCLINED " --inner 1,1=2;1,2=1/3;1,3=-1/4;2,2=3/2;2,3=1/5;3,3=2"
static const double inclined[3][3] = {{2, 1. / 3, -1. / 4}, {1. / 3, 3. / 2, 1. / 5}, {-1. / 4, 1. / 5, 2}};

/* chi and the lifts lie in D and are orthogonal to each other, for the kinetic energy or for the inner product above; B is the curvature of A; l has the
 * metric on both. */
static void check_bundle(object *o, size_t stage, bool own)
{
    size_t n = o->n, d = o->d, m = o->m, r = d - o->f;
    double omega[most * most], K[most * most], E[most * most], A[most * most], vector[2 * most][most] = {{0}}, *B = nh_alloc_array(d * n * n + 1, sizeof *B);
    forms(o, o->q, omega);
    metric(o, o->q, K);
    fields(o, stage, o->q, E);
    set_place(o);
    printed_connection(o, o->q, A);
    for (size_t i = 0; i < n; i++) {
        vector[i][o->x[i]] = 1;
        for (size_t a = 0; a < d; a++)
            for (size_t s = 0; s < m; s++) vector[i][s] -= A[a + i * d] * E[s + a * m];
    }
    for (size_t p = 0; p < r; p++)
        for (size_t a = 0; a < d; a++)
            for (size_t s = 0; s < m; s++) vector[n + p][s] += chi_of(o, p, a) * E[s + a * m];
    for (size_t i = 0; i < n + r; i++) {
        double size = 0;
        for (size_t s = 0; s < m; s++) size += vector[i][s] * vector[i][s];
        cr_expect_gt(size, 1e-6, "%s: vector %zu of D vanishes", o->name, i);
        for (size_t a = 0; a < o->f; a++) {
            double sum = 0;
            for (size_t s = 0; s < m; s++) sum += omega[a + s * o->f] * vector[i][s];
            same(o, "a form on D", sum, 0, 1e-9);
        }
        for (size_t j = i; j < n + r; j++) {
            double product = 0;
            char of[100];
            for (size_t s = 0; s < m; s++)
                for (size_t t = 0; t < m; t++) product += vector[i][s] * K[s + t * m] * vector[j][t];
            if (i < n && j >= n && !own) same(o, "a lift on S", product, 0, 1e-8);
            if (i < n && j >= n) snprintf(of, sizeof of, "%s' nu_%zu", name_of(o, i), j - n + 1);
            else if (j < n) snprintf(of, sizeof of, i == j ? "%s'^2" : "%s' %s'", name_of(o, i), name_of(o, j));
            else snprintf(of, sizeof of, i == j ? "nu_%zu^2" : "nu_%zu nu_%zu", i - n + 1, j - n + 1);
            same(o, "l", line_value(o, "lagrangian", of, "l"), i == j ? product / 2 : product, 1e-8);
        }
    }
    for (size_t i = 0; i < n && own; i++)
        for (size_t p = 0; p < r; p++) {
            double product = 0;
            for (size_t a = 0; a < d; a++)
                for (size_t b = 0; b < d; b++) product += chi_of(o, p, a) * inclined[a][b] * A[b + i * d];
            same(o, "a lift on S, by the inner product", product, 0, 1e-8);
        }
    curvature(o, n, d, o->x, printed_connection, B);
    check_lifts(o, "connection", A);
    for (size_t a = 0; a < d; a++)
        for (size_t i = 0; i < n; i++)
            for (size_t j = i + 1; j < n; j++) same(o, "B", line_value(o, "connection", "", "B_%s,%s^%zu", name_of(o, i), name_of(o, j), a + 1), B[(a * n + i) * n + j], 1e-6);
    nh_free(B);
}

/* ---- the equations of the whole group ---- */

/* A motion through the place: velocities of shape and of S, and what follows from them. */
typedef struct {
    size_t r;
    double speed[most], nu[most];                       /* along the shape coordinates; components along chi_p */
    double A[most * most], chi[most][most];             /* as printed; both are compared with the forms and the metric */
    double omega[most], v[most], mu[most];              /* of the group; of all coordinates; <dL/dv, e_a> */
    double E[most * most];
} motion;

static motion some_motion(object *o, size_t stage)
{
    motion w = {.r = o->d - o->f};
    double K[most * most];
    printed_connection(o, o->q, w.A);
    for (size_t p = 0; p < w.r; p++)
        for (size_t a = 0; a < o->d; a++) w.chi[p][a] = chi_of(o, p, a);
    for (size_t i = 0; i < o->n; i++) w.speed[i] = 0.4 - 0.27 * (double)i;
    for (size_t p = 0; p < w.r; p++) w.nu[p] = 0.6 - 0.35 * (double)p + 0.11 * (double)(p * p);
    for (size_t a = 0; a < o->d; a++) {
        for (size_t p = 0; p < w.r; p++) w.omega[a] += w.chi[p][a] * w.nu[p];
        for (size_t i = 0; i < o->n; i++) w.omega[a] -= w.A[a + i * o->d] * w.speed[i];
    }
    fields(o, stage, o->q, w.E);
    for (size_t i = 0; i < o->n; i++) w.v[o->x[i]] = w.speed[i];
    for (size_t a = 0; a < o->d; a++)
        for (size_t s = 0; s < o->m; s++) w.v[s] += w.omega[a] * w.E[s + a * o->m];
    metric(o, o->q, K);
    for (size_t a = 0; a < o->d; a++)
        for (size_t s = 0; s < o->m; s++)
            for (size_t t = 0; t < o->m; t++) w.mu[a] += w.E[s + a * o->m] * K[s + t * o->m] * w.v[t];
    for (size_t p = 0; p < w.r; p++) {
        char name[30];
        snprintf(name, sizeof name, "nu_%zu", p + 1);
        o->s.value[own_name(&o->s, name)] = w.nu[p];
    }
    for (size_t a = 0; a < o->d; a++) {
        char name[30];
        snprintf(name, sizeof name, "mu_%zu", a + 1);
        o->s.value[own_name(&o->s, name)] = w.mu[a];
    }
    return w;
}

static void set_motion(object *o, const motion *w)
{
    set_place(o);
    for (size_t i = 0; i < o->n; i++) o->s.value[2 * o->x[i] + 1] = w->speed[i];
}

/* (v d) Y_a, where Y_a is the field that is e_a on the slice and commutes with all e_b: d_i Y_a = d_i e_a along the slice, (e_b d) Y_a = (Y_a d) e_b. */
static void invariant_change(object *o, size_t stage, const motion *w, size_t a, double *out)
{
    double side[2][most * most], q[most];
    for (size_t s = 0; s < o->m; s++) out[s] = 0;
    for (int turn = 0; turn < 2; turn++) {
        for (int k = 0; k < 2; k++) {
            memcpy(q, o->q, sizeof q);
            if (turn)
                for (size_t s = 0; s < o->m; s++) q[s] += (k ? step : -step) * w->E[s + a * o->m];
            else
                for (size_t i = 0; i < o->n; i++) q[o->x[i]] += (k ? step : -step) * w->speed[i];
            fields(o, stage, q, side[k]);
        }
        for (size_t s = 0; s < o->m; s++)
            for (size_t b = 0; b < o->d; b++) {
                double along = turn ? w->omega[b] : b == a;
                out[s] += along * (side[1][s + b * o->m] - side[0][s + b * o->m]) / (2 * step);
            }
    }
}

/* d/dt <dL/dv, Z> = dL(Z, (v d) Z) on motions, for a field Z in D: the multipliers do no work on it. */
static double rate_along(object *o, const motion *w, const double *Z, const double *change)
{
    double side[2], q[most], v[most];
    for (int k = 0; k < 2; k++) {
        for (size_t s = 0; s < o->m; s++) q[s] = o->q[s] + (k ? step : -step) * Z[s], v[s] = w->v[s] + (k ? step : -step) * change[s];
        side[k] = evaluated(o, o->s.system->lagrangian, q, v);
    }
    return (side[1] - side[0]) / (2 * step);
}

/* The lift of d/dx^i or chi_p, carried around by the group, and how it changes along the motion. */
static void carried(object *o, size_t stage, const motion *w, size_t i, size_t p, double *Z, double *change)
{
    size_t m = o->m, d = o->d;
    bool horizontal = i < o->n;
    double by[most] = {0}, q[most], A[2][most * most], moved[most];
    for (size_t s = 0; s < m; s++) Z[s] = horizontal && s == o->x[i], change[s] = 0;
    for (int k = 0; k < 2; k++) {
        memcpy(q, o->q, sizeof q);
        for (size_t j = 0; j < o->n; j++) q[o->x[j]] += (k ? step : -step) * w->speed[j];
        printed_connection(o, q, A[k]);
    }
    for (size_t a = 0; a < d; a++) {
        double along = horizontal ? -w->A[a + i * d] : w->chi[p][a];
        if (horizontal) by[a] = -(A[1][a + i * d] - A[0][a + i * d]) / (2 * step);
        invariant_change(o, stage, w, a, moved);
        for (size_t s = 0; s < m; s++) Z[s] += along * w->E[s + a * m], change[s] += along * moved[s] + by[a] * w->E[s + a * m];
    }
}

/* The sum of coefficient times factor over the terms of a printed side. */
static double side_value(const object *o, const cJSON *terms)
{
    const cJSON *term;
    double sum = 0;
    cJSON_ArrayForEach(term, terms) sum += value_of(&o->s, text_of(term, "coefficient")) * (text_of(term, "of")[0] ? value_of(&o->s, text_of(term, "of")) : 1);
    return sum;
}

/* omega, mu, pi and the right sides of mu'(chi_p) and of pi'_i as printed. */
static void check_equations(object *o, size_t stage, const motion *w)
{
    double Z[most], change[most], K[most * most];
    const cJSON *equations = oracle_get(o->s.geometry, "equations");
    cr_assert_eq((size_t)cJSON_GetArraySize(equations), w->r + o->n, "%s: %d equations", o->name, cJSON_GetArraySize(equations));
    metric(o, o->q, K);
    set_motion(o, w);
    for (size_t a = 0; a < o->d; a++) {
        same(o, "omega", line_value(o, "lagrangian", "", "omega_%zu", a + 1), w->omega[a], 1e-9);
        same(o, "mu", line_value(o, "lagrangian", "", "mu_%zu", a + 1), w->mu[a], 1e-8);
    }
    for (size_t k = 0; k < w->r + o->n; k++) {
        size_t i = k < w->r ? o->n : k - w->r;
        const cJSON *line = cJSON_GetArrayItem(equations, (int)k), *term;
        carried(o, stage, w, i, k, Z, change);
        double want = rate_along(o, w, Z, change), pi = 0;
        set_motion(o, w);
        same(o, "a right side of the equations", side_value(o, oracle_get(line, "equals")), want, 1e-6);
        cJSON_ArrayForEach(term, oracle_get(line, "terms")) {
            size_t a = k < w->r ? (size_t)atoi(text_of(term, "of") + strlen("mu'_")) - 1 : 0;
            same(o, "a left side of the equations", value_of(&o->s, text_of(term, "coefficient")), k < w->r ? w->chi[k][a] : 1, 1e-9);
        }
        for (size_t s = 0; s < o->m && i < o->n; s++)
            for (size_t t = 0; t < o->m; t++) pi += Z[s] * K[s + t * o->m] * w->v[t];
        if (i < o->n) same(o, "pi", line_value(o, "lagrangian", "", "pi_%s", name_of(o, i)), pi, 1e-8);
    }
}

/* ---- by stages ---- */

typedef struct {
    size_t blocks, block[most];      /* of each generator */
    double lift[most][most];         /* H e_i */
    double cut[most][most];          /* H_j of the part j of a vector */
} chain;

static chain read_chain(const object *o, bool given)
{
    chain c = {0};
    const cJSON *block, *of;
    cJSON_ArrayForEach(block, oracle_get(o->s.stage, "chain")) {
        cJSON_ArrayForEach(of, block) c.block[of->valueint - 1] = c.blocks;
        c.blocks++;
    }
    for (size_t i = 0; i < o->d; i++) { /* e_i less its projection on the generators behind its block */
        double g[most * most], rest[most], rcond;
        size_t behind[most], n = 0;
        for (size_t k = 0; k < o->d; k++)
            if (c.block[k] > c.block[i]) behind[n++] = k;
        for (size_t k = 0; k < n; k++) {
            rest[k] = given && i < 3 && behind[k] < 3 ? inclined[i][behind[k]] : 0;
            for (size_t l = 0; l < n; l++) g[k + l * n] = given && behind[k] < 3 && behind[l] < 3 ? inclined[behind[k]][behind[l]] : k == l;
        }
        if (n) cr_assert(nh_solve(n, g, 1, rest, &rcond));
        c.lift[i][i] = 1;
        for (size_t k = 0; k < n; k++) c.lift[i][behind[k]] = -rest[k];
    }
    return c;
}

/* [u, v], and its parts in c->cut. */
static void bracket_in_parts(const object *o, chain *c, const double *u, const double *v)
{
    double rest[most] = {0};
    for (size_t a = 0; a < o->d; a++)
        for (size_t b = 0; b < o->d; b++)
            for (size_t k = 0; k < o->d; k++) rest[k] += o->c[(a * o->d + b) * o->d + k] * u[a] * v[b];
    memset(c->cut, 0, sizeof c->cut);
    for (size_t j = 0; j < c->blocks; j++) {
        for (size_t i = 0; i < o->d; i++)
            for (size_t k = 0; k < o->d && c->block[i] == j; k++) c->cut[j][k] += rest[i] * c->lift[i][k];
        for (size_t k = 0; k < o->d; k++) rest[k] -= c->cut[j][k];
    }
}

/* The part of a vector on the blocks from..to-1, lifted. */
static void part(const object *o, const chain *c, const double *x, size_t from, size_t to, double *out)
{
    double rest[most];
    memcpy(rest, x, sizeof rest);
    for (size_t k = 0; k < most; k++) out[k] = 0;
    for (size_t j = 0; j < c->blocks; j++) {
        double here[most] = {0};
        for (size_t i = 0; i < o->d; i++)
            for (size_t k = 0; k < o->d && c->block[i] == j; k++) here[k] += rest[i] * c->lift[i][k];
        for (size_t k = 0; k < o->d; k++) rest[k] -= here[k], out[k] += j >= from && j < to ? here[k] : 0;
    }
}

static void check_maps(const object *o, chain *c, bool given)
{
    for (size_t x = 0; x < o->d; x++)
        for (size_t y = 0; y < o->d; y++) {
            size_t j = c->block[x];
            double unit[most] = {0};
            char e[30];
            unit[y] = 1;
            snprintf(e, sizeof e, "e_%zu", y + 1);
            if (given) same(o, "H e", line_value(o, "chain", e, "H_%zu e_%zu", j, x + 1), c->lift[x][y], 1e-12);
            if (c->block[y] < j || (c->block[y] == j && y <= x)) continue;
            bool within = c->block[y] == j;
            bracket_in_parts(o, c, c->lift[x], within ? c->lift[y] : unit);
            for (size_t a = 0; a < o->d; a++) {
                double want = 0;
                for (size_t k = 0; k < c->blocks; k++) want += !within ? c->cut[k][a] : k > j ? -c->cut[k][a] : 0;
                snprintf(e, sizeof e, "e_%zu", a + 1);
                same(o, within ? "a" : "b", line_value(o, "chain", e, within ? "a_%zu(e_%zu,e_%zu)" : "b_%zu(e_%zu,e_%zu)", j, x + 1, y + 1), want, 1e-7);
            }
        }
}

/* The coefficients of mu in the line with this label are those of block i in c->cut, and are added to sum. */
static void check_contribution(const object *o, const chain *c, size_t i, const char *label, double *sum)
{
    for (size_t a = 0; a < o->d; a++) {
        char mu[30];
        snprintf(mu, sizeof mu, "mu_%zu", a + 1);
        double got = shown_value(&o->s, "by_stages", label, mu);
        same(o, label, got, c->cut[i][a], 1e-7);
        sum[a] += got;
    }
}

/* beta_i on the parts of [omega, chi_p] [CendraDiaz2018, eq. 14]; together they are all of mu([omega, chi_p]). */
static void check_by_stages(object *o, const motion *w, bool given)
{
    chain c = read_chain(o, given);
    set_motion(o, w);
    check_maps(o, &c, given);
    for (size_t p = 0; p < w->r; p++) {
        double sum[most] = {0}, u[most], x[most];
        char label[120];
        for (size_t i = 0; i < c.blocks; i++)
            for (size_t j = 0; j <= i; j++) {
                part(o, &c, w->omega, j, j + 1, u), part(o, &c, w->chi[p], j, j + 1, x);
                bracket_in_parts(o, &c, u, x);
                if (i == j) snprintf(label, sizeof label, "beta_%zu([omega_%zu,chi_%zu;%zu])", i, i, p + 1, i);
                else snprintf(label, sizeof label, "beta_%zu(-a_%zu(omega_%zu,chi_%zu;%zu))", i, j, j, p + 1, j);
                check_contribution(o, &c, i, label, sum);
                if (i == j) continue;
                part(o, &c, w->chi[p], j + 1, c.blocks, x);
                bracket_in_parts(o, &c, u, x);
                snprintf(label, sizeof label, "beta_%zu(b_%zu(omega_%zu,chi_%zu;>%zu))", i, j, j, p + 1, j);
                check_contribution(o, &c, i, label, sum);
                part(o, &c, w->omega, j + 1, c.blocks, u), part(o, &c, w->chi[p], j, j + 1, x);
                bracket_in_parts(o, &c, u, x);
                snprintf(label, sizeof label, "beta_%zu(-b_%zu(chi_%zu;%zu,omega_>%zu))", i, j, p + 1, j, j);
                check_contribution(o, &c, i, label, sum);
            }
        bracket_in_parts(o, &c, w->omega, w->chi[p]);
        for (size_t a = 0; a < o->d; a++) {
            double want = 0;
            for (size_t j = 0; j < c.blocks; j++) want += c.cut[j][a];
            same(o, "mu([omega, chi])", sum[a], want, 1e-7);
        }
    }
}

static void check_bundle_equations(object *o, size_t stage, const char *line)
{
    motion w = some_motion(o, stage);
    check_equations(o, stage, &w);
    if (cJSON_GetObjectItem(o->s.stage, "chain")) check_by_stages(o, &w, strstr(line, INCLINED) != NULL);
}

/* ---- a system ---- */

static void open_stage(object *o, const char *text, const char *line, size_t stage, const char *name)
{
    const cJSON *item;
    *o = (object){.s = reduced_from("own.yaml", text, 0, NULL, line, stage), .first = SIZE_MAX, .name = name};
    o->m = o->s.system->coordinates;
    o->f = o->s.system->constraints;
    for (size_t i = 0; i < o->m; i++) o->q[i] = 0.9 - 0.23 * (double)i + 0.06 * (double)(i * i);
    cJSON_ArrayForEach(item, oracle_get(o->s.stage, "shape")) o->shape[o->n] = item->valuestring, o->x[o->n++] = coordinate(o, item->valuestring);
    for (size_t s = 0; s <= stage; s++) { /* a second stage lies on the first one's slice, too */
        const cJSON *other = cJSON_GetArrayItem(oracle_get(o->s.root, "stages"), (int)s);
        bool below = s == 0 && stage > 0 && !strcmp(text_of(other, "kind"), "chaplygin") && !strcmp(text_of(o->s.stage, "kind"), "second");
        if (below) o->first = s;
        if (s < stage && !below) continue;
        cJSON_ArrayForEach(item, oracle_get(other, "slice")) {
            o->q[coordinate(o, item->string)] = value_of(&o->s, item->valuestring);
            if (s == stage) o->y[o->d++] = coordinate(o, item->string);
        }
    }
    set_place(o);
    constants(o, stage, o->d, o->q);
}

static void check(const char *name, const char *text, const char *line, const char *kinds)
{
    for (size_t stage = 0; kinds[stage]; stage++) {
        object o;
        open_stage(&o, text, line, stage, name);
        const char *kind = text_of(o.s.stage, "kind");
        cr_expect_eq(kind[0], kinds[stage], "%s: stage %zu is %s", name, stage + 1, kind);
        cr_assert_eq(cJSON_GetArraySize(oracle_get(o.s.root, "stages")), (int)strlen(kinds), "%s: %d stages", name, cJSON_GetArraySize(oracle_get(o.s.root, "stages")));
        if (!strcmp(kind, "chaplygin")) check_chaplygin(&o);
        if (!strcmp(kind, "second")) check_second(&o, stage);
        if (!strcmp(kind, "lagrange-dalembert-poincare")) {
            check_bundle(&o, stage, strstr(line, "lifts=1") != NULL);
            check_bundle_equations(&o, stage, line);
        }
        const cJSON *agreement = cJSON_GetObjectItem(o.s.stage, "agreement_with_full");
        if (!agreement) agreement = cJSON_GetObjectItem(o.s.stage, "agreement_with_first");
        cr_expect(cJSON_IsNumber(agreement) && agreement->valuedouble < 1e-9, "%s, stage %zu", name, stage + 1);
        reduced_clear(&o.s);
    }
}

Test(reduced_objects, snake_of_three_links, PLAIN_ONLY)
{
    check("snake", "name: snake\nparameters: [{name: m, value: 1.3}, {name: J, value: 0.4}, {name: l, value: 0.7}]\n"
          "coordinates: [{name: x, type: length}, {name: y, type: length}, {name: h, type: angle}, {name: a, type: angle}, {name: b, type: angle}]\n"
          "domain: {a: [0.3, 0.9], b: [0.4, 1.1]}\n"
          "definitions: [\"vx = x' - l*h'*sin(h) - l*(h'+a')*sin(h+a)\", \"vy = y' + l*h'*cos(h) + l*(h'+a')*cos(h+a)\", \"ux = x' + l*h'*sin(h) + l*(h'+b')*sin(h+b)\", \"uy = y' - l*h'*cos(h) - l*(h'+b')*cos(h+b)\"]\n"
          "lagrangian: m/2*(x'^2 + y'^2 + vx^2 + vy^2 + ux^2 + uy^2) + J/2*(h'^2 + (h'+a')^2 + (h'+b')^2)\n"
          "constraints: [\"y'*cos(h) = x'*sin(h)\", \"vy*cos(h+a) = vx*sin(h+a)\", \"uy*cos(h+b) = ux*sin(h+b)\"]\n", "", "c");
}

Test(reduced_objects, ball_with_a_rotor, PLAIN_ONLY)
{
    check("ball with a rotor", "name: rotor\nparameters: [{name: m, value: 1.1}, {name: A, value: 0.5}, {name: C, value: 0.7}, {name: I, value: 0.2}, {name: R, value: 0.6}]\n"
          "coordinates: [{name: x, type: length}, {name: y, type: length}, {name: p, type: angle}, {name: h, type: angle}, {name: s, type: angle}, {name: r, type: angle}]\n"
          "domain: {h: [0.5, 1.4]}\n"
          "definitions: [\"w1 = p'*sin(h)*sin(s) + h'*cos(s)\", \"w2 = p'*sin(h)*cos(s) - h'*sin(s)\", \"w3 = p'*cos(h) + s'\"]\n"
          "lagrangian: m/2*(x'^2 + y'^2) + A/2*(w1^2 + w2^2) + C/2*w3^2 + I/2*(w3 + r')^2\n"
          "constraints: [\"x' = R*(h'*sin(p) - s'*sin(h)*cos(p))\", \"y' = -R*(h'*cos(p) + s'*sin(h)*sin(p))\"]\n", " --group x=1;y=1;r=1;s=1", "csl");
}

Test(reduced_objects, disk_on_a_slope)
{
    check("disk on a slope", "name: slope\nparameters: [{name: m, value: 1.4}, {name: J, value: 0.6}, {name: K, value: 0.3}, {name: r, value: 0.5}, {name: g, value: 2.1}]\n"
          "coordinates: [{name: x, type: length}, {name: y, type: length}, {name: p, type: angle}, {name: h, type: angle}]\n"
          "lagrangian: m/2*(x'^2 + y'^2) + J/2*h'^2 + K/2*p'^2 + m*g*x\nconstraints: [\"x' = r*h'*cos(p)\", \"y' = r*h'*sin(p)\"]\n", "", "c");
}

/* A nonholonomic particle that carries a body of changing shape: N = SO(3). */
Test(reduced_objects, non_abelian_second_stage, PLAIN_ONLY)
{
    check("particle and body", "name: carrier\nparameters: [{name: A, value: 0.8}, {name: B, value: 1.1}, {name: C, value: 0.6}, {name: k, value: 0.4}]\n"
          "coordinates: [{name: x, type: length}, {name: y, type: length}, {name: z, type: length}, {name: p, type: angle}, {name: h, type: angle}, {name: s, type: angle}]\n"
          "domain: {h: [0.5, 1.4], y: [0.3, 0.8]}\n"
          "definitions: [\"w1 = p'*sin(h)*sin(s) + h'*cos(s)\", \"w2 = p'*sin(h)*cos(s) - h'*sin(s)\", \"w3 = p'*cos(h) + s'\"]\n"
          "lagrangian: (x'^2 + y'^2 + z'^2)/2 + (A + y^2)/2*w1^2 + B/2*(w2 + k*y*x')^2 + (C + x^2)/2*(w3 + k*y')^2 - x^2/2\n"
          "constraints: [\"z' = y*x'\"]\n",
          " --group z=1;p=1;p=-sin(p)*cos(h)/sin(h),h=cos(p),s=sin(p)/sin(h);p=cos(p)*cos(h)/sin(h),h=sin(p),s=-cos(p)/sin(h)", "csl");
}

/* Without constraints: a body with two masses that slide in it, rotations of all of it. */
Test(reduced_objects, body_with_sliding_masses, PLAIN_ONLY)
{
    check("sliding masses", "name: slider\nparameters: [{name: A, value: 0.8}, {name: B, value: 1.1}, {name: C, value: 0.6}, {name: m, value: 0.3}]\n"
          "coordinates: [{name: u, type: length}, {name: v, type: length}, {name: p, type: angle}, {name: h, type: angle}, {name: s, type: angle}]\n"
          "domain: {h: [0.5, 1.4]}\n"
          "definitions: [\"w1 = p'*sin(h)*sin(s) + h'*cos(s)\", \"w2 = p'*sin(h)*cos(s) - h'*sin(s)\", \"w3 = p'*cos(h) + s'\"]\n"
          "lagrangian: (A*w1^2 + B*w2^2 + C*w3^2)/2 + m/2*((u' - w3*v)^2 + (v' + w3*u)^2 + (w1*v - w2*u)^2) + m/2*(u'*w3) - (u^2 + 2*v^2 + u*v)/2\n",
          " --group p=1;p=-sin(p)*cos(h)/sin(h),h=cos(p),s=sin(p)/sin(h);p=cos(p)*cos(h)/sin(h),h=sin(p),s=-cos(p)/sin(h)", "ls");
}

Test(reduced_objects, double_pendulum_in_space, PLAIN_ONLY)
{
    check("pendulum in space", "name: spatial\nparameters: [{name: m, value: 1.2}, {name: M, value: 0.7}, {name: g, value: 3}]\n"
          "coordinates: [{name: p, type: angle}, {name: a, type: angle}, {name: q, type: angle}, {name: b, type: angle}]\ndomain: {a: [0.4, 1.2], b: [0.5, 1.3]}\n"
          "definitions: [\"X = cos(p)*cos(a)*a' - sin(p)*sin(a)*p'\", \"Y = sin(p)*cos(a)*a' + cos(p)*sin(a)*p'\", \"Z = sin(a)*a'\", \"U = X + cos(q)*cos(b)*b' - sin(q)*sin(b)*q'\", \"V = Y + sin(q)*cos(b)*b' + cos(q)*sin(b)*q'\", \"W = Z + sin(b)*b'\"]\n"
          "lagrangian: m/2*(X^2 + Y^2 + Z^2) + M/2*(U^2 + V^2 + W^2) + g*((m + M)*cos(a) + M*cos(b))\n", "", "ls");
}

/* Other joints: a hand of a SCARA robot with a flywheel; a nut on a screw. */
Test(reduced_objects, schoenflies_joint, PLAIN_ONLY)
{
    check("hand", "name: hand\nparameters: [{name: m, value: 1.2}, {name: A, value: 0.4}]\n"
          "bodies: [{name: a, mass: m, inertia: [0.3, 0.4, 0.5], center: [0.1, 0.2, 0]}, {name: b, mass: 0.8, inertia: [A, 0.5, 0.2], center: [0.15, 0, 0.05]}]\n"
          "joints:\n  - {type: schoenflies, child: a, coordinates: [x, y, z, h]}\n  - {type: revolute, parent: a, child: b, axis: x, at: [0.4, 0, 0], coordinates: [p]}\n",
          " --group x=1;y=1;z=1;h=1,x=-y,y=x" INCLINED, "ls");
}

Test(reduced_objects, translating_screw, PLAIN_ONLY)
{
    check("nut", "name: nut\nparameters: [{name: m, value: 1.2}, {name: c, value: 0.3}]\n"
          "bodies: [{name: a, mass: 1, inertia: [0.3, 0.4, 0.5], center: [0.1, 0, 0.2]}, {name: b, mass: m, inertia: [0.4, 0.3, 0.2], center: [0, 0.2, 0.1]}]\n"
          "joints:\n  - {type: revolute, child: a, coordinates: [s]}\n  - {type: translating-screw, pitch: c, axis: x, parent: a, child: b, at: [0.2, 0, 0], coordinates: [y, z, p]}\n", " --group s=1", "ls");
}

/* A blade at the end of an arm on a free cart: the constraint goes across the chain. */
Test(reduced_objects, constraint_across_a_chain, PLAIN_ONLY)
{
    check("arm with a blade", "name: arm\nparameters: [{name: m, value: 1.2}, {name: l, value: 0.5}]\n"
          "bodies: [{name: a, mass: m, inertia: [0.1, 0.1, 0.4]}, {name: b, mass: 0.7, inertia: [0.1, 0.1, 0.2], center: [0.2, 0, 0]}]\n"
          "joints:\n  - {type: planar, child: a, coordinates: [x, y, h]}\n  - {type: revolute, parent: a, child: b, at: [l, 0, 0], coordinates: [p]}\n"
          "wheels: [{type: knife-edge, body: b, at: [0.6, 0, 0], axis: y}]\n", " --group x=1;y=1;h=1,x=-y,y=x" INCLINED " --option lifts=1", "cl");
}

/* A metric that couples everything, and a constraint with two symmetries, one of which is not conserved. */
Test(reduced_objects, coupled_metric, PLAIN_ONLY)
{
    check("gears", "name: gears\nparameters: [{name: a, value: 1.2}, {name: b, value: 0.5}]\n"
          "coordinates: [{name: x, type: length}, {name: y, type: length}, {name: u, type: number}, {name: v, type: number}]\ndomain: {u: [0.3, 0.9], v: [0.4, 1.1]}\n"
          "lagrangian: (x'^2*(1 + u^2) + y'^2 + a*u'^2 + b*(1 + u^2)*v'^2)/2 + b*u*x'*v'/3 + y'*u'/4 - v^2/3\nconstraints: [\"y' = u*x' + v*u'\"]\n", " --group y=1;x=1", "cl");
}

/* Two driven wheels, and a mass that slides along a vertical axis and turns about it: a group that does not act freely, of which a part is taken. */
Test(reduced_objects, cart_with_a_cylindrical_joint, PLAIN_ONLY)
{
    check("cart", "name: cart\nparameters: [{name: m, value: 1.2}, {name: l, value: 0.5}, {name: r, value: 0.3}]\n"
          "bodies: [{name: cart, mass: m, inertia: [0.1, 0.1, 0.4], center: [0.1, 0, 0]}, {name: left, mass: 0.2, inertia: [0.01, 0.02, 0.01]},\n"
          "  {name: right, mass: 0.2, inertia: [0.01, 0.02, 0.01]}, {name: slider, mass: 0.4, inertia: [0.01, 0.01, 0.02]}]\n"
          "joints:\n  - {type: planar, child: cart, coordinates: [x, y, h]}\n  - {type: revolute, parent: cart, child: left, at: [0, l, 0], axis: y, coordinates: [a]}\n"
          "  - {type: revolute, parent: cart, child: right, at: [0, -l, 0], axis: y, coordinates: [b]}\n  - {type: cylindrical, parent: cart, child: slider, at: [0.3, 0, 0], axis: z, coordinates: [s, p]}\n"
          "wheels: [{type: rolling, body: left, axle: y, radius: r}, {type: rolling, body: right, axle: y, radius: r}]\n", "", "csl");
}

/* Two blades, one at the end of a rod that gets longer and shorter. */
Test(reduced_objects, blades_on_a_sliding_rod, PLAIN_ONLY)
{
    check("train", "name: train\nparameters: [{name: m, value: 1}, {name: k, value: 0.6}, {name: l, value: 0.4}]\n"
          "coordinates: [{name: x, type: length}, {name: y, type: length}, {name: h, type: angle}, {name: u, type: length}, {name: w, type: angle}]\n"
          "lagrangian: m/2*(x'^2 + y'^2) + 0.3*h'^2 + (u'^2 + (l + u)^2*(h' + w')^2)/4 + 0.1*(h' + w')^2 - k*u^2/2\ndomain: {u: [-0.2, 0.2], w: [0.4, 1.2]}\n"
          "constraints: [\"x'*sin(h) - y'*cos(h) = 0\", \"(x' - u'*sin(h + w))*sin(h + w) - (y' + u'*cos(h + w))*cos(h + w) = 0.2*(h' + w')\"]\n", "", "cl");
}

/* A group without a centre of its own line: Heisenberg's, and a constraint between its fields that changes with the shape. */
Test(reduced_objects, heisenberg_group)
{
    check("heisenberg", "name: heisenberg\nparameters: [{name: a, value: 0.7}, {name: b, value: 1.3}]\n"
          "coordinates: [{name: x, type: length}, {name: y, type: length}, {name: z, type: length}, {name: u, type: number}]\n"
          "lagrangian: (x'^2 + b*y'^2 + (z' + y*x')^2 + (1 + a*u^2)*u'^2)/2 + x'*u'/5 - u^2/2\nconstraints: [\"z' + y*x' = a*u*y'\"]\n", " --chain 1,3;2" INCLINED, "cl");
}

/* A tilted coin on a slope: of the plane's symmetries one translation is left. */
Test(reduced_objects, tilted_coin_on_a_slope, PLAIN_ONLY)
{
    check("coin", "name: coin\nparameters: [{name: m, value: 1.1}, {name: r, value: 0.5}, {name: g, value: 3}, {name: al, value: 0.3}]\n"
          "coordinates: [{name: th, type: angle}, {name: ph, type: angle}, {name: ps, type: angle}, {name: x, type: length}, {name: y, type: length}]\n"
          "definitions: [\"b = r*cos(th)\", \"z = r*sin(th)\"]\ndomain: {th: [0.5, 1.2]}\n"
          "lagrangian: m/2*((x' + z*th'*sin(ph) - b*ph'*cos(ph))^2 + (y' - z*th'*cos(ph) - b*ph'*sin(ph))^2 + b^2*th'^2) + m*r^2/8*(th'^2 + ph'^2*sin(th)^2) + m*r^2/4*(ps' + ph'*cos(th))^2"
          " - m*g*(z*cos(al) - sin(al)*(x - b*sin(ph)))\n"
          "constraints: [\"x' = -r*ps'*cos(ph)\", \"y' = -r*ps'*sin(ph)\"]\n", "", "c");
}

/* A rod that slides through a sleeve on a turning table, with a spring, and carries a flywheel: two commuting turns in the second stage. */
Test(reduced_objects, sleeve_on_a_table, PLAIN_ONLY)
{
    check("sleeve", "name: sleeve\nparameters: [{name: m, value: 1.2}, {name: I, value: 0.4}, {name: k, value: 2}]\n"
          "bodies: [{name: table, mass: 2, inertia: [0.4, 0.4, I]}, {name: rod, mass: m, inertia: [0.05, 0.3, 0.3], center: [0.2, 0, 0.1]}, {name: fly, mass: 0.3, inertia: [0.02, 0.04, 0.04]}]\n"
          "joints:\n  - {type: revolute, child: table, axis: z, coordinates: [p]}\n  - {type: cylindrical, parent: table, child: rod, at: [0, 0.3, 0.2], axis: x, coordinates: [s, u]}\n"
          "  - {type: revolute, parent: rod, child: fly, at: [0.4, 0, 0], axis: x, coordinates: [f]}\n", " --group p=1;f=1", "ls");
}

/* d Theta = d/dx of y/(1 + (e - k) x^2 + y^2) dy: closed for e = k alone; and for no parameters where it is -2 x y/(1 + x^2 + y^2)^2 (1 + e^2). */
Test(reduced_objects, parameters_with_a_measure)
{
    static const struct {
        const char *weight, *where;
    } cases[] = {{"(e - k)", "[[[\"e-k\"]]]"}, {"(1 + e^2)", "[[[\"e^2+1\"]]]"}, {"7", "[[]]"}, {"k*(e - 2*k)^2", "[[[\"k\"],[\"e-2*k\"]]]"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[600];
        snprintf(text, sizeof text, "name: weighted\nparameters: [{name: e, value: 0.7}, {name: k, value: 0.2}]\ncoordinates: [{name: x, type: length}, {name: y, type: length}, {name: z, type: length}]\n"
                 "domain: {x: [0.2, 0.6], y: [0.2, 0.6]}\nlagrangian: ((1 + %s*x^2)*x'^2 + y'^2 + z'^2)/2\nconstraints: [\"z' = y*x'\"]\n", cases[i].weight);
        reduced_sheet s = reduced_from("own.yaml", text, 0, NULL, " --group z=1", 0);
        char *where = cJSON_PrintUnformatted(oracle_get(oracle_get(s.stage, "measure"), "measure_where")), *to = where;
        for (const char *c = where; (*to = *c); c++) to += *c != ' ';
        cr_expect_str_eq(where, cases[i].where, "%s: %s", cases[i].weight, where);
        free(where);
        reduced_clear(&s);
    }
}
