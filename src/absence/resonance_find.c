/* resonance_find: the states where a shape rests, and its linear equations there. */
#include <string.h>

#include "absence/rational_value.h"
#include "absence/resonance.h"
#include "base/memory.h"
#include "base/text.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/print.h"

enum {
    places = 4,           /* of an angle: 0, pi, pi/2, -pi/2 */
    opposite_places = 2,  /* 0 and pi */
    most_angles = 3,      /* at all of them */
    most_opposite = 6,    /* at 0 and pi; more angles: at 0 */
    most_letters = 24,    /* of a shape */
    most_nodes = 4000000, /* of all rates that are evaluated, and the work on matrices in the same measure */
    matrix_work = 4       /* times the fourth power of their size */
};

typedef struct {
    nh_arena *arena;
    const nh_closed_shape *shape;
    nh_dag *dag;
    size_t nodes; /* counted work */
    size_t node_count[most_letters];
    nh_ex rate[most_letters], value[most_letters]; /* parameters at their values; the state that is tried */
    nh_ex *jacobian;                               /* NULL at first */
    size_t count, capacity;
    nh_resonance **found;
} work;

static nh_rational_value_place place_of(const work *w)
{
    return (nh_rational_value_place){
        .dag = w->dag, .count = w->shape->count, .symbol = w->shape->letter, .value = w->value};
}

/* Do all rates vanish at the state, and are they analytic there? */
static bool rests(work *w)
{
    nh_rational_value_place place = place_of(w);
    for (size_t i = 0; i < w->shape->count; i++) {
        w->nodes += w->node_count[i];
        nh_ex value = nh_substitute(w->dag, w->rate[i], place.count, place.symbol, place.value);
        if (nh_normal_is_zero(w->dag, value, 0) != NH_ZERO) return false;
    }
    for (size_t i = 0; i < w->shape->count; i++)
        if (!nh_rational_value_analytic(&place, w->rate[i])) return false;
    return true;
}

/* The matrix of the linear equations at the state; false: an entry is not a rational number. */
static bool linear_equations(work *w, fmpq_mat_t out)
{
    size_t n = w->shape->count;
    nh_rational_value_place place = place_of(w);
    if (!w->jacobian) {
        w->jacobian = nh_alloc_array(n * n + 1, sizeof *w->jacobian);
        for (size_t i = 0; i < n * n; i++) w->jacobian[i] = nh_diff(w->dag, w->rate[i / n], w->shape->letter[i % n]);
    }
    for (size_t i = 0; i < n * n; i++)
        if (!nh_rational_value_of(w->dag, nh_rational_value_at(&place, w->jacobian[i]),
                                  fmpq_mat_entry(out, (slong)(i / n), (slong)(i % n))))
            return false;
    return true;
}

static const char *words(const work *w)
{
    nh_text text;
    nh_text_init(&text);
    for (size_t i = 0; i < w->shape->count; i++) {
        char *letter = nh_print_string(w->dag, w->shape->letter[i]), *value = nh_print_string(w->dag, w->value[i]);
        nh_text_addf(&text, "%s%s = %s", i ? ", " : "", letter, value);
        nh_free(letter);
        nh_free(value);
    }
    const char *out = nh_arena_strdup(w->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

/* Keeps what says something and is not there yet. */
static void keep(work *w, nh_resonance *resonance)
{
    if (resonance->at_most >= resonance->letters) return;
    for (size_t i = 0; i < w->count; i++)
        if (!strcmp(w->found[i]->polynomial, resonance->polynomial) &&
            w->found[i]->diagonalizable == resonance->diagonalizable)
            return;
    nh_ex *value = nh_arena_alloc(w->arena, w->shape->count * sizeof *value);
    memcpy(value, w->value, w->shape->count * sizeof *value);
    resonance->value = value;
    for (size_t i = w->shape->coordinates; i < w->shape->count; i++) resonance->steady |= !nh_is_zero(w->dag, value[i]);
    resonance->point = words(w);
    nh_grow(&w->found, &w->capacity, w->count + 1, sizeof *w->found);
    size_t at = w->count++;
    for (; at > 0 && w->found[at - 1]->at_most > resonance->at_most; at--) w->found[at] = w->found[at - 1];
    w->found[at] = resonance;
}

static void try_state(work *w)
{
    size_t n = w->shape->count;
    if (w->nodes > most_nodes || !rests(w)) return;
    w->nodes += matrix_work * n * n * n * n;
    fmpq_mat_t matrix;
    fmpq_mat_init(matrix, (slong)n, (slong)n);
    if (linear_equations(w, matrix)) keep(w, nh_resonance_of(w->arena, matrix));
    fmpq_mat_clear(matrix);
}

/* All places of the angles, the other coordinates 0; the velocities are those of w->value. */
static void try_places(work *w)
{
    const nh_closed_shape *shape = w->shape;
    nh_ex pi = nh_pi(w->dag), half = nh_mul(w->dag, nh_ratio(w->dag, 1, 2), pi);
    nh_ex place[places] = {nh_int(w->dag, 0), pi, half, nh_neg(w->dag, half)};
    size_t angles = 0, each = 1, all = 1;
    for (size_t i = 0; i < shape->coordinates; i++) angles += shape->angle[i];
    if (angles <= most_opposite) each = angles <= most_angles ? places : opposite_places;
    for (size_t i = 0; i < angles; i++) all *= each;
    for (size_t turn = 0; turn < all; turn++) {
        size_t rest = turn;
        for (size_t i = 0; i < shape->coordinates; i++) {
            w->value[i] = place[shape->angle[i] ? rest % each : 0];
            if (shape->angle[i]) rest /= each;
        }
        try_state(w);
    }
}

size_t nh_resonance_find(nh_arena *arena, const nh_closed_shape *shape, nh_resonance ***out)
{
    *out = NULL;
    if (shape->obstacle || !shape->count || shape->count > most_letters) return 0;
    work w = {.arena = arena, .shape = shape, .dag = shape->model->dag};
    for (size_t i = 0; i < shape->count; i++) {
        w.rate[i] = nh_model_values(shape->model, shape->rate[i]);
        w.node_count[i] = nh_node_count(w.dag, w.rate[i]);
    }
    /* At rest, then with one velocity. */
    for (size_t moving = shape->coordinates; moving <= shape->count; moving++) {
        for (size_t i = shape->coordinates; i < shape->count; i++)
            w.value[i] = nh_int(w.dag, moving > shape->coordinates && i + 1 == moving);
        try_places(&w);
    }
    *out = nh_arena_alloc(arena, (w.count + 1) * sizeof **out);
    if (w.count) memcpy(*out, w.found, w.count * sizeof **out);
    nh_free(w.found);
    nh_free(w.jacobian);
    return w.count;
}
