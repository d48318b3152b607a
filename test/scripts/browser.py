"""A headless Chromium that a page is opened in, over the DevTools protocol through a pipe: what it shows, loads and says."""
import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time

NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")
PATIENCE = 30  # s


def found():
    """Path of a Chromium, None where there is none."""
    return next(filter(None, map(shutil.which, NAMES)), None)


class Browser:
    """One tab. `errors` holds what console and log told, `requests` the addresses that were asked for."""

    def __init__(self):
        """Starts the browser; its profile is a temporary folder."""
        self.profile = tempfile.TemporaryDirectory()
        to_browser, self.out = os.pipe()
        self.into, from_browser = os.pipe()
        # The protocol is spoken on descriptors 3 (read) and 4 (written).
        command = f"exec {found()} --headless=new --remote-debugging-pipe --no-sandbox --disable-gpu --disable-dev-shm-usage " \
                  f"--no-first-run --hide-scrollbars --user-data-dir={self.profile.name} about:blank 3<&{to_browser} 4>&{from_browser}"
        self.process = subprocess.Popen(["bash", "-c", command], pass_fds=(to_browser, from_browser),
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.pending, self.count, self.session = b"", 0, None
        self.errors, self.requests, self.events = [], [], []

    def __enter__(self):
        """Opens the tab; a RuntimeError says why the browser does not start."""
        try:
            target = self.ask("Target.createTarget", url="about:blank")["targetId"]
            self.session = self.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
            for domain in ("Page", "Runtime", "Log", "Network"):
                self.ask(f"{domain}.enable")
        except (RuntimeError, OSError) as reason:
            self.__exit__()
            raise RuntimeError(f"{found()} does not start: {reason}") from reason
        return self

    def __exit__(self, *_):
        os.close(self.out)  # the browser ends when its pipe does
        os.close(self.into)
        try:
            self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        try:
            self.profile.cleanup()
        except OSError:  # it may still be writing
            shutil.rmtree(self.profile.name, ignore_errors=True)

    def read(self):
        """The next message of the browser."""
        while b"\0" not in self.pending:
            if not select.select([self.into], [], [], PATIENCE)[0]:
                raise RuntimeError(f"the browser has said nothing for {PATIENCE} s")
            data = os.read(self.into, 1 << 20)
            if not data:
                raise RuntimeError("the browser has ended")
            self.pending += data
        message, self.pending = self.pending.split(b"\0", 1)
        return json.loads(message)

    def note(self, message):
        """Keeps what an event tells."""
        name, values = message.get("method"), message.get("params", {})
        if name == "Runtime.exceptionThrown" or name == "Runtime.consoleAPICalled" and values["type"] in ("error", "warning", "assert"):
            self.errors.append(json.dumps(values)[:300])
        elif name == "Log.entryAdded" and values["entry"]["level"] in ("error", "warning"):
            self.errors.append(values["entry"]["text"])
        elif name == "Network.requestWillBeSent":
            self.requests.append(values["request"]["url"])
        self.events.append(name)

    def ask(self, method, **values):
        """The result of a command; events that come before it are noted."""
        self.count += 1
        message = {"id": self.count, "method": method, "params": values} | ({"sessionId": self.session} if self.session else {})
        os.write(self.out, json.dumps(message).encode() + b"\0")
        while True:
            answer = self.read()
            if answer.get("id") == self.count:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]
            self.note(answer)

    def open(self, path, width, height=900, phone=False):
        """Opens a file at a width in pixels and waits for all of it."""
        self.ask("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=phone)
        self.events.clear()
        self.ask("Page.navigate", url=path.resolve().as_uri())
        until = time.monotonic() + PATIENCE
        while "Page.loadEventFired" not in self.events:
            if time.monotonic() > until:
                raise RuntimeError(f"{path} has not loaded in {PATIENCE} s")
            self.note(self.read())

    def value(self, script):
        """The value of an expression in the page."""
        return self.ask("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)["result"].get("value")

    def screenshot(self, path):
        """The whole page as a PNG."""
        data = self.ask("Page.captureScreenshot", captureBeyondViewport=True)["data"]
        path.write_bytes(base64.b64decode(data))

    def print_to(self, path):
        """The page as a PDF, on the paper that its style sheet asks for."""
        path.write_bytes(base64.b64decode(self.ask("Page.printToPDF", preferCSSPageSize=True, printBackground=True)["data"]))
