#include "reduction/jet_conditions.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/diff.h"
#include "reduction/subspace.h"

double *nh_jet_conditions_row(nh_jet_conditions *s, nh_condition_kind kind)
{
    nh_grow(&s->row[kind], &s->capacity[kind], (s->rows[kind] + 1) * s->columns, sizeof *s->row[kind]);
    return s->row[kind] + s->rows[kind]++ * s->columns;
}

static size_t forms_total(const nh_kinetic *k) { return (2 * k->m + k->f * (1 + k->m)) * (1 + k->m) + 1; }

static nh_tape *forms_tape(const nh_kinetic *k)
{
    size_t m = k->m, f = k->f, n = 0;
    nh_ex *e = nh_alloc_array(forms_total(k), sizeof *e);
    for (size_t s = 0; s < m; s++) e[n++] = nh_kinetic_diff(k, k->V, k->q[s]);
    for (size_t s = 0; s < m; s++)
        for (size_t r = 0; r < m; r++) e[n++] = nh_kinetic_diff(k, e[s], k->q[r]);
    for (size_t i = 0; i < f * m; i++) e[n++] = k->omega[i];
    for (size_t s = 0; s < m; s++)
        for (size_t i = 0; i < f * m; i++) e[n++] = nh_kinetic_diff(k, k->omega[i], k->q[s]);
    for (size_t i = 0; i < f; i++) e[n++] = k->b[i];
    for (size_t s = 0; s < m; s++)
        for (size_t i = 0; i < f; i++) e[n++] = nh_kinetic_diff(k, k->b[i], k->q[s]);
    for (size_t i = 0; i < m; i++) e[n++] = k->a[i];
    for (size_t s = 0; s < m; s++)
        for (size_t i = 0; i < m; i++) e[n++] = nh_kinetic_diff(k, k->a[i], k->q[s]);
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
        for (size_t s = 0; s < m; s++) e[n++] = nh_kinetic_diff(k, k->Q[s], in[l]);
    const nh_model *y = k->model;
    nh_tape *tape = nh_tape_create(k->dag, 2 * m, in, n, e, y->system->parameters, y->parameter, y->parameter_value);
    nh_free(e);
    return tape;
}

void nh_jet_conditions_init(nh_jet_conditions *s, const nh_kinetic *k, const nh_options *options, const double *q0)
{
    size_t m = k->m;
    *s = (nh_jet_conditions){.kinetic = k,
                             .options = options,
                             .m = m,
                             .f = k->f,
                             .columns = m * (m + 1) / 2,
                             .tape = forms_tape(k),
                             .force = force_tape(k)};
    s->work = nh_tape_work_create(s->tape);
    if (s->force) s->force_work = nh_tape_work_create(s->force);
    s->out = nh_alloc_array(forms_total(k) + 1, sizeof *s->out);
    s->x = nh_alloc_array(m, sizeof *s->x);
    nh_transport_init(&s->t, k, q0);
    s->t.steps = (size_t)options->transport_steps;
}

void nh_jet_conditions_clear(nh_jet_conditions *s)
{
    nh_transport_clear(&s->t);
    nh_tape_work_free(s->work);
    nh_tape_free(s->tape);
    if (s->force) nh_tape_work_free(s->force_work);
    nh_tape_free(s->force);
    nh_free(s->out);
    nh_free(s->x);
    for (int kind = 0; kind < NH_CONDITION_KINDS; kind++) nh_free(s->row[kind]);
}

/* The root of K_ii, or of the largest of K_ij where K is not definite. */
static double size_of(const nh_jet_conditions *s, size_t i)
{
    double size = s->t.K[i + s->m * i];
    for (size_t j = 0; j < s->m && !s->kinetic->metric; j++) size = fmax(size, fabs(s->t.K[i + s->m * j]));
    return sqrt(size);
}

/* (L_xi K)_ij = xi^l d_l K_ij + K_lj B^l_i + K_il B^l_j, divided by (K_ii K_jj)^(1/2); the transport stands at the
   place. */
static void metric_rows(nh_jet_conditions *s, const double *jets)
{
    size_t m = s->m, size = s->t.size;
    const double *K = s->t.K, *dK = s->t.dK;
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j <= i; j++) {
            double *row = nh_jet_conditions_row(s, NH_OF_METRIC), unit = 1 / (size_of(s, i) * size_of(s, j));
            for (size_t c = 0; c < s->columns; c++) {
                const double *xi = jets + c * size, *B = xi + m;
                double sum = 0;
                for (size_t l = 0; l < m; l++)
                    sum += xi[l] * dK[i + m * (j + m * l)] + K[l + m * j] * B[l + m * i] + K[i + m * l] * B[l + m * j];
                row[c] = sum * unit;
            }
        }
}

