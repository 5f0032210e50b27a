/* From a system file and the name of a parameter to its special values, with the currents that hold there. */
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "commands/classify_internal.h"
#include "exact/normal.h"
#include "graph/num.h"
#include "integrals/exact_points.h"

enum { chosen_degree = 4 };

/* ---- the family ---- */

bool nh_classified_parameter(const nh_system *s, const char *name, size_t *out, nh_error *error)
{
    for (*out = 0; *out < s->parameters; ++*out)
        if (!strcmp(s->parameter[*out].name, name)) return true;
    nh_fail(error, NH_USAGE, "", "`%s` is not a parameter of %s", name, s->name);
    return nh_system_hint_parameters(s, name, error);
}

/* Holds all other parameters at the ratios that their decimals denote; exact settings of the caller stay. */
static bool fix_others(nh_classified *x, const nh_classify_request *q, const nh_system *s, nh_error *error)
{
    x->other = nh_arena_alloc(x->arena, (s->parameters + q->settings + 1) * sizeof *x->other);
    for (size_t k = 0; k < q->settings; k++)
        if (q->setting[k].bottom > 0 && !q->setting[k].formula) x->other[x->others++] = q->setting[k];
    for (size_t i = 0; i < s->parameters; i++) {
        nh_num value = nh_num_decimal(s->parameter[i].value);
        const char *name = s->parameter[i].name;
        if (!strcmp(name, q->over) || (q->second && !strcmp(name, q->second)) || (q->third && !strcmp(name, q->third)))
            continue;
        if (!nh_num_short(value)) {
            char digits[32];
            nh_text_number(s->parameter[i].value, digits, sizeof digits);
            return nh_fail(error, NH_USAGE, "", "the value %s of `%s` has too many digits for a classification", digits,
                           name);
        }
        x->other[x->others++] = (nh_setting){
            .name = nh_arena_strdup(x->arena, name), .value = s->parameter[i].value, .top = value.p, .bottom = value.q};
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

static nh_analysis *analyse(const nh_classified *x, const nh_classify_request *q, size_t count, const nh_setting *at,
                            bool model_only, nh_error *error)
{
    size_t all;
    nh_setting *setting = nh_classified_settings(x, count, at, &all);
    nh_request request = {.line = q->command,
                          .system_path = q->system_path,
                          .settings = all,
                          .setting = setting,
                          .options = q->options,
                          .model_only = model_only};
    request.options.degree = (double)x->degree;
    nh_analysis *r = nh_analysis_create(&request, error);
    nh_free(setting);
    return r;
}

nh_analysis *nh_classified_analyse(const nh_classified *x, const nh_classify_request *q, size_t count,
                                   const nh_setting *at, nh_error *error)
{
    return analyse(x, q, count, at, q->of != NH_OF_CURRENTS, error);
}

static bool polynomial_in_velocities(const nh_analysis *r, const nh_current *f)
{
    return f->proof.proved && !f->series && !nh_depends(r->model->dag, f->phi, r->system->t);
}

static bool read_family(nh_classified *x, const nh_classify_request *q, nh_error *error)
{
    const char *name[3] = {q->over, q->second, q->third};
    nh_setting at[3];
    size_t count = q->third ? 3 : q->second ? 2 : 1, parameter[3];
    nh_system *s = nh_system_read(q->system_path, q->settings, q->setting, error);
    if (!s) return false;
    bool good = nh_system_needs_values(s, "a classification", error);
    for (size_t k = 0; k < count && good; k++) {
        static const double apart[] = {1, 1.0313, 0.9527};
        good = nh_classified_parameter(s, name[k], &parameter[k], error);
        for (size_t j = 0; j < k && good; j++)
            if (parameter[j] == parameter[k]) good = nh_fail(error, NH_USAGE, "", "--over names `%s` twice", name[k]);
        name[k] = nh_arena_strdup(x->arena, name[k]);
        if (good)
            at[k] = (nh_setting){.name = name[k], .value = unimportant(s->parameter[parameter[k]].value * apart[k])};
    }
    if (good && fix_others(x, q, s, error)) {
        x->name = nh_arena_strdup(x->arena, s->name);
        x->title = nh_arena_strdup(x->arena, s->title);
        x->over = name[0];
        x->second = name[1];
        x->third = name[2];
        x->almost_all = nh_classified_analyse(x, q, count, at, error);
    }
    nh_system_free(s);
    return x->almost_all != NULL;
}

/* ---- special values ---- */

const nh_current *nh_classified_current(const nh_analysis *r, size_t index)
{
    return index < r->count ? &r->found[index] : &r->further[index - r->count].current;
}

nh_ex *nh_classified_known(nh_classified *x)
{
    const nh_analysis *r = x->almost_all;
    nh_ex *phi = nh_alloc_array(r->count + r->furthers + 1, sizeof *phi);
    x->currents = nh_arena_alloc(x->arena, (r->count + r->furthers + 1) * sizeof *x->currents);
    for (size_t k = 0; k < r->count + r->furthers; k++) {
        const nh_current *f = nh_classified_current(r, k);
        if (!polynomial_in_velocities(r, f) || !f->proof.all_parameters) continue;
        bool rational = true;
        for (size_t i = 0; i < r->system->parameters; i++)
            rational &= nh_parametric_rational(r->model->dag, f->phi, r->model->parameter[i]);
        if (!rational) continue;
        phi[x->known] = f->phi;
        x->currents[x->known++] = k;
    }
    return phi;
}

bool nh_classified_rational(const nh_special_factor *f, int64_t *top, int64_t *bottom)
{
    if (f->degree != 1) return false;
    *top = -f->coefficient[0];
    *bottom = f->coefficient[1];
    return true;
}

/* The count of an analysis that has the coefficients of the family's: where the family depends on time, functions of
 * time too, also at a value at which the system does not. */
static const nh_completeness *completeness_of(const nh_classified *x, const nh_analysis *r)
{
    bool timely = !x->almost_all->completeness[NH_COMPLETE_IN_COORDINATES].counted;
    return &r->completeness[timely ? NH_COMPLETE_IN_TIME : NH_COMPLETE_IN_COORDINATES];
}

size_t nh_classified_complete(const nh_classified *x, const nh_analysis *r)
{
    const nh_completeness *c = completeness_of(x, r);
    return c->counted && !c->count.obstacle && !c->regional ? c->degree : 0;
}

size_t nh_classified_exact(const nh_classified *x, const nh_analysis *r, size_t rows, nh_classify_number *number)
{
    const nh_completeness *c = completeness_of(x, r);
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

size_t nh_classified_complete_everywhere(const nh_classified *x)
{
    const nh_analysis *r = x->almost_all;
    return x->known == r->count + r->furthers ? nh_classified_complete(x, r) : 0;
}

static void analyse_value(nh_classified *x, const nh_classify_request *q, nh_classify_value *v,
                          nh_classified_value *out)
{
    int64_t top, bottom;
    nh_error error;
    if (!v->first && !v->degenerate) return;
    if (!nh_classified_rational(&v->polynomial, &top, &bottom)) {
        if (!v->degenerate)
            out->why = x->question ? "it is looked at more closely at rational values only"
                                   : "currents are constructed at rational values only";
        return;
    }
    nh_error_clear(&error);
    nh_setting at = {.name = x->over, .value = (double)top / (double)bottom, .top = top, .bottom = bottom};
    if (v->degenerate) { /* the reason is that of the system there */
        nh_analysis *none = analyse(x, q, 1, &at, true, &error);
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
    nh_analysis *r = out->result = nh_classified_analyse(x, q, 1, &at, &error);
    out->why = r ? NULL : nh_arena_strdup(x->arena, error.what);
    if (!r) return;
    out->complete = nh_classified_complete(x, r);
    const nh_classification *c = x->classification;
    out->exact = nh_classified_exact(x, r, c->rows, v->number);
    if (v->open && v->open <= out->exact) { /* decided: there may be more from that degree on */
        v->first = v->open < v->first ? v->open : v->first;
        v->open = 0;
    }
    while (v->first && v->number[v->first].bound <= c->row[v->first - 1].number.bound)
        v->first = v->first < c->rows ? v->first + 1 : 0;
}

nh_classified *nh_classified_open(const nh_classify_request *q, nh_error *error)
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

nh_classify_question nh_classified_question(nh_classified *x, const nh_classify_request *q, const nh_ex *known)
{
    nh_classify_question question = {.shape = q->shape,
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
    nh_classified_parameter(x->almost_all->system, x->over, &question.parameter, &none);
    return question;
}

nh_classified *nh_classify_system(const nh_classify_request *q, nh_error *error)
{
    nh_classified *x = nh_classified_open(q, error);
    if (!x) return NULL;
    nh_ex *phi = nh_classified_known(x);
    nh_classify_question question = nh_classified_question(x, q, phi);
    if (q->of != NH_OF_CURRENTS) x->question = nh_linear_system_create(x->almost_all->model, q->of, &q->options);
    if (x->question) question.linear = &x->question->family;
    if (x->question && x->question->obstacle) x->classification = nh_classification_refused(x->question->obstacle);
    else x->classification = nh_classify(x->almost_all->model, &question);
    nh_free(phi);
    x->value = nh_arena_alloc(x->arena, (x->classification->values + 1) * sizeof *x->value);
    for (size_t k = 0; k < x->classification->values && !nh_interrupted(); k++)
        analyse_value(x, q, &x->classification->value[k], &x->value[k]);
    x->partial = nh_interrupted();
    return x;
}

void nh_classified_free(nh_classified *x)
{
    if (!x) return;
    for (size_t k = 0; x->value && k < x->classification->values; k++) nh_analysis_free(x->value[k].result);
    nh_classification_free(x->classification);
    nh_linear_system_free(x->question);
    nh_analysis_free(x->almost_all);
    nh_arena_free(x->arena);
}

/* ---- words ---- */

static void put_polynomial(const nh_special_factor *f, const char *name, nh_text *out)
{
    for (size_t j = f->degree + 1, written = 0; j-- > 0;) {
        int64_t c = f->coefficient[j];
        if (!c) continue;
        nh_text_add(out, written++ == 0 ? (c < 0 ? "-" : "") : c < 0 ? " - " : " + ");
        uint64_t size = c < 0 ? 0 - (uint64_t)c : (uint64_t)c;
        if (size != 1 || j == 0) nh_text_addf(out, "%" PRIu64 "%s", size, j ? "*" : "");
        if (j) nh_text_add(out, name);
        if (j > 1) nh_text_addf(out, "^%zu", j);
    }
}

const char *nh_classified_words(const nh_classified *x, const nh_special_factor *f)
{
    return nh_classified_values(x, x->over, f);
}

const char *nh_classified_values(const nh_classified *x, const char *name, const nh_special_factor *f)
{
    int64_t top, bottom;
    nh_text text;
    nh_text_init(&text);
    if (nh_classified_rational(f, &top, &bottom)) {
        nh_text_addf(&text, "%s = %" PRId64, name, top);
        if (bottom != 1) nh_text_addf(&text, "/%" PRId64, bottom);
    } else {
        double *root = nh_alloc_array(f->degree + 1, sizeof *root);
        size_t reals = nh_special_reals(f, root);
        put_polynomial(f, name, &text);
        nh_text_add(&text, reals ? " = 0 (" : " = 0 (no real value");
        for (size_t k = 0; k < reals; k++)
            nh_text_addf(&text, "%s%.8g", k ? ", " : nh_arena_printf(x->arena, "%s = ", name), root[k]);
        nh_text_add(&text, ")");
        nh_free(root);
    }
    const char *out = nh_arena_strdup(x->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}
