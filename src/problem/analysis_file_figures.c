/* analysis_file_figures: the figures of an analysis file, and their motions (docs/formats.md). */
#include <string.h>

#include "graph/node.h"
#include "problem/analysis_file_internal.h"

typedef nh_analysis_file_reader reader;

/* path: [x, y] or [x, y, heading]; residual: [x, y] */
static bool read_path(reader *r, const nh_deck_node *list, size_t most, nh_figure_request *f)
{
    static const char *const names[] = {"x", "y", "heading"};
    const nh_deck *deck = r->a->deck;
    const char *expected = most == 2 ? "two axes [x, y]" : "a path [x, y] or [x, y, heading]";
    if (!nh_deck_is(deck, list, NH_DECK_LIST, expected, r->error)) return false;
    if (list->count < 2 || list->count > most)
        return nh_deck_fail(deck, list, 0, r->error, "expected %s, found %zu expression%s", expected, list->count,
                            list->count == 1 ? "" : "s");
    f->quantity = nh_analysis_file_take(r, list->count, sizeof *f->quantity);
    for (size_t i = 0; i < list->count; i++) {
        if (!nh_analysis_file_parse(r, list->item[i], &f->quantity[i].value)) return false;
        f->quantity[i].name = i < 2 ? list->item[i]->text : names[i];
    }
    f->quantities = list->count;
    return true;
}

static bool read_scan(reader *r, const nh_deck_node *node, nh_figure_request *f)
{
    const nh_analysis_file *a = r->a;
    if (!nh_deck_is(a->deck, node, NH_DECK_SCALAR, "the name of an unknown", r->error)) return false;
    for (f->unknown = 0; f->unknown < a->unknowns; f->unknown++)
        if (!strcmp(node->text, nh_name_of(r->model->dag, a->unknown[f->unknown].symbol))) break;
    if (f->unknown == a->unknowns) {
        nh_deck_fail(a->deck, node, 0, r->error, "`%s` is not an unknown of this analysis", node->text);
        return nh_error_hint(r->error, "to declare it, write unknowns: {%s: [low, high]}, and use it in the ansatz",
                             node->text);
    }
    return a->unknowns == 1 || nh_deck_fail(a->deck, node, 0, r->error,
                                            "a scan needs an analysis with one unknown, this one has %zu", a->unknowns);
}

/* samples: [20, 40, 80] */
static bool read_samples(reader *r, const nh_deck_node *list, nh_figure_request *f)
{
    const nh_deck *deck = r->a->deck;
    if (!nh_deck_is(deck, list, NH_DECK_LIST, "a list of numbers of samples", r->error)) return false;
    f->value = nh_analysis_file_take(r, list->count, sizeof *f->value);
    for (size_t i = 0; i < list->count; i++) {
        if (!nh_deck_number(deck, list->item[i], "a number of samples", &f->value[i], r->error)) return false;
        if (!(f->value[i] >= 2 && f->value[i] <= 1e6 && f->value[i] == (double)(size_t)f->value[i]))
            return nh_deck_fail(deck, list->item[i], 0, r->error, "a number of samples is whole, from 2 to a million");
    }
    f->values = list->count;
    return f->values || nh_deck_fail(deck, list, 0, r->error, "there are no numbers of samples");
}

/* vary: {k: [1, 2, 3]} */
static bool read_vary(reader *r, const nh_deck_node *map, nh_figure_request *f)
{
    const nh_deck *deck = r->a->deck;
    const nh_system *system = r->model->system;
    bool known = false;
    if (!map) return true;
    if (!nh_deck_is(deck, map, NH_DECK_MAP, "vary {parameter: [values]}", r->error)) return false;
    if (map->count != 1)
        return nh_deck_fail(deck, map, 0, r->error, "one parameter can be varied in a figure, found %zu", map->count);
    f->vary = map->key[0]->text;
    for (size_t i = 0; i < system->parameters; i++) known |= !strcmp(f->vary, system->parameter[i].name);
    if (!known) {
        nh_deck_fail(deck, map->key[0], 0, r->error, "`%s` is not a parameter of %s", f->vary, system->name);
        return system->parameters
                   ? nh_error_hint(r->error, "vary: {%s: [1, 2]} repeats the motion for two values of a parameter",
                                   system->parameter[0].name)
                   : false;
    }
    const nh_deck_node *list = map->item[0];
    if (!nh_deck_is(deck, list, NH_DECK_LIST, "a list of values", r->error)) return false;
    f->value = nh_analysis_file_take(r, list->count, sizeof *f->value);
    for (size_t i = 0; i < list->count; i++)
        if (!nh_deck_number(deck, list->item[i], "the value of a parameter", &f->value[i], r->error)) return false;
    f->values = list->count;
    return f->values || nh_deck_fail(deck, list, 0, r->error, "there are no values of `%s`", f->vary);
}

