/* deck_read: from a file through libyaml's events to the tree of a deck; robot descriptions in XML by urdf.c. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <yaml.h>

#include "system/deck_internal.h"
#include "system/urdf.h"
#include "system/xml.h"
#include "base/escape.h"
#include "base/files.h"

enum { SIZE_LIMIT = NH_DECK_SIZE_LIMIT, NODE_LIMIT = 200000, DEPTH_LIMIT = 64 };

static const char comma_hint[] = "inside { } and [ ] a comma ends the entry: " NH_DECK_QUOTE_HINT;

typedef struct {
    yaml_parser_t parser;
    nh_deck *deck;
    nh_error *error;
    const nh_deck_node **stack; /* finished children of the collections being read */
    size_t used, capacity;
    size_t nodes;
} builder;

static size_t byte_at(const builder *b, yaml_mark_t mark) { return nh_deck_byte_of(b->deck, mark.index); }

/* Fail at a byte, with a hint. */
static bool refuse(builder *b, size_t byte, const char *what, const char *hint)
{
    nh_deck_fail_at(b->deck, byte, b->error, "%s", what);
    return nh_error_hint(b->error, "%s", hint);
}

static bool next_event(builder *b, yaml_event_t *event)
{
    yaml_parser_t *p = &b->parser;
    if (yaml_parser_parse(p, event)) return true;
    if (p->error == YAML_MEMORY_ERROR) nh_memory_ended(0);
    return nh_deck_explain(b->deck, p->problem ? p->problem : "unknown problem", byte_at(b, p->problem_mark),
                           p->context, byte_at(b, p->context_mark), b->error);
}

/* Refuses anchors, tags and aliases: files about mechanics do not need them, but an expression may begin with *. */
static bool check_properties(builder *b, const yaml_event_t *event)
{
    bool alias = event->type == YAML_ALIAS_EVENT;
    bool anchor = (event->type == YAML_SCALAR_EVENT && event->data.scalar.anchor) ||
                  (event->type == YAML_SEQUENCE_START_EVENT && event->data.sequence_start.anchor) ||
                  (event->type == YAML_MAPPING_START_EVENT && event->data.mapping_start.anchor);
    bool tag = (event->type == YAML_SCALAR_EVENT && event->data.scalar.tag) ||
               (event->type == YAML_SEQUENCE_START_EVENT && event->data.sequence_start.tag) ||
               (event->type == YAML_MAPPING_START_EVENT && event->data.mapping_start.tag);
    if (!alias && !anchor && !tag) return true;
    size_t at = byte_at(b, event->start_mark);
    nh_deck_fail_at(b->deck, at, b->error, "a value cannot begin with `%.1s` (YAML's %s are not used here)",
                    b->deck->source + at,
                    alias    ? "aliases"
                    : anchor ? "anchors"
                             : "tags");
    return nh_error_hint(b->error, NH_DECK_QUOTE_HINT);
}

/* A text must have no invisible characters, which escapes could insert. */
static bool check_scalar_text(builder *b, const char *text, size_t length, size_t begin)
{
    for (size_t i = 0, bytes; i < length; i += bytes ? bytes : 1) {
        uint32_t code = 0;
        bytes = nh_utf8_decode(text + i, length - i, &code);
        if (bytes && (nh_is_invisible(code) || code == '\r'))
            return refuse(b, begin,
                          code < 0x20 || (code >= 0x7F && code < 0xA0) ? "this text contains a control character"
                                                                       : "this text contains an invisible character",
                          "remove the escape that stands for it");
    }
    return true;
}

/* YAML reads [atan2(y, x)] as a list of `atan2(y` and `x)`. */
static bool check_cut(builder *b, const nh_deck_node *node)
{
    const char *source = b->deck->source;
    size_t after = node->end;
    int open = 0;
    while (nh_deck_is_space(source[after])) after++;
    if (!node->plain || source[after] != ',') return true;
    for (const char *c = node->text; *c; c++) open += (*c == '(') - (*c == ')');
    if (open <= 0) return true;
    return refuse(b, after, "this comma stands inside parentheses", comma_hint);
}

