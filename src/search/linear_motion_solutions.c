/* The currents of linear equations z' = A z + b that belong to one rate: with l' = -A^T l
 *
 *     l . z - int l . b dt
 *
 * is conserved.  The l of given functions of t (waves, and powers of t where the rate occurs several times) are the
 * null space of a matrix of expressions, which is exact, and so is the integral: where the drive is in resonance, or
 * waves are slow, the functions that an ansatz needs are nearly dependent on the interval of the samples. */
#include "exact/normal.h"
#include "exact/relation_space.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"
#include "graph/terms.h"
#include "search/linear_motion_internal.h"

typedef nh_linear_motion_block linear;

/* ---- the drives ---- */

/* The function of t that the term is a constant multiple of. */
static nh_ex function_of_time(nh_dag *d, nh_ex term, nh_ex t)
{
    if (nh_kind_of(d, term) != NH_PRODUCT) return nh_depends(d, term, t) ? term : nh_int(d, 1);
    nh_ex g = nh_int(d, 1);
    for (size_t i = 0; i < nh_arity(d, term); i++) {
        nh_ex factor = nh_pow(d, nh_child(d, term, i), nh_exponent_of(d, term, i));
        if (nh_depends(d, factor, t)) g = nh_mul(d, g, factor);
    }
    return g;
}

static bool add_drive(linear *l, nh_ex term)
{
    nh_dag *d = l->x->r->question->model->dag;
    nh_ex g = function_of_time(d, term, l->x->r->question->system->t);
    bool old = nh_is_zero(d, term);
    for (size_t i = 0; i < l->drives && !old; i++) old = g == l->drive[i];
    if (!old && l->drives == NH_LINEAR_MOTION_DRIVES) return false;
    if (!old) l->drive[l->drives++] = g;
    return true;
}

/* The functions of the terms of e that are new, sums below factors multiplied out; false where they are too many. */
static bool add_drives(linear *l, nh_ex e)
{
    nh_ex *part;
    bool fits = true;
    size_t n = nh_terms_of(l->x->r->question->model->dag, e, &part);
    if (n == 1) fits = add_drive(l, e);
    for (size_t k = 1; k < n && fits; k++) fits = add_drives(l, part[k]);
    nh_free(part);
    return fits;
}

/* b of one row, from which the terms with z are taken, and the derivatives of its functions. */
static bool drive(linear *l, nh_ex b)
{
    const nh_model *model = l->x->r->question->model;
    size_t first = l->drives;
    bool fits = add_drives(l, nh_simplify_short(model->dag, b, 0));
    for (size_t i = first; i < l->drives && fits; i++)
        fits = add_drives(l, nh_simplify_short(model->dag, nh_diff(model->dag, l->drive[i], model->system->t), 0));
    return fits;
}

bool nh_linear_motion_drives(linear *l)
{
    bool fits = true;
    l->drives = 0;
    l->drive[l->drives++] = nh_int(l->x->r->question->model->dag, 1);
    for (size_t i = 0; i < l->size && fits; i++) fits = drive(l, l->b[i]);
    return fits;
}

/* ---- the currents ---- */

/* The l = sum of coefficients times functions: column i n + k is function k in component i, row j the j-th component of
 * l' + A^T l. */
static nh_relation_space *space_of(const linear *l, size_t n, const nh_ex *function)
{
    const nh_model *model = l->x->r->question->model;
    nh_dag *d = model->dag;
    size_t rows = l->count, columns = n * rows;
    nh_ex *entry = nh_alloc_array(rows * columns + 1, sizeof *entry);
    for (size_t c = 0; c < columns; c++)
        for (size_t j = 0; j < rows; j++) {
            size_t i = c / n;
            nh_ex f = function[c % n], e = nh_mul(d, f, l->entry[l->of[i] + l->of[j] * l->size]);
            entry[c * rows + j] = i == j ? nh_add(d, e, nh_diff(d, f, model->system->t)) : e;
        }
    nh_relation_columns q = {.dag = d,
                             .columns = columns,
                             .rows = rows,
                             .entry = entry,
                             .variables = 1,
                             .variable = &model->system->t,
                             .parameters = model->system->parameters,
                             .parameter = model->parameter};
    nh_relation_space *space = nh_relation_space_of(l->x->r->arena, &q);
    nh_free(entry);
    return space;
}

size_t nh_linear_motion_solutions(const linear *l, size_t n, const nh_ex *function)
{
    nh_stage_solver *x = l->x;
    const nh_model *model = x->r->question->model;
    nh_dag *d = model->dag;
    size_t found = 0, columns = n * l->count;
    nh_relation_space *space = space_of(l, n, function);
    for (size_t k = 0; k < space->proved && !space->obstacle && !nh_stage_solver_done(x); k++) {
        nh_ex state = nh_int(d, 0), drive = state, F;
        for (size_t c = 0; c < columns; c++) {
            size_t i = l->of[c / n];
            nh_ex f = nh_mul(d, space->coefficient[k * columns + c], function[c % n]);
            state = nh_add(d, state, nh_mul(d, f, l->z[i]));
            drive = nh_add(d, drive, nh_mul(d, f, l->b[i]));
        }
        if (!nh_stage_solver_integral(x, model->system->t, nh_simplify_short(d, drive, 0), false, &F)) continue;
        found += nh_stage_solver_certify(x, nh_simplify_short(d, nh_sub(d, state, F), 0),
                                         "states with linear equations, times functions of t");
    }
    return found;
}
