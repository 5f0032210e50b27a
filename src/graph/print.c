#include "graph/print.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "graph/dag.h"
#include "graph/declared.h"
#include "graph/function.h"
#include "graph/measure.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/num_long.h"

/* Binding strength of the operator around an expression. */
enum { in_sum = 0, in_product = 1, in_power = 2 };

enum { max_depth = 1000 }; /* far more than anyone reads */

typedef struct {
    nh_dag *dag; /* printing may add a scaled term to the graph; existing nodes do not change */
    nh_text *out;
    int depth;
} printer;

static void put(printer *p, nh_ex e, int context);

static void put_number(printer *p, nh_num x)
{
    nh_num top, bottom;
    nh_num_split(x, &top, &bottom);
    nh_num_write(top, p->out);
    if (nh_num_is(bottom, 1)) return;
    nh_text_add(p->out, "/");
    nh_num_write(bottom, p->out);
}

static void open_if(printer *p, bool needed)
{
    if (needed) nh_text_add(p->out, "(");
}

static void close_if(printer *p, bool needed)
{
    if (needed) nh_text_add(p->out, ")");
}

/* Is the expression written with a leading minus? */
static bool negative(const nh_dag *dag, nh_ex e)
{
    if (nh_kind_of(dag, e) == NH_NUMBER) return nh_num_value(nh_number_of(dag, e)) < 0;
    return nh_kind_of(dag, e) == NH_PRODUCT && nh_num_value(nh_constant_of(dag, e)) < 0;
}

/* ---- products ---- */

typedef struct {
    nh_ex base, exponent;
    int rank;
    bool below;   /* it stands under the fraction bar */
    nh_num power; /* numeric exponent, its sign changed when it is below */
    bool numeric;
} factor;

/* Numbers, then symbols in the order of their declaration, then sums, then functions. */
static int rank_of(const nh_dag *dag, nh_ex e)
{
    switch (nh_kind_of(dag, e)) {
    case NH_NUMBER: return 0;
    case NH_SYMBOL: return 1;
    case NH_SUM: return 3;
    case NH_FUNCTION: return nh_function_of(dag, e) == NH_PI ? 0 : 4;
    default: return 2;
    }
}

static int by_rank(const void *a, const void *b)
{
    const factor *f = a, *g = b;
    if (f->rank != g->rank) return f->rank - g->rank;
    return f->base < g->base ? -1 : f->base > g->base; /* equal ranks keep the order of declaration */
}

static factor *sorted_factors(const nh_dag *dag, nh_ex e, size_t *count)
{
    size_t n = *count = nh_arity(dag, e);
    factor *f = nh_alloc_array(n, sizeof *f);
    for (size_t i = 0; i < n; i++) {
        f[i].base = nh_child(dag, e, i);
        f[i].rank = rank_of(dag, f[i].base);
        f[i].exponent = nh_exponent_of(dag, e, i);
        f[i].numeric = nh_kind_of(dag, f[i].exponent) == NH_NUMBER;
        f[i].below = negative(dag, f[i].exponent) && f[i].numeric;
        if (f[i].numeric) f[i].power = nh_number_of(dag, f[i].exponent);
        if (f[i].below) f[i].power = nh_num_mul(f[i].power, nh_num_int(-1));
    }
    qsort(f, n, sizeof *f, by_rank);
    return f;
}

/* Is it n^(p/q) with a whole n > 0? */
static bool is_root(const nh_dag *dag, const factor *f)
{
    if (nh_kind_of(dag, f->base) != NH_NUMBER || !f->numeric || f->power.q < 2) return false;
    nh_num n = nh_number_of(dag, f->base);
    return n.q == 1 && n.p > 0;
}

/* The first factor after i, on the same side of the fraction bar, with the same power; n if there is none. */
static size_t same_power(const factor *f, size_t n, size_t i, nh_num power, bool below)
{
    size_t j = i + 1;
    while (j < n && !(f[j].numeric && f[j].below == below && nh_num_equal(f[j].power, power))) j++;
    return j;
}

