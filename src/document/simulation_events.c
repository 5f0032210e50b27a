/* simulation_events: the events and the section of a motion, for a page. */
#include <stdio.h>

#include "document/simulation.h"

enum { most_rows = 40, most_columns = 8 };

const char *nh_direction_word(int direction) { return direction > 0 ? "rising" : direction < 0 ? "falling" : "both"; }

const char *nh_direction_before(int direction) { return direction > 0 ? "rising " : direction < 0 ? "falling " : ""; }

size_t nh_events_of(const nh_simulation *s, size_t which)
{
    size_t n = 0;
    for (size_t i = 0; s->motion && i < s->motion->events; i++) n += s->motion->event[i].which == which;
    return n;
}

/* ---- the page ---- */

/* "y = 0, falling: 12 times" and its first rows, with as many columns as are easy to read. */
static void table(nh_pen *p, const nh_simulation *s, size_t which)
{
    const nh_simulated_event *event = &s->event[which];
    size_t count = nh_events_of(s, which), columns = 0, rows = 0;
    nh_text heads;
    char caption[300];
    nh_text_init(&heads);
    nh_text_add(&heads, "t|direction");
    for (; columns < s->columns.count && columns < most_columns && s->columns.track[columns].kind != NH_TRACK_SHAPE;
         columns++)
        nh_text_addf(&heads, "|%s", s->columns.track[columns].name);
    snprintf(caption, sizeof caption, "%.150s, %s%s: %zu%s", event->name, nh_direction_word(event->event.direction),
             event->event.stop ? ", ends the motion"
             : event->section  ? ", the section"
                               : "",
             count, count > most_rows ? "; the first of them" : "");
    nh_pen_table(p, caption, nh_text_string(&heads));
    nh_text_clear(&heads);
    for (size_t i = 0; i < s->motion->events && rows < most_rows; i++) {
        const nh_event_found *found = &s->motion->event[i];
        if (found->which != which) continue;
        nh_pen_open(p, NH_PEN_ROW, NULL, NULL);
        nh_pen_cell(p, NH_PEN_ROW_HEAD, "%.10g", found->time);
        nh_pen_cell(p, NH_PEN_CELL, "%s", nh_direction_word(found->direction));
        for (size_t k = 0; k < columns; k++)
            nh_pen_cell(p, NH_PEN_CELL, "%.6g", s->trajectory->event_value[i * s->columns.count + k]);
        nh_pen_close(p, NH_PEN_ROW);
        rows++;
    }
    nh_pen_table_end(p);
}

void nh_events_write(nh_pen *p, const nh_simulation *s)
{
    if (!s->events) return;
    nh_pen_section(p, "events", s->has_section ? "Section" : "Events");
    if (s->has_section && nh_events_of(s, s->events - 1)) {
        nh_motion_plot plot = {0};
        nh_motion_plot_add(&plot, s, NULL);
        nh_plot picture = nh_motion_plot_of(&plot);
        nh_pen_plot(p, &picture, plot.title);
        nh_motion_plot_clear(&plot);
    }
    for (size_t i = 0; i < s->events; i++) {
        if (nh_events_of(s, i)) table(p, s, i);
        else
            nh_pen_words(p, "%s has no %szero along this motion.", s->event[i].name,
                         nh_direction_before(s->event[i].event.direction));
    }
}
