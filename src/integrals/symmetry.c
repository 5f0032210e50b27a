#include "integrals/symmetry.h"

#include <math.h>
#include <string.h>

#include "graph/diff.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"

enum { large_length = 3000, many_coordinates = 12 }; /* nh_complexity */

/* A long formula with rounded coefficients, a series, has no simpler form; for a very long one none could be found in
 * reasonable time. */
static nh_ex tidy(nh_dag *d, nh_ex e)
{
    return nh_complexity(d, e) > NH_SYMMETRY_LENGTHY && !nh_is_short(d, e) ? e : nh_simplify_short(d, e, large_length);
}

static nh_ex *take(nh_model *model, size_t n) { return nh_arena_alloc(model->arena, (n + 1) * sizeof(nh_ex)); }

nh_ex nh_symmetry_current(const nh_model *model, nh_ex Z0, const nh_ex *zeta)
{
    nh_ex phi = nh_mul(model->dag, model->Lbar, Z0);
    for (size_t i = 0; i < model->n; i++) phi = nh_add(model->dag, phi, nh_mul(model->dag, model->pbar[i], zeta[i]));
    return phi;
}

/* (N0), (NX)_j, (NY)_j of a field Z with current phi, 1 + 2n expressions that vanish iff Z is a constraint symmetry. */
static void equations_of(const nh_model *model, nh_ex phi, nh_ex Z0, const nh_ex *zeta, const nh_ex *W, nh_ex *out)
{
    nh_dag *d = model->dag;
    size_t n = model->n;
    out[0] = nh_model_X0(model, phi);
    for (size_t i = 0; i < n; i++) out[0] = nh_add(d, out[0], nh_mul(d, model->A[i], zeta[i]));
    for (size_t j = 0; j < n; j++) {
        nh_ex nx = nh_sub(d, nh_model_X(model, j, phi), nh_mul(d, model->A[j], Z0)), ny = nh_model_Y(model, j, phi);
        for (size_t i = 0; i < n; i++) {
            nx = nh_add(d, nx, nh_mul(d, nh_model_G(model)[i * n + j], zeta[i]));
            nx = nh_add(d, nx, nh_mul(d, model->M[i * n + j], W[i]));
            ny = nh_sub(d, ny, nh_mul(d, model->M[i * n + j], zeta[i]));
        }
        out[1 + j] = nx;
        out[1 + n + j] = ny;
    }
}

/* c or c*w_i with a simple number c, when z is that at most probes of the chart (near its singularities doubles lose
   their digits); else z. */
static nh_ex recognised(const nh_model *model, nh_ex z, size_t i)
{
    enum { tried = 5 };
    const nh_chart *c = model->chart;
    nh_tape *tape = nh_model_tape(model, 1, &z);
    nh_tape_work *work = nh_tape_work_create(tape);
    double *value = nh_alloc_array(c->probes + 1, sizeof *value);
    nh_ex found = z;
    for (size_t p = 0; p < c->probes; p++) nh_tape_eval(tape, work, c->probe + p * c->width, &value[p]);
    for (size_t first = 0; first < c->probes && first < tried && found == z; first++) {
        double number = round(12 * value[first]) / 12,
               factor = round(12 * value[first] / c->probe[first * c->width + 1 + model->m + i]) / 12;
        size_t constant = 0, linear = 0;
        for (size_t p = 0; p < c->probes; p++) {
            double w = c->probe[p * c->width + 1 + model->m + i];
            constant += fabs(value[p] - number) <= 1e-9;
            linear += fabs(value[p] - factor * w) <= 1e-9 * (1 + fabs(value[p]));
        }
        if (2 * constant > c->probes) found = nh_ratio(model->dag, (int64_t)round(12 * number), 12);
        else if (2 * linear > c->probes)
            found = nh_mul(model->dag, nh_ratio(model->dag, (int64_t)round(12 * factor), 12), c->w[i]);
    }
    nh_free(value);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return found;
}

