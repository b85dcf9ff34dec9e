"""Hosts on a separate network: Linux network namespaces, joined by a switch.

It does not touch the machine's own network, and disappears when its last program ends.
"""

import contextlib
import ctypes
import os
import subprocess

from tutorial_testing.processes import Program, Started

AS_ROOT = os.geteuid() == 0
CLONE_NEWNET = 0x40000000  # linux/sched.h


class Host:
    """A network namespace. Programs started in it see its interfaces and no others."""

    def __init__(self, first=None):
        """first: another host. Without root, only hosts of one user namespace can be joined."""
        enter = first.command() if first and not AS_ROOT else []
        user = [] if AS_ROOT or first else ["--user", "--map-root-user"]
        # A namespace lives as long as a program in it. This program ends with its standard input.
        self._holder = subprocess.Popen(
            [*enter, "unshare", *user, "--net", "sh", "-c", "echo; exec cat"],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        )  # fmt: skip
        if not self._holder.stdout.readline():
            raise PermissionError(self._holder.communicate()[1].strip())
        self.ip("link", "set", "lo", "up")

    def close(self):
        self._holder.communicate("")

    def command(self, *command):
        """Return the command line that runs a command here."""
        user = [] if AS_ROOT else ["--user", "--preserve-credentials"]
        return ["nsenter", "--target", str(self._holder.pid), *user, "--net", *command]

    def ip(self, *arguments):
        subprocess.run(self.command("ip", *arguments), check=True, timeout=30)

    def start(self, *command, **environment):
        return Program(*self.command(*command), **environment)

    @contextlib.contextmanager
    def inside(self):
        """Move this thread, and what it starts, to this host. Needs root."""
        theirs = f"/proc/{self._holder.pid}/ns/net"
        with open("/proc/thread-self/ns/net") as own, open(theirs) as there:
            _enter(there)
            try:
                yield
            finally:
                _enter(own)


def _enter(namespace):
    # Python has os.setns() from 3.12 on.
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.setns(namespace.fileno(), CLONE_NEWNET):
        raise OSError(ctypes.get_errno(), "setns")


class Network(Started):
    """Two hosts, each with a cable to one switch. A context manager."""

    def __init__(self, addresses):
        """addresses: name of a host -> its IPv4 address, all in one /24."""
        super().__init__()
        self._switch = self._host()
        self._hosts = {}
        self._switch.ip("link", "add", "bridge", "type", "bridge")
        self._switch.ip("link", "set", "bridge", "up")
        for name, address in addresses.items():
            host = self._hosts[name] = self._host(self._switch)
            holder = str(host._holder.pid)
            end = ["peer", "name", "eth0", "netns", holder]
            self._switch.ip("link", "add", name, "type", "veth", *end)
            self._switch.ip("link", "set", name, "master", "bridge", "up")
            host.ip("address", "add", f"{address}/24", "dev", "eth0")
            host.ip("link", "set", "eth0", "up")

    def __getitem__(self, name):
        return self._hosts[name]

    def _host(self, *first):
        host = Host(*first)
        self._stack.callback(host.close)
        return host

    def pull_cable(self, name):
        """Unplug a host from the switch: the host sees that it has no carrier."""
        self._switch.ip("link", "set", name, "down")

    def plug_cable(self, name):
        self._switch.ip("link", "set", name, "up")
