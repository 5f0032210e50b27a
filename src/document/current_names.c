/* current_names: names of conserved quantities by their definitions; algebra decides. */
#include "document/current_words.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "evaluate/tape.h"
#include "exact/normal.h"
#include "exact/relation_express.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "search/counted.h"

/* ---- by Noether's theorem ---- */

enum { longest = 1000, proof_terms = 4000 };

static bool is_zero(nh_dag *d, nh_ex e) { return nh_normal_is_zero(d, e, proof_terms) == NH_ZERO; }

static bool without_velocities(const nh_model *model, nh_ex e)
{
    bool none = true;
    for (size_t j = 1 + model->m; j < model->width; j++)
        none = none && !nh_depends(model->dag, e, model->chart->symbol[j]);
    return none;
}

/* Is Z a field on (t, q)? */
static bool is_field(const nh_model *model, const nh_field *Z)
{
    bool field = without_velocities(model, Z->time);
    for (size_t s = 0; s < model->m && field; s++) field = without_velocities(model, Z->space[s]);
    return field;
}

/* Do the values of e at two places differ?  It is a function of positions and parameters. */
static bool varies(const nh_model *model, nh_ex e)
{
    static const double golden = 0.6180339887498949, small = 1e-8;
    size_t n = 1 + model->m + model->system->parameters;
    nh_ex *symbol = nh_alloc_array(n, sizeof *symbol);
    double *at = nh_alloc_array(n, sizeof *at), value[2];
    for (size_t j = 0; j < n; j++)
        symbol[j] = j <= model->m ? model->chart->symbol[j] : model->parameter[j - 1 - model->m];
    for (int place = 0; place < 2; place++) {
        for (size_t j = 0; j < n; j++)
            at[j] = j > model->m ? model->parameter_value[j - 1 - model->m]
                                 : 0.4 + 0.8 * fmod(golden * (double)(j + 1 + (size_t)place * n), 1);
        nh_tape_constants(model->dag, 1, &e, n, symbol, at, &value[place]);
    }
    nh_free(symbol);
    nh_free(at);
    return !(fabs(value[1] - value[0]) <= small * (1 + fabs(value[0])));
}

/* The spatial angular velocity of a body with Euler's angles a, h, s about z, x and z, with these rates:
 * (h' cos a + s' sin h sin a, h' sin a - s' sin h cos a, a' + s' cos h).  About z, y, z it is the same, turned by a
 * right angle.  Is it the same everywhere, and not 0 or vertical? */
static bool turns_body(const nh_model *model, const nh_ex *rate, size_t a, size_t h, size_t s)
{
    nh_dag *d = model->dag;
    const nh_coordinate *c = model->system->coordinate;
    nh_ex sine = nh_call(d, NH_SIN, c[a].q), cosine = nh_call(d, NH_COS, c[a].q),
          spin = nh_mul(d, rate[s], nh_call(d, NH_SIN, c[h].q)), nod = rate[h];
    nh_ex w[3] = {nh_add(d, nh_mul(d, nod, cosine), nh_mul(d, spin, sine)),
                  nh_sub(d, nh_mul(d, nod, sine), nh_mul(d, spin, cosine)),
                  nh_add(d, rate[a], nh_mul(d, rate[s], nh_call(d, NH_COS, c[h].q)))};
    for (int i = 0; i < 3; i++)
        if (varies(model, w[i])) return false;
    for (int i = 0; i < 3; i++) {
        w[i] = nh_simplify(d, w[i]);
        if (!nh_model_is_constant(model, w[i])) return false;
    }
    return !nh_is_zero(d, w[0]) || !nh_is_zero(d, w[1]);
}

/* Does the kinetic energy depend on the angle?  It never does on the first of Euler's angles, which turns all in
 * space. */
static bool kinetic_depends(const nh_model *model, size_t angle, const size_t euler[3])
{
    nh_dag *d = model->dag;
    const nh_coordinate *c = model->system->coordinate;
    nh_ex slope = nh_diff(d, model->system->lagrangian, c[angle].q);
    bool any = false;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j <= i && !any; j++) {
            nh_ex T = nh_simplify(d, nh_diff(d, nh_diff(d, slope, c[euler[i]].v), c[euler[j]].v));
            any = !nh_is_zero(d, T);
        }
    return any;
}

/* The momentum of rotations of a body about an axis that is fixed in space, or in the body, where first and last of
 * Euler's angles change places; where the kinetic energy depends on neither, it may be each. */
static const char *body_name(const nh_model *model, const nh_field *Z)
{
    size_t m = model->m;
    for (size_t i = 0; i < m * m * m; i++) {
        size_t e[3] = {i / (m * m), i / m % m, i % m};
        bool three = e[0] != e[1] && e[1] != e[2] && e[0] != e[2] && !nh_is_zero(model->dag, Z->space[e[1]]);
        if (!three || !turns_body(model, Z->space, e[0], e[1], e[2])) continue;
        bool first = kinetic_depends(model, e[0], e), last = kinetic_depends(model, e[2], e);
        return first && last ? ""
               : last        ? "Component of the spatial angular momentum"
               : first       ? "Component of the angular momentum in the body"
                             : "Component of the angular momentum";
    }
    return "";
}

