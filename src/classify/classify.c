/* Special values of one parameter or more: where the equations lose rank modulo several primes, lifted to the
 * rationals; integrals are counted at every zero. */
#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "classify/classify_internal.h"
#include "classify/special_bound.h"

enum { least_primes = 4 };

typedef nh_classify_search search;
typedef nh_classify_place place;

/* ---- one prime: one parameter ---- */

static nh_parity parity_of(const nh_parametric_series *x, size_t degree)
{
    return !x->split ? NH_ALL_DEGREES : degree % 2 ? NH_ODD_DEGREES : NH_EVEN_DEGREES;
}

/* The linear system of one degree for every value of the parameters that vary, `variable` for each. */
static bool pencil_of(search *s, const nh_parametric_series *x, size_t degree, nh_sparse_pencil *out,
                      nh_parametric_variable *variable)
{
    memset(variable, 0, 2 * sizeof *variable);
    if (s->q.linear) return nh_parametric_linear_pencil(&s->family, x, degree, s->q.unknowns, out);
    return nh_parametric_pencil(&s->family, x, degree, parity_of(x, degree), s->q.unknowns, out, variable);
}

/* Q at the point of the series: (second + 1) x (degree + 1) coefficients. */
static nh_residue_polynomial singular_of(const nh_parametric_series *x)
{
    nh_residue_polynomial out = {.degree = {x->degree, x->second}};
    size_t count = (x->degree + 1) * (x->second + 1);
    out.coefficient = nh_alloc_array(count, sizeof *out.coefficient);
    for (size_t k = 0; k < count; k++) out.coefficient[k] = x->coefficient[k * x->length];
    return out;
}

/* chi of one parameter. */
static bool elementary_divisors(search *s, size_t degree, const nh_parametric_series *x, nh_classify_row *row,
                                nh_residue_polynomial *chi)
{
    nh_sparse_pencil pencil = {0};
    nh_parametric_variable variable[2];
    bool good = pencil_of(s, x, degree, &pencil, variable) &&
                nh_staircase(&pencil, x->ring->field, &s->products, chi, &row->nullity);
    if (good) {
        nh_parametric_back(&variable[0], 0, x->ring->field, chi);
        row->unknowns = pencil.columns;
        row->power[0] = pencil.degree;
        row->split = x->split;
    }
    nh_free(pencil.entry);
    return good;
}

/* ---- one prime: two parameters ---- */

/* One determinant of a compression at one point. */
static bool compressed_determinant(search *s, size_t degree, const nh_parametric_series *x, uint64_t seed,
                                   nh_classify_row *row, nh_residue_polynomial *out)
{
    nh_prime f = x->ring->field;
    nh_sparse_pencil pencil = {0};
    nh_parametric_variable variable[2];
    bool good = pencil_of(s, x, degree, &pencil, variable);
    if (good) {
        nh_staircase_matrices m = nh_staircase_reduce(&pencil, f, &s->products);
        size_t rank = nh_staircase_generic_rank(&m, f), size = rank * (m.degree > m.second ? m.degree : m.second);
        row->unknowns = pencil.columns;
        row->power[0] = pencil.degree;
        row->power[1] = pencil.second;
        if (size > row->size) row->size = size;
        good = size <= s->q.plane && s->products >= 0 && !nh_late();
        good = good && nh_staircase_determinant(&m, f, rank, seed, out);
        for (int v = 0; v < 2 && good; v++) nh_parametric_back(&variable[v], v, f, out);
        nh_free(m.entry);
    }
    nh_free(pencil.entry);
    return good;
}

/* ---- one prime: all ---- */

/* At two points for one parameter, at three for two: at two, intersections of curves that belong to the points would
 * remain.  Each polynomial is multiplied by Q, where which vanishes the equations at the point say nothing. */
