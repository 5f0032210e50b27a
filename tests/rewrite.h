/* rewrite: a system written again with other names, another order, other units, another choice of dependent velocities, or a term added; it is the same
 * system (or nearly), so the same must (or must not) be found. */
#ifndef NH_TESTS_REWRITE_H
#define NH_TESTS_REWRITE_H

#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/print.h"
#include "system/system.h"

enum { rewrite_most = 40 };

/* What is changed; zero: nothing. */
typedef struct {
    bool rename;             /* coordinates and quasi-velocities get new names */
    const size_t *order;     /* order[i]: which coordinate comes i-th; NULL: as it was */
    nh_num length, time, action; /* old = new * this; q == 0: 1.  `length` is that of every coordinate that is no pure number, `action` multiplies L */
    bool no_chart;           /* without the quasi-velocities */
    size_t dependents;       /* 0: as it was, or, with no_dependents, left to the program */
    const size_t *dependent;
    bool no_dependents;
    nh_ex extra;             /* added to L, in the old names; 0: nothing */
    size_t known;            /* currents to be written as known, in t, q, q' of the old names */
    const nh_ex *current;
} rewriting;

typedef struct {
    const nh_system *y;
    const rewriting *how;
    nh_dag *dag;
    size_t count;
    nh_ex from[3 * rewrite_most], to[3 * rewrite_most];
    char name[2 * rewrite_most][24]; /* of coordinates, then of quasi-velocities */
} rewriter;

static nh_num scale_or_one(nh_num x) { return x.q ? x : nh_num_int(1); }

static bool in_function(const nh_system *y, nh_ex e, nh_ex q)
{
    NH_LIST(call);
    size_t n = nh_functions_in(y->dag, e, &call);
    for (size_t i = 0; i < n; i++)
        if (nh_depends(y->dag, call[i], q)) return true;
    return false;
}

/* Angles, and what stands in a sine or exponential, are pure numbers. */
static bool is_number(const nh_system *y, size_t s)
{
    nh_ex q = y->coordinate[s].q;
    bool found = y->coordinate[s].type == NH_ANGLE || in_function(y, y->lagrangian, q);
    for (size_t a = 0; a < y->constraints && !found; a++) found = in_function(y, y->constraint[a].lhs, q) || in_function(y, y->constraint[a].rhs, q);
    return found;
}

static nh_num length_of(const rewriter *w, size_t s) { return is_number(w->y, s) ? nh_num_int(1) : scale_or_one(w->how->length); }

static void map_symbol(rewriter *w, nh_ex from, const char *name, nh_num scale)
{
    w->from[w->count] = from;
    w->to[w->count++] = nh_mul(w->dag, nh_number(w->dag, scale), nh_symbol(w->dag, name));
}

static rewriter rewriter_of(const nh_system *y, const rewriting *how)
{
    rewriter w = {.y = y, .how = how, .dag = y->dag};
    nh_num time = scale_or_one(how->time);
    map_symbol(&w, y->t, "t", time);
    for (size_t s = 0; s < y->coordinates + y->quasi; s++) {
        bool quasi = s >= y->coordinates;
        const char *old = quasi ? nh_name_of(w.dag, y->quasi_velocity[s - y->coordinates]) : y->coordinate[s].name;
        char velocity[30];
        if (how->rename) snprintf(w.name[s], sizeof w.name[s], "%c_%.16s", (char)('z' - (char)(s % 20)), old); /* another order of the alphabet */
        else snprintf(w.name[s], sizeof w.name[s], "%.20s", old);
        snprintf(velocity, sizeof velocity, "%s'", w.name[s]);
        if (quasi) {
            map_symbol(&w, y->quasi_velocity[s - y->coordinates], w.name[s], nh_num_int(1));
            continue;
        }
        map_symbol(&w, y->coordinate[s].q, w.name[s], length_of(&w, s));
        map_symbol(&w, y->coordinate[s].v, velocity, nh_num_mul(length_of(&w, s), nh_num_inv(time)));
    }
    return w;
}

static void write_again(const rewriter *w, FILE *out, nh_num factor, nh_ex e)
{
    e = nh_mul(w->dag, nh_number(w->dag, factor), nh_substitute(w->dag, e, w->count, w->from, w->to));
    char *text = nh_print_string(w->dag, e);
    fputs(text, out);
    nh_free(text);
}

