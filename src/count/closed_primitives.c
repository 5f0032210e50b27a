/* Polynomials of a coordinate, a sine or a cosine under roots, and functions whose derivatives have these roots:
 * elementary ones for quadratic polynomials, elliptic integrals, incomplete beta functions for two powers. */

#include "exact/normal.h"
#include "graph/diff.h"
#include "count/closed_words.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"

enum { largest_form = 2000 };

typedef struct {
    const nh_jet_equations *equations;
    nh_dag *dag;
    size_t count, most;
    nh_ex *out;
} list;

static void append(list *l, nh_ex e)
{
    bool there = !e || l->count == l->most;
    for (size_t i = 0; i < l->count && !there; i++) there = l->out[i] == e;
    if (!there) l->out[l->count++] = e;
}

static bool has_coordinates(const nh_jet_equations *x, nh_ex e)
{
    bool has = false;
    for (size_t k = 0; k < x->coordinates && !has; k++) has = nh_depends(x->dag, e, x->coordinate[k]);
    return has;
}

/* a + b z + c z^2 */
typedef struct {
    nh_ex a, b, c;
} quadratic;

static bool read_quadratic(nh_dag *d, nh_ex e, nh_ex z, quadratic *q)
{
    nh_ex zero = nh_int(d, 0), slope = nh_simplify_short(d, nh_diff(d, e, z), largest_form);
    q->c = nh_simplify_short(d, nh_mul(d, nh_ratio(d, 1, 2), nh_diff(d, slope, z)), largest_form);
    q->b = nh_simplify_short(d, nh_substitute(d, slope, 1, &z, &zero), largest_form);
    q->a = nh_simplify_short(d, nh_substitute(d, e, 1, &z, &zero), largest_form);
    return !nh_is_zero(d, q->c) && !nh_depends(d, q->c, z);
}

/* asinh, asin or a logarithm, up to a constant factor; 0: it is not real, or its sign is not known. */
static nh_ex primitive_of_root(const nh_jet_equations *x, const quadratic *q, nh_ex z, nh_ex root)
{
    nh_dag *d = x->dag;
    const nh_model *model = x->model;
    int sign = nh_model_sign(model, q->c);
    nh_ex size = sign < 0 ? nh_neg(d, q->c) : q->c,
          middle = nh_add(d, z, nh_div(d, q->b, nh_mul(d, nh_int(d, 2), q->c)));
    nh_ex rest = nh_sub(d, q->a, nh_div(d, nh_powi(d, q->b, 2), nh_mul(d, nh_int(d, 4), q->c)));
    rest = nh_simplify_short(d, rest, largest_form);
    bool constant = !has_coordinates(x, rest) && !has_coordinates(x, q->c);
    if (!sign || nh_is_zero(d, rest)) return 0;
    if (constant && nh_model_sign(model, rest) > 0)
        return nh_call(d, sign > 0 ? NH_ASINH : NH_ASIN, nh_mul(d, middle, nh_sqrt(d, nh_div(d, size, rest))));
    nh_ex inside = nh_add(d, middle, nh_sqrt(d, nh_simplify_short(d, nh_div(d, root, size), largest_form)));
    return sign > 0 && nh_model_sign(model, inside) > 0 ? nh_call(d, NH_LOG, inside) : 0;
}

/* The primitive of 1/(a + b z + c z^2): an arctangent, or an area function or logarithm; 0: its sign is not known. */
static nh_ex primitive_of_quotient(const nh_jet_equations *x, const quadratic *q, nh_ex z)
{
    nh_dag *d = x->dag;
    nh_ex slope = nh_add(d, q->b, nh_product(d, 3, (nh_ex[]){nh_int(d, 2), q->c, z})), four = nh_int(d, 4);
    nh_ex D = nh_sub(d, nh_product(d, 3, (nh_ex[]){four, q->a, q->c}), nh_powi(d, q->b, 2));
    D = nh_simplify_short(d, D, largest_form);
    int sign = has_coordinates(x, D) || has_coordinates(x, q->c) ? 0 : nh_model_sign(x->model, D);
    if (sign > 0) return nh_call(d, NH_ATAN, nh_simplify_short(d, nh_div(d, slope, nh_sqrt(d, D)), largest_form));
    if (!sign) return 0;
    nh_ex root = nh_sqrt(d, nh_neg(d, D)), inside = nh_div(d, nh_sub(d, slope, root), nh_add(d, slope, root));
    int side = nh_model_sign(x->model, inside);
    return side ? nh_call(d, NH_LOG, side > 0 ? inside : nh_neg(d, inside)) : 0;
}

