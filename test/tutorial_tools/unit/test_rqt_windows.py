"""The places of rqt's windows on the cockpit's page."""

from tutorial_tools.rqt_windows import place

PLACES = {
    "rqt": "", "rqt_console": "log", "rqt_plot": "plot", "rqt_topic /x": "topics/x",
    "rqt_graph": "Graph",
    "rqt_plot a/x:y,/joy/axes[1] /b": "plot?f=/a/x&f=/a/y&f=/joy/axes[1]&f=/b",
    'rqt_plot /a&last=1#"': "plot?f=/a%26last%3D1%23%22",
}  # fmt: skip


def test_place_of_a_window():
    for line, shown in PLACES.items():
        window, *names = line.split()
        assert place(window, names) == shown
