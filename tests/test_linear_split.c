/* Linear equations as sums of smaller ones: what was put together in another basis is taken apart. */
#include <criterion/criterion.h>
#include <flint/fmpq_mat.h>

#include "absence/linear_split.h"
#include "absence/monodromy.h"

/* entry (i, j) of A: num/den as texts of FLINT */
static void put(nh_linear_equation *e, size_t i, size_t j, const char *num, const char *den)
{
    fmpq_poly_t n, d;
    fmpq_poly_init(n);
    fmpq_poly_init(d);
    cr_assert_eq(fmpq_poly_set_str(n, num), 0, "%s", num);
    cr_assert_eq(fmpq_poly_set_str(d, den), 0, "%s", den);
    nh_linear_equation_set(e, i, j, n, d);
    fmpq_poly_clear(n);
    fmpq_poly_clear(d);
}

/* Motions near the z-axis of (a1 x^2 + a2 y^2 + z^2)/2 + (c1 x^2 + c2 y^2 + 2 c3 xy) z - z^3/3 at the level 1/11:
 * (x, y)'' = -K (x, y)/S - S'/(2 S) (x, y)'. */
static const char level[] = "4  2/11 0 -1 2/3";
static nh_linear_equation block4(const char *k11, const char *k12, const char *k22)
{
    nh_linear_equation e;
    nh_linear_equation_init(&e, 4);
    const char *k[4] = {k11, k12, k12, k22};
    for (size_t i = 0; i < 2; i++) {
        put(&e, i, 2 + i, "1  1", "1  1");
        put(&e, 2 + i, 2 + i, "3  0 1 -1", level);
        for (size_t j = 0; j < 2; j++) put(&e, 2 + i, j, k[2 * i + j], level);
    }
    nh_linear_equation_reduce(&e);
    return e;
}

/* A in another basis: B^-1 A B, B and its inverse of whole numbers: products of elementary matrices. */
static void turn(nh_linear_equation *e)
{
    size_t n = e->size;
    for (size_t step = 0; step < 3 * n; step++) {
        size_t a = step % n, b = (step * step + 2 * step + 1) % n;
        long w = (long)(step % 5) - 2;
        if (a == b) continue;
        for (size_t k = 0; k < n; k++) fmpz_poly_scalar_addmul_si(e->num + a * n + k, e->num + b * n + k, w);
        for (size_t k = 0; k < n; k++) fmpz_poly_scalar_addmul_si(e->num + k * n + b, e->num + k * n + a, -w);
    }
}

static void clear(size_t blocks, nh_linear_equation *block)
{
    for (size_t b = 0; b < blocks; b++) nh_linear_equation_clear(block + b);
    nh_free(block);
}

/* Splits and clears the equation; the sizes are the digits of `sizes`, sorted. */
static void splits(nh_linear_equation *e, const char *sizes, bool triangular)
{
    nh_linear_equation *block;
    bool is;
    size_t blocks = nh_linear_equation_split(e, &block, &is);
    char found[20] = "";
    for (size_t n = 1; n < 9; n++)
        for (size_t b = 0; b < blocks; b++)
            if (block[b].size == n) sprintf(found + strlen(found), "%zu", n);
    cr_expect_str_eq(found, sizes);
    cr_expect_eq(is, triangular);
    clear(blocks, block);
    nh_linear_equation_clear(e);
}

Test(linear_split, not_at_all)
{
    nh_linear_equation e = block4("2  -1 -2", "2  0 -3", "2  -2 -4");
    splits(&e, "4", false);
    e = block4("2  -1 -2", "2  0 -3", "2  -2 -4");
    turn(&e);
    splits(&e, "4", false);
    nh_linear_equation_init(&e, 2); /* a turn about x: the eigenvectors are not rational */
    put(&e, 0, 1, "2  0 1", "2  1 1");
    put(&e, 1, 0, "2  0 -1", "2  1 1");
    splits(&e, "2", false);
}

