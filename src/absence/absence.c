#include "absence/absence.h"

#include <string.h>

#include "absence/absence_internal.h"
#include "base/progress.h"

/* Without --absence one level of a few planes is tried, and nothing more once one of them decides. */
enum { USUAL_PLANES = 8, MOST_PLANES = 64, MOST_LEVELS = 3 };

/* Of all continuations along closed paths together: no other one begins then.  About 10 seconds. */
static const uint64_t most_work = (uint64_t)1 << 28;

/* ---- one attempt ---- */

/* Has the equation of a higher order excluded all integrals but functions of the energy? */
static bool by_higher(const nh_absence_attempt *attempt) { return attempt->higher && attempt->higher->refuted; }

/* How many independent integrals there can be, by this attempt, which has an equation. */
static size_t most_integrals(const nh_absence *absence, const nh_absence_attempt *attempt)
{
    return by_higher(attempt) ? 1 : absence->shape->count - 1 - attempt->orbit;
}

/* Does the class contain what has many values on the turning curve?  SL(2), its own commutator group, moves that too. */
static bool turns(const nh_absence_attempt *attempt)
{
    const nh_kovacic *kovacic = attempt->kovacic;
    return kovacic && kovacic->group == NH_GROUP_SL2 && kovacic->regular && attempt->orbit == 2;
}

/* Every integral of the class is a function of those found (2), or depends on them (1), by this attempt; else 0: so too
 * where one of them is not of the class. */
static int closes(const nh_absence *absence, const nh_absence_attempt *attempt)
{
    const nh_normal_equation *equation = attempt->equation;
    if (equation->obstacle) return 0;
    if (by_higher(attempt)) return absence->known == 1 ? 2 : 0;
    if (!attempt->orbit) return 0;
    if (attempt->rational && !equation->all_algebraic) return 0;
    if (attempt->orbit == equation->dimension) return equation->single_valued || turns(attempt) ? 2 : 0;
    if (!equation->all_single_valued && !turns(attempt)) return 0;
    return absence->known == absence->shape->count - 1 - attempt->orbit ? 1 : 0;
}

static bool generic(const nh_absence_attempt *attempt)
{
    return by_higher(attempt) ? attempt->higher->generic : attempt->equation->generic;
}

/* Does attempt a say more than b?  First what closes the list, then the larger class of functions, then generic
 * parameters, then the smaller number. */
static bool better(const nh_absence *absence, const nh_absence_attempt *a, const nh_absence_attempt *b)
{
    int x = closes(absence, a), y = closes(absence, b);
    if (x != y) return x > y;
    if (a->orbit != b->orbit && !x) return a->orbit > b->orbit;
    if (a->rational != b->rational) return b->rational;
    return generic(a) && !generic(b);
}

static bool enough(const nh_absence *absence, const nh_absence_attempt *attempt)
{
    return closes(absence, attempt) == 2 && !attempt->rational;
}

/* Was the same equation tried on another plane?  A reflection of the system exchanges planes. */
static bool tried(const nh_absence *absence, const nh_normal_equation *equation)
{
    for (size_t i = 0; i < absence->attempts; i++)
        if (nh_normal_equation_equal(absence->attempt[i].equation, equation)) return true;
    return false;
}

/* Why no monodromy is tried now, or NULL. */
static const char *without_monodromy(const nh_absence *absence)
{
    uint64_t work = 0;
    if (!absence->everything) return "its equation has more than two unknowns, which --absence tries";
    for (size_t i = 0; i < absence->attempts; i++)
        work += absence->attempt[i].monodromy ? absence->attempt[i].monodromy->work : 0;
    return work >= most_work ? "the continuation along closed paths takes too much work" : NULL;
}

