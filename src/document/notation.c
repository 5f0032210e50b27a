/* notation: labels are read from left to right; a letter that may carry scripts is written to a text of its own
 * first. */
#include "document/notation.h"

#include <ctype.h>
#include <string.h>

#include "document/typeset.h"

typedef struct {
    const char *at;
    nh_notation_form form;
} reader;

static void sequence(reader *r, char end, nh_text *out);

/* A name as in formulas. */
static void name(nh_notation_form form, const char *text, size_t length, nh_text *out)
{
    nh_text plain;
    nh_text_init(&plain);
    nh_text_add_n(&plain, text, length);
    const char *word = nh_text_string(&plain);
    bool number = strspn(word, "0123456789") == length;
    if (form == NH_NOTATION_TEXT) nh_text_add(out, word);
    else if (number || !nh_typeset(word, form == NH_NOTATION_LATEX ? NH_LATEX : NH_MATHML, out))
        nh_text_addf(out, form == NH_NOTATION_LATEX ? "%s" : "<mn>%s</mn>", word);
    nh_text_clear(&plain);
}

/* {..}, which becomes one group. */
static void group(reader *r, nh_text *out)
{
    if (*r->at == '{') r->at++;
    if (r->form == NH_NOTATION_MATHML) nh_text_add(out, "<mrow>");
    sequence(r, '}', out);
    if (r->form == NH_NOTATION_MATHML) nh_text_add(out, "</mrow>");
}

/* Signs without argument: text, MathML, LaTeX. */
static const struct {
    const char *name, *form[3];
} signs[] = {
    {"p", {"d", "<mo>\u2202</mo>", "\\partial "}},
    {"pc", {"d_c ", "<msub><mo>\u2202</mo><mi>c</mi></msub>", "\\partial_c "}},
    {"dcp",
     {"d'_c ", "<msubsup><mi mathvariant=\"normal\">d</mi><mi>c</mi><mo>\u2032</mo></msubsup>", "\\mathrm{d}'_c "}},
    {"d", {"d", "<mi mathvariant=\"normal\">d</mi>", "\\mathrm{d}"}},
    {"form", {"phi", "<mi>\u03d5</mi>", "\\phi"}},
    {"eps", {"eps", "<mi>\u03b5</mi>", "\\varepsilon"}},
    {"epsp", {"eps'", "<msup><mi>\u03b5</mi><mo>\u2032</mo></msup>", "\\varepsilon'"}},
    {"wedge", {" ^ ", "<mo>\u2227</mo>", "\\wedge "}},
    {"supset", {">", "<mo>\u2283</mo>", "\\supset "}},
    {"Sigma", {"sum", "<mo>\u2211</mo>", "\\sum"}},
    {"pidot", {"pi'", "<mover accent=\"true\"><mi>\u03c0</mi><mo>\u02d9</mo></mover>", "\\dot{\\pi}"}},
    {"quad", {"   ", "<mspace width=\"1em\"></mspace>", "\\quad "}},
};

static const struct {
    const char *name, *form[3][2];
} accents[] = {
    {"bar", {{"", "bar"}, {"<mover accent=\"true\">", "<mo>\u00af</mo></mover>"}, {"\\bar{", "}"}}},
    {"tilde", {{"", "tilde"}, {"<mover accent=\"true\">", "<mo>~</mo></mover>"}, {"\\tilde{", "}"}}},
    {"breve", {{"", "breve"}, {"<mover accent=\"true\">", "<mo>\u02d8</mo></mover>"}, {"\\breve{", "}"}}},
    {"hat", {{"", "hat"}, {"<mover accent=\"true\">", "<mo>^</mo></mover>"}, {"\\hat{", "}"}}},
};

static void fraction(reader *r, nh_text *out)
{
    static const char *const parts[3][3] = {{"", "/", ""}, {"<mfrac>", "", "</mfrac>"}, {"\\frac{", "}{", "}"}};
    nh_text_add(out, parts[r->form][0]);
    group(r, out);
    if (r->form == NH_NOTATION_TEXT && out->length && out->data[out->length - 1] == ' ') out->data[--out->length] = 0;
    nh_text_add(out, parts[r->form][1]);
    group(r, out);
    nh_text_add(out, parts[r->form][2]);
}

