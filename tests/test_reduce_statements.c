/* What `reduce` says of a system: text, page and JSON agree with each other and with what was computed. */
#include "oracle.h"

#include "document/html.h"
#include "document/export.h"
#include "document/reduction.h"
#include "scratch.h"
#include "sweep.h"

typedef struct {
    nh_reduction *r;
    nh_text text, page; /* the page without its tags */
    char *json;
} told;

static void strip_tags(const char *html, nh_text *out)
{
    bool tag = false;
    for (const char *c = html; *c; c++) {
        if (*c == '<') tag = true;
        else if (*c == '>') tag = false;
        else if (!tag) nh_text_addf(out, "%c", *c);
    }
}

/* Runs of blanks and ends of lines are one blank: where lines are broken is another question. */
static const char *flat(const char *text)
{
    static char copy[1 << 16];
    size_t n = 0;
    for (const char *c = text; *c && n + 1 < sizeof copy; c++)
        if (!strchr(" \n", *c)) copy[n++] = *c;
        else if (!n || copy[n - 1] != ' ') copy[n++] = ' ';
    copy[n] = 0;
    return copy;
}

static told tell_file(const char *path, size_t settings, const nh_setting *setting)
{
    told t;
    nh_error error = {0};
    nh_request q = {.system_path = path, .settings = settings, .setting = setting};
    nh_options_default(&q.options);
    t.r = nh_reduction_create(&q, &error);
    must(t.r != NULL, &error, path);
    nh_text html;
    nh_text_init(&t.text), nh_text_init(&t.page), nh_text_init(&html);
    nh_reduction_write(t.r, NULL, (nh_pen_style){.form = NH_PEN_TEXT, .verbose = true}, &html);
    for (const char *line = nh_text_string(&html); *line; line += strcspn(line, "\n"), line += *line == '\n') cr_expect_leq(strcspn(line, "\n"), 80, "%.200s", line);
    nh_text_add(&t.text, flat(nh_text_string(&html)));
    nh_text_clear(&html);
    nh_text_init(&html);
    nh_reduction_write(t.r, &(nh_run){.command = "nhsym reduce", .system_path = path, .seed = 1, .shown = 200, .seconds = NAN}, (nh_pen_style){.form = NH_PEN_PAGE}, &html);
    strip_tags(nh_text_string(&html), &t.page);
    t.json = nh_reduction_json(t.r, NULL);
    nh_text_clear(&html);
    return t;
}


static told tell(const char *text)
{
    char path[SCRATCH];
    cr_assert(scratch_text(path, text));
    told t = tell_file(path, 0, NULL);
    remove(path);
    return t;
}

static void done(told *t)
{
    nh_reduction_free(t->r);
    nh_text_clear(&t->text);
    nh_text_clear(&t->page);
    nh_free(t->json);
}

#define SAYS(where, words) cr_expect(strstr((where), (words)) || strstr((where), flat(words)), "\"%s\" is missing in\n%.6000s", (words), (where))
#define IS_SILENT(where, words) cr_expect(strstr((where), flat(words)) == NULL, "\"%s\" is in\n%.6000s", (words), (where))
#define TEXT(t) nh_text_string(&(t).text)
#define PAGE(t) nh_text_string(&(t).page)

/* An energy that was not followed does not drift by zero. */
Test(reduce_statements, energy_that_is_not_followed)
{
    told t = tell_file("systems/skate_with_friction.yaml", 0, NULL);
    cr_assert_gt(t.r->stages, 1);
    SAYS(TEXT(t), "energy not followed: forces act");
    SAYS(PAGE(t), "energy not followed: forces act");
    IS_SILENT(PAGE(t), "energy drifts by 0");
    SAYS(t.json, "\"energy_drift\":\tnull");
    SAYS(t.json, "\"energy_not_followed\":\t\"forces act\"");
    IS_SILENT(TEXT(t), "no second stage");
    SAYS(TEXT(t), "warning: stage 1 is not reduced further");
    done(&t);
    t = tell_file("systems/cart_on_disc.yaml", 0, NULL);
    SAYS(TEXT(t), "the moving energy drifts by");
    SAYS(PAGE(t), "the moving energy drifts by");
    SAYS(TEXT(t), "energy less the momentum of");
    SAYS(PAGE(t), "energy less the momentum of");
    IS_SILENT(PAGE(t), "gauge momentum");
    done(&t);
}

