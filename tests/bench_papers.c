/* bench_papers: docs/papers.md: every numbered item of the three papers, with the command that shows it, the program's value on the paper's example, and
 * whether both agree: computed here, from the JSON of the commands, at random points.
 *
 * The exit code is 1 when something neither agrees nor is explained by a correction that does. */
#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "papers.h"

#include "commands/verify.h"
#include "evaluate/tape.h"
#include "geometry/determining.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"
#include "integrals/bracket.h"
#include "reduction/ideal_chain.h"

enum { points = 12, most_symbols = 60 };
static const double enough = 1e-9; /* below this, relative to the largest value, two things are the same */

/* ---- documents ---- */

typedef struct {
    nh_system *system;
    cJSON *root;
    size_t symbols;
    nh_ex symbol[most_symbols];
    double value[points][most_symbols];
} document;

static document documents[D_COUNT];

static void stop(const char *what, const char *detail)
{
    fprintf(stderr, "bench_papers: %s: %s\n", what, detail);
    exit(1);
}

static cJSON *run(const char *words)
{
    const char *program = getenv("NHSYM");
    char command[6000];
    size_t size = 1 << 22, length = 0;
    char *text = malloc(size);
    snprintf(command, sizeof command, "%s %s --quiet --json -", program ? program : "build/nhsym", words);
    FILE *pipe = popen(command, "r");
    if (!pipe || !text) stop("cannot run", words);
    for (size_t more; (more = fread(text + length, 1, size - length - 1, pipe)) > 0;) {
        length += more;
        if (length + 1 == size && !(text = realloc(text, size *= 2))) stop("no memory for", words);
    }
    text[length] = 0;
    pclose(pipe);
    cJSON *root = cJSON_Parse(text);
    free(text);
    if (!root) stop("no JSON from", words);
    return root;
}

static nh_system *system_of(const char *name, size_t settings, const nh_setting *setting)
{
    char path[200];
    nh_error error = {0};
    snprintf(path, sizeof path, strchr(name, '/') ? "%s" : "systems/%s.yaml", name);
    nh_system *s = nh_system_read(path, settings, setting, &error);
    if (!s) stop(path, error.what);
    return s;
}

/* Symbols of a system with random values: the same for every run. */
static void scatter(document *d)
{
    unsigned state = 17;
    nh_ex *e = d->symbol;
    *e++ = d->system->t;
    for (size_t i = 0; i < d->system->coordinates; i++) *e++ = d->system->coordinate[i].q, *e++ = d->system->coordinate[i].v;
    for (size_t i = 0; i < d->system->quasi; i++) *e++ = d->system->quasi_velocity[i];
    d->symbols = (size_t)(e - d->symbol);
    for (size_t p = 0; p < points; p++)
        for (size_t i = 0; i < d->symbols; i++) {
            state = state * 1664525u + 1013904223u;
            d->value[p][i] = (0.3 + 0.9 * (state >> 8) / (double)(1 << 24)) * (i % 2 ? 1 : 0.5); /* velocities, and t, are smaller */
        }
}

static document *document_of(int index)
{
    document *d = &documents[index];
    if (d->root) return d;
    d->root = run(DOCUMENTS[index].words);
    d->system = system_of(DOCUMENTS[index].system, 0, NULL);
    scatter(d);
    return d;
}

/* A member by its path: keys, numbers of entries, "last", "#name" for the entry whose field has this name. */
static const cJSON *at(const cJSON *from, const char *path)
{
    char word[120];
    for (size_t length; from && *path; path += length + (path[length] == '.')) {
        length = strcspn(path, ".");
        snprintf(word, sizeof word, "%.*s", (int)length, path);
        const cJSON *next = NULL, *item;
        if (!cJSON_IsArray(from)) next = cJSON_GetObjectItemCaseSensitive(from, word);
        else if (!strcmp(word, "last")) next = cJSON_GetArrayItem(from, cJSON_GetArraySize(from) - 1);
        else if (word[0] != '#') next = cJSON_GetArrayItem(from, atoi(word));
        else
            cJSON_ArrayForEach(item, from) if (!next && cJSON_GetArraySize(at(item, "field")) == 1 && cJSON_GetObjectItem(at(item, "field"), word + 1)) next = item;
        from = next;
    }
    return from;
}

