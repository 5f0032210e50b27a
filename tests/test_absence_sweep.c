/* resonance and darboux over the shipped systems: neither claims fewer integrals than the files know. */
#include <criterion/criterion.h>

#include "absence/darboux.h"
#include "absence/rational_value.h"
#include "absence/resonance.h"
#include "integrals/independence.h"
#include "mechanics.h"
#include "sweep.h"

enum { generic_points = 24, most_currents = 40 };

/* The known integrals of the file that are functions of the shape's letters alone. */
static size_t known_of(const nh_closed_shape *shape, nh_ex *out)
{
    const nh_model *model = shape->model;
    size_t n = 0;
    for (size_t i = 0; i < model->system->currents && n < most_currents; i++) {
        nh_ex e = 0;
        nh_error error = {0};
        if (!nh_analysis_file_to_chart(model, model->system->current[i].value, &e, &error)) continue;
        bool inside = !nh_depends(model->dag, e, model->system->t);
        for (size_t k = 0; k < shape->left && inside; k++) inside = !nh_depends(model->dag, e, shape->left_out[k]);
        if (inside) out[n++] = e;
    }
    return n;
}

static size_t independent_of(const nh_model *model, const nh_points *generic, size_t n, const nh_ex *phi)
{
    nh_independence kind[most_currents];
    size_t count = 0;
    if (n) nh_independence_test(model, generic, n, phi, NULL, 1e-6, 1e-9, kind, NULL);
    for (size_t i = 0; i < n; i++) count += kind[i] == NH_INDEPENDENT;
    return count;
}

typedef struct {
    size_t states, sharp, homogeneous;
} totals;

static void try_system(const char *name, totals *total)
{
    char path[300];
    nh_error error = {0};
    snprintf(path, sizeof path, "systems/%s.yaml", name);
    mechanics x = mechanics_of_file(path, NH_CHART_AUTO, 0, NULL);
    nh_arena *arena = nh_arena_create();
    nh_closed_shape *shape = nh_closed_shape_of(arena, x.model);
    nh_points *generic = nh_points_create(x.model, generic_points, 1, 7, &error);
    must(generic != NULL, &error, name);
    nh_resonance **found;
    size_t n = nh_resonance_find(arena, shape, &found);
    nh_darboux *darboux = nh_darboux_of(arena, shape);
    nh_ex known[most_currents], analytic[most_currents];
    size_t integrals = known_of(shape, known);
    for (size_t i = 0; i < n; i++) {
        nh_rational_value_place place = {.dag = x.model->dag, .count = shape->count, .symbol = shape->letter, .value = found[i]->value};
        size_t count = 0;
        for (size_t k = 0; k < integrals; k++) {
            nh_ex e = nh_model_values(x.model, known[k]);
            if (nh_rational_value_analytic(&place, e)) analytic[count++] = known[k];
        }
        count = independent_of(x.model, generic, count, analytic);
        cr_expect_leq(count, found[i]->at_most, "%s at %s: at most %zu, and %zu are known", name, found[i]->point, found[i]->at_most, count);
        total->states++, total->sharp += count == found[i]->at_most;
    }
    total->homogeneous += darboux->applies;
    if (darboux->refuted && darboux->coordinates == 2)
        cr_expect_leq(independent_of(x.model, generic, integrals, known), 1U, "%s: %s", name, darboux->refutation.point);
    nh_points_free(generic);
    nh_arena_free(arena);
    mechanics_clear(&x);
}

Test(absence, sweep)
{
    char *name[most_files];
    totals total = {0};
    size_t n = list("systems", name), tried = 0;
    cr_assert_gt(n, 60U);
    for (size_t i = 0; i < n; i++) {
        if (sweep_tries(i, 1, 9)) tried++, try_system(name[i], &total);
        free(name[i]);
    }
    if (tried < n) return;
    cr_expect(total.states > 100 && total.sharp > 30 && total.homogeneous > 3, "%zu states of rest, %zu of them with as many integrals as can be; %zu homogeneous potentials",
              total.states, total.sharp, total.homogeneous);
}
