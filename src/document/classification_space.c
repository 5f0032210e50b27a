/* A classification over three parameters as a document, and as JSON. */
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "document/classification_internal.h"

typedef nh_classified_space space;
typedef nh_pen pen;

static bool special(const nh_plane_curve *s) { return s->first > 0 && !s->degenerate; }

/* ---- what is special ---- */

void nh_classification_space_answer(const space *x, pen *p)
{
    size_t surfaces = 0;
    for (size_t k = 0; k < x->space->surfaces; k++) surfaces += special(&x->space->surface[k]);
    nh_pen_say(p, "%zu surface%s, %zu curve%s and %zu point%s with %s", surfaces, surfaces == 1 ? "" : "s", x->curves,
               x->curves == 1 ? "" : "s", x->points, x->points == 1 ? "" : "s", nh_classification_more(x->family));
}

static void put_along(pen *p, const nh_classified *along, size_t complete)
{
    nh_classification_write_currents(p, along->almost_all, along->known, along->currents);
    if (!complete) nh_pen_words(p, "%s", nh_classification_fewer);
    else if (along->second)
        nh_pen_words(p, "All proved for every %s and %s; for almost all the list is complete up to degree %zu.",
                     along->second, along->over, complete);
    else
        nh_pen_words(p, "All proved for every %s; for almost all the list is complete up to degree %zu.", along->over,
                     complete);
}

static void put_surfaces(const space *x, pen *p, const size_t *almost_all)
{
    size_t written = 0;
    for (size_t k = 0; k < x->parts; k++) {
        const nh_classified_part *part = &x->part[k];
        if (part->surface == SIZE_MAX || !special(&x->space->surface[part->surface])) continue;
        const nh_plane_curve *s = &x->space->surface[part->surface];
        if (!written++) nh_pen_section(p, "surfaces", "More on the surfaces");
        nh_pen_place_card(p, nh_classified_surface_words(x->family, &s->polynomial));
        nh_classification_write_numbers(x->family, p, x->space->rows, s->number, s->first, part->complete, almost_all);
        if (part->within) put_along(p, part->within->family, part->complete);
        else nh_classification_write_no_currents(x->family, p, part->why);
    }
}

static const nh_plane_curve *curve_of(const space *x, size_t k, const nh_classified_curve **at)
{
    const nh_classified_plane *within = x->part[x->curve[k].part].within;
    *at = &within->curve[x->curve[k].index];
    return &within->plane->curve[x->curve[k].index];
}

static void put_curves(const space *x, pen *p, const size_t *almost_all)
{
    for (size_t k = 0; k < x->curves; k++) {
        const nh_classified_curve *at;
        const nh_plane_curve *c = curve_of(x, k, &at);
        if (!k) nh_pen_section(p, "curves", "More on the curves");
        nh_pen_place_card(p, x->curve[k].where);
        nh_classification_write_numbers(x->family, p, x->space->rows, c->number, c->first, at->complete, almost_all);
        if (at->along) put_along(p, at->along, at->complete);
        else nh_classification_write_no_currents(x->family, p, at->why);
    }
}

