# The script that `completion bash` prints completes in a real bash.
source "$(dirname "$0")/common.sh" "$1"
"$program" completion bash >script.bash
source ./script.bash

# completes WORD... EXPECTED: with the cursor at the end of the last WORD.
completes() {
  local expected=${*: -1}
  COMP_WORDS=(grainsweep "${@:1:$#-1}")
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  _grainsweep
  [ "${COMPREPLY[*]}" = "$expected" ] ||
    fail "${COMP_WORDS[*]} completes to \"${COMPREPLY[*]}\" instead of \"$expected\""
}

completes st status
completes re report
completes run --fr --fresh
completes run --out x --f "--fresh --fail-fast"
completes run a.json --isa av "avx2 avx512"
completes export out --format "" "csv xyz vtp"
completes completion "" bash
completes run a ""
complete -p grainsweep | grep -q -- "-o default" || fail "files are not completed"

# Every option of every command, as its help has it.
commands=$("$program" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]\+\) .*/\1/p')
[ "$(wc -w <<<"$commands")" -ge 10 ] || fail "no commands in --help"
for command in $commands; do
  options=$("$program" "$command" --help | sed -nE 's/^  (-[a-z],)?(--[a-z-]+) .*/\2/p')
  completes "$command" -- "$(echo $options)"
done
expect_code 2 "$program" completion fish
echo "bash completes"
