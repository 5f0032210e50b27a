/* papers_find: a row of docs/papers.md: its command, the value that stands in the command's text, and what is found. */
#ifndef NH_TESTS_PAPERS_FIND_H
#define NH_TESTS_PAPERS_FIND_H

#include "papers.h"
#include "papers_document.h"

static document *documents[D_COUNT];

static const document *document_of(int index)
{
    if (documents[index]) return documents[index];
    documents[index] = malloc(sizeof **documents);
    document_open(documents[index], DOCUMENTS[index].words, DOCUMENTS[index].system, 0, NULL);
    return documents[index];
}

static void documents_close(void)
{
    for (size_t i = 0; i < D_COUNT; i++)
        if (documents[i]) document_close(documents[i]), free(documents[i]);
}

/* ---- the determining equations ---- */

/* A basis field as printed, applied to e. */
static nh_ex along(const document *d, const char *label, nh_ex e)
{
    nh_dag *g = d->system->dag;
    nh_ex sum = nh_int(g, 0);
    for (size_t i = 0; i < d->symbols; i++) {
        char of[80];
        snprintf(of, sizeof of, "d/d%s", nh_name_of(g, d->symbol[i]));
        const char *c = shown(d, "canonical_distribution", label, of);
        if (strcmp(c, "0")) sum = nh_add(g, sum, nh_mul(g, parsed(d, c), nh_diff(g, e, d->symbol[i])));
    }
    return sum;
}

static nh_ex component(const document *d, const char *name)
{
    char label[120];
    snprintf(label, sizeof label, "Z_%s", name);
    return parsed(d, shown(d, "symmetry", label, ""));
}

/* Phi, Z^0, Z^x, zeta^x or Ztilde^x of the document's current. */
static nh_ex unknown(const document *d, const char *name)
{
    nh_dag *g = d->system->dag;
    char velocity[80];
    if (!strcmp(name, "Phi")) return parsed(d, shown(d, "question", "Phi", ""));
    if (!strcmp(name, "Z^0")) return component(d, "t");
    const char *index = strchr(name, '^') + 1;
    snprintf(velocity, sizeof velocity, "%s'", index);
    if (name[0] == 'Z') return component(d, name[1] == 't' ? velocity : index);
    return nh_sub(g, component(d, index), nh_mul(g, parsed(d, velocity), component(d, "t")));
}

static nh_ex applied(const document *d, const char *of)
{
    char name[80], label[120];
    const char *stroke = strchr(of, '/');
    if (!stroke) return unknown(d, of);
    const char *word = !strncmp(of, "d'_c ", 5) ? of + 5 : !strncmp(of, "d_c ", 4) ? of + 4 : of + 1;
    snprintf(name, sizeof name, "%.*s", (int)(stroke - word), word);
    nh_ex e = unknown(d, name);
    if (word == of + 1) return nh_diff(d->system->dag, e, parsed(d, stroke + 2));
    snprintf(label, sizeof label, "%.*s%s", (int)(word - of - 1), of, stroke);
    return along(d, label, e);
}

/* The largest left side of the equations of this number, relative to the terms; `more` (or 0) is added to each. */
static double violation(const document *d, const char *number, const nh_ex *more)
{
    double worst = 0;
    size_t l = 0, found = 0;
    for (size_t i = 0; i < d->lines; i++) {
        double sum[points] = {0}, size[points] = {0}, value[points];
        const char *line = d->line[i].text;
        if (!in_section(&d->line[i], heading_of("determining_equations"), 0) || line[0] != '(' || strncmp(line + 1, number, 2)) continue;
        const char *next = left_of(line);
        bool minus = *next == '-', after;
        found++;
        for (next += minus; next; minus = after) {
            size_t length, cut;
            const char *term = next;
            next = next_term(term, &length, &after);
            cut = factor_at(term, length);
            nh_ex c = cut ? parsed(d, strndup(term, cut)) : nh_int(d->system->dag, 1);
            const char *of = strndup(term + cut + (cut > 0), length - cut - (cut > 0));
            evaluate(d, nh_mul(d->system->dag, c, applied(d, of)), value);
            for (size_t p = 0; p < points; p++) sum[p] += minus ? -value[p] : value[p], size[p] += fabs(value[p]);
        }
        if (more) evaluate(d, more[l++], value);
        for (size_t p = 0; p < points; p++) worst = fmax(worst, size[p] > 0 ? fabs(sum[p] + (more ? value[p] : 0)) / size[p] : 0);
    }
    return found ? worst : INFINITY;
}
#include "papers_by.h"

