/* mpi_main: nhsym-mpi, whose processes share the units of one scan; the only file that knows MPI.
 *
 * A thread of rank 0 gives out numbers of units, so that no rank waits while another computes.  Results go through the
 * folder, which all ranks see; nothing else is sent.  Waiting processes and the thread sleep instead of spinning.
 * Where MPI does not allow threads every rank takes each size-th unit. */
#include <mpi.h>
#include <pthread.h>
#include <stdatomic.h>
#include <time.h>

#include "cli/cli.h"

enum { tag_ask = 1, tag_answer = 2 };

typedef struct {
    int rank, size;
    bool served;        /* rank 0 has the thread */
    atomic_size_t next; /* rank 0: the next unit */
    size_t mine;        /* without thread: how many this rank had */
    atomic_bool done;
    pthread_t server;
} team;

static void sleep_shortly(void)
{
    static const struct timespec moment = {0, 1000000};
    nanosleep(&moment, NULL);
}

/* ---- rank 0 ---- */

static void *serve(void *context)
{
    team *t = context;
    while (!atomic_load(&t->done)) {
        int asked;
        MPI_Status who;
        MPI_Iprobe(MPI_ANY_SOURCE, tag_ask, MPI_COMM_WORLD, &asked, &who);
        if (!asked) {
            sleep_shortly();
            continue;
        }
        MPI_Recv(NULL, 0, MPI_BYTE, who.MPI_SOURCE, tag_ask, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        unsigned long long number = atomic_fetch_add(&t->next, 1);
        MPI_Send(&number, 1, MPI_UNSIGNED_LONG_LONG, who.MPI_SOURCE, tag_answer, MPI_COMM_WORLD);
    }
    return NULL;
}

/* ---- all of them ---- */

static size_t next_unit(void *context)
{
    team *t = context;
    unsigned long long number;
    if (!t->served) return (size_t)t->rank + (size_t)t->size * t->mine++;
    if (t->rank == 0) return atomic_fetch_add(&t->next, 1);
    MPI_Request answer;
    MPI_Irecv(&number, 1, MPI_UNSIGNED_LONG_LONG, 0, tag_answer, MPI_COMM_WORLD, &answer);
    MPI_Send(NULL, 0, MPI_BYTE, 0, tag_ask, MPI_COMM_WORLD);
    for (int here = 0; MPI_Test(&answer, &here, MPI_STATUS_IGNORE), !here;) sleep_shortly();
    return (size_t)number;
}

static void wait_for_all(void)
{
    MPI_Request all;
    MPI_Ibarrier(MPI_COMM_WORLD, &all);
    for (int here = 0; MPI_Test(&all, &here, MPI_STATUS_IGNORE), !here;) sleep_shortly();
}

/* Between both barriers nobody asks for a unit. */
static void meet(void *context)
{
    team *t = context;
    wait_for_all();
    atomic_store(&t->next, 0);
    t->mine = 0;
    wait_for_all();
}

int main(int argc, char **argv)
{
    team t = {.size = 1};
    int level, code, failure;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_MULTIPLE, &level);
    MPI_Comm_rank(MPI_COMM_WORLD, &t.rank);
    MPI_Comm_size(MPI_COMM_WORLD, &t.size);
    t.served =
        t.rank == 0 && t.size > 1 && level >= MPI_THREAD_MULTIPLE && pthread_create(&t.server, NULL, serve, &t) == 0;
    bool server = t.served;
    MPI_Bcast(&t.served, 1, MPI_C_BOOL, 0, MPI_COMM_WORLD);
    nh_team shared = {.rank = (size_t)t.rank, .size = (size_t)t.size, .next = next_unit, .meet = meet, .context = &t};
    code = nh_cli_main(argc, argv, &shared);
    failure = code == NH_USAGE || code == NH_INPUT || code == NH_NUMERIC;
    if (failure && t.size > 1) MPI_Abort(MPI_COMM_WORLD, code); /* other ranks may wait for this one */
    if (t.size > 1) wait_for_all();
    atomic_store(&t.done, true);
    if (server) pthread_join(t.server, NULL);
    MPI_Finalize();
    return code;
}
