/* Closed polygons around the singular points, and the continuation along them.  All vertices are exact numbers, so a
 * path ends exactly where it began; whatever it winds around, the matrix is one of the monodromy group. */
#include "absence/monodromy_internal.h"

#include "base/memory.h"

enum {
    direction_bits = 64, /* of lengths */
    corners = 16,        /* of the polygon around a point: sides of 0.39 radii */
    most_steps = 4096,   /* of a path */
    reach = 13,          /* a step is 13/32 of the distance to the nearest singular point */
    reach_of = 32
};

static void path_add(nh_monodromy_path *path, const acb_t z)
{
    size_t capacity = path->capacity;
    nh_grow(&path->vertex, &path->capacity, path->count + 1, sizeof *path->vertex);
    for (size_t k = capacity; k < path->capacity; k++) acb_init(path->vertex + k);
    acb_set(path->vertex + path->count++, z);
}

void nh_monodromy_path_clear(nh_monodromy_path *path)
{
    for (size_t k = 0; k < path->capacity; k++) acb_clear(path->vertex + k);
    nh_free(path->vertex);
    *path = (nh_monodromy_path){0};
}

/* A lower bound of the distance of z from the nearest singular point but `skip`; false: it may be 0, or there is
 * none. */
static bool nearest(arb_t distance, const nh_monodromy_sum *sum, const acb_t z, size_t skip)
{
    acb_t d;
    arb_t size;
    acb_init(d);
    arb_init(size);
    arb_pos_inf(distance);
    for (size_t i = 0; i < sum->points; i++) {
        if (i == skip) continue;
        acb_sub(d, z, sum->point + i, sum->bits);
        acb_abs(size, d, direction_bits);
        arb_min(distance, distance, size, direction_bits);
    }
    acb_clear(d);
    arb_clear(size);
    arb_get_lbound_arf(arb_midref(distance), distance, direction_bits);
    mag_zero(arb_radref(distance));
    return arb_is_positive(distance) && arb_is_finite(distance);
}

/* One vertex more, towards the end; false: a singular point may be met. */
static bool path_step(const nh_monodromy_sum *sum, nh_monodromy_path *path, const acb_t end, bool *arrived)
{
    acb_srcptr z = path->vertex + path->count - 1;
    acb_t h;
    arb_t step, length;
    acb_init(h);
    arb_init(step);
    arb_init(length);
    bool good = nearest(step, sum, z, sum->points);
    arb_mul_ui(step, step, reach, direction_bits);
    arb_div_ui(step, step, reach_of, direction_bits);
    acb_sub(h, end, z, ARF_PREC_EXACT);
    acb_abs(length, h, direction_bits);
    *arrived = arf_cmp(arb_midref(length), arb_midref(step)) <= 0;
    if (*arrived) {
        acb_set(h, end);
    } else {
        arb_div(step, step, length, direction_bits);
        acb_mul_arb(h, h, step, direction_bits);
        acb_add(h, h, z, sum->bits);
        acb_get_mid(h, h);
        good = good && !acb_equal(h, z);
    }
    if (good) path_add(path, h);
    acb_clear(h);
    arb_clear(step);
    arb_clear(length);
    return good;
}

static bool path_to(const nh_monodromy_sum *sum, nh_monodromy_path *path, const acb_t end)
{
    bool arrived = false;
    while (!arrived)
        if (path->count > most_steps || !path_step(sum, path, end, &arrived)) return false;
    return true;
}

void nh_monodromy_base(const nh_monodromy_sum *sum, acb_t base)
{
    acb_t offset;
    arb_t spread, size;
    acb_init(offset);
    arb_init(spread);
    arb_init(size);
    acb_zero(base);
    for (size_t i = 0; i < sum->points; i++) acb_add(base, base, sum->point + i, direction_bits);
    if (sum->points) acb_div_ui(base, base, sum->points, direction_bits);
    for (size_t i = 0; i < sum->points; i++) {
        acb_sub(offset, sum->point + i, base, direction_bits);
        acb_abs(size, offset, direction_bits);
        arb_max(spread, spread, size, direction_bits);
    }
    if (!arb_is_positive(spread)) arb_one(spread);
    acb_set_d_d(offset, 0.3171, -0.7313); /* such that no line from here passes through two points of a usual figure */
    acb_mul_arb(offset, offset, spread, direction_bits);
    acb_add(base, base, offset, direction_bits);
    acb_get_mid(base, base);
    acb_clear(offset);
    arb_clear(spread);
    arb_clear(size);
}

