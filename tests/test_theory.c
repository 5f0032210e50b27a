/* --equations: what is printed of the geometry, read back from the JSON, against independent values (tests/data), and against itself by other ways.
 *
 * Nothing here uses the program's own derivatives along the canonical distribution: the fields are those that the JSON prints. */
#include "oracle.h"
#include "program.h"
#include "reduced_sheet.h"
#include "sweep.h"

#include "exact/normal.h"
#include "geometry/determining.h"
#include "graph/diff.h"

static const double TIGHT = 1e-11;

typedef struct {
    place p;
    mechanics x;            /* the same system in coordinate velocities */
    cJSON *root;
    const cJSON *equations;
} sheet;

/* The JSON of a command about a system file with the parameters of a set. */
static sheet sheet_of(const char *path, const char *text, const cJSON *set, size_t n, const char *const *parameter, const char *words, ...)
{
    sheet s = {.p = place_make()};
    char copy[4096];
    char *argument[most_words] = {s.p.program};
    size_t count = 1;
    va_list list;
    char whole[2 * PATH_MAX];
    snprintf(whole, sizeof whole, "%s/%s", s.p.project, path ? path : "");
    if (path) copy_here(&s.p, whole, "system.yaml");
    else write_here(&s.p, "system.yaml", text);
    snprintf(copy, sizeof copy, "%s system.yaml --equations --velocities coordinates --json=r.json --quiet", words);
    char *settings = nh_alloc(64 * n + 1), *at = settings;
    cut_words(copy, argument, count);
    while (argument[count]) count++;
    for (size_t i = 0; i < n; i++) {
        argument[count++] = "--set";
        argument[count++] = at;
        at += sprintf(at, "%s=%.17g", parameter[i], oracle_number(set, parameter[i])) + 1;
    }
    va_start(list, words);
    for (const char *word; (word = va_arg(list, const char *));) argument[count++] = (char *)word;
    va_end(list);
    argument[count] = NULL;
    finished f = run_vector(&s.p, &(manner){0}, argument);
    cr_assert_leq(f.code, 1, "%s: %s%s", words, f.out, f.err);
    finished_clear(&f);
    nh_free(settings);
    char *json = read_here(&s.p, "r.json");
    cr_assert_null(strstr(json, "nan"));
    s.root = cJSON_Parse(json);
    free(json);
    s.equations = oracle_get(s.root, "equations");
    s.x = oracle_model(path, text, set, n, parameter);
    return s;
}

static void sheet_clear(sheet *s)
{
    cJSON_Delete(s->root);
    mechanics_clear(&s->x);
    place_clear(&s->p);
}

static const cJSON *line_of(const sheet *s, const char *section, const char *label)
{
    const cJSON *line;
    cJSON_ArrayForEach(line, oracle_get(s->equations, section))
        if (!strcmp(text_of(line, "label"), label)) return line;
    return NULL;
}

/* The coefficients of one factor in a list of terms; of an expression, for "". */
static nh_ex coefficient(const sheet *s, const cJSON *line, const char *key, const char *of)
{
    const cJSON *term;
    nh_ex sum = nh_int(s->x.model->dag, 0);
    if (!line) return sum;
    if (!of[0] && cJSON_GetObjectItem(line, "expression")) return formula(s->x.model, text_of(line, "expression"));
    cJSON_ArrayForEach(term, oracle_get(line, key))
        if (!strcmp(text_of(term, "of"), of)) sum = nh_add(s->x.model->dag, sum, formula(s->x.model, text_of(term, "coefficient")));
    return sum;
}

static nh_ex entry(const sheet *s, const char *section, const char *label, const char *of) { return coefficient(s, line_of(s, section, label), "terms", of); }

static const char *name_of(const sheet *s, size_t l) { return s->x.system->coordinate[s->x.model->chart->free[l]].name; }

/* ---- against independent values ---- */

enum { ABAR, BBAR, GAMMA, LBAR, EPS, MU, CHETAEV, KINDS };

/* Left minus right side of Chetaev's equations with the accelerations and multipliers of the data, and the size of the terms. */
static void chetaev(const sheet *s, const double *z, const double *acc, const double *ydd, const double *mu, double *got)
{
    const nh_model *o = s->x.model;
    const cJSON *line = oracle_get(s->equations, "chetaev_equations")->child;
    for (size_t i = 0; i < o->m; i++, line = line->next) {
        double left = value_at(o, coefficient(s, line, "terms", ""), z), right = 0;
        for (size_t r = 0; r < o->m; r++) {
            char of[80];
            double a = 0;
            snprintf(of, sizeof of, "%s''", o->system->coordinate[r].name);
            for (size_t l = 0; l < o->n; l++) a += o->chart->free[l] == r ? acc[l] : 0;
            for (size_t b = 0; b < o->k; b++) a += o->chart->dependent[b] == r ? ydd[b] : 0;
            left += a * value_at(o, coefficient(s, line, "terms", of), z);
        }
        for (size_t b = 0; b < o->k; b++) {
            char of[80];
            snprintf(of, sizeof of, o->k == 1 ? "mu" : "mu_%zu", b + 1);
            right += mu[b] * value_at(o, coefficient(s, line, "equals", of), z);
        }
        got[i] = left - right;
    }
}

