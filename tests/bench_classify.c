/* bench_classify: families of tests/data/classify, whose files hold no answers, classified: the rows of
 * docs/classification.md. And random families, as many of them with a planted special value as without.
 *
 *     bench_classify [FAMILIES OF EACH KIND [ROWS OF THIS FILE ONLY, OR questions]]
 *
 * The exit code is 1 when a value is missed or false among the random ones. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "commands/classify.h"

static const struct {
    const char *file, *over;
    double degree;
    bool shape;
    const char *name;        /* of another parameter that is set, or NULL */
    int64_t top, bottom;
} FAMILIES[] = {
    {"henon_heiles", "eps", 4, false, "B", 1, 1},  {"henon_heiles", "eps", 6, false, "B", 16, 1}, {"henon_heiles",
        "eps", 4, false, "B", 5, 7}, {"henon_heiles", "B", 4, false, "eps", 1, 3},
    {"quartic", "b", 4, false, "mu", 1, 1},        {"quartic", "b", 4, false, "mu", 8, 1},        {"quartic", "b", 4,
        false, "mu", 16, 1},      {"quartic", "mu", 4, false, "b", 6, 1},
    {"quartic", "mu", 4, false, "b", 12, 1},       {"holt", "b", 6, false, NULL, 0, 0},           {"oscillators", "b",
        4, false, NULL, 0, 0},   {"atwood", "mu", 4, false, NULL, 0, 0},
    {"top", "C", 4, true, NULL, 0, 0},             {"top_level", "C", 3, true, NULL, 0, 0},       {"contact", "b", 3,
        false, NULL, 0, 0},        {"knife", "b", 2, false, NULL, 0, 0},         {"sleigh", "a", 1, false, NULL, 0, 0},
    {"cubic", "c", 6, false, "d", 0, 1},           {"toda", "a", 6, false, NULL, 0, 0},          {"suslov_potential", "b", 4, true, NULL, 0, 0},
    {"rolling_balls", "C", 2, true, NULL, 0, 0},
};

/* ---- families of the literature ---- */

enum { most_primes = 500 };  /* of a theorem that leaves out no number */

static void put_values(const nh_classified *x)
{
    const nh_classification *c = x->classification;
    size_t written = 0;
    for (size_t k = 0; k < c->specials; k++) {
        const nh_classify_special *v = &c->special[k];
        if (!v->first && !v->open) continue;
        printf("%s%s from degree %zu", written++ ? "; " : "", nh_classified_words(x, &v->polynomial), v->first
               ? v->first : v->open);
        if (v->first)
            printf(" (%zu instead of %zu, %s)", v->number[v->first].bound, c->row[v->first - 1].number.bound,
                   x->part[k].finding.complete >= v->first ? "proved" : "counted");
        else printf(" (not decided)");
    }
    printf("%s | ", written ? "" : "none");
    written = 0;
    for (size_t k = 0; k < c->specials; k++)
        if (c->special[k].degenerate)
            printf("%s%s", written++ ? "; " : "", nh_classified_words(x, &c->special[k].polynomial));
}

static void row(size_t index)
{
    char path[200];
    nh_error error;
    nh_error_clear(&error);
    nh_setting setting = {.name = FAMILIES[index].name,
                          .value = (double)FAMILIES[index].top / (double)(FAMILIES[index].bottom
                              ? FAMILIES[index].bottom : 1)};
    setting.top = FAMILIES[index].top, setting.bottom = FAMILIES[index].bottom;
    snprintf(path, sizeof path, "tests/data/classify/%s.yaml", FAMILIES[index].file);
    nh_classify_request q = {.system_path = path, .settings = setting.name != NULL, .setting = &setting,
                             .over = {FAMILIES[index].over}, .shape = FAMILIES[index].shape};
    nh_options_default(&q.options);
    q.options.degree = FAMILIES[index].degree;
    q.options.theorem = most_primes;
    double begin = nh_clock();
    nh_classified *x = nh_classify_system(&q, &error);
    if (!x) {
        printf("| %s | %s |\n", FAMILIES[index].file, error.what);
        return;
    }
    const nh_classification *c = x->classification;
    printf("| %s", x->title);
    if (setting.name) printf(", %s = %" PRId64, setting.name, setting.top);
    if (setting.name && setting.bottom != 1) printf("/%" PRId64, setting.bottom);
    printf("%s | %s | %zu | ", x->shape ? ", coefficients free of cyclic coordinates" : "", x->over[0], c->rows);
    for (size_t d = 0; d < c->rows; d++)
        printf("%s%s%zu", d ? ", " : "", c->row[d].number.bound == c->row[d].known ? "" : "<= ",
               c->row[d].number.bound);
    printf(" | ");
    put_values(x);
    size_t everywhere = c->rows;
    for (size_t d = 0; d < c->rows; d++)
        if (!c->row[d].theorem && everywhere == c->rows) everywhere = d;
    if (!c->rows) printf(" | - |");
    else if (everywhere == c->rows) printf(" | no other number |");
    else if (everywhere) printf(" | %.0e; to degree %zu no other number |", c->row[c->rows - 1].height, everywhere);
    else printf(" | %.0e |", c->row[c->rows - 1].height);
    printf(" %.1f |\n", nh_clock() - begin);
    fflush(stdout);
    nh_classified_free(x);
}

