#include "document/analysis.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "document/absence_words.h"
#include "document/current_words.h"
#include "document/facts.h"
#include "document/formula.h"
#include "document/screen.h"
#include "document/sheet.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "graph/print.h"
#include "integrals/fixed.h"
#include "search/explicit_motion.h"

enum { formula_lines = 6, short_lines = 2, few_equations = 8 };

typedef struct {
    const nh_analysis *r;
    nh_text *out;
    bool colour;
    /* what is left out where the full answer does not fit: SHORT: long formulas; PLAIN: symmetries whose words
     * take a line as well; BARE: formulas with names for their parts; LIST: all sentences */
    enum { FULL, SHORT, PLAIN, BARE, LIST } terse;
    bool all_proved;         /* every quantity */
    bool *written;           /* of each: was its formula? */
    const char *energy;      /* "T + V", or NULL */
    const char **proof;      /* of each: "for all m, k", or the sentence that says how sure it is */
    nh_ex *shown;            /* of each: its formula */
    nh_current_words *words; /* of each */
    nh_formula_list list;    /* of the quantities, with common names for repeated parts */
} screen;

static void say(const screen *x, size_t indent, nh_text *words) { nh_screen_say(x->out, indent, words); }

/* ---- the headline ---- */

static const nh_completeness *counted_first(const nh_analysis *r)
{
    const nh_completeness *c = &r->completeness[r->completeness[0].counted ? 0 : 1];
    return c->counted && !c->count.obstacle ? c : NULL;
}

/* Why more may exist than were found; "" where all was tried. */
static const char *left_open(const nh_analysis *r)
{
    if (r->search == NH_SEARCH_COMPLETE) return "";
    if (r->search == NH_SEARCH_CUT) return "A limit ended the search early: more may exist.";
    if (nh_analysis_left_out(r)) return "Parts of the search were too large and left out (--details): more may exist.";
    if (nh_analysis_by_trial(r)) return nh_facts_search(r);
    if (nh_facts_given(r) && !r->stages) return "Only the ansatz of the analysis file was tried.";
    return "";
}

/* Every quantity. */
static bool all_proved(const nh_analysis *r)
{
    const nh_current_list *list = r->list;
    bool all = true;
    for (size_t k = 0; k < list->count; k++) all = all && list->found[k].proof.proved && !list->found[k].series;
    return all;
}

void nh_analysis_answer_headline(const nh_analysis *r, nh_text *out)
{
    const nh_current_list *list = r->list;
    size_t n = list->independent, most = r->question->local_maximum;
    const char *proved = all_proved(r) ? " and proved" : "", *found = r->verdict == NH_FITTED ? "fitted" : "found";
    size_t ends = nh_analysis_to_the_end(r);
    if (!list->count && r->verdict == NH_FOUND)
        nh_text_addf(out, "%zu quantit%s conserved until motions end. At most %zu can exist.", ends,
                     ends == 1 ? "y is" : "ies are", most);
    else if (!list->count && r->verdict == NH_NONE) nh_text_add(out, "Nothing that was tried is conserved.");
    else if (!list->count && list->pieces) nh_text_add(out, "Nothing was found that is conserved along all motions.");
    else if (!list->count) nh_text_add(out, "Undecided: nothing was found that is surely conserved.");
    else if (n == most && n == 1)
        nh_text_addf(out, "The only conserved quantity that can exist was %s%s.", found, proved);
    else if (n == most) nh_text_addf(out, "All %zu conserved quantities that can exist were %s%s.", n, found, proved);
    else if (n == 1 && nh_current_is_energy(&list->found[0]))
        nh_text_addf(out, "Only the energy is conserved, as far as was looked%s. At most %zu quantities can be.",
                     nh_absence_words_headline(r), most);
    else
        nh_text_addf(out, "%zu independent conserved quantit%s %s. At most %zu can exist.", n,
                     n == 1 ? "y was" : "ies were", found, most);
    const nh_explicit_motion *m = r->motion;
    if (list->count && m && m->proved && m->known == m->states && !m->integrals)
        nh_text_addf(out, " The motion is known in closed form%s%s%s.", m->fixed ? " for " : "",
                     m->fixed ? nh_fixed_text(r->question->model, m->fixed) : "", m->region ? ", piece by piece" : "");
    if (*left_open(r)) nh_text_addf(out, " %s", left_open(r));
}

