/* linear motion: equations q'' = -B q with constant coefficients have the quadratic integrals that Lyapunov's equation gives, exactly, for any
 * number of coordinates, and waves, with powers of t where a rate has too few eigenvectors. */
#include "mechanics.h"
#include "scratch.h"
#include "sweep.h"

#include <math.h>

#include "commands/analyze.h"
#include "exact/invariant_forms.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "typed.h"

/* ---- forms ---- */

typedef struct {
    nh_arena *arena;
    nh_dag *dag;
    size_t n;
    nh_ex z[12], A[144], parameter[2];
} matrix;

static matrix matrix_of(size_t n)
{
    matrix a = {.arena = nh_arena_create(), .n = n};
    a.dag = nh_dag_create();
    char name[24];
    for (size_t i = 0; i < n; i++) {
        snprintf(name, sizeof name, "z%zu", i);
        a.z[i] = nh_symbol(a.dag, name);
    }
    a.parameter[0] = nh_symbol(a.dag, "m");
    a.parameter[1] = nh_symbol(a.dag, "k");
    for (size_t i = 0; i < n * n; i++) a.A[i] = nh_int(a.dag, 0);
    return a;
}

/* How many forms there are; each is put into the equations, and the last must not be a combination of the others (they have different terms). */
static size_t forms_of(matrix *a, nh_ex c)
{
    nh_dag *d = a->dag;
    nh_invariant_question q = {d, a->n, 2, a->z, a->A, c, a->parameter};
    nh_invariant_forms found = nh_invariant_forms_of(a->arena, &q);
    cr_assert_null(found.obstacle);
    for (size_t k = 0; k < found.count; k++) {
        nh_ex rate = nh_mul(d, c, found.form[k]);
        for (size_t i = 0; i < a->n; i++)
            for (size_t j = 0; j < a->n; j++)
                rate = nh_add(d, rate, nh_product(d, 3, (nh_ex[]){nh_diff(d, found.form[k], a->z[i]), a->A[i * a->n + j], a->z[j]}));
        cr_expect_eq(nh_normal_is_zero(d, rate, 0), NH_ZERO, "form %zu", k);
        cr_expect_neq(nh_normal_is_zero(d, found.form[k], 0), NH_ZERO);
        for (size_t j = 0; j < k; j++) cr_expect_neq(found.form[j], found.form[k]);
    }
    return found.count;
}

/* q' = w, w' = -B q - D w */
static void set_second_order(matrix *a, const char *const *B, const char *const *D)
{
    size_t n = a->n / 2;
    for (size_t i = 0; i < n; i++) {
        a->A[(n + i) * a->n + i] = nh_int(a->dag, 1);
        for (size_t j = 0; j < n; j++) {
            a->A[i * a->n + n + j] = nh_neg(a->dag, ex(a->dag, B[i * n + j]));
            a->A[i * a->n + j] = nh_neg(a->dag, ex(a->dag, D[i * n + j]));
        }
    }
}

/* The dimension is the number of pairs of eigenvalues with the sum -c, for matrices that are diagonal; Jordan's block of two pairs has two. */
Test(linear_motion, forms_are_counted_by_eigenvalues)
{
    static const struct {
        const char *B[9], *D[9];
        size_t n, count;
        const char *c;
    } row[] = {
        {{"k/m"}, {"0"}, 1, 1, "0"},                                              /* an oscillator: its energy */
        {{"k/m"}, {"1/m"}, 1, 0, "0"},                                            /* with drag: none */
        {{"k/m"}, {"1/m"}, 1, 1, "1/m"},                                          /* but one that decays */
        {{"k", "0", "0", "k"}, {"0", "0", "0", "0"}, 2, 4, "0"},                  /* u(2) */
        {{"k", "0", "0", "3*k"}, {"0", "0", "0", "0"}, 2, 2, "0"},
        {{"k", "0", "0", "4*k"}, {"0", "0", "0", "0"}, 2, 2, "0"},                /* 1 : 2 has its third integral at degree 3 */
        {{"k", "k", "0", "k"}, {"0", "0", "0", "0"}, 2, 2, "0"},                  /* Jordan's block */
        {{"k", "0", "0", "k"}, {"0", "m", "-m", "0"}, 2, 2, "0"},                 /* a magnetic field */
        {{"0", "0", "0", "0"}, {"0", "0", "0", "0"}, 2, 4, "0"},                  /* free: w w and q1 w2 - q2 w1 */
        {{"2*k/m", "-k/m", "0", "-k/m", "2*k/m", "-k/m", "0", "-k/m", "2*k/m"}, {"0", "0", "0", "0", "0", "0", "0", "0", "0"}, 3, 3, "0"},
        {{"k", "0", "0", "0", "k", "0", "0", "0", "k"}, {"0", "0", "0", "0", "0", "0", "0", "0", "0"}, 3, 9, "0"}};
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        matrix a = matrix_of(2 * row[i].n);
        set_second_order(&a, row[i].B, row[i].D);
        size_t count = forms_of(&a, ex(a.dag, row[i].c));
        cr_expect_eq(count, row[i].count, "row %zu: %zu", i, count);
        nh_dag_free(a.dag);
        nh_arena_free(a.arena);
    }
}

