/* analysis_file_initial: an initial state: values of t, coordinates and velocities, also as exact expressions. */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "evaluate/tape.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "problem/analysis_file_internal.h"

typedef nh_analysis_file_reader reader;

/* A number, or an expression of the parameters. */
static bool number_at(reader *r, const nh_deck_node *node, const char *name, nh_ex *e, double *out)
{
    const nh_model *model = r->model;
    if (!nh_deck_is(r->a->deck, node, NH_DECK_SCALAR, "an initial value", r->error)) return false;
    if (!nh_system_expression(model->system, r->a->deck, node, r->extras, r->extra, e, r->error)) return false;
    *out = nh_model_number(model, *e);
    if (isfinite(*out)) return true;
    nh_deck_fail(r->a->deck, node, 0, r->error, "the initial value of `%s` must be a number", name);
    return nh_error_hint(r->error, "only parameters can be used here");
}

/* "pi/6 theta'=1": a comma is missing.  Always false. */
static bool one_value(reader *r, const nh_deck_node *node)
{
    if (node->kind != NH_DECK_SCALAR || !strchr(node->text, '=')) return false;
    r->error->hint[0] = 0;
    return nh_error_hint(r->error, "commas separate the values: phi=0, omega=2");
}

/* Coordinate velocities that quasi-velocities give at (t, q). */
static void velocities_of(const nh_system *system, const double *quasi, nh_state *state)
{
    const nh_ex *symbols;
    const double *values;
    size_t m = system->coordinates;
    nh_ex *in = nh_alloc_array(1 + m + system->quasi, sizeof *in);
    double *z = nh_alloc_array(1 + m + system->quasi, sizeof *z);
    in[0] = system->t;
    z[0] = state->t;
    for (size_t i = 0; i < m; i++) {
        in[1 + i] = system->coordinate[i].q;
        z[1 + i] = state->q[i];
    }
    for (size_t i = 0; i < system->quasi; i++) {
        in[1 + m + i] = system->quasi_velocity[i];
        z[1 + m + i] = quasi[i];
    }
    nh_system_bindings(system, &symbols, &values);
    nh_tape *tape = nh_tape_create(system->dag, 1 + m + system->quasi, in, m, system->quasi_map, system->parameters,
                                   symbols, values);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, z, state->v);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(z);
    nh_free(in);
}

/* The same as expressions. */
static void exact_velocities(const nh_system *system, const nh_ex *quasi, nh_analysis_file *a)
{
    size_t m = system->coordinates, n = 1 + m + system->quasi;
    nh_ex *from = nh_alloc_array(2 * n, sizeof *from), *to = from + n;
    from[0] = system->t;
    for (size_t i = 0; i < m; i++) from[1 + i] = system->coordinate[i].q;
    memcpy(to, a->exact, (1 + m) * sizeof *to);
    memcpy(from + 1 + m, system->quasi_velocity, system->quasi * sizeof *from);
    memcpy(to + 1 + m, quasi, system->quasi * sizeof *to);
    for (size_t i = 0; i < m; i++) {
        a->exact[1 + m + i] = nh_substitute(system->dag, system->quasi_map[i], n, from, to);
        a->written[m + i] = true;
    }
    nh_free(from);
}

static bool unknown_state(reader *r, const nh_deck_node *key)
{
    const nh_system *system = r->model->system;
    const char **names = nh_analysis_file_take(r, 2 * system->coordinates + system->quasi + 1, sizeof *names);
    size_t n = nh_system_state_names(system, names);
    nh_deck_fail(r->a->deck, key, 0, r->error, "`%s` is not a coordinate or velocity of %s", key->text, system->name);
    const char *near = nh_text_nearest(key->text, names, n), *q = nh_system_velocity_meant(system, key->text, near);
    if (q) return nh_error_hint(r->error, NH_VELOCITY_IS_WRITTEN, q, q);
    if (near) return nh_error_hint(r->error, "did you mean `%s`?", near);
    const char *all = names[0];
    for (size_t i = 1; i < n; i++) all = nh_arena_printf(system->arena, "%s, %s", all, names[i]);
    return nh_error_hint(r->error, "it has %.150s", all);
}

