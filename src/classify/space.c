/* Special surfaces of three parameters, and where special curves and points can lie: planes modulo primes, lifted. */
#include "classify/space.h"

#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "classify/plane_internal.h"
#include "classify/sections.h"
#include "graph/num.h"

enum { least_primes = 4, first_sections = 4, parts = 3 };

typedef struct {
    nh_classify_search s;
    nh_classify_question question; /* the question, of which nu is varied */
    nh_space *out;
} search;

/* ---- one prime ---- */

typedef struct {
    search *s;
    size_t degree, prime;
    nh_plane_row *row;
} section;

static bool section_at(void *context, int64_t nu, nh_common_curves *out)
{
    const section *x = context;
    x->s->question.third_top = nu;
    x->s->question.third_bottom = 1;
    x->s->s.products = x->s->question.products;
    nh_progress("sections of special surfaces", -1);
    return nh_plane_zeros(&x->s->s, x->degree, x->prime, x->row, out);
}

/* ---- from residues to surfaces and walls ---- */

typedef struct {
    size_t count;
    nh_prime prime[NH_CLASSIFY_MOST_PRIMES];
    nh_residue_surface part[parts][NH_CLASSIFY_MOST_PRIMES];
} residues;

/* Special and degenerate surfaces, and walls. */
static const nh_residue_surface *part_of(const nh_sections *v, int part)
{
    return part == 0 ? &v->special : part == 1 ? &v->degenerate : &v->across;
}

static void clear(residues *r)
{
    for (size_t i = 0; i < r->count; i++)
        for (int k = 0; k < parts; k++) nh_free(r->part[k][i].coefficient);
    r->count = 0;
}

static bool same_degrees(const residues *r, const nh_sections *v)
{
    bool same = true;
    for (int k = 0; k < parts; k++)
        same &= !memcmp(r->part[k][0].degree, part_of(v, k)->degree, sizeof part_of(v, k)->degree);
    return same;
}

/* Unlucky primes are treated as in a plane. */
static void add(residues *r, nh_prime prime, nh_sections *v)
{
    if (r->count == 1 && !same_degrees(r, v)) clear(r);
    if (r->count && !same_degrees(r, v)) {
        nh_sections_clear(v);
        return;
    }
    r->prime[r->count] = prime;
    for (int k = 0; k < parts; k++) r->part[k][r->count] = *part_of(v, k);
    r->count++;
}

static void take_one(nh_special_surface **list, size_t *count, size_t *capacity, const nh_special_surface *x)
{
    for (size_t k = 0; k < *count; k++)
        if (nh_special_surface_same(&(*list)[k], x)) return;
    nh_grow(list, capacity, *count + 1, sizeof **list);
    (*list)[(*count)++] = nh_special_surface_copy(x);
}

static bool lift(search *s, const residues *r)
{
    nh_special_surfaces found[parts];
    bool lifted = true;
    for (int k = 0; k < parts; k++) {
        found[k] = nh_special_surfaces_lift(r->count, r->prime, r->part[k]);
        lifted &= found[k].lifted;
    }
    if (lifted) {
        nh_space *o = s->out;
        nh_plane_take_curves(&o->surface, &o->surfaces, &o->surface_capacity, &found[1], true);
        nh_plane_take_curves(&o->surface, &o->surfaces, &o->surface_capacity, &found[0], false);
        for (size_t k = 0; k < found[2].surfaces; k++)
            take_one(&s->out->wall, &s->out->walls, &s->out->wall_capacity, &found[2].surface[k]);
    }
    for (int k = 0; k < parts; k++) nh_special_surfaces_clear(&found[k]);
    return lifted;
}

