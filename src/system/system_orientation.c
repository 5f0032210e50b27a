/* system_orientation: the orientations of a system file: names, matrices, expressions in their angular velocities. */
#include <string.h>

#include "base/text.h"
#include "graph/dag.h"
#include "graph/parse.h"
#include "system/system_internal.h"

static const char *const axes[] = {"x", "y", "z"};

/* ---- names ---- */

static bool new_name(nh_system_reader *r, const nh_deck_node *place, const char *text)
{
    nh_deck_node node = *place;
    node.kind = NH_DECK_SCALAR;
    node.text = text;
    return nh_system_new_name(r, &node);
}

/* `velocities: [p, q, r]`, or NAME_wx, NAME_wy, NAME_wz. */
static bool words_of(nh_system_reader *r, const nh_deck_node *item, nh_orientation *o)
{
    nh_arena *arena = r->system->arena;
    const nh_deck_node *list = item && item->kind == NH_DECK_MAP ? nh_deck_get(item, "velocities") : NULL;
    if (list && !nh_deck_is(r->deck, list, NH_DECK_LIST, "velocities", r->error)) return false;
    if (list && list->count != 3) {
        nh_deck_fail(r->deck, list, 0, r->error, "an orientation has three angular velocities, not %zu", list->count);
        return nh_error_hint(r->error, "for example: velocities: [omega_x, omega_y, omega_z]");
    }
    for (int k = 0; k < 3; k++) {
        const nh_deck_node *place = list ? list->item[k] : o->node;
        if (list && !nh_deck_is(r->deck, place, NH_DECK_SCALAR, "a name", r->error)) return false;
        o->word[k] = list ? place->text : nh_arena_printf(arena, "%s_w%s", o->name, axes[k]);
        if (!new_name(r, place, o->word[k])) return false;
        o->omega[k] = nh_symbol(r->system->dag, o->word[k]);
    }
    for (int k = 0; k < 9; k++) {
        o->entry[k] = nh_arena_printf(arena, "%s_%s%s", o->name, axes[k / 3], axes[k % 3]);
        if (!new_name(r, o->node, o->entry[k])) return false;
        o->entry_symbol[k] = nh_symbol(r->system->dag, o->entry[k]);
    }
    return true;
}

static bool frame_of(nh_system_reader *r, const nh_deck_node *item, nh_orientation *o)
{
    const nh_deck_node *node = item && item->kind == NH_DECK_MAP ? nh_deck_get(item, "frame") : NULL;
    if (!node) return true;
    if (!nh_deck_is(r->deck, node, NH_DECK_SCALAR, "frame", r->error)) return false;
    o->space = !strcmp(node->text, "space");
    return o->space || !strcmp(node->text, "body") ||
           nh_deck_fail(r->deck, node, 0, r->error, "`%s` is no frame of angular velocities; expected body or space",
                        node->text);
}

bool nh_orientation_declare(nh_system_reader *r, const nh_deck_node *item, const nh_deck_node *name, const char *doc)
{
    nh_system *system = r->system;
    nh_orientation *o = &system->orientation[system->orientations];
    *o = (nh_orientation){.name = name->text, .node = name, .first = system->coordinates};
    if (!nh_system_new_name(r, name) || !frame_of(r, item, o)) return false;
    for (int k = 0; k < 3; k++) {
        nh_coordinate *c = &system->coordinate[system->coordinates];
        *c = (nh_coordinate){.name = nh_arena_printf(system->arena, "%s_%d", o->name, k + 1), .unit = "", .doc = doc};
        c->type = NH_PLAIN;
        if (!new_name(r, name, c->name)) return false;
        c->q = nh_symbol(system->dag, c->name);
        system->coordinates++;
    }
    if (!words_of(r, item, o)) return false;
    system->orientations++;
    return true;
}

nh_orientation *nh_orientation_named(const nh_system *system, const char *name)
{
    for (size_t i = 0; i < system->orientations; i++)
        if (!strcmp(system->orientation[i].name, name)) return &system->orientation[i];
    return NULL;
}

const nh_orientation *nh_orientation_of(const nh_system *system, size_t coordinate)
{
    for (size_t i = 0; i < system->orientations; i++)
        if (coordinate - system->orientation[i].first < 3) return &system->orientation[i];
    return NULL;
}

bool nh_orientation_word(const nh_system *system, const char *word, bool framed, bool *velocity, nh_ex *out)
{
    for (size_t i = 0; i < system->orientations; i++) {
        const nh_orientation *o = &system->orientation[i];
        for (int k = 0; k < 9; k++) {
            *velocity = k < 3 && !strcmp(o->word[k], word);
            if (*velocity) return *out = framed ? o->framed[k] : o->rate[k], true;
            if (!strcmp(o->entry[k], word)) return *out = o->matrix[k], true;
        }
    }
    return false;
}

/* ---- expressions ---- */

void nh_orientation_build_all(nh_system *system)
{
    for (size_t i = 0; i < system->orientations; i++) {
        nh_orientation *o = &system->orientation[i];
        for (size_t k = 0; k < 3; k++)
            o->q[k] = system->coordinate[o->first + k].q, o->v[k] = system->coordinate[o->first + k].v;
        nh_orientation_build(system->dag, o);
    }
}

nh_ex nh_orientation_framed(const nh_system *system, nh_ex e)
{
    for (size_t i = 0; i < system->orientations; i++) {
        const nh_orientation *o = &system->orientation[i];
        nh_ex v[3], to[3];
        for (size_t k = 0; k < 3; k++) {
            v[k] = system->coordinate[o->first + k].v;
            to[k] = nh_int(system->dag, 0);
            for (int j = 0; j < 3; j++)
                to[k] = nh_add(system->dag, to[k], nh_mul(system->dag, o->map[3 * k + (size_t)j], o->framed[j]));
        }
        e = nh_substitute(system->dag, e, 3, v, to);
    }
    return e;
}

nh_ex nh_orientation_written(const nh_system *system, nh_ex e)
{
    for (size_t i = 0; i < system->orientations; i++)
        e = nh_substitute(system->dag, e, 3, system->orientation[i].framed, system->orientation[i].rate);
    return e;
}

void nh_orientation_map(const nh_system *system, const nh_ex *framed, nh_ex *out)
{
    for (size_t i = 0; i < system->coordinates; i++) {
        const nh_orientation *o = nh_orientation_of(system, i);
        if (!o) {
            out[i] = framed[i];
            continue;
        }
        out[i] = nh_int(system->dag, 0);
        for (size_t k = 0; k < 3; k++)
            out[i] =
                nh_add(system->dag, out[i], nh_mul(system->dag, o->map[3 * (i - o->first) + k], framed[o->first + k]));
    }
}

nh_ex nh_orientation_shown(const nh_system *system, nh_ex e)
{
    for (size_t i = 0; i < system->orientations; i++)
        e = nh_orientation_in_entries(system->dag, &system->orientation[i], e);
    return e;
}

nh_ex nh_orientation_unshown(const nh_system *system, nh_ex e)
{
    for (size_t i = 0; i < system->orientations; i++)
        e = nh_substitute(system->dag, e, 9, system->orientation[i].entry_symbol, system->orientation[i].matrix);
    return e;
}
