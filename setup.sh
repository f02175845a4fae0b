#!/usr/bin/env bash
# Installs from Debian 12 packages what grainsweep is built with, three.js for its pages and
# gnuplot, which draws its figures, and for checks axe-core from npm. Does nothing when all of it is
# present. See usage below.
set -euo pipefail

readonly build_packages=(
  g++ cmake ninja-build
  libtbb-dev libeigen3-dev libxsimd-dev nlohmann-json3-dev libcli11-dev librandom123-dev
  libqhull-dev libmuparser-dev libboost-dev libmpfr-dev zlib1g-dev
  catch2 libbenchmark-dev
  gnuplot-nox libjs-three
)
readonly check_packages=(
  clang-format clang-tidy clang libclang-rt-14-dev strace python3 python3-jsonschema
  python3-pandas python3-matplotlib python3-ase lammps gmsh chromium lintian dpkg-dev parallel snakemake
  slurmctld slurmd slurm-client munge locales
)
# Where tests/checks/page.sh looks for axe-core, which finds what keeps people from reading a page.
readonly axe_version=4.14.1
readonly axe_home=${XDG_CACHE_HOME:-$HOME/.cache}/grainsweep-checks
readonly emulator_packages=(
  bochs bochs-term bochsbios vgabios isolinux syslinux-common genisoimage cpio busybox-static
)

usage() {
  cat <<'EOF'
usage: ./setup.sh [--checks] [--emulator]

Installs the packages that building and testing grainsweep takes, with apt-get, as root or through
sudo. Only what is missing is installed; with nothing missing it ends at once.

  --checks    also what .ci/run takes: clang-format and clang-tidy, clang for builds under
              sanitizers, strace, Python, LAMMPS, gmsh, Chromium and Slurm for the tests that need
              them, and axe-core, with npm, into ~/.cache/grainsweep-checks
  --emulator  also a PC emulator with AVX-512, for tests/checks/avx512_emulated.sh
  --help      this text
EOF
}

stop() {
  printf 'setup.sh: %s\n' "$@" >&2
  exit 1
}

# Sets `missing` to those of its arguments that are not installed.
find_missing() {
  local installed package
  installed=$(dpkg-query -W -f '${Package}=${db:Status-Status}\n' "$@" 2>/dev/null || true)
  missing=()
  for package in "$@"; do
    [[ $'\n'$installed$'\n' == *$'\n'"$package=installed"$'\n'* ]] || missing+=("$package")
  done
}

# Sets `as_root` to what has to stand before a command to run it as root.
find_root() {
  as_root=()
  if [[ $(id -u) == 0 ]]; then return; fi
  if ! command -v sudo >/dev/null; then
    stop "cannot install ${missing[*]}: neither root nor sudo is at hand." \
         "Ask an administrator to run: apt-get install ${missing[*]}"
  fi
  as_root=(sudo)
  if [[ ! -t 0 ]] && ! sudo -n true 2>/dev/null; then
    stop "cannot install ${missing[*]}: sudo asks for a password and there is no terminal." \
         "Run first, in a terminal: sudo apt-get install ${missing[*]}"
  fi
}

# Services are not started: tests start their own.
apt() {
  "${as_root[@]}" env RUNLEVEL=1 DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300 "$@"
}

install_missing() {
  printf 'setup.sh: installing %s\n' "${missing[*]}" >&2
  local log
  log=$(mktemp "${TMPDIR:-/tmp}/grainsweep-setup.XXXXXX")
  apt update >"$log" 2>&1 ||
    printf 'setup.sh: apt-get update failed; trying with the package lists at hand\n' >&2
  if ! apt install -y --no-install-recommends "${missing[@]}" >>"$log" 2>&1; then
    tail -n 15 "$log" >&2
    stop "apt-get could not install ${missing[*]} (its last words are above, all of them in $log)." \
         "Check the network and /etc/apt/sources.list: Debian 12 (bookworm) main has every package."
  fi
  rm -f "$log"
}

# A test that needs axe-core says so where it cannot be had.
install_axe() {
  grep -qs "axe v$axe_version" "$axe_home/node_modules/axe-core/axe.min.js" ||
    npm install --silent --no-audit --no-fund --prefix "$axe_home" "axe-core@$axe_version" >&2 ||
    printf 'setup.sh: axe-core %s could not be had from npm\n' "$axe_version" >&2
}

with_checks=no
packages=("${build_packages[@]}")
while (($#)); do
  case $1 in
    --checks)
      with_checks=yes
      packages+=("${check_packages[@]}")
      command -v npm >/dev/null || packages+=(npm) # nodejs from elsewhere brings its own
      ;;
    --emulator) packages+=("${emulator_packages[@]}") ;;
    -h | --help) usage && exit 0 ;;
    *) usage >&2 && stop "unknown option $1" ;;
  esac
  shift
done

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  stop "this system has no dpkg and apt-get; it installs packages on Debian 12 and its relatives." \
       "Elsewhere install by hand what these Debian packages hold: ${packages[*]}" \
       "then build with: cmake --preset release && cmake --build --preset release"
fi
find_missing "${packages[@]}"
if ((${#missing[@]})); then
  find_root
  install_missing
fi
if [[ $with_checks == yes ]]; then install_axe; fi
