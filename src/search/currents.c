#include "search/currents.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "graph/declared.h"
#include "graph/diff.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/print.h"
#include "search/coefficients.h"
#include "search/counted.h"
#include "search/current_list.h"
#include "search/dependence.h"
#include "search/described.h"
#include "search/specials.h"

enum { heldout_count = 256, generic_count = 24, open_digits = 12 };

/* max |Gamma(Phi)| / max(sum |terms of it|, 1e-3 |dPhi| |Gamma|). */
static double heldout_residual(const nh_model *o, const nh_points *points, nh_ex phi)
{
    size_t width = 1 + o->m + o->n, count = points->count;
    nh_ex *e = nh_alloc_array(2 * width, sizeof *e);
    double *value = nh_alloc_array(2 * width * count, sizeof *value), worst = 0;
    for (size_t j = 0; j < width; j++) {
        e[j] = j == 0 ? nh_int(o->dag, 1) : j <= o->m ? o->rho[j - 1] : o->a[j - 1 - o->m];
        e[width + j] = nh_diff(o->dag, phi, o->chart->symbol[j]);
    }
    nh_points_evaluate(points, o, 2 * width, e, value);
    for (size_t p = 0; p < count; p++) {
        double sum = 0, size = 0, g = 0, speed = 0;
        for (size_t j = 0; j < width; j++) {
            double x = value[j * count + p], y = value[(width + j) * count + p];
            sum += x * y;
            size += fabs(x * y);
            g += y * y;
            speed += x * x;
        }
        double r = fabs(sum) / fmax(fmax(size, 1e-3 * sqrt(g * speed)), DBL_MIN);
        if (isfinite(r)) worst = fmax(worst, r);
    }
    nh_free(value);
    nh_free(e);
    return worst;
}

/* Decides whether it is a current. */
static void decide(nh_current_checker *b, nh_candidate *c, nh_current *f)
{
    nh_analysis *r = b->result;
    f->quotient = c->quotient;
    nh_claim claim = {0};
    f->phi = nh_coefficients_assemble(r->model, c, &r->options, f, &claim);
    f->heldout = heldout_residual(r->model, b->heldout, f->phi);
    if (nh_coefficients_refuted(f, &r->options)) return;
    f->proof = nh_prove_claim(r->model, f->phi, claim, &r->options);
    nh_coefficients_certify(&r->options, f);
    /* rounding within the terms is no rate: balls have measured it, at other points */
    if (f->heldout > r->options.heldout && f->proof.digits >= open_digits) f->heldout = pow(10, -f->proof.digits);
}

/* Is a symbol named by these letters and a number? */
static bool is_used(const nh_dag *d, const char *letters)
{
    enum { most = 99 };
    char name[24];
    nh_ex symbol;
    for (int k = 0; k <= most; k++) {
        snprintf(name, sizeof name, "%s%d", letters, k);
        if (nh_symbol_find(d, name, &symbol)) return true;
    }
    return false;
}

const char *nh_currents_name(nh_analysis *r, size_t number)
{
    static const char *const letters[] = {"Phi", "Psi", "Xi", "Current"};
    for (size_t i = 0; !r->letter; i++)
        if (i + 1 == sizeof letters / sizeof *letters || !is_used(r->model->dag, letters[i])) r->letter = letters[i];
    return nh_arena_printf(r->arena, "%s%zu", r->letter, number);
}

/* Refines combinations that doubles propose, with many digits at exact points, which decide. */
static void decide_ranks(nh_analysis *r, const nh_ex *phi, nh_independence *kind)
{
    nh_ex *list = nh_alloc_array(r->count + 1, sizeof *list);
    size_t n = 0;
    for (size_t k = 0; k < r->count; k++) {
        list[n] = phi[k];
        if (kind[k] == NH_CONSTANT || r->found[k].series) {
            n += kind[k] == NH_INDEPENDENT;
            continue;
        }
        nh_rank *rank = &r->found[k].rank;
        *rank = nh_rank_decide(r->model, n, list, r->options.doubt);
        if (rank->answer != NH_RANK_UNDECIDED) kind[k] = rank->answer == NH_RANK_GROWS ? NH_INDEPENDENT : NH_DEPENDENT;
        n += kind[k] == NH_INDEPENDENT;
    }
    nh_free(list);
}

