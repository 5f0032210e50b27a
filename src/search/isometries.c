/* A stage of the search, for symmetries without an ansatz: isometries of the kinetic energy, counted by the transport
 * of their 1-jets and written in closed form (reduction/jets.h, generators.h), whatever the coordinates are.  With xi
 * such a field,
 *
 *     P = xi^s K_sr v^r
 *
 * is conserved where the potential is invariant and the field tangent to the constraints (Noether); where it is not,
 * quadratic integrals of separable and superintegrable systems on spaces of constant curvature are still quadratic
 * forms in the P with functions of position added. */
#include <string.h>

#include "base/progress.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "reduction/generators.h"
#include "search/stage_solver.h"
#include "search/stages_internal.h"

enum { most_momenta = 10, most_functions = 60, most_coordinates = 6 };

typedef struct {
    size_t n;
    nh_ex e[most_functions];
} list;

static void put(list *l, nh_ex e)
{
    for (size_t i = 0; i < l->n; i++)
        if (l->e[i] == e) return;
    if (l->n < most_functions) l->e[l->n++] = e;
}

static bool depends_on_position(const nh_kinetic *k)
{
    bool any = false;
    for (size_t i = 0; i < k->m * k->m; i++) {
        if (nh_depends(k->dag, k->K[i], k->model->system->t)) return false;
        for (size_t s = 0; s < k->m; s++) any |= nh_depends(k->dag, k->K[i], k->q[s]);
    }
    return any;
}

/* xi^s K_sr v^r on the submanifold.  Functions of position that total derivatives in L add are found by the ansatz. */
static nh_ex momentum(const nh_kinetic *k, const nh_generator *g)
{
    nh_dag *d = k->dag;
    nh_ex sum = nh_int(d, 0);
    for (size_t s = 0; s < k->m; s++)
        for (size_t r = 0; r < k->m; r++)
            sum = nh_add(d, sum, nh_product(d, 3, (nh_ex[]){g->component[s], k->K[s * k->m + r], k->v[r]}));
    return nh_simplify_short(d, nh_model_compose(k->model, sum), 0);
}

/* xi^s a_s of L = 1/2 K_rs v^r v^s + a_s v^s - V: what an invariant magnetic field or rotor adds to the momentum. */
static nh_ex magnetic(const nh_kinetic *k, const nh_ex *a, const nh_generator *g)
{
    nh_dag *d = k->dag;
    nh_ex sum = nh_int(d, 0);
    for (size_t s = 0; s < k->m; s++) sum = nh_add(d, sum, nh_mul(d, g->component[s], a[s]));
    return nh_simplify_short(d, sum, 0);
}

/* The momenta of the isometries, and those of the magnetic parts that are no numbers; 0 where the metric has none or is
 * constant (its isometries are among the polynomials). */
static size_t momenta(const nh_stage_solver *solver, nh_ex *P, list *also)
{
    nh_analysis *r = solver->r;
    const nh_options *options = &r->question->options;
    const nh_model *model = r->question->model;
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_kinetic *k = nh_kinetic_metric(model, (uint64_t)options->seed + 909, &ignored);
    nh_jets *jets = NULL;
    nh_generators found = {0};
    nh_ex *a = NULL;
    if (k && k->metric && depends_on_position(k)) {
        a = nh_arena_alloc(r->arena, (k->m + 1) * sizeof *a);
        memcpy(a, k->a, k->m * sizeof *a);
        nh_kinetic alone = *k; /* the metric alone */
        alone.magnetic = false;
        alone.linear = alone.affine = alone.autonomous = alone.general = true;
        alone.f = 0;
        for (size_t s = 0; s < k->m; s++) alone.a[s] = nh_int(k->dag, 0);
        jets = nh_jets_find(&alone, options, &ignored);
        if (jets && jets->dimension && !nh_generators_find(&found, &alone, jets, options, &ignored)) found.count = 0;
    }
    size_t n = 0;
    for (size_t i = 0; i < found.count && i < most_momenta; i++) {
        nh_ex with = magnetic(k, a, &found.generator[i]);
        if (nh_kind_of(k->dag, with) != NH_NUMBER) put(also, with);
        P[n++] = momentum(k, &found.generator[i]);
    }
    nh_jets_free(jets);
    nh_kinetic_free(k);
    return n;
}

/* 1, cos, sin to the given harmonic of every angle by itself. */
static list harmonics(const nh_stage_solver *solver, int most)
{
    const nh_model *model = solver->r->question->model;
    nh_dag *d = model->dag;
    list l = {0};
    put(&l, nh_int(d, 1));
    for (size_t s = 0; s < model->m; s++)
        for (int k = 1; k <= most && model->system->coordinate[s].type == NH_ANGLE; k++) {
            nh_ex angle = nh_mul(d, nh_int(d, k), model->system->coordinate[s].q);
            put(&l, nh_call(d, NH_COS, angle));
            put(&l, nh_call(d, NH_SIN, angle));
        }
    return l;
}

