#include "reduction/jets.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "expr/diff.h"
#include "reduction/subspace.h"
#include "reduction/transport.h"

enum { rays = 5, most_rays = 40, triangles = 2, halvings = 8 };

/* Rows of the conditions, apart, so that each can be left out. */
typedef struct {
    size_t columns, rows[3], capacity[3];
    double *row[3]; /* 0: metric and triangles; 1: potential; 2: constraints; row by row */
} conditions;

typedef struct {
    const nh_kinetic *kinetic;
    const nh_options *options;
    nh_transport t;
    nh_tape *tape; /* V's gradient and second derivatives, omega and its derivatives, b, a and theirs */
    nh_tape_work *work;
    nh_tape *force; /* Q and its derivatives by q and v, of both; NULL without forces */
    nh_tape_work *force_work;
    double *out, *x;
    size_t m, f, columns;
    conditions c;
} search;

static double *new_row(search *s, int kind)
{
    conditions *c = &s->c;
    nh_grow(&c->row[kind], &c->capacity[kind], (c->rows[kind] + 1) * c->columns, sizeof *c->row[kind]);
    return c->row[kind] + c->rows[kind]++ * c->columns;
}

static size_t forms_total(const nh_kinetic *k) { return (2 * k->m + k->f * (1 + k->m)) * (1 + k->m) + 1; }

static nh_tape *forms_tape(const nh_kinetic *k)
{
    size_t m = k->m, f = k->f, n = 0;
    nh_ex *e = nh_alloc_array(forms_total(k), sizeof *e);
    for (size_t s = 0; s < m; s++) e[n++] = nh_diff(k->dag, k->V, k->q[s]);
    for (size_t s = 0; s < m; s++)
        for (size_t r = 0; r < m; r++) e[n++] = nh_diff(k->dag, e[s], k->q[r]);
    for (size_t i = 0; i < f * m; i++) e[n++] = k->omega[i];
    for (size_t s = 0; s < m; s++)
        for (size_t i = 0; i < f * m; i++) e[n++] = nh_diff(k->dag, k->omega[i], k->q[s]);
    for (size_t i = 0; i < f; i++) e[n++] = k->b[i];
    for (size_t s = 0; s < m; s++)
        for (size_t i = 0; i < f; i++) e[n++] = nh_diff(k->dag, k->b[i], k->q[s]);
    for (size_t i = 0; i < m; i++) e[n++] = k->a[i];
    for (size_t s = 0; s < m; s++)
        for (size_t i = 0; i < m; i++) e[n++] = nh_diff(k->dag, k->a[i], k->q[s]);
    nh_tape *tape = nh_kinetic_tape(k, n, e);
    nh_free(e);
    return tape;
}

static nh_tape *force_tape(const nh_kinetic *k)
{
    size_t m = k->m, n = 0;
    if (!k->forced) return NULL;
    nh_ex *e = nh_alloc_array(m * (1 + 2 * m) + 2 * m, sizeof *e), *in = e + m * (1 + 2 * m);
    memcpy(in, k->q, m * sizeof *in);
    memcpy(in + m, k->v, m * sizeof *in);
    for (size_t s = 0; s < m; s++) e[n++] = k->Q[s];
    for (size_t l = 0; l < 2 * m; l++)
        for (size_t s = 0; s < m; s++) e[n++] = nh_diff(k->dag, k->Q[s], in[l]);
    const nh_model *y = k->model;
    nh_tape *tape = nh_tape_create(k->dag, 2 * m, in, n, e, y->system->parameters, y->parameter, y->parameter_value);
    nh_free(e);
    return tape;
}

/* (L_xi K)_ij = xi^l d_l K_ij + K_lj B^l_i + K_il B^l_j, divided by (K_ii K_jj)^(1/2); the transport stands at the place. */
static void metric_rows(search *s, const double *jets)
{
    size_t m = s->m, size = s->t.size;
    const double *K = s->t.K, *dK = s->t.dK;
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j <= i; j++) {
            double *row = new_row(s, 0), unit = 1 / sqrt(K[i + m * i] * K[j + m * j]);
            for (size_t c = 0; c < s->columns; c++) {
                const double *xi = jets + c * size, *B = xi + m;
                double sum = 0;
                for (size_t l = 0; l < m; l++) sum += xi[l] * dK[i + m * (j + m * l)] + K[l + m * j] * B[l + m * i] + K[i + m * l] * B[l + m * j];
                row[c] = sum * unit;
            }
        }
}

