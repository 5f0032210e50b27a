#include "graph/dag.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/budget.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "graph/dag_internal.h"
#include "graph/node.h"
#include "graph/num.h"

nh_dag *nh_dag_create(void)
{
    nh_dag *dag = nh_alloc(sizeof *dag);
    dag->worker = nh_parallel_worker();
    dag->bucket_count = 1 << 10;
    dag->bucket = nh_alloc_array(dag->bucket_count, sizeof *dag->bucket);
    dag->names = nh_arena_create();
    nh_int(dag, 0); /* index 0 is the number 0, index 1 the number 1 */
    nh_int(dag, 1);
    return dag;
}

static void *copied(const void *from, size_t count, size_t size)
{
    void *out = nh_alloc_array(count + 1, size);
    if (count) memcpy(out, from, count * size);
    return out;
}

nh_dag *nh_dag_copy(const nh_dag *dag)
{
    nh_dag *c = nh_alloc(sizeof *c);
    *c = *dag;
    c->copied = dag->node_count;
    c->worker = nh_parallel_worker();
    c->all.node = copied(dag->all.node, c->node_capacity = dag->node_count, sizeof *c->all.node);
    c->all.arg = copied(dag->all.arg, c->arg_capacity = dag->arg_count, sizeof *c->all.arg);
    c->bucket = copied(dag->bucket, dag->bucket_count, sizeof *c->bucket);
    c->name = copied(dag->name, c->name_capacity = dag->name_count, sizeof *c->name);
    c->memo = copied(dag->memo, dag->memo_capacity, sizeof *c->memo);
    for (int k = 0; k < NH_FORMS; k++) c->form[k] = copied(dag->form[k], dag->form_capacity[k], sizeof **c->form);
    c->rule = copied(dag->rule, c->rule_capacity = dag->rule_count, sizeof *c->rule);
    c->power = copied(dag->power, c->power_capacity = dag->power_count, sizeof *c->power);
    c->declared = copied(dag->declared, c->declared_capacity = dag->declared_count, sizeof *c->declared);
    c->names = nh_arena_create();
    return c;
}

void nh_dag_free(nh_dag *dag)
{
    if (!dag) return;
    nh_free(dag->all.node);
    nh_free(dag->all.arg);
    nh_free(dag->bucket);
    nh_free(dag->name);
    nh_free(dag->memo);
    for (int k = 0; k < NH_FORMS; k++) nh_free(dag->form[k]);
    nh_free(dag->rule);
    nh_free(dag->power);
    nh_free(dag->declared);
    nh_arena_free(dag->names);
    nh_free(dag);
}

size_t nh_dag_size(const nh_dag *dag) { return dag->node_count; }

/* ---- hash consing ---- */

static uint64_t mix(uint64_t h, uint64_t x)
{
    h ^= x + 0x9e3779b97f4a7c15u + (h << 6) + (h >> 2);
    h *= 0xff51afd7ed558ccdu;
    return h ^ (h >> 32);
}

static uint64_t hash_of(unsigned kind, unsigned op, size_t count, const uint32_t *arg)
{
    uint64_t h = mix(kind * 0x100u + op, count);
    for (size_t i = 0; i < count; i++) h = mix(h, arg[i]);
    return h;
}

static void rehash(nh_dag *dag)
{
    dag->bucket = nh_realloc_array(dag->bucket, 2 * dag->bucket_count, sizeof *dag->bucket);
    dag->bucket_count *= 2;
    memset(dag->bucket, 0, dag->bucket_count * sizeof *dag->bucket);
    for (uint32_t i = 0; i < dag->node_count; i++) {
        uint32_t *head = &dag->bucket[dag->all.node[i].hash & (dag->bucket_count - 1)];
        dag->all.node[i].next = *head;
        *head = i + 1;
    }
}

/* Which symbols occur, as 64 bits of a hash: a clear bit proves absence.  The arguments of a number are the words of
 * its value, that of a symbol is its place among the names: only those of other kinds are nodes. */
static uint64_t mask_of(const nh_dag *dag, unsigned kind, size_t count, const uint32_t *arg)
{
    if (kind == NH_NUMBER) return 0;
    if (kind == NH_SYMBOL) return (uint64_t)1 << (arg[0] % 64);
    uint64_t mask = 0;
    for (size_t i = 0; i < count; i++) mask |= dag->all.node[arg[i]].mask;
    return mask;
}

/* In the chain of its bucket; false: there is no such node. */
static bool find_node(const nh_dag *dag, uint64_t hash, unsigned kind, unsigned op, size_t count, const uint32_t *arg,
                      nh_ex *out)
{
    for (uint32_t i = dag->bucket[hash & (dag->bucket_count - 1)]; i; i = dag->all.node[i - 1].next) {
        const nh_node *n = &dag->all.node[i - 1];
        if (n->hash == hash && n->kind == kind && n->op == op && n->count == count &&
            (count == 0 || !memcmp(dag->all.arg + n->first, arg, count * sizeof *arg)))
            return *out = i - 1, true;
    }
    return false;
}