static const char *text_at(const cJSON *from, const char *path)
{
    const cJSON *item = at(from, path);
    return cJSON_IsString(item) ? item->valuestring : "";
}

static nh_ex parsed(const document *d, const char *text)
{
    nh_error error = {0};
    nh_ex e;
    if (!nh_system_expression_text(d->system, "papers", text, 0, NULL, &e, &error)) stop(text, error.what);
    return e;
}

static void evaluate(const document *d, nh_ex e, double *out)
{
    const nh_ex *parameter;
    const double *numbers;
    nh_system_bindings(d->system, &parameter, &numbers);
    nh_tape *tape = nh_tape_create(d->system->dag, d->symbols, d->symbol, 1, &e, d->system->parameters, parameter, numbers);
    nh_tape_work *work = nh_tape_work_create(tape);
    for (size_t p = 0; p < points; p++) nh_tape_eval(tape, work, d->value[p], &out[p]);
    nh_tape_work_free(work);
    nh_tape_free(tape);
}

static void values(const document *d, const char *text, double *out) { evaluate(d, parsed(d, text), out); }

/* The lines of a section: of --equations, or "2.chain": of a stage. */
static const cJSON *section_of(const document *d, const char *name)
{
    const char *dot = strchr(name, '.');
    char path[120];
    if (!dot) snprintf(path, sizeof path, "equations.%s", name);
    else snprintf(path, sizeof path, "stages.%.*s.geometry.%s", (int)(dot - name), name, dot + 1);
    const cJSON *list = at(d->root, path);
    if (!list) stop("no section", path);
    return list;
}

/* The text of a coefficient: of the line with this label or number, or of the line #i; `of`: its factor, or =factor on the right side.  "0": not there. */
static const char *shown(const document *d, const char *section, const char *label, const char *of)
{
    const cJSON *line, *term, *list = section_of(d, section);
    cJSON_ArrayForEach(line, list) {
        bool here = label[0] == '#' ? line == cJSON_GetArrayItem(list, atoi(label + 1)) : !strcmp(text_at(line, "label"), label) || !strcmp(text_at(line, "number"), label);
        if (!here) continue;
        if (!of[0] && at(line, "expression")) return text_at(line, "expression");
        cJSON_ArrayForEach(term, at(line, of[0] == '=' ? "equals" : "terms"))
            if (!strcmp(text_at(term, "of"), of + (of[0] == '='))) return text_at(term, "coefficient");
    }
    return "0";
}

/* The largest difference relative to the largest value. */
static double apart(const double *got, const double *want)
{
    double error = 0, size = 0;
    for (size_t p = 0; p < points; p++) {
        error = isfinite(got[p]) && isfinite(want[p]) ? fmax(error, fabs(got[p] - want[p])) : INFINITY;
        size = fmax(size, fabs(want[p]));
    }
    return size > 0 ? error / size : error;
}

/* ---- findings ---- */

