/* The words of a classification: what is asked, how many integrals there are, what is open and what is excluded. */
#include <ctype.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/progress.h"
#include "count/count.h"
#include "document/classification_internal.h"
#include "document/facts.h"
#include "graph/print.h"

/* ---- facts ---- */

nh_ex nh_classification_formula(const nh_analysis *result, const nh_current *f)
{
    return f->has_in_velocities ? f->in_velocities : nh_chart_shown(result->question->model->chart, f->phi);
}

bool nh_classification_is_exact(const nh_classify_row *row) { return row->number.bound == row->known; }

/* mu is a root of a polynomial without rational roots, or the line was not reached, or not up to the highest degree. */
bool nh_classification_is_unexamined(const nh_classified *x, const nh_classify_wall *line)
{
    int64_t top, bottom;
    return x->parameters == 2 &&
           (!nh_special_rational(&line->polynomial, &top, &bottom) || (!line->within && x->partial) ||
            (line->within && line->within->rows < x->classification->rows));
}

bool nh_classification_is_closed(const nh_classified *x)
{
    const nh_classification *c = x->classification;
    bool all = c->rows == (x->question ? x->question->family.levels : x->degree) && !x->partial;
    if (x->parameters == 3) return false; /* other values of the first parameter are not covered */
    for (size_t d = 0; d < c->rows; d++) all &= c->row[d].lifted && nh_classification_is_exact(&c->row[d]);
    for (size_t k = 0; k < c->specials; k++) {
        const nh_classify_special *v = &c->special[k];
        all &= !v->open && (x->parameters == 1 || v->first || v->degenerate || x->part[k].within);
    }
    for (size_t k = 0; k < c->walls; k++) {
        const nh_classification *within = c->wall[k].within;
        all &= !nh_classification_is_unexamined(x, &c->wall[k]);
        for (size_t i = 0; within && i < within->specials; i++) all &= !within->special[i].open;
    }
    return all;
}

const char *nh_classification_kind(const nh_classified *x, size_t dimension, size_t *count)
{
    static const char *const kind[] = {"point", "curve", "surface"};
    *count = 0;
    for (size_t k = 0; k < x->places; k++) *count += x->place[k].dimension == dimension;
    return kind[dimension];
}

size_t nh_classification_unlifted(const nh_classified *x)
{
    const nh_classification *c = x->classification;
    size_t most = 0;
    for (size_t d = 0; d < c->rows; d++)
        if (!(c->row[d].lifted && c->row[d].height >= 1) && c->row[d].roots > most) most = c->row[d].roots;
    return most;
}

/* ---- the question ---- */

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

const char *nh_classification_where(const nh_classified *x) { return WORDS[x->of].where; }
const char *nh_classification_more(const nh_classified *x) { return WORDS[x->of].more; }

const char *nh_classification_side(const nh_classified *x)
{
    return x->of == NH_OF_CURRENTS ? nh_count_where(x->almost_all->question->model) : NULL;
}

static void put_level(const nh_classified *x, size_t level, nh_text *out)
{
    switch (x->of) {
    case NH_OF_MEASURE: nh_text_add(out, "densities"); return;
    case NH_OF_HAMILTONIZATION: nh_text_add(out, "factors"); return;
    case NH_OF_SYMMETRIES: nh_text_add(out, "symmetries"); return;
    case NH_OF_INTEGRABILITY: nh_text_addf(out, "brackets up to length %zu", level + 1); return;
    default: nh_text_addf(out, "degree %zu", level);
    }
}

static void put_amount(const nh_classified *x, size_t bound, nh_text *out)
{
    bool word = x->of == NH_OF_MEASURE || x->of == NH_OF_HAMILTONIZATION;
    bool rank = x->of == NH_OF_INTEGRABILITY && x->question;
    if (word && bound < 2) nh_text_add(out, bound ? "one" : "none");
    else nh_text_addf(out, "%zu", rank ? x->question->family.unknowns - bound : bound);
}

static void put_beyond(const nh_classified *x, size_t bound, nh_text *out)
{
    bool any = (x->of == NH_OF_MEASURE || x->of == NH_OF_HAMILTONIZATION) && !bound;
    nh_text_add(out, any ? "one" : x->of == NH_OF_INTEGRABILITY ? "less than " : "more than ");
    if (!any) put_amount(x, bound, out);
}

const char *nh_classification_zeros(const nh_classified *x, const nh_special_factor *polynomial)
{
    return x->parameters == 1 ? nh_classified_words(x, polynomial) : nh_classified_equation(x, polynomial);
}

