/* Solutions that are linear in coordinates a_j on which nothing depends: the coefficients of a_j are combinations of
 * solutions without a, and Gamma(Phi) + sum_j a_j' (these combinations) = 0. */
#include "count/graded_solver_internal.h"

void nh_graded_extensions_start(nh_graded_system *s)
{
    const nh_graded_problem *p = s->p;
    s->extensions = p->left * p->given;
    s->moves = nh_arena_alloc(s->arena, p->left * p->fields + 1);
    for (size_t i = 0; i < p->left * p->fields; i++) s->moves[i] = !nh_jet_is_zero(s->r, p->left_rate + i * s->r->size);
    for (size_t i = 0; i < s->extensions && !s->over; i++) nh_graded_parameter(s, s->alphas, i);
}

/* Adds the products of one series of a_j' and the solutions' coefficients of alpha, at one exponent. */
static void add_products(const nh_graded_system *s, const nh_residue *rate, size_t alpha, size_t exponent,
                         nh_residue *sum)
{
    const nh_jet_ring *r = s->r;
    for (size_t z = r->pairs[exponent]; z < r->pairs[exponent + 1]; z++)
        if (rate[r->left[z]])
            nh_residue_add_multiple(s->f, s->p->given, sum,
                                    s->p->solution + (alpha * r->size + r->right[z]) * s->p->stride, rate[r->left[z]]);
}

void nh_graded_extend(const nh_graded_system *s, size_t beta, size_t exponent, nh_graded_sum *sum)
{
    const nh_graded_problem *p = s->p;
    int *e = nh_alloc_array(p->n + 1, sizeof *e);
    nh_residue *product = nh_alloc_array(p->given + 1, sizeof *product);
    for (size_t j = 0; j < p->left; j++) {
        for (size_t k = 0; k < p->given; k++) product[k] = 0;
        for (size_t i = 0; i < p->fields; i++) {
            if (!s->moves[j * p->fields + i]) continue;
            for (size_t l = 0; l < p->n; l++) e[l] = s->beta[beta * p->n + l] - (l == i);
            int alpha = nh_graded_find_alpha(s, e);
            if (alpha < 0) continue;
            add_products(s, p->left_rate + (j * p->fields + i) * s->r->size, (size_t)alpha, exponent, product);
            sum->work += (double)((s->r->pairs[exponent + 1] - s->r->pairs[exponent]) * p->given);
        }
        for (size_t k = 0; k < p->given; k++)
            if (product[k]) nh_graded_sum_add(sum, product[k], nh_graded_extension(s, j * p->given + k));
    }
    sum->work += (double)(s->extensions * s->N);
    nh_free(product);
    nh_free(e);
}

bool nh_graded_is_extended(const nh_graded_system *s)
{
    for (size_t i = 0; i < s->extensions; i++)
        for (size_t j = 0; j < s->N; j++)
            if (nh_graded_extension(s, i)[j]) return true;
    return false;
}
