/* wording: definitions of the words in reports, for `nhsym explain` and the pages. */
#ifndef NH_WORDING_H
#define NH_WORDING_H

#include <stddef.h>

typedef struct {
    const char *word, *text;
} nh_glossary_entry;

size_t nh_glossary_count(void);
nh_glossary_entry nh_glossary_at(size_t i);

/* The functions without elementary form, each with its arguments and its meaning. */
size_t nh_glossary_functions(void);
nh_glossary_entry nh_glossary_function_at(size_t i);

#endif
