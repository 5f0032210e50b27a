#include "commands/reduce.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/linalg.h"
#include "base/progress.h"
#include "geometry/model.h"
#include "reduction/subspace.h"
#include "commands/reduce_internal.h"
#include "commands/simulate.h"
#include "graph/dag.h"

const char *nh_stage_kind_name(nh_stage_kind kind)
{
    static const char *const names[] = {"chaplygin", "second", "lagrange-dalembert-poincare", "slice", "quotient"};
    return names[kind];
}

void nh_reduction_warn(nh_reduction *r, const char *format, ...)
{
    char text[600];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    if (r->warnings < sizeof r->warning / sizeof *r->warning)
        r->warning[r->warnings++] = nh_arena_strdup(r->arena, text);
}

bool nh_reduction_late(nh_reduction *r, const char *what)
{
    if (!nh_late()) return false;
    /* the deadline is past, but nothing ended the run */
    const char *option = nh_ended_option() ? nh_ended_option() : "--max-seconds";
    nh_reduction_warn(r, "a limit prevented %s; raise it by %s", what, option);
    return r->partial = true;
}

/* ---- the group ---- */

/* text[begin .. end) without the blanks around it. */
static void trim(const char *text, size_t *begin, size_t *end)
{
    while (*begin < *end && strchr(" \t", text[*begin])) ++*begin;
    while (*begin < *end && strchr(" \t", text[*end - 1])) --*end;
}

static bool bad_field(const nh_reduction *r, const char *typed, size_t begin, size_t end, nh_error *error)
{
    nh_deck_fail_typed("--group", typed, begin, error, "`%.*s` is not a component of a vector field",
                       (int)(end - begin), typed + begin);
    return nh_error_hint(error, "write fields as `%s=1; ...`; separate components by commas, fields by semicolons",
                         r->kinetic->name[0]);
}

/* "x=-y" in typed[begin .. end) */
static bool parse_component(nh_reduction *r, const char *typed, size_t begin, size_t end, nh_ex *component,
                            nh_error *error)
{
    const nh_kinetic *k = r->kinetic;
    trim(typed, &begin, &end);
    const char *equal = memchr(typed + begin, '=', end - begin);
    if (!equal) return bad_field(r, typed, begin, end, error);
    size_t stop = (size_t)(equal - typed), right = stop + 1;
    trim(typed, &begin, &stop);
    char *name = nh_arena_strndup(r->arena, typed + begin, stop - begin);
    long s = nh_system_coordinate(r->system, name);
    if (s < 0) {
        nh_deck_fail_typed("--group", typed, begin, error, "`%.100s` is not a coordinate", name);
        const char *near = nh_text_nearest(name, k->name, k->m);
        return near ? nh_error_hint(error, "did you mean `%s`?", near)
                    : nh_error_hint(error,
                                    "write fields as `%s=1; ...`; separate components by commas, fields by semicolons",
                                    k->name[0]);
    }
    if (!nh_system_expression_part(r->system, "--group", typed, right, end - right, 0, NULL, &component[s], error))
        return false;
    for (size_t j = 0; j < k->m; j++)
        if (nh_depends(k->dag, component[s], k->v[j]))
            return nh_deck_fail_typed(
                "--group", typed, right, error,
                "the component of `%s` contains a velocity; symmetries are fields on configuration space", name);
    return true;
}

/* "theta=1, x=-y, y=x" in typed[begin .. end) */
static bool parse_field(nh_reduction *r, const char *typed, size_t begin, size_t end, nh_ex *component, nh_error *error)
{
    const nh_kinetic *k = r->kinetic;
    for (size_t s = 0; s < k->m; s++) component[s] = nh_int(k->dag, 0);
    for (size_t at = begin; at < end;) {
        size_t length = nh_text_entry(typed + at, ",;");
        if (!parse_component(r, typed, at, at + length, component, error)) return false;
        at += length + (typed[at + length] == ',');
    }
    return true;
}

static bool group_of_fields(nh_reduction *r, const char *text, nh_error *error)
{
    size_t most = 1, n = 0;
    for (const char *c = text; *c; c++) most += *c == ';';
    nh_generator *g = nh_alloc_array(most, sizeof *g);
    nh_ex *component = nh_alloc_array(r->kinetic->m, sizeof *component);
    bool good = true;
    for (size_t at = 0; text[at] && good;) {
        size_t length = nh_text_entry(text + at, ";"), begin = at, end = at + length;
        trim(text, &begin, &end);
        if (begin < end) {
            good = parse_field(r, text, begin, end, component, error);
            if (good) nh_generator_init(&g[n++], r->kinetic, NULL, component, &r->options);
        }
        at += length + (text[at + length] == ';');
    }
    if (good && n) r->group = nh_group_of(r->kinetic, n, g, &r->options);
    if (good && !n) good = nh_fail(error, NH_USAGE, "--group", "no vector field is given");
    nh_free(g);
    nh_free(component);
    return good && nh_action_check(&r->group->action, &r->options, error);
}

