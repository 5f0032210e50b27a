/* force_potential: forces that have a potential give a current, the energy without it, also where the potential is not
 * single-valued or holds for one direction of the motion; others give none. */
#include "mechanics.h"
#include "scratch.h"

#include "commands/analyze.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "integrals/force_potential.h"

typedef struct {
    mechanics x;
    nh_points *points;
} scene;

static scene scene_of(const char *text)
{
    nh_error error = {0};
    scene s = {.x = mechanics_of_text(text, NH_CHART_AUTO)};
    s.points = nh_points_create(s.x.model, 60, 1, 1, &error);
    must(s.points != NULL, &error, text);
    return s;
}

static void scene_end(scene *s)
{
    nh_points_free(s->points);
    mechanics_clear(&s->x);
}

#define PLANE "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n"
#define SPACE "parameters: {a: 2, b: 0.7}\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\n"

/* dU/dq^i = Q_i, by normal forms */
Test(force_potential, its_derivatives_are_the_forces)
{
    static const char *closed[] = {
        PLANE "forces: [x = 3*x^2*y, y = x^3 - 2*y]\n",
        PLANE "forces: [\"x = -y/(x^2 + y^2)\", \"y = x/(x^2 + y^2)\"]\n",
        PLANE "forces: [\"x = -x/(x^2 + y^2)^2\", \"y = -y/(x^2 + y^2)^2\"]\n",
        PLANE "forces: [\"x = y*exp(x*y)\", \"y = x*exp(x*y) + cos(y)\"]\n",
        PLANE "forces: [\"y = 1/(1 + y^2)\"]\n",
        SPACE "forces: [\"x = a*y*z\", \"y = a*x*z + b/y\", z = a*x*y]\ndomain: {y: [0.5, 2]}\n",
        SPACE "forces: [\"x = -a*x/(x^2 + y^2 + z^2 + b^2)\", \"y = -a*y/(x^2 + y^2 + z^2 + b^2)\", \"z = -a*z/(x^2 + y^2 + z^2 + b^2)\"]\n",
        PLANE "forces: [\"x = -0.3*sign(x')\", \"y = -x'/abs(x') * 0 - y\"]\n",
        "coordinates: [x]\nlagrangian: x'^2/2\nforces: [\"x = -x'/abs(x') - x*abs(x')/x'\"]\n",
    };
    for (size_t i = 0; i < sizeof closed / sizeof *closed; i++) {
        scene s = scene_of(closed[i]);
        nh_dag *d = s.x.model->dag;
        nh_ex U = nh_force_potential(s.x.model, s.points, 0);
        cr_expect(U, "no potential: %s", closed[i]);
        double rest[64];
        for (size_t k = 0; U && k < s.x.model->m; k++) {
            nh_ex error = nh_sub(d, nh_diff(d, U, s.x.system->coordinate[k].q), s.x.system->force[k]);
            nh_points_evaluate(s.points, s.x.model, 1, &error, rest);
            for (size_t j = 0; j < s.points->count; j++) cr_expect_lt(fabs(rest[j]), 1e-12, "%s", closed[i]);
        }
        scene_end(&s);
    }
}

Test(force_potential, other_forces_have_none)
{
    static const char *open[] = {
        PLANE "forces: [x = y, y = 2*x]\n",
        PLANE "forces: [x = -y, y = x]\n",
        PLANE "forces: [x = -x']\n",
        PLANE "forces: [\"x = -x'/sqrt(x'^2 + y'^2)\", \"y = -y'/sqrt(x'^2 + y'^2)\"]\n",
        PLANE "forces: [x = sin(t)]\n",
        PLANE,
    };
    for (size_t i = 0; i < sizeof open / sizeof *open; i++) {
        scene s = scene_of(open[i]);
        cr_expect_eq(nh_force_potential(s.x.model, s.points, 0), 0u, "%s", open[i]);
        scene_end(&s);
    }
}

/* The current, proved, for all motions or in a region; and complete as far as it is counted. */
Test(force_potential, the_energy_without_it_is_a_current)
{
    static const struct {
        const char *text;
        const char *region;
    } row[] = {
        {"parameters: {a: 2}\n" PLANE "forces: [\"x = -a*y/(x^2 + y^2)\", \"y = a*x/(x^2 + y^2)\"]\n", "on each side of y = 0, where it jumps"},
        {"parameters: {m: 1.2, k: 5, mu: 0.3}\ncoordinates: [x]\nlagrangian: m/2*x'^2 - k/2*x^2\nforces: [\"x = -mu*m*sign(x')\"]\n",
         "on each side of x' = 0, where it jumps"},
    };
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        char path[SCRATCH];
        nh_error error = {0};
        cr_assert(scratch_text(path, row[i].text));
        nh_request request = {.system_path = path};
        nh_options_default(&request.options);
        nh_analysis *r = nh_analysis_create(&request, &error);
        remove(path);
        cr_assert_not_null(r, "%s", error.what);
        bool found = false;
        for (size_t k = 0; k < r->list->pieces; k++)
            found |= r->list->piece[k].proof.proved && !strcmp(r->list->piece[k].region, row[i].region);
        cr_expect(found, "%s: no proved current %s", row[i].text, row[i].region);
        cr_expect_geq(r->completeness[NH_COMPLETE_IN_COORDINATES].degree, 2u, "%s", row[i].text);
        nh_analysis_free(r);
    }
}