typedef struct {
    char value[400], finding[600];
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

static void show(finding *f, const char *text)
{
    enum { longest = 70 };
    if (strlen(text) <= longest) snprintf(f->value, sizeof f->value, "`%s`", text);
    else snprintf(f->value, sizeof f->value, "%zu characters", strlen(text));
}

static void compare(const row *r, const document *d, const char *text, finding *f)
{
    double got[points], want[points], printed, meant = INFINITY;
    show(f, text);
    values(d, text, got);
    values(d, r->printed, want);
    printed = apart(got, want);
    if (r->meant) values(d, r->meant, want), meant = apart(got, want);
    conclude(f, printed, meant);
}

/* ---- is it conserved, is it a symmetry? ---- */

static nh_verification *ask(const row *r, const char *text)
{
    nh_error error = {0};
    nh_options options;
    nh_setting setting = {.name = "k", .value = r->k};
    nh_options_default(&options);
    nh_system *s = system_of(r->label, r->k > 0, &setting);
    nh_verification *v = (r->kind == CURRENT ? nh_verification_of_current : nh_verification_of_field)(s, NH_CHART_COORDINATES, text, &options, &error);
    if (!v) stop(text, error.what);
    return v;
}

static void claim(const row *r, finding *f)
{
    nh_verification *v = ask(r, r->printed), *w = !v->conserved && r->meant ? ask(r, r->meant) : NULL;
    snprintf(f->value, sizeof f->value, "%s", v->conserved ? r->kind == CURRENT ? "conserved" : "a constraint symmetry" : v->region ? "only in a region" : "no");
    f->good = v->conserved || (w && w->conserved);
    f->misprint = w && w->conserved;
    const char *proved = (v->conserved ? v : w ? w : v)->proof.proved ? "proved" : "to 50 digits";
    if (r->kind == REFUTED && v->conserved) f->misprint = true, snprintf(f->finding, sizeof f->finding, "**misprint**: the statement is refuted, %s", proved);
    else if (v->conserved) snprintf(f->finding, sizeof f->finding, "agrees, %s", proved);
    else if (f->misprint && v->region) snprintf(f->finding, sizeof f->finding, "**misprint**: as printed only %s; corrected: %s", v->region, proved);
    else if (f->misprint) snprintf(f->finding, sizeof f->finding, "**misprint**: as printed refuted, residual %.1e; corrected: %s", v->residual, proved);
    else snprintf(f->finding, sizeof f->finding, "**DISAGREES**: residual %.1e", v->residual);
    nh_verification_free(v);
    if (w) nh_verification_free(w);
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
    char path[120];
    snprintf(path, sizeof path, "symmetry.components.%s", name);
    return parsed(d, text_at(d->root, path));
}

/* Phi, Z^0, Z^x, zeta^x or Ztilde^x of the document's current. */
static nh_ex unknown(const document *d, const char *name)
{
    nh_dag *g = d->system->dag;
    char velocity[80];
    if (!strcmp(name, "Phi")) return parsed(d, text_at(d->root, "current"));
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
    const cJSON *line, *term;
    double worst = 0;
    size_t l = 0;
    cJSON_ArrayForEach(line, section_of(d, "determining_equations")) {
        double sum[points] = {0}, size[points] = {0}, value[points];
        if (strncmp(text_at(line, "number") + 1, number, 2)) continue;
        cJSON_ArrayForEach(term, at(line, "terms")) {
            evaluate(d, nh_mul(d->system->dag, parsed(d, text_at(term, "coefficient")), applied(d, text_at(term, "of"))), value);
            for (size_t p = 0; p < points; p++) sum[p] += value[p], size[p] += fabs(value[p]);
        }
        if (more) evaluate(d, more[l++], value);
        for (size_t p = 0; p < points; p++) worst = fmax(worst, size[p] > 0 ? fabs(sum[p] + (more ? value[p] : 0)) / size[p] : 0);
    }
    return worst;
}

#include "bench_papers_by.h"
#include "bench_papers_variation.h"

/* ---- rows ---- */

static void is(const row *r, const document *d, finding *f)
{
    const cJSON *item = at(d->root, r->label);
    char *text = item ? cJSON_PrintUnformatted(item) : NULL, *bare = text;
    if (!text) stop("nothing at", r->label);
    if (text[0] == '"') bare++, text[strlen(text) - 1] = 0;
    show(f, bare);
    f->good = !strcmp(bare, r->printed);
    snprintf(f->finding, sizeof f->finding, f->good ? "agrees" : "**DISAGREES**: expected `%s`", r->printed);
    free(text);
}

static void small(const row *r, const document *d, finding *f)
{
    const cJSON *item = at(d->root, r->label);
    if (!cJSON_IsNumber(item)) stop("no number at", r->label);
    snprintf(f->value, sizeof f->value, "%.1e", item->valuedouble);
    f->good = fabs(item->valuedouble) < enough;
    snprintf(f->finding, sizeof f->finding, f->good ? "agrees to %d digits" : "**DISAGREES** (%d)", digits_of(fabs(item->valuedouble)));
}

static finding find(const row *r)
{
    finding f = {.value = ""};
    const document *d = r->document < D_COUNT ? document_of(r->document) : NULL;
    double printed = INFINITY, meant = INFINITY;
    switch (r->kind) {
    case VALUE: compare(r, d, shown(d, r->section, r->label, r->of), &f); break;
    case AT: compare(r, d, text_at(d->root, r->label), &f); break;
    case HOLDS: printed = violation(d, r->of, NULL); snprintf(f.value, sizeof f.value, "residual %.1e", printed); conclude(&f, printed, INFINITY); break;
    case IS: is(r, d, &f); break;
    case SMALL: small(r, d, &f); break;
    case BY:
        if (!by_variation(r, d, &printed, f.value, sizeof f.value)) by(r, d, &printed, &meant, f.value, sizeof f.value);
        conclude(&f, printed, meant);
        break;
    case NOT: f.good = f.not = true; snprintf(f.value, sizeof f.value, "-"); snprintf(f.finding, sizeof f.finding, "not computable: %s", r->printed); break;
    default: claim(r, &f);
    }
    if (r->ours && f.good && r->kind == BY)
        snprintf(f.finding, sizeof f.finding, "computed: holds to %d digits; the paper prints no value",
                 digits_of(printed));
    else if (r->ours && f.good)
        snprintf(f.finding, sizeof f.finding, r->kind == SMALL ? "holds" : "computed; the paper prints no value");
    return f;
}

/* Characters that a table takes for its own. */
static void put(const char *text)
{
    for (const char *c = text; *c; c++) printf(*c == '|' ? "\\|" : "%c", *c);
}

static void put_command(const row *r)
{
    char words[700];
    enum { longest = 110 };
    const char *name = r->kind == REFUTED ? "Gamma/Lbar" : strlen(r->printed ? r->printed : "") <= longest ? r->printed : r->item;
    const char *quote = name == r->printed ? "\"" : "";
    words[0] = 0;
    if (r->document < D_COUNT) snprintf(words, sizeof words, "nhsym %s", DOCUMENTS[r->document].shown ? DOCUMENTS[r->document].shown : DOCUMENTS[r->document].words);
    else if (r->kind == CURRENT) snprintf(words, sizeof words, "nhsym verify %s%s --current %s%s%s", r->label, r->k > 0 ? " --set k=1" : "", quote, name, quote);
    else if (r->kind == FIELD || r->kind == REFUTED) snprintf(words, sizeof words, "nhsym verify %s --field %s%s%s", r->label, quote, name, quote);
    else if (r->kind != NOT) snprintf(words, sizeof words, "%s", !strcmp(r->label, "crane metric") ? "nhsym verify crane --equations --current t" : "make papers");
    if (words[0]) put("`"), put(words), put("`");
    else printf("-");
}

int main(void)
{
    static const char *const papers[][2] = {{"sym", "Čech, Musilová: Symmetries and currents in nonholonomic mechanics [CechMusilova2014]"},
                                            {"chains", "Chhabra, Emami: Nonholonomic dynamical reduction of open-chain multi-body systems [ChhabraEmami2014]"},
                                            {"stages", "Cendra, Díaz: Lagrange-d'Alembert-Poincaré equations by several stages [CendraDiaz2018]"}};
    size_t count = 0, misprints = 0, not = 0, ours = 0, bad = 0;
    for (size_t k = 0; k < 3; k++) {
        printf("## %s\n\n| item | what | command | the program's value | finding |\n|---|---|---|---|---|\n", papers[k][1]);
        for (size_t i = 0; i < sizeof ROWS / sizeof *ROWS; i++) {
            const row *r = &ROWS[i];
            if (strcmp(r->paper, papers[k][0])) continue;
            finding f = find(r);
            printf("| %s | ", r->item);
            put(r->what);
            printf(" | ");
            put_command(r);
            printf(" | ");
            put(f.value);
            printf(" | ");
            put(f.finding);
            printf(" |\n");
            count++;
            misprints += f.misprint;
            not += f.not;
            ours += f.good && r->ours;
            bad += !f.good;
        }
        printf("\n");
    }
    printf("%zu rows: %zu agree, %zu misprints, %zu computed without a printed value, %zu not computable, %zu disagree.\n", count, count - misprints - not - ours - bad, misprints, ours,
           not, bad);
    for (size_t i = 0; i < D_COUNT; i++) {
        cJSON_Delete(documents[i].root);
        if (documents[i].system) nh_system_free(documents[i].system);
    }
    return bad > 0;
}
