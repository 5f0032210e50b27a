/* stages: which functions each stage of the search is made of. [docs/method.md, sec. 4, "Ansatz"; docs/stages.md]
 *
 *     dictionary (integrals/dictionary.h)     velocities, forms, momenta, frame, atoms, potentials, waves, lengths, ..
 *           |
 *           v  sets of expressions (nh_expr_set), their sums, squares and products
 *     families (nh_family)                    terms, products of terms, polynomials
 *           |
 *           v  one row of the table `stages`
 *     nh_stage                                an ansatz, solved by stage_solver.c
 *
 * Bases of pencils are built the same way; there one set of terms is the whole family. */
#include <math.h>
#include <string.h>

#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "integrals/shown_coordinates.h"
#include "search/stages_internal.h"

void nh_expr_set_put(nh_expr_set *l, nh_ex e)
{
    for (size_t i = 0; i < l->n; i++)
        if (l->e[i] == e) return;
    if (l->n < NH_MOST_EXPRS) l->e[l->n++] = e;
}

void nh_expr_set_put_all(nh_expr_set *l, size_t n, const nh_ex *e)
{
    for (size_t i = 0; i < n; i++) nh_expr_set_put(l, e[i]);
}

nh_family nh_family_list_terms(nh_family_list *s, const nh_expr_set *l)
{
    nh_ex *copy = nh_arena_alloc(s->arena, (l->n + 1) * sizeof *copy);
    memcpy(copy, l->e, l->n * sizeof *copy);
    return (nh_family){.kind = NH_TERMS, .terms = l->n, .term = copy};
}

nh_family nh_family_list_product(nh_family_list *s, size_t n, const nh_family *part)
{
    nh_family *copy = nh_arena_alloc(s->arena, n * sizeof *copy);
    memcpy(copy, part, n * sizeof *copy);
    return (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = n, .part = copy};
}

void nh_family_list_add(nh_family_list *s, nh_family f)
{
    if (s->count < NH_MOST_FAMILIES && (f.kind != NH_TERMS || f.terms)) s->family[s->count++] = f;
}

void nh_family_list_product_of_sets(nh_family_list *s, const nh_expr_set *a, const nh_expr_set *b)
{
    if (a->n && b->n)
        nh_family_list_add(
            s, nh_family_list_product(s, 2, (nh_family[]){nh_family_list_terms(s, a), nh_family_list_terms(s, b)}));
}

nh_family nh_family_list_polynomial(nh_family_list *s, const nh_expr_set *l, size_t degree)
{
    nh_ex *copy = nh_arena_alloc(s->arena, (l->n + 1) * sizeof *copy);
    memcpy(copy, l->e, l->n * sizeof *copy);
    return (nh_family){.kind = NH_POLYNOMIAL, .in = copy, .in_count = l->n, .degree = degree};
}

/* ---- the lists that stages are made of ---- */

/* All functions of degree one or two in the velocities that occur in the system. */
static nh_expr_set words(const nh_family_list *s)
{
    nh_expr_set l = {0};
    nh_expr_set_put(&l, s->o->E);
    nh_expr_set_put_all(&l, s->w->momenta, s->w->momentum);
    nh_expr_set_put_all(&l, s->w->velocities, s->w->velocity);
    nh_expr_set_put_all(&l, s->w->frames, s->w->frame);
    nh_expr_set_put_all(&l, s->w->forms, s->w->form);
    return l;
}

/* Those of degree one, without energy and momenta. */
static nh_expr_set linear_words(const nh_family_list *s)
{
    nh_expr_set l = {0};
    nh_expr_set_put_all(&l, s->w->velocities, s->w->velocity);
    nh_expr_set_put_all(&l, s->w->frames, s->w->frame);
    nh_expr_set_put_all(&l, s->w->forms, s->w->form);
    return l;
}

nh_expr_set nh_expr_set_positions(const nh_family_list *s, bool one, bool time)
{
    nh_expr_set l = {0};
    if (one) nh_expr_set_put(&l, nh_int(s->o->dag, 1));
    nh_expr_set_put_all(&l, s->w->positions, s->w->position);
    if (time) nh_expr_set_put(&l, s->o->system->t);
    return l;
}

