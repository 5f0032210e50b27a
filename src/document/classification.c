#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "document/classification_internal.h"
#include "document/facts.h"
#include "graph/print.h"

/* ---- what both say ---- */

static const nh_classification *of(const nh_classified *x) { return x->classification; }

static bool special(const nh_classify_value *v) { return v->first > 0 && !v->degenerate; }

static size_t count_special(const nh_classified *x)
{
    size_t n = 0;
    for (size_t k = 0; k < of(x)->values; k++) n += special(&of(x)->value[k]);
    return n;
}

char *nh_classification_current(const nh_analysis *r, const nh_current *f, double shown)
{
    return nh_print_short(r->model->dag, f->has_in_velocities ? f->in_velocities
                          : nh_chart_shown(r->model->chart, f->phi), shown);
}

const char *const nh_classification_decide = "A count with more work may decide it: `--option count_work=N`.";

const char *nh_classification_end(const char *end)
{
    if (!strcmp(end, "work")) return "the count of integrals takes more work than the option `count_work`";
    if (!strcmp(end, "staircase")) return "looking for the values takes more work than the option `staircase`";
    if (!strcmp(end, "unknowns")) return "the linear system has more unknowns than the option `pencil`";
    if (!strcmp(end, "plane")) return "the determinants are larger than the option `plane`";
    if (!strcmp(end, "curves")) return "there are more curves, and the determinants are larger than the option `plane`";
    if (!strcmp(end, "time")) return "the run was ended";
    return end;
}

/* ---- text ---- */

void nh_classification_head(const nh_classified *x, nh_text *out)
{
    nh_text_addf(out, "%s\n%s, over ", x->title, nh_classification_subject(x));
    if (x->second) nh_text_addf(out, "%s and ", x->second);
    nh_text_addf(out, "%s%s", x->over, x->shape ? ", with coefficients that do not depend on cyclic coordinates" : "");
    const nh_system *s = x->almost_all->system;
    for (size_t i = s->constraints - s->levels; i < s->constraints; i++)
        nh_text_addf(out, "%s%s", i == s->constraints - s->levels ? "\n   on the level " : ", ", s->constraint[i].text);
    for (size_t i = 0; i < x->fixed; i++)
        nh_text_addf(out, "%s%s = %.15g", i ? ", " : "\n   with ", x->other[i].name, x->other[i].value);
    nh_text_add(out, "\n\n");
}

/* Where the integrals for almost all values are known and proved, more is more. */
void nh_classification_almost_all(const nh_classified *x, size_t degree, const nh_classify_number *n, size_t known,
                                  nh_text *out)
{
    bool all = n->bound == known;
    const char *bounded = all ? "" : x->of == NH_OF_INTEGRABILITY ? "" : "at most ";
    nh_text_add(out, "  ");
    nh_classification_level(x, degree, out);
    nh_text_addf(out, ": %s", bounded);
    nh_classification_amount(x, n->bound, out);
    nh_text_addf(out, "%s%s\n", x->of == NH_OF_CURRENTS ? " with the constant 1" : "", all ? "" : n->settled
                 ? ", the same over several orders" : ", perhaps fewer");
}

void nh_classification_known(const nh_classified *x, nh_text *out)
{
    for (size_t k = 0; k < x->known; k++) {
        const nh_current *f = nh_classified_current(x->almost_all, x->currents[k]);
        char *text = nh_classification_current(x->almost_all, f, x->almost_all->options.shown);
        nh_text_addf(out, "  %s = %s\n", f->name, text ? text : "... (too long to be shown; option `shown`)");
        nh_free(text);
    }
}

static void put_almost_all(const nh_classified *x, nh_text *out)
{
    nh_text_addf(out, "For almost all %s\n", x->over);
    for (size_t d = 1; d <= of(x)->rows; d++)
        nh_classification_almost_all(x, d, &of(x)->row[d - 1].number, of(x)->row[d - 1].known, out);
    nh_classification_known(x, out);
}

/* The currents that were constructed, and what that proves. */
static void currents_text(const nh_analysis *r, nh_text *out)
{
    for (size_t k = 0; k < r->count; k++) {
        const nh_current *f = &r->found[k];
        if (!f->proof.proved || f->series) continue;
        char *text = nh_classification_current(r, f, r->options.shown);
        nh_text_addf(out, "    %s = %s\n", f->name, text ? text : "... (too long to be shown; option `shown`)");
        nh_free(text);
    }
}

void nh_classification_counted(const nh_classified *x, size_t degree, bool first, const nh_classify_number *n,
                               size_t almost_all, bool complete, nh_text *out)
{
    const char *bounded = complete || x->of == NH_OF_INTEGRABILITY ? "" : n->settled ? "up to " : "at most ";
    nh_text_add(out, first ? "    " : ", ");
    nh_classification_level(x, degree, out);
    nh_text_addf(out, ": %s", n->bounded ? bounded : "not counted");
    if (!n->bounded) return;
    nh_classification_amount(x, n->bound, out);
    nh_text_add(out, " instead of ");
    nh_classification_amount(x, almost_all, out);
}

void nh_classification_proof(const nh_classified *x, const nh_classified_value *at, size_t first, nh_text *out)
{
    if (at->shown) {
        nh_text_addf(out, "    %s%s\n", at->shown, at->complete >= first ? ", proved" : "");
        return;
    }
    if (!at->result) {
        nh_text_addf(out, "    counted modulo primes; %s%s\n", x->question ? "" : "no currents: ",
                     at->why ? at->why : "the run was ended");
        return;
    }
    currents_text(at->result, out);
    if (at->complete >= first)
        nh_text_addf(out, "    all of them proved, and complete to degree %zu\n", at->complete);
    else nh_text_add(out, "    proved, but fewer than were counted: the others were not constructed\n");
}