/* The energy less what the moving frame of Z adds to it: "Jacobi's integral" without constraints on velocities, else
 * "Moving energy" [FassoSansonetto2016]. */
static const char *energy_name(const nh_analysis *result, const nh_field *Z)
{
    const nh_model *model = result->question->model;
    bool moves = false;
    for (size_t s = 0; s < model->m; s++) moves |= !nh_is_zero(model->dag, Z->space[s]);
    if (!moves || nh_is_zero(model->dag, Z->time) || !nh_model_is_constant(model, Z->time)) return "";
    const char *kind = model->k ? nh_constraint_integrability(model, &result->question->constraint) : "none";
    bool free = !model->k || !strcmp(kind, "holonomic") || !strcmp(kind, "integrable");
    return free ? "Jacobi's integral" : "Moving energy";
}

/* phi = t P - M(q), for a symmetry that moves lengths at constant velocities, so that P is their momentum. */
static bool is_centre_of_mass(const nh_model *model, nh_ex phi)
{
    nh_dag *d = model->dag;
    nh_ex t = model->system->t, P = nh_diff(d, phi, t), M = nh_simplify(d, nh_sub(d, phi, nh_mul(d, t, P)));
    for (size_t s = 0; s < model->m; s++)
        if (model->system->coordinate[s].type == NH_ANGLE && nh_depends(d, M, model->system->coordinate[s].q))
            return false;
    return !nh_depends(d, P, t) && !nh_depends(d, M, t) && without_velocities(model, M);
}

nh_current_name nh_current_noether(const nh_analysis *result, const nh_current *f)
{
    nh_model *model = result->question->model;
    nh_dag *d = model->dag;
    const nh_field *Z = &f->symmetry.field;
    nh_current_name none = {"", 0};
    if (f->series || !f->has_symmetry || nh_complexity(d, f->phi) > longest || nh_complexity(d, model->E) > longest)
        return none;
    const char *how, *name = "";
    nh_text what;
    nh_text_init(&what);
    bool rotations = nh_symmetry_words(model, &f->symmetry, &how, &what);
    nh_text_clear(&what);
    if (!strncmp(how, "boosts", strlen("boosts")) && is_centre_of_mass(model, f->phi))
        return (nh_current_name){"Motion of the centre of mass", 0};
    if (f->symmetry.along_motion || !is_field(model, Z)) return none;
    if (!nh_is_zero(d, Z->time)) name = energy_name(result, Z);
    else name = rotations ? "Angular momentum" : body_name(model, Z);
    if (!*name) return none;
    nh_ex e = nh_neg(d, nh_mul(d, model->E, Z->time));
    for (size_t s = 0; s < model->m; s++) e = nh_add(d, e, nh_mul(d, model->p[s], Z->space[s]));
    bool energy = !nh_is_zero(d, Z->time);
    if (is_zero(d, nh_sub(d, f->phi, e))) return (nh_current_name){name, energy ? -1 : 1};
    if (is_zero(d, nh_add(d, f->phi, e))) return (nh_current_name){name, energy ? 1 : -1};
    return none;
}

/* ---- points with a force towards a centre ---- */

enum { most = 3, NOT_CENTRAL = 0, INVERSE = -1, ELASTIC = 2 };

static bool vanishes(nh_dag *d, nh_ex e) { return nh_is_zero(d, nh_simplify(d, e)); }

/* The mass of a point in two or three Cartesian coordinates, and V = m v^2/2 - L of (q); 0: it is no such point. */
static nh_ex point_mass(const nh_model *model, nh_ex *V)
{
    nh_dag *d = model->dag;
    const nh_system *system = model->system;
    nh_ex kinetic = nh_int(d, 0), m = 0;
    if (model->k || model->m < 2 || model->m > most || model->n != model->m || model->framed || model->chart->quasi ||
        system->orientations)
        return 0;
    for (size_t i = 0; i < model->m; i++) {
        nh_ex v = system->coordinate[i].v;
        if (system->coordinate[i].type == NH_ANGLE) return 0;
        nh_ex own = nh_simplify(d, nh_diff(d, nh_diff(d, system->lagrangian, v), v));
        if (i && !vanishes(d, nh_sub(d, own, m))) return 0;
        m = own;
        kinetic = nh_add(d, kinetic, nh_mul(d, m, nh_mul(d, v, v)));
    }
    if (!nh_model_is_constant(model, m) || nh_is_zero(d, m)) return 0;
    *V = nh_simplify(d, nh_sub(d, nh_div(d, kinetic, nh_int(d, 2)), system->lagrangian));
    for (size_t i = 0; i < model->m; i++)
        if (nh_depends(d, *V, system->coordinate[i].v)) return 0;
    return nh_depends(d, *V, system->t) ? 0 : m;
}

