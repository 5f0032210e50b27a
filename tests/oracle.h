/* oracle: reference values of tests/data, and models compared with them. */
#ifndef NH_TESTS_ORACLE_H
#define NH_TESTS_ORACLE_H

#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>

#include "mechanics.h"
#include "graph/dag.h"
#include "integrals/symmetry.h"

static inline cJSON *oracle_read(const char *path)
{
    FILE *file = fopen(path, "rb");
    cr_assert_not_null(file, "%s: run the tests from the folder of the project", path);
    fseek(file, 0, SEEK_END);
    size_t length = (size_t)ftell(file);
    rewind(file);
    char *text = nh_alloc(length + 1);
    cr_assert_eq(fread(text, 1, length, file), length);
    fclose(file);
    cJSON *json = cJSON_Parse(text);
    nh_free(text);
    cr_assert_not_null(json, "%s is not JSON", path);
    return json;
}

static inline const cJSON *oracle_get(const cJSON *object, const char *key)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, key);
    cr_assert_not_null(item, "no `%s` in the reference data", key);
    return item;
}

/* Numbers are strings (or plain numbers). */
static inline double oracle_value(const cJSON *item)
{
    if (cJSON_IsNumber(item)) return item->valuedouble;
    cr_assert(cJSON_IsString(item), "`%s` is no number", item->string ? item->string : "?");
    char *end;
    double value = strtod(item->valuestring, &end);
    cr_assert(*end == 0, "`%s` is no number", item->valuestring);
    return value;
}

static inline double oracle_number(const cJSON *object, const char *key)
{
    return oracle_value(oracle_get(object, key));
}

/* A number, or a list of numbers, or a list of lists: flat, row by row.  Returns how many. */
static inline size_t oracle_flat(const cJSON *item, double *out)
{
    size_t n = 0;
    if (!cJSON_IsArray(item)) {
        *out = oracle_value(item);
        return 1;
    }
    for (const cJSON *each = item->child; each; each = each->next) n += oracle_flat(each, out + n);
    return n;
}

/* A model with the parameters of a set. */
static inline mechanics oracle_model(const char *path, const char *text, const cJSON *set, size_t n, const char *const *parameter)
{
    nh_setting setting[10];
    nh_error error = {0};
    for (size_t i = 0; i < n; i++) setting[i] = (nh_setting){.name = parameter[i], .value = oracle_number(set, parameter[i])};
    nh_system *s = path ? nh_system_read(path, n, setting, &error) : nh_system_parse("oracle", text, n, setting, &error);
    return mechanics_make(s, NH_CHART_COORDINATES, &error);
}

/* The worst error so far of one kind of quantity, relative to the largest component of the whole vector (or `size`, if larger). */
typedef struct {
    const char *what;
    double worst;
    size_t compared;
} tally;

static inline void tally_add(tally *t, size_t n, const double *got, const double *want, double size)
{
    double error = 0;
    for (size_t i = 0; i < n; i++) size = fmax(size, fabs(want[i]));
    for (size_t i = 0; i < n; i++) error = isfinite(got[i]) ? fmax(error, fabs(got[i] - want[i])) : INFINITY;
    t->worst = fmax(t->worst, error == 0 ? 0 : error / size);
    t->compared++;
}

static inline void tally_check(const tally *t, double tolerance, const char *name)
{
    if (getenv("NHSYM_TEST_FIGURES")) printf("%-28s %-14s %4zu compared, worst %.1e\n", name, t->what, t->compared, t->worst);
    cr_expect(t->compared > 0, "%s: %s was compared with nothing", name, t->what);
    cr_expect(t->worst <= tolerance, "%s: %s is off by %.2e", name, t->what, t->worst);
}

/* ---- geometry ---- */

enum { ORACLE_LBAR, ORACLE_LA, ORACLE_ABAR, ORACLE_BBAR, ORACLE_ACC, ORACLE_YDD, ORACLE_MU, ORACLE_EPS, ORACLE_GAMMA, ORACLE_QUANTITIES };