static void entries(const sheet *s, const double *z, double *A, double *B, double *eps)
{
    const nh_model *o = s->x.model;
    char label[200];
    for (size_t l = 0; l < o->n; l++) {
        snprintf(label, sizeof label, "Abar_%s", name_of(s, l));
        A[l] = value_at(o, entry(s, "reduced_equations", label, ""), z);
        for (size_t r = l; r < o->n; r++) {
            snprintf(label, sizeof label, "Bbar_%s,%s", name_of(s, l), name_of(s, r));
            B[l * o->n + r] = B[r * o->n + l] = value_at(o, entry(s, "reduced_equations", label, ""), z);
        }
        for (size_t a = 0; a < o->k; a++) {
            snprintf(label, sizeof label, "eps_%s(g^%s)", name_of(s, l), o->system->coordinate[o->chart->dependent[a]].name);
            eps[a * o->n + l] = value_at(o, entry(s, "euler_expressions", label, ""), z);
        }
    }
}

static void semispray(const sheet *s, const double *z, double *gamma)
{
    const nh_model *o = s->x.model;
    for (size_t j = 0; j < 1 + o->m + o->n; j++) {
        char of[80];
        snprintf(of, sizeof of, "d/d%s", nh_name_of(o->dag, o->chart->symbol[j]));
        gamma[j] = value_at(o, entry(s, "semispray", "Gamma", of), z);
    }
}

static void compare(const sheet *s, const cJSON *set, const char *mu_key, const char *eps_key)
{
    static const char *const names[KINDS] = {"Abar", "Bbar", "Gamma", "Lbar", "eps'", "mu", "Chetaev"};
    const nh_model *o = s->x.model;
    size_t n = o->n, m = o->m, k = o->k;
    tally t[KINDS];
    const cJSON *point;
    double z[20], A[8], B[64], eps[64], gamma[20], want[64], acc[8], ydd[8], mu[8], got[20], zero[20] = {0};
    for (int i = 0; i < KINDS; i++) t[i] = (tally){.what = names[i]};
    cJSON_ArrayForEach(point, oracle_get(set, "points")) {
        oracle_flat(oracle_get(point, "z"), z);
        entries(s, z, A, B, eps);
        semispray(s, z, gamma);
        oracle_flat(oracle_get(point, "Abar"), want);
        tally_add(&t[ABAR], n, A, want, 0);
        oracle_flat(oracle_get(point, "Bbar"), want);
        tally_add(&t[BBAR], n * n, B, want, 0);
        oracle_flat(oracle_get(point, eps_key), want);
        if (eps_key[3] == '_') tally_add(&t[EPS], k * n, eps, want, 0);
        oracle_flat(oracle_get(point, "acc"), acc);
        oracle_flat(oracle_get(point, "ydd"), ydd);
        oracle_flat(oracle_get(point, mu_key), mu);
        want[0] = 1;
        for (size_t i = 0; i < m; i++) want[1 + i] = value_at(o, o->rho[i], z);
        memcpy(want + 1 + m, acc, n * sizeof *acc);
        tally_add(&t[GAMMA], 1 + m + n, gamma, want, 0);
        got[0] = value_at(o, entry(s, "lagrangian", "Lbar", ""), z);
        oracle_flat(oracle_get(point, "Lbar"), want);
        tally_add(&t[LBAR], 1, got, want, 0);
        for (size_t a = 0; a < k; a++) {
            char label[40];
            snprintf(label, sizeof label, k == 1 ? "mu" : "mu_%zu", a + 1);
            got[a] = value_at(o, entry(s, "chetaev_equations", label, ""), z);
        }
        tally_add(&t[MU], k, got, mu, 1e-3);
        chetaev(s, z, acc, ydd, mu, got);
        for (size_t i = 0; i < 8; i++) want[i] = fabs(acc[i < n ? i : 0]);
        tally_add(&t[CHETAEV], m, got, zero, 1 + fabs(acc[0]) + fabs(mu[0]));
    }
    for (int i = 0; i < KINDS; i++)
        if (t[i].compared) tally_check(&t[i], TIGHT, s->x.system->name);
}

static const char *const SLEIGH_PARAMETERS[] = {"m", "a", "k"};
static const char PHI2[] = "m*x'/cos(phi)*sin(phi/k) + m*a*k*phi'*cos(phi/k)";

Test(theory, sleigh_as_printed_is_the_tabulated_one, PLAIN_ONLY)
{
    cJSON *data = oracle_read("tests/data/sleigh_oracle.json");
    const cJSON *set;
    cJSON_ArrayForEach(set, oracle_get(data, "sets")) {
        sheet s = sheet_of("systems/sleigh.yaml", NULL, set, 3, SLEIGH_PARAMETERS, "verify", "--current", PHI2, NULL);
        compare(&s, set, "mu", "eps_prime_g");
        sheet_clear(&s);
    }
    cJSON_Delete(data);
}

Test(theory, thick_disk_as_printed_is_the_tabulated_one, PLAIN_ONLY)
{
    static const char *const parameter[] = {"r", "e", "M", "I1", "I3", "g"};
    cJSON *data = oracle_read("tests/data/disk_oracle.json");
    const cJSON *set;
    cJSON_ArrayForEach(set, oracle_get(data, "sets")) {
        sheet s = sheet_of(NULL, DISK, set, 6, parameter, "verify", "--current", "x1", NULL);
        compare(&s, set, "mu", "eps_prime");
        sheet_clear(&s);
    }
    cJSON_Delete(data);
}

static const char *const PROJECTILE_PARAMETERS[] = {"m", "g", "v0"};

Test(theory, nonlinear_constraint_as_printed_is_the_tabulated_one)
{
    cJSON *data = oracle_read("tests/data/nonlinear_oracle.json");
    const cJSON *set = oracle_get(oracle_get(data, "systems")->child, "sets")->child;
    sheet s = sheet_of(NULL, PROJECTILE_EXPLICIT, set, 3, PROJECTILE_PARAMETERS, "verify", "--current", "x", NULL);
    compare(&s, set, "mu", "eps_prime");
    sheet_clear(&s);
    cJSON_Delete(data);
}

