/* reduction_sheet: a stage of the first kind; the second in reduction_sheet_second.c, the whole group in
   reduction_sheet_bundle.c. */
#include "document/reduction_internal.h"

#include "document/reduction.h"
#include "document/reduction_sheet_internal.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"

static void add(const nh_reduction_builder *b, nh_ex e, const char *format, size_t a)
{
    nh_sheet_add(b->s, e, nh_sheet_label(b->s, format, a));
}

const char *nh_reduction_sheet_x(const nh_reduction_builder *b, const nh_slice *s, size_t i)
{
    return nh_name_of(b->d, s->x[i]);
}

void nh_reduction_sheet_frame(const nh_reduction_builder *b, const nh_slice *s)
{
    nh_text where;
    nh_text_init(&where);
    for (size_t a = 0; a < s->d; a++) {
        char *value = nh_print_string(b->d, s->y[a]);
        nh_text_addf(&where, "%s$<%s>$ = $<%s>$", a ? ", " : "", s->kinetic->name[s->along[a]], value);
        nh_free(value);
    }
    nh_sheet_begin(b->s, "frame", "Slice and generators",
                   nh_sheet_label(b->s,
                                  "On the slice %s. The $e_{a}$ span $V$, the directions of the orbits; $zeta^{a}$ is "
                                  "the group's velocity in the body frame.",
                                  nh_text_string(&where)));
    nh_text_clear(&where);
    for (size_t a = 0; a < s->d; a++) {
        nh_sheet_sum(b->s, "", nh_sheet_label(b->s, "e_{%zu}", a + 1));
        for (size_t r = 0; r < s->m; r++)
            nh_sheet_add(b->s, s->E[r * s->d + a], nh_sheet_label(b->s, "\\frac{\\p}{\\p<%s>}", s->kinetic->name[r]));
    }
}

/* d_i - A^a_i e_a */
void nh_reduction_sheet_lift(const nh_reduction_builder *b, const nh_slice *s, const nh_ex *A, const char *letter)
{
    size_t n = s->n, d = s->d;
    for (size_t a = 0; a < d; a++)
        for (size_t i = 0; i < n; i++)
            if (!nh_is_zero(b->d, A[a * n + i]))
                nh_sheet_formula(b->s,
                                 nh_sheet_label(b->s, "%s^{%zu}_{<%s>}", letter, a + 1, nh_reduction_sheet_x(b, s, i)),
                                 A[a * n + i]);
    for (size_t i = 0; i < n; i++) {
        const char *x = nh_reduction_sheet_x(b, s, i);
        nh_sheet_sum(b->s, "", nh_sheet_label(b->s, "hor(\\frac{\\p}{\\p<%s>})", x));
        nh_sheet_add(b->s, nh_int(b->d, 1), nh_sheet_label(b->s, "\\frac{\\p}{\\p<%s>}", x));
        for (size_t a = 0; a < d; a++) add(b, nh_neg(b->d, A[a * n + i]), "e_{%zu}", a + 1);
    }
}

void nh_reduction_sheet_curvature(const nh_reduction_builder *b, const nh_slice *s, const nh_ex *B, const char *letter)
{
    size_t n = s->n, listed = 0;
    for (size_t a = 0; a < s->d; a++)
        for (size_t i = 0; i < n; i++)
            for (size_t j = i + 1; j < n; j++) {
                nh_ex e = B[(a * n + i) * n + j];
                if (nh_is_zero(b->d, e)) continue;
                nh_sheet_formula(b->s,
                                 nh_sheet_label(b->s, "%s^{%zu}_{<%s>,<%s>}", letter, a + 1,
                                                nh_reduction_sheet_x(b, s, i), nh_reduction_sheet_x(b, s, j)),
                                 e);
                listed++;
            }
    if (!listed) nh_sheet_words(b->s, "The curvature vanishes.");
}

