/* urdf_internal: shared by urdf.c (links and joints) and urdf_values.c (numbers, places, circles). */
#ifndef NH_URDF_INTERNAL_H
#define NH_URDF_INTERNAL_H

#include "system/deck_build.h"
#include "system/urdf.h"
#include "system/xml.h"

typedef struct {
    double p[3], R[9]; /* a position and a rotation, row by row */
} nh_urdf_pose;

typedef struct nh_urdf_notes nh_urdf_notes; /* one kind of note */

typedef struct {
    nh_deck *deck;
    nh_error *error;
    nh_urdf_notes *notes; /* on parts that were left out or replaced */
} nh_urdf_reader;

bool nh_urdf_fail(nh_urdf_reader *u, size_t at, const char *format, ...) __attribute__((format(printf, 3, 4)));
/* Notes of one kind become one line: "FILE:LINE: KIND: ITEM (3), ITEM", with the line of the first item. */
void nh_urdf_note(nh_urdf_reader *u, size_t at, const char *kind, const char *item, ...)
    __attribute__((format(printf, 4, 5)));
/* The lines, in the order in which their kinds came. */
nh_deck_node *nh_urdf_notes_list(nh_urdf_reader *u);

extern const char nh_urdf_passed_over[]; /* a kind of note */

/* Note attributes and child elements that are not among these words (blanks between them).  One that resembles a known
 * word which is missing is refused as misspelt: its meaning would be lost.  `ignored`: children that have no meaning
 * here, and no note. */
bool nh_urdf_only(nh_urdf_reader *u, const nh_xml *element, const char *attributes, const char *children,
                  const char *ignored);

/* The attribute, which must be there. */
const nh_xml_attribute *nh_urdf_need(nh_urdf_reader *u, const nh_xml *element, const char *name);
/* Its numbers, exactly `count`; `words` (or NULL) gets them as they are written. */
bool nh_urdf_numbers(nh_urdf_reader *u, const nh_xml_attribute *a, size_t count, double *value, nh_deck_node *words);
/* One number; absent: the fallback. */
bool nh_urdf_number(nh_urdf_reader *u, const nh_xml *element, const char *name, double fallback, double *value);

/* The child <origin> of an element: into `map` (or nowhere: NULL) as `place`: [x, y, z] and `rotation`, unless they are
   zero. */
bool nh_urdf_origin(nh_urdf_reader *u, const nh_xml *element, nh_deck_node *map, const char *place, nh_urdf_pose *out);
nh_urdf_pose nh_urdf_product(const nh_urdf_pose *a, const nh_urdf_pose *b);

/* <inertial>: mass, centre, inertia and its axes into a body. */
bool nh_urdf_inertial(nh_urdf_reader *u, const nh_xml *inertial, nh_deck_node *body, double *mass);

/* The circle of a link that turns about `axis` (NULL: about none), `zero` its pose at zero displacements, as an entry
 * of NH_URDF_RIMS.  Does the joint turn without end? */
nh_deck_node *nh_urdf_rim(nh_urdf_reader *u, const nh_xml *link, const double *axis, const nh_urdf_pose *zero,
                          bool continuous);

/* Has it links, and not too many of these and of joints? */
bool nh_urdf_fits(nh_urdf_reader *u, const nh_xml *robot, size_t links, size_t joints);

/* Is the word NAME_x, or the like? */
bool nh_urdf_is_part(const char *word, const char *name);
/* Is the root <robot>?  Are the names of all joints, which must be there, different? */
bool nh_urdf_is_robot(nh_urdf_reader *u, const nh_xml *robot);
bool nh_urdf_distinct_joints(nh_urdf_reader *u, const nh_xml *robot);
/* The link that a joint's <parent> or <child> names, or "". */
const char *nh_urdf_end(const nh_xml *element, const char *key);
/* A link that is a parent alone and stands nowhere, as `world` often does, is a frame where everything else hangs on
 * it. Returns its name, or NULL; a name that resembles a link's is a misspelt one. */
const char *nh_urdf_implicit_root(const nh_xml *robot, size_t links, const char *const *written);

#endif