/* [Gamma, Z] = a Gamma + b Z with the printed functions and the tabulated fields. */
Test(theory, a_genuine_case_2_has_the_printed_functions, PLAIN_ONLY)
{
    cJSON *data = oracle_read("tests/data/nonlinear_oracle.json");
    const cJSON *set = oracle_get(oracle_get(data, "systems")->child->next, "sets")->child, *point;
    sheet s = sheet_of(NULL, SPACE_EXPLICIT, set, 3, PROJECTILE_PARAMETERS, "verify", "--current", "atan2(y',x')", NULL);
    const nh_model *o = s.x.model;
    size_t width = 1 + o->m + o->n;
    tally t = {.what = "a Gamma + b Z"};
    compare(&s, set, "mu", "eps_prime");
    nh_ex a = entry(&s, "currents", "a(Phi)", ""), b = entry(&s, "currents", "b(Phi)", "");
    cr_assert(line_of(&s, "currents", "b(Phi)") && !nh_is_zero(o->dag, b));
    cJSON_ArrayForEach(point, oracle_get(set, "points")) {
        double z[20], gamma[20], Z[20], want[20], got[20];
        const cJSON *current = oracle_get(oracle_get(point, "currents"), "Phi_az");
        oracle_flat(oracle_get(point, "z"), z);
        oracle_flat(oracle_get(point, "Gamma"), gamma);
        oracle_flat(oracle_get(current, "Z"), Z);
        oracle_flat(oracle_get(current, "bracket_Gamma_Z"), want);
        for (size_t j = 0; j < width; j++) got[j] = value_at(o, a, z) * gamma[j] + value_at(o, b, z) * Z[j];
        tally_add(&t, width, got, want, 0);
    }
    tally_check(&t, TIGHT, "case 2");
    sheet_clear(&s);
    cJSON_Delete(data);
}

/* [Gamma, Z] and i_[Gamma,Z] phi of the case 3 of the sleigh; F_1 by the formula in components, with the printed Z:
 * F_1 = Z(Lbar_y) + (Lbar - pbar v) dZ^0/dy + pbar_l dZ^l/dy, all of which but the first vanish here. */
Test(theory, brackets_as_printed_are_the_tabulated_ones)
{
    cJSON *data = oracle_read("tests/data/sleigh_oracle.json");
    const cJSON *set = oracle_get(data, "sets")->child->next, *point;
    sheet s = sheet_of("systems/sleigh.yaml", NULL, set, 3, SLEIGH_PARAMETERS, "verify", "--current", PHI2, NULL);
    const nh_model *o = s.x.model;
    tally t[3] = {{.what = "[Gamma,Z]"}, {.what = "i phi"}, {.what = "F_1"}};
    nh_ex form = entry(&s, "currents", "i_[Gamma,Z(Phi)]phi^1", ""), F = entry(&s, "currents", "F_1(Phi)", ""), La = entry(&s, "lagrangian", "Lbar_y", "");
    cr_expect_null(line_of(&s, "currents", "b(Phi)"), "this is case 3");
    cJSON_ArrayForEach(point, oracle_get(set, "points")) {
        double z[20], want[20], got[20], Z[20], sum = 0;
        const cJSON *current = oracle_get(oracle_get(point, "currents"), "Phi2");
        oracle_flat(oracle_get(point, "z"), z);
        oracle_flat(oracle_get(current, "bracket_Gamma_Z"), want);
        for (size_t j = 0; j < 6; j++) {
            char of[80];
            snprintf(of, sizeof of, "d/d%s", nh_name_of(o->dag, o->chart->symbol[j]));
            got[j] = value_at(o, entry(&s, "currents", "[Gamma,Z(Phi)]", of), z);
        }
        tally_add(&t[0], 6, got, want, 0);
        oracle_flat(oracle_get(current, "i_bracket_phi1"), want);
        got[0] = value_at(o, form, z);
        tally_add(&t[1], 1, got, want, 0);
        oracle_flat(oracle_get(current, "Z"), Z);
        for (size_t j = 0; j < 6; j++) sum += Z[j] * value_at(o, nh_diff(o->dag, La, o->chart->symbol[j]), z);
        got[0] = value_at(o, F, z);
        tally_add(&t[2], 1, got, &sum, 0);
    }
    for (int i = 0; i < 3; i++) tally_check(&t[i], TIGHT, "sleigh");
    sheet_clear(&s);
    cJSON_Delete(data);
}

/* Along each length the parts of the inertial force, with the tabulated accelerations, are mu df/dq'. */
Test(theory, inertial_forces_sum_up_to_the_reaction)
{
    cJSON *data = oracle_read("tests/data/sleigh_oracle.json");
    const cJSON *set = oracle_get(data, "sets")->child->next, *point, *line;
    sheet s = sheet_of("systems/sleigh.yaml", NULL, set, 3, SLEIGH_PARAMETERS, "verify", "--current", PHI2, NULL);
    const nh_model *o = s.x.model;
    tally t = {.what = "inertial forces"};
    cr_expect_null(line_of(&s, "inertial_forces", "F_x^Coriolis"));
    cJSON_ArrayForEach(point, oracle_get(set, "points")) {
        double z[20], acc[4], sum[2] = {0}, want[2], mu = oracle_number(point, "mu");
        oracle_flat(oracle_get(point, "z"), z);
        oracle_flat(oracle_get(point, "acc"), acc);
        acc[2] = oracle_value(oracle_get(point, "ydd"));
        cJSON_ArrayForEach(line, oracle_get(s.equations, "inertial_forces")) {
            double *of = &sum[text_of(line, "label")[2] == 'y'];
            *of += value_at(o, coefficient(&s, line, "terms", ""), z);
            if (!cJSON_GetObjectItem(line, "terms")) continue;
            *of += acc[0] * value_at(o, coefficient(&s, line, "terms", "phi''"), z) + acc[1] * value_at(o, coefficient(&s, line, "terms", "x''"), z);
            *of += acc[2] * value_at(o, coefficient(&s, line, "terms", "y''"), z);
        }
        want[0] = -mu * tan(z[1]);
        want[1] = mu;
        tally_add(&t, 2, sum, want, 1e-3);
    }
    tally_check(&t, TIGHT, "sleigh");
    sheet_clear(&s);
    cJSON_Delete(data);
}

