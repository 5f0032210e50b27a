#include "system/system.h"

#include <string.h>

#include "base/text.h"
#include "evaluate/tape.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/parse.h"
#include "graph/print.h"
#include "system/ordinary.h"
#include "system/system_internal.h"

/* ---- names ---- */

typedef struct {
    const nh_system *system;
    size_t extras;
    const nh_named *extra;
    unsigned forbid; /* NH_NO_VELOCITIES, NH_NO_QUASI */
} scope;

static bool in_named(size_t count, const nh_named *list, const char *name, nh_ex *out)
{
    for (size_t i = 0; i < count; i++) {
        if (strcmp(list[i].name, name)) continue;
        *out = list[i].value;
        return true;
    }
    return false;
}

static bool in_coordinates(const scope *s, const char *name, nh_ex *out, nh_parse_fault *fault)
{
    const nh_system *system = s->system;
    for (size_t i = 0; i < system->coordinates; i++) {
        size_t n = strlen(system->coordinate[i].name);
        if (strncmp(system->coordinate[i].name, name, n)) continue;
        bool velocity = !strcmp(name + n, "'");
        if (name[n] && !velocity) continue;
        *out = velocity ? system->coordinate[i].v : system->coordinate[i].q;
        if (!velocity || !(s->forbid & NH_NO_VELOCITIES)) return true;
        snprintf(fault->what, sizeof fault->what, "the velocity `%s` cannot be used here", name);
        snprintf(fault->hint, sizeof fault->hint,
                 "the map gives the coordinates' velocities: write it in quasi-velocities, coordinates and t");
        return false;
    }
    return false;
}

/* X' of a definition X(t, q): its derivative by time along any motion, dX/dt + sum_s dX/dq^s v^s.  One of X with
   velocities would hold accelerations. */
static bool rate_of_definition(const scope *s, const char *name, nh_ex *out, nh_parse_fault *fault)
{
    const nh_system *system = s->system;
    size_t length = strcspn(name, "'");
    const nh_named *x = NULL;
    for (size_t i = 0; i < system->definitions; i++)
        if (strlen(system->definition[i].name) == length && !strncmp(system->definition[i].name, name, length))
            x = &system->definition[i];
    if (!x || strcmp(name + length, "'")) return false;
    *out = nh_diff(system->dag, x->value, system->t);
    for (size_t i = 0; i < system->coordinates; i++) {
        if (!nh_is_zero(system->dag, nh_diff(system->dag, x->value, system->coordinate[i].v)))
            snprintf(fault->what, sizeof fault->what,
                     "`%s` is the time derivative of a definition with velocities: it contains accelerations", name);
        *out = nh_add(
            system->dag, *out,
            nh_mul(system->dag, nh_diff(system->dag, x->value, system->coordinate[i].q), system->coordinate[i].v));
    }
    if (!fault->what[0] && (s->forbid & NH_NO_VELOCITIES))
        snprintf(fault->what, sizeof fault->what, "the velocity `%s` cannot be used here", name);
    if (fault->what[0])
        snprintf(fault->hint, sizeof fault->hint,
                 "the time derivative of a definition without velocities is allowed wherever velocities are");
    return !fault->what[0];
}

static const char undeclared[] = "declare it under parameters, coordinates or definitions";

