#include "library/catalogue.h"

#include <ctype.h>
#include <string.h>

#include "base/files.h"
#include "commands/export.h"
#include "document/wording.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/parse.h"
#include "motion/method.h"
#include "problem/places.h"
#include "reduction/linear_questions.h"
#include "system/deck.h"
#include "system/deck_build.h"
#include "system/system.h"

/* ---- systems ---- */

bool nh_catalogue_has(const char *name)
{
    nh_arena *arena = nh_arena_create();
    bool found = nh_places_look(arena, "systems", name) != NULL;
    nh_arena_free(arena);
    return found;
}

/* As the system file that it stands for. */
static bool show_whole(const char *path, nh_text *out, nh_error *error)
{
    nh_deck *deck = nh_system_deck(path, error);
    if (!deck) return false;
    nh_deck_print(nh_deck_root(deck), out);
    nh_deck_free(deck);
    return true;
}

bool nh_catalogue_show(const char *path, bool whole, nh_text *out, nh_error *error)
{
    size_t length;
    if (whole) return show_whole(path, out, error);
    char *text = nh_files_read(path, NH_DECK_SIZE_LIMIT, &length, error);
    if (!text) return false;
    bool robot = text[strspn(text, " \t\r\n")] == '<';
    if (length > NH_DECK_SIZE_LIMIT)
        nh_fail(error, NH_INPUT, path, "the file is larger than %d MiB", NH_DECK_SIZE_LIMIT >> 20);
    else if (!robot) nh_text_add_n(out, text, length);
    nh_free(text);
    return error->code == NH_OK && (!robot || show_whole(path, out, error));
}

bool nh_catalogue_names(const char *path, const char *of, nh_text *out, nh_error *error)
{
    static const char *const words[] = {"parameters", "coordinates", "velocities"}, line[] = "%s\n";
    bool wanted[3] = {false};
    for (const char *at = of; *at; at += at[strcspn(at, ",")] != 0) {
        at += strspn(at, " ");
        size_t length = strcspn(at, ", "), k = 0;
        while (k < 3 && (strlen(words[k]) != length || strncmp(words[k], at, length))) k++;
        if (k < 3) wanted[k] = true;
        else
            nh_fail(error, NH_USAGE, "", "--of does not know `%.*s`", (int)length, at),
                nh_error_hint(error, "`nhsym show` takes parameters, coordinates and velocities");
        at += strcspn(at, ",");
    }
    nh_system *system = error->code == NH_OK ? nh_system_read(path, 0, NULL, error) : NULL;
    if (!system) return false;
    for (size_t i = 0; wanted[0] && i < system->parameters; i++) nh_text_addf(out, line, system->parameter[i].name);
    for (size_t i = 0; wanted[1] && i < system->coordinates; i++) nh_text_addf(out, line, system->coordinate[i].name);
    for (size_t i = 0; wanted[2] && i < system->coordinates; i++)
        nh_text_addf(out, line, nh_name_of(system->dag, system->coordinate[i].v));
    for (size_t i = 0; wanted[2] && i < system->quasi; i++)
        nh_text_addf(out, line, nh_name_of(system->dag, system->quasi_velocity[i]));
    nh_system_free(system);
    return true;
}

/* The text of a new system file; %s: the name, twice. */
static const char pattern[] =
    "# A system for nhsym.  `nhsym analyze %s.yaml` analyses it; change it line by line.\n"
    "name: %s\n"
    "title: A skate on a slope\n"
    "# source: the publication that describes the system\n"
    "\n"
    "parameters:                  # fixed numbers; --set m=3 overrides one\n"
    "  - {name: m, value: 2, unit: kg, doc: mass}\n"
    "  - {name: J, value: 0.5, unit: kg m^2, doc: moment of inertia}\n"
    "  - {name: b, value: 3, unit: m/s^2, doc: acceleration down the slope}\n"
    "\n"
    "coordinates:                 # type: angle, length, number or orientation\n"
    "  - {name: phi, type: angle, doc: heading}\n"
    "  - {name: x, type: length, unit: m, doc: down the slope}\n"
    "  - {name: y, type: length, unit: m, doc: across it}\n"
    "\n"
    "# definitions:               # names for expressions, in order; X' is the time derivative of X\n"
    "#   - X = x + 0.3*cos(phi)\n"
    "\n"
    "# Kinetic minus potential energy.  x' is the velocity of x; t, sin, cos, sqrt, exp, log, ... can be used.\n"
    "lagrangian: m/2*(x'^2 + y'^2) + J/2*phi'^2 + m*b*x\n"
    "\n"
    "constraints:                 # equations between velocities or positions; omit the list if there are none\n"
    "  - y'*cos(phi) = x'*sin(phi)\n"
    "\n"
    "# velocities:                # of your own choice, where the coordinate velocities break down\n"
    "#   names: [omega, v]\n"
    "#   map: [phi' = omega, x' = v*cos(phi), y' = v*sin(phi)]\n"
    "\n"
    "# forces:                    # generalized forces without a potential\n"
    "#   - phi = -0.01*phi'\n";

