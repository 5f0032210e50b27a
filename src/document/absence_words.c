#include "document/absence_words.h"

#include "base/memory.h"
#include "document/absence_parts.h"
#include "document/absence_words_internal.h"
#include "document/screen.h"
#include "graph/node.h"
#include "graph/print.h"

static const char *plural(size_t n) { return n == 1 ? "" : "s"; }

const char *nh_absence_words_plain(nh_arena *arena, const char *marked)
{
    char *text = nh_arena_strdup(arena, marked), *to = text;
    for (const char *c = marked; *c; c++)
        if (*c != NH_ABSENCE_WORDS_FORMULA[0] && *c != NH_ABSENCE_WORDS_END[0]) *to++ = *c;
    *to = 0;
    return text;
}

/* ---- why ---- */

static const char their_equation[] = "their normal variational equation";

/* Modulo a prime, where one was needed. */
static void put_prime(const nh_absence_writer *w, ulong prime)
{
    if (prime) nh_text_addf(w->out, "; proved modulo %zu", (size_t)prime);
}

static void put_orbit(const nh_absence_writer *w, const char *group)
{
    const nh_absence_attempt *t = w->best;
    nh_text_addf(w->out, "the %s of %s moves a general vector in %zu of %zu dimensions", group, their_equation,
                 t->orbit, t->equation->dimension);
    if (t->equation->blocks > 1) nh_text_addf(w->out, ", taken on its %zu blocks together", t->equation->blocks);
}

/* "the Galois group of their normal variational equation is SL(2); proved modulo 1073742391" */
static void put_reason(const nh_absence_writer *w)
{
    const nh_absence_attempt *t = w->best;
    const nh_darboux *d = w->a->darboux;
    switch (nh_absence_parts_reason_of(w->a)) {
    case NH_ABSENCE_BY_GROUP:
        nh_text_addf(w->out, "the Galois group of %s is SL(2)", their_equation);
        put_prime(w, t->kovacic->prime);
        break;
    case NH_ABSENCE_BY_BLOCK:
        nh_text_addf(w->out, "a block of %s has the Galois group SL(2)", their_equation);
        put_prime(w, t->kovacic->prime);
        break;
    case NH_ABSENCE_BY_TRIANGULAR:
        nh_text_addf(w->out, "the Galois group of %s is SL(2) or triangular, of dimension 2", their_equation);
        put_prime(w, t->kovacic->prime);
        break;
    case NH_ABSENCE_BY_RESIDUE:
        nh_text_addf(w->out,
                     "loops multiply the solutions of %s, which is of first order, by numbers that are no "
                     "roots of unity: a residue is not rational",
                     their_equation);
        break;
    case NH_ABSENCE_BY_IRREGULAR:
        nh_text_addf(w->out, "the solutions of %s, which is of first order, are not algebraic", their_equation);
        break;
    case NH_ABSENCE_BY_MONODROMY:
        put_orbit(w, "monodromy");
        nh_text_addf(w->out, "; proved in balls of %ld bits", t->monodromy->bits);
        break;
    case NH_ABSENCE_BY_LOGARITHM:
        nh_text_addf(w->out, "the variational equation of order %u along them has a logarithm at their pole, and ",
                     t->higher->order);
        nh_text_add(w->out, "the group of the first one is connected");
        put_prime(w, t->higher->prime);
        break;
    case NH_ABSENCE_BY_DARBOUX:
        nh_text_addf(
            w->out,
            "of Morales-Ruiz and Ramis: the potential is homogeneous of degree %ld, and its second derivatives "
            "have the eigenvalue %s there, at which the motions near by have the Galois group SL(2)",
            d->degree, nh_absence_words_formula(w, d->refutation.eigenvalue));
        break;
    case NH_ABSENCE_BY_NOTHING:
        if (t) put_orbit(w, "Galois group");
        break;
    }
}

static void put_evidence(const nh_absence_writer *w)
{
    bool generic = w->a->generic && w->r->question->system->parameters;
    nh_text_add(w->out,
                nh_absence_parts_reason_of(w->a) == NH_ABSENCE_BY_DARBOUX && !w->brief ? " (theorem " : " (theorem; ");
    if (w->brief) nh_text_add(w->out, nh_absence_parts_short(nh_absence_parts_reason_of(w->a)));
    else put_reason(w);
    if (generic)
        nh_text_add(w->out, w->brief ? "; so too for all parameters outside countably many hypersurfaces"
                                     : "; so too for all values of the parameters outside countably many "
                                       "hypersurfaces");
    nh_text_add(w->out, ")");
}

