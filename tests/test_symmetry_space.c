/* The space of constraint symmetries, and which currents can have better ones: its parts against computations of another kind, and what --equations prints. */
#include <cjson/cJSON.h>
#include <math.h>

#include "integrals/bracket.h"
#include "geometry/closure.h"
#include "integrals/symmetry.h"
#include "exact/relation_space.h"
#include "graph/dag.h"
#include "mechanics.h"
#include "program.h"
#include "sweep.h"

/* ---- relations among columns ---- */

static nh_relation_space *space_of(nh_arena *arena, const nh_model *o, size_t columns, size_t rows, const char *const *text)
{
    nh_ex *entry = nh_arena_alloc(arena, columns * rows * sizeof *entry);
    for (size_t i = 0; i < columns * rows; i++) entry[i] = formula(o, text[i]);
    return nh_relation_space_of(arena, &(nh_relation_columns){.dag = o->dag, .columns = columns, .rows = rows, .entry = entry, .variables = 1 + o->m + o->n, .variable = o->chart->symbol,
                                                              .parameters = o->system->parameters, .parameter = o->parameter});
}

static const char BEAD[] = "name: bead\nparameters: [{name: m, value: 2}, {name: k, value: 3}]\ncoordinates: [{name: f, type: angle}, {name: x, type: length}]\n"
                           "lagrangian: m/2*(x'^2 + f'^2)\n";

Test(symmetry_space, relations_with_parameters_are_all_found_and_hold)
{
    mechanics x = mechanics_of_text(BEAD, NH_CHART_COORDINATES);
    const nh_model *o = x.model;
    nh_arena *arena = nh_arena_create();
    const char *sums[] = {"1", "x", "sin(f)^2", "k*x - m*sin(f)", "cos(f)^2", "sin(f)", "x'*f'", "exp(x)"};
    nh_relation_space *s = space_of(arena, o, 8, 1, sums);
    cr_assert_null(s->obstacle);
    cr_expect_eq(s->bound, 2, "%zu", s->bound);
    cr_expect_eq(s->proved, 2);
    for (size_t i = 0; i < s->proved; i++) { /* in numbers, at some point */
        double z[5] = {0.3, 0.7, -1.3, 0.9, 1.7}, sum = 0;
        for (size_t j = 0; j < 8; j++) sum += value_at(o, s->coefficient[i * 8 + j], z) * value_at(o, formula(o, sums[j]), z);
        cr_expect_lt(fabs(sum), 1e-13);
    }
    const char *pairs[] = {"x", "f", "k*x", "k*f", "x", "x*f", "x + x*f/m", "f + x*f/m"}; /* two rows each: the second column is k times the first */
    s = space_of(arena, o, 4, 2, pairs);
    cr_expect_eq(s->bound, 1);
    cr_expect_eq(s->proved, 1);
    cr_expect_float_eq(value_at(o, s->coefficient[0], (double[5]){0}), -3, 1e-15);
    cr_expect_float_eq(value_at(o, s->coefficient[1], (double[5]){0}), 1, 1e-15);
    nh_arena_free(arena);
    mechanics_clear(&x);
}

/* ---- ranks of brackets ---- */

static nh_closure closure_of(const nh_model *o, size_t count, const char *const *text, const char *known)
{
    size_t width = 1 + o->m + o->n;
    nh_ex *field = nh_alloc_array(count * width + 1, sizeof *field), function = known ? formula(o, known) : 0;
    for (size_t i = 0; i < count * width; i++) field[i] = formula(o, text[i]);
    nh_closure c = nh_closure_of(o, count, field, known != NULL, &function);
    nh_free(field);
    return c;
}

