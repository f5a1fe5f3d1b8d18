#!/bin/sh
# full_disk.sh RANKS MPIEXEC PROGRAM: all ranks write one file on a disk that is too small, then on one that is not.
# Exit code 77 (skipped) where no small file system can be mounted.
ranks=$1; mpiexec=$2; program=$3
folder=$(mktemp -d)
trap 'umount "$folder" 2>/dev/null; rm -rf "$folder" "$folder.txt"' EXIT
if ! mount -t tmpfs -o size=64k tmpfs "$folder" 2>/dev/null; then
  echo "skipped: no right to mount a small file system here"
  exit 77
fi
"$mpiexec" -n "$ranks" "$program" "$folder" >"$folder.txt" 2>&1
code=$?
cat "$folder.txt"
if [ $code != 74 ]; then echo "FAILED: exit code $code, expected 74"; exit 1; fi
if [ "$(grep -c 'No space left' "$folder.txt")" != 1 ]; then echo "FAILED: not told once"; exit 1; fi
if [ -e "$folder/samples.h5" ]; then echo "FAILED: a half file under the final name"; exit 1; fi
mount -o remount,size=20m "$folder" || exit 1
"$mpiexec" -n "$ranks" "$program" "$folder" || { echo "FAILED: not written after space was made"; exit 1; }
[ -e "$folder/samples.h5" ] || { echo "FAILED: no file"; exit 1; }
[ ! -e "$folder/.samples.h5.part" ] || { echo "FAILED: a leftover"; exit 1; }
