/* deck: what is read, and the exact words and carets for what is not. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "system/deck.h"
#include "base/memory.h"
#include "base/text.h"
#include "scratch.h"
#include "sweep.h"

static char message[4096];

static const char *told(const nh_error *error)
{
    nh_error_format(error, message, sizeof message);
    return message;
}

static nh_deck *parse(const char *text)
{
    nh_error error;
    nh_error_clear(&error);
    nh_deck *deck = nh_deck_parse("f.yaml", text, strlen(text), &error);
    cr_assert_not_null(deck, "%s", told(&error));
    return deck;
}

static const char *refused_n(const char *text, size_t length)
{
    nh_error error;
    nh_error_clear(&error);
    nh_deck *deck = nh_deck_parse("f.yaml", text, length, &error);
    cr_assert_null(deck, "%s was accepted", text);
    cr_assert_eq(error.code, NH_INPUT);
    return told(&error);
}

static const char *refused(const char *text)
{
    return refused_n(text, strlen(text));
}

/* ---- the tree ---- */

Test(deck, remembers_kinds_texts_and_places)
{
    nh_deck *deck = parse("name: sleigh\nčas: {a: 1, b: [x, 'y z']}\nlist:\n- p\n-\n");
    const nh_deck_node *root = nh_deck_root(deck), *map = nh_deck_get(root, "čas");
    const nh_deck_node *list = nh_deck_get(map, "b"), *dashes = nh_deck_get(root, "list");
    cr_assert_str_eq(nh_deck_name(deck), "f.yaml");
    cr_assert_eq(root->kind, NH_DECK_MAP);
    cr_assert_eq(root->count, 3u);
    cr_assert_str_eq(root->key[1]->text, "čas");
    cr_assert_eq(map->kind, NH_DECK_MAP);
    cr_assert_eq(map->line, 2u);
    cr_assert_eq(map->column, 6u);
    cr_assert_eq(map->begin, 19u); /* č has two bytes */
    cr_assert_eq(map->end, 40u);
    cr_assert_eq(list->kind, NH_DECK_LIST);
    cr_assert_eq(list->count, 2u);
    cr_assert(list->item[0]->plain);
    cr_assert_not(list->item[1]->plain);
    cr_assert_str_eq(list->item[1]->text, "y z");
    cr_assert_eq(list->item[1]->column, 20u);
    cr_assert_eq(dashes->count, 2u);
    cr_assert_str_eq(dashes->item[1]->text, "");
    cr_assert(dashes->item[1]->plain);
    cr_assert_eq(dashes->begin, 47u);
    nh_deck_free(deck);
    nh_deck_free(NULL);
}

Test(deck, get_finds_only_in_maps)
{
    nh_deck *deck = parse("a: [1]\n");
    const nh_deck_node *root = nh_deck_root(deck);
    cr_assert_not_null(nh_deck_get(root, "a"));
    cr_assert_null(nh_deck_get(root, "b"));
    cr_assert_null(nh_deck_get(nh_deck_get(root, "a"), "a"));
    cr_assert_null(nh_deck_get(NULL, "a"));
    nh_deck_free(deck);
}

Test(deck, reads_byte_order_mark_crlf_and_document_marks)
{
    nh_deck *deck = parse("\xEF\xBB\xBF---\r\na: 1\r\nb: two\r\n  words\r\n...\r\n");
    const nh_deck_node *b = nh_deck_get(nh_deck_root(deck), "b");
    cr_assert_str_eq(b->text, "two words");
    cr_assert_eq(b->line, 3u);
    cr_assert_eq(b->column, 4u);
    nh_deck_free(deck);
}

Test(deck, expressions_need_few_quotes)
{
    nh_deck *deck = parse("- {name: energy, expr: m/2*x'^2, y: 3}\n- y' = x'*tan(phi)\n- -x + [1]\n- a:b\n- {in: [x', y'^2]}\n");
    const nh_deck_node *root = nh_deck_root(deck);
    cr_assert_str_eq(nh_deck_get(root->item[0], "expr")->text, "m/2*x'^2");
    cr_assert_str_eq(root->item[1]->text, "y' = x'*tan(phi)");
    cr_assert_str_eq(root->item[2]->text, "-x + [1]");
    cr_assert_str_eq(root->item[3]->text, "a:b");
    cr_assert_str_eq(nh_deck_get(root->item[4], "in")->item[1]->text, "y'^2");
    nh_deck_free(deck);
}

/* ---- what YAML cannot read ---- */

typedef struct {
    const char *text, *message;
} pair;

static void check_refusals(const pair *list, size_t count)
{
    for (size_t i = 0; i < count; i++)
        cr_expect_str_eq(refused(list[i].text), list[i].message, "for %s:\n%s\n", list[i].text, message);
}

#define CHECK_REFUSALS(list) check_refusals(list, sizeof list / sizeof list[0])
#define QUOTE "put the expression in double quotes"
#define COMMA "inside { } and [ ] a comma ends the entry: put the expression in double quotes"
#define ALIGNED "start all entries of a map, and all items of a list, in the same column"
#define ESCAPE "a backslash in double quotes begins an escape sequence; this is not one"
#define BACKSLASH "write \\\\ for a backslash, or use single quotes"

