/* The count compared with the known integrals, for the given and for generic parameter values, and as sentences. */
#include "count/completeness.h"

#include <string.h>

#include "base/parallel.h"
#include "graph/dag.h"

/* The highest degree that the rows settle, and what is missing at the next one. */
static void read_rows(nh_completeness *c, bool all)
{
    c->degree = c->missing_at = c->missing = c->incomplete_at = 0;
    c->linear = c->count.rows > 0;
    c->all = all;
    while (c->degree < c->count.rows && (all || c->count.row[c->degree].complete || c->count.row[c->degree].functions))
        c->linear &= c->count.row[c->degree++].complete;
    for (size_t d = c->count.rows; d-- > 0;)
        if (!c->count.row[d].complete) c->incomplete_at = d + 1;
    if (c->degree == c->count.rows) return;
    const nh_count_row *row = &c->count.row[c->degree];
    c->settled = row->settled;
    c->missing_at = row->degree;
    c->missing = row->rank > row->known_rank ? row->rank - row->known_rank : 0;
}

/* Were the equations of all its degrees solved? */
static bool has_orders(const nh_completeness *c)
{
    bool all = true;
    for (size_t d = 0; d < c->degree; d++) all &= c->count.row[d].order > 0;
    return all;
}

/* The degrees that are counted by default are worth some seconds. */
static double first_work(const nh_model *model, const nh_completeness_question *q, bool time)
{
    enum { few_coordinates = 4, times = 10, times_for_many = 5 };
    return time || q->degree ? 0 : (model->m <= few_coordinates ? times : times_for_many) * q->work;
}

/* The products of the same currents have to reach the bound for generic parameters, too.  Those that are independent
 * here are so there, and the bound here is one there where brackets have the same ranks [docs/method.md, sec. 10];
 * else, and where not the products but the ranks agree, all is counted for random residues. */
static bool holds_generically(const nh_model *model, const nh_completeness_question *q, const nh_completeness *c)
{
    if (!model->system->parameters || !q->general || !c->degree || (c->regional && !q->regional_general)) return false;
    nh_count_question question = {.time = c->count.time,
                                  .generic = true,
                                  .degree = c->degree,
                                  .work = q->work,
                                  .first_work = first_work(model, q, c->count.time),
                                  .memory = q->memory,
                                  .threads = q->threads,
                                  .known = q->known - (c->regional ? 0 : q->regional),
                                  .independent = q->independent - (c->regional ? 0 : q->regional),
                                  .current = q->current};
    if (c->linear && has_orders(c)) {
        nh_count brackets = nh_count_brackets(model, &question);
        if (!brackets.obstacle && brackets.weights == c->count.weights && brackets.leaf == c->count.leaf &&
            brackets.without == c->count.without)
            return true;
    }
    nh_completeness generic = {.count = nh_count_integrals(model, &question)};
    read_rows(&generic, q->all);
    return !generic.count.obstacle && generic.degree == c->degree && generic.linear >= c->linear;
}

/* The same with the currents of a region, where the others do not suffice. */
static nh_completeness completeness(const nh_model *model, const nh_completeness_question *q,
                                    nh_count_question question)
{
    nh_completeness c = {.counted = true, .asked = q->degree}, wide = c;
    question.known -= q->regional;
    question.independent -= q->regional;
    c.count = nh_count_integrals(model, &question);
    read_rows(&c, q->all);
    if (!q->regional || !c.missing_at || c.count.obstacle) return c;
    question.known += q->regional;
    question.independent += q->regional;
    wide.count = nh_count_integrals(model, &question);
    wide.regional = true;
    wide.only_regional = q->known == q->regional;
    read_rows(&wide, q->all);
    return wide.degree > c.degree || wide.missing < c.missing ? wide : c;
}

size_t nh_completeness_degree(const nh_model *model, bool time)
{
    enum { two = 2, few = 4, highest = 6, high = 4, low = 2 };
    size_t coordinates = model->m + time;
    return coordinates <= two ? highest : coordinates <= few ? high : low;
}