/* The power of the distance that V is, INVERSE or ELASTIC; NOT_CENTRAL: another function. */
static int power_of(const nh_model *model, nh_ex V)
{
    nh_dag *d = model->dag;
    nh_ex radial = nh_int(d, 0), slope[most], *x = (nh_ex[most]){0};
    for (size_t i = 0; i < model->m; i++) {
        x[i] = model->system->coordinate[i].q;
        slope[i] = nh_diff(d, V, x[i]);
        radial = nh_add(d, radial, nh_mul(d, x[i], slope[i]));
    }
    for (size_t i = 0; i < model->m; i++)
        for (size_t j = 0; j < i; j++)
            if (!vanishes(d, nh_sub(d, nh_mul(d, x[i], slope[j]), nh_mul(d, x[j], slope[i])))) return NOT_CENTRAL;
    if (vanishes(d, V)) return NOT_CENTRAL;
    return vanishes(d, nh_add(d, radial, V))                            ? INVERSE
           : vanishes(d, nh_sub(d, radial, nh_mul(d, nh_int(d, 2), V))) ? ELASTIC
                                                                        : NOT_CENTRAL;
}

/* The components and their names; how many. */
static size_t components(const nh_analysis *result, int power, nh_ex m, nh_ex V, nh_ex *e, const char **name)
{
    const nh_model *model = result->question->model;
    nh_dag *d = model->dag;
    const nh_coordinate *c = model->system->coordinate;
    nh_ex square = nh_int(d, 0), along = nh_int(d, 0);
    size_t n = 0;
    for (size_t i = 0; i < model->m; i++) {
        square = nh_add(d, square, nh_mul(d, c[i].v, c[i].v));
        along = nh_add(d, along, nh_mul(d, c[i].q, c[i].v));
    }
    for (size_t i = 0; i < model->m && power == INVERSE; i++, n++) {
        nh_ex bilinear = nh_sub(d, nh_mul(d, c[i].q, square), nh_mul(d, c[i].v, along));
        e[n] = nh_add(d, nh_mul(d, m, bilinear), nh_mul(d, c[i].q, V));
        name[n] = c[i].name;
    }
    for (size_t i = 0; i < model->m && power == ELASTIC; i++)
        for (size_t j = 0; j <= i; j++, n++) {
            nh_ex stiffness = nh_diff(d, nh_diff(d, V, c[i].q), c[i].q);
            e[n] = nh_add(d, nh_mul(d, m, nh_mul(d, c[i].v, c[j].v)), nh_mul(d, stiffness, nh_mul(d, c[i].q, c[j].q)));
            name[n] = nh_arena_printf(result->arena, "%s%s", c[j].name, c[i].name);
        }
    return n;
}

static const char *of_point(const nh_analysis *result, nh_ex phi, const char **of)
{
    enum { terms = 2000 };
    const nh_model *model = result->question->model;
    nh_ex V, m = point_mass(model, &V), e[most * (most + 1) / 2 + 1], c[most * (most + 1) / 2];
    const char *name[most * (most + 1) / 2];
    int power = m ? power_of(model, V) : NOT_CENTRAL;
    size_t n = power == NOT_CENTRAL ? 0 : components(result, power, m, V, e, name), used = 0;
    if (!n) return "";
    e[n] = phi;
    if (!nh_relation_express(model->dag, n + 1, e, model->system->parameters, model->parameter, terms, c)) return "";
    for (size_t i = 0; i < n; i++)
        if (!nh_is_zero(model->dag, c[i])) *of = name[i], used++;
    if (used != 1) *of = "";
    if (power == INVERSE)
        return used == 1 ? "Laplace-Runge-Lenz vector along" : "Component of the Laplace-Runge-Lenz vector";
    return used == 1 ? "Component of Fradkin's tensor" : "Sum of components of Fradkin's tensor";
}

/* ---- by the form ---- */

const char *nh_current_form(const nh_analysis *result, nh_ex phi, const char **of)
{
    nh_model *model = result->question->model;
    static const char *const form[] = {"A function of the positions", "Linear in the velocities",
                                       "Quadratic in the velocities", "Cubic in the velocities",
                                       "Of degree 4 in the velocities"};
    double degree = nh_counted_degree_of(model, phi);
    *of = "";
    const char *name =
        degree == 2 && !nh_depends(model->dag, phi, result->question->system->t) ? of_point(result, phi, of) : "";
    if (*name) return name;
    if (degree == 0 && nh_depends(model->dag, phi, result->question->system->t))
        return "A function of time and positions";
    return degree < sizeof form / sizeof *form ? form[(size_t)degree] : "";
}