/* Tries one plane at its levels; true: nothing better can come. */
static bool try_plane(nh_arena *arena, nh_absence *absence, const nh_plane *plane, const nh_known_integrals *known)
{
    size_t levels = absence->everything ? MOST_LEVELS : 1;
    for (size_t n = 0; n < levels && !nh_interrupted(); n++) {
        nh_absence_attempt *attempt = &absence->attempt[absence->attempts];
        *attempt = (nh_absence_attempt){.equation = nh_normal_equation_of(arena, absence->shape, plane, known, n)};
        if (attempt->equation->obstacle) {
            attempt->obstacle = attempt->equation->obstacle;
            absence->attempts += n == 0; /* the same obstacle at another level says nothing more */
            return false;
        }
        if (tried(absence, attempt->equation)) {
            nh_normal_equation_clear(attempt->equation);
            continue;
        }
        const char *without = without_monodromy(absence);
        if (!nh_absence_attempt_run(arena, absence->shape, attempt, absence->everything, without)) {
            nh_normal_equation_clear(attempt->equation);
            return false;
        }
        if (absence->best == SIZE_MAX || better(absence, attempt, &absence->attempt[absence->best]))
            absence->best = absence->attempts;
        absence->attempts++;
        if (enough(absence, attempt)) return !absence->everything;
    }
    return false;
}

static void try_planes(nh_arena *arena, nh_absence *absence, const nh_known_integrals *known)
{
    nh_plane *plane;
    absence->planes = nh_planes_find(arena, absence->shape, &plane);
    size_t most = absence->everything ? MOST_PLANES : USUAL_PLANES;
    size_t count = absence->planes < most ? absence->planes : most;
    absence->attempt = nh_arena_alloc(arena, (count * MOST_LEVELS + 1) * sizeof *absence->attempt);
    absence->best = SIZE_MAX;
    for (size_t i = 0; i < count && !nh_interrupted(); i++)
        if (try_plane(arena, absence, &plane[i], known)) break;
    for (size_t i = 0; i < absence->attempts; i++)
        if (!absence->attempt[i].equation->obstacle) nh_normal_equation_clear(absence->attempt[i].equation);
    if (absence->best == SIZE_MAX) absence->best = absence->attempts;
    else if (!absence->attempt[absence->best].orbit && !closes(absence, &absence->attempt[absence->best]))
        absence->best = absence->attempts;
}

/* ---- what follows ---- */

/* Lagrange's equations alone: no forces, no constraints, no letters left without their coordinates. */
static bool lagrangian(const nh_closed_shape *shape)
{
    const nh_model *model = shape->model;
    if (model->k) return false;
    for (size_t s = 0; s < model->m; s++)
        if (model->system->force && !nh_is_zero(model->dag, model->system->force[s])) return false;
    return true;
}

/* Do all integrals hold for all values of the parameters? */
static bool all_generic(const nh_known_integrals *known)
{
    bool all = true;
    for (size_t k = 0; k < known->count; k++) all = all && known->generic[k];
    return all;
}

/* What depends on the integrals found depends on all of them, also on those whose differentials vanish along the
 * motion. */
static void from_attempt(nh_absence *absence, const nh_known_integrals *known)
{
    const nh_absence_attempt *a = &absence->attempt[absence->best];
    int closed = closes(absence, a);
    absence->verdict = closed == 2 ? NH_ABSENCE_NONE_ELSE : closed == 1 ? NH_ABSENCE_DEPENDENT : NH_ABSENCE_AT_MOST;
    absence->at_most = most_integrals(absence, a);
    absence->rational = a->rational;
    /* SL(2) is its own commutator group, so a covering of the motion that opens an angle has it, too */
    bool own = a->kovacic && a->kovacic->group == NH_GROUP_SL2 && a->orbit <= 2;
    absence->periodic = a->equation->periodic && !own;
    absence->generic = generic(a) && (closed != 1 || all_generic(known));
}

/* A straight line of a homogeneous potential: two degrees of freedom have no integral besides the energy; more are not
 * integrable by commuting integrals. */
static void from_darboux(nh_absence *absence)
{
    enum { plane_letters = 4 };
    const nh_darboux *darboux = absence->darboux;
    if (!darboux || !darboux->refuted || absence->best < absence->attempts) return;
    bool plane = absence->shape->count == plane_letters;
    absence->verdict = !plane ? NH_ABSENCE_LIOUVILLE : absence->known ? NH_ABSENCE_NONE_ELSE : NH_ABSENCE_AT_MOST;
    absence->at_most = plane ? 1 : absence->at_most;
    absence->generic = darboux->generic;
    if (plane && absence->known > 1)
        absence->contradiction = "a straight line of the homogeneous potential allows no integral besides the energy, "
                                 "and one is proved";
}