static void headline(const screen *x)
{
    nh_text words;
    nh_text_init(&words);
    nh_analysis_answer_headline(x->r, &words);
    nh_screen_begin(x->out, x->colour, x->r->question->system, NULL, &words);
}

/* ---- the quantities ---- */

nh_ex nh_analysis_answer_shown(const nh_analysis *r, const nh_current *f)
{
    nh_ex e = nh_chart_shown(r->question->model->chart, nh_current_plain(r, f));
    return nh_formula_shortened(r->question->analysis, r->question->model->dag, e);
}

/* "2  p_x = m*x'"; NULL: the words in its place.  Was the formula written? */
static bool put_formula(const screen *x, size_t number, const char *label, char *formula, const char *instead)
{
    const char *head = nh_arena_printf(x->r->arena, "%-*zu%s", number < 10 ? 3 : 4, number, label);
    bool written = nh_screen_put(x->out, x->colour, 0, head, formula, x->terse ? short_lines : formula_lines, instead);
    nh_free(formula);
    return written;
}

/* "1 to 3, 5": the quantities that are marked; how many. */
static size_t put_numbers(const screen *x, const bool *marked, nh_text *out)
{
    size_t members = 0, n = x->r->list->count;
    for (size_t i = 0, end; i < n; i = end + 1) {
        end = i;
        if (!marked[i]) continue;
        while (end + 1 < n && marked[end + 1]) end++;
        nh_text_addf(out, members ? ", %zu" : "%zu", i + 1);
        if (end > i) nh_text_addf(out, end == i + 1 ? ", %zu" : " to %zu", end + 1);
        members += end - i + 1;
    }
    return members;
}

/* "1 to 3 are proved for all m, k; 4 for k = 2." */
static void put_proofs(const screen *x)
{
    const nh_analysis *r = x->r;
    const nh_current_list *list = r->list;
    size_t groups = 0;
    nh_text words;
    if (!list->count) return;
    nh_text_init(&words);
    bool *same = nh_alloc_array(list->count, sizeof *same);
    for (size_t k = 0; k < list->count; k++) {
        size_t first = 0, members = 0;
        while (strcmp(x->proof[first], x->proof[k])) first++;
        if (first < k) continue;
        nh_text_add(&words, groups ? "; " : "");
        bool all = true;
        for (size_t i = 0; i < list->count; i++) all &= same[i] = !strcmp(x->proof[i], x->proof[k]);
        if (!all) members = put_numbers(x, same, &words);
        if (all)
            nh_text_add(&words, list->count == 1 ? "Proved" : list->count == 2 ? "Both are proved" : "All are proved");
        else if (!groups) nh_text_add(&words, members > 1 ? " are proved" : " is proved");
        nh_text_add(&words, x->proof[k][0] || all || !groups ? x->proof[k] : " for all parameter values");
        groups++;
    }
    nh_free(same);
    nh_text_add(&words, ".");
    say(x, list->count == 1 ? 3 : 0, &words);
}

/* Those that are functions on the coverings of the angles' circles only. */
static void put_local(const screen *x)
{
    const nh_analysis *r = x->r;
    const nh_current_list *list = r->list;
    nh_text words;
    nh_text_init(&words);
    bool *local = nh_alloc_array(list->count + 1, sizeof *local);
    for (size_t k = 0; k < list->count; k++)
        local[k] = list->found[k].local && list->found[k].independence != NH_DEPENDENT;
    size_t n = put_numbers(x, local, &words);
    if (n) nh_text_addf(&words, " change%s when an angle makes a full turn.", n == 1 ? "s" : "");
    say(x, 0, &words);
    nh_free(local);
}

