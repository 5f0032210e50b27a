/* Lists on the command line: every option that takes one takes it in one syntax, in one piece or in several. */
#include <stdio.h>
#include <string.h>

#include "program.h"
#include "sweep.h"

/* Words of a line, in which '...' and "..." are one word. */
static finished run_line(place *p, const char *line)
{
    char copy[1000], *argument[most_words] = {p->program};
    size_t n = 1;
    snprintf(copy, sizeof copy, "%s", line);
    for (char *at = copy; *at && n < most_words - 1;) {
        at += strspn(at, " ");
        bool quoted = *at == '\'' || *at == '"';
        const char end[] = {quoted ? *at : ' ', 0};
        argument[n++] = at += quoted;
        at += strcspn(at, end);
        if (*at) *at++ = 0;
    }
    argument[n] = NULL;
    return run_vector(p, &(manner){0}, argument);
}

/* The same standard output and exit code? */
static void alike(place *p, const char *a, const char *b)
{
    finished one = run_line(p, a), two = run_line(p, b);
    cr_expect_eq(one.code, two.code, "%s: %d %s\n%s: %d %s", a, one.code, one.err, b, two.code, two.err);
    cr_expect_str_eq(one.out, two.out, "%s\n%s", a, b);
    cr_expect(one.code == 0 && strlen(one.out) > 20, "%s: %s%s", a, one.out, one.err);
    finished_clear(&one);
    finished_clear(&two);
}

Test(lists, in_one_piece_or_in_several, PLAIN_ONLY)
{
    static const char *const pairs[][2] = {
        {"simulate sleigh --initial omega=2 --until 1 --step 0.5 --set m=3 --set k=3", "simulate sleigh --initial omega=2 --until 1 --step 0.5 --set 'm = 3; k=3'"},
        {"simulate sleigh --initial omega=2,v=1 --until 1 --step 0.5", "simulate sleigh --initial omega=2 --initial ' v = 1 ' --until 1 --step 0.5"},
        {"simulate sleigh --initial omega=2 --until 1 --watch 'omega, T=m/2*v^2'", "simulate sleigh --initial omega=2 --until 1 --watch omega --watch 'T=m/2*v^2'"},
        {"simulate sleigh --initial omega=2 --until 1 --over 'k=1,2,5/2' --over m=1:2:3", "simulate sleigh --initial omega=2 --until 1 --over 'k=1; 2, 5/2, m=1:2:3'"},
        {"simulate sleigh --initial omega=2 --until 1 --option absolute=1e-9 --option tolerance=1e-7", "simulate sleigh --initial omega=2 --until 1 --option 'absolute=1e-9, tolerance=1e-7'"},
        {"verify sleigh --field 'Z0=1, x=0'", "verify sleigh --field Z0=1 --field x=0"},
        {"export sleigh --to c --of equations,momenta", "export sleigh --to c --of momenta --of 'equations;'"},
        {"export driven.yaml --to c --of equations --input thrust,torque", "export driven.yaml --to c --of equations --input thrust --input torque"},
        {"simulate driven.yaml --initial phi=0 --until 1 --input 'thrust=atan2(t,1), torque=t'", "simulate driven.yaml --initial phi=0 --until 1 --input thrust=atan2(t,1) --input torque=t"},
    };
    place p = place_with_systems();
    write_here(&p, "driven.yaml",
               "name: driven\nparameters: [{name: m, value: 2}, {name: thrust, value: 0}, {name: torque, value: 0}]\n"
               "coordinates: [{name: phi, type: angle}, {name: x, type: length}]\nlagrangian: m/2*(x'^2 + phi'^2)\nforces: [\"phi = torque\", \"x = thrust*cos(phi)\"]\n");
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) alike(&p, pairs[i][0], pairs[i][1]);
    place_clear(&p);
}

Test(lists, what_is_missing_is_told)
{
    static const char *const lines[] = {"analyze sleigh --set m=2,,k=3", "analyze sleigh --set ,m=2", "analyze sleigh --set ''", "analyze sleigh --option ' ; '", "scan sleigh --over ,k=1:2:3 -o x"};
    place p = place_with_systems();
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        finished f = run_line(&p, lines[i]);
        cr_expect_eq(f.code, 2, "%s: %d", lines[i], f.code);
        cr_expect_not_null(strstr(f.err, ": nothing stands "), "%s: %s", lines[i], f.err);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* What was typed is shown with a caret, as an error of the command line, whichever option it stands behind. */
Test(lists, an_expression_is_shown_as_it_was_typed, PLAIN_ONLY)
{
    static const struct { const char *line, *shown; } wrong[] = {
        {"analyze lagrange_top --on 'p_p=0, p_ss = 0'", "--on:1: unknown name `p_ss`\n  p_ss = 0\n  ^\nhint: did you mean `p_s`?"},
        {"analyze lagrange_top --on 'p_s = 2*sin('", "--on:13: the expression ends here, but a number, a name or `(` was expected\n  p_s = 2*sin(\n              ^"},
        {"analyze lagrange_top --on s=0", "--on:1: this level contains no velocity\n  s=0\n  ^"},
        {"analyze lagrange_top --on \"h'=1\"", "--on:1: motions leave this level: it is not one of an integral\n  h'=1\n  ^"},
        {"verify sleigh --field 'Z0=1; ph=2'", "--field:7: `ph` is neither Z0 nor a coordinate nor a velocity of the chart\n  Z0=1; ph=2\n        ^"},
        {"verify sleigh --field 'Z0=1; phi=2*sin(ph)'", "--field:17: unknown name `ph`\n  Z0=1; phi=2*sin(ph)\n                  ^"},
        {"verify sleigh --current 'm*v +* 2'", "--current:6: `*` cannot stand here"},
        {"simulate sleigh --watch 'T = v^2, \xcf\x89 = m*vv'", "--watch:16: unknown name `vv`\n  T = v^2, \xcf\x89 = m*vv\n                 ^"},
        {"reduce vertical_disk --group 'x=1; y=2*zz'", "--group:10: unknown name `zz`\n  x=1; y=2*zz\n           ^"},
        {"reduce vertical_disk --group 'x=1; yy=1'", "--group:6: `yy` is not a coordinate\n  x=1; yy=1\n       ^\nhint: did you mean `y`?"},
        {"reduce vertical_disk --group '1, 22'", "--group:4: there is no generator 22; the group has 4"},
        {"reduce vertical_disk --inner '1,1=1; 2,2=q+'", "--inner:12: unknown name `q`\n  1,1=1; 2,2=q+\n             ^"},
        {"simulate sleigh --initial 'phi=0, omga=2'", "--initial:8: `omga` is not a coordinate or velocity of sleigh"},
        {"simulate sleigh --input 'k=1+sin(tt)'", "--input k:7: unknown name `tt`\n  1+sin(tt)\n        ^"},
    };
    place p = place_with_systems();
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        finished f = run_line(&p, wrong[i].line);
        cr_expect(f.code == 2 && strstr(f.err, wrong[i].shown), "%s: code %d, %s", wrong[i].line, f.code, f.err);
        finished_clear(&f);
    }
    place_clear(&p);
}
