#include "exact/antiderivative.h"

#include "base/memory.h"
#include "exact/form.h"
#include "exact/normal.h"
#include "exact/relation_express.h"
#include "exact/square.h"
#include "graph/diff.h"

enum { default_terms = 20000, most_candidates = 140, most_kernels = 12, most_factors = 24, highest = 12 };

static const size_t absent = SIZE_MAX; /* x itself, where f contains x in functions only */

/* A kernel that depends on x, and the exponents that it may have in the numerator of F. */
typedef struct {
    size_t index; /* index among the kernels of f, or absent */
    nh_ex e;
    nh_kernel_kind kind;
    int64_t low, high;
} letter;

/* A factor of a denominator. */
typedef struct {
    nh_ex e;
    int64_t power;          /* its exponent in the denominator of F */
    const nh_factor *terms; /* NULL: the factor is a kernel, or the radicand of a root */
} divisor;

typedef struct {
    const nh_integration *in;
    nh_dag *d;
    nh_form form;
    nh_pieces pieces;
    size_t letters, divisors, count;
    letter letter[most_kernels];
    divisor divisor[most_factors];
    nh_ex candidate[most_candidates];
    int64_t degree; /* largest degree of the numerator of F */
    bool full;      /* a list was full */
} builder;

/* ---- candidates ---- */

static void put(builder *b, nh_ex g)
{
    if (!nh_depends(b->d, g, b->in->x)) return;
    for (size_t i = 0; i < b->count; i++)
        if (b->candidate[i] == g) return;
    if (b->count == most_candidates) b->full = true;
    else b->candidate[b->count++] = g;
}

static int sign_of(const builder *b, nh_ex e)
{
    if (nh_kind_of(b->d, e) != NH_NUMBER) return b->in->sign(b->in->context, e);
    double value = nh_num_value(nh_number_of(b->d, e));
    return (value > 0) - (value < 0);
}

/* The sign that decides between a real logarithm and an arctangent, where both are candidates for the two signs of
 * e. */
static int mostly(const builder *b, nh_ex e)
{
    int sign = sign_of(b, e);
    return sign || !b->in->mostly ? sign : b->in->mostly(b->in->context, e);
}

/* log |p| */
static void put_logarithm(builder *b, nh_ex p)
{
    nh_dag *d = b->d;
    int sign = sign_of(b, p);
    if (sign) put(b, nh_call(d, NH_LOG, sign > 0 ? p : nh_neg(d, p)));
    else put(b, nh_call(d, NH_LOG, nh_powi(d, p, 2)));
}

/* atanh f where |f| < 1, atanh 1/f where |f| > 1: the two have one derivative. */
static void put_area(builder *b, nh_ex f)
{
    nh_dag *d = b->d;
    nh_ex one = nh_int(d, 1);
    int sign = sign_of(b, nh_sub(d, one, nh_powi(d, f, 2)));
    if (sign) put(b, nh_call(d, NH_ATANH, sign > 0 ? f : nh_powi(d, f, -1)));
    else put(b, nh_call(d, NH_LOG, nh_powi(d, nh_div(d, nh_add(d, one, f), nh_sub(d, one, f)), 2)));
}

/* Square factors are taken out of the root, whatever their signs: a candidate may have either sign. */
static nh_ex root_of(const builder *b, nh_ex D)
{
    nh_dag *d = b->d;
    nh_ex outside, inside;
    return nh_square_split(d, D, &outside, &inside) ? nh_mul(d, outside, nh_sqrt(d, inside)) : nh_sqrt(d, D);
}

/* ---- the factors of a denominator ---- */

/* A factor's coefficients of 1, u, v, u^2 in two kernels (v = u's number: in one); false where it has other terms, or
   they depend on x. */