/* "integrals polynomial in the velocities, over eps, with coefficients ..., on the level ..., with k = 2" */
void nh_classification_head(const nh_classified *x, nh_text *out)
{
    const nh_system *system = x->almost_all->question->system;
    nh_text_addf(out, "Classified: %s, over ", WORDS[x->of].subject);
    for (size_t v = x->parameters; v-- > 0;)
        nh_text_addf(out, "%s%s", x->over[v], v > 1 ? ", " : v == 1 ? " and " : "");
    nh_text_add(out, x->shape ? ", with coefficients that do not depend on cyclic coordinates" : "");
    for (size_t i = system->constraints - system->levels; i < system->constraints; i++)
        nh_text_addf(out, "%s%s", i == system->constraints - system->levels ? ", on the level " : ", ",
                     system->constraint[i].text);
    for (size_t i = 0; i < x->fixed; i++) {
        char digits[32];
        nh_text_number(x->other[i].value, digits, sizeof digits);
        nh_text_addf(out, "%s%s = %s", i ? ", " : ", with ", x->other[i].name, digits);
    }
    const char *where = nh_classification_side(x);
    nh_text_addf(out, "%s%s.\n", where ? ", " : "", where ? where : "");
}

/* ---- numbers ---- */

/* Where the integrals for almost all values are known and proved, a larger number means more integrals. */
void nh_classification_almost_all(const nh_classified *x, size_t degree, nh_text *out)
{
    const nh_classify_row *row = &x->classification->row[degree - 1];
    bool all = nh_classification_is_exact(row);
    nh_text_add(out, "  ");
    put_level(x, degree, out);
    nh_text_addf(out, ": %s", all || x->of == NH_OF_INTEGRABILITY ? "" : "at most ");
    put_amount(x, row->number.bound, out);
    nh_text_addf(out, "%s%s\n", x->of == NH_OF_CURRENTS ? " (counting the constant 1)" : "",
                 all                   ? ""
                 : row->number.settled ? "; several orders give the same bound"
                                       : ", perhaps fewer");
}

void nh_classification_numbers(const nh_classified *x, const nh_classified_place *at, nh_text *out)
{
    for (size_t d = at->first; d <= x->classification->rows; d++) {
        const nh_classify_number *n = &at->number[d];
        bool sure = at->finding.exact >= d || x->of == NH_OF_INTEGRABILITY;
        nh_text_add(out, d == at->first ? "" : ", ");
        put_level(x, d, out);
        nh_text_addf(out, ": %s", !n->bounded ? "not counted" : sure ? "" : n->settled ? "up to " : "at most ");
        if (!n->bounded) continue;
        put_amount(x, n->bound, out);
        nh_text_add(out, " instead of ");
        put_amount(x, x->classification->row[d - 1].number.bound, out);
    }
    nh_text_add(out, ".");
}

const char *nh_classification_end(const nh_classified *x, char *room, size_t size)
{
    static const struct {
        const char *end, *words;
    } ENDS[] = {{"work", "the count of integrals takes more work than the option `count_work`"},
                {"staircase", "looking for the values takes more work than the option `staircase`"},
                {"unknowns", "the linear system has more unknowns than the option `pencil`"},
                {"plane", "the determinants are larger than the option `plane`"},
                {"curves", "there are more curves, and the determinants are larger than the option `plane`"},
                {"surfaces", "the special surfaces have too high a degree in the first parameter"}};
    const char *end = x->classification->end;
    if (end && !strcmp(end, "time")) return nh_ended_words(room, size), room;
    for (size_t k = 0; k < sizeof ENDS / sizeof *ENDS && end; k++)
        if (!strcmp(end, ENDS[k].end)) return ENDS[k].words;
    return end;
}

/* ---- what is open ---- */

static void put_degenerate(const nh_classified *x, nh_text *out)
{
    const nh_classification *c = x->classification;
    size_t written = 0;
    for (size_t k = 0; k < c->specials; k++)
        if (c->special[k].degenerate && !x->part[k].finding.why)
            nh_text_addf(out, "%s%s", written++ ? "; " : "Degenerate, and not examined: ",
                         nh_classification_zeros(x, &c->special[k].polynomial));
    if (written) nh_text_add(out, ".\n");
    for (size_t k = 0; k < c->specials; k++)
        if (c->special[k].degenerate && x->part[k].finding.why)
            nh_text_addf(out, "Degenerate: %s (%s).\n", nh_classification_zeros(x, &c->special[k].polynomial),
                         x->part[k].finding.why);
}

