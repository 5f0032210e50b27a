/* export_code: the body of a function in any language: names, then the unknowns, then the results. */
#ifndef NH_EXPORT_CODE_H
#define NH_EXPORT_CODE_H

#include "commands/export.h"
#include "document/source.h"

/* A function while it is being written. */
typedef struct nh_export_body {
    const nh_export *x;
    const nh_export_function *f;
    const char *prefix;
    const char *const *member; /* names of the parameters in the language */
    nh_source *code;
    nh_text *out;
    const char *indent; /* blanks before a statement */
    const char *time, *argument[NH_EXPORT_MOST_ARRAYS], *result[NH_EXPORT_MOST_ARRAYS], *inputs, *parameters;
    const char *unknown[NH_EXPORT_MOST_SOLVES], *matrix[NH_EXPORT_MOST_SOLVES], *right[NH_EXPORT_MOST_SOLVES];
} nh_export_body;

/* How a language writes the statements of a body; names that are not used are not unpacked. */
typedef struct {
    const nh_source_language *language;
    void (*begin)(nh_export_body *b);
    void (*unpack)(nh_export_body *b, const char *name, const char *array, size_t index);
    void (*parameter)(nh_export_body *b, const char *name, const char *member);
    void (*fill)(nh_export_body *b, const char *array, size_t rows, size_t columns,
                 const nh_ex *e);                    /* a new array; columns 0: a vector */
    void (*solve)(nh_export_body *b, size_t i);      /* unknown[i] = matrix[i]^-1 right[i] */
    void (*newton)(nh_export_body *b, size_t i);     /* begins a loop, with unknown[i] as the guess */
    void (*newton_end)(nh_export_body *b, size_t i); /* ends it, after one step */
    void (*end)(nh_export_body *b);                  /* the results */
} nh_export_form;

/* The name of parameter i as a member, in the arena of the code's language. */
const char *const *nh_export_members(const nh_export *x, const nh_source_language *language, nh_arena *arena);
/* Sets the indentation of the statements that follow: within a loop, behind it. */
void nh_export_indent(nh_export_body *b, const char *indent);
/* Writes the body of a function, between form->begin and form->end; returns whether the code has the sign function. */
bool nh_export_put_body(const nh_export_form *form, const nh_export *x, const nh_export_function *f, const char *prefix,
                        const char *const *member, nh_text *out);
size_t nh_export_expressions(const nh_export_function *f, nh_arena *arena, nh_ex **out);

#endif
