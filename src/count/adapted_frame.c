/* adapted_frame: weights by iterated brackets of power series at one point; then privileged coordinates, and the
 * fields in them. [docs/method.md, sec. 10, "Weights"]
 *
 *     grow        X_i (weight 1), [X_i, X_j] (2), [X_i, [X_j, X_k]] (3), ..  while directions at the point are new
 *
 *         q - q0 = to y:   columns of `to` are the directions       | weight 1 | 2 | 3 .. | across the leaf |
 *                                                                   |<------- kept ------>|
 *     correct     z_j = y_j + h_j(y) of weight 3 and more: Y^alpha(z_j)(0) = 0 for all alpha of weight below w_j
 *     bend        y_l = phi_l(z) across: X_i(phi_l) = X_i^l, solved weight by weight
 *     series      q and the fields as series in z, in a ring with these weights */
#include "count/adapted_frame.h"

#include <flint/nmod_mat.h>
#include <string.h>

#include "base/progress.h"

enum { largest_ring = 4000, highest_order = 7 };

/* ---- brackets ---- */

typedef struct {
    const nh_jet_ring *r;
    /* rank at which the search stops: the number of coordinates, or the rank that was found before */
    size_t all, wanted, count;
    size_t *weight;
    nh_residue *field; /* wanted x all series */
    nmod_mat_t rows;   /* their values at the point, in echelon form */
} frame_list;

/* [X, Y]^k = X^j d_j Y^k - Y^j d_j X^k */
static void bracket(const nh_jet_ring *r, size_t all, const nh_residue *X, const nh_residue *Y, nh_residue *out)
{
    nh_residue *slope = nh_alloc_array(r->size, sizeof *slope);
    memset(out, 0, all * r->size * sizeof *out);
    for (size_t k = 0; k < all; k++)
        for (size_t j = 0; j < all; j++) {
            nh_jet_derivative(r, Y + k * r->size, j, slope);
            nh_jet_add_product(r, out + k * r->size, X + j * r->size, slope);
            nh_jet_derivative(r, X + k * r->size, j, slope);
            nh_jet_sub_product(r, out + k * r->size, Y + j * r->size, slope);
        }
    nh_free(slope);
}

/* Is this direction new?  `rows` holds the independent directions so far, each with a pivot. */
static bool is_new(frame_list *l, const nh_residue *value)
{
    nh_prime f = l->r->field;
    nh_residue *v = nh_alloc_array(l->all + 1, sizeof *v);
    memcpy(v, value, l->all * sizeof *v);
    for (size_t i = 0; i < l->count; i++) {
        size_t p = 0;
        while (!nmod_mat_entry(l->rows, i, p)) p++;
        nh_residue factor = nh_residue_negative(f, v[p]);
        for (size_t j = 0; j < l->all && factor; j++)
            v[j] = nh_residue_add(f, v[j], nh_residue_mul(f, factor, (nh_residue)nmod_mat_entry(l->rows, i, j)));
    }
    size_t p = 0;
    while (p < l->all && !v[p]) p++;
    bool fresh = p < l->all;
    nh_residue inverse = fresh ? nh_residue_inverse(f, v[p]) : 0;
    for (size_t j = 0; j < l->all && fresh; j++)
        nmod_mat_entry(l->rows, l->count, j) = nh_residue_mul(f, v[j], inverse);
    nh_free(v);
    return fresh;
}

/* Keeps the field with this weight, if its value at the point is a new direction. */
static bool add_direction(frame_list *l, const nh_residue *X, size_t weight)
{
    nh_residue *at = nh_alloc_array(l->all + 1, sizeof *at);
    for (size_t k = 0; k < l->all; k++) at[k] = X[k * l->r->size];
    bool fresh = l->count < l->wanted && is_new(l, at);
    if (fresh) {
        memcpy(l->field + l->count * l->all * l->r->size, X, l->all * l->r->size * sizeof *X);
        l->weight[l->count++] = weight;
    }
    nh_free(at);
    return fresh;
}

