/* urdf_values: numbers, places, inertias and circles of a robot description. */
#include "system/urdf_internal.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { most_words = 24, word_size = 40 };

/* ---- messages ---- */

bool nh_urdf_fail(nh_urdf_reader *u, size_t at, const char *format, ...)
{
    char what[sizeof u->error->what];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return nh_deck_fail_at(u->deck, at, u->error, "%s", what);
}

/* Words with blanks between them as an array. */
static size_t words_of(const char *list, char out[most_words][word_size], const char *names[most_words])
{
    size_t n = 0;
    for (const char *at = list; *at && n < most_words; n++) {
        size_t length = strcspn(at, " ");
        snprintf(out[n], word_size, "%.*s", (int)length, at);
        names[n] = out[n];
        at += length + (at[length] == ' ');
    }
    return n;
}

static bool among(const char *word, size_t count, const char *const *names)
{
    for (size_t i = 0; i < count; i++)
        if (!strcmp(word, names[i])) return true;
    return false;
}

const char nh_urdf_passed_over[] = "passed over";

static bool only_attributes(nh_urdf_reader *u, const nh_xml *element, const char *list)
{
    char text[most_words][word_size];
    const char *names[most_words];
    size_t n = words_of(list, text, names);
    for (size_t i = 0; i < element->attributes; i++) {
        const nh_xml_attribute *a = &element->attribute[i];
        if (among(a->name, n, names) || strchr(a->name, ':') || !strcmp(a->name, "xmlns")) continue;
        const char *near = nh_text_nearest(a->name, names, n);
        if (near && !nh_xml_get(element, near)) {
            nh_urdf_fail(u, a->at, "<%s> has no attribute `%s`", element->name, a->name);
            return nh_error_hint(u->error, "did you mean `%s`?", near);
        }
        nh_urdf_note(u, a->at, nh_urdf_passed_over, "<%s %s>", element->name, a->name);
    }
    return true;
}

bool nh_urdf_only(nh_urdf_reader *u, const nh_xml *element, const char *attributes, const char *children,
                  const char *ignored)
{
    char text[most_words][word_size], other[most_words][word_size];
    const char *names[most_words], *others[most_words];
    if (!only_attributes(u, element, attributes)) return false;
    size_t n = words_of(children, text, names), m = words_of(ignored, other, others);
    for (const nh_xml *child = element->first; child; child = child->next) {
        if (among(child->name, n, names) || among(child->name, m, others)) continue;
        if (!strncmp(child->name, "xacro:", 6)) {
            nh_urdf_fail(u, child->begin, "<%s> belongs to xacro: this file must be expanded first", child->name);
            return nh_error_hint(u->error, "xacro robot.urdf.xacro > robot.urdf");
        }
        const char *near = nh_text_nearest(child->name, names, n);
        if (near && (!element->parent || !nh_xml_child(element, near, NULL))) { /* a root has many links and joints */
            nh_urdf_fail(u, child->begin, "<%s> has no element <%s>", element->name, child->name);
            return nh_error_hint(u->error, "did you mean <%s>?", near);
        }
        nh_urdf_note(u, child->begin, nh_urdf_passed_over, "<%s>", child->name);
    }
    return true;
}

/* ---- numbers ---- */

const nh_xml_attribute *nh_urdf_need(nh_urdf_reader *u, const nh_xml *element, const char *name)
{
    const nh_xml_attribute *a = nh_xml_get(element, name);
    if (a && a->value[0]) return a;
    if (a) nh_urdf_fail(u, a->begin, "the attribute `%s` of <%s> is empty", name, element->name);
    else nh_urdf_fail(u, element->begin, "<%s> has no attribute `%s`", element->name, name);
    nh_error_hint(u->error, "write <%s %s=\"..\">", element->name, name);
    return NULL;
}

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/* "0.1, 0, 2": a comma before a blank separates, too. */
static bool separates(const char *at) { return is_blank(*at) || (*at == ',' && (is_blank(at[1]) || !at[1])); }

