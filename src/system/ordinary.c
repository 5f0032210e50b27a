#include "system/ordinary.h"

#include <ctype.h>
#include <string.h>
#include <strings.h>

#include "evaluate/constant_text.h"
#include "graph/parse.h"
#include "graph/spelling.h"
#include "system/deck_build.h"

static const char *const top_keys[] = {
    "name",        "title",     "source",      "parameters", "coordinates", "definitions", "lagrangian",
    "constraints", "dependent", "velocities",  "forces",     "domain",      "known",       "doc",
    "bodies",      "joints",    "gravity",     "wheels",     "symmetry",    "draw",        "robustness",
    "include",     "urdf",      "base",        "notes",      "levels",      "points",      "springs",
    "dampers",     "actuators", "dissipation", "functions",  "tables"};
enum { top_key_count = sizeof top_keys / sizeof *top_keys };

static bool among(const char *const *words, size_t count, const char *word)
{
    for (size_t i = 0; i < count; i++)
        if (!strcmp(words[i], word)) return true;
    return false;
}

/* The key that is meant by a word: in other letters, with or without an s at its end, or by its sign; NULL: none. */
static const char *meant(const char *word)
{
    static const char *const others[][2] = {{"L", "lagrangian"},          {"kinetic", "T"},
                                            {"kinetic_energy", "T"},      {"kinetic energy", "T"},
                                            {"potential", "V"},           {"potential_energy", "V"},
                                            {"potential energy", "V"},    {"params", "parameters"},
                                            {"constants", "parameters"},  {"vars", "coordinates"},
                                            {"variables", "coordinates"}, {"generalized_coordinates", "coordinates"}};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (!strcmp(word, others[i][0])) return others[i][1];
    size_t n = strlen(word);
    for (size_t i = 0; i < top_key_count && n > 1; i++) {
        size_t k = strlen(top_keys[i]), shorter = k < n ? k : n;
        bool plural = k + 1 == n ? (word[n - 1] | 32) == 's' : n + 1 == k && top_keys[i][k - 1] == 's';
        if ((k == n || plural) && !strncasecmp(word, top_keys[i], shorter)) return top_keys[i];
    }
    return NULL;
}

/* ---- values ---- */

/* A part of a scalar, with its place. */
static nh_deck_node *part(nh_deck *deck, const nh_deck_node *node, size_t begin, size_t end)
{
    while (begin < end && strchr(" \n", node->text[begin])) begin++;
    while (begin < end && strchr(" \n", node->text[end - 1])) end--;
    size_t at = nh_deck_origin(deck, node, begin);
    const char *text = nh_arena_strndup(deck->arena, node->text + begin, end - begin);
    return nh_deck_word(deck, nh_deck_spelled(deck->arena, text), at, nh_deck_origin(deck, node, end));
}

/* A scalar "a, b" as the list [a, b]; with no separators as [a]. */
static const nh_deck_node *split(nh_deck *deck, const nh_deck_node *node, const char *separators)
{
    nh_deck_node *list = nh_deck_new_at(deck, NH_DECK_LIST, node);
    for (size_t at = 0, n; node->text[at]; at += n + (node->text[at + n] != 0)) {
        n = nh_text_entry(node->text + at, separators);
        if (strspn(node->text + at, " \n") < n) nh_deck_append(deck, list, part(deck, node, at, at + n));
    }
    return list;
}

/* A map {a: 1, b: 2} as the list [a: 1, b: 2]. */
static const nh_deck_node *entries(nh_deck *deck, const nh_deck_node *map)
{
    nh_deck_node *list = nh_deck_new_at(deck, NH_DECK_LIST, map);
    for (size_t i = 0; i < map->count; i++) {
        nh_deck_node *entry = nh_deck_new_at(deck, NH_DECK_MAP, map->key[i]);
        nh_deck_put(deck, entry, map->key[i]->text, map->item[i]);
        entry->key[0] = map->key[i];
        nh_deck_append(deck, list, entry);
    }
    return list;
}

/* "theta(t)" is the coordinate theta. */
static const nh_deck_node *without_time(nh_deck *deck, const nh_deck_node *item)
{
    static const char time[] = "(t)";
    size_t n = item->kind == NH_DECK_SCALAR ? strlen(item->text) : 0, tail = sizeof time - 1;
    return n > tail && !strcmp(item->text + n - tail, time) ? part(deck, item, 0, n - tail) : item;
}

