/* reflection: all maps S are tried, as bits, on values at a few points. [docs/method.md, sec. 4, "Sectors"]
 *
 *     bit      0       1 .. m        m + 1 ..              then
 *     sign of  t       q^1 .. q^m    w^i (quasi only)      shifts by pi of the angles
 *
 * In coordinate velocities the sign of w^i is that of t times that of its coordinate.  Maps that hold form a group;
 * bits that hold are entered into an echelon form over two elements, whose rows are its generators. */
#include "integrals/reflection.h"

#include <math.h>
#include <string.h>

#include "exact/normal.h"
#include "graph/function.h"
#include "graph/node.h"

enum { most_bits = 14, trial_points = 5 };

typedef struct {
    const nh_model *o;
    nh_tape *tape; /* rho (m), a (n), residuals of the implicit velocities */
    nh_tape_work *work;
    size_t outputs, points;
    double *z, *value; /* points x width, points x outputs */
    double *image, *there;
    size_t angles, angle[64], bits;
} trial;

/* ---- candidates: bits are e_0, e_1..e_m, shifts of the angles, and f_1..f_n where these do not follow from e ---- */

/* Does q stand in a sine, cosine or tangent of the equations of motion? */
static bool is_wave(const nh_model *model, nh_ex q)
{
    NH_LIST(call);
    for (size_t i = 0; i < model->m + model->n; i++) {
        nh_ex e = i < model->m ? model->rho[i] : model->a[i - model->m];
        size_t n = nh_functions_in(model->dag, e, &call);
        for (size_t j = 0; j < n; j++) {
            nh_function f = nh_function_of(model->dag, call[j]);
            if ((f == NH_SIN || f == NH_COS || f == NH_TAN) && nh_depends(model->dag, call[j], q)) return true;
        }
    }
    return false;
}

/* Values of rho, a and of the residuals of the implicit velocities at the points. */
static trial start(const nh_model *model, const nh_points *points)
{
    size_t m = model->m, n = model->n, k = model->chart->implicit;
    trial t = {.o = model, .outputs = m + n + k, .points = points->count < trial_points ? points->count : trial_points};
    nh_ex *e = nh_alloc_array(t.outputs + 1, sizeof *e);
    memcpy(e, model->rho, m * sizeof *e);
    memcpy(e + m, model->a, n * sizeof *e);
    for (size_t i = 0; i < k; i++) e[m + n + i] = model->chart->residual[i];
    t.tape = nh_model_tape(model, t.outputs, e);
    t.work = nh_tape_work_create(t.tape);
    nh_free(e);
    t.z = nh_alloc_array(t.points * model->width + 1, sizeof *t.z);
    t.value = nh_alloc_array(t.points * t.outputs + 1, sizeof *t.value);
    t.image = nh_alloc_array(model->width, sizeof *t.image);
    t.there = nh_alloc_array(t.outputs + 1, sizeof *t.there);
    for (size_t p = 0; p < t.points; p++) {
        for (size_t j = 0; j < model->width; j++) t.z[p * model->width + j] = points->column[j][p];
        nh_tape_eval(t.tape, t.work, t.z + p * model->width, t.value + p * t.outputs);
    }
    for (size_t s = 0; s < m && t.angles < 64; s++)
        if (is_wave(model, model->system->coordinate[s].q)) t.angle[t.angles++] = s;
    size_t plain = 1 + m + (model->chart->quasi ? n : 0);
    if (plain + t.angles > most_bits) t.angles = 0;
    t.bits = plain + t.angles;
    return t;
}

static void finish(trial *t)
{
    nh_tape_work_free(t->work);
    nh_tape_free(t->tape);
    nh_free(t->z);
    nh_free(t->value);
    nh_free(t->image);
    nh_free(t->there);
}

/* The map with these bits. */
static void decode(const trial *t, uint32_t bits, nh_reflection *r)
{
    const nh_model *model = t->o;
    size_t m = model->m, n = model->n, bit = 0;
    const nh_chart *c = model->chart;
    memset(r->shift, 0, model->width * sizeof *r->shift);
    for (size_t j = 0; j <= m; j++) r->sign[j] = bits >> bit++ & 1 ? -1 : 1;
    for (size_t i = 0; i < n; i++) {
        if (c->quasi) r->sign[1 + m + i] = bits >> bit++ & 1 ? -1 : 1;
        else r->sign[1 + m + i] = (signed char)(r->sign[0] * r->sign[1 + c->free[i]]);
    }
    for (size_t i = 0; i < c->implicit; i++)
        r->sign[1 + m + n + i] = (signed char)(r->sign[0] * r->sign[1 + c->dependent[i]]);
    for (size_t i = 0; i < t->angles; i++)
        if (bits >> bit++ & 1) r->shift[1 + t->angle[i]] = acos(-1);
}