static bool coefficients(const builder *b, const nh_factor *f, size_t u, size_t v, nh_ex out[4])
{
    nh_dag *d = b->d;
    size_t width = b->form.kernels.count;
    for (size_t i = 0; i < 4; i++) out[i] = nh_int(d, 0);
    for (size_t i = 0; i < f->terms; i++) {
        const int64_t *x = f->exponent + i * width;
        int64_t p = x[u], q = u == v ? 0 : x[v];
        bool known = p >= 0 && q >= 0 && p + q <= 2 && (q == 0 || p + q == 1);
        if (!known) return false;
        nh_ex c = nh_number(d, f->coefficient[i]);
        for (size_t g = 0; g < width; g++)
            if (g != u && g != v && x[g]) c = nh_mul(d, c, nh_kernel_power(&b->form.kernels, g, x[g]));
        if (nh_depends(d, c, b->in->x)) return false;
        size_t place = q ? 2 : p == 2 ? 3 : (size_t)p;
        out[place] = nh_add(d, out[place], c);
    }
    return true;
}

/* a u^2 + b u + c with h^2 = |b^2 - 4 a c|:  atan((2 a u + b)/h) or atanh of it. */
static void put_quadratic(builder *b, nh_ex u, const nh_ex c[4])
{
    nh_dag *d = b->d;
    nh_ex four = nh_int(d, 4),
          D = nh_simplify_short(d, nh_sub(d, nh_powi(d, c[1], 2), nh_product(d, 3, (nh_ex[]){four, c[3], c[0]})), 0);
    int sign = sign_of(b, D);
    if (nh_is_zero(d, D) || sign == 0) return;
    nh_ex h = root_of(b, sign > 0 ? D : nh_neg(d, D)),
          f = nh_div(d, nh_add(d, nh_product(d, 3, (nh_ex[]){nh_int(d, 2), c[3], u}), c[1]), h);
    if (sign > 0) put_area(b, f);
    else put(b, nh_call(d, NH_ATAN, f));
}

/* p = a + X, X = b cos u + c sin u, w = dp/du, S = b^2 + c^2:
 *
 *     int du/p = -(1/h) atanh(h w/(S + a X)),   h^2 = S - a^2 > 0
 *              =  (1/h) (u + 2 atan(w/(a + h + X))),   h^2 = a^2 - S > 0, h of the sign of a: without jumps */
static void put_turning(builder *b, size_t cosine, size_t sine, const nh_ex k[4])
{
    nh_dag *d = b->d;
    nh_ex C = nh_kernel_power(&b->form.kernels, cosine, 1), s = nh_kernel_power(&b->form.kernels, sine, 1);
    nh_ex X = nh_add(d, nh_mul(d, k[1], C), nh_mul(d, k[2], s)), w = nh_sub(d, nh_mul(d, k[2], C), nh_mul(d, k[1], s));
    nh_ex S = nh_add(d, nh_powi(d, k[1], 2), nh_powi(d, k[2], 2)),
          D = nh_simplify_short(d, nh_sub(d, S, nh_powi(d, k[0], 2)), 0);
    int sign = sign_of(b, D), side = sign_of(b, k[0]);
    if (nh_is_zero(d, D)) return;
    if (sign > 0) put_area(b, nh_div(d, nh_mul(d, root_of(b, D), w), nh_add(d, S, nh_mul(d, k[0], X))));
    if (sign >= 0 || side == 0) return;
    nh_ex h = nh_sqrt(d, nh_neg(d, D)), bottom = nh_add(d, nh_add(d, k[0], X), side > 0 ? h : nh_neg(d, h));
    put(b, nh_call(d, NH_ATAN, nh_div(d, w, bottom)));
}

