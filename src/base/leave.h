/* leave: removes temporary files, folders and child processes when the process ends early. */
#ifndef NH_LEAVE_H
#define NH_LEAVE_H

/* One temporary thing: embed it in the record of the file, folder or process. */
typedef struct nh_leaving {
    long process;                             /* that made it: a copy of the process leaves it alone */
    void (*undo)(struct nh_leaving *leaving); /* called from any thread; works without memory */
    struct nh_leaving *next, **link;
} nh_leaving;

/* Between hold and release the process does not end at once, so that several files take their places together.  Keep it
 * short; holds do not nest. */
void nh_leave_hold(void);
void nh_leave_release(void);

/* Call these between a hold and its release: add when the temporary thing is made, remove when it is gone or has its
 * place. */
void nh_leave_add(nh_leaving *leaving);
void nh_leave_remove(nh_leaving *leaving);

/* Undoes everything; the caller then ends the process.  Other threads that call nh_leave_hold wait until it ends. */
void nh_leave_now(void);

#endif
