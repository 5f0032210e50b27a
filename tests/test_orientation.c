/* Coordinates of type orientation: motions through every orientation against closed forms and against twins with Euler angles, and what analysis
 * prints of them. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdarg.h>

#include "program.h"
#include "sweep.h"

static const char *const top = "name: top\n"
                               "parameters: {A: 1.1, B: 1.1, C: 1.7, m: 1.3, g: 9.81, l: 0.4}\n"
                               "coordinates: [{name: R, type: orientation, velocities: [p, q, r]}]\n"
                               "lagrangian: (A*p^2 + B*q^2 + C*r^2)/2 - m*g*l*R_zz\n";
static const char *const bodies = "name: %s\nparameters: {m: 1.3, a: 1.1, b: 1.4, c: 1.9, l: 0.3}\ngravity: 9.81\n"
                                  "bodies: [{name: body, mass: m, inertia: [a, b, c], center: [0.1, 0, l]}]\n"
                                  "joints: [{type: spherical, child: body, %s}]\n"
                                  "definitions: [%s]\n";

/* Standard output of a command line in the place; it must succeed. */
static char *printed(const place *p, const char *format, ...)
{
    char line[2000], command[4096];
    va_list list;
    va_start(list, format);
    vsnprintf(line, sizeof line, format, list);
    va_end(list);
    snprintf(command, sizeof command, "N='%.400s'; %s", p->program, line);
    finished f = run_vector(p, &(manner){0}, (char *[]){"sh", "-c", command, NULL});
    cr_assert_eq(f.code, 0, "%s: exit code %d\n%s", line, f.code, f.err);
    char *out = f.out;
    free(f.err);
    return out;
}

/* The numbers of the last row of a table. */
static size_t last_row(char *table, double *out, size_t most)
{
    size_t n = 0;
    char *end = table + strlen(table);
    while (end > table && end[-1] == '\n') *--end = 0;
    char *at = strrchr(table, '\n');
    for (at = at ? at + 1 : table; n < most && *at; at += *at == ',') out[n++] = strtod(at, &at);
    free(table);
    return n;
}

Test(orientation, an_upright_top_spins_for_a_thousand_turns, PLAIN_ONLY)
{
    place p = place_make();
    double row[4];
    write_here(&p, "top.yaml", top);
    cr_assert_eq(last_row(printed(&p, "$N simulate top.yaml --initial \"r=2*pi\" --until 1000 --step 500 --tolerance 1e-13 "
                                      "--watch \"R_zz, E, R_xx\" --quiet"), row, 4), 4u);
    double energy = 1.7 / 2 * 4 * M_PI * M_PI + 1.3 * 9.81 * 0.4;
    cr_expect_float_eq(row[1], 1, 1e-12);
    cr_expect_float_eq(row[2], energy, 1e-12 * energy);
    cr_expect_float_eq(row[3], 1, 1e-9, "after whole turns: %.17g", row[3]);
    place_clear(&p);
}

/* The limits of a motion hold for all of its parts together. */
Test(orientation, limits_count_all_parts)
{
    place p = place_make();
    write_here(&p, "top.yaml", top);
    finished f = run_vector(&p, &(manner){0}, (char *[]){p.program, "simulate", "top.yaml", "--initial", "r=5, p=0.1", "--until", "100", "--step", "50", "--option", "steps=300",
                                                         "--method", "rk8pd", NULL});
    cr_expect(f.code == 5 && strstr(f.err, "steps was reached"), "exit code %d\n%s", f.code, f.err);
    finished_clear(&f);
    place_clear(&p);
}

/* Free bodies: energy and the momentum in space, from every special orientation, spinning about each axis. */
Test(orientation, free_bodies_keep_their_momentum_in_space, PLAIN_ONLY)
{
    static const char *const start[] = {"", "R_1=1, ", "R_2=1, ", "R_3=-1, ", "R_1=tan(pi/8), ", "R_1=1/sqrt(3), R_2=1/sqrt(3), R_3=1/sqrt(3), "};
    static const char *const spin[] = {"p=5", "q=5, p=1e-9", "r=5", "p=1, q=2, r=3"};
    static const double speed[][3] = {{5, 0, 0}, {1e-9, 5, 0}, {0, 0, 5}, {1, 2, 3}}, inertia[] = {1, 2, 3};
    place p = place_make();
    write_here(&p, "body.yaml", "name: body\ncoordinates: [{name: R, type: orientation, velocities: [p, q, r]}]\n"
                                "lagrangian: (p^2 + 2*q^2 + 3*r^2)/2\n");
    for (size_t i = 0; i < 24; i++) {
        double row[5], size = 0, square = 0;
        const char *watch = "E, R_xx*p + 2*R_xy*q + 3*R_xz*r, R_yx*p + 2*R_yy*q + 3*R_yz*r, R_zx*p + 2*R_zy*q + 3*R_zz*r";
        last_row(printed(&p, "$N simulate body.yaml --initial \"%s%s\" --until 100 --step 100 --tolerance 1e-13 --watch \"%s\" --quiet", start[i / 4],
                         spin[i % 4], watch), row, 5);
        for (int k = 0; k < 3; k++) {
            double L = inertia[k] * speed[i % 4][k];
            square += L * L;
            size += row[2 + k] * row[2 + k];
        }
        cr_expect_float_eq(sqrt(size), sqrt(square), 1e-10 * sqrt(square), "%s%s: |L| %.17g", start[i / 4], spin[i % 4], sqrt(size));
    }
    place_clear(&p);
}

