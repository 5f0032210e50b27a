/* name: names of the language, and the name that is suggested for a text that is no name. */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "base/escape.h"
#include "base/text.h"
#include "graph/function.h"
#include "graph/name.h"

static bool is_letter(char c) { return isalpha((unsigned char)c) || c == '_'; }

bool nh_is_name(const char *text)
{
    if (!is_letter(*text)) return false;
    for (; *text; text++)
        if (!is_letter(*text) && !isdigit((unsigned char)*text)) return false;
    return true;
}

bool nh_name_is_function(const char *name, nh_function *out)
{
    for (int f = 0; f < NH_FUNCTION_COUNT; f++) {
        if (f == NH_PI || f == NH_UNSPECIFIED || f == NH_TABLE || strcmp(name, nh_function_name((nh_function)f)))
            continue;
        *out = (nh_function)f;
        return true;
    }
    return false;
}

bool nh_is_reserved(const char *name)
{
    nh_function f;
    return nh_name_is_function(name, &f) || !strcmp(name, "pi") || !strcmp(name, "t") || !strcmp(name, "sqrt");
}

const char *nh_name_of_letter(const char *at, size_t *length)
{
    static const char *const letters[][2] = {
        {"α", "alpha"},  {"β", "beta"},   {"γ", "gamma"}, {"δ", "delta"}, {"ε", "epsilon"}, {"ϵ", "epsilon"},
        {"ζ", "zeta"},   {"η", "eta"},    {"θ", "theta"}, {"ϑ", "theta"}, {"ι", "iota"},    {"κ", "kappa"},
        {"λ", "lambda"}, {"μ", "mu"},     {"µ", "mu"},    {"ν", "nu"},    {"ξ", "xi"},      {"π", "pi"},
        {"ρ", "rho"},    {"σ", "sigma"},  {"ς", "sigma"}, {"τ", "tau"},   {"υ", "upsilon"}, {"φ", "phi"},
        {"ϕ", "phi"},    {"χ", "chi"},    {"ψ", "psi"},   {"ω", "omega"}, {"Γ", "Gamma"},   {"Δ", "Delta"},
        {"Θ", "Theta"},  {"Λ", "Lambda"}, {"Ξ", "Xi"},    {"Π", "Pi"},    {"Σ", "Sigma"},   {"Φ", "Phi"},
        {"Ψ", "Psi"},    {"Ω", "Omega"},  {"₀", "0"},     {"₁", "1"},     {"₂", "2"},       {"₃", "3"},
        {"₄", "4"},      {"₅", "5"},      {"₆", "6"},     {"₇", "7"},     {"₈", "8"},       {"₉", "9"}};
    for (size_t i = 0; i < sizeof letters / sizeof *letters; i++) {
        *length = strlen(letters[i][0]);
        if (!strncmp(at, letters[i][0], *length)) return letters[i][1];
    }
    return NULL;
}

/* "\\theta": the length of the command, and the name of the Greek letter; NULL: it is none. */
static const char *latex_letter(const char *at, size_t *length)
{
    static const char *const names[] = {
        "alpha", "beta",  "gamma", "delta", "epsilon", "zeta",  "eta", "theta",   "iota", "kappa", "lambda",
        "mu",    "nu",    "xi",    "pi",    "rho",     "sigma", "tau", "upsilon", "phi",  "chi",   "psi",
        "omega", "Gamma", "Delta", "Theta", "Lambda",  "Xi",    "Pi",  "Sigma",   "Phi",  "Psi",   "Omega"};
    if (*at != '\\') return NULL;
    size_t variant = !strncmp(at, "\\var", 4) ? 3 : 0, n = 0;
    const char *word = at + 1 + variant;
    while (isalpha((unsigned char)word[n])) n++;
    *length = 1 + variant + n;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strlen(names[i]) == n && !strncmp(word, names[i], n)) return names[i];
    return NULL;
}

size_t nh_name_spelled(const char *text, char *out, size_t room)
{
    size_t used = 0, length;
    bool brace = false;
    *out = 0;
    for (const char *at = text;; at += length) {
        const char *word = latex_letter(at, &length);
        if (!word) word = nh_name_of_letter(at, &length);
        if (!word && (is_letter(*at) || isdigit((unsigned char)*at))) word = at, length = 1;
        bool opens = *at == '{' && !brace && at > text && at[-1] == '_', closes = *at == '}' && brace;
        if (opens || closes) brace = opens, word = "", length = 1;
        if (!word) return brace ? 0 : (size_t)(at - text);
        size_t n = word == at ? 1 : strlen(word);
        if (used + n + 1 > room) n = room - 1 - used;
        memcpy(out + used, word, n);
        out[used += n] = 0;
    }
}

const char *nh_name_of_sign(const char *at)
{
    static const char *const signs[][2] = {
        {"\u2019", "'"},  {"\u2018", "'"},  {"\u2032", "'"},   {"\u00b4", "'"},         {"\u00b7", "*"},
        {"\u22c5", "*"},  {"\u00d7", "*"},  {"\u2212", "-"},   {"\u2013", "-"},         {"\u00f7", "/"},
        {"\u00b2", "^2"}, {"\u00b3", "^3"}, {"\u00bd", "1/2"}, {"\u221a", "sqrt(...)"}, {"\u00b0", "*pi/180"}};
    for (size_t i = 0; i < sizeof signs / sizeof *signs; i++)
        if (!strncmp(at, signs[i][0], strlen(signs[i][0]))) return signs[i][1];
    return NULL;
}

/* A name similar to the text: letters by their names, `_` for blanks and hyphens, leading digits moved to the end.
 * False where the text is an expression or has characters without a name. */
static bool similar_name(const char *text, nh_text *out)
{
    size_t digits = strspn(text, "0123456789"), length;
    for (const char *at = text + digits; *at; at += length) {
        const char *word = nh_name_of_letter(at, &length);
        if (!word) length = 1;
        if (word) nh_text_add(out, word);
        else if (is_letter(*at) || isdigit((unsigned char)*at)) nh_text_add_n(out, at, 1);
        else if (strchr(" -.", *at)) nh_text_add(out, "_");
        else if (*at != '\'') return false;
    }
    nh_text_add_n(out, text, digits);
    const char *name = nh_text_string(out);
    return nh_is_name(name) && !nh_is_reserved(name);
}

bool nh_name_hint(nh_error *error, const char *text)
{
    static const char rule[] = "a name is a letter a-z or A-Z, then letters, digits and _";
    nh_text name;
    nh_text_init(&name);
    if (similar_name(text, &name)) nh_error_hint(error, "%s: write `%s`", rule, nh_text_string(&name));
    else nh_error_hint(error, "%s", rule);
    nh_text_clear(&name);
    return false;
}

static const char before_code[] = "uni";

void nh_name_add_code(nh_text *out, uint32_t code) { nh_text_addf(out, "%s%04X", before_code, (unsigned)code); }

size_t nh_name_code(const char *at, uint32_t *code)
{
    enum { least = 4, most = 6 };
    size_t head = strlen(before_code);
    if (strncmp(at, before_code, head) != 0) return 0;
    size_t digits = strspn(at + head, "0123456789ABCDEF");
    *code = digits >= least && digits <= most ? (uint32_t)strtoul(at + head, NULL, 16) : 0;
    bool surrogate = *code >= 0xD800 && *code <= 0xDFFF;
    return *code < 0x80 || *code > 0x10FFFF || surrogate || nh_is_invisible(*code) ? 0 : head + digits;
}