const char *nh_classification_space_place(const space *x, const nh_classified_space_point *q)
{
    nh_text text;
    nh_text_init(&text);
    for (int v = 2; v >= 0; v--)
        nh_text_addf(&text, isfinite(q->about[v]) ? "%s%s = %s" : "%s%.0s%s", v == 2 ? "" : ", ", x->over[v],
                     q->value[v]);
    const char *out = nh_arena_strdup(x->family->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

static void put_points(const space *x, pen *p, const size_t *almost_all)
{
    for (size_t k = 0; k < x->points; k++) {
        const nh_classified_point *at = x->point[k].at;
        if (!k) nh_pen_section(p, "points", "More at the points");
        nh_pen_place_card(p, nh_classification_space_place(x, &x->point[k]));
        nh_classification_write_numbers(x->family, p, x->space->rows, at->number, at->first, at->at->exact, almost_all);
        nh_classification_write_value(x->family, p, at->at, at->first);
    }
}

/* ---- what is excluded ---- */

/* Writes every line about what is open in this part, with the part's name. */
static void put_left_within(const nh_classified_plane *within, const char *words, nh_text *out)
{
    nh_text lines;
    nh_text_init(&lines);
    if (within) nh_classification_plane_left(within, &lines);
    const char *end;
    for (const char *at = nh_text_string(&lines); *at; at = end) {
        end = at + strcspn(at, "\n");
        if (*end) end++;
        nh_text_addf(out, "On %s: %c%.*s", words, *at == 'D' ? 'd' : 'n', (int)(end - at - 1), at + 1);
    }
    nh_text_clear(&lines);
}

static void put_left(const space *x, nh_text *out)
{
    const nh_space *o = x->space;
    nh_classification_open_words(x->family, o->surfaces, o->surface, out);
    for (size_t k = 0; k < x->parts; k++) {
        const nh_classified_part *part = &x->part[k];
        const char *words = nh_classified_surface_words(x->family, part->polynomial);
        const nh_plane *in = part->within ? part->within->plane : NULL;
        if (!in) nh_text_addf(out, "Curves and points on %s were not searched for: %s.\n", words, part->why);
        else if (in->obstacle != nh_parametric_constant && in->rows < o->rows)
            nh_text_addf(out, "Curves and points on %s were searched for up to degree %zu only.\n", words, in->rows);
        put_left_within(part->within, words, out);
    }
}

static void put_excluded(const space *x, size_t degree, nh_text *out)
{
    const nh_plane_row *row = &x->space->row[degree - 1];
    nh_text_addf(out, "  degree %zu: ", degree);
    if (!row->planes || row->height < 1) nh_text_add(out, "no values are excluded by a proof\n");
    else
        nh_text_addf(out,
                     "in %zu planes of constant %s, no other pair of rational numbers %s, %s with numerators "
                     "and denominators up to %.1e has more than %zu\n",
                     row->planes, x->over[2], x->over[1], x->over[0], row->height, row->number.bound);
    nh_text_addf(out,
                 "    (%zu unknowns, order %zu, determinants of size %zu, surfaces from %zu values of %s, "
                 "modulo",
                 row->unknowns, row->number.order, row->size, row->sections, x->over[2]);
    for (size_t i = 0; i < row->primes; i++) nh_text_addf(out, "%s %" PRIu64, i ? "," : "", row->prime[i]);
    nh_text_add(out, ")\n");
}

static void put_all_excluded(const space *x, nh_text *out)
{
    const nh_space *o = x->space;
    size_t looked = 0;
    if (o->rows) nh_text_add(out, "Elsewhere:\n");
    for (size_t d = 1; d <= o->rows; d++) put_excluded(x, d, out);
    if (!o->rows) return;
    nh_text_addf(out,
                 "  These planes are all with numerator and denominator of %s up to %.0f that were not "
                 "classified as a whole (option `planes`).\n",
                 x->over[2], x->family->almost_all->options.planes);
    for (size_t k = 0; k < x->parts; k++) {
        const nh_plane *in = x->part[k].within ? x->part[k].within->plane : NULL;
        if (!in || in->rows < o->rows || in->row[o->rows - 1].height < 1) continue;
        nh_text_addf(out,
                     looked++ ? "; on %s: %.1e"
                              : "  Where one parameter follows from the others the same "
                                "holds for pairs of these. On %s: %.1e",
                     nh_classified_surface_words(x->family, x->part[k].polynomial), in->row[o->rows - 1].height);
    }
    if (looked) nh_text_add(out, ".\n");
    nh_text_addf(out,
                 "  Not excluded: single points and curves in planes %s = constant, for other values of %s. "
                 "The sections show, modulo the primes, no other surface and no other curve in another direction; "
                 "this is not proved.\n",
                 x->over[2], x->over[2]);
}

void nh_classification_outline_space(const space *x, pen *p)
{
    const nh_space *o = x->space;
    size_t almost_all[NH_COUNT_HIGHEST_DEGREE + 1] = {0};
    char words[200];
    nh_text text;
    nh_text_init(&text);
    if (!p->ink->brief) {
        nh_pen_section(p, "picture", "Slices");
        nh_classification_slices(x, p);
    }
    for (size_t d = 1; d <= o->rows; d++) {
        almost_all[d] = o->row[d - 1].number.bound;
        nh_classification_almost_all(x->family, d, &o->row[d - 1].number, o->row[d - 1].known, &text);
    }
    nh_classification_write_almost_all(x->family, p, &text);
    put_surfaces(x, p, almost_all);
    put_curves(x, p, almost_all);
    put_points(x, p, almost_all);
    nh_pen_section(p, "excluded", "What is excluded");
    put_left(x, &text);
    put_all_excluded(x, &text);
    nh_classification_write_lines(p, &text);
    if (o->end)
        nh_pen_words(p, "Degree %zu was not reached: %s.", o->rows + 1,
                     nh_classification_end(o->end, words, sizeof words));
}

/* ---- JSON ---- */

static void put_special(const space *x, nh_json *list)
{
    for (size_t k = 0; k < x->parts; k++) {
        const nh_classified_part *part = &x->part[k];
        if (part->surface == SIZE_MAX || !special(&x->space->surface[part->surface])) continue;
        const nh_plane_curve *s = &x->space->surface[part->surface];
        nh_json *item = nh_json_add_object(list);
        nh_json_put_text(item, "where", nh_classified_surface_words(x->family, &s->polynomial));
        nh_json_put_text(item, "on", NULL);
        nh_classification_put_found(item, x->space->rows, s->first, s->number, part->complete > 0, part->why);
        nh_classification_put_along(part->within ? part->within->family : NULL, item);
    }
    for (size_t k = 0; k < x->curves; k++) {
        const nh_classified_curve *at;
        const nh_plane_curve *c = curve_of(x, k, &at);
        nh_json *item = nh_json_add_object(list);
        nh_json_put_text(item, "where", x->curve[k].where);
        nh_json_put_text(item, "on", nh_classified_surface_words(x->family, x->part[x->curve[k].part].polynomial));
        nh_classification_put_found(item, x->space->rows, c->first, c->number, at->complete > 0, at->why);
        nh_classification_put_along(at->along, item);
    }
    for (size_t k = 0; k < x->points; k++) {
        const nh_classified_space_point *q = &x->point[k];
        const nh_analysis *r = q->at->at->result;
        nh_json *item = nh_json_add_object(list), *where = nh_json_put_object(item, "where");
        for (int v = 2; v >= 0; v--) nh_json_put_text(where, x->over[v], q->value[v]);
        nh_json_put_text(item, "on", nh_classified_surface_words(x->family, x->part[q->part].polynomial));
        nh_classification_put_found(item, x->space->rows, q->at->first, q->at->number,
                                    r && q->at->at->complete >= q->at->first, q->at->at->why);
        nh_classification_put_currents(r, 0, NULL, item);
    }
}

char *nh_classification_space_json(const space *x, const nh_run *run)
{
    const nh_space *o = x->space;
    nh_json *root = nh_classification_begin(x->family, o->obstacle, o->end, o->rows, o->row);
    nh_json *list = nh_json_put_array(root, "degrees");
    for (size_t d = 1; d <= o->rows; d++) {
        const nh_plane_row *row = &o->row[d - 1];
        nh_json *item = nh_classification_add_degree(list, d, row, row->planes ? row->height : NAN);
        nh_json_put_number(item, "sections", (double)row->sections);
        nh_json_put_number(item, "planes", (double)row->planes);
    }
    put_special(x, nh_json_put_array(root, "special"));
    list = nh_classification_put_open(x->family, root, o->surfaces, o->surface);
    for (size_t k = 0; k < x->parts; k++)
        if (!x->part[k].within) nh_json_add_text(list, nh_classified_surface_words(x->family, x->part[k].polynomial));
    nh_json_put_bool(root, "nowhere_else", false); /* other values of the first parameter are not covered */
    nh_json_put_bool(root, "partial", x->partial);
    nh_run_json(run, x->family->almost_all->system, root);
    return nh_json_finish(root);
}
