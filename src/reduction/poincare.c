/* The Lagrange-d'Alembert-Poincare equations at sample points, against the true accelerations (poincare.h).
 *
 *      values of K, omega, V and their first derivatives in the frame      place_values
 *      A and its derivatives: bordered system of K_ee and om_e             connection, curvature
 *      u' from the equations with multipliers in the same frame            accelerations
 *      both sides of (26) in one stage, and by stages along the chain      vertical, horizontal
 *      ad* in one stage and by stages                                      euler_poincare
 *
 * Each residual is relative to the sum of the moduli of its terms, so that it tells rounding from a wrong equation. */
#include "reduction/poincare.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/diff.h"
#include "reduction/subspace.h"

/* Everything at one place.  K (m x m), dK (n of them), omega (f x m, row-major), domega; dV (n).  A (d x n), dA (n of
   them: dA[l] = d_l A). */
typedef struct {
    const nh_slice *s;
    size_t m, n, d, f;
    double *K, *dK, *omega, *domega, *dV;
    double *A, *dA, *B; /* B[(a*n + i)*n + j] */
    double *chi;        /* d x r */
    size_t r;
    double *u, *du, *momentum, *rate; /* m each: (x', zeta), its derivative, Kf u, (Kf u)' */
    double *v;                        /* d */
    /* m each: the sums of the moduli of their terms, with which residuals are compared */
    double *of_momentum, *of_rate;
    const double *lifts; /* inner product of the generators for the lifts; NULL: that of the kinetic energy */
} place;

static nh_ex *list(const nh_slice *s, size_t *total)
{
    size_t m = s->m, n = s->n, f = s->f, at = 0;
    *total = (m * m + f * m) * (1 + n) + n;
    nh_ex *e = nh_alloc_array(*total + 1, sizeof *e);
    for (size_t i = 0; i < m * m; i++) e[at++] = s->K[i];
    for (size_t l = 0; l < n; l++)
        for (size_t i = 0; i < m * m; i++) e[at++] = nh_diff(s->dag, s->K[i], s->x[l]);
    for (size_t i = 0; i < f * m; i++) e[at++] = s->omega[i];
    for (size_t l = 0; l < n; l++)
        for (size_t i = 0; i < f * m; i++) e[at++] = nh_diff(s->dag, s->omega[i], s->x[l]);
    for (size_t l = 0; l < n; l++) e[at++] = nh_diff(s->dag, s->V, s->x[l]);
    return e;
}

static void place_init(place *p, const nh_slice *s)
{
    size_t m = s->m, n = s->n, d = s->d;
    *p = (place){.s = s, .m = m, .n = n, .d = d, .f = s->f};
    p->A = nh_alloc_array(d * n * (1 + n) + d * n * n + d * d + 6 * m + d + 1, sizeof *p->A);
    p->dA = p->A + d * n;
    p->B = p->dA + d * n * n;
    p->chi = p->B + d * n * n;
    p->u = p->chi + d * d;
    p->du = p->u + m;
    p->momentum = p->du + m;
    p->rate = p->momentum + m;
    p->of_momentum = p->rate + m;
    p->of_rate = p->of_momentum + m;
    p->v = p->of_rate + m;
}

static void place_values(place *p, double *z)
{
    size_t m = p->m, n = p->n, f = p->f;
    p->K = z;
    p->dK = p->K + m * m;
    p->omega = p->dK + n * m * m;
    p->domega = p->omega + f * m;
    p->dV = p->domega + n * f * m;
}

/* a x = b for a symmetric a, in units in which its blocks have size one: a_ij scale_i scale_j, b_i scale_i, x_i /
   scale_i. */
static bool solve_scaled(size_t size, const double *scale, double *a, size_t n, double *b, double *rcond)
{
    for (size_t i = 0; i < size * size; i++) a[i] *= scale[i % size] * scale[i / size];
    for (size_t i = 0; i < size * n; i++) b[i] *= scale[i % size];
    bool good = nh_solve(size, a, n, b, rcond);
    for (size_t i = 0; i < size * n && good; i++) b[i] *= scale[i % size];
    return good;
}

/* 1 / sqrt(K_ee) of each generator, and one over the length of each form. */
static void units_of(const place *p, double *scale)
{
    size_t m = p->m, n = p->n, d = p->d;
    for (size_t r = 0; r < d; r++) scale[r] = p->K[(n + r) * (m + 1)] > 0 ? 1 / sqrt(p->K[(n + r) * (m + 1)]) : 1;
    for (size_t c = 0; c < p->f; c++) {
        double length = 0;
        for (size_t r = 0; r < d; r++) length = hypot(length, p->omega[c * m + n + r] * scale[r]);
        scale[d + c] = length > 0 ? 1 / length : 1;
    }
}

