/* gather: see gather.h.
 *
 *      e --> multiplied out in symbols, calls of functions and roots --> gather_shape --+
 *        |        +-> sin a cos b + cos a sin b = sin(a + b), where it saves terms --> .. +--> the shortest, if it is
 *        +-> its parts by themselves ----------------------------------------------------+    proved to be e */
#include "exact/gather.h"

#include "base/progress.h"
#include "exact/gather_internal.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/dag_internal.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"

enum {
    shortest = 4,       /* complexity of what needs no other form */
    longest = 400,      /* of what is left as it is */
    widest = 4,         /* of the searches, which try more and more */
    most_work = 200000, /* steps of each search */
    proof_terms = 2000,
    most_joins = 4 /* angles that are joined, one after another */
};

/* ---- angles ---- */

typedef struct {
    size_t sine, cosine;
} angle;

/* A term with sin a and cos a of a = s b + sigma in terms of sigma and b: sin a = sin sigma cos b + s cos sigma sin b,
 * cos a = cos sigma cos b - s sin sigma sin b. */
static nh_gather_sum turned(nh_gathering *g, const nh_gather_term *t, angle a, angle sigma, angle b, int s)
{
    nh_gather_sum p = nh_gather_room(g, 1), factor[2];
    for (int i = 0; i < 2; i++) {
        factor[i] = nh_gather_room(g, 2);
        factor[i].n = 2;
        for (int j = 0; j < 2; j++) factor[i].t[j].c = nh_num_int(!j ? 1 : !i ? s : -s);
        factor[i].t[0].x[!i ? sigma.sine : sigma.cosine] = factor[i].t[0].x[b.cosine] = 1;
        factor[i].t[1].x[!i ? sigma.cosine : sigma.sine] = factor[i].t[1].x[b.sine] = 1;
        nh_gather_sort(g, &factor[i]);
    }
    int n[2] = {t->x[a.sine], t->x[a.cosine]};
    p.t[p.n++] = *t;
    p.t[0].x[a.sine] = p.t[0].x[a.cosine] = 0;
    if (n[0] < 0 || n[1] < 0 || n[0] + n[1] > 4) g->failed = true;
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < n[i] && !g->failed; k++) p = nh_gather_multiply(g, p, factor[i]);
    return p;
}

/* p with a - s b as an angle in the place of a; false: it has no fewer terms. */
static bool join(nh_gathering *g, nh_gather_sum *p, angle a, angle b, int s)
{
    nh_dag *d = g->dag;
    nh_ex one = nh_child(d, g->kernel[a.sine], 0), other = nh_child(d, g->kernel[b.sine], 0),
          sum = s > 0 ? nh_sub(d, one, other) : nh_add(d, one, other), sine = nh_call(d, NH_SIN, sum);
    /* sin(-u) is -sin(u), and numbers come out of it */
    if (nh_kind_of(d, sine) != NH_FUNCTION || nh_child(d, sine, 0) != sum) return false;
    size_t kernels = g->kernels;
    angle sigma = {.sine = nh_gather_kernel(g, sine)};
    if (!g->failed) sigma.cosine = (size_t)g->cosine[sigma.sine];
    nh_gather_sum q = nh_gather_room(g, 0);
    for (size_t i = 0; i < p->n && !g->failed; i++)
        q = nh_gather_add(g, q, nh_num_int(1), turned(g, &p->t[i], a, sigma, b, s));
    if (!g->failed) q = nh_gather_reduce(g, q, b.sine, b.cosine);
    nh_gather_sum r = g->failed ? q : nh_gather_reduce(g, q, sigma.sine, sigma.cosine);
    if (!g->failed && r.n < q.n) q = r;
    bool fewer = !g->failed && q.n < p->n;
    if (fewer) *p = q;
    else g->kernels = kernels;
    g->failed = false;
    return fewer;
}

