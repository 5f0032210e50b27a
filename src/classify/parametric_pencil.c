/* The linear system Q Gamma(Phi) = 0 as a whole, with one parameter or two: rows are w^beta z^e, columns the
 * coefficients of z^u in c_alpha. */
#include <flint/nmod_poly.h>
#include <string.h>

#include "base/progress.h"
#include "classify/parametric.h"

/* Exponents of monomials in the velocities. */
typedef struct {
    size_t n, count, capacity;
    uint8_t *exponent;
} monomials;

/* The exponents of all monomials in n velocities up to the degree, of one parity or of both. */
static monomials list(size_t n, size_t degree, nh_parity parity)
{
    monomials m = {.n = n};
    uint8_t *e = nh_alloc(n + 1);
    for (bool more = true; more;) {
        size_t sum = 0;
        for (size_t i = 0; i < n; i++) sum += e[i];
        if (sum <= degree && (parity == NH_ALL_DEGREES || (sum % 2 == 1) == (parity == NH_ODD_DEGREES))) {
            nh_grow(&m.exponent, &m.capacity, (m.count + 1) * n + 1, sizeof *m.exponent);
            memcpy(m.exponent + m.count++ * n, e, n);
        }
        size_t i = 0;
        while (i < n && (sum >= degree || e[i] == degree)) sum -= e[i], e[i++] = 0;
        more = i < n;
        if (more) e[i]++;
    }
    nh_free(e);
    return m;
}

/* The index of alpha = beta - shift, or SIZE_MAX. */
static size_t find(const monomials *m, const uint8_t *beta, const int *shift)
{
    for (size_t a = 0; a < m->count; a++) {
        bool same = true;
        for (size_t i = 0; i < m->n && same; i++) same = (int)beta[i] == (int)m->exponent[a * m->n + i] + shift[i];
        if (same) return a;
    }
    return SIZE_MAX;
}

typedef struct {
    const nh_parametric_series *s;
    const nh_jet_ring *r;
    size_t n, fields;
    size_t degree[2];        /* degree of the coefficients in lambda, in mu */
    nh_residue *coefficient; /* in powers of lambda - origin, mu - origin */
    monomials alpha, beta;
    nh_parametric_variable variable[2];
    int low[2], high[2]; /* lowest and highest power that occur, after scaling */
    size_t poles;        /* degree of the scalar that everything is divided by; 0: there is none */
    nh_residue *scalar;  /* poles + 1: monic */
    size_t *slot, slots; /* per row of the system: the index of its auxiliary equations */
    nh_sparse_pencil *out;
} assembly;

/* A term of Gamma with all powers of the parameters: its series begin at `at` among the coefficients. */
typedef struct {
    bool derivative;
    size_t index, at;
    int shift[16];       /* the exponent that it adds to alpha */
    int low[2], high[2]; /* powers that occur in it; low > high: none */
} term;

static nh_residue *coefficient_at(const assembly *x, size_t i, size_t j)
{
    return x->coefficient + (j * (x->degree[0] + 1) + i) * x->s->length;
}

/* ---- the terms ---- */

static void powers(const assembly *x, term *t)
{
    for (int v = 0; v < 2; v++) t->low[v] = 1, t->high[v] = 0;
    for (int j = 0; j <= (int)x->degree[1]; j++)
        for (int i = 0; i <= (int)x->degree[0]; i++) {
            int power[2] = {i, j};
            if (nh_jet_is_zero(x->r, coefficient_at(x, (size_t)i, (size_t)j) + t->at)) continue;
            bool first = t->low[0] > t->high[0];
            for (int v = 0; v < 2; v++) {
                if (first || power[v] < t->low[v]) t->low[v] = power[v];
                if (first || power[v] > t->high[v]) t->high[v] = power[v];
            }
        }
}

