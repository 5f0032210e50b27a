#include "integrals/open_way.h"

#include <math.h>
#include <string.h>

#include "exact/walls.h"

enum { places = 48, halvings = 50 };

struct nh_open_way {
    const nh_model *o;
    size_t bases;
    nh_tape *tape; /* L, then the bases */
    nh_tape_work *work;
    double *z, *value, *before;
};

nh_open_way *nh_open_way_create(const nh_model *model)
{
    nh_open_way *w = nh_alloc(sizeof *w);
    const nh_system *system = model->system;
    nh_ex e[1 + NH_MOST_WALLS];
    nh_walls poles = {0};
    nh_walls_add_poles(&poles, model->dag, system->lagrangian);
    for (size_t i = 0; i < system->coordinates && system->has_forces; i++)
        nh_walls_add_poles(&poles, model->dag, system->force[i]);
    e[0] = model->Lbar;
    for (size_t i = 0; i < poles.count; i++) e[1 + i] = nh_model_compose(model, poles.e[i]);
    *w = (nh_open_way){.o = model, .bases = poles.count, .tape = nh_model_tape(model, 1 + poles.count, e)};
    w->work = nh_tape_work_create(w->tape);
    w->z = nh_alloc_array(model->width + 2 * (1 + poles.count), sizeof *w->z);
    w->value = w->z + model->width;
    w->before = w->value + 1 + poles.count;
    return w;
}

void nh_open_way_free(nh_open_way *w)
{
    if (!w) return;
    nh_free(w->z);
    nh_tape_work_free(w->work);
    nh_tape_free(w->tape);
    nh_free(w);
}

/* The values at a part of the way; false where the constraints give no velocities. */
static bool at(nh_open_way *w, const double *from, const double *to, double s)
{
    size_t n = w->o->width - w->o->chart->implicit;
    for (size_t j = 0; j < w->o->width; j++) w->z[j] = j < n ? from[j] + s * (to[j] - from[j]) : from[j];
    if (!nh_chart_complete(w->o->chart, w->z)) return false;
    nh_tape_eval(w->tape, w->work, w->z, w->value);
    return true;
}

/* Between two places the base i changes its sign: does L go on growing nearer and nearer to its zero? */
static bool is_pole(nh_open_way *w, const double *from, const double *to, size_t i, double low, double high)
{
    static const double distance[] = {1e-3, 1e-5, 1e-7};
    double sign = w->before[1 + i], L[3];
    for (int k = 0; k < halvings; k++) {
        double middle = (low + high) / 2;
        if (!at(w, from, to, middle)) return false;
        if (w->value[1 + i] * sign > 0) low = middle;
        else high = middle;
    }
    for (int k = 0; k < 3; k++) {
        if (!at(w, from, to, low - distance[k])) return false;
        L[k] = w->value[0];
    }
    return !(fabs(L[2] - L[1]) < 0.5 * fabs(L[1] - L[0]));
}

bool nh_open_way_leads(nh_open_way *w, const double *from, const double *to)
{
    bool known = false;
    if (!w->bases) return true;
    for (int k = 0; k <= places; k++) {
        double s = (double)k / places;
        if (!at(w, from, to, s)) {
            known = false;
            continue;
        }
        if (isnan(w->value[0])) return false;
        for (size_t i = 0; i < w->bases && known; i++)
            if (w->value[1 + i] * w->before[1 + i] < 0) {
                if (is_pole(w, from, to, i, s - 1.0 / places, s)) return false;
                at(w, from, to, s);
            }
        memcpy(w->before, w->value, (1 + w->bases) * sizeof *w->before);
        known = true;
    }
    return true;
}
