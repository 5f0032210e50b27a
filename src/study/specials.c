#include "study/specials.h"

#include <math.h>
#include <string.h>

#include "noether/recognise.h"
#include "system/sample.h"

enum { search_points = 128, most_symbols = 12, most_values = 12, extra_sets = 4 };

/* ---- parameters and sums of parameters (J + m a^2) that values may be monomials of ---- */

static bool parametric_sum(const nh_model *o, nh_ex e)
{
    if (nh_kind_of(o->dag, e) != NH_SUM) return false;
    for (size_t j = 0; j < o->width; j++)
        if (nh_depends(o->dag, e, o->chart->symbol[j])) return false;
    return true;
}

static void harvest(const nh_model *o, nh_ex e, nh_ex *list, size_t *count)
{
    nh_dag *d = o->dag;
    if (*count == most_symbols) return;
    if (parametric_sum(o, e)) {
        for (size_t i = 0; i < *count; i++)
            if (list[i] == e) return;
        list[(*count)++] = e;
        return;
    }
    nh_kind kind = nh_kind_of(d, e);
    if (kind == NH_SYMBOL || kind == NH_NUMBER) return;
    for (size_t i = 0; i < nh_arity(d, e); i++) harvest(o, nh_child(d, e, i), list, count);
}

static size_t atoms(const nh_model *o, nh_ex *list)
{
    size_t count = 0;
    for (size_t i = 0; i < o->system->parameters && count < most_symbols; i++)
        if (o->parameter_value[i] > 0) list[count++] = o->parameter[i];
    for (size_t i = 0; i < o->n * o->n; i++) harvest(o, o->M[i], list, &count);
    for (size_t i = 0; i < o->n; i++) harvest(o, o->a[i], list, &count);
    return count;
}

/* ---- one value followed over several parameter sets ---- */

typedef struct {
    size_t sets, atoms;
    double *parameter; /* sets x parameters */
    double *atom;      /* sets x atoms */
} sets;

static sets make_sets(const nh_model *o, size_t n, const nh_ex *atom, uint64_t seed)
{
    size_t p = o->system->parameters;
    sets s = {.sets = n + 2 + extra_sets, .atoms = n};
    s.parameter = nh_alloc_array(s.sets * p + 1, sizeof *s.parameter);
    s.atom = nh_alloc_array(s.sets * n + 1, sizeof *s.atom);
    for (size_t k = 0; k < s.sets; k++) {
        double *value = s.parameter + k * p;
        for (size_t i = 0; i < p; i++) value[i] = o->parameter_value[i] * (k ? 1 + 0.2 * (nh_random(&seed) - 0.5) : 1);
        nh_tape *tape = nh_tape_create(o->dag, 0, NULL, n, atom, p, o->parameter, value);
        nh_tape_work *work = nh_tape_work_create(tape);
        nh_tape_eval(tape, work, NULL, s.atom + k * n);
        nh_tape_work_free(work);
        nh_tape_free(tape);
    }
    return s;
}

static void clear_sets(sets *s)
{
    nh_free(s->parameter);
    nh_free(s->atom);
}

/* The hit's value as a monomial of parameters, from the pencil at perturbed parameters; else a simple number; else 0. */
static nh_ex recognise(const nh_result *r, const nh_points *points, size_t families, const nh_family *family, const nh_unknown *u,
                       const nh_hits *hits, size_t which)
{
    const nh_model *o = r->model;
    nh_ex atom[most_symbols], found = 0;
    size_t n = atoms(o, atom);
    sets s = make_sets(o, n, atom, (uint64_t)r->options.seed + 5);
    double *value = nh_alloc_array(s.sets, sizeof *value), list[most_values];
    bool good = hits->pencil_applied && o->chart->implicit == 0, applied;
    nh_unknown wide = {u->symbol, 0, HUGE_VAL};
    for (size_t k = 0; k < s.sets && good; k++) {
        nh_model changed = *o; /* the same geometry at other parameter values: tapes bind them */
        changed.parameter_value = s.parameter + k * o->system->parameters;
        size_t count = nh_unknowns_pencil(&changed, points, families, family, &wide, &r->options, most_values, list, &applied);
        double target = k == 0 ? hits->hit[which].value[0] : value[0], best = HUGE_VAL;
        for (size_t i = 0; i < count; i++) /* the nearest value: parameters changed by at most ten percent */
            if (fabs(list[i] - target) < best) {
                best = fabs(list[i] - target);
                value[k] = list[i];
            }
        good = count > 0;
    }
    bool named = good && nh_recognise_monomial(o->dag, s.sets, n, atom, s.atom, value, 1e-8, &found);
    if (!named && !nh_recognise_number(o->dag, hits->hit[which].value[0], r->options.recognise, &found)) found = 0;
    nh_free(value);
    clear_sets(&s);
    return found;
}

