#include <string.h>

#include "study/analysis_internal.h"

static const struct {
    const char *name;
    size_t numbers;
} kinds[NH_SHAPE_KINDS] = {{"point", 2}, {"arrow", 3}, {"disc", 3}, {"wheel", 4}, {"segment", 4}};

const char *nh_shape_name(nh_shape_kind kind) { return kinds[kind].name; }
size_t nh_shape_numbers(nh_shape_kind kind) { return kinds[kind].numbers; }

/* One shape: {kind: [expressions]}. */
static bool read_shape(nh_analysis_reader *r, const nh_deck_node *node, nh_shape *out)
{
    const nh_deck *deck = r->a->deck;
    const char *names[NH_SHAPE_KINDS];
    for (int k = 0; k < NH_SHAPE_KINDS; k++) names[k] = kinds[k].name;
    if (!nh_deck_is(deck, node, NH_DECK_MAP, "a shape {point: [x, y]}", r->error)) return false;
    if (!nh_deck_only(deck, node, names, NH_SHAPE_KINDS, r->error)) return false;
    if (node->count != 1) return nh_deck_fail(deck, node, 0, r->error, "one shape per entry, found %zu", node->count);
    const nh_deck_node *list = node->item[0];
    while (strcmp(node->key[0]->text, names[out->kind])) out->kind++;
    size_t numbers = kinds[out->kind].numbers;
    if (!nh_deck_is(deck, list, NH_DECK_LIST, names[out->kind], r->error)) return false;
    if (list->count != numbers) {
        nh_deck_fail(deck, list, 0, r->error, "a %s is given by %zu expressions, found %zu", names[out->kind], numbers, list->count);
        return nh_error_hint(r->error, "point: [x, y], arrow: [x, y, angle], disc: [x, y, radius], wheel: [x, y, angle, radius], segment: [x1, y1, x2, y2]");
    }
    for (size_t j = 0; j < numbers; j++)
        if (!nh_deck_is(deck, list->item[j], NH_DECK_SCALAR, "an expression", r->error) || !nh_analysis_parse(r, list->item[j], &out->value[j])) return false;
    return true;
}

bool nh_analysis_read_drawing(nh_analysis_reader *r, const nh_deck_node *list)
{
    nh_analysis *a = r->a;
    a->shapes = 0;
    if (!list) return true;
    if (!nh_deck_is(a->deck, list, NH_DECK_LIST, "draw", r->error)) return false;
    a->shape = nh_analysis_take(r, list->count, sizeof *a->shape);
    for (size_t i = 0; i < list->count; i++)
        if (!read_shape(r, list->item[i], &a->shape[i])) return false;
    a->shapes = list->count;
    return true;
}