bool nh_catalogue_pattern(const char *name, nh_text *out)
{
    if (!nh_is_name(name)) return false;
    nh_text_addf(out, pattern, name, name);
    return true;
}

bool nh_catalogue_copy(const char *like, const char *name, nh_text *out, nh_error *error)
{
    nh_arena *arena = nh_arena_create();
    const char *path = nh_places_find(arena, "systems", like, error);
    nh_text text;
    nh_text_init(&text);
    bool good = path && nh_catalogue_show(path, false, &text, error);
    if (good && (strstr(nh_text_string(&text), "\ninclude:") || strstr(nh_text_string(&text), "\nurdf:"))) {
        nh_text_clear(&text); /* the other file is not found from here */
        good = nh_catalogue_show(path, true, &text, error);
    }
    const char *whole = nh_text_string(&text), *at = !strncmp(whole, "name:", 5) ? whole : strstr(whole, "\nname:");
    size_t before = at ? (size_t)(at - whole) + (*at == '\n') : 0;
    if (good) nh_text_addf(out, "# After the system %s.  `nhsym analyze %s.yaml` analyses it.\n", like, name);
    if (good) nh_text_add_n(out, whole, before);
    if (good) nh_text_addf(out, "name: %s\n", name);
    if (good) nh_text_add(out, at ? whole + before + strcspn(whole + before, "\n") + 1 : whole);
    nh_text_clear(&text);
    nh_arena_free(arena);
    return good;
}

/* ---- words ---- */

static void explain_options(nh_text *out)
{
    for (size_t i = 0; i < nh_option_count(); i++) {
        nh_option_row o = nh_option_at(i);
        nh_text_addf(out, "%-20s %-9g %-10s %s\n", o.name, o.value, o.unit, o.doc);
    }
}

static void explain_methods(nh_text *out)
{
    nh_text_addf(out, "%-16s %s\n", NH_METHOD_AUTOMATIC, "rk8pd, or bdf where the equations are stiff");
    for (size_t i = 0; i < nh_method_count(); i++)
        nh_text_addf(out, "%-16s %s\n", nh_method_at(i)->word, nh_method_at(i)->about);
}

static void explain_functions(nh_text *out)
{
    nh_text_add(out, NH_ELEMENTARY_WORDS
                "atan2(y, x) sqrt abs, and functions without elementary form.\n"
                "Of these the last argument may move, the others are numbers or parameters; f_prime is the derivative, "
                "as in bessel_j_prime(n, x).\n\n");
    for (size_t i = 0; i < nh_glossary_functions(); i++) {
        nh_glossary_entry f = nh_glossary_function_at(i);
        nh_text_addf(out, "%-24s %s\n", f.word, f.text);
    }
    nh_text_add(out, "\nAll arguments of elliptic integrals may move.  Values are computed by Arb, right to "
                     "the last digits of a double; where a function\n"
                     "is not real, it has none.  Proofs use its differential equation, neighbouring orders and "
                     "Wronski's determinant.\n");
}

/* Topics that are lists. */
static const struct {
    const char *word, *about;
    void (*put)(nh_text *out);
} lists[] = {
    {"options", "all numerical options (nhsym explain options)", explain_options},
    {"methods", "all integrators (nhsym explain methods)", explain_methods},
    {"functions", "functions of formulas (nhsym explain functions)", explain_functions},
};
enum { list_count = sizeof lists / sizeof *lists };

/* "stage" finds the stages of a reduction and of a search, "constraint" the constraint submanifold.  Does any topic
   begin like this? */
static bool explain_beginning(const char *word, nh_text *out)
{
    bool found = false;
    size_t length = strlen(word);
    for (size_t i = 0; i < nh_glossary_count(); i++) {
        nh_glossary_entry topic = nh_glossary_at(i);
        if (strncmp(topic.word, word, length) || topic.word[length] != ' ') continue;
        nh_text_addf(out, "%s: %s\n", topic.word, topic.text);
        found = true;
    }
    return found;
}

/* Does `text` contain the word or words, in capitals or not, between other characters? */
static bool has_words(const char *text, const char *words)
{
    size_t length = strlen(words);
    for (const char *at = text; (at = strcasestr(at, words)); at++)
        if ((at == text || !isalpha((unsigned char)at[-1])) && !isalpha((unsigned char)at[length])) return true;
    return false;
}