/* [Kf_ee om_e^T; om_e 0] (A_i; lambda) = (Kf_ei; om_x,i), and the same differentiated: the connection and its
   derivatives.  With an inner product of the generators g0 for Kf_ee, and 0 for Kf_ei. */
static bool connection(place *p)
{
    const double *g0 = p->lifts;
    size_t m = p->m, n = p->n, d = p->d, f = p->f, size = d + f;
    double *a = nh_alloc_array(size * size + 2 * size * n + size + 1, sizeof *a), *sol = a + size * size,
           *right = sol + size * n, *scale = right + size * n;
    bool good = true;
    units_of(p, scale);
    for (size_t l = 0; l <= n && good; l++) { /* l = 0: the solution itself */
        const double *dK = p->dK + (l ? l - 1 : 0) * m * m, *dw = p->domega + (l ? l - 1 : 0) * f * m;
        memset(a, 0, size * size * sizeof *a);
        for (size_t i = 0; i < d; i++) {
            for (size_t j = 0; j < d; j++) a[i + j * size] = g0 ? g0[i * d + j] : p->K[(n + i) * m + n + j];
            for (size_t c = 0; c < f; c++) a[i + (d + c) * size] = a[d + c + i * size] = p->omega[c * m + n + i];
        }
        for (size_t i = 0; i < n; i++) {
            double *b = right + i * size;
            for (size_t r = 0; r < d; r++) b[r] = g0 ? 0 : l ? dK[(n + r) * m + i] : p->K[(n + r) * m + i];
            for (size_t c = 0; c < f; c++) b[d + c] = l ? dw[c * m + i] : p->omega[c * m + i];
            for (size_t r = 0; r < d && l; r++) {
                for (size_t j = 0; j < d && !g0; j++) b[r] -= dK[(n + r) * m + n + j] * sol[j + i * size];
                for (size_t c = 0; c < f; c++) {
                    b[r] -= dw[c * m + n + r] * sol[d + c + i * size];
                    b[d + c] -= dw[c * m + n + r] * sol[r + i * size];
                }
            }
        }
        double rcond = 1;
        if (n) good = solve_scaled(size, scale, a, n, right, &rcond) && rcond > 1e-13;
        double *out = l ? p->dA + (l - 1) * d * n : p->A;
        if (!l) memcpy(sol, right, size * n * sizeof *sol);
        for (size_t i = 0; i < n; i++)
            for (size_t r = 0; r < d; r++) out[r * n + i] = right[r + i * size];
    }
    nh_free(a);
    return good;
}

static void curvature(place *p)
{
    const nh_algebra *g = &p->s->action->algebra;
    size_t n = p->n, d = p->d;
    for (size_t a = 0; a < d; a++)
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++) {
                double sum = p->dA[i * d * n + a * n + j] - p->dA[j * d * n + a * n + i];
                for (size_t b = 0; b < d; b++)
                    for (size_t c = 0; c < d; c++) sum -= g->c[(b * d + c) * d + a] * p->A[b * n + i] * p->A[c * n + j];
                p->B[(a * n + i) * n + j] = sum;
            }
}

