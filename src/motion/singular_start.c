#include "motion/singular_start.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "base/text.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/measure.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/print.h"
#include "graph/terms.h"
#include "motion/dynamics_internal.h"

enum { most_named = 6, most_shown = 60 };

typedef struct {
    const nh_model *model;
    const nh_state *state;
    double *v; /* m; those that were not given are zero */
} place;

/* ---- a divisor or a root that vanishes ---- */

typedef struct {
    size_t n;
    nh_ex *e; /* each once */
} list;

static void list_put(list *l, nh_ex e)
{
    for (size_t i = 0; i < l->n; i++)
        if (l->e[i] == e) return;
    l->e = nh_realloc_array(l->e, l->n + 1, sizeof *l->e);
    l->e[l->n++] = e;
}

/* The bases of negative and fractional powers and the arguments of logarithms in e. */
static void gather(nh_dag *d, nh_ex e, bool *seen, list *bases)
{
    nh_kind kind = nh_kind_of(d, e);
    if (kind == NH_NUMBER || kind == NH_SYMBOL || seen[e]) return;
    seen[e] = true;
    for (size_t i = 0; i < nh_arity(d, e); i++) {
        nh_ex child = nh_child(d, e, i), x = kind == NH_PRODUCT ? nh_exponent_of(d, e, i) : nh_int(d, 1);
        nh_num number = nh_kind_of(d, x) == NH_NUMBER ? nh_number_of(d, x) : nh_num_int(-1);
        double power = nh_num_value(number);
        bool root = power < 2 && power != round(power);
        if (power < 0 || root || (kind == NH_FUNCTION && nh_function_of(d, e) == NH_LOG)) list_put(bases, child);
        gather(d, child, seen, bases);
    }
}

void nh_singular_start_values(const nh_model *model, const nh_state *state, size_t n, const nh_ex *e, double *value)
{
    const nh_system *system = model->system;
    size_t m = model->m, extra = model->chart->quasi ? model->n : 0, inputs = 1 + 2 * m + extra;
    nh_ex *in = nh_alloc_array(inputs, sizeof *in);
    double *z = nh_alloc_array(inputs, sizeof *z);
    in[0] = system->t, z[0] = state->t;
    for (size_t s = 0; s < m; s++) {
        in[1 + s] = system->coordinate[s].q, z[1 + s] = state->q[s];
        in[1 + m + s] = system->coordinate[s].v, z[1 + m + s] = state->v[s];
    }
    for (size_t i = 0; i < extra; i++) in[1 + 2 * m + i] = model->chart->w[i];
    nh_tape *tape =
        nh_tape_create(model->dag, inputs, in, n, e, system->parameters, model->parameter, model->parameter_value);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, z, value);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(z);
    nh_free(in);
}

/* Velocities that were not given are zero. */
static void values_at(const place *p, size_t n, const nh_ex *e, double *value)
{
    nh_singular_start_values(p->model, &(nh_state){.t = p->state->t, .q = p->state->q, .v = p->v}, n, e, value);
}

/* "x = y = 0", "t = 0": the symbols that are named, with their values. */
static void put_values(const place *p, const bool *named, nh_text *out)
{
    const nh_system *system = p->model->system;
    size_t m = p->model->m, count = 0;
    double last = NAN;
    for (size_t i = 0; i < 1 + 2 * m && count < most_named; i++) {
        if (!named[i]) continue;
        double value = i == 0 ? p->state->t : i <= m ? p->state->q[i - 1] : p->v[i - 1 - m];
        nh_ex symbol = i == 0 ? system->t : i <= m ? system->coordinate[i - 1].q : system->coordinate[i - 1 - m].v;
        if (count++) {
            if (value == last) nh_text_addf(out, " = ");
            else nh_text_addf(out, " = %.6g, ", last);
        }
        nh_text_addf(out, "%s", nh_name_of(p->model->dag, symbol));
        last = value;
    }
    if (count) nh_text_addf(out, " = %.6g", last);
}

static void name_symbols(const place *p, nh_ex e, bool *named)
{
    const nh_model *model = p->model;
    named[0] = nh_depends(model->dag, e, model->system->t);
    for (size_t s = 0; s < model->m; s++) {
        named[1 + s] = nh_depends(model->dag, e, model->system->coordinate[s].q);
        named[1 + model->m + s] = nh_depends(model->dag, e, model->system->coordinate[s].v);
    }
}

