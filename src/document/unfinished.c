#include "document/unfinished.h"

#include "base/json.h"
#include "base/versions.h"
#include "document/pen.h"

static const char *plural(size_t count) { return count == 1 ? "" : "s"; }

void nh_unfinished_text(const nh_unfinished *u, nh_text *out)
{
    const nh_system *s = u->system;
    nh_text_addf(out, "%s\n%zu coordinate%s, %zu constraint%s\n\n", s->title, s->coordinates, plural(s->coordinates), s->constraints, plural(s->constraints));
    if (u->search) nh_text_add(out, "UNDECIDED: no current so far (search cut)\n");
    nh_text_addf(out, "Unfinished: %s%s%s\n", u->why, *u->doing ? " during this: " : "", u->doing);
}

char *nh_unfinished_json(const nh_unfinished *u)
{
    const nh_system *s = u->system;
    nh_json *root = nh_json_object();
    nh_json_put_number(root, "schema", 1);
    nh_json_put_text(root, "version", NH_VERSION);
    nh_json_put_text(root, "system", s->name);
    if (u->search) nh_json_put_text(root, "verdict", "UNDECIDED");
    if (u->search) nh_json_put_text(root, "search", "cut");
    nh_json_put_bool(root, "partial", true);
    nh_json *unfinished = nh_json_put_object(root, "unfinished");
    nh_json_put_text(unfinished, "why", u->why);
    nh_json_put_text(unfinished, "doing", u->doing);
    nh_json *coordinates = nh_json_put_array(root, "coordinates"), *constraints = nh_json_put_array(root, "constraints");
    for (size_t i = 0; i < s->coordinates; i++) nh_json_add_text(coordinates, s->coordinate[i].name);
    for (size_t i = 0; i < s->constraints; i++) nh_json_add_text(constraints, s->constraint[i].text);
    nh_run_json(u->run, s, root);
    return nh_json_finish(root);
}

void nh_unfinished_page(const nh_unfinished *u, nh_text *out)
{
    nh_pen pen, *p = &pen;
    nh_pen_begin(p, (nh_pen_style){.form = NH_PEN_PAGE}, &(nh_pen_subject){.system = u->system, .dag = u->system->dag, .shown = u->run->shown}, "an incomplete run", out);
    nh_pen_open(p, NH_PEN_ANSWER, "undecided", NULL);
    nh_pen_say(p, u->search ? "Undecided: no current so far (search cut)." : "Unfinished.");
    nh_pen_close(p, NH_PEN_ANSWER);
    p->ink->links(p->to, "system|System|repeat|Repeat it");
    nh_pen_warning(p, u->why);
    if (*u->doing) nh_pen_words(p, "The run ended during: %s", u->doing);
    nh_pen_system(p, NULL, NULL);
    nh_pen_end(p, u->run);
}