void nh_currents_list(const nh_analysis *r, nh_ex *phi, bool *exact)
{
    for (size_t k = 0; k < r->count; k++) {
        phi[k] = r->found[k].phi;
        exact[k] = r->found[k].proof.proved;
    }
}

static void independence(nh_analysis *r, const nh_points *generic)
{
    nh_ex *phi = nh_alloc_array(r->count + 1, sizeof *phi);
    nh_independence *kind = nh_alloc_array(r->count + 1, sizeof *kind);
    double *fraction = nh_alloc_array(r->count + 1, sizeof *fraction);
    bool *exact = nh_alloc_array(r->count + 1, sizeof *exact);
    nh_currents_list(r, phi, exact);
    nh_independence_test(r->model, generic, r->count, phi, exact, r->options.sure, r->options.doubt, kind, fraction);
    nh_free(exact);
    decide_ranks(r, phi, kind);
    nh_current_list_rank(r, kind, fraction);
    for (size_t k = 0; k < r->count; k++) r->found[k].name = nh_currents_name(r, k + 1);
    nh_free(fraction);
    nh_free(kind);
    nh_free(phi);
    nh_dependence_relations(r);
}

/* Root mean square of Gamma(Phi) over that of Phi - mean(Phi). */
static double relative_rate(const nh_model *o, const nh_points *points, nh_ex phi)
{
    nh_ex pair[2] = {phi, nh_model_gamma(o, phi)};
    double *value = nh_alloc_array(2 * points->count, sizeof *value), mean = 0, variation = 0, rate = 0;
    nh_points_evaluate(points, o, 2, pair, value);
    for (size_t p = 0; p < points->count; p++) mean += value[p] / (double)points->count;
    for (size_t p = 0; p < points->count; p++) {
        variation += pow(value[p] - mean, 2);
        rate += pow(value[points->count + p], 2);
    }
    nh_free(value);
    return variation > 0 && isfinite(rate) ? sqrt(rate / variation) : NAN;
}

/* Records a combination that is no current, or not certainly one, although doubles could not tell: as a slow quantity
 * when it changes slowly.  The slowest come first. */
static void note_almost(nh_current_checker *b, const nh_current *f, double digits)
{
    nh_analysis *r = b->result;
    double rate = relative_rate(r->model, b->generic, f->phi), unit = r->pace > 0 ? r->pace : 1;
    if (!(rate <= r->options.slow * unit) || digits < NH_LEAST_ALMOST) return;
    if (!r->almost) r->almost = nh_arena_alloc(r->arena, NH_MOST_ALMOST * sizeof *r->almost);
    size_t at = r->almosts;
    while (at > 0 && r->almost[at - 1].rate > rate) at--;
    if (at == NH_MOST_ALMOST) return;
    if (r->almosts < NH_MOST_ALMOST) r->almosts++;
    for (size_t k = r->almosts - 1; k > at; k--) r->almost[k] = r->almost[k - 1];
    nh_current copy = *f;
    nh_current_in_velocities(b, &copy);
    r->almost[at] = (nh_near_current){f->phi, copy.in_velocities, digits, rate};
}

/* A candidate is no current when it fails on held-out points, is refuted exactly, or does not cancel with many digits:
 * it is left out, with a warning.  A candidate without a certificate is left out too, also where nothing refutes it:
 * whether it is conserved stays open. */
static bool keeps(nh_current_checker *b, const nh_current *f, bool certain)
{
    nh_analysis *r = b->result;
    if (nh_coefficients_certain(f, &r->options)) return true;
    if (nh_coefficients_refuted(f, &r->options)) {
        note_almost(b, f, f->refined);
        return false;
    }
    /* it was only likely: where it cancels as far as doubles go the question stays open, otherwise it is answered */
    if (!certain) {
        r->open += f->proof.digits >= open_digits;
        return false;
    }
    /* fitted coefficients never cancel further */
    if (f->heldout <= r->options.heldout && !(f->exact && f->proof.refuted)) {
        r->open++;
        note_almost(b, f, f->proof.digits);
        return false;
    }
    nh_analysis_warn(r,
                     "rejected a combination that fits the samples to %.1e: it is not conserved (held-out residual "
                     "%.1e, its rate cancels to %.0f digits)",
                     f->quotient, f->heldout, f->proof.digits);
    return false;
}

