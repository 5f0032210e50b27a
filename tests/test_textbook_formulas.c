/* Formulas of textbooks: the program, given each of them multiplied out, shows it no longer than the book does. */
#include <criterion/criterion.h>

#include "exact/gather.h"
#include "exact/normal.h"
#include "graph/print.h"
#include "typed.h"

typedef struct {
    const char *source, *form;
} formula;

/* LL: Landau and Lifshitz, Mechanics, by section.  G: Goldstein, Classical Mechanics.  W: Whittaker, Analytical
 * Dynamics.  NF: Neimark and Fufaev, Dynamics of Nonholonomic Systems.  B: Bloch, Nonholonomic Mechanics and Control.
 * FS: Fasso and Sansonetto 2016.  V: Veselov and Veselova 1986.  C: Chaplygin 1903 and 1911.  BM: Borisov and Mamaev,
 * Rigid Body Dynamics.  A: Arnold, Mathematical Methods of Classical Mechanics.
 *
 * Not here, because it is not found again: Kovalevskaya's integral as the sum of two squares, in which 2 u^2 v^2 is
 * -2 u^2 v^2 + 4 u^2 v^2 (35 symbols; the program shows 46). */
static const formula textbook[] = {
    /* energies of points */
    {"LL 5, plane double pendulum", "(a + b)*l^2*p'^2/2 + b*h^2*q'^2/2 + b*l*h*p'*q'*cos(p - q) - (a + b)*g*l*cos(p) - "
                                    "b*g*h*cos(q)"},
    {"LL 5, pendulum on a moving point", "(M + m)*x'^2/2 + m*l*(l*p'^2/2 + x'*p'*cos(p) - g*cos(p))"},
    {"LL 5, governor", "m*l^2*(h'^2 + W^2*sin(h)^2) + 2*M*l^2*h'^2*sin(h)^2 - 2*(M + m)*g*l*cos(h)"},
    {"LL 14, spherical pendulum", "m*l^2*(h'^2 + p'^2*sin(h)^2)/2 + m*g*l*cos(h)"},
    {"LL 15, cone", "m*(r'^2 + r^2*p'^2*sin(a)^2)/2 + m*g*r*cos(a)"},
    {"LL 39, rotating frame", "m*(x'^2 + y'^2)/2 - m*W^2*(x^2 + y^2)/2"},
    {"G 1, bead on a turning hoop", "m*r^2*(h'^2 - W^2*sin(h)^2)/2 - m*g*r*cos(h)"},
    {"G 8, spring pendulum", "m*(r'^2 + r^2*h'^2)/2 + k*(r - l)^2/2 - m*g*r*cos(h)"},
    {"G 1, Atwood's machine", "(a + b + J/r^2)*x'^2/2 - (a - b)*g*x"},
    {"W 44, point on a surface of revolution", "m*(z'^2*(1 + f^2) + r^2*p'^2)/2 + V"},
    {"A 14, coupled oscillators", "m*(x'^2 + y'^2)/2 + k*(x^2 + y^2)/2 + c*(x - y)^2/2"},
    {"LL 23, Foucault's pendulum", "(x'^2 + y'^2)/2 + (w^2 - W^2)*(x^2 + y^2)/2"},
    {"Kirillov and Levi 2016, Jacobi's integral of the saddle",
     "(x'^2 + y'^2)/2 + k*((x^2 - y^2)*cos(2*W*t) + 2*x*y*sin(2*W*t))/2 - W*(x*y' - y*x')"},
    {"Szebehely 1967, Jacobi's integral", "(x'^2 + y'^2)/2 - (x^2 + y^2)/2 - (1 - mu)/r - mu/s"},
    {"G 3, two bodies", "(a*(x1'^2 + y1'^2) + b*(x2'^2 + y2'^2))/2 - G*a*b/r"},
    /* angular momentum, and what belongs to a centre */
    {"LL 9, angular momentum about z", "m*(x*y' - y*x')"},
    {"LL 9, of two points", "a*(x1*y1' - y1*x1') + b*(x2*y2' - y2*x2')"},
    {"LL 9, square of the angular momentum", "m^2*((x*y' - y*x')^2 + (y*z' - z*y')^2 + (z*x' - x*z')^2)"},
    {"LL 21, in a magnetic field", "m*(x*y' - y*x') + B*(x^2 + y^2)/2"},
    {"G 3.9, Laplace-Runge-Lenz along z", "m*(z*(x'^2 + y'^2) - z'*(x*x' + y*y')) - k*z/r"},
    {"G 3.9, Laplace-Runge-Lenz along x", "m*y'*(x*y' - y*x') - k*x/r"},
    {"Fradkin 1965, tensor", "m*x'*y' + m*w^2*x*y"},
    {"Fradkin 1965, diagonal", "m*(x'^2 + w^2*x^2)"},
    {"LL 8, centre of mass", "(a*x1 + b*x2 + c*x3) - t*(a*x1' + b*x2' + c*x3')"},
    {"LL 10, scaling of free points", "m*(x*x' + y*y' + z*z') - m*t*(x'^2 + y'^2 + z'^2)"},
    {"Euler 1760, two centres", "(x*y' - y*x')^2 + c^2*x'^2 - 2*c*x*(a/r - b/s)"},
    {"LL 48, on a sphere", "p'^2*sin(h)^2*(sin(h)^2*c + cos(h)^2*c)"},
    /* bodies about a point: the angular velocities in the body are those of LL 35 */
    {"LL 35, free top", "(A*(p'*sin(h)*sin(s) + h'*cos(s))^2 + B*(p'*sin(h)*cos(s) - h'*sin(s))^2 + C*(p'*cos(h) + "
                        "s')^2)/2"},
    {"LL 35, symmetric top", "A*(h'^2 + p'^2*sin(h)^2)/2 + C*(s' + p'*cos(h))^2/2 + g*cos(h)"},
    {"LL 35, its momentum about the vertical", "A*p'*sin(h)^2 + C*(s' + p'*cos(h))*cos(h)"},
    {"LL 35, spin", "C*(s' + p'*cos(h))"},
    {"LL 36, momentum of the free top about the vertical",
     "(A*(p'*sin(h)*sin(s) + h'*cos(s))*sin(s) + B*(p'*sin(h)*cos(s) - h'*sin(s))*cos(s))*sin(h) + C*(p'*cos(h) + "
     "s')*cos(h)"},
    {"LL 36, momentum of the free top along the line of nodes",
     "A*(p'*sin(h)*sin(s) + h'*cos(s))*cos(s) - B*(p'*sin(h)*cos(s) - h'*sin(s))*sin(s)"},
    {"LL 36, Euler's equations, square of the momentum", "A^2*u^2 + B^2*v^2 + C^2*w^2"},
    {"W 71, sleeping top", "A*(h'^2 + p'^2*sin(h)^2) + 2*m*g*l*cos(h)"},
    {"BM, Goryachev and Chaplygin", "w*(u^2 + v^2) - b*u*cos(h)"},
    {"BM, Kovalevskaya, energy", "J*(2*u^2 + 2*v^2 + w^2)/2 + b*sin(h)*sin(s)"},
    {"BM, gyrostat", "(A*u^2 + B*v^2 + C*w^2)/2 + k*w"},
    {"V, energy", "(A*(h'*cos(s) - s'*sin(h)*cos(h)*sin(s))^2 + B*(s'*sin(h)*cos(h)*cos(s) + h'*sin(s))^2 + "
                  "C*s'^2*sin(h)^4)/2"},
    {"V, momentum along x",
     "A*(h'*cos(s) - s'*sin(h)*cos(h)*sin(s))*(cos(p)*cos(s) - sin(p)*cos(h)*sin(s)) + B*(s'*sin(h)*cos(h)*cos(s) + "
     "h'*sin(s))*(cos(p)*sin(s) + sin(p)*cos(h)*cos(s)) + C*s'*sin(h)^3*sin(p)"},
    {"LL 32, differences of moments", "(A - B)*u*v + (B - C)*v*w"},
    {"LL 32, cylinder in a cylinder", "(m + J/a^2)*(R - a)^2*p'^2/2 - m*g*(R - a)*cos(p)"},
    {"LL 32, moment about a turned axis", "A*cos(s)^2 + B*sin(s)^2"},
    {"LL 34, rate of a momentum", "(A - B)*sin(s)*cos(s)*(p' + z)^2"},
    /* rolling and sliding */
    {"NF III, skate", "m*v^2/2 + J*w^2/2"},
    {"C 1911, sleigh", "m*v^2/2 + (J + m*a^2)*w^2/2"},
    {"C 1911, sleigh, direction", "v*sin(p/k) + a*k*w*cos(p/k)"},
    {"C 1903, ball", "(A*(p'*sin(h)*sin(s) + h'*cos(s))^2 + B*(p'*sin(h)*cos(s) - h'*sin(s))^2 + C*(p'*cos(h) + s')^2 "
                     "+ m*r^2*(h'^2 + s'^2*sin(h)^2))/2"},
    {"C 1903, ball, vertical momentum", "A*u*sin(h)*sin(s) + B*v*sin(h)*cos(s) + C*w*cos(h)"},
    {"NF III, homogeneous ball", "(J*(p' + s'*cos(h))^2 + (J + m*r^2)*(h'^2 + s'^2*sin(h)^2))/2"},
    {"NF II, disk that stands upright", "(m*r^2 + J)*h'^2/2 + K*p'^2/2"},
    {"NF III, falling disk", "(A*(h'^2 + p'^2*sin(h)^2) + (C + m*r^2)*(s' + p'*cos(h))^2 + m*r^2*h'^2)/2 + "
                             "m*g*r*sin(h)"},
    {"Routh 1905, sphere, Jellett's integral", "A*r*p'*sin(h)^2 + C*(s' + p'*cos(h))*(l + r*cos(h))"},
    {"Routh 1905, sphere, below the root", "A*C + m*C*(l + r*cos(h))^2 + m*A*r^2*sin(h)^2"},
    {"FS, moving energy on the turntable",
     "((J + m*r^2)*(u^2 + v^2) + J*w^2)/2 - m*W^2*(x^2 + y^2)/2 - J*W*w"},
    {"FS, skate on a belt", "J*h'^2/2 + m*(x' - V)^2/(2*cos(h)^2) - m*V^2/2"},
    {"B 1, ball on a slope", "(m + J/r^2)*(u^2 + v^2)/2 + J*n^2/2 - m*b*x"},
    {"B 1, two wheels", "m*v^2/2 + J*w^2/2 + I*(v^2 + c^2*w^2)/r^2"},
    {"B 3, snakeboard", "(m*l^2*cos(f)^2 + (J + 2*K)*sin(f)^2)*s^2/2 + R*(r + s*sin(f))^2/2 + K*f'^2"},
    {"Krishnaprasad and Tsakiris 2001, roller racer", "(m*u^2 + J*w^2 + K*(u*sin(f) - a*w*cos(f))^2/b^2)/2"},
    {"B 1, car with a trailer", "(J*w^2 + v^2*(m + M*cos(h - s)^2 + K*sin(h - s)^2/d^2))/2"},
    {"crane, momentum of the jib", "(jz + jx*sin(p)^2 + jy*cos(p)^2)*(q + f*sin(s)/l)"},
    {"crane, rate of a momentum", "(jx - jy)*sin(p)*cos(p)*(q' + z)^2"},
    /* oscillators and angles */
    {"LL 22, driven oscillator", "(x' + c*x)*sin(w*t) - w*x*cos(w*t)"},
    {"Ermakov 1880, invariant", "(x*y' - y*x')^2 + k*x^2/y^2"},
    {"LL 50, double angle", "(x'^2 - y'^2)*cos(2*a) + 2*x'*y'*sin(2*a)"},
    {"velocity along a turned heading", "v*cos(a + b) + w*sin(a + b)"},
    {"Henon and Heiles 1964, integrable", "3*x'*y' + 3*x*y*(A + y) + x^3"},
    {"Ramani 1982, quartic", "(x'^2 + 2*k*x^2*(x^2 + 2*y^2))^2 + 4*k*x^2*(2*y*x' - x*y')^2"},
};

