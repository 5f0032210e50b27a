/* recovery: where a thread continues after an allocation has failed.
 *
 * A function of nhsym.h runs its work by nh_recovery_run.  When an allocation of that thread fails, the work is given
 * up and the run returns false.  The memory of the work is lost; but every nh_undo that it added is called first, which
 * releases locks, closes files and joins threads.  A thread that has given up work in the middle may have left FLINT's
 * data of this thread in disorder (nh_recovery_lost): it must not call FLINT again. */
#ifndef NH_RECOVERY_H
#define NH_RECOVERY_H

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What must be undone when the work is given up; embed it in the record concerned. */
typedef struct nh_undo {
    void (*undo)(struct nh_undo *undo); /* must not allocate */
    struct nh_undo *before;
    uint64_t number;
} nh_undo;

/* Runs job(data).  False: an allocation failed, and the job was given up. */
bool nh_recovery_run(void (*job)(void *), void *data);
/* nh_recovery_here: is this thread within such a run? nh_recovery_lost: was one of its runs given up? */
bool nh_recovery_here(void);
bool nh_recovery_lost(void);
/* How many bytes the failed allocation of the last run that was given up wanted; SIZE_MAX: more than can be counted. */
size_t nh_recovery_wanted(void);
/* Gives up the innermost run of this thread; returns if there is none. */
void nh_recovery_go(size_t wanted);

/* Adds and removes an undo, both by the same thread; they may be removed in any order. */
void nh_undo_add(nh_undo *undo);
void nh_undo_remove(nh_undo *undo);

/* A mutex that is held while memory is allocated: nh_hold locks it, nh_release unlocks it, and so does a run that is
 * given up. */
typedef struct {
    nh_undo undo; /* first */
    pthread_mutex_t *lock;
} nh_held;

void nh_hold(nh_held *held, pthread_mutex_t *lock);
void nh_release(nh_held *held);

#endif