bool nh_classify_zeros(search *s, size_t degree, size_t prime, nh_classify_row *row, nh_common_zeros *out)
{
    enum { most_points = 3 };
    nh_residue_polynomial d[most_points] = {{.degree = {0}}}, Q[most_points] = {{.degree = {0}}};
    nh_prime f = nh_classify_prime(s, prime);
    bool one = nh_classify_free(s) == 1, good = true;
    size_t points = one ? 2 : 3, nullity = 0;
    for (uint64_t k = 0; k < points && good; k++) {
        nh_parametric_series *x = nh_classify_series(s, f, 101 + 10 * k, row->number.order);
        nh_residue_polynomial factor = {.degree = {0}};
        good = x && (one ? elementary_divisors(s, degree, x, row, &factor)
                         : compressed_determinant(s, degree, x, 31 + 1000 * k + prime, row, &factor));
        if (good) {
            Q[k] = singular_of(x);
            d[k] = nh_residue_polynomial_times(f, &factor, &Q[k]);
            size_t top = Q[k].degree[0];
            while (top > 0 && !Q[k].coefficient[top]) top--;
            if (s->out && s->q.parameters == 1) s->out->limit = !s->q.linear && top == x->degree;
            if (row->nullity > nullity) nullity = row->nullity;
        }
        nh_free(factor.coefficient);
        nh_parametric_series_free(x);
    }
    row->nullity = nullity;
    good = good && nh_common_zeros_find(f, points, d, points, Q, out);
    out->nullity = nullity;
    for (size_t k = 0; k < points; k++) {
        nh_free(d[k].coefficient);
        nh_free(Q[k].coefficient);
    }
    return good;
}

/* From the zeros where the last parameter that varies, v, has one value after the other; `sections` of the row, and
 * more until they suffice.  False with too_few set: they never do. */
static bool zeros_of_sections(search *s, size_t degree, size_t prime, nh_classify_row *row, bool *too_few,
                              nh_common_zeros *out)
{
    enum { first = 4, most_unlucky = 6 };
    int v = nh_classify_free(s) - 1;
    nh_common_zeros_list sections = {.count = 0};
    size_t used = 0;
    bool good = true, found = false;
    if (!row->sections) row->sections = first;
    for (size_t want = row->sections; want <= NH_ZEROS_MOST && good && !found; want += 2) {
        while (sections.count < want && used < want + most_unlucky && !nh_late() && good) {
            nh_common_zeros zeros = {.nullity = 0};
            int64_t value = 7919 + 1009 * (int64_t)used++; /* these have no special meaning */
            nh_classify_hold(s, v, value, 1);
            if (v == 2) s->products = s->q.products;
            nh_progress(v == 1 ? "sections of special curves" : "sections of special surfaces", -1);
            good = nh_classify_zeros(s, degree, prime, row, &zeros);
            if (good) nh_common_zeros_list_add(&sections, (uint64_t)value, &zeros);
            else nh_common_zeros_clear(&zeros);
        }
        good = good && sections.count == want;
        found = good && nh_common_zeros_from(nh_classify_prime(s, prime), v, &sections, out);
        row->sections = want;
    }
    nh_classify_hold(s, v, 0, 0);
    nh_common_zeros_list_clear(&sections);
    *too_few = good && !found;
    return found;
}

/* ---- from residues to zeros over the rationals ---- */

static nh_classify_special *special_of(nh_classification *c, const nh_special_factor *f)
{
    for (size_t k = 0; k < c->specials; k++)
        if (nh_special_same(&c->special[k].polynomial, f)) return &c->special[k];
    nh_grow(&c->special, &c->special_capacity, c->specials + 1, sizeof *c->special);
    c->special[c->specials] = (nh_classify_special){.polynomial = nh_special_copy(f)};
    return &c->special[c->specials++];
}

void nh_classify_add_wall(nh_classification *c, const nh_special_factor *polynomial)
{
    for (size_t k = 0; k < c->walls; k++)
        if (nh_special_same(&c->wall[k].polynomial, polynomial)) return;
    nh_grow(&c->wall, &c->wall_capacity, c->walls + 1, sizeof *c->wall);
    c->wall[c->walls++] = (nh_classify_wall){.polynomial = nh_special_copy(polynomial)};
}

/* (p_1 p_2 .. / norm)^(1/(degree + n)) for n parameters: every prime divides the value of the product of all
 * polynomials times the denominators, which is at most H^(degree + n) norm, and not zero where they have no zero. */
