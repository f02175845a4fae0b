# Odd surroundings: a clear refusal, or the same bytes as in ordinary ones.
source "$(dirname "$0")/common.sh" "$1"
write_small_sweep sweep.json
make_reference sweep.json

# ends_with CODES WHAT COMMAND...: exits with one of CODES.
ends_with() {
  local codes=$1 what=$2 code=0
  shift 2
  "$@" >said.txt 2>&1 || code=$?
  [[ " $codes " == *" $code "* ]] || fail "$what: ended with $code: $(cat said.txt)"
}
run=("$program" run sweep.json --threads 2 --out)

# Folders that cannot be written, for root too.
mkdir kept
if [ "$(id -u)" -eq 0 ] && mount -t tmpfs -o ro tmpfs kept 2>/dev/null; then
  trap 'umount "$here/kept"; rm -rf "$here"' EXIT
else
  chmod 555 kept
fi
if ! touch kept/file 2>/dev/null; then
  ends_with 4 "read-only folder" "${run[@]}" kept
  expect_text said.txt "kept/shards: cannot make the folder: "
  ends_with 4 "folder in a read-only folder" "${run[@]}" kept/out
  expect_text said.txt "kept/out: cannot make the folder: "
else
  echo "left out: no read-only folder can be made here"
fi

# Results stay readable where they cannot be written.
if [ "$(id -u)" -eq 0 ] && mount --bind reference kept 2>/dev/null; then
  mount -o remount,bind,ro kept
  ends_with 0 "status of a read-only folder" "$program" status kept
  ends_with 4 "report of a read-only folder" "$program" report kept
  ends_with 4 "run in a read-only folder of results" "${run[@]}" kept
  umount kept
fi

# Output that goes nowhere: the work is done all the same, and nothing printed gets into a file.
code=0; "${run[@]}" closed >&- 2>said.txt || code=$?
[ "$code" -eq 4 ] || fail "closed standard output: ended with $code"
expect_text said.txt "standard output: not everything could be written"
same_as_reference closed "closed standard output"
for said in --help "run --help" help --version; do
  code=0; "$program" $said >/dev/full 2>said.txt || code=$?
  [ $code -eq 4 ] || fail "$said on a full disk ended with $code"
done
code=0; "${run[@]}" full >/dev/full 2>said.txt || code=$?
[ "$code" -eq 4 ] || fail "full standard output: ended with $code"
same_as_reference full "full standard output"
code=0; "${run[@]}" errors >/dev/null 2>&- || code=$?
[ "$code" -le 1 ] || fail "closed standard error: ended with $code"
same_as_reference errors "closed standard error"
code=0; "${run[@]}" none <&- >&- 2>&- || code=$?
[ "$code" -eq 4 ] || fail "everything closed: ended with $code"
same_as_reference none "everything closed"
("${run[@]}" pipe 2>&1 || true) | head -n 1 >/dev/null
same_as_reference pipe "a pipe that closes after a line"
for folder in closed full errors none pipe; do
  ! grep -qv '^{"length":[0-9]*,"crc32":"[0-9a-f]*","\(run\|outcome\)":{.*}}$' $folder/shards/1-of-1.jsonl ||
    fail "$folder: the journal holds other text"
done

# No terminal, no environment, an odd locale, an unknown terminal.
ends_with "0 1" "no terminal" setsid "${run[@]}" session </dev/null
same_as_reference session "no terminal"
ends_with "0 1" "no environment" env -i "${run[@]}" bare
same_as_reference bare "no environment"
# For a locale that a machine does not have, a program gets C: so these locales are made here.
command -v localedef >/dev/null && [ -d /usr/share/i18n/locales ] || skip "there are no sources of locales (setup.sh --checks)"
mkdir locales
for locale in de_DE tr_TR; do localedef -i $locale -f UTF-8 "$PWD/locales/$locale.UTF-8" 2>/dev/null || true; done
export LOCPATH=$PWD/locales
[ "$(LC_ALL=de_DE.UTF-8 /usr/bin/printf %.1f 1,5)" = 1,5 ] || fail "the German locale is not there"
for locale in C de_DE.UTF-8 tr_TR.UTF-8 xx_YY.none; do
  ends_with "0 1" "locale $locale" env LC_ALL=$locale LANG=$locale TERM=dumb "${run[@]}" "locale-$locale"
  same_as_reference "locale-$locale" "locale $locale"