/* ---- systems ---- */

static nh_analysis *ask(const char *text)
{
    char path[SCRATCH];
    nh_error error = {0};
    cr_assert(scratch_text(path, text));
    nh_request request = {.system_path = path};
    nh_options_default(&request.options);
    request.options.until = 0.5; /* motions are none of the question */
    nh_analysis *r = nh_analysis_create(&request, &error);
    cr_assert_not_null(r, "%s", error.what);
    remove(path);
    return r;
}

/* Of second degree in the velocities, without t, and proved for all parameters. */
static size_t exact_squares(const nh_analysis *r)
{
    size_t count = 0;
    for (size_t k = 0; k < r->list->count; k++)
        count += r->list->found[k].proof.proved && r->list->found[k].proof.all_parameters && !nh_depends(r->question->model->dag, r->list->found[k].phi, r->question->system->t);
    return count;
}

/* n equal masses between springs: frequencies 2 sqrt(k/m) sin(j pi/(2 n + 2)) have no short names, the quadratic integrals need none, a constant
 * force included.  Drag at one end takes them all and leaves complex rates, the search for whose names ends after little work. */
Test(linear_motion, chains_have_their_quadratic_integrals, PLAIN_ONLY)
{
    enum { n = 5 };
    static const struct {
        const char *weight, *forces;
        size_t squares;
    } row[] = {{" + m*g*x", "", n}, {"", "forces: [\"x1 = -c*x1'\"]\n", 0}};
    for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
        if (!sweep_tries(k, 2, 2)) continue;
        nh_text text;
        nh_text_init(&text);
        nh_text_add(&text, "name: c\nparameters: [{name: k, value: 2.1}, {name: m, value: 1.3}, {name: g, value: 9.8}, {name: c, value: 0.3}]\ncoordinates: [x1");
        for (size_t i = 2; i <= n; i++) nh_text_addf(&text, ", x%zu", i);
        nh_text_add(&text, "]\nlagrangian: m*x1'^2/2 - k*x1^2/2");
        for (size_t i = 2; i <= n; i++) nh_text_addf(&text, " + m*x%zu'^2/2 - k*(x%zu - x%zu)^2/2", i, i, i - 1);
        for (size_t i = 1; i <= n && *row[k].weight; i++) nh_text_addf(&text, "%s%zu", row[k].weight, i);
        nh_text_addf(&text, " - k*x%d^2/2\n%s", n, row[k].forces);
        nh_analysis *r = ask(nh_text_string(&text));
        cr_expect_eq(exact_squares(r), row[k].squares, "row %zu: %zu", k, exact_squares(r));
        cr_expect_eq(r->list->independent, 2 * n, "row %zu: %zu", k, r->list->independent);
        nh_analysis_free(r);
        nh_text_clear(&text);
    }
}

/* Of three masses the frequencies are roots, sqrt((2 + sqrt(2)) k/m): waves are proved for all parameters, beside the quadratic integrals. */
Test(linear_motion, waves_of_few_masses_have_roots_as_rates, PLAIN_ONLY)
{
    nh_analysis *r = ask("name: c\nparameters: [{name: m, value: 1.3}, {name: k, value: 2.1}]\ncoordinates: [x, y, z]\n"
                         "lagrangian: m/2*(x'^2 + y'^2 + z'^2) - k/2*(x^2 + (y - x)^2 + (z - y)^2 + z^2)\n");
    cr_expect_eq(r->list->independent, 6);
    for (size_t i = 0; i < r->list->count; i++) cr_expect(r->list->found[i].proof.proved && r->list->found[i].proof.all_parameters, "%zu", i);
    nh_analysis_free(r);
}

