/* Coefficients of a linear family as series at a point, at values of the parameter. */
#include <string.h>

#include "exact/normal.h"
#include "classify/parametric_internal.h"

enum { largest_form = 2000 };

static size_t equations(const nh_parametric *f)
{
    const nh_linear_family *l = f->linear;
    return l->equations[l->levels - 1];
}

static size_t entries(const nh_parametric *f)
{
    return equations(f) * f->linear->unknowns * (nh_parametric_kept(f) + 1);
}

size_t nh_parametric_linear_length(const nh_parametric *f, const nh_jet_ring *r) { return (1 + entries(f)) * r->size; }

/* ---- expressions ---- */

static bool any_depends(const nh_parametric *f, size_t n, const nh_ex *e)
{
    const nh_model *o = f->counter.equations->model;
    bool any = false;
    for (size_t i = 0; i < n; i++) any |= nh_depends(o->dag, e[i], o->parameter[f->parameter[0]]);
    return any;
}

/* The family's equations take the place of the equations of motion, which are open already. */
void nh_parametric_linear_open(nh_parametric *f)
{
    nh_jet_equations *x = f->counter.equations;
    const nh_linear_family *l = f->linear;
    f->kept = l->variables;
    size_t count = entries(f);
    f->entry = nh_alloc_array(count + l->n * l->n + 1, sizeof *f->entry);
    bool good = true;
    for (size_t i = 0; i < count + l->n * l->n && good; i++) {
        f->entry[i] = nh_canonical(x->dag, i < count ? l->coefficient[i] : l->mass[i - count], largest_form);
        good = nh_jet_point_register(x->point, 1, &f->entry[i]);
    }
    if (!good) f->obstacle = x->point->obstacle;
    else if (!any_depends(f, count, f->entry))
        f->obstacle = "the equations of this question do not depend on the parameter";
    for (size_t i = 0; i < x->point->kernels && !f->obstacle; i++)
        if (any_depends(f, 1, &x->point->kernel[i].key))
            f->obstacle = "the parameter occurs inside of a function or a root";
    if (f->obstacle) return;
    nh_parametric_denominators(f, count, f->entry, f->of_rest);
    nh_parametric_denominators(f, l->n * l->n, f->entry + count, f->of_mass);
}

/* The variables at their point, everything else at residues. */
static nh_jet_eval *evaluator(nh_parametric *f, const nh_jet_ring *r)
{
    nh_jet_equations *x = f->counter.equations;
    const nh_linear_family *l = f->linear;
    nh_residue *q = nh_alloc_array(x->coordinates * r->size + 1, sizeof *q);
    for (size_t k = 0; k < x->coordinates; k++) q[k * r->size] = x->at[k];
    nh_jet_eval *v = nh_jet_equations_eval(x, r, q);
    uint64_t random = x->point->random + 4321;
    for (size_t k = 0; k < l->variables; k++) {
        memset(q, 0, r->size * sizeof *q);
        q[0] = nh_residue_random(r->field, &random);
        q[r->up[k * r->size]] = 1;
        nh_jet_eval_set(v, l->variable[k], q, false);
    }
    nh_free(q);
    return v;
}

static void times(const nh_jet_ring *r, nh_residue *a, const nh_residue *b, nh_residue *work)
{
    nh_jet_mul(r, a, b, work);
    memcpy(a, work, r->size * sizeof *a);
}

/* The common denominator of the coefficients goes to `clear`; its product with det M, without denominators, to Q. */
static bool multipliers(nh_parametric *f, nh_jet_eval *v, const nh_jet_ring *r, nh_residue *clear, nh_residue *Q)
{
    size_t n = f->linear->n, e = r->size;
    nh_residue *M = nh_alloc_array((n * n + 2) * e, sizeof *M), *value = M + n * n * e, *work = value + e;
    bool good = nh_jet_eval_all(v, n * n, f->entry + entries(f), M);
    nh_jet_constant(r, 1, clear);
    if (good) nh_parametric_determinant(r, n, M, Q);
    for (size_t i = 0; i < f->factors && good; i++) {
        good = nh_jet_eval_all(v, 1, &f->factor[i], value);
        for (size_t k = 0; k < f->of_rest[i] && good; k++) times(r, clear, value, work);
        for (size_t k = 0; k < f->of_mass[i] * n + f->of_rest[i] && good; k++) times(r, Q, value, work);
    }
    nh_free(M);
    return good;
}

