#!/bin/bash
# A sweep of any size and its fit on one machine or a few, with plain mpirun. Can be stopped and started again at any time:
# finished blocks are kept, and the results are the same to the bit.
#
#   jobs/freestand.mpirun.sh STUDY.yaml DIR [RANKS] [HOSTFILE]
#   jobs/freestand.mpirun.sh CATALOGUE.yaml DB catalogue [RANKS] [HOSTFILE]       # a catalogue instead
#   jobs/freestand.mpirun.sh VALIDATION.yaml DIR diagnose [RANKS] [HOSTFILE]      # or which effect measurements ask for
#
# RANKS: default all cores. HOSTFILE: as mpirun takes it, when the ranks run on more than one machine; DIR and the
# program must then be seen by all of them under the same path.
# Exit: that of freestand; 75 = stopped early, start the same line again to go on; 74 = the same, once what it names is cured.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
[ $# -ge 2 ] || die 2 "give a study and a folder: jobs/freestand.mpirun.sh STUDY.yaml DIR [RANKS] [HOSTFILE]"
line=("$@")
study=$1 folder=$2 verb=run
shift 2
case ${1:-} in run | catalogue | diagnose) verb=$1 && shift ;; esac
ranks=${1:-$(cores)} hostfile=${2:-}
freestand=${FREESTAND:-$freestand_root/build/release/freestand}
[[ $ranks =~ ^[1-9][0-9]*$ ]] || die 2 "RANKS is \"$ranks\": give a whole number above zero, or catalogue or diagnose before it"
[ -x "$freestand" ] || die 2 "there is no $freestand: build it (cmake --preset release && cmake --build build/release) or set FREESTAND"

resume=()
[ "$verb" = catalogue ] || [ ! -e "$folder" ] || resume=(--resume)
options=(-n "$ranks")
if [ -n "$hostfile" ]; then
  options+=(--hostfile "$hostfile")
else
  options+=(--use-hwthread-cpus --oversubscribe --bind-to none)
fi
mpi_environment

# mpirun passes SIGUSR1 on to the ranks that it has started, which end with 75 within ten seconds; while it starts them it loses what it is
# sent, so that it is sent until all have ended. SIGTERM, and the SIGINT that a terminal sends to all that it started, would end mpirun with
# 1: it runs in a session of its own, and hears what this script hears.
setsid mpirun "${options[@]}" "$freestand" "$verb" "$study" -o "$folder" "${resume[@]}" &
run=$!
asked=
# shellcheck disable=SC2317  # by the trap
ask_to_stop() {
  [ -z "$asked" ] || return 0
  asked=yes
  while kill -USR1 "$run" 2>/dev/null; do sleep 1; done &
}
trap ask_to_stop TERM INT USR1
wait_for "$run"
if [ "$code" = 75 ]; then
  say "stopped early; to go on:$(printf ' %q' "$0" "${line[@]}")"
fi
exit "$code"
