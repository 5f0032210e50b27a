/* recovery: where a thread continues after an allocation has failed.
 *
 * A function of nhsym.h runs its work by nh_recovery_run.  When an allocation of that thread fails, the work is given
 * up and the run returns false.  What the work had allocated is lost; but what it had noted by nh_undo_add is undone
 * first: locks are released, files closed, threads joined.  A thread that has given up work in the middle may have left
 * what FLINT keeps for this thread in disorder (nh_recovery_lost): it must not call FLINT again. */
#ifndef NH_RECOVERY_H
#define NH_RECOVERY_H

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Part of whatever must not stay as it is. */
typedef struct nh_undo {
    void (*undo)(struct nh_undo *undo); /* works without memory */
    struct nh_undo *before;
    uint64_t        number;
} nh_undo;

/* False: memory ended before the job did. */
bool nh_recovery_run(void (*job)(void *), void *data);
/* Is this thread within such a run?  Was one of its runs given up? */
bool nh_recovery_here(void);
bool nh_recovery_lost(void);
/* What the last run that was given up wanted, in bytes; SIZE_MAX: more than can be counted. */
size_t nh_recovery_wanted(void);
/* Gives up the innermost run of this thread; returns if there is none. */
void nh_recovery_go(size_t wanted);

/* By the same thread, in any order. */
void nh_undo_add(nh_undo *undo);
void nh_undo_remove(nh_undo *undo);

/* A lock that is held while memory is allocated. */
typedef struct {
    nh_undo          undo; /* first */
    pthread_mutex_t *lock;
} nh_held;

void nh_hold(nh_held *held, pthread_mutex_t *lock);
void nh_release(nh_held *held);

#endif
