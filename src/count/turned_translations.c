/* Translations and what turns them: A_ij a_j' = xi_s da_i'/dq_s, from values modulo a prime; each equation is then
 * proved. */
#include "count/turned_translations.h"

#include <flint/nmod_mat.h>
#include <string.h>

#include "count/adapted_frame.h"
#include "exact/normal.h"
#include "graph/diff.h"

enum { points = 3, velocities = 2, samples = points * velocities, attempts = 40 };

/* A symmetry whose components are constants, along the coordinates that are no a: xi, and A. */
typedef struct {
    nh_ex *xi;           /* m */
    nh_residue *residue; /* m: the same modulo the prime of the samples */
    nh_ex *A;            /* m x m */
    nh_residue *turn;    /* m x m */
} turning;

typedef struct {
    nh_jet_equations *x;
    nh_arena *arena;
    nh_prime field;
    size_t m, equations; /* rho (m), M, A */
    /* samples x equations x (1 + m): values, and derivatives along the coordinates */
    nh_residue *jet;
    bool *translated; /* is q_i one of the a? */
    size_t count;
    turning *turning;
} algebra;

static nh_ex coordinate(const algebra *g, size_t s) { return g->x->coordinate[g->x->time + s]; }

static nh_ex equation(const algebra *g, size_t e)
{
    const nh_jet_equations *x = g->x;
    size_t n = x->n;
    return e < g->m ? x->rho[e] : e < g->m + n * n ? x->M[e - g->m] : x->A[e - g->m - n * n];
}

static const nh_residue *jet(const algebra *g, size_t sample, size_t e)
{
    return g->jet + (sample * g->equations + e) * (1 + g->m);
}

static bool vanishes(const nh_jet_equations *x, nh_ex e) { return nh_normal_is_zero(x->dag, e, 0) == NH_ZERO; }

/* Values and first derivatives at random points and velocities.  False: no points were found. */
static bool sample(algebra *g)
{
    nh_jet_equations *x = g->x;
    size_t *one = nh_alloc_array(x->coordinates + 1, sizeof *one), taken = 0;
    for (size_t k = 0; k < x->coordinates; k++) one[k] = 1;
    nh_residue *w = nh_alloc_array(x->n + 1, sizeof *w);
    uint64_t random = 161803;
    g->jet = nh_arena_alloc(g->arena, (samples * g->equations * (1 + g->m) + 1) * sizeof *g->jet);
    for (size_t a = 0; a < attempts && taken < points && !x->obstacle; a++) {
        nh_jet_equations_choose(x, nh_jet_point_prime(x->point, 0), 31 + a);
        g->field = x->point->field;
        nh_jet_ring *ring = nh_jet_ring_create(g->field, x->coordinates, one, 1);
        nh_residue *q = nh_alloc_array(x->coordinates * ring->size + 1, sizeof *q),
                   *value = nh_alloc_array(g->equations * ring->size + 1, sizeof *value);
        for (size_t k = 0; k < x->coordinates; k++) {
            q[k * ring->size] = x->at[k];
            q[k * ring->size + ring->up[k * ring->size]] = 1;
        }
        nh_jet_eval *v = nh_jet_equations_eval(x, ring, q);
        bool good = true;
        for (size_t b = 0; b < velocities && good; b++) {
            for (size_t i = 0; i < x->n; i++) w[i] = nh_residue_random(g->field, &random);
            nh_jet_equations_velocities(x, v, ring, w);
            good = nh_jet_eval_all(v, g->m, x->rho, value) &&
                   nh_jet_eval_all(v, x->n * x->n, x->M, value + g->m * ring->size) &&
                   nh_jet_eval_all(v, x->n, x->A, value + (g->m + x->n * x->n) * ring->size);
            nh_residue *to = g->jet + (taken * velocities + b) * g->equations * (1 + g->m);
            for (size_t e = 0; e < g->equations && good; e++, to += 1 + g->m) {
                to[0] = value[e * ring->size];
                for (size_t s = 0; s < g->m; s++)
                    to[1 + s] = value[e * ring->size + ring->up[(x->time + s) * ring->size]];
            }
        }
        taken += good;
        nh_jet_eval_free(v);
        nh_free(value);
        nh_free(q);
        nh_jet_ring_free(ring);
    }
    nh_free(w);
    nh_free(one);
    return taken == points && !x->obstacle;
}

/* The number that a residue stands for; false: it is no short fraction. */
static bool number(const algebra *g, nh_residue r, nh_ex *out)
{
    enum { longest = 100 };
    int64_t top, bottom;
    if (!nh_residue_fraction(g->field, r, longest, &top, &bottom)) return false;
    *out = nh_ratio(g->x->dag, top, bottom);
    return true;
}

