/* For the files of the count. */
#ifndef NH_COUNT_INTERNAL_H
#define NH_COUNT_INTERNAL_H

#include "count/count.h"

/* One point, with everything that does not depend on degree and order. */
typedef struct {
    const nh_count_question *q;
    nh_jet_equations *equations;
    nh_adapted_frame *frame;
    /* degree; 0: not polynomial in the velocities, or depending on a time that is no coordinate */
    size_t known, *degree;
    size_t *index;          /* indices in the question's list */
    size_t *failed;         /* number of points at which it could not be evaluated */
    nh_ex *current, *slope; /* slope: d current/d w, n each */
    bool *named;            /* contains named functions; each represents any solution of its equation */
    nh_ex *rate;            /* Gamma of these: it must vanish for every such solution */
    bool unnamed;           /* currents with named functions are left out */
    /* the equations left coordinates out (turned_translations.h), and no integral of this degree is linear in them */
    bool unextended;
    double work, most; /* products of residues so far, and at most */
} nh_counter;

enum { NH_COUNT_POINTS = 200 }; /* number of points that are tried */

/* Opens the equations, and those known integrals that can be followed in them; an obstacle is in the equations.
 * `turned`: coordinates may be left out (turned_translations.h) of which no known integral is a function. */
void nh_counter_open(nh_counter *counter, const nh_model *model, const nh_count_question *question, bool turned);
void nh_counter_close(nh_counter *counter);

/* Moves to another point; false: it is singular. */
bool nh_count_regular_point(nh_counter *counter, size_t attempt);

/* Gamma as series at the point. */
typedef struct {
    nh_jet_ring *ring;
    nh_residue *coordinate, *field, *rate; /* adapted_frame.h, jet_equations.h */
    bool split;                            /* solutions are even or odd in the velocities */
} nh_count_series;

/* The caller frees it.  NULL: the series are too long, or the point is not `regular`. */
nh_count_series *nh_count_series_create(nh_counter *counter, size_t order, double most, bool *regular);
void nh_count_series_free(nh_count_series *series);
nh_graded_problem nh_count_problem(const nh_counter *counter, const nh_count_series *series, size_t degree,
                                   nh_parity parity);

/* Differentials at one point (z = 0, w) as rows: components along the coordinates, then along the velocities. */
typedef struct {
    size_t n, kept, rows, capacity;
    nh_residue *w, *row; /* n; rows x (kept + n) */
} nh_differentials;

/* The differentials of all solutions, and those of the known integrals, at the same random velocities. */
void nh_count_differentials(const nh_counter *counter, nh_differentials *all, nh_differentials *known);
void nh_count_differentials_clear(nh_differentials *all, nh_differentials *known);

/* The solutions of a problem, computed or remembered: N for each order is added to `total`; `injective_at`: SIZE_MAX
 * where the symbol never was; the solutions' differentials are added. *state comes from a lower order, or is NULL, and
 * goes on to the next.  False: beyond the limits. */
bool nh_count_solve(nh_counter *counter, const nh_graded_problem *problem, nh_graded_state **state, size_t *total,
                    size_t *injective_at, nh_differentials *differentials);
void nh_count_differentials_append(nh_differentials *differentials, const nh_differentials *more);
/* Room for more rows, all zero. */
nh_residue *nh_count_more_differentials(nh_differentials *differentials, size_t count);

/* Finds the degrees of the known integrals, and leaves out those without values.  False: another point is needed. */
bool nh_count_take_known(nh_counter *counter);

/* Products of the known integrals up to a degree, 1 first; empty when there are too many. */
typedef struct {
    size_t count;
    uint8_t *exponent;       /* count x known */
    size_t *before, *factor; /* each product is product number `before` times integral number `factor`; except for 1 */
    bool *is_factor;         /* of another product: it is `before` one */
} nh_count_monomials;

/* The products up to a degree. */
nh_count_monomials nh_count_monomials_list(const nh_counter *counter, size_t degree);
void nh_count_monomials_clear(nh_count_monomials *products);

