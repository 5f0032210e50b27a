#include "system/shape.h"

#include <string.h>

#include "graph/dag.h"

enum { plane = 2, axes = 6 };

/* given: how many numbers a file gives; a body in space also has its axes. */
static const struct {
    const char *name;
    size_t given;
    bool space, turns;
} kinds[NH_SHAPE_KINDS] = {{"point", 2, false, false},  {"arrow", 3, false, false},   {"disc", 3, false, false},
                           {"wheel", 4, false, false},  {"segment", 4, false, false}, {"ball", 4, true, true},
                           {"cylinder", 5, true, true}, {"box", 6, true, true},       {"rod", 6, true, false}};

static const char *const formats = "point: [x, y], arrow: [x, y, angle], disc: [x, y, radius], wheel: [x, y, angle, "
                                   "radius], segment: [x1, y1, x2, y2]; in space "
                                   "ball: [x, y, z, radius], cylinder: [x, y, z, radius, height], box: [x, y, z, a, b, "
                                   "c], rod: [x1, y1, z1, x2, y2, z2]";

const char *nh_shape_name(nh_shape_kind kind) { return kinds[kind].name; }
size_t nh_shape_numbers(nh_shape_kind kind) { return kinds[kind].given + (kinds[kind].turns ? axes : 0); }
bool nh_shape_in_space(nh_shape_kind kind) { return kinds[kind].space; }

static void put_pose(nh_shape *s, const nh_pose *pose)
{
    for (size_t i = 0; i < 3; i++) {
        s->value[i] = pose->p[i];
        for (size_t k = 0; k < plane; k++) s->value[kinds[s->kind].given + 3 * k + i] = pose->R[3 * i + k];
    }
}

nh_shape nh_shape_solid(nh_shape_kind kind, const char *name, const nh_pose *pose, const nh_ex *size)
{
    nh_shape out = {.kind = kind, .name = name};
    for (size_t i = 3; i < kinds[kind].given; i++) out.value[i] = size[i - 3];
    put_pose(&out, pose);
    return out;
}

/* [z: p, x: h]: turns about the body's own axes, one after another. */
static bool read_turns(const nh_deck *deck, const nh_deck_node *list, nh_dag *dag, nh_shape_parse *parse, void *context,
                       nh_pose *pose, nh_error *error)
{
    static const char *const axis[] = {"x", "y", "z"};
    if (!nh_deck_is(deck, list, NH_DECK_LIST, "turn [z: angle, x: angle, ..]", error)) return false;
    for (size_t i = 0; i < list->count; i++) {
        const nh_deck_node *turn = list->item[i];
        nh_ex u[3], angle;
        if (!nh_deck_is(deck, turn, NH_DECK_MAP, "a turn `z: angle`", error) ||
            !nh_deck_only(deck, turn, axis, 3, error))
            return false;
        for (size_t k = 0; k < turn->count; k++) {
            for (size_t e = 0; e < 3; e++) u[e] = nh_int(dag, !strcmp(turn->key[k]->text, axis[e]));
            if (!nh_deck_is(deck, turn->item[k], NH_DECK_SCALAR, "an expression", error) ||
                !parse(context, turn->item[k], &angle))
                return false;
            nh_pose next = nh_pose_turn(dag, u, angle);
            *pose = nh_pose_product(dag, pose, &next);
        }
    }
    return true;
}

static bool read_numbers(const nh_deck *deck, const nh_deck_node *list, nh_shape_parse *parse, void *context,
                         nh_shape *out, nh_error *error)
{
    size_t numbers = kinds[out->kind].given;
    if (!nh_deck_is(deck, list, NH_DECK_LIST, kinds[out->kind].name, error)) return false;
    if (list->count != numbers) {
        nh_deck_fail(deck, list, 0, error, "a %s is given by %zu expressions, found %zu", kinds[out->kind].name,
                     numbers, list->count);
        return nh_error_hint(error, "%s", formats);
    }
    for (size_t j = 0; j < numbers; j++)
        if (!nh_deck_is(deck, list->item[j], NH_DECK_SCALAR, "an expression", error) ||
            !parse(context, list->item[j], &out->value[j]))
            return false;
    return true;
}

bool nh_shape_read(const nh_deck *deck, const nh_deck_node *node, nh_dag *dag, nh_shape_parse *parse, void *context,
                   nh_shape *out, nh_error *error)
{
    enum { name = NH_SHAPE_KINDS, turn, keys };
    const char *names[keys] = {[name] = "name", [turn] = "turn"};
    const nh_deck_node *list = NULL, *turns = NULL;
    size_t shapes = 0;
    for (int k = 0; k < NH_SHAPE_KINDS; k++) names[k] = kinds[k].name;
    if (!nh_deck_is(deck, node, NH_DECK_MAP, "a shape {point: [x, y]}", error)) return false;
    if (!nh_deck_only(deck, node, names, keys, error)) return false;
    *out = (nh_shape){0};
    for (size_t i = 0; i < node->count; i++) {
        int kind = 0;
        while (strcmp(node->key[i]->text, names[kind])) kind++;
        if (kind == name && !nh_deck_is(deck, node->item[i], NH_DECK_SCALAR, "name", error)) return false;
        if (kind == name) out->name = node->item[i]->text;
        else if (kind == turn) turns = node->item[i];
        else out->kind = (nh_shape_kind)kind, list = node->item[i], shapes++;
    }
    if (shapes != 1) return nh_deck_fail(deck, node, 0, error, "one shape per entry, found %zu", shapes);
    if (!read_numbers(deck, list, parse, context, out, error)) return false;
    if (turns && !kinds[out->kind].turns)
        return nh_deck_fail(deck, turns, 0, error, "a %s has no `turn`; a ball, a cylinder and a box have",
                            kinds[out->kind].name);
    if (!kinds[out->kind].turns) return true;
    nh_pose pose = nh_pose_identity(dag);
    for (size_t i = 0; i < 3; i++) pose.p[i] = out->value[i];
    if (turns && !read_turns(deck, turns, dag, parse, context, &pose, error)) return false;
    put_pose(out, &pose);
    return true;
}