/* u in ker omf: the velocity of the sample in the frame; (Kf u)' from the equations with multipliers in the frame. */
static bool accelerations(place *p)
{
    const nh_algebra *g = &p->s->action->algebra;
    size_t m = p->m, n = p->n, d = p->d, f = p->f, size = m + f;
    double *a = nh_alloc_array(size * size + size + 1, sizeof *a), *b = a + size * size;
    for (size_t i = 0; i < m; i++) {
        p->momentum[i] = p->of_momentum[i] = p->of_rate[i] = 0;
        for (size_t j = 0; j < m; j++) {
            a[i + j * size] = p->K[i * m + j];
            p->momentum[i] += p->K[i * m + j] * p->u[j];
            p->of_momentum[i] += fabs(p->K[i * m + j] * p->u[j]);
            for (size_t l = 0; l < n; l++) b[i] -= p->u[l] * p->dK[l * m * m + i * m + j] * p->u[j];
        }
        for (size_t c = 0; c < f; c++)
            a[m + c + i * size] = p->omega[c * m + i], a[i + (m + c) * size] = -p->omega[c * m + i];
    }
    for (size_t i = 0; i < n; i++) {
        b[i] -= p->dV[i];
        p->of_rate[i] += fabs(p->dV[i]);
        for (size_t r = 0; r < m; r++)
            for (size_t c = 0; c < m; c++) {
                double term = 0.5 * p->u[r] * p->dK[i * m * m + r * m + c] * p->u[c];
                b[i] += term;
                p->of_rate[i] += fabs(term);
            }
    }
    for (size_t k = 0; k < d; k++)
        for (size_t c = 0; c < d; c++)
            for (size_t l = 0; l < d; l++) {
                double of_pair = g->c[(c * d + k) * d + l] * p->u[n + c];
                b[n + k] += of_pair * p->momentum[n + l];
                p->of_rate[n + k] += fabs(of_pair) * p->of_momentum[n + l];
            }
    for (size_t c = 0; c < f; c++)
        for (size_t l = 0; l < n; l++)
            for (size_t j = 0; j < m; j++) b[m + c] -= p->u[l] * p->domega[l * f * m + c * m + j] * p->u[j];
    bool good = nh_solve(size, a, 1, b, NULL);
    for (size_t i = 0; i < m && good; i++) {
        p->du[i] = b[i];
        p->rate[i] = 0;
        for (size_t j = 0; j < m; j++) {
            p->rate[i] += p->K[i * m + j] * b[j];
            p->of_rate[i] += fabs(p->K[i * m + j] * b[j]);
            for (size_t l = 0; l < n; l++) {
                double term = p->u[l] * p->dK[l * m * m + i * m + j] * p->u[j];
                p->rate[i] += term;
                p->of_rate[i] += fabs(term);
            }
        }
    }
    nh_free(a);
    return good;
}

/* The vectors of the group that the constraints allow, chi; in the units of units_of, so that no form or generator is
 * small because of its unit. */
static void distribution(place *p, double small)
{
    size_t m = p->m, n = p->n, d = p->d, f = p->f;
    double *forms = nh_alloc_array(f * d + d + f + 1, sizeof *forms), *scale = forms + f * d;
    units_of(p, scale);
    for (size_t c = 0; c < f; c++)
        for (size_t a = 0; a < d; a++) forms[c + a * f] = p->omega[c * m + n + a] * scale[a] * scale[d + c];
    p->r = nh_kernel(f, d, forms, small, p->chi, NULL, NULL);
    for (size_t j = 0; j < p->r; j++)
        for (size_t a = 0; a < d; a++) p->chi[a + j * d] *= scale[a];
    for (size_t a = 0; a < d; a++) {
        p->v[a] = p->u[n + a];
        for (size_t i = 0; i < n; i++) p->v[a] += p->A[a * n + i] * p->u[i];
    }
    nh_free(forms);
}

/* <a, b> = sum_k a_k b_k. */
static double pairing(size_t d, const double *a, const double *b)
{
    double sum = 0;
    for (size_t i = 0; i < d; i++) sum += a[i] * b[i];
    return sum;
}

/* off|/size; |off| where there is no size. */
static double beside(double off, double size) { return size > 0 ? fabs(off) / size : fabs(off); }

/* sum_bc |c^a_bc x_b y_c| */
static void bracket_terms(const nh_algebra *g, const double *x, const double *y, double *out)
{
    size_t d = g->d;
    memset(out, 0, d * sizeof *out);
    for (size_t i = 0; i < d * d * d; i++) out[i % d] += fabs(g->c[i] * x[i / d / d] * y[i / d % d]);
}

/* sum_a |mu_a'| |x_a| + |mu_a| |y_a|, of their terms; y >= 0. */
static double terms_of(const place *p, const double *x, const double *y)
{
    double sum = 0;
    for (size_t a = 0; a < p->d; a++) sum += p->of_rate[p->n + a] * fabs(x[a]) + p->of_momentum[p->n + a] * y[a];
    return sum;
}

/* The largest bracket of vectors as long as x and y, by the metric: max_a sum_bc |c^a_bc| s_a / (s_b s_c) |x| |y|, s_a
   = sqrt(K_aa). */
static double largest_bracket(const place *p, const nh_algebra *g, const double *unit, const double *x, const double *y)
{
    size_t d = p->d;
    double most = 0, of_x = 0, of_y = 0;
    for (size_t a = 0; a < d; a++) {
        double sum = 0;
        for (size_t i = a; i < d * d * d; i += d) sum += fabs(g->c[i]) * unit[a] / (unit[i / d / d] * unit[i / d % d]);
        most = fmax(most, sum);
        of_x = fmax(of_x, unit[a] * fabs(x[a]));
        of_y = fmax(of_y, unit[a] * fabs(y[a]));
    }
    return most * of_x * of_y;
}