/* x = M^-1 b (n).  Where that is long, and perhaps too long to be simplified, simple components are tried first, as the
 * fields of energies and momenta have them; M x = b proves them. */
static void solve(const nh_model *model, const nh_ex *b, nh_ex *x)
{
    enum { short_enough = 80 };
    nh_dag *d = model->dag;
    bool large = false, good = true;
    nh_ex *guess = nh_alloc_array(2 * model->n + 1, sizeof *guess), *right = guess + model->n;
    memcpy(right, b, model->n * sizeof *right);
    nh_lu_solve(model->M_lu, b, x);
    for (size_t i = 0; i < model->n; i++) large |= nh_complexity(d, x[i]) > short_enough;
    for (size_t i = 0; i < model->n && large && good; i++) {
        guess[i] = recognised(model, x[i], i);
        good = guess[i] != x[i] || nh_complexity(d, x[i]) <= short_enough;
    }
    for (size_t j = 0; j < model->n && large && good; j++) {
        nh_ex off = nh_neg(d, right[j]);
        for (size_t i = 0; i < model->n; i++) off = nh_add(d, off, nh_mul(d, model->M[j * model->n + i], guess[i]));
        good = nh_normal_is_zero(d, off, 0) == NH_ZERO;
    }
    if (large && good) memcpy(x, guess, model->n * sizeof *x);
    nh_free(guess);
}

nh_ex nh_symmetry_components(const nh_model *model, nh_ex phi, nh_ex *zeta)
{
    nh_dag *d = model->dag;
    nh_ex rest = phi;
    for (size_t i = 0; i < model->n; i++) zeta[i] = nh_model_Y(model, i, phi);
    solve(model, zeta, zeta);
    for (size_t i = 0; i < model->n; i++) {
        zeta[i] = tidy(d, zeta[i]);
        rest = nh_sub(d, rest, nh_mul(d, model->pbar[i], zeta[i]));
    }
    return tidy(d, nh_div(d, rest, model->Lbar));
}

/* Of many coordinates every component of Z has the long Z^0 = (Phi - pbar zeta)/Lbar as a factor of Gamma's: without it
 * they are short, and with it not worth the work. */
static bool is_of_many(const nh_model *model, const nh_symmetry *z)
{
    return model->m > many_coordinates && nh_kind_of(model->dag, z->Z0) != NH_NUMBER;
}

/* Z - Z^0 Gamma: R zeta and, by (NX) with M a = A, M (W - Z^0 a) = -G^T zeta - X(Phi). */
static void without_motion(nh_model *model, nh_symmetry *z)
{
    nh_dag *d = model->dag;
    size_t n = model->n;
    z->relative = (nh_field){nh_int(d, 0), take(model, model->m), take(model, n)};
    for (size_t s = 0; s < model->m; s++) {
        nh_ex e = nh_int(d, 0);
        for (size_t i = 0; i < n; i++) e = nh_add(d, e, nh_mul(d, model->R[s * n + i], z->zeta[i]));
        z->relative.space[s] = tidy(d, e);
    }
    for (size_t j = 0; j < n; j++) {
        nh_ex b = nh_neg(d, nh_model_X(model, j, z->phi));
        for (size_t i = 0; i < n; i++) b = nh_sub(d, b, nh_mul(d, nh_model_G(model)[i * n + j], z->zeta[i]));
        z->relative.velocity[j] = b;
    }
    solve(model, z->relative.velocity, z->relative.velocity);
    for (size_t i = 0; i < n; i++) z->relative.velocity[i] = tidy(d, z->relative.velocity[i]);
}

