/* Tabulated values of independent computations in 40-digit arithmetic (tests/data) against the program, and motions against closed forms.
 *
 * Errors are relative to the largest component of the vector that is compared (Z, the bracket, Gamma, ...), and to the number itself for
 * single numbers.  NHSYM_TEST_FIGURES=1 prints the worst of each kind. */
#include "oracle.h"
#include "sweep.h"

#include "motion/integrators.h"
#include "motion/validation.h"

static const double TIGHT = 1e-12;

/* ---- the sleigh ---- */

static const char SLEIGH[] = "systems/sleigh.yaml";
static const char *const SLEIGH_PARAMETERS[] = {"m", "a", "k"};

#define S "(x'/(a*cos(phi)))"
#define ROOT "sqrt(" S "^2 + k^2*phi'^2)"
static const claim SLEIGH_CLAIMS[] = {
    {.name = "Phi1", .formula = "-E"},
    {.name = "Phi2", .formula = "m*x'/cos(phi)*sin(phi/k) + m*a*k*phi'*cos(phi/k)"},
    {.name = "Phi2b", .formula = "m*x'/cos(phi)*cos(phi/k) - m*a*k*phi'*sin(phi/k)"},
    {.name = "Phi3", .formula = "m*a^2*k^2/2*log((" ROOT " + " S ")/(" ROOT " - " S ")) - m*a^2*t*" ROOT},
};
enum { CLAIMS = sizeof SLEIGH_CLAIMS / sizeof *SLEIGH_CLAIMS };

Test(oracle, sleigh_geometry)
{
    static const char *const key[ORACLE_QUANTITIES] = {"Lbar", "Lbar_1", "Abar", "Bbar", "acc", "ydd", "mu", "eps_prime_g", "Gamma"};
    cJSON *data = oracle_read("tests/data/sleigh_oracle.json");
    const cJSON *set;
    size_t points = 0;
    cJSON_ArrayForEach(set, oracle_get(data, "sets")) {
        mechanics x = oracle_model(SLEIGH, NULL, set, 3, SLEIGH_PARAMETERS);
        geometry g = geometry_of(x.model);
        const cJSON *point;
        cJSON_ArrayForEach(point, oracle_get(set, "points")) {
            geometry_compare(&g, x.model, point, key);
            points++;
        }
        geometry_check(&g, key, TIGHT, oracle_get(set, "name")->valuestring);
        mechanics_clear(&x);
    }
    cr_assert_eq(points, 120);
    cJSON_Delete(data);
}

Test(oracle, sleigh_currents_and_symmetries, PLAIN_ONLY)
{
    cJSON *data = oracle_read("tests/data/sleigh_oracle.json");
    const cJSON *set, *point;
    cJSON_ArrayForEach(set, oracle_get(data, "sets")) {
        mechanics x = oracle_model(SLEIGH, NULL, set, 3, SLEIGH_PARAMETERS);
        nh_points *points = points_of(x.model, 24, 5);
        for (size_t i = 0; i < CLAIMS; i++) {
            claim c = SLEIGH_CLAIMS[i];
            claim_open(&c, x.model, points);
            cJSON_ArrayForEach(point, oracle_get(set, "points")) claim_compare(&c, x.model, point);
            claim_check(&c, TIGHT, oracle_get(set, "name")->valuestring);
        }
        nh_points_free(points);
        mechanics_clear(&x);
    }
    cJSON_Delete(data);
}

/* ---- nonlinear constraints ---- */

static const char *const PROJECTILE_PARAMETERS[] = {"m", "g", "v0"};

#define UP "sqrt(v0^2 - x'^2)"
static const claim PLANE_CLAIMS[] = {
    {.name = "Phi_x", .formula = "x + v0^2*atan2(" UP ", x')/g"},
    {.name = "Phi_y", .formula = "y - v0^2*log(x'/v0)/g"},
    {.name = "Phi_t", .formula = "t + v0*atanh(" UP "/v0)/g"},
    {.name = NULL},
};