Test(deck, explains_expressions_that_yaml_takes_for_something_else)
{
    static const pair list[] = {
        {"a: 'phi' + 1\n", "f.yaml:1:10: unexpected text after the end of the value\n  a: 'phi' + 1\n           ^\nhint: " QUOTE ", all of it"},
        {"a: [x]*2\n", "f.yaml:1:7: unexpected text after the end of the value\n  a: [x]*2\n        ^\nhint: " QUOTE ", all of it"},
        {"a: *phi + 1\n", "f.yaml:1:4: a value cannot begin with `*` (YAML's aliases are not used here)\n  a: *phi + 1\n     ^\nhint: " QUOTE},
        {"a: *phi*x\n", "f.yaml:1:4: a value cannot begin with `*`\n  a: *phi*x\n     ^\nhint: " QUOTE},
        {"a: &phi 1\n", "f.yaml:1:4: a value cannot begin with `&` (YAML's anchors are not used here)\n  a: &phi 1\n     ^\nhint: " QUOTE},
        {"a: &phi [1]\n", "f.yaml:1:4: a value cannot begin with `&` (YAML's anchors are not used here)\n  a: &phi [1]\n     ^\nhint: " QUOTE},
        {"a: &phi {b: 1}\n", "f.yaml:1:4: a value cannot begin with `&` (YAML's anchors are not used here)\n  a: &phi {b: 1}\n     ^\nhint: " QUOTE},
        {"a: !!int 1\n", "f.yaml:1:4: a value cannot begin with `!` (YAML's tags are not used here)\n  a: !!int 1\n     ^\nhint: " QUOTE},
        {"a: !!seq [1]\n", "f.yaml:1:4: a value cannot begin with `!` (YAML's tags are not used here)\n  a: !!seq [1]\n     ^\nhint: " QUOTE},
        {"a: !!map {b: 1}\n", "f.yaml:1:4: a value cannot begin with `!` (YAML's tags are not used here)\n  a: !!map {b: 1}\n     ^\nhint: " QUOTE},
        {"a: !x!y 1\n", "f.yaml:1:4: a value cannot begin with `!`\n  a: !x!y 1\n     ^\nhint: " QUOTE},
        {"a: !{ 1\n", "f.yaml:1:4: a value cannot begin with `!`\n  a: !{ 1\n     ^\nhint: " QUOTE},
        {"a: @x\n", "f.yaml:1:4: a value cannot begin with `@`\n  a: @x\n     ^\nhint: " QUOTE},
        {"a: |x| + 1\n", "f.yaml:1:4: a value cannot begin with `|`\n  a: |x| + 1\n     ^\nhint: " QUOTE},
        {"{a: |x|}\n", "f.yaml:1:5: a value cannot begin with `|`\n  {a: |x|}\n      ^\nhint: " QUOTE},
        {"a: ? x\n", "f.yaml:1:4: a value cannot begin with `?`\n  a: ? x\n     ^\nhint: " QUOTE},
        {"%x: 1\n", "f.yaml:1:1: YAML reads a line that begins with `%` as a directive\n  %x: 1\n  ^\nhint: " QUOTE},
        {"a: b: c\n", "f.yaml:1:5: this `:` is not allowed here\n  a: b: c\n      ^\nhint: write `a: {b: c}`"},
        {"a: - x\n", "f.yaml:1:4: a list item `- ` is not allowed here\n  a: - x\n     ^\nhint: begin the list on a line of its own, or put the expression in double quotes"},
        {"a: 1\nb:2\n", "f.yaml:2:1: expected `key: value`\n  b:2\n  ^\nhint: write a space after the colon: `b: 2`"},
        {"a: \"x\\q\"\n", "f.yaml:1:6: " ESCAPE "\n  a: \"x\\q\"\n       ^\nhint: " BACKSLASH},
        {"a: \"\\xq\"\n", "f.yaml:1:5: " ESCAPE "\n  a: \"\\xq\"\n      ^\nhint: " BACKSLASH},
        {"a: \"\\ud800\"\n", "f.yaml:1:5: " ESCAPE "\n  a: \"\\ud800\"\n      ^\nhint: " BACKSLASH},
    };
    CHECK_REFUSALS(list);
}

Test(deck, explains_commas_and_brackets)
{
    static const pair list[] = {
        {"- {expr: atan2(y, x)}\n", "f.yaml:1:17: this comma stands inside parentheses\n  - {expr: atan2(y, x)}\n                  ^\nhint: " COMMA},
        {"[\"a\", f(é, x)]\n", "f.yaml:1:10: this comma stands inside parentheses\n  [\"a\", f(é, x)]\n           ^\nhint: " COMMA},
        {"- {expr: x, y + 1}\n", "f.yaml:1:13: `y + 1` has no value\n  - {expr: x, y + 1}\n              ^\nhint: " COMMA},
        {"{a:1, b: 2}\n", "f.yaml:1:2: `a:1` has no value\n  {a:1, b: 2}\n   ^\nhint: write a space after the colon"},
        {"a: [1, 2\n\n", "f.yaml:1:4: this `[` is not closed\n  a: [1, 2\n     ^\nhint: add `]`, or write an expression that contains `[` in double quotes"},
        {"a: {b: 2", "f.yaml:1:4: this `{` is not closed\n  a: {b: 2\n     ^\nhint: add `}`, or write an expression that contains `{` in double quotes"},
        {"a: [1, 2\nb: 3\n", "f.yaml:2:2: expected `,` or `]` in the list that begins with `[` in line 1\n  b: 3\n   ^\nhint: is the `[` in line 1 closed?"},
        {"- {a: 1\n- {b: 1}\n", "f.yaml:2:3: expected `,` or `}` in the map that begins with `{` in line 1\n  - {b: 1}\n    ^\nhint: is the `{` in line 1 closed?"},
        {"{a: 'x' + 1}\n", "f.yaml:1:9: expected `,` or `}` in the map that begins with `{` in line 1\n  {a: 'x' + 1}\n          ^\nhint: " QUOTE},
        {"[1,, 2]\n", "f.yaml:1:4: expected a value here\n  [1,, 2]\n     ^\nhint: write the value, or put an expression with commas in double quotes"},
        {"a: [1,\n\n", "f.yaml:1:7: expected a value here\n  a: [1,\n        ^\nhint: write the value, or put an expression with commas in double quotes"},
        {"a: ]\n", "f.yaml:1:4: expected a value here\n  a: ]\n     ^\nhint: write the value, or put an expression with commas in double quotes"},
        {"a: 'x + 1\nb: 2\n", "f.yaml:1:4: this quote is not closed\n  a: 'x + 1\n     ^\nhint: a value that begins with a quote ends with the same quote; an expression that begins with one goes into double quotes"},
        {"a: 'x + 1\n---\n", "f.yaml:1:4: this quote is not closed\n  a: 'x + 1\n     ^\nhint: close it before the line that begins with --- or ..."},
    };
    CHECK_REFUSALS(list);
}

