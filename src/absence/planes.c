/* planes: candidates are rejected by numbers, and proved by zero tests.
 *
 *     coordinates that rest: 0; angles: 0, pi, pi/2, -pi/2
 *     moving:                one coordinate x; two with y = x, -x (angles: also x + pi, pi - x); more with y = x, -x;
 *                            angles with angles only: another coordinate does not come back after a turn
 *     velocity:              w with x' = alpha(x) w on the plane; the others 0 */
#include "absence/planes.h"

#include <math.h>

#include "absence/curve_value.h"
#include "base/text.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/measure.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/print.h"

enum {
    rests = 4,             /* values at which an angle may rest */
    most_places = 256,     /* values of the coordinates at rest, for one moving coordinate */
    most_pair_places = 16, /* the same for two */
    most_planes = 64,
    longest_zero = 5000 /* terms of a normal form */
};

/* in units of pi/2 */
static const int rest_value[rests] = {0, 2, 1, -1};

/* Letter l is coefficient[l] (y0 or y1) + rest[l] pi/2 + its normal letter. */
typedef struct {
    size_t moving, velocity;
    int *coefficient, *rest;
} candidate;

typedef struct {
    nh_arena *arena;
    const nh_closed_shape *shape;
    nh_dag *dag;
    nh_tape *tape; /* rates over the letters */
    nh_tape_work *work;
    double *in, *out;
    candidate at;
    nh_plane *plane;
    size_t count;
} search;

/* The letter that letter l goes with: the moving coordinate, or the velocity. */
static size_t leader(const search *s, size_t l) { return l < s->shape->coordinates ? s->at.moving : s->at.velocity; }

static bool is_leader(const search *s, size_t l) { return l == s->at.moving || l == s->at.velocity; }

/* ---- rejected by numbers ---- */

/* Values of x and w at which rates are compared. */
static const double try_x[] = {0.3713, -0.6421, 1.8317, -2.7145}, try_w[] = {0.7331, 1.1207, -0.5733, 0.8611};

/* Do all other letters rest at this point?  -1: some rate has no value there. */
static int rests_at(search *s, double x, double w)
{
    static const double tolerance = 1e-8;
    const nh_closed_shape *shape = s->shape;
    for (size_t l = 0; l < shape->count; l++)
        s->in[l] = s->at.coefficient[l] * (l < shape->coordinates ? x : w) + s->at.rest[l] * acos(0.0);
    nh_tape_eval(s->tape, s->work, s->in, s->out);
    for (size_t l = 0; l < shape->count; l++)
        if (!isfinite(s->out[l])) return -1;
    for (size_t l = 0; l < shape->count; l++) {
        double rate = s->out[leader(s, l)], size = 1 + fabs(rate) + fabs(s->out[l]);
        if (!is_leader(s, l) && !(fabs(s->out[l] - s->at.coefficient[l] * rate) < tolerance * size)) return 0;
    }
    return fabs(s->out[s->at.moving]) > tolerance;
}

static bool may_be_plane(search *s)
{
    size_t good = 0;
    for (size_t k = 0; k < sizeof try_x / sizeof *try_x; k++) {
        int verdict = rests_at(s, try_x[k], try_w[k]);
        if (verdict == 0) return false;
        good += verdict > 0;
    }
    return good > 0;
}

/* ---- proved by zero tests ---- */

static nh_ex quarter_turns(nh_dag *dag, int n) { return nh_mul(dag, nh_ratio(dag, n, 2), nh_pi(dag)); }

/* "y - x" for the normal letter of y where y = x is the plane. */
static nh_ex normal_symbol(const search *s, size_t l)
{
    nh_dag *dag = s->dag;
    int c = s->at.coefficient[l], rest = s->at.rest[l];
    nh_ex letter = s->shape->letter[l];
    if (c == 0 && rest == 0) return letter;
    nh_ex value = nh_sub(dag, letter, nh_mul(dag, nh_int(dag, c), s->shape->letter[leader(s, l)]));
    char *name = nh_print_string(dag, nh_sub(dag, value, quarter_turns(dag, rest)));
    nh_ex symbol = nh_symbol_fresh(dag, name);
    nh_free(name);
    return symbol;
}

