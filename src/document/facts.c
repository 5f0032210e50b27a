#include "document/facts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "graph/node.h"
#include "graph/print.h"
#include "integrals/fixed.h"
#include "integrals/real_where.h"
#include "document/formula.h"

bool nh_facts_number(double value, int digits, nh_shown_number *out)
{
    if (!isfinite(value)) return false;
    nh_text_number(value, out->all, sizeof out->all);
    char shown[60];
    snprintf(shown, sizeof shown, "%.*g", digits, value);
    char *exponent = strchr(shown, 'e');
    out->minus = shown[0] == '-';
    out->has_power = exponent != NULL;
    out->power = exponent ? atoi(exponent + 1) : 0;
    if (exponent) *exponent = 0;
    snprintf(out->mantissa, sizeof out->mantissa, "%s", shown + out->minus);
    if (out->has_power && !strcmp(out->mantissa, "1")) out->mantissa[0] = 0;
    return true;
}

const char *nh_facts_list(const char *text, char *words, size_t size)
{
    const char *list = strstr(text, " ("), *end = strrchr(text, ')');
    if (!list || !end || end[1]) return NULL;
    snprintf(words, size, "%.*s", (int)(list + 1 - text), text);
    return list + 2;
}

bool nh_facts_next(const char **list, char *name, size_t size)
{
    size_t length = strcspn(*list, ",)");
    if (!length) return false;
    snprintf(name, size, "%.*s", (int)length, *list);
    *list += length;
    *list += strspn(*list, ", ");
    return true;
}

static void ranks(nh_text *out, const char *before, size_t n, const size_t *rank)
{
    for (size_t i = 0; i < n; i++) nh_text_addf(out, "%s%zu", i ? "," : before, rank[i]);
}

void nh_facts_constraint(const nh_analysis *result, nh_text *out)
{
    nh_model *model = result->question->model;
    static const char *const spaces[] = {"growth vector ", "growth vector with time ",
                                         "growth vector on the submanifold "};
    const nh_distribution *d = &result->question->constraint;
    const nh_growth *g = &d->growth;
    nh_text_addf(out, "%s%s constraint%s%s (%s", d->type == NH_NONLINEAR && d->homogeneous ? "homogeneous " : "",
                 nh_constraint_type_name(d->type), model->k == 1 ? "" : "s", d->rheonomic ? ", time-dependent" : "",
                 nh_constraint_integrability(model, d));
    if (g->length > 1) {
        nh_text_add(out, "; ");
        ranks(out, spaces[g->space], g->length, g->rank);
        if (g->cut) nh_text_add(out, ",...");
    }
    if (g->drops) {
        if (g->where) nh_text_addf(out, ", at %s = 0 ", nh_name_of(model->dag, g->where));
        ranks(out, g->where ? "" : ", at the origin ", g->length_there, g->rank_there);
    }
    nh_text_addf(out, ")%s", g->proved ? "" : g->by_numbers ? " (by numbers)" : " (modulo primes)");
}

/* The signs of one form of report. */
typedef struct {
    const char *the_case, *Z, *bracket, *combination; /* the first one may begin a sentence */
} signs;

static const signs signs_of[] = {
    [NH_FACTS_TEXT] = {"the case", "Z", "[Gamma,Z]", "[Gamma,Z] = a Gamma + b Z"},
    [NH_FACTS_PAGE] = {"the case", "$Z$", "$[Gamma,Z]$", "$[Gamma,Z]=a Gamma+b Z$"},
    [NH_FACTS_TEX] = {"The case", "$Z$", "$[\\Gamma, Z]$", "$[\\Gamma, Z] = a \\Gamma + b Z$"},
};

void nh_facts_symmetry(const nh_symmetry *z, nh_facts_form form, const char *between, nh_text *out)
{
    const signs *s = &signs_of[form];
    switch (z->kase) {
    case 1: nh_text_addf(out, "%s is a symmetry of the equations of motion (case 1)", s->Z); break;
    case 2: nh_text_addf(out, "%s (case 2)", s->combination); break;
    case 3:
        nh_text_addf(out, "%s is not a symmetry of the equations of motion, nor is %s (case 3)", s->Z, s->combination);
        break;
    default: nh_text_addf(out, "%s (1, 2 or 3) could not be decided", s->the_case);
    }
    nh_text_addf(out, "%s%s %s the canonical distribution", between, s->bracket,
                 z->bracket_in_distribution ? "lies in" : "leaves");
    if (z->projectable) nh_text_addf(out, "; %s is projectable", s->Z);
}

const char *nh_facts_equations(const nh_model *model)
{
    return model->k ? "Equations of motion on the constraint submanifold" : "Equations of motion";
}

