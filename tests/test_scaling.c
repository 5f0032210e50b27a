/* Scalings of the equations of motion: what they multiply, systems that have none, and what they do to the solutions
 * that are counted. */
#include "names.h"

#include <stdio.h>

#include "count/construct.h"
#include "count/scaling.h"
#include "graph/num.h"

/* Equations that are opened for counting. */
typedef struct {
    nh_system *s;
    nh_model *o;
    nh_jet_equations *x;
} opened;

static opened open_text(const char *text, bool time)
{
    nh_error error = {0};
    opened p = {.s = system_of(text)};
    p.o = nh_model_create(p.s, nh_chart_create(p.s, NH_CHART_AUTO, 1, &error), &error);
    must(p.o != NULL, &error, text);
    p.x = nh_jet_equations_create(p.o, time, false);
    cr_assert_null(p.x->obstacle, "%s", p.x->obstacle);
    return p;
}

static void close_text(opened *p)
{
    nh_jet_equations_free(p->x);
    nh_model_free(p->o);
    nh_system_free(p->s);
}

/* ---- which there are ---- */

/* One scaling; its numbers up to a common factor: kappa of the coordinates, then sigma. */
Test(scaling, homogeneous_systems_have_their_weights)
{
    static const struct {
        const char *text, *function;
        size_t numbers;
        int64_t number[6];
    } ROW[] = {
        /* q -> a q, t -> a^2 t */
        {"coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - 1/(x - y)^2\n", "x - y", 4, {1, 1, -1, -1}},
        /* Kepler: q^3 goes as t^2 */
        {"coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + 1/sqrt(x^2 + y^2)\n", "sqrt(x^2 + y^2)", 4, {2, 2, -1, -1}},
        /* an angle has no weight, and none has its velocity but for the time */
        {"coordinates: [{name: r, type: length}, {name: f, type: angle}]\nlagrangian: (r'^2 + r^2*f'^2)/2 + 1/r\n", "r", 4, {2, 0, -1, -3}},
        /* Henon and Heiles without the oscillator */
        {"coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - x^2*y + y^3/3\n", "x", 4, {2, 2, 3, 3}},
        /* a contact structure: z weighs as x y */
        {"coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2)/2 + z'^2/2*0 - x^4 - y^4\nconstraints: [\"z' = x*y' - y*x'\"]\n", "z", 5, {1, 1, 2, 2, 2}},
    };
    for (size_t i = 0; i < sizeof ROW / sizeof *ROW; i++) {
        char text[400];
        snprintf(text, sizeof text, "name: row\n%s", ROW[i].text);
        opened p = open_text(text, false);
        nh_ex f[4];
        size_t count = 0;
        f[count] = nh_model_compose(p.o, expression_of(p.s, ROW[i].function));
        cr_assert(nh_jet_equations_take(p.x, true, &f[count++]));
        for (size_t k = 0; k < p.x->coordinates; k++)
            if (p.x->coordinate[k] != f[0]) f[count++] = p.x->coordinate[k];
        nh_scalings s = nh_scaling_find(p.x, count, f);
        cr_assert_eq(s.count, 1u, "%s", ROW[i].text);
        size_t m = s.coordinates;
        double scale = nh_num_value(s.number[0]) / (double)ROW[i].number[0];
        cr_expect(scale != 0, "%s", ROW[i].text);
        for (size_t k = 0; k < ROW[i].numbers; k++) {
            double own = nh_num_value(s.number[k < m ? k : k + m]);
            cr_expect(fabs(own - scale * (double)ROW[i].number[k]) < 1e-12, "%s: number %zu is %g", ROW[i].text, k, own);
        }
        for (size_t k = 0; k < m; k++) cr_expect_eq(s.number[m + k].p, 0, "%s: no shift", ROW[i].text);
        nh_scaling_clear(&s);
        close_text(&p);
    }
}

/* Exponentials have weights where coordinates are shifted: Toda's chain. */
Test(scaling, exponentials_are_scaled_by_shifts)
{
    opened p = open_text("name: toda\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - exp(x - y) - exp(y)\n", false);
    nh_ex f[2] = {expression_of(p.s, "exp(x - y)"), expression_of(p.s, "exp(y)")};
    for (size_t k = 0; k < 2; k++) cr_assert(nh_jet_equations_take(p.x, true, &f[k]));
    nh_scalings s = nh_scaling_find(p.x, 2, f);
    cr_assert_eq(s.count, 1u);
    nh_prime field = nh_jet_point_prime(p.x->point, 3);
    nh_residue *scaling = nh_alloc_array(s.width, sizeof *scaling), weight[2];
    bool constant[2];
    cr_assert(nh_scaling_combine(&s, field, scaling));
    nh_scaling_weights(p.x, scaling, field, 2, f, weight, constant);
    nh_residue twice = nh_residue_add(field, scaling[2 * s.coordinates], scaling[2 * s.coordinates]);
    cr_expect(constant[0] && constant[1] && twice && weight[0] == twice && weight[1] == twice);
    nh_free(scaling);
    nh_scaling_clear(&s);
    close_text(&p);
}

