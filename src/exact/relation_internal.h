/* relation_internal: expressions in one field, and the kernels that are coefficients; for relation.c and
 * relation_unknown.c. */
#ifndef NH_RELATION_INTERNAL_H
#define NH_RELATION_INTERNAL_H

#include "exact/form.h"
#include "exact/relation_solve.h"

typedef struct {
    nh_dag *dag;
    size_t n, parameters;
    const nh_ex *parameter;
    nh_forms forms;
    nh_form form;
    nh_ex *e;       /* with canonical arguments */
    bool *constant; /* kernel -> does it depend on parameters only? */
    const nh_quotient **value, **c;
    /* sin u = (z - 1/z)/(2 i), cos u = (z + 1/z)/2 with z = exp(i u) for a variable u: sin(u - v) has factors then, and
     * common denominators are short */
    bool exponentials;
} nh_relation_question;

void nh_relation_question_init(nh_relation_question *question, nh_dag *dag, size_t n, size_t parameters,
                               const nh_ex *parameter, size_t max_terms);
void nh_relation_question_clear(nh_relation_question *question);

/* The expressions as values without denominators; false where that is too large, or an inexact constant occurs. */
bool nh_relation_question_read(nh_relation_question *question, const nh_ex *e);
nh_relation_system nh_relation_question_system(const nh_relation_question *question);

/* A constant as an expression; false when it does not fit into 64 bits. */
bool nh_relation_question_emit(nh_relation_question *question, const nh_quotient *value, nh_ex *out);

#endif
