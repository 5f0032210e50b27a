/* theory: the geometry of a system for --equations: the constraint submanifold, the equations for symmetries, and the
 * brackets of the currents.  Everything is exact, and only shown. */
#ifndef NH_THEORY_H
#define NH_THEORY_H

#include "base/option.h"
#include "geometry/determining.h"
#include "geometry/submanifold.h"
#include "integrals/bracket.h"
#include "search/equation_symmetries.h"

typedef struct nh_theory {
    /* the chart of coordinate velocities where there is one: the formulas are written in it */
    const nh_model *model;
    const nh_submanifold *submanifold, *own; /* of it; and of the chart that the currents are in (perhaps the same) */
    const nh_determining *determining;
    const nh_inertial *inertial; /* NULL: the reaction cannot be split */
    double shown, written;       /* options: longest formula in text and page; in the JSON */
    size_t brackets;
    struct nh_theory_bracket {
        const char *name; /* of the current */
        const nh_symmetry *symmetry;
        const nh_bracket *bracket;
    } * bracket;
    const nh_symmetry_space *space;           /* of the currents that are proved; NULL: none was looked for */
    const nh_bracket_fields *fields;          /* of the submanifold that is shown */
    const nh_equation_symmetries *symmetries; /* of the equations of motion; NULL: none were looked for */
    size_t currents;
    const nh_named_current *current;
} nh_theory;

/* `other`: a chart of coordinate velocities beside a quasi one, or NULL.  There is room for `most` brackets. */
nh_theory *nh_theory_of(nh_arena *arena, const nh_model *model, const nh_model *other, size_t most,
                        const nh_options *options);
void nh_theory_add(nh_arena *arena, nh_theory *theory, const char *name, const nh_symmetry *symmetry);
/* The space of constraint symmetries of these currents, which are proved and kept by the caller, and the symmetries of
   the equations of motion; counted: symmetry_space.h. */
void nh_theory_space(nh_arena *arena, nh_theory *theory, size_t count, const nh_named_current *current, size_t counted,
                     const nh_options *options);

#endif
