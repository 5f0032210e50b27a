#include "absence/monodromy.h"

#include <flint/fmpz_poly_factor.h>

#include "absence/monodromy_internal.h"
#include "base/foreign_memory.h"
#include "base/progress.h"

enum {
    digits = 20,
    first_bits = 256,
    last_bits = 4 * first_bits,
    most_points = 100, /* singular ones */
    spare_bits = 32    /* of the singular points */
};

static const uint64_t most_work = (uint64_t)1 << 27; /* about 5 seconds */

/* ---- equations and their singular points ---- */

/* Every row of num/den gets its own denominator. */
static void block_init(nh_monodromy_block *block, const nh_linear_equation *equation)
{
    size_t n = block->size = equation->size;
    block->num = nh_alloc_array(n * n + 1, sizeof *block->num);
    block->den = nh_alloc_array(n + 1, sizeof *block->den);
    block->order = NULL;
    fmpz_poly_t common;
    fmpz_poly_init(common);
    for (size_t a = 0; a < n; a++) {
        fmpz_poly_set(common, equation->den);
        for (size_t b = 0; b < n; b++) fmpz_poly_gcd(common, common, equation->num + a * n + b);
        fmpz_poly_init(block->den + a);
        fmpz_poly_div(block->den + a, equation->den, common);
        for (size_t b = 0; b < n; b++) {
            fmpz_poly_init(block->num + a * n + b);
            fmpz_poly_div(block->num + a * n + b, equation->num + a * n + b, common);
        }
    }
    fmpz_poly_clear(common);
}

static void block_clear(nh_monodromy_block *block)
{
    for (size_t k = 0; k < block->size * block->size; k++) fmpz_poly_clear(block->num + k);
    for (size_t a = 0; a < block->size; a++) fmpz_poly_clear(block->den + a);
    nh_free(block->num);
    nh_free(block->den);
    nh_free(block->order);
}

/* How often the factor divides p. */
static ulong multiplicity(const fmpz_poly_struct *p, const fmpz_poly_struct *factor)
{
    fmpz_poly_t rest;
    fmpz_poly_init(rest);
    ulong times = fmpz_poly_remove(rest, p, factor);
    fmpz_poly_clear(rest);
    return times;
}

/* The zeros of one irreducible factor, and their orders in every row. */
static void factor_points(nh_monodromy_sum *sum, const fmpz_poly_struct *factor, size_t first, size_t all)
{
    size_t degree = (size_t)fmpz_poly_degree(factor);
    arb_fmpz_poly_complex_roots(sum->point + first, factor, 0, sum->bits + spare_bits);
    for (size_t b = 0; b < sum->blocks; b++)
        for (size_t a = 0; a < sum->block[b].size; a++) {
            ulong times = multiplicity(sum->block[b].den + a, factor);
            for (size_t i = 0; i < degree; i++) sum->block[b].order[a * all + first + i] = times;
        }
}

static bool disjoint(const nh_monodromy_sum *sum)
{
    for (size_t i = 0; i < sum->points; i++)
        for (size_t k = 0; k < i; k++)
            if (acb_overlaps(sum->point + i, sum->point + k)) return false;
    return true;
}

bool nh_monodromy_sum_init(nh_monodromy_sum *sum, size_t blocks, const nh_linear_equation *block, long bits)
{
    *sum = (nh_monodromy_sum){.bits = bits, .blocks = blocks, .limit = most_work};
    sum->block = nh_alloc_array(blocks + 1, sizeof *sum->block);
    fmpz_poly_t common;
    fmpz_poly_factor_t factors;
    fmpz_poly_init(common);
    fmpz_poly_factor_init(factors);
    fmpz_poly_one(common);
    for (size_t b = 0; b < blocks; b++) {
        block_init(sum->block + b, block + b);
        sum->size += block[b].size;
        for (size_t a = 0; a < block[b].size; a++) fmpz_poly_lcm(common, common, sum->block[b].den + a);
    }
    fmpz_poly_factor(factors, common);
    for (slong k = 0; k < factors->num; k++) sum->points += (size_t)fmpz_poly_degree(factors->p + k);
    sum->point = _acb_vec_init((slong)sum->points);
    for (size_t b = 0; b < blocks; b++)
        sum->block[b].order = nh_alloc_array(block[b].size * sum->points + 1, sizeof *sum->block[b].order);
    size_t first = 0;
    for (slong k = 0; k < factors->num && sum->points <= most_points;
         first += (size_t)fmpz_poly_degree(factors->p + k), k++)
        factor_points(sum, factors->p + k, first, sum->points);
    fmpz_poly_factor_clear(factors);
    fmpz_poly_clear(common);
    return sum->points <= most_points && disjoint(sum);
}

void nh_monodromy_sum_clear(nh_monodromy_sum *sum)
{
    for (size_t b = 0; b < sum->blocks; b++) block_clear(sum->block + b);
    nh_free(sum->block);
    _acb_vec_clear(sum->point, (slong)sum->points);
}

nh_monodromy_element nh_monodromy_element_new(const nh_monodromy_sum *sum)
{
    nh_monodromy_element element = nh_alloc_array(sum->blocks + 1, sizeof *element);
    for (size_t b = 0; b < sum->blocks; b++) {
        acb_mat_init(element + b, (slong)sum->block[b].size, (slong)sum->block[b].size);
        acb_mat_one(element + b);
    }
    return element;
}

