/* Integrals that the stages of the search miss and the count does not: published systems, analysed without an analysis file. */
#include <criterion/criterion.h>

#include "catalogue.h"
#include "published.h"
#include "scratch.h"
#include "sweep.h"

static nh_analysis *analysed_with(const char *text, double construct_work, double words)
{
    char path[SCRATCH];
    FILE *out = scratch_open(path);
    cr_assert_not_null(out);
    fprintf(out, "name: published\n%s", text);
    fclose(out);
    nh_error error = {0};
    nh_request q = {.system_path = path};
    nh_options_default(&q.options);
    q.options.max_seconds = 1e6; /* the same on every machine */
    if (construct_work >= 0) q.options.construct = construct_work;
    if (words > 0) q.options.words = words;
    nh_analysis *r = nh_analysis_create(&q, &error);
    remove(path);
    cr_assert_not_null(r, "%s", error.what);
    return r;
}

static nh_analysis *analysed(const char *text, double construct_work) { return analysed_with(text, construct_work, 0); }

static size_t independent_and_proved(const nh_analysis *r)
{
    size_t n = 0;
    for (size_t k = 0; k < r->list->count; k++) n += r->list->found[k].independence == NH_INDEPENDENT && r->list->found[k].proof.proved;
    return n;
}

/* Every current is constant along the motion with multipliers as well, which shares no code with the search. */
Test(published, published_systems_are_complete_and_proved, PLAIN_ONLY)
{
    for (size_t i = 0; i < PUBLISHED_COUNT; i++) {
        if (!sweep_tries(i, 60, 120)) continue;
        const published *u = &PUBLISHED[i];
        nh_analysis *r = analysed(u->text, -1);
        const nh_completeness *c = &r->completeness[NH_COMPLETE_IN_COORDINATES];
        row o = {.rate = -INFINITY};
        compare(r, &o);
        cr_expect_eq(o.wrong, 0, "%s: %s", u->name, o.names);
        cr_expect_geq(independent_and_proved(r), u->proved, "%s: %zu proved", u->name, independent_and_proved(r));
        cr_expect(c->counted && c->degree >= u->degree && !c->missing_at, "%s: complete to degree %zu", u->name, c->degree);
        nh_analysis_free(r);
    }
}

/* A blade that slips sideways at a constant rate: the frequency of its integral is sqrt(0.4), and that less or more a whole number is none, because here only
 * one combination of the velocities and the first harmonics has rates of the velocity of h. */
Test(published, a_frequency_that_whole_numbers_do_not_shift, WHOLE_ONLY)
{
    nh_analysis *r = analysed("parameters: {M: 2, J: 3, d: 1}\ncoordinates: [x, y, {name: h, type: angle}]\n"
                              "lagrangian: M*(x'^2 + y'^2)/2 + J*h'^2/2\nconstraints: [\"x'*sin(h) - y'*cos(h) - d*h' = 0.3\"]\n", -1);
    const nh_completeness *c = &r->completeness[NH_COMPLETE_IN_COORDINATES];
    cr_expect(c->counted && c->degree >= 4 && !c->missing_at, "complete to degree %zu", c->degree);
    for (size_t k = 0; k < r->list->count; k++) cr_expect(r->list->found[k].proof.all_parameters, "Phi%zu", k + 1);
    cr_expect_eq(independent_and_proved(r), 2);
    nh_analysis_free(r);
}

/* Coefficients over all parameters, not for the values of the file only. */
Test(published, what_is_constructed_is_proved_for_all_parameters, PLAIN_ONLY)
{
    nh_analysis *r = analysed(PUBLISHED[1].text, -1);
    for (size_t k = 0; k < r->list->count; k++) cr_expect(!r->list->found[k].proof.proved || r->list->found[k].proof.all_parameters, "Phi%zu", k + 1);
    nh_analysis_free(r);
}

static nh_analysis *analysed_row(const char *name)
{
    for (size_t i = 0; i < PUBLISHED_COUNT; i++)
        if (!strcmp(PUBLISHED[i].name, name)) return analysed(PUBLISHED[i].text, -1);
    cr_assert_fail("no row %s", name);
    return NULL;
}

