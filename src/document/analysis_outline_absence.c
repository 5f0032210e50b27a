/* Other integrals: what is excluded, by which motions, and what a reader needs to repeat the proof. */
#include <string.h>

#include "base/memory.h"
#include "document/absence_parts.h"
#include "document/absence_words.h"
#include "document/analysis_internal.h"
#include "graph/node.h"
#include "graph/print.h"

/* Equations such as "x = 0, y = 0", one after the other. */
static void put_formulas(nh_pen *p, nh_arena *arena, const char *text)
{
    for (const char *at = text; *at;) {
        const char *end = strstr(at, ", ");
        size_t length = end ? (size_t)(end - at) : strlen(at);
        nh_pen_say(p, at == text ? "<%s>" : ", <%s>", nh_arena_strndup(arena, at, length));
        at += length + (end ? strlen(", ") : 0);
    }
}

/* A sentence of absence_words.h with its formulas. */
static void put_marked(nh_pen *p, nh_arena *arena, const char *sentence)
{
    for (const char *at = sentence; *at;) {
        bool formula = *at == NH_ABSENCE_WORDS_FORMULA[0];
        at += formula;
        size_t length = strcspn(at, formula ? NH_ABSENCE_WORDS_END : NH_ABSENCE_WORDS_FORMULA);
        const char *part = nh_arena_strndup(arena, at, length);
        if (formula) put_formulas(p, arena, part);
        else nh_pen_say(p, "%s", part);
        at += length + (formula && at[length]);
    }
}

static void put_paragraph(nh_pen *p, nh_arena *arena, const char *sentence)
{
    nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
    put_marked(p, arena, sentence);
    nh_pen_close(p, NH_PEN_WORDS);
}

bool nh_analysis_has_absence(const nh_analysis *r)
{
    const nh_absence *a = r->absence;
    return a && (a->contradiction || a->verdict != NH_ABSENCE_SETTLED || a->resonances);
}

void nh_analysis_write_absence_statement(nh_pen *p, const nh_analysis *r)
{
    const nh_absence *a = r->absence;
    nh_absence_words words = nh_absence_words_of(r);
    if (!words.count || (!a->contradiction && (a->verdict == NH_ABSENCE_OPEN || a->verdict == NH_ABSENCE_SETTLED)))
        return;
    if (a->contradiction) {
        nh_pen_warning(p, nh_absence_words_plain(r->arena, words.sentence[0]));
        return;
    }
    put_paragraph(p, r->arena, words.sentence[0]);
    if (words.not_excluded) put_paragraph(p, r->arena, words.not_excluded);
}

/* ---- the motions that were tried ---- */

/* A coefficient of an equation, in parentheses where it is a sum. */
static bool is_none(const char *coefficient) { return !strcmp(coefficient, "0"); }

static const char *factor(nh_arena *arena, const char *coefficient)
{
    bool sum = strpbrk(coefficient + (*coefficient == '-'), "+-") || *coefficient == '-';
    return nh_arena_printf(arena, sum ? "(%s)" : "%s", coefficient);
}

