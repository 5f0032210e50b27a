/* system_internal: shared by system.c (names), system_read.c and system_parts.c (the file). */
#ifndef NH_SYSTEM_INTERNAL_H
#define NH_SYSTEM_INTERNAL_H

#include <stdio.h>

#include "system/deck.h"
#include "system/system.h"

/* NH_FRAMED: angular velocities of orientations are symbols of their own. */
enum { NH_NO_VELOCITIES = 1, NH_NO_QUASI = 2, NH_FRAMED = 4 };

/* An expression (lhs NULL) or an equation, after the first `skip` bytes of the scalar `node`, with errors pointing into
   it. */
bool nh_system_read_expression(const nh_system *system, const nh_deck *deck, const nh_deck_node *node, size_t skip,
                               unsigned forbid, size_t extras, const nh_named *extra, nh_ex *lhs, nh_ex *rhs,
                               nh_error *error);
/* The same without quasi-velocities, and its text for outputs: what is written as on paper, in the canonical form. */
bool nh_system_read_written(const nh_system *system, const nh_deck *deck, const nh_deck_node *node, size_t skip,
                            nh_ex *lhs, nh_ex *rhs, const char **text, nh_error *error);
/* An expression; *undefined: it has no finite value at the given exact values of parameters, as 1/a at a = 0. */
bool nh_system_read_defined(const nh_system *system, const nh_deck *deck, const nh_deck_node *node, nh_ex *out,
                            bool *undefined, nh_error *error);

/* A system file while it is read. */
typedef struct {
    nh_system *system;
    nh_deck *deck;
    const nh_deck_node *root;
    nh_error *error;
    bool exact;        /* a parameter was given an exact value or a formula */
    nh_ex dissipation; /* Rayleigh's function */
    const char **note; /* of springs and dampers */
    size_t notes;
} nh_system_reader;

/* In order: zeroed memory of the system (count + 1 elements); the list under a key (absent: empty); the text under a
 * key; the two sides of "name = expression"; and the optional parts of the file. */
void *nh_system_take(nh_system_reader *r, size_t count, size_t size);
bool nh_system_list_of(nh_system_reader *r, const nh_deck_node *map, const char *key, const nh_deck_node **out,
                       size_t *count);
/* true or false; false where there is no such key.  `meaning` is the hint for anything else. */
bool nh_system_truth_of(nh_system_reader *r, const nh_deck_node *map, const char *key, const char *meaning, bool *out);
bool nh_system_text_of(nh_system_reader *r, const nh_deck_node *map, const char *key, const char *fallback,
                       const char **out);
bool nh_system_assignment_name(nh_system_reader *r, const nh_deck_node *node, const char *what, const char **name);
bool nh_system_read_right_side(nh_system_reader *r, const nh_deck_node *node, unsigned forbid, nh_ex *out);
/* Gives parameters the values of a request; those with exact values and inputs become definitions. */
bool nh_system_apply_settings(nh_system_reader *r, size_t count, const nh_setting *setting);
/* `functions:`, and those settings that give a value to one: "V(r)". */
bool nh_system_read_functions(nh_system_reader *r, size_t count, const nh_setting *setting);
bool nh_system_read_tables(nh_system_reader *r); /* `tables:` */
bool nh_system_is_function_setting(const nh_setting *setting);
bool nh_system_new_name(nh_system_reader *r, const nh_deck_node *node); /* is it free and well formed? */
bool nh_system_read_chart(nh_system_reader *r);
bool nh_system_read_forces(nh_system_reader *r);
bool nh_system_read_domain(nh_system_reader *r);
bool nh_system_read_symmetry(nh_system_reader *r);
bool nh_system_read_drawing(nh_system_reader *r);
bool nh_system_read_known(nh_system_reader *r);
bool nh_system_check_motions(nh_system_reader *r, const nh_deck_node *known);
bool nh_system_read_robustness(nh_system_reader *r);
bool nh_system_read_notes(nh_system_reader *r); /* these come at the end, as they concern the whole system */

