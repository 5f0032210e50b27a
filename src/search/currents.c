/* currents: what a null vector has to pass before it is a current.
 *
 *     nh_echelon_refine                 a short support, fitted again
 *     nh_coefficients_assemble          many digits, exact coefficients, letters for numbers inside of terms
 *     nh_currents_residual              points that no fit has seen
 *     nh_prove_claim                    proof, or digits in balls                  [docs/method.md, sec. 4]
 *     keeps                             no certificate: left out, perhaps as almost conserved
 *     nh_currents_hold, _continue       everywhere? else a piece, or its continuation [docs/method.md, sec. 5]
 *     nh_described_fill                 symmetry, kind, words
 *
 * At the end all currents are ranked once more: doubles propose, balls decide. */
#include "search/currents.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "graph/declared.h"
#include "graph/diff.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/print.h"
#include "integrals/fitted.h"
#include "search/coefficients.h"
#include "search/counted.h"
#include "search/current_list.h"
#include "search/dependence.h"
#include "search/described.h"
#include "search/specials.h"

enum { heldout_count = 256, generic_count = 24, open_digits = 12, least_of_a_fit = 2, digits_of_a_fit = 3 };

/* Decides whether it is a current. */
static void decide(nh_current_checker *checker, nh_candidate *c, nh_current *f)
{
    nh_analysis *result = checker->result;
    nh_model *model = result->question->model;
    const nh_options *options = &result->question->options;
    f->quotient = c->quotient;
    if (nh_fitted_is(model)) return nh_currents_fit(checker, c, f);
    nh_claim claim = {0};
    f->phi = nh_coefficients_assemble(model, c, options, f, &claim);
    f->heldout = nh_currents_residual(model, checker->heldout, f->phi);
    if (nh_coefficients_refuted(f, options)) return;
    f->proof = nh_prove_claim(model, f->phi, claim, options);
    nh_coefficients_certify(options, f);
    /* rounding within the terms is no rate: balls have measured it, at other points */
    if (f->heldout > options->heldout && f->proof.digits >= open_digits) f->heldout = pow(10, -f->proof.digits);
}

/* Refines combinations that doubles propose, with many digits at exact points, which decide. */
static void decide_ranks(nh_analysis *result, const nh_ex *phi, nh_independence *kind)
{
    nh_ex *list = nh_alloc_array(result->list->count + 1, sizeof *list);
    size_t n = 0;
    for (size_t k = 0; k < result->list->count; k++) {
        list[n] = phi[k];
        if (kind[k] == NH_CONSTANT || result->list->found[k].series) {
            n += kind[k] == NH_INDEPENDENT;
            continue;
        }
        nh_rank *rank = &nh_current_list_describe(result, &result->list->found[k])->rank;
        *rank = nh_rank_decide(result->question->model, n, list, result->question->options.doubt);
        if (rank->answer != NH_RANK_UNDECIDED) kind[k] = rank->answer == NH_RANK_GROWS ? NH_INDEPENDENT : NH_DEPENDENT;
        n += kind[k] == NH_INDEPENDENT;
    }
    nh_free(list);
}

/* kind and rank of all currents in their order, names, and relations of those that are dependent. */
static void independence(nh_analysis *result, const nh_points *generic)
{
    const nh_current_list *list = result->list;
    nh_ex *phi = nh_alloc_array(list->count + 1, sizeof *phi);
    nh_independence *kind = nh_alloc_array(list->count + 1, sizeof *kind);
    double *fraction = nh_alloc_array(list->count + 1, sizeof *fraction);
    bool *exact = nh_alloc_array(list->count + 1, sizeof *exact);
    nh_current_list_formulas(result->list, phi, exact);
    nh_independence_test(result->question->model, generic, list->count, phi, exact, result->question->options.sure,
                         result->question->options.doubt, kind, fraction);
    nh_free(exact);
    decide_ranks(result, phi, kind);
    nh_current_list_rank(result, kind, fraction);
    nh_current_list_name_all(result);
    nh_free(fraction);
    nh_free(kind);
    nh_free(phi);
    nh_dependence_relations(result);
}

