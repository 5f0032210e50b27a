/* closed_subsystem_idle: what has no influence on the observables: parameters, and bodies.
 *
 * The Lagrangian of a body b may be given a weight 1 + eps.  M and A are linear in the Lagrangian, so that M a = A
 * gives
 *
 *     da/d eps = M^-1 (A_b - M_b a),     M_b, A_b: those of L_b = 1/2 <V, I V> + m g . x alone, without forces;
 *
 * where this vanishes for the velocities that are kept, how heavy the body is does not matter to them. */
#include <math.h>
#include <string.h>

#include "exact/ball.h"
#include "exact/solve.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"
#include "graph/terms.h"
#include "integrals/exact_points.h"
#include "motion/closed_subsystem.h"

enum { ball_bits = 256, zero_digits = 40, wanted_points = 2, most_tries = 40 };

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

static nh_ex lagrangian_of(const nh_model *model, const nh_chain *chain, size_t body)
{
    nh_dag *d = model->dag;
    const nh_body *b = &chain->body[body];
    nh_pose pose;
    nh_twist twist;
    nh_chain_frame(chain, d, (long)body, 0, &pose, &twist);
    nh_inertia inertia = nh_body_inertia(d, b);
    nh_wrench momentum = nh_inertia_momentum(d, &inertia, &twist);
    return nh_add(d, nh_mul(d, nh_ratio(d, 1, 2), nh_pairing(d, &twist, &momentum)),
                  nh_mul(d, b->mass, nh_dot(d, chain->gravity, b->position)));
}

/* A_b - M_b a (n), and dL_b/dw (n). */
static void influence_of(const nh_model *model, nh_ex L, nh_ex *influence, nh_ex *momentum)
{
    nh_dag *d = model->dag;
    size_t n = model->n, m = model->m;
    nh_ex *p = nh_alloc_array(m + 1, sizeof *p), lbar = nh_model_compose(model, L);
    for (size_t i = 0; i < m; i++) p[i] = nh_model_compose(model, nh_diff(d, L, model->system->coordinate[i].v));
    for (size_t i = 0; i < n; i++) {
        nh_ex sum = nh_int(d, 0);
        for (size_t k = 0; k < m; k++) {
            nh_ex force = nh_sub(d, nh_model_compose(model, nh_diff(d, L, model->system->coordinate[k].q)),
                                 nh_model_X0(model, p[k]));
            for (size_t j = 0; j < n; j++) force = nh_sub(d, force, nh_mul(d, nh_model_Y(model, j, p[k]), model->a[j]));
            sum = nh_add(d, sum, nh_mul(d, model->R[k * n + i], force));
        }
        influence[i] = sum;
        momentum[i] = nh_model_Y(model, i, lbar);
    }
    nh_free(p);
}

/* Does the sum of factor[i] e[i] vanish to more digits than its terms cancel by chance? */
static bool cancels(const nh_model *model, nh_ball *ball, size_t n, const nh_ex *factor, const nh_ex *e)
{
    nh_dag *d = model->dag;
    nh_ex *term = NULL;
    size_t count = 0, capacity = 0;
    double bound, ratio, most = -INFINITY;
    bool good = true;
    for (size_t i = 0; i < n; i++) {
        nh_ex *of;
        size_t terms = nh_terms_of(d, e[i], &of);
        nh_grow(&term, &capacity, count + terms, sizeof *term);
        for (size_t k = terms > 1; k < terms; k++)
            term[count++] = nh_model_values(model, factor ? nh_mul(d, factor[i], of[k]) : of[k]);
        nh_free(of);
    }
    for (size_t i = 0; i < count && good; i++) {
        good = nh_ball_log10_bound(ball, term[i], &bound);
        most = fmax(most, bound);
    }
    if (good && most > -INFINITY) good = nh_ball_relative_sum(ball, count, term, &ratio) && ratio < -zero_digits;
    nh_free(term);
    return good;
}

