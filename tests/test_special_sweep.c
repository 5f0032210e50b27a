/* special_sweep: every shipped system from the states in which people begin: all coordinates equal (0, pi/2, -pi/2, pi, 1, 1/2), one of them alone, at rest
 * or with one velocity, at four tolerances.  The reference is Gragg's extrapolated midpoint rule [Hairer, Norsett, Wanner 1993, II.9] on the equations in all
 * coordinates with multipliers, which neither chart nor reduced equations nor an integrator of the program take part in.
 * tests/data/special_states.txt lists the starts that are refused, with the reason, and those at poles up to rounding, where the equations in all coordinates
 * are singular: no others may be. */
#include <stdio.h>

#include "base/text.h"
#include "commands/simulate.h"
#include "graph/node.h"
#include "mechanics.h"
#include "motion/trajectory.h"
#include "sweep.h"

#define KNOWN "tests/data/special_states.txt"

enum { columns = 8, fewest = 16, finest = 4096 };
static const double tolerances[] = {1e-4, 1e-7, 1e-10, 1e-13};

/* ---- the reference ---- */

static bool rate_of(nh_bordered *b, size_t m, double t, const double *z, double *rate)
{
    memcpy(rate, z + m, m * sizeof *rate);
    return nh_bordered_accelerations(b, t, z, z + m, rate + m);
}

static bool midpoint_steps(nh_bordered *b, size_t m, double t, double h, int count, const double *z, double *out)
{
    double *x = nh_alloc_array(6 * m, sizeof *x), *y = x + 2 * m, *f = y + 2 * m;
    memcpy(x, z, 2 * m * sizeof *x);
    bool good = rate_of(b, m, t, x, f);
    for (size_t i = 0; i < 2 * m; i++) y[i] = x[i] + h / count * f[i];
    for (int k = 1; k < count && good; k++) {
        good = rate_of(b, m, t + k * h / count, y, f);
        for (size_t i = 0; i < 2 * m; i++) {
            double next = x[i] + 2 * h / count * f[i];
            x[i] = y[i], y[i] = next;
        }
    }
    memcpy(out, y, 2 * m * sizeof *y);
    nh_free(x);
    return good;
}

/* From z at time 0 to `time` in so many steps. */
static bool extrapolated(nh_bordered *b, size_t m, double time, int steps, double *z)
{
    double *T = nh_alloc_array(columns * 2 * m, sizeof *T), h = time / steps;
    bool good = true;
    for (int step = 0; step < steps && good; step++) {
        for (int k = 0; k < columns && good; k++) {
            good = midpoint_steps(b, m, step * h, h, 2 * (k + 1), z, T + (size_t)k * 2 * m);
            for (int j = k; j-- > 0;) {
                double ratio = (double)(k + 1) / (j + 1);
                for (size_t i = 0; i < 2 * m; i++) {
                    double *at = T + (size_t)j * 2 * m + i;
                    *at = at[2 * m] + (at[2 * m] - *at) / (ratio * ratio - 1);
                }
            }
        }
        memcpy(z, T, 2 * m * sizeof *z);
    }
    nh_free(T);
    return good;
}

/* ---- the motions ---- */

typedef struct {
    const char *system;
    nh_system *read;
    char initial[4000];
} start;

enum { kinds = 12 };

static void describe(start *s, size_t kind)
{
    static const char *const all[kinds] = {"0", "pi/2", "-pi/2", "pi", "1", NULL, NULL, "0.5", "0", "0", "1", "pi/2"};
    size_t used = 0, m = s->read->coordinates, last = m - 1;
    s->initial[0] = '\0';
    for (size_t i = 0; i < m && all[kind]; i++)
        used += (size_t)snprintf(s->initial + used, sizeof s->initial - used, "%s%s=%s", i ? ", " : "", s->read->coordinate[i].name, all[kind]);
    if (kind == 5 || kind == 6) snprintf(s->initial, sizeof s->initial, "%s=pi/2", s->read->coordinate[kind == 5 ? 0 : last].name);
    if (kind >= 8) snprintf(s->initial + used, sizeof s->initial - used, ", %s'=1", s->read->coordinate[kind % 2 ? last : 0].name);
}

static nh_simulation *motion_from(const start *s, double tolerance, nh_error *error)
{
    char path[200];
    snprintf(path, sizeof path, "systems/%s.yaml", s->system);
    nh_request q = {.system_path = path, .initial = s->initial, .until_given = true, .tolerance_given = true, .step = 1};
    nh_options_default(&q.options);
    q.options.until = 1, q.options.tolerance = tolerance;
    nh_error_clear(error);
    return nh_simulation_create(&q, error);
}

