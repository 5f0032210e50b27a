#!/bin/sh
# How long a whole `nhsym analyze` takes for every shipped system.
# usage: bench_whole.sh BUILD          prints a table in markdown
build=$1
cd "$(dirname "$0")/.." || exit 1
[ -x "$build/nhsym" ] || { echo "usage: bench_whole.sh BUILD" >&2; exit 2; }
for file in systems/*.yaml; do
    name=$(basename "$file" .yaml)
    begin=$(date +%s.%N)
    "$build/nhsym" analyze "$name" --no-analysis -q >/dev/null 2>&1
    echo "$(date +%s.%N) $begin $name"
done | awk '{ printf "%.3f %s\n", $1 - $2, $3 }' | sort -n | awk '
    { n++; s[n] = $1; name[n] = $2; sum += $1 }
    END {
        print "| systems | all, s | median, s | the slowest, s |\n|---|---|---|---|"
        row = ""
        for (i = n; i > n - 5 && i > 0; i--) row = row (i < n ? ", " : "") name[i] " " s[i]
        printf "| %d | %.1f | %.3f | %s |\n", n, sum, (s[int((n + 1) / 2)] + s[int(n / 2) + 1]) / 2, row
    }'
