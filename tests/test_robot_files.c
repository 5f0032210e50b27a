/* robot_files: robot descriptions as people have them: what the physics does not need is passed over, names stay different, and what surely is not meant
 * is said.  Accelerations are compared with a recursion of Newton and Euler that is written here. */
#include <criterion/criterion.h>

#include <math.h>
#include <nhsym.h>

#include "base/text.h"
#include "program.h"
#include "sweep.h"

/* ---- random trees, and their inverse dynamics ---- */

enum { LINKS = 6 };

typedef struct {
    int parent, type; /* 0 fixed, 1 revolute, 2 continuous, 3 prismatic */
    int follows;      /* the link whose joint this one mimics, or -1 */
    double at[3], rpy[3], axis[3], factor, offset, damping;
    double mass, center[3], inertia[6];
} limb;

static double between(uint64_t *seed, double low, double high)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(*seed >> 11) / 9007199254740992.0;
}

/* A number as the file has it. */
static double written(double x)
{
    char text[32];
    snprintf(text, sizeof text, "%.4f", x);
    return strtod(text, NULL);
}

/* Away from multiples of pi/12, for which four digits would be taken. */
static double an_angle(uint64_t *seed)
{
    double x = written(between(seed, -3, 3));
    return fabs(x - M_PI / 12 * round(x * 12 / M_PI)) < 2e-3 ? x + 0.01 : x;
}

static void random_tree(uint64_t seed, limb *l)
{
    for (int i = 0; i < LINKS; i++) {
        l[i] = (limb){.parent = i ? (int)between(&seed, 0, i) : -1, .follows = -1, .factor = 1};
        l[i].type = i == 1 ? 1 : (int)between(&seed, 0, 4);
        if (i > 2 && l[i].type && between(&seed, 0, 1) < 0.3) l[i].follows = 1, l[i].factor = written(between(&seed, -2, 2)), l[i].offset = written(between(&seed, -1, 1));
        l[i].damping = written(between(&seed, 0, 0.2));
        l[i].mass = written(between(&seed, 0.5, 2));
        for (int k = 0; k < 3; k++) {
            l[i].at[k] = written(between(&seed, -0.5, 0.5));
            l[i].rpy[k] = an_angle(&seed);
            l[i].axis[k] = written(between(&seed, 0.1, 1));
            l[i].center[k] = written(between(&seed, -0.2, 0.2));
            l[i].inertia[k == 0 ? 0 : k == 1 ? 3 : 5] = written(between(&seed, 0.1, 0.15));
            l[i].inertia[k == 0 ? 1 : k == 1 ? 2 : 4] = written(between(&seed, -0.02, 0.02));
        }
    }
}

