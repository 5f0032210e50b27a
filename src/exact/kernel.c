/* The kernels of expressions (kernel.h). They are collected first, because the kernel of sin(x/2) depends on what
 * else is there: a group is all uses of one family and one atom, and its unit is the common denominator of their
 * coefficients.
 *
 *      uses          sin(x/2), cos(x/3), sin(x)        family sin and cos, atom x, coefficients 1/2, 1/3, 1
 *      unit          1/6
 *      kernels       sin(x/6), cos(x/6)                sin(x/2) = 3 sin - 4 sin^3 of x/6
 *
 * A use whose multiple of the unit would be too large leaves the group and gets a kernel of its own. */
#include "exact/kernel.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "graph/dag.h"
#include "graph/dag_internal.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"

enum {
    most_angle = 12,   /* sin(12 a) is written as a polynomial in sin(a), cos(a), sin(13 a) is not */
    most_power = 1000, /* b^1000 is a power, b^1001 a name */
    most_order = 64,   /* b^(1/64) is a root, b^(1/65) a name */
    deepest = 400      /* nesting that the stack surely bears */
};

/* ---- linear forms ---- */

static void add_part(nh_parts *parts, nh_ex atom, nh_num c)
{
    if (nh_num_is(c, 0)) return;
    nh_grow(&parts->item, &parts->capacity, parts->count + 1, sizeof *parts->item);
    parts->item[parts->count++] = (nh_part){atom, c};
}

/* scale * c * atom.  An inexact c belongs to the atom: 0.3 x is not treated as a rational multiple of x. */
static void add_scaled(nh_dag *dag, nh_parts *parts, nh_ex atom, nh_num c, nh_num scale)
{
    nh_num product = nh_num_mul(scale, c);
    if (nh_num_short(product)) {
        add_part(parts, atom, product);
        return;
    }
    bool minus = nh_num_value(c) < 0;
    nh_ex size = nh_number(dag, minus ? nh_num_mul(c, nh_num_int(-1)) : c);
    add_part(parts, nh_mul(dag, size, atom), minus ? nh_num_mul(scale, nh_num_int(-1)) : scale);
}

/* c * (c0 + c1 t1 + ...); the terms of a sum are neither sums nor have coefficients. */
static void split(nh_dag *dag, nh_parts *parts, nh_ex e)
{
    nh_num scale = nh_num_int(1), one = scale;
    if (nh_kind_of(dag, e) == NH_PRODUCT) {
        scale = nh_constant_of(dag, e);
        if (!nh_num_short(scale)) scale = nh_num_int(scale.d < 0 ? -1 : 1);
        e = nh_mul(dag, nh_number(dag, nh_num_inv(scale)), e);
    }
    if (nh_kind_of(dag, e) == NH_SUM) {
        add_scaled(dag, parts, nh_int(dag, 1), nh_constant_of(dag, e), scale);
        for (size_t i = 0; i < nh_arity(dag, e); i++)
            add_scaled(dag, parts, nh_child(dag, e, i), nh_coefficient_of(dag, e, i), scale);
    } else if (nh_kind_of(dag, e) == NH_NUMBER) {
        add_scaled(dag, parts, nh_int(dag, 1), nh_number_of(dag, e), scale);
    } else {
        add_scaled(dag, parts, e, one, scale);
    }
}

void nh_parts_make(nh_dag *dag, bool whole, nh_ex argument, nh_parts *parts)
{
    *parts = (nh_parts){0};
    if (!whole) {
        split(dag, parts, argument);
        return;
    }
    nh_num c = nh_num_int(1);
    if (nh_kind_of(dag, argument) == NH_PRODUCT) c = nh_constant_of(dag, argument);
    if (!nh_num_short(c)) c = nh_num_int(c.d < 0 ? -1 : 1);
    add_part(parts, nh_mul(dag, nh_number(dag, nh_num_inv(c)), argument), c);
}

void nh_kernel_parts(const nh_kernels *kernels, nh_kernel_kind family, nh_ex argument, nh_parts *parts)
{
    nh_parts_make(kernels->dag, kernels->literal && family != NH_KERNEL_POWER, argument, parts);
}

