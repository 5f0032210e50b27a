/* missing_construct: closed forms of the integrals that the count misses: proposed by series, then found and proved.
 *
 *     nh_construct          series of the missing integrals, compared with words up to a price      (count/construct.h)
 *        |  terms, without coefficients
 *     lift                  coefficients modulo primes, for all parameters (count/lift.h); else as a small stage
 *        |  a current
 *     price rises: 2, 3, 4, 6, 8, ..    shapes: closed shape, without cyclic coordinates, every coordinate
 *
 * What gave nothing is remembered (barren, refused): the same question is not asked again. */
#include <math.h>
#include <string.h>

#include "base/budget.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "count/lift.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "integrals/echelon.h"
#include "search/counted.h"
#include "search/currents.h"
#include "search/missing_internal.h"
#include "search/naming.h"

typedef nh_missing_search search;
typedef nh_missing_manner manner;
typedef nh_missing_barren barren;

/* Chooses the null vector with the most complex term: the simpler terms are those of known integrals. */
static bool lift_further(search *s, size_t degree, const nh_family *all)
{
    nh_analysis *r = s->solver->r;
    bool found = false;
    nh_solved x = nh_stage_solver_solve(s->solver, 1, all);
    if (x.nullspace && x.nullspace->dimension) {
        nh_candidates *list =
            nh_echelon(r->question->model, x.fit, x.ansatz, x.nullspace, x.nullspace->dimension, &r->question->options);
        for (size_t k = 0; k < list->count && !found; k++) {
            bool leads = false;
            for (size_t j = 0; j < list->candidate[k].count; j++) leads |= list->candidate[k].term[j] == all->term[0];
            found = leads && nh_currents_add_further(s->solver->bench, &list->candidate[k], x.fit, degree);
        }
        s->solver->bench->nears = 0; /* they are of the list */
        nh_candidates_free(list);
    }
    nh_solved_clear(&x);
    return found;
}

enum { most_constants = 10 };

static bool is_constant_of_leaf(const nh_model *model, const nh_current *f)
{
    return f->proof.proved && !nh_counted_has_velocities(model, f->phi) &&
           !nh_depends(model->dag, f->phi, model->system->t);
}

/* sqrt(x^2 + y^2) as x^2 + y^2: coefficients are polynomials in that. */
static nh_ex without_root(nh_dag *d, nh_ex e)
{
    bool root = nh_kind_of(d, e) == NH_PRODUCT && nh_arity(d, e) == 1 && nh_exponent_of(d, e, 0) == nh_ratio(d, 1, 2);
    return root ? nh_child(d, e, 0) : e;
}

/* Products of what is constant on the leaves of integrable constraints, 1 first: coefficients may depend on it. */
static size_t constants_of_leaf(const nh_analysis *result, nh_ex out[most_constants])
{
    const nh_current_list *list = result->list;
    enum { highest = 2 };
    const nh_model *model = result->question->model;
    size_t n = 0, first = 0;
    out[n++] = nh_int(model->dag, 1);
    for (size_t power = 0; power < highest; power++) {
        size_t last = n;
        for (size_t k = 0; k < list->count; k++)
            for (size_t j = first; j < last && n < most_constants && is_constant_of_leaf(model, &list->found[k]); j++) {
                nh_ex product = nh_mul(model->dag, out[j], without_root(model->dag, list->found[k].phi));
                bool known = false;
                for (size_t i = 0; i < n; i++) known |= out[i] == product;
                if (!known) out[n++] = product;
            }
        first = last;
    }
    return n;
}

/* By linear equations modulo primes: exactly, and for all parameters where they occur as polynomials. */
static nh_lift_result lift_exactly(search *s, bool time, size_t terms, const nh_ex *term)
{
    nh_lift_result exact = nh_lift(s->solver->r->question->model, time, terms, term, s->work);
    s->work -= exact.work;
    return exact;
}

static bool keep_lifted(search *s, const nh_lift_result *exact, size_t terms, const char *name)
{
    nh_analysis *r = s->solver->r;
    bool found = exact->integral && nh_stage_solver_certify(s->solver, exact->integral, name);
    if (found) r->stage[r->stages - 1].columns = terms;
    return found;
}

/* By doubles: the coefficients may be roots and the like.  Longer lists take seconds, and their small coefficients are
 * lost. */
static bool lift_by_doubles(search *s, size_t degree, const nh_family *all, bool further, const char *name)
{
    enum { most_terms = 300 };
    size_t before = s->solver->r->list->count;
    if (all->terms > most_terms) return false;
    nh_stage_solver_stage(s->solver, name, 1, all);
    return s->solver->r->list->count > before || (further && lift_further(s, degree, all));
}

/* FOUND, a function of the currents (which may be found again with every price of the words), or neither: simpler words
 * may do better. */
typedef enum { LIFT_FOUND, LIFT_KNOWN, LIFT_FAILED } lifted;

/* Finds the coefficients of an integral's terms, which may be constants of the leaf.  Those of a few terms may be
 * quotients in the parameters, which the exact relation of their rates has (coefficients.c). */
