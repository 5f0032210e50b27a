#!/bin/sh
# The same answer everywhere: what `analyze --json` says of the shipped systems, timings apart, on an idle machine, again, beside busy loops, with 1, 2 and 4
# threads, and in the sanitized build.  Run by hand:
#
#     tests/same_everywhere.sh [SYSTEM ...]          all systems when none is named
#
# NHSYM: the program (build/nhsym); NHSYM_SANITIZED: the sanitized one (build-sanitize/nhsym, left out when it is not there); BUSY: how many loops (6).
# The first differing lines are printed; the exit code is 1 when there are any.
set -u
program=${NHSYM:-build/nhsym}
sanitized=${NHSYM_SANITIZED:-build-sanitize/nhsym}
busy=${BUSY:-6}
work=$(mktemp -d)
loops=
stop() { for loop in $loops; do kill "$loop" 2>/dev/null; done; loops=; }
trap 'stop; rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
[ $# -gt 0 ] || set -- $(for file in systems/*.yaml; do basename "$file" .yaml; done)

# The keys that hold seconds, and how the program was called, are all that may differ.
plain() { sed -e '/"[a-z_]*_s":/d' -e '/"seconds":/d' -e '/"command":/d'; }

# answers NAME PROGRAM OPTIONS.. -- SYSTEM..: one file per system in $work/NAME
answers() {
    name=$1 command=$2 options=
    shift 2
    while [ "$1" != -- ]; do options="$options $1"; shift; done
    shift
    mkdir -p "$work/$name"
    for system; do
        "$command" analyze "$system" --quiet --max-seconds 100000 $options --json - >"$work/raw" 2>"$work/err"
        echo "exit code $?" | cat - "$work/err" >"$work/$name/$system"
        plain <"$work/raw" >>"$work/$name/$system"
    done
}

different=0
compare() {
    for system; do
        cmp -s "$work/idle/$system" "$work/$name/$system" && continue
        different=$((different + 1))
        echo "$system differs: $name"
        diff "$work/idle/$system" "$work/$name/$system" | cut -c1-160 | head -n 6
    done
}

answers idle "$program" -- "$@"
answers "a second run" "$program" -- "$@" && compare "$@"
for threads in 1 2 4; do answers "$threads threads" "$program" --threads $threads -- "$@" && compare "$@"; done
[ ! -x "$sanitized" ] || { answers "sanitized build" "$sanitized" -- "$@" && compare "$@"; }
i=0
while [ $i -lt "$busy" ]; do
    (while :; do :; done) &
    loops="$loops $!" i=$((i + 1))
done
answers "beside $busy busy loops" "$program" -- "$@" && compare "$@"
stop
echo "$# systems, $different differences"
[ $different -eq 0 ]
