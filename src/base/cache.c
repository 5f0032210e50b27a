#include "base/cache.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/memory.h"
#include "base/output.h"

enum { longest = 1 << 20 }; /* bytes of a text that is read */

bool nh_cache_path(const char *name, nh_text *path, const char **why)
{
    const char *own = getenv("NHSYM_CACHE"), *caches = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    *why = NULL;
    if (own && !*own) *why = "NHSYM_CACHE is empty";
    else if (own) nh_text_addf(path, "%s/%s", own, name);
    else if (caches && caches[0] == '/') nh_text_addf(path, "%s/nhsym/%s", caches, name); /* a relative one is to be ignored, by its specification */
    else if (home && home[0] == '/') nh_text_addf(path, "%s/.cache/nhsym/%s", home, name);
    else *why = "HOME is not set";
    return !*why;
}

char *nh_cache_read(const char *name)
{
    nh_text path;
    const char *why;
    nh_text_init(&path);
    FILE *file = nh_cache_path(name, &path, &why) ? fopen(nh_text_string(&path), "r") : NULL;
    nh_text_clear(&path);
    if (!file) return NULL;
    char *text = nh_alloc(longest + 1);
    size_t length = fread(text, 1, longest, file);
    bool good = !ferror(file) && feof(file);
    fclose(file);
    text[length] = 0;
    if (good) return text;
    nh_free(text);
    return NULL;
}

/* Every folder on the way to the file. */
static bool make_folders(char *path, nh_error *error)
{
    for (char *slash = strchr(path + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = 0;
        bool good = mkdir(path, 0700) == 0 || errno == EEXIST;
        if (!good) nh_fail(error, NH_NUMERIC, path, "the folder could not be made: %s", strerror(errno));
        *slash = '/';
        if (!good) return false;
    }
    return true;
}

bool nh_cache_write(const char *name, const char *text, nh_error *error)
{
    nh_text path;
    const char *why;
    nh_text_init(&path);
    bool good = nh_cache_path(name, &path, &why) || nh_fail(error, NH_NUMERIC, "", "there is no place for it: %s", why);
    char *copy = good ? nh_strdup(nh_text_string(&path)) : NULL;
    good = good && make_folders(copy, error) && nh_output_write(copy, text, strlen(text), error);
    nh_free(copy);
    nh_text_clear(&path);
    return good;
}
