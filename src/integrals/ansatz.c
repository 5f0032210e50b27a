/* ansatz: families become columns (products of factors) and terms (what is printed), with the matrix between them.
 *
 *     part     one family: columns, terms, map (terms x columns, column-major)
 *     product  of two parts: every column times every column, every term times every term; map = Kronecker product
 *     join     parts side by side; a column or term that two of them have is taken once
 *
 *                        columns of part 1   columns of part 2
 *                      +-------------------+-------------------+
 *         terms of 1   |      map 1        |                   |         to_term: rows of terms that both
 *                      +-------------------+      map 2        |         parts have belong to both blocks
 *         terms of 2   |                   |                   |
 *                      +-------------------+-------------------+
 *
 * [docs/method.md, sec. 4, "Ansatz"] */
#include "integrals/ansatz.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/function.h"

/* One family while it is built: columns, terms and the map between them. */
typedef struct {
    size_t columns, terms;
    nh_column *column;
    nh_ex *term;
    double *map; /* terms x columns */
} part;

typedef struct {
    nh_ansatz *a;
    const nh_model *model;
    const nh_points *points;
    size_t most, factor_capacity;
    bool too_large;
} builder;

static void *take(builder *b, size_t count, size_t size) { return nh_arena_alloc(b->a->arena, (count + 1) * size); }

/* The number of the factor e, which is added where it is new. */
static size_t factor_of(builder *b, nh_ex e)
{
    nh_ansatz *a = b->a;
    for (size_t i = 0; i < a->factors; i++)
        if (a->factor[i] == e) return i;
    nh_grow(&a->factor, &b->factor_capacity, a->factors + 1, sizeof *a->factor);
    a->factor[a->factors] = e;
    return a->factors++;
}

static bool part_alloc(builder *b, part *p, size_t columns, size_t terms)
{
    if (columns > b->most || terms > b->most) b->too_large = true;
    if (b->too_large) return false;
    *p = (part){columns, terms, take(b, columns, sizeof *p->column), take(b, terms, sizeof *p->term),
                take(b, columns * terms, sizeof *p->map)};
    return true;
}

static nh_column column_of(builder *b, size_t count, const size_t *factor)
{
    size_t *copy = take(b, count, sizeof *copy);
    memcpy(copy, factor, count * sizeof *copy);
    return (nh_column){count, copy};
}

/* Middle and half width of an expression over the sample points. */
static void range_of(const builder *b, nh_ex e, double *middle, double *half)
{
    double *value = nh_alloc_array(b->points->count + 1, sizeof *value), low = INFINITY, high = -INFINITY;
    nh_points_evaluate(b->points, b->model, 1, &e, value);
    for (size_t i = 0; i < b->points->count; i++) {
        if (!isfinite(value[i])) continue;
        low = fmin(low, value[i]);
        high = fmax(high, value[i]);
    }
    nh_free(value);
    *middle = low <= high ? (low + high) / 2 : 0;
    *half = high > low ? (high - low) / 2 : 1;
    if (fabs(*middle) < 0.25 * *half) *middle = 0; /* nearly centred: keep parity, and round numbers */
}

/* T_0 .. T_degree of s = (e - middle)/half as expressions, and their coefficients in powers of e, by T_k = 2 s
 * T_(k-1) - T_(k-2): power[i + k (degree + 1)] belongs to e^i in T_k. [Trefethen2013] */
static void chebyshev(builder *b, nh_ex e, size_t degree, nh_ex *T, double *power /* (degree+1)^2, column k: T_k */)
{
    nh_dag *d = b->a->dag;
    double middle, half;
    range_of(b, e, &middle, &half);
    nh_ex s = nh_mul(d, nh_sub(d, e, nh_real(d, middle)), nh_real(d, 1 / half));
    size_t n = degree + 1;
    memset(power, 0, n * n * sizeof *power);
    for (size_t k = 0; k <= degree; k++) {
        if (k < 2) {
            T[k] = k ? s : nh_int(d, 1);
            if (k) power[1 + k * n] = 1 / half;
            power[0 + k * n] = k ? -middle / half : 1;
            continue;
        }
        T[k] = nh_sub(d, nh_mul(d, nh_int(d, 2), nh_mul(d, s, T[k - 1])), T[k - 2]);
        for (size_t i = 0; i < n; i++) {
            double shifted = i ? power[i - 1 + (k - 1) * n] / half : 0;
            power[i + k * n] = 2 * (shifted - middle / half * power[i + (k - 1) * n]) - power[i + (k - 2) * n];
        }
    }
}

