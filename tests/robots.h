/* robots: robot descriptions by other means than the program's: XML by searching for words, poses by matrices of complex numbers, velocities and Jacobians
 * by complex steps (exact to rounding), derivatives of the mass matrix by differences of fourth order. */
#ifndef NH_TESTS_ROBOTS_H
#define NH_TESTS_ROBOTS_H

#include <criterion/criterion.h>

#include <complex.h>
#undef I
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_LINKS = 16, MOST_COORDINATES = 16, ROBOT_TEXT = 20000 };

typedef struct {
    double complex p[3], R[9];
} robot_pose;

typedef struct {
    char name[40], type[20];
    int parent, child, follows; /* links; the joint that it mimics, or -1 */
    double at[3], rpy[3], axis[3], factor, offset, damping;
} robot_joint;

typedef struct {
    char name[40];
    double mass, center[3], rpy[3], inertia[6];
} robot_link;

typedef struct {
    size_t links, joints, coordinates;
    robot_link link[MOST_LINKS];
    robot_joint joint[MOST_LINKS];
    int of_joint[MOST_LINKS], base[3]; /* coordinates of joints (-1: none) and of the base: x, y, heading */
    double height;
} robot;

/* ---- XML, as far as the files of the tests use it ---- */

/* The value of `attribute` in the first <tag ..> of the text; false without it. */
static inline bool robot_word(const char *text, const char *tag, const char *attribute, char *out, size_t size)
{
    char head[50], key[50];
    snprintf(head, sizeof head, "<%s ", tag);
    snprintf(key, sizeof key, " %s=\"", attribute);
    const char *at = strstr(text, head), *end = at ? strchr(at, '>') : NULL, *value = at ? strstr(at, key) : NULL;
    if (!value || value > end) return false;
    value += strlen(key);
    snprintf(out, size, "%.*s", (int)strcspn(value, "\""), value);
    return true;
}

static inline void robot_numbers(const char *text, const char *tag, const char *attribute, size_t n, double *out)
{
    char word[200], *at = word;
    if (!robot_word(text, tag, attribute, word, sizeof word)) return;
    for (size_t i = 0; i < n; i++) out[i] = strtod(at, &at);
}

/* Angles with six digits mean multiples of pi/2. */
static inline void robot_angles(const char *text, const char *tag, double out[3])
{
    robot_numbers(text, tag, "rpy", 3, out);
    for (int i = 0; i < 3; i++)
        if (fabs(out[i] - M_PI_2 * round(out[i] / M_PI_2)) < 1e-5) out[i] = M_PI_2 * round(out[i] / M_PI_2);
}

static inline int robot_index(const robot *r, const char *name, bool joint)
{
    for (size_t i = 0; i < (joint ? r->joints : r->links); i++)
        if (!strcmp(joint ? r->joint[i].name : r->link[i].name, name)) return (int)i;
    return -1;
}

/* The text between <tag ..> and </tag>, from *at on; an element that ends with /> is itself. */
static inline bool robot_element(const char **at, const char *tag, char out[ROBOT_TEXT])
{
    char head[50], tail[50];
    snprintf(head, sizeof head, "<%s ", tag);
    snprintf(tail, sizeof tail, "</%s>", tag);
    const char *begin = strstr(*at, head), *end = begin ? strchr(begin, '>') : NULL;
    if (!begin) return false;
    if (end[-1] != '/') end = strstr(begin, tail);
    snprintf(out, ROBOT_TEXT, "%.*s>", (int)(end - begin), begin);
    *at = end;
    return true;
}