/* dl/dx^i at constant (x', v), and pi_i'. */
static void horizontal_terms(const place *p, size_t i, double *slope, double *rate, double *size)
{
    size_t m = p->m, n = p->n, d = p->d;
    const double *mu = p->momentum + n;
    *slope = -p->dV[i];
    *rate = p->rate[i];
    *size = p->of_rate[i]; /* dV and the kinetic terms are among these */
    for (size_t r = 0; r < m; r++)
        for (size_t c = 0; c < m; c++) *slope += 0.5 * p->u[r] * p->dK[i * m * m + r * m + c] * p->u[c];
    for (size_t a = 0; a < d; a++) {
        const double *dA = p->dA + a * n;
        for (size_t j = 0; j < n; j++) {
            *slope -= mu[a] * dA[i * d * n + j] * p->u[j];
            *rate -= mu[a] * p->u[j] * dA[j * d * n + i];
            *size += p->of_momentum[n + a] * fabs(p->u[j]) * (fabs(dA[i * d * n + j]) + fabs(dA[j * d * n + i]));
        }
        *rate -= p->rate[n + a] * p->A[a * n + i];
        *size += p->of_rate[n + a] * fabs(p->A[a * n + i]);
    }
}

typedef struct {
    double *zeta, *bracket, *pa, *pb, *pc, *beta, *phi, *terms, *unit; /* d each */
} scratch;

/* mu'(chi) = mu([zeta, chi]) for each chi, with zeta = v - A x': in one stage, by stages, and the bracket itself by
 * stages. */
static void vertical(const place *p, const nh_ideals *c, const scratch *t, nh_poincare *out)
{
    const nh_algebra *g = &p->s->action->algebra;
    size_t d = p->d, n = p->n;
    const double *mu = p->momentum + n, *dmu = p->rate + n;
    double *dbeta = t->phi;
    for (size_t a = 0; a < d; a++) t->unit[a] = p->K[(n + a) * (p->m + 1)] > 0 ? sqrt(p->K[(n + a) * (p->m + 1)]) : 1;
    nh_ideals_split(c, p->u + n, t->pa); /* zeta = v - A x' */
    nh_ideals_split_covector(c, mu, t->beta);
    nh_ideals_split_covector(c, dmu, dbeta);
    for (size_t k = 0; k < p->r; k++) {
        const double *chi = p->chi + k * d;
        nh_algebra_bracket(g, p->u + n, chi, t->bracket);
        bracket_terms(g, p->u + n, chi, t->terms);
        double size = terms_of(p, chi, t->terms), longest = largest_bracket(p, g, t->unit, p->u + n, chi);
        out->one_vertical = fmax(out->one_vertical, beside(pairing(d, dmu, chi) - pairing(d, mu, t->bracket), size));
        nh_ideals_split(c, chi, t->pb);
        nh_ideals_bracket(c, t->pa, t->pb, t->pc);
        out->stages_vertical =
            fmax(out->stages_vertical, beside(pairing(d, dbeta, t->pb) - pairing(d, t->beta, t->pc), size));
        nh_ideals_join(c, t->pc, t->zeta);
        for (size_t a = 0; a < d; a++)
            out->bracket = fmax(out->bracket, beside(t->unit[a] * (t->zeta[a] - t->bracket[a]), longest));
    }
}

/* pi_i' against dl/dx^i - mu_a B^a_ji x'^j + mu([A_i, v]) for each i, in one stage and by stages. */
static void horizontal(const place *p, const nh_ideals *c, const scratch *t, nh_poincare *out)
{
    const nh_algebra *g = &p->s->action->algebra;
    size_t d = p->d, n = p->n;
    const double *mu = p->momentum + n;
    nh_ideals_split_covector(c, mu, t->beta);
    nh_ideals_split(c, p->v, t->pb);
    for (size_t i = 0; i < n; i++) {
        double slope, rate, size;
        horizontal_terms(p, i, &slope, &rate, &size);
        for (size_t a = 0; a < d; a++) {
            t->zeta[a] = p->A[a * n + i];
            t->phi[a] = 0; /* B_ji x'^j */
            for (size_t j = 0; j < n; j++) t->phi[a] += p->B[(a * n + j) * n + i] * p->u[j];
        }
        nh_algebra_bracket(g, t->zeta, p->v, t->bracket);
        bracket_terms(g, t->zeta, p->v, t->terms);
        for (size_t a = 0; a < d; a++) size += p->of_momentum[n + a] * (fabs(t->phi[a]) + t->terms[a]);
        double want = slope - pairing(d, mu, t->phi) + pairing(d, mu, t->bracket);
        out->one_horizontal = fmax(out->one_horizontal, beside(rate - want, size));
        nh_ideals_split(c, t->zeta, t->pa);
        nh_ideals_bracket(c, t->pa, t->pb, t->pc);
        nh_ideals_split(c, t->phi, t->pa);
        for (size_t a = 0; a < d; a++) t->pa[a] -= t->pc[a];
        out->stages_horizontal = fmax(out->stages_horizontal, beside(slope - rate - pairing(d, t->beta, t->pa), size));
    }
}

