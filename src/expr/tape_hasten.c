/* tape_hasten: when is a tape worth compiling? */

#include "base/clock.h"
#include "base/memory.h"
#include "expr/tape_internal.h"

enum { first_look = 500, timed = 5 };
static const double price = 0.05, price_each = 2e-4; /* seconds that compiling takes: at all, and per instruction (docs/performance.md) */
static const double between_looks = 2e-3;              /* seconds while the compiler runs */

void nh_tape_hasten(nh_tape_work *work, double patience)
{
    work->patience = patience;
    work->left = patience > 0 && !work->code ? first_look : 0;
}

/* The least of some evaluations at this point. */
static double time_one(const nh_tape *tape, nh_tape_work *work, const double *in)
{
    double least = 1;
    double *out = nh_alloc_array(tape->outputs + 1, sizeof *out);
    for (int i = 0; i < timed; i++) {
        double begun = nh_clock(), seconds;
        for (int k = 0; k < timed; k++) nh_tape_eval(tape, work, in, out);
        seconds = (nh_clock() - begun) / timed;
        if (seconds < least) least = seconds;
    }
    nh_free(out);
    return least > 1e-9 ? least : 1e-9;
}

static uint64_t evaluations_in(const nh_tape_work *work, double seconds)
{
    double n = seconds / work->each;
    return n < 1 ? 1 : n > 1e18 ? 1000000000000000000u : (uint64_t)n;
}

static void start(const nh_tape *tape, nh_tape_work *work)
{
    work->machine = nh_machine_of(tape);
    if (!work->machine) work->words = "not compiled: it is too long, or there is too much machine code already";
}

void nh_tape_look(const nh_tape *tape, nh_tape_work *work, const double *in)
{
    bool busy = false;
    if (work->each == 0) {
        work->each = time_one(tape, work, in);
        work->left = evaluations_in(work, work->patience * (price + price_each * (double)tape->length));
        work->machine = nh_machine_known(tape);
        if (!work->machine) return; /* otherwise another motion has paid for it */
    }
    if (!work->machine) start(tape, work);
    if (work->machine) work->code = nh_machine_get(work->machine, false, &busy);
    work->left = busy ? evaluations_in(work, between_looks) : 0;
}

bool nh_tape_compile(const nh_tape *tape, nh_tape_work *work)
{
    bool busy = false;
    if (!work->machine) start(tape, work);
    if (work->machine) work->code = nh_machine_get(work->machine, true, &busy);
    work->left = 0;
    return work->code != NULL;
}

const char *nh_tape_words(const nh_tape_work *work) { return work->machine ? nh_machine_words(work->machine) : work->words; }