/* ---- polynomial: all products of total degree <= degree ---- */

/* The next of all exponents x[0..n-1] with a sum up to the degree, like a counter with carry; 0 after the last one. */
static size_t next_exponents(size_t n, size_t degree, size_t *x)
{
    size_t total = 0;
    for (size_t i = 0; i < n; i++) total += x[i];
    for (size_t i = 0; i < n; i++) {
        if (total < degree) {
            x[i]++;
            return 1;
        }
        total -= x[i];
        x[i] = 0;
    }
    return 0;
}

/* A column is prod_i T_(x_i)(in_i), a term prod_i in_i^(x_i), over the same exponents x in the same order. */
static bool build_polynomial(builder *b, const nh_family *f, part *p)
{
    nh_dag *d = b->a->dag;
    size_t n = f->in_count, degree = f->degree, count = 0, *x = take(b, n, sizeof *x),
           *list = take(b, degree, sizeof *list);
    do count++;
    while (count <= b->most && next_exponents(n, degree, x));
    if (!part_alloc(b, p, count, count)) return false;
    size_t *exponents = take(b, count * n, sizeof *exponents), row = degree + 1;
    nh_ex *T = take(b, n * row, sizeof *T);
    double *power = take(b, n * row * row, sizeof *power);
    for (size_t i = 0; i < n; i++) chebyshev(b, f->in[i], degree, T + i * row, power + i * row * row);
    memset(x, 0, n * sizeof *x);
    for (size_t j = 0; j < count; j++, next_exponents(n, degree, x)) {
        size_t used = 0;
        nh_ex term = nh_int(d, 1);
        memcpy(exponents + j * n, x, n * sizeof *x);
        for (size_t i = 0; i < n; i++) {
            if (x[i]) list[used++] = factor_of(b, T[i * row + x[i]]);
            term = nh_mul(d, term, nh_powi(d, f->in[i], (int64_t)x[i]));
        }
        p->column[j] = column_of(b, used, list);
        p->term[j] = term;
    }
    for (size_t j = 0; j < count; j++) /* product of the one-dimensional maps; T_k has powers <= k only */
        for (size_t r = 0; r < count; r++) {
            double c = 1;
            for (size_t i = 0; i < n && c != 0; i++)
                c *= power[i * row * row + exponents[r * n + i] + exponents[j * n + i] * row];
            p->map[r + j * count] = c;
        }
    return true;
}

/* ---- fourier, chebyshev, terms ---- */

/* n terms as they are: a term is its own column, of one factor (none of the number 1), and the map is the identity. */
static bool build_terms(builder *b, size_t n, const nh_ex *term, part *p)
{
    if (!part_alloc(b, p, n, n)) return false;
    for (size_t j = 0; j < n; j++) {
        size_t factor = nh_is_number(b->a->dag, term[j], 1) ? 0 : factor_of(b, term[j]);
        p->column[j] = column_of(b, !nh_is_number(b->a->dag, term[j], 1), &factor);
        p->term[j] = term[j];
        p->map[j + j * n] = 1;
    }
    return true;
}

static bool build_fourier(builder *b, const nh_family *f, part *p)
{
    nh_dag *d = b->a->dag;
    size_t n = 0, in = f->in_count;
    nh_ex *term = take(b, in * 2 * f->degree + 1, sizeof *term);
    if (f->constant) term[n++] = nh_int(d, 1);
    for (size_t i = 0; i < in; i++)
        for (size_t k = 1; k <= f->degree; k++) {
            nh_ex angle = nh_mul(d, nh_mul(d, nh_int(d, (int64_t)k), f->frequency), f->in[i]);
            term[n++] = nh_call(d, NH_COS, angle);
            term[n++] = nh_call(d, NH_SIN, angle);
        }
    return build_terms(b, n, term, p);
}

/* The columns are T_k by their stable recurrence.  The terms are powers while these are readable; for higher degrees
 * T_2j = 2 T_j^2 - 1 and T_2j+1 = 2 T_j T_j+1 - s, which are short in print and hold outside of [-1, 1] as well (cos(k
 * acos s) does not). */
