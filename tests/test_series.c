/* Currents whose coefficients are functions of one variable without closed form: of an angle on intervals of any width,
 * and of time.  Against power series and closed forms, and systems that have none. */
#include "mechanics.h"
#include "program.h"
#include "scratch.h"
#include "sweep.h"

#include <math.h>

#include "exact/ball_ode.h"
#include "graph/print.h"
#include "commands/analyze.h"
#include "graph/dag.h"

/* ---- asking ---- */

static nh_analysis *ask(const char *text)
{
    char path[SCRATCH];
    cr_assert(scratch_text(path, text));
    nh_error error = {0};
    nh_request request = {.system_path = path};
    nh_options_default(&request.options);
    request.options.named = 0; /* series also of functions that have names */
    nh_analysis *r = nh_analysis_create(&request, &error);
    remove(path);
    cr_assert_not_null(r, "%s", error.what);
    return r;
}

/* f of word i at x, by Clenshaw's recurrence; 0 for a word that does not occur. */
static double f_of(const nh_analysis *r, const nh_series *s, const char *word, double x)
{
    double u = (2 * x - s->low - s->high) / (s->high - s->low), b = 0, c = 0;
    for (size_t i = 0; i < s->words; i++) {
        char *name = nh_print_string(r->question->model->dag, s->word[i]);
        bool same = !strcmp(name, word);
        nh_free(name);
        for (size_t k = s->degree + 1; same && k-- > 0;) {
            double next = s->coefficient[i * s->stride + k] + (k ? 2 : 1) * u * b - c;
            c = b;
            b = next;
        }
    }
    return b;
}

static size_t count_series(const nh_analysis *r)
{
    size_t n = 0;
    for (size_t k = 0; k < r->list->count; k++) n += r->list->found[k].series != NULL;
    return n;
}

/* Every series is certified, new, and constant along the motion; how many there are. */
static size_t check_series(const nh_analysis *r, const char *name)
{
    for (size_t k = 0; k < r->list->count; k++) {
        const nh_current *f = &r->list->found[k];
        if (!f->series) continue;
        cr_expect(f->proof.digits >= 50 && f->printed_digits >= 9 && f->heldout < 1e-8,
                  "%s: %g refined, %g printed, %.1e", name, f->proof.digits, f->printed_digits, f->heldout);
        cr_expect(f->independence == NH_INDEPENDENT && f->drift.small, "%s: drift %.1e", name, f->drift.drift[2]);
    }
    return count_series(r);
}

/* ---- an angle ---- */

/* Euler angles; R: height of the centre over the plane by h, q: how far beside it, b: radius of the point of contact
 * about the axis of the body. */
static const char body[] =
    "name: body\nparameters: [{name: m, value: 1.1}, {name: A, value: 0.35}, {name: C, value: 0.6}, {name: a, value: "
    "0.8}, {name: c, value: 0.5}, {name: g, value: 0.9}]\n"
    "coordinates: [{name: x, type: length}, {name: y, type: length}, {name: p, type: angle}, {name: h, type: angle}, "
    "{name: s, type: angle}]\n"
    "definitions:\n  - H = %s\n  - q = %s\n  - b = %s\n"
    "lagrangian: m*(x'^2 + y'^2 + q^2*h'^2)/2 + A*(h'^2 + p'^2*sin(h)^2)/2 + C*(s' + p'*cos(h))^2/2 - m*g*H\n"
    "constraints:\n  - x' + (q*p' + b*s')*cos(p) - H*h'*sin(p) = 0\n  - y' + (q*p' + b*s')*sin(p) + H*h'*cos(p) = "
    "0\ndomain: {h: [%g, %g]}\n";
static const char *const disk[3] = {"a*sin(h)", "a*cos(h)", "a"},
                         *const tyre[3] = {"a*sin(h) + c", "a*cos(h)", "a + c*sin(h)"},
                         *const ellipsoid[3] = {"sqrt(a^2*sin(h)^2 + c^2*cos(h)^2)", "(a^2 - c^2)*sin(h)*cos(h)/H",
                                                "a^2*sin(h)/H"};

static nh_analysis *roll(const char *const shape[3], double low, double high)
{
    char text[3000];
    snprintf(text, sizeof text, body, shape[0], shape[1], shape[2], low, high);
    return ask(text);
}

