/* deck_internal: the source text of a deck and the places in it.  Private to deck*.c. */
#ifndef NH_DECK_INTERNAL_H
#define NH_DECK_INTERNAL_H

#include "system/deck.h"
#include "base/memory.h"

struct nh_deck {
    nh_arena *arena; /* the nodes and their texts */
    char *name, *source;
    size_t length;
    const nh_deck_node *root;
    struct nh_deck *included; /* owned */
    size_t *before;           /* before[i]: code points before byte i * NH_DECK_BLOCK */
    size_t *line;             /* byte at which a line begins */
    size_t lines, line_capacity;
    bool hidden;  /* its text is in no message */
    nh_code code; /* code of its errors; NH_OK: that of a file, with line and column */
};

enum { NH_DECK_BLOCK = 64, NH_DECK_SHOWN = 192 };

/* A deck without a tree that owns a copy of `text` (without byte order mark), indexed. */
nh_deck *nh_deck_create(const char *name, const char *text, size_t length);

/* Refuses what is not text: bytes that are not UTF-8, and invisible characters.  (libyaml refuses them too, but without
 * line and column.) */
bool nh_deck_check_text(nh_deck *deck, nh_error *error);

/* libyaml counts code points, we count bytes. */
size_t nh_deck_byte_of(const nh_deck *deck, size_t code_point);
void nh_deck_place(const nh_deck *deck, size_t byte, size_t *line, size_t *column);

/* The byte of the source from which the byte `offset` of a scalar's text comes. */
size_t nh_deck_origin(const nh_deck *deck, const nh_deck_node *node, size_t offset);

bool nh_deck_is_break(char c);
bool nh_deck_is_space(char c); /* blank or line break */

/* nh_deck_fail for a byte of the source. */
bool nh_deck_fail_at(const nh_deck *deck, size_t byte, nh_error *error, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* The same for a file that another one includes, and of which nothing may be shown. */
bool nh_deck_fail_hidden(const char *name, nh_error *error);

/* A text as it is quoted in a message: one line, not too long. */
void nh_deck_shorten(const char *text, char out[NH_DECK_SHOWN]);

/* Errors of libyaml as messages for users.  Private to deck_read.c. */

#define NH_DECK_QUOTE_HINT "put the expression in double quotes"

/* `problem` and `context` are libyaml's words (context may be NULL), `at` and `since` the bytes where they stand. */
bool nh_deck_explain(const nh_deck *deck, const char *problem, size_t at, const char *context, size_t since,
                     nh_error *error);

#endif
