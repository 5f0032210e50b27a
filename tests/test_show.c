/* show --equations: the geometry of a system without a question about a current; and the names that --current and
 * --field know: E, Lbar, the currents, Gamma, Z(..).
 *
 * The sleigh's formulas are those of [CechMusilova2014, sec. 4]; with v along the blade, Lbar = m/2 (v^2 + a^2 k^2 omega^2),
 * omega' = -omega v/(a k^2), v' = a omega^2, by hand. */
#include <cjson/cJSON.h>

#include "program.h"

static void check_contains(const char *text, const char *part)
{
    cr_expect_not_null(strstr(text, part), "no %s in\n%s", part, text);
}

static finished ask(const place *p, const char *words, int code)
{
    finished f = run(p, words);
    cr_assert_eq(f.code, code, "%s: %d %s", words, f.code, f.err);
    return f;
}

static void shows(const place *p, const char *words, const char *const *line)
{
    finished f = ask(p, words, 0);
    for (; *line; line++) check_contains(f.out, *line);
    finished_clear(&f);
}

static size_t lines_of(const char *text)
{
    size_t n = 0;
    for (; *text; text++) n += *text == '\n';
    return n;
}

Test(show, the_geometry_of_the_sleigh_stands_on_one_screen)
{
    place p = place_with_systems();
    shows(&p, "show sleigh --equations",
          (const char *const[]){"\n3 coordinates: phi, x, y. 1 constraint. 2 independent velocities: omega, v.\n", "\n  y' = x'*tan(phi)\n",
                                "\n  x' = v*cos(phi)\n", "\n  Lbar = E = m*(a^2*k^2*omega^2 + v^2)/2\n",
                                "\n  X_0 = d/dt + omega d/dphi + v*cos(phi) d/dx + v*sin(phi) d/dy\n", "\n  X_omega = d/dphi\n",
                                "\n  [X_omega,X_v] = -sin(phi) d/dx + cos(phi) d/dy\n", "\n  Abar_omega = -m*a*omega*v\n",
                                "\n  M_omega,omega = m*a^2*k^2\n", "\n  omega' = -omega*v/(a*k^2)\n", "\n  v' = a*omega^2\n",
                                "\nMore: --details", NULL});
    place_clear(&p);
}

Test(show, no_first_screen_is_longer_than_40_lines)
{
    static const char *const systems[] = {"sleigh", "crane", "constant_speed", "kepler", "snakeboard", "whipple_bicycle"};
    place p = place_with_systems();
    for (size_t i = 0; i < sizeof systems / sizeof *systems; i++) {
        char words[80];
        snprintf(words, sizeof words, "show %s --equations", systems[i]);
        finished f = ask(&p, words, 0);
        cr_expect_leq(lines_of(f.out), 40, "%s: %zu lines", systems[i], lines_of(f.out));
        cr_expect_geq(lines_of(f.out), 10, "%s", systems[i]);
        finished_clear(&f);
    }
    place_clear(&p);
}

Test(show, details_have_the_equations_of_the_paper_with_their_numbers)
{
    place p = place_with_systems();
    shows(&p, "show sleigh --equations --details",
          (const char *const[]){"phi^1 = -tan(phi) dx + dy", "Reduced equations (9)", "Constraint semispray (21)", "(16, x)",
                                "  Y_omega = d/domega\n", "F_x^Euler = m*a*sin(phi) phi''", NULL});
    place_clear(&p);
}

Test(show, what_needs_equations_is_refused_without_them)
{
    place p = place_with_systems();
    finished f = ask(&p, "show sleigh --html a.html", 2);
    check_contains(f.err, "takes --html only with --equations");
    finished g = ask(&p, "show sleigh --equations --of parameters", 2);
    check_contains(g.err, "--equations, and --of as well");
    finished_clear(&f);
    finished_clear(&g);
    place_clear(&p);
}

/* [d/dx + ..., d/dy + ...] of z' = y x': the Heisenberg algebra. */
Test(show, brackets_of_fields_are_those_of_the_heisenberg_algebra)
{
    place p = place_make();
    write_here(&p, "h.yaml", "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\nconstraints: [z' = y*x']\n");
    shows(&p, "show h.yaml --equations",
          (const char *const[]){"d_c/dx = d/dx + y d/dz", "[d_c/dx,d_c/dy] = -d/dz", "Chetaev multipliers", NULL});
    place_clear(&p);
}

