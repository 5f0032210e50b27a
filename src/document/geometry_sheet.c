/* geometry_sheet: one function for each section. */
#include "document/geometry_sheet.h"

#include <string.h>

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"

typedef struct {
    nh_sheet *s;
    const nh_theory *t;
    const nh_model *o;
    nh_dag *d;
} builder;

/* The index l of a velocity: the name of its coordinate, or of the quasi-velocity. */
static const char *index_of(const builder *b, size_t l)
{
    const nh_chart *c = b->o->chart;
    return c->quasi ? nh_name_of(b->d, c->w[l]) : b->o->system->coordinate[c->free[l]].name;
}

static const char *velocity(const builder *b, size_t l) { return nh_name_of(b->d, b->o->chart->w[l]); }
static const char *coordinate(const builder *b, size_t s) { return b->o->system->coordinate[s].name; }
static const char *dependent(const builder *b, size_t a) { return coordinate(b, b->o->chart->dependent[a]); }

static void formula(const builder *b, nh_ex e, const char *format, const char *first, const char *second)
{
    nh_sheet_formula(b->s, nh_sheet_label(b->s, format, first, second), e);
}

static void add(const builder *b, nh_ex e, const char *format, const char *name)
{
    nh_sheet_add(b->s, e, nh_sheet_label(b->s, format, name));
}

/* ---- the constraints ---- */

static void normal_form(const builder *b)
{
    const nh_model *model = b->o;
    if (!b->t->submanifold->normal) return;
    char *branch = model->chart->branch ? nh_chart_branch_name(model->chart, model->chart->branch) : NULL;
    nh_sheet_begin(
        b->s, "normal_form", "Normal form of the constraints",
        branch ? nh_sheet_label(b->s, "Dependent velocities as functions of the others, on the branch %s.", branch)
               : "Dependent velocities as functions $g$ of the others.");
    nh_free(branch);
    /* here a root is shown as a root, and not as the velocity that it is equal to */
    b->s->section[b->s->sections - 1].literal = true;
    for (size_t a = 0; a < model->k; a++) {
        nh_ex g = model->rho[model->chart->dependent[a]];
        bool implicit = nh_kind_of(b->d, g) == NH_SYMBOL && model->chart->implicit &&
                        g == model->chart->u[a < model->chart->implicit ? a : 0];
        if (implicit)
            nh_sheet_words(b->s, nh_sheet_label(b->s, "$<%s'>$ has no closed form: the constraints determine it.",
                                                dependent(b, a)));
        else formula(b, g, "<%s'>", dependent(b, a), NULL);
    }
}

static void forms(const builder *b)
{
    const nh_model *model = b->o;
    for (size_t a = 0; a < model->k; a++) {
        const nh_ex *form = b->t->submanifold->form + a * (1 + model->m);
        nh_sheet_sum(b->s, "", nh_sheet_label(b->s, "\\form^{%zu}", a + 1));
        for (size_t s = 0; s < model->m; s++) add(b, form[1 + s], "\\d<%s>", coordinate(b, s));
        nh_sheet_add(b->s, form[0], "\\d t");
    }
}

/* X_0 and X_l, which the paper writes d'_c/dt and d_c/dq^l. */
static void basis(const builder *b)
{
    const nh_model *model = b->o;
    bool quasi = model->chart->quasi;
    nh_sheet_sum(b->s, "", quasi ? "X_{0}" : "\\frac{\\dcp}{\\d t}");
    nh_sheet_add(b->s, nh_int(b->d, 1), "\\frac{\\p}{\\p t}");
    for (size_t s = 0; s < model->m; s++) add(b, model->rho[s], "\\frac{\\p}{\\p<%s>}", coordinate(b, s));
    for (size_t l = 0; l < model->n; l++) {
        nh_sheet_sum(b->s, "", nh_sheet_label(b->s, quasi ? "X_{<%s>}" : "\\frac{\\pc}{\\p<%s>}", index_of(b, l)));
        for (size_t s = 0; s < model->m; s++)
            add(b, model->R[s * model->n + l], "\\frac{\\p}{\\p<%s>}", coordinate(b, s));
    }
}