/* W = M^-1 (A Z^0 - X(Phi) - G zeta) and Z^s = rho^s Z^0 + R^s_i zeta^i. */
static void solve_directly(nh_model *model, nh_symmetry *z)
{
    nh_dag *d = model->dag;
    size_t n = model->n;
    for (size_t j = 0; j < n; j++) {
        nh_ex b = nh_sub(d, nh_mul(d, model->A[j], z->Z0), nh_model_X(model, j, z->phi));
        for (size_t i = 0; i < n; i++) b = nh_sub(d, b, nh_mul(d, nh_model_G(model)[i * n + j], z->zeta[i]));
        /* zero for an energy: this is decided before M^-1 makes it long */
        z->W[j] = nh_normal_is_zero(d, b, 0) == NH_ZERO ? nh_int(d, 0) : b;
    }
    solve(model, z->W, z->W);
    for (size_t i = 0; i < n; i++) z->W[i] = tidy(d, z->W[i]);
    for (size_t s = 0; s < model->m; s++) {
        nh_ex e = nh_mul(d, model->rho[s], z->Z0);
        for (size_t i = 0; i < n; i++) e = nh_add(d, e, nh_mul(d, model->R[s * n + i], z->zeta[i]));
        z->field.space[s] = tidy(d, e);
    }
}

/* Is rho_i a sum of R_ij w^j with R free of w, as it is written?  However long R is, this is seen at once. */
static bool is_written_linear(const nh_model *model, size_t i)
{
    nh_ex *zero = nh_alloc_array(model->n + 1, sizeof *zero);
    const nh_ex *w = model->chart->symbol + 1 + model->m;
    bool linear = true;
    for (size_t j = 0; j < model->n; j++) {
        zero[j] = nh_int(model->dag, 0);
        for (size_t k = 0; k < model->n && linear; k++)
            linear = !nh_depends(model->dag, model->R[i * model->n + j], w[k]);
    }
    linear = linear && nh_is_zero(model->dag, nh_substitute(model->dag, model->rho[i], model->n, w, zero));
    nh_free(zero);
    return linear;
}

bool nh_symmetry_is_energy(const nh_model *model, nh_ex phi)
{
    nh_dag *d = model->dag;
    const nh_system *system = model->system;
    bool holds = (phi == model->E || phi == nh_neg(d, model->E)) && !system->has_forces &&
                 !nh_depends(d, system->lagrangian, system->t);
    for (size_t i = 0; i < model->m && holds; i++) {
        if (is_written_linear(model, i)) continue;
        nh_ex rest = nh_neg(d, model->rho[i]);
        for (size_t j = 0; j < model->n; j++)
            rest =
                nh_add(d, rest, nh_mul(d, model->chart->symbol[1 + model->m + j], nh_model_Y(model, j, model->rho[i])));
        holds = nh_normal_is_zero(d, rest, 0) == NH_ZERO;
    }
    return holds;
}

/* d/dt of -E, or -d/dt of E, where nothing depends on time: Z^0 = 1 and zeta = -w, so that
 * Z^s = rho^s - w^i Y_i(rho^s) = 0. */
static bool is_translation(nh_model *model, nh_symmetry *z)
{
    nh_dag *d = model->dag;
    if (nh_complexity(d, model->E) <= NH_SYMMETRY_LENGTHY || !nh_symmetry_is_energy(model, z->phi)) return false;
    for (size_t s = 0; s < model->m; s++)
        if (nh_depends(d, model->rho[s], model->system->t)) return false;
    bool minus = z->phi != model->E;
    z->Z0 = nh_int(d, minus ? 1 : -1);
    for (size_t i = 0; i < model->n; i++) {
        nh_ex w = model->chart->symbol[1 + model->m + i];
        z->zeta[i] = minus ? nh_neg(d, w) : w;
        z->W[i] = nh_int(d, 0);
    }
    z->field = (nh_field){z->Z0, take(model, model->m), take(model, model->n)};
    for (size_t s = 0; s < model->m; s++) z->field.space[s] = z->coordinate_rate[s] = nh_int(d, 0);
    memcpy(z->field.velocity, z->W, model->n * sizeof *z->W);
    return true;
}

