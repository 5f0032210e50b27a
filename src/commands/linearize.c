#include "commands/linearize.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "problem/analysis_file.h"

/* ---- the state ---- */

typedef struct {
    nh_linearized *x;
    nh_analysis_file *file;
    nh_ex *value;         /* 1 + 2m */
    bool *given, project; /* 2m */
    double *parameter;
    long axis_parameter, axis_value; /* what --over changes: an index of parameter, or of value; -1 */
} family;

static bool read_state(family *f, nh_error *error)
{
    nh_linearized *x = f->x;
    nh_system *system = x->system;
    size_t m = system->coordinates;
    f->value = nh_arena_alloc(x->arena, (1 + 2 * m) * sizeof *f->value);
    f->given = nh_arena_alloc(x->arena, (2 * m + 1) * sizeof *f->given);
    f->parameter = nh_arena_alloc(x->arena, (system->parameters + 1) * sizeof *f->parameter);
    for (size_t i = 0; i < system->parameters; i++) f->parameter[i] = system->parameter[i].value;
    for (size_t i = 0; i < 1 + 2 * m; i++) f->value[i] = nh_int(system->dag, 0);
    if (!x->at || !x->at[strspn(x->at, " ")]) return true;
    nh_model names = {.system = system, .dag = system->dag, .arena = x->arena, .m = m, .k = system->constraints};
    nh_system_bindings(system, &names.parameter, &names.parameter_value);
    f->file = nh_analysis_file_start("--at", x->at, NH_USAGE, error);
    if (!f->file || !nh_analysis_file_resolve(f->file, &names, error)) return false;
    memcpy(f->value, f->file->exact, (1 + 2 * m) * sizeof *f->value);
    memcpy(f->given, f->file->written, 2 * m * sizeof *f->given);
    return true;
}

/* A parameter, a coordinate or a velocity. */
static bool read_axis(family *f, const nh_scan_axis *axis, nh_error *error)
{
    const nh_system *system = f->x->system;
    size_t m = system->coordinates, n = 0;
    const char **names = nh_arena_alloc(f->x->arena, (system->parameters + 2 * m + 1) * sizeof *names);
    for (size_t i = 0; i < system->parameters; i++) {
        if (!strcmp(axis->name, system->parameter[i].name)) f->axis_parameter = (long)i;
        names[n++] = system->parameter[i].name;
    }
    for (size_t i = 0; i < 2 * m; i++) {
        const nh_coordinate *c = &system->coordinate[i % m];
        names[n] = i < m ? c->name : nh_name_of(system->dag, c->v);
        if (!strcmp(axis->name, names[n++])) f->axis_value = (long)i;
    }
    if (f->axis_parameter >= 0 || f->axis_value >= 0) return true;
    nh_fail(error, NH_USAGE, "", "--over: `%s` is not a parameter, a coordinate or a velocity of %s", axis->name,
            system->name);
    return nh_error_hint_near(error, axis->name, names, n, "a velocity is written x'");
}

static void move_to(family *f, double value, nh_ex exact)
{
    if (f->axis_parameter >= 0) f->parameter[f->axis_parameter] = value;
    if (f->axis_value < 0) return;
    f->value[1 + f->axis_value] = exact;
    f->given[f->axis_value] = true;
}

static nh_linear_equations *equations_of(family *f, nh_error *error)
{
    nh_linear_state state = {f->value, f->given, f->project};
    return nh_linearization_at(f->x->linearization, f->parameter, &state, error);
}

/* ---- what the eigenvalues say ---- */

static void judge(nh_linear_row *row)
{
    const nh_linear_equations *e = row->equations;
    size_t zero = 0, negative = 0, all = 0;
    for (size_t i = 0; e && i < e->eigenvalues; i++) {
        const nh_eigenvalue *z = &e->eigenvalue[i];
        all += z->times;
        if (z->re > z->radius) row->positive += z->times;
        else if (z->re < -z->radius) negative += z->times;
        else if (hypot(z->re, z->im) <= z->radius) zero += z->times;
    }
    row->verdict = !e                                   ? NH_LINEAR_UNKNOWN
                   : e->residual > 0 || e->changes      ? NH_LINEAR_UNSTEADY
                   : e->size > 0 && !e->eigenvalues     ? NH_LINEAR_UNKNOWN
                   : row->positive                      ? NH_LINEAR_UNSTABLE
                   : negative == all                    ? NH_LINEAR_STABLE
                   : negative + zero == all && negative ? NH_LINEAR_BUT_ZERO
                                                        : NH_LINEAR_MARGINAL;
}

