#!/bin/sh
# How late does a run end?  Every command on the shipped systems and on those of tests/data/nasty, with a time limit of S seconds each: the worst overrun of
# processor time (user and system, with children), per command, against 1.2 S + 0.2 s.  What counts is the processor: on a busy machine the wall's clock says nothing.
# usage: limits.sh [S [SYSTEM...]]     prints a table; 1 when a run took longer than allowed or ended in a way that it must not
limit=${1:-1}
[ $# -gt 0 ] && shift
cd "$(dirname "$0")/.." || exit 2
program=${NHSYM:-build/nhsym}
[ $# -gt 0 ] || set -- systems/*.yaml tests/data/nasty/*.yaml
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT

# One run: command, system, exit code, processor seconds, and how it ended.
one()
{
    command=$1 system=$2
    shift 2
    ( "$program" "$command" "$system" --max-seconds "$limit" --threads 1 "$@" >"$work/out" 2>"$work/err"; echo $? >"$work/code"; times ) >"$work/times"
    awk -v name="$command" -v file="$system" -v code="$(cat "$work/code")" -v cut="$(grep -c 'nothing could be reported in time' "$work/err")" '
        NR == 2 { for (i = 1; i <= 2; i++) { split($i, t, "m"); s += 60 * t[1] + t[2] } print name, file, code, s, cut }' "$work/times"
}

for system in "$@"; do
    first=$(awk '/^coordinates: \[/ { gsub(/^coordinates: \[|[],].*$/, ""); print; exit } /^coordinates:/ { on = 1; next } on && /name:/ { sub(/.*name: */, ""); sub(/[,}].*/, ""); print; exit }
                 /coordinates: \[/ { sub(/.*coordinates: \[/, ""); sub(/[],].*/, ""); print; exit }' "$system")
    one analyze "$system" --html "$work/page.html"
    one verify "$system" --current "$first'^2"
    one simulate "$system" --initial "$first'=0.1" --project --until 1000 --accuracy 1e-9
    one simulate "$system" --initial "$first'=0.1" --project --until 100 --ensemble 200
    one benchmark "$system" --budget 100
    one reduce "$system" --html "$work/page.html"
done | tee "$work/all" | awk -v limit="$limit" '
    { runs[$1]++; ended[$1] += $3 == 5; cut[$1] += $5 > 0; if ($4 > worst[$1]) { worst[$1] = $4; where[$1] = $2 } }
    $4 > 1.2 * limit + 0.2 { print "too late: " $1, $2 ": " $4 " s"; bad = 1 }
    $3 > 5 && $3 != 130 { print "ended with " $3 ": " $1, $2; bad = 1 }
    END {
        printf "%-10s %5s %8s %8s %10s  (limit %g s, allowed %g s)\n", "command", "runs", "code 5", "at once", "worst", limit, 1.2 * limit + 0.2
        for (c in runs) printf "%-10s %5d %8d %8d %8.2f s  %s\n", c, runs[c], ended[c], cut[c], worst[c], where[c]
        exit bad
    }'
code=$?
grep ' 1$' "$work/all" | awk '{ print "at once: " $1, $2 }'
exit $code
