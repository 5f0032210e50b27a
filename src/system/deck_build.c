/* deck_build: see deck_build.h. */
#include "system/deck_build.h"

#include <string.h>

#include "graph/parse.h"
#include "graph/spelling.h"

const char *nh_deck_spelled(nh_arena *arena, const char *text)
{
    char name[256];
    nh_spelling spelling = nh_spelling_of(text);
    const char *own = spelling.text + strspn(spelling.text, " ");
    size_t n = nh_name_spelled(own, name, sizeof name), end = n + (own[n] == '\'');
    bool whole = n && !own[end + strspn(own + end, " ")] && strlen(name) < sizeof name - 1 && nh_is_name(name);
    const char *spelled = whole ? nh_arena_printf(arena, "%s%s", name, end > n ? "'" : "") : text;
    nh_spelling_clear(&spelling);
    return strcmp(spelled, text) ? spelled : text;
}

const char *nh_deck_spelled_all(nh_arena *arena, const char *text)
{
    char name[256];
    nh_text out;
    nh_spelling spelling = nh_spelling_of(text);
    nh_text_init(&out);
    for (size_t n; *(text = spelling.text); spelling.text += n ? n : 1) {
        n = nh_name_spelled(text, name, sizeof name);
        if (n) nh_text_add(&out, name);
        else nh_text_add_n(&out, text, 1);
    }
    nh_spelling_clear(&spelling);
    const char *copy = nh_arena_strdup(arena, nh_text_string(&out));
    nh_text_clear(&out);
    return copy;
}

const char *nh_deck_escaped_letter(const nh_deck *deck, const nh_deck_node *node)
{
    char name[64];
    if (node->deck) deck = node->deck;
    if (node->kind != NH_DECK_SCALAR || node->plain || deck->source[node->begin] != '"') return NULL;
    for (size_t i = node->begin; i + 1 < node->end; i++) {
        if (deck->source[i] != '\\') continue;
        size_t length = 1 + strcspn(deck->source + i + 1, "\\\"' ^*/+-_()");
        char *word = nh_arena_strndup(deck->arena, deck->source + i, length);
        if (word[1] && nh_name_spelled(word, name, sizeof name)) return word + 1;
        i++;
    }
    return NULL;
}

nh_deck_node *nh_deck_new(nh_deck *deck, nh_deck_kind kind, size_t begin, size_t end)
{
    nh_deck_node *node = nh_arena_alloc(deck->arena, sizeof *node);
    *node = (nh_deck_node){.kind = kind, .text = "", .plain = true, .begin = begin, .end = end, .deck = deck};
    nh_deck_place(deck, begin, &node->line, &node->column);
    return node;
}

nh_deck_node *nh_deck_word(nh_deck *deck, const char *text, size_t begin, size_t end)
{
    nh_deck_node *node = nh_deck_new(deck, NH_DECK_SCALAR, begin, end);
    node->text = nh_arena_strdup(deck->arena, text);
    return node;
}

nh_deck_node *nh_deck_new_at(nh_deck *deck, nh_deck_kind kind, const nh_deck_node *place)
{
    nh_deck_node *node = nh_deck_new(deck, kind, 0, 0);
    if (!place) return node;
    *node = *place;
    node->kind = kind;
    node->text = "";
    node->plain = true;
    node->count = 0;
    node->item = node->key = NULL;
    return node;
}

nh_deck_node *nh_deck_word_at(nh_deck *deck, const char *text, const nh_deck_node *place)
{
    nh_deck_node *node = nh_deck_new_at(deck, NH_DECK_SCALAR, place);
    node->text = nh_arena_strdup(deck->arena, text);
    return node;
}

/* Makes room for one more: the array doubles whenever the count is a power of two. */
static void make_room(nh_deck *deck, const nh_deck_node ***array, size_t count)
{
    if (count & (count - 1)) return;
    const nh_deck_node **more = nh_arena_alloc(deck->arena, (2 * count + 1) * sizeof *more);
    if (count) memcpy(more, *array, count * sizeof *more);
    *array = more;
}

void nh_deck_append(nh_deck *deck, nh_deck_node *list, const nh_deck_node *item)
{
    make_room(deck, &list->item, list->count);
    list->item[list->count++] = item;
}

void nh_deck_put(nh_deck *deck, nh_deck_node *map, const char *key, const nh_deck_node *value)
{
    make_room(deck, &map->key, map->count);
    map->key[map->count] = nh_deck_word_at(deck, key, value);
    nh_deck_append(deck, map, value);
}

nh_deck_node *nh_deck_copy(nh_deck *deck, const nh_deck_node *node, const char *without)
{
    nh_deck_node *copy = nh_deck_new_at(deck, node->kind, node);
    copy->text = node->text;
    for (size_t i = 0; i < node->count; i++) {
        if (node->kind == NH_DECK_LIST) nh_deck_append(deck, copy, node->item[i]);
        else if (!without || strcmp(node->key[i]->text, without)) {
            nh_deck_put(deck, copy, node->key[i]->text, node->item[i]);
            copy->key[copy->count - 1] = node->key[i];
        }
    }
    return copy;
}

