/* fixed: exact relations that hold for all values of the parameters, or for as many as possible.
 *
 *     sum_j c_j e_j = 0,    c_j in Q(parameters)
 *
 * First every parameter is a symbol.  Where there is no such relation some of them must have their values: beginning
 * with all of them fixed, one after the other is set free as long as the relation remains.  Those that the user set,
 * and short values (1 before 0.6173), are set free last, because it is at these that something special happens.  Where
 * several are left, they may have to be related only, not to have these values.
 *
 * `fixed` is a list of what each parameter is replaced by: a free one by itself, one that must have its value by that
 * number, one that is related to others by an expression of these, which are free. */
#ifndef NH_FIXED_H
#define NH_FIXED_H

#include "base/option.h"
#include "geometry/model.h"

typedef struct {
    bool found;
    bool all_parameters; /* none is fixed */
    const nh_ex *fixed;  /* in the model's arena; NULL with all_parameters */
    bool too_large;      /* whether it holds for other values than the given ones could not be decided */
} nh_fixed;

/* The coefficients of the only relation among e (n entries).  `like`: at the parameters' values it must be this vector
 * up to a factor (NULL: any).  `found` is false where there is none. */
nh_fixed nh_fixed_relation(const nh_model *model, size_t n, const nh_ex *e, const double *like,
                           const nh_options *options, nh_ex *coefficient);

/* The same without relations among parameters: those that are not free have their values. */
nh_fixed nh_fixed_relation_by_values(const nh_model *model, size_t n, const nh_ex *e, const double *like,
                                     const nh_options *options, nh_ex *coefficient);

/* The same, with every parameter a symbol: false where there is none such. */
bool nh_fixed_relation_of_symbols(const nh_model *model, size_t n, const nh_ex *e, const double *like,
                                  const nh_options *options, nh_ex *coefficient);

/* Are the exact coefficients these numbers at the parameters' values, up to a factor?  (A relation may exist that is
   not the one that was fitted.) */
bool nh_fixed_is_like(const nh_model *model, size_t n, const nh_ex *exact, const double *like);

/* Which parameters must keep their values so that a statement holds that is true with all of them fixed?  `occurring`:
 * expressions that contain the relevant parameters. */
typedef bool nh_fixed_test(const nh_ex *fixed, void *context);
const nh_ex *nh_fixed_least(const nh_model *model, size_t n, const nh_ex *occurring, nh_fixed_test *holds,
                            void *context);

/* The parameters that two statements together fix: NULL as well as an empty list means none. */
const nh_ex *nh_fixed_both(const nh_model *model, const nh_ex *a, const nh_ex *b);

/* e with the fixed parameters at their exact values; all of them with `fixed` NULL. */
nh_ex nh_fixed_values(const nh_model *model, const nh_ex *fixed, nh_ex e);

/* Is the parameter replaced?  (With NULL none is.) */
bool nh_fixed_has(const nh_model *model, const nh_ex *fixed, size_t parameter);

/* A list in which these parameters (a flag for each) have their values; in the model's arena. */
const nh_ex *nh_fixed_those(const nh_model *model, const bool *which);

/* A list in which all parameters have their values. */
const nh_ex *nh_fixed_every(const nh_model *model);

/* Have all parameters their values?  (True for NULL.) */
bool nh_fixed_all(const nh_model *model, const nh_ex *fixed);

/* "k = 1, a = 2*b": the replaced parameters, in the model's arena. */
const char *nh_fixed_text(const nh_model *model, const nh_ex *fixed);

#endif