/* sqrt(2)*sqrt(x) is written sqrt(2*x), and sqrt(2)/(2*sqrt(x)) is written 1/sqrt(2*x). */
static void join_roots(nh_dag *dag, factor *f, size_t *count, nh_num *c)
{
    for (size_t i = 0; i < *count;) {
        nh_num n = is_root(dag, &f[i]) ? nh_number_of(dag, f[i].base) : nh_num_int(1);
        size_t j = n.p > 1 ? same_power(f, *count, i, f[i].power, false) : *count;
        if (n.p > 1 && j == *count && nh_num_short(*c) && c->q % n.p == 0) {
            nh_num other = nh_num_add(nh_num_int(1), nh_num_mul(f[i].power, nh_num_int(-1)));
            j = same_power(f, *count, i, other, true);
            if (j < *count) *c = nh_num_mul(*c, n);
        }
        nh_ex joined = j < *count ? nh_mul(dag, f[i].base, f[j].base) : 0;
        if (j == *count || (nh_kind_of(dag, joined) == NH_NUMBER && !nh_num_short(nh_number_of(dag, joined)))) {
            i++;
            continue;
        }
        f[j].base = joined;
        memmove(f + i, f + i + 1, (--*count - i) * sizeof *f);
    }
}

static void put_factor(printer *p, const factor *f)
{
    if (f->numeric && nh_num_is(f->power, 1)) {
        put(p, f->base, in_product);
    } else if (f->numeric && f->power.q == 2 && f->power.p == 1) {
        nh_text_add(p->out, "sqrt(");
        put(p, f->base, in_sum);
        nh_text_add(p->out, ")");
    } else {
        put(p, f->base, in_power);
        nh_text_add(p->out, "^");
        bool wrap = f->numeric && (f->power.q != 1);
        open_if(p, wrap);
        if (f->numeric) put_number(p, f->power);
        else put(p, f->exponent, in_power);
        close_if(p, wrap);
    }
}

static size_t put_factors(printer *p, const factor *f, size_t n, bool below, size_t written)
{
    for (size_t i = 0; i < n; i++) {
        if (f[i].below != below) continue;
        if (written++) nh_text_add(p->out, "*");
        put_factor(p, &f[i]);
    }
    return written;
}

/* The index of a factor that is a sum with a negative term: -z*(x - y) reads better as z*(y - x).  The arity when there
 * is none. */
static size_t find_mixed_sum(const nh_dag *dag, nh_ex e)
{
    size_t n = nh_arity(dag, e);
    for (size_t i = 0; i < n; i++) {
        nh_ex sum = nh_child(dag, e, i);
        nh_ex power = nh_exponent_of(dag, e, i);
        if (nh_kind_of(dag, sum) != NH_SUM || !(nh_is_number(dag, power, 1) || nh_is_number(dag, power, -1))) continue;
        if (nh_num_value(nh_constant_of(dag, sum)) < 0) return i;
        for (size_t k = 0; k < nh_arity(dag, sum); k++)
            if (nh_num_value(nh_coefficient_of(dag, sum, k)) < 0) return i;
    }
    return n;
}

/* Prints a product e without its sign; `negated` (0: none) is a factor that is printed with the opposite sign. */
static void put_product(printer *p, nh_ex e, nh_ex negated)
{
    size_t n, below = 0;
    factor *f = sorted_factors(p->dag, e, &n);
    nh_num c = nh_constant_of(p->dag, e);
    if (nh_num_value(c) < 0) c = nh_num_mul(c, nh_num_int(-1));
    join_roots(p->dag, f, &n, &c);
    for (size_t i = 0; i < n; i++)
        if (negated && f[i].base == negated) f[i].base = nh_neg(p->dag, negated);
    nh_num top, bottom;
    nh_num_split(c, &top, &bottom);
    for (size_t i = 0; i < n; i++) below += f[i].below;
    size_t written = 0;
    if (!nh_num_is(top, 1) || below == n) {
        put_number(p, top);
        written = 1;
    }
    put_factors(p, f, n, false, written);
    bool divided = !nh_num_is(bottom, 1);
    if (below || divided) {
        bool wrap = below + divided > 1;
        nh_text_add(p->out, "/");
        open_if(p, wrap);
        if (divided) put_number(p, bottom);
        put_factors(p, f, n, true, divided);
        close_if(p, wrap);
    }
    nh_free(f);
}