/* Fills y and letter. */
static void new_letters(const search *s, nh_plane *plane)
{
    const nh_closed_shape *shape = s->shape;
    size_t n = shape->count, next = 2;
    plane->y = nh_arena_alloc(s->arena, n * sizeof(nh_ex));
    plane->letter = nh_arena_alloc(s->arena, n * sizeof(nh_ex));
    plane->rate = nh_arena_alloc(s->arena, n * sizeof(nh_ex));
    plane->y[0] = shape->letter[s->at.moving];
    plane->y[1] = shape->letter[s->at.velocity];
    for (size_t l = 0; l < n; l++) {
        plane->letter[l] = shape->letter[l];
        if (is_leader(s, l)) continue;
        nh_ex y = normal_symbol(s, l), moved = shape->letter[leader(s, l)];
        plane->y[next++] = y;
        if (y == shape->letter[l]) continue;
        nh_ex e = nh_add(s->dag, y, nh_mul(s->dag, nh_int(s->dag, s->at.coefficient[l]), moved));
        plane->letter[l] = nh_add(s->dag, e, quarter_turns(s->dag, s->at.rest[l]));
    }
}

/* Fills rate: that of the letter, less that of the one it goes with. */
static void new_rates(const search *s, nh_plane *plane)
{
    const nh_closed_shape *shape = s->shape;
    nh_dag *dag = s->dag;
    size_t next = 2;
    for (size_t l = 0; l < shape->count; l++) {
        nh_ex rate = shape->rate[l];
        if (s->at.coefficient[l] && !is_leader(s, l)) {
            nh_ex led = nh_mul(dag, nh_int(dag, s->at.coefficient[l]), shape->rate[leader(s, l)]);
            rate = nh_sub(dag, rate, led);
        }
        rate = nh_substitute(dag, rate, shape->count, shape->letter, plane->letter);
        if (l == s->at.moving) plane->rate[0] = rate;
        else if (l == s->at.velocity) plane->rate[1] = rate;
        else plane->rate[next++] = rate;
    }
}

/* e at y[2] = y[3] = .. = 0 */
static nh_ex restricted(const search *s, const nh_plane *plane, nh_ex e)
{
    size_t normals = s->shape->count - 2;
    nh_ex *zero = nh_alloc_array(normals + 1, sizeof *zero);
    for (size_t i = 0; i < normals; i++) zero[i] = nh_int(s->dag, 0);
    e = nh_substitute(s->dag, e, normals, plane->y + 2, zero);
    nh_free(zero);
    return e;
}

/* Does e vanish, or have no value, on the plane at the parameters' values? */
static bool vanishes(const search *s, const nh_plane *plane, nh_ex e)
{
    e = nh_model_values(s->shape->model, restricted(s, plane, e));
    return !nh_is_exact(s->dag, e) || nh_normal_is_zero(s->dag, e, longest_zero) != NH_NONZERO;
}

/* Is the plane a pole or a branch point of a rate, although it may cancel? */
static bool is_singular(const search *s, const nh_plane *plane)
{
    nh_dag *dag = s->dag;
    NH_LIST(node);
    size_t count = nh_nodes_in(dag, s->shape->count, plane->rate, &node);
    bool singular = false;
    for (size_t k = 0; k < count && !singular; k++) {
        nh_ex e = node[k];
        nh_kind kind = nh_kind_of(dag, e);
        if (kind == NH_FUNCTION && nh_function_of(dag, e) == NH_TAN)
            singular = vanishes(s, plane, nh_call(dag, NH_COS, nh_child(dag, e, 0)));
        if (kind == NH_FUNCTION && nh_function_of(dag, e) == NH_LOG) singular = vanishes(s, plane, nh_child(dag, e, 0));
        for (size_t i = 0; kind == NH_PRODUCT && i < nh_arity(dag, e) && !singular; i++) {
            nh_ex x = nh_exponent_of(dag, e, i);
            bool number = nh_kind_of(dag, x) == NH_NUMBER && nh_num_short(nh_number_of(dag, x));
            if (number && nh_number_of(dag, x).q == 1 && nh_number_of(dag, x).p > 0) continue;
            if (nh_kind_of(dag, nh_child(dag, e, i)) == NH_NUMBER) continue;
            singular = vanishes(s, plane, nh_child(dag, e, i));
        }
    }
    return singular;
}