bool nh_quarter_turns(const nh_dag *dag, nh_part part, int64_t *turns)
{
    nh_num quarters = nh_num_mul(part.coefficient, nh_num_int(2));
    *turns = quarters.p;
    return quarters.q == 1 && nh_kind_of(dag, part.atom) == NH_FUNCTION && nh_function_of(dag, part.atom) == NH_PI;
}

nh_exponent_kind nh_exponent_kind_of(const nh_dag *dag, nh_ex exponent)
{
    if (nh_kind_of(dag, exponent) != NH_NUMBER) return NH_EXPONENT_SYMBOLIC;
    nh_num x = nh_number_of(dag, exponent);
    if (!nh_num_short(x) || fabs(nh_num_value(x)) > most_power || x.q > most_order) return NH_EXPONENT_OPAQUE;
    return x.q == 1 ? NH_EXPONENT_WHOLE : NH_EXPONENT_ROOT;
}

nh_ex nh_exponent_number(nh_dag *dag, nh_ex exponent, nh_ex *rest)
{
    nh_parts parts = {0};
    nh_ex number = nh_int(dag, 0), sum = number;
    split(dag, &parts, exponent);
    for (size_t i = 0; i < parts.count; i++) {
        nh_ex *to = nh_is_number(dag, parts.item[i].atom, 1) ? &number : &sum;
        *to = nh_add(dag, *to, nh_mul(dag, nh_number(dag, parts.item[i].coefficient), parts.item[i].atom));
    }
    nh_free(parts.item);
    *rest = sum;
    return number;
}

/* ---- collecting ---- */

void nh_kernels_init(nh_kernels *kernels, nh_dag *dag, bool literal, bool opaque)
{
    *kernels = (nh_kernels){.dag = dag, .literal = literal, .opaque = opaque};
}

void nh_kernels_clear(nh_kernels *kernels)
{
    nh_free(kernels->item);
    nh_free(kernels->use);
    nh_free(kernels->order);
    nh_index_clear(&kernels->seen);
    nh_index_clear(&kernels->plain);
    *kernels = (nh_kernels){0};
}

static size_t add_kernel(nh_kernels *k, nh_kernel kernel)
{
    nh_grow(&k->item, &k->capacity, k->count + 1, sizeof *k->item);
    k->item[k->count] = kernel;
    return k->count++;
}

static void note_plain(nh_kernels *k, nh_ex e)
{
    uint32_t known;
    if (nh_index_get(&k->plain, e, &known)) return;
    size_t i = add_kernel(k, (nh_kernel){.kind = NH_KERNEL_PLAIN, .atom = e, .unit = nh_num_int(1)});
    nh_index_put(&k->plain, e, (uint32_t)i);
}

static nh_num magnitude(nh_num c) { return nh_num_value(c) < 0 ? nh_num_mul(c, nh_num_int(-1)) : c; }

static void note_number(nh_kernels *k, nh_num c)
{
    if (nh_num_short(c)) return;
    if (!isfinite(c.d)) k->broken = true;
    else if (k->opaque) note_plain(k, nh_number(k->dag, magnitude(c)));
}

static bool same_group(const nh_kernel_use *u, const nh_kernel_use *v)
{
    return u->family == v->family && u->base == v->base && u->atom == v->atom;
}

static const nh_kernel_use *find_use(const nh_kernels *k, const nh_kernel_use *like)
{
    for (size_t i = 0; i < k->uses; i++)
        if (same_group(&k->use[i], like) && nh_num_equal(k->use[i].coefficient, like->coefficient)) return &k->use[i];
    return NULL;
}

static void note_use(nh_kernels *k, nh_kernel_kind family, nh_ex base, nh_ex atom, nh_num c)
{
    nh_kernel_use use = {.family = family, .base = base, .atom = atom, .coefficient = magnitude(c)};
    if (find_use(k, &use)) return;
    nh_grow(&k->use, &k->use_capacity, k->uses + 1, sizeof *k->use);
    k->use[k->uses++] = use;
}

