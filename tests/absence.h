/* absence: what the program says of a system, and what of that can be compared: for test_absence_systems and bench_absence. */
#ifndef NH_TESTS_ABSENCE_H
#define NH_TESTS_ABSENCE_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "absence/absence.h"
#include "absence_systems.h"
#include "base/clock.h"
#include "commands/analyze.h"
#include "graph/node.h"
#include "graph/print.h"
#include "scratch.h"

enum { absence_points = 24 };
static double absence_seconds; /* of the processor, for the last decision without the search before it */

/* The analysis of a file, with the question whether there is any other integral, asked of all planes and engines; the caller frees it.
 * NULL: there is none. */
static inline nh_analysis *absence_of_file(const char *path, nh_error *error)
{
    nh_request q = {.system_path = path};
    nh_options_default(&q.options);
    q.options.max_seconds = 1e6; /* the same on every machine */
    nh_analysis *r = nh_analysis_create(&q, error);
    double begin = nh_clock_of_process();
    if (r) nh_absence_find(r, true);
    absence_seconds = nh_clock_of_process() - begin;
    return r;
}

static inline nh_analysis *absence_of_text(const char *text, nh_error *error)
{
    char path[SCRATCH];
    if (!scratch_text(path, text)) return NULL;
    nh_analysis *r = absence_of_file(path, error);
    remove(path);
    return r;
}

/* At most so many independent integrals, as the program says; SIZE_MAX: it says nothing. */
static inline size_t absence_bound(const nh_absence *a)
{
    switch (a->verdict) {
    case NH_ABSENCE_NONE_ELSE:
    case NH_ABSENCE_DEPENDENT: return a->known;
    case NH_ABSENCE_AT_MOST: return a->at_most;
    case NH_ABSENCE_LIOUVILLE: return a->shape->count - a->shape->coordinates - 1; /* degrees of freedom */
    default: return SIZE_MAX;
    }
}

static inline const char *absence_word(const nh_absence *a)
{
    switch (a->verdict) {
    case NH_ABSENCE_NONE_ELSE: return a->rational ? "none else, rational" : "none else";
    case NH_ABSENCE_DEPENDENT: return a->rational ? "all depend on those found, rational" : "all depend on those found";
    case NH_ABSENCE_AT_MOST: return a->rational ? "at most so many, rational" : "at most so many";
    case NH_ABSENCE_LIOUVILLE: return "not by commuting integrals";
    case NH_ABSENCE_SETTLED: return "settled";
    default: return "open";
    }
}

/* ---- engines ---- */

static inline bool absence_attempt_by_kovacic(const nh_absence_attempt *t) { return t->kovacic && t->kovacic->group == NH_GROUP_SL2; }
static inline bool absence_attempt_by_balls(const nh_absence_attempt *t)
{
    return t->monodromy && t->monodromy->size && t->monodromy->rank == t->monodromy->size;
}

/* Which engines exclude something, at one plane and level or another. */
static inline unsigned absence_by(const nh_absence *a)
{
    unsigned by = a->darboux && a->darboux->refuted ? BY_LINES : 0;
    for (size_t k = 0; k < a->attempts; k++) {
        if (absence_attempt_by_kovacic(&a->attempt[k])) by |= BY_KOVACIC;
        if (absence_attempt_by_balls(&a->attempt[k])) by |= BY_BALLS;
        if (a->attempt[k].higher && a->attempt[k].higher->refuted) by |= BY_LOGARITHM;
    }
    return by;
}

/* The attempt that is shown: the one that decides, or the first with an engine; NULL: none. */
static inline const nh_absence_attempt *absence_shown(const nh_absence *a)
{
    if (a->best < a->attempts) return &a->attempt[a->best];
    for (size_t k = 0; k < a->attempts; k++)
        if (a->attempt[k].kovacic || a->attempt[k].monodromy || a->attempt[k].residues) return &a->attempt[k];
    return a->attempts ? a->attempt : NULL;
}

/* ---- integrals that exist ---- */

/* Functions that are not meromorphic, or may not be, or roots that the equations do not contain: such an integral may exist beside any
 * theorem. */
static inline bool absence_many_valued(const nh_closed_shape *shape, nh_ex phi)
{
    static const char *const words[] = {"log(", "atan", "asin", "acos", "elliptic", "legendre", "hyp", "bessel", "airy", "riemann", "gauss",
                                        "exp(", "abs(", "acosh", "e^", "/3)", "/4)", "/5)", "/6)"};
    nh_dag *dag = shape->model->dag;
    char *text = nh_print_string(dag, phi);
    bool many = false;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) many |= strstr(text, words[i]) && (words[i][0] != '/' || strstr(text, "^("));
    nh_free(text);
    NH_LIST(own);
    size_t roots = nh_radicands_in(dag, phi, &own);
    for (size_t k = 0; k < roots; k++) {
        bool letter = false;
        for (size_t i = 0; i < shape->count; i++) {
            NH_LIST(list);
            size_t n = nh_radicands_in(dag, shape->rate[i], &list);
            for (size_t j = 0; j < n; j++) letter |= list[j] == own[k];
        }
        many |= !letter;
    }
    return many;
}

/* Independent integrals among those found that the theorem speaks of: of letters of the shape only, in closed form, single-valued. */
static inline size_t absence_count(const nh_analysis *r)
{
    const nh_absence *a = r->absence;
    const nh_model *model = r->question->model;
    nh_error error = {0};
    nh_points *generic = nh_points_create(model, absence_points, 1, 4711, &error);
    nh_ex *phi = nh_alloc_array(r->list->count + 1, sizeof *phi);
    nh_independence *kind = nh_alloc_array(r->list->count + 1, sizeof *kind);
    size_t n = 0, count = 0;
    for (size_t k = 0; generic && k < r->list->count; k++) {
        const nh_current *f = &r->list->found[k];
        bool counts = f->proof.proved && !f->series && !f->local && !nh_depends(model->dag, f->phi, r->question->system->t);
        for (size_t i = 0; i < a->shape->left; i++) counts = counts && !nh_depends(model->dag, f->phi, a->shape->left_out[i]);
        if (counts && !absence_many_valued(a->shape, f->phi)) phi[n++] = f->phi;
    }
    if (n) nh_independence_test(model, generic, n, phi, NULL, r->question->options.sure, r->question->options.doubt, kind, NULL);
    for (size_t k = 0; k < n; k++) count += kind[k] == NH_INDEPENDENT;
    nh_free(kind);
    nh_free(phi);
    nh_points_free(generic);
    return count;
}

/* The same decision when only the energy is told to the engines (the first integral where there is none): those that are withheld
 * exist, so that they must not be excluded.  True: they are not. */
static inline bool absence_without(nh_analysis *r, char *why, size_t size)
{
    const nh_current_list *all = r->list;
    size_t exist = absence_count(r), kept = 0;
    for (size_t k = 0; k < all->count; k++)
        if (all->found[k].energy) kept = k;
    nh_current_list few = *all;
    few.found = all->found + kept;
    few.count = all->count ? 1 : 0;
    few.furthers = 0;
    r->list = &few;
    nh_absence_find(r, true);
    r->list = all;
    bool good = absence_bound(r->absence) >= exist;
    snprintf(why, size, "at most %zu by %s, and %zu exist", absence_bound(r->absence), absence_word(r->absence), exist);
    return good;
}

#endif
