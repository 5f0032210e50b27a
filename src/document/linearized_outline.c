/* linearized_outline: the linear equations as a document. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "document/linearized.h"
#include "document/pen.h"
#include "document/screen.h"
#include "graph/node.h"

enum { digits = 14 };

static const char *digits_of(const nh_linearized *x, double value)
{
    return nh_arena_printf(x->arena, "%.*g", digits, value == 0 ? 0 : value);
}

/* ---- the state ---- */

static void names(nh_pen *p, const nh_linearized *x, const nh_linear_equations *e, bool closed)
{
    const char *between = "";
    for (size_t i = 0; i < e->s + e->n; i++) {
        if (e->closed[i] != closed) continue;
        nh_pen_say(p, "%s<%s>", between, nh_linearize_name(x, e, i));
        between = ", ";
    }
}

/* The index of the next of the coordinates and velocities that is not 0; 2m: there is none. */
static size_t next_value(const nh_linear_equations *e, size_t i)
{
    while (i < 2 * e->m && (i < e->m ? e->q[i] : e->v[i - e->m]) == 0) i++;
    return i;
}

static const char *name_of_value(const nh_linearized *x, const nh_linear_equations *e, size_t i)
{
    const nh_coordinate *c = &x->system->coordinate[i % e->m];
    return nh_name_of(x->system->dag, i < e->m ? c->q : c->v);
}

static const char *value_of(const nh_linearized *x, const nh_linear_equations *e, size_t i)
{
    return digits_of(x, i < e->m ? e->q[i] : e->v[i - e->m]);
}

static const char at_rest[] = "at rest, all coordinates 0", all_else[] = "; all else is 0";

static void put_values(nh_pen *p, const nh_linearized *x, const nh_linear_equations *e)
{
    size_t first = next_value(e, 0);
    for (size_t i = first; i < 2 * e->m; i = next_value(e, i + 1))
        nh_pen_say(p, "%s<%s> = %s", i == first ? "" : ", ", name_of_value(x, e, i), value_of(x, e, i));
    nh_pen_say(p, "%s", first < 2 * e->m ? all_else : at_rest);
}

static const char *steadiness(const nh_linearized *x, const nh_linear_equations *e)
{
    if (e->residual > 0)
        return nh_arena_printf(x->arena, "no: what the matrix depends on changes, at the rate %.6g at most",
                               e->residual);
    if (e->changes) return "the rates vanish, but the linear equations change with time";
    return e->moves ? "yes: what moves does not occur in the linear equations" : "yes: an equilibrium";
}

static void state(nh_pen *p, const nh_linearized *x, const nh_linear_equations *e)
{
    nh_pen_section(p, "state", "The state");
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    nh_pen_fact_begin(p, "State");
    put_values(p, x, e);
    nh_pen_close(p, NH_PEN_FACT);
    nh_pen_fact(p, "Steady", "%s", steadiness(x, e));
    if (e->size < e->s + e->n) {
        nh_pen_fact_begin(p, "Left out");
        names(p, x, e, false);
        nh_pen_say(p, ": no rate of the others depends on them");
        nh_pen_close(p, NH_PEN_FACT);
    }
    nh_pen_close(p, NH_PEN_FACTS);
}

/* ---- eigenvalues ---- */

static void eigenvalues(nh_pen *p, const nh_linearized *x, const nh_linear_equations *e)
{
    nh_pen_section(p, "eigenvalues", "Eigenvalues");
    nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
    nh_pen_say(p, "Of the linear equations for ");
    names(p, x, e, true);
    nh_pen_say(p, ".");
    nh_pen_close(p, NH_PEN_WORDS);
    nh_pen_table(p, "", "#real part|#imaginary part|#error|#times");
    for (size_t i = 0; i < e->eigenvalues; i++) {
        const nh_eigenvalue *z = &e->eigenvalue[i];
        nh_pen_row(p, "%s|%s|%.1g|%zu", digits_of(x, z->re), digits_of(x, z->im), z->error, z->times);
    }
    nh_pen_table_end(p);
}

/* ---- matrices ---- */

static void matrix(nh_pen *p, const nh_linearized *x, const nh_linear_equations *e, const char *caption,
                   const double *entry, size_t columns, size_t first)
{
    nh_text head;
    nh_text_init(&head);
    for (size_t j = 0; j < columns; j++) nh_text_addf(&head, "|#%s", nh_linearize_name(x, e, first + j));
    nh_pen_table(p, caption, nh_text_string(&head));
    for (size_t i = 0; i < e->n; i++) {
        nh_pen_open(p, NH_PEN_ROW, NULL, NULL);
        nh_pen_cell(p, NH_PEN_ROW_HEAD, "%s", nh_linearize_name(x, e, e->s + i));
        for (size_t j = 0; j < columns; j++) nh_pen_cell(p, NH_PEN_CELL, "%s", digits_of(x, entry[i * columns + j]));
        nh_pen_close(p, NH_PEN_ROW);
    }
    nh_pen_table_end(p);
    nh_text_clear(&head);
}