/* The same body by Euler's angles, where these are regular, and by an orientation. */
Test(orientation, a_twin_with_euler_angles_moves_alike)
{
    place p = place_make();
    char text[1000];
    double a[5], b[5];
    snprintf(text, sizeof text, bodies, "angles", "angles: zyx, coordinates: [u, v, w]",
             "\"zx = -sin(v)\", \"zy = cos(v)*sin(w)\", \"zz = cos(v)*cos(w)\"");
    write_here(&p, "angles.yaml", text);
    snprintf(text, sizeof text, bodies, "turns", "coordinates: [R]", "\"zx = R_zx\", \"zy = R_zy\", \"zz = R_zz\"");
    write_here(&p, "turns.yaml", text);
    /* at zero angles the rates of w, v, u are the angular velocities about x, y, z */
    const char *rest = "--until 0.8 --step 0.8 --tolerance 1e-12 --watch \"zx, zy, zz, E\" --quiet";
    last_row(printed(&p, "$N simulate angles.yaml --initial \"w'=0.7, v'=-0.2, u'=2\" %s", rest), a, 5);
    last_row(printed(&p, "$N simulate turns.yaml --initial \"R_wx=0.7, R_wy=-0.2, R_wz=2\" %s", rest), b, 5);
    for (int i = 1; i < 5; i++) cr_expect_float_eq(a[i], b[i], 1e-9, "column %d: %.17g and %.17g", i, a[i], b[i]);
    place_clear(&p);
}

Test(orientation, every_integrator_passes_full_turns, PLAIN_ONLY)
{
    static const char *const methods[] = {"rk8pd", "rkf45", "msadams", "adams", "bdf", "dormand-prince", "verner", "fehlberg", "esdirk",
                                          "midpoint-4", "dalembert-4", "energy-4", "relaxation-4", "relaxation-8"};
    place p = place_make();
    double row[3], exact[3];
    const char *all = "$N simulate top.yaml --initial \"r=5, p=0.1\" --until 5 --step 5 --option fixed_steps=2000 --watch \"R_zz, R_xz\" --quiet --method %s --tolerance %s";
    write_here(&p, "top.yaml", top);
    last_row(printed(&p, all, "auto", "1e-13"), exact, 3);
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        last_row(printed(&p, all, methods[i], "1e-10"), row, 3);
        for (int k = 1; k < 3; k++)
            cr_expect_float_eq(row[k], exact[k], 2e-6, "%s: %.10g instead of %.10g", methods[i], row[k], exact[k]);
    }
    char *many = printed(&p, "$N simulate top.yaml --initial \"r=5, p=0.1\" --until 5 --step 5 --ensemble 2 --watch \"R_zz, R_xz\" --quiet");
    cr_expect(strstr(many, "\n0,5,"), "%s", many);
    free(many);
    place_clear(&p);
}

/* A ball by angular velocities in space: x' = r w_y; a disk that rolls straight and upright. */
Test(orientation, wheels_and_balls_roll, PLAIN_ONLY)
{
    place p = place_make();
    double row[6];
    write_here(&p, "ball.yaml", "name: ball\nparameters: {r: 0.3}\nbodies: [{name: ball, mass: 2, inertia: 0.1}]\n"
                                "coordinates: [{name: R, type: orientation, frame: space, velocities: [wx, wy, wz]}]\n"
                                "joints: [{type: free, child: ball, at: [0, 0, r], coordinates: [x, y, z, R]}]\n"
                                "wheels: [{type: ball, body: ball, radius: r}]\n");
    last_row(printed(&p, "$N simulate ball.yaml --initial \"wx=1, wy=10, wz=3\" --until 100 --step 100 --watch \"x, y, z, wy, E\" --quiet"), row, 6);
    cr_expect_float_eq(row[1], 300, 1e-7);
    cr_expect_float_eq(row[2], -30, 1e-7);
    cr_expect_float_eq(row[3], 0, 1e-12);
    cr_expect_float_eq(row[4], 10, 1e-9);
    write_here(&p, "disk.yaml", "name: disk\nparameters: {m: 2, r: 0.3}\ngravity: 9.81\n"
                                "bodies: [{name: disk, mass: m, inertia: [m*r^2/4, m*r^2/2, m*r^2/4]}]\n"
                                "joints: [{type: free, child: disk, coordinates: [x, y, z, R]}]\n"
                                "wheels: [{type: rolling, body: disk, axle: y, radius: r}]\n");
    last_row(printed(&p, "$N simulate disk.yaml --initial \"z=r, R_wy=10\" --until 100 --step 100 --watch \"x, y, z, R_wy, R_yz\" --quiet"), row, 6);
    cr_expect_float_eq(row[1], 300, 1e-8);
    cr_expect_float_eq(row[2], 0, 1e-10);
    cr_expect_float_eq(row[3], 0.3, 1e-10);
    cr_expect_float_eq(row[5], 0, 1e-10);
    place_clear(&p);
}