/* The whole group divided at once is an alternative, not what follows. */
Test(reduce_statements, stages_that_do_not_follow_each_other, PLAIN_ONLY)
{
    told t = tell_file("systems/crane.yaml", 0, NULL);
    SAYS(TEXT(t), "\nStage 2: second stage, by SO(2)");
    SAYS(TEXT(t), "\nStage 3, in one step instead of stages 1 and 2: ");
    SAYS(PAGE(t), "8 coordinates, 4 constraints; reduced to 4 shape coordinates, then to 3; in one step to 2.");
    nh_text code;
    nh_text_init(&code);
    nh_reduction_latex(t.r, &code);
    SAYS(nh_text_string(&code), "% Stage 3, in one step instead of stages 1 and 2 (");
    nh_text_clear(&code);
    done(&t);
    t = tell_file("systems/euler_disk.yaml", 0, NULL);
    SAYS(TEXT(t), "\nStage 2, in one step instead of stage 1: ");
    done(&t);
}

/* Where nothing is left of the shape in one step this is the first thing to read; the stages keep their numbers, which the other files have. */
Test(reduce_statements, one_step_to_a_point_comes_first)
{
    static const struct {
        const char *system, *whole, *first, *sizes;
    } cases[] = {{"sleigh", "\nIn one step, stage 2", "\nInstead of one step, stage 1", "reduced in one step to 0 shape coordinates; instead of one step to 2."},
                 {"vertical_disk", "\nIn one step, stage 3", "\nInstead of one step, stage 1", "reduced in one step to 0 shape coordinates; instead of one step to 2, then to 0."}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char path[100];
        snprintf(path, sizeof path, "systems/%s.yaml", cases[i].system);
        told t = tell_file(path, 0, NULL);
        const char *whole = strstr(TEXT(t), cases[i].whole + 1), *first = strstr(TEXT(t), cases[i].first + 1);
        cr_expect(whole && first && whole < first, "%s", TEXT(t));
        SAYS(PAGE(t), cases[i].sizes);
        size_t last = t.r->stages - 1;
        cr_expect(t.r->stage[0].kind == NH_STAGE_CHAPLYGIN && !t.r->stage[last].shown->n);
        cr_expect_eq(nh_reduction_order(t.r, 0), last);
        cr_expect_eq(nh_reduction_order(t.r, 1), 0);
        nh_text code;
        nh_text_init(&code);
        nh_reduction_latex(t.r, &code);
        const char *a = strstr(nh_text_string(&code), cases[i].whole + 1), *b = strstr(nh_text_string(&code), cases[i].first + 1);
        cr_expect(a && b && a < b, "%s", nh_text_string(&code));
        nh_text_clear(&code);
        done(&t);
    }
    told t = tell_file("systems/crane.yaml", 0, NULL);
    cr_expect_eq(nh_reduction_order(t.r, 0), 0); /* its shape is no point */
    done(&t);
}

/* Currents that are conserved without a closed form are conserved. */
Test(reduce_statements, momenta_without_a_closed_form, PLAIN_ONLY)
{
    told t = tell_file("systems/euler_disk.yaml", 0, NULL);
    cr_assert_eq(t.r->momenta.count, 0);
    SAYS(TEXT(t), "The 2 currents of stage 2 that are linear in the velocities are conserved; the search found no momentum of the group in closed form");
    IS_SILENT(TEXT(t), "no conserved momentum of the group");
    SAYS(PAGE(t), "The 2 currents of stage 2 that are linear in the velocities are conserved");
    IS_SILENT(PAGE(t), "no conserved momentum of the group");
    done(&t);
}

/* A symmetry that is not in D, along which the reaction does no work all the same. */
Test(reduce_statements, momenta_of_symmetries_outside_the_distribution)
{
    told t = tell_file("systems/sleigh.yaml", 1, (nh_setting[]){{.name = "k", .value = 1}});
    cr_assert_eq(t.r->momenta.count, 3);
    for (size_t i = 0; i < 3; i++) cr_expect(!t.r->momenta.momentum[i].horizontal && !t.r->momenta.momentum[i].gauge);
    SAYS(TEXT(t), "not horizontal, but conserved: momentum of d/dx");
    IS_SILENT(TEXT(t), "horizontal symmetry");
    SAYS(t.json, "\"kind\":\t\"momentum\"");
    done(&t);
    t = tell_file("systems/relativistic_charge.yaml", 0, NULL); /* no constraints: every field is horizontal */
    for (size_t i = 0; i < t.r->momenta.count; i++) cr_expect(t.r->momenta.momentum[i].horizontal);
    done(&t);
}

