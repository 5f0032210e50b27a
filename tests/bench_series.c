/* bench_series: how long the count's linear systems take, for growing numbers of coordinates and degrees.
 *
 * Of a natural system with a polynomial potential that has no integral but the energy: the even part of the given degree, of series up to two orders above the degree.  And
 * of shipped systems: the whole count of one degree, all orders of series that it takes, with coefficients in t, in all coordinates or in the shape alone.  The aims are half of
 * what a first version of the solver took. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/clock.h"
#include "base/text.h"
#include "count/count_internal.h"
#include "system/system.h"

enum { most_coordinates = 6 };

static const char *const NAME[most_coordinates] = {"x", "y", "z", "u", "v", "s"};

typedef struct {
    size_t coordinates, degree;
    double aim;
} task;

static const task TASK[] = {{2, 8, 0.0065}, {2, 12, 0.085}, {3, 4, 0.01}, {3, 6, 0.19}, {3, 8, 5.75}, {4, 2, 0.0025}, {4, 4, 0.32}, {4, 6, 26.5}, {5, 2, 0.015}, {5, 4, 7.45}, {6, 2, 0.04}};
enum { tasks = sizeof TASK / sizeof *TASK };

/* V = sum of k q_k^2/2 + q_k^2 q_(k+1) - q_(k+1)^3/3 + q_k q_(k+1)^3 */
static nh_model *model_of(size_t m)
{
    nh_text text;
    nh_error error = {0};
    nh_text_init(&text);
    nh_text_add(&text, "name: generic\ncoordinates: [");
    for (size_t k = 0; k < m; k++) nh_text_addf(&text, "%s%s", k ? ", " : "", NAME[k]);
    nh_text_add(&text, "]\nlagrangian: 0");
    for (size_t k = 0; k < m; k++) nh_text_addf(&text, " + %s'^2/2 - %zu*%s^2/2", NAME[k], k + 1, NAME[k]);
    for (size_t k = 0; k + 1 < m; k++) nh_text_addf(&text, " - %s^2*%s + %s^3/3 - %s*%s^3", NAME[k], NAME[k + 1], NAME[k + 1], NAME[k], NAME[k + 1]);
    nh_text_add(&text, "\n");
    nh_system *y = nh_system_parse("generic.yaml", nh_text_string(&text), 0, NULL, &error);
    nh_chart *chart = y ? nh_chart_create(y, NH_CHART_AUTO, 1, &error) : NULL;
    nh_model *o = chart ? nh_model_create(y, chart, &error) : NULL;
    if (!o) fprintf(stderr, "%s\n", error.what);
    nh_text_clear(&text);
    return o; /* as long as the program */
}

/* The least of some runs, in seconds. */
static double solve(const nh_graded_problem *p, size_t *unknowns, size_t *most)
{
    static const double long_enough = 0.3;
    double least = INFINITY, sum = 0;
    for (int run = 0; run < 5 && sum < long_enough; run++) {
        double start = nh_clock_of_thread();
        nh_graded_count *g = nh_graded_solve(p);
        double seconds = nh_clock_of_thread() - start;
        *unknowns = g->unknowns;
        *most = g->most;
        least = g->solved ? fmin(least, seconds) : INFINITY;
        sum += seconds;
        nh_graded_count_clear(g);
    }
    return least;
}

static double measure(const task *t)
{
    static const double no_limit = 1e15;
    nh_model *o = model_of(t->coordinates);
    nh_count_question q = {.degree = t->degree, .work = no_limit};
    nh_counter c;
    bool regular = false;
    if (!o) return NAN;
    nh_counter_open(&c, o, &q, false);
    nh_count_series *s = NULL;
    for (size_t point = 0; point < NH_COUNT_POINTS && !s; point++)
        if (nh_count_regular_point(&c, point)) s = nh_count_series_create(&c, t->degree + 2, INFINITY, &regular);
    double seconds = NAN;
    if (s) {
        size_t unknowns, most;
        nh_graded_problem p = nh_count_problem(&c, s, t->degree, NH_EVEN_DEGREES);
        seconds = solve(&p, &unknowns, &most);
        printf("| %zu | %zu | %zu | %zu | %.4f | %.4f |\n", t->coordinates, t->degree, unknowns, most, seconds, t->aim);
        fflush(stdout);
    }
    nh_count_series_free(s);
    nh_counter_close(&c);
    return seconds;
}

