/* A second stage, or the reduction of a system without constraints: locked inertia, mechanical connection, N_theta,
 * Xi_theta [ChhabraEmami2014, sec. 2.3].
 *
 *     alpha_theta = <theta, A>,    Xi_theta = d alpha_theta:  Xi(hor_i, hor_j) = theta_a B^a_ij,  Xi(e_a, e_b) =
 *     theta([e_a, e_b]),  Xi(hor_i, e_a) = 0     (2.17), (2.20)
 *
 * with A the whole connection and theta in the body frame, where it is m; n_theta is the kernel of theta([., .]). */
#include "exact/normal.h"
#include "exact/solve.h"
#include "document/reduction_sheet_internal.h"
#include "graph/dag.h"

static const char *number(const nh_reduction_builder *b, const char *letter, size_t a)
{
    return nh_sheet_label(b->s, "%s_{%zu}", letter, a + 1);
}

/* theta_a Bv^a_ij; without words where the group is not abelian, since then Xi has more. */
static void on_lifts(const nh_reduction_builder *b, const nh_second *t)
{
    size_t n = t->n, d = t->d, listed = 0;
    for (size_t i = 0; i < n; i++)
        for (size_t j = i + 1; j < n; j++) {
            bool any = false;
            for (size_t a = 0; a < d; a++) any |= !nh_is_zero(b->d, t->Bv[(a * n + i) * n + j]);
            if (!any) continue;
            nh_sheet_sum(b->s, "",
                         nh_sheet_label(b->s, "Xi_{<%s>,<%s>}", nh_reduction_sheet_x(b, &t->slice, i),
                                        nh_reduction_sheet_x(b, &t->slice, j)));
            for (size_t a = 0; a < d; a++) nh_sheet_add(b->s, t->Bv[(a * n + i) * n + j], number(b, "theta", a));
            listed++;
        }
    if (!listed) nh_sheet_words(b->s, t->abelian ? "$Xi_{theta}$ vanishes." : "$Xi_{theta}$ vanishes on lifts.");
}

/* theta([e_a, e_b]) as expressions in the given theta; d x d. */
static void pairing(const nh_second *t, const nh_ex *theta, nh_ex *out)
{
    nh_dag *g = t->slice.dag;
    size_t d = t->d;
    for (size_t a = 0; a < d * d; a++) {
        out[a] = nh_int(g, 0);
        for (size_t k = 0; k < d; k++) out[a] = nh_add(g, out[a], nh_mul(g, t->action.constant[a * d + k], theta[k]));
    }
}

static double any_pivot(void *dag, nh_ex e) { return !nh_is_zero(dag, nh_simplify(dag, e)); }

/* The indices of a regular block as large as the rank: for an alternating matrix, those of a set of independent
 * rows. */
static size_t regular_block(nh_dag *g, size_t d, const nh_ex *form, size_t *index)
{
    size_t n = 0;
    nh_ex *a = nh_alloc_array(d * d + 1, sizeof *a);
    for (size_t i = 0; i < d; i++) { /* is row i independent of those in the list? */
        size_t rank = 0, rows = n + 1;
        index[n] = i;
        for (size_t r = 0; r < d * d; r++) a[r] = r / d < rows ? form[index[r / d] * d + r % d] : nh_int(g, 0);
        nh_lu *lu = nh_lu_create(g, d, a, any_pivot, g, &rank);
        nh_lu_free(lu);
        n += rank == rows;
    }
    nh_free(a);
    return n;
}

/* xi with theta([xi, .]) = 0, for generic theta. */
static void isotropy(const nh_reduction_builder *b, const nh_second *t, const nh_ex *form)
{
    nh_dag *g = b->d;
    size_t d = t->d, *index = nh_alloc_array(d + 1, sizeof *index), n = regular_block(g, d, form, index), found = 0;
    nh_ex *block = nh_alloc_array(n * n + n + 1, sizeof *block), *c = block + n * n;
    for (size_t r = 0; r < n * n; r++) block[r] = form[index[r / n] * d + index[r % n]];
    nh_lu *lu = n ? nh_lu_create(g, n, block, any_pivot, g, NULL) : NULL;
    for (size_t k = 0; k < d && (lu || !n); k++) {
        bool inside = false;
        for (size_t r = 0; r < n; r++) inside |= index[r] == k;
        if (inside) continue;
        for (size_t r = 0; r < n; r++) c[r] = nh_neg(g, form[index[r] * d + k]);
        if (n) nh_lu_solve(lu, c, c);
        nh_sheet_sum(b->s, "", nh_sheet_label(b->s, "xi_{%zu}", ++found));
        for (size_t a = 0; a < d; a++) {
            nh_ex e = nh_int(g, a == k);
            for (size_t r = 0; r < n; r++)
                if (index[r] == a) e = nh_simplify(g, c[r]);
            nh_sheet_add(b->s, e, number(b, "e", a));
        }
    }
    nh_lu_free(lu);
    nh_free(block);
    nh_free(index);
}