static void note_parts(nh_kernels *k, nh_kernel_kind family, nh_ex base, nh_ex argument)
{
    nh_parts parts;
    int64_t turns;
    nh_kernel_parts(k, family, argument, &parts);
    for (size_t i = 0; i < parts.count; i++)
        if (family != NH_KERNEL_SIN || !nh_quarter_turns(k->dag, parts.item[i], &turns))
            note_use(k, family, base, parts.item[i].atom, parts.item[i].coefficient);
    nh_free(parts.item);
}

static void collect(nh_kernels *k, nh_ex e, int depth);

static void collect_power(nh_kernels *k, nh_ex base, nh_ex exponent, int depth)
{
    nh_ex number, rest;
    switch (nh_exponent_kind_of(k->dag, exponent)) {
    case NH_EXPONENT_WHOLE: collect(k, base, depth); break;
    case NH_EXPONENT_ROOT:
        collect(k, base, depth);
        note_use(k, NH_KERNEL_ROOT, 0, base, nh_num_ratio(1, nh_number_of(k->dag, exponent).q));
        break;
    case NH_EXPONENT_OPAQUE: note_plain(k, nh_pow(k->dag, base, exponent)); break;
    case NH_EXPONENT_SYMBOLIC:
        number = nh_exponent_number(k->dag, exponent, &rest);
        if (!nh_is_zero(k->dag, number)) collect_power(k, base, number, depth);
        note_parts(k, NH_KERNEL_POWER, base, rest);
    }
}

static void collect_function(nh_kernels *k, nh_ex e, int depth)
{
    nh_ex a = nh_arity(k->dag, e) ? nh_child(k->dag, e, 0) : 0;
    switch (nh_function_of(k->dag, e)) {
    case NH_SIN:
    case NH_COS:
    case NH_TAN: note_parts(k, NH_KERNEL_SIN, 0, a); break;
    case NH_SINH:
    case NH_COSH:
    case NH_TANH: note_parts(k, k->literal ? NH_KERNEL_SINH : NH_KERNEL_EXP, 0, a); break;
    case NH_EXP: note_parts(k, NH_KERNEL_EXP, 0, a); break;
    case NH_ABS:
        collect(k, a, depth);
        note_use(k, NH_KERNEL_ABS, 0, a, nh_num_int(1));
        break;
    default: note_plain(k, e);
    }
}

const nh_power_rule *nh_dag_power_rule(const nh_dag *dag, nh_ex symbol)
{
    for (size_t i = 0; i < dag->power_count; i++)
        if (dag->power[i].symbol == symbol) return &dag->power[i];
    return NULL;
}

/* The expressions in a symbol's relation come before it. */
static void collect_symbol(nh_kernels *k, nh_ex e, int depth)
{
    const nh_power_rule *rule = nh_dag_power_rule(k->dag, e);
    if (rule) collect(k, rule->value, depth);
    note_plain(k, e);
}

static void collect(nh_kernels *k, nh_ex e, int depth)
{
    uint32_t known;
    if (k->broken || k->too_deep || nh_index_get(&k->seen, e, &known)) return;
    nh_index_put(&k->seen, e, 0);
    nh_kind kind = nh_kind_of(k->dag, e);
    if (depth > deepest) k->too_deep = true;
    else if (kind == NH_NUMBER) note_number(k, nh_number_of(k->dag, e));
    else if (kind == NH_SYMBOL) collect_symbol(k, e, depth + 1);
    else if (kind == NH_FUNCTION) collect_function(k, e, depth + 1);
    else {
        note_number(k, nh_constant_of(k->dag, e));
        for (size_t i = 0; i < nh_arity(k->dag, e); i++) {
            if (kind == NH_PRODUCT) {
                collect_power(k, nh_child(k->dag, e, i), nh_exponent_of(k->dag, e, i), depth + 1);
                continue;
            }
            note_number(k, nh_coefficient_of(k->dag, e, i));
            collect(k, nh_child(k->dag, e, i), depth + 1);
        }
    }
}

void nh_kernels_collect(nh_kernels *kernels, nh_ex e) { collect(kernels, e, 0); }

/* ---- choosing units ---- */

