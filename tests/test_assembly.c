/* assembly: initial positions that do not satisfy the constraints, as people give them: straight, or with one angle. */
#include <criterion/criterion.h>

#include <math.h>

#include "program.h"
#include "sweep.h"

static const char linkage[] = "parameters: {l1: 0.5, l2: 1.2, l3: 1, d: 1.1}\n"
                              "coordinates: [{name: a, type: angle}, {name: b, type: angle}, {name: c, type: angle}]\n"
                              "definitions: [X = l1*cos(a) + l2/2*cos(b), Y = l1*sin(a) + l2/2*sin(b)]\n"
                              "lagrangian: l1^2/6*a'^2 + (X'^2 + Y'^2)/2 + l2^2/24*b'^2 + l3^2/6*c'^2\n"
                              "constraints: [l1*cos(a) + l2*cos(b) = d + l3*cos(c), l1*sin(a) + l2*sin(b) = l3*sin(c)]\n";

static void first_row(const char *csv, size_t n, double *value)
{
    const char *at = strchr(csv, '\n');
    cr_assert_not_null(at, "%s", csv);
    for (size_t i = 0; i < n; i++) value[i] = strtod(at + 1, (char **)&at);
}

/* Is the loop closed, and is the change across all motions of the closed loop, in the metric at the given position? */
Test(assembly, a_four_bar_linkage_closes_at_the_nearest_position, PLAIN_ONLY)
{
    static const struct {
        const char *initial;
        double from[3];
        bool held, nearest; /* a stays; is every coordinate free? */
    } cases[] = {
        {"a=1", {1, 0, 0}, true, false},
        {"a=1,b=0.1,c=1", {1, 0.1, 1}, false, true},
        {"a=0.4,b=0.6,c=1.2", {0.4, 0.6, 1.2}, false, true},
        {"a=0,b=0,c=0", {0, 0, 0}, false, false}, /* straight: no first derivative helps, and far from closed: near, not nearest */
    };
    place p = place_make();
    write_here(&p, "linkage.yaml", linkage);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double row[4];
        char line[200];
        snprintf(line, sizeof line, "simulate linkage.yaml --until 0.01 --step 0.01 --project --initial %s", cases[i].initial);
        finished f = run_expecting(&p, line, 0);
        cr_expect(strstr(f.err, "--project moves the initial position onto the constraints: ") && !strstr(f.err, "does not satisfy"), "%s", f.err);
        cr_expect_eq(strstr(f.err, "although it was given") != NULL, !cases[i].held, "%s", f.err);
        first_row(f.out, 4, row);
        double a = row[1], b = row[2], c = row[3], x = 0.5 * cos(a) + 1.2 * cos(b) - 1.1 - cos(c), y = 0.5 * sin(a) + 1.2 * sin(b) - sin(c);
        cr_expect(hypot(x, y) < 1e-10, "%s: open by %.2g", cases[i].initial, hypot(x, y));
        cr_expect(!cases[i].held || a == cases[i].from[0], "%s: a = %.17g", cases[i].initial, a);
        /* the motion of the closed loop: across both gradients */
        double J[2][3] = {{-0.5 * sin(a), -1.2 * sin(b), sin(c)}, {0.5 * cos(a), 1.2 * cos(b), -cos(c)}}, n[3], d[3];
        double ab = 0.5 * 0.6 * cos(cases[i].from[0] - cases[i].from[1]), K[3][3] = {{0.25 / 3 + 0.25, ab, 0}, {ab, 1.44 / 3, 0}, {0, 0, 1.0 / 3}}, across = 0, size = 0;
        for (int k = 0; k < 3; k++) n[k] = J[0][(k + 1) % 3] * J[1][(k + 2) % 3] - J[0][(k + 2) % 3] * J[1][(k + 1) % 3], d[k] = row[1 + k] - cases[i].from[k];
        for (int k = 0; k < 3; k++)
            for (int l = 0; l < 3; l++) across += n[k] * K[k][l] * d[l], size += fabs(n[k] * K[k][l] * d[l]);
        cr_expect(!cases[i].nearest || fabs(across) < 1e-6 * size, "%s: %.2g of %.2g is along the loop's own motion", cases[i].initial, across, size);
        finished_clear(&f);
    }
    finished open = run_expecting(&p, "simulate linkage.yaml --initial a=1 --until 0.01 --step 0.01", 0), chosen = run_expecting(&p, "simulate linkage.yaml --until 0.01 --step 0.01", 0);
    cr_expect(strstr(open.err, "--project moves it to the nearest position that does"), "%s", open.err);
    cr_expect(strstr(chosen.err, "--initial \"") && !strstr(chosen.err, "does not satisfy"), "%s", chosen.err);
    finished_clear(&open);
    finished_clear(&chosen);
    place_clear(&p);
}

Test(assembly, a_wheel_comes_to_stand_on_the_ground, PLAIN_ONLY)
{
    place p = place_make();
    double row[4];
    write_here(&p, "wheel.yaml", "parameters: {g: 9.81, r: 0.3}\ngravity: g\nbodies: [{name: wheel, mass: 1, inertia: [0.1, 0.2, 0.1]}]\n"
                                 "joints: [{type: free, child: wheel, coordinates: [x, y, z, yaw, lean, roll], angles: zxy}]\nwheels: [{type: rolling, body: wheel, axle: y, radius: r}]\n");
    finished f = run_expecting(&p, "simulate wheel.yaml --initial roll'=1 --project --until 0.01 --step 0.01", 0), in = run_expecting(&p, "simulate wheel.yaml --initial roll'=1 --until 0.01 --step 0.01", 0);
    first_row(f.out, 4, row);
    cr_expect(fabs(row[3] - 0.3) < 1e-12 && strstr(f.err, "z by 0.3"), "%s%s", f.out, f.err);
    cr_expect(strstr(in.err, "the contact of the wheel `wheel`"), "%s", in.err);
    finished_clear(&f);
    finished_clear(&in);
    place_clear(&p);
}
