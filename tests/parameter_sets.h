/* A system's formulas with other values of its parameters: for bench_parameters, which prints a table, and test_parameters_reduce, which asserts.
 *
 * Parameters are symbols, so that every formula must be the same, letter for letter.  Where one parameter has a special value that value is put in its place in the
 * formulas of both.  There may be more of them for a special value, and others are simple: the file's formula must then be a function of those that are found
 * there, which for currents is decided by the rank of gradients in ball arithmetic, and for fields, momenta and densities by linear algebra over the constants; or
 * mean nothing there, like a formula that becomes a constant, or with 1/k for k = 0, or with sqrt(B^2 - w^2) for B < w, or any where the file's equations of motion are not finite.
 * What holds for the file's values only, such as a series, is not compared, but counted.
 * Reduced equations are left out: charts are chosen by conditioning at the given values. */
#ifndef NH_TESTS_PARAMETER_SETS_H
#define NH_TESTS_PARAMETER_SETS_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/linalg.h"
#include "exact/normal.h"
#include "graph/print.h"
#include "document/facts.h"
#include "commands/analyze.h"
#include "commands/reduce_internal.h"
#include "graph/dag.h"
#include "graph/num.h"
#include "integrals/gradient_rank.h"
#include "problem/analysis_file.h"
#include "system/sample.h"

/* ---- formulas ---- */

typedef struct {
    char name[64];   /* "Phi2", "generator 3", "density of stage 1" */
    char *text;
    char limit[160]; /* for which parameters it holds, and why; "": for all */
} formula;

typedef struct {
    size_t count, capacity;
    formula *list;
    bool answered;   /* nothing failed */
    nh_analysis *analysis;   /* where they are from; NULL where there was none */
    nh_reduction *reduction;
} formulas;

/* One parameter at a special value; name NULL: none. */
typedef struct {
    const char *name;
    double value;
} special_value;

static inline void formulas_clear(formulas *f)
{
    for (size_t i = 0; i < f->count; i++) nh_free(f->list[i].text);
    nh_free(f->list);
    nh_analysis_free(f->analysis);
    nh_reduction_free(f->reduction);
    *f = (formulas){0};
}

static inline void put_substituted(const nh_model *o, special_value special, nh_ex e, nh_text *out)
{
    nh_dag *d = o->dag;
    for (size_t i = 0; i < o->system->parameters && special.name; i++) {
        nh_ex value = nh_number(d, nh_num_decimal(special.value));
        if (!strcmp(o->system->parameter[i].name, special.name)) e = nh_simplify(d, nh_substitute(d, e, 1, &o->parameter[i], &value));
    }
    char *text = nh_print_string(d, e);
    nh_text_addf(out, "%s%s", *nh_text_string(out) ? "; " : "", text);
    nh_free(text);
}

/* n expressions that are one formula; `proof` NULL: an identity. */
static inline void formulas_add(formulas *f, const nh_model *o, special_value special, const char *name, size_t n, const nh_ex *e, const nh_proof *proof, const char *why)
{
    nh_text text;
    nh_text_init(&text);
    for (size_t i = 0; i < n; i++) put_substituted(o, special, e[i], &text);
    nh_grow(&f->list, &f->capacity, f->count + 1, sizeof *f->list);
    formula *to = &f->list[f->count++];
    *to = (formula){.text = nh_strdup(nh_text_string(&text))};
    snprintf(to->name, sizeof to->name, "%s", name);
    if (proof && !proof->all_parameters && o->system->parameters)
        snprintf(to->limit, sizeof to->limit, "%s%s%s", nh_facts_holds(o, proof, false) + 1, *why ? ", " : "", why);
    nh_text_clear(&text);
}

/* ---- of an analysis ---- */

static inline const char *why_limited(const nh_current *f)
{
    if (f->series) return "a series";
    if (f->proof.proved) return "";
    return f->exact ? "no proof" : "numbers without a name";
}