/* "did you mean" over everything that has a name here: the nearest name, or NULL. */
static const char *suggest(const scope *s, const char *name, nh_parse_fault *fault)
{
    const nh_system *system = s->system;
    size_t n = 0, max = 2 + s->extras + system->definitions + system->parameters + 2 * system->coordinates +
                        system->quasi + 12 * system->orientations + NH_FUNCTION_COUNT;
    const char **list = nh_alloc_array(max, sizeof *list);
    for (size_t i = 0; i < s->extras; i++) list[n++] = s->extra[i].name;
    for (size_t i = 0; i < system->definitions; i++) list[n++] = system->definition[i].name;
    for (size_t i = 0; i < system->parameters; i++) list[n++] = system->parameter[i].name;
    for (size_t i = 0; i < system->coordinates; i++) list[n++] = system->coordinate[i].name;
    for (size_t i = 0; i < system->coordinates && system->coordinate[i].v; i++)
        list[n++] = nh_name_of(system->dag, system->coordinate[i].v);
    for (size_t i = 0; i < system->quasi; i++) list[n++] = nh_name_of(system->dag, system->quasi_velocity[i]);
    for (size_t i = 0; i < 12 * system->orientations; i++)
        list[n++] =
            i % 12 < 9 ? system->orientation[i / 12].entry[i % 12] : system->orientation[i / 12].word[i % 12 - 9];
    list[n++] = "sqrt";
    for (int f = 0; f < NH_FUNCTION_COUNT; f++) list[n++] = nh_function_name((nh_function)f);
    snprintf(fault->what, sizeof fault->what, "unknown name `%s`", name);
    const char *near = nh_text_nearest(name, list, n), *prime = strchr(name, '\'');
    bool meant = near && (!prime || strchr(near, '\'')), stem = false; /* m' is not a misspelt m */
    for (size_t i = 0; prime && i < n; i++)
        stem |= strlen(list[i]) == (size_t)(prime - name) && !strncmp(list[i], name, (size_t)(prime - name));
    if (meant) snprintf(fault->hint, sizeof fault->hint, "did you mean `%s`?", near);
    else if (prime && !stem)
        snprintf(fault->hint, sizeof fault->hint,
                 "`%.*s` is not known: write `- %.*s = ...` under `definitions:`, or name it under `coordinates:`",
                 (int)(prime - name), name, (int)(prime - name), name);
    else if (prime)
        snprintf(fault->hint, sizeof fault->hint,
                 "a prime marks the velocity of a coordinate or the time derivative of a definition; `%.*s` is neither",
                 (int)(prime - name), name);
    else if (s->extras)
        snprintf(fault->hint, sizeof fault->hint,
                 "declare it in the system file (parameters, coordinates, definitions), or where this has definitions, "
                 "unknowns or a start of its own");
    else snprintf(fault->hint, sizeof fault->hint, "%s", undeclared);
    nh_free(list);
    return near;
}

/* xdot, x_dot, dotx for x', e for exp, np.sin for sin: how the same is written elsewhere. */
static void translate(const scope *s, const char *name, const char *near, nh_parse_fault *fault)
{
    const nh_system *system = s->system;
    if (!strcmp(name, "energy")) snprintf(fault->hint, sizeof fault->hint, "the energy is written E");
    if (!strcmp(name, "e"))
        snprintf(fault->hint, sizeof fault->hint,
                 "the exponential function is written exp(...), and 1e-3 without blanks");
    static const char *const module[] = {"np", "numpy", "math", "sp", "sympy", "cmath", "scipy"};
    for (size_t i = 0; i < sizeof module / sizeof *module; i++)
        if (!strcmp(name, module[i]))
            snprintf(fault->hint, sizeof fault->hint, "functions are written without a module: sin(x), sqrt(x), pi");
    const char *q = nh_system_velocity_meant(system, name, near);
    if (q) snprintf(fault->hint, sizeof fault->hint, NH_VELOCITY_IS_WRITTEN, q, q);
}

