/* urdf: robots in the Unified Robot Description Format (URDF) as system files.
 *
 * Links become bodies, joints become joints, masses and dampings parameters; robot.c adds what carries the root and the
 * wheels.  The tree is that of a system file, so that everything else reads it as one, and messages point into the
 * XML. */
#ifndef NH_URDF_H
#define NH_URDF_H

#include "base/memory.h"
#include "system/deck.h"

/* A key of the root that no file has: {link: {written: .., radius: .., at: [..], height: ..} or {.., why: ..}}, the
 * circles of links that could be wheels; `written` is the link's name in the description, `like: wheel` stands where it
 * looks like a wheel, `height` that of the centre above the root link's origin at zero displacements, `why` the reason
 * why there is none. */
#define NH_URDF_RIMS " rims"

/* The root of a deck that holds XML.  NULL with a message. */
const nh_deck_node *nh_urdf_read(nh_deck *deck, nh_error *error);

/* A link's name as that of a body: letters, digits and _ (as names are in system files).  Two may become the same. */
char *nh_urdf_name(nh_arena *arena, const char *name);
/* The same for all links, or all joints: different names stay different, and those that are names already stay. */
void nh_urdf_names(nh_arena *arena, size_t count, const char *const *written, char **own);

#endif
