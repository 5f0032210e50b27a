/* scene_words: what a scene keeps, and what has no influence on it. */
#include <string.h>

#include "expr/diff.h"
#include "motion/scene.h"

const char *nh_scene_state_name(const nh_scene *s, size_t i) { return nh_name_of(s->model->dag, s->model->chart->symbol[1 + i]); }

static void list(const nh_scene *s, size_t from, size_t to, nh_text *out)
{
    for (size_t i = from; i < to; i++)
        nh_text_addf(out, "%s%s", i == from ? "" : i + 1 == to ? " and " : ", ", nh_scene_state_name(s, s->state[i]));
}

void nh_scene_words(const nh_scene *s, nh_text *out)
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
        nh_text_add(out, s->levels == 1 ? " by a conserved current" : " by conserved currents");
    }
    if (s->kept + s->levels < s->states) {
        nh_text_add(out, ", ");
        list(s, s->kept + s->levels, s->states, out);
        nh_text_add(out, " dropped");
    }
    nh_text_addf(out, "; %zu of %zu instructions", s->instructions, s->instructions_of_all);
}

/* ---- what never matters ---- */

static void list_names(size_t n, const char *const *name, nh_text *out)
{
    for (size_t i = 0; i < n; i++) nh_text_addf(out, "%s%s", i == 0 ? "" : i + 1 == n ? " and " : ", ", name[i]);
}

static bool is_idle(nh_dag *d, nh_ex e, size_t n, const nh_ex *parameter, const bool *idle)
{
    for (size_t i = 0; i < n; i++)
        if (!idle[i] && nh_depends(d, e, parameter[i])) return false;
    return true;
}

/* Does mass or inertia of the body have a parameter, and are all of them idle? */
static bool body_is_idle(const nh_model *o, const nh_body *b, const bool *idle)
{
    size_t n = o->system->parameters;
    bool any = false, good = is_idle(o->dag, b->mass, n, o->parameter, idle);
    for (int i = 0; i < 9 && good; i++) good = is_idle(o->dag, b->inertia[i], n, o->parameter, idle);
    for (size_t i = 0; i < n; i++) {
        any |= nh_depends(o->dag, b->mass, o->parameter[i]);
        for (int j = 0; j < 9; j++) any |= nh_depends(o->dag, b->inertia[j], o->parameter[i]);
    }
    return good && any;
}

void nh_scene_idle_words(const nh_scene *s, nh_text *out)
{
    const nh_model *o = s->model;
    const nh_chain *chain = o->system->chain;
    size_t n = o->system->parameters, names = 0, total = n + (chain ? chain->bodies : 0);
    bool *idle = nh_alloc_array(n + 1, sizeof *idle);
    const char **name = nh_alloc_array(total + 1, sizeof *name);
    for (size_t i = 0; i < n; i++)
        if ((idle[i] = nh_network_ignores(&s->network, o->parameter[i]))) name[names++] = nh_name_of(o->dag, o->parameter[i]);
    if (names) {
        nh_text_add(out, names == 1 ? "the parameter " : "the parameters ");
        list_names(names, name, out);
        nh_text_add(out, names == 1 ? " has no influence" : " have no influence");
    }
    names = 0;
    for (size_t b = 0; chain && b < chain->bodies; b++)
        if (body_is_idle(o, &chain->body[b], idle)) name[names++] = chain->body[b].name;
    if (names) {
        nh_text_add(out, names == 1 ? ", nor the body " : ", nor the bodies ");
        list_names(names, name, out);
    }
    nh_free(name);
    nh_free(idle);
}
