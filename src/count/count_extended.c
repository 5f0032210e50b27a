/* Integrals that are linear in coordinates that were left out. */
#include "count/count_internal.h"

/* The solutions of one parity, and whether they can be extended; `certain`: no limit was reached. */
static bool search(nh_graded_problem p, nh_graded_state *state, double *work, bool *certain)
{
    nh_graded_problem without = p;
    nh_graded_count *g = NULL;
    without.left = 0;
    without.keep = true;
    if (state && nh_graded_state_order(state) == p.ring->order) {
        p.solution = nh_graded_state_solutions(state, &without, &p.given, &p.stride, work);
    } else {
        g = nh_graded_solve(&without);
        p.given = p.stride = g->total[g->order];
        p.solution = g->solved ? g->series : NULL;
        *work += g->work;
    }
    bool found = !p.solution;
    *certain = !found;
    if (p.solution && p.given) {
        p.most_work -= *work;
        nh_graded_count *more = nh_graded_solve(&p);
        found = !more->solved || more->extended;
        *certain = more->solved;
        *work += more->work;
        nh_graded_count_clear(more);
    }
    if (g) nh_graded_count_clear(g);
    return found;
}

static bool extended(nh_counter *c, const nh_graded_problem *p, nh_graded_state *state)
{
    bool found, certain;
    double work = 0;
    if (!nh_count_recall_extended(c, p, &found, &work)) {
        found = search(*p, state, &work, &certain);
        if (certain) nh_count_remember_extended(c, p, found, work);
    }
    c->work += work;
    return found;
}

bool nh_count_extended(nh_counter *c, const nh_count_series *s, size_t degree, nh_graded_state *state[2], bool *found)
{
    nh_jet_equations *x = c->equations;
    nh_residue *rate = nh_alloc_array(x->left * x->fields * s->ring->size + 1, sizeof *rate);
    bool good = nh_jet_equations_left(x, s->ring, s->coordinate, rate);
    *found = false;
    for (int part = 0; part < (s->split ? 2 : 1) && good && !*found; part++) {
        nh_graded_problem p = nh_count_problem(c, s, degree,
                                               !s->split ? NH_ALL_DEGREES
                                               : part    ? NH_ODD_DEGREES
                                                         : NH_EVEN_DEGREES);
        p.left = x->left;
        p.left_rate = rate;
        *found = extended(c, &p, state[part]);
    }
    nh_free(rate);
    return good;
}