Test(deck, explains_indentation_and_keys)
{
    static const pair list[] = {
        {"a:\n\t- x\n", "f.yaml:2:1: YAML needs spaces here, not a tab\n   - x\n  ^\nhint: indent with spaces"},
        {"a: |\n\n\tx\n", "f.yaml:3:1: YAML needs spaces here, not a tab\n   x\n  ^\nhint: indent with spaces"},
        {"a: 1\n  b: 2\n", "f.yaml:2:4: this `:` is not allowed here\n    b: 2\n     ^\nhint: put a text that contains `: ` in double quotes; keys of one map begin in the same column"},
        {"a:\n  - x\n y\n", "f.yaml:3:2: this line does not fit the map that begins in line 1\n   y\n   ^\nhint: " ALIGNED},
        {"-\n  - x\n y\n", "f.yaml:3:2: this line does not fit the list that begins in line 1\n   y\n   ^\nhint: " ALIGNED},
        {"  a: 1\nb: 2\n", "f.yaml:2:1: this line does not continue the text above\n  b: 2\n  ^\nhint: keys of one map begin in the same column; put an expression with quotes or brackets in double quotes"},
        {"m: 1\nk: 2\nm: 3\nk: 4\nm: 5\n", "f.yaml:3:1: the key `m` occurs already in line 1\n  m: 3\n  ^\nhint: remove or rename one of them"},
        {"{\"m\": 1, m: 2}\n", "f.yaml:1:10: the key `m` occurs already in line 1\n  {\"m\": 1, m: 2}\n           ^\nhint: remove or rename one of them"},
        {"[x]: 1\n", "f.yaml:1:1: a key must be a word, found a list\n  [x]: 1\n  ^\nhint: " QUOTE},
        {"{x: y}: 1\n", "f.yaml:1:1: a key must be a word, found a map\n  {x: y}: 1\n  ^\nhint: " QUOTE},
        {": 1\n", "f.yaml:1:1: there is no key before the `:`\n  : 1\n  ^\nhint: write `key: value`"},
        {"a: {'': 1}\n", "f.yaml:1:5: there is no key before the `:`\n  a: {'': 1}\n      ^\nhint: write `key: value`"},
        {"<<: {a: 1}\n", "f.yaml:1:1: merge keys (`<<`) are not supported\n  <<: {a: 1}\n  ^\nhint: write out the entries"},
        {"---\na: 1\n---\nb: 2\n", "f.yaml:3:1: a second document begins here\n  ---\n  ^\nhint: one file holds one document: remove this line or split the file"},
        {"%YAML 1.1\n%YAML 1.1\n---\na: 1\n", "f.yaml:2:1: this is not YAML: found duplicate %YAML directive\n  %YAML 1.1\n  ^"},
        {"%YAML 1.7\n---\na: 1\n", "f.yaml:1:1: unsupported version of YAML\n  %YAML 1.7\n  ^\nhint: remove this line"},
    };
    CHECK_REFUSALS(list);
}

Test(deck, refuses_what_is_no_text)
{
    static const pair list[] = {
        {"a: é\xE9 é\n", "f.yaml:1:5: the byte 0xE9 is not part of UTF-8 text\n  a: é? é\n      ^\nhint: save the file in the encoding UTF-8"},
        {"a: \xC0\x80\n", "f.yaml:1:4: the byte 0xC0 is not part of UTF-8 text\n  a: ??\n     ^\nhint: save the file in the encoding UTF-8"},
        {"a: \xED\xA0\x80\n", "f.yaml:1:4: the byte 0xED is not part of UTF-8 text\n  a: ???\n     ^\nhint: save the file in the encoding UTF-8"},
        {"a: \xF4\x90\x80\x80\n", "f.yaml:1:4: the byte 0xF4 is not part of UTF-8 text\n  a: ????\n     ^\nhint: save the file in the encoding UTF-8"},
        {"a: \xE2\x82", "f.yaml:1:4: the byte 0xE2 is not part of UTF-8 text\n  a: ??\n     ^\nhint: save the file in the encoding UTF-8"},
        {"a: x\x1B[0m\n", "f.yaml:1:5: there is an invisible character (U+001B) in the text\n  a: x?[0m\n      ^\nhint: remove it, or write a space or a new line instead"},
        {"a: x\xE2\x80\xA8y\n", "f.yaml:1:5: there is an invisible character (U+2028) in the text\n  a: x???y\n      ^\nhint: remove it, or write a space or a new line instead"},
        {"a: \"x\\e[0m\"\n", "f.yaml:1:4: this text contains a control character\n  a: \"x\\e[0m\"\n     ^\nhint: remove the escape that stands for it"},
        {"a: \"x\\Ny\"\n", "f.yaml:1:4: this text contains a control character\n  a: \"x\\Ny\"\n     ^\nhint: remove the escape that stands for it"},
        {"a: \"x\\0y\"\n", "f.yaml:1:4: this text contains a control character\n  a: \"x\\0y\"\n     ^\nhint: remove the escape that stands for it"},
        {"", "f.yaml: this file is empty"},
        {"# only a remark\n\n", "f.yaml: this file is empty"},
        {"---\n", "f.yaml: this file is empty"},
        {"\xFF\xFE" "a", "f.yaml: the encoding of this file is UTF-16\nhint: save the file in the encoding UTF-8"},
    };
    CHECK_REFUSALS(list);
    cr_expect_str_eq(refused_n("a: \0b\n", 6), "f.yaml:1:4: there is a NUL byte in the text\n  a: ?b\n     ^\nhint: is this a text file?");
}

