/* Candidates that nearly are currents: combinations of several of them, refined with many digits. */
#include <math.h>

#include "integrals/refine.h"
#include "search/currents.h"
#include "search/current_list.h"

static size_t unite(nh_current_checker *checker, nh_ex *term, bool *leading)
{
    size_t n = 0;
    for (size_t k = 0; k < checker->nears; k++)
        for (size_t j = 0; j < checker->near[k]->count; j++) {
            size_t at = 0;
            while (at < n && term[at] != checker->near[k]->term[j]) at++;
            if (at == n) term[n++] = checker->near[k]->term[j];
            leading[at] |= j == checker->near[k]->pivot;
        }
    return n;
}

/* The pivot is a leading term that the vector contains. */
static nh_candidate joined(const nh_current_checker *checker, size_t n, const nh_ex *term, const bool *leading,
                           const double *coefficient)
{
    nh_arena *arena = checker->result->arena;
    nh_candidate c = {.all = n, .accepted = checker->near[0]->accepted};
    c.term = nh_arena_alloc(arena, (n + 1) * sizeof *c.term);
    c.coefficient = nh_arena_alloc(arena, (n + 1) * sizeof *c.coefficient);
    c.all_term = nh_arena_alloc(arena, (n + 1) * sizeof *c.all_term);
    c.all_coefficient = nh_arena_alloc(arena, (n + 1) * sizeof *c.all_coefficient);
    c.all_size = nh_arena_alloc(arena, (n + 1) * sizeof *c.all_size);
    for (size_t j = 0; j < n; j++) {
        c.all_term[j] = term[j];
        c.all_coefficient[j] = coefficient[j];
        c.all_size[j] = fabs(coefficient[j]);
        if (leading[j] && coefficient[j] != 0) c.term[0] = term[j];
    }
    return c;
}

size_t nh_currents_join(nh_current_checker *checker, const nh_points *fit)
{
    enum { most_terms = 160 };
    const nh_analysis *result = checker->result;
    size_t n = 0, added = 0;
    for (size_t k = 0; k < checker->nears; k++) n += checker->near[k]->count;
    nh_ex *term = nh_alloc_array(n + 1, sizeof *term);
    bool *leading = nh_alloc_array(n + 1, sizeof *leading);
    n = unite(checker, term, leading);
    nh_refined better = {0};
    if (checker->nears > 1 && n <= most_terms)
        better = nh_refine(result->question->model, n, term, leading, &result->question->options);
    for (size_t k = 0; k < better.count; k++) {
        if (better.digits[k] < result->question->options.digits) continue;
        nh_candidate c = joined(checker, n, term, leading, better.coefficient + k * n);
        added += nh_currents_add(checker, &c, fit, false);
    }
    checker->nears = 0;
    nh_refined_clear(&better);
    nh_free(leading);
    nh_free(term);
    return added;
}

/* ---- certified ones, aside ---- */

static bool is_certified_only(const nh_current *f) { return !f->proof.proved && !f->series; }

size_t nh_currents_set_aside(nh_current_checker *checker, nh_current **aside)
{
    return nh_current_list_take_all(checker->result, is_certified_only, aside);
}

void nh_currents_take_back(nh_current_checker *checker, size_t n, const nh_current *aside)
{
    for (size_t k = 0; k < n; k++) {
        const nh_current *f = &aside[k];
        if (f->independence == NH_INDEPENDENT && nh_currents_known(checker, f->phi, f->proof.proved)) continue;
        nh_current_list_append(checker->result, f);
    }
}