/* Of two roots, each a power of a coordinate times the other, the system's own alone is a letter: with both, one integral of two was found, and not proved. */
Test(published, a_root_that_the_system_has_is_no_second_letter, PLAIN_ONLY)
{
    nh_analysis *r = analysed_row("Perlick, first family");
    cr_expect_eq(independent_and_proved(r), 3);
    for (size_t k = 0; k < r->list->count; k++) cr_expect(r->list->found[k].proof.all_parameters, "Phi%zu", k + 1);
    cr_expect_eq(r->completeness[NH_COMPLETE_IN_COORDINATES].missing_at, 0);
    nh_analysis_free(r);
}

/* Coefficients of constructed integrals that are quotients in the parameters: W m R/(I + m R^2). */
Test(published, quotients_of_parameters_in_what_is_constructed, WHOLE_ONLY)
{
    nh_analysis *r = analysed_row("vertical disk on a turntable");
    cr_expect_eq(independent_and_proved(r), 5);
    for (size_t k = 0; k < r->list->count; k++) cr_expect(r->list->found[k].proof.all_parameters, "Phi%zu", k + 1);
    nh_analysis_free(r);
}

/* C. P. Dettmann and G. P. Morriss, Phys. Rev. E 54 (1996) 2495: Gauss's thermostat keeps the speed, and a momentum times an exponential of the potential; here on a
 * sphere, where the momentum is no product of a velocity and positions. */
Test(published, a_thermostat_on_a_sphere, PLAIN_ONLY)
{
    nh_analysis *r = analysed("parameters: {v: 0.5}\ncoordinates: [{name: h, type: angle}, {name: f, type: angle}]\n"
                              "lagrangian: (h'^2 + sin(h)^2*f'^2)/2 - cos(h)\nconstraints: [\"h'^2 + sin(h)^2*f'^2 = v^2\"]\ndomain: {h: [0.5, 2.5]}\n", -1);
    cr_expect_eq(independent_and_proved(r), 1);
    nh_analysis_free(r);
}

/* The fourth has waves in t, with the rates that the integrals have: known before, so that they cost nothing. */
Test(published, waves_in_time_are_within_the_work, WHOLE_ONLY)
{
    nh_analysis *r = analysed_row("Tremblay, Turbiner and Winternitz, k = 1/2");
    cr_expect_eq(independent_and_proved(r), 4);
    nh_analysis_free(r);
}

/* The fourth has waves of the rate 2 sqrt(k/m), which is none of the numbers of the system, and holds for all k and m. */
Test(published, rates_in_time_are_roots_of_parameters, WHOLE_ONLY)
{
    nh_analysis *r = analysed_row("Tremblay, Turbiner and Winternitz, k = 2, with a spring");
    cr_expect_eq(independent_and_proved(r), 4);
    for (size_t k = 0; k < r->list->count; k++) cr_expect(r->list->found[k].proof.all_parameters, "%s", r->list->found[k].name);
    nh_analysis_free(r);
}

Test(published, without_work_nothing_is_constructed_and_that_is_said)
{
    nh_analysis *r = analysed(PUBLISHED[0].text, 0);
    const nh_completeness *c = &r->completeness[NH_COMPLETE_IN_COORDINATES];
    cr_expect_eq(r->list->independent, 1);
    cr_expect_eq(c->missing_at, 4);
    cr_expect_eq(c->missing, 1);
    nh_analysis_free(r);
}

/* Two bodies and their mirror images near one point: the poles are nearly dependent on each other there, so that the integral of degree four is lost in doubles; its
 * coefficients are read from the residues.  With few words allowed few of the four denominators stand in one. */
#define NARROW_B2 \
    "parameters: {g: 0.4, h: 0.7}\n" PLANE "x^2 - y^2 - g/(x - y)^2 - g/(x + y)^2 - h/x^2 - h/y^2\ndomain: {x: [0.2, 0.25], y: [1.5, 1.55]}\n"

Test(published, integrals_with_nearly_dependent_poles, PLAIN_ONLY)
{
    static const double words[] = {0, 150};
    for (size_t i = 0; i < 2; i++) {
        if (!sweep_tries(i, 2, 2)) continue;
        nh_analysis *r = analysed_with(NARROW_B2, -1, words[i]);
        const nh_completeness *c = &r->completeness[NH_COMPLETE_IN_COORDINATES];
        cr_expect(independent_and_proved(r) >= 2 && c->degree == 6 && !c->missing_at, "%g words: %zu proved, complete to degree %zu", words[i],
                  independent_and_proved(r), c->degree);
        nh_analysis_free(r);
    }
}

