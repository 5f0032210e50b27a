/* reduction_remarks: the remarks on a stage besides its equations. */
#include <math.h>

#include "base/memory.h"
#include "exact/normal.h"
#include "document/facts.h"
#include "document/formula.h"
#include "document/reduction_internal.h"
#include "graph/node.h"
#include "graph/print.h"

void nh_reduction_conditions(const nh_reduction_stage *s, nh_pen *p)
{
    const nh_second *t = s->second;
    if (s->kind != NH_STAGE_SECOND) return;
    bool only_weak = t->strong > 1e-6 * (1 + t->weak) && t->strong > 1e-9;
    if (nh_reduction_on_levels(s))
        nh_pen_fact(p, "Conditions",
                    "(i) and (ii) of a second stage (Chhabra and Emami 2014) hold without constraints: G = {e} and "
                    "$Upsilon$ = 0");
    else
        nh_pen_fact(p, "Condition (ii)",
                    "of a second stage (Chhabra and Emami 2014), that no force acts along its fields: off by %.2g in "
                    "the weak form, %.2g in the strong one%s",
                    t->weak, t->strong, only_weak ? " (the momentum is conserved nevertheless)" : "");
    if (t->magnetic)
        nh_pen_fact(p, "Momentum", "constant, including the part of the Lagrangian that is linear in the velocities");
    else if (t->abelian) nh_pen_fact(p, "Momentum", "constant: the stage is a level set divided by the whole group");
    else
        nh_pen_fact(p, "Momentum", "moves on a coadjoint orbit of dimension %zu; isotropy algebra of dimension %zu",
                    t->orbit, t->d - t->orbit);
}

/* ---- what the constraints integrate to ---- */

size_t nh_reduction_leaves(const nh_reduction *r)
{
    const nh_growth *g = &r->growth;
    return g->length && !g->cut ? g->dimension - g->rank[g->length - 1] : 0;
}

void nh_reduction_growth_words(const nh_reduction *r, nh_text *out)
{
    const nh_growth *g = &r->growth;
    size_t n = nh_reduction_leaves(r), named = r->leaf_count;
    if (named)
        nh_text_add(out,
                    named == 1 ? "constant by the constraints alone: " : "constant by the constraints alone, each: ");
    nh_text_add(out, named ? "the growth vector of the distribution is " : "The growth vector of the distribution is ");
    for (size_t i = 0; i < g->length; i++) nh_text_addf(out, "%s%zu", i ? "," : "", g->rank[i]);
    nh_text_addf(out, " of %zu, ", g->dimension);
    if (g->cut) nh_text_add(out, "as far as it was computed");
    else nh_text_add(out, n ? "so it is not bracket generating" : "so it is bracket generating");
    if (!n || g->cut) nh_text_add(out, ".");
    else if (named >= n) nh_text_add(out, g->proved ? " (proved)." : " (by numbers).");
    else
        nh_text_addf(out, "%s; %zu%s function%s of the positions %s constant, and analyze looks for %s.",
                     g->proved ? " (proved)" : " (by numbers)", n - named, named ? " more" : "",
                     n - named == 1 ? "" : "s", n - named == 1 ? "is" : "are", n - named == 1 ? "it" : "them");
}

void nh_reduction_growth_json(const nh_reduction *r, nh_json *root)
{
    const nh_growth *g = &r->growth;
    if (!g->length) {
        nh_json_put_null(root, "distribution");
        return;
    }
    nh_json *to = nh_json_put_object(root, "distribution"), *ranks = nh_json_put_array(to, "growth_vector"),
            *list = nh_json_put_array(to, "constant");
    for (size_t i = 0; i < g->length; i++) nh_json_add_number(ranks, (double)g->rank[i]);
    nh_json_put_number(to, "integrals", (double)(g->dimension - g->rank[g->length - 1]));
    nh_json_put_bool(to, "proved", g->proved);
    for (size_t i = 0; i < r->leaf_count; i++) {
        char *text = nh_print_string(r->kinetic->dag, r->leaf[i]);
        nh_json_add_text(list, text);
        nh_free(text);
    }
}

/* ---- the measure ---- */

/* First what positive parameters can satisfy, then the rest. */
static void put_ways(const nh_reduction *r, const nh_parameter_zeros *v, nh_pen *p)
{
    nh_dag *d = r->kinetic->dag;
    size_t said = 0, before = 0;
    for (int positive = 1; positive >= 0; positive--, before = said)
        for (size_t i = 0; i < v->ways; i++) {
            if (nh_parameter_zeros_may_be_positive(d, &(nh_parameter_zeros){1, &v->way[i]}) != positive) continue;
            nh_pen_say(p, "%s", !said ? "" : said == before ? "; and, not for positive values, with " : ", or ");
            for (size_t k = 0; k < v->way[i].count; k++) {
                char *text = nh_formula_text(d, v->way[i].polynomial[k], r->options.shown);
                nh_pen_say(p, "%s<%s> = 0", k ? " and " : "", text);
                nh_free(text);
            }
            said++;
        }
    if (!v->ways) nh_pen_say(p, "no parameters");
}