/* A density that vanishes where the orbits become tangent to D, as the stage ends there, has one value on the angle all the same; one that grows from turn to turn has not. */
Test(reduce_statements, measures_that_are_local)
{
    static const struct {
        const char *text;
        bool local;
    } own[] = {
        {"name: blade\nparameters: [{name: m, value: 2}, {name: J, value: 0.5}]\ncoordinates: [{name: x, type: length}, {name: y, type: length}, {name: f, type: angle}]\n"
         "lagrangian: m*(x'^2 + y'^2)/2 + J*f'^2/2\nconstraints: [\"x'*sin(f) - y'*cos(f) = 0\"]\n", false},
        {"name: wave\nparameters: [{name: m, value: 2}, {name: J, value: 0.5}]\ncoordinates: [{name: x, type: length}, {name: f, type: angle}, {name: z, type: length}]\n"
         "lagrangian: m*(x'^2 + z'^2)/2 + J*f'^2/2\nconstraints: [\"z' - (2 + cos(f))*x' = 0\"]\n", false},
        {"name: ramp\nparameters: [{name: m, value: 2}, {name: J, value: 0.5}]\ncoordinates: [{name: x, type: length}, {name: f, type: angle}, {name: z, type: length}]\n"
         "lagrangian: m*x'^2/2 + m*exp(-f/5)*z'^2/2 + J*f'^2/2\nconstraints: [\"z' - exp(f/5)*x' = 0\"]\n", true},
    };
    for (size_t i = 0; i < sizeof own / sizeof *own; i++) {
        told t = tell(own[i].text);
        cr_assert_gt(t.r->stages, 0, "%zu", i);
        const nh_chaplygin_measure *m = &t.r->stage[0].measure;
        cr_expect(m->measure && m->size > 0, "%zu: %d, %g", i, m->measure, m->size);
        cr_expect_eq(m->local, own[i].local, "%zu\n%s", i, TEXT(t));
        cr_expect_eq(strstr(TEXT(t), "only locally") != NULL, own[i].local);
        cr_expect_eq(strstr(PAGE(t), "only locally") != NULL, own[i].local);
        done(&t);
    }
    static const char *const shipped[] = {"knife_edge", "disc_on_slope", "suslov_principal", "two_wheel_cart"};
    for (size_t i = 0; i < sizeof shipped / sizeof *shipped; i++) {
        char path[SCRATCH];
        snprintf(path, sizeof path, "systems/%s.yaml", shipped[i]);
        told t = tell_file(path, 0, NULL);
        cr_expect(t.r->stage[0].measure.measure);
        cr_expect_eq(t.r->stage[0].measure.local, i == 3, "%s", shipped[i]); /* the cart's grows with the difference of its wheels' angles */
        done(&t);
    }
}

/* On a torus a rotation of two angles is no symmetry: it is one of the plane that covers it. */
Test(reduce_statements, symmetries_that_are_local)
{
    told t = tell("name: torus\nparameters: [{name: J, value: 0.7}]\ncoordinates: [{name: a, type: angle}, {name: b, type: angle}, {name: c, type: angle}]\nlagrangian: J*(a'^2 + b'^2 + c'^2)/2\n");
    cr_assert_eq(t.r->all->action.d, 6);
    for (size_t i = 0; i < 6; i++) cr_expect_eq(t.r->all->action.generator[i].local, i >= 3, "generator %zu", i + 1);
    cr_expect_eq(t.r->all->global, 3);
    SAYS(TEXT(t), "Symmetry group, locally: SE(3), dimension 6; globally: SO(2)^3, of dimension 3");
    SAYS(TEXT(t), "-b d/da + a d/db   (local: many-valued on an angle)");
    SAYS(TEXT(t), "momentum of -b d/da + a d/db (proved; local: many-valued on an angle)");
    SAYS(PAGE(t), "Symmetry group, locally: SE(3), dimension 6; globally: SO(2)\u00b3, of dimension 3");
    SAYS(t.json, "\"global\":\t{\n\t\t\t\"dimension\":\t3,\n\t\t\t\"name\":\t\"SO(2)^3\",\n\t\t\t\"complete\":\ttrue");
    SAYS(t.json, "\"local\":\ttrue");
    for (size_t i = 0; i < t.r->stages; i++) cr_expect_not(t.r->stage[i].local); /* global ones are divided out where there are as many */
    done(&t);
    t = tell("name: plane\nparameters: [{name: J, value: 0.7}]\ncoordinates: [{name: a, type: length}, {name: b, type: length}]\nlagrangian: J*(a'^2 + b'^2)/2\n");
    IS_SILENT(TEXT(t), "ocally");
    IS_SILENT(TEXT(t), "(local:");
    IS_SILENT(t.json, "\"local\":\ttrue");
    cr_expect_not(t.r->all->local);
    done(&t);
}

