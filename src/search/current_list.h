/* current_list: the integrals that an analysis has found.
 *
 * The list is constant for the compiler everywhere else: only this file changes which integrals there are, their order
 * and their number.  The checker (currents.h) alone appends; whatever it appends was checked.  Later steps describe an
 * integral that is in the list: its name, relation, symmetry, drift. */
#ifndef NH_CURRENT_LIST_H
#define NH_CURRENT_LIST_H

#include "search/analysis.h"

/* An empty list, in the arena. */
void nh_current_list_begin(nh_analysis *result);
/* An entry (of found, piece or further), to describe it; its formula stays. */
nh_current *nh_current_list_describe(nh_analysis *result, const nh_current *entry);
/* Appends a copy; it counts as independent where its own member says so. */
void nh_current_list_append(nh_analysis *result, const nh_current *checked);
/* Takes number k out of the list, into whose place the last one moves. */
nh_current nh_current_list_take(nh_analysis *result, size_t k);
/* Takes out those for which `leaves` holds; the others keep their order.  Returns their number, and copies of them in
 * the arena. */
size_t nh_current_list_take_all(nh_analysis *result, bool (*leaves)(const nh_current *current), nh_current **taken);
/* The energy first, then the simple ones, so that complicated ones are called dependent; equally simple ones in an
 * order that does not depend on rounding. */
void nh_current_list_sort(nh_analysis *result);
/* Takes number `from` to the place `to` before it; those between move up. */
void nh_current_list_move(nh_analysis *result, size_t from, size_t to);
/* Whether each of them is independent of those before it; fraction[k] of its gradient is. */
void nh_current_list_rank(nh_analysis *result, const nh_independence *kind, const double *fraction);

/* "Phi3"; "Psi3" where the system has a symbol such as Phi1, and so on.  In the arena. */
const char *nh_current_list_name(nh_analysis *result, size_t number);
/* Names all that were found: by the source's symbols, or by numbers that no symbol has. */
void nh_current_list_name_all(nh_analysis *result);

/* The formulas, and whether each is proved: list->count of both. */
void nh_current_list_formulas(const nh_current_list *list, nh_ex *phi, bool *proved);

/* The same for those of a part of the motions; false where there are NH_MOST_PIECES. */
bool nh_current_list_append_piece(nh_analysis *result, const nh_current *checked);
/* Keeps those with keep[k], in their order. */
void nh_current_list_keep_pieces(nh_analysis *result, const bool *keep);

/* The same for functions of the others; false where there are NH_MOST_FURTHER.  degree: in the velocities. */
bool nh_current_list_append_further(nh_analysis *result, const nh_current *checked, size_t degree);

#endif
