/* The equations for coefficients that are functions of several variables. */
#include "integrals/box_series_internal.h"

#include <string.h>

#include "base/memory.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/measure.h"
#include "integrals/exact_points.h"

enum { most_velocities = 8 };

/* ---- the equations ---- */

/* A polynomial in the velocities: the exponents of 1, w^i and w^i w^j, and their coefficients. */
typedef struct {
    size_t count;
    unsigned char (*exponent)[most_velocities];
    nh_ex *coefficient;
} polynomial;

/* d^gamma e/d w^gamma/gamma! at w = 0. */
static nh_ex coefficient_of(const nh_model *o, nh_ex e, const unsigned char *gamma)
{
    nh_dag *d = o->dag;
    int64_t factorial = 1;
    nh_ex zero[most_velocities];
    for (size_t i = 0; i < o->n; i++) {
        zero[i] = nh_int(d, 0);
        for (int64_t k = 1; k <= gamma[i]; k++) {
            e = nh_diff(d, e, o->chart->w[i]);
            factorial *= k;
        }
    }
    e = nh_substitute(d, e, o->n, o->chart->w, zero);
    return nh_model_values(o, nh_div(d, e, nh_int(d, factorial)));
}

static polynomial polynomial_of(const nh_model *o, nh_ex e, size_t degree, nh_arena *arena)
{
    size_t n = o->n, most = 1 + n + n * (n + 1) / 2;
    polynomial p = {.exponent = nh_arena_alloc(arena, most * sizeof *p.exponent),
                    .coefficient = nh_arena_alloc(arena, most * sizeof *p.coefficient)};
    memset(p.exponent, 0, most * sizeof *p.exponent);
    p.count = 1;
    for (size_t i = 0; i < n && degree > 0; i++) p.exponent[p.count++][i] = 1;
    for (size_t i = 0; i < n && degree > 1; i++)
        for (size_t j = i; j < n; j++, p.count++) {
            p.exponent[p.count][i]++;
            p.exponent[p.count][j]++;
        }
    for (size_t k = 0; k < p.count; k++) p.coefficient[k] = coefficient_of(o, e, p.exponent[k]);
    return p;
}

size_t nh_box_order(size_t n, const unsigned char *alpha)
{
    size_t sum = 0;
    for (size_t i = 0; i < n; i++) sum += alpha[i];
    return sum;
}

size_t nh_box_exponents(size_t n, size_t degree, size_t step, unsigned char *out)
{
    size_t count = 0;
    for (size_t top = degree + 1; top-- > 0;) {
        unsigned char alpha[most_velocities] = {0};
        if ((degree - top) % step) continue;
        alpha[0] = (unsigned char)top;
        for (bool more = true; more;) {
            if (out) memcpy(out + count * n, alpha, n);
            count++;
            size_t i = n - 1; /* finds the last exponent above 0 before that of the last velocity */
            do more = i-- > 0;
            while (more && alpha[i] == 0);
            if (!more) continue;
            unsigned char rest = alpha[n - 1];
            alpha[n - 1] = 0;
            alpha[i]--;
            alpha[i + 1] = (unsigned char)(rest + 1);
        }
    }
    return count;
}

/* Is every coefficient of the other parity than |gamma| zero?  */
static bool has_parity(const nh_model *o, const polynomial *p, size_t parity)
{
    for (size_t k = 0; k < p->count; k++)
        if (nh_box_order(o->n, p->exponent[k]) % 2 != parity && !nh_is_zero(o->dag, p->coefficient[k])) return false;
    return true;
}

/* Adds to the entry the coefficient of w^beta in w^alpha p. */
static void add_shifted(const nh_model *o, nh_ex *entry, const unsigned char *beta, const int *alpha,
                        const polynomial *p, int64_t factor)
{
    for (size_t k = 0; k < p->count; k++) {
        bool same = true;
        for (size_t i = 0; i < o->n; i++) same &= alpha[i] + p->exponent[k][i] == beta[i];
        if (same) *entry = nh_add(o->dag, *entry, nh_mul(o->dag, nh_int(o->dag, factor), p->coefficient[k]));
    }
}

static bool is_closed(const nh_model *o, const nh_box_equations *e, nh_ex coefficient)
{
    for (size_t s = 0; s < o->width; s++) {
        bool own = false;
        for (size_t j = 0; j < e->variables; j++) own |= e->variable[j] == o->chart->symbol[s];
        if (!own && nh_depends(o->dag, coefficient, o->chart->symbol[s])) return false;
    }
    return true;
}

/* Fills in the entries of the equations from the rates of the velocities and the slopes of the variables.  False where
 * an entry depends on other variables. */
