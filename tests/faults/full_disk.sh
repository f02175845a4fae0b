# A disk that is full at any moment: a message with the path, exit code 4, and with room again the
# same command ends with the same bytes.
source "$(dirname "$0")/common.sh" "$1"
[ "$(id -u)" -eq 0 ] || skip "only root can make a small disk"
write_small_sweep sweep.json
make_reference sweep.json

disk=$here/disk
mkdir "$disk"
mount -t tmpfs -o size=4k tmpfs "$disk" 2>said.txt || skip "mounting is forbidden here: $(cat said.txt)"
trap 'umount "$disk"; rm -rf "$here"' EXIT

refused=0
sizes=$(times 8 60)
whole=$(du -sk reference | cut -f1)
for number in $(seq "$sizes"); do
  rm -rf "${disk:?}"/*
  kilobytes=$((4 + number * whole / sizes))
  mount -o "remount,size=${kilobytes}k" "$disk"
  code=0
  "$program" run sweep.json --threads 2 --out "$disk/out" --checkpoint-seconds 0.02 >said.txt 2>&1 ||
    code=$?
  if [ "$code" -gt 1 ]; then
    [ "$code" -eq 4 ] || fail "$kilobytes kB: ended with $code: $(cat said.txt)"
    grep -q "^grainsweep: $disk/out.*: No space left on device" said.txt ||
      fail "$kilobytes kB: not told what is full: $(cat said.txt)"
    refused=$((refused + 1))
  fi
  mount -o remount,size=64m "$disk"
  run_to_the_end sweep.json "$disk/out" --threads 2
  same_as_reference "$disk/out" "a disk of $kilobytes kB"
done
[ "$refused" -gt 0 ] || fail "no disk was too small"
echo "$sizes small disks, $refused of them full: told, and the same bytes with room again"