/* [X_l, X_s] and [X_0, X_l] along the coordinates, and [X_0, X_l] along time is 0: those that do not vanish. */
static void brackets(const builder *b)
{
    const nh_model *model = b->o;
    bool quasi = model->chart->quasi;
    for (size_t l = 0; l < model->n; l++)
        for (size_t s = 0; s <= l; s++) { /* s = 0: X_0, else X_{s-1} */
            const char *first = quasi ? "X_{0}" : "\\frac{\\dcp}{\\d t}";
            const char *format = quasi ? "X_{<%s>}" : "\\frac{\\pc}{\\p<%s>}";
            if (s) first = nh_sheet_label(b->s, format, index_of(b, s - 1));
            bool any = false;
            for (size_t i = 0; i < model->m; i++) {
                nh_ex R = model->R[i * model->n + l];
                nh_ex e =
                    s ? nh_sub(b->d, nh_model_X(model, s - 1, R), nh_model_X(model, l, model->R[i * model->n + s - 1]))
                      : nh_sub(b->d, nh_model_X0(model, R), nh_model_X(model, l, model->rho[i]));
                e = nh_simplify(b->d, e);
                if (nh_is_zero(b->d, e)) continue;
                if (!any)
                    nh_sheet_sum(b->s, "",
                                 nh_sheet_label(b->s, "[%s,%s]", first, nh_sheet_label(b->s, format, index_of(b, l))));
                any = true;
                add(b, e, "\\frac{\\p}{\\p<%s>}", coordinate(b, i));
            }
        }
}

static void distribution(const builder *b)
{
    const nh_model *model = b->o;
    bool quasi = model->chart->quasi;
    nh_sheet_begin(b->s, "canonical_distribution", "Canonical distribution",
                   model->k
                       ? "The fields that the forms $\\form^{a}$ annihilate; these span it."
                       : "Without constraints: spanned by the derivative along motions, less the accelerations, and "
                         "the directions of positions and velocities.");
    forms(b);
    basis(b);
    for (size_t l = 0; l < model->n && quasi; l++) {
        nh_sheet_sum(b->s, "", nh_sheet_label(b->s, "Y_{<%s>}", index_of(b, l)));
        add(b, nh_int(b->d, 1), "\\frac{\\p}{\\p<%s>}", velocity(b, l));
    }
}

/* ---- the Lagrangian ---- */

static void lagrangian(const builder *b)
{
    const nh_model *model = b->o;
    const nh_submanifold *s = b->t->submanifold;
    nh_sheet_begin(b->s, "lagrangian", model->k ? "Lagrangian on the constraint submanifold" : "Lagrangian and momenta",
                   s->normal ? "$\\bar{L}$ is $L$ with the constraints inserted, $\\bar{L}_{a}$ its derivative by a "
                               "dependent velocity, before they are inserted; $p$ are the momenta, $E$ is the energy."
                   : model->k || model->chart->quasi
                       ? "$\\bar{L}$ is $L$ in the velocities of the chart; $p$ are the momenta, $E$ is the energy."
                       : "Without constraints $\\bar{L}$ is $L$ itself; $p$ are the momenta, $E$ is the energy.");
    formula(b, model->Lbar, "\\bar{L}", NULL, NULL);
    for (size_t a = 0; a < model->k && s->normal; a++)
        formula(b, model->p[model->chart->dependent[a]], "\\bar{L}_{<%s>}", dependent(b, a), NULL);
    for (size_t l = 0; l < model->n; l++)
        formula(b, model->pbar[l], "\\frac{\\p\\bar{L}}{\\p<%s>}", velocity(b, l), NULL);
    for (size_t i = 0; i < model->m; i++) formula(b, model->p[i], "p_{<%s>}", coordinate(b, i), NULL);
    formula(b, model->E, "E", NULL, NULL);
}

/* The rate of a velocity: x'' or omega'. */
static const char *rate(const builder *b, size_t l) { return nh_sheet_label(b->s, "<%s'>", velocity(b, l)); }

