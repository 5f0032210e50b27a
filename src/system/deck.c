/* deck: access to the tree, with messages.  See deck.h; deck_read.c builds the tree. */
#include "system/deck.h"

#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "system/deck_internal.h"
#include "base/text.h"
#include "evaluate/constant_text.h"

const nh_deck_node *nh_deck_root(const nh_deck *deck) { return deck->root; }

const char *nh_deck_name(const nh_deck *deck) { return deck->name; }

const nh_deck_node *nh_deck_get(const nh_deck_node *map, const char *key)
{
    if (!map || map->kind != NH_DECK_MAP) return NULL;
    for (size_t i = 0; i < map->count; i++)
        if (strcmp(map->key[i]->text, key) == 0) return map->item[i];
    return NULL;
}

bool nh_deck_fail(const nh_deck *deck, const nh_deck_node *node, size_t offset, nh_error *error, const char *format,
                  ...)
{
    char what[2 * sizeof error->what]; /* longer than the field, so that nh_fail cuts it properly */
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    if (!node) return nh_fail(error, NH_INPUT, deck->name, "%s", what);
    if (node->deck) deck = node->deck;
    return nh_deck_fail_at(deck, nh_deck_origin(deck, node, offset), error, "%s", what);
}

/* A single word gets quotes: `value`; a description stays as it is: the mass of `b1`. */
static const char *quote_for(const char *what)
{
    for (const char *c = what; *c; c++)
        if (*c == '`' || *c == ' ') return "";
    return "`";
}

enum { FOUND_SIZE = NH_DECK_SHOWN + 32 };

/* The content of a node in words, as in "found ...". */
static void describe(const nh_deck_node *node, char out[FOUND_SIZE])
{
    char shown[NH_DECK_SHOWN];
    if (node->kind != NH_DECK_SCALAR) {
        snprintf(out, FOUND_SIZE, "%s", node->kind == NH_DECK_LIST ? "a list" : "a map");
    } else if (!node->text[0]) {
        snprintf(out, FOUND_SIZE, "%s", node->plain ? "nothing" : "an empty text");
    } else {
        nh_deck_shorten(node->text, shown);
        snprintf(out, FOUND_SIZE, "%s`%s`", node->plain ? "" : "the text ", shown);
    }
}

/* "`what` must be <wanted>, found ..." */
__attribute__((format(printf, 5, 6))) static bool wrong(const nh_deck *deck, const nh_deck_node *node, const char *what,
                                                        nh_error *error, const char *wanted, ...)
{
    char found[FOUND_SIZE], expected[256];
    const char *quote = quote_for(what);
    if (!node) return nh_deck_fail(deck, NULL, 0, error, "%s%s%s is missing", quote, what, quote);
    va_list arguments;
    va_start(arguments, wanted);
    vsnprintf(expected, sizeof expected, wanted, arguments);
    va_end(arguments);
    describe(node, found);
    return nh_deck_fail(deck, node, 0, error, "%s%s%s must be %s, found %s", quote, what, quote, expected, found);
}

/* YAML reads `a:1` as a single word. */
static bool lacks_space(const nh_deck_node *node)
{
    const char *colon = node->kind == NH_DECK_SCALAR && node->plain ? strchr(node->text, ':') : NULL;
    return colon && colon[1] && !nh_deck_is_space(colon[1]);
}

/* Shows how the list is written, where the file has a map or a single text: `forces: {x: -x'}` by its first entry. */
static void hint_list(const nh_deck_node *node, const char *what, nh_error *error)
{
    static const char *const of_equations[] = {"definitions", "forces", "map"};
    for (size_t i = 0; i < sizeof of_equations / sizeof *of_equations; i++)
        if (!strcmp(what, of_equations[i]) && node->kind == NH_DECK_MAP && node->count &&
            node->item[0]->kind == NH_DECK_SCALAR)
            nh_error_hint(error, "%s: [\"%s = %s\"%s]", what, node->key[0]->text, node->item[0]->text,
                          node->count > 1 ? ", .." : "");
    if (node->kind == NH_DECK_SCALAR && strchr(node->text, '=')) nh_error_hint(error, "%s: [\"%s\"]", what, node->text);
    nh_error_hint(error, "a list is written [a, b], or one item per line, each after `- `");
}

/* `- x: -x'` among equations. */
static void hint_equation(const nh_deck_node *node, const char *what, nh_error *error)
{
    if (strstr(what, "= expression`") && node->kind == NH_DECK_MAP && node->count == 1 &&
        node->item[0]->kind == NH_DECK_SCALAR)
        nh_error_hint(error, "with `=` in the place of the colon: \"%s = %s\"", node->key[0]->text,
                      node->item[0]->text);
}

