/* model_regular: has every independent velocity inertia?
 *
 * The equations of motion determine the accelerations only where the mass matrix on the constraint submanifold is
 * regular:
 *
 *     M = R^T K R,   K_rs = d^2 L / dv^r dv^s,   R = d rho / dw          [docs/method.md, sec. 2]
 *
 * It is evaluated at the probes of the chart, so that a singular Lagrangian is refused before anything is
 * simplified. */
#include "geometry/model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/linalg.h"
#include "base/text.h"
#include "exact/generic_value.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"
#include "graph/print.h"

/* ---- Lagrangians that are linear in all velocities, as those of point vortices and guiding centres ----
 *
 *     L = a_i q_i' - H:   omega_ij q_j' = dH/dq_i + da_i/dt - Q_i,   omega_ij = da_j/dq_i - da_i/dq_j
 *
 * No velocity has inertia: the state is q alone.  The program takes such equations as constraints beside one coordinate
 * that moves by itself; what stays constant are then integrals of these constraints. */

/* a_i = dL/dv_i; false: some a_i depends on a velocity, or all of them are zero. */
static bool is_linear(const nh_model *model, nh_ex *a)
{
    const nh_system *system = model->system;
    bool any = false;
    for (size_t i = 0; i < model->m; i++) {
        a[i] = nh_simplify_short(model->dag, nh_diff(model->dag, system->lagrangian, system->coordinate[i].v), 0);
        any |= !nh_is_zero(model->dag, a[i]);
        for (size_t j = 0; j < model->m; j++)
            if (nh_depends(model->dag, a[i], system->coordinate[j].v) ||
                nh_depends(model->dag, system->force[i], system->coordinate[j].v))
                return false;
    }
    return any && model->k == 0;
}

/* Solves for the velocities; false: the equations do not determine them. */
static bool solve(const nh_model *model, const nh_ex *a, nh_ex *velocity)
{
    const nh_system *system = model->system;
    nh_dag *d = model->dag;
    size_t m = model->m;
    nh_ex *omega = nh_alloc_array(m * m + 2 * m, sizeof *omega), *v = omega + m * m, *zero = v + m;
    for (size_t i = 0; i < m; i++) v[i] = system->coordinate[i].v, zero[i] = nh_int(d, 0);
    nh_ex H = nh_neg(d, nh_substitute(d, system->lagrangian, m, v, zero));
    for (size_t i = 0; i < m; i++) {
        nh_ex q = system->coordinate[i].q;
        for (size_t j = 0; j < m; j++) {
            nh_ex curl = nh_sub(d, nh_diff(d, a[j], q), nh_diff(d, a[i], system->coordinate[j].q));
            omega[i * m + j] = nh_simplify_short(d, curl, 0);
        }
        velocity[i] = nh_sub(d, nh_add(d, nh_diff(d, H, q), nh_diff(d, a[i], system->t)), system->force[i]);
    }
    nh_lu *lu = nh_lu_create(d, m, omega, nh_chart_pivot_score, model->chart, NULL);
    if (lu) nh_lu_solve(lu, velocity, velocity);
    for (size_t i = 0; i < m && lu; i++) velocity[i] = nh_simplify_short(d, velocity[i], 0);
    bool solved = lu != NULL;
    nh_lu_free(lu);
    nh_free(omega);
    return solved;
}

/* The name of a further coordinate. */
static const char *free_name(const nh_system *system)
{
    static const char *const names[] = {"s", "u", "clock", "own_clock"};
    size_t i = 0;
    nh_ex ignored;
    while (i + 1 < sizeof names / sizeof *names && nh_symbol_find(system->dag, names[i], &ignored)) i++;
    return names[i];
}

static void write_instead(const nh_model *model, const nh_ex *velocity, nh_error *error)
{
    enum { most = 500 }; /* a hint is no longer */
    const nh_system *system = model->system;
    const char *name = free_name(system);
    nh_text text;
    nh_text_init(&text);
    nh_text_addf(&text,
                 "write these equations as constraints beside a coordinate that moves by itself: coordinates [.., %s], "
                 "lagrangian: %s'^2/2, constraints: [",
                 name, name);
    for (size_t i = 0; i < model->m && text.length < most; i++) {
        char *e = nh_print_short(model->dag, velocity[i], most);
        nh_text_addf(&text, "%s\"%s' = %s\"", i ? ", " : "", system->coordinate[i].name, e ? e : "");
        if (!e) nh_text_addf(&text, "%*s", most, "");
        nh_free(e);
    }
    nh_text_add(&text, "]");
    if (text.length < most) nh_error_hint(error, "%s", nh_text_string(&text));
    else
        nh_error_hint(error,
                      "with L = a_i q_i' - H they are omega_ij q_j' = dH/dq_i, omega_ij = da_j/dq_i - da_i/dq_j: solve "
                      "them for q' and write them as constraints beside a coordinate that moves by itself: coordinates "
                      "[.., %s], lagrangian: %s'^2/2, constraints: [\"%s' = ..\", ..]",
                      name, name, system->coordinate[0].name);
    nh_text_clear(&text);
}

