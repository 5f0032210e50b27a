/* From a system file and names of parameters to their special values, with the currents that hold there. */
#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "commands/classify_internal.h"
#include "exact/normal.h"
#include "graph/num.h"
#include "integrals/exact_points.h"

enum { chosen_degree = 4 };

/* ---- the family ---- */

/* The index of a parameter; false with an error. */
static bool find_parameter(const nh_system *system, const char *name, size_t *out, nh_error *error)
{
    for (*out = 0; *out < system->parameters; ++*out)
        if (!strcmp(system->parameter[*out].name, name)) return true;
    nh_fail(error, NH_USAGE, "", "`%s` is not a parameter of %s", name, system->name);
    return nh_system_hint_parameters(system, name, error);
}

/* Holds all other parameters at the ratios that their decimals denote; exact settings of the caller stay. */
static bool fix_others(nh_classified *x, const nh_classify_request *q, const nh_system *system, nh_error *error)
{
    x->other = nh_arena_alloc(x->arena, (system->parameters + q->settings + 1) * sizeof *x->other);
    for (size_t k = 0; k < q->settings; k++)
        if (q->setting[k].bottom > 0 && !q->setting[k].formula) x->other[x->others++] = q->setting[k];
    for (size_t i = 0; i < system->parameters; i++) {
        nh_num value = nh_num_decimal(system->parameter[i].value);
        const char *name = system->parameter[i].name;
        bool varies = false;
        for (size_t k = 0; k < x->parameters; k++) varies |= !strcmp(name, x->over[k]);
        if (varies) continue;
        if (!nh_num_short(value)) {
            char digits[32];
            nh_text_number(system->parameter[i].value, digits, sizeof digits);
            return nh_fail(error, NH_USAGE, "", "the value %s of `%s` has too many digits for a classification", digits,
                           name);
        }
        x->other[x->others++] = (nh_setting){.name = nh_arena_strdup(x->arena, name),
                                             .value = system->parameter[i].value,
                                             .top = value.p,
                                             .bottom = value.q};
    }
    x->fixed = x->others;
    for (size_t k = 0; k < q->settings; k++) /* functions of parameters that are set before them */
        if (q->setting[k].formula) x->other[x->others++] = q->setting[k];
    return true;
}

/* A value near the file's value that has no special meaning. */
static double unimportant(double value) { return round((value * 1.0871 + (value == 0 ? 0.3187 : 0)) * 1e6) / 1e6; }

nh_setting *nh_classified_settings(const nh_classified *x, size_t count, const nh_setting *at, size_t *all)
{
    size_t formulas = x->others - x->fixed;
    *all = x->others + count;
    nh_setting *setting = nh_alloc_array(*all + 1, sizeof *setting);
    memcpy(setting, x->other, x->fixed * sizeof *setting);
    memcpy(setting + x->fixed, at, count * sizeof *setting);
    memcpy(setting + x->fixed + count, x->other + x->fixed, formulas * sizeof *setting);
    return setting;
}

static nh_analysis *analyse(const nh_classified *x, const nh_classify_request *q, const nh_setting *at, bool model_only,
                            nh_error *error)
{
    size_t all;
    nh_setting *setting = nh_classified_settings(x, x->parameters, at, &all);
    nh_request request = {.line = q->command,
                          .system_path = q->system_path,
                          .settings = all,
                          .setting = setting,
                          .options = q->options,
                          .model_only = model_only};
    request.options.degree = (double)x->degree;
    nh_analysis *result = nh_analysis_create(&request, error);
    nh_free(setting);
    return result;
}

static bool polynomial_in_velocities(const nh_analysis *result, const nh_current *f)
{
    return f->proof.proved && !f->series &&
           !nh_depends(result->question->model->dag, f->phi, result->question->system->t);
}

