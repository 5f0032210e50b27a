/* urdf: robot descriptions.  Three robots of tests/data/urdf are computed a second time by tests/robots.h: energies, equations of motion and
 * the velocities of the points of contact.  The messages for wrong files stand in tests/bad/urdf.txt. */
#include <criterion/criterion.h>

#include <nhsym.h>

#include "base/text.h"
#include "program.h"
#include "robots.h"
#include "sweep.h"

typedef struct {
    const char *name, *initial;
    size_t wheels;
    struct { const char *link; double radius; } wheel[5];
    double height, until;
} rolling_robot;

static const rolling_robot robots[] = {
    {"arm_robot", "left'=2, right'=1.5, turret'=0.3, elbow=0.4", 2, {{"left-wheel", 0.1}, {"right-wheel", 0.1}}, 0, 1000},
    {"car_trailer", "steer=0.2, steer'=0.1, rl'=10", 5, {{"rear_left", 0.3}, {"rear_right", 0.3}, {"front", 0.3}, {"trailer_left", 0.25}, {"trailer_right", 0.25}}, 0, 1000},
    {"snake", "bend1=0.2, bend1'=0.3, bend2=-0.1, a1'=10", 3, {{"w1", 0.03}, {"w2", 0.03}, {"w3", 0.03}}, 0.03, 1000},
};
enum { robot_count = sizeof robots / sizeof *robots };

typedef struct {
    nh_context *context;
    nh_problem *problem;
    nh_simulation *motion;
    robot r;
    size_t rows;
} rolling;

static void begin(rolling *x, const rolling_robot *given, double until, double step)
{
    char path[200], file[200];
    nh_error error = {NH_OK, "", "", "", ""};
    snprintf(path, sizeof path, "tests/data/urdf/%s.yaml", given->name);
    snprintf(file, sizeof file, "tests/data/urdf/%s.urdf", given->name);
    nh_question q = {.system = path, .initial = given->initial, .until = until, .step = step};
    x->context = nh_context_create();
    x->problem = nh_problem_open(x->context, &q, &error);
    cr_assert_not_null(x->problem, "%s: %s", error.where, error.what);
    x->motion = nh_simulate(x->problem, &error);
    cr_assert_not_null(x->motion, "%s: %s", given->name, error.what);
    x->rows = nh_simulation_rows(x->motion);
    robot_read(&x->r, file);
    x->r.height = given->height;
    x->r.coordinates = nh_problem_coordinates(x->problem);
    for (size_t j = 0; j < MOST_LINKS; j++) x->r.of_joint[j] = -1;
    for (size_t i = 0; i < x->r.coordinates; i++) {
        static const char *const base[] = {"x", "y", "heading"};
        const char *name = nh_problem_coordinate(x->problem, i);
        int joint = robot_index(&x->r, name, true);
        if (joint >= 0) x->r.of_joint[joint] = (int)i;
        for (int k = 0; k < 3; k++)
            if (!strcmp(name, base[k])) x->r.base[k] = (int)i;
    }
}

static void end(rolling *x)
{
    nh_simulation_free(x->motion);
    nh_problem_free(x->problem);
    nh_context_free(x->context);
}

static void state(const rolling *x, size_t row, double *q, double *v)
{
    size_t n = x->r.coordinates;
    for (size_t i = 0; i < n; i++) {
        q[i] = nh_simulation_value(x->motion, row, 1 + i);
        v[i] = nh_simulation_value(x->motion, row, 1 + n + i);
    }
}

/* The velocity of the point of contact of a wheel, in space: that of its centre and -r (omega x n), in the plane of the wheel when it stands upright. */
static void contact(const rolling *x, const rolling_robot *given, size_t wheel, const double *q, const double *v, double out[3])
{
    static const double origin[3] = {0};
    double w[3], r = given->wheel[wheel].radius;
    int link = robot_index(&x->r, given->wheel[wheel].link, false);
    cr_assert_geq(link, 0);
    robot_velocity(&x->r, q, v, link, origin, out, w);
    out[0] -= w[1] * r;
    out[1] += w[0] * r;
}