static bool build_chebyshev(builder *b, const nh_family *f, part *p)
{
    enum { readable = 8 };
    if (f->degree <= readable) return build_polynomial(b, f, p);
    nh_dag *d = b->a->dag;
    size_t n = f->degree + 1;
    nh_ex *T = take(b, n, sizeof *T);
    double *power = take(b, n * n, sizeof *power);
    chebyshev(b, f->in[0], f->degree, T, power);
    if (!build_terms(b, n, T, p)) return false;
    for (size_t k = 2; k < n; k++) {
        nh_ex twice = nh_mul(d, nh_int(d, 2), nh_mul(d, p->term[k / 2], p->term[(k + 1) / 2]));
        p->term[k] = nh_sub(d, twice, T[k % 2]);
    }
    return true;
}

/* ---- products and sums of families ---- */

/* map[(ti, tj), (ci, cj)] = map_x[ti, ci] map_y[tj, cj]; index (i, j) stands at i * (number of j) + j. */
static bool multiply_parts(builder *b, const part *x, const part *y, part *p)
{
    if (!part_alloc(b, p, x->columns * y->columns, x->terms * y->terms)) return false;
    for (size_t i = 0; i < x->columns; i++)
        for (size_t j = 0; j < y->columns; j++) {
            const nh_column *u = &x->column[i], *v = &y->column[j];
            size_t *list = take(b, u->count + v->count, sizeof *list);
            memcpy(list, u->factor, u->count * sizeof *list);
            memcpy(list + u->count, v->factor, v->count * sizeof *list);
            p->column[i * y->columns + j] = (nh_column){u->count + v->count, list};
        }
    for (size_t i = 0; i < x->terms; i++)
        for (size_t j = 0; j < y->terms; j++) p->term[i * y->terms + j] = nh_mul(b->a->dag, x->term[i], y->term[j]);
    for (size_t ci = 0; ci < x->columns; ci++)
        for (size_t cj = 0; cj < y->columns; cj++)
            for (size_t ti = 0; ti < x->terms; ti++)
                for (size_t tj = 0; tj < y->terms; tj++)
                    p->map[ti * y->terms + tj + (ci * y->columns + cj) * p->terms] =
                        x->map[ti + ci * x->terms] * y->map[tj + cj * y->terms];
    return true;
}

/* A family of the table, explicit terms, or the product of its parts, one after the other. */
static bool build(builder *b, const nh_family *f, part *p)
{
    switch (f->kind) {
#define X(kind, name, keys, single, columns)                                                                           \
    case kind: return build_##name(b, f, p);
        NH_FAMILY_TABLE(X)
#undef X
    case NH_TERMS: return build_terms(b, f->terms, f->term, p);
    default: break;
    }
    if (!build(b, &f->part[0], p)) return false;
    for (size_t i = 1; i < f->parts; i++) {
        part left = *p, right;
        if (!build(b, &f->part[i], &right) || !multiply_parts(b, &left, &right, p)) return false;
    }
    return true;
}

static size_t find_term(const nh_ansatz *a, nh_ex term)
{
    for (size_t i = 0; i < a->terms; i++)
        if (a->term[i] == term) return i;
    return a->terms;
}

static bool same_column(const nh_column *x, const nh_column *y)
{
    return x->count == y->count && !memcmp(x->factor, y->factor, x->count * sizeof *x->factor);
}

/* Concatenates families; a term or column that two families share is taken once. */
static void join(builder *b, size_t n, const part *p)
{
    nh_ansatz *a = b->a;
    size_t columns = 0, terms = 0;
    for (size_t i = 0; i < n; i++) columns += p[i].columns, terms += p[i].terms;
    a->column = take(b, columns, sizeof *a->column);
    a->term = take(b, terms, sizeof *a->term);
    size_t **row = take(b, n, sizeof *row);
    for (size_t i = 0; i < n; i++) {
        row[i] = take(b, p[i].terms, sizeof **row);
        for (size_t j = 0; j < p[i].terms; j++) {
            row[i][j] = find_term(a, p[i].term[j]);
            if (row[i][j] == a->terms) a->term[a->terms++] = p[i].term[j];
        }
    }
    a->to_term = take(b, a->terms * columns, sizeof *a->to_term);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < p[i].columns; j++) {
            bool known = false;
            for (size_t c = 0; c < a->columns && !known; c++) known = same_column(&a->column[c], &p[i].column[j]);
            if (known) continue;
            double *to = a->to_term + a->columns * a->terms;
            for (size_t r = 0; r < p[i].terms; r++) to[row[i][r]] += p[i].map[r + j * p[i].terms];
            a->column[a->columns++] = p[i].column[j];
        }
}

