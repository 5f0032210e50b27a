/* versions: versions of libraries and machine, so that a run can be repeated. */
#ifndef NH_VERSIONS_H
#define NH_VERSIONS_H

#include <stddef.h>

typedef struct {
    const char *name, *version;
} nh_version;

/* The libraries, in order; name is NULL after the last. */
nh_version nh_version_of(size_t index);
/* Operating system, release and processor: "Linux 6.1 x86_64". */
const char *nh_versions_machine(void);

#endif
