#include "document/reduction.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/escape.h"
#include "base/memory.h"
#include "document/facts.h"
#include "document/formula.h"
#include "document/reduction_internal.h"
#include "document/tex_internal.h"
#include "document/typeset.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "graph/print.h"
#include "reduction/section.h"

/* Simplified, unless it is so large that nobody would read it. */
static nh_ex shortened(const nh_reduction *r, nh_ex e)
{
    enum { largest = 4000 };
    return nh_node_count(r->kinetic->dag, e) < largest ? nh_simplify(r->kinetic->dag, e) : e;
}

const nh_reduction_stage *nh_reduction_named(const nh_reduction_stage *s) { return s->named ? s->named : s; }

size_t nh_reduction_equations(const nh_reduction *r, const nh_reduction_stage *s, nh_reduction_equation **out)
{
    const nh_reduced *o = s->shown;
    nh_dag *d = r->kinetic->dag;
    nh_arena *arena = r->kinetic->arena;
    size_t n = 0;
    nh_reduction_equation *e = nh_arena_alloc(arena, (o->n + 2 * o->r + o->d + 1) * sizeof *e);
    for (size_t i = 0; i < o->r && !o->plain; i++) {
        nh_ex sum = nh_int(d, 0);
        for (size_t j = 0; j < o->r; j++) sum = nh_add(d, sum, nh_mul(d, o->M[i * o->r + j], o->w[j]));
        e[n++] = (nh_reduction_equation){o->momentum[i], shortened(r, sum)};
    }
    for (size_t i = 0; i < o->n; i++) {
        bool trivial = false; /* x' is itself one of the velocities */
        for (size_t j = 0; j < o->r; j++) trivial |= o->dx[i] == o->w[j];
        if (!trivial) e[n++] = (nh_reduction_equation){nh_name_of(d, o->x[i]), shortened(r, o->dx[i])};
        if (!trivial) e[n - 1].name = nh_arena_printf(arena, "%s'", e[n - 1].name);
    }
    for (size_t i = 0; i < o->r; i++)
        e[n++] = (nh_reduction_equation){nh_arena_printf(arena, "%s'", o->momentum[i]), shortened(r, o->F[i])};
    for (size_t a = 0; a < o->d; a++)
        e[n++] = (nh_reduction_equation){
            nh_kinetic_unused_name(r->kinetic, "%s_%zu", s->kind == NH_STAGE_SECOND ? "eta" : "zeta", a + 1),
            shortened(r, o->zeta[a])};
    *out = e;
    return n;
}

const char *nh_reduction_joint_name(const nh_reduction *r, size_t joint)
{
    const nh_chain *c = r->system->chain;
    return nh_arena_printf(r->kinetic->arena, "joint of %s", c->body[c->joint[joint].child].name);
}

/* ---- the reduced equations as LaTeX ---- */

static void put_stage_name(const nh_reduction *r, size_t i, const char *before, nh_text *out)
{
    const nh_reduction_stage *s = &r->stage[i];
    const char *holds = nh_reduction_stage_holds(r, s);
    nh_text_addf(out, "%s%s (%s), by %s%s%s%s", before, nh_reduction_stage_title(r, i), nh_stage_kind_name(s->kind),
                 s->group, s->local ? ", which acts locally" : "", *holds ? ", a group of symmetries" : "", holds);
}

enum { wide_row = 60 }; /* letters that fit on a line beside the name */

static void put_piece(void *context, const char *piece, nh_typeset_follows follows)
{
    (void)follows;
    nh_text_add(context, piece);
}

/* Rows of one alignment when all fit on a line, otherwise paragraphs that TeX breaks. */
static void put_stage_latex(const nh_reduction *r, const nh_reduction_stage *s, nh_text *out)
{
    nh_reduction_equation *e;
    size_t n = nh_reduction_equations(r, s, &e);
    bool rows = true;
    for (size_t k = 0; k < n; k++) {
        char *text = nh_print_short(r->kinetic->dag, e[k].value, r->options.written);
        rows = rows && text && nh_typeset_width(text) < wide_row;
        nh_free(text);
    }
    if (rows) nh_text_add(out, "\\begin{align*}\n");
    for (size_t k = 0; k < n; k++) {
        char *text = nh_print_short(r->kinetic->dag, e[k].value, r->options.written);
        if (!rows) nh_text_add(out, "\\nhformula{");
        nh_typeset(e[k].name, NH_LATEX, out);
        nh_text_add(out, rows ? " &= " : " = ");
        if (!text) nh_text_add(out, "\\text{(too long to be written out)}");
        else if (rows) nh_typeset(text, NH_LATEX, out);
        else nh_typeset_pieces(text, NH_LATEX, NH_TEX_WIDEST, put_piece, out);
        nh_text_add(out, !rows ? "}\n" : k + 1 < n ? " \\\\\n" : "\n");
        nh_free(text);
    }
    if (rows) nh_text_add(out, "\\end{align*}\n");
}

