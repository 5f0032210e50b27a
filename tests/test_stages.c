/* stages: brackets and equations by stages against reference values, the bracket itself, and the true accelerations. */
#include "oracle.h"
#include "reduced.h"
#include "reduced_sheet.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/linalg.h"
#include "base/text.h"
#include "reduction/group.h"
#include "reduction/poincare.h"
#include "reduction/subspace.h"
#include "system/sample.h"
#include "sweep.h"

/* ---- six chains of normal subgroups, three inner products each, as `reduce --equations` prints them ---- */

/* The group of the data as the configuration space: fields of left translations in the order of its basis, and a kinetic energy that they leave invariant. */
static const struct {
    const char *group, *coordinates, *lagrangian, *fields, *domain;
} GROUPS[] = {
    {"SE(3)", "p h s x y z",
     "(2*(h'*cos(s) + p'*sin(h)*sin(s))^2 + 3*(p'*sin(h)*cos(s) - h'*sin(s))^2 + 4*(p'*cos(h) + s')^2 + 2*(x'^2 + y'^2 + z'^2) + (sin(h)*sin(p)*x' - sin(h)*cos(p)*y' + cos(h)*z')^2)/2",
     "{h: cos(p), p: -sin(p)*cos(h)/sin(h), s: sin(p)/sin(h), y: -z, z: y}; {h: sin(p), p: cos(p)*cos(h)/sin(h), s: -cos(p)/sin(h), x: z, z: -x}; {p: 1, x: -y, y: x}; {x: 1}; {y: 1}; {z: 1}",
     "{h: [0.5, 2.1]}"},
    {"SE(2)xS^1", "h x y s", "(h'^2 + h'*s' + 2*s'^2 + 2*(x'*cos(h) + y'*sin(h))^2 + 3*(y'*cos(h) - x'*sin(h))^2)/2", "{h: 1, x: -y, y: x}; {x: 1}; {y: 1}; {s: 1}", "{}"},
    {"SE(2)", "h x y", "(h'^2 + 2*(x'*cos(h) + y'*sin(h))^2 + 3*(y'*cos(h) - x'*sin(h))^2)/2", "{h: 1, x: -y, y: x}; {x: 1}; {y: 1}", "{}"},
    {"Heisenberg", "x y z", "(x'^2 + x'*y' + 2*y'^2 + 3*(z' + y*x')^2)/2", "{x: 1}; {y: 1, z: -x}; {z: 1}", "{}"},
    {"unipotent4", "x12 x23 x34 x13 x24 x14",
     "(x12'^2 + 2*x23'^2 + 3*x34'^2 + (x13' - x12*x23')^2 + 2*(x24' - x23*x34')^2 + 3*(x14' - x12*x24' + (x12*x23 - x13)*x34')^2)/2",
     "{x12: 1, x13: x23, x14: x24}; {x23: 1, x24: x34}; {x34: 1}; {x13: 1, x14: x34}; {x24: 1}; {x14: 1}", "{}"},
};

typedef struct {
    reduced_sheet s;
    size_t d, blocks, block[10]; /* of each generator */
    double c[1000], lift[100];   /* as printed; lift[a + i * d]: e_a in H e_i */
} shown_chain;

/* The words of a list with separators of one kind, each inside a format. */
static void add_each(nh_text *to, const char *list, const char *separator, const char *format)
{
    char copy[2000];
    snprintf(copy, sizeof copy, "%s", list);
    for (char *word = strtok(copy, separator); word; word = strtok(NULL, separator)) nh_text_addf(to, format, word);
}

