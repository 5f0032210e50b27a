/* Of the sentences on other integrals: letters, known integrals, and the class of functions. */
#include "base/memory.h"
#include "document/absence_words_internal.h"
#include "document/current_words.h"
#include "graph/node.h"
#include "graph/print.h"

/* ---- formulas and lists ---- */

const char *nh_absence_words_formula(const nh_absence_writer *w, const char *text)
{
    return nh_arena_printf(w->r->arena, NH_ABSENCE_WORDS_FORMULA "%s" NH_ABSENCE_WORDS_END, text);
}

/* "x, y and z" */
static void put_list(const nh_absence_writer *w, size_t n, const char *const *item, const char *last)
{
    for (size_t i = 0; i < n; i++) nh_text_addf(w->out, "%s%s", !i ? "" : i + 1 < n ? ", " : last, item[i]);
}

/* ---- the letters ---- */

/* "x, y, x', y'"; of a rational class angles by their sines and cosines. */
static void put_letters(const nh_absence_writer *w, bool rational)
{
    const nh_closed_shape *s = w->a->shape;
    const char **name = nh_arena_alloc(w->r->arena, (2 * s->count + 1) * sizeof *name);
    size_t n = 0;
    for (size_t i = 0; i < s->count; i++) {
        const char *letter = nh_name_of(s->model->dag, s->letter[i]);
        bool circle = rational && s->angle[i];
        name[n++] = nh_absence_words_formula(w, circle ? nh_arena_printf(w->r->arena, "sin(%s)", letter) : letter);
        if (circle) name[n++] = nh_absence_words_formula(w, nh_arena_printf(w->r->arena, "cos(%s)", letter));
    }
    put_list(w, n, name, ", ");
}

void nh_absence_words_put_left_out(const nh_absence_writer *w, const char *last, bool time)
{
    const nh_closed_shape *s = w->a->shape;
    const char **name = nh_arena_alloc(w->r->arena, (s->left + 1) * sizeof *name);
    for (size_t i = 0; i < s->left; i++)
        name[i] = nh_absence_words_formula(w, nh_name_of(s->model->dag, s->left_out[i]));
    if (time) name[s->left] = nh_absence_words_formula(w, "t");
    put_list(w, s->left + time, name, last);
}

/* "the equations of x, y, x', y'" */
void nh_absence_words_put_equations(const nh_absence_writer *w)
{
    enum { most_named = 8 };
    const nh_closed_shape *s = w->a->shape;
    if (!w->brief || (!w->unnamed && s->count <= most_named)) {
        nh_text_add(w->out, "the equations of ");
        put_letters(w, false);
    } else {
        nh_text_add(w->out, "the equations of motion");
        if (s->left) nh_text_add(w->out, " without "), nh_absence_words_put_left_out(w, " and ", false);
    }
}

/* ---- the known integrals ---- */

/* "those found", "Phi1 and Phi3"; on a first screen "those above", "quantities 1 and
 * 3": they have numbers there. */
void nh_absence_words_put_known(const nh_absence_writer *w)
{
    const char **name;
    size_t n = nh_absence_parts_known(w->r, &name);
    bool listed = true; /* those found, not functions of them */
    for (size_t i = 0; i < n; i++) listed = listed && w->a->known_current[i] < w->r->list->count;
    if (listed && n == w->r->list->independent) {
        nh_text_add(w->out, !w->brief ? "those found" : n == 1 ? "the one above" : "those above");
        return;
    }
    for (size_t i = 0; i < n; i++)
        name[i] = w->brief ? nh_arena_printf(w->r->arena, "%zu", w->a->known_current[i] + 1)
                           : nh_absence_words_formula(w, name[i]);
    if (w->brief) nh_text_add(w->out, n == 1 ? "quantity " : "quantities ");
    put_list(w, n, name, " and ");
}

/* ---- the class of functions ---- */

/* "energy 1/7"; "at the level 1/7 of Phi2" of another integral, which is the first of those used. */
static void put_level(const nh_absence_writer *w, const nh_normal_equation *e)
{
    size_t index = w->a->known_current[e->used ? e->used[0] : 0];
    const nh_current *current = nh_absence_current(w->r, index);
    char *level = nh_print_string(w->r->question->model->dag, e->level);
    bool energy = w->a->known && nh_current_is_energy(current);
    nh_text_addf(w->out, energy ? "of energy %s" : "at the level %s", level);
    if (!energy && w->a->known > 1) {
        if (w->brief && index < w->r->list->count) nh_text_addf(w->out, " of quantity %zu", index + 1);
        else nh_text_addf(w->out, " of %s", nh_absence_words_formula(w, current->name));
    }
    nh_free(level);
}

/* "the complex motions x = 0 of energy 1/7" */
static void put_motions(const nh_absence_writer *w)
{
    if (w->best) {
        const char *plane = w->best->equation->plane->words;
        nh_text_addf(w->out, "the complex motions %s ", nh_absence_words_formula(w, plane));
        put_level(w, w->best->equation);
    } else if (nh_absence_parts_reason_of(w->a) == NH_ABSENCE_BY_DARBOUX && w->unnamed)
        nh_text_add(w->out, "the complex motions on a straight line");
    else if (nh_absence_parts_reason_of(w->a) == NH_ABSENCE_BY_DARBOUX)
        nh_text_addf(w->out, "the complex motions on the line along %s", w->a->darboux->refutation.point);
    else nh_text_add(w->out, "some complex motions");
}

static void put_roots(const nh_absence_writer *w)
{
    const char **root;
    size_t n = nh_absence_parts_roots(w->r->arena, w->a->shape, &root);
    for (size_t i = 0; i < n; i++) root[i] = nh_absence_words_formula(w, root[i]);
    if (!n) return;
    nh_text_add(w->out, w->a->rational ? " and " : w->unnamed ? "in coordinates, velocities and " : "in these and ");
    if (w->unnamed) nh_text_addf(w->out, n == 1 ? "a root" : "%zu roots", n);
    else put_list(w, n, root, " and ");
    if (!w->a->rational) nh_text_addf(w->out, ", where %s not 0, ", n == 1 ? "that is" : "those are");
}

static void put_angles(const nh_absence_writer *w)
{
    const nh_closed_shape *s = w->a->shape;
    const char **name = nh_arena_alloc(w->r->arena, (s->count + 1) * sizeof *name);
    size_t n = 0;
    for (size_t i = 0; i < s->count; i++)
        if (s->angle[i]) name[n++] = nh_absence_words_formula(w, nh_name_of(s->model->dag, s->letter[i]));
    if (n) put_list(w, n, name, " and ");
    else nh_text_add(w->out, "the angles");
}

/* "meromorphic near the complex motions x = 0 of energy 1/7", "rational in x, y, x', y'" */
void nh_absence_words_put_class(const nh_absence_writer *w)
{
    if (w->a->rational) {
        nh_text_add(w->out, "rational in ");
        if (nh_absence_parts_angles(w->a->shape)) put_letters(w, true);
        else nh_text_add(w->out, w->unnamed ? "coordinates and velocities" : "these");
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
