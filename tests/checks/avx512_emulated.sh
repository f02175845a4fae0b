#!/usr/bin/env bash
# Runs the AVX-512 kernels on an emulated processor, for machines that have none.
# usage: avx512_emulated.sh [BUILD]     (build/release if not given; built before with ./test.sh)
#
# Bochs emulates a Skylake-X PC that boots Debian's kernel with the build's own programs in its
# first RAM disk: the kernel tests with AVX-512 forced, then a small sweep whose packings.csv has to
# equal, bit by bit, what this machine makes with SSE2. Takes one to two minutes; installs nothing
# but the packages of `setup.sh --emulator`, and downloads Debian's kernel package once.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
build=$(realpath "${1:-$root/build/release}")
work=$build/avx512_emulated
readonly root build work
readonly time_limit=600 # s; a hung guest must not hang the check
readonly programs=("$build/tests/kernels/test_kernels" "$build/runner/grainsweep")

stop() {
  printf 'avx512_emulated: %s\n' "$1" >&2
  exit 1
}

# Prints the path of a Debian kernel image, downloading its package the first time.
kernel_image() {
  local package
  if ! compgen -G "$work/kernel/boot/vmlinuz-*" >/dev/null; then
    package=$(apt-cache depends linux-image-cloud-amd64 | sed -n 's/^ *Depends: *//p' | head -n 1)
    [[ -n $package ]] || stop 'no kernel package known; run apt-get update'
    (cd "$work" && rm -f ./*.deb && apt-get -q download "$package" >/dev/null 2>&1) ||
      stop "cannot download $package"
    dpkg -x "$work"/*.deb "$work/kernel"
  fi
  compgen -G "$work/kernel/boot/vmlinuz-*"
}

write_sweep() {
  cat >"$work/sweep.json" <<'EOF'
{ "name": "emulated", "seed": 5, "replicates": 1,
  "base": { "shape": "sphere", "box": { "length": 5, "width": 4, "x": "periodic", "y": "walls" },
            "fill": { "solid_height": 7 }, "accuracy": "fast" } }
EOF
}

# make_packings ISA FOLDER: the sweep on this machine. Statuses 0 and 1 both leave a table.
make_packings() {
  rm -rf "$2"
  "$build/runner/grainsweep" run "$work/sweep.json" --out "$2" --isa "$1" --quiet || (($? == 1))
}

# What the guest does. Everything between the marks is the table, for comparison on this side.
write_init() {
  cat >"$work/disk/init" <<'EOF'
#!/bin/busybox sh
/bin/busybox mount -t proc proc /proc
/bin/busybox mount -t sysfs sysfs /sys
/bin/busybox mount -t tmpfs tmpfs /tmp
export GRAINSWEEP_ISA=avx512 HOME=/tmp
cd /tmp
/bin/test_kernels '~[slow]' --use-colour no
echo "kernel tests: status $?"
/bin/grainsweep run /sweep.json --out /tmp/out --threads 1 --quiet
echo "table begins"
/bin/busybox cat /tmp/out/packings.csv
echo "table ends"
/bin/busybox sleep 100000
EOF
  chmod +x "$work/disk/init"
}

# The first RAM disk: the programs, the libraries they load, and a shell.
make_disk() {
  local library
  rm -rf "$work/disk"
  mkdir -p "$work"/disk/{bin,proc,sys,tmp}
  cp /bin/busybox "${programs[@]}" "$work/disk/bin/"
  cp "$work/sweep.json" "$work/disk/"
  while read -r library; do
    install -D "$library" "$work/disk$library"
  done < <(ldd "${programs[@]}" | grep -oE '/[^ ]+\.so[^ ]*' | sort -u)
  write_init
}

# noxsaves, xsavec: Bochs reports the size of the compact state wrongly. tsc_early_khz, lpj: one
# emulated instruction is a tick, so waits are short. The rest leaves out what takes long to boot.
readonly kernel_options="console=ttyS0 quiet panic=-1 nokaslr mitigations=off acpi=off noxsaves \
clearcpuid=xsavec tsc=reliable tsc_early_khz=100000 lpj=10000 cryptomgr.notests \
initcall_blacklist=load_system_certificate_list"

make_image() {
  local image=$work/image
  rm -rf "$image" && mkdir -p "$image/isolinux"
  cp /usr/lib/ISOLINUX/isolinux.bin /usr/lib/syslinux/modules/bios/ldlinux.c32 "$image/isolinux"
  cp "$(kernel_image)" "$image/vmlinuz"
  (cd "$work/disk" && find . | cpio --quiet -o -H newc) | gzip -1 >"$image/disk.gz"
  printf 'DEFAULT test\nLABEL test\nKERNEL /vmlinuz\nINITRD /disk.gz\nAPPEND %s\n' \
    "$kernel_options" >"$image/isolinux/isolinux.cfg"
  genisoimage -quiet -o "$work/boot.iso" -b isolinux/isolinux.bin -c isolinux/boot.cat \
    -no-emul-boot -boot-load-size 4 -boot-info-table "$image"
}

write_machine() {
  cat >"$work/bochsrc" <<EOF
config_interface: textconfig
display_library: term
cpu: model=corei7_skylake_x, count=1, ips=100000000
memory: guest=512, host=512
romimage: file=/usr/share/bochs/BIOS-bochs-latest
vgaromimage: file=/usr/share/vgabios/vgabios.bin
ata0: enabled=1, ioaddr1=0x1f0, ioaddr2=0x3f0, irq=14
ata0-master: type=cdrom, path=$work/boot.iso, status=inserted
boot: cdrom
com1: enabled=1, mode=file, dev=$work/serial
log: $work/bochs.log
sound: driver=dummy
speaker: enabled=0
EOF
  echo c >"$work/continue" # Debian's Bochs starts in its debugger: go on
}

# Bochs does not heed a gentler signal.
stop_machine() {
  kill -KILL "$machine" 2>/dev/null || true
  wait "$machine" 2>/dev/null || true
}

# Runs the machine until the guest is done; its console is in $work/serial.
run_machine() {
  local deadline=$((SECONDS + time_limit))
  : >"$work/serial"
  TERM=vt100 bochs-bin -q -f "$work/bochsrc" -rc "$work/continue" </dev/null \
    >"$work/display" 2>&1 &
  machine=$!
  trap stop_machine EXIT
  while kill -0 $machine 2>/dev/null && ((SECONDS < deadline)) &&
    ! grep -qE '^table ends|Kernel panic' "$work/serial"; do
    sleep 1
  done
  trap - EXIT
  stop_machine
}

# table_of FILE: its rows without the column cpu_seconds, which no two runs share.
table_of() {
  tr -d '\r' <"$1" | awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "cpu_seconds") out = i }
    { $out = ""; print }'
}

"$root/setup.sh" --emulator
for program in "${programs[@]}"; do
  [[ -x $program ]] || stop "no $program; build first, with ./test.sh"
done
mkdir -p "$work"
write_sweep
make_packings sse2 "$work/expected"
make_disk
make_image
write_machine
run_machine

tr -d '\r' <"$work/serial" >"$work/console"
sed '/^table begins/,$d' "$work/console"
grep -qx 'kernel tests: status 0' "$work/console" || stop "kernel tests failed: see $work/console"
grep -q '^table ends' "$work/console" || stop "the sweep did not end: see $work/console"
sed '1,/^table begins/d; /^table ends/,$d' "$work/console" >"$work/packings.csv"
diff <(table_of "$work/expected/packings.csv") <(table_of "$work/packings.csv") ||
  stop 'packings with AVX-512 differ from those with SSE2'
printf 'avx512_emulated: kernel tests pass, and a packing has the same bits as with SSE2\n'
