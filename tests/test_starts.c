/* starts: motions from the states in which people begin, straight, upright, at rest, at any lean and steer, and through the places where a
 * chart is singular.  The constraints are those of the bordered equations, which no chart takes part in; the other method is IDA. */
#include <stdio.h>

#include "mechanics.h"
#include "sweep.h"
#include "commands/simulate.h"
#include "graph/node.h"
#include "motion/dynamics.h"
#include "motion/trajectory.h"

#define FOLDER "tests/data/wheeled/"

/* ---- velocities at a start ---- */

static size_t coordinate_named(const nh_system *s, const char *name)
{
    for (size_t i = 0; i < s->coordinates; i++)
        if (!strcmp(s->coordinate[i].name, name)) return i;
    cr_assert(false, "no coordinate %s", name);
    return 0;
}

/* The largest constraint at a state of m positions and m velocities, whose rows have length 1. */
static double violation(nh_bordered *b, size_t m, size_t k, double t, const double *state)
{
    double *K = nh_alloc_array(m * m + m + k * m + 2 * k, sizeof *K), *h = K + m * m, *F = h + m, *g = F + k * m, *f = g + k, worst = 0;
    bool good = nh_bordered_terms(b, t, state, state + m, K, h, F, g, f);
    for (size_t a = 0; a < k; a++) worst = fmax(worst, fabs(f[a]));
    nh_free(K);
    return good ? worst : INFINITY;
}

typedef struct {
    const char *file, *position[3], *given[3];
} vehicle;

/* The given velocities determine all others at every place but the last one's. */
static const vehicle VEHICLES[] = {{"bicycle", {"yaw", "steer", "roll"}, {"qr", "steer", "roll"}},
                                   {"tricycle", {"yaw", "steer", "qf"}, {"p", "steer", NULL}},
                                   {"cart", {"yaw", "lean", "p"}, {"p", "q", "lean"}},
                                   {"trailer", {"yaw", "steer", "hitch"}, {"x", "steer", NULL}}};
static const double PLACES[] = {0, 1e-9, 0.01, 0.3, -0.7, 1.5707963267948966, 3.141592653589793};
enum { places = sizeof PLACES / sizeof *PLACES };

static void start_vehicle(const vehicle *c, mechanics *x, nh_dynamics *d, nh_bordered *b, size_t which, double speed)
{
    size_t m = x->model->m, index[3] = {which % places, which / places % places, which / places / places};
    double *q = nh_alloc_array(6 * m + 2, sizeof *q), *v = q + m, *z = v + m, *y = z + 2 * m;
    bool *given = nh_alloc_array(m, sizeof *given);
    nh_error error = {0};
    for (size_t i = 0; i < 3; i++) {
        q[coordinate_named(x->system, c->position[i])] = PLACES[index[i]];
        if (!c->given[i]) continue;
        size_t s = coordinate_named(x->system, c->given[i]);
        given[s] = true, v[s] = i == 0 ? speed : 0.1 * speed;
    }
    nh_state state = {.q = q, .v = v, .given = given};
    bool good = nh_dynamics_start_all(d, &state, false, z, y + m, &error);
    memcpy(y, q, m * sizeof *y);
    cr_expect(good, "%s at %g, %g, %g: %s", c->file, PLACES[index[0]], PLACES[index[1]], PLACES[index[2]], error.what);
    double off = good ? violation(b, m, x->model->k, 0, y) : 0, size = 0;
    for (size_t s = 0; s < m; s++) size = fmax(size, fabs(y[m + s]));
    cr_expect(off <= 1e-12 * fmax(size, 1), "%s at %g, %g, %g: the constraints are off by %g", c->file, PLACES[index[0]], PLACES[index[1]], PLACES[index[2]], off);
    for (size_t s = 0; s < m && good; s++) cr_expect(!given[s] || fabs(y[m + s] - v[s]) <= 1e-12 * speed, "%s: %s'", c->file, x->system->coordinate[s].name);
    nh_free(given);
    nh_free(q);
}