static void put_undecided(const nh_classified *x, nh_text *out)
{
    const nh_classification *c = x->classification;
    for (size_t k = 0; k < c->specials; k++) {
        const nh_classify_special *v = &c->special[k];
        if (!v->open || v->degenerate) continue;
        nh_text_addf(out, "Not decided %s %s: ", x->parameters == 1 ? "at" : "on",
                     nh_classification_zeros(x, &v->polynomial));
        put_level(x, v->open, out);
        nh_text_add(out, ", of which there may be ");
        put_beyond(x, c->row[v->open - 1].number.bound, out);
        nh_text_add(out, ". A count with more work may decide it: `--option count_work=N`.\n");
    }
}

static void put_infinity(const nh_classified *x, nh_text *out)
{
    const nh_classification *c = x->classification;
    size_t first = 0;
    for (size_t d = c->rows; d >= 1; d--)
        if (c->row[d - 1].infinite.bounded && c->row[d - 1].infinite.bound > c->row[d - 1].number.bound) first = d;
    if (!c->limit) nh_text_addf(out, "As %s goes to infinity the equations of motion have no limit.\n", x->over[0]);
    else if (!first) nh_text_addf(out, "In the limit of infinite %s: not more.\n", x->over[0]);
    else
        nh_text_addf(out, "In the limit of infinite %s: up to %zu instead of %zu at degree %zu.\n", x->over[0],
                     c->row[first - 1].infinite.bound, c->row[first - 1].number.bound, first);
}

static void put_open(const nh_classified *x, nh_text *out);

/* What is open on a curve, surface or wall: each line with its equation. */
static void put_open_within(const nh_classified *x, const nh_classified_part *part, nh_text *out)
{
    const nh_classification *in = part->within ? part->within->classification : NULL;
    const char *words = nh_classified_equation(x, part->polynomial), *end,
               *what = x->parameters == 3 ? "Curves and points" : "Points";
    if (!in) nh_text_addf(out, "%s on %s were not searched for: %s.\n", what, words, part->finding.why);
    else if (in->obstacle != nh_parametric_constant && in->rows < x->classification->rows)
        nh_text_addf(out, "%s on %s were searched for up to degree %zu only.\n", what, words, in->rows);
    if (!in) return;
    nh_text lines;
    nh_text_init(&lines);
    put_open(part->within, &lines);
    for (const char *at = nh_text_string(&lines); *at; at = end) {
        end = at + strcspn(at, "\n");
        if (*end) end++;
        nh_text_addf(out, "On %s: %c%.*s", words, tolower((unsigned char)*at), (int)(end - at - 1), at + 1);
    }
    nh_text_clear(&lines);
}

static void put_open(const nh_classified *x, nh_text *out)
{
    const nh_classification *c = x->classification;
    put_degenerate(x, out);
    put_undecided(x, out);
    for (size_t k = 0; k < x->parts && x->parameters > 1; k++)
        if (!x->part[k].special || !x->part[k].special->degenerate) put_open_within(x, &x->part[k], out);
    for (size_t k = 0; k < c->walls; k++)
        if (nh_classification_is_unexamined(x, &c->wall[k]))
            nh_text_addf(out, "Not examined, or not up to the highest degree: points with %s.\n",
                         nh_classified_words(x, &c->wall[k].polynomial));
}

void nh_classification_left(const nh_classified *x, nh_text *out)
{
    put_open(x, out);
    if (x->parameters == 1 && !x->question) put_infinity(x, out);
}

/* ---- what is excluded ---- */

/* ", modulo 2147483579, 2147483543)" */
static void put_primes(const nh_classify_row *row, nh_text *out)
{
    nh_text_add(out, ", modulo");
    for (size_t i = 0; i < row->primes; i++) nh_text_addf(out, "%s %" PRIu64, i ? "," : "", row->prime[i]);
    nh_text_add(out, ")\n");
}

