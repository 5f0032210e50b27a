/* scan_refine: a jump of a scan, located, recognised and confirmed.
 *
 * A step is located by bisection of the leading number, a dip by Brent's minimisation of the square of its singular
 * value, which near a root is a parabola.  The located number is recognised (scan_recognise.c), and confirmed by the
 * source with the exact value as the parameter: a guess at which the number is that of the points around it is
 * discarded. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_min.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/json.h"
#include "base/memory.h"
#include "base/progress.h"
#include "commands/scan_internal.h"
#include "graph/num.h"

static const double finest = 1e-11, coarsest = 1e-6; /* relative errors of a located value */

typedef struct {
    const nh_scan *scan;
    const nh_scan_request *request;
    const nh_scan_jump *jump;
    nh_arena *arena;
    size_t settings;
    nh_setting *exact, *plain; /* settings of the jump's point; the value along the axis is changed */
    nh_setting *along, *along_plain;
    size_t space;        /* of a dip: index of the space in `jump->space` */
    double from, to;     /* interval between the points beside it */
    double value, error; /* the located value */
    double *number;      /* the numbers of the source */
    double generic, below, above, smallest;
    const char *name, *why; /* the exact value as text; why it is not confirmed */
    nh_scan_kind kind;
    bool confirmed, ended;
} task;

static double axis_value(const task *t, size_t index) { return t->scan->axis[t->jump->axis].value[index].value; }

static double leading_at(const task *t, ptrdiff_t offset)
{
    size_t stride = nh_scan_stride(t->scan, t->jump->axis), i = nh_scan_index(t->scan, t->jump->place, t->jump->axis);
    if ((offset < 0 && i == 0) || (offset > 0 && i + 1 >= t->scan->axis[t->jump->axis].count)) return NAN;
    const nh_scan_row *row = &t->scan->row[(size_t)((ptrdiff_t)t->jump->place + offset * (ptrdiff_t)stride)];
    return row->done ? row->number[0] : NAN;
}

/* The numbers with this value along the axis; returns the leading one. */
static double ask(task *t, const nh_setting *setting, bool generic)
{
    const char *why = NULL, *name = t->along->name;
    nh_setting *all = setting->bottom > 0 || setting->formula ? t->exact : t->plain,
               *along = setting->bottom > 0 || setting->formula ? t->along : t->along_plain;
    nh_setting before = *along;
    *along = *setting;
    along->name = name;
    if (!t->ended)
        t->ended =
            !t->request->source->at(t->request->source->context, t->arena, t->settings, all, generic, t->number, &why);
    *along = before;
    t->why = why;
    return t->ended ? NAN : t->number[0];
}

/* ---- location ---- */

/* Rounds to a decimal, which is an exact setting, with twelve digits of `size`. */
static nh_setting decimal(double value, double size)
{
    double digits = pow(10, 12 - ceil(log10(size))), rounded = round(value * digits) / digits;
    nh_num x = nh_num_decimal(rounded);
    return (nh_setting){.value = rounded, .top = nh_num_short(x) ? x.p : 0, .bottom = nh_num_short(x) ? x.q : 0};
}

static bool bisect(task *t)
{
    double size = fmax(fabs(t->from), fabs(t->to));
    while (t->to - t->from > finest * size && !t->ended) {
        nh_setting middle = decimal(0.5 * (t->from + t->to), size);
        if (!(middle.value > t->from && middle.value < t->to)) break;
        double n = ask(t, &middle, false);
        if (!isfinite(n)) break;
        *(n == t->below ? &t->from : &t->to) = middle.value;
    }
    t->value = 0.5 * (t->from + t->to);
    t->error = fmax(t->to - t->from, finest * size);
    return !t->ended && t->error <= coarsest * size;
}

/* sigma^2 of the space; as large as possible where it cannot be computed. */
static double square_at(double value, void *context)
{
    task *t = context;
    double smallest[NH_SCAN_MOST_SPACES];
    size_t vanishing[NH_SCAN_MOST_SPACES], space = t->jump->space[t->space];
    t->along_plain->value = value;
    t->ended = t->ended || nh_interrupted();
    if (t->ended) return 0;
    nh_scan_spectra(t->scan, t->request, t->settings, t->plain, space, t->jump->vanishing[t->space], smallest,
                    vanishing);
    return isfinite(smallest[space]) ? smallest[space] * smallest[space] : 1e100;
}

/* Near a root sigma = c |lambda - lambda0|: two values, one on each side, give lambda0 more accurately than a minimum
 * does. */