/* "m = 1" is the entry {name: m, value: 1}. */
static const nh_deck_node *as_parameter(nh_deck *deck, const nh_deck_node *item)
{
    const char *equal = item->kind == NH_DECK_SCALAR ? strchr(item->text, '=') : NULL;
    if (!equal) return item;
    nh_deck_node *map = nh_deck_new_at(deck, NH_DECK_MAP, item);
    size_t at = (size_t)(equal - item->text);
    nh_deck_put(deck, map, "name", part(deck, item, 0, at));
    nh_deck_put(deck, map, "value", part(deck, item, at + 1, strlen(item->text)));
    return map;
}

static const nh_deck_node *each(nh_deck *deck, const nh_deck_node *list,
                                const nh_deck_node *(*change)(nh_deck *, const nh_deck_node *))
{
    if (list->kind != NH_DECK_LIST) return list;
    nh_deck_node *copy = nh_deck_new_at(deck, NH_DECK_LIST, list);
    for (size_t i = 0; i < list->count; i++) nh_deck_append(deck, copy, change(deck, list->item[i]));
    return copy;
}

/* The value of a key as a list. */
static const nh_deck_node *listed(nh_deck *deck, const char *key, const nh_deck_node *value)
{
    static const char *const equations[] = {"definitions", "forces"};
    bool scalar = value->kind == NH_DECK_SCALAR && value->text[0];
    if (!strcmp(key, "coordinates")) return each(deck, scalar ? split(deck, value, ",; \n") : value, without_time);
    if (!strcmp(key, "parameters")) return each(deck, scalar ? split(deck, value, ",;\n") : value, as_parameter);
    if (!strcmp(key, "dependent")) return scalar ? split(deck, value, ",; \n") : value;
    if (value->kind == NH_DECK_MAP && among(equations, 2, key)) return entries(deck, value);
    bool each_equation = scalar && nh_text_entry(value->text, ",;") < strlen(value->text); /* x' = y', z' = 0 */
    for (const char *at = value->text; each_equation && *at; at += nh_text_entry(at, ",;"), at += *at != 0)
        each_equation = memchr(at, '=', nh_text_entry(at, ",;")) != NULL;
    return scalar && (among(equations, 2, key) || !strcmp(key, "constraints"))
               ? split(deck, value, each_equation ? ",;\n" : "\n")
               : value;
}

/* ---- keys ---- */

/* `T:` and `V:` are definitions, and without `lagrangian:` it is T - V. */
static void move_energies(nh_deck *deck)
{
    static const char *const energies[] = {"T", "V", "U"};
    const nh_deck_node *found[3];
    nh_deck_node *root, *list;
    bool any = false;
    for (size_t i = 0; i < 3; i++) any |= (found[i] = nh_deck_get(deck->root, energies[i])) != NULL;
    if (!any) return;
    const nh_deck_node *own = nh_deck_get(deck->root, "definitions"), *key = NULL;
    if (own && own->kind != NH_DECK_LIST) return;
    list = own ? nh_deck_copy(deck, own, NULL) : nh_deck_new_at(deck, NH_DECK_LIST, deck->root);
    root = nh_deck_copy(deck, deck->root, "definitions");
    for (size_t i = 0; i < 3; i++) {
        if (!found[i]) continue;
        nh_deck_node *entry;
        for (size_t k = 0; k < root->count; k++)
            if (root->item[k] == found[i]) key = root->key[k];
        entry = nh_deck_new_at(deck, NH_DECK_MAP, key);
        nh_deck_put(deck, entry, energies[i], found[i]);
        entry->key[0] = key;
        nh_deck_append(deck, list, entry);
        root = nh_deck_copy(deck, root, energies[i]);
    }
    nh_deck_put(deck, root, "definitions", list);
    if (found[0] && !(found[1] && found[2]) && !nh_deck_get(root, "lagrangian"))
        nh_deck_put(deck, root, "lagrangian",
                    nh_deck_word_at(deck,
                                    found[1]   ? "T - V"
                                    : found[2] ? "T - U"
                                               : "T",
                                    found[0]));
    deck->root = root;
}