static int64_t most_multiple(const nh_kernels *k, nh_kernel_kind family)
{
    if (family == NH_KERNEL_SIN || family == NH_KERNEL_SINH) return k->literal ? 1 : most_angle;
    return most_power;
}

/* The least common denominator of the group's coefficients, 0 when some multiple of 1/lcd is too large; *worst gets the
 * member, among those not yet settled, with the largest numerator or denominator. */
static int64_t common_denominator(const nh_kernels *k, const nh_kernel_use *group, size_t *worst)
{
    int64_t lcd = 1, height = -1;
    for (size_t i = 0; i < k->uses; i++) {
        const nh_kernel_use *u = &k->use[i];
        if (u->settled || !same_group(u, group)) continue;
        nh_num c = u->coefficient;
        int64_t h = c.p > c.q ? c.p : c.q;
        if (h > height) {
            height = h;
            *worst = i;
        }
        if (lcd) lcd = c.q <= most_power ? lcd / nh_gcd(lcd, c.q) * c.q : 0;
        if (lcd > most_power) lcd = 0;
    }
    double limit = (double)most_multiple(k, group->family);
    for (size_t i = 0; i < k->uses && lcd; i++) {
        const nh_kernel_use *u = &k->use[i];
        if (!u->settled && same_group(u, group) && nh_num_value(u->coefficient) * (double)lcd > limit + 0.5) lcd = 0;
    }
    return group->family == NH_KERNEL_ROOT && lcd > most_order ? 0 : lcd;
}

static size_t make_kernel(nh_kernels *k, const nh_kernel_use *u, nh_num unit)
{
    nh_kernel kernel = {.kind = u->family, .base = u->base, .atom = u->atom, .unit = unit};
    size_t i = add_kernel(k, kernel);
    if (u->family != NH_KERNEL_SIN && u->family != NH_KERNEL_SINH) return i;
    kernel.kind = u->family == NH_KERNEL_SIN ? NH_KERNEL_COS : NH_KERNEL_COSH;
    kernel.partner = i;
    k->item[i].partner = i + 1;
    add_kernel(k, kernel);
    return i;
}

static void settle(nh_kernels *k, size_t i, nh_num unit, size_t kernel)
{
    k->use[i].settled = true;
    k->use[i].unit = unit;
    k->use[i].kernel = kernel;
}

/* A number as an argument is divided by no more than the others demand: sin(3/10) alone is no polynomial in sin(1/10);
 * in coarse tables every argument is. */
static int64_t common_numerator(const nh_kernels *k, const nh_kernel_use *group, int64_t lcd)
{
    int64_t common = 0;
    bool argument = group->family != NH_KERNEL_ROOT && group->family != NH_KERNEL_POWER; /* and no exponent */
    if (!argument || !(k->coarse || nh_is_number(k->dag, group->atom, 1))) return 1;
    for (size_t i = 0; i < k->uses; i++) {
        const nh_kernel_use *u = &k->use[i];
        if (u->settled || !same_group(u, group)) continue;
        int64_t multiple = lcd / u->coefficient.q * u->coefficient.p;
        common = common ? nh_gcd(common, multiple) : multiple;
    }
    return common;
}

/* Members whose multiples are too large get kernels of their own until the rest agrees. */
static void settle_group(nh_kernels *k, size_t first)
{
    nh_kernel_use group = k->use[first];
    size_t worst = first;
    int64_t lcd;
    while (!k->use[first].settled && !(lcd = common_denominator(k, &group, &worst))) {
        nh_num unit = k->use[worst].coefficient;
        settle(k, worst, unit, make_kernel(k, &group, unit));
    }
    if (k->use[first].settled) return;
    nh_num unit = nh_num_ratio(common_numerator(k, &group, lcd), lcd);
    size_t kernel = make_kernel(k, &group, unit);
    for (size_t i = first; i < k->uses; i++)
        if (!k->use[i].settled && same_group(&k->use[i], &group)) settle(k, i, unit, kernel);
}

static int compare(uint64_t a, uint64_t b) { return a < b ? -1 : a > b; }

