/* families: the sleigh at given parameters, and ansatz families of every kind on it, for the tests of src/integrals. */
#ifndef NH_TESTS_FAMILIES_H
#define NH_TESTS_FAMILIES_H

#include "mechanics.h"
#include "integrals/echelon.h"

#define PHI2 "m*v*sin(phi/k) + m*a*k*omega*cos(phi/k)"
#define PHI2B "m*v*cos(phi/k) - m*a*k*omega*sin(phi/k)"

static inline mechanics sleigh(double m, double a, double k)
{
    nh_setting setting[] = {{.name = "m", .value = m}, {.name = "a", .value = a}, {.name = "k", .value = k}};
    return mechanics_of_file("systems/sleigh.yaml", NH_CHART_QUASI, 3, setting);
}

static inline nh_options defaults(void)
{
    nh_options o;
    nh_options_default(&o);
    return o;
}

static inline nh_ansatz *ansatz_of(const nh_model *o, const nh_points *points, size_t families, const nh_family *family)
{
    nh_error error = {0};
    nh_ansatz *a = nh_ansatz_create(o, points, families, family, 1500, &error);
    must(a != NULL, &error, "the ansatz");
    return a;
}

typedef struct {
    nh_ex in[3], angle, nu, term[3];
    nh_family velocities, wave, high, terms, product[3], family[6];
} families;

/* One family of every kind, and a product of three. */
static inline void families_of(const nh_model *o, families *f)
{
    f->in[0] = formula(o, "omega");
    f->in[1] = formula(o, "v");
    f->in[2] = formula(o, "x + 3");
    f->angle = formula(o, "phi");
    f->term[0] = formula(o, "t*sqrt(E)");
    f->term[1] = formula(o, "omega^2");
    f->term[2] = formula(o, "1");
    f->velocities = (nh_family){.kind = NH_POLYNOMIAL, .in_count = 3, .in = f->in, .degree = 3};
    f->wave = (nh_family){.kind = NH_FOURIER, .in_count = 1, .in = &f->angle, .degree = 2, .frequency = formula(o, "1/k"), .constant = true};
    f->high = (nh_family){.kind = NH_CHEBYSHEV, .in_count = 1, .in = &f->angle, .degree = 12};
    f->terms = (nh_family){.kind = NH_TERMS, .terms = 3, .term = f->term};
    f->product[0] = (nh_family){.kind = NH_POLYNOMIAL, .in_count = 2, .in = f->in, .degree = 1};
    f->product[1] = f->wave;
    f->product[2] = (nh_family){.kind = NH_CHEBYSHEV, .in_count = 1, .in = &f->in[2], .degree = 3};
    f->family[0] = f->velocities;
    f->family[1] = f->wave;
    f->family[2] = f->terms;
    f->family[3] = (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = 3, .part = f->product};
    f->family[4] = f->high;
}

#endif
