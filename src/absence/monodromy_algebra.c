/* What monodromy matrices prove of the dimension of orbits.
 *
 * For g = V diag(mu) V^-1 in the group, V diag(log |mu|) V^-1 lies in the Lie algebra of its Zariski closure: a closed
 * subgroup of a torus is the common kernel of the characters that are 1 on it, and mu^k = 1 gives
 * sum k_i log |mu_i| = 0 [docs/method.md, "No other integral"].  So do conjugates by elements of the group, and
 * brackets.  The rank of {A x}, A in the Lie algebra, at one x is at most the largest dimension of an orbit. */
#include "absence/monodromy_internal.h"

#include <string.h>

#include "base/memory.h"
#include "base/progress.h"

enum {
    most_pairs = 40,  /* words of two letters */
    most_powers = 24, /* words of a power and a letter */
    most_longer = 24, /* words of three to six letters */
    shortest = 3,
    longer_lengths = 4,
    small_part = 4, /* what is less than 2^(-bits/4) of the largest, may be 0 */
    most_letters = 12
};

/* The elements found, as far as they concern some of the blocks: the quotient of the sum by the others. */
typedef struct {
    const nh_monodromy_sum *sum;
    const nh_monodromy_element *loop, *inverse; /* points */
    const bool *used;                           /* blocks */
    size_t size, rank, kept, examined;
    acb_mat_t row;              /* size x size: A x in echelon form, in `rank` rows */
    size_t *pivot;              /* columns, per row */
    nh_monodromy_element *keep; /* elements that raised the rank */
    acb_ptr x;
    bool inaccurate;
} span;

static void span_init(span *s, const nh_monodromy_sum *sum, const bool *used)
{
    s->sum = sum;
    s->used = used;
    s->size = s->rank = s->kept = s->examined = 0;
    s->inaccurate = false;
    for (size_t b = 0; b < sum->blocks; b++) s->size += used[b] ? sum->block[b].size : 0;
    acb_mat_init(s->row, (slong)s->size, (slong)s->size);
    s->pivot = nh_alloc_array(s->size + 1, sizeof *s->pivot);
    s->keep = nh_alloc_array(s->size + 1, sizeof *s->keep);
    s->x = _acb_vec_init((slong)s->size);
    enum { step_re = 61, step_im = 47, period_re = 101, period_im = 89, shift_re = 17, shift_im = 31 };
    for (size_t k = 0; k < s->size; k++) /* nothing special; any x is right */
        acb_set_si_si(s->x + k, shift_re + (slong)(k * step_re % period_re),
                      (slong)(k * step_im % period_im) - shift_im);
}

static void span_clear(span *s)
{
    for (size_t k = 0; k < s->kept; k++) nh_monodromy_element_free(s->sum, s->keep[k]);
    acb_mat_clear(s->row);
    _acb_vec_clear(s->x, (slong)s->size);
    nh_free(s->pivot);
    nh_free(s->keep);
}

/* Is a larger than b?  By lower bounds of absolute values. */
static bool larger(const acb_t a, const acb_t b)
{
    mag_t low_a, low_b;
    mag_init(low_a);
    mag_init(low_b);
    acb_get_mag_lower(low_a, a);
    acb_get_mag_lower(low_b, b);
    bool is = mag_cmp(low_a, low_b) > 0;
    mag_clear(low_a);
    mag_clear(low_b);
    return is;
}

/* A x, into the row behind the others. */
static void span_apply(span *s, const acb_mat_struct *element)
{
    size_t at = 0;
    for (size_t b = 0; b < s->sum->blocks; b++) {
        if (!s->used[b]) continue;
        size_t n = s->sum->block[b].size;
        for (size_t i = 0; i < n; i++)
            acb_dot(acb_mat_entry(s->row, (slong)s->rank, (slong)(at + i)), NULL, 0,
                    acb_mat_entry(element + b, (slong)i, 0), 1, s->x + at, 1, (slong)n, s->sum->bits);
        at += n;
    }
}

/* Is some ball of the vector or matrix wider than `tolerance`? */
static bool wider(acb_srcptr x, size_t count, const mag_t tolerance)
{
    bool is = false;
    for (size_t k = 0; k < count && !is; k++)
        is = mag_cmp(arb_radref(acb_realref(x + k)), tolerance) > 0 ||
             mag_cmp(arb_radref(acb_imagref(x + k)), tolerance) > 0;
    return is;
}

