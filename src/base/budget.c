#include "base/budget.h"

#include <math.h>

#include "base/context_internal.h"

static const double most_at_once = 1e15; /* the sum stops here and never reaches 2^64 */

static const double units[] = {
#define X(name, units, doc) units,
    NH_WORK_TABLE(X)
#undef X
};

void nh_budget_begin(double millions)
{
    nh_context *c = nh_context_here();
    atomic_store(&c->used, 0);
    c->most = isfinite(millions) ? 1e6 * millions : INFINITY;
}

void nh_work_add(nh_work kind, double count)
{
    double add = fmin(units[kind] * count, most_at_once);
    if (add >= 1) atomic_fetch_add_explicit(&nh_context_here()->used, (uint_fast64_t)add, memory_order_relaxed);
}

double nh_work_millions(nh_work kind, double count) { return units[kind] * count / 1e6; }

static double used(void) { return (double)atomic_load(&nh_context_here()->used); }

bool nh_budget_allows(nh_work kind, double count) { return used() + units[kind] * count <= nh_context_here()->most; }

bool nh_budget_spent(void) { return used() > nh_context_here()->most; }

double nh_budget_part(void)
{
    double most = nh_context_here()->most;
    return isfinite(most) && most > 0 ? used() / most : 0;
}

double nh_budget_used(void) { return used() / 1e6; }
