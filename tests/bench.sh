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
# the rows of a table, then an empty line; numbers from it by awk, nothing where it was not made
table() { cat "$work/$1" >>"$work/page" && say ""; }
from() { [ -s "$work/$1" ] && awk -F'|' "$2" "$work/$1"; }
# a section of what build/tests/bench_NAME printed: its title, NAME, what to say before the table
section() {
    title=$1 name=$2
    shift 2
    say "## $title" ""
    if [ -s "$work/$name" ]; then say "\`build/tests/bench_$name\`" "" "$@" "" && table "$name"; else say "Not measured: build/tests/bench_$name was not built." ""; fi
}
# a line of the aims: what, the measured number (or nothing), its unit, `at most` or `at least`, the number that is aimed at
aim() {
    if [ -z "$2" ]; then verdict=""; elif [ "$4" = "at most" ]; then verdict=$(holds "$2" "$5"); else verdict=$(holds "$5" "$2"); fi
    say "| $1 | ${2:-not measured}${2:+$3} | $verdict |"
}
# "holds" when the first number is at most the second
holds() { awk -v x="$1" -v y="$2" 'BEGIN { print (x == "" ? "not measured" : x + 0 <= y + 0 ? "holds" : "**does not hold**") }'; }
# the i-th command of the whole runs, its j-th number
field() { sed -n "${1}p" "$work/run" | cut -d' ' -f"$2"; }

python=""
for candidate in /usr/bin/python3 python3; do
    "$candidate" -c 'import numpy, sympy, scipy' 2>/dev/null && python=$candidate && break
done
octave=""
command -v octave >/dev/null && octave --no-gui -qf --eval '[t, y] = ode45(@(t, y) -y, [0 1], 1);' >/dev/null 2>&1 && octave=octave

# ---- measure ----
echo "  bench: whole runs" >&2
"$build/tests/bench_run" 20 -- "$build/nhsym" analyze sleigh -- "$build/nhsym" analyze sleigh --no-analysis -- "$build/nhsym" version -- "$build/tests/nhsym-shared" version \
    >"$work/run" || exit 1
median=$(field 1 2)
memory=$(field 1 4)
if [ -n "$python" ]; then
    echo "  bench: SymPy and SciPy" >&2
    "$build/tests/bench_run" 10 -- "$build/nhsym" simulate sleigh -- "$build/nhsym" analyze sleigh -- "$python" tests/bench_sympy.py >"$work/sympy" || python=""
fi
echo "  bench: side by side" >&2
: >"$work/octave"
[ -n "$octave" ] && { octave --no-gui -qf tests/bench_octave.m >"$work/octave" 2>/dev/null || : >"$work/octave"; }
: >"$work/scipy"
: >"$work/numpy"
if [ -n "$python" ]; then
    "$python" tests/bench_sympy.py 2>/dev/null | tail -n 1 >"$work/scipy"
    OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 "$python" tests/bench_nullspace.py 1000 20000 >"$work/numpy" 2>/dev/null || : >"$work/numpy"
fi
# to the smallest of the errors that the others reached
least=$(cat "$work/scipy" "$work/octave" | awk '{ if (x == "" || $NF + 0 < x + 0) x = $NF } END { print x == "" ? 1e-10 : x }')
"$build/tests/bench_side" "$least" >"$work/side" || exit 1
for name in tape nullspace chain ensemble stress series; do
    echo "  bench: $name" >&2
    if [ -x "$build/tests/bench_$name" ]; then "$build/tests/bench_$name" >"$work/$name" || exit 1; fi
done

echo "  bench: every system" >&2
sh tests/bench_whole.sh "$build" >"$work/whole" || exit 1
echo "  bench: growth" >&2
sh tests/bench_growth.sh "$build" >"$work/growth" || exit 1
echo "  bench: accuracy" >&2
"$build/tests/bench_accuracy" systems >"$work/accuracy" || exit 1