/* Rolling bodies of revolution have, beside the energy, two integrals that are linear in the velocities (Appell,
 * Chaplygin, Korteweg): wherever the interval of the angle lies inside (0, pi), however wide it is.  Nothing else is
 * almost conserved. */
static void two_on(const char *name, const char *const shape[3], double low, double high)
{
    nh_analysis *r = roll(shape, low, high);
    cr_expect(r->verdict == NH_FOUND && r->list->independent == 3, "%s on [%g, %g]: %zu independent", name, low, high,
              r->list->independent);
    cr_expect_eq(check_series(r, name), 2, "%s on [%g, %g]", name, low, high);
    cr_expect_eq(r->almosts, 0, "%s on [%g, %g]: %zu almost conserved", name, low, high, r->almosts);
    for (size_t k = 0; k < r->list->count; k++) {
        const nh_series *s = r->list->found[k].series;
        cr_expect(!s || (s->low <= low && s->high >= high), "%s: [%g, %g] of [%g, %g]", name, s->low, s->high, low,
                  high);
    }
    nh_analysis_free(r);
}

Test(series, disk_on_a_short_interval, WHOLE_ONLY)
{
    two_on("disk", disk, 1.0, 2.1);
}

Test(series, disk_on_a_wide_interval, WHOLE_ONLY)
{
    two_on("disk", disk, 0.6, 2.5);
}

Test(series, disk_on_a_very_wide_interval, WHOLE_ONLY)
{
    two_on("disk", disk, 0.3, 2.8);
}

Test(series, disk_near_an_end, PLAIN_ONLY)
{
    two_on("disk", disk, 0.2, 1.2);
}

Test(series, tyre_on_a_wide_interval, WHOLE_ONLY)
{
    two_on("tyre", tyre, 0.3, 2.7);
}

Test(series, ellipsoid_on_a_wide_interval, WHOLE_ONLY)
{
    two_on("ellipsoid", ellipsoid, 0.3, 2.7);
}

/* At h = 0 and pi the equations are singular: an interval with these ends is too wide for a series, and what is said
 * holds on a part of it. */
Test(series, an_interval_up_to_the_poles_is_cut, WHOLE_ONLY)
{
    nh_analysis *r = roll(disk, 0.0005, 3.141);
    cr_expect(r->list->independent == 3 && check_series(r, "disk") == 2, "%zu independent", r->list->independent);
    for (size_t k = 0; k < r->list->count; k++) {
        const nh_series *s = r->list->found[k].series;
        cr_expect(!s || (s->low > 0 && s->low < 0.3 && s->high > 2.8 && s->high < M_PI), "[%g, %g]", s->low, s->high);
    }
    nh_analysis_free(r);
}

/* The same functions whatever the interval: near the middle of one the other's currents are combinations of its own, so
 * that ratios of 2 x 2 determinants of (f1, f2) do not depend on it. */
Test(series, the_interval_does_not_matter, WHOLE_ONLY)
{
    static const double at[3] = {1.1, 1.5, 1.9}, ends[2][2] = {{1.0, 2.1}, {0.3, 2.8}};
    double determinant[2][3];
    for (int i = 0; i < 2; i++) {
        nh_analysis *r = roll(disk, ends[i][0], ends[i][1]);
        const nh_series *s[2] = {0};
        for (size_t k = 0, n = 0; k < r->list->count && n < 2; k++)
            if (r->list->found[k].series) s[n++] = r->list->found[k].series;
        cr_assert(s[0] && s[1]);
        for (int j = 0; j < 3; j++)
            determinant[i][j] = f_of(r, s[0], "p'", at[j]) * f_of(r, s[1], "s'", at[j]) -
                                f_of(r, s[0], "s'", at[j]) * f_of(r, s[1], "p'", at[j]);
        nh_analysis_free(r);
    }
    for (int j = 1; j < 3; j++) {
        double a = determinant[0][j] / determinant[0][0], b = determinant[1][j] / determinant[1][0];
        cr_expect(fabs(a - b) < 1e-11 * fabs(a), "%.16g and %.16g", a, b);
    }
}

/* ---- time ---- */

