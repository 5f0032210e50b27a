/* The whole group block by block, along a chain g = n_0 > n_1 > ..., each an ideal of the one before [CendraDiaz2018,
 * sec. 2 to 5]; the same in numbers: reduction/ideal_chain.h.
 *
 *     H_j x = x - (its part in n_(j+1), by g0),        xi = sum_j H_j xi_j
 *     a_j(x, y) = -([H_j x, H_j y] - H_j [H_j x, H_j y]_j),      b_j(x, N) = [H_j x, N],      beta_j = H_j^T mu */
#include "exact/normal.h"
#include "exact/solve.h"
#include "document/reduction_sheet_internal.h"
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