static double value_of(const nh_simulation *s, size_t row, nh_ex symbol)
{
    const char *column = nh_name_of(s->model->dag, symbol);
    for (size_t i = 0; i < s->columns.count; i++)
        if (!strcmp(s->columns.track[i].name, column)) return s->value[row * s->columns.count + i];
    cr_assert(false, "no column %s", column);
    return NAN;
}

static void row_of(const nh_simulation *s, size_t row, double *z)
{
    const nh_system *system = s->model->system;
    size_t m = system->coordinates;
    for (size_t i = 0; i < m; i++) z[i] = value_of(s, row, system->coordinate[i].q), z[m + i] = value_of(s, row, system->coordinate[i].v);
}

/* The lines "system | state | what happens" of the list. */
static bool is_known(const char *known, const start *s, const char *what)
{
    nh_text line;
    nh_text_init(&line);
    nh_text_addf(&line, "\n%s | %s | %s", s->system, s->initial, what);
    bool found = strstr(known, nh_text_string(&line)) != NULL;
    nh_text_clear(&line);
    return found;
}

/* The largest difference of two states, relative to the largest state of its kind, position or velocity. */
static double difference(size_t m, const double *a, const double *b)
{
    double size[2] = {1, 1}, off = 0;
    for (size_t i = 0; i < 2 * m; i++) size[i / m] = fmax(size[i / m], fmax(fabs(a[i]), fabs(b[i])));
    for (size_t i = 0; i < 2 * m; i++) off = isfinite(a[i] - b[i]) ? fmax(off, fabs(a[i] - b[i]) / size[i / m]) : INFINITY;
    return off;
}

/* The reference has to be better than what it judges: its error is its change with twice as many steps. */
static void compare(const start *s, const char *known, const nh_simulation *motion, double tolerance)
{
    static const double rounding = 1e-11;
    size_t m = motion->model->m;
    double *z = nh_alloc_array(8 * m, sizeof *z), *reference = z + 2 * m, *coarser = reference + 2 * m, *first = coarser + 2 * m, error = INFINITY;
    nh_bordered *b = nh_bordered_create(motion->model);
    row_of(motion, 0, first);
    row_of(motion, 1, z);
    bool good = true;
    for (int steps = fewest; steps <= finest && !(error < 0.1 * tolerance + rounding); steps *= 2) { /* coarse ones may meet a pole */
        memcpy(coarser, reference, 2 * m * sizeof *z);
        memcpy(reference, first, 2 * m * sizeof *z);
        good = extrapolated(b, m, 1, steps, reference);
        error = good && steps > fewest ? difference(m, reference, coarser) : INFINITY;
    }
    cr_expect(good != is_known(known, s, "no reference"), "%s | %s | %s", s->system, s->initial, good ? "has a reference" : "no reference");
    double off = good ? difference(m, z, reference) : 0;
    cr_expect(off <= 10 * (tolerance + error + rounding), "%s from %s at %g: error %.2g, that of the reference %.2g; %ld evaluations", s->system, s->initial,
              tolerance, off, error, motion->motion->evaluations);
    nh_bordered_free(b);
    nh_free(z);
}

static void try(start *s, const char *known, size_t which)
{
    for (size_t k = 0; k < 4; k++) {
        if (!sweep_whole() && k != which % 4) continue;
        nh_error error;
        nh_simulation *motion = motion_from(s, tolerances[k], &error);
        const char *what = !motion ? "refused" : !motion->motion->complete ? "ends" : NULL;
        bool listed = is_known(known, s, "refused") || is_known(known, s, "ends"), free = is_known(known, s, "no reference");
        cr_expect(free || (what ? is_known(known, s, what) : !listed), "%s | %s | %s: %s%s (at %g)", s->system, s->initial, what ? what : "goes on",
                  motion ? motion->motion->note : error.what, listed ? "; otherwise in " KNOWN : "", tolerances[k]);
        if (!what) compare(s, known, motion, tolerances[k]);
        nh_simulation_free(motion);
        if (!motion) return;
    }
}

Test(special_sweep, shipped_systems, PLAIN_ONLY)
{
    char *name[most_files], known[40000] = "";
    nh_error error = {0};
    size_t n = list("systems", name);
    FILE *file = fopen(KNOWN, "r");
    cr_assert(file && fread(known, 1, sizeof known - 1, file) && feof(file), KNOWN);
    fclose(file);
    for (size_t i = 0; i < n; i++) {
        char path[200];
        snprintf(path, sizeof path, "systems/%s.yaml", name[i]);
        start s = {.system = name[i], .read = nh_system_read(path, 0, NULL, &error)};
        must(s.read != NULL, &error, path);
        for (size_t k = 0; k < kinds; k++) {
            if (!sweep_tries(5 * i + 7 * k, 24, 1000)) continue;
            describe(&s, k);
            try(&s, known, i + k);
        }
        if (sweep_whole()) fprintf(stderr, "measured: %s\n", name[i]);
        nh_system_free(s.read);
        free(name[i]);
    }
}
