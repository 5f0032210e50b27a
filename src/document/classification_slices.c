/* Slices of the space of three parameters: planes of the last two at values of the first one. */
#include <math.h>
#include <string.h>

#include "document/classification_internal.h"

enum { steps = 401, most_slices = 3 };

typedef nh_classified_space space;

typedef struct {
    nh_arena *arena;
    double nu, low[2], high[2]; /* ranges of lambda and mu */
    size_t count, capacity;
    nh_curve *curve;
} drawing;

/* ---- values ---- */

/* The real roots of the polynomial in v where the other parameters have these values; returns their number. */
static size_t roots_of(const nh_special_surface *s, int v, const double at[3], double *root)
{
    size_t width = s->degree[0] + 1, each = width * (s->degree[1] + 1), total = each * (s->degree[2] + 1);
    double *c = nh_alloc_array(s->degree[v] + 1, sizeof *c);
    for (size_t z = 0; z < total; z++) {
        size_t e[3] = {z % width, z % each / width, z / each};
        double term = (double)s->coefficient[z];
        for (int w = 0; w < 3; w++)
            if (w != v) term *= pow(at[w], (double)e[w]);
        c[e[v]] += term;
    }
    size_t count = nh_special_roots_of(s->degree[v], c, root);
    nh_free(c);
    return count;
}

static void see(drawing *d, int v, double value)
{
    if (!isfinite(value)) return;
    d->low[v] = fmin(d->low[v], value);
    d->high[v] = fmax(d->high[v], value);
}

/* Where a curve of the space meets the slice; returns the number of points. */
static size_t crossings(const space *x, size_t index, double nu, size_t most, double (*out)[2])
{
    const nh_classified_part *p = &x->part[x->curve[index].part];
    const nh_special_curve *c = &p->within->plane->curve[x->curve[index].index].polynomial;
    if (p->v == 2 || c->degree[0] == 0) return 0;
    double *root = nh_alloc_array(c->degree[0] + 1, sizeof *root), at[3] = {0, 0, nu}, last[2];
    size_t count = 0, roots = nh_special_curve_reals(c, 1, nu, root);
    for (size_t i = 0; i < roots && count < most; i++) {
        at[p->other[0]] = root[i];
        if (roots_of(p->polynomial, p->v, at, last) != 1) continue;
        at[p->v] = last[0];
        memcpy(out[count++], at, sizeof *out);
    }
    nh_free(root);
    return count;
}

/* ---- one slice ---- */

static nh_curve *new_curve(drawing *d, const char *name, size_t count, double **x, double **y)
{
    nh_grow(&d->curve, &d->capacity, d->count + 1, sizeof *d->curve);
    *x = nh_arena_alloc(d->arena, (count + 1) * sizeof **x);
    *y = nh_arena_alloc(d->arena, (count + 1) * sizeof **y);
    d->curve[d->count] = (nh_curve){.name = name, .count = count, .x = *x, .y = *y, .x_stride = 1, .y_stride = 1};
    return &d->curve[d->count++];
}

/* Branch after branch with gaps between them; lambda over mu, or mu over lambda where lambda does not occur. */
static void draw_surface(drawing *d, const nh_special_surface *s, const char *name)
{
    int v = s->degree[0] ? 0 : 1;
    size_t branches = s->degree[v];
    double *to[2], *root = nh_alloc_array(branches + 1, sizeof *root), at[3] = {0, 0, d->nu};
    if (branches) new_curve(d, name, branches * (steps + 1), &to[1], &to[0]);
    for (size_t b = 0; b < branches; b++)
        for (size_t k = 0; k <= steps; k++) {
            at[1 - v] = d->low[1 - v] + (d->high[1 - v] - d->low[1 - v]) * (double)k / (steps - 1);
            size_t roots = k < steps ? roots_of(s, v, at, root) : 0, i = b * (steps + 1) + k;
            bool inside = b < roots && root[b] >= d->low[v] && root[b] <= d->high[v];
            to[1 - v][i] = inside ? at[1 - v] : NAN;
            to[v][i] = inside ? root[b] : NAN;
        }
    nh_free(root);
}

static void draw_dots(drawing *d, size_t count, double (*at)[2], const char *name)
{
    double *mu, *lambda;
    if (!count) return;
    new_curve(d, name, count, &mu, &lambda)->dots = true;
    for (size_t k = 0; k < count; k++) {
        lambda[k] = at[k][0];
        mu[k] = at[k][1];
    }
}

/* A curve that lies in the slice. */
static void draw_inside(drawing *d, const space *x, size_t index, const char *name)
{
    const nh_classified_part *p = &x->part[x->curve[index].part];
    const nh_special_curve *c = &p->within->plane->curve[x->curve[index].index].polynomial;
    const nh_special_surface *s = p->polynomial;
    if (p->v != 2 || s->degree[0] + s->degree[1]) return;
    if (-(double)s->coefficient[0] / (double)s->coefficient[1] != d->nu) return;
    draw_surface(d, c, name);
}

static bool is_at(const nh_classified_space_point *q, double nu) { return q->about[2] == nu; }

