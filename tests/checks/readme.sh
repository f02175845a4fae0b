#!/usr/bin/env bash
# What the manual tells people to write and type is understood, and the output that it shows is what
# the program prints. usage: readme.sh GRAINSWEEP [--mend]
#
# In every README.md: sweeps are valid; commands and options in tables, and commands quoted, are
# known; the values of the presets and the formats of beds are right; the text between lines
#   <!-- begin: grainsweep WORDS --> and <!-- end -->
# is what that command prints. --mend writes it there.
# shellcheck disable=SC2016  # backquotes here are those of the pages
set -euo pipefail
grainsweep=$(realpath "${1:?usage: readme.sh GRAINSWEEP [--mend]}")
mend=${2:-}
readonly grainsweep mend
cd "$(dirname "$0")/../.."
work=$(mktemp -d "${TMPDIR:-/tmp}/grainsweep-readme.XXXXXX")
readonly work
trap 'rm -rf "$work"' EXIT

findings=0
report() {
  findings=$((findings + 1))
  printf '%s\n' "$@" >&2
}

# Sweeps: every block of JSON.
check_sweeps() {
  local page=$1 sweep
  awk -v stem="$work/sweep" '
    /^```json$/ { inside = 1; name = stem "-" ++number ".json"; next }
    /^```$/ { inside = 0 }
    inside { print > name }' "$page"
  for sweep in "$work"/sweep-*.json; do
    [[ -e $sweep ]] || continue
    sweeps=$((sweeps + 1))
    "$grainsweep" validate "$sweep" >"$work/said" 2>&1 ||
      report "$page: a sweep is wrong: $(cat "$work/said")"
    rm "$sweep"
  done
}

# Commands: those in tables, and those that lines of code call.
check_commands() {
  local page=$1 command
  while read -r command; do
    [[ -n $command ]] || continue
    commands=$((commands + 1))
    [[ $("$grainsweep" "$command" --help 2>&1 || true) == *"Usage: grainsweep $command"* ]] ||
      report "$page: the program does not know the command $command"
  done < <({
    sed -nE '/^\| command/,/^$/s/^\| `([a-z]+)[ `].*/\1/p' "$page"
    grep -oE '(run\.sh|grainsweep) [a-z]+ ' <(grep -E '^    |`(\./run\.sh|grainsweep) ' "$page") |
      awk '{ print $2 }'
  } | sort -u)
}

# Options: the table headed "option of `COMMAND`".
check_options() {
  local page=$1 command option
  command=$(sed -nE 's/^\| option of `([a-z]+)`.*/\1/p' "$page")
  [[ -n $command ]] || return 0
  "$grainsweep" "$command" --help >"$work/help"
  while read -r option; do
    grep -qF -- "$option" "$work/help" || report "$page: $command has no option $option"
  done < <(sed -nE '/^\| option of/,/^$/p' "$page" | grep -oE -- '--[a-z][a-z-]+' | sort -u)
}

# Presets: a row of the table headed "part" has the values of the presets in its head.
check_presets() {
  local page=$1 preset column part value
  grep -q '^| part ' "$page" || return 0
  column=2
  for preset in $(sed -nE '/^\| part /s/`//gp' "$page" | cut -d'|' -f3-6 | tr -d '|'); do
    column=$((column + 1))
    printf '{"name": "p", "base": {"accuracy": "%s"}, "sweep": [{}]}' "$preset" >"$work/preset.json"
    "$grainsweep" plan "$work/preset.json" --json >"$work/plan"
    while IFS='|' read -r part value; do
      parts=$((parts + 1))
      awk -v want="$value" -v have="$(grep -oE "\"$part\":[^,}]*" "$work/plan" | head -n 1 |
        cut -d: -f2)" 'BEGIN { exit !(have != "" && want + 0 == have + 0) }' ||
        report "$page: $part of $preset is not $value"
    done < <(sed -nE '/^\| part /,/^$/p' "$page" | tail -n +3 | tr -d '` ' | sed '/^$/d' |
      cut -d'|' -f2,$column)
  done
}

# Formats: the table headed `--format` has those that can be exported, and no other.
check_formats() {
  local page=$1
  grep -q '^| `--format` ' "$page" || return 0
  formats=$((formats + 1))
  "$grainsweep" export --help | sed -nE 's/.*--format NAME:\{([^}]*)\}.*/\1/p' | tr ',' '\n' |
    sort >"$work/known"
  sed -nE '/^\| `--format`/,/^$/p' "$page" | tail -n +3 | cut -d'|' -f2 | grep -oE '[a-z-]+' |
    sort >"$work/told"
  cmp -s "$work/known" "$work/told" ||
    report "$page: the formats are $(tr '\n' ' ' <"$work/known")"
}

# Text that a command prints: between the lines that name it.
check_generated() {
  local page=$1 words
  while read -r words; do
    [[ -n $words ]] || continue
    generated=$((generated + 1))
    # shellcheck disable=SC2086  # a command and its options
    "$grainsweep" $words >"$work/printed" 2>&1 || report "$page: grainsweep $words fails"
    awk -v begin="<!-- begin: grainsweep $words -->" -v printed="$work/printed" '
      $0 == "<!-- end -->" { inside = 0 }
      !inside { print }
      $0 == begin { inside = 1; while ((getline line <printed) > 0) print line }
    ' "$page" >"$work/page"
    [[ -z $mend ]] || cat "$work/page" >"$page"
    cmp -s "$work/page" "$page" ||
      report "$page: not what grainsweep $words prints; tests/checks/readme.sh GRAINSWEEP --mend writes it"
  done < <(sed -nE 's/^<!-- begin: grainsweep (.*) -->$/\1/p' "$page")
}

sweeps=0 commands=0 parts=0 formats=0 generated=0
mapfile -t pages < <(find . -name README.md -not -path './build*' | sed 's|^\./||' | sort)
for page in "${pages[@]}"; do
  check_sweeps "$page"
  check_commands "$page"
  check_options "$page"
  check_presets "$page"
  check_formats "$page"
  check_generated "$page"
done
((sweeps > 1 && commands > 9 && parts > 9 && formats > 0 && generated > 0)) ||
  report "the manual has only $sweeps sweeps, $commands commands, $parts parts of presets, $formats lists of formats and $generated tables"
((findings == 0)) || exit 1
printf 'manual: %d sweeps, %d commands, %d parts of presets and %d printed tables are right\n' \
  "$sweeps" "$commands" "$parts" "$generated"
