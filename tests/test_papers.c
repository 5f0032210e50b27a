/* papers: every row of docs/papers.md: its command runs as the page has it, its text shows the value, and the value is what the paper prints, or what is
 * right where the paper has a misprint. */
#include <criterion/criterion.h>

#include "papers_find.h"

static void all_rows_of(const char *paper)
{
    size_t count = 0;
    for (size_t i = 0; i < sizeof ROWS / sizeof *ROWS; i++) {
        if (strcmp(ROWS[i].paper, paper)) continue;
        finding f = find(&ROWS[i]);
        cr_expect(f.good, "%s, %s: %s, %s", ROWS[i].item, ROWS[i].what, f.value, f.finding);
        count++;
    }
    cr_expect_gt(count, 30);
    documents_close();
}

Test(papers, symmetries_and_currents) { all_rows_of("sym"); }
Test(papers, open_chains) { all_rows_of("chains"); }
Test(papers, equations_by_several_stages) { all_rows_of("stages"); }

/* Each kind of row, with something wrong in it. */
Test(papers, a_row_that_is_wrong_is_seen)
{
    static const row wrong[] = {
        {"sym", "a coefficient", "", VALUE, D_SHOW, "semispray", "Gamma", "d/dx'", .printed = "a*phi'^2*cos(phi) + phi'*x'*tan(phi)"},
        {"sym", "a label that is not there", "", VALUE, D_SHOW, "lagrangian", "Lbar_x", "", .printed = "m"},
        {"sym", "a section that is not there", "", VALUE, D_SHOW, "currents", "F_1(Phi)", "", .printed = "0"},
        {"sym", "words", "", WORDS, D_SHOW, .printed = "Constraint semispray (22)"},
        {"sym", "a number", "", NUMBER, D_PENDULUM, .label = "energy drifts at ", .of = "1"},
        {"sym", "a current", "", CURRENT, D_NONE, .label = "sleigh", .printed = "x'"},
        {"sym", "a field", "", FIELD, D_NONE, .label = "sleigh", .printed = "Gamma"},
        {"sym", "determining equations of another field", "", HOLDS, D_SHOW, .by = "99", .section = "determining_equations", .label = "(14)"},
        {"sym", "a formula with a sign that is wrong", "", BY, D_SHOW, .by = "before 25", .section = "semispray", .label = "Delta"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        finding f = find(&wrong[i]);
        cr_expect_not(f.good, "%s: %s, %s", wrong[i].item, f.value, f.finding);
    }
    documents_close();
}

/* A misprint is one only where the printed form was evaluated, and is off. */
Test(papers, a_right_formula_is_no_misprint)
{
    row r = {"sym", "(32)", "", VALUE, D_SHOW, "semispray", "Gamma", "d/dx'", .printed = "a*phi'^2*cos(phi) - phi'*x'*tan(phi)", .meant = "0"};
    cr_expect_not(find(&r).misprint);
    r.printed = "0";
    r.meant = "a*phi'^2*cos(phi) - phi'*x'*tan(phi)";
    cr_expect(find(&r).misprint);
    documents_close();
}

/* The page has each row with its commands, and nothing that disagrees or that no command shows. */
Test(papers, the_page_has_every_row)
{
    FILE *file = fopen("docs/papers.md", "r");
    cr_assert_not_null(file);
    static char page[1 << 20];
    page[fread(page, 1, sizeof page - 1, file)] = 0;
    fclose(file);
    for (size_t i = 0; i < sizeof ROWS / sizeof *ROWS; i++) {
        char head[8000];
        const char *first = command_of(&ROWS[i], false), *second = command_of(&ROWS[i], true);
        snprintf(head, sizeof head, "| %s | %s | %s%s%s", ROWS[i].item, ROWS[i].what, first ? "`" : "-", first ? first : "", first ? "`" : "");
        cr_expect_not_null(strstr(page, head), "`make papers` writes the page again; it lacks\n%s", head);
        if (second) cr_expect_not_null(strstr(page, second), "`make papers` writes the page again; it lacks\n%s", second);
        cr_expect(first || ROWS[i].kind == NOT, "%s", ROWS[i].item);
    }
    cr_expect_null(strstr(page, "DISAGREES"));
    cr_expect_not_null(strstr(page, " 0 disagree."));
}