/* A wheel that lies flat on the ground has no lowest point.  A car that moves has no velocity x' across itself, or with its steering across. */
static bool possible(const vehicle *c, size_t which, bool moving)
{
    double yaw = PLACES[which % places], steer = PLACES[which / places % places], last = PLACES[which / places / places];
    if (!strcmp(c->file, "bicycle") && fabs(cos(last)) < 0.1) return false;
    return !moving || strcmp(c->file, "trailer") || (fabs(cos(yaw)) > 0.1 && fabs(cos(steer)) > 0.1);
}

static void start_everywhere(const vehicle *c, size_t settings, const nh_setting *setting, size_t one_in)
{
    char path[100];
    snprintf(path, sizeof path, FOLDER "%s.yaml", c->file);
    mechanics x = mechanics_of_file(path, NH_CHART_COORDINATES, settings, setting);
    nh_dynamics *d = nh_dynamics_create(x.model);
    nh_bordered *b = nh_bordered_create(x.model);
    for (size_t i = 0; i < places * places * places; i++)
        for (int moving = 0; moving < 2; moving++)
            if (sweep_tries(i, one_in, 5 * one_in) && possible(c, i, moving)) start_vehicle(c, &x, d, b, i, moving ? 2 : 0);
    nh_bordered_free(b);
    nh_dynamics_free(d);
    mechanics_clear(&x);
}

Test(starts, velocities_come_from_the_constraints_at_every_lean_and_steer)
{
    static const double rakes[] = {0.31, 0, 0.1, 0.31415926535897931, 0.6};
    for (size_t i = 1; i < sizeof VEHICLES / sizeof *VEHICLES; i++) start_everywhere(&VEHICLES[i], 0, NULL, 3);
    for (size_t i = 0; i < sizeof rakes / sizeof *rakes && (i == 0 || sweep_whole()); i++)
        start_everywhere(&VEHICLES[0], 1, &(nh_setting){.name = "rake", .value = rakes[i]}, 3);
}

/* ---- motions ---- */

static nh_simulation *motion_of(const char *path, const char *initial, double until, const char *method, double rake, nh_error *error)
{
    const nh_setting setting = {.name = "rake", .value = rake};
    const nh_method *const only[] = {method ? nh_method_find(method) : NULL};
    nh_request q = {.system_path = path, .initial = initial, .until_given = true, .step = until / 4, .methods = method != NULL, .method = only};
    if (rake >= 0) q.settings = 1, q.setting = &setting;
    nh_options_default(&q.options);
    q.options.until = until;
    q.options.steps = 20000;
    return nh_simulation_create(&q, error);
}

static double value_of(const nh_simulation *s, size_t row, const char *column)
{
    for (size_t i = 0; i < s->columns.count; i++)
        if (!strcmp(s->columns.track[i].name, column)) return s->value[row * s->columns.count + i];
    cr_assert(false, "no column %s", column);
    return NAN;
}

/* The largest constraint along the motion. */
static double violation_along(const nh_simulation *s)
{
    const nh_model *o = s->model;
    size_t m = o->m;
    double *state = nh_alloc_array(2 * m + 1, sizeof *state), worst = 0;
    nh_bordered *b = nh_bordered_create(o);
    for (size_t r = 0; r < s->motion->count; r++) {
        for (size_t i = 0; i < m; i++) {
            state[i] = value_of(s, r, nh_name_of(o->dag, o->system->coordinate[i].q));
            state[m + i] = value_of(s, r, nh_name_of(o->dag, o->system->coordinate[i].v));
        }
        worst = fmax(worst, violation(b, m, o->k, s->motion->time[r], state));
    }
    nh_bordered_free(b);
    nh_free(state);
    return worst;
}

