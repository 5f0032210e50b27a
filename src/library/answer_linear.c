/* answer_linear: the linear equations at a state, or along a family. */
#include "base/progress.h"
#include "document/linearized.h"
#include "library/answer_internal.h"

static bool linearize_check(const nh_request *q, nh_error *error)
{
    if (q->overs < 2) return true;
    nh_fail(error, NH_USAGE, "", "--over takes one range here, found %zu", q->overs);
    return nh_error_hint(error, "a stability chart is made of several runs, with --set for the other parameter");
}

static bool linearize(nh_answer *a, nh_error *error)
{
    const nh_request *q = a->request;
    nh_linearize_request request = {.system_path = q->system_path,
                                    .settings = q->settings,
                                    .setting = q->setting,
                                    .at = q->initial,
                                    .over = q->overs ? q->over_list[0] : q->over,
                                    .project = q->project,
                                    .options = q->options};
    return (a->part[0] = nh_linearize_create(&request, error)) != NULL;
}

static void linearized_free(nh_answer *a) { nh_linearized_free(a->part[0]); }

static void linearized_write(const nh_answer *a, nh_pen_style style, nh_text *out)
{
    nh_linearized_write(a->part[0], &a->run, style, out);
}

static char *linearized_json(const nh_answer *a) { return nh_linearized_json(a->part[0], &a->run); }
static void linearized_table(const nh_answer *a, nh_text *csv) { nh_linearized_csv(a->part[0], csv); }
static void linearized_picture(const nh_answer *a, nh_text *svg) { nh_linearized_svg(a->part[0], svg); }

static size_t linearized_files(const nh_answer *a, nh_answer_file file[NH_ANSWER_FILES])
{
    file[0].name = "matrices.csv";
    nh_text_init(&file[0].text);
    nh_linearized_matrices_csv(a->part[0], &file[0].text);
    return 1;
}

static int linearized_code(const nh_answer *a, nh_error *error)
{
    const nh_linearized *x = a->part[0];
    if (x->partial) nh_fail_ended(error, "when %zu values were computed", x->rows);
    return nh_answer_code(x->partial, error);
}

const nh_answer_kind nh_answer_linearize = {.name = "linearize",
                                            .check = linearize_check,
                                            .create = linearize,
                                            .free = linearized_free,
                                            .write = linearized_write,
                                            .json = linearized_json,
                                            .table = linearized_table,
                                            .table_name = "eigenvalues.csv",
                                            .files = linearized_files,
                                            .picture = linearized_picture,
                                            .code = linearized_code};