/* Refuses such a Lagrangian, without constraints, with the constraints to write instead where they are short.  True,
 * without an error: the Lagrangian is of another kind. */
static bool refuse_first_order(const nh_model *model, nh_error *error)
{
    const nh_deck_node *where = nh_deck_get(nh_deck_root(model->system->deck), "lagrangian");
    nh_ex *a = nh_alloc_array(2 * model->m + 1, sizeof *a), *velocity = a + model->m;
    bool linear = is_linear(model, a), solved = linear && solve(model, a, velocity);
    if (solved) {
        nh_deck_fail(model->system->deck, where, 0, error,
                     "the Lagrangian is linear in the velocities: no velocity has inertia, and its equations of motion "
                     "are of first order");
        write_instead(model, velocity, error);
    } else if (linear) {
        nh_deck_fail(model->system->deck, where, 0, error,
                     "the Lagrangian is linear in the velocities, and its equations do not determine them");
        nh_error_hint(error, "every independent velocity needs inertia; or is a term of the Lagrangian missing?");
    }
    nh_free(a);
    return !linear;
}

/* ---- model regular ---- */

/* The mass matrix at those probes where it is finite. */
typedef struct {
    size_t n, count;
    double *M;         /* count x n x n */
    const double **at; /* the probes */
} masses;

static void masses_clear(masses *a)
{
    nh_free(a->M);
    nh_free(a->at);
}

/* K (m x m) and R (m x n, row-major), for models that have no mass matrix yet; to be freed. */
static nh_ex *factors(const nh_model *model)
{
    nh_dag *d = model->dag;
    size_t m = model->m, n = model->n;
    nh_ex *e = nh_alloc_array(m * m + m * n + 1, sizeof *e);
    for (size_t r = 0; r < m; r++) {
        nh_ex p = nh_diff(d, model->system->lagrangian, model->system->coordinate[r].v);
        for (size_t s = 0; s <= r; s++)
            e[r * m + s] = e[s * m + r] = nh_model_compose(model, nh_diff(d, p, model->system->coordinate[s].v));
        for (size_t i = 0; i < n; i++) e[m * m + r * n + i] = nh_model_Y(model, i, model->rho[r]);
    }
    return e;
}

/* Is M regular at almost all places, by its rank modulo primes?  False: it is not, or not known. */
static bool regular_exactly(const nh_model *model)
{
    nh_dag *d = model->dag;
    size_t m = model->m, n = model->n, rank = 0;
    nh_ex *M = nh_alloc_array(n * n + 1, sizeof *M), *e = model->M ? NULL : factors(model);
    for (size_t i = 0; i < n * n; i++) {
        nh_ex sum = nh_int(d, 0);
        for (size_t r = 0; r < m && e; r++)
            for (size_t s = 0; s < m; s++) {
                nh_ex *R = e + m * m, left = R[r * n + i / n], right = R[s * n + i % n];
                sum = nh_add(d, sum, nh_mul(d, e[r * m + s], nh_mul(d, left, right)));
            }
        M[i] = nh_model_values(model, model->M ? model->M[i] : sum);
    }
    bool regular = nh_generic_rank(d, n, n, M, &rank) && rank == n;
    nh_free(e);
    nh_free(M);
    return regular;
}

/* R^T K R from the values of the tape of `factors`. */
static void multiply(const nh_model *model, const double *value, double *M)
{
    size_t m = model->m, n = model->n;
    const double *K = value, *R = value + m * m;
    double *KR = nh_alloc_array(m * n + 1, sizeof *KR);
    memset(KR, 0, m * n * sizeof *KR);
    memset(M, 0, n * n * sizeof *M);
    for (size_t r = 0; r < m; r++)
        for (size_t s = 0; s < m; s++)
            for (size_t i = 0; i < n && K[r * m + s] != 0; i++) KR[r * n + i] += K[r * m + s] * R[s * n + i];
    for (size_t i = 0; i < n; i++)
        for (size_t r = 0; r < m; r++)
            for (size_t j = 0; j < n && R[r * n + i] != 0; j++) M[i * n + j] += R[r * n + i] * KR[r * n + j];
    nh_free(KR);
}

