#!/usr/bin/python3
"""Floods of messages, connections and requests: the driver goes on, and others come in."""

import contextlib
import json
import socket
import sys
import threading
from concurrent.futures import ThreadPoolExecutor

from tutorial_faults.live.samples import sample
from tutorial_testing import flood
from tutorial_testing.cockpit_rig import WithCockpit
from tutorial_testing.processes import Program
from tutorial_testing.rostests import run
from tutorial_testing.socket_page import SocketPage
from tutorial_testing.waiting import wait_for

VIEWERS, FLOOD_S = 30, 8  # the whole minute, and the latency, are in test/benchmark/cockpit
MOST_MORE_KB = 20_000
PINGS = 100_000
PING = b"\x89\x80" + bytes(4)
# A text message whose end never comes: its begin, and pieces of 0 bytes.
BEGIN, PIECES = b"\x01\x80" + bytes(4), 1000 * (b"\x00\x80" + bytes(4))
PONGS, PONG_BYTES = 1000 * (b"\x8a\x80" + bytes(4)), 30_000_000
HALF_OPEN, MOST_PAGES, REQUESTERS = 300, 64, 20
ELSEWHERE = "127.0.0.2"  # another address of this machine


class Flood(WithCockpit):
    options = ("--lan",)

    def memory_kb(self):
        pids = self.rig.program.left_behind()
        return max(sample(0.0, "cockpit", pid).memory_kb for pid in pids)

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

    def test_thirty_viewers_that_flood(self):
        command = sys.executable, flood.__file__, str(self.rig.port), self.rig.token("look")
        with self.rig.page() as page:
            self.rig.drive(page)
            number = page.wait_for("hello")["id"]
            before_kb, drives = self.memory_kb(), 0
            with Program(*command, str(VIEWERS), str(FLOOD_S)) as program:
                wait_for(lambda: "ready" in program.output, "flood")
                page.watch(robots=True)
                page.wait_for("robots")
                while not program.ended:
                    self.rig.drive(page)  # sits down anew, in the midst of it
                    drives += 1
                self.assertEqual(program.wait(), 0, program.output)
                taken = json.loads(program.output.splitlines()[-1])
            self.assertGreater(taken["sent"], 1000)
            self.assertGreater(drives, 0)
            # A busy machine may lose the operator for a moment; nobody else ever sits there.
            self.assertLessEqual({seat["driver"] for seat in page.of("seat")}, {number, None})
            self.assertNotIn("closed", [message["kind"] for message in page.messages])
            self.assertEqual(page.of("seat")[-1]["driver"], number)
            wait_for(lambda: self.memory_kb() - before_kb <= MOST_MORE_KB, "memory as before")

    def test_pings_whose_answers_are_not_read(self):
        made = self.upgraded()
        before_kb = self.memory_kb()
        with contextlib.suppress(ConnectionError):
            for _ in range(PINGS // 100):
                made.sendall(100 * PING)
        answers = 0
        with contextlib.suppress(ConnectionError):
            while some := len(made.recv(4096)):  # until it is closed
                answers += some
        self.assertLess(answers, PINGS)
        self.assertLessEqual(self.memory_kb() - before_kb, MOST_MORE_KB)

    def test_pongs_that_were_not_asked_for(self):
        made = self.upgraded()
        made.settimeout(5)
        with self.assertRaises(OSError):  # they are read as slowly as messages are
            for _ in range(PONG_BYTES // len(PONGS)):
                made.sendall(PONGS)

    def test_a_message_without_end(self):
        made = self.upgraded()
        made.sendall(BEGIN)
        with self.assertRaises(OSError):  # it is closed
            while True:
                made.sendall(PIECES)

    def test_connections_that_ask_for_nothing(self):
        for _ in range(HALF_OPEN):
            self.connection().sendall(b"GET / HTTP/1.1\r\n")
        with self.rig.page() as page:
            self.rig.drive(page)

    def fill(self, stack, token):
        """As many viewers as there is room for, and one more; None if others are there, too."""
        with contextlib.ExitStack() as attempt:
            pages = []
            while not pages or pages[-1].refusal is None:
                pages.append(attempt.enter_context(SocketPage(self.rig.port, token=token)))
            if len(pages) <= MOST_PAGES:
                return None
            stack.push(attempt.pop_all())
            return pages

    def test_a_flood_of_requests(self):
        """Many connections that ask again and again leave the driver its time."""
        host = f"127.0.0.1:{self.rig.port}"
        request = f"GET /page/style.css HTTP/1.1\r\nHost: {host}\r\n\r\n".encode()
        answers, ends = [], threading.Event()

        def ask():
            one = self.connection()
            while not ends.is_set():
                one.sendall(request)
                answers.append(len(one.recv(1 << 20)))

        with self.rig.page() as page, ThreadPoolExecutor(REQUESTERS) as pool:
            asked = [pool.submit(ask) for _ in range(REQUESTERS)]
            try:
                wait_for(lambda: len(answers) > 10 * REQUESTERS, "answers")
                self.rig.drive(page)
            finally:
                ends.set()
            for one in asked:
                one.result()

    def test_viewers_in_all_places(self):
        token = self.rig.token("look")
        with contextlib.ExitStack() as stack:
            pages = wait_for(lambda: self.fill(stack, token), "room, once those before are gone")
            self.assertEqual(pages[-1].refusal, 503)
            self.upgraded(ELSEWHERE)
            with self.rig.page() as page:
                self.rig.drive(page)
            gone = [page for page in pages if page.of("closed")]
            self.assertEqual(len(gone), 2)


if __name__ == "__main__":
    run()
