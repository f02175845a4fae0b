#!/usr/bin/env bash
# Every C++ file is as clang-format leaves it. usage: format.sh [ROOT]
# To mend: clang-format -i FILE
set -euo pipefail
cd "${1:-$(dirname "$0")/../..}"

mapfile -d '' -t sources < <(
  find kernels engine runner tests bench -name '*.[ch]pp' -print0 2>/dev/null | sort -z
)
((${#sources[@]})) || { printf 'format: no sources found\n' >&2 && exit 1; }
clang-format --dry-run -Werror "${sources[@]}"
printf 'format: %d files\n' "${#sources[@]}"
