#include "document/symmetry_words.h"

#include "exact/normal.h"
#include "graph/diff.h"

/* What the components of a field on (t, q) are. */
typedef struct {
    bool time, constant_time; /* Z^0 is not zero; it is constant */
    size_t moved, constant;   /* coordinates that move, by constants */
    bool velocities, clock;   /* components contain velocities; t */
} shape;

static shape shape_of(const nh_model *o, const nh_field *z)
{
    nh_dag *d = o->dag;
    shape out = {.time = !nh_is_zero(d, z->time), .constant_time = nh_model_is_constant(o, z->time)};
    for (size_t s = 0; s <= o->m; s++) {
        nh_ex e = s < o->m ? z->space[s] : z->time;
        if (s < o->m && !nh_is_zero(d, e)) out.moved++, out.constant += nh_model_is_constant(o, e);
        out.clock |= nh_depends(d, e, o->system->t);
        for (size_t i = 0; i < o->n; i++) out.velocities |= nh_depends(d, e, o->chart->w[i]);
        for (size_t i = 0; i < o->chart->implicit; i++) out.velocities |= nh_depends(d, e, o->chart->u[i]);
    }
    return out;
}

/* Is the field z^s = A^s_r q^r on lengths, with a constant A = -A^T, and constant on the other coordinates?  The rows
 * of A that are not zero are counted. */
static bool is_rotation(const nh_model *o, const nh_field *z, size_t *rows)
{
    nh_dag *d = o->dag;
    const nh_coordinate *c = o->system->coordinate;
    *rows = 0;
    for (size_t s = 0; s < o->m; s++) {
        if (c[s].type == NH_ANGLE) {
            if (!nh_model_is_constant(o, z->space[s])) return false;
            continue;
        }
        nh_ex rest = z->space[s];
        for (size_t r = 0; r < o->m; r++) {
            nh_ex A = nh_simplify(d, nh_diff(d, z->space[s], c[r].q));
            if (nh_is_zero(d, A)) continue;
            if (c[r].type == NH_ANGLE || !nh_model_is_constant(o, A)) return false;
            nh_ex back = nh_simplify(d, nh_add(d, A, nh_diff(d, z->space[r], c[s].q)));
            if (!nh_is_zero(d, back)) return false;
            rest = nh_sub(d, rest, nh_mul(d, A, c[r].q));
        }
        if (!nh_is_zero(d, nh_simplify(d, rest))) return false;
        *rows += !nh_is_zero(d, z->space[s]);
    }
    return *rows > 1;
}

/* "x, y and phi": the coordinates that move. */
static void put_moved(const nh_model *o, const nh_field *z, size_t moved, nh_text *out)
{
    size_t told = 0;
    for (size_t s = 0; s < o->m; s++) {
        if (nh_is_zero(o->dag, z->space[s])) continue;
        nh_text_addf(out, "%s%s", !told ? "" : told + 1 == moved ? " and " : ", ", o->system->coordinate[s].name);
        told++;
    }
}

bool nh_symmetry_words(const nh_model *o, const nh_symmetry *z, nh_text *out)
{
    enum { most_named = 4 };
    const nh_field *f = &z->field;
    shape is = shape_of(o, f);
    size_t rows;
    if (is.velocities || is.clock) {
        nh_text_addf(out, "a symmetry that involves %s%s%s", is.clock ? "time" : "",
                     is.clock && is.velocities ? " and " : "", is.velocities ? "the velocities" : "");
        return false;
    }
    if (is.time && !is.moved && is.constant_time) {
        nh_text_add(out, "the symmetry in time");
        return false;
    }
    bool turns = !is.time && is_rotation(o, f, &rows);
    if (turns && rows == 2 && is.moved == 2) nh_text_add(out, "rotations in the plane of ");
    else if (turns) nh_text_add(out, "rotations");
    else if (!is.time && is.moved == 1 && is.constant == 1) {
        size_t s = 0;
        while (nh_is_zero(o->dag, f->space[s])) s++;
        nh_text_add(out, o->system->coordinate[s].type == NH_ANGLE ? "turning " : "shifting ");
    } else if (!is.time && is.constant == is.moved) {
        nh_text_add(out, "a joint shift of ");
    } else {
        nh_text_addf(out, "a symmetry that moves %s", is.time ? "time and " : "");
    }
    if (turns && !(rows == 2 && is.moved == 2)) return true;
    if (is.moved <= most_named) put_moved(o, f, is.moved, out);
    else nh_text_addf(out, "%zu coordinates", is.moved);
    return turns;
}
