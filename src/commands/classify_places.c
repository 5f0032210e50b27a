/* The places of a classification: what is special, from the highest dimension down, without what only lies on something
 * with as many integrals; and their words. */
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "commands/classify_internal.h"
#include "graph/node.h"
#include "graph/num.h"

/* ---- words ---- */

/* The coefficient of v^power as text, or, for v < 0, the whole polynomial; highest powers first. */
static void put_polynomial(const nh_classified *x, const nh_special_factor *s, int v, size_t power, bool negative,
                           nh_text *out)
{
    size_t width = s->degree[0] + 1, each = width * (s->degree[1] + 1), written = 0;
    for (size_t i = s->degree[0] + 1; i-- > 0;)
        for (size_t j = s->degree[1] + 1; j-- > 0;)
            for (size_t k = s->degree[2] + 1; k-- > 0;) {
                int64_t a = s->coefficient[k * each + j * width + i];
                size_t e[3] = {i, j, k}, left = 0;
                if (!a || (v >= 0 && e[v] != power)) continue;
                if (v >= 0) e[v] = 0;
                for (int w = 0; w < 3; w++) left += e[w] > 0;
                bool minus = (a < 0) != negative;
                uint64_t size = a < 0 ? 0 - (uint64_t)a : (uint64_t)a;
                nh_text_add(out, written++ == 0 ? (minus ? "-" : "") : minus ? " - " : " + ");
                if (size != 1 || !left) nh_text_addf(out, "%" PRIu64 "%s", size, left ? "*" : "");
                for (int w = 0; w < 3; w++) {
                    if (!e[w]) continue;
                    nh_text_add(out, x->over[w]);
                    if (e[w] > 1) nh_text_addf(out, "^%zu", e[w]);
                    if (--left) nh_text_add(out, "*");
                }
            }
    if (!written) nh_text_add(out, "0");
}