/* Fills generic.  False: the letters do not rest, or x' is not alpha(x) w. */
static bool is_invariant(const search *s, nh_plane *plane)
{
    const nh_model *model = s->shape->model;
    nh_dag *dag = s->dag;
    nh_ex rate = restricted(s, plane, plane->rate[0]), alpha = nh_diff(dag, rate, plane->y[1]);
    plane->generic = true;
    for (size_t i = 1; i < s->shape->count; i++) {
        nh_ex e = i == 1 ? nh_sub(dag, rate, nh_mul(dag, alpha, plane->y[1])) : restricted(s, plane, plane->rate[i]);
        if (i == 1) e = nh_add(dag, nh_mul(dag, e, e), nh_powi(dag, nh_diff(dag, alpha, plane->y[1]), 2));
        if (!nh_is_exact(dag, e)) return false;
        if (nh_normal_is_zero(dag, e, longest_zero) == NH_ZERO) continue;
        plane->generic = false;
        if (nh_normal_is_zero(dag, nh_model_values(model, e), longest_zero) != NH_ZERO) return false;
    }
    plane->moving_rate = nh_mul(dag, nh_simplify_short(dag, alpha, 0), plane->y[1]);
    return true;
}

/* ---- words ---- */

/* Is letter l the velocity of a coordinate that rests, which then says it all? */
static bool is_told(const search *s, size_t l)
{
    const nh_closed_shape *shape = s->shape;
    for (size_t i = 0; i < shape->coordinates; i++)
        if (i != s->at.moving && shape->rate[i] == shape->letter[l]) return true;
    return false;
}

static const char *words_of(const search *s)
{
    const nh_closed_shape *shape = s->shape;
    nh_dag *dag = s->dag;
    nh_text text;
    nh_text_init(&text);
    for (size_t l = 0; l < shape->count; l++) {
        if (is_leader(s, l) || (l >= shape->coordinates && is_told(s, l))) continue;
        nh_ex value = nh_mul(dag, nh_int(dag, s->at.coefficient[l]), shape->letter[leader(s, l)]);
        char *right = nh_print_string(dag, nh_add(dag, value, quarter_turns(dag, s->at.rest[l])));
        nh_text_addf(&text, "%s%s = %s", text.length ? ", " : "", nh_name_of(dag, shape->letter[l]), right);
        nh_free(right);
    }
    const char *words = nh_arena_strdup(s->arena, text.length ? nh_text_string(&text) : "all motions");
    nh_text_clear(&text);
    return words;
}

/* ---- roots ---- */

/* Signs of the roots of rates on each side: bit r for root r; known[side]: all have signs. */
typedef struct {
    unsigned negative[NH_CURVE_NEAR + 1];
    bool known[NH_CURVE_NEAR + 1];
} root_signs;

static void add_root(const search *s, const nh_plane *plane, nh_ex radicand, size_t index, root_signs *signs)
{
    nh_curve_field field;
    nh_curve_element value, root, near;
    nh_curve_state state;
    nh_ex e = nh_model_values(s->shape->model, radicand);
    nh_curve_field_init(&field);
    nh_curve_field_element_init(&value);
    nh_curve_field_element_init(&root);
    nh_curve_field_element_init(&near);
    nh_curve_place place = {.dag = s->dag,
                            .field = &field,
                            .coordinate = plane->y[0],
                            .velocity = plane->y[1],
                            .zeros = s->shape->count - 2,
                            .zero = plane->y + 2};
    nh_curve_value(&place, 1, &e, &value, &state, NULL);
    bool rational = state == NH_CURVE_FINE && nh_curve_field_sqrt(&root, &value, NH_CURVE_FAR);
    for (nh_curve_side side = NH_CURVE_FAR; rational && side <= NH_CURVE_NEAR; side++) {
        bool known = nh_curve_field_sqrt(&near, &value, side);
        signs->known[side] &= known;
        if (known && !nh_curve_field_equal(&near, &root)) signs->negative[side] |= 1u << index;
    }
    nh_curve_field_element_clear(&value);
    nh_curve_field_element_clear(&root);
    nh_curve_field_element_clear(&near);
    nh_curve_field_clear(&field);
}

