/* closed_words: words over a system's letters, cheapest first, and their series.
 *
 *     letter i     powers 1, x, x^2, 1/x, ..  with prices, by rising price
 *     word k       choice[k * letters + i]: which power of letter i;  price: the sum
 *     next_choice  counts like a counter with carry through all choices up to the price
 *     reduce       words that are combinations of cheaper ones, by values at random points */
#include "count/closed_words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "exact/residue_matrix.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"

static const double tiny = 1e-9;

/* ---- powers of a letter ---- */

static uint32_t coordinates_in(const nh_jet_equations *x, nh_ex e)
{
    uint32_t mask = 0;
    for (size_t k = 0; k < x->coordinates && k < 32; k++)
        if (nh_depends(x->dag, e, x->coordinate[k])) mask |= (uint32_t)1 << k;
    return mask;
}

/* Is it a product of numbers and whole positive powers of coordinates, sines and cosines? */
static bool is_plain(const nh_jet_equations *x, nh_ex e)
{
    const nh_dag *d = x->dag;
    nh_kind kind = nh_kind_of(d, e);
    if (kind != NH_PRODUCT) {
        nh_function f = kind == NH_FUNCTION ? nh_function_of(d, e) : NH_PI;
        return kind == NH_NUMBER || kind == NH_SYMBOL || f == NH_SIN || f == NH_COS;
    }
    for (size_t k = 0; k < nh_arity(d, e); k++) {
        nh_ex exponent = nh_exponent_of(d, e, k);
        if (nh_kind_of(d, nh_child(d, e, k)) == NH_NUMBER) continue;
        bool whole = nh_kind_of(d, exponent) == NH_NUMBER && nh_number_of(d, exponent).q == 1;
        if (!whole || nh_num_value(nh_number_of(d, exponent)) < 0 || !is_plain(x, nh_child(d, e, k))) return false;
    }
    return true;
}

/* A power that cannot be evaluated is left out. */
static void put_power(nh_closed_words *w, nh_closed_letter *l, nh_ex e, double price)
{
    nh_jet_equations *x = w->equations;
    if (price > w->most + tiny) return;
    nh_closed_power p = {
        .shown = e, .value = e, .price = price, .coordinates = coordinates_in(x, e), .plain = is_plain(x, e)};
    size_t kernels = x->point->kernels;
    if (!nh_jet_equations_take(x, true, &p.value)) {
        x->obstacle = x->point->obstacle = NULL;
        x->point->kernels = kernels;
        return;
    }
    nh_grow(&l->power, &l->capacity, l->powers + 1, sizeof *l->power);
    size_t at = l->powers++;
    for (; at > 0 && l->power[at - 1].price > price; at--) l->power[at] = l->power[at - 1];
    l->power[at] = p;
}

/* The exponents k/root of a letter.  A negative exponent is priced relative to the lowest that the system has.  Whole
 * powers of a linear base are sums of other words. */
static void put_powers(nh_closed_words *w, nh_closed_letter *l, const nh_letter *a)
{
    nh_dag *d = w->equations->dag;
    double root = (double)a->root, down = a->down, up = a->up;
    for (int64_t k = 1; (double)k / root <= w->most * up; k++)
        if (!a->linear || k % a->root)
            put_power(w, l, nh_pow(d, a->base, nh_ratio(d, k, a->root)), (double)k / root / up);
    for (int64_t k = 1; a->down > 0 && (double)k / root <= w->most * down; k++)
        put_power(w, l, nh_pow(d, a->base, nh_ratio(d, -k, a->root)), (double)k / root / down);
}

static void put_exponentials(nh_closed_words *w, nh_closed_letter *l, const nh_letter *a)
{
    nh_dag *d = w->equations->dag;
    for (int64_t k = 1; a->known ? k <= a->known : (double)k <= w->most; k++) {
        double price = a->known ? 0 : (double)k;
        if (a->unit) { /* integrals consist of cosh(r t) and r sinh(r t) with coefficients without r */
            nh_ex argument = nh_mul(d, nh_int(d, k), a->base);
            put_power(w, l, nh_call(d, NH_COSH, argument), price);
            put_power(w, l, nh_mul(d, a->unit, nh_call(d, NH_SINH, argument)), price);
            continue;
        }
        put_power(w, l, nh_call(d, NH_EXP, nh_mul(d, nh_int(d, k), a->base)), price);
        if (a->down > 0) put_power(w, l, nh_call(d, NH_EXP, nh_mul(d, nh_int(d, -k), a->base)), price);
    }
}