/* The turns of a screw count: each ends a pitch further, so that nothing is many-valued there.  Without a pitch a rotation
 * beside a translation of the same body stays at its place. */
Test(reduce_statements, turns_of_a_screw_count)
{
    static const char *const text = "name: screw\nparameters: [{name: c, value: 0.3}]\nbodies: [{name: a, mass: 1.2, inertia: [0.3, 0.4, 0.5]}]\n"
                                    "joints: [{type: translating-screw, pitch: %s, axis: z, child: a, coordinates: [x, y, p]}]\n";
    for (int flat = 0; flat < 2; flat++) {
        char file[SCRATCH];
        snprintf(file, sizeof file, text, flat ? "0" : "c");
        told t = tell(file);
        size_t local = 0;
        for (size_t a = 0; a < t.r->all->action.d; a++) local += t.r->all->action.generator[a].local;
        cr_expect_eq(t.r->all->action.d, 6, "%zu", t.r->all->action.d);
        cr_expect_eq(local, flat ? 2 : 0, "%zu", local); /* the rotations that take p into a length */
        cr_expect_eq(t.r->all->local, flat == 1);
        done(&t);
    }
}

/* The stages as C. */
static void export_c(const nh_reduction *r, nh_text *out)
{
    nh_export *x = nh_export_of_reduction(r);
    nh_export_text(x, NH_EXPORT_C, "reduced", NULL, out);
    nh_export_free(x);
}

/* A Lagrangian may be many-valued and its symmetries not; dividing by a symmetry that is local is said to be so. */
Test(reduce_statements, stages_that_are_local)
{
    static const char text[] = "name: coiled\nparameters: [{name: k, value: 0.3}]\ncoordinates: [{name: r, type: length}, {name: f, type: angle}, {name: z, type: length}]\n"
                               "domain: {r: [0.5, 2]}\nlagrangian: (r'^2 + r^2*f'^2 + (1 + r^2)*(z' - f*r')^2)/2\n";
    char path[SCRATCH];
    cr_assert(scratch_text(path, text));
    nh_error error = {0};
    nh_request q = {.system_path = path};
    nh_options_default(&q.options);
    nh_reduction *r = nh_reduction_create(&q, &error);
    remove(path);
    must(r != NULL, &error, "coiled");
    size_t local = 0;
    for (size_t a = 0; a < r->all->action.d; a++) local += r->all->action.generator[a].local;
    cr_expect_eq(r->all->action.d, 2, "%zu", r->all->action.d); /* d/dz and d/df + r d/dz, single-valued though L is not */
    cr_expect_eq(local, 0);
    nh_reduction_free(r);
    /* r^2 (a^2 + b^2) with angles a, b: their rotation is the only symmetry */
    told t = tell("name: two_angles\ncoordinates: [{name: a, type: angle}, {name: b, type: angle}]\ndomain: {a: [0.5, 1.5], b: [0.5, 1.5]}\nlagrangian: (a'^2 + b'^2)/2 - (a^2 + b^2)^2\n");
    cr_assert(t.r->stages == 2 && t.r->all->action.d == 1);
    cr_expect(t.r->stage[0].local && t.r->stage[1].local && t.r->all->local && t.r->all->global == 0);
    SAYS(TEXT(t), "Symmetry group, locally: SO(2), dimension 1; globally: none");
    SAYS(TEXT(t), "acts only locally: it is many-valued on an angle");
    SAYS(PAGE(t), "this group acts only locally");
    nh_text code;
    nh_text_init(&code);
    export_c(t.r, &code);
    SAYS(nh_text_string(&code), "which acts locally.");
    nh_text_clear(&code);
    done(&t);
}