/* Files of earlier versions: chart {velocities: ..}, and stress. */
static bool rename_old_keys(nh_deck *deck, nh_error *error)
{
    const nh_deck_node *root = nh_deck_root(deck);
    if (!nh_deck_rename(deck, nh_deck_get(root, "chart"), "velocities", "names", error)) return false;
    if (!nh_deck_rename(deck, root, "chart", "velocities", error) ||
        !nh_deck_rename(deck, root, "stress", "robustness", error))
        return false;
    const nh_deck_node *maps = nh_deck_get(root, "robustness");
    for (size_t i = 0; maps && maps->kind == NH_DECK_LIST && i < maps->count; i++)
        if (!nh_deck_rename(deck, maps->item[i], "chart", "velocities", error)) return false;
    return true;
}

bool nh_ordinary_keys(nh_deck *deck, nh_error *error)
{
    if (deck->root->kind != NH_DECK_MAP) return true;
    if (!rename_old_keys(deck, error)) return false;
    nh_deck_node *root = nh_deck_copy(deck, deck->root, NULL);
    for (size_t i = 0; i < root->count; i++) {
        const char *word = root->key[i]->text, *key = among(top_keys, top_key_count, word) ? word : meant(word);
        if (!key) continue;
        if (key != word && !nh_deck_rename(deck, root, word, key, error)) return false;
        root->item[i] = listed(deck, key, root->item[i]);
    }
    deck->root = root;
    move_energies(deck);
    return true;
}

/* Keys that files of other programs may have, and their equivalents here. */
static const struct {
    const char *key, *hint;
} elsewhere[] = {
    {"hamiltonian", "a system is given by its Lagrangian: lagrangian: m/2*x'^2 - k/2*x^2"},
    {"holonomic", "constraints: [\"x = y\", \"y' = x*x'\"]: equations of positions and of velocities"},
    {"nonholonomic", "constraints: [\"x = y\", \"y' = x*x'\"]: equations of positions and of velocities"},
    {"inputs", "an input is a parameter: {name: u, value: 0, input: true}"},
    {"quasi_velocities", "velocities: {names: [v], map: [\"x' = v\"]}"},
    {"ansatz", "this is an analysis file: nhsym analyze SYSTEM --analysis FILE"},
    {"initial", "a motion's start is no part of the system: --initial \"x=1\", or an analysis file (`validate`)"},
    {"initial_conditions", "a motion's start is no part of the system: --initial \"x=1\""},
    {"initial_values", "a motion's start is no part of the system: --initial \"x=1\""},
    {"equations", "a system is given by its Lagrangian, and forces without a potential: forces: [\"x = -c*x'\"]"},
    {"equations_of_motion", "a system is given by its Lagrangian, and forces: forces: [\"x = -c*x'\"]"},
    {"H", "a system is given by its Lagrangian: lagrangian: m/2*x'^2 - k/2*x^2"},
};

/* Keys that are no keys of a system file, but parameters with their values, with the line to write. */
static bool no_parameters(nh_deck *deck, nh_error *error)
{
    const nh_deck_node *root = deck->root, *first = NULL;
    nh_text line;
    double value;
    nh_text_init(&line);
    for (size_t i = 0; i < root->count; i++) {
        const nh_deck_node *key = root->key[i], *item = root->item[i];
        if (among(top_keys, top_key_count, key->text) || !nh_is_name(key->text) || item->kind != NH_DECK_SCALAR ||
            !nh_constant_text(item->text, &value) || nh_text_nearest(key->text, top_keys, top_key_count))
            continue;
        nh_text_addf(&line, "%s%s: %s", first ? ", " : "", key->text, item->text);
        if (!first) first = key;
    }
    if (first) {
        bool some = nh_deck_get(root, "parameters") != NULL;
        nh_deck_fail(deck, first, 0, error, "unknown key `%s`", first->text);
        nh_error_hint(error,
                      some ? "list all parameters together: add to `parameters:` the entries {%s}" : "parameters: {%s}",
                      nh_text_string(&line));
    }
    nh_text_clear(&line);
    return !first;
}