static bool same_kind(const nh_linear_row *a, const nh_linear_row *b)
{
    return a->verdict == b->verdict && a->positive == b->positive;
}

/* ---- along a family ---- */

static nh_linear_row row_at(family *f, double value)
{
    nh_error ignored = {0};
    nh_linear_row row = {.value = {.value = value}};
    move_to(f, value, nh_real(f->x->system->dag, value));
    row.equations = equations_of(f, &ignored);
    judge(&row);
    return row;
}

/* Halves the interval until its ends are neighbouring numbers of 15 digits; returns where the first change ends, in
 * *found. */
static bool bisect(family *f, const nh_linear_row *begin, double high, double range, nh_linear_row *found)
{
    static const double narrow = 4e-15;
    double low = begin->value.value;
    bool good = true;
    for (double middle; good;) {
        middle = low + (high - low) / 2;
        if (high - low <= narrow * fmax(fmax(fabs(low), fabs(high)), range / 10) || middle <= low || middle >= high)
            break;
        nh_linear_row row = row_at(f, middle);
        good = row.equations && !nh_interrupted();
        if (same_kind(&row, begin)) low = middle;
        else {
            high = middle;
            nh_linear_equations_free(found->equations);
            *found = row;
            row.equations = NULL;
        }
        nh_linear_equations_free(row.equations);
    }
    if (!good) return false;
    const nh_linear_change c = {low, high, begin->verdict, found->verdict, begin->positive, found->positive};
    nh_linearized *x = f->x;
    nh_grow(&x->change, &x->change_capacity, x->changes + 1, sizeof *x->change);
    x->change[x->changes++] = c;
    return true;
}

/* All changes between two rows, one after the other. */
static void refine(family *f, const nh_linear_row *a, const nh_linear_row *b, double range)
{
    enum { most = 8 };
    nh_linear_row from = *a;
    from.equations = NULL;
    for (int i = 0; i < most && !same_kind(&from, b); i++) {
        nh_linear_row found = *b;
        found.equations = NULL;
        bool good = bisect(f, &from, b->value.value, range, &found);
        if (good) found.value.value = f->x->change[f->x->changes - 1].high;
        nh_linear_equations_free(found.equations);
        from = found;
        from.equations = NULL;
        if (!good) break;
    }
}

static void find_changes(family *f)
{
    nh_linearized *x = f->x;
    for (size_t i = 1; i < x->rows && !nh_interrupted(); i++) {
        const nh_linear_row *a = &x->row[i - 1], *b = &x->row[i];
        nh_progress("where the stability changes", (double)i / (double)x->rows);
        if (a->equations && b->equations && !same_kind(a, b) && a->value.value < b->value.value)
            refine(f, a, b, x->row[x->rows - 1].value.value - x->row[0].value.value);
    }
}

/* ---- branches ---- */

static size_t multiplicities(const nh_linear_equations *e)
{
    size_t all = 0;
    for (size_t i = 0; e && i < e->eigenvalues; i++) all += e->eigenvalue[i].times;
    return all;
}

static void expanded(const nh_linear_equations *e, double *re, double *im)
{
    size_t n = 0;
    for (size_t i = 0; e && i < e->eigenvalues; i++)
        for (size_t j = 0; j < e->eigenvalue[i].times; j++, n++)
            re[n] = e->eigenvalue[i].re, im[n] = e->eigenvalue[i].im;
}

/* Where a branch goes on: a straight line through its last two values. */
static double ahead(const nh_linearized *x, const double *z, size_t row, size_t branch)
{
    double last = z[(row - 1) * x->branches + branch];
    double before = row > 1 ? z[(row - 2) * x->branches + branch] : NAN;
    if (!isfinite(before)) return last;
    double h = x->row[row - 1].value.value - x->row[row - 2].value.value;
    return last + (last - before) / h * (x->row[row].value.value - x->row[row - 1].value.value);
}

/* Gives the eigenvalues of a row to the branches, the nearest pair first. */
static void continue_branches(nh_linearized *x, size_t row, size_t count, double *re, double *im, bool *used)
{
    size_t n = x->branches;
    double *to_re = x->re + row * n, *to_im = x->im + row * n;
    for (size_t j = 0; j < n; j++) to_re[j] = to_im[j] = NAN;
    for (size_t j = 0; j < count; j++) used[j] = false;
    for (size_t given = 0; given < count; given++) {
        size_t best = 0, branch = 0;
        double least = INFINITY;
        for (size_t b = 0; b < n; b++)
            for (size_t j = 0; j < count; j++) {
                if (used[j] || isfinite(to_re[b])) continue;
                double d = row ? hypot(ahead(x, x->re, row, b) - re[j], ahead(x, x->im, row, b) - im[j]) : 0;
                if (!isfinite(d)) d = DBL_MAX;
                if (d < least) least = d, best = j, branch = b;
            }
        used[best] = true;
        to_re[branch] = re[best];
        to_im[branch] = im[best];
    }
}

