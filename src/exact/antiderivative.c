/* Closed forms of integrals: f(x) -> F(x) with dF/dx = f, by the parallel Risch algorithm [Bronstein2007] (the
 * candidates: antiderivative.h). It may miss an F; one that it finds is right, because dF/dx = f is an exact
 * identity.
 *
 *      f
 *      |  roots of quotients without denominators
 *      |
 *      read                letters u_i: kernels that depend on x, with the exponents they may have in F
 *      |                   divisors p_j: factors of the denominator, with the power they keep in F (one less than in f)
 *      |
 *      candidates          log p_j, atan or atanh     put_functions_of
 *      |                   of square roots            antiderivative_roots.c
 *      |                   prod u_i^(n_i), and the same over prod p_j^(k_j)     put_monomials
 *      |
 *      combine             f = sum_j c_j dg_j/dx with constants c_j: linear, exact (relation_express.h)
 *      |
 *      by_parts            where this fails: int a L^n dx = A L^n - int A (L^n)' dx, L a logarithm or inverse */
#include "exact/antiderivative_internal.h"

#include "base/memory.h"
#include "exact/normal.h"
#include "exact/relation_express.h"
#include "exact/square.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/measure.h"
#include "graph/node.h"
#include "graph/num.h"

enum { default_terms = 20000, highest = 12 };

static const size_t absent = SIZE_MAX; /* x itself, where f contains x in functions only */

typedef nh_antiderivative_builder builder;
typedef nh_antiderivative_letter letter;
typedef nh_antiderivative_divisor divisor;

/* ---- candidates ---- */

void nh_antiderivative_put(builder *b, nh_ex g)
{
    if (!nh_depends(b->d, g, b->in->x)) return;
    for (size_t i = 0; i < b->count; i++)
        if (b->candidate[i] == g) return;
    if (b->count == NH_ANTIDERIVATIVE_CANDIDATES) b->full = true;
    else b->candidate[b->count++] = g;
}

int nh_antiderivative_sign(const builder *b, nh_ex e)
{
    if (nh_kind_of(b->d, e) != NH_NUMBER) return b->in->sign(b->in->context, e);
    double value = nh_num_value(nh_number_of(b->d, e));
    return (value > 0) - (value < 0);
}

int nh_antiderivative_mostly(const builder *b, nh_ex e)
{
    int sign = nh_antiderivative_sign(b, e);
    return sign || !b->in->mostly ? sign : b->in->mostly(b->in->context, e);
}

void nh_antiderivative_put_logarithm(builder *b, nh_ex p)
{
    nh_dag *d = b->d;
    int sign = nh_antiderivative_sign(b, p);
    if (sign) nh_antiderivative_put(b, nh_call(d, NH_LOG, sign > 0 ? p : nh_neg(d, p)));
    else nh_antiderivative_put(b, nh_call(d, NH_LOG, nh_powi(d, p, 2)));
}

void nh_antiderivative_put_area(builder *b, nh_ex f)
{
    nh_dag *d = b->d;
    nh_ex one = nh_int(d, 1);
    int sign = nh_antiderivative_sign(b, nh_sub(d, one, nh_powi(d, f, 2)));
    if (sign) nh_antiderivative_put(b, nh_call(d, NH_ATANH, sign > 0 ? f : nh_powi(d, f, -1)));
    else nh_antiderivative_put(b, nh_call(d, NH_LOG, nh_powi(d, nh_div(d, nh_add(d, one, f), nh_sub(d, one, f)), 2)));
}

nh_ex nh_antiderivative_root(const builder *b, nh_ex D)
{
    nh_dag *d = b->d;
    nh_ex outside, inside;
    return nh_square_split(d, D, &outside, &inside) ? nh_mul(d, outside, nh_sqrt(d, inside)) : nh_sqrt(d, D);
}

/* ---- the factors of a denominator ---- */

