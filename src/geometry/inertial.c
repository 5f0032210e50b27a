/* inertial: the quadratic form of A_s in the velocities, by kinds of coordinates. */
#include "geometry/submanifold.h"

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"

/* The name of the term v^j v^k: two angles, an angle and a length, two lengths. */
static nh_inertial_part part_of(const nh_system *system, size_t j, size_t k)
{
    bool first = system->coordinate[j].type == NH_ANGLE, second = system->coordinate[k].type == NH_ANGLE;
    return first && second ? NH_INERTIAL_CENTRIFUGAL : first || second ? NH_INERTIAL_CORIOLIS : NH_INERTIAL_FURTHER;
}

/* The parts of A_s along coordinate c: with B = d2A/dv^j dv^k, 1/2 v^j v^k B goes to the kind of (j, k), (dA/dv^j - B
 * v^k) v^j is linear, the rest applied.  False where A_s - Q_s is not at most quadratic. */
static bool split(const nh_submanifold *s, size_t c, nh_ex *part)
{
    const nh_model *model = s->model;
    nh_dag *d = model->dag;
    const nh_system *system = model->system;
    nh_ex A = nh_sub(d, s->free_A[c], system->force[c]), rest = A;
    for (size_t i = 0; i < NH_INERTIAL_PARTS; i++) part[i] = nh_int(d, 0);
    for (size_t j = 0; j < model->m; j++) {
        nh_ex slope = nh_diff(d, A, system->coordinate[j].v), linear = slope;
        for (size_t k = 0; k < model->m; k++) {
            nh_ex v = system->coordinate[k].v, second = nh_simplify(d, nh_diff(d, slope, v)), both;
            for (size_t l = 0; l < model->m; l++)
                if (nh_normal_is_zero(d, nh_diff(d, second, system->coordinate[l].v), 0) != NH_ZERO) return false;
            both = nh_product(d, 4, (nh_ex[]){nh_ratio(d, 1, 2), system->coordinate[j].v, v, second});
            part[part_of(system, j, k)] = nh_add(d, part[part_of(system, j, k)], both);
            rest = nh_sub(d, rest, both);
            linear = nh_sub(d, linear, nh_mul(d, second, v));
        }
        linear = nh_mul(d, linear, system->coordinate[j].v);
        part[NH_INERTIAL_FURTHER] = nh_add(d, part[NH_INERTIAL_FURTHER], linear);
        rest = nh_sub(d, rest, linear);
    }
    part[NH_INERTIAL_APPLIED] = nh_add(d, rest, system->force[c]);
    for (size_t i = 0; i < NH_INERTIAL_PARTS; i++) part[i] = nh_simplify(d, part[i]);
    return true;
}

nh_inertial *nh_inertial_of(nh_arena *arena, const nh_submanifold *s)
{
    enum { largest = 3000 };
    const nh_model *model = s->model;
    size_t lengths = 0;
    bool good = model->k > 0;
    for (size_t c = 0; c < model->m; c++) {
        lengths += model->system->coordinate[c].type == NH_LENGTH;
        good =
            good && model->system->coordinate[c].type != NH_PLAIN && nh_complexity(model->dag, s->free_A[c]) <= largest;
    }
    if (!good || lengths == 0) return NULL;
    nh_inertial *out = nh_arena_alloc(arena, sizeof *out);
    *out = (nh_inertial){s, nh_arena_alloc(arena, model->m * NH_INERTIAL_PARTS * sizeof(nh_ex))};
    for (size_t c = 0; c < model->m; c++)
        if (model->system->coordinate[c].type == NH_LENGTH && !split(s, c, out->part + c * NH_INERTIAL_PARTS))
            return NULL;
    return out;
}