const char *nh_classified_equation(const nh_classified *x, const nh_special_factor *s)
{
    nh_text text;
    nh_text_init(&text);
    put_polynomial(x, s, -1, 0, false, &text);
    const char *out = nh_arena_printf(x->arena, "%s = 0", nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

const char *nh_classified_ratio(nh_arena *arena, int64_t top, int64_t bottom)
{
    return nh_arena_printf(arena, bottom == 1 ? "%" PRId64 : "%" PRId64 "/%" PRId64, top, bottom);
}

const char *nh_classified_words(const nh_classified *x, const nh_special_factor *s)
{
    int64_t top, bottom;
    int v = nh_special_variable(s, 0);
    if (nh_special_rational(s, &top, &bottom))
        return nh_arena_printf(x->arena, "%s = %s", x->over[v], nh_classified_ratio(x->arena, top, bottom));
    static const double none[NH_MOST_PARAMETERS] = {0};
    double *root = nh_alloc_array(s->degree[v] + 1, sizeof *root);
    size_t reals = nh_special_reals(s, v, none, root);
    nh_text text;
    nh_text_init(&text);
    nh_text_addf(&text, reals ? "%s (%s = " : "%s (no real value", nh_classified_equation(x, s), x->over[v]);
    for (size_t k = 0; k < reals; k++) nh_text_addf(&text, "%s%.8g", k ? ", " : "", root[k]);
    nh_text_add(&text, ")");
    nh_free(root);
    const char *out = nh_arena_strdup(x->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

const char *nh_classified_graph(const nh_classified *x, const nh_special_factor *s, int v)
{
    nh_text top, bottom;
    nh_text_init(&top);
    nh_text_init(&bottom);
    put_polynomial(x, s, v, 0, true, &top);
    put_polynomial(x, s, v, 1, false, &bottom);
    const char *out = !strcmp(nh_text_string(&bottom), "1")
                          ? nh_arena_strdup(x->arena, nh_text_string(&top))
                          : nh_arena_printf(x->arena, "(%s)/(%s)", nh_text_string(&top), nh_text_string(&bottom));
    nh_text_clear(&bottom);
    nh_text_clear(&top);
    return out;
}

/* "B = 1, eps = 1/3   (on B - 1 = 0)" */
static const char *words_of_point(const nh_classified *x, const nh_classified_place *p)
{
    nh_text text;
    nh_text_init(&text);
    for (size_t v = x->parameters; v-- > 0;) {
        if (text.length) nh_text_add(&text, ", ");
        if (isfinite(p->about[v])) nh_text_addf(&text, "%s = ", x->over[v]);
        nh_text_add(&text, p->value[v]);
    }
    if (x->parameters == 2 && p->on) nh_text_addf(&text, "   (on %s)", nh_classified_equation(x, p->on));
    const char *out = nh_arena_strdup(x->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

/* ---- what is new ---- */

static void add_place(nh_classified *x, const nh_classified_place *p)
{
    nh_grow(&x->place, &x->place_capacity, x->places + 1, sizeof *x->place);
    x->place[x->places++] = *p;
}

/* Is there a degree with more integrals here than there? */
static bool has_more(const nh_classified *x, const nh_classify_number *here, const nh_classify_number *there)
{
    bool any = false;
    for (size_t d = 1; d <= x->classification->rows; d++)
        any |= here[d].bounded && there[d].bounded && here[d].bound > there[d].bound;
    return any;
}

/* Has the place, which was found within this part, more than everything else on which it lies? */
static bool is_new(const nh_classified *x, const nh_classified_part *within, const nh_classified_place *p)
{
    bool fresh = true;
    for (size_t k = 0; k < x->classification->specials && fresh; k++) {
        const nh_classify_special *s = &x->classification->special[k];
        if (s != within->special && nh_special_contains(&s->polynomial, &p->zeros))
            fresh = !s->degenerate && has_more(x, p->number, s->number);
    }
    for (size_t k = 0; k < x->places && fresh; k++) {
        const nh_classified_place *other = &x->place[k];
        bool inside = other->dimension + 1 < x->parameters;
        for (size_t i = 0; i < other->zeros.count && inside; i++)
            inside = nh_special_contains(&other->zeros.equation[i], &p->zeros);
        if (inside) fresh = has_more(x, p->number, other->number);
    }
    return fresh;
}

/* ---- from within ---- */

/* The value of a name in a system that was read, as a ratio. */
static bool number_of(const nh_system *system, const char *name, nh_num *out)
{
    for (size_t i = 0; i < system->definitions; i++) {
        if (strcmp(system->definition[i].name, name) ||
            nh_kind_of(system->dag, system->definition[i].value) != NH_NUMBER)
            continue;
        *out = nh_number_of(system->dag, system->definition[i].value);
        return true;
    }
    return false;
}

/* The place as one of all parameters: the equation of the part gives one of them, the others follow in their order. */
static nh_classified_place lifted(const nh_classified *x, const nh_classified_part *part,
                                  const nh_classified_place *from)
{
    int other[NH_MOST_PARAMETERS], others = 0;
    for (int v = 0; v < NH_MOST_PARAMETERS; v++)
        if (v != part->gives) other[others++] = v;
    nh_classified_place out = *from;
    out.on = part->polynomial;
    out.zeros = (nh_special_place){.count = 1, .gives = {part->gives}, .equation = {*part->polynomial}};
    for (size_t k = 0; k < from->zeros.count; k++) {
        nh_special_factor *to = &out.zeros.equation[out.zeros.count];
        *to = (nh_special_factor){.coefficient = from->zeros.equation[k].coefficient};
        for (int v = 0; v < others; v++) to->degree[other[v]] = from->zeros.equation[k].degree[v];
        out.zeros.gives[out.zeros.count++] = other[from->zeros.gives[k]];
    }
    if (out.dimension) {
        out.where = nh_arena_printf(x->arena, "%s, %s", part->graph, from->where);
        return out;
    }
    for (int v = 0; v < others; v++) {
        out.value[other[v]] = from->value[v];
        out.about[other[v]] = from->about[v];
    }
    int64_t top, bottom;
    nh_num number = {0};
    bool known = nh_special_rational(part->polynomial, &top, &bottom);
    if (known) number = nh_num_ratio(top, bottom);
    else
        known = from->finding.result &&
                number_of(from->finding.result->question->system, x->over[part->gives], &number) &&
                nh_num_short(number);
    out.value[part->gives] = known ? nh_classified_ratio(x->arena, number.p, number.q) : part->graph;
    out.about[part->gives] = known ? nh_num_value(number) : NAN;
    out.where = words_of_point(x, &out);
    return out;
}

/* What is special within the parts. */
static void take_within(nh_classified *x, size_t dimension)
{
    for (size_t k = 0; k < x->parts; k++) {
        const nh_classified *within = x->part[k].within;
        for (size_t i = 0; within && i < within->places; i++) {
            if (within->place[i].dimension != dimension) continue;
            nh_classified_place p = lifted(x, &x->part[k], &within->place[i]);
            if (is_new(x, &x->part[k], &p)) add_place(x, &p);
        }
    }
}

/* ---- of their own ---- */

/* Special values, curves or surfaces. */
static void take_specials(nh_classified *x)
{
    for (size_t k = 0; k < x->classification->specials; k++) {
        const nh_classify_special *v = &x->classification->special[k];
        if (!v->first || v->degenerate) continue;
        nh_classified_place p = {.dimension = x->parameters - 1,
                                 .zeros = {.count = 1, .gives = {x->part[k].gives}, .equation = {v->polynomial}},
                                 .where = nh_classified_equation(x, &v->polynomial),
                                 .about = {NAN, NAN, NAN},
                                 .first = v->first,
                                 .number = v->number,
                                 .finding = x->part[k].finding};
        if (x->parameters == 1) {
            int64_t top, bottom;
            bool rational = nh_special_rational(&v->polynomial, &top, &bottom);
            p.where = nh_classified_words(x, &v->polynomial);
            p.value[0] = rational ? nh_classified_ratio(x->arena, top, bottom) : p.where;
            if (rational) p.about[0] = (double)top / (double)bottom;
        }
        add_place(x, &p);
    }
}

/* A point that the classification on a line mu = top/bottom found. */
static void take_isolated(nh_classified *x, const nh_classify_request *q, const nh_classify_point *at)
{
    const nh_classify_wall *wall = &x->classification->wall[at->wall];
    nh_classify_special *v = &wall->within->special[at->value];
    int64_t top[2], bottom[2];
    bool rational = nh_special_rational(&v->polynomial, &top[0], &bottom[0]);
    nh_special_rational(&wall->polynomial, &top[1], &bottom[1]);
    nh_classified_place p = {.zeros = {.count = 2, .gives = {1}, .equation = {wall->polynomial, v->polynomial}},
                             .first = v->first,
                             .number = v->number,
                             .finding = {.why = "currents are constructed at rational values only"}};
    nh_setting setting[2];
    for (int k = 0; k < 2; k++) {
        bool known = k || rational;
        p.value[k] = known ? nh_classified_ratio(x->arena, top[k], bottom[k]) : nh_classified_words(x, &v->polynomial);
        p.about[k] = known ? (double)top[k] / (double)bottom[k] : NAN;
        if (known)
            setting[k] = (nh_setting){.name = x->over[k], .value = p.about[k], .top = top[k], .bottom = bottom[k]};
    }
    if (rational) nh_classified_analyse(x, q, setting, v, &p.finding);
    p.where = words_of_point(x, &p);
    add_place(x, &p);
}

void nh_classified_list_places(nh_classified *x, const nh_classify_request *q)
{
    take_specials(x);
    for (size_t k = 0; k < x->classification->points && !nh_interrupted(); k++)
        take_isolated(x, q, &x->classification->point[k]);
    for (size_t dimension = x->parameters - 1; dimension-- > 0;) take_within(x, dimension);
}