Test(symmetry_space, ranks_of_brackets_that_are_known)
{
    mechanics x = mechanics_of_text(BEAD, NH_CHART_COORDINATES); /* t, f, x, f', x' */
    const nh_model *o = x.model;
    const char *heisenberg[] = {"0", "1", "0", "0", "0", /**/ "0", "0", "1", "f", "0"}; /* with their bracket d/df': three */
    const char *commuting[] = {"1", "0", "0", "0", "0", /**/ "0", "k*cos(f)", "0", "0", "0"};
    const char *engel[] = {"0", "1", "0", "0", "0", /**/ "0", "0", "1", "f", "f^2"}; /* four */
    const char *turned[] = {"0", "-x*m", "m*f", "0", "0", /**/ "0", "0", "0", "-x'", "f'"}; /* two rotations */
    cr_expect_eq(closure_of(o, 2, heisenberg, NULL).rank, 3);
    cr_expect_eq(closure_of(o, 2, commuting, NULL).rank, 2);
    cr_expect_eq(closure_of(o, 2, engel, NULL).rank, 4);
    nh_closure c = closure_of(o, 2, turned, "f^2 + x^2");
    cr_expect_eq(c.rank, 2);
    cr_expect_eq(c.known, 1);
    cr_expect_eq(c.dimension, 5);
    mechanics_clear(&x);
}

/* ---- the fields against the brackets ---- */

static const char SKATE[] = /* on a slope, heavy at one side */
    "name: skate\nparameters: [{name: m, value: 2}, {name: J, value: 0.5}, {name: b, value: 3}]\n"
    "coordinates: [{name: f, type: angle}, {name: x, type: length}, {name: y, type: length}]\n"
    "lagrangian: m/2*(x'^2 + y'^2) + J/2*f'^2 + m*b*x\nconstraints: [\"y'*cos(f) = x'*sin(f)\"]\n";
static const char TURNED[] = /* affine, and the mass matrix depends on positions */
    "name: turned\nparameters: [{name: W, value: 0.7}]\ncoordinates: [{name: x, type: length}, {name: y, type: length}, {name: z, type: length}]\n"
    "lagrangian: (x'^2*(1 + x^2) + y'^2 + z'^2)/2\nconstraints: [\"z' = y*x' + W\"]\n";
static const char SPEED[] = /* nonlinear */
    "name: speed\nparameters: [{name: g, value: 1.5}, {name: c, value: 2}]\ncoordinates: [{name: x, type: length}, {name: y, type: length}, {name: z, type: length}]\n"
    "lagrangian: (x'^2 + y'^2 + z'^2)/2 - g*z\nconstraints: [\"x' = sqrt(c^2 - y'^2 - z'^2)\"]\n";

/* [Gamma, Z] - Gamma(Z^0) Gamma of a current by the definition, against V(Phi), and i_[Gamma,Z] phi^a against U_a(Phi). */
static void compare(const char *text, const char *current)
{
    mechanics x = mechanics_of_text(text, NH_CHART_COORDINATES);
    nh_model *o = x.model;
    nh_arena *arena = nh_arena_create();
    nh_points *points = points_of(o, 40, 3);
    nh_error error;
    nh_error_clear(&error);
    nh_symmetry z;
    nh_ex phi = formula(o, current);
    cr_assert(nh_symmetry_of(o, points, phi, 1e-7, &z, &error), "%s", error.what);
    cr_assert_lt(z.noether_residual, 1e-9, "%s is no current", current);
    const nh_submanifold *s = nh_submanifold_of(arena, o, NULL);
    nh_bracket_fields *f = nh_bracket_fields_of(arena, s);
    double *at = nh_alloc_array(o->width, sizeof *at);
    for (size_t p = 0; p < 10; p++) {
        point_of(points, p, at);
        double rate = value_at(o, nh_model_gamma(o, z.Z0), at), worst = 0, size = 1e-3;
        for (size_t i = 0; i < o->m + o->n; i++) {
            nh_ex by_definition = i < o->m ? nh_sub(o->dag, nh_model_gamma(o, z.field.space[i]), nh_model_along(o, &z.field, o->rho[i]))
                                           : nh_sub(o->dag, nh_model_gamma(o, z.W[i - o->m]), nh_model_along(o, &z.field, o->a[i - o->m]));
            double b = value_at(o, by_definition, at), gamma = value_at(o, i < o->m ? o->rho[i] : o->a[i - o->m], at);
            double V = value_at(o, nh_bracket_fields_apply(o, f->V + i * f->width, phi), at);
            worst = fmax(worst, fabs(b - rate * gamma - V));
            size = fmax(size, fabs(b) + fabs(rate * gamma) + fabs(V));
        }
        cr_expect_lt(worst, 1e-9 * size, "%s: V(%s) is off by %g of %g", o->system->name, current, worst, size);
        for (size_t a = 0; a < o->k; a++) {
            double form = 0;
            for (size_t r = 0; r < o->m; r++)
                form += value_at(o, s->form[a * (1 + o->m) + 1 + r], at) * value_at(o, nh_sub(o->dag, z.bracket.space[r], nh_mul(o->dag, o->rho[r], z.bracket.time)), at);
            double U = value_at(o, nh_bracket_fields_apply(o, f->U + a * f->width, phi), at);
            cr_expect_lt(fabs(U - form), 1e-9 * size, "%s: U(%s) = %g, not %g", o->system->name, current, U, form);
        }
    }
    nh_free(at);
    nh_points_free(points);
    nh_arena_free(arena);
    mechanics_clear(&x);
}

