/* verify_names: the names that --current and --field know beside those of the system: E, Lbar, the currents; Gamma and
 * Z(..) of a current, in a field that is a sum of functions times these. */
#include "commands/verify_internal.h"

#include <ctype.h>
#include <string.h>

#include "base/progress.h"
#include "commands/analyze.h"
#include "exact/normal.h"
#include "graph/node.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/print.h"
#include "problem/places.h"

enum { most_fields = 26 };

typedef struct {
    nh_verification *v;
    const char *option;
    size_t count, room;
    nh_named *name;
    nh_analysis *own; /* what `analyze` finds, where a name asks for it; else NULL */
} names;

static void add(names *x, const char *name, nh_ex value)
{
    if (x->count == x->room) {
        nh_named *more = nh_arena_alloc(x->v->arena, (x->room = 2 * x->room + 8) * sizeof *more);
        if (x->count) memcpy(more, x->name, x->count * sizeof *more);
        x->name = more;
    }
    x->name[x->count++] = (nh_named){.name = name, .value = value};
}

/* Has it a meaning without these names? */
static bool is_of_system(const names *x, const char *word)
{
    nh_error ignored;
    nh_ex any;
    nh_error_clear(&ignored);
    return nh_system_expression_text(x->v->system, x->option, word, x->count, x->name, &any, &ignored);
}

/* Phi_3 is Phi3. */
static bool same_name(const char *a, const char *b)
{
    do {
        while (*a == '_') a++;
        while (*b == '_') b++;
        if (*a != *b) return false;
    } while (*a++ && *b++);
    return true;
}

/* ---- the currents ---- */

/* As a person writes it: in velocities, where the chart has roots. */
static nh_ex in_velocities(const nh_model *model, nh_ex e)
{
    return nh_chart_in_velocities(model->chart, nh_chart_shown(model->chart, e));
}

/* A current as `analyze` writes it, of the same system, with the analysis that it would use. */
static bool found_by_analysis(names *x, const char *word, nh_ex *out, nh_error *error)
{
    nh_verification *v = x->v;
    if (!v->request) return nh_fail(error, NH_USAGE, x->option, "the system file knows no current `%s`", word);
    if (!x->own) {
        nh_request q = *v->request;
        const char *name = q.system_name;
        q.command = "analyze";
        if (name && !q.ons && !nh_places_is_path(name)) q.analysis_path = nh_places_look(q.arena, "analyses", name);
        if (!(x->own = nh_analysis_create(&q, error))) return false;
        if (nh_interrupted()) return nh_fail_ended(error, "while `analyze` looked for %s", word);
    }
    const nh_current_list *list = x->own->list;
    const nh_current *c = NULL;
    for (size_t i = 0; i < list->count && !c; i++)
        if (same_name(list->found[i].name, word)) c = &list->found[i];
    if (!c || c->series) {
        nh_fail(error, NH_USAGE, x->option, c ? "`%s` has no closed form" : "`analyze` finds no current `%s`", word);
        return nh_error_hint(error, "it finds %zu; or write the formula", list->count);
    }
    const nh_model *model = x->own->question->model;
    char *text = nh_print_string(model->dag, in_velocities(model, c->phi));
    bool good = nh_system_expression_text(v->system, x->option, text, 0, NULL, out, error);
    nh_free(text);
    return good;
}

/* The meaning of a word of the text; false without a message: it has none here. */
static bool meaning(names *x, const char *word, nh_ex *out, nh_error *error)
{
    const nh_model *model = x->v->model;
    const nh_system *system = x->v->system;
    if (!strcmp(word, "E")) return *out = in_velocities(model, model->E), true;
    if (!strcmp(word, "Lbar")) return *out = in_velocities(model, model->Lbar), true;
    for (size_t i = 0; i < system->currents; i++)
        if (same_name(system->current[i].name, word)) return *out = system->current[i].value, true;
    bool numbered = !strncmp(word, "Phi", 3) && isdigit((unsigned char)word[3 + (word[3] == '_')]);
    return numbered && found_by_analysis(x, word, out, error);
}

static bool learn(names *x, const char *typed, size_t begin, size_t length, nh_error *error)
{
    for (size_t at = begin; at < begin + length;) {
        size_t end = at;
        while (end < begin + length && (isalnum((unsigned char)typed[end]) || typed[end] == '_')) end++;
        if (end == at || isdigit((unsigned char)typed[at])) {
            at = end + (end == at);
            continue;
        }
        const char *word = nh_arena_strndup(x->v->arena, typed + at, end - at);
        nh_ex value;
        if (!is_of_system(x, word)) {
            if (meaning(x, word, &value, error)) add(x, word, value);
            else if (error->code != NH_OK) return false;
        }
        at = end;
    }
    return true;
}

static bool parse(names *x, const char *typed, size_t begin, size_t length, nh_ex *out, nh_error *error)
{
    return nh_system_expression_part(x->v->system, x->option, typed, begin, length, x->count, x->name, out, error);
}

bool nh_verification_read(nh_verification *v, const char *option, const char *typed, size_t begin, size_t length,
                          nh_ex *out, nh_error *error)
{
    names x = {.v = v, .option = option};
    bool good = learn(&x, typed, begin, length, error) && parse(&x, typed, begin, length, out, error);
    nh_analysis_free(x.own);
    v->named = v->named || x.count;
    return good;
}

/* ---- fields ---- */

