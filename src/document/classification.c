#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/progress.h"
#include "count/count.h"
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

nh_ex nh_classification_formula(const nh_analysis *r, const nh_current *f)
{
    return f->has_in_velocities ? f->in_velocities : nh_chart_shown(r->model->chart, f->phi);
}

const char *const nh_classification_decide = "A count with more work may decide it: `--option count_work=N`.";

const char *nh_classification_end(const char *end, char *room, size_t size)
{
    if (!strcmp(end, "work")) return "the count of integrals takes more work than the option `count_work`";
    if (!strcmp(end, "staircase")) return "looking for the values takes more work than the option `staircase`";
    if (!strcmp(end, "unknowns")) return "the linear system has more unknowns than the option `pencil`";
    if (!strcmp(end, "plane")) return "the determinants are larger than the option `plane`";
    if (!strcmp(end, "curves")) return "there are more curves, and the determinants are larger than the option `plane`";
    if (!strcmp(end, "surfaces")) return "the special surfaces have too high a degree in the first parameter";
    if (!strcmp(end, "time")) return nh_ended_words(room, size), room;
    return end;
}

/* ---- lines ---- */

/* "integrals polynomial in the velocities, over eps, with coefficients ..., on the level ..., with k = 2" */
void nh_classification_head(const nh_classified *x, nh_text *out)
{
    const nh_system *s = x->almost_all->system;
    nh_text_addf(out, "Classified: %s, over ", nh_classification_subject(x));
    if (x->third) nh_text_addf(out, "%s, ", x->third);
    if (x->second) nh_text_addf(out, "%s and ", x->second);
    nh_text_addf(out, "%s%s", x->over, x->shape ? ", with coefficients that do not depend on cyclic coordinates" : "");
    for (size_t i = s->constraints - s->levels; i < s->constraints; i++)
        nh_text_addf(out, "%s%s", i == s->constraints - s->levels ? ", on the level " : ", ", s->constraint[i].text);
    for (size_t i = 0; i < x->fixed; i++) {
        char digits[32];
        nh_text_number(x->other[i].value, digits, sizeof digits);
        nh_text_addf(out, "%s%s = %s", i ? ", " : ", with ", x->other[i].name, digits);
    }
    const char *where = nh_classification_side(x);
    nh_text_addf(out, "%s%s.\n", where ? ", " : "", where ? where : "");
}

/* Where the integrals for almost all values are known and proved, a larger number means more integrals. */
void nh_classification_almost_all(const nh_classified *x, size_t degree, const nh_classify_number *n, size_t known,
                                  nh_text *out)
{
    bool all = n->bound == known;
    const char *bounded = all ? "" : x->of == NH_OF_INTEGRABILITY ? "" : "at most ";
    nh_text_add(out, "  ");
    nh_classification_level(x, degree, out);
    nh_text_addf(out, ": %s", bounded);
    nh_classification_amount(x, n->bound, out);
    nh_text_addf(out, "%s%s\n", x->of == NH_OF_CURRENTS ? " (counting the constant 1)" : "",
                 all          ? ""
                 : n->settled ? "; several orders give the same bound"
                              : ", perhaps fewer");
}

void nh_classification_counted(const nh_classified *x, size_t degree, bool first, const nh_classify_number *n,
                               size_t almost_all, bool complete, nh_text *out)
{
    const char *bounded = complete || x->of == NH_OF_INTEGRABILITY ? "" : n->settled ? "up to " : "at most ";
    nh_text_add(out, first ? "" : ", ");
    nh_classification_level(x, degree, out);
    nh_text_addf(out, ": %s", n->bounded ? bounded : "not counted");
    if (!n->bounded) return;
    nh_classification_amount(x, n->bound, out);
    nh_text_add(out, " instead of ");
    nh_classification_amount(x, almost_all, out);
}

void nh_classification_left(const nh_classified *x, nh_text *out)
{
    const nh_classification *c = of(x);
    size_t degenerate = 0, first = 0;
    for (size_t k = 0; k < c->values; k++) {
        if (!c->value[k].degenerate || x->value[k].why) continue;
        nh_text_addf(out, "%s%s", degenerate++ ? "; " : "Degenerate, and not examined: ",
                     nh_classified_words(x, &c->value[k].polynomial));
    }
    if (degenerate) nh_text_add(out, ".\n");
    for (size_t k = 0; k < c->values; k++)
        if (c->value[k].degenerate && x->value[k].why)
            nh_text_addf(out, "Degenerate: %s (%s).\n", nh_classified_words(x, &c->value[k].polynomial),
                         x->value[k].why);
    for (size_t k = 0; k < c->values; k++) {
        const nh_classify_value *v = &c->value[k];
        if (!v->open || v->degenerate) continue;
        nh_text_addf(out, "Not decided at %s: ", nh_classified_words(x, &v->polynomial));
        nh_classification_level(x, v->open, out);
        nh_text_add(out, ", of which there may be ");
        nh_classification_beyond(x, c->row[v->open - 1].number.bound, out);
        nh_text_addf(out, ". %s\n", nh_classification_decide);
    }
    if (x->question) return;
    for (size_t d = c->rows; d >= 1; d--)
        if (c->row[d - 1].infinite.bounded && c->row[d - 1].infinite.bound > c->row[d - 1].number.bound) first = d;
    if (!c->limit) nh_text_addf(out, "As %s goes to infinity the equations of motion have no limit.\n", x->over);
    else if (!first) nh_text_addf(out, "In the limit of infinite %s: not more.\n", x->over);
    else
        nh_text_addf(out, "In the limit of infinite %s: up to %zu instead of %zu at degree %zu.\n", x->over,
                     c->row[first - 1].infinite.bound, c->row[first - 1].number.bound, first);
}