bool nh_parametric_linear_multiplier(nh_parametric *f, const nh_jet_ring *r, nh_residue *out)
{
    nh_residue *clear = nh_alloc_array(r->size, sizeof *clear);
    nh_jet_eval *v = evaluator(f, r);
    bool good = multipliers(f, v, r, clear, out);
    nh_jet_eval_free(v);
    nh_free(clear);
    return good;
}

static bool expressions(nh_parametric *f, const nh_jet_ring *r, nh_residue *out)
{
    size_t count = entries(f), e = r->size;
    nh_residue *clear = nh_alloc_array(2 * e, sizeof *clear);
    nh_jet_eval *v = evaluator(f, r);
    bool good = multipliers(f, v, r, clear, out) && out[0] && nh_jet_eval_all(v, count, f->entry, out + e);
    for (size_t i = 1; i <= count && good; i++)
        if (!nh_jet_is_zero(r, out + i * e)) times(r, out + i * e, clear, clear + e);
    nh_jet_eval_free(v);
    nh_free(clear);
    return good;
}

/* ---- the density of a measure ---- */

/* d (c w^a w^b)/d w^l summed over l: what the quadratic monomials of the rate of w^l give to the row of w^i. */
static void add_quadratic(const nh_jet_ring *r, size_t n, size_t l, const nh_residue *monomial, nh_residue *divergence)
{
    for (size_t a = 0; a < n; a++)
        for (size_t b = a; b < n; b++, monomial += r->size) {
            if (a == l) nh_jet_add_multiple(r, divergence + b * r->size, 1, monomial);
            if (b == l) nh_jet_add_multiple(r, divergence + a * r->size, 1, monomial);
        }
}

static bool density(nh_parametric *f, nh_parametric_series *s, nh_residue *out)
{
    const nh_jet_equations *x = f->counter.equations;
    const nh_jet_ring *r = s->ring;
    size_t n = x->n, kept = nh_parametric_kept(f), e = r->size, count = nh_jet_equations_monomials(n);
    size_t motion = (1 + x->fields * kept + n * count) * e;
    nh_residue *G = nh_alloc_array(motion + (n + 2) * e, sizeof *G), *rate = G + (1 + x->fields * kept) * e;
    nh_residue *divergence = G + motion, *work = divergence + (n + 1) * e;
    bool good = nh_parametric_motion(f, r, s->coordinate, G);
    memset(out, 0, s->length * sizeof *out);
    memcpy(out, G, e * sizeof *out);
    for (size_t l = 0; l < n && good; l++) {
        add_quadratic(r, n, l, rate + (l * count + 1 + n) * e, divergence);
        nh_jet_add_multiple(r, divergence + n * e, 1, rate + (l * count + 1 + l) * e);
    }
    for (size_t i = 0; i <= n && good; i++) {
        nh_residue *row = out + e + i * (kept + 1) * e;
        memcpy(row + kept * e, divergence + i * e, e * sizeof *row);
        for (size_t k = 0; k < kept && i < x->fields; k++) {
            memcpy(row + k * e, G + (1 + i * kept + k) * e, e * sizeof *row);
            nh_jet_derivative(r, row + k * e, k, work);
            nh_jet_add_multiple(r, row + kept * e, 1, work);
        }
    }
    nh_free(G);
    return good;
}

bool nh_parametric_linear_value(nh_parametric *f, nh_parametric_series *s, nh_residue *out)
{
    if (!f->linear->coefficient) return density(f, s, out);
    nh_parametric_set(f);
    f->counter.work += (double)s->ring->pairs[s->ring->size] * (double)entries(f);
    return expressions(f, s->ring, out);
}
