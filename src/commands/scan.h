/* scan: numbers of a system at every point of a grid of parameter values, and the values at which they jump.
 *
 * A grid is the product of one list of exact values for each parameter. At each point a source gives numbers, of which
 * the first leads: where it jumps there is a special value. Beside them stand the smallest generalized singular values
 * of a few ansatz spaces, nearly continuous functions of the parameter that vanish where such a space holds one more
 * current: between two points of the grid a special value shows as a dip of one of them.
 *
 * Points, and afterwards jumps, are items of a sweep (base/sweep.h) in a folder; the folder's manifest says what was
 * asked. Dips that are narrower than the grid, and currents outside of the ansatz spaces, are missed. */
#ifndef NH_SCAN_H
#define NH_SCAN_H

#include "base/option.h"
#include "base/sweep.h"
#include "system/system.h"

enum { NH_SCAN_MOST_AXES = 4, NH_SCAN_MOST_NUMBERS = 32, NH_SCAN_MOST_SPACES = 32 };

/* Exactly top/bottom; text: "5/2". */
typedef struct {
    double value;
    int64_t top, bottom;
    const char *text;
} nh_scan_value;

typedef struct {
    const char *name; /* a parameter */
    size_t count;
    nh_scan_value *value;
    bool ascending; /* then jumps and dips are looked for along it */
} nh_scan_axis;

/* Reads "k=1:4:61" or "k=1,2,5/2"; the caller checks whether the system has such a parameter. */
bool nh_scan_read_axis(nh_arena *arena, const char *text, nh_scan_axis *out, nh_error *error);

/* The numbers that a scan computes at a point. */
typedef struct {
    const char *of; /* "count", "analyze", "reduce" */
    size_t count;
    const char *const *name; /* the first leads */
    bool usual;              /* these are the numbers that `of` has by default */
    bool spectra;            /* the ansatz spaces are computed, too */
    /* The numbers with these settings, exact ones for the parameters of the grid; a number that is not there is NAN,
     * and *why is the reason, in the arena. `generic`: for almost all values of the parameters instead; the settings
     * are only starting values then. False: interrupted. */
    bool (*at)(void *context, nh_arena *arena, size_t settings, const nh_setting *setting, bool generic, double *number,
               const char **why);
    void *context;
} nh_scan_source;

typedef struct {
    const char *system_path;
    size_t settings;
    const nh_setting *setting;
    size_t axes;
    const char *const *over; /* "k=1:4:61", "k=1,2,5/2" */
    const nh_scan_source *source;
    nh_options options;
    const char *program; /* which program answers: version and build */
    const char *folder;
    size_t chunk, chunks; /* a part of the points, as in base/sweep.h */
    size_t workers;
    void (*begin_worker)(void);
    const nh_team *team;
} nh_scan_request;

typedef struct {
    double *number; /* numbers of the source */
    /* for each ansatz space the smallest generalized singular value that does not vanish; NAN */
    double *smallest;
    size_t *vanishing; /* for each ansatz space the number of those that vanish */
    const char *why;   /* why numbers are missing; or NULL */
    bool done;
} nh_scan_row;

typedef enum { NH_SCAN_HIT, NH_SCAN_STEP, NH_SCAN_DIP } nh_scan_kind;

/* A value at which something jumps. */
typedef struct {
    nh_scan_kind kind;  /* at a point of the grid; at an end of a region; between points */
    size_t axis, place; /* the axis; the index of the point, or of the one below */
    double value;
    const char *exact;   /* "1/3", "pi/6", or NULL: not recognised */
    double *number;      /* the numbers of the source there, where the value is confirmed; else NAN */
    double generic;      /* the leading number around it; for a step NAN */
    double below, above; /* the leading number at the points beside it */
    double smallest;     /* of a dip: the singular value there, relative to those at the points beside it */
    const char *space;   /* of a dip: the ansatz space that contains one more current there */
    bool confirmed;      /* with the exact value the source gives another leading number */
    const char *why;     /* why it does not; or NULL */
} nh_scan_special;

typedef struct {
    nh_arena *arena;
    nh_system *system; /* with the settings */
    const nh_scan_source *source;
    size_t axes, points, spaces;
    nh_scan_axis axis[NH_SCAN_MOST_AXES];
    const char *question; /* everything on which the answer depends, as a command line */
    const char **space;   /* names of the ansatz spaces */
    size_t *columns;      /* number of their functions */
    size_t *usual;        /* number of singular values that vanish at most points */
    nh_scan_row *row;
    size_t specials, unrefined; /* unrefined: jumps that were not examined yet */
    nh_scan_special *special;
    size_t units, finished; /* of the chunk */
    double unit_seconds;    /* seconds that a unit was estimated to take */
    size_t deaths;
    const char *death;
    bool partial, chunked; /* something is missing; only a chunk was computed */
    bool silent;           /* another member of the team prints the result */
} nh_scan;

/* Scans; the caller frees the result.  NULL: bad input, a folder that contains another scan, or one that cannot be
 * written. */
nh_scan *nh_scan_create(const nh_scan_request *request, nh_error *error);
void nh_scan_free(nh_scan *scan);

/* The value of an axis at a point of the grid; the last axis varies fastest. */
const nh_scan_value *nh_scan_at(const nh_scan *scan, size_t point, size_t axis);

/* The smallest singular value of a space that does not vanish at most points: 0 where it vanishes; or NAN. */
double nh_scan_sigma(const nh_scan *scan, size_t point, size_t space);

#endif