/* ---- sums ---- */

/* Prints one term c * e with its sign: "+ ", "- ", or a bare minus at the front. */
static void put_term(printer *p, nh_num c, nh_ex e, bool first)
{
    nh_dag *dag = p->dag;
    nh_ex scaled = nh_mul(dag, nh_number(dag, c), e);
    bool minus = negative(dag, scaled);
    if (!first) nh_text_add(p->out, minus ? " - " : " + ");
    else if (minus) nh_text_add(p->out, "-");
    if (nh_kind_of(dag, scaled) == NH_PRODUCT) put_product(p, scaled, 0);
    else put(p, minus ? nh_neg(dag, scaled) : scaled, in_product);
}

static void put_sum(printer *p, nh_ex e, nh_num scale)
{
    const nh_dag *dag = p->dag;
    size_t n = nh_arity(dag, e), lead = 0;
    while (lead < n && nh_num_value(nh_num_mul(scale, nh_coefficient_of(dag, e, lead))) < 0) lead++;
    nh_num constant = nh_num_mul(scale, nh_constant_of(dag, e));
    bool constant_first = lead == n && nh_num_value(constant) > 0;
    if (constant_first) put_number(p, constant);
    if (lead == n) lead = 0;
    for (size_t k = 0; k < n; k++) { /* a positive term comes first, if there is one */
        size_t i = k == 0 ? lead : k <= lead ? k - 1 : k;
        put_term(p, nh_num_mul(scale, nh_coefficient_of(dag, e, i)), nh_child(dag, e, i), k == 0 && !constant_first);
    }
    if (constant_first || nh_num_is(constant, 0)) return;
    bool minus = nh_num_value(constant) < 0;
    nh_text_add(p->out, minus ? " - " : " + ");
    put_number(p, minus ? nh_num_mul(constant, nh_num_int(-1)) : constant);
}

static size_t digits_of(int64_t n)
{
    size_t count = 1;
    while ((n /= 10) != 0) count++;
    return count;
}

/* The printed length of a coefficient, about; 1 is not printed. */
static size_t width_of(nh_num c)
{
    if (!nh_num_short(c)) return 20;
    size_t above = c.p == 1 || c.p == -1 ? 0 : 1 + digits_of(c.p);
    return above + (c.q == 1 ? 0 : 1 + digits_of(c.q));
}

/* Can c be multiplied into a sum, and divided out again when the text is read, without numbers that are too long to be
 * exact? */
static bool scales_exactly(const nh_dag *dag, nh_num c, nh_ex sum)
{
    static const double longest = 4e18; /* of the numbers of a 64-bit rational */
    nh_num first = nh_constant_of(dag, sum);
    double size = fabs((double)first.p) * (double)first.q;
    if (!nh_num_short(c) || (c.q == 1 && (c.p == 1 || c.p == -1))) return true;
    for (size_t i = 0; i < nh_arity(dag, sum); i++) {
        nh_num k = nh_coefficient_of(dag, sum, i);
        size = fmax(size, fabs((double)k.p) * (double)k.q);
    }
    return size * fabs((double)c.p) * (double)c.q < longest;
}

/* Is c * (sum) shorter without the parentheses: b - a for -(a - b), x^2/2 - b for (x^2 - 2*b)/2? */
static bool opens_sum(const nh_dag *dag, nh_ex e)
{
    if (nh_kind_of(dag, e) != NH_PRODUCT || nh_arity(dag, e) != 1) return false;
    nh_ex sum = nh_child(dag, e, 0);
    if (nh_kind_of(dag, sum) != NH_SUM || !nh_is_number(dag, nh_exponent_of(dag, e, 0), 1)) return false;
    nh_num scale = nh_constant_of(dag, e);
    if (!scales_exactly(dag, scale, sum)) return false;
    size_t closed = 2 + width_of(scale), open = 0;
    for (size_t i = 0; i < nh_arity(dag, sum); i++) {
        closed += width_of(nh_coefficient_of(dag, sum, i));
        open += width_of(nh_num_mul(scale, nh_coefficient_of(dag, sum, i)));
    }
    closed += width_of(nh_constant_of(dag, sum));
    open += width_of(nh_num_mul(scale, nh_constant_of(dag, sum)));
    return open < closed;
}