static double largest(const double *v, size_t n)
{
    double most = 0;
    for (size_t i = 0; i < n; i++) most = fmax(most, fabs(v[i]));
    return most;
}

Test(urdf, wheels_roll_over_a_thousand_units_of_time, PLAIN_ONLY)
{
    for (size_t i = 0; i < robot_count; i++) {
        if (!sweep_tries(i + 1, 3, 3)) continue;
        rolling x;
        double q[MOST_COORDINATES], v[MOST_COORDINATES], slip[3], worst = 0, speed = 0;
        begin(&x, &robots[i], robots[i].until, robots[i].until / 200);
        cr_assert_eq(x.rows, 201u, "%s: %zu rows", robots[i].name, x.rows);
        for (size_t row = 0; row < x.rows; row++) {
            state(&x, row, q, v);
            for (size_t w = 0; w < robots[i].wheels; w++) {
                contact(&x, &robots[i], w, q, v, slip);
                worst = fmax(worst, largest(slip, 3));
                speed = fmax(speed, fabs(v[x.r.base[0]]));
            }
        }
        cr_expect_gt(speed, 0.01, "%s hardly moves", robots[i].name);
        cr_expect_lt(worst, 1e-12, "%s: a point of contact moves at %.2e, the robot at %.2g", robots[i].name, worst, speed);
        end(&x);
    }
}

/* Directions of motion that the wheels allow: a basis of the null space of the contacts' velocities, by elimination with pivots. */
static size_t allowed(const rolling *x, const rolling_robot *given, const double *q, double basis[MOST_COORDINATES][MOST_COORDINATES])
{
    static double A[3 * 5][MOST_COORDINATES];
    size_t n = x->r.coordinates, rows = 2 * given->wheels, rank = 0, pivot[MOST_COORDINATES], free_ones = 0;
    bool dependent[MOST_COORDINATES] = {false};
    for (size_t c = 0; c < n; c++)
        for (size_t w = 0; w < given->wheels; w++) {
            double e[MOST_COORDINATES] = {0}, slip[3];
            e[c] = 1;
            contact(x, given, w, q, e, slip);
            A[2 * w][c] = slip[0];
            A[2 * w + 1][c] = slip[1];
        }
    while (rank < rows) {
        size_t br = 0, bc = 0;
        double best = 1e-9;
        for (size_t r = rank; r < rows; r++)
            for (size_t c = 0; c < n; c++)
                if (fabs(A[r][c]) > best) best = fabs(A[r][c]), br = r, bc = c;
        if (best <= 1e-9) break;
        for (size_t c = 0; c < n; c++) {
            double swap = A[rank][c];
            A[rank][c] = A[br][c];
            A[br][c] = swap;
        }
        for (size_t r = 0; r < rows; r++) {
            double f = r == rank ? 0 : A[r][bc] / A[rank][bc];
            for (size_t c = 0; c < n && f != 0; c++) A[r][c] -= f * A[rank][c];
        }
        dependent[bc] = true;
        pivot[rank++] = bc;
    }
    for (size_t c = 0; c < n; c++) {
        if (dependent[c]) continue;
        memset(basis[free_ones], 0, sizeof basis[0]);
        basis[free_ones][c] = 1;
        for (size_t r = 0; r < rank; r++) basis[free_ones][pivot[r]] = -A[r][c] / A[r][pivot[r]];
        free_ones++;
    }
    return free_ones;
}

