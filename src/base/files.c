#include "base/files.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/context_internal.h"
#include "base/memory.h"
#include "base/recovery.h"
#include "base/text.h"

void nh_files_begin(void) { nh_context_here()->files_kept = true; }

void nh_files_end(void)
{
    nh_context *c = nh_context_here();
    nh_known_files_free(c->file);
    c->file = NULL;
    c->files_kept = false;
}

void nh_files_swap(nh_file_store *store)
{
    nh_context *c = nh_context_here();
    nh_known_file *mine = c->file;
    c->file = *store;
    *store = mine;
}

void nh_files_free(nh_file_store store) { nh_known_files_free(store); }

/* Reads the whole stream, or one byte more than is allowed. */
static char *slurp(FILE *file, size_t limit, size_t *length)
{
    char *text = NULL;
    size_t capacity = 0, got;
    *length = 0;
    do {
        nh_grow(&text, &capacity, *length + 4096, 1);
        size_t room = capacity - *length, left = limit + 1 - *length;
        got = fread(text + *length, 1, room < left ? room : left, file);
        *length += got;
    } while (got > 0);
    return text;
}

typedef struct {
    nh_undo undo; /* first */
    FILE *file;
} open_file;

static void close_it(nh_undo *undo) { fclose(((open_file *)undo)->file); }

static char *from_file(const char *path, size_t limit, size_t *length, nh_error *error)
{
    struct stat status;
    FILE *file = fopen(path, "rb");
    if (!file) {
        nh_fail(error, errno == ENOMEM ? NH_LIMIT : NH_INPUT, path, "this file cannot be opened: %s", strerror(errno));
        return NULL;
    }
    open_file opened = {.undo.undo = close_it, .file = file};
    nh_undo_add(&opened.undo);
    bool folder = fstat(fileno(file), &status) == 0 && S_ISDIR(status.st_mode);
    if (folder) nh_fail(error, NH_INPUT, path, "this is a directory, not a file");
    char *text = folder ? NULL : slurp(file, limit, length);
    if (text && ferror(file)) {
        nh_fail(error, errno == ENOMEM ? NH_LIMIT : NH_INPUT, path, "this file cannot be read: %s", strerror(errno));
        nh_free(text);
        text = NULL;
    }
    nh_undo_remove(&opened.undo);
    fclose(file);
    return text;
}

static char *copy_of(const char *bytes, size_t length)
{
    char *out = nh_alloc_array(length + 1, 1);
    if (length) memcpy(out, bytes, length);
    return out;
}

static void keep(nh_context *c, const char *path, const char *text, size_t length)
{
    nh_known_file *f = nh_alloc(sizeof *f);
    *f = (nh_known_file){
        .next = c->file, .path = copy_of(path, strlen(path)), .text = copy_of(text, length), .length = length};
    c->file = f;
}

void nh_files_add(const char *path, const char *text, size_t length)
{
    nh_context *c = nh_context_here();
    nh_held held;
    c->files_kept = true;
    nh_hold(&held, &c->files_lock);
    keep(c, path, text, length);
    nh_release(&held);
}

uint64_t nh_files_fingerprint(void)
{
    nh_context *c = nh_context_here();
    nh_held held;
    uint64_t h = 0;
    nh_hold(&held, &c->files_lock);
    for (const nh_known_file *f = c->file; f; f = f->next) h = nh_text_fingerprint(h, f->text, f->length);
    nh_release(&held);
    return h;
}

char *nh_files_read(const char *path, size_t limit, size_t *length, nh_error *error)
{
    nh_context *c = nh_context_here();
    nh_held held;
    if (!c->files_kept) return from_file(path, limit, length, error);
    /* held also while a file is read: two threads that want the same file get one text */
    nh_hold(&held, &c->files_lock);
    const nh_known_file *f = c->file;
    while (f && strcmp(f->path, path)) f = f->next;
    char *text = f ? copy_of(f->text, f->length) : from_file(path, limit, length, error);
    if (f) *length = f->length;
    else if (text) keep(c, path, text, *length);
    nh_release(&held);
    return text;
}

static bool other(const char *path, nh_error *error)
{
    nh_fail(error, NH_INPUT, path, "this is no file that nhsym wrote here, but a link, a device or something else");
    return nh_error_hint(error, "remove it, or give another folder");
}

bool nh_files_regular(const char *path, nh_error *error)
{
    struct stat info;
    return lstat(path, &info) || S_ISREG(info.st_mode) || other(path, error);
}

char *nh_files_own(const char *path, nh_error *error)
{
    static const size_t limit = 100000000;
    struct stat info;
    size_t length = 0;
    if (!nh_files_regular(path, error)) return NULL;
    int number = open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    FILE *file = number >= 0 && !fstat(number, &info) && S_ISREG(info.st_mode) ? fdopen(number, "rb") : NULL;
    if (!file) {
        if (number >= 0) close(number);
        return NULL;
    }
    char *text = slurp(file, limit, &length);
    bool good = !ferror(file) && length <= limit && !memchr(text, 0, length);
    fclose(file);
    if (good) {
        char *ended = nh_realloc_array(text, length + 1, 1);
        ended[length] = 0;
        return ended;
    }
    nh_free(text);
    return NULL;
}