static void put_functions_of(builder *b, const divisor *p)
{
    nh_ex c[4];
    put_logarithm(b, p->e);
    for (size_t i = 0; i < b->letters && p->terms; i++) {
        const letter *u = &b->letter[i];
        if (u->index == absent) continue;
        if (coefficients(b, p->terms, u->index, u->index, c) && !nh_is_zero(b->d, c[3])) put_quadratic(b, u->e, c);
        size_t partner = b->form.kernels.item[u->index].partner;
        if (u->kind == NH_KERNEL_COS && coefficients(b, p->terms, u->index, partner, c) && nh_is_zero(b->d, c[3]))
            put_turning(b, u->index, partner, c);
    }
    for (size_t i = 0; i < b->letters && !p->terms; i++) /* a cosine or a sine alone */
        if (b->letter[i].kind == NH_KERNEL_COS) {
            size_t sine = b->form.kernels.item[b->letter[i].index].partner;
            nh_ex zero = nh_int(b->d, 0), one = nh_int(b->d, 1);
            if (p->e == b->letter[i].e) put_turning(b, b->letter[i].index, sine, (nh_ex[4]){zero, one, zero, zero});
            if (p->e == nh_kernel_power(&b->form.kernels, sine, 1))
                put_turning(b, b->letter[i].index, sine, (nh_ex[4]){zero, zero, one, zero});
        }
}

/* ---- roots of quadratic polynomials ---- */

/* sqrt(Q) with a polynomial Q in x, or in y = x^(1/n), exp(lambda x), cos(u) or sin(u): then candidates are functions
   of y. */
typedef struct {
    nh_ex x, Q, root, back; /* the variable; back: what it stands for */
    int degree;             /* of Q */
    size_t count;           /* 0: it is x */
    /* from[i] becomes to[i], a function of y; of the other one of sine and cosine only squares are functions of y */
    nh_ex from[2], to[2];
} radical;

/* The degree, 1 or 2, of Q = a x^2 + b x + c; 0 where it is no such polynomial. */
static int coefficients_of(const builder *b, nh_ex x, nh_ex Q, nh_ex out[3])
{
    nh_dag *d = b->d;
    nh_ex zero = nh_int(d, 0), first = nh_diff(d, Q, x), second = nh_simplify_short(d, nh_diff(d, first, x), 0);
    if (nh_depends(d, second, x)) return 0;
    out[0] = nh_simplify_short(d, nh_substitute(d, Q, 1, &x, &zero), 0);
    out[1] = nh_simplify_short(d, nh_substitute(d, first, 1, &x, &zero), 0);
    out[2] = nh_mul(d, nh_ratio(d, 1, 2), second);
    return nh_is_zero(d, second) ? !nh_is_zero(d, out[1]) : 2;
}

static nh_ex back(const builder *b, const radical *r, nh_ex e)
{
    return r->count ? nh_substitute(b->d, e, 1, &r->x, &r->back) : e;
}

/* exp(k log y) as y^k */
static nh_ex with_powers(nh_dag *d, nh_ex e, nh_ex y)
{
    enum { most = 32 };
    nh_ex call[most], by[most];
    size_t n = nh_functions_in(d, e, call, most), count = 0;
    for (size_t i = 0; i < n && i < most; i++) {
        if (nh_function_of(d, call[i]) != NH_EXP || !nh_depends(d, call[i], y)) continue;
        nh_ex k = nh_simplify_short(d, nh_mul(d, y, nh_diff(d, nh_child(d, call[i], 0), y)), 0);
        if (nh_kind_of(d, k) != NH_NUMBER) continue;
        by[count] = nh_pow(d, y, k);
        call[count++] = call[i];
    }
    return nh_substitute(d, e, count, call, by);
}

static nh_ex in_variable(const builder *b, const radical *r, nh_ex e)
{
    nh_dag *d = b->d;
    if (!r->count) return e;
    return nh_simplify_short(d, nh_canonical(d, with_powers(d, nh_substitute(d, e, r->count, r->from, r->to), r->x), 0),
                             0);
}