static void write_coordinates(const rewriter *w, FILE *out)
{
    static const char *const type[] = {"angle", "length", "number"};
    const nh_system *y = w->y;
    if (y->parameters) fputs("parameters:\n", out);
    for (size_t i = 0; i < y->parameters; i++) fprintf(out, "  - {name: %s, value: %.17g}\n", y->parameter[i].name, y->parameter[i].value);
    fputs("coordinates:\n", out);
    for (size_t i = 0; i < y->coordinates; i++) {
        size_t s = w->how->order ? w->how->order[i] : i;
        fprintf(out, "  - {name: %s, type: %s}\n", w->name[s], type[y->coordinate[s].type]);
    }
}

static void write_equations(const rewriter *w, FILE *out)
{
    const nh_system *y = w->y;
    nh_num action = scale_or_one(w->how->action);
    fputs("lagrangian: \"", out);
    write_again(w, out, action, nh_add(w->dag, y->lagrangian, w->how->extra));
    fputs("\"\n", out);
    if (y->constraints) fputs("constraints:\n", out);
    for (size_t a = 0; a < y->constraints; a++) {
        fputs("  - \"", out);
        write_again(w, out, nh_num_int(1), y->constraint[a].lhs);
        fputs(" = ", out);
        write_again(w, out, nh_num_int(1), y->constraint[a].rhs);
        fputs("\"\n", out);
    }
    if (y->has_forces) fputs("forces:\n", out);
    for (size_t s = 0; s < y->coordinates && y->has_forces; s++) {
        if (nh_is_zero(w->dag, y->force[s])) continue;
        fprintf(out, "  - \"%s = ", w->name[s]);
        write_again(w, out, nh_num_mul(action, length_of(w, s)), y->force[s]);
        fputs("\"\n", out);
    }
}

static void write_chart(const rewriter *w, FILE *out)
{
    const nh_system *y = w->y;
    const size_t *dependent = w->how->dependents ? w->how->dependent : y->dependent;
    size_t n = w->how->dependents ? w->how->dependents : w->how->no_dependents ? 0 : y->dependents;
    for (size_t i = 0; i < n; i++) fprintf(out, "%s%s%s", i ? ", " : "dependent: [", w->name[dependent[i]], i + 1 == n ? "]\n" : "");
    if (y->quasi == 0 || w->how->no_chart) return;
    fputs("velocities:\n  names: [", out);
    for (size_t i = 0; i < y->quasi; i++) fprintf(out, "%s%s", i ? ", " : "", w->name[y->coordinates + i]);
    fputs("]\n  map:\n", out);
    for (size_t s = 0; s < y->coordinates; s++) {
        fprintf(out, "    - \"%s' = ", w->name[s]);
        write_again(w, out, nh_num_mul(scale_or_one(w->how->time), nh_num_inv(length_of(w, s))), y->quasi_map[s]);
        fputs("\"\n", out);
    }
}

static void write_interval(FILE *out, const char *name, const char *prime, double low, double high, double factor)
{
    fprintf(out, "  %s%s: [%.17g, %.17g]\n", name, prime, low * factor, high * factor);
}

/* The box of the old units, in the new ones; where the file gives none, the default one. */
static void write_domain(const rewriter *w, FILE *out)
{
    const nh_system *y = w->y;
    double time = nh_num_value(scale_or_one(w->how->time));
    fputs("domain:\n", out);
    for (size_t i = 0; i < w->count; i++) {
        bool is_time = i == 0, quasi = i > 2 * y->coordinates;
        size_t s = quasi ? i - y->coordinates - 1 : is_time ? 0 : (i - 1) / 2;
        bool velocity = !is_time && !quasi && (i - 1) % 2;
        double length = quasi || is_time ? 1 : nh_num_value(length_of(w, s)), factor = is_time ? 1 / time : quasi ? 1 : velocity ? time / length : 1 / length;
        double low = is_time ? 0 : velocity || quasi ? -1.5 : -1, high = is_time ? 1 : -low;
        bool given = false;
        for (size_t k = 0; k < y->intervals; k++)
            if (y->interval[k].symbol == w->from[i]) given = true, low = y->interval[k].low, high = y->interval[k].high;
        if (quasi && w->how->no_chart) continue;
        if (given || factor != 1 || is_time) write_interval(out, is_time ? "t" : w->name[s], velocity ? "'" : "", low, high, factor);
    }
}

static void rewrite_system(const nh_system *y, const rewriting *how, FILE *out)
{
    rewriter w = rewriter_of(y, how);
    fputs("name: again\n", out);
    write_coordinates(&w, out);
    write_equations(&w, out);
    write_chart(&w, out);
    write_domain(&w, out);
    if (how->known) fputs("known:\n  currents:\n", out);
    for (size_t k = 0; k < how->known; k++) {
        fprintf(out, "    - {name: Phi%zu, expr: \"", k + 1);
        write_again(&w, out, nh_num_int(1), how->current[k]);
        fputs("\"}\n", out);
    }
}

#endif
