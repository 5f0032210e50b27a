/* leave: removes temporary files, folders and child processes when the process ends early. */
#ifndef NH_LEAVE_H
#define NH_LEAVE_H

/* One temporary thing: embed it in the record of the file, folder or process. */
typedef struct nh_leaving {
    void (*undo)(struct nh_leaving *leaving); /* called from any thread; works without memory */
    struct nh_leaving *next, **link;
} nh_leaving;

/* Between these the process does not end at once: files take their places together.  Short, and not nested. */
void nh_leave_hold(void);
void nh_leave_release(void);

/* Between a hold and its release: add when the thing is made, remove when it is gone or has its place. */
void nh_leave_add(nh_leaving *leaving);
void nh_leave_remove(nh_leaving *leaving);

/* Undo everything; the caller ends the process then.  Other threads that call nh_leave_hold wait until it ends. */
void nh_leave_now(void);

#endif