/* zeta, Z^0, W and the field's components in the chart. */
static void solve_components(nh_model *model, nh_symmetry *z)
{
    nh_dag *d = model->dag;
    if (is_translation(model, z)) return;
    z->Z0 = nh_symmetry_components(model, z->phi, z->zeta);
    z->field = (nh_field){z->Z0, take(model, model->m), take(model, model->n)};
    bool many = is_of_many(model, z);
    if (many) {
        without_motion(model, z);
        for (size_t i = 0; i < model->n; i++)
            z->W[i] = nh_add(d, z->relative.velocity[i], nh_mul(d, z->Z0, model->a[i]));
        for (size_t s = 0; s < model->m; s++)
            z->field.space[s] = nh_add(d, z->relative.space[s], nh_mul(d, z->Z0, model->rho[s]));
    } else {
        solve_directly(model, z);
    }
    memcpy(z->field.velocity, z->W, model->n * sizeof *z->W);
    for (size_t s = 0; s < model->m; s++) {
        nh_ex rate = nh_model_along(model, &z->field, model->rho[s]);
        z->coordinate_rate[s] = many ? rate : tidy(d, rate);
    }
}

static size_t total_complexity(const nh_model *model, const nh_field *f, const nh_ex *rate)
{
    size_t sum = nh_complexity(model->dag, f->time);
    for (size_t s = 0; s < model->m; s++)
        sum += nh_complexity(model->dag, f->space[s]) + nh_complexity(model->dag, rate[s]);
    for (size_t i = 0; i < model->n; i++) sum += nh_complexity(model->dag, f->velocity[i]);
    return sum;
}

/* Z^0 = (Phi - pbar zeta)/Lbar is a long quotient unless Phi is an energy, and every component contains it as a factor
 * of Gamma's.  Without Z^0 Gamma the field is often the familiar one, t d/dy + d/dy' of a boost. */
static void take_motion_away(nh_model *model, nh_symmetry *z)
{
    enum { short_enough = 120 };
    nh_dag *d = model->dag;
    size_t length = total_complexity(model, &z->field, z->coordinate_rate);
    if (nh_kind_of(d, z->Z0) == NH_NUMBER || length <= short_enough) return;
    if (!z->relative.space) without_motion(model, z);
    z->relative_rate = take(model, model->m);
    for (size_t s = 0; s < model->m; s++)
        z->relative_rate[s] = tidy(d, nh_model_along(model, &z->relative, model->rho[s]));
    z->along_motion =
        nh_complexity(d, z->Z0) + total_complexity(model, &z->relative, z->relative_rate) < 3 * length / 4;
}

/* The two parts of each component of [Gamma, Z]: the function whose derivative along Gamma is taken, and the one whose
 * derivative along Z is. */
static void bracket_halves(const nh_model *model, const nh_field *Z, nh_ex *first, nh_ex *second)
{
    size_t k = 0;
    first[k] = nh_model_gamma(model, Z->time);
    second[k++] = nh_int(model->dag, 0);
    for (size_t s = 0; s < model->m; s++, k++) {
        first[k] = nh_model_gamma(model, Z->space[s]);
        second[k] = nh_model_along(model, Z, model->rho[s]);
    }
    for (size_t i = 0; i < model->n; i++, k++) {
        first[k] = nh_model_gamma(model, Z->velocity[i]);
        second[k] = nh_model_along(model, Z, model->a[i]);
    }
}

/* From the parts for Z - c Gamma, with rate = Gamma(c): [Gamma, Z] = [Gamma, Z - c Gamma] + rate Gamma.  The components
 * are not simplified: they are evaluated, not printed.  With nu R = 0 the form needs no derivative of Z: i_[Gamma,Z]
 * phi^a = nu^a_s (Gamma(R^s_i) - X_i(rho^s)) zeta^i. */
