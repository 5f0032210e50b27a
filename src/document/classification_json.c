/* The classification over one parameter as JSON. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include "document/classification_internal.h"
#include "graph/print.h"

static const nh_classification *of(const nh_classified *x) { return x->classification; }

static bool exact(const nh_classify_row *row) { return row->number.bound == row->known; }

static bool special(const nh_classify_value *v) { return v->first > 0 && !v->degenerate; }

/* ---- parts shared with two and three parameters ---- */

static void put_number(nh_json *to, const char *key, const nh_classify_number *n)
{
    if (!n->bounded) {
        nh_json_put_null(to, key);
        return;
    }
    nh_json *item = nh_json_put_object(to, key);
    nh_json_put_number(item, "integrals", (double)n->bound);
    nh_json_put_number(item, "independent", (double)n->rank);
    nh_json_put_number(item, "order", (double)n->order);
    nh_json_put_bool(item, "settled", n->settled);
}

static void put_head(const nh_classified *x, nh_json *root)
{
    nh_json_put_number(root, "schema", 1);
    nh_json_put_text(root, "version", NH_VERSION);
    nh_json_put_text(root, "system", x->name);
    nh_json *over = nh_json_put_array(root, "over");
    if (x->third) nh_json_add_text(over, x->third);
    if (x->second) nh_json_add_text(over, x->second);
    nh_json_add_text(over, x->over);
    nh_json *parameters = nh_json_put_object(root, "parameters");
    for (size_t i = 0; i < x->fixed; i++) nh_json_put_number(parameters, x->other[i].name, x->other[i].value);
    nh_json_put_text(root, "of", nh_linear_question_name(x->of));
    nh_json_put_bool(root, "shape", x->shape);
    const nh_system *s = x->almost_all->system;
    nh_json *levels = nh_json_put_array(root, "levels");
    for (size_t i = s->constraints - s->levels; i < s->constraints; i++)
        nh_json_add_text(levels, s->constraint[i].text);
    nh_json_put_text(root, "where", nh_classification_side(x));
    nh_json_put_number(root, "degree", (double)x->degree);
}

void nh_classification_put_currents(const nh_analysis *r, size_t count, const size_t *index, nh_json *to)
{
    nh_json *list = nh_json_put_array(to, "currents");
    if (r && !index) count = r->count + r->furthers;
    for (size_t k = 0; r && k < count; k++) {
        const nh_current *f = nh_classified_current(r, index ? index[k] : k);
        if (!f->proof.proved || f->series) continue;
        char *text = nh_print_short(r->model->dag, nh_classification_formula(r, f), r->options.written);
        nh_json *item = nh_json_add_object(list);
        nh_json_put_text(item, "name", f->name);
        nh_json_put_text(item, "current", text);
        nh_free(text);
    }
}

/* For each degree from 1 on: numbers at one value. */
static void put_here(nh_json *to, size_t rows, const nh_classify_number *number)
{
    nh_json *degrees = nh_json_put_array(to, "degrees");
    for (size_t d = 1; d <= rows; d++) {
        nh_json *row = nh_json_add_object(degrees);
        nh_json_put_number(row, "degree", (double)d);
        put_number(row, "here", &number[d]);
    }
}

/* ---- two and three parameters ---- */

nh_json *nh_classification_begin(const nh_classified *x, const char *obstacle, const char *end, size_t rows,
                                 const nh_plane_row *row)
{
    nh_json *root = nh_json_object();
    put_head(x, root);
    nh_json_put_text(root, "obstacle", obstacle);
    nh_json_put_text(root, "ended_by", end);
    nh_json_put_number(root, "generic", rows ? (double)row[rows - 1].number.bound : NAN);
    nh_classification_put_currents(x->almost_all, x->known, x->currents, root);
    return root;
}

void nh_classification_put_along(const nh_classified *along, nh_json *to)
{
    nh_classification_put_currents(along ? along->almost_all : NULL, along ? along->known : 0,
                                   along ? along->currents : NULL, to);
}

static void put_primes(nh_json *to, size_t count, const uint64_t *prime)
{
    nh_json *primes = nh_json_put_array(to, "primes");
    for (size_t i = 0; i < count; i++) nh_json_add_number(primes, (double)prime[i]);
}

nh_json *nh_classification_add_degree(nh_json *list, size_t degree, const nh_plane_row *row, double height)
{
    nh_json *item = nh_json_add_object(list);
    nh_json_put_number(item, "degree", (double)degree);
    put_number(item, "almost_all", &row->number);
    nh_json_put_number(item, "known", (double)row->known);
    nh_json_put_bool(item, "exact", row->number.bound == row->known);
    nh_json_put_number(item, "unknowns", (double)row->unknowns);
    nh_json_put_number(item, "determinant", (double)row->size);
    nh_json_put_bool(item, "lifted", row->lifted);
    put_primes(item, row->primes, row->prime);
    nh_json_put_number(item, "excluded_height", height);
    return item;
}

void nh_classification_put_found(nh_json *item, size_t rows, size_t first, const nh_classify_number *number,
                                 bool proved, const char *why)
{
    nh_json_put_number(item, "from_degree", (double)first);
    nh_json_put_number(item, "dimension", (double)number[rows].bound);
    put_here(item, rows, number);
    nh_json_put_bool(item, "proved", proved);
    nh_json_put_text(item, "not_constructed_because", why);
}