static bool has_parts(const screen *x, size_t k)
{
    for (size_t i = 0; i < x->list.parts; i++)
        if (nh_depends(x->r->question->model->dag, x->list.formula[k], x->list.part[i].symbol)) return true;
    return false;
}

static void put_quantity(const screen *x, size_t k)
{
    const nh_analysis *r = x->r;
    const nh_current *f = &r->list->found[k];
    bool written = !f->series && x->list.stands[k] && !(x->terse >= BARE && has_parts(x, k));
    char *formula = written ? nh_print_string(r->question->model->dag, x->list.formula[k]) : NULL;
    x->written[k] = put_formula(x, k + 1, nh_current_label(r, f), formula,
                                f->series                 ? "a series (--details)"
                                : nh_current_is_energy(f) ? x->energy
                                                          : NULL);
}

static bool fits_line(size_t indent, size_t n, const nh_current_words *s, nh_text *out)
{
    nh_current_words_put(n, s, out);
    return indent + out->length <= 80 + 1; /* 1: the blank at its end */
}

/* The formulas, and below those that belong together what they are. */
static void put_quantities(const screen *x)
{
    size_t n = x->r->list->count;
    const nh_current_words *full = x->words;
    nh_current_words *s = nh_arena_alloc(x->r->arena, (n + 1) * sizeof *s);
    nh_text text;
    nh_text_init(&text);
    for (size_t k = 0; k < n; k++) {
        s[k] = full[k];
        if (x->terse >= PLAIN) s[k].how = s[k].what = "";
    }
    for (size_t k = 0, end; k < n; k = end) {
        bool alike = true;
        for (end = k; end < n && (end == k || nh_current_words_agree(&s[k], &s[end])); end++) {
            alike &= nh_current_words_agree(&full[k], &full[end]);
            put_quantity(x, end);
        }
        size_t indent = end < 10 ? 3 : 4;
        if (x->terse < PLAIN) nh_current_words_put(end - k, full + k, &text);
        else if (!alike || !fits_line(indent, end - k, full + k, &text))
            nh_text_clear(&text), nh_current_words_put(end - k, s + k, &text);
        if (x->terse == LIST) nh_text_clear(&text);
        say(x, indent, &text);
    }
}

/* "A_1 = x^2 + y^2". */
static void put_part(const screen *x, const char *name, const char *value)
{
    nh_text block;
    const char *line = nh_arena_printf(x->r->arena, "%s = %s", name, value);
    nh_text_init(&block);
    nh_screen_broken(NH_SCREEN_HANG - 1, 2 * NH_SCREEN_HANG, line, &block);
    nh_screen_formula(x->out, x->colour, nh_text_string(&block));
    nh_text_clear(&block);
}

/* The names of repeated parts that the written formulas need, once for all quantities: those that the analysis file
 * defines, then those of the program.  Each part uses later names only. */
static void put_parts(const screen *x)
{
    nh_dag *d = x->r->question->model->dag;
    bool used[NH_FORMULA_PARTS] = {false};
    const nh_analysis_file *file = x->r->question->analysis;
    for (size_t i = 0; file && i < file->definitions; i++)
        for (size_t k = 0; k < x->r->list->count; k++) {
            if (!x->written[k] || !nh_depends(d, x->list.formula[k], nh_symbol(d, file->definition[i].name))) continue;
            put_part(x, file->definition[i].name, file->definition[i].text);
            break;
        }
    for (size_t i = 0; i < x->list.parts && x->list.named; i++) {
        const nh_formula_part *part = x->list.part;
        for (size_t k = 0; k < x->r->list->count; k++)
            used[i] |= x->written[k] && nh_depends(d, x->list.formula[k], part[i].symbol);
        for (size_t j = 0; j < i; j++) used[i] |= used[j] && nh_depends(d, part[j].value, part[i].symbol);
        if (!used[i]) continue;
        char *value = nh_print_string(d, x->list.part[i].value);
        put_part(x, x->list.part[i].name, value);
        nh_free(value);
    }
}

