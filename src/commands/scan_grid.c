/* scan_grid: the grid of a scan, with exact values. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands/scan_internal.h"
#include "evaluate/constant_text.h"
#include "graph/num.h"

static const size_t most_points = 10000000;

static bool unreadable(const char *text, nh_error *error)
{
    nh_fail(error, NH_USAGE, "", "--over `%s` is neither a range nor a list", text);
    return nh_error_hint(error, "write NAME=LOW:HIGH:VALUES, as in k=1:4:61, or a list, as in k=1,2,5/2");
}

/* ---- exact values ---- */

/* A decimal number or a ratio of two, as they are written; of any other expression, as 2*pi, ten digits. */
static bool read_exact(const char *text, size_t length, nh_num *out)
{
    char word[64];
    double a, b;
    if (length >= sizeof word) return false;
    memcpy(word, text, length);
    word[length] = 0;
    if (!nh_text_to_parts(word, &a, &b)) {
        if (!nh_constant_text(word, &a)) return false;
        snprintf(word, sizeof word, "%.10g", a);
        if (!nh_text_to_parts(word, &a, &b)) return false;
    }
    nh_num p = nh_num_decimal(a), q = nh_num_decimal(b);
    if (!nh_num_short(p) || !nh_num_short(q)) return false;
    *out = nh_num_mul(p, nh_num_inv(q));
    return nh_num_short(*out);
}

static nh_scan_value value_of(nh_arena *arena, nh_num x)
{
    nh_scan_value v = {.top = x.p, .bottom = x.q, .value = (double)x.p / (double)x.q};
    v.text = nh_arena_printf(arena, x.q == 1 ? "%" PRId64 : "%" PRId64 "/%" PRId64, x.p, x.q);
    return v;
}

/* LOW + (HIGH - LOW) i / (VALUES - 1) */
static bool read_range(nh_arena *arena, const char *text, nh_scan_axis *a, nh_error *error)
{
    const char *equal = strchr(text, '=') + 1, *first = strchr(equal, ':'), *second = strchr(first + 1, ':');
    nh_num low, high;
    char *end;
    long count = second ? strtol(second + 1, &end, 10) : 0;
    if (!second || *end || count < 2 || !read_exact(equal, (size_t)(first - equal), &low))
        return unreadable(text, error);
    if (!read_exact(first + 1, (size_t)(second - first - 1), &high)) return unreadable(text, error);
    if ((size_t)count > most_points) return nh_fail(error, NH_USAGE, "", "--over `%s` has too many values", text);
    nh_num step = nh_num_mul(nh_num_add(high, nh_num_mul(nh_num_ratio(-1, 1), low)), nh_num_ratio(1, count - 1));
    a->count = (size_t)count;
    a->value = nh_arena_alloc(arena, a->count * sizeof *a->value);
    a->ascending = true;
    for (size_t i = 0; i < a->count; i++) {
        nh_num x = nh_num_add(low, nh_num_mul(step, nh_num_ratio((int64_t)i, 1)));
        if (!nh_num_short(step) || !nh_num_short(x)) {
            nh_fail(error, NH_USAGE, "", "--over `%s`: the values between have too many digits to be exact", text);
            return nh_error_hint(error, "give the ends with fewer digits");
        }
        a->value[i] = value_of(arena, x);
    }
    if (a->value[0].value < a->value[1].value) return true;
    nh_fail(error, NH_USAGE, "", "--over `%s`: the first end of the range is not below the second", text);
    return nh_error_hint(error, "a single value is a list: %.*s%s", (int)(equal - text), text, a->value[0].text);
}