typedef struct {
    const char *system, *coordinates;
    nh_count_question question;
    double aim;
} row;

static const row ROW[] = {
    {"henon_heiles", "x, y, t", {.time = true, .degree = 4}, 0.045},
    {"henon_heiles", "x, y, t", {.time = true, .degree = 6}, 0.48},
    {"routh_sphere", "all 5", {.degree = 2}, 0.025},
    {"routh_sphere", "all 5", {.degree = 3}, 0.155},
    {"routh_sphere", "all 5", {.degree = 4}, 2.1},
    {"rolling_disk", "all 5", {.degree = 2}, 0.065},
    {"rolling_disk", "all 5", {.degree = 3}, 1.05},
    {"rolling_disk", "the inclination", {.shape = NH_CLOSED_SHAPE, .degree = 8}, 0.02},
    {"kovalevskaya_top", "all 3", {.degree = 8}, 6.95},
    {"kovalevskaya_top", "all but the precession", {.shape = NH_NOT_CYCLIC, .degree = 8}, 0.095},
};
enum { rows = sizeof ROW / sizeof *ROW };

static void measure_row(const row *x)
{
    char path[256];
    nh_error error = {0};
    snprintf(path, sizeof path, "systems/%s.yaml", x->system);
    nh_system *y = nh_system_read(path, 0, NULL, &error);
    nh_chart *chart = y ? nh_chart_create(y, NH_CHART_AUTO, 1, &error) : NULL;
    nh_model *o = chart ? nh_model_create(y, chart, &error) : NULL;
    if (!o) {
        fprintf(stderr, "%s\n", error.what);
        return;
    }
    nh_count_question q = x->question;
    q.alone = true;
    q.work = 1e12;
    double least = INFINITY;
    size_t bound = 0, order = 0;
    for (int run = 0; run < 3; run++) {
        double start = nh_clock_of_thread();
        nh_count c = nh_count_integrals(o, &q);
        least = fmin(least, nh_clock_of_thread() - start);
        bound = c.rows ? c.row[0].bound : 0;
        order = c.rows ? c.row[0].order : 0;
    }
    printf("| %s | %s | %zu | %zu | %zu | %.4f | %.4f |\n", x->system, x->coordinates, q.degree, order, bound, least, x->aim);
    fflush(stdout);
    nh_model_free(o);
}

/* Between the two highest degrees, and from the fewest to the most coordinates at one degree. */
static double exponent(double x0, double y0, double x1, double y1) { return log(y1 / y0) / log(x1 / x0); }

int main(void)
{
    double seconds[tasks];
    printf("| coordinates | degree | unknowns | largest number of parameters | s | aim, s |\n|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < tasks; i++) seconds[i] = measure(&TASK[i]);
    printf("\nFitted growth with the degree: 2 coordinates d^%.1f (8 to 12), 3 coordinates d^%.1f (4 to 8), 4 coordinates d^%.1f (2 to 6); with the number m of coordinates: degree 2 m^%.1f (4 to 6), degree 4 m^%.1f (3 to 5).\n",
           exponent(8, seconds[0], 12, seconds[1]), exponent(4, seconds[2], 8, seconds[4]), exponent(2, seconds[5], 6, seconds[7]), exponent(4, seconds[5], 6, seconds[10]),
           exponent(3, seconds[2], 5, seconds[9]));
    printf("\n| system | coefficients in | degree | order | at most | s | aim, s |\n|---|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < rows; i++) measure_row(&ROW[i]);
    return 0;
}