/* ---- the statement ---- */

static void put_every(const nh_absence_writer *w)
{
    bool dependent = w->a->verdict == NH_ABSENCE_DEPENDENT;
    nh_text_add(w->out, "No other integral: every first integral of ");
    nh_absence_words_put_equations(w);
    nh_text_add(w->out, " that is ");
    nh_absence_words_put_class(w);
    if (!w->a->known) nh_text_add(w->out, " is constant");
    else nh_text_add(w->out, dependent ? " depends on " : " is a function of "), nh_absence_words_put_known(w);
    put_evidence(w);
    nh_text_add(w->out, ".");
}

static void put_at_most(const nh_absence_writer *w)
{
    const nh_absence *a = w->a;
    nh_text_addf(w->out, "At most %zu independent first integral%s of ", a->at_most, plural(a->at_most));
    nh_absence_words_put_equations(w);
    nh_text_add(w->out, a->at_most == 1 ? " is " : " are ");
    nh_absence_words_put_class(w);
    put_evidence(w);
    if (!a->known || a->known > a->at_most) { /* more are known, some of them of another class */
        nh_text_add(w->out, a->known ? "." : "; none is known.");
        return;
    }
    nh_text_addf(w->out, "; %zu %s known", a->known, a->known == 1 ? "is" : "are");
    if (a->known < w->r->list->independent) nh_text_add(w->out, ": "), nh_absence_words_put_known(w);
    nh_text_add(w->out, ".");
}

static void put_liouville(const nh_absence_writer *w)
{
    nh_text_addf(w->out, "Not integrable in the sense of Liouville%s", w->brief ? " by first integrals of " : ": ");
    nh_absence_words_put_equations(w);
    if (w->brief) nh_text_add(w->out, " that are ");
    else
        nh_text_add(w->out,
                    " do not have as many independent first integrals in involution as degrees of freedom, all of "
                    "them ");
    nh_absence_words_put_class(w);
    put_evidence(w);
    nh_text_add(w->out, ".");
}

static void put_open(const nh_absence_writer *w)
{
    nh_text_add(w->out, "Not decided whether there is any other integral");
    if (w->a->obstacle) nh_text_addf(w->out, ": %s", w->a->obstacle);
    nh_text_add(w->out, w->brief ? "." : ". Nothing is excluded by this, and nothing is found.");
}

static void put_statement(const nh_absence_writer *w)
{
    if (w->a->contradiction) {
        nh_text_addf(w->out,
                     "An error of this program: %s. So nothing is said of other integrals. Please report it with the "
                     "system file and the JSON of this analysis.",
                     w->a->contradiction);
        return;
    }
    switch (w->a->verdict) {
    case NH_ABSENCE_NONE_ELSE:
    case NH_ABSENCE_DEPENDENT: put_every(w); break;
    case NH_ABSENCE_AT_MOST: put_at_most(w); break;
    case NH_ABSENCE_LIOUVILLE: put_liouville(w); break;
    case NH_ABSENCE_OPEN: put_open(w); break;
    case NH_ABSENCE_SETTLED: nh_text_add(w->out, "As many integrals are known as there can be."); break;
    }
}

/* Ziglin's lemma sees through finite coverings, and SL(2), its own commutator group, through abelian ones. */
static void put_also_excluded(const nh_absence_writer *w)
{
    const nh_absence *a = w->a;
    bool turns = nh_absence_parts_angles(a->shape) && !nh_absence_parts_periodic(a);
    if (a->verdict == NH_ABSENCE_LIOUVILLE) return;
    if (a->verdict == NH_ABSENCE_AT_MOST)
        nh_text_addf(w->out, "So too where %s are counted.",
                     a->rational ? "algebraic ones" : "finitely many-valued ones");
    else if (a->rational) nh_text_add(w->out, "Also excluded: algebraic ones.");
    else
        nh_text_addf(w->out, "Also excluded: finitely many-valued ones%s.",
                     turns ? ", and ones that are not periodic in the angles" : "");
}

