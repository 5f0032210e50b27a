/* Taylor steps with proved remainders.
 *
 * Y' = A(x) Y, x = z + h t, 0 <= t <= 1.  Row a has the denominator D_a(t) = den_a(z + h t)/den_a(z), so that
 * D_a(0) = 1, and the numerators N_ab(t).  The coefficients C_k of the series follow from
 *
 *     E_(k+1) = sum_j N_j C_(k-j) - sum_(j>=1) D_j E_(k+1-j),   C_k = E_k/k,
 *
 * and are rounded to exact numbers, one after another: no ball depends on an earlier one.  So Y~ = C_0 + .. + C_n t^n
 * is an exact polynomial, and its residual R_a = D_a Y~_a' - (N Y~)_a has coefficients that the balls of E_k bound,
 * those behind the end of the series included.  By variation of constants
 *
 *     |Y(1) - Y~(1)| <= exp(int |A|) max_a (sum_k |R_ak| / min |D_a|),
 *
 * where int |A| and min |D_a| belong to the straight line; they are bounded on pieces that cover it. */
#include "absence/monodromy_internal.h"

#include "base/memory.h"
#include "base/progress.h"

enum {
    spare_bits = 32,  /* of the series, beyond those of the result */
    bound_bits = 53,  /* of bounds */
    pieces = 8,       /* that cover a step */
    fewest_bits = 32, /* of small coefficients */
    envelope = 2,     /* bits by which a coefficient may fall short of the one before without being believed */
    room = 64,        /* coefficients between two moves of the window */
    strongest = 8,    /* int |A| may be bits/8 */
    farthest = 3,     /* |h| is at most 3/4 of the distance to the next singular point */
    farthest_of = 4,
    most_terms_per_bit = 16,
    most_halvings = 24,
    word = 64
};

/* One step of one block. */
typedef struct {
    size_t n, window, span, at; /* size, longest recurrence, kept coefficients, place of the newest */
    long bits;
    acb_poly_struct *num, *den; /* n x n and n, in t */
    acb_ptr c, e;               /* n x n x span: C_k and k C_k */
    arb_ptr smallest;           /* n: of |D_a| */
    arb_t strength;             /* int |A| */
    bool converges;             /* |h| is a good part smaller than the distance to the next singular point */
    mag_ptr residual;           /* n x n: sum of |R_ak| */
    uint64_t products;          /* per coefficient */
} series;

static void series_init(series *s, const nh_monodromy_sum *sum, const nh_monodromy_block *block)
{
    s->n = block->size;
    s->bits = sum->bits + spare_bits;
    s->num = nh_alloc_array(s->n * s->n + 1, sizeof *s->num);
    s->den = nh_alloc_array(s->n + 1, sizeof *s->den);
    for (size_t k = 0; k < s->n * s->n; k++) acb_poly_init(s->num + k);
    for (size_t a = 0; a < s->n; a++) acb_poly_init(s->den + a);
    s->smallest = _arb_vec_init((slong)s->n);
    s->residual = _mag_vec_init((slong)(s->n * s->n));
    arb_init(s->strength);
    s->c = s->e = NULL;
    s->span = 0;
}

static void series_clear(series *s)
{
    for (size_t k = 0; k < s->n * s->n; k++) acb_poly_clear(s->num + k);
    for (size_t a = 0; a < s->n; a++) acb_poly_clear(s->den + a);
    nh_free(s->num);
    nh_free(s->den);
    _arb_vec_clear(s->smallest, (slong)s->n);
    _mag_vec_clear(s->residual, (slong)(s->n * s->n));
    arb_clear(s->strength);
    if (s->c) _acb_vec_clear(s->c, (slong)(s->n * s->n * s->span));
    if (s->e) _acb_vec_clear(s->e, (slong)(s->n * s->n * s->span));
}

/* out(t) = factor p(z + h t) */
static void shifted(acb_poly_t out, const fmpz_poly_struct *p, const acb_t z, const acb_t h, const acb_t factor,
                    long bits)
{
    acb_t scale;
    acb_init(scale);
    acb_set(scale, factor);
    acb_poly_set_fmpz_poly(out, p, 2 * bits);
    acb_poly_taylor_shift(out, out, z, 2 * bits);
    for (slong k = 0; k < acb_poly_length(out); k++) {
        acb_mul(out->coeffs + k, out->coeffs + k, scale, bits);
        acb_mul(scale, scale, h, bits);
    }
    acb_clear(scale);
}

