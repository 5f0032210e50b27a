/* Each symmetry is derived in a copy of the model; its expressions are brought back from there. */
#include "search/search.h"

#include <string.h>

#include "base/parallel.h"
#include "base/progress.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "integrals/fixed.h"
#include "search/current_list.h"

enum { together = 8, most_components = 16 };

/* ---- the components ---- */

/* n expressions: an array, or `one` of them. */
typedef struct {
    nh_ex **array, *one;
    size_t n;
} component;

static size_t list_field(const nh_model *model, nh_field *z, component *out)
{
    if (!z->space) return 0;
    out[0] = (component){.one = &z->time, .n = 1};
    out[1] = (component){.array = &z->space, .n = model->m};
    out[2] = (component){.array = &z->velocity, .n = model->n};
    return 3;
}

static size_t list(const nh_model *model, nh_symmetry *z, component *out)
{
    size_t n = 0;
    out[n++] = (component){.one = &z->Z0, .n = 1};
    out[n++] = (component){.array = &z->zeta, .n = model->n};
    out[n++] = (component){.array = &z->W, .n = model->n};
    out[n++] = (component){.array = &z->coordinate_rate, .n = model->m};
    out[n++] = (component){.array = &z->bracket_form, .n = model->k};
    if (z->relative_rate) out[n++] = (component){.array = &z->relative_rate, .n = model->m};
    n += list_field(model, &z->field, out + n);
    n += list_field(model, &z->relative, out + n);
    return n + list_field(model, &z->bracket, out + n);
}

static void put_values(nh_model *model, const nh_ex *fixed, nh_symmetry *z)
{
    component c[most_components];
    for (size_t k = list(model, z, c); k-- > 0;)
        for (size_t i = 0; i < c[k].n; i++) {
            nh_ex *e = c[k].one ? c[k].one : &(*c[k].array)[i];
            *e = nh_simplify_short(model->dag, nh_fixed_values(model, fixed, *e), 0);
        }
}

/* From a copy into the model. */
static void bring(nh_model *model, const nh_model *copy, nh_symmetry *z)
{
    component c[most_components];
    size_t components = list(model, z, c), total = 0;
    for (size_t k = 0; k < components; k++) total += c[k].n;
    nh_ex *all = nh_arena_alloc(model->arena, (total + 1) * sizeof *all);
    for (size_t k = 0, at = 0; k < components; at += c[k++].n)
        memcpy(all + at, c[k].one ? c[k].one : *c[k].array, c[k].n * sizeof *all);
    nh_dag_bring(model->dag, copy->dag, total, all);
    for (size_t k = 0, at = 0; k < components; at += c[k++].n)
        if (c[k].one) *c[k].one = all[at];
        else *c[k].array = all + at;
}

/* ---- several at a time ---- */

typedef struct {
    nh_current *current;
    nh_dag *dag;
    nh_model *model;
    nh_error trouble;
} task;

typedef struct {
    const nh_analysis *r;
    const nh_points *points;
    task task[together];
} tasks;

static void find(size_t index, void *context)
{
    tasks *x = context;
    task *t = &x->task[index];
    nh_current *f = t->current;
    t->dag = nh_dag_copy(x->r->question->model->dag);
    t->model = nh_model_copy(x->r->question->model, t->dag);
    nh_error_clear(&t->trouble);
    f->has_symmetry =
        nh_symmetry_of(t->model, x->points, f->phi, x->r->question->options.same, &f->symmetry, &t->trouble);
    if (f->has_symmetry && f->proof.fixed) put_values(t->model, f->proof.fixed, &f->symmetry);
}

static void find_all(nh_analysis *result, const nh_points *points, size_t n, nh_current *current)
{
    if (n) nh_model_G(result->question->model); /* every symmetry needs it: once is enough */
    for (size_t first = 0; first < n; first += together) {
        size_t count = n - first < together ? n - first : together;
        tasks x = {.r = result, .points = points};
        for (size_t k = 0; k < count; k++) x.task[k].current = &current[first + k];
        nh_parallel(count, nh_threads(result->question->options.threads), find, &x);
        for (size_t k = 0; k < count; k++) {
            task *t = &x.task[k];
            if (t->current->has_symmetry) bring(result->question->model, t->model, &t->current->symmetry);
            else nh_analysis_warn(result, "no symmetry could be computed: %s", t->trouble.what);
            nh_model_copy_free(t->model);
            nh_dag_free(t->dag);
        }
    }
}

void nh_symmetries_find(nh_analysis *result)
{
    const nh_current_list *list = result->list;
    enum { generic_count = 24 };
    nh_error trouble;
    nh_error_clear(&trouble);
    nh_progress("the symmetries", -1);
    nh_points *points = nh_points_create(result->question->model, generic_count, 1,
                                         (uint64_t)result->question->options.seed + 202, &trouble);
    if (!points) nh_analysis_warn(result, "no symmetry could be computed: %s", trouble.what);
    if (points) find_all(result, points, list->count, nh_current_list_describe(result, list->found));
    if (points) find_all(result, points, list->pieces, nh_current_list_describe(result, list->piece));
    nh_points_free(points);
}