/* ---- bounds ---- */

Test(deck, bounds_depth)
{
    char text[200] = "";
    for (int i = 0; i < 63; i++)
        strcat(text, "[");
    strcat(text, "x");
    for (int i = 0; i < 63; i++)
        strcat(text, "]");
    nh_deck_free(parse(text));
    memset(text, '[', 150);
    text[150] = '\0';
    cr_assert_eq(strncmp(refused(text), "f.yaml:1:65: lists and maps are nested deeper than 64\n", 54), 0, "%s", message);
}

Test(deck, bounds_the_number_of_values)
{
    nh_text text;
    nh_text_init(&text);
    for (int i = 0; i < 199999; i++)
        nh_text_add(&text, "- 1\n");
    nh_deck_free(parse(nh_text_string(&text)));
    nh_text_add(&text, "- 1\n");
    cr_assert_str_eq(refused(nh_text_string(&text)), "f.yaml:200000:3: the file has more than 200000 values\n  - 1\n    ^");
    nh_text_clear(&text);
}

Test(deck, bounds_size)
{
    size_t limit = (size_t)4 << 20;
    char *text = nh_alloc(limit + 2);
    memset(text, 'x', limit);
    nh_deck_free(parse(text));
    text[limit] = 'x';
    cr_assert_str_eq(refused(text), "f.yaml: the file is larger than 4 MiB");
    nh_free(text);
}

/* ---- files ---- */

static const char *unread(const char *path)
{
    nh_error error;
    nh_error_clear(&error);
    cr_assert_null(nh_deck_read(path, &error));
    cr_assert_eq(error.code, NH_INPUT);
    return told(&error);
}

Test(deck, reads_files)
{
    char path[SCRATCH];
    nh_error error;
    nh_error_clear(&error);
    cr_assert(scratch_text(path, "a: 2.385\n"));
    nh_deck *deck = nh_deck_read(path, &error);
    unlink(path);
    cr_assert_not_null(deck, "%s", told(&error));
    cr_assert_str_eq(nh_deck_name(deck), path);
    cr_assert_str_eq(nh_deck_get(nh_deck_root(deck), "a")->text, "2.385");
    nh_deck_free(deck);
}

Test(deck, tells_why_a_file_is_not_read)
{
    cr_expect_str_eq(unread("/no/such.yaml"), "/no/such.yaml: this file cannot be opened: No such file or directory");
    cr_expect_str_eq(unread("/tmp"), "/tmp: this is a directory, not a file");
    cr_expect_str_eq(unread("/dev/null"), "/dev/null: this file is empty");
    cr_expect_str_eq(unread("/dev/zero"), "/dev/zero: the file is larger than 4 MiB");
    if (access("/proc/self/mem", R_OK) == 0)
        cr_expect_str_eq(unread("/proc/self/mem"), "/proc/self/mem: this file cannot be read: Input/output error");
}

/* ---- carets ---- */

/* The value of `a` as the reader of an expression sees it: find `word` in the text, fail there. */
static const char *pointed(const char *source, const char *word)
{
    nh_error error;
    nh_error_clear(&error);
    nh_deck *deck = parse(source);
    const nh_deck_node *node = nh_deck_get(nh_deck_root(deck), "a");
    const char *at = strstr(node->text, word);
    cr_assert_not_null(at, "no %s in %s", word, node->text);
    cr_assert_not(nh_deck_fail(deck, node, (size_t)(at - node->text), &error, "unknown name `%s`", word));
    nh_deck_free(deck);
    return told(&error);
}

#define POINTS(source, word, expected) cr_expect_str_eq(pointed(source, word), expected, "%s\n", message)

Test(caret, in_plain_text)
{
    POINTS("a: m*phii + 1\n", "phii", "f.yaml:1:6: unknown name `phii`\n  a: m*phii + 1\n       ^");
    POINTS("a: m*phii + 1\n", "m*", "f.yaml:1:4: unknown name `m*`\n  a: m*phii + 1\n     ^");
    POINTS("a: é€😀 phii\n", "phii", "f.yaml:1:8: unknown name `phii`\n  a: é€😀 phii\n         ^");
    POINTS("a:\tm  *\tphii\n", "phii", "f.yaml:1:9: unknown name `phii`\n  a: m  * phii\n          ^");
}

