#!/usr/bin/env bash
# run.sh says when it builds, for the first time or anew, and is silent when there is nothing to do;
# a build that fails is shown. It is run in a copy with stand-ins for setup.sh, cmake and grainsweep.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
copy=$(mktemp -d "${TMPDIR:-/tmp}/grainsweep-run-test.XXXXXX")
readonly root copy
trap 'rm -rf "$copy"' EXIT

# stand_in FILE: standard input becomes the script FILE of the copy.
stand_in() {
  mkdir -p "$copy/$(dirname "$1")"
  { printf '#!/bin/bash\n' && cat; } >"$copy/$1"
  chmod +x "$copy/$1"
}

# expect STATUS TEXT: run.sh ends with STATUS and prints TEXT and nothing else, "" for nothing at
# all.
expect() {
  local status=0 said
  said=$(PATH=$copy/bin:$PATH "$copy/run.sh" plan a.json 2>&1) || status=$?
  # shellcheck disable=SC2053  # the text is a pattern
  # shellcheck disable=SC2053  # the text is a pattern
  [[ $status == "$1" && $said == $2 ]] ||
    { printf 'run.sh ended with %s, not %s, and said: %s\n' "$status" "$1" "$said" && exit 1; }
}

cp "$root/run.sh" "$copy"
stand_in setup.sh <<<'true'
stand_in bin/cmake <<EOF
[[ "\$*" != *' -n' ]] || { cat '$copy/to_do'; exit; }
echo "a line of the build"
[[ ! -e '$copy/broken' ]] || exit 1
mkdir -p '$copy/build/release/runner'
printf '#!/bin/bash\necho "ran \$*"\n' >'$copy/build/release/runner/grainsweep'
chmod +x '$copy/build/release/runner/grainsweep'
EOF

expect 0 'run.sh: building grainsweep in */build/release, once, a minute or two
ran plan a.json'
echo 'ninja: no work to do.' >"$copy/to_do"
expect 0 'ran plan a.json'
echo '[1/2] Building CXX object main.cpp.o' >"$copy/to_do"
expect 0 'run.sh: sources have changed, building what depends on them
ran plan a.json'
touch "$copy/broken"
expect 1 'run.sh: sources have changed, building what depends on them
*a line of the build
run.sh: the build failed; its last lines are above, all of them in */build/release/build.log
run.sh: if it worked before, try again without the folder */build/release'
echo "run.sh: says when it builds and why it does not run"
