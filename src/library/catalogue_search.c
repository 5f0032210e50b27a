/* catalogue_search: the systems, all or those with a word. */
#include <ctype.h>
#include <string.h>

#include "base/files.h"
#include "geometry/model.h"
#include "geometry/distribution.h"
#include "library/catalogue.h"
#include "problem/places.h"
#include "system/deck.h"
#include "system/system.h"

/* Does a word of the text begin with `word`, in capitals or not? `_` and other characters are between words. */
static bool has(const char *text, const char *word)
{
    for (const char *at = text; *word && (at = strcasestr(at, word)); at++)
        if (at == text || !isalnum((unsigned char)at[-1])) return true;
    return false;
}

/* The words of constraints_of, which takes long. */
static const char kinds[] = "no constraints, linear, affine, nonlinear, holonomic, integrable, partly, nonholonomic";

/* "linear, nonholonomic" */
static const char *constraints_of(nh_system *system, nh_arena *arena)
{
    nh_error trouble;
    nh_error_clear(&trouble);
    nh_chart *chart = nh_chart_create(system, NH_CHART_AUTO, 1, &trouble);
    nh_model *model = chart ? nh_model_create(system, chart, &trouble) : NULL;
    if (!model) return "";
    nh_distribution d = nh_distribution_of(model);
    const char *words =
        nh_arena_printf(arena, "%s, %s", nh_constraint_type_name(d.type), nh_constraint_integrability(model, &d));
    if (d.type == NH_UNCONSTRAINED) words = "no constraints";
    nh_model_free(model);
    return words;
}

/* The remarks at the head of a file: its lines that begin with #. */
static const char *remarks_of(const char *path, nh_arena *arena)
{
    nh_error trouble;
    size_t length;
    nh_error_clear(&trouble);
    char *text = nh_files_read(path, NH_DECK_SIZE_LIMIT, &length, &trouble);
    size_t n = 0;
    while (text && text[n] == '#') n += strcspn(text + n, "\n") + (text[n + strcspn(text + n, "\n")] != 0);
    const char *remarks = text ? nh_arena_strndup(arena, text, n) : "";
    nh_free(text);
    return remarks;
}

/* Writes the line of a system in which the word occurs; NULL: of any. */
static bool put_line(const char *name, const char *path, const char *word, nh_arena *arena, nh_text *out)
{
    nh_error trouble;
    nh_error_clear(&trouble);
    nh_system *system = nh_system_read(path, 0, NULL, &trouble);
    const char *title = system ? system->title : trouble.what, *where = "", *text = "";
    bool found = !word || has(name, word) || has(title, word);
    if (!found && system && has(system->source, word)) where = "source", text = system->source, found = true;
    if (!found && has(remarks_of(path, arena), word)) where = "remarks", found = true;
    if (!found && system && has(kinds, word) && has(text = constraints_of(system, arena), word))
        where = "constraints", found = true;
    if (found) nh_text_addf(out, "%-24s %s", name, title);
    if (found && *where) nh_text_addf(out, " (%s%s%s)", where, *text ? ": " : "", text);
    if (found) nh_text_add(out, "\n");
    nh_system_free(system);
    return found;
}

/* The word is nearest to one of a name or title. */
static void hint_near(nh_arena *arena, size_t count, const char **names, const char *word, nh_error *error)
{
    const char **words = nh_arena_alloc(arena, (8 * count + 1) * sizeof *words);
    size_t n = 0;
    for (size_t i = 0; i < count; i++) {
        char *copy = nh_arena_strdup(arena, names[i]), *rest = copy;
        for (char *part; (part = strsep(&rest, "_")) && n < 8 * count;)
            if (strlen(part) > 2) words[n++] = part;
    }
    const char *near = nh_text_nearest(word, words, n);
    if (near) nh_error_hint(error, "did you mean `nhsym list %s`?", near);
    else nh_error_hint(error, "`nhsym list` shows all of them");
}

bool nh_catalogue_systems(const char *word, nh_text *out, nh_error *error)
{
    nh_arena *arena = nh_arena_create();
    const char **names;
    size_t count = nh_places_names(arena, "systems", &names);
    bool some = false;
    for (size_t i = 0; i < count; i++) {
        const char *path = nh_places_look(arena, "systems", names[i]);
        if (path) some |= put_line(names[i], path, word, arena, out);
    }
    if (!count) {
        nh_fail(error, NH_INPUT, "", "there are no systems in ./systems, in NHSYM_PATH or installed");
        nh_error_hint(error, "run nhsym where a folder `systems` is, or set NHSYM_PATH");
    } else if (!some) {
        nh_fail(error, NH_USAGE, "", "no system has `%s` in its name, title, source, remarks or kind of constraints",
                word);
        hint_near(arena, count, names, word, error);
    }
    nh_arena_free(arena);
    return some;
}

void nh_catalogue_similar(const char *word, nh_text *out)
{
    nh_arena *arena = nh_arena_create();
    const char **names;
    size_t count = nh_places_names(arena, "systems", &names);
    for (size_t i = 0; i < count; i++) {
        const char *path = nh_places_look(arena, "systems", names[i]);
        nh_error trouble;
        nh_error_clear(&trouble);
        nh_system *system = path ? nh_system_read(path, 0, NULL, &trouble) : NULL;
        if (system && (has(names[i], word) || has(system->title, word)))
            nh_text_addf(out, "%s%s", out->length ? ", " : "", names[i]);
        nh_system_free(system);
    }
    nh_arena_free(arena);
}
