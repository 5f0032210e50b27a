/* export_meaning: exported functions are the equations of motion, their currents and their reductions, by other parts
 * of the program and by differences. */
#include "exported.h"
#include "exported_systems.h"

#include "document/export.h"
#include "geometry/bordered.h"
#include "reduction/reduced.h"
#include "scratch.h"
#include "sweep.h"

enum { probes = 3 };

static nh_export *make(const exported_system *s, const char *of)
{
    char path[SCRATCH];
    snprintf(path, sizeof path, "systems/%s.yaml", s->name);
    if (s->text) cr_assert(scratch_text(path, s->text));
    nh_export *x = exported_make(path, of, NULL);
    if (s->text) remove(path);
    return x;
}

/* The results of a function at arguments of one's own; NULL: the usual ones. */
static exported_call run(const nh_export *x, const char *name, size_t probe, const double *const *argument)
{
    const nh_export_function *f = exported_function(x, name);
    cr_assert_not_null(f, "%s has no %s", x->system->name, name);
    exported_call c = exported_call_make(x, f, probe);
    for (size_t a = 0; argument && a < f->arguments; a++)
        if (argument[a]) memcpy(c.argument[a], argument[a], f->argument[a].rows * sizeof(double));
    exported_run(x, f, &c);
    return c;
}

static void expect_near(const nh_export *x, const char *what, size_t n, const double *got, const double *want,
                        double allowed)
{
    double size = 1;
    for (size_t i = 0; i < n; i++) size = fmax(size, fabs(want[i]));
    for (size_t i = 0; i < n; i++)
        cr_expect(fabs(got[i] - want[i]) <= allowed * size, "%s, %s[%zu]: %.15g, not %.15g", x->system->name, what, i,
                  got[i], want[i]);
}

/* The chart's own values at a point (t, q, w, u). */
static void model_values(const nh_export *x, size_t n, const nh_ex *e, const double *point, double *out)
{
    const nh_model *o = x->model;
    nh_ex *in = nh_alloc_array(o->width + 1, sizeof *in);
    nh_tape *tape = nh_model_tape(o, n, e);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, point, out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(in);
}

/* ---- equations, momenta, submanifold ---- */

static void check_equations(const nh_export *x, size_t probe)
{
    const nh_model *o = x->model;
    const nh_chart *c = o->chart;
    size_t m = o->m, k = o->k, n = o->n;
    double *z = nh_alloc_array(c->width + 3 * m + k + n + 10, sizeof *z), *v = z + c->width, *a = v + m, *want = a + m;
    memcpy(z, c->probe + probe * c->width, c->width * sizeof *z);
    z[0] = exported_time;
    if (!nh_chart_complete(c, z)) {
        nh_free(z);
        return;
    }
    model_values(x, m, o->rho, z, v);
    const double *const both[] = {z + 1, v}, *const state[] = {z + 1, NULL};
    nh_bordered *b = nh_bordered_create(o);
    exported_call full = run(x, "accelerations", probe, both), rate = run(x, "rates", probe, state),
                  back = run(x, "state_of", probe, both);
    bool usable = nh_bordered_accelerations(b, z[0], z + 1, v, a) && full.good && nh_all_finite(m, a);
    nh_bordered_free(b);
    if (usable) {
        expect_near(x, "accelerations", m, full.result[0], a, 1e-9);
        model_values(x, n, o->a, z, want);
        expect_near(x, "rates of velocities", n, rate.result[0] + m, want, 1e-11);
        expect_near(x, "rates of coordinates", m, rate.result[0], v, 1e-11);
        expect_near(x, "state", m + n, back.result[0], z + 1, 1e-11);
    }
    if (usable && k) {
        exported_call forces = run(x, "multipliers", probe, state);
        model_values(x, k, o->mu, z, want);
        expect_near(x, "multipliers", k, full.result[1], want, 1e-9);
        expect_near(x, "multipliers on the submanifold", k, forces.result[0], want, 1e-11);
        expect_near(x, "reactions", m, full.result[2], forces.result[1], 1e-9);
        exported_call_clear(&forces);
    }
    exported_call_clear(&full);
    exported_call_clear(&rate);
    exported_call_clear(&back);
    nh_free(z);
}

