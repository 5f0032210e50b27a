/* linearization_state: a state that satisfies the constraints to all bits.
 *
 *     positions    dq = -J^+ P, Gauss-Newton of least squares in the coordinates that may move
 *     velocities   f(v) = 0 with least 1/2 v^T K v over those that are not given; then, where those that are given do
 *                  not fit by rounding, or with `project`, the nearest velocities, in the metric K */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "geometry/linearization_internal.h"

enum { most_steps = 60 };

void nh_linear_set(nh_linear_work *w)
{
    for (size_t i = 0; i < w->l->m; i++) {
        nh_ball_set_arb(w->ball, w->l->q[i], w->q + i);
        nh_ball_set_arb(w->ball, w->l->v[i], w->v + i);
    }
}

/* First what the user calls dependent, then lengths, then in the order of the file. */
void nh_linear_order(const nh_linearization *l, const bool *last, size_t *order)
{
    const nh_system *system = l->system;
    size_t count = 0, classes = 4;
    for (size_t class = 0; class < classes; class ++)
        for (size_t i = 0; i < l->m; i++) {
            bool named = false;
            for (size_t j = 0; j < system->dependents; j++) named |= system->dependent[j] == i;
            size_t of = last && last[i] ? 3 : named ? 0 : system->coordinate[i].type == NH_LENGTH ? 1 : 2;
            if (of == class) order[count++] = i;
        }
}

/* Half of the bits: Newton's steps double the right ones, so the next step would reach all. */
static double converged(const nh_linear_work *w) { return ldexp(1, -(int)(w->bits / 2)); }

/* Adds a step, and drops the radii.  Returns its size relative to 1 + |x|. */
static double move(arb_ptr x, size_t count, const arb_mat_t step, long bits)
{
    double largest = 0;
    for (size_t i = 0; i < count; i++) {
        double size = 1 + nh_ball_upper(x + i);
        largest = fmax(largest, nh_ball_upper(arb_mat_entry(step, i, 0)) / size);
        arb_add(x + i, x + i, arb_mat_entry(step, i, 0), bits);
        arb_get_mid_arb(x + i, x + i);
    }
    return largest;
}

/* step = W J^T (J W J^T)^-1 (-r), over the columns that are free; dependent rows of J are left out. */
static bool least_step(const arb_mat_t J, const arb_mat_t r, const bool *free, arb_mat_t step, long bits)
{
    size_t rows = (size_t)arb_mat_nrows(J), m = (size_t)arb_mat_ncols(J);
    arb_mat_t both, A, square, transposed, y;
    size_t *order = nh_alloc_array(2 * m + 1, sizeof *order), *pivot = order + m;
    arb_mat_init(both, (slong)rows, (slong)(m + 1));
    for (size_t i = 0; i < rows; i++) {
        for (size_t j = 0; j < m; j++)
            if (!free || free[j]) arb_set(arb_mat_entry(both, i, j), arb_mat_entry(J, i, j));
        arb_set(arb_mat_entry(both, i, m), arb_mat_entry(r, i, 0));
    }
    for (size_t j = 0; j < m; j++) order[j] = j;
    slong rank = (slong)nh_linear_eliminate(both, m, order, pivot, bits);
    arb_mat_init(A, rank, (slong)m);
    arb_mat_init(transposed, (slong)m, rank);
    arb_mat_init(square, rank, rank);
    arb_mat_init(y, rank, 1);
    for (slong i = 0; i < rank; i++) {
        for (slong j = 0; j < (slong)m; j++) arb_set(arb_mat_entry(A, i, j), arb_mat_entry(both, i, j));
        arb_neg(arb_mat_entry(y, i, 0), arb_mat_entry(both, i, m));
    }
    arb_mat_transpose(transposed, A);
    arb_mat_mul(square, A, transposed, bits);
    bool good = arb_mat_solve(y, square, y, bits);
    if (good) arb_mat_mul(step, transposed, y, bits);
    arb_mat_struct *const all[] = {both, A, square, transposed, y};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) arb_mat_clear(all[i]);
    nh_free(order);
    return good;
}

/* Gauss-Newton for `rows` equations e = 0 with the derivatives J in the symbols whose values are x. */
static bool newton(nh_linear_work *w, size_t rows, const nh_ex *e, const nh_ex *J, const bool *free, arb_ptr x,
                   double *first_step)
{
    size_t m = w->l->m;
    double size = INFINITY;
    *first_step = 0;
    for (int i = 0; i < most_steps && rows; i++) {
        arb_mat_t matrix, rest, step;
        nh_linear_set(w);
        arb_mat_init(step, (slong)m, 1);
        bool good = nh_linear_load(w->ball, rows, m, J, matrix);
        good = nh_linear_load(w->ball, rows, 1, e, rest) && good;
        good = good && least_step(matrix, rest, free, step, w->bits);
        if (good) size = move(x, m, step, w->bits);
        arb_mat_clear(step);
        arb_mat_clear(rest);
        arb_mat_clear(matrix);
        if (!good) return false;
        if (i == 0) *first_step = size;
        if (size <= converged(w)) break;
    }
    nh_linear_set(w);
    return !rows || size <= converged(w);
}