/* Currents; dependent ones too. */
static inline void add_analysis(formulas *f, const char *path, size_t settings, const nh_setting *setting, special_value special, const nh_options *options)
{
    nh_error error = {0};
    nh_request q = {.system_path = path, .settings = settings, .setting = setting, .options = *options};
    nh_analysis *r = nh_analysis_create(&q, &error);
    for (size_t k = 0; r && k < r->list->count; k++) {
        const nh_current *c = &r->list->found[k];
        formulas_add(f, r->question->model, special, c->name, 1, c->has_in_velocities ? &c->in_velocities : &c->phi, &c->proof, why_limited(c));
    }
    f->answered &= r != NULL;
    f->analysis = r;
    nh_error_clear(&error);
}

/* ---- of a reduction ---- */

/* Brackets follow from generators; where a special value brings more of these in they have other numbers. */
static inline void add_group(formulas *f, const nh_reduction *r, special_value special)
{
    const nh_action *g = &(r->all ? r->all : r->group)->action;
    const nh_kinetic *k = r->kinetic;
    char name[64];
    for (size_t a = 0; a < g->d; a++) {
        nh_proof proof = nh_generator_proof(k, &g->generator[a]);
        snprintf(name, sizeof name, "generator %zu", a + 1);
        formulas_add(f, k->model, special, name, k->m, g->generator[a].component, &proof, proof.proved ? "" : "to rounding");
    }
    for (size_t pair = 0; pair < g->d * g->d; pair++) {
        snprintf(name, sizeof name, "bracket %zu, %zu", pair / g->d + 1, pair % g->d + 1);
        if (!special.name && pair / g->d < pair % g->d) formulas_add(f, k->model, special, name, g->d, g->constant + pair * g->d, NULL, "");
    }
}

static inline void add_momenta(formulas *f, const nh_reduction *r, special_value special)
{
    char name[64];
    for (size_t i = 0; i < r->momenta.count; i++) {
        const nh_momentum *p = &r->momenta.momentum[i];
        snprintf(name, sizeof name, "momentum %zu", i + 1);
        formulas_add(f, r->model, special, name, 1, &p->value, &p->proof, p->proof.proved ? "" : "to rounding");
        snprintf(name, sizeof name, "field of momentum %zu", i + 1);
        formulas_add(f, r->model, special, name, r->kinetic->m, p->field, NULL, "");
    }
}

/* Generators, brackets, conserved momenta with their fields, densities, and the fields of joints. */
static inline void add_reduction(formulas *f, const char *path, size_t settings, const nh_setting *setting, special_value special, const nh_options *options)
{
    nh_error error = {0};
    nh_request q = {.system_path = path, .settings = settings, .setting = setting, .options = *options};
    nh_reduction *r = nh_reduction_create(&q, &error);
    char name[64];
    if (r && (r->all || r->group)) add_group(f, r, special);
    if (r) add_momenta(f, r, special);
    for (size_t i = 0; r && i < r->stages; i++) {
        const nh_chaplygin_measure *m = &r->stage[i].measure;
        snprintf(name, sizeof name, "density of stage %zu", i + 1);
        if (m->tested && m->measure && m->closed) formulas_add(f, r->model, special, name, 1, &m->density, &m->proof, m->proof.proved ? "" : "to rounding");
    }
    for (size_t i = 0; r && r->joints && i < r->joints->fields; i++) {
        snprintf(name, sizeof name, "joint field %zu", i + 1);
        formulas_add(f, r->model, special, name, r->kinetic->m, r->joints->field[i].component, NULL, "");
    }
    f->answered &= r != NULL;
    if (r) nh_reduction_whole_model(r, &error);
    f->reduction = r;
    nh_error_clear(&error);
}

/* ---- what becomes of a formula at other values ---- */

typedef enum { FATE_LETTERS, FATE_FUNCTION, FATE_LIMITED, FATE_NOTHING, FATE_OTHER, FATES } formula_fate; /* the better ones first */
static const char *const fate_words[] = {"letter for letter", "by those found there", "hold for the file's values only", "mean nothing", "differ"};

