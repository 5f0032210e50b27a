/* The names that forms give to quantities.
 *
 *     L = m v^2/2 - V,  x^s dV/dx^s = -V,  V central:   A_i = m (x_i v^2 - v_i (x v)) + x_i V    is conserved
 *     L = m v^2/2 - V,  x^s dV/dx^s = 2 V, V central:   T_ij = m v_i v_j + d2V/dx_i dx_j x_i x_j  likewise
 *
 * [Goldstein, Classical Mechanics, sec. 3.9; Fradkin, Am. J. Phys. 33 (1965) 207].  A quantity is a component of one of
 * them if it is one by an exact relation with coefficients that depend on parameters alone. */
#include <math.h>

#include "document/current_words.h"
#include "exact/normal.h"
#include "exact/relation_express.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "search/counted.h"

enum { most = 3, NOT_CENTRAL = 0, INVERSE = -1, ELASTIC = 2 };

static bool vanishes(nh_dag *d, nh_ex e) { return nh_is_zero(d, nh_simplify(d, e)); }

/* The mass of a point in two or three Cartesian coordinates, and V = m v^2/2 - L of (q); 0: it is no such point. */
static nh_ex point_mass(const nh_model *o, nh_ex *V)
{
    nh_dag *d = o->dag;
    const nh_system *s = o->system;
    nh_ex kinetic = nh_int(d, 0), m = 0;
    if (o->k || o->m < 2 || o->m > most || o->n != o->m || o->framed || o->chart->quasi || s->orientations) return 0;
    for (size_t i = 0; i < o->m; i++) {
        nh_ex v = s->coordinate[i].v;
        if (s->coordinate[i].type == NH_ANGLE) return 0;
        nh_ex own = nh_simplify(d, nh_diff(d, nh_diff(d, s->lagrangian, v), v));
        if (i && !vanishes(d, nh_sub(d, own, m))) return 0;
        m = own;
        kinetic = nh_add(d, kinetic, nh_mul(d, m, nh_mul(d, v, v)));
    }
    if (!nh_model_is_constant(o, m) || nh_is_zero(d, m)) return 0;
    *V = nh_simplify(d, nh_sub(d, nh_div(d, kinetic, nh_int(d, 2)), s->lagrangian));
    for (size_t i = 0; i < o->m; i++)
        if (nh_depends(d, *V, s->coordinate[i].v)) return 0;
    return nh_depends(d, *V, s->t) ? 0 : m;
}

/* The power of the distance that V is, INVERSE or ELASTIC; NOT_CENTRAL: another function. */
static int power_of(const nh_model *o, nh_ex V)
{
    nh_dag *d = o->dag;
    nh_ex radial = nh_int(d, 0), slope[most], *x = (nh_ex[most]){0};
    for (size_t i = 0; i < o->m; i++) {
        x[i] = o->system->coordinate[i].q;
        slope[i] = nh_diff(d, V, x[i]);
        radial = nh_add(d, radial, nh_mul(d, x[i], slope[i]));
    }
    for (size_t i = 0; i < o->m; i++)
        for (size_t j = 0; j < i; j++)
            if (!vanishes(d, nh_sub(d, nh_mul(d, x[i], slope[j]), nh_mul(d, x[j], slope[i])))) return NOT_CENTRAL;
    if (vanishes(d, V)) return NOT_CENTRAL;
    return vanishes(d, nh_add(d, radial, V))                            ? INVERSE
           : vanishes(d, nh_sub(d, radial, nh_mul(d, nh_int(d, 2), V))) ? ELASTIC
                                                                        : NOT_CENTRAL;
}

/* The components and their names; how many. */
static size_t components(const nh_analysis *r, int power, nh_ex m, nh_ex V, nh_ex *e, const char **name)
{
    const nh_model *o = r->model;
    nh_dag *d = o->dag;
    const nh_coordinate *c = o->system->coordinate;
    nh_ex square = nh_int(d, 0), along = nh_int(d, 0);
    size_t n = 0;
    for (size_t i = 0; i < o->m; i++) {
        square = nh_add(d, square, nh_mul(d, c[i].v, c[i].v));
        along = nh_add(d, along, nh_mul(d, c[i].q, c[i].v));
    }
    for (size_t i = 0; i < o->m && power == INVERSE; i++, n++) {
        nh_ex bilinear = nh_sub(d, nh_mul(d, c[i].q, square), nh_mul(d, c[i].v, along));
        e[n] = nh_add(d, nh_mul(d, m, bilinear), nh_mul(d, c[i].q, V));
        name[n] = c[i].name;
    }
    for (size_t i = 0; i < o->m && power == ELASTIC; i++)
        for (size_t j = 0; j <= i; j++, n++) {
            nh_ex stiffness = nh_diff(d, nh_diff(d, V, c[i].q), c[i].q);
            e[n] = nh_add(d, nh_mul(d, m, nh_mul(d, c[i].v, c[j].v)), nh_mul(d, stiffness, nh_mul(d, c[i].q, c[j].q)));
            name[n] = nh_arena_printf(r->arena, "%s%s", c[j].name, c[i].name);
        }
    return n;
}

static const char *of_point(const nh_analysis *r, nh_ex phi, const char **of)
{
    enum { terms = 2000 };
    const nh_model *o = r->model;
    nh_ex V, m = point_mass(o, &V), e[most * (most + 1) / 2 + 1], c[most * (most + 1) / 2];
    const char *name[most * (most + 1) / 2];
    int power = m ? power_of(o, V) : NOT_CENTRAL;
    size_t n = power == NOT_CENTRAL ? 0 : components(r, power, m, V, e, name), used = 0;
    if (!n) return "";
    e[n] = phi;
    if (!nh_relation_express(o->dag, n + 1, e, o->system->parameters, o->parameter, terms, c)) return "";
    for (size_t i = 0; i < n; i++)
        if (!nh_is_zero(o->dag, c[i])) *of = name[i], used++;
    if (used != 1) *of = "";
    if (power == INVERSE)
        return used == 1 ? "Laplace-Runge-Lenz vector along" : "Component of the Laplace-Runge-Lenz vector";
    return used == 1 ? "Component of Fradkin's tensor" : "Sum of components of Fradkin's tensor";
}

const char *nh_current_form(const nh_analysis *r, nh_ex phi, const char **of)
{
    static const char *const form[] = {"A function of the positions", "Linear in the velocities",
                                       "Quadratic in the velocities", "Cubic in the velocities",
                                       "Of degree 4 in the velocities"};
    double degree = nh_counted_degree_of(r->model, phi);
    *of = "";
    const char *name = degree == 2 && !nh_depends(r->model->dag, phi, r->system->t) ? of_point(r, phi, of) : "";
    if (*name) return name;
    if (degree == 0 && nh_depends(r->model->dag, phi, r->system->t)) return "A function of time and positions";
    return degree < sizeof form / sizeof *form ? form[(size_t)degree] : "";
}
