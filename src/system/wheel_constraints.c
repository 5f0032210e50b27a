/* wheel_constraints: the conditions of a system's wheels as constraints of the system.
 *
 * Two wheels on one axle forbid the same sideways motion, and a wheel that cannot leave its surface needs no condition
 * for it.  What the conditions before it imply is therefore left out: the rank of the coefficients (c_1 .. c_m, c_0),
 * c_s v^s + c_0 = 0, tells at sample points. */
#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/diff.h"
#include "graph/print.h"
#include "evaluate/tape.h"
#include "system/bodies_tree.h"
#include "system/sample.h"

enum { sample_points = 6 };
static const double rank_bound = 1e-9; /* of singular values, relative to the largest */

/* The velocity of a coordinate, or the symbol of an orientation's angular velocity. */
static nh_ex velocity_of(const nh_system *s, size_t i)
{
    const nh_orientation *o = nh_orientation_of(s, i);
    return o ? o->framed[i - o->first] : s->coordinate[i].v;
}

/* Coefficients of the velocities and what is left without them: m + 1, simplified where they are short. */
static void coefficients(const nh_system *s, nh_ex e, nh_ex *row)
{
    nh_ex rest = e;
    for (size_t i = 0; i < s->coordinates; i++) {
        nh_ex v = velocity_of(s, i), zero = nh_int(s->dag, 0);
        row[i] = nh_tidy(s->dag, nh_diff(s->dag, e, v));
        rest = nh_substitute(s->dag, rest, 1, &v, &zero);
    }
    row[s->coordinates] = nh_tidy(s->dag, rest);
}

static size_t rank_of(size_t rows, size_t columns, const double *value)
{
    double *a = nh_alloc_array(rows * columns + rows + columns, sizeof *a), *singular = a + rows * columns;
    size_t least = rows < columns ? rows : columns, rank = 0;
    memcpy(a, value, rows * columns * sizeof *a);
    if (nh_svd(columns, rows, a, singular, NULL, NULL))
        while (rank < least && singular[rank] > rank_bound * singular[0] && singular[rank] > 1e-300) rank++;
    nh_free(a);
    return rank;
}

/* Does the last of the rows say something new anywhere? */
static bool says_something(const nh_system *s, size_t rows, const nh_ex *row)
{
    size_t m = s->coordinates, width = m + 1;
    const nh_ex *symbols;
    const double *values;
    uint64_t seed = 1;
    nh_system_bindings(s, &symbols, &values);
    nh_ex *in = nh_alloc_array(width, sizeof *in);
    double *point = nh_alloc_array(width + rows * width, sizeof *point), *value = point + width;
    in[m] = s->t;
    for (size_t i = 0; i < m; i++) in[i] = s->coordinate[i].q;
    nh_tape *tape = nh_tape_create(s->dag, width, in, rows * width, row, s->parameters, symbols, values);
    nh_tape_work *work = nh_tape_work_create(tape);
    bool fresh = false;
    for (int p = 0; p < sample_points && !fresh; p++) {
        bool finite = true;
        for (size_t i = 0; i < width; i++) point[i] = 2 * nh_random(&seed) - 1;
        nh_tape_eval(tape, work, point, value);
        for (size_t i = 0; i < rows * width; i++) finite &= isfinite(value[i]);
        fresh = finite && rank_of(rows, width, value) > rank_of(rows - 1, width, value);
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(point);
    nh_free(in);
    return fresh;
}

static void add_constraint(nh_system *s, const nh_wheel *w, const nh_ex *row)
{
    nh_dag *d = s->dag;
    nh_ex sum = row[s->coordinates];
    for (size_t i = 0; i < s->coordinates; i++) sum = nh_add(d, sum, nh_mul(d, row[i], velocity_of(s, i)));
    char *text = nh_print_string(d, nh_orientation_shown(s, sum));
    s->constraint[s->constraints++] = (nh_constraint){
        .text = nh_arena_printf(s->arena, "%s = 0", text), .lhs = nh_orientation_written(s, sum), .rhs = nh_int(d, 0),
        .framed = sum, .node = w->node};
    nh_free(text);
}

static void exchange_rates(nh_chain *c)
{
    for (size_t k = 0; k < c->screws; k++) {
        nh_ex rate = c->screw[k].rate;
        c->screw[k].rate = c->screw[k].framed;
        c->screw[k].framed = rate;
    }
}

size_t nh_system_most_wheel_constraints(const nh_system *s) { return s->chain ? 3 * s->chain->wheels : 0; }

void nh_system_add_wheel_constraints(nh_system_reader *r)
{
    nh_system *s = r->system;
    const nh_chain *c = s->chain;
    size_t width = s->coordinates + 1, rows = 0;
    if (!c || !c->wheels) return;
    nh_ex *row = nh_alloc_array(3 * c->wheels * width, sizeof *row);
    for (size_t i = 0; i < c->wheels; i++) {
        nh_ex condition[3];
        exchange_rates(s->chain);
        size_t n = nh_wheel_conditions(c, s->dag, &c->wheel[i], condition);
        exchange_rates(s->chain);
        for (size_t k = 0; k < n; k++) {
            coefficients(s, condition[k], row + rows * width);
            if (!says_something(s, rows + 1, row)) continue;
            add_constraint(s, &c->wheel[i], row + rows * width);
            rows++;
        }
    }
    nh_free(row);
}
