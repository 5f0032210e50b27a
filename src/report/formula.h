/* formula: how reports write the formulas of a result. */
#ifndef NH_FORMULA_H
#define NH_FORMULA_H

#include "study/result.h"

/* e with the user's own abbreviations, from the analysis file, instead of what they stand for. */
nh_ex nh_formula_abbreviate(const nh_result *result, nh_ex e);

#endif