static void bracket(nh_model *model, nh_symmetry *z, const nh_ex *first, const nh_ex *second, nh_ex rate)
{
    nh_dag *d = model->dag;
    z->bracket = (nh_field){nh_add(d, first[0], rate), take(model, model->m), take(model, model->n)};
    for (size_t s = 0; s < model->m; s++)
        z->bracket.space[s] = nh_add(d, nh_sub(d, first[1 + s], second[1 + s]), nh_mul(d, rate, model->rho[s]));
    for (size_t i = 0; i < model->n; i++)
        z->bracket.velocity[i] =
            nh_add(d, nh_sub(d, first[1 + model->m + i], second[1 + model->m + i]), nh_mul(d, rate, model->a[i]));
    for (size_t a = 0; a < model->k; a++) {
        nh_ex e = nh_int(d, 0);
        for (size_t s = 0; s < model->m; s++)
            for (size_t i = 0; i < model->n; i++) {
                nh_ex turn =
                    nh_sub(d, nh_model_gamma(model, model->R[s * model->n + i]), nh_model_X(model, i, model->rho[s]));
                e = nh_add(d, e, nh_mul(d, nh_mul(d, model->nu[a * model->m + s], turn), z->zeta[i]));
            }
        z->bracket_form[a] = tidy(d, e);
    }
}

/* ---- deciding the case at points ---- */

typedef struct {
    size_t width, forms;                            /* 1 + m + n; k */
    double *gamma, *z, *first, *second, *form, *nu; /* values at one point */
    double *b, *scale;                              /* [Gamma, Z], and what its components are made of */
    const double *unit;                             /* of (t, q, w): components without units compare */
    double pace; /* how fast the state moves there, in those of the chart's box per unit of time */
} local;

/* The size of the terms of the bracket, and of the rate with which Z changes: a smaller difference is rounding. */
static void measure(const nh_model *model, local *l)
{
    l->pace = 0;
    for (size_t j = 0; j < l->width; j++) {
        double reach = fmax(fabs(model->chart->low[j]), fabs(model->chart->high[j]));
        l->b[j] = l->first[j] - l->second[j];
        l->scale[j] = fabs(l->first[j]) + fabs(l->second[j]);
        if (j && reach > 0 && isfinite(reach)) l->pace = fmax(l->pace, fabs(l->gamma[j]) / reach);
    }
}

/* r = b - b^0 Gamma against z' = Z - Z^0 Gamma: 1 when r vanishes, 2 when parallel, 3 otherwise, 0 when not finite.
   Neither has a component along t. */
static int case_at(const local *l, double same)
{
    double r2 = 0, z2 = 0, rz = 0, scale = 0, zscale = 0;
    for (size_t j = 1; j < l->width; j++) {
        double r = (l->b[j] - l->b[0] * l->gamma[j]) / l->unit[j], z = (l->z[j] - l->z[0] * l->gamma[j]) / l->unit[j];
        r2 += r * r;
        z2 += z * z;
        rz += r * z;
        /* a bracket of the size of Z is not small */
        scale = fmax(scale, fmax(l->scale[j] + fabs(l->b[0] * l->gamma[j]), l->pace * fabs(l->z[j])) / l->unit[j]);
        zscale = fmax(zscale, (fabs(l->z[j]) + fabs(l->z[0] * l->gamma[j])) / l->unit[j]);
    }
    if (!isfinite(r2 + z2 + rz + scale)) return 0;
    if (sqrt(r2) <= same * scale) return 1;
    if (sqrt(z2) <= same * zscale) return 3;
    double across = sqrt(fmax(0, r2 - rz * rz / z2));
    return across <= sqrt(same) * 1e-3 * sqrt(r2) ? 2 : 3;
}

/* i_[Gamma,Z] phi^a = nu^a_s [Gamma,Z]^s relative to the terms of this sum. */
static bool is_inside(const nh_model *model, const local *l, double same)
{
    bool inside = true;
    for (size_t a = 0; a < l->forms; a++) {
        double scale = 0;
        for (size_t s = 0; s < model->m; s++)
            scale = fmax(scale, fabs(l->nu[a * model->m + s]) * fmax(l->scale[1 + s], l->pace * fabs(l->z[1 + s])));
        inside &= fabs(l->form[a]) <= same * 10 * scale;
    }
    return inside;
}