/* xi(V) = 0 and its derivatives B^l_k d_l V + xi^l d_k d_l V = 0, divided by the size of dV at the place: near a singularity of V it would hide
 * all the others. */
static void potential_rows(search *s, const double *jets)
{
    size_t m = s->m;
    const double *c = s->t.scale, *dV = s->out, *ddV = s->out + m;
    double slope = 0;
    for (size_t l = 0; l < m; l++) {
        slope = fmax(slope, fabs(dV[l]) * c[l]);
        for (size_t k = 0; k < m; k++) slope = fmax(slope, fabs(ddV[l * m + k]) * c[l] * c[k]);
    }
    for (size_t k = 0; k <= m && slope > 0; k++) { /* k = m: the value itself */
        double *row = new_row(s, 1);
        for (size_t col = 0; col < s->columns; col++) {
            const double *xi = jets + col * s->t.size, *B = xi + m;
            row[col] = 0;
            for (size_t l = 0; l < m; l++)
                row[col] += k == m ? xi[l] * dV[l] * c[l] / slope : (B[l + m * k] * dV[l] * c[l] + xi[l] * ddV[l * m + k] * c[l] * c[k]) / slope;
        }
    }
}

/* (L_xi a)_i = xi^l d_l a_i + a_l B^l_i, divided by the size of a and da at the place. */
static void magnetic_rows(search *s, const double *jets)
{
    size_t m = s->m, f = s->f;
    const double *c = s->t.scale, *a = s->out + (m + f * m + f) * (1 + m), *da = a + m;
    double size = 0;
    for (size_t i = 0; i < m; i++) {
        size = fmax(size, fabs(a[i]) * c[i]);
        for (size_t l = 0; l < m; l++) size = fmax(size, fabs(da[l * m + i]) * c[l] * c[i]);
    }
    for (size_t i = 0; i < m && size > 0; i++) {
        double *row = new_row(s, 1);
        for (size_t col = 0; col < s->columns; col++) {
            const double *xi = jets + col * s->t.size, *B = xi + m;
            row[col] = 0;
            for (size_t l = 0; l < m; l++) row[col] += (xi[l] * da[l * m + i] * c[l] * c[i] + a[l] * c[l] * B[l + m * i]) / size;
        }
    }
}

/* Affine constraints, with v0 (scaled) of least length that satisfies them: (L_xi omega)(v0) + xi(b) = 0, forms of length `norm`. */
static void affine_rows(search *s, const double *jets, const double *norm, const double *v0)
{
    size_t m = s->m, f = s->f, size = s->t.size;
    const double *c = s->t.scale, *omega = s->out + m * (1 + m), *domega = omega + f * m, *b = omega + f * m * (1 + m), *db = b + f;
    for (size_t a = 0; a < f && !s->kinetic->linear; a++) {
        if (!(norm[a] > 0)) continue;
        double unit = 1 / norm[a] / (1 + fabs(b[a]) / norm[a]), *row = new_row(s, 2);
        for (size_t col = 0; col < s->columns; col++) {
            const double *xi = jets + col * size, *B = xi + m;
            double sum = 0;
            for (size_t l = 0; l < m; l++) {
                sum += xi[l] * db[l * f + a] * c[l];
                for (size_t i = 0; i < m; i++) sum += (xi[l] * domega[l * f * m + a * m + i] * c[l] * c[i] + omega[a * m + l] * c[l] * B[l + m * i]) * v0[i];
            }
            row[col] = sum * unit;
        }
    }
}

