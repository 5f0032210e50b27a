/* The member `absence` of an analysis: what a checker needs to repeat the proof. */
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

/* ---- an attempt ---- */

/* Where the group is known, and not where it is open. */
static void put_certificate(nh_json *to, const nh_kovacic *k)
{
    if (k && (k->group == NH_GROUP_SL2 || k->group == NH_GROUP_TRIANGULAR))
        nh_kovacic_certificate(nh_json_put_object(to, "certificate"), k);
    else nh_json_put_null(to, "certificate");
}

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

static void put_higher(nh_json *to, const nh_higher *h)
{
    static const char *const connected[] = {NULL, "multiplier", "solution"};
    if (!h) {
        nh_json_put_null(to, "higher");
        return;
    }
    nh_json *item = nh_json_put_object(to, "higher");
    nh_json_put_bool(item, "refuted", h->refuted);
    nh_json_put_number(item, "exponent", (double)h->exponent);
    if (h->order) {
        nh_json_put_number(item, "order", h->order);
        nh_json_put_bool(item, "across", h->across);
        nh_json_put_number(item, "power", (double)h->power);
        nh_json_put_number(item, "prime", (double)h->prime);
    } else {
        nh_json_put_null(item, "order");
        nh_json_put_null(item, "across");
        nh_json_put_null(item, "power");
        nh_json_put_null(item, "prime");
    }
    nh_json_put_text(item, "connected", connected[h->connected]);
    nh_json_put_text(item, "multiplier", h->multiplier);
    nh_json_put_text(item, "trace", h->trace);
    nh_json_put_number(item, "bits", (double)h->bits);
    nh_json_put_text(item, "solution", h->solution);
    nh_json_put_text(item, "obstacle", h->obstacle);
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
    put_certificate(item, t->kovacic);
    put_monodromy(item, e, t->monodromy);
    put_residue(item, t->residues);
    put_higher(item, t->higher);
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