/* ---- names ---- */

Test(show, the_field_along_motions_over_the_lagrangian_is_a_constraint_symmetry)
{
    place p = place_with_systems();
    shows(&p, "verify sleigh --field Gamma/Lbar",
          (const char *const[]){"Yes: this is a constraint symmetry, proved for all parameter values; it is\n  trivial", "\n  Phi = 1\n", NULL});
    finished f = ask(&p, "verify sleigh --field Gamma", 1); /* its current 2 Lbar - Lbar is E, whose field is -d/dt */
    check_contains(f.out, "No: this is not a constraint symmetry.");
    finished_clear(&f);
    place_clear(&p);
}

/* Z is linear in the current, and Z(1) = Gamma/Lbar: Z(Phi Psi) = Phi Z(Psi) + Psi Z(Phi) - Phi Psi Gamma/Lbar. */
Test(show, the_field_of_a_product_follows_from_those_of_its_factors)
{
    place p = place_with_systems();
    const char *const current[] = {"\n  Phi = m^2*(a^2*k^2*omega^2 + v^2)*(a*k*omega*cos(phi/k) + v*sin(phi/k))/2\n", NULL};
    shows(&p, "verify sleigh --field Z(E*Phi_2)", current);
    shows(&p, "verify sleigh --field E*Z(Phi_2)+Phi_2*Z(E)-E*Phi_2*Gamma/Lbar", current);
    place_clear(&p);
}

Test(show, currents_have_the_names_of_the_file_or_of_analyze)
{
    place p = place_with_systems();
    const char *const yes[] = {"Yes. This is conserved", "\n  Phi = ", NULL};
    shows(&p, "verify sleigh --current Phi_3", yes);             /* of the file */
    shows(&p, "verify sleigh --current Phi_1*Phi_2+E", yes); /* Phi_1: of analyze */
    shows(&p, "verify kepler --current Phi_1", yes);
    shows(&p, "verify sleigh --current -E", (const char *const[]){"\n  Phi = -m*(a^2*k^2*omega^2 + v^2)/2\n", NULL});
    finished g = ask(&p, "verify sleigh --current 2*pi", 0);
    cr_expect_null(strstr(g.out, "Phi = "), "what was typed is not repeated: %s", g.out);
    finished_clear(&g);
    finished f = ask(&p, "verify sleigh --current Phi_77", 2);
    check_contains(f.err, "`analyze` finds no current `Phi_77`");
    finished_clear(&f);
    place_clear(&p);
}

/* z'^2 = k^2 (x'^2 + y'^2): the chart has a root for z', the answers hold on both of its branches. */
Test(show, named_quantities_hold_on_both_branches)
{
    place p = place_with_systems();
    shows(&p, "verify appell_hamel --current E", (const char *const[]){"proved for all m, g, k, on both branches", "z'^2", NULL});
    shows(&p, "verify appell_hamel --field Z(E)", (const char *const[]){"Yes: this is a constraint symmetry", NULL});
    shows(&p, "verify appell_hamel --current Phi_1", (const char *const[]){"on both branches", NULL});
    place_clear(&p);
}

Test(show, a_name_of_the_system_keeps_its_meaning)
{
    place p = place_make();
    write_here(&p, "e.yaml", "coordinates: [x]\nparameters: {E: 3}\nlagrangian: x'^2/2\n");
    shows(&p, "verify e.yaml --current E --details", (const char *const[]){"Yes", "\n  Phi = E\n", "it is trivial", NULL});
    place_clear(&p);
}

Test(show, what_is_no_sum_of_fields_is_refused_as_it_was_typed)
{
    place p = place_with_systems();
    finished f = ask(&p, "verify sleigh --field Gamma^2", 2), g = ask(&p, "verify sleigh --field Z(Phi_2)+nothing", 2);
    finished h = ask(&p, "verify sleigh --field Z(Phi_2", 2), i = ask(&p, "verify sleigh --field Z(Z(E))", 2);
    check_contains(f.err, "`Gamma^2` is no sum of functions times Gamma or Z(..)");
    check_contains(g.err, "unknown name `nothing`");
    check_contains(g.err, "  Z(Phi_2)+nothing\n");
    check_contains(h.err, "a bracket is not closed");
    finished_clear(&f);
    finished_clear(&g);
    finished_clear(&h);
    finished_clear(&i);
    place_clear(&p);
}
