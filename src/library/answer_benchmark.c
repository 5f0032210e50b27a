/* answer_benchmark: integrators compared on one motion, and maps of where they fail. */
#include "base/progress.h"
#include "commands/robustness.h"
#include "document/benchmark.h"
#include "library/answer_internal.h"

/* Ranges are those of a map. */
static bool wants_maps(const nh_request *q) { return q->robustness || q->over; }

static bool benchmark_check(const nh_request *q, nh_error *error)
{
    if (!wants_maps(q) || !q->methods) return true;
    nh_fail(error, NH_USAGE, "", "--method, and --%s as well", q->over ? "over" : "robustness");
    return nh_error_hint(error, "maps compare five methods, which are always the same");
}

static bool benchmark(nh_answer *a, nh_error *error)
{
    const nh_request *q = a->request;
    nh_simulate_request request = nh_answer_motion(q);
    static const double usual = 5; /* seconds */
    a->part[0] = wants_maps(q) ? nh_robustness_benchmark(&request, q->over, q->budget, error)
                               : nh_benchmark_run(&request, q->budget > 0 ? q->budget : usual, error);
    return a->part[0] != NULL;
}

static void benchmark_free(nh_answer *a) { nh_benchmark_free(a->part[0]); }

static void benchmark_write(const nh_answer *a, nh_pen_style style, nh_text *out)
{
    const nh_benchmark *b = a->part[0];
    nh_benchmark_write(b, b->maps, &a->run, style, out);
}

static char *benchmark_json(const nh_answer *a)
{
    const nh_benchmark *b = a->part[0];
    return nh_benchmark_json(b, b->maps, &a->run);
}

static void benchmark_table(const nh_answer *a, nh_text *csv) { nh_benchmark_csv(a->part[0], csv); }

static void benchmark_picture(const nh_answer *a, nh_text *svg) { nh_benchmark_svg(a->part[0], svg); }

static int benchmark_code(const nh_answer *a, nh_error *error)
{
    (void)a;
    if (nh_interrupted()) nh_fail_ended(error, "while methods were compared: this is what was measured until then");
    return (int)error->code;
}

const nh_answer_kind nh_answer_benchmark = {.name = "benchmark",
                                            .analysis = true,
                                            .check = benchmark_check,
                                            .create = benchmark,
                                            .free = benchmark_free,
                                            .write = benchmark_write,
                                            .json = benchmark_json,
                                            .table = benchmark_table,
                                            .table_name = "runs.csv",
                                            .picture = benchmark_picture,
                                            .code = benchmark_code};