bool nh_urdf_numbers(nh_urdf_reader *u, const nh_xml_attribute *a, size_t count, double *value, nh_deck_node *words)
{
    size_t found = 0;
    for (const char *at = a->value; *at;) {
        size_t length = 0, begin = a->begin + (size_t)(at - a->value);
        while (at[length] && !separates(at + length)) length++;
        if (length) {
            const char *text = nh_arena_strndup(u->deck->arena, at, length);
            double x;
            if (strstr(text, "${") || strstr(text, "$(")) {
                nh_urdf_fail(u, begin, "`%s` belongs to xacro: this file must be expanded first", text);
                return nh_error_hint(u->error, "xacro robot.urdf.xacro > robot.urdf");
            }
            if (!nh_text_to_number(text, &x)) return nh_urdf_fail(u, begin, "`%s` is not a number", text);
            if (found < count) value[found] = x;
            if (found < count && words)
                nh_deck_append(u->deck, words, nh_deck_word(u->deck, text + (text[0] == '+'), begin, begin + length));
            found++;
            at += length;
        }
        while (*at && separates(at)) at++;
    }
    if (found == count) return true;
    nh_urdf_fail(u, a->begin, "`%s` has %zu number%s, not %zu", a->name, count, count == 1 ? "" : "s", found);
    return nh_error_hint(u->error, "for example %s=\"%s\"", a->name, count == 3 ? "0 0 1" : "0.1");
}

bool nh_urdf_number(nh_urdf_reader *u, const nh_xml *element, const char *name, double fallback, double *value)
{
    const nh_xml_attribute *a = nh_xml_get(element, name);
    *value = fallback;
    return !a || nh_urdf_numbers(u, a, 1, value, NULL);
}

/* ---- places ---- */

nh_urdf_pose nh_urdf_product(const nh_urdf_pose *a, const nh_urdf_pose *b)
{
    nh_urdf_pose c = {.p = {a->p[0], a->p[1], a->p[2]}};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            c.p[i] += a->R[3 * i + k] * b->p[k];
            for (int j = 0; j < 3; j++) c.R[3 * i + j] += a->R[3 * i + k] * b->R[3 * k + j];
        }
    return c;
}

/* 1 + the exponent of the last digit that is written, and how many digits there are from the first that is not 0 on,
   without zeros at the end. */
static int digits_of(const char *text, double *unit)
{
    int digits = 0, zeros = 0, decimals = 0;
    bool point = false;
    for (; *text && *text != 'e' && *text != 'E'; text++) {
        if (*text == '.') point = true;
        if (*text < '0' || *text > '9') continue;
        decimals += point;
        if (*text == '0') zeros += digits > 0;
        else digits += zeros + 1, zeros = 0;
    }
    *unit = pow(10, zeros - decimals + (*text ? atoi(text + 1) : 0));
    return digits;
}

/* People write 1.5708 for pi/2.  A number is taken for a multiple of pi/12 (with three digits: of pi/2) where that,
 * rounded or cut off after the digits that are written, gives it: otherwise an axle would lean a little, and its wheel
 * could not roll.  NULL: it is none. */
static const char *as_part_of_pi(nh_urdf_reader *u, const char *text, double x, double *exact)
{
    const double pi = 3.14159265358979323846;
    enum { parts = 12, enough_digits = 4 };
    double unit;
    int digits = digits_of(text, &unit), k = (int)lround(fmin(fmax(x, -100), 100) * parts / pi);
    if (k == 0 || digits < 3 || (digits < enough_digits && k % (parts / 2)) || fabs(x - k * pi / parts) >= unit)
        return NULL;
    *exact = k * pi / parts;
    int top = abs(k), bottom = parts;
    for (int d = 2; d <= 3; d++)
        while (top % d == 0 && bottom % d == 0) top /= d, bottom /= d;
    const char *sign = k < 0 ? "-" : "", *name = top == 1 ? nh_arena_printf(u->deck->arena, "%spi", sign)
                                                          : nh_arena_printf(u->deck->arena, "%s%d*pi", sign, top);
    return bottom == 1 ? name : nh_arena_printf(u->deck->arena, "%s/%d", name, bottom);
}

