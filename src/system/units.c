#include "system/units.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"

enum { longest_name = 24, deepest = 20 };

typedef struct {
    const char *name;
    signed char power[NH_UNIT_BASES]; /* m, kg, s, A, K, mol, cd */
    double scale;
    bool clock;
} named;

#define TURN 6.283185307179586
/* Those that take prefixes (the SI brochure of the BIPM), and those that do not. */
static const named scaled[] = {{"m", {1}, 1, 0},
                               {"g", {0, 1}, 1e-3, 0},
                               {"s", {0, 0, 1}, 1, 0},
                               {"A", {0, 0, 0, 1}, 1, 0},
                               {"K", {0, 0, 0, 0, 1}, 1, 0},
                               {"mol", {0, 0, 0, 0, 0, 1}, 1, 0},
                               {"cd", {0, 0, 0, 0, 0, 0, 1}, 1, 0},
                               {"rad", {0}, 1, 0},
                               {"sr", {0}, 1, 0},
                               {"Hz", {0, 0, -1}, 1, 0},
                               {"N", {1, 1, -2}, 1, 0},
                               {"Pa", {-1, 1, -2}, 1, 0},
                               {"J", {2, 1, -2}, 1, 0},
                               {"W", {2, 1, -3}, 1, 0},
                               {"C", {0, 0, 1, 1}, 1, 0},
                               {"V", {2, 1, -3, -1}, 1, 0},
                               {"F", {-2, -1, 4, 2}, 1, 0},
                               {"ohm", {2, 1, -3, -2}, 1, 0},
                               {"\u03a9", {2, 1, -3, -2}, 1, 0},
                               {"\u2126", {2, 1, -3, -2}, 1, 0},
                               {"S", {-2, -1, 3, 2}, 1, 0},
                               {"Wb", {2, 1, -2, -1}, 1, 0},
                               {"T", {0, 1, -2, -1}, 1, 0},
                               {"H", {2, 1, -2, -2}, 1, 0},
                               {"lm", {0, 0, 0, 0, 0, 0, 1}, 1, 0},
                               {"lx", {-2, 0, 0, 0, 0, 0, 1}, 1, 0},
                               {"Bq", {0, 0, -1}, 1, 0},
                               {"Gy", {2, 0, -2}, 1, 0},
                               {"Sv", {2, 0, -2}, 1, 0},
                               {"kat", {0, 0, -1, 0, 0, 1}, 1, 0},
                               {"eV", {2, 1, -2}, 1.602176634e-19, 0},
                               {"bar", {-1, 1, -2}, 1e5, 0},
                               {"L", {3}, 1e-3, 0},
                               {"l", {3}, 1e-3, 0},
                               {"t", {0, 1}, 1e3, 0},
                               {"cal", {2, 1, -2}, 4.184, 0},
                               {"Wh", {2, 1, -2}, 3600, 0},
                               {"pc", {1}, 3.0856775814913673e16, 0}};
static const named plain[] = {{"min", {0, 0, 1}, 60, 1},
                              {"h", {0, 0, 1}, 3600, 1},
                              {"d", {0, 0, 1}, 86400, 1},
                              {"yr", {0, 0, 1}, 31557600, 1},
                              {"deg", {0}, TURN / 360, 0},
                              {"\u00b0", {0}, TURN / 360, 0},
                              {"arcmin", {0}, TURN / 21600, 0},
                              {"arcsec", {0}, TURN / 1296000, 0},
                              {"rev", {0}, TURN, 0},
                              {"turn", {0}, TURN, 0},
                              {"rpm", {0, 0, -1}, TURN / 60, 1},
                              {"au", {1}, 149597870700, 0},
                              {"ha", {2}, 1e4, 0},
                              {"u", {0, 1}, 1.66053906660e-27, 0},
                              {"Da", {0, 1}, 1.66053906660e-27, 0},
                              {"atm", {-1, 1, -2}, 101325, 0},
                              {"in", {1}, 0.0254, 0},
                              {"ft", {1}, 0.3048, 0},
                              {"mi", {1}, 1609.344, 0},
                              {"lb", {0, 1}, 0.45359237, 0},
                              {"lbf", {1, 1, -2}, 4.4482216152605, 0},
                              {"psi", {-1, 1, -2}, 6894.757293168361, 0},
                              {"hp", {2, 1, -3}, 745.6998715822702, 0},
                              {"%", {0}, 0.01, 0},
                              {"degC", {0, 0, 0, 0, 1}, 1, 0},
                              {"\u00b0C", {0, 0, 0, 0, 1}, 1, 0}};