typedef struct {
    nh_ex *e[ORACLE_QUANTITIES];
    size_t count[ORACLE_QUANTITIES];
    tally t[ORACLE_QUANTITIES];
    nh_arena *arena;
} geometry;

static inline nh_ex *geometry_take(geometry *g, int which, size_t count)
{
    g->count[which] = count;
    return g->e[which] = nh_arena_alloc(g->arena, (count + 1) * sizeof(nh_ex));
}

static inline geometry geometry_of(const nh_model *o)
{
    static const char *const names[] = {"Lbar", "Lbar_a", "Abar", "Bbar", "acc", "ydd", "mu", "eps_prime", "Gamma"};
    geometry g = {.arena = nh_arena_create()};
    nh_dag *d = o->dag;
    size_t n = o->n, m = o->m, k = o->k;
    for (int i = 0; i < ORACLE_QUANTITIES; i++) g.t[i].what = names[i];
    *geometry_take(&g, ORACLE_LBAR, 1) = o->Lbar;
    nh_ex *La = geometry_take(&g, ORACLE_LA, k), *B = geometry_take(&g, ORACLE_BBAR, n * n), *ydd = geometry_take(&g, ORACLE_YDD, k);
    nh_ex *eps = geometry_take(&g, ORACLE_EPS, k * n), *gamma = geometry_take(&g, ORACLE_GAMMA, 1 + m + n);
    memcpy(geometry_take(&g, ORACLE_ABAR, n), o->A, n * sizeof(nh_ex));
    memcpy(geometry_take(&g, ORACLE_ACC, n), o->a, n * sizeof(nh_ex));
    nh_ex *mu = geometry_take(&g, ORACLE_MU, k); /* of the constraints solved for the dependent velocities, however they were written */
    for (size_t i = 0; i < n * n; i++) B[i] = nh_neg(d, o->M[i]);
    for (size_t a = 0; a < k; a++) {
        size_t s = o->chart->dependent[a];
        La[a] = o->p[s];
        ydd[a] = nh_model_gamma(o, o->rho[s]);
        mu[a] = nh_int(d, 0);
        for (size_t b = 0; b < k; b++) mu[a] = nh_add(d, mu[a], nh_mul(d, o->mu[b], o->nu[b * m + s]));
        for (size_t l = 0; l < n; l++) eps[a * n + l] = nh_sub(d, nh_model_X(o, l, o->rho[s]), nh_model_X0(o, o->R[s * n + l]));
    }
    gamma[0] = nh_int(d, 1);
    memcpy(gamma + 1, o->rho, m * sizeof(nh_ex));
    memcpy(gamma + 1 + m, o->a, n * sizeof(nh_ex));
    return g;
}

/* Compare one point; quantities that the data do not have are passed over. */
static inline void geometry_compare(geometry *g, const nh_model *o, const cJSON *point, const char *const key[ORACLE_QUANTITIES])
{
    double z[20], got[100], want[100];
    cr_assert_eq(oracle_flat(oracle_get(point, "z"), z), o->width - o->chart->implicit);
    for (size_t i = o->width - o->chart->implicit; i < o->width; i++) z[i] = o->chart->high[i];
    cr_assert(nh_chart_complete(o->chart, z));
    for (int i = 0; i < ORACLE_QUANTITIES; i++) {
        if (!key[i]) continue;
        cr_assert_eq(oracle_flat(oracle_get(point, key[i]), want), g->count[i], "%s", key[i]);
        values_at(o, g->count[i], g->e[i], z, got);
        tally_add(&g->t[i], g->count[i], got, want, 0);
    }
}

static inline void geometry_check(geometry *g, const char *const key[ORACLE_QUANTITIES], double tolerance, const char *name)
{
    for (int i = 0; i < ORACLE_QUANTITIES; i++)
        if (key[i]) tally_check(&g->t[i], tolerance, name);
    nh_arena_free(g->arena);
}

