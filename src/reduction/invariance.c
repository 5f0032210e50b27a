/* Does a field leave a system invariant (the conditions: invariance.h)? Three answers for each of metric, potential,
 * constraints and forces: the largest relative residual at the sample points; exactly, by normal forms, for the given
 * parameters; and for all parameters. A residual is relative to the moduli of the terms of its equation. */
#include "reduction/invariance.h"

#include <math.h>
#include <string.h>

#include "graph/diff.h"
#include "graph/terms.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/print.h"

nh_ex nh_field_along(const nh_kinetic *k, const nh_ex *xi, nh_ex e) { return nh_diff_along(k->dag, e, k->m, k->q, xi); }

void nh_field_bracket(const nh_kinetic *k, const nh_ex *xi, const nh_ex *eta, nh_ex *out)
{
    for (size_t s = 0; s < k->m; s++)
        out[s] = nh_simplify(k->dag, nh_sub(k->dag, nh_field_along(k, xi, eta[s]), nh_field_along(k, eta, xi[s])));
}

/* xi, prolonged to velocities, on a function of (t, q, v). */
static nh_ex prolonged(const nh_kinetic *k, const nh_ex *xi, nh_ex e)
{
    nh_ex sum = nh_field_along(k, xi, e);
    for (size_t s = 0; s < k->m; s++) {
        nh_ex slope = nh_diff(k->dag, e, k->v[s]);
        if (!nh_is_zero(k->dag, slope))
            sum = nh_add(k->dag, sum, nh_mul(k->dag, slope, nh_diff_along(k->dag, xi[s], k->m, k->q, k->v)));
    }
    return sum;
}

static bool plain(const nh_kinetic *k) { return k->quadratic && !k->magnetic && k->autonomous; }

/* (L_xi K)_rs = xi^l d_l K_rs + K_ls d_r xi^l + K_rl d_s xi^l */
static nh_ex metric_equation(const nh_kinetic *k, const nh_ex *xi, size_t r, size_t s)
{
    nh_dag *d = k->dag;
    nh_ex sum = nh_field_along(k, xi, k->K[r * k->m + s]);
    for (size_t l = 0; l < k->m; l++) {
        sum = nh_add(d, sum, nh_mul(d, k->K[l * k->m + s], nh_diff(d, xi[l], k->q[r])));
        sum = nh_add(d, sum, nh_mul(d, k->K[r * k->m + l], nh_diff(d, xi[l], k->q[s])));
    }
    return sum;
}

/* (L_xi Q)_s */
static nh_ex force_equation(const nh_kinetic *k, const nh_ex *xi, size_t s)
{
    nh_dag *d = k->dag;
    nh_ex e = prolonged(k, xi, k->Q[s]);
    for (size_t l = 0; l < k->m; l++) {
        nh_ex slope = nh_diff(d, xi[l], k->q[s]);
        if (!nh_is_zero(d, slope)) e = nh_add(d, e, nh_mul(d, k->Q[l], slope));
    }
    return e;
}

size_t nh_invariance_equations(const nh_kinetic *k, const nh_ex *xi, nh_ex *out, size_t *count)
{
    size_t n = 0, of_metric;
    if (plain(k)) {
        for (size_t r = 0; r < k->m; r++)
            for (size_t s = 0; s <= r; s++) out[n++] = metric_equation(k, xi, r, s);
    } else {
        out[n++] = prolonged(k, xi, k->model->system->lagrangian);
    }
    of_metric = n;
    out[n++] = plain(k) ? nh_field_along(k, xi, k->V) : nh_int(k->dag, 0);
    for (size_t a = 0; a < k->f; a++) out[n++] = nh_chart_compose(k->model->chart, prolonged(k, xi, k->force[a]));
    for (size_t s = 0; s < k->m && k->forced; s++)
        out[n++] = nh_chart_compose(k->model->chart, force_equation(k, xi, s));
    *count = n;
    return of_metric;
}

/* ---- at the sample points ---- */

/* The terms of an expression separately, so that a sum is compared with its terms. */
static double relative_size(nh_tape *tape, nh_tape_work *work, const double *z, size_t n, double *out)
{
    double worst = 0;
    nh_tape_eval(tape, work, z, out);
    for (size_t i = 0; i < n; i++)
        worst =
            fmax(worst, isfinite(out[2 * i]) && isfinite(out[2 * i + 1]) ? fabs(out[2 * i]) / (1e-300 + out[2 * i + 1])
                                                                         : INFINITY);
    return worst;
}

/* A size for e to be compared with: the sum of the moduli of its terms, plus `unit`. */
static nh_ex size_of(nh_dag *d, nh_ex e, nh_ex unit) { return nh_add(d, unit, nh_terms_moduli(d, e)); }