/* cos^i sin^j without those that sin^2 + cos^2 = 1 makes of others: of the products of negative powers, 1/(cos sin)
 * alone. */
static void put_circle(nh_closed_words *w, nh_closed_letter *l, const nh_letter *a)
{
    nh_dag *d = w->equations->dag;
    nh_ex c = nh_call(d, NH_COS, a->base), s = nh_call(d, NH_SIN, a->base);
    if (a->unit) s = nh_mul(d, a->unit, s); /* its coefficients are without the root */
    double cost_c = 1 / fmax(a->down, 1), cost_s = 1 / fmax(a->down_sine, 1);
    if (a->known) {
        for (int i = 0; i <= (int)a->known; i++)
            for (int j = i == 0; j <= 1 && i + j <= (int)a->known; j++)
                put_power(w, l, nh_mul(d, nh_powi(d, c, i), nh_powi(d, s, j)), 0);
        return;
    }
    int most_c = (int)(w->most / cost_c), most_s = (int)(w->most / cost_s);
    for (int i = a->down > 0 ? -most_c : 0; i <= (int)w->most; i++)
        for (int j = a->down_sine > 0 ? -most_s : 0; j <= 1; j++) {
            if ((i == 0 && j == 0) || (j < 0 && i > 1) || (j < 0 && i < 0 && (i < -1 || j < -1))) continue;
            put_power(w, l, nh_mul(d, nh_powi(d, c, i), nh_powi(d, s, j)),
                      (i < 0 ? -i * cost_c : i) + (j < 0 ? -j * cost_s : j));
        }
}

/* The powers of one letter; a letter with no power but 1 is left out. */
static void put_letter(nh_closed_words *w, const nh_letter *a)
{
    nh_grow(&w->letter, &w->capacity, w->letters + 1, sizeof *w->letter);
    nh_closed_letter *l = &w->letter[w->letters];
    *l = (nh_closed_letter){0};
    put_power(w, l, nh_int(w->equations->dag, 1), 0);
    if (a->kind == NH_LETTER_CIRCLE) put_circle(w, l, a);
    else if (a->kind == NH_LETTER_EXPONENTIAL) put_exponentials(w, l, a);
    else put_powers(w, l, a);
    if (l->powers > 1) w->letters++;
    else nh_free(l->power);
}

/* ---- words ---- */

/* The choice after `at`, with price `sum` and `factors` factors that are not plain.  False: it was the last. */
static bool next_choice(const nh_closed_words *w, size_t most_factors, size_t *at, double *sum, size_t *factors)
{
    for (size_t i = 0; i < w->letters; i++) {
        const nh_closed_power *power = w->letter[i].power;
        size_t others = *factors - !power[at[i]].plain, next = at[i] + 1;
        double rest = *sum - power[at[i]].price;
        while (next < w->letter[i].powers && others + !power[next].plain > most_factors) next++;
        bool fits = next < w->letter[i].powers && rest + power[next].price <= w->most + tiny;
        at[i] = fits ? next : 0;
        *sum = rest + power[at[i]].price;
        *factors = others + !power[at[i]].plain;
        if (fits) return true;
    }
    return false;
}

static bool is_wanted(const nh_closed_words *w, const nh_closed_weights *wanted, const size_t *at)
{
    nh_residue sum = 0;
    for (size_t i = 0; i < w->letters; i++) sum = nh_residue_add(wanted->field, sum, w->letter[i].power[at[i]].weight);
    for (size_t i = 0; i < wanted->count; i++)
        if (wanted->weight[i] == sum) return true;
    return false;
}

/* Counts the wanted choices whose price is at most `largest` and that have at most so many factors that are not plain,
 * and writes them where there is room.  More than `most`: where so many choices have to be looked at, too. */