/* Root mean square of Gamma(Phi) over that of Phi - mean(Phi). */
static double relative_rate(const nh_model *model, const nh_points *points, nh_ex phi)
{
    nh_ex pair[2] = {phi, nh_model_gamma(model, phi)};
    double *value = nh_alloc_array(2 * points->count, sizeof *value), mean = 0, variation = 0, rate = 0;
    nh_points_evaluate(points, model, 2, pair, value);
    for (size_t p = 0; p < points->count; p++) mean += value[p] / (double)points->count;
    for (size_t p = 0; p < points->count; p++) {
        variation += pow(value[p] - mean, 2);
        rate += pow(value[points->count + p], 2);
    }
    nh_free(value);
    return variation > 0 && isfinite(rate) ? sqrt(rate / variation) : NAN;
}

/* Is it, to two digits, a function of a nearly conserved quantity that is recorded? */
static bool is_noted(const nh_current_checker *checker, nh_ex phi)
{
    const nh_analysis *r = checker->result;
    double sure = r->question->options.sure;
    for (size_t k = 0; k < r->almosts; k++) {
        nh_ex pair[2] = {r->almost[k].phi, phi};
        nh_independence kind[2];
        nh_independence_test(r->question->model, checker->generic, 2, pair, NULL, sure, sure, kind, NULL);
        if (kind[1] != NH_INDEPENDENT) return true;
    }
    return false;
}

/* Records a combination that is no current, or not certainly one, although doubles could not tell: as a slow quantity
 * when it changes slowly.  The slowest come first. */
static void note_almost(nh_current_checker *checker, const nh_current *f, double digits)
{
    nh_analysis *result = checker->result;
    double rate = relative_rate(result->question->model, checker->generic, f->phi),
           unit = result->question->pace > 0 ? result->question->pace : 1;
    if (!(rate <= result->question->options.slow * unit) || digits < (f->fitted ? least_of_a_fit : NH_LEAST_ALMOST))
        return;
    if (f->fitted && is_noted(checker, f->phi)) return;
    if (!result->almost) result->almost = nh_arena_alloc(result->arena, NH_MOST_ALMOST * sizeof *result->almost);
    size_t at = result->almosts;
    while (at > 0 && result->almost[at - 1].rate > rate) at--;
    if (at == NH_MOST_ALMOST) return;
    if (result->almosts < NH_MOST_ALMOST) result->almosts++;
    for (size_t k = result->almosts - 1; k > at; k--) result->almost[k] = result->almost[k - 1];
    nh_current copy = *f;
    nh_current_in_velocities(checker, &copy);
    result->almost[at] = (nh_near_current){f->phi, copy.in_velocities, digits, rate};
}

/* A candidate is no current when it fails on held-out points, is refuted exactly, or does not cancel with many digits:
 * it is left out, with a warning.  A candidate without a certificate is left out too, also where nothing refutes it:
 * whether it is conserved stays open. */
static bool keeps(nh_current_checker *checker, const nh_current *f, bool certain)
{
    nh_analysis *result = checker->result;
    const nh_options *options = &result->question->options;
    if (f->fitted && f->heldout <= options->heldout && f->fit_digits >= digits_of_a_fit) return true;
    if (f->fitted) return note_almost(checker, f, -log10(f->heldout)), false;
    if (nh_coefficients_certain(f, options)) return true;
    if (nh_coefficients_refuted(f, options)) {
        note_almost(checker, f, f->refined);
        return false;
    }
    /* it was only likely: where it cancels as far as doubles go the question stays open, otherwise it is answered */
    if (!certain) {
        result->open += f->proof.digits >= open_digits;
        return false;
    }
    /* fitted coefficients never cancel further */
    if (f->heldout <= options->heldout && !(f->exact && f->proof.refuted)) {
        result->open++;
        note_almost(checker, f, f->proof.digits);
        return false;
    }
    nh_analysis_warn(result,
                     "rejected a combination that fits the samples to %.1e: it is not conserved (held-out residual "
                     "%.1e, its rate cancels to %.0f digits)",
                     f->quotient, f->heldout, f->proof.digits);
    return false;
}

nh_current_checker *nh_current_checker_create(nh_analysis *result, nh_error *error)
{
    uint64_t seed = (uint64_t)result->question->options.seed;
    nh_current_checker *checker = nh_alloc(sizeof *checker);
    checker->result = result;
    checker->heldout = nh_points_create(result->question->model, heldout_count, 1.7, seed + 101, error);
    checker->generic =
        checker->heldout ? nh_points_create(result->question->model, generic_count, 1, seed + 202, error) : NULL;
    checker->inverse = nh_alloc_array(result->question->model->n + 1, sizeof *checker->inverse);
    if (!checker->generic) {
        nh_current_checker_free(checker);
        return NULL;
    }
    checker->invertible = nh_chart_inverse(result->question->model->chart, checker->inverse);
    if (!checker->invertible)
        nh_analysis_warn(
            result,
            "the currents are not given in coordinate velocities: the chart is not affine in its quasi-velocities");
    return checker;
}