#define ACROSS "sqrt(x'^2 + y'^2)"
#define RISE "sqrt(v0^2 - x'^2 - y'^2)"
static const claim SPACE_CLAIMS[] = {
    {.name = "Phi_az", .formula = "atan2(y', x')"}, /* a genuine case 2 */
    {.name = "Phi_x", .formula = "x + x'*v0^2*atan2(" RISE ", " ACROSS ")/(g*" ACROSS ")"},
    {.name = "Phi_y", .formula = "y + y'*v0^2*atan2(" RISE ", " ACROSS ")/(g*" ACROSS ")"},
    {.name = "Phi_z", .formula = "z - v0^2*log(" ACROSS "/v0)/g"},
    {.name = "Phi_t", .formula = "t + v0*atanh(" RISE "/v0)/g"},
    {.name = NULL},
};

static void compare_nonlinear(const char *text, size_t implicit, const cJSON *system, const claim *claims)
{
    static const char *const key[ORACLE_QUANTITIES] = {"Lbar", "Lbar_1", "Abar", "Bbar", "acc", "ydd", "mu", "eps_prime", "Gamma"};
    const cJSON *set = oracle_get(system, "sets")->child, *point;
    mechanics x = oracle_model(NULL, text, set, 3, PROJECTILE_PARAMETERS);
    cr_assert_eq(x.model->chart->implicit, implicit);
    nh_points *points = points_of(x.model, 24, 5);
    geometry g = geometry_of(x.model);
    cJSON_ArrayForEach(point, oracle_get(set, "points")) geometry_compare(&g, x.model, point, key);
    geometry_check(&g, key, TIGHT, oracle_get(system, "name")->valuestring);
    for (; claims->name; claims++) {
        claim c = *claims;
        claim_open(&c, x.model, points);
        cJSON_ArrayForEach(point, oracle_get(set, "points")) claim_compare(&c, x.model, point);
        claim_check(&c, TIGHT, x.system->name);
    }
    nh_points_free(points);
    mechanics_clear(&x);
}

/* The same constraint solved for y', with a root to be chosen, and left to Newton's method and the implicit function theorem. */
Test(oracle, nonlinear_constraint_in_the_plane)
{
    cJSON *data = oracle_read("tests/data/nonlinear_oracle.json");
    const cJSON *system = oracle_get(data, "systems")->child;
    compare_nonlinear(PROJECTILE_EXPLICIT, 0, system, PLANE_CLAIMS);
    compare_nonlinear(PROJECTILE_QUADRATIC, 0, system, PLANE_CLAIMS);
    compare_nonlinear(PROJECTILE_IMPLICIT, 1, system, PLANE_CLAIMS);
    cJSON_Delete(data);
}

Test(oracle, nonlinear_constraint_in_space_with_a_symmetry_of_case_2, PLAIN_ONLY)
{
    cJSON *data = oracle_read("tests/data/nonlinear_oracle.json");
    const cJSON *system = oracle_get(data, "systems")->child->next;
    compare_nonlinear(SPACE_EXPLICIT, 0, system, SPACE_CLAIMS);
    compare_nonlinear(SPACE_QUADRATIC, 0, system, SPACE_CLAIMS);
    compare_nonlinear(SPACE_IMPLICIT, 1, system, SPACE_CLAIMS);
    cJSON_Delete(data);
}

/* ---- Euler's disk ---- */

Test(oracle, disk, PLAIN_ONLY)
{
    static const char *const key[ORACLE_QUANTITIES] = {"Lbar", "Lbar_a", "Abar", "Bbar", "acc", "ydd", "mu", "eps_prime"};
    static const char *const parameter[] = {"r", "e", "M", "I1", "I3", "g"};
    cJSON *data = oracle_read("tests/data/disk_oracle.json");
    const cJSON *set, *point;
    cJSON_ArrayForEach(set, oracle_get(data, "sets")) {
        mechanics x = oracle_model(NULL, DISK, set, 6, parameter);
        nh_points *points = points_of(x.model, 24, 5);
        geometry g = geometry_of(x.model);
        claim c = {.name = "Phi_E", .formula = "-E"};
        claim_open(&c, x.model, points);
        cJSON_ArrayForEach(point, oracle_get(set, "points")) {
            geometry_compare(&g, x.model, point, key);
            claim_compare(&c, x.model, point);
        }
        geometry_check(&g, key, TIGHT, oracle_get(set, "name")->valuestring);
        claim_check(&c, TIGHT, oracle_get(set, "name")->valuestring);
        nh_points_free(points);
        mechanics_clear(&x);
    }
    cJSON_Delete(data);
}