/* The fields, their brackets with each other, with the new ones among these, .. until there are no new ones.  At a
 * generic point a bracket that depends on the others at the point depends on them around it, and its brackets give
 * nothing new.  False: the series are too short to see where this ends. */
static bool grow(frame_list *l, size_t fields, const nh_residue *X)
{
    size_t block = l->all * l->r->size, from = 0;
    for (size_t i = 0; i < fields; i++) add_direction(l, X + i * block, 1);
    nh_residue *both = nh_alloc_array(block + 1, sizeof *both);
    for (size_t weight = 2; from < l->count && l->count < l->wanted && weight <= l->r->order + 1; weight++) {
        size_t to = l->count;
        for (size_t i = 0; i < fields; i++)
            for (size_t j = from; j < to; j++) {
                bracket(l->r, l->all, X + i * block, l->field + j * block, both);
                add_direction(l, both, weight);
            }
        from = to;
    }
    nh_free(both);
    return from == l->count || l->count == l->wanted;
}

/* Room for `wanted` directions, each a field of `all` series. */
static void frame_list_init(frame_list *l, const nh_jet_ring *r, size_t all, size_t wanted)
{
    *l = (frame_list){.r = r, .all = all, .wanted = wanted};
    l->weight = nh_alloc_array(wanted + 1, sizeof *l->weight);
    l->field = nh_alloc_array(wanted * all * r->size + 1, sizeof *l->field);
    nmod_mat_init(l->rows, (slong)wanted + 1, (slong)all, r->field.p);
}

static void frame_list_clear(frame_list *l)
{
    nmod_mat_clear(l->rows);
    nh_free(l->field);
    nh_free(l->weight);
}

/* A ring with all weights 1, of the highest order that is not too large. */
static nh_jet_ring *plain_ring(nh_prime field, size_t variables, size_t order)
{
    size_t *one = nh_alloc_array(variables + 1, sizeof *one);
    for (size_t k = 0; k < variables; k++) one[k] = 1;
    while (order > 1 && nh_jet_ring_size(variables, one, order, largest_ring) == SIZE_MAX) order--;
    nh_jet_ring *r = nh_jet_ring_create(field, variables, one, order);
    nh_free(one);
    return r;
}

/* ---- the frame ---- */

/* The coordinates q0 + to y, for y the coordinates of the ring. */
static void linear_coordinates(const nh_adapted_frame *x, const nh_jet_ring *r, const nh_residue *y, nh_residue *out)
{
    for (size_t k = 0; k < x->all; k++) {
        nh_jet_constant(r, x->equations->at[k], out + k * r->size);
        for (size_t j = 0; j < x->all; j++)
            nh_jet_add_multiple(r, out + k * r->size, x->to[k * x->all + j], y + j * r->size);
    }
}

/* The series z_k. */
static void variable(const nh_jet_ring *r, size_t k, nh_residue *out)
{
    nh_jet_constant(r, 0, out);
    if (r->up[k * r->size] != UINT32_MAX) out[r->up[k * r->size]] = 1;
}

/* The components along y of a field given along q. */
static void along_frame(const nh_adapted_frame *x, const nh_jet_ring *r, const nh_residue *X, nh_residue *out)
{
    memset(out, 0, x->all * r->size * sizeof *out);
    for (size_t i = 0; i < x->all; i++)
        for (size_t k = 0; k < x->all; k++)
            nh_jet_add_multiple(r, out + i * r->size, x->from[i * x->all + k], X + k * r->size);
}

/* `to` from the directions at the point, and its inverse. */
static void set_matrices(nh_adapted_frame *x, const frame_list *l)
{
    nmod_mat_t to, from;
    nmod_mat_init(to, (slong)x->all, (slong)x->all, l->r->field.p);
    nmod_mat_init(from, (slong)x->all, (slong)x->all, l->r->field.p);
    for (size_t j = 0; j < x->all; j++)
        for (size_t k = 0; k < x->all; k++) nmod_mat_entry(to, k, j) = l->field[(j * x->all + k) * l->r->size];
    nmod_mat_inv(from, to);
    for (size_t i = 0; i < x->all * x->all; i++) {
        x->to[i] = (nh_residue)nmod_mat_entry(to, i / x->all, i % x->all);
        x->from[i] = (nh_residue)nmod_mat_entry(from, i / x->all, i % x->all);
    }
    nmod_mat_clear(from);
    nmod_mat_clear(to);
}

