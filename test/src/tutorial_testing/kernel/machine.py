"""A machine in the machine: Debian's own kernel in QEMU, with the files of this system.

It is emulated in software (TCG), so that no right is needed; its root is this system's, read-only
over 9p, below an overlay in memory that takes all changes. Its clock counts its instructions: the
work of other programs makes a test longer, but no time that is measured in it.
"""

import lzma
import os
import re
import shlex
import shutil
import subprocess
from pathlib import Path

CACHE = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "ros1_tutorial" / "kernel"
BUSYBOX, QEMU = "/bin/busybox", "qemu-system-x86_64"
NEEDED = ("apt-get", "dpkg-deb", BUSYBOX, QEMU)
# In about the order in which to load them; what a kernel has built in, or not at all, has no file.
MODULES = (
    "virtio_ring", "virtio", "virtio_pci_modern_dev", "virtio_pci_legacy_dev", "virtio_pci",
    "netfs", "fscache", "9pnet", "9pnet_virtio", "9p", "overlay", "evdev", "joydev", "uinput",
)  # fmt: skip
INIT = """\
#!/bin/busybox sh
b=/bin/busybox
for folder in proc sys dev lower upper root; do $b mkdir -p /$folder; done
$b mount -t proc proc /proc
$b mount -t sysfs sys /sys
$b mount -t devtmpfs dev /dev
for module in {modules} {modules}; do $b insmod /$module 2>/dev/null; done
$b mount -t 9p -o trans=virtio,version=9p2000.L,msize=524288,cache=loose,ro root /lower
$b mount -t tmpfs tmpfs /upper
$b mkdir /upper/new /upper/work
$b mount -t overlay -o lowerdir=/lower,upperdir=/upper/new,workdir=/upper/work none /root
for folder in proc sys dev; do $b mount --move /$folder /root/$folder; done
$b mkdir -p /root/dev/shm
for folder in run dev/shm; do $b mount -t tmpfs tmpfs /root/$folder; done
$b ip link set lo up
$b hostname localhost
$b chroot /root /bin/sh -c {command}
echo o >/root/proc/sysrq-trigger
$b sleep 60
"""


def kernel():
    """Return (image, {name: file} of its modules) of Debian's package, downloaded once."""
    if not list(CACHE.glob("boot/vmlinuz-*")):
        depends = ("apt-cache", "depends", "linux-image-amd64")
        listed = subprocess.run(depends, capture_output=True, text=True, check=False).stdout
        (name,) = re.findall(r"Depends: (linux-image-\S+)", listed)  # or apt has no lists here
        shutil.rmtree(CACHE, ignore_errors=True)
        CACHE.mkdir(parents=True)
        subprocess.run(("apt-get", "download", name), cwd=CACHE, check=True)
        (package,) = CACHE.glob("*.deb")
        subprocess.run(("dpkg-deb", "-x", package, CACHE), check=True)
    (image,) = CACHE.glob("boot/vmlinuz-*")
    return image, {p.name.split(".")[0].replace("-", "_"): p for p in CACHE.rglob("*.ko*")}


def command_of_machine(folder, script, shift):
    """Return the command line of QEMU, whose standard output is the console.

    folder: for what the kernel starts with: a shell, modules, the guest's script.
    shift: an instruction takes 2**shift ns of the guest's time.
    """
    image, files = kernel()
    modules = [files[name] for name in MODULES if name in files]
    (folder / "bin").mkdir(parents=True)
    shutil.copy(BUSYBOX, folder / "bin/busybox")
    for path in modules:
        data = path.read_bytes()
        (folder / path.stem).write_bytes(lzma.decompress(data) if path.suffix == ".xz" else data)
    names = " ".join(path.stem for path in modules)
    (folder / "init").write_text(INIT.format(modules=names, command=shlex.quote(script)))
    (folder / "init").chmod(0o755)
    pack = f"{BUSYBOX} find . | {BUSYBOX} cpio -o -H newc >../initramfs.cpio"
    subprocess.run(pack, shell=True, cwd=folder, check=True)
    return (
        QEMU, "-accel", "tcg", "-cpu", "max", "-m", "2048", "-icount", f"shift={shift},sleep=on",
        "-nodefaults", "-display", "none", "-no-reboot", "-serial", "stdio",
        "-kernel", str(image), "-initrd", f"{folder}.cpio",
        "-append", "console=ttyS0 quiet panic=-1",
        "-fsdev", "local,id=root,path=/,security_model=none,readonly=on,multidevs=remap",
        "-device", "virtio-9p-pci,fsdev=root,mount_tag=root",
    )  # fmt: skip