/* ---- motions ---- */

/* The sleigh's own state at the beginning of a tabulated motion, and at its end: phi, x, y, omega, v. */
static void start_of(const cJSON *motion, double *t, double *q, double *v)
{
    double z[6], speed = oracle_number(motion, "v0");
    oracle_flat(oracle_get(motion, "z0"), z);
    *t = z[0];
    memcpy(q, z + 1, 3 * sizeof *q);
    v[0] = z[4];
    v[1] = speed * cos(z[1]);
    v[2] = speed * sin(z[1]);
}

static double end_error(const cJSON *motion, const double *state)
{
    double z[6], worst = 0;
    oracle_flat(oracle_get(motion, "zT"), z);
    double want[5] = {z[1], z[2], z[3], z[4], oracle_number(motion, "vT")};
    for (size_t i = 0; i < 5; i++) worst = isfinite(state[i]) ? fmax(worst, fabs(state[i] - want[i]) / fmax(1, fabs(want[i]))) : INFINITY;
    return worst;
}

/* The reduced equations from an initial state to the time `end`, by CVODE at rtol 1e-10; (q, w) there. */
static void flow(const nh_model *o, const nh_state *initial, double end, double *state)
{
    double z[20], times[2] = {initial->t, end}, scale[20];
    nh_error error = {0};
    for (size_t i = 0; i < 20; i++) scale[i] = 1e-3;
    nh_dynamics *d = nh_dynamics_create(o);
    must(nh_dynamics_start(d, initial, false, z, &error), &error, "the initial state");
    nh_flow_problem problem = nh_dynamics_problem(d);
    nh_flow_options options = {.method = NH_ADAMS, .rtol = 1e-10, .scale = scale};
    nh_motion *m = nh_cvode(&problem, z, 2, times, &options, &error);
    must(m != NULL && m->complete, &error, "the motion");
    memcpy(state, m->state + m->size, m->size * sizeof *state);
    nh_motion_free(m);
    nh_dynamics_free(d);
}

/* In quasi-velocities, through cos phi = 0, against the closed form. */
static double flow_error(const nh_model *o, const cJSON *motion)
{
    double q[3], v[3], state[5];
    nh_state initial = {.q = q, .v = v};
    start_of(motion, &initial.t, q, v);
    flow(o, &initial, oracle_number(motion, "T"), state);
    return end_error(motion, state);
}

static mechanics sleigh_of(const cJSON *set)
{
    nh_setting setting[3];
    for (size_t i = 0; i < 3; i++) setting[i] = (nh_setting){.name = SLEIGH_PARAMETERS[i], .value = oracle_number(set, SLEIGH_PARAMETERS[i])};
    return mechanics_of_file(SLEIGH, NH_CHART_QUASI, 3, setting);
}

Test(oracle, motions_of_the_sleigh)
{
    cJSON *data = oracle_read("tests/data/sleigh_oracle.json");
    const cJSON *set, *motion;
    tally t = {.what = "motion"};
    size_t crossing = 0;
    cJSON_ArrayForEach(set, oracle_get(data, "sets")) {
        mechanics x = sleigh_of(set);
        cJSON_ArrayForEach(motion, oracle_get(set, "trajectories")) {
            double error = flow_error(x.model, motion);
            cr_expect(error < 1e-8, "%s, %s: off by %.2e", oracle_get(set, "name")->valuestring, oracle_get(motion, "label")->valuestring, error);
            t.worst = fmax(t.worst, error);
            t.compared++;
            crossing += cJSON_IsTrue(oracle_get(motion, "crosses_chart_singularity_cosphi_0"));
        }
        mechanics_clear(&x);
    }
    tally_check(&t, 1e-8, "rtol 1e-10");
    cr_assert_eq(t.compared, 15);
    cr_assert_geq(crossing, 4);
    cJSON_Delete(data);
}

