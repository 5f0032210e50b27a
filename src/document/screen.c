#include "document/screen.h"

#include <ctype.h>
#include <string.h>

#include "base/memory.h"
#include "graph/print.h"

enum { line_width = 80, line_indent = 2 };

/* Where a line of at most `room` characters is best broken: before a + or - with few open parentheses, otherwise after
 * a factor; 0: nowhere. */
static size_t break_at(const char *text, size_t room)
{
    size_t best = 0;
    int depth = 0, least = 1 << 20;
    for (size_t i = 0; i < room && text[i]; i++) {
        depth += (text[i] == '(') - (text[i] == ')');
        bool equal = text[i + 1] == '=' && i > room / 4; /* not right after a label */
        if (i == 0 || text[i] != ' ' || (!equal && text[i + 1] != '+' && text[i + 1] != '-') || text[i + 2] != ' ')
            continue;
        if (depth > least && i < best + room / 2) continue;
        least = depth;
        best = i;
    }
    for (size_t i = room; i > room / 2 && !best; i--)
        if (text[i - 1] == '*' || text[i - 1] == ' ') best = i;
    return best;
}

/* The break between words: at the last blank with at most `room` columns before it, or at the first one. */
static size_t blank_at(const char *text, size_t room)
{
    size_t cut = 0, column = 0;
    for (size_t i = 0; text[i] && (column <= room || !cut); i++) {
        if (text[i] == ' ' && i) cut = i;
        column += ((unsigned char)text[i] & 0xc0) != 0x80;
    }
    return cut;
}

/* Breaks the text so that nothing extends beyond the last column; `hang`: indentation of all lines but the first. */
static void put_broken(nh_text *out, size_t indent, size_t hang, const char *text,
                       size_t (*where)(const char *, size_t))
{
    nh_text_addf(out, "%*s", (int)indent, "");
    for (size_t room = line_width - indent; nh_text_width(text) > room; room = line_width - hang) {
        size_t cut = where(text, room);
        if (!cut) break;
        nh_text_add_n(out, text, cut);
        text += cut + (text[cut] == ' ');
        nh_text_addf(out, "\n%*s", (int)hang, "");
    }
    nh_text_addf(out, "%s\n", text);
}

void nh_screen_paragraph(size_t indent, size_t hang, const char *words, nh_text *out)
{
    put_broken(out, indent, hang, words + strspn(words, " "), blank_at);
}

void nh_screen_broken(size_t indent, size_t hang, const char *formula, nh_text *out)
{
    put_broken(out, indent, hang, formula, break_at);
}

void nh_screen_fold(const char *text, nh_text *out)
{
    for (const char *line = text; *line;) {
        size_t length = strcspn(line, "\n"), indent = strspn(line, " ");
        nh_text one;
        nh_text_init(&one);
        nh_text_add_n(&one, line + indent, length - indent);
        put_broken(out, indent, indent + line_indent, nh_text_string(&one), blank_at);
        nh_text_clear(&one);
        line += length + (line[length] == '\n');
    }
}

bool nh_screen_is_wanted(nh_pen_style style) { return style.form == NH_PEN_TEXT && !style.verbose; }

static bool is_open(const char *const open[3], const char *name)
{
    for (size_t i = 0; open && i < 3 && open[i]; i++)
        if (!strcmp(open[i], name)) return true;
    return false;
}

/* The length of the beginning "mass_" that at least three parameters share; 0: there is none. */
static size_t shared_beginning(const nh_system *system, const char *name)
{
    enum { least = 3, letters = 3 };
    const char *end = strchr(name, '_');
    size_t length = end ? (size_t)(end - name) + 1 : 0, n = 0;
    for (size_t i = 0; length && i < system->parameters; i++) n += !strncmp(system->parameter[i].name, name, length);
    return n >= least && length > letters && isalpha((unsigned char)name[length]) ? length : 0;
}

enum { glue = 1 }; /* for a blank at which no line is broken */

/* "m = 1, l = 1" in one line. */
static void put_parameters(const nh_system *system, const char *const open[3], nh_text *out)
{
    size_t grouped = 0;
    for (size_t i = 0; i < system->parameters; i++) {
        const char *name = system->parameter[i].name;
        size_t length = shared_beginning(system, name), before = 0, group = 0;
        for (size_t j = 0; length && j < i; j++) before += !strncmp(system->parameter[j].name, name, length);
        for (size_t j = i; j < system->parameters && !before; j++) {
            const char *other = system->parameter[j].name;
            if ((length ? strncmp(other, name, length) != 0 : j > i) || is_open(open, other)) continue;
            nh_text_add(out, !out->length ? "" : grouped && !group ? "; " : ", ");
            if (!length) nh_text_addf(out, "%s%c=%c%.6g", other, glue, glue, system->parameter[j].value);
            else
                nh_text_addf(out, "%.*s%s%s%c%.6g", group ? 0 : (int)length - 1, name, group ? "" : ": ",
                             other + length, glue, system->parameter[j].value);
            group++, grouped = length;
        }
    }
}

