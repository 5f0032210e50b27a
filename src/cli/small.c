/* small: the commands that need no computation. */
#include <string.h>

#include "cli/cli.h"

int nh_cli_version(nh_cli *cli, nh_error *error)
{
    (void)cli;
    (void)error;
    puts("nhsym " NH_VERSION);
    return NH_OK;
}

int nh_cli_list(nh_cli *cli, nh_error *error)
{
    const char **names;
    size_t count = nh_cli_names(cli, "systems", &names);
    for (size_t i = 0; i < count; i++) {
        const char *path = nh_cli_look(cli, "systems", names[i]);
        nh_error trouble;
        nh_error_clear(&trouble);
        nh_system *s = path ? nh_system_read(path, 0, NULL, &trouble) : NULL;
        printf("%-24s %s\n", names[i], s ? s->title : trouble.what);
        nh_system_free(s);
    }
    if (count) return NH_OK;
    nh_fail(error, NH_INPUT, "", "there are no systems in ./systems, in NHSYM_PATH or installed");
    nh_error_hint(error, "run nhsym where a folder `systems` is, or set NHSYM_PATH");
    return NH_INPUT;
}

int nh_cli_show(nh_cli *cli, nh_error *error)
{
    if (cli->operands != 1) {
        nh_fail(error, NH_USAGE, "", "show which system?");
        nh_error_hint(error, "nhsym show sleigh");
        return NH_USAGE;
    }
    const char *path = nh_cli_find(cli, "systems", cli->operand[0], error);
    if (!path) return error->code;
    FILE *file = fopen(path, "r");
    if (!file) return nh_fail(error, NH_INPUT, path, "cannot be read"), NH_INPUT;
    char buffer[4096];
    for (size_t n; (n = fread(buffer, 1, sizeof buffer, file)) > 0;) fwrite(buffer, 1, n, stdout);
    fclose(file);
    return NH_OK;
}

static const struct {
    const char *word, *text;
} topics[] = {
    {"current", "A function Phi of time, coordinates and velocities that stays constant along every motion: Gamma(Phi) = 0."},
    {"symmetry", "The Chetaev field Z in the canonical distribution with L_Z(alpha) = 0 on it; its current is Phi = alpha(Z)."},
    {"case", "1: [Gamma,Z] = a Gamma, Z is also a symmetry of the equations of motion.  2: [Gamma,Z] = a Gamma + b Z.  3: neither."},
    {"distribution", "The canonical distribution: virtual displacements that the constraints allow. [Gamma,Z] may leave it."},
    {"FOUND", "Currents were found and each is proved, or certified to at least 50 digits."},
    {"NONE", "No combination of the ansatz is conserved: every generalized singular value is far above rounding."},
    {"UNDECIDED", "Values between rounding and significance: take more samples or another ansatz; a current is given with its digits."},
    {"gap", "The ratio of the first singular value that is not null to the last that is.  Below 1000 nothing is decided."},
    {"drift", "The largest change of a current along a computed motion, relative to the size of its terms."},
    {"local", "The current changes when an angle goes once around: it is defined on a part of the configuration space only."},
    {"independent", "Its gradient is not a combination of the gradients of the currents before it."},
    {"group", "The symmetries that leave kinetic energy, potential and constraints invariant: fields on configuration space (nhsym reduce)."},
    {"Chaplygin", "A system whose group's orbits and constraint distribution are complementary: V + D = TQ, V cap D = 0.  It reduces to the shape space."},
    {"shape", "Coordinates of a slice through the orbits of a group; the reduced equations are written in them."},
    {"stage", "A reduction by a group: Chaplygin's, a second one by further symmetry, or the whole group at once (Lagrange-d'Alembert-Poincare)."},
    {"holonomic", "A constraint between positions, as it was given."},
    {"integrable", "The constraints on velocities say no more than that as many functions of time and positions stay constant."},
    {"partly", "Partly integrable: some combinations of the constraints hold a function of time and positions constant, others do not."},
    {"nonholonomic", "No function of time and positions is held constant by the constraints: every place can be reached."},
    {"hidden", "Hidden holonomic constraints: functions that the constraints alone keep constant, found by brackets of the allowed directions."},
    {"growth", "Growth vector: the dimensions that the allowed directions, their brackets, the brackets with those, ... fill."},
    {"right", "A measured integration (nhsym chart) whose error its tolerance or step lets expect, and no guard complains."},
    {"warned", "Right, but a guard complains: the pivot of the chart, and in maps the drift of a current or a run at a tenth of the tolerance."},
    {"caught", "It failed, or its error is larger than may be expected, and a guard says so."},
    {"wrong", "It ended without complaint, and its error is larger than may be expected: options chart_wrong, chart_far and chart_fixed."},
    {"timeout", "An integration that was given up because it took too long."},
    {"semiholonomic", "eps'_l(g) = 0: a nonlinear constraint that behaves like a holonomic one in these coordinates."},
};

static void explain_options(void)
{
    for (size_t i = 0; i < nh_option_count(); i++) {
        nh_option_row o = nh_option_at(i);
        printf("%-13s %-9g %-10s %s\n", o.name, o.value, o.unit, o.doc);
    }
}

int nh_cli_explain(nh_cli *cli, nh_error *error)
{
    enum { count = sizeof topics / sizeof *topics };
    const char *names[count + 1], *word = cli->operands ? cli->operand[0] : NULL;
    for (size_t i = 0; i < count; i++) {
        names[i] = topics[i].word;
        if (!word) printf("%-14s %s\n", topics[i].word, topics[i].text);
        else if (!strcmp(word, topics[i].word)) return puts(topics[i].text), NH_OK;
    }
    if (!word) return puts("options        every number that decides something (nhsym explain options)"), NH_OK;
    if (!strcmp(word, "options")) return explain_options(), NH_OK;
    names[count] = "options";
    nh_fail(error, NH_USAGE, "", "nothing is known about `%s`", word);
    const char *near = nh_text_nearest(word, names, count + 1);
    if (near) nh_error_hint(error, "did you mean `%s`?", near);
    else nh_error_hint(error, "`nhsym explain` lists the topics");
    return NH_USAGE;
}