static bool read_figure(reader *r, const nh_deck_node *node, nh_figure_request *f)
{
    static const char *const keys[] = {"title", "path", "plot", "scan", "samples", "residual", "of", "vary", "time"};
    const nh_deck *deck = r->a->deck;
    if (!nh_deck_is(deck, node, NH_DECK_MAP,
                    "a figure {path: [x, y]}, {plot: [name = expression]}, {scan: unknown}, {samples: [numbers]} or "
                    "{residual: [x, y]}",
                    r->error))
        return false;
    if (!nh_deck_only(deck, node, keys, sizeof keys / sizeof *keys, r->error)) return false;
    const nh_deck_node *title = nh_deck_get(node, "title"), *path = nh_deck_get(node, "path"),
                       *plot = nh_deck_get(node, "plot"), *scan = nh_deck_get(node, "scan"),
                       *samples = nh_deck_get(node, "samples"), *residual = nh_deck_get(node, "residual"),
                       *of = nh_deck_get(node, "of"), *time = nh_deck_get(node, "time");
    if (!path + !plot + !scan + !samples + !residual != 4) {
        nh_deck_fail(deck, node, 0, r->error, "a figure has one of `path`, `plot`, `scan`, `samples` and `residual`");
        return nh_error_hint(r->error, "path: [x, y, heading], plot: [name = expression, ...], scan: nu, "
                                       "samples: [50, 100] or residual: [x, y]");
    }
    if (title && !nh_deck_is(deck, title, NH_DECK_SCALAR, "a title", r->error)) return false;
    f->kind = path      ? NH_FIGURE_PATH
              : plot    ? NH_FIGURE_PLOT
              : scan    ? NH_FIGURE_SCAN
              : samples ? NH_FIGURE_SAMPLES
                        : NH_FIGURE_RESIDUAL;
    f->title = title     ? title->text
               : path    ? "Path"
               : plot    ? "Over time"
               : scan    ? "Scan"
               : samples ? "Singular values, by the number of samples"
                         : "Where the equations hold";
    if (path && !read_path(r, path, 3, f)) return false;
    if (residual && !read_path(r, residual, 2, f)) return false;
    if (of && !residual) return nh_deck_fail(deck, of, 0, r->error, "`of` belongs to `residual`");
    if (of && !nh_analysis_file_parse(r, of, &f->of)) return false;
    if (plot && !nh_analysis_file_watches(r, plot, "plot", &f->quantity, &f->quantities)) return false;
    if (scan && !read_scan(r, scan, f)) return false;
    if (samples && !read_samples(r, samples, f)) return false;
    double range[2] = {0, 0};
    if (time && !nh_deck_range(deck, time, "the time interval [begin, end]", range, r->error)) return false;
    f->has_time = time != NULL;
    f->begin = range[0];
    f->end = range[1];
    const nh_deck_node *vary = nh_deck_get(node, "vary");
    if ((scan || samples || residual) && (vary || time))
        return nh_deck_fail(deck, vary ? vary : time, 0, r->error,
                            "`%s` does not use a motion: remove `vary` and `time`",
                            scan      ? "scan"
                            : samples ? "samples"
                                      : "residual");
    return read_vary(r, vary, f);
}

bool nh_analysis_file_read_figures(reader *r)
{
    nh_analysis_file *a = r->a;
    const nh_deck_node *list = nh_deck_get(r->root, "figures");
    a->figures = 0;
    if (!list) return true;
    if (!nh_deck_is(a->deck, list, NH_DECK_LIST, "figures", r->error)) return false;
    a->figure = nh_analysis_file_take(r, list->count, sizeof *a->figure);
    for (size_t i = 0; i < list->count; i++)
        if (!read_figure(r, list->item[i], &a->figure[i])) return false;
    a->figures = list->count;
    return true;
}
