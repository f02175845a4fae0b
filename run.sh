#!/usr/bin/env bash
# Sets up, builds grainsweep (Release, only what changed) and runs it: ./run.sh COMMAND OPTIONS...
# Works from any folder: paths in the options are relative to where it is called.
set -euo pipefail

root=$(dirname "$(readlink -f "$0")")
readonly root
readonly build=$root/build/release
readonly log=$build/build.log

build_grainsweep() {
  if [[ ! -x $build/runner/grainsweep ]]; then
    printf 'run.sh: building grainsweep in %s, once, a minute or two\n' "$build" >&2
  elif ! cmake --build "$build" --target grainsweep -- -n 2>/dev/null | grep 'no work to do' >/dev/null; then
    printf 'run.sh: sources have changed, building what depends on them\n' >&2
  fi
  (
    cd "$root" &&
      { [[ -f $build/build.ninja ]] || cmake --preset release; } &&
      cmake --build --preset release --target grainsweep
  ) >"$log" 2>&1
}

"$root/setup.sh"
mkdir -p "$build"
exec 9>"$build/.lock"
flock 9 # one build at a time, however many run.sh are started at once
if ! build_grainsweep; then
  tail -n 30 "$log" >&2
  printf 'run.sh: the build failed; its last lines are above, all of them in %s\n' "$log" >&2
  printf 'run.sh: if it worked before, try again without the folder %s\n' "$build" >&2
  exit 1
fi
exec 9>&-
printf -v GRAINSWEEP_COMMAND '%q' "$0" # what the commands that it prints begin with
[[ $0 == */* ]] || GRAINSWEEP_COMMAND="bash $GRAINSWEEP_COMMAND"
export GRAINSWEEP_COMMAND
exec "$build/runner/grainsweep" "$@"
