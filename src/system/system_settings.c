/* system_settings: values that a request gives to parameters of a system. */
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/parse.h"
#include "system/system_internal.h"

typedef nh_system_reader reader;

static void remove_parameter(nh_system *s, nh_parameter *p)
{
    size_t behind = s->parameters - 1 - (size_t)(p - s->parameter);
    memmove(p, p + 1, behind * sizeof *p);
    s->parameters--;
}

/* Gives the hint for a name that is unknown here, but may be one of a coordinate.  False. */
static bool hint_state(nh_error *error)
{
    if (strncmp(error->what, "unknown name", strlen("unknown name")) || !strncmp(error->hint, "did you mean", 12))
        return false;
    *error->hint = 0;
    return nh_error_hint(error, "an input is an expression of t and parameters; what depends on the state stands under "
                                "`forces:`");
}

/* An input over time replaces a parameter, as a definition.  It may contain names that are known before the
 * coordinates. */
static bool make_input(reader *r, nh_parameter *p, const nh_setting *setting)
{
    nh_system *s = r->system;
    nh_ex value;
    const char *name = p->name, *text = nh_arena_printf(s->arena, "%s = %s", name, setting->input);
    if (!nh_system_expression_text(s, nh_arena_printf(s->arena, "--input %s", name), setting->input, 0, NULL, &value,
                                   r->error))
        return hint_state(r->error);
    if (nh_depends(s->dag, value, p->symbol))
        return nh_fail(r->error, NH_USAGE, "--input", "the input `%s` depends on itself", name);
    s->definition[s->definitions++] = (nh_named){.name = name, .text = text, .value = value};
    remove_parameter(s, p);
    return s->driven = true;
}

/* Those that have exact values already are definitions. */
static bool among_parameters(void *context, const char *name, nh_ex *out, nh_parse_fault *fault)
{
    const nh_system *s = context;
    for (size_t i = 0; i < s->parameters; i++)
        if (!strcmp(s->parameter[i].name, name)) return *out = s->parameter[i].symbol, true;
    for (size_t i = 0; i < s->definitions; i++)
        if (!strcmp(s->definition[i].name, name)) return *out = s->definition[i].value, true;
    snprintf(fault->what, sizeof fault->what, "`%s` is not a parameter", name);
    return false;
}

/* A parameter with an exact value becomes a definition. */
static bool fix(reader *r, nh_parameter *p, const nh_setting *setting)
{
    nh_system *s = r->system;
    nh_parse_fault fault = {.offset = 0};
    nh_named d = {.name = p->name};
    if (setting->formula) {
        d.text = nh_arena_printf(s->arena, "%s = %s", p->name, setting->formula);
        if (!nh_parse(s->dag, setting->formula, among_parameters, s, &d.value, &fault))
            return nh_fail(r->error, NH_USAGE, "", "`%s` cannot be `%s`: %s", p->name, setting->formula, fault.what);
    } else {
        d.text = nh_arena_printf(s->arena, setting->bottom == 1 ? "%s = %lld" : "%s = %lld/%lld", p->name,
                                 (long long)setting->top, (long long)setting->bottom);
        d.value = nh_ratio(s->dag, setting->top, setting->bottom);
    }
    s->definition[s->definitions++] = d;
    remove_parameter(s, p);
    return r->exact = true;
}

bool nh_system_apply_settings(reader *r, size_t count, const nh_setting *setting)
{
    nh_system *s = r->system;
    s->definition = nh_system_take(r, count, sizeof *s->definition);
    for (size_t k = 0; k < count; k++) {
        nh_parameter *found = NULL;
        const char *name = nh_deck_spelled(s->arena, setting[k].name);
        if (nh_system_is_function_setting(&setting[k])) continue;
        for (size_t i = 0; i < s->parameters; i++)
            if (!strcmp(s->parameter[i].name, name)) found = &s->parameter[i];
        if (found && (setting[k].bottom > 0 || setting[k].formula || setting[k].input)) {
            if (!(setting[k].input ? make_input : fix)(r, found, &setting[k])) return false;
            continue;
        }
        if (found) {
            found->written = found->value;
            found->value = setting[k].value;
            found->set = true;
            continue;
        }
        if (setting[k].key)
            nh_deck_fail(setting[k].deck, setting[k].key, 0, r->error, "`%s` is not a parameter of %s", setting[k].name,
                         s->name);
        else nh_fail(r->error, NH_USAGE, "", "`%s` is not a parameter of %s", setting[k].name, s->name);
        return nh_system_hint_parameters(s, setting[k].name, r->error);
    }
    return true;
}
