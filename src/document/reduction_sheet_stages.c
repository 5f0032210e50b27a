/* The whole group block by block, along a chain g = n_0 > n_1 > ..., each an ideal of the one before [CendraDiaz2018,
 * sec. 2 to 5]; the same in numbers: reduction/ideal_chain.h.
 *
 *     H_j x = x - (its part in n_(j+1), by g0),        xi = sum_j H_j xi_j
 *     a_j(x, y) = -([H_j x, H_j y] - H_j [H_j x, H_j y]_j),      b_j(x, N) = [H_j x, N],      beta_j = H_j^T mu */
#include "document/reduction_sheet_internal.h"
#include "exact/normal.h"
#include "exact/solve.h"
#include "graph/dag.h"

typedef struct {
    const nh_reduction_builder *b;
    const nh_lagrange_poincare *l;
    const nh_ideals *chain;
    nh_dag *dag;
    size_t d;
    size_t *block; /* of each generator */
    nh_ex *lift;   /* column i: H_j e_i for e_i in block j; lift[a * d + i] */
    nh_ex *whole;  /* d: scratch */
} stages;

static nh_ex plus(nh_dag *d, nh_ex sum, nh_ex a, nh_ex b)
{
    return nh_is_zero(d, a) || nh_is_zero(d, b) ? sum : nh_add(d, sum, nh_mul(d, a, b));
}

static double any_pivot(void *dag, nh_ex e) { return !nh_is_zero(dag, nh_simplify(dag, e)); }

/* e_i minus its g0-projection to the generators behind its block. */
static void lift_one(const stages *s, const nh_ex *inner, size_t i)
{
    size_t d = s->d, n = 0;
    nh_ex *g = nh_alloc_array(d * d + 2 * d + 1, sizeof *g), *c = g + d * d;
    size_t *behind = nh_alloc_array(d + 1, sizeof *behind);
    for (size_t k = 0; k < d; k++)
        if (s->block[k] > s->block[i]) behind[n++] = k;
    for (size_t k = 0; k < n * n; k++) g[k] = inner[behind[k / n] * d + behind[k % n]];
    for (size_t k = 0; k < n; k++) c[k] = inner[behind[k] * d + i];
    nh_lu *lu = n ? nh_lu_create(s->dag, n, g, any_pivot, s->dag, NULL) : NULL;
    if (lu) nh_lu_solve(lu, c, c);
    for (size_t k = 0; k < n && lu; k++) s->lift[behind[k] * d + i] = nh_neg(s->dag, nh_simplify(s->dag, c[k]));
    nh_lu_free(lu);
    nh_free(g);
    nh_free(behind);
}

static stages stages_of(const nh_reduction_builder *b, const nh_lagrange_poincare *l, const nh_ideals *c,
                        const nh_ex *inner)
{
    size_t d = l->d;
    stages s = {.b = b,
                .l = l,
                .chain = c,
                .dag = b->d,
                .d = d,
                .block = nh_alloc_array(d + 1, sizeof *s.block),
                .lift = nh_alloc_array(d * d + d + 1, sizeof *s.lift)};
    s.whole = s.lift + d * d;
    for (size_t j = 0; j < c->blocks; j++)
        for (size_t i = c->start[j]; i < c->start[j] + c->size[j]; i++) s.block[c->order[i]] = j;
    for (size_t a = 0; a < d * d; a++) s.lift[a] = nh_int(b->d, a % (d + 1) == 0);
    for (size_t i = 0; i < d && inner; i++) lift_one(&s, inner, i);
    return s;
}

/* H_j of the block j of a vector in parts; from..to-1: the sum over these j. */
static void joined(const stages *s, const nh_ex *parts, size_t from, size_t to, nh_ex *out)
{
    for (size_t a = 0; a < s->d; a++) {
        out[a] = nh_int(s->dag, 0);
        for (size_t i = 0; i < s->d; i++)
            if (s->block[i] >= from && s->block[i] < to) out[a] = plus(s->dag, out[a], s->lift[a * s->d + i], parts[i]);
    }
}

/* xi = sum_j H_j xi_j: block after block, each less the lifts of those before. */
static void split(const stages *s, const nh_ex *xi, nh_ex *parts)
{
    nh_ex *rest = nh_alloc_array(s->d + 1, sizeof *rest);
    for (size_t a = 0; a < s->d; a++) rest[a] = xi[a];
    for (size_t j = 0; j < s->chain->blocks; j++) {
        for (size_t a = 0; a < s->d; a++)
            if (s->block[a] == j) parts[a] = rest[a];
        joined(s, parts, j, j + 1, s->whole);
        for (size_t a = 0; a < s->d; a++) rest[a] = nh_simplify(s->dag, nh_sub(s->dag, rest[a], s->whole[a]));
    }
    nh_free(rest);
}