/* int dx/sqrt(Q): with a > 0 the logarithm of 2 sqrt(a Q) + Q', with a < 0 the arctangent of Q'/(2 sqrt(-a Q)). */
static void put_first_kind(builder *b, const radical *r, const nh_ex k[3])
{
    nh_dag *d = b->d;
    nh_ex two = nh_int(d, 2), slope = back(b, r, nh_add(d, k[1], nh_product(d, 3, (nh_ex[]){two, k[2], r->x})));
    int sign = mostly(b, k[2]);
    if (sign > 0) put_logarithm(b, nh_add(d, nh_product(d, 3, (nh_ex[]){two, root_of(b, k[2]), r->root}), slope));
    if (sign < 0)
        put(b, nh_call(d, NH_ATAN,
                       nh_div(d, slope, nh_product(d, 3, (nh_ex[]){two, root_of(b, nh_neg(d, k[2])), r->root}))));
}

/* int dx/((x - p) sqrt(Q)): with T = 2 Q(p) + Q'(p) (x - p) the area function of T/(2 sqrt(Q(p) Q)), or the arctangent
   for Q(p) < 0; for a Q of degree one, where T = Q(p) + Q, they are twice those of sqrt(Q/Q(p)). */
static void put_third_kind(builder *b, const radical *r, nh_ex p)
{
    nh_dag *d = b->d;
    nh_ex at = nh_simplify_short(d, nh_substitute(d, r->Q, 1, &r->x, &p), 0), slope = nh_diff(d, r->Q, r->x),
          two = nh_int(d, 2);
    slope = nh_simplify_short(d, nh_substitute(d, slope, 1, &r->x, &p), 0);
    int sign = mostly(b, at);
    if (nh_is_zero(d, at) || sign == 0) return;
    nh_ex T = back(b, r, nh_add(d, nh_mul(d, two, at), nh_mul(d, slope, nh_sub(d, r->x, p))));
    nh_ex size = root_of(b, sign > 0 ? at : nh_neg(d, at));
    nh_ex f = r->degree == 1 ? nh_div(d, r->root, size) : nh_div(d, T, nh_product(d, 3, (nh_ex[]){two, size, r->root}));
    if (sign > 0) put_area(b, f);
    else put(b, nh_call(d, NH_ATAN, f));
}

static void put_poles(builder *b, const radical *r, nh_ex p)
{
    nh_dag *d = b->d;
    nh_ex k[3], zero = nh_int(d, 0), slope = nh_simplify_short(d, nh_diff(d, p, r->x), 0);
    if (nh_is_zero(d, slope)) return;
    if (!nh_depends(d, slope, r->x)) {
        put_third_kind(b, r, nh_neg(d, nh_div(d, nh_substitute(d, p, 1, &r->x, &zero), slope)));
    } else if (coefficients_of(b, r->x, p, k) == 2) {
        nh_ex D = nh_simplify_short(
                  d, nh_sub(d, nh_powi(d, k[1], 2), nh_product(d, 3, (nh_ex[]){nh_int(d, 4), k[2], k[0]})), 0),
              two = nh_mul(d, nh_int(d, 2), k[2]);
        if (sign_of(b, D) <= 0) return;
        put_third_kind(b, r, nh_div(d, nh_sub(d, root_of(b, D), k[1]), two));
        put_third_kind(b, r, nh_neg(d, nh_div(d, nh_add(d, root_of(b, D), k[1]), two)));
    }
}

static void put_integrals(builder *b, radical r)
{
    nh_dag *d = b->d;
    nh_ex k[3];
    bool is_exponential = r.count && nh_kind_of(d, r.back) == NH_FUNCTION && nh_function_of(d, r.back) == NH_EXP;
    r.Q = in_variable(b, &r, r.Q);
    if ((r.count && nh_depends(d, r.Q, b->in->x)) || !nh_depends(d, r.Q, r.x)) return;
    r.degree = coefficients_of(b, r.x, r.Q, k);
    if (!r.degree) return;
    if (r.degree == 2) put_first_kind(b, &r, k);
    if (is_exponential) put_third_kind(b, &r, nh_int(d, 0)); /* dx = dy/(lambda y) */
    for (size_t j = 0; j < b->divisors; j++) {
        nh_ex p = in_variable(b, &r, b->divisor[j].e);
        if (!r.count || !nh_depends(d, p, b->in->x)) put_poles(b, &r, p);
    }
}