typedef struct {
    nh_ex letter; /* the symbol that stands for it */
    nh_field field;
} named_field;

static bool field_of_current(names *x, nh_ex phi, nh_field *out, nh_error *error)
{
    nh_verification *v = x->v;
    enum { points_of_one = 24 };
    const nh_options *options = v->options;
    nh_points *generic = nh_points_create(v->model, points_of_one, 1, (uint64_t)options->seed + 8, error);
    nh_symmetry *z = nh_arena_alloc(v->arena, sizeof *z);
    bool good = generic && nh_symmetry_of(v->model, generic, phi, options->same, z, error);
    nh_points_free(generic);
    *out = z->field;
    return good;
}

/* The bracket that closes the one at `open`, or `end`. */
static size_t closing(const char *text, size_t open, size_t end)
{
    int depth = 0;
    for (size_t i = open; i < end; i++) {
        depth += (text[i] == '(') - (text[i] == ')');
        if (!depth) return i;
    }
    return end;
}

/* In `text` each Z(..) becomes a name of the same length, so that places in messages remain right. */
static bool take_fields(names *x, const char *typed, char *text, named_field *f, size_t *count, nh_error *error)
{
    size_t end = is_of_system(x, "Z(t)") ? 0 : strlen(typed);
    nh_dag *d = x->v->model->dag;
    for (size_t i = 0; i < end; i++) {
        bool first = !i || !(isalnum((unsigned char)typed[i - 1]) || typed[i - 1] == '_');
        if (!first || strncmp(typed + i, "Z(", 2)) continue;
        size_t close = closing(typed, i + 1, end);
        nh_ex phi;
        if (close == end) return nh_deck_fail_typed(x->option, typed, i + 1, error, "a bracket is not closed");
        if (*count == most_fields) return nh_deck_fail_typed(x->option, typed, i, error, "these are too many fields");
        if (!learn(x, typed, i + 2, close - i - 2, error) || !parse(x, typed, i + 2, close - i - 2, &phi, error) ||
            !nh_analysis_file_to_chart(x->v->model, phi, &phi, error) ||
            !field_of_current(x, phi, &f[*count].field, error))
            return false;
        memset(text + i, '_', close + 1 - i);
        text[i] = 'Z';
        text[i + 1] = (char)('a' + *count);
        const char *name = nh_arena_strndup(x->v->arena, text + i, close + 1 - i);
        f[*count].letter = nh_symbol_fresh(d, name);
        add(x, name, f[(*count)++].letter);
        i = close;
    }
    return true;
}

/* e = sum of f times its letter, with functions f: the coefficients; false: it is no such sum. */
static bool linear(const nh_verification *v, nh_ex e, size_t count, const named_field *f, nh_ex *coefficient)
{
    nh_dag *d = v->model->dag;
    nh_ex rest = e;
    for (size_t i = 0; i < count; i++) {
        coefficient[i] = nh_simplify(d, nh_diff(d, e, f[i].letter));
        for (size_t j = 0; j < count; j++)
            if (nh_depends(d, coefficient[i], f[j].letter)) return false;
        rest = nh_sub(d, rest, nh_mul(d, coefficient[i], f[i].letter));
    }
    return nh_normal_is_zero(d, rest, (size_t)v->options->proof_terms) == NH_ZERO;
}

/* Messages show what was typed. */
static void unmask(char *message, const char *text, const char *typed)
{
    char *at = strstr(message, text);
    if (at) memcpy(at, typed, strlen(typed));
}

bool nh_verification_read_field(nh_verification *v, const char *typed, nh_field *out, nh_error *error)
{
    names x = {.v = v, .option = "--field"};
    const nh_model *model = v->model;
    nh_dag *d = model->dag;
    named_field f[most_fields + 1];
    size_t count = 0;
    nh_ex e, coefficient[most_fields + 1];
    char *text = nh_arena_strdup(v->arena, typed);
    bool good = true;
    if (!is_of_system(&x, "Gamma")) {
        f[count++] = (named_field){nh_symbol_fresh(d, "Gamma"), {nh_int(d, 1), model->rho, model->a}};
        add(&x, "Gamma", f[0].letter);
    }
    good = take_fields(&x, typed, text, f, &count, error) && learn(&x, text, 0, strlen(text), error) &&
           parse(&x, text, 0, strlen(text), &e, error) && nh_analysis_file_to_chart(v->model, e, &e, error);
    nh_analysis_free(x.own);
    if (!good) return unmask(error->excerpt, text, typed), false;
    if (!linear(v, e, count, f, coefficient)) {
        nh_fail(error, NH_USAGE, "--field", "`%s` is no sum of functions times Gamma or Z(..)", typed);
        return nh_error_hint(error, "for example: Gamma/Lbar, or Z(Phi_1) - E*Gamma; or components: Z0=1; x=x'");
    }
    for (size_t i = 0; i < count; i++) {
        const nh_field *z = &f[i].field;
        out->time = nh_add(d, out->time, nh_mul(d, coefficient[i], z->time));
        for (size_t s = 0; s < model->m; s++)
            out->space[s] = nh_add(d, out->space[s], nh_mul(d, coefficient[i], z->space[s]));
        for (size_t l = 0; l < model->n; l++)
            out->velocity[l] = nh_add(d, out->velocity[l], nh_mul(d, coefficient[i], z->velocity[l]));
    }
    return true;
}
