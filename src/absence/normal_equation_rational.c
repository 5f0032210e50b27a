/* normal_equation_rational: coefficients in Q(x), and the blocks of a triangular form.
 *
 *     d xi/dx = C xi over K = Q(x)[w],   xi_i = w^(s_i) eta_i,  s_i = 0 or 1
 *     d eta_i/dx = sum_j w^(s_j - s_i) C_ij eta_j - s_i (w^2)'/(2 w^2) eta_i
 *
 * Under reversal of time w becomes -w.  Where each component is even or odd, which s_i records, all coefficients are
 * rational.  Otherwise, as with a magnetic field, xi = u + w v doubles the unknowns:
 *
 *     C = C_0 + C_1 w:   du/dx = C_0 u + w^2 C_1 v,   dv/dx = C_1 u + (C_0 - (w^2)'/(2 w^2)) v
 *
 * Over K this is the sum of the equation and its conjugate, w -> -w. */
#include "absence/linear_split.h"
#include "absence/normal_equation_internal.h"

/* C, among the components that are kept. */
static nh_curve_element *coefficients(const nh_normal_work *work)
{
    size_t d = work->free;
    nh_curve_element *c = nh_curve_field_elements(d * d), inverse;
    nh_curve_field_element_init(&inverse);
    nh_curve_field_inv(&work->field, &inverse, &work->rate);
    for (size_t a = 0; a < d; a++)
        for (size_t b = 0; b < d; b++)
            nh_curve_field_mul(&work->field, &c[a * d + b], &work->block[work->kept[a] * work->normals + work->kept[b]],
                               &inverse);
    nh_curve_field_element_clear(&inverse);
    return c;
}

/* Does the entry couple components of the same parity (0), of different ones (1), or none (-1)?  2: both. */
static int parity(const nh_curve_element *e)
{
    if (nh_curve_field_is_zero(e)) return -1;
    return nh_curve_field_is_even(e) ? 0 : nh_curve_field_is_odd(e) ? 1 : 2;
}

/* Colours what hangs together with component a.  False: it cannot be done. */
static bool spread(const nh_curve_element *c, size_t d, size_t a, int *s)
{
    bool again = true;
    s[a] = 0;
    while (again) {
        again = false;
        for (size_t k = 0; k < d * d; k++) {
            size_t i = k / d, j = k % d;
            int link = parity(&c[k]);
            if (link < 0 || (s[i] < 0 && s[j] < 0)) continue;
            if (link > 1) return false;
            if (s[i] >= 0 && s[j] >= 0 && s[i] != (s[j] ^ link)) return false;
            if (s[i] >= 0 && s[j] >= 0) continue;
            if (s[i] < 0) s[i] = s[j] ^ link;
            else s[j] = s[i] ^ link;
            again = true;
        }
    }
    return true;
}

static bool parities(const nh_curve_element *c, size_t d, int *s)
{
    for (size_t a = 0; a < d; a++) s[a] = -1;
    for (size_t a = 0; a < d; a++)
        if (s[a] < 0 && !spread(c, d, a, s)) return false;
    return true;
}

/* The entry of the equation of eta, in Q(x). */
static void make_rational(const nh_normal_work *work, nh_curve_element *entry, const int *s, size_t i, size_t j)
{
    nh_curve_element w, slope;
    nh_curve_field_element_init(&w);
    nh_curve_field_element_init(&slope);
    nh_curve_field_set_w(&w);
    if (i == j && s[i]) {
        nh_curve_field_derivative(&work->field, &slope, &w); /* w' = (w'/w) w */
        fmpz_poly_swap(slope.even, slope.odd);
        fmpz_poly_neg(slope.even, slope.even);
        nh_curve_field_add(entry, entry, &slope);
    }
    if (s[i] && !s[j]) nh_curve_field_inv(&work->field, &w, &w);
    if (s[i] != s[j]) nh_curve_field_mul(&work->field, entry, entry, &w);
    nh_curve_field_element_clear(&w);
    nh_curve_field_element_clear(&slope);
}

/* The entry of the doubled equation: halves u (0) and v (1) of rows and columns. */
static void double_entry(const nh_normal_work *work, nh_curve_element *out, const nh_curve_element *e, bool lower,
                         bool right)
{
    nh_curve_element w;
    nh_curve_field_element_init(&w);
    nh_curve_field_set_w(&w);
    nh_curve_field_set(out, e);
    if (lower == right) fmpz_poly_zero(out->odd); /* C_0 */
    else fmpz_poly_zero(out->even);               /* w C_1, times w or over w */
    if (lower && !right) nh_curve_field_inv(&work->field, &w, &w);
    if (lower != right) nh_curve_field_mul(&work->field, out, out, &w);
    nh_curve_field_element_clear(&w);
}

