/* Truncated power series modulo a prime (the equations: jet_ring.h).
 *
 * Once for a ring: (1) the exponents e with |e| <= order are listed, by |e| and then in lexicographic order; (2)
 * `before` counts them, so that an exponent finds its index by m additions instead of a search; (3) for each e all
 * pairs e = left + right are written down, of which a product is one sum; (4) `up` holds the index of e + 1_k, for
 * derivatives.
 *
 *   two variables of weight 1, order 2:            c_e is the coefficient of z^e
 *
 *     index      0     1     2     3     4     5        first[|e|] = 0, 1, 3, 6
 *     exponent  00    01    10    02    11    20
 *     |e|        0     1     1     2     2     2
 *
 *     pairs of 11:  (00, 11) (10, 01) (01, 10) (11, 00)      (a b)_11 = a_00 b_11 + a_10 b_01 + a_01 b_10 + a_11 b_00
 *
 * Coefficients by increasing |e| are computed from those of lower |e| only: functions need one pass and no iteration.
 */
#include "exact/jet_ring.h"

#include <stdlib.h>
#include <string.h>

#include "exact/row_sum.h"

/* ---- exponents ---- */

/* Exponents of one weighted degree, in lexicographic order. */
static size_t list(size_t variables, const size_t *weight, size_t left, uint8_t *current, size_t k, uint8_t *out,
                   size_t most)
{
    if (k + 1 == variables) {
        if (left % weight[k]) return 0;
        current[k] = (uint8_t)(left / weight[k]);
        if (out) memcpy(out, current, variables);
        return 1;
    }
    size_t count = 0;
    for (size_t e = 0; e * weight[k] <= left && count <= most; e++) {
        current[k] = (uint8_t)e;
        count +=
            list(variables, weight, left - e * weight[k], current, k + 1, out ? out + count * variables : NULL, most);
    }
    return count;
}

size_t nh_jet_ring_size(size_t variables, const size_t *weight, size_t order, size_t most)
{
    if (order > UINT8_MAX) return SIZE_MAX;
    if (variables == 0) return 1;
    uint8_t *current = nh_alloc(variables);
    size_t size = 0;
    for (size_t degree = 0; degree <= order && size <= most; degree++)
        size += list(variables, weight, degree, current, 0, NULL, most);
    nh_free(current);
    return size <= most ? size : SIZE_MAX;
}

/* e| = sum_k weight_k e_k. */
static size_t degree_of(const nh_jet_ring *r, const uint8_t *e)
{
    size_t degree = 0;
    for (size_t k = 0; k < r->variables; k++) degree += e[k] * r->weight[k];
    return degree;
}

/* before[k][left][x]: how many exponents e_k, e_(k+1).. of weighted degree `left` have e_k < x. */
static uint32_t *before(const nh_jet_ring *r, size_t k, size_t left)
{
    return r->before + (k * (r->order + 1) + left) * (r->order + 2);
}

static void count_before(nh_jet_ring *r)
{
    r->before = nh_arena_alloc(r->arena, (r->variables + 1) * (r->order + 1) * (r->order + 2) * sizeof *r->before);
    for (size_t k = r->variables; k-- > 0;)
        for (size_t left = 0; left <= r->order; left++) {
            uint32_t *own = before(r, k, left), sum = 0;
            for (size_t x = 0; x * r->weight[k] <= left; x++) {
                size_t rest = left - x * r->weight[k];
                sum += k + 1 < r->variables ? before(r, k + 1, rest)[rest / r->weight[k + 1] + 1] : rest == 0;
                own[x + 1] = sum;
            }
        }
}

/* The exponents of lower |e|, and for each k those that agree with e up to k - 1 and have a smaller e_k. */
size_t nh_jet_ring_find(const nh_jet_ring *r, const uint8_t *e)
{
    size_t left = degree_of(r, e), at = r->first[left];
    for (size_t k = 0; k < r->variables; k++) {
        at += before(r, k, left)[e[k]];
        left -= e[k] * r->weight[k];
    }
    return at;
}

/* exponent, degree, first and variables_in: all degrees, one after another. */
static void list_exponents(nh_jet_ring *r)
{
    uint8_t *current = nh_alloc(r->variables + 1);
    size_t at = 0;
    for (size_t degree = 0; degree <= r->order; degree++) {
        r->first[degree] = at;
        size_t more = r->variables ? list(r->variables, r->weight, degree, current, 0, r->exponent + at * r->variables,
                                          SIZE_MAX - 1)
                                   : degree == 0;
        for (size_t i = 0; i < more; i++, at++) {
            r->degree[at] = degree;
            for (size_t k = 0; k < r->variables; k++)
                if (r->exponent[at * r->variables + k]) r->variables_in[at] |= UINT32_C(1) << k % 32;
        }
    }
    r->first[r->order + 1] = at;
    nh_free(current);
}