/* Reads the system and analyses it at values of the parameters that have no special meaning. */
static bool read_family(nh_classified *x, const nh_classify_request *q, nh_error *error)
{
    static const double apart[NH_MOST_PARAMETERS] = {1, 1.0313, 0.9527};
    nh_setting at[NH_MOST_PARAMETERS];
    size_t index[NH_MOST_PARAMETERS];
    while (x->parameters < NH_MOST_PARAMETERS && q->over[x->parameters]) x->parameters++;
    nh_system *system = nh_system_read(q->system_path, q->settings, q->setting, error);
    if (!system) return false;
    bool good = nh_system_needs_values(system, "a classification", error) &&
                nh_system_needs_formulas(system, "a classification", error);
    for (size_t k = 0; k < x->parameters && good; k++) {
        const char *name = x->over[k] = nh_arena_strdup(x->arena, q->over[x->parameters - 1 - k]);
        good = find_parameter(system, name, &index[k], error);
        for (size_t j = 0; j < k && good; j++)
            if (index[j] == index[k]) good = nh_fail(error, NH_USAGE, "", "--over names `%s` twice", name);
        if (good)
            at[k] = (nh_setting){.name = name, .value = unimportant(system->parameter[index[k]].value * apart[k])};
    }
    if (good && fix_others(x, q, system, error)) {
        x->name = nh_arena_strdup(x->arena, system->name);
        x->title = nh_arena_strdup(x->arena, system->title);
        x->almost_all = analyse(x, q, at, q->of != NH_OF_CURRENTS, error);
    }
    nh_system_free(system);
    return x->almost_all != NULL;
}

/* ---- special values ---- */

const nh_current *nh_classified_current(const nh_analysis *result, size_t index)
{
    const nh_current_list *list = result->list;
    return index < list->count ? &list->found[index] : &list->further[index - list->count].current;
}

/* The currents that hold for every value, on the heap. */
static nh_ex *known_currents(nh_classified *x)
{
    const nh_analysis *result = x->almost_all;
    const nh_current_list *list = result->list;
    nh_ex *phi = nh_alloc_array(list->count + list->furthers + 1, sizeof *phi);
    x->currents = nh_arena_alloc(x->arena, (list->count + list->furthers + 1) * sizeof *x->currents);
    for (size_t k = 0; k < list->count + list->furthers; k++) {
        const nh_current *f = nh_classified_current(result, k);
        if (!polynomial_in_velocities(result, f) || !f->proof.all_parameters) continue;
        bool rational = true;
        for (size_t i = 0; i < result->question->system->parameters; i++)
            rational &=
                nh_parametric_rational(result->question->model->dag, f->phi, result->question->model->parameter[i]);
        if (!rational) continue;
        phi[x->known] = f->phi;
        x->currents[x->known++] = k;
    }
    return phi;
}

/* The count of an analysis that has the coefficients of the family's: where the family depends on time, functions of
 * time too, also at a value at which the system does not. */
static const nh_completeness *completeness_of(const nh_classified *x, const nh_analysis *result)
{
    bool timely = !x->almost_all->completeness[NH_COMPLETE_IN_COORDINATES].counted;
    return &result->completeness[timely ? NH_COMPLETE_IN_TIME : NH_COMPLETE_IN_COORDINATES];
}

/* The degree up to which the currents of an analysis account for the number of integrals; 0: none. */
static size_t complete_degree(const nh_classified *x, const nh_analysis *result)
{
    const nh_completeness *c = completeness_of(x, result);
    return c->counted && !c->count.obstacle && !c->regional ? c->degree : 0;
}

/* Takes the analysis' own bounds into the numbers of degrees 1 .. rows where they are lower; the degree up to which the
 * products of its currents are as many. */
static size_t exact_degree(const nh_classified *x, const nh_analysis *result, size_t rows, nh_classify_number *number)
{
    const nh_completeness *c = completeness_of(x, result);
    size_t d = 0;
    if (x->shape || !c->counted || c->count.obstacle || c->regional) return 0;
    for (size_t k = 0; k < c->count.rows && k < rows; k++) {
        const nh_count_row *row = &c->count.row[k];
        nh_classify_number *n = &number[row->degree];
        if (row->bounded && n->bounded && row->bound < n->bound) n->bound = row->bound;
        if (d + 1 == row->degree && (n->bounded ? n->bound : row->bound) == row->known) d++;
    }
    return d;
}

void nh_classified_analyse(nh_classified *x, const nh_classify_request *q, const nh_setting *at, nh_classify_special *v,
                           nh_classified_finding *out)
{
    nh_error error;
    nh_error_clear(&error);
    nh_analysis *result = analyse(x, q, at, false, &error);
    *out = (nh_classified_finding){.result = result, .why = result ? NULL : nh_arena_strdup(x->arena, error.what)};
    if (!result) return;
    nh_grow(&x->own, &x->owned_capacity, x->owned + 1, sizeof *x->own);
    x->own[x->owned++] = result;
    out->count = result->list->count + result->list->furthers;
    out->complete = complete_degree(x, result);
    out->exact = exact_degree(x, result, x->classification->rows, v->number);
}