/* y = exp(lambda x), exp(-lambda x), and their powers: cosh(x) is (1 + exp(2 x))/(2 exp(x)). */
static void put_root_of_exponentials(builder *b, nh_ex Q, nh_ex root, nh_ex exponential)
{
    enum { most_times = 4 };
    nh_dag *d = b->d;
    nh_ex y = nh_symbol_fresh(d, "y"),
          lambda = nh_simplify_short(d, nh_diff(d, nh_child(d, exponential, 0), b->in->x), 0);
    for (int i = 0; i < 2 * most_times && !nh_depends(d, lambda, b->in->x); i++) {
        nh_ex rate = nh_mul(d, nh_int(d, i % 2 ? -(i / 2 + 1) : i / 2 + 1), lambda);
        put_integrals(b, (radical){.x = y,
                                   .Q = Q,
                                   .root = root,
                                   .back = nh_call(d, NH_EXP, nh_mul(d, rate, b->in->x)),
                                   .count = 1,
                                   .from = {b->in->x},
                                   .to = {nh_div(d, nh_call(d, NH_LOG, y), rate)}});
    }
}

/* y = cos u and sin u */
static void put_root_of_waves(builder *b, nh_ex Q, nh_ex root, nh_ex cosine, nh_ex sine)
{
    nh_dag *d = b->d;
    nh_ex y = nh_symbol_fresh(d, "y"), other = nh_sqrt(d, nh_sub(d, nh_int(d, 1), nh_powi(d, y, 2)));
    put_integrals(b, (radical){y, Q, root, cosine, 0, 2, {cosine, sine}, {y, other}});
    put_integrals(b, (radical){y, Q, root, sine, 0, 2, {sine, cosine}, {y, other}});
}

/* y = x^(1/n) */
static void put_root_of_powers(builder *b, nh_ex Q, nh_ex root, int64_t n)
{
    nh_dag *d = b->d;
    nh_ex y = nh_symbol_fresh(d, "y"), log_y = nh_call(d, NH_LOG, y);
    put_integrals(b, (radical){.x = y,
                               .Q = Q,
                               .root = root,
                               .back = nh_pow(d, b->in->x, nh_ratio(d, 1, n)),
                               .count = 1,
                               .from = {b->in->x},
                               .to = {nh_call(d, NH_EXP, nh_mul(d, nh_int(d, n), log_y))}});
}

static void put_root(builder *b, nh_ex Q, nh_ex root)
{
    put_integrals(b, (radical){.x = b->in->x, .Q = Q, .root = root});
    for (size_t i = 0; i < b->letters; i++) {
        const letter *l = &b->letter[i];
        const nh_kernel *k = &b->form.kernels.item[l->index];
        if (l->kind == NH_KERNEL_ROOT && k->atom == b->in->x) put_root_of_powers(b, Q, root, k->unit.q);
        if (l->kind == NH_KERNEL_EXP) put_root_of_exponentials(b, Q, root, l->e);
        if (l->kind == NH_KERNEL_COS)
            put_root_of_waves(b, Q, root, l->e,
                              nh_kernel_power(&b->form.kernels, b->form.kernels.item[l->index].partner, 1));
    }
}

/* The candidates of one polynomial, and of products of two roots. */
static void put_roots(builder *b)
{
    const nh_kernel *k = b->form.kernels.item;
    for (size_t i = 0; i < b->letters; i++) {
        const letter *u = &b->letter[i];
        if (u->kind != NH_KERNEL_ROOT || k[u->index].unit.q != 2) continue;
        put_root(b, k[u->index].atom, u->e);
        for (size_t j = 0; j < i; j++) {
            const letter *v = &b->letter[j];
            if (v->kind == NH_KERNEL_ROOT && k[v->index].unit.q == 2)
                put_root(b, nh_mul(b->d, k[u->index].atom, k[v->index].atom), nh_mul(b->d, u->e, v->e));
        }
    }
}

