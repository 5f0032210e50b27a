/* The linear space of constraint symmetries, and which currents can have better ones, as sections of the geometry
   sheet. */
#include "document/geometry_sheet.h"

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/print.h"

static const char *const kind_title[NH_SPACES] = {[NH_SPACE_BEST] = "Projectable and of case 1",
                                                  [NH_SPACE_CASE1] = "Of case 1",
                                                  [NH_SPACE_PROJECTABLE] = "Projectable",
                                                  [NH_SPACE_INSIDE] = "With $[Gamma,Z]$ in the canonical distribution"};

/* ---- the space ---- */

/* The first of the kinds to which it belongs; NH_SPACES: none. */
static nh_space_kind kind_of(const nh_space_member *m)
{
    nh_space_kind k = 0;
    while (k < NH_SPACES && !m->in[k]) k++;
    return k;
}

/* A product of whole powers of names; NULL: it is none. */
static const char *monomial(nh_sheet *s, nh_ex e)
{
    nh_dag *d = s->dag;
    const char *label = "";
    if (nh_kind_of(d, e) == NH_NUMBER) return "1";
    if (nh_kind_of(d, e) == NH_SYMBOL) return nh_sheet_label(s, "<%s>", nh_name_of(d, e));
    if (nh_kind_of(d, e) != NH_PRODUCT || !nh_num_is(nh_constant_of(d, e), 1)) return NULL;
    for (size_t i = 0; i < nh_arity(d, e); i++) {
        nh_ex base = nh_child(d, e, i), power = nh_exponent_of(d, e, i);
        if (nh_kind_of(d, base) != NH_SYMBOL || !nh_num_short(nh_number_of(d, power)) || nh_number_of(d, power).q != 1)
            return NULL;
        long k = (long)nh_number_of(d, power).p;
        label = nh_sheet_label(s, k == 1 ? "%s%s<%s>" : "%s%s<%s>^{%ld}", label, i ? " " : "", nh_name_of(d, base), k);
    }
    return label;
}

/* The name of a current: a product, or Psi_i for a combination, which is defined in a line of its own. */
static const char *called(nh_sheet *s, const nh_space_member *m, size_t i)
{
    const char *label = monomial(s, m->combination);
    return label ? label : nh_sheet_label(s, "Psi_{%zu}", i);
}

static void show_field(nh_sheet *s, const nh_model *model, const char *name, const nh_field *z)
{
    nh_sheet_sum(s, "", nh_sheet_label(s, "Z(%s)", name));
    nh_sheet_add(s, z->time, "\\frac{\\p}{\\p t}");
    for (size_t i = 0; i < model->m; i++)
        nh_sheet_add(s, z->space[i], nh_sheet_label(s, "\\frac{\\p}{\\p<%s>}", model->system->coordinate[i].name));
}

/* The members of one kind: their names in a row; combinations and fields below. */
static void show_kind(nh_sheet *s, const nh_theory *t, nh_space_kind kind)
{
    const nh_symmetry_space *x = t->space;
    const char *list = kind < NH_SPACES ? nh_sheet_label(s, "%s: ", kind_title[kind]) : "Others: ";
    size_t shown = 0;
    for (size_t i = 0; i < x->dimension; i++)
        if (kind_of(&x->member[i]) == kind)
            list = nh_sheet_label(s, "%s%s$Z(%s)$", list, shown++ ? ", " : "", called(s, &x->member[i], i + 1));
    if (!shown) return;
    nh_sheet_words(s, nh_sheet_label(s, "%s.", list));
    for (size_t i = 0; i < x->dimension; i++) {
        const nh_space_member *m = &x->member[i];
        if (kind_of(m) != kind) continue;
        if (!monomial(s, m->combination)) nh_sheet_formula(s, called(s, m, i + 1), m->combination);
        if (m->field) show_field(s, t->own->model, called(s, m, i + 1), m->field);
    }
}

static void number(nh_sheet *s, const char *label, size_t n) { nh_sheet_formula(s, label, nh_int(s->dag, (int64_t)n)); }

