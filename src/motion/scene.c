#include "motion/scene.h"

#include <math.h>
#include <string.h>

#include "expr/diff.h"
#include "expr/normal.h"

static const double seems_zero = 1e-11; /* relative size below which a derivative may be identically zero */

/* ---- which state feeds which ---- */

static nh_ex rate_of_state(const nh_model *o, size_t i) { return i < o->m ? o->rho[i] : o->a[i - o->m]; }
static nh_ex symbol_of(const nh_model *o, size_t j) { return o->chart->symbol[1 + j]; }

/* Does d (relative to the size of e) vanish at all probes of the chart?  What is undefined somewhere does not. */
static bool vanishes_at_probes(const nh_model *o, nh_ex d, nh_ex e)
{
    const nh_chart *c = o->chart;
    nh_ex both[2] = {d, e};
    double value[2];
    nh_tape *tape = nh_model_tape(o, 2, both);
    nh_tape_work *work = nh_tape_work_create(tape);
    bool zero = c->probes > 0;
    for (size_t p = 0; p < c->probes && zero; p++) {
        nh_tape_eval(tape, work, c->probe + p * c->width, value);
        zero = fabs(value[0]) <= seems_zero * (1 + fabs(value[1]));
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return zero;
}

/* Through the implicit velocities too: derivatives follow their rules. */
static bool feeds(const nh_model *o, size_t j, nh_ex e)
{
    nh_ex d = nh_diff(o->dag, e, symbol_of(o, j));
    if (nh_is_zero(o->dag, d)) return false;
    return !(vanishes_at_probes(o, d, e) && nh_normal_is_zero(o->dag, d, 0) == NH_ZERO);
}

typedef struct {
    const nh_model *model;
    size_t states;
    bool *feeds; /* [i * states + j]: j feeds i */
    bool *kept;
} network;

static network network_of(const nh_model *o)
{
    network w = {.model = o, .states = o->m + o->n};
    w.feeds = nh_alloc_array(w.states * w.states, sizeof *w.feeds);
    w.kept = nh_alloc_array(w.states, sizeof *w.kept);
    for (size_t i = 0; i < w.states; i++)
        for (size_t j = 0; j < w.states; j++) w.feeds[i * w.states + j] = feeds(o, j, rate_of_state(o, i));
    return w;
}

static void close_under(network *w)
{
    for (bool again = true; again;) {
        again = false;
        for (size_t i = 0; i < w->states; i++)
            for (size_t j = 0; j < w->states && w->kept[i]; j++)
                if (w->feeds[i * w->states + j] && !w->kept[j]) again = w->kept[j] = true;
    }
}

static bool reads_implicit(const nh_model *o, nh_ex e)
{
    for (size_t a = 0; a < o->chart->implicit; a++)
        if (nh_depends(o->dag, e, o->chart->u[a])) return true;
    return false;
}

/* Implicit velocities are found together, so whatever their equations read is needed. */
static bool keep_implicit(network *w, size_t n, const nh_ex *watched)
{
    const nh_model *o = w->model;
    bool needed = false;
    for (size_t k = 0; k < n; k++) needed |= reads_implicit(o, watched[k]);
    for (size_t i = 0; i < w->states; i++) needed |= w->kept[i] && reads_implicit(o, rate_of_state(o, i));
    for (size_t a = 0; a < o->chart->implicit && needed; a++)
        for (size_t j = 0; j < w->states; j++) w->kept[j] |= nh_depends(o->dag, o->chart->residual[a], symbol_of(o, j));
    if (needed) close_under(w);
    return needed;
}

/* ---- core, quadratures, rest ---- */

/* Peel off, layer by layer, what no remaining state reads; the layer that goes last can be integrated first. */
static void sort_states(nh_scene *s, const network *w)
{
    bool *left = nh_alloc_array(w->states, sizeof *left), *layer = nh_alloc_array(w->states, sizeof *layer);
    memcpy(left, w->kept, w->states * sizeof *left);
    size_t at = s->kept;
    for (bool again = true; again;) {
        again = false;
        for (size_t j = 0; j < w->states; j++) {
            layer[j] = left[j];
            for (size_t i = 0; i < w->states; i++)
                if (left[i] && w->feeds[i * w->states + j]) layer[j] = false;
        }
        for (size_t j = w->states; j-- > 0;)
            if (layer[j]) {
                left[j] = false;
                s->state[--at] = j;
                again = true;
            }
    }
    s->core = at;
    s->quadratures = s->kept - at;
    size_t next = 0, last = s->kept;
    for (size_t j = 0; j < w->states; j++) {
        if (left[j]) s->state[next++] = j;
        if (!w->kept[j]) s->state[last++] = j;
    }
    nh_free(layer);
    nh_free(left);
}

static void make_tapes(nh_scene *s)
{
    const nh_model *o = s->model;
    size_t n = s->kept;
    nh_ex *e = nh_alloc_array(s->states + n * n, sizeof *e);
    for (size_t i = 0; i < s->states; i++) e[i] = rate_of_state(o, i);
    nh_tape *all = nh_model_tape(o, s->states, e);
    s->instructions_of_all = nh_tape_length(all);
    nh_tape_free(all);
    for (size_t i = 0; i < n; i++) e[i] = rate_of_state(o, s->state[i]);
    s->rate = n ? nh_model_tape(o, n, e) : NULL;
    s->instructions = n ? nh_tape_length(s->rate) : 0;
    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i < n; i++) e[n + i + j * n] = nh_diff(o->dag, e[i], symbol_of(o, s->state[j]));
    s->jacobian = n ? nh_model_tape(o, n * n, e + n) : NULL;
    nh_free(e);
}