/* w^i X_i^k d/dz_k,  X_0^k d/dz_k,  and the rates' monomials times d/dw^l */
static size_t list_terms(const assembly *x, term *out)
{
    size_t n = x->n, m = x->r->variables, count = nh_jet_equations_monomials(n), terms = 0;
    for (size_t i = 0; i < x->fields; i++)
        for (size_t k = 0; k < m; k++) {
            out[terms] = (term){.derivative = true, .index = k, .at = x->s->fields_at + (i * m + k) * x->r->size};
            if (i < n) out[terms].shift[i] = 1;
            terms++;
        }
    for (size_t l = 0; l < n; l++)
        for (size_t mu = 0, i = 0, j = 0; mu < count; mu++) {
            term *t = &out[terms++];
            *t = (term){.index = l, .at = x->s->rates_at + (l * count + mu) * x->r->size};
            t->shift[l]--;
            if (mu > 0 && mu <= n) t->shift[mu - 1]++;
            if (mu > n) {
                t->shift[i]++;
                t->shift[j]++;
                if (++j == n) j = ++i;
            }
        }
    for (size_t k = 0; k < terms; k++) powers(x, &out[k]);
    return terms;
}

/* ---- the variables ---- */

/* Rewrites coefficients in powers of lambda - origin, or of mu - origin, by Horner's scheme. */
static void move_origin(assembly *x, int v, nh_residue origin)
{
    size_t D = x->degree[v], others = x->degree[1 - v];
    for (size_t other = 0; other <= others && origin; other++)
        for (size_t i = 0; i < D; i++)
            for (size_t j = D; j-- > i;)
                nh_residue_add_multiple(x->r->field, x->s->length,
                                        v ? coefficient_at(x, other, j) : coefficient_at(x, j, other),
                                        v ? coefficient_at(x, other, j + 1) : coefficient_at(x, j + 1, other), origin);
}

static void take_coefficients(assembly *x)
{
    memcpy(x->coefficient, x->s->coefficient,
           (x->degree[0] + 1) * (x->degree[1] + 1) * x->s->length * sizeof *x->coefficient);
}

static int scaled_by(const assembly *x, const int *scale, const term *t)
{
    int sum = 0;
    for (size_t i = 0; i < x->n; i++) sum += scale[i] * t->shift[i];
    return sum;
}

typedef struct {
    int low, high;
    size_t constants[2]; /* terms that have the lowest power only, and the highest power only */
} spread;

static spread spread_of(const assembly *x, int v, size_t terms, const term *t, const int *scale)
{
    spread s = {.low = 1000, .high = -1000};
    for (size_t k = 0; k < terms; k++) {
        if (t[k].low[v] > t[k].high[v]) continue;
        int shift = scaled_by(x, scale, &t[k]);
        if (t[k].low[v] + shift < s.low) s.low = t[k].low[v] + shift;
        if (t[k].high[v] + shift > s.high) s.high = t[k].high[v] + shift;
    }
    for (size_t k = 0; k < terms; k++) {
        if (t[k].low[v] != t[k].high[v]) continue;
        int power = t[k].low[v] + scaled_by(x, scale, &t[k]);
        s.constants[0] += power == s.low;
        s.constants[1] += power == s.high;
    }
    return s;
}

/* Chooses scales -1, 0, 1 of the velocities, and the variable or its reciprocal: the least degree, then the most
 * constant terms. */
static void choose_scale(assembly *x, int v, nh_residue origin, size_t terms, const term *t, bool *any, size_t *best)
{
    size_t choices = 1;
    for (size_t i = 0; i < x->n && i < 6; i++) choices *= 3;
    for (size_t c = 0; c < choices; c++) {
        int scale[16] = {0};
        bool scaled = false;
        for (size_t i = 0, rest = c; i < x->n && i < 6; i++, rest /= 3)
            scale[i] = rest % 3 == 2 ? -1 : (int)(rest % 3), scaled |= scale[i] != 0;
        spread s = spread_of(x, v, terms, t, scale);
        for (int reciprocal = 0; reciprocal < 2; reciprocal++) {
            size_t degree = (size_t)(s.high - s.low), constants = s.constants[reciprocal];
            if (*any && (degree > best[0] || (degree == best[0] && constants <= best[1]))) continue;
            *any = true;
            best[0] = degree;
            best[1] = constants;
            x->variable[v] = (nh_parametric_variable){.origin = origin, .reciprocal = reciprocal, .scaled = scaled};
            memcpy(x->variable[v].scale, scale, sizeof scale);
            x->low[v] = s.low;
            x->high[v] = s.high;
        }
    }
}

