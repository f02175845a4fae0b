# The same sweep gives the same bytes on any number of threads and any instruction set.
source "$(dirname "$0")/common.sh" "$1"
write_sweep sweep.json 2

values_with() { # FOLDER OPTION...
  local folder=$1 code=0
  shift
  "$program" run sweep.json --out "$folder" "$@" >/dev/null 2>error.txt || code=$?
  [ "$code" -le 1 ] || fail "run $* ended with $code: $(cat error.txt)"
  values_of "$folder" >"$folder.txt"
}

values_with one --threads 1
[ "$(grep -c ',settled,\|,not_settled,' one.txt)" -eq 10 ] || fail "packings failed: $(cat one.txt)"
for threads in 2 8; do
  values_with $threads --threads $threads
  cmp one.txt $threads.txt || fail "other bits on $threads threads"
done
compared=""
for isa in sse2 avx2 avx512; do
  "$program" doctor | grep "^instruction sets" | grep -q "$isa[,;]" || continue
  values_with $isa --isa $isa
  cmp one.txt $isa.txt || fail "other bits with $isa"
  grep -q "\"isa\": \"$isa\"" $isa/provenance.json || fail "$isa was not used"
  compared="$compared $isa"
done
for folder in 2 8 sse2; do
  (cd $folder/states && sha256sum -- *.grains) >$folder.sums
  (cd one/states && sha256sum -- *.grains) | cmp - $folder.sums || fail "other grains in $folder"
done
echo "the same bits on 1, 2 and 8 threads and with$compared"