/* With the elements and attributes of files that other programs write. */
static void write_tree(place *p, const limb *l)
{
    static const char *const types[] = {"fixed", "revolute", "continuous", "prismatic"};
    nh_text out;
    nh_text_init(&out);
    nh_text_add(&out, "<?xml version=\"1.0\"?>\n<robot name=\"tree\" xmlns=\"http://example.org/urdf\">\n<gazebo reference=\"b0\"/><gazebo/>\n");
    for (int i = 0; i < LINKS; i++) {
        nh_text_addf(&out, "<link name=\"b%d\" concave=\"yes\"><inertial><origin xyz=\"%g %g %g\"/><mass value=\"%g\"/><inertia ixx=\"%g\" ixy=\"%g\" ixz=\"%g\" iyy=\"%g\" iyz=\"%g\" izz=\"%g\"/></inertial></link>\n", i,
                     l[i].center[0], l[i].center[1], l[i].center[2], l[i].mass, l[i].inertia[0], l[i].inertia[1], l[i].inertia[2], l[i].inertia[3], l[i].inertia[4], l[i].inertia[5]);
        nh_text_addf(&out, "<joint name=\"j%d\" type=\"%s\" dont_collapse=\"true\"><origin xyz=\"%g %g %g\" rpy=\"%g %g %g\"/>", i, types[l[i].type], l[i].at[0], l[i].at[1], l[i].at[2], l[i].rpy[0], l[i].rpy[1], l[i].rpy[2]);
        if (i) nh_text_addf(&out, "<parent link=\"b%d\"/>", l[i].parent);
        else nh_text_add(&out, "<parent link=\"world\"/>"); /* which has no element of its own */
        nh_text_addf(&out, "<child link=\"b%d\"/><axis xyz=\"%g %g %g\" rpy=\"0 0 0\"/><dynamics damping=\"%g\" K=\"7000\"/>", i, l[i].axis[0], l[i].axis[1], l[i].axis[2], l[i].damping);
        if (l[i].follows >= 0) nh_text_addf(&out, "<mimic joint=\"j%d\" multiplier=\"%g\" offset=\"%g\"/>", l[i].follows, l[i].factor, l[i].offset);
        else if (!l[i].type) nh_text_add(&out, "<mimic joint=\"j1\"/>");
        nh_text_add(&out, "</joint>\n");
    }
    nh_text_add(&out, "</robot>\n");
    write_here(p, "tree.urdf", nh_text_string(&out));
    nh_text_clear(&out);
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++) out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static void turn(const double R[9], bool back, const double x[3], double out[3])
{
    for (int i = 0; i < 3; i++) out[i] = back ? R[i] * x[0] + R[3 + i] * x[1] + R[6 + i] * x[2] : R[3 * i] * x[0] + R[3 * i + 1] * x[1] + R[3 * i + 2] * x[2];
}

/* out = a Rot(axis, angle): columns of the turned frame, by Rodrigues. */
static void rotate(const double a[9], const double axis[3], double angle, double out[9])
{
    double T[9], c = cos(angle), s = sin(angle);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) T[3 * i + j] = (i == j) * c + (1 - c) * axis[i] * axis[j];
    for (int k = 0; k < 3; k++) T[3 * ((k + 2) % 3) + (k + 1) % 3] += s * axis[k], T[3 * ((k + 1) % 3) + (k + 2) % 3] -= s * axis[k];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) out[3 * i + j] = a[3 * i] * T[j] + a[3 * i + 1] * T[3 + j] + a[3 * i + 2] * T[6 + j];
}

typedef struct {
    double R[9], p[3], w[3], dw[3], a[3], f[3], n[3], axis[3]; /* in the link's own frame; R, p: in the parent's; f, n: force and moment on it */
} carried;

