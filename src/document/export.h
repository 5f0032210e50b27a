/* export: the functions of commands/export.h in other languages (docs/export.md). */
#ifndef NH_REPORT_EXPORT_H
#define NH_REPORT_EXPORT_H

#include "base/text.h"
#include "commands/export.h"
#include "document/provenance.h"

typedef enum {
    NH_EXPORT_C,
    NH_EXPORT_PYTHON,
    NH_EXPORT_SYMPY,
    NH_EXPORT_MATLAB,
    NH_EXPORT_JS, /* the model of a motion alone (document/live.h) */
    NH_EXPORT_LATEX,
    NH_EXPORT_JSON
} nh_export_target;

/* Reads "c", "python", ..; false with a suggestion. */
bool nh_export_target_of(const char *name, nh_export_target *out, nh_error *error);

/* A name with which files and functions may begin, from the name of the system, or from `wish`; false where that gives
 * none. */
bool nh_export_prefix(const nh_export *x, const char *wish, const char **out, nh_error *error);

/* Can the language express all functions that occur? */
bool nh_export_possible(const nh_export *x, nh_export_target target, nh_error *error);

/* The output for a target: as files with these names, or all in one text. */
typedef struct {
    const char *name; /* "sleigh.h" */
    nh_text text;
} nh_export_file;
enum { NH_EXPORT_MOST_FILES = 2 };
size_t nh_export_files(const nh_export *x, nh_export_target target, const char *prefix, const nh_run *run,
                       nh_export_file out[NH_EXPORT_MOST_FILES]);
void nh_export_text(const nh_export *x, nh_export_target target, const char *prefix, const nh_run *run, nh_text *out);

/* A summary of the functions, in a few lines. */
void nh_export_summary(const nh_export *x, nh_text *out);

#endif
