/* sweep: many independent items, computed in units that outlive the process.
 *
 * An item is a number from 0 on; its answer is one line of text, which depends on nothing but the number. Items that
 * follow one another make a unit; a finished unit is a file in a folder, written completely or not at all. So a sweep
 * can be ended at any moment and continued, on any number of processes and machines that share the folder: the lines
 * are the same. What a unit is depends on `per_unit` alone, and the lines do not depend on it.
 *
 * A unit file begins with the fingerprint of the sweep and ends with a line that says that it is complete, with a sum
 * of all before; a file that was changed since is computed again.  A unit that
 * was interrupted leaves the lines that it has in a file that ends in `.part`. */
#ifndef NH_SWEEP_H
#define NH_SWEEP_H

#include "base/memory.h"
#include "base/text.h"
#include "base/error.h"

/* Processes of one run on many machines: the rank of this process, how many there are, next() returns the next number
 * that no process has taken since the last meeting, and meet() waits until all processes call it. */
typedef struct {
    size_t rank, size;
    size_t (*next)(void *context);
    void (*meet)(void *context);
    void *context;
} nh_team;

typedef struct {
    const char *folder;      /* folder of the unit files; it exists */
    const char *name;        /* the beginning of their names */
    const char *fingerprint; /* one line: what the answers depend on */
    const char *doing;       /* for progress reports */
    size_t items, per_unit;
    size_t chunk, chunks;       /* only units number chunk, chunk + chunks, ..; 0, 1: all */
    size_t workers;             /* processes; 1: this one alone */
    const nh_team *team;        /* or NULL */
    void (*begin_worker)(void); /* called first in a new process; may be NULL */
    /* Appends the line, without its end. False: interrupted (base/progress.h), there is no answer. */
    bool (*item)(void *context, size_t index, nh_text *line);
    void *context;
} nh_sweep;

/* The state of the chunk afterwards. */
typedef struct {
    size_t units, finished; /* number of units, and how many are finished */
    size_t deaths;          /* workers that ended before their work did */
    char death[120];        /* how the last of them ended */
} nh_sweep_state;

/* Computes the units that are missing.  False: a file could not be written; finished units are kept. */
bool nh_sweep_run(const nh_sweep *sweep, nh_sweep_state *state, nh_error *error);
/* The lines of all items of the chunk, in the arena; NULL where there is none yet.  Returns the number of items. */
size_t nh_sweep_read(const nh_sweep *sweep, nh_arena *arena, const char **line);

/* nh_sweep_hold marks that this process works in the folder; *hold is a handle (-1 where the file system cannot tell).
 * False: something else than a file has the name of the lock.  A process that is alone there (nh_sweep_is_alone) may
 * remove unfinished files of ended processes whose names
 * begin with `name` (nh_sweep_tidy). */
bool nh_sweep_hold(const char *folder, int *hold, nh_error *error);
bool nh_sweep_is_alone(int hold);
void nh_sweep_tidy(const char *folder, const char *name);
void nh_sweep_release(int hold);

#endif
