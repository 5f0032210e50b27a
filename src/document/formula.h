/* formula: how documents write the formulas of a result. */
#ifndef NH_FORMULA_H
#define NH_FORMULA_H

#include "document/typeset.h"
#include "search/analysis.h"

/* e as it is shown: with the abbreviations of the analysis file (or NULL) in place of the expressions that they stand
 * for, in the form that reads best (exact/gather.h). */
nh_ex nh_formula_shortened(const nh_analysis_file *analysis, nh_dag *dag, nh_ex e);
/* e with roots replaced by the dependent velocities to which they are equal. */
nh_ex nh_formula_shown(const nh_analysis *result, nh_ex e);

/* Among sums in the n formulas that are equal up to sign by their normal forms, all get the shortest form. */
void nh_formula_unify(nh_dag *dag, size_t n, nh_ex *e);

/* Introduces names for repeated parts of long formulas: the n formulas are changed, part[i] = {name, value} in an order
 * in which each value uses only later names.  Names are new to the graph: a letter, _ and a number.  There are at most
 * NH_FORMULA_FEW, and more only as long as nh_formula_fit would leave something out without them.  Returns their
 * number; 0 when all formulas are short. */
enum { NH_FORMULA_FEW = 12, NH_FORMULA_PARTS = 100 };
typedef struct {
    char name[16];
    nh_ex symbol, value;
} nh_formula_part;
typedef struct {
    double longest, all; /* symbols that a formula or the value of a name may have; all of them together */
    double times;        /* the longest formula over the option `shown` */
} nh_formula_room;
nh_formula_room nh_formula_page(double shown); /* in a document: four times as long; three such formulas together */
size_t nh_formula_parts(nh_dag *dag, size_t n, nh_ex *e, nh_formula_room room, nh_formula_part part[NH_FORMULA_PARTS]);

/* Chooses the formulas that a document shows: those for which there is room, with all the names that they need.
 * needed[k]: part k is one of these names.  Returns the least option `shown` with which all are shown. */
double nh_formula_fit(nh_dag *dag, size_t n, const nh_ex *e, size_t parts, const nh_formula_part *part,
                      nh_formula_room room, bool *stands, bool needed[NH_FORMULA_PARTS]);

/* Numbers the needed parts one after the other, from *names + 1, with their own letter or the given one; adds their
 * number to *names. */
void nh_formula_number(nh_dag *dag, size_t n, nh_ex *e, size_t parts, nh_formula_part *part, const bool *needed,
                       char letter, size_t *names);

/* Formulas below each other, with names for repeated parts, and the values of these names. */
typedef struct {
    nh_ex *formula;              /* the formulas with names */
    bool *stands, *short_enough; /* is there room for it: in the document; beside others, or where nothing folds */
    nh_formula_part part[NH_FORMULA_PARTS];
    size_t parts;
    bool named; /* is any part needed? */
    /* needed by a formula that is shown; by one that is short enough */
    bool needed[NH_FORMULA_PARTS], beside[NH_FORMULA_PARTS];
    double wanted;
} nh_formula_list;
/* shown: the option that says what is short enough. *names: as in nh_formula_number. */
nh_formula_list nh_formula_list_make(nh_dag *dag, size_t n, const nh_ex *e, double shown, size_t *names);
void nh_formula_list_clear(nh_formula_list *list);

/* The symmetry of a current as a sum of coefficients along basis fields: d/dt, d/dq, d/dx' of the chart of coordinate
 * velocities (or of the only one); or, where that is much shorter, a multiple of Gamma plus the remaining components.
 * Terms that vanish are left out.  The list belongs to the model's arena. */
typedef struct {
    nh_ex coefficient;
    const char *along; /* t, a coordinate or a velocity; NULL: Gamma */
} nh_field_term;
size_t nh_formula_field(const nh_analysis *result, const nh_symmetry *z, nh_field_term **out);

/* A formula as text; when it is longer than `shown` symbols, its length and the option that shows it. */
char *nh_formula_text(nh_dag *dag, nh_ex e, double shown);
/* The words for a formula that is left out: so many symbols, with names for repeated parts. */
void nh_formula_left_out(double wanted, nh_text *out);

/* For the text of an expression: has it a plus or minus outside all parentheses, after the first character? */
bool nh_formula_is_sum(const char *text);

/* Why a current is not called proved: the words behind "conserved to N digits", with a leading blank. */
const char *nh_formula_doubt(const nh_current *found);

#endif