static nh_ex along(const algebra *g, const turning *t, nh_ex e)
{
    nh_dag *d = g->x->dag;
    nh_ex sum = nh_int(d, 0);
    for (size_t s = 0; s < g->m; s++)
        if (t->residue[s]) sum = nh_add(d, sum, nh_mul(d, t->xi[s], nh_diff(d, e, coordinate(g, s))));
    return sum;
}

/* Does every equation but the rates of the a stay the same along it? */
static bool is_symmetry(const algebra *g, const turning *t)
{
    bool good = true;
    for (size_t e = 0; e < g->equations && good; e++)
        if (e >= g->m || !g->translated[e]) good = vanishes(g->x, along(g, t, equation(g, e)));
    return good;
}

/* The constant fields along which nothing changes but the rates of the a. */
static void find_turnings(algebra *g)
{
    size_t columns = 0, rows = 0, *place = nh_alloc_array(g->m + 1, sizeof *place);
    for (size_t s = 0; s < g->m; s++)
        if (!g->translated[s]) place[columns++] = s;
    nmod_mat_t slopes, fields;
    nmod_mat_init(slopes, (slong)(samples * g->equations), (slong)columns, g->field.p);
    nmod_mat_init(fields, (slong)columns, (slong)columns, g->field.p);
    for (size_t b = 0; b < samples; b++)
        for (size_t e = 0; e < g->equations; e++, rows++)
            for (size_t s = 0; s < columns && (e >= g->m || !g->translated[e]); s++)
                nmod_mat_entry(slopes, rows, s) = jet(g, b, e)[1 + place[s]];
    size_t found = (size_t)nmod_mat_nullspace(fields, slopes);
    g->turning = nh_arena_alloc(g->arena, (found + 1) * sizeof *g->turning);
    g->count = 0;
    for (size_t k = 0; k < found; k++) {
        turning t = {.xi = nh_arena_alloc(g->arena, (g->m + 1) * sizeof *t.xi),
                     .residue = nh_arena_alloc(g->arena, (g->m + 1) * sizeof *t.residue),
                     .A = nh_arena_alloc(g->arena, (g->m * g->m + 1) * sizeof *t.A),
                     .turn = nh_arena_alloc(g->arena, (g->m * g->m + 1) * sizeof *t.turn)};
        bool good = true;
        for (size_t s = 0; s < columns && good; s++) {
            t.residue[place[s]] = (nh_residue)nmod_mat_entry(fields, s, k);
            good = number(g, t.residue[place[s]], &t.xi[place[s]]);
        }
        if (good && is_symmetry(g, &t)) g->turning[g->count++] = t;
    }
    nmod_mat_clear(fields);
    nmod_mat_clear(slopes);
    nh_free(place);
}

/* xi_s da_i'/dq_s = A_ij a_j': the row of A.  False: it has none. */
static bool turns(const algebra *g, turning *t, size_t i)
{
    nh_dag *d = g->x->dag;
    nh_residue *row = t->turn + i * g->m;
    size_t columns = 0, *place = nh_alloc_array(g->m + 1, sizeof *place);
    memset(row, 0, g->m * sizeof *row);
    for (size_t j = 0; j < g->m; j++)
        if (g->translated[j]) place[columns++] = j;
    nmod_mat_t system;
    nmod_mat_init(system, samples, (slong)columns + 1, g->field.p);
    for (size_t b = 0; b < samples; b++) {
        nh_residue slope = 0;
        for (size_t s = 0; s < g->m; s++)
            slope = nh_residue_add(g->field, slope, nh_residue_mul(g->field, t->residue[s], jet(g, b, i)[1 + s]));
        for (size_t j = 0; j < columns; j++) nmod_mat_entry(system, b, j) = jet(g, b, place[j])[0];
        nmod_mat_entry(system, b, columns) = slope;
    }
    size_t rank = (size_t)nmod_mat_rref(system);
    bool good = true;
    for (size_t r = 0; r < rank && good; r++) {
        size_t p = 0;
        while (!nmod_mat_entry(system, r, p)) p++;
        good = p < columns;
        if (good) row[place[p]] = (nh_residue)nmod_mat_entry(system, r, columns);
    }
    nmod_mat_clear(system);
    nh_free(place);
    nh_ex rest = good ? along(g, t, equation(g, i)) : nh_int(d, 0);
    for (size_t j = 0; j < g->m && good; j++) {
        nh_ex factor;
        if (!row[j]) continue;
        good = number(g, row[j], &factor);
        if (good) rest = nh_sub(d, rest, nh_mul(d, factor, equation(g, j)));
    }
    return good && vanishes(g->x, rest);
}

