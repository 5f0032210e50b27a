/* numbers: what a report shows against the JSON of the same run. */
#ifndef NH_TESTS_NUMBERS_H
#define NH_TESTS_NUMBERS_H

#include <cjson/cJSON.h>
#include <criterion/criterion.h>
#include <math.h>
#include <stdlib.h>

/* All numbers of a JSON, sorted. */
typedef struct {
    size_t count, capacity;
    double *value;
} all_numbers;

static inline int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static inline void numbers_gather(const cJSON *item, all_numbers *n)
{
    if (cJSON_IsNumber(item)) {
        if (n->count == n->capacity) n->value = realloc(n->value, (n->capacity = 2 * n->capacity + 1000) * sizeof *n->value);
        n->value[n->count++] = item->valuedouble;
    }
    for (const cJSON *child = item->child; child; child = child->next) numbers_gather(child, n);
}

static inline all_numbers numbers_of_json(const cJSON *json)
{
    all_numbers n = {0};
    numbers_gather(json, &n);
    if (n.count) qsort(n.value, n.count, sizeof *n.value, by_value);
    return n;
}

/* What is shown is the value, rounded, and the JSON has the value to the last digit. */
static inline void expect_number(const all_numbers *n, double value, double shown, double nearness, const char *line)
{
    cr_expect(n->count && bsearch(&value, n->value, n->count, sizeof value, by_value), "%s: the report has %.17g, the JSON has not", line, value);
    cr_expect_float_eq(shown, value, nearness * fabs(value), "%s: %.17g is shown as %g", line, value, shown);
}

#endif