static void magnetic(const nh_reduction_builder *b, const nh_second *t)
{
    size_t d = t->d;
    nh_ex *theta = nh_alloc_array(d * d + d + 1, sizeof *theta), *form = theta + d;
    nh_sheet_begin(
        b->s, "magnetic_form", "Isotropy of the momentum and magnetic form",
        t->abelian
            ? "$N_{theta}=N$: the level set is divided by the whole group. $Xi_{theta}=\\d alpha_{theta}$, "
              "$alpha_{theta}=theta_{a} (zeta^{a}+\\breve{A}^{a}_{i} \\d x^{i})$, is the magnetic form "
              "(Chhabra and Emami 2014, eq. 2.20)."
            : nh_sheet_label(b->s,
                             "$theta$ is the momentum in the body frame, which moves on a coadjoint orbit of dimension "
                             "%zu. The $xi$ span the algebra of $N_{theta}$, of dimension %zu, for a generic $theta$: "
                             "$theta([xi,e_{a}])=0$. $Xi_{theta}=\\d alpha_{theta}$, $alpha_{theta}=theta_{a} "
                             "(zeta^{a}+\\breve{A}^{a}_{i} \\d x^{i})$, is $theta_{a} B^{a}_{i,j}$ on lifts and "
                             "$theta([e_{a},e_{b}])$ on orbits (Chhabra and Emami 2014, eq. 2.17); "
                             "on one of each it vanishes.",
                             t->orbit, d - t->orbit));
    on_lifts(b, t);
    for (size_t k = 0; k < d; k++) theta[k] = nh_symbol_fresh(b->d, nh_sheet_label(b->s, "theta_%zu", k + 1));
    pairing(t, theta, form);
    for (size_t a = 0; a < d && !t->abelian; a++)
        for (size_t c = a + 1; c < d; c++)
            if (!nh_is_zero(b->d, form[a * d + c]))
                nh_sheet_formula(b->s, nh_sheet_label(b->s, "Xi(e_{%zu},e_{%zu})", a + 1, c + 1), form[a * d + c]);
    if (!t->abelian) isotropy(b, t, form);
    nh_free(theta);
}

static void connection(const nh_reduction_builder *b, const nh_second *t)
{
    size_t d = t->d;
    nh_sheet_begin(b->s, "mechanical_connection", "Locked inertia and mechanical connection",
                   nh_sheet_label(b->s,
                                  "$I_{a,b}$ is the metric%s on the orbits; $theta_{a}=I_{a,b} v^{b}$ with "
                                  "$v=zeta+\\breve{A} <x'>$ is the momentum%s (Chhabra and Emami 2014, eq. 2.14).%s",
                                  t->first->d ? " of the first stage" : "",
                                  t->abelian ? ", which is kept" : " in the body frame",
                                  t->n > 1 ? " $hor$ and $B$ are the lift and the curvature of $\\breve{A}$." : ""));
    for (size_t a = 0; a < d; a++)
        for (size_t c = a; c < d; c++)
            if (!nh_is_zero(b->d, t->inertia[a * d + c]))
                nh_sheet_formula(b->s, nh_sheet_label(b->s, "I_{%zu,%zu}", a + 1, c + 1), t->inertia[a * d + c]);
    nh_reduction_sheet_lift(b, &t->slice, t->Av, "\\breve{A}");
    if (t->n > 1) nh_reduction_sheet_curvature(b, &t->slice, t->Bv, "B");
}

/* R = 1/2 x' Kbreve x' - 1/2 theta I^-1 theta - V, without the magnetic term. */
static void routhian(const nh_reduction_builder *b, const nh_second *t, const nh_ex *locked)
{
    size_t d = t->d;
    nh_sheet_sum(b->s, "", "R_{theta}");
    nh_reduction_sheet_kinetic(b, t->Kt);
    for (size_t a = 0; a < d; a++)
        for (size_t c = a; c < d; c++) {
            nh_ex e = nh_neg(b->d, a == c ? nh_mul(b->d, nh_ratio(b->d, 1, 2), locked[a * d + c]) : locked[a * d + c]);
            nh_sheet_add(b->s, e,
                         a == c ? nh_sheet_label(b->s, "theta_{%zu}^{2}", a + 1)
                                : nh_sheet_label(b->s, "theta_{%zu} theta_{%zu}", a + 1, c + 1));
        }
    nh_sheet_add(b->s, nh_neg(b->d, t->slice.V), "");
}

void nh_reduction_sheet_second(nh_reduction_builder *b, const nh_second *t, const nh_reduction_theory *theory)
{
    b->slice = &t->slice;
    nh_reduction_sheet_frame(b, &t->slice);
    connection(b, t);
    magnetic(b, t);
    nh_sheet_begin(b->s, "hamiltonian", "Momentum level set, reduced Lagrangian and Hamiltonian",
                   t->first->d
                       ? "$\\hat{p}$ are the momenta of the first stage, $p$ those that remain. $R_{theta}$ is "
                         "Routh's function: with the forces of $Xi_{theta}$ and $Upsilon$ its equations are those of "
                         "the stage."
                       : "$\\hat{p}$ are the momenta before the reduction, $p$ those that remain. $R_{theta}$ is "
                         "Routh's function: with the force of $Xi_{theta}$ its equations are those of the stage.");
    for (size_t i = 0; i < t->n; i++) {
        nh_sheet_sum(b->s, "", nh_sheet_label(b->s, "\\hat{p}_{<%s>}", nh_reduction_sheet_x(b, &t->slice, i)));
        nh_sheet_add(b->s, nh_int(b->d, 1), nh_sheet_label(b->s, "p_{<%s>}", nh_reduction_sheet_x(b, &t->slice, i)));
        for (size_t a = 0; a < t->d; a++) nh_sheet_add(b->s, t->Av[a * t->n + i], number(b, "theta", a));
    }
    nh_reduction_sheet_symmetric(b, &t->slice, t->Kt, "\\breve{K}");
    if (!theory->locked) return;
    routhian(b, t, theory->locked);
    if (theory->inverse || !t->n)
        nh_reduction_sheet_hamiltonian(b, "\\breve{H}", theory->inverse, theory->locked, t->slice.V);
}