typedef struct {
    size_t index, complexity;
} ranked;

static int simplest_first(const void *a, const void *b)
{
    const ranked *x = a, *y = b;
    if (x->complexity != y->complexity) return x->complexity < y->complexity ? -1 : 1;
    return x->index < y->index ? -1 : x->index > y->index;
}

/* Simple columns come first: where columns are dependent the null space keeps the first ones. */
static void order_columns(builder *b)
{
    nh_ansatz *a = b->a;
    ranked *r = nh_alloc_array(a->columns + 1, sizeof *r);
    size_t *length = nh_alloc_array(a->factors + 1, sizeof *length);
    for (size_t i = 0; i < a->factors; i++) length[i] = nh_complexity(a->dag, a->factor[i]);
    for (size_t j = 0; j < a->columns; j++) {
        r[j] = (ranked){j, a->column[j].count};
        for (size_t i = 0; i < a->column[j].count; i++) r[j].complexity += length[a->column[j].factor[i]];
    }
    qsort(r, a->columns, sizeof *r, simplest_first);
    nh_column *column = take(b, a->columns, sizeof *column);
    double *map = take(b, a->terms * a->columns, sizeof *map);
    for (size_t j = 0; j < a->columns; j++) {
        column[j] = a->column[r[j].index];
        memcpy(map + j * a->terms, a->to_term + r[j].index * a->terms, a->terms * sizeof *map);
    }
    a->column = column;
    a->to_term = map;
    nh_free(length);
    nh_free(r);
}

/* The number of monomials of n variables up to a degree: n + degree over degree. */
static double monomials(size_t n, size_t degree)
{
    double size = 1;
    for (size_t k = 1; k <= degree; k++) size *= (double)(n + k) / (double)k;
    return round(size);
}

static double size_of(const nh_family *f)
{
    double size = 1;
    switch (f->kind) {
#define X(kind, name, keys, single, columns)                                                                           \
    case kind: return (double)(columns);
        NH_FAMILY_TABLE(X)
#undef X
    case NH_TERMS: return (double)f->terms;
    default: break;
    }
    for (size_t i = 0; i < f->parts; i++) size *= size_of(&f->part[i]);
    return size;
}

double nh_ansatz_size(size_t families, const nh_family *family)
{
    double sum = 0;
    for (size_t i = 0; i < families; i++) sum += size_of(&family[i]);
    return sum;
}

nh_ansatz *nh_ansatz_create(const nh_model *model, const nh_points *points, size_t families, const nh_family *family,
                            size_t most, nh_error *error)
{
    nh_ansatz *a = nh_alloc(sizeof *a);
    a->arena = nh_arena_create();
    a->dag = model->dag;
    builder b = {.a = a, .model = model, .points = points, .most = most};
    part *p = nh_alloc_array(families + 1, sizeof *p);
    bool good = true;
    size_t total = 0;
    for (size_t i = 0; i < families && good; i++) {
        good = build(&b, &family[i], &p[i]);
        total += good ? p[i].columns : 0;
    }
    if (good && total <= most) {
        join(&b, families, p);
        order_columns(&b);
    }
    nh_free(p);
    if (good && total <= most) return a;
    nh_fail(error, NH_LIMIT, "", "the ansatz has more than %zu columns", most);
    nh_error_hint(error, "lower a degree or the harmonics, or raise the limit with --columns");
    nh_ansatz_free(a);
    return NULL;
}

void nh_ansatz_free(nh_ansatz *ansatz)
{
    if (!ansatz) return;
    nh_free(ansatz->factor);
    nh_arena_free(ansatz->arena);
    nh_free(ansatz);
}

nh_ex nh_ansatz_column(const nh_ansatz *a, size_t j)
{
    nh_ex e = nh_int(a->dag, 1);
    for (size_t i = 0; i < a->column[j].count; i++) e = nh_mul(a->dag, e, a->factor[a->column[j].factor[i]]);
    return e;
}