static const char airy[] = "name: airy\ncoordinates: [{name: x, type: length}]\nlagrangian: x'^2/2 - t*x^2/2\n";

/* x'' = -t x with x(0) = 1, x'(0) = 0 and the other way round: sum of a_k t^k, (k+3)(k+2) a_(k+3) = -a_k. */
static void airy_functions(double t, double y[2], double slope[2])
{
    for (int i = 0; i < 2; i++) {
        double term = i ? t : 1;
        y[i] = slope[i] = 0;
        for (int k = i; k < 90; k += 3) {
            y[i] += term;
            slope[i] += k * term / t;
            term *= -t * t * t / ((k + 3.0) * (k + 2.0));
        }
    }
}

/* The current that is x at t = 0 is x y2' - x' y2, the one that is x' at t = 0 is x' y1 - x y1'. */
Test(series, airy_functions)
{
    static const char *const meaning[2] = {"x at t = 0", "x' at t = 0"};
    nh_analysis *r = ask(airy);
    size_t seen = 0;
    cr_expect(r->list->independent == 2 && r->search == NH_SEARCH_COMPLETE && check_series(r, "airy") == 2);
    for (size_t k = 0; k < r->list->count; k++)
        for (int i = 0; i < 2 && r->list->found[k].series; i++) {
            if (strcmp(r->list->found[k].meaning, meaning[i])) continue;
            seen++;
            for (double t = 0.25; t < 4; t += 0.5) {
                double y[2], slope[2];
                airy_functions(t, y, slope);
                double x = i ? -slope[0] : slope[1], v = i ? y[0] : -y[1];
                double a = f_of(r, r->list->found[k].series, "x", t), b = f_of(r, r->list->found[k].series, "x'", t);
                cr_expect(fabs(a - x) + fabs(b - v) < 1e-11 * (1 + fabs(x) + fabs(v)),
                          "t = %g: %.15g, %.15g instead of %.15g, %.15g", t, a, b, x, v);
            }
        }
    cr_expect_eq(seen, 2);
    nh_analysis_free(r);
}

/* Linear equations of N coordinates have 2 N integrals that are linear in positions and velocities; where some are
 * closed forms the rest are series. */
static const struct {
    const char *name, *text;
    size_t all;
} driven[] = {
    {"Bessel",
     "parameters: [{name: nu, value: 0.3}]\ncoordinates: [{name: x, type: length}]\nlagrangian: t*x'^2/2 - (t - "
     "nu^2/t)*x^2/2\ndomain: {t: [0.5, 3]}\n",
     2},
    {"Bessel, by default",
     "parameters: [{name: nu, value: 0.3}]\ncoordinates: [{name: x, type: length}]\nlagrangian: t*x'^2/2 - (t - "
     "nu^2/t)*x^2/2\n",
     2},
    {"Mathieu",
     "parameters: [{name: a, value: 1.3}, {name: b, value: 0.4}]\ncoordinates: [{name: x, type: length}]\nlagrangian: "
     "x'^2/2 - (a + b*cos(t))*x^2/2\n",
     2},
    {"pendulum on a shaken support",
     "parameters: [{name: l, value: 1.2}, {name: g, value: 0.9}, {name: d, value: 0.2}, {name: w, value: "
     "3.1}]\ncoordinates: [{name: f, type: length}]\n"
     "lagrangian: l^2*f'^2/2 - l*(g - d*w^2*sin(w*t))*f^2/2\n",
     2},
    {"Airy falling", "coordinates: [{name: x, type: length}]\nlagrangian: x'^2/2 + t*x^2/2\n", 2},
    {"coupled oscillators",
     "parameters: [{name: k, value: 0.7}]\ncoordinates: [{name: x, type: length}, {name: y, type: length}]\n"
     "lagrangian: x'^2/2 + y'^2/2 - x^2/2 - t*y^2/2 - k*(x - y)^2/2\n",
     4},
    {"in polar coordinates",
     "coordinates: [{name: r, type: length}, {name: f, type: angle}]\nlagrangian: (r'^2 + r^2*f'^2)/2 - "
     "t*r^2/2\ndomain: {r: [0.5, 1.5]}\n",
     4},
    {"a pull", "coordinates: [{name: x, type: length}]\nlagrangian: x'^2/2 + exp(cos(t))*x\n", 2},
    {"friction that grows",
     "coordinates: [{name: x, type: length}]\nlagrangian: x'^2/2 - x^2/2\nforces:\n  - x = -t*x'\n", 2},
    {"squares: Ermakov and Pinney",
     "parameters: [{name: k, value: 0.7}]\ncoordinates: [{name: x, type: length}]\nlagrangian: x'^2/2 - (1 + t)*x^2/2 "
     "- k/(2*x^2)\n"
     "domain: {x: [0.5, 1.5]}\n",
     2},
    {"beside another motion",
     "coordinates: [{name: x, type: length}, {name: y, type: length}]\nlagrangian: x'^2/2 - t*x^2/2 + y'^2/2 - y^4/4\n",
     3},
};
enum { driven_count = sizeof driven / sizeof *driven };