nh_expr_set nh_expr_set_functions(const nh_family_list *s, bool one)
{
    nh_expr_set l = {0};
    if (one) nh_expr_set_put(&l, nh_int(s->o->dag, 1));
    nh_expr_set_put_all(&l, s->w->atoms, s->w->atom);
    nh_expr_set_put_all(&l, s->w->potentials, s->w->potential);
    return l;
}

nh_expr_set nh_expr_set_waves(const nh_family_list *s)
{
    nh_dag *d = s->o->dag;
    nh_expr_set l = {0};
    nh_expr_set_put(&l, nh_int(d, 1));
    for (size_t i = 0; i < s->w->waves; i++) {
        size_t n = l.n;
        if (n == NH_MOST_EXPRS) break;
        nh_ex angle = s->w->wave[i], c = nh_call(d, NH_COS, angle), q = nh_call(d, NH_SIN, angle);
        for (size_t j = 0; j < n; j++) {
            nh_expr_set_put(&l, nh_mul(d, l.e[j], c));
            nh_expr_set_put(&l, nh_mul(d, l.e[j], q));
        }
    }
    return l;
}

nh_expr_set nh_expr_set_squares(const nh_family_list *s, const nh_expr_set *a)
{
    nh_expr_set l = {0};
    for (size_t i = 0; i < a->n && l.n < NH_MOST_EXPRS; i++)
        for (size_t j = 0; j <= i; j++) nh_expr_set_put(&l, nh_mul(s->o->dag, a->e[i], a->e[j]));
    return l;
}

/* ---- the stages ---- */

/* Lengths, with `squares_too` their products of two, and t. */
nh_expr_set nh_expr_set_lengths(const nh_family_list *s, bool squares_too, bool time)
{
    nh_dag *d = s->o->dag;
    nh_expr_set l = {0};
    nh_expr_set_put(&l, nh_int(d, 1));
    for (size_t i = 0; i < s->w->lengths; i++) nh_expr_set_put(&l, s->w->length[i]);
    for (size_t i = 0; i < s->w->lengths && squares_too; i++)
        for (size_t j = 0; j <= i; j++) nh_expr_set_put(&l, nh_mul(d, s->w->length[i], s->w->length[j]));
    if (time) nh_expr_set_put(&l, s->o->system->t);
    return l;
}

/* All products of one function of each set. */
static nh_expr_set times(const nh_family_list *s, const nh_expr_set *a, const nh_expr_set *b)
{
    nh_expr_set l = {0};
    for (size_t i = 0; i < a->n && l.n < NH_MOST_EXPRS; i++)
        for (size_t j = 0; j < b->n; j++) nh_expr_set_put(&l, nh_mul(s->o->dag, a->e[i], b->e[j]));
    return l;
}

/* Products of components in the frame of the kinetic energy with lengths and harmonics: the components of vectors,
 * and with squares of the frame those of tensors, in polar coordinates. */
static nh_expr_set frame_products(const nh_family_list *s)
{
    nh_expr_set f = {0}, w = nh_expr_set_waves(s), some = nh_expr_set_lengths(s, false, false),
                all = nh_expr_set_lengths(s, true, false), g = nh_expr_set_functions(s, false);
    nh_expr_set_put_all(&f, s->w->frames, s->w->frame);
    nh_expr_set out = times(s, &f, &some), squares = nh_expr_set_squares(s, &f), more = times(s, &squares, &all);
    nh_expr_set_put_all(&out, more.n, more.e);
    nh_expr_set_put_all(&out, all.n, all.e);
    nh_expr_set_put_all(&out, g.n, g.e);
    return times(s, &out, &w);
}

static void stage_words(nh_family_list *s)
{
    nh_expr_set l = words(s), q = nh_expr_set_positions(s, false, true), f = nh_expr_set_functions(s, false);
    nh_expr_set_put_all(&l, q.n, q.e);
    nh_expr_set_put_all(&l, f.n, f.e);
    nh_family_list_add(s, nh_family_list_terms(s, &l));
}

static void stage_words_positions(nh_family_list *s)
{
    nh_expr_set l = words(s), q = nh_expr_set_positions(s, true, true), f = nh_expr_set_functions(s, false);
    nh_family_list_product_of_sets(s, &l, &q);
    nh_expr_set tq = nh_expr_set_positions(s, false, true);
    bool timely = nh_family_list_timely(s);
    nh_family_list_add(s, nh_family_list_polynomial(s, &tq, timely ? 2 : 1));
    nh_family_list_add(s, nh_family_list_terms(s, &f));
    if (timely) nh_family_list_drive(s);
}

