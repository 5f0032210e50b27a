/* A stage of the search: two coordinates with linear equations that a turn of their plane leaves as they are, so that
 * they are one equation in zeta = x + i y, with a spring, damping, a gyroscope's or magnetic force, a follower force:
 *
 *     zeta'' = C zeta' + K zeta,   lambda = (C +- sqrt(D))/2,   D = C^2 + 4 K = X + i Y
 *
 * (zeta' - lambda_2 zeta) exp(-lambda_1 t) is constant, and its conjugate; with p = sqrt((|D| + X)/2) the root is
 * p + i Y/(2 p): roots of real numbers only. */
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "search/stage_solver.h"

typedef struct {
    nh_ex re, im;
} number;

/* Real and imaginary part of the matrix ((re, -im), (im, re)); false where it is of another form. */
static bool as_number(nh_dag *d, const nh_ex a[4], number *out)
{
    *out = (number){a[0], a[1]};
    return nh_normal_is_zero(d, nh_sub(d, a[0], a[3]), 0) == NH_ZERO &&
           nh_normal_is_zero(d, nh_add(d, a[1], a[2]), 0) == NH_ZERO;
}

/* sqrt(D); false where D is real, or has no value. */
static bool root_of(const nh_model *model, number D, number *out)
{
    nh_dag *d = model->dag;
    nh_ex two = nh_int(d, 2), square = nh_add(d, nh_mul(d, D.re, D.re), nh_mul(d, D.im, D.im));
    nh_ex size = nh_sqrt(d, nh_simplify_short(d, square, 0));
    out->re = nh_sqrt(d, nh_div(d, nh_add(d, size, D.re), two));
    out->im = nh_div(d, D.im, nh_mul(d, two, out->re));
    return nh_model_sign(model, out->re) > 0 && !nh_is_zero(d, D.im);
}

/* The two currents with exp(-lambda t), `other` the other root. */
static size_t currents(nh_stage_solver *solver, const nh_ex q[2], const nh_ex v[2], number lambda, number other)
{
    nh_dag *d = solver->r->question->model->dag;
    nh_ex t = solver->r->question->system->t, angle = nh_mul(d, lambda.im, t);
    nh_ex decay = nh_call(d, NH_EXP, nh_neg(d, nh_mul(d, lambda.re, t)));
    nh_ex cosine = nh_mul(d, decay, nh_call(d, NH_COS, angle)), sine = nh_mul(d, decay, nh_call(d, NH_SIN, angle));
    nh_ex u[] = {nh_add(d, nh_sub(d, v[0], nh_mul(d, other.re, q[0])), nh_mul(d, other.im, q[1])),
                 nh_sub(d, nh_sub(d, v[1], nh_mul(d, other.re, q[1])), nh_mul(d, other.im, q[0]))};
    nh_ex e[] = {nh_add(d, nh_mul(d, u[0], cosine), nh_mul(d, u[1], sine)),
                 nh_sub(d, nh_mul(d, u[1], cosine), nh_mul(d, u[0], sine))};
    size_t found = 0;
    for (size_t i = 0; i < 2 && !nh_stage_solver_done(solver); i++)
        found += nh_stage_solver_certify(solver, e[i], "a complex coordinate with a linear equation");
    return found;
}

size_t nh_complex_pair_search(nh_stage_solver *solver, const nh_complex_pair *pair)
{
    const nh_model *model = solver->r->question->model;
    nh_dag *d = model->dag;
    number C, K, root;
    if (!as_number(d, pair->C, &C) || !as_number(d, pair->K, &K)) return 0;
    nh_ex half = nh_ratio(d, 1, 2), four = nh_int(d, 4), cross = nh_product(d, 3, (nh_ex[]){nh_int(d, 2), C.re, C.im});
    number D = {nh_sub(d, nh_mul(d, C.re, C.re), nh_mul(d, C.im, C.im)), cross};
    D.re = nh_simplify_short(d, nh_add(d, D.re, nh_mul(d, four, K.re)), 0);
    D.im = nh_simplify_short(d, nh_add(d, D.im, nh_mul(d, four, K.im)), 0);
    if (!root_of(model, D, &root)) return 0;
    number a = {nh_mul(d, half, nh_add(d, C.re, root.re)), nh_mul(d, half, nh_add(d, C.im, root.im))},
           b = {nh_mul(d, half, nh_sub(d, C.re, root.re)), nh_mul(d, half, nh_sub(d, C.im, root.im))};
    return currents(solver, pair->q, pair->v, a, b) + currents(solver, pair->q, pair->v, b, a);
}
