/* bench_stages: what each row of the search (search/staged_search.c) finds that the others do not.
 *
 *     bench_stages FOLDER [base|stored|greedy|main|selections|rows|leave|whole|all [SET]]     prints the page docs/stages.md
 *
 * Every system of every set is analysed by a process of its own, on one thread, with all rows and with some left out; its counted work, its memory and,
 * as a last resort, its processor time are bounded.  Results are kept in FOLDER, a file per system, so that a run continues where it was stopped.  The second
 * word ends it early: `base` runs all rows only, `stored` nothing, `greedy` for the last table only, `main` the first two selections and each row, `selections` and `leave` all
 * up to that table; `whole` also runs what need not be run (below).  With the third word only one set is looked at.
 *
 * Two runs are the same where the second leaves out, besides, only rows that found nothing in the first: then the second is not made. */
#include <errno.h>
#include <inttypes.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "base/progress.h"
#include "perturbed.h"
#include "published.h"
#include "random_system.h"
#include "search/search.h"
#include "unseen.h"

enum { MOST_TASKS = 600, MOST_RESULTS = 300, MOST_FORMULAS = 24, RANDOM_SYSTEMS = 60, SETS = 5, longest_shown = 110 };

static const double long_run = 8; /* s: a system that takes longer with all rows is not measured */
static const double megabytes = 1500, cpu_limit = 60;

/* With the analysis file of the same name, whose fits come first. */
#define ANALYSIS (UINT64_C(1) << 62)

static const char *const set_name[SETS] = {"catalogue", "published", "unseen", "random", "generated"};

typedef struct {
    uint64_t mask, used;
    int status; /* 0: an answer; 1: an error; 2: beyond the limit of processor time, or it crashed */
    size_t independent, proved, general, series, pieces, furthers, length;
    double seconds;
    size_t formulas, losts;
    char *formula[MOST_FORMULAS]; /* of the independent integrals */
    char *lost[MOST_FORMULAS];    /* those of the run with all rows that are no functions of these */
    bool run;                     /* and not known from another one */
} result;

typedef struct {
    size_t set;
    char name[120], path[4200], file[4200];
    size_t results;
    result *result;
} task;

static task tasks[MOST_TASKS];
static size_t task_count, rows;
static bool stored_only, whole;
static const char *only; /* this set; NULL: all */

/* ---- the sets ---- */

static void plain(char *name)
{
    for (; *name; name++)
        if (*name == '/' || *name == '|') *name = ' ';
}

static void add_task(size_t set, const char *folder, const char *name, const char *path)
{
    if (task_count == MOST_TASKS) exit(2);
    task *t = &tasks[task_count++];
    *t = (task){.set = set, .result = calloc(MOST_RESULTS, sizeof *t->result)};
    snprintf(t->name, sizeof t->name, "%s", name);
    snprintf(t->path, sizeof t->path, "%s", path);
    snprintf(t->file, sizeof t->file, "%.3900s/%s - %.100s.txt", folder, set_name[set], name);
    plain(t->name);
    plain(t->file + strlen(folder) + 1);
}

/* A system file of the set, to be written. */
static FILE *open_system(size_t set, const char *folder, const char *name, char path[4096])
{
    snprintf(path, 4096, "%.3800s/%s - %.200s.yaml", folder, set_name[set], name);
    plain(path + strlen(folder) + 1);
    FILE *out = fopen(path, "w");
    if (!out) exit(2);
    return out;
}

static void add_text(size_t set, const char *folder, const char *name, const char *text)
{
    char path[4096];
    FILE *out = open_system(set, folder, name, path);
    fprintf(out, "name: stages\n%s", text);
    fclose(out);
    add_task(set, folder, name, path);
}

static void add_random(size_t set, const char *folder)
{
    for (size_t i = 0; i < RANDOM_SYSTEMS; i++) {
        char name[20], path[4096];
        random_system r = random_system_create(1000003 + i);
        snprintf(name, sizeof name, "random%zu", i);
        FILE *out = open_system(set, folder, name, path);
        random_system_write(&r, "random", out);
        fclose(out);
        nh_dag_free(r.dag);
        add_task(set, folder, name, path);
    }
}

