#include "study/ranking.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/cache.h"
#include "base/json.h"
#include "expr/fingerprint.h"

enum { name_size = 64, most_ways = 1000 };
static const char *const measured_names[] = {"chart", "survey", "plain survey"};
static const double near = 1; /* decades: the cheapest way for one accuracy is so for others */
static const char *const velocities_names[] = {[NH_OWN_VELOCITIES] = "own velocities", [NH_OTHER_VELOCITIES] = "other velocities", [NH_ALL_COORDINATES] = "all coordinates"};

uint64_t nh_ranking_key(const nh_model *o)
{
    nh_ex *e = nh_alloc_array(o->m + o->n + 1, sizeof *e);
    memcpy(e, o->rho, o->m * sizeof *e);
    memcpy(e + o->m, o->a, o->n * sizeof *e);
    uint64_t key = nh_fingerprint(o->dag, o->m + o->n, e, o->width, o->chart->symbol, o->system->parameters, o->parameter, o->parameter_value);
    nh_free(e);
    return key;
}

static const char *name_of(uint64_t key, char name[name_size])
{
    snprintf(name, name_size, "charts/%016" PRIx64 ".json", key);
    return name;
}

size_t nh_ranking_adaptive(nh_ranking *r)
{
    size_t kept = 0;
    for (size_t i = 0; i < r->count; i++)
        if (!r->way[i].method->order && r->way[i].velocities == NH_OWN_VELOCITIES) r->way[kept++] = r->way[i];
    return r->count = kept;
}

bool nh_ranking_possible(void)
{
    nh_text path;
    const char *why;
    nh_text_init(&path);
    bool possible = nh_cache_path("", &path, &why);
    nh_text_clear(&path);
    return possible;
}

/* ---- writing ---- */

bool nh_ranking_write(const nh_ranking *r, const char *system, nh_error *error)
{
    char name[name_size];
    nh_json *root = nh_json_object();
    nh_json_put_number(root, "schema", 1);
    nh_json_put_text(root, "nhsym", NH_VERSION);
    nh_json_put_text(root, "system", system);
    nh_json_put_number(root, "begin", r->begin);
    nh_json_put_number(root, "end", r->end);
    nh_json_put_text(root, "measured", measured_names[r->surveyed + r->plain]);
    nh_json *asked = nh_json_put_array(root, "asked");
    for (size_t i = 0; i < r->asks; i++) nh_json_put_number(nh_json_add_object(asked), "accuracy", r->asked[i]);
    nh_json *ways = nh_json_put_array(root, "ways");
    for (size_t i = 0; i < r->count; i++) {
        nh_json *item = nh_json_add_object(ways);
        nh_json_put_text(item, "method", r->way[i].method->name);
        nh_json_put_text(item, "velocities", velocities_names[r->way[i].velocities]);
        nh_json_put_number(item, "tolerance", r->way[i].tolerance);
        nh_json_put_number(item, "step", r->way[i].step);
        nh_json_put_number(item, "error", r->way[i].error);
        nh_json_put_number(item, "seconds_per_time", r->way[i].seconds);
    }
    char *text = nh_json_finish(root);
    bool good = nh_cache_write(name_of(r->key, name), text, error);
    nh_free(text);
    return good;
}

bool nh_ranking_tells(const nh_ranking *r, double eps, bool plain)
{
    bool tells = r->count && !r->surveyed;
    for (size_t i = 0; i < r->asks && r->count && (plain || !r->plain); i++) tells |= fabs(log10(eps / r->asked[i])) < near;
    return tells;
}

bool nh_ranking_keep(const nh_model *model, nh_ranking *r, nh_error *error)
{
    nh_arena *arena = nh_arena_create();
    nh_ranking old;
    r->key = nh_ranking_key(model);
    bool there = nh_ranking_read(r->key, arena, &old), good = r->count && !(there && (!old.surveyed || (r->plain && !old.plain)));
    bool beside = good && there && old.plain == r->plain && !nh_ranking_tells(&old, r->asked[0], r->plain) && old.count + r->count <= most_ways;
    if (beside) {
        nh_way *all = nh_arena_alloc(arena, (old.count + r->count) * sizeof *all);
        memcpy(all, r->way, r->count * sizeof *all);
        memcpy(all + r->count, old.way, old.count * sizeof *all);
        r->way = all;
        r->count += old.count;
        for (size_t i = 0; i < old.asks && r->asks < NH_RANKING_ASKED; i++) r->asked[r->asks++] = old.asked[i];
    }
    good = good && nh_ranking_write(r, model->system->name, error);
    nh_arena_free(arena);
    return good;
}

/* ---- reading ---- */

static bool read_velocities(const nh_json *item, nh_velocities *out)
{
    const char *text = nh_json_text(item, "velocities");
    for (int k = NH_OWN_VELOCITIES; text && k <= NH_ALL_COORDINATES; k++)
        if (!strcmp(text, velocities_names[k])) {
            *out = (nh_velocities)k;
            return true;
        }
    return false;
}

/* False: not a way that this program knows, or with numbers that make no sense. */
static bool read_way(const nh_json *item, nh_way *w)
{
    const char *method = nh_json_text(item, "method");
    *w = (nh_way){.method = method ? nh_method_find(method) : NULL, .tolerance = nh_json_value(item, "tolerance"), .step = nh_json_value(item, "step"),
                  .error = nh_json_value(item, "error"), .seconds = nh_json_value(item, "seconds_per_time")};
    if (!w->method || !read_velocities(item, &w->velocities) || !(w->error > 0 && w->error < 1) || !(w->seconds > 0 && isfinite(w->seconds))) return false;
    return w->method->order ? w->step > 0 && isfinite(w->step) : w->tolerance > 0 && w->tolerance < 1;
}

static bool read_all(const nh_json *root, nh_arena *arena, nh_ranking *out)
{
    const char *version = nh_json_text(root, "nhsym");
    size_t count = nh_json_count(nh_json_get(root, "ways"));
    if (!version || strcmp(version, NH_VERSION) || count == 0 || count > most_ways) return false;
    out->begin = nh_json_value(root, "begin");
    out->end = nh_json_value(root, "end");
    const nh_json *asked = nh_json_get(root, "asked");
    const char *measured = nh_json_text(root, "measured");
    out->plain = measured && !strcmp(measured, measured_names[2]);
    out->surveyed = out->plain || (measured && !strcmp(measured, measured_names[1]));
    for (size_t i = 0; i < nh_json_count(asked) && out->asks < NH_RANKING_ASKED; i++) {
        double eps = nh_json_value(nh_json_entry(asked, i), "accuracy");
        if (eps > 0 && eps < 1) out->asked[out->asks++] = eps;
    }
    out->way = nh_arena_alloc(arena, count * sizeof *out->way);
    for (size_t i = 0; i < count; i++) out->count += read_way(nh_json_entry(nh_json_get(root, "ways"), i), &out->way[out->count]);
    return out->count > 0;
}

bool nh_ranking_read(uint64_t key, nh_arena *arena, nh_ranking *out)
{
    char name[name_size], *text = nh_cache_read(name_of(key, name));
    nh_json *root = text ? nh_json_parse(text) : NULL;
    *out = (nh_ranking){.key = key};
    bool good = root && read_all(root, arena, out);
    if (!good) *out = (nh_ranking){.key = key};
    nh_json_free(root);
    nh_free(text);
    return good;
}