void nh_current_checker_free(nh_current_checker *checker)
{
    if (!checker) return;
    nh_points_free(checker->generic);
    nh_points_free(checker->heldout);
    nh_free(checker->inverse);
    nh_free(checker);
}

nh_independence nh_currents_beside(const nh_analysis *result, const nh_points *points, nh_ex current, bool own,
                                   double doubt)
{
    const nh_current_list *list = result->list;
    nh_ex *phi = nh_alloc_array(list->count + 1, sizeof *phi);
    nh_independence *kind = nh_alloc_array(list->count + 1, sizeof *kind);
    bool *exact = nh_alloc_array(list->count + 1, sizeof *exact);
    nh_current_list_formulas(result->list, phi, exact);
    phi[list->count] = current;
    exact[list->count] = own;
    nh_independence_test(result->question->model, points, list->count + 1, phi, exact, result->question->options.sure,
                         doubt, kind, NULL);
    nh_independence out = kind[list->count];
    nh_free(exact);
    nh_free(kind);
    nh_free(phi);
    return out;
}

static bool is_known(const nh_current_checker *checker, nh_ex current, bool own, double doubt)
{
    return nh_currents_beside(checker->result, checker->generic, current, own, doubt) != NH_INDEPENDENT;
}

bool nh_currents_known(const nh_current_checker *checker, nh_ex current, bool exact)
{
    return is_known(checker, current, exact, checker->result->question->options.doubt);
}

/* ---- the list ---- */

static void describe(nh_current_checker *checker, const nh_current *entry)
{
    nh_described_fill(checker, nh_current_list_describe(checker->result, entry));
}

/* A function of the currents and the pieces so far is left out. */
static bool add_piece(nh_current_checker *checker, const nh_current *f)
{
    nh_analysis *result = checker->result;
    const nh_current_list *list = result->list;
    size_t n = list->count + list->pieces;
    nh_ex *phi = nh_alloc_array(n + 1, sizeof *phi);
    nh_independence *kind = nh_alloc_array(n + 1, sizeof *kind);
    for (size_t k = 0; k < n; k++) phi[k] = k < list->count ? list->found[k].phi : list->piece[k - list->count].phi;
    phi[n] = f->phi;
    nh_independence_test(result->question->model, checker->generic, n + 1, phi, NULL, result->question->options.sure,
                         result->question->options.doubt, kind, NULL);
    bool added = kind[n] == NH_INDEPENDENT && nh_current_list_append_piece(result, f);
    nh_free(kind);
    nh_free(phi);
    return added;
}

/* What is proved comes before pieces that are only certified, and may be functions of it. */
static void keep_piece(nh_current_checker *checker, const nh_current *f)
{
    nh_analysis *result = checker->result;
    const nh_current_list *list = result->list;
    nh_current aside[NH_MOST_PIECES];
    bool stays[NH_MOST_PIECES] = {0};
    size_t certified = 0;
    for (size_t k = 0; k < list->pieces; k++) {
        stays[k] = list->piece[k].proof.proved || !f->proof.proved;
        if (!stays[k]) aside[certified++] = list->piece[k];
    }
    nh_current_list_keep_pieces(result, stays);
    if (add_piece(checker, f)) describe(checker, &list->piece[list->pieces - 1]);
    for (size_t k = 0; k < certified; k++) add_piece(checker, &aside[k]);
}

/* Describes a true current that holds everywhere; one that holds in a part of the motions becomes a piece, and false is
 * returned. */
static bool holds_everywhere(nh_current_checker *checker, nh_current *f)
{
    f->region = nh_currents_hold(checker, f);
    if (f->region && nh_currents_continue(checker, f)) f->region = NULL;
    if (f->region && f->proof.sided && !checker->constructs) return false; /* a simpler one may hold everywhere */
    if (f->region) {
        keep_piece(checker, f);
        return false;
    }
    nh_described_fill(checker, f);
    nh_specials_name(checker->result, &f->letters);
    return true;
}