static nh_urdf_pose turned(int axis, double angle)
{
    nh_urdf_pose a = {.R = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    int i = (axis + 1) % 3, j = (axis + 2) % 3;
    a.R[4 * i] = a.R[4 * j] = cos(angle);
    a.R[3 * i + j] = -sin(angle);
    a.R[3 * j + i] = sin(angle);
    return a;
}

/* Roll, pitch and yaw are turns about fixed axes x, y, z, which is z, y, x about those that turn: R = Rz(yaw) Ry(pitch)
   Rx(roll). */
static bool rotation(nh_urdf_reader *u, const nh_xml_attribute *rpy, nh_deck_node *map, nh_urdf_pose *out)
{
    static const char *const axes[] = {"x", "y", "z"};
    double angle[3];
    nh_deck_node *words = nh_deck_new(u->deck, NH_DECK_LIST, rpy->begin, rpy->end),
                 *turns = nh_deck_new(u->deck, NH_DECK_LIST, rpy->begin, rpy->end);
    if (!nh_urdf_numbers(u, rpy, 3, angle, words)) return false;
    for (int k = 2; k >= 0; k--) {
        const nh_deck_node *word = words->item[k];
        const char *part = as_part_of_pi(u, word->text, angle[k], &angle[k]);
        if (angle[k] == 0) continue;
        if (part && map) nh_urdf_note(u, word->begin, "angles are taken exactly", "%s for %s", word->text, part);
        nh_deck_node *step = nh_deck_new_at(u->deck, NH_DECK_MAP, word);
        nh_deck_put(u->deck, step, axes[k], part ? nh_deck_word_at(u->deck, part, word) : word);
        nh_deck_append(u->deck, turns, step);
        nh_urdf_pose turn = turned(k, angle[k]);
        *out = nh_urdf_product(out, &turn);
    }
    if (turns->count && map) nh_deck_put(u->deck, map, "rotation", turns);
    return true;
}

bool nh_urdf_origin(nh_urdf_reader *u, const nh_xml *element, nh_deck_node *map, const char *place, nh_urdf_pose *out)
{
    const nh_xml *origin = nh_xml_child(element, "origin", NULL);
    *out = (nh_urdf_pose){.R = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    if (!origin) return true;
    if (!nh_urdf_only(u, origin, "xyz rpy", "", "")) return false;
    const nh_xml_attribute *xyz = nh_xml_get(origin, "xyz"), *rpy = nh_xml_get(origin, "rpy");
    if (xyz) {
        nh_deck_node *words = nh_deck_new(u->deck, NH_DECK_LIST, xyz->begin, xyz->end);
        if (!nh_urdf_numbers(u, xyz, 3, out->p, words)) return false;
        if (map && (out->p[0] != 0 || out->p[1] != 0 || out->p[2] != 0)) nh_deck_put(u->deck, map, place, words);
    }
    return !rpy || rotation(u, rpy, map, out);
}

/* ---- inertias ---- */

static const char *link_name(const nh_xml *inertia)
{
    const nh_xml_attribute *name = nh_xml_get(inertia->parent->parent, "name");
    return name ? name->value : "";
}

/* Is the symmetric matrix xx, xy, xz, yy, yz, zz positive semidefinite, up to `least` < 0 of its size? */
static bool semidefinite(const double I[6], double size, double least)
{
    double xx = I[0], xy = I[1], xz = I[2], yy = I[3], yz = I[4], zz = I[5], l = least * size;
    double determinant = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
    return xx >= l && yy >= l && zz >= l && xx * yy - xy * xy >= l * size && xx * zz - xz * xz >= l * size &&
           yy * zz - yz * yz >= l * size && determinant >= l * size * size;
}

/* Of a body: all principal moments are at least 0, and none is larger than the sum of the others.  Many files get it
 * wrong, and robots move with them as they are written: notes.  A negative moment about an axis of the frame is an
 * error. */
static bool check_inertia(nh_urdf_reader *u, const nh_xml *inertia, const double I[6])
{
    static const double least = -1e-9;
    double size = fabs(I[0]) + fabs(I[3]) + fabs(I[5]), half = (I[0] + I[3] + I[5]) / 2;
    double rest[6] = {half - I[0], -I[1], -I[2], half - I[3], -I[4], half - I[5]};
    if (I[0] < least * size || I[3] < least * size || I[5] < least * size) {
        nh_urdf_fail(u, inertia->begin, "no body has this inertia: a moment of inertia is negative");
        return nh_error_hint(u->error, "ixx, iyy and izz are positive");
    }
    if (!semidefinite(I, size, least))
        nh_urdf_note(u, inertia->begin,
                     "no body has these inertias, as one principal moment is negative: check ixy, ixz, iyz of the "
                     "links",
                     "%s", link_name(inertia));
    else if (!semidefinite(rest, size, least))
        nh_urdf_note(
            u, inertia->begin,
            "no body has these inertias, as one principal moment is larger than the sum of the other two: check the "
            "links",
            "%s", link_name(inertia));
    return true;
}

/* Residues of computations, as in ixy="2e-35", would hide symmetries: an entry that is 0 up to the rounding of the
 * others, or of mass times square metre. */
static bool is_rounding(const double I[6], double x, double mass)
{
    static const double of_others = 1e-12, of_square = 1e-15;
    return x != 0 && fabs(x) <= of_others * (fabs(I[0]) + fabs(I[3]) + fabs(I[5])) + of_square * fabs(mass);
}

/* The matrix is symmetric, and URDF has its upper half. Converters write the other one as well, equal or zero. */
static bool lower_half(nh_urdf_reader *u, const nh_xml *inertia, const double I[6])
{
    static const struct {
        const char *name, *upper;
        int of;
    } entry[] = {{"iyx", "ixy", 1}, {"izx", "ixz", 2}, {"izy", "iyz", 4}};
    for (int i = 0; i < 3; i++) {
        const nh_xml_attribute *a = nh_xml_get(inertia, entry[i].name);
        double value = 0;
        if (a && !nh_urdf_numbers(u, a, 1, &value, NULL)) return false;
        if (value != 0 && value != I[entry[i].of])
            nh_urdf_note(u, a->begin, "the matrix of inertia is symmetric, and its upper half is taken",
                         "%s differs from %s", entry[i].name, entry[i].upper);
    }
    return true;
}

static bool inertia_of(nh_urdf_reader *u, const nh_xml *inertia, double mass, nh_deck_node *body)
{
    static const char *const names[] = {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"};
    static const int place[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    double I[6];
    const nh_deck_node *entry[6];
    if (!nh_urdf_only(u, inertia, "ixx ixy ixz iyx iyy iyz izx izy izz", "", "")) return false;
    for (int i = 0; i < 6; i++) {
        const nh_xml_attribute *a = nh_xml_get(inertia, names[i]);
        nh_deck_node *words = nh_deck_new(u->deck, NH_DECK_LIST, inertia->begin, inertia->end);
        bool diagonal = names[i][1] == names[i][2];
        if (!a && diagonal && !nh_urdf_need(u, inertia, names[i])) return false;
        if (!a) nh_deck_append(u->deck, words, nh_deck_word(u->deck, "0", inertia->begin, inertia->end));
        I[i] = 0;
        if (a && !nh_urdf_numbers(u, a, 1, &I[i], words)) return false;
        entry[i] = words->item[0];
    }
    if (!lower_half(u, inertia, I)) return false;
    for (int i = 0; i < 6; i++) {
        if (!is_rounding(I, I[i], mass)) continue;
        nh_urdf_note(u, entry[i]->begin, "moments of inertia are taken for 0", "%s", entry[i]->text);
        entry[i] = nh_deck_word_at(u->deck, "0", entry[i]);
        I[i] = 0;
    }
    if (!check_inertia(u, inertia, I)) return false;
    bool products = I[1] != 0 || I[2] != 0 || I[4] != 0;
    if (!products && I[0] == 0 && I[3] == 0 && I[5] == 0) return true;
    nh_deck_node *rows = nh_deck_new(u->deck, NH_DECK_LIST, inertia->begin, inertia->end);
    for (int i = 0; i < 3; i++) {
        nh_deck_node *row = products ? nh_deck_new(u->deck, NH_DECK_LIST, inertia->begin, inertia->end) : rows;
        for (int j = 0; j < 3; j++)
            if (products || i == j) nh_deck_append(u->deck, row, entry[place[i][j]]);
        if (products) nh_deck_append(u->deck, rows, row);
    }
    nh_deck_put(u->deck, body, "inertia", rows);
    return true;
}

bool nh_urdf_inertial(nh_urdf_reader *u, const nh_xml *inertial, nh_deck_node *body, double *mass)
{
    nh_urdf_pose ignored;
    if (!nh_urdf_only(u, inertial, "", "origin mass inertia", "")) return false;
    const nh_xml *weight = nh_xml_child(inertial, "mass", NULL), *inertia = nh_xml_child(inertial, "inertia", NULL);
    if (!weight) {
        nh_urdf_fail(u, inertial->begin, "this <inertial> has no <mass>");
        return nh_error_hint(u->error, "write <mass value=\"1.5\"/>");
    }
    const nh_xml_attribute *value = nh_urdf_only(u, weight, "value", "", "") ? nh_urdf_need(u, weight, "value") : NULL;
    if (!value || !nh_urdf_numbers(u, value, 1, mass, NULL)) return false;
    if (*mass < 0) return nh_urdf_fail(u, value->begin, "a mass cannot be negative, but it is %.10g here", *mass);
    return nh_urdf_origin(u, inertial, body, "center", &ignored) && (!inertia || inertia_of(u, inertia, *mass, body));
}

/* ---- circles ---- */

/* How high a point is above the root link's origin. */
static void put_height(nh_urdf_reader *u, const nh_xml *element, double height, nh_deck_node *rim)
{
    char text[40];
    snprintf(text, sizeof text, "%.12g", height);
    nh_deck_put(u->deck, rim, "height", nh_deck_word(u->deck, text, element->begin, element->end));
}

/* The cylinder or sphere of a <collision> or <visual>; NULL: it has none. */
static const nh_xml *round_shape(const nh_xml *shape)
{
    const nh_xml *geometry = nh_xml_child(shape, "geometry", NULL),
                 *cylinder = nh_xml_child(geometry, "cylinder", NULL);
    return cylinder ? cylinder : nh_xml_child(geometry, "sphere", NULL);
}

static const nh_xml *round_child(const nh_xml *link, const char *kind)
{
    const nh_xml *shape = nh_xml_child(link, kind, NULL);
    while (shape && !round_shape(shape)) shape = nh_xml_child(link, kind, shape);
    return shape;
}

/* Is an axis of a body level, at zero displacements? */
static bool lies(const double axis[3], const double R[9])
{
    const double level = 0.1;
    double up = R[6] * axis[0] + R[7] * axis[1] + R[8] * axis[2];
    return fabs(up) < level * sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
}

static bool named_wheel(const char *name)
{
    static const char *const words[] = {"wheel", "Wheel", "WHEEL"};
    bool named = false;
    for (int i = 0; i < 3; i++) named |= strstr(name, words[i]) != NULL;
    return named;
}

nh_deck_node *nh_urdf_rim(nh_urdf_reader *u, const nh_xml *link, const double *axis, const nh_urdf_pose *zero,
                          bool continuous)
{
    const nh_xml *shape = round_child(link, "collision"), *round;
    nh_deck_node *rim = nh_deck_new(u->deck, NH_DECK_MAP, link->begin, link->end);
    nh_urdf_pose origin;
    double radius;
    const char *written = nh_xml_get(link, "name")->value;
    nh_deck_put(u->deck, rim, "written", nh_deck_word(u->deck, written, link->begin, link->end));
    if (!shape) shape = round_child(link, "visual");
    bool cylinder = shape && !strcmp(round_shape(shape)->name, "cylinder");
    if (continuous && lies(axis, zero->R) && (cylinder || named_wheel(written)))
        nh_deck_put(u->deck, rim, "like", nh_deck_word(u->deck, "wheel", link->begin, link->end));
    if (!axis || !shape) {
        nh_deck_put(u->deck, rim, "why", nh_deck_word(u->deck, "it has no cylinder or sphere", link->begin, link->end));
        put_height(u, link, zero->p[2], rim);
        return rim;
    }
    round = round_shape(shape);
    const nh_xml_attribute *a = nh_urdf_need(u, round, "radius");
    nh_deck_node *words = nh_deck_new(u->deck, NH_DECK_LIST, round->begin, round->end);
    if (!a || !nh_urdf_numbers(u, a, 1, &radius, words) || !nh_urdf_origin(u, shape, NULL, NULL, &origin)) return NULL;
    if ((origin.p[0] != 0 || origin.p[1] != 0 || origin.p[2] != 0)) {
        const nh_xml_attribute *xyz = nh_xml_get(nh_xml_child(shape, "origin", NULL), "xyz");
        nh_deck_node *at = nh_deck_new(u->deck, NH_DECK_LIST, xyz->begin, xyz->end);
        if (!nh_urdf_numbers(u, xyz, 3, origin.p, at)) return NULL;
        nh_deck_put(u->deck, rim, "at", at);
    }
    double along = 0, size = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    for (int i = 0; i < 3; i++) along += axis[i] * origin.R[3 * i + 2] / size;
    if (strcmp(round->name, "sphere") && fabs(along) < 1 - 1e-6)
        nh_deck_put(
            u->deck, rim, "why",
            nh_deck_word(u->deck, "the axis of its cylinder is not that of its joint", round->begin, round->end));
    else nh_deck_put(u->deck, rim, "radius", words->item[0]);
    nh_urdf_pose centre = nh_urdf_product(zero, &origin);
    put_height(u, round, centre.p[2], rim);
    return rim;
}