/* Two eigenvectors for four rates of two values: waves alone give half of what there is. */
Test(linear_motion, jordan_blocks_have_powers_of_time, PLAIN_ONLY)
{
    static const char *const text[] = {
        "name: j\ncoordinates: [x, y]\nlagrangian: \"x'*y' - x*y - y^2/2\"\n",
        "name: j\nparameters: [{name: w, value: 1.7}]\ncoordinates: [x, y]\nlagrangian: \"x'*y' - w^2*x*y - y^2/2\"\n",
        "name: j\ncoordinates: [a, b, c, d]\nlagrangian: \"a'*b' - a*b - b^2/2 + c'*d' - c*d - d^2/2\"\n",
        /* a rate that rounding splits by its cube root; a drive of the frame's own rate, which brings t^2 */
        "name: j\nparameters: {k: 0.7}\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - k*(x^2 + y^2 + z^2)/2\nforces: [\"y = x\", \"z = y\"]\n",
        "name: j\nparameters: {w: 0.6}\ncoordinates: [x, y]\n"
        "lagrangian: (x'^2 + y'^2)/2 + w*(x*y' - y*x') + w^2*(x^2 + y^2)/2 - x*cos(w*t) + y*sin(w*t)\n"};
    for (size_t k = 0; k < sizeof text / sizeof *text; k++) {
        nh_analysis *r = ask(text[k]);
        cr_expect_eq(r->list->independent, r->question->local_maximum, "%s: %zu", text[k], r->list->independent);
        for (size_t i = 0; i < r->list->count; i++) cr_expect(r->list->found[i].proof.all_parameters);
        nh_analysis_free(r);
    }
}

/* In resonance the functions of t that an ansatz needs are nearly dependent on the interval of the samples: the integral of the drive is exact.  Also without
 * resonance, with damping, with real eigenvalues, and with two equal ones, which this way does not solve. */
Test(linear_motion, drives_are_integrated)
{
    static const char *const text[] = {"w^2*x^2/2 - f*x*cos(w*t)\n", "w^2*x^2/2 - f*x*cos(n*t)\nforces: [\"x = -2*c*x'\"]\n", "-w^2*x^2/2 - f*x*exp(w*t)\n",
                                       "w^2*x^2/2 - f*x*t^2*sin(w*t)\n", "w^2*x^2/2 - f*x*exp(-w*t)\nforces: [\"x = -2*w*x'\"]\n"};
    for (size_t i = 0; i < sizeof text / sizeof *text; i++) {
        char all[400], path[SCRATCH];
        snprintf(all, sizeof all, "name: driven\nparameters: {w: 0.8, f: 0.3, n: 0.7, c: 0.2}\ncoordinates: [x]\nlagrangian: x'^2/2 - (%s", text[i]);
        char *end = strchr(strstr(all, "lagrangian"), '\n');
        memmove(end + 1, end, strlen(end) + 1);
        *end = ')';
        FILE *out = scratch_open(path);
        cr_assert(out && fputs(all, out) >= 0 && fclose(out) == 0);
        nh_error error = {0};
        nh_request q = {.system_path = path};
        nh_options_default(&q.options);
        nh_analysis *r = nh_analysis_create(&q, &error);
        remove(path);
        cr_assert(r, "%s", error.what);
        size_t proved = 0;
        for (size_t k = 0; k < r->list->count; k++) proved += r->list->found[k].independence == NH_INDEPENDENT && r->list->found[k].proof.all_parameters;
        cr_expect_eq(proved, 2, "%s: %zu", text[i], proved);
        nh_analysis_free(r);
    }
}

/* A gyroscope's force, damping and a follower force: the root of a complex number by roots of real ones, whatever the sign of its real part. */
Test(linear_motion, complex_coordinates, WHOLE_ONLY)
{
    static const char *const more[] = {"- a*(x^2 + y^2)/2\nforces: [\"x = -c*x'\", \"y = -c*y'\"]\n", "+ a*(x^2 + y^2)/2\nforces: [\"x = -c*x'\", \"y = -c*y'\"]\n",
                                       "- a*(x^2 + y^2)/2\nforces: [\"x = -c*y\", \"y = c*x\"]\n"};
    for (size_t k = 0; k < sizeof more / sizeof *more; k++) {
        char text[400];
        snprintf(text, sizeof text, "name: g\nparameters: {a: 0.4, c: 0.2, w: 1.3}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + w*(x*y' - y*x')/2 %s", more[k]);
        nh_analysis *r = ask(text);
        size_t proved = 0;
        for (size_t i = 0; i < r->list->count; i++) proved += r->list->found[i].independence == NH_INDEPENDENT && r->list->found[i].proof.all_parameters;
        cr_expect_eq(proved, 4, "%zu: %zu", k, proved);
        nh_analysis_free(r);
    }
}

