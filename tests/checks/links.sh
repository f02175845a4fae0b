#!/usr/bin/env bash
# Nothing the manual refers to is missing. usage: links.sh [ROOT]
#
# - every link of a Markdown file leads to a file or folder that exists, and to a heading in it;
# - every script and every file of the project that is quoted exists;
# - README.md has 200 lines at most.
# shellcheck disable=SC2016  # backquotes here are those of the pages
set -euo pipefail
cd "${1:-$(dirname "$0")/../..}"

findings=0
report() {
  findings=$((findings + 1))
  printf 'links: %s\n' "$@" >&2
}

# The headings of a page as links name them.
headings_of() {
  sed -nE 's/^#+ (.*)$/\1/p' "$1" | tr '[:upper:]' '[:lower:]' | sed -E 's/[^a-z0-9 _-]//g; s/ /-/g'
}

mapfile -t pages < <(find . -name '*.md' -not -path './build*' -not -path './out/*' | sed 's|^\./||' | sort)
links=0
for page in "${pages[@]}"; do
  while read -r link; do
    [[ -n $link && $link != http*://* ]] || continue
    links=$((links + 1))
    target=${link%%#*} heading=''
    [[ $link != *'#'* ]] || heading=${link#*#}
    file=$page
    [[ -z $target ]] || file=$(dirname "$page")/$target
    if [[ ! -e $file ]]; then
      report "$page: leads to $target, which does not exist"
    elif [[ -n $heading ]] && ! headings_of "$file" | grep -xF -- "$heading" >/dev/null; then
      report "$page: leads to the heading #$heading, which $file does not have"
    fi
  done < <(grep -oE '\]\([^) ]+\)' "$page" | sed -E 's/^\]\((.*)\)$/\1/' || true)
  while read -r quoted; do
    [[ -z $quoted || -e $quoted || -e $(dirname "$page")/$quoted ]] ||
      report "$page: quotes $quoted, which does not exist"
  done < <(grep -oE '(^|[` ])(\./|\.ci/|bench/|configs/|tests/)[A-Za-z0-9_./-]*[A-Za-z0-9_]' "$page" |
    sed -E 's/^[` ]//' | sort -u || true)
done

lines=$(wc -l <README.md)
((lines <= 200)) || report "README.md has $lines lines; 200 are enough, the rest belongs into a page of its room"
((findings == 0)) || exit 1
printf 'links: %d in %d pages, none dangles\n' "$links" "${#pages[@]}"