nh_current_checker *nh_current_checker_create(nh_analysis *r, nh_error *error)
{
    uint64_t seed = (uint64_t)r->options.seed;
    nh_current_checker *b = nh_alloc(sizeof *b);
    b->result = r;
    b->heldout = nh_points_create(r->model, heldout_count, 1.7, seed + 101, error);
    b->generic = b->heldout ? nh_points_create(r->model, generic_count, 1, seed + 202, error) : NULL;
    b->inverse = nh_alloc_array(r->model->n + 1, sizeof *b->inverse);
    if (!b->generic) {
        nh_current_checker_free(b);
        return NULL;
    }
    b->invertible = nh_chart_inverse(r->model->chart, b->inverse);
    if (!b->invertible)
        nh_analysis_warn(
            r, "the currents are not given in coordinate velocities: the chart is not affine in its quasi-velocities");
    return b;
}

void nh_current_checker_free(nh_current_checker *b)
{
    if (!b) return;
    nh_points_free(b->generic);
    nh_points_free(b->heldout);
    nh_free(b->inverse);
    nh_free(b);
}

nh_independence nh_currents_beside(const nh_analysis *r, const nh_points *points, nh_ex current, bool own, double doubt)
{
    nh_ex *phi = nh_alloc_array(r->count + 1, sizeof *phi);
    nh_independence *kind = nh_alloc_array(r->count + 1, sizeof *kind);
    bool *exact = nh_alloc_array(r->count + 1, sizeof *exact);
    nh_currents_list(r, phi, exact);
    phi[r->count] = current;
    exact[r->count] = own;
    nh_independence_test(r->model, points, r->count + 1, phi, exact, r->options.sure, doubt, kind, NULL);
    nh_independence out = kind[r->count];
    nh_free(exact);
    nh_free(kind);
    nh_free(phi);
    return out;
}

static bool is_known(const nh_current_checker *b, nh_ex current, bool own, double doubt)
{
    return nh_currents_beside(b->result, b->generic, current, own, doubt) != NH_INDEPENDENT;
}

bool nh_currents_known(const nh_current_checker *b, nh_ex current, bool exact)
{
    return is_known(b, current, exact, b->result->options.doubt);
}

/* ---- the list ---- */

/* A function of the currents and the pieces so far is left out. */
static bool add_piece(nh_current_checker *b, const nh_current *f)
{
    nh_analysis *r = b->result;
    size_t n = r->count + r->pieces;
    nh_ex *phi = nh_alloc_array(n + 1, sizeof *phi);
    nh_independence *kind = nh_alloc_array(n + 1, sizeof *kind);
    for (size_t k = 0; k < n; k++) phi[k] = k < r->count ? r->found[k].phi : r->piece[k - r->count].phi;
    phi[n] = f->phi;
    nh_independence_test(r->model, b->generic, n + 1, phi, NULL, r->options.sure, r->options.doubt, kind, NULL);
    bool added = kind[n] == NH_INDEPENDENT && nh_current_list_append_piece(r, f);
    nh_free(kind);
    nh_free(phi);
    return added;
}

/* What is proved comes before pieces that are only certified, and may be functions of it. */
static void keep_piece(nh_current_checker *b, const nh_current *f)
{
    nh_analysis *r = b->result;
    nh_current aside[NH_MOST_PIECES];
    bool stays[NH_MOST_PIECES] = {0};
    size_t certified = 0;
    for (size_t k = 0; k < r->pieces; k++) {
        stays[k] = r->piece[k].proof.proved || !f->proof.proved;
        if (!stays[k]) aside[certified++] = r->piece[k];
    }
    nh_current_list_keep_pieces(r, stays);
    if (add_piece(b, f)) nh_described_fill(b, &r->piece[r->pieces - 1]);
    for (size_t k = 0; k < certified; k++) add_piece(b, &aside[k]);
}

/* Describes a true current that holds everywhere; one that holds in a part of the motions becomes a piece, and false is
 * returned. */
static bool holds_everywhere(nh_current_checker *b, nh_current *f)
{
    f->region = nh_currents_hold(b, f);
    if (f->region && nh_currents_continue(b, f)) f->region = NULL;
    if (f->region && f->proof.sided && !b->constructs) return false; /* a simpler one may hold everywhere */
    if (f->region) {
        keep_piece(b, f);
        return false;
    }
    nh_described_fill(b, f);
    nh_specials_name(b->result, &f->letters);
    return true;
}