/* Two frames, one motion; a torque along an angular velocity has the power torque times angular velocity. */
Test(orientation, frames_and_torques)
{
    place p = place_make();
    double a[5], b[5];
    write_here(&p, "a.yaml", "name: a\nparameters: {c: 0.3}\ncoordinates: [{name: R, type: orientation, velocities: [p, q, r]}]\n"
                             "lagrangian: (p^2 + 2*q^2 + 3*r^2)/2 - R_zz - 0.3*R_xy\nforces: [\"p = -c*p\", \"q = -c*q\", \"r = -c*r\"]\n");
    write_here(&p, "b.yaml", "name: b\nparameters: {c: 0.3}\n"
                             "coordinates: [{name: R, type: orientation, frame: space, velocities: [u, v, w]}]\n"
                             "definitions: [p = R_xx*u + R_yx*v + R_zx*w, q = R_xy*u + R_yy*v + R_zy*w, r = R_xz*u + R_yz*v + R_zz*w]\n"
                             "lagrangian: (p^2 + 2*q^2 + 3*r^2)/2 - R_zz - 0.3*R_xy\nforces: [\"u = -c*u\", \"v = -c*v\", \"w = -c*w\"]\n");
    const char *rest = "--until 6 --step 6 --tolerance 1e-12 --watch \"R_zz, R_xy, E, p + q + r\" --quiet";
    last_row(printed(&p, "$N simulate a.yaml --initial \"p=1, q=-2, r=0.5\" %s", rest), a, 5);
    last_row(printed(&p, "$N simulate b.yaml --initial \"u=1, v=-2, w=0.5\" %s", rest), b, 5);
    for (int i = 1; i < 5; i++) cr_expect_float_eq(a[i], b[i], 1e-9, "column %d: %.17g and %.17g", i, a[i], b[i]);
    place_clear(&p);
}

Test(orientation, analysis_is_written_in_matrix_entries, PLAIN_ONLY)
{
    static const char *const wanted[] = {"FOUND: 3 independent currents", "Complete to degree 4", "m*g*l*R_zz", "R_zx", "r' = 0"};
    place p = place_make();
    write_here(&p, "top.yaml", "name: top\nparameters: {A: 1.1, C: 1.7, m: 1.3, g: 9.81, l: 0.4}\n"
                               "coordinates: [{name: R, type: orientation, velocities: [p, q, r]}]\n"
                               "lagrangian: (A*(p^2 + q^2) + C*r^2)/2 - m*g*l*R_zz\n");
    char *text = printed(&p, "$N analyze -v top.yaml");
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) cr_expect(strstr(text, wanted[i]), "no `%s` in\n%s", wanted[i], text);
    free(text);
    text = printed(&p, "$N verify top.yaml --current \"A*(R_zx*p + R_zy*q) + C*R_zz*r\"");
    cr_expect(strstr(text, "Yes"), "%s", text);
    free(text);
    text = printed(&p, "$N reduce -v top.yaml");
    cr_expect(strstr(text, "SO(2)^2") && !strstr(text, "differs by"), "%s", text);
    free(text);
    place_clear(&p);
}

static void refused(const place *p, const char *coordinate, const char *words)
{
    char text[500];
    snprintf(text, sizeof text, "name: s\ncoordinates: [%s]\nlagrangian: 1\n", coordinate);
    write_here(p, "s.yaml", text);
    finished f = run_vector(p, &(manner){0}, (char *[]){(char *)p->program, "analyze", "s.yaml", NULL});
    cr_expect_eq(f.code, 3, "%s: exit code %d", coordinate, f.code);
    cr_expect(strstr(f.err, words), "%s: no `%s` in\n%s", coordinate, words, f.err);
    finished_clear(&f);
}

Test(orientation, messages)
{
    place p = place_make();
    refused(&p, "{name: R, type: orientation, frame: bodies}", "expected body or space");
    refused(&p, "{name: R, type: orientation, velocities: [a, b]}", "three angular velocities, not 2");
    refused(&p, "{name: R, type: orientation, velocities: [a, a, b]}", "declared twice");
    refused(&p, "{name: R, type: orientation, unit: m}", "unit");
    refused(&p, "{name: R, type: orientaton}", "did you mean `orientation`?");
    place_clear(&p);
}