/* ---- what f is made of ---- */

static void add_divisor(builder *b, nh_ex e, int64_t power, const nh_factor *terms)
{
    if (!nh_depends(b->d, e, b->in->x)) return;
    if (b->divisors == most_factors) b->full = true;
    else b->divisor[b->divisors++] = (divisor){e, power, terms};
}

static nh_ex factor_expression(const builder *b, const nh_factor *f)
{
    nh_dag *d = b->d;
    nh_ex *term = nh_alloc_array(f->terms + 1, sizeof *term);
    for (size_t i = 0; i < f->terms; i++) {
        term[i] = nh_int(d, 1);
        for (size_t g = 0; g < b->form.kernels.count; g++)
            if (f->exponent[i * b->form.kernels.count + g])
                term[i] = nh_mul(d, term[i],
                                 nh_kernel_power(&b->form.kernels, g, f->exponent[i * b->form.kernels.count + g]));
    }
    nh_ex sum = nh_linear(d, f->terms, f->coefficient, term);
    nh_free(term);
    return sum;
}

static int64_t degree_in(const nh_factor *f, size_t width, size_t g)
{
    int64_t most = 0;
    for (size_t i = 0; i < f->terms; i++)
        if (f->exponent[i * width + g] > most) most = f->exponent[i * width + g];
    return most;
}

/* The degree of numerator or denominator in a kernel, whichever is larger. */
static int64_t degree_of(const builder *b, size_t g)
{
    int64_t over = 0, under = 0, own = b->pieces.exponent[g];
    for (size_t j = 0; j < b->pieces.factors; j++) {
        const nh_factor *f = &b->pieces.factor[j];
        int64_t degree = degree_in(f, b->form.kernels.count, g) * f->power;
        if (degree > 0) over += degree;
        else under -= degree;
    }
    if (own > 0) over += own;
    else under -= own;
    return over > under ? over : under;
}

static void add_letter(builder *b, size_t g)
{
    const nh_kernel *k = &b->form.kernels.item[g];
    nh_ex e = nh_kernel_power(&b->form.kernels, g, 1);
    int64_t own = b->pieces.exponent[g], degree = degree_of(b, g);
    if (!nh_depends(b->d, e, b->in->x)) return;
    if (b->letters == most_kernels || degree > highest) {
        b->full = true;
        return;
    }
    letter l = {.index = g, .e = e, .kind = k->kind, .high = degree + (k->kind == NH_KERNEL_PLAIN)};
    if (k->kind == NH_KERNEL_EXP || k->kind == NH_KERNEL_POWER) l.low = own < 0 ? own : 0;
    else if (k->kind == NH_KERNEL_ROOT) l.low = 1 - (int64_t)k->unit.q, l.high = (int64_t)k->unit.q - 1;
    else if (k->kind == NH_KERNEL_SIN) l.high = 1;
    else if (k->kind == NH_KERNEL_COS) l.high += degree_of(b, k->partner); /* sin^2 = 1 - cos^2 */
    if (own < 0 && (k->kind == NH_KERNEL_PLAIN || k->kind == NH_KERNEL_SIN || k->kind == NH_KERNEL_COS))
        add_divisor(b, e, -own - 1, NULL);
    b->letter[b->letters++] = l;
}