/* The conditions for a measure; those for a factor are too long to be read, and only in the JSON. */
static void conditions(const nh_reduction *r, const nh_reduction_stage *s, nh_pen *p)
{
    const nh_measure_conditions *c = &s->conditions;
    size_t count = 0;
    if (c->never) nh_pen_say(p, "; none exists for positive values of the parameters (proved)");
    for (size_t i = 0; i < c->count && !c->never; i++) {
        if (c->condition[i].factor) continue;
        if (!count)
            nh_pen_say(p, "; an invariant measure exists for %s", c->condition[i].where.ways ? "parameters with " : "");
        else nh_pen_say(p, "; and also ");
        put_ways(r, &c->condition[i].where, p);
        count++;
    }
    if (!c->known && r->system->parameters)
        nh_pen_say(p, "; %sit is not known for which parameters one exists: the conditions are too large",
                   c->rare ? "for almost all parameters none exists (proved); " : "");
}

/* A parameter of the conditions, otherwise any. */
static const char *one_parameter(const nh_reduction *r, const nh_measure_conditions *c)
{
    nh_dag *d = r->kinetic->dag;
    const nh_parameter *all = r->system->parameter;
    for (size_t i = 0; i < c->count; i++)
        for (size_t w = 0; w < c->condition[i].where.ways; w++)
            for (size_t j = 0; j < r->system->parameters; j++)
                if (nh_depends(d, c->condition[i].where.way[w].polynomial[0], all[j].symbol)) return all[j].name;
    return all[0].name;
}

/* For a question that is not decided for all parameters: classify answers it for the values of one parameter. */
static void pointer(const nh_reduction *r, const nh_reduction_stage *s, nh_pen *p)
{
    const nh_chaplygin_measure *m = &s->measure;
    const nh_measure_conditions *c = &s->conditions;
    bool measure = !m->measure && !c->never, factor = !m->factor && s->shown->n > 2 && !c->never_hamiltonian;
    if (!r->system->parameters || !(measure || factor) || s->kind == NH_STAGE_SECOND) return;
    nh_pen_say(p, "; the values of one parameter with %s: classify --over %s --of %s",
               measure ? "a measure" : "such a factor", one_parameter(r, c), measure ? "measure" : "hamiltonization");
}

static void factor(const nh_reduction_stage *s, nh_pen *p)
{
    const nh_chaplygin_measure *m = &s->measure;
    size_t n = s->shown->n;
    if (s->kind == NH_STAGE_SECOND && n > 2)
        return; /* the term that the momentum adds to the form would have to be closed, too */
    if (m->factor && m->closed && n == 2)
        nh_pen_say(
            p,
            "; the density is a conformal factor that makes it Hamiltonian, in the time $\\d tau$ = density $\\d <t>$");
    else if (m->factor && m->closed && n > 2)
        nh_pen_say(p, "; density^(1/%zu) is a conformal factor that makes it Hamiltonian", n - 1);
    else if (m->factor) nh_pen_say(p, "; a conformal factor makes it Hamiltonian%s", m->local ? ", only locally" : "");
    else
        nh_pen_say(p, m->simple ? "; no conformal factor makes it Hamiltonian"
                                : "; no conformal factor makes it Hamiltonian ($Upsilon$ is not $phi$-simple)");
    if (!m->factor && n > 2 && s->conditions.never_hamiltonian)
        nh_pen_say(p, ", whatever positive values the parameters have (proved)");
}

static void measure(const nh_reduction *r, const nh_reduction_stage *s, nh_pen *p)
{
    const nh_chaplygin_measure *m = &s->measure;
    if (!m->tested) return;
    nh_pen_fact_begin(p, "Measure");
    if (m->measure)
        nh_pen_say(p, "an invariant measure exists%s",
                   m->size == 0 ? ": the Liouville measure"
                   : m->local   ? ", but only locally: its density is many-valued on an angle"
                                : "");
    else nh_pen_say(p, "no invariant measure with a density on the shape space (|$\\d Theta$| = %.2g)", m->curl);
    if (!m->exact) nh_pen_say(p, " (by numbers)");
    if (m->measure && m->closed && !m->proof.all_parameters)
        nh_pen_say(p, "; the density holds%s",
                   m->proof.proved ? nh_facts_holds(r->kinetic->model, &m->proof, false) : " to rounding");
    if (!m->measure) conditions(r, s, p);
    factor(s, p);
    pointer(r, s, p);
    nh_pen_close(p, NH_PEN_FACT);
}

/* ---- currents, chain ---- */

