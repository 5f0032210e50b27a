/* xml: XML text as a tree of elements with the place of every attribute.
 *
 * Expat parses; it tells the byte at which an element begins, from which the places of its attributes are found.  Texts
 * between elements are left out.  Document types, and with them entities of their own, are refused. */
#ifndef NH_XML_H
#define NH_XML_H

#include "system/deck.h"

typedef struct {
    const char *name, *value;
    size_t at, begin, end; /* bytes of the source: where the name begins; the value, without its quotes */
} nh_xml_attribute;

typedef struct nh_xml nh_xml;
struct nh_xml {
    const char *name;
    size_t begin, end; /* bytes of the start tag */
    size_t attributes;
    nh_xml_attribute *attribute;
    nh_xml *parent, *first, *last, *next;
};

/* Is the source XML, and not YAML? */
bool nh_xml_looks(const nh_deck *deck);
/* The root of the source, in the deck's memory.  NULL with a message. */
const nh_xml *nh_xml_read(nh_deck *deck, nh_error *error);

/* The attribute of this name, or NULL; the first child of this name behind `after` (NULL: the first one), or NULL. */
const nh_xml_attribute *nh_xml_get(const nh_xml *element, const char *name);
const nh_xml *nh_xml_child(const nh_xml *element, const char *name, const nh_xml *after);

#endif
