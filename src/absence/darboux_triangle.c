/* darboux_triangle: three bodies at the corners of an equilateral triangle (Lagrange). */
#include "absence/darboux_internal.h"
#include "absence/rational_value.h"
#include "graph/dag.h"

enum { bodies = 3, space = 3 };

/* The mass of a body whose coordinates stand together; false: they have different inertia, or are coupled. */
static bool mass_of(size_t n, const nh_ex *inertia, size_t body, nh_ex *mass)
{
    size_t width = n / bodies, first = body * width;
    *mass = inertia[first * n + first];
    for (size_t i = first; i < first + width; i++)
        for (size_t j = 0; j < n; j++)
            if (inertia[i * n + j] != (i == j ? *mass : 0)) return false;
    return true;
}

bool nh_darboux_triangle_place(nh_dag *dag, size_t n, const nh_ex *inertia, nh_ex *c)
{
    nh_ex mass[bodies], all = nh_int(dag, 0), half = nh_ratio(dag, 1, 2);
    if (n != 2 * bodies && n != space * bodies) return false;
    for (size_t i = 0; i < bodies; i++) {
        if (!mass_of(n, inertia, i, &mass[i])) return false;
        all = nh_add(dag, all, mass[i]);
    }
    nh_ex height = nh_mul(dag, half, nh_sqrt(dag, nh_int(dag, 3)));
    nh_ex corner[2][bodies] = {{nh_int(dag, 1), nh_neg(dag, half), nh_neg(dag, half)},
                               {nh_int(dag, 0), height, nh_neg(dag, height)}};
    for (size_t i = 0; i < n; i++) c[i] = nh_int(dag, 0);
    for (size_t axis = 0; axis < 2; axis++) {
        nh_ex sum = nh_int(dag, 0);
        for (size_t i = 0; i < bodies; i++) sum = nh_add(dag, sum, nh_mul(dag, mass[i], corner[axis][i]));
        nh_ex centre = nh_div(dag, sum, all);
        for (size_t i = 0; i < bodies; i++) c[i * (n / bodies) + axis] = nh_sub(dag, corner[axis][i], centre);
    }
    return true;
}

void nh_darboux_triangle(nh_darboux_work *w)
{
    nh_ex inertia[NH_DARBOUX_MOST * NH_DARBOUX_MOST], c[NH_DARBOUX_MOST];
    for (size_t i = 0; i < w->n * w->n; i++)
        inertia[i] = nh_rational_value_number(w->dag, fmpq_mat_entry(w->inertia, (slong)(i / w->n), (slong)(i % w->n)));
    if (nh_darboux_triangle_place(w->dag, w->n, inertia, c))
        nh_darboux_try(w, c, "c, an equilateral triangle about the centre of mass");
}
