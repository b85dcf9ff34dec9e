"""Floods of messages and connections: the driver goes on, and others come in."""

import contextlib
import json
import socket
import sys

from tutorial_testing import flood
from tutorial_testing.cockpit_rig import WithCockpit
from tutorial_testing.processes import Program, memory_kb
from tutorial_testing.socket_page import SocketPage
from tutorial_testing.waiting import wait_for

VIEWERS, FLOOD_S = 30, 8  # the whole minute, and the latency, are in test/benchmark/cockpit
MOST_MORE_KB = 20_000
# Frames of a WebSocket: pings, answers to none, pieces of a message that does not end.
PINGS, PONGS, PIECES = (1000 * (code + b"\x80" + bytes(4)) for code in (b"\x89", b"\x8a", b"\0"))
MOST_BYTES = 30_000_000
HALF_OPEN, MOST_PAGES = 300, 64
ELSEWHERE = "127.0.0.2"  # another address of this machine


class Flood(WithCockpit):
    options = ("--lan",)

    def memory_kb(self):
        return max(map(memory_kb, self.rig.program.left_behind()))

    def connection(self, address="127.0.0.1"):
        made = socket.create_connection(("127.0.0.1", self.rig.port), 20, (address, 0))
        self.addCleanup(made.close)
        return made

    def upgraded(self, address="127.0.0.1"):
        """Return the socket of a viewer's WebSocket that is opened by hand."""
        host, token = f"127.0.0.1:{self.rig.port}", self.rig.token("look")
        made = self.connection(address)
        made.sendall(
            f"GET /ws?token={token} HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\n"
            "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
            "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n".encode()
        )
        self.assertIn(b"101", made.recv(4096).split(b"\r\n")[0])
        return made

    def test_the_driver_goes_on_beside_thirty_viewers_that_flood(self):
        command = sys.executable, flood.__file__, str(self.rig.port), self.rig.token("look")
        with self.rig.page() as page:
            self.rig.drive(page)
            number = page.wait_for("hello")["id"]
            before_kb, drives = self.memory_kb(), 0
            with Program(*command, str(VIEWERS), str(FLOOD_S)) as program:
                wait_for(lambda: "ready" in program.output, "flood")
                while not program.ended:
                    self.rig.drive(page)  # sits down again, in the midst of it
                    drives += 1
                self.assertEqual(program.wait(), 0, program.output)
                self.assertGreater(json.loads(program.output.splitlines()[-1])["sent"], 1000)
            self.assertGreater(drives, 0)
            # A busy machine may lose the operator for a moment; nobody else ever sits there.
            self.assertLessEqual(
                {session["driver"] for session in page.of("session")}, {number, None}
            )
            self.assertEqual(page.of("closed"), [])
            wait_for(lambda: self.memory_kb() - before_kb <= MOST_MORE_KB, "memory as before")

    def test_a_program_that_sends_frames_without_end_costs_no_memory(self):
        """It is closed, or not read."""
        for frames, begin in ((PINGS, b""), (PONGS, b""), (PIECES, b"\x01\x80" + bytes(4))):
            made, before_kb = self.upgraded(), self.memory_kb()
            made.settimeout(5)
            with self.assertRaises(OSError):
                made.sendall(begin)
                for _ in range(MOST_BYTES // len(frames)):
                    made.sendall(frames)
            self.assertLessEqual(self.memory_kb() - before_kb, MOST_MORE_KB)

    def test_viewers_and_connections_make_room_for_a_driver_and_another_address(self):
        token = self.rig.token("look")
        for _ in range(HALF_OPEN):
            self.connection().sendall(b"GET / HTTP/1.1\r\n")
        with contextlib.ExitStack() as stack:
            pages = []
            # One more than fits; an earlier test may have left some.
            while len(pages) <= MOST_PAGES and not (pages and pages[-1].refusal):
                pages.append(stack.enter_context(SocketPage(self.rig.port, token=token)))
            self.assertEqual(pages[-1].refusal, 503)
            self.upgraded(ELSEWHERE)
            with self.rig.page() as page:
                self.rig.drive(page)
