# SIGKILL between two beds, inside a bed or while tables are written, then the same command: nothing
# lost, nothing done twice, the same bytes, and no checkpoint of a bed that was gone on with.
source "$(dirname "$0")/common.sh" "$1"
write_small_sweep sweep.json '{ "label": "exact", "set": { "accuracy": "exact" } }'
make_reference sweep.json

kills=0 inside=0 folders=0
wanted=$(times 30 1000)
while [ "$kills" -lt "$wanted" ]; do
  folders=$((folders + 1))
  [ "$folders" -le $((10 * wanted)) ] || fail "only $kills kills came before the end"
  before=0
  for try in 1 2 3; do
    start "$program" run sweep.json --no-report --threads 2 --out out --checkpoint-seconds 0
    wait_until has_packings out "$(between "$before" "$packings")" || true
    [ $((try % 2)) -eq 0 ] || wait_until has_checkpoint out || true
    pause "$(between 0 20)"
    end_runner KILL
    [ "$code" -eq 137 ] || break
    kills=$((kills + 1))
    now=$(whole_jobs out | sort -u | wc -l)
    [ "$now" -ge "$before" ] || fail "kill $kills: a stored packing is lost"
    before=$now
    [ "$before" -lt "$packings" ] || break
  done
  # A run that was done before its kill has stored more than was counted.
  before=$(whole_jobs out | sort -u | wc -l)
  ! has_checkpoint out || inside=$((inside + 1))
  run_to_the_end sweep.json out --threads 2
  [ "$(grep -c '^[0-9]*/[0-9]*  ' said.txt || true)" -eq $((packings - before)) ] ||
    fail "kill $kills: a stored packing was made again: $(cat said.txt)"
  same_as_reference out "after kill $kills"
  rm -r out
done
[ "$inside" -gt 0 ] || fail "no kill left a checkpoint"
echo "$kills times SIGKILL in $folders folders, $inside with checkpoints left: nothing lost, the same bytes"