/* Takes out of the a what is not turned into others of them, until nothing changes. */
static void close_algebra(algebra *g)
{
    for (bool changed = true; changed;) {
        changed = false;
        find_turnings(g);
        for (size_t i = 0; i < g->m; i++) {
            if (!g->translated[i]) continue;
            bool good = true, any = false;
            for (size_t k = 0; k < g->count && good; k++) {
                good = turns(g, &g->turning[k], i);
                for (size_t j = 0; j < g->m; j++) any |= g->turning[k].turn[i * g->m + j] != 0;
            }
            if (good && any) continue;
            g->translated[i] = false;
            changed = true;
        }
    }
}

/* ---- leaves ---- */

/* A of a random combination of the fields that are tangent to the leaf, on which the covectors `across` vanish. */
static void tangent_turn(const algebra *g, size_t across, const nh_residue *covector, size_t rows, const size_t *place,
                         nmod_mat_t A)
{
    size_t first = g->x->time, all = g->m + first;
    uint64_t random = 2718281;
    nmod_mat_t conditions, tangent;
    nmod_mat_init(conditions, (slong)across, (slong)g->count, g->field.p);
    nmod_mat_init(tangent, (slong)g->count, (slong)g->count, g->field.p);
    for (size_t l = 0; l < across; l++)
        for (size_t k = 0; k < g->count; k++)
            for (size_t s = 0; s < g->m; s++)
                nmod_mat_entry(conditions, l, k) =
                    nh_residue_add(g->field, (nh_residue)nmod_mat_entry(conditions, l, k),
                                   nh_residue_mul(g->field, covector[l * all + first + s], g->turning[k].residue[s]));
    slong free = nmod_mat_nullspace(tangent, conditions);
    for (slong f = 0; f < free; f++) {
        nh_residue weight = nh_residue_random(g->field, &random);
        for (size_t k = 0; k < g->count; k++) {
            nh_residue factor = nh_residue_mul(g->field, weight, (nh_residue)nmod_mat_entry(tangent, k, f));
            for (size_t i = 0; i < rows * rows; i++)
                nmod_mat_entry(A, i / rows, i % rows) = nh_residue_add(
                    g->field, (nh_residue)nmod_mat_entry(A, i / rows, i % rows),
                    nh_residue_mul(g->field, factor, g->turning[k].turn[place[i / rows] * g->m + place[i % rows]]));
        }
    }
    nmod_mat_clear(tangent);
    nmod_mat_clear(conditions);
}

/* Are the translations tangent to the leaf, and turned by something tangent with an invertible A? */
static bool is_solvable(const algebra *g, size_t across, const nh_residue *covector)
{
    size_t first = g->x->time, all = g->m + first, rows = 0, *place = nh_alloc_array(g->m + 1, sizeof *place);
    bool good = true;
    for (size_t i = 0; i < g->m; i++)
        if (g->translated[i]) place[rows++] = i;
    for (size_t l = 0; l < across && good; l++)
        for (size_t i = 0; i < rows; i++) good = good && covector[l * all + first + place[i]] == 0;
    nmod_mat_t A;
    nmod_mat_init(A, (slong)rows, (slong)rows, g->field.p);
    if (good) tangent_turn(g, across, covector, rows, place, A);
    good = good && rows > 0 && (size_t)nmod_mat_rank(A) == rows;
    nmod_mat_clear(A);
    nh_free(place);
    return good;
}

/* Where the brackets span everything one point shows it; a leaf is taken at two. */
static bool is_tangent(const algebra *g)
{
    enum { leaves = 2 };
    nh_jet_equations *x = g->x;
    nh_residue *covector = nh_alloc_array(x->coordinates * x->coordinates + 1, sizeof *covector);
    size_t seen = 0, across = 0;
    bool good = true;
    for (size_t a = 0; a < attempts && good && seen < leaves && !x->obstacle; a++) {
        nh_jet_equations_choose(x, g->field, 1 + a);
        if (!nh_adapted_frame_across(x, &across, covector)) continue;
        good = is_solvable(g, across, covector);
        seen += across ? 1 : leaves;
    }
    nh_free(covector);
    return good && seen >= leaves && !x->obstacle;
}

size_t nh_turned_translations(nh_jet_equations *x, nh_ex *out)
{
    algebra g = {.x = x, .m = x->m, .equations = x->m + x->n * x->n + x->n, .arena = nh_arena_create()};
    size_t count = 0;
    g.translated = nh_arena_alloc(g.arena, g.m + 1);
    for (size_t i = 0; i < g.m; i++) count += g.translated[i] = nh_jet_equations_is_cyclic(x, coordinate(&g, i));
    if (count && sample(&g)) {
        close_algebra(&g);
        count = 0;
        for (size_t i = 0; i < g.m; i++)
            if (g.translated[i]) out[count++] = coordinate(&g, i);
        if (count && !is_tangent(&g)) count = 0;
    } else {
        count = 0;
    }
    nh_arena_free(g.arena);
    return count;
}
