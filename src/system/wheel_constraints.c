/* wheel_constraints: the conditions of a system's wheels as constraints of the system.
 *
 * Two wheels on one axle forbid the same sideways motion, and a wheel that cannot leave its surface needs no condition
 * for it.  What the conditions before it imply is therefore left out: the rank of the coefficients (c_1 .. c_m, c_0),
 * c_s v^s + c_0 = 0, tells. */
#include "exact/generic_value.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/print.h"
#include "system/bodies_tree.h"

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

/* Does the last of the rows say something new anywhere?  Decided modulo primes, for the values of the parameters. */
static bool says_something(const nh_system *s, size_t rows, const nh_ex *row)
{
    size_t width = s->coordinates + 1, with, before;
    nh_ex *e = nh_alloc_array(rows * width, sizeof *e);
    for (size_t i = 0; i < rows * width; i++) e[i] = nh_system_values(s, s->dag, row[i]);
    bool fresh = !nh_generic_rank(s->dag, rows, width, e, &with) ||
                 !nh_generic_rank(s->dag, rows - 1, width, e, &before) || with > before;
    nh_free(e);
    return fresh;
}

static void add_constraint(nh_system *s, const nh_wheel *w, const nh_ex *row, nh_ex level)
{
    nh_dag *d = s->dag;
    nh_ex sum = row[s->coordinates];
    for (size_t i = 0; i < s->coordinates; i++) sum = nh_add(d, sum, nh_mul(d, row[i], velocity_of(s, i)));
    char *text = nh_print_string(d, nh_orientation_shown(s, sum));
    s->constraint[s->constraints++] = (nh_constraint){.text = nh_arena_printf(s->arena, "%s = 0", text),
                                                      .lhs = nh_orientation_written(s, sum),
                                                      .rhs = nh_int(d, 0),
                                                      .level = level,
                                                      .framed = sum,
                                                      .node = w->node};
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
        nh_ex condition[3], level[3];
        exchange_rates(s->chain);
        size_t n = nh_wheel_conditions(c, s->dag, &c->wheel[i], condition, level);
        exchange_rates(s->chain);
        for (size_t k = 0; k < n; k++) {
            coefficients(s, condition[k], row + rows * width);
            if (!says_something(s, rows + 1, row)) continue;
            add_constraint(s, &c->wheel[i], row + rows * width, level[k]);
            rows++;
        }
    }
    nh_free(row);
}
