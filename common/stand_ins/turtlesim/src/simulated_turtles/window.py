"""The window of the field, in tkinter: an image for the paper and a polygon for each turtle."""

from __future__ import annotations

import tkinter

from simulated_turtles.paper import SIZE

COLORS = ("#4a7c3a", "#8a6a3a", "#3a6a8a", "#7a4a7a")  # The turtles have them in turn.


class Window:
    """The window, which only the main thread may use; tkinter.TclError without a screen."""

    def __init__(self) -> None:
        """Open it."""
        self._root = tkinter.Tk(className="turtlesim")
        self._root.title("TurtleSim")
        self._root.resizable(False, False)
        self._root.protocol("WM_DELETE_WINDOW", lambda: setattr(self, "is_open", False))
        self._image = tkinter.PhotoImage(width=SIZE, height=SIZE)
        self._canvas = tkinter.Canvas(self._root, width=SIZE, height=SIZE, highlightthickness=0)
        self._canvas.create_image(0, 0, image=self._image, anchor="nw")
        self._canvas.pack()
        self._shown: list[list[float]] = []
        self.is_open = True

    def show(self, change: tuple[int, int, bytes] | None, outlines: list[list[float]]) -> None:
        """Show the pixels that changed, from a column and row on, and the turtles' polygons."""
        if change:
            column, row, ppm = change
            self._root.tk.call(str(self._image), "put", ppm, "-to", column, row)
        if outlines != self._shown:
            self._canvas.delete("turtle")
            for number, outline in enumerate(outlines):
                color = COLORS[number % len(COLORS)]
                self._canvas.create_polygon(outline, fill=color, outline="#222", tags="turtle")
            self._shown = outlines
        self._root.update()
