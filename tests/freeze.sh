#!/bin/sh
# What the commands write, as hashes, timings apart: before and after a change that shall not change any of it.  Run by hand:
#
#     tests/freeze.sh OUT [SYSTEM ...]          all systems when none is named
#
# OUT gets a line for each output: system, command, format, hash; formats are the text, the JSON, the page, the LaTeX, the table, standard error and the exit code. Where OUT is
# there already it is compared instead, and the outputs that differ are named; the exit code is 1 when there are any.
# NHSYM: the program (build/nhsym); COMMANDS: some of "analyze reduce simulate verify classify scan export" (all; a benchmark consists of timings);
# KEEP: a folder that gets the outputs themselves, so that two can be compared line by line; JOBS: systems at a time (2).
set -u
cd "$(dirname "$0")/.." || exit 2
if [ "${1-}" = --one ]; then # a system, in a folder of its own: outputs have names without a path, because some tell how they were asked for
    system=$2
    top=$PWD
    mkdir -p "$KEEP/$system" && cd "$KEEP/$system" || exit 2
    ln -s "$top/systems" "$top/analyses" .
    parameter=$("$NHSYM" show "$system" --of parameters | head -n 1)
    coordinate=$("$NHSYM" show "$system" --of coordinates | head -n 1)
    # ask COMMAND OPTIONS..: the formats that the command has
    ask() {
        command=$1
        shift
        case " $COMMANDS " in *" $command "*) ;; *) return ;; esac
        case $command in export) set -- "$@" --tex o.tex ;; *) set -- "$@" --tex o.tex --html o.html ;; esac
        case $command in reduce | scan) set -- "$@" --csv o.csv ;; esac
        "$NHSYM" "$command" "$system" "$@" --json o.json --max-seconds 100000 >o.text 2>o.err
        echo "exit code $?" >>o.err
        # Words that follow from a timing: keys and rows of seconds, and how much faster one of two motions was.
        for file in o.*; do
            sed -E -e '/^\t*"[a-z_]*_s":/d' -e '/^\t*"(seconds|speedup)":/d' -e '/<th scope="row">time</d' -e '/seconds of integration/d' \
                -e '/^time [&]/d' -e '/^[0-9.]+ m?s$/d' -e 's/[0-9.e+-]+ (m|µ)?s and/and/' -e 's/[0-9.]+ m?s;/;/' "$file" >"$command.${file#o.}"
            rm "$file"
        done
    }
    ask analyze --equations
    ask reduce --equations
    ask simulate
    ask verify --field "Z0=1"
    [ -z "$parameter" ] || ask classify --over "$parameter" --degree 1
    [ -z "$parameter" ] || ask scan --over "$parameter=1:2:3" --of count --workers 1 -o folder
    rm -rf folder
    for language in c python sympy matlab latex json; do
        case " $COMMANDS " in *" export "*) "$NHSYM" export "$system" --to $language >export-$language.code 2>/dev/null ;; esac
    done
    ask export --input "$coordinate" # the message
    "$NHSYM" show "$system" >show.text
    rm systems analyses
    sha256sum -- *.* | sed -E "s/^([0-9a-f]*)  ([a-z-]*)\.([a-z]*)$/$system \2 \3 \1/" >"$KEEP/$system.hashes"
    exit 0
fi
out=${1:?usage: freeze.sh OUT [SYSTEM ...]}
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
NHSYM=$(realpath "${NHSYM:-build/nhsym}")
KEEP=$(realpath -m "${KEEP:-$work/outputs}")
COMMANDS=${COMMANDS:-analyze reduce simulate verify classify scan export}
export NHSYM KEEP COMMANDS
mkdir -p "$KEEP"
[ $# -gt 0 ] || set -- $(for file in systems/*.yaml; do basename "$file" .yaml; done)
mkdir -p "$KEEP/words"
{
    for topic in list explain "explain methods" "explain options" "explain functions" help; do "$NHSYM" $topic; done
    "$NHSYM" help | sed -n 's/^  \([a-z]*\) .*/\1/p' | while read -r command; do "$NHSYM" help "$command"; done
} >"$KEEP/words/help.text" 2>&1
(cd "$KEEP/words" && sha256sum help.text | sed 's/\([^ ]*\) .*/words help text \1/' >../words.hashes)
printf '%s\n' "$@" | xargs -P "${JOBS:-2}" -n 1 sh "$0" --one
for system in words "$@"; do cat "$KEEP/$system.hashes"; done >"$work/hashes"
if [ ! -e "$out" ]; then
    cp "$work/hashes" "$out"
    echo "$# systems, $(wc -l <"$out") outputs"
    exit 0
fi
different=$(for system in words "$@"; do grep "^$system " "$out"; done | diff - "$work/hashes" | sed -n 's/^[<>] \(.*\) .*/\1/p' | sort -u)
[ -z "$different" ] || printf '%s\n' "$different" | sed 's/$/ differs/'
echo "$# systems, $(wc -l <"$work/hashes") outputs, $(printf '%s' "$different" | grep -c .) differ"
[ -z "$different" ]