static void polish(task *t, double scale)
{
    static const double steps[] = {1e-4, 1e-6};
    for (size_t k = 0; k < sizeof steps / sizeof *steps && !t->ended; k++) {
        double h = steps[k] * (t->to - t->from), left = sqrt(square_at(t->value - h, t)),
               right = sqrt(square_at(t->value + h, t));
        double shift = h * (left - right) / (left + right);
        if (!(fabs(shift) < h)) return;
        double there = sqrt(square_at(t->value + shift, t)) / scale;
        if (!(there <= t->smallest)) return;
        t->value += shift;
        t->smallest = there;
    }
}

/* Minimises, until it is no root or cannot be located better. */
static bool minimise(task *t, gsl_min_fminimizer *m)
{
    enum { most = 80, tried = 6 };
    double size = fmax(fabs(t->from), fabs(t->to)),
           scale = sqrt(fmin(gsl_min_fminimizer_f_lower(m), gsl_min_fminimizer_f_upper(m)));
    double before = gsl_min_fminimizer_f_minimum(m);
    for (int k = 0; k < most && !t->ended; k++) {
        if (gsl_min_fminimizer_iterate(m)) break;
        double f = gsl_min_fminimizer_f_minimum(m);
        bool flat = k % tried == tried - 1 && f > 0.9 * before;
        if (k % tried == tried - 1) before = f;
        if (flat || gsl_min_fminimizer_x_upper(m) - gsl_min_fminimizer_x_lower(m) < 1e-14 * size) break;
    }
    t->value = gsl_min_fminimizer_x_minimum(m);
    t->smallest = sqrt(gsl_min_fminimizer_f_minimum(m)) / scale;
    if (t->smallest < t->request->options.scan_root) polish(t, scale);
    t->error = fmax(100 * t->smallest * (t->to - t->from), finest * size);
    return !t->ended && t->smallest < t->request->options.scan_root;
}

static bool find_minimum(task *t)
{
    gsl_error_handler_t *handler = gsl_set_error_handler_off();
    gsl_min_fminimizer *m = nh_memory_got(gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent));
    gsl_function f = {square_at, t};
    double middle = axis_value(t, nh_scan_index(t->scan, t->jump->place, t->jump->axis));
    bool good = !gsl_min_fminimizer_set(m, &f, middle, t->from, t->to) && minimise(t, m);
    gsl_min_fminimizer_free(m);
    gsl_set_error_handler(handler);
    return good;
}

static bool locate(task *t)
{
    size_t i = nh_scan_index(t->scan, t->jump->place, t->jump->axis), last = t->scan->axis[t->jump->axis].count - 1;
    t->below = leading_at(t, t->kind == NH_SCAN_STEP ? 0 : -1);
    t->above = leading_at(t, 1);
    t->from = axis_value(t, i - (t->kind != NH_SCAN_STEP && i > 0));
    t->to = axis_value(t, i < last ? i + 1 : last);
    if (t->kind == NH_SCAN_HIT) return t->value = axis_value(t, i), true;
    if (t->kind == NH_SCAN_STEP) return bisect(t);
    for (t->space = 0; t->space < t->jump->spaces && !t->ended; t->space++)
        if (find_minimum(t)) return true;
    return false;
}

/* ---- recognition ---- */

static const char *name_of(task *t, const nh_setting *s)
{
    if (s->formula) return s->formula;
    return nh_arena_printf(t->arena, s->bottom == 1 ? "%lld" : "%lld/%lld", (long long)s->top, (long long)s->bottom);
}

/* Does the source give another number there than around it? */
static bool confirms(task *t, const nh_setting *guess)
{
    double n = ask(t, guess, false);
    if (!isfinite(n)) return false;
    if (t->kind == NH_SCAN_STEP) return true;
    return isfinite(t->generic) && n != t->generic;
}

/* A step at an end of the grid is a single value, as far as the grid shows. */
static void look_at_ends(task *t)
{
    size_t last = t->scan->axis[t->jump->axis].count - 1;
    if (t->kind != NH_SCAN_STEP || !t->confirmed) return;
    bool first = t->value == axis_value(t, 0) && t->number[0] == t->below,
         end = t->value == axis_value(t, last) && t->number[0] == t->above;
    if (!first && !end) return;
    t->kind = NH_SCAN_HIT;
    t->generic = first ? t->above : t->below;
}