static root_signs signs_of(const search *s, const nh_plane *plane)
{
    enum { most_roots = 32 };
    root_signs signs = {.known = {true, true, true}};
    size_t roots = 0;
    for (size_t i = 0; i < s->shape->count && !plane->angle; i++) {
        NH_LIST(found);
        size_t n = nh_radicands_in(s->dag, plane->rate[i], &found);
        for (size_t k = 0; k < n && roots < most_roots; k++) add_root(s, plane, found[k], roots++, &signs);
    }
    return signs;
}

static void add_plane(search *s, nh_plane plane, nh_curve_side side, const char *words)
{
    if (s->count == most_planes) return;
    plane.side = side;
    plane.words = words;
    s->plane[s->count++] = plane;
}

/* The plane once for each pattern of signs that its roots have. */
static void add_sides(search *s, const nh_plane *plane)
{
    static const char *const relation[] = {" > 0", " < 0", " near 0"};
    root_signs signs = signs_of(s, plane);
    const char *words = words_of(s), *name = nh_name_of(s->dag, plane->y[0]);
    bool alone = true;
    for (nh_curve_side side = NH_CURVE_FAR_BELOW; side <= NH_CURVE_NEAR; side++)
        alone = alone && signs.negative[side] == 0;
    if (alone) {
        add_plane(s, *plane, NH_CURVE_FAR, words);
        return;
    }
    for (nh_curve_side side = NH_CURVE_FAR; side <= NH_CURVE_NEAR; side++) {
        bool fresh = signs.known[side];
        for (nh_curve_side other = NH_CURVE_FAR; other < side; other++)
            fresh = fresh && !(signs.known[other] && signs.negative[other] == signs.negative[side]);
        if (fresh) add_plane(s, *plane, side, nh_arena_printf(s->arena, "%s, %s%s", words, name, relation[side]));
    }
}

/* ---- all candidates ---- */

static void try_candidate(search *s)
{
    if (s->count == most_planes || !may_be_plane(s)) return;
    nh_plane plane = {.angle = s->shape->angle[s->at.moving]};
    new_letters(s, &plane);
    new_rates(s, &plane);
    if (is_singular(s, &plane) || !is_invariant(s, &plane)) return;
    add_sides(s, &plane);
}

/* The next values of the coordinates that neither move nor have a fixed rest; false after the last. */
static bool next_place(search *s, const bool *fixed)
{
    const nh_closed_shape *shape = s->shape;
    for (size_t l = 0; l < shape->coordinates; l++) {
        if (fixed[l] || !shape->angle[l]) continue;
        size_t now = 0;
        while (rest_value[now] != s->at.rest[l]) now++;
        now = (now + 1) % rests;
        s->at.rest[l] = rest_value[now];
        if (now) return true;
    }
    return false;
}

/* All values of the other coordinates. */
static void try_places(search *s, const bool *fixed, size_t most)
{
    size_t places = 0;
    do try_candidate(s);
    while (++places < most && next_place(s, fixed));
    for (size_t l = 0; l < s->shape->coordinates; l++)
        if (!fixed[l]) s->at.rest[l] = 0;
}

static void begin_candidate(search *s, size_t moving, size_t velocity)
{
    for (size_t l = 0; l < s->shape->count; l++) s->at.coefficient[l] = s->at.rest[l] = 0;
    s->at.moving = moving;
    s->at.velocity = velocity;
    s->at.coefficient[moving] = s->at.coefficient[velocity] = 1;
}

static void single(search *s)
{
    const nh_closed_shape *shape = s->shape;
    bool *fixed = nh_alloc_array(shape->count + 1, sizeof *fixed);
    for (size_t i = 0; i < shape->coordinates; i++)
        for (size_t k = shape->coordinates; k < shape->count; k++) {
            if (!nh_depends(s->dag, shape->rate[i], shape->letter[k])) continue;
            begin_candidate(s, i, k);
            fixed[i] = true;
            try_places(s, fixed, most_places);
            fixed[i] = false;
        }
    nh_free(fixed);
}