enum { formulas = sizeof textbook / sizeof *textbook };

/* As the search has it: multiplied out, then in its shortest form by nh_simplify. */
static nh_ex found(nh_dag *d, const char *form) { return nh_simplify(d, nh_canonical_sum(d, ex(d, form))); }

Test(textbook_formulas, are_shown_no_longer_than_in_the_book)
{
    size_t longer = 0;
    cr_assert_geq((int)formulas, 60);
    for (size_t i = 0; i < formulas; i++) {
        nh_dag *d = nh_dag_create();
        nh_ex book = ex(d, textbook[i].form), shown = nh_gather(d, found(d, textbook[i].form));
        bool good = nh_complexity(d, shown) <= nh_complexity(d, book);
        longer += !good;
        if (!good)
            cr_log_error("%s: %zu symbols, %zu in the book: %s", textbook[i].source, nh_complexity(d, shown),
                         nh_complexity(d, book), nh_print_string(d, shown));
        nh_dag_free(d);
    }
    cr_assert_eq(longer, 0, "%zu of %d formulas are longer than in the book", longer, (int)formulas);
}

Test(textbook_formulas, are_equal_to_those_of_the_book)
{
    for (size_t i = 0; i < formulas; i++) {
        nh_dag *d = nh_dag_create();
        nh_ex book = ex(d, textbook[i].form), shown = nh_gather(d, found(d, textbook[i].form));
        cr_expect_eq(nh_normal_is_zero(d, nh_sub(d, book, shown), 0), NH_ZERO, "%s", textbook[i].source);
        nh_dag_free(d);
    }
}

Test(textbook_formulas, were_longer_before_they_are_gathered)
{
    size_t longer = 0;
    for (size_t i = 0; i < formulas; i++) {
        nh_dag *d = nh_dag_create();
        longer += nh_complexity(d, found(d, textbook[i].form)) > nh_complexity(d, ex(d, textbook[i].form));
        nh_dag_free(d);
    }
    cr_expect_geq((int)longer, 25, "%zu", longer);
}
