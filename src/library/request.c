#include "library/request.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/files.h"
#include "evaluate/constant_text.h"
#include "problem/analysis_file.h"
#include "problem/input.h"
#include "problem/places.h"
#include "system/deck.h"
#include "system/sample_grid.h"
#include "system/system.h"

static const char words_of_line[] = ", command line"; /* how the name of a completed file ends */

bool nh_request_number(const char *text, double *value) { return nh_constant_text(text, value); }

bool nh_request_option(nh_request *q, const char *name, const char *text, nh_error *error)
{
    const struct {
        const char *name;
        bool *given;
    } known[] = {{"max_seconds", &q->limited},
                 {"seed", &q->seed_given},
                 {"samples", &q->samples_given},
                 {"tolerance", &q->tolerance_given},
                 {"until", &q->until_given}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) *known[i].given |= !strcmp(name, known[i].name);
    double value;
    char digits[40];
    if (!nh_text_to_number(text, &value) && nh_constant_text(text, &value))
        snprintf(digits, sizeof digits, "%.17g", value), text = digits;
    bool good = nh_options_set(&q->options, name, text, error);
    q->absence |= q->options.absence > 0;
    return good;
}

bool nh_request_velocities(nh_request *q, const char *word, nh_error *error)
{
    static const char *const names[] = {"auto", "quasi", "coordinates"};
    for (int i = 0; i < 3; i++) {
        if (strcmp(word, names[i])) continue;
        q->chart = (nh_chart_choice)i;
        return true;
    }
    nh_fail(error, NH_USAGE, "", "there are no velocities `%s`", word);
    return nh_error_hint_near(error, word, names, sizeof names / sizeof *names,
                              q->line ? "--velocities takes auto, quasi or coordinates"
                                      : "velocities takes auto, quasi or coordinates");
}

bool nh_request_route(nh_request *q, const char *word, nh_error *error)
{
    nh_route route;
    if (nh_analysis_file_route(word, &route, NULL)) {
        q->route = nh_analysis_file_route_word(route);
        return true;
    }
    nh_fail(error, NH_USAGE, "", "there is no route `%s`", word);
    return nh_analysis_file_route(word, &route, error);
}

bool nh_request_grid(nh_request *q, const char *word, nh_error *error)
{
    nh_grid_kind kind;
    q->grid = word;
    return nh_sample_grid_kind(word, &kind, error);
}

bool nh_request_method(nh_request *q, const char *word, nh_error *error)
{
    const nh_method *one, **all;
    if (!nh_method_given(word, &one, error)) return false;
    if (!one) return true;
    all = nh_arena_alloc(q->arena, (q->methods + 1) * sizeof *all);
    if (q->methods) memcpy(all, q->method, q->methods * sizeof *all);
    all[q->methods++] = one;
    q->method = all;
    return true;
}

/* Some names have commas. */
bool nh_request_methods(nh_request *q, const char *list, nh_error *error)
{
    if (nh_method_find(list)) return nh_request_method(q, list, error);
    for (const char *at = list; *(at += strspn(at, " ,;"));) {
        size_t length = nh_text_entry(at, ",;"), end = length;
        while (end && at[end - 1] == ' ') end--;
        if (!nh_request_method(q, nh_arena_strndup(q->arena, at, end), error)) return false;
        at += length;
    }
    return true;
}

void nh_request_typed(nh_request *q, const char *option, const char *name, const char *text)
{
    const char **words = q->system_words ? &q->system_words : &q->typed; /* before the system is known: behind it */
    *words = nh_arena_printf(q->arena, "%s --%s \"%s=%s\"", *words ? *words : "", option, name, text);
}

void nh_request_setting(nh_request *q, nh_setting setting)
{
    nh_setting *all = nh_arena_alloc(q->arena, (q->settings + 1) * sizeof *all);
    if (q->settings) memcpy(all, q->setting, q->settings * sizeof *all);
    all[q->settings++] = setting;
    q->setting = all;
}

bool nh_request_input(nh_request *q, const char *name, const char *text, nh_error *error)
{
    const char *input = nh_input_text(q->arena, name, text, error);
    if (!input) return false;
    nh_request_setting(q, (nh_setting){.name = name, .input = input});
    nh_request_typed(q, "input", name, text);
    return true;
}

/* ---- additions to the system file ---- */

/* A word of YAML in double quotes. */
static void put_quoted(nh_text *out, const char *word)
{
    nh_text_add(out, "\"");
    for (const char *c = word; *c; c++) {
        if (*c == '"' || *c == '\\') nh_text_add(out, "\\");
        nh_text_add_n(out, *c == '\n' ? " " : c, 1);
    }
    nh_text_add(out, "\"");
}

/* What is added to the text next comes from typed[offset ..] behind an option. */
static void note(nh_request *q, const nh_text *out, const char *option, const char *typed, size_t offset)
{
    if (!(q->pieces & (q->pieces - 1))) { /* room for one more: it doubles whenever the count is a power of two */
        nh_request_piece *more = nh_arena_alloc(q->arena, (2 * q->pieces + 1) * sizeof *more);
        if (q->pieces) memcpy(more, q->piece, q->pieces * sizeof *more);
        q->piece = more;
    }
    q->piece[q->pieces++] =
        (nh_request_piece){.begin = out->length + 1, .offset = offset, .option = option, .typed = typed};
}