/* The letter that is the velocity of coordinate i; shape->count: there is none. */
static size_t velocity_of(const nh_closed_shape *shape, size_t i)
{
    size_t k = shape->coordinates;
    while (k < shape->count && shape->letter[k] != shape->rate[i]) k++;
    return k;
}

static void pair(search *s, size_t i, size_t j)
{
    const nh_closed_shape *shape = s->shape;
    size_t k = velocity_of(shape, i), l = velocity_of(shape, j);
    if (k == shape->count || l == shape->count || shape->angle[i] != shape->angle[j]) return;
    bool *fixed = nh_alloc_array(shape->count + 1, sizeof *fixed), angles = shape->angle[i] && shape->angle[j];
    fixed[i] = fixed[j] = true;
    for (int sign = 1; sign >= -1; sign -= 2)
        for (int half = 0; half <= (angles ? 2 : 0); half += 2) {
            begin_candidate(s, i, k);
            s->at.coefficient[j] = s->at.coefficient[l] = sign;
            s->at.rest[j] = half;
            try_places(s, fixed, most_pair_places);
        }
    nh_free(fixed);
}

/* The next pattern of 0, 1, -1 per coordinate, as digits of a number in base 3. */
static bool next_pattern(int *sign, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        sign[i] = sign[i] == 0 ? 1 : sign[i] == 1 ? -1 : 0;
        if (sign[i]) return true;
    }
    return false;
}

/* The candidate of a pattern; false where fewer than three move, the first backwards, angles with others, or one has no
 * velocity. */
static bool begin_pattern(search *s, const int *sign)
{
    enum { fewest = 3 };
    const nh_closed_shape *shape = s->shape;
    size_t n = shape->coordinates, first = n, moving = 0;
    for (size_t i = n; i-- > 0;) {
        if (!sign[i]) continue;
        if (velocity_of(shape, i) == shape->count || (first < n && shape->angle[i] != shape->angle[first]))
            return false;
        first = i;
        moving++;
    }
    if (moving < fewest || sign[first] < 0) return false;
    begin_candidate(s, first, velocity_of(shape, first));
    for (size_t i = 0; i < n; i++)
        if (sign[i]) s->at.coefficient[i] = s->at.coefficient[velocity_of(shape, i)] = sign[i];
    return true;
}

/* Three coordinates and more that move alike. */
static void groups(search *s)
{
    enum { most_coordinates = 5 };
    const nh_closed_shape *shape = s->shape;
    size_t n = shape->coordinates;
    if (n > most_coordinates) return;
    int sign[most_coordinates] = {0};
    bool fixed[most_coordinates];
    while (next_pattern(sign, n)) {
        if (!begin_pattern(s, sign)) continue;
        for (size_t i = 0; i < n; i++) fixed[i] = sign[i] != 0;
        try_places(s, fixed, most_pair_places);
    }
}

size_t nh_planes_find(nh_arena *arena, const nh_closed_shape *shape, nh_plane **out)
{
    const nh_model *model = shape->model;
    size_t n = shape->count;
    *out = NULL;
    if (shape->obstacle || shape->coordinates == 0 || n < 2) return 0;
    search s = {.arena = arena, .shape = shape, .dag = model->dag};
    s.plane = nh_arena_alloc(arena, most_planes * sizeof *s.plane);
    s.tape = nh_tape_create(model->dag, n, shape->letter, n, shape->rate, model->system->parameters, model->parameter,
                            model->parameter_value);
    s.work = nh_tape_work_create(s.tape);
    s.in = nh_alloc_array(n, sizeof *s.in);
    s.out = nh_alloc_array(n, sizeof *s.out);
    s.at.coefficient = nh_alloc_array(n, sizeof *s.at.coefficient);
    s.at.rest = nh_alloc_array(n, sizeof *s.at.rest);
    single(&s);
    for (size_t i = 0; i < shape->coordinates; i++)
        for (size_t j = i + 1; j < shape->coordinates; j++) pair(&s, i, j);
    groups(&s);
    nh_free(s.in);
    nh_free(s.out);
    nh_free(s.at.coefficient);
    nh_free(s.at.rest);
    nh_tape_work_free(s.work);
    nh_tape_free(s.tape);
    *out = s.plane;
    return s.count;
}