/* Numerators and denominators in t; false: some denominator may be 0 at z. */
static bool series_coefficients(series *s, const nh_monodromy_block *block, const acb_t z, const acb_t h)
{
    bool good = true;
    acb_t one, scale;
    acb_init(one);
    acb_init(scale);
    acb_one(one);
    s->window = 1;
    s->products = 0;
    for (size_t a = 0; a < s->n && good; a++) {
        shifted(s->den + a, block->den + a, z, h, one, s->bits);
        acb_inv(scale, s->den[a].coeffs, s->bits);
        good = acb_is_finite(scale);
        _acb_vec_scalar_mul(s->den[a].coeffs, s->den[a].coeffs, acb_poly_length(s->den + a), scale, s->bits);
        acb_mul(scale, scale, h, s->bits);
        size_t length = (size_t)acb_poly_length(s->den + a);
        for (size_t b = 0; b < s->n && good; b++) {
            acb_poly_struct *num = s->num + a * s->n + b;
            if (!fmpz_poly_is_zero(block->num + a * s->n + b))
                shifted(num, block->num + a * s->n + b, z, h, scale, s->bits);
            if ((size_t)acb_poly_length(num) > s->window) s->window = (size_t)acb_poly_length(num);
            length += (size_t)acb_poly_length(num);
        }
        if ((size_t)acb_poly_length(s->den + a) > s->window) s->window = (size_t)acb_poly_length(s->den + a);
        s->products += length * s->n;
    }
    acb_clear(one);
    acb_clear(scale);
    return good;
}

/* |D_a| on the piece t, by its zeros. */
static void denominator_bound(arb_t bound, const nh_monodromy_sum *sum, const ulong *order, acb_srcptr slope,
                              const acb_t t)
{
    acb_t factor;
    arb_t size;
    acb_init(factor);
    arb_init(size);
    arb_one(bound);
    for (size_t i = 0; i < sum->points; i++) {
        if (!order[i]) continue;
        acb_mul(factor, slope + i, t, bound_bits);
        acb_add_ui(factor, factor, 1, bound_bits);
        acb_abs(size, factor, bound_bits);
        arb_pow_ui(size, size, order[i], bound_bits);
        arb_mul(bound, bound, size, bound_bits);
    }
    acb_clear(factor);
    arb_clear(size);
}

/* The sum of |N_ab| over b on the piece t. */
static void numerator_bound(arb_t bound, const series *s, size_t a, const acb_t t)
{
    acb_t value;
    arb_t size;
    acb_init(value);
    arb_init(size);
    arb_zero(bound);
    for (size_t b = 0; b < s->n; b++) {
        acb_poly_evaluate(value, s->num + a * s->n + b, t, bound_bits);
        acb_abs(size, value, bound_bits);
        arb_add(bound, bound, size, bound_bits);
    }
    acb_clear(value);
    arb_clear(size);
}

/* The norm of A on the piece t: the largest sum of a row; the least |D_a| are kept. */
static void piece_bound(arb_t norm, series *s, const nh_monodromy_sum *sum, const nh_monodromy_block *block,
                        acb_srcptr slope, const acb_t t)
{
    arb_t row, den;
    arb_init(row);
    arb_init(den);
    arb_zero(norm);
    for (size_t a = 0; a < s->n; a++) {
        denominator_bound(den, sum, block->order + a * sum->points, slope, t);
        arb_min(s->smallest + a, s->smallest + a, den, bound_bits);
        numerator_bound(row, s, a, t);
        arb_div(row, row, den, bound_bits);
        arb_max(norm, norm, row, bound_bits);
    }
    arb_clear(row);
    arb_clear(den);
}

/* Is |slope| at most 3/4, for every point where the block is singular? */
static bool within(const nh_monodromy_sum *sum, const nh_monodromy_block *block, acb_srcptr slope)
{
    bool is = true;
    arb_t size;
    arb_init(size);
    for (size_t i = 0; i < sum->points && is; i++) {
        bool singular = false;
        for (size_t a = 0; a < block->size; a++) singular = singular || block->order[a * sum->points + i];
        acb_abs(size, slope + i, bound_bits);
        arb_mul_ui(size, size, farthest_of, bound_bits);
        arb_sub_ui(size, size, farthest, bound_bits);
        is = !singular || arb_is_nonpositive(size);
    }
    arb_clear(size);
    return is;
}