/* Does any term have sines or cosines of both angles? */
static bool meet(const nh_gather_sum *p, angle a, angle b)
{
    bool any = false;
    for (size_t i = 0; i < p->n; i++)
        any |= (p->t[i].x[a.sine] || p->t[i].x[a.cosine]) && (p->t[i].x[b.sine] || p->t[i].x[b.cosine]);
    return any;
}

/* A term with an even number of sines and cosines of a, by those of 2 a: sin a cos a = sin(2 a)/2,
 * cos^2 a = (1 + cos(2 a))/2, sin^2 a = (1 - cos(2 a))/2. */
static nh_gather_sum halved(nh_gathering *g, const nh_gather_term *t, angle a, angle two)
{
    nh_gather_sum s = nh_gather_room(g, 1), half[2];
    int x = t->x[a.sine], y = t->x[a.cosine];
    for (int i = 0; i < 2; i++) {
        half[i] = nh_gather_room(g, 2);
        half[i].n = 2;
        half[i].t[0].c = nh_num_ratio(1, 2);
        half[i].t[1].c = nh_num_ratio(i ? 1 : -1, 2);
        half[i].t[1].x[two.cosine] = 1;
        nh_gather_sort(g, &half[i]);
    }
    s.t[s.n++] = *t;
    s.t[0].x[a.sine] = s.t[0].x[a.cosine] = 0;
    if (x % 2) s.t[0].x[two.sine]++, s.t[0].c = nh_num_mul(t->c, nh_num_ratio(1, 2));
    for (int k = 0; k < x / 2; k++) s = nh_gather_multiply(g, s, half[0]);
    for (int k = 0; k < y / 2; k++) s = nh_gather_multiply(g, s, half[1]);
    return s;
}

/* Every term with the double angle; false: there are no fewer terms. */
static bool doubled(nh_gathering *g, nh_gather_sum *p, angle a)
{
    nh_dag *d = g->dag;
    nh_ex sine = nh_call(d, NH_SIN, nh_mul(d, nh_int(d, 2), nh_child(d, g->kernel[a.sine], 0)));
    if (nh_kind_of(d, sine) != NH_FUNCTION) return false;
    for (size_t i = 0; i < p->n; i++) {
        int x = p->t[i].x[a.sine], y = p->t[i].x[a.cosine];
        if (x < 0 || y < 0 || (x + y) % 2 || x + y > 4) return false;
    }
    size_t kernels = g->kernels;
    angle two = {.sine = nh_gather_kernel(g, sine)};
    if (!g->failed) two.cosine = (size_t)g->cosine[two.sine];
    nh_gather_sum q = nh_gather_room(g, 0);
    for (size_t i = 0; i < p->n && !g->failed; i++) q = nh_gather_add(g, q, nh_num_int(1), halved(g, &p->t[i], a, two));
    bool fewer = !g->failed && q.n < p->n;
    if (fewer) *p = q;
    else g->kernels = kernels;
    g->failed = false;
    return fewer;
}

static bool join_any(nh_gathering *g, nh_gather_sum *p)
{
    for (size_t i = 0; i < g->kernels; i++)
        for (size_t j = 0; j < g->kernels; j++) {
            if (i == j || g->cosine[i] < 0 || g->cosine[j] < 0) continue;
            angle a = {i, (size_t)g->cosine[i]}, b = {j, (size_t)g->cosine[j]};
            if (meet(p, a, b) && (join(g, p, a, b, -1) || join(g, p, a, b, 1))) return true;
        }
    for (size_t i = 0; i < g->kernels; i++)
        if (g->cosine[i] >= 0 && doubled(g, p, (angle){i, (size_t)g->cosine[i]})) return true;
    return false;
}

/* ---- a formula ---- */

static void offer(nh_dag *d, nh_ex *best, nh_ex e)
{
    if (nh_gather_cost(d, e) < nh_gather_cost(d, *best) && nh_complexity(d, e) <= nh_complexity(d, *best)) *best = e;
}