/* ---- the determining equations ---- */

/* A basis field as it is printed, applied to e. */
static nh_ex along(const sheet *s, const char *label, nh_ex e)
{
    const nh_model *o = s->x.model;
    const cJSON *line = line_of(s, "canonical_distribution", label);
    nh_ex sum = nh_int(o->dag, 0);
    cr_assert_not_null(line, "no field %s", label);
    for (size_t j = 0; j < 1 + o->m; j++) {
        char of[80];
        snprintf(of, sizeof of, "d/d%s", nh_name_of(o->dag, o->chart->symbol[j]));
        sum = nh_add(o->dag, sum, nh_mul(o->dag, coefficient(s, line, "terms", of), nh_diff(o->dag, e, o->chart->symbol[j])));
    }
    return sum;
}

typedef struct {
    nh_ex phi, Z0, Z[8], W[8];
} field;

static field field_of(const sheet *s)
{
    const nh_model *o = s->x.model;
    const cJSON *components = oracle_get(oracle_get(s->root, "symmetry"), "components");
    field f = {formula(o, text_of(s->root, "current")), formula(o, text_of(components, "t")), {0}, {0}};
    for (size_t l = 0; l < o->n; l++) {
        f.Z[l] = formula(o, text_of(components, name_of(s, l)));
        f.W[l] = formula(o, text_of(components, nh_name_of(o->dag, o->chart->w[l])));
    }
    return f;
}

/* Phi, Z^0, Z^x, zeta^x, Ztilde^x. */
static nh_ex unknown(const sheet *s, const field *f, const char *word, size_t length)
{
    const nh_model *o = s->x.model;
    char name[80];
    snprintf(name, sizeof name, "%.*s", (int)length, word);
    if (!strcmp(name, "Phi")) return f->phi;
    if (!strcmp(name, "Z^0")) return f->Z0;
    for (size_t l = 0; l < o->n; l++) {
        char index[80];
        snprintf(index, sizeof index, "Ztilde^%s", name_of(s, l));
        if (!strcmp(name, index)) return f->W[l];
        if (!strcmp(name, index + 5) || (name[0] == 'Z' && !strcmp(name + 1, index + 6))) return f->Z[l];
        snprintf(index, sizeof index, "zeta^%s", name_of(s, l));
        if (!strcmp(name, index)) return nh_sub(o->dag, f->Z[l], nh_mul(o->dag, o->chart->w[l], f->Z0));
    }
    cr_assert_fail("what is `%s`?", name);
    return 0;
}

/* "d_c Z^x/dphi" and the like, applied to a field. */
static nh_ex factor(const sheet *s, const field *f, const char *of)
{
    const nh_model *o = s->x.model;
    const char *stroke = strchr(of, '/');
    char label[120];
    if (!stroke) return unknown(s, f, of, strlen(of));
    const char *word = !strncmp(of, "d'_c ", 5) ? of + 5 : !strncmp(of, "d_c ", 4) ? of + 4 : of + 1;
    nh_ex e = unknown(s, f, word, (size_t)(stroke - word));
    for (size_t l = 0; l < o->n; l++)
        if (word == of + 1 && !strcmp(stroke + 2, nh_name_of(o->dag, o->chart->w[l]))) return nh_diff(o->dag, e, o->chart->w[l]);
    snprintf(label, sizeof label, "%s/d%s", word == of + 5 ? "d'_c" : "d_c", stroke + 2);
    return along(s, label, e);
}

/* The largest left side over the points, relative to its terms. */
static double violation(const sheet *s, const field *f, int number, const nh_points *points)
{
    const nh_model *o = s->x.model;
    const cJSON *line, *term;
    double worst = 0;
    size_t lines = 0;
    cJSON_ArrayForEach(line, oracle_get(s->equations, "determining_equations")) {
        if (atoi(text_of(line, "number") + (text_of(line, "number")[0] == '(')) != number) continue;
        lines++;
        nh_ex e[40];
        size_t n = 0;
        cJSON_ArrayForEach(term, oracle_get(line, "terms")) e[n++] = nh_mul(o->dag, formula(o, text_of(term, "coefficient")), factor(s, f, text_of(term, "of")));
        for (size_t p = 0; p < points->count; p++) {
            double z[20], value[40], sum = 0, size = 0;
            point_of(points, p, z);
            values_at(o, n, e, z, value);
            for (size_t i = 0; i < n; i++) sum += value[i], size += fabs(value[i]);
            worst = fmax(worst, size > 0 ? fabs(sum) / size : 0);
        }
    }
    cr_expect_eq(lines, number == 14 || number == 17 ? 1 : o->n, "%d: %zu lines", number, lines);
    return worst;
}