static bool read_list(nh_arena *arena, const char *text, nh_scan_axis *a, nh_error *error)
{
    size_t most = 1;
    const char *at = strchr(text, '=') + 1;
    for (const char *c = at; *c; c++) most += *c == ',';
    a->value = nh_arena_alloc(arena, most * sizeof *a->value);
    a->ascending = most > 1;
    for (size_t length;; at += length + 1) {
        nh_num x;
        at += strspn(at, " ");
        length = strcspn(at, ",");
        size_t word = length;
        while (word && at[word - 1] == ' ') word--;
        if (!read_exact(at, word, &x)) {
            nh_fail(error, NH_USAGE, "", "--over `%s`: `%.*s` is not a number", text, (int)word, at);
            return nh_error_hint(error, "values are decimal numbers or ratios of them, as in k=1,2,5/2");
        }
        a->value[a->count++] = value_of(arena, x);
        if (a->count > 1) a->ascending &= a->value[a->count - 1].value > a->value[a->count - 2].value;
        if (!at[length]) return true;
    }
}

/* ---- parameters ---- */

static bool is_parameter(const nh_scan *x, const char *name, nh_error *error)
{
    const nh_system *system = x->system;
    for (size_t i = 0; i < x->axes; i++)
        if (!strcmp(name, x->axis[i].name)) return nh_fail(error, NH_USAGE, "", "--over names `%s` twice", name);
    for (size_t i = 0; i < system->parameters; i++)
        if (!strcmp(system->parameter[i].name, name)) return true;
    nh_fail(error, NH_USAGE, "", "`%s` is not a parameter of %s", name, system->name);
    return nh_system_hint_parameters(system, name, error);
}

bool nh_scan_read_axis(nh_arena *arena, const char *text, nh_scan_axis *out, nh_error *error)
{
    const char *equal = strchr(text, '=');
    if (!equal || equal == text) return unreadable(text, error);
    *out = (nh_scan_axis){.name = nh_arena_strndup(arena, text, (size_t)(equal - text))};
    return (strchr(equal, ':') ? read_range : read_list)(arena, text, out, error);
}

bool nh_scan_read_grid(nh_scan *x, const nh_scan_request *q, nh_error *error)
{
    x->points = 1;
    if (q->axes > NH_SCAN_MOST_AXES)
        return nh_fail(error, NH_USAGE, "", "a scan has at most %d parameters, but --over is given %zu times",
                       NH_SCAN_MOST_AXES, q->axes);
    for (size_t i = 0; i < q->axes; i++) {
        nh_scan_axis *a = &x->axis[x->axes];
        if (!nh_scan_read_axis(x->arena, q->over[i], a, error) || !is_parameter(x, a->name, error)) return false;
        x->axes++;
        if (a->count > most_points / x->points)
            return nh_fail(error, NH_USAGE, "", "the grid has more than %zu points", most_points);
        x->points *= a->count;
    }
    return true;
}

/* ---- points ---- */

size_t nh_scan_stride(const nh_scan *x, size_t axis)
{
    size_t stride = 1;
    for (size_t i = axis + 1; i < x->axes; i++) stride *= x->axis[i].count;
    return stride;
}

size_t nh_scan_index(const nh_scan *x, size_t point, size_t axis)
{
    return point / nh_scan_stride(x, axis) % x->axis[axis].count;
}

const nh_scan_value *nh_scan_at(const nh_scan *x, size_t point, size_t axis)
{
    return &x->axis[axis].value[nh_scan_index(x, point, axis)];
}

nh_setting *nh_scan_settings(const nh_scan *x, const nh_scan_request *q, nh_arena *arena, size_t point, bool exact,
                             size_t *count)
{
    nh_setting *out = nh_arena_alloc(arena, (q->settings + x->axes) * sizeof *out);
    if (q->settings) memcpy(out, q->setting, q->settings * sizeof *out);
    for (size_t i = 0; i < x->axes; i++) {
        const nh_scan_value *v = nh_scan_at(x, point, i);
        out[q->settings + i] =
            (nh_setting){.name = x->axis[i].name, .value = v->value, .top = v->top, .bottom = exact ? v->bottom : 0};
    }
    *count = q->settings + x->axes;
    return out;
}