/* (L_xi Q)_s = xi^l d_l Q_s + B^l_r v^r dQ_s/dv^l + Q_l B^l_s at two velocities v0 + X w that the constraints allow; X (m x n) and v0 scaled. */
static void force_rows(search *s, const double *q, const double *jets, size_t n, const double *X, const double *v0)
{
    size_t m = s->m, size = s->t.size;
    const double *c = s->t.scale;
    double *z = nh_alloc_array(3 * m + m * (1 + 2 * m), sizeof *z), *v = z + 2 * m, *Q = v + m, *dq = Q + m, *dv = dq + m * m;
    memcpy(z, q, m * sizeof *z);
    for (int trial = 0; trial < 2 && s->force; trial++) {
        double most = 0;
        for (size_t i = 0; i < m; i++) {
            v[i] = v0[i];
            for (size_t k = 0; k < n; k++) v[i] += X[i + m * k] * sin(1.3 + (double)k * 2.1 + trial * 1.7);
            z[m + i] = v[i] * c[i];
        }
        nh_tape_eval(s->force, s->force_work, z, Q);
        for (size_t i = 0; i < m * (1 + 2 * m); i++) most = isfinite(Q[i]) ? fmax(most, fabs(Q[i])) : INFINITY;
        for (size_t i = 0; i < m && most > 0 && isfinite(most); i++) {
            double *row = new_row(s, 2);
            for (size_t col = 0; col < s->columns; col++) {
                const double *xi = jets + col * size, *B = xi + m;
                double sum = 0;
                for (size_t l = 0; l < m; l++) {
                    sum += xi[l] * c[l] * dq[l * m + i] * c[i] + Q[l] * c[l] * B[l + m * i];
                    for (size_t r = 0; r < m; r++) sum += B[l + m * r] * v[r] * c[l] * dv[l * m + i] * c[i];
                }
                row[col] = sum / most;
            }
        }
    }
    nh_free(z);
}

/* (L_xi omega)_i = xi^s d_s omega_i + omega_s B^s_i on an orthonormal basis X of D (scaled coordinates), forms of length one. */
static void constraint_rows(search *s, const double *q, const double *jets)
{
    size_t m = s->m, f = s->f, size = s->t.size;
    const double *c = s->t.scale, *omega = s->out + m + m * m, *domega = omega + f * m;
    double *forms = nh_alloc_array(f * m + m * m + m + 1, sizeof *forms), *X = forms + f * m, *lie = X + m * m, *norm = nh_alloc_array(f + 1, sizeof *norm);
    for (size_t a = 0; a < f; a++) {
        for (size_t i = 0; i < m; i++) norm[a] = hypot(norm[a], omega[a * m + i] * c[i]);
        for (size_t i = 0; i < m; i++) forms[a + f * i] = norm[a] > 0 ? omega[a * m + i] * c[i] / norm[a] : 0;
    }
    size_t n = nh_kernel(f, m, forms, s->options->group, X, NULL, NULL);
    for (size_t a = 0; a < f; a++)
        for (size_t k = 0; k < n; k++) {
            double *row = new_row(s, 2);
            for (size_t col = 0; col < s->columns; col++) {
                const double *xi = jets + col * size, *B = xi + m;
                double sum = 0;
                for (size_t i = 0; i < m; i++) {
                    lie[i] = 0;
                    for (size_t l = 0; l < m && norm[a] > 0; l++)
                        lie[i] += xi[l] * domega[l * f * m + a * m + i] * c[l] * c[i] / norm[a] + forms[a + f * l] * B[l + m * i];
                    sum += lie[i] * X[i + m * k];
                }
                row[col] = sum;
            }
        }
    double *least = nh_alloc_array(f * m + f + m + 1, sizeof *least), *v0 = least + f * m; /* forms v0 = -b / norm */
    const double *b = omega + f * m * (1 + m);
    memcpy(least, forms, f * m * sizeof *least);
    for (size_t a = 0; a < f; a++) v0[a] = norm[a] > 0 ? -b[a] / norm[a] : 0;
    if (f && !s->kinetic->linear) nh_least_squares(f, m, least, 1, v0, m > f ? m : f, 1e-12);
    else memset(v0, 0, m * sizeof *v0);
    affine_rows(s, jets, norm, v0);
    force_rows(s, q, jets, n, X, v0);
    nh_free(least);
    nh_free(forms);
    nh_free(norm);
}

