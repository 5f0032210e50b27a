#include "document/absence_words.h"

#include "base/memory.h"
#include "document/absence_parts.h"
#include "document/current_words.h"
#include "document/screen.h"
#include "graph/node.h"
#include "graph/print.h"

typedef struct {
    const nh_analysis *r;
    const nh_absence *a;
    const nh_absence_attempt *best;
    bool brief; /* for a first screen */
    nh_text *out;
} writer;

static const char *plural(size_t n) { return n == 1 ? "" : "s"; }

/* ---- formulas and lists ---- */

static const char *formula(const writer *w, const char *text)
{
    return nh_arena_printf(w->r->arena, NH_ABSENCE_WORDS_FORMULA "%s" NH_ABSENCE_WORDS_END, text);
}

const char *nh_absence_words_plain(nh_arena *arena, const char *marked)
{
    char *text = nh_arena_strdup(arena, marked), *to = text;
    for (const char *c = marked; *c; c++)
        if (*c != NH_ABSENCE_WORDS_FORMULA[0] && *c != NH_ABSENCE_WORDS_END[0]) *to++ = *c;
    *to = 0;
    return text;
}

/* "x, y and z" */
static void put_list(const writer *w, size_t n, const char *const *item, const char *last)
{
    for (size_t i = 0; i < n; i++) nh_text_addf(w->out, "%s%s", !i ? "" : i + 1 < n ? ", " : last, item[i]);
}

/* ---- the letters ---- */

/* "x, y, x', y'"; of a rational class angles by their sines and cosines. */
static void put_letters(const writer *w, bool rational)
{
    const nh_closed_shape *s = w->a->shape;
    const char **name = nh_arena_alloc(w->r->arena, (2 * s->count + 1) * sizeof *name);
    size_t n = 0;
    for (size_t i = 0; i < s->count; i++) {
        const char *letter = nh_name_of(s->model->dag, s->letter[i]);
        bool circle = rational && s->angle[i];
        name[n++] = formula(w, circle ? nh_arena_printf(w->r->arena, "sin(%s)", letter) : letter);
        if (circle) name[n++] = formula(w, nh_arena_printf(w->r->arena, "cos(%s)", letter));
    }
    put_list(w, n, name, ", ");
}

static void put_left_out(const writer *w, const char *last, bool time)
{
    const nh_closed_shape *s = w->a->shape;
    const char **name = nh_arena_alloc(w->r->arena, (s->left + 1) * sizeof *name);
    for (size_t i = 0; i < s->left; i++) name[i] = formula(w, nh_name_of(s->model->dag, s->left_out[i]));
    if (time) name[s->left] = formula(w, "t");
    put_list(w, s->left + time, name, last);
}

/* "the equations of x, y, x', y'" */
static void put_equations(const writer *w)
{
    enum { most_named = 8 };
    const nh_closed_shape *s = w->a->shape;
    if (!w->brief || s->count <= most_named) {
        nh_text_add(w->out, "the equations of ");
        put_letters(w, false);
    } else {
        nh_text_add(w->out, "the equations of motion");
        if (s->left) nh_text_add(w->out, " without "), put_left_out(w, " and ", false);
    }
}

/* ---- the known integrals ---- */

/* "those found", "Phi1 and Phi3"; on a first screen "those above", "quantities 1 and
 * 3": they have numbers there. */
static void put_known(const writer *w)
{
    const char **name;
    size_t n = nh_absence_parts_known(w->r, &name);
    if (n == w->r->list->independent) {
        nh_text_add(w->out, !w->brief ? "those found" : n == 1 ? "the one above" : "those above");
        return;
    }
    for (size_t i = 0; i < n; i++)
        name[i] = w->brief ? nh_arena_printf(w->r->arena, "%zu", w->a->known_current[i] + 1) : formula(w, name[i]);
    if (w->brief) nh_text_add(w->out, n == 1 ? "quantity " : "quantities ");
    put_list(w, n, name, " and ");
}

/* ---- the class of functions ---- */

