# A packing that fails ends nothing but itself, unless that is asked for; it is made again on demand.
source "$(dirname "$0")/common.sh" "$1"
cat >sweep.json <<'JSON'
{ "name": "failing", "replicates": 2,
  "base": { "box": { "length": 5, "width": 5 }, "fill": { "solid_height": 4 },
            "measure": { "exclude_floor": 1, "exclude_surface": 1 }, "accuracy": "fast" },
  "sweep": [ { "label": "small", "grid": { "box.width": [3, 4] } },
             { "label": "too low", "set": { "box.width": 6, "measure.exclude_floor": 5.5 } } ] }
JSON
failed='too low, W = 6 #1  failed (the bed is too low'

expect_code 1 "$program" run sweep.json --no-report --threads 2 --out all
expect_text error.txt "6/6  " "$failed"
[ "$(grep -c ',failed,.*the bed is too low' all/packings.csv)" -eq 2 ] || fail "no reason in the table"
! grep -q pending all/packings.csv || fail "a failed packing ended others"

# The largest packings come first: on one thread the first one fails, and nothing else is made.
expect_code 1 "$program" run sweep.json --no-report --threads 1 --out fast --fail-fast
expect_text error.txt "Stopped by --fail-fast after $failed" "1 of 6 packings are kept in fast"
[ "$(grep -c ',pending,' fast/packings.csv)" -eq 5 ] || fail "--fail-fast did not stop at once"

# Without --fail-fast the rest follows; what failed is not made again.
expect_code 1 "$program" run sweep.json --no-report --threads 2 --out fast
expect_text error.txt "1 of 6 packings are done, going on" "6/6  "
[ "$(values_of fast)" = "$(values_of all)" ] || fail "other values after --fail-fast"

expect_code 1 "$program" run sweep.json --no-report --threads 2 --out fast
[ ! -s error.txt ] || fail "failed packings were made again without being asked: $(cat error.txt)"
expect_code 1 "$program" run sweep.json --no-report --threads 2 --out fast --retry-failed
expect_text error.txt "6/6  " "$failed"
[ "$(grep -c '^[0-9]/6  ' error.txt)" -eq 2 ] || fail "--retry-failed made more than the failed ones"
[ "$(values_of fast)" = "$(values_of all)" ] || fail "other values after --retry-failed"

# Where nothing else is to be made, --fail-fast would stop at the same one for ever.
expect_code 1 "$program" run sweep.json --no-report --threads 1 --out fast --retry-failed --fail-fast
expect_text error.txt "Stopped by --fail-fast after " "6 of 6 packings are kept" "Go on with: "
! grep -q 'Go on with: .*--retry-failed' error.txt || fail "retrying is proposed without end"

# What there is no time to make again stays as it is.
cat >long.json <<'JSON'
{ "name": "long", "base": { "box": { "length": 20, "width": 20 }, "fill": { "solid_height": 8 },
                            "measure": { "exclude_floor": 12 } } }
JSON
expect_code 1 "$program" run long.json --no-report --threads 2 --out long
expect_code 1 "$program" run long.json --no-report --threads 1 --out long --retry-failed --time-limit 1
expect_text error.txt "note: no time was left to make all failed packings again"
[ "$(grep -c ',failed,' long/packings.csv)" -eq 1 ] || fail "a packing is lost that was to be made again"

# Steps that do not suffice: the bed is kept, and neither the table nor the exit code calls it settled.
sed -e 's/"fast" }/{ "preset": "fast", "max_steps": 24 } }/' -e '/"too low"/d' -e 's/4\] } },/4] } } ] }/' \
  sweep.json >short.json
expect_code 1 "$program" run short.json --no-report --threads 2 --out short
[ "$(grep -c ',not_settled,' short/packings.csv)" -eq 4 ] || fail "beds without steps to settle settled"
expect_code 1 "$program" run short.json --no-report --threads 2 --out short
[ ! -s error.txt ] || fail "beds that did not settle were made again: $(cat error.txt)"

# What is taken out of the folder while the run is at work is missed at its end; the next run makes
# it again. A run that was too fast to be robbed is made anew.
for ((try = 1; ; ++try)); do
  rm -rf robbed
  "$program" run sweep.json --no-report --threads 1 --out robbed >out.txt 2>error.txt &
  runner=$!
  until has_packings robbed 2 || ! is_running $runner; do :; done
  mv robbed/shards/1-of-1.beds "stolen-$try" 2>/dev/null || true
  code=0
  wait $runner || code=$?
  if grep -qF " no longer in robbed" error.txt; then break; fi
  [ "$try" -lt 50 ] || fail "nothing was missed: $(cat error.txt)"
done
[ "$code" -eq 1 ] || fail "packings are missing, and the exit code is $code"
expect_code 1 "$program" run sweep.json --no-report --threads 2 --out robbed
[ "$(values_of robbed)" = "$(values_of all)" ] || fail "other values after packings were taken away"
echo "failed packings end nothing but themselves, and those that are gone are missed"
