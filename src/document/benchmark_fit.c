/* benchmark_fit: the discrete problem as text and JSON. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "document/benchmark_internal.h"

static void time_text(double seconds, char out[24])
{
    double ms = 1e3 * seconds;
    snprintf(out, 24, ms < 9.95 ? "%.2f" : "%.0f", ms);
}

const char *nh_fitted_word(const nh_fitted *m)
{
    if (m->undecided) return "undecided";
    if (m->dimension > m->wanted) return "too many";
    if (m->dimension < m->wanted) return "too few";
    return m->right ? "accurate" : "inexact";
}

static void put(const nh_fitted *m, nh_text *out)
{
    char ms[24], gap[24], error[24];
    time_text(m->seconds, ms);
    snprintf(gap, sizeof gap, isfinite(m->gap) ? "%.0e" : "-", m->gap);
    snprintf(error, sizeof error, isfinite(m->error) ? "%.0e" : "-", m->error);
    nh_text_addf(out, "%9zu%9zu   %-10s%-10s%-12s%6zu of %-6zu%9s%9s%9s   %-9s%s\n", m->columns, m->samples, m->basis, m->route, m->solver, m->dimension, m->wanted, gap, error, ms,
                 nh_fitted_word(m), m->front ? " *" : "");
}

void nh_fits_text(const nh_benchmark *c, bool verbose, nh_text *out)
{
    if (!c->fits) return;
    nh_text_add(out, "\nThe discrete problem: polynomials in velocities, sines, cosines and coordinates; error of the known currents, milliseconds\n");
    nh_text_addf(out, "%9s%9s   %-10s%-10s%-12s%15s%7s%9s%9s\n", "columns", "samples", "basis", "route", "solver", "dimension", "gap", "error", "time");
    size_t largest = c->fit[c->fits - 1].functions;
    for (size_t i = 0, next; i < c->fits; i = next) {
        const nh_fitted *m = &c->fit[i];
        for (next = i; next < c->fits && c->fit[next].functions == m->functions;) next++;
        for (size_t j = i; j < next; j++) {
            const nh_fitted *f = &c->fit[j];
            if (verbose || j == i || f->front || (m->functions == largest && f->samples == m->samples)) put(f, out);
        }
    }
    nh_text_addf(out, "  * accurate, and no other of as many functions is both faster and more exact%s\n", verbose ? "" : "; --verbose shows all");
    if (c->fits_partial) nh_text_add(out, "  there was no time for more functions; --budget allows more\n");
}

void nh_fits_json(const nh_benchmark *c, nh_json *root)
{
    nh_json *list = nh_json_put_array(root, "discrete");
    for (size_t i = 0; i < c->fits; i++) {
        const nh_fitted *m = &c->fit[i];
        nh_json *item = nh_json_add_object(list);
        nh_json_put_number(item, "functions", (double)m->functions);
        nh_json_put_number(item, "columns", (double)m->columns);
        nh_json_put_number(item, "samples", (double)m->samples);
        nh_json_put_text(item, "basis", m->basis);
        nh_json_put_text(item, "route", m->route);
        nh_json_put_text(item, "solver", m->solver);
        nh_json_put_number(item, "rank", (double)m->rank);
        nh_json_put_number(item, "dimension", (double)m->dimension);
        nh_json_put_number(item, "wanted", (double)m->wanted);
        nh_json_put_number(item, "gap", m->gap);
        nh_json_put_number(item, "error", m->error);
        nh_json_put_number(item, "seconds", m->seconds);
        const char *word = nh_fitted_word(m);
        nh_json_put_text(item, "status", !strcmp(word, "accurate") ? "right" : word);
        nh_json_put_bool(item, "front", m->front);
    }
}
