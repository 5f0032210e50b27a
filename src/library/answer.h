/* answer: one way from a request to its documents, for the command line and for nhsym.h: a row for each command that
 * computes something. */
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

/* A row; what a command does not have is NULL. */
typedef struct {
    const char *name;
    bool analysis; /* it reads an analysis file */
    /* Are the words of the request known?  Before anything is written. */
    bool (*check)(const nh_request *request, nh_error *error);
    /* Fills the parts.  False with a message: there is no answer. */
    bool (*create)(nh_answer *answer, nh_error *error);
    void (*free)(nh_answer *answer);
    void (*write)(const nh_answer *answer, nh_pen_style style, nh_text *out); /* the document */
    char *(*json)(const nh_answer *answer);                                   /* a heap string (nh_free) */
    /* A table or code, which is printed in the place of the document; false: this request wants the document. */
    bool (*print)(const nh_answer *answer, nh_text *out);
    /* Comma-separated values; their name in the folder of -o, where they always stand. */
    void (*table)(const nh_answer *answer, nh_text *csv);
    const char *table_name;
    size_t (*files)(const nh_answer *answer, nh_answer_file file[NH_ANSWER_FILES]); /* further ones of the folder */
    void (*picture)(const nh_answer *answer, nh_text *svg);
    /* Lines for standard error; printed: the table is printed or stands in a file. */
    void (*notes)(const nh_answer *answer, bool verbose, bool printed, nh_text *out);
    /* The exit code, with a message where the answer is not all that was asked for. */
    int (*code)(const nh_answer *answer, nh_error *error);
} nh_answer_kind;

struct nh_answer {
    const nh_answer_kind *kind;
    const nh_request *request;
    nh_run run;                  /* for its documents */
    void *part[NH_ANSWER_PARTS]; /* results of src/commands, or NULL */
    bool failed;                 /* a message says why it ends early: its files do not take their places */
    /* of a scan that several processes share: only words are written of a chunk, and nothing by other processes */
    bool words_only, silent;
};

/* NULL: no command that computes has this name. */
const nh_answer_kind *nh_answer_kind_of(const char *command);
/* The answer to a request whose files are found; the request must outlive it. */
bool nh_answer_create(nh_answer *answer, const nh_request *request, nh_error *error);
/* That the computation was ended before there was an answer: the system, and the step at which that was.  False: not
   even the system is known. */
bool nh_answer_unfinished(nh_answer *answer, const nh_request *request);
void nh_answer_free(nh_answer *answer);
/* What the algebra keeps for this thread is given back. */
void nh_answer_cleanup(void);

/* The next figure of a page, a file of its own; false after the last.  Does a text begin as the figure of that number
   does, from 1? */
bool nh_answer_figure(const char **page, const char **figure, size_t *length);
bool nh_answer_is_figure(const char *text, size_t number);

#endif
