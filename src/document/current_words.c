#include "document/current_words.h"

#include <ctype.h>
#include <string.h>

#include "document/symmetry_words.h"
#include "exact/normal.h"
#include "graph/dag.h"

static bool is_minus(const nh_current *f) { return !strncmp(f->meaning, "minus", 5); }

bool nh_current_is_energy(const nh_current *f) { return f->energy && (!strcmp(f->meaning, "energy") || is_minus(f)); }

nh_ex nh_current_signed(const nh_analysis *r, const nh_current *f, nh_ex e)
{
    return is_minus(f) ? nh_neg(r->model->dag, e) : e;
}

const char *nh_current_label(const nh_analysis *r, const nh_current *f)
{
    nh_dag *d = r->model->dag;
    if (nh_current_is_energy(f) && !nh_depends(d, f->phi, nh_symbol(d, "E"))) return "E = ";
    const char *of = strstr(f->meaning, "momentum of ");
    bool bare = of && (of == f->meaning || !strncmp(f->meaning, "minus the ", 10));
    const char *p = bare ? nh_arena_printf(r->arena, "p_%s", of + strlen("momentum of ")) : NULL;
    return p && !nh_depends(d, f->phi, nh_symbol(d, p)) ? nh_arena_printf(r->arena, "%s = ", p) : "";
}

const char *nh_current_energy_named(const nh_analysis *r)
{
    const nh_system *s = r->system;
    const nh_named *kinetic = NULL, *potential = NULL;
    for (size_t i = 0; i < s->definitions; i++) {
        const nh_named *x = &s->definition[i];
        if (!strcmp(x->name, "T")) kinetic = x;
        else if (!strcmp(x->name, "V") || (!potential && !strcmp(x->name, "U"))) potential = x;
    }
    nh_dag *d = r->model->dag;
    if (!kinetic || !potential) return NULL;
    nh_ex sum = nh_model_compose(r->model, nh_add(d, kinetic->value, potential->value));
    bool equal = nh_normal_is_zero(d, nh_sub(d, r->model->E, sum), 0) == NH_ZERO;
    return equal ? nh_arena_printf(r->arena, "T + %s", potential->name) : NULL;
}

/* ---- sentences ---- */

static const char *capital(const nh_analysis *r, const char *text)
{
    return nh_arena_printf(r->arena, "%c%s", toupper((unsigned char)*text), text + 1);
}

/* The name by its meaning, by rotations, by its form; and what the system's file says of it. */
static void name_it(const nh_analysis *r, const nh_current *f, bool rotations, nh_current_words *out)
{
    static const char minus[] = "minus the ", multiple[] = "a multiple of the ", momentum[] = "momentum of ";
    const char *m = f->meaning;
    if (!strncmp(m, minus, strlen(minus))) m += strlen(minus);
    const char *of = strstr(m, momentum), *before = !strncmp(m, multiple, strlen(multiple)) ? multiple : "";
    if (of) of += strlen(momentum);
    bool angle = false;
    for (size_t s = 0; of && s < r->system->coordinates; s++)
        angle |= !strcmp(of, r->system->coordinate[s].name) && r->system->coordinate[s].type == NH_ANGLE;
    out->name = of ? capital(r, nh_arena_printf(r->arena, "%s%smomentum conjugate to", before, angle ? "angular " : ""))
                : *m        ? capital(r, m)
                : rotations ? "Angular momentum"
                            : "";
    out->of = of ? of : "";
    if (f->doc) out->doc = *out->name ? f->doc : capital(r, f->doc);
    else if (!*out->name && !f->series) out->name = nh_current_form(r, f->phi, &out->of);
}

nh_current_words nh_current_words_of(const nh_analysis *r, const nh_current *f, bool symmetry, const char *proof)
{
    nh_current_words out = {.of = "", .doc = "", .how = "", .what = ""};
    nh_text what, rest;
    nh_text_init(&what);
    nh_text_init(&rest);
    const char *how = "";
    bool follows = f->independence == NH_DEPENDENT;
    bool rotations = f->has_symmetry && !f->series && nh_symmetry_words(r->model, &f->symmetry, &how, &what);
    name_it(r, f, rotations, &out);
    if (symmetry && !follows) out.how = how, out.what = nh_arena_strdup(r->arena, nh_text_string(&what));
    if (follows) nh_text_add(&rest, "Follows from the others. ");
    if (f->independence == NH_DOUBTFUL) nh_text_add(&rest, "Perhaps it follows from the others. ");
    if (f->independence == NH_CONSTANT) nh_text_add(&rest, "It has the same value at all states. ");
    if (proof) nh_text_addf(&rest, "%s%s.", f->proof.proved ? "Proved" : "", proof);
    out.rest = nh_arena_strdup(r->arena, nh_text_string(&rest));
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
