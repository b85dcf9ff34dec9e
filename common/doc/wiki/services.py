"""Exercise 2: a server that adds, and a client that asks it."""

import re
from dataclasses import dataclass
from typing import Any, Dict, Tuple

from tutorial_course.common import PACKAGE, START_S, must_run, recorded

from tutorial_check.course import check
from tutorial_check.course_kit.client import Answer, Client
from tutorial_check.isolation.program import Ran
from tutorial_check.judge.scripts import crash

SERVER, CLIENT = "add_two_ints_server.py", "add_two_ints_client.py"
SERVICE, KIND = "/add_two_ints", f"{PACKAGE}/AddTwoInts"
ASKED = ((1, 2), (40, -7), (2**40, 2**41))
GIVEN, STRANGE = {"a": 31, "b": 12}, 4321  # for the client, and what our server responds


@dataclass(frozen=True)
class Served:
    """The server, and what it responded."""

    program: Ran
    answers: Tuple[Answer, ...]


@dataclass(frozen=True)
class Asked:
    """The client, whether it waited for our server, and what it asked."""

    program: Ran
    waited: bool
    requests: Tuple[Dict[str, Any], ...] = ()


def serve(ground, script) -> Served:
    """Ask the student's server."""
    with ground.stage() as stage:
        client, answers = Client(stage), []
        program = stage.start(PACKAGE, script)
        for a, b in ASKED:
            if all(answer.values for answer in answers):
                answers.append(client.ask(SERVICE, KIND, {"a": a, "b": b}))
        return Served(program.ran, tuple(answers))


def ask(ground, script) -> Asked:
    """Start the student's client, and our server only when it waits."""
    with ground.stage() as stage:
        client = Client(stage)
        program = stage.start(PACKAGE, script, *map(str, GIVEN.values()))
        if stage.wait_for_start(lambda: program.ended):
            return Asked(program.ran, False)
        client.serve(SERVICE, KIND, {"sum": STRANGE})
        stage.wait(lambda: program.ended, START_S)
        return Asked(program.ran, True, tuple(each[2] for each in client.heard(SERVICE)))


@check("W6", "the server adds", "2", "W5", look=f"rosservice call {SERVICE} 1 2")
def server(session):
    """Compare the sums."""
    found, blame = recorded(session, PACKAGE, SERVER, serve)
    for (a, b), answer in zip(ASKED, found.answers):
        if answer.values is None:
            must_run(session, PACKAGE, found.program, f"a server of {SERVICE}")
            hint = "look at the names in rospy.Service(...)"
            raise blame.wrong("Service(", f"{SERVICE}, {KIND}", answer.trouble, hint)
        if answer.values["sum"] != a + b:
            hint = "return AddTwoIntsResponse(request.a + request.b)"
            raise blame.wrong("return", f"{a} + {b} = {a + b}", answer.values["sum"], hint)


@check("W7", "the client asks and prints", "2", "W5", look=f"rosrun {PACKAGE} {CLIENT} 4 5")
def client(session):
    """Compare what it asked and printed."""
    found, blame = recorded(session, PACKAGE, CLIENT, ask)
    output = found.program.output
    if not found.waited or "Traceback" in output:
        hint = f"rospy.wait_for_service('{SERVICE[1:]}') before the call"
        raise crash(session, PACKAGE, found.program, f"it waits for {SERVICE}", hint)
    if not found.requests:
        seen, hint = "it does not", "look at the name of the service"
        raise blame.wrong("ServiceProxy( wait_for_service(", f"it calls {SERVICE}", seen, hint)
    if found.requests[0] != GIVEN:
        proxy = re.search(r"(\w+)\s*=\s*(?:rospy\.)?ServiceProxy", blame.text)
        words = f"{proxy[1]}( argv" if proxy else "argv"
        hint = "a is sys.argv[1], b is sys.argv[2]"
        raise blame.wrong(words, f"it asks {GIVEN}", found.requests[0], hint)
    if str(STRANGE) not in output:
        seen, hint = output[-80:].strip() or "nothing", "print response.sum"
        raise blame.wrong("print", f"it prints the response, here {STRANGE}", seen, hint)
