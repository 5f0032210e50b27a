/* The discrete problem piece by piece: points, ansatz, rows. */
#include "families.h"

#include "graph/dag.h"

/* ---- points ---- */

#define ON_A_LINE(lagrangian) "name: line\ncoordinates:\n  - {name: x, type: length}\nlagrangian: " lagrangian "\n"

static nh_points *counted(const char *text, size_t count)
{
    mechanics x = mechanics_of_text(text, NH_CHART_AUTO);
    nh_points *p = points_of(x.model, count, 3);
    cr_assert_eq(p->count, count);
    cr_assert_eq(p->tried, p->count + p->not_finite + p->not_solved + p->degenerate);
    mechanics_clear(&x);
    return p;
}

Test(points, rejections_are_counted_by_reason)
{
    nh_points *p = counted(ON_A_LINE("x'^2/2 + log(x)"), 200); /* defined for half of the box */
    cr_assert(p->not_finite > 120 && p->not_finite < 300 && p->not_solved == 0 && p->degenerate == 0, "%zu not finite", p->not_finite);
    nh_points_free(p);
    p = counted(ON_A_LINE("x'^2/2 - 1e8*x^2"), 200); /* |x''| > 1e8 for |x| > 1/2 */
    cr_assert(p->degenerate > 120 && p->degenerate < 300 && p->not_finite == 0, "%zu degenerate", p->degenerate);
    nh_points_free(p);
    p = counted(PARTICLE("slow", "") "lagrangian: x'^2 + y'^2\nconstraints: [\"sqrt(x'^2 + y'^2) = 1\"]\ndependent: [y]\n", 200); /* |x'| < 1 */
    cr_assert(p->not_solved + p->not_finite > 60, "%zu not solved", p->not_solved);
    nh_points_free(p);
    p = counted(ON_A_LINE("x'^2/2"), 200);
    cr_assert_eq(p->tried, 200);
    nh_points_free(p);
}

Test(points, too_few_are_an_error_that_counts)
{
    nh_error error = {0};
    mechanics x = mechanics_of_text(ON_A_LINE("x'^2/2 + log(x - 0.999)"), NH_CHART_AUTO);
    cr_assert_null(nh_points_create(x.model, 100, 1, 1, &error));
    cr_assert_eq(error.code, NH_NUMERIC);
    cr_assert(strstr(error.what, "of 4200 sample points were usable") && strstr(error.hint, "domain"), "%s | %s", error.what, error.hint);
    mechanics_clear(&x);
}

/* ---- beyond the chart ---- */

#define SKATE_BY_X(domain) PARTICLE_WITH_HEADING "constraints: [\"x'*sin(phi) - y'*cos(phi) = 0\"]\ndependent: [y]\ndomain: {phi: " domain "}\n"
#define PARTICLE_WITH_HEADING "name: skate\ncoordinates:\n  - {name: x, type: length}\n  - {name: y, type: length}\n  - {name: phi, type: angle}\n" \
    "lagrangian: (x'^2 + y'^2)/2 + phi'^2/4 - sin(phi)*x\n"

/* Near phi = pi/2 the chart of x' breaks down: points there satisfy the constraint and the equations of motion in all coordinates. */
Test(points, another_chart_takes_over)
{
    mechanics x = mechanics_of_text(SKATE_BY_X("[1.0, 2.1]"), NH_CHART_AUTO);
    nh_points *plain = points_of(x.model, 400, 4), *p = nh_points_cover(x.model, 400, 4, NULL);
    cr_assert_not_null(p);
    const nh_points *b = p->beyond;
    cr_assert_not_null(b);
    cr_assert_eq(p->tried - nh_points_equations(p), 0, "none is lost");
    cr_assert_eq(plain->tried, p->tried);
    cr_assert_null(plain->beyond);
    size_t width = x.model->width, m = x.model->m;
    for (size_t i = 0; i < b->count; i++) {
        double phi = b->column[3][i], vx = b->column[width][i], vy = b->column[width + 1][i], turn = b->column[width + 2][i];
        double along = vx * cos(phi) + vy * sin(phi), rate = -cos(phi) * sin(phi); /* v' = F_x cos phi on the blade, x'' = (v cos phi)' */
        cr_assert(fabs(cos(phi)) < 0.05 && fabs(vx * sin(phi) - vy * cos(phi)) < 1e-13, "at %g", phi);
        cr_assert_float_eq(b->column[width + m][i], rate * cos(phi) - along * turn * sin(phi), 1e-12);
        cr_assert_eq(b->column[4][i], vx);
        cr_assert(b->weight[i] > 0 && b->weight[i] <= 1);
    }
    nh_points_free(plain);
    nh_points_free(p);
    mechanics_clear(&x);
}