/* The sentence about one degree: which values are excluded. */
static void put_excluded(const nh_classified *x, size_t degree, nh_text *out)
{
    const nh_classify_row *row = &of(x)->row[degree - 1];
    bool lifted = row->lifted && row->height >= 1;
    nh_text_add(out, "  ");
    nh_classification_level(x, degree, out);
    nh_text_addf(out, ": no %s%s has ", count_special(x) ? "other " : "", x->over);
    nh_classification_beyond(x, row->number.bound, out);
    if (row->theorem) nh_text_add(out, " (proved for all numbers, real or complex)");
    else if (lifted)
        nh_text_addf(out, " (proved for all transcendental %s and all fractions with terms up to %.1e)", x->over,
                     row->height);
    else
        nh_text_addf(out,
                     " (proved for all transcendental %s; up to %zu algebraic values, here or at a lower degree, "
                     "are known modulo primes only)",
                     x->over, row->roots);
    nh_text_add(out, "\n");
    if (!lifted) return;
    if (row->theorem)
        nh_text_addf(
            out, "    (coefficients of special values have at most %.0f bits; others are excluded modulo %zu primes)\n",
            row->bits, row->theorem_primes);
    nh_text_addf(out, "    (%zu unknowns, order %zu, modulo", row->unknowns, row->number.order);
    for (size_t i = 0; i < row->primes; i++) nh_text_addf(out, "%s %" PRIu64, i ? "," : "", row->prime[i]);
    nh_text_add(out, ")\n");
}

size_t nh_classification_unlifted(const nh_classified *x)
{
    const nh_classification *c = of(x);
    size_t most = 0;
    for (size_t d = 1; d <= c->rows; d++) {
        const nh_classify_row *row = &c->row[d - 1];
        if (!(row->lifted && row->height >= 1) && row->roots > most) most = row->roots;
    }
    return most;
}

void nh_classification_excluded(const nh_classified *x, nh_text *out)
{
    const nh_classification *c = of(x);
    if (!c->rows) return;
    size_t theorems = 0, known = 0, primes = 0;
    for (size_t d = 1; d <= c->rows; d++) {
        const nh_classify_row *row = &c->row[d - 1];
        put_excluded(x, d, out);
        theorems += row->theorem;
        known += row->bits > 0;
        if (row->theorem_primes > primes) primes = row->theorem_primes;
    }
    if (theorems == c->rows) return;
    nh_text_add(out,
                "  Irrational algebraic values are almost, but not completely, ruled out: modulo each of the primes "
                "such a number would have the residue of a value that was examined, or none.\n");
    if (known == c->rows)
        nh_text_addf(out,
                     "  With `--option theorem=%zu` the program takes enough primes to exclude all other numbers.\n",
                     primes);
}

/* ---- words ---- */

static const struct {
    const char *subject; /* the subject of the whole classification */
    const char *where;   /* heading of the special values, and of sentences about them */
    const char *more;    /* "more ..." */
} WORDS[NH_LINEAR_QUESTIONS] = {
    [NH_OF_CURRENTS] = {"integrals polynomial in the velocities", "Special values",
                        "more conserved quantities than the others"},
    [NH_OF_MEASURE] = {"invariant measures exp(sigma(q)) dq dw", "Values with an invariant measure",
                       "an invariant measure (a preserved volume)"},
    [NH_OF_HAMILTONIZATION] =
        {"conformal factors on the shape space, by which the reduced equations become Hamiltonian",
         "Values with a conformal factor", "a conformal factor"},
    [NH_OF_SYMMETRIES] = {"infinitesimal symmetries of Lagrangian and constraints", "Values with more symmetries",
                          "more symmetries than the others"},
    [NH_OF_INTEGRABILITY] = {"directions that brackets of the allowed motions have", "Values with fewer directions",
                             "fewer directions of motion than the others"},
};

const char *nh_classification_subject(const nh_classified *x) { return WORDS[x->of].subject; }
const char *nh_classification_where(const nh_classified *x) { return WORDS[x->of].where; }
const char *nh_classification_more(const nh_classified *x) { return WORDS[x->of].more; }

const char *nh_classification_side(const nh_classified *x)
{
    return x->of == NH_OF_CURRENTS ? nh_count_where(x->almost_all->model) : NULL;
}

void nh_classification_level(const nh_classified *x, size_t level, nh_text *out)
{
    switch (x->of) {
    case NH_OF_MEASURE: nh_text_add(out, "densities"); return;
    case NH_OF_HAMILTONIZATION: nh_text_add(out, "factors"); return;
    case NH_OF_SYMMETRIES: nh_text_add(out, "symmetries"); return;
    case NH_OF_INTEGRABILITY: nh_text_addf(out, "brackets up to length %zu", level + 1); return;
    default: nh_text_addf(out, "degree %zu", level);
    }
}

void nh_classification_amount(const nh_classified *x, size_t bound, nh_text *out)
{
    bool word = x->of == NH_OF_MEASURE || x->of == NH_OF_HAMILTONIZATION;
    bool rank = x->of == NH_OF_INTEGRABILITY && x->question;
    if (word && bound < 2) nh_text_add(out, bound ? "one" : "none");
    else nh_text_addf(out, "%zu", rank ? x->question->family.unknowns - bound : bound);
}

void nh_classification_beyond(const nh_classified *x, size_t bound, nh_text *out)
{
    bool any = (x->of == NH_OF_MEASURE || x->of == NH_OF_HAMILTONIZATION) && !bound;
    nh_text_add(out, any ? "one" : x->of == NH_OF_INTEGRABILITY ? "less than " : "more than ");
    if (!any) nh_classification_amount(x, bound, out);
}
