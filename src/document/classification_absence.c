/* Of which values of a parameter another integral is found, excluded or undecided: as a document, and as JSON. */
#include <math.h>
#include <string.h>

#include "document/absence_parts.h"
#include "document/classification_internal.h"
#include "document/current_words.h"
#include "document/screen.h"
#include "graph/node.h"
#include "graph/print.h"

/* ---- words ---- */

static const char *const side_word[] = {
    [NH_CLASSIFIED_FOUND] = "found", [NH_CLASSIFIED_EXCLUDED] = "excluded", [NH_CLASSIFIED_UNDECIDED] = "undecided"};

/* The motions near which the theorem holds; NULL: there is none. */
static const char *motion_of(const nh_classified_absence *x, const nh_absence *a)
{
    if (a->best >= a->attempts) return NULL;
    const nh_normal_equation *e = a->attempt[a->best].equation;
    return nh_arena_printf(x->arena, "%s, %s", e->plane->words, e->curve);
}

/* Values that are excluded for the same class of integrals are listed together, and undecided ones with the same
 * reason. */
static bool together(const nh_classified_value *a, const nh_classified_value *b)
{
    if (a->side != b->side || a->side == NH_CLASSIFIED_FOUND) return false;
    if (a->side == NH_CLASSIFIED_EXCLUDED) return a->result->absence->rational == b->result->absence->rational;
    return a->why == b->why || (a->why && b->why && !strcmp(a->why, b->why));
}

/* "mu = 3/2, 5/4": the value, and all later ones that are listed with it. */
static const char *list(const nh_classified_absence *x, size_t from)
{
    const nh_classified_value *v = &x->value[from];
    const char *text = nh_arena_printf(x->arena, "%s = %s", x->over, v->text);
    for (size_t k = from + 1; k < x->values; k++)
        if (together(v, &x->value[k])) text = nh_arena_printf(x->arena, "%s, %s", text, x->value[k].text);
    return text;
}

/* Was it listed with an earlier one? */
static bool listed(const nh_classified_absence *x, size_t k)
{
    for (size_t i = 0; i < k; i++)
        if (together(&x->value[i], &x->value[k])) return true;
    return false;
}

static const char *integrals(size_t count) { return count == 1 ? "integral" : "integrals"; }

/* What is true of these values: a line of the list, without its values. */
static const char *statement(const nh_classified_absence *x, const nh_classified_value *v)
{
    if (v->side == NH_CLASSIFIED_FOUND) {
        size_t known = v->result->absence->known;
        return nh_arena_printf(x->arena, "found: %zu %s instead of %zu", known, integrals(known), x->fewest);
    }
    if (v->side == NH_CLASSIFIED_EXCLUDED)
        return nh_arena_printf(x->arena, "excluded (theorem): %s depends on the %zu %s found",
                               v->result->absence->rational ? "every rational one" : "every one of the class below",
                               x->fewest, integrals(x->fewest));
    return nh_arena_printf(x->arena, "undecided%s%s", v->why ? ": " : "", v->why ? v->why : "");
}

static const char *almost_all(const nh_classified_absence *x)
{
    if (x->generic)
        return nh_arena_printf(x->arena,
                               "For all other %s outside countably many: excluded (theorem, shown at %s = %s).",
                               x->over, x->over, x->generic_at);
    return nh_arena_printf(x->arena, "Of other %s nothing is said.", x->over);
}

/* Which integrals the theorem speaks of; NULL where nothing is excluded. */
static const char *class_of(const nh_classified_absence *x)
{
    const nh_closed_shape *shape = NULL;
    const char *left = "";
    for (size_t k = 0; k < x->values && !shape; k++)
        if (x->value[k].side == NH_CLASSIFIED_EXCLUDED) shape = x->value[k].result->absence->shape;
    if (!shape) return NULL;
    for (size_t i = 0; i < shape->left; i++)
        left = nh_arena_printf(x->arena, "%s%s, ", left, nh_name_of(shape->model->dag, shape->left_out[i]));
    return nh_arena_printf(x->arena,
                           "Of integrals without %st: those that are meromorphic near certain complex motions, and "
                           "periodic in angles. Others, as smooth ones, are not excluded.",
                           left);
}

