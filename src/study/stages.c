#include "study/stages.h"

#include <string.h>

enum { most_list = 200, most_families = 24 };

typedef struct {
    nh_arena *arena;
    const nh_model *o;
    const nh_dictionary *w;
    nh_family *family;
    size_t count;
} shelf;

typedef struct {
    size_t n;
    nh_ex e[most_list];
} list;

static void put(list *l, nh_ex e)
{
    for (size_t i = 0; i < l->n; i++)
        if (l->e[i] == e) return;
    if (l->n < most_list) l->e[l->n++] = e;
}

static void put_all(list *l, size_t n, const nh_ex *e)
{
    for (size_t i = 0; i < n; i++) put(l, e[i]);
}

static nh_family terms_of(shelf *s, const list *l)
{
    nh_ex *copy = nh_arena_alloc(s->arena, (l->n + 1) * sizeof *copy);
    memcpy(copy, l->e, l->n * sizeof *copy);
    return (nh_family){.kind = NH_TERMS, .terms = l->n, .term = copy};
}

static nh_family product_of(shelf *s, size_t n, const nh_family *part)
{
    nh_family *copy = nh_arena_alloc(s->arena, n * sizeof *copy);
    memcpy(copy, part, n * sizeof *copy);
    return (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = n, .part = copy};
}

static void add(shelf *s, nh_family f)
{
    if (s->count < most_families && (f.kind != NH_TERMS || f.terms)) s->family[s->count++] = f;
}

static void add_product(shelf *s, const list *a, const list *b)
{
    if (a->n && b->n) add(s, product_of(s, 2, (nh_family[]){terms_of(s, a), terms_of(s, b)}));
}

static nh_family polynomial_of(shelf *s, const list *l, size_t degree)
{
    nh_ex *copy = nh_arena_alloc(s->arena, (l->n + 1) * sizeof *copy);
    memcpy(copy, l->e, l->n * sizeof *copy);
    return (nh_family){.kind = NH_POLYNOMIAL, .in = copy, .in_count = l->n, .degree = degree};
}

/* ---- the lists that stages are made of ---- */

/* Everything of degree one or two in the velocities that the system itself shows. */
static list words(const shelf *s)
{
    list l = {0};
    put(&l, s->o->E);
    put_all(&l, s->w->momenta, s->w->momentum);
    put_all(&l, s->w->velocities, s->w->velocity);
    put_all(&l, s->w->frames, s->w->frame);
    put_all(&l, s->w->forms, s->w->form);
    return l;
}

static list linear_words(const shelf *s)
{
    list l = {0};
    put_all(&l, s->w->velocities, s->w->velocity);
    put_all(&l, s->w->frames, s->w->frame);
    put_all(&l, s->w->forms, s->w->form);
    return l;
}

static list positions(const shelf *s, bool one, bool time)
{
    list l = {0};
    if (one) put(&l, nh_int(s->o->dag, 1));
    put_all(&l, s->w->positions, s->w->position);
    if (time) put(&l, s->o->system->t);
    return l;
}

static list functions(const shelf *s, bool one)
{
    list l = {0};
    if (one) put(&l, nh_int(s->o->dag, 1));
    put_all(&l, s->w->atoms, s->w->atom);
    put_all(&l, s->w->potentials, s->w->potential);
    return l;
}

/* prod over the angles of {1, cos, sin}, to the given harmonic. */
static list waves(const shelf *s, size_t harmonic)
{
    nh_dag *d = s->o->dag;
    list l = {0};
    put(&l, nh_int(d, 1));
    for (size_t i = 0; i < s->w->waves; i++) {
        size_t n = l.n;
        for (size_t k = 1; k <= harmonic; k++) {
            nh_ex angle = nh_mul(d, nh_int(d, (int64_t)k), s->w->wave[i]), c = nh_call(d, NH_COS, angle), q = nh_call(d, NH_SIN, angle);
            for (size_t j = 0; j < n; j++) {
                put(&l, nh_mul(d, l.e[j], c));
                put(&l, nh_mul(d, l.e[j], q));
            }
        }
    }
    return l;
}

