/* system_functions: `functions:`, functions of one argument: V(r), f(t), with or without a value. */
#include <string.h>

#include "graph/dag.h"
#include "graph/declared.h"
#include "graph/diff.h"
#include "graph/node.h"
#include "graph/parse.h"
#include "system/system_internal.h"

typedef nh_system_reader reader;

/* "V(r) = k*r^2/2": the function, its argument, and where the value begins (0: there is none). */
typedef struct {
    const char *name, *variable;
    size_t value;
} head;

/* Splits "V(r)", possibly with a value behind it.  False: it is written otherwise. */
static bool split(nh_arena *arena, const char *text, head *out)
{
    char word[2][64];
    size_t at = nh_name_spelled(text, word[0], sizeof *word), n;
    at += strspn(text + at, " ");
    if (text[at++] != '(') return false;
    at += strspn(text + at, " ");
    n = nh_name_spelled(text + at, word[1], sizeof *word);
    at += n + strspn(text + at + n, " ");
    if (!n || text[at++] != ')') return false;
    at += strspn(text + at, " ");
    if (text[at] && text[at] != '=') return false;
    *out = (head){nh_arena_strdup(arena, word[0]), nh_arena_strdup(arena, word[1]), text[at] ? at + 1 : 0};
    return nh_is_name(out->name) && nh_is_name(out->variable);
}

static bool fail_form(reader *r, const nh_deck_node *node)
{
    nh_deck_fail(r->deck, node, 0, r->error, "a function was expected: \"V(r)\", or {name: V, of: r}");
    return nh_error_hint(r->error, "with a value: \"V(r) = k*r^2/2\", or {name: V, of: r, value: k*r^2/2}");
}

/* A value may contain its argument and parameters alone. */
static bool only_argument(reader *r, nh_ex value, nh_ex variable, const char **other)
{
    const nh_system *system = r->system;
    NH_LIST(symbol);
    size_t n = nh_symbols_in(system->dag, value, &symbol);
    for (size_t i = 0; i < n; i++) {
        bool good = symbol[i] == variable;
        for (size_t k = 0; k < system->parameters; k++) good |= symbol[i] == system->parameter[k].symbol;
        *other = nh_name_of(system->dag, symbol[i]);
        if (!good) return false;
    }
    return true;
}

static const char outside[] = "the value of `%s` contains `%s`, which is neither its argument `%s` nor a parameter";

/* The value and its derivatives. */
static void give(nh_dag *dag, size_t f, nh_ex variable, nh_ex value)
{
    nh_ex all[NH_DECLARED_PRIMES + 1] = {value};
    for (size_t i = 1; i <= NH_DECLARED_PRIMES; i++) all[i] = nh_diff(dag, all[i - 1], variable);
    nh_declared_give(dag, f, variable, all);
}

/* The symbol of the argument, which hides what else has its name; t is t. */
static nh_ex argument_of(const nh_system *system, const char *name)
{
    return strcmp(name, "t") ? nh_symbol_fresh(system->dag, name) : system->t;
}

/* The value in the file. */
static bool value_in_file(reader *r, const head *h, size_t f, const nh_deck_node *node, size_t skip)
{
    const char *other;
    nh_ex value, variable = argument_of(r->system, h->variable);
    nh_named extra = {.name = h->variable, .value = variable};
    if (!nh_deck_is(r->deck, node, NH_DECK_SCALAR, "the value of a function", r->error) ||
        !nh_system_read_expression(r->system, r->deck, node, skip, NH_NO_QUASI, 1, &extra, NULL, &value, r->error))
        return false;
    if (!only_argument(r, value, variable, &other))
        return nh_deck_fail(r->deck, node, skip, r->error, outside, h->name, other, h->variable);
    give(r->system->dag, f, variable, value);
    return true;
}

static bool read_function(reader *r, const nh_deck_node *item)
{
    static const char *const keys[] = {"name", "of", "value", "doc"};
    head h = {0};
    const nh_deck_node *name = item, *value = item;
    if (item->kind == NH_DECK_MAP) {
        if (!nh_deck_only(r->deck, item, keys, 4, r->error)) return false;
        const nh_deck_node *of = nh_deck_get(item, "of");
        name = nh_deck_get(item, "name");
        value = nh_deck_get(item, "value");
        if (!name || !of || name->kind != NH_DECK_SCALAR || of->kind != NH_DECK_SCALAR) return fail_form(r, item);
        h = (head){name->text, of->text, 0};
        if (!nh_is_name(h.variable)) return nh_deck_fail(r->deck, of, 0, r->error, "`%s` is not a name", h.variable);
    } else if (item->kind != NH_DECK_SCALAR || !split(r->system->arena, item->text, &h)) {
        return fail_form(r, item);
    }
    nh_deck_node own = *name;
    own.text = h.name;
    if (!nh_system_new_name(r, &own)) return false;
    size_t f = nh_declared_add(r->system->dag, h.name);
    if (item->kind == NH_DECK_SCALAR) return !h.value || value_in_file(r, &h, f, item, h.value);
    return !value || value_in_file(r, &h, f, value, 0);
}

bool nh_system_is_function_setting(const nh_setting *setting) { return strchr(setting->name, '(') != NULL; }

/* A value of a request: `--set "V(r) = k*r^2/2"`. */
static bool apply(reader *r, const nh_setting *setting)
{
    nh_system *system = r->system;
    head h;
    size_t f;
    const char *other;
    nh_ex value;
    if (!split(system->arena, setting->name, &h) || !nh_declared_find(system->dag, h.name, &f)) {
        nh_fail(r->error, NH_USAGE, "", "`%s` is not a function of %s", setting->name, system->name);
        return nh_error_hint(r->error, "functions are declared in the system file: functions: [\"V(r)\"]");
    }
    nh_named extra = {.name = h.variable, .value = argument_of(system, h.variable)};
    if (!nh_system_expression_text(system, nh_arena_printf(system->arena, "--set %s", setting->name), setting->input, 1,
                                   &extra, &value, r->error))
        return false;
    if (!only_argument(r, value, extra.value, &other))
        return nh_fail(r->error, NH_USAGE, "", outside, h.name, other, h.variable);
    give(system->dag, f, extra.value, value);
    return true;
}

bool nh_system_read_functions(reader *r, size_t settings, const nh_setting *setting)
{
    const nh_deck_node *list;
    size_t n;
    if (!nh_system_list_of(r, r->root, "functions", &list, &n)) return false;
    for (size_t i = 0; i < n; i++)
        if (!read_function(r, list->item[i])) return false;
    for (size_t k = 0; k < settings; k++)
        if (nh_system_is_function_setting(&setting[k]) && !apply(r, &setting[k])) return false;
    return true;
}

bool nh_system_needs_values(const nh_system *system, const char *what, nh_error *error)
{
    const char *name = nh_declared_unspecified(system->dag);
    if (!name) return true;
    nh_fail(error, NH_INPUT, system->name, "%s needs numbers, but the function `%s` has no value", what, name);
    return nh_error_hint(error, "give it one, for example --set \"%s(r) = r^2/2\", or as `value:` in the file", name);
}

bool nh_system_needs_formulas(const nh_system *system, const char *what, nh_error *error)
{
    const char *name = nh_declared_has_table(system->dag);
    if (!name) return true;
    nh_fail(error, NH_INPUT, system->name, "%s needs formulas, but `%s` is a table, which has none", what, name);
    return nh_error_hint(error, "analyze, verify, simulate and benchmark work with tables");
}
