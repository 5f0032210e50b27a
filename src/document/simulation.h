/* simulation: a simulation as CSV, as JSON (schema version 1, docs/formats.md), as a page and as LaTeX. */
#ifndef NH_MOTION_REPORT_H
#define NH_MOTION_REPORT_H

#include "base/json.h"
#include "base/text.h"
#include "document/pen.h"
#include "commands/simulate.h"

/* as CSV: a line of names, then a row per output time */
void nh_motion_csv(const nh_simulation *simulation, nh_text *out);
/* A heap string (nh_free) that ends in a newline; `run` may be NULL. */
char *nh_motion_json(const nh_simulation *simulation, const nh_run *run);

void nh_simulation_write(const nh_simulation *simulation, const nh_run *run, nh_pen_style style, nh_text *out);

/* For the top of a page; NULL where there are less than two times.  nh_stage_free. */
nh_stage *nh_simulation_stage(const nh_simulation *simulation, const nh_run *run);

/* The member `accuracy` of a motion; null when a is NULL. */
void nh_accuracy_json(const nh_accuracy *a, nh_json *root);

/* The picture: the section; or the columns of --axes; or the observables or coordinates over time, and for an ensemble
 * one quantity of all members. */
void nh_motion_svg(const nh_simulation *simulation, nh_text *out);

/* Events of --event as a table: event, direction, t and the columns of the motion; points of --section: t and these
   columns. */
void nh_events_csv(const nh_simulation *simulation, nh_text *out);
void nh_section_csv(const nh_simulation *simulation, nh_text *out);
/* "rising", "falling" or "both"; the same before a noun, where "both" is left out; and the number of zeros of
 * expression number `which`. */
const char *nh_direction_word(int direction);
const char *nh_direction_before(int direction);
size_t nh_events_of(const nh_simulation *simulation, size_t which);
/* Events and section on a page. */
void nh_events_write(nh_pen *pen, const nh_simulation *simulation);

/* One or several motions in a picture of two of their columns: curves, or the points of their sections.  `name`: of the
 * motion in the legend, or NULL.  A picture begins as zeros. */
typedef struct {
    size_t members;
    nh_curve *curve;
    bool named, timed, equal;
    char title[300], x_label[100], y_label[100];
} nh_motion_plot;
void nh_motion_plot_add(nh_motion_plot *plot, const nh_simulation *simulation, const char *name);
nh_plot nh_motion_plot_of(const nh_motion_plot *plot);
void nh_motion_plot_clear(nh_motion_plot *plot);

/* The same for an ensemble: with a column `member` in front; as a list of objects. */
void nh_ensemble_csv(const nh_simulation *simulation, nh_text *out);
char *nh_ensemble_json(const nh_simulation *simulation, const nh_run *run);

/* For motions of a table that are computed one by one: adds rows, with columns for the member and its parameters; or
 * adds entries to `motions` of an object, to which the first motion adds the common members. */
void nh_member_csv(const nh_simulation *simulation, size_t member, const nh_simulate_row *row, nh_text *out);
void nh_member_json(const nh_simulation *simulation, const nh_simulate_row *row, const nh_run *run, nh_json *root);

#endif
