/* Lines mu = a/b on which more than the points of known curves is special. */
#include "classify/plane_sweep.h"

#include <flint/nmod_poly.h>
#include <math.h>
#include <stdlib.h>

#include "base/progress.h"
#include "graph/num.h"

typedef nh_classify_search search;

/* ---- what is known on a line ---- */

/* The product of the known curves at this mu, as a polynomial in lambda modulo the prime. */
static void known_at(const nh_plane_known *o, nh_residue mu, nh_prime f, nmod_poly_t out)
{
    nmod_poly_t p;
    nmod_poly_init(p, f.p);
    nmod_poly_one(out);
    for (size_t k = 0; k < o->curves; k++) {
        const nh_special_curve *c = &o->curve[k];
        nmod_poly_zero(p);
        for (size_t i = 0; i <= c->degree[0]; i++) {
            nh_residue sum = 0;
            for (size_t j = c->degree[1] + 1; j-- > 0;)
                sum = nh_residue_add(f, nh_residue_mul(f, sum, mu),
                                     nh_residue_of(f, c->coefficient[j * (c->degree[0] + 1) + i]));
            nmod_poly_set_coeff_ui(p, (slong)i, sum);
        }
        if (!nmod_poly_is_zero(p)) nmod_poly_mul(out, out, p);
    }
    nmod_poly_clear(p);
}

/* The norm |.|_1 of the same polynomial over the integers, at mu = top/bottom, without denominators; its degree is
 * added. */
static double known_norm(const nh_plane_known *o, int64_t top, int64_t bottom, size_t *degree)
{
    double norm = 1;
    for (size_t k = 0; k < o->curves; k++) {
        const nh_special_curve *c = &o->curve[k];
        double sum = 0;
        for (size_t i = 0; i <= c->degree[0]; i++)
            for (size_t j = 0; j <= c->degree[1]; j++)
                sum += fabs((double)c->coefficient[j * (c->degree[0] + 1) + i]) * pow(fabs((double)top), (double)j) *
                       pow((double)bottom, (double)(c->degree[1] - j));
        norm *= sum;
        *degree += c->degree[0];
    }
    return norm;
}

static void multiply(nmod_poly_t out, const nh_residue_polynomial *p)
{
    nmod_poly_t x;
    nmod_poly_init(x, out->mod.n);
    for (size_t j = 0; j <= p->degree; j++) nmod_poly_set_coeff_ui(x, (slong)j, p->coefficient[j]);
    nmod_poly_mul(out, out, x);
    nmod_poly_clear(x);
}

/* ---- one line ---- */

typedef enum { NOTHING, SOMETHING, ENDED } outcome;

/* At the value of mu that the search holds: is anything special besides points of known curves? */
static outcome look(search *s, const nh_plane_known *o, size_t degree, const nh_classify_number *number)
{
    enum { prime = 0 };
    nh_prime f = nh_classify_prime(s, prime);
    nh_classify_row row = {.number = *number};
    nh_classify_place any = {.kind = NH_CLASSIFY_ANY};
    nh_classify_number here;
    nh_special_roots roots;
    if (!nh_classify_count(s, degree, &any, number->bound, NULL, &here)) return nh_late() ? ENDED : SOMETHING;
    if (here.bound != number->bound) return SOMETHING;
    if (!nh_classify_roots(s, degree, prime, &row, &roots)) return nh_late() || s->products < 0 ? ENDED : SOMETHING;
    nmod_poly_t known, found;
    nmod_poly_init(known, f.p);
    nmod_poly_init(found, f.p);
    nmod_poly_one(found);
    known_at(o, s->family.value, f, known);
    multiply(found, &roots.excluded);
    multiply(found, &roots.degenerate);
    nmod_poly_rem(found, known, found); /* roots are simple */
    outcome out = nmod_poly_is_zero(found) ? NOTHING : SOMETHING;
    nmod_poly_clear(found);
    nmod_poly_clear(known);
    nh_special_roots_clear(&roots);
    return out;
}

