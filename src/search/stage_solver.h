/* stage_solver: one stage of the search: solve a linear problem and keep the new currents. */
#ifndef NH_STAGE_SOLVER_H
#define NH_STAGE_SOLVER_H

#include "integrals/dictionary.h"
#include "integrals/sectors.h"
#include "search/counted.h"
#include "search/currents.h"

enum { NH_MOST_FACTORS = 10 };

/* The state of the search. */
typedef struct {
    nh_analysis *r;
    nh_current_checker *bench;
    nh_dictionary words;
    nh_points *ranges;
    nh_reflections *reflections; /* found when a stage is large */
    size_t factors;              /* simple currents, dependent ones too: factors of later stages */
    nh_ex factor[NH_MOST_FACTORS];
    nh_counted counted;          /* stages that the count makes superfluous are left out */
    size_t forms;                /* that linear motion leaves invariant, when all of them are known: quadratic ones */
    /* the stage at hand has few columns for what it looks for: it may have as many as any ansatz */
    bool wide;
} nh_stage_solver;

/* Points for the ranges of columns, and a current checker; no stages yet. */
bool nh_stage_solver_begin(nh_stage_solver *solver, nh_analysis *result, nh_error *error);
void nh_stage_solver_end(nh_stage_solver *solver);

/* A stage's linear problem, solved. */
typedef struct {
    nh_ansatz *ansatz;
    nh_points *fit;
    nh_nullspace *nullspace; /* NULL when something went wrong */
    size_t sectors;
    nh_limit limit;          /* why it was not solved: too large */
} nh_solved;

/* Nothing more to find, or no work or time left. */
bool nh_stage_solver_done(const nh_stage_solver *solver);

/* Columns are limited by the largest part, and by what can be held at all. */
nh_solved nh_stage_solver_solve(nh_stage_solver *solver, size_t families, const nh_family *family);
void nh_solved_clear(nh_solved *solved);

/* An entry in the list of what was tried. */
nh_stage_record *nh_stage_solver_note(nh_stage_solver *solver, const char *name);
/* How much new a stage seems to give, and the largest of the null values that it comes from (`worst`; may be NULL);
   whether any. */
size_t nh_stage_solver_news(nh_stage_solver *solver, size_t families, const nh_family *family, double *worst);
bool nh_stage_solver_promising(nh_stage_solver *solver, size_t families, const nh_family *family);
/* Solve it, keep what is new, and note it. */
void nh_stage_solver_stage(nh_stage_solver *solver, const char *name, size_t families, const nh_family *family);
/* One expression: where it is new, and its rate cancels in ball arithmetic, it is kept.  Doubles may lose all digits of
 * it, where determinants of the constraints are small on parts of the domain.  How many independent currents that
 * makes. */
size_t nh_stage_solver_certify(nh_stage_solver *solver, nh_ex e, const char *name);
/* The same of each of n, as one stage. */
void nh_stage_solver_certify_each(nh_stage_solver *solver, size_t n, const nh_ex *e, const char *name);
/* The same of a sum of terms with these coefficients for the given parameters; for others they are solved for. */
size_t nh_stage_solver_certify_terms(nh_stage_solver *solver, size_t terms, const nh_ex *term,
                                     const nh_num *coefficient, const char *name);

/* Exponentials and waves in t and in the coordinates, with rates from the pencil. */
void nh_rates_search(nh_stage_solver *solver);
/* The same in t alone, for this family. */
void nh_rates_search_in(nh_stage_solver *solver, const nh_family *base);
/* Systems, or blocks of coordinates, whose equations of motion are linear with constant coefficients. */
void nh_linear_motion_search(nh_stage_solver *solver);
/* The quadratic forms of such a system alone, where its rates have no names: what positions turned into each other give
   is among them, and takes more. */
void nh_linear_motion_forms(nh_stage_solver *solver);
/* Momenta of the isometries of the kinetic energy, whatever the coordinates, and their products. */
void nh_isometries_search(nh_stage_solver *solver);
/* Currents polynomial in the velocities whose coefficients are functions of one coordinate, without closed form. */
void nh_series_stages(nh_stage_solver *solver);
/* The same, linear ones, where the equations depend on several coordinates: what has a closed form should have been
   found before. */
void nh_stage_solver_series_in_each(nh_stage_solver *solver);
/* With functions of t. */
void nh_stage_solver_series_in_time(nh_stage_solver *solver);

#endif