static bool fill_scalar(builder *b, nh_deck_node *node, const yaml_event_t *event)
{
    const char *text = (const char *)event->data.scalar.value;
    size_t length = event->data.scalar.length;
    node->kind = NH_DECK_SCALAR;
    node->plain = event->data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
    if (!check_scalar_text(b, text, length, node->begin)) return false;
    node->text = nh_arena_strndup(b->deck->arena, text, length);
    return check_cut(b, node);
}

static nh_deck_node *new_node(builder *b, const yaml_event_t *event)
{
    nh_deck_node *node = nh_arena_alloc(b->deck->arena, sizeof *node);
    node->text = "";
    node->deck = b->deck;
    node->begin = byte_at(b, event->start_mark);
    node->end = byte_at(b, event->end_mark);
    nh_deck_place(b->deck, node->begin, &node->line, &node->column);
    return node;
}

static void push(builder *b, const nh_deck_node *node)
{
    nh_grow(&b->stack, &b->capacity, b->used + 1, sizeof *b->stack);
    b->stack[b->used++] = node;
}

/* The children since `bottom` become items; of a map, every other one is a key. */
static void collect(builder *b, nh_deck_node *node, size_t bottom)
{
    size_t stride = node->kind == NH_DECK_MAP ? 2 : 1, total = b->used - bottom;
    node->count = total / stride;
    node->item = nh_arena_alloc(b->deck->arena, node->count * sizeof *node->item);
    if (stride == 2) node->key = nh_arena_alloc(b->deck->arena, node->count * sizeof *node->key);
    for (size_t i = 0; i < node->count; i++) {
        node->item[i] = b->stack[bottom + stride * i + stride - 1];
        if (stride == 2) node->key[i] = b->stack[bottom + stride * i];
    }
    b->used = bottom;
}

/* The end of a collection: its bracket; in block style libyaml only gives the place of the next word. */
static void close_collection(builder *b, nh_deck_node *node, const yaml_event_t *end)
{
    char first = b->deck->source[node->begin];
    if (first == '{' || first == '[') node->end = byte_at(b, end->end_mark);
    else if (node->count > 0) node->end = node->item[node->count - 1]->end;
}

static int by_text(const void *left, const void *right)
{
    const nh_deck_node *a = *(const nh_deck_node *const *)left, *b = *(const nh_deck_node *const *)right;
    int order = strcmp(a->text, b->text);
    return order ? order : (a->begin > b->begin) - (a->begin < b->begin);
}

/* Sorted, so that the time for a hostile file is not quadratic. */
static bool check_duplicates(builder *b, const nh_deck_node *map)
{
    const nh_deck_node *second = NULL, *first = NULL;
    const nh_deck_node **sorted = nh_alloc_array(map->count, sizeof *sorted);
    memcpy(sorted, map->key, map->count * sizeof *sorted);
    qsort(sorted, map->count, sizeof *sorted, by_text);
    for (size_t i = 1; i < map->count; i++) {
        bool same = strcmp(sorted[i - 1]->text, sorted[i]->text) == 0;
        if (same && (!second || sorted[i]->begin < second->begin)) {
            first = sorted[i - 1];
            second = sorted[i];
        }
    }
    nh_free(sorted);
    if (!second) return true;
    char shown[NH_DECK_SHOWN];
    nh_deck_shorten(second->text, shown);
    nh_deck_fail_at(b->deck, second->begin, b->error, "the key `%s` occurs already in line %zu", shown, first->line);
    return nh_error_hint(b->error, "remove or rename one of them");
}