/* ---- parts ---- */

/* What holds at a value of one parameter. */
static void examine_value(nh_classified *x, const nh_classify_request *q, nh_classify_special *v,
                          nh_classified_finding *out)
{
    const nh_classification *c = x->classification;
    int64_t top, bottom;
    nh_error error;
    if (!v->first && !v->degenerate) return;
    if (!nh_special_rational(&v->polynomial, &top, &bottom)) {
        if (!v->degenerate)
            out->why = x->question ? "it is looked at more closely at rational values only"
                                   : "currents are constructed at rational values only";
        return;
    }
    nh_error_clear(&error);
    nh_setting at = {.name = x->over[0], .value = (double)top / (double)bottom, .top = top, .bottom = bottom};
    if (v->degenerate) { /* the reason is that of the system there */
        nh_analysis *none = analyse(x, q, &at, true, &error);
        out->why = none ? NULL : nh_arena_strdup(x->arena, error.what);
        nh_analysis_free(none);
        return;
    }
    if (x->question) {
        out->why = NULL;
        nh_classified_confirm(x, q, &at, v->number[v->first].bound, out);
        out->exact = out->complete;
        return;
    }
    nh_classified_analyse(x, q, &at, v, out);
    if (!out->result) return;
    if (v->open && v->open <= out->exact) { /* decided: there may be more from that degree on */
        v->first = v->open < v->first ? v->open : v->first;
        v->open = 0;
    }
    while (v->first && v->number[v->first].bound <= c->row[v->first - 1].number.bound)
        v->first = v->first < c->rows ? v->first + 1 : 0;
}

/* The degree up to which products of currents that are proved everywhere on a curve or surface are as many as were
 * counted. */
static size_t complete_within(const nh_classified *x, const nh_classify_special *special, const nh_classified *within)
{
    const nh_classification *c = within->classification;
    const nh_analysis *result = within->almost_all;
    size_t d = 0;
    if (!special || !special->first) return 0;
    if (c->obstacle == nh_parametric_constant)
        d = within->known == result->list->count + result->list->furthers ? complete_degree(within, result) : 0;
    else
        while (d < c->rows && d < x->classification->rows && c->row[d].known == c->row[d].number.bound) d++;
    return d >= special->first ? d : 0;
}

/* Classifies on a curve, surface or wall over all parameters but the one that it gives. */
static void classify_within(nh_classified *x, const nh_classify_request *q, nh_classified_part *p)
{
    int64_t top, bottom;
    nh_error error;
    nh_error_clear(&error);
    p->finding.why =
        x->parameters == 2
            ? "currents are constructed on curves on which one parameter is a rational function of the other"
            : "currents are constructed on surfaces on which one parameter is a rational function of the "
              "others";
    p->gives = nh_special_variable(p->polynomial, 1);
    if (p->gives == NH_MOST_PARAMETERS) return;
    const char *name = x->over[p->gives], *formula = nh_classified_graph(x, p->polynomial, p->gives);
    nh_setting *setting = nh_arena_alloc(x->arena, (x->others + 1) * sizeof *setting);
    setting[0] = (nh_setting){.name = name, .formula = formula};
    if (nh_special_rational(p->polynomial, &top, &bottom)) {
        formula = nh_classified_ratio(x->arena, top, bottom);
        setting[0] = (nh_setting){.name = name, .value = (double)top / (double)bottom, .top = top, .bottom = bottom};
    }
    memcpy(setting + 1, x->other, x->others * sizeof *setting); /* some of these may depend on it */
    nh_classify_request request = *q;
    memset(request.over, 0, sizeof request.over);
    for (size_t k = 0, v = x->parameters; v-- > 0;)
        if ((int)v != p->gives) request.over[k++] = x->over[v];
    request.settings = x->others + 1;
    request.setting = setting;
    request.options.degree = (double)x->classification->rows;
    p->graph = nh_arena_printf(x->arena, "%s = %s", name, formula);
    const nh_classified *within = p->within = nh_classify_system(&request, &error);
    p->finding.why = within ? NULL : nh_arena_strdup(x->arena, error.what);
    if (!within) return;
    x->partial |= within->partial;
    size_t complete = complete_within(x, p->special, within);
    p->finding = (nh_classified_finding){.result = within->almost_all,
                                         .count = within->known,
                                         .index = within->currents,
                                         .complete = complete,
                                         .exact = complete};
}