/* The case by Z, or by Z - Z^0 Gamma: it is the same. */
static void decide(nh_model *model, const nh_points *points, nh_symmetry *z, const nh_field *Z, const nh_ex *first,
                   const nh_ex *second, double same)
{
    size_t width = 1 + model->m + model->n, total = 4 * width + model->k + model->k * model->m, count = points->count;
    nh_ex *e = nh_alloc_array(total, sizeof *e);
    e[0] = nh_int(model->dag, 1);
    memcpy(e + 1, model->rho, model->m * sizeof *e);
    memcpy(e + 1 + model->m, model->a, model->n * sizeof *e);
    e[width] = Z->time;
    memcpy(e + width + 1, Z->space, model->m * sizeof *e);
    memcpy(e + width + 1 + model->m, Z->velocity, model->n * sizeof *e);
    memcpy(e + 2 * width, first, width * sizeof *e);
    memcpy(e + 3 * width, second, width * sizeof *e);
    memcpy(e + 4 * width, z->bracket_form, model->k * sizeof *e);
    memcpy(e + 4 * width + model->k, model->nu, model->k * model->m * sizeof *e);
    double *value = nh_alloc_array(total * count, sizeof *value), *at = nh_alloc_array(total + 3 * width, sizeof *at),
           *unit = at + total + 2 * width;
    nh_points_evaluate(points, model, total, e, value);
    for (size_t j = 0; j < width; j++) unit[j] = nh_chart_symbol_unit(model->system, model->chart->symbol[j]);
    local l = {.width = width,
               .forms = model->k,
               .gamma = at,
               .z = at + width,
               .first = at + 2 * width,
               .second = at + 3 * width,
               .form = at + 4 * width,
               .nu = at + 4 * width + model->k,
               .b = at + total,
               .scale = at + total + width,
               .unit = unit};
    int worst = 1;
    bool inside = true, decided = false;
    for (size_t p = 0; p < count; p++) {
        for (size_t j = 0; j < total; j++) at[j] = value[j * count + p];
        measure(model, &l);
        int kase = case_at(&l, same);
        if (kase == 0) continue;
        decided = true;
        if (kase > worst) worst = kase;
        inside &= is_inside(model, &l, same);
    }
    z->kase = decided ? worst : 0;
    /* Gamma and Z lie in the distribution; for a long formula the form is the less certain criterion */
    z->bracket_in_distribution = inside || z->kase == 1 || z->kase == 2;
    nh_free(at);
    nh_free(value);
    nh_free(e);
}

/* The largest residual of the constraint Noether equations, relative to the largest of their terms as they are written.
 * Where all terms vanish there is nothing to compare rounding with, and the normal form decides. */
