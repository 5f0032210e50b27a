#include "base/recovery.h"

#include <setjmp.h>

typedef struct recovery recovery;
struct recovery {
    jmp_buf at;
    recovery *around;
    uint64_t number; /* number of the last undo that was added before the run */
};

static _Thread_local recovery *innermost;
static _Thread_local nh_undo *last;
static _Thread_local uint64_t numbers;
static _Thread_local size_t bytes;
static _Thread_local bool lost;

bool nh_recovery_run(void (*job)(void *), void *data)
{
    recovery r = {.around = innermost, .number = numbers};
    innermost = &r;
    if (setjmp(r.at)) return false;
    job(data);
    innermost = r.around;
    return true;
}

bool nh_recovery_here(void) { return innermost != NULL; }
bool nh_recovery_lost(void) { return lost; }
size_t nh_recovery_wanted(void) { return bytes; }

void nh_recovery_go(size_t wanted)
{
    recovery *r = innermost;
    if (!r) return;
    while (last && last->number > r->number) {
        nh_undo *u = last;
        last = u->before;
        u->undo(u);
    }
    innermost = r->around;
    bytes = wanted;
    lost = true;
    longjmp(r->at, 1);
}

void nh_undo_add(nh_undo *undo)
{
    undo->before = last;
    undo->number = ++numbers;
    last = undo;
}

void nh_undo_remove(nh_undo *undo)
{
    nh_undo **at = &last;
    while (*at && *at != undo) at = &(*at)->before;
    if (*at) *at = undo->before;
}

/* ---- locks ---- */

static void unlock(nh_undo *undo) { pthread_mutex_unlock(((nh_held *)undo)->lock); }

void nh_hold(nh_held *held, pthread_mutex_t *lock)
{
    held->undo.undo = unlock;
    held->lock = lock;
    pthread_mutex_lock(lock);
    nh_undo_add(&held->undo);
}

void nh_release(nh_held *held)
{
    nh_undo_remove(&held->undo);
    pthread_mutex_unlock(held->lock);
}