/* The momenta of affine fields in the coordinates that the system shows. */
static void shown(nh_family_list *s)
{
    nh_ex *u = nh_arena_alloc(s->arena, 2 * (s->o->m + 1) * sizeof *u), *P = u + s->o->m;
    nh_expr_set p = {0}, w = {0};
    if (!nh_shown_coordinates(s->o, s->w->places, s->w->place, u, P)) return;
    nh_expr_set_put(&w, nh_int(s->o->dag, 1));
    nh_expr_set_put(&w, s->o->system->t);
    nh_expr_set_put_all(&w, s->o->m, u);
    nh_expr_set_put_all(&p, s->o->m, P);
    nh_family_list_product_of_sets(s, &p, &w);
}

/* xi^s dL/dv^s, whatever L is, of fields with first harmonics of the angles, the system's functions and sums of
 * positions as they are written, beside t and positions: what is cyclic, or turns, in coordinates as Y = y + sin(h);
 * and the energy there, where these move. */
static void stage_momenta(nh_family_list *s)
{
    nh_dag *d = s->o->dag;
    nh_expr_set p = {0}, f = nh_expr_set_functions(s, false), tq = nh_expr_set_positions(s, true, true), w = tq;
    for (size_t i = 0; i < s->w->waves; i++) {
        nh_expr_set_put(&w, nh_call(d, NH_COS, s->w->wave[i]));
        nh_expr_set_put(&w, nh_call(d, NH_SIN, s->w->wave[i]));
    }
    nh_expr_set_put_all(&w, f.n, f.e);
    nh_expr_set_put_all(&w, s->w->places, s->w->place);
    if (w.n == tq.n) return;
    nh_expr_set_put_all(&p, s->w->momenta, s->w->momentum);
    nh_family_list_product_of_sets(s, &p, &w);
    shown(s);
    nh_family_list_add(s, nh_family_list_polynomial(s, &tq, 1));
    nh_expr_set_put(&f, s->o->E);
    nh_family_list_add(s, nh_family_list_terms(s, &f));
}

static void stage_degree_2(nh_family_list *s)
{
    enum { degree = 2 };
    nh_expr_set v = {0}, f = nh_expr_set_functions(s, true);
    for (size_t i = 0; i < s->w->positions; i++) nh_expr_set_put(&v, s->w->position[i]);
    nh_expr_set_put_all(&v, s->w->velocities, s->w->velocity);
    nh_family products = nh_family_list_polynomial(s, &v, degree);
    if (f.n > 1) products = nh_family_list_product(s, 2, (nh_family[]){products, nh_family_list_terms(s, &f)});
    nh_family_list_add(s, products);
}

/* L has terms of degree one in the velocities: a magnetic field. */
static bool is_magnetic(const nh_family_list *s)
{
    const nh_model *model = s->o;
    nh_ex *zero = nh_arena_alloc(s->arena, (model->n + 1) * sizeof *zero);
    for (size_t i = 0; i < model->n; i++) zero[i] = nh_int(model->dag, 0);
    for (size_t k = 0; k < model->m; k++)
        if (!nh_is_zero(model->dag, nh_substitute(model->dag, model->p[k], model->n, model->chart->w, zero)))
            return true;
    return false;
}

/* Quadratic in the velocities, linear in positions, atoms of weight two: Runge-Lenz vectors; in the field of a monopole
   also linear in the velocities. */
static void stage_weights(nh_family_list *s)
{
    nh_expr_set l = linear_words(s), v = {0}, q = nh_expr_set_squares(s, &l), x = nh_expr_set_positions(s, true, false),
                f = nh_expr_set_functions(s, false);
    nh_family_list_product_of_sets(s, &q, &x);
    nh_family_list_product_of_sets(s, &f, &x);
    nh_expr_set_put_all(&v, s->o->n, s->o->chart->w);
    if (f.n && is_magnetic(s))
        nh_family_list_add(
            s, nh_family_list_product(s, 3,
                                      (nh_family[]){nh_family_list_terms(s, &v), nh_family_list_terms(s, &x),
                                                    nh_family_list_terms(s, &f)}));
}

