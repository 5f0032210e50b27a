/* velocity_turn: two velocities that turn along one coordinate have two linear currents, by an integral that is elementary or elliptic; with a potential there
 * are none. */
#include "mechanics.h"
#include "scratch.h"
#include "sweep.h"

#include "commands/analyze.h"
#include "graph/print.h"

#define SKATES(M, MORE)                                                                                                                                          \
    "name: skates\nparameters: {m: 1, I: 0.3, M: " M ", J: 0.2, a: 0.4, b: 0.5, k: 0.7}\n"                                                                      \
    "bodies:\n  - {name: one, mass: m, inertia: I}\n  - {name: two, mass: M, inertia: J, center: [-b, 0, 0]}\n"                                                 \
    "joints:\n  - {type: planar, child: one, axis: z, coordinates: [x, y, h]}\n  - {type: revolute, parent: one, child: two, at: [-a, 0, 0], axis: z, coordinates: [q]}\n" \
    "wheels:\n  - {type: knife-edge, body: one, axis: y}\n  - {type: knife-edge, body: two, at: [-b, 0, 0], axis: y}\n" MORE

static nh_analysis *analysis_of(const char *text)
{
    char path[SCRATCH];
    FILE *out = scratch_open(path);
    cr_assert(out && fputs(text, out) >= 0 && fclose(out) == 0);
    nh_error error = {0};
    nh_request q = {.system_path = path};
    nh_options_default(&q.options);
    q.options.max_seconds = 1e6; /* the same on every machine */
    nh_analysis *r = nh_analysis_create(&q, &error);
    remove(path);
    cr_assert(r, "%s", error.what);
    return r;
}

/* So many independent currents, all proved for all parameters; the last one contains these words. */
static void expect(const char *text, size_t currents, const char *word)
{
    nh_analysis *r = analysis_of(text);
    size_t proved = 0;
    bool there = !word;
    for (size_t k = 0; k < r->list->count; k++) {
        char *shown = nh_print_string(r->question->model->dag, r->list->found[k].phi);
        proved += r->list->found[k].independence == NH_INDEPENDENT && r->list->found[k].proof.all_parameters;
        there |= word && strstr(shown, word);
        nh_free(shown);
    }
    cr_expect_eq(proved, currents, "%zu of %zu", proved, currents);
    cr_expect(there, "no current contains %s", word);
    nh_analysis_free(r);
}

Test(velocity_turn, hinged_skates, PLAIN_ONLY) { expect(SKATES("0.9", ""), 2, "elliptic_pi"); }

/* J = M b^2: the root under the integral is a constant for these values. */
Test(velocity_turn, where_the_root_is_a_constant, WHOLE_ONLY) { expect(SKATES("0.8", ""), 2, "elliptic_pi"); }

/* Two equal links, each with a skate at its middle: the angle between them changes by itself, so that all is elementary, also the heading and the time. */
Test(velocity_turn, equal_links, WHOLE_ONLY)
{
    static const char text[] =
        "name: links\nparameters: {m: 1, J: 0.2, l: 0.5}\ncoordinates: [x, y, {name: f, type: angle}, {name: u, type: angle}]\n"
        "lagrangian: m/2*(x'^2+y'^2)+J*f'^2/2 + m/2*((x'-l*sin(f)*f'-l*sin(f+u)*(f'+u'))^2+(y'+l*cos(f)*f'+l*cos(f+u)*(f'+u'))^2)+J*(f'+u')^2/2\n"
        "constraints: [\"x'*sin(f) = y'*cos(f)\", \"x'*sin(f+u) - y'*cos(f+u) = l*f'*cos(u) + l*(f'+u')\"]\n";
    expect(text, 4, "t*u'");
}

Test(velocity_turn, with_a_spring_there_is_none, WHOLE_ONLY) { expect(SKATES("0.9", "lagrangian: -k*q^2/2\n"), 1, NULL); }

/* With numbers in place of the parameters.  With one velocity as the first the root of its inertia jumps at q = 0, with the other one it does not. */
Test(velocity_turn, numbers_as_parameters, WHOLE_ONLY)
{
    static const char text[] =
        "name: skates\ncoordinates: [x, y, {name: h, type: angle}, {name: q, type: angle}]\nlagrangian: (x'^2 + y'^2)/2 + h'^2/8 + (h' + q')^2/4\n"
        "constraints: [y'*cos(h) = x'*sin(h), y'*cos(h + q) - x'*sin(h + q) = h' + q' + h'*cos(q)]\n";
    nh_analysis *r = analysis_of(text);
    size_t proved = 0;
    for (size_t k = 0; k < r->list->count; k++) proved += r->list->found[k].independence == NH_INDEPENDENT && r->list->found[k].proof.proved;
    cr_expect_geq(proved, 2);
    nh_analysis_free(r);
}