static size_t choices(const nh_closed_words *w, size_t most_factors, size_t most, const nh_closed_weights *wanted,
                      uint16_t *choice, double *price)
{
    enum { most_looks = 1000000 };
    size_t count = 0, looks = 0, factors = 0, *at = nh_alloc_array(w->letters + 1, sizeof *at);
    double sum = 0;
    do {
        if (++looks > most_looks) count = most + 1;
        else if (!wanted || is_wanted(w, wanted, at)) {
            for (size_t i = 0; choice && i < w->letters; i++) choice[count * w->letters + i] = (uint16_t)at[i];
            if (choice) price[count] = sum;
            count++;
        }
    } while (count <= most && next_choice(w, most_factors, at, &sum, &factors));
    nh_free(at);
    return count;
}

/* The largest number of factors that are not plain with which there are at most `most` words; 0: even one gives
 * more. */
static size_t factors_that_fit(const nh_closed_words *w, size_t most, const nh_closed_weights *wanted)
{
    size_t factors = w->letters;
    while (factors > 0 && choices(w, factors, most, wanted, NULL, NULL) > most) factors--;
    return factors;
}

typedef struct {
    double price;
    size_t factors, index;
} rank;

static int by_price(const void *a, const void *b)
{
    const rank *x = a, *y = b;
    if (fabs(x->price - y->price) > tiny) return x->price < y->price ? -1 : 1;
    if (x->factors != y->factors) return x->factors < y->factors ? -1 : 1;
    return (x->index > y->index) - (x->index < y->index);
}

/* Words by price, then by the number of their factors. */
static void sort(nh_closed_words *w)
{
    size_t n = w->letters;
    rank *order = nh_alloc_array(w->words + 1, sizeof *order);
    uint16_t *choice = nh_alloc_array(w->words * n + 1, sizeof *choice);
    double *price = nh_alloc_array(w->words + 1, sizeof *price);
    for (size_t k = 0; k < w->words; k++) {
        order[k] = (rank){.price = w->price[k], .index = k};
        for (size_t i = 0; i < n; i++) order[k].factors += w->choice[k * n + i] > 0;
    }
    qsort(order, w->words, sizeof *order, by_price);
    for (size_t k = 0; k < w->words; k++) {
        memcpy(choice + k * n, w->choice + order[k].index * n, n * sizeof *choice);
        price[k] = w->price[order[k].index];
    }
    nh_free(order);
    nh_free(w->choice);
    nh_free(w->price);
    w->choice = choice;
    w->price = price;
}

/* The only coordinate on which e depends; 0: there is none, or another. */
static nh_ex only_coordinate(const nh_jet_equations *x, nh_ex e)
{
    nh_ex only = 0;
    for (size_t k = 0; k < x->coordinates; k++) {
        if (!nh_depends(x->dag, e, x->coordinate[k])) continue;
        if (only) return 0;
        only = x->coordinate[k];
    }
    return only;
}

/* Powers of q, exp(b q), and cos^i(c q) sin^j(c q) with i >= 0 and j = 0 or 1 are sums of q^a exp(lambda q), no pair
 * (a, lambda) twice: their products, also of several coordinates, are linearly independent. */
static bool are_independent(const nh_jet_equations *x, const nh_closed_letters *l)
{
    for (size_t i = 0; i < l->count; i++) {
        const nh_letter *a = &l->item[i];
        nh_ex q = only_coordinate(x, a->base);
        if (!q || (a->kind == NH_LETTER_POWER && a->base != q)) return false;
        if (a->kind == NH_LETTER_CIRCLE && (a->down > 0 || a->down_sine > 0)) return false;
        if (a->kind != NH_LETTER_POWER && nh_depends(x->dag, nh_diff(x->dag, a->base, q), q)) return false;
        for (size_t k = 0; k < i; k++)
            if (l->item[k].kind == a->kind && nh_depends(x->dag, l->item[k].base, q)) return false;
    }
    return true;
}

nh_closed_words *nh_closed_words_create(nh_jet_equations *x, double price, bool secular,
                                        const nh_construct_rates *rates)
{
    nh_closed_words *w = nh_alloc(sizeof *w);
    *w = (nh_closed_words){.equations = x, .most = price};
    nh_closed_letters letters = nh_closed_letters_of(x, secular, rates);
    w->independent = are_independent(x, &letters);
    for (size_t i = 0; i < letters.count; i++) put_letter(w, &letters.item[i]);
    nh_free(letters.item);
    return w;
}

