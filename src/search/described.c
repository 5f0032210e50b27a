#include "search/described.h"

#include <math.h>
#include <string.h>

#include "exact/normal.h"
#include "exact/relation_express.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "integrals/fixed.h"
#include "integrals/symmetry.h"
#include "problem/analysis_file.h"
#include "search/current_list.h"

static const size_t longest = 3000; /* largest complexity of a current whose form is chosen here */

/* ---- normalisation: the symmetry's simplest component gets coefficient one ---- */

/* The shortest form, which does not depend on how e was written: of equally short forms that of the expanded sum. */
static nh_ex shortest(nh_dag *d, nh_ex e)
{
    nh_ex as_written = nh_simplify_short(d, e, 0), sum = as_written;
    if (nh_is_short(d, e) && nh_complexity(d, e) <= longest) sum = nh_simplify_short(d, nh_canonical_sum(d, e), 0);
    return nh_complexity(d, sum) <= nh_complexity(d, as_written) ? sum : as_written;
}

/* The factor of e that contains numbers and parameters only. */
static nh_ex parametric_factor(const nh_model *model, nh_ex e)
{
    nh_dag *d = model->dag;
    if (nh_kind_of(d, e) != NH_PRODUCT) return nh_model_is_constant(model, e) ? e : nh_int(d, 1);
    nh_ex factor = nh_number(d, nh_constant_of(d, e));
    for (size_t i = 0; i < nh_arity(d, e); i++) {
        nh_ex base = nh_child(d, e, i), x = nh_exponent_of(d, e, i);
        if (nh_model_is_constant(model, base) && nh_model_is_constant(model, x))
            factor = nh_mul(d, factor, nh_pow(d, base, x));
    }
    return factor;
}

/* A factor c is no unit: it may be 0. */
static bool is_unit(const nh_model *model, nh_ex factor)
{
    double value = nh_model_number(model, factor);
    return isfinite(value) && value != 0;
}

/* The divisor of the current: Z^0 where it is a constant, so that the energy's symmetry is d/dt; else the simplest
 * factor of zeta. */
static nh_ex unit_of(const nh_model *model, nh_ex Z0, const nh_ex *zeta)
{
    nh_dag *d = model->dag;
    if (nh_model_is_constant(model, Z0) && is_unit(model, Z0)) return Z0;
    nh_ex best = nh_int(d, 1);
    size_t least = SIZE_MAX;
    for (size_t i = model->n; i-- > 0;) { /* of equally simple components the last one is taken */
        if (nh_is_zero(d, zeta[i])) continue;
        nh_ex factor = parametric_factor(model, zeta[i]);
        size_t size = nh_is_number(d, factor, 1) ? 0 : nh_complexity(d, factor);
        if (size >= least || !is_unit(model, factor)) continue;
        least = size;
        best = factor;
    }
    return best;
}

/* The fixed parameters' values in a list of expressions. */
static void put_values(nh_model *model, const nh_ex *fixed, size_t n, nh_ex *e)
{
    for (size_t i = 0; i < n && e; i++) e[i] = nh_simplify_short(model->dag, nh_fixed_values(model, fixed, e[i]), 0);
}

/* Does a parameter stand in e that is fixed? */
static bool has_fixed(const nh_model *model, const nh_ex *fixed, nh_ex e)
{
    bool found = false;
    for (size_t i = 0; i < model->system->parameters && !found; i++)
        found = nh_fixed_has(model, fixed, i) && nh_depends(model->dag, e, model->parameter[i]);
    return found;
}

static void normalise(nh_model *model, nh_current *f)
{
    nh_dag *d = model->dag;
    if (nh_complexity(d, model->E) > NH_SYMMETRY_LENGTHY && nh_symmetry_is_energy(model, f->phi)) {
        f->phi = nh_neg(d, model->E);
        return;
    }
    nh_ex *zeta = nh_alloc_array(model->n + 1, sizeof *zeta);
    /* e or -e: where the symmetry does not tell which */
    if (nh_is_short(d, f->phi) && nh_complexity(d, f->phi) <= longest)
        f->phi = shortest(d, nh_canonical_sign(d, f->phi) < 0 ? nh_neg(d, f->phi) : f->phi);
    nh_ex Z0 = nh_symmetry_components(model, f->phi, zeta);
    /* where the current is shown with such a symbol its unit is */
    bool valued = f->proof.fixed && !has_fixed(model, f->proof.fixed, f->phi);
    put_values(model, f->proof.fixed, valued ? model->n : 0, zeta);
    nh_ex unit = unit_of(model, Z0, zeta);
    nh_free(zeta);
    f->phi = shortest(d, nh_div(d, f->phi, unit));
}

/* ---- what it is ---- */

/* Does the current change when an angle makes one turn?  Then it is defined only locally; not where turns count,
 * because the system is at another place after each.  A series in the angle is compared half a turn before and after
 * the middle of its interval: on a shorter interval it does not tell. */
static bool is_local(const nh_model *model, const nh_points *points, nh_ex phi, const nh_series *series)
{
    nh_dag *d = model->dag;
    nh_ex turn = nh_mul(d, nh_int(d, 2), nh_pi(d));
    for (size_t s = 0; s < model->m; s++) {
        const nh_coordinate *c = &model->system->coordinate[s];
        if (c->type != NH_ANGLE || c->counted || !nh_depends(d, phi, c->q)) continue;
        nh_ex here = c->q;
        if (series && series->variable == c->q) here = nh_real(d, (series->low + series->high) / 2 - M_PI);
        nh_ex around = nh_add(d, here, turn);
        nh_ex pair[2] = {nh_substitute(d, phi, 1, &c->q, &here), nh_substitute(d, phi, 1, &c->q, &around)};
        double *value = nh_alloc_array(2 * points->count, sizeof *value), worst = 0, size = 0;
        nh_points_evaluate(points, model, 2, pair, value);
        for (size_t p = 0; p < points->count; p++) {
            double change = fabs(value[p] - value[points->count + p]);
            if (isfinite(change)) worst = fmax(worst, change);
            if (isfinite(value[p])) size = fmax(size, fabs(value[p]));
        }
        nh_free(value);
        if (worst > 1e-9 * size) return true;
    }
    return false;
}

