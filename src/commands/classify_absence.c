/* From a range of one parameter to the values at which another integral is found, excluded, or neither. */
#include "commands/classify_absence.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/progress.h"
#include "graph/num.h"

enum { usual_values = 32, most_values = 10000, usual_height = 4, farthest = 1000000, longest_number = 64 };

/* ---- the values ---- */

typedef struct {
    nh_num low, high;
    long most;
} range;

static bool unreadable(const char *text, nh_error *error)
{
    nh_fail(error, NH_USAGE, "", "--over `%s` is neither a range nor a list of values of one parameter", text);
    return nh_error_hint(error, "write NAME=LOW:HIGH, as in mu=1/2:5, or a list, as in mu=1,3/2,8/3");
}

/* A decimal number or a ratio of two, as they are written. */
static bool read_number(const char *text, size_t length, nh_num *out)
{
    char word[longest_number];
    double top, bottom;
    while (length && *text == ' ') text++, length--;
    while (length && text[length - 1] == ' ') length--;
    if (!length || length >= sizeof word) return false;
    memcpy(word, text, length);
    word[length] = 0;
    if (!nh_text_to_parts(word, &top, &bottom)) return false;
    nh_num p = nh_num_decimal(top), q = nh_num_decimal(bottom);
    if (!nh_num_short(p) || !nh_num_short(q)) return false;
    *out = nh_num_mul(p, nh_num_inv(q));
    return nh_num_short(*out) && fabs(nh_num_value(*out)) <= farthest && out->q <= farthest;
}

/* Inserts a value where the order wants it, unless it is there. */
static nh_classified_value *insert(nh_classified_absence *x, nh_num v)
{
    size_t at = 0;
    while (at < x->values && x->value[at].top * v.q < v.p * x->value[at].bottom) at++;
    if (at < x->values && x->value[at].top == v.p && x->value[at].bottom == v.q) return &x->value[at];
    nh_grow(&x->value, &x->capacity, x->values + 1, sizeof *x->value);
    memmove(x->value + at + 1, x->value + at, (x->values - at) * sizeof *x->value);
    x->values++;
    const char *form = v.q == 1 ? "%" PRId64 : "%" PRId64 "/%" PRId64;
    x->value[at] = (nh_classified_value){.top = v.p, .bottom = v.q, .text = nh_arena_printf(x->arena, form, v.p, v.q)};
    return &x->value[at];
}

static bool within(const range *r, nh_num v)
{
    return v.p * r->low.q >= r->low.p * v.q && v.p * r->high.q <= r->high.p * v.q;
}

/* Calls `insert` for the fractions with this denominator, in lowest terms, or counts them where x is NULL. */
static long fractions(nh_classified_absence *x, const range *r, int64_t denominator)
{
    long count = 0;
    int64_t first = (int64_t)floor(nh_num_value(r->low) * (double)denominator) - 1,
            last = (int64_t)ceil(nh_num_value(r->high) * (double)denominator) + 1;
    for (int64_t p = first; p <= last && count <= r->most; p++) {
        nh_num v = {.p = p, .q = denominator};
        if (nh_gcd(p, denominator) != 1 || !within(r, v)) continue;
        count++;
        if (x) insert(x, v);
    }
    return count;
}

/* All fractions with denominators up to the largest for which there are no more than so many. */
static bool read_range(nh_classified_absence *x, const char *text, range *r, nh_error *error)
{
    const char *equal = strchr(text, '=') + 1, *first = strchr(equal, ':'), *second = strchr(first + 1, ':');
    size_t length = second ? (size_t)(second - first - 1) : strlen(first + 1);
    char *end = "";
    r->most = second ? strtol(second + 1, &end, 10) : usual_values;
    if (*end || r->most < 1 || r->most > most_values || !read_number(equal, (size_t)(first - equal), &r->low) ||
        !read_number(first + 1, length, &r->high))
        return unreadable(text, error);
    if (nh_num_value(r->low) >= nh_num_value(r->high))
        return nh_fail(error, NH_USAGE, "", "--over `%s`: the first end of the range is not below the second", text);
    int64_t denominator = 0;
    for (long all = 0; denominator <= r->most; denominator++) {
        all += fractions(NULL, r, denominator + 1);
        if (all > r->most) break;
    }
    for (int64_t q = 1; q <= denominator; q++) fractions(x, r, q);
    x->range = nh_arena_printf(x->arena, "from %.*s to %.*s, fractions with denominators up to %" PRId64,
                               (int)(first - equal), equal, (int)length, first + 1, denominator);
    if (x->values) return true;
    nh_fail(error, NH_USAGE, "", "--over `%s`: there are more whole numbers than %ld", text, r->most);
    return nh_error_hint(error, "write more as the third number: %s:1000", text);
}

