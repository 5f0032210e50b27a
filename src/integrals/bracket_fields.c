/* bracket_fields: coefficients by exact derivatives, not simplified: they are evaluated at points. */
#include "integrals/bracket_fields.h"

#include <string.h>

#include "graph/dag.h"

typedef struct {
    const nh_model *o;
    nh_dag *d;
    size_t m, n, width;
    nh_ex *inverse, *P, *H; /* M^-1; R M^-1; M^-1 G^T M^-1 */
} maker;

static nh_ex product(nh_dag *d, nh_ex a, nh_ex b) { return nh_mul(d, a, b); }

/* out (rows x columns) = a (rows x inner) b (inner x columns); `transposed`: by the transpose of b. */
static void multiply(nh_dag *d, size_t rows, size_t inner, size_t columns, const nh_ex *a, const nh_ex *b,
                     bool transposed, nh_ex *out)
{
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < columns; j++) {
            out[i * columns + j] = nh_int(d, 0);
            for (size_t l = 0; l < inner; l++)
                out[i * columns + j] =
                    nh_add(d, out[i * columns + j],
                           product(d, a[i * inner + l], transposed ? b[j * inner + l] : b[l * columns + j]));
        }
}

static void add(const maker *x, nh_ex *sum, nh_ex c) { *sum = nh_add(x->d, *sum, c); }
static void add_Y(const maker *x, nh_ex *field, nh_ex c, size_t k) { add(x, &field[1 + x->m + k], c); }

/* field += c X_j */
static void add_X(const maker *x, nh_ex *field, nh_ex c, size_t j)
{
    for (size_t s = 0; s < x->m; s++) add(x, &field[1 + s], product(x->d, c, x->o->R[s * x->n + j]));
}

/* field += c [Gamma, Y_k],  [Gamma, Y_k] = -X_k - Y_k(a^i) Y_i */
static void add_gamma_Y(const maker *x, nh_ex *field, nh_ex c, size_t k)
{
    nh_ex minus = nh_neg(x->d, c);
    add_X(x, field, minus, k);
    for (size_t i = 0; i < x->n; i++) add_Y(x, field, product(x->d, minus, nh_model_Y(x->o, k, x->o->a[i])), i);
}

/* field += c [Gamma, X_j],  [Gamma, X_j] = (Gamma(R^s_j) - X_j(rho^s)) d/dq^s - X_j(a^i) Y_i */
static void add_gamma_X(const maker *x, nh_ex *field, nh_ex c, size_t j)
{
    const nh_model *o = x->o;
    for (size_t s = 0; s < x->m; s++)
        add(x, &field[1 + s],
            product(x->d, c, nh_sub(x->d, nh_model_gamma(o, o->R[s * x->n + j]), nh_model_X(o, j, o->rho[s]))));
    for (size_t i = 0; i < x->n; i++) add_Y(x, field, nh_neg(x->d, product(x->d, c, nh_model_X(o, j, o->a[i]))), i);
}

/* P_rk df/dq^r for one k */
static nh_ex along_zeta(const maker *x, size_t k, nh_ex f)
{
    nh_field v = {nh_int(x->d, 0), nh_alloc_array(x->m + 1, sizeof(nh_ex)), nh_alloc_array(x->n + 1, sizeof(nh_ex))};
    for (size_t r = 0; r < x->m; r++) v.space[r] = x->P[r * x->n + k];
    for (size_t i = 0; i < x->n; i++) v.velocity[i] = nh_int(x->d, 0);
    nh_ex e = nh_model_along(x->o, &v, f);
    nh_free(v.space);
    nh_free(v.velocity);
    return e;
}

/* V^s: its component along Y_k for each k. */
static void along_position(const maker *x, size_t s, nh_ex *field)
{
    const nh_model *o = x->o;
    size_t n = x->n;
    for (size_t k = 0; k < n; k++) {
        nh_ex e = nh_sub(x->d, nh_model_gamma(o, x->P[s * n + k]), along_zeta(x, k, o->rho[s]));
        for (size_t j = 0; j < n; j++) {
            e = nh_sub(x->d, e, product(x->d, x->P[s * n + j], nh_model_Y(o, j, o->a[k])));
            for (size_t l = 0; l < n; l++)
                e = nh_add(
                    x->d, e,
                    product(x->d, x->P[s * n + j], product(x->d, nh_model_G(o)[l * n + j], x->inverse[l * n + k])));
        }
        add_Y(x, field, e, k);
    }
}