/* Row j of M^-1 (A_b - M_b a), for the velocities that are kept. */
static bool vanishes_for_kept(const nh_closed_subsystem *s, nh_ball *ball, const nh_ex *influence)
{
    const nh_model *model = s->model;
    nh_ex *row = nh_alloc_array(model->n + 1, sizeof *row);
    bool good = true;
    for (size_t j = 0; j < s->kept + s->levels && good; j++) {
        if (s->state[j] < model->m) continue;
        for (size_t i = 0; i < model->n; i++) row[i] = nh_int(model->dag, i == s->state[j] - model->m);
        nh_lu_solve(model->M_lu, row, row);
        good = cancels(model, ball, model->n, row, influence);
    }
    nh_free(row);
    return good;
}

/* With currents: are those states a closed subsystem without the currents as well?  Then their rates do not depend on
 * dropped states. */
static bool closed_without_currents(const nh_closed_subsystem *s, nh_ball *ball)
{
    const nh_model *model = s->model;
    bool good = true;
    for (size_t i = 0; i < s->kept + s->levels; i++)
        for (size_t j = s->kept + s->levels; j < s->states && good; j++) {
            if (s->state[i] < model->m) continue;
            nh_ex slope = nh_diff(model->dag, model->a[s->state[i] - model->m], model->chart->symbol[1 + s->state[j]]);
            good = nh_is_zero(model->dag, slope) || cancels(model, ball, 1, NULL, &slope);
        }
    return good;
}

/* A body whose weight changes nothing at random points, and that moves with a dropped state (otherwise its energy may
 * be watched). */
static bool body_has_no_influence(const nh_closed_subsystem *s, size_t body)
{
    const nh_model *model = s->model;
    size_t n = model->n, points = 0;
    if (s->implicit || !n || !model->M_lu) return false;
    nh_ex *influence = nh_alloc_array(2 * n, sizeof *influence), *momentum = influence + n;
    influence_of(model, lagrangian_of(model, model->system->chain, body), influence, momentum);
    nh_ball *ball = nh_ball_create(model->dag, ball_bits);
    uint64_t state = 1;
    bool good = true, moves = false;
    nh_exact_parameters(model, ball);
    for (int tries = 0; tries < most_tries && points < wanted_points && good; tries++) {
        if (!nh_exact_point(model, ball, &state)) continue;
        points++;
        good = (!s->levels || closed_without_currents(s, ball)) && vanishes_for_kept(s, ball, influence);
        for (size_t j = s->kept + s->levels; j < s->states && good; j++)
            if (s->state[j] >= model->m) moves |= !cancels(model, ball, 1, NULL, &momentum[s->state[j] - model->m]);
    }
    nh_ball_free(ball);
    nh_free(influence);
    return good && moves;
}

/* Has the body no influence?  Judged by the parameters of its mass and inertia where it has some; otherwise by its
 * weight. */
static bool body_is_idle(const nh_closed_subsystem *s, size_t body, const bool *idle)
{
    const nh_model *model = s->model;
    const nh_body *b = &model->system->chain->body[body];
    size_t n = model->system->parameters;
    bool any = false, good = is_idle(model->dag, b->mass, n, model->parameter, idle);
    for (int i = 0; i < 9 && good; i++) good = is_idle(model->dag, b->inertia[i], n, model->parameter, idle);
    for (size_t i = 0; i < n; i++) {
        any |= nh_depends(model->dag, b->mass, model->parameter[i]);
        for (int j = 0; j < 9; j++) any |= nh_depends(model->dag, b->inertia[j], model->parameter[i]);
    }
    return any ? good : body_has_no_influence(s, body);
}

void nh_closed_subsystem_idle_words(const nh_closed_subsystem *s, nh_text *out)
{
    const nh_model *model = s->model;
    const nh_chain *chain = model->system->chain;
    size_t n = model->system->parameters, names = 0, total = n + (chain ? chain->bodies : 0);
    bool *idle = nh_alloc_array(n + 1, sizeof *idle);
    const char **name = nh_alloc_array(total + 1, sizeof *name);
    for (size_t i = 0; i < n; i++)
        if ((idle[i] = nh_dependency_graph_ignores(&s->graph, model->parameter[i])))
            name[names++] = nh_name_of(model->dag, model->parameter[i]);
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
        nh_text_add(out, names == 1 ? first ? "the body " : ", nor the body "
                         : first    ? "the bodies "
                                    : ", nor the bodies ");
        list_names(names, name, out);
        if (first) nh_text_add(out, names == 1 ? " has no influence" : " have no influence");
    }
    nh_free(name);
    nh_free(idle);
}
