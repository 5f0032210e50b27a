/* facts: sentences that the text, page and LaTeX document share, in the markup of each. */
#ifndef NH_FACTS_H
#define NH_FACTS_H

#include "base/json.h"
#include "base/text.h"
#include "search/analysis.h"

/* A number in a report: all its digits; then the shown ones, as [minus] mantissa [times 10^power], without the mantissa
 * where that is 1.  False: not finite. */
typedef struct {
    char all[40], mantissa[60];
    bool minus, has_power;
    int power;
} nh_shown_number;
bool nh_facts_number(double value, int digits, nh_shown_number *out);

/* Splits words that end in a list of names in parentheses, such as "coordinate velocities (x', y')": the words before
 * the parenthesis, and the list; NULL without such a list. */
const char *nh_facts_list(const char *text, char *words, size_t size);
/* The next name of a list; false after the last. */
bool nh_facts_next(const char **list, char *name, size_t size);

/* "homogeneous nonlinear constraint, time-dependent (nonholonomic; growth vector 2,3)" */
void nh_facts_constraint(const nh_analysis *result, nh_text *out);

/* What kind of symmetry Z is: its case, whether [Gamma,Z] lies in the canonical distribution, whether Z is projectable.
 * `between`: the text between the case and the rest.  PAGE: with formulas in the language of notation.h between dollar
 * signs. */
typedef enum { NH_FACTS_TEXT, NH_FACTS_PAGE, NH_FACTS_TEX } nh_facts_form;
void nh_facts_symmetry(const nh_symmetry *symmetry, nh_facts_form form, const char *between, nh_text *out);

/* The heading of w' = a(t, q, w), the equations of motion on the constraint submanifold. */
const char *nh_facts_equations(const nh_model *model);

/* Sentences that say whether the currents found are all that are polynomial in the velocities; "" when this was not
 * counted. */
void nh_facts_completeness(const nh_analysis *result, nh_text *out);

/* How the drift of a current changes when the tolerance of the integration is reduced. */
const char *nh_facts_drift(const nh_drift *drift);

/* For a constraint with two branches (otherwise ""): which branch was computed, and whether the equations hold on the
 * other one; and, for a current, on which branch it holds. */
void nh_facts_branch(const nh_analysis *result, nh_text *out);
/* ", on both branches", or nothing. */
const char *nh_facts_which_branch(const nh_analysis *result, const nh_current *found);

/* "4 independent currents on each side of x = 0, where the motion has an impulse": only where there is no other
 * current. */
const char *nh_facts_between_walls(const nh_analysis *result);
/* The ansatz is that of the analysis file: nothing else was tried. */
bool nh_facts_given(const nh_analysis *result);
/* How the search ended, in whole sentences. */
const char *nh_facts_search(const nh_analysis *result);

/* For which parameters a statement holds: " for all m, a, k" (with `names`; else " for all parameter values"), " for k
 * = 1", " for these parameter values only"; "" without parameters.  In JSON, under the key "holds": "all parameters",
 * an object of those that must have their values, "these values". */
const char *nh_facts_holds(const nh_model *model, const nh_proof *proof, bool names);
void nh_facts_put_holds(nh_json *item, const nh_model *model, const nh_proof *proof);
void nh_facts_add_holds(nh_json *list, const nh_model *model, const nh_proof *proof);

/* "Fitted to 2e-16; along the motion it changes by 4e-10": of a system with tables, relative to its terms. */
void nh_facts_fit(const nh_current *current, nh_text *out);
/* How sure it is: of a proved one " for all m, k" or "", after "proved"; of another one a sentence without its end. */
const char *nh_facts_proof(const nh_analysis *result, const nh_current *found);

/* Is the head of a column, which begins with # where the column holds numbers, a number itself: "#1e-8"? */
bool nh_facts_head(const char *head, double *value);

#endif