/* ---- corrections ---- */

/* f := Y(f) = Y^j d_j f. */
static void along_field(const nh_jet_ring *r, size_t all, const nh_residue *Y, nh_residue *f)
{
    nh_residue *slope = nh_alloc_array(2 * r->size, sizeof *slope), *sum = slope + r->size;
    for (size_t j = 0; j < all; j++) {
        nh_jet_derivative(r, f, j, slope);
        nh_jet_add_product(r, sum, Y + j * r->size, slope);
    }
    memcpy(f, sum, r->size * sizeof *f);
    nh_free(slope);
}

/* (Y^alpha f)(0), Y_1 outermost */
static nh_residue iterated(const nh_jet_ring *r, size_t all, size_t kept, const nh_residue *Y, const uint8_t *alpha,
                           const nh_residue *f)
{
    nh_residue *g = nh_alloc_array(r->size, sizeof *g);
    memcpy(g, f, r->size * sizeof *g);
    for (size_t i = kept; i-- > 0;)
        for (size_t k = 0; k < alpha[i]; k++) along_field(r, all, Y + i * all * r->size, g);
    nh_residue value = g[0];
    nh_free(g);
    return value;
}

/* out := y^alpha over the kept coordinates. */
static void monomial(const nh_jet_ring *r, size_t kept, const uint8_t *alpha, const nh_residue *y, nh_residue *out)
{
    nh_residue *work = nh_alloc_array(r->size, sizeof *work);
    nh_jet_constant(r, 1, out);
    for (size_t i = 0; i < kept; i++)
        for (size_t k = 0; k < alpha[i]; k++) {
            nh_jet_mul(r, out, y + i * r->size, work);
            memcpy(out, work, r->size * sizeof *out);
        }
    nh_free(work);
}

/* h_j,alpha = - (Y^alpha (y_j + corrections of lower degree))(0)/alpha!  for |alpha| = degree and weight(alpha) <
   w_j */
static void correct_degree(nh_adapted_frame *x, const nh_jet_ring *r, const nh_residue *y, const nh_residue *Y,
                           size_t j, size_t degree, nh_residue *f)
{
    nh_prime p = r->field;
    uint8_t *alpha = nh_alloc(x->kept + 1);
    nh_residue *sum = nh_alloc_array(2 * r->size, sizeof *sum), *power = sum + r->size;
    for (bool more = !nh_late(); more;) {
        size_t total = 0, weight = 0;
        for (size_t i = 0; i < x->kept; i++) total += alpha[i], weight += alpha[i] * x->weight[i];
        nh_residue value = total == degree && weight < x->weight[j] ? iterated(r, x->all, x->kept, Y, alpha, f) : 0;
        for (size_t i = 0; i < x->kept && value; i++)
            for (size_t k = 2; k <= alpha[i]; k++)
                value = nh_residue_mul(p, value, nh_residue_inverse(p, (nh_residue)k));
        if (value) {
            uint8_t *own = nh_arena_alloc(x->arena, x->kept);
            memcpy(own, alpha, x->kept);
            nh_frame_correction *list = nh_arena_alloc(x->arena, (x->corrections + 1) * sizeof *list);
            if (x->corrections) memcpy(list, x->correction, x->corrections * sizeof *list);
            list[x->corrections++] = (nh_frame_correction){j, own, nh_residue_negative(p, value)};
            x->correction = list;
            monomial(r, x->kept, alpha, y, power);
            nh_jet_add_multiple(r, sum, nh_residue_negative(p, value), power);
        }
        size_t i = 0;
        while (i < x->kept && alpha[i] == degree) alpha[i++] = 0;
        more = i < x->kept;
        if (more) alpha[i]++;
    }
    nh_jet_add_multiple(r, f, 1, sum);
    nh_free(sum);
    nh_free(alpha);
}

