/* A classification as JSON. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include "document/classification_internal.h"
#include "graph/print.h"

/* ---- pieces ---- */

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
    for (size_t v = x->parameters; v-- > 0;) nh_json_add_text(over, x->over[v]);
    nh_json *parameters = nh_json_put_object(root, "parameters");
    for (size_t i = 0; i < x->fixed; i++) nh_json_put_number(parameters, x->other[i].name, x->other[i].value);
    nh_json_put_text(root, "of", nh_linear_question_name(x->of));
    nh_json_put_bool(root, "shape", x->shape);
    const nh_system *system = x->almost_all->question->system;
    nh_json *levels = nh_json_put_array(root, "levels");
    for (size_t i = system->constraints - system->levels; i < system->constraints; i++)
        nh_json_add_text(levels, system->constraint[i].text);
    nh_json_put_text(root, "where", nh_classification_side(x));
    nh_json_put_number(root, "degree", (double)x->degree);
}

/* The currents proved at a place or for almost all values; "current" is null when it is longer than the option
 * `written`. */
static void put_currents(const nh_analysis *result, size_t count, const size_t *index, nh_json *to)
{
    nh_json *list = nh_json_put_array(to, "currents");
    for (size_t k = 0; result && k < count; k++) {
        const nh_current *f = nh_classified_current(result, index ? index[k] : k);
        if (!f->proof.proved || f->series) continue;
        char *text = nh_print_short(result->question->model->dag, nh_classification_formula(result, f),
                                    result->question->options.written);
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

static void put_primes(nh_json *to, size_t count, const uint64_t *prime)
{
    nh_json *primes = nh_json_put_array(to, "primes");
    for (size_t i = 0; i < count; i++) nh_json_add_number(primes, (double)prime[i]);
}

/* ---- degrees ---- */

/* Keys of one parameter, in addition to those of all. */
static void put_value_row(const nh_classify_row *row, nh_json *item)
{
    nh_json_put_bool(item, "excluded_everywhere", row->theorem);
    nh_json_put_number(item, "primes_for_everywhere", row->bits > 0 ? (double)row->theorem_primes : NAN);
    put_number(item, "infinity", &row->infinite);
}

static void put_degrees(const nh_classified *x, nh_json *to)
{
    nh_json *list = nh_json_put_array(to, "degrees");
    for (size_t d = 1; d <= x->classification->rows; d++) {
        const nh_classify_row *row = &x->classification->row[d - 1];
        nh_json *item = nh_json_add_object(list);
        nh_json_put_number(item, "degree", (double)d);
        put_number(item, "almost_all", &row->number);
        nh_json_put_number(item, "known", row->known == SIZE_MAX ? NAN : (double)row->known);
        nh_json_put_bool(item, "exact", nh_classification_is_exact(row));
        nh_json_put_number(item, "unknowns", (double)row->unknowns);
        if (x->parameters > 1) nh_json_put_number(item, "determinant", (double)row->size);
        nh_json_put_bool(item, "lifted", row->lifted);
        if (x->parameters == 1) nh_json_put_number(item, "examined", (double)row->roots);
        put_primes(item, row->primes, row->prime);
        bool known = x->parameters == 3 ? row->swept > 0 : row->lifted;
        nh_json_put_number(item, "excluded_height", known ? row->height : NAN);
        if (x->parameters == 1) put_value_row(row, item);
        if (x->parameters == 2) nh_json_put_number(item, "lines", (double)row->swept);
        if (x->parameters == 3) nh_json_put_number(item, "sections", (double)row->sections);
        if (x->parameters == 3) nh_json_put_number(item, "planes", (double)row->swept);
    }
}

/* ---- places ---- */

/* {"B": "1", "eps": "1/3"}, or an equation as text. */
static void put_where(const nh_classified *x, const nh_classified_place *at, nh_json *item)
{
    if (at->dimension || (x->parameters == 1 && !isfinite(at->about[0]))) {
        nh_json_put_text(item, "where", at->where);
        return;
    }
    nh_json *where = nh_json_put_object(item, "where");
    for (size_t v = x->parameters; v-- > 0;) nh_json_put_text(where, x->over[v], at->value[v]);
}

/* The polynomial of a value, and its real roots. */
static void put_polynomial(const nh_special_factor *s, nh_json *item)
{
    static const double none[NH_MOST_PARAMETERS] = {0};
    char text[60];
    nh_json *coefficients = nh_json_put_array(item, "polynomial");
    for (size_t j = 0; j <= s->degree[0]; j++) {
        snprintf(text, sizeof text, "%" PRId64, s->coefficient[j]);
        nh_json_add_text(coefficients, text);
    }
    double *root = nh_alloc_array(s->degree[0] + 1, sizeof *root);
    nh_json_put_numbers(item, "real_values", nh_special_reals(s, 0, none, root), root, 1);
    nh_free(root);
}

static void put_place(const nh_classified *x, const nh_classified_place *at, nh_json *list)
{
    const nh_classified_finding *f = &at->finding;
    size_t rows = x->classification->rows;
    nh_json *item = nh_json_add_object(list);
    put_where(x, at, item);
    if (x->parameters == 1) put_polynomial(&at->zeros.equation[0], item);
    else nh_json_put_text(item, "on", at->on ? nh_classified_equation(x, at->on) : NULL);
    nh_json_put_number(item, "from_degree", (double)at->first);
    nh_json_put_number(item, "dimension", (double)at->number[rows].bound);
    put_here(item, rows, at->number);
    nh_json_put_bool(item, "proved", (f->result || f->shown) && f->complete >= at->first);
    if (x->parameters == 1) nh_json_put_text(item, "shown", f->shown);
    nh_json_put_text(item, "not_constructed_because", f->why);
    put_currents(f->result, f->count, f->index, item);
}

/* What is singular, and what was not decided or not examined. */
static void put_open(const nh_classified *x, nh_json *root)
{
    const nh_classification *c = x->classification;
    nh_json *degenerate = nh_json_put_array(root, "degenerate"), *undecided = nh_json_put_array(root, "undecided");
    for (size_t k = 0; k < c->specials; k++) {
        const char *words = nh_classification_zeros(x, &c->special[k].polynomial);
        if (c->special[k].degenerate) nh_json_add_text(degenerate, words);
        if (c->special[k].open) nh_json_add_text(undecided, words);
    }
    for (size_t k = 0; k < c->walls; k++)
        if (nh_classification_is_unexamined(x, &c->wall[k]))
            nh_json_add_text(undecided, nh_classified_words(x, &c->wall[k].polynomial));
    for (size_t k = 0; k < x->parts && x->parameters == 3; k++)
        if (!x->part[k].within && (!x->part[k].special || !x->part[k].special->degenerate))
            nh_json_add_text(undecided, nh_classified_equation(x, x->part[k].polynomial));
}

char *nh_classification_json(const nh_classified *x, const nh_run *run)
{
    const nh_classification *c = x->classification;
    nh_json *root = nh_json_object();
    put_head(x, root);
    nh_json_put_text(root, "obstacle", c->obstacle);
    nh_json_put_text(root, "ended_by", c->end);
    if (x->parameters == 1) nh_json_put_bool(root, "limit", c->limit);
    nh_json_put_number(root, "generic", c->rows ? (double)c->row[c->rows - 1].number.bound : NAN);
    put_currents(x->almost_all, x->known, x->currents, root);
    put_degrees(x, root);
    nh_json *list = nh_json_put_array(root, "special");
    for (size_t k = 0; k < x->places; k++) put_place(x, &x->place[k], list);
    put_open(x, root);
    nh_json_put_bool(root, "nowhere_else", nh_classification_is_closed(x));
    nh_json_put_bool(root, "partial", x->partial);
    nh_run_json(run, x->almost_all->question->system, root);
    return nh_json_finish(root);
}