/* -c_0/c_1 */
static nh_residue root_of(nh_prime f, const nmod_poly_t p)
{
    nh_residue bottom = (nh_residue)nmod_poly_get_coeff_ui(p, 1), top = (nh_residue)nmod_poly_get_coeff_ui(p, 0);
    return nh_residue_negative(f, nh_residue_mul(f, top, nh_residue_inverse(f, bottom)));
}

/* Chooses the origin.  Where Q vanishes the equations are singular anyway, so roots common to all coefficients of Q are
 * good origins; otherwise 0.  `scalar`: Q is that common factor times a function of the coordinates. */
static nh_residue singular_origin(assembly *x, int v, bool *scalar)
{
    nmod_poly_t common, e;
    slong highest = 0;
    nmod_poly_init(common, x->r->field.p);
    nmod_poly_init(e, x->r->field.p);
    for (size_t other = 0; other <= x->degree[1 - v]; other++)
        for (size_t z = 0; z < x->r->size && nmod_poly_degree(common) != 0; z++) {
            nmod_poly_zero(e);
            for (size_t j = 0; j <= x->degree[v]; j++)
                nmod_poly_set_coeff_ui(e, (slong)j, (v ? coefficient_at(x, other, j) : coefficient_at(x, j, other))[z]);
            nmod_poly_gcd(common, common, e);
            if (nmod_poly_degree(e) > highest) highest = nmod_poly_degree(e);
        }
    *scalar = highest > 0 && nmod_poly_degree(common) == highest && x->degree[1 - v] == 0;
    for (slong j = 0; *scalar && j <= highest; j++) x->scalar[j] = (nh_residue)nmod_poly_get_coeff_ui(common, j);
    if (*scalar) x->poles = (size_t)highest;
    nmod_poly_derivative(e, common);
    nmod_poly_gcd(e, common, e);
    if (nmod_poly_degree(common) > 0) nmod_poly_div(common, common, e);
    nh_residue origin = nmod_poly_degree(common) == 1 ? root_of(x->r->field, common) : 0;
    nmod_poly_clear(e);
    nmod_poly_clear(common);
    return origin;
}

/* Divides everything by the scalar: the quotient stands behind the remainder, whose powers are below the scalar's
 * degree. */
static void divide_by_scalar(assembly *x)
{
    size_t length = x->s->length, D = x->s->degree;
    take_coefficients(x);
    for (size_t j = D + 1; j-- > x->poles;)
        for (size_t k = 0; k < x->poles; k++)
            nh_residue_add_multiple(x->r->field, length, x->coefficient + (j - x->poles + k) * length,
                                    x->coefficient + j * length, nh_residue_negative(x->r->field, x->scalar[k]));
    x->variable[0] = (nh_parametric_variable){0};
    x->low[0] = 0;
    x->high[0] = (int)(D - x->poles);
}

/* Chooses the variables one after the other: the choice for one does not affect the other. */
static void choose_variable(assembly *x, int v, size_t terms, term *t)
{
    bool scalar;
    take_coefficients(x);
    nh_residue origin[2] = {0, singular_origin(x, v, &scalar)};
    bool any = false;
    size_t best[2] = {0, 0};
    for (int k = 0; k < 1 + (origin[1] != 0); k++) {
        take_coefficients(x);
        move_origin(x, v, origin[k]);
        for (size_t i = 0; i < terms; i++) powers(x, &t[i]);
        choose_scale(x, v, origin[k], terms, t, &any, best);
    }
    if (!scalar || best[0] < 2) x->poles = 0;
}

