/* Motions from special states: at rest, upright, straight, aligned, equal, one velocity alone, where states are zero and stay zero up to rounding.
 * Plane chains of pendula with links and masses of 1 in absolute angles, against Gragg's extrapolated midpoint rule [Hairer, Norsett, Wanner 1993, II.9] on
 * the equations of the chain by hand, in long double. */
#include <criterion/criterion.h>
#include <math.h>

#include "base/json.h"
#include "base/text.h"
#include "motion/method.h"
#include "program.h"
#include "sweep.h"

enum { most = 8, columns = 8, steps = 256 };
static const long double g = 9.81L;

/* ---- the chain by hand: mu_max(i,j) cos(q_i - q_j) q_j'' + mu_max(i,j) sin(q_i - q_j) q_j'^2 + g mu_i sin(q_i) = 0 ---- */

static void rate_by_hand(int n, const long double *z, long double *rate)
{
    long double M[most][most + 1];
    for (int i = 0; i < n; i++) {
        M[i][n] = -g * (n - i) * sinl(z[i]);
        for (int j = 0; j < n; j++) {
            long double mu = n - (i > j ? i : j);
            M[i][j] = mu * cosl(z[i] - z[j]);
            M[i][n] -= mu * sinl(z[i] - z[j]) * z[n + j] * z[n + j];
        }
    }
    for (int i = 0; i < n; i++) /* the matrix is positive: no pivots */
        for (int k = i + 1; k < n; k++)
            for (int j = n; j >= i; j--) M[k][j] -= M[k][i] / M[i][i] * M[i][j];
    for (int i = n; i-- > 0; rate[n + i] = M[i][n] / M[i][i])
        for (int j = i + 1; j < n; j++) M[i][n] -= M[i][j] * rate[n + j];
    memcpy(rate, z + n, (size_t)n * sizeof *rate);
}

static void midpoint_steps(int n, const long double *z, long double h, int count, long double *out)
{
    long double x[2 * most], y[2 * most], f[2 * most];
    int size = 2 * n;
    memcpy(x, z, (size_t)size * sizeof *x);
    rate_by_hand(n, x, f);
    for (int i = 0; i < size; i++) y[i] = x[i] + h / count * f[i];
    for (int k = 1; k < count; k++) {
        rate_by_hand(n, y, f);
        for (int i = 0; i < size; i++) {
            long double next = x[i] + 2 * h / count * f[i];
            x[i] = y[i], y[i] = next;
        }
    }
    memcpy(out, y, (size_t)size * sizeof *y);
}

static void by_hand(int n, long double time, long double *z)
{
    long double T[columns][2 * most];
    for (int step = 0; step < steps; step++) {
        for (int k = 0; k < columns; k++) {
            midpoint_steps(n, z, time / steps, 2 * (k + 1), T[k]);
            for (int j = k; j-- > 0;) {
                long double ratio = (long double)(k + 1) / (j + 1);
                for (int i = 0; i < 2 * n; i++) T[j][i] = T[j + 1][i] + (T[j + 1][i] - T[j][i]) / (ratio * ratio - 1);
            }
        }
        memcpy(z, T[0], 2 * (size_t)n * sizeof *z);
    }
}

/* ---- the same by the program ---- */

static void chain(const place *p, int n)
{
    nh_text text;
    nh_text_init(&text);
    nh_text_add(&text, "name: chain\ncoordinates: [");
    for (int i = 0; i < n; i++) nh_text_addf(&text, "%s{name: q%d, type: angle}", i ? ", " : "", i);
    nh_text_add(&text, "]\nlagrangian: 0");
    for (int i = 0; i < n; i++) {
        nh_text_addf(&text, " + %d*(q%d'^2/2 + 9.81*cos(q%d))", n - i, i, i);
        for (int j = 0; j < i; j++) nh_text_addf(&text, " + %d*q%d'*q%d'*cos(q%d - q%d)", n - i, i, j, i, j);
    }
    nh_text_add(&text, "\n");
    write_here(p, "chain.yaml", nh_text_string(&text));
    nh_text_clear(&text);
}

/* The first angle, the others, the first and the last velocity. */
typedef struct {
    const char *first, *others, *first_velocity, *last_velocity;
} special;

static const special states[] = {{"pi/2", "pi/2", "0", "0"}, {"-pi/2", "-pi/2", "0", "0"}, {"1", "1", "0", "0"},
                                 {"pi/2", "0", "0", "0"},    {"0", "pi/2", "0", "0"},      {"0", "0", "1", "0"},
                                 {"0", "0", "0", "1"},       {"pi", "0", "0", "0"},        {"pi", "pi", "0", "0"},
                                 {"pi/2", "pi/2", "1", "0"}, {"1e-9", "0", "0", "0"},      {"0", "0", "0", "0"},
                                 {"pi", "pi/2", "0", "0"},   {"1.5708", "1.5708", "0", "0"}};
enum { count_of_states = sizeof states / sizeof *states };

static double at_end(const nh_json *root, const char *format, int i)
{
    char name[20];
    snprintf(name, sizeof name, format, i);
    return nh_json_number_at(nh_json_get(nh_json_get(root, "states"), name), 1);
}