/* A factor's coefficients of 1, u, v, u^2 in two kernels (v = u: in one), out[0] to out[3]; false where it has other
 * terms, or they depend on x. */
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
    int sign = nh_antiderivative_sign(b, D);
    if (nh_is_zero(d, D) || sign == 0) return;
    nh_ex h = nh_antiderivative_root(b, sign > 0 ? D : nh_neg(d, D)),
          f = nh_div(d, nh_add(d, nh_product(d, 3, (nh_ex[]){nh_int(d, 2), c[3], u}), c[1]), h);
    if (sign > 0) nh_antiderivative_put_area(b, f);
    else nh_antiderivative_put(b, nh_call(d, NH_ATAN, f));
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
    int sign = nh_antiderivative_sign(b, D), side = nh_antiderivative_sign(b, k[0]);
    if (nh_is_zero(d, D)) return;
    if (sign > 0)
        nh_antiderivative_put_area(
            b, nh_div(d, nh_mul(d, nh_antiderivative_root(b, D), w), nh_add(d, S, nh_mul(d, k[0], X))));
    if (sign >= 0 || side == 0) return;
    nh_ex h = nh_sqrt(d, nh_neg(d, D)), bottom = nh_add(d, nh_add(d, k[0], X), side > 0 ? h : nh_neg(d, h));
    nh_antiderivative_put(b, nh_call(d, NH_ATAN, nh_div(d, w, bottom)));
}

/* The functions whose derivatives have the divisor p as denominator: its logarithm; where it is quadratic in a
 * letter, put_quadratic; where it is linear in a cosine and its sine, put_turning. */
