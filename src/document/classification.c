#include "document/classification.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "graph/print.h"
#include "document/facts.h"

/* ---- what both say ---- */

static const nh_classification *of(const nh_classified *x) { return x->classification; }

/* The integrals for almost all values are known and proved: then more is more. */
static bool exact(const nh_classify_row *row) { return row->number.bound == row->known; }

static bool special(const nh_classify_value *v) { return v->first > 0 && !v->degenerate; }

static size_t count_special(const nh_classified *x)
{
    size_t n = 0;
    for (size_t k = 0; k < of(x)->values; k++) n += special(&of(x)->value[k]);
    return n;
}

static char *current_text(const nh_analysis *r, const nh_current *f, double shown)
{
    return nh_print_short(r->model->dag, f->has_in_velocities ? f->in_velocities
                          : nh_chart_shown(r->model->chart, f->phi), shown);
}

static const char *end_words(const char *end)
{
    if (!strcmp(end, "work")) return "the count of integrals takes more work than the option `count_work`";
    if (!strcmp(end, "unknowns")) return "the linear system has more unknowns than the option `pencil`";
    if (!strcmp(end, "time")) return "the run was ended";
    return end;
}

/* ---- text ---- */

static void put_head(const nh_classified *x, nh_text *out)
{
    nh_text_addf(out, "%s\nintegrals polynomial in the velocities, over %s%s", x->title, x->over, x->shape
                 ? ", with coefficients that do not depend on cyclic coordinates" : "");
    for (size_t i = 0; i < x->others; i++)
        nh_text_addf(out, "%s%s = %.15g", i ? ", " : "\n   with ", x->other[i].name, x->other[i].value);
    nh_text_add(out, "\n\n");
}

static void put_almost_all(const nh_classified *x, nh_text *out)
{
    nh_text_addf(out, "For almost all %s\n", x->over);
    for (size_t d = 1; d <= of(x)->rows; d++) {
        const nh_classify_row *row = &of(x)->row[d - 1];
        nh_text_addf(out, "  degree %zu: %s%zu with the constant 1%s\n", d, exact(row) ? "" : "at most ",
                     row->number.bound,
                     exact(row) ? "" : row->number.settled ? ", the same over several orders" : ", perhaps fewer");
    }
    for (size_t k = 0; k < x->known; k++) {
        const nh_current *f = &x->almost_all->found[x->currents[k]];
        char *text = current_text(x->almost_all, f, x->almost_all->options.shown);
        nh_text_addf(out, "  %s = %s\n", f->name, text ? text : "... (too long to be shown; option `shown`)");
        nh_free(text);
    }
}

static void put_currents(const nh_classified_value *at, nh_text *out)
{
    const nh_analysis *r = at->result;
    for (size_t k = 0; k < r->count; k++) {
        const nh_current *f = &r->found[k];
        if (!f->proof.proved || f->series) continue;
        char *text = current_text(r, f, r->options.shown);
        nh_text_addf(out, "    %s = %s\n", f->name, text ? text : "... (too long to be shown; option `shown`)");
        nh_free(text);
    }
}

static void put_value(const nh_classified *x, size_t index, nh_text *out)
{
    const nh_classify_value *v = &of(x)->value[index];
    const nh_classified_value *at = &x->value[index];
    nh_text_addf(out, "  %s\n    ", nh_classified_words(x, &v->polynomial));
    for (size_t d = v->first; d <= of(x)->rows; d++) {
        const nh_classify_number *n = &v->number[d];
        nh_text_addf(out, "%sdegree %zu: ", d > v->first ? ", " : "", d);
        if (!n->bounded) nh_text_add(out, "not counted");
        else nh_text_addf(out, "%s%zu instead of %zu", at->complete >= d ? "" : n->settled ? "up to " : "at most ",
                          n->bound, of(x)->row[d - 1].number.bound);
    }
    nh_text_add(out, "\n");
    if (!at->result) {
        nh_text_addf(out, "    counted modulo primes; no currents: %s\n", at->why);
        return;
    }
    put_currents(at, out);
    if (at->complete >= v->first)
        nh_text_addf(out, "    all of them proved, and complete to degree %zu\n", at->complete);
    else nh_text_add(out, "    proved, but fewer than were counted: the others were not constructed\n");
}

