#include "base/json.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <string.h>

#include "base/escape.h"
#include "base/memory.h"
#include "base/text.h"

/* cJSON itself drops the last digit. */
static cJSON *number(double value)
{
    char text[40];
    if (!isfinite(value)) return cJSON_CreateNull();
    nh_text_number(value, text, sizeof text);
    return cJSON_CreateRaw(text);
}

static nh_json *put(nh_json *object, const char *key, cJSON *item)
{
    cJSON_AddItemToObject(object, key, item);
    return item;
}

static nh_json *add(nh_json *array, cJSON *item)
{
    cJSON_AddItemToArray(array, item);
    return item;
}

/* JSON is UTF-8, but a path of the system may be any bytes. */
static cJSON *text_or_null(const char *text)
{
    if (!text) return cJSON_CreateNull();
    nh_text whole;
    nh_text_init(&whole);
    nh_utf8_mend(text, &whole);
    cJSON *item = cJSON_CreateString(nh_text_string(&whole));
    nh_text_clear(&whole);
    return item;
}

/* Without memory cJSON would silently leave members out.  It allocates through base/memory.h, where a failed allocation
 * does not return. */
static void use_our_memory(void)
{
    static cJSON_Hooks hooks = {nh_alloc, nh_free};
    cJSON_InitHooks(&hooks);
}

nh_json *nh_json_object(void)
{
    use_our_memory();
    return cJSON_CreateObject();
}

nh_json *nh_json_put_object(nh_json *object, const char *key) { return put(object, key, cJSON_CreateObject()); }
nh_json *nh_json_put_array(nh_json *object, const char *key) { return put(object, key, cJSON_CreateArray()); }
void nh_json_put_number(nh_json *object, const char *key, double value) { put(object, key, number(value)); }
void nh_json_put_text(nh_json *object, const char *key, const char *text) { put(object, key, text_or_null(text)); }
void nh_json_put_bool(nh_json *object, const char *key, bool value) { put(object, key, cJSON_CreateBool(value)); }
void nh_json_put_null(nh_json *object, const char *key) { put(object, key, cJSON_CreateNull()); }
void nh_json_put_copy(nh_json *object, const char *key, const nh_json *value)
{
    put(object, key, cJSON_Duplicate(value, 1));
}
nh_json *nh_json_add_object(nh_json *array) { return add(array, cJSON_CreateObject()); }
nh_json *nh_json_add_array(nh_json *array) { return add(array, cJSON_CreateArray()); }
void nh_json_add_number(nh_json *array, double value) { add(array, number(value)); }
void nh_json_add_text(nh_json *array, const char *text) { add(array, text_or_null(text)); }
nh_json *nh_json_get(const nh_json *object, const char *key) { return cJSON_GetObjectItem(object, key); }

void nh_json_put_numbers(nh_json *object, const char *key, size_t n, const double *value, size_t stride)
{
    nh_json *array = nh_json_put_array(object, key);
    for (size_t i = 0; i < n; i++) nh_json_add_number(array, value[i * stride]);
}

char *nh_json_finish(nh_json *root)
{
    char *printed = cJSON_Print(root);
    cJSON_Delete(root);
    size_t length = strlen(printed);
    char *out = nh_alloc(length + 2);
    memcpy(out, printed, length);
    out[length] = '\n';
    cJSON_free(printed);
    return out;
}

char *nh_json_line(nh_json *root)
{
    char *printed = cJSON_PrintUnformatted(root);
    cJSON_Delete(root);
    char *out = nh_strdup(printed);
    cJSON_free(printed);
    return out;
}

nh_json *nh_json_parse(const char *text)
{
    use_our_memory();
    return cJSON_Parse(text);
}
void nh_json_free(nh_json *root) { cJSON_Delete(root); }
const char *nh_json_text(const nh_json *object, const char *key)
{
    return cJSON_GetStringValue(nh_json_get(object, key));
}

double nh_json_value(const nh_json *object, const char *key)
{
    const cJSON *item = nh_json_get(object, key);
    return cJSON_IsNumber(item) ? item->valuedouble : NAN;
}

bool nh_json_is_true(const nh_json *object, const char *key) { return cJSON_IsTrue(nh_json_get(object, key)); }

double nh_json_number_at(const nh_json *array, size_t index)
{
    const cJSON *item = nh_json_entry(array, index);
    return cJSON_IsNumber(item) ? item->valuedouble : NAN;
}

size_t nh_json_count(const nh_json *array) { return cJSON_IsArray(array) ? (size_t)cJSON_GetArraySize(array) : 0; }
const nh_json *nh_json_entry(const nh_json *array, size_t index) { return cJSON_GetArrayItem(array, (int)index); }

bool nh_json_is_text(const nh_json *value) { return cJSON_IsString(value); }

double nh_json_size(const nh_json *value)
{
    if (cJSON_IsNumber(value)) return value->valuedouble;
    if (cJSON_IsBool(value)) return cJSON_IsTrue(value);
    return cJSON_IsArray(value) ? (double)cJSON_GetArraySize(value) : NAN;
}

size_t nh_json_names(const nh_json *object, size_t most, const char **name)
{
    size_t n = 0;
    const cJSON *item;
    cJSON_ArrayForEach (item, object) {
        if (n < most && item->string) name[n++] = item->string;
    }
    return n;
}