Test(urdf, energies_and_equations_are_those_of_an_independent_computation, PLAIN_ONLY)
{
    static const size_t freedom[robot_count] = {4, 2, 2};
    for (size_t i = 0; i < robot_count; i++) {
        rolling x;
        double q[MOST_COORDINATES], v[MOST_COORDINATES], a[MOST_COORDINATES], rest[MOST_COORDINATES], basis[MOST_COORDINATES][MOST_COORDINATES];
        nh_error error = {NH_OK, "", "", "", ""};
        begin(&x, &robots[i], 2, 0.2);
        nh_rates *rates = nh_rates_create(x.problem, &error);
        cr_assert_not_null(rates, "%s", error.what);
        size_t energy = nh_simulation_columns(x.motion) - 1;
        cr_assert_str_eq(nh_simulation_column(x.motion, energy), "E");
        for (size_t row = 0; row < x.rows; row++) {
            state(&x, row, q, v);
            double E = nh_simulation_value(x.motion, row, energy), own = robot_energy(&x.r, q, v);
            cr_expect_float_eq(E, own, 1e-11 * (1 + fabs(own)), "%s, row %zu: E = %.17g, not %.17g", robots[i].name, row, E, own);
            double t = nh_simulation_value(x.motion, row, 0);
            nh_rates_at(rates, 1, &t, q, v, a);
            robot_residual(&x.r, q, v, a, rest);
            size_t ways = allowed(&x, &robots[i], q, basis);
            cr_expect_eq(ways, freedom[i], "%s: %zu degrees of freedom", robots[i].name, ways);
            for (size_t k = 0; k < ways; k++) {
                double power = 0, size = 0;
                for (size_t c = 0; c < x.r.coordinates; c++) power += basis[k][c] * rest[c], size += fabs(basis[k][c] * rest[c]);
                cr_expect_leq(fabs(power), 1e-8 * (1 + size), "%s, row %zu: d'Alembert's principle is violated by %.2e of %.2e", robots[i].name, row, power, size);
            }
        }
        nh_rates_free(rates);
        end(&x);
    }
}


/* ---- the command line ---- */

static const char cart[] = "<robot name=\"cart-1\">\n"
                           "  <link name=\"body\"><inertial><mass value=\"3\"/><inertia ixx=\"0.1\" iyy=\"0.1\" izz=\"0.2\"/></inertial></link>\n"
                           "  <link name=\"l.wheel\"><collision><origin rpy=\"1.57 0 0\"/><geometry><cylinder radius=\"0.1\" length=\"0.02\"/></geometry></collision></link>\n"
                           "  <link name=\"r.wheel\"><inertial><mass value=\"1\"/><inertia ixx=\"0.1\" iyy=\"0.1\" izz=\"0.1\"/></inertial></link>\n"
                           "  <joint name=\"l\" type=\"continuous\"><origin xyz=\"0 0.3 -0.05\"/><parent link=\"body\"/><child link=\"l.wheel\"/><axis xyz=\"0 1 0\"/></joint>\n"
                           "  <joint name=\"r\" type=\"continuous\"><origin xyz=\"0 -0.3 -0.05\"/><parent link=\"body\"/><child link=\"r.wheel\"/><axis xyz=\"0 1 0\"/></joint>\n"
                           "  <strange/>\n"
                           "</robot>\n";

static const char massive[] = "<robot name=\"cart-1\">\n"
                              "  <link name=\"body\"><inertial><mass value=\"3\"/><inertia ixx=\"0.1\" iyy=\"0.1\" izz=\"0.2\"/></inertial></link>\n"
                              "  <link name=\"arm\"><inertial><mass value=\"1\"/><inertia ixx=\"0.1\" iyy=\"0.1\" izz=\"0.1\"/></inertial></link>\n"
                              "  <joint name=\"l\" type=\"continuous\"><parent link=\"body\"/><child link=\"arm\"/><axis xyz=\"0 1 0\"/></joint>\n"
                              "</robot>\n";