/* The values v^e along a random curve z_k = v_k s^(weight_k), and series in s of the series along it. */
void nh_count_curve(const nh_jet_ring *ring, uint64_t *random, nh_residue *out);
void nh_count_along(const nh_jet_ring *ring, const nh_jet_ring *line, const nh_residue *curve, size_t count,
                    const nh_residue *series, nh_residue *out);

/* Random linear functionals of series: combinations of the coefficients along a curve, several functionals on each
 * curve. */
typedef struct {
    size_t count, lines, size, order; /* number of functionals; of curves; of coefficients */
    nh_residue *curve, *weight;       /* lines x size: v^e; count x (order + 1) */
} nh_count_lines;

nh_count_lines nh_count_lines_create(const nh_jet_ring *ring, size_t least);
void nh_count_lines_clear(nh_count_lines *lines);
/* Applies the functionals of one curve to a series along it: functional i goes to out[i stride]. */
void nh_count_line_values(const nh_count_lines *lines, size_t line, nh_prime field, const nh_residue *series,
                          nh_residue *out, size_t stride);
/* Applies all functionals to N series that lie side by side: into out[i stride + series]. */
void nh_count_lines_values(const nh_count_lines *lines, const nh_jet_ring *ring, size_t N, const nh_residue *series,
                           nh_residue *out, size_t stride);

/* Random linear functionals of polynomials in the velocities whose coefficients are series: each takes its own
 * velocities and a curve z_k = v_k s^(weight_k) and combines the coefficients of the series in s. */
typedef struct {
    size_t count, n, size, order;   /* number of coefficients of the series */
    nh_residue *w, *curve, *weight; /* count x n; count x size: v^e; count x (order + 1) */
} nh_count_functionals;

nh_count_functionals nh_count_functionals_create(const nh_jet_ring *ring, size_t n, size_t count, uint64_t seed);
void nh_count_functionals_clear(nh_count_functionals *functionals);

/* Values of the functionals on products (count x functionals), and on solutions, whose series may be longer (N x
 * functionals). */
bool nh_count_product_values(nh_counter *counter, const nh_jet_ring *ring, const nh_residue *coordinate,
                             const nh_count_monomials *products, const nh_count_functionals *functionals,
                             nh_residue *out);
void nh_count_solution_values(const nh_graded_count *count, const nh_jet_ring *ring,
                              const nh_count_functionals *functionals, nh_residue *out);

/* A subspace in echelon form, to which rows are added. */
typedef struct {
    size_t width, rows, capacity;
    nh_residue *row;
} nh_count_space;

/* Adds a vector; returns whether the subspace grows. */
bool nh_count_space_add(nh_count_space *rows, nh_prime field, const nh_residue *row);

/* The rank of the products up to a degree, at most `bound`, goes to row->known and row->lower.  False as above. */
bool nh_count_products(nh_counter *counter, const nh_jet_ring *ring, const nh_residue *coordinate, size_t degree,
                       size_t bound, nh_count_row *row);

/* Can a solution be linear in coordinates that were left out?  A limit of work says yes.  `state`: of both parities at
 * this order, or NULL.  False: another point is needed. */
bool nh_count_extended(nh_counter *counter, const nh_count_series *series, size_t degree, nh_graded_state *state[2],
                       bool *extended);

/* Whether solutions can be extended, as it was found before within the same limit of work; and keeps it.  The problem
 * has the rates of what was left out. */
bool nh_count_recall_extended(const nh_counter *counter, const nh_graded_problem *problem, bool *extended,
                              double *work);
void nh_count_remember_extended(nh_counter *counter, const nh_graded_problem *problem, bool extended, double work);

/* Adds the differentials of all solutions, or of the known integrals of any degree. */
void nh_count_solutions_differ(const nh_graded_count *count, nh_prime field, nh_differentials *d);
bool nh_count_known_differ(nh_counter *counter, const nh_jet_ring *ring, const nh_residue *coordinate,
                           nh_differentials *d);
size_t nh_count_rank(const nh_differentials *d, nh_prime field);

/* Rows of further degrees up to `last`, where the equations are linear and no sum of their frequencies vanishes;
 * otherwise none. */
void nh_count_linear(nh_counter *counter, size_t last, nh_count *out);

#endif