/* Coordinates of weight 3 and more, degree after degree; those of lower weight need none. */
static bool correct(nh_adapted_frame *x, const nh_jet_ring *r)
{
    size_t block = x->all * r->size, fields = x->equations->fields;
    nh_residue *y = nh_alloc_array(2 * block + r->size + 1, sizeof *y), *q = y + block, *f = q + block,
               *X = nh_alloc_array(2 * fields * block + 1, sizeof *X), *Z = X + fields * block;
    for (size_t k = 0; k < x->all; k++) variable(r, k, y + k * r->size);
    linear_coordinates(x, r, y, q);
    bool good = nh_jet_equations_fields(x->equations, r, q, X);
    for (size_t i = 0; i < fields && good; i++) along_frame(x, r, X + i * block, Z + i * block);
    frame_list l;
    frame_list_init(&l, r, x->all, x->kept);
    if (good) grow(&l, fields, Z);
    for (size_t j = 0; j < x->kept && good; j++) {
        if (x->weight[j] < 3) continue;
        memcpy(f, y + j * r->size, r->size * sizeof *f);
        for (size_t degree = 2; degree < x->weight[j]; degree++) correct_degree(x, r, y, l.field, j, degree, f);
    }
    frame_list_clear(&l);
    nh_free(X);
    nh_free(y);
    return good;
}

/* ---- creation ---- */

/* Directions, weights and corrections by series up to this order: brackets of weight w are exact at the point up to
 * order + 1, and h_j,alpha, which takes at most w_j - 2 derivatives of what enters it, is when w_j is.  `settled`: all
 * directions are found, or series of this order show no more.  False: another point is needed. */
static bool grow_to(nh_adapted_frame *x, size_t order, bool corrected, bool *settled)
{
    nh_jet_equations *o = x->equations;
    size_t all = x->all, fields = o->fields;
    nh_jet_ring *r = plain_ring(o->point->field, all, order);
    nh_residue *q = nh_alloc_array(all * r->size + 1, sizeof *q),
               *X = nh_alloc_array(fields * all * r->size + 1, sizeof *X),
               *unit = nh_alloc_array(all * r->size + 1, sizeof *unit);
    for (size_t k = 0; k < all; k++) {
        variable(r, k, q + k * r->size);
        q[k * r->size] = o->at[k];
    }
    frame_list l;
    frame_list_init(&l, r, all, all);
    bool good = nh_jet_equations_fields(o, r, q, X);
    *settled = good && grow(&l, fields, X);
    if (good && !*settled && (order == highest_order || r->order < order)) {
        o->obstacle = "brackets of the fields that take too long series";
        good = false;
    }
    x->kept = l.count;
    x->step = l.count ? l.weight[l.count - 1] : 0;
    memcpy(x->weight, l.weight, l.count * sizeof *x->weight);
    for (size_t k = 0; k < all && good; k++) { /* directions across the leaves */
        memset(unit, 0, all * r->size * sizeof *unit);
        unit[k * r->size] = 1;
        add_direction(&l, unit, 0);
    }
    good = good && l.count == all;
    if (good && *settled) set_matrices(x, &l);
    if (good && *settled && x->step > 2 && corrected) good = correct(x, r);
    frame_list_clear(&l);
    nh_free(unit);
    nh_free(X);
    nh_free(q);
    nh_jet_ring_free(r);
    return good;
}

static nh_adapted_frame *create(nh_jet_equations *equations, bool corrected)
{
    nh_arena *arena = nh_arena_create();
    nh_adapted_frame *x = nh_arena_alloc(arena, sizeof *x);
    size_t all = equations->coordinates;
    *x = (nh_adapted_frame){.equations = equations, .arena = arena, .all = all};
    x->to = nh_arena_alloc(arena, (all * all + 1) * sizeof *x->to);
    x->from = nh_arena_alloc(arena, (all * all + 1) * sizeof *x->from);
    x->weight = nh_arena_alloc(arena, (all + 1) * sizeof *x->weight);
    bool settled = false, good = true;
    for (size_t order = 1; good && !settled; order = 2 * order + 1) good = grow_to(x, order, corrected, &settled);
    if (good) return x;
    nh_arena_free(arena);
    return NULL;
}