static nh_ex append_node(nh_dag *dag, uint64_t hash, unsigned kind, unsigned op, size_t count, const uint32_t *arg)
{
    /* a full graph ends the program as lack of memory does */
    if (dag->node_count >= UINT32_MAX - 1 || dag->arg_count + count > UINT32_MAX) nh_alloc(SIZE_MAX);
    if (dag->node_count >= dag->bucket_count) rehash(dag);
    nh_grow(&dag->all.node, &dag->node_capacity, dag->node_count + 1, sizeof *dag->all.node);
    nh_grow(&dag->all.arg, &dag->arg_capacity, dag->arg_count + count, sizeof *dag->all.arg);
    uint32_t self = (uint32_t)dag->node_count++;
    nh_node *n = &dag->all.node[self];
    *n = (nh_node){.kind = (uint8_t)kind,
                   .op = (uint8_t)op,
                   .count = (uint32_t)count,
                   .first = (uint32_t)dag->arg_count,
                   .hash = hash};
    if (count) memcpy(dag->all.arg + dag->arg_count, arg, count * sizeof *arg);
    dag->arg_count += count;
    n->mask = mask_of(dag, kind, count, arg);
    uint32_t *head = &dag->bucket[hash & (dag->bucket_count - 1)];
    n->next = *head;
    *head = self + 1;
    return self;
}

nh_ex nh_dag_intern(nh_dag *dag, unsigned kind, unsigned op, size_t count, const uint32_t *arg)
{
    /* a mistake of the program, whatever the number of threads */
    if (NH_CHECKED && dag->worker != nh_parallel_worker()) abort();
    nh_work_add(NH_WORK_NODE, 1);
    nh_ex same;
    uint64_t hash = hash_of(kind, op, count, arg);
    return find_node(dag, hash, kind, op, count, arg, &same) ? same : append_node(dag, hash, kind, op, count, arg);
}

/* ---- forms ---- */

bool nh_dag_form(const nh_dag *dag, nh_ex e, nh_dag_kept kept, nh_ex *out)
{
    if (e >= dag->form_capacity[kept] || !dag->form[kept][e]) return false;
    *out = dag->form[kept][e] - 1;
    return true;
}

void nh_dag_set_form(nh_dag *dag, nh_ex e, nh_dag_kept kept, nh_ex form)
{
    size_t old = dag->form_capacity[kept];
    if (e >= old) {
        nh_grow(&dag->form[kept], &dag->form_capacity[kept], dag->node_count, sizeof **dag->form);
        memset(dag->form[kept] + old, 0, (dag->form_capacity[kept] - old) * sizeof **dag->form);
    }
    dag->form[kept][e] = form + 1;
}

/* ---- leaves ---- */

nh_ex nh_number(nh_dag *dag, nh_num value)
{
    uint32_t word[6];
    memset(word, 0, sizeof word);
    if (value.q > 0) value.d = 0;
    else if (isnan(value.d)) value.d = NAN; /* one nan, whatever its sign */
    memcpy(word, &value.p, 8);
    memcpy(word + 2, &value.q, 8);
    memcpy(word + 4, &value.d, 8);
    return nh_dag_intern(dag, NH_NUMBER, 0, 6, word);
}

nh_ex nh_int(nh_dag *dag, int64_t value) { return nh_number(dag, nh_num_int(value)); }
nh_ex nh_ratio(nh_dag *dag, int64_t p, int64_t q) { return nh_number(dag, nh_num_ratio(p, q)); }
nh_ex nh_real(nh_dag *dag, double value) { return nh_number(dag, nh_num_real(value)); }

bool nh_symbol_find(const nh_dag *dag, const char *name, nh_ex *out)
{
    for (size_t i = 0; i < dag->name_count; i++) {
        if (dag->name[i].hidden || strcmp(dag->name[i].text, name)) continue;
        *out = dag->name[i].symbol;
        return true;
    }
    return false;
}

static nh_ex new_symbol(nh_dag *dag, const char *name, bool hidden)
{
    uint32_t index = (uint32_t)dag->name_count;
    const char *kept = nh_arena_strdup(dag->names, name);
    nh_grow(&dag->name, &dag->name_capacity, dag->name_count + 1, sizeof *dag->name);
    nh_ex symbol = nh_dag_intern(dag, NH_SYMBOL, 0, 1, &index);
    dag->name[dag->name_count++] = (nh_symbol_name){kept, symbol, hidden};
    return symbol;
}

nh_ex nh_symbol(nh_dag *dag, const char *name)
{
    nh_ex found;
    return nh_symbol_find(dag, name, &found) ? found : new_symbol(dag, name, false);
}

nh_ex nh_symbol_fresh(nh_dag *dag, const char *name) { return new_symbol(dag, name, true); }

const char *nh_name_of(const nh_dag *dag, nh_ex e) { return dag->name[dag->all.arg[dag->all.node[e].first]].text; }

