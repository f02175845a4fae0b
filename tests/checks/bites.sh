#!/usr/bin/env bash
# Each check finds what it is for: violations planted in a temporary copy, one at a time, and
# nothing in the copy without them. usage: bites.sh CHECK...
# CHECK: folder_order links assertions kernel_objects one_definition meshes format tidy tidy_config
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
copy=$(mktemp -d "${TMPDIR:-/tmp}/grainsweep-bites.XXXXXX")
readonly root copy
trap 'rm -rf "$copy"' EXIT

fail() {
  printf 'bites: %s\n' "$1" >&2
  cat "$copy/output" >&2
  exit 1
}

# passes COMMAND...: the check finds nothing.
passes() {
  "$@" >"$copy/output" 2>&1 || fail "${1##*/} complains about a clean tree"
}

# finds TEXT COMMAND...: the check fails and names what was planted.
finds() {
  local text=$1
  shift
  if "$@" >"$copy/output" 2>&1; then fail "${1##*/} missed: $text"; fi
  grep -qF -- "$text" "$copy/output" || fail "${1##*/} failed, but not for: $text"
}

# plant FILE: standard input becomes that file of the copy.
plant() {
  mkdir -p "$copy/$(dirname "$1")"
  cat >"$copy/$1"
}

# A small tree in order: an engine of two folders over one kernel.
plant_clean_tree() {
  cp "$root/.clang-format" "$root/.clang-tidy" "$copy"
  plant kernels/twice.hpp <<<$'#pragma once\nint twice(int value);'
  plant kernels/twice.cpp <<<$'#include "kernels/twice.hpp"\n\nint twice(int value) { return 2 * value; }'
  plant engine/scene/bed.hpp <<<$'#pragma once\nstruct Bed {\n  int grains = 0;\n};'
  plant engine/measure/size.cpp <<<$'#include "engine/scene/bed.hpp"\n#include "kernels/twice.hpp"\n\nint size(const Bed& bed) { return twice(bed.grains); }'
}

# finds_planted FILE LINE TEXT COMMAND...: FILE holding LINE is found as TEXT; takes it out again.
finds_planted() {
  local file=$1 line=$2
  plant "$file" <<<"$line"
  finds "${@:3}"
  rm "${copy:?}/$file"
}

bite_folder_order() {
  local check=("$root/tests/checks/folder_order.sh" "$copy")
  plant_clean_tree
  passes "${check[@]}"
  finds_planted kernels/up.cpp '#include "engine/scene/bed.hpp"' 'kernels may include only' "${check[@]}"
  finds_planted engine/here.cpp '#include "scene/bed.hpp"' 'from the root' "${check[@]}"
  finds_planted engine/scene/wide.cpp '#if defined(__AVX2__)' 'no #if on an instruction set' "${check[@]}"
  finds_planted engine/scene/json.cpp '#include <nlohmann/json.hpp>' 'reads and prints nothing' "${check[@]}"
  plant engine/measure/phi.hpp <<<''
  finds_planted engine/scene/back.cpp '#include "engine/measure/phi.hpp"' \
    'include each other: engine/' "${check[@]}"
  rm "$copy/engine/measure/phi.hpp"
  plant engine/packing.hpp <<<'#include "engine/scene/bed.hpp"'
  finds_planted engine/measure/up.cpp '#include "engine/packing.hpp"' 'not of the ground floor' "${check[@]}"
  rm "$copy/engine/packing.hpp"
  plant engine/units.hpp <<<'#include "engine/scene/bed.hpp"'
  finds_planted engine/scene/long.hpp '#include "engine/units.hpp"' \
    'include each other: engine/' "${check[@]}"
  rm "$copy/engine/units.hpp"
  plant bench/beds.hpp <<<''
  finds_planted tests/test_beds.cpp '#include "bench/beds.hpp"' 'tests may include only' "${check[@]}"
  plant engine/scene/one.hpp <<<'#include "engine/scene/two.hpp"'
  finds_planted engine/scene/two.hpp '#include "engine/scene/one.hpp"' \
    'include each other: engine/scene/' "${check[@]}"
}