static shown_chain ask_for(const cJSON *each)
{
    const char *name = oracle_get(each, "group")->valuestring;
    size_t g = 0;
    while (g < sizeof GROUPS / sizeof *GROUPS && strncmp(name, GROUPS[g].group, strlen(GROUPS[g].group))) g++;
    cr_assert_lt(g, sizeof GROUPS / sizeof *GROUPS, "%s", name);
    shown_chain x = {.d = (size_t)cJSON_GetArraySize(oracle_get(each, "structure_constants"))};
    nh_text text, line;
    nh_text_init(&text);
    nh_text_init(&line);
    nh_text_add(&text, "name: group\ncoordinates:\n");
    add_each(&text, GROUPS[g].coordinates, " ", "  - {name: %s, type: number}\n");
    nh_text_addf(&text, "lagrangian: %s\ndomain: %s\nsymmetry:\n", GROUPS[g].lagrangian, GROUPS[g].domain);
    add_each(&text, GROUPS[g].fields, ";", "  - %s\n");
    nh_text_add(&line, " --chain ");
    for (const cJSON *b = oracle_get(each, "blocks")->child; b; b = b->next, x.blocks++)
        for (const cJSON *i = b->child; i; i = i->next) {
            x.block[i->valueint] = x.blocks;
            nh_text_addf(&line, "%s%d", i != b->child ? "," : x.blocks ? ";" : "", i->valueint + 1);
        }
    double metric[100];
    cr_assert_eq(oracle_flat(oracle_get(each, "metric"), metric), x.d * x.d);
    for (size_t i = 0; i < x.d; i++)
        for (size_t j = i; j < x.d; j++) nh_text_addf(&line, "%s%zu,%zu=%.17g", i + j ? ";" : " --inner ", i + 1, j + 1, metric[i + j * x.d]);
    x.s = reduced_from(name, nh_text_string(&text), 0, NULL, nh_text_string(&line), 0);
    nh_text_clear(&line);
    nh_text_clear(&text);
    return x;
}

/* The structure constants and the lifts H e_i. */
static void read_chain(shown_chain *x)
{
    size_t d = x->d;
    char label[90], of[40];
    cr_assert_eq(oracle_flat(oracle_get(oracle_get(x->s.root, "group"), "structure_constants"), x->c), d * d * d);
    for (size_t i = 0; i < d; i++)
        for (size_t a = 0; a < d; a++) {
            snprintf(label, sizeof label, "H_%zu e_%zu", x->block[i], i + 1);
            snprintf(of, sizeof of, "e_%zu", a + 1);
            x->lift[a + i * d] = shown_value(&x->s, "chain", label, of);
        }
}

/* sum_i H e_i parts_i over the blocks from..to-1 */
static void lifted(const shown_chain *x, const double *parts, size_t from, size_t to, double *out)
{
    for (size_t a = 0; a < x->d; a++) {
        out[a] = 0;
        for (size_t i = 0; i < x->d; i++)
            if (x->block[i] >= from && x->block[i] < to) out[a] += x->lift[a + i * x->d] * parts[i];
    }
}

/* The other way round; blocks stand one behind another. */
static void taken_apart(const shown_chain *x, const double *vector, double *parts)
{
    double rest[10], of[10];
    memcpy(rest, vector, x->d * sizeof *rest);
    for (size_t j = 0; j < x->blocks; j++) {
        for (size_t i = 0; i < x->d; i++)
            if (x->block[i] == j) parts[i] = rest[i];
        lifted(x, parts, j, j + 1, of);
        for (size_t a = 0; a < x->d; a++) rest[a] -= of[a];
    }
}

/* sign times the printed map "a" or "b" of x, y, added to out: y of block j for a_j, of the algebra for b_j. */
static void add_map(const shown_chain *x, char letter, double sign, size_t j, const double *u, const double *v, double *out)
{
    char label[90], of[40];
    for (size_t p = 0; p < x->d; p++)
        for (size_t q = 0; q < x->d; q++) {
            bool swapped = letter == 'a' && q < p;
            if (x->block[p] != j || p == q || (letter == 'a' ? x->block[q] != j : x->block[q] <= j) || u[p] * v[q] == 0) continue;
            snprintf(label, sizeof label, "%c_%zu(e_%zu,e_%zu)", letter, j, (swapped ? q : p) + 1, (swapped ? p : q) + 1);
            for (size_t a = 0; a < x->d; a++) {
                snprintf(of, sizeof of, "e_%zu", a + 1);
                out[a] += sign * (swapped ? -1 : 1) * u[p] * v[q] * shown_value(&x->s, "chain", label, of);
            }
        }
}

/* [sum_j H_j x_j, sum_j H_j y_j] with the printed maps [CendraDiaz2018, eq. 14]:
 * sum_j (H_j [x_j, y_j]_j - a_j(x_j, y_j) + b_j(x_j, sum_(k>j) H_k y_k) - b_j(y_j, sum_(k>j) H_k x_k)). */
