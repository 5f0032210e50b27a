/* analysis_file_internal: shared by analysis_file*.c. */
#ifndef NH_ANALYSIS_FILE_INTERNAL_H
#define NH_ANALYSIS_FILE_INTERNAL_H

#include "problem/analysis_file.h"

typedef struct {
    nh_analysis_file *a;
    const nh_model *model;
    const nh_deck_node *root;
    nh_named *extra;    /* E, Lbar, unknowns, definitions */
    size_t extras, own; /* the first `own` are E and Lbar */
    nh_error *error;
} nh_analysis_file_reader;

/* `count` + 1 zeroed elements that live as long as the analysis. */
void *nh_analysis_file_take(nh_analysis_file_reader *r, size_t count, size_t size);
/* An expression in the names of the analysis, brought to the model's chart. */
bool nh_analysis_file_parse(nh_analysis_file_reader *r, const nh_deck_node *node, nh_ex *out);
/* One of `count` names; an absent node leaves *out alone. */
bool nh_analysis_file_choice(const nh_deck *deck, const nh_deck_node *node, const char *what, size_t count,
                             const char *const *names, size_t *out, nh_error *error);
/* A list of "name = expression". */
bool nh_analysis_file_watches(nh_analysis_file_reader *r, const nh_deck_node *list, const char *what, nh_named **out,
                              size_t *count);
/* Reads the map {x: 0, ..} of an initial state. */
bool nh_analysis_file_read_initial(nh_analysis_file_reader *r, const nh_deck_node *map);
/* Reads the figures. */
bool nh_analysis_file_read_figures(nh_analysis_file_reader *r);
/* Reads the ansatz, a list of families. */
bool nh_analysis_file_read_ansatz(nh_analysis_file_reader *r);

#endif
