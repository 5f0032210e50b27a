/* A system as K, a, V, omega, b and Q at sample points (kinetic.h).
 *
 *      read_lagrangian     K_rs = d2L/dv^r dv^s, a_s = dL/dv^s at rest, V = -L at rest; anything that is left over is
 *                          recorded: explicit time, a Lagrangian that is not quadratic
 *      read_constraints    omega^A_s = df^A/dv^s, b^A = f^A at rest, poles taken out first
 *      take_places         positions and velocities from the box; those nearest to singular metrics are left out */
#include "reduction/kinetic.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/linalg.h"
#include "base/progress.h"
#include "graph/diff.h"
#include "graph/terms.h"
#include "exact/generic_value.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "system/constraint_samples.h"

static bool depends_on_any(const nh_dag *d, nh_ex e, size_t n, const nh_ex *symbol)
{
    for (size_t i = 0; i < n; i++)
        if (nh_depends(d, e, symbol[i])) return true;
    return false;
}

/* e with all velocities zero. */
static nh_ex at_rest(const nh_kinetic *k, nh_ex e)
{
    nh_ex *zero = nh_alloc_array(k->m, sizeof *zero);
    for (size_t s = 0; s < k->m; s++) zero[s] = nh_int(k->dag, 0);
    e = nh_substitute(k->dag, e, k->m, k->v, zero);
    nh_free(zero);
    return e;
}

/* The derivative by a velocity as an expression of the place alone; false when a velocity stays in it. */
static bool linear_part(const nh_kinetic *k, nh_ex e, nh_ex v, nh_ex *out)
{
    *out = nh_simplify(k->dag, nh_diff(k->dag, e, v));
    if (!depends_on_any(k->dag, *out, k->m, k->v)) return true;
    nh_ex rest = at_rest(k, *out);
    if (nh_normal_is_zero(k->dag, nh_sub(k->dag, *out, rest), 0) != NH_ZERO) return false;
    *out = rest;
    return true;
}

static void read_lagrangian(nh_kinetic *k, bool metric_alone)
{
    nh_dag *d = k->dag;
    nh_ex L = k->model->system->lagrangian;
    k->quadratic = true;
    for (size_t r = 0; r < k->m; r++) {
        nh_ex p = nh_diff(d, L, k->v[r]);
        for (size_t s = 0; s <= r; s++) {
            if (!linear_part(k, p, k->v[s], &k->K[r * k->m + s])) k->quadratic = false;
            k->K[s * k->m + r] = k->K[r * k->m + s];
        }
        k->a[r] = nh_simplify(d, at_rest(k, p));
        k->magnetic |= !nh_is_zero(d, k->a[r]);
    }
    k->V = nh_neg(d, nh_simplify(d, at_rest(k, L)));
    if (metric_alone) k->V = nh_int(d, 0);
    k->autonomous = metric_alone || !nh_depends(d, L, k->model->system->t);
    for (size_t i = 0; i < k->m * k->m; i++) k->autonomous &= !nh_depends(d, k->K[i], k->model->system->t);
    if (k->quadratic && k->autonomous) return;
    for (size_t i = 0; i < k->m * k->m; i++) k->K[i] = nh_int(d, 0);
    for (size_t i = 0; i < k->m; i++) k->a[i] = nh_int(d, 0);
    k->V = nh_int(d, 0);
}

static void read_constraints(nh_kinetic *k)
{
    nh_dag *d = k->dag;
    k->affine = k->linear = true;
    for (size_t a = 0; a < k->f; a++) {
        k->force[a] = nh_numerator(d, nh_chart_constraint(k->model->chart, a));
        for (size_t s = 0; s < k->m; s++)
            if (!linear_part(k, k->force[a], k->v[s], &k->omega[a * k->m + s])) k->affine = k->linear = false;
        k->b[a] = nh_simplify(d, at_rest(k, k->force[a]));
        k->linear &= nh_is_zero(d, k->b[a]);
        k->autonomous &= !nh_depends(d, k->force[a], k->model->system->t);
    }
    for (size_t i = 0; i < k->f * k->m && !(k->affine && k->autonomous); i++) k->omega[i] = nh_int(d, 0);
    for (size_t a = 0; a < k->f && !(k->affine && k->autonomous); a++) k->b[a] = nh_int(d, 0);
}