static double height_of(const search *s, const nh_common_zeros_list *found, double norm)
{
    static const double rounding = 1e-9;
    double logarithm = -log(norm > 1 ? norm : 1);
    size_t degree = (size_t)nh_classify_free(s);
    for (int part = 0; part < NH_ZEROS_PARTS; part++)
        for (int v = 0; v < NH_MOST_PARAMETERS; v++) degree += found->at[0].part[part].degree[v];
    for (size_t i = 0; i < found->count; i++) logarithm += log((double)nh_classify_prime(s, found->key[i]).p);
    return floor(exp(logarithm / (double)degree) * (1 - rounding));
}

/* ---- every number ---- */

enum { coordinates_tried = 27, least_coordinate = 1, choices = 3, unlucky = 20 };

/* The tangent of half the angle is a whole number. */
static void choose_angle(nh_jet_point *point, nh_ex coordinate, int64_t q0)
{
    nh_prime f = point->field;
    nh_residue u = nh_residue_of(f, nh_special_bound_tangent(q0)), square = nh_residue_mul(f, u, u);
    nh_residue inverse = nh_residue_inverse(f, nh_residue_add(f, 1, square));
    for (size_t i = 0; i < point->kernels; i++) {
        nh_jet_kernel *k = &point->kernel[i];
        if (k->kind != NH_JET_CIRCLE || k->key != coordinate || k->order != 1) continue;
        k->value = nh_residue_mul(f, nh_residue_sub(f, 1, square), inverse);
        k->sine = nh_residue_mul(f, nh_residue_add(f, u, u), inverse);
        k->chosen = true;
    }
}

/* Searches whole coordinates at which the nullity modulo a prime is that of the random points, and bounds the length of
 * special values. */
static bool bound_at(search *s, size_t degree, const nh_classify_row *row, int64_t *q0, nh_special_bound *out)
{
    nh_jet_equations *x = s->family.counter.equations;
    bool found = false;
    for (size_t trial = 0; trial < coordinates_tried && !found && !nh_late(); trial++) {
        bool regular = nh_parametric_choose(&s->family, nh_classify_prime(s, 0), trial) && !s->family.counter.frame;
        for (size_t k = 0, rest = trial; k < x->coordinates; k++, rest /= choices) {
            q0[k] = least_coordinate + (int64_t)(rest % choices);
            x->at[k] = (nh_residue)q0[k];
            choose_angle(x->point, x->coordinate[k], q0[k]);
        }
        nh_residue_polynomial chi = {.degree = {0}};
        nh_classify_row here = {.known = 0};
        nh_parametric_series *series =
            regular ? nh_parametric_series_create(&s->family, row->number.order, &regular) : NULL;
        nh_parity parity = series ? parity_of(series, degree) : NH_ALL_DEGREES;
        found = series && elementary_divisors(s, degree, series, &here, &chi) && here.nullity == row->nullity;
        nh_parametric_series_free(series);
        if (found && !nh_special_bound_find(&s->family, degree, parity, row->number.order, q0,
                                            here.unknowns - here.nullity, out)) {
            found = false;
            trial = coordinates_tried;
        }
        nh_free(chi.coefficient);
    }
    return found;
}

/* The numbers for both parities add up to the number of integrals; degree - 1 has the other parity. */
static bool is_number(const search *s, size_t degree, const nh_classify_row *row)
{
    size_t other = !row->split ? 0 : degree == 1 ? 1 : s->out->row[degree - 2].nullity;
    return row->nullity + other == row->number.bound;
}

/* A special value that is no root of F, the product of the values, has a primitive polynomial g that divides a minor:
 * its leading coefficient and Mahler's measure are below 2^bits. Every prime divides lc(g) Res(g, F), which is below
 * 2^(bits (1 + deg F)) |F|_1^deg g.  `lifted`: special and degenerate values. */
