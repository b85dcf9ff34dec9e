"""The window of the field, in tkinter."""

from __future__ import annotations

import tkinter

from simulated_turtles.field import SIZE, Field


class Window:
    """The window, which only the main thread may use; tkinter.TclError without a screen."""

    def __init__(self) -> None:
        """Open it."""
        self._root = tkinter.Tk(className="turtlesim")
        self._root.title("TurtleSim")
        self._root.resizable(False, False)
        self._root.protocol("WM_DELETE_WINDOW", lambda: setattr(self, "is_open", False))
        self._image = tkinter.PhotoImage(width=SIZE, height=SIZE)
        tkinter.Label(self._root, image=self._image, borderwidth=0).pack()
        self._version, self.is_open = 0, True

    def show(self, field: Field) -> None:
        """Show a field as it is now."""
        if field.version != self._version:
            self._image.put(field.picture("PPM"))
            self._version = field.version
        self._root.update()