/* n x n, symmetric: the entries that do not vanish. */
void nh_reduction_sheet_symmetric(const nh_reduction_builder *b, const nh_slice *s, const nh_ex *e, const char *letter)
{
    for (size_t i = 0; i < s->n; i++)
        for (size_t j = i; j < s->n; j++)
            if (!nh_is_zero(b->d, e[i * s->n + j]))
                nh_sheet_formula(b->s,
                                 nh_sheet_label(b->s, "%s_{<%s>,<%s>}", letter, nh_reduction_sheet_x(b, s, i),
                                                nh_reduction_sheet_x(b, s, j)),
                                 e[i * s->n + j]);
}

/* 1/2 p K^-1 p as terms; names of two momenta by their indices. */
static void quadratic(const nh_reduction_builder *b, size_t n, const nh_ex *inverse,
                      const char *(*name)(const nh_reduction_builder *, size_t), bool numbered)
{
    for (size_t i = 0; i < n; i++)
        for (size_t j = i; j < n; j++) {
            nh_ex e = i == j ? nh_mul(b->d, nh_ratio(b->d, 1, 2), inverse[i * n + j]) : inverse[i * n + j];
            const char *letter = numbered ? "theta" : "p";
            if (i == j) nh_sheet_add(b->s, e, nh_sheet_label(b->s, "%s_{%s}^{2}", letter, name(b, i)));
            else nh_sheet_add(b->s, e, nh_sheet_label(b->s, "%s_{%s} %s_{%s}", letter, name(b, i), letter, name(b, j)));
        }
}

static const char *shape_name(const nh_reduction_builder *b, size_t i)
{
    return nh_sheet_label(b->s, "<%s>", nh_reduction_sheet_x(b, b->slice, i));
}
static const char *group_name(const nh_reduction_builder *b, size_t a) { return nh_sheet_label(b->s, "%zu", a + 1); }

static const char *speed(const nh_reduction_builder *b, size_t i)
{
    return nh_sheet_label(b->s, "<%s'>", nh_reduction_sheet_x(b, b->slice, i));
}

/* 1/2 x' K x' as terms. */
void nh_reduction_sheet_kinetic(const nh_reduction_builder *b, const nh_ex *K)
{
    size_t n = b->slice->n;
    for (size_t i = 0; i < n; i++)
        for (size_t j = i; j < n; j++) {
            nh_ex e = i == j ? nh_mul(b->d, nh_ratio(b->d, 1, 2), K[i * n + j]) : K[i * n + j];
            nh_sheet_add(b->s, e,
                         i == j ? nh_sheet_label(b->s, "%s^{2}", speed(b, i))
                                : nh_sheet_label(b->s, "%s %s", speed(b, i), speed(b, j)));
        }
}

void nh_reduction_sheet_hamiltonian(const nh_reduction_builder *b, const char *label, const nh_ex *inverse,
                                    const nh_ex *locked, nh_ex V)
{
    nh_sheet_sum(b->s, "", label);
    quadratic(b, b->slice->n, inverse, shape_name, false);
    if (locked) quadratic(b, b->slice->d, locked, group_name, true);
    nh_sheet_add(b->s, V, "");
}

/* ---- the first stage ---- */

static void gyroscopic(const nh_reduction_builder *b, const nh_chaplygin *c)
{
    size_t n = c->n, d = c->d, listed = 0;
    nh_sheet_begin(
        b->s, "gyroscopic_form", "Momentum of the group and almost-symplectic form",
        "$J_{a}$ is the group's momentum in the body frame; the form is $\\d x\\wedge\\d p + \\frac{1}{2} "
        "Upsilon_{i,j} \\d x^{i}\\wedge\\d x^{j}$ with $Upsilon_{i,j}=J_{a} B^{a}_{i,j}$, eqs. 2.11 and 2.12.");
    for (size_t a = 0; a < d; a++) {
        nh_sheet_sum(b->s, "", nh_sheet_label(b->s, "J_{%zu}", a + 1));
        for (size_t j = 0; j < n; j++) nh_sheet_add(b->s, c->J[a * n + j], speed(b, j));
    }
    for (size_t i = 0; i < n; i++)
        for (size_t j = i + 1; j < n; j++) {
            bool any = false;
            for (size_t k = 0; k < n; k++) any |= !nh_is_zero(b->d, c->U[(k * n + i) * n + j]);
            if (!any) continue;
            nh_sheet_sum(b->s, "",
                         nh_sheet_label(b->s, "Upsilon_{<%s>,<%s>}", nh_reduction_sheet_x(b, c->slice, i),
                                        nh_reduction_sheet_x(b, c->slice, j)));
            for (size_t k = 0; k < n; k++) nh_sheet_add(b->s, c->U[(k * n + i) * n + j], speed(b, k));
            listed++;
        }
    if (!listed) nh_sheet_words(b->s, "$Upsilon$ vanishes: the form is symplectic.");
}

