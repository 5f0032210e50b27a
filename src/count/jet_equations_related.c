/* Relations between the kernels of the equations of motion: exponentials, sines and roots that occur in them. */
#include <flint/nmod_mat.h>

#include "count/jet_equations.h"
#include "exact/jet_point.h"
#include "exact/kernel.h"

/* Series of low order in time and the coordinates, at one point, of all atoms of a kind, into columns from `first` on.
 * False: another point is needed. */
static bool atoms_at(nh_jet_equations *x, const nh_jet_ring *ring, bool real, nmod_mat_t rows, size_t first)
{
    nh_residue *q = nh_alloc_array(ring->variables * ring->size + 1, sizeof *q);
    for (size_t k = 0; k < ring->variables; k++) {
        q[k * ring->size + ring->up[k * ring->size]] = 1;
        q[k * ring->size] = x->at[k < x->coordinates ? k : x->coordinates + x->model->system->parameters];
    }
    nh_jet_eval *v = nh_jet_equations_eval(x, ring, q);
    if (!x->time) nh_jet_eval_set(v, x->model->system->t, q + x->coordinates * ring->size, false);
    size_t count;
    nh_jet_eval_atoms(v, real, &count, NULL);
    nh_residue *series = nh_alloc_array(count * ring->size + 1, sizeof *series);
    bool good = nh_jet_eval_atoms(v, real, &count, series);
    for (size_t i = 0; i < count && good; i++)
        for (size_t e = 0; e < ring->size; e++) nmod_mat_entry(rows, i, first + e) = series[i * ring->size + e];
    nh_free(series);
    nh_jet_eval_free(v);
    nh_free(q);
    return good;
}

/* Is it a root of an expression that has roots itself? */
static bool is_nested(nh_dag *d, const nh_jet_kernel *k)
{
    NH_LIST(product);
    if (k->kind != NH_JET_ROOT) return false;
    size_t n = nh_products_in(d, k->key, &product);
    bool nested = false;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < nh_arity(d, product[i]); j++)
            nested |= nh_exponent_kind_of(d, nh_exponent_of(d, product[i], j)) == NH_EXPONENT_ROOT &&
                      nh_kind_of(d, nh_child(d, product[i], j)) != NH_NUMBER;
    return nested;
}

/* At a point where all roots of sums without roots have values: *square says whether the nested root number `at` exists
 * there.  False: this is no such point. */
static bool asks(nh_jet_equations *x, const nh_jet_ring *ring, size_t at, bool *square)
{
    nh_jet_point *p = x->point;
    nh_jet_eval *v = nh_jet_equations_eval(x, ring, x->at);
    nh_residue value, root;
    bool good = true;
    for (size_t i = 0; i < p->kernels && good; i++) {
        const nh_jet_kernel *k = &p->kernel[i];
        if (k->kind != NH_JET_ROOT || is_nested(x->dag, k)) continue;
        nh_num least = nh_num_ratio(1, (int64_t)k->order);
        good = nh_jet_eval_all(v, 1, &k->key, &value) && value && nh_jet_point_root(p, k->key, value, least, &root);
    }
    good = good && nh_jet_eval_all(v, 1, &p->kernel[at].key, &value) && value;
    if (good) *square = nh_residue_root(p->field, value, 2, &root);
    nh_jet_eval_free(v);
    return good;
}

/* sqrt(1 + x + sqrt(2 x + x^2)) = (sqrt(2 + x) + sqrt(x))/sqrt(2), where residues may have the other sign: a sum of
   roots that is a square at all points has its root among the other kernels. */
static bool has_root_of_square(nh_jet_equations *x, nh_prime field)
{
    enum { points = 24, most_tries = 4000 };
    size_t one[1] = {1};
    nh_jet_ring *ring = nh_jet_ring_create(field, 1, one, 0);
    bool related = false;
    for (size_t at = 0; at < x->point->kernels && !related; at++) {
        size_t asked = 0;
        bool square = true;
        const nh_jet_kernel *k = &x->point->kernel[at];
        if (k->order % 2 || nh_kind_of(x->dag, k->key) != NH_SUM || !is_nested(x->dag, k)) continue;
        for (uint64_t seed = 1; seed < most_tries && asked < points && square; seed++) {
            nh_jet_equations_choose(x, field, seed);
            asked += asks(x, ring, at, &square);
        }
        related = square;
    }
    nh_jet_ring_free(ring);
    return related;
}

bool nh_jet_equations_related(nh_jet_equations *x, nh_prime field)
{
    enum { order = 3, points = 6, most_tries = 200 };
    if (has_root_of_square(x, field)) return true;
    size_t *one = nh_alloc_array(x->coordinates + 2, sizeof *one), variables = x->coordinates + !x->time, count;
    for (size_t k = 0; k < variables; k++) one[k] = 1;
    nh_jet_ring *ring = nh_jet_ring_create(field, variables, one, order);
    bool independent = true;
    x->point->conjugates = true;
    for (int real = 0; real < 2 && independent; real++) {
        nmod_mat_t rows;
        nmod_mat_init(rows, (slong)x->point->kernels + 1, (slong)(points * ring->size), field.p);
        size_t found = 0;
        for (uint64_t seed = 1; seed < most_tries && found < points; seed++) {
            nh_jet_equations_choose(x, field, seed);
            found += atoms_at(x, ring, real, rows, found * ring->size);
        }
        nh_jet_eval *v = nh_jet_eval_create(x->point, ring);
        nh_jet_eval_atoms(v, real, &count, NULL);
        nh_jet_eval_free(v);
        independent = found == points && (size_t)nmod_mat_rank(rows) == count;
        nmod_mat_clear(rows);
    }
    x->point->conjugates = false;
    nh_jet_ring_free(ring);
    nh_free(one);
    return !independent;
}
