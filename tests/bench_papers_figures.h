/* bench_papers_figures: the curves of the sleigh's figures, which the program draws from computed motions, against the motion in closed form.
 *
 * From phi = 0 with omega = k and v = 0 the equations (35) have the solution
 *
 *     omega = k/cosh t,  v = a k^2 tanh t,  phi = 2 k arctan(tanh(t/2)),  x' = v cos phi,  y' = v sin phi                                            (33) */
#ifndef NH_TESTS_BENCH_PAPERS_FIGURES_H
#define NH_TESTS_BENCH_PAPERS_FIGURES_H

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
    int steps = 2 * (int)ceil(fabs(to - from) / longest);
    double w = (to - from) / steps, sum = 0;
    for (int i = 0; i <= steps; i++) sum += (i == 0 || i == steps ? 1 : i % 2 ? 4 : 2) * path_rate(s, from + i * w, along_y);
    return sum * w / 3;
}

/* A path that is sampled evenly from -5 to 5: the largest distance, relative to its size. */
static double path_distance(const sleigh *s, const cJSON *curve)
{
    const double last = 5;
    double worst = 0, size = 0;
    for (int along_y = 0; along_y < 2; along_y++) {
        const cJSON *at = cJSON_GetObjectItem(curve, along_y ? "y" : "x"), *point;
        int n = cJSON_GetArraySize(at), i = 0;
        double t = -last, want = path_between(s, 0, -last, along_y);
        cJSON_ArrayForEach(point, at) {
            worst = fmax(worst, fabs(point->valuedouble - want));
            size = fmax(size, fabs(want));
            double next = -last + 2 * last * ++i / (n - 1);
            want += path_between(s, t, next, along_y);
            t = next;
        }
    }
    return worst / size;
}

/* Of a plot over time: the energy that its name says. */
static double energy(const sleigh *s, const char *name, double t)
{
    double v = s->a * s->k * s->k * tanh(t), turn = s->a * s->k / cosh(t), k2 = s->k * s->k;
    double factor[] = {!strncmp(name, "E_TC,", 5) || !strncmp(name, "E_T,", 4) || !strncmp(name, "E,", 2),
                       !strncmp(name, "E_TC,", 5) ? 1 : !strncmp(name, "E_RC,", 5) ? k2 - 1 : !strncmp(name, "E_T,", 4) ? 0 : k2};
    return s->m / 2 * (factor[0] * v * v + factor[1] * turn * turn);
}

static double plot_distance(const sleigh *s, const cJSON *curve)
{
    const cJSON *x = cJSON_GetObjectItem(curve, "x"), *y = cJSON_GetObjectItem(curve, "y");
    const char *name = cJSON_GetObjectItem(curve, "name")->valuestring;
    double worst = 0, size = 0;
    for (const cJSON *t = x->child, *e = y->child; t && e; t = t->next, e = e->next) {
        double want = energy(s, name, t->valuedouble);
        worst = fmax(worst, fabs(e->valuedouble - want));
        size = fmax(size, fabs(want));
    }
    return worst / size;
}

static double figure(const document *d, int which)
{
    const cJSON *curve, *all = at(d->root, "figures");
    const cJSON *of = cJSON_GetArrayItem(all, which);
    double worst = 0;
    if (!of || !cJSON_GetArraySize(at(of, "curves"))) stop("no figure", "sleigh");
    cJSON_ArrayForEach(curve, at(of, "curves")) {
        sleigh s = {parameter_of(d, "a"), parameter_of(d, "m"), cJSON_GetObjectItem(curve, "value")->valuedouble};
        worst = fmax(worst, (which == 0 ? path_distance : plot_distance)(&s, curve));
    }
    return worst;
}

#endif