static void chaplygin(nh_reduction_builder *b, const nh_chaplygin *c, const nh_reduction_theory *t)
{
    size_t n = c->n;
    b->slice = c->slice;
    nh_reduction_sheet_frame(b, c->slice);
    nh_sheet_begin(b->s, "connection", "Connection, horizontal lift and curvature",
                   "$zeta=-\\hat{A} <x'>$ where the constraints hold (Chhabra and Emami 2014, eq. 2.8). The lifts span "
                   "the constraint distribution $D$, which meets $V$ in $0$ only: $S=0$. "
                   "$B^{a}_{i,j}=\\p_{i} A^{a}_{j}-\\p_{j} A^{a}_{i}-C^{a}_{b,c} A^{b}_{i} A^{c}_{j}$. Entries that "
                   "are not listed vanish.");
    nh_reduction_sheet_lift(b, c->slice, c->A, "\\hat{A}");
    nh_reduction_sheet_curvature(b, c->slice, c->B, "B");
    nh_sheet_begin(b->s, "hamiltonian", "Reduced Lagrangian and Hamiltonian",
                   "$\\hat{K}=H^{T} K H$ with the metric $K$ of the kinetic energy and the lift $H$; "
                   "$p_{i}=\\hat{K}_{i,j} <x'>^{j}$ (eq. 2.10).");
    nh_reduction_sheet_symmetric(b, c->slice, c->K, "\\hat{K}");
    nh_sheet_sum(b->s, "", "\\hat{L}");
    nh_reduction_sheet_kinetic(b, c->K);
    for (size_t i = 0; i < n && !c->plain; i++) nh_sheet_add(b->s, c->a[i], speed(b, i));
    nh_sheet_add(b->s, nh_neg(b->d, c->V), "");
    if (c->plain && t->inverse) nh_reduction_sheet_hamiltonian(b, "\\hat{H}", t->inverse, NULL, c->V);
    gyroscopic(b, c);
}

/* ---- Lagrange-Poincare stages ---- */

static const char *number(const nh_reduction_builder *b, const char *letter, size_t a)
{
    return nh_sheet_label(b->s, "%s_{%zu}", letter, a + 1);
}
static const char *bundle_speed(const nh_reduction_builder *b, const nh_slice *s, size_t i)
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
                         i == j ? nh_sheet_label(b->s, "%s^{2}", bundle_speed(b, s, i))
                                : nh_sheet_label(b->s, "%s %s", bundle_speed(b, s, i), bundle_speed(b, s, j)));
        }
    for (size_t i = 0; i < l->n; i++)
        for (size_t p = 0; p < l->r; p++)
            nh_sheet_add(b->s, l->C[i * l->r + p], nh_sheet_label(b->s, "%s nu_{%zu}", bundle_speed(b, s, i), p + 1));
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

static void put_bundle(const nh_reduction_builder *b, const nh_lagrange_poincare *l)
{
    nh_reduction_sheet_frame(b, l->slice);
    distribution(b, l);
    lagrangian(b, l);
    equations(b, l);
}

/* ---- all of them ---- */

