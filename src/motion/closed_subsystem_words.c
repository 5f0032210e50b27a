/* closed_subsystem_words: a closed subsystem in words. */
#include "graph/node.h"
#include "motion/closed_subsystem.h"

const char *nh_closed_subsystem_state_name(const nh_closed_subsystem *s, size_t i)
{
    return nh_name_of(s->model->dag, s->model->chart->symbol[1 + i]);
}

static void list(const nh_closed_subsystem *s, size_t from, size_t to, nh_text *out)
{
    for (size_t i = from; i < to; i++)
        nh_text_addf(out, "%s%s",
                     i == from     ? ""
                     : i + 1 == to ? " and "
                                   : ", ",
                     nh_closed_subsystem_state_name(s, s->state[i]));
}

void nh_closed_subsystem_words(const nh_closed_subsystem *s, nh_text *out)
{
    nh_text_addf(out, "%zu of %zu states integrated", s->core, s->states);
    if (s->core) {
        nh_text_add(out, " (");
        list(s, 0, s->core, out);
        nh_text_add(out, ")");
    }
    if (s->quadratures) {
        nh_text_add(out, ", ");
        list(s, s->core, s->kept, out);
        nh_text_add(out, " by quadrature");
    }
    if (s->levels) {
        nh_text_add(out, ", ");
        list(s, s->kept, s->kept + s->levels, out);
        nh_text_add(out, s->levels == 1 ? " by a conserved quantity" : " by conserved quantities");
    }
    if (s->kept + s->levels < s->states) {
        nh_text_add(out, ", ");
        list(s, s->kept + s->levels, s->states, out);
        nh_text_add(out, " not needed");
    }
    nh_text_addf(out, "; %zu of %zu operations", s->instructions, s->instructions_of_all);
}