static void put_functions_of(builder *b, const divisor *p)
{
    nh_ex c[4];
    nh_antiderivative_put_logarithm(b, p->e);
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

/* ---- what f is made of ---- */

/* A factor of the denominator that depends on x, with its power in the denominator of F. */
static void add_divisor(builder *b, nh_ex e, int64_t power, const nh_factor *terms)
{
    if (!nh_depends(b->d, e, b->in->x)) return;
    if (b->divisors == NH_ANTIDERIVATIVE_FACTORS) b->full = true;
    else b->divisor[b->divisors++] = (divisor){e, power, terms};
}

/* The polynomial of a factor as an expression in the kernels. */
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

/* The exponents that the kernel g may have in F. By the derivative of a monomial: a kernel u with u' of degree 0 (x,
 * logarithms) gains one; exponentials keep their exponents, also negative ones; of a root of order q, 1 - q to q - 1
 * are independent; of a sine 0 and 1, as sin^2 = 1 - cos^2. */
static void add_letter(builder *b, size_t g)
{
    const nh_kernel *k = &b->form.kernels.item[g];
    nh_ex e = nh_kernel_power(&b->form.kernels, g, 1);
    int64_t own = b->pieces.exponent[g], degree = degree_of(b, g);
    if (!nh_depends(b->d, e, b->in->x)) return;
    if (b->letters == NH_ANTIDERIVATIVE_KERNELS || degree > highest) {
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

static bool is_root(const builder *b, const nh_kernel *k)
{
    return k->kind == NH_KERNEL_ROOT && nh_depends(b->d, k->atom, b->in->x);
}

static bool is_root_below(const builder *b)
{
    for (size_t j = 0; j < b->pieces.factors; j++)
        for (size_t g = 0; g < b->form.kernels.count && b->pieces.factor[j].power < 0; g++)
            if (is_root(b, &b->form.kernels.item[g]) && degree_in(&b->pieces.factor[j], b->form.kernels.count, g) > 0)
                return true;
    return false;
}

/* f in factors; 1/(a + b sqrt(R)) as (a - b sqrt(R))/(a^2 - b^2 R), whose denominator shows the logarithms. */
static bool factors(builder *b, nh_arena *arena, nh_forms *forms, nh_ex f)
{
    nh_form *form = &b->form;
    bool good = nh_form_make(forms, f, true, form) == NH_FIELD_FINE;
    good = good && nh_pieces_make(form->field, arena, form->value, true, &b->pieces);
    if (!good || !is_root_below(b)) return good;
    form->value = nh_quotient_rationalise(form->field, form->value);
    return nh_quotient_field_state_of(form->field) == NH_FIELD_FINE &&
           nh_pieces_make(form->field, arena, form->value, true, &b->pieces);
}

/* The kernels of f that depend on x, x itself among them, and the factors of its denominator. */
static bool read(builder *b, nh_arena *arena, nh_forms *forms, nh_ex f)
{
    if (!factors(b, arena, forms, f)) return false;
    bool has_x = false, rooted = false;
    for (size_t g = 0; g < b->form.kernels.count; g++) {
        const nh_kernel *k = &b->form.kernels.item[g];
        has_x |= k->kind == NH_KERNEL_PLAIN && k->atom == b->in->x;
        rooted |= is_root(b, k);
        add_letter(b, g);
    }
    if (!has_x && b->letters < NH_ANTIDERIVATIVE_KERNELS)
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
        nh_antiderivative_put(b, so_far);
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

/* In the order in which a relation prefers them: short ones first. */
static void candidates(builder *b)
{
    nh_ex below = nh_int(b->d, 1);
    for (size_t j = 0; j < b->divisors; j++) put_functions_of(b, &b->divisor[j]);
    nh_antiderivative_put_roots(b);
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
    if (nh_antiderivative_sign(b, p) <= 0 || nh_antiderivative_sign(b, q) <= 0) return;
    nh_ex sum = nh_simplify_short(d, nh_add(d, p, q), 0), difference = nh_simplify_short(d, nh_sub(d, p, q), 0);
    if (nh_depends(d, sum, b->in->x) && nh_depends(d, difference, b->in->x)) return;
    *F = nh_add(d, *F,
                nh_product(d, 3, (nh_ex[]){nh_int(d, 2), c[i], nh_call(d, NH_ATANH, nh_div(d, difference, sum))}));
    c[i] = c[j] = nh_int(d, 0);
}

/* c with sum_j c_j dg_j/dx = f, from one exact relation of the n + 1 functions dg_1/dx .. dg_n/dx, f; the logarithms
 * that differ by their sign are joined. */
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
    NH_LIST(product);
    size_t n = nh_products_in(d, f, &product);
    for (size_t i = 0; i < n && i < most; i++)
        for (size_t k = 0; k < nh_arity(d, product[i]); k++) {
            nh_ex base = nh_child(d, product[i], k), x = nh_exponent_of(d, product[i], k);
            bool half = nh_kind_of(d, x) == NH_NUMBER && nh_number_of(d, x).q == 2;
            if (!half || !nh_depends(d, base, in->x)) continue;
            nh_ex D = nh_simplify_short(d, nh_div(d, nh_numerator(d, base), base), 0), outside, inside;
            if (!nh_depends(d, D, in->x) || is_exponential(d, D)) continue;
            if (!nh_square_split_quotient(d, base, &outside, &inside)) continue;
            int sign = in->sign(in->context, outside);
            if (!sign) continue;
            f = nh_substitute_root(d, f, base,
                                   nh_product(d, 3, (nh_ex[]){nh_int(d, sign), outside, nh_sqrt(d, inside)}));
        }
    return f;
}

/* The whole for one f without integration by parts. */
static bool elementary(const nh_integration *in, nh_ex f, nh_ex *F)
{
    f = nh_simplify_short(in->dag, without_fractions_below(in, f), 0);
    *F = nh_mul(in->dag, f, in->x);
    if (!nh_depends(in->dag, f, in->x)) return true;
    builder *b = nh_alloc(sizeof *b);
    *b = (builder){.in = in, .d = in->dag};
    nh_arena *arena = nh_arena_create();
    nh_forms forms;
    nh_forms_init(&forms, in->dag, false, in->max_terms ? in->max_terms : default_terms);
    forms.coarse = true;
    bool found = read(b, arena, &forms, f), done = false;
    if (found && in->elliptic) {
        nh_antiderivative_put_elliptic(b);
        done = b->count > 0 && combine(b, f, F); /* few, before the many that are elementary */
    }
    if (found && !done) candidates(b);
    done = done || (found && !b->full && combine(b, f, F));
    for (int halves = 0; found && !done && in->elliptic && halves <= 1; halves++)
        done = nh_antiderivative_elliptic_quartic(b, f, halves, F);
    nh_form_clear(&b->form);
    nh_forms_clear(&forms);
    nh_arena_free(arena);
    nh_free(b);
    return done;
}

/* The last of the logarithms and inverse functions of x in f, and f's degree in it with the leading coefficient; false:
 * there is none, or f is not such a polynomial. */
static bool leading_part(const nh_integration *in, nh_ex f, nh_ex *L, int64_t *degree, nh_ex *coefficient)
{
    enum { most = 16, highest_degree = 3 };
    nh_dag *d = in->dag;
    NH_LIST(call);
    size_t n = nh_functions_in(d, f, &call);
    *L = 0;
    for (size_t i = 0; i < n && n <= most; i++) {
        nh_function g = nh_function_of(d, call[i]);
        bool inverse = g == NH_LOG || g == NH_ATAN || g == NH_ATANH || g == NH_ASIN || g == NH_ACOS || g == NH_ASINH ||
                       g == NH_ACOSH;
        if (inverse && nh_depends(d, call[i], in->x)) *L = call[i];
    }
    if (!*L) return false;
    nh_ex s = nh_symbol_fresh(d, "L");
    *coefficient = nh_substitute(d, f, 1, L, &s);
    for (*degree = 0; *degree <= highest_degree && nh_depends(d, *coefficient, s); ++*degree)
        *coefficient = nh_simplify_short(d, nh_mul(d, nh_ratio(d, 1, *degree + 1), nh_diff(d, *coefficient, s)), 0);
    return *degree >= 1 && *degree <= highest_degree;
}

/* int a L^n dx = A L^n - int A (L^n)' dx, A = int a dx, where f = a L^n + ..: the rest has a lower degree. */
static bool by_parts(const nh_integration *in, nh_ex f, int depth, nh_ex *F)
{
    nh_dag *d = in->dag;
    nh_ex L, a, A, G;
    int64_t n;
    if (elementary(in, f, F)) return true;
    if (depth == 0 || !leading_part(in, f, &L, &n, &a) || !by_parts(in, a, depth - 1, &A)) return false;
    nh_ex part = nh_mul(d, A, nh_powi(d, L, n)), rest = nh_simplify_short(d, nh_sub(d, f, nh_diff(d, part, in->x)), 0);
    if (!by_parts(in, rest, depth - 1, &G)) return false;
    *F = nh_add(d, part, G);
    return true;
}

bool nh_antiderivative(const nh_integration *in, nh_ex f, nh_ex *F)
{
    enum { most_parts = 4 };
    return by_parts(in, f, most_parts, F);
}

/* log(1 + f) + log(1 - f), or their difference. */
static nh_ex logarithms(nh_dag *d, nh_ex f, bool difference)
{
    nh_ex one = nh_int(d, 1), plus = nh_call(d, NH_LOG, nh_add(d, one, f));
    nh_ex minus = nh_call(d, NH_LOG, nh_sub(d, one, f));
    return difference ? nh_sub(d, plus, minus) : nh_add(d, plus, minus);
}

/* For p = q^2: 2 log q; where q is a sine and its cosine f in the other logarithms: log(1 + f) + log(1 - f); else 0. */
static nh_ex logarithm_of_square(nh_dag *d, nh_ex p, size_t n, const nh_ex *call)
{
    bool power = nh_kind_of(d, p) == NH_PRODUCT && nh_arity(d, p) == 1 && nh_num_is(nh_constant_of(d, p), 1);
    if (!power || !nh_is_number(d, nh_exponent_of(d, p, 0), 2)) return 0;
    nh_ex q = nh_child(d, p, 0), f = 0;
    if (nh_kind_of(d, q) == NH_FUNCTION && nh_function_of(d, q) == NH_SIN) f = nh_call(d, NH_COS, nh_child(d, q, 0));
    for (size_t i = 0; f && i < n; i++)
        if (nh_function_of(d, call[i]) == NH_ATANH && nh_child(d, call[i], 0) == f) return logarithms(d, f, false);
    return nh_mul(d, nh_int(d, 2), nh_call(d, NH_LOG, q));
}

nh_ex nh_antiderivative_factor(nh_dag *d, nh_ex F)
{
    enum { most = 16 };
    NH_LIST(call);
    nh_ex old[most], by[most];
    size_t n = nh_functions_in(d, F, &call), known = 0;
    for (size_t i = 0; i < n && n <= most; i++) {
        nh_function f = nh_function_of(d, call[i]);
        nh_ex p = f == NH_LOG || f == NH_ATANH ? nh_child(d, call[i], 0) : 0;
        nh_ex sum = f == NH_ATANH ? nh_mul(d, nh_ratio(d, 1, 2), logarithms(d, p, true))
                    : p           ? logarithm_of_square(d, p, n, call)
                                  : 0;
        if (!sum) continue;
        old[known] = call[i];
        by[known++] = sum;
    }
    return nh_canonical(d, nh_call(d, NH_EXP, nh_neg(d, nh_substitute(d, F, known, old, by))), 0);
}
