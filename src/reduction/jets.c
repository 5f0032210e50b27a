/* All local symmetries from jets at one point (jets.h; docs/method.md (20), (21)).
 *
 *      q0 --------- ray 1 --------> q1         jets (xi, B), (L_xi K)(q0) = 0: m (m + 1)/2 columns of m + m^2 numbers
 *       \                        /
 *        \--- ray 2 --> q2 --- triangle        at each end: rows (L_xi K), xi(V), L_xi omega on D, .. of every column
 *         \                                    around a triangle: the jet must come back as it was
 *          ...
 *
 *      null vectors of all rows = local symmetries: as many as are counted modulo a prime (symmetry_count.h) where that
 *      is possible, else as there are small singular values; brackets from the jets at q0
 *
 * After the first ray only the jets that may still be symmetries go on. */
#include "reduction/jets.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/progress.h"
#include "reduction/jet_conditions.h"
#include "reduction/subspace.h"

enum { rays = 5, most_rays = 40, triangles = 2, halvings = 8 };

/* The jets at q0 with L_xi K = 0: B = K^-1 (A - 1/2 xi^l d_l K), A antisymmetric. */
static void first_jets(nh_jet_conditions *s, double *jets)
{
    size_t m = s->m, size = s->t.size, column = 0;
    double *S = nh_alloc_array(m * m, sizeof *S);
    for (size_t l = 0; l < m; l++, column++) {
        jets[column * size + l] = 1;
        for (size_t i = 0; i < m * m; i++) S[i] = -0.5 * s->t.dK[i + m * m * l];
        nh_multiply(m, m, m, s->t.Kinv, S, jets + column * size + m);
    }
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < i; j++, column++) {
            memset(S, 0, m * m * sizeof *S);
            S[i + m * j] = 1;
            S[j + m * i] = -1;
            nh_multiply(m, m, m, s->t.Kinv, S, jets + column * size + m);
        }
    nh_free(S);
}

/* Towards a sample point, as far as the transport succeeds. */
static bool follow_ray(nh_jet_conditions *s, const double *q0, const double *target, const double *jets, double *end,
                       double *moved)
{
    double part = 1;
    size_t length = s->t.size * s->columns;
    for (int i = 0; i < halvings; i++, part /= 2) {
        for (size_t j = 0; j < s->m; j++) end[j] = q0[j] + part * (target[j] - q0[j]);
        memcpy(moved, jets, length * sizeof *moved);
        if (nh_transport_along(&s->t, q0, end, s->columns, moved, s->options->transport)) return true;
    }
    return false;
}

static void triangle_rows(nh_jet_conditions *s, const double *from, const double *to, const double *moved,
                          const double *direct)
{
    size_t size = s->t.size, length = size * s->columns;
    double *round = nh_alloc_array(length, sizeof *round);
    memcpy(round, moved, length * sizeof *round);
    if (nh_transport_along(&s->t, from, to, s->columns, round, s->options->transport))
        for (size_t i = 0; i < size; i++) {
            double *row = nh_jet_conditions_row(s, NH_OF_METRIC);
            for (size_t c = 0; c < s->columns; c++) row[c] = round[i + c * size] - direct[i + c * size];
        }
    nh_free(round);
}

/* [a,b]^i = a^j B_b^i_j - (a <-> b);  d_k [a,b]^i = B_a^j_k B_b^i_j + (derivative of B_b along a)^i_k - (a <-> b). */
static void find_algebra(nh_jet_conditions *s, const double *jet, nh_jets *out)
{
    size_t m = s->m, d = out->dimension, size = s->t.size;
    double *brackets = nh_alloc_array(size * d * d + 1, sizeof *brackets), *rate = nh_alloc_array(size, sizeof *rate);
    out->algebra = nh_algebra_create(d);
    for (size_t a = 0; a < d && !nh_interrupted(); a++) {
        const double *A = jet + a * size;
        nh_transport_at(&s->t, out->place, A);
        for (size_t b = 0; b < d; b++) {
            const double *B = jet + b * size;
            nh_transport_rate(&s->t, A, B, rate);
            for (size_t i = 0; i < size; i++) { /* + at (a,b), - at (b,a) */
                double term = rate[i];
                for (size_t j = 0; j < m && i >= m; j++)
                    term += B[m + (i - m) % m + m * j] * A[m + j + m * ((i - m) / m)];
                brackets[i + (a * d + b) * size] += term;
                brackets[i + (b * d + a) * size] -= term;
            }
        }
    }
    out->closure = nh_coordinates(size, d, jet, d * d, brackets, out->algebra.c);
    /* the jets have size one: this threshold is absolute too */
    bool abelian = nh_largest(d * d * d, out->algebra.c) <= s->options->group;
    for (size_t i = 0; i < d * d * d; i++) out->algebra.c[i] = abelian ? 0 : -out->algebra.c[i];
    nh_free(brackets);
    nh_free(rate);
}

