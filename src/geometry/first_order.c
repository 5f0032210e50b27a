#include "geometry/first_order.h"

#include "base/text.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/print.h"

/* a_i = dL/dv_i; false: some a_i depends on a velocity, or all of them are zero. */
static bool is_linear(const nh_model *model, nh_ex *a)
{
    const nh_system *system = model->system;
    bool any = false;
    for (size_t i = 0; i < model->m; i++) {
        a[i] = nh_simplify_short(model->dag, nh_diff(model->dag, system->lagrangian, system->coordinate[i].v), 0);
        any |= !nh_is_zero(model->dag, a[i]);
        for (size_t j = 0; j < model->m; j++)
            if (nh_depends(model->dag, a[i], system->coordinate[j].v) ||
                nh_depends(model->dag, system->force[i], system->coordinate[j].v))
                return false;
    }
    return any && model->k == 0;
}

/* Solves for the velocities; false: the equations do not determine them. */
static bool solve(const nh_model *model, const nh_ex *a, nh_ex *velocity)
{
    const nh_system *system = model->system;
    nh_dag *d = model->dag;
    size_t m = model->m;
    nh_ex *omega = nh_alloc_array(m * m + 2 * m, sizeof *omega), *v = omega + m * m, *zero = v + m;
    for (size_t i = 0; i < m; i++) v[i] = system->coordinate[i].v, zero[i] = nh_int(d, 0);
    nh_ex H = nh_neg(d, nh_substitute(d, system->lagrangian, m, v, zero));
    for (size_t i = 0; i < m; i++) {
        nh_ex q = system->coordinate[i].q;
        for (size_t j = 0; j < m; j++) {
            nh_ex curl = nh_sub(d, nh_diff(d, a[j], q), nh_diff(d, a[i], system->coordinate[j].q));
            omega[i * m + j] = nh_simplify_short(d, curl, 0);
        }
        velocity[i] = nh_sub(d, nh_add(d, nh_diff(d, H, q), nh_diff(d, a[i], system->t)), system->force[i]);
    }
    nh_lu *lu = nh_lu_create(d, m, omega, nh_chart_pivot_score, model->chart, NULL);
    if (lu) nh_lu_solve(lu, velocity, velocity);
    for (size_t i = 0; i < m && lu; i++) velocity[i] = nh_simplify_short(d, velocity[i], 0);
    bool solved = lu != NULL;
    nh_lu_free(lu);
    nh_free(omega);
    return solved;
}

/* The name of a further coordinate. */
static const char *free_name(const nh_system *system)
{
    static const char *const names[] = {"s", "u", "clock", "own_clock"};
    size_t i = 0;
    nh_ex ignored;
    while (i + 1 < sizeof names / sizeof *names && nh_symbol_find(system->dag, names[i], &ignored)) i++;
    return names[i];
}

/* The hint: the same equations as constraints beside a coordinate that moves by itself, or how to write them where
 * they are long. */
static void write_instead(const nh_model *model, const nh_ex *velocity, nh_error *error)
{
    enum { most = 500 }; /* a hint is no longer */
    const nh_system *system = model->system;
    const char *name = free_name(system);
    nh_text text;
    nh_text_init(&text);
    nh_text_addf(&text,
                 "write these equations as constraints beside a coordinate that moves by itself: coordinates [.., %s], "
                 "lagrangian: %s'^2/2, constraints: [",
                 name, name);
    for (size_t i = 0; i < model->m && text.length < most; i++) {
        char *e = nh_print_short(model->dag, velocity[i], most);
        nh_text_addf(&text, "%s\"%s' = %s\"", i ? ", " : "", system->coordinate[i].name, e ? e : "");
        if (!e) nh_text_addf(&text, "%*s", most, "");
        nh_free(e);
    }
    nh_text_add(&text, "]");
    if (text.length < most) nh_error_hint(error, "%s", nh_text_string(&text));
    else
        nh_error_hint(error,
                      "with L = a_i q_i' - H they are omega_ij q_j' = dH/dq_i, omega_ij = da_j/dq_i - da_i/dq_j: solve "
                      "them for q' and write them as constraints beside a coordinate that moves by itself: coordinates "
                      "[.., %s], lagrangian: %s'^2/2, constraints: [\"%s' = ..\", ..]",
                      name, name, system->coordinate[0].name);
    nh_text_clear(&text);
}

bool nh_first_order_refuse(const nh_model *model, nh_error *error)
{
    const nh_deck_node *where = nh_deck_get(nh_deck_root(model->system->deck), "lagrangian");
    nh_ex *a = nh_alloc_array(2 * model->m + 1, sizeof *a), *velocity = a + model->m;
    bool linear = is_linear(model, a), solved = linear && solve(model, a, velocity);
    if (solved) {
        nh_deck_fail(model->system->deck, where, 0, error,
                     "the Lagrangian is linear in the velocities: no velocity has inertia, and its equations of motion "
                     "are of first order");
        write_instead(model, velocity, error);
    } else if (linear) {
        nh_deck_fail(model->system->deck, where, 0, error,
                     "the Lagrangian is linear in the velocities, and its equations do not determine them");
        nh_error_hint(error, "every independent velocity needs inertia; or is a term of the Lagrangian missing?");
    }
    nh_free(a);
    return !linear;
}