/* From a candidate to a current: refined, decided, described; false: it is none, or nothing new. */
static bool check(nh_current_checker *b, nh_candidate *candidate, const nh_points *fit, bool certain, nh_current *f)
{
    nh_analysis *r = b->result;
    *f = (nh_current){0};
    nh_echelon_refine(r->model, fit, candidate, &r->options);
    decide(b, candidate, f);
    b->refuted += nh_coefficients_refuted(f, &r->options);
    if (nh_coefficients_refuted(f, &r->options) && f->refined >= NH_LEAST_ALMOST && b->nears < NH_MOST_ALMOST)
        b->near[b->nears++] = candidate;
    /* exact coefficients are not those of the fit, by which it was compared */
    bool again = f->moved || !certain || (f->exact && candidate->count > 1 && candidate->only_new);
    if (!keeps(b, f, certain) || (again && nh_currents_known(b, f->phi, f->proof.proved))) return false;
    return holds_everywhere(b, f);
}

bool nh_currents_add(nh_current_checker *b, nh_candidate *candidate, const nh_points *fit, bool certain)
{
    nh_current f;
    bool good = check(b, candidate, fit, certain, &f);
    if (good) nh_current_list_append(b->result, &f);
    return good;
}

void nh_currents_add_again(nh_current_checker *b, nh_candidate *candidate, const nh_points *fit, bool certain)
{
    nh_current last = nh_current_list_take(b->result, b->result->count - 1);
    if (!nh_currents_add(b, candidate, fit, certain)) nh_current_list_append(b->result, &last);
}

/* An integral polynomial in the velocities replaces a current that is not, and is a function of it and the others: it
 * is regular where these velocities vanish, and its field is shorter. */
static bool take_place(nh_current_checker *b, const nh_current *f)
{
    nh_analysis *r = b->result;
    for (size_t k = r->count; k-- > 0;) {
        const nh_current *have = &r->found[k];
        if (have->series || have->energy || nh_counted_degree_of(r->model, have->phi) < INFINITY) continue;
        if (have->proof.all_parameters && !f->proof.all_parameters) continue;
        nh_current old = nh_current_list_take(r, k);
        if (!nh_currents_known(b, f->phi, f->proof.proved)) {
            nh_current_list_append(r, f);
            if (nh_currents_known(b, old.phi, old.proof.proved)) {
                nh_described_fill(b, &r->found[r->count - 1]);
                return true;
            }
            nh_current_list_take(r, r->count - 1);
        }
        nh_current_list_append(r, &old);
    }
    return false;
}

bool nh_currents_add_further(nh_current_checker *b, nh_candidate *candidate, const nh_points *fit, size_t degree)
{
    nh_analysis *r = b->result;
    nh_current f;
    if (!check(b, candidate, fit, true, &f) || !f.proof.proved || r->furthers == NH_MOST_FURTHER) return false;
    nh_region open = nh_region_open(r->model, &b->terrain, f.phi, &r->options, r->arena);
    if (open.count && nh_currents_continue(b, &f))
        open = nh_region_open(r->model, &b->terrain, f.phi, &r->options, r->arena);
    f.region = nh_region_text(r->model->dag, &open, r->arena);
    if (!f.region && take_place(b, &f)) return true;
    f.independence = NH_DEPENDENT;
    return nh_current_list_append_further(r, &f, degree);
}

/* Are the coefficients those of an exact relation with all parameters as symbols? */
static bool add_related(nh_current_checker *b, nh_ex phi, double quotient)
{
    nh_analysis *r = b->result;
    nh_current f = {.phi = phi, .exact = true, .quotient = quotient};
    if (nh_currents_known(b, phi, true)) return false;
    f.heldout = heldout_residual(r->model, b->heldout, phi);
    f.proof = nh_prove_claim(r->model, phi, (nh_claim){.free = true, .related = true}, &r->options);
    bool good = keeps(b, &f, true) && holds_everywhere(b, &f);
    if (good) nh_current_list_append(r, &f);
    return good;
}

size_t nh_currents_exchange_last(nh_current_checker *b, nh_ex phi, bool *exchanged)
{
    nh_current last = nh_current_list_take(b->result, b->result->count - 1);
    bool added = add_related(b, phi, last.quotient);
    *exchanged = added && nh_currents_known(b, last.phi, last.proof.proved);
    if (!*exchanged) nh_current_list_append(b->result, &last);
    return added && !*exchanged;
}