/* On one branch of a quadratic constraint no point of the other is taken. */
Test(points, another_chart_knows_no_branches)
{
    mechanics x = mechanics_of_text(PARTICLE_WITH_HEADING "constraints: [\"x'^2*sin(phi)^2 - y'^2*cos(phi)^2 = 0\"]\ndependent: [y]\n", NH_CHART_AUTO);
    nh_points *p = nh_points_cover(x.model, 400, 4, NULL);
    cr_assert(x.model->chart->branch && p && p->degenerate > 0);
    cr_assert_null(p->beyond);
    nh_points_free(p);
    mechanics_clear(&x);
}

/* The rows from beyond the chart vanish for a current and for nothing else: energy against energy + x'^2/100. */
Test(rows, equations_from_beyond_the_chart)
{
    mechanics x = mechanics_of_text(SKATE_BY_X("[1.0, 2.1]"), NH_CHART_AUTO);
    nh_points *p = nh_points_cover(x.model, 400, 4, NULL);
    nh_ex e[2] = {x.model->E, nh_add(x.model->dag, x.model->E, formula(x.model, "x'^2/100"))};
    nh_family family = {.kind = NH_TERMS, .terms = 2, .term = e};
    nh_ansatz *a = ansatz_of(x.model, p, 1, &family);
    cr_assert_eq(a->columns, 2);
    size_t rows = nh_points_equations(p);
    double *A = nh_alloc_array(2 * rows, sizeof *A), *B = nh_alloc_array(2 * p->count, sizeof *B), largest[2] = {0};
    nh_rows_all(x.model, a, p, A, B);
    for (size_t j = 0; j < 2; j++)
        for (size_t i = p->count; i < rows; i++) largest[j] = fmax(largest[j], fabs(A[j * rows + i]));
    cr_assert(largest[0] < 1e-12 && largest[1] > 1e-6, "%g %g", largest[0], largest[1]);
    nh_free(A);
    nh_free(B);
    nh_ansatz_free(a);
    nh_points_free(p);
    mechanics_clear(&x);
}

/* weight = 1 / (1 + max|a| + max|v|), everywhere on the submanifold. */
Test(points, weights_and_constraints)
{
    mechanics x = mechanics_of_text(COUPLED, NH_CHART_AUTO);
    const nh_model *o = x.model;
    nh_points *p = points_of(o, 300, 4);
    double z[20], a[10], v[10], f;
    for (size_t i = 0; i < p->count; i += 7) {
        point_of(p, i, z);
        values_at(o, o->n, o->a, z, a);
        values_at(o, o->m, o->rho, z, v);
        double fast = 0, strong = 0;
        for (size_t j = 0; j < o->n; j++) strong = fmax(strong, fabs(a[j]));
        for (size_t j = 0; j < o->m; j++) fast = fmax(fast, fabs(v[j]));
        cr_assert_float_eq(p->weight[i], 1 / (1 + strong + fast), 1e-15);
        for (size_t k = 0; k < o->k; k++) {
            f = value_at(o, nh_model_compose(o, nh_chart_constraint(o->chart, k)), z);
            cr_assert(fabs(f) < 1e-13, "constraint %zu is off by %g", k, f);
        }
    }
    nh_points_free(p);
    mechanics_clear(&x);
}

