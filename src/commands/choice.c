#include "commands/choice.h"

/* The model in coordinate velocities, which is derived if it is not there yet. */
static const nh_model *derive(void *context, double effort)
{
    nh_choice *c = context;
    nh_error ignored;
    nh_error_clear(&ignored);
    if (!c->other && c->may_derive && c->model->chart->quasi && c->deriving < effort)
        c->other =
            nh_model_create(c->system, nh_chart_create(c->system, NH_CHART_COORDINATES, c->seed, &ignored), &ignored);
    return c->other;
}

void nh_choice_open(nh_choice *c, bool plain)
{
    c->ways = (nh_integration_plans){.pilot = true, .plain = plain, .context = c, .derive = derive};
}

void nh_choice_close(nh_choice *c)
{
    nh_model_free(c->other);
    c->other = NULL;
}
