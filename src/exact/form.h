/* form: expressions as quotients of polynomials in kernels.
 *
 * First the arguments of functions and roots are made canonical, by the same method, so that equal arguments are the
 * same node; then the kernels are collected, related to each other, and the expression is evaluated in their field. */
#ifndef NH_FORM_H
#define NH_FORM_H

#include "exact/kernel.h"
#include "exact/normal_quotient.h"

/* The state that all normal forms of one computation share. */
typedef struct {
    nh_dag *dag;          /* borrowed */
    bool literal, coarse; /* see kernel.h; coarse: arguments are not */
    size_t max_terms;
    int depth;
    nh_index rewritten, canonical;
} nh_forms;

typedef struct {
    nh_kernels kernels;
    nh_quotient_field *field;
    const nh_quotient *value;
    nh_index known; /* node -> index into `of` */
    const nh_quotient **of;
    size_t count, capacity;
} nh_form;

void nh_forms_init(nh_forms *forms, nh_dag *dag, bool literal, size_t max_terms);
void nh_forms_clear(nh_forms *forms);

/* The form of e; with `opaque` inexact numbers are kernels of their own.  The state says whether there is a value;
 * clear the form in any case. */
nh_quotient_field_state nh_form_make(nh_forms *forms, nh_ex e, bool opaque, nh_form *form);
void nh_form_clear(nh_form *form);

/* e with canonical arguments, radicands and exponents: the first step, for those who put many expressions into one
   field. */
nh_ex nh_form_rewrite(nh_forms *forms, nh_ex e);

/* Declares the relations of |u| and sign(u), whose kernels are collected: sign(u)^2 = 1 except where u = 0; |u| =
 * sign(u) u where both are in one field, otherwise |u|^2 = u^2. */
void nh_form_relate_signs(nh_form *form);
void nh_form_relate_abs(nh_form *form, size_t kernel);

/* The value of e, whose kernels have been collected and related (form_eval.c). */
const nh_quotient *nh_form_eval(nh_form *form, nh_ex e);

#endif
