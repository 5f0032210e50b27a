#include "document/current_words.h"

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"

/* A field on (t, q): the symmetry itself, or its part that is no motion. */
typedef struct {
    const nh_model *o;
    nh_ex time, *space;     /* m */
    bool velocities, clock; /* components contain velocities; t */
    size_t moved;           /* coordinates that move */
} shape;

static bool has_velocities(const nh_model *model, nh_ex e)
{
    for (size_t i = 0; i < model->n; i++)
        if (nh_depends(model->dag, e, model->chart->w[i])) return true;
    for (size_t i = 0; i < model->chart->implicit; i++)
        if (nh_depends(model->dag, e, model->chart->u[i])) return true;
    return false;
}

static void look(shape *x)
{
    const nh_model *model = x->o;
    x->moved = 0;
    x->velocities = x->clock = false;
    for (size_t s = 0; s <= model->m; s++) {
        nh_ex e = s < model->m ? x->space[s] : x->time;
        x->moved += s < model->m && !nh_is_zero(model->dag, e);
        x->clock |= nh_depends(model->dag, e, model->system->t);
        x->velocities |= has_velocities(model, e);
    }
}

/* Z + f Gamma moves the same solutions as Z.  With zeta = xi - tau v, the part of Z that is no motion, tau and xi are
 * the components of a field on (t, q), if they contain no velocities.  Free systems in coordinate velocities only. */
static bool without_motion(const nh_model *model, const nh_symmetry *z, shape *x)
{
    enum { longest = 200 };
    nh_dag *d = model->dag;
    if (model->k || model->n != model->m || model->framed || model->chart->quasi || model->chart->implicit)
        return false;
    for (size_t i = 0; i < model->n; i++)
        if (nh_kind_of(d, model->rho[i]) != NH_SYMBOL || nh_complexity(d, z->zeta[i]) > longest) return false;
    nh_ex *xi = nh_arena_alloc(model->arena, model->m * sizeof *xi), tau = 0;
    for (size_t s = 0; s < model->m; s++) {
        nh_ex Q = nh_int(d, 0);
        for (size_t i = 0; i < model->n; i++)
            Q = nh_add(d, Q, nh_mul(d, z->zeta[i], nh_diff(d, model->rho[s], model->chart->w[i])));
        if (!s) tau = nh_simplify(d, nh_neg(d, nh_diff(d, Q, model->rho[s])));
        xi[s] = nh_simplify(d, nh_add(d, Q, nh_mul(d, tau, model->rho[s])));
    }
    *x = (shape){.o = model, .time = tau, .space = xi};
    look(x);
    return !x->velocities;
}

/* Are all components c q^s, with a constant c that may be 0; of t c t + c'? */
static bool is_scaling(const shape *x)
{
    nh_dag *d = x->o->dag;
    for (size_t s = 0; s <= x->o->m; s++) {
        nh_ex e = s < x->o->m ? x->space[s] : x->time,
              q = s < x->o->m ? x->o->system->coordinate[s].q : x->o->system->t;
        nh_ex c = nh_simplify(d, nh_diff(d, e, q)), rest = nh_simplify(d, nh_sub(d, e, nh_mul(d, c, q)));
        if (!nh_model_is_constant(x->o, c) || !nh_model_is_constant(x->o, rest)) return false;
        if (s < x->o->m && !nh_is_zero(d, rest)) return false;
    }
    return true;
}

/* Are all components c t? */
static bool is_boost(const shape *x)
{
    nh_dag *d = x->o->dag;
    for (size_t s = 0; s < x->o->m; s++) {
        nh_ex c = nh_simplify(d, nh_diff(d, x->space[s], x->o->system->t));
        nh_ex rest = nh_simplify(d, nh_sub(d, x->space[s], nh_mul(d, c, x->o->system->t)));
        if (!nh_model_is_constant(x->o, c) || !nh_is_zero(d, rest)) return false;
    }
    return true;
}

/* Do the components depend on t alone; on nothing (`constant`)? */
static bool is_shift(const shape *x, bool constant)
{
    const nh_system *system = x->o->system;
    for (size_t s = 0; s < x->o->m; s++) {
        for (size_t r = 0; r < x->o->m; r++)
            if (nh_depends(x->o->dag, x->space[s], system->coordinate[r].q)) return false;
        if (constant && !nh_model_is_constant(x->o, x->space[s])) return false;
    }
    return true;
}

/* Is the field z^s = A^s_r q^r on lengths, with a constant A = -A^T, and constant on the other coordinates?  The rows
 * of A that are not zero are counted. */