/* What is constant in a part of the motions only. */
static void put_regions(const screen *x)
{
    const nh_analysis *r = x->r;
    const nh_current_list *list = r->list;
    for (size_t k = 0; k < list->pieces; k++) {
        const nh_current *f = &list->piece[k];
        nh_text words;
        nh_text_init(&words);
        char *formula =
            nh_print_short(r->question->model->dag, nh_analysis_answer_shown(r, f), r->question->options.shown);
        put_formula(x, list->count + k + 1, "", formula, NULL);
        nh_text_addf(&words, "Constant only %s. %s%s.", f->region, f->proof.proved ? "Proved" : "",
                     nh_facts_proof(r, f));
        say(x, list->count + k < 9 ? 3 : 4, &words);
    }
}

static void quantities(screen *x)
{
    const nh_analysis *r = x->r;
    const nh_current_list *list = r->list;
    size_t names = 0;
    x->list = nh_formula_list_make(r->question->model->dag, list->count, x->shown, r->question->options.shown, &names);
    if (list->count) nh_text_add(x->out, "\n");
    put_quantities(x);
    put_parts(x);
    nh_formula_list_clear(&x->list);
    if (x->all_proved) put_proofs(x);
    put_local(x);
    put_regions(x);
}

/* ---- can there be more? ---- */

/* "x and y", "t, x and y", "t and the coordinates" */
static const char *functions_of(const nh_analysis *r, bool time)
{
    enum { most_named = 4 };
    const nh_system *s = r->question->system;
    if (s->coordinates > most_named) return time ? "t and the coordinates" : "the coordinates";
    const char *text = time ? "t" : "";
    for (size_t i = 0; i < s->coordinates; i++)
        text = nh_arena_printf(r->arena, "%s%s%s", text,
                               !*text                   ? ""
                               : i + 1 < s->coordinates ? ", "
                                                        : " and ",
                               s->coordinate[i].name);
    return text;
}

/* Is the statement the usual one: all integrals are polynomials in those found, everywhere, and all are proved? */
static bool is_plain(const nh_analysis *r, const nh_completeness *c)
{
    return c->degree && c->linear && !c->regional && !c->count.where && !c->count.leaf && all_proved(r);
}

void nh_analysis_answer_completeness(const nh_analysis *r, nh_text *out)
{
    const nh_completeness *c = counted_first(r), *time = &r->completeness[NH_COMPLETE_IN_TIME];
    if (r->search == NH_SEARCH_COMPLETE && r->list->independent >= r->question->local_maximum) return;
    if (!c || !is_plain(r, c)) {
        nh_facts_completeness(r, out);
    } else {
        nh_text_addf(out,
                     "Nothing else is conserved among polynomials in the velocities up to degree %zu, with any "
                     "functions of %s as coefficients",
                     c->degree, functions_of(r, c == time));
        bool timed = c != time && time->counted && !time->count.obstacle && time->degree;
        if (timed && time->degree < c->degree)
            nh_text_addf(out, " (up to degree %zu if they may contain t)", time->degree);
        else if (timed) nh_text_add(out, ", which may contain t");
        nh_text_addf(out, "%s: proved.", r->list->count ? ", apart from combinations of these" : "");
        const nh_completeness *open = c->missing_at ? c : timed && time->missing_at ? time : NULL;
        if (open)
            nh_text_addf(out, " At degree %zu%s %zu more %s not ruled out.", open->missing_at,
                         open == time && c != time ? ", with t in the coefficients," : "", open->missing,
                         open->missing == 1 ? "is" : "are");
    }
}

