/* symmetry_space: linear conditions on sums of products of currents. [docs/method.md, sec. 5, (18a)]
 *
 *     list_products       1, Phi_i, Phi_i Phi_j up to degree 2 in the velocities; independent ones: columns
 *     conditions          rows that vanish: U_a(Phi) (inside), V(Phi) (case 1), Y_i(Z^s) (projectable), or both (best)
 *     subspace            all combinations of the columns whose rows vanish: exact (exact/relation_space.h)
 *     make_basis          nested spaces in echelon form:   best  <  case 1  <  inside  <  all
 *                                                          best  <  projectable     <  all
 *     bound               rank of the closure of Gamma and U (or V): how many such currents can exist at all */
#include "search/symmetry_space.h"

#include <string.h>

#include "base/progress.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"
#include "integrals/symmetry.h"

enum { highest = 2, most_products = 150, most_nodes = 300000 };

typedef struct {
    nh_arena *arena;
    const nh_model *o;
    nh_dag *d;
    const nh_options *options;
    const nh_bracket_fields *fields;
    size_t count, *degree; /* of the currents; SIZE_MAX: above the highest, or no polynomial */
    const nh_named_current *current;
    nh_ex *symbol; /* their names */
    nh_symmetry_space *out;
    bool autonomous; /* nothing depends on t, and d/dt is in the canonical distribution */
    size_t columns;  /* products that are linearly independent */
    nh_ex value[most_products], name[most_products];
} space;

/* ---- products of currents ---- */

/* The degree in the velocities: behind it the derivatives by s of Phi(t, q, w + s c) vanish, for all c. */
static size_t degree_of(const space *x, nh_ex phi)
{
    nh_dag *d = x->d;
    nh_ex s = nh_symbol_fresh(d, "a step"), *moved = nh_alloc_array(x->o->n + 1, sizeof *moved);
    for (size_t i = 0; i < x->o->n; i++)
        moved[i] = nh_add(d, x->o->chart->w[i], nh_mul(d, s, nh_symbol_fresh(d, "a direction")));
    nh_ex e = nh_substitute(d, phi, x->o->n, x->o->chart->w, moved);
    size_t degree = SIZE_MAX;
    for (size_t k = 0; k <= highest && degree == SIZE_MAX; k++) {
        e = nh_diff(d, e, s);
        if (nh_normal_is_zero(d, e, 0) == NH_ZERO) degree = k;
    }
    nh_free(moved);
    return degree;
}

/* A further product, with its name in the currents' names. */
static void put(space *x, nh_ex value, nh_ex name)
{
    x->out->left_out += x->columns == most_products;
    if (x->columns == most_products) return;
    x->value[x->columns] = value;
    x->name[x->columns++] = name;
}

/* 1, the currents, then products of two of them of the highest degree at most. */
static void list_products(space *x)
{
    nh_dag *d = x->d;
    put(x, nh_int(d, 1), nh_int(d, 1));
    for (size_t i = 0; i < x->count; i++) {
        x->symbol[i] = nh_symbol_fresh(d, x->current[i].name);
        put(x, x->current[i].phi, x->symbol[i]);
    }
    for (size_t i = 0; i < x->count; i++)
        for (size_t j = i; j < x->count; j++)
            if (x->degree[i] <= highest && x->degree[j] <= highest && x->degree[i] + x->degree[j] <= highest)
                put(x, nh_mul(d, x->current[i].phi, x->current[j].phi), nh_mul(d, x->symbol[i], x->symbol[j]));
}

nh_relation_space *nh_symmetry_space_relations(nh_arena *arena, const nh_model *model, const nh_options *options,
                                               size_t columns, size_t rows, const nh_ex *entry)
{
    nh_relation_columns q = {.dag = model->dag,
                             .columns = columns,
                             .rows = rows,
                             .entry = entry,
                             .variables = 1 + model->m + model->n,
                             .variable = model->chart->symbol,
                             .parameters = model->system->parameters,
                             .parameter = model->parameter,
                             .max_terms = (size_t)options->proof_terms};
    return nh_relation_space_of(arena, &q);
}

static nh_relation_space *relations(const space *x, size_t rows, const nh_ex *entry)
{
    return nh_symmetry_space_relations(x->arena, x->o, x->options, x->columns, rows, entry);
}

/* The last column of a relation. */
static size_t lead(const space *x, const nh_ex *c)
{
    size_t j = x->columns;
    while (j-- > 0)
        if (!nh_is_zero(x->d, c[j])) return j;
    return 0;
}