void nh_reduction_latex(const nh_reduction *r, nh_text *out)
{
    nh_text_add(out, "% ");
    nh_escape_line(r->system->title, out);
    nh_text_addf(out, ": reduced equations of motion, written by nhsym " NH_VERSION "; for the package amsmath\n%s",
                 nh_tex_formula_macro);
    for (size_t k = 0; k < r->stages; k++) {
        size_t i = nh_reduction_order(r, k);
        put_stage_name(r, i, "\n% ", out);
        nh_text_add(out, "\n");
        put_stage_latex(r, nh_reduction_named(&r->stage[i]), out);
    }
}

/* ---- words for the facts of a reduction ---- */

const char *nh_reduction_not_counted(const nh_kinetic *k)
{
    if (!k->quadratic) return "the Lagrangian is not quadratic in the velocities";
    if (!k->autonomous) return "time occurs in the Lagrangian or in a constraint";
    if (!k->affine) return "a constraint is not linear in the velocities";
    return k->invertible ? "time occurs in a force" : "not all velocities have inertia";
}

bool nh_reduction_on_levels(const nh_reduction_stage *s)
{
    return s->kind == NH_STAGE_SECOND && s->second->first->d == 0;
}

bool nh_reduction_instead(const nh_reduction *r, size_t i)
{
    nh_stage_kind kind = r->stage[i].kind;
    return i > 0 && kind != NH_STAGE_CHAPLYGIN && (kind != NH_STAGE_SECOND || nh_reduction_on_levels(&r->stage[i]));
}

/* Is the last stage the division by the whole group, and its shape a point?  Then it comes first. */
static bool point_first(const nh_reduction *r)
{
    size_t last = r->stages - 1;
    return r->stages > 1 && r->stage[0].kind == NH_STAGE_CHAPLYGIN && nh_reduction_instead(r, last) &&
           !r->stage[last].shown->n;
}

size_t nh_reduction_order(const nh_reduction *r, size_t k)
{
    if (!point_first(r)) return k;
    return k ? k - 1 : r->stages - 1;
}

const char *nh_reduction_stage_title(const nh_reduction *r, size_t i)
{
    nh_arena *arena = r->kinetic->arena;
    if (point_first(r) && i == r->stages - 1) return nh_arena_printf(arena, "In one step, stage %zu", i + 1);
    if (point_first(r) && i == 0) return "Instead of one step, stage 1";
    if (!nh_reduction_instead(r, i)) return nh_arena_printf(arena, "Stage %zu", i + 1);
    if (nh_reduction_on_levels(&r->stage[i]))
        return nh_arena_printf(arena, "Stage %zu, instead of stage %zu", i + 1, i);
    if (i == 1) return nh_arena_printf(arena, "Stage %zu, in one step instead of stage 1", i + 1);
    return nh_arena_printf(arena, "Stage %zu, in one step instead of stages 1 %s %zu", i + 1, i == 2 ? "and" : "to", i);
}

const char *nh_reduction_stage_kind(const nh_reduction_stage *s)
{
    static const char *const titles[] = {"Chaplygin reduction by", "second stage, by", NULL, "equations on a slice of",
                                         "the quotient by"};
    if (nh_reduction_on_levels(s))
        return s->second->abelian ? "Routh's reduction, on level sets of the momentum, by"
                                  : "reduction of the cotangent bundle, on level sets of the momentum, by";
    if (s->kind != NH_STAGE_POINCARE) return titles[s->kind];
    bool shape = s->shown->n > 0, constrained = s->shown_slice->f > 0;
    if (shape) return constrained ? "Lagrange-d'Alembert-Poincare equations of" : "Lagrange-Poincare equations of";
    return constrained ? "Euler-d'Alembert-Poincare equations of" : "Euler-Poincare equations of";
}

/* zeta_1 = zeta1 */
static bool names_itself(const nh_dag *d, const nh_reduction_equation *e)
{
    const char *bar = strchr(e->name, '_'),
               *name = nh_kind_of(d, e->value) == NH_SYMBOL ? nh_name_of(d, e->value) : NULL;
    size_t length = bar ? (size_t)(bar - e->name) : 0;
    return bar && name && !strncmp(name, e->name, length) && !strcmp(name + length, bar + 1);
}