static void command(reader *r, nh_text *out)
{
    const char *word = ++r->at;
    while (isalpha((unsigned char)*r->at)) r->at++;
    size_t length = (size_t)(r->at - word);
    if (*r->at == ' ') r->at++;
    if (length == 4 && !strncmp(word, "frac", 4)) {
        fraction(r, out);
        return;
    }
    for (size_t i = 0; i < sizeof signs / sizeof *signs; i++)
        if (strlen(signs[i].name) == length && !strncmp(word, signs[i].name, length))
            nh_text_add(out, signs[i].form[r->form]);
    for (size_t i = 0; i < sizeof accents / sizeof *accents; i++) {
        if (strlen(accents[i].name) != length || strncmp(word, accents[i].name, length)) continue;
        nh_text_add(out, accents[i].form[r->form][0]);
        group(r, out);
        nh_text_add(out, accents[i].form[r->form][1]);
    }
}

/* A sign by itself. */
static void sign(nh_notation_form form, char c, nh_text *out)
{
    const char *minus = c == '-' && form == NH_NOTATION_MATHML ? "\u2212" : NULL;
    if (form != NH_NOTATION_MATHML) nh_text_add_n(out, &c, 1);
    else if (c == '>') nh_text_add(out, "<mo>&gt;</mo>");
    else if (c != ' ')
        nh_text_addf(out, strchr("()[]", c) ? "<mo stretchy=\"false\">%.*s</mo>" : "<mo>%.*s</mo>", minus ? 3 : 1,
                     minus ? minus : &c);
}

/* A letter that scripts may follow, and these. */
static void atom(reader *r, nh_text *out)
{
    nh_text base, script[2];
    nh_text_init(&base);
    if (*r->at == '<') {
        const char *end = strchr(r->at, '>');
        name(r->form, r->at + 1, (size_t)(end - r->at - 1), &base);
        r->at = end + 1;
    } else if (*r->at == '\\') {
        command(r, &base);
    } else if (isalnum((unsigned char)*r->at)) {
        const char *from = r->at;
        while (isalnum((unsigned char)*r->at) || *r->at == '\'') r->at++;
        name(r->form, from, (size_t)(r->at - from), &base);
    } else {
        sign(r->form, *r->at++, &base);
    }
    for (int i = 0; i < 2; i++) nh_text_init(&script[i]);
    while (*r->at == '_' || *r->at == '^') {
        int up = *r->at++ == '^';
        group(r, &script[up]);
    }
    const char *below = nh_text_string(&script[0]), *above = nh_text_string(&script[1]), *b = nh_text_string(&base);
    bool page = r->form == NH_NOTATION_MATHML, latex = r->form == NH_NOTATION_LATEX;
    if (page && *below && *above) nh_text_addf(out, "<msubsup><mrow>%s</mrow>%s%s</msubsup>", b, below, above);
    else if (page && (*below || *above))
        nh_text_addf(out, *below ? "<msub><mrow>%s</mrow>%s</msub>" : "<msup><mrow>%s</mrow>%s</msup>", b,
                     *below ? below : above);
    else nh_text_addf(out, latex && (*below || *above) ? "{%s}" : "%s", b);
    if (!page && *below) nh_text_addf(out, latex ? "_{%s}" : "_%s", below);
    if (!page && *above) nh_text_addf(out, latex ? "^{%s}" : "^%s", above);
    nh_text_clear(&base);
    for (int i = 0; i < 2; i++) nh_text_clear(&script[i]);
}

static void sequence(reader *r, char end, nh_text *out)
{
    while (*r->at && *r->at != end) atom(r, out);
    if (*r->at) r->at++;
}

void nh_notation_write(const char *label, nh_notation_form form, nh_text *out)
{
    reader r = {label, form};
    sequence(&r, 0, out);
}

bool nh_notation_next(const char **words, nh_text *part, bool *label)
{
    nh_text_init(part);
    if (!**words) return false;
    *label = **words == '$';
    *words += *label;
    size_t length = strcspn(*words, "$");
    nh_text_add_n(part, *words, length);
    *words += length + (*label && (*words)[length]);
    return true;
}