/* V^i, summand by summand in the order of the header. */
static void along_velocity(const maker *x, size_t i, nh_ex *field)
{
    const nh_model *o = x->o;
    nh_dag *d = x->d;
    size_t n = x->n;
    for (size_t k = 0; k < n; k++) {
        add_Y(x, field, nh_neg(d, nh_add(d, nh_model_gamma(o, x->H[i * n + k]), along_zeta(x, k, o->a[i]))), k);
        add_gamma_Y(x, field, nh_neg(d, x->H[i * n + k]), k);
        add_X(x, field, nh_neg(d, nh_model_gamma(o, x->inverse[i * n + k])), k);
        add_gamma_X(x, field, nh_neg(d, x->inverse[i * n + k]), k);
        for (size_t l = 0; l < n; l++) {
            nh_ex slope = nh_model_Y(o, l, o->a[i]);
            add_Y(x, field, product(d, slope, x->H[l * n + k]), k);
            add_X(x, field, product(d, slope, x->inverse[l * n + k]), k);
        }
    }
}

/* M^-1, column by column. */
static void invert(maker *x)
{
    nh_ex *unit = nh_alloc_array(x->n + 1, sizeof *unit), *column = nh_alloc_array(x->n + 1, sizeof *column);
    for (size_t k = 0; k < x->n; k++) {
        for (size_t i = 0; i < x->n; i++) unit[i] = nh_int(x->d, i == k);
        nh_lu_solve(x->o->M_lu, unit, column);
        for (size_t i = 0; i < x->n; i++) x->inverse[i * x->n + k] = column[i];
    }
    nh_free(column);
    nh_free(unit);
}

static void zero(nh_dag *d, size_t n, nh_ex *e)
{
    for (size_t i = 0; i < n; i++) e[i] = nh_int(d, 0);
}

nh_bracket_fields *nh_bracket_fields_of(nh_arena *arena, const nh_submanifold *submanifold)
{
    const nh_model *model = submanifold->model;
    nh_bracket_fields *out = nh_arena_alloc(arena, sizeof *out);
    size_t m = model->m, n = model->n, width = 1 + m + n;
    nh_dag *d = model->dag;
    *out = (nh_bracket_fields){.width = width, .across = model->k, .all = m + n};
    out->gamma = nh_arena_alloc(arena, (1 + model->k + m + n) * width * sizeof *out->gamma);
    out->U = out->gamma + width;
    out->V = out->U + model->k * width;
    zero(d, (1 + model->k + m + n) * width, out->gamma);
    maker x = {model,
               d,
               m,
               n,
               width,
               nh_alloc_array(n * n + 1, sizeof(nh_ex)),
               nh_alloc_array(m * n + 1, sizeof(nh_ex)),
               nh_alloc_array(n * n + 1, sizeof(nh_ex))};
    nh_ex *half = nh_alloc_array(n * n + 1, sizeof *half);
    invert(&x);
    multiply(d, m, n, n, model->R, x.inverse, false, x.P);
    multiply(d, n, n, n, x.inverse, nh_model_G(model), true, half);
    multiply(d, n, n, n, half, x.inverse, false, x.H);
    out->gamma[0] = nh_int(d, 1);
    memcpy(out->gamma + 1, model->rho, m * sizeof *out->gamma);
    memcpy(out->gamma + 1 + m, model->a, n * sizeof *out->gamma);
    for (size_t s = 0; s < m; s++) along_position(&x, s, out->V + s * width);
    for (size_t i = 0; i < n; i++) along_velocity(&x, i, out->V + (m + i) * width);
    for (size_t a = 0; a < model->k; a++)
        for (size_t s = 0; s < m; s++)
            for (size_t c = 0; c < width; c++)
                add(&x, &out->U[a * width + c],
                    product(d, submanifold->form[a * (1 + m) + 1 + s], out->V[s * width + c]));
    nh_free(half);
    nh_free(x.H);
    nh_free(x.P);
    nh_free(x.inverse);
    return out;
}

nh_ex nh_bracket_fields_apply(const nh_model *model, const nh_ex *field, nh_ex e)
{
    nh_field v = {field[0], (nh_ex *)field + 1, (nh_ex *)field + 1 + model->m};
    return nh_model_along(model, &v, e);
}