bool nh_currents_add_series(nh_current_checker *b, nh_ex phi, const nh_series *series, double digits,
                            const char *meaning)
{
    nh_analysis *r = b->result;
    nh_current f = {.phi = phi, .series = series, .quotient = pow(10, -digits), .asked = true, .refined = digits};
    if (nh_declared_unspecified(r->model->dag)) return false; /* of the stand-in */
    if (nh_currents_known(b, f.phi, f.proof.proved)) return false;
    f.heldout = heldout_residual(r->model, b->heldout, phi);
    f.proof = nh_prove_current(r->model, phi, false, &r->options);
    nh_coefficients_certify(&r->options, &f);
    if (!keeps(b, &f, true)) return false;
    nh_described_fill(b, &f);
    if (meaning) f.meaning = meaning;
    nh_current_list_append(r, &f);
    return true;
}

static bool is_certified_only(const nh_current *f) { return !f->proof.proved && !f->series; }

size_t nh_currents_set_aside(nh_current_checker *b, nh_current **aside)
{
    return nh_current_list_take_all(b->result, is_certified_only, aside);
}

void nh_currents_take_back(nh_current_checker *b, size_t n, const nh_current *aside)
{
    for (size_t k = 0; k < n; k++) {
        const nh_current *f = &aside[k];
        if (f->independence == NH_INDEPENDENT && nh_currents_known(b, f->phi, f->proof.proved)) continue;
        nh_current_list_append(b->result, f);
    }
}

/* The energy is expected to be conserved: where it is not, a warning says so, with its rate when that is short. */
static void miss_energy(nh_current_checker *b)
{
    enum { longest = 40 };
    nh_analysis *r = b->result;
    const nh_model *o = r->model;
    for (size_t k = 0; k < r->count; k++)
        if (r->found[k].energy) return;
    if (!(heldout_residual(o, b->generic, o->E) > r->options.heldout)) return;
    nh_ex rate = nh_model_gamma(o, o->E);
    if (nh_complexity(o->dag, rate) < 10 * longest) rate = nh_simplify(o->dag, rate);
    rate = nh_chart_in_velocities(o->chart, nh_chart_shown(o->chart, rate));
    char *text = nh_complexity(o->dag, rate) <= longest ? nh_print_string(o->dag, rate) : NULL;
    nh_analysis_warn(r, "the energy is not conserved%s%s", text ? ": it changes at the rate " : "", text ? text : "");
    r->energy_rate = text ? nh_arena_printf(r->arena, "%s", text) : NULL;
    nh_free(text);
}

/* Removes nearly conserved quantities that only approximate a function of the currents, to two digits. */
static void forget_known_almosts(nh_current_checker *b)
{
    nh_analysis *r = b->result;
    size_t kept = 0;
    for (size_t k = 0; k < r->almosts; k++)
        if (!is_known(b, r->almost[k].phi, false, r->options.sure)) r->almost[kept++] = r->almost[k];
    r->almosts = kept;
}

/* Removes pieces that are functions of currents found later. */
static void name_pieces(nh_current_checker *b)
{
    nh_analysis *r = b->result;
    bool keep[NH_MOST_PIECES] = {0};
    for (size_t k = 0; k < r->pieces; k++) keep[k] = !nh_currents_known(b, r->piece[k].phi, r->piece[k].proof.proved);
    nh_current_list_keep_pieces(r, keep);
    for (size_t k = 0; k < r->pieces; k++) r->piece[k].name = nh_currents_name(r, r->count + k + 1);
}

static bool is_known_series(const nh_current *f) { return f->series && f->independence != NH_INDEPENDENT; }

/* Removes series that are functions of closed forms found later. */
static bool forget_known_series(nh_analysis *r)
{
    nh_current *forgotten;
    return nh_current_list_take_all(r, is_known_series, &forgotten) > 0;
}

void nh_currents_recount(nh_current_checker *b)
{
    bool series = false;
    for (size_t k = 0; k < b->result->count; k++) series |= b->result->found[k].series != NULL;
    if (!series) return;
    nh_current_list_sort(b->result);
    independence(b->result, b->generic);
    forget_known_series(b->result);
}

void nh_currents_finish(nh_current_checker *b)
{
    name_pieces(b);
    forget_known_almosts(b);
    nh_current_list_sort(b->result);
    independence(b->result, b->generic);
    if (forget_known_series(b->result)) independence(b->result, b->generic);
    nh_dependence_on_known(b->result);
    miss_energy(b);
}