static void exclude_all(search *s, size_t degree, const nh_common_zeros_list *found, const nh_special_factors lifted[2],
                        nh_classify_row *row)
{
    nh_jet_equations *x = s->family.counter.equations;
    nh_special_bound bound;
    int64_t *q0 = nh_alloc_array(x->coordinates + 1, sizeof *q0);
    double left = s->products, roots = 0, have = 0;
    bool known =
        !s->q.linear && s->q.parameters == 1 && is_number(s, degree, row) && bound_at(s, degree, row, q0, &bound);
    nh_free(q0);
    if (!known) return;
    for (int part = 0; part < 2; part++) roots += (double)found->at[0].part[part].degree[0];
    double need = bound.bits * (1 + roots) + bound.degree * log2(lifted[0].norm * lifted[1].norm);
    row->bits = bound.bits;
    row->theorem_primes = (size_t)(need / 30) + 1; /* each has more than 30 bits */
    size_t most = row->theorem_primes <= s->q.theorem ? row->theorem_primes + unlucky : 0;
    for (size_t prime = 0; prime < most && have <= need && !nh_late(); prime++) {
        nh_prime f = nh_classify_prime(s, prime);
        nh_common_zeros zeros;
        nh_classify_row here = *row;
        s->products = s->q.products;
        if (!nh_classify_zeros(s, degree, prime, &here, &zeros)) break;
        bool agree = here.nullity == row->nullity;
        for (int part = 0; part < 2 && agree; part++)
            agree = nh_special_cover(lifted[part].factors, lifted[part].factor, f, NH_MOST_PARAMETERS, 0,
                                     &zeros.part[part]);
        if (agree) have += log2((double)f.p);
        nh_common_zeros_clear(&zeros);
    }
    s->products = left;
    row->theorem = have > need && (degree == 1 || !row->split || s->out->row[degree - 2].theorem);
}

/* Takes what is known over the rationals.  False: one more prime does not confirm it. */
static bool lift_zeros(search *s, size_t degree, const nh_common_zeros_list *found, nh_classify_row *row)
{
    nh_special_factors lifted[NH_ZEROS_PARTS];
    nh_prime prime[NH_CLASSIFY_MOST_PRIMES];
    nh_residue_polynomial residue[NH_CLASSIFY_MOST_PRIMES];
    bool all = true;
    for (size_t i = 0; i < found->count; i++) prime[i] = nh_classify_prime(s, found->key[i]);
    for (int part = 0; part < NH_ZEROS_PARTS; part++) {
        for (size_t i = 0; i < found->count; i++) residue[i] = found->at[i].part[part];
        lifted[part] = nh_special_lift(found->count, prime, residue);
        all &= lifted[part].lifted;
    }
    for (int part = NH_ZEROS_DEGENERATE; part >= NH_ZEROS_SPECIAL && all; part--)
        for (size_t k = 0; k < lifted[part].factors; k++)
            special_of(s->out, &lifted[part].factor[k])->degenerate |= part == NH_ZEROS_DEGENERATE;
    for (size_t k = 0; k < lifted[NH_ZEROS_ACROSS].factors && all; k++)
        nh_classify_add_wall(s->out, &lifted[NH_ZEROS_ACROSS].factor[k]);
    if (all && s->q.parameters < 3) row->height = height_of(s, found, lifted[0].norm * lifted[1].norm * lifted[2].norm);
    if (all && nh_classify_free(s) == 1) {
        row->nullity = found->at[0].nullity;
        exclude_all(s, degree, found, lifted, row);
    }
    for (int part = 0; part < NH_ZEROS_PARTS; part++) nh_special_factors_clear(&lifted[part]);
    return all;
}