enum { most_parts = 64, probes = 32 };

static inline nh_model *model_of(const formulas *f) { return f->analysis ? f->analysis->question->model : f->reduction ? f->reduction->whole : NULL; }

/* The parts of a formula, which "; " separates, as expressions of another run of the same system; 0 where one means nothing. */
static inline size_t parts_of(const nh_model *o, const char *text, nh_ex *e)
{
    nh_error error = {0};
    char *copy = nh_strdup(text);
    size_t n = 0;
    bool good = !strstr(text, "nan") && !strstr(text, "inf");
    for (char *at = copy, *next; good && at && n < most_parts; at = next) {
        if ((next = strstr(at, "; "))) *next = 0, next += 2;
        good = nh_system_expression_text(o->system, "a formula", at, 0, NULL, &e[n], &error) && nh_analysis_file_to_chart(o, e[n], &e[n], &error);
        n++;
    }
    nh_error_clear(&error);
    nh_free(copy);
    return good ? n : 0;
}

/* Values of the parts at points: value[part * probes + point]; false where there are no points. */
static inline bool values_of(const nh_model *o, size_t n, const nh_ex *e, double *value)
{
    nh_error error = {0};
    nh_points *p = nh_points_create(o, probes, 1, 17, &error);
    if (p) nh_points_evaluate(p, o, n, e, value);
    nh_points_free(p);
    nh_error_clear(&error);
    return p != NULL;
}

/* Are all parts finite real numbers at some point? */
static inline bool real_somewhere(const nh_model *o, size_t n, const nh_ex *e)
{
    double *value = nh_alloc_array(n * probes + 1, sizeof *value);
    bool there = values_of(o, n, e, value), real = false;
    for (size_t i = 0; there && i < probes; i++) {
        bool all = true;
        for (size_t j = 0; j < n; j++) all &= isfinite(value[j * probes + i]);
        real |= all;
    }
    nh_free(value);
    return real;
}

/* Are the file's equations of motion, in its chart, finite anywhere for a special value? */
static inline bool equations_mean_something(const formulas *was, special_value special)
{
    const nh_model *o = model_of(was);
    nh_dag *d = o ? o->dag : NULL;
    nh_ex e[2 * most_parts];
    size_t n = 0;
    if (!o || !special.name || o->n + o->m > 2 * most_parts) return true;
    for (size_t i = 0; i < o->m; i++) e[n++] = o->rho[i];
    for (size_t i = 0; i < o->n; i++) e[n++] = o->a[i];
    for (size_t i = 0; i < o->system->parameters; i++) {
        nh_ex value = nh_number(d, nh_num_decimal(special.value));
        for (size_t j = 0; j < n && !strcmp(o->system->parameter[i].name, special.name); j++) e[j] = nh_substitute(d, e[j], 1, &o->parameter[i], &value);
    }
    return real_somewhere(o, n, e);
}

/* Is it a combination with constant coefficients of the formulas of the same kind (the first word of the name, without numbers)? */
static inline bool is_spanned(const formulas *is, const formula *f, size_t n, const nh_ex *e)
{
    const nh_model *o = model_of(is);
    size_t rows = n * probes, columns = 0, kind = strcspn(f->name, "0123456789");
    double *all = nh_alloc_array((is->count + 1) * rows + 1, sizeof *all), *b = nh_alloc_array(rows + is->count + 1, sizeof *b), size = 0, off = 0;
    bool good = values_of(o, n, e, b);
    for (size_t i = 0; good && i < is->count; i++) {
        nh_ex part[most_parts];
        if (strncmp(is->list[i].name, f->name, kind) || parts_of(o, is->list[i].text, part) != n) continue;
        good = values_of(o, n, part, all + columns++ * rows);
    }
    for (size_t j = 0; j < rows; j++) { /* a point where one of them is not finite is no point */
        bool finite = isfinite(b[j]);
        for (size_t i = 0; i < columns; i++) finite &= isfinite(all[i * rows + j]);
        if (!finite) b[j] = 0;
        for (size_t i = 0; i < columns && !finite; i++) all[i * rows + j] = 0;
        size = fmax(size, fabs(b[j]));
    }
    double *kept = nh_alloc_array(rows * (columns + 1) + 1, sizeof *kept), *want = nh_alloc_array(rows + 1, sizeof *want);
    memcpy(kept, all, rows * columns * sizeof *kept);
    memcpy(want, b, rows * sizeof *want);
    good = good && columns > 0 && columns <= rows && nh_least_squares(rows, columns, all, 1, b, rows, 1e-12) > 0;
    for (size_t j = 0; good && j < rows; j++) {
        for (size_t i = 0; i < columns; i++) want[j] -= b[i] * kept[i * rows + j];
        off = fmax(off, fabs(want[j]));
    }
    nh_free(all);
    nh_free(b);
    nh_free(kept);
    nh_free(want);
    return good && off <= 1e-9 * size;
}

