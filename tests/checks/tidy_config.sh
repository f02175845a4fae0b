#!/usr/bin/env bash
# .clang-tidy says what it means: every check it names exists, every check it disables has its
# reason in a comment line "#   NAME: REASON". usage: tidy_config.sh [ROOT]
set -euo pipefail
cd "${1:-$(dirname "$0")/../..}"

known=$(clang-tidy --list-checks --checks='*' | sed 's/^ *//')
findings=0
report() {
  findings=$((findings + 1))
  printf '.clang-tidy: %s\n' "$1" >&2
}

mapfile -t named < <(sed -n '/^Checks:/,/^[A-Z].*:/s/^  \([^,]*\),\{0,1\}$/\1/p' .clang-tidy)
((${#named[@]} > 1)) || report 'no checks found'
for name in "${named[@]}"; do
  glob=${name#-}
  [[ $name != -[!*]* ]] || grep -qE "^#   $glob: .{10,}" .clang-tidy ||
    report "$glob is disabled without a reason"
  [[ $glob == clang-diagnostic-* ]] || compgen -W "$known" -X "!$glob" >/dev/null ||
    report "clang-tidy knows no check $glob"
done
while read -r option; do
  grep -qxF "${option%.*}" <<<"$known" || report "an option names the unknown check ${option%.*}"
done < <(sed -nE 's/^.*\{ *key: *([a-z.A-Z-]+).*/\1/p' .clang-tidy)

((findings == 0)) || exit 1
printf '.clang-tidy: %d entries\n' "${#named[@]}"
