"""Exercises 1 and 2: a message and a service, a server that adds, and its client."""

import re

from tutorial_check import Client, File, Seen, Wrong, check, must_build, package_of, recorded

from .turtles import PACKAGE, START_S

FIELDS = {  # Other fields may be added.
    "msg/Num.msg": ["int64 num"],
    "srv/AddTwoInts.srv": ["int64 a", "int64 b", "---", "int64 sum"],
}
CLIENT = "add_two_ints_client.py"
SERVICE, KIND = "/add_two_ints", f"{PACKAGE}/AddTwoInts"
ASKED, SUM = {"a": 2**40, "b": -7}, 2**40 - 7
GIVEN, STRANGE = {"a": 31, "b": 12}, 4321  # arguments of the client, and our server's response


def serve(workspace, script) -> Seen:
    """Call the student's server."""
    with workspace.ros_session() as ros:
        client = Client(ros)
        program = ros.start(PACKAGE, script)
        answer = client.ask(SERVICE, KIND, ASKED)
        return client.seen(program, answers=[answer.values, answer.trouble])


def ask(workspace, script) -> Seen:
    """Start the student's client, and then, while it waits, our server."""
    with workspace.ros_session() as ros:
        client = Client(ros)
        program = ros.start(PACKAGE, script, *map(str, GIVEN.values()))
        ros.wait_for_start(lambda: program.ended)
        client.serve(SERVICE, KIND, {"sum": STRANGE})
        ros.wait(lambda: program.ended, START_S)
        return client.seen(program, SERVICE)


def check_fields(submission, path):
    """Check the text of a type."""
    folder, wanted = package_of(submission, PACKAGE).folder, FIELDS[path]
    if not (folder / path).is_file():
        names = [str(path.relative_to(folder)) for path in folder.rglob(f"*{path[-4:]}")]
        where, there = "".join(names[:1]), ", ".join(names) or "none"
        raise Wrong(f"{PACKAGE}/{path}", there, where, "capitals count")
    file = File(submission, PACKAGE, path)
    given = [" ".join(line.partition("#")[0].split()) for line in file.text.splitlines()]
    missing = next((line for line in wanted if line not in given), wanted[-1])
    is_right = [line for line in given if line in wanted] == wanted
    words, hint = f"{missing.split()[-1]} int", f"write {missing}"
    file.must(is_right, words, " / ".join(wanted), " / ".join(filter(None, given)), hint)


@check("W1", "Num.msg", "1", look=f"rosmsg show {PACKAGE}/Num", timeless=True)
def message(submission):
    check_fields(submission, "msg/Num.msg")


@check("W2", "AddTwoInts.srv", "1", look=f"rossrv show {PACKAGE}/AddTwoInts", timeless=True)
def service(submission):
    check_fields(submission, "srv/AddTwoInts.srv")


@check("W3", "package.xml: message_generation, message_runtime", "1", timeless=True)
def manifest(submission):
    depends = package_of(submission, PACKAGE).depends
    file = File(submission, PACKAGE, "package.xml")
    for name, kind in (("message_generation", "build"), ("message_runtime", "exec")):
        hint = f"<{kind}_depend>{name}</{kind}_depend>, and not in a comment"
        words = f"{name} message_ depend>"
        file.must(name in depends, words, f"a dependency on {name}", "none", hint)


@check("W4", "catkin_make builds", "1", needs=(message, service), look="catkin_make")
def builds(submission):
    must_build(submission)


@check("W5", "both are generated", "1", needs=builds, look=f"rosmsg show {PACKAGE}/Num")
def are_generated(submission):
    file = File(submission, PACKAGE, "CMakeLists.txt")
    for path, macro in zip(FIELDS, ("add_message_files", "add_service_files")):
        name = path.split("/")[1]
        hint = f"{macro}(FILES {name})"
        if name in package_of(submission, PACKAGE).cmake:
            hint = "generate_messages()"
        is_made = re.search(rf"from .*{PACKAGE}/{name[:-4]}\b", must_build(submission).output)
        words = f"{name} {hint.partition('(')[0]} catkin_package"
        file.must(is_made, words, f"{path} is generated", "it is not", hint)


@check("W6", "the server adds", "2", needs=are_generated, look=f"rosservice call {SERVICE} 1 2")
def server(submission):
    file, seen = recorded(submission, PACKAGE, "add_two_ints_server.py", serve)
    values, trouble = seen.answers
    file.must_run(seen.program, f"a server of {SERVICE}", may_end=bool(values))
    hint = f"look at the names in {file.either('rospy.Service', 'advertiseService')}(...)"
    file.must(values, "Service(", f"{SERVICE}, {KIND}", trouble, hint)
    words, hint = "return", "return AddTwoIntsResponse(request.a + request.b)"
    if not file.is_python:
        words, hint = ".sum return", "response.sum = request.a + request.b; return true"
    file.must(values["sum"] == SUM, words, f"{ASKED} make {SUM}", values["sum"], hint)


@check("W7", "the client asks and prints", "2", needs=are_generated,
       look=f"rosrun {PACKAGE} {CLIENT} 4 5")  # fmt: skip
def client(submission):
    file, seen = recorded(submission, PACKAGE, CLIENT, ask)
    requests, output = seen.heard[SERVICE], seen.program.output
    expected, hint = f"it waits for {SERVICE}", f"wait_for_service('{SERVICE[1:]}')"
    hint = file.either(f"rospy.{hint}", f'ros::service::waitForService("{SERVICE[1:]}")')
    file.must_run(seen.program, expected, f"{hint} before the call", may_end=bool(requests))
    words, hint = "ServiceProxy( serviceClient< wait_for_service(", "look at the service's name"
    file.must(requests, words, f"it calls {SERVICE}", "it does not", hint)
    proxy = re.search(r"(\w+)\s*=\s*(?:rospy\.)?ServiceProxy", file.text)
    words, hint = f"{proxy[1]}( argv" if proxy else "argv[ argv", "a is argv[1], b is argv[2]"
    file.must(requests[0] == GIVEN, words, f"it asks {GIVEN}", requests[0], hint)
    expected, there = f"it prints the response, here {STRANGE}", output[-80:].strip() or "nothing"
    hint = f"print {file.either('response.sum', 'add.response.sum')}"
    file.must(str(STRANGE) in output, "print ROS_INFO cout", expected, there, hint)
