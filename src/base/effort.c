#include "base/effort.h"

#include <stdint.h>

static _Thread_local uint64_t spent; /* whole units: a difference does not depend on what was computed before */

double nh_effort(void) { return (double)spent; }
void nh_effort_add(double units) { spent += (uint64_t)(units + 0.5); }