static bool conditions_at(search *s, const double *q, const double *jets)
{
    memset(s->x, 0, s->m * sizeof *s->x);
    if (!nh_transport_at(&s->t, q, s->x)) return false;
    nh_tape_eval(s->tape, s->work, q, s->out);
    metric_rows(s, jets);
    potential_rows(s, jets);
    magnetic_rows(s, jets);
    constraint_rows(s, q, jets);
    return true;
}

/* The jets at q0 with L_xi K = 0: B = K^-1 (A - 1/2 xi^l d_l K), A antisymmetric. */
static void first_jets(search *s, double *jets)
{
    size_t m = s->m, size = s->t.size, column = 0;
    double *S = nh_alloc_array(m * m, sizeof *S);
    for (size_t l = 0; l < m; l++, column++) {
        jets[column * size + l] = 1;
        for (size_t i = 0; i < m * m; i++) S[i] = -0.5 * s->t.dK[i + m * m * l];
        nh_multiply(m, m, m, s->t.Kinv, S, jets + column * size + m);
    }
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < i; j++, column++) {
            memset(S, 0, m * m * sizeof *S);
            S[i + m * j] = 1;
            S[j + m * i] = -1;
            nh_multiply(m, m, m, s->t.Kinv, S, jets + column * size + m);
        }
    nh_free(S);
}

/* Toward a sample point, as far as the way is free. */
static bool follow_ray(search *s, const double *q0, const double *target, const double *jets, double *end, double *moved)
{
    double part = 1;
    size_t length = s->t.size * s->columns;
    for (int i = 0; i < halvings; i++, part /= 2) {
        for (size_t j = 0; j < s->m; j++) end[j] = q0[j] + part * (target[j] - q0[j]);
        memcpy(moved, jets, length * sizeof *moved);
        if (nh_transport_along(&s->t, q0, end, s->columns, moved, s->options->transport)) return true;
    }
    return false;
}

static void triangle_rows(search *s, const double *from, const double *to, const double *moved, const double *direct)
{
    size_t size = s->t.size, length = size * s->columns;
    double *round = nh_alloc_array(length, sizeof *round);
    memcpy(round, moved, length * sizeof *round);
    if (nh_transport_along(&s->t, from, to, s->columns, round, s->options->transport))
        for (size_t i = 0; i < size; i++) {
            double *row = new_row(s, 0);
            for (size_t c = 0; c < s->columns; c++) row[c] = round[i + c * size] - direct[i + c * size];
        }
    nh_free(round);
}

static size_t null_space(search *s, bool potential, bool constraints, double *basis, double *last, double *first)
{
    size_t n = s->columns, use[3] = {s->c.rows[0], potential ? s->c.rows[1] : 0, constraints ? s->c.rows[2] : 0}, rows = use[0] + use[1] + use[2], at = 0;
    double *a = nh_alloc_array(rows * n + 1, sizeof *a);
    for (int kind = 0; kind < 3; kind++)
        for (size_t r = 0; r < use[kind]; r++, at++)
            for (size_t c = 0; c < n; c++) a[at + c * rows] = s->c.row[kind][r * n + c];
    size_t dimension = nh_kernel(rows, n, a, s->options->group, basis, last, first);
    nh_free(a);
    return dimension;
}

