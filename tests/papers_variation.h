/* papers_variation: both first variation formulas, point by point in the jets, and the invariance of the Hamiltonian under a lifted action. */
#ifndef NH_TESTS_PAPERS_VARIATION_H
#define NH_TESTS_PAPERS_VARIATION_H

#include "graph/dag.h"

static const char *const PLACE[3] = {"phi", "x", "y"};

/* Any accelerations, and any variation: dt, then by PLACE; that of (1) has functions of t and of t, q. */
static const char *const ANY_RATE[3] = {"1 + x*y'", "phi - 2*t", "x'*phi' - y/2"};
static const char *const ANY_FIELD[4] = {"1 + t^2/3", "t + x*y/4", "sin(phi) + t*y", "x^2 - phi"};
static const char *const ANY_ALLOWED[3] = {"t - phi'*x/5", "cos(x)*y + x'", "phi'^2 - t*phi"};

/* de/dt along sections that have the accelerations ANY_RATE and, with normal (else NULL), y' = *normal. */
static nh_ex total_rate(const document *d, nh_ex e, const nh_ex *normal)
{
    nh_dag *g = d->system->dag;
    nh_ex sum = nh_diff(g, e, parsed(d, "t"));
    for (size_t i = 0; i < 3; i++) {
        char name[20];
        snprintf(name, sizeof name, "%s'", PLACE[i]);
        nh_ex v = parsed(d, name), of_velocity = normal && i == 2 ? nh_int(g, 0) : nh_mul(g, nh_diff(g, e, v), parsed(d, ANY_RATE[i]));
        sum = nh_add(g, sum, nh_add(g, nh_mul(g, nh_diff(g, e, parsed(d, PLACE[i])), normal && i == 2 ? *normal : v), of_velocity));
    }
    return normal ? inserted(d, sum, "y'") : sum;
}

/* (1): the variation of L dt is i(dtheta) + d(i(theta)); i(dtheta) = E_s (xi^s - q'^s xi^0) dt with the printed E. */
static double first_variation(const document *d)
{
    nh_dag *g = d->system->dag;
    nh_ex L = d->system->lagrangian, zero = parsed(d, ANY_FIELD[0]), slow = total_rate(d, zero, NULL);
    nh_ex left = nh_add(g, nh_mul(g, zero, nh_diff(g, L, parsed(d, "t"))), nh_mul(g, L, slow)), current = nh_mul(g, L, zero), right = nh_int(g, 0);
    for (size_t i = 0; i < 3; i++) {
        char name[20], line[4] = {'#', (char)('0' + i), 0};
        snprintf(name, sizeof name, "%s'", PLACE[i]);
        nh_ex v = parsed(d, name), xi = parsed(d, ANY_FIELD[1 + i]), p = nh_diff(g, L, v), E = coefficient(d, "chetaev_equations", line, "");
        nh_ex vertical = nh_sub(g, xi, nh_mul(g, v, zero)), lifted = nh_sub(g, total_rate(d, xi, NULL), nh_mul(g, v, slow));
        for (size_t s = 0; s < 3; s++) {
            snprintf(name, sizeof name, "%s''", PLACE[s]);
            E = nh_add(g, E, nh_mul(g, coefficient(d, "chetaev_equations", line, name), parsed(d, ANY_RATE[s])));
        }
        left = nh_add(g, left, nh_add(g, nh_mul(g, xi, nh_diff(g, L, parsed(d, PLACE[i]))), nh_mul(g, lifted, p)));
        current = nh_add(g, current, nh_mul(g, p, vertical));
        right = nh_add(g, right, nh_mul(g, E, vertical));
    }
    return differ(d, left, nh_add(g, right, total_rate(d, current, NULL)));
}

/* (7): the same on the constraint submanifold, for Z in the canonical distribution: i(Z) d(theta) = (Abar_l + Bbar_ls q''^s)(Z^l - q'^l Z^0) dt.
 * The components of Z along the velocities drop out of the left side; they are 0 here. */