static void equations(nh_pen *p, const nh_linearized *x, const nh_linear_equations *e)
{
    nh_pen_section(p, "equations", "Linear equations");
    nh_pen_words(p,
                 "M dw' + C dw + K dx = 0: dx deviations of coordinates, dw of their velocities. The dependent ones "
                 "follow from the constraints. Errors of the entries: %.1g at most.",
                 e->error);
    matrix(p, x, e, "M", e->M, e->n, e->s);
    matrix(p, x, e, "C", e->C, e->n, e->s);
    matrix(p, x, e, "K", e->N, e->s, 0);
}

/* ---- along a family ---- */

static void side(nh_pen *p, nh_linear_verdict verdict, size_t positive)
{
    nh_pen_say(p, "%s", nh_linearized_word(verdict));
    if (positive) nh_pen_say(p, positive == 1 ? " (%zu positive real part)" : " (%zu positive real parts)", positive);
}

static void changes(nh_pen *p, const nh_linearized *x)
{
    nh_pen_section(p, "changes", "Where the stability changes");
    if (!x->changes) nh_pen_words(p, "Nowhere between the values.");
    else nh_pen_table(p, "", nh_arena_printf(x->arena, "#%s|#error|below|above", x->over));
    for (size_t i = 0; i < x->changes; i++) {
        const nh_linear_change *c = &x->change[i];
        nh_pen_open(p, NH_PEN_ROW, NULL, NULL);
        nh_pen_cell(p, NH_PEN_CELL, "%s", nh_arena_printf(x->arena, "%.15g", c->low + (c->high - c->low) / 2));
        nh_pen_cell(p, NH_PEN_CELL, "%.1g", (c->high - c->low) / 2);
        nh_pen_open(p, NH_PEN_CELL, NULL, NULL);
        side(p, c->before, c->positive_before);
        nh_pen_close(p, NH_PEN_CELL);
        nh_pen_open(p, NH_PEN_CELL, NULL, NULL);
        side(p, c->after, c->positive_after);
        nh_pen_close(p, NH_PEN_CELL);
        nh_pen_close(p, NH_PEN_ROW);
    }
    if (x->changes) nh_pen_table_end(p);
}

static void values(nh_pen *p, const nh_linearized *x)
{
    nh_pen_section(p, "values", "Eigenvalues along the family");
    nh_pen_table(p, "", nh_arena_printf(x->arena, "#%s|verdict|#largest real part|#its imaginary part", x->over));
    for (size_t i = 0; i < x->rows; i++) {
        const nh_linear_row *row = &x->row[i];
        const nh_linear_equations *e = row->equations;
        bool any = e && e->eigenvalues;
        nh_pen_row(p, "%s|%s|%s|%s", digits_of(x, row->value.value), e ? nh_linearized_word(row->verdict) : row->why,
                   any ? digits_of(x, e->eigenvalue[0].re) : "", any ? digits_of(x, e->eigenvalue[0].im) : "");
    }
    nh_pen_table_end(p);
}

static void picture(nh_pen *p, const nh_linearized *x)
{
    nh_curve *curves;
    nh_plot plot = nh_linearized_plot(x, &curves);
    nh_pen_plot(p, &plot, x->over ? "Real and imaginary parts of the eigenvalues." : "The eigenvalues in the plane.");
    nh_free(curves);
}

static void answer(nh_pen *p, const nh_linearized *x)
{
    nh_linear_verdict v = x->row[0].verdict;
    bool decided = v == NH_LINEAR_UNSTABLE || v == NH_LINEAR_STABLE;
    nh_pen_open(p, NH_PEN_ANSWER, x->over || decided ? "found" : "undecided", NULL);
    if (!x->over) nh_pen_say(p, "%s", nh_linearized_sentence(v));
    else
        nh_pen_say(p,
                   x->changes == 1 ? "The stability changes at %zu value of <%s>."
                                   : "The stability changes at %zu values of <%s>.",
                   x->changes, x->over);
    nh_pen_close(p, NH_PEN_ANSWER);
}

/* ---- the first screen ---- */

enum { most_shown = 20 }; /* eigenvalues, or changes */

/* What a small deviation with this eigenvalue does. */
static void put_meaning(const nh_eigenvalue *z, nh_text *out)
{
    bool zero = fabs(z->re) <= z->error, real = fabs(z->im) <= z->error;
    if (zero && real) nh_text_add(out, "no exponential growth or decay");
    if (!real) nh_text_addf(out, "period %.5g", 2 * acos(-1) / fabs(z->im));
    if (!zero)
        nh_text_addf(out, "%s%s in %.5g", real ? "" : ", ", z->re > 0 ? "grows by e" : "decays to 1/e",
                     1 / fabs(z->re));
}

