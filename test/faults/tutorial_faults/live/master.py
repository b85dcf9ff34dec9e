"""The ROS master of the hunt, which may be killed, hung, and given its memory back."""

import os
import signal
import xmlrpc.client
from typing import NamedTuple

from node_kit.questions import call
from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

ASKER = "/faults"
QUESTION_S = 2.0
STARTS_S = 120.0  # on a machine that is busy with something else


class Memory(NamedTuple):
    """What a master knows: [(node, its uri, topic, type)] of those who publish and subscribe."""

    publishers: list
    subscribers: list
    services: list


class Master:
    """rosmaster on the address of ROS_MASTER_URI; a context manager."""

    def __init__(self, environment):
        """environment: that of the robot."""
        self._environment = environment
        self._uri = environment["ROS_MASTER_URI"]
        self._program = None
        self._memory = None
        self.hung = False

    def __enter__(self):
        self.start()
        return self

    def __exit__(self, *_):
        self._program.__exit__()

    def start(self, simulated=False):
        """Start it and wait for its first answer."""
        port = self._uri.rstrip("/").rsplit(":", 1)[1]
        self._program = Program("rosmaster", "--core", "-p", port, **self._environment)
        wait_for(lambda: self.ask("getPid"), "master", STARTS_S)
        # Or every line of a node's log asks the master first.
        self.ask("setParam", "/rosout_disable_topics_generation", False)
        self.ask("setParam", "/use_sim_time", simulated)

    def ask(self, method, *arguments):
        """The value of a method of the master, or None."""
        return call(self._uri, method, *arguments, caller=ASKER, timeout_s=QUESTION_S)[1]

    def remember(self):
        """Keep what it knows, for restore()."""
        publishers, subscribers, services = self.ask("getSystemState")
        types = dict(self.ask("getTopicTypes"))
        uris = {}

        def entries(kind, more):
            """(node, its uri, name of the topic or service, more about that)."""
            for topic, nodes in kind:
                for node in nodes:
                    uris[node] = uris.get(node) or self.ask("lookupNode", node)
                    yield node, uris[node], topic, more(topic)

        def type_of(topic):
            return types.get(topic, "*")

        self._memory = Memory(
            list(entries(publishers, type_of)),
            list(entries(subscribers, type_of)),
            list(entries(services, lambda service: self.ask("lookupService", service))),
        )

    def kill(self):
        """Kill it as by kill -9; it forgets all."""
        self.remember()
        os.kill(self._program.pid, signal.SIGKILL)
        self._program.wait()

    def restore(self):
        """Tell a new one who was registered, as no node of ROS does by itself.

        A node that has come meanwhile under a name is the newer one, and stays.
        """
        memory, self._memory = self._memory, None
        new = {name for kind in self.ask("getSystemState") for _, names in kind for name in names}
        server = xmlrpc.client.ServerProxy(self._uri)
        for name, uri, topic, kind in memory.publishers:
            if name not in new:
                server.registerPublisher(name, topic, kind, uri)
        for name, uri, topic, kind in memory.subscribers:
            if name not in new:
                server.registerSubscriber(name, topic, kind, uri)
        for name, uri, service, service_uri in memory.services:
            if name not in new and service_uri:
                server.registerService(name, service, service_uri, uri)

    def hang(self):
        """Let it take connections and answer nobody."""
        self.hung = True
        os.kill(self._program.pid, signal.SIGSTOP)

    def go_on(self):
        """Let it answer again."""
        self.hung = False
        os.kill(self._program.pid, signal.SIGCONT)

    @property
    def lost(self):
        """Whether it was killed, and does not yet know who is there."""
        return self._memory is not None