/* [a,b]^i = a^j B_b^i_j - (a <-> b);  d_k [a,b]^i = B_a^j_k B_b^i_j + (derivative of B_b along a)^i_k - (a <-> b). */
static void find_algebra(search *s, const double *jet, nh_jets *out)
{
    size_t m = s->m, d = out->dimension, size = s->t.size;
    double *brackets = nh_alloc_array(size * d * d + 1, sizeof *brackets), *rate = nh_alloc_array(size, sizeof *rate);
    out->algebra = nh_algebra_create(d);
    for (size_t a = 0; a < d; a++) {
        const double *A = jet + a * size;
        nh_transport_at(&s->t, out->place, A);
        for (size_t b = 0; b < d; b++) {
            const double *B = jet + b * size;
            nh_transport_rate(&s->t, A, B, rate);
            for (size_t i = 0; i < size; i++) { /* + at (a,b), - at (b,a) */
                double term = rate[i];
                for (size_t j = 0; j < m && i >= m; j++) term += B[m + (i - m) % m + m * j] * A[m + j + m * ((i - m) / m)];
                brackets[i + (a * d + b) * size] += term;
                brackets[i + (b * d + a) * size] -= term;
            }
        }
    }
    out->closure = nh_coordinates(size, d, jet, d * d, brackets, out->algebra.c);
    bool abelian = nh_largest(d * d * d, out->algebra.c) <= s->options->group; /* the jets have size one: this threshold is absolute too */
    for (size_t i = 0; i < d * d * d; i++) out->algebra.c[i] = abelian ? 0 : -out->algebra.c[i];
    nh_free(brackets);
    nh_free(rate);
}

/* Combinations of the columns, in true coordinates: xi^i s_i, B^i_j s_i / s_j. */
static void combine(const search *s, const double *jets, const double *basis, size_t d, double *out)
{
    size_t m = s->m, size = s->t.size;
    nh_multiply(size, d, s->columns, jets, basis, out);
    for (size_t c = 0; c < d; c++)
        for (size_t i = 0; i < m; i++) {
            out[c * size + i] *= s->t.scale[i];
            for (size_t j = 0; j < m; j++) out[c * size + m + i + m * j] *= s->t.scale[i] / s->t.scale[j];
        }
}

static void conclude(search *s, const double *jets, const double *moved, nh_jets *out)
{
    size_t n = s->columns, size = s->t.size, length = size * n;
    double *basis = nh_alloc_array(n * n + 1, sizeof *basis), *sv = nh_alloc_array(n + 1, sizeof *sv);
    out->of_metric = null_space(s, false, false, basis, NULL, NULL);
    out->of_potential = null_space(s, true, false, basis, NULL, NULL);
    out->of_constraints = null_space(s, false, true, basis, NULL, NULL);
    size_t d = out->dimension = null_space(s, true, true, basis, &out->last_null, &out->first_other);
    double *scaled = nh_alloc_array(size * d + 1, sizeof *scaled), *xi = nh_alloc_array(s->m * d + 1, sizeof *xi);
    nh_multiply(size, d, n, jets, basis, scaled);
    find_algebra(s, scaled, out);
    for (size_t c = 0; c < d; c++) memcpy(xi + c * s->m, scaled + c * size, s->m * sizeof *xi);
    nh_singular_values(s->m, d, xi, sv);
    while (out->orbit < d && sv[out->orbit] > s->options->group) out->orbit++;
    out->jet = nh_alloc_array(size * d + 1, sizeof *out->jet);
    out->moved = nh_alloc_array(out->places * size * d + 1, sizeof *out->moved);
    combine(s, jets, basis, d, out->jet);
    for (size_t p = 0; p < out->places; p++) combine(s, moved + p * length, basis, d, out->moved + p * size * d);
    nh_free(basis);
    nh_free(sv);
    nh_free(scaled);
    nh_free(xi);
}

/* After the first ray only those jets are carried on that leave the metric alone there too (with a generous bound: what is kept without need is
 * sorted out later).  Jets, their images at the end of that ray and the rows so far are expressed in them. */
static void thin_out(search *s, double *jets, double *moved)
{
    size_t n = s->columns, size = s->t.size;
    double *basis = nh_alloc_array(n * n + 1, sizeof *basis), *a = nh_alloc_array(s->c.rows[0] * n + 1, sizeof *a), *out = nh_alloc_array(size * n + 1, sizeof *out);
    for (size_t r = 0; r < s->c.rows[0]; r++)
        for (size_t c = 0; c < n; c++) a[r + c * s->c.rows[0]] = s->c.row[0][r * n + c];
    size_t kept = nh_kernel(s->c.rows[0], n, a, sqrt(s->options->group), basis, NULL, NULL);
    for (int which = 0; which < 2; which++) {
        nh_multiply(size, kept, n, which ? moved : jets, basis, out);
        memcpy(which ? moved : jets, out, size * kept * sizeof *out);
    }
    for (int kind = 0; kind < 3; kind++)
        for (size_t r = 0; r < s->c.rows[kind]; r++) {
            nh_multiply(1, kept, n, s->c.row[kind] + r * n, basis, out);
            memmove(s->c.row[kind] + r * kept, out, kept * sizeof *out);
        }
    s->columns = s->c.columns = kept;
    nh_free(basis);
    nh_free(a);
    nh_free(out);
}

