# Shell functions that the scripts share. Sourced by bash: `. "$(dirname "$0")/lib.sh"`.
# shellcheck shell=bash
freestand_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

say() { printf '%s\n' "$*"; }
step() { printf '\n== %s\n' "$*"; }
die() {  # die EXIT_CODE TEXT...
  local code=$1
  shift
  printf '%s: %s\n' "${0##*/}" "$*" >&2
  exit "$code"
}

# Waits for a process of this shell and sets `code` to its exit code. A signal that the shell traps ends `wait`, not the
# process.
wait_for() {  # wait_for PROCESS
  while ! wait "$1" && kill -0 "$1" 2>/dev/null; do :; done
  code=0
  wait "$1" || code=$?
}

# Cores this process may use.
cores() { nproc 2>/dev/null || getconf _NPROCESSORS_ONLN; }

# Debian packages of jobs/packages.txt, one a line: those that freestand needs, and those that are only nice to have.
needed_packages() { sed -e '/# optional/d' -e 's/#.*//' -e '/^[[:space:]]*$/d' "$freestand_root/jobs/packages.txt"; }
optional_packages() { sed -n 's/[[:space:]]*# optional.*//p' "$freestand_root/jobs/packages.txt"; }

# Which of the packages on standard input are not installed, one a line.
missing_of() {
  local wanted
  wanted=$(sort -u)
  # shellcheck disable=SC2016  # dpkg-query fills these in
  # One name that dpkg has never heard of makes dpkg-query fail; it still lists the others.
  comm -23 <(printf '%s\n' "$wanted") \
    <(printf '%s\n' "$wanted" | xargs dpkg-query -W -f '${db:Status-Abbrev} ${Package}\n' 2>/dev/null | sed -n 's/^ii  *//p' | sort -u)
}

# What mpirun asks for on this machine: root must be allowed, every hardware thread counts as a slot, and ranks are not
# bound to cores, since a container may hold only some of them.
mpirun_here() {  # mpirun_here RANKS PROGRAM ARGUMENTS...
  local ranks=$1
  shift
  mpi_environment
  mpirun --use-hwthread-cpus --oversubscribe --bind-to none -n "$ranks" "$@"
}

mpi_environment() {
  if [ "$(id -u)" = 0 ]; then
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  fi
  # Copying between processes by the kernel is forbidden in many containers; without it Open MPI warns at every start.
  export OMPI_MCA_btl_vader_single_copy_mechanism=${OMPI_MCA_btl_vader_single_copy_mechanism:-none}
}

# Levels of x86-64 that this machine runs, as FREESTAND_LEVELS takes them: kernels of others only cost the compiler time here. A build for a
# cluster of several kinds of machines keeps all: cmake --preset release.
levels_here() {
  local flags
  flags=$(sed -n '/^flags/{p;q}' /proc/cpuinfo 2>/dev/null || true)
  case " $flags " in
    *" avx512vl "*) echo "v2;v3;v4" ;;
    *" avx2 "*) echo "v2;v3" ;;
    *" sse4_2 "*) echo v2 ;;
    *) echo "v2;v3;v4" ;;
  esac
}

# Configures and builds with a preset, for this machine: build PRESET [TARGETS...]
build() {
  local preset=$1 log
  shift
  cd "$freestand_root" || die 1 "there is no $freestand_root"
  log=build/$preset/configure.log
  mkdir -p "build/$preset"
  if ! cmake --preset "$preset" -DFREESTAND_LEVELS="$(levels_here)" >"$log" 2>&1; then
    tail -n 30 "$log" >&2
    die 1 "cmake could not configure (see $freestand_root/$log)"
  fi
  cmake --build "build/$preset" --parallel "$(cores)" ${1:+--target "$@"}
}

# The same, and a warning of the compiler is a mistake: build_without_warnings PRESET [TARGETS...]
build_without_warnings() {
  local folder=$freestand_root/build/$1
  mkdir -p "$folder"
  build "$@" 2>&1 | tee "$folder/build.log"
  if grep -q 'warning:' "$folder/build.log"; then
    rm -f "$folder/.ninja_deps"  # so that the next build says it again
    die 1 "the build warns (see $folder/build.log): mend what it warns of"
  fi
}