static double constrained_variation(const document *d)
{
    nh_dag *g = d->system->dag;
    nh_ex normal = coefficient(d, "normal_form", "y'", ""), L = coefficient(d, "lagrangian", "Lbar", ""), force = coefficient(d, "lagrangian", "Lbar_y", "");
    nh_ex zero = parsed(d, ANY_ALLOWED[0]), slow = total_rate(d, zero, &normal), right = nh_int(g, 0), current = nh_mul(g, L, zero);
    nh_ex dependent = nh_mul(g, normal, zero), turned = nh_int(g, 0), left = nh_mul(g, L, slow);
    nh_ex Z[3];
    for (size_t l = 0; l < 2; l++) {
        char name[40];
        snprintf(name, sizeof name, "%s'", FREE[l]);
        nh_ex v = parsed(d, name), vertical, lifted, slope = nh_diff(g, normal, v), E, p;
        snprintf(name, sizeof name, "dLbar/d%s'", FREE[l]);
        p = coefficient(d, "lagrangian", name, "");
        snprintf(name, sizeof name, "Abar_%s", FREE[l]);
        E = coefficient(d, "reduced_equations", name, "");
        for (size_t s = 0; s < 2; s++) {
            snprintf(name, sizeof name, "Bbar_%s,%s", FREE[l], FREE[s]);
            E = nh_add(g, E, nh_mul(g, coefficient(d, "reduced_equations", name, ""), inserted(d, parsed(d, ANY_RATE[s]), "y'")));
        }
        Z[l] = parsed(d, ANY_ALLOWED[1 + l]);
        vertical = nh_sub(g, Z[l], nh_mul(g, v, zero));
        lifted = nh_sub(g, total_rate(d, Z[l], &normal), nh_mul(g, v, slow));
        left = nh_add(g, left, nh_mul(g, p, lifted));
        turned = nh_add(g, turned, nh_mul(g, slope, lifted));
        dependent = nh_add(g, dependent, nh_mul(g, slope, vertical));
        current = nh_add(g, current, nh_mul(g, p, vertical));
        right = nh_add(g, right, nh_mul(g, E, vertical));
    }
    Z[2] = dependent;
    nh_ex varied = nh_sub(g, total_rate(d, dependent, &normal), nh_add(g, nh_mul(g, normal, slow), turned)); /* of phi^1, along the section */
    for (size_t i = 0; i < 3; i++) {
        nh_ex q = parsed(d, PLACE[i]);
        left = nh_add(g, left, nh_mul(g, Z[i], nh_diff(g, L, q)));
        varied = nh_sub(g, varied, nh_mul(g, Z[i], nh_diff(g, normal, q)));
    }
    return differ(d, nh_add(g, left, nh_mul(g, force, varied)), nh_add(g, right, total_rate(d, current, &normal)));
}

/* {J, H} for J = p_i xi^i(q) at p = dL/dv, where dH/dp = v and dH/dq = -dL/dq: of each generator "e_4: -y d/dx + x d/dy; proved" of the group, beside
 * the sizes of its terms. */
static double lifted_action(const document *d)
{
    nh_dag *g = d->system->dag;
    const nh_system *s = d->system;
    double worst = 0;
    size_t count = 0;
    for (size_t i = 0; i < d->lines; i++) {
        double sum[points] = {0}, size[points] = {0}, value[points];
        size_t number;
        const char *colon = strstr(d->line[i].text, ": "), *end = strstr(d->line[i].text, "; ");
        if (strncmp(d->line[i].heading, "Group given", 11) || sscanf(d->line[i].text, "e_%zu: ", &number) != 1 || !colon || !end) continue;
        char *field = strndup(colon + 2, (size_t)(end - colon) - 2);
        for (size_t j = 0; j < s->coordinates; j++) {
            char name[80], of[80];
            snprintf(of, sizeof of, "d/d%s", s->coordinate[j].name);
            nh_ex xi = parsed(d, coefficient_in(field, of)), turn = nh_int(g, 0);
            for (size_t k = 0; k < s->coordinates; k++) {
                snprintf(name, sizeof name, "%s'", s->coordinate[k].name);
                turn = nh_add(g, turn, nh_mul(g, nh_diff(g, xi, parsed(d, s->coordinate[k].name)), parsed(d, name)));
            }
            snprintf(name, sizeof name, "%s'", s->coordinate[j].name);
            const nh_ex terms[2] = {nh_mul(g, nh_diff(g, s->lagrangian, parsed(d, name)), turn),
                                    nh_mul(g, nh_diff(g, s->lagrangian, parsed(d, s->coordinate[j].name)), xi)};
            for (size_t k = 0; k < 2; k++) {
                evaluate(d, terms[k], value);
                for (size_t p = 0; p < points; p++) sum[p] += value[p], size[p] += fabs(value[p]);
            }
        }
        for (size_t p = 0; p < points; p++) worst = fmax(worst, size[p] > 0 ? fabs(sum[p]) / size[p] : 0);
        count++;
        free(field);
    }
    return count ? worst : INFINITY;
}

/* False: another computation. */
static bool by_variation(const row *r, const document *d, double *printed)
{
    if (!strcmp(r->by, "first variation")) *printed = first_variation(d);
    else if (!strcmp(r->by, "constrained variation")) *printed = constrained_variation(d);
    else if (!strcmp(r->by, "lifted action")) *printed = lifted_action(d);
    else return false;
    return true;
}

#endif
