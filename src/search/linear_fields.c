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
#include "integrals/centre_of_mass.h"
#include "search/stage_solver.h"
#include "search/stages_internal.h"

static bool is_constant(const nh_model *model, nh_ex e)
{
    for (size_t s = 0; s < model->m; s++)
        if (nh_depends(model->dag, e, model->system->coordinate[s].q)) return false;
    return !nh_depends(model->dag, e, model->system->t);
}

/* dp_s/dt = Q, a constant: p_s - Q t; with p_s = dF/dt also F - t p_s + Q t^2/2. */
static void centres_of_mass(nh_stage_solver *solver, size_t centres, const nh_centre_of_mass *centre,
                            const nh_ex *force)
{
    const nh_model *model = solver->r->model;
    nh_dag *d = model->dag;
    nh_ex t = model->system->t, half = nh_ratio(d, 1, 2);
    for (size_t i = 0; i < centres && !nh_stage_solver_done(solver); i++) {
        nh_ex Q = force[i], P = model->p[centre[i].s];
        if (!nh_is_zero(d, Q))
            nh_stage_solver_certify(solver, nh_sub(d, P, nh_mul(d, Q, t)), "a momentum and its force");
        if (nh_stage_solver_done(solver)) return;
        nh_ex F = nh_sub(d, centre[i].F, nh_mul(d, t, P));
        nh_stage_solver_certify(solver, nh_add(d, F, nh_product(d, 3, (nh_ex[]){half, Q, nh_powi(d, t, 2)})),
                                "a centre of mass");
    }
}

/* The centres of mass along which the force is a constant, and it. */
static size_t pulled_centres(const nh_model *model, size_t max_terms, nh_centre_of_mass *centre, nh_ex *force)
{
    nh_dag *d = model->dag;
    size_t centres = nh_centre_of_mass_find(model, max_terms, centre), count = 0;
    for (size_t i = 0; i < centres; i++) {
        size_t s = centre[i].s;
        nh_ex Q = nh_simplify_short(d, nh_diff(d, model->system->lagrangian, model->system->coordinate[s].q), 0);
        if (model->system->has_forces) Q = nh_add(d, Q, model->system->force[s]);
        bool constant = is_constant(model, Q);
        for (size_t r = 0; r < model->m; r++) constant = constant && !nh_depends(d, Q, model->system->coordinate[r].v);
        if (!constant) continue;
        centre[count] = centre[i];
        force[count++] = Q;
    }
    return count;
}

/* F_i p_j/M of two centres: with them a turn is one about the centre of mass, which a constant force leaves alone.
 * Without a force they are products of currents. */
static nh_expr_set turns_about_centres(const nh_model *model, size_t centres, const nh_centre_of_mass *centre,
                                       const nh_ex *force)
{
    nh_expr_set all = {0};
    bool some = false;
    for (size_t i = 0; i < centres; i++) some |= !nh_is_zero(model->dag, force[i]);
    for (size_t i = 0; i < centres && some; i++)
        for (size_t j = 0; j < centres; j++) {
            nh_ex word = nh_mul(model->dag, centre[i].F, model->p[centre[j].s]);
            if (j != i) nh_expr_set_put(&all, nh_div(model->dag, word, centre[i].mass));
        }
    return all;
}