/* Of a current: is it a function of those found there? */
static inline bool is_function(const formulas *is, nh_ex phi)
{
    const nh_analysis *r = is->analysis;
    nh_ex list[200];
    size_t n = 0;
    for (size_t k = 0; r && k < r->list->count && n < 190; k++)
        if (r->list->found[k].independence == NH_INDEPENDENT) list[n++] = r->list->found[k].phi;
    list[n] = phi;
    return r && nh_rank_decide(r->question->model, n, list, r->question->options.doubt).answer == NH_RANK_STAYS;
}

static inline bool is_constant(const nh_model *o, size_t n, const nh_ex *e)
{
    bool moves = false;
    for (size_t j = 0; j < o->width; j++)
        for (size_t i = 0; i < n; i++) moves |= nh_depends(o->dag, e[i], o->chart->symbol[j]);
    return !moves && n == 1;
}

static inline formula_fate fate_of(const formulas *is, const formula *f)
{
    const nh_model *o = model_of(is);
    nh_ex e[most_parts];
    size_t n = o ? parts_of(o, f->text, e) : 0;
    if (*f->limit) return FATE_LIMITED;
    if (!o || !strncmp(f->name, "bracket", 7)) return FATE_OTHER;
    if (!n || is_constant(o, n, e)) return FATE_NOTHING;
    if (strncmp(f->name, "Phi", 3) ? is_spanned(is, f, n, e) : is_function(is, e[0])) return FATE_FUNCTION;
    return real_somewhere(o, n, e) ? FATE_OTHER : FATE_NOTHING;
}

/* What kind of system it is with these values; false: none. */
static inline bool kind_of(const char *path, size_t settings, const nh_setting *setting, char *out, size_t size)
{
    nh_error error = {0};
    nh_system *s = nh_system_read(path, settings, setting, &error);
    nh_chart *chart = s ? nh_chart_create(s, NH_CHART_AUTO, 1, &error) : NULL;
    nh_model *o = chart ? nh_model_bare(s, chart) : NULL; /* which owns the chart */
    nh_kinetic *k = o ? nh_kinetic_create(o, 1, &error) : NULL;
    if (k) snprintf(out, size, "%d%d%d%d%d%d%d", k->quadratic, k->magnetic, k->metric, k->linear, k->affine, k->forced, k->reducible);
    bool good = k != NULL;
    nh_kinetic_free(k);
    nh_model_free(o);
    nh_system_free(s);
    nh_error_clear(&error);
    return good;
}

/* ---- values ---- */

enum { PARAMETER_SETS = 3, most_parameters = 40, most_draws = 20 };
static const char *const parameter_set_name[PARAMETER_SETS] = {"whole numbers", "decimals", "one special value"};

typedef struct {
    size_t count;
    nh_setting setting[most_parameters];
    special_value special;
    char text[400];
} parameter_set;

static inline void add_setting(parameter_set *p, const char *name, double value)
{
    size_t n = strlen(p->text);
    p->setting[p->count++] = (nh_setting){.name = name, .value = value};
    snprintf(p->text + n, sizeof p->text - n, "%s%s = %.15g", n ? ", " : "", name, value);
}

