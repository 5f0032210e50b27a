/* A stage of the search: fields that are linear in the coordinates, and centres of mass.
 *
 *     P = (B^s_r q^r + b^s) p_s                  of a turn of all coordinates at once: of a body that floats freely
 *     the same with words of turns in three angles
 *     the same with F_r p_s/M                    of a turn about the centre of mass, of a body that falls
 *     p_s = dF/dt, dp_s/dt = Q:  F - t p_s + Q t^2/2
 *
 * The coefficients of P are numbers such as 1, where those in the velocities are all masses and lengths; the last has
 * none, so that all are proved for all parameters, by the short fields that they have. */
#include "base/memory.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"
#include "integrals/affine_field.h"
#include "search/stage_solver.h"
#include "search/stages_internal.h"

static bool is_constant(const nh_model *model, nh_ex e)
{
    for (size_t s = 0; s < model->m; s++)
        if (nh_depends(model->dag, e, model->system->coordinate[s].q)) return false;
    return !nh_depends(model->dag, e, model->system->t);
}

/* Of the whole along a direction: dF/dt = P, dP/dt = Q is constant, and F/mass is the place of the centre of mass. */
typedef struct {
    nh_ex F, P, Q, mass; /* mass: 0 where it is not needed */
} centre;

/* P - Q t and F - t P + Q t^2/2. */
static void centres_of_mass(nh_stage_solver *solver, size_t centres, const centre *c)
{
    nh_dag *d = solver->r->question->model->dag;
    nh_ex t = solver->r->question->model->system->t, half = nh_ratio(d, 1, 2);
    for (size_t i = 0; i < centres && !nh_stage_solver_done(solver); i++) {
        nh_ex momentum = nh_sub(d, c[i].P, nh_mul(d, c[i].Q, t)), F = nh_sub(d, c[i].F, nh_mul(d, t, c[i].P));
        if (!nh_is_zero(d, c[i].Q)) nh_stage_solver_certify(solver, momentum, "a momentum and its force");
        if (nh_stage_solver_done(solver)) return;
        F = nh_add(d, F, nh_product(d, 3, (nh_ex[]){half, c[i].Q, nh_powi(d, t, 2)}));
        nh_stage_solver_certify(solver, F, "a centre of mass");
    }
}

/* Those along one coordinate, by geometry (integrals/affine_field.h); returns their number, at most m. */
static size_t pulled_centres(const nh_model *model, size_t max_terms, centre *out)
{
    nh_dag *d = model->dag;
    nh_centre_of_mass *found = nh_alloc_array(model->m + 1, sizeof *found);
    size_t centres = nh_centre_of_mass_find(model, max_terms, found), count = 0;
    for (size_t i = 0; i < centres; i++) {
        size_t s = found[i].s;
        nh_ex Q = nh_simplify_short(d, nh_diff(d, model->system->lagrangian, model->system->coordinate[s].q), 0);
        if (model->system->has_forces) Q = nh_add(d, Q, model->system->force[s]);
        bool constant = is_constant(model, Q);
        for (size_t r = 0; r < model->m; r++) constant = constant && !nh_depends(d, Q, model->system->coordinate[r].v);
        if (constant) out[count++] = (centre){found[i].F, model->p[s], Q, found[i].mass};
    }
    nh_free(found);
    return count;
}

/* F_i P_j/M of two centres: with them a turn is one about the centre of mass, which a constant force leaves alone.
 * Without a force they are products of currents. */
static nh_expr_set turns_about_centres(const nh_model *model, size_t centres, const centre *c)
{
    nh_expr_set all = {0};
    bool some = false;
    for (size_t i = 0; i < centres; i++) some |= !nh_is_zero(model->dag, c[i].Q);
    for (size_t i = 0; i < centres && some; i++)
        for (size_t j = 0; j < centres; j++)
            if (j != i) nh_expr_set_put(&all, nh_div(model->dag, nh_mul(model->dag, c[i].F, c[j].P), c[i].mass));
    return all;
}

/* The angles about whose axis the whole can be turned: a known current has a field that moves no other angle. */
static void first_angles(const nh_stage_solver *solver, bool *first)
{
    const nh_analysis *r = solver->r;
    const nh_model *model = r->question->model;
    const nh_coordinate *c = model->system->coordinate;
    nh_ex *zeta = nh_alloc_array(model->n + 1, sizeof *zeta);
    for (size_t k = 0; k < r->list->count; k++) {
        size_t angles = 0, last = 0;
        if (!nh_affine_field(model, r->list->found[k].phi, &r->question->options, zeta)) continue;
        for (size_t s = 0; s < model->m; s++)
            if (c[s].type == NH_ANGLE && !nh_is_zero(model->dag, zeta[s])) angles++, last = s;
        if (angles == 1 && nh_kind_of(model->dag, zeta[last]) == NH_NUMBER) first[last] = true;
    }
    nh_free(zeta);
}

/* Turns in space: the momenta of three angles in a row times the words of affine_field.h, for each first angle and the
 * other two as second, together with the families of turns in a plane. */