/* The fields of the system file. */
static bool group_of_file(nh_reduction *r, nh_error *error)
{
    const nh_system *system = r->system;
    nh_generator *g = nh_alloc_array(system->symmetries, sizeof *g);
    for (size_t i = 0; i < system->symmetries; i++)
        nh_generator_init(&g[i], r->kinetic, NULL, system->symmetry + i * system->coordinates, &r->options);
    r->group = nh_group_of(r->kinetic, system->symmetries, g, &r->options);
    nh_free(g);
    return nh_action_check(&r->group->action, &r->options, error);
}

/* "1, 2, 5": numbers of generators of the group that was found. */
static bool group_of_numbers(nh_reduction *r, const char *text, nh_error *error)
{
    size_t d = r->all->action.d, n = 0;
    nh_generator *g = nh_alloc_array(strlen(text) + 1, sizeof *g);
    bool good = true;
    for (const char *c = text; *c && good;) {
        char *end;
        c += strspn(c, " \t");
        long i = strtol(c, &end, 10);
        if (end == c) {
            c++;
            continue;
        }
        good = i >= 1 && (size_t)i <= d;
        if (good) g[n++] = r->all->action.generator[i - 1];
        else
            nh_deck_fail_typed("--group", text, (size_t)(c - text), error,
                               "there is no generator %ld; the group has %zu", i, d);
        c = end;
    }
    if (good) r->group = nh_group_of(r->kinetic, n, g, &r->options);
    nh_free(g);
    return good && nh_action_check(&r->group->action, &r->options, error);
}

/* The number of symmetries of the equations beyond those of L. */
static void count_weaker(nh_reduction *r)
{
    nh_error trouble = {0};
    const nh_kinetic *k = r->kinetic;
    bool flat = !k->magnetic;
    for (size_t s = 0; s < k->m && flat; s++) flat = !nh_depends(k->dag, k->V, k->q[s]);
    if (!r->all->jets || r->strict || flat || nh_interrupted()) return;
    nh_jets *j = nh_jets_find(nh_quasi_symmetry_kinetic(k), &r->options, &trouble);
    size_t more = j ? nh_group_jets_within_walls(j, k, &r->options) : 0,
           own = j ? nh_group_jets_within_walls(r->all->jets, k, &r->options) : 0;
    if (more > own) r->weaker = more - own;
    nh_jets_free(j);
    nh_error_clear(&trouble);
}

static void keep_within_walls(nh_reduction *r)
{
    r->group = nh_group_within_walls(r->all, &r->options);
    if (!r->group) {
        r->group = r->all;
        return;
    }
    size_t lost = r->all->action.d - r->group->action.d;
    r->all->local = true;
    r->all->global = r->group->action.d;
    nh_free(r->all->global_name);
    r->all->global_name = nh_strdup(r->group->name);
    nh_reduction_warn(r,
                      "%zu of the %zu local symmetries move%s places where the Lagrangian or a force jumps or has a "
                      "kink: %s left out, because %s motions that reach these places to no motions",
                      lost, r->all->action.d, lost == 1 ? "s" : "", lost == 1 ? "it is" : "they are",
                      lost == 1 ? "it takes" : "they take");
}

/* Fields that the user named must leave the walls invariant, too. */
static bool named_within_walls(nh_reduction *r, nh_error *error)
{
    nh_group *within = r->group ? nh_group_within_walls(r->group, &r->options) : NULL;
    if (!within) return true;
    nh_group_free(within);
    nh_fail(error, NH_INPUT, "",
            "these fields are symmetries on each side only of a place where the Lagrangian or a force jumps or has a "
            "kink: they move this place");
    return nh_error_hint(error, "nhsym reduce without --group lists all symmetries");
}