/* The relations that are no combinations of others. */
static bool make_independent(space *x, nh_symmetry_space *out)
{
    nh_relation_space *r = relations(x, 1, x->value);
    out->obstacle = r->obstacle;
    out->sure &= r->proved == r->bound;
    bool gone[most_products] = {false};
    for (size_t i = 0; i < r->proved; i++) gone[lead(x, r->coefficient + i * x->columns)] = true;
    size_t kept = 0;
    for (size_t j = 0; j < x->columns; j++)
        if (!gone[j]) x->value[kept] = x->value[j], x->name[kept++] = x->name[j];
    x->columns = kept;
    return !out->obstacle;
}

/* ---- conditions ---- */

static bool is_autonomous(const nh_submanifold *s)
{
    const nh_model *model = s->model;
    bool good = !nh_depends(model->dag, model->E, model->system->t);
    for (size_t r = 0; r < model->m && good; r++)
        good = !nh_depends(model->dag, model->rho[r], model->system->t) &&
               !nh_depends(model->dag, model->p[r], model->system->t);
    for (size_t i = 0; i < model->n && good; i++) good = !nh_depends(model->dag, model->a[i], model->system->t);
    for (size_t a = 0; a < model->k && good; a++)
        good = nh_normal_is_zero(model->dag, s->form[a * (1 + model->m)], 0) == NH_ZERO;
    return good;
}

static bool all_vanish(const space *x, size_t n, const nh_ex *e)
{
    for (size_t i = 0; i < n; i++)
        if (!nh_is_zero(x->d, e[i]) && nh_normal_is_zero(x->d, e[i], (size_t)x->options->proof_terms) != NH_ZERO)
            return false;
    return true;
}

/* Z^0 and Z^s of a current. */
static void components(const space *x, nh_ex phi, nh_ex *out)
{
    const nh_model *o = x->o;
    nh_dag *d = x->d;
    nh_ex *zeta = nh_alloc_array(o->n + 1, sizeof *zeta), rest = phi;
    for (size_t i = 0; i < o->n; i++) zeta[i] = nh_model_Y(o, i, phi);
    nh_lu_solve(o->M_lu, zeta, zeta);
    for (size_t i = 0; i < o->n; i++) rest = nh_sub(d, rest, nh_mul(d, o->pbar[i], zeta[i]));
    out[0] = nh_div(d, rest, o->Lbar);
    for (size_t s = 0; s < o->m; s++) {
        out[1 + s] = nh_mul(d, o->rho[s], out[0]);
        for (size_t i = 0; i < o->n; i++) out[1 + s] = nh_add(d, out[1 + s], nh_mul(d, o->R[s * o->n + i], zeta[i]));
    }
    nh_free(zeta);
}

static size_t rows_of(const space *x, nh_space_kind kind)
{
    size_t projectable = (1 + x->o->m) * x->o->n;
    return kind == NH_SPACE_INSIDE        ? x->fields->across
           : kind == NH_SPACE_CASE1       ? x->fields->all
           : kind == NH_SPACE_PROJECTABLE ? projectable
                                          : x->fields->all + projectable;
}

/* Is the field of -E d/dt, because d/dt lies in the canonical distribution?  [Gamma, d/dt] = 0 where nothing depends on
 * t.  For long formulas only this proof is short. */
static bool is_translation(const space *x, nh_ex phi)
{
    bool energy = false;
    for (size_t i = 0; i < x->count && !energy; i++) energy = x->current[i].energy && x->current[i].phi == phi;
    return energy && x->autonomous;
}

/* The expressions that vanish for a current of a kind. */
static void conditions(const space *x, nh_space_kind kind, nh_ex phi, nh_ex *out)
{
    const nh_bracket_fields *b = x->fields;
    const nh_model *model = x->o;
    if (is_translation(x, phi)) {
        for (size_t i = rows_of(x, kind); i-- > 0;) out[i] = nh_int(x->d, 0);
        return;
    }
    if (kind == NH_SPACE_INSIDE)
        for (size_t a = 0; a < b->across; a++) *out++ = nh_bracket_fields_apply(model, b->U + a * b->width, phi);
    if (kind == NH_SPACE_CASE1 || kind == NH_SPACE_BEST)
        for (size_t c = 0; c < b->all; c++) *out++ = nh_bracket_fields_apply(model, b->V + c * b->width, phi);
    if (kind != NH_SPACE_PROJECTABLE && kind != NH_SPACE_BEST) return;
    nh_ex *Z = nh_alloc_array(1 + model->m, sizeof *Z);
    components(x, phi, Z);
    for (size_t s = 0; s <= model->m; s++)
        for (size_t i = 0; i < model->n; i++) *out++ = nh_model_Y(model, i, Z[s]);
    nh_free(Z);
}

