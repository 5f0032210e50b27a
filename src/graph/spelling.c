#include "graph/spelling.h"

#include <ctype.h>
#include <stdint.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "graph/name.h"

enum { deepest = 64 /* braces in braces */ };

typedef struct {
    const char *start, *at;
    nh_text out;
    size_t *origin, origins;
    int depth, primes; /* primes of a letter with dots, which stand behind its index */
} speller;

/* The signs of one character, and those of words. */
static const char *const signs[][2] = {
    {"\u2019", "'"}, {"\u2018", "'"}, {"\u2032", "'"}, {"\u00b4", "'"},  {"\u2033", "''"},     {"\u00b7", "*"},
    {"\u22c5", "*"}, {"\u2219", "*"}, {"\u00d7", "*"}, {"\u2217", "*"},  {"\u2212", "-"},      {"\u2013", "-"},
    {"\u00f7", "/"}, {"\u2215", "/"}, {"\u00a0", " "}, {"\u2009", " "},  {"\u221a", " sqrt "}, {"\u00b0", " deg "},
    {"\u202f", " "}, {"\u2061", " "}, {"\\cdot", "*"}, {"\\times", "*"}, {"\\left", ""},       {"\\right", ""},
    {"\\quad", " "}, {"\\,", " "},    {"\\;", " "},    {"\\:", " "},     {"\\!", " "},         {"\\ ", " "}};
