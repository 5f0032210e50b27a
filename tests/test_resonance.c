/* resonance: known polynomials; the bound is never below what eigenvalues with known relations allow; states of rest of nonholonomic systems. */
#include <criterion/criterion.h>

#include <string.h>

#include "absence/resonance.h"
#include "graph/dag.h"
#include "mechanics.h"

static unsigned long state = 4711;
static long drawn(long most) /* -most .. most */
{
    state = (state * 6364136223846793005UL + 1442695040888963407UL);
    return (long)((state >> 33) % (unsigned long)(2 * most + 1)) - most;
}

/* The companion matrix of x^n + c[n-1] x^(n-1) + .. + c[0]. */
static void companion(fmpq_mat_t A, slong n, const long *c)
{
    fmpq_mat_init(A, n, n);
    for (slong i = 0; i + 1 < n; i++) fmpq_one(fmpq_mat_entry(A, i + 1, i));
    for (slong i = 0; i < n; i++) fmpq_set_si(fmpq_mat_entry(A, i, n - 1), -c[i], 1);
}

/* S A S^-1 with a random S of determinant 1. */
static void conjugate(fmpq_mat_t A)
{
    slong n = fmpq_mat_nrows(A);
    for (slong turn = 0; turn < 3 * n; turn++) {
        slong i = (drawn(1000) + 1000) % n, j = (drawn(1000) + 1000) % n;
        if (i == j) continue;
        fmpq_t c, part;
        fmpq_init(c);
        fmpq_init(part);
        fmpq_set_si(c, drawn(2), 1);
        for (slong k = 0; k < n; k++) { /* row i += c row j */
            fmpq_mul(part, c, fmpq_mat_entry(A, j, k));
            fmpq_add(fmpq_mat_entry(A, i, k), fmpq_mat_entry(A, i, k), part);
        }
        for (slong k = 0; k < n; k++) { /* column j -= c column i */
            fmpq_mul(part, c, fmpq_mat_entry(A, k, i));
            fmpq_sub(fmpq_mat_entry(A, k, j), fmpq_mat_entry(A, k, j), part);
        }
        fmpq_clear(c);
        fmpq_clear(part);
    }
}

Test(resonance, known_polynomials)
{
    static const struct { const char *what; slong n; long c[6]; size_t span; bool divergence, prime; } list[] = {
        {"lambda^3 - lambda - 1", 3, {-1, -1, 0}, 2, false, true},
        {"lambda^3 + lambda^2 + 1", 3, {1, 0, 1}, 3, true, true},
        {"lambda^4 + 3*lambda^2 + 1", 4, {1, 0, 3, 0}, 2, false, true},
        {"lambda^4 + 10*lambda^2 + 1", 4, {1, 0, 10, 0}, 2, false, true},
        {"lambda^5 - lambda^4 + 8*lambda^3 + lambda^2 + 21*lambda", 5, {0, 21, 1, 8, -1}, 3, true, false}, /* x (x^2 + x + 3) (x^2 - 2 x + 7): 1, sqrt(-11), sqrt(-6) */
        {"lambda^5 + lambda^4 + 5*lambda^3 + 2*lambda^2 + 3*lambda", 5, {0, 3, 2, 5, 1}, 4, true, true},
        {"lambda^6 - 1", 6, {-1, 0, 0, 0, 0, 0}, 2, false, true}, /* 1 and a cube root of 1 */
        {"lambda^2 - 2", 2, {-2, 0}, 1, false, true},
        {"lambda^2 - 2*lambda - 1", 2, {-1, -2}, 2, true, true},
        {"lambda^3 - 7*lambda - 6", 3, {-6, -7, 0}, 1, false, true}, /* -1, -2, 3 */
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        nh_arena *arena = nh_arena_create();
        fmpq_mat_t A;
        companion(A, list[i].n, list[i].c);
        for (int turn = 0; turn < 2; turn++) {
            nh_resonance *r = nh_resonance_of(arena, A);
            cr_expect(!strcmp(r->polynomial, list[i].what), "%s: %s", list[i].what, r->polynomial);
            cr_expect_eq(r->span, list[i].span, "%s: span %zu", list[i].what, r->span);
            cr_expect(r->diagonalizable, "%s", list[i].what);
            cr_expect_eq(r->at_most, (size_t)list[i].n - list[i].span, "%s: %zu", list[i].what, r->at_most);
            cr_expect_eq(r->divergence, list[i].divergence, "%s", list[i].what);
            cr_expect_eq(r->letters, (size_t)list[i].n);
            cr_expect_eq(r->prime > 1000, list[i].prime, "%s: %lu", list[i].what, r->prime);
            conjugate(A);
        }
        fmpq_mat_clear(A);
        nh_arena_free(arena);
    }
}

