"""Lines of the log on pages."""

from pathlib import Path

import pytest
from rosgraph_msgs.msg import Log

from cockpit_server.tabs.logs import Logs, shown, without_folders
from tutorial_testing.claims import claim
from tutorial_testing.nodes import serialised
from tutorial_testing.session_room import Topics, look, page


def test_page_that_watches_the_log_gets_each_line_once():
    topics = Topics()
    logs = Logs(topics)
    client, sent = page()

    def lines(text, log):
        for _ in range(2):  # a new connection brings a latched line again
            topics.hear("/rosout", Log(msg=text))
        client.watch.log = log
        messages = [message for _ in range(2) for message in look(logs, (client, sent))[0]]
        return [entry["text"] for message in messages for entry in message["entries"]]

    assert lines("b", log=True) == ["b"]
    assert lines("c", log=False) == []
    assert lines("d", log=True) == ["c", "d"]  # the page already has the others


@claim("Folders of the server are not shown")
@pytest.mark.parametrize(
    ("text", "shown_text"),
    [("in /home/ada/ws/x.bag", "in ./x.bag"), ("/home/ada/.ros/log", "~/.ros/log"),
     ("/home/ada", "~"), ("/home/ada2/x /home/ada/ws-2", "/home/ada2/x ~/ws-2")],
)  # fmt: skip
def test_folders_of_the_server_are_not_shown(text, shown_text):
    assert without_folders(text, "/home/ada", "/home/ada/ws") == shown_text


@claim("Folders of the server ...", because="the file of a C++ node")
@pytest.mark.parametrize(
    ("file", "function", "place"),
    [("talker.py", "Talker.spin", "talker.py:12(Talker.spin)"), ("", "", ""),
     (f"{Path.home()}/ws/talker.cpp", "int main(int, char**)",
      "~/ws/talker.cpp:12(int main(int, char**))")],
)  # fmt: skip
def test_a_line_has_its_place_in_the_program(file, function, place):
    assert shown(serialised(Log(file=file, line=12, function=function)))["place"] == place


def test_no_name_of_a_line_is_long():
    long = "x" * 10**6
    entry = shown(serialised(Log(name=long, msg=long, file=long, function=long)))
    assert len("".join(map(str, entry.values()))) < 3000
