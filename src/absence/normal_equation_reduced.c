/* normal_equation_reduced: the variational equation across the plane.
 *
 *     d xi/dt = B xi,   B_ij = d rate_i/d y_j          the plane is invariant: its own directions do not enter
 *     F, E integrals:   F = f(E) on the plane, with f' = lambda = F_w/E_w constant along the curve
 *     eta = dF - lambda dE in normal directions        eta xi is constant, and 0 in N
 *
 * N is what all eta annihilate: one component is eliminated for each independent eta. */
#include "absence/normal_equation_internal.h"

#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"

/* Values of derivatives that are given as expressions of the plane's letters. */
static void values_of(const nh_normal_work *work, size_t n, nh_ex *e, nh_curve_element *value, nh_curve_state *state,
                      const char **why)
{
    for (size_t i = 0; i < n; i++) e[i] = nh_model_values(work->shape->model, e[i]);
    nh_curve_value(&work->place, n, e, value, state, why);
}

/* The rate of the field's variable: that of x, or x' (1 + t^2)/2 for t = tan(x/2). */
static void variable_rate(nh_normal_work *work, const nh_curve_element *rate)
{
    nh_curve_element factor;
    nh_curve_field_element_init(&factor);
    nh_curve_field_set_si(&factor, 1);
    if (work->plane->angle) {
        fmpz_poly_set_coeff_si(factor.even, 2, 1);
        fmpz_poly_set_ui(factor.den, 2);
    }
    nh_curve_field_mul(&work->field, &work->rate, rate, &factor);
    nh_curve_field_element_clear(&factor);
}

/* Is w' what the curve says, (w^2)'/(2 w) x'?  It is, if the curve is a level of an integral. */
static bool moves_along(const nh_normal_work *work, const nh_curve_element *velocity_rate)
{
    nh_curve_element w;
    nh_curve_field_element_init(&w);
    nh_curve_field_set_w(&w);
    nh_curve_field_derivative(&work->field, &w, &w);
    nh_curve_field_mul(&work->field, &w, &w, &work->rate);
    bool good = nh_curve_field_equal(&w, velocity_rate);
    nh_curve_field_element_clear(&w);
    return good;
}

/* B and the rate. */
static bool normal_block(nh_normal_work *work)
{
    enum { others = 2 }; /* the rates on the plane itself */
    size_t n = work->normals, entries = n * n, all = entries + others;
    const nh_plane *plane = work->plane;
    nh_ex *e = nh_alloc_array(all, sizeof *e);
    nh_curve_element *value = nh_curve_field_elements(all);
    nh_curve_state *state = nh_alloc_array(all, sizeof *state);
    const char **why = nh_alloc_array(all, sizeof *why);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) e[i * n + j] = nh_diff(work->dag, plane->rate[2 + i], plane->y[2 + j]);
    e[entries] = plane->rate[0];
    e[entries + 1] = plane->rate[1];
    values_of(work, all, e, value, state, why);
    bool good = true;
    for (size_t k = 0; k < all && good; k++)
        if (state[k] != NH_CURVE_FINE) good = nh_normal_equation_refuse(work, why[k]);
    for (size_t k = 0; k < entries && good; k++) nh_curve_field_set(&work->block[k], &value[k]);
    if (good) variable_rate(work, &value[entries]);
    if (good && nh_curve_field_is_zero(&work->rate)) good = nh_normal_equation_refuse(work, "nothing moves");
    if (good && !moves_along(work, &value[entries + 1]))
        good = nh_normal_equation_refuse(work, "the integral does not hold on the plane");
    nh_free(e);
    nh_free(state);
    nh_free(why);
    nh_curve_field_elements_free(value, all);
    return good;
}

/* F_w and dF in normal directions into 1 + normals elements. */
static bool slopes_of(const nh_normal_work *work, size_t k, nh_curve_element *slope)
{
    size_t n = work->normals + 1;
    nh_ex *e = nh_alloc_array(n, sizeof *e);
    nh_curve_state *state = nh_alloc_array(n, sizeof *state);
    for (size_t i = 0; i < n; i++) e[i] = nh_diff(work->dag, work->integral[k], work->plane->y[1 + i]);
    values_of(work, n, e, slope, state, NULL);
    bool good = true;
    for (size_t i = 0; i < n; i++) good = good && state[i] == NH_CURVE_FINE;
    nh_free(e);
    nh_free(state);
    return good;
}

/* row -= row[pivot] held_by for all that are there; then, unless it is 0, it becomes one of them. */
static bool join(nh_normal_work *work, nh_curve_element *row)
{
    size_t n = work->normals, p = n;
    const nh_curve_field *field = &work->field;
    nh_curve_element factor;
    nh_curve_field_element_init(&factor);
    for (size_t h = 0; h < work->held; h++) {
        nh_curve_field_set(&factor, &row[work->pivot[h]]);
        for (size_t j = 0; j < n; j++) nh_curve_field_submul(field, &row[j], &factor, &work->held_by[h * n + j]);
    }
    for (size_t j = n; j-- > 0 && p == n;) /* velocities go first */
        if (!nh_curve_field_is_zero(&row[j])) p = j;
    bool fresh = p < n && nh_curve_field_inv(field, &factor, &row[p]);
    for (size_t j = 0; fresh && j < n; j++) nh_curve_field_mul(field, &row[j], &row[j], &factor);
    for (size_t h = 0; fresh && h < work->held; h++) {
        nh_curve_field_set(&factor, &work->held_by[h * n + p]);
        for (size_t j = 0; j < n; j++) nh_curve_field_submul(field, &work->held_by[h * n + j], &factor, &row[j]);
    }
    for (size_t j = 0; fresh && j < n; j++) nh_curve_field_set(&work->held_by[work->held * n + j], &row[j]);
    if (fresh) work->pivot[work->held++] = p;
    nh_curve_field_element_clear(&factor);
    return fresh;
}

