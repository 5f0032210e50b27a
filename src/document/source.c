#include "document/source.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "document/source_internal.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"

enum { most_nodes = 60, most_terms = 24 }; /* longest expression in one statement; most terms of a sum */

/* ---- names ---- */

void nh_source_identifier(const nh_source_language *l, const char *text, nh_text *out)
{
    size_t dashes = 0;
    if (!isalpha((unsigned char)*text)) nh_text_add(out, "x");
    for (const char *c = text; *c; c++) {
        bool fits = isalnum((unsigned char)*c) || *c == '_';
        if (*c == '\'' && !l->plain) dashes++;
        else nh_text_add_n(out, fits || (l->plain && *c == '\'') ? c : "_", 1);
    }
    if (dashes) nh_text_addf(out, "_%.*s%s", (int)(dashes - 1 < 4 ? dashes - 1 : 4), "dddd", "dot");
}

/* Is it one of the words, which blanks separate? */
static bool among(const char *words, const char *word)
{
    size_t n = strlen(word);
    for (const char *at = words; n && (at = strstr(at, word)); at += n)
        if (at > words && at[-1] == ' ' && at[n] == ' ') return true;
    return false;
}

static bool taken(const nh_source *w, const char *word)
{
    if (among(w->language->reserved, word)) return true;
    for (size_t i = 0; i < w->words; i++)
        if (!strcmp(w->word[i], word)) return true;
    return false;
}

const char *nh_source_word(nh_source *w, const char *wish)
{
    nh_text text;
    nh_text_init(&text);
    nh_source_identifier(w->language, wish, &text);
    char *word = nh_arena_strdup(w->arena, nh_text_string(&text));
    for (size_t i = 2; taken(w, word); i++)
        word =
            w->language->plain ? nh_arena_printf(w->arena, "%s_%zu", wish, i) : nh_arena_printf(w->arena, "%s_", word);
    nh_text_clear(&text);
    nh_grow(&w->word, &w->capacity, w->words + 1, sizeof *w->word);
    return w->word[w->words++] = word;
}

void nh_source_set(nh_source *w, nh_ex symbol, const char *words)
{
    w->name[symbol] = nh_arena_strdup(w->arena, words);
}

const char *nh_source_name(nh_source *w, nh_ex symbol)
{
    if (!w->name[symbol]) w->name[symbol] = nh_source_word(w, nh_name_of(w->dag, symbol));
    return w->name[symbol];
}

/* ---- statements ---- */

nh_source *nh_source_create(const nh_source_language *language, nh_dag *dag, nh_text *out)
{
    nh_source *w = nh_alloc(sizeof *w);
    size_t size = nh_dag_size(dag);
    *w = (nh_source){
        .language = language, .dag = dag, .out = out, .arena = nh_arena_create(), .size = size, .indent = ""};
    w->uses = nh_alloc_array(size + 1, sizeof *w->uses);
    w->name = nh_alloc_array(size + 1, sizeof *w->name);
    w->reach = nh_alloc_array(size + 1, sizeof *w->reach);
    w->nodes = nh_alloc_array(size + 1, sizeof *w->nodes);
    return w;
}

void nh_source_free(nh_source *w)
{
    if (!w) return;
    nh_free(w->uses);
    nh_free(w->name);
    nh_free(w->reach);
    nh_free(w->nodes);
    nh_free(w->word);
    nh_free(w->outer.uses);
    nh_free(w->outer.name);
    nh_arena_free(w->arena);
    nh_free(w);
}

void nh_source_indent(nh_source *w, const char *indent) { w->indent = indent; }
bool nh_source_has_sign(const nh_source *w) { return w->sign; }

void nh_source_libraries(const nh_source_language *language, const char *code, nh_text *out)
{
    for (size_t i = 0; i < 2; i++)
        if (language->library[i][0] && strstr(code, language->library[i][0])) nh_text_add(out, language->library[i][1]);
}

void nh_source_series(const nh_source_language *language, const char *code, nh_text *out)
{
    if (language->series[0] && strstr(code, language->series[0])) nh_text_add(out, language->series[1]);
}

const char *nh_source_lacks(const nh_source_language *language, const nh_dag *dag, nh_ex e)
{
    NH_LIST(call);
    size_t n = nh_functions_in(dag, e, &call);
    for (size_t i = 0; i < n && !language->plain; i++) {
        nh_function f = nh_function_of(dag, call[i]);
        if (nh_is_named_function(f) && !language->named[f]) return nh_function_name(f);
    }
    return NULL;
}
void nh_source_whole(nh_source *w) { w->whole = true; }

static bool is_leaf(const nh_source *w, nh_ex e)
{
    return nh_kind_of(w->dag, e) == NH_NUMBER || nh_kind_of(w->dag, e) == NH_SYMBOL ||
           (nh_kind_of(w->dag, e) == NH_FUNCTION && nh_arity(w->dag, e) == 0);
}

/* The children of a node that are printed, and how often: x^3 as a product has its base three times. */
static size_t children(const nh_source *w, nh_ex e, size_t i, nh_ex out[2], uint32_t times[2])
{
    const nh_dag *d = w->dag;
    out[0] = nh_child(d, e, i);
    times[0] = 1;
    if (nh_kind_of(d, e) != NH_PRODUCT) return 1;
    out[1] = nh_exponent_of(d, e, i);
    times[1] = 1;
    if (nh_kind_of(d, out[1]) != NH_NUMBER) return 2;
    nh_num power = nh_number_of(d, out[1]);
    if (nh_num_value(power) < 0) power = nh_num_mul(power, nh_num_int(-1));
    if (nh_source_small_power(w, power) > 1) times[0] = 2;
    return 1;
}