/* A shipped system with a small term added (perturbed.h). */
static void add_perturbed(size_t set, const char *folder, const char *name)
{
    char from[4096], path[4096];
    nh_error error = {0};
    snprintf(from, sizeof from, "systems/%s.yaml", name);
    nh_system *y = nh_system_read(from, 0, NULL, &error);
    if (!y) return;
    FILE *out = open_system(set, folder, name, path);
    rewrite_system(y, &(rewriting){.extra = generic_term(y, perturbation[0], 1)}, out);
    fclose(out);
    nh_system_free(y);
    add_task(set, folder, name, path);
}

static bool wanted(size_t set) { return !only || !strcmp(only, set_name[set]); }

static void make_sets(const char *folder)
{
    char *name[most_files], path[4096];
    size_t n = list("systems", name);
    for (size_t i = 0; i < n && wanted(0); i++) {
        snprintf(path, sizeof path, "systems/%s.yaml", name[i]);
        add_task(0, folder, name[i], path);
    }
    for (size_t i = 0; i < PUBLISHED_COUNT && wanted(1); i++) add_text(1, folder, PUBLISHED[i].name, PUBLISHED[i].text);
    for (size_t i = 0; i < UNSEEN_COUNT && wanted(2); i++) add_text(2, folder, UNSEEN[i].name, UNSEEN[i].text);
    if (wanted(3)) add_random(3, folder);
    for (size_t i = 0; i < n; i++) {
        if (wanted(4)) add_perturbed(4, folder, name[i]);
        free(name[i]);
    }
}

/* ---- one analysis, in a process of its own ---- */

static char *line_of(nh_dag *d, nh_ex e)
{
    char *text = nh_print_string(d, e);
    for (char *c = text; *c; c++)
        if (*c == '\n') *c = ' ';
    return text;
}

/* Those of the run with all rows that are no functions of these. */
static void write_lost(nh_analysis *r, const result *all, FILE *out)
{
    nh_error error = {0};
    nh_points *generic = nh_points_create(r->question->model, points, 1, 4711, &error);
    for (size_t i = 0; i < all->formulas && generic; i++) {
        nh_ex typed, e;
        bool read = nh_system_expression_text(r->question->system, "formula", all->formula[i], 0, NULL, &typed, &error) &&
                    nh_analysis_file_to_chart(r->question->model, typed, &e, &error);
        if (!read || !depends(r, generic, e)) fprintf(out, "lost\t%s%s\n", read ? "" : "(not read) ", all->formula[i]);
    }
    nh_points_free(generic);
}

static void write_result(nh_analysis *r, const result *all, FILE *out)
{
    size_t proved = 0, general = 0, series = 0, length = 0;
    nh_dag *d = r->question->model->dag;
    for (size_t k = 0; k < r->list->count; k++) {
        const nh_current *f = &r->list->found[k];
        if (f->independence != NH_INDEPENDENT) continue;
        char *text = line_of(d, f->phi);
        proved += f->proof.proved && !f->series;
        general += f->proof.all_parameters && f->proof.proved && !f->series;
        series += f->series != NULL;
        length += strlen(text);
        nh_free(text);
    }
    fprintf(out, "result 0 %zu %zu %zu %zu %zu %zu %zu %" PRIx64 "\n", r->list->independent, proved, general, series, r->list->pieces, r->list->furthers, length, r->used);
    for (size_t k = 0; k < r->list->count; k++) {
        const nh_current *f = &r->list->found[k];
        if (f->independence != NH_INDEPENDENT) continue;
        char *text = line_of(d, f->has_in_velocities ? f->in_velocities : f->phi);
        fprintf(out, "found\t%s\n", text);
        nh_free(text);
    }
    if (all && r->list->independent < all->independent) write_lost(r, all, out);
}

static void child(const task *t, uint64_t mask, const result *all, FILE *out)
{
    char analysis[200];
    nh_error error = {0};
    nh_request q = {.system_path = t->path, .left_out = mask & ~ANALYSIS, .seed_given = true};
    snprintf(analysis, sizeof analysis, "analyses/%s.yaml", t->name);
    if (mask & ANALYSIS) q.analysis_path = analysis;
    nh_options_default(&q.options);
    q.options.threads = 1;
    q.options.max_seconds = 1e6; /* counted work ends a search, the same on every machine */
    q.options.steps = 2000;      /* motions are not what is measured here */
    q.options.until = 0.1;
    nh_limit_memory_set(1e6 * megabytes);
    setrlimit(RLIMIT_CPU, &(struct rlimit){(rlim_t)cpu_limit, (rlim_t)cpu_limit + 1});
    nh_analysis *r = nh_analysis_create(&q, &error);
    if (r) write_result(r, all, out);
    else fprintf(out, "result 1\nfound\t%s\n", error.what);
}