static nh_curve_element *doubled(const nh_normal_work *work, const nh_curve_element *c)
{
    size_t d = work->free, n = 2 * d;
    nh_curve_element *all = nh_curve_field_elements(n * n), slope;
    nh_curve_field_element_init(&slope);
    nh_curve_field_set_w(&slope);
    nh_curve_field_derivative(&work->field, &slope, &slope); /* w' = (w'/w) w */
    fmpz_poly_swap(slope.even, slope.odd);
    fmpz_poly_neg(slope.even, slope.even);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) double_entry(work, &all[i * n + j], &c[i % d * d + j % d], i >= d, j >= d);
    for (size_t i = d; i < n; i++) nh_curve_field_add(&all[i * n + i], &all[i * n + i], &slope);
    nh_curve_field_element_clear(&slope);
    return all;
}

/* ---- blocks: strongly connected components ---- */

/* reach[i * d + j]: a chain of entries that are not 0 leads from i to j. */
static bool *reaches(const nh_curve_element *c, size_t d)
{
    bool *reach = nh_alloc_array(d * d + 1, sizeof *reach);
    for (size_t k = 0; k < d * d; k++) reach[k] = k / d == k % d || !nh_curve_field_is_zero(&c[k]);
    for (size_t k = 0; k < d; k++)
        for (size_t i = 0; i < d; i++)
            for (size_t j = 0; j < d; j++) reach[i * d + j] |= reach[i * d + k] && reach[k * d + j];
    return reach;
}

static void set_entry(nh_linear_equation *equation, size_t i, size_t j, const nh_curve_element *e)
{
    fmpq_poly_t num, den;
    fmpq_poly_init(num);
    fmpq_poly_init(den);
    fmpq_poly_set_fmpz_poly(num, e->even);
    fmpq_poly_set_fmpz_poly(den, e->den);
    nh_linear_equation_set(equation, i, j, num, den);
    fmpq_poly_clear(num);
    fmpq_poly_clear(den);
}

/* The component of `a` among d, the first of its members, split as far as a constant change of its unknowns does. */
static void add_block(nh_normal_equation *out, size_t d, const nh_curve_element *c, const bool *reach, size_t a)
{
    size_t size = 0;
    size_t *member = nh_alloc_array(d, sizeof *member);
    for (size_t i = a; i < d; i++)
        if (reach[a * d + i] && reach[i * d + a]) member[size++] = i;
    nh_linear_equation block, *piece;
    nh_linear_equation_init(&block, size);
    for (size_t i = 0; i < size; i++)
        for (size_t j = 0; j < size; j++) set_entry(&block, i, j, &c[member[i] * d + member[j]]);
    nh_linear_equation_reduce(&block);
    bool triangular;
    size_t pieces = nh_linear_equation_split(&block, &piece, &triangular);
    for (size_t i = 0; i < pieces; i++) out->block[out->blocks++] = piece[i];
    out->triangular |= triangular;
    nh_linear_equation_clear(&block);
    nh_free(piece);
    nh_free(member);
}

static void make_blocks(nh_normal_work *work, size_t d, const nh_curve_element *c)
{
    nh_normal_equation *out = work->out;
    bool *reach = reaches(c, d);
    out->block = nh_arena_alloc(work->arena, (d + 1) * sizeof *out->block);
    for (size_t a = 0; a < d; a++) {
        bool first = true;
        for (size_t i = 0; i < a; i++) first &= !(reach[a * d + i] && reach[i * d + a]);
        if (first) add_block(out, d, c, reach, a);
        for (size_t i = 0; i < d; i++) out->triangular |= reach[a * d + i] && !reach[i * d + a];
    }
    nh_free(reach);
}

void nh_normal_equation_rational(nh_normal_work *work)
{
    size_t d = work->free;
    nh_curve_element *c = coefficients(work);
    int *s = nh_alloc_array(d + 1, sizeof *s);
    if (parities(c, d, s)) {
        for (size_t k = 0; k < d * d; k++) make_rational(work, &c[k], s, k / d, k % d);
        make_blocks(work, d, c);
    } else {
        nh_curve_element *twice = doubled(work, c);
        work->out->doubled = true;
        make_blocks(work, 2 * d, twice);
        nh_curve_field_elements_free(twice, 2 * d * 2 * d);
    }
    nh_free(s);
    nh_curve_field_elements_free(c, d * d);
}
