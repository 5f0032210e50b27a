#include "system/shape.h"

#include <string.h>

static const struct {
    const char *name;
    size_t numbers;
} kinds[NH_SHAPE_KINDS] = {{"point", 2}, {"arrow", 3}, {"disc", 3}, {"wheel", 4}, {"segment", 4}};

const char *nh_shape_name(nh_shape_kind kind) { return kinds[kind].name; }
size_t nh_shape_numbers(nh_shape_kind kind) { return kinds[kind].numbers; }

bool nh_shape_read(const nh_deck *deck, const nh_deck_node *node, nh_shape_parse *parse, void *context, nh_shape *out, nh_error *error)
{
    const char *names[NH_SHAPE_KINDS + 1] = {[NH_SHAPE_KINDS] = "name"};
    const nh_deck_node *list = NULL;
    size_t shapes = 0;
    for (int k = 0; k < NH_SHAPE_KINDS; k++) names[k] = kinds[k].name;
    if (!nh_deck_is(deck, node, NH_DECK_MAP, "a shape {point: [x, y]}", error)) return false;
    if (!nh_deck_only(deck, node, names, NH_SHAPE_KINDS + 1, error)) return false;
    *out = (nh_shape){0};
    for (size_t i = 0; i < node->count; i++) {
        int kind = 0;
        while (strcmp(node->key[i]->text, names[kind])) kind++;
        if (kind == NH_SHAPE_KINDS && !nh_deck_is(deck, node->item[i], NH_DECK_SCALAR, "name", error)) return false;
        if (kind == NH_SHAPE_KINDS) out->name = node->item[i]->text;
        else out->kind = (nh_shape_kind)kind, list = node->item[i], shapes++;
    }
    if (shapes != 1) return nh_deck_fail(deck, node, 0, error, "one shape per entry, found %zu", shapes);
    size_t numbers = kinds[out->kind].numbers;
    if (!nh_deck_is(deck, list, NH_DECK_LIST, names[out->kind], error)) return false;
    if (list->count != numbers) {
        nh_deck_fail(deck, list, 0, error, "a %s is given by %zu expressions, found %zu", names[out->kind], numbers, list->count);
        return nh_error_hint(error, "point: [x, y], arrow: [x, y, angle], disc: [x, y, radius], wheel: [x, y, angle, radius], segment: [x1, y1, x2, y2]");
    }
    for (size_t j = 0; j < numbers; j++)
        if (!nh_deck_is(deck, list->item[j], NH_DECK_SCALAR, "an expression", error) || !parse(context, list->item[j], &out->value[j])) return false;
    return true;
}
