/* shown: the geometry of a system as a document, as its first screen, and as JSON (schema version 1,
 * docs/formats.md). */
#ifndef NH_DOCUMENT_SHOWN_H
#define NH_DOCUMENT_SHOWN_H

#include "commands/show.h"
#include "document/pen.h"

/* Both complete the geometry where they show it. */
void nh_shown_write(nh_shown *shown, const nh_run *run, nh_pen_style style, nh_text *out);
/* A heap string (nh_free) that ends in a newline; `run` may be NULL. */
char *nh_shown_json(nh_shown *shown, const nh_run *run);

#endif
