/* Text from files stays text in every language that it is written into; files are read once in a run. */
#include <criterion/criterion.h>

#include "system/deck.h"
#include "base/escape.h"
#include "base/files.h"
#include "program.h"
#include "scratch.h"

static const char hostile[] =
    "name: hostile\n"
    "title: \"a */ #error injected\\n#include \\\"x\\\" ?\?/ /* \\\\\\n\\\\input{x} <script>alert(1)</script> & ]]> % $ ^ _ ~ # =1+1 'r' \\\\\"\n"
    "source: \"*/ <b>\\\\end{document} ${x}\\n--> ]]>\"\n"
    "parameters: [{name: g, value: 9.81, doc: \"<script>alert(2)</script> \\\\input{y}\\n*/\"}]\n"
    "coordinates: [{name: x, doc: \"</math><script>\" }, {name: y}]\n"
    "lagrangian: (x'^2 + y'^2)/2 - g*y\n"
    "known: {currents: [{name: \"=cmd|'/c calc'!A1\", expr: x'}, {name: \"a,\\\"b\\\"\\nc\", expr: \"y' + g*t\"}, {name: \"<script>alert(3)</script>&\", expr: \"x - x'*t\"}]}\n";

/* A system of tags that match, and entities that are known. */
static bool is_xml(const char *s)
{
    char open[200][40];
    int depth = 0;
    if (!strncmp(s, "<!DOCTYPE html>", 15)) s += 15;
    while (*s) {
        if (!strncmp(s, "<![CDATA[", 9)) {
            if (!(s = strstr(s, "]]>"))) return false;
            s += 3;
        } else if (*s == '<') {
            char name[40];
            bool end = s[1] == '/', quote = false;
            if (sscanf(s + 1 + end, "%39[^ \t\n/>]", name) != 1) return false;
            const char *last = s;
            while (*s && (quote || *s != '>')) {
                if (*s == '"') quote = !quote;
                if (*s == '<' && s != last) return false;
                s++;
            }
            if (*s++ != '>') return false;
            if (end && (depth == 0 || strcmp(open[--depth], name))) return false;
            if (!end && s[-2] != '/' && name[0] != '?') snprintf(open[depth++], 40, "%s", name);
            if (depth == 200) return false;
        } else if (*s == '&') {
            size_t n = strcspn(s, ";");
            if (n > 8) return false;
            s += n;
        } else {
            s++;
        }
    }
    return depth == 0;
}

static void check_page(const place *p, const char *line, const char *name)
{
    finished f = run_expecting(p, line, 0);
    finished_clear(&f);
    char *page = read_here(p, name);
    cr_assert_not_null(page, "%s", line);
    cr_expect(is_xml(page), "%s", line);
    cr_expect_null(strstr(page, "<script>alert"), "%s", line);
    free(page);
}

Test(hostile, pages_and_plots)
{
    place p = place_make();
    write_here(&p, "hostile.yaml", hostile);
    check_page(&p, "analyze hostile.yaml --quiet --html page.html", "page.html");
    check_page(&p, "verify hostile.yaml --quiet --current x' --html page.html", "page.html");
    check_page(&p, "simulate hostile.yaml --quiet --initial x'=1 --until 1 --html page.html", "page.html");
    check_page(&p, "reduce hostile.yaml --quiet --html page.html", "page.html");
    check_page(&p, "benchmark hostile.yaml --quiet --initial x'=1 --budget 1s --html page.html --svg plot.svg", "page.html");
    check_page(&p, "benchmark hostile.yaml --quiet --initial x'=1 --budget 1s --svg plot.svg", "plot.svg");
    place_clear(&p);
}

Test(hostile, code)
{
    place p = place_make();
    double none[1];
    char all[40000];
    write_here(&p, "hostile.yaml", hostile);
    finished f = run_expecting(&p, "reduce hostile.yaml --to c", 0);
    snprintf(all, sizeof all, "%s\nint main(void) { return 0; }\n", f.out);
    cr_expect_eq(scratch_run_c(all, none, 1), 0, "%s", f.out);
    finished_clear(&f);
    f = run_expecting(&p, "reduce hostile.yaml --to latex", 0);
    cr_expect(f.out[0] == '%' && !strncmp(strchr(f.out, '\n'), "\n\\providecommand", 15), "%s", f.out);
    finished_clear(&f);
    f = run_expecting(&p, "analyze hostile.yaml --quiet --tex page.tex", 0);
    char *tex = read_here(&p, "page.tex");
    cr_expect(tex && !strstr(tex, "\\input{") && strstr(tex, "\\end{document}") && !strstr(strstr(tex, "\\end{document}") + 1, "\\end{document}"));
    free(tex);
    finished_clear(&f);
    place_clear(&p);
}

/* Every line of the table has as many fields; none begins a formula. */
Test(hostile, tables)
{
    place p = place_make();
    write_here(&p, "hostile.yaml", hostile);
    finished f = run_expecting(&p, "simulate hostile.yaml --initial x'=1 --until 1 --step 0.5", 0);
    size_t fields[8] = {0}, lines = 0;
    bool quoted = false, begins = true;
    for (const char *c = f.out; *c && lines < 8; c++) {
        if (begins) cr_expect(!strchr("=+@", *c == '"' ? c[1] : *c), "%.40s", c);
        begins = !quoted && (*c == ',' || *c == '\n');
        if (*c == '"') quoted = !quoted;
        else if (*c == ',' && !quoted) fields[lines]++;
        else if (*c == '\n') lines++;
    }
    cr_expect_eq(lines, 4, "%s", f.out);
    for (size_t i = 1; i < 4; i++) cr_expect_eq(fields[i], fields[0], "%s", f.out);
    cr_expect(strstr(f.out, ",cmd_dot_c_calc_dot_A1,a_b_c,"), "%s", f.out);
    finished_clear(&f);
    place_clear(&p);
}