nh_adapted_frame *nh_adapted_frame_create(nh_jet_equations *equations) { return create(equations, true); }

bool nh_adapted_frame_across(nh_jet_equations *equations, size_t *across, nh_residue *covector)
{
    nh_adapted_frame *x = create(equations, false);
    if (!x) return false;
    *across = x->all - x->kept;
    memcpy(covector, x->from + x->kept * x->all, *across * x->all * sizeof *covector);
    nh_adapted_frame_free(x);
    return true;
}

void nh_adapted_frame_free(nh_adapted_frame *frame)
{
    if (frame) nh_arena_free(frame->arena);
}

/* ---- series ---- */

/* y_j = z_j - sum h_j,alpha y^alpha: only coordinates of lower weight occur on the right, and these come first. */
static void frame_coordinates(const nh_adapted_frame *x, const nh_jet_ring *r, nh_residue *y)
{
    nh_residue *power = nh_alloc_array(r->size, sizeof *power);
    memset(y, 0, x->all * r->size * sizeof *y);
    for (size_t j = 0; j < x->kept; j++) {
        variable(r, j, y + j * r->size);
        for (size_t i = 0; i < x->corrections; i++) {
            const nh_frame_correction *h = &x->correction[i];
            if (h->index != j) continue;
            monomial(r, x->kept, h->exponent, y, power);
            nh_jet_add_multiple(r, y + j * r->size, nh_residue_negative(r->field, h->coefficient), power);
        }
    }
    nh_free(power);
}

/* A field along y becomes one along z: Z^j = Y^j + sum d h_j/dy_i Y^i. */
static void along_corrected(const nh_adapted_frame *x, const nh_jet_ring *r, const nh_residue *y, const nh_residue *Y,
                            nh_residue *Z)
{
    nh_residue *power = nh_alloc_array(2 * r->size, sizeof *power), *product = power + r->size;
    uint8_t *less = nh_alloc(x->kept + 1);
    memcpy(Z, Y, x->kept * r->size * sizeof *Z);
    for (size_t i = 0; i < x->corrections; i++) {
        const nh_frame_correction *h = &x->correction[i];
        for (size_t k = 0; k < x->kept; k++) {
            if (!h->exponent[k]) continue;
            memcpy(less, h->exponent, x->kept);
            less[k]--;
            monomial(r, x->kept, less, y, power);
            nh_jet_mul(r, power, Y + k * r->size, product);
            nh_jet_add_multiple(r, Z + h->index * r->size, nh_residue_mul(r->field, h->coefficient, h->exponent[k]),
                                product);
        }
    }
    nh_free(less);
    nh_free(power);
}

/* ---- leaves ---- */

/* The parts of lowest order of the fields, as equations of weight k for a function of weight k + 1:  X^_i phi =
 * defect_i, with the columns `across` right-hand sides.  Its solution is unique: the fields and their brackets span
 * everything. */