/* ---- other questions ---- */

static const struct {
    const char *path, *over; /* NULL: over each of the parameters in turn, the others at their values */
    nh_linear_question of;
} QUESTIONS[] = {
    {"tests/data/classify/sleigh.yaml", "a", NH_OF_MEASURE},          {"tests/data/classify/sleigh.yaml", "a", NH_OF_HAMILTONIZATION},
    {"tests/data/classify/suslov.yaml", "D", NH_OF_MEASURE},          {"tests/data/classify/suslov.yaml", "D", NH_OF_HAMILTONIZATION},
    {"tests/data/classify/veselova.yaml", "b", NH_OF_MEASURE},        {"tests/data/classify/veselova.yaml", "b", NH_OF_INTEGRABILITY},
    {"tests/data/classify/ball.yaml", "l", NH_OF_MEASURE},            {"tests/data/classify/ball.yaml", "l", NH_OF_HAMILTONIZATION},
    {"tests/data/classify/ellipsoids.yaml", "b", NH_OF_MEASURE},      {"tests/data/classify/triaxial.yaml", "b", NH_OF_MEASURE},
    {"tests/data/classify/distribution.yaml", "k", NH_OF_MEASURE},    {"tests/data/classify/distribution.yaml", "k", NH_OF_HAMILTONIZATION},
    {"tests/data/classify/distribution.yaml", "k", NH_OF_SYMMETRIES}, {"tests/data/classify/distribution.yaml", "k", NH_OF_INTEGRABILITY},
    {"tests/data/classify/oscillators.yaml", "b", NH_OF_SYMMETRIES},  {"systems/crane.yaml", NULL, NH_OF_HAMILTONIZATION},
};

/* What one run says of one parameter: adds it to the parts of a row. */
static void answer(size_t index, const char *over, nh_text *names, nh_text *special, nh_text *degenerate, size_t *number,
                   double *height)
{
    nh_error error = {0};
    nh_classify_request q = {.system_path = QUESTIONS[index].path, .over = {over}, .of = QUESTIONS[index].of};
    nh_options_default(&q.options);
    q.options.count_work = 1e10;
    nh_classified *x = nh_classify_system(&q, &error);
    if (!x) return;
    const nh_classification *c = x->classification;
    if (!c->obstacle) nh_text_addf(names, "%s%s", nh_text_string(names)[0] ? ", " : "", over);
    for (size_t k = 0; k < c->specials; k++) {
        const nh_classify_special *v = &c->special[k];
        const char *words = nh_classified_words(x, &v->polynomial);
        nh_text *to = v->degenerate ? degenerate : special;
        if (!v->degenerate && !v->first && !v->open) continue;
        nh_text_addf(to, "%s%s", nh_text_string(to)[0] ? "; " : "", words);
        if (!v->degenerate)
            nh_text_addf(to, " (%zu, %s)", v->number[v->first ? v->first : v->open].bound, !v->first ? "not decided"
                         : x->part[k].finding.complete >= v->first ? "proved" : "counted");
    }
    if (c->rows && c->row[0].height < *height) *height = c->row[0].height;
    if (c->rows) *number = c->row[0].number.bound;
    nh_classified_free(x);
}

static void question_row(size_t index)
{
    nh_error error = {0};
    nh_text names, special, degenerate;
    size_t number = 0;
    double begin = nh_clock(), height = INFINITY;
    nh_text_init(&names);
    nh_text_init(&special);
    nh_text_init(&degenerate);
    nh_system *s = nh_system_read(QUESTIONS[index].path, 0, NULL, &error);
    for (size_t i = 0; s && i < s->parameters; i++)
        if (!QUESTIONS[index].over || !strcmp(QUESTIONS[index].over, s->parameter[i].name))
            answer(index, s->parameter[i].name, &names, &special, &degenerate, &number, &height);
    printf("| %s | %s | %s | %zu | %s | %s | %.0e | %.1f |\n", s ? s->title : error.what, nh_text_string(&names),
           nh_linear_question_name(QUESTIONS[index].of), number, nh_text_string(&special)[0] ? nh_text_string(&special) : "none",
           nh_text_string(&degenerate), height, nh_clock() - begin);
    fflush(stdout);
    nh_system_free(s);
    nh_text_clear(&names);
    nh_text_clear(&special);
    nh_text_clear(&degenerate);
}

