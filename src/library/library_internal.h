/* library_internal: what the files of the public interface (nhsym.h) share. */
#ifndef NH_LIBRARY_INTERNAL_H
#define NH_LIBRARY_INTERNAL_H

#include "base/context.h"
#include "base/files.h"
#include "base/memory.h"
#include "base/option.h"
#include "motion/method.h"
#include "system/embedding.h"

struct nh_problem {
    nh_context  *context;
    nh_context  *before; /* of the thread, while a computation goes on */
    nh_arena    *arena;
    nh_question  question; /* its strings are in the arena */
    const char  *system_path, *analysis_path; /* names of the texts where they are given as such */
    size_t       settings;
    nh_setting  *setting;
    nh_chart_choice chart;
    nh_options   options;
    const nh_method *method;
    bool         seed_given, limited, samples_given, tolerance_given;
    nh_file_store files; /* that it has read */
    nh_system   *system;
};

/* A computation in the problem's context begins and ends: its files, its time limit. */
void nh_problem_enter(nh_problem *problem);
void nh_problem_leave(nh_problem *problem);

#endif
