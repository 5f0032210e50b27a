/* memory: see memory.h. */
#include "base/memory.h"

#include <fcntl.h>
#include <math.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/recovery.h"

static nh_memory_handler *the_handler;
static atomic_size_t before_failure = SIZE_MAX; /* allocations */

void nh_memory_set_handler(nh_memory_handler *handler) { the_handler = handler; }

/* A handler that returns would leave its caller with a null pointer: abort rather than that. */
void nh_memory_ended(size_t wanted)
{
    nh_recovery_go(wanted);
    if (the_handler) the_handler(wanted);
    abort();
}

void *nh_memory_got(void *pointer)
{
    if (!pointer) nh_memory_ended(0);
    return pointer;
}

size_t nh_memory_fail_after(size_t allocations) { return atomic_exchange(&before_failure, allocations); }

/* Is this the allocation that a test wants to fail? */
static bool to_fail(void)
{
    if (atomic_load_explicit(&before_failure, memory_order_relaxed) == SIZE_MAX) return false;
    return atomic_fetch_sub(&before_failure, 1) == 0;
}

static size_t product(size_t count, size_t size)
{
    size_t bytes;
    if (__builtin_mul_overflow(count, size, &bytes)) nh_memory_ended(SIZE_MAX);
    return bytes ? bytes : 1;
}

void *nh_alloc(size_t size) { return nh_alloc_array(1, size); }

void *nh_alloc_array(size_t count, size_t size)
{
    size_t bytes = product(count, size);
    void *memory = to_fail() ? NULL : calloc(1, bytes);
    if (!memory) nh_memory_ended(bytes);
    return memory;
}

void *nh_alloc_bytes(size_t size)
{
    void *memory = to_fail() ? NULL : malloc(size ? size : 1);
    if (!memory) nh_memory_ended(size);
    return memory;
}

void *nh_realloc_array(void *old, size_t count, size_t size)
{
    size_t bytes = product(count, size);
    void *memory = to_fail() ? NULL : realloc(old, bytes);
    if (!memory) nh_memory_ended(bytes);
    return memory;
}

void nh_free(void *pointer) { free(pointer); }

char *nh_strdup(const char *text)
{
    size_t size = strlen(text) + 1;
    return memcpy(nh_alloc(size), text, size);
}

/* The second number of /proc/self/statm counts resident pages (proc(5)). */
double nh_memory_in_use(void)
{
    char text[100];
    int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    ssize_t length = file >= 0 ? read(file, text, sizeof text - 1) : -1;
    if (file >= 0) close(file);
    text[length > 0 ? length : 0] = 0;
    const char *pages = strchr(text, ' ');
    return pages ? strtod(pages, NULL) * (double)sysconf(_SC_PAGESIZE) : 0;
}

/* The number that a file begins with; infinite where there is none, as for "max". */
static double number_in(const char *path)
{
    char text[100], *end = text;
    int file = open(path, O_RDONLY | O_CLOEXEC);
    ssize_t length = file >= 0 ? read(file, text, sizeof text - 1) : -1;
    if (file >= 0) close(file);
    text[length > 0 ? length : 0] = 0;
    double value = strtod(text, &end);
    return end > text ? value : INFINITY;
}

double nh_memory_of_group(const char *list, const char *root)
{
    double least = INFINITY;
    char line[600], path[1000];
    FILE *file = fopen(list, "re");
    while (file && fgets(line, sizeof line, file)) {
        char *kind = strchr(line, ':'), *group = kind ? strchr(kind + 1, ':') : NULL;
        const char *memory = strstr(line, "memory");
        bool one = group && group == kind + 1, other = group && memory && memory < group;
        if (!one && !other) continue;
        line[strcspn(line, "\n")] = 0;
        group++;
        for (char *cut = group + strlen(group); cut; cut = strrchr(group, '/')) { /* the group, and those around it */
            *cut = 0;
            snprintf(path, sizeof path, "%s%s%s/%s", root, one ? "" : "/memory", group,
                     one ? "memory.max" : "memory.limit_in_bytes");
            least = fmin(least, number_in(path));
        }
    }
    if (file) fclose(file);
    return least;
}

