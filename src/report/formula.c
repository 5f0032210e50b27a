#include "report/formula.h"

/* The user's own abbreviations, from the analysis file, instead of what they stand for. */
nh_ex nh_formula_abbreviate(const nh_result *r, nh_ex e)
{
    const nh_analysis *a = r->analysis;
    nh_dag *d = r->model->dag;
    for (size_t i = a ? a->definitions : 0; i-- > 0;) {
        nh_kind kind = nh_kind_of(d, a->definition[i].value);
        if (kind == NH_NUMBER || kind == NH_SYMBOL) continue;
        nh_ex name = nh_symbol(d, a->definition[i].name), value = a->definition[i].value;
        bool root = kind == NH_PRODUCT && nh_arity(d, value) == 1 && nh_num_is(nh_constant_of(d, value), 1)
                    && nh_exponent_of(d, value, 0) == nh_ratio(d, 1, 2);
        e = root ? nh_substitute_root(d, e, nh_child(d, value, 0), name) : nh_substitute(d, e, 1, &value, &name);
    }
    return e;
}

static void add_term(const nh_model *o, nh_field_term *list, size_t *n, nh_ex e, const char *along)
{
    if (!nh_is_zero(o->dag, e)) list[(*n)++] = (nh_field_term){e, along};
}

size_t nh_formula_field(const nh_result *r, const nh_symmetry *z, nh_field_term **out)
{
    const nh_model *o = r->model, *basis = r->other ? r->other : o;
    const nh_field *f = z->along_motion ? &z->relative : &z->field;
    const nh_ex *rate = z->along_motion ? z->relative_rate : z->coordinate_rate;
    size_t n = 0;
    nh_field_term *list = *out = nh_arena_alloc(o->arena, (2 + o->m + basis->n) * sizeof *list);
    if (z->along_motion) add_term(o, list, &n, z->Z0, NULL);
    add_term(o, list, &n, f->time, "t");
    for (size_t s = 0; s < o->m; s++) add_term(o, list, &n, f->space[s], r->system->coordinate[s].name);
    for (size_t i = 0; i < basis->n; i++) {
        nh_ex e = r->other ? 0 : f->velocity[i];
        for (size_t s = 0; s < o->m && r->other; s++)
            if (basis->chart->w[i] == r->system->coordinate[s].v) e = rate[s];
        add_term(o, list, &n, e, nh_name_of(o->dag, basis->chart->w[i]));
    }
    return n;
}
