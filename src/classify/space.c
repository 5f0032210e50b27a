/* Special surfaces of three parameters, and where special curves and points can lie: planes modulo primes, lifted. */
#include "classify/space.h"

#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "classify/plane_internal.h"

enum { least_primes = 4, first_sections = 4, most_sections = 20, most_unlucky = 6 };

typedef struct {
    nh_classify_search s;
    nh_classify_question question; /* the question, of which nu is varied */
    nh_space *out;
} search;

/* The index-th of some values of nu that have no special meaning. */
static int64_t nu_at(size_t index) { return 7919 + 1009 * (int64_t)index; }

/* ---- one prime ---- */

/* Sections at several values of nu, all of the same degrees. */
typedef struct {
    size_t count, used;      /* used: number of values of nu taken, unlucky ones included */
    nh_residue nu[most_sections];
    nh_common_curves at[most_sections];
} sections;

static bool alike(const nh_common_curves *a, const nh_common_curves *b)
{
    return !memcmp(a->special.degree, b->special.degree, sizeof a->special.degree)
        && !memcmp(a->degenerate.degree, b->degenerate.degree, sizeof a->degenerate.degree)
        && a->across.degree == b->across.degree;
}

/* A section whose degrees differ is unlucky: the first one, when the second disagrees with it, otherwise the new
 * one. */
static void add_section(sections *x, nh_residue nu, nh_common_curves *c)
{
    if (x->count == 1 && !alike(&x->at[0], c)) nh_common_curves_clear(&x->at[--x->count]);
    if (x->count && !alike(&x->at[0], c)) {
        nh_common_curves_clear(c);
        return;
    }
    x->nu[x->count] = nu;
    x->at[x->count++] = *c;
}

static bool more_sections(search *s, size_t degree, size_t prime, size_t want, nh_plane_row *row, sections *x)
{
    nh_prime f = nh_classify_prime(&s->s, prime);
    while (x->count < want && x->used < want + most_unlucky && !nh_late()) {
        nh_common_curves c = {.across = {0, NULL}};
        s->question.third_top = nu_at(x->used++);
        s->question.third_bottom = 1;
        s->s.products = s->question.products;
        nh_progress("sections of special surfaces", -1);
        if (!nh_plane_zeros(&s->s, degree, prime, row, &c)) {
            nh_common_curves_clear(&c);
            return false;
        }
        add_section(x, nh_residue_of(f, s->question.third_top), &c);
    }
    return x->count == want;
}

/* Special and degenerate surfaces and walls modulo one prime. */
typedef struct {
    nh_residue_surface part[3];
} volumes;

static void clear_volumes(volumes *v)
{
    for (int k = 0; k < 3; k++) nh_free(v->part[k].coefficient);
    *v = (volumes){0};
}

static nh_residue_surface part_of(const nh_common_curves *c, int part)
{
    nh_residue_surface across = {.degree = {0, c->across.degree}, .coefficient = c->across.coefficient};
    return part == 0 ? c->special : part == 1 ? c->degenerate : across;
}

static bool interpolate(const sections *x, nh_prime f, volumes *out)
{
    bool good = true;
    nh_residue_surface section[most_sections];
    for (int part = 0; part < 3 && good; part++) {
        for (size_t k = 0; k < x->count; k++) section[k] = part_of(&x->at[k], part);
        good = nh_residue_surface_from(f, x->count, x->nu, section, &out->part[part]);
    }
    if (!good) clear_volumes(out);
    return good;
}

/* Takes more sections until they suffice. */
static bool volumes_modulo(search *s, size_t degree, size_t prime, nh_plane_row *row, size_t *count, volumes *out)
{
    sections x = {.count = 0};
    bool good = true, found = false;
    for (size_t want = *count; want <= most_sections && good && !found; want += 2) {
        good = more_sections(s, degree, prime, want, row, &x);
        found = good && interpolate(&x, nh_classify_prime(&s->s, prime), out);
        *count = want;
    }
    if (good && !found) s->out->end = "surfaces";
    for (size_t k = 0; k < x.count; k++) nh_common_curves_clear(&x.at[k]);
    return found;
}

/* ---- from residues to surfaces and walls ---- */

typedef struct {
    size_t count;
    nh_prime prime[NH_CLASSIFY_MOST_PRIMES];
    nh_residue_surface part[3][NH_CLASSIFY_MOST_PRIMES];
} residues;

static void clear(residues *r)
{
    for (size_t i = 0; i < r->count; i++)
        for (int k = 0; k < 3; k++) nh_free(r->part[k][i].coefficient);
    r->count = 0;
}

static bool same_degrees(const residues *r, const volumes *v)
{
    bool same = true;
    for (int k = 0; k < 3; k++) same &= !memcmp(r->part[k][0].degree, v->part[k].degree, sizeof v->part[k].degree);
    return same;
}

/* Unlucky primes are treated as in a plane. */
static void add(residues *r, nh_prime prime, volumes *v)
{
    if (r->count == 1 && !same_degrees(r, v)) clear(r);
    if (r->count && !same_degrees(r, v)) {
        clear_volumes(v);
        return;
    }
    r->prime[r->count] = prime;
    for (int k = 0; k < 3; k++) r->part[k][r->count] = v->part[k];
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
    nh_special_surfaces found[3];
    bool lifted = true;
    for (int k = 0; k < 3; k++) {
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
    for (int k = 0; k < 3; k++) nh_special_surfaces_clear(&found[k]);
    return lifted;
}

static bool find_surfaces(search *s, size_t degree, nh_plane_row *row)
{
    residues r = {.count = 0};
    bool good = true;
    row->sections = first_sections;
    for (size_t prime = 0; prime < NH_CLASSIFY_MOST_PRIMES && good && !row->lifted; prime++) {
        volumes v = {0};
        good = volumes_modulo(s, degree, prime, row, &row->sections, &v);
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
    for (int part = 0; part < 3 && covered; part++) {
        size_t count;
        nh_residue_surface curve = part_of(&c, part);
        nh_special_surface *known = known_of(s->out, part == 2, &count);
        covered = nh_special_surfaces_cover(count, known, f, nu, &curve);
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
    return s->out->end ? s->out->end : s->s.family.obstacle ? s->s.family.obstacle : nh_late() ? "time"
        : !row->number.bounded ? "work" : row->size > s->question.plane ? "plane"
        : s->s.products < 0 ? "staircase" : "unknowns";
}

static void run(search *s)
{
    nh_space *o = s->out;
    while (o->rows < s->question.degree && !nh_late()) {
        nh_plane_row row = {.known = 0};
        size_t degree = o->rows + 1;
        nh_classify_place any = {.kind = NH_CLASSIFY_ANY};
        nh_progress("integrals for almost all values", -1);
        bool good = nh_classify_count(&s->s, degree, &any, 0, &row.known, &row.number)
            && find_surfaces(s, degree, &row) && sweep(s, degree, &row, s->question.planes) && !nh_late();
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
