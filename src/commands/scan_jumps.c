/* scan_jumps: where the numbers of a scan jump, along every line of the grid.
 *
 *     hit    the leading number at one point is another than at the points beside it
 *     step   it changes from one point to the next, and stays
 *     dip    a singular value is smallest at a point, and smaller than a parabola through the squares can be that stays
 *            away from zero:  sigma(lambda)^2 = m^2 + c^2 (lambda - lambda0)^2,  m small */
#include <math.h>
#include <string.h>

#include "commands/scan_internal.h"

static const double depth = 0.5; /* of a dip: largest m^2, as a part of the smallest square */

typedef struct {
    const nh_scan *scan;
    size_t axis, first, stride, count;
    double generic;
    nh_scan_jump *jump;
    size_t jumps, capacity;
} line;

static size_t place(const line *l, size_t i) { return l->first + i * l->stride; }
static const nh_scan_row *row(const line *l, size_t i) { return &l->scan->row[place(l, i)]; }
static double leading(const line *l, size_t i) { return row(l, i)->done ? row(l, i)->number[0] : NAN; }
static double at(const line *l, size_t i) { return l->scan->axis[l->axis].value[i].value; }

static nh_scan_jump *add(line *l, nh_scan_kind kind, size_t i)
{
    nh_grow(&l->jump, &l->capacity, l->jumps + 1, sizeof *l->jump);
    nh_scan_jump *j = &l->jump[l->jumps++];
    *j = (nh_scan_jump){.kind = kind, .axis = l->axis, .place = place(l, i), .generic = l->generic};
    return j;
}

/* The value that most points of the line have; of two the smaller one. */
static double most_common(const line *l, double (*value)(const line *, size_t, size_t), size_t space)
{
    double best = NAN;
    size_t times = 0;
    for (size_t i = 0; i < l->count; i++) {
        double v = value(l, i, space);
        size_t n = 0;
        for (size_t k = 0; k < l->count; k++) n += value(l, k, space) == v;
        if (n > times || (n && n == times && v < best)) {
            times = n;
            best = v;
        }
    }
    return best;
}

static double leading_of(const line *l, size_t i, size_t space)
{
    (void)space;
    return leading(l, i);
}

static double vanishing_of(const line *l, size_t i, size_t space)
{
    return row(l, i)->done && isfinite(row(l, i)->smallest[space]) ? (double)row(l, i)->vanishing[space] : NAN;
}

/* ---- the leading number ---- */

static bool is_hit(const line *l, size_t i)
{
    return i > 0 && i + 1 < l->count && isfinite(leading(l, i)) && leading(l, i) != l->generic &&
           leading(l, i - 1) == l->generic && leading(l, i + 1) == l->generic;
}

static void find_steps(line *l)
{
    for (size_t i = 0; i < l->count; i++)
        if (is_hit(l, i)) add(l, NH_SCAN_HIT, i);
    for (size_t i = 0; i + 1 < l->count; i++) {
        double a = leading(l, i), b = leading(l, i + 1);
        if (isfinite(a) && isfinite(b) && a != b && !is_hit(l, i) && !is_hit(l, i + 1)) add(l, NH_SCAN_STEP, i);
    }
}

/* ---- singular values ---- */

/* The singular value of a space at a point: 0 where one more vanishes, NAN where this is not known. */
static double sigma(const line *l, size_t i, size_t space, double generic)
{
    double n = vanishing_of(l, i, space);
    return n > generic ? 0 : n == generic ? row(l, i)->smallest[space] : NAN;
}

/* m^2 of the parabola through the three squares, over the middle one; INFINITY: it has no minimum there. */
static double bottom_of(const line *l, size_t i, size_t space, double generic)
{
    double x0 = at(l, i - 1) - at(l, i), x1 = at(l, i + 1) - at(l, i);
    double a = sigma(l, i - 1, space, generic), b = sigma(l, i, space, generic), c = sigma(l, i + 1, space, generic);
    if (!isfinite(a + b + c) || !(b < a) || !(b < c) || b == 0) return INFINITY;
    double u = (a * a - b * b) / x0, v = (c * c - b * b) / x1, curvature = (v - u) / (x1 - x0),
           slope = u - curvature * x0;
    return fmax(0, 1 - slope * slope / (4 * curvature) / (b * b));
}

/* The spaces with a dip at this point, the deepest first. */
static void find_dip(line *l, size_t i, const double *generic)
{
    double bottom[3] = {INFINITY, INFINITY, INFINITY};
    nh_scan_jump found = {0};
    for (size_t s = 0; s < l->scan->spaces; s++) {
        if (!l->scan->columns[s] || !isfinite(generic[s])) continue;
        double m = bottom_of(l, i, s, generic[s]);
        size_t k = found.spaces;
        if (!(m < depth)) continue;
        while (k > 0 && m < bottom[k - 1]) k--;
        if (k == 3) continue;
        if (found.spaces < 3) found.spaces++;
        for (size_t j = found.spaces - 1; j > k; j--) {
            bottom[j] = bottom[j - 1];
            found.space[j] = found.space[j - 1];
            found.vanishing[j] = found.vanishing[j - 1];
        }
        bottom[k] = m;
        found.space[k] = s;
        found.vanishing[k] = (size_t)generic[s];
    }
    if (!found.spaces) return;
    nh_scan_jump *j = add(l, NH_SCAN_DIP, i);
    j->spaces = found.spaces;
    memcpy(j->space, found.space, sizeof found.space);
    memcpy(j->vanishing, found.vanishing, sizeof found.vanishing);
}

/* A point of the grid at which one more vanishes, where the leading number is not known. */
static void find_vanishing(line *l, size_t i, const double *generic)
{
    if (isfinite(leading(l, i))) return;
    for (size_t s = 0; s < l->scan->spaces; s++) {
        if (!l->scan->columns[s] || !isfinite(generic[s]) || sigma(l, i, s, generic[s]) != 0) continue;
        nh_scan_jump *j = add(l, NH_SCAN_HIT, i);
        j->spaces = 1;
        j->space[0] = s;
        j->vanishing[0] = (size_t)generic[s];
        return;
    }
}

static void look_along(line *l)
{
    double *generic = nh_alloc_array(l->scan->spaces + 1, sizeof *generic);
    l->generic = most_common(l, leading_of, 0);
    for (size_t s = 0; s < l->scan->spaces; s++) generic[s] = most_common(l, vanishing_of, s);
    find_steps(l);
    for (size_t i = 0; i < l->count; i++) find_vanishing(l, i, generic);
    for (size_t i = 1; i + 1 < l->count; i++) find_dip(l, i, generic);
    nh_free(generic);
}

size_t nh_scan_jumps(const nh_scan *x, nh_scan_jump **out)
{
    line l = {.scan = x};
    for (size_t a = 0; a < x->axes; a++) {
        l.axis = a;
        l.stride = nh_scan_stride(x, a);
        l.count = x->axis[a].count;
        for (l.first = 0; l.first < x->points && x->axis[a].ascending; l.first++)
            if (nh_scan_index(x, l.first, a) == 0) look_along(&l);
    }
    *out = nh_arena_alloc(x->arena, (l.jumps + 1) * sizeof **out);
    if (l.jumps) memcpy(*out, l.jump, l.jumps * sizeof **out);
    nh_free(l.jump);
    return l.jumps;
}