# ---- the page ----
model=$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo 2>/dev/null | head -n 1)
say "# Performance" "" \
    "Written by \`make bench\`; every table names the command that made it. Times are those of the machine below, which may have had" \
    "other work: measure again before you rely on a number. Ratios within a table vary less than times." "" \
    "Machine: ${model:-unknown processor}, $(nproc 2>/dev/null || echo '?') cores; $(${CC:-gcc} --version | head -n 1); optimisation -O2. Measured on $(date +%F)." ""

say "## A whole run" "" \
    "\`build/tests/bench_run 20 -- build/nhsym analyze sleigh -- build/nhsym analyze sleigh --no-analysis -- build/nhsym version -- build/tests/nhsym-shared version\`" "" \
    "20 rounds after one that is not counted; a run is everything from the start of the process to its end. \`version\` only loads the" \
    "libraries; \`nhsym-shared\` is the same program without archives in it (\`make ARCHIVES=\`). \`--no-analysis\` lets the program choose the ansatz stage by stage." "" \
    "| command | least, ms | median, ms | most, ms | peak memory, MB |" "|---|---|---|---|---|"
i=0
for name in "nhsym analyze sleigh" "nhsym analyze sleigh --no-analysis" "nhsym version" "nhsym-shared version"; do
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
    say "Not measured: python3 with NumPy, SymPy and SciPy was not found (Debian: \`apt-get install python3-numpy python3-sympy python3-scipy\`)." ""
fi

say "## Side by side, part by part" "" \
    "\`build/tests/bench_side $least\`, \`python3 tests/bench_sympy.py\`, \`octave tests/bench_octave.m\`, \`python3 tests/bench_nullspace.py 1000 20000\`" "" \
    "Inside one process each, without its start. The motion of the sleigh to t = 10, nhsym's to the least of the errors of the others; Octave gets equations derived by hand." \
    "The null space is that of a matrix of 20 000 rows and 1000 columns, by the singular values of the matrix (as \`scipy.linalg.null_space\` does) and by those of R" \
    "of its QR decomposition; then that of a pair of such matrices, how little A c is where B c varies, which is what nhsym needs (see below). One thread." "" \
    "| | nhsym | SymPy and SciPy, NumPy | Octave ode45 |" "|---|---|---|---|"
read -r side_derive side_move side_error <"$work/side"
read -r scipy_derive scipy_move scipy_error <"$work/scipy"
read -r octave_move octave_error <"$work/octave"
read -r numpy_svd numpy_qr numpy_dimension numpy_pair numpy_pair_qr <"$work/numpy"
null_all=$(from nullspace 'NF == 14 && $2 + 0 == 1000 { print $13 + 0 }')
null_here=$(from nullspace 'NF == 14 && $2 + 0 == 1000 { print $6 + 0 }')
one_here=$(from nullspace 'NF == 14 && $2 + 0 == 1000 { print $12 + 0 }')
say "| derivation, ms | $side_derive | ${scipy_derive:-not installed} | by hand |" \
    "| motion, ms (error) | $side_move ($side_error) | ${scipy_move:-not installed} ${scipy_error:+($scipy_error)} | ${octave_move:-not installed} ${octave_error:+($octave_error)} |" \
    "| null space of one matrix, s | $one_here | ${numpy_svd:-not installed}${numpy_qr:+, by QR first $numpy_qr} | |" \
    "| of a pair, s | $null_here | ${numpy_pair:-not installed}${numpy_pair_qr:+, by QR first $numpy_pair_qr} | |" ""
ratio_of() { [ -n "$1" ] && [ -n "$2" ] && awk -v x="$1" -v y="$2" 'BEGIN { printf "%.1f", x / y }'; }
derive_ratio=$(ratio_of "$scipy_derive" "$side_derive")
move_ratio=$(ratio_of "$scipy_move" "$side_move")
both_ratio=$(awk -v a="$scipy_derive" -v b="$scipy_move" -v c="$side_derive" -v d="$side_move" 'BEGIN { if (a && b && c && d) printf "%.1f", (a + b) / (c + d) }')
octave_ratio=$(ratio_of "$octave_move" "$side_move")
numpy_ratio=$(ratio_of "$numpy_svd" "$one_here")
numpy_pair_ratio=$(ratio_of "$numpy_pair" "$null_here")

