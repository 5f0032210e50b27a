/* The plane of two parameters as a plot, and slices of the space of three, planes of lambda and mu at values of nu:
 * special curves and surfaces, and points with more integrals. */
#include <math.h>
#include <string.h>

#include "document/classification_internal.h"

enum { steps = 401, most_slices = 3, most_crossings = 16 };

typedef struct {
    const nh_classified *of;
    nh_arena *arena;
    double nu; /* of three parameters; otherwise 0 */
    size_t count, capacity;
    nh_curve *curve;
    double low[2], high[2]; /* ranges of lambda and mu */
} drawing;

/* ---- what lies in the slice ---- */

/* The index-th place, where it has this dimension and a point of dimension 0 lies in the slice. */
static const nh_classified_place *place_of(const drawing *d, size_t index, size_t dimension)
{
    const nh_classified_place *p = &d->of->place[index];
    bool there = dimension || d->of->parameters == 2 || p->about[2] == d->nu;
    return p->dimension == dimension && there ? p : NULL;
}

/* Where a curve of three parameters meets the slice; returns the number of points. */
static size_t crossings(const drawing *d, const nh_classified_place *p, double (*out)[2])
{
    int v = p->zeros.gives[0], other = 1 - v;
    if (v == 2 || p->zeros.equation[1].degree[other] == 0) return 0;
    double *root = nh_alloc_array(p->zeros.equation[1].degree[other] + 1, sizeof *root), at[3] = {0, 0, d->nu}, last[2];
    size_t count = 0, roots = nh_special_reals(&p->zeros.equation[1], other, at, root);
    for (size_t i = 0; i < roots && count < most_crossings; i++) {
        at[other] = root[i];
        if (nh_special_reals(&p->zeros.equation[0], v, at, last) != 1) continue;
        at[v] = last[0];
        memcpy(out[count++], at, sizeof *out);
    }
    nh_free(root);
    return count;
}

/* ---- the window ---- */

static void widen(drawing *d, int v, double value)
{
    if (!isfinite(value)) return;
    d->low[v] = fmin(d->low[v], value);
    d->high[v] = fmax(d->high[v], value);
}

/* The real zeros over the middle of the window, in both directions. */
static void widen_by_zeros(drawing *d, const nh_special_factor *s)
{
    double middle[3] = {(d->low[0] + d->high[0]) / 2, (d->low[1] + d->high[1]) / 2, d->nu};
    for (int v = 1; v >= 0; v--) {
        double *root = nh_alloc_array(s->degree[v] + 1, sizeof *root);
        size_t roots = nh_special_reals(s, v, middle, root);
        for (size_t i = 0; i < roots; i++) widen(d, v, root[i]);
        nh_free(root);
    }
}

/* Contains zero, the values at which the family was analysed, all points, and curves over the middle of these. */
static void choose_window(drawing *d)
{
    const nh_classified *x = d->of;
    const nh_system *system = x->almost_all->question->system;
    double at[most_crossings][2];
    for (size_t i = 0; i < system->parameters; i++)
        for (int v = 0; v < 2; v++)
            if (system->parameter[i].name && !strcmp(system->parameter[i].name, x->over[v]))
                widen(d, v, system->parameter[i].value);
    for (size_t k = 0; k < x->places && x->parameters == 3; k++) {
        size_t count = place_of(d, k, 1) ? crossings(d, &x->place[k], at) : 0;
        for (size_t i = 0; i < 2 * count; i++) widen(d, (int)(i % 2), at[i / 2][i % 2]);
    }
    for (size_t k = 0; k < x->places; k++)
        for (int v = 0; v < 2 && place_of(d, k, 0); v++) widen(d, v, x->place[k].about[v]);
    for (size_t k = 0; k < x->classification->specials; k++)
        if (x->classification->special[k].first) widen_by_zeros(d, &x->classification->special[k].polynomial);
    for (int v = 0; v < 2; v++) {
        double span = d->high[v] > d->low[v] ? d->high[v] - d->low[v] : 1;
        d->low[v] -= 0.1 * span;
        d->high[v] += 0.1 * span;
    }
}

/* ---- curves and points ---- */

static nh_curve *new_curve(drawing *d, const char *name, size_t count, double *to[2])
{
    nh_grow(&d->curve, &d->capacity, d->count + 1, sizeof *d->curve);
    for (int v = 0; v < 2; v++) to[v] = nh_arena_alloc(d->arena, (count + 1) * sizeof **to);
    d->curve[d->count] = (nh_curve){.name = name, .count = count, .x = to[1], .y = to[0], .x_stride = 1, .y_stride = 1};
    return &d->curve[d->count++];
}

/* Branch after branch with gaps between them; lambda over mu, or mu over lambda where lambda does not occur. */
static void draw_zeros(drawing *d, const nh_special_factor *s, const char *name)
{
    int v = s->degree[0] ? 0 : 1;
    size_t branches = s->degree[v];
    double *to[2], *root = nh_alloc_array(branches + 1, sizeof *root), at[3] = {0, 0, d->nu};
    if (branches) new_curve(d, name, branches * (steps + 1), to);
    for (size_t b = 0; b < branches; b++)
        for (size_t k = 0; k <= steps; k++) {
            at[1 - v] = d->low[1 - v] + (d->high[1 - v] - d->low[1 - v]) * (double)k / (steps - 1);
            size_t roots = k < steps ? nh_special_reals(s, v, at, root) : 0, i = b * (steps + 1) + k;
            bool inside = b < roots && root[b] >= d->low[v] && root[b] <= d->high[v];
            to[1 - v][i] = inside ? at[1 - v] : NAN;
            to[v][i] = inside ? root[b] : NAN;
        }
    nh_free(root);
}