static void all_of(size_t i)
{
    char text[2000];
    snprintf(text, sizeof text, "name: driven\n%s", driven[i].text);
    nh_analysis *r = ask(text);
    cr_expect(r->verdict == NH_FOUND && r->list->independent == driven[i].all, "%s: %zu of %zu", driven[i].name,
              r->list->independent, driven[i].all);
    cr_expect_gt(check_series(r, driven[i].name), 0u, "%s: no series", driven[i].name);
    for (size_t k = 0; k < r->list->count; k++) {
        const nh_series *s = r->list->found[k].series;
        cr_expect(!s || s->variable == r->question->system->t, "%s", driven[i].name);
    }
    nh_analysis_free(r);
}

Test(series, one_linear_equation, PLAIN_ONLY)
{
    for (size_t i = 0; i < 5; i++)
        if (sweep_tries(i, 2, 6)) all_of(i);
}

Test(series, more_than_one, PLAIN_ONLY)
{
    for (size_t i = 5; i < driven_count; i++)
        if (sweep_tries(i, 4, 5)) all_of(i);
}

/* What is nearly linear has no integral, although doubles cannot tell it from one that has. */
Test(series, a_small_term_is_seen)
{
    nh_analysis *r =
        ask("name: near\ncoordinates: [{name: x, type: length}]\nlagrangian: x'^2/2 - t*x^2/2 - 1e-12*x^4/4\n");
    cr_expect_eq(count_series(r), 0);
    nh_analysis_free(r);
}

/* Series of one coordinate each are left until no closed form of them was constructed: none is lost. */
Test(series, of_one_coordinate_of_two, PLAIN_ONLY)
{
    nh_analysis *r = ask("name: turn\n"
                         "coordinates: [{name: x, type: length}, {name: y, type: length}, {name: z, type: length}, "
                         "{name: h, type: length}, {name: u, type: length}]\n"
                         "lagrangian: (x'^2 + y'^2 + z'^2 + h'^2 + u'^2)/2 - u^4/4\n"
                         "constraints:\n  - z' - sin(h^2)*x' - h*y' = 0\ndomain: {h: [0.6, 1.9]}\n");
    size_t alone = 0, h = 3;
    cr_expect(r->list->independent == 6, "%zu independent", r->list->independent);
    for (size_t k = 0; k < r->list->count; k++) {
        const nh_series *s = r->list->found[k].series;
        alone += s && s->variable == r->question->system->coordinate[h].q;
    }
    cr_expect_eq(alone, 1u);
    nh_analysis_free(r);
}

/* Functions of two coordinates without closed form are not sought: error functions of x + i y here.  What is proved stays
 * proved, and the count says that it may not be all. */
Test(series, of_two_coordinates_together_none)
{
    nh_analysis *r = ask("name: plane\ncoordinates: [x, y]\nlagrangian: exp(x^2 - y^2)*(x'^2 + y'^2)/2\n");
    const nh_completeness *c = &r->completeness[NH_COMPLETE_IN_COORDINATES];
    cr_expect(r->list->independent == 1 && r->list->found[0].energy && r->list->found[0].proof.proved);
    cr_expect(c->counted && c->missing_at == 1 && c->missing == 2, "%zu missing at %zu", c->missing, c->missing_at);
    nh_analysis_free(r);
}