/* Codes of exponents: the sum of e_k stride_k, where stride_k is the number of codes of the variables before; and a
 * table of their indices. */
typedef struct {
    size_t *stride;
    uint32_t *index; /* NULL: there are too many codes */
} codes;

/* The code of e: codes of sums are sums of codes, as long as no e_k exceeds order/weight_k. */
static size_t code_of(const nh_jet_ring *r, const codes *c, const uint8_t *e)
{
    size_t code = 0;
    for (size_t k = 0; k < r->variables; k++) code += e[k] * c->stride[k];
    return code;
}

static codes number_codes(const nh_jet_ring *r)
{
    enum { most_codes = 1 << 21 };
    codes c = {.stride = nh_alloc_array(r->variables + 1, sizeof *c.stride)};
    size_t count = 1;
    for (size_t k = 0; k < r->variables && count <= most_codes; k++) {
        c.stride[k] = count;
        count *= r->order / r->weight[k] + 1;
    }
    if (count > most_codes) return c;
    c.index = nh_alloc_array(count, sizeof *c.index);
    for (size_t e = 0; e < r->size; e++) c.index[code_of(r, &c, r->exponent + e * r->variables)] = (uint32_t)e;
    return c;
}

/* The number of left exponents that are nowhere larger than the sums. */
static size_t count_pairs(const nh_jet_ring *r)
{
    size_t count = 0;
    for (size_t e = 0; e < r->size; e++) {
        size_t own = 1;
        for (size_t k = 0; k < r->variables; k++) own *= (size_t)r->exponent[e * r->variables + k] + 1;
        count += own;
    }
    return count;
}

/* Lists the pairs of one sum, counting up the left exponent; the code of the right one is the difference of codes. */
static size_t list_pairs_of(nh_jet_ring *r, const codes *c, const uint8_t *sum, uint8_t *left, uint8_t *right,
                            size_t count)
{
    size_t m = r->variables, all = c->index ? code_of(r, c, sum) : 0, own = 0;
    memset(left, 0, m + 1);
    for (bool more = true; more; count++) {
        for (size_t k = 0; k < m && !c->index; k++) right[k] = (uint8_t)(sum[k] - left[k]);
        r->left[count] = c->index ? c->index[own] : (uint32_t)nh_jet_ring_find(r, left);
        r->right[count] = c->index ? c->index[all - own] : (uint32_t)nh_jet_ring_find(r, right);
        size_t k = 0;
        for (; k < m && left[k] == sum[k]; k++) {
            own -= left[k] * c->stride[k];
            left[k] = 0;
        }
        more = k < m;
        if (!more) continue;
        left[k]++;
        own += c->stride[k];
    }
    return count;
}

/* The pairs of each sum: all left exponents that are nowhere larger. */
static void list_pairs(nh_jet_ring *r)
{
    size_t m = r->variables, room = count_pairs(r), count = 0;
    uint8_t *left = nh_alloc(m + 1), *right = nh_alloc(m + 1);
    codes c = number_codes(r);
    r->pairs = nh_arena_alloc(r->arena, (r->size + 1) * sizeof *r->pairs);
    r->left = nh_arena_alloc(r->arena, (room + 1) * sizeof *r->left);
    r->right = nh_arena_alloc(r->arena, (room + 1) * sizeof *r->right);
    for (size_t e = 0; e < r->size; e++) {
        r->pairs[e] = count;
        count = list_pairs_of(r, &c, r->exponent + e * m, left, right, count);
    }
    r->pairs[r->size] = count;
    nh_free(c.index);
    nh_free(c.stride);
    nh_free(right);
    nh_free(left);
}

/* up[k][e] = the index of e + 1_k, UINT32_MAX beyond the order. */
static void list_steps(nh_jet_ring *r)
{
    size_t m = r->variables;
    uint8_t *next = nh_alloc(m + 1);
    r->up = nh_arena_alloc(r->arena, (m * r->size + 1) * sizeof *r->up);
    for (size_t k = 0; k < m; k++)
        for (size_t e = 0; e < r->size; e++) {
            memcpy(next, r->exponent + e * m, m);
            next[k]++;
            r->up[k * r->size + e] =
                r->degree[e] + r->weight[k] <= r->order ? (uint32_t)nh_jet_ring_find(r, next) : UINT32_MAX;
        }
    nh_free(next);
}