static void euler(const builder *b)
{
    const nh_model *model = b->o;
    const nh_submanifold *s = b->t->submanifold;
    if (model->chart->quasi) return; /* in quasi-velocities there are more terms: Abar contains them */
    nh_sheet_begin(
        b->s, "euler_expressions", "Euler expressions",
        !model->k ? "The derivative by $q^{l}$, less the rate of the derivative by the velocity $l$."
                  : "Of a function $f$: its constraint derivative by $q^{l}$, less the rate of its derivative by the "
                    "velocity $l$. The reduced equations are $\\eps_{l}(\\bar{L})-\\bar{L}_{a} \\eps_{l}(g^{a})=0$.");
    for (size_t l = 0; l < model->n; l++) {
        nh_sheet_sum(b->s, "", nh_sheet_label(b->s, "\\eps_{<%s>}(\\bar{L})", index_of(b, l)));
        nh_sheet_add(b->s, s->force[l], "");
        for (size_t r = 0; r < model->n; r++)
            nh_sheet_add(b->s, nh_neg(b->d, s->inertia[l * model->n + r]), rate(b, r));
    }
    for (size_t a = 0; a < model->k && s->normal; a++)
        for (size_t l = 0; l < model->n; l++) {
            nh_sheet_sum(b->s, "", nh_sheet_label(b->s, "\\eps_{<%s>}(g^{<%s>})", index_of(b, l), dependent(b, a)));
            nh_sheet_add(b->s, s->turn[a * model->n + l], "");
            for (size_t r = 0; r < model->n; r++)
                nh_sheet_add(b->s, nh_neg(b->d, s->bend[(a * model->n + l) * model->n + r]), rate(b, r));
        }
}

/* ---- the reduced equations ---- */

static void matrix(const builder *b, const nh_ex *e, bool minus, const char *format, bool diagonal)
{
    size_t n = b->o->n;
    for (size_t l = 0; l < n; l++)
        for (size_t s = l + !diagonal; s < n; s++)
            if (!nh_is_zero(b->d, e[l * n + s]))
                formula(b, minus ? nh_neg(b->d, e[l * n + s]) : e[l * n + s], format, index_of(b, l), index_of(b, s));
}

static void reduced(const builder *b)
{
    const nh_model *model = b->o;
    nh_sheet_begin(
        b->s, "reduced_equations", "Reduced equations (9)",
        "$\\bar{A}_{l}+\\bar{B}_{l,s} <w'>^{s}=0$ for the independent velocities $w$. $\\bar{B}$ and its inverse are "
        "symmetric; $G$, the braces of (18) and (20), is antisymmetric. Entries that are not listed vanish.");
    for (size_t l = 0; l < model->n; l++) formula(b, model->A[l], "\\bar{A}_{<%s>}", index_of(b, l), NULL);
    matrix(b, model->M, true, "\\bar{B}_{<%s>,<%s>}", true);
    matrix(b, b->t->submanifold->inverse, false, "(\\bar{B}^{-1})_{<%s>,<%s>}", true);
    matrix(b, nh_model_G(model), false, "G_{<%s>,<%s>}", false);
    for (size_t l = 0; l < model->n; l++) {
        nh_sheet_sum(b->s, nh_sheet_label(b->s, "(9, <%s>)", index_of(b, l)), "");
        nh_sheet_add(b->s, model->A[l], "");
        for (size_t s = 0; s < model->n; s++) nh_sheet_add(b->s, nh_neg(b->d, model->M[l * model->n + s]), rate(b, s));
    }
}

static void field(const builder *b, const nh_model *model, nh_ex time, const nh_ex *space, const nh_ex *along)
{
    nh_sheet_add(b->s, time, "\\frac{\\p}{\\p t}");
    for (size_t s = 0; s < model->m; s++) add(b, space[s], "\\frac{\\p}{\\p<%s>}", coordinate(b, s));
    for (size_t l = 0; l < model->n; l++)
        add(b, along[l], "\\frac{\\p}{\\p<%s>}", nh_name_of(b->d, model->chart->w[l]));
}

static void semispray(const builder *b)
{
    nh_sheet_begin(b->s, "semispray", b->o->k ? "Constraint semispray (21)" : "Semispray (21)",
                   b->o->k ? "The field of the equations of motion on the constraint submanifold."
                           : "The field of the equations of motion.");
    nh_sheet_sum(b->s, "", "Gamma");
    field(b, b->o, nh_int(b->d, 1), b->o->rho, b->o->a);
}

