/* currents_fit: residuals of currents at points that no fit has seen, and currents of systems with tables, of which
 * there is nothing else (integrals/fitted.h). */
#include <float.h>
#include <math.h>

#include "base/linalg.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"
#include "integrals/fitted.h"
#include "integrals/recognise.h"
#include "search/current_checker.h"

/* max |Gamma(Phi)| / max(sum |terms of it|, 1e-3 |dPhi| |Gamma|). */
double nh_currents_residual(const nh_model *model, const nh_points *points, nh_ex phi)
{
    size_t width = 1 + model->m + model->n, count = points->count;
    nh_ex *e = nh_alloc_array(2 * width, sizeof *e);
    double *value = nh_alloc_array(2 * width * count, sizeof *value), worst = 0;
    for (size_t j = 0; j < width; j++) {
        e[j] = j == 0 ? nh_int(model->dag, 1) : j <= model->m ? model->rho[j - 1] : model->a[j - 1 - model->m];
        e[width + j] = nh_diff(model->dag, phi, model->chart->symbol[j]);
    }
    nh_points_evaluate(points, model, 2 * width, e, value);
    for (size_t p = 0; p < count; p++) {
        double sum = 0, size = 0, g = 0, speed = 0;
        for (size_t j = 0; j < width; j++) {
            double x = value[j * count + p], y = value[(width + j) * count + p];
            sum += x * y;
            size += fabs(x * y);
            g += y * y;
            speed += x * x;
        }
        double r = fabs(sum) / fmax(fmax(size, 1e-3 * sqrt(g * speed)), DBL_MIN);
        if (isfinite(r)) worst = fmax(worst, r);
    }
    nh_free(value);
    nh_free(e);
    return worst;
}

/* sum_j c_j b_j; `tolerance` > 0: with simple coefficients, and without terms that are smaller than it.  0: some
 * number is not simple. */
static nh_ex rounded(const nh_current_checker *checker, const nh_candidate *c, double tolerance)
{
    const nh_model *model = checker->result->question->model;
    const nh_points *points = checker->heldout;
    nh_dag *d = model->dag;
    nh_ex sum = nh_int(d, 0);
    bool good = true;
    double largest = 0, *size = nh_alloc_array(c->count, sizeof *size);
    double *value = nh_alloc_array(c->count * points->count, sizeof *value);
    nh_points_evaluate(points, model, c->count, c->term, value);
    for (size_t j = 0; j < c->count; j++) {
        size[j] = fabs(c->coefficient[j]) * nh_norm(points->count, value + j * points->count);
        largest = fmax(largest, size[j]);
    }
    for (size_t j = 0; j < c->count && good; j++) {
        nh_ex number = nh_real(d, c->coefficient[j]);
        if (tolerance > 0 && size[j] <= tolerance * largest) continue;
        good = !(tolerance > 0) || nh_recognise_number(d, c->coefficient[j], tolerance, &number);
        sum = nh_add(d, sum, nh_mul(d, number, c->term[j]));
    }
    nh_free(value);
    nh_free(size);
    return good ? sum : 0;
}

/* A combination of a system with tables, at points that no fit has seen: simple coefficients are taken where its
 * residual hardly grows by it, and others are fitted again there. */
void nh_currents_fit(const nh_current_checker *checker, const nh_candidate *c, nh_current *f)
{
    static const double hardly = 3, least = 1e-10, most = 1e-2, wider = 10;
    const nh_model *model = checker->result->question->model;
    const nh_options *options = &checker->result->question->options;
    f->fitted = true;
    f->phi = rounded(checker, c, 0);
    f->heldout = fmax(nh_currents_residual(model, checker->heldout, f->phi), DBL_EPSILON);
    nh_ex simple = rounded(checker, c, fmax(least, fmin(most, wider * f->heldout)));
    double residual = simple ? fmax(nh_currents_residual(model, checker->heldout, simple), DBL_EPSILON) : INFINITY;
    f->exact = residual <= hardly * f->heldout;
    f->fit_digits = f->exact ? INFINITY : nh_fitted_again(model, checker->heldout, c, options);
    if (f->exact) f->phi = simple, f->heldout = residual;
    if (nh_kind_of(model->dag, f->phi) == NH_PRODUCT) /* a number as a factor says nothing */
        f->phi = nh_div(model->dag, f->phi, nh_number(model->dag, nh_constant_of(model->dag, f->phi)));
}