static const char *number(const stages *s, const char *letter, size_t a)
{
    return nh_sheet_label(s->b->s, "%s_{%zu}", letter, a + 1);
}

/* ---- the chain ---- */

static void heading(const stages *s, bool given)
{
    const nh_ideals *c = s->chain;
    nh_text words;
    nh_text_init(&words);
    for (size_t j = 0; j < c->blocks; j++) {
        nh_text_addf(&words, "%sblock %zu", j ? "; " : "", j);
        for (size_t i = c->start[j]; i < c->start[j] + c->size[j]; i++)
            nh_text_addf(&words, " $e_{%zu}$", c->order[i] + 1);
    }
    nh_sheet_begin(
        s->b->s, "chain", "Chain of subgroups",
        nh_sheet_label(
            s->b->s,
            "%s. $n_{j}$ is spanned by block $j$ and those behind it, an ideal of $n_{j-1}$ (Cendra and Diaz 2018, "
            "theorem 2.3). $g_{0}$: %s. $a_{j}(x,y)$ is minus the part of $[H_{j} x,H_{j} y]$ in $n_{j+1}$, "
            "$b_{j}(x,N)=[H_{j} x,N]$; those that are not listed vanish.",
            nh_text_string(&words),
            given ? "the inner product that was given; the lifts $H_{j}$ are orthogonal to $n_{j+1}$ in it"
                  : "the inner product in which the generators are orthonormal, so that each is its own lift $H_{j}$"));
    nh_text_clear(&words);
    for (size_t i = 0; i < s->d && given; i++) {
        nh_sheet_sum(s->b->s, "", nh_sheet_label(s->b->s, "H_{%zu} e_{%zu}", s->block[i], i + 1));
        for (size_t a = 0; a < s->d; a++) nh_sheet_add(s->b->s, s->lift[a * s->d + i], number(s, "e", a));
    }
}

/* a_j(e_x, e_y) for two of a block; b_j(e_x, e_y) for e_y behind it. */
static void map(const stages *s, size_t x, size_t y)
{
    size_t d = s->d, j = s->block[x], k = s->block[y];
    nh_ex *u = nh_alloc_array(5 * d + 1, sizeof *u), *v = u + d, *out = v + d, *parts = out + d, *unit = parts + d;
    bool any = false;
    for (size_t a = 0; a < d; a++)
        u[a] = s->lift[a * d + x], v[a] = k == j ? s->lift[a * d + y] : nh_int(s->dag, a == y);
    nh_lagrange_poincare_bracket(s->l, u, v, out);
    if (k == j) {
        split(s, out, parts);
        joined(s, parts, j + 1, s->chain->blocks, unit);
        for (size_t a = 0; a < d; a++) out[a] = nh_neg(s->dag, unit[a]);
    }
    for (size_t a = 0; a < d; a++) {
        nh_ex e = nh_simplify(s->dag, out[a]);
        if (nh_is_zero(s->dag, e)) continue;
        if (!any)
            nh_sheet_sum(s->b->s, "",
                         nh_sheet_label(s->b->s, k == j ? "a_{%zu}(e_{%zu},e_{%zu})" : "b_{%zu}(e_{%zu},e_{%zu})", j,
                                        x + 1, y + 1));
        any = true;
        nh_sheet_add(s->b->s, e, number(s, "e", a));
    }
    nh_free(u);
}

/* ---- the equations ---- */

/* label = <beta_i, [x, y]_i> as a combination of the momenta; nothing where it vanishes. */
static void contribution(const stages *s, size_t i, const nh_ex *x, const nh_ex *y, const char *label)
{
    size_t d = s->d;
    nh_ex *out = nh_alloc_array(2 * d + 1, sizeof *out), *parts = out + d;
    bool any = false;
    nh_lagrange_poincare_bracket(s->l, x, y, out);
    split(s, out, parts);
    joined(s, parts, i, i + 1, out);
    for (size_t a = 0; a < d; a++) {
        nh_ex e = nh_simplify(s->dag, out[a]);
        if (nh_is_zero(s->dag, e)) continue;
        if (!any) nh_sheet_sum(s->b->s, "", label);
        any = true;
        nh_sheet_add(s->b->s, e, number(s, "mu", a));
    }
    nh_free(out);
}