/* Combinations of the columns, in true coordinates: xi^i s_i, B^i_j s_i / s_j. */
static void combine(const nh_jet_conditions *s, const double *jets, const double *basis, size_t d, double *out)
{
    size_t m = s->m, size = s->t.size;
    nh_multiply(size, d, s->columns, jets, basis, out);
    for (size_t c = 0; c < d; c++)
        for (size_t i = 0; i < m; i++) {
            out[c * size + i] *= s->t.scale[i];
            for (size_t j = 0; j < m; j++) out[c * size + m + i + m * j] *= s->t.scale[i] / s->t.scale[j];
        }
}

/* The ranks of the rows kind by kind, the null vectors, and the algebra. */
static void conclude(nh_jet_conditions *s, const double *jets, const double *moved, nh_jets *out)
{
    size_t n = s->columns, size = s->t.size, length = size * n;
    double *basis = nh_alloc_array(n * n + 1, sizeof *basis), *sv = nh_alloc_array(n + 1, sizeof *sv);
    nh_symmetry_count known = nh_symmetry_count_of(s->kinetic);
    out->exact = !known.obstacle && known.dimension <= n;
    if (!out->exact) {
        known.of_metric = nh_jet_conditions_kernel(s, false, false, SIZE_MAX, basis, NULL, NULL);
        known.of_potential = nh_jet_conditions_kernel(s, true, false, SIZE_MAX, basis, NULL, NULL);
        known.of_constraints = nh_jet_conditions_kernel(s, false, true, SIZE_MAX, basis, NULL, NULL);
    }
    out->of_metric = known.of_metric;
    out->of_potential = known.of_potential;
    out->of_constraints = known.of_constraints;
    size_t d = out->dimension = nh_jet_conditions_kernel(s, true, true, out->exact ? known.dimension : SIZE_MAX, basis,
                                                         &out->last_null, &out->first_other);
    double *scaled = nh_alloc_array(size * d + 1, sizeof *scaled), *xi = nh_alloc_array(s->m * d + 1, sizeof *xi);
    nh_multiply(size, d, n, jets, basis, scaled);
    find_algebra(s, scaled, out);
    for (size_t c = 0; c < d; c++) memcpy(xi + c * s->m, scaled + c * size, s->m * sizeof *xi);
    nh_singular_values(s->m, d, xi, sv);
    while (out->orbit < d && !out->exact && sv[out->orbit] > s->options->group) out->orbit++;
    if (out->exact) out->orbit = known.orbit;
    out->jet = nh_alloc_array(size * d + 1, sizeof *out->jet);
    out->moved = nh_alloc_array(out->places * size * d + 1, sizeof *out->moved);
    combine(s, jets, basis, d, out->jet);
    for (size_t p = 0; p < out->places; p++) combine(s, moved + p * length, basis, d, out->moved + p * size * d);
    nh_free(basis);
    nh_free(sv);
    nh_free(scaled);
    nh_free(xi);
}

/* After the first ray only those jets are kept that leave the metric invariant there, too (with a generous threshold:
 * unnecessary ones are removed later).  Jets, their images at the end of that ray and the rows so far are expressed in
 * terms of them. */
static void thin_out(nh_jet_conditions *s, double *jets, double *moved)
{
    size_t n = s->columns, size = s->t.size;
    double *basis = nh_alloc_array(n * n + 1, sizeof *basis), *out = nh_alloc_array(size * n + 1, sizeof *out);
    size_t kept = nh_jet_conditions_kernel_generous(s, basis);
    for (int which = 0; which < 2; which++) {
        nh_multiply(size, kept, n, which ? moved : jets, basis, out);
        memcpy(which ? moved : jets, out, size * kept * sizeof *out);
    }
    nh_jet_conditions_restrict(s, kept, basis);
    nh_free(basis);
    nh_free(out);
}