/* ---- linear equations that the coordinates hide ---- */

#define POLAR "coordinates: [{name: r, type: length}, {name: f, type: angle}]\ndomain: {r: [0.4, 1.4]}\nlagrangian: (r'^2 + r^2*f'^2)/2 "
#define SPACE "coordinates: [{name: r, type: length}, {name: h, type: angle}, {name: f, type: angle}]\ndomain: {r: [0.4, 1.4], h: [0.4, 1.2]}\n" \
              "lagrangian: (r'^2 + r^2*h'^2 + r^2*sin(h)^2*f'^2)/2 "

/* An oscillator with drag, in a magnetic field, driven, seen from a turning frame with its own drive, with two bodies, in space; a
 * saddle that turns (words with functions of t); also by the square, the exponential
 * and the logarithm of a coordinate.  Each had series, or numbers, or two fewer, or took a minute. */
Test(linear_motion, functions_of_the_coordinates, PLAIN_ONLY)
{
    static const char *const text[] = {
        "parameters: {c: 0.3, k: 0.5}\n" POLAR "- k*r^2/2\nforces: [\"r = -c*r'\", \"f = -c*r^2*f'\"]\n",
        "parameters: {b: 0.7, k: 0.5}\n" POLAR "+ b*r^2*f'/2 - k*r^2/2\n",
        "parameters: {e: 0.3, w: 0.7}\n" POLAR "- r^2/2 - e*r*cos(f)*cos(w*t)\n",
        "parameters: {w: 0.3, g: 0.7}\n" POLAR "+ r^2*f'*w + r^2*w^2/2 - g*r*cos(f + w*t)\n",
        "parameters: {b: 0.2, k: 0.3}\n" SPACE "+ b*r^2*sin(h)^2*f'/2 - k*r^2/2\n",
        "parameters: {k: 0.2}\ncoordinates: [{name: r, type: length}, {name: f, type: angle}, {name: s, type: length}, {name: g, type: angle}]\n"
        "domain: {r: [0.4, 1.2], s: [0.5, 1.3]}\nlagrangian: (r'^2 + r^2*f'^2 + s'^2 + s^2*g'^2)/2 - k*(r^2 + s^2 - 2*r*s*cos(f - g))/2\n",
        "parameters: {k: 0.6, W: 0.7}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - k/2*((x^2 - y^2)*cos(2*W*t) + 2*x*y*sin(2*W*t))\n",
        "parameters: {k: 0.2}\ncoordinates: [u, v]\nlagrangian: (2*u*u' + v')^2/2 + v'^2/2 - k*(u^2 + v)^2/2 - v^2/2\ndomain: {u: [0.4, 1.2], v: [0.4, 1.2]}\n",
        "parameters: {k: 0.2}\ncoordinates: [u, v]\nlagrangian: exp(2*u)*u'^2/2 + v'^2/2 - k*exp(2*u)/2 - v*exp(u)/5 - v^2/2\n",
        "parameters: {k: 0.2}\ncoordinates: [u, v]\nlagrangian: u'^2/(2*u^2) + v'^2/2 - k*log(u)^2/2 - v*log(u)/5 - v^2/2\ndomain: {u: [0.4, 2]}\n"};
    for (size_t k = 0; k < sizeof text / sizeof *text; k++) {
        if (!sweep_tries(k, 2, 10)) continue;
        char whole[600];
        snprintf(whole, sizeof whole, "name: hidden\n%s", text[k]);
        nh_analysis *r = ask(whole);
        size_t proved = 0;
        for (size_t i = 0; i < r->list->count; i++) proved += r->list->found[i].independence == NH_INDEPENDENT && r->list->found[i].proof.all_parameters;
        cr_expect_eq(proved, r->question->local_maximum, "%s: %zu of %zu", text[k], proved, r->question->local_maximum);
        nh_analysis_free(r);
    }
}