/* From a candidate to a current: refined, decided, described; false: it is none, or nothing new. */
static bool check(nh_current_checker *checker, nh_candidate *candidate, const nh_points *fit, bool certain,
                  nh_current *f)
{
    nh_analysis *result = checker->result;
    const nh_options *options = &result->question->options;
    *f = (nh_current){0};
    nh_echelon_refine(result->question->model, fit, candidate, options);
    decide(checker, candidate, f);
    checker->refuted += nh_coefficients_refuted(f, options);
    if (nh_coefficients_refuted(f, options) && f->refined >= NH_LEAST_ALMOST && checker->nears < NH_MOST_ALMOST)
        checker->near[checker->nears++] = candidate;
    /* exact coefficients are not those of the fit, by which it was compared */
    bool again = f->moved || !certain || (f->exact && candidate->count > 1 && candidate->only_new);
    if (!keeps(checker, f, certain) || (again && nh_currents_known(checker, f->phi, f->proof.proved))) return false;
    return holds_everywhere(checker, f);
}

bool nh_currents_add(nh_current_checker *checker, nh_candidate *candidate, const nh_points *fit, bool certain)
{
    nh_current f;
    bool good = check(checker, candidate, fit, certain, &f);
    if (good) nh_current_list_append(checker->result, &f);
    return good;
}

void nh_currents_add_again(nh_current_checker *checker, nh_candidate *candidate, const nh_points *fit, bool certain)
{
    nh_current last = nh_current_list_take(checker->result, checker->result->list->count - 1);
    if (!nh_currents_add(checker, candidate, fit, certain)) nh_current_list_append(checker->result, &last);
}

/* An integral polynomial in the velocities replaces a current that is not, and is a function of it and the others: it
 * is regular where these velocities vanish, and its field is shorter. */
static bool take_place(nh_current_checker *checker, const nh_current *f)
{
    nh_analysis *result = checker->result;
    const nh_current_list *list = result->list;
    for (size_t k = list->count; k-- > 0;) {
        const nh_current *have = &list->found[k];
        if (have->series || have->energy || nh_counted_degree_of(result->question->model, have->phi) < INFINITY)
            continue;
        if (have->proof.all_parameters && !f->proof.all_parameters) continue;
        nh_current old = nh_current_list_take(result, k);
        if (!nh_currents_known(checker, f->phi, f->proof.proved)) {
            nh_current_list_append(result, f);
            if (nh_currents_known(checker, old.phi, old.proof.proved)) {
                describe(checker, &list->found[list->count - 1]);
                return true;
            }
            nh_current_list_take(result, list->count - 1);
        }
        nh_current_list_append(result, &old);
    }
    return false;
}

bool nh_currents_add_further(nh_current_checker *checker, nh_candidate *candidate, const nh_points *fit, size_t degree)
{
    nh_analysis *result = checker->result;
    nh_model *model = result->question->model;
    nh_current f;
    if (!check(checker, candidate, fit, true, &f) || !f.proof.proved || result->list->furthers == NH_MOST_FURTHER)
        return false;
    nh_region open = nh_region_open(model, &checker->terrain, f.phi, &result->question->options, result->arena);
    if (open.count && nh_currents_continue(checker, &f))
        open = nh_region_open(model, &checker->terrain, f.phi, &result->question->options, result->arena);
    f.region = nh_region_text(model->dag, &open, result->arena);
    if (!f.region && take_place(checker, &f)) return true;
    f.independence = NH_DEPENDENT;
    return nh_current_list_append_further(result, &f, degree);
}

/* Are the coefficients those of an exact relation with all parameters as symbols? */
static bool add_related(nh_current_checker *checker, nh_ex phi, double quotient)
{
    nh_analysis *result = checker->result;
    nh_current f = {.phi = phi, .exact = true, .quotient = quotient, .fit_digits = INFINITY};
    if (nh_currents_known(checker, phi, true)) return false;
    f.fitted = nh_fitted_is(result->question->model);
    f.heldout = nh_currents_residual(result->question->model, checker->heldout, phi);
    f.proof = nh_prove_claim(result->question->model, phi, (nh_claim){.free = true, .related = true},
                             &result->question->options);
    bool good = keeps(checker, &f, true) && holds_everywhere(checker, &f);
    if (good) nh_current_list_append(result, &f);
    return good;
}