/* All six kinds hold for the field of a current; each kind is broken by a change of the unknowns that stand in it. */
static void check_determining(const char *path, const char *current)
{
    sheet s = sheet_of(path, NULL, NULL, 0, NULL, "verify", "--current", current, NULL);
    const nh_model *o = s.x.model;
    nh_dag *d = o->dag;
    nh_points *points = points_of(o, 12, 3);
    field f = field_of(&s), wrong = f;
    for (int number = 14; number <= 19; number++) cr_expect_leq(violation(&s, &f, number, points), 1e-9, "%s: (%d)", path, number);
    nh_ex bump = nh_add(d, o->chart->symbol[1], nh_mul(d, nh_int(d, 2), nh_mul(d, o->chart->w[0], o->chart->w[0])));
    wrong.phi = nh_add(d, f.phi, bump);
    wrong.Z0 = nh_add(d, f.Z0, bump);
    for (size_t l = 0; l < o->n; l++) wrong.W[l] = nh_add(d, f.W[l], bump);
    for (int number = 14; number <= 19; number++) cr_expect_geq(violation(&s, &wrong, number, points), 1e-4, "%s: (%d) holds for a wrong field", path, number);
    nh_points_free(points);
    sheet_clear(&s);
}

Test(theory, determining_equations_as_printed_hold_for_symmetries_and_for_no_other_field, PLAIN_ONLY)
{
    check_determining("systems/sleigh.yaml", PHI2);
    check_determining("systems/appell_hamel.yaml", "(x*y' - x'*y)/sqrt(x'^2 + y'^2)");
    check_determining("systems/nonholonomic_particle.yaml", "y - t*y'");
    check_determining("systems/skate_on_belt.yaml", "y' - (x - V*t)*th'");
    check_determining("systems/kepler.yaml", "m*(x*y' - x'*y)");
}

/* The left-hand side of an equation for a field and its current, which vanishes for a constraint symmetry. */
static nh_ex left_side(const nh_determining *all, size_t equation, nh_ex phi, nh_ex Z0, const nh_ex *zeta,
                           const nh_ex *W)
{
    const nh_model *o = all->model;
    nh_dag *d = o->dag;
    const nh_determining_equation *e = &all->equation[equation];
    nh_ex sum = nh_int(d, 0);
    for (size_t i = 0; i < e->terms; i++) {
        const nh_determining_term *t = &e->term[i];
        nh_ex of = t->of == NH_DETERMINING_PHI  ? phi
                   : t->of == NH_DETERMINING_Z0 ? Z0
                   : t->of == NH_DETERMINING_W  ? W[t->index]
                                                : zeta[t->index];
        if (t->of == NH_DETERMINING_Z) of = nh_add(d, of, nh_mul(d, o->chart->w[t->index], Z0));
        nh_ex along = t->along == NH_DETERMINING_X0  ? nh_model_X0(o, of)
                      : t->along == NH_DETERMINING_X ? nh_model_X(o, t->direction, of)
                      : t->along == NH_DETERMINING_Y ? nh_model_Y(o, t->direction, of)
                                                     : of;
        sum = nh_add(d, sum, nh_mul(d, t->coefficient, along));
    }
    return sum;
}

/* In quasi-velocities alone, and with two affine constraints: the same equations, without the JSON between. */
Test(theory, determining_equations_in_any_chart, PLAIN_ONLY)
{
    mechanics all[] = {mechanics_of_text(AFFINE, NH_CHART_QUASI), mechanics_of_text(AFFINE, NH_CHART_COORDINATES), mechanics_of_text(TURNTABLE, NH_CHART_COORDINATES)};
    nh_arena *arena = nh_arena_create();
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        const nh_model *o = all[i].model;
        nh_determining *list = nh_determining_of(arena, o);
        nh_points *points = points_of(o, 8, 3);
        nh_ex one = nh_int(o->dag, 1), zeta[8], W[8], zero[8];
        /* Z = Gamma/Lbar has the current 1, whatever the system is */
        nh_ex Z0 = nh_div(o->dag, one, o->Lbar);
        for (size_t l = 0; l < o->n; l++) zeta[l] = zero[l] = nh_int(o->dag, 0), W[l] = nh_mul(o->dag, Z0, o->a[l]);
        for (size_t e = 0; e < list->count; e++) {
            nh_ex good = left_side(list, e, one, Z0, zeta, W), bad = left_side(list, e, o->E, o->E, W, zero);
            double size = 0;
            for (size_t p = 0; p < points->count; p++) {
                double z[20];
                point_of(points, p, z);
                cr_expect_float_eq(value_at(o, good, z), 0, 1e-8, "%s: equation %zu", o->system->name, e);
                size = fmax(size, fabs(value_at(o, bad, z)));
            }
            cr_expect_gt(size, 1e-6, "%s: equation %zu holds for anything", o->system->name, e);
        }
        nh_points_free(points);
        mechanics_clear(&all[i]);
    }
    nh_arena_free(arena);
}

/* ---- as text, page and LaTeX ---- */

Test(theory, the_geometry_is_80_columns_wide_and_there_when_it_is_wanted)
{
    place p = place_with_systems();
    finished f = run_expecting(&p, "verify rolling_disk --current p'+s'*cos(h) --equations", 1);
    const char *at = strstr(f.out, "Canonical distribution");
    cr_assert_not_null(at);
    for (const char *end; *at; at = *end ? end + 1 : end) {
        end = at + strcspn(at, "\n");
        cr_expect_leq(end - at, 80, "%.*s", (int)(end - at), at);
    }
    finished_clear(&f);
    f = run_expecting(&p, "verify sleigh --current m*(a^2*k^2*omega^2+v^2)", 0);
    cr_expect_null(strstr(f.out, "Canonical distribution"));
    finished_clear(&f);
    place_clear(&p);
}

