"""The udev rule and the program that installs it."""

import subprocess

import pytest

from kobuki_driver.io import create_udev_rules
from kobuki_driver.io.ports import PRODUCT, SERIAL, VENDOR
from kobuki_driver.link.udev_rules import RULES
from tutorial_testing.claims import claim

pytestmark = claim(
    "`create_udev_rules` makes the cable /dev/kobuki for the group dialout, with a latency timer "
    "of 1 ms; each obstacle is one line"
)


def test_the_rule_knows_the_cable_by_its_numbers_and_sets_the_latency_timer():
    tty, converter = RULES.replace("\\\n", "").splitlines()[2:]
    assert f'ATTRS{{idVendor}}=="{VENDOR:04x}", ATTRS{{idProduct}}=="{PRODUCT:04x}"' in tty
    assert f'ATTRS{{serial}}=="{SERIAL}*"' in tty
    for part in ('GROUP="dialout"', 'MODE="0660"', 'SYMLINK+="kobuki"'):
        assert part in tty
    for part in ('DRIVER=="ftdi_sio"', 'ATTR{latency_timer}="1"'):
        assert part in converter


@pytest.fixture
def run(monkeypatch):
    def install(*arguments):
        monkeypatch.setattr("sys.argv", ["create_udev_rules", *arguments])
        return create_udev_rules.main()

    return install


def test_it_is_written_and_the_group_is_named(run, tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("SUDO_USER", "nobody_of_this_name")
    assert run("--folder", str(tmp_path / "rules.d")) == 0
    assert (tmp_path / "rules.d/57-kobuki.rules").read_text() == RULES
    assert "sudo usermod -aG dialout nobody_of_this_name" in capsys.readouterr().out


def test_udev_applies_it_at_once(run, tmp_path, monkeypatch):
    commands = []
    monkeypatch.setattr(create_udev_rules, "FOLDER", str(tmp_path))
    monkeypatch.setattr(subprocess, "run", lambda command, **_: commands.append(command))
    assert run("--folder", str(tmp_path)) == 0
    assert [words[1] for words in commands] == ["control", "trigger", "trigger"]


def test_without_udev_one_line_says_so(run, tmp_path, monkeypatch, capsys):
    def fail(*_, **__):
        raise FileNotFoundError

    monkeypatch.setattr(create_udev_rules, "FOLDER", str(tmp_path))
    monkeypatch.setattr(subprocess, "run", fail)
    assert run("--folder", str(tmp_path)) == 0
    assert "udev does not run here" in capsys.readouterr().err


def test_a_user_goes_through_sudo(run, monkeypatch):
    called = []
    monkeypatch.setattr("os.geteuid", lambda: 1000)
    monkeypatch.setattr("os.access", lambda *_: False)
    monkeypatch.setattr("shutil.which", lambda _: "/usr/bin/sudo")
    monkeypatch.setattr("os.execv", lambda path, words: called.append((path, words[1])) or 0)
    run()
    assert called == [("/usr/bin/sudo", "env")]


def test_without_sudo_one_line_says_so(run, monkeypatch, capsys):
    monkeypatch.setattr("os.geteuid", lambda: 1000)
    monkeypatch.setattr("os.access", lambda *_: False)
    monkeypatch.setattr("shutil.which", lambda _: None)
    assert run() == 1
    assert "run it as root" in capsys.readouterr().err


def test_a_folder_that_cannot_be_written_is_one_line(run, tmp_path, capsys):
    (tmp_path / "file").write_text("")
    assert run("--folder", str(tmp_path / "file/rules.d")) == 1
    assert capsys.readouterr().err.count("\n") == 1
