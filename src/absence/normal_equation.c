/* normal_equation: in this order
 *
 *     normal_equation_curve      w^2 = 2 (h - V)/m from an integral m w^2/2 + V on the plane; the field K = Q(x)[w]
 *     normal_equation_reduced    d xi/dt = B xi for normal directions, less those that integrals hold
 *     normal_equation_rational   xi = w^s eta, with coefficients in Q(x), or twice as many unknowns; blocks */
#include "absence/normal_equation.h"

#include "absence/normal_equation_internal.h"
#include "graph/dag.h"

bool nh_normal_equation_refuse(nh_normal_work *work, const char *why)
{
    if (!work->out->obstacle) work->out->obstacle = why;
    return false;
}

static void begin(nh_normal_work *work)
{
    const nh_closed_shape *shape = work->shape;
    const nh_known_integrals *known = work->known;
    work->integral = nh_alloc_array(known->count + 1, sizeof *work->integral);
    for (size_t k = 0; k < known->count; k++) {
        nh_ex e = nh_substitute(work->dag, known->integral[k], shape->count, shape->letter, work->plane->letter);
        work->integral[k] = nh_model_values(shape->model, e);
    }
    nh_curve_field_init(&work->field);
    nh_curve_field_element_init(&work->rate);
    work->normals = shape->count - 2;
    work->place = (nh_curve_place){.dag = work->dag,
                                   .field = &work->field,
                                   .coordinate = work->plane->y[0],
                                   .velocity = work->plane->y[1],
                                   .angle = work->plane->angle,
                                   .side = work->plane->side,
                                   .zeros = work->normals,
                                   .zero = work->plane->y + 2};
    work->block = nh_curve_field_elements(work->normals * work->normals);
    work->held_by = nh_curve_field_elements(known->count * work->normals);
    work->pivot = nh_alloc_array(known->count + 1, sizeof *work->pivot);
    work->kept = nh_alloc_array(work->normals + 1, sizeof *work->kept);
}

static void end(nh_normal_work *work)
{
    nh_curve_field_elements_free(work->held_by, work->known->count * work->normals);
    nh_curve_field_elements_free(work->block, work->normals * work->normals);
    nh_curve_field_element_clear(&work->rate);
    nh_curve_field_clear(&work->field);
    nh_free(work->integral);
    nh_free(work->pivot);
    nh_free(work->kept);
}

nh_normal_equation *nh_normal_equation_of(nh_arena *arena, const nh_closed_shape *shape, const nh_plane *plane,
                                          const nh_known_integrals *known, size_t n)
{
    nh_normal_equation *out = nh_arena_alloc(arena, sizeof *out);
    nh_normal_work work = {
        .arena = arena, .dag = shape->model->dag, .shape = shape, .plane = plane, .known = known, .out = out};
    out->plane = plane;
    out->generic = plane->generic;
    out->single_valued = out->all_single_valued = out->all_algebraic = true;
    out->periodic = plane->angle;
    out->used = nh_arena_alloc(arena, (known->count + 1) * sizeof *out->used);
    begin(&work);
    if (nh_normal_equation_curve(&work, n) && nh_normal_equation_reduced(&work)) nh_normal_equation_rational(&work);
    end(&work);
    return out;
}

/* An orbit of the doubled equation lies in the product of an orbit of the equation and one of its conjugate, which are
 * of the same dimension: continuation along the curve from (x, w) to (x, -w) exchanges the two. */
size_t nh_normal_equation_orbit(const nh_normal_equation *equation, size_t orbit)
{
    return equation->doubled ? (orbit + 1) / 2 : orbit;
}

void nh_normal_equation_clear(nh_normal_equation *equation)
{
    for (size_t b = 0; equation->block && b < equation->blocks; b++) nh_linear_equation_clear(&equation->block[b]);
    equation->block = NULL;
}

bool nh_normal_equation_equal(const nh_normal_equation *a, const nh_normal_equation *b)
{
    if (a->obstacle || b->obstacle || a->known != b->known || a->blocks != b->blocks) return false;
    if (a->triangular != b->triangular || a->doubled != b->doubled || a->periodic != b->periodic ||
        a->generic != b->generic)
        return false;
    for (size_t k = 0; k < a->blocks; k++) {
        const nh_linear_equation *p = &a->block[k], *q = &b->block[k];
        if (p->size != q->size || !fmpz_poly_equal(p->den, q->den)) return false;
        for (size_t i = 0; i < p->size * p->size; i++)
            if (!fmpz_poly_equal(p->num + i, q->num + i)) return false;
    }
    return true;
}