section "Evaluation of a right-hand side" tape "Compiled: by the C compiler of this machine from the tape, the same bits ([motions.md](motions.md), section 6)."
batch=$(from tape '/^\| sleigh/ && $4 + 0 == 256 && $10 + 0 > worst { worst = $10 + 0 } END { if (worst) print worst }')
compiled=$(from tape '/^\| sleigh/ && $9 + 0 > worst { worst = $9 + 0 } END { if (worst) print worst }')

section "Null space" nullspace \
    "Rate: 2 m n^2 operations for each QR decomposition of m rows and n columns and 5 n^3 for the quotient and its singular vectors, per second, over those of dgemm. The second table is a real" \
    "ansatz in its Chebyshev basis; assembly are the values and rates of all its columns at all samples."
rate=$(from nullspace 'NF == 14 && $2 + 0 == 1000 { print $9 + 0 }')
gap=$(from nullspace 'NF == 9 && $2 + 0 > 900 { print $8 + 0 }')
assembly=$(from nullspace 'NF == 9 && $2 + 0 > 900 && $5 > 0 { printf "%.2f", $4 / $5 }')

section "Chains of bodies" chain \
    "Chains of n bodies on revolute joints, axes turned against each other. Building: from text to mass matrix and accelerations. By hand: composite" \
    "rigid bodies, recursive Newton and Euler and Cholesky in C (\`tests/chain.h\`). The tape is interpreted or compiled, one point, or interpreted for a batch of 256 points" \
    "at a time. Nanoseconds per point, the least of many short runs. The difference is that of the accelerations, relative."
ten=$(from chain '$2 + 0 == 10 { print $3 + 0 }')

section "Counting integrals" series \
    "The linear systems of the count ([method.md](method.md), section 10) for a natural system with a polynomial potential: the even part of the given degree in the velocities, of series up to" \
    "two orders above it. Least of some runs of the solver alone. Parameters: the most that are free at a time. Then whole counts of one degree of shipped systems, with all orders that they take." \
    "The aims are half of what a first version of the solver took."

say "## Every system" "" "\`tests/bench_whole.sh build\`" "" \
    "Whole runs of \`nhsym analyze --no-analysis\`, from the start of the process to its end, one for each shipped system." ""
table whole
whole_time=$(from whole 'NR == 3 { print $3 + 0 }')
whole_median=$(from whole 'NR == 3 { print $4 + 0 }')
whole_most=$(from whole 'NR == 3 { split($5, a, " "); print a[2] + 0 }')

say "## Growth" "" "\`tests/bench_growth.sh build\`" "" \
    "Medians of three whole runs of \`nhsym analyze\`, less that of \`nhsym version\`. How chains of bodies grow stands in the section before." ""
table growth

section "Many motions at once" ensemble \
    "The same motions at tolerance 1e-8: each alone by CVODE Adams, each alone by a Runge-Kutta pair of order 8, and by this in batches that take common steps. One thread;" \
    "medians of 3. The difference is the largest of a final state, relative to 1 + its size."
many=$(from ensemble '$3 + 0 > 0 && (least == "" || $9 + 0 < least) { least = $9 + 0 } END { print least }')
sleighs=$(from ensemble '/^\| sleigh/ { print $8 + 0 }')

say "## A wanted accuracy" "" "\`build/tests/bench_accuracy systems\`" "" \
    "\`--accuracy\` on every shipped system, six starts and three times each. Truth: Runge-Kutta of order 8 at 1e-14 where another pair agrees to a tenth of eps; of what is accepted" \
    "nothing may be wrong. Cheapest: the run of rk8pd, rkf45 or CVODE Adams with the loosest tolerance that has an error below eps, found by trying; evaluations, counted work and time of all runs that" \
    "\`--accuracy\` makes, over those of it. Not accepted are motions that end in a singularity, and some whose rounding errors grow beyond eps." ""
