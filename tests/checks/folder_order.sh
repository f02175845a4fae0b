#!/usr/bin/env bash
# The house keeps its order: kernels <- engine <- runner. usage: folder_order.sh [ROOT]
#
# - a file includes its own top folder and those below it, never above, named from the root;
# - the folders beside each other at any depth include each other in one direction only, without a
#   cycle, and so do the files (headers included by headers);
# - each layer does without what is not its business (JSON in the engine, Eigen in a kernel, ...);
# - an instruction set is asked for by `#if` in kernels/ alone.
set -euo pipefail
cd "${1:-$(dirname "$0")/../..}"

findings=0
report() {
  findings=$((findings + 1))
  printf 'folder order: %s\n' "$@" >&2
}

mapfile -t sources < <(find kernels engine runner -name '*.[ch]pp' | sort)
((${#sources[@]})) || { report 'no sources found under kernels, engine, runner' && exit 1; }

# Lines "FILE INCLUDED" for every include in quotes.
quoted_includes() {
  grep -HE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' "${sources[@]}" |
    sed -E 's/^([^:]*):[^"]*"([^"]*)".*/\1 \2/'
}
edges=$(quoted_includes || true)

# A top folder may include these.
declare -rA may_include=([kernels]='kernels' [engine]='kernels engine' [runner]='kernels engine runner')
while read -r file included; do
  [[ -n $file ]] || continue
  if [[ ! -f $included ]]; then
    report "$file includes \"$included\": name it from the root of the project"
  elif [[ " ${may_include[${file%%/*}]} " != *" ${included%%/*} "* ]]; then
    report "$file includes \"$included\": ${file%%/*} may include only ${may_include[${file%%/*}]}"
  fi
done <<<"$edges"

# Lines "A B" for folders A, B beside each other where a file under A includes one under B.
sibling_edges() {
  awk 'NF == 2 {
    n = split($1, from, "/"); m = split($2, to, "/"); parent = ""
    for (i = 1; i < n && i < m; i++) {
      if (from[i] != to[i]) { print parent from[i], parent to[i]; break }
      parent = parent from[i] "/"
    }
  }' <<<"$edges" | sort -u
}

# Reads edges "A B"; reports a cycle among them as one of `what`.
expect_no_cycle() {
  local what=$1 loop
  loop=$(tsort 2>&1 >/dev/null | sed -n 's/^tsort: //p' | grep -v 'contains a loop' | paste -sd ' ' || true)
  [[ -z $loop ]] || report "$what include each other: $loop"
}
expect_no_cycle folders < <(sibling_edges)
expect_no_cycle files < <(awk 'NF == 2' <<<"$edges")

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