/* Distinct whole numbers up to 9, or to the number of parameters, with the signs of the file's values. */
static inline void draw_whole_numbers(const nh_system *s, uint64_t *state, parameter_set *p)
{
    size_t n = s->parameters, most = n > 7 ? n + 2 : 9;
    double taken[most_parameters];
    for (size_t i = 0; i < n; i++) {
        size_t j;
        do {
            taken[i] = 2 + floor((double)(most - 1) * nh_random(state));
            for (j = 0; j < i && taken[j] != taken[i]; j++) continue;
        } while (j < i);
        add_setting(p, s->parameter[i].name, s->parameter[i].value < 0 ? -taken[i] : taken[i]);
    }
}

/* Five digits, not far from the file's values. */
static inline void draw_decimals(const nh_system *s, uint64_t *state, parameter_set *p)
{
    for (size_t i = 0; i < s->parameters; i++) {
        double value = s->parameter[i].value != 0 ? s->parameter[i].value : 1, digits;
        value *= 0.7 + 0.7 * nh_random(state);
        digits = pow(10, 4 - floor(log10(fabs(value))));
        add_setting(p, s->parameter[i].name, round(value * digits) / digits);
    }
}

/* One parameter at 1, at 0, or at another one's value. */
static inline void draw_special(const nh_system *s, uint64_t *state, parameter_set *p)
{
    size_t n = s->parameters, i = (size_t)((double)n * nh_random(state)), way = (size_t)((n > 1 ? 3 : 2) * nh_random(state)), j = (i + 1 + (size_t)((double)(n - 1) * nh_random(state))) % n;
    double value = way == 0 ? 1 : way == 1 ? 0 : s->parameter[j].value;
    add_setting(p, s->parameter[i].name, value);
    p->special = (special_value){s->parameter[i].name, value};
}

static inline parameter_set parameter_set_draw(const nh_system *s, size_t kind, uint64_t *state)
{
    parameter_set p = {0};
    if (kind == 0) draw_whole_numbers(s, state, &p);
    else if (kind == 1) draw_decimals(s, state, &p);
    else draw_special(s, state, &p);
    return p;
}

/* ---- a system ---- */

typedef struct {
    bool currents, reductions;
    nh_options options;
} parameters_question;

static inline formulas ask(const char *path, const parameters_question *q, size_t settings, const nh_setting *setting, special_value special)
{
    formulas f = {.answered = true};
    if (q->currents) add_analysis(&f, path, settings, setting, special, &q->options);
    if (q->reductions) add_reduction(&f, path, settings, setting, special, &q->options);
    return f;
}

typedef struct {
    bool drawn[PARAMETER_SETS];        /* were there admissible values? */
    formula_fate fate[PARAMETER_SETS]; /* the worst of a formula */
    size_t formulas, limited; /* of the file; those that hold for some values only, of the file and of the first two sets */
    char *words;              /* what is not there letter for letter, and what is limited, with reasons */
} parameters_row;

static inline const formula *find_formula(const formulas *f, const char *text)
{
    for (size_t i = 0; i < f->count; i++)
        if (!strcmp(f->list[i].text, text)) return &f->list[i];
    return NULL;
}

static inline const formula *named(const formulas *f, const char *name)
{
    for (size_t i = 0; i < f->count; i++)
        if (!strcmp(f->list[i].name, name)) return &f->list[i];
    return NULL;
}

static inline void list_limited(const formulas *f, const char *where, parameters_row *o, nh_text *out)
{
    for (size_t i = 0; i < f->count; i++) {
        if (!*f->list[i].limit) continue;
        nh_text_addf(out, "%s%s %s: %s", *nh_text_string(out) ? "; " : "", where, f->list[i].name, f->list[i].limit);
        o->limited++;
    }
}

/* How many hold for all values. */
static inline size_t unlimited(const formulas *f)
{
    size_t n = 0;
    for (size_t i = 0; i < f->count; i++) n += !*f->list[i].limit;
    return n;
}

