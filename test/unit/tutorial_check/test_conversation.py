"""What works, and is worth a note."""

from types import SimpleNamespace

import pytest

from tutorial_check.exercises import chatter, conversation, joy2twist, talking
from tutorial_check.exercises.driving import CMD_VEL, JOY, PACKAGE, Drive
from tutorial_check.model import Wrong

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


@pytest.mark.parametrize(("sleeps", "where"), [([], SCRIPT), ([7], f"{SCRIPT}:7")])
def test_a_sleep_is_blamed_only_in_the_callback(sleeps, where):
    late = {"is_prompt": False, "delay_s": None, "trouble": False, "answered": 50, "sent": 125}
    seen = SimpleNamespace(script=SCRIPT, sleep_lines=sleeps, **late)
    with pytest.raises(Wrong) as raised:
        conversation.check_rate(None, seen)
    assert (raised.value.where, "no sleep" in raised.value.hint) == (where, bool(sleeps))


@pytest.mark.parametrize(("enough", "is_prompt"), [(0.95, False), (0.5, True)])
def test_of_a_queue_of_one_the_newest_counts(enough, is_prompt):
    seen = {"answered": 90, "sent": 125, "possible": 120, "delay_s": 0.01, "unavoidable_s": 0.0}
    assert Drive.is_prompt.fget(SimpleNamespace(enough=enough, **seen)) == is_prompt
