#!/bin/sh
# How late does a run end?  Every command on the shipped systems and on those of tests/data/nasty, with a time limit of S seconds each: the most processor time (user and
# system, with children) that a run takes after the limit, per command, against 0.2 S + 0.2 s.  What counts is the processor: on a busy machine the wall's clock says nothing.
# usage: limits.sh [S [SYSTEM...]]     prints docs/limits.md; 1 when a run took longer than allowed or ended in a way that it must not
# EVERY=N: of the shipped systems every N-th.
limit=${1:-1}
every=${EVERY:-1}
[ $# -gt 0 ] && shift
cd "$(dirname "$0")/.." || exit 2
program=${NHSYM:-build/nhsym}
tick=$(getconf CLK_TCK)
what="\`$*\`" how="sh tests/limits.sh $limit"
if [ $# -eq 0 ]; then
    set -- $(ls systems/*.yaml | awk -v every="$every" 'NR % every == 0') tests/data/nasty/*.yaml
    nasty=$(ls tests/data/nasty/*.yaml | wc -l)
    what="$(($# - nasty)) systems of \`systems/\` and the $nasty of \`tests/data/nasty\`"
    [ "$every" = 1 ] || how="EVERY=$every $how"
fi
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT

# One run: command, system, exit code, processor seconds after the limit, and whether it ended without a result.
one()
{
    command=$1 system=$2
    shift 2
    (
        "$program" "${command%% *}" "$system" --max-seconds "$limit" "$@" >"$work/out" 2>"$work/err" &
        sleep "$limit"
        sed 's/.*) //' "/proc/$!/stat" 2>/dev/null | awk -v tick="$tick" '{ print ($12 + $13 + $14 + $15) / tick }' >"$work/before"
        wait $!
        echo $? >"$work/code"
        times >"$work/times"
    )
    awk -v name="$command" -v file="$system" -v code="$(cat "$work/code")" -v before="$(cat "$work/before")" -v cut="$(grep -c 'nothing could be reported in time' "$work/err")" '
        NR == 2 { for (i = 1; i <= 2; i++) { split($i, t, "m"); s += 60 * t[1] + t[2] } print name "|" file "|" code "|" (before == "" || s < before ? 0 : s - before) "|" cut }' "$work/times"
}

# The first name of a list of a system file, in any of YAML's forms; the first coordinate of joints, as an unfinished result names it.
first() { awk -v list="$1:" '$1 == list { on = 1 } on && match($0, /name: *[A-Za-z_][A-Za-z_0-9]*/) { s = substr($0, RSTART + 5, RLENGTH - 5); sub(/^ */, "", s); print s; exit }
    on && match($0, /[[{][A-Za-z_][A-Za-z_0-9]*/) { print substr($0, RSTART + 1, RLENGTH - 1); exit }' "$2"; }
joint() { "$program" analyze "$1" --max-seconds 0.05 --quiet --json - 2>/dev/null | tr -d ' \n\t' | sed -n 's/.*"coordinates":\["\([^"]*\)".*/\1/p'; }

for system in "$@"; do
    q=$(first coordinates "$system") p=$(first parameters "$system")
    [ "$q" ] || q=$(joint "$system")
    rm -rf "$work/scan"
    one analyze "$system" --threads 1 --html "$work/page.html"
    one verify "$system" --threads 1 --current "$q'^2"
    one simulate "$system" --initial "$q'=0.1" --project --until 1000 --accuracy 1e-9
    one "simulate --ensemble" "$system" --threads 1 --initial "$q'=0.1" --project --until 100 --ensemble 200
    one benchmark "$system" --budget 100
    one reduce "$system" --threads 1 --html "$work/page.html"
    one export "$system" --to c
    [ -z "$p" ] || one classify "$system" --threads 1 --over "$p"
    [ -z "$p" ] || one scan "$system" --threads 1 --over "$p=1:2:5" -o "$work/scan"
done >"$work/all"
cat <<PAGE
# Time limits

Written by \`$how > docs/limits.md\`: every command with \`--max-seconds $limit\` on $what
(\`classify\` and \`scan\` over the first parameter of those that have one). In the latter some step takes minutes, or memory without bounds.
Seconds are those that the processor spent after the limit, up to the end of the process, when results are written: a fifth of the limit and 0.2 s are allowed.
The table of an ensemble, tens of megabytes, is written to its end, which counts as well.
Reached: runs that the limit ended. Without a result: of these, those that could name only the system and what they were doing.

| command | runs | reached | without a result | most, s | by |
|---|---|---|---|---|---|
PAGE
awk -F'|' -v limit="$limit" '
    { if (!($1 in runs)) name[++n] = $1; runs[$1]++; ended[$1] += $3 == 5; cut[$1] += $5 > 0; if ($4 > worst[$1]) { worst[$1] = $4; by[$1] = $2 } }
    $4 > 0.2 * limit + 0.2 { late[++lates] = "`" $1 "` on `" $2 "`: " $4 " s" }
    $3 > 5 && $3 != 130 { late[++lates] = "`" $1 "` on `" $2 "` ended with exit code " $3 }
    END {
        for (i = 1; i <= n; i++) { c = name[i]; printf "| `%s` | %d | %d | %d | %.2f | `%s` |\n", c, runs[c], ended[c], cut[c], worst[c], by[c] }
        printf "\nLater than allowed (%g s)%s\n", 0.2 * limit + 0.2, lates ? ":\n" : ": none."
        for (i = 1; i <= lates; i++) print "* " late[i]
        exit lates > 0
    }' "$work/all"