/* ---- kept results ---- */

static void read_line(result *r, char *line)
{
    line[strcspn(line, "\n")] = 0;
    if (!strncmp(line, "found\t", 6) && r->formulas < MOST_FORMULAS) r->formula[r->formulas++] = strdup(line + 6);
    else if (!strncmp(line, "lost\t", 5) && r->losts < MOST_FORMULAS) r->lost[r->losts++] = strdup(line + 5);
    else
        sscanf(line, "result %d %zu %zu %zu %zu %zu %zu %zu %" SCNx64, &r->status, &r->independent, &r->proved, &r->general, &r->series, &r->pieces,
               &r->furthers, &r->length, &r->used);
}

static void read_results(task *t)
{
    FILE *in = fopen(t->file, "r");
    char *line = NULL;
    size_t size = 0;
    while (in && getline(&line, &size, in) > 0) {
        uint64_t mask;
        double seconds;
        if (sscanf(line, "mask %" SCNx64 " %lf", &mask, &seconds) == 2) {
            if (t->results == MOST_RESULTS) exit(2);
            t->result[t->results++] = (result){.mask = mask, .seconds = seconds, .status = 2, .run = true};
        } else if (t->results) read_line(&t->result[t->results - 1], line);
    }
    free(line);
    if (in) fclose(in);
}

static result *kept(task *t, uint64_t mask)
{
    for (size_t i = 0; i < t->results; i++)
        if (t->result[i].mask == mask) return &t->result[i];
    return NULL;
}

/* One that this one must be equal to. */
static result *same_run(task *t, uint64_t mask)
{
    for (size_t i = 0; i < t->results; i++) {
        const result *r = &t->result[i];
        uint64_t further = mask & ~r->mask;
        if (r->status == 0 && !(r->mask & ~mask) && !(further & (r->used | ANALYSIS))) return &t->result[i];
    }
    return NULL;
}