/* ad*_eta mu in one stage and by stages. */
static void euler_poincare(const place *p, const nh_ideals *c, const scratch *t, nh_poincare *out)
{
    const nh_algebra *g = &p->s->action->algebra;
    size_t d = p->d, n = p->n;
    nh_algebra_coad(g, p->u + n, p->momentum + n, t->bracket);
    nh_ideals_split_covector(c, t->bracket, t->pc);
    nh_ideals_split(c, p->u + n, t->pa);
    nh_ideals_split_covector(c, p->momentum + n, t->beta);
    nh_ideals_euler_poincare(c, t->pa, t->beta, t->pb);
    double size = 0;
    memset(t->terms, 0, d * sizeof *t->terms);
    for (size_t i = 0; i < d * d * d; i++)
        t->terms[i / d % d] += fabs(g->c[i] * p->u[n + i / d / d]) * p->of_momentum[n + i % d];
    for (size_t a = 0; a < d; a++) size = fmax(size, t->terms[a]);
    for (size_t a = 0; a < d; a++) out->euler_poincare = fmax(out->euler_poincare, beside(t->pb[a] - t->pc[a], size));
}

bool nh_poincare_check(nh_poincare *out, const nh_slice *s, const nh_ideals *c, const double *lifts,
                       const nh_options *options, nh_error *error)
{
    enum { most_places = 12 };
    const nh_kinetic *k = s->kinetic;
    size_t total, m = s->m, d = s->d;
    nh_ex *e = list(s, &total);
    double *z = nh_alloc_array(total + 1, sizeof *z), *work = nh_alloc_array(9 * d + 2 * m + 1, sizeof *work),
           *q = work + 9 * d;
    nh_tape *tape = nh_kinetic_tape(k, total, e);
    nh_tape_work *tape_work = nh_tape_work_create(tape);
    scratch t = {work,         work + d,     work + 2 * d, work + 3 * d, work + 4 * d,
                 work + 5 * d, work + 6 * d, work + 7 * d, work + 8 * d};
    place p;
    bool good = true;
    *out = (nh_poincare){0};
    place_init(&p, s);
    p.lifts = lifts;
    for (size_t at = 0; at < k->places && out->places < most_places && good; at++) {
        memcpy(q, k->place + at * m, m * sizeof *q);
        for (size_t a = 0; a < d; a++) q[s->along[a]] = s->y0[a];
        nh_tape_eval(tape, tape_work, q, z);
        place_values(&p, z);
        if (!isfinite(nh_largest(total, z))) continue;
        if (!connection(&p)) {
            good = nh_fail(error, NH_NUMERIC, "",
                           "V + D is not TQ: the momenta of the group do not determine a connection");
            break;
        }
        for (size_t i = 0; i < s->n; i++) p.u[i] = k->speed[at * m + s->shape[i]];
        distribution(&p, options->group);
        for (size_t a = 0; a < d; a++) { /* u = (x', -A x' + a vector of S) */
            p.u[s->n + a] = 0;
            for (size_t i = 0; i < s->n; i++) p.u[s->n + a] -= p.A[a * s->n + i] * p.u[i];
            for (size_t j = 0; j < p.r; j++) p.u[s->n + a] += p.chi[a + j * d] * k->speed[at * m + (j + s->n) % m];
        }
        distribution(&p, options->group);
        if (!accelerations(&p)) continue;
        curvature(&p);
        out->dimension = p.r;
        out->curvature = fmax(out->curvature, nh_largest(d * s->n * s->n, p.B));
        vertical(&p, c, &t, out);
        horizontal(&p, c, &t, out);
        euler_poincare(&p, c, &t, out);
        out->places++;
    }
    nh_tape_work_free(tape_work);
    nh_tape_free(tape);
    nh_free(p.A);
    nh_free(e);
    nh_free(z);
    nh_free(work);
    return good && (out->places > 0 || nh_fail(error, NH_NUMERIC, "",
                                               "the equations by stages could not be evaluated at any sample point"));
}
