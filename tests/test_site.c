/* The documentation as a site (docs/site): all pages are made, every link leads somewhere, and the search works from files.
 * Without pandoc, which `make check` does not install, the test is skipped. */
#include "program.h"
#include "sweep.h"

static finished shell(const place *p, const char *command)
{
    char *argument[] = {"sh", "-c", (char *)command, NULL};
    return run_vector(p, &(manner){0}, argument);
}

/* docs/NAME.md -> NAME.html, whose last link leads to a neighbour. */
static size_t pages_are_there(const place *p)
{
    DIR *docs = opendir("docs");
    size_t pages = 0;
    cr_assert(docs);
    for (struct dirent *entry; (entry = readdir(docs));) {
        char path[300], *end = strstr(entry->d_name, ".md");
        if (!end) continue;
        snprintf(path, sizeof path, "site/%.*s.html", (int)(end - entry->d_name), entry->d_name);
        char *page = read_here(p, path);
        cr_expect(page && strstr(page, "<h1") && (strstr(page, "class=\"prev\"") || strstr(page, "class=\"next\"")), "%s", path);
        cr_expect(page && !strstr(page, "src=\"http") && !strstr(page, "<link rel=\"stylesheet\" href=\"http"), "%s wants a network", path);
        free(page);
        pages++;
    }
    closedir(docs);
    return pages;
}

/* Every function of nhsym.h and every class of the package has its place. */
static void interfaces_are_complete(const place *p)
{
    char *page = read_here(p, "site/api_c.html"), line[1000], wanted[200];
    size_t functions = 0;
    FILE *header = fopen("src/nhsym.h", "r");
    while (fgets(line, sizeof line, header)) {
        char *paren = strchr(line, '('), *name = paren;
        if (strncmp(line, "NH_API ", 7) || !paren) continue;
        while (name[-1] == '_' || (name[-1] >= 'a' && name[-1] <= 'z')) name--;
        snprintf(wanted, sizeof wanted, "id=\"%.*s\"", (int)(paren - name), name);
        cr_expect_not_null(strstr(page, wanted), "api_c.html has no %s", wanted);
        functions++;
    }
    fclose(header);
    cr_expect_geq(functions, 40);
    free(page);
    page = read_here(p, "site/api_python.html");
    const char *const some[] = {"id=\"system\"", "id=\"systemsimulate\"", "id=\"currentalong\"", "id=\"inputerror\"", "&gt;&gt;&gt; nhsym.system(&quot;sleigh&quot;"};
    for (size_t i = 0; i < sizeof some / sizeof *some; i++) cr_expect_not_null(strstr(page, some[i]), "api_python.html has no %s", some[i]);
    free(page);
}

/* A dead link and a dead anchor are found; what was there before has none, or the build would have failed. */
static void dead_links_are_found(const place *p)
{
    char command[2 * PATH_MAX];
    snprintf(command, sizeof command, "echo '<a href=\"nowhere.html\">a</a> <img src=\"method.html#no-such-section\">' >>site/faq.html; python3 '%.4000s/docs/site/make.py' --check site", p->project);
    finished f = shell(p, command);
    cr_expect(f.code == 1 && strstr(f.err, "faq.html: no file nowhere.html") && strstr(f.err, "faq.html: no anchor method.html#no-such-section"), "%d: %s", f.code, f.err);
    finished_clear(&f);
}

/* A product whose stars Markdown takes for emphasis, and emphasis. */
static void torn_formulas_are_found(const place *p)
{
    char command[2 * PATH_MAX];
    snprintf(command, sizeof command,
             "cd '%.4000s/docs/site' && python3 -B -c \"import make; print(make.torn(make.converted({'a.md': 'so a*b - c*d is'})['a.md']), make.torn(make.converted({'a.md': 'a *bold* (*b*) word'})['a.md']))\"",
             p->project);
    finished f = shell(p, command);
    cr_expect_str_eq(f.out, "so a<em>b - c None\n", "%s", f.err);
    finished_clear(&f);
}

static bool search_finds(const place *p)
{
    char command[2 * PATH_MAX];
    snprintf(command, sizeof command,
             "command -v chromium >/dev/null || exit 3\nHOME='%.2000s' timeout 100 chromium --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --disable-background-networking "
             "--virtual-time-budget=3000 --user-data-dir='%.2000s/browser' --dump-dom 'file://%.2000s/site/faq.html?q=benchmark+capsize' 2>/dev/null",
             p->folder, p->folder, p->folder);
    finished f = shell(p, command);
    bool there = f.code != 3;
    char *results = strstr(f.out, "id=\"results\""), *first = results ? strstr(results, "<a href=\"") : NULL;
    if (there) cr_expect(first && !strncmp(first + 9, "linearize.html#whipples-bicycle\"", 32), "%.300s", results ? results : f.out);
    finished_clear(&f);
    return there;
}

Test(site, is_made_has_no_dead_link_and_is_searched, PLAIN_ONLY)
{
    place p = place_make();
    char command[3 * PATH_MAX];
    snprintf(command, sizeof command, "command -v pandoc >/dev/null || exit 3\nout=$PWD/site\ncd '%.4000s' && python3 docs/site/make.py \"$out\" '%.4000s' pendulum", p.project, p.program);
    finished f = shell(&p, command);
    bool made = f.code != 3, searched = false;
    if (made) {
        cr_assert_eq(f.code, 0, "%s", f.err);
        cr_expect_geq(pages_are_there(&p), 24);
        char *gallery = read_here(&p, "site/gallery.html"), *live = read_here(&p, "site/gallery/pendulum.html");
        cr_expect(gallery && live && strstr(gallery, "href=\"gallery/pendulum.html\"") && strstr(gallery, "src=\"docs/catalogue/pendulum.svg\""));
        free(gallery), free(live);
        interfaces_are_complete(&p);
        torn_formulas_are_found(&p);
        searched = search_finds(&p);
        dead_links_are_found(&p);
    }
    finished_clear(&f);
    place_clear(&p);
    if (!made) {
        cr_log_warn("skipped: there is no pandoc");
        cr_skip_test("no pandoc");
    }
    if (!searched) cr_log_warn("site: the search was not tried, there is no chromium");
}
