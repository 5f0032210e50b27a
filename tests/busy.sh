#!/bin/sh
# Runs a command beside N loops that keep the processors busy; its exit code is the command's.  No answer may depend on them, only the time:
#
#     sh tests/busy.sh 6 make check
#
# A loop ends by itself when this script is gone, however it ended.
if [ $# -lt 2 ] || ! [ "$1" -ge 0 ] 2>/dev/null; then
    echo "usage: busy.sh N COMMAND ..." >&2
    exit 2
fi
count=$1
shift
loops=
trap 'kill $loops 2>/dev/null' EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP
while [ "$count" -gt 0 ]; do
    (
        trap - EXIT
        while kill -0 $$ 2>/dev/null; do
            i=0
            while [ $i -lt 20000 ]; do i=$((i + 1)); done
        done
    ) </dev/null >/dev/null 2>&1 &
    loops="$loops $!" count=$((count - 1))
done
"$@"
