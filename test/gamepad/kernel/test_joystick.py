"""A joystick of a real Linux kernel drives: of this one, or of Debian's in QEMU if it makes none.

QEMU emulates the processor in software (TCG), which needs no privileges. The guest's root is this
system's, read-only over 9p, below an overlay in memory. Its clock counts instructions, so the load
of other programs prolongs the test, but no time that the test measures.
"""

import lzma
import os
import re
import shlex
import shutil
import subprocess
from pathlib import Path

import pytest

from tutorial_testing.claims import claim
from tutorial_testing.processes import Program, free_port

LONGEST_S = 3600.0  # alone some minutes; beside other tests several times as long
CACHE = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "ros1_tutorial/kernel"
BUSYBOX, QEMU = "/bin/busybox", "qemu-system-x86_64"
# Loaded in this order; a module that is built in, or missing, has no file.
MODULES = (
    "virtio_ring", "virtio", "virtio_pci_modern_dev", "virtio_pci_legacy_dev", "virtio_pci",
    "netfs", "fscache", "9pnet", "9pnet_virtio", "9p", "overlay", "evdev", "joydev", "uinput",
)  # fmt: skip
# The variables that the guest's environment keeps.
KEPT = r"PATH|PYTHONPATH|CMAKE_PREFIX_PATH|LD_LIBRARY_PATH|PKG_CONFIG_PATH|ROS_(?!IP|LOG_DIR).*"
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
for name in run dev/shm; do $b mkdir -p /root/$name; $b mount -t tmpfs tmpfs /root/$name; done
$b ip link set lo up
$b hostname localhost
$b chroot /root /bin/sh -c {command}
echo o >/root/proc/sysrq-trigger
$b sleep 60
"""


def makes_joysticks():
    """Return whether this kernel does, and has no joystick yet, which js0 would be."""
    there = map(os.path.exists, ("/sys/module/joydev", "/run/udev/control"))
    return os.access("/dev/uinput", os.W_OK) and all(there) and not Path("/dev/input/js0").exists()


def kernel():
    """Return (image, {name: file} of its modules) of Debian's package, downloaded once."""
    if not list(CACHE.glob("boot/vmlinuz-*")):
        listed = subprocess.check_output(("apt-cache", "depends", "linux-image-amd64"), text=True)
        (name,) = re.findall(r"Depends: (linux-image-\S+)", listed)
        CACHE.mkdir(parents=True, exist_ok=True)
        subprocess.run(("apt-get", "download", name), cwd=CACHE, check=True)
        (package,) = CACHE.glob("*.deb")
        subprocess.run(("dpkg-deb", "-x", package, CACHE), check=True)
    (image,) = CACHE.glob("boot/vmlinuz-*")
    return image, {p.name.split(".")[0].replace("-", "_"): p for p in CACHE.rglob("*.ko*")}


def in_guest(command, folder, shift):
    """Return the command that starts a guest which runs a command; folder: for its initramfs."""
    image, files = kernel()
    modules = [files[name] for name in MODULES if name in files]
    (folder / "bin").mkdir(parents=True)
    shutil.copy(BUSYBOX, folder / "bin/busybox")
    for path in modules:
        data = path.read_bytes()
        (folder / path.stem).write_bytes(lzma.decompress(data) if path.suffix == ".xz" else data)
    given = {name: value for name, value in os.environ.items() if re.fullmatch(KEPT, name)}
    # The home is in the guest: a QEMU that root did not start may not read root's.
    given.update(HOME="/run", ROS_HOSTNAME="localhost", PYTHONUNBUFFERED="1")
    given["ROS_MASTER_URI"] = "http://localhost:11311"
    udev, words = "/lib/systemd/systemd-udevd --daemon", shlex.join(map("=".join, given.items()))
    script = shlex.quote(f"{udev}; env -i {words} {shlex.join(command)}")
    names = " ".join(path.stem for path in modules)
    (folder / "init").write_text(INIT.format(modules=names, command=script))
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


# An instruction takes 2**shift ns: less for the page, which is late for the cockpit after 0.2 s.
@claim("A joystick of a real kernel drives, by the nodes and by Chromium's page, in both modes")
@pytest.mark.parametrize(("script", "shift"), [("drive", 1), ("drive_page", 0)])
def test_a_joystick_of_the_kernel_drives_the_robot_by(script, shift, tmp_path):
    needed = ["chromedriver"] * ("page" in script) + [QEMU, BUSYBOX] * (not makes_joysticks())
    for program in needed:
        if not shutil.which(program):
            pytest.skip(f"no {program}: ./tutorial setup or ./tutorial test browser installs it")
    command = ("/usr/bin/python3", str(Path(__file__).with_name(f"{script}.py")))
    command = command if makes_joysticks() else in_guest(command, tmp_path / "initramfs", shift)
    with Program(*command, ROS_MASTER_URI=f"http://localhost:{free_port()}") as program:
        program.wait(LONGEST_S)
        assert "drive: passed" in program.output, program.output