/* 2^e times a bound of the largest absolute value, and of `least`. */
static void part_of_largest(mag_t tolerance, acb_srcptr x, size_t count, ulong least, slong e)
{
    mag_t size;
    mag_init(size);
    mag_set_ui(tolerance, least);
    for (size_t k = 0; k < count; k++) {
        acb_get_mag(size, x + k);
        mag_max(tolerance, tolerance, size);
    }
    mag_mul_2exp_si(tolerance, tolerance, e);
    mag_clear(size);
}

/* The row behind the others minus what it has of them. */
static void span_reduce(span *s)
{
    acb_t factor;
    acb_init(factor);
    acb_ptr row = acb_mat_entry(s->row, (slong)s->rank, 0);
    for (size_t r = 0; r < s->rank; r++) {
        acb_srcptr other = acb_mat_entry(s->row, (slong)r, 0);
        acb_div(factor, row + s->pivot[r], other + s->pivot[r], s->sum->bits);
        for (size_t k = 0; k < s->size; k++)
            if (k != s->pivot[r]) acb_submul(row + k, factor, other + k, s->sum->bits);
        acb_zero(row + s->pivot[r]); /* exactly, by choice of the factor */
    }
    acb_clear(factor);
}

/* Does A x lie outside of the span of the others, certainly?  Then its row joins them. */
static bool span_raised(span *s, const acb_mat_struct *element)
{
    mag_t tolerance;
    mag_init(tolerance);
    span_apply(s, element);
    acb_srcptr row = acb_mat_entry(s->row, (slong)s->rank, 0);
    part_of_largest(tolerance, row, s->size, 1, -s->sum->bits / small_part);
    span_reduce(s);
    size_t best = s->size;
    for (size_t k = 0; k < s->size; k++)
        if (!acb_contains_zero(row + k) && acb_is_finite(row + k) && (best == s->size || larger(row + k, row + best)))
            best = k;
    bool raised = best < s->size;
    if (raised) s->pivot[s->rank++] = best;
    else if (wider(row, s->size, tolerance)) s->inaccurate = true; /* is it 0, or not known well enough? */
    mag_clear(tolerance);
    return raised;
}

/* Keeps a copy of an element that raises the rank. */
static void span_offer(span *s, const acb_mat_struct *element)
{
    if (s->rank == s->size || !span_raised(s, element)) return;
    nh_monodromy_element copy = nh_monodromy_element_new(s->sum);
    for (size_t b = 0; b < s->sum->blocks; b++) acb_mat_set(copy + b, element + b);
    s->keep[s->kept++] = copy;
}

/* Conjugates by the loops, and brackets with the elements kept. */
static void span_relatives(span *s, const acb_mat_struct *element)
{
    const nh_monodromy_sum *sum = s->sum;
    nh_monodromy_element other = nh_monodromy_element_new(sum), minus = nh_monodromy_element_new(sum);
    for (size_t i = 0; i < sum->points && s->rank < s->size; i++) {
        for (size_t b = 0; b < sum->blocks; b++) {
            if (!s->used[b]) continue;
            acb_mat_mul(other + b, s->loop[i] + b, element + b, sum->bits);
            acb_mat_mul(other + b, other + b, s->inverse[i] + b, sum->bits);
        }
        span_offer(s, other);
    }
    for (size_t k = 0; k < s->kept && s->rank < s->size; k++) {
        for (size_t b = 0; b < sum->blocks; b++) {
            if (!s->used[b]) continue;
            acb_mat_mul(other + b, s->keep[k] + b, element + b, sum->bits);
            acb_mat_mul(minus + b, element + b, s->keep[k] + b, sum->bits);
            acb_mat_sub(other + b, other + b, minus + b, sum->bits);
        }
        span_offer(s, other);
    }
    nh_monodromy_element_free(sum, other);
    nh_monodromy_element_free(sum, minus);
}

/* An element and what follows from it. */
static void span_take(span *s, const acb_mat_struct *element)
{
    span_offer(s, element);
    span_relatives(s, element);
    for (; s->examined < s->kept && s->rank < s->size; s->examined++) span_relatives(s, s->keep[s->examined]);
}

/* ---- words in the loops ---- */

