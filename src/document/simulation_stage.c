/* The motion of a simulation with its quantities, for the top of a page: the energy and the currents that the file
 * knows, as far as they are conserved. */
#include <math.h>
#include <string.h>

#include "document/facts.h"
#include "document/live.h"
#include "document/simulation.h"
#include "graph/dag.h"
#include "integrals/prove.h"

typedef struct {
    const nh_simulation *s;
    size_t count;
    nh_stage_row *row;
    nh_live_quantity *quantity;
} list;

/* Is it the energy under another name? */
static bool is_energy(const list *l, nh_ex e, const nh_options *options)
{
    const nh_model *o = l->s->model;
    nh_ex term[] = {e, nh_neg(o->dag, o->E)};
    return e == o->E || nh_prove_zero(o, 2, term, true, options).proved;
}

/* What is not proved to be conserved is only plotted. */
static void add(list *l, const nh_track *track, const nh_options *options)
{
    enum { most_named = 6 }; /* parameters */
    const nh_simulation *s = l->s;
    bool energy = track->kind == NH_TRACK_ENERGY, words = strchr(track->name, ' ') != NULL;
    nh_proof proof = nh_prove_current(s->model, track->value, true, options);
    if (!proof.proved || (!energy && is_energy(l, track->value, options))) return;
    const char *sure = nh_facts_holds(s->model, &proof, s->system->parameters <= most_named);
    l->quantity[l->count] = (nh_live_quantity){.name = track->name,
                                               .value = track->value,
                                               .proved = true,
                                               .all_parameters = proof.all_parameters,
                                               .fixed = proof.fixed};
    l->row[l->count++] = (nh_stage_row){.name = energy  ? "Energy"
                                                : words ? track->name
                                                        : "",
                                        .doc = "",
                                        .from = energy ? "the symmetry in time" : "",
                                        .sure = *sure == ' ' ? sure + 1 : sure,
                                        .anchor = "",
                                        .label = words ? "" : track->name,
                                        .value = track->value,
                                        .proved = true,
                                        .drift = NAN};
}

nh_stage *nh_simulation_stage(const nh_simulation *s, const nh_run *run)
{
    nh_time_series *series = nh_time_series_of_simulation(s);
    if (!series || series->count < 2) return nh_time_series_free(series), NULL;
    const nh_observables *t = &s->columns;
    nh_options options;
    nh_options_default(&options);
    list l = {.s = s,
              .row = nh_arena_alloc(s->arena, (t->count + 1) * sizeof *l.row),
              .quantity = nh_arena_alloc(s->arena, (t->count + 1) * sizeof *l.quantity)};
    for (size_t i = 0; i < t->count; i++)
        if (t->track[i].kind == NH_TRACK_ENERGY) add(&l, &t->track[i], &options);
    for (size_t i = 0; i < t->count; i++)
        if (t->track[i].kind == NH_TRACK_CURRENT || t->track[i].kind == NH_TRACK_WATCH) add(&l, &t->track[i], &options);
    double *first = nh_arena_alloc(s->arena, (t->count + 1) * sizeof *first);
    for (size_t i = 0; i < t->count; i++) first[i] = series->line[i].value[0];
    nh_live_request request = {.model = s->model,
                               .tracks = t,
                               .first = first,
                               .begin = series->time[0],
                               .end = series->time[series->count - 1],
                               .quantities = l.count,
                               .quantity = l.quantity};
    nh_stage *stage = nh_arena_alloc(s->arena, sizeof *stage);
    *stage = (nh_stage){.series = series,
                        .tracks = t,
                        .live = nh_live_create(&request, nh_live_js_lacks),
                        .command = nh_live_command(s->arena, run, s->system),
                        .rows = l.count,
                        .row = l.row};
    return stage;
}
