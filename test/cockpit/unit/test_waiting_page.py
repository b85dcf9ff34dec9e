"""Before the master runs, a browser gets a page that says so and reloads by itself."""

import socket
import threading
import urllib.error
import urllib.request

import pytest

from cockpit_server.io import waiting_page


def test_a_browser_that_comes_before_the_master_is_told_so_and_one_that_is_silent_holds_up_none():
    with socket.create_server(("127.0.0.1", 0)) as listener:
        address = listener.getsockname()
        answer_for = waiting_page.answer_for
        serving = threading.Thread(target=answer_for, args=(listener, 2.0), daemon=True)
        with socket.create_connection(address):
            serving.start()
            with pytest.raises(urllib.error.HTTPError) as raised:
                urllib.request.urlopen(f"http://127.0.0.1:{address[1]}/?token=x", timeout=30)
        answer = raised.value
        assert (answer.code, answer.headers["Refresh"]) == (503, "1")
        assert "waits for a ROS master: start roscore" in answer.read().decode()
        serving.join()
