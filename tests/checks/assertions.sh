#!/usr/bin/env bash
# No line of a shell test is an assertion that cannot fail: under `set -e` neither a command behind `!`
# nor any but the last of some joined by `&&` ends a script. usage: assertions.sh [ROOT]
set -euo pipefail
cd "${1:-$(dirname "$0")/../..}"

mapfile -t scripts < <(find tests bench -name '*.sh' | sort)
# Continued lines are one; what comes after `||`, `if` or `while` is no such line.
found=$(
  for script in "${scripts[@]}"; do
    sed -E ':more; /\\$/ { N; s/\\\n *//; b more }' "$script" |
      grep -nE '^ *(! |(\[ .*\]|\[\[ .*\]\]|(grep|cmp|test) .*) && (\[|grep|cmp|test|! ))' | grep -vE '\|\||; do$|; then$' |
      sed "s|^|$script: cannot fail, about line |" || true
  done
)
[[ -z $found ]] || { printf '%s\n' "$found" >&2 && exit 1; }
printf 'assertions: %d scripts\n' "${#scripts[@]}"