/* Takes more primes until the zeros are known over the rationals. */
static bool find_zeros(search *s, size_t degree, bool by_sections, nh_classify_row *row)
{
    nh_common_zeros_list found = {.count = 0};
    bool good = true, too_few = false;
    for (size_t prime = 0; prime < NH_CLASSIFY_MOST_PRIMES && good && !row->lifted; prime++) {
        nh_common_zeros zeros = {.nullity = 0};
        good = by_sections ? zeros_of_sections(s, degree, prime, row, &too_few, &zeros)
                           : nh_classify_zeros(s, degree, prime, row, &zeros);
        if (!good) {
            nh_common_zeros_clear(&zeros);
            break;
        }
        nh_common_zeros_list_add(&found, prime, &zeros);
        row->lifted = found.count >= least_primes && lift_zeros(s, degree, &found, row);
    }
    if (too_few && s->q.parameters == 3) s->out->end = "surfaces";
    row->roots = found.count ? found.at[0].part[NH_ZEROS_SPECIAL].degree[0] : 0;
    row->primes = found.count;
    for (size_t i = 0; i < found.count; i++) row->prime[i] = nh_classify_prime(s, found.key[i]).p;
    nh_common_zeros_list_clear(&found);
    return good;
}

/* ---- what is special of one degree ---- */

/* Of two parameters: by determinants, or, where these are too large, line by line; where the lines show more curves
 * than are known, these are found first, from their points on lines. */
static bool find_in_plane(search *s, size_t degree, nh_classify_row *row)
{
    nh_classification *c = s->out;
    bool swept = c->rows && c->row[c->rows - 1].swept;
    if (!swept && find_zeros(s, degree, false, row)) return true;
    swept |= !nh_late() && row->size > s->q.plane;
    if (!swept || !s->q.lines) return false;
    if (nh_classify_sweep(s, degree, s->q.lines, row)) return true;
    if (c->end != nh_classify_curves) return false;
    nh_classify_row found = *row;
    c->end = NULL;
    s->products = s->q.products;
    if (!find_zeros(s, degree, true, &found) || !found.lifted) {
        c->end = s->products < 0 ? NULL : nh_classify_curves;
        return false;
    }
    row->sections = found.sections;
    return nh_classify_sweep(s, degree, s->q.lines, row);
}

static bool find_special(search *s, size_t degree, nh_classify_row *row)
{
    if (s->q.parameters == 3)
        return find_zeros(s, degree, true, row) && row->lifted && nh_classify_sweep(s, degree, s->q.planes, row);
    return s->q.parameters == 2 && nh_classify_free(s) == 2 ? find_in_plane(s, degree, row)
                                                            : find_zeros(s, degree, false, row);
}

/* Counts the integrals of this degree at everything that was found so far. */
static void count_specials(search *s, size_t degree)
{
    static const char *const phase[] = {"special values", "special curves", "special surfaces"};
    size_t almost_all = s->out->row[degree - 1].number.bound;
    for (size_t k = 0; k < s->out->specials && !nh_late(); k++) {
        nh_classify_special *v = &s->out->special[k];
        if (v->degenerate) continue;
        nh_progress(phase[nh_classify_free(s) - 1], -1);
        place p = {.on = &v->polynomial};
        nh_classify_number *n = &v->number[degree];
        bool counted = nh_classify_count(s, degree, &p, almost_all, NULL, n), more = counted && n->bound > almost_all;
        if ((more || !counted) && !v->first && !v->open) v->degenerate = nh_classify_singular(s, &p);
        if (v->degenerate) continue;
        if (more && n->settled && !v->first) v->first = degree;
        if ((!counted || (more && !n->settled)) && !v->open) v->open = degree;
    }
}

/* ---- lines of two parameters ---- */

/* A point on a curve is special only if it has more integrals than the curve. */
static bool is_beyond_curves(const nh_classification *c, const nh_classify_special *v, const nh_special_factor *wall)
{
    nh_special_place at = {.count = 2, .gives = {1}, .equation = {*wall, v->polynomial}};
    for (size_t k = 0; k < c->specials; k++) {
        const nh_classify_special *curve = &c->special[k];
        if (!nh_special_contains(&curve->polynomial, &at)) continue;
        bool more = false;
        for (size_t d = 1; d <= c->rows; d++)
            more |= v->number[d].settled && curve->number[d].bounded && v->number[d].bound > curve->number[d].bound;
        if (curve->degenerate || !more) return false;
    }
    return true;
}