static list squares(const shelf *s, const list *a)
{
    list l = {0};
    for (size_t i = 0; i < a->n; i++)
        for (size_t j = 0; j <= i; j++) put(&l, nh_mul(s->o->dag, a->e[i], a->e[j]));
    return l;
}

/* ---- the stages ---- */

/* Products of components along the frame of the kinetic energy with lengths and harmonics: in polar coordinates the components of vectors. */
static list lengths(const shelf *s, bool squares_too, bool time)
{
    nh_dag *d = s->o->dag;
    list l = {0};
    put(&l, nh_int(d, 1));
    for (size_t i = 0; i < s->w->lengths; i++) put(&l, s->w->length[i]);
    for (size_t i = 0; i < s->w->lengths && squares_too; i++)
        for (size_t j = 0; j <= i; j++) put(&l, nh_mul(d, s->w->length[i], s->w->length[j]));
    if (time) put(&l, s->o->system->t);
    return l;
}

static list times(const shelf *s, const list *a, const list *b)
{
    list l = {0};
    for (size_t i = 0; i < a->n; i++)
        for (size_t j = 0; j < b->n; j++) put(&l, nh_mul(s->o->dag, a->e[i], b->e[j]));
    return l;
}

static list frame_products(const shelf *s, bool squares_too)
{
    list f = {0}, w = waves(s, 1), some = lengths(s, false, !squares_too), all = lengths(s, true, false), g = functions(s, false);
    put_all(&f, s->w->frames, s->w->frame);
    list out = times(s, &f, &some), sq = squares(s, &f), more = times(s, &sq, &all);
    if (squares_too) put_all(&out, more.n, more.e);
    put_all(&out, all.n, all.e);
    if (squares_too) put_all(&out, g.n, g.e);
    return times(s, &out, &w);
}

static void stage_frame(shelf *s)
{
    if (s->w->frames < s->o->n) return;
    list l = frame_products(s, true);
    add(s, terms_of(s, &l));
}

static void stage_words(shelf *s)
{
    list l = words(s), q = positions(s, false, true), f = functions(s, false);
    put_all(&l, q.n, q.e);
    put_all(&l, f.n, f.e);
    add(s, terms_of(s, &l));
}

static void stage_words_positions(shelf *s)
{
    list l = words(s), q = positions(s, true, true), f = functions(s, false);
    add_product(s, &l, &q);
    add(s, terms_of(s, &f));
    add(s, terms_of(s, &q));
}

static void stage_linear_waves(shelf *s)
{
    list l = linear_words(s), w = waves(s, 1);
    if (s->w->waves) add_product(s, &l, &w);
}

static void stage_functions(shelf *s)
{
    list l = words(s), q = positions(s, true, false), f = functions(s, true);
    if (f.n < 2) return;
    add(s, product_of(s, 3, (nh_family[]){terms_of(s, &l), terms_of(s, &q), terms_of(s, &f)}));
    add_product(s, &q, &f);
}

static void stage_linear_functions(shelf *s)
{
    list l = linear_words(s), f = functions(s, true);
    if (f.n > 1) add_product(s, &l, &f);
}

/* Total degree in positions and velocities, with the atoms; only where the angles do not matter. */
static void stage_total(shelf *s, size_t degree, bool with_functions)
{
    list v = {0}, f = functions(s, true);
    for (size_t i = 0; i < s->w->positions; i++) put(&v, s->w->position[i]);
    put_all(&v, s->w->velocities, s->w->velocity);
    if (with_functions && f.n > 1) add(s, product_of(s, 2, (nh_family[]){polynomial_of(s, &v, degree), terms_of(s, &f)}));
    else add(s, polynomial_of(s, &v, degree));
}