/* "energy 1/7"; "at the level 1/7 of Phi2" of another integral, which is the first of those used. */
static void put_level(const writer *w, const nh_normal_equation *e)
{
    size_t index = w->a->known_current[e->used[0]];
    const nh_current *current = &w->r->list->found[index];
    char *level = nh_print_string(w->r->question->model->dag, e->level);
    bool energy = nh_current_is_energy(current);
    nh_text_addf(w->out, energy ? "of energy %s" : "at the level %s", level);
    if (!energy && w->a->known > 1) {
        if (w->brief) nh_text_addf(w->out, " of quantity %zu", index + 1);
        else nh_text_addf(w->out, " of %s", formula(w, current->name));
    }
    nh_free(level);
}

/* "the complex motions x = 0 of energy 1/7" */
static void put_motions(const writer *w)
{
    if (w->best) {
        nh_text_addf(w->out, "the complex motions %s ", formula(w, w->best->equation->plane->words));
        put_level(w, w->best->equation);
    } else if (nh_absence_parts_reason_of(w->a) == NH_ABSENCE_BY_DARBOUX)
        nh_text_addf(w->out, "the complex motions on the line along %s", w->a->darboux->refutation.point);
    else nh_text_add(w->out, "some complex motions");
}

static void put_roots(const writer *w)
{
    const char **root;
    size_t n = nh_absence_parts_roots(w->r->arena, w->a->shape, &root);
    for (size_t i = 0; i < n; i++) root[i] = formula(w, root[i]);
    if (!n) return;
    nh_text_add(w->out, w->a->rational ? " and " : "in these and ");
    put_list(w, n, root, " and ");
    if (!w->a->rational) nh_text_addf(w->out, ", where %s not 0, ", n == 1 ? "that is" : "those are");
}

static void put_angles(const writer *w)
{
    const nh_closed_shape *s = w->a->shape;
    const char **name = nh_arena_alloc(w->r->arena, (s->count + 1) * sizeof *name);
    size_t n = 0;
    for (size_t i = 0; i < s->count; i++)
        if (s->angle[i]) name[n++] = formula(w, nh_name_of(s->model->dag, s->letter[i]));
    if (n) put_list(w, n, name, " and ");
    else nh_text_add(w->out, "the angles");
}

/* "meromorphic near the complex motions x = 0 of energy 1/7", "rational in x, y, x', y'" */
static void put_class(const writer *w)
{
    if (w->a->rational) {
        nh_text_add(w->out, "rational in ");
        if (nh_absence_parts_angles(w->a->shape)) put_letters(w, true);
        else nh_text_add(w->out, "these");
        put_roots(w);
        return;
    }
    nh_text_add(w->out, "meromorphic ");
    put_roots(w);
    nh_text_add(w->out, "near ");
    put_motions(w);
    if (!nh_absence_parts_periodic(w->a)) return;
    nh_text_add(w->out, " and 2 pi-periodic in ");
    put_angles(w);
}

/* ---- why ---- */

static const char their_equation[] = "their normal variational equation";

/* Modulo a prime, where one was needed. */
static void put_prime(const writer *w, ulong prime)
{
    if (prime) nh_text_addf(w->out, "; proved modulo %zu", (size_t)prime);
}

static void put_orbit(const writer *w, const char *group)
{
    const nh_absence_attempt *t = w->best;
    nh_text_addf(w->out, "the %s of %s moves a general vector in %zu of %zu dimensions", group, their_equation,
                 t->orbit, t->equation->dimension);
    if (t->equation->blocks > 1) nh_text_addf(w->out, ", taken on its %zu blocks together", t->equation->blocks);
}

/* "the Galois group of their normal variational equation is SL(2); proved modulo 1073742391" */
static void put_reason(const writer *w)
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
    case NH_ABSENCE_BY_DARBOUX:
        nh_text_addf(
            w->out,
            "of Morales-Ruiz and Ramis: the potential is homogeneous of degree %ld, and its second derivatives "
            "have the eigenvalue %s there, at which the motions near by have the Galois group SL(2)",
            d->degree, formula(w, d->refutation.eigenvalue));
        break;
    case NH_ABSENCE_BY_NOTHING:
        if (t) put_orbit(w, "Galois group");
        break;
    }
}