nh_sheet *nh_reduction_sheet(const nh_reduction *r, const nh_reduction_stage *stage)
{
    const nh_reduction_theory *t = stage->theory;
    nh_reduction_builder b = {.d = r->kinetic->dag};
    if (!t || (stage->kind != NH_STAGE_CHAPLYGIN && stage->kind != NH_STAGE_SECOND && !t->bundle)) return NULL;
    b.s = nh_sheet_create(r->arena, b.d);
    b.s->shown = r->options.shown;
    if (stage->kind == NH_STAGE_CHAPLYGIN) chaplygin(&b, stage->chaplygin, t);
    if (stage->kind == NH_STAGE_SECOND) nh_reduction_sheet_second(&b, stage->second, t);
    if (t->bundle) put_bundle(&b, t->bundle);
    if (t->bundle && stage->by_stages) nh_reduction_sheet_stages(&b, t->bundle, stage->chain, r->inner);
    return b.s;
}

/* ---- brackets, reduced equations, and formulas to which remarks refer ---- */

static nh_sheet *sheet_of(const nh_reduction *r)
{
    nh_sheet *s = nh_sheet_create(r->arena, r->kinetic->dag);
    s->shown = r->options.shown;
    return s;
}

/* Those of the fields, minus the constants of the Lie algebra. */
static void put_brackets(nh_sheet *s, const nh_action *g)
{
    nh_dag *d = g->kinetic->dag;
    for (size_t a = 0; a < g->d; a++)
        for (size_t b = a + 1; b < g->d; b++) {
            bool any = false;
            if (g->outside[a * g->d + b])
                nh_sheet_words(
                    s, nh_sheet_label(
                           s, "$[e_{%zu},e_{%zu}]$ is none of their combinations: a symmetry without a closed form.",
                           a + 1, b + 1));
            for (size_t k = 0; k < g->d; k++) {
                nh_ex c = g->constant[(a * g->d + b) * g->d + k];
                if (nh_is_zero(d, c)) continue;
                if (!any) nh_sheet_sum(s, "", nh_sheet_label(s, "[e_{%zu},e_{%zu}]", a + 1, b + 1));
                any = true;
                nh_sheet_add(s, nh_neg(d, c), nh_sheet_label(s, "e_{%zu}", k + 1));
            }
        }
}

nh_sheet *nh_reduction_brackets_sheet(const nh_reduction *r, const nh_action *g)
{
    nh_sheet *s = sheet_of(r);
    nh_sheet_begin(s, "brackets", "", "");
    put_brackets(s, g);
    s->section->words =
        s->section->lines
            ? "Brackets of the fields, $[e_{a},e_{b}]=-C^{c}_{a,b} e_{c}$ with the structure constants $C$ of the Lie "
              "algebra of the group. Those that are not listed vanish."
            : "All brackets vanish.";
    return s;
}

nh_sheet *nh_reduction_equations_sheet(const nh_reduction *r, const nh_reduction_stage *stage)
{
    const char **label;
    nh_ex *value;
    size_t n = nh_reduction_shown(r, stage, &label, &value);
    nh_sheet *s = sheet_of(r);
    nh_sheet_begin(s, "reduced_equations", "", "");
    for (size_t i = 0; i < n; i++) nh_sheet_formula(s, nh_sheet_label(s, "<%s>", label[i]), value[i]);
    nh_sheet_words(s, nh_sheet_label(s, "(%s)", nh_reduction_letters(r, stage)));
    return s;
}

nh_sheet *nh_reduction_remarks_sheet(const nh_reduction *r, const nh_reduction_stage *stage)
{
    const nh_chaplygin_measure *m = &stage->measure;
    const nh_linear_momenta *l = &stage->linear;
    nh_sheet *s = sheet_of(r);
    nh_sheet_begin(s, "remarks", "", "");
    if (m->tested && m->measure && m->closed) nh_sheet_formula(s, "<density>", m->density);
    for (size_t a = 0; a < l->count * l->count; a++) {
        const char *label = nh_sheet_label(s, "N_{%zu,%zu}", a / l->count + 1, a % l->count + 1);
        if (!nh_is_zero(s->dag, l->N[a])) nh_sheet_formula(s, label, l->N[a]);
    }
    return s->section->lines ? s : NULL;
}
