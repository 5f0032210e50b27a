/* darboux_table: which eigenvalues the theorem allows.
 *
 *     lambda = j + k j (j - 1)/2,   ((k - 1)/k + k j (j + 1))/2,   j whole
 *
 * are those whose D = (k - 2)^2 + 8 k lambda is the square of a rational w with (k - 2 +- w)/(2 k) or (-k +- w)/(2 k)
 * whole; for |k| = 3, 4, 5 there are rows a + b (m + n j)^2 besides. */
#include "absence/darboux.h"

typedef struct {
    long k, a_top;
    ulong a_bottom;
    long b_top;
    ulong b_bottom;
    long m, n;
} row;

static const row rows[] = {
    {3, -1, 24, 1, 6, 1, 3},    {3, -1, 24, 3, 32, 1, 4},   {3, -1, 24, 3, 50, 1, 5},   {3, -1, 24, 3, 50, 2, 5},
    {-3, 25, 24, -1, 6, 1, 3},  {-3, 25, 24, -3, 32, 1, 4}, {-3, 25, 24, -3, 50, 1, 5}, {-3, 25, 24, -3, 50, 2, 5},
    {4, -1, 8, 2, 9, 1, 3},     {-4, 9, 8, -2, 9, 1, 3},    {5, -9, 40, 5, 18, 1, 3},   {5, -9, 40, 1, 10, 2, 5},
    {-5, 49, 40, -5, 18, 1, 3}, {-5, 49, 40, -1, 10, 2, 5},
};

/* The root of a square, not negative; false: it is none. */
static bool root_of(fmpq_t root, const fmpq_t square)
{
    if (!fmpz_is_square(fmpq_numref(square)) || !fmpz_is_square(fmpq_denref(square))) return false;
    fmpz_sqrt(fmpq_numref(root), fmpq_numref(square));
    fmpz_sqrt(fmpq_denref(root), fmpq_denref(square));
    return true;
}

/* Is (c + w)/(2 k) or (c - w)/(2 k) whole? */
static bool whole(long c, const fmpq_t w, long k)
{
    bool found = false;
    fmpq_t j, twice;
    fmpq_init(j);
    fmpq_init(twice);
    fmpq_set_si(twice, 2 * k, 1);
    for (int sign = 0; sign < 2 && !found; sign++) {
        fmpq_set_si(j, c, 1);
        if (sign) fmpq_sub(j, j, w);
        else fmpq_add(j, j, w);
        fmpq_div(j, j, twice);
        found = fmpz_is_one(fmpq_denref(j));
    }
    fmpq_clear(twice);
    fmpq_clear(j);
    return found;
}

/* Is lambda = a + b u^2 with a whole u = m or -m modulo n? */
static bool in_row(const row *r, const fmpq_t lambda)
{
    fmpq_t u, part;
    fmpq_init(u);
    fmpq_init(part);
    fmpq_set_si(part, r->a_top, r->a_bottom);
    fmpq_sub(u, lambda, part);
    fmpq_set_si(part, r->b_top, r->b_bottom);
    fmpq_div(u, u, part);
    bool in = root_of(u, u) && fmpz_is_one(fmpq_denref(u));
    if (in) {
        long rest = (long)fmpz_fdiv_ui(fmpq_numref(u), (ulong)r->n);
        in = rest == r->m || rest == r->n - r->m;
    }
    fmpq_clear(part);
    fmpq_clear(u);
    return in;
}

bool nh_darboux_allowed(long k, const fmpq_t lambda)
{
    enum { of_lambda = 8, none = 2 }; /* the theorem says nothing for k = +-none */
    if (k == 0 || k == none || k == -none) return true;
    bool allowed = false;
    fmpq_t w, part;
    fmpq_init(w);
    fmpq_init(part);
    fmpq_set_si(part, k, 1);
    fmpq_mul(w, lambda, part);
    fmpq_set_si(part, of_lambda, 1);
    fmpq_mul(w, w, part);
    fmpq_set_si(part, k - 2, 1);
    fmpq_mul(part, part, part);
    fmpq_add(w, w, part);
    if (root_of(w, w)) allowed = whole(k - 2, w, k) || whole(-k, w, k);
    for (size_t i = 0; i < sizeof rows / sizeof *rows && !allowed; i++)
        if (rows[i].k == k) allowed = in_row(&rows[i], lambda);
    fmpq_clear(part);
    fmpq_clear(w);
    return allowed;
}