/* A_s + B_sr q''^r = mu_a df^a/dq'^s */
static void chetaev(const builder *b)
{
    const nh_model *model = b->o;
    const nh_submanifold *s = b->t->submanifold;
    nh_sheet_begin(
        b->s, "chetaev_equations", model->k ? "Chetaev's equations with multipliers (10)" : "Lagrange's equations (2)",
        model->k ? "In all velocities, for the constraints as they were written; then multipliers and force of "
                   "the constraints, with the constraints inserted."
                 : "");
    for (size_t i = 0; i < model->m; i++) {
        nh_sheet_sum(b->s, "", "");
        nh_sheet_add(b->s, s->free_A[i], "");
        for (size_t r = 0; r < model->m; r++) add(b, s->free_B[i * model->m + r], "<%s''>", coordinate(b, r));
        if (model->k) nh_sheet_equals(b->s);
        for (size_t a = 0; a < model->k; a++)
            nh_sheet_add(b->s, s->f_v[a * model->m + i],
                         model->k == 1 ? "mu" : nh_sheet_label(b->s, "mu_{%zu}", a + 1));
    }
    for (size_t a = 0; a < model->k; a++)
        nh_sheet_formula(b->s, model->k == 1 ? "mu" : nh_sheet_label(b->s, "mu_{%zu}", a + 1), model->mu[a]);
    for (size_t i = 0; i < model->m && model->k; i++)
        formula(b, model->reaction[i], "F_{<%s>}", coordinate(b, i), NULL);
}

/* (46): mu_a df^a/dq'^s as a sum of inertial forces. */
static void inertial(const builder *b)
{
    static const char *const names[] = {"F^{centrifugal}_{<%s>}", "F^{Coriolis}_{<%s>}", "F^{further}_{<%s>}",
                                        "F^{applied}_{<%s>}"};
    const nh_inertial *f = b->t->inertial;
    const nh_model *model = b->o;
    if (!f) return;
    nh_sheet_begin(b->s, "inertial_forces", "The force of the constraints as inertial forces (46)",
                   "Left side of Chetaev's equation along each length, by its parts; those not listed vanish. Minus "
                   "their sum is the force of the constraints.");
    for (size_t c = 0; c < model->m; c++) {
        if (model->system->coordinate[c].type != NH_LENGTH) continue;
        for (int turning = 1; turning >= 0; turning--) {
            bool any = false;
            for (size_t r = 0; r < model->m; r++) {
                nh_ex e = f->of->free_B[c * model->m + r];
                if (nh_is_zero(b->d, e) || (model->system->coordinate[r].type == NH_ANGLE) != turning) continue;
                if (!any)
                    nh_sheet_sum(b->s, "",
                                 nh_sheet_label(b->s, turning ? "F^{Euler}_{<%s>}" : "F^{translational}_{<%s>}",
                                                coordinate(b, c)));
                any = true;
                add(b, e, "<%s''>", coordinate(b, r));
            }
        }
        for (size_t i = 0; i < NH_INERTIAL_PARTS; i++) {
            nh_ex e = f->part[c * NH_INERTIAL_PARTS + i];
            if (!nh_is_zero(b->d, e)) formula(b, e, names[i], coordinate(b, c), NULL);
        }
    }
}

/* ---- determining equations ---- */

static const char *unknown(const builder *b, const nh_determining_term *t)
{
    switch (t->of) {
    case NH_DETERMINING_PHI: return "Phi";
    case NH_DETERMINING_Z0: return "Z^{0}";
    case NH_DETERMINING_W:
        return nh_sheet_label(b->s, b->o->chart->quasi ? "W^{<%s>}" : "\\tilde{Z}^{<%s>}", index_of(b, t->index));
    default: return nh_sheet_label(b->s, t->of == NH_DETERMINING_Z ? "Z^{<%s>}" : "zeta^{<%s>}", index_of(b, t->index));
    }
}

static const char *operated(const builder *b, const nh_determining_term *t)
{
    const char *of = unknown(b, t);
    bool quasi = b->o->chart->quasi;
    if (t->along == NH_DETERMINING_PLAIN) return of;
    if (t->along == NH_DETERMINING_X0) return nh_sheet_label(b->s, quasi ? "X_{0}(%s)" : "\\frac{\\dcp %s}{\\d t}", of);
    if (t->along == NH_DETERMINING_Y)
        return nh_sheet_label(b->s, "\\frac{\\p %s}{\\p<%s>}", of, velocity(b, t->direction));
    return quasi ? nh_sheet_label(b->s, "X_{<%s>}(%s)", index_of(b, t->direction), of)
                 : nh_sheet_label(b->s, "\\frac{\\pc %s}{\\p<%s>}", of, index_of(b, t->direction));
}