static inline void robot_read(robot *r, const char *path)
{
    static char text[ROBOT_TEXT], part[ROBOT_TEXT];
    static const char *const entries[] = {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"};
    char word[40];
    FILE *file = fopen(path, "r");
    cr_assert_not_null(file, "%s", path);
    text[fread(text, 1, sizeof text - 1, file)] = 0;
    fclose(file);
    *r = (robot){.links = 0};
    for (const char *at = text; robot_element(&at, "link", part); r->links++) {
        robot_link *l = &r->link[r->links];
        robot_word(part, "link", "name", l->name, sizeof l->name);
        const char *inertial = strstr(part, "<inertial>"), *end = strstr(part, "</inertial>");
        if (!inertial) continue;
        part[end - part] = 0;
        robot_numbers(inertial, "mass", "value", 1, &l->mass);
        robot_numbers(inertial, "origin", "xyz", 3, l->center);
        robot_numbers(inertial, "origin", "rpy", 3, l->rpy);
        for (int i = 0; i < 6; i++) robot_numbers(inertial, "inertia", entries[i], 1, &l->inertia[i]);
    }
    for (const char *at = text; robot_element(&at, "joint", part); r->joints++) {
        robot_joint *j = &r->joint[r->joints];
        *j = (robot_joint){.follows = -1, .factor = 1, .axis = {1}};
        robot_word(part, "joint", "name", j->name, sizeof j->name);
        robot_word(part, "joint", "type", j->type, sizeof j->type);
        robot_word(part, "parent", "link", word, sizeof word);
        j->parent = robot_index(r, word, false);
        robot_word(part, "child", "link", word, sizeof word);
        j->child = robot_index(r, word, false);
        robot_numbers(part, "origin", "xyz", 3, j->at);
        robot_angles(part, "origin", j->rpy);
        robot_numbers(part, "axis", "xyz", 3, j->axis);
        robot_numbers(part, "dynamics", "damping", 1, &j->damping);
        robot_numbers(part, "mimic", "multiplier", 1, &j->factor);
        robot_numbers(part, "mimic", "offset", 1, &j->offset);
        if (robot_word(part, "mimic", "joint", word, sizeof word)) j->follows = robot_index(r, word, true);
    }
}

/* ---- poses ---- */

static inline robot_pose robot_product(const robot_pose *a, const robot_pose *b)
{
    robot_pose c = {.p = {a->p[0], a->p[1], a->p[2]}};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            c.p[i] += a->R[3 * i + k] * b->p[k];
            for (int j = 0; j < 3; j++) c.R[3 * i + j] += a->R[3 * i + k] * b->R[3 * k + j];
        }
    return c;
}

/* Rodrigues: R = cos 1 + sin [a] + (1 - cos) a a^T. */
static inline robot_pose robot_turn(const double axis[3], double complex angle)
{
    double size = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]), a[3] = {axis[0] / size, axis[1] / size, axis[2] / size};
    double cross[9] = {0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0};
    robot_pose t = {.p = {0}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) t.R[3 * i + j] = (i == j) * ccos(angle) + csin(angle) * cross[3 * i + j] + (1 - ccos(angle)) * a[i] * a[j];
    return t;
}

static inline robot_pose robot_place(const double at[3], const double rpy[3])
{
    static const double axis[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    robot_pose pose = robot_turn(axis[2], rpy[2]), y = robot_turn(axis[1], rpy[1]), x = robot_turn(axis[0], rpy[0]);
    pose = robot_product(&pose, &y);
    pose = robot_product(&pose, &x);
    for (int i = 0; i < 3; i++) pose.p[i] = at[i];
    return pose;
}

static inline robot_pose robot_link_pose(const robot *r, const double complex *q, int link)
{
    static const double up[3] = {0, 0, 1};
    int carrier = -1;
    for (size_t i = 0; i < r->joints; i++)
        if (r->joint[i].child == link) carrier = (int)i;
    if (carrier < 0) {
        robot_pose base = robot_turn(up, q[r->base[2]]);
        base.p[0] = q[r->base[0]];
        base.p[1] = q[r->base[1]];
        base.p[2] = r->height;
        return base;
    }
    const robot_joint *j = &r->joint[carrier];
    robot_pose pose = robot_link_pose(r, q, j->parent), step = robot_place(j->at, j->rpy);
    pose = robot_product(&pose, &step);
    if (!strcmp(j->type, "fixed")) return pose;
    double complex s = j->follows < 0 ? q[r->of_joint[carrier]] : j->factor * q[r->of_joint[j->follows]] + j->offset;
    step = robot_turn(j->axis, s);
    return robot_product(&pose, &step);
}

/* The velocity of a point fixed in a link (in its frame) and the link's angular velocity, by a complex step along v. */
static inline robot_pose robot_velocity(const robot *r, const double *q, const double *v, int link, const double point[3], double linear[3], double angular[3])
{
    const double h = 1e-200;
    double complex z[MOST_COORDINATES];
    for (size_t i = 0; i < r->coordinates; i++) z[i] = q[i] + _Complex_I * h * v[i];
    robot_pose pose = robot_link_pose(r, z, link);
    double W[9] = {0};
    for (int i = 0; i < 3; i++) {
        double complex x = pose.p[i];
        for (int k = 0; k < 3; k++) x += pose.R[3 * i + k] * point[k];
        linear[i] = cimag(x) / h;
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++) W[3 * i + j] += cimag(pose.R[3 * i + k]) / h * creal(pose.R[3 * j + k]);
    }
    angular[0] = W[7], angular[1] = W[2], angular[2] = W[3];
    return pose;
}

