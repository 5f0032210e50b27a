/* The plane of two parameters as a plot: special curves, and points with more integrals than the curves. */
#include <math.h>
#include <string.h>

#include "document/classification_internal.h"

enum { steps = 401 };

typedef nh_classified_plane plane;

typedef struct {
    nh_arena *arena;
    size_t count, capacity;
    nh_curve *curve;
    double low[2], high[2]; /* ranges of lambda and mu */
} drawing;

/* ---- the window ---- */

static void see(drawing *d, int v, double value)
{
    if (!isfinite(value)) return;
    if (value < d->low[v]) d->low[v] = value;
    if (value > d->high[v]) d->high[v] = value;
}

/* Contains all points, the value at which the family was analysed, and zero; and the points of curves over the middle
 * of that. */
static void window(drawing *d, const plane *x)
{
    for (int v = 0; v < 2; v++) d->low[v] = 0, d->high[v] = 0;
    const nh_analysis *r = x->family->almost_all;
    for (size_t i = 0; i < r->system->parameters; i++)
        for (int v = 0; v < 2; v++)
            if (r->system->parameter[i].name && !strcmp(r->system->parameter[i].name, x->over[v]))
                see(d, v, r->system->parameter[i].value);
    for (size_t k = 0; k < x->points; k++)
        for (int v = 0; v < 2; v++) see(d, v, x->point[k].about[v]);
    for (size_t k = 0; k < x->plane->curves; k++) {
        const nh_special_curve *c = &x->plane->curve[k].polynomial;
        double *root = nh_alloc_array(c->degree[0] + c->degree[1] + 1, sizeof *root), middle[2];
        for (int v = 0; v < 2; v++) middle[v] = (d->low[v] + d->high[v]) / 2;
        for (int fixed = 0; fixed < 2 && x->plane->curve[k].first; fixed++) {
            size_t roots = nh_special_curve_reals(c, fixed, middle[fixed], root);
            for (size_t i = 0; i < roots; i++) see(d, 1 - fixed, root[i]);
        }
        nh_free(root);
    }
    for (int v = 0; v < 2; v++) {
        double span = d->high[v] > d->low[v] ? d->high[v] - d->low[v] : 1;
        d->low[v] -= 0.1 * span;
        d->high[v] += 0.1 * span;
    }
}

/* ---- curves and points ---- */

static nh_curve *new_curve(drawing *d, const char *name, size_t count, double **x, double **y)
{
    nh_grow(&d->curve, &d->capacity, d->count + 1, sizeof *d->curve);
    *x = nh_arena_alloc(d->arena, (count + 1) * sizeof **x);
    *y = nh_arena_alloc(d->arena, (count + 1) * sizeof **y);
    d->curve[d->count] = (nh_curve){.name = name, .count = count, .x = *x, .y = *y, .x_stride = 1, .y_stride = 1};
    return &d->curve[d->count++];
}

/* Branch after branch with gaps between them; lambda over mu, or mu over lambda for a vertical line. */
static void draw_curve(drawing *d, const plane *x, size_t index, const char *name)
{
    const nh_special_curve *c = &x->plane->curve[index].polynomial;
    int fixed = c->degree[0] > 0; /* mu is the variable */
    size_t branches = c->degree[1 - fixed];
    double *to[2], *root = nh_alloc_array(branches + 1, sizeof *root);
    new_curve(d, name, branches * (steps + 1), &to[1], &to[0]);
    for (size_t b = 0; b < branches; b++)
        for (size_t k = 0; k <= steps; k++) {
            double value = d->low[fixed] + (d->high[fixed] - d->low[fixed]) * (double)k / (steps - 1);
            size_t roots = k < steps ? nh_special_curve_reals(c, fixed, value, root) : 0, at = b * (steps + 1) + k;
            bool inside = b < roots && root[b] >= d->low[1 - fixed] && root[b] <= d->high[1 - fixed];
            to[fixed][at] = inside ? value : NAN;
            to[1 - fixed][at] = inside ? root[b] : NAN;
        }
    nh_free(root);
}

/* The points with so many integrals. */
static void draw_points(drawing *d, const plane *x, size_t number, const char *name)
{
    double *mu, *lambda;
    size_t rows = x->plane->rows, count = 0;
    nh_curve *c = new_curve(d, name, x->points, &mu, &lambda);
    for (size_t k = 0; k < x->points; k++) {
        const nh_classified_point *p = &x->point[k];
        if (!p->rational || p->number[rows].bound != number) continue;
        mu[count] = p->about[1];
        lambda[count++] = p->about[0];
    }
    c->count = count;
    c->dots = true;
}

static void all_points(drawing *d, const plane *x)
{
    size_t rows = x->plane->rows, last = 0;
    for (size_t next = 0; next != SIZE_MAX; last = next) { /* in ascending order */
        next = SIZE_MAX;
        for (size_t k = 0; k < x->points; k++) {
            size_t n = x->point[k].number[rows].bound;
            if (x->point[k].rational && n > last && n < next) next = n;
        }
        if (next != SIZE_MAX) draw_points(d, x, next, nh_arena_printf(d->arena, "points with %zu", next));
    }
}

void nh_classification_picture(const plane *x, nh_pen *pen)
{
    drawing d = {.arena = x->family->arena};
    size_t rows = x->plane->rows;
    if (!rows) return;
    window(&d, x);
    for (size_t k = 0; k < x->plane->curves; k++) {
        const nh_plane_curve *c = &x->plane->curve[k];
        if (!c->first && !c->degenerate) continue;
        const char *words = nh_classified_surface_words(x->family, &c->polynomial);
        draw_curve(&d, x, k,
                   c->degenerate ? nh_arena_printf(d.arena, "%s: degenerate", words)
                                 : nh_arena_printf(d.arena, "%s: %zu", words, c->number[rows].bound));
    }
    all_points(&d, x);
    const char *only = d.count == 1 ? d.curve[0].name : NULL; /* the plot has no legend */
    const char *caption =
        nh_arena_printf(d.arena, "Numbers of integrals of degree %zu, with the constant 1%s%s; elsewhere %zu.", rows,
                        only ? ": " : "", only ? only : "", x->plane->row[rows - 1].number.bound);
    nh_plot plot = {.title = "Where there are more conservation laws",
                    .description = caption,
                    .x_label = x->over[1],
                    .y_label = x->over[0],
                    .curves = d.count,
                    .curve = d.curve};
    if (d.count) pen->ink->plot(pen->to, &plot, caption);
    nh_free(d.curve);
}
