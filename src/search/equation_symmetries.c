/* equation_symmetries: an ansatz for the fields, and its exact solution. [docs/method.md, sec. 5]
 *
 *     list_words, list_columns    monomials of the letters times the component d/dt or d/dq^s (times 1 or w^i)
 *     prolonged                   rates r^s = Gamma(S^s) - rho^s Gamma(S^0) - S(rho^s), W from r = R W;
 *                                 rows: phi^a_s r^s (k) and Gamma(W^i) - a^i Gamma(S^0) - S(a^i) (n)
 *     solve                       the combinations of the columns whose rows vanish (exact/relation_space.h)
 *     keep_new                    dynamical ones that are no point symmetries times currents
 *     act                         S(Phi) of every current: zero, a combination, a function of them, or a new current */
#include "search/equation_symmetries.h"

#include <string.h>

#include "base/progress.h"
#include "exact/normal.h"
#include "exact/relation_express.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"

enum { most_letters = 24, most_words = 300, most_columns = 360, most_nodes = 400000, most_dynamical = 12 };

typedef struct {
    nh_arena *arena;
    const nh_submanifold *s;
    const nh_model *o;
    nh_dag *d;
    const nh_options *options;
    nh_lu *lu; /* R^T R, of quasi-velocities */
    size_t words;
    nh_ex word[most_words];
    size_t columns, rows;
    nh_ex *space; /* columns x (1 + m): the fields of the ansatz */
    nh_equation_symmetries *out;
} search;

/* ---- the ansatz ---- */

static bool moves_with(const nh_model *model, nh_ex symbol)
{
    for (size_t s = 0; s < model->m; s++)
        if (nh_depends(model->dag, model->rho[s], symbol)) return true;
    for (size_t i = 0; i < model->n; i++)
        if (nh_depends(model->dag, model->a[i], symbol)) return true;
    return false;
}

/* t; lengths; sines and cosines of the angles on which the equations of motion depend. */
static void list_letters(search *x)
{
    nh_equation_symmetries *out = x->out;
    out->letter = nh_arena_alloc(x->arena, (1 + 2 * x->o->m) * sizeof *out->letter);
    out->letter[out->letters++] = x->o->system->t;
    for (size_t s = 0; s < x->o->m; s++) {
        const nh_coordinate *c = &x->o->system->coordinate[s];
        if (c->type != NH_ANGLE) out->letter[out->letters++] = c->q;
        if (c->type != NH_ANGLE || !moves_with(x->o, c->q)) continue;
        out->letter[out->letters++] = nh_call(x->d, NH_SIN, c->q);
        out->letter[out->letters++] = nh_call(x->d, NH_COS, c->q);
    }
}

static bool is_cosine(const nh_dag *d, nh_ex e)
{
    return nh_kind_of(d, e) == NH_FUNCTION && nh_function_of(d, e) == NH_COS;
}

/* Monomials of the letters; sin^2 stands for cos^2. */
static void list_words(search *x, size_t degree)
{
    const nh_equation_symmetries *out = x->out;
    x->words = 0;
    x->word[x->words++] = nh_int(x->d, 1);
    for (size_t i = 0; i < out->letters && x->words < most_words; i++) x->word[x->words++] = out->letter[i];
    for (size_t i = 0; i < out->letters && degree > 1; i++)
        for (size_t j = i; j < out->letters && x->words < most_words; j++)
            if (i != j || !is_cosine(x->d, out->letter[i]))
                x->word[x->words++] = nh_mul(x->d, out->letter[i], out->letter[j]);
}

/* The field e d/dx of one component x: t, or a coordinate. */
static void add_column(search *x, size_t component, nh_ex e)
{
    nh_ex *field = x->space + x->columns++ * (1 + x->o->m);
    for (size_t s = 0; s <= x->o->m; s++) field[s] = s == component ? e : nh_int(x->d, 0);
}

/* Sorts the simplest functions first: the reduced form of each symmetry then has the simplest terms. */
static void list_columns(search *x, bool dynamical)
{
    size_t m = x->o->m, factors = dynamical ? 1 + x->o->n : 1;
    x->columns = 0;
    x->space = nh_arena_alloc(x->arena, x->words * (1 + m) * factors * (1 + m) * sizeof *x->space);
    for (size_t b = 0; b < x->words; b++)
        for (size_t f = 0; f < factors; f++)
            for (size_t s = dynamical; s <= m; s++)
                add_column(x, s, f ? nh_mul(x->d, x->word[b], x->o->chart->w[f - 1]) : x->word[b]);
}

