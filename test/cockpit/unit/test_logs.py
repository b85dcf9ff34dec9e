"""Lines of the log on pages."""

import pytest
from rosgraph_msgs.msg import Log

from cockpit_server.tabs.logs import Logs, without_folders
from tutorial_testing.claims import claim
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