static void shown_bracket(const shown_chain *x, const double *u, const double *v, double *parts)
{
    double sum[10] = {0}, quotient[10], of[10];
    for (size_t j = 0; j < x->blocks; j++) {
        for (size_t k = 0; k < x->d; k++) {
            quotient[k] = 0;
            for (size_t p = 0; p < x->d && x->block[k] == j; p++)
                for (size_t q = 0; q < x->d; q++)
                    if (x->block[p] == j && x->block[q] == j) quotient[k] += x->c[(p * x->d + q) * x->d + k] * u[p] * v[q];
        }
        lifted(x, quotient, j, j + 1, of);
        for (size_t a = 0; a < x->d; a++) sum[a] += of[a];
        add_map(x, 'a', -1, j, u, v, sum);
        lifted(x, v, j + 1, x->blocks, of);
        add_map(x, 'b', 1, j, u, of, sum);
        lifted(x, u, j + 1, x->blocks, of);
        add_map(x, 'b', -1, j, v, of, sum);
    }
    taken_apart(x, sum, parts);
}

/* beta' in parts, from the vertical equations by stages, with omega = sum_j H_j eta_j and mu from beta_j = mu H_j. */
static void shown_rates(shown_chain *x, const double *eta, const double *beta, double *out)
{
    size_t d = x->d;
    double chi[100], parts[100], omega[10], mu[10], nu[10], right[10], transposed[100], rcond;
    char label[60], of[40];
    lifted(x, eta, 0, x->blocks, omega);
    for (size_t i = 0; i < d; i++)
        for (size_t a = 0; a < d; a++) transposed[i + a * d] = x->lift[a + i * d];
    memcpy(mu, beta, d * sizeof *mu);
    cr_assert(nh_solve(d, transposed, 1, mu, &rcond));
    for (size_t p = 0; p < d; p++)
        for (size_t a = 0; a < d; a++) {
            snprintf(label, sizeof label, "chi_%zu", p + 1);
            snprintf(of, sizeof of, "e_%zu", a + 1);
            chi[a + p * d] = shown_value(&x->s, "connection", label, of);
        }
    for (size_t p = 0; p < d; p++) taken_apart(x, chi + p * d, parts + p * d);
    memcpy(nu, omega, d * sizeof *nu);
    cr_assert(nh_solve(d, chi, 1, nu, &rcond));
    for (size_t p = 0; p < d; p++) {
        snprintf(of, sizeof of, "nu_%zu", p + 1);
        x->s.value[own_name(&x->s, of)] = nu[p];
    }
    const cJSON *line, *term;
    memset(right, 0, sizeof right);
    cJSON_ArrayForEach(line, oracle_get(x->s.geometry, "by_stages")) {
        const char *chi_p = strstr(text_of(line, "label"), "chi_");
        cr_assert_not_null(chi_p);
        cJSON_ArrayForEach(term, oracle_get(line, "terms")) right[atoi(chi_p + 4) - 1] += value_of(&x->s, text_of(term, "coefficient")) * mu[atoi(text_of(term, "of") + 3) - 1];
    }
    for (size_t p = 0; p < d; p++)
        for (size_t i = 0; i < d; i++) transposed[p + i * d] = parts[i + p * d];
    memcpy(out, right, d * sizeof *out);
    cr_assert(nh_solve(d, transposed, 1, out, &rcond));
}

Test(stages, reference_values_as_printed, PLAIN_ONLY)
{
    cJSON *data = oracle_read("tests/data/stages_oracle.json");
    tally constants = {.what = "constants"}, bracket = {.what = "bracket"}, rates = {.what = "beta'"};
    double misprint = 0;
    for (const cJSON *each = oracle_get(data, "cases")->child; each; each = each->next) {
        static double want[1000], got[10], eta[10], other[10], beta[10];
        shown_chain x = ask_for(each);
        read_chain(&x);
        oracle_flat(oracle_get(each, "structure_constants"), want);
        tally_add(&constants, x.d * x.d * x.d, x.c, want, 0);
        oracle_flat(oracle_get(each, "eta"), eta);
        oracle_flat(oracle_get(each, "etabar"), other);
        oracle_flat(oracle_get(each, "beta"), beta);
        oracle_flat(oracle_get(each, "bracket"), want);
        shown_bracket(&x, eta, other, got);
        tally_add(&bracket, x.d, got, want, 0);
        oracle_flat(oracle_get(each, "betadot"), want);
        shown_rates(&x, eta, beta, got);
        tally_add(&rates, x.d, got, want, 0);
        oracle_flat(oracle_get(each, "betadot_printed_eq20"), want);
        for (size_t i = 0; i < x.d; i++) misprint = fmax(misprint, fabs(got[i] - want[i]));
        reduced_clear(&x.s);
    }
    tally_check(&constants, 1e-13, "stages");
    tally_check(&bracket, 1e-12, "stages");
    tally_check(&rates, 1e-12, "stages");
    cr_expect_gt(misprint, 1, "the misprinted equation 20 cannot be told from the right one");
    cJSON_Delete(data);
}