/* "growth vector", "case 1": the topics that say these words, or where none does, those that have one of them. */
static bool explain_mentioning(const char *words, nh_text *out)
{
    bool found = false;
    for (size_t i = 0; i < nh_glossary_count(); i++) {
        nh_glossary_entry topic = nh_glossary_at(i);
        if (!has_words(topic.text, words)) continue;
        nh_text_addf(out, "%s: %s\n", topic.word, topic.text);
        found = true;
    }
    for (size_t i = 0; i < nh_glossary_count() && !found && strchr(words, ' '); i++)
        if (has_words(words, nh_glossary_at(i).word))
            nh_text_addf(out, "%s: %s\n", nh_glossary_at(i).word, nh_glossary_at(i).text);
    return *nh_text_string(out) != 0;
}

static bool explain_all(nh_text *out)
{
    static const char row[] = "%-22s %s\n";
    for (size_t i = 0; i < nh_glossary_count(); i++)
        nh_text_addf(out, row, nh_glossary_at(i).word, nh_glossary_at(i).text);
    for (size_t i = 0; i < list_count; i++) nh_text_addf(out, row, lists[i].word, lists[i].about);
    return true;
}

bool nh_catalogue_explain(nh_arena *arena, size_t words, const char *const *given, nh_text *out, nh_error *error)
{
    size_t count = nh_glossary_count();
    const char **names = nh_arena_alloc(arena, (count + list_count) * sizeof *names);
    if (!words) return explain_all(out);
    const char *word = given[0];
    for (size_t i = 1; i < words; i++) word = nh_arena_printf(arena, "%s %s", word, given[i]);
    for (size_t i = 0; i < count; i++) {
        names[i] = nh_glossary_at(i).word;
        if (!strcmp(word, names[i])) return nh_text_addf(out, "%s\n", nh_glossary_at(i).text), true;
    }
    for (size_t i = 0; i < list_count; i++) {
        names[count + i] = lists[i].word;
        if (!strcmp(word, lists[i].word)) return lists[i].put(out), true;
    }
    if (explain_beginning(word, out) || (strlen(word) > 2 && explain_mentioning(word, out))) return true;
    nh_fail(error, NH_USAGE, "", "there is no topic `%s`", word);
    const char *near = nh_text_nearest(word, names, count + list_count);
    /* "canonical distribution" */
    for (size_t i = words; i-- && !near;) near = nh_text_nearest(given[i], names, count + list_count);
    return near ? nh_error_hint(error, "did you mean `%s`?", near)
                : nh_error_hint(error, "`nhsym explain` lists the topics");
}

/* The words that --of accepts in a command. */
static void values_of(const char *command, const char *between, nh_text *out)
{
    static const char *const fixed[][4] = {{"verify", "constraint", "equations"},
                                           {"scan", "count", "analyze", "reduce"},
                                           {"show", "parameters", "coordinates", "velocities"}};
    const char *first = "";
    for (size_t i = 0; i < sizeof fixed / sizeof *fixed; i++)
        for (size_t k = 1; !strcmp(command, fixed[i][0]) && k < 4 && fixed[i][k]; k++, first = between)
            nh_text_addf(out, "%s%s", first, fixed[i][k]);
#define X(name, word) nh_text_addf(out, "%s" #word, first), first = between;
    if (!strcmp(command, "classify")) {
        NH_LINEAR_QUESTION_TABLE(X)
        nh_text_addf(out, "%sabsence", between);
    }
#undef X
    if (strcmp(command, "export")) return;
    for (unsigned part = 1; part <= NH_EXPORT_ALL; part <<= 1, first = between)
        nh_text_addf(out, "%s%s", first, nh_export_part_name((nh_export_part)part));
}

void nh_catalogue_values(const char *name, const char *command, const char *between, nh_text *out)
{
    if (!strcmp(name, "method")) {
        nh_text_add(out, NH_METHOD_AUTOMATIC);
        for (size_t i = 0; i < nh_method_count(); i++) nh_text_addf(out, "%s%s", between, nh_method_at(i)->word);
    } else if (!strcmp(name, "option")) {
        for (size_t i = 0; i < nh_option_count(); i++)
            nh_text_addf(out, "%s%s=", i ? between : "", nh_option_at(i).name);
    } else if (!strcmp(name, "of")) {
        values_of(command, between, out);
    } else if (!strcmp(name, "explain")) {
        nh_text_addf(out, "options%smethods", between);
        for (size_t i = 0; i < nh_glossary_count(); i++)
            if (!strchr(nh_glossary_at(i).word, ' ')) nh_text_addf(out, "%s%s", between, nh_glossary_at(i).word);
    }
}