nh_jet_ring *nh_jet_ring_create(nh_prime field, size_t variables, const size_t *weight, size_t order)
{
    nh_arena *arena = nh_arena_create();
    nh_jet_ring *r = nh_arena_alloc(arena, sizeof *r);
    size_t *own = nh_arena_alloc(arena, (variables + 1) * sizeof *own);
    memcpy(own, weight, variables * sizeof *own);
    *r = (nh_jet_ring){.field = field, .variables = variables, .order = order, .weight = own, .arena = arena};
    r->size = nh_jet_ring_size(variables, weight, order, SIZE_MAX - 1);
    r->exponent = nh_arena_alloc(arena, r->size * variables + 1);
    r->degree = nh_arena_alloc(arena, (r->size + 1) * sizeof *r->degree);
    r->variables_in = nh_arena_alloc(arena, (r->size + 1) * sizeof *r->variables_in);
    r->first = nh_arena_alloc(arena, (order + 2) * sizeof *r->first);
    r->inverse = nh_arena_alloc(arena, (order + 1) * sizeof *r->inverse);
    for (size_t k = 1; k <= order; k++) r->inverse[k] = nh_residue_inverse(field, (nh_residue)k);
    list_exponents(r);
    count_before(r);
    list_pairs(r);
    list_steps(r);
    return r;
}

void nh_jet_ring_free(nh_jet_ring *ring)
{
    if (ring) nh_arena_free(ring->arena);
}

/* ---- linear operations and products ---- */

bool nh_jet_is_constant(const nh_jet_ring *r, const nh_residue *a)
{
    for (size_t e = 1; e < r->size; e++)
        if (a[e]) return false;
    return true;
}

/* The variables on which it depends, as bits.  Most series depend on a few of them, and so does what products and
 * functions make of these: the other coefficients are 0. */
static uint32_t variables_of(const nh_jet_ring *r, const nh_residue *a)
{
    uint32_t all = 0;
    for (size_t e = 1; e < r->size; e++)
        if (a[e]) all |= r->variables_in[e];
    return all;
}

bool nh_jet_is_zero(const nh_jet_ring *r, const nh_residue *a) { return a[0] == 0 && nh_jet_is_constant(r, a); }

void nh_jet_constant(const nh_jet_ring *r, nh_residue c, nh_residue *out)
{
    memset(out, 0, r->size * sizeof *out);
    out[0] = c;
}

void nh_jet_add_multiple(const nh_jet_ring *r, nh_residue *sum, nh_residue c, const nh_residue *a)
{
    nh_residue_add_multiple(r->field, r->size, sum, a, c);
}

void nh_jet_scale(const nh_jet_ring *r, nh_residue *a, nh_residue c) { nh_residue_scale(r->field, r->size, a, c); }

/* Series in one variable of weight 1: out = sum_i a_i z^i b, whose rows are b after so many zeros. */
static void multiply_along_line(const nh_jet_ring *r, const nh_residue *a, const nh_residue *b, nh_residue *out)
{
    size_t n = r->size;
    const nh_residue **row = nh_alloc_array(n, sizeof *row);
    nh_residue *shifted = nh_alloc_array(2 * n, sizeof *shifted);
    memcpy(shifted + n, b, n * sizeof *b);
    for (size_t i = 0; i < n; i++) row[i] = shifted + n - i;
    nh_jet_constant(r, 0, out);
    nh_row_sum_add(r->field, n, out, n, a, row);
    nh_free(shifted);
    nh_free(row);
}

/* Three cases: a constant factor; one variable of weight 1, where rows of a Toeplitz matrix are added by vectors; and
 * the pairs in general, without those exponents whose variables occur in neither factor. */
void nh_jet_mul(const nh_jet_ring *r, const nh_residue *a, const nh_residue *b, nh_residue *out)
{
    enum { short_line = 12 };
    uint32_t of_a = variables_of(r, a), of_b = variables_of(r, b);
    if (!of_a || !of_b) {
        nh_jet_constant(r, 0, out);
        nh_jet_add_multiple(r, out, of_a ? b[0] : a[0], of_a ? a : b);
        return;
    }
    if (r->variables == 1 && r->weight[0] == 1 && r->size > short_line) {
        multiply_along_line(r, a, b, out);
        return;
    }
    for (size_t e = 0; e < r->size; e++) {
        uint64_t sum = 0;
        out[e] = 0;
        if (r->variables_in[e] & ~(of_a | of_b)) continue;
        for (size_t i = r->pairs[e]; i < r->pairs[e + 1]; i++)
            sum = nh_residue_gather(r->field, sum, a[r->left[i]], b[r->right[i]]);
        out[e] = nh_residue_reduce(r->field, sum);
    }
}