Test(urdf, wheels_and_base_are_named_on_the_command_line_or_in_a_file_beside_it, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "cart.urdf", cart);
    write_here(&p, "cart.yaml", "urdf: cart.urdf\nwheels: [l.wheel, {body: r_wheel, radius: 0.1}]\n");
    finished line = run_expecting(&p, "analyze -v cart.urdf --wheel l.wheel --wheel r.wheel=0.1", 0);
    finished file = run_expecting(&p, "analyze -v cart.yaml", 0);
    cr_expect_not_null(strstr(line.out, "5 coordinates, 3 linear constraints"), "%s", line.out);
    cr_expect_not_null(strstr(line.out, "FOUND: 7 independent currents of at most 7"), "%s", line.out);
    cr_expect_eq(strncmp(line.out, file.out, (size_t)(strstr(line.out, "How it was found") - line.out)), 0, "other currents");
    finished_clear(&line);
    finished_clear(&file);
    finished standing = run_expecting(&p, "show cart.urdf --wheel l.wheel,r.wheel=1/10", 0);
    cr_expect_not_null(strstr(standing.out, "{name: base, type: planar, child: body, at: [0, 0, 0.15], coordinates: [x, y, heading]}"), "%s", standing.out);
    cr_expect_not_null(strstr(standing.out, "cart.urdf:7: passed over: <strange>"), "%s", standing.out);
    write_here(&p, "copy.yaml", standing.out); /* what is shown is a system file */
    finished copy = run_expecting(&p, "simulate copy.yaml --initial l'=1,r'=2 --until 1", 0), own = run_expecting(&p, "simulate cart.yaml --initial l'=1,r'=2 --until 1", 0);
    cr_expect_str_eq(copy.out, own.out);
    cr_expect_not_null(strstr(own.err, "<strange>"), "notes are said: %s", own.err);
    finished_clear(&standing);
    finished_clear(&copy);
    finished_clear(&own);
    write_here(&p, "cart.urdf", massive);
    finished flying = run_expecting(&p, "reduce -v cart.urdf --base floating", 0), resting = run_expecting(&p, "export cart.urdf --to c --of equations", 0);
    cr_expect_not_null(strstr(flying.out, "7 coordinates"), "%s", flying.out);
    cr_expect_not_null(strstr(resting.out, "cart_1_accelerations"), "%s", resting.out);
    finished_clear(&flying);
    finished_clear(&resting);
    place_clear(&p);
}

Test(urdf, a_wheel_that_cannot_be_is_refused_at_its_place)
{
    static const struct { const char *line, *what, *hint; } wrong[] = {
        {"--wheel l.weel", "--wheel:1: there is no body `l.weel`\n  l.weel\n  ^\n", "did you mean `l_wheel`?"},
        {"--wheel r", "--wheel:1: there is no body `r`", "hint: the joint `r` turns the body `r_wheel`: name the body"},
        {"--wheel body", "--wheel:1: `body` cannot be a wheel: no joint turns it about an axis", "{type: ball, body: body, radius: ..}"},
        {"--wheel r.wheel", "the wheel `r_wheel` needs a radius: it has no cylinder or sphere", "--wheel r_wheel=0.1"},
        {"--wheel l.wheel=-1", "--wheel:9: a radius cannot be negative, but it is -1 here\n  l.wheel=-1\n          ^", NULL},
        {"--wheel l.wheel,r.wheel=1/xx", "--wheel:11: unknown name `xx`\n  r.wheel=1/xx\n            ^", NULL},
        {"--wheel l.wheel --base plannar", "--base:1: `plannar` is not a kind of base", "did you mean `planar`?"},
    };
    place p = place_make();
    write_here(&p, "cart.urdf", cart);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char line[200];
        snprintf(line, sizeof line, "analyze cart.urdf %s", wrong[i].line);
        finished f = run_expecting(&p, line, 2);
        cr_expect_not_null(strstr(f.err, wrong[i].what), "%s", f.err);
        cr_expect(!wrong[i].hint || strstr(f.err, wrong[i].hint), "%s", f.err);
        finished_clear(&f);
    }
    place_clear(&p);
}

