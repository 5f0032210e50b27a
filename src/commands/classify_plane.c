/* From a system file and the names of two parameters to special curves and points, with the currents that hold
   there. */
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "commands/classify_internal.h"
#include "graph/node.h"
#include "graph/num.h"

typedef nh_classified_plane plane;

/* ---- words ---- */

/* The coefficient of v^power as text, or, for v < 0, the whole polynomial; highest powers first. */
static void put_polynomial(const nh_classified *x, const nh_special_surface *s, int v, size_t power, bool negative,
                           nh_text *out)
{
    const char *const name[3] = {x->over, x->second, x->third};
    size_t width = s->degree[0] + 1, each = width * (s->degree[1] + 1), written = 0;
    for (size_t i = s->degree[0] + 1; i-- > 0;)
        for (size_t j = s->degree[1] + 1; j-- > 0;)
            for (size_t k = s->degree[2] + 1; k-- > 0;) {
                int64_t a = s->coefficient[k * each + j * width + i];
                size_t e[3] = {i, j, k}, left = 0;
                if (!a || (v >= 0 && e[v] != power)) continue;
                if (v >= 0) e[v] = 0;
                for (int w = 0; w < 3; w++) left += e[w] > 0;
                bool minus = (a < 0) != negative;
                uint64_t size = a < 0 ? 0 - (uint64_t)a : (uint64_t)a;
                nh_text_add(out, written++ == 0 ? (minus ? "-" : "") : minus ? " - " : " + ");
                if (size != 1 || !left) nh_text_addf(out, "%" PRIu64 "%s", size, left ? "*" : "");
                for (int w = 0; w < 3; w++) {
                    if (!e[w]) continue;
                    nh_text_add(out, name[w]);
                    if (e[w] > 1) nh_text_addf(out, "^%zu", e[w]);
                    if (--left) nh_text_add(out, "*");
                }
            }
    if (!written) nh_text_add(out, "0");
}