/* A density that is a power of the determinant's numerator alone, without the pole of the angles. */
Test(reduce_statements, densities, PLAIN_ONLY)
{
    told t;
    static const char *const dense[] = {"chaplygin_ball", "veselova", "spherical_robot", "routh_sphere"};
    for (size_t i = 0; i < sizeof dense / sizeof *dense; i++) {
        char path[SCRATCH];
        snprintf(path, sizeof path, "systems/%s.yaml", dense[i]);
        t = tell_file(path, 0, NULL);
        SAYS(TEXT(t), "density = 1/sqrt(");
        cr_expect(t.r->stage[0].measure.proof.all_parameters);
        done(&t);
    }
}

Test(reduce_statements, one_coordinate)
{
    told t = tell_file("systems/damped_oscillator.yaml", 0, NULL);
    SAYS(TEXT(t), "\n1 coordinate, 0 constraints");
    done(&t);
}

/* A momentum is not called by the letter of a parameter. */
Test(reduce_statements, momenta_beside_a_parameter_of_that_name, PLAIN_ONLY)
{
    told t = tell_file("systems/vertical_disk.yaml", 0, NULL);
    IS_SILENT(TEXT(t), ") J = ");
    SAYS(TEXT(t), "    p_xi = K*p'\n");
    done(&t);
    if (!sweep_whole()) return;
    t = tell_file("systems/snakeboard.yaml", 0, NULL);
    SAYS(TEXT(t), "    p_xi = ");
    done(&t);
    t = tell_file("systems/crane.yaml", 0, NULL);
    SAYS(TEXT(t), "    J = ");
    done(&t);
}

/* ---- without inertia ---- */

static void refuses(const char *text, const char *words)
{
    char path[SCRATCH];
    nh_error error = {0};
    nh_request q = {.system_path = path};
    nh_options_default(&q.options);
    cr_assert(scratch_text(path, text));
    nh_reduction *r = nh_reduction_create(&q, &error);
    cr_expect(!r && error.code == NH_INPUT && strstr(error.what, words) && *error.hint, "%s: %d %s %s", words, error.code, error.what, error.hint);
    nh_reduction_free(r);
    remove(path);
}

/* Its equations do not determine the motion: that its group is trivial would not even be true. */
Test(reduce_statements, a_singular_Lagrangian_is_refused_with_all_directions)
{
    refuses("coordinates: [x, y]\nlagrangian: (x' + y')^2/2 - x^2\n", "rank 1 of 2; no inertia in the direction x' : y' = 1 : -1");
    refuses("coordinates: [x, y, z]\nlagrangian: x'^2/2 + y*z'\n", "rank 1 of 3; no inertia in the directions y' and z'");
    refuses("coordinates: [x, y, z]\nlagrangian: (x'^2 - y'^2)/2 + z'^2/2\nconstraints:\n  - y' = x'\n", "rank 1 of 2; no inertia in the direction x'");
    /* it turns with z: the place belongs to it */
    refuses("coordinates: [x, y, z]\nlagrangian: (cos(z)*x' + sin(z)*y')^2/2 + z'^2/2\n", "rank 2 of 3; no inertia in the direction x' : y' = 0.256 : 1 (at x = ");
    refuses("coordinates: [x, y]\nlagrangian: sqrt(1 + (x' + y')^2)\n", "rank 1 of 2; no inertia in the direction x' : y' = 1 : -1");
}

/* What constraints bind needs no inertia: x moves, y follows it. */
Test(reduce_statements, inertia_on_the_constraint_submanifold_is_enough)
{
    told t = tell("coordinates: [x, y, z]\nlagrangian: x'^2/2 + z'^2/2\nconstraints:\n  - y' = x*x'\n");
    cr_expect_eq(t.r->group->action.d, 5);
    SAYS(nh_text_string(&t.text), "d/dx + x d/dy");
    done(&t);
}

