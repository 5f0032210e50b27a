/* request: all that can be asked of one system: the command line and the questions of nhsym.h fill it, and the rows of
 * library/answer.h read it.  Members that are NULL, 0 or false were not given. */
#ifndef NH_LIBRARY_REQUEST_H
#define NH_LIBRARY_REQUEST_H

#include "base/memory.h"
#include "base/option.h"
#include "base/sweep.h"
#include "base/text.h"
#include "motion/method.h"
#include "system/embedding.h"

/* A value of an option in the text that completes a system file: it begins at byte `begin` there, and at byte `offset`
 * of the option's value. */
typedef struct {
    size_t begin, offset;
    const char *option, *typed;
} nh_request_piece;

typedef struct {
    nh_arena *arena;            /* of its strings */
    const char *command, *line; /* "analyze"; all that was typed, for reports */
    const char *system_path, *analysis_path;
    const char *system_words; /* the system as typed, with its --wheel, --base, --on, --input, for a command line */
    const char *typed;        /* inputs and functions of it that were typed before the system, or NULL */
    size_t settings;
    nh_setting *setting;
    nh_chart_choice velocities;
    nh_options options;
    bool limited, seed_given, samples_given, tolerance_given, until_given; /* in `options` */
    bool documents, json, csv; /* will be written: a document or a JSON; a JSON; a table */
    bool draw;                 /* a document that draws the motion */
    bool picture;              /* that, or a picture alone */
    /* additions to the system file */
    size_t wheels, ons;
    const char **wheel, *base, **on; /* --wheel, each; --base; --on, each */
    const char *completed;           /* the text that adds them, or NULL */
    size_t pieces;
    nh_request_piece *piece;
    /* of motions */
    const char *initial, *from; /* "phi=0, omega=2"; where that is written, for messages (NULL: --initial) */
    const char *table;          /* a file of initial states */
    const char *watch, *event, *section, *axes;
    size_t methods;
    const nh_method *const *method; /* one of a motion; of a comparison only these */
    double step, accuracy, spread;
    size_t ensemble;
    bool project, scene;
    /* of verify; of verify, classify, scan, export and show; of analyze, verify and reduce */
    const char *current, *field, *of;
    bool equations;
    /* of reduce and export */
    const char *group, *chain, *inner, *to, *input, *name;
    bool weak;
    /* of benchmark, classify, scan and simulate: every range, with commas and as a list */
    const char *over, **over_list;
    size_t overs;
    bool shape, robustness;
    double budget;
    /* of scan */
    size_t numbers, chunk, chunks, workers;
    const char **number, *program;
    const char *folder;  /* of scan, and of every command with -o */
    const nh_team *team; /* processes of one run on several machines */
    void (*begin_worker)(void);
} nh_request;

/* A numerical option by its name (base/option.h); "auto", "quasi" or "coordinates"; the name of one more integrator, or
   "auto". */
bool nh_request_option(nh_request *request, const char *name, const char *text, nh_error *error);
/* A number, or an expression of numbers: 2*pi, 90deg, 1/3. */
bool nh_request_number(const char *text, double *value);
bool nh_request_velocities(nh_request *request, const char *word, nh_error *error);
bool nh_request_method(nh_request *request, const char *word, nh_error *error);
/* The entries of a list of integrators. */
bool nh_request_methods(nh_request *request, const char *list, nh_error *error);
/* Remembers "--option NAME=TEXT" for a command line that names the system. */
void nh_request_typed(nh_request *request, const char *option, const char *name, const char *text);
/* A parameter over time: an expression of t, or FILE.csv:COLUMN.  There is room for one more setting. */
bool nh_request_input(nh_request *request, const char *name, const char *text, nh_error *error);

/* The file of a system by name or path, with the additions. */
bool nh_request_system(nh_request *request, const char *word, nh_error *error);
/* Writes the notes about the system file: lines that begin with `head`. */
void nh_request_remarks(const nh_request *request, const char *head, nh_text *out);
/* An error in an addition is an error of the command line: the message shows the option and its value. */
void nh_request_blame(const nh_request *request, nh_error *error);

/* The file of an analysis by name or path; the one that has the name of the system, if there is one: a system by path
   has none, nor one with additional levels. */
bool nh_request_analysis(nh_request *request, const char *word, nh_error *error);
void nh_request_usual_analysis(nh_request *request, const char *system);
/* The system that the analysis asks about; NULL: it names none, or there is an error. */
const char *nh_request_subject(const nh_request *request, nh_error *error);

#endif
