#!/bin/sh
# What a unit of a scan costs beside its points, and what follows from that for many processors.
# usage: bench_scan.sh [POINTS]           NHSYM: the program
points=${1:-2000}
program=$(realpath "${NHSYM:-build/nhsym}")
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 2
printf 'name: oscillator\nparameters: {k: 2}\ncoordinates: [x]\nlagrangian: x'"'"'^2/2 - k*x^2/2\n' >oscillator.yaml
scan="$program scan oscillator.yaml --over k=1:2:$points --of count --degree 1 --option scan_columns=2 --quiet"
now() { date +%s.%N; }
timed() { # UNIT: seconds for all points with this many in a unit
    rm -rf scan
    timeout -s INT 0.01 $scan -o scan 2>/dev/null
    [ -f scan/manifest.json ] || $scan --chunk 1/1000000 -o scan
    sed -i 's/"points_per_unit":.*/"points_per_unit":\t'"$1"',/' scan/manifest.json
    rm -rf scan/units/*
    begun=$(now)
    $scan -o scan
    ended=$(now)
    awk "BEGIN { print $ended - $begun }"
}
one=$(timed "$points")
many=$(timed 1)
begun=$(now)
$scan -o scan
again=$(awk "BEGIN { print $(now) - $begun }")
bytes=$(cat scan/units/* | wc -c)
awk -v n="$points" -v one="$one" -v many="$many" -v again="$again" -v bytes="$bytes" 'BEGIN {
    unit = (many - one) / (n - 1)
    printf "%d points in 1 unit: %.2f s; in %d units: %.2f s; a unit costs %.2f ms beside its points\n", n, one, n, many, 1e3 * unit
    printf "finished, run again (all unit files are read, all documents written): %.2f s, %.0f us a point; %.0f bytes a point on the disk\n", again, 1e6 * again / n, bytes / n
    printf "estimate, not a measurement: points of 50 ms, units of 10 s; seconds on P processors = units / P (rounded up) times (10 + unit) + end\n"
    printf "%12s %14s %14s %14s\n", "points", "1 processor", "100", "1000"
    for (points = 1e4; points <= 1e6; points *= 10) {
        units = points / 200; end = again / n * points
        printf "%12d", points
        for (p = 1; p <= 1000; p *= p == 1 ? 100 : 10) { rounds = int((units + p - 1) / p); printf " %14.0f", rounds * (10 + unit) + end }
        printf "\n"
    }
}'
