/* library_internal: what the files of the public interface (nhsym.h) share. */
#ifndef NH_LIBRARY_INTERNAL_H
#define NH_LIBRARY_INTERNAL_H

#include "base/context.h"
#include "base/files.h"
#include "library/request.h"

struct nh_problem {
    nh_context  *context;
    nh_context  *before; /* of the thread, while a computation goes on */
    nh_arena    *arena;
    nh_request   request; /* of every computation; its strings are in the arena */
    nh_file_store files; /* that it has read */
    nh_system   *system;
};

/* A computation in the problem's context begins and ends: its files, its time limit. */
void nh_problem_enter(nh_problem *problem);
void nh_problem_leave(nh_problem *problem);

#endif