/* ---- the equations ---- */

/* W from the rates r^s = R^s_i W^i: those of the independent coordinates, or (R^T R)^-1 R^T r. */
static void prolong(const search *x, const nh_ex *rate, nh_ex *W)
{
    const nh_model *o = x->o;
    for (size_t i = 0; i < o->n && !x->lu; i++) W[i] = rate[o->chart->free[i]];
    if (!x->lu) return;
    for (size_t i = 0; i < o->n; i++) {
        W[i] = nh_int(x->d, 0);
        for (size_t s = 0; s < o->m; s++) W[i] = nh_add(x->d, W[i], nh_mul(x->d, o->R[s * o->n + i], rate[s]));
    }
    nh_lu_solve(x->lu, W, W);
}

/* W of a field, and, where they are wanted, k + n expressions that vanish for a symmetry. */
static void prolonged(const search *x, const nh_ex *field, nh_ex *W, nh_ex *equation)
{
    const nh_model *o = x->o;
    nh_dag *d = x->d;
    nh_ex *rate = nh_alloc_array(o->m + 1, sizeof *rate), stretch = nh_model_gamma(o, field[0]);
    nh_field f = {field[0], (nh_ex *)field + 1, W};
    for (size_t i = 0; i < o->n; i++) W[i] = nh_int(d, 0);
    for (size_t s = 0; s < o->m; s++)
        rate[s] = nh_sub(d, nh_sub(d, nh_model_gamma(o, field[1 + s]), nh_mul(d, stretch, o->rho[s])),
                         nh_model_along(o, &f, o->rho[s]));
    prolong(x, rate, W);
    for (size_t a = 0; a < o->k && equation; a++) {
        equation[a] = nh_int(d, 0);
        for (size_t s = 0; s < o->m; s++)
            equation[a] = nh_add(d, equation[a], nh_mul(d, x->s->form[a * (1 + o->m) + 1 + s], rate[s]));
    }
    for (size_t i = 0; i < o->n && equation; i++)
        equation[o->k + i] =
            nh_sub(d, nh_sub(d, nh_model_gamma(o, W[i]), nh_mul(d, stretch, o->a[i])), nh_model_along(o, &f, o->a[i]));
    nh_free(rate);
}

static nh_relation_space *relations(const search *x, size_t columns, size_t rows, const nh_ex *entry)
{
    return nh_symmetry_space_relations(x->arena, x->o, x->options, columns, rows, entry);
}

/* The symmetries of the ansatz; NULL where formulas are too long. */
static nh_relation_space *solve(search *x)
{
    size_t m = x->o->m, nodes = 0;
    nh_ex *entry = nh_alloc_array(x->columns * x->rows + 1, sizeof *entry), *W = nh_alloc_array(x->o->n + 1, sizeof *W);
    for (size_t j = 0; j < x->columns && nodes < most_nodes; j++) {
        prolonged(x, x->space + j * (1 + m), W, entry + j * x->rows);
        for (size_t i = 0; i < x->rows; i++) nodes += nh_node_count(x->d, entry[j * x->rows + i]);
    }
    nh_relation_space *r = nodes < most_nodes && !nh_late() ? relations(x, x->columns, x->rows, entry) : NULL;
    nh_free(W);
    nh_free(entry);
    return r;
}

static nh_equation_symmetry field_of(const search *x, const nh_ex *c, bool dynamical)
{
    size_t m = x->o->m;
    nh_ex *sum = nh_arena_alloc(x->arena, (1 + m) * sizeof *sum);
    for (size_t s = 0; s <= m; s++) {
        sum[s] = nh_int(x->d, 0);
        for (size_t j = 0; j < x->columns; j++)
            if (!nh_is_zero(x->d, c[j])) sum[s] = nh_add(x->d, sum[s], nh_mul(x->d, c[j], x->space[j * (1 + m) + s]));
        sum[s] = nh_simplify_short(x->d, sum[s], 0);
    }
    return (nh_equation_symmetry){sum[0], sum + 1, dynamical};
}