/* M at every probe of the chart where it is finite: of the model, or R^T K R where the model has none yet. */
static masses masses_of(const nh_model *model)
{
    size_t n = model->n, total = model->M ? n * n : model->m * (model->m + n);
    masses a = {.n = n,
                .M = nh_alloc_array(model->chart->probes * n * n + 1, sizeof *a.M),
                .at = nh_alloc_array(model->chart->probes + 1, sizeof *a.at)};
    nh_ex *own = model->M ? NULL : factors(model);
    nh_tape *tape = nh_model_tape(model, total, model->M ? model->M : own);
    nh_tape_work *work = nh_tape_work_create(tape);
    double *value = nh_alloc_array(total + 1, sizeof *value);
    for (size_t p = 0; p < model->chart->probes; p++) {
        double *M = a.M + a.count * n * n;
        nh_tape_eval(tape, work, model->chart->probe + p * model->width, value);
        if (model->M) memcpy(M, value, n * n * sizeof *M);
        else multiply(model, value, M);
        if (nh_all_finite(n * n, M)) a.at[a.count++] = model->chart->probe + p * model->width;
    }
    nh_free(value);
    nh_free(own);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return a;
}

/* Orders directions by the first velocity in which they have a component. */
static int earlier(const void *a, const void *b, void *context)
{
    const double *x = a, *y = b;
    size_t n = *(size_t *)context, i = 0;
    while (i < n && (x[i] == 0) == (y[i] == 0)) i++;
    return i == n ? 0 : x[i] == 0 ? 1 : -1;
}

/* Replaces vectors (rows of `null`, count x n) by a basis of their span with few components: each has a component 1,
 * its largest, where the others have 0. */
static void shorten(size_t count, size_t n, double *null)
{
    static const double tie = 1 + 1e-9, nothing = 1e-9;
    for (size_t k = 0; k < count; k++) {
        double *row = null + k * n;
        size_t large = 0;
        for (size_t i = 0; i < n; i++)
            if (fabs(row[i]) > tie * fabs(row[large])) large = i;
        for (size_t i = 0, unit = large; i < n; i++)
            if (i != unit) row[i] /= row[unit];
        row[large] = 1;
        for (size_t j = 0; j < count; j++) {
            double part = null[j * n + large];
            for (size_t i = 0; i < n && j != k; i++) null[j * n + i] -= part * row[i];
        }
    }
    for (size_t i = 0; i < count * n; i++)
        if (fabs(null[i]) < nothing) null[i] = 0;
    qsort_r(null, count, n * sizeof *null, earlier, &n);
}

/* The rank of M at one probe, and the directions without inertia there (n - rank rows of n; where the rank is n, the
 * direction with the least inertia). */
static size_t rank_at(const masses *a, size_t probe, double *null)
{
    static const double least = 1e-11; /* part of the largest singular value */
    size_t n = a->n, rank = 0;
    double *M = nh_alloc_array(2 * n * n + n + 1, sizeof *M), *vt = M + n * n, *s = vt + n * n;
    memcpy(M, a->M + probe * n * n, n * n * sizeof *M);
    if (!nh_svd(n, n, M, s, NULL, vt)) s[0] = 0;
    while (rank < n && s[rank] > least * fmax(s[0], 1e-300)) rank++;
    size_t first = rank < n ? rank : n - 1;
    for (size_t k = first; k < n; k++)
        for (size_t i = 0; i < n; i++) null[(k - first) * n + i] = vt[k + i * n];
    shorten(n - first, n, null);
    nh_free(M);
    return rank;
}

/* "y'" or "x' : z' = 1 : -0.5" */
static void print_direction(const nh_model *model, const double *direction, nh_text *out)
{
    const char *between = "";
    size_t moving = 0;
    for (size_t i = 0; i < model->n; i++) {
        if (direction[i] == 0) continue;
        nh_text_addf(out, "%s%s", between, nh_name_of(model->dag, model->chart->w[i]));
        between = " : ";
        moving++;
    }
    between = " = ";
    for (size_t i = 0; i < model->n && moving > 1; i++) {
        if (direction[i] == 0) continue;
        nh_text_addf(out, "%s%.4g", between, direction[i]);
        between = " : ";
    }
}

