/* time_scale: a sampling box for systems that are much faster than the units they are written in (an electron in SI
 * units).
 *
 * By default velocities are drawn from [-1.5, 1.5] and t from [0, 1].  Where the forces at rest turn the motion around
 * in much less than that, all that samples would see are the forces.  With L_s the half width of a coordinate's
 * interval and
 *
 *     Omega = max(max_i sqrt(median |a^i| / L_i), median (|da| / |v|))
 *
 * over the probes of the chart, a^i at rest, da what small velocities v add to that (gyroscopic forces, friction), both
 * in units of L_i,
 *
 * velocities are then drawn from 1.5 L_s Omega [-1, 1] and t from [0, 1/Omega]. */
#ifndef NH_TIME_SCALE_H
#define NH_TIME_SCALE_H

#include "geometry/model.h"

/* Adds intervals to the system for t and velocities that have none; returns Omega, or 1 when nothing had to be done.
 * What was made of the system before has the old box. */
double nh_time_scale_set(nh_system *system, const nh_model *model);

/* Adds intervals for velocities that have none, so many times as large as by default; false: all have one. */
bool nh_time_scale_velocities(nh_system *system, const nh_model *model, double factor);

#endif
