/* reduction_sheet_metric: the metric of the kinetic energy, the locked inertia of a stage, and Helmholtz's conditions
 * on its gyroscopic force. */
#include "document/reduction_internal.h"

#include "base/memory.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"
#include "graph/print.h"
#include "reduction/hamilton.h"

enum { most_length = 3000 };

static nh_sheet *sheet_of(const nh_reduction *r, const char *key, const char *title, const char *words)
{
    nh_sheet *s = nh_sheet_create(r->arena, r->kinetic->dag);
    s->shown = r->options.shown;
    nh_sheet_begin(s, key, title, words);
    return s;
}

static nh_ex tidy(const nh_reduction *r, nh_ex e) { return nh_simplify_short(r->kinetic->dag, e, most_length); }

static void put(const nh_reduction *r, nh_json *to, const char *key, nh_ex e)
{
    char *text = nh_print_short(r->kinetic->dag, e, r->options.written);
    nh_json_put_text(to, key, text);
    nh_free(text);
}

/* ---- the metric ---- */

nh_sheet *nh_reduction_metric_sheet(const nh_reduction *r)
{
    const nh_kinetic *k = r->kinetic;
    if (!k->quadratic) return NULL;
    nh_sheet *s = sheet_of(r, "metric", "Metric of the kinetic energy",
                           "$T=\\frac{1}{2} K_{r,s} <q'>^{r} <q'>^{s}$. Entries that are not listed vanish.");
    for (size_t i = 0; i < k->m; i++)
        for (size_t j = i; j < k->m; j++) {
            nh_ex e = tidy(r, k->K[i * k->m + j]);
            if (!nh_is_zero(k->dag, e))
                nh_sheet_formula(s, nh_sheet_label(s, "K_{<%s>,<%s>}", k->name[i], k->name[j]), e);
        }
    return s->section->lines ? s : NULL;
}

void nh_reduction_metric_json(const nh_reduction *r, nh_json *to)
{
    const nh_kinetic *k = r->kinetic;
    if (!k->quadratic) {
        nh_json_put_null(to, "metric");
        return;
    }
    nh_json *outer = nh_json_put_array(to, "metric");
    for (size_t i = 0; i < k->m; i++) {
        nh_json *row = nh_json_add_array(outer);
        for (size_t j = 0; j < k->m; j++) {
            char *text = nh_print_short(k->dag, tidy(r, k->K[i * k->m + j]), r->options.written);
            nh_json_add_text(row, text);
            nh_free(text);
        }
    }
}

/* ---- locked inertia ---- */

/* A second stage's with --equations stands among its mechanical connection. */
nh_sheet *nh_reduction_inertia_sheet(const nh_reduction *r, const nh_reduction_stage *stage)
{
    const nh_slice *slice = stage->shown_slice;
    const nh_second *t = stage->kind == NH_STAGE_SECOND ? stage->second : NULL;
    bool whole = stage->kind == NH_STAGE_POINCARE || stage->kind == NH_STAGE_SLICE;
    if (!(whole || (t && !stage->theory))) return NULL;
    nh_sheet *s =
        sheet_of(r, "locked_inertia", "Locked inertia",
                 t && t->first->d ? "$I_{a,b}=\\hat{K}(e_{a},e_{b})$ on the slice, with the metric of the first "
                                    "stage. Entries that are not listed vanish."
                                  : "$I_{a,b}=K(e_{a},e_{b})$ on the slice. Entries that are not listed "
                                    "vanish.");
    for (size_t a = 0; a < slice->d; a++)
        for (size_t b = a; b < slice->d; b++) {
            nh_ex e = t ? t->inertia[a * t->d + b] : slice->K[(slice->n + a) * slice->m + slice->n + b];
            e = tidy(r, e);
            if (!nh_is_zero(s->dag, e)) nh_sheet_formula(s, nh_sheet_label(s, "I_{%zu,%zu}", a + 1, b + 1), e);
        }
    return s->section->lines ? s : NULL;
}

/* ---- Helmholtz's conditions ----
 *
 * F_i = U_kil x'^k x'^l + m_a M_ail x'^l.  A force that depends on places and velocities is one of a Lagrangian iff
 *
 *     dF_i/dx'^j + dF_j/dx'^i = (U_jil + U_ijl) x'^l = 0             (U and M are antisymmetric in the last two)
 *     dF_i/dx^j - dF_j/dx^i = 1/2 d/dt (dF_i/dx'^j - dF_j/dx'^i)
 *
 * By the first one U is antisymmetric in all three, so that U_kil x'^k x'^l = 0; for the rest the second one is
 * d_i M_jk + d_j M_ki + d_k M_ij = 0. */

static nh_ex symmetric(const nh_hamilton *h, size_t i, size_t j, size_t l)
{
    size_t n = h->n;
    return nh_add(h->dag, h->U[(j * n + i) * n + l], h->U[(i * n + j) * n + l]);
}

/* The coefficient of m_a. */
static nh_ex closed(const nh_hamilton *h, size_t a, size_t i, size_t j, size_t k)
{
    size_t n = h->n;
    const nh_ex *M = h->U + (n + a) * n * n;
    nh_dag *d = h->dag;
    return nh_add(d, nh_add(d, nh_diff(d, M[j * n + k], h->x[i]), nh_diff(d, M[k * n + i], h->x[j])),
                  nh_diff(d, M[i * n + j], h->x[k]));
}