/* The currents of a kind, as relations; all of them where there is no condition; NULL where formulas are too long. */
static nh_relation_space *subspace(const space *x, nh_space_kind kind)
{
    size_t rows = rows_of(x, kind), nodes = 0;
    nh_ex *entry = nh_alloc_array(x->columns * (rows + 1), sizeof *entry);
    for (size_t j = 0; j < x->columns; j++) conditions(x, kind, x->value[j], entry + j * rows);
    for (size_t e = 0; e < x->columns * rows && nodes < most_nodes; e++) nodes += nh_node_count(x->d, entry[e]);
    if (!rows) entry[0] = nh_int(x->d, 0);
    for (size_t j = 0; j < x->columns && !rows; j++) entry[j] = nh_int(x->d, 0);
    nh_relation_space *r = nodes < most_nodes && !nh_late() ? relations(x, rows ? rows : 1, entry) : NULL;
    nh_free(entry);
    return r;
}

/* ---- a basis ---- */

/* sum_j c_j of_j over the columns. */
static nh_ex combined(const space *x, const nh_ex *c, const nh_ex *of)
{
    nh_ex sum = nh_int(x->d, 0);
    for (size_t j = 0; j < x->columns; j++)
        if (!nh_is_zero(x->d, c[j])) sum = nh_add(x->d, sum, nh_mul(x->d, c[j], of[j]));
    return sum;
}

/* Z^0 and Z^s of a current, simplified. */
static const nh_field *projected(const space *x, nh_ex phi)
{
    const nh_model *o = x->o;
    nh_field *f = nh_arena_alloc(x->arena, sizeof *f);
    nh_ex *along = nh_arena_alloc(x->arena, o->m * sizeof *along), *zeta = nh_alloc_array(o->n + 1, sizeof *zeta);
    *f = (nh_field){nh_symmetry_components(o, phi, zeta), along, NULL};
    for (size_t s = 0; s < o->m; s++) {
        nh_ex e = nh_mul(x->d, o->rho[s], f->time);
        for (size_t i = 0; i < o->n; i++) e = nh_add(x->d, e, nh_mul(x->d, o->R[s * o->n + i], zeta[i]));
        along[s] = nh_simplify_short(x->d, e, 0);
    }
    nh_free(zeta);
    return f;
}

/* Of nested spaces in echelon form the last columns are nested as well: those that are new complete a basis. */
static void add_members(const space *x, nh_symmetry_space *out, size_t n, const nh_ex *coefficient, const bool *kinds,
                        bool *taken)
{
    for (size_t i = 0; i < n; i++) {
        const nh_ex *c = coefficient + i * x->columns;
        size_t last = lead(x, c);
        if (taken[last]) continue;
        taken[last] = true;
        nh_space_member *m = &out->member[out->dimension++];
        *m = (nh_space_member){.combination = combined(x, c, x->name), .phi = combined(x, c, x->value)};
        memcpy(m->in, kinds, NH_SPACES * sizeof *kinds);
        if (m->in[NH_SPACE_PROJECTABLE]) m->field = projected(x, m->phi);
    }
}

/* The subspaces from the smallest on, then all products: each adds to the basis what it has beyond those before it. */
static void make_basis(const space *x, nh_symmetry_space *out)
{
    static const bool kinds[NH_SPACES][NH_SPACES] = {[NH_SPACE_BEST] = {true, true, true, true},
                                                     [NH_SPACE_CASE1] = {false, true, false, true},
                                                     [NH_SPACE_PROJECTABLE] = {false, false, true, false},
                                                     [NH_SPACE_INSIDE] = {false, false, false, true}};
    static const bool none[NH_SPACES] = {false};
    bool taken[most_products] = {false};
    nh_ex unit[most_products];
    out->member = nh_arena_alloc(x->arena, (x->columns + 1) * sizeof *out->member);
    for (nh_space_kind k = 0; k < NH_SPACES; k++) {
        nh_relation_space *r = subspace(x, k);
        if (!r || r->obstacle) {
            out->obstacle = r ? r->obstacle : "formulas that are too long";
            return;
        }
        out->of[k] = r->proved;
        out->sure &= r->proved == r->bound;
        add_members(x, out, r->proved, r->coefficient, kinds[k], taken);
    }
    for (size_t j = 0; j < x->columns; j++) {
        for (size_t i = 0; i < x->columns; i++) unit[i] = nh_int(x->d, i == j);
        add_members(x, out, 1, unit, none, taken);
    }
}

/* ---- bounds ---- */

typedef struct {
    size_t n, width;
    const nh_ex *field;                            /* the fields, without Gamma */
    nh_ex phi[most_products], name[most_products]; /* independent currents that they annihilate */
    size_t count;
} candidates;

static bool annihilated(const space *x, const candidates *b, nh_ex phi)
{
    if (is_translation(x, phi)) return true;
    for (size_t a = 0; a < b->n; a++) {
        nh_ex e = nh_bracket_fields_apply(x->o, b->field + a * b->width, phi);
        if (!nh_is_zero(x->d, e) && nh_normal_is_zero(x->d, e, (size_t)x->options->proof_terms) != NH_ZERO)
            return false;
    }
    return true;
}

