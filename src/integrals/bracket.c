/* bracket: the components of [Gamma, Z], simplified.  The shortest component gives a and b, which are then checked on
 * all of them. */
#include "integrals/bracket.h"

#include <string.h>

#include "exact/normal.h"
#include "graph/dag.h"

enum { large_length = 3000 };

static nh_ex tidy(const nh_model *model, nh_ex e) { return nh_simplify_short(model->dag, e, large_length); }
static nh_ex *take(nh_arena *arena, size_t n) { return nh_arena_alloc(arena, (n + 1) * sizeof(nh_ex)); }

/* F_a = V_a(Phi) + Omega(Z, V_a), and i_[Gamma,Z] phi^a from the bracket's components; 0 where it is known to lie
 * inside. */
static void forms(nh_arena *arena, const nh_submanifold *s, const nh_symmetry *z, nh_bracket *b)
{
    const nh_model *model = s->model;
    nh_field V = {nh_int(model->dag, 0), NULL, take(arena, model->n)};
    for (size_t i = 0; i < model->n; i++) V.velocity[i] = nh_int(model->dag, 0);
    b->F = take(arena, model->k);
    b->form = take(arena, model->k);
    for (size_t a = 0; a < model->k; a++) {
        const nh_ex *form = s->form + a * (1 + model->m);
        V.space = s->across + a * model->m;
        b->F[a] =
            tidy(model, nh_add(model->dag, nh_model_along(model, &V, z->phi), nh_model_omega(model, &z->field, &V)));
        b->form[a] = z->bracket_in_distribution ? nh_int(model->dag, 0) : nh_mul(model->dag, form[0], b->field.time);
        for (size_t r = 0; r < model->m && !z->bracket_in_distribution; r++)
            b->form[a] = nh_add(model->dag, b->form[a], nh_mul(model->dag, form[1 + r], b->field.space[r]));
        b->form[a] = tidy(model, b->form[a]);
    }
}

/* [Gamma, Z], or for Z = Z^0 Gamma + Z' where that is shorter [Gamma, Z'] + Gamma(Z^0) Gamma: Z' has no component along
   t. */
static void components(const nh_model *model, const nh_symmetry *z, nh_bracket *b)
{
    nh_dag *d = model->dag;
    b->along_motion = z->along_motion;
    b->motion = z->along_motion ? tidy(model, nh_model_gamma(model, z->Z0)) : nh_int(d, 0);
    b->field.time = z->along_motion ? nh_int(d, 0) : tidy(model, z->bracket.time);
    for (size_t r = 0; r < model->m; r++)
        b->field.space[r] = tidy(model, z->along_motion ? nh_sub(d, nh_model_gamma(model, z->relative.space[r]),
                                                                 nh_model_along(model, &z->relative, model->rho[r]))
                                                        : z->bracket.space[r]);
    for (size_t i = 0; i < model->n; i++)
        b->field.velocity[i] = tidy(model, z->along_motion ? nh_sub(d, nh_model_gamma(model, z->relative.velocity[i]),
                                                                    nh_model_along(model, &z->relative, model->a[i]))
                                                           : z->bracket.velocity[i]);
    for (size_t r = 0; r < model->m; r++) b->rate[r] = tidy(model, nh_model_along(model, &b->field, model->rho[r]));
}

/* f - f^0 Gamma: 1 + m + n components, the first of them 0. */
static void relative(const nh_model *model, const nh_field *f, nh_ex *out)
{
    nh_dag *d = model->dag;
    *out++ = nh_int(d, 0);
    for (size_t s = 0; s < model->m; s++)
        *out++ = tidy(model, nh_sub(d, f->space[s], nh_mul(d, f->time, model->rho[s])));
    for (size_t i = 0; i < model->n; i++)
        *out++ = tidy(model, nh_sub(d, f->velocity[i], nh_mul(d, f->time, model->a[i])));
}

/* [Gamma, Z] - [Gamma, Z]^0 Gamma = b (Z - Z^0 Gamma), a = [Gamma, Z]^0 - b Z^0 */
static void coefficients(nh_arena *arena, const nh_model *model, const nh_symmetry *z, nh_bracket *out)
{
    nh_dag *d = model->dag;
    size_t width = 1 + model->m + model->n, best = 0;
    nh_ex *r = take(arena, width), *Z = take(arena, width);
    if (z->kase != 1 && z->kase != 2) return;
    relative(model, &out->field, r);
    relative(model, &z->field, Z);
    for (size_t j = 1; j < width && z->kase == 2; j++)
        if (!nh_is_zero(d, Z[j]) && (!best || nh_complexity(d, Z[j]) + nh_complexity(d, r[j]) <
                                                  nh_complexity(d, Z[best]) + nh_complexity(d, r[best])))
            best = j;
    out->b = best ? tidy(model, nh_div(d, r[best], Z[best])) : nh_int(d, 0);
    out->a = tidy(model, nh_sub(d, nh_add(d, out->motion, out->field.time), nh_mul(d, out->b, z->Z0)));
    out->decided = true;
    for (size_t j = 1; j < width && out->decided; j++)
        out->decided = nh_normal_is_zero(d, nh_sub(d, r[j], nh_mul(d, out->b, Z[j])), 0) == NH_ZERO;
}

nh_bracket *nh_bracket_of(nh_arena *arena, const nh_submanifold *s, const nh_symmetry *z)
{
    const nh_model *model = s->model;
    nh_bracket *b = nh_arena_alloc(arena, sizeof *b);
    *b = (nh_bracket){.field = {0, take(arena, model->m), take(arena, model->n)}, .rate = take(arena, model->m)};
    components(model, z, b);
    forms(arena, s, z, b);
    coefficients(arena, model, z, b);
    return b;
}

/* ---- as derivatives of a current ---- */

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
