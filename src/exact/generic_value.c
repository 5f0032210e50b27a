#include "exact/generic_value.h"

#include "base/memory.h"
#include "exact/form.h"
#include "exact/jet_eval.h"
#include "exact/residue_matrix.h"

enum { canonical_length = 2000, order = 2, most_points = 100, most_symbols = 64 };

typedef struct {
    nh_jet_point *point;
    const nh_jet_ring *ring;
    size_t n, constants, variables;
    const nh_ex *e, *variable;
    nh_ex constant[most_symbols];
} problem;

/* The symbols that are no variables; false: there are too many. */
static bool list_constants(problem *x, nh_dag *dag)
{
    nh_ex symbol[most_symbols];
    for (size_t i = 0; i < x->n; i++) {
        size_t count = nh_symbols_in(dag, x->e[i], symbol, most_symbols);
        if (count > most_symbols) return false;
        for (size_t k = 0; k < count; k++) {
            bool known = false;
            for (size_t j = 0; j < x->variables && !known; j++) known = x->variable[j] == symbol[k];
            for (size_t j = 0; j < x->constants && !known; j++) known = x->constant[j] == symbol[k];
            if (known) continue;
            if (x->constants == most_symbols) return false;
            x->constant[x->constants++] = symbol[k];
        }
    }
    return true;
}

static nh_jet_eval *at_point(problem *x, uint64_t seed)
{
    const nh_jet_ring *ring = x->ring;
    uint64_t random = seed + 2718;
    nh_residue *series = nh_alloc_array(ring->size, sizeof *series);
    nh_jet_point_choose(x->point, ring->field, seed);
    nh_jet_eval *v = nh_jet_eval_create(x->point, ring);
    for (size_t k = 0; k < x->constants; k++) {
        nh_jet_constant(ring, nh_residue_random(ring->field, &random), series);
        nh_jet_eval_set(v, x->constant[k], series, false);
    }
    for (size_t k = 0; k < x->variables; k++) {
        nh_jet_constant(ring, nh_residue_random(ring->field, &random), series);
        series[ring->up[k * ring->size]] = 1;
        nh_jet_eval_set(v, x->variable[k], series, false);
    }
    nh_free(series);
    return v;
}

/* Are the atoms linearly independent?  Then the kernels satisfy no other relations [jet_point.h]. */
static bool unrelated(const problem *x, nh_jet_eval *v)
{
    bool good = true;
    for (int real = 0; real < 2 && good; real++) {
        size_t count;
        nh_jet_eval_atoms(v, real, &count, NULL);
        nh_residue *rows = nh_alloc_array(count * x->ring->size + 1, sizeof *rows);
        good = nh_jet_eval_atoms(v, real, &count, rows) &&
               nh_residue_matrix_rank(x->ring->field, count, x->ring->size, rows) == count;
        nh_free(rows);
    }
    return good;
}

static bool solve(problem *x)
{
    nh_residue *value = nh_alloc_array(x->n * x->ring->size + 1, sizeof *value);
    bool found = false, done = false;
    for (uint64_t seed = 1; seed <= most_points && !done; seed++) {
        nh_jet_eval *v = at_point(x, seed);
        done = nh_jet_eval_all(v, x->n, x->e, value);
        for (size_t i = 0; i < x->n * x->ring->size && done && !found; i++) found = value[i] != 0;
        found = found && unrelated(x, v);
        nh_jet_eval_free(v);
    }
    nh_free(value);
    return found;
}

bool nh_generic_nonzero(nh_dag *dag, size_t n, const nh_ex *e, size_t variables, const nh_ex *variable)
{
    nh_ex *own = nh_alloc_array(n + 1, sizeof *own);
    size_t *one = nh_alloc_array(variables + 1, sizeof *one);
    problem x = {.point = nh_jet_point_create(dag), .n = n, .e = own, .variables = variables, .variable = variable};
    nh_forms forms;
    for (size_t k = 0; k < variables; k++) one[k] = 1;
    nh_forms_init(&forms, dag, false, canonical_length);
    for (size_t i = 0; i < n; i++) own[i] = nh_form_rewrite(&forms, e[i]);
    nh_forms_clear(&forms);
    bool found = variables && list_constants(&x, dag) && nh_jet_point_register(x.point, n, own);
    /* a prime modulo which the numbers have their roots */
    nh_jet_ring *ring = nh_jet_ring_create(nh_jet_point_prime(x.point, 0), variables, one, order);
    x.ring = ring;
    found = found && solve(&x);
    nh_jet_ring_free(ring);
    nh_jet_point_free(x.point);
    nh_free(one);
    nh_free(own);
    return found;
}