const char *nh_facts_drift(const nh_drift *d)
{
    double tight = d->drift[NH_DRIFT_RUNS - 1];
    if (tight == 0) return "it does not change at all";
    if (!d->falls) return "it does not fall with the tolerance";
    bool less = tight < d->drift[0] / 5; /* as in nh_drift_judge: a smaller decrease is rounding */
    return less ? "it falls with the tolerance" : "it is of the size of rounding error at every tolerance";
}

/* Only where some parameters are fixed and some are not is there something to say. */
static bool some_fixed(const nh_model *model, const nh_proof *p)
{
    return p->proved && p->fixed && !nh_fixed_all(model, p->fixed);
}

const char *nh_facts_holds(const nh_model *model, const nh_proof *p, bool names)
{
    enum { most_named = 6 };
    const nh_system *system = model->system;
    if (!system->parameters) return "";
    if (some_fixed(model, p)) return nh_arena_printf(model->arena, " for %s", nh_fixed_text(model, p->fixed));
    if (!p->all_parameters) return " for these parameter values only";
    if (!names || system->parameters > most_named) return " for all parameter values";
    nh_text text;
    nh_text_init(&text);
    for (size_t i = 0; i < system->parameters; i++)
        nh_text_addf(&text, "%s%s", i ? ", " : " for all ", system->parameter[i].name);
    const char *out = nh_arena_strdup(model->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

static const char *all_or_these(const nh_model *model, const nh_proof *p)
{
    return p->all_parameters || !model->system->parameters ? "all parameters" : "these values";
}

/* A value, or its formula in terms of parameters. */
static void put_fixed_one(nh_json *object, const nh_model *model, size_t i, nh_ex e)
{
    const char *name = model->system->parameter[i].name;
    if (nh_kind_of(model->dag, e) == NH_NUMBER) {
        nh_json_put_number(object, name, model->parameter_value[i]);
        return;
    }
    char *text = nh_print_string(model->dag, e);
    nh_json_put_text(object, name, text);
    nh_free(text);
}

static void put_fixed(nh_json *object, const nh_model *model, const nh_ex *fixed)
{
    for (size_t i = 0; i < model->system->parameters; i++)
        if (nh_fixed_has(model, fixed, i)) put_fixed_one(object, model, i, fixed[i]);
}

void nh_facts_put_holds(nh_json *item, const nh_model *model, const nh_proof *p)
{
    if (some_fixed(model, p)) put_fixed(nh_json_put_object(item, "holds"), model, p->fixed);
    else nh_json_put_text(item, "holds", all_or_these(model, p));
}

void nh_facts_add_holds(nh_json *list, const nh_model *model, const nh_proof *p)
{
    if (some_fixed(model, p)) put_fixed(nh_json_add_object(list), model, p->fixed);
    else nh_json_add_text(list, all_or_these(model, p));
}

/* ---- branches ---- */

void nh_facts_branch(const nh_analysis *result, nh_text *out)
{
    if (!result->branch) return;
    nh_text_addf(out, "computed on the branch %s; ", result->branch);
    if (result->equations_on_both) nh_text_addf(out, "the equations hold on the branch %s too", result->other_branch);
    else nh_text_add(out, "the equations hold on this branch only");
}

const char *nh_facts_which_branch(const nh_analysis *result, const nh_current *f)
{
    return !result->question->model->chart->branch ? ""
           : f->on_both                            ? ", on both branches"
                        : nh_arena_printf(result->arena, ", on the branch %s only", result->branch);
}

/* ---- the answer ---- */

const char *nh_facts_between_walls(const nh_analysis *result)
{
    const nh_current_list *list = result->list;
    const char *where = NULL;
    size_t n = nh_analysis_to_the_end(result);
    for (size_t k = 0; k < list->pieces; k++)
        if (list->piece[k].to_the_end && (!where || strcmp(where, list->piece[k].region) == 0))
            where = list->piece[k].region;
        else if (list->piece[k].to_the_end) where = "each in its region, where motions end";
    return nh_arena_printf(result->arena, "%zu independent current%s of at most %zu, %s", n, n == 1 ? "" : "s",
                           result->question->local_maximum, where);
}

bool nh_facts_given(const nh_analysis *result)
{
    return result->question->analysis && result->question->analysis->families > 0;
}

const char *nh_facts_search(const nh_analysis *result)
{
    size_t left_out = nh_analysis_left_out(result);
    bool counted = false; /* the count says what other integrals there can be */
    for (size_t i = 0; i < NH_COMPLETENESS_KINDS; i++)
        counted |= result->completeness[i].counted && !result->completeness[i].count.obstacle;
    if (result->search == NH_SEARCH_COMPLETE)
        return "The search is complete. There cannot be more currents: together they determine every orbit locally.";
    if (result->search == NH_SEARCH_CUT)
        return "A limit ended the search before the last stage: more currents may exist.";
    if (left_out)
        return nh_arena_printf(result->arena,
                               "The search is exhausted: it tried every stage except %zu that %s too large; the list "
                               "of stages names the option that allows %s.",
                               left_out, left_out == 1 ? "is" : "are", left_out == 1 ? "it" : "them");
    if (nh_analysis_by_trial(result))
        return nh_arena_printf(result->arena,
                               "The values of the unknowns were sought by trial: %ld of them, in %zu of %.0f equal "
                               "parts of their box. This proves nothing about other values.",
                               result->hits->evaluations, result->hits->visited,
                               pow((double)result->hits->parts, (double)result->hits->unknowns));
    if (nh_facts_given(result) && !result->stages)
        return "The search is exhausted: it tried the ansatz of the analysis file, and nothing else. With "
               "--no-analysis "
               "the program chooses what it tries.";
    return counted ? "The search is exhausted: it tried every stage."
                   : "The search is exhausted: it tried every stage. Other currents may exist.";
}

void nh_facts_completeness(const nh_analysis *result, nh_text *out)
{
    const nh_current_list *list = result->list;
    const nh_completeness *first = &result->completeness[result->completeness[0].counted ? 0 : 1];
    bool all = result->search == NH_SEARCH_COMPLETE && list->independent >= result->question->local_maximum;
    size_t uncertain = 0;
    if (all && first->counted && first->count.obstacle) return; /* there are no more integrals that could be counted */
    for (size_t k = 0; k < list->count; k++)
        uncertain +=
            list->found[k].independence == NH_INDEPENDENT && (!list->found[k].proof.proved || list->found[k].series);
    nh_completeness_words(result->completeness, uncertain, out);
}

bool nh_facts_head(const char *head, double *value)
{
    char *rest;
    if (*head != '#') return false;
    *value = strtod(head + 1, &rest);
    return rest > head + 1 && !*rest;
}

/* " with w^2 - W^2 != 0", ", real where k > 0" */
static void put_where(const nh_analysis *r, const nh_current *f, nh_text *out)
{
    nh_model *model = r->question->model;
    nh_ex found[NH_MOST_REAL_WHERE];
    bool parameters = !f->series && (f->proof.all_parameters || f->proof.fixed);
    size_t n = parameters ? nh_real_where_divisors(model, f->phi, found) : 0;
    for (size_t i = 0; i < n; i++) {
        nh_text_add(out, i ? " and " : " with ");
        nh_print(model->dag, found[i], out);
        nh_text_add(out, " != 0");
    }
    n = f->series ? 0 : nh_real_where(model, f->phi, found);
    for (size_t i = 0; i < n; i++) {
        nh_text_add(out, i ? " and " : ", real where ");
        nh_print(model->dag, found[i], out);
        nh_text_add(out, " > 0");
    }
}

/* Rounded up to one digit. */
static double at_most(double x)
{
    static const double rounding = 1e-9;
    double unit = pow(10, floor(log10(x)));
    return x > 0 ? ceil(x / unit - rounding) * unit : x;
}

void nh_facts_fit(const nh_current *f, nh_text *out)
{
    const double *drift = f->drift.drift;
    nh_text_addf(out, "Fitted to %.1g", at_most(f->heldout));
    if (isfinite(f->fit_digits))
        nh_text_addf(out, ", its coefficients to %.0f digit%s", f->fit_digits, f->fit_digits == 1 ? "" : "s");
    if (isfinite(drift[NH_DRIFT_RUNS - 1]) && drift[0] > 0)
        nh_text_addf(out, "; along the motion it changes by %.1g%s", at_most(drift[0]),
                     drift[NH_DRIFT_RUNS - 1] < drift[0] / 2 ? ", less with smaller tolerances" : "");
}

const char *nh_facts_proof(const nh_analysis *r, const nh_current *f)
{
    nh_text out;
    nh_text_init(&out);
    if (f->fitted) nh_facts_fit(f, &out);
    else if (!f->proof.proved)
        nh_text_addf(&out, "Conserved to %.6g digits%s", floor(f->proof.digits), nh_formula_doubt(f));
    if (!f->fitted) nh_text_add(&out, nh_facts_holds(r->question->model, &f->proof, true));
    nh_text_add(&out, nh_facts_which_branch(r, f));
    put_where(r, f, &out);
    const char *text = nh_arena_strdup(r->arena, nh_text_string(&out));
    nh_text_clear(&out);
    return text;
}