typedef struct {
    const char *name;
    void (*build)(nh_family_list *);
} recipe;

static const recipe stages[] = {
    [NH_STAGE_WORDS] = {"energy, momenta, velocities, forms, positions, terms of the potential", stage_words},
    [NH_STAGE_DRIVE] = {"momenta times 1, t and logarithms of t, positions, powers of t", nh_stage_drive},
    [NH_STAGE_WORDS_POSITIONS] = {"energy, momenta, velocities and forms times 1, t and the positions",
                                  stage_words_positions},
    [NH_STAGE_MOMENTA] = {"momenta times t, positions and sums of them, harmonics and functions; energy",
                          stage_momenta},
    [NH_STAGE_DEGREE_2] = {"total degree 2 times the system's own functions", stage_degree_2},
    [NH_STAGE_WEIGHTS] = {"quadratic forms times positions", stage_weights},
    [NH_STAGE_WEIGHT_4] = {"weighted degree 4 in the frame of the kinetic energy", nh_stage_weight_4},
    [NH_STAGE_SEPARATION] = {"squares of velocities times positions of higher degree, energy and functions times lower",
                             nh_stage_separation},
    [NH_STAGE_TIME] = {"squares of positions and velocities times functions of time", nh_stage_time},
    [NH_STAGE_HALF_ANGLES] = {"squares of the frame times lengths and half angles", nh_stage_half_angles},
    [NH_STAGE_RATIONAL] = {"quotients by the denominators of the Lagrangian", nh_stage_rational},
};

bool nh_stage_at(nh_arena *arena, const nh_model *model, const nh_dictionary *w, size_t index, nh_stage *out)
{
    if (index >= sizeof stages / sizeof *stages) return false;
    nh_family_list s = {arena, model, w, nh_arena_alloc(arena, NH_MOST_FAMILIES * sizeof(nh_family)), 0};
    stages[index].build(&s);
    *out = (nh_stage){stages[index].name, s.count, s.family};
    return true;
}

/* Masses and springs that grow like t need t times the words.  Elsewhere t f is a second vector for the eigenvalue of
 * f, which rounding splits. */
static void put_growing(const nh_family_list *s, nh_expr_set *l)
{
    nh_expr_set words = {0};
    nh_ex t = s->o->system->t;
    nh_expr_set_put_all(&words, s->o->n, s->o->chart->w);
    nh_expr_set_put_all(&words, s->w->positions, s->w->position);
    for (size_t i = 0; i < words.n; i++) nh_expr_set_put(l, nh_mul(s->o->dag, t, words.e[i]));
}

/* Squares or cubes of velocities and lengths, and the system's functions, for cubes times lengths.  Lists that are too
   long are left empty. */
static nh_expr_set pencil_powers(const nh_family_list *s, size_t degree)
{
    enum { most_variables = 7 };
    nh_expr_set u = {0}, l = {0}, q = nh_expr_set_lengths(s, false, false), f = nh_expr_set_functions(s, false);
    nh_expr_set_put_all(&u, s->o->n, s->o->chart->w);
    nh_expr_set_put_all(&u, s->w->lengths, s->w->length);
    if (u.n > most_variables || s->w->lengths == 0 || (degree > 2 && (s->w->waves || f.n == 0))) return l;
    l = nh_expr_set_squares(s, &u);
    for (size_t k = 2; k < degree; k++) l = times(s, &l, &u);
    nh_expr_set g = degree > 2 ? times(s, &f, &q) : f;
    nh_expr_set_put_all(&l, g.n, g.e);
    return l;
}