/* ---- point symmetries ---- */

/* Point symmetries, with words of the highest degree that leaves few enough columns. */
static bool find_points(search *x)
{
    nh_equation_symmetries *out = x->out;
    for (out->degree = 2; out->degree > 0; out->degree--) {
        list_words(x, out->degree);
        if (x->words < most_words && x->words * (1 + x->o->m) <= most_columns) break;
    }
    if (!out->degree) return out->obstacle = "an ansatz with too many terms", false;
    list_columns(x, false);
    out->columns = x->columns;
    nh_relation_space *r = solve(x);
    out->obstacle = !r ? "formulas that are too long" : r->obstacle;
    if (out->obstacle) return false;
    out->sure = r->proved == r->bound;
    out->item = nh_arena_alloc(x->arena, (r->proved + most_dynamical + 1) * sizeof *out->item);
    for (size_t i = 0; i < r->proved; i++)
        out->item[out->points++] = field_of(x, r->coefficient + i * x->columns, false);
    return true;
}

/* ---- dynamical symmetries ---- */

/* factor (S^r - rho^r S^0), m components: what of a field is no multiple of Gamma. */
static void put_evolutionary(const search *x, nh_ex **at, const nh_equation_symmetry *s, nh_ex factor)
{
    for (size_t r = 0; r < x->o->m; r++)
        *(*at)++ = nh_mul(x->d, factor, nh_sub(x->d, s->space[r], nh_mul(x->d, x->o->rho[r], s->time)));
}

/* The dynamical symmetries that are no combinations of point symmetries, of these times currents, and of earlier
 * ones. */
static void keep_new(search *x, const nh_relation_space *r, size_t count, const nh_named_current *current)
{
    nh_equation_symmetries *out = x->out;
    size_t m = x->o->m, known = out->points * (1 + count), columns = known + r->proved;
    nh_equation_symmetry *found = nh_alloc_array(r->proved + 1, sizeof *found);
    nh_ex *entry = nh_alloc_array(columns * m + 1, sizeof *entry), *at = entry;
    bool *old = nh_alloc_array(columns + 1, sizeof *old);
    for (size_t c = 0; c <= count; c++)
        for (size_t i = 0; i < out->points; i++)
            put_evolutionary(x, &at, &out->item[i], c ? current[c - 1].phi : nh_int(x->d, 1));
    for (size_t i = 0; i < r->proved; i++) {
        found[i] = field_of(x, r->coefficient + i * x->columns, true);
        put_evolutionary(x, &at, &found[i], nh_int(x->d, 1));
    }
    nh_relation_space *dependent = relations(x, columns, m, entry);
    for (size_t i = 0; i < dependent->proved; i++) {
        size_t last = columns;
        while (last-- > 0 && nh_is_zero(x->d, dependent->coefficient[i * columns + last])) continue;
        old[last] = true;
    }
    for (size_t i = 0; i < r->proved && !dependent->obstacle && dependent->proved == dependent->bound &&
                       out->dynamical < most_dynamical;
         i++)
        if (!old[known + i]) out->item[out->points + out->dynamical++] = found[i];
    nh_free(old);
    nh_free(entry);
    nh_free(found);
}

static void find_dynamical(search *x, size_t count, const nh_named_current *current)
{
    size_t degree = 2;
    for (; degree > 0; degree--) {
        list_words(x, degree);
        if (x->words < most_words && x->words * x->o->m * (1 + x->o->n) <= most_columns) break;
    }
    if (!degree) return;
    list_columns(x, true);
    nh_relation_space *r = solve(x);
    if (r && !r->obstacle && r->proved) keep_new(x, r, count, current);
}

/* ---- S(Phi) of the currents ---- */

static nh_ex derivative(const search *x, const nh_equation_symmetry *s, nh_ex phi)
{
    nh_ex *field = nh_alloc_array(1 + x->o->m, sizeof *field), *W = nh_alloc_array(x->o->n + 1, sizeof *W);
    field[0] = s->time;
    memcpy(field + 1, s->space, x->o->m * sizeof *field);
    prolonged(x, field, W, NULL);
    nh_field f = {field[0], field + 1, W};
    nh_ex e = nh_simplify_short(x->d, nh_model_along(x->o, &f, phi), 0);
    nh_free(W);
    nh_free(field);
    return e;
}