/* K is positive definite at a place when its Cholesky factor exists. */
static bool positive(size_t m, double *K)
{
    for (size_t j = 0; j < m; j++) {
        double before = K[j + j * m];
        for (size_t k = 0; k < j; k++) K[j + j * m] -= K[j + k * m] * K[j + k * m];
        if (!(K[j + j * m] > 1e-12 * before)) return false;
        K[j + j * m] = sqrt(K[j + j * m]);
        for (size_t i = j + 1; i < m; i++) {
            for (size_t k = 0; k < j; k++) K[i + j * m] -= K[i + k * m] * K[j + k * m];
            K[i + j * m] /= K[j + j * m];
        }
    }
    return true;
}

/* Is K positive definite at the sample points? */
static bool has_metric(const nh_kinetic *k)
{
    enum { trials = 8 };
    bool good = k->quadratic && k->autonomous;
    double *K = nh_alloc_array(k->m * k->m, sizeof *K);
    for (size_t p = 0; good && p < trials && p < k->places; p++) {
        nh_kinetic_values(k, k->m * k->m, k->K, k->place + p * k->m, K);
        good = positive(k->m, K);
    }
    nh_free(K);
    return good;
}

/* The singular values of K with unit diagonal at a place, in K; false where something is not finite. */
static bool spectrum(const nh_kinetic *k, nh_tape *tape, nh_tape_work *work, const double *q, double *K,
                     double **values)
{
    size_t m = k->m;
    double *s = K + m * m + k->f * m + 1, *unit = s + m;
    nh_tape_eval(tape, work, q, K);
    for (size_t i = 0; i < m * m + k->f * m + 1; i++)
        if (!isfinite(K[i])) return false;
    *values = s;
    if (!k->quadratic || !k->autonomous) return true;
    /* indefinite ones, too */
    for (size_t i = 0; i < m; i++) unit[i] = K[i * (m + 1)] != 0 ? 1 / sqrt(fabs(K[i * (m + 1)])) : 1;
    for (size_t i = 0; i < m * m; i++) K[i] *= unit[i % m] * unit[i / m];
    return nh_svd(m, m, K, s, NULL, NULL) && s[0] > 0;
}

/* The rank that K has in most places: inertia may be missing where constraints bind. */
static size_t usual_rank(const nh_kinetic *k, nh_tape *tape, nh_tape_work *work, const nh_constraint_samples *sample,
                         double *K)
{
    enum { trials = 8 };
    static const double rounding = 1e-14; /* times m */
    size_t most = 0;
    double *s;
    for (size_t p = 0; p < trials && p < sample->count && k->quadratic && k->autonomous; p++) {
        size_t rank = 0;
        if (!spectrum(k, tape, work, sample->point + p * sample->width + 1, K, &s)) continue;
        while (rank < k->m && s[rank] > rounding * (double)k->m * s[0]) rank++;
        if (rank > most) most = rank;
    }
    return most;
}

/* The distance of a place from singular ones: the least singular value that is not zero everywhere, relative to the
 * largest; 0 where a value is not finite. */
static double condition(const nh_kinetic *k, nh_tape *tape, nh_tape_work *work, const double *q, size_t rank, double *K)
{
    double *s;
    return !spectrum(k, tape, work, q, K, &s) ? 0 : rank ? s[rank - 1] / s[0] : 1;
}

