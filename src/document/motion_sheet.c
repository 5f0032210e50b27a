#include "document/analysis_internal.h"

#include <math.h>

#include "graph/dag.h"
#include "graph/node.h"
#include "integrals/fixed.h"
#include "search/explicit_motion.h"
#include "search/motion_series.h"

/* The parameter, the meaning of the letters, and the values for which it holds. */
static const char *words_of(nh_sheet *s, const nh_analysis *result)
{
    const nh_explicit_motion *m = result->motion;
    const char *fixed = m->fixed ? nh_fixed_text(result->question->model, m->fixed) : "";
    const char *rest = m->known < m->states ? " No closed form was found for the other states." : "";
    const char *where = m->region ? nh_arena_printf(result->arena, "while a motion stays in one region (%s)", m->region)
                                  : "along every motion";
    return nh_sheet_label(s,
                          "These formulas hold %s%s%s%s, with $<%s>$ as the parameter; the numbers C are constant "
                          "%s.%s%s",
                          where, *fixed ? ", for " : "", fixed,
                          result->branch ? nh_arena_printf(result->arena, ", on the branch %s only", result->branch)
                                         : "",
                          nh_name_of(s->dag, m->state[m->parameter]), m->region ? "there" : "along motions",
                          m->proved ? " Proved: they satisfy the equations of motion." : "", rest);
}

static const char *name(nh_sheet *s, nh_ex symbol) { return nh_sheet_label(s, "<%s>", nh_name_of(s->dag, symbol)); }

/* The interval around the start, with all coefficients. */
static void first_series(nh_sheet *s, const nh_motion_series *v, const char *of)
{
    const nh_motion_series_link *first = &v->link[v->first];
    nh_sheet_formula(s, nh_sheet_label(s, "<%s>_{0}", of), nh_real(s->dag, first->centre));
    nh_sheet_formula(s, "Delta_{max}", nh_real(s->dag, first->half));
    for (size_t j = 0; j < v->integrals; j++) {
        const nh_motion_series_of_one *one = &first->integral[j];
        nh_sheet_sum(s, "", name(s, one->symbol));
        for (size_t k = 0; k < NH_MOTION_SERIES_TERMS; k++)
            nh_sheet_add(s, nh_real(s->dag, one->coefficient[k]),
                         k == 0   ? ""
                         : k == 1 ? "Delta"
                                  : nh_sheet_label(s, "Delta^{%zu}", k));
        nh_sheet_formula(s, nh_sheet_label(s, "\\eps_{%s}", name(s, one->symbol)), nh_real(s->dag, one->bound));
    }
}

static double largest_bound(const nh_motion_series *v)
{
    double out = 0;
    for (size_t i = 0; i < v->links; i++)
        for (size_t j = 0; j < v->integrals; j++) out = fmax(out, v->link[i].integral[j].bound);
    return out;
}

/* The integrals at one end of the chain, where it has more than one interval on that side. */
static void at_end(nh_sheet *s, const nh_motion_series *v, size_t link, double end)
{
    const nh_motion_series_link *at = &v->link[link];
    for (size_t j = 0; j < v->integrals && link != v->first; j++)
        nh_sheet_formula(s, nh_sheet_label(s, "%s(<%.6g>)", name(s, at->integral[j].symbol), end),
                         nh_real(s->dag, nh_motion_series_value(at, j, end)));
}

/* The chain of all intervals: how far it extends, and the integrals at its ends. */
static void other_series(nh_sheet *s, const nh_motion_series *v, const char *of)
{
    double begin = nh_motion_series_begin(v), end = nh_motion_series_end(v);
    const char *rest = nh_sheet_label(s, "; the checked motion goes from $<%.6g>$ to $<%.6g>$", v->low, v->high);
    if (begin <= v->low && end >= v->high) rest = ", where the checked motion goes";
    nh_sheet_words(s, nh_sheet_label(s,
                                     "%zu intervals beside one another, each with such series about its own centre, "
                                     "cover $<%s>$ from $<%.6g>$ to $<%.6g>$%s. The largest $\\eps$ is $<%.1e>$. "
                                     "The JSON has all coefficients (explicit_motion.intervals).",
                                     v->links, of, begin, end, rest, largest_bound(v)));
    at_end(s, v, 0, begin);
    at_end(s, v, v->links - 1, end);
}

