/* Special curves and points of two parameters: determinants at three points modulo several primes, lifted to the
 * rationals. */
#include "classify/plane.h"

#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "classify/plane_internal.h"
#include "classify/plane_sweep.h"
#include "classify/sections.h"

enum { least_primes = 4, places = 3 };

typedef struct {
    nh_classify_search s;
    const nh_model *model;
    nh_plane *out;
} search;

/* ---- determinants ---- */

/* Multiplies by x^low and rewrites a polynomial in the pencil's variables as one in the parameters; in place. */
static void back(nh_residue_surface *x, int v, const nh_parametric_variable *variable, nh_prime f)
{
    size_t root = variable->reciprocal || variable->scaled, D = x->degree[v], width = x->degree[0] + 1;
    size_t out_width = v ? width : width + root, stride = v ? out_width : 1, others = x->degree[1 - v];
    nh_residue *c = nh_alloc_array(out_width * (x->degree[1] + 1 + (v ? root : 0)), sizeof *c);
    for (size_t other = 0; other <= others; other++) {
        nh_residue *line = c + (v ? other : other * out_width);
        const nh_residue *from = x->coefficient + (v ? other : other * width);
        for (size_t k = 0; k <= D; k++)
            line[(k + root) * stride] = from[(variable->reciprocal ? D - k : k) * (v ? width : 1)];
        for (size_t i = 0; i < D + root && variable->origin; i++)
            for (size_t j = D + root; j-- > i;)
                line[j * stride] =
                    nh_residue_sub(f, line[j * stride], nh_residue_mul(f, variable->origin, line[(j + 1) * stride]));
    }
    nh_free(x->coefficient);
    x->coefficient = c;
    x->degree[v] += root;
}

/* Q at the point, as a polynomial in both. */
static nh_residue_surface singular(const nh_parametric_series *x)
{
    nh_residue_surface out = {.degree = {x->degree, x->second}};
    size_t count = (x->degree + 1) * (x->second + 1);
    out.coefficient = nh_alloc_array(count, sizeof *out.coefficient);
    for (size_t k = 0; k < count; k++) out.coefficient[k] = x->coefficient[k * x->length];
    return out;
}

/* One determinant at one point, times Q. */
static bool determinants(nh_classify_search *s, const nh_parametric_series *x, size_t degree, uint64_t seed,
                         nh_plane_row *row, nh_residue_surface *out, nh_residue_surface *Q)
{
    nh_prime f = x->ring->field;
    nh_sparse_pencil pencil = {0};
    nh_parametric_variable variable[2] = {{.origin = 0}};
    nh_parity parity = !x->split ? NH_ALL_DEGREES : degree % 2 ? NH_ODD_DEGREES : NH_EVEN_DEGREES;
    bool good = nh_parametric_pencil(&s->family, x, degree, parity, s->q->unknowns, &pencil, variable);
    if (good) {
        nh_staircase_matrices m = nh_staircase_reduce(&pencil, f, &s->products);
        size_t rank = nh_compression_rank(&m, f), size = rank * (m.degree > m.second ? m.degree : m.second);
        row->unknowns = pencil.columns;
        row->power[0] = pencil.degree;
        row->power[1] = pencil.second;
        if (size > row->size) row->size = size;
        good = size <= s->q->plane && s->products >= 0 && !nh_late();
        *Q = singular(x);
        nh_residue_surface d;
        good = good && nh_compression_determinant(&m, f, rank, seed, &d);
        for (int v = 0; v < 2 && good; v++) back(&d, v, &variable[v], f);
        if (good) *out = nh_residue_surface_times(f, &d, Q), nh_free(d.coefficient);
        nh_free(m.entry);
    }
    nh_free(pencil.entry);
    return good;
}

