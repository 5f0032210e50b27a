#include "evaluate/tape_complex.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "evaluate/named_value.h"
#include "evaluate/tape_internal.h"
#include "graph/function.h"

/* Written out: C's operators check every product for infinities. */
static double complex times(double complex a, double complex b)
{
    return CMPLX(creal(a) * creal(b) - cimag(a) * cimag(b), creal(a) * cimag(b) + cimag(a) * creal(b));
}

static double complex over(double complex a, double complex b)
{
    double size = creal(b) * creal(b) + cimag(b) * cimag(b);
    double complex top = times(a, conj(b));
    return CMPLX(creal(top) / size, cimag(top) / size);
}

static double complex power(double complex a, double complex b)
{
    if (cimag(b) != 0) return creal(a) > 0 ? cexp(times(b, clog(a))) : NAN;
    double x = creal(a), n = creal(b);
    return CMPLX(pow(x, n), n == 0 ? 0 : n * pow(x, n - 1) * cimag(a));
}

static double complex angle(double complex y, double complex x)
{
    double a = creal(x), b = creal(y);
    return CMPLX(atan2(b, a), (a * cimag(y) - b * cimag(x)) / (a * a + b * b));
}

static double complex call(unsigned f, double complex a, double complex b)
{
    double x = creal(a);
    switch (f) {
    case NH_SIN: return csin(a);
    case NH_COS: return ccos(a);
    case NH_TAN: return ctan(a);
    case NH_ASIN: return fabs(x) <= 1 ? casin(a) : NAN;
    case NH_ACOS: return fabs(x) <= 1 ? cacos(a) : NAN;
    case NH_ATAN: return catan(a);
    case NH_SINH: return csinh(a);
    case NH_COSH: return ccosh(a);
    case NH_TANH: return ctanh(a);
    case NH_ASINH: return casinh(a);
    case NH_ACOSH: return x >= 1 ? cacosh(a) : NAN;
    case NH_ATANH: return fabs(x) <= 1 ? catanh(a) : NAN;
    case NH_EXP: return cexp(a);
    case NH_LOG: return x >= 0 ? clog(a) : NAN;
    case NH_ABS: return x < 0 ? -a : a;
    case NH_SIGN: return x > 0 ? 1 : x < 0 ? -1 : x;
    case NH_ATAN2: return angle(a, b);
    default: return NAN;
    }
}

static double complex value_of(unsigned op, double complex a, double complex b)
{
    switch (op) {
    case NH_OP_ADD: return a + b;
    case NH_OP_SUB: return a - b;
    case NH_OP_MUL: return times(a, b);
    case NH_OP_DIV: return over(a, b);
    case NH_OP_NEG: return -a;
    case NH_OP_INV: return over(1, a);
    case NH_OP_SQUARE: return times(a, a);
    case NH_OP_SQRT: return creal(a) >= 0 ? csqrt(a) : NAN;
    case NH_OP_POW: return power(a, b);
    default: return call(op - NH_OP_FUNCTION, a, b);
    }
}

/* A table has values at real places only: beside them to the first order, as complex steps need it. */
static double complex table_value(const nh_tape *tape, const double complex *argument)
{
    const nh_spline *s = tape->table[(size_t)creal(argument[0])];
    unsigned n = (unsigned)creal(argument[1]), i = n % NH_SPLINE_ORDERS, j = n / NH_SPLINE_ORDERS;
    double x = creal(argument[2]), y = creal(argument[3]);
    double slope = nh_spline_value(s, i + 1, j, x, y) * cimag(argument[2]);
    if (s->y) slope += nh_spline_value(s, i, j + 1, x, y) * cimag(argument[3]);
    return CMPLX(nh_spline_value(s, i, j, x, y), slope);
}

double complex *nh_tape_complex_create(const nh_tape *tape)
{
    double complex *work = nh_alloc_array(tape->registers + 1, sizeof *work);
    for (size_t i = 0; i < tape->constants; i++) work[tape->inputs + i] = tape->constant[i];
    return work;
}

void nh_tape_eval_complex(const nh_tape *tape, double complex *r, const double complex *in, double complex *out)
{
    if (tape->inputs) memcpy(r, in, tape->inputs * sizeof *r);
    for (const nh_instruction *x = tape->code, *end = x + tape->length; x < end; x++) {
        const nh_more_arguments *more = x->more ? &tape->more[x->more - 1] : NULL;
        const double complex argument[NH_MOST_ARGUMENTS] = {r[x->a], r[x->b], more ? r[more->c] : 0,
                                                            more ? r[more->d] : 0};
        if (x->op == NH_OP_FUNCTION + NH_TABLE) {
            r[x->to] = table_value(tape, argument);
            continue;
        }
        r[x->to] = nh_op_is_named(x->op) ? nh_named_value_complex((nh_function)(x->op - NH_OP_FUNCTION), argument)
                                         : value_of(x->op, r[x->a], r[x->b]);
    }
    for (size_t i = 0; i < tape->outputs; i++) out[i] = r[tape->output[i]];
}