void nh_reflect(const nh_reflection *r, size_t width, const double *z, double *out)
{
    for (size_t j = 0; j < width; j++) out[j] = r->sign[j] * z[j] + r->shift[j];
}

static bool close_to(double a, double b, double size) { return fabs(a - b) <= 1e-9 * (size + fabs(a) + fabs(b)); }

/* rho^s(S z) = e_0 e_s rho^s(z), a^i(S z) = e_0 f_i a^i(z), and residuals that stay 0, at point p. */
static bool holds_at(trial *t, const nh_reflection *r, size_t p)
{
    const nh_model *o = t->o;
    const double *here = t->value + p * t->outputs;
    double speed = 0, strength = 0;
    nh_reflect(r, o->width, t->z + p * o->width, t->image);
    nh_tape_eval(t->tape, t->work, t->image, t->there);
    for (size_t s = 0; s < o->m; s++) speed = fmax(speed, fabs(here[s]));
    for (size_t i = 0; i < o->n; i++) strength = fmax(strength, fabs(here[o->m + i]));
    for (size_t k = 0; k < t->outputs; k++) {
        bool velocity = k < o->m, residual = k >= o->m + o->n;
        int sign = residual ? 0 : r->sign[0] * r->sign[1 + k];
        if (!isfinite(t->there[k]) || !close_to(t->there[k], sign * here[k], velocity || residual ? speed : strength))
            return false;
    }
    return true;
}

static bool holds(trial *t, const nh_reflection *r)
{
    for (size_t p = 0; p < t->points; p++)
        if (!holds_at(t, r, p)) return false;
    return true;
}

/* ---- generators ---- */

static nh_reflection empty(nh_arena *arena, size_t width)
{
    nh_reflection r;
    r.sign = nh_arena_alloc(arena, width);
    r.shift = nh_arena_alloc(arena, width * sizeof *r.shift);
    return r;
}

/* Reduces by the known generators, and keeps the rest: Gaussian elimination over GF(2), each row with its own leading
 * bit. */
static void enter(uint32_t bits, uint32_t *basis, size_t *count)
{
    for (size_t i = 0; i < *count; i++)
        if ((bits ^ basis[i]) < bits) bits ^= basis[i];
    if (bits) basis[(*count)++] = bits;
    for (size_t i = *count; i-- > 1 && basis[i] > basis[i - 1];) {
        uint32_t x = basis[i];
        basis[i] = basis[i - 1];
        basis[i - 1] = x;
    }
}

nh_reflections *nh_reflections_find(const nh_model *model, const nh_points *points)
{
    nh_arena *arena = nh_arena_create();
    nh_reflections *out = nh_arena_alloc(arena, sizeof *out);
    *out = (nh_reflections){.arena = arena, .width = model->width};
    trial t = start(model, points);
    uint32_t basis[most_bits];
    size_t count = 0;
    nh_reflection r = empty(arena, model->width);
    for (uint32_t bits = 1; t.bits <= most_bits && t.points && bits < 1u << t.bits; bits++) {
        decode(&t, bits, &r);
        if (holds(&t, &r)) enter(bits, basis, &count);
    }
    out->generator = nh_arena_alloc(arena, (count + 1) * sizeof *out->generator);
    for (size_t i = 0; i < count; i++) {
        out->generator[i] = empty(arena, model->width);
        decode(&t, basis[i], &out->generator[i]);
    }
    out->count = count;
    finish(&t);
    return out;
}

nh_reflection nh_reflections_product(const nh_reflections *all, const nh_reflection *first, const nh_reflection *second)
{
    nh_reflection r = empty(all->arena, all->width);
    for (size_t j = 0; j < all->width; j++) {
        r.sign[j] = (signed char)(first->sign[j] * second->sign[j]);
        r.shift[j] = first->sign[j] * second->shift[j] + first->shift[j];
    }
    return r;
}

void nh_reflections_free(nh_reflections *r)
{
    if (r) nh_arena_free(r->arena);
}