/* Parents have larger indices than their children. */
void nh_source_plan(nh_source *w, size_t n, const nh_ex *e)
{
    nh_ex child[2];
    uint32_t times[2];
    size_t top = 0;
    for (size_t i = 0; i < n; i++) {
        if (!w->uses[e[i]]++) w->reach[e[i]] = 1;
        if (e[i] >= top) top = (size_t)e[i] + 1;
    }
    for (size_t at = top; at-- > 0;) {
        nh_ex x = (nh_ex)at;
        if (!w->reach[x]) continue;
        w->reach[x] = 0;
        if (is_leaf(w, x)) continue;
        for (size_t i = 0; i < nh_arity(w->dag, x); i++)
            for (size_t k = children(w, x, i, child, times); k-- > 0;) {
                if (!w->uses[child[k]]) w->reach[child[k]] = 1;
                w->uses[child[k]] += times[k];
            }
    }
}

static const char *next_name(nh_source *w)
{
    char wish[40];
    do snprintf(wish, sizeof wish, "s%zu", ++w->count);
    while (taken(w, wish));
    return nh_source_word(w, wish);
}

static void begin(nh_source *w, const char *name)
{
    nh_text_addf(w->out, "%s%s%s = ", w->indent, w->language->declare, name);
}
static void end(nh_source *w) { nh_text_addf(w->out, "%s\n", w->language->end); }

/* Writes a sum of many terms in several statements. */
static void state_sum(nh_source *w, nh_ex e)
{
    const char *so_far = NULL;
    size_t n = nh_arity(w->dag, e);
    for (size_t i = 0; i < n; i += most_terms) {
        size_t last = i + most_terms < n ? i + most_terms : n;
        const char *name = next_name(w);
        begin(w, name);
        if (so_far) {
            nh_text_add(w->out, so_far);
            for (size_t k = i; k < last; k++) nh_source_put_term(w, e, k, false);
        } else {
            nh_source_put_terms(w, e, i, last);
        }
        end(w);
        so_far = name;
    }
    w->name[e] = so_far;
}

static void state(nh_source *w, nh_ex e)
{
    if (nh_kind_of(w->dag, e) == NH_SUM && nh_arity(w->dag, e) > most_terms) {
        state_sum(w, e);
        return;
    }
    const char *name = next_name(w);
    begin(w, name);
    nh_source_put_inside(w, e, NH_IN_SUM);
    end(w);
    w->name[e] = name;
}

/* Marks the nodes that e needs and that are not written yet; returns one more than the largest index in e. */
static size_t reach(nh_source *w, size_t n, const nh_ex *e)
{
    nh_ex child[2];
    uint32_t times[2];
    size_t top = 0;
    for (size_t i = 0; i < n; i++) {
        w->reach[e[i]] = 1;
        if (e[i] >= top) top = (size_t)e[i] + 1;
    }
    for (size_t at = top; at-- > 0;) {
        nh_ex x = (nh_ex)at;
        if (!w->reach[x] || w->name[x] || is_leaf(w, x)) continue;
        for (size_t i = 0; i < nh_arity(w->dag, x); i++)
            for (size_t k = children(w, x, i, child, times); k-- > 0;) w->reach[child[k]] = 1;
    }
    return top;
}

/* -x, 2*x: a name would be longer. */
static bool light(const nh_source *w, nh_ex e)
{
    return nh_kind_of(w->dag, e) == NH_PRODUCT && nh_arity(w->dag, e) == 1 &&
           nh_is_number(w->dag, nh_exponent_of(w->dag, e, 0), 1) && nh_source_simple(w, nh_child(w->dag, e, 0));
}

/* Counts; symbols get their names here, too, in the order of their declaration. */
void nh_source_parts(nh_source *w, size_t n, const nh_ex *e)
{
    nh_ex child[2];
    uint32_t times[2];
    size_t top = reach(w, n, e);
    for (size_t at = 0; at < top; at++) {
        nh_ex x = (nh_ex)at;
        if (!w->reach[x]) continue;
        w->reach[x] = 0;
        w->nodes[x] = 1;
        if (w->name[x] || is_leaf(w, x)) continue;
        size_t nodes = 1, parents = w->uses[x];
        bool own = nh_kind_of(w->dag, x) == NH_SUM && nh_arity(w->dag, x) > most_terms;
        for (size_t i = 0; i < nh_arity(w->dag, x); i++)
            for (size_t k = children(w, x, i, child, times); k-- > 0;) nodes += w->nodes[child[k]];
        w->nodes[x] = (uint32_t)(nodes < most_nodes ? nodes : most_nodes);
        if (!w->whole && (own || (parents > 1 && !light(w, x)) || nodes >= most_nodes)) {
            state(w, x);
            w->nodes[x] = 1;
        }
    }
}

/* ---- loops ---- */

void nh_source_open(nh_source *w)
{
    w->outer.uses = w->uses;
    w->outer.name = w->name;
    w->uses = nh_alloc_array(w->size + 1, sizeof *w->uses);
    w->name = nh_alloc_array(w->size + 1, sizeof *w->name);
    memcpy(w->name, w->outer.name, w->size * sizeof *w->name);
}

void nh_source_close(nh_source *w)
{
    for (size_t i = 0; i < w->size; i++) /* names of symbols are kept */
        if (w->name[i] && nh_kind_of(w->dag, (nh_ex)i) == NH_SYMBOL) w->outer.name[i] = w->name[i];
    nh_free(w->uses);
    nh_free(w->name);
    w->uses = w->outer.uses;
    w->name = w->outer.name;
    w->outer.uses = NULL;
    w->outer.name = NULL;
}