/* typed[begin .. end) as a word of the text. */
static void put_typed(nh_request *q, nh_text *out, const char *option, const char *typed, size_t begin, size_t end)
{
    while (begin < end && typed[begin] == ' ') begin++;
    while (begin < end && typed[end - 1] == ' ') end--;
    note(q, out, option, typed, begin);
    put_quoted(out, nh_arena_strndup(q->arena, typed + begin, end - begin));
}

/* "left" or "left=0.1". */
static void put_wheel(nh_request *q, nh_text *out, const char *typed)
{
    size_t length = strlen(typed), equal = strcspn(typed, "=");
    note(q, out, "--wheel", typed, 0);
    if (equal < length) nh_text_add(out, "{body: ");
    put_typed(q, out, "--wheel", typed, 0, equal);
    if (equal == length) return;
    nh_text_add(out, ", radius: ");
    put_typed(q, out, "--wheel", typed, equal + 1, length);
    nh_text_add(out, "}");
}

/* The same file with wheels, a base and levels: a text of one line that includes it. */
static const char *completed(nh_request *q, const char *path)
{
    const char *slash = strrchr(path, '/');
    nh_text text;
    nh_text_init(&text);
    nh_text_add(&text, "{include: ");
    put_quoted(&text, slash ? slash + 1 : path);
    for (size_t i = 0; i < q->wheels; i++)
        nh_text_add(&text, i ? ", " : ", wheels: ["), put_wheel(q, &text, q->wheel[i]);
    if (q->wheels) nh_text_add(&text, "]");
    if (q->base) nh_text_add(&text, ", base: "), put_typed(q, &text, "--base", q->base, 0, strlen(q->base));
    for (size_t i = 0; i < q->ons; i++)
        nh_text_add(&text, i ? ", " : ", levels: ["), put_typed(q, &text, "--on", q->on[i], 0, strlen(q->on[i]));
    nh_text_add(&text, q->ons ? "]}\n" : "}\n");
    const char *name = nh_arena_printf(q->arena, "%s%s", path, words_of_line);
    nh_files_add(name, nh_text_string(&text), text.length);
    q->completed = nh_arena_strdup(q->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return name;
}

static const char *system_words(const nh_request *q, const char *word)
{
    const char *text = nh_arena_strdup(q->arena, word);
    for (size_t i = 0; i < q->wheels; i++) text = nh_arena_printf(q->arena, "%s --wheel \"%s\"", text, q->wheel[i]);
    if (q->base) text = nh_arena_printf(q->arena, "%s --base \"%s\"", text, q->base);
    for (size_t i = 0; i < q->ons; i++) text = nh_arena_printf(q->arena, "%s --on \"%s\"", text, q->on[i]);
    return q->typed ? nh_arena_printf(q->arena, "%s%s", text, q->typed) : text;
}

bool nh_request_system(nh_request *q, const char *word, nh_error *error)
{
    q->system_name = word;
    q->system_words = system_words(q, word);
    q->system_path = nh_places_find(q->arena, "systems", word, error);
    if (q->system_path && (q->wheels || q->base || q->ons)) q->system_path = completed(q, q->system_path);
    return q->system_path != NULL;
}

void nh_request_remarks(const nh_request *q, const char *head, nh_text *out)
{
    nh_error ignored; /* the reader of the file says what is wrong */
    nh_error_clear(&ignored);
    nh_system *system = nh_system_read(q->system_path, q->settings, q->setting, &ignored);
    for (size_t i = 0; system && i < system->notes; i++) nh_text_addf(out, "%s%s\n", head, system->note[i]);
    nh_system_free(system);
}

void nh_request_blame(const nh_request *q, nh_error *error)
{
    const char *place = q->completed && error->code != NH_OK ? strstr(error->where, words_of_line) : NULL;
    size_t line = 0, column = 0, at = 0;
    if (!place || sscanf(place + strlen(words_of_line), ":%zu:%zu", &line, &column) != 2 || line != 1) return;
    /* columns count characters */
    for (size_t seen = 0; q->completed[at] && (seen += ((unsigned char)q->completed[at] & 0xC0) != 0x80) < column;)
        at++;
    const nh_request_piece *piece = NULL;
    /* + 1: its quote counts, too */
    for (size_t i = 0; i < q->pieces && q->piece[i].begin <= at + 1; i++) piece = &q->piece[i];
    if (!piece) return;
    nh_error own;
    nh_error_clear(&own);
    nh_deck_fail_typed(piece->option, piece->typed, piece->offset + (at > piece->begin ? at - piece->begin : 0), &own,
                       "%s", error->what);
    if (error->hint[0]) nh_error_hint(&own, "%s", error->hint);
    *error = own;
}

/* ---- the analysis ---- */

bool nh_request_analysis(nh_request *q, const char *word, nh_error *error)
{
    return (q->analysis_path = nh_places_find(q->arena, "analyses", word, error)) != NULL;
}

void nh_request_usual_analysis(nh_request *q, const char *system)
{
    if (!q->ons && !nh_places_is_path(system)) q->analysis_path = nh_places_look(q->arena, "analyses", system);
}

const char *nh_request_subject(const nh_request *q, nh_error *error)
{
    nh_analysis_file *file = nh_analysis_file_read(q->analysis_path, error);
    const char *name = file && file->system ? nh_arena_strdup(q->arena, file->system) : NULL;
    nh_analysis_file_free(file);
    return name;
}