/* The largest |e_i| over its terms and its unit, at the sample points. */
static double largest_residual(const nh_kinetic *k, size_t n, const nh_ex *e, const nh_ex *unit)
{
    size_t m = k->m, width = 1 + 2 * m;
    nh_ex *in = nh_alloc_array(width, sizeof *in), *pair = nh_alloc_array(2 * n + 1, sizeof *pair);
    double *z = nh_alloc_array(width + 2 * n + 1, sizeof *z), worst = 0;
    in[0] = k->model->system->t;
    memcpy(in + 1, k->q, m * sizeof *in);
    memcpy(in + 1 + m, k->v, m * sizeof *in);
    for (size_t i = 0; i < n; i++) {
        pair[2 * i] = e[i];
        pair[2 * i + 1] = size_of(k->dag, e[i], unit[i]);
    }
    nh_tape *tape = nh_tape_create(k->dag, width, in, 2 * n, pair, k->model->system->parameters, k->model->parameter,
                                   k->model->parameter_value);
    nh_tape_work *work = nh_tape_work_create(tape);
    for (size_t p = 0; p < k->places && n; p++) {
        z[0] = k->time[p];
        memcpy(z + 1, k->place + p * m, m * sizeof *z);
        memcpy(z + 1 + m, k->speed + p * m, m * sizeof *z);
        worst = fmax(worst, relative_size(tape, work, z, n, z + width));
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(in);
    nh_free(pair);
    nh_free(z);
    return worst;
}

static nh_proof proof_of(const nh_condition *c)
{
    return (nh_proof){.proved = c->proved, .all_parameters = c->all_parameters, .fixed = c->fixed};
}

static void join(const nh_kinetic *k, nh_condition *c, nh_proof proof)
{
    proof = nh_proof_both(k->model, proof_of(c), proof);
    c->proved = proof.proved;
    c->all_parameters = proof.all_parameters;
    c->fixed = proof.fixed;
}

nh_proof nh_generator_proof(const nh_kinetic *k, const nh_generator *g)
{
    nh_proof proof = nh_proof_both(k->model, proof_of(&g->metric), proof_of(&g->potential));
    proof = nh_proof_both(k->model, proof, proof_of(&g->constraints));
    return nh_proof_both(k->model, proof, proof_of(&g->forces));
}

static nh_condition condition(const nh_kinetic *k, size_t n, const nh_ex *e, double residual, const nh_options *options)
{
    nh_condition c = {.holds = residual <= options->group, .residual = residual};
    c.proved = c.all_parameters = c.holds;
    for (size_t i = 0; i < n && c.proved; i++) {
        if (nh_normal_is_zero(k->dag, e[i], (size_t)options->proof_terms) == NH_ZERO) continue;
        nh_proof proof = nh_prove_zero(k->model, 1, &e[i], true, options);
        join(k, &c, proof);
        c.holds &= proof.proved || !proof.refuted;
    }
    return c;
}

nh_ex nh_invariance_sum(const nh_kinetic *k)
{
    const nh_dag *d = k->dag;
    bool minus =
        nh_kind_of(d, k->V) == NH_PRODUCT && nh_arity(d, k->V) == 1 && nh_is_number(d, nh_exponent_of(d, k->V, 0), 1);
    return minus ? nh_child(d, k->V, 0) : k->V;
}

/* A potential of many terms may be too large for one proof, or for one with all parameters: xi of each term often
 * vanishes by itself. */
static void prove_by_terms(const nh_kinetic *k, const nh_ex *xi, const nh_options *options, nh_condition *c)
{
    nh_dag *d = k->dag;
    nh_ex V = nh_invariance_sum(k);
    nh_condition whole = *c;
    if (!c->holds || (c->proved && c->all_parameters) || nh_kind_of(d, V) != NH_SUM) return;
    c->proved = c->all_parameters = true;
    c->fixed = NULL;
    for (size_t i = 0; i < nh_arity(d, V) && c->proved; i++) {
        nh_ex rate = nh_field_along(k, xi, nh_child(d, V, i));
        if (nh_normal_is_zero(d, rate, (size_t)options->proof_terms) == NH_ZERO) continue;
        join(k, c, nh_prove_zero(k->model, 1, &rate, true, options));
    }
    if (whole.proved && !(c->proved && c->all_parameters)) *c = whole;
}

/* The size of the terms of the change of L, coordinate by coordinate: sum |xi^s dL/dq^s| + |xi^s' dL/dv^s|. */
static nh_ex size_of_change(const nh_kinetic *k, const nh_ex *xi)
{
    nh_dag *d = k->dag;
    nh_ex L = k->model->system->lagrangian, sum = nh_int(d, 0);
    for (size_t s = 0; s < k->m; s++) {
        nh_ex rate = nh_diff_along(d, xi[s], k->m, k->q, k->v);
        sum = nh_add(d, sum, nh_call(d, NH_ABS, nh_mul(d, xi[s], nh_diff(d, L, k->q[s]))));
        sum = nh_add(d, sum, nh_call(d, NH_ABS, nh_mul(d, rate, nh_diff(d, L, k->v[s]))));
    }
    return sum;
}

static nh_condition forces_invariant(const nh_kinetic *k, const nh_ex *xi, const nh_options *options)
{
    nh_dag *d = k->dag;
    nh_ex *e = nh_alloc_array(2 * k->m + 1, sizeof *e), *unit = e + k->m, size = nh_int(d, 0);
    for (size_t s = 0; s < k->m; s++) {
        e[s] = force_equation(k, xi, s);
        size = nh_add(d, size, nh_call(d, NH_ABS, k->Q[s]));
    }
    for (size_t s = 0; s < k->m; s++) unit[s] = size;
    nh_condition c = condition(k, k->m, e, largest_residual(k, k->m, e, unit), options);
    nh_free(e);
    return c;
}

void nh_generator_init(nh_generator *g, const nh_kinetic *k, const char *name, const nh_ex *component,
                       const nh_options *options)
{
    nh_dag *d = k->dag;
    size_t m = k->m, h = m * (m + 1) / 2, n = 0, total = h + 1 + k->f + m, all;
    nh_ex *e = nh_alloc_array(2 * total + k->f, sizeof *e), *unit = e + total, *raw = unit + total;
    *g = (nh_generator){.name = name, .component = nh_arena_alloc(k->arena, m * sizeof *g->component)};
    memcpy(g->component, component, m * sizeof *component);
    size_t of_metric = nh_invariance_equations(k, component, e, &all);
    for (size_t r = 0; r < m && plain(k); r++) /* entries compare with the geometric mean of the diagonal */
        for (size_t s = 0; s <= r; s++)
            unit[n++] = nh_sqrt(d, nh_call(d, NH_ABS, nh_mul(d, k->K[r * m + r], k->K[s * m + s])));
    if (!plain(k)) unit[n++] = size_of_change(k, component);
    g->metric = condition(k, of_metric, e, largest_residual(k, of_metric, e, unit), options);
    unit[0] = nh_int(d, 0);
    for (size_t r = 0; r < m; r++)
        unit[0] = nh_add(d, unit[0], nh_call(d, NH_ABS, nh_mul(d, component[r], nh_diff(d, k->V, k->q[r]))));
    g->potential = condition(k, 1, e + of_metric, largest_residual(k, 1, e + of_metric, unit), options);
    prove_by_terms(k, component, options, &g->potential);
    for (size_t a = 0; a < k->f; a++) {
        raw[a] = prolonged(k, component, k->force[a]);
        unit[a] = nh_int(d, 0);
        for (size_t s = 0; s < m; s++)
            unit[a] = nh_add(d, unit[a], nh_call(d, NH_ABS, nh_diff(d, k->force[a], k->v[s])));
    }
    g->constraints = condition(k, k->f, e + of_metric + 1, largest_residual(k, k->f, raw, unit), options);
    g->forces = k->forced ? forces_invariant(k, component, options)
                          : (nh_condition){.holds = true, .proved = true, .all_parameters = true};
    g->local = nh_kinetic_many_valued(k, m, component);
    g->invariant = g->metric.holds && g->potential.holds && g->constraints.holds && g->forces.holds;
    nh_free(e);
}

void nh_generator_text(const nh_kinetic *k, const nh_generator *g, nh_text *out)
{
    bool first = true;
    for (size_t s = 0; s < k->m; s++) {
        nh_ex e = g->component[s];
        if (nh_is_zero(k->dag, e)) continue;
        const char *name = k->name[s];
        nh_ex minus = nh_neg(k->dag, e);
        bool below = nh_kind_of(k->dag, e) == NH_PRODUCT && nh_num_value(nh_constant_of(k->dag, e)) < 0;
        below |= nh_kind_of(k->dag, e) == NH_NUMBER && nh_num_value(nh_number_of(k->dag, e)) < 0;
        nh_text_add(out, first ? (below ? "-" : "") : below ? " - " : " + ");
        nh_ex shown = below ? minus : e;
        if (!nh_is_number(k->dag, shown, 1)) {
            char *text = nh_print_string(k->dag, shown);
            bool sum = strchr(text, ' ') != NULL; /* also a number times a sum */
            nh_text_addf(out, sum ? "(%s) " : "%s ", text);
            nh_free(text);
        }
        nh_text_addf(out, "d/d%s", name);
        first = false;
    }
    if (first) nh_text_add(out, "0");
}