/* The shortest one that is zero. */
static bool shortest_zero(const place *p, const list *bases, nh_ex *which)
{
    static const double zero = 1e-12;
    nh_dag *d = p->model->dag;
    size_t n = bases->n, best = SIZE_MAX;
    nh_ex *e = nh_alloc_array(2 * n + 1, sizeof *e);
    double *x = nh_alloc_array(2 * n + 1, sizeof *x);
    bool *named = nh_alloc_array(1 + 2 * p->model->m, sizeof *named);
    for (size_t i = 0; i < n; i++) e[i] = bases->e[i], e[n + i] = nh_terms_moduli(d, bases->e[i]);
    if (n) values_at(p, 2 * n, e, x);
    for (size_t i = 0; i < n; i++) {
        bool varies = false;
        name_symbols(p, e[i], named);
        for (size_t j = 0; j < 1 + 2 * p->model->m; j++) varies |= named[j];
        if (!varies || !(fabs(x[i]) <= zero * x[n + i]) || nh_complexity(d, e[i]) >= best) continue;
        best = nh_complexity(d, e[i]);
        *which = e[i];
    }
    nh_free(named);
    nh_free(x);
    nh_free(e);
    return best < SIZE_MAX;
}

static bool by_divisor(const place *p, bool *named, nh_text *out)
{
    const nh_model *model = p->model;
    const nh_system *system = model->system;
    size_t m = model->m, n = 0;
    nh_ex *e = nh_alloc_array(1 + 2 * m + model->k + 1, sizeof *e), which = 0;
    e[n++] = system->lagrangian;
    for (size_t s = 0; s < m; s++) e[n++] = system->force[s];
    for (size_t s = 0; s < m && system->quasi; s++) e[n++] = system->quasi_map[s];
    for (size_t a = 0; a < model->k; a++) e[n++] = nh_constraint_without_poles(model, a);
    bool *seen = nh_alloc_array(nh_dag_size(model->dag) + 1, sizeof *seen);
    list bases = {0};
    for (size_t i = 0; i < n; i++) gather(model->dag, e[i], seen, &bases);
    bool found = shortest_zero(p, &bases, &which);
    if (found) {
        char *text = nh_print_string(model->dag, which);
        name_symbols(p, which, named);
        put_values(p, named, out);
        bool symbol = nh_kind_of(model->dag, which) == NH_SYMBOL;
        if (!symbol && strlen(text) <= most_shown) nh_text_addf(out, ": %s = 0", text);
        nh_free(text);
    }
    nh_free(bases.e);
    nh_free(seen);
    nh_free(e);
    return found;
}

/* ---- a position constraint ---- */

static bool by_position(const place *p, nh_text *out)
{
    static const double small = 1e-9;
    const nh_system *system = p->model->system;
    for (size_t a = 0; a < system->constraints; a++) {
        const nh_constraint *c = &system->constraint[a];
        if (!c->position) continue;
        double value[2];
        const nh_ex e[2] = {c->level, nh_terms_moduli(p->model->dag, c->level)};
        values_at(p, 2, e, value);
        if (fabs(value[0]) <= small * value[1]) continue;
        nh_text_addf(out, "the positions are not on `%.120s`: its sides differ by %.6g", c->text ? c->text : "",
                     value[0]);
        return true;
    }
    return false;
}

/* ---- the mass matrix and the constraints ---- */

/* The least singular value of the bordered matrix with a unit diagonal, relative to the largest, and its vector (m +
 * k). */
static double least_value(const place *p, nh_bordered *b, double t, const double *q, const double *v, double *vector)
{
    size_t m = p->model->m, k = p->model->k, n = m + k;
    static const double without_inertia = 1e-9;
    double *K = nh_alloc_array(m * m + m + k * m + 2 * k + 2 * n * n + n + m + 1, sizeof *K), *h = K + m * m,
           *F = h + m, *g = F + k * m, *f = g + k, *matrix = f + k, *vt = matrix + n * n, *sigma = vt + n * n,
           *scale = sigma + n;
    double least = 0, usual = 0;
    bool good = nh_bordered_terms(b, t, q, v, K, h, F, g, f);
    for (size_t s = 0; s < m; s++) usual = fmax(usual, fabs(K[s * (m + 1)]));
    usual = without_inertia * (usual > 0 ? usual : 1);
    for (size_t s = 0; s < m; s++) scale[s] = 1 / sqrt(fmax(fabs(K[s * (m + 1)]), usual));
    for (size_t s = 0; s < m; s++) {
        for (size_t r = 0; r < m; r++) matrix[r + s * n] = K[r + s * m] * scale[r] * scale[s];
        for (size_t a = 0; a < k; a++) matrix[m + a + s * n] = matrix[s + (m + a) * n] = F[a + s * k] * scale[s];
    }
    if (good && nh_svd(n, n, matrix, sigma, NULL, vt)) {
        least = sigma[0] > 0 ? sigma[n - 1] / sigma[0] : 0;
        for (size_t i = 0; i < n; i++) vector[i] = vt[n - 1 + i * n] * (i < m ? scale[i] : 1);
    }
    nh_free(K);
    return least;
}