static void add_product(const nh_jet_ring *r, nh_residue *sum, const nh_residue *a, const nh_residue *b, bool minus)
{
    if (nh_jet_is_zero(r, a) || nh_jet_is_zero(r, b)) return;
    nh_residue *product = nh_alloc_array(r->size, sizeof *product);
    nh_jet_mul(r, a, b, product);
    nh_jet_add_multiple(r, sum, minus ? (nh_residue)(r->field.p - 1) : 1, product);
    nh_free(product);
}

void nh_jet_add_product(const nh_jet_ring *r, nh_residue *sum, const nh_residue *a, const nh_residue *b)
{
    add_product(r, sum, a, b, false);
}
void nh_jet_sub_product(const nh_jet_ring *r, nh_residue *sum, const nh_residue *a, const nh_residue *b)
{
    add_product(r, sum, a, b, true);
}

/* (da/dz_k)_e = (e_k + 1) a_(e + 1_k) */
void nh_jet_derivative(const nh_jet_ring *r, const nh_residue *a, size_t k, nh_residue *out)
{
    for (size_t e = 0; e < r->size; e++) {
        uint32_t up = r->up[k * r->size + e];
        out[e] = up == UINT32_MAX ? 0 : nh_residue_mul(r->field, a[up], r->exponent[up * r->variables + k]);
    }
}

void nh_jet_euler(const nh_jet_ring *r, const nh_residue *a, nh_residue *out)
{
    for (size_t e = 0; e < r->size; e++) out[e] = nh_residue_mul(r->field, a[e], (nh_residue)r->degree[e]);
}

void nh_jet_euler_inverse(const nh_jet_ring *r, const nh_residue *a, nh_residue at, nh_residue *out)
{
    for (size_t e = 0; e < r->size; e++)
        out[e] = r->degree[e] ? nh_residue_mul(r->field, a[e], r->inverse[r->degree[e]]) : at;
}

/* ---- functions: coefficient by coefficient, by increasing |e| ---- */

void nh_jet_power(const nh_jet_ring *r, const nh_residue *a, nh_residue s, nh_residue at, nh_residue *out)
{
    nh_prime f = r->field;
    nh_jet_constant(r, at, out);
    uint32_t variables = variables_of(r, a);
    if (!variables) return;
    nh_residue *factor = nh_alloc_array((r->order + 1) * (r->order + 1), sizeof *factor),
               lead = nh_residue_inverse(f, a[0]);
    /* a E(y) = s E(a) y:  a_0 |e| y_e = sum over g != 0 of (s |g| - |e - g|) a_g y_(e-g) */
    for (size_t g = 0; g <= r->order; g++)
        for (size_t h = 0; h <= r->order; h++)
            factor[g * (r->order + 1) + h] = nh_residue_sub(f, nh_residue_mul(f, s, (nh_residue)g), (nh_residue)h);
    for (size_t e = 1; e < r->size; e++) {
        uint64_t sum = 0;
        if (r->variables_in[e] & ~variables) continue;
        for (size_t i = r->pairs[e]; i < r->pairs[e + 1]; i++) {
            size_t g = r->left[i], h = r->right[i];
            if (g && a[g] && out[h])
                sum = nh_residue_gather(
                    f, sum, nh_residue_mul(f, a[g], factor[r->degree[g] * (r->order + 1) + r->degree[h]]), out[h]);
        }
        out[e] = nh_residue_mul(f, nh_residue_reduce(f, sum), nh_residue_mul(f, lead, r->inverse[r->degree[e]]));
    }
    nh_free(factor);
}

/* |e| y_e = sum of (E u)_g x_(e-g) */
static nh_residue step(const nh_jet_ring *r, const nh_residue *euler, const nh_residue *x, size_t e)
{
    uint64_t sum = 0;
    for (size_t i = r->pairs[e]; i < r->pairs[e + 1]; i++)
        sum = nh_residue_gather(r->field, sum, euler[r->left[i]], x[r->right[i]]);
    return nh_residue_mul(r->field, nh_residue_reduce(r->field, sum), r->inverse[r->degree[e]]);
}