static const struct {
    const char *name;
    double scale;
} prefixes[] = {{"k", 1e3},   {"m", 1e-3},  {"c", 1e-2},      {"d", 1e-1},      {"da", 1e1}, {"h", 1e2},
                {"M", 1e6},   {"G", 1e9},   {"T", 1e12},      {"P", 1e15},      {"E", 1e18}, {"Z", 1e21},
                {"Y", 1e24},  {"u", 1e-6},  {"\u00b5", 1e-6}, {"\u03bc", 1e-6}, {"n", 1e-9}, {"p", 1e-12},
                {"f", 1e-15}, {"a", 1e-18}, {"z", 1e-21},     {"y", 1e-24}};
/* Words that people write for units: refused, with the symbol as a suggestion. */
static const char *const words[][2] = {
    {"meter", "m"},    {"metre", "m"},     {"meters", "m"},  {"metres", "m"},   {"kilogram", "kg"},
    {"gram", "g"},     {"second", "s"},    {"seconds", "s"}, {"sec", "s"},      {"newton", "N"},
    {"joule", "J"},    {"watt", "W"},      {"volt", "V"},    {"ampere", "A"},   {"amp", "A"},
    {"tesla", "T"},    {"hertz", "Hz"},    {"pascal", "Pa"}, {"degree", "deg"}, {"degrees", "deg"},
    {"radian", "rad"}, {"radians", "rad"}, {"hour", "h"},    {"minute", "min"}, {"kelvin", "K"}};
enum {
    scaled_count = sizeof scaled / sizeof *scaled,
    plain_count = sizeof plain / sizeof *plain,
    prefix_count = sizeof prefixes / sizeof *prefixes,
    word_count = sizeof words / sizeof *words
};

/* ---- what units stand for ---- */

static const nh_unit one = {.scale = 1};

nh_unit nh_unit_product(nh_unit a, nh_unit b, double power)
{
    for (int i = 0; i < NH_UNIT_BASES; i++) a.power[i] += power * b.power[i];
    a.scale *= pow(b.scale, power);
    a.clock |= b.clock;
    return a;
}

bool nh_unit_equal(nh_unit a, nh_unit b)
{
    static const double rounding = 1e-9;
    for (int i = 0; i < NH_UNIT_BASES; i++)
        if (fabs(a.power[i] - b.power[i]) > rounding) return false;
    return !(fabs(a.scale / b.scale - 1) > rounding); /* also where one is not known */
}

static void print_powers(nh_unit unit, int sign, bool *some, nh_text *out)
{
    static const char *const names[] = {"m", "kg", "s", "A", "K", "mol", "cd"};
    static const int order[] = {NH_UNIT_KILOGRAM, NH_UNIT_METRE, NH_UNIT_SECOND, NH_UNIT_AMPERE,
                                NH_UNIT_KELVIN,   NH_UNIT_MOLE,  NH_UNIT_CANDELA};
    static const double least = 1e-9;
    for (int i = 0; i < NH_UNIT_BASES; i++) {
        double power = sign * unit.power[order[i]];
        if (power < least) continue;
        nh_text_addf(out, "%s%s", *some ? " " : "", names[order[i]]);
        if (fabs(power - 1) > least) nh_text_addf(out, power == floor(power) ? "^%g" : "^(%g)", power);
        *some = true;
    }
}

