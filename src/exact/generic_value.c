#include "exact/generic_value.h"

#include <string.h>

#include "base/memory.h"
#include "exact/form.h"
#include "exact/jet_eval.h"
#include "exact/jet_independent.h"
#include "exact/residue_matrix.h"
#include "graph/dag.h"
#include "graph/node.h"

enum { canonical_length = 2000, order = 2, most_points = 400, most_symbols = 64 };

typedef struct {
    nh_jet_point *point;
    const nh_jet_ring *ring;
    size_t n, constants, variables;
    const nh_ex *e, *variable;
    nh_ex constant[most_symbols];
    size_t signs, asked; /* the roots that are functions of others may have either sign: one bit each; their number */
} problem;

enum { most_signs = 6 };

static int sign_of(void *context, nh_ex e)
{
    problem *x = context;
    (void)e;
    return x->asked == most_signs ? 0 : x->signs >> x->asked++ & 1 ? -1 : 1;
}

/* The next choice of signs, or the first one; false: all were taken.  *known: functions have no other relations. */
static bool next_signs(problem *x, bool first, bool *known)
{
    if (first) x->signs = 0;
    else if (++x->signs >> x->asked) return false;
    x->asked = 0;
    x->point->sign = sign_of;
    x->point->context = x;
    *known = !nh_jet_point_related(x->point);
    return true;
}

/* The symbols that are no variables; false: there are too many. */
static bool list_constants(problem *x, nh_dag *dag)
{
    NH_LIST(symbol);
    for (size_t i = 0; i < x->n; i++) {
        size_t count = nh_symbols_in(dag, x->e[i], &symbol);
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

/* All symbols at random residues; the variables as series with slope 1 in their own direction. */
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

static bool solve(problem *x)
{
    nh_residue *value = nh_alloc_array(x->n * x->ring->size + 1, sizeof *value);
    bool found = false, done = false;
    for (uint64_t seed = 1; seed <= most_points && !done; seed++) {
        nh_jet_eval *v = at_point(x, seed);
        done = nh_jet_eval_all(v, x->n, x->e, value);
        for (size_t i = 0; i < x->n * x->ring->size && done && !found; i++) found = value[i] != 0;
        nh_jet_eval_free(v);
    }
    nh_free(value);
    return found;
}

/* Prepares expressions; false: they have no residues. */
static bool prepare(problem *x, nh_dag *dag, size_t n, const nh_ex *e, nh_ex *own)
{
    nh_forms forms;
    *x = (problem){.point = nh_jet_point_create(dag), .n = n, .e = own};
    nh_forms_init(&forms, dag, false, canonical_length);
    for (size_t i = 0; i < n; i++) own[i] = nh_form_rewrite(&forms, e[i]);
    nh_forms_clear(&forms);
    return nh_jet_point_register(x->point, n, own);
}

/* The ring of series at the index-th prime modulo which the numbers have their roots. */
static nh_jet_ring *ring_at(const problem *x, size_t index)
{
    size_t *one = nh_alloc_array(x->variables + 1, sizeof *one);
    for (size_t k = 0; k < x->variables; k++) one[k] = 1;
    nh_jet_ring *ring = nh_jet_ring_create(nh_jet_point_prime(x->point, index), x->variables, one, order);
    nh_free(one);
    return ring;
}

bool nh_generic_nonzero(nh_dag *dag, size_t n, const nh_ex *e, size_t variables, const nh_ex *variable)
{
    problem x;
    nh_ex *own = nh_alloc_array(n + 1, sizeof *own);
    bool found = prepare(&x, dag, n, e, own) && variables;
    x.variables = variables;
    x.variable = variable;
    if (found && list_constants(&x, dag)) {
        nh_jet_ring *ring = ring_at(&x, 0);
        x.ring = ring;
        for (bool first = true, known; found && next_signs(&x, first, &known); first = false)
            found = known && solve(&x);
        nh_jet_ring_free(ring);
    } else {
        found = false;
    }
    nh_jet_point_free(x.point);
    nh_free(own);
    return found;
}

/* ---- at regular points ---- */

/* At one regular point; false: there is none. */
static bool read_at(problem *x, nh_generic_read *read, void *context)
{
    nh_residue *value = nh_alloc_array(x->n * x->ring->size + 1, sizeof *value);
    bool done = false;
    for (uint64_t seed = 1; seed <= most_points && !done; seed++) {
        nh_jet_eval *v = at_point(x, seed);
        done = nh_jet_eval_all(v, x->n, x->e, value) && read(x->ring, value, context);
        nh_jet_eval_free(v);
    }
    nh_free(value);
    return done;
}

/* With the variables set; the other symbols are constants. */
static bool read_all(problem *x, nh_generic_read *read, void *context)
{
    enum { primes = 2 };
    bool good = true;
    for (size_t index = 0; index < primes && good; index++) {
        nh_jet_ring *ring = ring_at(x, index);
        x->ring = ring;
        good = read_at(x, read, context);
        nh_jet_ring_free(ring);
    }
    return good;
}

bool nh_generic_series(nh_dag *dag, size_t n, const nh_ex *e, size_t variables, const nh_ex *variable,
                       nh_generic_read *read, void *context)
{
    problem x;
    nh_ex *own = nh_alloc_array(n + 1, sizeof *own);
    bool good = prepare(&x, dag, n, e, own) && variables && !nh_jet_point_related(x.point);
    x.variables = variables;
    x.variable = variable;
    good = good && list_constants(&x, dag) && read_all(&x, read, context);
    nh_jet_point_free(x.point);
    nh_free(own);
    return good;
}

/* ---- ranks ---- */

typedef struct {
    size_t rows, columns, rank;
} matrix;

static bool read_rank(const nh_jet_ring *ring, nh_residue *series, void *context)
{
    matrix *m = context;
    nh_residue *a = nh_alloc_array(m->rows * m->columns + 1, sizeof *a);
    for (size_t i = 0; i < m->rows * m->columns; i++) a[i] = series[i * ring->size];
    size_t here = nh_residue_matrix_rank(ring->field, m->rows, m->columns, a);
    m->rank = here > m->rank ? here : m->rank;
    nh_free(a);
    return true;
}

bool nh_generic_rank(nh_dag *dag, size_t rows, size_t columns, const nh_ex *e, size_t *rank)
{
    problem x;
    matrix m = {rows, columns, 0};
    nh_ex *own = nh_alloc_array(rows * columns + 1, sizeof *own), variable[most_symbols];
    bool good = prepare(&x, dag, rows * columns, e, own) && list_constants(&x, dag);
    x.variables = x.constants ? x.constants : 1;
    if (x.constants) memcpy(variable, x.constant, sizeof variable);
    else variable[0] = nh_symbol_fresh(dag, "x");
    x.variable = variable;
    x.constants = 0;
    *rank = SIZE_MAX;
    for (bool first = true, known; good && next_signs(&x, first, &known); first = false) {
        m.rank = 0;
        good = known && read_all(&x, read_rank, &m);
        *rank = m.rank < *rank ? m.rank : *rank;
    }
    nh_jet_point_free(x.point);
    nh_free(own);
    return good;
}