/* Drifts of the four currents, the multiplier form beside, and where the other chart ends. */
static void validate(const mechanics *x, const nh_model *other, const cJSON *motion, tally drift[CLAIMS], tally *full)
{
    double q[3], v[3];
    nh_error error = {0};
    nh_state initial = {.q = q, .v = v};
    nh_ex phi[CLAIMS];
    nh_options options;
    nh_options_default(&options);
    start_of(motion, &initial.t, q, v);
    for (size_t i = 0; i < CLAIMS; i++) phi[i] = formula(x->model, SLEIGH_CLAIMS[i].formula);
    nh_validation_request request = {.model = x->model, .other = other, .currents = CLAIMS, .current = phi, .initial = &initial, .until = oracle_number(motion, "T"), .outputs = 201, .options = &options};
    nh_validation *r = nh_validate(&request, &error);
    must(r != NULL, &error, "the validation");
    cr_expect(r->complete && r->note[0] == 0, "%s", r->note);
    for (size_t i = 0; i < CLAIMS; i++) {
        drift[i].worst = fmax(drift[i].worst, r->current[i].drift[NH_DRIFT_RUNS - 1]);
        drift[i].compared++;
        cr_expect(r->current[i].small && r->current[i].falls, "%s drifts by %.1e, %.1e, %.1e", SLEIGH_CLAIMS[i].name, r->current[i].drift[0],
                  r->current[i].drift[1], r->current[i].drift[2]);
    }
    full->compared++;
    full->worst = r->multiplier_form ? fmax(full->worst, fmax(fmax(r->state_difference, r->multiplier_difference), r->violation)) : INFINITY;
    cr_expect_lt(end_error(motion, r->state + (r->count - 1) * r->size), 1e-8);
    cr_expect_eq(!isnan(r->crossing), cJSON_IsTrue(oracle_get(motion, "crosses_chart_singularity_cosphi_0")), "crossing at %g", r->crossing);
    nh_validation_free(r);
}

Test(oracle, drifts_of_the_sleighs_currents)
{
    cJSON *data = oracle_read("tests/data/sleigh_oracle.json");
    const cJSON *set, *motion;
    tally drift[CLAIMS] = {{.what = "drift"}, {.what = "drift"}, {.what = "drift"}, {.what = "drift"}}, full = {.what = "multiplier form"};
    cJSON_ArrayForEach(set, oracle_get(data, "sets")) {
        mechanics x = sleigh_of(set);
        nh_model *other = nh_model_create(x.system, nh_chart_create(x.system, NH_CHART_COORDINATES, 1, NULL), NULL);
        cr_assert_not_null(other);
        cJSON_ArrayForEach(motion, oracle_get(set, "trajectories")) validate(&x, other, motion, drift, &full);
        nh_model_free(other);
        mechanics_clear(&x);
    }
    for (size_t i = 0; i < CLAIMS; i++) tally_check(&drift[i], 100 * 1e-10, SLEIGH_CLAIMS[i].name);
    tally_check(&full, 1e-6, "sleigh");
    cJSON_Delete(data);
}

/* Euler's disk: the reference motions are from an extrapolation method in extended precision (errors below 1e-20). */
Test(oracle, motions_of_the_disk, PLAIN_ONLY)
{
    static const char *const parameter[] = {"r", "e", "M", "I1", "I3", "g"};
    cJSON *data = oracle_read("tests/data/disk_oracle.json");
    const cJSON *set, *motion;
    tally t = {.what = "motion"};
    cJSON_ArrayForEach(set, oracle_get(data, "sets")) {
        mechanics x = oracle_model(NULL, DISK, set, 6, parameter);
        double r = oracle_number(set, "r"), z[8], want[8], state[8], v[5];
        cJSON_ArrayForEach(motion, oracle_get(set, "trajectories")) {
            oracle_flat(oracle_get(motion, "z0"), z);
            oracle_flat(oracle_get(motion, "zT"), want);
            memcpy(v, z + 5, 3 * sizeof *v);
            v[3] = -r * z[7] * cos(z[1]);
            v[4] = -r * z[7] * sin(z[1]);
            nh_state initial = {.q = z, .v = v};
            flow(x.model, &initial, oracle_number(motion, "T"), state);
            tally_add(&t, 8, state, want, 1);
        }
        mechanics_clear(&x);
    }
    tally_check(&t, 1e-8, "disk, rtol 1e-10");
    cJSON_Delete(data);
}
