/* faults_preload: a library for LD_PRELOAD that lets one allocation or system call of a program fail, or sends it a signal before one.
 *
 * What is to happen stands in a file that the test shares ($NHSYM_FAULT, a record of faults.h); it also counts what there was.  Programs that the
 * program starts are left alone. */
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <spawn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "faults.h"

static fault *shared;

void *__libc_malloc(size_t), *__libc_calloc(size_t, size_t), *__libc_realloc(void *, size_t), *__libc_memalign(size_t, size_t);

__attribute__((constructor)) static void begin(void)
{
    const char *path = getenv("NHSYM_FAULT");
    int file = path ? open(path, O_RDWR | O_CLOEXEC) : -1;
    void *got = file >= 0 ? mmap(NULL, sizeof(fault), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0) : MAP_FAILED;
    unsetenv("LD_PRELOAD");
    if (got != MAP_FAILED) __atomic_store_n(&shared, got, __ATOMIC_RELEASE);
}

static int strikes(fault_kind kind)
{
    fault *f = __atomic_load_n(&shared, __ATOMIC_ACQUIRE);
    if (!f) return 0;
    long n = __atomic_add_fetch(&f->count[kind], 1, __ATOMIC_RELAXED);
    if (f->kind != kind || n < f->at || n >= f->at + f->times) return 0;
    __atomic_store_n(&f->struck, 1, __ATOMIC_RELAXED);
    return 1;
}

/* ---- allocations ---- */

#define ALLOCATION(call) (strikes(FAULT_MEMORY) ? (errno = ENOMEM, NULL) : (call))
void *malloc(size_t n) { return ALLOCATION(__libc_malloc(n)); }
void *calloc(size_t n, size_t size) { return ALLOCATION(__libc_calloc(n, size)); }
void *realloc(void *old, size_t n) { return ALLOCATION(__libc_realloc(old, n)); }
void *aligned_alloc(size_t alignment, size_t n) { return ALLOCATION(__libc_memalign(alignment, n)); }
void *memalign(size_t alignment, size_t n) { return ALLOCATION(__libc_memalign(alignment, n)); }
int posix_memalign(void **out, size_t alignment, size_t n)
{
    if (strikes(FAULT_MEMORY)) return ENOMEM;
    *out = __libc_memalign(alignment, n);
    return *out ? 0 : ENOMEM;
}

/* ---- calls ---- */

#define NEXT(name) static __typeof__(name) *next; if (!next) *(void **)&next = dlsym(RTLD_NEXT, #name)
/* One that writes, and before which a signal may come. */
static int fails_writing(int reason)
{
    if (strikes(FAULT_SIGNAL)) kill(getpid(), shared->signal);
    if (!strikes(FAULT_CALL)) return 0;
    errno = reason;
    return 1;
}

static int fails(int reason)
{
    if (!strikes(FAULT_CALL)) return 0;
    errno = reason;
    return 1;
}

static int opened(const char *name, int flags, mode_t mode)
{
    int (*next)(const char *, int, ...);
    *(void **)&next = dlsym(RTLD_NEXT, "open");
    if (flags & O_CREAT ? fails_writing(ENOSPC) : fails(EIO)) return -1;
    return next(name, flags, mode);
}

#define OPEN(name)                              \
    int name(const char *path, int flags, ...)  \
    {                                           \
        va_list list;                           \
        va_start(list, flags);                  \
        mode_t mode = va_arg(list, mode_t);     \
        va_end(list);                           \
        return opened(path, flags, mode);       \
    }
OPEN(open)
OPEN(open64)

FILE *fopen(const char *path, const char *mode)
{
    NEXT(fopen);
    return *mode == 'r' ? (fails(EIO) ? NULL : next(path, mode)) : fails_writing(ENOSPC) ? NULL : next(path, mode);
}

ssize_t write(int file, const void *bytes, size_t n)
{
    NEXT(write);
    return fails_writing(ENOSPC) ? -1 : next(file, bytes, n);
}

#define WRITER(name, reason, arguments, ...) \
    int name arguments                       \
    {                                        \
        NEXT(name);                          \
        return fails_writing(reason) ? -1 : next(__VA_ARGS__); \
    }
WRITER(fsync, EIO, (int file), file)
int rename(const char *from, const char *to)
{
    NEXT(rename);
    static unsigned renames;
    if (shared && shared->pause) usleep((unsigned)shared->pause * ((5 * renames++ + 3 * (unsigned)getpid()) % 7));
    return fails_writing(EIO) ? -1 : next(from, to);
}
WRITER(link, EPERM, (const char *from, const char *to), from, to)
WRITER(unlink, EIO, (const char *path), path)
WRITER(rmdir, EIO, (const char *path), path)
WRITER(mkdir, ENOSPC, (const char *path, mode_t mode), path, mode)
WRITER(fchmod, EPERM, (int file, mode_t mode), file, mode)
WRITER(flock, ENOLCK, (int file, int how), file, how)
WRITER(unlinkat, EIO, (int folder, const char *path, int flags), folder, path, flags)

char *mkdtemp(char *name)
{
    NEXT(mkdtemp);
    return fails_writing(ENOSPC) ? NULL : next(name);
}

pid_t fork(void)
{
    NEXT(fork);
    return fails(EAGAIN) ? -1 : next();
}

int close(int file)
{
    NEXT(close);
    int result = next(file);
    return fails(EIO) ? -1 : result;
}

int posix_spawnp(pid_t *pid, const char *file, const posix_spawn_file_actions_t *actions, const posix_spawnattr_t *attributes, char *const argument[], char *const around[])
{
    NEXT(posix_spawnp);
    return fails(EAGAIN) ? EAGAIN : next(pid, file, actions, attributes, argument, around);
}

int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*work)(void *), void *argument)
{
    NEXT(pthread_create);
    return fails(EAGAIN) ? EAGAIN : next(thread, attributes, work, argument);
}