/* Classifies on the wall mu = top/bottom, unless it is a curve itself, or a degenerate one. */
static void classify_line(search *s, size_t index)
{
    nh_classification *c = s->out;
    nh_special_factor wall = c->wall[index].polynomial;
    place any = {.on = NULL};
    int64_t top, bottom;
    if (!nh_special_rational(&wall, &top, &bottom)) return;
    for (size_t k = 0; k < c->specials; k++)
        if (nh_special_same(&c->special[k].polynomial, &wall)) return;
    nh_classify_hold(s, 1, top, bottom);
    nh_classify_question q = s->q;
    bool degenerate = nh_classify_singular(s, &any);
    nh_classify_hold(s, 1, 0, 0);
    if (degenerate) {
        special_of(c, &wall)->degenerate = true;
        return;
    }
    q.degree = c->rows;
    nh_classification *within = c->wall[index].within = nh_classify(s->model, &q);
    for (size_t k = 0; k < within->specials; k++) {
        const nh_classify_special *v = &within->special[k];
        if (!v->first || v->degenerate || !is_beyond_curves(c, v, &wall)) continue;
        nh_grow(&c->point, &c->point_capacity, c->points + 1, sizeof *c->point);
        c->point[c->points++] = (nh_classify_point){index, k};
    }
}

/* ---- degrees ---- */

static size_t last_degree(const search *s) { return s->q.linear ? s->q.linear->levels : s->q.degree; }

static const char *end_of(const search *s, const nh_classify_row *row)
{
    return s->out->end              ? s->out->end
           : s->family.obstacle     ? s->family.obstacle
           : nh_late()              ? "time"
           : !row->number.bounded   ? "work"
           : s->products < 0        ? "staircase"
           : row->size > s->q.plane ? "plane"
                                    : "unknowns";
}

static void run(search *s)
{
    nh_classification *c = s->out;
    place any = {.on = NULL}, infinite = {.infinite = true};
    while (c->rows < last_degree(s) && !nh_late()) {
        nh_classify_row row = {.known = 0};
        size_t degree = c->rows + 1;
        nh_progress("integrals for almost all values", -1);
        bool good = nh_classify_count(s, degree, &any, 0, &row.known, &row.number);
        nh_progress("where the equations for integrals lose rank", -1);
        s->products = s->q.products;
        good = good && find_special(s, degree, &row) && !nh_late();
        if (s->q.linear && row.number.bound == 0) row.known = 0;
        /* the other parity was examined one degree lower */
        if (c->rows) row.height = fmin(row.height, c->row[c->rows - 1].height);
        if (!good) {
            c->end = end_of(s, &row);
            break;
        }
        c->row[c->rows++] = row;
        count_specials(s, degree);
        if (c->limit) nh_classify_count(s, degree, &infinite, row.number.bound, NULL, &c->row[degree - 1].infinite);
    }
    if (c->rows < last_degree(s) && !c->end) c->end = "time";
    for (size_t k = 0; k < c->walls && c->rows && nh_classify_free(s) == 2 && !nh_late(); k++) classify_line(s, k);
    if (s->family.obstacle && !c->rows) c->obstacle = s->family.obstacle;
    c->step = nh_parametric_step(&s->family);
}

nh_classification *nh_classify(const nh_model *model, const nh_classify_question *q)
{
    nh_classification *out = nh_alloc(sizeof *out);
    search s;
    nh_classify_open(&s, model, q);
    s.out = out;
    if (s.family.obstacle) out->obstacle = s.family.obstacle;
    else run(&s);
    nh_parametric_close(&s.family);
    return out;
}

nh_classification *nh_classification_refused(const char *obstacle)
{
    nh_classification *out = nh_alloc(sizeof *out);
    out->obstacle = obstacle;
    return out;
}

void nh_classification_free(nh_classification *c)
{
    if (!c) return;
    for (size_t k = 0; k < c->specials; k++) nh_free(c->special[k].polynomial.coefficient);
    for (size_t k = 0; k < c->walls; k++) {
        nh_free(c->wall[k].polynomial.coefficient);
        nh_classification_free(c->wall[k].within);
    }
    nh_free(c->special);
    nh_free(c->wall);
    nh_free(c->point);
    nh_free(c);
}
