#include "document/formula.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "exact/gather.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/print.h"

nh_ex nh_formula_shortened(const nh_analysis_file *a, nh_dag *d, nh_ex e)
{
    for (size_t i = a ? a->definitions : 0; i-- > 0;) {
        nh_kind kind = nh_kind_of(d, a->definition[i].value);
        if (kind == NH_NUMBER || kind == NH_SYMBOL) continue;
        nh_ex name = nh_symbol(d, a->definition[i].name), value = a->definition[i].value;
        bool root = kind == NH_PRODUCT && nh_arity(d, value) == 1 && nh_num_is(nh_constant_of(d, value), 1) &&
                    nh_exponent_of(d, value, 0) == nh_ratio(d, 1, 2);
        e = root ? nh_substitute_root(d, e, nh_child(d, value, 0), name) : nh_substitute(d, e, 1, &value, &name);
    }
    return nh_gather(d, e);
}

nh_ex nh_formula_shown(const nh_analysis *result, nh_ex e)
{
    return nh_chart_shown(result->question->other && result->question->other->chart->roots
                              ? result->question->other->chart
                              : result->question->model->chart,
                          e);
}

/* ---- names for repeated parts ---- */

enum {
    most_names = 120,
    long_formula = 120,
    largest_graph = 20000,
    least_gain = 12,
    formulas_per_block = 3,
    page_room = 4
};

/* How often does each node below n occur in the text of the formulas?  A node has a larger index than its children. */
static void occurrences(const nh_dag *d, size_t n, double *times)
{
    for (size_t e = n; e-- > 0;) {
        if (times[e] == 0) continue;
        nh_kind kind = nh_kind_of(d, (nh_ex)e);
        if (kind == NH_NUMBER || kind == NH_SYMBOL) continue;
        for (size_t i = 0; i < nh_arity(d, (nh_ex)e); i++) {
            times[nh_child(d, (nh_ex)e, i)] += times[e];
            if (kind == NH_PRODUCT) times[nh_exponent_of(d, (nh_ex)e, i)] += times[e];
        }
    }
}

/* The node whose name saves the most; false when no name saves enough.  What stands alone on a line needs no name. */
static bool most_repeated(const nh_dag *d, size_t formulas, const nh_ex *e, size_t parts, const nh_formula_part *part,
                          nh_ex *best)
{
    size_t n = nh_dag_size(d);
    double *times = nh_alloc_array(n + 1, sizeof *times), gain = least_gain;
    bool found = false;
    for (size_t i = 0; i < formulas; i++) times[e[i]] += 1;
    for (size_t i = 0; i < parts; i++) times[part[i].value] += 1;
    occurrences(d, n, times);
    for (size_t j = 0; j < n; j++) {
        if (times[j] < 2 || nh_kind_of(d, (nh_ex)j) == NH_NUMBER || nh_kind_of(d, (nh_ex)j) == NH_SYMBOL) continue;
        double saved = (times[j] - 1) * ((double)nh_complexity(d, (nh_ex)j) - 2);
        if (!(saved > gain)) continue;
        gain = saved;
        *best = (nh_ex)j;
        found = true;
    }
    nh_free(times);
    return found;
}

/* A letter with which no name of the graph begins, for names A_1, A_2, ... */
static char free_letter(const nh_dag *d)
{
    static const char letters[] = "ABCDGHKNPQSUVWXY";
    for (const char *c = letters; *c; c++) {
        char name[16];
        nh_ex taken;
        bool used = false;
        for (size_t i = 0; i <= most_names && !used; i++) {
            snprintf(name, sizeof name, i ? "%c_%zu" : "%c", *c, i);
            used = nh_symbol_find(d, name, &taken);
        }
        if (!used) return *c;
    }
    return 'Z';
}

/* The room of a formula beside others, or where nothing folds. */
static nh_formula_room block(double shown) { return (nh_formula_room){shown, formulas_per_block * shown, 1}; }

nh_formula_room nh_formula_page(double shown)
{
    return (nh_formula_room){page_room * shown, formulas_per_block * page_room * shown, page_room};
}

