/* reduction_remarks: what is said of a stage beside its equations. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "exact/normal.h"
#include "document/facts.h"
#include "document/formula.h"
#include "document/reduction.h"

static void say(const nh_reduction_pen *p, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void say(const nh_reduction_pen *p, const char *format, ...)
{
    char words[1200];
    va_list list;
    va_start(list, format);
    vsnprintf(words, sizeof words, format, list);
    va_end(list);
    p->words(p->to, words);
}

static void say_text(const nh_reduction_pen *p, nh_text *text)
{
    p->words(p->to, nh_text_string(text));
    nh_text_clear(text);
}

void nh_reduction_conditions(const nh_reduction_stage *s, const nh_reduction_pen *p)
{
    const nh_second *t = s->second;
    if (s->kind != NH_STAGE_SECOND) return;
    bool only_weak = t->strong > 1e-6 * (1 + t->weak) && t->strong > 1e-9;
    if (nh_reduction_on_levels(s)) say(p, "without constraints G = {e} and Upsilon = 0, so that the conditions (i) and (ii) of a second stage hold");
    else say(p, "condition (ii) of a second stage, that no force acts along its fields: weak form %.1e, strong form %.1e%s", t->weak, t->strong, only_weak ? " (the momentum is conserved nevertheless)" : "");
    if (t->magnetic) say(p, "the conserved momentum includes the part of the Lagrangian that is linear in the velocities");
    else if (t->abelian) say(p, "its momentum is constant: the stage is a level set divided by the whole group");
    else say(p, "the momentum moves on a coadjoint orbit of dimension %zu; isotropy algebra of dimension %zu", t->orbit, t->d - t->orbit);
}

static void put_ways(const nh_reduction *r, const nh_parameter_zeros *v, nh_text *out)
{
    for (size_t i = 0; i < v->ways; i++) {
        nh_text_add(out, i ? ", or " : "");
        for (size_t k = 0; k < v->way[i].count; k++) {
            char *text = nh_formula_text(r->kinetic->dag, v->way[i].polynomial[k], r->options.shown);
            nh_text_addf(out, "%s%s = 0", k ? " and " : "", text);
            nh_free(text);
        }
    }
    if (!v->ways) nh_text_add(out, "no parameters");
}

/* The conditions for a measure; those for a factor are more than one reads, and stand in the JSON. */
static void conditions(const nh_reduction *r, const nh_reduction_stage *s, const nh_reduction_pen *p)
{
    const nh_measure_conditions *c = &s->conditions;
    size_t count = 0;
    nh_text words;
    nh_text_init(&words);
    nh_text_add(&words, "an invariant measure exists for ");
    for (size_t i = 0; i < c->count; i++) {
        if (c->condition[i].factor) continue;
        nh_text_add(&words, count++ ? "; and besides " : c->condition[i].where.ways ? "parameters with " : "");
        put_ways(r, &c->condition[i].where, &words);
    }
    if (count) p->words(p->to, nh_text_string(&words));
    if (!c->known && r->system->parameters) say(p, "for which parameters one exists is not known: the conditions are too large");
    nh_text_clear(&words);
}

static void measure(const nh_reduction *r, const nh_reduction_stage *s, const nh_reduction_pen *p)
{
    const nh_chaplygin_measure *m = &s->measure;
    if (!m->tested) return;
    if (m->measure) say(p, "an invariant measure exists%s", m->size == 0 ? ": the Liouville measure" : m->local ? ", but only locally: its density is many-valued on an angle" : "");
    if (m->measure && m->closed) {
        p->formula(p->to, "density", m->density);
        if (!m->proof.all_parameters) say(p, "the density holds%s", m->proof.proved ? nh_facts_holds(r->kinetic->model, &m->proof, false) : " to rounding");
    }
    if (!m->measure) say(p, "no invariant measure with a density on the shape space (|d Theta| = %.2g)", m->curl);
    if (!m->measure) conditions(r, s, p);
    if (s->kind == NH_STAGE_SECOND && s->shown->n > 2) return; /* what the momentum adds to the form would have to be closed, too */
    if (m->factor && m->closed && s->shown->n == 2) say(p, "the density is a conformal factor that makes it Hamiltonian, in the time d tau = density dt");
    else if (m->factor && m->closed && s->shown->n > 2) say(p, "density^(1/%zu) is a conformal factor that makes it Hamiltonian", s->shown->n - 1);
    else if (m->factor) say(p, "a conformal factor makes it Hamiltonian%s", m->local ? ", only locally" : "");
    else say(p, "no conformal factor makes it Hamiltonian%s", m->simple ? "" : " (Ups is not phi-simple)");
}

