/* The member `absence` of an analysis: what a checker needs to repeat the proof. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "document/absence_parts.h"
#include "document/absence_words.h"
#include "document/analysis_internal.h"
#include "graph/node.h"
#include "graph/print.h"

static void put_names(nh_json *to, const char *key, size_t n, const char *const *name)
{
    nh_json *list = nh_json_put_array(to, key);
    for (size_t i = 0; i < n; i++) nh_json_add_text(list, name[i]);
}

static void put_symbols(nh_json *to, const char *key, const nh_closed_shape *shape, bool left_out)
{
    nh_json *list = nh_json_put_array(to, key);
    size_t n = left_out ? shape->left : shape->count;
    const nh_ex *symbol = left_out ? shape->left_out : shape->letter;
    for (size_t i = 0; i < n; i++) nh_json_add_text(list, nh_name_of(shape->model->dag, symbol[i]));
}

/* ---- a certificate of Kovacic's algorithm ---- */

typedef struct {
    bool minus;
    const char *digits; /* of the coefficient; length 0: it is 1 */
    size_t length, power;
} term;

/* The next term of a polynomial in x as FLINT writes it, "3*x^2-x+7"; false after the last. */
static bool next_term(const char **at, term *out)
{
    enum { decimal = 10 };
    *out = (term){0};
    for (; **at == ' ' || **at == '+' || **at == '-'; (*at)++) out->minus ^= **at == '-';
    if (!**at) return false;
    out->digits = *at;
    out->length = strspn(*at, "0123456789");
    const char *x = *at + out->length + ((*at)[out->length] == '*');
    if (*x == 'x') out->power = x[1] == '^' ? strtoul(x + 2, NULL, decimal) : 1;
    *at += strcspn(*at, " +-");
    return true;
}

/* Its coefficients as texts, the constant first. */
static void put_polynomial(nh_arena *arena, nh_json *to, const char *key, const char *text)
{
    nh_json *list = nh_json_put_array(to, key);
    size_t degree = 0;
    term t;
    for (const char *at = text; next_term(&at, &t);)
        if (t.power > degree) degree = t.power;
    const char **coefficient = nh_arena_alloc(arena, (degree + 1) * sizeof *coefficient);
    for (const char *at = text; next_term(&at, &t);)
        coefficient[t.power] = nh_arena_printf(arena, "%s%.*s", t.minus ? "-" : "", t.length ? (int)t.length : 1,
                                               t.length ? t.digits : "1");
    for (size_t i = 0; i <= degree; i++) nh_json_add_text(list, coefficient[i] ? coefficient[i] : "0");
}

static void put_residues(nh_json *to, const char *key, size_t n, const ulong *value)
{
    nh_json *list = nh_json_put_array(to, key);
    for (size_t i = 0; i < n; i++) nh_json_add_number(list, (double)value[i]);
}

static void put_signed(nh_json *to, const char *key, size_t n, const slong *value)
{
    nh_json *list = nh_json_put_array(to, key);
    for (size_t i = 0; i < n; i++) nh_json_add_number(list, (double)value[i]);
}

/* Where the group is known, and not where it is open. */
static void put_certificate(nh_arena *arena, nh_json *to, const nh_kovacic *k)
{
    if (!k || (k->group != NH_GROUP_SL2 && k->group != NH_GROUP_TRIANGULAR)) {
        nh_json_put_null(to, "certificate");
        return;
    }
    nh_json *item = nh_json_put_object(to, "certificate");
    put_polynomial(arena, item, "r_num", k->r_num);
    put_polynomial(arena, item, "r_den", k->r_den);
    nh_json_put_number(item, "prime", (double)k->prime);
    put_residues(item, "poles", k->poles, k->pole);
    put_residues(item, "roots", k->poles, k->root);
    nh_json_put_number(item, "root_infinity", k->root ? (double)k->root[k->poles] : 0);
    put_signed(item, "degrees", k->degrees, k->degree_of_p);
    nh_json *list = nh_json_put_array(item, "invariants");
    for (size_t i = 0; i < NH_KOVACIC_INVARIANTS; i++) {
        const nh_kovacic_invariant *v = &k->invariant[i];
        if (!v->possible) continue;
        nh_json *entry = nh_json_add_object(list);
        nh_json_put_number(entry, "m", v->m);
        put_signed(entry, "lowest", k->poles, v->lowest);
        nh_json_put_number(entry, "degree", (double)v->degree);
    }
}

/* ---- an attempt ---- */

static void put_monodromy(nh_json *to, const nh_normal_equation *e, const nh_monodromy *m)
{
    if (!m) {
        nh_json_put_null(to, "monodromy");
        return;
    }
    nh_json *item = nh_json_put_object(to, "monodromy");
    nh_json_put_number(item, "rank", (double)m->rank);
    nh_json_put_number(item, "size", (double)m->size);
    nh_json_put_number(item, "bits", (double)m->bits);
    put_names(item, "traces", m->trace ? e->blocks * m->singular : 0, m->trace);
    nh_json_put_text(item, "obstacle", m->obstacle);
}