bite_links() {
  local check=("$root/tests/checks/links.sh" "$copy")
  plant README.md <<<$'# Title\n\n## A part\n\n[here](#a-part), [there](runner/README.md#its-part)'
  plant runner/README.md <<<$'# Its part\n\n[back](../README.md)'
  passes "${check[@]}"
  finds_planted bench/README.md '[gone](gone.md)' 'leads to gone.md' "${check[@]}"
  finds_planted bench/README.md '[gone](../README.md#gone)' 'the heading #gone' "${check[@]}"
  # shellcheck disable=SC2016  # backquotes of a page
  finds_planted bench/README.md 'Run `bench/gone.sh`.' 'quotes bench/gone.sh' "${check[@]}"
  yes '' | head -n 200 >>"$copy/README.md" || true
  finds 'README.md has 205 lines' "${check[@]}"
}

bite_assertions() {
  local check=("$root/tests/checks/assertions.sh" "$copy")
  mkdir -p "$copy/bench"
  plant tests/good.sh <<<$'! grep x y || fail\nwhile\n  ! grep x y; do\n  true\ndone\n[[ ! -e x && ! -e y ]]\n[ -e x ] && continue'
  passes "${check[@]}"
  finds_planted tests/not.sh '! cmp a b' 'tests/not.sh: cannot fail, about line 1' "${check[@]}"
  finds_planted bench/both.sh '[ ! -e a ] && [ ! -e b ]' 'bench/both.sh: cannot fail' "${check[@]}"
  finds_planted tests/long.sh $'! python3 a \\\n  b' 'tests/long.sh: cannot fail' "${check[@]}"
}

bite_format() {
  local check=("$root/tests/checks/format.sh" "$copy")
  plant_clean_tree
  passes "${check[@]}"
  finds_planted runner/cramped.cpp 'int  f( ){return 1 ;}' 'runner/cramped.cpp:1' "${check[@]}"
}

# compile_object ISA SOURCE: what a kernel's object for ISA would be.
compile_object() {
  mkdir -p "$copy/kernels/$1"
  g++ -std=c++20 -O3 -x c++ -c - -o "$copy/kernels/$1/planted.o" <<<"$2"
}

bite_kernel_objects() {
  local check=("$root/tests/checks/kernel_objects.sh" "$copy") isa
  local clean='namespace { int once(int v) { return v; } } int kernel(int v) { return once(v); }'
  local shared='[[gnu::noinline]] inline int leaked(int v) { return v + 1; }
                int kernel(int v) { return leaked(v); }'
  mkdir "$copy/kernels"
  finds 'none for avx2' "${check[@]}"
  for isa in avx2 avx512; do compile_object $isa "$clean"; done
  passes "${check[@]}"
  for isa in avx2 avx512; do
    compile_object $isa "$shared"
    finds 'W leaked(int)' "${check[@]}"
    compile_object $isa "$clean"
  done
  mkdir -p "$copy/sources/kernels"
  cp "$root"/kernels/{CMakeLists.txt,kernels.cpp} "$copy/sources/kernels"
  passes "${check[@]}" "$copy/sources"
  sed -i 's/__builtin_cpu_supports("avx512vl") != 0/true/' "$copy/sources/kernels/kernels.cpp"
  finds 'avx512 is compiled with -mavx512vl' "${check[@]}" "$copy/sources"
}

# build_planted: a program of two sources as the preset `thread` builds the runner.
build_planted() {
  cmake -S "$copy/project" --preset thread --log-level=ERROR &&
    cmake --build "$copy/project/build/thread"
}

bite_one_definition() {
  plant project/CMakeLists.txt <<'EOF'
cmake_minimum_required(VERSION 3.25)
project(planted LANGUAGES CXX)
add_executable(planted one.cpp two.cpp)
EOF
  cp "$root/CMakePresets.json" "$copy/project"
  plant project/one.cpp <<<'namespace g { struct Fit { int rows; }; int rows_of(const Fit& fit) { return fit.rows; } }
int main() { return 0; }'
  plant project/two.cpp <<<'namespace g { struct Fit { double a, b; }; double b_of(const Fit& fit) { return fit.b; } }'
  finds 'violates the C++ One Definition Rule' build_planted
  sed -i 's/Fit/Line/g' "$copy/project/two.cpp"
  passes build_planted
}

# box NAME X Y Z SIDE: a cube as a solid of an STL file, its lowest corner at X Y Z.
box() {
  local name=$1 side=$5 corner triangle k
  local -a at=("$2" "$3" "$4")
  printf 'solid %s\n' "$name"
  for triangle in '0 3 1' '0 2 3' '4 5 7' '4 7 6' '0 1 5' '0 5 4' '2 7 3' '2 6 7' '0 6 2' '0 4 6' '1 3 7' '1 7 5'; do
    printf 'facet normal 0 0 0\nouter loop\n'
    for corner in $triangle; do
      printf 'vertex'
      for k in 0 1 2; do awk "BEGIN { printf \" %.9g\", ${at[k]} + $side * $(((corner >> k) & 1)) }"; done
      printf '\n'
    done
    printf 'endloop\nendfacet\n'
  done
  printf 'endsolid %s\n' "$name"
}