static void stage_degree_2(shelf *s) { stage_total(s, 2, true); }
static void stage_degree_3(shelf *s) { stage_total(s, 3, false); }
static void stage_degree_4(shelf *s) { stage_total(s, 4, false); }
static void stage_degree_6(shelf *s) { stage_total(s, 6, false); }

static void stage_quadratic_waves(shelf *s)
{
    list l = linear_words(s), q = squares(s, &l), w = waves(s, 1), f = functions(s, false);
    if (!s->w->waves) return;
    add_product(s, &q, &w);
    add(s, terms_of(s, &f));
}

/* Quadratic in the velocities, linear in positions, atoms of weight two: Runge-Lenz vectors. */
static void stage_weights(shelf *s)
{
    list l = linear_words(s), q = squares(s, &l), x = positions(s, true, false), f = functions(s, false);
    add_product(s, &q, &x);
    add_product(s, &f, &x);
}

/* Weighted degree four: linear forms have weight one, terms of the potential and their derivatives two, as in the energy (Kovalevskaya's
 * integral, Toda's, Calogero's). */
static void weighted(shelf *s, const list *u, const list *f)
{
    list ff = squares(s, f);
    add(s, polynomial_of(s, u, 4));
    if (f->n) add(s, product_of(s, 2, (nh_family[]){polynomial_of(s, u, 2), terms_of(s, f)}));
    add(s, terms_of(s, &ff));
}

static void stage_weight_4(shelf *s)
{
    enum { most = 10 };
    list u = {0}, f = {0};
    put_all(&f, s->w->potentials < most ? s->w->potentials : most, s->w->potential);
    if (s->w->frames == s->o->n) put_all(&u, s->w->frames, s->w->frame);
    else put_all(&u, s->o->n, s->o->chart->w);
    weighted(s, &u, &f);
}

/* The same in the forms that the system itself shows, where they are as many as the velocities. */
static void stage_forms_4(shelf *s)
{
    enum { most = 10 };
    list u = {0}, f = {0};
    if (s->w->forms != s->o->n) return;
    put_all(&f, s->w->potentials < most ? s->w->potentials : most, s->w->potential);
    put_all(&u, s->w->forms, s->w->form);
    weighted(s, &u, &f);
}

/* What separation of variables gives (Euler's two centres, Liouville's systems): squares of velocities with coefficients of higher degree in
 * the positions, the energy and the system's functions with lower ones. */
static void stage_separation(shelf *s)
{
    list l = {0}, e = {0}, q = positions(s, false, false), f = functions(s, false);
    bool few = s->w->positions <= 2;
    if (s->w->positions > 3 || s->w->waves) return;
    put_all(&l, s->o->n, s->o->chart->w);
    list v = squares(s, &l);
    put(&e, s->o->E);
    put_all(&e, f.n, f.e);
    add(s, product_of(s, 2, (nh_family[]){terms_of(s, &v), polynomial_of(s, &q, few ? 4 : 2)}));
    add(s, product_of(s, 2, (nh_family[]){terms_of(s, &e), polynomial_of(s, &q, 2)}));
    add(s, polynomial_of(s, &q, 4));
}

/* Squares of positions and velocities with coefficients that depend on time: Ermakov and Lewis. */
static void stage_time(shelf *s)
{
    nh_dag *d = s->o->dag;
    list l = {0}, f = functions(s, true), g = {0};
    nh_ex t = s->o->system->t;
    if (!nh_depends(d, s->o->Lbar, t) || s->w->positions > 3) return;
    put_all(&l, s->w->positions, s->w->position);
    put_all(&l, s->o->n, s->o->chart->w);
    list v = squares(s, &l);
    put(&g, nh_int(d, 1));
    put(&g, t);
    put(&g, nh_powi(d, t, 2));
    for (size_t i = 0; i < f.n; i++) {
        bool timely = nh_depends(d, f.e[i], t);
        for (size_t j = 0; j < s->w->positions; j++) timely &= !nh_depends(d, f.e[i], s->w->position[j]);
        if (timely) put(&g, f.e[i]);
    }
    add_product(s, &v, &g);
    add_product(s, &l, &g);
}

