/* Many motions at once: each is that of a motion of its own; the coefficients are those of the method. */
#include "mechanics.h"
#include "motion/ensemble.h"
#include "motion/integrators.h"

enum { COUNT = 5 };

/* sum b_i = 1, sum b_i c_i^p = 1/(p+1) up to p = 7, rows add up to c, and some of the coupled conditions. */
Test(ensemble, coefficients_satisfy_the_order_conditions)
{
    nh_tableau t;
    cr_assert(nh_tableau_rk8pd(&t));
    cr_assert_eq(t.stages, 13);
    for (int p = 0; p < 8; p++) {
        double sum = 0, coupled = 0;
        for (int i = 0; i < t.stages; i++) {
            sum += t.b[i] * pow(t.c[i], p);
            for (int j = 0; j < i; j++) coupled += t.b[i] * t.a[i][j] * pow(t.c[j], p);
        }
        cr_expect_float_eq(sum, 1.0 / (p + 1), 1e-13, "%d: %g", p, sum);
        if (p < 7) cr_expect_float_eq(coupled, 1.0 / (p + 1) / (p + 2), 1e-12, "%d: %g", p, coupled);
    }
    double error = 0;
    for (int i = 0; i < t.stages; i++) {
        double row = 0;
        for (int j = 0; j < i; j++) row += t.a[i][j];
        cr_expect_float_eq(row, t.c[i], 1e-13);
        error += t.e[i];
    }
    cr_expect_float_eq(error, 0, 1e-13);
}

static void request_of(nh_trajectory_request *q, const nh_model *o, const nh_options *options, double *times, double until, size_t n, const nh_ex *e)
{
    for (int i = 0; i < COUNT; i++) times[i] = until * i / (COUNT - 1);
    *q = (nh_trajectory_request){.model = o, .count = COUNT, .times = times, .options = options, .n = n, .e = e};
}

/* Member k against a trajectory by itself, in all coordinates where its chart ends. */
static void compare_alone(const nh_ensemble *all, size_t k, nh_trajectory_request q, const double *z0, const char *path)
{
    const nh_model *o = q.model;
    nh_error error = {0};
    double *point = nh_alloc_array(o->width + o->m, sizeof *point), *v = point + o->width, *q0 = nh_alloc_array(o->m, sizeof *q0);
    memcpy(point + 1, z0, (o->m + o->n) * sizeof *point);
    memcpy(q0, z0, o->m * sizeof *q0);
    values_at(o, o->m, o->rho, point, v);
    nh_state state = {.q = q0, .v = v};
    q.initial = &state;
    nh_trajectory *own = nh_trajectory_create(&q, &error);
    cr_assert(own && own->motion->complete, "%s, member %zu", path, k);
    for (size_t i = 0; i < COUNT * q.n; i++) {
        double a = all->value[k * COUNT * q.n + i], b = own->value[i];
        cr_expect_float_eq(a, b, 1e-6 * (1 + fabs(b)), "%s, member %zu: %.12g, not %.12g", path, k, a, b);
    }
    nh_trajectory_free(own);
    nh_free(q0);
    nh_free(point);
}

/* Members of several batches and threads against motions of their own. */
static size_t compare(const char *path, nh_chart_choice choice, size_t members, const double *z0, double spread, double until, size_t threads)
{
    mechanics x = mechanics_of_file(path, choice, 0, NULL);
    nh_model *o = x.model;
    size_t size = o->m + o->n, n = o->m + 1;
    double times[COUNT], *initial = nh_alloc_array(members, size * sizeof *initial);
    nh_options options;
    nh_error error = {0};
    nh_trajectory_request q;
    nh_options_default(&options);
    options.tolerance = 1e-9;
    nh_ex *e = nh_alloc_array(n, sizeof *e);
    memcpy(e, o->rho, o->m * sizeof *e);
    e[o->m] = o->E;
    request_of(&q, o, &options, times, until, n, e);
    nh_ensemble_states(size, z0, members, spread, 5, initial);
    nh_ensemble *all = nh_ensemble_create(&q, members, initial, threads, &error);
    must(all != NULL, &error, path);
    cr_expect_eq(all->incomplete, 0, "%s", all->note);
    for (size_t k = 0; k < members; k += members / 30 + 1) {
        nh_ensemble *one = nh_ensemble_create(&q, 1, initial + k * size, 1, &error);
        compare_alone(all, k, q, initial + k * size, path);
        for (size_t i = 0; i < COUNT * n; i++) {
            double a = all->value[k * COUNT * n + i], b = one->value[i];
            cr_expect_float_eq(a, b, 1e-6 * (1 + fabs(b)), "%s, member %zu: %.12g, not %.12g", path, k, a, b);
        }
        nh_dynamics *d = nh_dynamics_create(o);
        nh_flow_problem problem = nh_dynamics_problem(d);
        nh_flow_options how = {.rtol = 1e-12};
        nh_motion *motion = nh_gsl_odeiv(NH_RK8PD, &problem, initial + k * size, COUNT, times, &how, &error);
        if (all->alone == 0 && motion && motion->complete) {
            double *value = nh_alloc_array(COUNT * n, sizeof *value);
            nh_along(d, motion, n, e, value);
            for (size_t i = 0; i < COUNT * n; i++)
                cr_expect_float_eq(all->value[k * COUNT * n + i], value[i], 1e-6 * (1 + fabs(value[i])), "%s, member %zu: %.12g, not %.12g", path, k,
                                   all->value[k * COUNT * n + i], value[i]);
            nh_free(value);
        }
        nh_motion_free(motion);
        nh_dynamics_free(d);
        nh_ensemble_free(one);
    }
    size_t alone = all->alone;
    nh_ensemble_free(all);
    nh_free(initial);
    nh_free(e);
    mechanics_clear(&x);
    return alone;
}