Test(points, boxes_seeds_and_stretch)
{
    mechanics x = sleigh(2, 1, 2);
    nh_points *p = points_of(x.model, 500, 7), *same = points_of(x.model, 500, 7), *other = points_of(x.model, 500, 8);
    nh_points *wide = nh_points_create(x.model, 500, 1.7, 7, NULL);
    double largest = 0, farthest = 0, heading = 0;
    size_t equal = 0;
    for (size_t i = 0; i < 500; i++) {
        for (size_t j = 0; j < p->width; j++) {
            cr_assert_eq(p->column[j][i], same->column[j][i]);
            equal += p->column[j][i] == other->column[j][i];
        }
        largest = fmax(largest, fabs(p->column[4][i]));
        farthest = fmax(farthest, fabs(wide->column[4][i]));
        heading = fmax(heading, fabs(wide->column[1][i]));
    }
    cr_assert_eq(equal, 0);
    cr_assert(largest <= 2 && largest > 1.98 && farthest <= 3.4 && farthest > 3.3 && heading <= 1.2, "%g %g %g", largest, farthest, heading);
    nh_points_free(p);
    nh_points_free(same);
    nh_points_free(other);
    nh_points_free(wide);
    mechanics_clear(&x);
}

/* Values in blocks of a batch, and the last incomplete block. */
Test(points, evaluation_agrees_with_single_points)
{
    mechanics x = sleigh(1.3, 0.7, 1.5);
    nh_points *p = points_of(x.model, 2 * NH_BATCH + 37, 9);
    nh_ex e[2] = {formula(x.model, PHI2), formula(x.model, "t*sqrt(E)")};
    double *value = nh_alloc_array(2 * p->count, sizeof *value), z[6];
    nh_points_evaluate(p, x.model, 2, e, value);
    for (size_t i = 0; i < p->count; i++)
        for (size_t k = 0; k < 2; k++) {
            point_of(p, i, z);
            double one = value_at(x.model, e[k], z);
            cr_assert(fabs(value[k * p->count + i] - one) <= 1e-14 * (1 + fabs(one)));
        }
    nh_free(value);
    nh_points_free(p);
    mechanics_clear(&x);
}

/* ---- ansatz ---- */

/* column_j = sum_r to_term[r,j] term_r ; the worst error over the points, relative to the largest sum of |terms| there. */
static double map_error(const nh_model *o, const nh_ansatz *a, const nh_points *points)
{
    size_t n = points->count;
    nh_ex *e = nh_alloc_array(a->columns + a->terms + 1, sizeof *e);
    double *value = nh_alloc_array((a->columns + a->terms) * n + 1, sizeof *value), worst = 0;
    for (size_t j = 0; j < a->columns; j++) e[j] = nh_ansatz_column(a, j);
    memcpy(e + a->columns, a->term, a->terms * sizeof *e);
    nh_points_evaluate(points, o, a->columns + a->terms, e, value);
    for (size_t j = 0; j < a->columns; j++) {
        double error = 0, size = 0;
        for (size_t p = 0; p < n; p++) {
            double sum = 0, terms = 0;
            for (size_t r = 0; r < a->terms; r++) {
                double c = a->to_term[r + j * a->terms];
                if (c == 0) continue;
                sum += c * value[(a->columns + r) * n + p];
                terms += fabs(c * value[(a->columns + r) * n + p]);
            }
            size = fmax(size, terms);
            error = isfinite(sum) ? fmax(error, fabs(sum - value[j * n + p])) : INFINITY;
        }
        worst = fmax(worst, error / fmax(size, 1e-300));
    }
    nh_free(value);
    nh_free(e);
    return worst;
}

Test(ansatz, terms_and_columns_span_the_same)
{
    mechanics x = sleigh(1.3, 0.7, 1.5);
    nh_points *points = points_of(x.model, 256, 1), *others = nh_points_create(x.model, 300, 1.7, 2, NULL);
    families f;
    families_of(x.model, &f);
    for (size_t i = 0; i < 5; i++) {
        nh_ansatz *a = ansatz_of(x.model, points, 1, &f.family[i]);
        double inside = map_error(x.model, a, points), outside = map_error(x.model, a, others);
        cr_expect(inside < 1e-14, "family %zu is off by %.1e", i, inside);
        cr_expect(outside < 1e-13, "family %zu is off by %.1e at other points", i, outside);
        nh_ansatz_free(a);
    }
    nh_ansatz *a = ansatz_of(x.model, points, 5, f.family);
    cr_expect_lt(map_error(x.model, a, points), 1e-14);
    nh_ansatz_free(a);
    nh_points_free(points);
    nh_points_free(others);
    mechanics_clear(&x);
}