/* Is d eta/dt + eta B = 0?  It is, for an integral. */
static bool is_constant(const nh_normal_work *work, const nh_curve_element *eta)
{
    size_t n = work->normals;
    bool good = true;
    nh_curve_element sum, term;
    nh_curve_field_element_init(&sum);
    nh_curve_field_element_init(&term);
    for (size_t j = 0; j < n && good; j++) {
        nh_curve_field_derivative(&work->field, &sum, &eta[j]);
        nh_curve_field_mul(&work->field, &sum, &sum, &work->rate);
        for (size_t i = 0; i < n; i++) {
            nh_curve_field_mul(&work->field, &term, &eta[i], &work->block[i * n + j]);
            nh_curve_field_add(&sum, &sum, &term);
        }
        good = nh_curve_field_is_zero(&sum);
    }
    nh_curve_field_element_clear(&sum);
    nh_curve_field_element_clear(&term);
    return good;
}

/* Is it known that the integral has one value near the curve, up to signs of roots? */
static bool has_one_value(const nh_normal_work *work, size_t k)
{
    NH_LIST(call);
    nh_ex F = work->integral[k];
    bool good = !work->plane->angle || nh_closed_shape_periodic(work->dag, 1, &F, work->plane->y[0]);
    for (size_t i = nh_functions_in(work->dag, F, &call); i-- > 0;) {
        nh_function f = nh_function_of(work->dag, call[i]);
        good = good && (f == NH_SIN || f == NH_COS || f == NH_TAN || f == NH_EXP || f == NH_SINH || f == NH_COSH ||
                        f == NH_TANH || f == NH_PI);
    }
    return good;
}

/* Does the integral contain no exponential, and no hyperbolic function? */
static bool is_algebraic(const nh_normal_work *work, size_t k)
{
    NH_LIST(call);
    bool good = true;
    for (size_t i = nh_functions_in(work->dag, work->integral[k], &call); i-- > 0;) {
        nh_function f = nh_function_of(work->dag, call[i]);
        good = good && (f == NH_SIN || f == NH_COS || f == NH_TAN || f == NH_PI);
    }
    return good;
}

/* The integral is used. */
static void use(nh_normal_work *work, size_t k)
{
    nh_normal_equation *out = work->out;
    out->used[out->known++] = k;
    out->generic = out->generic && work->known->generic[k];
    out->single_valued = out->single_valued && has_one_value(work, k);
}

/* The integrals' covectors; those that vanish, or are no elements of K, are not used. */
static bool hold(nh_normal_work *work)
{
    size_t n = work->normals + 1;
    bool good = true;
    nh_normal_equation *out = work->out;
    nh_curve_element *energy = nh_curve_field_elements(n), *slope = nh_curve_field_elements(n), lambda;
    nh_curve_field_element_init(&lambda);
    good = slopes_of(work, work->determines, energy) && nh_curve_field_inv(&work->field, &energy[0], &energy[0]);
    if (!good) nh_normal_equation_refuse(work, "the differential of the integral has no value on the plane");
    use(work, work->determines);
    for (size_t k = 0; k < work->known->count && good; k++) {
        out->all_single_valued = out->all_single_valued && has_one_value(work, k);
        out->all_algebraic = out->all_algebraic && is_algebraic(work, k);
        if (k == work->determines) continue;
        bool usable = slopes_of(work, k, slope);
        if (usable) nh_curve_field_mul(&work->field, &lambda, &slope[0], &energy[0]);
        for (size_t j = 1; usable && j < n; j++) nh_curve_field_submul(&work->field, &slope[j], &lambda, &energy[j]);
        if (usable && !is_constant(work, slope + 1))
            good = nh_normal_equation_refuse(work, "an integral does not hold near the plane");
        if (good && usable && join(work, slope + 1)) use(work, k);
        else out->unused++;
    }
    nh_curve_field_element_clear(&lambda);
    nh_curve_field_elements_free(energy, n);
    nh_curve_field_elements_free(slope, n);
    return good;
}

/* xi_p = - sum eta_j xi_j: B_ij -= B_ip eta_j for the components that are kept. */
static void eliminate(nh_normal_work *work)
{
    size_t n = work->normals;
    for (size_t j = 0; j < n; j++) {
        bool is_pivot = false;
        for (size_t h = 0; h < work->held; h++) is_pivot |= work->pivot[h] == j;
        if (!is_pivot) work->kept[work->free++] = j;
    }
    for (size_t h = 0; h < work->held; h++)
        for (size_t a = 0; a < work->free; a++)
            for (size_t b = 0; b < work->free; b++) {
                size_t i = work->kept[a], j = work->kept[b];
                nh_curve_field_submul(&work->field, &work->block[i * n + j], &work->block[i * n + work->pivot[h]],
                                      &work->held_by[h * n + j]);
            }
}

bool nh_normal_equation_reduced(nh_normal_work *work)
{
    if (!normal_block(work) || !hold(work)) return false;
    eliminate(work);
    work->out->dimension = work->free;
    return true;
}
