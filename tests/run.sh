#!/bin/sh
# Runs Criterion programs, one more at a time than there are processors, because some wait (for a limit of time, a browser, a server), and adds up what they say.  Those that took longest last time go first; before the first time, those that run other programs (a compiler, Python), then those with sweeps.
# usage: run.sh BUILD|PROGRAM...          the last line is "N passed, N failed"
if [ "$1" = --one ]; then # a program: its log, with the seconds of each test, and its line "name passed failed seconds" stay beside it
    program=$2
    log=$program.log
    NHSYM="${program%/tests/*}/nhsym" timeout -k 10 1500 "$program" --jobs 1 --verbose=1 >"$log" 2>&1 # many times what any takes: one that hangs is a failure
    code=$?
    line=$(sed 's/\x1b\[[0-9;]*m//g' "$log" | grep -a 'Synthesis:' | tail -n 1)
    good=$(printf '%s' "$line" | sed -n 's/.*Passing: *\([0-9]*\).*/\1/p')
    all=$(printf '%s' "$line" | sed -n 's/.*Tested: *\([0-9]*\).*/\1/p')
    : "${good:=0}" "${all:=0}"
    bad=$((all - good))
    [ "$all" = 0 ] && grep -aq -e 'skipped: ' -e 'Test is disabled' "$log" && all=skipped # all of them, and the program says why
    [ "$code" != 0 ] && [ "$bad" = 0 ] && ! grep -aq 'skipped: ' "$log" && bad=1 # a warning makes it 1
    [ "$all" = 0 ] && bad=1
    grep -aq -e 'LeakSanitizer: detected' -e 'runtime error:' -e 'ERROR: AddressSanitizer' "$log" && bad=$((bad + 1)) # Criterion passes these over
    times >"$log.said" # of the processor: by these the programs are compared
    seconds=$(sed -n '2s/[ms]/ /gp' "$log.said" | awk '{ print int(60 * $1 + $2 + 60 * $3 + $4 + 0.5) }')
    echo "$program $good $bad $seconds" >"$program.line"
    {
        printf '%-45s %4d passed %3d failed %5d s\n' "$program" "$good" "$bad" "$seconds"
        grep -a '^measured: ' "$log"
        [ "$all" = skipped ] && grep -a -e 'skipped: ' -e 'Test is disabled' "$log" | head -n 1
        [ "$bad" = 0 ] || grep -av -e '\[RUN \]' -e '\[PASS\]' "$log"
    } >"$log.said"
    cat "$log.said" && rm "$log.said"
    exit 0
fi
# Threads of OpenBLAS, of three programs on two processors, mostly wait for each other.
export OPENBLAS_NUM_THREADS="${OPENBLAS_NUM_THREADS:-1}"
# And its kernels are those that the program takes (src/cli/archives.c): for a processor that it does not know it would take its slowest.
[ "$OPENBLAS_CORETYPE" ] || ! grep -qw avx2 /proc/cpuinfo 2>/dev/null || ! grep -qw fma /proc/cpuinfo || export OPENBLAS_CORETYPE=Haswell
# A third of the time under the address sanitizer went into call stacks of thirty frames and memory held back; what is set already has the last word (malloc_context_size=30 to see where a block came from).
export ASAN_OPTIONS="malloc_context_size=1:quarantine_size_mb=8:$ASAN_OPTIONS"
programs=$(for name in "$@"; do
    if [ -d "$name" ]; then ls "$name"/tests/test_*; else echo "$name"; fi
done | grep -v '\.[a-z]*$')
before=$(for program in $programs; do
    seconds=$(cut -d' ' -f4 "$program.line" 2>/dev/null)
    [ "$seconds" ] || ! grep -q 'popen(' "tests/${program##*/}.c" 2>/dev/null || seconds=100
    [ "$seconds" ] || seconds=$(grep -c -e sweep_ -e PLAIN_ONLY -e WHOLE_ONLY "tests/${program##*/}.c" 2>/dev/null)
    echo "${seconds:-0} $program"
    rm -f "$program.line"
done | sort -rn | cut -d' ' -f2)
echo "$before" | xargs -P $(($(nproc 2>/dev/null || echo 2) + 1)) -n 1 sh "$0" --one
passed=0
failed=0
for program in $programs; do
    good=0
    bad=1 # one that left no line
    [ -f "$program.line" ] && read -r _ good bad _ <"$program.line"
    passed=$((passed + good))
    failed=$((failed + bad))
    [ "$bad" = 0 ] || { # again, where one looks first, and where a log that was cut off still has it
        echo "failed: $program"
        grep -av -e '\[RUN \]' -e '\[PASS\]' -e '^measured: ' "$program.log" | head -n 40
    }
done
echo "$passed passed, $failed failed"
[ "$failed" = 0 ] && [ "$passed" -gt 0 ]
