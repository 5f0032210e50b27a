#include "document/current_words.h"

#include <ctype.h>
#include <string.h>

#include "exact/gather.h"
#include "exact/normal.h"
#include "graph/dag.h"

/* ---- words ---- */

static const char multiple[] = "a multiple of the ";

static bool is_minus(const nh_current *f) { return !strncmp(f->meaning, "minus", 5); }

bool nh_current_is_energy(const nh_current *f) { return f->energy && (!strcmp(f->meaning, "energy") || is_minus(f)); }

nh_ex nh_current_signed(const nh_analysis *result, const nh_current *f, nh_ex e)
{
    return is_minus(f) ? nh_neg(result->question->model->dag, e) : e;
}

nh_ex nh_current_plain(const nh_analysis *result, const nh_current *f)
{
    const nh_model *model = result->question->model;
    if (is_minus(f)) return nh_neg(model->dag, f->phi);
    if (f->series || f->symbol || (*f->meaning && strncmp(f->meaning, multiple, strlen(multiple)))) return f->phi;
    if (!*f->meaning) {
        int sign = nh_current_noether(result, f).sign;
        if (sign) return sign < 0 ? nh_neg(model->dag, f->phi) : f->phi;
    }
    nh_dag *d = model->dag;
    nh_ex gathered = nh_gather(d, f->phi), e = nh_model_without_constants(model, gathered);
    if (gathered != f->phi) return e;
    nh_ex minus = nh_model_without_constants(model, nh_gather(d, nh_neg(d, f->phi)));
    return nh_complexity(d, minus) < nh_complexity(d, e) ? minus : e;
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

/* The name by its meaning, by its symmetry, by its form; and what the system's file says of it. */
static void name_it(const nh_analysis *result, const nh_current *f, nh_current_words *out)
{
    static const char minus[] = "minus the ", momentum[] = "momentum of ";
    const char *m = f->meaning;
    if (!strncmp(m, minus, strlen(minus))) m += strlen(minus);
    const char *of = strstr(m, momentum), *before = !strncmp(m, multiple, strlen(multiple)) ? multiple : "";
    if (of) of += strlen(momentum);
    bool angle = false;
    for (size_t s = 0; of && s < result->question->system->coordinates; s++)
        angle |= !strcmp(of, result->question->system->coordinate[s].name) &&
                 result->question->system->coordinate[s].type == NH_ANGLE;
    out->name = of   ? capital(result, nh_arena_printf(result->arena, "%s%smomentum conjugate to", before,
                                                     angle ? "angular " : ""))
                : *m ? capital(result, m)
                     : nh_current_noether(result, f).name;
    out->of = of ? of : "";
    if (f->doc) out->doc = *out->name ? f->doc : capital(result, f->doc);
    else if (!*out->name && !f->series) out->name = nh_current_form(result, f->phi, &out->of);
}

nh_current_words nh_current_words_of(const nh_analysis *result, const nh_current *f, bool symmetry, const char *proof)
{
    nh_current_words out = {.of = "", .doc = "", .how = "", .what = ""};
    nh_text what, rest;
    nh_text_init(&what);
    nh_text_init(&rest);
    const char *how = "";
    bool follows = f->independence == NH_DEPENDENT;
    if (f->has_symmetry && !f->series) nh_symmetry_words(result->question->model, &f->symmetry, &how, &what);
    name_it(result, f, &out);
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