static void space(nh_sheet *s, const nh_theory *t)
{
    const nh_symmetry_space *x = t->space;
    nh_sheet_begin(s, "symmetry_space", "The linear space of constraint symmetries",
                   "Of the currents that were found, their products of degree two at most in the velocities, and 1. Z "
                   "is linear: $Z(1)=Gamma/\\bar{L}$, $Z(Phi Psi)=Phi Z(Psi)+Psi Z(Phi)-Phi Psi Gamma/\\bar{L}$. "
                   "Fields that are projectable, of case 1, or have $[Gamma,Z]$ in the canonical distribution (inside) "
                   "form subspaces; the basis begins with the first ones.");
    if (x->obstacle) {
        nh_sheet_words(s, nh_sheet_label(s, "Not found, because of %s.", x->obstacle));
        return;
    }
    number(s, "dim", x->dimension);
    number(s, "dim_{projectable}", x->of[NH_SPACE_PROJECTABLE]);
    number(s, "dim_{case1}", x->of[NH_SPACE_CASE1]);
    number(s, "dim_{projectable,case1}", x->of[NH_SPACE_BEST]);
    if (t->own->model->k) number(s, "dim_{inside}", x->of[NH_SPACE_INSIDE]);
    if (x->counted && x->counted == x->dimension - x->others)
        nh_sheet_words(s, "The count of all currents of degree two finds no more: they are all that there are.");
    else if (x->counted > x->dimension - x->others)
        nh_sheet_words(
            s, nh_sheet_label(s, "The space of all currents of degree two has at most dimension %zu, by their count.",
                              x->counted));
    if (x->left_out)
        nh_sheet_words(s, nh_sheet_label(s, "There are too many products: %zu were left out.", x->left_out));
    nh_sheet_words(
        s, x->sure ? "These numbers are proved."
                   : "These numbers are lower bounds of the subspaces: some relations are too long to be proved.");
    for (nh_space_kind k = 0; k <= NH_SPACES; k++) show_kind(s, t, k);
}

/* ---- bounds ---- */

/* A function of currents that is no product of them is denoted by the letter, and defined in a line of its own. */
static const char *names_of(nh_sheet *s, const nh_space_bound *b, const char *letter)
{
    const char *list = "";
    for (size_t i = 0; i < b->count; i++) {
        const char *name = monomial(s, b->name[i]);
        if (!name) nh_sheet_formula(s, name = nh_sheet_label(s, "%s_{%zu}", letter, i + 1), b->name[i]);
        list = nh_sheet_label(s, "%s%s$%s$", list, !i ? "" : i + 1 == b->count ? " and " : ", ", name);
    }
    return list;
}

/* The conclusion from the rank about the currents that `have` such a field. */
static void conclude(nh_sheet *s, const nh_space_bound *b, const char *letter, const char *fields, const char *have)
{
    const nh_closure *c = &b->closure;
    if (c->obstacle) {
        nh_sheet_words(s,
                       nh_sheet_label(s, "How many currents have %s was not found, because of %s.", have, c->obstacle));
        return;
    }
    size_t left = c->dimension - c->rank;
    const char *names = names_of(s, b, letter);
    nh_sheet_words(s, nh_sheet_label(s,
                                     "$Gamma$ and %s span with their brackets %zu of %zu dimensions at a point modulo "
                                     "a prime, so at least as many almost everywhere.",
                                     fields, c->rank, c->dimension));
    if (!left) nh_sheet_words(s, nh_sheet_label(s, "So no current but constants has %s: proved.", have));
    else if (left == c->known)
        nh_sheet_words(s, nh_sheet_label(s, "So the currents with %s are the functions of %s, and no others: proved.",
                                         have, names));
    else
        nh_sheet_words(s, nh_sheet_label(s, "So at most %zu independent current%s %s %s%s%s.", left,
                                         left == 1 ? "" : "s", left == 1 ? "has" : "have", have,
                                         b->count ? "; of those found: " : "; none was found", names));
}

/* U_a = c^l d/dw^l. */
static void show_across(nh_sheet *s, const nh_model *model, size_t a, const nh_ex *coefficient)
{
    nh_sheet_sum(s, "", nh_sheet_label(s, "U_{%zu}", a + 1));
    for (size_t l = 0; l < model->n; l++)
        nh_sheet_add(s, nh_simplify_short(s->dag, coefficient[l], 0),
                     nh_sheet_label(s, "\\frac{\\p}{\\p<%s>}", nh_name_of(s->dag, model->chart->w[l])));
}

