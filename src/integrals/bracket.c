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