void nh_screen_begin(nh_text *out, bool colour, const nh_system *system, const char *const open[3], nh_text *answer)
{
    enum { width = 80, blanks = 3 };
    size_t start = out->length;
    nh_text values;
    nh_text_init(&values);
    put_parameters(system, open, &values);
    bool fit = nh_text_width(system->title) + blanks + nh_text_width(nh_text_string(&values)) <= width;
    nh_text_addf(out, colour ? "\033[1m%s\033[0m" : "%s", system->title);
    if (fit && values.length) nh_text_addf(out, "   %s", nh_text_string(&values));
    nh_text_add(out, "\n");
    nh_screen_say(out, 0, answer);
    if (!fit) nh_screen_say(out, 2, &values);
    for (size_t i = start; i < out->length; i++)
        if (out->data[i] == glue) out->data[i] = ' ';
    nh_text_clear(&values);
}

void nh_screen_say(nh_text *out, size_t indent, nh_text *words)
{
    while (words->length && words->data[words->length - 1] == ' ') words->data[--words->length] = 0;
    if (words->length) nh_screen_paragraph(indent, indent, nh_text_string(words), out);
    nh_text_clear(words);
}

void nh_screen_formula(nh_text *out, bool colour, const char *lines)
{
    for (const char *at = lines; *at;) {
        size_t length = strcspn(at, "\n");
        nh_text_add(out, colour ? "\033[36m" : "");
        nh_text_add_n(out, at, length);
        nh_text_add(out, colour ? "\033[0m\n" : "\n");
        at += length + (at[length] == '\n');
    }
}

bool nh_screen_equation(const char *label, nh_dag *d, nh_ex e, nh_text *out)
{
    enum { longest = 80 * NH_SCREEN_LINES };
    nh_text line;
    nh_text_init(&line);
    char *value = nh_print_short(d, e, longest); /* a shared graph can be exponentially long on paper */
    nh_text_addf(&line, "%s = %s", label, value ? value : "");
    if (value) nh_screen_broken(2, 2 + NH_SCREEN_HANG, nh_text_string(&line), out);
    bool written = value;
    nh_free(value);
    nh_text_clear(&line);
    return written;
}

bool nh_screen_put(nh_text *out, bool colour, size_t indent, const char *head, const char *formula, size_t most,
                   const char *instead)
{
    nh_text line, block;
    nh_text_init(&line);
    nh_text_init(&block);
    nh_text_addf(&line, "%s%s", head, formula ? formula : instead ? instead : "a long formula (--details)");
    nh_screen_broken(indent, indent + NH_SCREEN_HANG + (indent ? 0 : 2), nh_text_string(&line), &block);
    size_t n = nh_screen_count(nh_text_string(&block));
    bool written = formula && n <= most;
    if (formula && !written) {
        nh_text_clear(&block);
        nh_text_addf(&block, "%*s%s", (int)indent, "", head);
        if (instead) nh_text_addf(&block, "%s\n", instead);
        else nh_text_addf(&block, "a formula of %zu lines (--details)\n", n);
    }
    nh_screen_formula(out, colour, nh_text_string(&block));
    nh_text_clear(&line);
    nh_text_clear(&block);
    return written;
}

size_t nh_screen_count(const char *text)
{
    size_t n = 0;
    for (; *text; text++) n += *text == '\n';
    return n;
}

bool nh_screen_fit(nh_text *out, nh_text *block, size_t tail)
{
    size_t lines = nh_screen_count(nh_text_string(out)) + nh_screen_count(nh_text_string(block)) + tail;
    if (lines <= NH_SCREEN_LINES) nh_text_add(out, nh_text_string(block));
    nh_text_clear(block);
    return lines <= NH_SCREEN_LINES;
}

void nh_screen_more(nh_text *out, const char *details, const char *other)
{
    nh_text_addf(out, "\nMore: --details   %s\n", details);
    if (other) nh_text_addf(out, "      %s\n", other);
}
