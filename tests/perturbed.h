/* A system of a folder with a small random term added to its Lagrangian, analysed: for bench_perturbed and test_perturbed. */
#ifndef NH_TESTS_PERTURBED_H
#define NH_TESTS_PERTURBED_H

#include <unistd.h>

#include "catalogue.h"
#include "rewrite.h"
#include "scratch.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "system/sample.h"

enum { PERTURBATIONS = 3 };
static const int perturbation[PERTURBATIONS] = {-3, -6, -9};

typedef struct {
    size_t original, survive; /* currents of the unperturbed system; those that are conserved with the term too */
    row o;                    /* of the perturbed system against the survivors */
} perturbed;

/* eps (c1 cos(k_s q^s) + c2 v^j sin(l_s q^s)), whole k and l for angles, with phases: generic in every coordinate and one velocity. */
static nh_ex generic_term(const nh_system *y, int exponent, uint64_t seed)
{
    nh_dag *d = y->dag;
    uint64_t state = seed * 77 + 5;
    nh_ex phase[2] = {nh_ratio(d, 37, 100), nh_ratio(d, 81, 100)};
    for (size_t i = 0; i < 2; i++)
        for (size_t s = 0; s < y->coordinates; s++) {
            int64_t k = 1 + (int64_t)(3 * nh_random(&state)), tenths = 5 + (int64_t)(12 * nh_random(&state));
            nh_ex c = y->coordinate[s].type == NH_ANGLE ? nh_int(d, k) : nh_ratio(d, tenths, 10);
            phase[i] = nh_add(d, phase[i], nh_mul(d, c, y->coordinate[s].q));
        }
    size_t j = (size_t)((double)y->coordinates * nh_random(&state));
    nh_ex wave = nh_mul(d, nh_ratio(d, 3, 2), nh_call(d, NH_COS, phase[0])), turn = nh_mul(d, y->coordinate[j].v, nh_call(d, NH_SIN, phase[1]));
    return nh_mul(d, nh_pow(d, nh_int(d, 10), nh_int(d, exponent)), nh_add(d, wave, turn));
}

static bool is_certified(const nh_analysis *r, const nh_current *f) { return f->proof.proved || f->proof.digits >= r->question->options.digits; }

/* Those of the independent currents that the multiplier form of the changed system conserves too; out: at most r->count. */
static size_t survivors(const nh_analysis *r, nh_ex term, nh_ex *out)
{
    nh_error error = {0};
    size_t n = 0;
    nh_points *at = nh_points_create(r->question->model, points, 1, 815, &error);
    nh_ex before = r->question->system->lagrangian;
    r->question->system->lagrangian = nh_add(r->question->model->dag, before, term);
    multiplier_motion *motion = multiplier_motion_create(r->question->model, at, bits);
    r->question->system->lagrangian = before;
    for (size_t k = 0; k < r->list->count; k++) {
        const nh_current *f = &r->list->found[k];
        if (f->independence != NH_INDEPENDENT || !is_certified(r, f)) continue;
        multiplier_rate rate = rate_of(motion, f);
        if (rate.upper < rate_bound) out[n++] = f->in_velocities;
    }
    multiplier_motion_free(motion);
    nh_points_free(at);
    return n;
}

static inline perturbed perturbed_copy(const char *folder, const char *name, size_t which, uint64_t seed, const nh_options *wanted)
{
    perturbed p = {0};
    char from[4096], path[SCRATCH];
    nh_error error = {0};
    nh_options options = *wanted;
    options.steps = 2000; /* the motions are not what is judged here */
    snprintf(from, sizeof from, "%s/%s.yaml", folder, name);
    nh_request q = {.system_path = from, .options = options};
    nh_analysis *r = nh_analysis_create(&q, &error);
    FILE *out = r ? scratch_open(path) : NULL;
    if (!out) {
        p.o.wrong = 1;
        note(&p.o, "error:", error.what);
        nh_analysis_free(r);
        return p;
    }
    nh_ex *known = nh_alloc_array(r->list->count + 1, sizeof *known), term = generic_term(r->question->system, perturbation[which], seed);
    p.original = r->list->independent;
    p.survive = survivors(r, term, known);
    rewrite_system(r->question->system, &(rewriting){.extra = term, .known = p.survive, .current = known}, out);
    fclose(out);
    p.o = compare_path(path, &options);
    remove(path);
    nh_free(known);
    nh_analysis_free(r);
    return p;
}

#endif
