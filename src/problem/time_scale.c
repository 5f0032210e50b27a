#include "problem/time_scale.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double fast = 1e3, velocity = 1.5;

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double half_width(const nh_model *model, size_t s)
{
    return (model->chart->high[1 + s] - model->chart->low[1 + s]) / 2;
}

/* The unit of the coordinate whose velocity w^i is; 1 for quasi-velocities. */
static double length_of(const nh_model *model, size_t i)
{
    return model->chart->quasi ? 1 : half_width(model, model->chart->free[i]);
}

/* The accelerations at probe p, its velocities multiplied by `part`. */
static bool accelerations(const nh_model *model, nh_tape *tape, nh_tape_work *work, size_t p, double part, double *z,
                          double *out)
{
    const nh_chart *c = model->chart;
    memcpy(z, c->probe + p * c->width, c->width * sizeof *z);
    for (size_t i = 0; i < model->n; i++) z[1 + model->m + i] *= part;
    if (!nh_chart_complete(c, z)) return false;
    nh_tape_eval(tape, work, z, out);
    for (size_t i = 0; i < model->n; i++)
        if (!isfinite(out[i])) return false;
    return true;
}

static double median(size_t count, double *list)
{
    qsort(list, count, sizeof *list, ascending);
    return list[count / 2];
}

/* The change of the accelerations at probe p, in lengths, when `part` of its velocities is reversed, and the largest of
 * these velocities. */
static bool turned_round(const nh_model *model, nh_tape *tape, nh_tape_work *work, size_t p, double part, double *z,
                         double *out, double *change, double *speed)
{
    *change = *speed = 0;
    if (!accelerations(model, tape, work, p, -part, z, out) ||
        !accelerations(model, tape, work, p, part, z, out + model->n))
        return false;
    for (size_t i = 0; i < model->n; i++) {
        *change = fmax(*change, fabs(out[model->n + i] - out[i]) / (2 * length_of(model, i)));
        *speed = fmax(*speed, fabs(z[1 + model->m + i]) / length_of(model, i));
    }
    return true;
}

/* Accelerations at rest, and the change by small velocities, which gyroscopic forces and friction multiply by a rate.
 * Terms that depend on the direction of the velocities alone (dry friction, multipliers of homogeneous constraints)
 * give no rate: they do not become smaller with the velocities. */
static double omega(const nh_model *model)
{
    static const double small = 1e-3;
    const nh_chart *c = model->chart;
    size_t n = model->n, rest = 0, slow = 0;
    nh_tape *tape = nh_model_tape(model, n, model->a);
    nh_tape_work *work = nh_tape_work_create(tape);
    double *z = nh_alloc_array(c->width, sizeof *z), *out = nh_alloc_array(2 * n + 1, sizeof *out), most = 0;
    double *a = nh_alloc_array((n + 1) * c->probes + 1, sizeof *a), *rate = a + n * c->probes;
    for (size_t p = 0; p < c->probes; p++) {
        double change, speed, half_change, half_speed;
        if (accelerations(model, tape, work, p, 0, z, out)) {
            for (size_t i = 0; i < n; i++) a[i * c->probes + rest] = fabs(out[i]);
            rest++;
        }
        if (turned_round(model, tape, work, p, small, z, out, &change, &speed) && speed > 0 &&
            turned_round(model, tape, work, p, small / 2, z, out, &half_change, &half_speed))
            rate[slow++] = fmax(0, change - half_change) / (speed - half_speed);
    }
    for (size_t i = 0; i < n && rest; i++)
        most = fmax(most, sqrt(median(rest, a + i * c->probes) / length_of(model, i)));
    if (slow) most = fmax(most, median(slow, rate));
    nh_free(out);
    nh_free(a);
    nh_free(z);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return isfinite(most) ? most : 0;
}

static void add(nh_system *system, nh_ex symbol, double low, double high)
{
    for (size_t i = 0; i < system->intervals; i++)
        if (system->interval[i].symbol == symbol) return;
    system->interval[system->intervals++] = (nh_interval){symbol, low, high};
}

/* Room for intervals of all that may get one. */
static void make_room(nh_system *system)
{
    nh_interval *list =
        nh_arena_alloc(system->arena, (system->intervals + 1 + system->coordinates + system->quasi) * sizeof *list);
    if (system->intervals) memcpy(list, system->interval, system->intervals * sizeof *list);
    system->interval = list;
}

static void scale_velocities(nh_system *system, const nh_model *model, double factor)
{
    for (size_t i = 0; i < model->m; i++) {
        double most = velocity * half_width(model, i) * factor;
        add(system, system->coordinate[i].v, -most, most);
    }
    for (size_t i = 0; i < system->quasi; i++)
        add(system, system->quasi_velocity[i], -velocity * factor, velocity * factor);
}

double nh_time_scale_set(nh_system *system, const nh_model *model)
{
    double Omega = omega(model), longest = 1;
    for (size_t i = 0; i < model->m; i++) longest = fmax(longest, half_width(model, i));
    if (!(Omega * longest > fast)) return 1;
    make_room(system);
    add(system, system->t, 0, 1 / Omega);
    scale_velocities(system, model, Omega);
    return Omega;
}

bool nh_time_scale_velocities(nh_system *system, const nh_model *model, double factor)
{
    size_t before = system->intervals;
    make_room(system);
    scale_velocities(system, model, factor);
    return system->intervals > before;
}
