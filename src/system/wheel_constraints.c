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
static nh_ex velocity_of(const nh_system *system, size_t i)
{
    const nh_orientation *o = nh_orientation_of(system, i);
    return o ? o->framed[i - o->first] : system->coordinate[i].v;
}

/* Coefficients of the velocities and what is left without them: m + 1, simplified where they are short. */
static void coefficients(const nh_system *system, nh_ex e, nh_ex *row)
{
    nh_ex rest = e;
    for (size_t i = 0; i < system->coordinates; i++) {
        nh_ex v = velocity_of(system, i), zero = nh_int(system->dag, 0);
        row[i] = nh_tidy(system->dag, nh_diff(system->dag, e, v));
        rest = nh_substitute(system->dag, rest, 1, &v, &zero);
    }
    row[system->coordinates] = nh_tidy(system->dag, rest);
}

/* Does the last of the rows say something new anywhere?  Decided modulo primes, for the values of the parameters. */
static bool says_something(const nh_system *system, size_t rows, const nh_ex *row)
{
    size_t width = system->coordinates + 1, with, before;
    nh_ex *e = nh_alloc_array(rows * width, sizeof *e);
    for (size_t i = 0; i < rows * width; i++) e[i] = nh_system_values(system, system->dag, row[i]);
    bool fresh = !nh_generic_rank(system->dag, rows, width, e, &with) ||
                 !nh_generic_rank(system->dag, rows - 1, width, e, &before) || with > before;
    nh_free(e);
    return fresh;
}

static void add_constraint(nh_system *system, const nh_wheel *w, const nh_ex *row, nh_ex level)
{
    nh_dag *d = system->dag;
    nh_ex sum = row[system->coordinates];
    for (size_t i = 0; i < system->coordinates; i++) sum = nh_add(d, sum, nh_mul(d, row[i], velocity_of(system, i)));
    char *text = nh_print_string(d, nh_orientation_shown(system, sum));
    system->constraint[system->constraints++] = (nh_constraint){.text = nh_arena_printf(system->arena, "%s = 0", text),
                                                                .lhs = nh_orientation_written(system, sum),
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

size_t nh_system_most_wheel_constraints(const nh_system *system)
{
    return system->chain ? 3 * system->chain->wheels : 0;
}

void nh_system_add_wheel_constraints(nh_system_reader *r)
{
    nh_system *system = r->system;
    const nh_chain *c = system->chain;
    size_t width = system->coordinates + 1, rows = 0;
    if (!c || !c->wheels) return;
    nh_ex *row = nh_alloc_array(3 * c->wheels * width, sizeof *row);
    for (size_t i = 0; i < c->wheels; i++) {
        nh_ex condition[3], level[3];
        exchange_rates(system->chain);
        size_t n = nh_wheel_conditions(c, system->dag, &c->wheel[i], condition, level);
        exchange_rates(system->chain);
        for (size_t k = 0; k < n; k++) {
            coefficients(system, condition[k], row + rows * width);
            if (!says_something(system, rows + 1, row)) continue;
            add_constraint(system, &c->wheel[i], row + rows * width, level[k]);
            rows++;
        }
    }
    nh_free(row);
}