/* The angles about whose axis the whole can be turned: a known current has a field that moves no other angle. */
static void first_angles(const nh_stage_solver *solver, bool *first)
{
    const nh_analysis *r = solver->r;
    const nh_model *model = r->model;
    const nh_coordinate *c = model->system->coordinate;
    nh_ex *zeta = nh_alloc_array(model->n + 1, sizeof *zeta);
    for (size_t k = 0; k < r->count; k++) {
        size_t angles = 0, last = 0;
        if (!nh_affine_field(model, r->found[k].phi, &r->options, zeta)) continue;
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
    const nh_model *model = solver->r->model;
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

/* F - t P + c t^2/2 of P = g_s v^s + c t, a current with constant g and c, where F = g_s q^s. */
static void boost(nh_stage_solver *solver, nh_ex P)
{
    const nh_model *model = solver->r->model;
    nh_dag *d = model->dag;
    nh_ex t = model->system->t, F = nh_int(d, 0), rest = P, c = nh_simplify_short(d, nh_diff(d, P, t), 0);
    bool linear = nh_model_is_constant(model, c);
    for (size_t s = 0; s < model->m && linear; s++) {
        const nh_coordinate *q = &model->system->coordinate[s];
        nh_ex g = nh_simplify_short(d, nh_diff(d, P, q->v), 0);
        linear = nh_model_is_constant(model, g);
        F = nh_add(d, F, nh_mul(d, g, q->q));
        rest = nh_sub(d, rest, nh_mul(d, g, q->v));
    }
    if (!linear || nh_is_zero(d, F) || !nh_is_zero(d, nh_sub(d, rest, nh_mul(d, c, t)))) return;
    F = nh_sub(d, F, nh_mul(d, t, P));
    F = nh_add(d, F, nh_product(d, 3, (nh_ex[]){nh_ratio(d, 1, 2), c, nh_powi(d, t, 2)}));
    nh_stage_solver_certify(solver, nh_simplify_short(d, F, 0), "a centre of mass");
}

/* Of a constant kinetic energy: the sums of momenta that a constant force changes, and their centres of mass.  They
 * come first: turns of the whole about its centre of mass are products of them. */
static void boosts(nh_stage_solver *solver, nh_family_list *families)
{
    const nh_analysis *result = solver->r;
    const nh_model *model = result->model;
    nh_expr_set linear_in_t = {0};
    nh_expr_set_put_all(&linear_in_t, model->m, model->p);
    nh_expr_set_put(&linear_in_t, model->system->t);
    nh_family momenta = nh_family_list_terms(families, &linear_in_t);
    nh_stage_solver_stage(solver, "canonical momenta", 1, &momenta);
    for (size_t k = 0, count = result->count; k < count && !nh_stage_solver_done(solver); k++)
        if (result->found[k].proof.proved) boost(solver, result->found[k].phi);
    /* one that is a function of the energy and the others */
    for (size_t s = 0; s < model->m && !nh_stage_solver_done(solver); s++)
        if (nh_is_zero(model->dag, nh_simplify_short(model->dag, nh_model_gamma(model, model->p[s]), 0)))
            boost(solver, model->p[s]);
}

void nh_linear_fields_search(nh_stage_solver *solver)
{
    nh_analysis *result = solver->r;
    const nh_model *model = result->model;
    bool constant = true;
    if (model->k || model->chart->quasi) return;
    for (size_t i = 0; i < model->n * model->n; i++) constant = constant && is_constant(model, model->M[i]);
    if (constant && nh_linear_motion_is(solver)) return; /* the search of linear motion has all of them */
    nh_centre_of_mass *centre = nh_arena_alloc(result->arena, (model->m + 1) * sizeof *centre);
    nh_ex *force = nh_arena_alloc(result->arena, (model->m + 1) * sizeof *force);
    size_t centres = pulled_centres(model, (size_t)result->options.proof_terms, centre, force);
    nh_family_list families = {result->arena, model, &solver->words, NULL, 0};
    nh_expr_set momenta = {0}, positions = nh_expr_set_positions(&families, true, false),
                others = turns_about_centres(model, centres, centre, force);
    nh_expr_set_put_all(&momenta, model->m, model->p);
    nh_family factor[] = {nh_family_list_terms(&families, &momenta), nh_family_list_terms(&families, &positions)};
    nh_family all[] = {nh_family_list_product(&families, 2, factor), nh_family_list_terms(&families, &others)};
    size_t n = others.n ? 2 : 1;
    if (constant) boosts(solver, &families);
    solver->wide = true; /* of many coordinates these are few columns */
    nh_stage_solver_stage(solver, "canonical momenta times 1 and positions", n, all);
    solver->wide = false;
    if (!constant) turns_in_space(solver, &families, n, all);
    centres_of_mass(solver, centres, centre, force);
}
