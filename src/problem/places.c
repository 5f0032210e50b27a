/* places: see places.h. */
#include "problem/places.h"

#include <dirent.h>
#include <dlfcn.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "base/text.h"
#include "system/deck.h"

enum { most_places = 64 };

/* The file that this code runs from: the shared library, or the program. */
static char *file_of_code(nh_arena *arena)
{
    Dl_info info;
    void *here = (void *)(uintptr_t)nh_places_look;
    if (dladdr(here, &info) && info.dli_fname && info.dli_fname[0] == '/' && strstr(info.dli_fname, ".so"))
        return nh_arena_strdup(arena, info.dli_fname);
    char path[4096];
    ssize_t n = readlink("/proc/self/exe", path, sizeof path - 1);
    return n > 0 ? nh_arena_strndup(arena, path, (size_t)n) : NULL;
}

/* Is a file of this kind, in a folder that holds both kinds? An unreadable
 * file counts as the requested kind, and its errors are reported. */
static bool is_of_kind(const char *file, const char *kind)
{
    static const char *const of_systems[] = {"coordinates", "lagrangian", "bodies", "include", "urdf"};
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_deck *deck = nh_deck_read(file, &ignored);
    bool system = false, analysis = !strcmp(kind, "analyses"),
         readable = deck && nh_deck_root(deck)->kind == NH_DECK_MAP;
    for (size_t i = 0; readable && i < sizeof of_systems / sizeof *of_systems; i++)
        system |= nh_deck_get(nh_deck_root(deck), of_systems[i]) != NULL;
    nh_deck_free(deck);
    return !readable || system != analysis;
}

typedef struct {
    const char *folder;
    bool mixed; /* systems and analyses */
} place;

/* Folders to search, in order: here, each entry of NHSYM_PATH (its systems/ or analyses/, and itself), the installed
   data. */
static size_t places(nh_arena *arena, const char *kind, place *out)
{
    size_t n = 0;
    out[n++].folder = nh_arena_strdup(arena, kind);
    const char *path = getenv("NHSYM_PATH");
    while (path && *path && n + 7 < most_places) {
        size_t length = strcspn(path, ":");
        if (length) {
            out[n++].folder = nh_arena_printf(arena, "%.*s/%s", (int)length, path, kind);
            out[n++] = (place){.folder = nh_arena_strndup(arena, path, length), .mixed = true};
        }
        path += length + (path[length] == ':');
    }
    char *above = file_of_code(arena), *slash = above ? strrchr(above, '/') : NULL;
    for (int i = 0; i < 3 && slash; i++) { /* PREFIX is above bin, lib or lib/ARCHITECTURE, wherever it was moved to */
        *slash = 0;
        if (!(slash = strrchr(above, '/'))) break;
        size_t length = (size_t)(slash - above);
        out[n++].folder = nh_arena_printf(arena, "%.*s/share/nhsym/%s", (int)length, above, kind);
        /* built, and not installed: beside the folder of the build */
        if (i == 0) out[n++].folder = nh_arena_printf(arena, "%.*s/%s", (int)length, above, kind);
    }
    out[n++].folder = nh_arena_printf(arena, "%s/%s", NH_DATADIR, kind);
    return n;
}

bool nh_places_is_path(const char *name)
{
    static const char *const endings[] = {".yaml", ".yml", ".urdf", ".xml", ".xacro"};
    size_t length = strlen(name);
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        size_t n = strlen(endings[i]);
        if (length > n && !strcmp(name + length - n, endings[i])) return true;
    }
    return strchr(name, '/') != NULL;
}

const char *nh_places_look(nh_arena *arena, const char *kind, const char *name)
{
    place where[most_places] = {{NULL, false}};
    if (nh_places_is_path(name)) return access(name, F_OK) ? NULL : nh_arena_strdup(arena, name);
    size_t n = places(arena, kind, where);
    for (size_t i = 0; i < n; i++) {
        const char *file = nh_arena_printf(arena, "%s/%s.yaml", where[i].folder, name);
        if (!access(file, F_OK) && (!where[i].mixed || is_of_kind(file, kind))) return file;
    }
    for (size_t i = 0; i < n; i++) { /* those that are there for benchmark --robustness, and not listed */
        const char *file = nh_arena_printf(arena, "%s/stress/%s.yaml", where[i].folder, name);
        if (!access(file, F_OK)) return file;
    }
    return NULL;
}