static char *text_at(const char *path)
{
    FILE *file = fopen(path, "r");
    if (!file) return NULL;
    char *text = read_stream(file);
    fclose(file);
    return text;
}

/* Robots that others described, as Debian's package dart-doc ships them: an arm of KUKA in the commands, and one of Barrett with the lower half of its inertias. */
Test(urdf, robots_of_others)
{
    static const struct { const char *line; int code; } runs[] = {{"show kr5.urdf", 0}, {"analyze kr5.urdf --columns 1 --degree 1 --json kr5.json", 0}, {"verify kr5.urdf --current elbow_roll'", 1},
        {"verify kr5.urdf --field shoulder_yaw=1", 1}, {"simulate kr5.urdf --until 0.5 --step 0.25 --svg kr5.svg", 0}, {"reduce kr5.urdf", 0}, {"benchmark kr5.urdf --until 0.2 --budget 200ms", 0},
        {"export kr5.urdf --to c --of equations -o code", 0}, {"export kr5.urdf --to latex --of momenta -o code", 0}, {"show wam.urdf", 0}, {"simulate wam.urdf --until 0.5 --step 0.25", 0}};
    place p = place_make();
    char *kr5 = text_at("/usr/share/doc/dart/data/urdf/KR5/KR5 sixx R650.urdf"), *wam = text_at("/usr/share/doc/dart/data/urdf/wam/wam.urdf");
    if (kr5) write_here(&p, "kr5.urdf", kr5);
    if (wam) write_here(&p, "wam.urdf", wam);
    if (!kr5 || !wam) puts("skipped: no robots of Debian's package dart-doc");
    for (size_t i = 0; kr5 && wam && i < sizeof runs / sizeof *runs; i++) {
        finished f = run_expecting(&p, runs[i].line, runs[i].code);
        finished_clear(&f);
    }
    free(kr5);
    free(wam);
    place_clear(&p);
}

