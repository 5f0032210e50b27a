/* Fields are fitted first: their rows are the constraint Noether equations as these are written, textbook systems by fields alone, the routes of a user, and the order and signs of a source. */
#include "mechanics.h"
#include "analysed.h"

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "integrals/ansatz.h"
#include "integrals/field_rows.h"
#include "integrals/symmetry.h"

static const char SKATE[] = "name: skate\nparameters: [{name: m, value: 1.3}, {name: J, value: 0.7}]\ncoordinates: [{name: x}, {name: y}, {name: h, type: angle}]\n"
                            "lagrangian: m*(x'^2 + y'^2)/2 + J*h'^2/2 + m*x/5\nconstraints: [\"y'*cos(h) = x'*sin(h)\"]\ndomain: {h: [-1.1, 1.2]}\n",
                  BELT[] = "name: belt\nparameters: [{name: V, value: 0.6}]\ncoordinates: [{name: x}, {name: y}, {name: h, type: angle}]\n"
                           "lagrangian: (x'^2 + y'^2)/2 + h'^2/3\nconstraints: [\"y'*cos(h) = (x' - V)*sin(h)\"]\ndomain: {h: [-1.1, 1.2]}\n",
                  SPEED[] = "name: speed\ncoordinates: [{name: x}, {name: y}, {name: z}]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - z\nconstraints: [\"z'^2 = x'^2 + y'^2\"]\n"
                            "domain: {x': [1, 2], y': [1, 2], z': [1, 3]}\n",
                  FREE[] = "name: free\nparameters: [{name: k, value: 1.7}]\ncoordinates: [{name: r}, {name: p, type: angle}]\nlagrangian: (r'^2 + r^2*p'^2)/2 - k*r^2/2 + r^2*p'/3\ndomain: {r: [0.5, 2]}\n";

/* The largest difference of a row from (N0), (NY)_j of the field with current Phi and components zeta, written out with M, A, X_0, Y_j. */
static double off_by(const nh_model *o, const nh_field_bases *bases, const nh_ansatz *a, const nh_points *points)
{
    nh_dag *d = o->dag;
    size_t n = o->n, count = points->count, derivations = bases->inclined ? 1 + n : 1, equations = nh_field_rows_equations(o, bases, count);
    double *A = nh_alloc_array(equations * a->columns + 1, sizeof *A), *B = nh_alloc_array(count * a->columns + 1, sizeof *B), worst = 0;
    cr_assert_eq(equations, derivations * count);
    nh_field_rows_all(o, bases, a, 0, points, A, B);
    for (size_t j = 0; j < a->columns; j++) {
        nh_ex phi = nh_ansatz_column(a, j), e[1 + 8], size[1 + 8];
        /* zeta of a product, by M^-1 of the base alone where it has components, and the other factors */
        nh_ex zeta[8];
        for (size_t i = 0; i < n; i++) zeta[i] = nh_int(d, 0);
        for (size_t f = 0; f < a->column[j].count; f++) {
            nh_ex rest = nh_int(d, 1);
            for (size_t g = 0; g < a->column[j].count; g++)
                if (g != f) rest = nh_mul(d, rest, a->factor[a->column[j].factor[g]]);
            for (size_t b = 0; b < bases->count; b++)
                for (size_t i = 0; i < n && bases->base[b].phi == a->factor[a->column[j].factor[f]]; i++) zeta[i] = nh_add(d, zeta[i], nh_mul(d, rest, bases->base[b].zeta[i]));
        }
        e[0] = nh_model_X0(o, phi);
        size[0] = e[0];
        for (size_t i = 0; i < n; i++) e[0] = nh_add(d, e[0], nh_mul(d, o->A[i], zeta[i]));
        for (size_t q = 0; q < n; q++) {
            e[1 + q] = size[1 + q] = nh_model_Y(o, q, phi);
            for (size_t i = 0; i < n; i++) e[1 + q] = nh_sub(d, e[1 + q], nh_mul(d, o->M[i * n + q], zeta[i]));
        }
        double *value = nh_alloc_array(2 * (1 + n) * count, sizeof *value);
        nh_points_evaluate(points, o, 1 + n, e, value);
        nh_points_evaluate(points, o, 1 + n, size, value + (1 + n) * count);
        for (size_t q = 0; q <= n; q++)
            for (size_t p = 0; p < count; p++) {
                double own = value[q * count + p], scale = 1 + fabs(value[(1 + n + q) * count + p]),
                       row = q < derivations ? A[j * equations + q * count + p] / points->weight[p] : 0; /* without rows: an identity */
                worst = fmax(worst, fabs(own - row) / scale);
            }
        nh_free(value);
    }
    nh_free(A);
    nh_free(B);
    return worst;
}

