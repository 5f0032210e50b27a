/* new: a system file to start from. */
#include <fcntl.h>
#include <errno.h>
#include <string.h>
#include <unistd.h>

#include "cli/cli.h"
#include "graph/parse.h"

/* %s: the name, twice. */
static const char pattern[] =
    "# A system for nhsym.  `nhsym analyze %s.yaml` analyses it; change it line by line.\n"
    "name: %s\n"
    "title: A skate on a slope\n"
    "# source: the publication that describes the system\n"
    "\n"
    "parameters:                  # fixed numbers; --set m=3 overrides one\n"
    "  - {name: m, value: 2, unit: kg, doc: mass}\n"
    "  - {name: J, value: 0.5, unit: kg m^2, doc: moment of inertia}\n"
    "  - {name: b, value: 3, unit: m/s^2, doc: acceleration down the slope}\n"
    "\n"
    "coordinates:                 # type: angle, length or number\n"
    "  - {name: phi, type: angle, doc: heading}\n"
    "  - {name: x, type: length, unit: m, doc: down the slope}\n"
    "  - {name: y, type: length, unit: m, doc: across it}\n"
    "\n"
    "# definitions:               # names for expressions, in order; X' is the time derivative of X\n"
    "#   - X = x + 0.3*cos(phi)\n"
    "\n"
    "# Kinetic minus potential energy.  x' is the velocity of x; t, sin, cos, sqrt, exp, log, ... can be used.\n"
    "lagrangian: m/2*(x'^2 + y'^2) + J/2*phi'^2 + m*b*x\n"
    "\n"
    "constraints:                 # equations between velocities or positions; omit the list if there are none\n"
    "  - y'*cos(phi) = x'*sin(phi)\n"
    "\n"
    "# velocities:                # of your own choice, where the coordinate velocities break down\n"
    "#   names: [omega, v]\n"
    "#   map: [phi' = omega, x' = v*cos(phi), y' = v*sin(phi)]\n"
    "\n"
    "# forces:                    # generalized forces without a potential\n"
    "#   - phi = -0.01*phi'\n";

int nh_cli_new(nh_cli *cli, nh_error *error)
{
    const char *name = cli->operands == 1 ? cli->operand[0] : NULL;
    if (!name || !nh_is_name(name)) {
        if (!name) nh_fail(error, NH_USAGE, "", "`nhsym new` takes one name");
        else nh_fail(error, NH_USAGE, "", "`%s` is not a name: a name is a letter, then letters, digits and _", name);
        nh_error_hint(error, "`nhsym new skate` writes skate.yaml");
        return NH_USAGE;
    }
    const char *path = nh_arena_printf(cli->arena, "%s.yaml", name);
    int file = open(path, O_WRONLY | O_CREAT | O_EXCL, 0666); /* never over a file that is there */
    FILE *stream = file < 0 ? NULL : fdopen(file, "w");
    if (!stream) {
        bool there = errno == EEXIST;
        if (there) nh_fail(error, NH_INPUT, path, "this file exists already; it was not changed");
        else nh_fail(error, NH_INPUT, path, "this file could not be created: %s", strerror(errno));
        nh_error_hint(error, there ? "choose another name, or remove the file first"
                                   : "nhsym writes the file into the current folder; change to another folder");
        return NH_INPUT;
    }
    bool good = fprintf(stream, pattern, name, name) > 0;
    good &= fclose(stream) == 0;
    if (!good) {
        nh_fail(error, NH_NUMERIC, path, "could not be written: %s", strerror(errno));
        nh_error_hint(error, "the incomplete file was removed; free some space, or use another folder");
        unlink(path);
        return NH_NUMERIC;
    }
    if (!cli->quiet) printf("wrote %s; `nhsym analyze %s` analyses it\n", path, path);
    return NH_OK;
}