/* Rational: P / v with P linear. */
static void stage_ratios(shelf *s)
{
    nh_dag *d = s->o->dag;
    list l = linear_words(s), q = positions(s, true, false), v = {0};
    for (size_t i = 0; i < s->w->velocities; i++) put(&v, nh_powi(d, s->w->velocity[i], -1));
    for (size_t i = 0; i < s->w->atoms; i++) put(&v, s->w->atom[i]);
    add(s, product_of(s, 3, (nh_family[]){terms_of(s, &l), terms_of(s, &q), terms_of(s, &v)}));
}

static void stage_linear_waves_2(shelf *s)
{
    list l = linear_words(s), w = waves(s, 2);
    if (s->w->waves) add_product(s, &l, &w);
}

static const struct {
    const char *name;
    void (*build)(shelf *);
} stages[] = {
    {"energy, momenta, velocities, forms, positions, terms of the potential", stage_words},
    {"the same times 1, t and the positions", stage_words_positions},
    {"velocities and forms times first harmonics of the angles", stage_linear_waves},
    {"velocities and forms times the system's own functions", stage_linear_functions},
    {"energy, momenta and forms times positions and the system's own functions", stage_functions},
    {"total degree 2 times the system's own functions", stage_degree_2},
    {"quadratic forms times positions", stage_weights},
    {"weighted degree 4 in the frame of the kinetic energy", stage_weight_4},
    {"weighted degree 4 in the system's own forms", stage_forms_4},
    {"squares of velocities times positions of higher degree, energy and functions times lower", stage_separation},
    {"squares of positions and velocities times functions of time", stage_time},
    {"squares of the frame times lengths and first harmonics", stage_frame},
    {"ratios of velocities", stage_ratios},
    {"total degree 3", stage_degree_3},
    {"quadratic forms times first harmonics", stage_quadratic_waves},
    {"velocities and forms times second harmonics", stage_linear_waves_2},
    {"total degree 4", stage_degree_4},
    {"total degree 6", stage_degree_6},
};

bool nh_stage_at(nh_arena *arena, const nh_model *o, const nh_dictionary *w, size_t index, nh_stage *out)
{
    if (index >= sizeof stages / sizeof *stages) return false;
    shelf s = {arena, o, w, nh_arena_alloc(arena, most_families * sizeof(nh_family)), 0};
    stages[index].build(&s);
    *out = (nh_stage){stages[index].name, s.count, s.family};
    return true;
}

nh_family nh_stage_pencil_base(nh_arena *arena, const nh_model *o, const nh_dictionary *w, size_t base)
{
    enum { most_with_waves = 110 };
    shelf s = {arena, o, w, NULL, 0};
    if (base >= NH_PENCIL_PLAIN) {
        list l = {0};
        if (w->frames == o->n) l = frame_products(&s, base > NH_PENCIL_PLAIN);
        return terms_of(&s, &l);
    }
    list l = {0}, v = waves(&s, 1), q = positions(&s, false, false), f = functions(&s, false);
    put_all(&l, w->velocities, w->velocity);
    if (base == 2) put_all(&l, w->frames, w->frame);
    if (base == 2) put_all(&l, w->forms, w->form);
    size_t words_count = l.n;
    for (size_t i = 0; i < words_count && base > 0 && words_count * v.n <= most_with_waves; i++)
        for (size_t j = 0; j < v.n; j++) put(&l, nh_mul(o->dag, l.e[i], v.e[j]));
    if (base < 2) return terms_of(&s, &l);
    put_all(&l, q.n, q.e);
    put_all(&l, f.n, f.e);
    put_all(&l, w->momenta, w->momentum);
    return terms_of(&s, &l);
}
