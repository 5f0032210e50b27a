/* bench_pictures: a small picture of every system of a folder, as it moves when nobody says how.
 *
 *     bench_pictures systems docs/catalogue        writes NAME.svg; the exit code is 1 when a system could not be drawn
 */
#include "base/output.h"
#include "catalogue.h"
#include "document/thumbnail.h"
#include "commands/analyze.h"

static bool draw(const char *folder, const char *name, const char *into)
{
    char path[500], to[500];
    nh_error error;
    nh_error_clear(&error);
    snprintf(path, sizeof path, "%.200s/%.200s.yaml", folder, name);
    snprintf(to, sizeof to, "%.200s/%.200s.svg", into, name);
    nh_analyze_request q = {.system_path = path};
    nh_options_default(&q.options);
    q.options.max_seconds = 0.05; /* the motion is wanted, not the currents */
    nh_analysis *r = nh_analysis_create(&q, &error);
    nh_time_series *c = r ? nh_time_series_of_analysis(r) : NULL;
    nh_text text;
    nh_text_init(&text);
    bool good = c && nh_thumbnail(c, r->system->title, &text) && nh_output_write(to, nh_text_string(&text), text.length, &error);
    if (!good) fprintf(stderr, "%s: no picture: %s\n", name, error.what);
    nh_text_clear(&text);
    nh_time_series_free(c);
    nh_analysis_free(r);
    return good;
}

int main(int argc, char **argv)
{
    char *name[most_files];
    if (argc != 3) return 2;
    size_t n = list(argv[1], name), drawn = 0;
    for (size_t i = 0; i < n; i++) {
        drawn += draw(argv[1], name[i], argv[2]);
        free(name[i]);
    }
    return drawn != n;
}