Test(caret, in_folded_lines)
{
    const char *source = "a: m/2*(x'^2\r\n     + 1  \r\n\r\n   \r\n   + phii)\n";
    POINTS(source, "+ 1", "f.yaml:2:6: unknown name `+ 1`\n       + 1  \n       ^");
    POINTS(source, "phii", "f.yaml:5:6: unknown name `phii`\n     + phii)\n       ^");
    POINTS(source, " + 1", "f.yaml:1:13: unknown name ` + 1`\n  a: m/2*(x'^2\n              ^");
    POINTS("a: \"x\n\n\n  + phii\"\n", "phii", "f.yaml:4:5: unknown name `phii`\n    + phii\"\n      ^");
    POINTS("a: 'x\n  + phii'\n", "phii", "f.yaml:2:5: unknown name `phii`\n    + phii'\n      ^");
}

Test(caret, in_quotes)
{
    POINTS("a: 'phii'\n", "phii", "f.yaml:1:5: unknown name `phii`\n  a: 'phii'\n      ^");
    POINTS("a: 'x'' + y''^2 + phii'\n", "phii", "f.yaml:1:19: unknown name `phii`\n  a: 'x'' + y''^2 + phii'\n                    ^");
    POINTS("a: 'x'' + 1'\n", "' + 1", "f.yaml:1:6: unknown name `' + 1`\n  a: 'x'' + 1'\n       ^");
    POINTS("a: \"\\\"q\\\" \\x41\\u00e9\\U0001F600\\_\\t phii\"\n", "phii",
           "f.yaml:1:36: unknown name `phii`\n  a: \"\\\"q\\\" \\x41\\u00e9\\U0001F600\\_\\t phii\"\n                                     ^");
    POINTS("a: \"x + \\\n\n    y + phii\"\n", "phii", "f.yaml:3:9: unknown name `phii`\n      y + phii\"\n          ^");
    POINTS("a: \"x + \\\n    phii\"\n", "phii", "f.yaml:2:5: unknown name `phii`\n      phii\"\n      ^");
}

Test(caret, in_the_middle_of_a_character_stands_before_it)
{
    nh_error error;
    nh_error_clear(&error);
    nh_deck *deck = parse("a: x€y\n");
    nh_deck_fail(deck, nh_deck_get(nh_deck_root(deck), "a"), 3, &error, "stop");
    nh_deck_free(deck);
    cr_assert_str_eq(told(&error), "f.yaml:1:5: stop\n  a: x€y\n      ^");
}

Test(caret, of_a_long_file_name_the_place_survives)
{
    char name[1001];
    memset(name, 'd', 1000);
    name[1000] = '\0';
    nh_error error;
    nh_error_clear(&error);
    cr_assert_null(nh_deck_parse(name, "a: @", 4, &error));
    cr_assert_eq(strlen(error.where), sizeof error.where - 1);
    cr_assert_str_eq(error.where + sizeof error.where - 9, "dddd:1:4");
}

Test(caret, in_blocks)
{
    const char *literal = "a: |-  # remark\n\n    x +\n      y\n\n    + phii\nb: 1\n";
    POINTS(literal, "x", "f.yaml:3:5: unknown name `x`\n      x +\n      ^");
    POINTS(literal, "y", "f.yaml:4:7: unknown name `y`\n        y\n        ^");
    POINTS(literal, "phii", "f.yaml:6:7: unknown name `phii`\n      + phii\n        ^");
    POINTS("a: |2\n    x +\n   y\n", "y", "f.yaml:3:4: unknown name `y`\n     y\n     ^");
    const char *folded = "a: >\r\n  one\r\n  two\r\n\r\n  three\r\n    four\r\n  five\r\n";
    POINTS(folded, "two", "f.yaml:3:3: unknown name `two`\n    two\n    ^");
    POINTS(folded, "three", "f.yaml:5:3: unknown name `three`\n    three\n    ^");
    POINTS(folded, "four", "f.yaml:6:5: unknown name `four`\n      four\n      ^");
    POINTS(folded, "five", "f.yaml:7:3: unknown name `five`\n    five\n    ^");
}

static const char *pointed_at(const char *source, size_t offset)
{
    nh_error error;
    nh_error_clear(&error);
    nh_deck *deck = parse(source);
    nh_deck_fail(deck, nh_deck_get(nh_deck_root(deck), "a"), offset, &error, "stop");
    nh_deck_free(deck);
    return told(&error);
}

Test(caret, at_the_end_and_beyond)
{
    cr_expect_str_eq(pointed_at("a: x +\nb: 1\n", 3), "f.yaml:1:7: stop\n  a: x +\n        ^");
    cr_expect_str_eq(pointed_at("a: x +\nb: 1\n", 999), "f.yaml:1:7: stop\n  a: x +\n        ^");
    cr_expect_str_eq(pointed_at("a: 'x +'\n", 3), "f.yaml:1:8: stop\n  a: 'x +'\n         ^");
    cr_expect_str_eq(pointed_at("a: |\n  x +\n\nb: 1\n", 4), "f.yaml:2:6: stop\n    x +\n       ^");
    cr_expect_str_eq(pointed_at("a:\nb: 1\n", 0), "f.yaml:1:3: stop\n  a:\n    ^");
    cr_expect_str_eq(pointed_at("a: ''\n", 0), "f.yaml:1:5: stop\n  a: ''\n      ^");
    cr_expect_str_eq(pointed_at("b: 1\na: [x,\n  y]\n", 0), "f.yaml:2:4: stop\n  a: [x,\n     ^");
}

Test(caret, without_a_node_the_file_is_named)
{
    nh_error error;
    nh_error_clear(&error);
    nh_deck *deck = parse("a: 1\n");
    nh_deck_fail(deck, NULL, 0, &error, "there is no `%s`", "lagrangian");
    cr_assert_str_eq(told(&error), "f.yaml: there is no `lagrangian`");
    nh_deck_fail(deck, nh_deck_root(deck), 0, &error, "second");
    cr_assert_str_eq(told(&error), "f.yaml: there is no `lagrangian`");
    cr_assert_not(nh_deck_fail(deck, nh_deck_root(deck), 0, NULL, "nobody listens"));
    nh_deck_free(deck);
}

