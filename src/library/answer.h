/* answer: one way from a request to its documents, for the command line and for nhsym.h.  The table in
 * answer_internal.h has a row for each command that computes something. */
#ifndef NH_LIBRARY_ANSWER_H
#define NH_LIBRARY_ANSWER_H

#include "document/form.h"
#include "document/provenance.h"
#include "library/request.h"

typedef struct nh_answer nh_answer;

/* A file of the folder of -o. */
typedef struct {
    const char *name; /* "events.csv" */
    nh_text text;
} nh_answer_file;
enum { NH_ANSWER_FILES = 2, NH_ANSWER_PARTS = 3 };

/* A row of the table; members that a command does not have are NULL. */
typedef struct {
    const char *name;
    bool analysis; /* it reads an analysis file */
    /* Are the words of the request valid?  Called before anything is written. */
    bool (*check)(const nh_request *request, nh_error *error);
    /* Fills the parts.  False with a message: there is no answer. */
    bool (*create)(nh_answer *answer, nh_error *error);
    void (*free)(nh_answer *answer);
    void (*write)(const nh_answer *answer, nh_pen_style style, nh_text *out); /* the document */
    char *(*json)(const nh_answer *answer);                                   /* a heap string (nh_free) */
    /* A table or code, which is printed in the place of the document; false: this request wants the document. */
    bool (*print)(const nh_answer *answer, nh_text *out);
    bool tabular; /* what it prints is a table, which a terminal shows with less */
    /* Comma-separated values, and their file name in the folder of -o, where they are always written. */
    void (*table)(const nh_answer *answer, nh_text *csv);
    const char *table_name;
    size_t (*files)(const nh_answer *answer, nh_answer_file file[NH_ANSWER_FILES]); /* further ones of the folder */
    void (*picture)(const nh_answer *answer, nh_text *svg);
    /* Writes lines to standard error; printed: the table is printed or written to a file. */
    void (*notes)(const nh_answer *answer, bool verbose, bool printed, nh_text *out);
    /* The exit code, with a message where the answer is incomplete or negative. */
    int (*code)(const nh_answer *answer, nh_error *error);
} nh_answer_kind;

struct nh_answer {
    const nh_answer_kind *kind;
    const nh_request *request;
    nh_run run;                  /* for its documents */
    void *part[NH_ANSWER_PARTS]; /* results of src/commands, or NULL */
    bool failed;                 /* a message says why it ended early: its files do not replace earlier ones */
    /* of a scan that several processes share: a chunk has only words, and other processes write nothing */
    bool words_only, silent;
};

/* NULL: no command that computes has this name. */
const nh_answer_kind *nh_answer_kind_of(const char *command);
/* The answer to a request whose files are found; the request must outlive it. */
bool nh_answer_create(nh_answer *answer, const nh_request *request, nh_error *error);
/* Says that the computation was ended before there was an answer: the system, and the step that was interrupted.
 * False: not even the system is known. */
bool nh_answer_unfinished(nh_answer *answer, const nh_request *request);
void nh_answer_free(nh_answer *answer);
/* Frees compiled machine code, and the memory that FLINT keeps for this thread. */
void nh_answer_cleanup(void);

/* The next figure of a page, a file of its own; false after the last.  Does a text begin as the figure of that number
   does, from 1? */
bool nh_answer_figure(const char **page, const char **figure, size_t *length);
bool nh_answer_is_figure(const char *text, size_t number);

#endif