Test(urdf, inertias_have_an_upper_half_that_counts)
{
    static const char form[] = "<robot name=\"top\"><link name=\"base\"/><link name=\"top\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" ixy=\"0.25\" iyy=\"1\" izz=\"1\" %s/></inertial></link>\n"
                               "<joint name=\"spin\" type=\"continuous\"><parent link=\"base\"/><child link=\"top\"/><axis xyz=\"0 0 1\"/></joint></robot>\n";
    static const char *const lower[] = {"iyx=\"0\" izx=\"0.0\" izy=\"0\"", "iyx=\"0.25\"", "iyx=\"0.5\""};
    place p = place_make();
    for (int i = 0; i < 3; i++) {
        char text[700];
        snprintf(text, sizeof text, form, lower[i]);
        write_here(&p, "top.urdf", text);
        finished f = run_expecting(&p, "show top.urdf", 0);
        cr_expect_not_null(strstr(f.out, "inertia: [[1, 0.25, 0], [0.25, 1, 0], [0, 0, 1]]"), "%s", f.out);
        cr_expect_eq(strstr(f.out, "its upper half is taken: iyx differs from ixy") != NULL, i == 2, "%s", f.out);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* A planar joint across a direction that is no axis has the kinetic energy of a planar one in a turned frame. */
Test(urdf, planar_joints_across_any_direction)
{
    static const char form[] = "<robot name=\"p\"><link name=\"world\"/><link name=\"plate\"><inertial><origin xyz=\"0.1 0.2 0.3\"/><mass value=\"2\"/>"
                               "<inertia ixx=\"0.3\" ixy=\"0.01\" ixz=\"0.02\" iyy=\"0.2\" iyz=\"0.03\" izz=\"0.25\"/></inertial></link>"
                               "<joint name=\"s\" type=\"planar\"><parent link=\"world\"/><child link=\"plate\"/><axis xyz=\"%s\"/></joint></robot>";
    place p = place_make();
    char text[sizeof form + 40];
    double energy[2];
    for (int i = 0; i < 2; i++) {
        snprintf(text, sizeof text, form, i ? "0 0 -1" : "0 0 1");
        write_here(&p, "p.urdf", text);
        finished f = run_expecting(&p, i ? "simulate p.urdf --initial s_a'=-2,s_x'=1 --until 1 --step 1 --watch E" : "simulate p.urdf --initial s_a'=2,s_y'=1 --until 1 --step 1 --watch E", 0);
        cr_assert_eq(sscanf(strchr(f.out, '\n'), " 0,%lf", &energy[i]), 1, "%s", f.out);
        finished_clear(&f);
    }
    cr_expect_float_eq(energy[0], energy[1], 1e-12, "%.15g and %.15g", energy[0], energy[1]);
    place_clear(&p);
}

/* ---- many joints ---- */

/* A trunk of three links that carries `limbs` chains of `length` links; joints about directions that are no axes, bodies without symmetry. */
static void write_humanoid(place *p, const char *name, int limbs, int length)
{
    nh_text out;
    nh_text_init(&out);
    nh_text_add(&out, "<robot name=\"many\">\n");
    int bodies = 3 + limbs * length;
    for (int i = 0; i < bodies; i++) {
        nh_text_addf(&out, "<link name=\"b%d\"><inertial><origin xyz=\"0.01 %g 0.05\"/><mass value=\"%g\"/><inertia ixx=\"%g\" ixy=\"0.001\" ixz=\"0.002\" iyy=\"0.05\" iyz=\"0.003\" izz=\"0.04\"/></inertial></link>\n",
                     i, 0.01 * (i % 3), 1 + 0.1 * (i % 7), 0.03 + 0.001 * (i % 5));
        int parent = i < 3 ? i - 1 : (i - 3) % length ? i - 1 : 1 + (i - 3) / length % 2;
        if (i) nh_text_addf(&out, "<joint name=\"j%d\" type=\"revolute\"><origin xyz=\"%g 0.02 0.2\" rpy=\"0.1 %g 0\"/><parent link=\"b%d\"/><child link=\"b%d\"/><axis xyz=\"%d %d 1\"/></joint>\n",
                            i, 0.1 - 0.01 * (i % 4), 0.2 * (i % 3), parent, i, i % 2, i % 3);
    }
    nh_text_add(&out, "</robot>\n");
    write_here(p, name, nh_text_string(&out));
    nh_text_clear(&out);
}

/* The last column at first and at last: the energy. */
static void energies(const char *csv, double *first, double *last)
{
    const char *row = strchr(csv, '\n'), *end = csv + strlen(csv) - 1;
    cr_assert(row && end > row && *end == '\n', "%s", csv);
    const char *next = strchr(row + 1, '\n'), *comma = next, *at = end;
    while (*comma != ',') comma--;
    while (at[-1] != ',') at--;
    *first = strtod(comma + 1, NULL);
    *last = strtod(at, NULL);
}

Test(urdf, a_robot_of_thirty_joints_is_simulated_and_exported, WHOLE_ONLY)
{
    place p = place_make();
    double first, last;
    write_humanoid(&p, "many.urdf", 4, 7);
    finished f = run_expecting(&p, "simulate many.urdf --base floating --initial j3'=1,j9'=-1,z'=2,x'=1 --until 0.2 --step 0.1", 0);
    energies(f.out, &first, &last);
    cr_expect(fabs(last - first) < 1e-8 * fabs(first) && fabs(first) > 1, "%.15g becomes %.15g", first, last);
    finished_clear(&f);
    f = run_expecting(&p, "simulate many.urdf --until 0.1 --method bdf --tolerance 1e-6 --initial j3'=1 --watch j3,E --json many.json", 0); /* differences instead of a Jacobian */
    finished_clear(&f);
    f = run_expecting(&p, "export many.urdf --base floating --to c --of equations,submanifold -o code", 0);
    finished_clear(&f);
    place_clear(&p);
}
