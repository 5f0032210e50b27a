#include "base/budget.h"

#include <math.h>
#include <stdatomic.h>
#include <stdint.h>

static const double most = 1e15; /* of one addition: 2^64 is never reached */

static atomic_uint_fast64_t used;  /* whole units: their sum does not depend on the order in which threads add them */
static double limit = INFINITY;    /* units; set between computations, read by all of their threads */

static const double units[] = {
#define X(name, units, doc) units,
    NH_WORK_TABLE(X)
#undef X
};

void nh_budget_begin(double millions)
{
    atomic_store(&used, 0);
    limit = isfinite(millions) ? 1e6 * millions : INFINITY;
}

void nh_work_add(nh_work kind, double count)
{
    double add = fmin(units[kind] * count, most);
    if (add >= 1) atomic_fetch_add_explicit(&used, (uint_fast64_t)add, memory_order_relaxed);
}

double nh_work_millions(nh_work kind, double count) { return units[kind] * count / 1e6; }

bool nh_budget_allows(nh_work kind, double count) { return (double)atomic_load(&used) + units[kind] * count <= limit; }

bool nh_budget_spent(void) { return (double)atomic_load(&used) > limit; }

double nh_budget_part(void) { return isfinite(limit) && limit > 0 ? (double)atomic_load(&used) / limit : 0; }

double nh_budget_used(void) { return (double)atomic_load(&used) / 1e6; }
