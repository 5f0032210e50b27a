/* The classification over two parameters: what is not covered, in words; and the JSON. */
#include <inttypes.h>
#include <math.h>

#include "document/classification_internal.h"

typedef nh_classified_plane plane;

/* ---- what both say ---- */

static bool exact(const nh_plane_row *row) { return row->number.bound == row->known; }

static bool special(const nh_plane_curve *c) { return c->first > 0 && !c->degenerate; }

/* Lines that were not classified: mu is a root of a polynomial without rational roots, or the line was not reached, or
 * not up to the highest degree. */
static bool unexamined(const plane *x, const nh_plane_line *l)
{
    return l->across.degree > 1 || (!l->line && x->partial) || (l->line && l->line->rows < x->plane->rows);
}

/* Nothing is open: up to the height of the last degree there are no other special points. */
static bool closed(const plane *x)
{
    const nh_plane *o = x->plane;
    bool all = o->rows == x->family->degree && !x->partial;
    for (size_t d = 0; d < o->rows; d++) all &= o->row[d].lifted && exact(&o->row[d]);
    for (size_t k = 0; k < o->curves; k++)
        all &= !o->curve[k].open && (o->curve[k].first || o->curve[k].degenerate || x->curve[k].along);
    for (size_t k = 0; k < o->lines; k++) {
        const nh_classification *line = o->line[k].line;
        all &= !unexamined(x, &o->line[k]);
        for (size_t i = 0; line && i < line->values; i++) all &= !line->value[i].open;
    }
    return all;
}

/* ---- lines ---- */

void nh_classification_open_words(const nh_classified *x, size_t count, const nh_plane_curve *curve, nh_text *out)
{
    size_t written = 0;
    for (size_t k = 0; k < count; k++)
        if (curve[k].degenerate)
            nh_text_addf(out, "%s%s", written++ ? "; " : "Degenerate, and not examined: ",
                         nh_classified_surface_words(x, &curve[k].polynomial));
    nh_text_add(out, written ? ".\n" : "");
    for (size_t k = 0; k < count; k++)
        if (curve[k].open)
            nh_text_addf(out, "Not decided on %s: how many there are of degree %zu. %s\n",
                         nh_classified_surface_words(x, &curve[k].polynomial), curve[k].open, nh_classification_decide);
}

void nh_classification_plane_left(const plane *x, nh_text *out)
{
    const nh_plane *o = x->plane;
    nh_classification_open_words(x->family, o->curves, o->curve, out);
    for (size_t k = 0; k < o->curves; k++) /* curves without more integrals */
        if (!o->curve[k].first && !o->curve[k].degenerate && !x->curve[k].along)
            nh_text_addf(out, "Not examined: points on %s.\n",
                         nh_classified_surface_words(x->family, &o->curve[k].polynomial));
    for (size_t k = 0; k < o->lines; k++)
        if (unexamined(x, &o->line[k]))
            nh_text_addf(out, "Not examined, or not up to the highest degree: points with %s.\n",
                         nh_classified_values(x->family, x->over[1], &o->line[k].across));
}

void nh_classification_plane_excluded(const plane *x, nh_text *out)
{
    const nh_plane *o = x->plane;
    bool any = x->points > 0;
    for (size_t k = 0; k < o->curves; k++) any |= special(&o->curve[k]);
    if (o->rows) nh_text_addf(out, "%s:\n", any ? "Nowhere else" : "Nowhere more");
    for (size_t d = 1; d <= o->rows; d++) {
        const nh_plane_row *row = &o->row[d - 1];
        if (!row->lifted || row->height < 1) {
            nh_text_addf(
                out, "  degree %zu: curves and points, here or at a lower degree, are known modulo primes only\n", d);
            continue;
        }
        nh_text_addf(out,
                     "  degree %zu: no other pair of rational numbers with numerators and denominators up to %.1e has "
                     "more than %zu\n",
                     d, row->height, row->number.bound);
        if (row->swept)
            nh_text_addf(out, "    (by %zu lines of %s modulo %" PRIu64 ", and those of the points)\n", row->swept,
                         x->over[1], row->prime[0]);
        else {
            nh_text_addf(out, "    (%zu unknowns, order %zu, determinants of size %zu, modulo", row->unknowns,
                         row->number.order, row->size);
            for (size_t i = 0; i < row->primes; i++) nh_text_addf(out, "%s %" PRIu64, i ? "," : "", row->prime[i]);
            nh_text_add(out, ")\n");
        }
    }
    if (o->rows && o->row[o->rows - 1].swept)
        nh_text_addf(
            out,
            "  By lines, pairs in which %s is no such ratio are not examined: determinants are larger than the option "
            "`plane`.\n",
            x->over[1]);
    else if (o->rows)
        nh_text_add(
            out,
            "  Another pair of algebraic numbers can have more only if, modulo each of the primes, it lies on one of "
            "the curves, has the residues of a point that was examined, or has no residues. Infinite values were not "
            "examined.\n");
}

/* ---- JSON ---- */

static void put_json_curve(const plane *x, size_t index, nh_json *list)
{
    const nh_plane_curve *c = &x->plane->curve[index];
    const nh_classified_curve *at = &x->curve[index];
    nh_json *item = nh_json_add_object(list);
    nh_json_put_text(item, "where", nh_classified_surface_words(x->family, &c->polynomial));
    nh_json_put_text(item, "on", NULL);
    nh_classification_put_found(item, x->plane->rows, c->first, c->number, at->complete > 0, at->why);
    nh_classification_put_along(at->along, item);
}

/* {"B": "1", "eps": "1/3"}, or equations as text. */
static void put_json_point(const plane *x, const nh_classified_point *p, nh_json *list)
{
    const nh_analysis *r = p->at->result;
    nh_json *item = nh_json_add_object(list);
    nh_json *where = nh_json_put_object(item, "where");
    for (int k = 1; k >= 0; k--) nh_json_put_text(where, x->over[k], p->value[k]);
    nh_json_put_text(
        item, "on",
        p->curve == SIZE_MAX ? NULL : nh_classified_surface_words(x->family, &x->plane->curve[p->curve].polynomial));
    nh_classification_put_found(item, x->plane->rows, p->first, p->number, r && p->at->complete >= p->first,
                                p->at->why);
    nh_classification_put_currents(r, 0, NULL, item);
}

char *nh_classification_plane_json(const plane *x, const nh_run *run)
{
    const nh_plane *o = x->plane;
    nh_json *root = nh_classification_begin(x->family, o->obstacle, o->end, o->rows, o->row);
    nh_json *list = nh_json_put_array(root, "degrees");
    for (size_t d = 1; d <= o->rows; d++) {
        const nh_plane_row *row = &o->row[d - 1];
        nh_json *item = nh_classification_add_degree(list, d, row, row->lifted ? row->height : NAN);
        nh_json_put_number(item, "lines", (double)row->swept);
    }
    list = nh_json_put_array(root, "special");
    for (size_t k = 0; k < o->curves; k++)
        if (special(&o->curve[k])) put_json_curve(x, k, list);
    for (size_t k = 0; k < x->points; k++) put_json_point(x, &x->point[k], list);
    list = nh_classification_put_open(x->family, root, o->curves, o->curve);
    for (size_t k = 0; k < o->lines; k++)
        if (unexamined(x, &o->line[k]))
            nh_json_add_text(list, nh_classified_values(x->family, x->over[1], &o->line[k].across));
    nh_json_put_bool(root, "nowhere_else", closed(x));
    nh_json_put_bool(root, "partial", x->partial);
    nh_run_json(run, x->family->almost_all->system, root);
    return nh_json_finish(root);
}