/* The kernels of f that depend on x, x itself among them, and the factors of its denominator. */
static bool read(builder *b, nh_arena *arena, nh_forms *forms, nh_ex f)
{
    if (nh_form_make(forms, f, true, &b->form) != NH_FIELD_FINE ||
        !nh_pieces_make(b->form.field, arena, b->form.value, true, &b->pieces))
        return false;
    bool has_x = false, rooted = false;
    for (size_t g = 0; g < b->form.kernels.count; g++) {
        has_x |= b->form.kernels.item[g].kind == NH_KERNEL_PLAIN && b->form.kernels.item[g].atom == b->in->x;
        rooted |=
            b->form.kernels.item[g].kind == NH_KERNEL_ROOT && nh_depends(b->d, b->form.kernels.item[g].atom, b->in->x);
        add_letter(b, g);
    }
    if (!has_x && b->letters < most_kernels)
        b->letter[b->letters++] = (letter){.index = absent, .e = b->in->x, .kind = NH_KERNEL_PLAIN, .high = 1};
    for (size_t j = 0; j < b->pieces.factors; j++) {
        const nh_factor *p = &b->pieces.factor[j];
        if (p->power < 0) add_divisor(b, factor_expression(b, p), -p->power - !rooted, p);
    }
    for (size_t i = 0; i < b->letters; i++)
        if (b->letter[i].kind == NH_KERNEL_ROOT) add_divisor(b, b->form.kernels.item[b->letter[i].index].atom, 0, NULL);
    for (size_t i = 0; i < b->letters; i++) b->degree = b->letter[i].high > b->degree ? b->letter[i].high : b->degree;
    return !b->full;
}

/* All monomials, the shortest first. */
static void put_monomials(builder *b, size_t at, nh_ex so_far, int64_t degree)
{
    if (at == b->letters) {
        put(b, so_far);
        return;
    }
    const letter *l = &b->letter[at];
    for (int64_t n = l->low; n <= l->high; n++) {
        int64_t size = n < 0 ? -n : n;
        if (size + degree > b->degree + 1) continue;
        put_monomials(b, at + 1, n ? nh_mul(b->d, so_far, nh_pow(b->d, l->e, nh_int(b->d, n))) : so_far, degree + size);
    }
}

/* ---- the whole ---- */

static void candidates(builder *b)
{
    nh_ex below = nh_int(b->d, 1);
    for (size_t j = 0; j < b->divisors; j++) put_functions_of(b, &b->divisor[j]);
    put_roots(b);
    put_monomials(b, 0, below, 0);
    for (size_t j = 0; j < b->divisors; j++)
        if (b->divisor[j].power > 0) below = nh_mul(b->d, below, nh_powi(b->d, b->divisor[j].e, -b->divisor[j].power));
    if (!nh_is_number(b->d, below, 1)) put_monomials(b, 0, below, 0);
}

static bool is_logarithm(const builder *b, nh_ex g)
{
    return nh_kind_of(b->d, g) == NH_FUNCTION && nh_function_of(b->d, g) == NH_LOG;
}

/* k (log p - log q) = 2 k atanh((p - q)/(p + q)), which is shorter where one of sum and difference is constant. */
static void join(const builder *b, size_t i, size_t j, nh_ex *c, nh_ex *F)
{
    nh_dag *d = b->d;
    if (!is_logarithm(b, b->candidate[i]) || !is_logarithm(b, b->candidate[j]) || nh_is_zero(d, c[i])) return;
    if (nh_normal_is_zero(d, nh_add(d, c[i], c[j]), 0) != NH_ZERO) return;
    nh_ex p = nh_child(d, b->candidate[i], 0), q = nh_child(d, b->candidate[j], 0);
    if (sign_of(b, p) <= 0 || sign_of(b, q) <= 0) return;
    nh_ex sum = nh_simplify_short(d, nh_add(d, p, q), 0), difference = nh_simplify_short(d, nh_sub(d, p, q), 0);
    if (nh_depends(d, sum, b->in->x) && nh_depends(d, difference, b->in->x)) return;
    *F = nh_add(d, *F,
                nh_product(d, 3, (nh_ex[]){nh_int(d, 2), c[i], nh_call(d, NH_ATANH, nh_div(d, difference, sum))}));
    c[i] = c[j] = nh_int(d, 0);
}