static void put_value(const nh_classified *x, size_t index, nh_text *out)
{
    const nh_classify_value *v = &of(x)->value[index];
    const nh_classified_value *at = &x->value[index];
    nh_text_addf(out, "  %s\n", nh_classified_words(x, &v->polynomial));
    for (size_t d = v->first; d <= of(x)->rows; d++)
        nh_classification_counted(x, d, d == v->first, &v->number[d], of(x)->row[d - 1].number.bound, at->complete >= d, out);
    nh_text_add(out, "\n");
    nh_classification_proof(x, at, v->first, out);
}

void nh_classification_open(const nh_classified *x, nh_text *out)
{
    for (size_t k = 0; k < of(x)->values; k++) {
        const nh_classify_value *v = &of(x)->value[k];
        if (!v->open) continue;
        nh_text_addf(out, "\nNot decided at %s: ", nh_classified_words(x, &v->polynomial));
        nh_classification_level(x, v->open, out);
        nh_text_add(out, ", of which there may be ");
        nh_classification_beyond(x, of(x)->row[v->open - 1].number.bound, out);
        nh_text_addf(out, ". %s\n", nh_classification_decide);
    }
}

static void put_values(const nh_classified *x, nh_text *out)
{
    size_t n = count_special(x), degenerate = 0;
    if (n) nh_text_addf(out, "\n%s\n", nh_classification_where(x));
    for (size_t k = 0; k < of(x)->values; k++)
        if (special(&of(x)->value[k])) put_value(x, k, out);
    for (size_t k = 0; k < of(x)->values; k++) {
        const nh_classify_value *v = &of(x)->value[k];
        if (!v->degenerate) continue;
        nh_text_addf(out, "%s%s", degenerate++ ? "; " : "\nDegenerate, and not looked at: ",
                     nh_classified_words(x, &v->polynomial));
    }
    if (degenerate) nh_text_add(out, "\n");
    nh_classification_open(x, out);
}

static void put_infinity(const nh_classified *x, nh_text *out)
{
    const nh_classification *c = of(x);
    if (x->question) return;
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

/* What one degree excludes. */
static void put_excluded(const nh_classified *x, size_t degree, bool verbose, nh_text *out)
{
    const nh_classify_row *row = &of(x)->row[degree - 1];
    bool lifted = row->lifted && row->height >= 1;
    nh_text_add(out, "  ");
    nh_classification_level(x, degree, out);
    nh_text_add(out, row->theorem ? ": no number, real or complex," : ": no transcendental number");
    if (lifted && !row->theorem)
        nh_text_addf(out, ", and no rational one with numerator and denominator up to %.1e,", row->height);
    nh_text_add(out, " has ");
    nh_classification_beyond(x, row->number.bound, out);
    if (!lifted)
        nh_text_addf(out, "; up to %zu algebraic values, here or at a lower degree, are known modulo primes only",
                     row->roots);
    nh_text_add(out, "\n");
    if (!verbose || !lifted) return;
    if (row->theorem)
        nh_text_addf(out, "    (coefficients of special values have at most %.0f bits; others are excluded modulo %zu primes)\n",
                     row->bits, row->theorem_primes);
    nh_text_addf(out, "    (%zu unknowns, order %zu, modulo", row->unknowns, row->number.order);
    for (size_t i = 0; i < row->primes; i++) nh_text_addf(out, "%s %" PRIu64, i ? "," : "", row->prime[i]);
    nh_text_add(out, ")\n");
}

static void put_all_excluded(const nh_classified *x, bool verbose, nh_text *out)
{
    const nh_classification *c = of(x);
    if (!c->rows) return;
    nh_text_addf(out, "\n%s values, proved:\n", count_special(x) ? "No other" : "No special");
    size_t theorems = 0, known = 0, primes = 0;
    for (size_t d = 1; d <= c->rows; d++) {
        const nh_classify_row *row = &c->row[d - 1];
        put_excluded(x, d, verbose, out);
        theorems += row->theorem;
        known += row->bits > 0;
        if (row->theorem_primes > primes) primes = row->theorem_primes;
    }
    if (theorems == c->rows) return;
    nh_text_add(out, "  Another algebraic number could be one only if modulo all of the primes it has the residue of a value that was examined, or none.\n");
    if (known == c->rows)
        nh_text_addf(out, "  With `--option theorem=%zu` so many primes are taken that no number is left out.\n", primes);
}

void nh_classification_excluded(const nh_classified *x, bool verbose, nh_text *out)
{
    const char *end = of(x)->end;
    put_all_excluded(x, verbose, out);
    if (end && x->question) nh_text_addf(out, "\nThe question was not answered: %s.\n", nh_classification_end(end));
    else if (end) nh_text_addf(out, "\nDegree %zu was not reached: %s.\n", of(x)->rows + 1, nh_classification_end(end));
}

void nh_classification_text(const nh_classified *x, bool verbose, nh_text *out)
{
    nh_classification_head(x, out);
    if (of(x)->obstacle) {
        nh_text_addf(out, "Nothing can be said: %s.\n", of(x)->obstacle);
        return;
    }
    put_almost_all(x, out);
    put_values(x, out);
    put_infinity(x, out);
    nh_classification_excluded(x, verbose, out);
}