/* ---- dynamics ---- */

/* The mass matrix, and the potential. */
static inline double robot_mass(const robot *r, const double *q, double M[MOST_COORDINATES][MOST_COORDINATES])
{
    static const int entry[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    double potential = 0;
    size_t n = r->coordinates;
    memset(M, 0, sizeof(double) * MOST_COORDINATES * MOST_COORDINATES);
    for (size_t l = 0; l < r->links; l++) {
        const robot_link *link = &r->link[l];
        double linear[MOST_COORDINATES][3], angular[MOST_COORDINATES][3], zero[3] = {0}, in_world[9] = {0};
        robot_pose pose = {.p = {0}}, axes = robot_place(zero, link->rpy);
        for (size_t k = 0; k < n; k++) {
            double e[MOST_COORDINATES] = {0};
            e[k] = 1;
            pose = robot_velocity(r, q, e, (int)l, link->center, linear[k], angular[k]);
        }
        axes = robot_product(&pose, &axes);
        for (int i = 0; i < 9; i++)
            for (int a = 0; a < 3; a++)
                for (int b = 0; b < 3; b++) in_world[i] += creal(axes.R[3 * (i / 3) + a]) * link->inertia[entry[a][b]] * creal(axes.R[3 * (i % 3) + b]);
        for (size_t k = 0; k < n; k++)
            for (size_t m = 0; m < n; m++)
                for (int i = 0; i < 3; i++) {
                    M[k][m] += link->mass * linear[k][i] * linear[m][i];
                    for (int j = 0; j < 3; j++) M[k][m] += angular[k][i] * in_world[3 * i + j] * angular[m][j];
                }
        double z = creal(pose.p[2]);
        for (int k = 0; k < 3; k++) z += creal(pose.R[6 + k]) * link->center[k];
        potential += 9.81 * link->mass * z;
    }
    return potential;
}

static inline double robot_energy(const robot *r, const double *q, const double *v)
{
    double M[MOST_COORDINATES][MOST_COORDINATES], E = robot_mass(r, q, M);
    for (size_t k = 0; k < r->coordinates; k++)
        for (size_t m = 0; m < r->coordinates; m++) E += M[k][m] * v[k] * v[m] / 2;
    return E;
}

/* M a + dM/dt v - d/dq (v^T M v)/2 + dV/dq - Q: what the constraints must balance. */
static inline void robot_residual(const robot *r, const double *q, const double *v, const double *a, double *out)
{
    const double h = 1e-3, weight[4] = {1, -8, 8, -1}, shift[4] = {-2, -1, 1, 2};
    static double M[MOST_COORDINATES][MOST_COORDINATES];
    size_t n = r->coordinates;
    robot_mass(r, q, M);
    for (size_t i = 0; i < n; i++) {
        out[i] = 0;
        for (size_t k = 0; k < n; k++) out[i] += M[i][k] * a[k];
    }
    for (size_t c = 0; c < n; c++) /* derivatives along coordinate c */
        for (int s = 0; s < 4; s++) {
            double moved[MOST_COORDINATES], w = weight[s] / (12 * h);
            memcpy(moved, q, n * sizeof *moved);
            moved[c] += shift[s] * h;
            double V = robot_mass(r, moved, M), T = 0;
            for (size_t i = 0; i < n; i++)
                for (size_t k = 0; k < n; k++) {
                    out[i] += w * M[i][k] * v[k] * v[c];
                    T += M[i][k] * v[i] * v[k] / 2;
                }
            out[c] += w * (V - T);
        }
    for (size_t j = 0; j < r->joints; j++) { /* power of a damper: damping * rate^2 */
        int at = r->of_joint[r->joint[j].follows < 0 ? (int)j : r->joint[j].follows];
        if (at >= 0) out[at] += r->joint[j].damping * r->joint[j].factor * r->joint[j].factor * v[at];
    }
}

#endif