bool nh_ordinary_only_known(nh_deck *deck, nh_error *error)
{
    const nh_deck_node *root = deck->root;
    for (size_t i = 0; i < root->count; i++)
        for (size_t j = 0; j < sizeof elsewhere / sizeof *elsewhere; j++)
            if (!strcmp(root->key[i]->text, elsewhere[j].key)) {
                nh_deck_fail(deck, root->key[i], 0, error, "unknown key `%s`", elsewhere[j].key);
                return nh_error_hint(error, "%s", elsewhere[j].hint);
            }
    return no_parameters(deck, error) && nh_deck_only(deck, root, top_keys, top_key_count, error);
}

bool nh_ordinary_ask_values(nh_deck *deck, const nh_deck_node *list, const nh_deck_node *first, nh_error *error)
{
    const char *line = "";
    for (size_t i = 0; i < list->count; i++) {
        const nh_deck_node *item = list->item[i], *own = nh_deck_get(item, "name"), *value = nh_deck_get(item, "value");
        const char *name = own ? own->text : item->text, *usual = strcmp(name, "g") ? "1" : "9.81";
        line = nh_arena_printf(deck->arena, "%s%s%s: %s", line, i ? ", " : "", name, value ? value->text : usual);
    }
    nh_deck_fail(deck, first, 0, error, "the parameter `%s` has no value", first->text);
    return nh_error_hint(error, "parameters: {%s}", line);
}

/* ---- names that are not declared ---- */

typedef struct {
    nh_text names;   /* each with a blank behind it */
    bool velocities; /* names with a prime are looked for, others else */
    bool hidden;     /* a part is of a file whose text is in no message */
    nh_ordinary_known *is_known;
    void *context;
} search;

static bool has(const search *s, const char *name)
{
    size_t n = strlen(name);
    for (const char *at = nh_text_string(&s->names); (at = strstr(at, name)); at += n)
        if ((at == nh_text_string(&s->names) || at[-1] == ' ') && at[n] == ' ') return true;
    return false;
}

/* The names of an expression. */
static void look_into(search *s, const char *text)
{
    static const char *const words[] = {"deg", "diff", "Derivative", "derivative", "D", "dt", "e"};
    nh_spelling spelling = nh_spelling_of(text);
    char name[256];
    for (const char *at = spelling.text; *at;) {
        size_t number = strspn(at, "0123456789."), exponent;
        if (number) {
            exponent = strspn(at + number + 1 + (at[number] && strchr("+-", at[number + 1]) != NULL), "0123456789");
            at += number + (strchr("eE", at[number]) && at[number] && exponent ? 1 : 0);
            continue;
        }
        size_t n = nh_name_spelled(at, name, sizeof name);
        const char *behind = at + n + strspn(at + n, " ");
        bool moves = n && at[n] == '\'', called = *behind == '(' && n && behind == at + n;
        at += n ? n : 1;
        if (!n || moves != s->velocities || (called && !moves) || nh_is_reserved(name) || has(s, name)) continue;
        if (among(words, sizeof words / sizeof *words, name) || !nh_is_name(name)) continue;
        if (!s->is_known || !s->is_known(s->context, name)) nh_text_addf(&s->names, "%s ", name);
    }
    nh_spelling_clear(&spelling);
}

/* The same of all that a file says about motion. */
static void look_everywhere(search *s, const nh_deck_node *root)
{
    static const char *const keys[] = {"definitions", "lagrangian", "constraints", "forces", "dissipation"};
    for (size_t k = 0; k < sizeof keys / sizeof *keys; k++) {
        const nh_deck_node *node = nh_deck_get(root, keys[k]);
        size_t count = node && node->kind == NH_DECK_LIST ? node->count : node ? 1 : 0;
        for (size_t i = 0; i < count; i++) {
            const nh_deck_node *item = node->kind == NH_DECK_LIST ? node->item[i] : node;
            bool named = k == 0 || k == 3;
            if (item->kind == NH_DECK_MAP && item->count == 1) item = item->item[0], named = false;
            if (item->kind != NH_DECK_SCALAR) continue;
            s->hidden |= item->deck && item->deck->hidden;
            const char *equal = named ? strchr(item->text, '=') : NULL;
            look_into(s, equal ? equal + 1 : item->text);
        }
    }
}

