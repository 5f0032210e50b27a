#include "system/orientation.h"

#include <string.h>

#include "base/text.h"
#include "exact/normal.h"
#include "graph/diff.h"
#include "graph/parse.h"
#include "system/embedding_internal.h"

static const char *const axes[] = {"x", "y", "z"};

/* ---- names ---- */

static bool new_name(nh_system_reader *r, const nh_deck_node *place, const char *text)
{
    nh_deck_node node = *place;
    node.kind = NH_DECK_SCALAR;
    node.text = text;
    return nh_system_new_name(r, &node);
}

/* `velocities: [p, q, r]`, or NAME_wx, NAME_wy, NAME_wz. */
static bool words_of(nh_system_reader *r, const nh_deck_node *item, nh_orientation *o)
{
    nh_arena *arena = r->system->arena;
    const nh_deck_node *list = item && item->kind == NH_DECK_MAP ? nh_deck_get(item, "velocities") : NULL;
    if (list && !nh_deck_is(r->deck, list, NH_DECK_LIST, "velocities", r->error)) return false;
    if (list && list->count != 3) {
        nh_deck_fail(r->deck, list, 0, r->error, "an orientation has three angular velocities, not %zu", list->count);
        return nh_error_hint(r->error, "for example: velocities: [omega_x, omega_y, omega_z]");
    }
    for (int k = 0; k < 3; k++) {
        const nh_deck_node *place = list ? list->item[k] : o->node;
        if (list && !nh_deck_is(r->deck, place, NH_DECK_SCALAR, "a name", r->error)) return false;
        o->word[k] = list ? place->text : nh_arena_printf(arena, "%s_w%s", o->name, axes[k]);
        if (!new_name(r, place, o->word[k])) return false;
        o->omega[k] = nh_symbol(r->system->dag, o->word[k]);
    }
    for (int k = 0; k < 9; k++) {
        o->entry[k] = nh_arena_printf(arena, "%s_%s%s", o->name, axes[k / 3], axes[k % 3]);
        if (!new_name(r, o->node, o->entry[k])) return false;
        o->entry_symbol[k] = nh_symbol(r->system->dag, o->entry[k]);
    }
    return true;
}

static bool frame_of(nh_system_reader *r, const nh_deck_node *item, nh_orientation *o)
{
    const nh_deck_node *node = item && item->kind == NH_DECK_MAP ? nh_deck_get(item, "frame") : NULL;
    if (!node) return true;
    if (!nh_deck_is(r->deck, node, NH_DECK_SCALAR, "frame", r->error)) return false;
    o->space = !strcmp(node->text, "space");
    return o->space || !strcmp(node->text, "body") ||
           nh_deck_fail(r->deck, node, 0, r->error,
                        "`%s` is no frame of angular velocities; expected body or space", node->text);
}

bool nh_orientation_declare(nh_system_reader *r, const nh_deck_node *item, const nh_deck_node *name, const char *doc)
{
    nh_system *s = r->system;
    nh_orientation *o = &s->orientation[s->orientations];
    *o = (nh_orientation){.name = name->text, .node = name, .first = s->coordinates};
    if (!nh_system_new_name(r, name) || !frame_of(r, item, o)) return false;
    for (int k = 0; k < 3; k++) {
        nh_coordinate *c = &s->coordinate[s->coordinates];
        *c = (nh_coordinate){.name = nh_arena_printf(s->arena, "%s_%d", o->name, k + 1), .unit = "", .doc = doc};
        c->type = NH_PLAIN;
        if (!new_name(r, name, c->name)) return false;
        c->q = nh_symbol(s->dag, c->name);
        s->coordinates++;
    }
    if (!words_of(r, item, o)) return false;
    s->orientations++;
    return true;
}

nh_orientation *nh_orientation_named(const nh_system *s, const char *name)
{
    for (size_t i = 0; i < s->orientations; i++)
        if (!strcmp(s->orientation[i].name, name)) return &s->orientation[i];
    return NULL;
}

const nh_orientation *nh_orientation_of(const nh_system *s, size_t coordinate)
{
    for (size_t i = 0; i < s->orientations; i++)
        if (coordinate - s->orientation[i].first < 3) return &s->orientation[i];
    return NULL;
}

