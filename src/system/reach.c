#include "system/system_internal.h"

#include <math.h>

#include "evaluate/tape.h"
#include "exact/walls.h"
#include "graph/dag.h"
#include "graph/declared.h"
#include "graph/function.h"
#include "system/domain.h"
#include "system/embedding_internal.h"

/* a wall is sought up to so many half widths from the middle of the interval, in so many steps */
enum { farthest = 16, steps = 512 };

static bool is_given(const nh_system *system, nh_ex symbol)
{
    for (size_t i = 0; i < system->intervals; i++)
        if (system->interval[i].symbol == symbol) return true;
    return false;
}

/* The one symbol of time, position or velocity in the wall, whose interval is a default one and no full turn. */
static bool only_symbol(const nh_system *system, nh_ex wall, nh_ex *out)
{
    size_t n = 0;
    if (nh_depends(system->dag, wall, system->t)) {
        *out = system->t;
        n++;
    }
    for (size_t i = 0; i < system->coordinates; i++) {
        const nh_coordinate *c = &system->coordinate[i];
        bool place = nh_depends(system->dag, wall, c->q), moves = nh_depends(system->dag, wall, c->v);
        if (!place && !moves) continue;
        if (place && c->type == NH_ANGLE) return false;
        *out = place ? c->q : c->v;
        n += (size_t)place + (size_t)moves;
    }
    return n == 1 && !is_given(system, *out);
}

/* The sign changes nearest to the middle on both sides of it; infinite where there is none. */
static void roots_around(const nh_tape *tape, double low, double high, double *below, double *above)
{
    nh_tape_work *work = nh_tape_work_create(tape);
    double middle = (low + high) / 2, step = farthest * (high - low) / 2 / steps;
    *below = -INFINITY;
    *above = INFINITY;
    for (int side = -1; side <= 1; side += 2) {
        double last = NAN;
        for (int k = 0; k <= steps; k++) {
            double x = middle + side * step * (k + 0.5), value, *found = side < 0 ? below : above;
            nh_tape_eval(tape, work, &x, &value);
            if (last * value < 0) {
                *found = x - side * step / 2;
                break;
            }
            last = value;
        }
    }
    nh_tape_work_free(work);
}

static void reach(nh_system *system, nh_ex wall, nh_ex symbol)
{
    double low, high, below, above;
    nh_ex *parameter = nh_arena_alloc(system->arena, (system->parameters + 1) * sizeof *parameter);
    double *value = nh_arena_alloc(system->arena, (system->parameters + 1) * sizeof *value);
    for (size_t i = 0; i < system->parameters; i++) {
        parameter[i] = system->parameter[i].symbol;
        value[i] = system->parameter[i].value;
    }
    nh_tape *tape = nh_tape_create(system->dag, 1, &symbol, 1, &wall, system->parameters, parameter, value);
    nh_domain_range(system, symbol, &low, &high);
    roots_around(tape, low, high, &below, &above);
    nh_tape_free(tape);
    double half = (high - low) / 2, margin = half / 2;
    bool inside = below > low + margin / 2 || above < high - margin / 2;
    if (inside || (isinf(below) && isinf(above))) return;
    if (above - high <= low - below) high = fmax(high, above + half);
    else low = fmin(low, below - half);
    system->reach[system->reaches++] = (nh_interval){symbol, low, high};
}

/* ---- tables ---- */

/* A coordinate without an interval of the file that is an argument of a table gets that of the table; an angle the part
 * of its own that the table has. */
static void reach_table(nh_system *system, nh_ex argument, size_t n, const double *node)
{
    double low, high;
    for (size_t i = 0; i < system->reaches; i++)
        if (system->reach[i].symbol == argument) return;
    for (size_t i = 0; i < system->coordinates; i++) {
        const nh_coordinate *c = &system->coordinate[i];
        if (c->q != argument || is_given(system, c->q)) continue;
        nh_domain_range(system, c->q, &low, &high);
        bool angle = c->type == NH_ANGLE;
        low = angle ? fmax(low, node[0]) : node[0], high = angle ? fmin(high, node[n - 1]) : node[n - 1];
        if (low < high) system->reach[system->reaches++] = (nh_interval){c->q, low, high};
    }
}

static void reach_tables(nh_system *system, nh_ex e)
{
    nh_dag *d = system->dag;
    NH_LIST(call);
    size_t calls = nh_functions_in(d, e, &call);
    for (size_t i = 0; i < calls; i++) {
        if (nh_function_of(d, call[i]) != NH_TABLE) continue;
        const nh_spline *s = nh_declared_table(d, (size_t)nh_number_of(d, nh_child(d, call[i], 0)).p);
        reach_table(system, nh_child(d, call[i], 2), s->nx, s->x);
        if (s->y) reach_table(system, nh_child(d, call[i], 3), s->ny, s->y);
    }
}

void nh_reach_walls(nh_system *system)
{
    nh_walls walls = {0};
    nh_walls_add(&walls, system->dag, system->lagrangian);
    for (size_t i = 0; i < system->coordinates && system->has_forces; i++)
        nh_walls_add(&walls, system->dag, system->force[i]);
    for (size_t a = 0; a < system->constraints; a++)
        nh_walls_add(&walls, system->dag, nh_sub(system->dag, system->constraint[a].lhs, system->constraint[a].rhs));
    system->reach = nh_arena_alloc(system->arena, (walls.count + system->coordinates + 1) * sizeof *system->reach);
    for (size_t i = 0; i < walls.count; i++) {
        nh_ex symbol = 0;
        if (!walls.edge[i] && only_symbol(system, walls.e[i], &symbol)) reach(system, walls.e[i], symbol);
    }
    if (!nh_declared_has_table(system->dag)) return;
    reach_tables(system, system->lagrangian);
    for (size_t i = 0; i < system->coordinates && system->has_forces; i++) reach_tables(system, system->force[i]);
    for (size_t a = 0; a < system->constraints; a++)
        reach_tables(system, nh_sub(system->dag, system->constraint[a].lhs, system->constraint[a].rhs));
}
