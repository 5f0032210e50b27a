/* The same answer everywhere: to the last digit for every number of threads, and again; and on another kind of processor,
 * for which OpenBLAS and the C library have other kernels, the same formulas, counts and proofs, and the same numbers up to what is known of them.  The whole catalogue
 * goes through tests/same_everywhere.sh. */
#include "program.h"
#include "sweep.h"

#include <cjson/cJSON.h>
#include <math.h>

static const char *const questions[] = {"analyze sleigh --until 1",
                                        "analyze kepler --until 1",
                                        "analyze vertical_disk --no-analysis --until 1",
                                        "analyze henon_heiles_sk --until 1",
                                        "reduce vertical_disk --until 1",
                                        "simulate sleigh --initial omega=2 --until 1"};
enum { question_count = sizeof questions / sizeof *questions };

static bool ends_with(const char *text, const char *end)
{
    size_t n = strlen(text), k = strlen(end);
    return n >= k && !strcmp(text + n - k, end);
}

/* How long it took, and how it was called. */
static bool may_differ(const char *key) { return key && (ends_with(key, "_s") || !strcmp(key, "seconds") || !strcmp(key, "speedup") || !strcmp(key, "command")); }

/* With other last digits a motion takes other steps, and a warning tells another drift. */
static bool depends_on_digits(const char *key) { return key && (!strcmp(key, "evaluations") || !strcmp(key, "warnings")); }

/* `known`: of a number, relative; what is below `noise` is an error or zero. */
static bool equal(const cJSON *a, const cJSON *b, double known, double noise, char *where, size_t room)
{
    bool same = a && b && (a->type & 0xff) == (b->type & 0xff);
    size_t at = strlen(where);
    if (same && cJSON_IsNumber(a)) {
        double x = a->valuedouble, y = b->valuedouble, larger = fmax(fabs(x), fabs(y));
        return x == y || fabs(x - y) <= known * larger || larger < noise;
    }
    if (same && cJSON_IsString(a)) return !strcmp(a->valuestring, b->valuestring);
    if (!same || (!cJSON_IsObject(a) && !cJSON_IsArray(a))) return same;
    const cJSON *x = a->child, *y = b->child;
    for (; x && y; x = x->next, y = y->next) {
        where[at] = 0;
        if (x->string) snprintf(where + at, room - at, ".%.60s", x->string);
        if (x->string && strcmp(x->string, y->string)) return false;
        if (may_differ(x->string) || (known > 0 && depends_on_digits(x->string))) continue;
        if (!equal(x, y, known, noise, where, room)) return false;
    }
    where[at] = 0;
    return !x && !y;
}

static cJSON *answer(const place *p, const char *question, const char *more, const char *const *environment)
{
    char line[300];
    snprintf(line, sizeof line, "%s --quiet --json - %s", question, more);
    finished f = run_so(p, &(manner){.environment = environment}, line);
    cJSON *root = cJSON_Parse(f.out);
    cr_expect(root, "%s: %d %s", line, f.code, f.err);
    finished_clear(&f);
    return root;
}

/* Is every question answered alike in these surroundings? */
static void compare(const char *name, const char *more, const char *const *environment, double known, double noise)
{
    place p = place_with_systems();
    for (size_t i = 0; i < question_count; i++) {
        if (!sweep_tries(i, 4, 8)) continue;
        char where[2000] = "";
        cJSON *a = answer(&p, questions[i], "--threads 1", NULL);
        cJSON *b = answer(&p, questions[i], more, environment);
        cr_expect(equal(a, b, known, noise, where, sizeof where), "%s, %s: another answer at %s", questions[i], name, where);
        cJSON_Delete(a);
        cJSON_Delete(b);
    }
    place_clear(&p);
}

Test(everywhere, threads, PLAIN_ONLY)
{
    for (size_t i = 0; i < 3; i++) {
        char name[20], more[20];
        if (!sweep_tries(i + 1, 2, 3)) continue;
        snprintf(name, sizeof name, "%d threads", 1 << i);
        snprintf(more, sizeof more, "--threads %d", 1 << i);
        compare(name, more, NULL, 0, 0);
    }
}

/* Without the instructions of newer processors; a processor or a library that does not know these names goes on as before. */
Test(everywhere, processors, PLAIN_ONLY)
{
    static const char *const old[] = {"OPENBLAS_CORETYPE=Nehalem", "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-AVX2_Usable,-FMA,-FMA_Usable,-AVX512F,-AVX512F_Usable", NULL};
    static const char *const other[] = {"OPENBLAS_CORETYPE=Sandybridge", NULL};
    compare("an old processor", "--threads 1", old, 1e-5, 1e-6);
    compare("another processor", "--threads 2", other, 1e-5, 1e-6);
}

/* The values that a stage of the search takes for zero are bounded by rounding, which every library has its own of: how many
 * null vectors there are is decided by the currents that they are. */
Test(everywhere, rounding_does_not_count_null_vectors)
{
    place p = place_with_systems();
    static const char *const bound[] = {"--option zero=1", "--option zero=100"};
    static const char *const key[] = {"dimension", "found", "undecided"};
    cJSON *root[2], *stages[2];
    for (size_t i = 0; i < 2; i++) {
        root[i] = answer(&p, "analyze quartic_oscillator --no-analysis --until 1", bound[i], NULL);
        stages[i] = cJSON_GetObjectItem(root[i], "stages");
        cr_assert(cJSON_GetArraySize(stages[i]) > 3, "%d stages", cJSON_GetArraySize(stages[i]));
    }
    cr_assert_eq(cJSON_GetArraySize(stages[0]), cJSON_GetArraySize(stages[1]));
    for (int s = 0; s < cJSON_GetArraySize(stages[0]); s++)
        for (size_t k = 0; k < sizeof key / sizeof *key; k++)
            cr_expect(cJSON_Compare(cJSON_GetObjectItem(cJSON_GetArrayItem(stages[0], s), key[k]),
                                    cJSON_GetObjectItem(cJSON_GetArrayItem(stages[1], s), key[k]), true),
                      "stage %d: another %s", s, key[k]);
    for (size_t i = 0; i < 2; i++) cJSON_Delete(root[i]);
    place_clear(&p);
}
