/* transport: 1-jets of isometries along straight lines (jets.h).
 *
 * Works in coordinates divided by the scales s_i = l K_ii(q0)^(-1/2), and with the metric divided by l^2, the square of
 * the length of the sampling box: in these the metric has size one, and so has the box. */
#ifndef NH_TRANSPORT_H
#define NH_TRANSPORT_H

#include "reduction/kinetic.h"

typedef struct {
    const nh_kinetic *kinetic;
    size_t steps;      /* number of steps that may still be made along lines */
    size_t m, h, size; /* h = m(m+1)/2; size = m + m^2: length of a jet */
    nh_tape *tape;     /* K, dK, ddK, packed */
    nh_tape_work *work;
    double *scale; /* m */
    double factor; /* of the metric: 1/l^2 */
    double *raw, *q;
    double *K, *dK;       /* m^2; dK[i + m*(j + m*k)] = d_k K_ij; scaled */
    double *Kinv, *Gamma; /* m^2; Gamma[i + m*(j + m*k)] */
    double *G, *dG;       /* along a direction X: Gamma^i_jk X^k (m^2); its derivative by q^l, dG[i + m*(j + m*l)] */
    double *first, *dfirst;
} nh_transport;

/* q0 fixes the scales. */
void nh_transport_init(nh_transport *transport, const nh_kinetic *kinetic, const double *q0);
void nh_transport_clear(nh_transport *transport);

/* Computes metric and Christoffel symbols at a place (true coordinates), and their derivatives along the direction x
 * (scaled); false when not finite. */
bool nh_transport_at(nh_transport *transport, const double *q, const double *x);
/* The derivative of a jet along the direction x that nh_transport_at was given. */
void nh_transport_rate(const nh_transport *transport, const double *x, const double *jet, double *rate);
/* Transports `count` jets (columns of y) from q0 to q1; false where this fails, as near a singularity of the metric. */
bool nh_transport_along(nh_transport *transport, const double *q0, const double *q1, size_t count, double *y,
                        double tolerance);

#endif
