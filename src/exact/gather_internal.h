/* gather_internal: sums of products of powers, in which gather looks for short forms. */
#ifndef NH_GATHER_INTERNAL_H
#define NH_GATHER_INTERNAL_H

#include "base/memory.h"
#include "graph/expr.h"

/* A kernel is a symbol, a call of a function, a root or a sum below a fraction bar: what stands in products with whole
 * exponents. */
enum { NH_GATHER_KERNELS = 24, NH_GATHER_TERMS = 64, NH_GATHER_MEMO = 1024 };

typedef struct {
    nh_num c;
    int8_t x[NH_GATHER_KERNELS]; /* exponents of the kernels */
} nh_gather_term;

/* A sum of terms, sorted by their exponents, each of which occurs once. */
typedef struct {
    size_t n;
    nh_gather_term *t;
} nh_gather_sum;

typedef struct {
    nh_dag *dag;
    nh_arena *arena;
    size_t kernels, length[NH_GATHER_KERNELS]; /* printed lengths */
    nh_ex kernel[NH_GATHER_KERNELS];
    int cosine[NH_GATHER_KERNELS]; /* of a sine: the cosine of the same angle; else -1 */
    bool closed;                   /* powers of sums are kernels: nothing is multiplied out */
    bool failed;                   /* too many terms or kernels, or too long numbers */
    size_t work, most_work;        /* steps so far; so many may there be */
    struct {
        nh_gather_sum sum;
        int width;
        nh_ex shape;
    } memo[NH_GATHER_MEMO];
} nh_gathering;

/* ---- gather_sum.c ---- */

/* The number of the kernel, made when new; sets `failed` where there is no room. */
size_t nh_gather_kernel(nh_gathering *g, nh_ex e);
/* e multiplied out; sets `failed` where that is too long. */
nh_gather_sum nh_gather_expand(nh_gathering *g, nh_ex e);
/* A sum with room for n terms, none of them there; sorts it when its terms are there, and adds like terms. */
nh_gather_sum nh_gather_room(nh_gathering *g, size_t n);
void nh_gather_sort(nh_gathering *g, nh_gather_sum *s);
/* a + c b, a b, and a / t, where the terms are divisible as numbers are */
nh_gather_sum nh_gather_add(nh_gathering *g, nh_gather_sum a, nh_num c, nh_gather_sum b);
nh_gather_sum nh_gather_multiply(nh_gathering *g, nh_gather_sum a, nh_gather_sum b);
nh_gather_sum nh_gather_times(nh_gathering *g, nh_gather_sum a, const nh_gather_term *t, bool divide);
/* p = d q + r, where each term of d times each of q is a term of p, and no two of these fall together; false: q = 0. */
bool nh_gather_divide(nh_gathering *g, nh_gather_sum p, nh_gather_sum d, nh_gather_sum *q, nh_gather_sum *r);
/* May t be divided by d without a new negative exponent? */
bool nh_gather_divides(const nh_gathering *g, const nh_gather_term *d, const nh_gather_term *t);
bool nh_gather_same(const nh_gathering *g, const nh_gather_term *a, const nh_gather_term *b);
/* sin^2 = 1 - cos^2 or the other way round, wherever such a square stands. */
nh_gather_sum nh_gather_reduce(nh_gathering *g, nh_gather_sum p, size_t from, size_t to);
nh_ex nh_gather_product(nh_gathering *g, const nh_gather_term *t);
nh_ex nh_gather_written(nh_gathering *g, nh_gather_sum p);

/* ---- gather_shape.c ---- */

/* The printed length, and more for what reads badly: fraction bars and nested parentheses. */
size_t nh_gather_cost(const nh_dag *dag, nh_ex e);

/* Forms of p that compete; `width`: how many ways are tried. */
typedef struct {
    nh_gathering *g;
    nh_gather_sum p;
    int width;
    nh_ex best;
    size_t length; /* its cost */
} nh_gather_contest;
/* Takes e where it costs less than the best so far. */
void nh_gather_offer(nh_gather_contest *c, nh_ex e);
static inline bool nh_gather_tired(const nh_gathering *g) { return g->failed || g->work > g->most_work; }
bool nh_gather_is_one(const nh_gathering *g, const nh_gather_term *t);

/* The shortest form of p that was found.  `width`: how many ways are tried at each step. */
nh_ex nh_gather_shape(nh_gathering *g, nh_gather_sum p, int width);

/* ---- gather_square.c ---- */

void nh_gather_offer_squares(nh_gather_contest *c);

#endif
