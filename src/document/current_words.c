#include "document/current_words.h"

#include <string.h>

#include "exact/normal.h"

static bool is_minus(const nh_current *f) { return !strncmp(f->meaning, "minus", 5); }

bool nh_current_is_energy(const nh_current *f) { return f->energy && (!strcmp(f->meaning, "energy") || is_minus(f)); }

nh_ex nh_current_signed(const nh_analysis *r, const nh_current *f, nh_ex e)
{
    return is_minus(f) ? nh_neg(r->model->dag, e) : e;
}

const char *nh_current_label(const nh_analysis *r, const nh_current *f)
{
    nh_dag *d = r->model->dag;
    if (nh_current_is_energy(f) && !nh_depends(d, f->phi, nh_symbol(d, "E"))) return "E = ";
    const char *of = strstr(f->meaning, "momentum of ");
    bool bare = of && (of == f->meaning || !strncmp(f->meaning, "minus the ", 10));
    const char *p = bare ? nh_arena_printf(r->arena, "p_%s", of + strlen("momentum of ")) : NULL;
    return p && !nh_depends(d, f->phi, nh_symbol(d, p)) ? nh_arena_printf(r->arena, "%s = ", p) : "";
}