nh_scene *nh_scene_create(const nh_model *o, size_t n, const nh_ex *watched)
{
    nh_arena *arena = nh_arena_create();
    nh_scene *s = nh_arena_alloc(arena, sizeof *s);
    *s = (nh_scene){.model = o, .arena = arena, .states = o->m + o->n};
    s->state = nh_arena_alloc(arena, s->states * sizeof *s->state);
    network w = network_of(o);
    for (size_t j = 0; j < w.states; j++)
        for (size_t k = 0; k < n && !w.kept[j]; k++) w.kept[j] = feeds(o, j, watched[k]);
    close_under(&w);
    s->implicit = keep_implicit(&w, n, watched);
    for (size_t j = 0; j < w.states; j++) s->kept += w.kept[j];
    sort_states(s, &w);
    make_tapes(s);
    nh_free(w.kept);
    nh_free(w.feeds);
    return s;
}

void nh_scene_free(nh_scene *s)
{
    if (!s) return;
    nh_tape_free(s->rate);
    nh_tape_free(s->jacobian);
    nh_arena_free(s->arena);
}

/* ---- its equations ---- */

struct nh_scene_run {
    const nh_scene *scene;
    nh_tape_work *rate, *jacobian;
    const nh_flow_problem *whole;
    double *point; /* (t, q, w, u): dropped states at their initial values, implicit velocities at their last ones */
};

nh_scene_run *nh_scene_run_create(const nh_scene *s, const double *z0)
{
    nh_scene_run *run = nh_alloc(sizeof *run);
    *run = (nh_scene_run){.scene = s, .point = nh_alloc_array(s->model->width, sizeof *run->point)};
    if (s->rate) run->rate = nh_tape_work_create(s->rate);
    if (s->jacobian) run->jacobian = nh_tape_work_create(s->jacobian);
    memcpy(run->point + 1, z0, s->states * sizeof *z0);
    return run;
}

void nh_scene_run_hasten(nh_scene_run *run, double patience)
{
    if (run->rate) nh_tape_hasten(run->rate, patience);
    if (run->jacobian) nh_tape_hasten(run->jacobian, patience);
}

const char *nh_scene_run_words(const nh_scene_run *run) { return run->rate ? nh_tape_words(run->rate) : NULL; }

void nh_scene_run_free(nh_scene_run *run)
{
    if (!run) return;
    nh_tape_work_free(run->rate);
    nh_tape_work_free(run->jacobian);
    nh_free(run->point);
    nh_free(run);
}

static bool place(nh_scene_run *run, double t, const double *z)
{
    const nh_scene *s = run->scene;
    run->point[0] = t;
    for (size_t i = 0; i < s->kept; i++) run->point[1 + s->state[i]] = z[i];
    return !s->implicit || nh_chart_complete(s->model->chart, run->point);
}

bool nh_scene_point(nh_scene_run *run, double t, const double *z, double *point)
{
    bool good = place(run, t, z);
    memcpy(point, run->point, run->scene->model->width * sizeof *point);
    return good;
}

static bool finite_all(size_t n, const double *x)
{
    for (size_t i = 0; i < n; i++)
        if (!isfinite(x[i])) return false;
    return true;
}

static bool scene_rate(double t, const double *z, double *rate, void *context)
{
    nh_scene_run *run = context;
    if (!place(run, t, z)) return false;
    nh_tape_eval(run->scene->rate, run->rate, run->point, rate);
    return finite_all(run->scene->kept, rate);
}

static bool scene_jacobian(double t, const double *z, double *jacobian, void *context)
{
    nh_scene_run *run = context;
    if (!place(run, t, z)) return false;
    nh_tape_eval(run->scene->jacobian, run->jacobian, run->point, jacobian);
    return finite_all(run->scene->kept * run->scene->kept, jacobian);
}

static bool scene_guard(double t, const double *z, double *value, void *context)
{
    nh_scene_run *run = context;
    return place(run, t, z) && run->whole->guard(t, run->point + 1, value, run->whole->context);
}

nh_flow_problem nh_scene_problem(nh_scene_run *run, const nh_flow_problem *whole)
{
    run->whole = whole;
    size_t guards = whole ? whole->guards : 0;
    return (nh_flow_problem){.size = run->scene->kept, .context = run, .rate = scene_rate, .jacobian = scene_jacobian, .guards = guards, .guard = guards ? scene_guard : NULL};
}

/* ---- in words ---- */

const char *nh_scene_state_name(const nh_scene *s, size_t i) { return nh_name_of(s->model->dag, symbol_of(s->model, i)); }

static void list(const nh_scene *s, size_t from, size_t to, nh_text *out)
{
    for (size_t i = from; i < to; i++)
        nh_text_addf(out, "%s%s", i == from ? "" : i + 1 == to ? " and " : ", ", nh_scene_state_name(s, s->state[i]));
}

void nh_scene_words(const nh_scene *s, nh_text *out)
{
    nh_text_addf(out, "%zu of %zu states integrated", s->core, s->states);
    if (s->core) {
        nh_text_add(out, " (");
        list(s, 0, s->core, out);
        nh_text_add(out, ")");
    }
    if (s->quadratures) {
        nh_text_add(out, ", ");
        list(s, s->core, s->kept, out);
        nh_text_add(out, " by quadrature");
    }
    if (s->kept < s->states) {
        nh_text_add(out, ", ");
        list(s, s->kept, s->states, out);
        nh_text_add(out, " dropped");
    }
    nh_text_addf(out, "; %zu of %zu instructions", s->instructions, s->instructions_of_all);
}