static void completeness(const screen *x)
{
    enum { absence_lines = 4 };
    nh_text words;
    nh_text_init(&words);
    nh_analysis_answer_completeness(x->r, &words);
    say(x, 0, &words);
    const char *absence = nh_absence_words_short(x->r, absence_lines);
    nh_text_add(&words, absence ? absence : "");
    say(x, 0, &words);
}

/* ---- the motion that checks it, and the equations ---- */

static void motion(const screen *x)
{
    const nh_analysis *r = x->r;
    const nh_current_list *list = r->list;
    const nh_validation *v = r->validation;
    double worst = 0;
    size_t measured = 0;
    for (size_t k = 0; k < list->count && v; k++) {
        double drift = list->found[k].drift.drift[NH_DRIFT_RUNS - 1];
        if (isfinite(drift)) worst = fmax(worst, drift), measured++;
    }
    if (!measured) return;
    nh_text words;
    nh_text_init(&words);
    nh_text_addf(&words, "Along a computed motion (t = %.4g to %.4g) ", v->begin, v->end);
    if (measured < list->count)
        nh_text_addf(&words, "%zu of them could be followed: %s", measured,
                     measured > 1 ? "they change" : "it changes");
    else nh_text_add(&words, measured > 1 ? "they change" : "it changes");
    nh_text_addf(&words, " by %s%.2g, relative to %s terms.", measured > 1 ? "at most " : "", worst,
                 measured > 1 ? "their" : "its");
    double other = v->multistep ? v->multistep_difference : v->multiplier_form ? v->state_difference : NAN;
    if (isfinite(other))
        nh_text_addf(&words,
                     other > NH_MOTIONS_APART ? " Another method gives another motion: states differ by %.2g."
                                              : " Another method gives the same motion to %.2g.",
                     other);
    say(x, 0, &words);
}

/* "The constraint  y' = x'*tan(phi)  is nonholonomic." */
static void put_constraints(const screen *x, nh_text *out)
{
    enum { most_written = 3 };
    const nh_analysis *r = x->r;
    const nh_system *s = r->question->system;
    if (!r->question->model->k) return;
    nh_text words;
    nh_text_init(&words);
    nh_text_addf(&words, "The %s", s->constraints == 1 ? "constraint" : "constraints");
    for (size_t a = 0; a < s->constraints && s->constraints <= most_written; a++)
        nh_text_addf(&words, "%s %s", a ? "," : "", s->constraint[a].text);
    nh_text_addf(&words, " %s %s.", s->constraints == 1 ? "is" : "are",
                 nh_constraint_integrability(r->question->model, &r->question->constraint));
    nh_screen_paragraph(0, 0, nh_text_string(&words), out);
    nh_text_clear(&words);
}

/* The equations of motion, where they take few lines. */
static void equations(const screen *x, size_t room)
{
    const nh_analysis *r = x->r;
    const nh_model *o = r->question->model;
    bool all = true;
    nh_text block;
    nh_text_init(&block);
    put_constraints(x, &block);
    for (size_t s = 0; s < o->m && all && o->chart->quasi && !o->framed; s++)
        all = nh_screen_equation(nh_arena_printf(o->arena, "%s'", o->system->coordinate[s].name), o->dag, o->rho[s],
                                 &block);
    for (size_t i = 0; i < o->n && all; i++) {
        nh_ex a = nh_chart_shown(o->chart, o->a[i]);
        all = nh_screen_equation(nh_arena_printf(o->arena, "%s'", nh_name_of(o->dag, o->chart->w[i])), o->dag,
                                 nh_formula_shortened(r->question->analysis, o->dag, a), &block);
    }
    size_t n = nh_screen_count(nh_text_string(&block));
    bool fits = all && (n <= few_equations || n <= room);
    if (fits) nh_text_addf(x->out, "\n%s", nh_text_string(&block));
    nh_text_clear(&block);
}

