/* scan_recognise: guesses the exact value of a number that is known to about ten digits.
 *
 * A ratio, or one times a power of ten; a root of a quadratic equation with small whole coefficients, found as a short
 * vector of a lattice; a ratio times pi; a logarithm of a ratio.  The caller must check them. */
#include <flint/fmpz.h>
#include <flint/fmpz_lll.h>
#include <flint/fmpz_mat.h>
#include <inttypes.h>
#include <math.h>

#include "commands/scan_internal.h"
#include "graph/num.h"
#include "integrals/recognise.h"

/* a random number is near one of so few with probability 1/1000 */
enum { largest_denominator = 1000, largest_factor = 60 };

static void put(nh_setting *out, size_t *n, double value, const char *formula)
{
    for (size_t i = 0; i < *n; i++)
        if (out[i].bottom > 0 && out[i].value == value) return;
    if (*n < NH_SCAN_MOST_GUESSES) out[(*n)++] = (nh_setting){.value = value, .formula = formula};
}

static bool ratio_of(double value, int64_t most, double tolerance, nh_num *out)
{
    return value != 0 && nh_recognise_ratio(value, most, tolerance, out) && nh_num_short(*out);
}

/* "pi/6", "2*pi", "-3*pi/4" */
static const char *times_pi(nh_arena *arena, nh_num r)
{
    const char *sign = r.p < 0 ? "-" : "";
    const char *top = r.p == 1 || r.p == -1 ? "pi" : nh_arena_printf(arena, "%" PRId64 "*pi", r.p < 0 ? -r.p : r.p);
    return r.q == 1 ? nh_arena_printf(arena, "%s%s", sign, top)
                    : nh_arena_printf(arena, "%s%s/%" PRId64, sign, top, r.q);
}

/* value = r pi, or value = log r, with a ratio r of small numbers. */
static void guess_transcendental(nh_arena *arena, double value, double tolerance, nh_setting *out, size_t *n)
{
    nh_num r;
    if (ratio_of(value / M_PI, largest_factor, tolerance, &r))
        put(out, n, (double)r.p / (double)r.q * M_PI, times_pi(arena, r));
    if (fabs(value) >= 20 || !ratio_of(exp(value), largest_factor, fabs(value) * tolerance, &r)) return;
    put(out, n, log((double)r.p / (double)r.q),
        nh_arena_printf(arena, r.q == 1 ? "log(%" PRId64 ")" : "log(%" PRId64 "/%" PRId64 ")", r.p, r.q));
}

/* c0 + c1 x + c2 x^2 = 0: the rows (1 0 0 | T), (0 1 0 | T x), (0 0 1 | T x^2) have a short combination. */
static bool relation(double x, double tolerance, int64_t c[3])
{
    fmpz_mat_t m;
    fmpz_lll_t lll;
    double scale = 1 / fmax(tolerance, 1e-15), power = 1;
    bool small = true;
    fmpz_mat_init(m, 3, 4);
    for (slong i = 0; i < 3; i++, power *= x) {
        fmpz_one(fmpz_mat_entry(m, i, i));
        fmpz_set_d(fmpz_mat_entry(m, i, 3), round(scale * power));
    }
    fmpz_lll_context_init_default(lll);
    fmpz_lll(m, NULL, lll);
    for (slong i = 0; i < 3; i++) {
        const fmpz *entry = fmpz_mat_entry(m, 0, i);
        small = small && fmpz_cmpabs(entry, &(fmpz){largest_factor}) <= 0;
        c[i] = small ? fmpz_get_si(entry) : 0;
    }
    fmpz_mat_clear(m);
    return small && c[2] != 0;
}

/* (p + m sqrt(d))/r in lowest terms, with r > 0. */
static const char *surd(nh_arena *arena, int64_t p, int64_t m, int64_t d, int64_t r)
{
    for (int64_t k = 2; k * k <= d; k++)
        while (d % (k * k) == 0) d /= k * k, m *= k;
    int64_t g = nh_gcd(nh_gcd(p, m), r) * (r < 0 ? -1 : 1);
    p /= g, m /= g, r /= g;
    int64_t size = m < 0 ? -m : m;
    const char *root = nh_arena_printf(arena, "sqrt(%" PRId64 ")", d);
    if (size != 1) root = nh_arena_printf(arena, "%" PRId64 "*%s", size, root);
    const char *top = !p ? nh_arena_printf(arena, "%s%s", m < 0 ? "-" : "", root)
                         : nh_arena_printf(arena, "%" PRId64 "%s%s", p, m < 0 ? "-" : "+", root);
    if (r == 1) return top;
    return nh_arena_printf(arena, p ? "(%s)/%" PRId64 : "%s/%" PRId64, top, r);
}

static void guess_quadratic(nh_arena *arena, double value, double tolerance, nh_setting *out, size_t *n)
{
    int64_t c[3];
    if (!relation(value, tolerance, c)) return;
    int64_t b = c[1], square = b * b - 4 * c[0] * c[2];
    double root = square > 0 ? sqrt((double)square) : 0, bottom = 2 * (double)c[2];
    if (square <= 0 || root == floor(root)) return; /* rational values are guessed elsewhere */
    double plus = (-(double)b + root) / bottom, minus = (-(double)b - root) / bottom,
           exact = fabs(plus - value) <= fabs(minus - value) ? plus : minus;
    if (fabs(exact - value) > 10 * tolerance * fabs(value)) return;
    put(out, n, exact, surd(arena, -b, exact == plus ? 1 : -1, square, 2 * c[2]));
}

/* value = r 10^e with few digits, where lengths, masses or times are in small or large units. */
static void guess_power_of_ten(nh_arena *arena, double value, double tolerance, nh_setting *out, size_t *n)
{
    static const double most = 1000;
    int e = (int)floor(log10(fabs(value)));
    double power = pow(10, e);
    nh_num r;
    if (fabs(value) <= most && fabs(value) >= 1 / most) return; /* a ratio, or nothing simple */
    if (!ratio_of(value / power, largest_denominator, tolerance, &r)) return;
    char *number = nh_arena_printf(arena, r.q == 1 ? "%" PRId64 "e%d" : "%" PRId64 "e%d/%" PRId64, r.p, e, r.q);
    put(out, n, (double)r.p / (double)r.q * power, number);
}

size_t nh_scan_guess(nh_arena *arena, double value, double error, nh_setting *out)
{
    static const double coarsest = 1e-6; /* a number known to fewer digits is near many simple ones */
    size_t n = 0;
    nh_num r;
    if (fabs(value) <= error) out[n++] = (nh_setting){.value = 0, .top = 0, .bottom = 1};
    if (value == 0) return n;
    double tolerance = fmin(coarsest, error / fabs(value));
    if (ratio_of(value, largest_denominator, tolerance, &r))
        out[n++] = (nh_setting){.value = (double)r.p / (double)r.q, .top = r.p, .bottom = r.q};
    guess_power_of_ten(arena, value, tolerance, out, &n);
    guess_quadratic(arena, value, tolerance, out, &n);
    guess_transcendental(arena, value, tolerance, out, &n);
    return n;
}