/* A Lagrangian that is not quadratic may be undefined for velocities of the box: good[i] = 0 for such states. */
static void leave_out_undefined(const nh_kinetic *k, size_t rounds, const nh_constraint_samples *sample, double *good)
{
    const nh_system *system = k->model->system;
    size_t m = k->m, width = 1 + 2 * m;
    nh_ex *in = nh_alloc_array(width, sizeof *in);
    double L;
    if (!k->quadratic || !k->autonomous) {
        in[0] = system->t;
        memcpy(in + 1, k->q, m * sizeof *in);
        memcpy(in + 1 + m, k->v, m * sizeof *in);
        nh_tape *tape = nh_tape_create(k->dag, width, in, 1, &system->lagrangian, system->parameters,
                                       k->model->parameter, k->model->parameter_value);
        nh_tape_work *work = nh_tape_work_create(tape);
        for (size_t r = 0; r < rounds; r++)
            for (size_t p = 0; p < sample[r].count; p++, good++) {
                nh_tape_eval(tape, work, sample[r].point + p * sample[r].width, &L);
                if (!isfinite(L)) *good = 0;
            }
        nh_tape_work_free(work);
        nh_tape_free(tape);
    }
    nh_free(in);
}

/* Positions and velocities from the box; the places nearest to a singularity of the coordinates are left out, the best
   one comes first. */