static lifted lift(search *s, size_t degree, bool time, const nh_constructed *c, bool further)
{
    enum { a_few = 20 };
    nh_analysis *result = s->solver->r;
    nh_family *all = nh_arena_alloc(result->arena, sizeof *all);
    nh_ex constant[most_constants];
    size_t constants = constants_of_leaf(result, constant), terms = 0, once = 0;
    nh_ex *term = nh_arena_alloc(result->arena, constants * c->terms * sizeof *term),
          *first_once = nh_arena_alloc(result->arena, constants * c->terms * sizeof *first_once);
    for (size_t j = 0; j < c->terms; j++)
        for (size_t k = 0; k < constants; k++) {
            term[terms] = nh_mul(result->question->model->dag, c->term[j], constant[k]);
            if (j || !k) first_once[once++] = term[terms];
            terms++;
        }
    *all = (nh_family){.kind = NH_TERMS, .terms = terms, .term = term};
    s->solver->wide = true;
    const char *name = nh_arena_printf(result->arena, "an integral of degree %zu that the count misses", degree);
    nh_lift_result exact = further ? (nh_lift_result){0} : lift_exactly(s, time, once, first_once);
    bool first = exact.general || once > a_few;
    if (first && keep_lifted(s, &exact, once, name)) return LIFT_FOUND;
    if (exact.integral && nh_currents_known(s->solver->bench, exact.integral, true)) return LIFT_KNOWN;
    if (lift_by_doubles(s, degree, all, further, name)) return LIFT_FOUND;
    return !first && keep_lifted(s, &exact, once, name) ? LIFT_FOUND : LIFT_FAILED;
}

/* These terms, where they were tried before. */
static const nh_missing_refused *refused_before(const search *s, const nh_constructed *c, bool further)
{
    for (size_t i = 0; i < s->refusals; i++) {
        const nh_missing_refused *a = &s->refused[i];
        if (a->further == further && a->terms == c->terms && !memcmp(a->term, c->term, c->terms * sizeof *c->term))
            return a;
    }
    return NULL;
}

static void refuse(search *s, const nh_constructed *c, bool further, bool known)
{
    if (s->refusals == NH_MISSING_MOST_REFUSED) return;
    nh_ex *term = nh_arena_alloc(s->solver->r->arena, c->terms * sizeof *term);
    memcpy(term, c->term, c->terms * sizeof *term);
    s->refused[s->refusals++] = (nh_missing_refused){c->terms, term, further, known};
}

static bool is_over(const search *s, bool further)
{
    return further ? nh_budget_spent() || nh_late() || s->solver->r->list->furthers == NH_MOST_FURTHER
                   : nh_stage_solver_done(s->solver);
}

/* The same question as before, as far as the work goes; NULL: it was not asked, or there was something new. */
static const barren *asked_before(const search *s, const barren *now)
{
    for (size_t i = 0; i < s->barrens; i++) {
        const barren *b = &s->barren[i];
        if (b->how.further == now->how.further && b->how.secular == now->how.secular &&
            b->how.weights == now->how.weights && b->how.shape == now->how.shape && b->time == now->time &&
            b->rates == now->rates && b->only == now->only && b->degree == now->degree && b->price == now->price &&
            b->given == now->given)
            return b;
    }
    return NULL;
}

/* What the construction before has found out, without its work being done again. */
static void take(search *s, const barren *b, bool *more)
{
    s->work -= b->work;
    if (b->solutions > s->solutions) s->solutions = b->solutions;
    if (b->recognised && b->solutions > s->recognised) s->recognised = b->solutions;
    if (b->whole) s->covered = b->price;
    *more = b->more;
}

/* Tries the words up to one price. */
static bool construct_at(search *s, const nh_completeness *c, manner how, double price, bool *more)
{
    nh_analysis *r = s->solver->r;
    bool further = how.further;
    size_t degree = further ? c->incomplete_at : c->missing_at;
    barren now = {.how = {how.further, how.secular, how.weights, how.shape, NULL},
                  .time = c->count.time,
                  .rates = how.rates != NULL,
                  .only = how.rates && how.rates->only,
                  .degree = degree,
                  .price = price,
                  .given = s->work};
    const barren *before = asked_before(s, &now);
    if (before) return take(s, before, more), false;
    nh_ex *phi = nh_alloc_array(nh_missing_most_proved(r), sizeof *phi);
    bool general, found = false;
    nh_construct_question q = {.time = c->count.time,
                               .shape = how.shape,
                               .further = further,
                               .secular = how.secular,
                               .weights = how.weights,
                               .rates = how.rates,
                               .degree = degree,
                               .price = price,
                               .most_words = (size_t)r->question->options.words,
                               .work = s->work,
                               .threads = nh_threads(r->question->options.threads),
                               .current = phi};
    q.known = nh_counted_proved(r, phi, &general, &q.independent);
    size_t regional = nh_counted_regional(r, phi + q.known, &general);
    q.known += regional;
    q.independent += regional;
    nh_construction *x = nh_construct(r->question->model, &q);
    now.work = x->work;
    now.solutions = x->solutions;
    now.whole = x->whole;
    /* an integral that could not be proved may have a simpler form in words of a higher price */
    size_t unproved = 0, unproved_again = 0;
    for (size_t k = 0; k < x->count && !is_over(s, further); k++) {
        const nh_missing_refused *old = refused_before(s, &x->item[k], further);
        unproved_again += old && !old->known;
        if (old) continue;
        lifted l = lift(s, degree, q.time, &x->item[k], further);
        if (l != LIFT_FOUND) refuse(s, &x->item[k], further, l == LIFT_KNOWN);
        found |= l == LIFT_FOUND;
        unproved += l == LIFT_FAILED;
    }
    bool all = x->recognised == x->dimension;
    now.recognised = !x->limited && all && !unproved && !unproved_again;
    now.more = !x->limited && (!all || unproved);
    take(s, &now, more);
    if (!x->count && !nh_late() && s->barrens < NH_MISSING_MOST_BARREN) s->barren[s->barrens++] = now;
    nh_construction_free(x);
    nh_free(phi);
    return found;
}