bool nh_plane_zeros(nh_classify_search *s, size_t degree, size_t prime, nh_plane_row *row, nh_common_curves *out)
{
    nh_residue_surface d[places] = {{.degree = {0}}}, Q[places] = {{.degree = {0}}};
    bool good = true;
    for (uint64_t k = 0; k < places && good; k++) {
        nh_parametric_series *x = nh_classify_series(s, nh_classify_prime(s, prime), 101 + 10 * k, row->number.order);
        good = x && determinants(s, x, degree, 31 + 1000 * k + prime, row, &d[k], &Q[k]);
        nh_parametric_series_free(x);
    }
    if (good) good = nh_common_curves_find(nh_classify_prime(s, prime), places, d, places, Q, out);
    for (size_t k = 0; k < places; k++) {
        nh_free(d[k].coefficient);
        nh_free(Q[k].coefficient);
    }
    return good;
}

/* ---- from residues to curves and lines ---- */

typedef struct {
    size_t count;
    nh_prime prime[NH_CLASSIFY_MOST_PRIMES];
    nh_residue_surface special[NH_CLASSIFY_MOST_PRIMES], degenerate[NH_CLASSIFY_MOST_PRIMES];
    nh_residue_polynomial across[NH_CLASSIFY_MOST_PRIMES];
} residues;

static void clear(residues *r)
{
    for (size_t i = 0; i < r->count; i++) {
        nh_free(r->special[i].coefficient);
        nh_free(r->degenerate[i].coefficient);
        nh_free(r->across[i].coefficient);
    }
    r->count = 0;
}

static bool alike(const residues *r, const nh_common_curves *c)
{
    return !memcmp(r->special[0].degree, c->special.degree, sizeof c->special.degree) &&
           !memcmp(r->degenerate[0].degree, c->degenerate.degree, sizeof c->degenerate.degree) &&
           r->across[0].degree == c->across.degree;
}

/* A prime at which the degrees differ is unlucky: the first one, when the second disagrees with it, otherwise the new
 * one. */
static void add(residues *r, nh_prime prime, nh_common_curves *c)
{
    if (r->count == 1 && !alike(r, c)) clear(r);
    if (r->count && !alike(r, c)) {
        nh_common_curves_clear(c);
        return;
    }
    r->prime[r->count] = prime;
    r->special[r->count] = c->special;
    r->degenerate[r->count] = c->degenerate;
    r->across[r->count++] = c->across;
}

void nh_plane_take_curves(nh_plane_curve **list, size_t *count, size_t *capacity, const nh_special_surfaces *found,
                          bool degenerate)
{
    for (size_t k = 0; k < found->surfaces; k++) {
        size_t at = 0;
        while (at < *count && !nh_special_surface_same(&(*list)[at].polynomial, &found->surface[k])) at++;
        if (at == *count) {
            nh_grow(list, capacity, *count + 1, sizeof **list);
            (*list)[(*count)++] = (nh_plane_curve){.polynomial = nh_special_surface_copy(&found->surface[k])};
        }
        (*list)[at].degenerate |= degenerate;
    }
}

static void take_lines(nh_plane *o, size_t count, const nh_special_factor *factor)
{
    for (size_t k = 0; k < count; k++) {
        const nh_special_factor *f = &factor[k];
        size_t at = 0, length = (f->degree + 1) * sizeof *f->coefficient;
        while (at < o->lines && (o->line[at].across.degree != f->degree ||
                                 memcmp(o->line[at].across.coefficient, f->coefficient, length)))
            at++;
        if (at < o->lines) continue;
        nh_grow(&o->line, &o->line_capacity, o->lines + 1, sizeof *o->line);
        o->line[o->lines++] = (nh_plane_line){.across = {.degree = f->degree, .coefficient = nh_alloc(length)}};
        memcpy(o->line[at].across.coefficient, f->coefficient, length);
    }
}

/* As for one parameter: every prime divides the value of the product of all polynomials times their denominators. */
static double height(const residues *r, double norm)
{
    double logarithm = -log(norm > 1 ? norm : 1);
    size_t degree = 2 + r->across[0].degree;
    for (int v = 0; v < 2; v++) degree += r->special[0].degree[v] + r->degenerate[0].degree[v];
    for (size_t i = 0; i < r->count; i++) logarithm += log((double)r->prime[i].p);
    return floor(exp(logarithm / (double)degree) * (1 - 1e-9));
}