/* One part for each value, curve or surface, then one for each wall of three parameters: cylinders, then planes. */
static void list_parts(nh_classified *x)
{
    nh_classification *c = x->classification;
    x->part = nh_arena_alloc(x->arena, (c->specials + c->walls + 1) * sizeof *x->part);
    for (; x->parts < c->specials; x->parts++)
        x->part[x->parts] =
            (nh_classified_part){.polynomial = &c->special[x->parts].polynomial, .special = &c->special[x->parts]};
    for (int plane = 0; plane < 2 && x->parameters == 3; plane++)
        for (size_t k = 0; k < c->walls; k++)
            if ((nh_special_variable(&c->wall[k].polynomial, 0) == 2) == plane)
                x->part[x->parts++] = (nh_classified_part){.polynomial = &c->wall[k].polynomial};
}

static void examine_parts(nh_classified *x, const nh_classify_request *q)
{
    nh_classification *c = x->classification;
    for (size_t k = 0; k < x->parts; k++) {
        nh_classified_part *p = &x->part[k];
        nh_classify_special *special = k < c->specials ? &c->special[k] : NULL;
        if (!special || !special->degenerate) p->finding.why = "the run was ended";
        if (nh_interrupted() || !c->rows) continue;
        if (x->parameters == 1) examine_value(x, q, special, &p->finding);
        else if (!special || !special->degenerate) classify_within(x, q, p);
    }
}

/* ---- the whole ---- */

static nh_classified *open_family(const nh_classify_request *q, nh_error *error)
{
    nh_arena *arena = nh_arena_create();
    nh_classified *x = nh_arena_alloc(arena, sizeof *x);
    *x = (nh_classified){.arena = arena,
                         .shape = q->shape,
                         .of = q->of,
                         .degree = q->options.degree > 0 ? (size_t)q->options.degree : chosen_degree};
    if (read_family(x, q, error)) return x;
    nh_classified_free(x);
    return NULL;
}

static nh_classify_question question_of(const nh_classified *x, const nh_classify_request *q, const nh_ex *known)
{
    nh_classify_question question = {.parameters = x->parameters,
                                     .shape = q->shape,
                                     .degree = x->degree,
                                     .work = q->options.count_work,
                                     .products = q->options.staircase,
                                     .theorem = (size_t)q->options.theorem,
                                     .unknowns = (size_t)q->options.pencil,
                                     .plane = (size_t)q->options.plane,
                                     .lines = (size_t)q->options.lines,
                                     .planes = (size_t)q->options.planes,
                                     .known = x->known,
                                     .current = known};
    nh_error none;
    nh_error_clear(&none);
    for (size_t k = 0; k < x->parameters; k++)
        find_parameter(x->almost_all->question->system, x->over[k], &question.parameter[k], &none);
    return question;
}

nh_classified *nh_classify_system(const nh_classify_request *q, nh_error *error)
{
    nh_classified *x = open_family(q, error);
    if (!x) return NULL;
    nh_ex *phi = known_currents(x);
    nh_classify_question question = question_of(x, q, phi);
    if (q->of != NH_OF_CURRENTS)
        x->question = nh_linear_system_create(x->almost_all->question->model, q->of, &q->options);
    if (x->question) question.linear = &x->question->family;
    if (x->question && x->question->obstacle) x->classification = nh_classification_refused(x->question->obstacle);
    else x->classification = nh_classify(x->almost_all->question->model, &question);
    nh_free(phi);
    list_parts(x);
    examine_parts(x, q);
    nh_classified_list_places(x, q);
    x->partial |= nh_interrupted();
    return x;
}

void nh_classified_free(nh_classified *x)
{
    if (!x) return;
    for (size_t k = 0; k < x->parts; k++) nh_classified_free(x->part[k].within);
    for (size_t k = 0; k < x->owned; k++) nh_analysis_free(x->own[k]);
    nh_free(x->own);
    nh_free(x->place);
    nh_classification_free(x->classification);
    nh_linear_system_free(x->question);
    nh_analysis_free(x->almost_all);
    nh_arena_free(x->arena);
}
