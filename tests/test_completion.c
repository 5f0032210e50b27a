/* Completions by the shells themselves: what `nhsym help bash`, `zsh` and `fish` print is loaded and asked. */
#include <string.h>

#include "program.h"
#include "sweep.h"

static bool has(const char *shell)
{
    char line[80];
    snprintf(line, sizeof line, "command -v %s >/dev/null 2>&1", shell);
    if (system(line) == 0) return true;
    printf("skipped: no %s\n", shell);
    return false;
}

/* What a shell prints that runs the script in the folder of the place, with the program in its path. */
static char *by_shell(place *p, const char *shell, const char *script)
{
    char line[4 * PATH_MAX], folder[PATH_MAX];
    snprintf(folder, sizeof folder, "%s", p->program);
    *strrchr(folder, '/') = 0;
    write_here(p, "script", script);
    snprintf(line, sizeof line, "cd '%s' && PATH='%s':\"$PATH\" HOME='%s' %s script 2>&1", p->folder, folder, p->folder, shell);
    FILE *pipe = popen(line, "r");
    cr_assert_not_null(pipe);
    char *out = read_stream(pipe);
    pclose(pipe);
    return out;
}

static void expect_words(const char *out, const char *const *word)
{
    for (; *word; word++) {
        char line[80];
        snprintf(line, sizeof line, "\n%s\n", *word);
        cr_expect_not_null(strstr(out, line), "%s is not completed:\n%s", *word, out);
    }
}

/* Every option that the help of a command lists, every command, values, systems and files. */
Test(completion, bash_completes_everything, PLAIN_ONLY)
{
    if (!has("bash")) return;
    place p = place_with_systems();
    write_here(&p, "mine.yaml", "name: mine\n");
    write_here(&p, "robot.urdf", "<robot/>\n");
    char *out = by_shell(&p, "bash",
                         "source <(nhsym help bash)\n"
                         "ask() { COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); COMPREPLY=(); _nhsym; printf '%s\\n' \"${COMPREPLY[@]}\"; }\n"
                         "echo; ask nhsym ''; ask nhsym simulate sleigh --method auto; ask nhsym simulate sleigh --method relax; ask nhsym analyze sle; ask nhsym analyze m; ask nhsym analyze rob\n"
                         "ask nhsym simulate sleigh --svg mi; ask nhsym analyze sleigh -o mi; ask nhsym analyze sleigh --velocities q; ask nhsym explain ga; ask nhsym help ver; ask nhsym reduce sleigh --to py; ask nhsym classify x --of hamil; ask nhsym export x --of subm; ask nhsym show x --of coord; ask nhsym verify x --of equ\n"
                         "[ -z \"$(ask nhsym show x --of hamil)\" ] || echo 'show lacks a list of its own for --of'\n"
                         "for c in $(nhsym help | sed -n 's/^  nhsym \\([a-z]*\\).*/\\1/p'); do for o in $(nhsym help $c | sed -n 's/^  \\(-[a-z], \\)*\\(--[a-z-]*\\).*/\\2/p'); do\n"
                         "  ask nhsym $c x $o | grep -qx -- $o && echo + || echo \"lacks $c $o\"; done; done\n");
    static const char *const words[] = {"analyze", "scan", "export", "auto", "relaxation-8", "sleigh", "mine.yaml", "robot.urdf", "quasi", "gap", "verify", "python", "hamiltonization", "submanifold", "coordinates", "equations", NULL};
    expect_words(out, words);
    cr_expect_null(strstr(out, "lacks"), "%s", strstr(out, "lacks"));
    size_t options = 0;
    for (const char *c = out; (c = strstr(c, "\n+")); c++) options++;
    cr_expect_geq(options, 100u, "%s", out);
    free(out);
    place_clear(&p);
}

/* Parameters, coordinates and velocities of the system on the line, also in a list, between quotes, and of an own file. */
Test(completion, bash_completes_names_of_the_system)
{
    if (!has("bash")) return;
    place p = place_with_systems();
    write_here(&p, "bead.yaml", "name: bead\nparameters: [{name: stiffness, value: 2}]\ncoordinates: [arc]\nlagrangian: arc'^2/2 - stiffness*arc^2/2\n");
    char *out = by_shell(&p, "bash",
                         "source <(nhsym help bash)\n"
                         "ask() { COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); COMPREPLY=(); _nhsym; printf '%s|' \"${COMPREPLY[@]}\"; echo; }\n"
                         "echo; ask nhsym analyze bead.yaml --set ''; ask nhsym simulate --quiet bead.yaml --initial ''; ask nhsym simulate sleigh --initial '\"phi=0, om'; ask nhsym simulate sleigh --over x\n"
                         "ask nhsym classify sleigh --over k,; ask nhsym simulate nosuch --set ''\n");
    static const char *const words[] = {"stiffness=|", "arc=|arc\\'=|", "phi=0, omega=|", "x|x\\'|", "k,m|k,a|k,k|", "|", NULL};
    expect_words(out, words);
    free(out);
    place_clear(&p);
}

Test(completion, fish_completes)
{
    if (!has("fish")) return;
    place p = place_with_systems();
    char *out = by_shell(&p, "fish",
                         "nhsym help fish | source; echo\n"
                         "for line in 'nhsym analyze sleigh --set k' 'nhsym simulate sleigh --initial \"phi=0, om' 'nhsym classify sleigh --over a,' 'nhsym ana' 'nhsym analyze sle' 'nhsym simulate sleigh --meth' 'nhsym simulate sleigh --method relaxation' 'nhsym help ver'; complete -C $line | cut -f1; end\n");
    static const char *const words[] = {"k=", "phi=0, omega=", "a,m", "analyze", "sleigh", "--method", "relaxation-8", "verify", NULL};
    expect_words(out, words);
    free(out);
    place_clear(&p);
}

Test(completion, zsh_reads_it)
{
    if (!has("zsh")) return;
    place p = place_with_systems();
    char *out = by_shell(&p, "zsh -f", "nhsym help zsh >_nhsym && zsh -n _nhsym && echo \"\nread\n\"\n");
    static const char *const words[] = {"read", NULL};
    expect_words(out, words);
    free(out);
    place_clear(&p);
}