static bool find_groups(nh_reduction *r, const nh_request *q, nh_error *error)
{
    if (q->group && !q->group[strspn(q->group, " ,;\t")])
        return nh_fail(error, NH_USAGE, "--group", "give vector fields or numbers of generators");
    bool numbers = q->group && !q->group[strspn(q->group, "0123456789 ,;")];
    if (!q->group && r->system->symmetries) return group_of_file(r, error) && named_within_walls(r, error);
    if (!q->group || numbers) {
        r->all = nh_group_find(r->kinetic, &r->options, error);
        if (!r->all) return false;
        count_weaker(r);
        if (r->all->missing)
            nh_reduction_warn(r, "%zu further local symmetr%s: the search found no closed form", r->all->missing,
                              r->all->missing == 1 ? "y exists" : "ies exist");
    }
    if (numbers) return group_of_numbers(r, q->group, error) && named_within_walls(r, error);
    if (q->group) return group_of_fields(r, q->group, error) && named_within_walls(r, error);
    keep_within_walls(r);
    return true;
}

/* At a place where the group's orbit has a lower dimension there is nothing to divide out: an error where the user gave
 * the group, otherwise a warning. */
static bool starts_well(nh_reduction *r, nh_error *error)
{
    nh_error trouble = {0};
    if (!r->kinetic->metric ||
        nh_action_check_at(&r->group->action, r->initial.q, &r->options, r->group->given ? error : &trouble))
        return true;
    if (r->group->given) return false;
    nh_reduction_warn(r, "at the initial position, %s", trouble.what);
    return true;
}

/* For a system of bodies: which displacements of its joints leave the kinetic energy invariant, and what else these
 * leave invariant. */
static bool joint_by_joint(nh_reduction *r, const nh_request *q, nh_error *error)
{
    if (!r->system->chain || nh_reduction_late(r, "the symmetries joint by joint")) return true;
    r->joints = nh_chain_symmetries_find(r->system, (uint64_t)q->options.seed, error);
    if (!r->joints) return false;
    r->of_joint = nh_arena_alloc(r->arena, (r->joints->fields + 1) * sizeof *r->of_joint);
    for (size_t i = 0; i < r->joints->fields; i++)
        nh_generator_init(&r->of_joint[i], r->kinetic, NULL, r->joints->field[i].component, &r->options);
    return true;
}

/* ---- the whole reduction ---- */

/* Where metric and constraints give only a vague reason for a failure, the equations of motion give it with its place
 * in the file. */
static void explain_failure(nh_reduction *r, const nh_request *q, nh_error *error)
{
    nh_error better = {0};
    nh_model *whole =
        nh_model_create(r->system, nh_chart_create(r->system, q->chart, (uint64_t)q->options.seed, &better), &better);
    if (!whole && better.code != NH_OK) *error = better;
    nh_model_free(whole);
}

static bool open_system(nh_reduction *r, const nh_request *q, nh_error *error)
{
    r->system = nh_system_read(q->system_path, q->settings, q->setting, error);
    if (!r->system) return false;
    r->model = nh_model_bare(r->system, nh_chart_create(r->system, q->chart, (uint64_t)q->options.seed, error));
    if (!r->model || !nh_model_regular(r->model, error)) return false;
    r->kinetic = nh_kinetic_create(r->model, (uint64_t)q->options.seed, error);
    if (!r->kinetic) explain_failure(r, q, error);
    if (!r->kinetic || !q->weak) return r->kinetic != NULL;
    if (!r->kinetic->general) {
        nh_fail(error, NH_USAGE, "",
                "--weak needs a kinetic energy quadratic in the velocities and constraints that are at most affine: %s",
                r->kinetic->obstacle);
        return nh_error_hint(error, "remove --weak");
    }
    r->strict = r->kinetic;
    r->kinetic = nh_quasi_symmetry_kinetic(r->strict);
    return true;
}

/* For a system that is reduced directly, or by symmetries of its equations. */
static bool conserved(nh_reduction *r)
{
    nh_error trouble = {0};
    if (r->strict) nh_quasi_symmetry_momenta(&r->momenta, r->strict, &r->group->action, &r->options);
    else if (!nh_reduction_quotient_momenta(r, &trouble))
        nh_reduction_warn(r, "the search for conserved momenta was skipped: %s", trouble.what);
    nh_error_clear(&trouble);
    return true;
}

/* Where there are no accelerations, a momentum without proof remains one "to rounding". */
static void confirm(nh_reduction *r)
{
    nh_error trouble = {0};
    if (nh_reduction_whole_model(r, &trouble)) nh_momenta_confirm(&r->momenta, r->whole, &r->options);
    nh_error_clear(&trouble);
}