void nh_monodromy_element_free(const nh_monodromy_sum *sum, nh_monodromy_element element)
{
    for (size_t b = 0; b < sum->blocks; b++) acb_mat_clear(element + b);
    nh_free(element);
}

/* ---- the answer ---- */

static const char *trace_text(nh_arena *arena, const acb_mat_t g, long bits)
{
    acb_t trace;
    acb_init(trace);
    acb_mat_trace(trace, g, bits);
    char *re = arb_get_str(acb_realref(trace), digits, 0), *im = arb_get_str(acb_imagref(trace), digits, 0);
    const char *text = nh_arena_printf(arena, "%s + %s i", re, im);
    flint_free(re);
    flint_free(im);
    acb_clear(trace);
    return text;
}

static void traces(nh_arena *arena, nh_monodromy *m, const nh_monodromy_sum *sum, const nh_monodromy_element *loop)
{
    m->trace = nh_arena_alloc(arena, (sum->blocks * sum->points + 1) * sizeof *m->trace);
    for (size_t b = 0; b < sum->blocks; b++)
        for (size_t i = 0; i < sum->points; i++)
            m->trace[b * sum->points + i] = trace_text(arena, loop[i] + b, sum->bits);
}

static const char *obstacle(nh_arena *arena, const nh_monodromy_proof *proof, size_t size, long bits)
{
    if (proof->rank == size) return NULL;
    if (proof->rank)
        return nh_arena_printf(arena, "the elements found move a general vector in %zu of %zu dimensions", proof->rank,
                               size);
    if (!proof->simple) return nh_arena_printf(arena, "eigenvalues were not separated with %ld bits", bits);
    if (proof->moduli) return "no element was found whose eigenvalues are simple in every block";
    return proof->inaccurate
               ? nh_arena_printf(arena, "with %ld bits no multiplier's absolute value was told from 1", bits)
               : "every multiplier found has absolute value 1";
}

/* All loops; NULL, or why not. */
static const char *follow(nh_monodromy_sum *sum, nh_monodromy_element *loop, bool *hopeless)
{
    for (size_t i = 0; i < sum->points; i++) {
        if (nh_monodromy_loop(sum, i, loop[i])) continue;
        *hopeless = sum->work > sum->limit || nh_interrupted();
        return nh_interrupted() ? "the computation was ended"
               : *hopeless      ? "the continuation along closed paths takes too much work"
                                : "a closed path passes too near to singular points";
    }
    return NULL;
}

static nh_monodromy *attempt(nh_arena *arena, size_t blocks, const nh_linear_equation *block, long bits, bool *hopeless)
{
    nh_foreign_memory_begin();
    nh_monodromy *m = nh_arena_alloc(arena, sizeof *m);
    nh_monodromy_sum sum;
    *hopeless = false;
    bool apart = nh_monodromy_sum_init(&sum, blocks, block, bits);
    *m = (nh_monodromy){.size = sum.size, .blocks = blocks, .bits = bits, .singular = sum.points};
    nh_monodromy_element *loop = nh_alloc_array(sum.points + 1, sizeof *loop);
    for (size_t i = 0; i < sum.points; i++) loop[i] = nh_monodromy_element_new(&sum);
    if (sum.points > most_points) {
        *hopeless = true;
        m->obstacle = nh_arena_printf(arena, "there are more than %d singular points", most_points);
    } else if (!apart) {
        m->obstacle = nh_arena_printf(arena, "the singular points were not separated with %ld bits", bits);
    } else if (!sum.points) {
        *hopeless = true;
        m->obstacle = sum.size ? "there is no singular point: every closed path gives the identity" : NULL;
    } else if (!(m->obstacle = follow(&sum, loop, hopeless))) {
        nh_monodromy_proof proof;
        nh_monodromy_prove(&sum, loop, &proof);
        m->rank = proof.rank;
        m->words = proof.words;
        m->obstacle = obstacle(arena, &proof, sum.size, bits);
        *hopeless = !proof.inaccurate;
        traces(arena, m, &sum, loop);
    }
    m->steps = sum.steps;
    m->work = sum.work;
    for (size_t i = 0; i < sum.points; i++) nh_monodromy_element_free(&sum, loop[i]);
    nh_free(loop);
    nh_monodromy_sum_clear(&sum);
    return m;
}

nh_monodromy *nh_monodromy_of(nh_arena *arena, size_t blocks, const nh_linear_equation *block, long bits)
{
    bool hopeless;
    return attempt(arena, blocks, block, bits, &hopeless);
}

nh_monodromy *nh_monodromy_try(nh_arena *arena, size_t blocks, const nh_linear_equation *block)
{
    nh_monodromy *best = NULL;
    bool hopeless = false;
    for (long bits = first_bits; bits <= last_bits && !hopeless && !(best && nh_interrupted()); bits *= 2) {
        nh_monodromy *m = attempt(arena, blocks, block, bits, &hopeless);
        m->work += best ? best->work : 0;
        bool better = !best || m->rank > best->rank || (m->rank == best->rank && m->trace);
        if (better) best = m;
        else best->work = m->work;
        if (best->rank == best->size) break;
    }
    return best;
}
