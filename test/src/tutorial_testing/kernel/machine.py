"""A machine in the machine: Debian's own kernel in QEMU, with the files of this system.

The kernel of a container or of a small virtual machine may have no joysticks. This one has. It is
emulated in software (TCG), so that no right is needed; its root is this system's, read-only over
9p, below an overlay in memory that takes all changes.

While it works, its clock counts its instructions. So the work of other programs on this machine
makes the test longer, but no time that is measured in it. KVM would have the clock of this machine.
"""

import lzma
import os
import re
import shlex
import shutil
import subprocess
import tempfile
from pathlib import Path

CACHE = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "ros1_tutorial" / "kernel"
BUSYBOX = Path("/bin/busybox")
QEMU = "qemu-system-x86_64"
MODULES = ("virtio_pci", "9pnet_virtio", "9p", "overlay", "evdev", "joydev", "uinput")
SHIFT = 1  # of command_of_machine(): about what the emulation takes
EXIT = "the guest's command ended with"  # a line with the exit code, on the console

INIT = """\
#!/bin/busybox sh
b=/bin/busybox
$b mount -t proc proc /proc
$b mount -t sysfs sys /sys
$b mount -t devtmpfs dev /dev
{insmod}
$b mount -t 9p -o trans=virtio,version=9p2000.L,msize=524288,cache=loose,ro root /lower
$b mount -t tmpfs tmpfs /upper
$b mkdir /upper/new /upper/work
$b mount -t overlay -o lowerdir=/lower,upperdir=/upper/new,workdir=/upper/work overlay /root
for folder in proc sys dev; do $b mount --move /$folder /root/$folder; done
$b mkdir -p /root/dev/shm
for folder in run dev/shm; do $b mount -t tmpfs tmpfs /root/$folder; done
$b ip link set lo up
$b hostname localhost
$b chroot /root {command}
echo "{exit} $?"
echo o >/root/proc/sysrq-trigger
$b sleep 60
"""


def makes_joysticks(root=Path("/")):
    """Return whether the kernel of this machine makes joysticks for this user, and has none so far.

    One that is plugged in would be taken for the virtual one. root: where its files are.
    """
    return (
        os.access(root / "dev/uinput", os.W_OK)
        and (root / "sys/module/joydev").exists()
        and not (root / "dev/input/js0").exists()
    )


class MachineError(Exception):
    """There can be no such machine here; the text says in one line why."""


class NoKernelError(MachineError):
    """This is not Debian on a PC, or apt has no lists of packages here."""


def kernel():
    """Return (kernel image, folder of its modules) of Debian's package, downloaded once.

    Raises MachineError.
    """
    for tool in ("apt-get", "dpkg-deb", QEMU):
        if not shutil.which(tool):
            raise MachineError(f"{tool} is missing: on Debian, ./tutorial setup installs it")
    if not BUSYBOX.exists():
        raise MachineError(f"{BUSYBOX} is missing: apt install busybox-static")
    if not list(CACHE.glob("boot/vmlinuz-*")):
        _download()
    image = sorted(CACHE.glob("boot/vmlinuz-*"))[-1]
    # /lib in Debian 12's package, /usr/lib in Debian 13's.
    trees = list(CACHE.glob(f"**/lib/modules/{image.name.split('-', 1)[1]}"))
    if not trees:
        raise MachineError(f"{CACHE} has no modules for {image.name}; remove it and try again")
    return image, trees[0]


def _download():
    try:
        listed = _run("apt-cache", "depends", "linux-image-amd64")
    except MachineError:  # no such package or, as in an image, no lists of packages
        listed = ""
    name = re.search(r"Depends: (linux-image-\S+)", listed)
    if not name:
        raise NoKernelError("apt lists no linux-image-amd64, the kernel of Debian on PCs")
    shutil.rmtree(CACHE, ignore_errors=True)
    CACHE.mkdir(parents=True)
    _run("apt-get", "download", name[1], cwd=CACHE)
    (package,) = CACHE.glob("*.deb")
    _run("dpkg-deb", "-x", str(package), str(CACHE))
    package.unlink()


def _run(*command, cwd=None):
    done = subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False)
    if done.returncode:
        raise MachineError(f"{' '.join(command)}: {done.stderr.strip().splitlines()[-1]}")
    return done.stdout


def modules(tree):
    """Return {name: bytes} of MODULES and of those they need, in the order in which to load them.

    tree: lib/modules/VERSION of a kernel. What is built into the kernel has no file.
    """
    files = {path.name.split(".")[0].replace("-", "_"): path for path in Path(tree).rglob("*.ko*")}
    loaded = {}

    def load(name):
        if name in loaded or name not in files:
            return
        data = files[name].read_bytes()
        if files[name].suffix == ".xz":
            data = lzma.decompress(data)
        needed = re.search(rb"\0depends=([^\0]*)\0", data)
        for other in needed[1].decode().replace("-", "_").split(",") if needed else ():
            load(other)
        loaded[name] = data

    for name in MODULES:
        load(name)
    return loaded


def make_initramfs(path, tree, command):
    """Write what the kernel starts with: a shell, the modules, and the command of the guest."""
    files = {f"modules/{name}.ko": data for name, data in modules(tree).items()}
    insmod = "\n".join(f"$b insmod /{name}" for name in files)
    script = INIT.format(insmod=insmod, command=shlex.join(command), exit=EXIT)
    files.update({"init": script.encode(), "bin/busybox": BUSYBOX.read_bytes()})
    with tempfile.TemporaryDirectory() as folder:
        for name in ("bin", "modules", "proc", "sys", "dev", "lower", "upper", "root"):
            Path(folder, name).mkdir()
        for name, data in files.items():
            Path(folder, name).write_bytes(data)
            Path(folder, name).chmod(0o755)
        pack = f"{BUSYBOX} find . | {BUSYBOX} cpio -o -H newc"
        path.write_bytes(
            subprocess.check_output(pack, shell=True, cwd=folder, stderr=subprocess.DEVNULL)
        )


def command_of_machine(image, initramfs, shift=SHIFT, memory_mib=2048):
    """Return the command line of QEMU; the console is its standard output.

    shift: an instruction takes 2**shift ns of the guest's time.
    """
    return (
        QEMU, "-accel", "tcg", "-cpu", "max", "-m", str(memory_mib),
        "-icount", f"shift={shift},sleep=on",
        "-nodefaults", "-display", "none", "-no-reboot", "-serial", "stdio",
        "-kernel", str(image), "-initrd", str(initramfs),
        "-append", "console=ttyS0 quiet panic=-1",
        "-fsdev", "local,id=root,path=/,security_model=none,readonly=on,multidevs=remap",
        "-device", "virtio-9p-pci,fsdev=root,mount_tag=root",
    )  # fmt: skip