static result *make_run(task *t, uint64_t mask)
{
    int pipes[2];
    struct rusage used;
    int status;
    const result *all = kept(t, 0);
    if (t->results == MOST_RESULTS || pipe(pipes)) exit(2);
    fflush(NULL);
    pid_t pid = fork();
    if (pid == 0) {
        close(pipes[0]);
        FILE *out = fdopen(pipes[1], "w");
        child(t, mask, all, out);
        fclose(out);
        _exit(0);
    }
    close(pipes[1]);
    FILE *in = fdopen(pipes[0], "r"), *out = fopen(t->file, "a");
    result *r = &t->result[t->results++];
    *r = (result){.mask = mask, .status = 2, .run = true};
    char *text = NULL, *line = NULL;
    size_t length = 0, size = 0;
    FILE *copy = open_memstream(&text, &length);
    while (getline(&line, &size, in) > 0) {
        fputs(line, copy);
        read_line(r, line);
    }
    fclose(copy);
    fclose(in);
    wait4(pid, &status, 0, &used);
    r->seconds = (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + 1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
    if (!out) exit(2);
    fprintf(out, "mask %" PRIx64 " %.3f\n%s", mask, r->seconds, text);
    fclose(out);
    free(text);
    free(line);
    return r;
}

/* The result with these rows left out; NULL: not known. */
static result *result_of(task *t, uint64_t mask, bool must_run)
{
    result *r = kept(t, mask);
    if (!r && !must_run) r = same_run(t, mask);
    if (!r && stored_only) r = same_run(t, mask);
    if (!r && !stored_only) r = make_run(t, mask);
    return r;
}

static bool measured(const task *t)
{
    for (size_t i = 0; i < t->results; i++)
        if (t->result[i].mask == 0) return t->result[i].status == 0 && t->result[i].seconds <= long_run;
    return false;
}

/* ---- one selection over a set ---- */

typedef struct {
    size_t systems, independent, lost, gained, pieces, unproved, special, longer, missing, failed;
    double length, base_length, seconds;
    bool run; /* all of them were */
} total;

static bool is_longer(const result *r, const result *all) { return (double)r->length > 1.5 * (double)all->length + 40; }

static bool loses(const result *r, const result *all)
{
    return r->status != 0 || r->independent < all->independent || r->proved < all->proved ||
           (r->pieces < all->pieces && r->independent == all->independent);
}

static size_t less(size_t a, size_t b) { return a < b ? b - a : 0; }

static void add_to(total *s, const result *r, const result *all)
{
    s->systems++;
    s->run &= r->run;
    if (r->status) {
        s->failed++;
        return;
    }
    s->independent += r->independent;
    s->lost += less(r->independent, all->independent);
    s->gained += less(all->independent, r->independent);
    s->pieces += r->independent == all->independent ? less(r->pieces, all->pieces) : 0;
    s->unproved += r->independent >= all->independent ? less(r->proved, all->proved) : 0;
    s->special += r->independent >= all->independent ? less(r->general, all->general) : 0;
    s->longer += is_longer(r, all);
    s->length += (double)r->length;
    s->base_length += (double)all->length;
    s->seconds += r->seconds;
}

static total total_of(size_t set, uint64_t mask, bool must_run)
{
    total s = {.run = true};
    for (size_t i = 0; i < task_count; i++) {
        task *t = &tasks[i];
        if (t->set != set || !measured(t)) continue;
        result *r = result_of(t, mask, must_run);
        if (!r) s.missing++;
        else {
            bool own = kept(t, mask) != NULL;
            add_to(&s, r, kept(t, 0));
            s.run &= own;
        }
    }
    return s;
}

/* ---- the page ---- */

static uint64_t bit_of(const char *name)
{
    for (size_t i = 0; i < rows; i++)
        if (!strcmp(nh_staged_search_row(i), name)) return UINT64_C(1) << i;
    fprintf(stderr, "no row %s\n", name);
    exit(2);
}

static uint64_t every_row(void) { return (UINT64_C(1) << rows) - 1; }

static uint64_t bits_of(const char *names)
{
    uint64_t mask = 0;
    char text[600], *save = NULL;
    snprintf(text, sizeof text, "%s", names);
    for (char *name = strtok_r(text, ",", &save); name; name = strtok_r(NULL, ",", &save)) mask |= bit_of(name + strspn(name, " "));
    return mask;
}

static void print_names(uint64_t mask)
{
    bool some = false;
    for (size_t i = 0; i < rows; i++)
        if (mask >> i & 1) printf("%s%s", some ? ", " : "", nh_staged_search_row(i)), some = true;
    if (!some) printf("none");
}

static void print_cell(const total *s)
{
    if (s->missing || !s->systems) printf(" - |");
    else {
        printf(" %s%zu", s->lost ? "**" : "", s->lost);
        if (s->lost) printf("**");
        if (s->gained) printf(", %zu more", s->gained);
        if (s->pieces) printf(", %zu of a part", s->pieces);
        if (s->unproved) printf(", %zu not proved in closed form", s->unproved);
        if (s->special) printf(", %zu for the values of the file only", s->special);
        if (s->failed) printf(", %zu without an answer", s->failed);
        printf(" |");
    }
}

static void print_sets(void)
{
    puts("## The sets\n\n| set | systems | measured | independent integrals | proved | for all parameters | series | of a part | characters | seconds |\n"
         "|---|---|---|---|---|---|---|---|---|---|");
    for (size_t set = 0; set < SETS; set++) {
        size_t n = 0, good = 0, sum[6] = {0};
        double seconds = 0;
        for (size_t i = 0; i < task_count; i++) {
            if (tasks[i].set != set) continue;
            const result *r = result_of(&tasks[i], 0, true);
            n++;
            if (!r || !measured(&tasks[i])) continue;
            good++;
            seconds += r->seconds;
            size_t add[6] = {r->independent, r->proved, r->general, r->series, r->pieces, r->length};
            for (size_t j = 0; j < 6; j++) sum[j] += add[j];
        }
        printf("| %s | %zu | %zu | %zu | %zu | %zu | %zu | %zu | %zu | %.0f |\n", set_name[set], n, good, sum[0], sum[1], sum[2], sum[3], sum[4], sum[5], seconds);
        fflush(stdout);
    }
    printf("\nNot measured, because they take longer than %g s with all rows, or have no answer:", long_run);
    size_t n = 0;
    for (size_t i = 0; i < task_count; i++)
        if (tasks[i].results && !measured(&tasks[i])) printf("%s %s (%s)", n++ ? "," : "", tasks[i].name, set_name[tasks[i].set]);
    puts(n ? ".\n" : " none.\n");
}

static const struct {
    const char *name, *rows;
    bool rest; /* with quadratures, frames, levels and sides at the end */
} SELECTIONS[] = {
    {"seven rows: linear motion, rates, words times positions, isometries, series of one coordinate, degree 2, series in time",
     "linear motion, rates, words times positions, isometries, series of one coordinate, degree 2, series in time", true},
    {"none", "", true},
    {"linear motion, rates", "linear motion, rates", true},
    {"linear motion, rates; without quadratures, frames, levels, sides", "linear motion, rates", false},
    {"none; without quadratures, frames, levels, sides", "", false},
};

static void print_selections(size_t most)
{
    puts("## Selections\n\nIntegrals that are lost, per set; then systems whose formulas become longer than 1.5 times their length and 40 characters; the change of "
         "the length of all; and processor seconds, all of them over all sets.\n\n| rows that are kept | catalogue | published | unseen | random | generated | longer | "
         "characters | seconds |\n|---|---|---|---|---|---|---|---|---|");
    for (size_t k = 0; k < sizeof SELECTIONS / sizeof *SELECTIONS && k < most; k++) {
        uint64_t keep = bits_of(SELECTIONS[k].rows) | (SELECTIONS[k].rest ? bits_of("quadratures, frames, levels, sides") : 0);
        total sum = {.run = true};
        printf("| %s |", SELECTIONS[k].name);
        for (size_t set = 0; set < SETS; set++) {
            total s = total_of(set, every_row() & ~keep, true);
            print_cell(&s);
            fflush(stdout);
            sum.longer += s.longer, sum.length += s.length, sum.base_length += s.base_length, sum.seconds += s.seconds, sum.run &= s.run;
        }
        printf(" %zu | %+.1f %% | %s%.0f |\n", sum.longer, 100 * (sum.length / sum.base_length - 1), sum.run ? "" : "<= ", sum.seconds);
        fflush(stdout);
    }
    puts("");
}

static void print_leave_one_out(void)
{
    puts("## Each row alone left out\n\nIntegrals that only this row finds, per set; systems in which it found something with all rows; systems whose formulas become "
         "longer than 1.5 times their length and 40 characters without it; the change of the length of all formulas, and of the processor seconds of the systems in which "
         "it found something.\n\n| row | catalogue | published | unseen | random | generated | used in | longer | characters | seconds |\n|---|---|---|---|---|---|---|---|---|---|");
    for (size_t i = 0; i < rows; i++) {
        uint64_t mask = UINT64_C(1) << i;
        total sum = {0};
        size_t used = 0;
        printf("| %s |", nh_staged_search_row(i));
        for (size_t set = 0; set < SETS; set++) {
            total s = total_of(set, mask, whole);
            print_cell(&s);
            fflush(stdout);
            sum.longer += s.longer, sum.length += s.length, sum.base_length += s.base_length;
        }
        double seconds = 0;
        for (size_t k = 0; k < task_count; k++) {
            if (!measured(&tasks[k])) continue;
            const result *r = kept(&tasks[k], mask), *all = kept(&tasks[k], 0);
            used += (all->used & mask) != 0;
            if (r) seconds += r->seconds - all->seconds;
        }
        printf(" %zu | %zu | %+.0f | %+.1f |\n", used, sum.longer, sum.length - sum.base_length, seconds);
        fflush(stdout);
    }
    puts("");
}

/* The fits of analysis files, beside the search without them. */
static void print_analyses(void)
{
    puts("## Analysis files\n\n| system | integrals with its analysis file | without it | lost by the file | characters with it | without | seconds with it | without |\n"
         "|---|---|---|---|---|---|---|---|");
    for (size_t i = 0; i < task_count; i++) {
        task *t = &tasks[i];
        char path[200];
        snprintf(path, sizeof path, "analyses/%s.yaml", t->name);
        if (t->set || !measured(t) || access(path, R_OK)) continue;
        const result *r = result_of(t, ANALYSIS, true), *all = kept(t, 0);
        if (!r) continue;
        printf("| %s | %zu | %zu |", t->name, r->independent, all->independent);
        for (size_t k = 0; k < r->losts; k++) printf("%s `%s`", k ? "," : "", r->lost[k]);
        printf(" | %zu | %zu | %.1f | %.1f |\n", r->length, all->length, r->seconds, all->seconds);
        fflush(stdout);
    }
    puts("");
}

/* What is lost in the runs of one selection. */
static void print_losses(const char *what, uint64_t mask)
{
    for (size_t i = 0; i < task_count; i++) {
        task *t = &tasks[i];
        const result *all = kept(t, 0), *r = measured(t) ? kept(t, mask) : NULL;
        if (!r || (!loses(r, all) && !is_longer(r, all))) continue;
        printf("| %s | %s | %s | ", what, set_name[t->set], t->name);
        if (r->status) printf("no answer");
        else printf("%zu of %zu", r->independent, all->independent);
        if (!r->status && r->pieces != all->pieces) printf("; of a part %zu, not %zu", r->pieces, all->pieces);
        if (!r->status && r->independent >= all->independent && r->proved < all->proved) printf("; %zu not proved in closed form", all->proved - r->proved);
        if (!r->status && is_longer(r, all)) printf("; %zu characters, not %zu", r->length, all->length);
        printf(" |");
        for (size_t k = 0; k < r->losts; k++) printf("%s `%.*s%s`", k ? "," : "", longest_shown, r->lost[k], strlen(r->lost[k]) > longest_shown ? " .." : "");
        puts(" |");
    }
}

static void print_which(void)
{
    puts("## Which\n\nIntegrals of the run with all rows that are not functions of those that are found without the row. A row of the table above that is not named here "
         "loses nothing.\n\n| left out | set | system | found | lost |\n|---|---|---|---|---|");
    for (size_t i = 0; i < rows; i++) print_losses(nh_staged_search_row(i), UINT64_C(1) << i);
    char name[40];
    for (size_t k = 0; k < 3; k++) {
        uint64_t keep = bits_of(SELECTIONS[k].rows) | bits_of("quadratures, frames, levels, sides");
        snprintf(name, sizeof name, "all but %s", k == 0 ? "seven rows" : k == 1 ? "none" : "two rows");
        print_losses(name, every_row() & ~keep);
    }
    puts("");
}

/* ---- elimination ---- */

static bool worse(uint64_t mask, bool lengths, const task **where)
{
    for (size_t i = 0; i < task_count; i++) {
        task *t = &tasks[i];
        if (!measured(t)) continue;
        const result *r = result_of(t, mask, false), *all = kept(t, 0);
        *where = t;
        if (!r || loses(r, all) || (lengths && is_longer(r, all))) return true;
    }
    return false;
}

/* Rows that find something in few systems are left out first. */
static void print_elimination(bool lengths)
{
    uint64_t left = 0, tried = 0;
    printf("Left out one after another, while nothing is lost%s:\n\n| row | left out | because of |\n|---|---|---|\n", lengths ? " and no formulas become longer" : "");
    for (size_t step = 0; step < rows; step++) {
        size_t best = 0, least = SIZE_MAX;
        for (size_t i = 0; i < rows; i++) {
            size_t used = 0;
            for (size_t k = 0; k < task_count; k++) used += measured(&tasks[k]) && (kept(&tasks[k], 0)->used >> i & 1);
            if (!(tried >> i & 1) && used < least) best = i, least = used;
        }
        uint64_t bit = UINT64_C(1) << best;
        const task *where = NULL;
        tried |= bit;
        bool keep = worse(left | bit, lengths, &where);
        if (!keep) left |= bit;
        printf("| %s | %s | %s |\n", nh_staged_search_row(best), keep ? "no" : "yes", keep ? where->name : "");
        fflush(stdout);
    }
    printf("\nWhat remains: ");
    print_names(every_row() & ~left);
    puts(".\n");
}

int main(int argc, char **argv)
{
    if (argc < 2) return 2;
    const char *folder = argv[1], *until = argc > 2 ? argv[2] : "";
    if (mkdir(folder, 0777) && errno != EEXIST) return 2;
    while (nh_staged_search_row(rows)) rows++;
    bool greedy = !strcmp(until, "greedy");
    stored_only = greedy || !strcmp(until, "stored");
    whole = !strcmp(until, "whole");
    only = argc > 3 ? argv[3] : NULL;
    make_sets(folder);
    for (size_t i = 0; i < task_count; i++) read_results(&tasks[i]);
    puts("");
    print_sets();
    if (!strcmp(until, "base")) return 0;
    bool first = !strcmp(until, "main");
    print_selections(first ? 2 : SIZE_MAX);
    if (!strcmp(until, "selections")) return 0;
    print_leave_one_out();
    print_analyses();
    print_which();
    if (!strcmp(until, "leave") || !strcmp(until, "rows") || first) return 0;
    puts("## The smallest selection\n");
    if (stored_only && !greedy) return puts("Not computed yet."), 0;
    stored_only = false;
    print_elimination(true);
    print_elimination(false);
    return 0;
}