double nh_symmetry_residual(const nh_model *model, const nh_points *points, nh_ex phi, nh_ex Z0, const nh_ex *zeta,
                            const nh_ex *W, double kind[3])
{
    static const double suspicious = 1e-9;
    nh_dag *d = model->dag;
    size_t n = 1 + 2 * model->n, all = n, count = points->count;
    nh_ex *e = nh_alloc_array(n + (model->m + 1) * (model->n + 1) + model->n, sizeof *e);
    equations_of(model, phi, Z0, zeta, W, e);
    for (size_t j = 0; j < model->n; j++) e[all++] = nh_model_Y(model, j, phi);
    e[all++] = nh_diff(d, phi, model->system->t);
    for (size_t s = 0; s < model->m; s++) { /* the terms of X_0(Phi) and X_j(Phi), which may cancel */
        nh_ex slope = nh_diff(d, phi, model->system->coordinate[s].q);
        e[all++] = nh_mul(d, model->rho[s], slope);
        for (size_t j = 0; j < model->n; j++) e[all++] = nh_mul(d, model->R[s * model->n + j], slope);
    }
    double *value = nh_alloc_array(all * count + n, sizeof *value), *off = value + all * count, worst = 0;
    nh_points_evaluate(points, model, all, e, value);
    for (size_t p = 0; p < count; p++) {
        double scale = 0;
        for (size_t i = n; i < all; i++) scale = fmax(scale, fabs(value[i * count + p]));
        for (size_t i = 0; i < n; i++) {
            double r = fabs(value[i * count + p]) / fmax(scale, 1e-300);
            if (isfinite(r)) off[i] = fmax(off[i], r);
        }
    }
    kind[0] = kind[1] = kind[2] = 0;
    for (size_t i = 0; i < n; i++) {
        double *own = &kind[i == 0 ? 0 : i <= model->n ? 1 : 2];
        if (off[i] > *own && (off[i] <= suspicious || nh_normal_is_zero(model->dag, e[i], 0) != NH_ZERO)) *own = off[i];
        worst = fmax(worst, *own);
    }
    nh_free(value);
    nh_free(e);
    return worst;
}

/* Is dc/dw = e exactly?  With rounded coefficients: relative to c at the points, with w in its unit. */
static bool vanishes(const nh_model *model, const nh_points *points, nh_ex e, nh_ex c, double unit, double same)
{
    if (nh_is_exact(model->dag, e)) return nh_normal_is_zero(model->dag, e, 0) == NH_ZERO;
    size_t count = points->count;
    double *value = nh_alloc_array(2 * count + 1, sizeof *value), worst = 0, size = 0;
    nh_points_evaluate(points, model, 2, (nh_ex[]){e, c}, value);
    for (size_t p = 0; p < count; p++) {
        worst = fmax(worst, isfinite(value[p]) ? fabs(value[p]) * unit : 0);
        size = fmax(size, isfinite(value[count + p]) ? fabs(value[count + p]) : 0);
    }
    nh_free(value);
    return worst <= same * size;
}

static bool is_projectable(const nh_model *model, const nh_points *points, const nh_symmetry *z, double same)
{
    for (size_t i = 0; i < model->n; i++) {
        double unit = nh_chart_symbol_unit(model->system, model->chart->w[i]);
        for (size_t s = 0; s <= model->m; s++) {
            nh_ex c = s < model->m ? z->field.space[s] : z->Z0;
            if (!vanishes(model, points, nh_model_Y(model, i, c), c, unit, same)) return false;
        }
    }
    return true;
}

bool nh_symmetry_of(nh_model *model, const nh_points *points, nh_ex phi, double same, nh_symmetry *z, nh_error *error)
{
    *z = (nh_symmetry){.phi = phi,
                       .zeta = take(model, model->n),
                       .W = take(model, model->n),
                       .coordinate_rate = take(model, model->m),
                       .bracket_form = take(model, model->k)};
    if (nh_normal_is_zero(model->dag, model->Lbar, 0) == NH_ZERO)
        return nh_fail(error, NH_NUMERIC, "",
                       "the constrained Lagrangian vanishes identically, so currents have no symmetry of Noether type");
    solve_components(model, z);
    take_motion_away(model, z);
    nh_ex *first = take(model, 1 + model->m + model->n), *second = take(model, 1 + model->m + model->n);
    bool many = is_of_many(model, z);
    const nh_field *Z = many ? &z->relative : &z->field;
    bracket_halves(model, Z, first, second);
    bracket(model, z, first, second, many ? nh_model_gamma(model, z->Z0) : nh_int(model->dag, 0));
    decide(model, points, z, Z, first, second, same);
    z->projectable = is_projectable(model, points, z, same);
    z->noether_residual = nh_symmetry_residual(model, points, phi, z->Z0, z->zeta, z->W, z->off);
    return true;
}
