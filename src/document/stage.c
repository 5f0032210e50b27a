#include "document/stage.h"

void nh_stage_free(nh_stage *s)
{
    if (!s) return;
    nh_time_series_free((nh_time_series *)s->series);
    nh_live_free(s->live);
}