static void question_rows(void)
{
    puts("\nOther questions (`--of`), of one parameter after the other where several are named, the others at their values. Number: for almost all values the dimension of the densities of "
         "measures (1: there is one), of conformal factors, of symmetries, or of the forms that brackets of the allowed motions leave; special values with theirs. Proved: the program constructs it there "
         "and proves it exactly; counted: modulo primes.\n\n| family | over | question | number | special values | degenerate | height | s |\n|---|---|---|---|---|---|---|---|");
    for (size_t i = 0; i < sizeof QUESTIONS / sizeof *QUESTIONS; i++) question_row(i);
}

/* ---- two and three parameters ---- */

static const struct {
    const char *file, *over[3];
    double degree, planes;
    bool shape;
} SEVERAL[] = {{"henon_heiles", {"B", "eps"}, 6, 0, false},      {"quartic", {"mu", "b"}, 4, 0, false},
               {"cubic", {"c", "d"}, 4, 0, false},               {"heavy_tops", {"b", "c"}, 4, 0, true},
               {"contact_quadratic", {"b", "c"}, 2, 0, false},   {"knife_cubic", {"b", "c"}, 2, 0, false},
               {"henon_heiles", {"A", "B", "eps"}, 4, 4, false}, {"quartic_three", {"B", "mu", "b"}, 4, 4, false},
               {"cubic_three", {"b", "c", "d"}, 2, 4, false},    {"contact_three", {"a", "b", "c"}, 2, 4, false},
               {"knife_three", {"a", "b", "c"}, 2, 4, false},    {"suslov_three", {"J", "a", "b"}, 2, 2, true},
               {"tops_three", {"l", "b", "c"}, 2, 2, true}};

/* The lists of [NakagawaYoshida2001] and [AMNS2018]: all homogeneous potentials of degree three, and all real ones of degree four, that have a second
 * integral up to degree four, but for turns of the plane, as far as the families hold them; turned by complex angles some of them come again. */
static const struct {
    const char *file, *potential, *where;
} LIST[] = {
    {"cubic", "y^3/3 + d x^3, separable", "c = 0 from degree 2"},
    {"cubic", "y^3/3 + x^2 y + d x^3, separable in turned coordinates", "c - 1 = 0 from degree 2"},
    {"cubic", "y^3/3 + x^2 y/6", "(1/6, 0) from degree 2"},
    {"cubic", "y^3/3 + x^2 y/16", "(1/16, 0) from degree 4"},
    {"cubic", "y^3/3", "(0, 0) from degree 1"},
    {"cubic", "y^3/15 + x^2 y/2 + 7 i x^3/15, all times 5", "(5/2, 9*d^2 + 49 = 0 (no real value)) from degree 2"},
    {"cubic", "y^3 + x^2 y/2 + sqrt(3) i x^3/18, all divided by 3", "(1/6, 972*d^2 + 1 = 0 (no real value)) from degree 4"},
    {"cubic", "y^3/45 + x^2 y/2 + 17 sqrt(14) i x^3/90, all times 15", "(15/2, 18*d^2 + 2023 = 0 (no real value)) from degree 4"},
    {"cubic", "y^3/45 + x^2 y/2 + 3 sqrt(3) i x^3/10, all times 15", "(15/2, 4*d^2 + 243 = 0 (no real value)) from degree 4"},
    {"cubic", "y^3/10 + x^2 y/2 + 11 sqrt(3) i x^3/45, all times 10/3", "(5/3, 243*d^2 + 484 = 0 (no real value)) from degree 4"},
    {"quartic", "x^4 + mu y^4, separable", "b = 0 from degree 2"},
    {"quartic", "x^4", "(0, 0) from degree 1"},
    {"quartic", "(x^2 + y^2)^2", "(1, 2) from degree 1"},
    {"quartic", "x^4 + 6 x^2 y^2 + y^4, separable in turned coordinates", "(1, 6) from degree 2"},
    {"quartic", "x^4 + 12 x^2 y^2 + 16 y^4", "(16, 12) from degree 2"},
    {"quartic", "x^4 + 3/4 x^2 y^2 + y^4/16, the same with x and y exchanged", "(1/16, 3/4) from degree 2"},
    {"quartic", "x^4 + 6 x^2 y^2 + 8 y^4", "(8, 6) from degree 4"},
    {"quartic", "x^4 + 3/4 x^2 y^2 + y^4/8, the same with x and y exchanged", "(1/8, 3/4) from degree 4"},
};