Test(fields, rows_are_the_noether_equations_as_they_are_written)
{
    static const char *const systems[] = {FREE, SKATE, BELT, SPEED};
    for (size_t s = 0; s < sizeof systems / sizeof *systems; s++) {
        nh_error error = {0};
        mechanics x = mechanics_of_text(systems[s], NH_CHART_AUTO);
        nh_model *o = x.model;
        nh_dag *d = o->dag;
        nh_field_bases bases = nh_field_rows_bases(o);
        cr_expect_eq(bases.inclined, systems[s] == SPEED, "%s", x.system->name);
        nh_ex base[8], function[4] = {nh_int(d, 1), o->system->t, o->system->coordinate[0].q, nh_call(d, NH_SIN, o->system->coordinate[1].q)};
        for (size_t b = 0; b < bases.count; b++) base[b] = bases.base[b].phi;
        nh_family all = {.kind = NH_TERMS, .terms = bases.count, .term = base}, times = {.kind = NH_TERMS, .terms = 4, .term = function};
        nh_family part[3] = {all, all, times}, family[2] = {{.kind = NH_FAMILY_PRODUCT, .parts = 3, .part = part}, {.kind = NH_FAMILY_PRODUCT, .parts = 2, .part = part + 1}};
        nh_points *points = nh_points_create(o, 60, 1, 1, &error);
        nh_ansatz *a = nh_ansatz_create(o, points, 2, family, 300, &error);
        must(points && a, &error, x.system->name);
        double off = off_by(o, &bases, a, points);
        cr_expect(off < 1e-12, "%s: the rows are off by %.1e", x.system->name, off);
        nh_ansatz_free(a);
        nh_points_free(points);
        mechanics_clear(&x);
    }
}

/* The analysis by one route, without an analysis file unless one is given. */
static nh_analysis *by(const char *system, const char *question, const char *route)
{
    nh_error error = {0};
    nh_request q = {.system_path = system, .analysis_path = question, .route = route};
    nh_options_default(&q.options);
    q.options.max_seconds = 1e6;
    nh_analysis *r = nh_analysis_create(&q, &error);
    must(r != NULL, &error, system);
    return r;
}

/* What a textbook has for these systems, by fields alone: how many independent currents, all of them proved. */
Test(fields, fields_alone_find_what_textbooks_have)
{
    static const struct {
        const char *system;
        size_t currents; /* Goldstein, Poole, Safko 2002; Landau, Lifshitz 1976; of rolling bodies: energy, spin, moving energy */
    } cases[] = {{"kepler", 5}, {"free_particle", 6}, {"spherical_pendulum", 2}, {"lagrange_top", 3}, {"projectile", 4}, {"pendulum", 1}, {"ball_on_turntable", 2}, {"charged_particle", 4}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char path[80];
        snprintf(path, sizeof path, "systems/%s.yaml", cases[i].system);
        nh_analysis *r = by(path, NULL, "fields");
        size_t proved = 0;
        for (size_t k = 0; k < r->list->count; k++) proved += r->list->found[k].proof.proved && r->list->found[k].independence == NH_INDEPENDENT;
        cr_expect(proved >= cases[i].currents, "%s: %zu, not %zu", cases[i].system, proved, cases[i].currents);
        for (size_t k = 0; k < r->list->count; k++)
            cr_expect(!r->list->found[k].has_symmetry || r->list->found[k].symmetry.noether_residual < 1e-8, "%s: %.1e", cases[i].system, r->list->found[k].symmetry.noether_residual);
        cr_expect(!r->counted_space.compared || r->counted_space.angle < 1e-8, "%s: angle %.1e", cases[i].system, r->counted_space.angle);
        nh_analysis_free(r);
    }
}

