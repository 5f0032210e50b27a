/* thumbnail: a motion as a small picture: paths, and the system at their end. */
#ifndef NH_THUMBNAIL_H
#define NH_THUMBNAIL_H

#include "base/text.h"
#include "document/time_series.h"

/* A stand-alone SVG document of a few kilobytes, without axes, both on one scale; `title` is its text alternative.
   False when nothing is drawn. */
bool nh_thumbnail(const nh_time_series *course, const char *title, nh_text *out);

#endif