void nh_unit_print(nh_unit unit, nh_text *out)
{
    bool above = false, below = false;
    double scale = isnan(unit.scale) ? 1 : unit.scale;
    nh_text bottom;
    nh_text_init(&bottom);
    print_powers(unit, -1, &below, &bottom);
    if (fabs(scale - 1) > 1e-9) nh_text_addf(out, "%.6g", scale), above = true;
    print_powers(unit, 1, &above, out);
    if (!above) nh_text_add(out, "1");
    if (below) nh_text_addf(out, strchr(nh_text_string(&bottom), ' ') ? "/(%s)" : "/%s", nh_text_string(&bottom));
    nh_text_clear(&bottom);
}

static bool is_in(size_t n, const named *list, const char *name, double scale, nh_unit *out)
{
    for (size_t i = 0; i < n; i++) {
        if (strcmp(list[i].name, name)) continue;
        *out = one;
        for (int k = 0; k < NH_UNIT_BASES; k++) out->power[k] = list[i].power[k];
        out->scale = scale * list[i].scale;
        out->clock = list[i].clock || (scale != 1 && (!strcmp(name, "s") || !strcmp(name, "Hz")));
        return true;
    }
    return false;
}

static bool is_name(const char *name, nh_unit *out)
{
    if (is_in(scaled_count, scaled, name, 1, out) || is_in(plain_count, plain, name, 1, out)) return true;
    for (size_t i = 0; i < prefix_count; i++) {
        size_t n = strlen(prefixes[i].name);
        if (!strncmp(name, prefixes[i].name, n) && is_in(scaled_count, scaled, name + n, prefixes[i].scale, out))
            return true;
    }
    return false;
}

/* One letter resembles every other one: only longer names are compared. */
static const char *nearest(const char *name)
{
    static const char *const common[] = {"kg",     "mm",     "cm",  "km",  "ms",   "kHz", "MHz", "kN",  "mN",
                                         "mol",    "rad",    "Hz",  "Pa",  "kPa",  "MPa", "kJ",  "kW",  "mV",
                                         "kV",     "mA",     "Wb",  "ohm", "bar",  "eV",  "min", "deg", "rpm",
                                         "arcmin", "arcsec", "atm", "lbf", "turn", "rev"};
    for (size_t i = 0; i < word_count; i++)
        if (!strcmp(words[i][0], name)) return words[i][1];
    return strlen(name) < 2 ? NULL : nh_text_nearest(name, common, sizeof common / sizeof *common);
}

/* ---- reading ---- */

typedef struct {
    const char *text, *at;
    nh_unit_fault *fault;
} reader;

static bool fail(reader *r, const char *where, size_t length, const char *near)
{
    *r->fault = (nh_unit_fault){(size_t)(where - r->text), length, near};
    return false;
}

static void blanks(reader *r)
{
    while (*r->at == ' ') r->at++;
}

static bool take(reader *r, const char *sign)
{
    size_t n = strlen(sign);
    if (strncmp(r->at, sign, n)) return false;
    r->at += n;
    return true;
}