/* phi in terms of e: "" itself, "minus the ", "a multiple of the "; NULL where phi/e is not constant for all
 * parameters. */
static const char *part_of(nh_model *model, nh_ex phi, nh_ex e)
{
    nh_ex ratio = nh_simplify_short(model->dag, nh_div(model->dag, phi, e), 0);
    if (!nh_model_is_constant(model, ratio)) return NULL;
    return nh_is_number(model->dag, ratio, 1)    ? ""
           : nh_is_number(model->dag, ratio, -1) ? "minus the "
                                                 : "a multiple of the ";
}

/* Is phi/e the same at all points?  Simplifying the quotient costs a hundred times as much. */
static bool looks_proportional(size_t points, const double *phi, const double *e)
{
    static const double same = 1e-6;
    double low = INFINITY, high = -INFINITY;
    for (size_t p = 0; p < points; p++) {
        double ratio = phi[p] / e[p];
        if (!isfinite(ratio)) continue;
        low = fmin(low, ratio);
        high = fmax(high, ratio);
    }
    return high - low <= same * fmax(fabs(low), fabs(high));
}

/* Energy, or the momentum of a coordinate: where the current is proportional to E or to a p_s at the points. */
static void find_meaning(nh_analysis *result, const nh_points *points, nh_current *f)
{
    nh_model *model = result->question->model;
    size_t n = 2 + model->m, count = points->count, found = 0;
    nh_ex *e = nh_alloc_array(n, sizeof *e);
    double *value = nh_alloc_array(n * count, sizeof *value);
    const char *part = NULL;
    e[0] = f->phi;
    e[1] = model->E;
    memcpy(e + 2, model->p, model->m * sizeof *e);
    nh_points_evaluate(points, model, n, e, value);
    for (size_t j = 1; j < n && !part; found = j++)
        if (!nh_is_zero(model->dag, e[j]) && looks_proportional(count, value, value + j * count))
            part = part_of(model, f->phi, e[j]);
    nh_free(value);
    nh_free(e);
    f->energy = part && found == 1;
    if (!part) f->meaning = "";
    else if (f->energy) f->meaning = nh_arena_printf(result->arena, "%senergy", part);
    else
        f->meaning =
            nh_arena_printf(result->arena, "%smomentum of %s", part, model->system->coordinate[found - 2].name);
}

void nh_current_in_velocities(const nh_current_checker *checker, nh_current *f)
{
    nh_model *model = checker->result->question->model;
    bool invertible = checker->invertible && !model->framed; /* angular velocities are what one reads */
    nh_ex *v = nh_alloc_array(model->chart->implicit + 1, sizeof *v);
    for (size_t a = 0; a < model->chart->implicit; a++) v[a] = model->system->coordinate[model->chart->dependent[a]].v;
    f->has_in_velocities = invertible;
    f->in_velocities = nh_substitute(model->dag, f->phi, model->chart->implicit, model->chart->u, v);
    if (invertible && model->chart->quasi)
        f->in_velocities = shortest(
            model->dag, nh_substitute(model->dag, f->in_velocities, model->n, model->chart->w, checker->inverse));
    f->in_velocities = nh_chart_in_velocities(model->chart, nh_chart_shown(model->chart, f->in_velocities));
    nh_free(v);
}

void nh_described_fill(nh_current_checker *checker, nh_current *f)
{
    nh_analysis *result = checker->result;
    if (!f->series) normalise(result->question->model, f);
    f->local = is_local(result->question->model, checker->generic, f->phi, f->series);
    find_meaning(result, checker->generic, f);
    nh_current_in_velocities(checker, f);
}

/* phi = c e with c a function of the parameters, exactly? */
static bool is_multiple(const nh_analysis *result, nh_ex phi, nh_ex e)
{
    const nh_model *model = result->question->model;
    nh_ex c, pair[2] = {e, phi};
    return nh_relation_express(model->dag, 2, pair, model->system->parameters, model->parameter,
                               (size_t)result->question->options.proof_terms, &c);
}

void nh_described_by_source(nh_current_checker *checker)
{
    nh_analysis *result = checker->result;
    const nh_current_list *list = result->list;
    nh_model *model = result->question->model;
    size_t place = 0;
    for (size_t k = 0; k < model->system->currents; k++) {
        const nh_named *known = &model->system->current[k];
        nh_ex own;
        nh_error ignored;
        nh_error_clear(&ignored);
        if (!known->symbol || !nh_analysis_file_to_chart(model, known->value, &own, &ignored)) continue;
        own = nh_simplify_short(model->dag, own, 0);
        for (size_t i = place; i < list->count; i++) {
            if (list->found[i].series || !list->found[i].proof.proved) continue;
            if (!is_multiple(result, list->found[i].phi, own)) continue;
            nh_current_list_move(result, i, place);
            nh_current *f = nh_current_list_describe(result, &list->found[place++]);
            f->phi = own;
            f->symbol = known->symbol;
            find_meaning(result, checker->generic, f);
            nh_current_in_velocities(checker, f);
            break;
        }
    }
}