/* Of one parameter: the sentence about one degree. */
static void put_excluded(const nh_classified *x, size_t degree, nh_text *out)
{
    const nh_classify_row *row = &x->classification->row[degree - 1];
    bool lifted = row->lifted && row->height >= 1;
    nh_text_add(out, "  ");
    put_level(x, degree, out);
    nh_text_addf(out, ": no %s%s has ", x->places ? "other " : "", x->over[0]);
    put_beyond(x, row->number.bound, out);
    if (row->theorem) nh_text_add(out, " (proved for all numbers, real or complex)");
    else if (lifted)
        nh_text_addf(out, " (proved for all transcendental %s and all fractions with terms up to %.1e)", x->over[0],
                     row->height);
    else
        nh_text_addf(out,
                     " (proved for all transcendental %s; up to %zu algebraic values, here or at a lower degree, "
                     "are known modulo primes only)",
                     x->over[0], row->roots);
    nh_text_add(out, "\n");
    if (!lifted) return;
    if (row->theorem)
        nh_text_addf(
            out, "    (coefficients of special values have at most %.0f bits; others are excluded modulo %zu primes)\n",
            row->bits, row->theorem_primes);
    nh_text_addf(out, "    (%zu unknowns, order %zu", row->unknowns, row->number.order);
    put_primes(row, out);
}

static void put_excluded_values(const nh_classified *x, nh_text *out)
{
    const nh_classification *c = x->classification;
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

/* Of two parameters. */
static void put_excluded_pairs(const nh_classified *x, nh_text *out)
{
    const nh_classification *c = x->classification;
    nh_text_addf(out, "%s:\n", x->places ? "Nowhere else" : "Nowhere more");
    for (size_t d = 1; d <= c->rows; d++) {
        const nh_classify_row *row = &c->row[d - 1];
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
            nh_text_addf(out, "    (%zu unknowns, order %zu, determinants of size %zu", row->unknowns,
                         row->number.order, row->size);
            put_primes(row, out);
        }
    }
    if (c->row[c->rows - 1].swept)
        nh_text_addf(out,
                     "  By lines, pairs in which %s is no such ratio are not examined: determinants are larger than "
                     "the option `plane`.\n",
                     x->over[1]);
    else
        nh_text_add(out,
                    "  Another pair of algebraic numbers can have more only if, modulo each of the primes, it lies on "
                    "one of the curves, has the residues of a point that was examined, or has no residues. Infinite "
                    "values were not examined.\n");
}

/* Of three parameters: the heights of pairs within surfaces and walls. */
static void put_heights_within(const nh_classified *x, nh_text *out)
{
    size_t rows = x->classification->rows, written = 0;
    for (size_t k = 0; k < x->parts; k++) {
        const nh_classification *in = x->part[k].within ? x->part[k].within->classification : NULL;
        if (!in || in->rows < rows || in->row[rows - 1].height < 1) continue;
        nh_text_addf(out,
                     written++ ? "; on %s: %.1e"
                               : "  Where one parameter follows from the others the same "
                                 "holds for pairs of these. On %s: %.1e",
                     nh_classified_equation(x, x->part[k].polynomial), in->row[rows - 1].height);
    }
    if (written) nh_text_add(out, ".\n");
}

static void put_excluded_planes(const nh_classified *x, nh_text *out)
{
    const nh_classification *c = x->classification;
    nh_text_add(out, "Elsewhere:\n");
    for (size_t d = 1; d <= c->rows; d++) {
        const nh_classify_row *row = &c->row[d - 1];
        nh_text_addf(out, "  degree %zu: ", d);
        if (!row->swept || row->height < 1) nh_text_add(out, "no values are excluded by a proof\n");
        else
            nh_text_addf(out,
                         "in %zu planes of constant %s, no other pair of rational numbers %s, %s with numerators "
                         "and denominators up to %.1e has more than %zu\n",
                         row->swept, x->over[2], x->over[1], x->over[0], row->height, row->number.bound);
        nh_text_addf(out, "    (%zu unknowns, order %zu, determinants of size %zu, surfaces from %zu values of %s",
                     row->unknowns, row->number.order, row->size, row->sections, x->over[2]);
        put_primes(row, out);
    }
    nh_text_addf(out,
                 "  These planes are all with numerator and denominator of %s up to %.0f that were not "
                 "classified as a whole (option `planes`).\n",
                 x->over[2], x->almost_all->question->options.planes);
    put_heights_within(x, out);
    nh_text_addf(out,
                 "  Not excluded: single points and curves in planes %s = constant, for other values of %s. "
                 "The sections show, modulo the primes, no other surface and no other curve in another direction; "
                 "this is not proved.\n",
                 x->over[2], x->over[2]);
}

void nh_classification_excluded(const nh_classified *x, nh_text *out)
{
    static void (*const put[])(const nh_classified *, nh_text *) = {put_excluded_values, put_excluded_pairs,
                                                                    put_excluded_planes};
    if (x->classification->rows) put[x->parameters - 1](x, out);
}