Test(ensemble, members_are_motions_of_their_own)
{
    const double sleigh[5] = {0.3, 0, 0, 2, 0.7}, contact[8] = {1, 0.2, 0.3, 0.9, 0.5, -0.4, 0.7, 0.1};
    cr_expect_eq(compare("systems/sleigh.yaml", NH_CHART_QUASI, 300, sleigh, 0.3, 4, 2), 0);
    cr_expect_eq(compare("systems/contact_oscillator.yaml", NH_CHART_AUTO, 131, contact, 0.2, 7, 1), 0);
    cr_expect_eq(compare("systems/isotropic_oscillator.yaml", NH_CHART_AUTO, 1, contact, 0.2, 3, 1), 0);
}

/* In the chart (phi', x') some members cross cos phi = 0: these are computed alone, in all coordinates, and right. */
Test(ensemble, members_that_leave_the_chart)
{
    const double z0[5] = {0.3, 0, 0, 0.5, 0.1};
    size_t alone = compare("systems/sleigh.yaml", NH_CHART_COORDINATES, 60, z0, 0.9, 3, 2);
    cr_expect(alone > 0 && alone < 60, "%zu", alone);
}

/* A skate's heading does not mind that its chart ends: all members together. */
Test(ensemble, members_that_the_end_of_a_chart_does_not_concern)
{
    mechanics x = mechanics_of_file("systems/knife_edge.yaml", NH_CHART_AUTO, 0, NULL);
    double times[COUNT], initial[20 * 5], z0[5] = {0};
    nh_options options;
    nh_error error = {0};
    nh_trajectory_request q;
    nh_ex heading = formula(x.model, "p");
    nh_options_default(&options);
    z0[3] = 0.4, z0[4] = 1;
    for (size_t i = 0; i < 20; i++) memcpy(initial + 5 * i, z0, sizeof z0), initial[5 * i + 4] += 0.01 * (double)i;
    request_of(&q, x.model, &options, times, 8, 1, &heading);
    q.smallest = true;
    nh_ensemble *all = nh_ensemble_create(&q, 20, initial, 2, &error);
    must(all != NULL, &error, "knife_edge");
    cr_expect_eq(all->alone, 0, "%zu", all->alone);
    double turned = all->value[20 * COUNT - 1], rate = initial[19 * 5 + 4];
    cr_expect(fabs(turned - 8 * rate) < 1e-9 || fabs(turned - 8 * initial[19 * 5 + 3]) < 1e-9, "%.15g", turned);
    nh_ensemble_free(all);
    mechanics_clear(&x);
}

Test(ensemble, states_lie_around_the_first)
{
    const double z0[3] = {0, -4, 0.5};
    double z[40][3], low[3] = {9, 9, 9}, high[3] = {-9, -9, -9};
    nh_ensemble_states(3, z0, 40, 0.25, 3, z[0]);
    for (int i = 0; i < 3; i++) cr_expect_eq(z[0][i], z0[i]);
    for (int k = 1; k < 40; k++)
        for (int i = 0; i < 3; i++) low[i] = fmin(low[i], z[k][i]), high[i] = fmax(high[i], z[k][i]);
    for (int i = 0; i < 3; i++) {
        double reach = 0.25 * fmax(1, fabs(z0[i]));
        cr_expect(low[i] >= z0[i] - reach && high[i] <= z0[i] + reach && high[i] - low[i] > 1.6 * reach, "%d: %g %g", i, low[i], high[i]);
    }
}
