#include "document/reduction_internal.h"

#include <math.h>
#include <string.h>

#include "document/facts.h"
#include "document/formula.h"
#include "document/screen.h"
#include "document/sheet.h"
#include "exact/normal.h"
#include "graph/node.h"
#include "graph/print.h"

/* "-y d/dx + x d/dy + d/dtheta" */
static void put_field(const nh_kinetic *k, const nh_ex *component, nh_text *out)
{
    bool any = false;
    for (size_t s = 0; s < k->m; s++) {
        if (nh_is_zero(k->dag, component[s])) continue;
        char *text = nh_print_string(k->dag, component[s]);
        bool minus = text[0] == '-' && !nh_formula_is_sum(text), sum = nh_formula_is_sum(text);
        const char *rest = minus ? text + 1 : text;
        nh_text_add(out, any ? (minus ? " - " : " + ") : minus ? "-" : "");
        if (strcmp(rest, "1")) nh_text_addf(out, sum ? "(%s) " : "%s ", rest);
        nh_text_addf(out, "d/d%s", k->name[s]);
        nh_free(text);
        any = true;
    }
}

static void put_fields(const nh_action *a, nh_text *out)
{
    for (size_t i = 0; i < a->d; i++) {
        nh_text_add(out, i ? ",  " : "");
        put_field(a->kinetic, a->generator[i].component, out);
    }
}

/* How sure the group is, in one sentence. */
static void put_certainty(const nh_reduction *r, const nh_group *g, nh_text *out)
{
    bool proved = true;
    for (size_t a = 0; a < g->action.d; a++)
        proved &= nh_generator_proof(r->kinetic, &g->action.generator[a]).all_parameters;
    if (proved) nh_text_add(out, g->action.d == 1 ? "It is proved" : "Each is proved");
    else nh_text_add(out, "Not each is proved for all parameters (--details)");
    if (g->given) nh_text_add(out, ".");
    else if (!g->jets)
        nh_text_addf(out, "; there may be more, because they could not be counted: %s.",
                     nh_reduction_not_counted(r->kinetic));
    else if (g->missing) nh_text_addf(out, "; a count shows %zu more, for which no closed form was found.", g->missing);
    else
        nh_text_addf(out, "%s a count shows that there are no others%s.", proved ? ", and" : ";",
                     g->jets->exact ? "" : ", by numbers");
}

/* "8 coordinates become 4, then 3; or 2 in one step." */
static void put_sizes(const nh_reduction *r, nh_text *out)
{
    size_t f = r->kinetic->f;
    nh_text_addf(out, "%zu coordinate%s", r->kinetic->m, r->kinetic->m == 1 ? "" : "s");
    if (f) nh_text_addf(out, " with %zu constraint%s", f, f == 1 ? "" : "s");
    for (size_t k = 0; k < r->stages; k++) {
        size_t i = nh_reduction_order(r, k);
        const nh_reduction_stage *s = &r->stage[i];
        bool other = nh_reduction_instead(r, i), first = i > 0 && k == 0;
        nh_text_addf(out, "%s %zu%s",
                     !k                            ? " become"
                     : other || (i == 0 && k == 1) ? "; or"
                                                   : ", then",
                     s->shown->n,
                     !other                                  ? ""
                     : first || s->kind == NH_STAGE_POINCARE ? " in one step"
                                                             : " in another way");
    }
    nh_text_add(out, ". ");
}

static void group(const nh_reduction *r, bool colour, nh_text *out)
{
    const nh_group *g = r->all ? r->all : r->group;
    size_t dimension = g->action.d + g->missing;
    nh_text words;
    nh_text_init(&words);
    put_sizes(r, &words);
    if (!dimension) {
        nh_text_add(&words, "No symmetry of kinetic energy, potential and constraints together was found. ");
        if (!g->jets) nh_text_addf(&words, "They could not be counted: %s.", nh_reduction_not_counted(r->kinetic));
        nh_screen_begin(out, colour, r->system, NULL, &words);
        return;
    }
    nh_text_addf(&words, "The %s %s%s, of dimension %zu%s.", g->given ? "given group is" : "symmetries form the group",
                 g->name, g->local && !g->given ? " (locally)" : "", dimension, nh_reduction_globally(r, g));
    nh_screen_begin(out, colour, r->system, NULL, &words);
    if (g->action.d) {
        nh_text_init(&words);
        put_fields(&g->action, &words);
        nh_screen_paragraph(2, NH_SCREEN_HANG, nh_text_string(&words), out);
        nh_text_clear(&words);
    }
    nh_text_init(&words);
    put_certainty(r, g, &words);
    nh_screen_say(out, 0, &words);
}