table accuracy
accuracy_work=$(from accuracy '/^\| all/ { print $11 + 0 }')
accuracy_time=$(from accuracy '/^\| all/ { print $13 + 0 }')
accuracy_cases=$(from accuracy '/^\| all/ { n += $3 } END { print n }')
accuracy_wrong=$(from accuracy '/^\| all/ { n += $5 } END { print n + 0 }')

say "## Robustness" "" "\`build/tests/bench_stress\`" "" \
    "Cells of the shipped maps ([motions.md](motions.md), section 4), five methods on every value of motions, up to four ways on those of the discrete problem. Below: the energy of a motion that nothing turns round in time" \
    "(a pendulum that rotates drives the direction of a velocity), and of one that is (it librates), by methods of fixed steps [ModinVerdier2020]." ""
table stress
silent=$(from stress 'NR > 2 && NF == 11 { n += $9 } END { print n + 0 }')

say "## Aims" "" "| aim | measured | |" "|---|---|---|"
aim "a whole run of \`nhsym analyze sleigh\` below 50 ms (median)" "$median" " ms" "at most" 50
aim "and below 50 MB" "$memory" " MB" "at most" 50
aim "SymPy and SciPy, deriving and integrating the same sleigh, as whole processes, beaten by a factor of 100" "$ratio" "" "at least" 100
aim "the derivation by SymPy beaten by a factor of 40" "$derive_ratio" "" "at least" 40
aim "the motion by SciPy at no larger error beaten by a factor of 50" "$move_ratio" "" "at least" 50
aim "both together, inside the processes, beaten by a factor of 100" "$both_ratio" "" "at least" 100
aim "the motion by Octave beaten by a factor of 50" "$octave_ratio" "" "at least" 50
aim "the null space of one matrix by NumPy's singular values beaten by a factor of 2" "$numpy_ratio" "" "at least" 2
aim "and that of a pair" "$numpy_pair_ratio" "" "at least" 2
aim "the null space of 1000 columns at 50 % of dgemm's rate" "$rate" " %" "at least" 50
aim "its gap in the Chebyshev basis above 1e10" "$gap" "" "at least" 1e10
aim "and its assembly no slower than the QR decompositions" "$assembly" "" "at most" 1
aim "every shipped system analysed below a minute together" "$whole_time" " s" "at most" 60
aim "with a median below 0.3 s" "$whole_median" " s" "at most" 0.3
aim "and none above 5 s" "$whole_most" " s" "at most" 5
aim "a compiled right-hand side at most 1.5 times as long as C by hand" "$compiled" "" "at most" 1.5
aim "10 000 sleighs at once at least 10 times as fast as one by one by CVODE" "$sleighs" "" "at least" 10
aim "--accuracy: of $accuracy_cases motions none accepted and wrong" "$accuracy_wrong" "" "at most" 0
aim "and its median counted work below 4 times that of the cheapest run that suffices" "$accuracy_work" "" "at most" 4
aim "and its median time likewise below 5 times" "$accuracy_time" "" "at most" 5
aim "undetected cells in the robustness maps: none" "$silent" "" "at most" 0
aim "a batch of 256 points at most 1.0 times as long as scalar C by hand, per point" "$batch" "" "at most" 1
aim "a chain of ten bodies from text to its equations below 1 s" "$ten" " s" "at most" 1
aim "many motions at once at least 2 times as fast as one by one" "$many" "" "at least" 2
aim "null space of 1000 columns from 20 000 rows below 2.5 s, on all processors" "$null_all" " s" "at most" 2.5

mv "$work/page" "$out" && chmod 644 "$out" && echo "$out"
