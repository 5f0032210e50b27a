/* papers_stages: brackets and equations by stages, as the third paper prints them, with the algebra, the chain and the forms a_j, b_j
 * that a command prints, at random vectors: against [x,y] = C x y and mu'(xi) = <mu, [omega, xi]> of the same text. */
#ifndef NH_TESTS_PAPERS_STAGES_H
#define NH_TESTS_PAPERS_STAGES_H

enum { most_e = 10 };

typedef struct {
    size_t n, blocks, block_of[most_e];
    double C[most_e][most_e][most_e]; /* [e_a,e_b] = C_ab^c e_c: minus that of the fields */
    double a[most_e][most_e][most_e], b[most_e][most_e][most_e]; /* a_j(e_p,e_q), b_j(e_p,e_q), p in block j */
} chained;

/* c_1 e_1 + c_2 e_2 + .. of a line. */
static void read_vector(const document *d, const char *line, size_t n, double *out)
{
    for (size_t k = 0; k < n; k++) {
        char of[40];
        double value[points];
        snprintf(of, sizeof of, "e_%zu", k + 1);
        values(d, coefficient_in(right_of(line), of), value);
        out[k] = value[0];
    }
}

static size_t index_of(const char *text) { return (size_t)atoi(text) - 1; }

/* The chain of the last stage that has one. */
static chained read_chain(const document *d)
{
    chained g = {.n = 0};
    int stage = 0;
    for (size_t i = 0; i < d->lines; i++)
        if (in_section(&d->line[i], heading_of("chain"), 0)) stage = d->line[i].stage;
    const char *at = stage ? beginning_of(d, stage) : NULL;
    if (!at || !(at = strstr(at, "Chain of subgroups block 0"))) stop("no chain", d->flat);
    for (at += strlen("Chain of subgroups "); !strncmp(at, "block ", 6); at += strspn(at, "; ")) {
        size_t block = (size_t)atoi(at + 6);
        at += 7;
        while (!strncmp(at, " e_", 3)) {
            g.block_of[index_of(at + 3)] = block;
            g.n++;
            at += 3 + strspn(at + 3, "0123456789");
        }
        g.blocks = block + 1;
    }
    for (size_t i = 0; i < d->lines; i++) {
        const char *line = d->line[i].text;
        size_t p, q;
        int j;
        char form;
        double value[most_e];
        bool here = in_section(&d->line[i], heading_of("chain"), stage);
        if (here && sscanf(line, "%c_%d(e_%zu,e_%zu) = ", &form, &j, &p, &q) == 4 && (form == 'a' || form == 'b')) {
            read_vector(d, line, g.n, value);
            memcpy(form == 'a' ? g.a[p - 1][q - 1] : g.b[p - 1][q - 1], value, g.n * sizeof *value);
        }
        bool group = !strncmp(d->line[i].heading, "The group", 9) || !strncmp(d->line[i].heading, "Group given", 11);
        if (!group || sscanf(line, "[e_%zu,e_%zu] = ", &p, &q) != 2 || p > g.n || q > g.n) continue;
        read_vector(d, line, g.n, value);
        for (size_t k = 0; k < g.n; k++) g.C[p - 1][q - 1][k] = -value[k], g.C[q - 1][p - 1][k] = value[k];
    }
    return g;
}

static void direct_bracket(const chained *g, const double *x, const double *y, double *out)
{
    for (size_t k = 0; k < g->n; k++) {
        out[k] = 0;
        for (size_t p = 0; p < g->n; p++)
            for (size_t q = 0; q < g->n; q++) out[k] += x[p] * y[q] * g->C[p][q][k];
    }
}

/* What a formula leaves out, or has wrong. */
enum { AS_MEANT, BARS, NO_HORIZONTAL, ONLY_OWN };

/* (14): in block i  [x_i,y_i] + sum_j<i (-a_j(x_j,y_j) + b_j(x_j, sum_k>j y_k) - b_j(y_j, sum_k>j x_k)).
 * BARS: of block 1 the last form has y behind it, as for n = 3.  NO_HORIZONTAL: b_0(y_0, x_1) is missing in block 2, as in the horizontal
 * equation of two stages, x = A dx, y = eta. */
static void staged_bracket(const chained *g, const double *x, const double *y, int wrong, double *out)
{
    for (size_t k = 0; k < g->n; k++) {
        size_t i = g->block_of[k];
        out[k] = 0;
        for (size_t p = 0; p < g->n; p++)
            for (size_t q = 0; q < g->n; q++) {
                size_t j = g->block_of[p], l = g->block_of[q];
                bool behind = j < i && l > j, bars = wrong == BARS && i == 1, drop = wrong == NO_HORIZONTAL && i == 2 && j == 0 && l == 1;
                if (j == i && l == i) out[k] += x[p] * y[q] * g->C[p][q][k];
                if (j == l && j < i) out[k] -= x[p] * y[q] * g->a[p][q][k];
                if (behind) out[k] += x[p] * y[q] * g->b[p][q][k] - (drop ? 0 : y[p] * (bars ? y[q] : x[q]) * g->b[p][q][k]);
            }
    }
}

