#!/bin/sh
# Measures, and writes what was measured as a page.
# usage: bench.sh BUILD OUT.md       (`make bench` does it)
build=$1
out=$2
cd "$(dirname "$0")/.." || exit 1
[ -x "$build/nhsym" ] && [ -x "$build/tests/bench_run" ] && [ -n "$out" ] || {
    echo "usage: bench.sh BUILD OUT.md, after: make all tests" >&2
    exit 2
}
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT

say() { printf '%s\n' "$@" >>"$work/page"; }
# "holds" when the first number is at most the second
holds() { awk -v x="$1" -v y="$2" 'BEGIN { print (x == "" ? "not measured" : x + 0 <= y + 0 ? "holds" : "**does not hold**") }'; }
field() { sed -n "${1}p" "$work/run" | cut -d' ' -f"$2"; }

python=""
for candidate in /usr/bin/python3 python3; do
    "$candidate" -c 'import sympy, scipy' 2>/dev/null && python=$candidate && break
done

# ---- measure ----
echo "  bench: whole runs" >&2
"$build/tests/bench_run" 20 -- "$build/nhsym" analyze sleigh -- "$build/nhsym" analyze sleigh --no-analysis -- "$build/nhsym" version \
    >"$work/run" || exit 1
median=$(field 1 2)
memory=$(field 1 4)
if [ -n "$python" ]; then
    echo "  bench: SymPy and SciPy" >&2
    "$build/tests/bench_run" 10 -- "$build/nhsym" simulate sleigh -- "$build/nhsym" analyze sleigh -- "$python" tests/bench_sympy.py >"$work/sympy" || python=""
fi
for name in tape nullspace chain ensemble; do
    echo "  bench: $name" >&2
    if [ -x "$build/tests/bench_$name" ]; then "$build/tests/bench_$name" >"$work/$name" || exit 1; fi
done

# ---- the page ----
model=$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo 2>/dev/null | head -n 1)
say "# Performance" "" \
    "Written by \`make bench\`; every table names the command that made it. Times are of the machine below while it may have had" \
    "other work to do: run it again before you rely on a number, the ratios within one table vary less than the times." "" \
    "Machine: ${model:-unknown processor}, $(nproc 2>/dev/null || echo '?') cores; $(${CC:-gcc} --version | head -n 1); optimisation -O2." ""

say "## A whole run" "" \
    "\`build/tests/bench_run 20 -- build/nhsym analyze sleigh -- build/nhsym analyze sleigh --no-analysis -- build/nhsym version\`" "" \
    "20 rounds after one that is not counted; a run is everything from the start of the process to its end. \`version\` only loads the" \
    "libraries. \`--no-analysis\` lets the program choose the ansatz stage by stage." "" \
    "| command | least, ms | median, ms | most, ms | peak memory, MB |" "|---|---|---|---|---|"
i=0
for name in "nhsym analyze sleigh" "nhsym analyze sleigh --no-analysis" "nhsym version"; do
    i=$((i + 1))
    say "| \`$name\` | $(field $i 1) | $(field $i 2) | $(field $i 3) | $(field $i 4) |"
done
say ""

say "## Beside SymPy and SciPy" ""
ratio=""
if [ -n "$python" ]; then
    ratio=$(awk 'NR == 1 { a = $2 } NR == 3 { printf "%.1f", $2 / a }' "$work/sympy")
    whole=$(awk 'NR == 2 { a = $2 } NR == 3 { printf "%.1f", $2 / a }' "$work/sympy")
    say "\`build/tests/bench_run 10 -- build/nhsym simulate sleigh -- build/nhsym analyze sleigh -- python3 tests/bench_sympy.py\`" "" \
        "The script derives Lagrange's equations of the same sleigh with SymPy's \`LagrangesMethod\`, compiles them to Python and integrates" \
        "them with SciPy to the same time at the same tolerance. \`simulate\` does the same; \`analyze\` also derives a second chart, finds and" \
        "proves the currents, and integrates four motions. The programs take turns. $("$python" -c 'import sympy, scipy; print(f"SymPy {sympy.__version__}, SciPy {scipy.__version__}.")')" "" \
        "| command | least, ms | median, ms | most, ms | peak memory, MB |" "|---|---|---|---|---|"
    awk 'NR == 1 { n = "nhsym simulate sleigh" } NR == 2 { n = "nhsym analyze sleigh" } NR == 3 { n = "python3 tests/bench_sympy.py" }
         { printf "| `%s` | %s | %s | %s | %s |\n", n, $1, $2, $3, $4 }' "$work/sympy" >>"$work/page"
    say "" "Ratio of the medians: $ratio to \`simulate\`, $whole to the whole analysis." ""
