#include "system/levels.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/diff.h"
#include "evaluate/tape.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "system/domain.h"
#include "system/sample.h"

enum { starts = 240, newton_steps = 80, enough_starts = 20, deepest = 60 };
static const double farthest = 100; /* starting points lie within so many times the domain around its middle */

/* ---- proved by intervals ---- */

typedef struct {
    double low, high;
} range;

static const range everything = {-INFINITY, INFINITY};

/* Rounded outwards: a sum, a product or a function of doubles is off by less than this part of itself. */
static range outwards(range r)
{
    static const double part = 4 * DBL_EPSILON;
    return (range){r.low - part * fabs(r.low), r.high + part * fabs(r.high)};
}

/* With 0 * infinity = 0: a factor zero is exact here. */
static double times(double a, double b) { return a == 0 || b == 0 ? 0 : a * b; }

static range product_of(range a, range b)
{
    double p[4] = {times(a.low, b.low), times(a.low, b.high), times(a.high, b.low), times(a.high, b.high)};
    return outwards((range){fmin(fmin(p[0], p[1]), fmin(p[2], p[3])), fmax(fmax(p[0], p[1]), fmax(p[2], p[3]))});
}

static range power_of(range b, nh_num x)
{
    if (x.q == 1 && x.p > 0 && x.p % 2 == 0) {
        double least = b.low <= 0 && b.high >= 0 ? 0 : fmin(fabs(b.low), fabs(b.high));
        return (range){pow(least, (double)x.p), pow(fmax(fabs(b.low), fabs(b.high)), (double)x.p)};
    }
    if (x.q == 1 && x.p > 0) return (range){pow(b.low, (double)x.p), pow(b.high, (double)x.p)};
    bool even = x.q == 1 && x.p % 2 == 0;
    /* roots are not negative */
    return even || x.q != 1 ? (range){0, INFINITY} : b.low >= 0 ? (range){0, INFINITY} : everything;
}

static range function_of(nh_function f, range a)
{
    static const double half_turn = 3.1415926535897936;
    switch (f) {
    case NH_SIN:
    case NH_COS:
    case NH_TANH:
    case NH_SIGN: return (range){-1, 1};
    case NH_EXP: return (range){0, INFINITY};
    case NH_COSH: return (range){1, INFINITY};
    case NH_ABS: return a.low > 0 ? a : a.high < 0 ? (range){-a.high, -a.low} : (range){0, INFINITY};
    case NH_ATAN:
    case NH_ASIN: return (range){-half_turn / 2, half_turn / 2};
    case NH_ACOS: return (range){0, half_turn};
    case NH_ATAN2: return (range){-half_turn, half_turn};
    case NH_ACOSH: return (range){0, INFINITY};
    case NH_PI: return (range){3.1415926535897927, half_turn};
    default: return everything;
    }
}

/* Bounds of e, wherever it is real. */
static range range_of(const nh_system *system, nh_ex e, int depth)
{
    const nh_dag *d = system->dag;
    range out;
    if (depth > deepest) return everything;
    switch (nh_kind_of(d, e)) {
    case NH_NUMBER: out.low = out.high = nh_num_value(nh_number_of(d, e)); return outwards(out);
    case NH_SYMBOL:
        for (size_t i = 0; i < system->parameters; i++)
            if (system->parameter[i].symbol == e)
                return (range){system->parameter[i].value, system->parameter[i].value};
        return everything;
    case NH_SUM:
        out.low = out.high = nh_num_value(nh_constant_of(d, e));
        out = outwards(out);
        for (size_t i = 0; i < nh_arity(d, e); i++) {
            double c = nh_num_value(nh_coefficient_of(d, e, i));
            range term = product_of((range){c, c}, range_of(system, nh_child(d, e, i), depth + 1));
            out = outwards((range){out.low + term.low, out.high + term.high});
        }
        return out;
    case NH_PRODUCT:
        out.low = out.high = nh_num_value(nh_constant_of(d, e));
        out = outwards(out);
        for (size_t i = 0; i < nh_arity(d, e); i++) {
            nh_ex x = nh_exponent_of(d, e, i);
            range base = range_of(system, nh_child(d, e, i), depth + 1);
            bool numeric = nh_kind_of(d, x) == NH_NUMBER && nh_num_short(nh_number_of(d, x));
            out = product_of(out, numeric ? outwards(power_of(base, nh_number_of(d, x))) : everything);
        }
        return out;
    default:
        return function_of(nh_function_of(d, e),
                           nh_arity(d, e) ? range_of(system, nh_child(d, e, 0), depth + 1) : everything);
    }
}

static bool never_zero(const nh_system *system, nh_ex e)
{
    range r = range_of(system, e, 0);
    return r.low > 0 || r.high < 0;
}

/* ---- search for a point ---- */

typedef struct {
    nh_system *system;
    size_t k, m, width; /* levels; coordinates; 1 + m */
    nh_tape *tape;      /* k levels, then their derivatives by (t, q), column-major */
    nh_tape_work *work;
    double *out, *dense, *step, *half; /* half: of the sampling interval of each */
} search;

/* |f| relative to the change of f by a step of the size of q, or of its sampling interval. */
static bool is_zero(const search *x, const double *z)
{
    static const double small = 1e-9;
    for (size_t a = 0; a < x->k; a++) {
        double size = 0;
        for (size_t j = 0; j < x->width; j++)
            size = fmax(size, fabs(x->out[x->k + a + j * x->k]) * (x->half[j] + fabs(z[j])));
        if (fabs(x->out[a]) > small * size) return false;
    }
    return true;
}

