/* export_internal: shared by export.c (files, words about functions), export_code.c (bodies of functions) and one file
 * for each language. */
#ifndef NH_REPORT_EXPORT_INTERNAL_H
#define NH_REPORT_EXPORT_INTERNAL_H

#include "document/source.h"
#include "document/export.h"

/* A function while it is written. */
typedef struct nh_export_body {
    const nh_export *x;
    const nh_export_function *f;
    const char *prefix;
    const char *const *member; /* of the parameters, in the language's words */
    nh_source *code;
    nh_text *out;
    const char *indent; /* of a statement */
    const char *time, *argument[NH_EXPORT_MOST_ARRAYS], *result[NH_EXPORT_MOST_ARRAYS], *inputs, *parameters;
    const char *unknown[NH_EXPORT_MOST_SOLVES], *matrix[NH_EXPORT_MOST_SOLVES], *right[NH_EXPORT_MOST_SOLVES];
} nh_export_body;

/* How a language writes the statements of a body; a name that is not used is not unpacked. */
typedef struct {
    const nh_source_language *language;
    void (*begin)(nh_export_body *b);
    void (*unpack)(nh_export_body *b, const char *name, const char *array, size_t index);
    void (*parameter)(nh_export_body *b, const char *name, const char *member);
    void (*fill)(nh_export_body *b, const char *array, size_t rows, size_t columns,
                 const nh_ex *e);                    /* a new array; columns 0: a vector */
    void (*solve)(nh_export_body *b, size_t i);      /* unknown[i] = matrix[i]^-1 right[i] */
    void (*newton)(nh_export_body *b, size_t i);     /* a loop begins, with unknown[i] as the guess */
    void (*newton_end)(nh_export_body *b, size_t i); /* it ends, after one step */
    void (*end)(nh_export_body *b);                  /* results */
} nh_export_form;

/* member[i] of parameter i, in the arena of the code's language. */
const char *const *nh_export_members(const nh_export *x, const nh_source_language *language, nh_arena *arena);
/* Statements are indented so from now on: within a loop, behind it. */
void nh_export_indent(nh_export_body *b, const char *indent);
/* The body of a function, between form->begin and form->end; the code has the sign function or not. */
bool nh_export_put_body(const nh_export_form *form, const nh_export *x, const nh_export_function *f, const char *prefix,
                        const char *const *member, nh_text *out);
/* Arguments whose symbols occur in the body are unpacked; is this one used at all? */
bool nh_export_uses(const nh_export_function *f, nh_ex symbol);
size_t nh_export_expressions(const nh_export_function *f, nh_arena *arena, nh_ex **out);

/* What a function is, line by line, each after `before`: its purpose, where currents hold, which stage it is. */
void nh_export_words(const nh_export *x, const nh_export_function *f, const char *before, nh_text *out);
/* "name: what it is (x, y, phi)" of an array. */
void nh_export_array_words(const nh_export_function *f, const nh_export_array *a, nh_text *out);
/* The names of an array's rows. */
const char *nh_export_label(const nh_export_function *f, const nh_export_array *a, size_t row);
/* "title: exported by nhsym", the notes: the head of a file, each line after `before`. */
void nh_export_head(const nh_export *x, const char *before, nh_text *out);

void nh_export_c_header(const nh_export *x, const char *prefix, nh_text *out);
void nh_export_c_source(const nh_export *x, const char *prefix, bool include, nh_text *out);
void nh_export_python(const nh_export *x, const char *prefix, bool sympy, nh_text *out);
void nh_export_matlab(const nh_export *x, const char *prefix, nh_text *out);
void nh_export_latex(const nh_export *x, nh_text *out);
char *nh_export_json(const nh_export *x, const nh_run *run);

#endif
