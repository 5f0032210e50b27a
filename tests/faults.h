/* faults: the record that a test shares with the library that lets allocations and calls fail (faults_preload.c). */
#ifndef NH_TESTS_FAULTS_H
#define NH_TESTS_FAULTS_H

typedef enum { FAULT_NONE, FAULT_MEMORY, FAULT_CALL, FAULT_SIGNAL, FAULT_KINDS } fault_kind;

typedef struct {
    long kind, at, times; /* the at-th of this kind, and those after it, so many */
    int signal, struck, pause; /* number; did it happen; microseconds, some of them before each rename */
    long count[FAULT_KINDS];
} fault;

#endif
