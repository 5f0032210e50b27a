#include "study/choice.h"

#include <string.h>

const nh_model *nh_choice_derive(nh_choice *c)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    if (!c->other && c->may_derive && c->model->chart->quasi) c->other = nh_model_create(c->system, nh_chart_create(c->system, NH_CHART_COORDINATES, c->seed, &ignored), &ignored);
    return c->other;
}

static const nh_model *derive_in(void *context, double seconds)
{
    nh_choice *c = context;
    return c->other || c->deriving < seconds ? nh_choice_derive(c) : NULL;
}

/* Nothing depends on its being kept. */
static void keep(void *context, double eps, const nh_survey *survey)
{
    nh_choice *c = context;
    nh_error ignored;
    nh_way way[NH_SURVEY_WAYS];
    nh_error_clear(&ignored);
    memcpy(way, survey->way, survey->count * sizeof *way);
    nh_ranking r = {.begin = c->begin, .end = c->end, .surveyed = true, .plain = c->ways.plain, .asks = 1, .asked = {eps}, .count = survey->count, .way = way};
    nh_ranking_keep(c->model, &r, &ignored);
}

void nh_choice_open(nh_choice *c, double eps, bool plain)
{
    bool there = c->remember && nh_ranking_read(nh_ranking_key(c->model), c->arena, &c->ranking);
    if (!there || !nh_ranking_tells(&c->ranking, eps, plain)) c->ranking = (nh_ranking){.count = 0};
    if (plain) nh_ranking_adaptive(&c->ranking);
    c->ways = (nh_ways){.count = c->ranking.count, .way = c->ranking.way, .surveyed = c->ranking.surveyed, .survey = true, .plain = plain, .context = c, .derive = derive_in};
    if (c->remember && nh_ranking_possible()) c->ways.keep = keep;
}

void nh_choice_close(nh_choice *c)
{
    nh_model_free(c->other);
    c->other = NULL;
}
