#include "system/units.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"

enum { longest_name = 24, deepest = 20 };

/* Those that take prefixes (the SI brochure of the BIPM), and those that do not. */
static const char *const scaled[] = {
    "m", "g", "s", "A", "K", "mol", "cd", "rad", "sr", "Hz", "N", "Pa", "J", "W", "C", "V", "F", "ohm", "\u03a9",
    "\u2126", "S", "Wb", "T", "H", "lm", "lx", "Bq", "Gy", "Sv", "kat", "eV", "bar", "L", "l", "t", "cal", "Wh", "pc"};
static const char *const plain[] = {
    "min", "h", "d", "yr", "deg", "\u00b0", "arcmin", "arcsec", "rev", "turn", "rpm", "au", "ha", "u", "Da", "atm",
    "in", "ft", "mi", "lb", "lbf", "psi", "hp", "%", "degC", "\u00b0C"};
static const char *const prefixes[] = {
    "k", "m", "c", "d", "da", "h", "M", "G", "T", "P", "E", "Z", "Y", "u", "\u00b5", "\u03bc", "n", "p", "f", "a",
    "z", "y"};
/* Words that people write for them: not understood, and pointed to the symbol. */
static const char *const words[][2] = {
    {"meter", "m"}, {"metre", "m"}, {"meters", "m"}, {"metres", "m"}, {"kilogram", "kg"}, {"gram", "g"},
    {"second", "s"}, {"seconds", "s"}, {"sec", "s"}, {"newton", "N"}, {"joule", "J"}, {"watt", "W"}, {"volt", "V"},
    {"ampere", "A"}, {"amp", "A"}, {"tesla", "T"}, {"hertz", "Hz"}, {"pascal", "Pa"}, {"degree", "deg"},
    {"degrees", "deg"}, {"radian", "rad"}, {"radians", "rad"}, {"hour", "h"}, {"minute", "min"}, {"kelvin", "K"}};
enum {
    scaled_count = sizeof scaled / sizeof *scaled,
    plain_count = sizeof plain / sizeof *plain,
    prefix_count = sizeof prefixes / sizeof *prefixes,
    word_count = sizeof words / sizeof *words
};

static bool is_in(size_t n, const char *const *list, const char *name)
{
    for (size_t i = 0; i < n; i++)
        if (!strcmp(list[i], name)) return true;
    return false;
}

static bool is_name(const char *name)
{
    if (is_in(scaled_count, scaled, name) || is_in(plain_count, plain, name)) return true;
    for (size_t i = 0; i < prefix_count; i++) {
        size_t n = strlen(prefixes[i]);
        if (!strncmp(name, prefixes[i], n) && is_in(scaled_count, scaled, name + n)) return true;
    }
    return false;
}

/* One letter is near to every other: only longer names are compared. */
static const char *nearest(const char *name)
{
    static const char *const common[] = {
        "kg", "mm", "cm", "km", "ms", "kHz", "MHz", "kN", "mN", "mol", "rad", "Hz", "Pa", "kPa", "MPa", "kJ", "kW",
        "mV", "kV", "mA", "Wb", "ohm", "bar", "eV", "min", "deg", "rpm", "arcmin", "arcsec", "atm", "lbf", "turn",
        "rev"};
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

static bool superscript(reader *r)
{
    static const char *const signs[] = {
        "\u207b", "\u00b9", "\u00b2", "\u00b3", "\u2070", "\u2074", "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    for (size_t i = 0; i < sizeof signs / sizeof *signs; i++)
        if (take(r, signs[i])) return true;
    return false;
}

static bool digits(reader *r)
{
    const char *from = r->at;
    while (isdigit((unsigned char)*r->at) || (*r->at == '.' && r->at > from)) r->at++;
    return r->at > from;
}

/* 2, -1, 0.5, (1/2), (-2) */
static bool exponent(reader *r)
{
    const char *from = r->at;
    bool open = take(r, "(");
    if (!take(r, "-")) take(r, "+");
    bool good = digits(r) && (!open || ((!take(r, "/") || digits(r)) && take(r, ")")));
    return good || fail(r, from, 1, NULL);
}

static bool is_letter(const reader *r)
{
    return isalpha((unsigned char)*r->at) || *r->at == '%' || *r->at == '_'
        || ((unsigned char)*r->at >= 0x80 && strncmp(r->at, "\u00b7", 2));
}

static bool name(reader *r)
{
    char word[longest_name];
    const char *from = r->at;
    while (is_letter(r)) {
        reader ahead = *r;
        if (superscript(&ahead)) break;
        r->at++;
    }
    size_t n = (size_t)(r->at - from);
    if (n == 0) return fail(r, from, 1, NULL);
    snprintf(word, sizeof word, "%.*s", (int)(n < sizeof word ? n : sizeof word - 1), from);
    return is_name(word) || fail(r, from, n, nearest(word));
}

static bool quotient(reader *r, int depth);

static bool factor(reader *r, int depth)
{
    const char *from = r->at;
    if (take(r, "(")) {
        if (depth == deepest || !quotient(r, depth + 1)) return depth == deepest ? fail(r, from, 1, NULL) : false;
        if (!take(r, ")")) return fail(r, from, 1, NULL);
    } else if (*r->at == '1' && !isdigit((unsigned char)r->at[1])) {
        r->at++;
    } else if (!name(r)) {
        return false;
    }
    if (take(r, "^")) return exponent(r);
    while (superscript(r)) {}
    return true;
}

static bool product(reader *r, int depth)
{
    for (;;) {
        if (!factor(r, depth)) return false;
        blanks(r);
        bool more = take(r, "*") || take(r, "\u00b7");
        blanks(r);
        if (!more && (!*r->at || *r->at == '/' || *r->at == ')')) return true;
    }
}

static bool quotient(reader *r, int depth)
{
    do {
        blanks(r);
        if (!product(r, depth)) return false;
        blanks(r);
    } while (take(r, "/"));
    return true;
}

bool nh_is_unit(const char *text, nh_unit_fault *fault)
{
    reader r = {text, text, fault};
    blanks(&r);
    if (!*r.at) return true;
    return quotient(&r, 0) && (!*r.at || fail(&r, r.at, 1, NULL));
}
