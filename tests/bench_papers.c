/* bench_papers: docs/papers.md: every numbered item of the three papers, with the command that shows it, the value that stands in its text, and
 * whether both agree: computed here, from that text, at random points.
 *
 * The exit code is 1 when something neither agrees nor is explained by a correction that does. */
#include "papers_find.h"

/* Characters that a table takes for its own. */
static void put(const char *text)
{
    for (const char *c = text; *c; c++) printf(*c == '|' ? "\\|" : "%c", *c);
}

static void put_code(const char *text)
{
    if (!text) return;
    printf("`");
    put(text);
    printf("`");
}

static void put_row(const row *r, const finding *f)
{
    const char *first = command_of(r, false), *second = f->misprint ? command_of(r, true) : NULL;
    printf("| %s | ", r->item);
    put(r->what);
    printf(" | ");
    if (first) put_code(first);
    else printf("-");
    if (second) printf("<br>"), put_code(second);
    printf(" | ");
    put(f->value);
    printf(" | ");
    put(f->finding);
    printf(" |\n");
}

int main(void)
{
    static const char *const papers[][2] = {{"sym", "Čech, Musilová: Symmetries and currents in nonholonomic mechanics [CechMusilova2014]"},
                                            {"chains", "Chhabra, Emami: Nonholonomic dynamical reduction of open-chain multi-body systems [ChhabraEmami2014]"},
                                            {"stages", "Cendra, Díaz: Lagrange-d'Alembert-Poincaré equations by several stages [CendraDiaz2018]"}};
    size_t count = 0, misprints = 0, not = 0, ours = 0, bad = 0;
    for (size_t k = 0; k < 3; k++) {
        printf("## %s\n\n| item | what | command | its text shows | finding |\n|---|---|---|---|---|\n", papers[k][1]);
        for (size_t i = 0; i < sizeof ROWS / sizeof *ROWS; i++) {
            const row *r = &ROWS[i];
            if (strcmp(r->paper, papers[k][0])) continue;
            finding f = find(r);
            put_row(r, &f);
            count++;
            misprints += f.misprint;
            not += f.not;
            ours += f.good && r->ours && !f.misprint;
            bad += !f.good;
        }
        printf("\n");
    }
    printf("%zu rows: %zu agree, %zu misprints, %zu computed without a printed value, %zu not computable, %zu disagree.\n", count, count - misprints - not - ours - bad, misprints, ours,
           not, bad);
    documents_close();
    return bad > 0;
}