/* ---- findings ---- */

typedef struct {
    char value[900], finding[600];
    bool good, misprint, not;
} finding;

static int digits_of(double error) { return error < 1e-15 ? 15 : (int)floor(-log10(error)); }

static void conclude(finding *f, double printed, double meant)
{
    f->good = printed < enough || meant < enough;
    f->misprint = printed >= enough && f->good;
    if (printed < enough) snprintf(f->finding, sizeof f->finding, "agrees to %d digits", digits_of(printed));
    else if (f->misprint) snprintf(f->finding, sizeof f->finding, "**misprint**: as printed off by %.1e, corrected to %d digits", printed, digits_of(meant));
    else snprintf(f->finding, sizeof f->finding, "**DISAGREES** by %.1e", printed);
}

/* The beginning of a long text. */
static void show(finding *f, const char *text)
{
    enum { longest = 76 };
    size_t n = strlen(text);
    if (n > longest)
        for (n = longest; n > longest / 2 && text[n] != ' '; n--) continue;
    snprintf(f->value, sizeof f->value, n < strlen(text) ? "`%.*s ..`" : "`%.*s`", (int)n, text);
}

static void compare(const row *r, const document *d, finding *f)
{
    double got[points], want[points], printed, meant = INFINITY;
    const char *text = shown(d, r->section, r->label, r->of ? r->of : ""), *line = line_of(d, r->section, r->label);
    const char *of = r->of ? r->of : "", *term = NULL;
    if (!has_section(d, r->section)) {
        snprintf(f->finding, sizeof f->finding, "**DISAGREES**: nothing stands at %s", r->section);
        return;
    }
    if (line && *of) term = of[0] == '=' ? term_in(right_of(line), of + 1) : term_in(line[0] == '(' || r->label[0] == '#' ? left_of(line) : right_of(line), of);
    if (term) show(f, term);
    else if (line && !*of) show(f, line);
    else snprintf(f->value, sizeof f->value, "not listed: it vanishes");
    values(d, text, got);
    if (!r->printed) {
        f->good = line != NULL;
        return;
    }
    values(d, r->printed, want);
    printed = apart(got, want);
    if (r->meant) values(d, r->meant, want), meant = apart(got, want);
    conclude(f, printed, meant);
}

/* What was run answers Yes, and proves it. */
static bool yes(const char *words, bool *proved, char *answer, size_t size)
{
    char *text = run_command(words), *flat = flattened(text);
    const char *at = strstr(flat, " Yes"), *no = strstr(flat, " No");
    bool good = at && (!no || at < no);
    const char *from = good ? at + 1 : no ? no + 1 : "";
    size_t first = strcspn(from, "."), more = strlen(from) > first ? strcspn(from + first + 1, ".") : 0; /* "Yes. This is conserved" */
    snprintf(answer, size, "%.*s", (int)(first < 4 ? first + 1 + more : first), from);
    *proved = good && strstr(at, "proved");
    free(flat);
    free(text);
    return good;
}

/* ---- commands ---- */

static const char *asked(const row *r, const char *text)
{
    static char words[8][6000];
    static int next;
    char *out = words[next++ % 8];
    const char *option = r->kind == CURRENT ? "--current" : "--field";
    snprintf(out, sizeof *words, "nhsym verify %s --velocities coordinates%s %s \"%s\"", r->label, r->k > 0 ? " --set k=1" : "", option, text);
    return out;
}

/* The command of a row, as the page has it; of a misprint with a corrected one, that is the second; NULL: none. */
static const char *command_of(const row *r, bool second)
{
    bool claims = r->kind == CURRENT || r->kind == FIELD || r->kind == REFUTED;
    if (second) return claims && r->meant ? asked(r, r->meant) : NULL;
    return r->kind == NOT ? NULL : claims ? asked(r, r->printed) : DOCUMENTS[r->document].words;
}