bool nh_currents_exchange_last(nh_current_checker *checker, nh_ex phi)
{
    nh_current last = nh_current_list_take(checker->result, checker->result->list->count - 1);
    bool added = add_related(checker, phi, last.quotient);
    bool exchanged = added && nh_currents_known(checker, last.phi, last.proof.proved);
    if (!exchanged) nh_current_list_append(checker->result, &last);
    return exchanged;
}

bool nh_currents_add_series(nh_current_checker *checker, nh_ex phi, const nh_series *series, double digits,
                            const char *meaning)
{
    nh_analysis *result = checker->result;
    nh_model *model = result->question->model;
    nh_current f = {.phi = phi, .series = series, .quotient = pow(10, -digits), .asked = true, .refined = digits};
    if (nh_declared_unspecified(model->dag) || nh_fitted_is(model)) return false; /* of the stand-in; of a table */
    if (nh_currents_known(checker, f.phi, f.proof.proved)) return false;
    f.heldout = nh_currents_residual(model, checker->heldout, phi);
    f.proof = nh_prove_current(model, phi, false, &result->question->options);
    nh_coefficients_certify(&result->question->options, &f);
    if (!keeps(checker, &f, true)) return false;
    nh_described_fill(checker, &f);
    if (meaning) f.meaning = meaning;
    nh_current_list_append(result, &f);
    return true;
}

/* The energy is expected to be conserved: where it is not, a warning says so, with its rate when that is short. */
static void miss_energy(nh_current_checker *checker)
{
    enum { longest = 40 };
    nh_analysis *result = checker->result;
    const nh_model *model = result->question->model;
    for (size_t k = 0; k < result->list->count; k++)
        if (result->list->found[k].energy) return;
    if (!(nh_currents_residual(model, checker->generic, model->E) > result->question->options.heldout)) return;
    nh_ex rate = nh_model_gamma(model, model->E);
    if (nh_complexity(model->dag, rate) < 10 * longest) rate = nh_simplify(model->dag, rate);
    rate = nh_chart_in_velocities(model->chart, nh_chart_shown(model->chart, rate));
    char *text = nh_complexity(model->dag, rate) <= longest ? nh_print_string(model->dag, rate) : NULL;
    nh_analysis_warn(result, "the energy is not conserved%s%s", text ? ": it changes at the rate " : "",
                     text ? text : "");
    result->energy_rate = text ? nh_arena_printf(result->arena, "%s", text) : NULL;
    nh_free(text);
}

/* Removes nearly conserved quantities that only approximate a function of the currents, to two digits. */
static void forget_known_almosts(nh_current_checker *checker)
{
    nh_analysis *result = checker->result;
    size_t kept = 0;
    for (size_t k = 0; k < result->almosts; k++)
        if (!is_known(checker, result->almost[k].phi, false, result->question->options.sure))
            result->almost[kept++] = result->almost[k];
    result->almosts = kept;
}

/* Removes pieces that are functions of currents found later. */
static void name_pieces(nh_current_checker *checker)
{
    nh_analysis *result = checker->result;
    const nh_current_list *list = result->list;
    bool keep[NH_MOST_PIECES] = {0};
    for (size_t k = 0; k < list->pieces; k++)
        keep[k] = !nh_currents_known(checker, list->piece[k].phi, list->piece[k].proof.proved);
    nh_current_list_keep_pieces(result, keep);
    for (size_t k = 0; k < list->pieces; k++)
        nh_current_list_describe(result, &list->piece[k])->name = nh_current_list_name(result, list->count + k + 1);
}

static bool is_known_series(const nh_current *f) { return f->series && f->independence != NH_INDEPENDENT; }

/* Removes series that are functions of closed forms found later. */
static bool forget_known_series(nh_analysis *result)
{
    nh_current *forgotten;
    return nh_current_list_take_all(result, is_known_series, &forgotten) > 0;
}

void nh_currents_recount(nh_current_checker *checker)
{
    bool series = false;
    for (size_t k = 0; k < checker->result->list->count; k++) series |= checker->result->list->found[k].series != NULL;
    if (!series) return;
    nh_current_list_sort(checker->result);
    independence(checker->result, checker->generic);
    forget_known_series(checker->result);
}

void nh_currents_finish(nh_current_checker *checker)
{
    name_pieces(checker);
    forget_known_almosts(checker);
    nh_current_list_sort(checker->result);
    nh_described_by_source(checker);
    independence(checker->result, checker->generic);
    if (forget_known_series(checker->result)) independence(checker->result, checker->generic);
    nh_dependence_on_known(checker->result);
    miss_energy(checker);
}