bool nh_orientation_word(const nh_system *s, const char *word, bool framed, bool *velocity, nh_ex *out)
{
    for (size_t i = 0; i < s->orientations; i++) {
        const nh_orientation *o = &s->orientation[i];
        for (int k = 0; k < 9; k++) {
            *velocity = k < 3 && !strcmp(o->word[k], word);
            if (*velocity) return *out = framed ? o->framed[k] : o->rate[k], true;
            if (!strcmp(o->entry[k], word)) return *out = o->matrix[k], true;
        }
    }
    return false;
}

/* ---- matrices ---- */

/* The matrix of x -> s cross x. */
static void cross_matrix(nh_dag *d, const nh_ex s[3], nh_ex out[9])
{
    for (int i = 0; i < 9; i++) out[i] = nh_int(d, 0);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        out[3 * k + j] = s[i];
        out[3 * j + k] = nh_neg(d, s[i]);
    }
}

static void build(nh_system *y, nh_orientation *o)
{
    nh_dag *d = y->dag;
    nh_ex s[3], v[3], turn[9], square = nh_int(d, 0), one = nh_int(d, 1);
    for (int k = 0; k < 3; k++) {
        s[k] = y->coordinate[o->first + (size_t)k].q;
        v[k] = y->coordinate[o->first + (size_t)k].v;
        square = nh_add(d, square, nh_powi(d, s[k], 2));
        o->framed[k] = nh_symbol_fresh(d, o->word[k]);
    }
    cross_matrix(d, s, turn);
    nh_ex inner = nh_sub(d, one, square), outer = nh_add(d, one, square), over = nh_powi(d, outer, -2),
          two = nh_int(d, 2), quarter = nh_ratio(d, 1, 4);
    nh_ex own[9]; /* F of the body */
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            nh_ex ss = nh_mul(d, s[i], s[j]), same = nh_int(d, i == j), w = turn[3 * i + j];
            nh_ex even = nh_add(d, nh_mul(d, inner, same), nh_mul(d, two, ss)), odd = nh_mul(d, two, w);
            own[3 * i + j] = nh_mul(d, quarter, nh_add(d, even, odd));
            o->map[3 * i + j] = nh_mul(d, quarter, o->space ? nh_sub(d, even, odd) : nh_add(d, even, odd));
            nh_ex twice = nh_sub(d, ss, nh_mul(d, square, same)); /* [s]^2 */
            nh_ex sum = nh_add(d, nh_mul(d, nh_int(d, 8), twice), nh_product(d, 3, (nh_ex[]){nh_int(d, 4), inner, w}));
            o->matrix[3 * i + j] = nh_add(d, same, nh_mul(d, sum, over));
        }
    for (int k = 0; k < 3; k++) { /* w = F^-1 s' = 16 F^T s'/(1 + s.s)^2 */
        o->rate[k] = o->body[k] = nh_int(d, 0);
        for (int i = 0; i < 3; i++) {
            o->rate[k] = nh_add(d, o->rate[k], nh_mul(d, o->map[3 * i + k], v[i]));
            o->body[k] = nh_add(d, o->body[k], nh_mul(d, own[3 * i + k], v[i]));
        }
        o->rate[k] = nh_product(d, 3, (nh_ex[]){nh_int(d, 16), over, o->rate[k]});
        o->body[k] = nh_product(d, 3, (nh_ex[]){nh_int(d, 16), over, o->body[k]});
    }
    for (int k = 0; k < 3; k++) { /* R^T w for components in space */
        o->framed_body[k] = o->space ? nh_int(d, 0) : o->framed[k];
        for (int i = 0; i < 3 && o->space; i++)
            o->framed_body[k] = nh_add(d, o->framed_body[k], nh_mul(d, o->matrix[3 * i + k], o->framed[i]));
    }
}

void nh_orientations_build(nh_system *s)
{
    for (size_t i = 0; i < s->orientations; i++) build(s, &s->orientation[i]);
}

nh_ex nh_orientation_framed(const nh_system *s, nh_ex e)
{
    for (size_t i = 0; i < s->orientations; i++) {
        const nh_orientation *o = &s->orientation[i];
        nh_ex v[3], to[3];
        for (size_t k = 0; k < 3; k++) {
            v[k] = s->coordinate[o->first + k].v;
            to[k] = nh_int(s->dag, 0);
            for (int j = 0; j < 3; j++)
                to[k] = nh_add(s->dag, to[k], nh_mul(s->dag, o->map[3 * k + (size_t)j], o->framed[j]));
        }
        e = nh_substitute(s->dag, e, 3, v, to);
    }
    return e;
}

