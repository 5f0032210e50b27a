/* system_settings: values that a request gives to parameters of a system. */
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/parse.h"
#include "system/system_internal.h"

typedef nh_system_reader reader;

static void remove_parameter(nh_system *system, nh_parameter *p)
{
    size_t behind = system->parameters - 1 - (size_t)(p - system->parameter);
    memmove(p, p + 1, behind * sizeof *p);
    system->parameters--;
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
    nh_system *system = r->system;
    nh_ex value;
    const char *name = p->name, *text = nh_arena_printf(system->arena, "%s = %s", name, setting->input);
    if (!nh_system_expression_text(system, nh_arena_printf(system->arena, "--input %s", name), setting->input, 0, NULL,
                                   &value, r->error))
        return hint_state(r->error);
    if (nh_depends(system->dag, value, p->symbol))
        return nh_fail(r->error, NH_USAGE, "--input", "the input `%s` depends on itself", name);
    system->definition[system->definitions++] = (nh_named){.name = name, .text = text, .value = value};
    remove_parameter(system, p);
    return system->driven = true;
}

/* Those that have exact values already are definitions. */
static bool among_parameters(void *context, const char *name, nh_ex *out, nh_parse_fault *fault)
{
    const nh_system *system = context;
    for (size_t i = 0; i < system->parameters; i++)
        if (!strcmp(system->parameter[i].name, name)) return *out = system->parameter[i].symbol, true;
    for (size_t i = 0; i < system->definitions; i++)
        if (!strcmp(system->definition[i].name, name)) return *out = system->definition[i].value, true;
    snprintf(fault->what, sizeof fault->what, "`%s` is not a parameter", name);
    return false;
}

/* A parameter with an exact value becomes a definition. */
static bool fix(reader *r, nh_parameter *p, const nh_setting *setting)
{
    nh_system *system = r->system;
    nh_parse_fault fault = {.offset = 0};
    nh_named d = {.name = p->name};
    if (setting->formula) {
        d.text = nh_arena_printf(system->arena, "%s = %s", p->name, setting->formula);
        if (!nh_parse(system->dag, setting->formula, among_parameters, system, &d.value, &fault))
            return nh_fail(r->error, NH_USAGE, "", "`%s` cannot be `%s`: %s", p->name, setting->formula, fault.what);
    } else {
        d.text = nh_arena_printf(system->arena, setting->bottom == 1 ? "%s = %lld" : "%s = %lld/%lld", p->name,
                                 (long long)setting->top, (long long)setting->bottom);
        d.value = nh_ratio(system->dag, setting->top, setting->bottom);
    }
    system->definition[system->definitions++] = d;
    remove_parameter(system, p);
    return r->exact = true;
}

bool nh_system_apply_settings(reader *r, size_t count, const nh_setting *setting)
{
    nh_system *system = r->system;
    system->definition = nh_system_take(r, count, sizeof *system->definition);
    for (size_t k = 0; k < count; k++) {
        nh_parameter *found = NULL;
        const char *name = nh_deck_spelled(system->arena, setting[k].name);
        if (nh_system_is_function_setting(&setting[k])) continue;
        for (size_t i = 0; i < system->parameters; i++)
            if (!strcmp(system->parameter[i].name, name)) found = &system->parameter[i];
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
                         system->name);
        else nh_fail(r->error, NH_USAGE, "", "`%s` is not a parameter of %s", setting[k].name, system->name);
        return nh_system_hint_parameters(system, setting[k].name, r->error);
    }
    return true;
}