done

# Names with spaces, quotes and UTF-8, also of the sweep file; the command to go on can be pasted.
odd="ein \"Ordner\" für d'Körner φ"
mkdir "$odd"
cp sweep.json "$odd/größe 1.json"
ends_with "0 1" "an odd path" "$program" run "$odd/größe 1.json" --threads 2 --out "$odd/out 1"
same_as_reference "$odd/out 1" "an odd path"
ends_with 0 "report of an odd path" "$program" report "$odd/out 1"
ends_with 0 "export of an odd path" "$program" export "$odd/out 1" --format vtp
journal="$odd/out 1/shards/1-of-1.jsonl"
head -n 3 "$journal" >two && mv two "$journal"
ends_with 0 "status of an odd path" "$program" status "$odd/out 1"
command=$(sed -n 's/^Go on with: //p' said.txt)
[ -n "$command" ] || fail "no command to go on: $(cat said.txt)"
ends_with "0 1" "the command to go on" bash -c "$command --threads 2"
same_as_reference "$odd/out 1" "gone on with the command that status prints"

# Limits of the shell: of the size of a file, and of memory.
(ulimit -f 8 && ends_with 4 "a limit of file sizes" "${run[@]}" limited)
(ulimit -f 8 && "${run[@]}" limited >said.txt 2>&1 || true)
expect_text said.txt "grainsweep: limited/" "File too large"
ends_with "0 1" "no limit of file sizes" "${run[@]}" limited
same_as_reference limited "after a limit of file sizes"
(ulimit -v 20000 && ends_with 5 "too little memory" "${run[@]}" starved)

# A bed for which there is no memory breaks off, the others are made: it is still to be made.
cat >large.json <<'JSON'
{ "name": "large", "replicates": 1, "base": { "accuracy": "fast" },
  "sweep": [ { "label": "large", "set": { "box": { "length": 100, "width": 100 }, "fill.grains": 1000000 } },
             { "label": "small", "set": { "box": { "length": 5, "width": 5 }, "fill.grains": 250 } } ] }
JSON
limit=40000 # kB, of which a small bed takes more or less from system to system
while code=0 && { (ulimit -v $limit && "$program" run large.json --threads 1 --out short >said.txt 2>&1) || code=$?; }; do
  ! grep -q "1 packing broke off" said.txt || break
  limit=$((limit + 10000))
  [ $limit -lt 400000 ] || fail "no limit lets a small bed pass and a large one not: $(cat said.txt)"
done
[ $code = 5 ] || fail "a bed without memory ends with $code: $(cat said.txt)"
expect_text said.txt "1 packing broke off, mostly for lack of memory"
"$program" status short >said.txt
expect_text said.txt "1 of 2 packings done: 1 settled" "; 1 broke off" "Left: about "

# Many beds of one thread, so that there is time while it runs.
cat >many.json <<'JSON'
{ "name": "many", "replicates": 40, "base": { "box": { "length": 5, "width": 5 },
  "fill": { "solid_height": 7 }, "accuracy": "fast" } }
JSON

# Its folder removed or renamed while it runs: reported, and not made anew without its lock.
for away in "rm -r gone" "mv gone elsewhere"; do
  start "$program" run many.json --threads 1 --out gone
  wait_until has_packings gone 2 || fail "nothing was stored"
  $away
  wait "$runner" && code=0 || code=$?
  [ "$code" -eq 4 ] || fail "$away: ended with $code"
  [ ! -e gone ] || fail "$away: the folder was made anew"
done
echo "odd surroundings: refused clearly, or the same bytes"