/* What was found in a plane against the list. False: something is missing, or there is more. */
static bool compare(const char *file, size_t found, const char *items, nh_text *table)
{
    size_t listed = 0, missing = 0;
    for (size_t i = 0; i < sizeof LIST / sizeof *LIST; i++) {
        if (strcmp(LIST[i].file, file)) continue;
        bool here = strstr(items, LIST[i].where) != NULL;
        listed++;
        missing += !here;
        nh_text_addf(table, "| %s | %s | %s |\n", LIST[i].potential, LIST[i].where, here ? "yes" : "no");
    }
    if (listed) nh_text_addf(table, "| %s: found and not in the list | %zu | |\n", file, found + missing - listed);
    return !listed || (!missing && found == listed);
}

/* "(B, eps) = (1, 1/3) from degree 2": as the list has it, then with the number of integrals. */
static void put_places(const nh_classified *x, nh_text *items)
{
    const nh_classification *c = x->classification;
    size_t written = 0;
    for (size_t k = 0; k < x->places; k++) {
        const nh_classified_place *p = &x->place[k];
        nh_text where;
        nh_text_init(&where);
        for (size_t v = x->parameters; v-- > 0 && !p->dimension;)
            nh_text_addf(&where, "%s%s%s", where.length ? ", " : "(", p->value[v], v ? "" : ")");
        if (p->dimension) nh_text_addf(&where, p->on ? "(%s)" : "%s", p->where);
        nh_text_addf(&where, " from degree %zu", p->first);
        nh_text_addf(items, "%s;", nh_text_string(&where));
        printf("%s%s (%zu, %s)", k ? "; " : "", nh_text_string(&where), p->number[p->first].bound,
               p->finding.complete >= p->first ? "proved" : "counted");
        nh_text_clear(&where);
    }
    printf("%s | ", x->places ? "" : "none");
    for (size_t k = 0; k < c->specials; k++)
        if (c->special[k].degenerate) printf("%s%s", written++ ? "; " : "", nh_classified_equation(x, &c->special[k].polynomial));
}

static bool several_row(size_t index, nh_text *table)
{
    char path[200];
    nh_error error = {0};
    const char *const *over = SEVERAL[index].over;
    nh_setting setting = {.name = "A", .value = 1, .top = 1, .bottom = 1};
    snprintf(path, sizeof path, "tests/data/classify/%s.yaml", SEVERAL[index].file);
    nh_classify_request q = {.system_path = path, .settings = !strcmp(SEVERAL[index].file, "henon_heiles") && !over[2],
                             .setting = &setting, .over = {over[0], over[1], over[2]}, .shape = SEVERAL[index].shape};
    nh_options_default(&q.options);
    q.options.degree = SEVERAL[index].degree;
    q.options.planes = SEVERAL[index].planes;
    double begin = nh_clock();
    nh_classified *x = nh_classify_system(&q, &error);
    if (!x) {
        printf("| %s | %s |\n", SEVERAL[index].file, error.what);
        return false;
    }
    const nh_classification *c = x->classification;
    nh_text items;
    nh_text_init(&items);
    printf("| %s%s | ", x->title, x->shape ? ", coefficients free of cyclic coordinates" : "");
    for (size_t v = x->parameters; v-- > 0;) printf("%s%s", x->over[v], v ? ", " : "");
    printf(" | %zu | ", c->rows);
    for (size_t d = 0; d < c->rows; d++)
        printf("%s%s%zu", d ? ", " : "", c->row[d].number.bound == c->row[d].known ? "" : "<= ", c->row[d].number.bound);
    printf(" | ");
    put_places(x, &items);
    printf(" | %.0e | %.1f |\n", c->rows ? c->row[c->rows - 1].height : 0, nh_clock() - begin);
    fflush(stdout);
    bool good = over[2] ? c->rows == (size_t)SEVERAL[index].degree
                        : compare(SEVERAL[index].file, x->places, nh_text_string(&items), table);
    nh_text_clear(&items);
    nh_classified_free(x);
    return good;
}

/* ---- brute force ---- */

static bool brute_force(void)
{
    puts("\nFour of these families, with nonholonomic constraints, are to our knowledge classified nowhere else. `tests/brute_force.py` computes their numbers at single values in another way: equations of motion derived by "
         "hand, in other coordinates, all Taylor coefficients of an integral as unknowns, modulo a prime that the program does not use. It agrees at special values, beside them, and at values that are special for similar systems without constraints.\n");
    fflush(stdout);
    return system("/usr/bin/python3 tests/brute_force.py") != 0;
}