static bool is_rotation(const shape *x, size_t *rows)
{
    const nh_model *o = x->o;
    nh_dag *d = o->dag;
    const nh_coordinate *c = o->system->coordinate;
    *rows = 0;
    for (size_t s = 0; s < o->m; s++) {
        if (c[s].type == NH_ANGLE) {
            if (!nh_model_is_constant(o, x->space[s])) return false;
            continue;
        }
        nh_ex rest = x->space[s];
        for (size_t r = 0; r < o->m; r++) {
            nh_ex A = nh_simplify(d, nh_diff(d, x->space[s], c[r].q));
            if (nh_is_zero(d, A)) continue;
            if (c[r].type == NH_ANGLE || !nh_model_is_constant(o, A)) return false;
            nh_ex back = nh_simplify(d, nh_add(d, A, nh_diff(d, x->space[r], c[s].q)));
            if (!nh_is_zero(d, back)) return false;
            rest = nh_sub(d, rest, nh_mul(d, A, c[r].q));
        }
        if (!nh_is_zero(d, nh_simplify(d, rest))) return false;
        *rows += !nh_is_zero(d, x->space[s]);
    }
    return *rows > 1;
}

/* "time, x and phi": what moves. */
static void put_moved(const shape *x, nh_text *out)
{
    enum { most_named = 4 };
    bool time = !nh_is_zero(x->o->dag, x->time);
    size_t told = time;
    if (time) nh_text_add(out, x->moved && x->moved <= most_named ? "time" : x->moved ? "time and " : "time");
    if (x->moved > most_named) nh_text_addf(out, "%zu coordinates", x->moved);
    for (size_t s = 0; s < x->o->m && x->moved <= most_named; s++) {
        if (nh_is_zero(x->o->dag, x->space[s])) continue;
        nh_text_addf(out, "%s%s",
                     !told                         ? ""
                     : told + 1 == x->moved + time ? " and "
                                                   : ", ",
                     x->o->system->coordinate[s].name);
        told++;
    }
}

/* The coordinate about which the two others are turned, where the positions are three lengths; SIZE_MAX: none. */
static size_t axis_of(const shape *x)
{
    size_t axis = SIZE_MAX;
    for (size_t s = 0; s < x->o->m; s++) {
        if (x->o->system->coordinate[s].type == NH_ANGLE) return SIZE_MAX;
        if (nh_is_zero(x->o->dag, x->space[s])) axis = s;
    }
    return x->o->m == 3 ? axis : SIZE_MAX;
}

static const char *involved(const shape *x)
{
    return !x->velocities ? "a symmetry that involves time"
           : x->clock     ? "a symmetry that involves time and the velocities"
                          : "a symmetry that involves the velocities";
}

static bool rotation_words(const shape *x, size_t rows, const char **how, nh_text *what)
{
    size_t axis = axis_of(x);
    bool plane = rows == 2 && x->moved == 2;
    *how = !plane ? "rotations" : axis < SIZE_MAX ? "rotations about" : "rotations in the plane of";
    if (plane && axis < SIZE_MAX) nh_text_add(what, x->o->system->coordinate[axis].name);
    else if (plane) put_moved(x, what);
    return true;
}

bool nh_symmetry_words(const nh_model *model, const nh_symmetry *z, const char **how, nh_text *what)
{
    nh_dag *d = model->dag;
    shape x = {.o = model, .time = z->field.time, .space = z->field.space};
    size_t rows;
    look(&x);
    if (x.velocities && !without_motion(model, z, &x)) {
        x.velocities = true;
        for (size_t s = 0; s <= model->m; s++)
            x.clock |= nh_depends(d, s < model->m ? z->field.space[s] : z->field.time, model->system->t);
        *how = involved(&x);
        return false;
    }
    bool time = !nh_is_zero(d, x.time);
    if (time && !x.moved && nh_model_is_constant(model, x.time)) {
        *how = "the symmetry in time";
        return false;
    }
    if (!time && is_rotation(&x, &rows)) return rotation_words(&x, rows, how, what);
    if (!time && is_shift(&x, true)) {
        size_t s = 0;
        while (nh_is_zero(d, x.space[s])) s++;
        *how = x.moved > 1                                     ? "a joint shift of"
               : model->system->coordinate[s].type == NH_ANGLE ? "turning"
                                                               : "shifting";
    } else if (!time && is_boost(&x)) *how = "boosts along";
    else if (!time && is_shift(&x, false)) *how = "time-dependent shifts of";
    else if (is_scaling(&x)) *how = "a scaling of";
    else if (x.clock) {
        *how = involved(&x);
        return false;
    } else *how = "a symmetry that moves";
    put_moved(&x, what);
    return false;
}
