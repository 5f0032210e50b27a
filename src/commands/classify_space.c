/* Three parameters: special surfaces, and the curves and points on them, on walls and in planes, each of which is
 * classified as the plane of two of the parameters. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/progress.h"
#include "commands/classify_internal.h"

typedef nh_classified_space space;
typedef nh_classified_part part;

/* ---- parts ---- */

/* The degree up to which products of currents that are proved on the whole surface are as many as were counted. */
static size_t complete_on(const nh_plane_curve *s, const nh_classified_plane *within)
{
    size_t d = 0;
    if (within->plane->obstacle == nh_parametric_constant) {
        d = nh_classified_complete_everywhere(within->family);
        return s->first && d >= s->first ? d : 0;
    }
    while (d < within->plane->rows && within->plane->row[d].known == within->plane->row[d].number.bound) d++;
    return s->first && !within->plane->obstacle && d >= s->first ? d : 0;
}

static void classify_part(space *x, const nh_classify_request *q, part *p)
{
    nh_error error;
    nh_error_clear(&error);
    const nh_special_surface *s = p->polynomial;
    while (p->v < 3 && s->degree[p->v] != 1) p->v++;
    p->why = "currents are constructed on surfaces on which one parameter is a rational function of the others";
    if (p->v == 3) return;
    for (int w = 0, k = 0; w < 3; w++)
        if (w != p->v) p->other[k++] = w;
    const char *formula = nh_classified_graph(x->family, s, p->v);
    size_t count = x->family->others;
    nh_setting *setting = nh_arena_alloc(x->family->arena, (count + 1) * sizeof *setting);
    /* some of these may depend on the surface's parameter */
    memcpy(setting + 1, x->family->other, count * sizeof *setting);
    setting[0] = (nh_setting){.name = x->over[p->v], .formula = formula};
    if (s->degree[0] + s->degree[1] == 0) { /* a number */
        int64_t top = -s->coefficient[0], bottom = s->coefficient[1];
        setting[0] =
            (nh_setting){.name = x->over[p->v], .value = (double)top / (double)bottom, .top = top, .bottom = bottom};
        formula = nh_arena_printf(x->family->arena, bottom == 1 ? "%" PRId64 : "%" PRId64 "/%" PRId64, top, bottom);
    }
    nh_classify_request request = *q;
    request.over = x->over[p->other[1]]; /* lambda of that plane is its second name */
    request.second = x->over[p->other[0]];
    request.third = NULL;
    request.settings = count + 1;
    request.setting = setting;
    request.options.degree = (double)x->space->rows;
    p->graph = nh_arena_printf(x->family->arena, "%s = %s", x->over[p->v], formula);
    p->within = nh_classify_plane_system(&request, &error);
    p->why = p->within ? NULL : nh_arena_strdup(x->family->arena, error.what);
    if (p->within && p->surface != SIZE_MAX) p->complete = complete_on(&x->space->surface[p->surface], p->within);
}

static void classify_parts(space *x, const nh_classify_request *q)
{
    const nh_space *o = x->space;
    x->part = nh_arena_alloc(x->family->arena, (o->surfaces + o->walls + o->planes + 1) * sizeof *x->part);
    for (size_t k = 0; k < o->surfaces; k++)
        if (!o->surface[k].degenerate)
            x->part[x->parts++] = (part){.polynomial = &o->surface[k].polynomial, .surface = k};
    for (size_t k = 0; k < o->walls; k++) x->part[x->parts++] = (part){.polynomial = &o->wall[k], .surface = SIZE_MAX};
    for (size_t k = 0; k < o->planes; k++)
        x->part[x->parts++] = (part){.polynomial = &o->plane[k], .surface = SIZE_MAX};
    for (size_t k = 0; k < x->parts && o->rows; k++) {
        x->part[k].why = "the run was ended";
        if (!nh_interrupted()) classify_part(x, q, &x->part[k]);
    }
}

/* ---- which special curves and points are new ---- */

/* Is there a degree with more integrals here than there? */
static bool more(const space *x, const nh_classify_number *here, const nh_classify_number *there)
{
    bool any = false;
    for (size_t d = 1; d <= x->space->rows; d++)
        any |= here[d].settled && there[d].bounded && here[d].bound > there[d].bound;
    return any;
}

/* Does the curve of this part, or the points of it, lie on the surface? */
static bool lies_on(const nh_special_surface *s, const part *p, const nh_special_curve *curve,
                    const nh_classified_point *point)
{
    nh_special_curve section;
    bool inside = false;
    if (nh_special_surface_section(s, p->polynomial, p->v, &section)) {
        if (curve) inside = nh_special_curve_covers(&section, curve);
        int64_t number[2][2] = {{0, 1}, {0, 1}}, coefficient[2];
        nh_special_factor root = {.degree = 1, .coefficient = coefficient};
        for (int k = 0; point && k < 2; k++)
            if (isfinite(point->about[k]))
                sscanf(point->value[k], "%" SCNd64 "/%" SCNd64, &number[k][0], &number[k][1]);
        coefficient[0] = -number[0][0];
        coefficient[1] = number[0][1];
        if (point && isfinite(point->about[1]))
            inside = nh_special_curve_contains(&section, point->root ? point->root : &root, number[1][0], number[1][1]);
    }
    nh_free(section.coefficient);
    return inside;
}

