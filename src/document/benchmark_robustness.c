/* Where methods fail, as maps, in the document of a benchmark. */
#include <stdio.h>

#include "document/benchmark.h"
#include "document/benchmark_internal.h"

/* A table: the first quantity downwards, across it the methods, or for one method the second quantity. */
static void map_of(nh_pen *p, const nh_robustness_map *map, size_t first, size_t step, size_t across,
                   const char *caption, const char *corner)
{
    const nh_robustness_cell *cell = map->cell + first;
    nh_text heads;
    nh_text_init(&heads);
    nh_text_add(&heads, corner);
    for (size_t j = 0; j < across; j++) {
        if (map->second_axis) nh_text_addf(&heads, "|%.4g", cell[j * step].second_at);
        else nh_text_addf(&heads, "|%s", cell[j].method);
    }
    nh_pen_table(p, caption, nh_text_string(&heads));
    nh_text_clear(&heads);
    for (size_t j = 0; j * step < map->cells; j++) {
        const nh_robustness_cell *at = &cell[j * step];
        if (j % across == 0) {
            if (j) nh_pen_close(p, NH_PEN_ROW);
            nh_pen_open(p, NH_PEN_ROW, NULL, NULL);
            nh_pen_open(p, NH_PEN_ROW_HEAD, NULL, NULL);
            nh_pen_say(p, "%.4g", at->at);
            nh_pen_close(p, NH_PEN_ROW_HEAD);
        }
        nh_pen_open(p, NH_PEN_KIND, nh_run_record_status_name(at->status), at->note);
        nh_pen_say(p, "%s", nh_run_record_status_name(at->status));
        nh_pen_close(p, NH_PEN_KIND);
    }
    if (map->cells) nh_pen_close(p, NH_PEN_ROW);
    nh_pen_table_end(p);
}

static void map_table(nh_pen *p, const nh_robustness_map *map)
{
    char caption[300], corner[200];
    size_t values = map->cells / map->methods, across = 1;
    if (!map->second_axis) {
        map_of(p, map, 0, 1, map->methods, map->name, map->axis);
        return;
    }
    while (across < values && map->cell[across * map->methods].at == map->cell[0].at) across++;
    snprintf(corner, sizeof corner, "%.90s \u2193  %.90s \u2192", map->axis, map->second_axis);
    for (size_t j = 0; j < map->methods; j++) {
        snprintf(caption, sizeof caption, "%.200s: %.80s", map->name, map->cell[j].method);
        map_of(p, map, j, map->methods, across, caption, corner);
    }
}

/* The notes of cells, which a terminal's table does not show. */
static void put_notes(nh_pen *p, const nh_robustness_map *map)
{
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    for (size_t i = 0; i < map->cells; i++) {
        const nh_robustness_cell *at = &map->cell[i];
        if (!at->note || !at->note[0]) continue;
        nh_pen_fact_begin(p, at->method);
        nh_pen_say(p, "at %.4g", at->at);
        if (map->second_axis) nh_pen_say(p, ", %.4g", at->second_at);
        nh_pen_say(p, " %s: %s", nh_run_record_status_name(at->status), at->note);
        nh_pen_close(p, NH_PEN_FACT);
    }
    nh_pen_close(p, NH_PEN_FACTS);
}

void nh_benchmark_write_robustness(nh_pen *p, const nh_robustness *s)
{
    if (!s) return;
    nh_pen_section(p, "robustness", "Where methods fail");
    nh_pen_words(p,
                 "At tolerance %.1g; an error below %.1g is accurate. Flagged: accurate, and a safeguard triggered; "
                 "detected: not accurate, and a safeguard says so; "
                 "failed: ended early, with a reason; timeout; undetected: not accurate, and no safeguard triggered.",
                 s->tolerance, s->accuracy);
    for (size_t i = 0; i < s->maps; i++) {
        map_table(p, &s->map[i]);
        if (p->ink->brief) put_notes(p, &s->map[i]);
    }
    if (!p->ink->brief) return; /* on a page each cell has its colour */
    nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
    nh_pen_say(p, "In all:");
    for (int k = 0; k <= NH_UNDETECTED; k++)
        nh_pen_say(p, "%s %zu %s", k ? "," : "", s->count[k], nh_run_record_status_name((nh_run_record_status)k));
    nh_pen_close(p, NH_PEN_WORDS);
}
