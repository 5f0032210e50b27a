/* formula: how reports write the formulas of a result. */
#ifndef NH_FORMULA_H
#define NH_FORMULA_H

#include "document/typeset.h"
#include "search/analysis.h"

/* e with the user's own abbreviations, from the analysis file (or NULL), instead of what they stand for. */
nh_ex nh_formula_shortened(const nh_analysis_file *analysis, nh_dag *dag, nh_ex e);
/* e without roots that are dependent velocities. */
nh_ex nh_formula_shown(const nh_analysis *result, nh_ex e);

/* Sums in the n formulas that are equal, or minus each other, by their normal forms get the shortest of their forms. */
void nh_formula_unify(nh_dag *dag, size_t n, nh_ex *e);

/* Long formulas with names for what occurs in them more than once: the n formulas are changed, part[i] = {name, value}
 * in an order in which each uses only names that come later.  Names are new to the graph: a letter, _ and a number.
 * There are at most NH_FORMULA_FEW, and more only as long as nh_formula_fit would leave something out without them.
 * Returns their number; 0 when all are short. */
enum { NH_FORMULA_FEW = 12, NH_FORMULA_PARTS = 100 };
typedef struct {
    char name[16];
    nh_ex symbol, value;
} nh_formula_part;
typedef struct {
    double longest, all; /* symbols that a formula or the value of a name may have; all of them together */
    double times;        /* how often the option `shown` the longest is */
} nh_formula_room;
nh_formula_room nh_formula_page(double shown); /* of a document: four times as long; three such formulas together */
size_t nh_formula_parts(nh_dag *dag, size_t n, nh_ex *e, nh_formula_room room, nh_formula_part part[NH_FORMULA_PARTS]);

/* Which of the formulas stand in a document: those for which there is room, with all the names that they need.
 * needed[k]: part k is one of these names.  Returns the least option `shown` with which all of them stand there. */
double nh_formula_fit(nh_dag *dag, size_t n, const nh_ex *e, size_t parts, const nh_formula_part *part,
                      nh_formula_room room, bool *stands, bool needed[NH_FORMULA_PARTS]);

/* Numbers the parts that are needed one after the other, without gaps, from *names + 1, with their own letter or the
 * one given; *names counts them. */
void nh_formula_number(nh_dag *dag, size_t n, nh_ex *e, size_t parts, nh_formula_part *part, const bool *needed,
                       char letter, size_t *names);

/* Formulas under each other, with names for what is repeated, and the parts of that. */
typedef struct {
    nh_ex *formula;              /* with names */
    bool *stands, *short_enough; /* is there room for it: in the document; beside others, or where nothing folds */
    nh_formula_part part[NH_FORMULA_PARTS];
    size_t parts;
    bool named;                                              /* is any part needed? */
    bool needed[NH_FORMULA_PARTS], beside[NH_FORMULA_PARTS]; /* by what stands; by what is short enough */
    double wanted;
} nh_formula_list;
/* shown: the option, which says what is short enough.  *names: as nh_formula_number has it. */
nh_formula_list nh_formula_list_make(nh_dag *dag, size_t n, const nh_ex *e, double shown, size_t *names);
void nh_formula_list_clear(nh_formula_list *list);

/* The symmetry of a current as a sum of coefficients along basis fields: d/dt, d/dq, d/dx' of the chart of coordinate
 * velocities (or of the only one); or along Gamma first and then the rest, where that is much shorter.  Terms that
 * vanish are left out.  The list belongs to the model's arena. */
typedef struct {
    nh_ex coefficient;
    const char *along; /* t, a coordinate or a velocity; NULL: Gamma */
} nh_field_term;
size_t nh_formula_field(const nh_analysis *result, const nh_symmetry *z, nh_field_term **out);

/* A formula as text; when it is longer than `shown` symbols, how long it is and which option shows it. */
char *nh_formula_text(nh_dag *dag, nh_ex e, double shown);
/* The words for one that is left out: with names for what is repeated it wants so many symbols. */
void nh_formula_left_out(double wanted, nh_text *out);

/* Of the text of an expression: has it a plus or minus outside all parentheses, after the first character? */
bool nh_formula_is_sum(const char *text);

/* Why a current is not said to be proved: what stands behind "conserved to N digits", with its blank. */
const char *nh_formula_doubt(const nh_current *found);

#endif
