#!/bin/sh
# Runs every Criterion program of the given build folders and adds up what they say.
# usage: run.sh BUILD...          the last line is "N passed, N failed"
passed=0
failed=0
log=$(mktemp)
for build in "$@"; do
    for program in "$build"/tests/test_*; do
        case "$program" in *.o | *.d) continue ;; esac
        NHSYM="$build/nhsym" timeout -k 10 900 "$program" --jobs 2 >"$log" 2>&1 # many times what any takes: one that hangs is a failure
        code=$?
        line=$(sed 's/\x1b\[[0-9;]*m//g' "$log" | grep -a 'Synthesis:' | tail -n 1)
        good=$(printf '%s' "$line" | sed -n 's/.*Passing: *\([0-9]*\).*/\1/p')
        all=$(printf '%s' "$line" | sed -n 's/.*Tested: *\([0-9]*\).*/\1/p')
        : "${good:=0}" "${all:=0}"
        bad=$((all - good))
        [ "$code" != 0 ] && [ "$bad" = 0 ] && bad=1
        [ "$all" = 0 ] && bad=1
        grep -aq -e 'LeakSanitizer: detected' -e 'runtime error:' -e 'ERROR: AddressSanitizer' "$log" && bad=$((bad + 1)) # Criterion passes these over
        printf '%-45s %4d passed %3d failed\n' "$program" "$good" "$bad"
        grep -a '^measured: ' "$log"
        [ "$bad" = 0 ] || cat "$log"
        passed=$((passed + good))
        failed=$((failed + bad))
    done
done
rm -f "$log"
echo "$passed passed, $failed failed"
[ "$failed" = 0 ] && [ "$passed" -gt 0 ]