static const char *name_of(const nh_hamilton *h, size_t i) { return nh_name_of(h->dag, h->x[i]); }

static void symmetric_lines(const nh_reduction *r, const nh_hamilton *h, nh_sheet *s)
{
    for (size_t i = 0; i < h->n; i++)
        for (size_t j = i; j < h->n; j++) {
            nh_ex *e = nh_alloc_array(h->n + 1, sizeof *e);
            bool any = false;
            for (size_t l = 0; l < h->n; l++) e[l] = tidy(r, symmetric(h, i, j, l)), any |= !nh_is_zero(h->dag, e[l]);
            const char *x = name_of(h, i), *y = name_of(h, j);
            if (any)
                nh_sheet_sum(s, "",
                             i == j ? nh_sheet_label(s, "2 \\frac{\\p F_{<%s>}}{\\p<%s'>}", x, x)
                                    : nh_sheet_label(s, "\\frac{\\p F_{<%s>}}{\\p<%s'>}+\\frac{\\p F_{<%s>}}{\\p<%s'>}",
                                                     x, y, y, x));
            for (size_t l = 0; l < h->n && any; l++) nh_sheet_add(s, e[l], nh_sheet_label(s, "<%s'>", name_of(h, l)));
            nh_free(e);
        }
}

static void closed_lines(const nh_reduction *r, const nh_hamilton *h, nh_sheet *s)
{
    for (size_t i = 0; i < h->n; i++)
        for (size_t j = i + 1; j < h->n; j++)
            for (size_t k = j + 1; k < h->n; k++) {
                bool any = false;
                for (size_t a = 0; a < h->d; a++) any |= !nh_is_zero(h->dag, tidy(r, closed(h, a, i, j, k)));
                if (!any) continue;
                nh_sheet_sum(
                    s, "",
                    nh_sheet_label(s, "(\\d Upsilon)_{<%s>,<%s>,<%s>}", name_of(h, i), name_of(h, j), name_of(h, k)));
                for (size_t a = 0; a < h->d; a++)
                    nh_sheet_add(s, tidy(r, closed(h, a, i, j, k)),
                                 nh_sheet_label(s, "<%s>", nh_name_of(h->dag, h->m[a])));
            }
}

nh_sheet *nh_reduction_helmholtz_sheet(const nh_reduction *r, const nh_reduction_stage *stage)
{
    const nh_hamilton *h = nh_reduction_hamilton(r, stage);
    if (!h || !h->n) return NULL;
    nh_sheet *s = sheet_of(r, "helmholtz_conditions", "Helmholtz's conditions", "");
    symmetric_lines(r, h, s);
    closed_lines(r, h, s);
    s->section->words =
        s->section->lines
            ? "The force $F_{i}=Upsilon_{i,j} <x'>^{j}$ is one of a Lagrangian only where these vanish:"
            : "They hold: the force $F_{i}=Upsilon_{i,j} <x'>^{j}$ is zero, or one of a Lagrangian that is "
              "linear in the velocities.";
    return s;
}

/* The velocities stand in the formulas as they do in the reduced equations. */
void nh_reduction_helmholtz_json(const nh_reduction *r, const nh_reduction_stage *stage, nh_json *root)
{
    const nh_hamilton *h = nh_reduction_hamilton(r, stage);
    if (!h) {
        nh_json_put_null(root, "helmholtz_conditions");
        return;
    }
    nh_json *to = nh_json_put_object(root, "helmholtz_conditions"), *list = nh_json_put_array(to, "symmetric"),
            *other = nh_json_put_array(to, "closed");
    nh_dag *d = h->dag;
    bool holds = true;
    for (size_t i = 0; i < h->n; i++)
        for (size_t j = i; j < h->n; j++) {
            nh_ex sum = nh_int(d, 0);
            for (size_t l = 0; l < h->n; l++)
                sum = nh_add(d, sum, nh_mul(d, tidy(r, symmetric(h, i, j, l)), stage->shown->w[l]));
            if (nh_is_zero(d, sum)) continue;
            nh_json *item = nh_json_add_object(list);
            nh_json_put_text(item, "i", name_of(h, i));
            nh_json_put_text(item, "j", name_of(h, j));
            put(r, item, "value", sum);
            holds = false;
        }
    for (size_t c = 0; c < h->n * h->n * h->n; c++) {
        size_t i = c / (h->n * h->n), j = c / h->n % h->n, k = c % h->n;
        nh_ex sum = nh_int(d, 0);
        for (size_t a = 0; a < h->d && i < j && j < k; a++)
            sum = nh_add(d, sum, nh_mul(d, tidy(r, closed(h, a, i, j, k)), h->m[a]));
        if (nh_is_zero(d, sum)) continue;
        nh_json *item = nh_json_add_object(other);
        nh_json_put_text(item, "i", name_of(h, i));
        nh_json_put_text(item, "j", name_of(h, j));
        nh_json_put_text(item, "k", name_of(h, k));
        put(r, item, "value", sum);
        holds = false;
    }
    nh_json_put_bool(to, "holds", holds);
}