static bool is_known_line(const nh_plane_known *o, int64_t top, int64_t bottom)
{
    for (size_t k = 0; k < o->lines; k++) {
        const nh_special_factor *f = &o->line[k];
        if (f->degree == 1 && f->coefficient[1] == bottom && f->coefficient[0] == -top) return true;
    }
    for (size_t k = 0; k < o->curves; k++) {
        const nh_special_curve *c = &o->curve[k];
        if (c->degree[0] == 0 && c->degree[1] == 1 && c->coefficient[1] * top + c->coefficient[0] * bottom == 0)
            return true;
    }
    return false;
}

static void add_line(nh_plane_sweep *out, int64_t top, int64_t bottom)
{
    nh_grow(&out->line, &out->capacity, out->count + 1, sizeof *out->line);
    nh_special_factor *f = &out->line[out->count++];
    *f = (nh_special_factor){.degree = 1, .coefficient = nh_alloc_array(2, sizeof *f->coefficient)};
    f->coefficient[0] = -top;
    f->coefficient[1] = bottom;
}

/* Every prime divides the value of the known polynomial times a denominator, as for one parameter. */
static void take_height(nh_plane_sweep *out, double p, const nh_plane_known *o, int64_t top, int64_t bottom)
{
    size_t degree = 0;
    double norm = known_norm(o, top, bottom, &degree);
    double height = floor(pow(p / norm, 1 / (double)(degree + 1)) * (1 - 1e-9));
    if (height < out->height) out->height = height;
}

static bool examine(search *s, nh_classify_question *q, const nh_plane_known *o, size_t degree,
                    const nh_classify_number *number, int64_t top, int64_t bottom, nh_plane_sweep *out)
{
    if (is_known_line(o, top, bottom)) return true;
    q->top = top;
    q->bottom = bottom;
    outcome found = look(s, o, degree, number);
    if (found == ENDED) return false;
    out->examined++;
    if (found == SOMETHING) add_line(out, top, bottom);
    else take_height(out, (double)nh_classify_prime(s, 0).p, o, top, bottom);
    return true;
}

/* ---- all of them ---- */

/* Works at a mu that has no special meaning. */
static bool curves_are_known(search *s, nh_classify_question *q, const nh_plane_known *o, size_t degree,
                             const nh_classify_number *number)
{
    static const int64_t top = 7368787, bottom = 2750159; /* primes */
    q->top = top;
    q->bottom = bottom;
    return look(s, o, degree, number) == NOTHING;
}

/* Every mu of this height. */
static bool examine_size(search *s, nh_classify_question *q, const nh_plane_known *o, size_t degree,
                         const nh_classify_number *number, int64_t size, nh_plane_sweep *out)
{
    bool good = true;
    for (int64_t other = 0; other <= size && good; other++) {
        if (nh_gcd(size, other) != 1) continue;
        nh_progress("lines in the plane of the parameters", -1);
        for (int64_t sign = 1; sign >= -1 && good; sign -= 2) {
            if (other == 0 && sign < 0) continue;
            good = examine(s, q, o, degree, number, sign * other, size, out); /* 0 is 0/1 */
            if (good && other && other != size) good = examine(s, q, o, degree, number, sign * size, other, out);
        }
    }
    return good;
}

bool nh_plane_sweep_lines(search *s, const nh_plane_known *o, size_t degree, const nh_classify_number *number,
                          size_t height, nh_plane_sweep *out)
{
    const nh_classify_question *own = s->q;
    nh_classify_question q = *own;
    bool held = s->family.held, good;
    *out = (nh_plane_sweep){.height = (double)height};
    s->q = &q;
    s->family.held = true;
    s->products = own->products;
    good = curves_are_known(s, &q, o, degree, number);
    out->curves = !good;
    for (int64_t size = 1; size <= (int64_t)height && good; size++) {
        good = examine_size(s, &q, o, degree, number, size, out);
        if (good || size == 1 || nh_late()) continue;
        out->height = fmin(out->height, (double)(size - 1)); /* the work that is left does not reach this size */
        good = true;
        break;
    }
    s->q = own;
    s->family.held = held;
    return good;
}

void nh_plane_sweep_clear(nh_plane_sweep *x)
{
    for (size_t k = 0; k < x->count; k++) nh_free(x->line[k].coefficient);
    nh_free(x->line);
}