/* A sign of a superscript; its value is added to those before it. */
static bool superscript(reader *r, double *value)
{
    static const char *const signs[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                        "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    for (size_t i = 0; i < sizeof signs / sizeof *signs; i++)
        if (take(r, signs[i])) return *value = 10 * *value + (double)i, true;
    return false;
}

static bool superscripts(reader *r, double *value)
{
    bool minus = take(r, "\u207b"), some = false;
    *value = 0;
    while (superscript(r, value)) some = true;
    if (minus) *value = -*value;
    return some || minus;
}

static bool digits(reader *r, double *value)
{
    const char *from = r->at;
    while (isdigit((unsigned char)*r->at) || (*r->at == '.' && r->at > from)) r->at++;
    *value = strtod(from, NULL);
    return r->at > from;
}

/* 2, -1, 0.5, (1/2), (-2) */
static bool exponent(reader *r, double *value)
{
    const char *from = r->at;
    double below = 1;
    bool open = take(r, "("), minus = take(r, "-");
    if (!minus) take(r, "+");
    bool good = digits(r, value) && (!open || ((!take(r, "/") || digits(r, &below)) && take(r, ")")));
    *value *= (minus ? -1 : 1) / (below != 0 ? below : 1);
    return good || fail(r, from, 1, NULL);
}

static bool is_letter(const reader *r)
{
    return isalpha((unsigned char)*r->at) || *r->at == '%' || *r->at == '_' ||
           ((unsigned char)*r->at >= 0x80 && strncmp(r->at, "\u00b7", 2));
}

static bool name(reader *r, nh_unit *out)
{
    char word[longest_name];
    double ignored;
    const char *from = r->at;
    while (is_letter(r)) {
        reader ahead = *r;
        if (superscripts(&ahead, &ignored)) break;
        r->at++;
    }
    size_t n = (size_t)(r->at - from);
    if (n == 0) return fail(r, from, 1, NULL);
    snprintf(word, sizeof word, "%.*s", (int)(n < sizeof word ? n : sizeof word - 1), from);
    return is_name(word, out) || fail(r, from, n, nearest(word));
}

static bool quotient(reader *r, int depth, nh_unit *out);

static bool factor(reader *r, int depth, nh_unit *out)
{
    const char *from = r->at;
    double power = 1;
    *out = one;
    if (take(r, "(")) {
        if (depth == deepest || !quotient(r, depth + 1, out)) return depth == deepest ? fail(r, from, 1, NULL) : false;
        if (!take(r, ")")) return fail(r, from, 1, NULL);
    } else if (*r->at == '1' && !isdigit((unsigned char)r->at[1])) {
        r->at++;
    } else if (!name(r, out)) {
        return false;
    }
    if (take(r, "^")) {
        if (!exponent(r, &power)) return false;
    } else if (!superscripts(r, &power)) {
        power = 1;
    }
    *out = nh_unit_product(one, *out, power);
    return true;
}

static bool product(reader *r, int depth, nh_unit *out)
{
    for (*out = one;;) {
        nh_unit each;
        if (!factor(r, depth, &each)) return false;
        *out = nh_unit_product(*out, each, 1);
        blanks(r);
        bool more = take(r, "*") || take(r, "\u00b7");
        blanks(r);
        if (!more && (!*r->at || *r->at == '/' || *r->at == ')')) return true;
    }
}

static bool quotient(reader *r, int depth, nh_unit *out)
{
    double power = 1;
    *out = one;
    do {
        nh_unit each;
        blanks(r);
        if (!product(r, depth, &each)) return false;
        *out = nh_unit_product(*out, each, power);
        power = -1;
        blanks(r);
    } while (take(r, "/"));
    return true;
}

static bool read(const char *text, nh_unit *out, nh_unit_fault *fault)
{
    reader r = {text, text, fault};
    *out = one;
    blanks(&r);
    if (!*r.at) return true;
    return quotient(&r, 0, out) && (!*r.at || fail(&r, r.at, 1, NULL));
}

bool nh_is_unit(const char *text, nh_unit_fault *fault)
{
    nh_unit ignored;
    return read(text, &ignored, fault);
}

nh_unit nh_unit_of(const char *text)
{
    nh_unit unit;
    nh_unit_fault ignored;
    return read(text, &unit, &ignored) ? unit : one;
}

bool nh_unit_hint(const char *text, nh_error *error)
{
    size_t number = strspn(text, "0123456789.+-"), blank = strspn(text + number, " ");
    nh_unit_fault fault;
    if (!number || !text[number + blank] || !nh_is_unit(text + number + blank, &fault)) return false;
    error->hint[0] = 0;
    return nh_error_hint(error, "write the unit next to its number: {value: %.*s, unit: %s}", (int)number, text,
                         text + number + blank);
}