/* Two letters: number of `shown` among all pairs, in the order of the first. */
static size_t spell_pair(size_t points, size_t number, size_t shown, size_t *letter)
{
    size_t left = number * (points * (points - 1) / 2) / shown, first = 0;
    for (; left >= points - 1 - first; first++) left -= points - 1 - first;
    letter[0] = first;
    letter[1] = first + 1 + left;
    return 2;
}

/* A power and another letter: what has only eigenvalues of absolute value 1, moves far when it is repeated. */
static size_t spell_power(size_t points, size_t number, size_t *letter)
{
    static const size_t power[] = {5, 2, 8, 3};
    size_t pairs = points * (points - 1), first = number % pairs / (points - 1), second = number % pairs % (points - 1);
    size_t times = power[(number + number / pairs) % (sizeof power / sizeof *power)];
    for (size_t k = 0; k < times; k++) letter[k] = first;
    letter[times] = second + (second >= first);
    return times + 1;
}

/* The letters of a word; 0: there are no more. */
static size_t spell(size_t points, size_t number, size_t *letter)
{
    if (number < points) {
        letter[0] = number;
        return 1;
    }
    if (points < 2) return 0;
    number -= points;
    size_t pairs = points * (points - 1) / 2, shown = pairs < most_pairs ? pairs : most_pairs;
    if (number < shown) return spell_pair(points, number, shown, letter);
    number -= shown;
    if (number < most_powers) return spell_power(points, number, letter);
    number -= most_powers;
    if (number >= most_longer) return 0;
    size_t length = shortest + number % longer_lengths;
    uint64_t seed = number + 1;
    for (size_t k = 0; k < length; k++) {
        seed = seed * 6364136223846793005u + 1442695040888963407u; /* a fixed choice among many */
        letter[k] = (size_t)((seed >> 33) % points);
    }
    return length;
}

/* The logarithm's relative V diag(log |mu|) V^-1 of one block; `moduli`: some |mu| is not 1, certainly.  False: the
 * eigenvalues were not separated. */
static bool log_of_moduli(acb_mat_t A, const acb_mat_t g, slong bits, bool *moduli)
{
    slong n = acb_mat_nrows(g);
    acb_ptr near = _acb_vec_init(n), mu = _acb_vec_init(n);
    acb_mat_t V, W;
    arb_t size;
    acb_mat_init(V, n, n);
    acb_mat_init(W, n, n);
    arb_init(size);
    bool good = true;
    if (n == 1) {
        acb_set(mu, acb_mat_entry(g, 0, 0));
        acb_mat_one(V);
    } else {
        acb_mat_approx_eig_qr(near, NULL, W, g, NULL, 0, bits);
        good = acb_mat_eig_simple(mu, NULL, V, g, near, W, bits);
    }
    good = good && acb_mat_inv(W, V, bits);
    for (slong j = 0; j < n && good; j++) {
        acb_abs(size, mu + j, bits);
        arb_log(size, size, bits);
        *moduli = *moduli || (arb_is_finite(size) && !arb_contains_zero(size));
        for (slong i = 0; i < n; i++) acb_mul_arb(acb_mat_entry(V, i, j), acb_mat_entry(V, i, j), size, bits);
    }
    if (good) acb_mat_mul(A, V, W, bits);
    good = good && acb_mat_is_finite(A);
    _acb_vec_clear(near, n);
    _acb_vec_clear(mu, n);
    acb_mat_clear(V);
    acb_mat_clear(W);
    arb_clear(size);
    return good;
}

/* Is the matrix known to less than half of the bits? */
static bool coarse(const acb_mat_t g, slong bits)
{
    size_t entries = (size_t)(acb_mat_nrows(g) * acb_mat_ncols(g));
    mag_t tolerance;
    mag_init(tolerance);
    part_of_largest(tolerance, g->entries, entries, 0, -bits / 2);
    bool is = wider(g->entries, entries, tolerance);
    mag_clear(tolerance);
    return is;
}

/* What one word gives: an element for those blocks in which it has simple eigenvalues. */
typedef struct {
    nh_monodromy_element log;
    bool *good; /* blocks */
    bool moduli;
} found;

