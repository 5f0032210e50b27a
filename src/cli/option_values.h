/* option_values: what each option of the command line asks for. */
#ifndef NH_OPTION_VALUES_H
#define NH_OPTION_VALUES_H

#include "cli/cli.h"

enum {
    opt_set = 256,
    opt_analysis,
    opt_no_analysis,
    opt_route,
    opt_velocities,
    opt_json,
    opt_fragment,
    opt_current,
    opt_field,
    opt_initial,
    opt_at,
    opt_project,
    opt_method,
    opt_initial_table,
    opt_step,
    opt_watch,
    opt_scene,
    opt_budget,
    opt_svg,
    opt_pdf,
    opt_csv,
    opt_group,
    opt_chain,
    opt_inner,
    opt_weak,
    opt_to,
    opt_tolerance,
    opt_until,
    opt_seed,
    opt_samples,
    opt_grid,
    opt_columns,
    opt_degree,
    opt_threads,
    opt_max_seconds,
    opt_max_memory,
    opt_option,
    opt_progress,
    opt_no_color,
    opt_version,
    opt_accuracy,
    opt_ensemble,
    opt_spread,
    opt_robustness,
    opt_fit,
    opt_over,
    opt_shape,
    opt_equations,
    opt_absence,
    opt_of,
    opt_number,
    opt_workers,
    opt_chunk,
    opt_input,
    opt_name,
    opt_like,
    opt_wheel,
    opt_base,
    opt_on,
    opt_event,
    opt_section,
    opt_axes,
#define X(name, form, writer) opt_##name,
    NH_PEN_FORM_TABLE(X)
#undef X
};

/* Reads the value of an option, which is NULL where it takes none, into `cli`; `name` is its long name.  NH_USAGE: the
 * value is not what the option takes. */
bool nh_option_value_take(nh_cli *cli, int code, const char *name, const char *value, nh_error *error);

/* "-" is standard input. */
const char *nh_option_value_file(const char *word);

#endif
