/* deck: YAML text as a tree with the position of every word.
 *
 * libyaml parses; this module keeps file, line and column of each node, so that readers can point at what they do
 * not understand, and knows the source text, so that a message shows the line with a caret. Aliases, anchors, tags
 * and several documents are refused; depth and size are bounded. */
#ifndef NH_DECK_H
#define NH_DECK_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"
#include "base/memory.h"

typedef enum { NH_DECK_SCALAR, NH_DECK_LIST, NH_DECK_MAP } nh_deck_kind;

typedef struct nh_deck_node nh_deck_node;
struct nh_deck_node {
    nh_deck_kind kind;
    const char *text;           /* of a scalar */
    bool plain;                 /* a scalar without quotes, so that null, true and 12 are not texts */
    size_t count;               /* items of a list, entries of a map */
    const nh_deck_node **item;  /* items, or values of a map */
    const nh_deck_node **key;   /* keys of a map (scalars, distinct) */
    size_t begin, end;          /* byte range in the source */
    size_t line, column;        /* of the first character, from 1; a column counts code points */
    const struct nh_deck *deck; /* the deck that it belongs to: a file may include another one */
};

typedef struct nh_deck nh_deck;

enum { NH_DECK_SIZE_LIMIT = 4 << 20 }; /* bytes of a file */

/* Read a file, or a text that is called `name` in messages.  NULL on failure. */
nh_deck *nh_deck_read(const char *path, nh_error *error);
nh_deck *nh_deck_parse(const char *name, const char *text, size_t length, nh_error *error);
void nh_deck_free(nh_deck *deck);

/* Merge in the file that the root's key `include` names, relative to the folder of this one, and those that it
 * includes: the root is then a map without that key.  Maps are united and lists appended to those of the included file;
 * on conflicts, also of list entries {name: ...} of one name, this file takes precedence.  Messages about a node name
 * the file in which it stands.  Before a file is merged, `prepare` (or NULL) may rename its old keys. */
typedef bool nh_deck_prepare(nh_deck *deck, nh_error *error);
bool nh_deck_include(nh_deck *deck, nh_deck_prepare *prepare, nh_error *error);
/* In a map (anything else stays as it is), the key `old` is read as `key`, which is its name now.  Both at once are
   refused. */
bool nh_deck_rename(nh_deck *deck, const nh_deck_node *map, const char *old, const char *key, nh_error *error);
/* A map {x: 1, y: {unit: m}}, or a list [x: 1, y: {unit: m}], as the list [{name: x, KEY: 1}, {name: y, unit: m}] that
 * it abbreviates (KEY: short_for); a scalar, and other items of a list, are not changed. */
const nh_deck_node *nh_deck_named(nh_deck *deck, const char *short_for, const nh_deck_node *node);
/* A name, possibly with a prime, in ASCII where it has Greek letters (nh_name_spelled); any other text is returned
   itself. */
const char *nh_deck_spelled(nh_arena *arena, const char *text);
/* The same for every name of an expression. */
const char *nh_deck_spelled_all(nh_arena *arena, const char *text);
/* A Greek letter of LaTeX, such as \theta, that a scalar between double quotes lost to an escape; NULL: none. */
const char *nh_deck_escaped_letter(const nh_deck *deck, const nh_deck_node *node);
const nh_deck_node *nh_deck_root(const nh_deck *deck);
const char *nh_deck_name(const nh_deck *deck);
/* The path of the file that a scalar names, from the folder of the file in which it stands. */
const char *nh_deck_beside(nh_deck *deck, const nh_deck_node *node);

/* The value of `key` in a map, or NULL. */
const nh_deck_node *nh_deck_get(const nh_deck_node *map, const char *key);

/* Record an error at a node: where, excerpt with caret.  `offset` counts bytes into the scalar's text (0 otherwise);
 * the caret finds the right column through quotes, escapes and folded lines.  Returns false. */
bool nh_deck_fail(const nh_deck *deck, const nh_deck_node *node, size_t offset, nh_error *error, const char *format,
                  ...) __attribute__((format(printf, 5, 6)));

/* Records an error in the text of an option, at a byte of it: the place is OPTION:COLUMN, the code is that of the
 * command line.  Returns false. */
bool nh_deck_fail_typed(const char *option, const char *typed, size_t at, nh_error *error, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

/* Refuse keys of a map that are not among `known`, suggesting the nearest. */
bool nh_deck_only(const nh_deck *deck, const nh_deck_node *map, const char *const *known, size_t count,
                  nh_error *error);

/* Typed access with messages: "expected a number, found a list".  `what` names the thing in the message. */
bool nh_deck_is(const nh_deck *deck, const nh_deck_node *node, nh_deck_kind kind, const char *what, nh_error *error);
bool nh_deck_number(const nh_deck *deck, const nh_deck_node *node, const char *what, double *out, nh_error *error);
bool nh_deck_whole(const nh_deck *deck, const nh_deck_node *node, const char *what, long min, long max, long *out,
                   nh_error *error);
/* A list of two numbers low < high. */
bool nh_deck_range(const nh_deck *deck, const nh_deck_node *node, const char *what, double out[2], nh_error *error);

#endif
