"""Clients and messages that are refused: nothing moves, and the driver still drives."""

import contextlib
import http.client

from tutorial_testing.cockpit_rig import WithCockpit
from tutorial_testing.socket_page import DRIVE, SocketPage


class Refused(WithCockpit):
    """A cockpit for other machines, a robot, and clients that may not drive it."""

    options = ("--lan",)

    def setUp(self):
        self.tokens = self.rig.token("drive"), self.rig.token("look")

    def tearDown(self):
        """Nothing moved, no token was printed again, and the driver may still drive."""
        self.assertEqual([moment for moment in self.rig.odometry if moment.moves], [])
        with self.rig.page() as page:
            self.rig.drive(page)
            page.say("stop")
            self.rig.wait_for_rest()
            self.assertTrue(self.rig.stays_at_rest())
        self.rig.odometry.clear()
        output = self.rig.program.output
        self.assertNotIn("Traceback", output)
        for token in self.tokens:
            self.assertEqual(output.count(token), 1, output)  # printed at the start

    def get(self, path, **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.rig.port, timeout=20)
        with contextlib.closing(connection):
            connection.request("GET", f"{path}?token={self.tokens[0]}", headers=headers)
            answer = connection.getresponse()
            return answer.status, answer.read().decode()

    def test_foreign_hosts_and_origins_other_files_and_sockets_without_a_token_are_refused(self):
        self.assertEqual(self.get("/")[0], 200)
        for headers in ({"Host": "evil.example"}, {"Origin": "http://evil.example"}):
            status, words = self.get("/page/main.js", **headers)
            self.assertEqual((status, words.count("\n")), (403, 1), words)
        for path in ("/page/../package.xml", "/page/%2e%2e/package.xml", "/x"):
            self.assertIn(self.get(path)[0], (403, 404), path)
        driver, port = self.tokens[0], self.rig.port
        for token, headers in (
            (None, {}),
            ("wrong", {}),
            (driver, {"Origin": f"http://127.0.0.1:{port + 1}"}),
            (driver, {"Origin": "null"}),
            (driver, {"Host": f"evil.example:{port}", "Origin": f"http://evil.example:{port}"}),
        ):
            with SocketPage(port, token=token, **headers) as page:
                self.assertEqual(page.refusal, 403, (token, headers))

    def test_a_viewer_may_not_drive_and_long_messages_close_the_connection(self):
        with SocketPage(self.rig.port, token=self.tokens[1]) as page:
            page.say("bag_open", name="joy.bag")
            page.wait_for("bag")
            page.hand = DRIVE
            page.say("drive", robot="", mode="D")
            page.say("reset", robot="")
            page.say("bag_play", topic="/joy", rate=1.0, loop=False, robot="")
            twist = {"topic": "/cmd_vel", "type": "geometry_msgs/Twist", "values": {}}
            page.say("publish", **twist)
            page.say("repeat", **twist, period=0.1)
            page.say("set", parameter="/fake_turtlebot/rate", values={"value": "1"})
            page.say("record", on=True)
            for what in ("drive", "reset", "bag_play", "publish", "repeat", "set", "record"):
                why = page.wait_for("refused", lambda no, what=what: no["what"] == what)["why"]
                self.assertIn("may only look", why)
            self.assertEqual([session for session in page.of("session") if session["yours"]], [])
        with self.rig.page() as page:
            page.say("release", why="x" * 100_000)
            page.wait_for("closed")