/* "x^2 - 2" of FLINT's "x^2-2", so that lines can be broken. */
static const char *spaced(nh_arena *arena, const char *polynomial)
{
    nh_text text;
    nh_text_init(&text);
    for (const char *c = polynomial; *c; c++) {
        bool sign = (*c == '+' || *c == '-') && c > polynomial && c[-1] != ' ' && c[-1] != '(' && c[-1] != '^';
        nh_text_addf(&text, sign ? " %c " : "%c", *c);
    }
    const char *out = nh_arena_strdup(arena, nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

static const char *equation_text(nh_arena *arena, const nh_absence_attempt *t)
{
    const char *text = "u_xx"; /* dots would be derivatives by time */
    if (!t->p || !t->q) return NULL;
    if (!is_none(t->p)) text = nh_arena_printf(arena, "%s + %s*u_x", text, factor(arena, t->p));
    if (!is_none(t->q)) text = nh_arena_printf(arena, "%s + %s*u", text, factor(arena, t->q));
    return nh_arena_printf(arena, "%s = 0", text);
}

/* "2", "4 in 2 blocks": how many equations of first order. */
static void size_cell(nh_pen *p, const nh_normal_equation *e)
{
    nh_pen_open(p, NH_PEN_CELL, NULL, NULL);
    if (e->obstacle) nh_pen_say(p, "none: %s", e->obstacle);
    else nh_pen_say(p, "%zu", e->dimension);
    if (!e->obstacle && e->blocks > 1)
        nh_pen_say(p, " in %zu blocks%s", e->blocks, e->triangular ? ", triangular" : "");
    nh_pen_close(p, NH_PEN_CELL);
}

/* What the second engine says beside the first. */
static const char *balls(nh_arena *arena, const nh_absence_attempt *t)
{
    const nh_monodromy *m = t->monodromy;
    if (!m || !t->kovacic) return "";
    return nh_arena_printf(arena, " (monodromy, in balls: moves in %zu of %zu)", m->rank, m->size);
}

static void attempt_row(nh_pen *p, const nh_analysis *r, const nh_absence_attempt *t)
{
    const nh_normal_equation *e = t->equation;
    char *level = nh_print_string(r->question->model->dag, e->level);
    nh_pen_open(p, NH_PEN_ROW, NULL, NULL);
    nh_pen_open(p, NH_PEN_ROW_HEAD, NULL, NULL);
    put_formulas(p, r->arena, e->plane->words);
    nh_pen_close(p, NH_PEN_ROW_HEAD);
    nh_pen_cell(p, NH_PEN_CELL, "<%s>", level);
    if (e->curve) nh_pen_cell(p, NH_PEN_CELL, "<%s>", e->curve);
    else nh_pen_cell(p, NH_PEN_CELL, "%s", "");
    size_cell(p, e);
    nh_pen_cell(p, NH_PEN_CELL, "%s%s%s%s", nh_absence_parts_group(r->arena, t), balls(r->arena, t),
                t->obstacle ? ": " : "", t->obstacle ? t->obstacle : "");
    nh_pen_close(p, NH_PEN_ROW);
    nh_free(level);
}

/* The same on a terminal, where a table would be too wide. */
static void attempt_fact(nh_pen *p, const nh_analysis *r, const nh_absence_attempt *t)
{
    const nh_normal_equation *e = t->equation;
    char *level = nh_print_string(r->question->model->dag, e->level);
    nh_pen_fact_begin(p, nh_arena_printf(r->arena, "%s, level %s", e->plane->words, level));
    if (e->curve) nh_pen_say(p, "%s; ", e->curve);
    if (e->obstacle) nh_pen_say(p, "no normal equation: %s", e->obstacle);
    else nh_pen_say(p, "normal equation of size %zu", e->dimension);
    if (!e->obstacle && e->blocks > 1)
        nh_pen_say(p, " in %zu blocks%s", e->blocks, e->triangular ? ", triangular" : "");
    if (!e->obstacle) nh_pen_say(p, "; group: %s%s", nh_absence_parts_group(r->arena, t), balls(r->arena, t));
    if (t->obstacle) nh_pen_say(p, ", %s", t->obstacle);
    nh_pen_close(p, NH_PEN_FACT);
    nh_free(level);
}

static void motions(nh_pen *p, const nh_analysis *r)
{
    const nh_absence *a = r->absence;
    if (!a->attempts) return;
    if (p->ink->brief) {
        nh_pen_heading(p, "Motions that were tried");
        nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
        for (size_t i = 0; i < a->attempts; i++) attempt_fact(p, r, &a->attempt[i]);
        nh_pen_close(p, NH_PEN_FACTS);
        return;
    }
    nh_pen_table(p, "Motions that were tried, and the normal variational equations along them",
                 "plane|level|motion|equations|group");
    for (size_t i = 0; i < a->attempts; i++) attempt_row(p, r, &a->attempt[i]);
    nh_pen_table_end(p);
}

static const char *plural(size_t n) { return n == 1 ? "" : "s"; }

/* ---- certificates ---- */

static void equation_facts(nh_pen *p, nh_arena *arena, const nh_absence_attempt *t)
{
    const char *text = equation_text(arena, t);
    if (!text) return;
    nh_pen_fact_begin(p, "Normal variational equation");
    nh_pen_say(p, "<%s>, derivatives by <%s>", text, "x");
    if (t->equation->variable && strcmp(t->equation->variable, "x") != 0)
        nh_pen_say(p, ", where <%s> stands for <%s>", "x", t->equation->variable);
    nh_pen_close(p, NH_PEN_FACT);
}

static void residue_list(nh_pen *p, size_t n, const ulong *value)
{
    for (size_t i = 0; i < n; i++) nh_pen_say(p, i ? ", %zu" : "%zu", (size_t)value[i]);
}

static void invariants(nh_pen *p, const nh_kovacic *k)
{
    nh_pen_fact_begin(p, "Invariants");
    for (size_t i = 0; i < NH_KOVACIC_INVARIANTS; i++) {
        const nh_kovacic_invariant *v = &k->invariant[i];
        nh_pen_say(p, i ? "; of degree %zu: " : "of degree %zu: ", (size_t)v->m);
        if (v->possible && v->solutions < 0) nh_pen_say(p, "not needed");
        else if (v->possible) nh_pen_say(p, "none with P of degree up to %ld", (long)v->degree);
        else nh_pen_say(p, "the exponents allow none");
    }
    nh_pen_close(p, NH_PEN_FACT);
}

static void kovacic_facts(nh_pen *p, nh_arena *arena, const nh_absence_attempt *t)
{
    const nh_kovacic *k = t->kovacic;
    nh_pen_heading(p, k->group == NH_GROUP_SL2 ? "Why the group is SL(2)"
                                               : "Why the group is SL(2) or triangular, of dimension 2");
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    equation_facts(p, arena, t);
    nh_pen_fact_begin(p, "Normal form");
    nh_pen_say(p, "<%s>, <%s>", "u_xx = r*u",
               nh_arena_printf(arena, "r = (%s)/(%s)", spaced(arena, k->r_num), spaced(arena, k->r_den)));
    nh_pen_close(p, NH_PEN_FACT);
    nh_pen_fact(p, "Singular points", "%s, infinity included", k->regular ? "all regular" : "some irregular");
    if (k->prime) nh_pen_fact(p, "Prime", "%zu", (size_t)k->prime);
    if (k->pole && k->poles) {
        nh_pen_fact_begin(p, "Poles");
        nh_pen_say(p, "modulo the prime ");
        residue_list(p, k->poles, k->pole);
        nh_pen_close(p, NH_PEN_FACT);
    }
    nh_pen_fact_begin(p, "Exponents");
    nh_pen_say(p, "differences at the poles, then at infinity: ");
    for (size_t i = 0; i <= k->poles; i++) nh_pen_say(p, i ? ", %s" : "%s", k->exponent[i]);
    nh_pen_close(p, NH_PEN_FACT);
    nh_pen_fact_begin(p, "Invariant lines");
    if (!k->degrees) nh_pen_say(p, "the exponents allow none");
    for (size_t i = 0; i < k->degrees; i++)
        nh_pen_say(p, i ? ", %ld" : "none with P of degree up to %ld", (long)k->degree_of_p[i]);
    if (k->degrees) nh_pen_say(p, " (%zu choices of signs)", k->sign_vectors);
    nh_pen_close(p, NH_PEN_FACT);
    invariants(p, k);
    nh_pen_close(p, NH_PEN_FACTS);
}

static void monodromy_facts(nh_pen *p, const nh_normal_equation *e, const nh_monodromy *m)
{
    nh_pen_heading(p, "How far the monodromy moves");
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    nh_pen_fact(p, "Orbit", "at least %zu of %zu dimensions", m->rank, m->size);
    nh_pen_fact(p, "Balls", "of %ld bits", m->bits);
    nh_pen_fact(p, "Paths", "around %zu singular points, %zu Taylor steps, %zu elements of the Lie algebra",
                m->singular, m->steps, m->words);
    if (m->obstacle) nh_pen_fact(p, "Obstacle", "%s", m->obstacle);
    nh_pen_close(p, NH_PEN_FACTS);
    if (!m->trace || !m->singular) return;
    nh_pen_table(p, "Traces of the monodromy matrices, to 20 digits", "block|loop|#trace");
    for (size_t i = 0; i < e->blocks; i++)
        for (size_t j = 0; j < m->singular; j++)
            nh_pen_row(p, "#%zu|%zu|%s", i + 1, j + 1, m->trace[i * m->singular + j]);
    nh_pen_table_end(p);
}

static void higher_facts(nh_pen *p, nh_arena *arena, const nh_absence_attempt *t)
{
    const nh_higher *h = t->higher;
    nh_pen_heading(p, "Why the group of higher order is not abelian");
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    equation_facts(p, arena, t);
    nh_pen_fact_begin(p, "Exponents");
    nh_pen_say(p, "<%s> and <%s>, in the time from the pole of the motion",
               nh_arena_printf(arena, "%ld", -(long)h->exponent), nh_arena_printf(arena, "%ld", (long)h->exponent + 1));
    nh_pen_close(p, NH_PEN_FACT);
    nh_pen_fact_begin(p, "Connected");
    if (h->connected == NH_HIGHER_SOLUTION)
        nh_pen_say(p, "the normal variational equation has the solution <%s>, so that its group is unipotent",
                   h->solution);
    else
        nh_pen_say(p,
                   "a closed path multiplies a solution of the normal variational equation by a number of absolute "
                   "value %s; proved in balls of %ld bits",
                   h->multiplier, h->bits);
    nh_pen_close(p, NH_PEN_FACT);
    nh_pen_fact_begin(p, "Logarithm");
    nh_pen_say(p, "at order %zu, %s the plane: the series in the time from the pole ends before <%s>", (size_t)h->order,
               h->across ? "across" : "along", nh_arena_printf(arena, "t^(%ld)", (long)h->power));
    nh_pen_close(p, NH_PEN_FACT);
    nh_pen_fact(p, "Prime", "%zu", (size_t)h->prime);
    nh_pen_close(p, NH_PEN_FACTS);
}

static void residue_facts(nh_pen *p, const nh_residues *s)
{
    const char *at = s->factor && strcmp(s->factor, "1/x") != 0 ? s->factor : NULL; /* NULL: infinity */
    if (!s->factor) return;
    nh_pen_heading(p, "Why the group is infinite");
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    nh_pen_fact_begin(p, s->verdict == NH_RESIDUE_MEROMORPHIC ? "Residue" : "Irregular point");
    if (s->verdict == NH_RESIDUE_MEROMORPHIC && s->residue) nh_pen_say(p, "<%s>, not rational, ", s->residue);
    if (at) nh_pen_say(p, "at the zeros of <%s>", at);
    else nh_pen_say(p, "at infinity");
    nh_pen_close(p, NH_PEN_FACT);
    nh_pen_close(p, NH_PEN_FACTS);
}

static void certificate(nh_pen *p, const nh_analysis *r)
{
    const nh_absence_attempt *t = nh_absence_parts_best(r->absence);
    if (!t || r->absence->contradiction) return;
    switch (nh_absence_parts_reason_of(r->absence)) {
    case NH_ABSENCE_BY_GROUP:
    case NH_ABSENCE_BY_BLOCK:
    case NH_ABSENCE_BY_TRIANGULAR: kovacic_facts(p, r->arena, t); break;
    case NH_ABSENCE_BY_RESIDUE:
    case NH_ABSENCE_BY_IRREGULAR: residue_facts(p, t->residues); break;
    case NH_ABSENCE_BY_MONODROMY: monodromy_facts(p, t->equation, t->monodromy); break;
    case NH_ABSENCE_BY_LOGARITHM: higher_facts(p, r->arena, t); break;
    case NH_ABSENCE_BY_DARBOUX:
    case NH_ABSENCE_BY_NOTHING: break;
    }
}

/* ---- potentials and states of rest ---- */

static void darboux(nh_pen *p, nh_arena *arena, const nh_darboux *d)
{
    if (!d || !d->applies) return;
    nh_pen_heading(p, "The homogeneous potential");
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    nh_pen_fact(p, "Degree", "%s", nh_arena_printf(arena, "%ld", d->degree)); /* it may be negative */
    nh_pen_fact(p, "Straight motions", "%zu line%s found, %zu with eigenvalues that were not decided", d->points,
                plural(d->points), d->undecided);
    if (d->refuted) {
        nh_pen_fact_begin(p, "Eigenvalue");
        nh_pen_say(p, "<%s> at %s, which integrable potentials of this degree do not have", d->refutation.eigenvalue,
                   d->refutation.point);
        nh_pen_close(p, NH_PEN_FACT);
    }
    if (d->obstacle) nh_pen_fact(p, "Obstacle", "%s", d->obstacle);
    nh_pen_close(p, NH_PEN_FACTS);
}

static void rest_row(nh_pen *p, nh_arena *arena, const nh_resonance *e)
{
    nh_pen_open(p, NH_PEN_ROW, NULL, NULL);
    nh_pen_open(p, NH_PEN_ROW_HEAD, NULL, NULL);
    put_formulas(p, arena, e->point);
    nh_pen_close(p, NH_PEN_ROW_HEAD);
    nh_pen_cell(p, NH_PEN_CELL, "<%s>", spaced(arena, e->polynomial));
    nh_pen_cell(p, NH_PEN_CELL, "%zu", e->letters);
    nh_pen_cell(p, NH_PEN_CELL, "%zu", e->span);
    nh_pen_cell(p, NH_PEN_CELL, "%zu", e->at_most);
    if (e->prime) nh_pen_cell(p, NH_PEN_CELL, "%zu", (size_t)e->prime);
    else nh_pen_cell(p, NH_PEN_CELL, "%s", "\u2013");
    nh_pen_close(p, NH_PEN_ROW);
}

/* The same on a terminal. */
static void rest_fact(nh_pen *p, nh_arena *arena, const nh_resonance *e)
{
    nh_pen_fact(p, e->point, "at most %zu; characteristic polynomial %s; of %zu eigenvalues, which span at least %zu%s",
                e->at_most, spaced(arena, e->polynomial), e->letters, e->span,
                e->prime ? nh_arena_printf(arena, " (modulo %zu)", (size_t)e->prime) : "");
}

static void rest(nh_pen *p, const nh_analysis *r)
{
    static const char title[] = "Integrals that are analytic near states of rest and steady motions";
    const nh_absence *a = r->absence;
    if (!a->resonances) return;
    if (p->ink->brief) {
        nh_pen_heading(p, title);
        nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
        for (size_t i = 0; i < a->resonances; i++) rest_fact(p, r->arena, a->resonance[i]);
        nh_pen_close(p, NH_PEN_FACTS);
        return;
    }
    nh_pen_table(p, title, "state|characteristic polynomial|#letters|#span of the eigenvalues|#at most|prime");
    for (size_t i = 0; i < a->resonances; i++) rest_row(p, r->arena, a->resonance[i]);
    nh_pen_table_end(p);
}

/* ---- the section ---- */

static void remarks(nh_pen *p, const nh_analysis *r)
{
    const nh_absence *a = r->absence;
    if (nh_absence_parts_excludes(a) && !a->rational)
        nh_pen_words(
            p, "The complex motions are those in complex time, with all their loops, without the points where the "
               "equations have no value; what an integral does there does not matter. Integrals that are defined "
               "only where these motions do not go are not excluded.");
    if (a->shape && a->shape->left) {
        nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
        nh_pen_say(p, "The other equations do not contain ");
        for (size_t i = 0; i < a->shape->left; i++)
            nh_pen_say(p, i ? ", <%s>" : "<%s>", nh_name_of(a->shape->model->dag, a->shape->left_out[i]));
        nh_pen_say(p, "; nothing is said of integrals that do.");
        nh_pen_close(p, NH_PEN_WORDS);
    }
    if (!a->everything)
        nh_pen_words(p, "Only what costs little was tried; --absence tries all planes, levels and methods.");
}

void nh_analysis_write_absence(nh_pen *p, const nh_analysis *r)
{
    const nh_absence *a = r->absence;
    if (!nh_analysis_has_absence(r)) return;
    nh_absence_words words = nh_absence_words_of(r);
    nh_pen_section(p, "absence", "Other integrals");
    for (size_t i = 0; i < words.count; i++) put_paragraph(p, r->arena, words.sentence[i]);
    if (!a->contradiction) remarks(p, r);
    motions(p, r);
    certificate(p, r);
    darboux(p, r->arena, a->darboux);
    rest(p, r);
}