/* Functions that a potential may require: the system's functions, lengths, harmonics, and products of the functions
 * with harmonics. */
static nh_family functions_family(const nh_stage_solver *solver, int most_harmonic, nh_family *part)
{
    nh_arena *arena = solver->r->arena;
    list *w = nh_arena_alloc(arena, sizeof *w), *f = nh_arena_alloc(arena, sizeof *f);
    *w = harmonics(solver, most_harmonic);
    put(f, nh_int(solver->r->question->model->dag, 1));
    for (size_t i = 0; i < solver->words.atoms; i++) put(f, solver->words.atom[i]);
    for (size_t i = 0; i < solver->words.potentials; i++) put(f, solver->words.potential[i]);
    for (size_t i = 0; i < solver->words.lengths; i++) put(f, solver->words.length[i]);
    part[0] = (nh_family){.kind = NH_TERMS, .terms = w->n, .term = w->e};
    part[1] = (nh_family){.kind = NH_TERMS, .terms = f->n, .term = f->e};
    return (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = 2, .part = part};
}

/* Under constraints with coefficients that depend on two angles: of a ball that rolls on a sphere the spin about the
 * normal, n . w with n = (sin a cos b, sin a sin b, cos a). */
static void on_a_sphere(nh_stage_solver *solver, size_t n, const nh_ex *P)
{
    enum { waves = 3 };
    nh_analysis *result = solver->r;
    const nh_model *model = result->question->model;
    nh_dag *d = model->dag;
    nh_family_list families = {result->arena, model, &solver->words, NULL, 0};
    nh_expr_set momenta = {0};
    nh_expr_set_put_all(&momenta, n, P);
    for (size_t a = 0; a < model->m; a++)
        for (size_t b = 0; b < a && !nh_stage_solver_done(solver); b++) {
            if (model->system->coordinate[a].type != NH_ANGLE || model->system->coordinate[b].type != NH_ANGLE)
                continue;
            nh_ex qa = model->system->coordinate[a].q, qb = model->system->coordinate[b].q, one = nh_int(d, 1);
            nh_ex left[waves] = {one, nh_call(d, NH_COS, qa), nh_call(d, NH_SIN, qa)},
                  right[waves] = {one, nh_call(d, NH_COS, qb), nh_call(d, NH_SIN, qb)};
            nh_expr_set products = {0};
            for (size_t i = 0; i < waves * waves; i++)
                nh_expr_set_put(&products, nh_mul(d, left[i / waves], right[i % waves]));
            nh_family factor[] = {nh_family_list_terms(&families, &momenta),
                                  nh_family_list_terms(&families, &products)};
            nh_family all = nh_family_list_product(&families, 2, factor);
            if (nh_stage_solver_promising(solver, 1, &all))
                nh_stage_solver_stage(solver, "momenta of the isometries times waves of two angles", 1, &all);
        }
}

void nh_isometries_search(nh_stage_solver *solver)
{
    nh_analysis *result = solver->r;
    const nh_model *model = result->question->model;
    if (model->m > most_coordinates ||
        (nh_counted_covers(&solver->counted, 1, true) && nh_counted_covers(&solver->counted, 2, false)))
        return;
    nh_progress("isometries of the kinetic energy", -1);
    nh_ex *P = nh_arena_alloc(result->arena, most_momenta * sizeof *P),
          *PP = nh_arena_alloc(result->arena, (most_momenta * most_momenta + 1) * sizeof *PP);
    list *also = nh_arena_alloc(result->arena, sizeof *also);
    also->n = 0;
    put(also, solver->r->question->system->t); /* a force that is uniform along the field */
    size_t n = momenta(solver, P, also), squares = 0;
    if (n == 0) return;
    nh_family part[4], *all = nh_arena_alloc(result->arena, 3 * sizeof *all);
    all[0] = (nh_family){.kind = NH_TERMS, .terms = n, .term = P};
    all[1] = functions_family(solver, 1, part);
    all[2] = (nh_family){.kind = NH_TERMS, .terms = also->n, .term = also->e};
    nh_stage_solver_stage(solver, "momenta of the isometries of the kinetic energy, and functions", 3, all);
    if (model->k && !nh_counted_covers(&solver->counted, 1, false)) on_a_sphere(solver, n, P);
    if (nh_stage_solver_done(solver)) return;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++) PP[squares++] = nh_mul(model->dag, P[i], P[j]);
    all[0] = (nh_family){.kind = NH_TERMS, .terms = squares, .term = PP};
    all[1] = functions_family(solver, 2, part + 2);
    nh_stage_solver_stage(solver, "their products, and functions", 2, all);
}
