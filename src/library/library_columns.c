#include "library/library_columns.h"

#include "base/memory.h"

void nh_columns_open(nh_columns *c, size_t m, size_t count, const double *t, const double *q, const double *v)
{
    *c = (nh_columns){.inputs = 1 + 2 * m, .count = count, .t = t, .q = q, .v = v};
    c->in = nh_alloc_array(c->inputs, sizeof *c->in);
}

size_t nh_columns_next(nh_columns *c, size_t from)
{
    size_t m = (c->inputs - 1) / 2, left = c->count - from;
    c->in[0] = c->t ? c->t + from : c->zero;
    for (size_t i = 0; i < m; i++) {
        c->in[1 + i] = c->q + i * c->count + from;
        c->in[1 + m + i] = c->v + i * c->count + from;
    }
    return left < NH_BATCH ? left : NH_BATCH;
}

void nh_columns_close(nh_columns *c) { nh_free(c->in); }