static bool solve_leading(const nh_adapted_frame *x, const nh_jet_ring *r, const nh_residue *Z,
                          const nh_residue *defect, size_t k, nh_residue *phi)
{
    size_t across = x->all - x->kept, fields = x->equations->fields, e = r->size;
    size_t from = r->first[k], rows = r->first[k + 1] - from, first = r->first[k + 1],
           columns = r->first[k + 2] - first;
    nmod_mat_t M;
    nmod_mat_init(M, (slong)(fields * rows), (slong)(columns + across), r->field.p);
    for (size_t i = 0; i < fields; i++)
        for (size_t q = 0; q < rows; q++) {
            ulong *row = M->rows[i * rows + q];
            for (size_t j = 0; j < x->kept; j++)
                for (size_t z = r->pairs[from + q]; z < r->pairs[from + q + 1]; z++) {
                    nh_residue c = Z[(i * x->kept + j) * e + r->left[z]];
                    size_t u = r->up[j * e + r->right[z]];
                    if (!c || u == UINT32_MAX || r->degree[u] != k + 1) continue;
                    c = nh_residue_mul(r->field, c, r->exponent[u * r->variables + j]);
                    row[u - first] = nh_residue_add(r->field, (nh_residue)row[u - first], c);
                }
            for (size_t l = 0; l < across; l++) row[columns + l] = defect[(i * across + l) * e + from + q];
        }
    size_t rank = (size_t)nmod_mat_rref(M);
    bool good = rank == columns && (columns == 0 || nmod_mat_entry(M, rank - 1, columns - 1) == 1);
    for (size_t l = 0; l < across && good; l++)
        for (size_t u = 0; u < columns; u++) phi[l * e + first + u] = (nh_residue)nmod_mat_entry(M, u, columns + l);
    nmod_mat_clear(M);
    return good;
}

/* On a leaf the coordinates across are functions of those along it, y_l = phi_l(z), and the fields are tangent to it:
 * X_i(phi_l) = X_i^l.  Weight by weight: the terms of weight k + 1 of phi from the equations of weight k. */
static bool bend(const nh_adapted_frame *x, const nh_jet_ring *r, nh_residue *y, const nh_residue *q, size_t k,
                 bool *flat)
{
    size_t across = x->all - x->kept, fields = x->equations->fields, e = r->size, block = x->all * e,
           along = x->kept * e;
    nh_residue *phi = y + along, *X = nh_alloc_array(fields * block + 1, sizeof *X),
               *Y = nh_alloc_array(block + 1, sizeof *Y), *Z = nh_alloc_array(fields * along + 1, sizeof *Z);
    nh_residue *defect = nh_alloc_array(fields * across * e + 1, sizeof *defect),
               *slope = nh_alloc_array(e, sizeof *slope);
    bool good = nh_jet_equations_fields(x->equations, r, q, X);
    *flat = true;
    for (size_t i = 0; i < fields && good; i++) {
        along_frame(x, r, X + i * block, Y);
        along_corrected(x, r, y, Y, Z + i * along);
        for (size_t l = 0; l < across; l++) {
            nh_residue *d = defect + (i * across + l) * e;
            memcpy(d, Y + along + l * e, e * sizeof *d);
            for (size_t j = 0; j < x->kept; j++) {
                nh_jet_derivative(r, phi + l * e, j, slope);
                nh_jet_sub_product(r, d, Z + i * along + j * e, slope);
            }
            /* for the highest weight phi needs one more order */
            for (size_t c = 0; c < r->first[r->order]; c++) *flat = *flat && d[c] == 0;
        }
    }
    good = good && (*flat || solve_leading(x, r, Z, defect, k, phi));
    nh_free(slope);
    nh_free(defect);
    nh_free(Z);
    nh_free(Y);
    nh_free(X);
    return good;
}

bool nh_adapted_frame_series(const nh_adapted_frame *x, const nh_jet_ring *r, nh_residue *coordinate, nh_residue *field)
{
    size_t block = x->all * r->size, fields = x->equations->fields;
    nh_residue *y = nh_alloc_array(2 * block + 1, sizeof *y), *Y = y + block,
               *X = nh_alloc_array(fields * block + 1, sizeof *X);
    bool good = true, flat = x->kept == x->all;
    frame_coordinates(x, r, y);
    linear_coordinates(x, r, y, coordinate);
    for (size_t k = 0; k < r->order && good && !flat; k++) {
        good = bend(x, r, y, coordinate, k, &flat);
        linear_coordinates(x, r, y, coordinate);
    }
    good = good && nh_jet_equations_fields(x->equations, r, coordinate, X);
    for (size_t i = 0; i < fields && good; i++) {
        along_frame(x, r, X + i * block, Y);
        along_corrected(x, r, y, Y, field + i * x->kept * r->size);
    }
    nh_free(X);
    nh_free(y);
    return good;
}
