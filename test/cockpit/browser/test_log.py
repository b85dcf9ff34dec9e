"""The tab Log: which line of a program warned; a filter, a pause and a file."""

import re

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

from tutorial_testing.claims import claim
from tutorial_testing.cockpit.accessibility import violations
from tutorial_testing.waiting import wait_for

PROGRAM = """import rospy, std_msgs.msg
def work():
    rospy.logwarn("battery is low")
rospy.init_node("student")
work()
rospy.wait_for_message("/go", std_msgs.msg.Empty)
rospy.loginfo("later")
rospy.spin()
"""
CPP = (
    "{level: 8, name: /cpp, msg: no scan, file: /opt/ws/src/drive.cpp, line: 40,"
    " function: 'int main(int, char**)'}"
)
# The texts of the rows that are drawn, and how wide the widest one is.
ROWS = "[...document.querySelectorAll('#log-lines tr')].filter((row) => row.offsetHeight)"
TEXTS = f"{ROWS}.map((row) => row.innerText)"
WIDEST = f"Math.max(...{ROWS}.map((row) => row.scrollWidth))"


def press(page, *keys):
    """Press keys, one after the other, where the focus is."""
    ActionChains(page.driver).send_keys(*keys).perform()


def filter_by(page, text):
    page.one("#log-filter").send_keys(Keys.CONTROL, "a", Keys.NULL, text or Keys.DELETE)


@claim(
    "Tab Log: one click shows which line of a program warned, in Python and C++; a filter excludes "
    "as well; new lines wait during a pause; what is shown is saved as in rosout.log"
)
def test_log_shows_the_line_of_a_program_excludes_pauses_and_saves(world, page, ros, tmp_path):
    program = tmp_path / "student.py"
    program.write_text(PROGRAM)
    with world.run("/usr/bin/python3", str(program)), world.run(
        "rostopic", "pub", "/rosout", "rosgraph_msgs/Log", CPP
    ):
        page.tab("Log")  # and no more
        shown = lambda: "\n".join(page.ask(TEXTS))  # noqa: E731
        wait_for(lambda: "battery is low" in shown() and "no scan" in shown(), "both", seen=shown)
        assert re.search(r"WARN\s+/student\s+student\.py:3 work\(\)\s+battery is low", shown())
        assert re.search(r"ERROR\s+/cpp\s+drive\.cpp:40 main\(\)\s+no scan", shown())
        filter_by(page, "-student.py")
        wait_for(lambda: "battery" not in shown() and "no scan" in shown(), "the others")
        filter_by(page, "drive.cpp -battery")
        wait_for(lambda: "no scan" in shown() and "/student" not in shown(), "drive.cpp alone")
        filter_by(page, "")
        press(page, Keys.TAB, Keys.ENTER)
        page.wait_for_text("#log-pause", "Resume")
        ros("rostopic", "pub", "-1", "/go", "std_msgs/Empty")
        page.wait_for_text("#log-count", "1 new")
        assert "later" not in shown()
        press(page, Keys.ENTER)
        wait_for(lambda: "later" in shown(), "what waited")
        filter_by(page, "student")
        page.send("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(tmp_path))
        press(page, Keys.TAB, Keys.TAB, Keys.ENTER)
        saved = tmp_path / "rosout.log"
        lines = wait_for(lambda: saved.exists() and saved.read_text(), "file").splitlines()
    at = r"\d+\.\d{3}"
    for line, wanted in zip(
        lines,
        (
            rf"{at} WARN /student \[student\.py:3\(work\)\] battery is low",
            rf"{at} INFO /student \[student\.py:7\(<module>\)\] later",
        ),
    ):
        assert re.fullmatch(wanted, line)
    assert len(lines) == 2


@claim("Tab Log: one click ...", because="a phone")
def test_a_phone_shows_places_without_a_scroll_to_the_side(world, shared_browser):
    page = shared_browser
    with page.tab_of(360, 740, touch=True):
        page.open(f"{world.address}#log")
        entry = CPP.replace("drive.cpp", f"{'long_' * 12}name.cpp")
        with world.run("rostopic", "pub", "/rosout", "rosgraph_msgs/Log", entry):
            wait_for(lambda: "name.cpp:40" in "".join(page.ask(TEXTS)), "its place")
            assert page.ask(WIDEST) <= 360
            assert violations(page) == []