/* A curve of three parameters: its points in the slice, or the curve where it lies in it. */
static void draw_curve(drawing *d, const nh_classified_place *p, const char *name)
{
    double at[most_crossings][2], *to[2];
    size_t count = crossings(d, p, at);
    if (count) new_curve(d, name, count, to)->dots = true;
    for (size_t k = 0; k < 2 * count; k++) to[k % 2][k / 2] = at[k / 2][k % 2];
    int64_t top, bottom;
    if (p->zeros.gives[0] == 2 && nh_special_rational(&p->zeros.equation[0], &top, &bottom) &&
        (double)top / (double)bottom == d->nu)
        draw_zeros(d, &p->zeros.equation[1], name);
}

/* The points by their numbers of integrals, in ascending order. */
static void draw_points(drawing *d)
{
    const nh_classified *x = d->of;
    size_t rows = x->classification->rows, last = 0;
    for (size_t next = 0; next != SIZE_MAX; last = next) {
        double *to[2];
        size_t count = 0;
        next = SIZE_MAX;
        for (size_t k = 0; k < x->places; k++) {
            const nh_classified_place *p = place_of(d, k, 0);
            if (!p || !isfinite(p->about[0]) || !isfinite(p->about[1])) continue;
            size_t n = p->number[rows].bound;
            if (n > last && n < next) next = n;
        }
        if (next == SIZE_MAX) return;
        nh_curve *c = new_curve(d, nh_arena_printf(d->arena, "points with %zu", next), x->places, to);
        for (size_t k = 0; k < x->places; k++) {
            const nh_classified_place *p = place_of(d, k, 0);
            if (!p || !isfinite(p->about[0]) || !isfinite(p->about[1]) || p->number[rows].bound != next) continue;
            for (int v = 0; v < 2; v++) to[v][count] = p->about[v];
            count++;
        }
        c->count = count;
        c->dots = true;
    }
}

static void draw_plane(const nh_classified *x, double nu, nh_pen *pen)
{
    drawing d = {.of = x, .arena = x->arena, .nu = nu};
    const nh_classification *c = x->classification;
    char digits[32] = "";
    choose_window(&d);
    for (size_t k = 0; k < c->specials; k++) {
        const nh_classify_special *s = &c->special[k];
        if (!s->first && !s->degenerate) continue;
        const char *words = nh_classified_equation(x, &s->polynomial);
        draw_zeros(&d, &s->polynomial,
                   s->degenerate ? nh_arena_printf(d.arena, "%s: degenerate", words)
                                 : nh_arena_printf(d.arena, "%s: %zu", words, s->number[c->rows].bound));
    }
    for (size_t k = 0; k < x->places && x->parameters == 3; k++) {
        const nh_classified_place *p = place_of(&d, k, 1);
        if (p) draw_curve(&d, p, nh_arena_printf(d.arena, "%s: %zu", p->where, p->number[c->rows].bound));
    }
    draw_points(&d);
    if (x->parameters == 3) nh_text_number(nu, digits, sizeof digits);
    const char *slice = *digits ? nh_arena_printf(d.arena, "%s = %s", x->over[2], digits) : NULL;
    const char *only = d.count == 1 ? d.curve[0].name : NULL; /* the plot has no legend */
    const char *caption = nh_arena_printf(
        d.arena, "%s%sNumbers of integrals of degree %zu, with the constant 1%s%s; elsewhere %zu.", slice ? slice : "",
        slice ? ". " : "", c->rows, only ? ": " : "", only ? only : "", c->row[c->rows - 1].number.bound);
    nh_plot plot = {.title = slice ? nh_arena_printf(d.arena, "Where there are more, %s", slice)
                                   : "Where there are more conservation laws",
                    .description = caption,
                    .x_label = x->over[1],
                    .y_label = x->over[0],
                    .curves = d.count,
                    .curve = d.curve};
    if (d.count) pen->ink->plot(pen->to, &plot, caption);
    nh_free(d.curve);
}

/* ---- slices ---- */

static void add_slice(double *nu, size_t *count, double value)
{
    for (size_t k = 0; k < *count; k++)
        if (nu[k] == value) return;
    if (*count < most_slices && isfinite(value)) nu[(*count)++] = value;
}

/* Of three parameters: planes that contain something special; then planes on both sides of the file's value. */
void nh_classification_picture(const nh_classified *x, nh_pen *pen)
{
    double nu[most_slices] = {0}, own = 1;
    size_t count = x->parameters == 2;
    const nh_system *system = x->almost_all->question->system;
    if (!x->classification->rows) return;
    if (x->parameters == 3) {
        for (size_t i = 0; i < system->parameters; i++)
            if (!strcmp(system->parameter[i].name, x->over[2])) own = system->parameter[i].value;
        own = own == 0 ? 1 : round(own * 100) / 100;
        add_slice(nu, &count, own);
        for (size_t k = 0; k < x->places; k++)
            if (!x->place[k].dimension) add_slice(nu, &count, x->place[k].about[2]);
        for (size_t k = 0; k < x->classification->walls; k++) {
            int64_t top, bottom;
            const nh_special_factor *wall = &x->classification->wall[k].polynomial;
            if (nh_special_variable(wall, 0) == 2 && nh_special_rational(wall, &top, &bottom))
                add_slice(nu, &count, (double)top / (double)bottom);
        }
        add_slice(nu, &count, 2 * own);
        add_slice(nu, &count, -own);
    }
    for (size_t k = 0; k < count; k++) draw_plane(x, nu[k], pen);
}