static bool lift(search *s, const residues *r, nh_plane_row *row)
{
    nh_special_surfaces special = nh_special_surfaces_lift(r->count, r->prime, r->special);
    nh_special_surfaces degenerate = nh_special_surfaces_lift(r->count, r->prime, r->degenerate);
    nh_special_factors across = nh_special_lift(r->count, r->prime, r->across);
    bool lifted = special.lifted && degenerate.lifted && across.lifted;
    if (lifted) {
        nh_plane *o = s->out;
        nh_plane_take_curves(&o->curve, &o->curves, &o->curve_capacity, &degenerate, true);
        nh_plane_take_curves(&o->curve, &o->curves, &o->curve_capacity, &special, false);
        take_lines(s->out, across.factors, across.factor);
        row->height = height(r, special.norm * degenerate.norm * across.norm);
    }
    nh_special_surfaces_clear(&special);
    nh_special_surfaces_clear(&degenerate);
    nh_special_factors_clear(&across);
    return lifted;
}

/* ---- points on lines ---- */

typedef struct {
    search *s;
    nh_classify_question *q;
    size_t degree, prime;
    const nh_plane_row *row;
} section;

/* Points where mu has this value. */
static bool section_at(void *context, int64_t mu, nh_common_curves *out)
{
    const section *x = context;
    nh_classify_row row = {.number = x->row->number};
    nh_special_roots roots;
    x->q->top = mu;
    x->q->bottom = 1;
    nh_progress("sections of special curves", -1);
    if (!nh_classify_roots(&x->s->s, x->degree, x->prime, &row, &roots)) return false;
    *out = (nh_common_curves){
        .special = {.degree = {roots.excluded.degree}, .coefficient = roots.excluded.coefficient},
        .degenerate = {.degree = {roots.degenerate.degree}, .coefficient = roots.degenerate.coefficient},
        .across = {.coefficient = nh_alloc_array(1, sizeof *out->across.coefficient)}};
    out->across.coefficient[0] = 1;
    return true;
}

/* mu becomes the second variable. */
static nh_residue_surface in_mu(nh_residue_surface a)
{
    return (nh_residue_surface){.degree = {a.degree[0], a.degree[2]}, .coefficient = a.coefficient};
}

/* Modulo one prime: curves on which lambda is not constant from their points on lines, where the determinants are too
 * large; isolated points are not found. */
static bool curves_from_points(search *s, size_t degree, size_t prime, nh_plane_row *row, nh_common_curves *out)
{
    enum { first_sections = 4 };
    const nh_classify_question *own = s->s.q;
    nh_classify_question q = *own;
    section x = {.s = s, .q = &q, .degree = degree, .prime = prime, .row = row};
    nh_sections found;
    bool held = s->s.family.held, too_few;
    size_t count = row->sections ? row->sections : first_sections;
    nh_prime f = nh_classify_prime(&s->s, prime);
    s->s.q = &q;
    s->s.family.held = true;
    bool good = nh_sections_find(f, section_at, &x, &count, &too_few, &found);
    s->s.q = own;
    s->s.family.held = held;
    row->sections = count;
    if (!good) return false;
    *out = (nh_common_curves){in_mu(found.special), in_mu(found.degenerate), {.coefficient = found.across.coefficient}};
    return true;
}

/* Takes more primes until the curves and lines are known over the rationals. */
static bool find_zeros(search *s, size_t degree, bool from_points, nh_plane_row *row)
{
    residues r = {.count = 0};
    bool good = true;
    s->s.products = s->s.q->products;
    for (size_t prime = 0; prime < NH_CLASSIFY_MOST_PRIMES && good && !row->lifted; prime++) {
        nh_common_curves curves = {.across = {0, NULL}};
        good = from_points ? curves_from_points(s, degree, prime, row, &curves)
                           : nh_plane_zeros(&s->s, degree, prime, row, &curves);
        if (!good) {
            nh_common_curves_clear(&curves);
            break;
        }
        add(&r, nh_classify_prime(&s->s, prime), &curves);
        row->lifted = r.count >= least_primes && lift(s, &r, row);
    }
    row->primes = r.count;
    for (size_t i = 0; i < r.count; i++) row->prime[i] = r.prime[i].p;
    clear(&r);
    return good;
}

