"""What works, and is worth a note."""

from types import SimpleNamespace

import pytest

from tutorial_check.exercises import chatter, conversation, joy2twist, talking
from tutorial_check.exercises.driving import CMD_VEL, JOY, PACKAGE

SCRIPT = "joy2twist.py"
IN_CALLBACK = """#!/usr/bin/env python3
def callback(data):
    send(Twist())
def send(msg):
    rospy.Publisher("/cmd_vel", Twist, queue_size=1).publish(msg)
rospy.Subscriber("/joy", Joy, callback)
"""


def write(session, package, **texts):
    """Programs of these texts, which may be run."""
    for name, text in texts.items():
        path = session.package(package).folder / f"{name}.py"
        path.write_text(text)
        path.chmod(0o755)


def test_a_publisher_that_is_made_in_the_callback(make_session):
    session = make_session(PACKAGE, "4.3")
    write(session, PACKAGE, joy2twist=IN_CALLBACK)
    seen = SimpleNamespace(
        script=SCRIPT,
        master_alive=True,
        connected=True,
        ended_early=False,
        samples=[],
        shown=0,
        publishers={CMD_VEL: ["/node"]},
        subscribers={JOY: ["/node"]},
        types={CMD_VEL: "geometry_msgs/Twist"},
        warnings=[],
    )
    note = conversation.check_topics(session, seen)
    assert note.seen.startswith("the Publisher is made in the callback")
    assert note.where == "joy2twist.py:5"


NODE = "#!/usr/bin/env python3\nrospy.init_node('{}.py')\n"


@pytest.mark.parametrize(
    "package, names, check, last",
    [
        (PACKAGE, ["joy2twist"], joy2twist.file, "joy2twist"),
        (talking.PACKAGE, ["talker", "listener"], chatter.files, "talker"),
    ],
)
def test_a_node_called_like_its_file(make_session, package, names, check, last):
    session = make_session(package, "4.3")
    write(session, package, **{name: NODE.format(name) for name in names})
    note = check(session)
    assert (note.where, f"'{last}'" in note.hint) == (f"{last}.py:2", True)