static void linear(const nh_reduction *r, const nh_reduction_stage *s, const nh_reduction_pen *p)
{
    const nh_linear_momenta *l = &s->linear;
    nh_dag *d = r->kinetic->dag;
    if (!l->count) return;
    const char *x = nh_name_of(d, s->shown->x[0]);
    nh_text words;
    nh_text_init(&words);
    nh_text_addf(&words, "%zu current%s linear in the velocities: Y(%s)^-1 p with dY/d%s = N Y, p = (", l->count, l->count == 1 ? "" : "s", x, x);
    for (size_t a = 0; a < l->count; a++) nh_text_addf(&words, "%s%s", a ? ", " : "", s->shown->momentum[l->index[a]]);
    nh_text_add(&words, ")");
    if (s->linear_drift >= 0) nh_text_addf(&words, l->count == 1 ? "; it drifts by %.1e" : "; they drift by %.1e", s->linear_drift);
    say_text(p, &words);
    for (size_t a = 0; a < l->count * l->count; a++) {
        char name[64];
        snprintf(name, sizeof name, "N_%zu%zu", a / l->count + 1, a % l->count + 1);
        if (!nh_is_zero(d, l->N[a])) p->formula(p->to, name, l->N[a]);
    }
}

static void chain(const nh_reduction_stage *s, const nh_reduction_pen *p)
{
    const nh_ideals *c = s->chain;
    const nh_poincare *o = &s->poincare;
    nh_text words;
    if (!s->by_stages) return;
    nh_text_init(&words);
    nh_text_add(&words, "by stages along ");
    for (size_t j = 0; j < c->blocks; j++) {
        nh_text_add(&words, j ? " > {" : "{");
        for (size_t i = c->start[j]; i < c->d; i++) nh_text_addf(&words, "%s%zu", i > c->start[j] ? ", " : "", c->order[i] + 1);
        nh_text_add(&words, "}");
    }
    nh_text_addf(&words, " (numbers of the generators above); S of dimension %zu", o->dimension);
    say_text(p, &words);
    say(p, "vertical and horizontal equations against the true accelerations at %zu places: in one stage %.1e, by stages %.1e", o->places, fmax(o->one_vertical, o->one_horizontal),
        fmax(o->stages_vertical, o->stages_horizontal));
    say(p, "bracket by stages against the bracket %.1e, Euler-Poincare right-hand side %.1e", o->bracket, o->euler_poincare);
}

/* By which method, at which cost, and why. */
static void choice(const nh_reduction *r, const nh_reduction_stage *s, const nh_reduction_pen *p)
{
    const nh_reduction_choice *c = &s->choice;
    if (!c->method) return;
    say(p, "accuracy %.1e %s up to t = %.4g: %s", r->wanted, c->held ? "held" : "not reached", s->reached, c->why);
    nh_text words;
    nh_text_init(&words);
    nh_text_addf(&words, "  %ld evaluations, %.2g ms with reconstruction", c->evaluations, 1e3 * c->seconds);
    if (c->seconds > 0 && r->full.seconds > 0) nh_text_addf(&words, ": %.2g times the time of the full motion", c->seconds / r->full.seconds);
    if (s->seconds > 0 && r->full.seconds > 0) nh_text_addf(&words, ", %.2g times without it", s->seconds / r->full.seconds);
    say_text(p, &words);
}

static void numbers(const nh_reduction *r, const nh_reduction_stage *s, const nh_reduction_pen *p)
{
    const char *with = s->against_full ? "the full motion" : "the first stage";
    nh_text words;
    nh_text_init(&words);
    if (s->compared) nh_text_addf(&words, "after reconstruction: %.1e from %s up to t = %.4g", s->agreement, with, s->reached);
    if (s->compared && s->unsure > 0) nh_text_addf(&words, ", whose own error is %.1e", s->unsure);
    if (!s->compared) nh_text_addf(&words, "not compared with %s", with);
    const char *why = nh_reduction_no_energy(r, s), *energy = nh_reduction_energy(r, s);
    if (why) nh_text_addf(&words, "; %s not followed: %s", energy, why);
    else nh_text_addf(&words, "; %s drifts by %.1e", energy, s->energy_drift);
    if (s->kind == NH_STAGE_SECOND && s->momentum_drift >= 0) nh_text_addf(&words, why ? "; the momentum drifts by %.1e" : ", the momentum by %.1e", s->momentum_drift);
    say_text(p, &words);
    choice(r, s, p);
    if (s->charts) say(p, "the slice or the velocities change %zu time%s along the motion", s->charts, s->charts == 1 ? "" : "s");
    if (s->note[0]) say(p, "note: %s", s->note);
}

void nh_reduction_remarks(const nh_reduction *r, const nh_reduction_stage *s, const nh_reduction_pen *p)
{
    measure(r, s, p);
    linear(r, s, p);
    chain(s, p);
    numbers(r, s, p);
}