Test(symmetry_space, fields_have_the_components_of_the_brackets)
{
    compare(BEAD, "x - x'*t");
    compare(BEAD, "f'*(x - x'*t)");
    compare(SKATE, "f'");
    compare(SKATE, "J*f'^2/2 + m*(x'^2 + y'^2)/2 - m*b*x");
    compare(SKATE, "f - f'*t");
    compare(TURNED, "y'");
    compare(TURNED, "y - y'*t");
    compare(SPEED, "y'/x'");
    compare(SPEED, "z - c^2/(2*g)*log(y'^2)");
}

/* ---- what is printed ---- */

static char *equations_of(place *p, const char *text, const char *words)
{
    char command[300];
    write_here(p, "s.yaml", text);
    snprintf(command, sizeof command, "analyze s.yaml --equations --json=r.json %s", words);
    finished f = run(p, command);
    cr_assert_eq(f.code, 0, "%s", f.err);
    finished_clear(&f);
    return read_here(p, "r.json");
}

static const cJSON *section_of(const cJSON *root, const char *key) { return cJSON_GetObjectItem(cJSON_GetObjectItem(root, "equations"), key); }

static double number_in(const cJSON *root, const char *section, const char *label)
{
    const cJSON *line;
    cJSON_ArrayForEach(line, section_of(root, section))
    {
        const cJSON *own = cJSON_GetObjectItem(line, "label"), *value = cJSON_GetObjectItem(line, "expression");
        if (cJSON_IsString(own) && !strcmp(own->valuestring, label) && cJSON_IsString(value)) return atof(value->valuestring);
    }
    return -1;
}

static double number_of(const cJSON *root, const char *label) { return number_in(root, "symmetry_space", label); }

static bool says(const cJSON *root, const char *key, const char *words)
{
    const cJSON *line;
    cJSON_ArrayForEach(line, section_of(root, key))
    {
        const cJSON *own = cJSON_GetObjectItem(line, "words");
        if (cJSON_IsString(own) && strstr(own->valuestring, words)) return true;
    }
    return false;
}

/* Every field of a section, called `first` and so on: `verify` calls it a symmetry of that kind. */
static size_t verified(place *p, const cJSON *root, const char *section, const char *first, const char *kind)
{
    size_t count = 0;
    const cJSON *line, *term;
    cJSON_ArrayForEach(line, section_of(root, section))
    {
        const cJSON *label = cJSON_GetObjectItem(line, "label"), *terms = cJSON_GetObjectItem(line, "terms");
        char field[2000] = "";
        if (!terms || !label || strncmp(label->valuestring, first, strlen(first)) || strchr(label->valuestring + 2, '(')) continue;
        cJSON_ArrayForEach(term, terms)
        {
            const char *of = cJSON_GetObjectItem(term, "of")->valuestring; /* d/dx */
            size_t used = strlen(field);
            snprintf(field + used, sizeof field - used, "%s%s=%s", used ? "; " : "", strcmp(of, "d/dt") ? of + 3 : "Z0", cJSON_GetObjectItem(term, "coefficient")->valuestring);
        }
        char *argument[] = {p->program, "verify", "s.yaml", "--field", field, "--of", (char *)kind, NULL};
        finished f = run_vector(p, &(manner){0}, argument);
        cr_expect_eq(f.code, 0, "%s: %s%s", field, f.out, f.err);
        finished_clear(&f);
        count++;
    }
    return count;
}