/* Lean and its rate in a bicycle whose steering is straight: the eliminated chart is 0/0 there.  Exactly x' = 0.3 qr' and yaw' = 0. */
Test(starts, a_leaning_bicycle_steers_straight, PLAIN_ONLY)
{
    nh_error error = {0};
    nh_simulation *s = motion_of(FOLDER "bicycle.yaml", "z=0.3*cos(0.01), roll=0.01, roll'=0.05, steer'=0, qr'=5", 1e-13, NULL, 0.31, &error);
    must(s != NULL, &error, "the bicycle");
    cr_expect_float_eq(value_of(s, 0, "x'"), 1.5, 1e-13, "x' = %.17g", value_of(s, 0, "x'"));
    cr_expect_float_eq(value_of(s, 0, "yaw'"), 0, 1e-13, "yaw' = %g", value_of(s, 0, "yaw'"));
    cr_expect(violation_along(s) < 1e-9, "%g", violation_along(s));
    nh_simulation_free(s);
}

/* Straight and upright at constant speed: the symmetric motion stays so, whatever the angle of the head. */
Test(starts, straight_and_upright_motions_stay_so, PLAIN_ONLY)
{
    static const struct {
        const char *file, *initial;
        double rake;
    } cases[] = {{"bicycle", "z=0.3, qr'=5", 0.31}, {"tricycle", "x'=1.5", -1}, {"trailer", "x'=1.5", -1}, {"bicycle", "z=0.3, roll=0, steer'=0, qr'=5", 0}, {"bicycle", "z=0.3, x'=1.5", 0.6}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases && (i < 3 || sweep_whole()); i++) {
        char path[100];
        nh_error error = {0};
        snprintf(path, sizeof path, FOLDER "%s.yaml", cases[i].file);
        nh_simulation *s = motion_of(path, cases[i].initial, 2, NULL, cases[i].rake, &error);
        must(s != NULL, &error, path);
        cr_expect(s->motion->complete, "%s: %s", path, s->motion->note);
        for (size_t r = 0; r < s->motion->count; r++) {
            cr_expect_float_eq(value_of(s, r, "x"), 1.5 * s->motion->time[r], 1e-9);
            cr_expect_float_eq(value_of(s, r, "x'"), 1.5, 1e-9);
            cr_expect(fabs(value_of(s, r, "yaw")) < 1e-9 && fabs(value_of(s, r, "yaw'")) < 1e-9);
        }
        cr_expect(violation_along(s) < 1e-9, "%s: %g", path, violation_along(s));
        nh_simulation_free(s);
    }
}

/* The last state by IDA, from the first one of the motion. */
static void compare_with_ida(const nh_simulation *s, double allowed, const char *what)
{
    const nh_model *o = s->model;
    size_t m = o->m, last = s->motion->count - 1;
    double *y = nh_alloc_array(4 * m, sizeof *y), *scale = y + 2 * m, times[2] = {s->motion->time[0], s->motion->time[last]};
    nh_error error = {0};
    for (size_t i = 0; i < m; i++) {
        y[i] = value_of(s, 0, nh_name_of(o->dag, o->system->coordinate[i].q));
        y[m + i] = value_of(s, 0, nh_name_of(o->dag, o->system->coordinate[i].v));
        scale[i] = scale[m + i] = 1;
    }
    nh_bordered *b = nh_bordered_create(o);
    nh_chetaev_problem problem = nh_bordered_problem(b);
    nh_chetaev_motion *ida = nh_chetaev(&problem, y, 2, times, &(nh_flow_options){.method = NH_BDF, .rtol = 1e-10, .scale = scale, .max_steps = 1e5}, &error);
    must(ida && ida->motion->complete, &error, what);
    for (size_t i = 0; i < m; i++) {
        double off = value_of(s, last, nh_name_of(o->dag, o->system->coordinate[i].q)) - ida->motion->state[ida->motion->size + i];
        cr_expect(fabs(off) < allowed, "%s: %s is off by %g", what, o->system->coordinate[i].name, off);
    }
    nh_chetaev_motion_free(ida);
    nh_bordered_free(b);
    nh_free(y);
}