/* As many rays as give half again as many rows as there are unknowns, of the potential and of the constraints each. */
static size_t rays_wanted(const search *s)
{
    size_t least = s->c.rows[1] && s->c.rows[2] ? (s->c.rows[1] < s->c.rows[2] ? s->c.rows[1] : s->c.rows[2]) : s->c.rows[1] + s->c.rows[2];
    size_t wanted = least ? 2 + 3 * s->columns / least : rays; /* the rows so far are those of two places */
    return wanted < rays ? rays : wanted > most_rays ? most_rays : wanted;
}

static void run(search *s, nh_jets *out)
{
    size_t m = s->m, length = s->t.size * s->columns, wanted = rays;
    double *jets = nh_alloc_array(length * (1 + most_rays), sizeof *jets), *moved = jets + length;
    out->end = nh_alloc_array(most_rays * m, sizeof *out->end);
    nh_transport_at(&s->t, out->place, s->x);
    first_jets(s, jets);
    conditions_at(s, out->place, jets);
    for (size_t p = 1; p < s->kinetic->places && out->places < wanted && s->columns; p++) {
        double *end = out->end + out->places * m, *here = moved + out->places * length;
        if (follow_ray(s, out->place, s->kinetic->place + p * m, jets, end, here) && conditions_at(s, end, here)) out->places++;
        if (out->places == 1 && length == s->t.size * m * (m + 1) / 2) {
            thin_out(s, jets, here);
            length = s->t.size * s->columns;
            wanted = rays_wanted(s);
        }
    }
    for (size_t p = 0; p + 1 < out->places && p < triangles && s->columns; p++)
        triangle_rows(s, out->end + p * m, out->end + (p + 1) * m, moved + p * length, moved + (p + 1) * length);
    if (out->places) conclude(s, jets, moved, out);
    nh_free(jets);
}

nh_jets *nh_jets_find(const nh_kinetic *k, const nh_options *options, nh_error *error)
{
    nh_jets *out = nh_alloc(sizeof *out);
    size_t m = k->m, total = forms_total(k);
    *out = (nh_jets){.m = m, .place = nh_alloc_array(m, sizeof *out->place)};
    search s = {.kinetic = k, .options = options, .m = m, .f = k->f, .columns = m * (m + 1) / 2, .tape = forms_tape(k)};
    s.work = nh_tape_work_create(s.tape);
    s.force = force_tape(k);
    if (s.force) s.force_work = nh_tape_work_create(s.force);
    s.out = nh_alloc_array(total + 1, sizeof *s.out);
    s.x = nh_alloc_array(m, sizeof *s.x);
    s.c.columns = s.columns;
    memcpy(out->place, k->place, m * sizeof *out->place);
    nh_transport_init(&s.t, k, out->place);
    run(&s, out);
    nh_transport_clear(&s.t);
    nh_tape_work_free(s.work);
    nh_tape_free(s.tape);
    if (s.force) nh_tape_work_free(s.force_work);
    nh_tape_free(s.force);
    nh_free(s.out);
    nh_free(s.x);
    for (int i = 0; i < 3; i++) nh_free(s.c.row[i]);
    if (out->places) return out;
    nh_jets_free(out);
    nh_fail(error, NH_NUMERIC, "", "no way could be found along which symmetries of the metric could be followed");
    nh_error_hint(error, "give a domain without singularities of the coordinates");
    return NULL;
}

void nh_jets_free(nh_jets *j)
{
    if (!j) return;
    nh_free(j->place);
    nh_free(j->jet);
    nh_free(j->end);
    nh_free(j->moved);
    nh_algebra_clear(&j->algebra);
    nh_free(j);
}