/* Velocities have momenta, which have these velocities. */
static void check_momenta(const nh_export *x, size_t probe)
{
    exported_call p = run(x, "momenta", probe, NULL);
    const nh_export_function *f = exported_function(x, "velocities_of_momenta"),
                             *sub = exported_function(x, "submanifold_state_of_momenta");
    bool finite = p.good && nh_all_finite(x->model->m, p.result[0]);
    if (f && finite) {
        const double *const from[] = {p.argument[0], p.result[0], p.argument[1]};
        exported_call v = run(x, f->name, probe, from);
        cr_expect(v.good, "%s", x->system->name);
        expect_near(x, "velocities of momenta", x->model->m, v.result[0], p.argument[1], 1e-9);
        exported_call_clear(&v);
    }
    if (sub && finite) {
        exported_call own = run(x, "submanifold_momenta", probe, NULL);
        const double *const from[] = {own.argument[0], own.result[0], own.argument[0] + x->model->m};
        exported_call state = run(x, sub->name, probe, from);
        expect_near(x, "state of momenta", x->model->m + x->model->n, state.result[0], own.argument[0], 1e-9);
        exported_call_clear(&own);
        exported_call_clear(&state);
    }
    exported_call_clear(&p);
}

Test(export_meaning, equations)
{
    for (size_t i = 0; i < EXPORTED_SYSTEMS; i++) {
        if (!sweep_tries(i, 8, 16)) continue;
        nh_export *x = make(&EXPORTED[i], "equations, momenta, submanifold");
        for (size_t p = 0; p < probes; p++) {
            check_equations(x, p);
            check_momenta(x, p);
        }
        nh_export_free(x);
    }
}

/* ---- currents ---- */

/* Their gradients are those of differences, and orthogonal to the motion. */
static void check_currents(const nh_export *x, size_t probe)
{
    static const double h = 1e-5;
    const nh_export_function *f = exported_function(x, "submanifold_current_gradients");
    if (!f) return;
    exported_call slope = run(x, f->name, probe, NULL), rate = run(x, "rates", probe, NULL);
    size_t count = f->result[0].rows, n = f->result[0].columns, size = f->argument[0].rows;
    double *z = nh_alloc_array(size + 1, sizeof *z);
    for (size_t k = 0; k < count && slope.good && rate.good; k++) {
        double *g = slope.result[0] + k * n, along = g[0], terms = fabs(g[0]);
        for (size_t j = 0; j < size; j++)
            along += g[1 + j] * rate.result[0][j], terms += fabs(g[1 + j] * rate.result[0][j]);
        if (isfinite(terms))
            cr_expect(fabs(along) <= 1e-9 * (1 + terms), "%s: %s changes by %g", x->system->name, f->result[0].label[k],
                      along);
    }
    for (size_t j = 0; j < size && slope.good && nh_all_finite(count * n, slope.result[0]); j++) {
        const double *const from[] = {z, NULL};
        exported_call side[2];
        for (int s = 0; s < 2; s++) {
            memcpy(z, slope.argument[0], size * sizeof *z);
            z[j] += s ? h : -h;
            side[s] = run(x, "submanifold_currents", probe, from);
        }
        for (size_t k = 0; k < count; k++) {
            double want = (side[1].result[0][k] - side[0].result[0][k]) / (2 * h), got = slope.result[0][k * n + 1 + j],
                   all = 1 + fabs(want) + fabs(side[0].result[0][k]);
            if (isfinite(want))
                cr_expect(fabs(got - want) <= 1e-6 * all, "%s: d%s/d%zu is %g, not %g", x->system->name,
                          f->result[0].label[k], j, got, want);
        }
        exported_call_clear(&side[0]);
        exported_call_clear(&side[1]);
    }
    nh_free(z);
    exported_call_clear(&slope);
    exported_call_clear(&rate);
}

/* The same in all coordinates, where both are written. */
static void check_in_velocities(const nh_export *x, size_t probe)
{
    const nh_export_function *f = exported_function(x, "currents"), *own = exported_function(x, "submanifold_currents");
    if (!f || f->result[0].rows != own->result[0].rows) return;
    exported_call a = run(x, f->name, probe, NULL), b = run(x, own->name, probe, NULL);
    if (a.good && b.good && nh_all_finite(f->result[0].rows, b.result[0]))
        expect_near(x, "currents", f->result[0].rows, a.result[0], b.result[0], 1e-9);
    exported_call_clear(&a);
    exported_call_clear(&b);
}

Test(export_meaning, currents, PLAIN_ONLY)
{
    size_t systems = 0;
    for (size_t i = 0; i < EXPORTED_SYSTEMS; i++) {
        if (!sweep_tries(i, 7, 14)) continue;
        nh_export *x = make(&EXPORTED[i], "currents, submanifold");
        for (size_t p = 0; p < probes; p++) {
            check_currents(x, p);
            check_in_velocities(x, p);
        }
        systems += exported_function(x, "submanifold_currents") != NULL;
        nh_export_free(x);
    }
    cr_expect_gt(systems, 2);
}

/* ---- reductions ---- */