/* ---- integrals that are functions of others, and relations ---- */

static bool has_relation(const nh_analysis *r, const char *left, const char *right)
{
    for (size_t k = 0; k < r->relations; k++)
        if (!strcmp(r->relation[k].left, left) && !strcmp(r->relation[k].right, right)) return true;
    return false;
}

/* Two components of Runge and Lenz's vector depend on the third, on energy and momentum: A L = 0 and A^2 = k^2 - 2 E L^2 / m, with Phi1 = -E. */
Test(published, integrals_that_depend_on_others_and_their_relations, PLAIN_ONLY)
{
    nh_analysis *r = analysed("parameters: {m: 1.3, k: 0.8}\ncoordinates: [x, y, z]\nlagrangian: m*(x'^2 + y'^2 + z'^2)/2 + k/sqrt(x^2 + y^2 + z^2)\n", -1);
    const nh_completeness *c = &r->completeness[NH_COMPLETE_IN_COORDINATES];
    cr_assert_eq(r->list->independent, 5);
    cr_assert_eq(r->list->furthers, 2);
    for (size_t k = 0; k < r->list->furthers; k++) cr_expect(r->list->further[k].degree == 2 && r->list->further[k].current.proof.all_parameters);
    cr_expect(c->linear && c->generic && c->degree == 4);
    cr_expect_eq(c->count.row[3].bound, 80, "%zu", c->count.row[3].bound);
    cr_assert_eq(r->relations, 2);
    cr_expect(has_relation(r, "Phi4*Phi7", "Phi3*Phi6 - Phi2*Phi5"));
    cr_expect(has_relation(r, "Phi7^2", "k^2 - Phi5^2 - Phi6^2 - 2*Phi1*Phi2^2/m - 2*Phi1*Phi3^2/m - 2*Phi1*Phi4^2/m"));
    nh_analysis_free(r);
}

/* With time in two currents of Smorodinsky and Winternitz's oscillator the integrals without it, of degrees two and three, are functions of them; the square of the cubic one
 * is a polynomial in the others. */
Test(published, a_cubic_integral_whose_square_is_a_polynomial)
{
    nh_analysis *r = analysed("parameters: {w: 0.8, a: 0.3, b: 0.5}\n" PLANE "w^2*(x^2 + y^2)/2 - a/x^2 - b/y^2\n" QUADRANT, -1);
    const nh_completeness *c = &r->completeness[NH_COMPLETE_IN_COORDINATES];
    cr_assert_eq(r->list->furthers, 3);
    cr_expect_eq(r->list->further[2].degree, 3);
    cr_expect(c->linear && c->degree == 6);
    cr_expect_eq(r->relations, 1);
    cr_expect_str_eq(r->relation[0].left, "Phi7^2");
    nh_analysis_free(r);
}

/* A control: nothing but the energy, and nothing is added. */
Test(published, generic_systems_have_no_further_integrals)
{
    nh_analysis *r = analysed(PLANE "x^4 - x*y^3 - x^2*y\n", -1);
    cr_expect_eq(r->list->count, 1);
    cr_expect_eq(r->list->furthers, 0);
    cr_expect_eq(r->relations, 0);
    cr_expect(r->completeness[NH_COMPLETE_IN_COORDINATES].linear);
    nh_analysis_free(r);
}

/* cos(sqrt(a) t) beside cos(t): no rational multiples of one angle, which residues show by the sign of the root; of a = 4 they are. */
Test(published, frequencies_that_are_roots_are_followed, PLAIN_ONLY)
{
    static const char *const value[] = {"2.3", "4"};
    for (size_t i = 0; i < 2; i++) {
        char text[300];
        snprintf(text, sizeof text, "parameters: {a: %s}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - a*x^2/2 + x*cos(t) - y^4\n", value[i]);
        nh_analysis *r = analysed(text, -1);
        const nh_completeness *c = &r->completeness[NH_COMPLETE_IN_TIME];
        cr_expect(r->list->independent == 3 && c->counted && c->degree >= 4 && !c->missing_at, "a = %s: %zu, complete to degree %zu", value[i], r->list->independent, c->degree);
        nh_analysis_free(r);
    }
}
