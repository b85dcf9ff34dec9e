"""Builds are kept in the cache: each where the next check of that workspace looks for it."""

import os
from dataclasses import replace

import pytest

from tutorial_check.recording import build_store
from tutorial_check.recording.build_store import BuildStore, name_of_build, trim
from tutorial_check.recording.build_tree import WHOLE
from tutorial_check.submission.order import Sandbox
from tutorial_testing.claims import claim

pytestmark = claim("Builds are kept in the cache, in a bounded size, for each workspace its last")


@pytest.fixture
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return build_store.cache()


def test_what_a_worker_writes_the_next_one_reads(order, cache):
    with BuildStore(order) as store:
        assert store.descriptors == [store.new]
        os.write(store.new, b"first" + WHOLE)
        store.keep()
        with BuildStore(order) as beside:
            assert os.read(beside.last, 99) == b"first" + WHOLE
    with BuildStore(order) as store:
        assert os.read(store.last, 99) == b"first" + WHOLE
        os.write(store.new, b"cut off")
    with BuildStore(order) as store:
        assert os.read(store.last, 99) == b"first" + WHOLE
    assert os.listdir(cache) == [name_of_build(order)]


def test_a_worker_without_a_cache_has_no_build(order, cache):
    cache.parent.touch()
    with BuildStore(order) as store:
        assert not store.descriptors


def test_what_may_change_a_build_changes_its_name(order, tmp_path, monkeypatch):
    header = tmp_path / "lower/devel/include/ros/ros.h"
    header.parent.mkdir(parents=True)
    header.touch()
    order = replace(order, underlay=str(tmp_path / "lower/devel/setup.bash"))
    names = [name_of_build(order), name_of_build(replace(order, workspace=tmp_path / "other"))]
    names += [name_of_build(replace(order, sandbox=Sandbox({"ROS_DISTRO": "noetic"})))]
    names += [name_of_build(replace(order, variant={"package": "drive"}))]
    header.write_text("// newer")
    names += [name_of_build(order)]
    monkeypatch.setattr(build_store, "_code", lambda: "another release")
    names += [name_of_build(order)]
    assert len(set(names)) == len(names)
    assert name_of_build(order) == name_of_build(replace(order, exercises=("3",)))


def test_builds_that_were_not_used_for_longest_make_room(tmp_path):
    for time_s, name in enumerate(("oldest", "older", "new")):
        (tmp_path / name).write_bytes(b"x" * 10)
        os.utime(tmp_path / name, (time_s, time_s))
    trim(tmp_path, most_bytes=25)
    assert {*os.listdir(tmp_path)} == {"older", "new"}
