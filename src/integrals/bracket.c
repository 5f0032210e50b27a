/* bracket: the components of [Gamma, Z], simplified.  The shortest component gives a and b, which are then checked on
 * all of them. */
#include "integrals/bracket.h"

#include <string.h>

#include "exact/normal.h"
#include "graph/dag.h"

enum { large_length = 3000 };

static nh_ex tidy(const nh_model *o, nh_ex e) { return nh_simplify_short(o->dag, e, large_length); }
static nh_ex *take(nh_arena *arena, size_t n) { return nh_arena_alloc(arena, (n + 1) * sizeof(nh_ex)); }

static void forms(nh_arena *arena, const nh_submanifold *s, const nh_symmetry *z, nh_bracket *b)
{
    const nh_model *o = s->model;
    nh_field V = {nh_int(o->dag, 0), NULL, take(arena, o->n)};
    for (size_t i = 0; i < o->n; i++) V.velocity[i] = nh_int(o->dag, 0);
    b->F = take(arena, o->k);
    b->form = take(arena, o->k);
    for (size_t a = 0; a < o->k; a++) {
        const nh_ex *form = s->form + a * (1 + o->m);
        V.space = s->across + a * o->m;
        b->F[a] = tidy(o, nh_add(o->dag, nh_model_along(o, &V, z->phi), nh_model_omega(o, &z->field, &V)));
        b->form[a] = z->bracket_in_distribution ? nh_int(o->dag, 0) : nh_mul(o->dag, form[0], b->field.time);
        for (size_t r = 0; r < o->m && !z->bracket_in_distribution; r++)
            b->form[a] = nh_add(o->dag, b->form[a], nh_mul(o->dag, form[1 + r], b->field.space[r]));
        b->form[a] = tidy(o, b->form[a]);
    }
}

/* [Gamma, Z], or for Z = Z^0 Gamma + Z' where that is shorter [Gamma, Z'] + Gamma(Z^0) Gamma: Z' has no component along
   t. */
static void components(const nh_model *o, const nh_symmetry *z, nh_bracket *b)
{
    nh_dag *d = o->dag;
    b->along_motion = z->along_motion;
    b->motion = z->along_motion ? tidy(o, nh_model_gamma(o, z->Z0)) : nh_int(d, 0);
    b->field.time = z->along_motion ? nh_int(d, 0) : tidy(o, z->bracket.time);
    for (size_t r = 0; r < o->m; r++)
        b->field.space[r] = tidy(o, z->along_motion ? nh_sub(d, nh_model_gamma(o, z->relative.space[r]),
                                                             nh_model_along(o, &z->relative, o->rho[r]))
                                                    : z->bracket.space[r]);
    for (size_t i = 0; i < o->n; i++)
        b->field.velocity[i] = tidy(o, z->along_motion ? nh_sub(d, nh_model_gamma(o, z->relative.velocity[i]),
                                                                nh_model_along(o, &z->relative, o->a[i]))
                                                       : z->bracket.velocity[i]);
    for (size_t r = 0; r < o->m; r++) b->rate[r] = tidy(o, nh_model_along(o, &b->field, o->rho[r]));
}

/* f - f^0 Gamma: 1 + m + n components, the first of them 0. */
static void relative(const nh_model *o, const nh_field *f, nh_ex *out)
{
    nh_dag *d = o->dag;
    *out++ = nh_int(d, 0);
    for (size_t s = 0; s < o->m; s++) *out++ = tidy(o, nh_sub(d, f->space[s], nh_mul(d, f->time, o->rho[s])));
    for (size_t i = 0; i < o->n; i++) *out++ = tidy(o, nh_sub(d, f->velocity[i], nh_mul(d, f->time, o->a[i])));
}

/* [Gamma, Z] - [Gamma, Z]^0 Gamma = b (Z - Z^0 Gamma), a = [Gamma, Z]^0 - b Z^0 */
static void coefficients(nh_arena *arena, const nh_model *o, const nh_symmetry *z, nh_bracket *out)
{
    nh_dag *d = o->dag;
    size_t width = 1 + o->m + o->n, best = 0;
    nh_ex *r = take(arena, width), *Z = take(arena, width);
    if (z->kase != 1 && z->kase != 2) return;
    relative(o, &out->field, r);
    relative(o, &z->field, Z);
    for (size_t j = 1; j < width && z->kase == 2; j++)
        if (!nh_is_zero(d, Z[j]) && (!best || nh_complexity(d, Z[j]) + nh_complexity(d, r[j]) <
                                                  nh_complexity(d, Z[best]) + nh_complexity(d, r[best])))
            best = j;
    out->b = best ? tidy(o, nh_div(d, r[best], Z[best])) : nh_int(d, 0);
    out->a = tidy(o, nh_sub(d, nh_add(d, out->motion, out->field.time), nh_mul(d, out->b, z->Z0)));
    out->decided = true;
    for (size_t j = 1; j < width && out->decided; j++)
        out->decided = nh_normal_is_zero(d, nh_sub(d, r[j], nh_mul(d, out->b, Z[j])), 0) == NH_ZERO;
}

nh_bracket *nh_bracket_of(nh_arena *arena, const nh_submanifold *s, const nh_symmetry *z)
{
    const nh_model *o = s->model;
    nh_bracket *b = nh_arena_alloc(arena, sizeof *b);
    *b = (nh_bracket){.field = {0, take(arena, o->m), take(arena, o->n)}, .rate = take(arena, o->m)};
    components(o, z, b);
    forms(arena, s, z, b);
    coefficients(arena, o, z, b);
    return b;
}
