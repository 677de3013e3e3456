#!/usr/bin/env bash
# Boots a Debian kernel in QEMU without KVM, runs a script in it, and brings back its files.
#
#     run_in_vm.sh KERNEL_FOLDER WORK_FOLDER PROGRAM...
#
# KERNEL_FOLDER: the kernel that scripts/fetch_vm_kernel.sh unpacked. WORK_FOLDER holds run.sh, which the machine runs in /trial
# among copies of all the files there; its files in /trial/out come back in WORK_FOLDER/out, its output in WORK_FOLDER/console.
# PROGRAMs are copied to /bin with the libraries they need. The machine's clock counts instructions (-icount): however busy the
# host is, time inside is what a machine of a fixed speed would see. Without random instructions, random addresses and another date
# each time, programs there behave for seconds as they did the last time.
set -euo pipefail

kernel=$1
work=$(cd "$2" && pwd)
shift 2

root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
mkdir -p "$root"/{bin,dev,proc,sys,tmp,modules,trial,lib64}
cp "$(command -v busybox)" "$root/bin/busybox"
cp "$kernel"/modules/*.ko "$root/modules/"
for program in "$@"; do
    cp -L "$program" "$root/bin/"
    strip "$root/bin/$(basename "$program")"
    # Each library goes where the loader of this machine found it.
    ldd "$program" | grep -o '/[^ ]*' | while read -r library; do
        mkdir -p "$root$(dirname "$library")"
        [ -e "$root$library" ] || cp -L "$library" "$root$library"
    done
done
find "$work" -maxdepth 1 -type f -exec cp {} "$root/trial/" \;

cat >"$root/init" <<'INIT'
#!/bin/busybox sh
/bin/busybox --install -s /bin
export PATH=/bin HOME=/trial
mount -t devtmpfs none /dev
mount -t proc none /proc
mount -t sysfs none /sys
for module in hid uhid hid-generic; do insmod /modules/$module.ko; done
# Threads with real-time priority may use the one processor as long as they need.
echo -1 >/proc/sys/kernel/sched_rt_runtime_us
ip link set lo up
mkdir -p /trial/out
cd /trial
sh ./run.sh
stty -F /dev/ttyS1 raw
tar -c -z -C /trial out >/dev/ttyS1
poweroff -f
INIT
chmod +x "$root/init"
(cd "$root" && find . | cpio -o -H newc --quiet) >"$work/initramfs"

rm -rf "$work/out" "$work/out.tar.gz"
# 2^1 ns per instruction: a machine of 500 million instructions per second, that skips the time in which it sleeps.
timeout 240 qemu-system-x86_64 -accel tcg -icount shift=1,sleep=off -cpu max,-rdrand,-rdseed -smp 1 -m 1024 \
    -rtc base=2026-01-01,clock=vm -nodefaults -no-reboot -display none \
    -kernel "$kernel/vmlinuz" -initrd "$work/initramfs" -append "console=ttyS0 quiet panic=-1 mitigations=off nokaslr norandmaps" \
    -serial "file:$work/console" -serial "file:$work/out.tar.gz" </dev/null
rm "$work/initramfs"
tar -x -z -C "$work" -f "$work/out.tar.gz"