static bool resolve(void *context, const char *name, nh_ex *out, nh_parse_fault *fault)
{
    const scope *s = context;
    const nh_system *system = s->system;
    if (!strcmp(name, "t")) {
        *out = system->t;
        return true;
    }
    const nh_named *definition = s->forbid & NH_FRAMED ? system->framed_definition : system->definition;
    bool velocity;
    if (in_named(s->extras, s->extra, name, out) || in_named(system->definitions, definition, name, out)) return true;
    name = nh_system_state_name(system, name);
    for (size_t i = 0; i < system->quasi && system->orientations && !(s->forbid & NH_NO_QUASI); i++)
        if (!strcmp(nh_name_of(system->dag, system->quasi_velocity[i]), name))
            return *out = system->quasi_velocity[i], true;
    if (nh_orientation_word(system, name, s->forbid & NH_FRAMED, &velocity, out)) {
        if (!velocity || !(s->forbid & NH_NO_VELOCITIES)) return true;
        snprintf(fault->what, sizeof fault->what, "the angular velocity `%s` cannot be used here", name);
        return false;
    }
    for (size_t i = 0; i < system->parameters; i++) {
        if (strcmp(system->parameter[i].name, name)) continue;
        *out = system->parameter[i].symbol;
        return true;
    }
    if (in_coordinates(s, name, out, fault)) return true;
    if (!fault->what[0] && rate_of_definition(s, name, out, fault)) return true;
    if (fault->what[0]) return false;
    for (size_t i = 0; i < system->quasi; i++) {
        if (strcmp(nh_name_of(system->dag, system->quasi_velocity[i]), name)) continue;
        *out = system->quasi_velocity[i];
        if (!(s->forbid & NH_NO_QUASI)) return true;
        snprintf(fault->what, sizeof fault->what, "the quasi-velocity `%s` cannot be used here", name);
        snprintf(fault->hint, sizeof fault->hint, "write it in the coordinates' own velocities");
        return false;
    }
    translate(s, name, suggest(s, name, fault), fault);
    return false;
}

/* Where an expression should stand: after `skip` bytes there is another `=`. */
static bool not_an_equation(const nh_deck *deck, const nh_deck_node *node, size_t skip, nh_error *error)
{
    const char *equal = strchr(node->text + skip, '=');
    if (!equal) return true;
    size_t at = (size_t)(equal - node->text);
    if (skip) return nh_deck_fail(deck, node, at, error, at == skip ? "write a single `=`" : "there is a second `=`");
    nh_deck_fail(deck, node, at, error, "an expression was expected here, not an equation");
    return nh_error_hint(error, "equations stand under constraints, forces, definitions and in the velocities' map");
}

/* The order of a function must be constant: a first argument that contains coordinates, velocities or time, or NULL. */
static const char *moving_order(const nh_system *system, nh_ex e)
{
    NH_LIST(call);
    NH_LIST(symbol);
    size_t calls = nh_functions_in(system->dag, e, &call);
    for (size_t i = 0; i < calls; i++) {
        nh_function f = nh_function_of(system->dag, call[i]);
        for (size_t j = 0; j < nh_function_constants(f); j++) {
            size_t n = nh_symbols_in(system->dag, nh_child(system->dag, call[i], j), &symbol), fixed = 0;
            for (size_t k = 0; k < n; k++)
                for (size_t p = 0; p < system->parameters; p++) fixed += system->parameter[p].symbol == symbol[k];
            if (fixed < n) return nh_function_name(f);
        }
    }
    return NULL;
}

/* Parses, and checks conditions beyond the grammar. */
static bool read_text(const nh_system *system, const char *text, scope *s, nh_ex *lhs, nh_ex *rhs,
                      nh_parse_fault *fault)
{
    if (lhs ? !nh_parse_equation(system->dag, text, resolve, s, lhs, rhs, fault)
            : !nh_parse(system->dag, text, resolve, s, rhs, fault))
        return false;
    const char *name = lhs ? moving_order(system, *lhs) : NULL, *place;
    if (!name) name = moving_order(system, *rhs);
    if (!name) return true;
    nh_function f = NH_SIN;
    while (strcmp(nh_function_name(f), name)) f++;
    place = strstr(text, name);
    *fault = (nh_parse_fault){.offset = place ? (size_t)(place - text) : 0};
    snprintf(fault->what, sizeof fault->what,
             "only the last argument of %s(%s) may move: the others are numbers or parameters", name,
             nh_function_arguments(f));
    snprintf(fault->hint, sizeof fault->hint, "the derivative with respect to another argument has no closed form");
    return false;
}