Test(symmetry_space, of_the_sleigh_only_functions_of_the_energy_have_their_brackets_in_the_distribution, PLAIN_ONLY)
{
    place p = place_with_systems();
    finished f = run(&p, "analyze -v sleigh --set k=3 --equations --json=r.json");
    cr_assert_eq(f.code, 0, "%s", f.err);
    cr_expect(strstr(f.out, "Gamma and U_1 span with their brackets 5 of 6 dimensions"), "%s", f.out);
    finished_clear(&f);
    char *json = read_here(&p, "r.json");
    cJSON *root = cJSON_Parse(json);
    cr_expect(says(root, "bracket_bounds", "So the currents with [Gamma,Z] in the canonical distribution are the functions of Phi1, and no others: proved."));
    cr_expect_eq(number_of(root, "dim"), 9);
    cr_expect_eq(number_of(root, "dim_projectable"), 3);
    cr_expect_eq(number_of(root, "dim_case1"), 2);
    cJSON_Delete(root);
    free(json);
    place_clear(&p);
}

Test(symmetry_space, a_skate_on_a_slope, PLAIN_ONLY)
{
    place p = place_make();
    char *json = equations_of(&p, SKATE, "");
    cJSON *root = cJSON_Parse(json);
    cr_expect(says(root, "symmetry_space", "These numbers are proved."));
    cr_expect_geq(number_of(root, "dim_projectable"), 2); /* d/dt, d/df */
    cr_expect_geq(verified(&p, root, "symmetry_space", "Z(", "constraint"), 2);
    cr_expect(says(root, "bracket_bounds", "proved."));
    cJSON_Delete(root);
    free(json);
    place_clear(&p);
}

/* Roots of numbers have residues modulo some primes alone: a point has to have all of these. */
Test(symmetry_space, roots_of_numbers, WHOLE_ONLY)
{
    static const char *const root_of[] = {"2", "3", "5", "7", "10", "13"};
    for (size_t i = 0; i < sizeof root_of / sizeof *root_of; i++) {
        if (!sweep_tries(i, 2, 6)) continue;
        char text[700];
        place p = place_make();
        snprintf(text, sizeof text, "name: rooted\nparameters: [{name: m, value: 1.2}, {name: J, value: 0.4}]\ncoordinates: [{name: f, type: angle}, {name: x, type: length}, {name: y, type: length}]\n"
                 "lagrangian: m/2*(x'^2 + y'^2) + J/2*f'^2 + sqrt(%s)*m*x*sqrt(2 + sqrt(%s) + x^2)\nconstraints: [\"y'*cos(f) = x'*sin(f)\"]\n", root_of[i], root_of[i]);
        char *json = equations_of(&p, text, "");
        cJSON *root = cJSON_Parse(json);
        cr_expect_not(says(root, "symmetry_space", "regular point"), "root of %s", root_of[i]);
        cr_expect_not(says(root, "bracket_bounds", "regular point"), "root of %s", root_of[i]);
        cr_expect_not(says(root, "equation_symmetries", "regular point"), "root of %s", root_of[i]);
        cr_expect_gt(number_of(root, "dim"), 1, "root of %s", root_of[i]);
        cJSON_Delete(root);
        free(json);
        place_clear(&p);
    }
}

/* x' = e^(-g ..) ..: of the currents y' and z' none has its bracket in the distribution, and a quotient has. */
Test(symmetry_space, a_quotient_of_currents_is_better_than_they_are, PLAIN_ONLY)
{
    place p = place_with_systems();
    finished f = run(&p, "analyze constant_speed --equations --json=r.json --quiet");
    cr_assert_eq(f.code, 0, "%s", f.err);
    finished_clear(&f);
    char *json = read_here(&p, "r.json");
    cJSON *root = cJSON_Parse(json);
    cr_expect(says(root, "bracket_bounds", "^-1 Phi"));
    cr_expect(says(root, "bracket_bounds", "So no current but constants has a field of case 1: proved."));
    cJSON_Delete(root);
    free(json);
    place_clear(&p);
}