/* A Lagrangian that is not defined for all velocities of the box has the symmetries that it has. */
Test(reduce_statements, symmetries_of_a_root_of_the_velocities)
{
    told t = tell("coordinates: [x, y]\nlagrangian: -sqrt(1 - x'^2 - y'^2)\n");
    cr_expect_eq(t.r->group->action.d, 3);
    SAYS(nh_text_string(&t.text), "Symmetry group: SE(2), dimension 3");
    done(&t);
}

/* The derivative of sign(u) is zero, so that d/dx satisfies the conditions of a symmetry on both sides of the place where a force jumps; across it the "momentum" jumps. */
Test(reduce_statements, symmetries_on_each_side_of_a_wall)
{
    static const struct {
        const char *lagrangian;
        bool weak;
        size_t local, whole, momenta; /* dimensions */
    } of[] = {
        {"(x'^2+y'^2)/2 - 2*x - abs(x) - y^2/2", true, 1, 0, 0}, {"(x'^2+y'^2)/2 + abs(x)*y'", true, 3, 1, 1},    {"(x'^2+3*y'^2)/2 - abs(x - y)", true, 2, 1, 1},
        {"(x'^2+3*y'^2)/2 - abs(x - y)", false, 1, 1, 1},        {"(x'^2+y'^2)/2 - sign(x)", false, 3, 1, 1},     {"(x'^2+y'^2)/2 - abs(x^2+y^2-1)", true, 1, 1, 1},
        {"(x'^2+y'^2)/2 - sqrt(x^2+y^2)", true, 1, 1, 1},        {"(x'^2+y'^2)/2 - 2*x", true, 2, 2, 2},
    };
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        char text[300], path[SCRATCH];
        nh_error error = {0};
        snprintf(text, sizeof text, "name: wall\ncoordinates: [x, y]\nlagrangian: %s\n", of[i].lagrangian);
        cr_assert(scratch_text(path, text));
        nh_request q = {.system_path = path, .weak = of[i].weak};
        nh_options_default(&q.options);
        nh_reduction *r = nh_reduction_create(&q, &error);
        must(r != NULL, &error, text);
        cr_expect_eq(r->all->action.d, of[i].local, "%s: %zu", of[i].lagrangian, r->all->action.d);
        cr_expect_eq(r->group->action.d, of[i].whole, "%s: %zu", of[i].lagrangian, r->group->action.d);
        cr_expect_eq(r->momenta.count, of[i].momenta, "%s: %zu momenta", of[i].lagrangian, r->momenta.count);
        cr_expect_eq(r->warnings > 0 && strstr(r->warning[0], "local symmetr") != NULL, of[i].local > of[i].whole, "%s: %s", of[i].lagrangian, r->warnings ? r->warning[0] : "");
        for (size_t k = 0; k < r->stages; k++) cr_expect(!nh_stage_apart(&r->stage[k], &r->options), "%s: stage %zu", of[i].lagrangian, k + 1);
        nh_reduction_free(r);
        q.group = "x=1";
        nh_error_clear(&error);
        r = of[i].local > of[i].whole ? nh_reduction_create(&q, &error) : NULL;
        cr_expect(!r && (of[i].local == of[i].whole || strstr(error.what, "on each side only")), "%s: %s", of[i].lagrangian, error.what ? error.what : "taken");
        nh_error_clear(&error);
        nh_reduction_free(r);
        remove(path);
    }
}