/* The repeated block, as it is and turned: two blocks whose traces agree, and 3 of 4 dimensions. */
Test(linear_split, equal_blocks)
{
    for (int turned = 0; turned < 2; turned++) {
        nh_linear_equation e = block4("2  -1 -2", "0", "2  -1 -2"), *block;
        if (turned) turn(&e);
        bool triangular;
        cr_assert_eq(nh_linear_equation_split(&e, &block, &triangular), 2);
        cr_expect_not(triangular);
        cr_expect_eq(block[0].size, 2);
        cr_expect_eq(block[1].size, 2);
        nh_arena *arena = nh_arena_create();
        nh_monodromy *m = nh_monodromy_of(arena, 2, block, 256);
        cr_expect_eq(m->rank, 3, "%zu, %s", m->rank, m->obstacle);
        nh_arena_free(arena);
        clear(2, block);
        nh_linear_equation_clear(&e);
    }
}

/* x y coupled by a constant symmetric matrix of rational eigenvectors: K = 2 x ((1, 2), (2, 1)) + ((3, 1), (1, 3)). */
Test(linear_split, normal_modes)
{
    nh_linear_equation e = block4("2  -3 -2", "2  -1 -4", "2  -3 -2");
    splits(&e, "22", false);
    e = block4("2  -3 -2", "2  -1 -4", "2  -3 -2");
    turn(&e);
    splits(&e, "22", false);
}

/* 2 + 1 + 2 in a turned basis, with and without something above the diagonal. */
Test(linear_split, turned_sum)
{
    for (int above = 0; above < 2; above++) {
        nh_linear_equation e;
        nh_linear_equation_init(&e, 5);
        put(&e, 0, 1, "1  1", "1  1");
        put(&e, 1, 0, "2  1 3", "2  -2 1");
        put(&e, 2, 2, "1  1/3", "2  0 1");
        put(&e, 3, 4, "1  1", "2  0 1");
        put(&e, 4, 3, "2  2 -5", "1  1");
        if (above) put(&e, 0, 4, "1  1", "2  3 1");
        nh_linear_equation_reduce(&e);
        turn(&e);
        splits(&e, "122", above);
    }
}

Test(linear_split, triangular)
{
    nh_linear_equation e;
    nh_linear_equation_init(&e, 3); /* only the last unknown moves the others */
    put(&e, 0, 0, "1  1", "2  0 1");
    put(&e, 0, 2, "1  1", "2  1 1");
    put(&e, 1, 1, "1  2", "2  0 1");
    put(&e, 2, 2, "1  1", "2  1 1");
    nh_linear_equation_reduce(&e);
    turn(&e);
    splits(&e, "111", true);
    nh_linear_equation_init(&e, 3);
    splits(&e, "111", false);
    nh_linear_equation_init(&e, 0);
    splits(&e, "", false);
    nh_linear_equation_init(&e, 2); /* a subspace that a constant change does take away: 1/x (1 0; 1 2) */
    put(&e, 0, 0, "1  1", "2  0 1");
    put(&e, 1, 0, "1  1", "2  0 1");
    put(&e, 1, 1, "1  2", "2  0 1");
    nh_linear_equation_reduce(&e);
    splits(&e, "11", false);
}

/* The blocks are those that were put in: the traces of A agree. */
Test(linear_split, values)
{
    nh_linear_equation e, *block;
    nh_linear_equation_init(&e, 2);
    put(&e, 0, 0, "1  1", "2  0 1");
    put(&e, 1, 1, "2  3 1", "2  -1 1");
    nh_linear_equation_reduce(&e);
    turn(&e);
    bool triangular;
    cr_assert_eq(nh_linear_equation_split(&e, &block, &triangular), 2);
    size_t first = fmpz_poly_degree(block[0].num) == 0 ? 0 : 1;
    fmpz_poly_t wanted;
    fmpz_poly_init(wanted);
    fmpz_poly_set_str(wanted, "1  1");
    cr_expect(fmpz_poly_equal(block[first].num, wanted));
    fmpz_poly_set_str(wanted, "2  0 1");
    cr_expect(fmpz_poly_equal(block[first].den, wanted));
    fmpz_poly_set_str(wanted, "2  3 1");
    cr_expect(fmpz_poly_equal(block[1 - first].num, wanted));
    fmpz_poly_set_str(wanted, "2  -1 1");
    cr_expect(fmpz_poly_equal(block[1 - first].den, wanted));
    fmpz_poly_clear(wanted);
    clear(2, block);
    nh_linear_equation_clear(&e);
}