static void make_branches(nh_linearized *x)
{
    for (size_t i = 0; i < x->rows; i++) {
        size_t n = multiplicities(x->row[i].equations);
        if (n > x->branches) x->branches = n;
    }
    size_t n = x->branches;
    x->re = nh_arena_alloc(x->arena, (x->rows * n + 1) * sizeof *x->re);
    x->im = nh_arena_alloc(x->arena, (x->rows * n + 1) * sizeof *x->im);
    double *re = nh_alloc_array(2 * n + 1, sizeof *re), *im = re + n;
    bool *used = nh_alloc_array(n + 1, sizeof *used);
    for (size_t i = 0; i < x->rows; i++) {
        expanded(x->row[i].equations, re, im);
        continue_branches(x, i, multiplicities(x->row[i].equations), re, im, used);
    }
    nh_free(used);
    nh_free(re);
}

/* ---- the answer ---- */

static bool one_state(family *f, nh_error *error)
{
    nh_linearized *x = f->x;
    x->row = nh_arena_alloc(x->arena, sizeof *x->row);
    x->rows = 1;
    x->row[0].equations = equations_of(f, error);
    judge(&x->row[0]);
    return x->row[0].equations != NULL;
}

static bool all_states(family *f, const char *over, nh_error *error)
{
    nh_linearized *x = f->x;
    nh_scan_axis axis;
    size_t good = 0;
    if (!nh_scan_read_axis(x->arena, over, &axis, error) || !read_axis(f, &axis, error)) return false;
    x->over = axis.name;
    x->row = nh_arena_alloc(x->arena, axis.count * sizeof *x->row);
    for (size_t i = 0; i < axis.count; i++) {
        nh_error why = {0};
        nh_progress("the linear equations", (double)i / (double)axis.count);
        if (nh_interrupted()) break;
        nh_linear_row *row = &x->row[x->rows++];
        row->value = axis.value[i];
        move_to(f, row->value.value, nh_ratio(x->system->dag, row->value.top, row->value.bottom));
        row->equations = equations_of(f, &why);
        judge(row);
        good += row->equations != NULL;
        if (row->equations) continue;
        row->why = nh_arena_strdup(x->arena, why.what);
        if (!good && i + 1 == axis.count) *error = why;
    }
    x->partial = x->rows < axis.count;
    if (!good) return nh_interrupted() ? nh_fail_ended(error, "while the equations were linearised") : false;
    if (axis.ascending) find_changes(f);
    x->partial |= nh_interrupted();
    make_branches(x);
    return true;
}

nh_linearized *nh_linearize_create(const nh_request *q, nh_error *error)
{
    nh_arena *arena = nh_arena_create();
    nh_linearized *x = nh_arena_alloc(arena, sizeof *x);
    *x = (nh_linearized){.arena = arena, .at = q->initial ? nh_arena_strdup(arena, q->initial) : NULL};
    family f = {.x = x, .project = q->project, .axis_parameter = -1, .axis_value = -1};
    nh_progress("the equations of motion", -1);
    x->system = nh_system_read(q->system_path, q->settings, q->setting, error);
    bool good = x->system && nh_system_needs_formulas(x->system, "linearize", error) && read_state(&f, error);
    if (good) x->linearization = nh_linearization_create(x->system);
    const char *over = q->overs ? q->over_list[0] : q->over;
    good = good && (over ? all_states(&f, over, error) : one_state(&f, error));
    nh_analysis_file_free(f.file);
    if (good) return x;
    nh_linearized_free(x);
    return NULL;
}

void nh_linearized_free(nh_linearized *x)
{
    if (!x) return;
    for (size_t i = 0; i < x->rows; i++) nh_linear_equations_free(x->row[i].equations);
    nh_free(x->change);
    nh_linearization_free(x->linearization);
    nh_system_free(x->system);
    nh_arena_free(x->arena);
}

const char *nh_linearize_name(const nh_linearized *x, const nh_linear_equations *e, size_t i)
{
    const nh_coordinate *c = x->system->coordinate;
    return i < e->s ? c[e->position[i]].name : nh_name_of(x->system->dag, c[e->velocity[i - e->s]].v);
}