/* Which entries of the state make the matrix regular when they change alone? */
static void find_cause(const place *p, nh_bordered *b, double least, bool *named)
{
    static const double moved = 0.01, regular = 1e3, rounding = 1e-12;
    size_t m = p->model->m;
    double *z = nh_alloc_array(2 * m + m + p->model->k, sizeof *z), *vector = z + 2 * m;
    for (size_t i = 0; i < 1 + 2 * m; i++) {
        memcpy(z, p->state->q, m * sizeof *z);
        memcpy(z + m, p->v, m * sizeof *z);
        if (i) z[i - 1] += moved * nh_chart_unit(p->model->system, (i - 1) % m);
        double t = p->state->t + (i ? 0 : moved);
        named[i] = least_value(p, b, t, z, z + m, vector) > regular * fmax(least, rounding);
    }
    nh_free(z);
}

static void say_constraints(const nh_system *system, size_t k, const double *row, double part, nh_text *out)
{
    size_t count = 0, last = 0;
    for (size_t a = 0; a < k; a++)
        if (fabs(row[a]) > part) count++, last = a;
    const char *text = system->constraint[last].text;
    if (count == 1 && text)
        nh_text_addf(out, "the coefficients of the velocities in the constraint `%.120s` vanish", text);
    else nh_text_addf(out, "the constraints are not independent of each other there");
}

static bool by_matrix(const place *p, bool *named, nh_text *out)
{
    static const double singular = 1e-11, takes_part = 0.3;
    const nh_system *system = p->model->system;
    size_t m = p->model->m, k = p->model->k;
    double *vector = nh_alloc_array(m + k, sizeof *vector), most = 0, reaction = 0;
    nh_bordered *b = nh_bordered_create(p->model);
    double least = least_value(p, b, p->state->t, p->state->q, p->v, vector);
    bool found = nh_all_finite(m + k, vector) && least < singular;
    if (found) {
        find_cause(p, b, least, named);
        put_values(p, named, out);
        for (size_t s = 0; s < m; s++) most = fmax(most, fabs(vector[s]));
        for (size_t a = 0; a < k; a++) reaction = fmax(reaction, fabs(vector[m + a]));
        if (out->length) nh_text_addf(out, ": ");
        if (reaction > most) say_constraints(system, k, vector + m, takes_part * reaction, out);
        else nh_text_addf(out, "the mass matrix is singular, without inertia in");
        for (size_t s = 0, count = 0; s < m && reaction <= most; s++)
            if (fabs(vector[s]) > takes_part * most)
                nh_text_addf(out, "%s%s", count++ ? ", " : " ", system->coordinate[s].name);
    }
    nh_bordered_free(b);
    nh_free(vector);
    return found;
}

/* ---- the message ---- */

/* The angle that is the only cause. */
static const char *angle(const nh_model *model, const bool *named)
{
    const char *name = NULL;
    size_t count = 0;
    for (size_t i = 0; i < 1 + 2 * model->m; i++) {
        if (!named[i]) continue;
        count++;
        const nh_coordinate *c = i > 0 && i <= model->m ? &model->system->coordinate[i - 1] : NULL;
        if (c && c->type == NH_ANGLE) name = c->name;
    }
    return count == 1 ? name : NULL;
}

void nh_singular_start_explain(const nh_model *model, const nh_state *state, nh_error *error)
{
    if (error->code != NH_NUMERIC) return;
    place p = {.model = model, .state = state, .v = nh_alloc_array(model->m + 1, sizeof *p.v)};
    bool *named = nh_alloc_array(1 + 2 * model->m, sizeof *named);
    for (size_t s = 0; s < model->m; s++) p.v[s] = state->given && !state->given[s] ? 0 : state->v[s];
    nh_text why;
    nh_text_init(&why);
    bool surface = by_position(&p, &why), found = surface || by_divisor(&p, named, &why) || by_matrix(&p, named, &why);
    const char *name = angle(model, named);
    if (found) {
        nh_error_clear(error);
        nh_fail(error, NH_NUMERIC, "", "no motion starts from this state: %s", nh_text_string(&why));
        if (surface) nh_error_hint(error, "give positions that satisfy the constraint");
        else if (name)
            nh_error_hint(error,
                          "where `%s` is an Euler angle, or that of a pole, the coordinates are singular, not the "
                          "motion: start from another value, or use other angles (of a joint: `angles: xyz`); for a "
                          "body, an orientation without singular states (docs/bodies.md, Orientations)",
                          name);
        else nh_error_hint(error, "start from other values, or use coordinates that are regular there");
    }
    nh_text_clear(&why);
    nh_free(named);
    nh_free(p.v);
}