/* ---- the reduction ---- */

#include "base/linalg.h"
#include "graph/dag.h"
#include "graph/node.h"

static size_t crane_settings(const cJSON *set, nh_setting *setting)
{
    const cJSON *parameter;
    size_t n = 0;
    cJSON_ArrayForEach(parameter, oracle_get(set, "params")) setting[n++] = (nh_setting){.name = parameter->string, .value = parameter->valuedouble};
    return n;
}

static const char *const BASE[4] = {"psi1", "psi2", "phi1", "phi2"}; /* the order of the data */

/* Khat, Upsilon, H(x, p) and the momenta of the group, of the first stage. */
Test(theory, first_stage_of_the_crane_as_printed_is_the_tabulated_one, PLAIN_ONLY)
{
    cJSON *data = oracle_read("tests/data/crane_oracle.json");
    const cJSON *set = oracle_get(data, "sets")->child, *point;
    nh_setting setting[20];
    size_t n = crane_settings(set, setting);
    reduced_sheet s = reduced_of("systems/crane.yaml", n, setting, " --group 1,2,5,6", 0);
    tally t[4] = {{.what = "Khat"}, {.what = "Upsilon12"}, {.what = "kinetic energy"}, {.what = "lift"}};
    cJSON_ArrayForEach(point, oracle_get(set, "points")) {
        double q[8], v[8], want[16], got[16], p[4], sum = 0, energy = 0;
        char label[80];
        oracle_flat(oracle_get(point, "q_full"), q);
        oracle_flat(oracle_get(point, "qdot_full"), v);
        set_state(&s, q, v);
        for (size_t i = 0; i < 16; i++) {
            snprintf(label, sizeof label, "Khat_%s,%s", BASE[i / 4], BASE[i % 4]);
            got[i] = shown_value(&s, "hamiltonian", label, "");
            snprintf(label, sizeof label, "Khat_%s,%s", BASE[i % 4], BASE[i / 4]);
            if (got[i] == 0) got[i] = shown_value(&s, "hamiltonian", label, "");
        }
        oracle_flat(oracle_get(point, "Khat"), want);
        tally_add(&t[0], 16, got, want, 0);
        for (size_t k = 0; k < 4; k++) {
            char speed[20];
            snprintf(speed, sizeof speed, "%s'", BASE[k]);
            sum += shown_value(&s, "gyroscopic_form", "Upsilon_psi1,psi2", speed) * value_of(&s, speed);
        }
        oracle_flat(oracle_get(point, "Upsilon12"), want);
        tally_add(&t[1], 1, &sum, want, 0);
        oracle_flat(oracle_get(point, "phat"), p); /* H = 1/2 p x' there: no potential */
        sum = 0;
        for (size_t i = 0; i < 4; i++) {
            char speed[20];
            snprintf(speed, sizeof speed, "%s'", BASE[i]);
            energy += p[i] * value_of(&s, speed) / 2;
            for (size_t j = 0; j < 4; j++) {
                snprintf(label, sizeof label, i == j ? "p_%s^2" : "p_%s p_%s", BASE[i], BASE[j]);
                sum += shown_value(&s, "hamiltonian", "Hhat", label) * p[i] * p[j];
            }
        }
        tally_add(&t[2], 1, &sum, &energy, 0);
        /* psi3' = -A^3 x' on the motion: e_3 of the list is d/dpsi3 */
        got[0] = -shown_value(&s, "connection", "Ahat_psi1^3", "") * value_of(&s, "psi1'") - shown_value(&s, "connection", "Ahat_psi2^3", "") * value_of(&s, "psi2'");
        want[0] = value_of(&s, "psi3'");
        tally_add(&t[3], 1, got, want, 0);
    }
    for (int i = 0; i < 4; i++) tally_check(&t[i], TIGHT, "crane");
    reduced_clear(&s);
    cJSON_Delete(data);
}

Test(theory, second_stage_of_the_crane_as_printed_is_the_tabulated_one, PLAIN_ONLY)
{
    cJSON *data = oracle_read("tests/data/crane_oracle.json");
    const cJSON *set = oracle_get(data, "sets")->child, *point;
    nh_setting setting[20];
    size_t n = crane_settings(set, setting);
    reduced_sheet s = reduced_of("systems/crane.yaml", n, setting, " --group 1,2,3,5,6", 1);
    tally t = {.what = "Abreve, Xi"};
    cJSON_ArrayForEach(point, oracle_get(set, "points")) {
        double q[8], v[8], want[4], got[3];
        oracle_flat(oracle_get(point, "q_full"), q);
        oracle_flat(oracle_get(point, "qdot_full"), v);
        set_state(&s, q, v);
        got[0] = shown_value(&s, "mechanical_connection", "Abreve_psi1^1", "");
        got[1] = shown_value(&s, "mechanical_connection", "Abreve_psi2^1", "");
        got[2] = shown_value(&s, "magnetic_form", "Xi_psi1,psi2", "theta_1");
        oracle_flat(oracle_get(point, "Abreve"), want);
        want[2] = oracle_number(point, "Xi12_over_vartheta");
        tally_add(&t, 3, got, want, 0);
    }
    tally_check(&t, TIGHT, "crane");
    reduced_clear(&s);
    cJSON_Delete(data);
}

/* ---- the whole group: the printed equations along the stage's own motion ---- */

typedef struct {
    reduced_sheet *s;
    size_t n, r, d, dim;              /* shape, velocities, group, S */
    size_t x[8], dx[8], w[12], nu[12]; /* places of the symbols; of dx: SIZE_MAX where x' is a velocity w already */
    const cJSON *momentum, *equations, *velocity;
} bundle;

