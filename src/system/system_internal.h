/* system_internal: shared by system.c (names), system_read.c and system_parts.c (the file). */
#ifndef NH_SYSTEM_INTERNAL_H
#define NH_SYSTEM_INTERNAL_H

#include <stdio.h>

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

#endif