const char *nh_classified_surface_words(const nh_classified *x, const nh_special_surface *s)
{
    nh_text text;
    nh_text_init(&text);
    put_polynomial(x, s, -1, 0, false, &text);
    const char *out = nh_arena_printf(x->arena, "%s = 0", nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

const char *nh_classified_graph(const nh_classified *x, const nh_special_surface *s, int v)
{
    if (s->degree[v] != 1) return NULL;
    nh_text top, bottom;
    nh_text_init(&top);
    nh_text_init(&bottom);
    put_polynomial(x, s, v, 0, true, &top);
    put_polynomial(x, s, v, 1, false, &bottom);
    const char *out = !strcmp(nh_text_string(&bottom), "1")
                          ? nh_arena_strdup(x->arena, nh_text_string(&top))
                          : nh_arena_printf(x->arena, "(%s)/(%s)", nh_text_string(&top), nh_text_string(&bottom));
    nh_text_clear(&bottom);
    nh_text_clear(&top);
    return out;
}

/* ---- curves ---- */

/* The degree up to which the products of currents that are proved on the whole curve are as many as were counted. */
static size_t complete_along(const plane *x, const nh_plane_curve *c, const nh_classified *along)
{
    const nh_classification *of = along->classification;
    size_t d = 0;
    if (of->obstacle == nh_parametric_constant) {
        d = nh_classified_complete_everywhere(along);
        return c->first && d >= c->first ? d : 0;
    }
    while (d < of->rows && d < x->plane->rows && of->row[d].known == of->row[d].number.bound) d++;
    return c->first && !of->obstacle && d >= c->first ? d : 0;
}

static void classify_curve(plane *x, const nh_classify_request *q, const nh_plane_curve *c, nh_classified_curve *out)
{
    nh_error error;
    nh_error_clear(&error);
    if (c->degenerate) return;
    const char *formula = nh_classified_graph(x->family, &c->polynomial, 0);
    out->upright = !formula;
    if (!formula) formula = nh_classified_graph(x->family, &c->polynomial, 1);
    out->why = "currents are constructed on curves on which one parameter is a rational function of the other";
    if (!formula) return;
    const char *bound = x->over[out->upright], *free = x->over[!out->upright];
    size_t count = x->family->others;
    nh_setting *setting = nh_arena_alloc(x->family->arena, (count + 1) * sizeof *setting);
    /* some of these may depend on the curve's parameter */
    memcpy(setting + 1, x->family->other, count * sizeof *setting);
    setting[0] = (nh_setting){.name = bound, .formula = formula};
    nh_classify_request request = *q;
    request.over = free;
    request.second = NULL;
    request.settings = count + 1;
    request.setting = setting;
    request.options.degree = (double)x->plane->rows;
    out->graph = nh_arena_printf(x->family->arena, "%s = %s", bound, formula);
    out->along = nh_classify_system(&request, &error);
    out->why = out->along ? NULL : nh_arena_strdup(x->family->arena, error.what);
    if (out->along) out->complete = complete_along(x, c, out->along);
}

/* ---- points ---- */

static const char *ratio(nh_arena *arena, int64_t top, int64_t bottom)
{
    return nh_arena_printf(arena, bottom == 1 ? "%" PRId64 : "%" PRId64 "/%" PRId64, top, bottom);
}

static void add_point(plane *x, size_t *capacity, const nh_classified_point *p)
{
    nh_grow(&x->point, capacity, x->points + 1, sizeof *x->point);
    x->point[x->points++] = *p;
}

static void isolated_point(plane *x, const nh_classify_request *q, size_t index, nh_classified_value *out,
                           size_t *capacity)
{
    nh_error error;
    nh_error_clear(&error);
    const nh_plane_point *at = &x->plane->point[index];
    const nh_plane_line *line = &x->plane->line[at->line];
    nh_classify_value *v = &line->line->value[at->value];
    nh_arena *arena = x->family->arena;
    int64_t top[2], bottom[2];
    nh_classified_rational(&line->across, &top[1], &bottom[1]);
    nh_classified_point p = {.first = v->first, .number = v->number, .curve = SIZE_MAX, .at = out};
    p.root = &v->polynomial;
    p.rational = nh_classified_rational(&v->polynomial, &top[0], &bottom[0]);
    for (int k = 0; k < 2; k++) {
        bool known = k || p.rational;
        p.value[k] =
            known ? ratio(arena, top[k], bottom[k]) : nh_classified_values(x->family, x->over[0], &v->polynomial);
        p.about[k] = known ? (double)top[k] / (double)bottom[k] : NAN;
    }
    out->why = "currents are constructed at rational values only";
    if (p.rational) {
        nh_setting setting[2];
        for (int k = 0; k < 2; k++)
            setting[k] = (nh_setting){.name = x->over[k], .value = p.about[k], .top = top[k], .bottom = bottom[k]};
        out->result = nh_classified_analyse(x->family, q, 2, setting, &error);
        out->why = out->result ? NULL : nh_arena_strdup(arena, error.what);
        if (out->result) {
            out->complete = nh_classified_complete(x->family, out->result);
            out->exact = nh_classified_exact(x->family, out->result, x->plane->rows, v->number);
        }
    }
    add_point(x, capacity, &p);
}

static bool number_of(const nh_system *s, const char *name, nh_num *out)
{
    for (size_t i = 0; i < s->definitions; i++) {
        if (strcmp(s->definition[i].name, name) || nh_kind_of(s->dag, s->definition[i].value) != NH_NUMBER) continue;
        *out = nh_number_of(s->dag, s->definition[i].value);
        return true;
    }
    return false;
}

const char *nh_classified_value_of(nh_arena *arena, const nh_system *s, const char *name, double *about)
{
    nh_num n;
    if (!number_of(s, name, &n)) return NULL;
    *about = nh_num_value(n);
    return nh_num_short(n) ? ratio(arena, n.p, n.q) : NULL;
}

static bool have_point(const plane *x, const nh_classified_point *p)
{
    for (size_t k = 0; k < x->points; k++)
        if (!strcmp(x->point[k].value[0], p->value[0]) && !strcmp(x->point[k].value[1], p->value[1])) return true;
    return false;
}

/* Is there another curve through this rational point that is not examined, or almost all points of which have as
 * many? */
static bool belongs_to_another(const plane *x, size_t index, const nh_classified_point *p)
{
    nh_num value[2];
    for (int i = 0; i < 2; i++)
        if (!number_of(p->at->result->system, x->over[i], &value[i])) return false;
    int64_t coefficient[2] = {-value[0].p, value[0].q};
    nh_special_factor lambda = {.degree = 1, .coefficient = coefficient};
    for (size_t k = 0; k < x->plane->curves; k++) {
        const nh_plane_curve *c = &x->plane->curve[k];
        if (k == index || !nh_special_curve_contains(&c->polynomial, &lambda, value[1].p, value[1].q)) continue;
        bool more = false;
        for (size_t d = 1; d <= x->plane->rows; d++)
            more |= c->number[d].bounded && p->number[d].bounded && p->number[d].bound > c->number[d].bound;
        if (c->degenerate || !more) return true;
    }
    return false;
}

/* The special values of the classification along a curve. */
static void points_on_curve(plane *x, size_t index, size_t *capacity)
{
    const nh_classified_curve *c = &x->curve[index];
    const nh_classification *of = c->along->classification;
    for (size_t k = 0; k < of->values; k++) {
        const nh_classify_value *v = &of->value[k];
        if (!v->first || v->degenerate) continue;
        nh_classified_point p = {
            .first = v->first, .number = v->number, .curve = index, .at = &c->along->value[k], .about = {NAN, NAN}};
        for (int i = 0; i < 2 && p.at->result; i++)
            p.value[i] = nh_classified_value_of(x->family->arena, p.at->result->system, x->over[i], &p.about[i]);
        p.rational = p.value[0] && p.value[1];
        if (!p.rational) {
            p.value[c->upright] = c->graph;
            p.value[!c->upright] = nh_classified_words(c->along, &v->polynomial);
        }
        if (have_point(x, &p) || (p.rational && belongs_to_another(x, index, &p))) continue;
        add_point(x, capacity, &p);
    }
}

/* ---- the whole plane ---- */

nh_classified_plane *nh_classify_plane_system(const nh_classify_request *request, nh_error *error)
{
    nh_classify_request q = *request;
    q.over = request->second; /* lambda is the second name: curves are written as functions of the first */
    q.second = request->over;
    nh_classified *family = nh_classified_open(&q, error);
    if (!family) return NULL;
    plane *x = nh_arena_alloc(family->arena, sizeof *x);
    *x = (plane){.family = family, .over = {family->over, family->second}};
    nh_ex *phi = nh_classified_known(family);
    nh_classify_question question = nh_classified_question(family, &q, phi);
    question.two = nh_classified_parameter(family->almost_all->system, x->over[1], &question.second, error);
    x->plane = nh_plane_classify(family->almost_all->model, &question);
    nh_free(phi);
    x->curve = nh_arena_alloc(family->arena, (x->plane->curves + 1) * sizeof *x->curve);
    x->isolated = nh_arena_alloc(family->arena, (x->plane->points + 1) * sizeof *x->isolated);
    size_t capacity = 0;
    for (size_t k = 0; k < x->plane->points && !nh_interrupted(); k++)
        isolated_point(x, &q, k, &x->isolated[k], &capacity);
    for (size_t k = 0; k < x->plane->curves && !nh_interrupted(); k++)
        classify_curve(x, &q, &x->plane->curve[k], &x->curve[k]);
    for (size_t k = 0; k < x->plane->curves; k++)
        if (x->curve[k].along) points_on_curve(x, k, &capacity);
    x->partial = nh_interrupted();
    return x;
}

void nh_classified_plane_free(nh_classified_plane *x)
{
    for (size_t k = 0; x->curve && k < x->plane->curves; k++)
        if (x->curve[k].along) nh_classified_free(x->curve[k].along);
    for (size_t k = 0; x->isolated && k < x->plane->points; k++) nh_analysis_free(x->isolated[k].result);
    nh_free(x->point);
    nh_plane_free(x->plane);
    nh_classified_free(x->family);
}