/* From the centre of the circle around the point to where the path from the base meets it. */
static bool radius_vector(const nh_monodromy_sum *sum, size_t point, const acb_t base, acb_t out)
{
    acb_t centre;
    arb_t radius, far;
    acb_init(centre);
    arb_init(radius);
    arb_init(far);
    acb_get_mid(centre, sum->point + point);
    acb_sub(out, base, centre, sum->bits);
    acb_abs(far, out, direction_bits);
    bool good = arb_is_positive(far) && (sum->points == 1 || nearest(radius, sum, centre, point));
    if (sum->points == 1) arb_set(radius, far);
    arb_min(radius, radius, far, direction_bits);
    arb_mul_2exp_si(radius, radius, -1);
    arb_div(radius, radius, far, direction_bits);
    acb_mul_arb(out, out, radius, direction_bits);
    acb_get_mid(out, out);
    acb_clear(centre);
    arb_clear(radius);
    arb_clear(far);
    return good;
}

/* Corner k of the polygon. */
static void corner(acb_t out, const nh_monodromy_sum *sum, size_t point, const acb_t radius, slong k)
{
    fmpq_t turn;
    acb_t centre;
    fmpq_init(turn);
    acb_init(centre);
    fmpq_set_si(turn, 2 * k, corners);
    arb_sin_cos_pi_fmpq(acb_imagref(out), acb_realref(out), turn, direction_bits);
    acb_mul(out, out, radius, direction_bits);
    acb_get_mid(centre, sum->point + point);
    acb_add(out, out, centre, sum->bits);
    acb_get_mid(out, out);
    fmpq_clear(turn);
    acb_clear(centre);
}

bool nh_monodromy_paths(const nh_monodromy_sum *sum, size_t point, nh_monodromy_path *go, nh_monodromy_path *around)
{
    acb_t z, start, radius;
    acb_init(z);
    acb_init(start);
    acb_init(radius);
    nh_monodromy_base(sum, z);
    path_add(go, z);
    bool good = radius_vector(sum, point, z, radius);
    if (good) {
        corner(start, sum, point, radius, 0);
        good = path_to(sum, go, start);
        path_add(around, start);
    }
    for (slong k = 1; k <= corners && good; k++) {
        corner(z, sum, point, radius, k);
        good = path_to(sum, around, k < corners ? z : start); /* the very number where it began */
    }
    acb_clear(z);
    acb_clear(start);
    acb_clear(radius);
    return good;
}

/* The transition matrix of one block along a path. */
static bool along(nh_monodromy_sum *sum, size_t b, const nh_monodromy_path *path, acb_mat_t T)
{
    acb_mat_t step;
    acb_t h;
    slong n = (slong)sum->block[b].size;
    bool good = true;
    acb_mat_init(step, n, n);
    acb_init(h);
    acb_mat_one(T);
    for (size_t k = 1; k < path->count && good; k++) {
        acb_sub(h, path->vertex + k, path->vertex + k - 1, ARF_PREC_EXACT);
        good = nh_monodromy_line(sum, b, path->vertex + k - 1, h, step);
        acb_mat_mul(T, step, T, sum->bits);
    }
    acb_mat_clear(step);
    acb_clear(h);
    return good;
}

/* loop = go^-1 around go */
static bool closed(nh_monodromy_sum *sum, size_t b, const nh_monodromy_path *go, const nh_monodromy_path *around,
                   acb_mat_t loop)
{
    acb_mat_t there, back;
    slong n = (slong)sum->block[b].size;
    acb_mat_init(there, n, n);
    acb_mat_init(back, n, n);
    bool good = along(sum, b, go, there) && along(sum, b, around, loop) && acb_mat_inv(back, there, sum->bits);
    acb_mat_mul(loop, loop, there, sum->bits);
    acb_mat_mul(loop, back, loop, sum->bits);
    good = good && acb_mat_is_finite(loop);
    acb_mat_clear(there);
    acb_mat_clear(back);
    return good;
}

bool nh_monodromy_loop(nh_monodromy_sum *sum, size_t point, nh_monodromy_element loop)
{
    nh_monodromy_path go = {0}, around = {0};
    bool good = nh_monodromy_paths(sum, point, &go, &around);
    for (size_t b = 0; b < sum->blocks && good; b++) good = closed(sum, b, &go, &around, loop + b);
    nh_monodromy_path_clear(&go);
    nh_monodromy_path_clear(&around);
    return good;
}