/* What the theorem leaves open, with the letters that it does not know. */
static void put_not_excluded(const nh_absence_writer *w)
{
    const nh_absence *a = w->a;
    nh_text_add(w->out, "Not excluded: ");
    if (a->verdict == NH_ABSENCE_LIOUVILLE) nh_text_add(w->out, "a further integral alone, ");
    if (a->rational)
        nh_text_add(w->out, w->brief ? "ones that are not rational, " : "integrals that are not rational, ");
    else if (w->brief) nh_text_add(w->out, "ones with other singularities there, smooth ones, ");
    else
        nh_text_add(w->out, "integrals with other singularities on these complex motions (logarithms, irrational "
                            "powers; real-analytic ones may have them), smooth ones, ");
    if (!w->brief && nh_absence_parts_periodic(a)) nh_text_add(w->out, "ones that are not periodic in the angles, ");
    nh_text_add(w->out, w->brief ? "ones with " : "and integrals that contain ");
    nh_absence_words_put_left_out(w, " or ", true);
    nh_text_add(w->out, ".");
}

static void put_unused(const nh_absence_writer *w)
{
    size_t n = w->a->many_valued;
    if (n)
        nh_text_addf(w->out,
                     "%zu of those found %s many-valued near these motions, or contain%s t: %s not of this class.", n,
                     n == 1 ? "is" : "are", n == 1 ? "s" : "", n == 1 ? "it is" : "they are");
}

/* ---- states of rest ---- */

static bool leaves_few(const nh_resonance *e) { return e->at_most + 1 < e->letters; }

static void put_rest(const nh_absence_writer *w, const nh_resonance *e)
{
    const char *what = e->steady ? "the steady motion" : "the state of rest";
    if (leaves_few(e)) {
        nh_text_addf(w->out, "Near %s %s ", what, nh_absence_words_formula(w, e->point));
        if (e->at_most)
            nh_text_addf(w->out, "at most %zu independent first integral%s of ", e->at_most, plural(e->at_most));
        else nh_text_add(w->out, "only constants among the first integrals of ");
        nh_absence_words_put_equations(w);
        nh_text_addf(w->out,
                     " %s real-analytic, or %s of real-analytic functions (theorem; the eigenvalues there "
                     "span at least %zu dimension%s over the rational numbers%s",
                     e->at_most == 1 ? "is" : "are", e->at_most == 1 ? "a quotient" : "quotients", e->span,
                     plural(e->span), e->diagonalizable ? "" : ", and the linear equations cannot be diagonalized");
        put_prime(w, e->prime);
        nh_text_add(w->out, ").");
    }
    if (e->divergence)
        nh_text_addf(w->out, "%sNo measure with a positive density of class C^1 is preserved near %s %s.",
                     leaves_few(e) ? " " : "", what, nh_absence_words_formula(w, e->point));
}

/* The state that leaves the fewest, the first of these; NULL: none leaves few. */
static const nh_resonance *best_rest(const nh_absence *a)
{
    const nh_resonance *best = NULL;
    for (size_t i = 0; i < a->resonances; i++)
        if (leaves_few(a->resonance[i]) && (!best || a->resonance[i]->at_most < best->at_most)) best = a->resonance[i];
    return best;
}

/* The best bound, and the first state near which no measure is preserved; a table has the others. */
static void put_rests(const nh_absence_writer *w)
{
    const nh_absence *a = w->a;
    const nh_resonance *best = best_rest(a), *diverges = NULL;
    for (size_t i = a->resonances; i-- > 0;)
        if (a->resonance[i]->divergence) diverges = a->resonance[i];
    if (best && best->divergence) diverges = best;
    if (best) put_rest(w, best);
    if (!diverges || diverges == best) return;
    nh_resonance alone = *diverges;
    alone.at_most = alone.letters; /* said of the best */
    nh_text_add(w->out, best ? " " : "");
    put_rest(w, &alone);
}

/* ---- all sentences ---- */

static void keep(const nh_absence_writer *w, nh_absence_words *all)
{
    if (w->out->length) all->sentence[all->count++] = nh_arena_strdup(w->r->arena, nh_text_string(w->out));
    nh_text_clear(w->out);
}

