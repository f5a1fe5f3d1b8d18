#!/bin/sh
# ending.sh RANKS MPIEXEC PROGRAM: errors and signals under mpirun. Exit code as promised, the message told once.
ranks=$1; mpiexec=$2; program=$3
failures=0

check() { # WHAT EXPECTED_CODE EXPECTED_MESSAGES CODE OUTPUT
  told=$(grep -c trouble "$5")
  if [ "$4" != "$2" ] || [ "$told" != "$3" ]; then
    echo "FAILED $1: exit code $4 (expected $2), told $told times (expected $3)"
    cat "$5"
    failures=$((failures + 1))
  fi
}

output=$(mktemp)
trap 'rm -f "$output"' EXIT
for case in ok:0:0 one:3:1 all:3:1 shared:2:1 block:75:1; do
  what=${case%%:*}; rest=${case#*:}
  "$mpiexec" -n "$ranks" "$program" "$what" >"$output" 2>&1
  check "$what" "${rest%%:*}" "${rest#*:}" $? "$output"
done

# SIGUSR1, which mpirun passes on, stops all ranks after their open blocks.
"$mpiexec" -n "$ranks" "$program" sweep >"$output" 2>&1 &
pid=$!
tries=0
while [ "$(grep -c ready "$output")" -lt "$ranks" ] && [ $tries -lt 300 ]; do sleep 0.1; tries=$((tries + 1)); done
kill -USR1 $pid
wait $pid
check "stop on a signal" 75 0 $? "$output"
exit $failures
