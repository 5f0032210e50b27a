/* urdf_notes: what was left out of a robot description, or replaced, in few lines.  See urdf_internal.h. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "system/urdf_internal.h"

enum { most_items = 8, item_size = 200 };

typedef struct item item;
struct item {
    const char *text;
    size_t count;
    item *next;
};

struct nh_urdf_notes {
    const char *kind;
    size_t at; /* of the first item */
    item *first;
    nh_urdf_notes *next;
};

/* The list's end: kind `kind`, which is made where it is new. */
static nh_urdf_notes *kind_of(nh_urdf_reader *u, size_t at, const char *kind)
{
    nh_urdf_notes **k = &u->notes;
    while (*k && strcmp((*k)->kind, kind)) k = &(*k)->next;
    if (!*k) {
        *k = nh_arena_alloc(u->deck->arena, sizeof **k);
        **k = (nh_urdf_notes){.kind = kind, .at = at};
    }
    return *k;
}

void nh_urdf_note(nh_urdf_reader *u, size_t at, const char *kind, const char *format, ...)
{
    char text[item_size];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    item **i = &kind_of(u, at, kind)->first;
    while (*i && strcmp((*i)->text, text)) i = &(*i)->next;
    if (!*i) {
        *i = nh_arena_alloc(u->deck->arena, sizeof **i);
        **i = (item){.text = nh_arena_strdup(u->deck->arena, text)};
    }
    (*i)->count++;
}

nh_deck_node *nh_urdf_notes_list(nh_urdf_reader *u)
{
    nh_deck_node *list = nh_deck_new(u->deck, NH_DECK_LIST, 0, 0);
    for (const nh_urdf_notes *k = u->notes; k; k = k->next) {
        size_t line, column, shown = 0, more = 0;
        nh_text text;
        nh_text_init(&text);
        nh_deck_place(u->deck, k->at, &line, &column);
        nh_text_addf(&text, "%s:%zu: %s: ", u->deck->name, line, k->kind);
        for (const item *i = k->first; i; i = i->next) {
            if (shown == most_items) more++;
            if (shown == most_items) continue;
            nh_text_addf(&text, "%s%s", shown++ ? ", " : "", i->text);
            if (i->count > 1) nh_text_addf(&text, " (%zu)", i->count);
        }
        if (more) nh_text_addf(&text, " and %zu more", more);
        nh_deck_append(u->deck, list, nh_deck_word(u->deck, nh_text_string(&text), k->at, k->at));
        nh_text_clear(&text);
    }
    return list;
}