static void choose_variables(assembly *x, size_t terms, term *t)
{
    choose_variable(x, 0, terms, t);
    if (x->degree[1]) choose_variable(x, 1, terms, t);
    if (x->poles) divide_by_scalar(x);
    else {
        take_coefficients(x);
        for (int v = 0; v < 2; v++) move_origin(x, v, x->variable[v].origin);
    }
    for (size_t i = 0; i < terms; i++) powers(x, &t[i]);
}

void nh_parametric_back(const nh_parametric_variable *variable, int v, nh_prime f, nh_residue_polynomial *x)
{
    size_t root = variable->reciprocal || variable->scaled, D = x->degree[v], width = x->degree[0] + 1;
    size_t out_width = v ? width : width + root, stride = v ? out_width : 1, others = x->degree[1 - v];
    nh_residue *c = nh_alloc_array(out_width * (x->degree[1] + 1 + (v ? root : 0)), sizeof *c);
    for (size_t other = 0; other <= others; other++) {
        nh_residue *line = c + (v ? other : other * out_width);
        const nh_residue *from = x->coefficient + (v ? other : other * width);
        for (size_t k = 0; k <= D; k++)
            line[(k + root) * stride] = from[(variable->reciprocal ? D - k : k) * (v ? width : 1)];
        for (size_t i = 0; i < D + root && variable->origin; i++)
            for (size_t j = D + root; j-- > i;)
                line[j * stride] =
                    nh_residue_sub(f, line[j * stride], nh_residue_mul(f, variable->origin, line[(j + 1) * stride]));
    }
    nh_free(x->coefficient);
    x->coefficient = c;
    x->degree[v] += root;
    while (!x->degree[1] && x->degree[0] && !c[x->degree[0]]) x->degree[0]--; /* roots at infinity */
}

/* ---- the entries ---- */

static void put(assembly *x, size_t row, size_t column, size_t power, nh_residue value)
{
    nh_sparse_pencil *p = x->out;
    nh_grow(&p->entry, &p->capacity, p->entries + 1, sizeof *p->entry);
    p->entry[p->entries++] = (nh_sparse_entry){(uint32_t)row, (uint32_t)column, (uint32_t)power, value};
}

/* The auxiliary equations of a row, y = N(x)/scalar(x) with N of a lower degree, as the observer form of a linear
 * system:
 *
 *     x z_k = z_(k-1) - scalar_k z_(e-1) + N_k,     y = z_(e-1) */
static size_t auxiliary(assembly *x, size_t row, size_t power)
{
    if (x->slot[row] == SIZE_MAX) x->slot[row] = x->slots++;
    return x->beta.count * x->r->first[x->r->order] + x->slot[row] * x->poles + power;
}

static void close_auxiliary(assembly *x)
{
    nh_prime f = x->r->field;
    size_t rows = x->out->rows, columns = x->out->columns, e = x->poles;
    for (size_t i = 0; i < rows && e; i++) {
        if (x->slot[i] == SIZE_MAX) continue;
        size_t z = columns + x->slot[i] * e, at = rows + x->slot[i] * e;
        put(x, i, z + e - 1, 0, 1);
        for (size_t k = 0; k < e; k++) {
            put(x, at + k, z + k, 1, 1);
            if (k) put(x, at + k, z + k - 1, 0, nh_residue_negative(f, 1));
            put(x, at + k, z + e - 1, 0, x->scalar[k]);
        }
    }
    x->out->rows += x->slots * e;
    x->out->columns += x->slots * e;
    if (x->slots && !x->out->degree) x->out->degree = 1;
}