/* One kind of coefficients: the question of the count, and what its rows say. */
static void count_kind(const nh_model *model, const nh_completeness_question *q, int kind, nh_completeness *c)
{
    size_t chosen = nh_completeness_degree(model, kind == NH_COMPLETE_IN_TIME);
    nh_count_question question = {.time = kind == NH_COMPLETE_IN_TIME,
                                  .timeless = kind == NH_COMPLETE_IN_COORDINATES,
                                  .degree = q->degree ? q->degree : chosen,
                                  .until_missing = q->until_missing,
                                  .work = q->work,
                                  .first_work = first_work(model, q, kind == NH_COMPLETE_IN_TIME),
                                  .memory = q->memory,
                                  .threads = q->threads,
                                  .known = q->known,
                                  .independent = q->independent,
                                  .current = q->current};
    *c = completeness(model, q, question);
    if (kind == NH_COMPLETE_IN_COORDINATES && c->count.time) *c = (nh_completeness){0};
}

static void generalize_kind(const nh_model *model, const nh_completeness_question *q, int kind, nh_completeness *c)
{
    (void)kind;
    c->generic = c->counted && holds_generically(model, q, c);
}

/* ---- all kinds at the same time, each in a copy of the model ---- */

typedef void for_kind(const nh_model *model, const nh_completeness_question *q, int kind, nh_completeness *c);

typedef struct {
    const nh_model *model;
    const nh_completeness_question *q;
    for_kind *work;
    nh_completeness *out;
    nh_dag *dag[NH_COMPLETENESS_KINDS];
    nh_model *copy[NH_COMPLETENESS_KINDS];
} kinds;

static void do_kind(size_t kind, void *context)
{
    kinds *x = context;
    if (x->q->kinds && !(x->q->kinds >> kind & 1)) return;
    x->dag[kind] = nh_dag_copy(x->model->dag);
    x->copy[kind] = nh_model_copy(x->model, x->dag[kind]);
    x->work(x->copy[kind], x->q, (int)kind, &x->out[kind]);
}

/* Texts that are in the memory of a copy. */
static void keep_texts(nh_arena *arena, nh_count *c)
{
    const char **name = nh_arena_alloc(arena, (c->without + 1) * sizeof *name);
    for (size_t i = 0; i < c->without; i++) name[i] = nh_arena_strdup(arena, c->without_name[i]);
    c->without_name = name;
    if (c->where) c->where = nh_arena_strdup(arena, c->where);
}

static void do_kinds(const nh_model *model, const nh_completeness_question *q, for_kind *work, nh_completeness *out)
{
    kinds x = {.model = model, .q = q, .work = work, .out = out};
    nh_parallel(NH_COMPLETENESS_KINDS, q->threads, do_kind, &x);
    for (int kind = 0; kind < NH_COMPLETENESS_KINDS; kind++) {
        if (!x.copy[kind]) continue;
        keep_texts(model->arena, &out[kind].count);
        nh_model_copy_free(x.copy[kind]);
        nh_dag_free(x.dag[kind]);
    }
}

void nh_completeness_of(const nh_model *model, const nh_completeness_question *question,
                        nh_completeness out[NH_COMPLETENESS_KINDS])
{
    do_kinds(model, question, count_kind, out);
}

void nh_completeness_generic(const nh_model *model, const nh_completeness_question *question,
                             nh_completeness completeness[NH_COMPLETENESS_KINDS])
{
    nh_completeness_question every = *question;
    every.kinds = 0;
    do_kinds(model, &every, generalize_kind, completeness);
}

static const char *plural(size_t n) { return n == 1 ? "" : "s"; }

/* The sentence about a degree that was asked for and not counted, because of the limit of work. */
static bool ended_by_work(const nh_completeness *c)
{
    return c->asked > c->count.rows && c->count.end && !strcmp(c->count.end, "work");
}

static const char more_work[] = "takes more work than the option `count_work` allows";

