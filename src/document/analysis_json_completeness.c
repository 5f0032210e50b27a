/* The count of the integrals as JSON: "completeness", for the coordinates alone or, for a system that depends on time,
 * with time; "in_time" is a member of the former. */
#include <stdio.h>

#include "document/analysis_json_internal.h"

static void put_new(nh_json *to, const nh_completeness *c)
{
    nh_json *fresh = nh_json_put_object(to, "new");
    char degree[16];
    for (size_t d = 0; d < c->count.rows; d++) {
        const nh_count_row *row = &c->count.row[d];
        snprintf(degree, sizeof degree, "%zu", row->degree);
        if (row->complete && row->bound > row->lower)
            nh_json_put_number(fresh, degree, (double)(row->bound - row->lower));
    }
}

static void put_degrees(nh_json *to, const nh_completeness *c)
{
    nh_json *list = nh_json_put_array(to, "degrees");
    for (size_t d = 0; d < c->count.rows; d++) {
        const nh_count_row *row = &c->count.row[d];
        nh_json *item = nh_json_add_object(list);
        nh_json_put_number(item, "degree", (double)row->degree);
        nh_json_put_number(item, "dimension", (double)row->bound);
        nh_json_put_number(item, "found", (double)row->known);
        nh_json_put_number(item, "rank", (double)row->rank);
        nh_json_put_number(item, "found_rank", (double)row->known_rank);
        nh_json_put_number(item, "order", (double)row->order);
        nh_json_put_bool(item, "stable", row->settled);
    }
}

static nh_json *put_count(nh_json *to, const char *key, const nh_completeness *c)
{
    if (!c->counted) {
        nh_json_put_null(to, key);
        return NULL;
    }
    nh_json *item = nh_json_put_object(to, key);
    const nh_count_row *row = c->count.rows ? &c->count.row[c->degree ? c->degree - 1 : 0] : NULL;
    nh_json_put_number(item, "degree", (double)c->degree);
    nh_json_put_text(item, "coefficients", c->count.time ? "t and coordinates" : "all coordinates");
    nh_json_put_text(item, "obstacle", c->count.obstacle);
    if (row) nh_json_put_number(item, "dimension", (double)row->bound);
    else nh_json_put_null(item, "dimension");
    if (row) nh_json_put_number(item, "found", (double)row->known);
    else nh_json_put_null(item, "found");
    put_new(item, c);
    if (row) nh_json_put_number(item, "order", (double)row->order);
    else nh_json_put_null(item, "order");
    nh_json_put_bool(item, "stable", row && (row->settled || row->complete));
    nh_json_put_number(item, "prime", (double)c->count.prime);
    nh_json_put_text(item, "of",
                     !c->degree  ? NULL
                     : c->linear ? "polynomials in the currents"
                                 : "functions of the currents");
    nh_json_put_text(item, "where", c->count.where);
    nh_json_put_bool(item, "regional", c->regional);
    nh_json_put_text(item, "proved",
                     !c->degree || !c->linear ? NULL
                     : c->generic             ? "for generic parameters"
                                              : "for these values");
    nh_json_put_number(item, "step", (double)c->count.step);
    nh_json_put_number(item, "leaf", (double)c->count.leaf);
    nh_json *without = nh_json_put_array(item, "without");
    for (size_t i = 0; i < c->count.without; i++) nh_json_add_text(without, c->count.without_name[i]);
    if (c->missing_at) nh_json_put_number(item, "missing_at", (double)c->missing_at);
    else nh_json_put_null(item, "missing_at");
    nh_json_put_number(item, "missing", (double)c->missing);
    nh_json_put_bool(item, "missing_settled", !c->missing_at || c->settled);
    put_degrees(item, c);
    return item;
}

void nh_analysis_json_completeness(const nh_analysis *r, nh_json *to)
{
    const nh_completeness *c = r->completeness;
    bool timely = !c[NH_COMPLETE_IN_COORDINATES].counted;
    nh_json *item = put_count(to, "completeness", &c[timely ? NH_COMPLETE_IN_TIME : NH_COMPLETE_IN_COORDINATES]);
    if (item && timely) nh_json_put_null(item, "in_time");
    else if (item) put_count(item, "in_time", &c[NH_COMPLETE_IN_TIME]);
}