/* Terms of different degrees, or a function that no scaling multiplies. */
Test(scaling, other_systems_have_none)
{
    static const char *const NONE[] = {
        "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (x^2 + y^2)/2 - x^2*y + y^3/3\n",
        "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - exp(x) - y^4\n",
        "coordinates: [x, y]\nlagrangian: (1 + x^2)*(x'^2 + y'^2)/2 - 1/x\n",
    };
    for (size_t i = 0; i < sizeof NONE / sizeof *NONE; i++) {
        char text[300];
        snprintf(text, sizeof text, "name: none\n%s", NONE[i]);
        opened p = open_text(text, false);
        nh_scalings s = nh_scaling_find(p.x, 2, p.x->coordinate);
        cr_expect_eq(s.count, 0u, "%s", NONE[i]);
        nh_scaling_clear(&s);
        close_text(&p);
    }
}

/* ---- what they do to solutions ---- */

static nh_construction *constructed(const nh_model *o, size_t degree, double price, size_t words, bool weights)
{
    nh_ex known = o->E;
    nh_construct_question q = {.degree = degree, .price = price, .most_words = words, .work = 2e9, .known = 1,
                               .independent = 1, .current = &known, .weights = weights};
    return nh_construct(o, &q);
}

/* Post and Winternitz's cubic integral is found by weights in the same terms as without. */
Test(scaling, an_integral_has_the_same_terms_with_weights_and_without)
{
    opened p = open_text("name: pw\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - 7/10*y*x^(-2/3)\n", false);
    nh_construction *plain = constructed(p.o, 3, 2, 600, false), *own = constructed(p.o, 3, 2, 600, true);
    cr_assert(plain->count == 1 && own->count == 1 && own->whole);
    cr_assert_eq(own->item[0].terms, plain->item[0].terms);
    for (size_t i = 0; i < own->item[0].terms; i++) {
        bool same = false;
        for (size_t j = 0; j < plain->item[0].terms; j++) same |= plain->item[0].term[j] == own->item[0].term[i];
        cr_expect(same);
    }
    nh_construction_free(own);
    nh_construction_free(plain);
    close_text(&p);
}

/* An integral of degree four of Calogero's system of type B3: words of all weights are more than 200. */
Test(scaling, words_of_one_weight_are_fewer)
{
    opened p = open_text("name: B3\ncoordinates: [a, b, c]\nlagrangian: (a'^2 + b'^2 + c'^2)/2 - 1/(a - b)^2 - 1/(a - c)^2 - "
                         "1/(b - c)^2 - 1/(a + b)^2 - 1/(a + c)^2 - 1/(b + c)^2 - 1/a^2 - 1/b^2 - 1/c^2\n", false);
    nh_construction *plain = constructed(p.o, 4, 2, 200, false), *own = constructed(p.o, 4, 2, 200, true);
    cr_expect(plain->count == 0 && own->count > 0, "%zu and %zu", plain->count, own->count);
    nh_construction_free(own);
    nh_construction_free(plain);
    close_text(&p);
}

/* Of each homogeneous function of one variable there is one: what is recognised must be so for more reasons than that
 * the words of a weight span all such functions.  A system with one integral keeps one. */
Test(scaling, nothing_is_recognised_by_too_many_words)
{
    opened p = open_text("name: quartic\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - x^4 - x^3*y - 2*y^4\n", false);
    for (size_t degree = 2; degree <= 4; degree++)
        for (double price = 2; price <= 8; price *= 2) {
            nh_construction *c = constructed(p.o, degree, price, 600, true);
            cr_expect_eq(c->count, 0u);
            nh_construction_free(c);
        }
    close_text(&p);
}

/* Solutions that are continued from a lower order are those of the long series. */
Test(scaling, solutions_continue_from_a_lower_order)
{
    opened p = open_text("name: kepler\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + 1/sqrt(x^2 + y^2)\n", false);
    nh_count_question q = {.degree = 2, .work = 2e9};
    nh_counter c;
    bool regular = false;
    nh_counter_open(&c, p.o, &q, false);
    for (size_t attempt = 0; !regular; attempt++)
        if (nh_count_regular_point(&c, attempt)) nh_count_series_free(nh_count_series_create(&c, 1, 2e9, &regular));
    nh_count_series *few = nh_count_series_create(&c, 6, 2e9, &regular), *many = nh_count_series_create(&c, 9, 2e9, &regular);
    nh_graded_problem first = nh_count_problem(&c, few, 2, NH_EVEN_DEGREES), last = nh_count_problem(&c, many, 2, NH_EVEN_DEGREES);
    first.keep = last.keep = true;
    nh_graded_count *start = nh_graded_solve(&first), *whole = nh_graded_solve(&last);
    last.from = start->total[6];
    last.from_order = 6;
    last.from_size = few->ring->size;
    last.from_series = start->series;
    nh_graded_count *rest = nh_graded_solve(&last);
    size_t N = whole->total[9], size = many->ring->size;
    cr_assert(whole->solved && rest->solved && N > 1);
    cr_assert_eq(rest->total[9], N);
    cr_expect_eq(memcmp(rest->series, whole->series, whole->alphas * size * N * sizeof *whole->series), 0);
    nh_graded_count_clear(rest);
    nh_graded_count_clear(whole);
    nh_graded_count_clear(start);
    nh_count_series_free(many);
    nh_count_series_free(few);
    nh_counter_close(&c);
    close_text(&p);
}