/* The velocities of an orientation's coordinates, from its angular velocities. */
static void turn(const nh_system *system, const nh_orientation *o, const double *omega, const nh_ex *omega_exact,
                 nh_analysis_file *a)
{
    nh_state *state = &a->initial;
    nh_ex in[3], *q = a->exact + 1 + o->first, *v = q + system->coordinates;
    double F[9];
    for (size_t k = 0; k < 3; k++) in[k] = system->coordinate[o->first + k].q;
    nh_tape *tape = nh_tape_create(system->dag, 3, in, 9, o->map, 0, NULL, NULL);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, state->q + o->first, F);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    for (size_t i = 0; i < 3; i++) {
        state->v[o->first + i] = F[3 * i] * omega[0] + F[3 * i + 1] * omega[1] + F[3 * i + 2] * omega[2];
        state->given[o->first + i] = a->written[system->coordinates + o->first + i] = true;
        v[i] = nh_int(system->dag, 0);
        for (size_t k = 0; k < 3; k++) {
            nh_ex slope = nh_substitute(system->dag, o->map[3 * i + k], 3, in, q);
            v[i] = nh_add(system->dag, v[i], nh_mul(system->dag, slope, omega_exact[k]));
        }
    }
}

bool nh_analysis_file_read_initial(nh_analysis_file_reader *r, const nh_deck_node *map)
{
    const nh_system *system = r->model->system;
    nh_state *state = &r->a->initial;
    double *quasi = nh_analysis_file_take(r, system->quasi, sizeof *quasi);
    size_t m = system->coordinates;
    nh_ex *exact = r->a->exact = nh_analysis_file_take(r, 1 + 2 * m, sizeof *exact), e,
          *quasi_exact = nh_analysis_file_take(r, system->quasi, sizeof *exact);
    r->a->written = nh_analysis_file_take(r, 2 * m, sizeof *r->a->written);
    for (size_t i = 0; i < 1 + 2 * m; i++) exact[i] = nh_int(system->dag, 0);
    for (size_t i = 0; i < system->quasi; i++) quasi_exact[i] = nh_int(system->dag, 0);
    double *turning = nh_analysis_file_take(r, 3 * system->orientations, sizeof *turning);
    nh_ex *turning_exact = nh_analysis_file_take(r, 3 * system->orientations, sizeof *turning_exact);
    for (size_t i = 0; i < 3 * system->orientations; i++) turning_exact[i] = nh_int(system->dag, 0);
    bool any_quasi = false, any_velocity = false,
         *turns = nh_analysis_file_take(r, system->orientations, sizeof *turns);
    state->given = nh_analysis_file_take(r, system->coordinates, sizeof *state->given);
    state->placed = nh_analysis_file_take(r, system->coordinates, sizeof *state->placed);
    for (size_t i = 0; i < map->count; i++) {
        const char *name = nh_system_state_name(system, map->key[i]->text);
        double value;
        bool known = !strcmp(name, "t");
        if (!number_at(r, map->item[i], name, &e, &value)) return one_value(r, map->item[i]);
        if (known) state->t = value, exact[0] = e;
        for (size_t j = 0; j < system->coordinates && !known; j++) {
            bool velocity = !strcmp(name, nh_name_of(system->dag, system->coordinate[j].v));
            known = velocity || !strcmp(name, system->coordinate[j].name);
            if (known) {
                (velocity ? state->v : state->q)[j] = value;
                exact[1 + velocity * m + j] = e;
                r->a->written[velocity * m + j] = true;
            }
            if (velocity) state->given[j] = true;
            else if (known) state->placed[j] = true;
            any_velocity |= velocity;
        }
        for (size_t j = 0; j < 3 * system->orientations && !known; j++)
            if (!strcmp(name, system->orientation[j / 3].word[j % 3])) {
                turning[j] = value;
                turning_exact[j] = e;
                known = turns[j / 3] = any_velocity = true;
            }
        for (size_t j = 0; j < system->quasi && !known; j++)
            if (!strcmp(name, nh_name_of(system->dag, system->quasi_velocity[j]))) {
                quasi[j] = value;
                quasi_exact[j] = e;
                known = any_quasi = true;
            }
        if (!known) return unknown_state(r, map->key[i]);
    }
    if (any_quasi && any_velocity)
        return nh_deck_fail(r->a->deck, map, 0, r->error,
                            "give either coordinate velocities or quasi-velocities, not both");
    for (size_t i = 0; i < system->orientations; i++)
        if (turns[i]) turn(system, &system->orientation[i], turning + 3 * i, turning_exact + 3 * i, r->a);
    if (any_quasi) velocities_of(system, quasi, state), exact_velocities(system, quasi_exact, r->a);
    if (any_quasi) state->given = NULL;
    r->a->has_initial = true;
    return true;
}