bite_meshes() {
  if ! command -v gmsh >/dev/null || ! /usr/bin/python3 -c 'import numpy' 2>/dev/null; then
    printf 'SKIPPED: gmsh or python3-numpy is not installed\n'
    exit 77
  fi
  cd "$copy"
  local check=(/usr/bin/python3 "$root/tests/checks/meshes.py" 9 bed.stl) container
  container=$(box container 0 0 0 4)
  plant bed.stl <<<"$(box grain_1 1 1 1 1)"$'\n'"$(box grain_2 2.1 1.2 1.3 1)"$'\n'"$container"
  passes "${check[@]}"
  plant bed.stl <<<"$(box grain_1 1 1 1 1)"$'\n'"$(box grain_2 1.9 1.2 1.3 1)"$'\n'"$container"
  finds 'bed.stl: gmsh ends with' "${check[@]}" # which cross
  plant bed.stl <<<"$(box grain_1 1 1 1 1)"$'\n'"$(box grain_2 3.5 1.2 1.3 1)"$'\n'"$container"
  finds 'bed.stl: gmsh ends with' "${check[@]}" # a grain through the wall
  plant bed.stl <<<"$(box grain_1 1 1 1 1 | sed '2,8d')"$'\n'"$container"
  finds 'bed.stl: surface 1 has a hole' "${check[@]}"
  plant bed.stl <<<"$(box grain_1 1 1 1 1)"$'\n'"$(sed '2,8d' <<<"$container")"
  finds 'bed.stl: surface 2 has a hole' "${check[@]}"
}

# Writes the compile commands of every source in the copy.
write_compile_commands() {
  local source separator='['
  for source in $(cd "$copy" && find . -name '*.cpp' -printf '%P\n'); do
    printf '%s{"directory": "%s", "file": "%s/%s", "command": "g++ -std=c++20 -I. -c %s"}\n' \
      "$separator" "$copy" "$copy" "$source" "$source"
    separator=','
  done >"$copy/compile_commands.json"
  printf ']\n' >>"$copy/compile_commands.json"
}

run_tidy() {
  write_compile_commands
  "$root/tests/checks/tidy.sh" "$copy" "$copy"
}

bite_tidy() {
  plant_clean_tree
  passes run_tidy
  local long
  long=$(printf 'int tall(int v) {\n'; yes '  v += 1;' | head -n 81; printf '  return v;\n}\n')
  finds_planted runner/tall.cpp "$long" readability-function-size run_tidy
  finds_planted runner/moved.cpp $'#include <string>\n#include <utility>\nvoid keep(std::string);
unsigned long f(std::string s) {\n  keep(std::move(s));\n  return s.size();\n}' \
    bugprone-use-after-move run_tidy
  finds_planted runner/copied.cpp $'#include <string>\nunsigned long f(std::string s) { return s.size(); }' \
    performance-unnecessary-value-param run_tidy
  finds_planted runner/named.cpp 'int CamelFunction() { return 0; }' \
    readability-identifier-naming run_tidy
  finds_planted runner/unset.cpp $'int f(bool b) {\n  int value;\n  if (b) value = 1;\n  return value;\n}' \
    cppcoreguidelines-init-variables run_tidy
  finds_planted runner/zero.cpp 'int* f() { return 0; }' modernize-use-nullptr run_tidy
}

bite_tidy_config() {
  local check=("$root/tests/checks/tidy_config.sh" "$copy")
  cp "$root/.clang-tidy" "$copy"
  passes "${check[@]}"
  sed -i 's/^  performance-\*/  performence-*/' "$copy/.clang-tidy"
  finds 'knows no check performence-*' "${check[@]}"
  sed 's/^  -\*,/&\n  -bugprone-use-after-move,/' "$root/.clang-tidy" >"$copy/.clang-tidy"
  finds 'bugprone-use-after-move is disabled without a reason' "${check[@]}"
}

(($#)) || { printf 'usage: bites.sh CHECK...\n' >&2 && exit 2; }
for check in "$@"; do
  rm -rf "${copy:?}"/*
  "bite_$check"
  printf 'bites: %s finds what is planted\n' "$check"
done
