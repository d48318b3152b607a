"""A screen for programs that draw by OpenGL: the one that there is, else an Xvfb of its own."""
import contextlib
import os
import subprocess

NEEDS_SERVER = not os.environ.get("DISPLAY")


@contextlib.contextmanager
def screen():
    """The environment of a program that draws, while the screen lasts. OSError where Xvfb cannot start."""
    if not NEEDS_SERVER:
        yield dict(os.environ)
        return
    reading, writing = os.pipe()
    # A server resets when its last client leaves, and refuses who comes meanwhile: ParaView, which connects once to try, then to draw.
    command = ["Xvfb", "-displayfd", str(writing), "-screen", "0", "1600x1200x24", "-nolisten", "tcp", "-noreset"]
    with subprocess.Popen(command, pass_fds=[writing], stderr=subprocess.DEVNULL) as server:
        os.close(writing)
        try:
            with os.fdopen(reading) as told:
                number = told.readline().strip()  # once it takes connections
            if not number:
                raise OSError("Xvfb does not start")
            yield os.environ | {"DISPLAY": f":{number}"}
        finally:
            server.terminate()