bool nh_closed_words_weigh(nh_closed_words *w, const nh_residue *scaling, nh_prime field)
{
    size_t powers = 0, at = 0;
    bool all = true;
    for (size_t i = 0; i < w->letters; i++) powers += w->letter[i].powers;
    nh_ex *value = nh_alloc_array(powers + 1, sizeof *value);
    nh_residue *weight = nh_alloc_array(powers + 1, sizeof *weight);
    bool *constant = nh_alloc_array(powers + 1, sizeof *constant);
    for (size_t i = 0; i < w->letters; i++)
        for (size_t k = 0; k < w->letter[i].powers; k++) value[at++] = w->letter[i].power[k].value;
    nh_scaling_weights(w->equations, scaling, field, powers, value, weight, constant);
    at = 0;
    for (size_t i = 0; i < w->letters; i++) {
        nh_closed_letter *l = &w->letter[i];
        size_t kept = 0;
        for (size_t k = 0; k < l->powers; k++, at++) {
            all &= constant[at];
            if (!constant[at]) continue;
            l->power[kept] = l->power[k];
            l->power[kept++].weight = weight[at];
        }
        l->powers = kept;
    }
    nh_free(constant);
    nh_free(weight);
    nh_free(value);
    return all;
}

bool nh_closed_words_list(nh_closed_words *w, size_t most_words, const nh_closed_weights *wanted)
{
    size_t factors = factors_that_fit(w, most_words, wanted);
    if (w->letters && !factors) return false;
    nh_free(w->choice);
    nh_free(w->price);
    w->words = choices(w, factors, most_words, wanted, NULL, NULL);
    w->choice = nh_alloc_array(w->words * w->letters + 1, sizeof *w->choice);
    w->price = nh_alloc_array(w->words + 1, sizeof *w->price);
    choices(w, factors, most_words, wanted, w->choice, w->price);
    sort(w);
    return w->words > 0;
}

void nh_closed_words_free(nh_closed_words *w)
{
    if (!w) return;
    for (size_t i = 0; i < w->letters; i++) nh_free(w->letter[i].power);
    nh_free(w->letter);
    nh_free(w->choice);
    nh_free(w->price);
    nh_free(w);
}

uint32_t nh_closed_words_coordinates(const nh_closed_words *w, size_t word)
{
    uint32_t mask = 0;
    for (size_t i = 0; i < w->letters; i++) mask |= w->letter[i].power[w->choice[word * w->letters + i]].coordinates;
    return mask;
}

nh_residue nh_closed_words_weight(const nh_closed_words *w, nh_prime field, size_t word)
{
    nh_residue sum = 0;
    for (size_t i = 0; i < w->letters; i++)
        sum = nh_residue_add(field, sum, w->letter[i].power[w->choice[word * w->letters + i]].weight);
    return sum;
}

nh_ex nh_closed_words_expression(const nh_closed_words *w, size_t word)
{
    nh_dag *d = w->equations->dag;
    nh_ex e = nh_int(d, 1);
    for (size_t i = 0; i < w->letters; i++)
        e = nh_mul(d, e, w->letter[i].power[w->choice[word * w->letters + i]].shown);
    return e;
}

/* ---- independent words ---- */

/* The values of all words at the point of the equations.  False: the point is not regular. */
static bool values_at(const nh_closed_words *w, const nh_jet_ring *point, nh_residue *value, nh_residue *out)
{
    nh_jet_equations *x = w->equations;
    nh_jet_eval *v = nh_jet_equations_eval(x, point, x->at);
    size_t first = 0;
    bool good = true;
    for (size_t i = 0; i < w->letters && good; i++)
        for (size_t k = 0; k < w->letter[i].powers && good; k++)
            good = nh_jet_eval_all(v, 1, &w->letter[i].power[k].value, &value[first++]);
    for (size_t k = 0; k < w->words && good; k++) {
        const uint16_t *choice = w->choice + k * w->letters;
        out[k] = 1;
        first = 0;
        for (size_t i = 0; i < w->letters; first += w->letter[i++].powers)
            if (choice[i]) out[k] = nh_residue_mul(point->field, out[k], value[first + choice[i]]);
    }
    nh_jet_eval_free(v);
    return good;
}

static void keep_words(nh_closed_words *w, size_t count, const size_t *chosen)
{
    for (size_t k = 0; k < count; k++) {
        memmove(w->choice + k * w->letters, w->choice + chosen[k] * w->letters, w->letters * sizeof *w->choice);
        w->price[k] = w->price[chosen[k]];
    }
    w->words = count;
}