nh_json *nh_classification_put_open(const nh_classified *x, nh_json *root, size_t count, const nh_plane_curve *curve)
{
    nh_json *degenerate = nh_json_put_array(root, "degenerate"), *undecided = nh_json_put_array(root, "undecided");
    for (size_t k = 0; k < count; k++) {
        const char *words = nh_classified_surface_words(x, &curve[k].polynomial);
        if (curve[k].degenerate) nh_json_add_text(degenerate, words);
        if (curve[k].open) nh_json_add_text(undecided, words);
    }
    return undecided;
}

/* ---- one parameter ---- */

static void put_degrees(const nh_classified *x, nh_json *to)
{
    nh_json *list = nh_json_put_array(to, "degrees");
    for (size_t d = 1; d <= of(x)->rows; d++) {
        const nh_classify_row *row = &of(x)->row[d - 1];
        nh_json *item = nh_json_add_object(list);
        nh_json_put_number(item, "degree", (double)d);
        put_number(item, "almost_all", &row->number);
        nh_json_put_number(item, "known", row->known == SIZE_MAX ? NAN : (double)row->known);
        nh_json_put_bool(item, "exact", exact(row));
        nh_json_put_number(item, "unknowns", (double)row->unknowns);
        nh_json_put_bool(item, "lifted", row->lifted);
        nh_json_put_number(item, "examined", (double)row->roots);
        put_primes(item, row->primes, row->prime);
        nh_json_put_number(item, "excluded_height", row->lifted ? row->height : NAN);
        nh_json_put_bool(item, "excluded_everywhere", row->theorem);
        nh_json_put_number(item, "primes_for_everywhere", row->bits > 0 ? (double)row->theorem_primes : NAN);
        put_number(item, "infinity", &row->infinite);
    }
}

/* {"eps": "1/3"}, or an equation as text. */
static void put_where(const nh_classified *x, const nh_classify_value *v, nh_json *item)
{
    int64_t top, bottom;
    char ratio[60];
    if (!nh_classified_rational(&v->polynomial, &top, &bottom)) {
        nh_json_put_text(item, "where", nh_classified_words(x, &v->polynomial));
        return;
    }
    snprintf(ratio, sizeof ratio, bottom == 1 ? "%" PRId64 : "%" PRId64 "/%" PRId64, top, bottom);
    nh_json_put_text(nh_json_put_object(item, "where"), x->over, ratio);
}

static void put_special(const nh_classified *x, size_t index, nh_json *list)
{
    const nh_classify_value *v = &of(x)->value[index];
    const nh_classified_value *at = &x->value[index];
    char text[60];
    nh_json *item = nh_json_add_object(list);
    put_where(x, v, item);
    nh_json *coefficients = nh_json_put_array(item, "polynomial");
    for (size_t j = 0; j <= v->polynomial.degree; j++) {
        snprintf(text, sizeof text, "%" PRId64, v->polynomial.coefficient[j]);
        nh_json_add_text(coefficients, text);
    }
    double *root = nh_alloc_array(v->polynomial.degree + 1, sizeof *root);
    nh_json_put_numbers(item, "real_values", nh_special_reals(&v->polynomial, root), root, 1);
    nh_free(root);
    nh_json_put_number(item, "from_degree", (double)v->first);
    nh_json_put_number(item, "dimension", (double)v->number[of(x)->rows].bound);
    put_here(item, of(x)->rows, v->number);
    nh_json_put_bool(item, "proved", (at->result || at->shown) && at->complete >= v->first);
    nh_json_put_text(item, "shown", at->shown);
    nh_json_put_text(item, "not_constructed_because", at->why);
    nh_classification_put_currents(at->result, 0, NULL, item);
}

/* Values at which the equations are singular, and values at which the number was not decided. */
static bool put_others(const nh_classified *x, nh_json *root)
{
    bool open = false;
    nh_json *degenerate = nh_json_put_array(root, "degenerate"), *undecided = nh_json_put_array(root, "undecided");
    for (size_t k = 0; k < of(x)->values; k++) {
        const nh_classify_value *v = &of(x)->value[k];
        if (v->degenerate) nh_json_add_text(degenerate, nh_classified_words(x, &v->polynomial));
        if (v->open) nh_json_add_text(undecided, nh_classified_words(x, &v->polynomial));
        open |= v->open > 0;
    }
    return open;
}

char *nh_classification_json(const nh_classified *x, const nh_run *run)
{
    nh_json *root = nh_json_object();
    bool all = of(x)->rows == (x->question ? x->question->family.levels : x->degree);
    put_head(x, root);
    nh_json_put_text(root, "obstacle", of(x)->obstacle);
    nh_json_put_text(root, "ended_by", of(x)->end);
    nh_json_put_bool(root, "limit", of(x)->limit);
    nh_json_put_number(root, "generic", of(x)->rows ? (double)of(x)->row[of(x)->rows - 1].number.bound : NAN);
    nh_classification_put_currents(x->almost_all, x->known, x->currents, root);
    put_degrees(x, root);
    nh_json *list = nh_json_put_array(root, "special");
    for (size_t k = 0; k < of(x)->values; k++)
        if (special(&of(x)->value[k])) put_special(x, k, list);
    all &= !put_others(x, root);
    for (size_t d = 0; d < of(x)->rows; d++) all &= of(x)->row[d].lifted && exact(&of(x)->row[d]);
    nh_json_put_bool(root, "nowhere_else", all);
    nh_json_put_bool(root, "partial", x->partial);
    nh_run_json(run, x->almost_all->system, root);
    return nh_json_finish(root);
}