static bool check_key(builder *b, const nh_deck_node *key)
{
    if (key->kind != NH_DECK_SCALAR)
        return refuse(b, key->begin,
                      key->kind == NH_DECK_LIST ? "a key must be a word, found a list"
                                                : "a key must be a word, found a map",
                      NH_DECK_QUOTE_HINT);
    if (!key->text[0]) return refuse(b, key->begin, "there is no key before the `:`", "write `key: value`");
    if (key->plain && strcmp(key->text, "<<") == 0)
        return refuse(b, key->begin, "merge keys (`<<`) are not supported", "write out the entries");
    return true;
}

/* YAML reads {a: 1, b} as b without a value: mostly a misplaced comma or a missing colon. */
static bool check_value(builder *b, const nh_deck_node *key, const nh_deck_node *value)
{
    const char *source = b->deck->source;
    bool empty = value->kind == NH_DECK_SCALAR && value->plain && !value->text[0];
    size_t gap = value->begin > key->end ? value->begin - key->end : 0;
    if (!empty || memchr(source + key->end, ':', gap) || source[key->end] == ':') return true;
    char shown[NH_DECK_SHOWN];
    nh_deck_shorten(key->text, shown);
    nh_deck_fail_at(b->deck, key->begin, b->error, "`%s` has no value", shown);
    const char *equal = key->plain ? strchr(key->text, '=') : NULL; /* {m = 1} */
    size_t before = equal ? (size_t)(equal - key->text) : 0;
    while (before && key->text[before - 1] == ' ') before--;
    if (before)
        return nh_error_hint(b->error, "write `%.*s: %s`", (int)before, key->text, equal + 1 + strspn(equal + 1, " "));
    if (key->plain && strchr(key->text, ':')) return nh_error_hint(b->error, "write a space after the colon");
    return nh_error_hint(b->error, "%s", comma_hint);
}

/* A name with Greek letters is the same in ASCII, except in texts for readers and in units. */
static void spell(nh_deck *deck, const nh_deck_node *node, const nh_deck_node *key)
{
    static const char *const texts[] = {"title", "doc", "unit", "source"};
    for (size_t i = 0; key && i < sizeof texts / sizeof *texts; i++)
        if (!strcmp(key->text, texts[i])) return;
    if (node->kind == NH_DECK_SCALAR) ((nh_deck_node *)node)->text = nh_deck_spelled(deck->arena, node->text);
}

static bool read_node(builder *b, yaml_event_t *event, size_t depth);

/* The items of a list, or the keys and values of a map, until `stop`. */
static bool read_children(builder *b, nh_deck_node *node, yaml_event_type_t stop, size_t depth)
{
    size_t bottom = b->used;
    for (;;) {
        yaml_event_t event;
        if (!next_event(b, &event)) return false;
        if (event.type == stop) {
            collect(b, node, bottom);
            close_collection(b, node, &event);
            yaml_event_delete(&event);
            return true;
        }
        if (!read_node(b, &event, depth + 1)) return false;
        bool at_value = node->kind == NH_DECK_MAP && (b->used - bottom) % 2 == 0;
        bool at_key = node->kind == NH_DECK_MAP && !at_value;
        spell(b->deck, b->stack[b->used - 1], at_value ? b->stack[b->used - 2] : NULL);
        if (at_key && !check_key(b, b->stack[b->used - 1])) return false;
        if (at_value && !check_value(b, b->stack[b->used - 2], b->stack[b->used - 1])) return false;
    }
}

/* Build the node that `event` begins and push it; the event is used up. */
static bool read_node(builder *b, yaml_event_t *event, size_t depth)
{
    yaml_event_type_t type = event->type;
    size_t begin = byte_at(b, event->start_mark);
    nh_deck_node *node = NULL;
    bool good = check_properties(b, event);
    if (good && depth > DEPTH_LIMIT)
        good = nh_deck_fail_at(b->deck, begin, b->error, "lists and maps are nested deeper than %d", DEPTH_LIMIT);
    if (good && ++b->nodes > NODE_LIMIT)
        good = nh_deck_fail_at(b->deck, begin, b->error, "the file has more than %d values", NODE_LIMIT);
    if (good) {
        node = new_node(b, event);
        if (type == YAML_SCALAR_EVENT) good = fill_scalar(b, node, event);
    }
    yaml_event_delete(event);
    if (good && type == YAML_SEQUENCE_START_EVENT) {
        node->kind = NH_DECK_LIST;
        good = read_children(b, node, YAML_SEQUENCE_END_EVENT, depth);
    } else if (good && type == YAML_MAPPING_START_EVENT) {
        node->kind = NH_DECK_MAP;
        good = read_children(b, node, YAML_MAPPING_END_EVENT, depth) && check_duplicates(b, node);
    }
    if (good) push(b, node);
    return good;
}

