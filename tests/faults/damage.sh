# Any file of an output folder damaged at random, the folder finished or half finished: the next run
# mends it or says what it cannot mend, and until then no command prints other results in silence.
source "$(dirname "$0")/common.sh" "$1"
write_small_sweep sweep.json
make_reference sweep.json

# A folder as a kill leaves it: some packings stored, one under way with both its checkpoints.
is_half() {
  local files=(half/checkpoints/*.1)
  has_packings half 1 && [ -e "${files[0]}" ]
}
for kill in $(seq 50); do
  rm -rf half
  start "$program" run sweep.json --no-report --threads 2 --out half --checkpoint-seconds 0
  wait_until is_half || true
  end_runner KILL
  ! is_half || break
done
is_half || fail "no kill in 50 left packings and checkpoints"

# look FOLDER NAME: what commands print about the folder, and what they warn about. Figures, which
# take ten times as long as all the rest, are left out.
look() {
  code=0
  {
    PATH=none "$program" report "$1" && "$program" status "$1" && "$program" status "$1" --check &&
      "$program" export "$1" --quiet --to "$here/grains"
  } >"$2" 2>warned.txt </dev/null || code=$?
  sed -i '/^note: report.html: no figures, for want of gnuplot/d' warned.txt
  sed -i 's/, silent for [^;]*;/;/' "$2" # that is the age of files
  cat grains/* >>"$2" 2>/dev/null || true
  rm -rf grains
}
for state in reference half; do
  rm -rf out && cp -r $state out
  look out $state.seen
  [ "$code" -eq 0 ] && [ ! -s warned.txt ] || fail "$state is not sound: $(cat warned.txt)"
done

# damage FILE: flips a bit, cuts, empties or removes it, adds to it, or puts another file in its
# place.
damage() {
  local size bit at place other others
  size=$(stat -c %s "$1")
  draw at 0 $((size > 0 ? size - 1 : 0))
  draw kind 0 7
  draw bit 0 7
  case $kind in
    0) truncate -s "$at" "$1" ;;
    1) rm "$1" ;;
    2) printf 'x' >>"$1" ;;
    3)
      others=("$(dirname "$1")"/*)
      draw place 0 $((${#others[@]} - 1))
      other=${others[place]}
      [ ! -f "$other" ] || [ "$other" = "$1" ] || cp "$other" "$1"
      ;;
    *) flip_bit "$1" "$at" "$bit" ;;
  esac
}

mended=0 told=0
tries=$(times 60 2000)
for number in $(seq "$tries"); do
  RANDOM=$number
  state=$([ $((number % 2)) -eq 0 ] && echo reference || echo half)
  rm -rf out && cp -r $state out
  mapfile -t files < <(cd out && find . -type f | sort)
  draw place 0 $((${#files[@]} - 1))
  file=${files[place]}
  damage "out/$file"
  what="try $number, $state/$file, damage $kind"

  look out seen.txt
  if [ "$code" -eq 0 ] && [ ! -s warned.txt ]; then
    cmp -s seen.txt $state.seen || fail "$what: other results are printed in silence"
  fi

  code=0
  "$program" run sweep.json --no-report --threads 2 --out out >/dev/null 2>said.txt </dev/null || code=$?
  if [ "$code" -gt 1 ]; then
    [ "$code" -eq 4 ] && grep -q '^grainsweep: out' said.txt || fail "$what: ended with $code: $(cat said.txt)"
    told=$((told + 1))
    continue
  fi
  cmp <(values_of out) <(values_of reference) || fail "$what: other values"
  for table in reference/*.csv; do
    table=$(basename "$table")
    [ "$table" = packings.csv ] || cmp "reference/$table" "out/$table" || fail "$what: other $table"
  done
  cmp <(beds_in reference) <(beds_in out) || fail "$what: other grains"
  mended=$((mended + 1))
done

# A bed damaged after the clock was set back by a day: what is made anew counts, in whichever
# journal.
make_of_tomorrow() { # JOURNAL
  perl -MCompress::Zlib=crc32 -i -pe 'next unless /"outcome":(.*)\}$/;
    my $text = $1 =~ s/"finished_at":\K[\d.]+/$& + 86400/er;
    $_ = sprintf(qq({"length":%d,"crc32":"%08x","outcome":%s}\n), length($text), crc32($text), $text)
  ' "$1"
}
for shards in 1/1 "1/2 2/2"; do
  rm -rf out
  for shard in $shards; do run_to_the_end sweep.json out --threads 2 --shard "$shard" --alone; done
  for journal in out/shards/*.jsonl; do
    make_of_tomorrow "$journal"
    printf '\xff' | dd of="${journal%.jsonl}.beds" bs=1 seek=500 conv=notrunc status=none
  done
  run_to_the_end sweep.json out --threads 2
  expect_text said.txt "out/shards/${shards%%/*}-of-${shards##*/}.beds: packing "
  cmp <(values_of out) <(values_of reference) || fail "shards $shards of tomorrow: other values"
  cmp <(beds_in out) <(beds_in reference) || fail "shards $shards of tomorrow: other grains"
  expect_code 0 "$program" status out --check
  [ ! -s error.txt ] || fail "shards $shards of tomorrow: not mended: $(cat error.txt)"
done

# A folder in the place of a checkpoint, for a packing that is made and for one that is not: it is
# reported, no more.
for option in "" "--fresh --yes"; do
  rm -rf out && cp -r half out
  for job in $(tail -n +2 reference/packings.csv | cut -d, -f1); do
    rm -f out/checkpoints/$job.0 && mkdir -p out/checkpoints/$job.0
  done
  run_to_the_end sweep.json out --threads 2 $option
  expect_text said.txt "warning: out/checkpoints/$job.0: cannot remove: Is a directory; "
  cmp <(values_of out) <(values_of reference) || fail "folders as checkpoints, run $option: other values"
done
[ "$mended" -gt $((tries / 2)) ] || fail "only $mended of $tries damaged folders were mended"
echo "$tries damaged folders: $mended mended by the next run, $told refused and told, none silent"
