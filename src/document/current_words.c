#include "document/current_words.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

#include "exact/normal.h"
#include "exact/relation_express.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "search/counted.h"

/* ---- the name that its form gives a quantity ---- */

enum { most = 3, NOT_CENTRAL = 0, INVERSE = -1, ELASTIC = 2 };

static bool vanishes(nh_dag *d, nh_ex e) { return nh_is_zero(d, nh_simplify(d, e)); }

/* The mass of a point in two or three Cartesian coordinates, and V = m v^2/2 - L of (q); 0: it is no such point. */
static nh_ex point_mass(const nh_model *model, nh_ex *V)
{
    nh_dag *d = model->dag;
    const nh_system *system = model->system;
    nh_ex kinetic = nh_int(d, 0), m = 0;
    if (model->k || model->m < 2 || model->m > most || model->n != model->m || model->framed || model->chart->quasi ||
        system->orientations)
        return 0;
    for (size_t i = 0; i < model->m; i++) {
        nh_ex v = system->coordinate[i].v;
        if (system->coordinate[i].type == NH_ANGLE) return 0;
        nh_ex own = nh_simplify(d, nh_diff(d, nh_diff(d, system->lagrangian, v), v));
        if (i && !vanishes(d, nh_sub(d, own, m))) return 0;
        m = own;
        kinetic = nh_add(d, kinetic, nh_mul(d, m, nh_mul(d, v, v)));
    }
    if (!nh_model_is_constant(model, m) || nh_is_zero(d, m)) return 0;
    *V = nh_simplify(d, nh_sub(d, nh_div(d, kinetic, nh_int(d, 2)), system->lagrangian));
    for (size_t i = 0; i < model->m; i++)
        if (nh_depends(d, *V, system->coordinate[i].v)) return 0;
    return nh_depends(d, *V, system->t) ? 0 : m;
}

/* The power of the distance that V is, INVERSE or ELASTIC; NOT_CENTRAL: another function. */
static int power_of(const nh_model *model, nh_ex V)
{
    nh_dag *d = model->dag;
    nh_ex radial = nh_int(d, 0), slope[most], *x = (nh_ex[most]){0};
    for (size_t i = 0; i < model->m; i++) {
        x[i] = model->system->coordinate[i].q;
        slope[i] = nh_diff(d, V, x[i]);
        radial = nh_add(d, radial, nh_mul(d, x[i], slope[i]));
    }
    for (size_t i = 0; i < model->m; i++)
        for (size_t j = 0; j < i; j++)
            if (!vanishes(d, nh_sub(d, nh_mul(d, x[i], slope[j]), nh_mul(d, x[j], slope[i])))) return NOT_CENTRAL;
    if (vanishes(d, V)) return NOT_CENTRAL;
    return vanishes(d, nh_add(d, radial, V))                            ? INVERSE
           : vanishes(d, nh_sub(d, radial, nh_mul(d, nh_int(d, 2), V))) ? ELASTIC
                                                                        : NOT_CENTRAL;
}

/* The components and their names; how many. */
static size_t components(const nh_analysis *result, int power, nh_ex m, nh_ex V, nh_ex *e, const char **name)
{
    const nh_model *model = result->question->model;
    nh_dag *d = model->dag;
    const nh_coordinate *c = model->system->coordinate;
    nh_ex square = nh_int(d, 0), along = nh_int(d, 0);
    size_t n = 0;
    for (size_t i = 0; i < model->m; i++) {
        square = nh_add(d, square, nh_mul(d, c[i].v, c[i].v));
        along = nh_add(d, along, nh_mul(d, c[i].q, c[i].v));
    }
    for (size_t i = 0; i < model->m && power == INVERSE; i++, n++) {
        nh_ex bilinear = nh_sub(d, nh_mul(d, c[i].q, square), nh_mul(d, c[i].v, along));
        e[n] = nh_add(d, nh_mul(d, m, bilinear), nh_mul(d, c[i].q, V));
        name[n] = c[i].name;
    }
    for (size_t i = 0; i < model->m && power == ELASTIC; i++)
        for (size_t j = 0; j <= i; j++, n++) {
            nh_ex stiffness = nh_diff(d, nh_diff(d, V, c[i].q), c[i].q);
            e[n] = nh_add(d, nh_mul(d, m, nh_mul(d, c[i].v, c[j].v)), nh_mul(d, stiffness, nh_mul(d, c[i].q, c[j].q)));
            name[n] = nh_arena_printf(result->arena, "%s%s", c[j].name, c[i].name);
        }
    return n;
}