/* The energy of a mass that grows, times an exponential of t, has a closed form. */
Test(series, none_where_there_is_a_closed_form)
{
    nh_analysis *r =
        ask("name: growing\ncoordinates: [x, y]\nlagrangian: exp(t/5)*exp(x^2 - y^2)*(x'^2 + y'^2)/2\n");
    cr_assert_eq(r->list->independent, 1u);
    cr_expect(!r->list->found[0].series && r->list->found[0].proof.proved);
    nh_analysis_free(r);
}

/* The variable and the interval stand in every output. */
Test(series, the_interval_of_time_is_said_everywhere)
{
    place p = place_make();
    write_here(&p, "airy.yaml", airy);
    finished f = run_expecting(&p, "analyze -v airy.yaml --option named=0 --tex a.tex --json a.json --html a.html", 0);
    char *tex = read_here(&p, "a.tex"), *page = read_here(&p, "a.html"), *json = read_here(&p, "a.json");
    unfold(f.out);
    cr_expect_not_null(strstr(f.out, " in t, without closed form among the functions of the search, on [-0.4, 10.4]."), "%s", f.out);
    cr_expect_not_null(strstr(json, "\"coordinate\":\t\"t\""), "%.3000s", json);
    cr_expect_not_null(strstr(json, "\"low\":\t-0.4"));
    cr_expect_not_null(strstr(page, "without closed form among the functions of the search"));
    cr_expect_not_null(strstr(page, "-0.4"));
    cr_expect_not_null(strstr(tex, "without closed form among the functions of the search"));
    free(json), free(page), free(tex);
    finished_clear(&f);
    place_clear(&p);
}

/* ---- the differential equation itself ---- */

typedef struct {
    nh_ex s, x;
} plane;

static bool at_point(void *context, nh_ball *ball, double s, size_t sample)
{
    plane *p = context;
    nh_ball_set_double(ball, p->s, s);
    nh_ball_set_ratio(ball, p->x, (int64_t)(7 * sample % 31) + 1, 16);
    return true;
}

/* s' = 1, x' = x/s: f x with f' + f/s = 0, so f = 1/s; 1 is there too, x^2 s would be a word that is a multiple of x^2,
 * and x^3 goes with 1/s^3. */
Test(series, words_and_singularities, PLAIN_ONLY)
{
    nh_dag *d = nh_dag_create();
    plane p = {nh_symbol(d, "s"), nh_symbol(d, "x")};
    nh_ex x2 = nh_powi(d, p.x, 2), rate = nh_div(d, p.x, p.s);
    nh_ex word[4] = {nh_int(d, 1), p.x, x2, nh_mul(d, p.s, x2)}, slope[4];
    slope[0] = nh_int(d, 0);
    slope[1] = rate;
    slope[2] = nh_mul(d, nh_int(d, 2), nh_mul(d, p.x, rate));
    slope[3] = nh_add(d, x2, nh_mul(d, p.s, slope[2]));
    nh_ball *ball = nh_ball_create(d, nh_ball_ode_bits(50));
    nh_ball_ode_problem problem = {.words = 4,
                                   .value = word,
                                   .slope = slope,
                                   .variable_slope = nh_int(d, 1),
                                   .point = at_point,
                                   .context = &p,
                                   .digits = 50};
    nh_ball_ode *o = nh_ball_ode_create(ball, &problem);
    cr_expect_eq(nh_ball_ode_start(o, 1, 0.9), 3);
    cr_expect_eq(nh_ball_ode_words(o), 3);
    cr_expect_eq(nh_ball_ode_extend(o, 3, 1e-3), 3);
    double left = nh_ball_ode_extend(o, -1, 1e-3), f[9], digits[3];
    cr_expect(left > 0 && left < 0.02, "%g", left);
    nh_ball_ode_normalise(o, 1);
    nh_ball_ode_value(o, 2.5, f);
    for (size_t v = 0; v < 3; v++)
        for (size_t i = 0; i < 3; i++) cr_expect_float_eq(f[i + 3 * v], i == v ? pow(2.5, -(double)i) : 0, 1e-15);
    cr_expect(nh_ball_ode_residual(o, 2.5, 5, digits));
    for (size_t v = 0; v < 3; v++) cr_expect_geq(digits[v], 50);
    nh_ball_ode_free(o);
    nh_ball_free(ball);
    nh_dag_free(d);
}