/* The number of rays that gives one and a half times as many rows as there are unknowns, of the potential and of the
 * constraints each. */
static size_t rays_wanted(const nh_jet_conditions *s)
{
    size_t of_V = s->rows[NH_OF_POTENTIAL], of_D = s->rows[NH_OF_CONSTRAINTS];
    size_t least = of_V && of_D ? (of_V < of_D ? of_V : of_D) : of_V + of_D;
    size_t wanted = least ? 2 + 3 * s->columns / least : rays; /* the rows so far are those of two places */
    return wanted < rays ? rays : wanted > most_rays ? most_rays : wanted;
}

/* Rays, triangles, and the conclusion. */
static void run(nh_jet_conditions *s, nh_jets *out)
{
    size_t m = s->m, length = s->t.size * s->columns, wanted = rays;
    if (nh_interrupted()) return; /* then the tapes of `s` are not complete */
    double *jets = nh_alloc_array(length * (1 + most_rays), sizeof *jets), *moved = jets + length;
    out->end = nh_alloc_array(most_rays * m, sizeof *out->end);
    nh_transport_at(&s->t, out->place, s->x);
    first_jets(s, jets);
    nh_jet_conditions_at(s, out->place, jets);
    for (size_t p = 1; p < s->kinetic->places && out->places < wanted && s->columns && !nh_interrupted(); p++) {
        double *end = out->end + out->places * m, *here = moved + out->places * length;
        if (follow_ray(s, out->place, s->kinetic->place + p * m, jets, end, here) && nh_jet_conditions_at(s, end, here))
            out->places++;
        if (out->places == 1 && length == s->t.size * m * (m + 1) / 2) {
            thin_out(s, jets, here);
            length = s->t.size * s->columns;
            wanted = rays_wanted(s);
        }
    }
    for (size_t p = 0; p + 1 < out->places && p < triangles && s->columns && !nh_interrupted(); p++)
        triangle_rows(s, out->end + p * m, out->end + (p + 1) * m, moved + p * length, moved + (p + 1) * length);
    if (out->places && !nh_interrupted()) conclude(s, jets, moved, out);
    nh_free(jets);
}

nh_jets *nh_jets_find(const nh_kinetic *k, const nh_options *options, nh_error *error)
{
    size_t m = k->m, unknowns = m * (m + 1) / 2;
    if ((double)unknowns > options->jets) {
        nh_fail(error, NH_LIMIT, "",
                "the symmetries of a kinetic energy in %zu coordinates were not computed: too many unknowns (%zu)", m,
                unknowns);
        return nh_error_hint(error,
                             "give the group by --group \"%s=1; ...\", or allow more unknowns by --option jets=%zu",
                             k->name[0], unknowns),
               NULL;
    }
    nh_jets *out = nh_alloc(sizeof *out);
    nh_jet_conditions s;
    *out = (nh_jets){.m = m, .place = nh_alloc_array(m, sizeof *out->place)};
    memcpy(out->place, k->place, m * sizeof *out->place);
    nh_jet_conditions_init(&s, k, options, out->place);
    run(&s, out);
    size_t left = s.t.steps;
    nh_jet_conditions_clear(&s);
    if (out->places && left > 0 && !nh_interrupted()) return out;
    nh_jets_free(out);
    if (nh_interrupted()) return nh_fail_ended(error, "during the search for symmetries of the kinetic energy"), NULL;
    if (!left) {
        nh_fail(error, NH_LIMIT, "", "the symmetries of the kinetic energy could not be transported within %g steps",
                options->transport_steps);
        return nh_error_hint(error,
                             "do masses or lengths differ by many orders of magnitude, or does the domain lie close "
                             "to a singularity of the coordinates?  Allow more steps by --option "
                             "transport_steps=%g, or give the group by --group",
                             10 * options->transport_steps),
               NULL;
    }
    nh_fail(error, NH_NUMERIC, "", "the symmetries of the metric could not be transported: no regular path was found");
    nh_error_hint(error, "give a domain without singularities of the coordinates");
    return NULL;
}

void nh_jets_free(nh_jets *j)
{
    if (!j) return;
    nh_free(j->place);
    nh_free(j->jet);
    nh_free(j->end);
    nh_free(j->moved);
    nh_algebra_clear(&j->algebra);
    nh_free(j);
}