/* Does every formula of `was` stand in `is`, under its name unless a special value brings others in?  The worst fate of one. */
static inline formula_fate compare_formulas(const formulas *was, const formulas *is, const parameter_set *p, nh_text *out)
{
    bool meaning = equations_mean_something(was, p->special), bad_count = !p->special.name && unlimited(is) != unlimited(was);
    formula_fate worst = is->answered && !bad_count ? FATE_LETTERS : FATE_OTHER;
    size_t count[FATES] = {0};
    const char *names[FATES][400];
    if (!is->answered || bad_count) nh_text_addf(out, "%s%s: %zu formulas instead of %zu", *nh_text_string(out) ? "; " : "", p->text, unlimited(is), unlimited(was));
    for (size_t i = 0; i < was->count; i++) {
        const formula *f = &was->list[i], *g = named(is, f->name);
        if (p->special.name ? find_formula(is, f->text) != NULL : g && !strcmp(g->text, f->text)) continue;
        formula_fate fate = fate_of(is, f);
        if (fate == FATE_OTHER && !meaning) fate = FATE_NOTHING;
        if (getenv("NHSYM_TEST_FIGURES") && fate == FATE_OTHER) printf("%s: %s\n    %s\n    %s\n", p->text, f->name, f->text, g ? g->text : "");
        if (count[fate] < 400) names[fate][count[fate]++] = f->name;
        worst = fate > worst ? fate : worst;
    }
    for (formula_fate k = FATE_FUNCTION; k < FATES; k++) {
        if (count[k]) nh_text_addf(out, "%s%s: %s: ", *nh_text_string(out) ? "; " : "", p->text, fate_words[k]);
        for (size_t i = 0; i < count[k]; i++) nh_text_addf(out, "%s%s", i ? ", " : "", names[k][i]);
    }
    return worst;
}

/* One set of values against the file's formulas. */
static inline void compare_set(const char *path, const nh_system *s, const parameters_question *q, const formulas *plain, size_t set, uint64_t *state, parameters_row *o, nh_text *out)
{
    char usual[16], kind[16] = "";
    parameter_set p;
    bool good = kind_of(path, 0, NULL, usual, sizeof usual);
    size_t draws = 0;
    do p = parameter_set_draw(s, set, state);
    while (good && !(kind_of(path, p.count, p.setting, kind, sizeof kind) && !strcmp(kind, usual)) && ++draws < most_draws);
    if (!good || draws == most_draws) return;
    formulas is = ask(path, q, p.count, p.setting, p.special), was = p.special.name ? ask(path, q, 0, NULL, p.special) : (formulas){0};
    o->drawn[set] = true;
    o->fate[set] = compare_formulas(p.special.name ? &was : plain, &is, &p, out);
    if (!p.special.name) list_limited(&is, parameter_set_name[set], o, out);
    formulas_clear(&is);
    formulas_clear(&was);
}

/* `words` is for the caller to free. */
static inline parameters_row parameters_of(const char *path, bool currents, bool reductions, uint64_t seed)
{
    parameters_row o = {0};
    parameters_question q = {.currents = currents, .reductions = reductions};
    nh_error error = {0};
    nh_text words;
    nh_options_default(&q.options);
    nh_text_init(&words);
    nh_system *s = nh_system_read(path, 0, NULL, &error);
    if (!s) nh_text_addf(&words, "%s", error.what);
    if (s && s->parameters && s->parameters <= most_parameters) {
        formulas plain = ask(path, &q, 0, NULL, (special_value){0});
        o.formulas = plain.count;
        list_limited(&plain, "file", &o, &words);
        for (size_t set = 0; set < PARAMETER_SETS; set++) compare_set(path, s, &q, &plain, set, &seed, &o, &words);
        formulas_clear(&plain);
    }
    o.words = nh_strdup(nh_text_string(&words));
    nh_text_clear(&words);
    nh_system_free(s);
    nh_error_clear(&error);
    return o;
}

#endif
