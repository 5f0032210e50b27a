/* The values a/b of the last parameter, one after the other: lines mu = a/b where determinants of two parameters are
 * too large, planes nu = a/b of three.
 *
 * There one parameter less varies.  Modulo a prime the equations lose rank at the zeros of nh_classify_zeros.  Where
 * all of these lie on known curves (surfaces, walls) nothing else is special there, up to a height of the others. */
#include <math.h>

#include "base/progress.h"
#include "classify/classify_internal.h"
#include "graph/num.h"

typedef nh_classify_search search;

const char nh_classify_curves[] = "curves";

/* ---- one value ---- */

typedef enum { NOTHING, SOMETHING, ENDED } outcome;

/* Known zeros, or walls, in one list, whose coefficients are borrowed, without those that parameter v alone gives. */
static nh_special_factor *known_of(const nh_classification *c, int v, bool walls, size_t *count)
{
    size_t all = walls ? c->walls : c->specials;
    nh_special_factor *known = nh_alloc_array(all + 1, sizeof *known);
    *count = 0;
    for (size_t k = 0; k < all; k++) {
        const nh_special_factor *x = walls ? &c->wall[k].polynomial : &c->special[k].polynomial;
        if (nh_special_variable(x, 0) < v) known[(*count)++] = *x;
    }
    return known;
}

/* Is anything special at the held value of parameter v besides known zeros? */
static outcome look_at(search *s, int v, size_t degree, const nh_classify_number *number, size_t prime)
{
    nh_prime f = nh_classify_prime(s, prime);
    nh_classify_row row = {.number = *number};
    nh_classify_place any = {.on = NULL};
    nh_classify_number here;
    nh_common_zeros zeros = {.nullity = 0};
    nh_residue value;
    if (!nh_residue_ratio(f, s->q.top[v], s->q.bottom[v], &value)) return SOMETHING;
    if (!nh_classify_count(s, degree, &any, number->bound, NULL, &here)) return nh_late() ? ENDED : SOMETHING;
    if (here.bound != number->bound) return SOMETHING;
    if (v == 2) s->products = s->q.products;
    bool covered = nh_classify_zeros(s, degree, prime, &row, &zeros);
    for (int part = 0; part < NH_ZEROS_PARTS && covered; part++) {
        size_t count;
        nh_special_factor *known = known_of(s->out, v, part == NH_ZEROS_ACROSS, &count);
        covered = nh_special_cover(count, known, f, v, value, &zeros.part[part]);
        nh_free(known);
    }
    nh_common_zeros_clear(&zeros);
    return nh_late() || s->products < 0 ? ENDED : covered ? NOTHING : SOMETHING;
}

/* The height of the others that the primes cover at top/bottom: every prime divides the value of the product of all
 * polynomials times their denominators, as in nh_classify_row.
 * norm = product of sum |c_(i, j, ..)| |top|^power bottom^(degree - power) over the known polynomials. */
static double height_at(const search *s, int v, double logarithm, int64_t top, int64_t bottom)
{
    static const double rounding = 1e-9;
    size_t degree = (size_t)v;
    for (int walls = 0; walls < 2; walls++) {
        size_t count;
        nh_special_factor *known = known_of(s->out, v, walls, &count);
        for (size_t k = 0; k < count; k++) {
            const nh_special_factor *x = &known[k];
            size_t length = nh_special_length(x), each = length / (x->degree[v] + 1);
            double norm = 0;
            for (size_t z = 0; z < length; z++)
                norm += fabs((double)x->coefficient[z]) * pow(fabs((double)top), (double)(z / each)) *
                        pow((double)bottom, (double)(x->degree[v] - z / each));
            logarithm -= log(norm);
            for (int w = 0; w < v; w++) degree += x->degree[w];
        }
        nh_free(known);
    }
    return floor(exp(logarithm / (double)degree) * (1 - rounding));
}

/* A known wall, or a curve or surface itself? */
static bool is_known(const nh_classification *c, const nh_special_factor *value)
{
    bool known = false;
    for (size_t k = 0; k < c->walls && !known; k++) known = nh_special_same(&c->wall[k].polynomial, value);
    for (size_t k = 0; k < c->specials && !known; k++) known = nh_special_same(&c->special[k].polynomial, value);
    return known;
}

/* Looks modulo as many primes as there are other parameters.  False: ended. */
static bool examine_value(search *s, int v, size_t degree, int64_t top, int64_t bottom, nh_classify_row *row)
{
    int64_t coefficient[2] = {-top, bottom};
    nh_special_factor value = {.coefficient = coefficient};
    double logarithm = 0;
    outcome found = NOTHING;
    value.degree[v] = 1;
    if (is_known(s->out, &value)) return true;
    nh_progress(v == 1 ? "lines in the plane of the parameters" : "planes in the space of the parameters", -1);
    nh_classify_hold(s, v, top, bottom);
    for (size_t prime = 0; prime < (size_t)v && found == NOTHING; prime++) {
        found = look_at(s, v, degree, &row->number, prime);
        logarithm += log((double)nh_classify_prime(s, prime).p);
    }
    if (found == ENDED) return false;
    row->swept++;
    if (found == SOMETHING) nh_classify_add_wall(s->out, &value);
    else row->height = fmin(row->height, height_at(s, v, logarithm, top, bottom));
    return true;
}

/* ---- all of them ---- */

/* Every value with numerator or denominator of this size, and the other one not larger. */
static bool examine_size(search *s, int v, size_t degree, int64_t size, nh_classify_row *row)
{
    bool good = true;
    for (int64_t other = 0; other <= size && good; other++) {
        if (nh_gcd(size, other) != 1) continue;
        for (int64_t sign = 1; sign >= -1 && good; sign -= 2) {
            if (other == 0 && sign < 0) continue;
            good = examine_value(s, v, degree, sign * other, size, row); /* 0 is 0/1 */
            if (good && other && other != size) good = examine_value(s, v, degree, sign * size, other, row);
        }
    }
    return good;
}

/* Looks at a mu that has no special meaning. */
static bool curves_are_known(search *s, size_t degree, const nh_classify_row *row)
{
    static const int64_t top = 7368787, bottom = 2750159; /* primes */
    nh_classify_hold(s, 1, top, bottom);
    return look_at(s, 1, degree, &row->number, 0) == NOTHING;
}

bool nh_classify_sweep(search *s, size_t degree, size_t height, nh_classify_row *row)
{
    int v = (int)s->q.parameters - 1;
    bool line = v == 1, good = true;
    s->products = s->q.products;
    row->height = line ? (double)height : INFINITY;
    row->swept = 0;
    if (line) good = curves_are_known(s, degree, row);
    if (!good && !nh_late()) s->out->end = nh_classify_curves;
    for (int64_t size = 1; size <= (int64_t)height && good; size++) {
        good = examine_size(s, v, degree, size, row);
        if (good || !line || size == 1 || nh_late()) continue;
        row->height = fmin(row->height, (double)(size - 1)); /* the work that is left does not reach this size */
        good = true;
        break;
    }
    nh_classify_hold(s, v, 0, 0);
    if (good && line) {
        row->lifted = true;
        row->primes = 1;
        row->prime[0] = nh_classify_prime(s, 0).p;
    }
    return good;
}