/* p, or p without squares of sines, or without those of cosines: which has the fewest terms. */
static nh_gather_sum plainest(nh_gathering *g, nh_gather_sum p)
{
    nh_gather_sum best = p;
    for (int cosines = 0; cosines < 2; cosines++) {
        nh_gather_sum s = p;
        for (size_t k = 0; k < g->kernels && !g->failed; k++) {
            size_t other = g->cosine[k] >= 0 ? (size_t)g->cosine[k] : k;
            if (other != k) s = nh_gather_reduce(g, s, cosines ? other : k, cosines ? k : other);
        }
        if (!g->failed && s.n < best.n) best = s;
        g->failed = false;
    }
    return best;
}

/* The forms of e multiplied out; false: that is too long. */
static bool offer_shapes(nh_dag *d, nh_ex *best, nh_ex e, bool closed)
{
    nh_gathering *g = nh_alloc(sizeof *g);
    g->dag = d;
    g->closed = closed;
    g->arena = nh_arena_create();
    nh_gather_sum p = nh_gather_expand(g, e);
    bool fine = !g->failed;
    if (fine) p = plainest(g, p);
    for (int joined = 0; !g->failed && joined <= most_joins; joined++) {
        for (int width = 2; width <= widest && !g->failed; width++) {
            g->most_work = g->work + most_work;
            nh_ex shape = nh_gather_shape(g, p, width);
            if (!g->failed) offer(d, best, shape);
        }
        if (g->failed || !join_any(g, &p)) break;
    }
    nh_arena_free(g->arena);
    nh_free(g);
    return fine;
}

/* e with its parts gathered: all of them, or those that are not multiplied out: arguments, radicands and what is below
 * fraction bars. */
static nh_ex parts_of(nh_dag *d, nh_ex e, bool all)
{
    nh_kind kind = nh_kind_of(d, e);
    size_t n = nh_arity(d, e);
    if (kind == NH_NUMBER || kind == NH_SYMBOL) return e;
    if (kind == NH_FUNCTION) {
        nh_ex argument[NH_MOST_ARGUMENTS];
        for (size_t i = 0; i < n; i++) argument[i] = nh_gather(d, nh_child(d, e, i));
        return nh_call_any(d, nh_function_of(d, e), argument);
    }
    nh_ex whole = nh_number(d, nh_constant_of(d, e));
    for (size_t i = 0; i < n; i++) {
        nh_ex child = nh_child(d, e, i), x = kind == NH_PRODUCT ? nh_exponent_of(d, e, i) : nh_int(d, 1);
        bool opens = nh_kind_of(d, x) == NH_NUMBER && nh_number_of(d, x).q == 1 && nh_number_of(d, x).p > 0;
        nh_ex part = opens && !all ? parts_of(d, child, false) : nh_gather(d, child);
        if (kind == NH_PRODUCT) whole = nh_mul(d, whole, nh_pow(d, part, nh_gather(d, x)));
        else whole = nh_add(d, whole, nh_mul(d, nh_number(d, nh_coefficient_of(d, e, i)), part));
    }
    return whole;
}

nh_ex nh_gather(nh_dag *d, nh_ex e)
{
    nh_ex known, best = e;
    if (!nh_complexity_within(d, e, longest) || nh_complexity(d, e) <= shortest || nh_interrupted()) return e;
    if (nh_dag_form(d, e, NH_FORM_SHOWN, &known)) return known;
    nh_ex parts = parts_of(d, e, false);
    offer(d, &best, parts);
    if (nh_is_short(d, e) && !offer_shapes(d, &best, parts, false)) {
        offer(d, &best, parts_of(d, e, true));
        offer_shapes(d, &best, best, true);
    }
    if (best != e && nh_normal_is_zero(d, nh_sub(d, best, e), proof_terms) != NH_ZERO) best = e;
    nh_dag_set_form(d, e, NH_FORM_SHOWN, best);
    nh_dag_set_form(d, best, NH_FORM_SHOWN, best);
    return best;
}