/* The same with what is wrong. */
static bool is_known(void *context, const char *name)
{
    nh_parse_fault fault = {.offset = 0};
    nh_ex any;
    return resolve(context, name, &any, &fault);
}

static bool read_node(const nh_deck *deck, const nh_deck_node *node, size_t skip, scope *s, nh_ex *lhs, nh_ex *rhs,
                      nh_parse_fault *fault, nh_error *error)
{
    if (!lhs && !not_an_equation(deck, node, skip, error)) return false;
    if (read_text(s->system, node->text + skip, s, lhs, rhs, fault)) return true;
    nh_deck_fail(deck, node, skip + fault->offset, error, "%s", fault->what);
    const char *letter = nh_deck_escaped_letter(deck, node);
    if (letter)
        return nh_error_hint(error,
                             "between double quotes YAML reads \\%c in its own way: write '\\%s' between single "
                             "quotes, or %s",
                             *letter, letter, letter);
    if (!strcmp(fault->hint, undeclared)) return nh_ordinary_hint_declare(deck, is_known, s, error);
    return fault->hint[0] ? nh_error_hint(error, "%s", fault->hint) : false;
}

bool nh_system_read_expression(const nh_system *system, const nh_deck *deck, const nh_deck_node *node, size_t skip,
                               unsigned forbid, size_t extras, const nh_named *extra, nh_ex *lhs, nh_ex *rhs,
                               nh_error *error)
{
    nh_parse_fault fault;
    return read_node(deck, node, skip, &(scope){system, extras, extra, forbid}, lhs, rhs, &fault, error);
}

bool nh_system_read_written(const nh_system *system, const nh_deck *deck, const nh_deck_node *node, size_t skip,
                            nh_ex *lhs, nh_ex *rhs, const char **text, nh_error *error)
{
    nh_parse_fault fault;
    if (!read_node(deck, node, skip, &(scope){system, 0, NULL, NH_NO_QUASI}, lhs, rhs, &fault, error)) return false;
    *text = node->text + skip + strspn(node->text + skip, " ");
    if (!fault.ordinary) return true;
    char *left = lhs ? nh_print_string(system->dag, *lhs) : NULL, *right = nh_print_string(system->dag, *rhs);
    *text = nh_arena_printf(system->arena, "%s%s%s", left ? left : "", left ? " = " : "", right);
    nh_free(left);
    nh_free(right);
    return true;
}

bool nh_system_read_defined(const nh_system *system, const nh_deck *deck, const nh_deck_node *node, nh_ex *out,
                            bool *undefined, nh_error *error)
{
    nh_parse_fault fault = {.undefined = false};
    bool good = nh_deck_is(deck, node, NH_DECK_SCALAR, "an expression", error) &&
                read_node(deck, node, 0, &(scope){system, 0, NULL, 0}, NULL, out, &fault, error);
    *undefined = !good && fault.undefined;
    return good;
}

bool nh_system_expression(const nh_system *system, const nh_deck *deck, const nh_deck_node *node, size_t extras,
                          const nh_named *extra, nh_ex *out, nh_error *error)
{
    if (!nh_deck_is(deck, node, NH_DECK_SCALAR, "an expression", error)) return false;
    return nh_system_read_expression(system, deck, node, 0, 0, extras, extra, NULL, out, error);
}

bool nh_system_right_side(const nh_system *system, const nh_deck *deck, const nh_deck_node *node, size_t extras,
                          const nh_named *extra, nh_ex *out, nh_error *error)
{
    const char *equal = strchr(node->text, '=');
    size_t skip = equal ? (size_t)(equal - node->text) + 1 : 0;
    return nh_system_read_expression(system, deck, node, skip, 0, extras, extra, NULL, out, error);
}