static void put_short_reason(const writer *w)
{
    static const char *const words[] = {"Galois group SL(2)",    "a block with the Galois group SL(2)",
                                        "Galois group",          "a residue is not rational",
                                        "an irregular point",    "monodromy, in balls",
                                        "homogeneous potential", "normal variational equation"};
    nh_text_add(w->out, words[nh_absence_parts_reason_of(w->a)]);
}

static void put_evidence(const writer *w)
{
    bool generic = w->a->generic && w->r->question->system->parameters;
    nh_text_add(w->out,
                nh_absence_parts_reason_of(w->a) == NH_ABSENCE_BY_DARBOUX && !w->brief ? " (theorem " : " (theorem; ");
    if (w->brief) put_short_reason(w);
    else put_reason(w);
    if (generic)
        nh_text_add(w->out, w->brief ? "; so too for all parameters outside countably many hypersurfaces"
                                     : "; so too for all values of the parameters outside countably many "
                                       "hypersurfaces");
    nh_text_add(w->out, ")");
}

/* ---- the statement ---- */

static void put_every(const writer *w)
{
    bool dependent = w->a->verdict == NH_ABSENCE_DEPENDENT;
    nh_text_add(w->out, "No other integral: every first integral of ");
    put_equations(w);
    nh_text_add(w->out, " that is ");
    put_class(w);
    if (!w->a->known) nh_text_add(w->out, " is constant");
    else nh_text_add(w->out, dependent ? " depends on " : " is a function of "), put_known(w);
    put_evidence(w);
    nh_text_add(w->out, ".");
}

static void put_at_most(const writer *w)
{
    const nh_absence *a = w->a;
    nh_text_addf(w->out, "At most %zu independent first integral%s of ", a->at_most, plural(a->at_most));
    put_equations(w);
    nh_text_add(w->out, a->at_most == 1 ? " is " : " are ");
    put_class(w);
    put_evidence(w);
    if (!a->known || a->known > a->at_most) { /* more are known, some of them of another class */
        nh_text_add(w->out, a->known ? "." : "; none is known.");
        return;
    }
    nh_text_addf(w->out, "; %zu %s known", a->known, a->known == 1 ? "is" : "are");
    if (a->known < w->r->list->independent) nh_text_add(w->out, ": "), put_known(w);
    nh_text_add(w->out, ".");
}

static void put_liouville(const writer *w)
{
    nh_text_add(w->out, "Not integrable in the sense of Liouville: ");
    put_equations(w);
    nh_text_add(w->out, " do not have as many independent first integrals in involution as degrees of freedom, all of "
                        "them ");
    put_class(w);
    put_evidence(w);
    nh_text_add(w->out, ".");
}

static void put_open(const writer *w)
{
    nh_text_add(w->out, "Not decided whether there is any other integral");
    if (w->a->obstacle) nh_text_addf(w->out, ": %s", w->a->obstacle);
    nh_text_add(w->out, w->brief ? "." : ". Nothing is excluded by this, and nothing is found.");
}

static void put_statement(const writer *w)
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
static void put_also_excluded(const writer *w)
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
static void put_not_excluded(const writer *w)
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
    nh_text_add(w->out, w->brief ? "ones that contain " : "and integrals that contain ");
    put_left_out(w, " or ", true);
    nh_text_add(w->out, ".");
}

static void put_unused(const writer *w)
{
    size_t n = w->a->many_valued;
    if (n)
        nh_text_addf(w->out,
                     "%zu of those found %s many-valued near these motions, or contain%s t: %s not of this class.", n,
                     n == 1 ? "is" : "are", n == 1 ? "s" : "", n == 1 ? "it is" : "they are");
}

/* ---- states of rest ---- */

