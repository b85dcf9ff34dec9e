"""What several exercises need: names, turtlesim on a stage, lines that are to blame."""

from tutorial_check.judge.scripts import crash, program_of
from tutorial_check.model import CannotCheck, Wrong
from tutorial_check.source.launch_xml import place_of

PACKAGE = "beginner_tutorials"
POSE, TWIST = "turtlesim/Pose", "geometry_msgs/Twist"
START_S = 8.0
# Where the real one is installed, it is that, which draws with Qt.
TURTLESIM = ["env", "QT_QPA_PLATFORM=offscreen", "rosrun", "turtlesim", "turtlesim_node"]


def start_turtles(stage, client):
    """Start turtlesim; listen to turtle1."""
    stage.launch(TURTLESIM, trusted=True)
    client.listen("/turtle1/pose", POSE)
    if not stage.wait(lambda: client.count("/turtle1/pose"), START_S):
        raise CannotCheck("turtlesim does not start")


def path_of(client, topic="/turtle1/pose", since=0):
    """Return (x, y, theta, speed, rate of turn) of each pose of a turtle."""
    return tuple(tuple(values.values()) for _, _, values in client.heard(topic, since))


def moves(client, topic="/turtle1/pose"):
    """Return whether a turtle has moved within the last second."""
    newest = path_of(client, topic, max(0, client.count(topic) - 62))
    return any(speed or turn for *_, speed, turn in newest)


def recorded(session, package, name, recorder, *arguments):
    """Return what was recorded of a program, and the Blame of it. Raises Wrong."""
    script = program_of(session, package, name)
    return session.recording(recorder, script, *arguments), Blame(session, package, script)


def must_run(session, package, ran, expected):
    """Raise Wrong for a program that ended, or printed a traceback."""
    if ran.ended or "Traceback" in ran.output:
        raise crash(session, package, ran, expected, "rospy.spin() keeps it running")


class Blame:
    """A program of the student's, to name its lines."""

    def __init__(self, session, package, script):
        self._script, self.text = script, session.text(package, script)

    def line(self, *words):
        """Return FILE:LINE of the first of these words that is there; else the file."""
        return place_of(self._script, self.text, *words)

    def wrong(self, words, expected, seen, hint=""):
        """Return the Wrong for the line with the first of these words."""
        return Wrong(expected, str(seen), self.line(*words.split()), hint)