/* 300 columns: "a: " and 297 letters, the word at `column` (from 1).  The excerpt's line has 100 columns, and dots. */
static void check_window(size_t column, const char *first, size_t caret, bool dots_after)
{
    char source[301], *lines[3] = {0}, *rest;
    memset(source, 'x', 300);
    memcpy(source, "a: ", 3);
    source[column - 1] = 'W';
    source[300] = '\0';
    char *copy = nh_strdup(pointed(source, "W"));
    for (size_t i = 0; i < 3; i++)
        lines[i] = strtok_r(i == 0 ? copy : NULL, "\n", &rest);
    size_t width = nh_text_width(lines[1]), dots = (strncmp(first, "…", 3) == 0) + dots_after;
    cr_expect_eq(strncmp(lines[1] + 2, first, strlen(first)), 0, "%s", lines[1]);
    cr_expect_eq(width, 2 + 100 + dots, "%zu", width);
    cr_expect_eq(strcmp(lines[1] + strlen(lines[1]) - 3, "…") == 0, dots_after, "%s", lines[1]);
    cr_expect_eq(strlen(lines[2]), 2 + caret, "%s", lines[2]);
    const char *under = lines[1] + 2 + caret - 1 + (strncmp(first, "…", 3) == 0 ? 2 : 0); /* … has three bytes */
    cr_expect_eq(*under, 'W', "%s\n%s", lines[1], lines[2]);
    nh_free(copy);
}

Test(caret, long_lines_are_seen_through_a_window)
{
    check_window(10, "a: x", 10, true);
    check_window(150, "…xx", 52, true);
    check_window(300, "…xx", 101, false);
}

/* ---- typed access ---- */

static const char *source_of_values =
    "n: 2.385\nq: '3'\nw: abc\nl: [1, 2]\nm: {x: 1}\ne:\nbig: 1e999\nseed: 1234567890123456789\nr: [-1.5, 2]\n"
    "up: [2, 1]\nthree: [1, 2, 3]\nbad: [1, x]\nh: 1.5\nhuge: 99999999999999999999\nmega: 1e6\nempty: ''\nsmall: 1e-999\n";

static nh_deck *values;
static nh_error failure;

static void setup(void)
{
    values = parse(source_of_values);
    nh_error_clear(&failure);
}

static void teardown(void)
{
    nh_deck_free(values);
}

TestSuite(typed, .init = setup, .fini = teardown);

static const nh_deck_node *of(const char *key)
{
    return nh_deck_get(nh_deck_root(values), key);
}

static const char *not_number(const char *key, const char *what)
{
    double out = 7;
    nh_error_clear(&failure);
    cr_assert_not(nh_deck_number(values, of(key), what, &out, &failure));
    cr_assert_eq(out, 7);
    return told(&failure);
}

Test(typed, numbers)
{
    double out = 0;
    cr_assert(nh_deck_number(values, of("n"), "value", &out, &failure));
    cr_assert_eq(out, 2.385);
    cr_expect_str_eq(not_number("l", "value"), "f.yaml:4:4: `value` must be a number, found a list\n  l: [1, 2]\n     ^");
    cr_expect_str_eq(not_number("m", "value"), "f.yaml:5:4: `value` must be a number, found a map\n  m: {x: 1}\n     ^");
    cr_expect_str_eq(not_number("w", "the mass"), "f.yaml:3:4: the mass must be a number, found `abc`\n  w: abc\n     ^");
    cr_expect_str_eq(not_number("e", "value"), "f.yaml:6:3: `value` must be a number, found nothing\n  e:\n    ^");
    cr_expect_str_eq(not_number("empty", "value"), "f.yaml:16:9: `value` must be a number, found an empty text\n  empty: ''\n          ^");
    cr_expect_str_eq(not_number("none", "value"), "f.yaml: `value` is missing");
    cr_expect_str_eq(not_number("big", "value"), "f.yaml:7:6: `value` must be a number that a double can hold, found `1e999`\n  big: 1e999\n       ^");
    cr_expect_str_eq(not_number("small", "value"), "f.yaml:17:8: `value` must be a number that a double can hold, found `1e-999`\n  small: 1e-999\n         ^");
    cr_expect_str_eq(not_number("q", "value"), "f.yaml:2:5: `value` must be a number, found the text `3`\n  q: '3'\n      ^\nhint: remove the quotes: a quoted value is a text");
}

Test(typed, numbers_as_people_write_them)
{
    static const struct {
        const char *text;
        double value;
    } good[] = {{"1", 1}, {"-2.5", -2.5}, {"1e-3", 1e-3}, {".5", .5}, {"5.", 5}, {"+3E+2", 300}, {"-.25e1", -2.5}, {"007", 7}, {"0e-999", 0}};
    static const char *const bad[] = {"1e", "e1", ".", "1.2.3", "0x10", "1_000", ".inf", ".nan", "inf", "nan", "1 2", "1e+", "2m", "1,5", "١"};
    char text[64];
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        double out = 99;
        snprintf(text, sizeof text, "a: %s\n", good[i].text);
        nh_deck *deck = parse(text);
        cr_expect(nh_deck_number(deck, nh_deck_get(nh_deck_root(deck), "a"), "a", &out, NULL), "%s", text);
        cr_expect_eq(out, good[i].value, "%s", text);
        nh_deck_free(deck);
    }
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        double out;
        snprintf(text, sizeof text, "a: %s\n", bad[i]);
        nh_deck *deck = parse(text);
        cr_expect_not(nh_deck_number(deck, nh_deck_get(nh_deck_root(deck), "a"), "a", &out, NULL), "%s", text);
        nh_deck_free(deck);
    }
}