/* A state where the equations of the letters rest is a steady motion of the system where others are left out. */
static void put_rest(const writer *w, const nh_resonance *e)
{
    bool few = e->at_most + 1 < e->letters;
    if (few) {
        nh_text_addf(w->out, "Near %s, where ", formula(w, e->point));
        put_equations(w);
        if (e->at_most)
            nh_text_addf(w->out, " rest, at most %zu independent first integral%s of theirs %s", e->at_most,
                         plural(e->at_most), e->at_most == 1 ? "is" : "are");
        else nh_text_add(w->out, " rest, of their first integrals only constants are");
        nh_text_addf(w->out,
                     " real-analytic, or %s of real-analytic functions (theorem; the eigenvalues there span at least "
                     "%zu dimension%s over the rational numbers%s",
                     e->at_most == 1 ? "a quotient" : "quotients", e->span, plural(e->span),
                     e->diagonalizable ? "" : ", and the linear equations cannot be diagonalized");
        put_prime(w, e->prime);
        nh_text_add(w->out, ").");
    }
    if (e->divergence)
        nh_text_addf(w->out, "%sNo measure with a positive density of class C^1 is preserved near %s.", few ? " " : "",
                     formula(w, e->point));
}

/* ---- all sentences ---- */

static void keep(const writer *w, nh_absence_words *all)
{
    if (w->out->length) all->sentence[all->count++] = nh_arena_strdup(w->r->arena, nh_text_string(w->out));
    nh_text_clear(w->out);
}

nh_absence_words nh_absence_words_of(const nh_analysis *r)
{
    enum { others = 4 };
    nh_absence_words all = {0};
    const nh_absence *a = r->absence;
    if (!a) return all;
    nh_text text;
    nh_text_init(&text);
    writer w = {.r = r, .a = a, .best = nh_absence_parts_best(a), .out = &text};
    all.sentence = nh_arena_alloc(r->arena, (a->resonances + others) * sizeof *all.sentence);
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
    for (size_t i = 0; i < a->resonances; i++) put_rest(&w, a->resonance[i]), keep(&w, &all);
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

/* The state of rest that leaves the fewest; NULL: none leaves few. */
static const nh_resonance *best_rest(const nh_absence *a)
{
    const nh_resonance *best = NULL;
    for (size_t i = 0; i < a->resonances; i++)
        if (a->resonance[i]->at_most + 1 < a->resonance[i]->letters &&
            (!best || a->resonance[i]->at_most < best->at_most))
            best = a->resonance[i];
    return best;
}

/* What is left out first where room is short: the other values of parameters, then what is not excluded but for the
 * letters that are left out. */
static const char *short_words(const nh_analysis *r, bool generic, bool exceptions)
{
    nh_absence a = *r->absence;
    a.generic &= generic;
    nh_text text;
    nh_text_init(&text);
    writer w = {.r = r, .a = &a, .best = nh_absence_parts_best(&a), .brief = true, .out = &text};
    put_statement(&w);
    if (nh_absence_parts_excludes(&a) && exceptions) nh_text_add(&text, " "), put_not_excluded(&w);
    else if (nh_absence_parts_excludes(&a)) {
        nh_text_add(&text, " Not excluded: ones that contain ");
        put_left_out(&w, " or ", true);
        nh_text_add(&text, ", and others (--details).");
    }
    const char *words = nh_absence_words_plain(r->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return words;
}

static const char *rest_words(const nh_analysis *r, const nh_resonance *rest)
{
    nh_text text;
    nh_text_init(&text);
    writer w = {.r = r, .a = r->absence, .brief = true, .out = &text};
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
    if (!a->contradiction && a->verdict == NH_ABSENCE_OPEN && rest) return rest_words(r, rest);
    if (!a->contradiction && a->verdict == NH_ABSENCE_OPEN && !a->everything) return NULL;
    const char *words = short_words(r, true, true);
    if (lines_of(words) > lines) words = short_words(r, false, true);
    if (lines_of(words) > lines) words = short_words(r, false, false);
    return words;
}
