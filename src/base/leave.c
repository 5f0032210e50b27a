#include "base/leave.h"

#include <pthread.h>
#include <stddef.h>
#include <unistd.h>

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static nh_leaving *first;

void nh_leave_hold(void) { pthread_mutex_lock(&lock); }
void nh_leave_release(void) { pthread_mutex_unlock(&lock); }

void nh_leave_add(nh_leaving *leaving)
{
    leaving->process = (long)getpid();
    leaving->next = first;
    leaving->link = &first;
    if (first) first->link = &leaving->next;
    first = leaving;
}

void nh_leave_remove(nh_leaving *leaving)
{
    *leaving->link = leaving->next;
    if (leaving->next) leaving->next->link = leaving->link;
}

void nh_leave_now(void)
{
    nh_leave_hold();
    for (nh_leaving *l = first; l; l = l->next)
        if (l->process == (long)getpid()) l->undo(l);
}
