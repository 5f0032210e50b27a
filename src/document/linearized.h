/* linearized: the linear equations of motion as a document, JSON, tables and a picture. */
#ifndef NH_DOCUMENT_LINEARIZED_H
#define NH_DOCUMENT_LINEARIZED_H

#include "commands/linearize.h"
#include "document/form.h"
#include "document/provenance.h"
#include "document/svg.h"

void nh_linearized_write(const nh_linearized *linearized, const nh_run *run, nh_pen_style style, nh_text *out);
char *nh_linearized_json(const nh_linearized *linearized, const nh_run *run); /* a heap string (nh_free) */

/* Eigenvalues: a row for each, or for each value of what changes. */
void nh_linearized_csv(const nh_linearized *linearized, nh_text *out);
/* The matrices: a row for each entry: value of what changes, matrix, row, column, entry. */
void nh_linearized_matrices_csv(const nh_linearized *linearized, nh_text *out);
/* Eigenvalues in the plane; real and imaginary parts over what changes. */
void nh_linearized_svg(const nh_linearized *linearized, nh_text *out);

/* The picture of nh_linearized_svg: its plot, with curves on the heap (nh_free). */
nh_plot nh_linearized_plot(const nh_linearized *linearized, nh_curve **curves);

/* "unstable"; and a sentence that says what follows. */
const char *nh_linearized_word(nh_linear_verdict verdict);
const char *nh_linearized_sentence(nh_linear_verdict verdict);

#endif
