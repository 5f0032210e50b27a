#include "study/defaults.h"

#include <string.h>


static nh_ex *copy(nh_result *r, size_t n, const nh_ex *e)
{
    nh_ex *to = nh_arena_alloc(r->arena, (n + 1) * sizeof *to);
    memcpy(to, e, n * sizeof *to);
    return to;
}

static nh_family polynomial(nh_result *r, size_t n, const nh_ex *in, size_t degree)
{
    return (nh_family){.kind = NH_POLYNOMIAL, .in = copy(r, n, in), .in_count = n, .degree = degree};
}

static nh_family product(nh_result *r, nh_family a, nh_family b)
{
    nh_family *part = nh_arena_alloc(r->arena, 2 * sizeof *part);
    part[0] = a;
    part[1] = b;
    return (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = 2, .part = part};
}

/* Velocities to degree 2 with every shape function to first order; the energy as one column, whatever it looks like. */
void nh_defaults_ansatz(nh_result *r, size_t *families, nh_family **family)
{
    const nh_model *o = r->model;
    nh_dag *d = o->dag;
    nh_family *list = nh_arena_alloc(r->arena, (4 + 2 * o->m) * sizeof *list);
    nh_ex *lengths = nh_arena_alloc(r->arena, (o->m + 2) * sizeof *lengths);
    nh_ex *terms = nh_arena_alloc(r->arena, (o->m + 2) * sizeof *terms);
    size_t n = 0, count = 0, term_count = 0;
    lengths[count++] = o->system->t;
    for (size_t s = 0; s < o->m; s++) lengths[count++] = o->system->coordinate[s].q;
    terms[term_count++] = o->E;
    for (size_t s = 0; s < o->m; s++)
        if (!nh_is_zero(d, o->p[s])) terms[term_count++] = o->p[s];
    list[n++] = (nh_family){.kind = NH_TERMS, .terms = term_count, .term = copy(r, term_count, terms)};
    list[n++] = polynomial(r, o->n, o->chart->w, 2);
    list[n++] = product(r, polynomial(r, o->n, o->chart->w, 1), polynomial(r, count, lengths, 1));
    for (size_t s = 0; s < o->m; s++) {
        const nh_coordinate *c = &o->system->coordinate[s];
        if (c->type != NH_ANGLE) continue;
        nh_family wave = {.kind = NH_FOURIER, .in = copy(r, 1, &c->q), .in_count = 1, .degree = 1, .frequency = nh_int(d, 1), .constant = true};
        list[n++] = product(r, polynomial(r, o->n, o->chart->w, 1), wave);
    }
    *families = n;
    *family = list;
    r->ansatz_note = "chosen: energy, momenta, degree 2 in the velocities, velocities times t, coordinates and first harmonics of angles";
}

bool nh_defaults_initial(nh_result *r, nh_state *state, nh_error *error)
{
    const nh_model *o = r->model;
    nh_points *p = nh_points_create(o, 1, 0.7, (uint64_t)r->options.seed + 909, error);
    if (!p) return false;
    double *v = nh_alloc_array(o->m + 1, sizeof *v);
    nh_points_evaluate(p, o, o->m, o->rho, v);
    *state = (nh_state){0, nh_arena_alloc(r->arena, (o->m + 1) * sizeof(double)), nh_arena_alloc(r->arena, (o->m + 1) * sizeof(double))};
    state->t = p->column[0][0];
    for (size_t s = 0; s < o->m; s++) {
        state->q[s] = p->column[1 + s][0];
        state->v[s] = v[s];
    }
    nh_free(v);
    nh_points_free(p);
    return true;
}