static bool find_surfaces(search *s, size_t degree, nh_plane_row *row)
{
    residues r = {.count = 0};
    bool good = true;
    row->sections = first_sections;
    for (size_t prime = 0; prime < NH_CLASSIFY_MOST_PRIMES && good && !row->lifted; prime++) {
        nh_sections v;
        section x = {.s = s, .degree = degree, .prime = prime, .row = row};
        bool too_few;
        good = nh_sections_find(nh_classify_prime(&s->s, prime), section_at, &x, &row->sections, &too_few, &v);
        if (too_few) s->out->end = "surfaces";
        if (!good) break;
        add(&r, nh_classify_prime(&s->s, prime), &v);
        row->lifted = r.count >= least_primes && lift(s, &r);
    }
    row->primes = r.count;
    for (size_t i = 0; i < r.count; i++) row->prime[i] = r.prime[i].p;
    clear(&r);
    s->question.third_bottom = 0;
    return good && row->lifted;
}

/* ---- planes nu = a/b ---- */

typedef enum { NOTHING, SOMETHING, ENDED } outcome;

/* Surfaces and walls in one list, whose coefficients are borrowed. */
static nh_special_surface *known_of(const nh_space *o, bool walls, size_t *count)
{
    nh_special_surface *known = nh_alloc_array(o->surfaces + o->walls + 1, sizeof *known);
    *count = 0;
    for (size_t k = 0; k < o->surfaces && !walls; k++) known[(*count)++] = o->surface[k].polynomial;
    for (size_t k = 0; k < o->walls && walls; k++) known[(*count)++] = o->wall[k];
    return known;
}

/* Is anything special in the plane of the question besides sections of known surfaces and walls? */
static outcome look(search *s, size_t degree, const nh_plane_row *row, size_t prime)
{
    nh_prime f = nh_classify_prime(&s->s, prime);
    nh_plane_row plane = {.number = row->number};
    nh_classify_place any = {.kind = NH_CLASSIFY_ANY};
    nh_classify_number here;
    nh_common_curves c = {.across = {0, NULL}};
    nh_residue nu;
    if (!nh_residue_ratio(f, s->question.third_top, s->question.third_bottom, &nu)) return SOMETHING;
    if (!nh_classify_count(&s->s, degree, &any, row->number.bound, NULL, &here)) return nh_late() ? ENDED : SOMETHING;
    if (here.bound != row->number.bound) return SOMETHING;
    s->s.products = s->question.products;
    bool good = nh_plane_zeros(&s->s, degree, prime, &plane, &c), covered = good;
    nh_sections curves = nh_sections_of(&c);
    for (int part = 0; part < parts && covered; part++) {
        size_t count;
        const nh_residue_surface *curve = part_of(&curves, part);
        nh_special_surface *known = known_of(s->out, part == 2, &count);
        covered = nh_special_surfaces_cover(count, known, f, nu, curve);
        nh_free(known);
    }
    nh_common_curves_clear(&c);
    return nh_late() || s->s.products < 0 ? ENDED : covered ? NOTHING : SOMETHING;
}

/* The primes divide the value of the product of all polynomials times their denominators, where a pair of rationals up
 * to the height lies on none of them: as in a plane. */
static double height_at(const nh_space *o, double logarithm, int64_t top, int64_t bottom)
{
    static const double rounding = 1e-9;
    size_t degree = 2;
    double size = fmax(fabs((double)top), (double)bottom);
    for (size_t k = 0; k < o->surfaces + o->walls; k++) {
        const nh_special_surface *x = k < o->surfaces ? &o->surface[k].polynomial : &o->wall[k - o->surfaces];
        size_t count = (x->degree[0] + 1) * (x->degree[1] + 1) * (x->degree[2] + 1);
        double norm = 0;
        for (size_t z = 0; z < count; z++) norm += fabs((double)x->coefficient[z]);
        logarithm -= log(norm) + (double)x->degree[2] * log(size);
        degree += x->degree[0] + x->degree[1];
    }
    return floor(exp(logarithm / (double)degree) * (1 - rounding));
}

