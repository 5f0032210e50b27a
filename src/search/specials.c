#include "search/specials.h"

#include <math.h>
#include <string.h>

#include "graph/dag.h"
#include "integrals/recognise.h"
#include "search/naming.h"

enum { search_points = 128, most_values = 12 };

/* The pencil at other parameter values. */
typedef struct {
    const nh_analysis *r;
    const nh_points *points;
    size_t families;
    const nh_family *family;
    nh_unknown unknown;
} pencil_context;

static bool follow(const nh_model *changed, double near, double *value, void *context)
{
    const pencil_context *c = context;
    double list[most_values], best = HUGE_VAL;
    bool applied;
    size_t count = nh_unknowns_pencil(changed, c->points, c->families, c->family, &c->unknown, &c->r->question->options,
                                      most_values, list, &applied);
    for (size_t i = 0; i < count; i++)
        if (fabs(list[i] - near) < best) {
            best = fabs(list[i] - near);
            *value = list[i];
        }
    return count > 0;
}

static nh_ex recognise(const nh_analysis *r, const nh_points *points, size_t families, const nh_family *family,
                       const nh_unknown *u, const nh_hits *hits, size_t which)
{
    pencil_context c = {r, points, families, family, {u->symbol, 0, HUGE_VAL}};
    return nh_name_value(r->question->model, hits->hit[which].value[0], follow, &c, r->question->options.recognise,
                         (uint64_t)r->question->options.seed);
}

static void name_values(nh_analysis *result, const nh_points *points, size_t families, const nh_family *family)
{
    const nh_hits *h = result->hits;
    result->special = nh_arena_alloc(result->arena, (h->count + 1) * sizeof *result->special);
    result->specials = h->count;
    for (size_t k = 0; k < h->count; k++) {
        nh_ex *named = nh_arena_alloc(result->arena, (h->unknowns + 1) * sizeof *named);
        for (size_t j = 0; j < h->unknowns; j++) {
            if (h->unknowns == 1)
                named[j] = recognise(result, points, families, family, &result->question->analysis->unknown[0], h, k);
            else if (!nh_recognise_number(result->question->model->dag, h->hit[k].value[j],
                                          result->question->options.recognise, &named[j]))
                named[j] = 0;
        }
        result->special[k] = (nh_special){h->hit[k].value, named, &h->hit[k]};
    }
}

/* Families without unknowns stay; the others are repeated with each value. */
static void expand(nh_analysis *result, size_t *families, nh_family **family)
{
    const nh_analysis_file *a = result->question->analysis;
    nh_dag *d = result->question->model->dag;
    nh_family *out = nh_arena_alloc(result->arena, (*families * (1 + result->specials) + 1) * sizeof *out);
    nh_ex *from = nh_arena_alloc(result->arena, (a->unknowns + 1) * sizeof *from),
          *to = nh_arena_alloc(result->arena, (a->unknowns + 1) * sizeof *to);
    size_t n = 0;
    for (size_t j = 0; j < a->unknowns; j++) from[j] = a->unknown[j].symbol;
    for (size_t i = 0; i < *families; i++) {
        bool contains = false;
        for (size_t j = 0; j < a->unknowns; j++)
            contains |= nh_family_contains(result->question->model, &(*family)[i], from[j]);
        if (!contains) out[n++] = (*family)[i];
        for (size_t k = 0; k < result->specials && contains; k++) {
            for (size_t j = 0; j < a->unknowns; j++)
                to[j] = result->special[k].recognised[j] ? result->special[k].recognised[j]
                                                         : nh_real(d, result->special[k].value[j]);
            out[n++] = nh_family_substitute(result->arena, d, &(*family)[i], a->unknowns, from, to);
        }
    }
    *families = n;
    *family = out;
}

bool nh_specials_find(nh_analysis *result, size_t *families, nh_family **family, nh_error *error)
{
    if (!result->question->analysis || result->question->analysis->unknowns == 0) return true;
    const nh_analysis_file *a = result->question->analysis;
    nh_points *points = nh_points_create(result->question->model, search_points, 1,
                                         (uint64_t)result->question->options.seed + 404, error);
    if (!points) return false;
    result->hits = nh_unknowns_find(result->question->model, points, *families, *family, a->unknowns, a->unknown,
                                    &result->question->options, error);
    if (result->hits) {
        name_values(result, points, *families, *family);
        expand(result, families, family);
        for (size_t k = 0; k < result->specials; k++)
            if (result->hits->pencil_applied &&
                !(result->special[k].hit->by_pencil && result->special[k].hit->by_search))
                nh_analysis_warn(result, "the value %.12g of an unknown was found by the %s only",
                                 result->special[k].value[0],
                                 result->special[k].hit->by_pencil ? "eigenvalue pencil" : "global search");
    }
    nh_points_free(points);
    return result->hits != NULL;
}

void nh_specials_name(nh_analysis *result, const nh_letters *letters)
{
    static const double same = 1e-7; /* a search knows fewer digits of a value than the current that it leads to */
    for (size_t k = 0; k < result->specials; k++)
        for (size_t j = 0; j < result->hits->unknowns; j++)
            for (size_t i = 0; i < letters->count; i++) {
                double value = result->special[k].value[j], size = fabs(value);
                if (!(fabs(size - letters->value[i]) <= same * size)) continue;
                result->special[k].recognised[j] =
                    value < 0 ? nh_neg(result->question->model->dag, letters->name[i]) : letters->name[i];
            }
}
