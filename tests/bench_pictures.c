/* bench_pictures: a small picture of every system of a folder, as it moves when nobody says how.
 *
 *     bench_pictures systems docs/catalogue        writes NAME.svg; the exit code is 1 when a system could not be drawn
 */
#include <math.h>

#include "base/output.h"
#include "catalogue.h"
#include "commands/simulate.h"
#include "thumbnail.h"

/* The motion at so many equal steps of the time for which it goes by itself. */
static nh_simulation *move(const char *path, nh_error *error)
{
    enum { steps = 2000 };
    nh_request q = {.system_path = path, .draw = true};
    nh_options_default(&q.options);
    nh_simulation *s = nh_simulation_create(&q, error);
    if (!s || !s->motion || s->motion->count < 2) return s;
    q.step = fabs(s->motion->time[s->motion->count - 1] - s->motion->time[0]) / steps;
    nh_simulation_free(s);
    return nh_simulation_create(&q, error);
}

static bool draw(const char *folder, const char *name, const char *into)
{
    char path[500], to[500];
    nh_error error;
    nh_error_clear(&error);
    snprintf(path, sizeof path, "%.200s/%.200s.yaml", folder, name);
    snprintf(to, sizeof to, "%.200s/%.200s.svg", into, name);
    nh_simulation *s = move(path, &error);
    nh_time_series *c = s ? nh_time_series_of_simulation(s) : NULL;
    nh_text text;
    nh_text_init(&text);
    bool good = c && thumbnail(c, s->system->title, &text) && nh_output_write(to, nh_text_string(&text), text.length, &error);
    if (!good) fprintf(stderr, "%s: no picture: %s\n", name, error.what);
    nh_text_clear(&text);
    nh_time_series_free(c);
    nh_simulation_free(s);
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
