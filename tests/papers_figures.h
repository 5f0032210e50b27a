/* papers_figures: the curves of the sleigh's figures, which the program draws from computed motions, against the motion in closed form.
 *
 * From phi = 0 with omega = k and v = 0 the equations (35) have the solution
 *
 *     omega = k/cosh t,  v = a k^2 tanh t,  phi = 2 k arctan(tanh(t/2)),  x' = v cos phi,  y' = v sin phi                                            (33) */
#ifndef NH_TESTS_PAPERS_FIGURES_H
#define NH_TESTS_PAPERS_FIGURES_H

typedef struct {
    double a, m, k;
} sleigh;

/* x' and y' */
static double path_rate(const sleigh *s, double t, bool along_y)
{
    double v = s->a * s->k * s->k * tanh(t), phi = 2 * s->k * atan(tanh(t / 2));
    return v * (along_y ? sin(phi) : cos(phi));
}

/* Its integral, by Simpson's rule. */
static double path_between(const sleigh *s, double from, double to, bool along_y)
{
    const double longest = 2e-4;
    if (from == to) return 0;
    int steps = 2 * (int)ceil(fabs(to - from) / longest);
    double w = (to - from) / steps, sum = 0;
    for (int i = 0; i <= steps; i++) sum += (i == 0 || i == steps ? 1 : i % 2 ? 4 : 2) * path_rate(s, from + i * w, along_y);
    return sum * w / 3;
}

/* The column of a CSV table; -1: there is none. */
static int column_of(const char *csv, const char *name)
{
    int column = 0;
    size_t n = strlen(name);
    for (const char *at = csv; *at && *at != '\n'; column++) {
        size_t length = strcspn(at, ",\n");
        if (length == n && !strncmp(at, name, n)) return column;
        at += length + (at[length] == ',');
    }
    return -1;
}

static double cell_of(const char *line, int column)
{
    for (; column > 0; column--) line = strchr(line, ',') + 1;
    return strtod(line, NULL);
}

/* Energies of the blade, and about the centre of mass. */
static double energy(const sleigh *s, const char *name, double t)
{
    double v = s->a * s->k * s->k * tanh(t), turn = s->a * s->k / cosh(t), k2 = s->k * s->k;
    double straight = !strcmp(name, "E_TC") || !strcmp(name, "E_T"), round = !strcmp(name, "E_TC") ? 1 : !strcmp(name, "E_RC") ? k2 - 1 : !strcmp(name, "E_T") ? 0 : k2;
    return s->m / 2 * (straight * v * v + round * turn * turn);
}

/* A column of the table over time, against the closed form: the largest distance, relative to its size. */
static double column_distance(const sleigh *s, const char *csv, const char *name)
{
    int column = column_of(csv, name);
    double worst = 0, size = 0, path = 0, before = 0;
    if (column < 0) stop("no column", name);
    for (const char *line = strchr(csv, '\n'); line && line[1]; line = strchr(line + 1, '\n')) {
        double t = strtod(line + 1, NULL), want;
        bool along_y = name[0] == 'y';
        if (name[0] == 'x' || along_y) want = path += path_between(s, before, t, along_y);
        else want = !strcmp(name, "phi") ? 2 * s->k * atan(tanh(t / 2)) : energy(s, name, t);
        worst = fmax(worst, fabs(cell_of(line + 1, column) - want));
        size = fmax(size, fabs(want));
        before = t;
    }
    return size > 0 ? worst / size : INFINITY;
}

/* "3 x y phi": k and the columns. */
static double figure(const document *d, const char *part)
{
    sleigh s = {parameter_of(d, "a"), parameter_of(d, "m"), atof(part)};
    double worst = 0;
    for (const char *at = strchr(part, ' '); at; at = strchr(at + 1, ' ')) {
        char name[20] = "";
        sscanf(at, "%19s", name);
        worst = fmax(worst, column_distance(&s, d->text, name));
    }
    return worst;
}

#endif
