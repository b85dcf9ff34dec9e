"""C12: components of CMakeLists.txt that can be found."""

import pytest

from tutorial_check.exercises import packages


@pytest.fixture
def joy2twist(make_session, monkeypatch):
    """C12 of a package with this CMakeLists.txt, all of whose dependencies are declared."""
    session = make_session("joy2twist", "4.3")
    folder = session.package("joy2twist").folder
    monkeypatch.setattr(packages, "_dependencies", lambda *_: session.package("joy2twist"))
    (session.folder / "share/rospy/cmake").mkdir(parents=True)
    (session.folder / "share/rospy/cmake/rospyConfig.cmake").touch()
    session.underlay_environment["CMAKE_PREFIX_PATH"] = str(session.folder)
    session.memo("built", lambda: (1, 'Could not find a package "joystick"\n'))

    def check(text):
        (folder / "CMakeLists.txt").write_text(text)
        return packages.joy2twist(session)

    return check


@pytest.mark.parametrize("words", ["rospy joy2twist", "rospy # joystick", "${NEEDED}"])
def test_components_that_can_be_found(joy2twist, words):
    assert joy2twist(f"find_package(catkin REQUIRED COMPONENTS\n  {words}\n)\n") == "src/joy2twist"
    assert joy2twist("find_package(catkin REQUIRED)") == "src/joy2twist"