/* The largest |e|, after Newton's steps: may be large where the rows that were left out contradict. */
static double left(nh_linear_work *w, size_t rows, const nh_ex *e, size_t *worst)
{
    double largest = 0;
    arb_t value;
    arb_init(value);
    for (size_t i = 0; i < rows; i++) {
        if (!nh_ball_eval(w->ball, e[i], value)) largest = INFINITY;
        else if (nh_ball_upper(value) > largest) largest = nh_ball_upper(value), *worst = i;
    }
    arb_clear(value);
    return largest;
}

bool nh_linear_positions(nh_linear_work *w, const bool *free, double *first_step)
{
    size_t worst;
    return newton(w, w->l->p, w->l->P, w->l->P_q, free, w->q, first_step) &&
           left(w, w->l->p, w->l->P, &worst) <= converged(w);
}

bool nh_linear_dependent_velocities(nh_linear_work *w)
{
    const nh_linearization *l = w->l;
    bool *free = nh_alloc_array(l->m + 1, sizeof *free);
    double step;
    size_t worst;
    for (size_t r = 0; r < l->k; r++) free[w->dependent[r]] = true;
    bool good = newton(w, l->k, l->f, l->F, free, w->v, &step) && left(w, l->k, l->f, &worst) <= converged(w);
    nh_free(free);
    return good;
}

/* ---- least kinetic energy ---- */

/* On the velocities that satisfy the constraints, R dw over the free ones: R^T K R dw = -R^T K v. */
static bool least_energy(nh_linear_work *w, const bool *free)
{
    const nh_linearization *l = w->l;
    size_t m = l->m, k = l->k, count = 0;
    arb_mat_t K, F, R, left_side, right, speed, step, part;
    size_t *order = nh_alloc_array(2 * m + 1, sizeof *order), *pivot = order + m;
    bool good = nh_linear_load(w->ball, m, m, l->K, K);
    good = nh_linear_load(w->ball, k, m, l->F, F) && good;
    for (size_t a = 0; a < k && good; a++)
        for (size_t j = 0; j < m; j++)
            if (!free[j]) arb_zero(arb_mat_entry(F, a, j));
    for (size_t j = 0; j < m; j++) order[j] = j;
    size_t rank = good ? nh_linear_eliminate(F, m, order, pivot, w->bits) : 0;
    for (size_t j = rank; j < m; j++)
        if (free[pivot[j]]) pivot[rank + count++] = pivot[j];
    arb_mat_init(R, (slong)m, (slong)count);
    arb_mat_init(part, (slong)count, (slong)m);
    arb_mat_init(left_side, (slong)count, (slong)count);
    arb_mat_init(right, (slong)count, 1);
    arb_mat_init(speed, (slong)m, 1);
    arb_mat_init(step, (slong)m, 1);
    for (size_t i = 0; i < count && good; i++) {
        size_t j = pivot[rank + i];
        arb_one(arb_mat_entry(R, j, i));
        for (size_t r = 0; r < rank; r++) arb_neg(arb_mat_entry(R, pivot[r], i), arb_mat_entry(F, r, j));
    }
    for (size_t j = 0; j < m; j++) arb_neg(arb_mat_entry(speed, j, 0), w->v + j);
    arb_mat_t transposed;
    arb_mat_init(transposed, (slong)count, (slong)m);
    arb_mat_transpose(transposed, R);
    if (good) {
        arb_mat_mul(part, transposed, K, w->bits);
        arb_mat_mul(left_side, part, R, w->bits);
        arb_mat_mul(right, part, speed, w->bits);
        good = arb_mat_solve(right, left_side, right, w->bits);
    }
    if (good) {
        arb_mat_mul(step, R, right, w->bits);
        move(w->v, m, step, w->bits);
    }
    arb_mat_struct *const all[] = {K, F, R, left_side, right, speed, step, part, transposed};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) arb_mat_clear(all[i]);
    nh_free(order);
    return good;
}

/* ---- the start ---- */

