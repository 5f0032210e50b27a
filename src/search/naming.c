#include "search/naming.h"

#include "graph/index.h"
#include "graph/node.h"
#include "integrals/recognise.h"
#include "system/sample.h"

enum { extra_sets = 4 };
/* small, so that the nearest value belongs to the same number; large relative to rounding */
static const double spread = 0.04;

/* ---- parameters and sums of parameters (J + m a^2) that values may be monomials of ---- */

static bool parametric_sum(const nh_model *model, nh_ex e)
{
    return nh_kind_of(model->dag, e) == NH_SUM && nh_model_is_constant(model, e);
}

/* `seen`: a shared graph has exponentially many paths. */
static void harvest(const nh_model *model, nh_ex e, nh_ex *list, size_t *count, nh_index *seen)
{
    nh_dag *d = model->dag;
    uint32_t known;
    nh_kind kind = nh_kind_of(d, e);
    if (*count == NH_NAMING_ATOMS || kind == NH_SYMBOL || kind == NH_NUMBER || nh_index_get(seen, e, &known)) return;
    nh_index_put(seen, e, 0);
    if (parametric_sum(model, e)) {
        list[(*count)++] = e;
        return;
    }
    for (size_t i = 0; i < nh_arity(d, e); i++) harvest(model, nh_child(d, e, i), list, count, seen);
}

size_t nh_naming_atoms(const nh_model *model, nh_ex list[NH_NAMING_ATOMS])
{
    size_t count = 0;
    nh_index seen = {0};
    for (size_t i = 0; i < model->system->parameters && count < NH_NAMING_ATOMS; i++)
        if (model->parameter_value[i] > 0) list[count++] = model->parameter[i];
    for (size_t i = 0; i < model->n * model->n; i++) harvest(model, model->M[i], list, &count, &seen);
    for (size_t i = 0; i < model->n; i++) harvest(model, model->a[i], list, &count, &seen);
    nh_index_clear(&seen);
    return count;
}

/* ---- parameter sets: the given one, then others within ten percent ---- */

typedef struct {
    size_t count, atoms;
    double *parameter, *atom; /* count x parameters, count x atoms */
} sets;

static sets make_sets(const nh_model *model, size_t n, const nh_ex *atom, uint64_t seed)
{
    size_t p = model->system->parameters;
    sets s = {.count = n + 2 + extra_sets, .atoms = n};
    s.parameter = nh_alloc_array(s.count * p + 1, sizeof *s.parameter);
    s.atom = nh_alloc_array(s.count * n + 1, sizeof *s.atom);
    for (size_t k = 0; k < s.count; k++) {
        double *value = s.parameter + k * p;
        for (size_t i = 0; i < p; i++)
            value[i] = model->parameter_value[i] * (k ? 1 + spread * (nh_random(&seed) - 0.5) : 1);
        nh_tape_constants(model->dag, n, atom, p, model->parameter, value, s.atom + k * n);
    }
    return s;
}

/* Implicit velocities are solved by tapes that are bound already: they cannot be moved to other parameters. */
static bool follow_all(const nh_model *model, const sets *s, double value, nh_follow *follow, void *context,
                       double *values)
{
    values[0] = value;
    if (model->chart->implicit) return false;
    for (size_t k = 1; k < s->count; k++) {
        nh_model changed = *model;
        changed.parameter_value = s->parameter + k * model->system->parameters;
        if (!follow(&changed, value, &values[k], context)) return false;
    }
    return true;
}

nh_ex nh_name_value(const nh_model *model, double value, nh_follow *follow, void *context, double tolerance,
                    uint64_t seed)
{
    nh_ex atom[NH_NAMING_ATOMS], found = 0;
    size_t n = nh_naming_atoms(model, atom);
    sets s = make_sets(model, n, atom, seed + 5);
    double *values = nh_alloc_array(s.count, sizeof *values);
    bool named = follow_all(model, &s, value, follow, context, values) &&
                 nh_recognise_monomial(model->dag, s.count, n, atom, s.atom, values, 100 * tolerance, &found);
    if (!named && !nh_recognise_number(model->dag, value, tolerance, &found)) found = 0;
    nh_free(values);
    nh_free(s.parameter);
    nh_free(s.atom);
    return found;
}