/* Keeps a function whose gradient does not depend on those before it. */
static void offer(const space *x, candidates *b, nh_ex phi, nh_ex name)
{
    if (b->count == most_products || nh_kind_of(x->d, name) == NH_NUMBER || !annihilated(x, b, phi)) return;
    b->phi[b->count] = phi;
    b->name[b->count] = name;
    nh_closure c = nh_closure_of(x->o, 0, NULL, b->count + 1, b->phi);
    b->count += !c.obstacle && c.known == b->count + 1;
}

/* Products of powers: sum_i c_i field(Phi_i)/Phi_i = 0. */
static void offer_powers(const space *x, candidates *b)
{
    nh_dag *d = x->d;
    space logarithms = *x;
    if (!b->n || x->count < 2 || x->count >= most_products) return;
    nh_ex *entry = nh_alloc_array(x->count * b->n, sizeof *entry);
    for (size_t i = 0; i < x->count; i++)
        for (size_t a = 0; a < b->n; a++)
            entry[i * b->n + a] =
                nh_div(d, nh_bracket_fields_apply(x->o, b->field + a * b->width, x->current[i].phi), x->current[i].phi);
    logarithms.columns = x->count;
    nh_relation_space *r = relations(&logarithms, b->n, entry);
    for (size_t k = 0; k < r->proved; k++) {
        nh_ex phi = nh_int(d, 1), name = phi;
        for (size_t i = 0; i < x->count; i++) {
            phi = nh_mul(d, phi, nh_pow(d, x->current[i].phi, r->coefficient[k * x->count + i]));
            name = nh_mul(d, name, nh_pow(d, x->symbol[i], r->coefficient[k * x->count + i]));
        }
        offer(x, b, phi, name);
    }
    nh_free(entry);
}

/* The number of independent currents that Gamma and `n` fields annihilate, and those functions of the found currents
 * that they annihilate. */
static nh_space_bound bound(const space *x, size_t n, const nh_ex *field)
{
    candidates *b = nh_alloc(sizeof *b);
    *b = (candidates){.n = n, .width = x->fields->width, .field = field};
    nh_ex *all = nh_alloc_array((1 + n) * b->width, sizeof *all);
    memcpy(all, x->fields->gamma, b->width * sizeof *all);
    memcpy(all + b->width, field, n * b->width * sizeof *all);
    for (size_t i = 0; i < x->count; i++) offer(x, b, x->current[i].phi, x->symbol[i]);
    for (size_t i = 0; i < x->out->dimension; i++) offer(x, b, x->out->member[i].phi, x->out->member[i].combination);
    offer_powers(x, b);
    nh_space_bound out = {.closure = nh_closure_of(x->o, 1 + n, all, b->count, b->phi),
                          .count = b->count,
                          .name = nh_arena_alloc(x->arena, (b->count + 1) * sizeof *out.name)};
    memcpy(out.name, b->name, b->count * sizeof *b->name);
    nh_free(all);
    nh_free(b);
    return out;
}

nh_symmetry_space *nh_symmetry_space_of(nh_arena *arena, const nh_submanifold *s, size_t count,
                                        const nh_named_current *current, size_t counted, const nh_options *options)
{
    nh_symmetry_space *out = nh_arena_alloc(arena, sizeof *out);
    *out = (nh_symmetry_space){.degree = highest, .sure = true, .counted = counted};
    space *x = nh_alloc(sizeof *x);
    *x = (space){.arena = arena,
                 .o = s->model,
                 .d = s->model->dag,
                 .options = options,
                 .fields = nh_bracket_fields_of(arena, s),
                 .count = count,
                 .current = current,
                 .out = out,
                 .degree = nh_alloc_array(count + 1, sizeof(size_t)),
                 .symbol = nh_alloc_array(count + 1, sizeof(nh_ex))};
    for (size_t i = 0; i < count; i++) out->others += (x->degree[i] = degree_of(x, current[i].phi)) == SIZE_MAX;
    x->autonomous = is_autonomous(s);
    list_products(x);
    if (x->o->chart->implicit) out->obstacle = "velocities that are given implicitly";
    else if (nh_normal_is_zero(x->d, x->o->Lbar, 0) == NH_ZERO)
        out->obstacle = "a Lagrangian that vanishes on the constraint submanifold";
    else if (make_independent(x, out)) make_basis(x, out);
    out->all_inside = all_vanish(x, x->fields->across * x->fields->width, x->fields->U);
    out->all_case1 = all_vanish(x, x->fields->all * x->fields->width, x->fields->V);
    if (!out->all_inside) out->inside = bound(x, x->fields->across, x->fields->U);
    if (!out->all_case1) out->case1 = bound(x, x->fields->all, x->fields->V);
    nh_free(x->symbol);
    nh_free(x->degree);
    nh_free(x);
    return out;
}
