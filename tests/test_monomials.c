/* Expressions multiplied out in some of their symbols: the sum is the expression, and each monomial is there once. */
#include "names.h"

#include <string.h>

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/monomials.h"

static nh_ex of_name(const nh_system *s, const char *name)
{
    nh_ex e = 0;
    cr_assert(nh_symbol_find(s->dag, name, &e), "%s", name);
    return e;
}

static nh_system *plane(void)
{
    return system_of("name: plane\nparameters: {a: 2, b: 3}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n");
}

Test(monomials, add_up_to_the_expression)
{
    static const struct {
        const char *text;
        size_t count;
    } ROW[] = {
        {"(x + a)^3*y", 4},
        {"(x + sin(a))*(x - sin(a)) - x^2", 1},
        {"x*(y + 1)/a + y*(x - 1)/b", 3},
        {"((x + y)^2 - (x - y)^2)/(a + b) - 4*x*y/(a + b)", 1}, /* two quotients that only a normal form compares */
        {"x - x", 0},
        {"sqrt(a)", 1},
        {"exp(a*b)*(1 + x)^2*(1 + y)^2", 9},
    };
    nh_system *s = plane();
    nh_ex symbol[] = {of_name(s, "x"), of_name(s, "y")};
    for (size_t i = 0; i < sizeof ROW / sizeof *ROW; i++) {
        nh_ex e = expression_of(s, ROW[i].text), sum = nh_int(s->dag, 0);
        nh_monomials m;
        cr_assert(nh_monomials_of(s->dag, e, 2, symbol, 100, &m), "%s", ROW[i].text);
        cr_expect_leq(m.count, ROW[i].count, "%s: %zu", ROW[i].text, m.count);
        for (size_t k = 0; k < m.count; k++) {
            nh_ex term = m.coefficient[k];
            cr_expect(!nh_depends(s->dag, term, symbol[0]) && !nh_depends(s->dag, term, symbol[1]), "%s", ROW[i].text);
            for (size_t j = 0; j < 2; j++) term = nh_mul(s->dag, term, nh_powi(s->dag, symbol[j], m.exponent[k * 2 + j]));
            sum = nh_add(s->dag, sum, term);
            for (size_t l = 0; l < k; l++)
                cr_expect(memcmp(m.exponent + k * 2, m.exponent + l * 2, 2), "%s: one monomial twice", ROW[i].text);
        }
        cr_expect_eq(nh_normal_is_zero(s->dag, nh_sub(s->dag, sum, e), 0), NH_ZERO, "%s", ROW[i].text);
        nh_monomials_clear(&m);
    }
    nh_system_free(s);
}

Test(monomials, only_polynomials_have_a_degree)
{
    static const struct {
        const char *text;
        bool x, y;
    } ROW[] = {{"x^2*sin(y)", true, false}, {"1/x + y", false, true}, {"x^a", false, true}, {"sqrt(x + y)", false, false},
               {"a^x*y^2", false, true},    {"(x*y + 1)^5/b", true, true}, {"sqrt(a)", true, true}};
    nh_system *s = plane();
    for (size_t i = 0; i < sizeof ROW / sizeof *ROW; i++) {
        nh_ex e = expression_of(s, ROW[i].text);
        cr_expect_eq(nh_monomials_has_degree(s->dag, e, of_name(s, "x")), ROW[i].x, "%s in x", ROW[i].text);
        cr_expect_eq(nh_monomials_has_degree(s->dag, e, of_name(s, "y")), ROW[i].y, "%s in y", ROW[i].text);
    }
    nh_system_free(s);
}

Test(monomials, too_many_are_refused)
{
    nh_system *s = plane();
    nh_ex symbol[] = {of_name(s, "x"), of_name(s, "y")}, e = expression_of(s, "(x + y + a)^20");
    nh_monomials m;
    cr_expect(!nh_monomials_of(s->dag, e, 2, symbol, 100, &m));
    nh_monomials_clear(&m);
    cr_assert(nh_monomials_of(s->dag, e, 2, symbol, 1000, &m));
    cr_expect_eq(m.count, (size_t)(21 * 22 / 2));
    nh_monomials_clear(&m);
    nh_system_free(s);
}