static bool off(nh_linear_work *w, const char *what, const nh_constraint *c, double by, nh_error *error)
{
    (void)w;
    nh_fail(error, NH_USAGE, "", "the state violates the constraint `%s`: its %s are off by %.2g", c->text, what, by);
    return nh_error_hint(error, "leave out %s that follow from the constraints, or add --project", what);
}

static const nh_constraint *position_constraint(const nh_system *system, size_t index)
{
    size_t c = 0;
    while (!system->constraint[c].position || index--) c++;
    return &system->constraint[c];
}

/* Typed numbers may be rounded: such a step is no projection. */
static const double rounding = 1e-8;

/* First with those positions fixed that were given (with `project`), then with all free; a step beyond rounding is an
 * error, unless `project`. */
static bool start_positions(nh_linear_work *w, const nh_linear_state *state, nh_error *error)
{
    const nh_linearization *l = w->l;
    size_t m = l->m, worst = 0;
    double step, by = (nh_linear_set(w), left(w, l->p, l->P, &worst));
    bool *free = nh_alloc_array(m + 1, sizeof *free);
    for (size_t i = 0; i < m; i++) free[i] = !state->given[i];
    arb_ptr typed = _arb_vec_init((slong)m);
    _arb_vec_set(typed, w->q, (slong)m);
    /* those that were typed stay where they are, if that is possible */
    bool good = state->project && nh_linear_positions(w, free, &step);
    if (!good) {
        _arb_vec_set(w->q, typed, (slong)m);
        good = nh_linear_positions(w, NULL, &step);
        if (good && !state->project && step > rounding)
            good = off(w, "positions", position_constraint(l->system, worst), by, error);
    }
    if (!good) {
        nh_fail(error, NH_NUMERIC, "", "no positions near this state satisfy the constraints");
        nh_error_hint(error, "begin nearer to a solution, or at a place where the constraints are independent");
    }
    _arb_vec_clear(typed, (slong)m);
    nh_free(free);
    return good;
}

/* 1. The velocities that were not given take up the constraints.  2. Among these, the least kinetic energy.  3. Where
 * that does not suffice, all move: by rounding, or with `project`. */
static bool start_velocities(nh_linear_work *w, const nh_linear_state *state, nh_error *error)
{
    const nh_linearization *l = w->l;
    size_t m = l->m, worst = 0;
    double step;
    bool *free = nh_alloc_array(m + 1, sizeof *free), any = false;
    for (size_t i = 0; i < m; i++) any |= free[i] = !state->given[m + i];
    bool good = newton(w, l->k, l->f, l->F, free, w->v, &step);
    /* without a metric the shortest ones stay */
    if (good && any && least_energy(w, free)) good = newton(w, l->k, l->f, l->F, free, w->v, &step);
    double by = good ? left(w, l->k, l->f, &worst) : 0;
    if (good && by > converged(w)) {
        good = newton(w, l->k, l->f, l->F, NULL, w->v, &step);
        if (good && !state->project && step > rounding)
            good = off(w, "velocities", &l->system->constraint[worst], by, error);
    }
    nh_free(free);
    if (good) return true;
    nh_fail(error, NH_NUMERIC, "", "no velocities that satisfy the constraints were found at this state");
    return nh_error_hint(error, "give other velocities, or a state where the constraints are independent");
}

/* At a kink there is no linear equation: |x|, or friction without motion. */
static bool smooth(nh_linear_work *w, nh_error *error)
{
    arb_t value;
    arb_init(value);
    bool good = true;
    for (size_t i = 0; i < w->l->walls && good; i++)
        good = !nh_ball_eval(w->ball, w->l->wall[i], value) || !nh_linear_vanishes(value, 1);
    arb_clear(value);
    if (good) return true;
    nh_fail(error, NH_NUMERIC, "",
            "the equations of motion have a kink or a jump at this state: there are no linear "
            "equations");
    return nh_error_hint(error, "abs(x), sign(x) and sqrt(x) are not smooth at x = 0: take a state beside it");
}

bool nh_linear_start(nh_linear_work *w, const nh_linear_state *state, nh_error *error)
{
    const nh_linearization *l = w->l;
    size_t m = l->m;
    bool good = true;
    good = nh_ball_eval(w->ball, state->value[0], w->begin);
    nh_ball_set_arb(w->ball, l->system->t, w->begin);
    for (size_t i = 0; i < 2 * m && good; i++) {
        arb_ptr x = i < m ? w->q + i : w->v + (i - m);
        good = nh_ball_eval(w->ball, state->value[1 + i], x);
        arb_get_mid_arb(x, x);
    }
    if (!good) return nh_fail(error, NH_USAGE, "--at", "a value of the state is not finite");
    return start_positions(w, state, error) && start_velocities(w, state, error) && smooth(w, error);
}