static void found_of_word(found *f, const span *all, size_t letters, const size_t *letter, nh_monodromy_proof *proof)
{
    const nh_monodromy_sum *sum = all->sum;
    acb_mat_t word;
    for (size_t b = 0; b < sum->blocks; b++) {
        slong n = (slong)sum->block[b].size;
        acb_mat_init(word, n, n);
        acb_mat_set(word, all->loop[letter[0]] + b);
        for (size_t k = 1; k < letters; k++) acb_mat_mul(word, all->loop[letter[k]] + b, word, sum->bits);
        f->good[b] = log_of_moduli(f->log + b, word, sum->bits, &f->moduli);
        proof->simple = proof->simple || f->good[b];
        proof->inaccurate = proof->inaccurate || coarse(word, sum->bits);
        acb_mat_clear(word);
    }
    proof->moduli = proof->moduli || f->moduli;
}

static bool all_used(const found *f, const bool *used, size_t blocks)
{
    bool all = f->moduli;
    for (size_t b = 0; b < blocks; b++) all = all && (f->good[b] || !used[b]);
    return all;
}

static void proof_take(nh_monodromy_proof *proof, const span *s)
{
    proof->inaccurate = proof->inaccurate || s->inaccurate;
    if (s->rank <= proof->rank) return;
    proof->rank = s->rank;
    proof->words = s->kept;
}

/* Not all blocks of some words have simple eigenvalues: those that have are a quotient of the sum, whose orbits are
 * images of the orbits of the sum. */
static void prove_parts(const span *all, size_t words, const found *found_of, nh_monodromy_proof *proof)
{
    size_t blocks = all->sum->blocks;
    for (size_t w = 0; w < words; w++) {
        bool whole = true, seen = !found_of[w].moduli;
        for (size_t b = 0; b < blocks; b++) whole = whole && found_of[w].good[b];
        for (size_t v = 0; v < w && !seen; v++)
            seen = found_of[v].moduli && !memcmp(found_of[v].good, found_of[w].good, blocks * sizeof *found_of->good);
        if (whole || seen) continue;
        span s;
        span_init(&s, all->sum, found_of[w].good);
        s.loop = all->loop;
        s.inverse = all->inverse;
        for (size_t v = 0; v < words && s.rank < s.size; v++)
            if (all_used(found_of + v, s.used, blocks)) span_take(&s, found_of[v].log);
        proof_take(proof, &s);
        span_clear(&s);
    }
}

static void prove_with(span *all, nh_monodromy_proof *proof)
{
    const nh_monodromy_sum *sum = all->sum;
    size_t words = 0, most = sum->points + most_pairs + most_powers + most_longer, letter[most_letters], letters;
    found *found_of = nh_alloc_array(most + 1, sizeof *found_of);
    for (; all->rank < all->size && (letters = spell(sum->points, words, letter)) && !nh_interrupted(); words++) {
        found *f = found_of + words;
        f->log = nh_monodromy_element_new(sum);
        f->good = nh_alloc_array(sum->blocks + 1, sizeof *f->good);
        found_of_word(f, all, letters, letter, proof);
        if (all_used(f, all->used, sum->blocks)) span_take(all, f->log);
    }
    proof_take(proof, all);
    if (all->rank < all->size) prove_parts(all, words, found_of, proof);
    for (size_t w = 0; w < words; w++) {
        nh_monodromy_element_free(sum, found_of[w].log);
        nh_free(found_of[w].good);
    }
    nh_free(found_of);
}

void nh_monodromy_prove(const nh_monodromy_sum *sum, const nh_monodromy_element *loop, nh_monodromy_proof *proof)
{
    *proof = (nh_monodromy_proof){0};
    bool *used = nh_alloc_array(sum->blocks + 1, sizeof *used), good = true;
    nh_monodromy_element *inverse = nh_alloc_array(sum->points + 1, sizeof *inverse);
    for (size_t b = 0; b < sum->blocks; b++) used[b] = true;
    for (size_t i = 0; i < sum->points; i++) {
        inverse[i] = nh_monodromy_element_new(sum);
        for (size_t b = 0; b < sum->blocks; b++) good = good && acb_mat_inv(inverse[i] + b, loop[i] + b, sum->bits);
    }
    span all;
    span_init(&all, sum, used);
    all.loop = loop;
    all.inverse = inverse;
    if (good) prove_with(&all, proof);
    else proof->inaccurate = true;
    span_clear(&all);
    for (size_t i = 0; i < sum->points; i++) nh_monodromy_element_free(sum, inverse[i]);
    nh_free(inverse);
    nh_free(used);
}