double nh_memory_of_machine(void)
{
    double pages = (double)sysconf(_SC_PHYS_PAGES), size = (double)sysconf(_SC_PAGESIZE);
    double group = nh_memory_of_group("/proc/self/cgroup", "/sys/fs/cgroup");
    return pages > 0 && size > 0 ? fmin(pages * size, group) : isfinite(group) ? group : 0;
}

/* `array_pointer` is a `T **`; memcpy reads and writes it without pretending that it is a `void **`. */
void nh_grow(void *array_pointer, size_t *capacity, size_t need, size_t size)
{
    if (need <= *capacity) return;
    size_t wanted = *capacity > SIZE_MAX / 2 ? need : 2 * *capacity;
    if (wanted < 8) wanted = 8;
    if (wanted < need) wanted = need;
    void *array;
    memcpy(&array, array_pointer, sizeof array);
    array = nh_realloc_array(array, wanted, size);
    memcpy(array_pointer, &array, sizeof array);
    *capacity = wanted;
}

/* An arena is a list of blocks; the first is the one being filled.  Large requests get a block of their own behind
 * it, so that they do not waste its rest.  The first block is small, because most arenas hold little; each further one
 * is larger. */
enum { ALIGNMENT = 16, FIRST_BLOCK = 960, BLOCK_SIZE = 16384, LARGE = BLOCK_SIZE / 4 };

typedef struct block block;
struct block {
    block *next;
    _Alignas(ALIGNMENT) unsigned char memory[];
};

struct nh_arena {
    block *first;
    size_t used, capacity; /* of the first block */
};

nh_arena *nh_arena_create(void) { return nh_alloc(sizeof(nh_arena)); }

void nh_arena_free(nh_arena *arena)
{
    if (!arena) return;
    for (block *each = arena->first, *next; each; each = next) {
        next = each->next;
        nh_free(each);
    }
    nh_free(arena);
}

static block *new_block(size_t size)
{
    if (size > SIZE_MAX - sizeof(block)) nh_memory_ended(SIZE_MAX);
    return nh_alloc(sizeof(block) + size);
}

static void *alloc_large(nh_arena *arena, size_t size)
{
    block *own = new_block(size);
    if (arena->first) {
        own->next = arena->first->next;
        arena->first->next = own;
    } else {
        arena->first = own; /* used == capacity == 0: the block is full from the start */
    }
    return own->memory;
}

void *nh_arena_alloc(nh_arena *arena, size_t size)
{
    if (size > LARGE) return alloc_large(arena, size);
    size = size ? (size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT : ALIGNMENT;
    if (size > arena->capacity - arena->used) {
        size_t room = arena->capacity ? 4 * arena->capacity : FIRST_BLOCK;
        room = room < size ? 4 * size : room;
        room = room > BLOCK_SIZE ? BLOCK_SIZE : room;
        block *fresh = new_block(room);
        fresh->next = arena->first;
        arena->first = fresh;
        arena->used = 0;
        arena->capacity = room;
    }
    void *memory = arena->first->memory + arena->used;
    arena->used += size;
    return memory;
}

char *nh_arena_strndup(nh_arena *arena, const char *text, size_t length)
{
    if (length == SIZE_MAX) nh_memory_ended(SIZE_MAX);
    char *copy = nh_arena_alloc(arena, length + 1);
    if (length) memcpy(copy, text, length);
    return copy;
}

char *nh_arena_strdup(nh_arena *arena, const char *text) { return nh_arena_strndup(arena, text, strlen(text)); }

char *nh_arena_printf(nh_arena *arena, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    char *text = nh_arena_alloc(arena, length < 0 ? 1 : (size_t)length + 1);
    if (length > 0) vsnprintf(text, (size_t)length + 1, format, again);
    va_end(again);
    return text;
}
