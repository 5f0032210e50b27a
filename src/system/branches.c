/* branches: dependent velocities that are roots: finding them, choosing the branch, and writing formulas in the
 * velocity instead of the root. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "graph/diff.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/print.h"
#include "system/embedding_internal.h"

/* ---- roots on a chart ---- */

/* The dependent velocity s as a symbol that prints like it, and satisfies symbol^2 = value. */
static nh_root *add_root(nh_chart *c, size_t s, nh_ex base)
{
    nh_dag *d = c->system->dag;
    nh_root *r = &c->root_of[c->roots++];
    *r = (nh_root){
        .coordinate = s, .base = base, .symbol = nh_symbol_fresh(d, nh_name_of(d, c->system->coordinate[s].v))};
    return r;
}

/* a u^2 + b u + c = 0 with root = branch*(2 a u + b) */
void nh_branches_quadratic(nh_chart *chart, size_t s, const nh_quadratic *q)
{
    nh_dag *d = chart->system->dag;
    nh_ex u = chart->system->coordinate[s].v;
    nh_root *r = add_root(chart, s, q->radicand);
    chart->rho[s] = q->u;
    chart->branch = q->branch;
    chart->radicand = q->radicand;
    chart->root = nh_mul(d, nh_int(d, q->branch), q->linear);
    r->value = nh_substitute(d, chart->root, 1, &u, &r->symbol);
    nh_ex rest = nh_add(d, nh_mul(d, q->b, r->symbol), q->c);
    r->square = nh_simplify(d, nh_neg(d, nh_div(d, rest, q->a)));
    nh_relate(d, r->symbol, 2, r->square);
}

static bool depends_on_velocities(const nh_chart *c, nh_ex e)
{
    for (size_t i = 0; i < c->n; i++)
        if (nh_depends(c->system->dag, e, c->w[i])) return true;
    return false;
}

/* The bases of half powers in e that depend on velocities, each once. */
static size_t bases_in(const nh_chart *c, nh_ex e, nh_ex *base, size_t most)
{
    NH_LIST(all);
    size_t bases = nh_radicands_in(c->system->dag, e, &all), n = 0;
    for (size_t i = 0; i < bases && n < most; i++)
        if (depends_on_velocities(c, all[i])) base[n++] = all[i];
    return n;
}

/* v = alpha R + beta, R = sqrt(B) with alpha and beta free of R and alpha free of velocities: R = (v - beta)/alpha. */
static void note_root(nh_chart *c, size_t s)
{
    nh_dag *d = c->system->dag;
    nh_ex base[2], R = nh_symbol_fresh(d, "R"), zero = nh_int(d, 0);
    if (bases_in(c, c->rho[s], base, 2) != 1) return;
    for (size_t k = 0; k < c->roots; k++)
        if (c->root_of[k].base == base[0]) return;
    nh_ex e = nh_substitute_root(d, c->rho[s], base[0], R), alpha = nh_simplify(d, nh_diff(d, e, R)),
          beta = nh_substitute(d, e, 1, &R, &zero);
    if (nh_is_zero(d, alpha) || nh_depends(d, alpha, R) || depends_on_velocities(c, alpha)) return;
    nh_root *r = add_root(c, s, base[0]);
    r->value = nh_div(d, nh_sub(d, r->symbol, beta), alpha);
    nh_ex square = nh_sub(d, nh_mul(d, nh_powi(d, alpha, 2), base[0]), nh_powi(d, beta, 2));
    r->square = nh_simplify(d, nh_add(d, square, nh_product(d, 3, (nh_ex[]){nh_int(d, 2), beta, r->symbol})));
    nh_relate(d, r->symbol, 2, r->square);
}

void nh_branches_note(nh_chart *chart)
{
    size_t k = chart->system->constraints;
    for (size_t a = chart->roots ? 1 : 0; a < k && !chart->quasi; a++)
        if (!chart->implicit) note_root(chart, chart->dependent[a]);
}

/* ---- formulas ---- */

