#!/usr/bin/env bash
# The Debian package: lintian finds no error in it, and its program runs configs/quick.json in a
# root of its own, in which there is nothing but the package, those that it depends on, as they are
# installed here, and /proc. That is not an installation of Debian: there is no dpkg in it and
# nothing is configured.
# usage: package.sh BUILD_FOLDER
build=$(realpath "$1")
source "$(dirname "$0")/../runner/program/common.sh" "$build/runner/grainsweep"
for tool in cpack dpkg-deb dpkg-shlibdeps unshare chroot; do
  command -v $tool >/dev/null || skip "$tool is not installed"
done
unshare -rm true 2>said.txt || skip "no name spaces can be made here: $(cat said.txt)"

cpack -G DEB --config "$build/CPackConfig.cmake" -B "$here/packed" >said.txt 2>&1 || fail "$(cat said.txt)"
deb=$(echo packed/*.deb)
version=$("$program" --version | cut -d' ' -f2)
[ "$(dpkg-deb -f "$deb" Version)" = "$version-1" ] || fail "the package has another version than $version"

mkdir root && (cd root && mkdir -p usr/bin usr/sbin usr/lib usr/lib64 tmp proc && ln -s usr/{bin,sbin,lib,lib64} .)
dpkg-deb -x "$deb" root
(cd / && PYTHONPATH=$here/root/usr/lib/python3/dist-packages PYTHONDONTWRITEBYTECODE=1 \
  /usr/bin/python3 -c "import grainsweep; assert grainsweep.__file__.startswith('$here')") || fail "no Python reader"
grep -q "^version: $version\$" root/usr/share/doc/grainsweep/CITATION.cff || fail "CITATION.cff is of another version"
zcat root/usr/share/doc/grainsweep/changelog.gz | grep "^## $version " >/dev/null || fail "CHANGELOG.md lacks $version"
for command in run collect report; do
  zcat "root/usr/share/man/man1/grainsweep-$command.1.gz" >page.1
  "$program" $command --help | grep -oE -- '--[a-z][a-z-]+' | sort -u >options
  while read -r option; do
    grep -qF -- "${option//-/\\-}" page.1 || fail "the manual page of $command lacks $option"
  done <options
done
source root/usr/share/bash-completion/completions/grainsweep
COMP_WORDS=(grainsweep run --thr) COMP_CWORD=2
_grainsweep
[ "${COMPREPLY[*]}" = --threads ] || fail "bash completes --thr to ${COMPREPLY[*]}"
zsh_words=root/usr/share/zsh/vendor-completions/_grainsweep
grep -qF ']:NAME:(csv xyz ' $zsh_words || fail "zsh does not complete formats"
! grep -E ':[^:]* in \[|\{[a-z]+,' $zsh_words || fail "zsh would run what an option's value may be"
! command -v zsh >/dev/null || zsh -n $zsh_words
! command -v fish >/dev/null || fish -n root/usr/share/fish/vendor_completions.d/grainsweep.fish

# All that the package depends on, directly or not.
needed=() left=("$(dpkg-deb -f "$deb" Depends)")
while ((${#left[@]})); do
  mapfile -t found < <(tr ',' '\n' <<<"${left[*]}" | sed -E 's/\|.*//; s/\(.*//; s/:any//; s/ //g' | grep . | sort -u)
  left=()
  for package in "${found[@]}"; do
    [[ " ${needed[*]} " == *" $package "* ]] && continue
    needed+=("$package")
    depends=$(dpkg-query -W -f '${Pre-Depends},${Depends},' "$package") || fail "$package is not installed"
    left+=("$depends")
  done
done
for package in "${needed[@]}"; do
  dpkg -L "$package" | while read -r file; do [[ -d $file ]] || echo "$file"; done
done | tar -c -T - 2>/dev/null | tar -x -C root --keep-directory-symlink
# packaged WORD...: the program in that root.
packaged() {
  unshare -rm bash -c 'mount --rbind /proc root/proc && exec chroot root /usr/bin/grainsweep "$@"' - "$@"
}
packaged --version >said.txt 2>&1 || fail "does not start with ${needed[*]}: $(cat said.txt)"
packaged run /usr/share/grainsweep/configs/quick.json --out /tmp/quick \
  >said.txt 2>&1 || fail "quick.json: $(tail -n 5 said.txt)"
for sweep in root/usr/share/grainsweep/configs/*.json; do
  case $sweep in *.reference.json | *.schema.json) continue ;; esac
  packaged validate "${sweep#root}" >said.txt 2>&1 || fail "$(cat said.txt)"
done
"$program" run root/usr/share/grainsweep/configs/quick.json --out here >/dev/null 2>&1
for table in groups fits fit_points profiles decays distributions sizes columns; do
  cmp "here/$table.csv" "root/tmp/quick/$table.csv" || fail "other $table.csv than outside"
done
[ -s root/tmp/quick/report.html ] || fail "no page"

command -v lintian >/dev/null || skip "lintian is not installed (setup.sh --checks installs it); all else is right"
lintian --fail-on error "$deb" >said.txt 2>&1 || fail "lintian: $(cat said.txt)"
echo "$(basename "$deb") with ${#needed[@]} packages below it; lintian: $(grep -c '^W' said.txt || true) warnings"
