/* closed_subsystem_idle: what has no influence on a scene: parameters, and bodies.
 *
 * The Lagrangian of a body b may be given a weight 1 + eps.  M and A are linear in the Lagrangian, so that M a = A gives
 *
 *     da/d eps = M^-1 (A_b - M_b a),     M_b, A_b: those of L_b = 1/2 <V, I V> + m g . x alone, without forces;
 *
 * where this vanishes for the velocities that are kept, how heavy the body is does not matter to them. */
#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/diff.h"
#include "motion/closed_subsystem.h"

static const double nothing = 1e-9; /* relative size of an influence that is rounding */

static void list_names(size_t n, const char *const *name, nh_text *out)
{
    for (size_t i = 0; i < n; i++) nh_text_addf(out, "%s%s", i == 0 ? "" : i + 1 == n ? " and " : ", ", name[i]);
}

static bool is_idle(nh_dag *d, nh_ex e, size_t n, const nh_ex *parameter, const bool *idle)
{
    for (size_t i = 0; i < n; i++)
        if (!idle[i] && nh_depends(d, e, parameter[i])) return false;
    return true;
}

static nh_ex lagrangian_of(const nh_model *o, const nh_chain *chain, size_t body)
{
    nh_dag *d = o->dag;
    const nh_body *b = &chain->body[body];
    nh_pose pose;
    nh_twist twist;
    nh_chain_frame(chain, d, (long)body, 0, &pose, &twist);
    nh_inertia inertia = nh_body_inertia(d, b);
    nh_wrench momentum = nh_inertia_momentum(d, &inertia, &twist);
    return nh_add(d, nh_mul(d, nh_ratio(d, 1, 2), nh_pairing(d, &twist, &momentum)), nh_mul(d, b->mass, nh_dot(d, chain->gravity, b->position)));
}

/* M (n x n), a (n), A_b - M_b a (n), dL_b/dw of what is dropped (n; 0 for the rest). */
static void influence_of(const nh_closed_subsystem *s, nh_ex L, nh_ex *out)
{
    const nh_model *o = s->model;
    nh_dag *d = o->dag;
    size_t n = o->n, m = o->m;
    nh_ex *p = nh_alloc_array(m + 1, sizeof *p), lbar = nh_model_compose(o, L);
    memcpy(out, o->M, n * n * sizeof *out);
    memcpy(out + n * n, o->a, n * sizeof *out);
    for (size_t i = 0; i < m; i++) p[i] = nh_model_compose(o, nh_diff(d, L, o->system->coordinate[i].v));
    for (size_t i = 0; i < n; i++) {
        nh_ex sum = nh_int(d, 0);
        for (size_t k = 0; k < m; k++) {
            nh_ex force = nh_sub(d, nh_model_compose(o, nh_diff(d, L, o->system->coordinate[k].q)), nh_model_X0(o, p[k]));
            for (size_t j = 0; j < n; j++) force = nh_sub(d, force, nh_mul(d, nh_model_Y(o, j, p[k]), o->a[j]));
            sum = nh_add(d, sum, nh_mul(d, o->R[k * n + i], force));
        }
        out[n * n + n + i] = sum;
        out[n * n + 2 * n + i] = nh_int(d, 0);
    }
    for (size_t j = s->kept + s->levels; j < s->states; j++)
        if (s->state[j] >= m) out[n * n + 2 * n + s->state[j] - m] = nh_model_Y(o, s->state[j] - m, lbar);
    nh_free(p);
}

static bool vanishes_for_kept(const nh_closed_subsystem *s, size_t n, double *value)
{
    const double *a = value + n * n;
    double *x = value + n * n + n, most = 0;
    if (!nh_solve(n, value, 1, x, NULL)) return false;
    for (size_t i = 0; i < n; i++) most = fmax(most, fabs(a[i]) + fabs(x[i]));
    for (size_t j = 0; j < s->kept + s->levels; j++)
        if (s->state[j] >= s->model->m && !(fabs(x[s->state[j] - s->model->m]) <= nothing * (1 + most))) return false;
    return true;
}