static void take_places(nh_kinetic *k, uint64_t seed)
{
    enum { rounds = 4 };
    static const double usable = 1e-3; /* part of the best condition */
    size_t m = k->m, most = 0, total = m * m + k->f * m + 1;
    nh_constraint_samples sample[rounds];
    nh_ex *e = nh_alloc_array(total, sizeof *e);
    memcpy(e, k->K, m * m * sizeof *e);
    memcpy(e + m * m, k->omega, k->f * m * sizeof *e);
    e[total - 1] = k->V;
    nh_tape *tape = nh_kinetic_tape(k, total, e);
    nh_tape_work *work = nh_tape_work_create(tape);
    for (int r = 0; r < rounds; r++) {
        nh_constraint_samples_init(&sample[r], k->model->system, k->f, seed + 1000 * (uint64_t)r);
        most += sample[r].count;
    }
    double *K = nh_alloc_array(total + 2 * m, sizeof *K), *good = nh_alloc_array(most + 1, sizeof *good), best = 0;
    size_t rank = usual_rank(k, tape, work, &sample[0], K);
    k->invertible = rank == m;
    k->place = nh_arena_alloc(k->arena, (most + 1) * m * sizeof *k->place);
    k->speed = nh_arena_alloc(k->arena, (most + 1) * m * sizeof *k->speed);
    k->time = nh_arena_alloc(k->arena, (most + 1) * sizeof *k->time);
    for (size_t r = 0, at = 0; r < rounds; r++)
        for (size_t p = 0; p < sample[r].count; p++)
            best =
                fmax(best, good[at++] = condition(k, tape, work, sample[r].point + p * sample[r].width + 1, rank, K));
    leave_out_undefined(k, rounds, sample, good);
    for (size_t r = 0, at = 0; r < rounds; r++) {
        for (size_t p = 0; p < sample[r].count; p++, at++) {
            const double *z = sample[r].point + p * sample[r].width;
            size_t n = k->places;
            if (!(good[at] > 0) || good[at] < usable * best) continue;
            k->time[n] = z[0];
            memcpy(k->place + n * m, z + 1, m * sizeof *z);
            memcpy(k->speed + n * m, z + 1 + m, m * sizeof *z);
            k->places++;
            if (good[at] < best) continue;
            for (size_t s = 0; s < m; s++) { /* to the front */
                double x = k->place[s], v = k->speed[s];
                k->place[s] = k->place[n * m + s], k->place[n * m + s] = x;
                k->speed[s] = k->speed[n * m + s], k->speed[n * m + s] = v;
            }
        }
        nh_constraint_samples_clear(&sample[r]);
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(e);
    nh_free(K);
    nh_free(good);
}

/* Do the forces not contain the time? */
static bool forces_autonomous(const nh_kinetic *k)
{
    for (size_t s = 0; s < k->m && k->forced; s++)
        if (nh_depends(k->dag, k->Q[s], k->model->system->t)) return false;
    return true;
}

/* What keeps the system from the form of kinetic.h, in words; NULL: nothing. */
static const char *obstacle_of(const nh_kinetic *k)
{
    if (!k->quadratic) return "the Lagrangian is not quadratic in the velocities";
    if (!k->autonomous) return "time occurs in the Lagrangian or in a constraint";
    if (k->forced) return "there are forces without a potential";
    if (k->magnetic) return "the Lagrangian has a part linear in the velocities";
    if (!k->affine) return "a constraint is not linear in the velocities";
    if (!k->linear) return "a constraint is affine, not linear, in the velocities";
    if (!k->metric) return "the mass matrix of all velocities is not positive definite";
    return NULL;
}

static nh_kinetic *create(const nh_model *model, uint64_t seed, bool metric_alone, nh_error *error)
{
    enum { least_places = 12 };
    nh_arena *arena = nh_arena_create();
    nh_kinetic *k = nh_arena_alloc(arena, sizeof *k);
    size_t m = model->m, f = model->k;
    *k = (nh_kinetic){.model = model,
                      .dag = model->dag,
                      .arena = arena,
                      .m = m,
                      .f = f,
                      .forced = model->system->has_forces && !metric_alone};
    nh_ex *all = nh_arena_alloc(arena, (3 * m + m * m + f * (m + 2) + 1) * sizeof *all);
    k->q = all;
    k->v = k->q + m;
    k->a = k->v + m;
    k->K = k->a + m;
    k->omega = k->K + m * m;
    k->b = k->omega + f * m;
    k->force = k->b + f;
    k->Q = model->system->force;
    k->name = nh_arena_alloc(arena, m * sizeof *k->name);
    k->angle = nh_arena_alloc(arena, 3 * m * sizeof *k->angle);
    k->dependent = k->angle + m;
    k->periodic = k->dependent + m;
    for (size_t j = 0; j < model->system->dependents; j++) k->dependent[model->system->dependent[j]] = true;
    for (size_t s = 0; s < m; s++) {
        k->name[s] = model->system->coordinate[s].name;
        k->angle[s] = model->system->coordinate[s].type == NH_ANGLE;
        k->periodic[s] = k->angle[s] && !model->system->coordinate[s].counted;
        k->q[s] = model->system->coordinate[s].q;
        k->v[s] = model->system->coordinate[s].v;
    }
    read_lagrangian(k, metric_alone);
    bool autonomous = k->autonomous;
    read_constraints(k);
    if (metric_alone) k->autonomous = autonomous;
    take_places(k, seed);
    k->metric = has_metric(k);
    k->obstacle = obstacle_of(k);
    k->reducible = !k->obstacle;
    k->countable = k->invertible && k->affine && k->autonomous && forces_autonomous(k);
    k->general = k->metric && k->countable;
    if (k->places >= least_places) return k;
    nh_fail(error, NH_NUMERIC, "", "only %zu sample points of the domain are usable", k->places);
    nh_error_hint(error, "give a domain on which the Lagrangian and the constraints are defined");
    nh_kinetic_free(k);
    return NULL;
}

nh_kinetic *nh_kinetic_create(const nh_model *model, uint64_t seed, nh_error *error)
{
    return create(model, seed, false, error);
}

nh_kinetic *nh_kinetic_metric(const nh_model *model, uint64_t seed, nh_error *error)
{
    return create(model, seed, true, error);
}

void nh_kinetic_free(nh_kinetic *k)
{
    if (k) nh_arena_free(k->arena);
}

static bool used(const nh_kinetic *k, const char *name)
{
    const nh_system *system = k->model->system;
    nh_ex symbol;
    bool found = nh_symbol_find(k->dag, name, &symbol);
    for (size_t i = 0; i < system->definitions && !found; i++) found = !strcmp(system->definition[i].name, name);
    for (size_t i = 0; i < system->quasi && !found; i++)
        found = !strcmp(nh_name_of(k->dag, system->quasi_velocity[i]), name);
    return found;
}

const char *nh_kinetic_unused_name(const nh_kinetic *k, const char *format, ...)
{
    char text[200];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    const char *name = nh_arena_printf(k->arena, "%s", text);
    while (used(k, name)) name = nh_arena_printf(k->arena, "%s_r", name);
    return name;
}

nh_tape *nh_kinetic_tape(const nh_kinetic *k, size_t count, const nh_ex *out)
{
    return nh_tape_create(k->dag, k->m, k->q, count, out, k->model->system->parameters, k->model->parameter,
                          k->model->parameter_value);
}

nh_ex nh_kinetic_diff(const nh_kinetic *k, nh_ex e, nh_ex x)
{
    return nh_interrupted() ? nh_int(k->dag, 0) : nh_diff(k->dag, e, x);
}

/* Values of `count` expressions of q at the places: places x count. */
static void run(const nh_kinetic *k, size_t count, const nh_ex *e, size_t places, const double *q, double *out)
{
    nh_tape *tape = nh_kinetic_tape(k, count, e);
    nh_tape_work *work = nh_tape_work_create(tape);
    for (size_t p = 0; p < places; p++) nh_tape_eval(tape, work, q + p * k->m, out + p * count);
    nh_tape_work_free(work);
    nh_tape_free(tape);
}

void nh_kinetic_values(const nh_kinetic *k, size_t count, const nh_ex *e, const double *q, double *out)
{
    run(k, count, e, 1, q, out);
}

void nh_kinetic_sample(const nh_kinetic *k, size_t count, const nh_ex *e, size_t places, double *out)
{
    run(k, count, e, places, k->place, out);
}

void nh_kinetic_sizes(const nh_kinetic *k, size_t places, double *size)
{
    for (size_t s = 0; s < k->m; s++) {
        size[s] = 0;
        for (size_t p = 0; p < places; p++) size[s] = fmax(size[s], fabs(k->place[p * k->m + s]));
        if (k->angle[s] || size[s] == 0) size[s] = 1;
    }
}

double nh_kinetic_length(const nh_kinetic *k, const double *diagonal)
{
    double length = 0;
    for (size_t i = 0; i < k->m; i++)
        if (diagonal[i] > 0) length = fmax(length, nh_chart_unit(k->model->system, i) * sqrt(diagonal[i]));
    return length > 0 && isfinite(length) ? exp2(10 * round(log2(length) / 10)) : 1;
}

/* The largest sum of the moduli of the terms of each expression at some places, into size. */
static void terms_at(const nh_kinetic *k, size_t count, const nh_ex *e, size_t places, double *size)
{
    nh_ex *terms = nh_alloc_array(count + 1, sizeof *terms);
    double *value = nh_alloc_array(places * count + 1, sizeof *value);
    for (size_t i = 0; i < count; i++) terms[i] = nh_terms_moduli(k->dag, e[i]);
    nh_kinetic_sample(k, count, terms, places, value);
    for (size_t i = 0; i < places * count; i++) size[i % count] = fmax(size[i % count], value[i]);
    nh_free(terms);
    nh_free(value);
}

bool nh_kinetic_many_valued(const nh_kinetic *k, size_t count, const nh_ex *e)
{
    enum { most_places = 6 };
    static const double turn = 6.283185307179586, same = 1e-8;
    size_t places = k->places < most_places ? k->places : most_places;
    double *q = nh_alloc_array(k->m + 3 * count + 1, sizeof *q), *before = q + k->m, *after = before + count,
           *size = after + count;
    bool many = false;
    terms_at(k, count, e, places, size);
    nh_tape *tape = nh_kinetic_tape(k, count, e);
    nh_tape_work *work = nh_tape_work_create(tape);
    for (size_t p = 0; p < places && !many; p++) {
        memcpy(q, k->place + p * k->m, k->m * sizeof *q);
        nh_tape_eval(tape, work, q, before);
        for (size_t s = 0; s < k->m && !many; s++) {
            if (!k->periodic[s]) continue;
            q[s] += turn;
            nh_tape_eval(tape, work, q, after);
            q[s] -= turn;
            for (size_t i = 0; i < count; i++) many |= fabs(after[i] - before[i]) > same * size[i];
        }
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(q);
    return many;
}

bool nh_kinetic_rank(const nh_kinetic *k, size_t rows, size_t columns, const nh_ex *e, size_t *rank)
{
    nh_ex *value = nh_alloc_array(rows * columns + 1, sizeof *value);
    for (size_t i = 0; i < rows * columns; i++) value[i] = nh_model_values(k->model, e[i]);
    *rank = 0;
    bool known = !rows || !columns || nh_generic_rank(k->dag, rows, columns, value, rank);
    nh_free(value);
    return known;
}