nh_absence_words nh_absence_words_of(const nh_analysis *r)
{
    enum { most_sentences = 5 };
    nh_absence_words all = {0};
    const nh_absence *a = r->absence;
    if (!a) return all;
    nh_text text;
    nh_text_init(&text);
    nh_absence_writer w = {.r = r, .a = a, .best = nh_absence_parts_best(a), .out = &text};
    all.sentence = nh_arena_alloc(r->arena, most_sentences * sizeof *all.sentence);
    put_statement(&w);
    keep(&w, &all);
    if (a->contradiction) return all;
    if (nh_absence_parts_excludes(a)) {
        put_also_excluded(&w);
        keep(&w, &all);
        put_not_excluded(&w);
        keep(&w, &all);
        all.not_excluded = all.sentence[all.count - 1];
        put_unused(&w);
        keep(&w, &all);
    }
    put_rests(&w);
    keep(&w, &all);
    return all;
}

const char *nh_absence_words_sentence(const nh_analysis *r)
{
    nh_absence_words all = nh_absence_words_of(r);
    const char *text = NULL;
    for (size_t i = 0; i < all.count; i++)
        text = nh_arena_printf(r->arena, "%s%s%s", text ? text : "", text ? " " : "", all.sentence[i]);
    return text ? nh_absence_words_plain(r->arena, text) : NULL;
}

/* ---- a first screen ---- */

static size_t lines_of(const char *words)
{
    nh_text block;
    nh_text_init(&block);
    nh_screen_paragraph(0, 0, words, &block);
    size_t n = nh_screen_count(nh_text_string(&block));
    nh_text_clear(&block);
    return n;
}

/* What is left out where room is short, more and more: the other values of parameters; what is not excluded, but for
 * the letters that are left out; the letters of the equations, of which those left out then are told. */
enum { all_words, for_these_values, few_exceptions, unnamed_letters };

static const char *short_words(const nh_analysis *r, int short_of)
{
    nh_absence a = *r->absence;
    a.generic &= short_of < for_these_values;
    nh_text text;
    nh_text_init(&text);
    nh_absence_writer w = {.r = r,
                           .a = &a,
                           .best = nh_absence_parts_best(&a),
                           .brief = true,
                           .unnamed = short_of >= unnamed_letters,
                           .out = &text};
    put_statement(&w);
    bool excludes = nh_absence_parts_excludes(&a);
    if (excludes && a.many_valued)
        nh_text_addf(&text, " %zu of those above %s many-valued there.", a.many_valued,
                     a.many_valued == 1 ? "is" : "are");
    if (excludes && short_of < few_exceptions) nh_text_add(&text, " "), put_not_excluded(&w);
    else if (excludes && w.unnamed) nh_text_add(&text, " Other kinds are not excluded (--details).");
    else if (excludes) {
        nh_text_add(&text, " Not excluded: ones with ");
        nh_absence_words_put_left_out(&w, " or ", true);
        nh_text_add(&text, ", others (--details).");
    }
    const char *words = nh_absence_words_plain(r->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return words;
}

static const char *rest_words(const nh_analysis *r, const nh_resonance *rest)
{
    nh_text text;
    nh_text_init(&text);
    nh_absence_writer w = {.r = r, .a = r->absence, .brief = true, .out = &text};
    nh_resonance one = *rest;
    one.divergence = false;
    put_rest(&w, &one);
    const char *words = nh_absence_words_plain(r->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return words;
}

const char *nh_absence_words_short(const nh_analysis *r, size_t lines)
{
    const nh_absence *a = r->absence;
    const nh_resonance *rest = a && !a->contradiction ? best_rest(a) : NULL;
    if (!a || (!a->contradiction && a->verdict == NH_ABSENCE_SETTLED)) return NULL;
    if (rest && rest->at_most > a->known && !a->everything) rest = NULL; /* others may exist near it */
    bool open = !a->contradiction && a->verdict == NH_ABSENCE_OPEN;
    if (open && rest && a->everything)
        return nh_arena_printf(r->arena, "%s %s", short_words(r, all_words), rest_words(r, rest));
    if (open && rest) return rest_words(r, rest);
    if (open && !a->everything) return NULL;
    const char *words = short_words(r, all_words);
    for (int i = for_these_values; i <= unnamed_letters && lines_of(words) > lines; i++) words = short_words(r, i);
    return words;
}

/* Behind "Only the energy is conserved, as far as was looked". */
const char *nh_absence_words_headline(const nh_analysis *r)
{
    const nh_absence *a = r->absence;
    bool none_else = a && !a->contradiction && a->verdict == NH_ABSENCE_NONE_ELSE && !a->rational && !a->many_valued;
    return none_else ? " and by a theorem" : "";
}