static size_t place_of(const reduced_sheet *s, const char *name)
{
    for (size_t i = 0; i < s->symbols; i++)
        if (!strcmp(nh_name_of(s->system->dag, s->symbol[i]), name)) return i;
    return SIZE_MAX;
}

static bundle bundle_of(reduced_sheet *s)
{
    static char names[12][32];
    bundle b = {.s = s, .momentum = oracle_get(s->stage, "momentum"), .equations = oracle_get(s->stage, "equations"), .velocity = oracle_get(s->stage, "group_velocity")};
    const cJSON *item;
    cJSON_ArrayForEach(item, oracle_get(s->stage, "shape")) {
        char speed[80];
        snprintf(speed, sizeof speed, "%s'", item->valuestring);
        b.x[b.n] = place_of(s, item->valuestring);
        b.dx[b.n++] = place_of(s, speed);
    }
    cJSON_ArrayForEach(item, oracle_get(s->stage, "velocities")) {
        size_t at = place_of(s, item->valuestring);
        b.w[b.r++] = at < SIZE_MAX ? at : own_name(s, item->valuestring);
    }
    b.d = (size_t)cJSON_GetArraySize(b.velocity);
    cJSON_ArrayForEach(item, oracle_get(s->geometry, "connection")) b.dim += !strncmp(text_of(item, "label"), "chi_", 4);
    for (size_t p = 0; p < b.dim; p++) {
        snprintf(names[p], sizeof names[p], "nu_%zu", p + 1);
        b.nu[p] = own_name(s, names[p]);
    }
    return b;
}

static double numbered(const bundle *b, const char *section, const char *label, size_t i, const char *of, size_t j)
{
    char name[80], factor[80];
    snprintf(name, sizeof name, "%s_%zu", label, i + 1);
    snprintf(factor, sizeof factor, of[0] ? "%s_%zu" : "", of, j + 1);
    return shown_value(b->s, section, name, factor);
}

/* (x, w) into the symbols, with x' where it is not one of w, and nu from zeta + A x' = nu chi; M (r x r), F and x' on demand. */
static void bundle_state(const bundle *b, const double *x, const double *w, double *M, double *F, double *dx)
{
    reduced_sheet *s = b->s;
    const cJSON *item;
    for (size_t i = 0; i < b->n; i++) s->value[b->x[i]] = x[i];
    for (size_t j = 0; j < b->r && M; j++) {
        size_t i = 0;
        for (size_t k = 0; k < b->r; k++) s->value[b->w[k]] = k == j;
        cJSON_ArrayForEach(item, b->momentum) M[i++ + j * b->r] = value_of(s, text_of(item, "value"));
    }
    for (size_t k = 0; k < b->r; k++) s->value[b->w[k]] = w[k];
    size_t at = 0;
    cJSON_ArrayForEach(item, b->equations) {
        size_t of = place_of(s, text_of(item, "of"));
        for (size_t i = 0; i < b->n; i++)
            if (of == b->x[i]) s->value[b->dx[i]] = value_of(s, text_of(item, "rate"));
        if (of == SIZE_MAX && F) F[at++] = value_of(s, text_of(item, "rate"));
    }
    for (size_t i = 0; i < b->n && dx; i++) dx[i] = s->value[b->dx[i]];
    double N[144] = {0}, right[12] = {0}, rcond;
    for (size_t a = 0; a < b->d; a++) {
        double v = value_of(s, text_of(cJSON_GetArrayItem(b->velocity, (int)a), "value"));
        for (size_t i = 0; i < b->n; i++) {
            char label[80];
            snprintf(label, sizeof label, "A_%s^%zu", nh_name_of(s->system->dag, s->symbol[b->x[i]]), a + 1);
            v += shown_value(s, "connection", label, "") * s->value[b->dx[i]];
        }
        for (size_t p = 0; p < b->dim; p++) {
            right[p] += numbered(b, "connection", "chi", p, "e", a) * v;
            for (size_t q = 0; q < b->dim; q++) N[p + q * b->dim] += numbered(b, "connection", "chi", p, "e", a) * numbered(b, "connection", "chi", q, "e", a);
        }
    }
    if (b->dim) cr_assert(nh_solve(b->dim, N, 1, right, &rcond));
    for (size_t p = 0; p < b->dim; p++) s->value[b->nu[p]] = right[p];
}

/* mu (d) and pi (n) in the present state. */
static void bundle_momenta(const bundle *b, double *out)
{
    for (size_t a = 0; a < b->d; a++) *out++ = numbered(b, "lagrangian", "mu", a, "", 0);
    for (size_t i = 0; i < b->n; i++) {
        char label[80];
        snprintf(label, sizeof label, "pi_%s", nh_name_of(b->s->system->dag, b->s->symbol[b->x[i]]));
        *out++ = shown_value(b->s, "lagrangian", label, "");
    }
}

/* mu' and pi' along the motion, by differences of the momenta a step before and behind. */
static void bundle_rates(const bundle *b, const double *x, const double *w, double *out)
{
    static const double step = 1e-5;
    double M[144], F[12], dx[8], p[12], side[2][20], rcond;
    bundle_state(b, x, w, M, F, dx);
    for (size_t i = 0; i < b->r; i++) {
        p[i] = 0;
        for (size_t j = 0; j < b->r; j++) p[i] += M[i + j * b->r] * w[j];
    }
    for (int k = 0; k < 2; k++) {
        double at[8], q[12], h = k ? step : -step;
        for (size_t i = 0; i < b->n; i++) at[i] = x[i] + h * dx[i];
        for (size_t i = 0; i < b->r; i++) q[i] = p[i] + h * F[i];
        bundle_state(b, at, w, M, NULL, NULL);
        cr_assert(nh_solve(b->r, M, 1, q, &rcond));
        bundle_state(b, at, q, NULL, NULL, NULL);
        bundle_momenta(b, side[k]);
    }
    for (size_t i = 0; i < b->d + b->n; i++) out[i] = (side[1][i] - side[0][i]) / (2 * step);
    bundle_state(b, x, w, NULL, NULL, NULL);
}