static void linear(const nh_reduction *r, const nh_reduction_stage *s, nh_pen *p)
{
    const nh_linear_momenta *l = &s->linear;
    if (!l->count) return;
    const char *x = nh_name_of(r->kinetic->dag, s->shown->x[0]);
    nh_pen_fact_begin(p, l->count == 1 ? "Current" : "Currents");
    nh_pen_say(p, "%zu linear in the velocities: $Y^{-1}$ p with $\\d Y$/$\\d$", l->count);
    nh_pen_name(p, x);
    nh_pen_say(p, " = $N Y$, p = (");
    for (size_t a = 0; a < l->count; a++) nh_pen_say(p, a ? ", " : ""), nh_pen_name(p, s->shown->momentum[l->index[a]]);
    nh_pen_say(p, ")");
    if (s->linear_drift >= 0)
        nh_pen_say(p, l->count == 1 ? "; it drifts by %.2g" : "; they drift by %.2g", s->linear_drift);
    nh_pen_close(p, NH_PEN_FACT);
}

static void chain(const nh_reduction_stage *s, nh_pen *p)
{
    const nh_ideals *c = s->chain;
    const nh_poincare *o = &s->poincare;
    if (!s->by_stages) return;
    nh_pen_fact_begin(p, "By stages");
    nh_pen_say(p, "along ");
    for (size_t j = 0; j < c->blocks; j++) {
        nh_pen_say(p, j ? " $\\supset$ {" : "{");
        for (size_t i = c->start[j]; i < c->d; i++)
            nh_pen_say(p, "%s%zu", i > c->start[j] ? ", " : "", c->order[i] + 1);
        nh_pen_say(p, "}");
    }
    nh_pen_say(p,
               " (numbers of the generators above); S of dimension %zu. Checked at %zu places: the vertical and "
               "horizontal equations differ from the true accelerations by %.2g in one stage and by %.2g by stages; "
               "the bracket by stages differs from the bracket by %.2g, the Euler-Poincare right-hand side by %.2g",
               o->dimension, o->places, fmax(o->one_vertical, o->one_horizontal),
               fmax(o->stages_vertical, o->stages_horizontal), o->bracket, o->euler_poincare);
    nh_pen_close(p, NH_PEN_FACT);
}

/* ---- the motions ---- */

/* The method of the motion, its cost, and the reason for the choice. */
static void choice(const nh_reduction *r, const nh_reduction_stage *s, nh_pen *p)
{
    const nh_reduction_choice *c = &s->choice;
    if (!c->method) return;
    nh_pen_fact_begin(p, c->held ? "Method" : "Not accurate");
    nh_pen_say(p, "accuracy %.2g %s up to t = %.4g: %s; %ld evaluations, %.2g ms with reconstruction", r->wanted,
               c->held ? "held" : "not reached", s->reached, c->why, c->evaluations, 1e3 * c->seconds);
    if (c->seconds > 0 && r->full.seconds > 0)
        nh_pen_say(p, ": %.2g times the time of the full motion", c->seconds / r->full.seconds);
    if (s->seconds > 0 && r->full.seconds > 0) nh_pen_say(p, ", %.2g times without it", s->seconds / r->full.seconds);
    nh_pen_close(p, NH_PEN_FACT);
}

static void numbers(const nh_reduction *r, const nh_reduction_stage *s, nh_pen *p)
{
    const char *with = s->against_full ? "the full motion" : "the first stage";
    const char *why = nh_reduction_no_energy(r, s), *energy = nh_reduction_energy(r, s);
    nh_pen_fact_begin(p, "Check");
    if (s->printed_states)
        nh_pen_say(p, "as printed: %.2g from %s at %zu states; ", s->printed,
                   s->kind == NH_STAGE_SECOND ? "the first stage" : "the true accelerations", s->printed_states);
    if (s->compared) nh_pen_say(p, "after reconstruction: %.2g from %s up to t = %.4g", s->agreement, with, s->reached);
    else nh_pen_say(p, "not compared with %s", with);
    if (s->compared && s->unsure > 0) nh_pen_say(p, ", whose own error is %.2g", s->unsure);
    if (why) nh_pen_say(p, "; %s not followed: %s", energy, why);
    else nh_pen_say(p, "; %s drifts by %.2g", energy, s->energy_drift);
    if (s->kind == NH_STAGE_SECOND && s->momentum_drift >= 0)
        nh_pen_say(p, why ? "; the momentum drifts by %.2g" : ", the momentum by %.2g", s->momentum_drift);
    if (s->charts == 1) nh_pen_say(p, "; the slice or the velocities change once along the motion");
    else if (s->charts) nh_pen_say(p, "; the slice or the velocities change %zu times along the motion", s->charts);
    nh_pen_close(p, NH_PEN_FACT);
}

void nh_reduction_remarks(const nh_reduction *r, const nh_reduction_stage *s, nh_pen *p)
{
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    measure(r, s, p);
    linear(r, s, p);
    chain(s, p);
    numbers(r, s, p);
    choice(r, s, p);
    nh_pen_close(p, NH_PEN_FACTS);
    nh_pen_sheet(p, nh_reduction_remarks_sheet(r, s));
    if (s->note[0]) nh_pen_warning(p, s->note);
}
