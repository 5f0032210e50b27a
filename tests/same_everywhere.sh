#!/bin/sh
# The same answer everywhere: what `analyze --json` says of the shipped systems, timings apart, on an idle machine, again, beside busy loops, with 1, 2 and 4 threads,
# and in the sanitized build; and on other kinds of processors, for which OpenBLAS and the C library have other kernels, the same but for numbers
# outside of formulas.  Run by hand:
#
#     tests/same_everywhere.sh [SYSTEM ...]          all systems when none is named
#
# COMMAND: what is asked (analyze; "reduce", or "analyze --no-analysis"); PASSES: some of "again threads sanitized processors busy" (all).
# NHSYM: the program (build/nhsym); NHSYM_SANITIZED: the sanitized one (build-sanitize/nhsym, left out when it is not there); BUSY: how many loops (6).
# That no run leaves files for the next one is checked as well.  The first differing lines are printed; the exit code is 1 when there are any.
set -u
program=${NHSYM:-build/nhsym}
sanitized=${NHSYM_SANITIZED:-build-sanitize/nhsym}
busy=${BUSY:-6}
question=${COMMAND:-analyze}
passes=${PASSES:-again threads sanitized processors busy}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
[ $# -gt 0 ] || set -- $(for file in systems/*.yaml; do basename "$file" .yaml; done)

# The keys that hold seconds, and how the program was called, are all that may differ.
plain() { sed -e '/"[a-z_]*_s":/d' -e '/"seconds":/d' -e '/"speedup":/d' -e '/"command":/d'; }
# Words: formulas, names, verdicts, how many there are.  Numbers that were measured have other last digits, motions other steps, warnings other drifts.
words() { sed -E -e '/"(evaluations|warnings)":/d' -e 's/(:\t|\[|, |^\t+)-?[0-9][0-9.e+-]*/\1#/g' "$1"; }

# answers NAME COMMAND OPTIONS.. -- SYSTEM..: one file per system in $work/NAME
answers() {
    name=$1 command=$2 options=
    shift 2
    while [ "$1" != -- ]; do options="$options $1"; shift; done
    shift
    mkdir -p "$work/$name"
    for system; do
        $command $question "$system" --quiet --max-seconds 100000 $options --json - >"$work/raw" 2>"$work/err"
        echo "exit code $?" | cat - "$work/err" >"$work/$name/$system"
        plain <"$work/raw" >>"$work/$name/$system"
    done
}

different=0
compare_words() {
    for system; do
        words "$work/idle/$system" >"$work/one"
        words "$work/$name/$system" >"$work/two"
        cmp -s "$work/one" "$work/two" && continue
        different=$((different + 1))
        echo "$system differs: $name"
        diff "$work/one" "$work/two" | cut -c1-160 | head -n 6
    done
}

compare() {
    for system; do
        cmp -s "$work/idle/$system" "$work/$name/$system" && continue
        different=$((different + 1))
        echo "$system differs: $name"
        diff "$work/idle/$system" "$work/$name/$system" | cut -c1-160 | head -n 6
    done
}

wanted() { case " $passes " in *" $1 "*) return 0 ;; esac; return 1; }

# Nothing is kept from one run for the next: a cache would be in the user's folders, which are empty before and after.
export HOME="$work/home" XDG_CACHE_HOME="$work/home/cache"
mkdir "$HOME"
answers idle "$program" -- "$@"
wanted again && answers "a second run" "$program" -- "$@" && compare "$@"
wanted threads && for threads in 1 2 4; do answers "$threads threads" "$program" --threads $threads -- "$@" && compare "$@"; done
wanted sanitized && [ -x "$sanitized" ] && answers "sanitized build" "$sanitized" -- "$@" && compare "$@"
if wanted processors; then
    for core in Nehalem Sandybridge SkylakeX; do
        OPENBLAS_CORETYPE=$core
        GLIBC_TUNABLES=
        [ $core = SkylakeX ] || GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-AVX2_Usable,-FMA,-FMA_Usable,-AVX512F,-AVX512F_Usable
        export OPENBLAS_CORETYPE GLIBC_TUNABLES
        answers "as on $core" "$program" -- "$@" && compare_words "$@"
        unset OPENBLAS_CORETYPE GLIBC_TUNABLES
    done
fi
if wanted busy; then
    answers "beside $busy busy loops" "sh tests/busy.sh $busy $program" -- "$@" && compare "$@"
fi
[ -z "$(find "$HOME" -type f)" ] || { different=$((different + 1)); echo "files are kept for the next run:"; find "$HOME" -type f; }
echo "$# systems, $different differences"
[ $different -eq 0 ]