/* " of y' and of x' : z' = 1 : 2, at x = 0.3": with a place only where the directions depend on it. */
static void print_directions(const nh_model *model, size_t count, const double *null, const double *place, nh_text *out)
{
    enum { most = 3 };
    nh_text_addf(out, "no inertia in the direction%s ", count > 1 ? "s" : "");
    for (size_t k = 0; k < count && k < most; k++) {
        nh_text_addf(out, "%s", k == 0 ? "" : k + 1 == count ? " and " : ", ");
        print_direction(model, null + k * model->n, out);
    }
    if (count > most) nh_text_addf(out, " and %zu more", count - most);
    for (size_t s = 0; s < model->m && place; s++)
        nh_text_addf(out, "%s%s = %.3g", s ? ", " : " (at ", model->system->coordinate[s].name, place[1 + s]);
    if (place) nh_text_addf(out, ")");
}

/* The probe with the largest rank, and whether the directions without inertia are the same at all probes with that
 * rank. */
static size_t typical(const masses *a, size_t *rank, double *null, bool *everywhere)
{
    static const double apart = 1e-6;
    size_t n = a->n, best = 0;
    double *other = nh_alloc_array(n * n + 1, sizeof *other);
    *rank = rank_at(a, 0, null);
    *everywhere = true;
    for (size_t p = 1; p < a->count; p++) {
        size_t here = rank_at(a, p, other), directions = here < n ? n - here : 1;
        if (here > *rank) {
            *rank = here;
            *everywhere = true;
            best = p;
            memcpy(null, other, directions * n * sizeof *null);
        }
        for (size_t i = 0; here == *rank && i < directions * n; i++) *everywhere &= fabs(other[i] - null[i]) <= apart;
    }
    nh_free(other);
    return best;
}

bool nh_model_singular(const nh_model *model, nh_error *error)
{
    const nh_deck_node *where = nh_deck_get(nh_deck_root(model->system->deck), "lagrangian");
    if (!refuse_first_order(model, error)) return false;
    masses a = masses_of(model);
    if (a.count == 0) {
        masses_clear(&a);
        nh_deck_fail(model->system->deck, where, 0, error,
                     "the mass matrix of the Lagrangian is not finite at any point of the sampling domain");
        return nh_error_hint(error, "is a denominator 0, or a radicand negative?  Or does `domain:` lie outside the "
                                    "region where the Lagrangian is defined?");
    }
    double *null = nh_alloc_array(model->n * model->n + 1, sizeof *null);
    size_t rank;
    bool everywhere;
    size_t best = typical(&a, &rank, null, &everywhere);
    nh_text which;
    nh_text_init(&which);
    print_directions(model, rank < model->n ? model->n - rank : 1, null, everywhere ? NULL : a.at[best], &which);
    nh_deck_fail(
        model->system->deck, where, 0, error,
        rank < model->n
            ? "the Lagrangian is singular on the constraint submanifold: its mass matrix has rank %zu of %zu; %.500s"
            : "the mass matrix of the Lagrangian has rank %zu of %zu but is singular in places of the sampling domain; "
              "%.500s",
        rank, model->n, nh_text_string(&which));
    nh_text_clear(&which);
    nh_free(null);
    masses_clear(&a);
    return nh_error_hint(
        error,
        rank < model->n
            ? "every independent velocity needs inertia; a coordinate without any should be eliminated by a constraint"
            : "keep `domain:` away from there");
}

/* Where M is singular at every probe: scaled to a unit diagonal, it has a singular value of the size of rounding.  Its
 * rank modulo primes then decides: small inertia is inertia. */
bool nh_model_regular(const nh_model *model, nh_error *error)
{
    static const double rounding = 1e-14; /* times n */
    size_t n = model->n, found = 0;
    masses a = masses_of(model);
    double *unit = nh_alloc_array(2 * n + 1, sizeof *unit), *s = unit + n;
    for (size_t p = 0; p < a.count; p++) {
        double *M = a.M + p * n * n;
        for (size_t i = 0; i < n; i++) unit[i] = M[i * (n + 1)] != 0 ? 1 / sqrt(fabs(M[i * (n + 1)])) : 1;
        for (size_t i = 0; i < n * n; i++) M[i] *= unit[i / n] * unit[i % n];
        found += n && nh_svd(n, n, M, s, NULL, NULL) && s[n - 1] <= rounding * (double)n * s[0];
    }
    bool regular = a.count < 2 || found < a.count;
    nh_free(unit);
    masses_clear(&a);
    return regular || regular_exactly(model) || nh_model_singular(model, error);
}