/* ---- chains of algebras ---- */

static nh_algebra euclidean(void) /* e1, e2 translations, e3 the turn, e4 a circle beside it */
{
    nh_algebra g = nh_algebra_create(4);
    g.c[(2 * 4 + 0) * 4 + 1] = 1, g.c[(0 * 4 + 2) * 4 + 1] = -1;
    g.c[(2 * 4 + 1) * 4 + 0] = -1, g.c[(1 * 4 + 2) * 4 + 0] = 1;
    return g;
}

Test(stages, chains_are_found_and_wrong_ones_refused)
{
    nh_algebra g = euclidean();
    size_t size[4], order[4];
    double metric[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    nh_error error = {0};
    nh_ideals chain;
    size_t blocks = nh_ideals_find(&g, size, order);
    cr_expect_eq(blocks, 3, "%zu blocks", blocks);
    must(nh_ideals_init(&chain, &g, blocks, size, order, metric, &error), &error, "the chain");
    nh_ideals_clear(&chain);
    size_t wrong_size[2] = {2, 2}, wrong[4] = {0, 1, 2, 3}; /* the turn and the circle are no ideal */
    cr_expect(!nh_ideals_init(&chain, &g, 2, wrong_size, wrong, metric, &error));
    cr_expect(strstr(error.what, "[e1, e3] has a component along e2"), "%s", error.what);
    nh_algebra_clear(&g);
}

/* se(2) > R^2 > R: the last is an ideal of R^2 only. Bracket and equations in parts are those of the algebra. */
Test(stages, subnormal_chains)
{
    nh_algebra g = euclidean();
    size_t size[4] = {1, 1, 1, 1}, order[4] = {2, 3, 0, 1}, pair[3] = {2, 1, 1};
    double metric[16] = {3, 0.2, 0.5, -0.7, 0.2, 2, 0.3, 0.4, 0.5, 0.3, 4, 0.1, -0.7, 0.4, 0.1, 2}, eta[4] = {0.7, -1.1, 0.4, 0.9}, other[4] = {1.3, 0.2, -0.8, 0.6};
    double x[4], y[4], bracket[4], parts[4], got[4], beta[4], mu[4] = {0.3, -0.5, 1.2, 0.8};
    nh_error error = {0};
    for (int k = 0; k < 2; k++) {
        nh_ideals chain;
        must(nh_ideals_init(&chain, &g, k ? 3 : 4, k ? pair : size, order, metric, &error), &error, "the chain");
        nh_ideals_bracket(&chain, eta, other, got);
        nh_ideals_join(&chain, eta, x);
        nh_ideals_join(&chain, other, y);
        nh_algebra_bracket(&g, x, y, bracket);
        nh_ideals_split(&chain, bracket, parts);
        for (size_t i = 0; i < 4; i++) cr_expect_float_eq(got[i], parts[i], 1e-14, "part %zu: %g, %g", i, got[i], parts[i]);
        nh_ideals_split_covector(&chain, mu, beta);
        nh_ideals_euler_poincare(&chain, eta, beta, got);
        double left = 0, right = 0; /* sum_i got_i other_i = <mu, [eta, other]> */
        for (size_t i = 0; i < 4; i++) left += got[i] * other[i], right += mu[i] * bracket[i];
        cr_expect_float_eq(left, right, 1e-14);
        nh_ideals_clear(&chain);
    }
    size_t wrong[4] = {0, 2, 1, 3}, three[2] = {1, 3};
    cr_expect(!nh_ideals_init(&(nh_ideals){0}, &g, 2, three, wrong, metric, &error), "the turn makes of e2 e1");
    nh_algebra_clear(&g);
}

static void equations(const char *name, nh_system *system, size_t n, const size_t *index, size_t blocks, const size_t *size, const size_t *order, size_t dimension, double tolerance)
{
    nh_error error = {0};
    nh_options options;
    nh_options_default(&options);
    reducible x = reducible_make(system, 11, &error);
    nh_group *g = nh_group_find(x.kinetic, &options, &error);
    must(g != NULL, &error, name);
    double *t = nh_alloc_array(g->action.d * n, sizeof *t), *metric = nh_alloc_array(n * n, sizeof *metric), y0[10];
    uint64_t seed = 2385;
    for (size_t i = 0; i < n; i++) t[index[i] + i * g->action.d] = 1;
    nh_action action;
    nh_action_sub(&action, &g->action, n, t, &options);
    must(nh_action_check(&action, &options, &error), &error, name);
    size_t shape[20], along[20], found_size[20], found_order[20];
    nh_slice slice;
    nh_ideals chain;
    nh_poincare p;
    nh_slice_choose(&action, shape, along);
    for (size_t a = 0; a < n; a++) y0[a] = x.kinetic->place[along[a]];
    nh_slice_init(&slice, &action, shape, along, y0);
    for (size_t i = 0; i < n; i++) /* any inner product */
        for (size_t j = 0; j <= i; j++) metric[i + j * n] = metric[j + i * n] = 0.4 * (2 * nh_random(&seed) - 1) + (i == j ? (double)n : 0);
    if (!blocks) blocks = nh_ideals_find(&action.algebra, found_size, found_order), size = found_size, order = found_order;
    must(nh_ideals_init(&chain, &action.algebra, blocks, size, order, metric, &error), &error, name);
    double off = 0;
    for (int own = 0; own < 2; own++) { /* lifts orthogonal to S for that inner product, and for the kinetic energy */
        must(nh_poincare_check(&p, &slice, &chain, own ? NULL : metric, &options, &error), &error, name);
        if (!own) off = fmax(fmax(p.one_vertical, p.one_horizontal), fmax(p.stages_vertical, p.stages_horizontal));
    }
    double worst = fmax(fmax(p.one_vertical, p.one_horizontal), fmax(fmax(p.stages_vertical, p.stages_horizontal), fmax(p.bracket, p.euler_poincare)));
    if (getenv("NHSYM_TEST_FIGURES"))
        printf("%-26s %zu blocks, S of %zu, |B| %.2g: one stage %.1e %.1e, by stages %.1e %.1e, bracket %.1e\n", name, blocks, p.dimension, p.curvature, p.one_vertical, p.one_horizontal,
               p.stages_vertical, p.stages_horizontal, p.bracket);
    cr_expect(worst < tolerance && off < tolerance, "%s: %g, %g", name, worst, off);
    cr_expect_eq(p.dimension, dimension, "%s: S has dimension %zu", name, p.dimension);
    cr_expect(p.places >= 8);
    nh_ideals_clear(&chain);
    nh_action_clear(&action);
    nh_group_free(g);
    reducible_clear(&x);
    nh_free(t);
    nh_free(metric);
}

/* The constraint does not split along the chain in most of these. */
Test(stages, equations_agree_with_the_accelerations, PLAIN_ONLY)
{
    nh_error error = {0};
    static const size_t all[] = {0, 1, 2, 3, 4, 5}, se2[] = {0, 1, 3}, circle_first[] = {0, 1, 2}, ball[] = {0, 1, 2}, one_two[] = {1, 2}, turn_first[] = {2, 0, 1}, psi_first[] = {0, 1, 2};
    equations("snakeboard, SE(2)", nh_system_parse("snakeboard", SNAKEBOARD, 0, NULL, &error), 3, se2, 2, one_two, turn_first, 1, 1e-11);
    equations("snakeboard, all", nh_system_parse("snakeboard", SNAKEBOARD, 0, NULL, &error), 4, all, 0, NULL, NULL, 2, 1e-11);
    equations("crane, all", nh_system_parse("crane", CRANE, 0, NULL, &error), 6, all, 0, NULL, NULL, 2, 1e-11);
    equations("disk, S^1 x R^2", nh_system_parse("disk", DISK, 0, NULL, &error), 3, circle_first, 2, one_two, psi_first, 1, 1e-11);
    equations("disk, all", nh_system_parse("disk", DISK, 0, NULL, &error), 4, all, 0, NULL, NULL, 2, 1e-11);
    equations("Chaplygin ball", nh_system_read("systems/chaplygin_ball.yaml", 0, NULL, &error), 3, ball, 0, NULL, NULL, 1, 1e-11);
    equations("cart, all", nh_system_parse("cart", CART, 0, NULL, &error), 5, all, 0, NULL, NULL, 2, 1e-11);
    equations("cart, SE(2)", nh_system_parse("cart", CART, 0, NULL, &error), 3, (size_t[]){0, 1, 4}, 0, NULL, NULL, 0, 1e-11);
    equations("top", nh_system_read("systems/euler_top.yaml", 0, NULL, &error), 3, all, 0, NULL, NULL, 3, 1e-11);
}