/* mu'(e_i) = <mu, [omega, e_i]>.  ONLY_OWN: for e_i in block j only <mu_j, [omega_j, e_i] + sum_l<j b_l(omega_l, e_i)>, as printed in (20), (21),
 * (26) and behind. */
static void staged_rates(const chained *g, const double *mu, const double *omega, int wrong, double *out)
{
    for (size_t e = 0; e < g->n; e++) {
        double one[most_e] = {0}, bracket[most_e];
        one[e] = 1;
        staged_bracket(g, omega, one, AS_MEANT, bracket);
        out[e] = 0;
        for (size_t k = 0; k < g->n; k++)
            if (wrong != ONLY_OWN || g->block_of[k] == g->block_of[e]) out[e] += mu[k] * bracket[k];
    }
}

static void direct_rates(const chained *g, const double *mu, const double *omega, double *out)
{
    for (size_t e = 0; e < g->n; e++) {
        double one[most_e] = {0}, bracket[most_e];
        one[e] = 1;
        direct_bracket(g, omega, one, bracket);
        out[e] = 0;
        for (size_t k = 0; k < g->n; k++) out[e] += mu[k] * bracket[k];
    }
}

static double distance(size_t n, const double *x, const double *y)
{
    double off = 0, size = 0;
    for (size_t i = 0; i < n; i++) off = fmax(off, fabs(x[i] - y[i])), size = fmax(size, fabs(y[i]));
    return size > 0 ? off / size : INFINITY; /* a comparison of zeros says nothing */
}

/* `part`: "bracket", "bars", "horizontal", "rates", "own": the largest differences over some random vectors. */
static void by_stages(const document *d, const char *part, double *printed, double *meant)
{
    chained g = read_chain(d);
    unsigned state = 5;
    bool rates = !strcmp(part, "rates") || !strcmp(part, "own");
    int wrong = !strcmp(part, "bars") ? BARS : !strcmp(part, "horizontal") ? NO_HORIZONTAL : !strcmp(part, "own") ? ONLY_OWN : AS_MEANT;
    *printed = *meant = 0;
    for (size_t trial = 0; trial < points; trial++) {
        double x[most_e], y[most_e], want[most_e], got[most_e], right[most_e];
        for (size_t i = 0; i < 2 * g.n; i++) {
            state = state * 1664525u + 1013904223u;
            *(i < g.n ? &x[i] : &y[i - g.n]) = (double)(state >> 8) / (1 << 23) - 1;
        }
        if (rates) direct_rates(&g, x, y, want), staged_rates(&g, x, y, wrong, got), staged_rates(&g, x, y, AS_MEANT, right);
        else direct_bracket(&g, x, y, want), staged_bracket(&g, x, y, wrong, got), staged_bracket(&g, x, y, AS_MEANT, right);
        *printed = fmax(*printed, distance(g.n, got, want));
        *meant = fmax(*meant, distance(g.n, right, want));
    }
    if (wrong == AS_MEANT) *meant = INFINITY;
}

/* The printed rates mu_a' of a stage, against <mu, [zeta, e_a]> with the printed momenta, for all a that have a rate: of a group that is the whole
 * configuration space. */
static double euler_poincare(const document *d, int stage)
{
    nh_dag *g = d->system->dag;
    char section[30], label[40];
    double C[most_e][most_e][most_e] = {{{0}}}, value[most_e], worst = 0;
    size_t n = 0, compared = 0;
    snprintf(section, sizeof section, "%d.stage", stage);
    for (bool more = true; more && n < most_e; n += more) {
        snprintf(label, sizeof label, "mu_%zu", n + 1);
        more = line_of(d, section, label) != NULL;
    }
    for (size_t i = 0; i < d->lines; i++) {
        size_t p, q;
        const char *line = d->line[i].text;
        if (strncmp(d->line[i].heading, "The group", 9) || sscanf(line, "[e_%zu,e_%zu] = ", &p, &q) != 2) continue;
        read_vector(d, line, n, value);
        for (size_t k = 0; k < n; k++) C[p - 1][q - 1][k] = -value[k], C[q - 1][p - 1][k] = value[k];
    }
    for (size_t e = 0; e < n; e++) {
        nh_ex sum = nh_int(g, 0), size = sum;
        for (size_t p = 0; p < n; p++)
            for (size_t k = 0; k < n; k++) {
                char zeta[40], mu[40];
                if (C[p][e][k] == 0) continue;
                snprintf(zeta, sizeof zeta, "zeta%zu", p + 1);
                snprintf(mu, sizeof mu, "mu_%zu", k + 1);
                nh_ex term = nh_mul(g, nh_mul(g, nh_int(g, (int64_t)C[p][e][k]), parsed(d, zeta)), parsed(d, shown(d, section, mu, "")));
                sum = nh_add(g, sum, term);
                if (size == nh_int(g, 0)) size = term;
            }
        snprintf(label, sizeof label, "mu_%zu'", e + 1);
        if (!line_of(d, section, label)) continue;
        nh_ex rate = parsed(d, shown(d, section, label, ""));
        double off = differ(d, nh_add(g, rate, size), nh_add(g, sum, size));
        worst = fmax(worst, off);
        compared++;
    }
    return compared == n && n ? worst : INFINITY;
}

#endif