/* Conjugate ones are one line. */
static void put_eigenvalues(const nh_linear_equations *e, nh_text *out)
{
    size_t told = 0, left = 0;
    nh_text_add(out, e->eigenvalues ? "\nEigenvalues\n" : "");
    for (size_t i = 0; i < e->eigenvalues; i++) {
        const nh_eigenvalue *z = &e->eigenvalue[i];
        bool real = fabs(z->im) <= z->error;
        if (!real && z->im < 0) continue;
        if (told++ >= most_shown) {
            left++;
            continue;
        }
        nh_text value;
        nh_text_init(&value);
        nh_text_addf(&value, "%.10g", fabs(z->re) <= z->error ? 0 : z->re);
        if (!real) nh_text_addf(&value, " +- %.10g i", z->im);
        nh_text_addf(out, "  %-31s ", nh_text_string(&value));
        if (e->residual == 0 && !e->changes) put_meaning(z, out);
        if (z->times > 1) nh_text_addf(out, " (%zu times)", z->times);
        nh_text_add(out, "\n");
        nh_text_clear(&value);
    }
    if (left) nh_text_addf(out, "  %zu more (--details)\n", left);
}

static void put_changes(const nh_linearized *x, nh_text *out)
{
    for (size_t i = 0; i < x->changes && i < most_shown; i++) {
        const nh_linear_change *c = &x->change[i];
        nh_text_addf(out, "%s  %s = %.10g: %s below, %s above\n", i ? "" : "\n", x->over,
                     c->low + (c->high - c->low) / 2, nh_linearized_word(c->before), nh_linearized_word(c->after));
    }
    if (x->changes > most_shown) nh_text_addf(out, "  %zu more (--details)\n", x->changes - most_shown);
    size_t open = 0;
    for (size_t i = 0; i < x->rows; i++) open += !x->row[i].equations;
    if (open) nh_text_addf(out, "  at %zu of %zu values there is no answer (--details)\n", open, x->rows);
}

static void first_screen(const nh_linearized *x, bool colour, nh_text *out)
{
    const nh_linear_equations *e = x->row[0].equations;
    const char *const open[3] = {x->over};
    nh_text words;
    nh_text_init(&words);
    bool same = true;
    for (size_t i = 0; i < x->rows; i++) same &= x->row[i].equations && x->row[i].verdict == x->row[0].verdict;
    if (x->over && !x->changes && same)
        nh_text_addf(&words, "The state is %s at all %zu values of %s", nh_linearized_word(x->row[0].verdict), x->rows,
                     x->over);
    else if (x->over)
        nh_text_addf(&words, "The stability changes at %zu value%s of %s", x->changes, x->changes == 1 ? "" : "s",
                     x->over);
    else nh_text_add(&words, nh_linearized_sentence(x->row[0].verdict));
    if (x->over) nh_text_addf(&words, " between %s and %s.", x->row[0].value.text, x->row[x->rows - 1].value.text);
    nh_screen_begin(out, colour, x->system, open, &words);
    if (x->over) {
        put_changes(x, out);
    } else {
        size_t first = next_value(e, 0);
        nh_text_add(&words, "State: ");
        for (size_t i = first; i < 2 * e->m; i = next_value(e, i + 1))
            nh_text_addf(&words, "%s%s = %s", i == first ? "" : ", ", name_of_value(x, e, i), value_of(x, e, i));
        nh_text_addf(&words, "%s. Steady: %s.", first < 2 * e->m ? all_else : at_rest, steadiness(x, e));
        nh_screen_say(out, 0, &words);
        put_eigenvalues(e, out);
    }
    nh_screen_more(out, x->over ? "the eigenvalues at each value" : "the linear equations, and the errors",
                   "--svg FILE  the eigenvalues as a picture");
}

void nh_linearized_write(const nh_linearized *x, const nh_run *run, nh_pen_style style, nh_text *out)
{
    if (nh_screen_is_wanted(style)) {
        first_screen(x, style.colour, out);
        return;
    }
    nh_pen pen, *p = &pen;
    nh_pen_subject subject = {.system = x->system, .dag = x->system->dag, .shown = run->shown};
    nh_pen_begin(p, style, &subject, "linear equations of motion", out);
    answer(p, x);
    p->ink->links(p->to, x->over ? "changes|Changes|values|Values|system|System|repeat|Repeat it"
                                 : "state|The state|eigenvalues|Eigenvalues|equations|Equations|system|System|repeat|"
                                   "Repeat it");
    if (x->over) {
        changes(p, x);
        values(p, x);
        picture(p, x);
    } else {
        const nh_linear_equations *e = x->row[0].equations;
        state(p, x, e);
        eigenvalues(p, x, e);
        picture(p, x);
        equations(p, x, e);
    }
    nh_pen_system(p, NULL, NULL);
    nh_pen_end(p, run);
}