/* ---- entries from one line ---- */

/* The node of text[begin .. end) without the blanks around it. */
static nh_deck_node *word_between(nh_deck *deck, size_t begin, size_t end)
{
    while (begin < end && nh_deck_is_space(deck->source[begin])) begin++;
    while (begin < end && nh_deck_is_space(deck->source[end - 1])) end--;
    nh_deck_node *node = nh_deck_new(deck, NH_DECK_SCALAR, begin, end);
    node->text = nh_deck_spelled(deck->arena, nh_arena_strndup(deck->arena, deck->source + begin, end - begin));
    return node;
}

/* "phi=0": the entry of the map that stands in text[begin .. end). */
static bool add_entry(nh_deck *deck, nh_deck_node *map, size_t begin, size_t end, nh_error *error)
{
    static const char cure[] = "write NAME=VALUE, with commas between: x=0, y=1";
    size_t equal = begin + strcspn(deck->source + begin, "=:,;");
    const nh_deck_node *name = word_between(deck, begin, equal < end ? equal : end),
                       *value = equal < end ? word_between(deck, equal + 1, end) : NULL;
    if (!value && !name->text[0]) return true; /* a comma at the end */
    if (!name->text[0]) nh_deck_fail(deck, name, 0, error, "a name is missing before `=`");
    else if (!value || !value->text[0]) nh_deck_fail(deck, name, 0, error, "`%s` has no value", name->text);
    const nh_deck_node *last = map->count ? map->item[map->count - 1] : NULL;
    double number;
    if (!value && last && nh_text_to_number(name->text, &number) && nh_text_to_number(last->text, &number)) /* x=0,5 */
        return nh_error_hint(error, "use a decimal point: %s=%s.%s", map->key[map->count - 1]->text, last->text,
                             name->text);
    if (error->code != NH_OK) return nh_error_hint(error, cure);
    if (nh_deck_get(map, name->text)) return nh_deck_fail(deck, name, 0, error, "`%s` is given twice", name->text);
    nh_deck_put(deck, map, name->text, value);
    map->key[map->count - 1] = name;
    return true;
}

nh_deck *nh_deck_line(const char *name, const char *text, nh_code code, nh_error *error)
{
    nh_deck *deck = nh_deck_create(name, text, strlen(text));
    deck->code = code;
    nh_deck_node *map = nh_deck_new(deck, NH_DECK_MAP, 0, deck->length);
    bool good = nh_deck_check_text(deck, error);
    size_t begin = strspn(deck->source, " "), end = deck->length;
    while (end > begin && deck->source[end - 1] == ' ') end--;
    bool braces = begin < end && deck->source[begin] == '{' && deck->source[end - 1] == '}'; /* {phi: 0} */
    for (size_t at = braces ? begin + 1 : 0, stop = braces ? end - 1 : deck->length; good && at < stop; at++) {
        size_t length = nh_text_entry(deck->source + at, ",;");
        if (at + length > stop) length = stop - at;
        good = add_entry(deck, map, at, at + length, error);
        at += length;
    }
    deck->root = map;
    if (good) return deck;
    nh_deck_free(deck);
    return NULL;
}

/* ---- as YAML ---- */

/* In quotes unless it is one word that YAML leaves alone. */
static void print_word(const char *text, nh_text *out)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.+-*/^()";
    bool bare = text[0] && !text[strspn(text, plain)] && !strchr("*-/.^)+", text[0]);
    if (bare || nh_text_is_number(text)) {
        nh_text_add(out, text);
        return;
    }
    nh_text_add(out, "\"");
    for (const char *c = text; *c; c++)
        if (*c == '"' || *c == '\\') nh_text_addf(out, "\\%c", *c);
        else if (*c == '\n') nh_text_add(out, "\\n");
        else nh_text_add_n(out, c, 1);
    nh_text_add(out, "\"");
}

static void print_flow(const nh_deck_node *node, nh_text *out)
{
    bool map = node->kind == NH_DECK_MAP;
    if (node->kind == NH_DECK_SCALAR) {
        print_word(node->text, out);
        return;
    }
    nh_text_add(out, map ? "{" : "[");
    for (size_t i = 0; i < node->count; i++) {
        if (i) nh_text_add(out, ", ");
        if (map) print_word(node->key[i]->text, out);
        if (map) nh_text_add(out, ": ");
        print_flow(node->item[i], out);
    }
    nh_text_add(out, map ? "}" : "]");
}

void nh_deck_print(const nh_deck_node *root, nh_text *out)
{
    for (size_t i = 0; i < root->count; i++) {
        const nh_deck_node *value = root->item[i];
        bool lines = value->kind == NH_DECK_LIST && value->count;
        nh_text_addf(out, "%s:%s", root->key[i]->text, lines ? "\n" : " ");
        for (size_t j = 0; lines && j < value->count; j++) {
            nh_text_add(out, "  - ");
            print_flow(value->item[j], out);
            nh_text_add(out, "\n");
        }
        if (!lines) print_flow(value, out);
        if (!lines) nh_text_add(out, "\n");
    }
}