/* x' = y, y' = 0: y is the only integral.  The same with the eigenvalue 2 instead of 0: y^2 exp(-2 x/y) is not analytic; there is none. */
Test(resonance, not_diagonalizable)
{
    nh_arena *arena = nh_arena_create();
    fmpq_mat_t A;
    fmpq_mat_init(A, 2, 2);
    nh_resonance *zero = nh_resonance_of(arena, A);
    cr_expect(zero->diagonalizable && zero->at_most == 2 && zero->span == 0 && zero->prime == 0);
    fmpq_one(fmpq_mat_entry(A, 0, 1));
    nh_resonance *r = nh_resonance_of(arena, A);
    cr_expect(!r->diagonalizable && r->at_most == 1 && r->span == 0 && !r->divergence, "%zu", r->at_most);
    fmpq_set_si(fmpq_mat_entry(A, 0, 0), 2, 1);
    fmpq_set_si(fmpq_mat_entry(A, 1, 1), 2, 1);
    r = nh_resonance_of(arena, A);
    cr_expect(!r->diagonalizable && r->at_most == 0 && r->span == 1 && r->divergence, "%zu", r->at_most);
    fmpq_set_si(fmpq_mat_entry(A, 1, 1), 3, 1);
    r = nh_resonance_of(arena, A);
    cr_expect(r->diagonalizable && r->at_most == 1 && r->span == 1, "%zu", r->at_most);
    fmpq_mat_clear(A);
    nh_arena_free(arena);
}

Test(resonance, rational_eigenvalues)
{
    for (int turn = 0; turn < 50; turn++) {
        nh_arena *arena = nh_arena_create();
        slong n = 1 + (drawn(1000) + 1000) % 6;
        bool any = false;
        fmpq_mat_t A;
        fmpq_mat_init(A, n, n);
        for (slong i = 0; i < n; i++) {
            fmpq_set_si(fmpq_mat_entry(A, i, i), drawn(turn % 3 ? 9 : 1), (ulong)(1 + (drawn(2) + 2)));
            any |= !fmpq_is_zero(fmpq_mat_entry(A, i, i));
        }
        conjugate(A);
        nh_resonance *r = nh_resonance_of(arena, A);
        cr_expect_eq(r->span, (size_t)any, "turn %d: %s has span %zu", turn, r->polynomial, r->span);
        cr_expect(r->diagonalizable, "turn %d: %s", turn, r->polynomial);
        fmpq_mat_clear(A);
        nh_arena_free(arena);
    }
}

/* Blocks (a, m b; b, a) with the eigenvalues a +- b sqrt(m): 1, sqrt(-1), sqrt(2), sqrt(3), sqrt(5) are independent over Q, so that the
 * dimension is the rank of the matrix of a's and b's.  It is found; beside a block x^3 - 2, whose roots add 2, no more than that. */