/* `L = x'^2/2` for `L: x'^2/2`. */
static void hint_colon(const nh_deck_node *node, nh_error *error)
{
    const char *text = node->kind == NH_DECK_SCALAR ? node->text : "", *equal = strchr(text, '=');
    size_t word = strspn(text, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_");
    if (!word || !equal || strspn(text + word, " ") != (size_t)(equal - text) - word) return;
    const char *source = node->deck->source + node->begin, *rest = strchr(source, '=') + 1;
    rest += strspn(rest, " ");
    int length = (int)strcspn(rest, "\r\n");
    nh_error_hint(error, "write a colon after the key: `%.*s: %.*s`", (int)word, text, length, rest);
}

bool nh_deck_is(const nh_deck *deck, const nh_deck_node *node, nh_deck_kind kind, const char *what, nh_error *error)
{
    static const char *const wanted[] = {"a single value", "a list", "a map (`key: value`)"};
    if (node && node->kind == kind) return true;
    bool fresh = error && error->code == NH_OK;
    wrong(deck, node, what, error, "%s", wanted[kind]);
    if (fresh && node && kind == NH_DECK_MAP && lacks_space(node))
        nh_error_hint(error, "write a space after the colon");
    if (fresh && node && kind == NH_DECK_MAP) hint_colon(node, error);
    if (fresh && node && kind == NH_DECK_LIST) hint_list(node, what, error);
    if (fresh && node && kind == NH_DECK_SCALAR) hint_equation(node, what, error);
    return false;
}

static void list_known(const char *const *known, size_t count, nh_text *out)
{
    for (size_t i = 0; i < count; i++) nh_text_addf(out, "%s%s", i > 0 ? ", " : "known keys: ", known[i]);
}

/* The key that is called `word` elsewhere, if it is known here and not yet written; NULL: none. */
static const char *called(const nh_deck_node *map, const char *word, const char *const *known, size_t count)
{
    static const char *const other[][2] = {
        {"force", " torque moment effort tau load "},
        {"torque", " force moment effort tau "},
        {"stiffness", " k constant spring_constant spring_rate elasticity "},
        {"damping", " c d b friction viscosity coefficient "},
        {"rest", " length l0 rest_length rest_angle equilibrium neutral offset "},
        {"length", " rest l0 rest_length natural_length free_length "},
        {"between", " points ends from "},
        {"mass", " m weight "},
        {"inertia", " i j inertia_tensor tensor_of_inertia moment_of_inertia moments_of_inertia "},
        {"center", " com cog cm center_of_mass centre_of_mass position "},
        {"rotation", " orientation rpy turn "},
        {"parent", " base from predecessor "},
        {"child", " to link successor body "},
        {"body", " link frame parent "},
        {"at", " position pos location place point origin xyz anchor "},
        {"axis", " direction xyz "},
        {"pitch", " lead "},
        {"radius", " r "},
        {"value", " default val number amount "},
        {"unit", " units dimension "},
        {"type", " kind joint_type "},
        {"doc", " description comment note remark help info text "},
        {"name", " id label symbol "},
        {"expr", " expression formula value equation "},
        {"initial", " start state x0 initial_state "},
        {"time", " until span duration t_span "},
        {"bodies", " links rigid_bodies "},
        {"actuators", " motors inputs controls "},
        {"domain", " range ranges bounds limits "},
        {"dissipation", " rayleigh damping friction "}};
    char plain[NH_DECK_SHOWN + 2] = " ";
    size_t n = 1;
    for (; *word && n < sizeof plain - 2; word++)
        plain[n++] = strchr(" -", *word) ? '_' : (char)tolower((unsigned char)*word);
    plain[n] = ' ';
    for (size_t i = 0; i < sizeof other / sizeof *other; i++)
        for (size_t j = 0; j < count && strstr(other[i][1], plain); j++)
            if (!strcmp(known[j], other[i][0]) && !nh_deck_get(map, known[j])) return known[j];
    return NULL;
}

/* At the top of a file: `x2: l*sin(theta)` is a definition, and `m: 2` a parameter. */
static bool hint_block(const nh_deck *deck, const nh_deck_node *value, const char *word, const char *const *known,
                       size_t count, nh_error *error)
{
    const char *text = value->kind == NH_DECK_SCALAR && value->plain ? value->text : "";
    bool number = nh_text_is_number(text), top = false;
    for (size_t j = 0; j < count; j++) top |= !strcmp(known[j], number ? "parameters" : "definitions");
    if (!top || deck->hidden || (!number && !strpbrk(text, "+-*/^(")) || strlen(text) > 80) return false;
    nh_error_hint(error,
                  number ? "write `- {name: %s, value: %s}` under `parameters:`"
                         : "write `- %s = %s` under `definitions:`",
                  word, text);
    return true;
}

static void hint_known(const nh_deck *deck, const nh_deck_node *map, size_t i, const char *const *known, size_t count,
                       nh_error *error)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_ -";
    const char *word = map->key[i]->text, *near = called(map, word, known, count);
    if (!near) near = nh_text_nearest(word, known, count);
    if (near) {
        nh_error_hint(error, "did you mean `%s`?", near);
        return;
    }
    if (hint_block(deck, map->item[i], word, known, count, error)) return;
    nh_text list;
    nh_text_init(&list);
    bool split = deck->source[map->begin] == '{' && word[strspn(word, letters)]; /* an expression, at its comma? */
    if (split) nh_text_add(&list, "if it belongs to an expression, put the expression in double quotes; ");
    list_known(known, count, &list);
    nh_error_hint(error, "%s", nh_text_string(&list));
    nh_text_clear(&list);
}

