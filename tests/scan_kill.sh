#!/bin/sh
# Kills a scan again and again, a worker or all of it, at random moments, and looks whether anything is lost or there twice.
# usage: scan_kill.sh [TIMES [SEED]]       NHSYM: the program; prints a line per kill, and 0 when the result is that of a run in one piece
times=${1:-50}
seed=${2:-1}
program=$(realpath "${NHSYM:-build/nhsym}")
cd "$(dirname "$0")/.." || exit 2
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
scan="$program scan tests/data/classify/henon_heiles.yaml --set B=1 --over eps=-1:3:81 --quiet"
random() { # r: below $1
    seed=$(((seed * 1103515245 + 12345) % 2147483648))
    r=$((seed / 1000003 % $1))
}
$scan -o "$work/whole" || exit 1
round=0
kills=0
while [ "$kills" -lt "$times" ]; do
    round=$((round + 1))
    rm -rf "$work/killed"
    while [ "$kills" -lt "$times" ]; do
        setsid $scan --workers 2 -o "$work/killed" &
        main=$!
        what=
        while [ "$what" != "all of it" ]; do
            random 6
            sleep "0.$((r + 1))"
            kill -0 "$main" 2>/dev/null || break # it was ready
            random 2
            victim=$(pgrep -P "$main" | head -n 1)
            if [ "$r" = 0 ] && [ "$victim" ]; then
                what="a worker"
                kill -KILL "$victim" 2>/dev/null || continue
            else
                what="all of it"
                kill -KILL "-$main" 2>/dev/null || break
            fi
            kills=$((kills + 1))
            echo "$kills: killed $what, $(ls "$work/killed/units" 2>/dev/null | grep -c 'txt$') units finished"
        done
        wait "$main" 2>/dev/null
        [ "$what" = "all of it" ] || break
    done
    $scan --workers 2 -o "$work/killed" || exit 1
    for file in scan.json scan.csv report.html; do
        cmp "$work/whole/$file" "$work/killed/$file" || exit 1
    done
    [ "$(ls "$work/whole/units" | grep -c 'txt$')" = "$(ls "$work/killed/units" | wc -l)" ] || { ls "$work/killed/units"; exit 1; }
done
echo "$kills kills in $round rounds: the same result every time"