/* Sizes by hand; what two families share enters once. */
Test(ansatz, sizes_and_duplicates)
{
    mechanics x = sleigh(1.3, 0.7, 1.5);
    nh_points *points = points_of(x.model, 256, 1);
    families f;
    families_of(x.model, &f);
    const size_t size[] = {20, 5, 3, 3 * 5 * 4, 13};
    for (size_t i = 0; i < 5; i++) {
        nh_ansatz *a = ansatz_of(x.model, points, 1, &f.family[i]);
        cr_expect_eq(a->columns, size[i], "family %zu has %zu columns", i, a->columns);
        cr_expect_eq(a->terms, size[i]);
        nh_ansatz_free(a);
    }
    nh_family twice[] = {f.wave, f.velocities, f.wave, f.velocities};
    nh_ansatz *a = ansatz_of(x.model, points, 4, twice);
    cr_expect_eq(a->columns, 20 + 5 - 1); /* the constant is in both */
    cr_expect_eq(a->terms, 20 + 5 - 1);
    nh_ansatz_free(a);
    nh_family shared[] = {f.velocities, f.terms}; /* omega^2 and 1 are terms of both; omega^2 is not a column of the first */
    a = ansatz_of(x.model, points, 2, shared);
    cr_expect_eq(a->terms, 20 + 1);
    cr_expect_eq(a->columns, 20 + 2);
    cr_expect_lt(map_error(x.model, a, points), 1e-14);
    nh_ansatz_free(a);
    nh_points_free(points);
    mechanics_clear(&x);
}

/* The working columns are well conditioned where the monomials are not. */
Test(ansatz, columns_are_of_size_one)
{
    mechanics x = sleigh(1.3, 0.7, 1.5);
    nh_points *points = points_of(x.model, 256, 1);
    families f;
    families_of(x.model, &f);
    nh_family high = {.kind = NH_POLYNOMIAL, .in_count = 1, .in = &f.in[2], .degree = 8}; /* powers of x + 3, up to 65536 */
    nh_ansatz *a = ansatz_of(x.model, points, 1, &high);
    double *value = nh_alloc_array(points->count, sizeof *value);
    for (size_t j = 0; j < a->columns; j++) {
        nh_ex e = nh_ansatz_column(a, j);
        double largest = 0;
        nh_points_evaluate(points, x.model, 1, &e, value);
        for (size_t p = 0; p < points->count; p++) largest = fmax(largest, fabs(value[p]));
        cr_assert(largest > 0.9 && largest < 1 + 1e-9, "column %zu reaches %g", j, largest);
    }
    nh_free(value);
    nh_ansatz_free(a);
    nh_points_free(points);
    mechanics_clear(&x);
}

static void refused(const nh_model *o, const nh_points *points, const nh_family *family, size_t most)
{
    nh_error error = {0};
    cr_assert_null(nh_ansatz_create(o, points, 1, family, most, &error));
    cr_assert_eq(error.code, NH_LIMIT);
    cr_assert(strstr(error.what, "more than") && strstr(error.hint, "--columns"), "%s", error.what);
}

Test(ansatz, too_large)
{
    mechanics x = sleigh(1.3, 0.7, 1.5);
    nh_points *points = points_of(x.model, 64, 1);
    families f;
    families_of(x.model, &f);
    refused(x.model, points, &f.velocities, 19);
    refused(x.model, points, &f.family[3], 59);
    f.velocities.degree = 200; /* must be noticed before it is built: 1.4 million columns */
    refused(x.model, points, &f.velocities, 1500);
    f.wave.degree = 200;
    nh_family product[] = {f.wave, f.wave, f.wave, f.wave, f.wave, f.wave, f.wave, f.wave};
    nh_family big = {.kind = NH_FAMILY_PRODUCT, .parts = 8, .part = product}; /* 401^8 overflows 64 bits */
    refused(x.model, points, &big, 1500);
    nh_points_free(points);
    mechanics_clear(&x);
}