static void put_residue(nh_json *to, const nh_residues *s)
{
    static const char *const verdicts[] = {"meromorphic", "rational", "open"};
    if (!s) {
        nh_json_put_null(to, "residues");
        return;
    }
    nh_json *item = nh_json_put_object(to, "residues");
    nh_json_put_text(item, "verdict", verdicts[s->verdict]);
    nh_json_put_text(item, "factor", s->factor);
    nh_json_put_text(item, "residue", s->residue);
}

static void put_attempt(const nh_analysis *r, nh_json *list, const nh_absence_attempt *t)
{
    const nh_normal_equation *e = t->equation;
    nh_json *item = nh_json_add_object(list);
    char *level = nh_print_string(r->question->model->dag, e->level);
    nh_json_put_text(item, "plane", e->plane->words);
    nh_json_put_text(item, "level", level);
    nh_free(level);
    nh_json_put_text(item, "curve", e->curve);
    nh_json_put_text(item, "variable", e->variable);
    nh_json_put_number(item, "known_rank", (double)e->known);
    nh_json_put_number(item, "dimension", (double)e->dimension);
    nh_json_put_number(item, "blocks", (double)e->blocks);
    nh_json_put_text(item, "p", t->p);
    nh_json_put_text(item, "q", t->q);
    nh_json_put_text(item, "group", nh_absence_parts_group(r->arena, t));
    if (t->kovacic) nh_json_put_bool(item, "regular", t->kovacic->regular);
    else nh_json_put_null(item, "regular");
    nh_json_put_number(item, "orbit", (double)t->orbit);
    nh_json_put_text(item, "obstacle", t->obstacle ? t->obstacle : e->obstacle);
    put_certificate(r->arena, item, t->kovacic);
    put_monodromy(item, e, t->monodromy);
    put_residue(item, t->residues);
}

/* ---- potentials and states of rest ---- */

static void put_darboux(nh_json *to, const nh_darboux *d)
{
    if (!d || !d->applies) {
        nh_json_put_null(to, "darboux");
        return;
    }
    nh_json *item = nh_json_put_object(to, "darboux");
    nh_json_put_number(item, "degree", (double)d->degree);
    nh_json_put_number(item, "points", (double)d->points);
    nh_json_put_number(item, "undecided", (double)d->undecided);
    nh_json_put_bool(item, "refuted", d->refuted);
    nh_json_put_text(item, "point", d->refuted ? d->refutation.point : NULL);
    nh_json_put_text(item, "eigenvalue", d->refuted ? d->refutation.eigenvalue : NULL);
    nh_json_put_text(item, "obstacle", d->obstacle);
}

static void put_rest(nh_json *to, const nh_absence *a)
{
    nh_json *list = nh_json_put_array(to, "rest");
    for (size_t i = 0; i < a->resonances; i++) {
        const nh_resonance *e = a->resonance[i];
        nh_json *item = nh_json_add_object(list);
        nh_json_put_text(item, "state", e->point);
        nh_json_put_text(item, "polynomial", e->polynomial);
        nh_json_put_number(item, "letters", (double)e->letters);
        nh_json_put_number(item, "span", (double)e->span);
        nh_json_put_bool(item, "diagonalizable", e->diagonalizable);
        nh_json_put_number(item, "at_most", (double)e->at_most);
        nh_json_put_number(item, "prime", (double)e->prime);
        nh_json_put_bool(item, "no_measure", e->divergence);
    }
}

/* ---- the whole ---- */

void nh_analysis_json_absence(const nh_analysis *r, nh_json *to)
{
    const nh_absence *a = r->absence;
    if (!a) {
        nh_json_put_null(to, "absence");
        return;
    }
    nh_json *item = nh_json_put_object(to, "absence");
    bool excludes = nh_absence_parts_excludes(a);
    const char **known;
    size_t n = nh_absence_parts_known(r, &known);
    nh_json_put_text(item, "verdict", nh_absence_parts_verdict(a));
    nh_json_put_text(item, "sentence", nh_absence_words_sentence(r));
    nh_json_put_text(item, "class", !excludes ? NULL : a->rational ? "rational" : "meromorphic");
    if (a->shape) put_symbols(item, "letters", a->shape, false), put_symbols(item, "left_out", a->shape, true);
    else nh_json_put_array(item, "letters"), nh_json_put_array(item, "left_out");
    nh_json_put_bool(item, "periodic", excludes && nh_absence_parts_periodic(a));
    nh_json_put_bool(item, "generic", excludes && a->generic);
    put_names(item, "known", n, known);
    nh_json_put_number(item, "many_valued", (double)a->many_valued);
    if (excludes) nh_json_put_number(item, "at_most", (double)a->at_most);
    else nh_json_put_null(item, "at_most");
    nh_json_put_bool(item, "everything", a->everything);
    nh_json_put_number(item, "planes", (double)a->planes);
    if (nh_absence_parts_best(a)) nh_json_put_number(item, "decided_by", (double)a->best);
    else nh_json_put_null(item, "decided_by");
    nh_json *list = nh_json_put_array(item, "motions");
    for (size_t i = 0; i < a->attempts; i++) put_attempt(r, list, &a->attempt[i]);
    put_darboux(item, a->darboux);
    put_rest(item, a);
    nh_json_put_text(item, "obstacle", a->obstacle);
    nh_json_put_text(item, "contradiction", a->contradiction);
}
