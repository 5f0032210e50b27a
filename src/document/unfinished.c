#include "document/unfinished.h"

#include "base/json.h"
#include "base/versions.h"

static const char *plural(size_t count) { return count == 1 ? "" : "s"; }

char *nh_unfinished_json(const nh_unfinished *u, const nh_run *run)
{
    const nh_system *system = u->system;
    nh_json *root = nh_json_object();
    nh_json_put_number(root, "schema", 1);
    nh_json_put_text(root, "version", NH_VERSION);
    nh_json_put_text(root, "system", system->name);
    if (u->search) nh_json_put_text(root, "verdict", "UNDECIDED");
    if (u->search) nh_json_put_text(root, "search", "cut");
    nh_json_put_bool(root, "partial", true);
    nh_json *unfinished = nh_json_put_object(root, "unfinished");
    nh_json_put_text(unfinished, "why", u->why);
    nh_json_put_text(unfinished, "doing", u->doing);
    nh_json *coordinates = nh_json_put_array(root, "coordinates"),
            *constraints = nh_json_put_array(root, "constraints");
    for (size_t i = 0; i < system->coordinates; i++) nh_json_add_text(coordinates, system->coordinate[i].name);
    for (size_t i = 0; i < system->constraints; i++) nh_json_add_text(constraints, system->constraint[i].text);
    nh_run_json(run, system, root);
    return nh_json_finish(root);
}

void nh_unfinished_write(const nh_unfinished *u, const nh_run *run, nh_pen_style style, nh_text *out)
{
    const nh_system *system = u->system;
    nh_pen pen, *p = &pen;
    nh_pen_begin(p, style, &(nh_pen_subject){.system = system, .dag = system->dag, .shown = run->shown},
                 "an incomplete run", out);
    nh_pen_open(p, NH_PEN_ANSWER, "undecided", NULL);
    nh_pen_say(p, u->search ? "UNDECIDED: no current so far (search cut)" : "Unfinished");
    nh_pen_close(p, NH_PEN_ANSWER);
    p->ink->links(p->to, "system|System|repeat|Repeat it");
    nh_pen_warning(p, u->why);
    if (*u->doing) nh_pen_words(p, "The run ended during: %s", u->doing);
    nh_pen_words(p, "%zu coordinate%s, %zu constraint%s", system->coordinates, plural(system->coordinates),
                 system->constraints, plural(system->constraints));
    nh_pen_system(p, NULL, NULL);
    nh_pen_end(p, run);
}