/* The bounds on the straight line. */
static void series_bounds(series *s, const nh_monodromy_sum *sum, const nh_monodromy_block *block, const acb_t z,
                          const acb_t h)
{
    acb_ptr slope = _acb_vec_init((slong)sum->points);
    acb_t t;
    arb_t norm;
    acb_init(t);
    arb_init(norm);
    for (size_t i = 0; i < sum->points; i++) { /* den_a(z + h t)/den_a(z) is the product of 1 + t h/(z - point) */
        acb_sub(slope + i, z, sum->point + i, sum->bits);
        acb_div(slope + i, h, slope + i, bound_bits);
    }
    s->converges = within(sum, block, slope);
    for (size_t a = 0; a < s->n; a++) arb_one(s->smallest + a);
    arb_zero(s->strength);
    for (slong k = 0; k < pieces; k++) {
        acb_set_si(t, 2 * k + 1);
        mag_one(arb_radref(acb_realref(t)));
        acb_div_si(t, t, 2 * pieces, bound_bits);
        piece_bound(norm, s, sum, block, slope, t);
        arb_add(s->strength, s->strength, norm, bound_bits);
    }
    arb_div_ui(s->strength, s->strength, pieces, bound_bits);
    _acb_vec_clear(slope, (slong)sum->points);
    acb_clear(t);
    arb_clear(norm);
}

/* Room for one more coefficient: the last ones move to the beginning. */
static void series_advance(series *s)
{
    if (++s->at < s->span) return;
    for (size_t entry = 0; entry < s->n * s->n; entry++)
        for (size_t k = 0; k < s->window; k++) {
            size_t to = entry * s->span + k, from = to + s->span - s->window;
            acb_swap(s->c + to, s->c + from);
            acb_swap(s->e + to, s->e + from);
        }
    s->at = s->window;
}

/* E_(k+1) of column b, row a, from the coefficients before; s->at is the place of the new one. */
static void series_next(acb_t next, const series *s, size_t a, size_t b, size_t k, long bits)
{
    size_t known = k + 1; /* C_0 .. C_k */
    acb_zero(next);
    for (size_t c = 0; c < s->n; c++) {
        const acb_poly_struct *num = s->num + a * s->n + c;
        size_t length = (size_t)acb_poly_length(num);
        if (length > known) length = known;
        if (length)
            acb_dot(next, next, 0, num->coeffs, 1, s->c + (c * s->n + b) * s->span + s->at - 1, -1, (slong)length,
                    bits);
    }
    size_t length = (size_t)acb_poly_length(s->den + a) - 1;
    if (length > k) length = k; /* E_0 is 0 */
    if (length)
        acb_dot(next, next, 1, s->den[a].coeffs + 1, 1, s->e + (a * s->n + b) * s->span + s->at - 1, -1, (slong)length,
                bits);
}

/* e with |Re x|, |Im x| < 2^e. */
static slong exponent_of(const acb_t x)
{
    slong re = arf_abs_bound_lt_2exp_si(arb_midref(acb_realref(x)));
    slong im = arf_abs_bound_lt_2exp_si(arb_midref(acb_imagref(x)));
    return re > im ? re : im;
}

/* The next coefficient of all entries, 0 where the series has ended; what the rounding changes goes to the residual.
 * Returns the exponent of the largest |E|. */
static slong series_coefficient(series *s, size_t k, long bits, bool ended, acb_mat_t sum)
{
    acb_t ball;
    mag_t size;
    acb_init(ball);
    mag_init(size);
    slong exponent = -ARF_PREC_EXACT;
    for (size_t entry = 0; entry < s->n * s->n; entry++) {
        acb_ptr c = s->c + entry * s->span + s->at, e = s->e + entry * s->span + s->at;
        series_next(ball, s, entry / s->n, entry % s->n, k, bits);
        if (ended) {
            acb_zero(c);
        } else {
            acb_div_ui(c, ball, k + 1, bits);
            acb_get_mid(c, c);
            acb_add(acb_mat_entry(sum, (slong)(entry / s->n), (slong)(entry % s->n)),
                    acb_mat_entry(sum, (slong)(entry / s->n), (slong)(entry % s->n)), c, s->bits);
        }
        acb_mul_ui(e, c, k + 1, ARF_PREC_EXACT);
        slong now = exponent_of(e);
        if (now > exponent) exponent = now;
        acb_sub(ball, e, ball, bound_bits);
        acb_get_mag(size, ball);
        mag_add(s->residual + entry, s->residual + entry, size);
    }
    acb_clear(ball);
    mag_clear(size);
    return exponent;
}