/* The primitives of 1/`base`, or of a root of it, by one coordinate. */
static void along_coordinates(list *l, nh_ex base, bool root)
{
    const nh_jet_equations *x = l->equations;
    for (size_t k = 0; k < x->coordinates; k++) {
        nh_ex q = x->coordinate[k];
        quadratic p;
        if (q != x->model->system->t && nh_depends(l->dag, base, q) && read_quadratic(l->dag, base, q, &p))
            append(l, root ? primitive_of_root(x, &p, q, base) : primitive_of_quotient(x, &p, q));
    }
}

/* ---- two powers ---- */

/* base = a + b q^n with a and b free of coordinates: b q^n is read from q base', and a is the rest. */
static bool read_binomial(const nh_jet_equations *x, nh_ex base, nh_ex q, int64_t *n, nh_ex *a, nh_ex *b)
{
    enum { least = 3, most = 8 };
    nh_dag *d = x->dag;
    nh_ex rate = nh_mul(d, q, nh_diff(d, base, q));
    for (*n = least; *n <= most; ++*n) {
        nh_ex power = nh_powi(d, q, *n);
        *b = nh_simplify_short(d, nh_div(d, rate, nh_mul(d, nh_int(d, *n), power)), largest_form);
        *a = nh_simplify_short(d, nh_sub(d, base, nh_mul(d, *b, power)), largest_form);
        if (!has_coordinates(x, *a) && !has_coordinates(x, *b)) return true;
    }
    return false;
}

/* The primitive of q^(k - 1)/sqrt(a + b q^n), up to a factor: q^k 2F1(k/n, 1/2; 1 + k/n; -b q^n/a) [DLMF 8.17.7],
 * elementary where 2 k = n.  The others are sums of these and of q^k sqrt(a + b q^n). */
static void along_binomials(list *l, nh_ex base)
{
    const nh_jet_equations *x = l->equations;
    nh_dag *d = l->dag;
    for (size_t i = 0; i < x->coordinates; i++) {
        nh_ex q = x->coordinate[i], a, b;
        int64_t n;
        if (q == x->model->system->t || !nh_depends(d, base, q) || !read_binomial(x, base, q, &n, &a, &b)) continue;
        if (nh_model_sign(x->model, a) <= 0) continue;
        nh_ex argument = nh_neg(d, nh_div(d, nh_mul(d, b, nh_powi(d, q, n)), a)), half = nh_ratio(d, 1, 2);
        for (int64_t k = 1; k < n; k++) {
            quadratic p = {.a = a, .b = nh_int(d, 0), .c = b};
            nh_ex order[] = {nh_ratio(d, k, n), half, nh_ratio(d, k + n, n), argument};
            if (2 * k == n) append(l, primitive_of_root(x, &p, nh_powi(d, q, k), base));
            else append(l, nh_mul(d, nh_powi(d, q, k), nh_call_any(d, NH_HYP2F1, order)));
        }
    }
}

/* ---- angles ---- */

/* The primitives of 1/sqrt(a - a m sin(u)^2) and of the root itself: incomplete elliptic integrals, up to factors. */
static void append_elliptic(list *l, nh_ex angle, nh_ex a, nh_ex product)
{
    const nh_jet_equations *x = l->equations;
    nh_dag *d = l->dag;
    a = nh_simplify_short(d, a, largest_form);
    if (has_coordinates(x, a) || nh_model_sign(x->model, a) <= 0) return;
    nh_ex argument[] = {angle, nh_simplify_short(d, nh_div(d, product, a), largest_form)};
    append(l, nh_call_any(d, NH_ELLIPTIC_F, argument));
    append(l, nh_call_any(d, NH_ELLIPTIC_EINC, argument));
}

/* base = a + b z + c z^2 or a + b z in the wave z = cos(u), sin(u), with no other coordinate. */
typedef enum { NEITHER, LINEAR, SQUARE } power;
static power power_of_wave(const nh_jet_equations *x, nh_ex base, nh_ex wave, quadratic *p)
{
    nh_ex z = nh_symbol(x->dag, "z of a primitive"), e = nh_substitute(x->dag, base, 1, &wave, &z);
    if (has_coordinates(x, e) || !nh_depends(x->dag, e, z)) return NEITHER;
    return read_quadratic(x->dag, e, z, p) ? SQUARE : nh_is_zero(x->dag, p->c) ? LINEAR : NEITHER;
}

