# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a command on a terminal of a given width, and says what it wrote there."""
import fcntl
import os
import pty
import struct
import subprocess
import termios


def on_terminal(command, columns, timeout=600, **more):
    """Exit code and text. Standard output and standard error are the terminal."""
    control, terminal = pty.openpty()
    fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    environment = {"TERM": "xterm"} | more.pop("env", {})
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=terminal, stderr=terminal,
                               env={k: v for k, v in os.environ.items() if k not in ("NO_COLOR", "COLUMNS", "TERM")} | environment, **more)
    os.close(terminal)
    text = b""
    while True:
        try:
            part = os.read(control, 65536)
        except OSError:  # the last writer has gone
            part = b""
        if not part:
            break
        text += part
    os.close(control)
    return process.wait(timeout), text.decode().replace("\r\n", "\n")