/* A group that is not virtually abelian, though its orbits leave room for integrals: those of a Lagrangian system do
 * not all commute. */
static void from_group(nh_absence *absence)
{
    if (absence->verdict != NH_ABSENCE_OPEN && absence->verdict != NH_ABSENCE_AT_MOST) return;
    if (absence->at_most < absence->shape->count / 2 || !lagrangian(absence->shape)) return;
    for (size_t i = 0; i < absence->attempts; i++) {
        const nh_kovacic *kovacic = absence->attempt[i].kovacic;
        if (!kovacic || (kovacic->group != NH_GROUP_SL2 && kovacic->group != NH_GROUP_TRIANGULAR)) continue;
        absence->verdict = NH_ABSENCE_LIOUVILLE;
        absence->best = i;
        absence->rational = !kovacic->regular;
        absence->generic = absence->attempt[i].equation->generic;
        return;
    }
}

/* Are all integrals found of the class of which the attempt speaks? */
static bool speaks_of_all(const nh_absence_attempt *attempt)
{
    const nh_normal_equation *equation = attempt->equation;
    return equation->all_single_valued && (equation->all_algebraic || !attempt->rational);
}

/* A theorem that allows fewer integrals than are proved to exist is an error of the program. */
static void compare(nh_arena *arena, nh_absence *absence)
{
    for (size_t i = 0; i < absence->attempts; i++) {
        const nh_absence_attempt *a = &absence->attempt[i];
        size_t at_most = most_integrals(absence, a);
        if (a->equation->obstacle || absence->known <= at_most || !speaks_of_all(a)) continue;
        absence->contradiction =
            nh_arena_printf(arena, "the motions %s allow at most %zu independent integrals, and %zu are proved",
                            a->equation->plane->words, at_most, absence->known);
    }
}

/* The first obstacle, in the order of the steps. */
static const char *first_obstacle(const nh_absence *absence)
{
    if (absence->shape->obstacle) return absence->shape->obstacle;
    if (!absence->planes) return "no motion was found that moves one coordinate and leaves all others at rest";
    return absence->attempts ? absence->attempt[0].obstacle : "the computation was ended";
}

static void conclude(nh_arena *arena, nh_absence *absence, const nh_known_integrals *known)
{
    absence->at_most = absence->shape->count - 1;
    if (absence->best < absence->attempts) from_attempt(absence, known);
    from_darboux(absence);
    from_group(absence);
    compare(arena, absence);
    if (absence->verdict == NH_ABSENCE_OPEN) absence->obstacle = first_obstacle(absence);
}

/* The smallest shape, with the coordinates that the energy needs where it is conserved: it determines the curves. */
static nh_closed_shape *shape_of(const nh_analysis *analysis)
{
    const nh_model *model = analysis->question->model;
    bool conserved = false;
    for (size_t k = 0; k < analysis->list->count; k++) conserved |= analysis->list->found[k].energy;
    return nh_closed_shape_keeping(analysis->arena, model, conserved ? 1 : 0, &model->E);
}

void nh_absence_find(struct nh_analysis *analysis, bool everything)
{
    nh_arena *arena = analysis->arena;
    nh_absence *absence = analysis->absence = nh_arena_alloc(arena, sizeof *absence);
    absence->everything = everything;
    absence->shape = shape_of(analysis);
    if (absence->shape->obstacle) {
        absence->obstacle = absence->shape->obstacle;
        return;
    }
    nh_known_integrals known = nh_absence_known(analysis, absence);
    if (absence->known + 1 >= absence->shape->count) {
        absence->verdict = NH_ABSENCE_SETTLED;
        absence->at_most = absence->known;
        return;
    }
    try_planes(arena, absence, &known);
    bool decided = absence->best < absence->attempts && enough(absence, &absence->attempt[absence->best]);
    if (everything || !decided) absence->darboux = nh_darboux_of(arena, absence->shape);
    if (everything || !decided) absence->resonances = nh_resonance_find(arena, absence->shape, &absence->resonance);
    if (nh_interrupted()) { /* what was computed afterwards proves nothing */
        absence->darboux = NULL;
        absence->resonances = 0;
    }
    conclude(arena, absence, &known);
}