/* Is it the name of a definition, also of a later one? */
static bool is_defined(const nh_deck_node *root, const char *name)
{
    const nh_deck_node *list = nh_deck_get(root, "definitions");
    for (size_t i = 0; list && list->kind == NH_DECK_LIST && i < list->count; i++) {
        const nh_deck_node *item = list->item[i];
        const char *left = item->kind == NH_DECK_MAP && item->count ? item->key[0]->text : item->text;
        size_t n = strlen(name);
        if (left && !strncmp(left, name, n) && (!left[n] || left[n] == ' ' || left[n] == '=')) return true;
    }
    return false;
}

bool nh_ordinary_hint_declare(const nh_deck *deck, nh_ordinary_known *is_known, void *context, nh_error *error)
{
    search s = {.is_known = is_known, .context = context};
    const nh_deck_node *root = deck->root, *own = nh_deck_get(root, "parameters");
    bool map = !own || own->kind == NH_DECK_MAP;
    nh_text line;
    nh_text_init(&line);
    nh_text_init(&s.names);
    look_everywhere(&s, root);
    const char *dash = own && own->deck && own->deck->source[own->begin] == '-' ? "- " : "";
    for (const char *at = nh_text_string(&s.names); *at;) {
        int n = (int)strcspn(at, " ");
        char *name = nh_arena_strndup(deck->arena, at, (size_t)n);
        at += n + 1;
        if (is_defined(root, name)) continue;
        const char *value = !strcmp(name, "g") ? "9.81" : "1";
        nh_text_add(&line, line.length ? map ? ", " : " and " : "");
        if (map) nh_text_addf(&line, "%s: %s", name, value);
        else nh_text_addf(&line, "`%s{name: %s, value: %s}`", dash, name, value);
    }
    if (!s.hidden) error->hint[0] = 0; /* of a file that is shown in no message the names are not, either */
    if (s.hidden) nh_text_clear(&line);
    else if (!line.length) nh_error_hint(error, "declare it under parameters, coordinates or definitions");
    else if (!own) nh_error_hint(error, "declare it, for instance `parameters: {%s}`", nh_text_string(&line));
    else if (map) nh_error_hint(error, "declare it, for instance under `parameters:` by `%s`", nh_text_string(&line));
    else nh_error_hint(error, "declare it, for instance under `parameters:` by %s", nh_text_string(&line));
    nh_text_clear(&line);
    nh_text_clear(&s.names);
    return false;
}

/* The names with commas between. */
static const char *with_commas(nh_deck *deck, const search *s, const char *behind)
{
    const char *out = "";
    for (const char *at = nh_text_string(&s->names); *at; at += strcspn(at, " ") + 1)
        out = nh_arena_printf(deck->arena, "%s%s%.*s%s", out, *out ? ", " : "", (int)strcspn(at, " "), at,
                              !*behind               ? ""
                              : strncmp(at, "g ", 2) ? behind
                                                     : ": 9.81");
    return out;
}

typedef struct {
    const nh_deck_node *root;
    const char *moving;
    nh_ordinary_known *is_parameter;
    void *context;
} declared;

static bool is_declared(void *context, const char *name)
{
    const declared *d = context;
    size_t n = strlen(name);
    for (const char *at = d->moving; (at = strstr(at, name)); at += n)
        if (!strchr(", ]", at[-1]) && at[-1] != '[') continue;
        else if (strchr(",]", at[n])) return true;
    return is_defined(d->root, name) || d->is_parameter(d->context, name);
}

const char *nh_ordinary_declare_all(nh_deck *deck, nh_ordinary_known *is_parameter, void *context)
{
    search s = {.velocities = true}, others = {.is_known = is_declared};
    declared d = {.root = deck->root, .is_parameter = is_parameter, .context = context};
    nh_text_init(&s.names);
    nh_text_init(&others.names);
    look_everywhere(&s, deck->root);
    const char *line = NULL, *list = with_commas(deck, &s, "");
    if (*list) {
        d.moving = line = nh_arena_printf(deck->arena, "[%s]", list);
        others.context = &d;
        look_everywhere(&others, deck->root);
        const char *missing = with_commas(deck, &others, ": 1");
        line = *missing ? nh_arena_printf(deck->arena, "coordinates: %s, and parameters: {%s}", line, missing)
                        : nh_arena_printf(deck->arena, "coordinates: %s", line);
    }
    nh_text_clear(&s.names);
    nh_text_clear(&others.names);
    return line;
}
