#include "commands/classify.h"

#include <string.h>

#include "base/progress.h"
#include "cli/cli.h"
#include "document/classification.h"

/* "eps", "B, eps" or "A, B, eps" */
static bool read_names(nh_cli *cli, nh_classify_request *q, nh_error *error)
{
    const char *name[4];
    size_t count = 0;
    for (const char *at = cli->over; at; at = strchr(at, ',') ? strchr(at, ',') + 1 : NULL) {
        at += strspn(at, " ");
        size_t length = strcspn(at, ", ");
        if (length == 0) return nh_fail(error, NH_USAGE, "", "--over `%s` lacks the name of a parameter", cli->over);
        if (count < 4) name[count++] = nh_arena_strndup(cli->arena, at, length);
    }
    if (count > 3) {
        nh_fail(error, NH_USAGE, "", "--over `%s` names more than three parameters", cli->over);
        return nh_error_hint(error, "give the others values with --set");
    }
    q->over = name[0];
    q->second = count > 1 ? name[1] : NULL;
    q->third = count > 2 ? name[2] : NULL;
    return true;
}

/* --of measure */
static bool read_question(nh_cli *cli, nh_classify_request *q, nh_error *error)
{
    static const char *const names[] = {
#define X(name, word) #word,
        NH_LINEAR_QUESTION_TABLE(X)
#undef X
    };
    size_t of = 0;
    while (cli->of && of < NH_LINEAR_QUESTIONS && strcmp(cli->of, names[of])) of++;
    q->of = (nh_linear_question)of;
    if (of < NH_LINEAR_QUESTIONS && (of == NH_OF_CURRENTS || !q->second)) return true;
    if (of < NH_LINEAR_QUESTIONS) {
        nh_fail(error, NH_USAGE, "", "--of %s takes one parameter, not %s", cli->of, q->third ? "three" : "two");
        return nh_error_hint(error, q->third ? "give the others values with --set" : "give the other a value with "
                             "--set");
    }
    nh_fail(error, NH_USAGE, "", "--of does not know `%s`", cli->of);
    const char *near = nh_text_nearest(cli->of, names, NH_LINEAR_QUESTIONS);
    return nh_error_hint(error, near ? "did you mean `%s`?" : "currents, measure, hamiltonization, symmetries or "
                         "constraints%s", near ? near : "");
}

static bool request_of(nh_cli *cli, nh_classify_request *q, nh_error *error)
{
    if (cli->operands > 1) return nh_cli_one_system(cli, "nhsym classify penning_trap --over w", error);
    if (cli->operands != 1 || !cli->over) {
        nh_fail(error, NH_USAGE, "", "classify which system, over which parameter?");
        return nh_error_hint(error, "nhsym classify penning_trap --over w");
    }
    *q = (nh_classify_request){.command = cli->line, .settings = cli->settings, .setting = cli->setting,
                               .shape = cli->shape, .options = cli->options};
    if (!read_names(cli, q, error) || !read_question(cli, q, error)) return false;
    q->system_path = nh_cli_system(cli, cli->operand[0], error);
    return q->system_path != NULL;
}

/* What may be written of one of the three kinds of results. */
typedef struct {
    nh_classified *line;
    nh_classified_plane *plane;
    nh_classified_space *space;
    bool partial;
    const char *obstacle;
} answer;

static bool classify(const nh_classify_request *q, answer *a, nh_error *error)
{
    if (q->third) a->space = nh_classify_space_system(q, error);
    else if (q->second) a->plane = nh_classify_plane_system(q, error);
    else a->line = nh_classify_system(q, error);
    if (a->space) a->partial = a->space->partial, a->obstacle = a->space->space->obstacle;
    if (a->plane) a->partial = a->plane->partial, a->obstacle = a->plane->plane->obstacle;
    if (a->line) a->partial = a->line->partial, a->obstacle = a->line->classification->obstacle;
    return a->line || a->plane || a->space;
}

static char *json_of(const answer *a, const nh_run *run)
{
    return a->space ? nh_classification_space_json(a->space, run)
        : a->plane ? nh_classification_plane_json(a->plane, run) : nh_classification_json(a->line, run);
}

static void render(const void *result, const nh_run *run, nh_pen_style style, nh_text *out)
{
    const answer *a = result;
    nh_classification_write(a->line, a->plane, a->space, run, style, out);
}

int nh_cli_classify(nh_cli *cli, nh_error *error)
{
    nh_classify_request request;
    answer a = {.line = NULL};
    nh_cli_progress_begin(cli);
    if (!request_of(cli, &request, error) || !nh_cli_use_folder(cli, error) || !nh_cli_can_write(cli, error))
        return error->code;
    bool done = classify(&request, &a, error);
    nh_cli_progress_end();
    nh_run run = nh_cli_run(cli, request.system_path, NULL);
    if (!done) return nh_cli_failed(cli, &run, error);
    bool good = nh_cli_write_words(cli, render, &a, &run, error);
    if (cli->json && good) good = nh_cli_write_json(cli, json_of(&a, &run), error);
    good = good && nh_cli_write_documents(cli, render, &a, &run, error);
    good = nh_cli_written(cli, good, error);
    if (good && a.obstacle) nh_fail(error, NH_NUMERIC, "", "%s", a.obstacle);
    if (a.line) nh_classified_free(a.line);
    if (a.plane) nh_classified_plane_free(a.plane);
    if (a.space) nh_classified_space_free(a.space);
    return !good ? (int)error->code : nh_interrupted() ? (int)nh_ended_code() : a.partial ? NH_LIMIT : (int)error->code;
}