/* ---- looking ---- */

bool nh_is_number(const nh_dag *dag, nh_ex e, int64_t value)
{
    return dag->all.node[e].kind == NH_NUMBER && nh_num_is(nh_number_of(dag, e), value);
}

/* The indices of all nodes below `e`, each once, children first. */
typedef struct {
    size_t count, capacity, slots;
    uint32_t *node, *slot; /* found so far, in order of discovery; hash table of index + 1 */
} found_nodes;

static bool discover(found_nodes *f, uint32_t e)
{
    if (2 * f->count >= f->slots) {
        size_t slots = f->slots ? 4 * f->slots : 64;
        uint32_t *slot = nh_alloc_array(slots, sizeof *slot);
        for (size_t i = 0; i < f->count; i++) {
            size_t at = f->node[i] * 2654435761u & (slots - 1);
            while (slot[at]) at = (at + 1) & (slots - 1);
            slot[at] = f->node[i] + 1;
        }
        nh_free(f->slot);
        f->slot = slot;
        f->slots = slots;
    }
    size_t at = e * 2654435761u & (f->slots - 1);
    for (; f->slot[at]; at = (at + 1) & (f->slots - 1))
        if (f->slot[at] == e + 1) return false;
    f->slot[at] = e + 1;
    nh_grow(&f->node, &f->capacity, f->count + 1, sizeof *f->node);
    f->node[f->count++] = e;
    return true;
}

static int ascending(const void *a, const void *b)
{
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* The cost depends on what is below e and not on the size of the graph: a search through all nodes would be quadratic
 * in large systems. */
size_t nh_nodes_in(const nh_dag *dag, size_t n, const nh_ex *e, nh_ex **out)
{
    found_nodes f = {0};
    for (size_t k = 0; k < n; k++) discover(&f, e[k]);
    for (size_t i = 0; i < f.count; i++) {
        const nh_node *at = &dag->all.node[f.node[i]];
        for (uint32_t j = 0; at->kind > NH_SYMBOL && j < at->count; j++) discover(&f, dag->all.arg[at->first + j]);
    }
    /* children have smaller indices than their parents */
    if (f.count) qsort(f.node, f.count, sizeof *f.node, ascending);
    nh_free(f.slot);
    *out = f.node;
    return f.count;
}

/* The mask alone decides as long as there are at most as many symbols as bits. */
bool nh_depends(const nh_dag *dag, nh_ex e, nh_ex symbol)
{
    if (e == symbol) return true;
    if (e < symbol || !(dag->all.node[e].mask & dag->all.node[symbol].mask)) return false;
    if (dag->all.node[e].kind <= NH_SYMBOL) return false;
    if (dag->name_count <= 64) return true;
    uint32_t *node;
    size_t count = nh_nodes_in(dag, 1, &e, &node);
    bool found = false;
    for (size_t i = 0; i < count && !found; i++) found = node[i] == symbol;
    nh_free(node);
    return found;
}

void nh_nodes_free(nh_ex **list)
{
    nh_free(*list);
    *list = NULL;
}

static size_t of_kind(const nh_dag *dag, nh_ex e, nh_kind kind, nh_ex **list)
{
    nh_nodes_free(list);
    size_t count = nh_nodes_in(dag, 1, &e, list), found = 0;
    for (size_t i = 0; i < count; i++)
        if (dag->all.node[(*list)[i]].kind == kind) (*list)[found++] = (*list)[i];
    return found;
}

size_t nh_symbols_in(const nh_dag *dag, nh_ex e, nh_ex **list) { return of_kind(dag, e, NH_SYMBOL, list); }
size_t nh_functions_in(const nh_dag *dag, nh_ex e, nh_ex **list) { return of_kind(dag, e, NH_FUNCTION, list); }
size_t nh_products_in(const nh_dag *dag, nh_ex e, nh_ex **list) { return of_kind(dag, e, NH_PRODUCT, list); }

size_t nh_radicands_in(const nh_dag *dag, nh_ex e, nh_ex **list)
{
    NH_LIST(product);
    size_t count = nh_products_in(dag, e, &product), found = 0, capacity = 0;
    nh_nodes_free(list);
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < nh_arity(dag, product[i]); k++) {
            nh_ex base = nh_child(dag, product[i], k), power = nh_exponent_of(dag, product[i], k);
            bool half = nh_kind_of(dag, power) == NH_NUMBER && nh_num_short(nh_number_of(dag, power)) &&
                        nh_number_of(dag, power).q == 2;
            for (size_t j = 0; j < found && half; j++) half = (*list)[j] != base;
            if (!half) continue;
            nh_grow(list, &capacity, found + 1, sizeof **list);
            (*list)[found++] = base;
        }
    return found;
}

size_t nh_node_count(const nh_dag *dag, nh_ex e)
{
    uint32_t *node;
    size_t count = nh_nodes_in(dag, 1, &e, &node);
    nh_free(node);
    return count;
}