/* Where symmetries cannot be counted the list may be incomplete, and the reason is told; where they are, or the user named the fields, nothing is. */
Test(reduce_statements, what_is_not_counted_may_be_incomplete)
{
    static const struct {
        const char *rest, *why;
    } cases[] = {
        {"lagrangian: (x'^2 + y'^2)/2 - (1 + cos(t)/5)*(x^2 + y^2)\n", "Not counted: time occurs in the Lagrangian or in a constraint; there may be more symmetries than the search for closed forms found"},
        {"lagrangian: (x'^2 + y'^2)/2\nforces: [\"x = -x*cos(t)\", \"y = -y*cos(t)\"]\n", "Not counted: time occurs in a force; "},
        {"lagrangian: (x'^2 + y'^2)/2\nconstraints: [\"x'^2 + y'^2 = 1\"]\n", "Not counted: a constraint is not linear in the velocities; "},
        {"lagrangian: (x'^2 + y'^2)/2 + (x'^2 + y'^2)^2/9\n", "Not counted: the Lagrangian is not quadratic in the velocities; "},
        {"lagrangian: (x'^2 + y'^2)/2 - (x^2 + y^2)/2\n", NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[400];
        snprintf(text, sizeof text, "name: own\ncoordinates: [{name: x, type: length}, {name: y, type: length}]\n%s", cases[i].rest);
        told t = tell(text);
        if (cases[i].why) {
            SAYS(TEXT(t), cases[i].why);
            SAYS(PAGE(t), "there may be more symmetries than the search for closed forms found");
        } else {
            IS_SILENT(TEXT(t), "Not counted");
        }
        done(&t);
    }
}

/* The fields' sum that a line "[e_1,e_4] = 2 e_2 - e_3" names, at a place. */
static void named_sum(const nh_action *g, const char *text, const double *E, double *out)
{
    size_t m = g->kinetic->m;
    memset(out, 0, m * sizeof *out);
    for (bool more = *text; more; more = *text == '+' || *text == '-') {
        double sign = 1, factor = 1, below = 1;
        for (; *text == ' ' || *text == '+' || *text == '-'; text++)
            if (*text == '-') sign = -sign;
        if (*text != 'e') factor = strtod(text, (char **)&text);
        if (*text == '/') below = strtod(text + 1, (char **)&text);
        text += strspn(text, " ");
        cr_assert(!strncmp(text, "e_", 2), "an unknown term: %.40s", text);
        size_t k = strtoul(text + 2, (char **)&text, 10) - 1;
        for (size_t s = 0; s < m; s++) out[s] += sign * factor / below * E[s + k * m];
        text += strspn(text, " ");
    }
}

/* The brackets that are printed are those of the fields, and minus the constants in JSON: compared at places. */
Test(reduce_statements, brackets_are_those_of_the_fields)
{
    static const char *const systems[] = {
        "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n",
        "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\n",
        "coordinates: [{name: a, type: angle}, {name: b, type: angle}]\nlagrangian: (a'^2 + sin(a)^2*b'^2)/2\ndomain: {a: [0.4, 2.6]}\n",
        "coordinates: [x, s]\nlagrangian: (x'^2 - s'^2)/2\n",
        "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/(2*y^2)\ndomain: {y: [0.4, 1.2]}\n",
        "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + (z' - x*y')^2)/2\n",
        "coordinates: [x, y, {name: h, type: angle}]\nlagrangian: (x'^2 + y'^2 + h'^2)/2\nconstraints: [\"y'*cos(h) = x'*sin(h)\"]\n",
    };
    for (size_t i = 0; i < sizeof systems / sizeof *systems; i++) {
        char file[300];
        snprintf(file, sizeof file, "name: own\n%s", systems[i]);
        told t = tell(file);
        const nh_group *group = t.r->all ? t.r->all : t.r->group;
        const nh_action *g = &group->action;
        const nh_kinetic *k = g->kinetic;
        size_t m = k->m, seen = 0;
        nh_ex bracket[12];
        double E[120], want[12], got[12];
        nh_action_values(g, k->place, E);
        for (size_t a = 0; a < g->d; a++)
            for (size_t b = a + 1; b < g->d; b++) {
                char label[80];
                snprintf(label, sizeof label, "[e_%zu,e_%zu] = ", a + 1, b + 1);
                const char *line = strstr(TEXT(t), label);
                nh_field_bracket(k, g->generator[a].component, g->generator[b].component, bracket);
                nh_kinetic_values(k, m, bracket, k->place, want);
                named_sum(g, line ? line + strlen(label) : "", E, got);
                seen += line != NULL;
                for (size_t s = 0; s < m; s++) {
                    double from_constants = 0;
                    for (size_t c = 0; c < g->d; c++) from_constants -= g->algebra.c[(a * g->d + b) * g->d + c] * E[s + c * m];
                    cr_expect(fabs(got[s] - want[s]) < 1e-9 && fabs(from_constants - want[s]) < 1e-9, "%s[e_%zu,e_%zu], %zu: %g, %g, printed %g", file, a + 1, b + 1, s, want[s], from_constants, got[s]);
                }
            }
        cr_expect(seen > 0, "no bracket is printed\n%s", file);
        done(&t);
    }
}
