#!/usr/bin/env bash
# setup.sh installs exactly what is missing and says what to do where it cannot. It is run with a
# PATH of stand-ins for dpkg-query, apt-get, id and sudo, so nothing is really installed.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
stand_ins=$(mktemp -d "${TMPDIR:-/tmp}/grainsweep-setup-test.XXXXXX")
readonly root stand_ins
trap 'rm -rf "$stand_ins"' EXIT

# stand_in NAME: standard input becomes the script that stands in for the command NAME.
stand_in() {
  { printf '#!/bin/bash\n' && cat; } >"$stand_ins/bin/$1"
  chmod +x "$stand_ins/bin/$1"
}

# A system with apt where PACKAGES are missing and everything works; USER is the user's id.
new_system() {
  local user=$1 missing=$2 tool
  rm -rf "${stand_ins:?}/bin" && mkdir "$stand_ins/bin"
  for tool in bash cat env mktemp rm tail; do ln -s "$(command -v $tool)" "$stand_ins/bin"; done
  stand_in id <<<"echo $user"
  stand_in dpkg-query <<EOF
for name; do [[ " -W -f $missing " == *" \$name "* || \$name == *{* ]] || echo "\$name=installed"; done
EOF
  stand_in apt-get <<<"echo \"apt-get \$*\" >>'$stand_ins/calls'"
  : >"$stand_ins/calls"
}

# said_or_called TEXT: setup.sh printed it or called apt-get with it; with no TEXT, did neither.
said_or_called() {
  if [[ -n $1 ]]; then
    grep -qF -- "$1" "$stand_ins/output" "$stand_ins/calls"
  else
    [[ ! -s $stand_ins/output && ! -s $stand_ins/calls ]]
  fi
}

# expect STATUS TEXT [OPTION...]: setup.sh ends with STATUS and says (or calls apt-get with) TEXT.
expect() {
  local status=0
  env PATH="$stand_ins/bin" TMPDIR="$stand_ins" "$BASH" "$root/setup.sh" "${@:3}" \
    >"$stand_ins/output" 2>&1 </dev/null || status=$?
  if [[ $status != "$1" ]] || ! said_or_called "$2"; then
    printf 'setup.sh: expected status %s and "%s", got status %s and:\n' "$1" "$2" "$status" >&2
    cat "$stand_ins/output" "$stand_ins/calls" >&2
    exit 1
  fi
}

new_system 0 ''
expect 0 ''

new_system 0 'catch2 ninja-build'
expect 0 'install -y --no-install-recommends ninja-build catch2'

new_system 0 'clang-tidy'
expect 0 ''
expect 0 'install -y --no-install-recommends clang-tidy' --checks

new_system 1000 'catch2'
expect 1 'Ask an administrator to run: apt-get install catch2'
stand_in sudo <<<'exit 1'
expect 1 'sudo asks for a password and there is no terminal'
# shellcheck disable=SC2016
stand_in sudo <<<'[[ $1 == -n ]] && shift; "$@"'
ln -s "$(command -v true)" "$stand_ins/bin"
expect 0 'install -y --no-install-recommends catch2'

new_system 0 'catch2'
stand_in apt-get <<<'echo "E: no route to the archive" && exit 100'
expect 1 'E: no route to the archive'
expect 1 'apt-get could not install catch2'

rm "$stand_ins/bin/dpkg-query"
expect 1 'this system has no dpkg and apt-get'
expect 1 'unknown option --chekcs' --chekcs
printf 'setup.sh: installs what is missing, explains what it cannot\n'