/* Forces on all joints that motion with displacements s, rates and accelerations needs: outwards velocities, inwards forces. */
static void inverse_dynamics(const limb *l, const double *s, const double *ds, const double *dds, double *tau)
{
    carried c[LINKS];
    for (int i = 0; i < LINKS; i++) {
        static const double e[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, none[3] = {0};
        const limb *b = &l[i];
        carried *x = &c[i], root = {.a = {0, 0, 9.81}};
        const carried *up = b->parent < 0 ? &root : &c[b->parent];
        double A[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, B[9], t[3], u[3], size = sqrt(b->axis[0] * b->axis[0] + b->axis[1] * b->axis[1] + b->axis[2] * b->axis[2]);
        bool turns = b->type == 1 || b->type == 2, slides = b->type == 3;
        for (int k = 0; k < 3; k++) x->axis[k] = b->axis[k] / size;
        rotate(A, e[2], b->rpy[2], B), rotate(B, e[1], b->rpy[1], A), rotate(A, e[0], b->rpy[0], B);
        rotate(B, x->axis, turns ? s[i] : 0, x->R);
        turn(B, false, slides ? x->axis : none, t);
        for (int k = 0; k < 3; k++) x->p[k] = b->at[k] + t[k] * s[i];
        turn(x->R, true, up->w, x->w), turn(x->R, true, up->dw, x->dw);
        cross(up->dw, x->p, t), cross(up->w, x->p, u), cross(up->w, u, B);
        for (int k = 0; k < 3; k++) A[k] = up->a[k] + t[k] + B[k];
        turn(x->R, true, A, x->a);
        cross(x->w, x->axis, t);
        for (int k = 0; k < 3; k++) {
            if (slides) x->a[k] += 2 * t[k] * ds[i] + x->axis[k] * dds[i];
            if (turns) x->dw[k] += t[k] * ds[i] + x->axis[k] * dds[i];
        }
        for (int k = 0; k < 3 && turns; k++) x->w[k] += x->axis[k] * ds[i];
        double I[9] = {b->inertia[0], b->inertia[1], b->inertia[2], b->inertia[1], b->inertia[3], b->inertia[4], b->inertia[2], b->inertia[4], b->inertia[5]}, Iw[3], Ia[3];
        cross(x->dw, b->center, t), cross(x->w, b->center, u), cross(x->w, u, A);
        for (int k = 0; k < 3; k++) x->f[k] = b->mass * (x->a[k] + t[k] + A[k]);
        turn(I, false, x->w, Iw), turn(I, false, x->dw, Ia), cross(x->w, Iw, t), cross(b->center, x->f, u);
        for (int k = 0; k < 3; k++) x->n[k] = Ia[k] + t[k] + u[k];
    }
    for (int i = LINKS - 1; i >= 0; i--) {
        double f[3], n[3], t[3];
        tau[i] = l[i].damping * ds[i];
        for (int k = 0; k < 3; k++) tau[i] += (l[i].type == 3 ? c[i].f[k] : l[i].type ? c[i].n[k] : 0) * c[i].axis[k];
        if (l[i].parent < 0) continue;
        turn(c[i].R, false, c[i].f, f), turn(c[i].R, false, c[i].n, n), cross(c[i].p, f, t);
        for (int k = 0; k < 3; k++) c[l[i].parent].f[k] += f[k], c[l[i].parent].n[k] += n[k] + t[k];
    }
}

static void compare_tree(place *p, uint64_t which)
{
    uint64_t seed = which;
    limb l[LINKS];
    int of[LINKS];
    double q[LINKS] = {0}, v[LINKS] = {0}, a[LINKS] = {0}, s[LINKS], ds[LINKS], dds[LINKS], tau[LINKS], t = 0;
    char path[sizeof p->folder + 20];
    nh_error error = {NH_OK, "", "", "", ""};
    random_tree(seed, l);
    write_tree(p, l);
    snprintf(path, sizeof path, "%s/tree.urdf", p->folder);
    nh_question question = {.system = path};
    nh_context *context = nh_context_create();
    nh_problem *problem = nh_problem_open(context, &question, &error);
    cr_assert_not_null(problem, "seed %d: %s %s", (int)which, error.where, error.what);
    nh_rates *rates = nh_rates_create(problem, &error);
    cr_assert_not_null(rates, "%s", error.what);
    size_t m = nh_problem_coordinates(problem), expected = 0;
    for (int i = 0; i < LINKS; i++) {
        of[i] = -1;
        expected += l[i].type && l[i].follows < 0;
        for (size_t k = 0; k < m; k++) {
            char name[8];
            snprintf(name, sizeof name, "j%d", l[i].follows >= 0 ? l[i].follows : i);
            if (l[i].type && !strcmp(name, nh_problem_coordinate(problem, k))) of[i] = (int)k;
        }
        cr_assert(!l[i].type || of[i] >= 0);
    }
    cr_assert_eq(m, expected);
    for (size_t k = 0; k < m; k++) q[k] = between(&seed, -1, 1), v[k] = between(&seed, -1, 1);
    nh_rates_at(rates, 1, &t, q, v, a);
    for (int i = 0; i < LINKS; i++) {
        s[i] = of[i] < 0 ? 0 : l[i].factor * q[of[i]] + l[i].offset;
        ds[i] = of[i] < 0 ? 0 : l[i].factor * v[of[i]];
        dds[i] = of[i] < 0 ? 0 : l[i].factor * a[of[i]];
    }
    inverse_dynamics(l, s, ds, dds, tau);
    for (size_t k = 0; k < m; k++) {
        double power = 0, size = 1;
        for (int i = 0; i < LINKS; i++)
            if (of[i] == (int)k) power += l[i].factor * tau[i], size += fabs(l[i].factor * tau[i]);
        cr_expect_lt(fabs(power), 1e-9 * size * (1 + fabs(a[k])), "seed %d: a force of %.3g is left on %s", (int)which, power, nh_problem_coordinate(problem, k));
    }
    nh_rates_free(rates);
    nh_problem_free(problem);
    nh_context_free(context);
}

Test(robot_files, accelerations_of_random_trees_are_those_of_newton_and_euler, PLAIN_ONLY)
{
    place p = place_make();
    for (uint64_t i = 1; i <= 24; i++)
        if (sweep_tries(i, 24, 6)) compare_tree(&p, i);
    place_clear(&p);
}

/* ---- what is passed over, and what is not ---- */

#define ARM "<link name=\"arm\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\"/></inertial></link>"
#define HINGE(more) "<joint name=\"hinge\" type=\"revolute\"><parent link=\"base\"/><child link=\"arm\"/><axis xyz=\"0 1 0\"/>" more "</joint>"
#define INERTIA(text) "<link name=\"arm\"><inertial><origin xyz=\"0, 0.5, 1\"/><mass value=\"2\"/><inertia " text "/></inertial></link>"

Test(robot_files, what_the_physics_does_not_need_is_passed_over_with_a_note)
{
    static const struct {
        const char *inside, *note; /* NULL: there is none of this kind */
    } cases[] = {
        {"<link name=\"base\"/>" ARM HINGE(""), NULL},
        {"<link name=\"base\"/>" ARM HINGE("<limit lower=\"-1\" lowr=\"2\"/>") "<gazebo/><gazebo/><frobnicate/>", "passed over: <gazebo> (2), <frobnicate>"},
        {"<link name=\"base\"/>" ARM HINGE("<dynamics damping=\"0\" D=\"1\" K=\"2\"/>"), "passed over: <dynamics D>, <dynamics K>"},
        {"<link name=\"base\" concave=\"yes\"/>" ARM HINGE("<lmit/>"), "passed over: <joint"},
        {ARM HINGE(""), "a frame without mass stands for the link that is missing: base"},
        {"<link name=\"base\"/>" INERTIA("ixx=\"1\" ixy=\"2e-17\" iyy=\"1\" izz=\"1\"") HINGE(""), "moments of inertia are taken for 0: 2e-17"},
        {"<link name=\"base\"/>" INERTIA("ixx=\"-5e-20\" iyy=\"0\" izz=\"0\"") HINGE(""), "moments of inertia are taken for 0: -5e-20"},
        {"<link name=\"base\"/>" INERTIA("ixx=\"1\" iyy=\"1\" izz=\"2.1\"") HINGE(""), "larger than the sum of the other two: check the links: arm"},
        {"<link name=\"base\"/>" INERTIA("ixx=\"1\" ixy=\"1.5\" iyy=\"1\" izz=\"1\"") HINGE(""), "a principal moment"},
        {"<link name=\"base\"/>" ARM HINGE("<dynamics friction=\"0.1\"/>"), "dry friction is left out of the joints: hinge"},
    };
    place p = place_make();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1200];
        snprintf(text, sizeof text, "<robot name=\"r\">%s</robot>\n", cases[i].inside);
        write_here(&p, "r.urdf", text);
        finished f = run_expecting(&p, "simulate r.urdf --initial hinge=0.1 --until 0.1 --step 0.1", 0);
        bool said = strstr(f.err, "passed over") || strstr(f.err, "left out") || strstr(f.err, "taken for") || strstr(f.err, "check") || strstr(f.err, "stands for");
        if (i == 3) cr_expect(strstr(f.err, "<link concave>") && strstr(f.err, "<lmit>"), "%s", f.err);
        else if (i == 8) cr_expect(strstr(f.err, "one principal moment is negative"), "%s", f.err);
        else cr_expect(cases[i].note ? strstr(f.err, cases[i].note) != NULL : !said, "case %zu: %s", i, f.err);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* A string of C with its zero, as some programs save it. */
Test(robot_files, zeros_at_the_end_are_no_text)
{
    static const char text[] = "<robot name=\"r\"><link name=\"base\"/>" ARM HINGE("") "</robot>\n\0\0";
    place p = place_make();
    char path[sizeof p.folder + 20];
    snprintf(path, sizeof path, "%s/r.urdf", p.folder);
    FILE *file = fopen(path, "wb");
    cr_assert_not_null(file);
    fwrite(text, 1, sizeof text, file);
    fclose(file);
    finished f = run_expecting(&p, "show r.urdf", 0);
    finished_clear(&f);
    place_clear(&p);
}

Test(robot_files, a_spherical_joint_has_three_turns, PLAIN_ONLY)
{
    static const char *const types[] = {"spherical", "ball"};
    place p = place_make();
    for (int i = 0; i < 2; i++) {
        char text[700];
        snprintf(text, sizeof text, "<robot name=\"r\"><link name=\"world\"/>" INERTIA("ixx=\"1\" iyy=\"1\" izz=\"1\"") "<joint name=\"hip\" type=\"%s\"><parent link=\"world\"/><child link=\"arm\"/></joint></robot>", types[i]);
        write_here(&p, "r.urdf", text);
        finished f = run_expecting(&p, "analyze -v r.urdf", 0); /* its energy, and the momentum about the vertical */
        cr_expect(strstr(f.out, "3 coordinates") && strstr(f.out, "hip_a"), "%s", f.out);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* ---- names ---- */

/* Every pair of names becomes two names, and what is shown is a file with the same motion. */
Test(robot_files, names_stay_different_and_are_said_as_they_are_written, PLAIN_ONLY)
{
    static const char *const names[][2] = {{"arm-1", "arm_1"}, {"arm_1", "arm 1"}, {"腕一", "腕二"}, {"t", "pi"}, {"sin", "g"}, {"ground", "x"}, {"α", "alpha"}, {"1", "_1"}, {"base", "base_joint"}, {"mass_a", "a"}, {"é", "è"}};
    static const char form[] = "<robot name=\"r\"><link name=\"root\"/>"
                               "<link name=\"%s\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\"/></inertial></link><link name=\"%s\"><inertial><mass value=\"2\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\"/></inertial></link>"
                               "<joint name=\"%s\" type=\"revolute\"><parent link=\"root\"/><child link=\"%s\"/></joint><joint name=\"%s\" type=\"revolute\"><origin xyz=\"0 0.5 0\"/><parent link=\"%s\"/><child link=\"%s\"/></joint></robot>\n";
    place p = place_make();
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (!sweep_tries(i + 1, sizeof names / sizeof *names, 5)) continue;
        const char *a = names[i][0], *b = names[i][1];
        char text[1500];
        snprintf(text, sizeof text, form, a, b, a, a, b, a, b);
        write_here(&p, "r.urdf", text);
        finished shown = run_expecting(&p, "show r.urdf", 0);
        if (strpbrk(a, "-\xe8\xc3")) cr_expect_not_null(strstr(shown.out, a), "%s is not said: %s", a, shown.out);
        write_here(&p, "copy.yaml", shown.out);
        finished own = run_expecting(&p, "simulate r.urdf --until 0.2 --step 0.2 --initial t=0 --quiet", 0), copy = run_expecting(&p, "simulate copy.yaml --until 0.2 --step 0.2 --initial t=0 --quiet", 0);
        cr_expect_str_eq(own.out, copy.out, "%s and %s", a, b);
        cr_expect(strchr(own.out, '\n') - own.out > 10, "%s", own.out);
        finished_clear(&shown);
        finished_clear(&own);
        finished_clear(&copy);
    }
    place_clear(&p);
}

/* ---- what is not meant ---- */

#define WHEEL(name, moments) "<link name=\"" name "\"><inertial><mass value=\"1\"/><inertia " moments "/></inertial><collision><origin rpy=\"1.5708 0 0\"/><geometry><cylinder radius=\"0.1\" length=\"0.02\"/></geometry></collision></link>"
#define AXLE(name, place) "<joint name=\"" name "_joint\" type=\"continuous\"><origin xyz=\"" place "\"/><parent link=\"body\"/><child link=\"" name "\"/><axis xyz=\"0 1 0\"/></joint>"
#define BODY "<link name=\"body\"><inertial><mass value=\"3\"/><inertia ixx=\"0.1\" iyy=\"0.1\" izz=\"0.2\"/></inertial></link>"
#define ROUND "ixx=\"0.003\" iyy=\"0.005\" izz=\"0.003\""

Test(robot_files, what_surely_is_not_meant_is_said, PLAIN_ONLY)
{
    static const struct {
        const char *inside, *options, *note; /* NULL: nothing is said */
        int code;
    } cases[] = {
        {BODY WHEEL("l", ROUND) WHEEL("r", ROUND) AXLE("l", "0 0.3 0") AXLE("r", "0 -0.3 0"), "--wheel l,r", NULL, 0},
        {BODY WHEEL("l", ROUND) WHEEL("r", ROUND) AXLE("l", "0 0.3 0") AXLE("r", "0 -0.3 0"), "", "look like wheels turn in the air: --wheel l,r lets them roll", 0},
        {BODY WHEEL("l", ROUND) WHEEL("r", ROUND) AXLE("l", "0 0.3 0") AXLE("r", "0 -0.3 0.04"), "--wheel l,r", "do not touch the ground: r; r is 0.04 above it", 0},
        {BODY WHEEL("l", ROUND) WHEEL("r", ROUND) AXLE("l", "0 0.3 0") AXLE("r", "0 -0.3 0"), "--wheel l,r=0.2", "do not touch the ground: r; r is 0.1 below it", 0},
        {BODY WHEEL("l", "ixx=\"0.004\" iyy=\"0.005\" izz=\"0.002\"") WHEEL("r", ROUND) AXLE("l", "0 0.3 0") AXLE("r", "0 -0.3 0"), "--wheel l,r", "not round about their axles, so their angles occur in the equations of motion: l; inertia: [0.003, 0.005, 0.003] of l", 0},
        {BODY "<link name=\"arm\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\"/></inertial></link>" AXLE("arm", "0 0 1"), "", "`body` is fixed to the ground: --base floating or planar lets it move", 0},
        {BODY "<link name=\"arm\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\"/></inertial></link>" AXLE("arm", "0 0 1"), "--base fixed", NULL, 0},
        {BODY, "", "hint: every joint is fixed: --base floating", 3},
    };
    place p = place_make();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[2000], line[200];
        snprintf(text, sizeof text, "<robot name=\"r\">%s</robot>\n", cases[i].inside);
        write_here(&p, "r.urdf", text);
        snprintf(line, sizeof line, "simulate r.urdf --initial t=0 --until 0.1 --step 0.1 %s", cases[i].options);
        finished f = run_expecting(&p, line, cases[i].code);
        bool said = strstr(f.err, "ground") || strstr(f.err, "round");
        cr_expect(cases[i].note ? strstr(f.err, cases[i].note) != NULL : !said, "case %zu: %s", i, f.err);
        finished_clear(&f);
    }
    place_clear(&p);
}