static void coordinates_words(const nh_completeness *c, const char *coefficients, nh_text *out)
{
    const char *most = c->degree > 1 ? "at most " : "", *before = c->count.where ? " " : "",
               *where = c->count.where ? c->count.where : "",
               *found = !c->regional       ? "those found"
                        : c->only_regional ? "those that are constant in a region only"
                                           : "those found and of those that are constant in a region only";
    if (c->degree && c->count.row[c->degree - 1].bound == 1)
        nh_text_addf(out,
                     "Complete to degree %zu%s%s: %sno function polynomial in the velocities of degree %s%zu, with any "
                     "functions of %s as coefficients, is conserved",
                     c->degree, before, where,
                     c->count.leaf ? "but for functions of what the constraints keep constant, " : "", most, c->degree,
                     coefficients);
    else if (c->degree)
        nh_text_addf(out,
                     "Complete to degree %zu%s%s: every integral polynomial in the velocities of degree %s%zu, with "
                     "any functions of %s%s as coefficients, is a %s %s",
                     c->degree, before, where, most, c->degree, coefficients,
                     c->count.leaf ? " (and of what the constraints keep constant)" : "",
                     c->linear ? "polynomial in" : "function of", found);
    if (c->degree && c->all && !c->linear) nh_text_add(out, ": there cannot be more independent ones.");
    else if (c->degree)
        nh_text_addf(out, " (%s %s).",
                     c->linear
                         ? "proved for"
                         : "the number of all is proved, the rank of their differentials taken modulo a prime, for",
                     c->generic ? "generic parameters and for these" : "these parameters");
    if (ended_by_work(c)) nh_text_addf(out, " Degree %zu %s.", c->count.rows + 1, more_work);
    if (!c->missing_at) return;
    const nh_count_row *row = &c->count.row[c->missing_at - 1];
    if (c->degree && !c->settled) {
        nh_text_addf(out,
                     " Degree %zu is not settled: series up to order %zu, the highest within the limit of work, still "
                     "allow %zu more independent integral%s.",
                     c->missing_at, row->order, c->missing, plural(c->missing));
        return;
    }
    if (!c->count.row[c->missing_at - 1].order) {
        nh_text_addf(out,
                     "%s degree %zu there are %zu more independent integrals: the equations are linear, and their "
                     "frequencies have no resonances.",
                     c->degree ? " At" : "At", c->missing_at, c->missing);
        return;
    }
    if (!c->degree) nh_text_addf(out, "Not complete%s%s:", before, where);
    nh_text_addf(out, " %s degree %zu", c->degree ? "At" : "at", c->missing_at);
    if (!c->degree) nh_text_addf(out, ", with any functions of %s as coefficients,", coefficients);
    nh_text_addf(out, " there may be at most %zu more independent integral%s (order %zu%s).", c->missing,
                 plural(c->missing), row->order, row->settled ? "" : ", not settled");
}

void nh_completeness_words(const nh_completeness c[NH_COMPLETENESS_KINDS], size_t uncertain, nh_text *out)
{
    const nh_completeness *first = &c[c[0].counted ? 0 : 1], *time = &c[NH_COMPLETE_IN_TIME];
    if (!first->counted) return;
    if (first->count.obstacle) {
        nh_text_addf(out, "More integrals were not counted: %s.", first->count.obstacle);
        return;
    }
    coordinates_words(first, first == time ? "time and the coordinates" : "the coordinates", out);
    if (first->missing_at && uncertain)
        nh_text_addf(out, " The %zu current%s that %s certified, not proved, may be among them.", uncertain,
                     plural(uncertain), uncertain == 1 ? "is" : "are");
    if (first == time || !time->counted || time->count.obstacle) return;
    if (time->degree) nh_text_addf(out, " With time in the coefficients: complete to degree %zu", time->degree);
    if (time->degree && time->regional) nh_text_add(out, ", with those that are constant in a region only");
    if (time->degree && ended_by_work(time)) nh_text_addf(out, "; degree %zu %s", time->count.rows + 1, more_work);
    if (time->degree && !time->missing_at) nh_text_add(out, ".");
    if (!time->missing_at) return;
    nh_text_add(out, time->degree ? ";" : " With time in the coefficients:");
    if (!time->count.row[time->missing_at - 1].order)
        nh_text_addf(out, " at degree %zu there are %zu more.", time->missing_at, time->missing);
    else if (time->settled) nh_text_addf(out, " at degree %zu at most %zu more.", time->missing_at, time->missing);
    else nh_text_addf(out, " degree %zu is not settled.", time->missing_at);
}