nh_ex nh_orientation_written(const nh_system *s, nh_ex e)
{
    for (size_t i = 0; i < s->orientations; i++)
        e = nh_substitute(s->dag, e, 3, s->orientation[i].framed, s->orientation[i].rate);
    return e;
}

void nh_orientation_map(const nh_system *s, const nh_ex *framed, nh_ex *out)
{
    for (size_t i = 0; i < s->coordinates; i++) {
        const nh_orientation *o = nh_orientation_of(s, i);
        if (!o) {
            out[i] = framed[i];
            continue;
        }
        out[i] = nh_int(s->dag, 0);
        for (size_t k = 0; k < 3; k++)
            out[i] = nh_add(s->dag, out[i], nh_mul(s->dag, o->map[3 * (i - o->first) + k], framed[o->first + k]));
    }
}

/* ---- printed formulas ---- */

/* The coefficients c_0 and c_ij of e = c_0 + c_ij R_ij where e is linear in the entries.  They follow from the first
 * terms of (1 + s.s)^2 e = p + d_i s_i + h_ij s_i s_j/2 + .. at s = 0, T = c_xx + c_yy + c_zz:
 *
 *     p = c_0 + T,   d_i = 4 (c_kj - c_jk),   h_ij = 8 (c_ij + c_ji),   h_ii/2 = 2 p - 8 T + 8 c_ii. */
static void coefficients_of(nh_dag *d, const nh_ex s[3], nh_ex e, nh_ex *c0, nh_ex c[9])
{
    nh_ex zero[3] = {nh_int(d, 0), nh_int(d, 0), nh_int(d, 0)}, square = nh_int(d, 1), first[3], half[9], sum = zero[0];
    for (int i = 0; i < 3; i++) square = nh_add(d, square, nh_powi(d, s[i], 2));
    nh_ex F = nh_simplify(d, nh_mul(d, e, nh_powi(d, square, 2))), p = nh_substitute(d, F, 3, s, zero);
    for (int i = 0; i < 3; i++) {
        nh_ex slope = nh_diff(d, F, s[i]);
        first[i] = nh_substitute(d, slope, 3, s, zero);
        for (int j = 0; j < 3; j++)
            half[3 * i + j] = nh_div(d, nh_substitute(d, nh_diff(d, slope, s[j]), 3, s, zero), nh_int(d, 2));
        sum = nh_add(d, sum, half[4 * i]);
    }
    nh_ex T = nh_div(d, nh_sub(d, nh_mul(d, nh_int(d, 6), p), sum), nh_int(d, 16)), eight = nh_int(d, 8);
    *c0 = nh_simplify(d, nh_sub(d, p, T));
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        nh_ex own = nh_add(d, nh_sub(d, half[4 * i], nh_mul(d, nh_int(d, 2), p)), nh_mul(d, eight, T)),
              odd = nh_div(d, first[i], eight), even = nh_div(d, half[3 * j + k], eight);
        c[4 * i] = nh_simplify(d, nh_div(d, own, eight));
        c[3 * k + j] = nh_simplify(d, nh_add(d, even, odd));
        c[3 * j + k] = nh_simplify(d, nh_sub(d, even, odd));
    }
}

/* e by the entries of one orientation, where it is linear in them: that is proved. */
static nh_ex shown_by(const nh_system *y, const nh_orientation *o, nh_ex e)
{
    enum { longest = 4000, terms = 4000 };
    nh_dag *d = y->dag;
    nh_ex s[3], c0, c[9];
    bool any = false;
    for (size_t k = 0; k < 3; k++) {
        s[k] = y->coordinate[o->first + k].q;
        any |= nh_depends(d, e, s[k]);
    }
    if (!any || !nh_complexity_within(d, e, longest)) return e;
    coefficients_of(d, s, e, &c0, c);
    nh_ex shown = c0, same = c0;
    for (int k = 0; k < 9; k++) {
        shown = nh_add(d, shown, nh_mul(d, c[k], o->entry_symbol[k]));
        same = nh_add(d, same, nh_mul(d, c[k], o->matrix[k]));
    }
    return nh_normal_is_zero(d, nh_sub(d, e, same), terms) == NH_ZERO ? nh_simplify_short(d, shown, 0) : e;
}