static void claim(const row *r, finding *f)
{
    char answer[200], other[200];
    bool proved, again = false, good = yes(asked(r, r->printed), &proved, answer, sizeof answer);
    bool corrected = !good && r->meant && yes(asked(r, r->meant), &again, other, sizeof other);
    show(f, answer);
    f->good = good || corrected;
    f->misprint = corrected;
    if (r->kind == REFUTED && good) f->misprint = true, snprintf(f->finding, sizeof f->finding, "**misprint**: the statement is refuted%s", proved ? ", proved" : "");
    else if (good) snprintf(f->finding, sizeof f->finding, "agrees%s", proved ? ", proved" : "");
    else if (corrected) snprintf(f->finding, sizeof f->finding, "**misprint**: as printed refuted; corrected by the second command%s", again ? ": proved" : "");
    else snprintf(f->finding, sizeof f->finding, "**DISAGREES**");
}

/* ---- rows ---- */

static void by_words(const row *r, const document *d, finding *f)
{
    show(f, r->printed);
    f->good = words_in(d, r->printed) != NULL;
    f->misprint = f->good && r->meant;
    if (f->misprint) snprintf(f->finding, sizeof f->finding, "**misprint**: %s", r->meant);
    else snprintf(f->finding, sizeof f->finding, f->good ? "agrees" : "**DISAGREES**: the words are not there");
}

static void by_number(const row *r, const document *d, finding *f)
{
    double number = number_behind(d, atoi(r->of), r->label);
    snprintf(f->value, sizeof f->value, "`%s%.1e`", r->label, number);
    f->good = fabs(number) < enough;
    if (f->good) snprintf(f->finding, sizeof f->finding, "agrees to %d digits", digits_of(fabs(number)));
    else snprintf(f->finding, sizeof f->finding, "**DISAGREES**: %g", number);
}

static void by_computation(const row *r, const document *d, finding *f)
{
    double printed = INFINITY, meant = INFINITY;
    const char *line = r->section ? line_of(d, r->section, r->label) : NULL;
    if (line) show(f, line);
    else if (r->section) snprintf(f->value, sizeof f->value, "not there");
    else if (!strcmp(r->by, "solves")) show(f, r->part);
    else snprintf(f->value, sizeof f->value, "columns%s", strchr(r->part, ' '));
    if (r->kind == HOLDS) printed = violation(d, r->by, NULL);
    else by(r, d, &printed, &meant);
    conclude(f, printed, meant);
    if (r->section && !line) f->good = false, snprintf(f->finding, sizeof f->finding, "**DISAGREES**: the line %s is not there", r->label);
    if (r->ours && f->good) snprintf(f->finding, sizeof f->finding, "computed: holds to %d digits; the paper prints no value", digits_of(printed));
}

static finding find(const row *r)
{
    finding f = {.value = ""};
    const document *d = r->document < D_COUNT && r->kind != CURRENT && r->kind != FIELD && r->kind != REFUTED && r->kind != NOT ? document_of(r->document) : NULL;
    switch (r->kind) {
    case VALUE: compare(r, d, &f); break;
    case WORDS: by_words(r, d, &f); break;
    case NUMBER: by_number(r, d, &f); break;
    case HOLDS:
    case BY: by_computation(r, d, &f); break;
    case NOT:
        f.good = f.not = true;
        snprintf(f.value, sizeof f.value, "-");
        snprintf(f.finding, sizeof f.finding, "not computable: %s", r->printed);
        break;
    default: claim(r, &f);
    }
    if (r->ours && r->kind == CURRENT) snprintf(f.finding, sizeof f.finding, f.good ? "holds, proved; the paper does not say it" : "**DISAGREES**");
    else if (r->ours && f.good && r->kind != BY)
        snprintf(f.finding, sizeof f.finding, r->kind == NUMBER ? "holds" : "computed; the paper prints no value");
    return f;
}

#endif