Test(resonance, quadratic_fields)
{
    static const long root[] = {2, 3, 5, -1, 8, 12};
    static const slong base[] = {2, 3, 4, 1, 2, 3}, times[] = {1, 1, 1, 1, 2, 2}; /* sqrt(8) = 2 sqrt(2) */
    enum { roots = 6, turns = 60, most_blocks = 3 };
    for (int turn = 0; turn < turns; turn++) {
        nh_arena *arena = nh_arena_create();
        slong blocks = 1 + (drawn(1000) + 1000) % most_blocks, cubic = turn % 3 == 2 ? 3 : 0;
        fmpq_mat_t A, known;
        fmpq_mat_init(A, 2 * blocks + cubic, 2 * blocks + cubic);
        fmpq_mat_init(known, 2 * blocks, roots);
        for (slong i = 0; i < blocks; i++) {
            size_t which = (size_t)(drawn(1000) + 1000) % roots;
            long a = drawn(3), b = 1 + (drawn(1000) + 1000) % 3;
            fmpq_set_si(fmpq_mat_entry(A, 2 * i, 2 * i), a, 1);
            fmpq_set_si(fmpq_mat_entry(A, 2 * i + 1, 2 * i + 1), a, 1);
            fmpq_set_si(fmpq_mat_entry(A, 2 * i + 1, 2 * i), b, 1);
            fmpq_set_si(fmpq_mat_entry(A, 2 * i, 2 * i + 1), b * root[which], 1);
            for (int sign = 0; sign < 2; sign++) {
                fmpq_set_si(fmpq_mat_entry(known, 2 * i + sign, 0), a, 1);
                fmpq_set_si(fmpq_mat_entry(known, 2 * i + sign, base[which]), (sign ? b : -b) * times[which], 1);
            }
        }
        for (slong i = 0; i < cubic; i++)
            fmpq_set_si(fmpq_mat_entry(A, 2 * blocks + i, 2 * blocks + (i + 1) % 3), i ? 1 : 2, 1);
        conjugate(A);
        nh_resonance *r = nh_resonance_of(arena, A);
        size_t dimension = (size_t)fmpq_mat_rref(known, known) + (cubic ? 2 : 0);
        cr_expect_leq(r->span, dimension, "turn %d: %s has span %zu, and %zu is shown", turn, r->polynomial, dimension, r->span);
        cr_expect(cubic || r->span == dimension, "turn %d: %s has span %zu, and %zu is shown", turn, r->polynomial, dimension, r->span);
        cr_expect(r->diagonalizable, "turn %d: %s", turn, r->polynomial);
        fmpq_mat_clear(A);
        fmpq_mat_clear(known);
        nh_arena_free(arena);
    }
}

/* A shape of these coordinates and all velocities. */
static nh_closed_shape *shape_of(nh_arena *arena, const nh_model *model, const char *const *kept)
{
    nh_closed_shape *shape = nh_arena_alloc(arena, sizeof *shape);
    while (kept[shape->coordinates]) shape->coordinates++;
    shape->model = model;
    shape->count = shape->coordinates + model->n;
    shape->letter = nh_arena_alloc(arena, shape->count * sizeof *shape->letter);
    shape->rate = nh_arena_alloc(arena, shape->count * sizeof *shape->rate);
    shape->angle = nh_arena_alloc(arena, shape->count * sizeof *shape->angle);
    for (size_t i = 0; i < shape->count; i++) {
        if (i < shape->coordinates) {
            long at = nh_system_coordinate(model->system, kept[i]);
            cr_assert(at >= 0);
            shape->letter[i] = model->system->coordinate[at].q;
            shape->rate[i] = model->rho[at];
            shape->angle[i] = model->system->coordinate[at].type == NH_ANGLE;
        } else {
            shape->letter[i] = model->chart->w[i - shape->coordinates];
            shape->rate[i] = model->a[i - shape->coordinates];
        }
    }
    return shape;
}

/* The strongest of the states of a system that moves in the coordinates `kept` and its velocities. */
static const nh_resonance *strongest(nh_arena *arena, const mechanics *x, const char *const *kept, size_t count)
{
    nh_resonance **found;
    size_t n = nh_resonance_find(arena, shape_of(arena, x->model, kept), &found);
    cr_assert_eq(n, count, "%s: %zu states", x->system->name, n);
    for (size_t i = 0; i + 1 < n; i++) cr_expect_leq(found[i]->at_most, found[i + 1]->at_most);
    return n ? found[0] : NULL;
}