static const char *not_whole(const char *key, long min, long max)
{
    long out = 7;
    nh_error_clear(&failure);
    cr_assert_not(nh_deck_whole(values, of(key), "samples", min, max, &out, &failure));
    cr_assert_eq(out, 7);
    return told(&failure);
}

Test(typed, whole_numbers)
{
    long out = 0;
    cr_assert(nh_deck_whole(values, of("seed"), "seed", 0, LONG_MAX, &out, &failure));
    cr_assert_eq(out, 1234567890123456789L);
    cr_assert(nh_deck_whole(values, of("mega"), "samples", 1, 1000000, &out, &failure));
    cr_assert_eq(out, 1000000);
    cr_expect_str_eq(not_whole("mega", 1, 999999), "f.yaml:15:7: `samples` must be a whole number from 1 to 999999, found `1e6`\n  mega: 1e6\n        ^");
    cr_expect_str_eq(not_whole("h", 1, LONG_MAX), "f.yaml:13:4: `samples` must be a whole number, at least 1, found `1.5`\n  h: 1.5\n     ^");
    cr_expect_str_eq(not_whole("w", LONG_MIN, 5), "f.yaml:3:4: `samples` must be a whole number, at most 5, found `abc`\n  w: abc\n     ^");
    cr_expect_str_eq(not_whole("huge", LONG_MIN, LONG_MAX), "f.yaml:14:7: `samples` must be a whole number, found `99999999999999999999`\n  huge: 99999999999999999999\n        ^");
    cr_expect_str_eq(not_whole("q", 1, 9), "f.yaml:2:5: `samples` must be a whole number from 1 to 9, found the text `3`\n  q: '3'\n      ^\nhint: remove the quotes: a quoted value is a text");
    cr_expect_str_eq(not_whole("big", 1, 9), "f.yaml:7:6: `samples` must be a whole number from 1 to 9, found `1e999`\n  big: 1e999\n       ^");
    cr_expect_str_eq(not_whole("none", 1, 9), "f.yaml: `samples` is missing");
}

static const char *not_range(const char *key)
{
    double out[2] = {7, 8};
    nh_error_clear(&failure);
    cr_assert_not(nh_deck_range(values, of(key), "phi", out, &failure));
    cr_assert(out[0] == 7 && out[1] == 8);
    return told(&failure);
}

Test(typed, ranges)
{
    double out[2];
    cr_assert(nh_deck_range(values, of("r"), "phi", out, &failure));
    cr_assert(out[0] == -1.5 && out[1] == 2);
    cr_expect_str_eq(not_range("n"), "f.yaml:1:4: `phi` must be a range [low, high], found `2.385`\n  n: 2.385\n     ^");
    cr_expect_str_eq(not_range("three"), "f.yaml:11:8: `phi` must be a range [low, high], found a list of 3\n  three: [1, 2, 3]\n         ^");
    cr_expect_str_eq(not_range("bad"), "f.yaml:12:10: the upper end of `phi` must be a number, found `x`\n  bad: [1, x]\n           ^");
    cr_expect_str_eq(not_range("up"), "f.yaml:10:9: `phi` must be a range [low, high] with low < high, found [2, 1]\n  up: [2, 1]\n          ^");
    cr_expect_str_eq(not_range("none"), "f.yaml: `phi` is missing");
}

Test(typed, kinds)
{
    cr_assert(nh_deck_is(values, of("l"), NH_DECK_LIST, "l", &failure));
    cr_assert_not(nh_deck_is(values, of("l"), NH_DECK_MAP, "domain", &failure));
    cr_expect_str_eq(told(&failure), "f.yaml:4:4: `domain` must be a map (`key: value`), found a list\n  l: [1, 2]\n     ^");
    nh_error_clear(&failure);
    cr_assert_not(nh_deck_is(values, of("w"), NH_DECK_LIST, "constraints", &failure));
    cr_expect_str_eq(told(&failure), "f.yaml:3:4: `constraints` must be a list, found `abc`\n  w: abc\n     ^\nhint: a list is written [a, b], or one item per line, each after `- `");
    nh_error_clear(&failure);
    cr_assert_not(nh_deck_is(values, of("m"), NH_DECK_SCALAR, "name", &failure));
    cr_expect_str_eq(told(&failure), "f.yaml:5:4: `name` must be a single value, found a map\n  m: {x: 1}\n     ^");
}

Test(typed, a_missing_space_after_a_colon_is_noticed)
{
    nh_deck *deck = parse("name:sleigh\n");
    cr_assert_not(nh_deck_is(deck, nh_deck_root(deck), NH_DECK_MAP, "the system", &failure));
    cr_expect_str_eq(told(&failure), "f.yaml:1:1: the system must be a map (`key: value`), found `name:sleigh`\n  name:sleigh\n  ^\nhint: write a space after the colon");
    nh_deck_free(deck);
}

Test(typed, long_values_are_shortened_in_messages)
{
    char text[512] = "a: ", expected[512] = "";
    for (int i = 0; i < 60; i++)
        strcat(text, "é");
    nh_deck *deck = parse(text);
    double out;
    cr_assert_not(nh_deck_number(deck, nh_deck_get(nh_deck_root(deck), "a"), "a", &out, &failure));
    strcat(expected, "`a` must be a number, found `");
    for (int i = 0; i < 40; i++)
        strcat(expected, "é");
    strcat(expected, "…`");
    cr_expect_str_eq(failure.what, expected);
    nh_deck_free(deck);
}