static int by_identity(const void *left, const void *right)
{
    const nh_kernel *a = left, *b = right;
    int c = compare(a->atom, b->atom);
    if (!c) c = compare(a->kind, b->kind);
    if (!c) c = compare(a->base, b->base);
    if (!c) c = compare((uint64_t)a->unit.q, (uint64_t)b->unit.q);
    return c ? c : compare((uint64_t)a->unit.p, (uint64_t)b->unit.p);
}

/* Leading terms, and with them canonical forms, must not depend on the order in which kernels are found. */
static void sort_kernels(nh_kernels *k)
{
    size_t *place = nh_alloc_array(k->count, sizeof *place);
    k->order = nh_alloc_array(k->count, sizeof *k->order);
    for (size_t i = 0; i < k->count; i++) k->item[i].discovered = i;
    if (k->count) qsort(k->item, k->count, sizeof *k->item, by_identity);
    for (size_t i = 0; i < k->count; i++) {
        place[k->item[i].discovered] = i;
        k->order[k->item[i].discovered] = i;
    }
    for (size_t i = 0; i < k->count; i++) k->item[i].partner = place[k->item[i].partner];
    for (size_t i = 0; i < k->uses; i++) k->use[i].kernel = place[k->use[i].kernel];
    nh_index_clear(&k->plain);
    for (size_t i = 0; i < k->count; i++)
        if (k->item[i].kind == NH_KERNEL_PLAIN) nh_index_put(&k->plain, k->item[i].atom, (uint32_t)i);
    nh_free(place);
}

void nh_kernels_settle(nh_kernels *kernels)
{
    for (size_t i = 0; i < kernels->uses; i++)
        if (!kernels->use[i].settled) settle_group(kernels, i);
    sort_kernels(kernels);
}

/* ---- asking ---- */

size_t nh_kernel_plain(const nh_kernels *kernels, nh_ex e)
{
    uint32_t i = 0;
    if (!nh_index_get(&kernels->plain, e, &i)) abort(); /* collect() has seen everything that is evaluated */
    return i;
}

size_t nh_kernel_find(const nh_kernels *kernels, nh_kernel_kind family, nh_ex base, nh_ex atom, nh_num c,
                      int64_t *multiple)
{
    nh_kernel_use like = {.family = family, .base = base, .atom = atom, .coefficient = c};
    if (family == NH_KERNEL_ROOT) like.coefficient = nh_num_ratio(1, c.q);
    const nh_kernel_use *u = find_use(kernels, &like);
    if (!u) abort(); /* as above */
    *multiple = nh_num_mul(c, nh_num_inv(u->unit)).p;
    return u->kernel;
}

nh_ex nh_kernel_argument(const nh_kernels *kernels, size_t kernel)
{
    const nh_kernel *k = &kernels->item[kernel];
    return k->shown ? k->shown : nh_mul(kernels->dag, nh_number(kernels->dag, k->unit), k->atom);
}

nh_ex nh_kernel_power(const nh_kernels *kernels, size_t kernel, int64_t power)
{
    static const nh_function function[] = {[NH_KERNEL_SIN] = NH_SIN,
                                           [NH_KERNEL_COS] = NH_COS,
                                           [NH_KERNEL_SINH] = NH_SINH,
                                           [NH_KERNEL_COSH] = NH_COSH,
                                           [NH_KERNEL_ABS] = NH_ABS};
    const nh_kernel *k = &kernels->item[kernel];
    nh_dag *dag = kernels->dag;
    nh_ex whole = nh_int(dag, power), base = k->shown ? k->shown : k->atom;
    switch (k->kind) {
    case NH_KERNEL_PLAIN: return nh_pow(dag, base, whole);
    case NH_KERNEL_ROOT: return nh_pow(dag, base, nh_mul(dag, whole, nh_number(dag, k->unit)));
    case NH_KERNEL_POWER: return nh_pow(dag, k->base, nh_mul(dag, whole, nh_kernel_argument(kernels, kernel)));
    case NH_KERNEL_EXP: return nh_call(dag, NH_EXP, nh_mul(dag, whole, nh_kernel_argument(kernels, kernel)));
    default: return nh_pow(dag, nh_call(dag, function[k->kind], nh_kernel_argument(kernels, kernel)), whole);
    }
}