static bool examine(search *s, size_t degree, nh_plane_row *row, int64_t top, int64_t bottom)
{
    enum { primes = 2 };
    nh_space *o = s->out;
    int64_t coefficient[2] = {-top, bottom};
    nh_special_surface plane = {.degree = {0, 0, 1}, .coefficient = coefficient};
    double logarithm = 0;
    outcome found = NOTHING;
    s->question.third_top = top;
    s->question.third_bottom = bottom;
    nh_progress("planes in the space of the parameters", -1);
    for (size_t k = 0; k < o->planes; k++)
        if (nh_special_surface_same(&o->plane[k], &plane)) return true; /* this plane will be classified anyway */
    for (size_t prime = 0; prime < primes && found == NOTHING; prime++) {
        found = look(s, degree, row, prime);
        logarithm += log((double)nh_classify_prime(&s->s, prime).p);
    }
    if (found == ENDED) return false;
    row->planes++;
    if (found == SOMETHING) take_one(&o->plane, &o->planes, &o->plane_capacity, &plane);
    else row->height = fmin(row->height, height_at(o, logarithm, top, bottom));
    return true;
}

static bool sweep(search *s, size_t degree, nh_plane_row *row, size_t height)
{
    bool good = true;
    row->height = INFINITY;
    for (int64_t size = 1; size <= (int64_t)height && good; size++)
        for (int64_t other = 0; other <= size && good; other++) {
            if (nh_gcd(size, other) != 1) continue;
            for (int64_t sign = 1; sign >= -1 && good; sign -= 2) {
                if (other == 0 && sign < 0) continue;
                good = examine(s, degree, row, sign * other, size); /* 0 is 0/1 */
                if (good && other && other != size) good = examine(s, degree, row, sign * size, other);
            }
        }
    s->question.third_bottom = 0;
    return good;
}

/* ---- degrees ---- */

static const char *end_of(const search *s, const nh_plane_row *row)
{
    return s->out->end                     ? s->out->end
           : s->s.family.obstacle          ? s->s.family.obstacle
           : nh_late()                     ? "time"
           : !row->number.bounded          ? "work"
           : row->size > s->question.plane ? "plane"
           : s->s.products < 0             ? "staircase"
                                           : "unknowns";
}

static void run(search *s)
{
    nh_space *o = s->out;
    while (o->rows < s->question.degree && !nh_late()) {
        nh_plane_row row = {.known = 0};
        size_t degree = o->rows + 1;
        nh_classify_place any = {.kind = NH_CLASSIFY_ANY};
        nh_progress("integrals for almost all values", -1);
        bool good = nh_classify_count(&s->s, degree, &any, 0, &row.known, &row.number) &&
                    find_surfaces(s, degree, &row) && sweep(s, degree, &row, s->question.planes) && !nh_late();
        if (!good) {
            o->end = end_of(s, &row);
            break;
        }
        if (o->rows) row.height = fmin(row.height, o->row[o->rows - 1].height);
        o->row[o->rows++] = row;
        nh_plane_count_curves(&s->s, NH_CLASSIFY_SURFACE, degree, row.number.bound, o->surfaces, o->surface);
    }
    if (o->rows < s->question.degree && !o->end) o->end = "time";
    if (s->s.family.obstacle && !o->rows) o->obstacle = s->s.family.obstacle;
}

nh_space *nh_space_classify(const nh_model *model, const nh_classify_question *q)
{
    search s = {.question = *q, .out = nh_alloc(sizeof *s.out)};
    s.question.third_bottom = 0;
    nh_classify_open(&s.s, model, &s.question);
    if (s.s.family.obstacle) s.out->obstacle = s.s.family.obstacle;
    else run(&s);
    nh_parametric_close(&s.s.family);
    return s.out;
}

void nh_space_free(nh_space *o)
{
    if (!o) return;
    for (size_t k = 0; k < o->surfaces; k++) nh_free(o->surface[k].polynomial.coefficient);
    for (size_t k = 0; k < o->walls; k++) nh_free(o->wall[k].coefficient);
    for (size_t k = 0; k < o->planes; k++) nh_free(o->plane[k].coefficient);
    nh_free(o->surface);
    nh_free(o->wall);
    nh_free(o->plane);
    nh_free(o);
}