static void determining(const builder *b)
{
    const nh_determining *all = b->t->determining;
    const nh_model *model = b->o;
    bool quasi = model->chart->quasi;
    nh_sheet_begin(b->s, "determining_equations", "Determining equations of constraint symmetries (14)-(19)",
                   quasi
                       ? "Unknown: the functions of $Z=Z^{0} X_{0}+zeta^{l} X_{l}+W^{l} Y_{l}$. With the current $Phi$ "
                         "(13), equations (17)-(19) say the same as (14)-(16)."
                       : "Unknown: the components $Z^{0}$, $Z^{l}$ and those along velocities, $\\tilde{Z}^{l}$, of a "
                         "field in the canonical distribution. "
                         "With its current $Phi$ (13) and $zeta^{l}$, equations (17)-(19) say the same as (14)-(16).");
    for (size_t l = 0; l < model->n && !quasi; l++) {
        nh_sheet_sum(b->s, "", nh_sheet_label(b->s, "zeta^{<%s>}", index_of(b, l)));
        add(b, nh_int(b->d, 1), "Z^{<%s>}", index_of(b, l));
        nh_sheet_add(b->s, nh_neg(b->d, model->chart->w[l]), "Z^{0}");
    }
    nh_sheet_sum(b->s, "(13)", "Phi");
    nh_sheet_add(b->s, model->Lbar, "Z^{0}");
    for (size_t l = 0; l < model->n; l++) add(b, model->pbar[l], "zeta^{<%s>}", index_of(b, l));
    for (size_t i = 0; i < all->count; i++) {
        const nh_determining_equation *e = &all->equation[i];
        bool one = e->number == 14 || e->number == 17;
        nh_sheet_sum(b->s,
                     one ? nh_sheet_label(b->s, "(%d)", e->number)
                         : nh_sheet_label(b->s, "(%d, <%s>)", e->number, index_of(b, e->direction)),
                     "");
        for (size_t j = 0; j < e->terms; j++) nh_sheet_add(b->s, e->term[j].coefficient, operated(b, &e->term[j]));
    }
}

/* ---- currents ---- */

/* [Gamma, Z] along coordinate velocities, where the geometry is shown in them. */
static void bracket_field(const builder *b, const struct nh_theory_bracket *c)
{
    const nh_bracket *k = c->bracket;
    const nh_model *own = b->t->own->model;
    nh_sheet_sum(b->s, "", nh_sheet_label(b->s, "[Gamma,Z(<%s>)]", c->name));
    nh_sheet_add(b->s, k->motion, "Gamma");
    if (own == b->o) {
        field(b, own, k->field.time, k->field.space, k->field.velocity);
        return;
    }
    nh_sheet_add(b->s, k->field.time, "\\frac{\\p}{\\p t}");
    for (size_t s = 0; s < own->m; s++) add(b, k->field.space[s], "\\frac{\\p}{\\p<%s>}", coordinate(b, s));
    for (size_t l = 0; l < b->o->n; l++) add(b, k->rate[b->o->chart->free[l]], "\\frac{\\p}{\\p<%s>}", velocity(b, l));
}

static void currents(const builder *b)
{
    const nh_theory *t = b->t;
    if (!t->brackets) return;
    nh_sheet_begin(b->s, "currents", "Brackets of the currents' fields",
                   "The Lie derivative of the constraint form along Z is $F_{a} \\form^{a}$ (12); $[Gamma,Z]=a Gamma+b "
                   "Z$ in case 1, with $b=0$, and in case 2. $i_{[Gamma,Z]}\\form^{a}$ is what the bracket has outside "
                   "of the canonical distribution (22).");
    for (size_t i = 0; i < t->brackets; i++) {
        const struct nh_theory_bracket *c = &t->bracket[i];
        for (size_t a = 0; a < b->o->k; a++)
            nh_sheet_formula(b->s, nh_sheet_label(b->s, "F_{%zu}(<%s>)", a + 1, c->name), c->bracket->F[a]);
        bracket_field(b, c);
        if (c->bracket->decided) {
            formula(b, c->bracket->a, "a(<%s>)", c->name, NULL);
            if (c->symmetry->kase == 2) formula(b, c->bracket->b, "b(<%s>)", c->name, NULL);
        }
        for (size_t a = 0; a < b->o->k; a++)
            nh_sheet_formula(b->s, nh_sheet_label(b->s, "i_{[Gamma,Z(<%s>)]}\\form^{%zu}", c->name, a + 1),
                             c->bracket->form[a]);
    }
}