/* With currents: are those states a closed system without them, too?  Then their rates are the same at places that differ in what is dropped only. */
static bool closed_without_currents(const nh_closed_subsystem *s, const nh_tape *tape, nh_tape_work *work, const double *point, const double *other, const double *value)
{
    size_t n = s->model->n, width = s->model->width, count = n * n + 3 * n;
    double *mixed = nh_alloc_array(width + count, sizeof *mixed), *there = mixed + width;
    bool good = true;
    memcpy(mixed, point, width * sizeof *mixed);
    for (size_t j = s->kept + s->levels; j < s->states; j++) mixed[1 + s->state[j]] = other[1 + s->state[j]];
    nh_tape_eval(tape, work, mixed, there);
    for (size_t j = 0; j < s->kept + s->levels; j++) {
        size_t i = s->state[j] - s->model->m;
        if (s->state[j] >= s->model->m) good = good && fabs(there[n * n + i] - value[n * n + i]) <= nothing * (1 + fabs(value[n * n + i]));
    }
    nh_free(mixed);
    return good;
}

/* A body whose weight changes nothing at the chart's probes, and that moves with something dropped (else what is watched may be its energy). */
static bool body_has_no_influence(const nh_closed_subsystem *s, size_t body)
{
    const nh_model *o = s->model;
    size_t n = o->n, count = n * n + 3 * n;
    if (s->implicit || !n || o->chart->probes < 2) return false;
    nh_ex *e = nh_alloc_array(count, sizeof *e);
    double *value = nh_alloc_array(count, sizeof *value);
    influence_of(s, lagrangian_of(o, o->system->chain, body), e);
    nh_tape *tape = nh_model_tape(o, count, e);
    nh_tape_work *work = nh_tape_work_create(tape);
    bool good = true, moves = false;
    for (size_t p = 0; p < o->chart->probes && good; p++) {
        const double *point = o->chart->probe + p * o->width, *other = o->chart->probe + (p + 1) % o->chart->probes * o->width;
        nh_tape_eval(tape, work, point, value);
        good = nh_all_finite(count, value) && (!s->levels || closed_without_currents(s, tape, work, point, other, value));
        for (size_t i = 0; i < n && good; i++) moves |= fabs(value[n * n + 2 * n + i]) > nothing;
        good = good && vanishes_for_kept(s, n, value);
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(value);
    nh_free(e);
    return good && moves;
}

/* By the parameters of its mass and inertia, where it has some; else by what its weight changes. */
static bool body_is_idle(const nh_closed_subsystem *s, size_t body, const bool *idle)
{
    const nh_model *o = s->model;
    const nh_body *b = &o->system->chain->body[body];
    size_t n = o->system->parameters;
    bool any = false, good = is_idle(o->dag, b->mass, n, o->parameter, idle);
    for (int i = 0; i < 9 && good; i++) good = is_idle(o->dag, b->inertia[i], n, o->parameter, idle);
    for (size_t i = 0; i < n; i++) {
        any |= nh_depends(o->dag, b->mass, o->parameter[i]);
        for (int j = 0; j < 9; j++) any |= nh_depends(o->dag, b->inertia[j], o->parameter[i]);
    }
    return any ? good : body_has_no_influence(s, body);
}

void nh_closed_subsystem_idle_words(const nh_closed_subsystem *s, nh_text *out)
{
    const nh_model *o = s->model;
    const nh_chain *chain = o->system->chain;
    size_t n = o->system->parameters, names = 0, total = n + (chain ? chain->bodies : 0);
    bool *idle = nh_alloc_array(n + 1, sizeof *idle);
    const char **name = nh_alloc_array(total + 1, sizeof *name);
    for (size_t i = 0; i < n; i++)
        if ((idle[i] = nh_dependency_graph_ignores(&s->network, o->parameter[i]))) name[names++] = nh_name_of(o->dag, o->parameter[i]);
    if (names) {
        nh_text_add(out, names == 1 ? "the parameter " : "the parameters ");
        list_names(names, name, out);
        nh_text_add(out, names == 1 ? " has no influence" : " have no influence");
    }
    names = 0;
    for (size_t b = 0; chain && b < chain->bodies; b++)
        if (body_is_idle(s, b, idle)) name[names++] = chain->body[b].name;
    if (names) {
        bool first = !nh_text_string(out)[0];
        nh_text_add(out, names == 1 ? first ? "the body " : ", nor the body " : first ? "the bodies " : ", nor the bodies ");
        list_names(names, name, out);
        if (first) nh_text_add(out, names == 1 ? " has no influence" : " have no influence");
    }
    nh_free(name);
    nh_free(idle);
}
