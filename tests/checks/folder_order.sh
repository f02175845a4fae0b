#!/usr/bin/env bash
# The project keeps its order: kernels <- engine <- runner <- tests <- bench.
# usage: folder_order.sh [ROOT]
#
# - a file includes its own top folder and those below it, never above, named from the root;
# - of the files directly in a folder, the folders inside it include the ground floor only: the
#   headers named below;
# - what lies beside each other at any depth, folders and files, includes each other in one direction
#   only, without a cycle;
# - each layer does without what is not its business (JSON in the engine, Eigen in a kernel, ...);
# - an instruction set is asked for by `#if` only in kernels/.
set -euo pipefail
cd "${1:-$(dirname "$0")/../..}"

findings=0
report() {
  findings=$((findings + 1))
  printf 'folder order: %s\n' "$@" >&2
}

readonly ground_floor=(
  kernels/kernels.hpp
  engine/clusters.hpp engine/context.hpp engine/interval.hpp engine/portable.hpp engine/results.hpp
  engine/saved_state.hpp engine/text.hpp engine/units.hpp
  runner/exit_codes.hpp runner/hash.hpp runner/instruction_set.hpp runner/machine.hpp runner/text.hpp
  runner/versions.hpp
  tests/runner/sample_rows.hpp tests/runner/stored.hpp tests/runner/temporary_folder.hpp
)

mapfile -t sources < <(find kernels engine runner tests bench -name '*.[ch]pp' 2>/dev/null | sort)
((${#sources[@]})) || { report 'no sources found under kernels, engine, runner' && exit 1; }

# Lines "FILE INCLUDED" for every include in quotes.
quoted_includes() {
  grep -HE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' "${sources[@]}" |
    sed -E 's/^([^:]*):[^"]*"([^"]*)".*/\1 \2/'
}
edges=$(quoted_includes || true)

# A top folder may include these.
declare -rA may_include=(
  [kernels]='kernels' [engine]='kernels engine' [runner]='kernels engine runner'
  [tests]='kernels engine runner tests' [bench]='kernels engine runner tests bench'
)
while read -r file included; do
  [[ -n $file ]] || continue
  if [[ ! -f $included ]]; then
    report "$file includes \"$included\": name it from the root of the project"
  elif [[ " ${may_include[${file%%/*}]} " != *" ${included%%/*} "* ]]; then
    report "$file includes \"$included\": ${file%%/*} may include only ${may_include[${file%%/*}]}"
  elif [[ ${file%/*} == "${included%/*}"/* && " ${ground_floor[*]} " != *" $included "* ]]; then
    report "$file includes \"$included\": it lies above, and is not of the ground floor"
  fi
done <<<"$edges"

# Lines "A B" where A, B are folders or files beside each other, and A or a file in it includes B or
# a file in it.
sibling_edges() {
  awk 'NF == 2 {
    n = split($1, from, "/"); m = split($2, to, "/"); parent = ""
    for (i = 1; i <= n && i <= m; i++) {
      if (from[i] != to[i]) { print parent from[i], parent to[i]; break }
      parent = parent from[i] "/"
    }
  }' <<<"$edges" | sort -u
}

loop=$(sibling_edges | tsort 2>&1 >/dev/null | sed -n 's/^tsort: //p' | grep -v 'contains a loop' |
  paste -sd ' ' || true)
[[ -z $loop ]] || report "these include each other: $loop"

# forbid FOLDER REGEX WHY: no line of a source under FOLDER matches.
forbid() {
  local line
  while IFS= read -r line; do
    report "$line: $3"
  done < <(grep -rnE --include='*.[ch]pp' "$2" "$1" || true)
}
include='^[[:space:]]*#[[:space:]]*include[[:space:]]*'
forbid kernels "$include<(Eigen/|tbb/|oneapi/|nlohmann/)" 'a kernel knows numbers only'
forbid engine "$include<(tbb/|oneapi/|thread|mutex|atomic|future)" 'the engine starts no thread'
forbid engine "$include<(nlohmann/|fstream|filesystem|iostream|cstdio)" 'the engine reads and prints nothing'
forbid engine "$include<(chrono|ctime)>" 'the engine knows no clock'
for folder in engine runner; do
  forbid $folder "$include<(xsimd/(xsimd|types|arch|memory|math)|[a-z0-9]*mmintrin)" 'SIMD belongs in kernels/'
  forbid $folder '^[[:space:]]*#[[:space:]]*(el)?if.*(__AVX|__SSE|__FMA|__x86_64|XSIMD_)' \
    'no #if on an instruction set outside kernels/'
done

((findings == 0)) || exit 1
printf 'folder order: %d files, %d includes, all downward\n' "${#sources[@]}" "$(grep -c . <<<"$edges")"
