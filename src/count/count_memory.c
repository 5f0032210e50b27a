/* Keeps the solutions of a count: the same equations are asked again whenever more integrals are known. */
#include <stdatomic.h>
#include <string.h>

#include "base/progress.h"
#include "count/count_internal.h"

/* Of one parity at one order. */
typedef struct answer {
    struct answer *next;
    uint64_t key;
    size_t *total, injective_at, rows; /* rows: differentials of the solutions */
    bool injective, extended;
    nh_residue *row;
    double work;
} answer;

/* Threads add answers at its head, and none is removed before the end. */
struct nh_count_memory {
    answer *_Atomic first;
};

nh_count_memory *nh_count_memory_create(void) { return nh_alloc(sizeof(nh_count_memory)); }

void nh_count_memory_free(nh_count_memory *m)
{
    if (!m) return;
    for (answer *a = m->first, *next; a; a = next) {
        next = a->next;
        nh_free(a->total);
        nh_free(a->row);
        nh_free(a);
    }
    nh_free(m);
}

/* SplitMix64's finaliser, number by number. */
static uint64_t mix(uint64_t key, uint64_t value)
{
    key = (key ^ value) + 0x9e3779b97f4a7c15u;
    key = (key ^ key >> 30) * 0xbf58476d1ce4e5b9u;
    key = (key ^ key >> 27) * 0x94d049bb133111ebu;
    return key ^ key >> 31;
}

static uint64_t mix_residues(uint64_t key, size_t count, const nh_residue *x)
{
    for (size_t i = 0; i < count; i++) key = mix(key, x[i]);
    return key;
}

/* A fingerprint of everything that the number of solutions and their differentials depend on. */
static uint64_t key_of(const nh_graded_problem *p, const nh_differentials *d)
{
    const nh_jet_ring *r = p->ring;
    const uint64_t number[] = {r->field.p, p->n,         p->fields, p->degree,
                               p->parity,  r->variables, r->order,  p->most_parameters};
    uint64_t key = 1;
    for (size_t i = 0; i < sizeof number / sizeof *number; i++) key = mix(key, number[i]);
    for (size_t k = 0; k < r->variables; k++) key = mix(key, r->weight[k]);
    key = mix_residues(key, p->fields * r->variables * r->size, p->field);
    key = mix_residues(key, p->left * p->fields * r->size, p->left_rate);
    key = mix_residues(key, p->n * nh_jet_equations_monomials(p->n) * r->size, p->rate);
    return mix_residues(key, d->n, d->w);
}

static const answer *recall(const nh_count_memory *m, uint64_t key)
{
    const answer *a = m ? m->first : NULL;
    while (a && a->key != key) a = a->next;
    return a;
}

static void keep(nh_count_memory *m, answer a)
{
    answer *kept = nh_alloc(sizeof *kept);
    *kept = a;
    kept->next = m->first;
    while (!atomic_compare_exchange_weak(&m->first, &kept->next, kept)) {
    }
}

bool nh_count_recall_extended(const nh_counter *c, const nh_graded_problem *p, bool *extended, double *work)
{
    nh_differentials none = {0};
    const answer *a = recall(c->q->memory, mix(key_of(p, &none), p->left));
    if (!a || a->work >= p->most_work) return false;
    *extended = a->extended;
    *work = a->work;
    return true;
}

void nh_count_remember_extended(nh_counter *c, const nh_graded_problem *p, bool extended, double work)
{
    nh_differentials none = {0};
    if (!c->q->memory || nh_late()) return;
    keep(c->q->memory, (answer){.key = mix(key_of(p, &none), p->left), .extended = extended, .work = work});
}

static void remember(nh_count_memory *m, uint64_t key, const nh_graded_count *g, const nh_differentials *d,
                     size_t before)
{
    size_t width = d->kept + d->n;
    if (!m) return;
    answer a = {.key = key,
                .injective = g->injective,
                .injective_at = g->injective_at,
                .rows = d->rows - before,
                .work = g->work};
    a.total = nh_alloc_array(g->order + 1, sizeof *a.total);
    memcpy(a.total, g->total, (g->order + 1) * sizeof *a.total);
    a.row = nh_alloc_array(a.rows * width + 1, sizeof *a.row);
    memcpy(a.row, d->row + before * width, a.rows * width * sizeof *a.row);
    keep(m, a);
}

bool nh_count_solve(nh_counter *c, const nh_graded_problem *p, nh_graded_state **state, size_t *total,
                    size_t *injective_at, nh_differentials *d)
{
    uint64_t key = key_of(p, d);
    const answer *a = recall(c->q->memory, key);
    if (a && a->work >= p->most_work) a = NULL; /* the limit of work would not suffice for it */
    size_t before = d->rows, order = p->ring->order;
    if (a) {
        memcpy(nh_count_more_differentials(d, a->rows), a->row, a->rows * (d->kept + d->n) * sizeof *a->row);
        for (size_t k = 0; k <= order; k++) total[k] += a->total[k];
        *injective_at = a->injective ? a->injective_at : SIZE_MAX;
        c->work += a->work;
        return true;
    }
    nh_graded_count *g = nh_graded_continue(p, state);
    bool solved = g->solved;
    c->work += g->work;
    *injective_at = g->injective ? g->injective_at : SIZE_MAX;
    for (size_t k = 0; k <= order; k++) total[k] += g->total[k];
    if (solved) nh_count_solutions_differ(g, p->ring->field, d);
    if (solved) remember(c->q->memory, key, g, d, before);
    nh_graded_count_clear(g);
    return solved;
}
