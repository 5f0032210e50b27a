/* kovacic: the Galois group of y'' = r y over C(x).  [docs/method.md, "No other integral"]
 *
 *     nh_kovacic_decide    degrees in characteristic 0 (kovacic_points); the prime (kovacic_prime); invariant lines
 *                          (kovacic_riccati); invariant forms of degree 4, 6, 8, 12 (kovacic_invariant)
 *     none of them         SL(2).  A polynomial over the algebraic numbers that solves these linear equations would be
 *                          one modulo the prime, divided by its coefficient of least valuation
 *     one line, no form    not diagonalizable; its character is infinite where an exponent is not rational
 *
 * With an irregular point no finite group is possible, so degree 4 is enough. */
#include "absence/kovacic_internal.h"

enum { least_prime = 12, first_prime = 1073741824 };

static const unsigned degree_of_form[NH_KOVACIC_INVARIANTS] = {4, 6, 8, 12};

/* r in lowest terms. */
static void reduce(fmpz_poly_t num, fmpz_poly_t den)
{
    fmpz_poly_t common;
    fmpz_poly_init(common);
    fmpz_poly_gcd(common, num, den); /* the common content is in it */
    fmpz_poly_div(num, num, common);
    fmpz_poly_div(den, den, common);
    if (fmpz_sgn(fmpz_poly_lead(den)) < 0) {
        fmpz_poly_neg(num, num);
        fmpz_poly_neg(den, den);
    }
    fmpz_poly_clear(common);
}

static const char *polynomial_text(nh_arena *arena, const fmpz_poly_t f)
{
    char *text = fmpz_poly_get_str_pretty(f, "x");
    const char *copy = nh_arena_strdup(arena, text);
    flint_free(text);
    return copy;
}

static const char **coefficients(nh_arena *arena, const fmpz_poly_t f, size_t *length)
{
    *length = (size_t)fmpz_poly_length(f);
    const char **out = nh_arena_alloc(arena, (*length + 1) * sizeof *out);
    for (size_t i = 0; i < *length; i++) {
        char *text = fmpz_get_str(NULL, 10, fmpz_poly_get_coeff_ptr(f, (slong)i));
        out[i] = nh_arena_strdup(arena, text);
        flint_free(text);
    }
    return out;
}

static void tell_points(const nh_kovacic_problem *problem, nh_kovacic *out)
{
    size_t points = problem->poles + 1;
    out->poles = problem->poles;
    out->double_pole = nh_arena_alloc(problem->arena, points * sizeof *out->double_pole);
    out->order = nh_arena_alloc(problem->arena, points * sizeof *out->order);
    out->regular = true;
    for (size_t i = 0; i < points; i++) {
        const nh_kovacic_place *place = problem->place + problem->at[i];
        out->order[i] = place->order;
        out->double_pole[i] = i < problem->poles && place->order == 2;
        if (place->irregular) out->regular = false;
    }
}

/* Bounds of all invariants that are needed. */
static void bounds(const nh_kovacic_problem *problem, nh_kovacic *out)
{
    for (size_t k = 0; k < (out->regular ? NH_KOVACIC_INVARIANTS : 1); k++) {
        nh_kovacic_bounds(problem, out->invariant + k);
        out->invariant[k].solutions = out->invariant[k].possible ? -1 : 0;
    }
}

/* Some 1 + 4 b is not the square of a rational number. */
static bool irrational(const nh_kovacic_problem *problem)
{
    for (size_t i = 0; i <= problem->places; i++)
        if (problem->place[i].order == 2 && !problem->place[i].rational) return true;
    return false;
}

static nh_kovacic_group with_prime(const nh_kovacic_problem *problem, nh_kovacic *out)
{
    if (!nh_kovacic_riccati(problem, out)) return NH_GROUP_UNDECIDED;
    bool infinite = out->riccati == 1 && out->regular && irrational(problem);
    if (out->riccati && !infinite) {
        out->obstacle = nh_arena_printf(problem->arena, "Riccati's equation has a solution modulo %lu", problem->prime);
        return NH_GROUP_OPEN;
    }
    bool large = false;
    for (size_t k = 0; k < NH_KOVACIC_INVARIANTS; k++) {
        nh_kovacic_invariant *invariant = out->invariant + k;
        if (!invariant->possible) continue;
        if (invariant->degree > nh_kovacic_most_degree) {
            large = true;
            continue;
        }
        nh_kovacic_invariant_find(problem, invariant);
        if (!invariant->solutions) continue;
        out->obstacle = nh_arena_printf(problem->arena, "a form of degree %u stays constant modulo %lu", invariant->m,
                                        problem->prime);
        return NH_GROUP_OPEN;
    }
    if (large) {
        out->obstacle = nh_kovacic_large(problem->arena);
        return NH_GROUP_UNDECIDED;
    }
    return infinite ? NH_GROUP_TRIANGULAR : NH_GROUP_SL2;
}

