#!/bin/sh
# How the time of a whole analysis grows: with the sample points, the columns of the ansatz, the coordinates, and the length of a chain.
# usage: bench_growth.sh BUILD          prints tables in markdown
build=$1
cd "$(dirname "$0")/.." || exit 1
[ -x "$build/nhsym" ] && [ -x "$build/tests/bench_run" ] || { echo "usage: bench_growth.sh BUILD" >&2; exit 2; }
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT

# the median of three runs less that of the bare program, ms
bare=$("$build/tests/bench_run" 5 -- "$build/nhsym" version | cut -d' ' -f2)
time_of() { "$build/tests/bench_run" 3 -- "$build/nhsym" "$@" | awk -v bare="$bare" '{ print ($2 > bare ? $2 - bare : 0.01) }'; }

# usage: table WHAT EXPECTED; stdin: pairs of size and ms
table() {
    awk -v what="$1" -v expected="$2" '
        { n++; size[n] = $1; ms[n] = $2 }
        END {
            row = ""
            for (i = 1; i <= n; i++) row = row (i > 1 ? ", " : "") size[i] ": " ms[i]
            first = n > 3 ? n - 2 : 1    # the largest sizes, where what grows is what takes the time
            for (i = first; i <= n; i++) { k++; a = log(size[i]); b = log(ms[i]); sx += a; sy += b; sxx += a * a; sxy += a * b }
            printf "| %s | %s | %.1f | %s |\n", what, row, (k * sxy - sx * sy) / (k * sxx - sx * sx), expected
        }'
}

oscillators() { # n of them, all frequencies different
    awk -v n="$1" 'BEGIN {
        printf "name: oscillators\ncoordinates: ["
        for (i = 1; i <= n; i++) printf("%s{name: x%d}", (i > 1 ? ", " : ""), i)
        printf "]\nlagrangian: "
        for (i = 1; i <= n; i++) printf("%sx%d'"'"'^2/2 - %.3f*x%d^2/2", (i > 1 ? " + " : ""), i, i + sqrt(i), i)
        print "" }'
}

# every function of two coordinates and velocities up to this degree
polynomial() { printf 'name: degree\nsystem: oscillators\nansatz:\n  - {basis: polynomial, in: [x1, x2, x1'"'"', x2'"'"'], degree: %s}\n' "$1"; }

echo "| with | size: ms | exponent of the largest three | expected |"
echo "|---|---|---|---|"
for n in 4096 16384 65536 262144; do echo "$n $(time_of analyze sleigh --samples $n -q)"; done | table "sample points (sleigh)" "1"
oscillators 2 >"$work/oscillators.yaml"
for degree in 4 6 8 10; do
    polynomial $degree >"$work/degree.yaml"
    echo "$(awk -v d=$degree 'BEGIN { print (d + 1) * (d + 2) * (d + 3) * (d + 4) / 24 }') $(time_of analyze "$work/oscillators.yaml" --analysis "$work/degree.yaml" --samples 4096 -q)"
done | table "columns (polynomials of two oscillators), 4096 points" "2 (points x columns^2)"
for n in 2 3 4 5 6; do
    oscillators $n >"$work/oscillators.yaml"
    echo "$n $(time_of analyze "$work/oscillators.yaml" --max-seconds 1000 --option stage_columns=40 -q)"
done | table "coordinates (oscillators), stages of at most 40 columns" ""
for n in 1 2 3 4 5; do echo "$n $(time_of analyze car_trailers_$n --no-analysis --option stage_columns=40 --max-seconds 1000 -q)"; done | table "trailers behind a car, stages of at most 40 columns" ""