bool nh_deck_only(const nh_deck *deck, const nh_deck_node *map, const char *const *known, size_t count, nh_error *error)
{
    if (!nh_deck_is(deck, map, NH_DECK_MAP, "this entry", error)) return false;
    for (size_t i = 0; i < map->count; i++) {
        size_t j = 0;
        while (j < count && strcmp(map->key[i]->text, known[j]) != 0) j++;
        if (j < count) continue;
        char shown[NH_DECK_SHOWN];
        nh_deck_shorten(map->key[i]->text, shown);
        bool fresh = error && error->code == NH_OK;
        nh_deck_fail(deck, map->key[i], 0, error, "unknown key `%s`", shown);
        if (fresh) hint_known(deck, map, i, known, count, error);
        return false;
    }
    return true;
}

static bool is_plain(const nh_deck_node *node) { return node && node->kind == NH_DECK_SCALAR && node->plain; }

/* After a message about a quoted number. */
static void hint_unquote(const nh_deck_node *node, bool fresh, nh_error *error)
{
    if (fresh && node && node->kind == NH_DECK_SCALAR && !node->plain && nh_text_is_number(node->text))
        nh_error_hint(error, "remove the quotes: a quoted value is a text");
}

bool nh_deck_number(const nh_deck *deck, const nh_deck_node *node, const char *what, double *out, nh_error *error)
{
    bool plain = is_plain(node), number = plain && nh_text_is_number(node->text);
    if (plain && !number && nh_constant_text(node->text, out)) return true;
    if (!number) {
        bool fresh = error && error->code == NH_OK;
        wrong(deck, node, what, error, "a number");
        hint_unquote(node, fresh, error);
        return fresh && is_plain(node) ? nh_error_hint_number(error, node->text) : false;
    }
    return nh_text_to_number(node->text, out) || wrong(deck, node, what, error, "a number that a double can hold");
}

/* Reads digits exactly: a seed may have 19 of them.  1e6 and 4096.0 are whole numbers, too, up to 2^53, below which a
 * double has all of these. */
static bool to_whole(const char *text, long *out)
{
    const double exact = 9007199254740992.0; /* 2^53 */
    char *rest;
    errno = 0;
    *out = strtol(text, &rest, 10);
    if (*rest == '\0') return errno == 0;
    double value = strtod(text, NULL);
    if (!(fabs(value) <= exact) || value != floor(value)) return false;
    *out = (long)value;
    return true;
}

bool nh_deck_whole(const nh_deck *deck, const nh_deck_node *node, const char *what, long min, long max, long *out,
                   nh_error *error)
{
    long value;
    if (is_plain(node) && nh_text_is_number(node->text) && to_whole(node->text, &value) && value >= min &&
        value <= max) {
        *out = value;
        return true;
    }
    bool fresh = error && error->code == NH_OK;
    if (min == LONG_MIN && max == LONG_MAX) wrong(deck, node, what, error, "a whole number");
    else if (max == LONG_MAX) wrong(deck, node, what, error, "a whole number, at least %ld", min);
    else if (min == LONG_MIN) wrong(deck, node, what, error, "a whole number, at most %ld", max);
    else wrong(deck, node, what, error, "a whole number from %ld to %ld", min, max);
    hint_unquote(node, fresh, error);
    return false;
}

bool nh_deck_range(const nh_deck *deck, const nh_deck_node *node, const char *what, double out[2], nh_error *error)
{
    static const char *const end_name[] = {"lower", "upper"};
    const char *quote = quote_for(what);
    double value[2];
    if (!node || node->kind != NH_DECK_LIST) return wrong(deck, node, what, error, "a range [low, high]");
    if (node->count != 2)
        return nh_deck_fail(deck, node, 0, error, "%s%s%s must be a range [low, high], found a list of %zu", quote,
                            what, quote, node->count);
    for (size_t i = 0; i < 2; i++) {
        char name[128];
        snprintf(name, sizeof name, "the %s end of %s%.80s%s", end_name[i], quote, what, quote);
        if (!nh_deck_number(deck, node->item[i], name, &value[i], error)) return false;
    }
    if (!(value[0] < value[1]))
        return nh_deck_fail(deck, node->item[1], 0, error,
                            "%s%s%s must be a range [low, high] with low < high, found [%s, %s]", quote, what, quote,
                            node->item[0]->text, node->item[1]->text);
    memcpy(out, value, sizeof value);
    return true;
}