static bool fail_empty(builder *b) { return nh_fail(b->error, NH_INPUT, b->deck->name, "this file is empty"); }

/* Take the next event and tell its type; `begin` gets its place. */
static bool take_event(builder *b, yaml_event_type_t *type, size_t *begin)
{
    yaml_event_t event;
    if (!next_event(b, &event)) return false;
    *type = event.type;
    *begin = byte_at(b, event.start_mark);
    yaml_event_delete(&event);
    return true;
}

/* STREAM-START DOCUMENT-START node DOCUMENT-END STREAM-END */
static bool read_document(builder *b)
{
    yaml_event_type_t type;
    yaml_event_t event;
    size_t begin;
    if (!take_event(b, &type, &begin) || !take_event(b, &type, &begin)) return false;
    if (type == YAML_STREAM_END_EVENT) return fail_empty(b);
    if (!next_event(b, &event) || !read_node(b, &event, 1)) return false;
    const nh_deck_node *root = b->stack[0];
    if (!take_event(b, &type, &begin) || !take_event(b, &type, &begin)) return false;
    if (type != YAML_STREAM_END_EVENT)
        return refuse(b, begin, "a second document begins here",
                      "one file holds one document: remove this line or split the file");
    if (root->kind == NH_DECK_SCALAR && root->plain && !root->text[0]) return fail_empty(b);
    b->deck->root = root;
    return true;
}

static bool build(nh_deck *deck, nh_error *error)
{
    builder b = {.deck = deck, .error = error};
    if (!yaml_parser_initialize(&b.parser)) nh_memory_ended(0);
    yaml_parser_set_encoding(&b.parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&b.parser, (const unsigned char *)deck->source, deck->length);
    bool good = read_document(&b);
    yaml_parser_delete(&b.parser);
    nh_free(b.stack);
    return good;
}

/* Checks that concern the bytes as a whole. */
static bool check_bytes(const char *name, const char *text, size_t length, nh_error *error)
{
    if (length > SIZE_LIMIT) return nh_fail(error, NH_INPUT, name, "the file is larger than %d MiB", SIZE_LIMIT >> 20);
    if (length >= 2 && (memcmp(text, "\xFF\xFE", 2) == 0 || memcmp(text, "\xFE\xFF", 2) == 0)) {
        nh_fail(error, NH_INPUT, name, "the encoding of this file is UTF-16");
        return nh_error_hint(error, "save the file in the encoding UTF-8");
    }
    return true;
}

nh_deck *nh_deck_parse(const char *name, const char *text, size_t length, nh_error *error)
{
    if (!check_bytes(name, text, length, error)) return NULL;
    nh_deck *deck = nh_deck_create(name, text, length);
    if (nh_xml_looks(deck)) /* its end is a tag: strings of C ending with NUL were written */
        while (deck->length && !deck->source[deck->length - 1]) deck->length--;
    if (nh_deck_check_text(deck, error) &&
        (nh_xml_looks(deck) ? (deck->root = nh_urdf_read(deck, error)) != NULL : build(deck, error)))
        return deck;
    nh_deck_free(deck);
    return NULL;
}

nh_deck *nh_deck_read(const char *path, nh_error *error)
{
    size_t length;
    char *text = nh_files_read(path, SIZE_LIMIT, &length, error);
    nh_deck *deck = text ? nh_deck_parse(path, text, length, error) : NULL;
    nh_free(text);
    return deck;
}