bool nh_system_expression_part(const nh_system *system, const char *where, const char *typed, size_t begin,
                               size_t length, size_t extras, const nh_named *extra, nh_ex *out, nh_error *error)
{
    scope s = {system, extras, extra, 0};
    nh_parse_fault fault;
    if (read_text(system, nh_arena_strndup(system->arena, typed + begin, length), &s, NULL, out, &fault)) return true;
    nh_deck_fail_typed(where, typed, begin + fault.offset, error, "%s", fault.what);
    return fault.hint[0] ? nh_error_hint(error, "%s", fault.hint) : false;
}

bool nh_system_expression_text(const nh_system *system, const char *where, const char *text, size_t extras,
                               const nh_named *extra, nh_ex *out, nh_error *error)
{
    return nh_system_expression_part(system, where, text, 0, strlen(text), extras, extra, out, error);
}

long nh_system_coordinate(const nh_system *system, const char *name)
{
    const char *spelled = nh_deck_spelled(system->arena, name);
    for (size_t i = 0; i < system->coordinates; i++)
        if (!strcmp(system->coordinate[i].name, spelled)) return (long)i;
    return -1;
}

const char *nh_system_state_name(const nh_system *system, const char *name)
{
    static const char *const around[][3] = {
        {"", "_dot", "'"}, {"", "dot", "'"}, {"d", "/dt", "'"}, {"", "_ddot", "''"}, {"", "ddot", "''"}};
    size_t length = strlen(name);
    bool start = length > 3 && !strcmp(name + length - 3, "(0)"); /* x(0) = 1 */
    name = nh_deck_spelled(system->arena, start ? nh_arena_strndup(system->arena, name, length - 3) : name);
    length = strlen(name);
    nh_ex taken;
    if (nh_symbol_find(system->dag, name, &taken) || in_named(system->definitions, system->definition, name, &taken))
        return name;
    for (size_t i = 0; i < sizeof around / sizeof *around; i++) {
        size_t head = strlen(around[i][0]), tail = strlen(around[i][1]);
        if (length <= head + tail || strncmp(name, around[i][0], head) || strcmp(name + length - tail, around[i][1]))
            continue;
        const char *stem =
            nh_deck_spelled(system->arena, nh_arena_strndup(system->arena, name + head, length - head - tail));
        bool known = nh_symbol_find(system->dag, stem, &taken) ||
                     in_named(system->definitions, system->definition, stem, &taken);
        if (known || !i) return nh_arena_printf(system->arena, "%s%s", stem, around[i][2]);
    }
    return name;
}

void nh_system_bindings(const nh_system *system, const nh_ex **symbols, const double **values)
{
    nh_ex *s = nh_arena_alloc(system->arena, (system->parameters + 1) * sizeof *s);
    double *v = nh_arena_alloc(system->arena, (system->parameters + 1) * sizeof *v);
    for (size_t i = 0; i < system->parameters; i++) {
        s[i] = system->parameter[i].symbol;
        v[i] = system->parameter[i].value;
    }
    *symbols = s;
    *values = v;
}

nh_ex nh_system_values(const nh_system *system, nh_dag *dag, nh_ex e)
{
    nh_ex *symbol = nh_alloc_array(2 * system->parameters + 1, sizeof *symbol), *value = symbol + system->parameters;
    for (size_t i = 0; i < system->parameters; i++) {
        symbol[i] = system->parameter[i].symbol;
        value[i] = nh_number(dag, nh_num_decimal(system->parameter[i].value));
    }
    e = nh_substitute(dag, e, system->parameters, symbol, value);
    nh_free(symbol);
    return e;
}

double nh_system_number(const nh_system *system, nh_ex e)
{
    const nh_ex *symbols;
    const double *values;
    double value;
    nh_system_bindings(system, &symbols, &values);
    nh_tape_constants(system->dag, 1, &e, system->parameters, symbols, values, &value);
    return value;
}

void nh_system_free(nh_system *system)
{
    if (!system) return;
    nh_dag_free(system->dag);
    nh_deck_free(system->deck);
    nh_arena_free(system->arena);
}
