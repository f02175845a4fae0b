#!/usr/bin/env bash
# What is compiled for a wide instruction set stays there. usage: kernel_objects.sh BUILD
#
# An inline function or template that the compiler did not inline is a weak symbol, and the linker
# keeps one copy of each name: perhaps the one with AVX instructions, for a processor without them.
# So the objects for avx2 and avx512 must define no weak, vague-linkage or unique symbol at all.
set -euo pipefail
cd "${1:?usage: kernel_objects.sh BUILD}/kernels"

findings=0
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
printf 'kernel objects: no shared symbols for avx2, avx512\n'