/* Is a formula left out of the document because it is too long? */
static bool too_long(const nh_dag *d, size_t n, const nh_ex *e, size_t parts, const nh_formula_part *part,
                     nh_formula_room room)
{
    double all = 0;
    bool longer = false;
    for (size_t i = 0; i < n + parts; i++) {
        double length = (double)nh_complexity(d, i < n ? e[i] : part[i - n].value);
        longer |= length > room.longest;
        all += length;
    }
    return longer || all > room.all;
}

size_t nh_formula_parts(nh_dag *d, size_t n, nh_ex *e, nh_formula_room room, nh_formula_part part[NH_FORMULA_PARTS])
{
    size_t count = 0, longest = 0, nodes = 0;
    char letter = free_letter(d);
    for (size_t i = 0; i < n; i++) {
        size_t length = nh_complexity(d, e[i]);
        if (length > longest) longest = length;
        nodes += nh_node_count(d, e[i]);
    }
    if (longest < long_formula || nodes > largest_graph) return 0;
    nh_formula_unify(d, n, e);
    for (nh_ex best; count < NH_FORMULA_PARTS && most_repeated(d, n, e, count, part, &best);) {
        if (count >= NH_FORMULA_FEW && !too_long(d, n, e, count, part, room)) break;
        nh_formula_part *p = &part[count];
        snprintf(p->name, sizeof p->name, "%c_%zu", letter, count + 1);
        p->value = best;
        nh_ex name = p->symbol = nh_symbol_fresh(d, p->name);
        for (size_t i = 0; i < n; i++) e[i] = nh_substitute(d, e[i], 1, &best, &name);
        for (size_t i = 0; i < count; i++) part[i].value = nh_substitute(d, part[i].value, 1, &best, &name);
        count++;
    }
    return count;
}

/* Marks the parts that e needs, directly or through others; values use later names only. */
static void need(nh_dag *d, nh_ex e, size_t parts, const nh_formula_part *part, bool *needed)
{
    NH_LIST(symbol);
    size_t n = nh_symbols_in(d, e, &symbol);
    for (size_t j = 0; j < n; j++)
        for (size_t k = 0; k < parts; k++)
            if (symbol[j] == part[k].symbol && !needed[k]) {
                needed[k] = true;
                need(d, part[k].value, parts, part, needed);
            }
}

double nh_formula_fit(nh_dag *d, size_t n, const nh_ex *e, size_t parts, const nh_formula_part *part,
                      nh_formula_room room, bool *stands, bool needed[NH_FORMULA_PARTS])
{
    bool known[NH_FORMULA_PARTS] = {false};
    double used_up = 0, all = 0, wanted = 0;
    memset(needed, 0, NH_FORMULA_PARTS * sizeof *needed);
    for (size_t i = 0; i < n; i++) {
        bool with[NH_FORMULA_PARTS];
        double length = (double)nh_complexity(d, e[i]), more = length, longest = length;
        memcpy(with, needed, sizeof with);
        need(d, e[i], parts, part, with);
        all += length;
        for (size_t k = 0; k < parts; k++) {
            if (!with[k]) continue;
            length = (double)nh_complexity(d, part[k].value);
            longest = fmax(longest, length);
            if (!needed[k]) more += length;
            if (!known[k]) all += length;
            known[k] = true;
        }
        wanted = fmax(wanted, longest);
        stands[i] = longest <= room.longest && used_up + more <= room.all;
        if (!stands[i]) continue;
        used_up += more;
        memcpy(needed, with, sizeof with);
    }
    return ceil((isfinite(room.all) ? fmax(wanted, all / formulas_per_block) : wanted) / room.times);
}

void nh_formula_number(nh_dag *d, size_t n, nh_ex *e, size_t parts, nh_formula_part *part, const bool *needed,
                       char letter, size_t *names)
{
    nh_ex from[NH_FORMULA_PARTS], to[NH_FORMULA_PARTS];
    size_t count = 0;
    for (size_t k = 0; k < parts; k++) {
        if (!needed[k]) continue;
        snprintf(part[k].name, sizeof part[k].name, "%c_%zu", letter ? letter : part[k].name[0], ++*names);
        from[count] = part[k].symbol;
        to[count++] = part[k].symbol = nh_symbol_fresh(d, part[k].name);
    }
    for (size_t i = 0; i < n; i++) e[i] = nh_substitute(d, e[i], count, from, to);
    for (size_t k = 0; k < parts; k++)
        if (needed[k]) part[k].value = nh_substitute(d, part[k].value, count, from, to);
}