/* The largest parts of e that are linear in the entries. */
typedef struct {
    const nh_system *system;
    const nh_orientation *orientation;
    size_t parts, visits;
    nh_ex part[64], shown[64];
} parts_of;

static void collect(parts_of *p, nh_ex e)
{
    enum { most_visits = 2000 };
    nh_dag *d = p->system->dag;
    nh_kind kind = nh_kind_of(d, e);
    bool any = false;
    for (size_t k = 0; k < 3; k++) any |= nh_depends(d, e, p->system->coordinate[p->orientation->first + k].q);
    if (!any || p->parts == sizeof p->part / sizeof *p->part || ++p->visits > most_visits || kind == NH_SYMBOL) return;
    nh_ex shown = shown_by(p->system, p->orientation, e);
    if (shown != e) {
        p->part[p->parts] = e;
        p->shown[p->parts++] = shown;
        return;
    }
    for (size_t i = 0; i < nh_arity(d, e); i++) collect(p, nh_child(d, e, i));
}

nh_ex nh_orientation_shown(const nh_system *s, nh_ex e)
{
    for (size_t i = 0; i < s->orientations; i++) {
        parts_of p = {.system = s, .orientation = &s->orientation[i]};
        collect(&p, e);
        e = nh_substitute(s->dag, e, p.parts, p.part, p.shown);
    }
    return e;
}

nh_ex nh_orientation_unshown(const nh_system *s, nh_ex e)
{
    for (size_t i = 0; i < s->orientations; i++)
        e = nh_substitute(s->dag, e, 9, s->orientation[i].entry_symbol, s->orientation[i].matrix);
    return e;
}

/* ---- velocities where the file chooses none ---- */

/* The system whose velocities are those along the frame: the velocity symbols of an orientation's coordinates stand for
 * its angular velocities. */
static nh_system along_frame(nh_system_reader *r)
{
    nh_system *s = r->system, copy = *s;
    copy.orientations = 0;
    copy.constraint = nh_system_take(r, s->constraints, sizeof *copy.constraint);
    for (size_t a = 0; a < s->constraints; a++) {
        nh_ex f = s->constraint[a].framed;
        for (size_t i = 0; i < s->orientations; i++) {
            const nh_orientation *o = &s->orientation[i];
            for (size_t k = 0; k < 3; k++)
                f = nh_substitute(s->dag, f, 1, &o->framed[k], &s->coordinate[o->first + k].v);
        }
        copy.constraint[a] = s->constraint[a];
        copy.constraint[a].lhs = f;
        copy.constraint[a].rhs = nh_int(s->dag, 0);
    }
    return copy;
}

/* The velocity that belongs to the rate along the frame with this number. */
static nh_ex velocity_of(const nh_system *s, size_t i)
{
    const nh_orientation *o = nh_orientation_of(s, i);
    return o ? o->omega[i - o->first] : s->coordinate[i].v;
}

bool nh_orientation_velocities(nh_system_reader *r)
{
    nh_system *s = r->system, frame = along_frame(r);
    size_t m = s->coordinates;
    nh_chart *c = nh_embedding_coordinates(&frame, 1, r->error);
    if (!c) return false;
    if (c->implicit) {
        nh_chart_free(c);
        nh_deck_fail(r->deck, s->constraint[0].node, 0, r->error,
                     "constraints that are not linear in the velocities need `velocities:` beside an orientation");
        return nh_error_hint(r->error, "velocities: {names: [..], map: [\"%s = ..\", ..]}", s->orientation[0].word[0]);
    }
    s->quasi_velocity = nh_system_take(r, c->n, sizeof *s->quasi_velocity);
    s->quasi_framed = nh_system_take(r, m, sizeof *s->quasi_framed);
    s->quasi_map = nh_system_take(r, m, sizeof *s->quasi_map);
    for (size_t j = 0; j < c->n; j++) s->quasi_velocity[j] = velocity_of(s, c->free[j]);
    s->quasi = c->n;
    for (size_t i = 0; i < m; i++)
        s->quasi_framed[i] = nh_substitute(s->dag, c->rho[i], c->n, c->w, s->quasi_velocity);
    nh_orientation_map(s, s->quasi_framed, s->quasi_map);
    nh_chart_free(c);
    return true;
}
