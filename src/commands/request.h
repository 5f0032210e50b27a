/* request: all that can be asked of one system: a command and its options.  The command line and the questions of
 * nhsym.h fill it (library/request.h), and every command takes it.
 *
 * Members that are NULL, 0 or false were not given; a command reads those that it has a use for.  Nothing is owned: the
 * members refer to memory that outlives the request. */
#ifndef NH_COMMANDS_REQUEST_H
#define NH_COMMANDS_REQUEST_H

#include "base/memory.h"
#include "base/option.h"
#include "base/sweep.h"
#include "motion/method.h"
#include "system/embedding.h"

/* A value of an option in the text that completes a system file: it begins at byte `begin` there, and at byte `offset`
 * of the option's value. */
typedef struct {
    size_t begin, offset;
    const char *option, *typed;
} nh_request_piece;

typedef struct nh_request {
    nh_arena *arena;            /* of its strings */
    const char *command, *line; /* "analyze"; all that was typed, for reports */
    const char *system_path, *analysis_path;
    const char *system_name;  /* as it was typed, to find an analysis of the same name */
    const char *system_words; /* the system as typed, with its --wheel, --base, --on, --input, for a command line */
    const char *typed;        /* inputs and functions of it that were typed before the system, or NULL */
    size_t settings;          /* --set, applied after the settings of the analysis file */
    const nh_setting *setting;
    nh_chart_choice chart; /* --velocities; NH_CHART_AUTO: that of the analysis file */
    const char *grid; /* of analyze and benchmark: a word of system/sample_grid.h; NULL: that of the analysis file */
    nh_options options;
    /* of `options`; those that are given take precedence over the analysis file */
    bool limited, seed_given, samples_given, tolerance_given, until_given;
    bool documents, json, csv; /* will be written: a document or a JSON; a JSON; a table */
    bool draw;                 /* a document that draws the motion: also follows what is drawn */
    bool picture;              /* that, or a picture alone: with more points than a short table has */
    /* additions to the system file */
    size_t wheels, ons;
    const char **wheel, *base, **on; /* --wheel, each; --base; --on, each */
    const char *completed;           /* the text that adds them, or NULL */
    size_t pieces;
    nh_request_piece *piece;
    /* of motions: "phi=0, omega=2" (NULL: that of the analysis file, otherwise a state that satisfies the constraints);
     * where that is written, for messages (NULL: --initial) */
    const char *initial, *from;
    const char *table;                   /* a file of initial states */
    const struct nh_simulate_rows *rows; /* what it says, as the members of an ensemble */
    const char *watch;                   /* "y, T = m/2*v^2": only these, by the smallest model for them */
    bool scene;                          /* the same with the observables of the analysis file */
    const char *event;                   /* "y = 0, falling, stop; phi'": whose zeros are recorded, or end the motion */
    const char *section, *axes;          /* "x, rising": a Poincare section; "y, y'": the columns of the picture */
    size_t methods;
    const nh_method *const *method; /* one of a motion (0: a suitable one); of a comparison only these (0: all) */
    double step;                    /* output spacing; 0: a hundredth of the time */
    double accuracy;                /* of motions; 0: options.tolerance, unchecked */
    size_t ensemble;                /* members; 0: one motion */
    double spread;  /* of their initial states about the given one, relative to max(|z_i|, 1); 0: as usual */
    bool project;   /* moves velocities that violate the constraints to the nearest that do not */
    bool equations; /* of analyze, verify and reduce: writes out the objects of the theory */
    /* of analyze: does not search; rows of the search (search/staged_search.c) that a developer leaves out */
    bool model_only;
    bool absence;      /* of analyze: all planes and engines for the question whether there is any other integral */
    const char *route; /* "both", "fields" or "currents": what is fitted; NULL: that of the analysis file */
    uint64_t left_out;
    /* of verify (and one more column of a motion, Phi, for its page); "Z0=1; phi=phi'"; of verify, classify, scan,
     * export and show: what of it */
    const char *current, *field, *of;
    /* of reduce and export: "1, 2, 5" (numbers of the generators found) or "x=1; theta=1, x=-y, y=x" */
    const char *group;
    bool weak;         /* also allows symmetries up to a total derivative */
    const char *chain; /* "3; 1, 2": blocks of generators of the group, the smallest normal subgroup last */
    /* "1,4=1/2; 4,4=3": entries of the inner product g0 of these generators, which defines the lifts of the equations
     * by stages; NULL: the generators are orthonormal */
    const char *inner;
    /* the language; "u, tau": parameters that are inputs of a controller; the first word of the names */
    const char *to, *input, *name;
    /* of benchmark, classify, linearize, scan and simulate: every range, with commas and as a list */
    const char *over, **over_list;
    size_t overs;
    bool shape;      /* of classify: coefficients that do not depend on cyclic coordinates */
    bool robustness; /* of benchmark: maps */
    bool fit;        /* of benchmark: the discrete problem alone */
    double budget;   /* seconds */
    /* of scan */
    size_t numbers, chunk, chunks, workers;
    const char **number, *program;
    const char *folder;  /* of scan, and of every command with -o */
    const nh_team *team; /* processes of one run on several machines */
    void (*begin_worker)(void);
} nh_request;

#endif
