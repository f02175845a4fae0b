# SIGKILL at random times, then the same command: nothing lost, nothing done twice, the same bytes.
source "$(dirname "$0")/common.sh" "$1"
write_small_sweep sweep.json
make_reference sweep.json

kills=0 folders=0 landed=0
wanted=$(times 30 1000)
while [ "$kills" -lt "$wanted" ]; do
  folders=$((folders + 1))
  before=0
  for try in 1 2 3; do
    code=0
    "$program" run sweep.json --threads 2 --out "out$folders" --checkpoint-seconds 0.02 \
      >said.txt 2>&1 &
    runner=$!
    pause "$(between 0 "$duration")"
    kill -KILL $runner 2>/dev/null || true
    wait $runner 2>/dev/null || code=$?
    kills=$((kills + 1))
    [ "$code" -ne 137 ] || landed=$((landed + 1))
    now=$(whole_jobs "out$folders" | sort -u | wc -l)
    [ "$now" -ge "$before" ] || fail "kill $kills: a stored packing is lost"
    before=$now
  done
  run_to_the_end sweep.json "out$folders" --threads 2
  [ "$(grep -c '^[0-9]*/[0-9]*  ' said.txt || true)" -eq $((packings - before)) ] ||
    fail "kill $kills: a stored packing was made again: $(cat said.txt)"
  same_as_reference "out$folders" "after kill $kills"
  rm -r "out$folders"
done
[ "$landed" -gt $((kills / 3)) ] || fail "only $landed of $kills kills came before the end"
echo "$kills times SIGKILL in $folders folders ($landed before the end): nothing lost, the same bytes"