size_t nh_reduction_shown(const nh_reduction *r, const nh_reduction_stage *s, const char ***label, nh_ex **value)
{
    nh_reduction_equation *e;
    size_t n = nh_reduction_equations(r, s, &e), shown = 0;
    *label = nh_arena_alloc(r->kinetic->arena, (n + 1) * sizeof **label);
    *value = nh_arena_alloc(r->kinetic->arena, (n + 1) * sizeof **value);
    for (size_t i = 0; i < n; i++)
        if (!names_itself(r->kinetic->dag, &e[i])) (*label)[shown] = e[i].name, (*value)[shown++] = e[i].value;
    return shown;
}

const char *nh_reduction_letters(const nh_reduction *r, const nh_reduction_stage *s)
{
    bool shape = s->shown->n > 0;
    nh_arena *arena = r->kinetic->arena;
    const char *p = shape ? "$p_{i}$: momenta of the shape; " : "";
    static const char group[] = "velocity of the group along its field $e_{a}$, in the body frame";
    switch (s->kind) {
    case NH_STAGE_CHAPLYGIN:
        return nh_arena_printf(arena, s->shown->d ? "%s$zeta_{a}$: %s" : "%s",
                               s->shown->d ? p : "$p_{i}$: momenta of the shape", group);
    case NH_STAGE_SECOND:
        return nh_arena_printf(arena,
                               "%s$m_{a}$: momentum of the group, in the body frame, and $v_{a}$ (%s, .. in text and "
                               "code), the velocity %s; $eta_{a}$: %s",
                               p, nh_name_of(r->kinetic->dag, s->shown->w[s->shown->n]),
                               shape ? "$eta_{a} + \\breve{A} <x'>$ that belongs to it by the mechanical connection"
                                     : "that belongs to it",
                               group);
    case NH_STAGE_QUOTIENT: return nh_arena_printf(arena, "$zeta_{a}$: %s", group);
    default:
        return nh_arena_printf(
            arena,
            "%s$zeta_{a}$ (zeta1, .. in text and code where it is one of the independent velocities): %s; "
            "$mu_{a}$: its momentum",
            p, group);
    }
}

const char *nh_reduction_stage_holds(const nh_reduction *r, const nh_reduction_stage *s)
{
    nh_proof all = {.proved = true, .all_parameters = true};
    for (size_t a = 0; a < s->action->d; a++)
        all = nh_proof_both(r->kinetic->model, all, nh_generator_proof(r->kinetic, &s->action->generator[a]));
    if (all.all_parameters || !r->system->parameters) return "";
    return all.proved ? nh_facts_holds(r->kinetic->model, &all, false) : " to rounding";
}

const char *nh_reduction_no_energy(const nh_reduction *r, const nh_reduction_stage *s)
{
    const nh_kinetic *k = r->kinetic;
    if (s->energy_drift >= 0) return NULL;
    if (s->reduced->conservative) return "the reduced motion could not be computed";
    if (!k->autonomous) return "the equations depend on time";
    if (r->strict) return "with --weak everything except the kinetic energy is a force";
    return k->forced ? "forces act" : k->linear ? "it is not conserved" : "the constraints do work";
}

const char *nh_reduction_energy(const nh_reduction *r, const nh_reduction_stage *s)
{
    return r->kinetic->linear || s->kind == NH_STAGE_QUOTIENT ? "energy" : "the moving energy";
}

size_t nh_reduction_linear_stage(const nh_reduction *r)
{
    for (size_t i = 0; i < r->stages; i++)
        if (r->stage[i].linear.count) return i;
    return SIZE_MAX;
}

const char *nh_reduction_momentum_kind(const nh_momentum *p)
{
    if (p->moving) return "energy less the momentum of";
    if (p->of_lagrangian) return "symmetry of the Lagrangian in the distribution: momentum of";
    return p->horizontal ? "horizontal symmetry: momentum of"
           : p->gauge    ? "gauge momentum of"
                         : "not horizontal, but conserved: momentum of";
}

const char *nh_reduction_globally(const nh_reduction *r, const nh_group *g)
{
    const char *least = g->missing ? "at least " : "";
    if (!g->local) return "";
    if (!g->global || !g->global_name) return g->missing ? "" : "; globally: none";
    return nh_arena_printf(r->kinetic->arena, "; globally: %s%s, of dimension %zu", least, g->global_name, g->global);
}

static bool names(const nh_system *system, const char *name)
{
    bool taken = nh_system_coordinate(system, name) >= 0;
    for (size_t i = 0; i < system->parameters; i++) taken |= !strcmp(system->parameter[i].name, name);
    return taken;
}

const char *nh_reduction_momentum_name(const nh_reduction *r, const nh_momentum *p)
{
    const char *J = names(r->system, "J") ? "p_xi" : "J", *E = names(r->system, "E") ? "energy" : "E";
    return p->moving ? nh_arena_printf(r->kinetic->arena, "%s - %s", E, J) : J;
}