/* Without constraints every current has a field of case 1; the free particle's space of degree two in two dimensions. */
Test(symmetry_space, of_unconstrained_systems_everything_is_of_case_1, PLAIN_ONLY)
{
    place p = place_make();
    char *json = equations_of(&p, "name: two\ncoordinates: [{name: x, type: length}, {name: y, type: length}]\nlagrangian: (x'^2 + y'^2)/2\n", "");
    cJSON *root = cJSON_Parse(json);
    cr_expect(says(root, "bracket_bounds", "All V vanish"));
    cr_expect_eq(number_of(root, "dim"), 20, "%g", number_of(root, "dim")); /* as their count says */
    cr_expect(says(root, "symmetry_space", "they are all that there are"));
    cr_expect_eq(number_of(root, "dim"), number_of(root, "dim_case1"));
    cr_expect_geq(verified(&p, root, "symmetry_space", "Z(", "constraint"), 3);
    cJSON_Delete(root);
    free(json);
    place_clear(&p);
}

/* ---- symmetries of the equations of motion ---- */

static void point_symmetries(const char *text, double points, double dynamical)
{
    place p = place_make();
    char *json = equations_of(&p, text, "");
    cJSON *root = cJSON_Parse(json);
    cr_expect(says(root, "equation_symmetries", "all that there are of this form: proved"), "%s", text);
    cr_expect_eq(number_in(root, "equation_symmetries", "dim_point"), points, "%s: %g", text, number_in(root, "equation_symmetries", "dim_point"));
    cr_expect_eq(number_in(root, "equation_symmetries", "dim_dynamical"), dynamical, "%s: %g", text, number_in(root, "equation_symmetries", "dim_dynamical"));
    cr_expect_eq((double)verified(&p, root, "equation_symmetries", "S_", "equations"), points + dynamical);
    cJSON_Delete(root);
    free(json);
    place_clear(&p);
}

#define LINE(L) "name: line\nparameters: [{name: k, value: 3}]\ncoordinates: [{name: x, type: length}]\ndomain: {x: [0.5, 2]}\nlagrangian: " L "\n"

/* Lie's numbers for equations of second order: 8, 3, 2. */
Test(symmetry_space, point_symmetries_of_one_equation, PLAIN_ONLY)
{
    point_symmetries(LINE("x'^2/2"), 8, 0);
    point_symmetries(LINE("x'^2/2 - k/x^2"), 3, 0);
    point_symmetries(LINE("x'^2/2 - k*x^4"), 2, 0);
    point_symmetries(LINE("x'^2/2 - k*x^4 + x^3"), 1, 0);
}

/* Shifts, a turn, two scalings; and a shift across the blade: parallel curves are motions as well. On a slope turns and one scaling are gone. */
Test(symmetry_space, point_symmetries_of_skates, WHOLE_ONLY)
{
    point_symmetries("name: skate\nparameters: [{name: m, value: 2}, {name: J, value: 0.5}]\ncoordinates: [{name: f, type: angle}, {name: x, type: length}, {name: y, type: length}]\n"
                     "lagrangian: m/2*(x'^2 + y'^2) + J/2*f'^2\nconstraints: [\"y'*cos(f) = x'*sin(f)\"]\n", 7, 0);
    point_symmetries(SKATE, 5, 0);
}

static char *line_of(const cJSON *root, const char *label)
{
    const cJSON *line;
    cJSON_ArrayForEach(line, section_of(root, "equation_symmetries"))
        if (cJSON_GetObjectItem(line, "label") && !strcmp(cJSON_GetObjectItem(line, "label")->valuestring, label)) return cJSON_GetObjectItem(line, "expression")->valuestring;
    return "";
}

/* A turn makes of one current of the sleigh the other one; none of both fields is a symmetry of the equations of motion. */
Test(symmetry_space, a_turn_maps_currents_of_the_sleigh_to_each_other, PLAIN_ONLY)
{
    place p = place_with_systems();
    finished f = run(&p, "analyze sleigh --equations --json=r.json --quiet");
    cr_assert_eq(f.code, 0, "%s", f.err);
    finished_clear(&f);
    char *json = read_here(&p, "r.json");
    cJSON *root = cJSON_Parse(json);
    cr_expect_eq(number_in(root, "equation_symmetries", "dim_point"), 5);
    cr_expect_str_eq(line_of(root, "S_5(Phi2)"), "-Phi4/k");
    cr_expect_str_eq(line_of(root, "S_5(Phi4)"), "Phi2/k");
    cr_expect_str_eq(line_of(root, "S_4(Phi1)"), "-2*Phi1");
    cJSON_Delete(root);
    free(json);
    place_clear(&p);
}