/* Through phi = pi/2, where y' does not follow, and from there, by every kind of method. */
Test(starts, motions_go_through_the_singular_places_of_charts)
{
    static const char *const methods[] = {NULL, "adams", "rk8pd", "bdf", "verner", "rkf45", "dormand-prince", "msadams"};
    static const char *const from[] = {"phi=pi/2, phi'=1.5, y'=0.4", "phi'=2, x'=0.3", "phi=pi/2", "phi=-pi/2, phi'=0.1, y'=1"};
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++)
        for (size_t j = 0; j < sizeof from / sizeof *from; j++) {
            if (!sweep_tries(i * 4 + j, 3, 11) || (i == sizeof methods / sizeof *methods - 1 && !sweep_whole())) continue;
            char what[120];
            nh_error error = {0};
            snprintf(what, sizeof what, "%s by %s", from[j], methods[i] ? methods[i] : "the automatic choice");
            nh_simulation *s = motion_of(FOLDER "skate.yaml", from[j], j == 1 || j == 2 || sweep_whole() ? 4 : 1e-13, methods[i], -1, &error);
            must(s != NULL, &error, what);
            cr_expect(s->motion->complete, "%s: %s", what, s->motion->note);
            cr_expect((s->chosen != NULL) == (j != 1), "%s: %s", what, s->chosen ? s->chosen : "");
            double off = violation_along(s);
            cr_expect(off < 1e-9, "%s: the constraints are off by %g", what, off);
            if (j != 2) compare_with_ida(s, 1e-5, what);
            nh_simulation_free(s);
        }
}

/* Velocities that contradict each other are refused with the constraint and the nearest ones that do not, which --project takes. */
Test(starts, contradictions_are_explained)
{
    nh_error error = {0};
    nh_simulation *s = motion_of(FOLDER "trailer.yaml", "x'=1, y'=0.5", 0.1, NULL, -1, &error);
    cr_assert(!s);
    cr_expect(strstr(error.what, "the initial velocities violate the constraints: the residual is 0.5 in `"), "%s", error.what);
    cr_expect(strstr(error.hint, "y' = 0"), "%s", error.hint);
}

/* Hinges at a right angle, pi/2 up to rounding: the given velocity follows from others of 1e16 and more. */
Test(starts, velocities_that_follow_by_rounding_are_refused)
{
    nh_error error = {0};
    nh_simulation *s = motion_of("systems/car_trailers_3.yaml", "h0=pi/2, h1=pi/2, h2=pi/2, h3=pi/2, h3'=1", 0.1, NULL, -1, &error);
    cr_assert(!s, "it starts");
    cr_expect(strstr(error.what, "the initial velocities violate the constraints: by these "), "%s", error.what);
}

/* A state from which no motion starts: which coordinate, and what vanishes. */
Test(starts, singular_states_are_explained)
{
    static const struct {
        const char *file, *initial, *what, *hint;
    } cases[] = {
        {"systems/kepler.yaml", "x=0, y=0, z=0", "x = y = z = 0: x^2 + y^2 + z^2 = 0", "start from other values"},
        {"systems/lagrange_top.yaml", "h=0", "h = 0: the mass matrix is singular, without inertia in p, s", "Euler angle"},
        {"systems/kovalevskaya_top.yaml", "theta=0", "theta = 0: sin(theta) = 0", "`angles: xyz`"},
        {"systems/lane_emden.yaml", "x=1", "t = 0: the mass matrix is singular, without inertia in x", "other values"},
        {"systems/appell_hamel.yaml", "x=1", "x' = y' = z' = 0: the coefficients of the velocities in the constraint `", "other values"},
        {"systems/ellipsoid_geodesic.yaml", "x=0, y=0, z=0, x'=1", "the positions are not on `x^2/a + y^2/b + z^2/c = 1`: its sides differ by -1", "satisfy the constraint"},
        {"systems/three_bodies.yaml", "x1=1, x2=1, y1=1, y2=1, x3=0, y3=0", "x1 = y1 = x2 = y2 = 1: (x1 - x2)^2 + (y1 - y2)^2 = 0", "other values"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        nh_error error = {0};
        nh_simulation *s = motion_of(cases[i].file, cases[i].initial, 0.1, NULL, -1, &error);
        cr_expect(!s, "%s starts from %s", cases[i].file, cases[i].initial);
        cr_expect(strstr(error.what, cases[i].what) && strstr(error.hint, cases[i].hint), "%s: %s\nhint: %s", cases[i].file, error.what, error.hint);
        nh_simulation_free(s);
    }
}