static int by_name(const void *a, const void *b) { return strcmp(*(const char *const *)a, *(const char *const *)b); }

size_t nh_places_names(nh_arena *arena, const char *kind, const char ***names)
{
    place where[most_places] = {{NULL, false}};
    const char **list = NULL;
    size_t places_count = places(arena, kind, where), count = 0, capacity = 0, kept = 0;
    for (size_t i = 0; i < places_count; i++) {
        DIR *directory = opendir(where[i].folder);
        for (struct dirent *entry; directory && (entry = readdir(directory));) {
            size_t length = strlen(entry->d_name);
            if (length < 6 || strcmp(entry->d_name + length - 5, ".yaml")) continue;
            if (where[i].mixed && !is_of_kind(nh_arena_printf(arena, "%s/%s", where[i].folder, entry->d_name), kind))
                continue;
            nh_grow(&list, &capacity, count + 1, sizeof *list);
            list[count++] = nh_arena_strndup(arena, entry->d_name, length - 5);
        }
        if (directory) closedir(directory);
    }
    if (count) qsort(list, count, sizeof *list, by_name);
    const char **out = nh_arena_alloc(arena, (count + 1) * sizeof *out);
    for (size_t i = 0; i < count; i++)
        if (i == 0 || strcmp(list[i], list[i - 1])) out[kept++] = list[i];
    nh_free(list);
    *names = out;
    return kept;
}

/* The file of a nearly equal name in the same folder, or NULL. */
static const char *file_near(nh_arena *arena, const char *path)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    int above = (int)(name - path);
    DIR *directory = opendir(slash ? nh_arena_strndup(arena, path, (size_t)above) : ".");
    const char **list = NULL, *near = NULL;
    size_t count = 0, capacity = 0;
    for (const struct dirent *entry; directory && (entry = readdir(directory));) {
        if (!nh_places_is_path(entry->d_name)) continue;
        nh_grow(&list, &capacity, count + 1, sizeof *list);
        list[count++] = nh_arena_strdup(arena, entry->d_name);
    }
    if (directory) closedir(directory);
    if (count) qsort(list, count, sizeof *list, by_name);
    if (count) near = nh_text_nearest(name, list, count);
    nh_free(list);
    return near ? nh_arena_printf(arena, "%.*s%s", above, path, near) : NULL;
}

/* "sleigh.yaml", where only a shipped system has this name. */
static const char *shipped(nh_arena *arena, const char *kind, const char *path)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path, *dot = strrchr(name, '.');
    name = dot ? nh_arena_strndup(arena, name, (size_t)(dot - name)) : name;
    return nh_places_look(arena, kind, name) ? name : NULL;
}

static const char *no_such_file(nh_arena *arena, const char *kind, const char *path, nh_error *error)
{
    nh_fail(error, NH_INPUT, path, "there is no such file");
    const char *near = file_near(arena, path), *name = near ? NULL : shipped(arena, kind, path);
    if (near) nh_error_hint(error, "did you mean `%s`?", near);
    else if (name) nh_error_hint(error, "nhsym has a file of this name: write `%s`", name);
    else if (!strcmp(kind, "systems"))
        nh_error_hint(error, "`nhsym list` lists the available systems; `nhsym new skate` writes an example");
    return NULL;
}

const char *nh_places_find(nh_arena *arena, const char *kind, const char *name, nh_error *error)
{
    const char *found = nh_places_look(arena, kind, name);
    if (found) return found;
    if (nh_places_is_path(name)) return no_such_file(arena, kind, name, error);
    const char **names;
    size_t count = nh_places_names(arena, kind, &names);
    nh_fail(error, NH_INPUT, "", "there is no %s `%s` in ./%s, in NHSYM_PATH or among the installed ones",
            strcmp(kind, "systems") ? "analysis" : "system", name, kind);
    const char *near = nh_text_nearest(name, names, count), *file = nh_arena_printf(arena, "%s.yaml", name),
               *beside = strchr(name, '.') ? file_near(arena, name) : NULL;
    if (!access(file, F_OK)) nh_error_hint(error, "did you mean the file %s?  Write its whole name", file);
    else if (!access(name, F_OK)) nh_error_hint(error, "there is a file of this name here: write ./%s", name);
    else if (beside) nh_error_hint(error, "did you mean the file `%s`?", beside);
    else if (near) nh_error_hint(error, "did you mean `%s`?", near);
    else nh_error_hint(error, "give the path of a file, or a name that `nhsym list` shows");
    return NULL;
}