static bool read_list(nh_classified_absence *x, const char *text, range *r, nh_error *error)
{
    x->range = "in the list, and special values between";
    for (const char *at = strchr(text, '=') + 1;; at++) {
        size_t length = strcspn(at, ",");
        nh_num v;
        if (!read_number(at, length, &v)) return unreadable(text, error);
        insert(x, v);
        at += length;
        if (!*at) break;
    }
    r->low = (nh_num){.p = x->value[0].top, .q = x->value[0].bottom};
    r->high = (nh_num){.p = x->value[x->values - 1].top, .q = x->value[x->values - 1].bottom};
    return true;
}

/* Without a range: fractions with terms up to 4. */
static void usual(nh_classified_absence *x)
{
    x->range = nh_arena_printf(x->arena, "among fractions with terms up to %d", usual_height);
    for (int64_t q = 1; q <= usual_height; q++)
        for (int64_t p = -usual_height; p <= usual_height; p++)
            if (nh_gcd(p, q) == 1) insert(x, (nh_num){.p = p, .q = q});
}

static bool read_values(nh_classified_absence *x, const char *text, range *r, nh_error *error)
{
    const char *equal = strchr(text, '=');
    size_t length = equal ? (size_t)(equal - text) : strlen(text);
    *r = (range){.low = {.p = -farthest, .q = 1}, .high = {.p = farthest, .q = 1}};
    while (length && text[length - 1] == ' ') length--;
    if (!length || (!equal && strchr(text, ','))) return unreadable(text, error);
    x->over = nh_arena_strndup(x->arena, text, length);
    if (!equal) return usual(x), true;
    return strchr(equal, ':') ? read_range(x, text, r, error) : read_list(x, text, r, error);
}

static bool is_parameter(const nh_classified_absence *x, nh_error *error)
{
    for (size_t i = 0; i < x->system->parameters; i++)
        if (!strcmp(x->system->parameter[i].name, x->over)) return true;
    nh_fail(error, NH_USAGE, "", "`%s` is not a parameter of %s", x->over, x->system->name);
    return nh_system_hint_parameters(x->system, x->over, error);
}

/* ---- special values ---- */

/* Those that the search for integrals polynomial in the velocities finds, where they are rational and in the range. */
static void add_special(nh_classified_absence *x, const nh_classify_request *q, const range *r)
{
    nh_error error;
    nh_error_clear(&error);
    nh_classify_request request = *q;
    request.of = NH_OF_CURRENTS;
    memset(request.over, 0, sizeof request.over);
    request.over[0] = x->over;
    x->special = nh_classify_system(&request, &error);
    if (!x->special) {
        x->no_special = nh_arena_strdup(x->arena, error.what);
        return;
    }
    const nh_classification *c = x->special->classification;
    for (size_t k = 0; k < c->specials; k++) {
        nh_num v = {0};
        if (!c->special[k].first || !nh_special_rational(&c->special[k].polynomial, &v.p, &v.q)) continue;
        if (llabs(v.p) <= farthest && v.q <= farthest && within(r, v)) insert(x, v)->special = true;
    }
}

/* ---- decisions ---- */

static nh_analysis *decide(const nh_classified_absence *x, const nh_classify_request *q, const nh_classified_value *v,
                           bool exact, nh_error *error)
{
    nh_setting *setting = nh_alloc_array(q->settings + 1, sizeof *setting);
    size_t all = 0;
    for (size_t k = 0; k < q->settings; k++)
        if (strcmp(q->setting[k].name, x->over)) setting[all++] = q->setting[k];
    setting[all++] = (nh_setting){.name = x->over,
                                  .value = (double)v->top / (double)v->bottom,
                                  .top = exact ? v->top : 0,
                                  .bottom = exact ? v->bottom : 0};
    nh_request request = {.line = q->command,
                          .system_path = q->system_path,
                          .settings = all,
                          .setting = setting,
                          .options = q->options,
                          .absence = true};
    nh_analysis *result = nh_analysis_create(&request, error);
    if (result && !result->absence) nh_absence_find(result, true);
    nh_free(setting);
    return result;
}