/* ---- random families ---- */

static int small(uint64_t *random) { return (int)(nh_residue_random(nh_prime_at(0), random) % 19) - 9; }

static void put_potential(nh_text *out, uint64_t *random)
{
    nh_text_add(out, "(");
    for (int degree = 2; degree <= 4; degree++)
        for (int i = 0; i <= degree; i++) nh_text_addf(out, " + (%d)*x^%d*y^%d", small(random), i, degree - i);
    nh_text_add(out, ")");
}

/* Without a value: V + eps W; with one: V is separable in turned coordinates, (b eps - a) W. How many values there are,
 * and is the planted one among them? */
static size_t random_values(uint64_t *random, bool planted, bool *found)
{
    nh_text text;
    nh_error error;
    int a = 1 + abs(small(random)) % 5, top = small(random), bottom = 1 + abs(small(random)) % 7;
    nh_error_clear(&error);
    nh_text_init(&text);
    nh_text_add(&text, "name: random\nparameters: {eps: 0.37}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (");
    if (planted)
        nh_text_addf(&text, "(%d*x + y)^4 + (%d)*(%d*x + y)^2 + (x - %d*y)^3 + (%d)*(x - %d*y)^2 + (%d*eps - (%d))*", a,
                     small(random), a, a, small(random), a, bottom, top);
    else put_potential(&text, random), nh_text_add(&text, " + eps*");
    put_potential(&text, random);
    nh_text_add(&text, ")\n");
    nh_system *s = nh_system_parse("random.yaml", nh_text_string(&text), 0, NULL, &error);
    nh_model *o = s ? nh_model_create(s, nh_chart_create(s, NH_CHART_AUTO, 1, &error), &error) : NULL;
    nh_text_clear(&text);
    if (!o) return SIZE_MAX;
    nh_classify_question q = {.parameters = 1, .degree = 4, .work = 1e10, .products = 5e10, .unknowns = 6000, .known = 1, .current = &o->E};
    nh_classification *c = nh_classify(o, &q);
    size_t values = c->rows < 4 ? SIZE_MAX : 0;
    for (size_t k = 0; k < c->specials; k++) {
        const nh_special_factor *f = &c->special[k].polynomial;
        if (!c->special[k].first) continue;
        values++;
        *found |= f->degree[0] == 1 && f->coefficient[1] * top + f->coefficient[0] * bottom == 0;
    }
    nh_classification_free(c);
    nh_model_free(o);
    nh_system_free(s);
    return values;
}

int main(int argc, char **argv)
{
    size_t each = argc > 1 ? strtoul(argv[1], NULL, 10) : 100, missed = 0, wrong = 0;
    puts("| family | over | degree | for almost all values, by degree | special values | degenerate | height | s |\n|---|---|---|---|---|---|---|---|");
    const char *only = argc > 2 ? argv[2] : NULL;
    for (size_t i = 0; i < sizeof FAMILIES / sizeof *FAMILIES; i++)
        if (!only || !strcmp(only, FAMILIES[i].file)) row(i);
    nh_text table;
    nh_text_init(&table);
    for (size_t i = 0; i < sizeof SEVERAL / sizeof *SEVERAL; i++)
        if (!only || !strcmp(only, SEVERAL[i].file)) wrong += !several_row(i, &table);
    if (nh_text_string(&table)[0])
        printf("\nAgainst the lists of all homogeneous potentials of degree three, and of all real ones of degree four, with a second integral up to degree four [NakagawaYoshida2001; AMNS2018], which hold those of [Hietarinta1987]; values of both "
               "parameters in the order of the families above.\n\n| potential | in the family | found |\n|---|---|---|\n%s", nh_text_string(&table));
    nh_text_clear(&table);
    if (!only || !strcmp(only, "questions")) question_rows();
    if (!only || !strcmp(only, "brute_force")) wrong += brute_force();
    uint64_t random = 2026;
    size_t off = wrong; /* the lists and brute force */
    for (size_t i = 0; i < 2 * each; i++) {
        bool planted = i % 2, found = false;
        size_t values = random_values(&random, planted, &found);
        missed += planted && !found;
        wrong += values != planted;
    }
    printf("\nRandom potentials of degree four in the plane, integrals up to degree four: %zu with a planted rational value, of which %zu missed; %zu without; with other values than the planted ones, or ended before: %zu.\n",
           each, missed, each, wrong - off);
    return missed + wrong > 0;
}
