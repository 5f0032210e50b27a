/* term_list: the terms of a sum or the factors of a product while they are being sorted, shared by algebra.c and
 * product.c. */
#ifndef NH_TERM_LIST_H
#define NH_TERM_LIST_H

#include "graph/expr.h"

typedef struct {
    nh_ex e;  /* term of a sum, base of a product */
    nh_num c; /* coefficient (sums) */
    nh_ex x;  /* exponent (products) */
} nh_term_list_item;

/* The caller frees list. */
typedef struct {
    nh_num c; /* constant of a sum, coefficient of a product */
    nh_term_list_item *list;
    size_t count, capacity;
} nh_term_list;

/* Appends an item. */
void nh_term_list_push(nh_term_list *list, nh_term_list_item item);
/* A comparison for qsort that puts equal expressions side by side. */
int nh_term_list_order(const void *a, const void *b);
/* The node of kind NH_SUM or NH_PRODUCT; the items are sorted, and each expression occurs once. */
nh_ex nh_term_list_intern(nh_dag *dag, nh_kind kind, const nh_term_list *list);

/* The product without its coefficient. */
nh_ex nh_product_without_number(nh_dag *dag, nh_ex product);

#endif