nh_formula_list nh_formula_list_make(nh_dag *d, size_t n, const nh_ex *e, double shown, size_t *names)
{
    nh_formula_list l = {.formula = nh_alloc_array(n + 1, sizeof *l.formula),
                         .stands = nh_alloc_array(2 * n + 1, sizeof *l.stands)};
    l.short_enough = l.stands + n;
    if (n) memcpy(l.formula, e, n * sizeof *e);
    const nh_formula_room least = block(shown), room = nh_formula_page(shown);
    l.parts = nh_formula_parts(d, n, l.formula, least, l.part);
    nh_formula_fit(d, n, l.formula, l.parts, l.part, least, l.short_enough, l.beside);
    l.wanted = nh_formula_fit(d, n, l.formula, l.parts, l.part, room, l.stands, l.needed);
    for (size_t i = 0; i < n; i++) l.short_enough[i] &= l.stands[i];
    for (size_t k = 0; k < l.parts; k++) l.named |= l.needed[k];
    nh_formula_number(d, n, l.formula, l.parts, l.part, l.needed, 0, names);
    return l;
}

void nh_formula_list_clear(nh_formula_list *l)
{
    nh_free(l->formula);
    nh_free(l->stands);
}

/* ---- fields ---- */

static void add_term(const nh_model *model, nh_field_term *list, size_t *n, nh_ex e, const char *along)
{
    if (!nh_is_zero(model->dag, e)) list[(*n)++] = (nh_field_term){e, along};
}

size_t nh_formula_field(const nh_analysis *result, const nh_symmetry *z, nh_field_term **out)
{
    const nh_model *model = result->question->model, *basis = result->question->other ? result->question->other : model;
    const nh_field *f = z->along_motion ? &z->relative : &z->field;
    const nh_ex *rate = z->along_motion ? z->relative_rate : z->coordinate_rate;
    size_t n = 0;
    nh_field_term *list = *out = nh_arena_alloc(model->arena, (2 + model->m + basis->n) * sizeof *list);
    if (z->along_motion) add_term(model, list, &n, z->Z0, NULL);
    add_term(model, list, &n, f->time, "t");
    for (size_t s = 0; s < model->m; s++)
        add_term(model, list, &n, f->space[s], result->question->system->coordinate[s].name);
    for (size_t i = 0; i < basis->n; i++) {
        nh_ex e = result->question->other ? 0 : f->velocity[i];
        for (size_t s = 0; s < model->m && result->question->other; s++)
            if (basis->chart->w[i] == result->question->system->coordinate[s].v) e = rate[s];
        add_term(model, list, &n, e, nh_name_of(model->dag, basis->chart->w[i]));
    }
    return n;
}

void nh_formula_left_out(double wanted, nh_text *out)
{
    if (wanted < 1e9) nh_text_addf(out, "... (too long to be shown; --option shown=%.0f shows it)", wanted);
    else nh_text_add(out, "... (too long to be shown)");
}

char *nh_formula_text(nh_dag *d, nh_ex e, double shown)
{
    nh_text words;
    char *text = nh_print_short(d, e, shown);
    if (text) return text;
    nh_text_init(&words);
    nh_formula_left_out((double)nh_complexity(d, e), &words);
    text = nh_strdup(nh_text_string(&words));
    nh_text_clear(&words);
    return text;
}

bool nh_formula_is_sum(const char *text)
{
    int depth = 0;
    for (const char *c = text; *c; c++) {
        depth += (*c == '(') - (*c == ')');
        if (depth == 0 && *c == ' ' && (c[1] == '+' || c[1] == '-')) return true;
    }
    return false;
}

const char *nh_formula_doubt(const nh_current *f)
{
    if (f->exact) return " (not proved)";
    return f->asked && f->refined >= f->proof.digits ? " with its coefficients refined"
                                                     : " (coefficients fitted in double precision)";
}
