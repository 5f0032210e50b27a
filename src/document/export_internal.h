/* export_internal: shared by export.c (files, words about functions) and one file for each language. */
#ifndef NH_REPORT_EXPORT_INTERNAL_H
#define NH_REPORT_EXPORT_INTERNAL_H

#include "document/export_code.h"
#include "document/export.h"

/* The description of a function, each line after `before`: its purpose, the region of currents, the stage. */
void nh_export_words(const nh_export *x, const nh_export_function *f, const char *before, nh_text *out);
/* "name: description (x, y, phi)" of an array. */
void nh_export_array_words(const nh_export_function *f, const nh_export_array *a, nh_text *out);
/* The names of an array's rows. */
const char *nh_export_label(const nh_export_function *f, const nh_export_array *a, size_t row);
/* The head of a file, each line after `before`: "title: exported by nhsym", and the notes. */
void nh_export_head(const nh_export *x, const char *before, nh_text *out);

void nh_export_c_header(const nh_export *x, const char *prefix, nh_text *out);
void nh_export_c_source(const nh_export *x, const char *prefix, bool include, nh_text *out);
void nh_export_python(const nh_export *x, const char *prefix, bool sympy, nh_text *out);
void nh_export_matlab(const nh_export *x, const char *prefix, nh_text *out);
void nh_export_latex(const nh_export *x, nh_text *out);
char *nh_export_json(const nh_export *x, const nh_run *run);

#endif