static const char *headline(const nh_classified_absence *x)
{
    size_t found = nh_classified_absence_count(x, NH_CLASSIFIED_FOUND),
           excluded = nh_classified_absence_count(x, NH_CLASSIFIED_EXCLUDED);
    return nh_arena_printf(x->arena,
                           "Another integral, over %s %s: found at %zu of %zu values, excluded by a theorem at %zu, "
                           "undecided at %zu.%s",
                           x->over, x->range, found, x->values, excluded, x->values - found - excluded,
                           x->partial ? " The run was ended before." : "");
}

/* ---- the document ---- */

/* Of a value with more integrals: its formulas. */
static void show_currents(const nh_analysis *result, bool colour, nh_text *block)
{
    enum { most_lines = 3 };
    const nh_absence *a = result->absence;
    for (size_t k = 0; k < a->known; k++) {
        const nh_current *f = nh_absence_current(result, a->known_current[k]);
        char *text = nh_print_string(result->question->model->dag,
                                     nh_current_signed(result, f, nh_classification_formula(result, f)));
        nh_screen_put(block, colour, 4, nh_current_label(result, f), text, most_lines, NULL);
        nh_free(text);
    }
}

static void write_screen(const nh_classified_absence *x, bool colour, nh_text *out)
{
    enum { tail = 5 };
    const char *const open[3] = {x->over, NULL, NULL};
    nh_text words, block;
    nh_text_init(&words);
    nh_text_init(&block);
    nh_text_add(&words, headline(x));
    nh_screen_begin(out, colour, x->system, open, &words);
    nh_text_add(out, "\n");
    size_t left = 0;
    for (size_t side = 0; side < sizeof side_word / sizeof *side_word; side++)
        for (size_t k = 0; k < x->values; k++) {
            if (x->value[k].side != (nh_classified_side)side || listed(x, k)) continue;
            nh_screen_paragraph(2, NH_SCREEN_HANG,
                                nh_arena_printf(x->arena, "%s: %s", list(x, k), statement(x, &x->value[k])), &block);
            if (side == NH_CLASSIFIED_FOUND) show_currents(x->value[k].result, colour, &block);
            left += !nh_screen_fit(out, &block, tail);
        }
    if (left) nh_text_addf(out, "  %zu more lines: --details\n", left);
    nh_text_add(out, "\n");
    nh_screen_paragraph(0, 0, almost_all(x), out);
    if (class_of(x)) nh_screen_paragraph(0, 0, class_of(x), out);
    nh_screen_more(out, "of each value its motions, engines and reasons", NULL);
}

static void write_row(const nh_classified_absence *x, nh_pen *p, const nh_classified_value *v)
{
    const nh_absence *a = v->result ? v->result->absence : NULL;
    const char *motion = a ? motion_of(x, a) : NULL, *why = v->side == NH_CLASSIFIED_UNDECIDED ? v->why : NULL;
    nh_pen_row(p, "#%s%s|%s|%s|%s|%s", v->text, v->special ? " (special)" : "", side_word[v->side],
               a ? nh_arena_printf(x->arena, "%zu", a->known) : "", motion ? motion : "", why ? why : "");
}

void nh_classification_absence_write(const nh_classified_absence *x, const nh_run *run, nh_pen_style style,
                                     nh_text *out)
{
    if (nh_screen_is_wanted(style)) {
        write_screen(x, style.colour, out);
        return;
    }
    const nh_analysis *any = NULL;
    for (size_t k = 0; k < x->values && !any; k++) any = x->value[k].result;
    nh_pen_subject subject = {.system = x->system,
                              .dag = any ? any->question->model->dag : x->system->dag,
                              .chart = any ? any->question->model->chart : NULL,
                              .shown = run->shown,
                              .open = {x->over}};
    nh_pen all, *p = &all;
    nh_pen_begin(p, style, &subject, "classification", out);
    nh_pen_open(p, NH_PEN_ANSWER, "found", NULL);
    nh_pen_say(p, "%s", headline(x));
    nh_pen_close(p, NH_PEN_ANSWER);
    nh_pen_section(p, "values", "Values");
    nh_pen_table(p, "", nh_arena_printf(x->arena, "%s|another integral|#found|motions|why undecided", x->over));
    for (size_t k = 0; k < x->values; k++) write_row(x, p, &x->value[k]);
    nh_pen_table_end(p);
    nh_pen_words(p, "%s", almost_all(x));
    if (class_of(x)) nh_pen_words(p, "%s", class_of(x));
    if (x->no_special) nh_pen_words(p, "Special values were not searched for: %s.", x->no_special);
    if (any) nh_pen_system(p, any->question->model, NULL);
    nh_pen_glossary(p, "current, proved");
    nh_pen_end(p, run);
}