/* e| y_e = sum over g != 0 of |g| u_g y_(e-g); with g = 0 the term is 0, so that y_e itself does not occur. */
void nh_jet_exponential(const nh_jet_ring *r, const nh_residue *u, nh_residue at, nh_residue *out)
{
    nh_residue *euler = nh_alloc_array(r->size, sizeof *euler);
    nh_jet_euler(r, u, euler);
    nh_jet_constant(r, at, out);
    uint32_t variables = variables_of(r, u);
    for (size_t e = 1; e < r->size; e++)
        if (!(r->variables_in[e] & ~variables)) out[e] = step(r, euler, out, e);
    nh_free(euler);
}

/* E(sin u) = E(u) cos u, E(cos u) = -E(u) sin u, both at once, because each needs the other of lower order. */
void nh_jet_circle(const nh_jet_ring *r, const nh_residue *u, nh_residue sine, nh_residue cosine, nh_residue *sin,
                   nh_residue *cos)
{
    nh_residue *euler = nh_alloc_array(r->size, sizeof *euler);
    nh_jet_euler(r, u, euler);
    nh_jet_constant(r, sine, sin);
    nh_jet_constant(r, cosine, cos);
    uint32_t variables = variables_of(r, u);
    for (size_t e = 1; e < r->size; e++) {
        if (r->variables_in[e] & ~variables) continue;
        nh_residue slope = step(r, euler, cos, e);
        cos[e] = nh_residue_negative(r->field, step(r, euler, sin, e));
        sin[e] = slope;
    }
    nh_free(euler);
}

void nh_jet_integral(const nh_jet_ring *r, const nh_residue *u, const nh_residue *slope, nh_residue at, nh_residue *out)
{
    nh_residue *euler = nh_alloc_array(2 * r->size, sizeof *euler), *rate = euler + r->size;
    nh_jet_euler(r, u, euler);
    nh_jet_mul(r, euler, slope, rate);
    nh_jet_euler_inverse(r, rate, at, out);
    nh_free(euler);
}

/* ---- linear equations ---- */

static void swap_rows(size_t length, nh_residue *a, nh_residue *b)
{
    for (size_t k = 0; k < length; k++) {
        nh_residue x = a[k];
        a[k] = b[k];
        b[k] = x;
    }
}

/* row := row - factor * other, from its entry `from` on */
static void subtract_row(const nh_jet_ring *r, size_t from, size_t length, nh_residue *row, const nh_residue *factor,
                         const nh_residue *other)
{
    for (size_t k = from; k < length; k++) nh_jet_sub_product(r, row + k * r->size, factor, other + k * r->size);
}

/* For each column: a pivot row whose entry is not 0 at the point, that is a unit of the ring; the row over its pivot;
 * the column eliminated from all other rows. An entry without constant term is no unit, and no pivot. */
bool nh_jet_solve(const nh_jet_ring *r, size_t n, nh_residue *M, size_t count, nh_residue *b)
{
    size_t e = r->size;
    nh_residue *inverse = nh_alloc_array(3 * e, sizeof *inverse), *product = inverse + e, *factor = product + e;
    bool regular = true;
    for (size_t c = 0; c < n && regular; c++) {
        size_t p = c;
        while (p < n && !M[(p * n + c) * e]) p++;
        regular = p < n;
        if (!regular) break;
        if (p != c)
            swap_rows(n * e, M + p * n * e, M + c * n * e), swap_rows(count * e, b + p * count * e, b + c * count * e);
        const nh_residue *pivot = M + (c * n + c) * e;
        nh_jet_power(r, pivot, (nh_residue)(r->field.p - 1), nh_residue_inverse(r->field, pivot[0]), inverse);
        for (size_t k = c; k < n + count; k++) {
            nh_residue *entry = k < n ? M + (c * n + k) * e : b + (c * count + k - n) * e;
            nh_jet_mul(r, entry, inverse, product);
            memcpy(entry, product, e * sizeof *entry);
        }
        for (size_t i = 0; i < n; i++) {
            if (i == c || nh_jet_is_zero(r, M + (i * n + c) * e)) continue;
            memcpy(factor, M + (i * n + c) * e, e * sizeof *factor);
            subtract_row(r, c, n, M + i * n * e, factor, M + c * n * e);
            subtract_row(r, 0, count, b + i * count * e, factor, b + c * count * e);
        }
    }
    nh_free(inverse);
    return regular;
}