/* The terms of one chi, as text. */
static void vertical(const stages *s, size_t p)
{
    nh_sheet *o = s->b->s;
    size_t d = s->d, blocks = s->chain->blocks;
    nh_ex *omega = nh_alloc_array(5 * d + 1, sizeof *omega), *chi = omega + d, *x = chi + d, *y = x + d, *own = y + d;
    for (size_t a = 0; a < d; a++) own[a] = s->l->chi[a * s->l->r + p];
    split(s, s->l->omega, omega);
    split(s, own, chi);
    for (size_t i = 0; i < blocks; i++) {
        joined(s, omega, i, i + 1, x);
        joined(s, chi, i, i + 1, y);
        contribution(s, i, x, y, nh_sheet_label(o, "beta_{%zu}([omega_{%zu},chi_{%zu;%zu}])", i, i, p + 1, i));
        for (size_t j = 0; j < i; j++) {
            joined(s, omega, j, j + 1, x);
            joined(s, chi, j, j + 1, y);
            contribution(s, i, x, y,
                         nh_sheet_label(o, "beta_{%zu}(-a_{%zu}(omega_{%zu},chi_{%zu;%zu}))", i, j, j, p + 1, j));
            joined(s, chi, j + 1, blocks, y);
            contribution(s, i, x, y,
                         nh_sheet_label(o, "beta_{%zu}(b_{%zu}(omega_{%zu},chi_{%zu;>%zu}))", i, j, j, p + 1, j));
            joined(s, omega, j + 1, blocks, x);
            joined(s, chi, j, j + 1, y);
            contribution(s, i, x, y,
                         nh_sheet_label(o, "beta_{%zu}(-b_{%zu}(chi_{%zu;%zu},omega_{>%zu}))", i, j, p + 1, j, j));
        }
    }
    nh_free(omega);
}

/* Of the section that is being written. */
static size_t lines(const nh_reduction_builder *b) { return b->s->section[b->s->sections - 1].lines; }

void nh_reduction_sheet_stages(const nh_reduction_builder *b, const nh_lagrange_poincare *l, const nh_ideals *c,
                               const nh_ex *inner)
{
    stages s = stages_of(b, l, c, inner);
    heading(&s, inner != NULL);
    size_t before = lines(b);
    for (size_t x = 0; x < s.d; x++)
        for (size_t y = 0; y < s.d; y++)
            if (s.block[y] > s.block[x] || (s.block[y] == s.block[x] && y > x)) map(&s, x, y);
    if (lines(b) == before) nh_sheet_words(b->s, "All $a_{j}$ and $b_{j}$ vanish.");
    /* sum_j beta_j'(chi_j) = sum_i <beta_i, [omega, chi]_i>, with the bracket in parts [CendraDiaz2018, eq. 14] */
    nh_sheet_begin(b->s, "by_stages", "Vertical equations by stages, block by block",
                   "$beta_{j}=mu H_{j}$ is the part of $mu$ on block $j$, $omega=\\Sigma_{j} H_{j} omega_{j}$ and "
                   "$chi_{a}=\\Sigma_{j} H_{j} chi_{a;j}$; $chi_{a;>j}$ and $omega_{>j}$ are the parts behind block "
                   "$j$. For each $chi$ the sum of the parts below is $\\Sigma_{j} beta'_{j}(chi_{j})$ (Cendra "
                   "and Diaz 2018, eq. 14); the sum over all blocks is needed, since $chi$ need not lie in one of "
                   "them.");
    for (size_t p = 0; p < l->r; p++) vertical(&s, p);
    if (!lines(b)) nh_sheet_words(b->s, "All parts vanish.");
    nh_free(s.block);
    nh_free(s.lift);
}

/* ---- second stages ---- */

static const char *numbered(const nh_reduction_builder *b, const char *letter, size_t a)
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
            for (size_t a = 0; a < d; a++) nh_sheet_add(b->s, t->Bv[(a * n + i) * n + j], numbered(b, "theta", a));
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
            nh_sheet_add(b->s, e, numbered(b, "e", a));
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
        for (size_t a = 0; a < t->d; a++) nh_sheet_add(b->s, t->Av[a * t->n + i], numbered(b, "theta", a));
    }
    nh_reduction_sheet_symmetric(b, &t->slice, t->Kt, "\\breve{K}");
    if (!theory->locked) return;
    routhian(b, t, theory->locked);
    if (theory->inverse || !t->n)
        nh_reduction_sheet_hamiltonian(b, "\\breve{H}", theory->inverse, theory->locked, t->slice.V);
}