/* `levels:` as constraints, behind all others, and velocities for them (invariant_level.c). */
bool nh_system_read_levels(nh_system_reader *r);

/* Bodies and joints, in this order: parents; the coordinates of joints (room for them: NH_MOST_SCREWS each);
 * expressions and all that follows from them.  Wheels become constraints, for which the caller has room. */
bool nh_system_read_tree(nh_system_reader *r);
bool nh_system_read_joint_coordinates(nh_system_reader *r);
bool nh_system_read_chain(nh_system_reader *r);
/* Positions of `points:` as definitions.  And `springs:`, `dampers:`, `actuators:` and `dissipation:`, which change the
 * Lagrangian and the forces (elements.c). */
bool nh_system_read_points(nh_system_reader *r);
bool nh_system_read_elements(nh_system_reader *r);
/* Are the first `length` characters NAME_x, NAME_y or NAME_z of a point of the file? */
bool nh_system_is_point(const nh_system_reader *r, const char *name, size_t length);
size_t nh_system_most_wheel_constraints(const nh_system *system);
void nh_system_add_wheel_constraints(nh_system_reader *r);

/* Declares the orientation that the map `item` of the file describes (NULL: one with default names): its coordinates
 * come next.  The caller has room for three coordinates. */
bool nh_orientation_declare(nh_system_reader *r, const nh_deck_node *item, const nh_deck_node *name, const char *doc);
/* After all velocities have symbols: matrices and angular velocities. */
void nh_orientation_build_all(nh_system *system);
/* Where the file chooses no velocities: those of the other coordinates and the angular velocities, without those that
 * the constraints determine (frame_velocities.c). */
bool nh_orientation_velocities(nh_system_reader *r);

/* Default sampling intervals that reach beyond the walls of functions of one symbol.
 *
 * |t - 2| is 2 - t all over 0 < t < 1: samples from there alone would show what holds for t < 2 only.  So where a wall
 * (exact/walls.h) of the Lagrangian, a force or a constraint depends on one symbol alone, and the default interval
 * lies on one side of it, the interval is widened to half of its width beyond.  A coordinate that is an argument of a
 * table has the interval of the table. */

/* Sets system->reach; intervals that the file gives are left as they are. */
void nh_reach_walls(nh_system *system);

/* Notes on wheels that surely are not meant so. */

/* Wheels that do not touch their surface wherever the system is, and wheels whose inertia is not round about the axle
 * about which they turn, with the values of the parameters.  At most two texts in the system's memory; returns how
 * many. */
size_t nh_wheel_checks(const nh_system *system, const char *out[2]);

/* Do the terms of a system have one unit?
 *
 * Symbols have the units that the file gives: parameters and coordinates their own, a coordinate of type length metres
 * of unknown scale, an angle 1, a velocity that of its coordinate by time.  A symbol without a unit may have any unit,
 * and so may all that contains it; so may a number that is added.  A number as a factor has none.  Compared are the
 * terms of a sum, the two sides of a constraint, arguments of functions and exponents with 1, and a generalized force
 * with the Lagrangian's unit by that of its coordinate.  Systems of bodies and joints are not compared: numbers stand
 * for masses and lengths there. */

/* Writes a sentence about each part of the system in which units do not agree, in memory of the system; returns how
 * many. */
size_t nh_dimension_check(nh_system *system, const char ***out);

/* What a file with bodies leaves to be completed.
 *
 *     base: planar                  the body without a joint is carried: fixed, planar, floating (angles),
 *                                   free (an orientation)
 *     wheels: [left, {body: right, radius: 0.1}]
 *
 * The body that is the child of no joint gets a joint: of the type `base`; without it, where the bodies are those of a
 * robot description, planar if there are wheels and otherwise fixed.  A wheel that names a body alone rolls; its axle
 * is the axis of the body's joint, and a robot description gives its radius. */

/* After all files are merged. */
bool nh_robot_complete(nh_deck *deck, nh_error *error);

#endif