/* Raises the price of the words until something is found. */
static bool construct_up_to(search *s, const nh_completeness *c, manner how, double dearest, double work)
{
    bool found = false, more = true;
    s->work = work;
    s->solutions = 0;
    for (double price = 2; more && !found && price <= dearest && s->work > 0 && !is_over(s, how.further);
         price += price < 4 ? 1 : 2)
        if (how.weights || price > s->covered) found = construct_at(s, c, how, price, &more);
    return found;
}

/* Is the number with time in the coefficients no larger than without? */
static bool adds_nothing(const nh_analysis *result, const nh_completeness *c)
{
    const nh_completeness *first = &result->completeness[NH_COMPLETE_IN_COORDINATES];
    return c != first && first->counted && first->missing_at == c->missing_at && c->missing_at &&
           first->count.row[c->missing_at - 1].bound == c->count.row[c->missing_at - 1].bound;
}

/* Tries the shape first, the closed one before the other.  Where it has as many solutions as there are, more
 * coordinates give no others: *shape is then the one that is enough. */
static bool construct_in_shapes(search *s, const nh_completeness *c, manner how, double dearest, double work,
                                nh_count_shape *shape)
{
    static const nh_count_shape order[] = {NH_CLOSED_SHAPE, NH_NOT_CYCLIC, NH_EVERY_COORDINATE};
    size_t degree = how.further ? c->incomplete_at : c->missing_at, all = c->count.row[degree - 1].bound;
    bool found = false, enough = false;
    for (size_t i = s->cyclic > 1 ? 0 : s->cyclic ? 1 : 2; i < sizeof order / sizeof *order && !found && !enough; i++) {
        manner own = how;
        own.shape = *shape = order[i];
        if (own.shape != NH_EVERY_COORDINATE) own.rates = NULL;
        s->covered = 0;
        own.weights = true;
        found = construct_up_to(s, c, own, dearest, work);
        own.weights = false;
        if (!found) found = construct_up_to(s, c, own, dearest, work);
        enough = s->solutions == all;
    }
    return found;
}

/* Tries one kind of coefficients.  In t alone most coefficients are waves, which the words do not contain, and a count
 * that is not settled is mostly far too large. */
bool nh_missing_construct(search *s, const nh_completeness *c, bool further)
{
    /* parts of the work: for rare functions, and for integrals that the currents found determine */
    static const double part = 0.25, further_part = 0.08;
    double dearest = c->count.time ? 6 : 16, dearest_secular = 6,
           work = s->solver->r->question->options.construct * (further ? further_part : 1);
    bool wanted = further || (c->counted && c->missing_at && c->missing && (c->settled || !c->count.time) &&
                              !adds_nothing(s->solver->r, c));
    if (!wanted) return false;
    size_t degree = further ? c->incomplete_at : c->missing_at;
    nh_ex atom[NH_NAMING_ATOMS];
    const nh_model *model = s->solver->r->question->model;
    nh_construct_rates rates =
        nh_construct_rates_of(model, degree, c->count.time, nh_naming_atoms(model, atom), atom, part * work);
    manner any = {.further = further, .rates = &rates}, secular = any;
    secular.secular = true;
    work = fmax(work - rates.work, 0);
    nh_construct_rates only = rates;
    only.only = true;
    manner by_rates = {.further = further, .rates = &only};
    bool before = c->count.time && !further;
    if (before && nh_primitives_search(s->solver, true, degree)) return true;
    if (rates.count && construct_up_to(s, c, by_rates, dearest, further ? work : part * work)) return true;
    s->covered = s->recognised = 0;
    if (construct_in_shapes(s, c, any, dearest, work, &secular.shape)) return true;
    s->covered = 0;
    bool others = s->recognised < c->count.row[degree - 1].bound;
    return (!further && !before && nh_primitives_search(s->solver, c->count.time, c->missing_at)) ||
           (others && !c->count.time && construct_up_to(s, c, secular, dearest_secular, part * work));
}