/* The primitives for roots of a + c sin(u)^2, a + c cos(u)^2 = (a + c) - c sin(u)^2, a + b cos(u) = (a + b) - 2 b
 * sin(u/2)^2. */
static void along_angle(list *l, nh_ex base, nh_ex angle)
{
    nh_dag *d = l->dag;
    nh_ex of[2] = {nh_call(d, NH_COS, angle), nh_call(d, NH_SIN, angle)};
    for (int i = 0; i < 2; i++) {
        quadratic p;
        power highest = power_of_wave(l->equations, base, of[i], &p);
        if (highest == SQUARE && nh_is_zero(d, p.b)) {
            if (i == 0) append_elliptic(l, angle, nh_add(d, p.a, p.c), p.c);
            else append_elliptic(l, angle, p.a, nh_neg(d, p.c));
        } else if (i == 0 && highest == LINEAR) {
            append_elliptic(l, nh_mul(d, nh_ratio(d, 1, 2), angle), nh_add(d, p.a, p.b), nh_mul(d, nh_int(d, 2), p.b));
        }
    }
}

/* The primitives by the sine and the cosine of an angle: the square of one of them is in `base`, and no other function
 * of a coordinate. */
static void along_circle(list *l, nh_ex base, nh_ex angle)
{
    const nh_jet_equations *x = l->equations;
    nh_dag *d = l->dag;
    nh_ex of[2] = {nh_call(d, NH_COS, angle), nh_call(d, NH_SIN, angle)};
    for (int i = 0; i < 2; i++) {
        quadratic p;
        if (power_of_wave(x, base, of[i], &p) != SQUARE || !nh_is_zero(d, p.b)) continue;
        quadratic other = {.a = nh_add(d, p.a, p.c), .b = p.b, .c = nh_neg(d, p.c)};
        append(l, primitive_of_root(x, &p, of[i], base));
        append(l, primitive_of_root(x, &other, of[1 - i], base));
    }
}

/* Primitives that letters suggest: logarithms of linear bases, integrals along coordinates and circles; those that
 * are not elementary come last. */
static void of_letters(list *l, const nh_closed_letters *letters)
{
    for (size_t i = 0; i < letters->count; i++) {
        const nh_letter *a = &letters->item[i];
        if (a->kind != NH_LETTER_POWER) continue;
        bool linear = nh_kind_of(l->dag, a->base) == NH_SYMBOL || a->linear;
        int sign = linear && a->down > 0 ? nh_model_sign(l->equations->model, a->base) : 0;
        if (sign) append(l, nh_call(l->dag, NH_LOG, sign > 0 ? a->base : nh_neg(l->dag, a->base)));
        if (a->down > 0) along_coordinates(l, a->base, false);
        if (a->root != 2) continue;
        along_coordinates(l, a->base, true);
        along_coordinates(l, nh_numerator(l->dag, a->base), true); /* 1 + (x/y)^2 */
        for (size_t k = 0; k < letters->count; k++)
            if (letters->item[k].kind == NH_LETTER_CIRCLE) along_circle(l, a->base, letters->item[k].base);
    }
    for (size_t i = 0; i < letters->count; i++) {
        if (letters->item[i].kind != NH_LETTER_CIRCLE) continue;
        append(l, nh_call(l->dag, NH_COS, letters->item[i].base));
        append(l, nh_call(l->dag, NH_SIN, letters->item[i].base));
    }
    for (size_t i = 0; i < letters->count; i++) { /* the ones that are not elementary come last */
        const nh_letter *a = &letters->item[i];
        if (a->kind != NH_LETTER_POWER || a->root != 2) continue;
        along_binomials(l, nh_numerator(l->dag, a->base)); /* 1 + 1/y^4 */
        for (size_t k = 0; k < letters->count; k++)
            if (letters->item[k].kind == NH_LETTER_CIRCLE) along_angle(l, a->base, letters->item[k].base);
    }
}

size_t nh_closed_primitives(const nh_model *model, bool time, size_t most, nh_ex *out)
{
    nh_jet_equations *x = nh_jet_equations_create(model, time, false);
    list l = {.equations = x, .dag = x->dag, .most = most, .out = out};
    nh_closed_letters letters = {0};
    if (!x->obstacle) letters = nh_closed_letters_of(x, false, NULL);
    of_letters(&l, &letters);
    nh_free(letters.item);
    nh_jet_equations_free(x);
    return l.count;
}