static void name_values(nh_result *r, const nh_points *points, size_t families, const nh_family *family)
{
    const nh_hits *h = r->hits;
    r->special = nh_arena_alloc(r->arena, (h->count + 1) * sizeof *r->special);
    r->specials = h->count;
    for (size_t k = 0; k < h->count; k++) {
        nh_ex *named = nh_arena_alloc(r->arena, (h->unknowns + 1) * sizeof *named);
        for (size_t j = 0; j < h->unknowns; j++) {
            if (h->unknowns == 1) named[j] = recognise(r, points, families, family, &r->analysis->unknown[0], h, k);
            else if (!nh_recognise_number(r->model->dag, h->hit[k].value[j], r->options.recognise, &named[j])) named[j] = 0;
        }
        r->special[k] = (nh_special){h->hit[k].value, named, &h->hit[k]};
    }
}

/* Families without unknowns stay; the others are repeated with each value. */
static void expand(nh_result *r, size_t *families, nh_family **family)
{
    const nh_analysis *a = r->analysis;
    nh_dag *d = r->model->dag;
    nh_family *out = nh_arena_alloc(r->arena, (*families * (1 + r->specials) + 1) * sizeof *out);
    nh_ex *from = nh_arena_alloc(r->arena, (a->unknowns + 1) * sizeof *from), *to = nh_arena_alloc(r->arena, (a->unknowns + 1) * sizeof *to);
    size_t n = 0;
    for (size_t j = 0; j < a->unknowns; j++) from[j] = a->unknown[j].symbol;
    for (size_t i = 0; i < *families; i++) {
        bool contains = false;
        for (size_t j = 0; j < a->unknowns; j++) contains |= nh_family_contains(r->model, &(*family)[i], from[j]);
        if (!contains) out[n++] = (*family)[i];
        for (size_t k = 0; k < r->specials && contains; k++) {
            for (size_t j = 0; j < a->unknowns; j++)
                to[j] = r->special[k].recognised[j] ? r->special[k].recognised[j] : nh_real(d, r->special[k].value[j]);
            out[n++] = nh_family_substitute(r->arena, d, &(*family)[i], a->unknowns, from, to);
        }
    }
    *families = n;
    *family = out;
}

bool nh_specials_find(nh_result *r, size_t *families, nh_family **family, nh_error *error)
{
    if (!r->analysis || r->analysis->unknowns == 0) return true;
    const nh_analysis *a = r->analysis;
    nh_points *points = nh_points_create(r->model, search_points, 1, (uint64_t)r->options.seed + 404, error);
    if (!points) return false;
    r->hits = nh_unknowns_find(r->model, points, *families, *family, a->unknowns, a->unknown, &r->options, error);
    if (r->hits) {
        name_values(r, points, *families, *family);
        expand(r, families, family);
        for (size_t k = 0; k < r->specials; k++)
            if (r->hits->pencil_applied && !(r->special[k].hit->by_pencil && r->special[k].hit->by_search))
                nh_result_warn(r, "the value %.12g of an unknown was found by the %s only", r->special[k].value[0],
                               r->special[k].hit->by_pencil ? "eigenvalue pencil" : "global search");
    }
    nh_points_free(points);
    return r->hits != NULL;
}