static double sum_of(const bundle *b, const cJSON *terms, const double *rate)
{
    const cJSON *term;
    double sum = 0;
    cJSON_ArrayForEach(term, terms) {
        const char *of = text_of(term, "of");
        double c = value_of(b->s, text_of(term, "coefficient"));
        if (!of[0]) sum += c;
        else if (!strncmp(of, "mu'_", 4)) sum += c * rate[atoi(of + 4) - 1];
        else if (!strncmp(of, "mu_", 3)) sum += c * numbered(b, "lagrangian", "mu", (size_t)atoi(of + 3) - 1, "", 0);
        else {
            cr_assert_eq(strncmp(of, "pi'_", 4), 0, "what is %s?", of);
            for (size_t i = 0; i < b->n; i++)
                if (!strcmp(of + 4, nh_name_of(b->s->system->dag, b->s->symbol[b->x[i]]))) sum += c * rate[b->d + i];
        }
    }
    return sum;
}

static void check_bundle(const char *file, const char *line, size_t stage, size_t n, size_t dim)
{
    reduced_sheet s = reduced_of(file, 0, NULL, line, stage);
    bundle b = bundle_of(&s);
    cr_assert(b.n == n && b.dim == dim, "%s: %zu shape coordinates, S of dimension %zu", file, b.n, b.dim);
    double x[8], w[12], rate[20], largest = 0;
    for (int trial = 0; trial < 3; trial++) {
        size_t p = 0;
        const cJSON *equation, *part;
        for (size_t i = 0; i < b.n; i++) x[i] = 0.7 + 0.31 * (double)i - 0.17 * trial;
        for (size_t i = 0; i < b.r; i++) w[i] = 0.9 - 0.37 * (double)i + 0.23 * trial;
        bundle_rates(&b, x, w, rate);
        for (size_t a = 0; a < b.d + b.n; a++) largest = fmax(largest, fabs(rate[a]));
        for (size_t a = 0; a < b.d; a++) /* omega is the group's velocity */
            cr_expect_float_eq(numbered(&b, "lagrangian", "omega", a, "", 0), value_of(&s, text_of(cJSON_GetArrayItem(b.velocity, (int)a), "value")), 1e-10, "%s: omega_%zu", file, a + 1);
        cJSON_ArrayForEach(equation, oracle_get(s.geometry, "equations")) {
            double left = sum_of(&b, oracle_get(equation, "terms"), rate), right = sum_of(&b, oracle_get(equation, "equals"), rate), whole = 0;
            cr_expect_float_eq(left, right, 1e-6 * (1 + fabs(left)), "%s: equation %zu: %.9g, %.9g", file, p, left, right);
            char mine[32];
            snprintf(mine, sizeof mine, "chi_%zu;", ++p);
            if (p > b.dim) continue;
            cJSON_ArrayForEach(part, oracle_get(s.geometry, "by_stages"))
                if (strstr(text_of(part, "label"), mine)) whole += sum_of(&b, cJSON_GetObjectItem(part, "terms"), rate);
            cr_expect_float_eq(whole, right, 1e-10 * (1 + fabs(right)), "%s: by stages, equation %zu: %.12g, %.12g", file, p, whole, right);
        }
        cr_expect_eq(p, b.n + b.dim);
    }
    cr_expect_gt(largest, 1e-3, "%s: nothing happens", file);
    reduced_clear(&s);
}

Test(theory, the_whole_group_at_once_and_by_stages_as_printed_along_its_own_motion, WHOLE_ONLY)
{
    check_bundle("systems/euler_disk.yaml", "", 1, 1, 2);
    check_bundle("systems/euler_disk.yaml", " --group 1,2,3 --chain 1;2,3", 1, 2, 1);
    check_bundle("systems/euler_disk.yaml", " --inner 1,4=1/3;2,4=-1/5;3,2=2/7;4,4=2;1,1=5/4", 1, 1, 2);
    check_bundle("systems/euler_disk.yaml", " --group 1,2,3 --chain 1;2,3 --inner 1,2=1/3;1,3=r^2/7", 1, 2, 1);
    check_bundle("systems/euler_top.yaml", " --inner 1,2=1/3;2,3=1/4", 0, 0, 3);
    check_bundle("systems/snakeboard.yaml", "", 0, 1, 2);
    check_bundle("systems/chaplygin_ball.yaml", "", 2, 2, 1);
    check_bundle("systems/sleigh_inertia.yaml", "", 1, 0, 2);
    check_bundle("systems/euler_top.yaml", "", 0, 0, 3);
}

/* Each subgroup normal in the one before, and not in the whole group: shifts along one line of the plane. */
Test(theory, a_subnormal_chain_as_printed, PLAIN_ONLY)
{
    check_bundle("systems/euler_disk.yaml", " --chain 4;1;2;3", 1, 1, 2);
    check_bundle("systems/euler_disk.yaml", " --chain 4;1;2;3 --inner 1,4=1/3;2,4=-1/5;3,2=2/7;4,4=2;1,1=5/4", 1, 1, 2);
}