static bool combine(const builder *b, nh_ex f, nh_ex *F)
{
    nh_dag *d = b->d;
    size_t n = b->count + 1;
    nh_ex *rate = nh_alloc_array(n, sizeof *rate), *c = nh_alloc_array(n, sizeof *c);
    for (size_t j = 0; j < b->count; j++) rate[j] = nh_diff(d, b->candidate[j], b->in->x);
    rate[b->count] = f;
    bool found = nh_relation_express(d, n, rate, b->in->constants, b->in->constant, b->in->max_terms, c);
    *F = nh_int(d, 0);
    for (size_t j = 0; j < b->count && found; j++)
        for (size_t i = 0; i < j; i++) join(b, i, j, c, F);
    for (size_t j = 0; j < b->count && found; j++) *F = nh_add(d, *F, nh_mul(d, c[j], b->candidate[j]));
    nh_free(c);
    nh_free(rate);
    return found;
}

static bool is_exponential(const nh_dag *d, nh_ex e)
{
    bool all = nh_kind_of(d, e) == NH_FUNCTION ? nh_function_of(d, e) == NH_EXP : nh_kind_of(d, e) == NH_PRODUCT;
    for (size_t i = 0; nh_kind_of(d, e) == NH_PRODUCT && i < nh_arity(d, e) && all; i++)
        all = is_exponential(d, nh_child(d, e, i));
    return all;
}

/* sqrt(N/D) as sqrt(N D)/|D|, with squares taken out, so that a polynomial stands below the root.  Exponentials
 * stay. */
static nh_ex without_fractions_below(const nh_integration *in, nh_ex f)
{
    enum { most = 64 };
    nh_dag *d = in->dag;
    nh_ex product[most];
    size_t n = nh_products_in(d, f, product, most);
    for (size_t i = 0; i < n && i < most; i++)
        for (size_t k = 0; k < nh_arity(d, product[i]); k++) {
            nh_ex base = nh_child(d, product[i], k), x = nh_exponent_of(d, product[i], k);
            bool half = nh_kind_of(d, x) == NH_NUMBER && nh_number_of(d, x).q == 2;
            if (!half || !nh_depends(d, base, in->x)) continue;
            nh_ex N = nh_numerator(d, base), D = nh_simplify_short(d, nh_div(d, N, base), 0);
            nh_ex outside, inside, both = nh_simplify_short(d, nh_mul(d, N, D), 0);
            if (!nh_depends(d, D, in->x) || is_exponential(d, D)) continue;
            if (!nh_square_split(d, both, &outside, &inside)) continue;
            nh_ex factor = nh_simplify_short(d, nh_div(d, outside, D), 0);
            int sign = in->sign(in->context, factor);
            if (!sign) continue;
            f = nh_substitute_root(d, f, base,
                                   nh_product(d, 3, (nh_ex[]){nh_int(d, sign), factor, nh_sqrt(d, inside)}));
        }
    return f;
}

bool nh_antiderivative(const nh_integration *in, nh_ex f, nh_ex *F)
{
    f = nh_simplify_short(in->dag, without_fractions_below(in, f), 0);
    *F = nh_mul(in->dag, f, in->x);
    if (!nh_depends(in->dag, f, in->x)) return true;
    builder *b = nh_alloc(sizeof *b);
    *b = (builder){.in = in, .d = in->dag};
    nh_arena *arena = nh_arena_create();
    nh_forms forms;
    nh_forms_init(&forms, in->dag, false, in->max_terms ? in->max_terms : default_terms);
    bool found = read(b, arena, &forms, f);
    if (found) candidates(b);
    found = found && !b->full && combine(b, f, F);
    nh_form_clear(&b->form);
    nh_forms_clear(&forms);
    nh_arena_free(arena);
    nh_free(b);
    return found;
}