static void recognise(task *t)
{
    nh_setting guess[NH_SCAN_MOST_GUESSES], here = *t->along;
    size_t guesses = 1;
    const char *why = NULL;
    t->generic = t->jump->generic;
    if (!isfinite(t->generic) && t->kind != NH_SCAN_STEP) t->generic = ask(t, t->along_plain, true);
    if (t->kind == NH_SCAN_HIT) guess[0] = here;
    else guesses = nh_scan_guess(t->arena, t->value, t->error, guess);
    for (size_t k = 0; k < guesses && !t->confirmed && !t->ended; k++) {
        t->confirmed = confirms(t, &guess[k]);
        if (t->confirmed) t->name = name_of(t, &guess[k]), t->value = guess[k].value;
        else if (!why)
            why = nh_arena_printf(t->arena, "with exactly %s %s", name_of(t, &guess[k]),
                                  t->why ? t->why : "the number is the same as around it");
    }
    if (t->kind == NH_SCAN_HIT) t->name = name_of(t, &here);
    look_at_ends(t);
    t->why = t->confirmed ? NULL : why ? why : "the exact value was not recognised";
    for (size_t i = 0; !t->confirmed && i < t->request->source->count; i++) t->number[i] = NAN;
}

/* ---- a line ---- */

static void write_line(const task *t, nh_text *line)
{
    nh_json *to = nh_json_object();
    char value[40];
    snprintf(value, sizeof value, "%.11g", t->value);
    nh_json_put_number(to, "value", strtod(value, NULL));
    nh_json_put_number(to, "kind", t->kind);
    nh_json_put_text(to, "exact", t->name);
    nh_json_put_numbers(to, "number", t->request->source->count, t->number, 1);
    nh_json_put_number(to, "generic", t->generic);
    nh_json_put_number(to, "below", t->below);
    nh_json_put_number(to, "above", t->above);
    nh_json_put_number(to, "space", t->jump->spaces ? (double)t->jump->space[t->space] : NAN);
    nh_json_put_bool(to, "confirmed", t->confirmed);
    nh_json_put_text(to, "why", t->why);
    char *text = nh_json_line(to);
    nh_text_add(line, text);
    nh_free(text);
}

bool nh_scan_refine(const nh_scan *x, const nh_scan_request *q, const nh_scan_jump *jump, nh_text *line)
{
    task t = {.scan = x, .request = q, .jump = jump, .arena = nh_arena_create(), .generic = NAN, .kind = jump->kind};
    t.number = nh_arena_alloc(t.arena, (q->source->count + 1) * sizeof *t.number);
    t.exact = nh_scan_settings(x, q, t.arena, jump->place, true, &t.settings);
    t.plain = nh_scan_settings(x, q, t.arena, jump->place, false, &t.settings);
    t.along = &t.exact[q->settings + jump->axis];
    t.along_plain = &t.plain[q->settings + jump->axis];
    bool found = locate(&t);
    if (found && !t.ended) recognise(&t);
    if (found && !t.ended) write_line(&t, line);
    else nh_text_add(line, "{}");
    nh_arena_free(t.arena);
    return !t.ended;
}

bool nh_scan_read_special(nh_scan *x, const char *line, const nh_scan_jump *jump, nh_scan_special *out)
{
    nh_json *from = nh_json_parse(line);
    bool found = isfinite(nh_json_value(from, "value"));
    double space = nh_json_value(from, "space");
    const nh_json *numbers = nh_json_get(from, "number");
    *out = (nh_scan_special){.kind = found ? (nh_scan_kind)nh_json_value(from, "kind") : jump->kind,
                             .axis = jump->axis,
                             .place = jump->place};
    if (found) {
        out->value = nh_json_value(from, "value");
        out->generic = nh_json_value(from, "generic");
        out->below = nh_json_value(from, "below");
        out->above = nh_json_value(from, "above");
        if (nh_json_text(from, "exact")) out->exact = nh_arena_strdup(x->arena, nh_json_text(from, "exact"));
        if (nh_json_text(from, "why")) out->why = nh_arena_strdup(x->arena, nh_json_text(from, "why"));
        if (isfinite(space)) out->space = x->space[(size_t)space];
        out->confirmed = nh_json_is_true(from, "confirmed");
        out->number = nh_arena_alloc(x->arena, (x->source->count + 1) * sizeof *out->number);
        for (size_t i = 0; i < x->source->count; i++) out->number[i] = nh_json_number_at(numbers, i);
    }
    nh_json_free(from);
    return found;
}
