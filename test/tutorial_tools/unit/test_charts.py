"""The library for the page's charts, where the archive has no package of it."""

import hashlib
import io
import tarfile

import pytest

from cockpit_server.io import web_server
from tutorial_testing.claims import claim
from tutorial_tools.io.command import charts

pytestmark = claim(
    "Where the archive lacks the page's charts or zstandard, the set-up fetches them, by their "
    "hashes"
)


@pytest.fixture
def registry(tmp_path, monkeypatch):
    """The registry's file; Debian's package is not installed."""
    file = tmp_path / "dygraphs.tgz"
    with tarfile.open(file, "w:gz") as archive:
        for name in (*charts.FILES, "other.js"):
            about = tarfile.TarInfo(f"package/dist/{name}")
            about.size = len(name)
            archive.addfile(about, io.BytesIO(name.encode()))
    monkeypatch.setattr(charts, "OF_DEBIAN", tmp_path / "none")
    monkeypatch.setattr(charts, "URL", file.as_uri())
    monkeypatch.setattr(charts, "SHA256", hashlib.sha256(file.read_bytes()).hexdigest())
    return file


def test_what_the_archive_lacks_is_fetched_and_served(registry, tmp_path, monkeypatch, capsys):
    workspace = tmp_path / "ws"
    charts.fetch_charts(workspace, again=False)
    folder = workspace / "charts"
    assert {path.name: path.read_text() for path in folder.iterdir()} == {
        name: name for name in charts.FILES
    }
    assert "the archive lacks" in capsys.readouterr().err
    monkeypatch.setenv("TUTORIAL_RESULTS", str(workspace))
    monkeypatch.setattr(web_server, "OF_DEBIAN", tmp_path / "none")
    assert web_server.folder_of_charts() == folder
    registry.unlink()
    charts.fetch_charts(workspace, again=True)
    assert not capsys.readouterr().err


@pytest.mark.parametrize("damage", ["another file", "no network"])
def test_a_failure_is_reported_once_and_leaves_no_file(registry, tmp_path, capsys, damage):
    whole = registry.read_bytes()
    registry.write_bytes(b"another")
    if damage == "no network":
        registry.unlink()
    charts.fetch_charts(tmp_path / "ws", again=False)
    assert "Check the network, then run ./tutorial setup again" in capsys.readouterr().err
    charts.fetch_charts(tmp_path / "ws", again=False)
    assert not capsys.readouterr().err and not (tmp_path / "ws/charts").exists()
    registry.write_bytes(whole)
    charts.fetch_charts(tmp_path / "ws", again=True)
    assert (tmp_path / "ws/charts/dygraph.css").exists()
