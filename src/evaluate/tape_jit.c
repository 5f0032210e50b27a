/* tape_jit: decides when a tape is compiled.  The decision is counted, not timed: the same evaluation of every run
 * starts the compiler.  The code is used as soon as it is ready, which varies, but it computes the same bits. */

#include "base/memory.h"
#include "evaluate/machine.h"
#include "evaluate/tape_internal.h"

enum { first_look = 500 };
/* units of effort that compiling costs: per tape, and per instruction (docs/performance.md) */
static const double price = 5e7, price_each = 2e5;
static const double between_looks = 2e6; /* units of effort between two looks while the compiler runs */

double nh_op_effort(unsigned op)
{
    static const double plain = 1.2, division = 2.5, root = 4, power = 25, function = 12, named = 5000, table = 60;
    if (op == NH_OP_SQRT) return root;
    if (op == NH_OP_POW) return power;
    if (op == NH_OP_FUNCTION + NH_TABLE) return table;
    if (op >= NH_OP_FUNCTION) return nh_op_is_named(op) ? named : function;
    return op == NH_OP_DIV || op == NH_OP_INV ? division : plain;
}

static uint64_t evaluations_in(const nh_tape *tape, double units)
{
    double n = units / tape->effort;
    return n < 1 ? 1 : n > 1e18 ? 1000000000000000000u : (uint64_t)n;
}

void nh_tape_jit(nh_tape_work *work, double patience)
{
    work->patience = patience;
    work->left = patience > 0 && !work->code ? first_look : 0;
}

static void start(const nh_tape *tape, nh_tape_work *work)
{
    work->machine = nh_machine_of(tape);
    if (!work->machine)
        work->words = "not compiled: it is too long, has functions that C does not know, or there is too much machine "
                      "code already";
}

void nh_tape_look(const nh_tape *tape, nh_tape_work *work)
{
    bool busy = false;
    if (!work->looked) {
        work->looked = true;
        work->left = evaluations_in(tape, work->patience * (price + price_each * (double)tape->length));
        work->machine = nh_machine_known(tape);
        if (!work->machine) return; /* otherwise another motion has already started the compiler */
    }
    if (!work->machine) start(tape, work);
    if (work->machine) work->code = nh_machine_get(work->machine, false, &busy);
    work->left = busy ? evaluations_in(tape, between_looks) : 0;
}

bool nh_tape_compile(const nh_tape *tape, nh_tape_work *work)
{
    bool busy = false;
    if (!work->machine) start(tape, work);
    if (work->machine) work->code = nh_machine_get(work->machine, true, &busy);
    work->left = 0;
    return work->code != NULL;
}

const char *nh_tape_words(const nh_tape_work *work)
{
    return work->machine ? nh_machine_words(work->machine) : work->words;
}
