/* The whole group at once. */
#include "document/reduction_sheet_internal.h"

#include "exact/normal.h"
#include "graph/dag.h"

static const char *number(const nh_reduction_builder *b, const char *letter, size_t a)
{
    return nh_sheet_label(b->s, "%s_{%zu}", letter, a + 1);
}
static const char *speed(const nh_reduction_builder *b, const nh_slice *s, size_t i)
{
    return nh_sheet_label(b->s, "<%s'>", nh_reduction_sheet_x(b, s, i));
}

/* S, and with the lifts D. */
static void distribution(const nh_reduction_builder *b, const nh_lagrange_poincare *l)
{
    static const char rest[] = "Entries that are not listed vanish.";
    const char *orthogonal = l->lifts ? "the inner product of the generators" : "the kinetic energy",
               *what = !l->slice->f ? "Without constraints $S$ is the whole algebra"
                                    : "$S$ is what $V$ and the constraint distribution $D$ have in common. The "
                                      "$chi_{a}$ span $S$, with the lifts they span $D$";
    nh_sheet_begin(b->s, "connection", "Nonholonomic connection and curvature",
                   l->slice->f || l->lifts
                       ? nh_sheet_label(b->s, "%s. The lifts are orthogonal to $S$ for %s. %s", what, orthogonal, rest)
                       : nh_sheet_label(b->s, "%s and the connection the mechanical one. %s", what, rest));
    for (size_t p = 0; p < l->r; p++) {
        nh_sheet_sum(b->s, "", number(b, "chi", p));
        for (size_t a = 0; a < l->d; a++) nh_sheet_add(b->s, l->chi[a * l->r + p], number(b, "e", a));
    }
    nh_reduction_sheet_lift(b, l->slice, l->A, "A");
    if (l->n > 1) nh_reduction_sheet_curvature(b, l->slice, l->B, "B");
}

static void lagrangian(const nh_reduction_builder *b, const nh_lagrange_poincare *l)
{
    const nh_slice *s = l->slice;
    nh_sheet_begin(b->s, "lagrangian", "Reduced Lagrangian and momenta",
                   "$v=zeta+A <x'>=nu_{a} chi_{a}$ lies in $S$; $omega=v-A <x'>$ is the body velocity; $mu=\\frac{\\p "
                   "l}{\\p v}$, $pi_{i}=\\frac{\\p l}{\\p<x'>^{i}}$.");
    nh_sheet_sum(b->s, "", "l");
    for (size_t i = 0; i < l->n; i++)
        for (size_t j = i; j < l->n; j++) {
            nh_ex e = i == j ? nh_mul(b->d, nh_ratio(b->d, 1, 2), l->Kh[i * l->n + j]) : l->Kh[i * l->n + j];
            nh_sheet_add(b->s, e,
                         i == j ? nh_sheet_label(b->s, "%s^{2}", speed(b, s, i))
                                : nh_sheet_label(b->s, "%s %s", speed(b, s, i), speed(b, s, j)));
        }
    for (size_t i = 0; i < l->n; i++)
        for (size_t p = 0; p < l->r; p++)
            nh_sheet_add(b->s, l->C[i * l->r + p], nh_sheet_label(b->s, "%s nu_{%zu}", speed(b, s, i), p + 1));
    for (size_t p = 0; p < l->r; p++)
        for (size_t q = p; q < l->r; q++) {
            nh_ex e = p == q ? nh_mul(b->d, nh_ratio(b->d, 1, 2), l->I[p * l->r + q]) : l->I[p * l->r + q];
            nh_sheet_add(b->s, e,
                         p == q ? nh_sheet_label(b->s, "nu_{%zu}^{2}", p + 1)
                                : nh_sheet_label(b->s, "nu_{%zu} nu_{%zu}", p + 1, q + 1));
        }
    nh_sheet_add(b->s, nh_neg(b->d, s->V), "");
    for (size_t a = 0; a < l->d; a++) nh_sheet_formula(b->s, number(b, "omega", a), l->omega[a]);
    for (size_t a = 0; a < l->d; a++) nh_sheet_formula(b->s, number(b, "mu", a), l->mu[a]);
    for (size_t i = 0; i < l->n; i++)
        nh_sheet_formula(b->s, nh_sheet_label(b->s, "pi_{<%s>}", nh_reduction_sheet_x(b, s, i)), l->pi[i]);
}

static void column(const nh_lagrange_poincare *l, const nh_ex *matrix, size_t width, size_t c, nh_ex *out)
{
    for (size_t a = 0; a < l->d; a++) out[a] = matrix[a * width + c];
}

static void add_momenta(const nh_reduction_builder *b, const nh_lagrange_poincare *l, const nh_ex *e)
{
    for (size_t a = 0; a < l->d; a++) nh_sheet_add(b->s, nh_simplify(b->d, e[a]), number(b, "mu", a));
}

static void equations(const nh_reduction_builder *b, const nh_lagrange_poincare *l)
{
    nh_ex *chi = nh_alloc_array(3 * l->d + 1, sizeof *chi), *out = chi + l->d, *A = out + l->d;
    nh_sheet_begin(b->s, "equations", "Vertical and horizontal equations",
                   "$mu'(chi)=mu([omega,chi])$ for each $chi$ of $S$, which is not differentiated (Cendra and Diaz "
                   "2018, sec. 5); $\\pidot_{i}=\\frac{\\p l}{\\p x^{i}}+mu_{a} B^{a}_{i,j} <x'>^{j}+mu([A_{i},v])$.");
    for (size_t p = 0; p < l->r; p++) {
        column(l, l->chi, l->r, p, chi);
        nh_lagrange_poincare_bracket(l, l->omega, chi, out);
        nh_sheet_sum(b->s, "", "");
        for (size_t a = 0; a < l->d; a++) nh_sheet_add(b->s, chi[a], nh_sheet_label(b->s, "mu'_{%zu}", a + 1));
        nh_sheet_equals(b->s);
        add_momenta(b, l, out);
    }
    for (size_t i = 0; i < l->n; i++) {
        column(l, l->A, l->n, i, A);
        nh_lagrange_poincare_bracket(l, A, l->v, out);
        for (size_t a = 0; a < l->d; a++)
            for (size_t j = 0; j < l->n; j++)
                out[a] = nh_add(b->d, out[a], nh_mul(b->d, l->B[(a * l->n + i) * l->n + j], l->dx[j]));
        nh_sheet_sum(b->s, "", "");
        nh_sheet_add(b->s, nh_int(b->d, 1),
                     nh_sheet_label(b->s, "\\pidot_{<%s>}", nh_reduction_sheet_x(b, l->slice, i)));
        nh_sheet_equals(b->s);
        nh_sheet_add(b->s, l->slope[i], "");
        add_momenta(b, l, out);
    }
    nh_free(chi);
}

void nh_reduction_sheet_bundle(const nh_reduction_builder *b, const nh_lagrange_poincare *l)
{
    nh_reduction_sheet_frame(b, l->slice);
    distribution(b, l);
    lagrangian(b, l);
    equations(b, l);
}