/* Simplification may have changed the radicand by a factor that is a number: sqrt(4 B) is 2 sqrt(B). */
static nh_ex with_root(const nh_chart *c, nh_ex e, nh_ex radicand, nh_ex root)
{
    enum { most = 16 };
    nh_dag *d = c->system->dag;
    nh_ex base[most];
    size_t n = bases_in(c, e, base, most);
    for (size_t i = 0; i < n; i++) {
        nh_ex factor = base[i] == radicand ? nh_int(d, 1) : nh_simplify(d, nh_div(d, base[i], radicand));
        if (nh_kind_of(d, factor) != NH_NUMBER || !(nh_num_value(nh_number_of(d, factor)) > 0)) continue;
        e = nh_substitute_root(d, e, base[i], nh_mul(d, nh_sqrt(d, factor), root));
    }
    return e;
}

nh_ex nh_chart_both_branches(const nh_chart *c, nh_ex e) { return with_root(c, e, c->radicand, c->root); }

nh_ex nh_chart_shown(const nh_chart *c, nh_ex e)
{
    nh_dag *d = c->system->dag;
    for (size_t k = 0; k < c->roots; k++) {
        const nh_root *r = &c->root_of[k];
        nh_ex in_root = with_root(c, e, r->base, r->value), square = nh_powi(d, r->symbol, 2);
        if (in_root != e) e = nh_simplify_short(d, in_root, 0);
        nh_ex shorter = nh_kind_of(d, r->square) == NH_NUMBER ? e : nh_substitute(d, e, 1, &r->square, &square);
        if (shorter != e) shorter = nh_simplify_short(d, shorter, 0);
        if (nh_complexity(d, shorter) < nh_complexity(d, e)) e = shorter;
    }
    return nh_orientation_shown(c->system, e);
}

nh_ex nh_chart_in_velocities(const nh_chart *c, nh_ex shown)
{
    const nh_system *system = c->system;
    for (size_t k = 0; k < c->roots; k++)
        shown = nh_substitute(system->dag, shown, 1, &c->root_of[k].symbol,
                              &system->coordinate[c->root_of[k].coordinate].v);
    return nh_orientation_unshown(system, shown);
}

nh_ex nh_chart_composed(const nh_chart *c, nh_ex shown, const nh_chart *other)
{
    nh_dag *d = c->system->dag;
    for (size_t k = 0; k < c->roots; k++)
        shown = nh_substitute(d, shown, 1, &c->root_of[k].symbol, &other->rho[c->root_of[k].coordinate]);
    return shown;
}

/* ---- the name of a branch ---- */

/* The sign of something that contains parameters only, at their values; 0 when it contains anything else. */
static int sign_of(const nh_chart *c, nh_ex e)
{
    for (size_t j = 0; j < c->width; j++)
        if (nh_depends(c->system->dag, e, c->symbol[j])) return 0;
    double value = nh_system_number(c->system, e);
    return value > 0 ? 1 : value < 0 ? -1 : 0;
}

/* e over the positive number that is its factor. */
static nh_ex without_factor(nh_dag *d, nh_ex e)
{
    nh_num factor = nh_kind_of(d, e) == NH_PRODUCT ? nh_constant_of(d, e) : nh_num_int(1);
    nh_ex size = nh_number(d, nh_num_value(factor) < 0 ? nh_num_mul(factor, nh_num_int(-1)) : factor);
    return nh_simplify(d, nh_div(d, e, size));
}

char *nh_chart_branch_name(const nh_chart *c, int branch)
{
    nh_dag *d = c->system->dag;
    const nh_root *r = &c->root_of[0];
    /* 2 a u + b; 2 a where b = 0 */
    nh_ex linear = nh_mul(d, nh_int(d, c->branch), r->value), slope = nh_div(d, linear, r->symbol);
    int sign = nh_depends(d, slope, r->symbol) ? 0 : sign_of(c, slope);
    nh_text text;
    nh_text_init(&text);
    nh_print(d, sign ? r->symbol : without_factor(d, nh_simplify(d, linear)), &text);
    nh_text_add(&text, (sign ? sign : 1) * branch > 0 ? " > 0" : " < 0");
    char *name = nh_strdup(nh_text_string(&text));
    nh_text_clear(&text);
    return name;
}