/* xi(V) = 0 and its derivatives B^l_k d_l V + xi^l d_k d_l V = 0, divided by the size of dV at the place: near a
 * singularity of V these rows would dominate all others. */
static void potential_rows(nh_jet_conditions *s, const double *jets)
{
    size_t m = s->m;
    const double *c = s->t.scale, *dV = s->out, *ddV = s->out + m;
    double slope = 0;
    for (size_t l = 0; l < m; l++) {
        slope = fmax(slope, fabs(dV[l]) * c[l]);
        for (size_t k = 0; k < m; k++) slope = fmax(slope, fabs(ddV[l * m + k]) * c[l] * c[k]);
    }
    for (size_t k = 0; k <= m && slope > 0; k++) { /* k = m: the value itself */
        double *row = nh_jet_conditions_row(s, NH_OF_POTENTIAL);
        for (size_t col = 0; col < s->columns; col++) {
            const double *xi = jets + col * s->t.size, *B = xi + m;
            row[col] = 0;
            for (size_t l = 0; l < m; l++)
                row[col] += k == m ? xi[l] * dV[l] * c[l] / slope
                                   : (B[l + m * k] * dV[l] * c[l] + xi[l] * ddV[l * m + k] * c[l] * c[k]) / slope;
        }
    }
}

/* (L_xi a)_i = xi^l d_l a_i + a_l B^l_i, divided by the size of a and da at the place. */
static void magnetic_rows(nh_jet_conditions *s, const double *jets)
{
    size_t m = s->m, f = s->f;
    const double *c = s->t.scale, *a = s->out + (m + f * m + f) * (1 + m), *da = a + m;
    double size = 0;
    for (size_t i = 0; i < m; i++) {
        size = fmax(size, fabs(a[i]) * c[i]);
        for (size_t l = 0; l < m; l++) size = fmax(size, fabs(da[l * m + i]) * c[l] * c[i]);
    }
    for (size_t i = 0; i < m && size > 0; i++) {
        double *row = nh_jet_conditions_row(s, NH_OF_POTENTIAL);
        for (size_t col = 0; col < s->columns; col++) {
            const double *xi = jets + col * s->t.size, *B = xi + m;
            row[col] = 0;
            for (size_t l = 0; l < m; l++)
                row[col] += (xi[l] * da[l * m + i] * c[l] * c[i] + a[l] * c[l] * B[l + m * i]) / size;
        }
    }
}

/* Affine constraints, with v0 (scaled) of least length that satisfies them: (L_xi omega)(v0) + xi(b) = 0, forms of
   length `norm`. */
static void affine_rows(nh_jet_conditions *s, const double *jets, const double *norm, const double *v0)
{
    size_t m = s->m, f = s->f, size = s->t.size;
    const double *c = s->t.scale, *omega = s->out + m * (1 + m), *domega = omega + f * m, *b = omega + f * m * (1 + m),
                 *db = b + f;
    for (size_t a = 0; a < f && !s->kinetic->linear; a++) {
        if (!(norm[a] > 0)) continue;
        double unit = 1 / norm[a] / (1 + fabs(b[a]) / norm[a]), *row = nh_jet_conditions_row(s, NH_OF_CONSTRAINTS);
        for (size_t col = 0; col < s->columns; col++) {
            const double *xi = jets + col * size, *B = xi + m;
            double sum = 0;
            for (size_t l = 0; l < m; l++) {
                sum += xi[l] * db[l * f + a] * c[l];
                for (size_t i = 0; i < m; i++)
                    sum +=
                        (xi[l] * domega[l * f * m + a * m + i] * c[l] * c[i] + omega[a * m + l] * c[l] * B[l + m * i]) *
                        v0[i];
            }
            row[col] = sum * unit;
        }
    }
}

/* (L_xi Q)_s = xi^l d_l Q_s + B^l_r v^r dQ_s/dv^l + Q_l B^l_s at two velocities v0 + X w that the constraints allow; X
   (m x n) and v0 scaled. */