/* ---- numbers on curves and lines ---- */

void nh_plane_count_curves(nh_classify_search *s, nh_classify_kind kind, size_t degree, size_t almost_all, size_t count,
                           nh_plane_curve *curve)
{
    for (size_t k = 0; k < count && !nh_late(); k++) {
        nh_plane_curve *c = &curve[k];
        if (c->degenerate) continue;
        nh_progress(kind == NH_CLASSIFY_CURVE ? "special curves" : "special surfaces", -1);
        nh_classify_place p = {.kind = kind, .surface = &c->polynomial};
        nh_classify_number *n = &c->number[degree];
        bool counted = nh_classify_count(s, degree, &p, almost_all, NULL, n), more = counted && n->bound > almost_all;
        if ((more || !counted) && !c->first && !c->open) c->degenerate = nh_classify_singular(s, &p);
        if (c->degenerate) continue;
        if (more && n->settled && !c->first) c->first = degree;
        if ((!counted || (more && !n->settled)) && !c->open) c->open = degree;
    }
}

/* Is the line mu = top/bottom itself one of the curves? */
static bool is_curve(const nh_plane *o, int64_t top, int64_t bottom)
{
    for (size_t k = 0; k < o->curves; k++) {
        const nh_special_curve *c = &o->curve[k].polynomial;
        if (c->degree[0] == 0 && c->degree[1] == 1 && c->coefficient[1] * top + c->coefficient[0] * bottom == 0)
            return true;
    }
    return false;
}

/* A point on a curve is special only if it has more integrals than the curve. */
static bool beyond_curves(const nh_plane *o, const nh_classify_value *v, int64_t top, int64_t bottom)
{
    for (size_t k = 0; k < o->curves; k++) {
        const nh_plane_curve *c = &o->curve[k];
        if (!nh_special_curve_contains(&c->polynomial, &v->polynomial, top, bottom)) continue;
        bool more = false;
        for (size_t d = 1; d <= o->rows; d++)
            more |= v->number[d].settled && c->number[d].bounded && v->number[d].bound > c->number[d].bound;
        if (c->degenerate || !more) return false;
    }
    return true;
}

/* Have the equations no meaning on the line of this question? Then it is a degenerate curve. */
static bool take_degenerate(search *s, const nh_classify_question *line)
{
    const nh_classify_question *own = s->s.q;
    nh_plane *o = s->out;
    bool held = s->s.family.held;
    nh_classify_place any = {.kind = NH_CLASSIFY_ANY};
    s->s.q = line;
    s->s.family.held = true;
    bool degenerate = nh_classify_singular(&s->s, &any);
    s->s.q = own;
    s->s.family.held = held;
    if (!degenerate) return false;
    int64_t coefficient[2] = {-line->top, line->bottom};
    nh_special_curve curve = {.degree = {0, 1}, .coefficient = coefficient};
    nh_special_surfaces one = {.surfaces = 1, .surface = &curve};
    nh_plane_take_curves(&o->curve, &o->curves, &o->curve_capacity, &one, true);
    return true;
}

static void classify_line(search *s, size_t index)
{
    nh_plane *o = s->out;
    nh_plane_line *l = &o->line[index];
    if (l->across.degree != 1) return;
    nh_classify_question q = *s->s.q;
    q.top = -l->across.coefficient[0];
    q.bottom = l->across.coefficient[1];
    q.degree = o->rows;
    if (is_curve(o, q.top, q.bottom) || take_degenerate(s, &q)) return;
    l->line = nh_classify(s->model, &q);
    for (size_t k = 0; k < l->line->values; k++) {
        const nh_classify_value *v = &l->line->value[k];
        if (!v->first || v->degenerate || !beyond_curves(o, v, q.top, q.bottom)) continue;
        nh_grow(&o->point, &o->point_capacity, o->points + 1, sizeof *o->point);
        o->point[o->points++] = (nh_plane_point){index, k};
    }
}

/* ---- degrees ---- */