/* Adds the entries of `series` times x^power d/dz_index (derivative) or d/dw^index; `rest`: divided by the scalar. */
static void add_term(assembly *x, size_t power, bool rest, const term *t, const nh_residue *series)
{
    const nh_jet_ring *r = x->r;
    size_t rows = r->first[r->order];
    if (nh_jet_is_zero(r, series)) return;
    for (size_t b = 0; b < x->beta.count; b++) {
        size_t a = find(&x->alpha, x->beta.exponent + b * x->beta.n, t->shift);
        if (a == SIZE_MAX) continue;
        for (size_t e = 0; e < rows; e++)
            for (size_t z = r->pairs[e]; z < r->pairs[e + 1]; z++) {
                size_t u = t->derivative ? r->up[t->index * r->size + r->right[z]] : r->right[z];
                if (!series[r->left[z]] || u == UINT32_MAX) continue;
                size_t factor = t->derivative ? r->exponent[u * r->variables + t->index]
                                              : x->alpha.exponent[a * x->alpha.n + t->index];
                nh_residue v = nh_residue_mul(r->field, series[r->left[z]], (nh_residue)factor);
                if (!v) continue;
                if (rest)
                    put(x, auxiliary(x, b * rows + e, power), a * r->size + u, 0, nh_residue_negative(r->field, v));
                else put(x, b * rows + e, a * r->size + u, power, v);
            }
    }
}

/* The power of a variable that stands for this power of the parameter in the pencil. */
static size_t power_of(const assembly *x, int v, const term *t, int power)
{
    power += scaled_by(x, x->variable[v].scale, t);
    return (size_t)(x->variable[v].reciprocal ? x->high[v] - power : power - x->low[v]);
}

static void add_terms(assembly *x, size_t terms, const term *t)
{
    for (size_t k = 0; k < terms && !nh_late(); k++)
        for (int j = t[k].low[1]; j <= t[k].high[1]; j++)
            for (int i = t[k].low[0]; i <= t[k].high[0]; i++) {
                bool rest = i < (int)x->poles;
                size_t power = power_of(x, 0, &t[k], i - (rest ? 0 : (int)x->poles));
                if (x->degree[1]) power += power_of(x, 1, &t[k], j) * (x->out->degree + 1);
                add_term(x, power, rest, &t[k], coefficient_at(x, (size_t)i, (size_t)j) + t[k].at);
            }
}

bool nh_parametric_pencil(const nh_parametric *f, const nh_parametric_series *s, size_t degree, nh_parity parity,
                          size_t most, nh_sparse_pencil *out, nh_parametric_variable *variable)
{
    static const nh_parity other[] = {
        [NH_ALL_DEGREES] = NH_ALL_DEGREES, [NH_EVEN_DEGREES] = NH_ODD_DEGREES, [NH_ODD_DEGREES] = NH_EVEN_DEGREES};
    size_t n = f->counter.equations->n, fields = f->counter.equations->fields;
    if (n > 16) return false;
    assembly x = {.s = s,
                  .r = s->ring,
                  .n = n,
                  .fields = fields,
                  .degree = {s->degree, s->second},
                  .alpha = list(n, degree, parity),
                  .beta = list(n, degree + 1, other[parity]),
                  .out = out};
    x.coefficient = nh_alloc_array((s->degree + 1) * (s->second + 1) * s->length, sizeof *x.coefficient);
    x.scalar = nh_alloc_array((s->degree > s->second ? s->degree : s->second) + 1, sizeof *x.scalar);
    term *t = nh_alloc_array(fields * s->ring->variables + n * nh_jet_equations_monomials(n) + 1, sizeof *t);
    size_t terms = list_terms(&x, t);
    choose_variables(&x, terms, t);
    *out = (nh_sparse_pencil){.rows = x.beta.count * s->ring->first[s->ring->order],
                              .columns = x.alpha.count * s->ring->size,
                              .degree = (size_t)(x.high[0] - x.low[0]),
                              .second = (size_t)(x.high[1] - x.low[1])};
    bool good = out->columns * (out->degree ? out->degree : 1) <= most;
    x.slot = nh_alloc_array(out->rows + 1, sizeof *x.slot);
    for (size_t i = 0; i < out->rows; i++) x.slot[i] = SIZE_MAX;
    if (good) add_terms(&x, terms, t);
    if (good) close_auxiliary(&x);
    nh_free(x.slot);
    nh_free(x.scalar);
    memcpy(variable, x.variable, (s->second ? 2 : 1) * sizeof *variable);
    nh_free(t);
    nh_free(x.coefficient);
    nh_free(x.alpha.exponent);
    nh_free(x.beta.exponent);
    return good && !nh_late();
}