/* A file with two words replaced. */
static char *changed(const char *path, const char *first, const char *by, const char *second, const char *by_second)
{
    enum { most = 1 << 16 };
    char *text = nh_alloc(most), *out = nh_alloc(most);
    FILE *file = fopen(path, "r");
    cr_assert(file && fread(text, 1, most - 1, file) > 0);
    fclose(file);
    char *at = strstr(text, first), *next = at ? strstr(at, second) : NULL;
    cr_assert(at && next);
    snprintf(out, most, "%.*s%s%.*s%s%s", (int)(at - text), text, by, (int)(next - at - strlen(first)), at + strlen(first), by_second, next + strlen(second));
    nh_free(text);
    return out;
}

/* The sleigh without its place: it rests with any speed along its blade, and stands on all circles of one energy: one integral.  At rest its
 * equations are quadratic, which says nothing.  An ellipsoid on its long and its middle axis; the ellipsoid's own axes are rational here. */
Test(resonance, rolling)
{
    nh_arena *arena = nh_arena_create();
    mechanics sleigh = mechanics_of_file("systems/sleigh.yaml", NH_CHART_QUASI, 0, NULL);
    const nh_resonance *r = strongest(arena, &sleigh, (const char *const[]){NULL}, 1);
    cr_expect_str_eq(r->point, "omega = 0, v = 1");
    cr_expect_str_eq(r->polynomial, "lambda^2 + 1/4*lambda");
    cr_expect(r->at_most == 1 && r->divergence && r->diagonalizable && r->steady);
    /* With the heading there are two integrals; at rest phi' = omega is not diagonalizable. */
    r = strongest(arena, &sleigh, (const char *const[]){"phi", NULL}, 2);
    cr_expect(r->at_most == 2 && !r->diagonalizable && !r->steady, "%zu", r->at_most);
    mechanics_clear(&sleigh);
    char *text = changed("systems/rattleback.yaml", "a = 1.2\n", "a = 1.21\n", "b = 0.7\n", "b = 0.64\n");
    mechanics rattleback = mechanics_of_text(text, NH_CHART_QUASI);
    nh_free(text);
    r = strongest(arena, &rattleback, (const char *const[]){"theta", "psi", NULL}, 2);
    cr_expect(r->at_most == 3 && r->letters == 5 && !r->divergence, "%zu", r->at_most);
    cr_expect_str_eq(r->point, "theta = pi/2, psi = 0, w1 = 0, w2 = 0, w3 = 0");
    mechanics_clear(&rattleback);
    nh_arena_free(arena);
}

/* x'' = -x - |x|^3 and the like are not analytic at 0: nothing is said there.  x'' = x^3 - sin(x): cos and sin of 1 are no rational numbers, and
 * not needed. */
Test(resonance, only_where_analytic)
{
    static const struct { const char *force; size_t count; } list[] = {
        {"-x - y + 2*x*sqrt(x^2 + y^2 + 1)", 1}, {"-x - y + 2*x*sqrt(x^2 + y^2)", 0}, {"-x - y + x^3*sqrt(x^2 + y^2)", 0}, {"-x - y + x^2*abs(y)", 0},
        {"-x - y + x^2/(1 - cos(y))", 0}, {"-x - y + x^2/(2 - cos(y))", 1}, {"-x*sqrt(2)", 0},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        nh_arena *arena = nh_arena_create();
        char *text = nh_arena_printf(arena, "name: f\ncoordinates:\n  - {name: x, type: length}\n  - {name: y, type: length}\n"
                                            "lagrangian: (x'^2 + y'^2)/2\nforces:\n  - x = %s - x'\n  - y = -3*y + x\n", list[i].force);
        mechanics x = mechanics_of_text(text, NH_CHART_AUTO);
        strongest(arena, &x, (const char *const[]){"x", "y", NULL}, list[i].count);
        mechanics_clear(&x);
        nh_arena_free(arena);
    }
}
