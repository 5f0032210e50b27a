#include "integrals/letters.h"

#include <string.h>

#include "exact/relation_unknown.h"
#include "graph/dag.h"

enum { kinds = 3 };

typedef struct {
    const nh_model *o;
    const nh_options *options;
    size_t n;
    const nh_ex *term;
    const double *coefficient;
    nh_ex *lifted, *rate, *named; /* work: n each */
    nh_ex *out;
    nh_letters *letters;
} problem;

/* The relation with these numbers as expressions of the parameters; on success p->named are the terms. */
static nh_fixed named_relation(problem *p, const nh_lifted *numbers)
{
    const nh_model *model = p->o;
    nh_letters *letters = p->letters;
    nh_unknown_numbers s = {
        model->dag,     model->system->parameters, model->parameter, model->parameter_value,
        numbers->count, numbers->symbol,           numbers->value,   (size_t)p->options->proof_terms};
    nh_fixed none = {0};
    for (size_t j = 0; j < p->n; j++) p->rate[j] = nh_model_gamma(model, p->lifted[j]);
    if (!nh_relation_unknown(&s, p->n, p->rate, p->coefficient, letters->name)) return none;
    letters->count = numbers->count;
    memcpy(letters->value, numbers->value, sizeof letters->value);
    for (size_t j = 0; j < p->n; j++) {
        p->named[j] = nh_substitute(model->dag, p->lifted[j], numbers->count, numbers->symbol, letters->name);
        p->rate[j] = nh_model_gamma(model, p->named[j]);
    }
    return nh_fixed_relation(model, p->n, p->rate, p->coefficient, p->options, p->out);
}

/* The terms with symbols for their numbers of this kind; for one of the numbers only, unless `only` is beyond them. */
static bool lift(problem *p, nh_symbolise_decimals_kind kind, size_t only, nh_lifted *numbers)
{
    nh_dag *d = p->o->dag;
    nh_ex value[NH_MOST_LIFTED];
    *numbers = (nh_lifted){0};
    for (size_t j = 0; j < p->n; j++)
        p->lifted[j] =
            nh_symbolise_decimals_inside(d, p->term[j], kind, p->o->system->parameters, p->o->parameter, numbers);
    if (numbers->overflow || only >= numbers->count) return !numbers->overflow && numbers->count > 0;
    for (size_t i = 0; i < numbers->count; i++) value[i] = i == only ? numbers->symbol[i] : numbers->exact[i];
    for (size_t j = 0; j < p->n; j++)
        p->lifted[j] = nh_substitute(d, p->lifted[j], numbers->count, numbers->symbol, value);
    numbers->symbol[0] = numbers->symbol[only];
    numbers->value[0] = numbers->value[only];
    numbers->count = 1;
    return true;
}

/* Tries all numbers of a kind at once, then each by itself: only one of them may depend on parameters. */
static nh_fixed try_kind(problem *p, nh_symbolise_decimals_kind kind)
{
    nh_lifted numbers;
    nh_fixed out = {0};
    if (!lift(p, kind, NH_MOST_LIFTED, &numbers)) return out;
    size_t count = numbers.count;
    if (count <= NH_MOST_UNKNOWN) out = named_relation(p, &numbers);
    for (size_t i = 0; i < count && count > 1 && !out.all_parameters; i++)
        if (lift(p, kind, i, &numbers)) out = named_relation(p, &numbers);
    return out;
}

nh_fixed nh_letters_relation(const nh_model *model, size_t n, nh_ex *term, const double *coefficient,
                             const nh_options *options, nh_ex *out, nh_letters *letters)
{
    static const nh_symbolise_decimals_kind kind[kinds] = {NH_SYMBOLISE_DECIMALS_ROUGH, NH_SYMBOLISE_DECIMALS_FRACTIONS,
                                                           NH_SYMBOLISE_DECIMALS_ALL};
    nh_ex *work = nh_alloc_array(4 * n + 1, sizeof *work);
    problem p = {model, options, n, term, coefficient, work, work + n, work + 2 * n, work + 3 * n, letters};
    nh_fixed found = {0};
    for (size_t i = 0; i < kinds && !found.all_parameters; i++) found = try_kind(&p, kind[i]);
    if (found.all_parameters) {
        memcpy(term, p.named, n * sizeof *term);
        memcpy(out, p.out, n * sizeof *out);
    }
    nh_free(work);
    return found.all_parameters ? found : (nh_fixed){0};
}