static void series(nh_sheet *s, const nh_analysis *result)
{
    const nh_explicit_motion *m = result->motion;
    const nh_motion_series *v = m->series;
    if (!v) return;
    const char *of = nh_name_of(s->dag, m->state[m->parameter]);
    nh_sheet_begin(s, "series", "Series of the integrals",
                   nh_sheet_label(s,
                                  "Along the checked motion, from its start at $<%s>_{0}$, with $Delta = <%s> - "
                                  "<%s>_{0}$. Where $|Delta|$ is at most $Delta_{max}$ each differs by at "
                                  "most its $\\eps$ from its series: proved in ball arithmetic by Taylor's theorem.",
                                  of, of, of));
    first_series(s, v, of);
    if (v->links > 1) other_series(s, v, of);
}

nh_sheet *nh_motion_sheet(const nh_analysis *result)
{
    nh_model *model = result->question->model;
    const nh_explicit_motion *m = result->motion;
    if (!m) return NULL;
    nh_sheet *s = nh_sheet_create(result->arena, model->dag);
    s->analysis = result->question->analysis;
    s->chart = model->chart->roots ? model->chart : NULL;
    s->shown = result->question->options.shown;
    s->written = result->question->options.written;
    nh_sheet_begin(s, "states", "Explicit motion", words_of(s, result));
    for (size_t i = 0; i < m->states; i++)
        if (m->is_known[i] && i != m->parameter) nh_sheet_formula(s, name(s, m->state[i]), m->value[i]);
    if (m->roots) nh_sheet_begin(s, "roots", "Roots in these formulas", "The state determines the sign of each.");
    for (size_t i = 0; i < m->roots; i++) {
        nh_sheet_formula(s, nh_sheet_label(s, "<%s>^{2}", nh_name_of(s->dag, m->root[i].symbol)), m->root[i].square);
        nh_sheet_formula(s, name(s, m->root[i].symbol), m->root[i].value);
    }
    if (m->integrals)
        nh_sheet_begin(s, "integrals", "Integrals in these formulas",
                       "No closed form was found for these. Each is 0 at the start of the motion.");
    for (size_t i = 0; i < m->integrals; i++)
        nh_sheet_formula(s,
                         nh_sheet_label(s, "d<%s>/d<%s>", nh_name_of(s->dag, m->integral[i].symbol),
                                        nh_name_of(s->dag, m->state[m->parameter])),
                         m->integral[i].integrand);
    series(s, result);
    nh_sheet_begin(
        s, "constants",
        m->integrals ? "The constants, from the state at the start" : "The constants, from the state at any time", "");
    for (size_t j = 0; j < m->constants; j++) nh_sheet_formula(s, name(s, m->constant[j].symbol), m->constant[j].value);
    return s;
}

/* Every interval of the chain, with the coefficients of (s - centre)^k. */
static void intervals_json(const nh_analysis *result, nh_json *to)
{
    const nh_motion_series *v = result->motion->series;
    if (!v) {
        nh_json_put_null(to, "intervals");
        return;
    }
    nh_json *intervals = nh_json_put_array(to, "intervals");
    for (size_t i = 0; i < v->links; i++) {
        nh_json *item = nh_json_add_object(intervals);
        nh_json_put_number(item, "centre", v->link[i].centre);
        nh_json_put_number(item, "half", v->link[i].half);
        nh_json *integrals = nh_json_put_array(item, "integrals");
        for (size_t j = 0; j < v->integrals; j++) {
            const nh_motion_series_of_one *one = &v->link[i].integral[j];
            nh_json *of = nh_json_add_object(integrals);
            nh_json_put_text(of, "name", nh_name_of(result->question->model->dag, one->symbol));
            nh_json_put_numbers(of, "coefficients", NH_MOTION_SERIES_TERMS, one->coefficient, 1);
            nh_json_put_number(of, "bound", one->bound);
        }
    }
}

void nh_motion_sheet_json(const nh_analysis *result, nh_json *to)
{
    const nh_explicit_motion *m = result->motion;
    if (!m) {
        nh_json_put_null(to, "explicit_motion");
        return;
    }
    nh_json *item = nh_json_put_object(to, "explicit_motion");
    nh_json_put_text(item, "parameter", nh_name_of(result->question->model->dag, m->state[m->parameter]));
    nh_json_put_bool(item, "complete", m->known == m->states);
    nh_json_put_bool(item, "proved", m->proved);
    nh_json_put_text(item, "fixed", m->fixed ? nh_fixed_text(result->question->model, m->fixed) : NULL);
    nh_json_put_text(item, "region", m->region);
    intervals_json(result, item);
    nh_sheet_json(nh_motion_sheet(result), item);
}