/* Sums the series into T; false: it does not end. */
static bool series_sum(series *s, nh_monodromy_sum *sum, acb_mat_t T)
{
    size_t entries = s->n * s->n, quiet = 0, behind = 0;
    s->span = s->window + room;
    s->c = _acb_vec_init((slong)(entries * s->span));
    s->e = _acb_vec_init((slong)(entries * s->span));
    s->at = 0;
    acb_mat_one(T);
    for (size_t a = 0; a < s->n; a++) acb_one(s->c + (a * s->n + a) * s->span);
    slong seen = 0; /* the coefficients have about so many bits before the point */
    for (size_t k = 0; behind < s->window; k++) {
        if (k > (size_t)(most_terms_per_bit * s->bits) || sum->work > sum->limit) return false;
        long bits = s->bits + (seen < 0 ? seen : 0);
        if (bits < fewest_bits) bits = fewest_bits;
        series_advance(s);
        bool ended = quiet >= s->window; /* so many negligible coefficients make all further ones negligible */
        slong exponent = series_coefficient(s, k, bits, ended, T);
        quiet = exponent < -s->bits || ended ? quiet + 1 : 0;
        behind += ended;
        seen = exponent + envelope > seen - envelope ? exponent + envelope : seen - envelope;
        sum->work += s->products * (uint64_t)((bits + word - 1) / word);
    }
    return true;
}

/* Widens T by what the residual allows. */
static void series_error(series *s, acb_mat_t T)
{
    arb_t error, row, growth;
    mag_t radius;
    arb_init(error);
    arb_init(row);
    arb_init(growth);
    mag_init(radius);
    arb_exp(growth, s->strength, bound_bits);
    for (size_t b = 0; b < s->n; b++) {
        arb_zero(error);
        for (size_t a = 0; a < s->n; a++) {
            arf_set_mag(arb_midref(row), s->residual + a * s->n + b);
            mag_zero(arb_radref(row));
            arb_div(row, row, s->smallest + a, bound_bits);
            arb_max(error, error, row, bound_bits);
        }
        arb_mul(error, error, growth, bound_bits);
        arb_get_mag(radius, error);
        for (size_t a = 0; a < s->n; a++) acb_add_error_mag(acb_mat_entry(T, (slong)a, (slong)b), radius);
    }
    arb_clear(error);
    arb_clear(row);
    arb_clear(growth);
    mag_clear(radius);
}

/* Is the step short enough for its bound, and free of singular points? */
static bool series_mild(const series *s)
{
    arb_t most;
    arb_init(most);
    arb_set_si(most, s->bits / strongest);
    bool mild = s->converges && arb_is_finite(s->strength) && arb_lt(s->strength, most);
    for (size_t a = 0; a < s->n; a++) mild = mild && arb_is_positive(s->smallest + a);
    arb_clear(most);
    return mild;
}

nh_monodromy_outcome nh_monodromy_step(nh_monodromy_sum *sum, size_t b, const acb_t z, const acb_t h, acb_mat_t T)
{
    series s;
    const nh_monodromy_block *block = sum->block + b;
    series_init(&s, sum, block);
    nh_monodromy_outcome outcome = NH_MONODROMY_FAILED;
    if (series_coefficients(&s, block, z, h)) {
        series_bounds(&s, sum, block, z, h);
        outcome = series_mild(&s) ? NH_MONODROMY_DONE : NH_MONODROMY_SHORTER;
    }
    if (outcome == NH_MONODROMY_DONE) {
        if (series_sum(&s, sum, T)) series_error(&s, T);
        else outcome = NH_MONODROMY_FAILED;
    }
    series_clear(&s);
    return outcome;
}

/* The same by halves, where one step is too long. */
static bool line_within(nh_monodromy_sum *sum, size_t b, const acb_t z, const acb_t h, int halvings, acb_mat_t T)
{
    if (nh_interrupted()) return false;
    sum->steps++;
    nh_monodromy_outcome outcome = nh_monodromy_step(sum, b, z, h, T);
    if (outcome != NH_MONODROMY_SHORTER || !halvings) return outcome == NH_MONODROMY_DONE;
    acb_t half, middle;
    acb_mat_t second;
    acb_init(half);
    acb_init(middle);
    acb_mat_init(second, acb_mat_nrows(T), acb_mat_nrows(T));
    acb_mul_2exp_si(half, h, -1);
    acb_add(middle, z, half, ARF_PREC_EXACT);
    bool good =
        line_within(sum, b, z, half, halvings - 1, T) && line_within(sum, b, middle, half, halvings - 1, second);
    if (good) acb_mat_mul(T, second, T, sum->bits);
    acb_clear(half);
    acb_clear(middle);
    acb_mat_clear(second);
    return good;
}

bool nh_monodromy_line(nh_monodromy_sum *sum, size_t b, const acb_t z, const acb_t h, acb_mat_t T)
{
    return line_within(sum, b, z, h, most_halvings, T);
}
