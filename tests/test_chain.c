/* Symmetries of the metric of open chains, joint by joint: the crane's numbers, and every field found leaves the metric alone. */
#include "chain.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "mechanics.h"
#include "reduction/chain.h"

/* The largest component of L_xi K = xi(K_ij) + K_sj d_i xi^s + K_is d_j xi^s over random positions, relative to that of K. */
static double change_of_metric(const nh_system *s, const nh_ex *xi)
{
    size_t m = s->coordinates;
    nh_dag *d = s->dag;
    const nh_ex *symbols, *K = s->chain->K;
    const double *values;
    nh_ex in[64], *e = nh_alloc_array(2 * m * m, sizeof *e);
    double q[64], *out = nh_alloc_array(2 * m * m, sizeof *out), worst = 0, size = 0;
    uint64_t seed = 77;
    for (size_t i = 0; i < m; i++) {
        in[i] = s->coordinate[i].q;
        for (size_t j = 0; j < m; j++) {
            nh_ex sum = nh_int(d, 0);
            for (size_t l = 0; l < m; l++) {
                sum = nh_add(d, sum, nh_mul(d, xi[l], nh_diff(d, K[i * m + j], s->coordinate[l].q)));
                sum = nh_add(d, sum, nh_mul(d, K[l * m + j], nh_diff(d, xi[l], s->coordinate[i].q)));
                sum = nh_add(d, sum, nh_mul(d, K[i * m + l], nh_diff(d, xi[l], s->coordinate[j].q)));
            }
            e[i * m + j] = sum;
            e[m * m + i * m + j] = K[i * m + j];
        }
    }
    nh_system_bindings(s, &symbols, &values);
    nh_tape *tape = nh_tape_create(d, m, in, 2 * m * m, e, s->parameters, symbols, values);
    nh_tape_work *work = nh_tape_work_create(tape);
    for (int p = 0; p < 5; p++) {
        for (size_t i = 0; i < m; i++) q[i] = between(&seed, 0.2, 1.3);
        nh_tape_eval(tape, work, q, out);
        for (size_t i = 0; i < m * m; i++) worst = fmax(worst, fabs(out[i])), size = fmax(size, fabs(out[m * m + i]));
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(out);
    nh_free(e);
    return worst / size;
}

static nh_chain_symmetries *found(const nh_system *s)
{
    nh_error error = {0};
    nh_chain_symmetries *a = nh_chain_symmetries_find(s, 5, &error);
    must(a != NULL, &error, "symmetries");
    cr_expect_leq(a->last_null, 1e-12, "%.1e", a->last_null);
    cr_expect_geq(a->first_other, 1e-4, "%.1e", a->first_other);
    for (size_t k = 0; k < a->fields; k++) {
        double change = change_of_metric(s, a->field[k].component);
        cr_expect(change <= 1e-12, "%s of joint %zu: L_xi K = %.1e", nh_chain_rule_name(a->field[k].rule), a->field[k].joint, change);
    }
    return a;
}

static void expect(const nh_chain_symmetries *a, size_t joint, size_t first, size_t ap1, size_t ap2, size_t extremity)
{
    const size_t *got = a->dimension + joint * NH_CHAIN_RULES, want[] = {first, ap1, ap2, extremity};
    for (int r = 0; r < NH_CHAIN_RULES; r++) cr_expect_eq(got[r], want[r], "joint %zu, %s: %zu, not %zu", joint, nh_chain_rule_name((nh_chain_rule)r), got[r], want[r]);
}

Test(chain, crane)
{
    nh_error error = {0};
    nh_system *s = nh_system_read("systems/crane.yaml", 0, NULL, &error);
    must(s != NULL, &error, "crane");
    nh_chain_symmetries *a = found(s);
    expect(a, 0, 3, 3, 3, 0); /* the car: x, y, theta */
    expect(a, 1, 0, 0, 1, 0); /* psi1 */
    expect(a, 2, 0, 0, 1, 0); /* phi1 */
    expect(a, 3, 0, 0, 1, 1); /* psi2, psi3: wheels are round */
    expect(a, 4, 0, 0, 1, 1);
    expect(a, 5, 0, 0, 0, 0); /* phi2 */
    nh_ex phi2[8];
    for (int i = 0; i < 8; i++) phi2[i] = nh_int(s->dag, i == 7);
    cr_expect_gt(change_of_metric(s, phi2), 1e-3); /* and the check sees it */
    nh_chain_symmetries_free(a);
    nh_system_free(s);
}

/* A round body on a spherical joint: space turns it (left), and it may be turned in itself (right) about its axis. */
Test(chain, spherical_extremity)
{
    nh_system *s = nh_system_parse("test.yaml",
                                   "bodies: [{name: cart, mass: 2}, {name: top, mass: 1, inertia: [0.3, 0.3, 0.5], center: [0, 0, 0.4]}]\n"
                                   "joints:\n  - {type: translation, axes: [x, y, z], child: cart, coordinates: [x, y, z]}\n"
                                   "  - {type: spherical, parent: cart, child: top, angles: zxz, coordinates: [p, h, s]}\n", 0, NULL, NULL);
    nh_chain_symmetries *a = found(s);
    expect(a, 0, 3, 3, 3, 0);
    expect(a, 1, 0, 0, 0, 1);
    nh_chain_symmetries_free(a);
    nh_system_free(s);
}

/* Commuting joints: two slides in different directions are symmetries by AP1; a sphere that turns about its centre by AP2 and from the right. */
Test(chain, commuting_joints)
{
    nh_system *s = nh_system_parse("test.yaml",
                                   "bodies: [{name: a, mass: 2}, {name: b, mass: 1, center: [0.3, 0, 0]}, {name: ball, mass: 1, inertia: 0.2}]\n"
                                   "joints:\n  - {type: prismatic, axis: x, child: a, coordinates: [x]}\n"
                                   "  - {type: prismatic, axis: [1, 2, 2], parent: a, child: b, coordinates: [u]}\n"
                                   "  - {type: spherical, parent: b, child: ball, coordinates: [p, h, s]}\n", 0, NULL, NULL);
    nh_chain_symmetries *a = found(s);
    expect(a, 0, 1, 1, 1, 0);
    expect(a, 1, 0, 1, 1, 0);
    expect(a, 2, 0, 0, 3, 3); /* a turn about a centre that moves is no displacement of space */
    nh_chain_symmetries_free(a);
    nh_system_free(s);
}

Test(chain, without_bodies)
{
    nh_error error = {0};
    nh_system *s = nh_system_parse("test.yaml", "coordinates: [x]\nlagrangian: x'^2\n", 0, NULL, &error);
    cr_assert_null(nh_chain_symmetries_find(s, 1, &error));
    cr_expect_eq(error.code, NH_USAGE);
    nh_system_free(s);
}