static void put_values(const nh_classified *x, nh_text *out)
{
    size_t n = count_special(x), degenerate = 0;
    if (n) nh_text_add(out, "\nMore for\n");
    for (size_t k = 0; k < of(x)->values; k++)
        if (special(&of(x)->value[k])) put_value(x, k, out);
    for (size_t k = 0; k < of(x)->values; k++) {
        const nh_classify_value *v = &of(x)->value[k];
        if (!v->degenerate) continue;
        nh_text_addf(out, "%s%s", degenerate++ ? "; " : "\nDegenerate, and not looked at: ",
                     nh_classified_words(x, &v->polynomial));
    }
    if (degenerate) nh_text_add(out, "\n");
    for (size_t k = 0; k < of(x)->values; k++) {
        const nh_classify_value *v = &of(x)->value[k];
        if (v->open)
            nh_text_addf(out, "\nNot decided at %s: how many there are of degree %zu.\n",
                         nh_classified_words(x, &v->polynomial), v->open);
    }
}

static void put_infinity(const nh_classified *x, nh_text *out)
{
    const nh_classification *c = of(x);
    if (!c->limit) {
        nh_text_addf(out, "\nAs %s goes to infinity the equations of motion have no limit.\n", x->over);
        return;
    }
    size_t first = 0;
    for (size_t d = c->rows; d >= 1; d--)
        if (c->row[d - 1].infinite.bounded && c->row[d - 1].infinite.bound > c->row[d - 1].number.bound) first = d;
    if (first)
        nh_text_addf(out, "\nIn the limit of infinite %s: up to %zu instead of %zu at degree %zu.\n", x->over,
                     c->row[first - 1].infinite.bound, c->row[first - 1].number.bound, first);
    else nh_text_addf(out, "\nIn the limit of infinite %s: not more.\n", x->over);
}

static void put_excluded(const nh_classified *x, bool verbose, nh_text *out)
{
    const nh_classification *c = of(x);
    if (!c->rows) return;
    nh_text_addf(out, "\n%s values, proved:\n", count_special(x) ? "No other" : "No special");
    for (size_t d = 1; d <= c->rows; d++) {
        const nh_classify_row *row = &c->row[d - 1];
        if (!row->lifted || row->height < 1) {
            nh_text_addf(out, "  degree %zu: no transcendental number has more than %zu; up to %zu algebraic values, here or at a lower degree, are known modulo primes only\n", d, row->number.bound, row->roots);
            continue;
        }
        nh_text_addf(out, "  degree %zu: no transcendental number, and no rational one with numerator and denominator up to %.1e, has more than %zu\n", d, row->height, row->number.bound);
        if (verbose) {
            nh_text_addf(out, "    (%zu unknowns, order %zu, modulo", row->unknowns, row->number.order);
            for (size_t i = 0; i < row->primes; i++) nh_text_addf(out, "%s %" PRIu64, i ? "," : "", row->prime[i]);
            nh_text_add(out, ")\n");
        }
    }
    nh_text_add(out, "  Another algebraic number could be one only if modulo all of the primes it has the residue of a value that was examined, or none.\n");
}

void nh_classification_text(const nh_classified *x, bool verbose, nh_text *out)
{
    put_head(x, out);
    if (of(x)->obstacle) {
        nh_text_addf(out, "Nothing can be said: %s.\n", of(x)->obstacle);
        return;
    }
    put_almost_all(x, out);
    put_values(x, out);
    put_infinity(x, out);
    put_excluded(x, verbose, out);
    if (of(x)->end) nh_text_addf(out, "\nDegree %zu was not reached: %s.\n", of(x)->rows + 1, end_words(of(x)->end));
}

/* ---- JSON ---- */

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

static void put_degrees(const nh_classified *x, nh_json *to)
{
    nh_json *list = nh_json_put_array(to, "degrees");
    for (size_t d = 1; d <= of(x)->rows; d++) {
        const nh_classify_row *row = &of(x)->row[d - 1];
        nh_json *item = nh_json_add_object(list);
        nh_json_put_number(item, "degree", (double)d);
        put_number(item, "almost_all", &row->number);
        nh_json_put_number(item, "known", (double)row->known);
        nh_json_put_bool(item, "exact", exact(row));
        nh_json_put_number(item, "unknowns", (double)row->unknowns);
        nh_json_put_bool(item, "lifted", row->lifted);
        nh_json_put_number(item, "examined", (double)row->roots);
        nh_json *primes = nh_json_put_array(item, "primes");
        for (size_t i = 0; i < row->primes; i++) nh_json_add_number(primes, (double)row->prime[i]);
        nh_json_put_number(item, "excluded_height", row->lifted ? row->height : NAN);
        put_number(item, "infinity", &row->infinite);
    }
}