static void put_function(printer *p, nh_ex e)
{
    size_t first = nh_declared_put(p->dag, e, p->out);
    if (first == 0) nh_text_add(p->out, nh_function_name(nh_function_of(p->dag, e)));
    size_t last = nh_declared_arguments(p->dag, e);
    if (last == 0) return;
    nh_text_add(p->out, "(");
    for (size_t i = first; i < last; i++) {
        if (i > first) nh_text_add(p->out, ", ");
        put(p, nh_child(p->dag, e, i), in_sum);
    }
    nh_text_add(p->out, ")");
}

static void put_real(printer *p, nh_num x, int context)
{
    nh_num top, bottom;
    nh_num_split(x, &top, &bottom);
    bool wrap =
        context > in_sum && (nh_num_value(x) < 0 || !nh_num_is(bottom, 1) || (context == in_power && !nh_num_short(x)));
    open_if(p, wrap);
    put_number(p, x);
    close_if(p, wrap);
}

/* Prints a sum, or a number times a sum. */
static void put_scaled_sum(printer *p, nh_ex e, int context)
{
    bool scaled = nh_kind_of(p->dag, e) == NH_PRODUCT;
    open_if(p, context > in_sum);
    if (scaled) put_sum(p, nh_child(p->dag, e, 0), nh_constant_of(p->dag, e));
    else put_sum(p, e, nh_num_int(1));
    close_if(p, context > in_sum);
}

static void put_signed_product(printer *p, nh_ex e, int context)
{
    nh_dag *dag = p->dag;
    bool minus = negative(dag, e);
    size_t n = nh_arity(dag, e), mixed = minus ? find_mixed_sum(dag, e) : n;
    if (mixed < n) minus = false;
    bool root = n == 1 && nh_num_is(nh_constant_of(dag, e), 1) && nh_exponent_of(dag, e, 0) == nh_ratio(dag, 1, 2);
    bool wrap = context > in_sum && !root;
    open_if(p, wrap);
    if (minus) nh_text_add(p->out, "-");
    put_product(p, e, mixed < n ? nh_child(dag, e, mixed) : 0);
    close_if(p, wrap);
}

static void put_any(printer *p, nh_ex e, int context)
{
    nh_kind kind = nh_kind_of(p->dag, e);
    if (kind == NH_NUMBER) put_real(p, nh_number_of(p->dag, e), context);
    else if (kind == NH_SYMBOL) nh_text_add(p->out, nh_name_of(p->dag, e));
    else if (kind == NH_FUNCTION) put_function(p, e);
    else if (kind == NH_SUM || opens_sum(p->dag, e)) put_scaled_sum(p, e, context);
    else put_signed_product(p, e, context);
}

static void put(printer *p, nh_ex e, int context)
{
    if (++p->depth > max_depth) nh_text_add(p->out, "...");
    else put_any(p, e, context);
    p->depth--;
}

void nh_print(nh_dag *dag, nh_ex e, nh_text *out)
{
    printer p = {dag, out, 0};
    put(&p, e, in_sum);
}

char *nh_print_string(nh_dag *dag, nh_ex e)
{
    nh_text text;
    nh_text_init(&text);
    nh_print(dag, e, &text);
    char *copy = nh_strdup(nh_text_string(&text));
    nh_text_clear(&text);
    return copy;
}

char *nh_print_short(nh_dag *dag, nh_ex e, double most)
{
    return (double)nh_complexity(dag, e) > most ? NULL : nh_print_string(dag, e);
}
