/* json: writes and reads JSON documents, over cJSON.  Numbers read back exactly; what is not finite becomes null. */
#ifndef NH_JSON_H
#define NH_JSON_H

#include <stdbool.h>
#include <stddef.h>

typedef struct cJSON nh_json; /* an object, an array, or a value; children belong to their parent */

/* A new object, which the caller owns until it is added to another value or written. */
nh_json *nh_json_object(void);
/* Members of an object. */
nh_json *nh_json_put_object(nh_json *object, const char *key);
nh_json *nh_json_put_array(nh_json *object, const char *key);
void nh_json_put_number(nh_json *object, const char *key, double value);
void nh_json_put_text(nh_json *object, const char *key, const char *text); /* null when text is NULL */
void nh_json_put_bool(nh_json *object, const char *key, bool value);
void nh_json_put_null(nh_json *object, const char *key);
/* An array of the n numbers value[0], value[stride], ... */
void nh_json_put_numbers(nh_json *object, const char *key, size_t n, const double *value, size_t stride);
/* A copy of the member `from`. */
void nh_json_put_copy(nh_json *object, const char *key, const nh_json *value);
/* Entries of an array. */
nh_json *nh_json_add_object(nh_json *array);
nh_json *nh_json_add_array(nh_json *array);
void nh_json_add_number(nh_json *array, double value);
void nh_json_add_text(nh_json *array, const char *text);

/* The member `key`, which still belongs to the object; NULL where it is missing or `object` is NULL. */
nh_json *nh_json_get(const nh_json *object, const char *key);

/* ---- reading ---- */

/* NULL: the text is no JSON document. */
nh_json *nh_json_parse(const char *text);
void nh_json_free(nh_json *root);
/* For a member that may be missing or of another kind: NULL, or not-a-number. */
const char *nh_json_text(const nh_json *object, const char *key);
double nh_json_value(const nh_json *object, const char *key);
bool nh_json_is_true(const nh_json *object, const char *key);
/* For an array, which may be NULL. */
double nh_json_number_at(const nh_json *array, size_t index);
size_t nh_json_count(const nh_json *array);
const nh_json *nh_json_entry(const nh_json *array, size_t index);

bool nh_json_is_text(const nh_json *value);
/* A number itself, a truth value as 1 or 0, a list as the number of its entries; not-a-number for anything else. */
double nh_json_size(const nh_json *value);
/* The names of an object's members, at most `most`; they last as long as the object. */
size_t nh_json_names(const nh_json *object, size_t most, const char **name);

/* The document as a heap string (nh_free) that ends in a newline; the document is freed. */
char *nh_json_finish(nh_json *root);
/* The same on one line, which does not end in a newline. */
char *nh_json_line(nh_json *root);

#endif
