"""Sphinx: the documentation site, built by test/docs from the pages as they are."""

from pathlib import Path

from sphinx.application import Sphinx

ROOT = Path(__file__).resolve().parents[2]
project = "ROS 1 tutorial"
extensions = ["myst_parser"]
root_doc = "README"
pages = ["*.md", "*/README.md", "common/*/README.md", "common/doc/*.md", "test/*.md"]
include_patterns = [*pages, "common/doc/*/README.md"]
html_theme = "alabaster"
html_theme_options = {"page_width": "auto", "fixed_sidebar": True}
myst_heading_anchors = 4
suppress_warnings = ["myst.xref_missing"]  # links to source files, which are not part of the site


def setup(app: Sphinx) -> None:
    """Give the first page the contents, which GitHub does not need."""
    app.connect("source-read", add_contents)


def add_contents(app: Sphinx, page: str, source: "list[str]") -> None:
    """Append a hidden table of contents to the root page."""
    if page == root_doc:
        others = sorted(app.env.found_docs - {root_doc})
        source[0] += "\n```{toctree}\n:hidden:\n\n" + "\n".join(others) + "\n```\n"