/* ---- rows ---- */

/* Gamma(b_j) and kappa b_j by Leibniz' rule against the tape of the column as one expression. */
Test(rows, leibniz_rates_are_derivatives_along_gamma)
{
    mechanics x = sleigh(1.3, 0.7, 1.5);
    const nh_model *o = x.model;
    nh_points *points = points_of(o, NH_BATCH + 70, 1);
    families f;
    families_of(o, &f);
    nh_ansatz *a = ansatz_of(o, points, 5, f.family);
    size_t n = points->count, worst_column = 0;
    nh_ex kappa = formula(o, "omega"), e[2];
    double *A = nh_alloc_array(n * a->columns, sizeof *A), *B = nh_alloc_array(n * a->columns, sizeof *B), *value = nh_alloc_array(2 * n, sizeof *value);
    double worst = 0;
    nh_rows_pencil(o, a, kappa, points, A, B);
    for (size_t j = 0; j < a->columns; j++) {
        double size = 0, error = 0;
        e[0] = nh_model_gamma(o, nh_ansatz_column(a, j));
        e[1] = nh_mul(o->dag, kappa, nh_ansatz_column(a, j));
        nh_points_evaluate(points, o, 2, e, value);
        for (size_t p = 0; p < n; p++) {
            double w = points->weight[p];
            size = fmax(size, w * (fabs(value[p]) + fabs(value[n + p])));
            error = fmax(error, fabs(A[j * n + p] - w * value[p]) + fabs(B[j * n + p] - w * value[n + p]));
        }
        if (error / fmax(size, 1e-300) > worst) worst_column = j;
        worst = fmax(worst, size == 0 ? error : error / size);
    }
    cr_assert(worst < 1e-12, "column %zu is off by %.1e", worst_column, worst);
    nh_free(A);
    nh_free(B);
    nh_free(value);
    nh_ansatz_free(a);
    nh_points_free(points);
    mechanics_clear(&x);
}

/* The symmetry route's rows for the fields of some currents: the null space they leave. */
static nh_nullspace *fields(const nh_model *o, size_t n, const char *const *text, size_t *columns)
{
    nh_ex b[8];
    nh_error error = {0};
    nh_options options = defaults();
    nh_nullspace_options limits = nh_nullspace_options_from(&options);
    nh_field_column *column;
    nh_points *points = points_of(o, 200, 1);
    for (size_t i = 0; i < n; i++) b[i] = formula(o, text[i]);
    *columns = nh_rows_field_columns(o, n, b, &column);
    nh_equations *equations = nh_equations_create(*columns, 1);
    nh_rows_symmetry(o, *columns, column, points, equations);
    nh_nullspace *s = nh_nullspace_solve(equations, &limits, &error);
    must(s != NULL, &error, "the null space");
    nh_equations_free(equations);
    nh_points_free(points);
    return s;
}

Test(rows, the_symmetry_route_sees_true_fields_only)
{
    static const char *const true_ones[] = {"E", PHI2, PHI2B}, *const false_ones[] = {"omega^2", "m*v*sin(phi) + m*a*omega*cos(phi)", "v*omega"};
    mechanics x = sleigh(1.3, 0.7, 1.5);
    size_t columns;
    for (size_t i = 0; i < 3; i++) {
        nh_nullspace *s = fields(x.model, 1, &true_ones[i], &columns), *wrong = fields(x.model, 1, &false_ones[i], &columns);
        cr_expect(s->dimension == 1 && s->spectrum[0] < 1e-14, "%s: %zu, %.1e", true_ones[i], s->dimension, s->spectrum[0]);
        cr_expect(wrong->dimension == 0 && wrong->spectrum[0] > 1e-4, "%s: %zu, %.1e", false_ones[i], wrong->dimension, wrong->spectrum[0]);
        nh_nullspace_free(s);
        nh_nullspace_free(wrong);
    }
    nh_nullspace *s = fields(x.model, 3, true_ones, &columns);
    cr_expect_eq(s->dimension, 3);
    nh_nullspace_free(s);
    mechanics_clear(&x);
}