/* The cylinder over the curve along the parameter for which the part was solved; in the arena. */
static nh_special_surface cylinder(const space *x, const part *p, const nh_special_curve *c)
{
    nh_special_surface out = {.degree = {0}};
    for (int k = 0; k < 2; k++) out.degree[p->other[k]] = c->degree[k];
    size_t count = (c->degree[0] + 1) * (c->degree[1] + 1);
    out.coefficient = nh_arena_alloc(x->family->arena, count * sizeof *out.coefficient);
    memcpy(out.coefficient, c->coefficient, count * sizeof *out.coefficient);
    return out;
}

static bool is_new(const space *x, const part *p, const nh_special_curve *curve, const nh_classified_point *point,
                   const nh_classify_number *number)
{
    bool fresh = true;
    for (size_t k = 0; k < x->space->surfaces && fresh; k++) {
        const nh_plane_curve *s = &x->space->surface[k];
        if ((s->first || s->degenerate) && lies_on(&s->polynomial, p, curve, point))
            fresh = !s->degenerate && more(x, number, s->number);
    }
    for (size_t k = 0; k < x->curves && fresh; k++) {
        const part *other = &x->part[x->curve[k].part];
        const nh_plane_curve *c = &other->within->plane->curve[x->curve[k].index];
        nh_special_surface over = cylinder(x, other, &c->polynomial);
        if (lies_on(other->polynomial, p, curve, point) && lies_on(&over, p, curve, point))
            fresh = more(x, number, c->number);
    }
    return fresh;
}

static void collect_curves(space *x, size_t index)
{
    const part *p = &x->part[index];
    const nh_plane *o = p->within->plane;
    for (size_t k = 0; k < o->curves; k++) {
        const nh_plane_curve *c = &o->curve[k];
        if (!c->first || c->degenerate || !is_new(x, p, &c->polynomial, NULL, c->number)) continue;
        const char *words = nh_classified_surface_words(p->within->family, &c->polynomial);
        x->curve[x->curves++] = (nh_classified_space_curve){
            .part = index, .index = k, .where = nh_arena_printf(x->family->arena, "%s, %s", p->graph, words)};
    }
}

/* ---- points ---- */

static nh_classified_space_point point_of(const space *x, size_t index, const nh_classified_point *at)
{
    const part *p = &x->part[index];
    nh_classified_space_point out = {.part = index, .at = at};
    for (int k = 0; k < 2; k++) {
        out.value[p->other[k]] = at->value[k];
        out.about[p->other[k]] = at->about[k];
    }
    out.value[p->v] = p->graph;
    out.about[p->v] = NAN;
    if (p->polynomial->degree[0] + p->polynomial->degree[1] == 0) {
        int64_t top = -p->polynomial->coefficient[0], bottom = p->polynomial->coefficient[1];
        out.value[p->v] = strstr(p->graph, "= ") + 2;
        out.about[p->v] = (double)top / (double)bottom;
    } else if (at->at->result) {
        const char *value =
            nh_classified_value_of(x->family->arena, at->at->result->system, x->over[p->v], &out.about[p->v]);
        if (value) out.value[p->v] = value;
    }
    return out;
}

static void collect_points(space *x, size_t index)
{
    const part *p = &x->part[index];
    for (size_t k = 0; k < p->within->points; k++) {
        const nh_classified_point *at = &p->within->point[k];
        nh_classified_space_point found = point_of(x, index, at);
        bool same = false;
        for (size_t j = 0; j < x->points && !same; j++) {
            same = true;
            for (int v = 0; v < 3; v++) same &= !strcmp(x->point[j].value[v], found.value[v]);
        }
        if (!same && is_new(x, p, NULL, at, at->number)) x->point[x->points++] = found;
    }
}

static void collect(space *x)
{
    size_t curves = 0, points = 0;
    for (size_t k = 0; k < x->parts; k++) {
        const nh_classified_plane *within = x->part[k].within;
        curves += within ? within->plane->curves : 0;
        points += within ? within->points : 0;
        x->partial |= within && within->partial;
    }
    x->curve = nh_arena_alloc(x->family->arena, (curves + 1) * sizeof *x->curve);
    x->point = nh_arena_alloc(x->family->arena, (points + 1) * sizeof *x->point);
    for (size_t k = 0; k < x->parts; k++)
        if (x->part[k].within) collect_curves(x, k);
    for (size_t k = 0; k < x->parts; k++)
        if (x->part[k].within) collect_points(x, k);
}

/* ---- the whole space ---- */

nh_classified_space *nh_classify_space_system(const nh_classify_request *request, nh_error *error)
{
    nh_classify_request q = *request;
    q.over = request->third; /* as with two parameters: lambda is the last name */
    q.third = request->over;
    nh_classified *family = nh_classified_open(&q, error);
    if (!family) return NULL;
    space *x = nh_arena_alloc(family->arena, sizeof *x);
    *x = (space){.family = family, .over = {family->over, family->second, family->third}};
    nh_ex *phi = nh_classified_known(family);
    nh_classify_question question = nh_classified_question(family, &q, phi);
    question.two = nh_classified_parameter(family->almost_all->system, x->over[1], &question.second, error);
    question.three = nh_classified_parameter(family->almost_all->system, x->over[2], &question.third, error);
    x->space = nh_space_classify(family->almost_all->model, &question);
    nh_free(phi);
    classify_parts(x, &q);
    collect(x);
    x->partial |= nh_interrupted();
    return x;
}

void nh_classified_space_free(nh_classified_space *x)
{
    for (size_t k = 0; k < x->parts; k++)
        if (x->part[k].within) nh_classified_plane_free(x->part[k].within);
    nh_space_free(x->space);
    nh_classified_free(x->family);
}