static void bounds(nh_sheet *s, const nh_theory *t)
{
    const nh_model *model = t->model;
    const nh_bracket_fields *f = t->fields;
    nh_sheet_begin(s, "bracket_bounds", "Which currents can have better symmetries",
                   model->k
                       ? "Vertical fields with $i_{[Gamma,Z]}\\form^{a}=U_{a}(Phi)$ for every current, and fields $V$ "
                         "with which $[Gamma,Z-Z^{0} Gamma]$ has the components $V(Phi)$: a function of one current "
                         "has the case of the current."
                       : "Fields $V$ with which $[Gamma,Z-Z^{0} Gamma]$ has the components $V(Phi)$ for every "
                         "current: a function of one current has the case of the current.");
    for (size_t a = 0; a < model->k && !t->space->all_inside; a++)
        show_across(s, model, a, f->U + a * f->width + 1 + model->m);
    if (model->k && t->space->all_inside)
        nh_sheet_words(s, "All $U_{a}$ vanish: $[Gamma,Z]$ lies in the canonical distribution for every current.");
    else if (model->k)
        conclude(s, &t->space->inside, "f", model->k == 1 ? "$U_{1}$" : "the $U_{a}$",
                 "$[Gamma,Z]$ in the canonical distribution");
    if (t->space->all_case1) nh_sheet_words(s, "All $V$ vanish: every current has a field of case 1.");
    else conclude(s, &t->space->case1, "g", "all $V$", "a field of case 1");
}

/* ---- symmetries of the equations of motion ---- */

static const char *letters_of(nh_sheet *s, const nh_equation_symmetries *e)
{
    const char *list = "";
    for (size_t i = 0; i < e->letters; i++) {
        char *name = nh_print_string(s->dag, e->letter[i]);
        list = nh_sheet_label(s, "%s%s$<%s>$", list, i ? ", " : "", name);
        nh_free(name);
    }
    return list;
}

/* S_i(Phi) = .. in terms of currents, or as a formula. */
static void show_action(nh_sheet *s, const nh_theory *t, const nh_symmetry_action *a)
{
    const char *label = nh_sheet_label(s, "S_{%zu}(<%s>)", a->symmetry + 1, t->current[a->current].name);
    nh_sheet_formula(s, label, a->combination ? a->combination : a->value);
    if (a->combination) return;
    nh_sheet_words(s, a->answer == NH_ACTION_INDEPENDENT
                          ? "This is a current that does not depend on those that were found."
                      : a->answer == NH_ACTION_DEPENDENT
                          ? "This depends on the currents, but is no combination of their products of degree two."
                          : "This is no combination of the currents' products of degree two.");
}

static void equations(nh_sheet *s, const nh_theory *t)
{
    const nh_equation_symmetries *e = t->symmetries;
    const nh_model *model = t->own->model;
    nh_sheet_begin(
        s, "equation_symmetries", "Symmetries of the equations of motion",
        "Fields $S$ with $[Gamma,S]=a Gamma$, which need not be constraint symmetries: point symmetries on time and "
        "positions, prolonged to velocities; and dynamical ones, whose components along positions "
        "depend on velocities, up to multiples of $Gamma$. The derivative of a current along $S$ is a current.");
    if (e->obstacle) {
        nh_sheet_words(s, nh_sheet_label(s, "The search for them was not possible, because of %s.", e->obstacle));
        return;
    }
    nh_sheet_words(
        s, nh_sheet_label(s, "The search used components of degree %zu at most in %s. %s", e->degree, letters_of(s, e),
                          e->sure ? "The point symmetries are all that there are of this form: proved."
                                  : "There may be more of this form: some relations are too long to be proved."));
    number(s, "dim_{point}", e->points);
    number(s, "dim_{dynamical}", e->dynamical);
    for (size_t i = 0; i < e->points + e->dynamical; i++) {
        nh_sheet_sum(s, "", nh_sheet_label(s, "S_{%zu}", i + 1));
        nh_sheet_add(s, e->item[i].time, "\\frac{\\p}{\\p t}");
        for (size_t r = 0; r < model->m; r++)
            nh_sheet_add(s, e->item[i].space[r],
                         nh_sheet_label(s, "\\frac{\\p}{\\p<%s>}", model->system->coordinate[r].name));
    }
    if (e->dynamical)
        nh_sheet_words(s, "The dynamical ones are counted without combinations of point symmetries and of their "
                          "products with currents.");
    for (size_t i = 0; i < e->actions; i++) show_action(s, t, &e->action[i]);
    if (t->currents && e->points + e->dynamical)
        nh_sheet_words(s, e->actions ? "All other derivatives of the currents vanish."
                                     : "All derivatives of the currents vanish.");
}

void nh_symmetry_sheet(nh_sheet *s, const nh_theory *t)
{
    if (!t->space) return;
    space(s, t);
    bounds(s, t);
    if (t->symmetries) equations(s, t);
}