/* S(Phi) in the basis of the space of currents. */
static nh_ex combination(const search *x, const nh_symmetry_space *space, nh_ex e)
{
    size_t n = space->dimension;
    nh_ex *all = nh_alloc_array(n + 1, sizeof *all), *c = nh_alloc_array(n + 1, sizeof *c), sum = 0;
    for (size_t i = 0; i < n; i++) all[i] = space->member[i].phi;
    all[n] = e;
    if (n && nh_relation_express(x->d, n + 1, all, x->o->system->parameters, x->o->parameter,
                                 (size_t)x->options->proof_terms, c)) {
        sum = nh_int(x->d, 0);
        for (size_t i = 0; i < n; i++) sum = nh_add(x->d, sum, nh_mul(x->d, c[i], space->member[i].combination));
    }
    nh_free(c);
    nh_free(all);
    return sum;
}

/* Is it a function of the currents, by the ranks of gradients?  A larger rank is a proof that it is not. */
static nh_action_answer dependence(const search *x, size_t count, const nh_named_current *current, nh_ex e)
{
    nh_ex *all = nh_alloc_array(count + 1, sizeof *all);
    for (size_t i = 0; i < count; i++) all[i] = current[i].phi;
    all[count] = e;
    nh_closure before = nh_closure_of(x->o, 0, NULL, count, all), after = nh_closure_of(x->o, 0, NULL, count + 1, all);
    nh_free(all);
    return before.obstacle || after.obstacle ? NH_ACTION_UNDECIDED
           : after.known > before.known      ? NH_ACTION_INDEPENDENT
                                             : NH_ACTION_DEPENDENT;
}

static void act(search *x, size_t count, const nh_named_current *current, const nh_symmetry_space *space)
{
    nh_equation_symmetries *out = x->out;
    size_t all = out->points + out->dynamical;
    out->action = nh_arena_alloc(x->arena, (all * count + 1) * sizeof *out->action);
    for (size_t i = 0; i < all; i++)
        for (size_t k = 0; k < count && !nh_late(); k++) {
            nh_ex e = derivative(x, &out->item[i], current[k].phi);
            if (nh_is_zero(x->d, e) || nh_normal_is_zero(x->d, e, (size_t)x->options->proof_terms) == NH_ZERO) continue;
            nh_ex sum = combination(x, space, e);
            out->action[out->actions++] =
                (nh_symmetry_action){i, k, e, sum, sum ? NH_ACTION_DEPENDENT : dependence(x, count, current, e)};
        }
}

/* ---- the whole ---- */

static void prepare(search *x)
{
    const nh_model *model = x->o;
    x->rows = model->k + model->n;
    list_letters(x);
    if (!model->chart->quasi) return;
    nh_ex *square = nh_alloc_array(model->n * model->n + 1, sizeof *square);
    for (size_t i = 0; i < model->n * model->n; i++) {
        square[i] = nh_int(x->d, 0);
        for (size_t s = 0; s < model->m; s++)
            square[i] =
                nh_add(x->d, square[i],
                       nh_mul(x->d, model->R[s * model->n + i / model->n], model->R[s * model->n + i % model->n]));
    }
    x->lu = nh_lu_create(x->d, model->n, square, nh_chart_pivot_score, model->chart, NULL);
    if (!x->lu) x->out->obstacle = "quasi-velocities that are not independent";
    nh_free(square);
}

nh_equation_symmetries *nh_equation_symmetries_of(nh_arena *arena, const nh_submanifold *s, size_t count,
                                                  const nh_named_current *current, const nh_symmetry_space *space,
                                                  const nh_options *options)
{
    nh_equation_symmetries *out = nh_arena_alloc(arena, sizeof *out);
    *out = (nh_equation_symmetries){0};
    search *x = nh_alloc(sizeof *x);
    *x = (search){.arena = arena, .s = s, .o = s->model, .d = s->model->dag, .options = options, .out = out};
    if (x->o->chart->implicit) out->obstacle = "velocities that are given implicitly";
    else prepare(x);
    if (!out->obstacle && find_points(x)) {
        find_dynamical(x, count, current);
        act(x, count, current, space);
    }
    nh_lu_free(x->lu);
    nh_free(x);
    return out;
}