static const char *of_point(const nh_analysis *result, nh_ex phi, const char **of)
{
    enum { terms = 2000 };
    const nh_model *model = result->question->model;
    nh_ex V, m = point_mass(model, &V), e[most * (most + 1) / 2 + 1], c[most * (most + 1) / 2];
    const char *name[most * (most + 1) / 2];
    int power = m ? power_of(model, V) : NOT_CENTRAL;
    size_t n = power == NOT_CENTRAL ? 0 : components(result, power, m, V, e, name), used = 0;
    if (!n) return "";
    e[n] = phi;
    if (!nh_relation_express(model->dag, n + 1, e, model->system->parameters, model->parameter, terms, c)) return "";
    for (size_t i = 0; i < n; i++)
        if (!nh_is_zero(model->dag, c[i])) *of = name[i], used++;
    if (used != 1) *of = "";
    if (power == INVERSE)
        return used == 1 ? "Laplace-Runge-Lenz vector along" : "Component of the Laplace-Runge-Lenz vector";
    return used == 1 ? "Component of Fradkin's tensor" : "Sum of components of Fradkin's tensor";
}

/* "Component of the Laplace-Runge-Lenz vector along", "Quadratic in the velocities", or ""; of: what follows it. */
static const char *name_of_form(const nh_analysis *result, nh_ex phi, const char **of)
{
    nh_model *model = result->question->model;
    static const char *const form[] = {"A function of the positions", "Linear in the velocities",
                                       "Quadratic in the velocities", "Cubic in the velocities",
                                       "Of degree 4 in the velocities"};
    double degree = nh_counted_degree_of(model, phi);
    *of = "";
    const char *name =
        degree == 2 && !nh_depends(model->dag, phi, result->question->system->t) ? of_point(result, phi, of) : "";
    if (*name) return name;
    if (degree == 0 && nh_depends(model->dag, phi, result->question->system->t))
        return "A function of time and positions";
    return degree < sizeof form / sizeof *form ? form[(size_t)degree] : "";
}

/* ---- words ---- */

static bool is_minus(const nh_current *f) { return !strncmp(f->meaning, "minus", 5); }

bool nh_current_is_energy(const nh_current *f) { return f->energy && (!strcmp(f->meaning, "energy") || is_minus(f)); }

nh_ex nh_current_signed(const nh_analysis *result, const nh_current *f, nh_ex e)
{
    return is_minus(f) ? nh_neg(result->question->model->dag, e) : e;
}

const char *nh_current_label(const nh_analysis *result, const nh_current *f)
{
    nh_dag *d = result->question->model->dag;
    if (f->symbol) {
        bool minus = nh_current_is_energy(f) && f->meaning[0] == 'm' && !nh_depends(d, f->phi, nh_symbol(d, "E"));
        return nh_arena_printf(result->arena, minus ? "%s = -E,  E = " : "%s = ", f->symbol);
    }
    if (nh_current_is_energy(f) && !nh_depends(d, f->phi, nh_symbol(d, "E"))) return "E = ";
    const char *of = strstr(f->meaning, "momentum of ");
    bool bare = of && (of == f->meaning || !strncmp(f->meaning, "minus the ", 10));
    const char *p = bare ? nh_arena_printf(result->arena, "p_%s", of + strlen("momentum of ")) : NULL;
    return p && !nh_depends(d, f->phi, nh_symbol(d, p)) ? nh_arena_printf(result->arena, "%s = ", p) : "";
}

const char *nh_current_energy_named(const nh_analysis *result)
{
    nh_model *model = result->question->model;
    const nh_system *system = result->question->system;
    const nh_named *kinetic = NULL, *potential = NULL;
    for (size_t i = 0; i < system->definitions; i++) {
        const nh_named *x = &system->definition[i];
        if (!strcmp(x->name, "T")) kinetic = x;
        else if (!strcmp(x->name, "V") || (!potential && !strcmp(x->name, "U"))) potential = x;
    }
    nh_dag *d = model->dag;
    if (!kinetic || !potential) return NULL;
    nh_ex sum = nh_model_compose(model, nh_add(d, kinetic->value, potential->value));
    bool equal = nh_normal_is_zero(d, nh_sub(d, model->E, sum), 0) == NH_ZERO;
    return equal ? nh_arena_printf(result->arena, "T + %s", potential->name) : NULL;
}