else
    say "Not measured: python3 with SymPy and SciPy was not found (Debian: \`apt-get install python3-sympy python3-scipy\`)." ""
fi

say "## Evaluation of a right-hand side" ""
batch=""
if [ -s "$work/tape" ]; then
    batch=$(awk -F'|' '/^\| sleigh/ && $4 + 0 == 256 && $8 + 0 > worst { worst = $8 + 0 } END { if (worst) print worst }' "$work/tape")
    say "\`build/tests/bench_tape\`" ""
    cat "$work/tape" >>"$work/page"
    say ""
else
    say "Not measured: build/tests/bench_tape was not built." ""
fi

say "## Null space" ""
null=""
if [ -s "$work/nullspace" ]; then
    null=$(awk -F'|' '$2 + 0 == 1000 { print $6 + 0 }' "$work/nullspace")
    say "\`build/tests/bench_nullspace\`" ""
    cat "$work/nullspace" >>"$work/page"
    say ""
else
    say "Not measured: build/tests/bench_nullspace was not built." ""
fi

say "## Chains of bodies" ""
ten=""
if [ -s "$work/chain" ]; then
    ten=$(awk -F'|' '$2 + 0 == 10 { print $3 + 0 }' "$work/chain")
    say "\`build/tests/bench_chain\`" "" \
        "Chains of n bodies on revolute joints, axes turned against each other. Building: from text to mass matrix and accelerations. By hand: composite" \
        "rigid bodies, recursive Newton and Euler and Cholesky in C (\`tests/chain.h\`). The tape is interpreted, one point or a batch of 256 points at a" \
        "time. Nanoseconds per point, the least of many short runs. The difference is that of the accelerations, relative." ""
    cat "$work/chain" >>"$work/page"
    say ""
else
    say "Not measured: build/tests/bench_chain was not built." ""
fi

say "## Many motions at once" ""
many=""
if [ -s "$work/ensemble" ]; then
    many=$(awk -F'|' '$3 + 0 > 0 && (least == "" || $7 + 0 < least) { least = $7 + 0 } END { print least }' "$work/ensemble")
    say "\`build/tests/bench_ensemble\`" "" \
        "The same motions by the same Runge-Kutta pair of order 8 at tolerance 1e-8: each alone, and in batches that take common steps. One thread; medians" \
        "of 5. The difference is the largest of a final state, relative to 1 + its size." ""
    cat "$work/ensemble" >>"$work/page"
    say ""
else
    say "Not measured: build/tests/bench_ensemble was not built." ""
fi

say "## Aims" "" "| aim | measured | |" "|---|---|---|" \
    "| a whole run of \`nhsym analyze sleigh\` below 50 ms (median) | $median ms | $(holds "$median" 50) |" \
    "| and below 50 MB | $memory MB | $(holds "$memory" 50) |" \
    "| SymPy and SciPy, deriving and integrating the same sleigh, beaten by a factor of 40 | ${ratio:-not measured} | $([ -n "$ratio" ] && holds 40 "$ratio") |" \
    "| a batch of 256 points at most 1.2 times as long as scalar C by hand, per point | ${batch:-not measured} | $([ -n "$batch" ] && holds "$batch" 1.2) |" \
    "| a chain of ten bodies from text to its equations below 1 s | $([ -n "$ten" ] && echo "$ten s" || echo "not measured") | $([ -n "$ten" ] && holds "$ten" 1) |" \
    "| many motions at once at least 2 times as fast as one by one | ${many:-not measured} | $([ -n "$many" ] && holds 2 "$many") |" \
    "| null space of 1000 columns from 20 000 rows below 2.5 s | $([ -n "$null" ] && echo "$null s" || echo "not measured") | $([ -n "$null" ] && holds "$null" 2.5) |"

mv "$work/page" "$out" && chmod 644 "$out" && echo "$out"