/* ---- JSON ---- */

/* The independent integrals that are found at a value. */
static void put_currents(const nh_analysis *result, nh_json *to)
{
    nh_json *list = nh_json_put_array(to, "currents");
    const nh_absence *a = result ? result->absence : NULL;
    for (size_t k = 0; a && k < a->known; k++) {
        const nh_current *f = nh_absence_current(result, a->known_current[k]);
        char *text = nh_print_short(result->question->model->dag, nh_classification_formula(result, f),
                                    result->question->options.written);
        nh_json *item = nh_json_add_object(list);
        nh_json_put_text(item, "name", f->name);
        nh_json_put_text(item, "current", text);
        nh_free(text);
    }
}

static void put_engines(const nh_absence *a, nh_json *to)
{
    nh_json *list = nh_json_put_array(to, "engines");
    if (!a) return;
    if (a->darboux && a->darboux->refuted) nh_json_add_text(list, "lines");
    if (a->best >= a->attempts) return;
    const nh_absence_attempt *t = &a->attempt[a->best];
    if (t->kovacic && t->kovacic->group == NH_GROUP_SL2) nh_json_add_text(list, "kovacic");
    if (t->monodromy && t->monodromy->rank == t->monodromy->size) nh_json_add_text(list, "monodromy");
    if (t->residues && t->residues->verdict != NH_RESIDUE_OPEN) nh_json_add_text(list, "residues");
    if (t->higher && t->higher->refuted) nh_json_add_text(list, "logarithm");
}

static void put_value(const nh_classified_absence *x, const nh_classified_value *v, nh_json *to)
{
    const nh_absence *a = v->result ? v->result->absence : NULL;
    nh_json *item = nh_json_add_object(to);
    nh_json_put_text(item, "value", v->text);
    nh_json_put_bool(item, "special", v->special);
    nh_json_put_text(item, "side", side_word[v->side]);
    nh_json_put_text(item, "verdict", a ? nh_absence_parts_verdict(a) : NULL);
    nh_json_put_number(item, "integrals", a ? (double)a->known : NAN);
    nh_json_put_text(item, "motion", a ? motion_of(x, a) : NULL);
    nh_json_put_text(item, "class",
                     a && v->side == NH_CLASSIFIED_EXCLUDED ? (a->rational ? "rational" : "meromorphic") : NULL);
    nh_json_put_text(item, "obstacle", v->side == NH_CLASSIFIED_UNDECIDED ? v->why : NULL);
    nh_json_put_text(item, "contradiction", a ? a->contradiction : NULL);
    put_engines(a, item);
    put_currents(v->result, item);
}

char *nh_classification_absence_json(const nh_classified_absence *x, const nh_run *run)
{
    nh_json *root = nh_json_object();
    nh_json_put_number(root, "schema", 1);
    nh_json_put_text(root, "version", NH_VERSION);
    nh_json_put_text(root, "system", x->system->name);
    nh_json_add_text(nh_json_put_array(root, "over"), x->over);
    nh_json *parameters = nh_json_put_object(root, "parameters");
    for (size_t i = 0; i < x->system->parameters; i++)
        if (strcmp(x->system->parameter[i].name, x->over))
            nh_json_put_number(parameters, x->system->parameter[i].name, x->system->parameter[i].value);
    nh_json_put_text(root, "of", "absence");
    nh_json_put_text(root, "range", x->range);
    nh_json_put_number(root, "fewest", x->fewest == SIZE_MAX ? NAN : (double)x->fewest);
    nh_json *list = nh_json_put_array(root, "values");
    for (size_t k = 0; k < x->values; k++) put_value(x, &x->value[k], list);
    for (size_t side = 0; side < sizeof side_word / sizeof *side_word; side++)
        nh_json_put_number(root, side_word[side], (double)nh_classified_absence_count(x, (nh_classified_side)side));
    nh_json_put_text(root, "speaks_of", class_of(x));
    nh_json_put_bool(root, "almost_all_excluded", x->generic);
    nh_json_put_text(root, "shown_at", x->generic_at);
    nh_json_put_text(root, "no_special_values_because", x->no_special);
    nh_json_put_bool(root, "partial", x->partial);
    nh_run_json(run, x->system, root);
    return nh_json_finish(root);
}
