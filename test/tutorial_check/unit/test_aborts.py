"""What programs in C++ print when they fail, as g++ 12 and roscpp 1.15 of Debian 12 do."""

import signal

import pytest

from tutorial_check.data.recordings import Ran
from tutorial_check.submission.aborts import (
    abort_of,
    has_error,
    has_failed,
    place_of_abort,
    signal_of,
)
from tutorial_testing.claims import claim

RED, PLAIN = "\x1b[31m", "\x1b[0m"
OWN = f"{PLAIN}[ INFO] [1795824909.705938106]: good day{PLAIN}\n"
INIT_FIRST = "You must call ros::init() before creating the first NodeHandle"
NO_INIT = f"""{RED}[FATAL] [1.0]: {INIT_FIRST}{PLAIN}
{RED}[FATAL] [1.0]: BREAKPOINT HIT
\tfile = ./clients/roscpp/src/libros/node_handle.cpp
\tline=157
{PLAIN}
"""
NO_PUBLISHER = f"""{RED}[FATAL] [1.0]: ASSERTION FAILED
\tfile = /usr/include/ros/publisher.h
\tline = 107
\tcond = false
\tmessage = {PLAIN}
{RED}[FATAL] [1.0]: Call to publish() on an invalid Publisher{PLAIN}
{RED}[FATAL] [1.0]:
{PLAIN}
"""
OWN_ASSERTION = f"""{RED}[FATAL] [1.0]: ASSERTION FAILED
\tfile = /ws/src/beginner_tutorials/src/talker.cpp
\tline = 21
\tcond = ready_
{PLAIN}
"""
NO_NAME = """terminate called after throwing an instance of 'ros::InvalidNameException'
  what():  The node name must not be empty
"""
LOCKED = """terminate called after throwing an instance of 'boost::wrapexcept<boost::lock_error>'
  what():  boost: mutex lock failed in pthread_mutex_lock: Invalid argument
"""
POINTER = (
    "talker: /usr/include/boost/smart_ptr/shared_ptr.hpp:728: typename T::type "
    "boost::shared_ptr<T>::operator->() const [with T = A<B<void> >]: Assertion `px != 0' failed.\n"
)
INDEX = (
    "/usr/include/c++/12/bits/stl_vector.h:1123: reference std::vector<float>::operator[]"
    "(size_type): Assertion '__n < this->size()' failed.\n"
)


@claim(
    "A program in C++ that fails is reported with the error that it printed, or its signal; what "
    "it displays of its own is none"
)
@pytest.mark.parametrize(("output", "error"), [
    (OWN + NO_INIT, INIT_FIRST),
    (OWN + NO_PUBLISHER, "Call to publish() on an invalid Publisher"),
    (OWN_ASSERTION, "assertion ready_ failed"),
    (NO_NAME, "ros::InvalidNameException: The node name must not be empty"),
    (LOCKED, "boost::lock_error: boost: mutex lock failed in pthread_mutex_lock: Invalid argument"),
    ("terminate called after throwing an instance of 'int'\n", "int"),
    ("terminate called without an active exception\n", "terminate called without an active exc"),
    (OWN + POINTER, "Assertion `px != 0' failed"),
    (INDEX, "Assertion '__n < this->size()' failed"),
    ("double free or corruption (out)\n", "double free or corruption (out)"),
    ("*** stack smashing detected ***: terminated\n", "*** stack smashing detected ***"),
])  # fmt: skip
def test_the_error_of_a_program_that_fails(output, error):
    assert abort_of(output).startswith(error)
    assert has_error(output)


@pytest.mark.parametrize("output", [
    "", OWN, f"{RED}[FATAL] [1.0]: no joystick{PLAIN}\n", "the robot is free()\n",
    "Assertion: it works\n",
])  # fmt: skip
def test_what_a_program_displays_is_no_error(output):
    assert not abort_of(output)
    assert not has_error(output)


@pytest.mark.parametrize(("code", "words"), [
    (-signal.SIGSEGV, "SIGSEGV, a segmentation fault"), (-signal.SIGFPE, "SIGFPE, a whole number"),
    (-signal.SIGKILL, ""), (1, ""), (0, ""), (None, ""),
])  # fmt: skip
def test_the_signal_of_a_program_that_fails(code, words):
    ran = Ran("talker", OWN, code, False, False)
    assert signal_of(ran).startswith(words)
    assert has_failed(ran) == bool(words)


@pytest.mark.parametrize(("output", "place"), [
    (INDEX, ("/usr/include/c++/12/bits/stl_vector.h", 1123)), (NO_NAME, ("", 0)),
    (NO_PUBLISHER, ("/usr/include/ros/publisher.h", 107)), (NO_INIT, ("", 0)),
])  # fmt: skip
def test_the_place_of_an_assertion(output, place):
    assert place_of_abort(output) == place
