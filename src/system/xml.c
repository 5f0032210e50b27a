/* xml: see xml.h. */
#include "system/xml.h"

#include <expat.h>
#include <string.h>

#include "system/deck_internal.h"

typedef struct {
    XML_Parser parser;
    nh_deck *deck;
    nh_error *error;
    /* blanks before the text: an XML declaration stands at the very beginning for Expat, if not for people */
    size_t skip;
    nh_xml *root, *open; /* open: the element whose end is still to come */
} reader;

/* The byte of the source at which Expat is. */
static size_t place(const reader *r)
{
#if XML_MAJOR_VERSION > 2 || XML_MINOR_VERSION >= 9 /* where the other name is deprecated */
    int64_t index = XML_GetCurrentByteIndex64(r->parser);
#else
    int64_t index = XML_GetCurrentByteIndex(r->parser);
#endif
    size_t at = r->skip + (index < 0 ? 0 : (size_t)index);
    return at < r->deck->length ? at : r->deck->length;
}

static size_t skip_space(const char *source, size_t at)
{
    while (nh_deck_is_space(source[at])) at++;
    return at;
}

/* The attributes of the start tag at `begin`, in the order of the file, which is Expat's: the tag is known to be well
   formed. */
static void place_attributes(const char *source, nh_xml *element)
{
    size_t at = element->begin + 1 + strlen(element->name);
    for (size_t i = 0; i < element->attributes; i++) {
        nh_xml_attribute *a = &element->attribute[i];
        a->at = at = skip_space(source, at);
        at = skip_space(source, at + strlen(a->name));
        at = skip_space(source, at + 1); /* behind the sign = */
        a->begin = a->end = at + 1;
        while (source[a->end] && source[a->end] != source[at]) a->end++;
        at = a->end + 1;
    }
    element->end = at;
}

static void XMLCALL start(void *context, const XML_Char *name, const XML_Char **words)
{
    reader *r = context;
    nh_xml *element = nh_arena_alloc(r->deck->arena, sizeof *element);
    *element = (nh_xml){.name = nh_arena_strdup(r->deck->arena, name), .begin = place(r), .parent = r->open};
    while (words[2 * element->attributes]) element->attributes++;
    element->attribute = nh_arena_alloc(r->deck->arena, (element->attributes + 1) * sizeof *element->attribute);
    for (size_t i = 0; i < element->attributes; i++) {
        element->attribute[i].name = nh_arena_strdup(r->deck->arena, words[2 * i]);
        element->attribute[i].value = nh_arena_strdup(r->deck->arena, words[2 * i + 1]);
    }
    place_attributes(r->deck->source, element);
    if (!r->open) r->root = element;
    else if (r->open->last) r->open->last->next = element;
    else r->open->first = element;
    if (r->open) r->open->last = element;
    r->open = element;
}

static void XMLCALL finish(void *context, const XML_Char *name)
{
    reader *r = context;
    (void)name;
    r->open = r->open->parent;
}

static void XMLCALL document_type(void *context, const XML_Char *name, const XML_Char *system, const XML_Char *public,
                                  int subset)
{
    reader *r = context;
    (void)name, (void)system, (void)public, (void)subset;
    nh_deck_fail_at(r->deck, place(r), r->error, "a document type (`<!DOCTYPE`) is not read");
    nh_error_hint(r->error, "remove it; entities that it declares must be written out");
    XML_StopParser(r->parser, XML_FALSE);
}

/* Expat's words for what is wrong, and which element is still open. */
static bool explain(reader *r)
{
    size_t line, column;
    nh_deck_fail_at(r->deck, place(r), r->error, "this is not well-formed XML: %s",
                    XML_ErrorString(XML_GetErrorCode(r->parser)));
    if (XML_GetErrorCode(r->parser) == XML_ERROR_INVALID_TOKEN)
        return nh_error_hint(
            r->error,
            "a tag ends with `>`, a value stands in quotes, and `&` and `<` in it are written `&amp;` and `&lt;`");
    if (!r->open) return nh_error_hint(r->error, "the file must be one element <robot name=\"..\"> ... </robot>");
    nh_deck_place(r->deck, r->open->begin, &line, &column);
    return nh_error_hint(r->error,
                         "`<%s>` of line %zu is open here; it ends with `</%s>`, or begins and ends as `<%s ... />`",
                         r->open->name, line, r->open->name, r->open->name);
}

bool nh_xml_looks(const nh_deck *deck)
{
    const char *begin = deck->source + skip_space(deck->source, 0);
    return *begin == '<' && begin[1] != '<'; /* `<<` is YAML's key of a merge */
}

static void *reallocate(void *old, size_t size) { return nh_realloc_array(old, 1, size); }

const nh_xml *nh_xml_read(nh_deck *deck, nh_error *error)
{
    static const XML_Memory_Handling_Suite memory = {nh_alloc_bytes, reallocate, nh_free};
    reader r = {.parser = XML_ParserCreate_MM("UTF-8", &memory, NULL), .deck = deck, .error = error};
    nh_memory_got(r.parser);
    r.skip = skip_space(deck->source, 0);
    XML_SetUserData(r.parser, &r);
    XML_SetElementHandler(r.parser, start, finish);
    XML_SetStartDoctypeDeclHandler(r.parser, document_type);
    bool good = XML_Parse(r.parser, deck->source + r.skip, (int)(deck->length - r.skip), 1) == XML_STATUS_OK;
    if (!good && XML_GetErrorCode(r.parser) == XML_ERROR_NO_MEMORY) nh_memory_ended(0);
    if (!good) explain(&r);
    XML_ParserFree(r.parser);
    return good ? r.root : NULL;
}

const nh_xml_attribute *nh_xml_get(const nh_xml *element, const char *name)
{
    for (size_t i = 0; element && i < element->attributes; i++)
        if (!strcmp(element->attribute[i].name, name)) return &element->attribute[i];
    return NULL;
}

const nh_xml *nh_xml_child(const nh_xml *element, const char *name, const nh_xml *after)
{
    const nh_xml *child = after ? after->next : element ? element->first : NULL;
    while (child && strcmp(child->name, name)) child = child->next;
    return child;
}