static nh_kovacic_group group_of(nh_kovacic_problem *problem, nh_kovacic *out, ulong after)
{
    if (!nh_kovacic_degrees(problem, out)) return NH_GROUP_UNDECIDED;
    bounds(problem, out);
    if (!nh_kovacic_prime_find(problem, after)) {
        out->obstacle = "no prime was found modulo which the poles and exponents are residues";
        return NH_GROUP_UNDECIDED;
    }
    out->prime = problem->prime;
    out->pole = problem->pole;
    out->root = problem->root;
    return with_prime(problem, out);
}

nh_kovacic *nh_kovacic_decide_after(nh_arena *arena, const fmpz_poly_t r_num, const fmpz_poly_t r_den, ulong after)
{
    nh_kovacic *out = nh_arena_alloc(arena, sizeof *out);
    fmpz_poly_t num, den;
    fmpz_poly_init(num);
    fmpz_poly_init(den);
    fmpz_poly_set(num, r_num);
    fmpz_poly_set(den, r_den);
    reduce(num, den);
    out->r_num = polynomial_text(arena, num);
    out->r_den = polynomial_text(arena, den);
    out->num = coefficients(arena, num, &out->num_length);
    out->den = coefficients(arena, den, &out->den_length);
    for (size_t k = 0; k < NH_KOVACIC_INVARIANTS; k++) out->invariant[k].m = degree_of_form[k];
    if (fmpz_poly_is_zero(num)) {
        out->regular = true;
        out->group = NH_GROUP_OPEN;
        out->obstacle = "r = 0: all solutions are polynomials";
    } else if (fmpz_poly_degree(den) > nh_kovacic_most_poles || fmpz_poly_degree(num) > nh_kovacic_most_degree) {
        out->group = NH_GROUP_UNDECIDED;
        out->obstacle = nh_arena_printf(arena, "r has a degree over %d", nh_kovacic_most_poles);
    } else {
        nh_kovacic_problem problem;
        nh_kovacic_problem_begin(&problem, arena, num, den);
        tell_points(&problem, out);
        out->group = group_of(&problem, out, after > least_prime ? after : least_prime);
        nh_kovacic_problem_end(&problem);
    }
    fmpz_poly_clear(den);
    fmpz_poly_clear(num);
    return out;
}

nh_kovacic *nh_kovacic_decide(nh_arena *arena, const fmpz_poly_t r_num, const fmpz_poly_t r_den)
{
    return nh_kovacic_decide_after(arena, r_num, r_den, first_prime);
}

const char *nh_kovacic_word(nh_kovacic_group group)
{
    static const char *const word[] = {
        [NH_GROUP_SL2] = "SL(2)",
        [NH_GROUP_TRIANGULAR] = "triangular, of dimension 2, or SL(2)",
        [NH_GROUP_OPEN] = "open",
        [NH_GROUP_UNDECIDED] = "undecided",
    };
    return word[group];
}

static void put_numbers(nh_json *object, const char *key, size_t count, const ulong *number)
{
    nh_json *array = nh_json_put_array(object, key);
    for (size_t i = 0; i < count && number; i++) nh_json_add_number(array, (double)number[i]);
}

static void put_texts(nh_json *object, const char *key, size_t count, const char *const *text)
{
    nh_json *array = nh_json_put_array(object, key);
    for (size_t i = 0; i < count; i++) nh_json_add_text(array, text[i]);
}

void nh_kovacic_certificate(nh_json *object, const nh_kovacic *kovacic)
{
    put_texts(object, "r_num", kovacic->num_length, kovacic->num);
    put_texts(object, "r_den", kovacic->den_length, kovacic->den);
    nh_json_put_number(object, "prime", (double)kovacic->prime);
    put_numbers(object, "poles", kovacic->poles, kovacic->pole);
    put_numbers(object, "roots", kovacic->poles, kovacic->root);
    nh_json_put_number(object, "root_infinity", kovacic->root ? (double)kovacic->root[kovacic->poles] : 0);
    nh_json *degrees = nh_json_put_array(object, "degrees");
    for (size_t i = 0; i < kovacic->degrees; i++) nh_json_add_number(degrees, (double)kovacic->degree_of_p[i]);
    nh_json *invariants = nh_json_put_array(object, "invariants");
    for (size_t k = 0; k < NH_KOVACIC_INVARIANTS; k++) {
        const nh_kovacic_invariant *invariant = kovacic->invariant + k;
        if (!invariant->possible) continue;
        nh_json *entry = nh_json_add_object(invariants);
        nh_json_put_number(entry, "m", invariant->m);
        nh_json *lowest = nh_json_put_array(entry, "lowest");
        for (size_t i = 0; i < kovacic->poles; i++) nh_json_add_number(lowest, (double)invariant->lowest[i]);
        nh_json_put_number(entry, "degree", (double)invariant->degree);
    }
}