Test(hostile, what_is_not_seen_is_refused)
{
    static const char *const titles[] = {"a\xe2\x80\xae" "b", "a\xe2\x81\xa6" "b", "a\xe2\x80\x8e" "b", "a\\u202Eb", "a\\u2069b", "a\\u200Fb", "a\\u061Cb", "a\\x1Bb"};
    for (size_t i = 0; i < sizeof titles / sizeof *titles; i++) {
        char text[200];
        nh_error error = {0};
        int n = snprintf(text, sizeof text, "name: t\ntitle: \"%s\"\n", titles[i]);
        nh_deck *deck = nh_deck_parse("f.yaml", text, (size_t)n, &error);
        cr_expect(!deck && error.code == NH_INPUT && strstr(error.where, "f.yaml:2:"), "%s: %s: %s", titles[i], error.where, error.what);
        nh_deck_free(deck);
    }
}

static const char *escaped(void (*escape)(const char *text, nh_text *out), const char *text)
{
    static nh_text out;
    nh_text_clear(&out);
    nh_text_init(&out);
    escape(text, &out);
    return nh_text_string(&out);
}

Test(hostile, languages)
{
    cr_expect_str_eq(escaped(nh_escape_c_comment, "a*//*b?\?/c\nd\\"), "a* // *b? ?/c d\\ ");
    cr_expect_str_eq(escaped(nh_escape_line, "a\nb\r\tc\x1b\xff"), "a b  c??");
    cr_expect_str_eq(escaped(nh_escape_xml, "<a b=\"c\">&'\x01\xc3\xa9"), "&lt;a b=&quot;c&quot;&gt;&amp;&#39;?\xc3\xa9");
    cr_expect_str_eq(escaped(nh_escape_terminal, "a\x1b[31m\n\xe2\x80\xae" "b\r\n\x9b"), "a?[31m\n?b\r\n?");
}

Test(hostile, terminal)
{
    place p = place_make();
    finished f = run_expecting(&p, "show no\x1b[31m.yaml", 3);
    cr_expect(!strchr(f.err, '\x1b') && strstr(f.err, "no?[31m.yaml"), "%s", f.err);
    finished_clear(&f);
    write_here(&p, "bidi.yaml", "name: t\ntitle: a\xe2\x80\xae" "b\x1b[2J\n");
    f = run_expecting(&p, "show bidi.yaml", 0);
    cr_expect_str_eq(f.out, "name: t\ntitle: a?b?[2J\n");
    finished_clear(&f);
    place_clear(&p);
}

/* ---- files are read once ---- */

Test(hostile, a_file_is_read_once)
{
    char path[SCRATCH];
    size_t length;
    nh_error error = {0};
    for (int kept = 1; kept >= 0; kept--) {
        cr_assert(scratch_text(path, "first"));
        if (kept) nh_files_begin();
        char *one = nh_files_read(path, 100, &length, &error);
        FILE *file = fopen(path, "w");
        cr_assert(one && file && fputs("second", file) >= 0 && fclose(file) == 0);
        char *two = nh_files_read(path, 100, &length, &error);
        cr_expect(two && length == (kept ? 5 : 6) && !strncmp(two, kept ? "first" : "second", length));
        free(one);
        free(two);
        unlink(path);
        if (kept) nh_files_end();
    }
}

/* Pipes give their text once; figures with other parameters need system and analysis again. */
Test(hostile, pipes)
{
    static const char system_text[] = "name: ok\nparameters: [{name: k, value: 1}]\ncoordinates: [{name: x}]\nlagrangian: x'^2/2 - k*x^2/2\n";
    static const char analysis[] = "name: an\nsystem: ok\nvalidate: {initial: {x: 1}, time: [0, 2]}\nfigures: [{title: T, plot: [\"a = x\"], vary: {k: [1, 2]}, time: [0, 1]}]\n";
    place p = place_make();
    char name[2][PATH_MAX + 20];
    for (int i = 0; i < 2; i++) {
        snprintf(name[i], sizeof name[i], "%s/%s", p.folder, i ? "analysis.fifo" : "system.fifo");
        cr_assert_eq(mkfifo(name[i], 0600), 0);
        pid_t writer = fork();
        if (writer == 0) {
            FILE *file = fopen(name[i], "w");
            if (file) fputs(i ? analysis : system_text, file), fclose(file);
            _exit(0);
        }
    }
    finished f = run_expecting(&p, "analyze ./system.fifo --analysis ./analysis.fifo --html page.html", 0);
    cr_expect_null(strstr(f.out, "missing"), "%s", f.out);
    char *page = read_here(&p, "page.html");
    cr_expect(page && strstr(page, "k = 2"));
    free(page);
    finished_clear(&f);
    while (wait(NULL) > 0) {}
    for (int i = 0; i < 2; i++) unlink(name[i]);
    place_clear(&p);
}

/* A formula of megabytes, as equations of long chains have them: one whose rest is measured for each character takes hours. */
Test(hostile, long_texts_are_mended)
{
    enum { characters = 1 << 23 };
    char *text = malloc(characters + 1);
    cr_assert_not_null(text);
    memset(text, 'x', characters);
    text[characters - 1] = '\xff';
    text[characters] = 0;
    nh_text out;
    nh_text_init(&out);
    nh_utf8_mend(text, &out);
    cr_expect_eq(out.length, (size_t)characters + 2);
    cr_expect_str_eq(nh_text_string(&out) + characters - 1, "\xef\xbf\xbd");
    nh_text_clear(&out);
    nh_escape_line(text, &out);
    cr_expect_eq(out.length, (size_t)characters);
    nh_text_clear(&out);
    free(text);
}