static void window(drawing *d, const space *x)
{
    enum { most = 16 };
    double at[most][2];
    const nh_system *s = x->family->almost_all->system;
    for (int v = 0; v < 2; v++) d->low[v] = d->high[v] = 0;
    for (size_t i = 0; i < s->parameters; i++)
        for (int v = 0; v < 2; v++)
            if (!strcmp(s->parameter[i].name, x->over[v])) see(d, v, s->parameter[i].value);
    for (size_t k = 0; k < x->curves; k++) {
        size_t count = crossings(x, k, d->nu, most, at);
        for (size_t i = 0; i < 2 * count; i++) see(d, (int)(i % 2), at[i / 2][i % 2]);
    }
    for (size_t k = 0; k < x->points; k++)
        for (int v = 0; v < 2 && is_at(&x->point[k], d->nu); v++) see(d, v, x->point[k].about[v]);
    for (size_t k = 0; k < x->space->surfaces; k++) {
        const nh_special_surface *surface = &x->space->surface[k].polynomial;
        int v = surface->degree[0] ? 0 : 1;
        double middle[3] = {(d->low[0] + d->high[0]) / 2, (d->low[1] + d->high[1]) / 2, d->nu};
        double *root = nh_alloc_array(surface->degree[v] + 1, sizeof *root);
        size_t roots = x->space->surface[k].first ? roots_of(surface, v, middle, root) : 0;
        for (size_t i = 0; i < roots; i++) see(d, v, root[i]);
        nh_free(root);
    }
    for (int v = 0; v < 2; v++) {
        double span = d->high[v] > d->low[v] ? d->high[v] - d->low[v] : 1;
        d->low[v] -= 0.1 * span;
        d->high[v] += 0.1 * span;
    }
}

static void draw_slice(const space *x, double nu, nh_pen *pen)
{
    enum { most = 16 };
    drawing d = {.arena = x->family->arena, .nu = nu};
    double(*at)[2] = nh_alloc_array(x->points + most, sizeof *at);
    size_t rows = x->space->rows, points = 0;
    char digits[32];
    window(&d, x);
    for (size_t k = 0; k < x->space->surfaces; k++) {
        const nh_plane_curve *s = &x->space->surface[k];
        if (!s->first && !s->degenerate) continue;
        const char *words = nh_classified_surface_words(x->family, &s->polynomial);
        draw_surface(&d, &s->polynomial,
                     s->degenerate ? nh_arena_printf(d.arena, "%s: degenerate", words)
                                   : nh_arena_printf(d.arena, "%s: %zu", words, s->number[rows].bound));
    }
    for (size_t k = 0; k < x->curves; k++) {
        const nh_plane_curve *c = &x->part[x->curve[k].part].within->plane->curve[x->curve[k].index];
        const char *name = nh_arena_printf(d.arena, "%s: %zu", x->curve[k].where, c->number[rows].bound);
        draw_dots(&d, crossings(x, k, nu, most, at), at, name);
        draw_inside(&d, x, k, name);
    }
    for (size_t k = 0; k < x->points; k++)
        if (is_at(&x->point[k], nu) && isfinite(x->point[k].about[0]) && isfinite(x->point[k].about[1]))
            memcpy(at[points++], x->point[k].about, sizeof *at);
    draw_dots(&d, points, at, "points");
    nh_text_number(nu, digits, sizeof digits);
    const char *only = d.count == 1 ? d.curve[0].name : NULL; /* the plot has no legend */
    const char *caption = nh_arena_printf(d.arena,
                                          "%s = %s. Numbers of integrals of degree %zu, with the constant "
                                          "1%s%s; elsewhere %zu.",
                                          x->over[2], digits, rows, only ? ": " : "", only ? only : "",
                                          x->space->row[rows - 1].number.bound);
    nh_plot plot = {.title = nh_arena_printf(d.arena, "Where there are more, %s = %s", x->over[2], digits),
                    .description = caption,
                    .x_label = x->over[1],
                    .y_label = x->over[0],
                    .curves = d.count,
                    .curve = d.curve};
    if (d.count) pen->ink->plot(pen->to, &plot, caption);
    nh_free(at);
    nh_free(d.curve);
}

/* ---- all slices ---- */

static void add_slice(double *nu, size_t *count, double value)
{
    for (size_t k = 0; k < *count; k++)
        if (nu[k] == value) return;
    if (*count < most_slices && isfinite(value)) nu[(*count)++] = value;
}

/* Planes that contain something special; then planes on both sides of the file's value. */
void nh_classification_slices(const space *x, nh_pen *pen)
{
    double nu[most_slices], own = 1;
    size_t count = 0;
    const nh_system *s = x->family->almost_all->system;
    if (!x->space->rows) return;
    for (size_t i = 0; i < s->parameters; i++)
        if (!strcmp(s->parameter[i].name, x->over[2])) own = s->parameter[i].value;
    own = own == 0 ? 1 : round(own * 100) / 100;
    add_slice(nu, &count, own);
    for (size_t k = 0; k < x->points; k++) add_slice(nu, &count, x->point[k].about[2]);
    for (size_t k = 0; k < x->space->planes; k++)
        add_slice(nu, &count, -(double)x->space->plane[k].coefficient[0] / (double)x->space->plane[k].coefficient[1]);
    add_slice(nu, &count, 2 * own);
    add_slice(nu, &count, -own);
    for (size_t k = 0; k < count; k++) draw_slice(x, nu[k], pen);
}