static void turns_in_space(nh_stage_solver *solver, nh_family_list *families, size_t others, const nh_family *other)
{
    enum { three = 3 };
    const nh_model *model = solver->r->question->model;
    size_t *angle = nh_alloc_array(model->m + 1, sizeof *angle), angles = 0;
    bool *first = nh_alloc_array(model->m + 1, sizeof *first);
    for (size_t s = 0; s < model->m; s++)
        if (model->system->coordinate[s].type == NH_ANGLE) angle[angles++] = s;
    if (angles >= three) first_angles(solver, first);
    for (size_t i = 0; i + three <= angles; i++)
        for (size_t pair = 0; pair < three * three && !nh_stage_solver_done(solver); pair++) {
            size_t a = angle[i + pair / three], b = angle[i + pair % three];
            nh_expr_set momenta = {0}, words = {0};
            nh_ex word[NH_AFFINE_FIELD_WORDS];
            if (first[a]) nh_expr_set_put_all(&words, nh_affine_field_words(model, a, b, word), word);
            if (!words.n) continue;
            for (size_t k = 0; k < three; k++) nh_expr_set_put(&momenta, model->p[angle[i + k]]);
            nh_family factor[] = {nh_family_list_terms(families, &momenta), nh_family_list_terms(families, &words)};
            nh_family all[] = {nh_family_list_product(families, 2, factor), other[0], other[others - 1]};
            if (nh_stage_solver_promising(solver, 1 + others, all))
                nh_stage_solver_stage(solver, "momenta of turns in three angles", 1 + others, all);
        }
    nh_free(first);
    nh_free(angle);
}

/* Of a current P - Q t with P = g_s v^s, g and Q constant: F = g_s q^s.  False: it is no such current. */
static bool centre_of(const nh_model *model, nh_ex current, centre *out)
{
    nh_dag *d = model->dag;
    nh_ex Q = nh_neg(d, nh_simplify_short(d, nh_diff(d, current, model->system->t), 0)), zero = nh_int(d, 0);
    *out = (centre){zero, zero, Q, zero};
    if (!nh_model_is_constant(model, Q)) return false;
    for (size_t s = 0; s < model->m; s++) {
        const nh_coordinate *q = &model->system->coordinate[s];
        nh_ex g = nh_simplify_short(d, nh_diff(d, current, q->v), 0);
        if (!nh_model_is_constant(model, g)) return false;
        out->F = nh_add(d, out->F, nh_mul(d, g, q->q));
        out->P = nh_add(d, out->P, nh_mul(d, g, q->v));
    }
    nh_ex rest = nh_sub(d, nh_sub(d, current, out->P), nh_neg(d, nh_mul(d, Q, model->system->t)));
    return !nh_is_zero(d, out->F) && nh_is_zero(d, rest);
}

/* Of a constant kinetic energy: the sums of momenta that a constant force changes.  They and their centres of mass come
 * first: turns of the whole about its centre of mass are products of them.  Returns their number, at most 2 m. */
static size_t moved_centres(nh_stage_solver *solver, nh_family_list *families, centre *out)
{
    const nh_analysis *result = solver->r;
    const nh_current_list *list = result->list;
    const nh_model *model = result->question->model;
    nh_expr_set linear_in_t = {0};
    size_t count = 0;
    nh_expr_set_put_all(&linear_in_t, model->m, model->p);
    nh_expr_set_put(&linear_in_t, model->system->t);
    nh_family momenta = nh_family_list_terms(families, &linear_in_t);
    nh_stage_solver_stage(solver, "canonical momenta", 1, &momenta);
    for (size_t k = 0; k < list->count && count < model->m; k++)
        count += list->found[k].proof.proved && centre_of(model, list->found[k].phi, &out[count]);
    /* one that is a function of the energy and the others */
    for (size_t s = 0; s < model->m; s++)
        if (nh_is_zero(model->dag, nh_simplify_short(model->dag, nh_model_gamma(model, model->p[s]), 0)))
            count += centre_of(model, model->p[s], &out[count]);
    return count;
}

void nh_linear_fields_search(nh_stage_solver *solver)
{
    nh_analysis *result = solver->r;
    const nh_model *model = result->question->model;
    bool constant = true;
    if (model->k || model->chart->quasi) return;
    for (size_t i = 0; i < model->n * model->n; i++) constant = constant && is_constant(model, model->M[i]);
    if (constant && nh_linear_motion_is(solver)) return; /* the search of linear motion has all of them */
    nh_family_list families = {result->arena, model, &solver->words, NULL, 0};
    centre *c = nh_arena_alloc(result->arena, (2 * model->m + 1) * sizeof *c);
    size_t centres = constant ? moved_centres(solver, &families, c)
                              : pulled_centres(model, (size_t)result->question->options.proof_terms, c);
    nh_expr_set momenta = {0}, positions = nh_expr_set_positions(&families, true, false),
                others = constant ? (nh_expr_set){0} : turns_about_centres(model, centres, c);
    nh_expr_set_put_all(&momenta, model->m, model->p);
    nh_family factor[] = {nh_family_list_terms(&families, &momenta), nh_family_list_terms(&families, &positions)};
    nh_family all[] = {nh_family_list_product(&families, 2, factor), nh_family_list_terms(&families, &others)};
    size_t n = others.n ? 2 : 1;
    if (constant) centres_of_mass(solver, centres, c);
    solver->wide = true; /* of many coordinates these are few columns */
    nh_stage_solver_stage(solver, "canonical momenta times 1 and positions", n, all);
    solver->wide = false;
    if (constant) return;
    turns_in_space(solver, &families, n, all);
    centres_of_mass(solver, centres, c);
}