/* The three currents of [CechMusilova2014, sec. 4.2] by a fit of fields, in their order and with their signs; and by each route the same number of them. */
Test(fields, the_sleigh_has_its_three_currents_by_every_route)
{
    static const char *const routes[] = {"fields", "currents", "both"}, *const names[] = {"Phi1", "Phi2", "Phi3"};
    for (size_t i = 0; i < 3; i++) {
        nh_analysis *r = by("systems/sleigh.yaml", "analyses/sleigh.yaml", routes[i]);
        nh_model *o = r->question->model;
        cr_assert_geq(r->list->count, 3);
        cr_expect_eq(r->symmetry.done, i != 1, "%s", routes[i]);
        for (size_t k = 0; k < 3; k++) {
            const nh_named *known = &r->question->system->current[k == 2 ? 3 : k];
            nh_ex own;
            nh_error error = {0};
            must(nh_analysis_file_to_chart(o, known->value, &own, &error), &error, known->name);
            cr_expect_str_eq(r->list->found[k].name, names[k], "%s", routes[i]);
            cr_expect(nh_normal_is_zero(o->dag, nh_sub(o->dag, r->list->found[k].phi, own), 0) == NH_ZERO, "%s: %s is another multiple", routes[i], names[k]);
            for (int e = 0; e < 3; e++) cr_expect_lt(r->list->found[k].symmetry.off[e], 1e-11);
        }
        nh_analysis_free(r);
    }
}

/* nu = 1/k without a file: the pencil over the momenta has it as a letter. */
Test(fields, the_pencil_over_momenta_finds_the_frequency_of_the_sleigh)
{
    nh_analysis *r = by("systems/sleigh.yaml", NULL, "fields");
    nh_model *o = r->question->model;
    nh_ex own;
    nh_error error = {0};
    must(nh_analysis_file_to_chart(o, r->question->system->current[1].value, &own, &error), &error, "Phi2");
    bool there = false;
    for (size_t k = 0; k < r->list->count; k++)
        there |= r->list->found[k].proof.all_parameters && nh_normal_is_zero(o->dag, nh_sub(o->dag, r->list->found[k].phi, own), 0) == NH_ZERO;
    cr_expect(there, "Phi2 is not among the %zu found for all k", r->list->count);
    nh_analysis_free(r);
}

Test(fields, a_word_that_is_no_route_is_told)
{
    nh_error error = {0};
    nh_route route = NH_ROUTE_BOTH;
    cr_expect(nh_analysis_file_route("symmetry", &route, &error) && route == NH_ROUTE_FIELDS);
    cr_expect(nh_analysis_file_route("currents", &route, &error) && route == NH_ROUTE_CURRENTS);
    cr_expect(!nh_analysis_file_route("field", &route, &error));
    cr_expect(strstr(error.hint, "fields"), "%s", error.hint);
}

/* x' is the momentum of a particle that is free for x < 0, and of no use for x > 0: the map of its residual says so point by point. */
Test(fields, a_map_of_the_residual_shows_where_a_function_is_conserved)
{
    char system[SCRATCH], question[SCRATCH];
    cr_assert(scratch_text(system, "name: ramp\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (x + abs(x))*(x*y^2 + y^4 + x^3)\n"));
    cr_assert(scratch_text(question, "name: map\nsystem: ramp\nfigures: [{residual: [x, y], of: x'}]\n"));
    nh_error error = {0};
    nh_request q = {.system_path = system, .analysis_path = question, .documents = true};
    nh_options_default(&q.options);
    nh_analysis *r = nh_analysis_create(&q, &error);
    must(r != NULL, &error, "the map");
    cr_assert_eq(r->figures, 1);
    size_t small = 0, large = 0;
    for (size_t k = 0; k < r->figure[0].curves; k++) {
        const nh_figure_curve *c = &r->figure[0].curve[k];
        bool held = !strcmp(c->name, "below 1e-12");
        for (size_t p = 0; p < c->count; p++) {
            cr_expect_eq(held, c->x[p] < 0, "%s at x = %g", c->name, c->x[p]);
            small += held, large += !held;
        }
    }
    cr_expect(small > 500 && large > 500, "%zu, %zu", small, large);
    nh_analysis_free(r);
    remove(system);
    remove(question);
}
