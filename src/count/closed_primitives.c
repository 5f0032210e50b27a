/* Quadratic polynomials of a coordinate, a sine or a cosine under roots, and what has their roots as derivatives. */
#include "count/closed_primitives.h"

#include "exact/normal.h"
#include "graph/diff.h"
#include "count/closed_letters.h"

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

/* asinh, asin or a logarithm, up to a constant factor; 0: it is not real, or not of one sign. */
static nh_ex primitive_of_root(const nh_jet_equations *x, const quadratic *q, nh_ex z, nh_ex root)
{
    nh_dag *d = x->dag;
    const nh_model *o = x->model;
    int sign = nh_model_sign(o, q->c);
    nh_ex size = sign < 0 ? nh_neg(d, q->c) : q->c,
          middle = nh_add(d, z, nh_div(d, q->b, nh_mul(d, nh_int(d, 2), q->c)));
    nh_ex rest = nh_sub(d, q->a, nh_div(d, nh_powi(d, q->b, 2), nh_mul(d, nh_int(d, 4), q->c)));
    rest = nh_simplify_short(d, rest, largest_form);
    bool constant = !has_coordinates(x, rest) && !has_coordinates(x, q->c);
    if (!sign || nh_is_zero(d, rest)) return 0;
    if (constant && nh_model_sign(o, rest) > 0)
        return nh_call(d, sign > 0 ? NH_ASINH : NH_ASIN, nh_mul(d, middle, nh_sqrt(d, nh_div(d, size, rest))));
    nh_ex inside = nh_add(d, middle, nh_sqrt(d, nh_simplify_short(d, nh_div(d, root, size), largest_form)));
    return sign > 0 && nh_model_sign(o, inside) > 0 ? nh_call(d, NH_LOG, inside) : 0;
}

/* Of a root of `base`, by a coordinate. */
static void along_coordinates(list *l, nh_ex base)
{
    const nh_jet_equations *x = l->equations;
    for (size_t k = 0; k < x->coordinates; k++) {
        nh_ex q = x->coordinate[k];
        quadratic p;
        if (q != x->model->system->t && nh_depends(l->dag, base, q) && read_quadratic(l->dag, base, q, &p))
            append(l, primitive_of_root(x, &p, q, base));
    }
}

/* By the sine and the cosine of an angle: the square of one of them is in `base`, and nothing else of a coordinate. */
static void along_circle(list *l, nh_ex base, nh_ex angle)
{
    const nh_jet_equations *x = l->equations;
    nh_dag *d = l->dag;
    nh_ex z = nh_symbol(d, "z of a primitive"), of[2] = {nh_call(d, NH_COS, angle), nh_call(d, NH_SIN, angle)};
    for (int i = 0; i < 2; i++) {
        quadratic p;
        nh_ex e = nh_substitute(d, base, 1, &of[i], &z);
        if (has_coordinates(x, e) || !nh_depends(d, e, z) || !read_quadratic(d, e, z, &p)) continue;
        if (!nh_is_zero(d, p.b)) continue;
        quadratic other = {.a = nh_add(d, p.a, p.c), .b = p.b, .c = nh_neg(d, p.c)};
        append(l, primitive_of_root(x, &p, of[i], base));
        append(l, primitive_of_root(x, &other, of[1 - i], base));
    }
}

static void of_letters(list *l, const nh_letters *letters)
{
    for (size_t i = 0; i < letters->count; i++) {
        const nh_letter *a = &letters->item[i];
        if (a->kind != NH_LETTER_POWER) continue;
        bool linear = nh_kind_of(l->dag, a->base) == NH_SYMBOL || a->linear;
        int sign = linear && a->down > 0 ? nh_model_sign(l->equations->model, a->base) : 0;
        if (sign) append(l, nh_call(l->dag, NH_LOG, sign > 0 ? a->base : nh_neg(l->dag, a->base)));
        if (a->root != 2) continue;
        along_coordinates(l, a->base);
        along_coordinates(l, nh_numerator(l->dag, a->base)); /* 1 + (x/y)^2 */
        for (size_t k = 0; k < letters->count; k++)
            if (letters->item[k].kind == NH_LETTER_CIRCLE) along_circle(l, a->base, letters->item[k].base);
    }
}

size_t nh_closed_primitives(const nh_model *model, bool time, size_t most, nh_ex *out)
{
    nh_jet_equations *x = nh_jet_equations_create(model, time, false);
    list l = {.equations = x, .dag = x->dag, .most = most, .out = out};
    nh_letters letters = {0};
    if (!x->obstacle) letters = nh_letters_of(x, false, NULL);
    of_letters(&l, &letters);
    nh_free(letters.item);
    nh_jet_equations_free(x);
    return l.count;
}