static const char *const known[] = {"name", "expr", "source"};

static const char *not_only(const char *source)
{
    nh_deck *deck = parse(source);
    nh_error_clear(&failure);
    cr_assert_not(nh_deck_only(deck, nh_deck_root(deck), known, 3, &failure));
    nh_deck_free(deck);
    return told(&failure);
}

Test(typed, unknown_keys)
{
    nh_deck *deck = parse("{expr: 1, name: 2}");
    cr_assert(nh_deck_only(deck, nh_deck_root(deck), known, 3, &failure));
    nh_deck_free(deck);
    cr_expect_str_eq(not_only("name: x\nexrp: 1\n"), "f.yaml:2:1: unknown key `exrp`\n  exrp: 1\n  ^\nhint: did you mean `expr`?");
    cr_expect_str_eq(not_only("colour: 1\n"), "f.yaml:1:1: unknown key `colour`\n  colour: 1\n  ^\nhint: known keys: name, expr, source");
    cr_expect_str_eq(not_only("{expr: 1, y: 3}\n"), "f.yaml:1:11: unknown key `y`\n  {expr: 1, y: 3}\n            ^\nhint: known keys: name, expr, source");
    cr_expect_str_eq(not_only("{expr: 1, y): 3}\n"), "f.yaml:1:11: unknown key `y)`\n  {expr: 1, y): 3}\n            ^\nhint: if it belongs to an expression, " QUOTE "; known keys: name, expr, source");
    cr_expect_str_eq(not_only("{name: a, Formula: 3}\n"), "f.yaml:1:11: unknown key `Formula`\n  {name: a, Formula: 3}\n            ^\nhint: did you mean `expr`?");
    cr_expect_str_eq(not_only("- x\n"), "f.yaml:1:1: this entry must be a map (`key: value`), found a list\n  - x\n  ^");
}

Test(typed, the_first_cause_stays_with_its_hint)
{
    double out;
    nh_fail(&failure, NH_NUMERIC, "", "first");
    cr_assert_not(nh_deck_number(values, of("q"), "q", &out, &failure));
    cr_assert_not(nh_deck_only(values, nh_deck_root(values), known, 3, &failure));
    cr_assert_not(nh_deck_is(values, of("w"), NH_DECK_MAP, "w", &failure));
    cr_expect_str_eq(told(&failure), "first");
}

/* ---- garbage ---- */

static unsigned draw(unsigned long long *state)
{
    *state ^= *state << 13, *state ^= *state >> 7, *state ^= *state << 17;
    return (unsigned)(*state >> 32);
}

/* Every caret of a text that was read points at the letter it is about; whatever is refused has a message. */
static void check_carets(const nh_deck *deck, const nh_deck_node *node, const char *source)
{
    for (size_t i = 0; i < node->count; i++) {
        check_carets(deck, node->item[i], source);
        if (node->kind == NH_DECK_MAP)
            check_carets(deck, node->key[i], source);
    }
    cr_assert_leq(node->begin, node->end);
    cr_assert_leq(node->end, strlen(source));
    for (size_t i = 0; i < strlen(node->text); i++) {
        nh_error error;
        nh_error_clear(&error);
        nh_deck_fail(deck, node, i, &error, "x");
        char *caret = strrchr(error.excerpt, '\n'), letter = node->text[i];
        if (letter < '*' || letter > 'z' || letter == '\\' || source[node->begin] == '"' || source[node->begin] == '\\')
            continue; /* blanks are folded, quotes doubled; escapes hide the letter; \\ before a name is dropped */
        size_t column = strlen(caret) - 1;
        cr_assert_eq(error.excerpt[column - 1], letter, "%zu of <%s> in\n%s\n%s", i, node->text, source, error.excerpt);
    }
}

Test(garbage, is_survived, PLAIN_ONLY)
{
    static const char start[] = "name: x\nl: m/2*(x' +\n   y')\n\n   + z\np: [{n: 'a''b\n  c', v: 2}, \"q\\x41 r\"]\nf: >\n  a\n  b\n\n   c\ng: |\n x\n  y\n";
    static const char *const piece[] = {"'", "\"", ": ", "- ", "{", "}", "[", "]", ",", "|\n", ">", "&a", "*a", "\n", "\r\n", "\n  ", "\t", "#", "\\", "? ", "%"};
    unsigned long long state = 2385;
    unsigned accepted = 0;
    for (int run = 0; run < 20000; run++) {
        char text[512];
        strcpy(text, start);
        for (unsigned i = draw(&state) % 4 + 1; i > 0; i--) {
            const char *insert = piece[draw(&state) % (sizeof piece / sizeof piece[0])];
            size_t length = strlen(text), at = draw(&state) % length, drop = draw(&state) % 3, tail = at + drop < length ? at + drop : length;
            memmove(text + at + strlen(insert), text + tail, length - tail + 1);
            memcpy(text + at, insert, strlen(insert));
        }
        nh_error error;
        nh_error_clear(&error);
        nh_deck *deck = nh_deck_parse("f.yaml", text, strlen(text), &error);
        cr_assert_eq(deck == NULL, error.code == NH_INPUT);
        cr_assert_eq(deck == NULL, error.what[0] != '\0');
        if (deck)
            check_carets(deck, nh_deck_root(deck), text);
        accepted += deck != NULL;
        nh_deck_free(deck);
    }
    cr_assert_gt(accepted, 1000u);
}