static void force_rows(nh_jet_conditions *s, const double *q, const double *jets, size_t n, const double *X,
                       const double *v0)
{
    size_t m = s->m, size = s->t.size;
    const double *c = s->t.scale;
    double *z = nh_alloc_array(3 * m + m * (1 + 2 * m), sizeof *z), *v = z + 2 * m, *Q = v + m, *dq = Q + m,
           *dv = dq + m * m;
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
            double *row = nh_jet_conditions_row(s, NH_OF_CONSTRAINTS);
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

/* (L_xi omega)_i = xi^s d_s omega_i + omega_s B^s_i on an orthonormal basis X of D (scaled coordinates), forms of
   length one. */
static void constraint_rows(nh_jet_conditions *s, const double *q, const double *jets)
{
    size_t m = s->m, f = s->f, size = s->t.size;
    const double *c = s->t.scale, *omega = s->out + m + m * m, *domega = omega + f * m;
    double *forms = nh_alloc_array(f * m + m * m + m + 1, sizeof *forms), *X = forms + f * m, *lie = X + m * m,
           *norm = nh_alloc_array(f + 1, sizeof *norm);
    for (size_t a = 0; a < f; a++) {
        for (size_t i = 0; i < m; i++) norm[a] = hypot(norm[a], omega[a * m + i] * c[i]);
        for (size_t i = 0; i < m; i++) forms[a + f * i] = norm[a] > 0 ? omega[a * m + i] * c[i] / norm[a] : 0;
    }
    size_t n = nh_kernel(f, m, forms, s->options->group, X, NULL, NULL);
    for (size_t a = 0; a < f; a++)
        for (size_t k = 0; k < n; k++) {
            double *row = nh_jet_conditions_row(s, NH_OF_CONSTRAINTS);
            for (size_t col = 0; col < s->columns; col++) {
                const double *xi = jets + col * size, *B = xi + m;
                double sum = 0;
                for (size_t i = 0; i < m; i++) {
                    lie[i] = 0;
                    for (size_t l = 0; l < m && norm[a] > 0; l++)
                        lie[i] += xi[l] * domega[l * f * m + a * m + i] * c[l] * c[i] / norm[a] +
                                  forms[a + f * l] * B[l + m * i];
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

bool nh_jet_conditions_at(nh_jet_conditions *s, const double *q, const double *jets)
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

/* The kernel of the rows of the kinds in `use`, of this dimension or (SIZE_MAX) with the threshold `small`. */
static size_t kernel_of(const nh_jet_conditions *s, const size_t use[NH_CONDITION_KINDS], double small, size_t known,
                        double *basis, double *last, double *first)
{
    size_t n = s->columns, rows = 0, at = 0;
    for (int kind = 0; kind < NH_CONDITION_KINDS; kind++) rows += use[kind];
    double *a = nh_alloc_array(rows * n + 1, sizeof *a);
    for (int kind = 0; kind < NH_CONDITION_KINDS; kind++)
        for (size_t r = 0; r < use[kind]; r++, at++)
            for (size_t c = 0; c < n; c++) a[at + c * rows] = s->row[kind][r * n + c];
    size_t dimension = known == SIZE_MAX ? nh_kernel(rows, n, a, small, basis, last, first)
                                         : nh_kernel_of_dimension(rows, n, a, known, basis, last, first);
    nh_free(a);
    return dimension;
}

size_t nh_jet_conditions_kernel(const nh_jet_conditions *s, bool potential, bool constraints, size_t dimension,
                                double *basis, double *last, double *first)
{
    size_t use[NH_CONDITION_KINDS] = {s->rows[NH_OF_METRIC], potential ? s->rows[NH_OF_POTENTIAL] : 0,
                                      constraints ? s->rows[NH_OF_CONSTRAINTS] : 0};
    return kernel_of(s, use, s->options->group, dimension, basis, last, first);
}

size_t nh_jet_conditions_kernel_generous(const nh_jet_conditions *s, double *basis)
{
    size_t use[NH_CONDITION_KINDS] = {s->rows[NH_OF_METRIC]};
    return kernel_of(s, use, sqrt(s->options->group), SIZE_MAX, basis, NULL, NULL);
}

void nh_jet_conditions_restrict(nh_jet_conditions *s, size_t kept, const double *basis)
{
    size_t n = s->columns;
    double *out = nh_alloc_array(kept + 1, sizeof *out);
    for (int kind = 0; kind < NH_CONDITION_KINDS; kind++)
        for (size_t r = 0; r < s->rows[kind]; r++) {
            nh_multiply(1, kept, n, s->row[kind] + r * n, basis, out);
            memmove(s->row[kind] + r * kept, out, kept * sizeof *out);
        }
    s->columns = kept;
    nh_free(out);
}