/* Beyond the largest determinant, lines are examined. */
static bool sweep(search *s, size_t degree, nh_plane_row *row)
{
    nh_plane_sweep x;
    nh_plane *o = s->out;
    nh_special_curve *curve = nh_alloc_array(o->curves + 1, sizeof *curve);
    nh_special_factor *line = nh_alloc_array(o->lines + 1, sizeof *line);
    for (size_t k = 0; k < o->curves; k++) curve[k] = o->curve[k].polynomial;
    for (size_t k = 0; k < o->lines; k++) line[k] = o->line[k].across;
    nh_plane_known known = {o->curves, o->lines, curve, line};
    bool good = nh_plane_sweep_lines(&s->s, &known, degree, &row->number, s->s.q->lines, &x);
    nh_free(line);
    nh_free(curve);
    if (x.curves && !nh_late()) s->out->end = "curves";
    if (good) {
        take_lines(s->out, x.count, x.line);
        row->swept = x.examined;
        row->lifted = true;
        row->height = x.height;
        row->primes = 1;
        row->prime[0] = nh_classify_prime(&s->s, 0).p;
    }
    nh_plane_sweep_clear(&x);
    return good;
}

/* Where the lines show more curves than are known, these are found first. */
static bool find_on_lines(search *s, size_t degree, nh_plane_row *row)
{
    static const char unknown[] = "curves";
    nh_plane *o = s->out;
    if (sweep(s, degree, row)) return true;
    if (!o->end || strcmp(o->end, unknown)) return false;
    nh_plane_row found = *row;
    o->end = NULL;
    if (!find_zeros(s, degree, true, &found) || !found.lifted) {
        o->end = s->s.products < 0 ? NULL : unknown;
        return false;
    }
    row->sections = found.sections;
    return sweep(s, degree, row);
}

static void run(search *s)
{
    nh_plane *o = s->out;
    while (o->rows < s->s.q->degree && !nh_late()) {
        nh_plane_row row = {.known = 0};
        size_t degree = o->rows + 1;
        nh_classify_place any = {.kind = NH_CLASSIFY_ANY};
        nh_progress("integrals for almost all values", -1);
        bool good = nh_classify_count(&s->s, degree, &any, 0, &row.known, &row.number);
        nh_progress("where the equations for integrals lose rank", -1);
        bool swept = o->rows && o->row[o->rows - 1].swept, found = good && !swept && find_zeros(s, degree, false, &row);
        if (good && !found && !nh_late()) swept |= row.size > s->s.q->plane;
        good = good && (found || (swept && s->s.q->lines && find_on_lines(s, degree, &row))) && !nh_late();
        if (o->rows) row.height = fmin(row.height, o->row[o->rows - 1].height);
        if (!good) {
            if (!o->end)
                o->end = s->s.family.obstacle       ? s->s.family.obstacle
                         : nh_late()                ? "time"
                         : !row.number.bounded      ? "work"
                         : s->s.products < 0        ? "staircase"
                         : row.size > s->s.q->plane ? "plane"
                                                    : "unknowns";
            break;
        }
        o->row[o->rows++] = row;
        nh_plane_count_curves(&s->s, NH_CLASSIFY_CURVE, degree, row.number.bound, o->curves, o->curve);
    }
    for (size_t k = 0; k < o->lines && o->rows && !nh_late(); k++) classify_line(s, k);
    if (s->s.family.obstacle && !o->rows) o->obstacle = s->s.family.obstacle;
}

nh_plane *nh_plane_classify(const nh_model *model, const nh_classify_question *q)
{
    search s = {.model = model, .out = nh_alloc(sizeof *s.out)};
    nh_classify_open(&s.s, model, q);
    if (s.s.family.obstacle) s.out->obstacle = s.s.family.obstacle;
    else run(&s);
    nh_parametric_close(&s.s.family);
    return s.out;
}

void nh_plane_free(nh_plane *o)
{
    if (!o) return;
    for (size_t k = 0; k < o->curves; k++) nh_free(o->curve[k].polynomial.coefficient);
    for (size_t k = 0; k < o->lines; k++) {
        nh_free(o->line[k].across.coefficient);
        nh_classification_free(o->line[k].line);
    }
    nh_free(o->curve);
    nh_free(o->line);
    nh_free(o->point);
    nh_free(o);
}