static void clear_stages(nh_reduction *r)
{
    for (size_t i = 0; i < 4; i++) nh_action_clear(&r->action[i]);
    for (size_t i = 0; i < 2; i++) nh_second_clear(&r->second[i]);
    nh_ideals_clear(&r->chain);
    nh_frame_motion_free(r->frame);
    r->frame = NULL;
    for (size_t i = 0; i < r->stages; i++) nh_free(r->stage[i].group);
    memset(r->action, 0, sizeof r->action);
    memset(r->second, 0, sizeof r->second);
    memset(&r->chain, 0, sizeof r->chain);
    memset(r->stage, 0, sizeof r->stage);
    r->stages = r->unused_count = 0;
}

/* Carries out the stages.  When the run was interrupted there are none, and the group is kept. */
static bool divide_by_group(nh_reduction *r, nh_error *error)
{
    if (nh_interrupted() || nh_reduction_stages(r, error)) return true;
    if (nh_interrupted()) clear_stages(r);
    return nh_interrupted();
}

nh_reduction *nh_reduction_create(const nh_request *q, nh_error *error)
{
    static const double finest = 1e-14; /* tolerance */
    nh_arena *arena = nh_arena_create();
    nh_reduction *r = nh_arena_alloc(arena, sizeof *r);
    r->arena = arena;
    r->begin = clock();
    r->options = q->options;
    r->wanted = q->accuracy;
    if (q->accuracy > 0) r->options.tolerance = q->accuracy / NH_REDUCTION_ALLOWED;
    if (!(r->options.tolerance >= finest)) {
        nh_fail(error, NH_USAGE, "", "reduced motions can be compared to %.0e at best; %.0e was requested",
                NH_REDUCTION_ALLOWED * finest, q->accuracy);
        nh_reduction_free(r);
        return NULL;
    }
    r->until = q->options.until;
    r->chain_text = q->chain;
    r->inner_text = q->inner;
    r->chart = q->chart;
    nh_linalg_threads(1);
    nh_progress("the symmetry group", -1);
    bool good = open_system(r, q, error) && find_groups(r, q, error) && nh_reduction_initial(r, q, error) &&
                starts_well(r, error) && joint_by_joint(r, q, error);
    bool some = r->kinetic && (r->kinetic->reducible || r->kinetic->general);
    if (good && !some && r->group->action.d)
        nh_reduction_warn(r, "%s: the equations are reduced directly, without a connection and without momenta",
                          r->kinetic->obstacle);
    bool divide = good && r->group->action.d;
    if (divide) nh_progress("reduced equations, and motions of both", -1);
    if (divide) good = divide_by_group(r, error);
    if (divide && good && !nh_interrupted() && !nh_reduction_late(r, "the conserved momenta"))
        good = some && !r->strict ? nh_momenta_find(&r->momenta, &r->group->action, &r->options, error) : conserved(r);
    if (good && nh_momenta_unproved(&r->momenta, &r->group->action)) confirm(r);
    if (good) nh_reduction_integrable(r);
    if (good && q->equations) nh_reduction_write_out(r);
    if (good) nh_reduction_name_moved(r);
    if (good) nh_momenta_mark(&r->momenta, r->kinetic);
    if (nh_interrupted()) {
        char words[80];
        nh_ended_words(words, sizeof words);
        nh_reduction_warn(r, "%s: the results are partial%s%s", words, nh_ended_option() ? "; raise the limit by " : "",
                          nh_ended_option() ? nh_ended_option() : "");
        r->partial = true;
    }
    if (good && nh_interrupted()) nh_error_clear(error);
    r->seconds = (double)(clock() - r->begin) / CLOCKS_PER_SEC;
    if (good) return r;
    nh_reduction_free(r);
    return NULL;
}

bool nh_reduction_again(nh_reduction *r, size_t place, nh_error *error)
{
    const nh_kinetic *k = r->kinetic;
    if (place >= k->places) return nh_fail(error, NH_USAGE, "", "there are only %zu sample points", k->places);
    if (!r->group->action.d) return nh_fail(error, NH_USAGE, "", "the system is not reduced");
    clear_stages(r);
    r->begin = clock();
    r->warnings = 0;
    r->brief = true;
    memcpy(r->initial.q, k->place + place * k->m, k->m * sizeof(double));
    memcpy(r->initial.v, k->speed + place * k->m, k->m * sizeof(double));
    return nh_reduction_stages(r, error);
}

void nh_reduction_free(nh_reduction *r)
{
    if (!r) return;
    clear_stages(r);
    nh_chain_symmetries_free(r->joints);
    if (r->group != r->all) nh_group_free(r->group);
    nh_group_free(r->all);
    nh_kinetic_free(r->kinetic);
    nh_model_free(r->whole);
    nh_model_free(r->model);
    nh_system_free(r->system);
    nh_arena_free(r->arena);
}