static const char *const superscripts[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                           "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
/* Letters with dots as one character.  (A German or French ä, ë, ï, ö, ü has none in mechanics.) */
static const struct {
    char sign[4], letter;
    int dots;
} dotted[] = {{"ȧ", 'a', 1}, {"ḃ", 'b', 1}, {"ċ", 'c', 1}, {"ḋ", 'd', 1}, {"ė", 'e', 1}, {"ḟ", 'f', 1}, {"ġ", 'g', 1},
              {"ḣ", 'h', 1}, {"ṁ", 'm', 1}, {"ṅ", 'n', 1}, {"ȯ", 'o', 1}, {"ṗ", 'p', 1}, {"ṙ", 'r', 1}, {"ṡ", 's', 1},
              {"ṫ", 't', 1}, {"ẇ", 'w', 1}, {"ẋ", 'x', 1}, {"ẏ", 'y', 1}, {"ż", 'z', 1}, {"ẍ", 'x', 2}, {"ÿ", 'y', 2},
              {"ẅ", 'w', 2}, {"ḧ", 'h', 2}, {"ẗ", 't', 2}, {"Ẋ", 'X', 1}, {"Ẏ", 'Y', 1}, {"Ż", 'Z', 1}, {"Ṙ", 'R', 1}};

static void put_n(speller *s, const char *text, size_t n)
{
    nh_grow(&s->origin, &s->origins, s->out.length + n + 1, sizeof *s->origin);
    for (size_t i = 0; i < n; i++) s->origin[s->out.length + i] = (size_t)(s->at - s->start);
    nh_text_add_n(&s->out, text, n);
}
static void put(speller *s, const char *text) { put_n(s, text, strlen(text)); }

static void put_primes(speller *s)
{
    for (; s->primes; s->primes--) put(s, "'");
}

static bool starts(const char *at, const char *word)
{
    size_t n = strlen(word);
    bool command = word[0] == '\\' && isalpha((unsigned char)word[n - 1]);
    return !strncmp(at, word, n) && !(command && isalpha((unsigned char)at[n]));
}

static void spell_one(speller *s);

/* The next group {...} of LaTeX, or one sign. */
static void spell_group(speller *s)
{
    s->at += strspn(s->at, " ");
    if (*s->at != '{') {
        if (*s->at) spell_one(s);
        return;
    }
    s->at++;
    if (++s->depth <= deepest)
        while (*s->at && *s->at != '}') spell_one(s);
    s->depth--;
    put_primes(s);
    s->at += *s->at == '}';
}

/* A group in parentheses. */
static void spell_closed(speller *s)
{
    put(s, "(");
    spell_group(s);
    put(s, ")");
}

/* Is the group one word: {2}, {m}, {dt}, {d\theta}? */
static bool is_word(const char *group)
{
    size_t n = 1;
    if (*group != '{') return false;
    while (isalnum((unsigned char)group[n]) || group[n] == '\\' || (unsigned char)group[n] >= 0x80) n++;
    return group[n] == '}';
}

static bool spell_fraction(speller *s)
{
    static const char *const words[] = {"\\frac", "\\dfrac", "\\tfrac"};
    for (size_t i = 0; i < 3; i++) {
        if (!starts(s->at, words[i])) continue;
        s->at += strlen(words[i]);
        put(s, " (");
        (is_word(s->at) ? spell_group : spell_closed)(s);
        put(s, "/");
        (is_word(s->at) ? spell_group : spell_closed)(s);
        put(s, ") ");
        return true;
    }
    return false;
}

/* \dot{\theta}_1 is theta_1'. */
static bool spell_dot(speller *s)
{
    int dots = starts(s->at, "\\dot") ? 1 : starts(s->at, "\\ddot") ? 2 : 0;
    if (!dots) return false;
    s->at += dots == 1 ? strlen("\\dot") : strlen("\\ddot");
    put(s, " ");
    spell_group(s);
    s->primes += dots;
    return true;
}

/* \cos\theta, \sqrt{x} */
static bool spell_function(speller *s)
{
    char word[16];
    size_t n = 0;
    if (*s->at != '\\') return false;
    for (; n < sizeof word - 1 && isalpha((unsigned char)s->at[1 + n]); n++) word[n] = s->at[1 + n];
    word[n] = 0;
    if (!strncmp(word, "arc", 3)) memmove(word + 1, word + 3, sizeof word - 3); /* arcsin is asin */
    if (!strcmp(word, "ln")) strcpy(word, "log");
    if (!nh_is_reserved(word) || !strcmp(word, "t") || !strcmp(word, "pi")) return false;
    unsigned char last = s->out.length ? (unsigned char)s->out.data[s->out.length - 1] : ' ';
    bool follows = isalnum(last) || last >= 0x80;
    if (follows) put(s, " ");
    put(s, word);
    s->at += 1 + n;
    if (!strcmp(word, "sqrt") && *s->at == '{') spell_closed(s);
    else if (!strchr("(^{", *s->at)) put(s, " ");
    return true;
}

/* Digits as superscripts are an exponent. */
static bool spell_power(speller *s)
{
    bool some = false, minus = !strncmp(s->at, "\u207b", strlen("\u207b"));
    const char *start = s->at;
    if (minus) s->at += strlen("\u207b");
    for (size_t i = 0; i < 10; i++) {
        size_t n = strlen(superscripts[i]);
        if (strncmp(s->at, superscripts[i], n)) continue;
        const char digit[] = {(char)('0' + i), 0};
        if (!some) put_primes(s), put(s, minus ? "^-" : "^");
        put(s, digit);
        s->at += n;
        some = true;
        i = SIZE_MAX; /* the next digit */
    }
    if (some) put(s, " ");
    else s->at = start;
    return some;
}

/* A letter with dots; and dots that combine with the letter before. */
static bool spell_dotted(speller *s)
{
    static const char one[] = "\u0307", two[] = "\u0308";
    int dots = !strncmp(s->at, one, 2) ? 1 : !strncmp(s->at, two, 2) ? 2 : 0;
    if (dots) return s->primes += dots, s->at += 2, true;
    for (size_t i = 0; i < sizeof dotted / sizeof *dotted; i++) {
        size_t n = strlen(dotted[i].sign);
        if (strncmp(s->at, dotted[i].sign, n)) continue;
        put_primes(s);
        put_n(s, &dotted[i].letter, 1);
        s->primes = dotted[i].dots;
        return s->at += n, true;
    }
    return false;
}

static bool spell_sign(speller *s)
{
    for (size_t i = 0; i < sizeof signs / sizeof *signs; i++) {
        if (!starts(s->at, signs[i][0])) continue;
        put(s, signs[i][1]);
        return s->at += strlen(signs[i][0]), true;
    }
    return false;
}

/* x_{1} as it is, else braces are parentheses. */
static bool spell_brace(speller *s)
{
    bool index = *s->at == '_' && s->at[1] == '{';
    if (*s->at == '{') return spell_closed(s), true;
    if (!index) return false;
    size_t n = strcspn(s->at, "}");
    n += s->at[n] == '}';
    put_n(s, s->at, n);
    return s->at += n, true;
}

/* Does the index of a name go on here?  That of x_c has letters. */
static bool indexes(const speller *s)
{
    size_t length;
    const char *at = s->at, *letter = nh_name_of_letter(at, &length);
    size_t n = s->out.length;
    while (n && isalnum((unsigned char)s->out.data[n - 1])) n--;
    bool below = n && s->out.data[n - 1] == '_' && !isdigit((unsigned char)s->out.data[n]);
    if (below && (letter || isalpha((unsigned char)*at))) return true;
    return *at == '_' || isdigit((unsigned char)*at) || (letter && isdigit((unsigned char)*letter)) ||
           !strncmp(at, "\u0307", 2) || !strncmp(at, "\u0308", 2);
}

static void spell_one(speller *s)
{
    if (s->primes && !indexes(s)) put_primes(s);
    if (spell_fraction(s) || spell_dot(s) || spell_function(s) || spell_power(s) || spell_dotted(s) || spell_sign(s) ||
        spell_brace(s))
        return;
    size_t n = 1;
    while (((unsigned char)s->at[n] & 0xC0) == 0x80 || (*s->at == '\\' && isalpha((unsigned char)s->at[n]))) n++;
    put_n(s, s->at, n);
    s->at += n;
}

nh_spelling nh_spelling_of(const char *text)
{
    nh_spelling spelling = {.text = text};
    bool plain = true;
    for (const char *c = text; *c && plain; c++) plain = !((unsigned char)*c & 0x80) && *c != '\\' && *c != '{';
    if (plain) return spelling;
    speller s = {.start = text, .at = text};
    nh_text_init(&s.out);
    while (*s.at) spell_one(&s);
    put_primes(&s);
    put_n(&s, "", 0);
    s.origin[s.out.length] = strlen(text);
    spelling = (nh_spelling){.own = nh_alloc_array(s.out.length + 1, 1), .origin = s.origin, .length = s.out.length};
    memcpy(spelling.own, nh_text_string(&s.out), s.out.length + 1);
    nh_text_clear(&s.out);
    spelling.text = spelling.own;
    return spelling;
}

void nh_spelling_clear(nh_spelling *spelling)
{
    nh_free(spelling->own);
    nh_free(spelling->origin);
    *spelling = (nh_spelling){.text = NULL};
}

size_t nh_spelling_origin(const nh_spelling *spelling, size_t at)
{
    return spelling->origin && at <= spelling->length ? spelling->origin[at] : at;
}
