/* urdf_names: names of links and joints as names of the language, different ones for different ones.  See urdf.h. */
#include <stdio.h>
#include <string.h>

#include "base/escape.h"
#include "base/text.h"
#include "graph/parse.h"
#include "system/urdf_internal.h"

static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
static bool is_digit(char c) { return c >= '0' && c <= '9'; }

/* Letters that are not Latin: Greek ones by their names, others by their numbers, which end before the next letter. */
static size_t put_letter(nh_text *out, const char *at)
{
    size_t length;
    uint32_t code = 0;
    const char *word = nh_name_of_letter(at, &length);
    if (word) return nh_text_add(out, word), length;
    length = nh_utf8_decode(at, strlen(at), &code);
    if (!length) return nh_text_add(out, "_"), 1;
    nh_name_add_code(out, code);
    if (at[length] && strchr("0123456789ABCDEF", at[length])) nh_text_add(out, "_");
    return length;
}

char *nh_urdf_name(nh_arena *arena, const char *name)
{
    nh_text out;
    nh_text_init(&out);
    if (!is_letter(*name) && (unsigned char)*name < 128) nh_text_add(&out, "link_");
    for (const char *c = name; *c;) {
        if ((unsigned char)*c >= 128) c += put_letter(&out, c);
        else nh_text_add_n(&out, is_letter(*c) || is_digit(*c) ? c : "_", 1), c++;
    }
    if (!strcmp(name, "ground")) nh_text_add(&out, "_link"); /* `ground` is the fixed frame */
    char *own = nh_arena_strdup(arena, nh_text_string(&out));
    nh_text_clear(&out);
    return own;
}

static bool taken(char *const *own, size_t count, const char *name)
{
    for (size_t i = 0; i < count; i++)
        if (own[i] && !strcmp(own[i], name)) return true;
    return false;
}

void nh_urdf_names(nh_arena *arena, size_t count, const char *const *written, char **own)
{
    for (size_t i = 0; i < count; i++) { /* names that stay come first */
        char *name = nh_urdf_name(arena, written[i]);
        own[i] = strcmp(name, written[i]) ? NULL : name;
    }
    for (size_t i = 0; i < count; i++) {
        if (own[i]) continue;
        char *plain = nh_urdf_name(arena, written[i]), *name = plain;
        size_t k = i;
        while (k-- > 0 && strcmp(written[k], written[i])) {
        } /* the same name twice is a fault that is found later */
        for (int n = 2; k == SIZE_MAX && taken(own, count, name); n++) name = nh_arena_printf(arena, "%s_%d", plain, n);
        own[i] = k == SIZE_MAX ? name : own[k];
    }
}

bool nh_urdf_is_part(const char *word, const char *name)
{
    size_t n = strlen(name);
    return !strncmp(word, name, n) && word[n] == '_' && word[n + 1] && !word[n + 2];
}