static double residual(const search *x)
{
    double sum = 0;
    for (size_t a = 0; a < x->k; a++) sum += x->out[a] * x->out[a];
    return sqrt(sum);
}

/* From z, by steps that are halved until |f| falls: 1 for a point, 0 for none, -1 where the levels cannot be
 * evaluated.  t stays. */
static int descend(search *x, double *z)
{
    size_t k = x->k, m = x->m, big = k > m ? k : m;
    double *trial = x->step + big;
    nh_tape_eval(x->tape, x->work, z, x->out);
    for (int i = 0; i < newton_steps; i++) {
        double now = residual(x), cut = 1, then = INFINITY;
        if (!isfinite(now)) return i ? 0 : -1;
        if (is_zero(x, z)) return 1;
        memcpy(x->dense, x->out + 2 * k, k * m * sizeof *x->dense);
        memset(x->step, 0, big * sizeof *x->step);
        memcpy(x->step, x->out, k * sizeof *x->step);
        if (nh_least_squares(k, m, x->dense, 1, x->step, big, 1e-12) < 0) return 0;
        for (int half = 0; half < 30 && !(then < now); half++, cut /= 2) {
            trial[0] = z[0];
            for (size_t j = 0; j < m; j++) trial[1 + j] = z[1 + j] - cut * x->step[j];
            nh_tape_eval(x->tape, x->work, trial, x->out);
            then = residual(x);
        }
        if (!(then < now)) return 0;
        memcpy(z, trial, x->width * sizeof *z);
    }
    return is_zero(x, z);
}

static void create(search *x, const nh_ex *level)
{
    nh_system *system = x->system;
    nh_ex *in = nh_alloc_array(x->width, sizeof *in), *out = nh_alloc_array(x->k * (1 + x->width), sizeof *out);
    const nh_ex *symbols;
    const double *values;
    in[0] = system->t;
    for (size_t i = 0; i < x->m; i++) in[1 + i] = system->coordinate[i].q;
    for (size_t a = 0; a < x->k; a++) {
        out[a] = level[a];
        for (size_t j = 0; j < x->width; j++) out[x->k + a + j * x->k] = nh_diff(system->dag, level[a], in[j]);
    }
    nh_system_bindings(system, &symbols, &values);
    x->tape =
        nh_tape_create(system->dag, x->width, in, x->k * (1 + x->width), out, system->parameters, symbols, values);
    x->work = nh_tape_work_create(x->tape);
    x->out = nh_alloc_array(x->k * (1 + x->width), sizeof *x->out);
    x->dense = nh_alloc_array(x->k * x->m + 1, sizeof *x->dense);
    x->step = nh_alloc_array((x->k > x->m ? x->k : x->m) + x->width + 1, sizeof *x->step);
    x->half = nh_alloc_array(x->width, sizeof *x->half);
    for (size_t j = 0; j < x->width; j++) {
        double low, high;
        nh_domain_range(system, in[j], &low, &high);
        x->half[j] = (high - low) / 2;
    }
    nh_free(in);
    nh_free(out);
}

static void clear(search *x)
{
    nh_tape_work_free(x->work);
    nh_tape_free(x->tape);
    nh_free(x->out);
    nh_free(x->dense);
    nh_free(x->step);
    nh_free(x->half);
}

/* Does the search from some start end at a point?  Also true where hardly any point can be evaluated: then it is not
 * decided. */
static bool has_point(nh_system *s, size_t k, const nh_ex *level, uint64_t seed)
{
    search x = {.system = s, .k = k, .m = s->coordinates, .width = 1 + s->coordinates};
    size_t evaluated = 0;
    bool found = false;
    double *z = nh_alloc_array(x.width, sizeof *z);
    create(&x, level);
    for (int i = 0; i < starts && !found; i++) {
        double scale = pow(farthest, (double)i / starts);
        for (size_t j = 0; j < x.width; j++) {
            double low, high;
            nh_domain_range(s, j ? s->coordinate[j - 1].q : s->t, &low, &high);
            z[j] = (low + high) / 2 + (j ? scale : 1) * (high - low) * (nh_random(&seed) - 0.5);
        }
        int end = descend(&x, z);
        found = end == 1;
        evaluated += end >= 0;
    }
    clear(&x);
    nh_free(z);
    return found || evaluated < enough_starts;
}

bool nh_levels_check(nh_system *system, uint64_t seed, nh_error *error)
{
    nh_ex *level = nh_alloc_array(system->constraints + 1, sizeof *level);
    size_t k = 0, a = 0;
    bool good = true, proved = false;
    for (; a < system->constraints && good; a++) {
        if (!system->constraint[a].position) continue;
        level[k++] = system->constraint[a].level;
        proved = never_zero(system, level[k - 1]);
        good = !proved && has_point(system, k, level, seed);
        if (good) continue;
        const nh_deck_node *node = system->constraint[a].node;
        if (proved)
            nh_deck_fail(system->deck, node, 0, error,
                         "no real positions satisfy this constraint: its two sides differ everywhere");
        else if (k == 1)
            nh_deck_fail(system->deck, node, 0, error, "no positions were found that satisfy this constraint");
        else
            nh_deck_fail(system->deck, node, 0, error,
                         "no positions were found that satisfy this constraint and those before it");
        if (proved) nh_error_hint(error, "check the signs and the parameter values");
        else
            nh_error_hint(
                error,
                "Newton's method was started at %d points, up to %g times the sampling domain around its centre; "
                "if solutions exist, give a `domain:` near them",
                starts, farthest);
    }
    nh_free(level);
    return good;
}
