# Shared by the stories of this folder: each is called as `bash <story>.sh <program>`, works in a
# folder of its own and fails at the first thing that is not as it should be.
set -euo pipefail
program=$(realpath "$1")
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here"
unset GRAINSWEEP_ISA

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# expect_code CODE COMMAND...: runs it, output in out.txt and error.txt.
expect_code() {
  local expected=$1 code=0
  shift
  "$@" >out.txt 2>error.txt </dev/null || code=$?
  [ "$code" -eq "$expected" ] || {
    cat out.txt error.txt >&2
    fail "exit code $code instead of $expected: $*"
  }
}

# expect_text FILE TEXT...: every TEXT stands in FILE.
expect_text() {
  local file=$1
  shift
  local text
  for text in "$@"; do
    grep -qF -- "$text" "$file" || {
      cat "$file" >&2
      fail "no \"$text\" in $file"
    }
  done
}

# A sweep of small beds: `replicates` of them at each of four wall gaps and one periodic.
write_sweep() {
  local file=$1 replicates=$2 solid_height=${3:-4}
  cat >"$file" <<JSON
{ "name": "small", "seed": 3, "replicates": $replicates,
  "base": { "shape": "sphere",
            "box": { "length": 5, "width": 5, "x": "periodic", "y": "walls" },
            "fill": { "solid_height": $solid_height },
            "measure": { "exclude_floor": 1, "exclude_surface": 1 },
            "accuracy": "fast" },
  "sweep": [ { "label": "walls", "grid": { "box.width": [3, 4, 5, 6] } },
             { "label": "bulk", "set": { "box.width": 5, "box.y": "periodic" } } ] }
JSON
}

# packings.csv without the column cpu_seconds (the 22nd; no cell before it holds a comma).
values_of() {
  cut -d, -f1-21,23- "$1/packings.csv"
}