/* ---- sentences ---- */

static const char *capital(const nh_analysis *result, const char *text)
{
    return nh_arena_printf(result->arena, "%c%s", toupper((unsigned char)*text), text + 1);
}

/* The name by its meaning, by rotations, by its form; and what the system's file says of it. */
static void name_it(const nh_analysis *result, const nh_current *f, bool rotations, nh_current_words *out)
{
    static const char minus[] = "minus the ", multiple[] = "a multiple of the ", momentum[] = "momentum of ";
    const char *m = f->meaning;
    if (!strncmp(m, minus, strlen(minus))) m += strlen(minus);
    const char *of = strstr(m, momentum), *before = !strncmp(m, multiple, strlen(multiple)) ? multiple : "";
    if (of) of += strlen(momentum);
    bool angle = false;
    for (size_t s = 0; of && s < result->question->system->coordinates; s++)
        angle |= !strcmp(of, result->question->system->coordinate[s].name) &&
                 result->question->system->coordinate[s].type == NH_ANGLE;
    out->name = of          ? capital(result, nh_arena_printf(result->arena, "%s%smomentum conjugate to", before,
                                                     angle ? "angular " : ""))
                : *m        ? capital(result, m)
                : rotations ? "Angular momentum"
                            : "";
    out->of = of ? of : "";
    if (f->doc) out->doc = *out->name ? f->doc : capital(result, f->doc);
    else if (!*out->name && !f->series) out->name = name_of_form(result, f->phi, &out->of);
}

nh_current_words nh_current_words_of(const nh_analysis *result, const nh_current *f, bool symmetry, const char *proof)
{
    nh_current_words out = {.of = "", .doc = "", .how = "", .what = ""};
    nh_text what, rest;
    nh_text_init(&what);
    nh_text_init(&rest);
    const char *how = "";
    bool follows = f->independence == NH_DEPENDENT;
    bool rotations =
        f->has_symmetry && !f->series && nh_symmetry_words(result->question->model, &f->symmetry, &how, &what);
    name_it(result, f, rotations, &out);
    if (symmetry && !follows) out.how = how, out.what = nh_arena_strdup(result->arena, nh_text_string(&what));
    if (follows) nh_text_add(&rest, "Follows from the others. ");
    if (f->independence == NH_DOUBTFUL) nh_text_add(&rest, "Perhaps it follows from the others. ");
    if (f->independence == NH_CONSTANT) nh_text_add(&rest, "It has the same value at all states. ");
    if (proof) nh_text_addf(&rest, "%s%s.", f->proof.proved ? "Proved" : "", proof);
    out.rest = nh_arena_strdup(result->arena, nh_text_string(&rest));
    nh_text_clear(&what);
    nh_text_clear(&rest);
    return out;
}

/* A list in a list has no clear end. */
bool nh_current_words_agree(const nh_current_words *a, const nh_current_words *b)
{
    bool plain = !strstr(a->what, " and ") && !strstr(b->what, " and ");
    return !strcmp(a->name, b->name) && !strcmp(a->doc, b->doc) && !strcmp(a->how, b->how) &&
           !strcmp(a->rest, b->rest) && !*a->of == !*b->of && !*a->what == !*b->what &&
           (plain || !strcmp(a->what, b->what));
}

/* " x, y and z": the different ones. */
static void put_each(nh_text *out, size_t n, const nh_current_words *s, bool what)
{
    size_t different = 0, told = 0;
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < n; i++) {
            const char *one = what ? s[i].what : s[i].of;
            bool again = !*one;
            for (size_t j = 0; j < i && !again; j++) again = !strcmp(one, what ? s[j].what : s[j].of);
            if (again) continue;
            if (!pass) different++;
            else told++, nh_text_addf(out, "%s%s", told == 1 ? " " : told == different ? " and " : ", ", one);
        }
}

void nh_current_words_put(size_t n, const nh_current_words *s, nh_text *out)
{
    nh_text_add(out, s->name);
    put_each(out, n, s, false);
    if (*s->doc) nh_text_addf(out, "%s%s", *s->name ? ": " : "", s->doc);
    if (*s->name || *s->doc) nh_text_add(out, nh_text_string(out)[out->length - 1] == '.' ? " " : ". ");
    if (*s->how) {
        nh_text_addf(out, "From %s", s->how);
        put_each(out, n, s, true);
        nh_text_add(out, ". ");
    }
    nh_text_add(out, s->rest);
}