/* ---- currents ---- */

enum { ORACLE_PHI, ORACLE_Z, ORACLE_BRACKET, ORACLE_FORM, ORACLE_CURRENT_QUANTITIES };

typedef struct {
    const char *name, *formula;
    nh_symmetry z;
    tally t[ORACLE_CURRENT_QUANTITIES];
} claim;

static inline void claim_open(claim *c, nh_model *o, const nh_points *points)
{
    static const char *const names[] = {"Phi", "Z", "[Gamma,Z]", "i_[Gamma,Z]"};
    nh_error error = {0};
    nh_options options;
    nh_options_default(&options);
    for (int i = 0; i < ORACLE_CURRENT_QUANTITIES; i++) c->t[i] = (tally){.what = names[i]};
    must(nh_symmetry_of(o, points, formula(o, c->formula), options.same, &c->z, &error), &error, c->name);
}

static inline void claim_field(const nh_model *o, const nh_field *f, const double *z, double *out)
{
    out[0] = value_at(o, f->time, z);
    values_at(o, o->m, f->space, z, out + 1);
    values_at(o, o->n, f->velocity, z, out + 1 + o->m);
}

static inline void claim_compare(claim *c, const nh_model *o, const cJSON *point)
{
    double z[20], got[30], want[30];
    const cJSON *data = oracle_get(oracle_get(point, "currents"), c->name), *form = cJSON_GetObjectItem(data, "i_bracket_phi1");
    size_t width = 1 + o->m + o->n;
    oracle_flat(oracle_get(point, "z"), z);
    for (size_t i = o->width - o->chart->implicit; i < o->width; i++) z[i] = o->chart->high[i];
    cr_assert(nh_chart_complete(o->chart, z));
    *got = value_at(o, c->z.phi, z);
    cr_assert_eq(oracle_flat(oracle_get(data, "Phi"), want), 1);
    tally_add(&c->t[ORACLE_PHI], 1, got, want, 0);
    claim_field(o, &c->z.field, z, got);
    cr_assert_eq(oracle_flat(oracle_get(data, "Z"), want), width);
    tally_add(&c->t[ORACLE_Z], width, got, want, 0);
    claim_field(o, &c->z.bracket, z, got);
    cr_assert_eq(oracle_flat(oracle_get(data, "bracket_Gamma_Z"), want), width);
    bool zero = true; /* a bracket that vanishes: 40-digit rounding in the data */
    for (size_t i = 0; i < width; i++) zero &= fabs(want[i]) < 1e-40;
    tally_add(&c->t[ORACLE_BRACKET], width, got, want, zero ? 1 : 0);
    values_at(o, o->k, c->z.bracket_form, z, got);
    for (size_t a = 0; a < o->k; a++) got[a] /= value_at(o, o->nu[a * o->m + o->chart->dependent[a]], z); /* the form of y' - g, as for mu */
    cr_assert_eq(oracle_flat(form ? form : oracle_get(data, "i_bracket_phi"), want), o->k);
    tally_add(&c->t[ORACLE_FORM], o->k, got, want, fabs(*want) < 1e-40 ? 1 : 0);
    cr_expect_eq(c->z.kase, (int)oracle_number(data, "case"), "%s is of case %d", c->name, c->z.kase);
    cr_expect_eq(c->z.bracket_in_distribution, cJSON_IsTrue(oracle_get(data, "bracket_in_C")), "%s: bracket in C", c->name);
}

static inline void claim_check(const claim *c, double tolerance, const char *name)
{
    char text[100];
    snprintf(text, sizeof text, "%.40s %.40s", name, c->name);
    for (int i = 0; i < ORACLE_CURRENT_QUANTITIES; i++) tally_check(&c->t[i], tolerance, text);
}

#endif