static void more(const screen *x)
{
    const nh_analysis *r = x->r;
    nh_screen_more(x->out,
                   r->motion               ? "symmetries, equations, the motion, checks, the search"
                   : r->question->model->k ? "symmetries, equations, constraint forces, checks, the search"
                                           : "symmetries, equations, checks, the search",
                   "--html FILE the same, with the motion, in a page");
}

static void furthers(const screen *x)
{
    nh_text words;
    if (!x->r->list->furthers) return;
    nh_text_init(&words);
    nh_text_addf(&words, "%zu further polynomial%s conserved too, as %s of these (--details)", x->r->list->furthers,
                 x->r->list->furthers > 1 ? "s are" : " is", x->r->list->furthers > 1 ? "functions" : "a function");
    nh_current_words first = {.name = ""}, *s = nh_arena_alloc(x->r->arena, x->r->list->furthers * sizeof *s);
    bool alike = true;
    for (size_t i = 0; i < x->r->list->furthers; i++) {
        s[i] = nh_current_words_of(x->r, &x->r->list->further[i].current, false, NULL);
        s[i].rest = "";
        if (!i) first = s[i];
        alike &= nh_current_words_agree(&s[i], &first);
    }
    nh_text_add(&words, alike && *first.of ? ": " : ".");
    if (alike && *first.of) nh_current_words_put(x->r->list->furthers, s, &words);
    say(x, 0, &words);
}

static void warnings(const screen *x, size_t from, size_t to)
{
    for (size_t i = from; i < to; i++)
        nh_screen_paragraph(0, 2, nh_arena_printf(x->r->arena, "Warning: %s", x->r->warning[i]), x->out);
}

static void write(screen *x)
{
    enum { tail = 3 };
    const nh_analysis *r = x->r;
    /* what was noted when the file was read: the answer may be that of another system than was meant */
    size_t notes = 0;
    while (notes < r->question->system->notes && notes < r->warnings &&
           !strcmp(r->warning[notes], r->question->system->note[notes]))
        notes++;
    headline(x);
    warnings(x, 0, notes);
    quantities(x);
    nh_text_add(x->out, "\n");
    completeness(x);
    furthers(x);
    motion(x);
    warnings(x, notes, r->warnings);
    size_t n = nh_screen_count(nh_text_string(x->out)) + tail + 1;
    equations(x, n < NH_SCREEN_LINES ? NH_SCREEN_LINES - n : 0);
    more(x);
}

void nh_analysis_write_answer(const nh_analysis *r, bool colour, nh_text *out)
{
    nh_text text;
    nh_text_init(&text);
    screen x = {.r = r, .out = &text, .colour = colour, .all_proved = all_proved(r)};
    x.proof = nh_arena_alloc(r->arena, (r->list->count + 1) * sizeof *x.proof);
    x.written = nh_arena_alloc(r->arena, (r->list->count + 1) * sizeof *x.written);
    x.shown = nh_arena_alloc(r->arena, (r->list->count + 1) * sizeof *x.shown);
    x.words = nh_arena_alloc(r->arena, (r->list->count + 1) * sizeof *x.words);
    for (size_t k = 0; k < r->list->count; k++) {
        x.proof[k] = nh_facts_proof(r, &r->list->found[k]);
        x.shown[k] = nh_analysis_answer_shown(r, &r->list->found[k]);
        x.words[k] = nh_current_words_of(r, &r->list->found[k], true, x.all_proved ? NULL : x.proof[k]);
        if (nh_current_is_energy(&r->list->found[k])) x.energy = nh_current_energy_named(r);
    }
    write(&x);
    while (nh_screen_count(nh_text_string(&text)) > NH_SCREEN_LINES && x.terse < LIST) {
        nh_text_clear(&text);
        x.terse++;
        write(&x);
    }
    nh_text_add(out, nh_text_string(&text));
    nh_text_clear(&text);
}
