#!/usr/bin/env bash
# What is compiled for a wide instruction set stays there, and runs only where the processor has all
# that it was compiled for. usage: kernel_objects.sh BUILD [SOURCES]
#
# An inline function or template that the compiler did not inline is a weak symbol, and the linker
# keeps one copy of each name: perhaps the one with AVX instructions, for a processor without them.
# So the objects for avx2 and avx512 must define no weak, vague-linkage or unique symbol at all.
#
# And is_supported has to ask the processor for every feature that the compiler may use: one that is
# forgotten is an illegal instruction on a machine that lacks it.
set -euo pipefail
build=${1:?usage: kernel_objects.sh BUILD [SOURCES]}/kernels
sources=$(realpath "${2:-$(dirname "$0")/../..}")/kernels
readonly build sources

# compiled_for ISA, asked_for ISA: features, one a line, sorted.
compiled_for() {
  sed -n "s/^add_kernels($1 \(.*\))\$/\1/p" "$sources/CMakeLists.txt" | tr ' ' '\n' | sed 's/^-m//' | sort
}
asked_for() {
  sed -n "/^bool is_supported/,/^}/{/case Isa::$1:/,/;/p}" "$sources/kernels.cpp" |
    grep -o 'supports("[a-z0-9]*")' | cut -d'"' -f2 | sort
}

findings=0
for isa in sse2 avx2 avx512; do
  [[ -n $(compiled_for $isa) ]] ||
    { printf 'kernel objects: no features of %s in %s\n' "$isa" "$sources/CMakeLists.txt" >&2 && exit 1; }
  for feature in $(comm -23 <(compiled_for $isa) <(asked_for $isa)); do
    findings=$((findings + 1))
    printf 'kernel objects: %s is compiled with -m%s, is_supported does not ask for it\n' \
      "$isa" "$feature" >&2
  done
done
cd "$build"
for isa in avx2 avx512; do
  mapfile -t objects < <(find . -name '*.o' -path "*$isa*" | sort)
  ((${#objects[@]})) ||
    { printf 'kernel objects: none for %s in %s\n' "$isa" "$PWD" >&2 && exit 1; }
  for object in "${objects[@]}"; do
    shared=$(nm --defined-only --demangle "$object" | grep -E '^[0-9a-f]+ [WVu] ' || true)
    [[ -z $shared ]] || {
      findings=$((findings + 1))
      printf 'kernel objects: %s defines what other objects may be linked to:\n%s\n' \
        "$object" "$shared" >&2
    }
  done
done
((findings == 0)) || exit 1
printf 'kernel objects: no shared symbols for avx2, avx512; all their features are asked for\n'