/* Rates and body velocity by the reduction's own tapes. */
static void check_stage(const nh_export *x, size_t i, size_t probe)
{
    const nh_reduced *o = x->reduction->stage[i].shown;
    char name[40];
    snprintf(name, sizeof name, "stage%zu", i + 1);
    exported_call c = run(x, name, probe, NULL);
    double *rate = nh_alloc_array(o->n + o->r + o->d + 1, sizeof *rate), *zeta = rate + o->n + o->r;
    nh_reduced_flow *flow = nh_reduced_flow_create(o);
    nh_reduced_flow_time(flow, exported_time);
    if (c.good && nh_reduced_flow_at(flow, c.argument[0], rate, NULL, zeta, NULL)) {
        expect_near(x, name, o->n + o->r, c.result[0], rate, 1e-10);
        if (o->d) expect_near(x, "zeta", o->d, c.result[1], zeta, 1e-10);
    }
    nh_reduced_flow_free(flow);
    nh_free(rate);
    exported_call_clear(&c);
}

/* Where the place is at a later time, along the reduced motion: `group` and `state` moved by their rates. */
static void place_at(const nh_export *x, const char *name, size_t probe, const exported_call *stage,
                     const exported_call *group, size_t state, size_t d, double h, double *q, size_t m)
{
    double *z = nh_alloc_array(state + d + 1, sizeof *z), *theta = z + state;
    for (size_t k = 0; k < state; k++) z[k] = stage->argument[0][k] + h * stage->result[0][k];
    for (size_t a = 0; a < d; a++) theta[a] = group->argument[state > 0][a] + h * group->result[0][a];
    const double *const from[] = {state ? z : theta, theta};
    exported_call c = run(x, name, probe, from);
    memcpy(q, c.result[0], m * sizeof *q);
    exported_call_clear(&c);
    nh_free(z);
}

/* The velocity of the reconstructed place satisfies the constraints, and has the energy of the stage. */
static void check_place(const nh_export *x, size_t i, size_t probe, size_t *checked)
{
    double h = 1e-5; /* of the time in which something changes by its size */
    const nh_reduction_stage *s = &x->reduction->stage[i];
    char name[4][40];
    static const char *const suffix[] = {"", "_group", "_place", "_energy"};
    for (int k = 0; k < 4; k++) snprintf(name[k], sizeof name[k], "stage%zu%s", i + 1, suffix[k]);
    if (!exported_function(x, name[2]) || s->shown_slice->kinetic != x->reduction->kinetic) return;
    size_t m = s->shown_slice->m, size = s->shown->n + s->shown->r, d = s->shown->d, k = x->model->k;
    exported_call stage = run(x, name[0], probe, NULL), group = run(x, name[1], probe, NULL),
                  energy = run(x, name[3], probe, NULL);
    double *q = nh_alloc_array(4 * m + 1, sizeof *q), *later = q + m, *before = later + m, *v = before + m;
    if (stage.good && group.good && size) {
        double fastest = 1;
        for (size_t r = 0; r < size; r++) fastest = fmax(fastest, fabs(stage.result[0][r]));
        for (size_t a = 0; a < d; a++) fastest = fmax(fastest, fabs(group.result[0][a]));
        h /= fastest;
        place_at(x, name[2], probe, &stage, &group, size, d, 0, q, m);
        place_at(x, name[2], probe, &stage, &group, size, d, h, later, m);
        place_at(x, name[2], probe, &stage, &group, size, d, -h, before, m);
        for (size_t r = 0; r < m; r++) v[r] = (later[r] - before[r]) / (2 * h);
        const double *const from[] = {q, v};
        exported_call terms = run(x, "terms", probe, from), full = run(x, "energy", probe, from);
        double *violation = terms.result[4], speed = 1;
        for (size_t r = 0; r < m; r++) speed = fmax(speed, fabs(v[r]));
        for (size_t a = 0; a < k && isfinite(speed); a++)
            cr_expect(fabs(violation[a]) <= 1e-7 * speed, "%s, stage %zu: constraint %zu is off by %g", x->system->name,
                      i + 1, a + 1, violation[a]);
        if (x->reduction->kinetic->linear && isfinite(energy.result[0][0]))
            expect_near(x, name[3], 1, full.result[0], energy.result[0], 1e-6);
        *checked += isfinite(speed);
        exported_call_clear(&terms);
        exported_call_clear(&full);
    }
    nh_free(q);
    exported_call_clear(&stage);
    exported_call_clear(&group);
    exported_call_clear(&energy);
}

Test(export_meaning, reductions)
{
    size_t checked = 0;
    for (size_t i = 0; i < EXPORTED_SYSTEMS; i++) {
        if (!sweep_tries(i, 8, 16)) continue;
        nh_export *x = make(&EXPORTED[i], "equations, reduced");
        for (size_t s = 0; x->reduction && s < x->reduction->stages; s++)
            for (size_t p = 0; p < probes; p++) {
                check_stage(x, s, p);
                check_place(x, s, p, &checked);
            }
        nh_export_free(x);
    }
    cr_expect_gt(checked, 5);
    cr_log_info("%zu places", checked);
}