/* "stage 1   Chaplygin reduction by SE(2)" and what is left */
static void stages(const nh_reduction *r, nh_text *out)
{
    nh_text_add(out, "\n");
    for (size_t k = 0; k < r->stages; k++) {
        size_t i = nh_reduction_order(r, k);
        const nh_reduction_stage *s = nh_reduction_named(&r->stage[i]);
        nh_text words;
        nh_text_init(&words);
        nh_text_addf(&words, "%s: divide by %s. Left: ", nh_reduction_stage_title(r, i), s->group);
        for (size_t j = 0; j < s->shown->n; j++)
            nh_text_addf(&words, "%s%s", j ? ", " : "", nh_name_of(r->kinetic->dag, s->shown->x[j]));
        nh_text_add(&words, s->shown->n ? "." : "a point: only the velocities of the group move.");
        nh_screen_paragraph(0, NH_SCREEN_HANG, nh_text_string(&words), out);
        nh_text_clear(&words);
    }
    if (!r->stages) nh_text_add(out, "No reduction was possible.\n");
}

static void momenta(const nh_reduction *r, bool colour, nh_text *out)
{
    enum { most_lines = 4 };
    if (!r->momenta.count) return;
    nh_text_add(out, "\nConserved\n");
    for (size_t i = 0; i < r->momenta.count; i++) {
        const nh_momentum *m = &r->momenta.momentum[i];
        nh_text words;
        nh_text_init(&words);
        char *value = nh_print_short(r->kinetic->dag, m->value, 80 * NH_SCREEN_LINES);
        nh_screen_put(out, colour, 2, nh_arena_printf(r->arena, "%s = ", nh_reduction_momentum_name(r, m)), value,
                      most_lines, NULL);
        nh_free(value);
        nh_text_add(&words, m->moving ? "energy less the momentum of " : "momentum of ");
        put_field(r->kinetic, m->field, &words);
        if (m->of_lagrangian) nh_text_add(&words, ", a symmetry of the Lagrangian that the constraints allow");
        nh_text_addf(&words, "; %s%s%s.", m->proof.proved ? "proved" : "to rounding",
                     m->proof.all_parameters ? "" : nh_facts_holds(r->kinetic->model, &m->proof, false),
                     m->local ? "; not the same after a full turn of an angle" : "");
        nh_screen_say(out, NH_SCREEN_HANG, &words);
    }
}

/* What the constraints alone keep constant. */
static void constant(const nh_reduction *r, bool colour, nh_text *out)
{
    enum { most_lines = 4 };
    size_t integrals = nh_reduction_leaves(r);
    nh_text words;
    if (!integrals) return;
    nh_text_add(out, r->momenta.count ? "" : "\nConserved\n");
    for (size_t i = 0; i < r->leaf_count; i++) {
        char *value = nh_print_short(r->kinetic->dag, r->leaf[i], 80 * NH_SCREEN_LINES);
        nh_screen_put(out, colour, 2, "", value, most_lines, NULL);
        nh_free(value);
    }
    nh_text_init(&words);
    nh_reduction_growth_words(r, &words);
    nh_screen_say(out, r->leaf_count ? NH_SCREEN_HANG : 2, &words);
}

/* How the printed equations and the reduced motions compare with the full ones: the worst of all stages. */
static void check(const nh_reduction *r, nh_text *out)
{
    double printed = -1, apart = -1, energy = -1, reached = INFINITY;
    for (size_t i = 0; i < r->stages; i++) {
        const nh_reduction_stage *s = &r->stage[i];
        if (s->printed_states) printed = fmax(printed, s->printed);
        if (!s->compared) continue;
        apart = fmax(apart, s->agreement);
        reached = fmin(reached, s->reached);
        energy = fmax(energy, s->energy_drift);
    }
    nh_text words;
    nh_text_init(&words);
    if (printed >= 0)
        nh_text_addf(&words, "The equations as printed agree with the true accelerations to %.2g. ", printed);
    if (apart >= 0)
        nh_text_addf(&words,
                     "Put together again, the reduced motions differ from the full one by %.2g up to t = %.4g. ", apart,
                     reached);
    if (energy >= 0) nh_text_addf(&words, "The energy changes by %.2g.", energy);
    if (words.length) nh_text_add(out, "\n");
    nh_screen_say(out, 0, &words);
}

void nh_reduction_write_answer(const nh_reduction *r, bool colour, nh_text *out)
{
    group(r, colour, out);
    stages(r, out);
    momenta(r, colour, out);
    constant(r, colour, out);
    check(r, out);
    for (size_t i = 0; i < r->warnings; i++)
        nh_screen_paragraph(0, 2, nh_arena_printf(r->arena, "Warning: %s", r->warning[i]), out);
    for (size_t i = 0; i < r->unused_count; i++)
        nh_screen_paragraph(0, 2, nh_arena_printf(r->arena, "Not used: %s (--details says why).", r->unused[i].what),
                            out);
    nh_screen_more(out, "the reduced equations, brackets, conditions, measures",
                   "--to c      the reduced equations as code (python, sympy, matlab, latex)");
}