/* What is proved at a value or for almost all; "current" is null when it is longer than the option `written`. */
static void put_list(const nh_analysis *r, size_t count, const size_t *index, nh_json *to)
{
    nh_json *list = nh_json_put_array(to, "currents");
    for (size_t k = 0; r && k < count; k++) {
        const nh_current *f = &r->found[index ? index[k] : k];
        if (!f->proof.proved || f->series) continue;
        char *text = current_text(r, f, r->options.written);
        nh_json *item = nh_json_add_object(list);
        nh_json_put_text(item, "name", f->name);
        nh_json_put_text(item, "current", text);
        nh_free(text);
    }
}

static void put_special(const nh_classified *x, size_t index, nh_json *list)
{
    const nh_classify_value *v = &of(x)->value[index];
    const nh_classified_value *at = &x->value[index];
    int64_t top, bottom;
    char ratio[60];
    nh_json *item = nh_json_add_object(list), *coefficients = nh_json_put_array(item, "polynomial");
    for (size_t j = 0; j <= v->polynomial.degree; j++) {
        snprintf(ratio, sizeof ratio, "%" PRId64, v->polynomial.coefficient[j]);
        nh_json_add_text(coefficients, ratio);
    }
    bool rational = nh_classified_rational(&v->polynomial, &top, &bottom);
    if (rational) snprintf(ratio, sizeof ratio, bottom == 1 ? "%" PRId64 : "%" PRId64 "/%" PRId64, top, bottom);
    nh_json_put_text(item, "value", rational ? ratio : NULL);
    double *root = nh_alloc_array(v->polynomial.degree + 1, sizeof *root);
    nh_json_put_numbers(item, "real_values", nh_special_reals(&v->polynomial, root), root, 1);
    nh_free(root);
    nh_json_put_bool(item, "degenerate", v->degenerate);
    nh_json_put_number(item, "from_degree", special(v) ? (double)v->first : NAN);
    nh_json_put_number(item, "undecided_at", v->open ? (double)v->open : NAN);
    nh_json *degrees = nh_json_put_array(item, "degrees");
    for (size_t d = 1; d <= of(x)->rows && special(v); d++) {
        nh_json *row = nh_json_add_object(degrees);
        nh_json_put_number(row, "degree", (double)d);
        put_number(row, "here", &v->number[d]);
    }
    nh_json_put_bool(item, "constructed", at->result && at->complete >= v->first && special(v));
    nh_json_put_text(item, "not_constructed_because", at->why);
    put_list(at->result, at->result ? at->result->count : 0, NULL, item);
}

char *nh_classification_json(const nh_classified *x, const nh_run *run)
{
    nh_json *root = nh_json_object();
    nh_json_put_number(root, "schema", 1);
    nh_json_put_text(root, "version", NH_VERSION);
    nh_json_put_text(root, "system", x->name);
    nh_json_put_text(root, "over", x->over);
    nh_json *parameters = nh_json_put_object(root, "parameters");
    for (size_t i = 0; i < x->others; i++) nh_json_put_number(parameters, x->other[i].name, x->other[i].value);
    nh_json_put_bool(root, "shape", x->shape);
    nh_json_put_number(root, "degree", (double)x->degree);
    nh_json_put_text(root, "obstacle", of(x)->obstacle);
    nh_json_put_text(root, "ended_by", of(x)->end);
    nh_json_put_bool(root, "limit", of(x)->limit);
    put_list(x->almost_all, x->known, x->currents, root);
    put_degrees(x, root);
    nh_json *list = nh_json_put_array(root, "values");
    for (size_t k = 0; k < of(x)->values; k++)
        if (special(&of(x)->value[k]) || of(x)->value[k].degenerate || of(x)->value[k].open) put_special(x, k, list);
    nh_json_put_bool(root, "partial", x->partial);
    nh_run_json(run, x->almost_all->system, root);
    return nh_json_finish(root);
}
