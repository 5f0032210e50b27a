/* Keeps the solutions of a count: the same equations are asked again whenever more integrals are known. */
#include <string.h>

#include "base/progress.h"
#include "count/count_internal.h"

/* Of one parity at one order. */
typedef struct {
    uint64_t key;
    size_t *total, injective_at, rows; /* rows: differentials of the solutions */
    bool injective, extended;
    nh_residue *row;
    double work;
} answer;

struct nh_count_memory {
    nh_arena *arena;
    size_t count, capacity;
    answer *item;
};

nh_count_memory *nh_count_memory_create(void)
{
    nh_count_memory *m = nh_alloc(sizeof *m);
    *m = (nh_count_memory){.arena = nh_arena_create()};
    return m;
}

void nh_count_memory_free(nh_count_memory *m)
{
    if (!m) return;
    nh_arena_free(m->arena);
    nh_free(m->item);
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
    for (size_t i = 0; m && i < m->count; i++)
        if (m->item[i].key == key) return &m->item[i];
    return NULL;
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
    nh_count_memory *m = c->q->memory;
    if (!m || nh_late()) return;
    nh_grow(&m->item, &m->capacity, m->count + 1, sizeof *m->item);
    m->item[m->count++] = (answer){.key = mix(key_of(p, &none), p->left), .extended = extended, .work = work};
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
    a.total = nh_arena_alloc(m->arena, (g->order + 1) * sizeof *a.total);
    memcpy(a.total, g->total, (g->order + 1) * sizeof *a.total);
    a.row = nh_arena_alloc(m->arena, a.rows * width * sizeof *a.row + 1);
    memcpy(a.row, d->row + before * width, a.rows * width * sizeof *a.row);
    nh_grow(&m->item, &m->capacity, m->count + 1, sizeof *m->item);
    m->item[m->count++] = a;
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