/* At most so many independent integrals; SIZE_MAX: nothing is known. */
static size_t bound_of(const nh_absence *a)
{
    switch (a->verdict) {
    case NH_ABSENCE_NONE_ELSE:
    case NH_ABSENCE_DEPENDENT: return a->known;
    case NH_ABSENCE_AT_MOST: return a->at_most;
    default: return SIZE_MAX;
    }
}

static void decide_value(nh_classified_absence *x, const nh_classify_request *q, nh_classified_value *v)
{
    nh_error error;
    nh_error_clear(&error);
    v->side = NH_CLASSIFIED_UNDECIDED;
    v->why = "the run was ended";
    if (nh_interrupted()) return;
    v->result = decide(x, q, v, true, &error);
    v->why = v->result ? v->result->absence->obstacle : nh_arena_strdup(x->arena, error.what);
}

/* What was found at each value is compared with the fewest. */
static void choose_sides(nh_classified_absence *x)
{
    x->fewest = SIZE_MAX;
    for (size_t k = 0; k < x->values; k++)
        if (x->value[k].result && x->value[k].result->absence->known < x->fewest)
            x->fewest = x->value[k].result->absence->known;
    for (size_t k = 0; k < x->values; k++) {
        nh_classified_value *v = &x->value[k];
        if (!v->result) continue;
        if (v->result->absence->known > x->fewest) v->side = NH_CLASSIFIED_FOUND;
        else if (bound_of(v->result->absence) <= x->fewest) v->side = NH_CLASSIFIED_EXCLUDED;
    }
}

/* By a logarithm of higher order, which often exists at single values only. */
static bool by_logarithm(const nh_classified_value *v)
{
    const nh_absence *a = v->result->absence;
    const nh_higher *higher = a->best < a->attempts ? a->attempt[a->best].higher : NULL;
    return higher && higher->refuted;
}

/* With the parameter as a letter, at the first value where others are excluded, if possible at first order: so too for
 * all values but countably many? */
static void decide_for_almost_all(nh_classified_absence *x, const nh_classify_request *q)
{
    for (size_t i = 0; i < 2 * x->values && !x->letter && !nh_interrupted(); i++) {
        size_t k = i % x->values;
        nh_error none;
        nh_error_clear(&none);
        if (x->value[k].side != NH_CLASSIFIED_EXCLUDED || x->value[k].result->absence->rational) continue;
        if (by_logarithm(&x->value[k]) != (i >= x->values)) continue;
        x->letter = decide(x, q, &x->value[k], false, &none);
        if (!x->letter) return;
        const nh_absence *a = x->letter->absence;
        x->generic = a->generic && !a->rational && bound_of(a) <= x->fewest;
        x->generic_at = x->generic ? x->value[k].text : NULL;
    }
}

nh_classified_absence *nh_classify_absence(const nh_classify_request *q, const char *text, nh_error *error)
{
    nh_arena *arena = nh_arena_create();
    nh_classified_absence *x = nh_arena_alloc(arena, sizeof *x);
    range r;
    *x = (nh_classified_absence){.arena = arena};
    x->system = nh_system_read(q->system_path, q->settings, q->setting, error);
    if (!x->system || !read_values(x, text, &r, error) || !is_parameter(x, error)) {
        nh_classified_absence_free(x);
        return NULL;
    }
    add_special(x, q, &r);
    for (size_t k = 0; k < x->values; k++) decide_value(x, q, &x->value[k]);
    choose_sides(x);
    decide_for_almost_all(x, q);
    x->partial = nh_interrupted() || (x->special && x->special->partial);
    return x;
}

size_t nh_classified_absence_count(const nh_classified_absence *x, nh_classified_side side)
{
    size_t count = 0;
    for (size_t k = 0; k < x->values; k++) count += x->value[k].side == side;
    return count;
}

void nh_classified_absence_free(nh_classified_absence *x)
{
    if (!x) return;
    for (size_t k = 0; k < x->values; k++) nh_analysis_free(x->value[k].result);
    nh_free(x->value);
    nh_analysis_free(x->letter);
    nh_classified_free(x->special);
    nh_system_free(x->system);
    nh_arena_free(x->arena);
}