static bool fill(nh_box_series *x, const polynomial *rate, const polynomial *slope, const unsigned char *beta,
                 nh_ex *along, nh_ex *plain)
{
    const nh_model *o = x->model;
    nh_box_equations *e = &x->equations;
    bool closed = true;
    for (size_t b = 0; b < e->equations; b++)
        for (size_t a = 0; a < x->words; a++) {
            int alpha[most_velocities];
            for (size_t i = 0; i < o->n; i++) alpha[i] = x->exponent[a * o->n + i];
            nh_ex *A = along + (b * x->words + a) * e->variables, *B = plain + b * x->words + a;
            for (size_t j = 0; j < e->variables; j++) {
                A[j] = nh_int(o->dag, 0);
                add_shifted(o, &A[j], beta + b * o->n, alpha, &slope[j], 1);
                closed = closed && is_closed(o, e, A[j]);
            }
            *B = nh_int(o->dag, 0);
            for (size_t i = 0; i < o->n; i++) {
                if (alpha[i] == 0) continue;
                alpha[i]--;
                add_shifted(o, B, beta + b * o->n, alpha, &rate[i], alpha[i] + 1);
                alpha[i]++;
            }
            closed = closed && is_closed(o, e, *B);
        }
    e->along = along;
    e->plain = plain;
    return closed;
}

/* Their derivatives would take more work than everything else. */
static bool are_long(const nh_model *o)
{
    enum { longest = 20000 };
    double sum = 0;
    for (size_t i = 0; i < o->n; i++) sum += (double)nh_complexity(o->dag, o->a[i]);
    return sum > longest;
}

static nh_ex slope_of(const nh_model *o, nh_ex variable)
{
    for (size_t s = 0; s < o->m; s++)
        if (o->system->coordinate[s].q == variable) return o->rho[s];
    return nh_int(o->dag, 1);
}

static void make_words(nh_box_series *x, nh_arena *arena)
{
    const nh_model *o = x->model;
    size_t step = x->split ? 2 : 1;
    x->words = nh_box_exponents(o->n, x->degree, step, NULL);
    x->exponent = nh_arena_alloc(arena, x->words * o->n + 1);
    x->word = nh_arena_alloc(arena, x->words * sizeof *x->word);
    nh_box_exponents(o->n, x->degree, step, x->exponent);
    for (size_t a = 0; a < x->words; a++) {
        x->word[a] = nh_int(o->dag, 1);
        for (size_t i = 0; i < o->n; i++)
            for (size_t k = 0; k < x->exponent[a * o->n + i]; k++)
                x->word[a] = nh_mul(o->dag, x->word[a], o->chart->w[i]);
    }
}

nh_box_series *nh_box_series_create(const nh_model *o, size_t variables, const nh_ex *variable, size_t degree,
                                    nh_arena *arena)
{
    if (o->n == 0 || o->n > most_velocities || variables > NH_BOX_VARIABLES || o->chart->implicit) return NULL;
    if (are_long(o)) return NULL;
    nh_box_series *x = nh_arena_alloc(arena, sizeof *x);
    polynomial rate[most_velocities], slope[NH_BOX_VARIABLES];
    nh_ex *own = nh_arena_alloc(arena, variables * sizeof *own);
    memcpy(own, variable, variables * sizeof *own);
    *x = (nh_box_series){.model = o, .degree = degree, .split = true};
    for (size_t i = 0; i < o->n; i++) {
        rate[i] = polynomial_of(o, o->a[i], 2, arena);
        x->split &= has_parity(o, &rate[i], 0);
    }
    for (size_t j = 0; j < variables; j++) {
        slope[j] = polynomial_of(o, slope_of(o, variable[j]), 1, arena);
        x->split &= has_parity(o, &slope[j], 1);
    }
    make_words(x, arena);
    size_t step = x->split ? 2 : 1, equations = nh_box_exponents(o->n, degree + 1, step, NULL);
    unsigned char *beta = nh_arena_alloc(arena, equations * o->n + 1);
    nh_box_exponents(o->n, degree + 1, step, beta);
    x->equations =
        (nh_box_equations){.variables = variables, .variable = own, .functions = x->words, .equations = equations};
    nh_ex *along = nh_arena_alloc(arena, equations * x->words * variables * sizeof *along),
          *plain = nh_arena_alloc(arena, equations * x->words * sizeof *plain);
    return fill(x, rate, slope, beta, along, plain) ? x : NULL;
}

size_t nh_box_series_shape(const nh_model *o, nh_ex out[NH_BOX_VARIABLES])
{
    size_t n = 0;
    bool *taken = nh_alloc_array(o->m + 1, sizeof *taken);
    for (bool more = true; more;) {
        more = false;
        for (size_t s = 0; s <= o->m; s++) {
            nh_ex q = o->chart->symbol[s]; /* t first */
            bool occurs = false;
            for (size_t i = 0; i < o->n; i++) occurs |= nh_depends(o->dag, o->a[i], q);
            for (size_t j = 1; j <= o->m; j++) occurs |= taken[j] && nh_depends(o->dag, o->rho[j - 1], q);
            if (!occurs || taken[s]) continue;
            taken[s] = more = true;
            if (n < NH_BOX_VARIABLES) out[n] = q;
            n++;
        }
    }
    nh_free(taken);
    return n;
}