nh_sheet *nh_geometry_sheet(nh_arena *arena, const nh_theory *t, const nh_analysis_file *analysis)
{
    builder b = {nh_sheet_create(arena, t->model->dag), t, t->model, t->model->dag};
    b.s->analysis = analysis;
    b.s->chart = t->model->chart->roots ? t->model->chart : NULL;
    b.s->shown = t->shown;
    b.s->written = t->written;
    normal_form(&b);
    distribution(&b);
    nh_sheet_begin(b.s, "field_brackets", "Brackets of these fields", "Those that do not vanish.");
    brackets(&b);
    lagrangian(&b);
    euler(&b);
    reduced(&b);
    semispray(&b);
    chetaev(&b);
    inertial(&b);
    determining(&b);
    currents(&b);
    nh_symmetry_sheet(b.s, t);
    return b.s;
}

/* ---- what a reader looks for first ---- */

/* What the velocities of the coordinates are: of the constraints, or of the map to quasi-velocities. */
static void overview_velocities(const builder *b)
{
    const nh_model *model = b->o;
    nh_sheet_begin(b->s, "velocities", "Chart", "");
    b->s->section[b->s->sections - 1].literal = true;
    for (size_t i = 0; i < model->m && !model->framed; i++)
        if (nh_kind_of(b->d, model->rho[i]) != NH_SYMBOL || model->chart->quasi)
            formula(b, model->rho[i], "<%s'>", coordinate(b, i), NULL);
}

static void overview_lagrangian(const builder *b)
{
    const nh_model *model = b->o;
    const char *L = model->k ? "\\bar{L}" : "L";
    nh_sheet_begin(b->s, "lagrangian",
                   model->k ? "Lagrangian with the constraints inserted, and energy" : "Lagrangian and energy", "");
    if (model->Lbar == model->E) {
        formula(b, model->E, "%s = E", L, NULL);
        return;
    }
    formula(b, model->Lbar, "%s", L, NULL);
    formula(b, model->E, "E", NULL, NULL);
}

static void overview_equations(const builder *b)
{
    const nh_model *model = b->o;
    nh_sheet_begin(b->s, "forces", "Forces", "");
    for (size_t l = 0; l < model->n; l++) formula(b, model->A[l], "\\bar{A}_{<%s>}", index_of(b, l), NULL);
    matrix(b, nh_model_G(model), false, "G_{<%s>,<%s>}", false);
    nh_sheet_begin(b->s, "inertia", "Mass matrix", "");
    matrix(b, model->M, false, "M_{<%s>,<%s>}", true);
    nh_sheet_begin(b->s, "equations_of_motion", "Equations of motion", "");
    for (size_t l = 0; l < model->n; l++) nh_sheet_formula(b->s, rate(b, l), model->a[l]);
    nh_sheet_begin(b->s, "multipliers", "Chetaev multipliers", "");
    for (size_t a = 0; a < model->k; a++)
        nh_sheet_formula(b->s, model->k == 1 ? "mu" : nh_sheet_label(b->s, "mu_{%zu}", a + 1), model->mu[a]);
}

nh_sheet *nh_geometry_overview(nh_arena *arena, const nh_model *model, const nh_options *options)
{
    builder b = {nh_sheet_create(arena, model->dag), NULL, model, model->dag};
    b.s->chart = model->chart->roots ? model->chart : NULL;
    b.s->shown = options->shown;
    b.s->written = options->written;
    overview_velocities(&b);
    overview_lagrangian(&b);
    nh_sheet_begin(b.s, "fields", "Fields of the canonical distribution, and their brackets", "");
    basis(&b);
    brackets(&b);
    overview_equations(&b);
    return b.s;
}

void nh_geometry_json(nh_arena *arena, const nh_theory *t, const nh_analysis_file *analysis, nh_json *to,
                      const char *key)
{
    if (!t) {
        nh_json_put_null(to, key);
        return;
    }
    nh_json *item = nh_json_put_object(to, key);
    nh_json_put_text(item, "chart", t->model->chart->name);
    nh_sheet_json(nh_geometry_sheet(arena, t, analysis), item);
}