/* Velocities, times first harmonics of the angles where these stay few; of degree one everything else as well. */
static nh_expr_set pencil_words(const nh_family_list *s, nh_pencil_base base)
{
    enum { most_with_waves = 110 };
    const nh_dictionary *w = s->w;
    nh_expr_set l = {0}, v = {0};
    nh_expr_set_put_all(&l, w->velocities, w->velocity);
    if (base >= NH_PENCIL_LINEAR) nh_expr_set_put_all(&l, w->frames, w->frame);
    if (base >= NH_PENCIL_LINEAR) nh_expr_set_put_all(&l, w->forms, w->form);
    size_t n = l.n;
    if (base > NH_PENCIL_VELOCITIES && (double)n * pow(3, (double)w->waves) <= most_with_waves)
        v = nh_expr_set_waves(s);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < v.n; j++) nh_expr_set_put(&l, nh_mul(s->o->dag, l.e[i], v.e[j]));
    if (base >= NH_PENCIL_TIME) nh_expr_set_put_time(s, &l);
    if (base == NH_PENCIL_GROWING) put_growing(s, &l);
    if (base < NH_PENCIL_LINEAR) return l;
    nh_expr_set q = nh_expr_set_positions(s, false, false), f = nh_expr_set_functions(s, false);
    nh_expr_set_put_all(&l, q.n, q.e);
    nh_expr_set_put_all(&l, f.n, f.e);
    nh_expr_set_put_all(&l, w->momenta, w->momentum);
    return l;
}

/* Velocities times 1 and positions. */
static nh_expr_set pencil_products(const nh_family_list *s)
{
    nh_expr_set u = {0}, x = nh_expr_set_positions(s, true, false);
    nh_expr_set_put_all(&u, s->w->velocities, s->w->velocity);
    return times(s, &u, &x);
}

/* Derivatives of the potentials, repeatedly: with friction c x'^2, exp(2 c x) (x'^2/2 + f(x)) is conserved where f' +
 * 2 c f = V', so that f is a sum of derivatives of V where these end. */
static void put_derivatives(const nh_family_list *s, nh_expr_set *l)
{
    enum { highest = 6 };
    const nh_model *model = s->o;
    for (size_t i = 0; i < s->w->potentials; i++)
        for (size_t k = 0; k < model->m; k++) {
            nh_ex e = s->w->potential[i];
            for (size_t j = 0; j < highest && nh_depends(model->dag, e, model->system->coordinate[k].q); j++) {
                e = nh_diff(model->dag, e, model->system->coordinate[k].q);
                if (nh_kind_of(model->dag, e) == NH_PRODUCT)
                    e = nh_div(model->dag, e, nh_number(model->dag, nh_constant_of(model->dag, e)));
                nh_expr_set_put(l, e);
            }
        }
}

/* Squares of velocities, and the system's functions with the derivatives of its potentials. */
static nh_expr_set pencil_squares(const nh_family_list *s)
{
    nh_expr_set u = {0}, f = nh_expr_set_functions(s, true);
    put_derivatives(s, &f);
    nh_expr_set_put_all(&u, s->o->n, s->o->chart->w);
    nh_expr_set uu = nh_expr_set_squares(s, &u);
    nh_expr_set_put_all(&uu, f.n, f.e);
    return uu;
}

nh_family nh_stage_pencil_around(nh_arena *arena, const nh_model *model, const nh_dictionary *w, nh_ex angle)
{
    nh_dag *d = model->dag;
    nh_family_list s = {arena, model, w, NULL, 0};
    nh_expr_set l = linear_words(&s), wave = {0};
    nh_expr_set_put(&wave, nh_int(d, 1));
    nh_expr_set_put(&wave, nh_call(d, NH_COS, angle));
    nh_expr_set_put(&wave, nh_call(d, NH_SIN, angle));
    nh_expr_set both = times(&s, &l, &wave);
    return nh_family_list_terms(&s, &both);
}

nh_family nh_stage_pencil_base(nh_arena *arena, const nh_model *model, const nh_dictionary *w, nh_pencil_base base)
{
    nh_family_list s = {arena, model, w, NULL, 0};
    nh_expr_set l = {0};
    switch (base) {
    case NH_PENCIL_QUADRATIC: l = pencil_powers(&s, 2); break;
    case NH_PENCIL_CUBIC: l = pencil_powers(&s, 3); break;
    case NH_PENCIL_SQUARES: l = pencil_squares(&s); break;
    case NH_PENCIL_ENERGY:
        l = nh_expr_set_functions(&s, true);
        nh_expr_set_put(&l, model->E);
        break;
    case NH_PENCIL_RATIONAL: l = nh_expr_set_quotients(&s); break;
    case NH_PENCIL_PRODUCTS: l = pencil_products(&s); break;
    case NH_PENCIL_FRAME:
        if (w->frames == model->n) l = frame_products(&s);
        break;
    default: l = pencil_words(&s, base);
    }
    return nh_family_list_terms(&s, &l);
}