/* The rank of the values of all words at so many points; `chosen`: the pivot columns. */
static size_t independent_at(const nh_closed_words *w, nh_prime field, size_t rows, size_t *chosen, bool *enough)
{
    enum { most_tries = 64 };
    nh_jet_equations *x = w->equations;
    size_t n = w->words, one = 1, found = 0, powers = 0, independent = 0;
    for (size_t i = 0; i < w->letters; i++) powers += w->letter[i].powers;
    nh_jet_ring *point = nh_jet_ring_create(field, 1, &one, 0);
    nh_residue *matrix = nh_alloc_array(rows * n + 1, sizeof *matrix);
    nh_residue *value = nh_alloc_array(powers + 1, sizeof *value);
    for (uint64_t seed = 1; found < rows && seed < most_tries * rows; seed++) {
        nh_jet_equations_choose(x, field, seed);
        found += values_at(w, point, value, matrix + found * n);
    }
    *enough = found == rows;
    if (*enough) independent = nh_residue_matrix_pivots(field, rows, n, matrix, chosen);
    nh_jet_ring_free(point);
    nh_free(value);
    nh_free(matrix);
    return independent;
}

/* Points are added until there are more than the rank: often only few of the words are independent. */
bool nh_closed_words_reduce(nh_closed_words *w, double most, double *work)
{
    /* rows_together: rows that dense algebra treats in the time of one product */
    enum { spare = 8, first = 64, rows_together = 4 };
    if (w->independent) return true;
    nh_prime field = nh_jet_point_prime(w->equations->point, 0);
    size_t n = w->words, kept = 0, *chosen = nh_alloc_array(n + 1, sizeof *chosen), rows = first;
    bool enough = true, allowed = true;
    for (bool more = true; more && enough && allowed; rows *= 2) {
        more = rows < n + spare;
        if (!more) rows = n + spare;
        double least = (double)(rows < n ? rows : n), planned = (double)rows * (double)n * least / rows_together;
        allowed = *work + planned < most;
        if (!allowed) break;
        kept = independent_at(w, field, rows, chosen, &enough);
        *work += (double)rows * (double)n * (double)kept / rows_together;
        more &= kept + spare > rows;
    }
    if (enough && allowed) keep_words(w, kept, chosen);
    nh_free(chosen);
    return allowed;
}

/* ---- values ---- */

/* Series of every power of every letter; series[i]: of letter i, one after another. */
static bool powers(const nh_closed_words *w, nh_jet_eval *v, const nh_jet_ring *ring, nh_residue **series)
{
    bool good = true;
    for (size_t i = 0; i < w->letters && good; i++) {
        const nh_closed_letter *l = &w->letter[i];
        series[i] = nh_alloc_array(l->powers * ring->size, sizeof **series);
        for (size_t k = 0; k < l->powers && good; k++)
            good = nh_jet_eval_all(v, 1, &l->power[k].value, series[i] + k * ring->size);
    }
    return good;
}

bool nh_closed_words_evaluate(const nh_closed_words *w, const nh_jet_ring *ring, const nh_residue *coordinate,
                              nh_residue *out, double *work)
{
    nh_residue **series = nh_alloc_array(w->letters + 1, sizeof *series),
               *both = nh_alloc_array(ring->size, sizeof *both);
    nh_jet_eval *v = nh_jet_equations_eval(w->equations, ring, coordinate);
    bool good = powers(w, v, ring, series);
    for (size_t k = 0; k < w->words && good; k++) {
        nh_residue *word = out + k * ring->size;
        bool first = true;
        nh_jet_constant(ring, 1, word);
        for (size_t i = 0; i < w->letters; i++) {
            const nh_residue *factor = series[i] + w->choice[k * w->letters + i] * ring->size;
            if (!w->choice[k * w->letters + i]) continue;
            if (!first) {
                nh_jet_mul(ring, word, factor, both);
                *work += (double)ring->pairs[ring->size];
            }
            memcpy(word, first ? factor : both, ring->size * sizeof *word);
            first = false;
        }
    }
    for (size_t i = 0; i < w->letters; i++) nh_free(series[i]);
    nh_jet_eval_free(v);
    nh_free(both);
    nh_free(series);
    return good;
}