static double at_start(const nh_json *root, const char *format, int i)
{
    char name[20];
    snprintf(name, sizeof name, format, i);
    return nh_json_number_at(nh_json_get(nh_json_get(root, "states"), name), 0);
}

static nh_json *from_special(const place *p, int n, const special *s, const char *method, double tolerance, double time)
{
    char line[1000];
    size_t used = (size_t)snprintf(line, sizeof line, "q0=%s, q0'=%s, q%d'=%s", s->first, s->first_velocity, n - 1,
                                   s->last_velocity);
    for (int i = 1; i < n; i++) used += (size_t)snprintf(line + used, sizeof line - used, ", q%d=%s", i, s->others);
    char until[40], digits[40];
    snprintf(until, sizeof until, "%g", time);
    snprintf(digits, sizeof digits, "%g", tolerance);
    finished f = run_vector(p, &(manner){0},
                            (char *[]){(char *)p->program, "simulate", "chain.yaml", "--initial", line, "--until", until, "--step",
                                       until, "--method", (char *)method, "--tolerance", digits, "--json", "-", NULL});
    nh_json *root = f.code == 0 ? nh_json_parse(f.out) : NULL;
    cr_expect(root, "%d links, %s, %s at %g: exit code %d\n%.300s", n, line, method, tolerance, f.code, f.err);
    finished_clear(&f);
    return root;
}

/* The largest error of angles relative to the largest angle or 1, or of velocities relative to the largest velocity.  A motion that rounding alone moves has
 * no size of its own; chains amplify errors, rounding as well. */
static void compare(const place *p, int n, const special *s, const char *method, double tolerance)
{
    static const double rounding = 1e-11;
    bool multistep = strstr(method, "adams") || strstr(method, "bdf"); /* it controls the error of a step, and makes more of them */
    double time = n > 4 ? 0.5 : 1, size[2] = {1, 1}, off = 0;
    nh_json *root = from_special(p, n, s, method, tolerance, time);
    if (!root) return;
    long double z[2 * most];
    for (int i = 0; i < n; i++) z[i] = at_start(root, "q%d", i), z[n + i] = at_start(root, "q%d'", i);
    by_hand(n, time, z);
    for (int i = 0; i < 2 * n; i++) size[i / n] = fmax(size[i / n], (double)fabsl(z[i]));
    for (int i = 0; i < 2 * n; i++)
        off = fmax(off, fabs(at_end(root, i < n ? "q%d" : "q%d'", i % n) - (double)z[i]) / size[i / n]);
    cr_expect(off < (multistep ? 50 : 10) * tolerance + rounding, "%d links from %s, %s, %s, %s, %s at %g: error %.2g, %.0f evaluations", n, s->first,
              s->others, s->first_velocity, s->last_velocity, method, tolerance, off,
              nh_json_value(nh_json_get(root, "stats"), "evaluations"));
    nh_json_free(root);
}

/* With the method that is chosen, at all tolerances. */
Test(special_states, chains, PLAIN_ONLY)
{
    static const double tolerances[] = {1e-4, 1e-7, 1e-10, 1e-13};
    place p = place_make();
    for (int n = 2; n <= (sweep_whole() ? most : 5); n++) {
        chain(&p, n);
        for (size_t i = 0; i < count_of_states; i++)
            for (size_t k = 0; k < 4; k++)
                if (sweep_tries(17 * (size_t)n + 4 * i + k, 7, 29)) compare(&p, n, &states[i], "auto", tolerances[k]);
    }
    place_clear(&p);
}

/* One link up: the last ones begin as high powers of t, below the rounding of the rates.  That costs some steps, and not 200000. */
Test(special_states, the_last_links_of_a_long_chain_begin_from_zero)
{
    place p = place_make();
    chain(&p, most);
    compare(&p, most, &states[3], "auto", 1e-9);
    nh_json *root = from_special(&p, most, &states[3], "auto", 1e-9, 0.5);
    double evaluations = nh_json_value(nh_json_get(root, "stats"), "evaluations");
    cr_expect(evaluations < 20000, "%.0f evaluations", evaluations);
    nh_json_free(root);
    place_clear(&p);
}

/* (States inside a step of an implicit method took scales of their own from zeros: 57 million evaluations.) */
Test(special_states, implicit_steps_begin_from_rest)
{
    place p = place_make();
    chain(&p, 3);
    nh_json *root = from_special(&p, 3, &states[0], "esdirk", 1e-6, 1);
    double evaluations = nh_json_value(nh_json_get(root, "stats"), "evaluations");
    cr_expect(evaluations < 100000, "%.0f evaluations", evaluations);
    nh_json_free(root);
    place_clear(&p);
}

/* Each method that controls its error. */
Test(special_states, methods, PLAIN_ONLY)
{
    place p = place_make();
    for (int n = 2; n <= 3; n++) {
        chain(&p, n);
        for (size_t i = 0; i < count_of_states; i++)
            for (size_t k = 0; k < nh_method_count(); k++)
                if (!nh_method_at(k)->order && sweep_tries(5 * (size_t)n + 3 * i + k, 5, 23))
                    compare(&p, n, &states[i], nh_method_at(k)->word, k % 2 ? 1e-9 : 1e-6);
    }
    place_clear(&p);
}
