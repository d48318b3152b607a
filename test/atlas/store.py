"""Results that a repeated command finds again."""
import hashlib
import json


class Store:
    """Results by the digest of what was run, kept in a file line by line: a repeated call does nothing twice."""

    def __init__(self, path, programs):
        """Of a file, for these programs: others begin anew."""
        self.path, self.found = path, {}
        binaries = [programs / name for name in ("mpm-static", "mpm-seismic", "mpm-seismic-faulty")]
        self.build = hashlib.sha256(b"".join(hashlib.sha256(b.read_bytes()).digest() for b in binaries)).hexdigest()
        text = path.read_text() if path.exists() else ""
        for line in text.splitlines():
            try:
                entry = json.loads(line)
            except ValueError:  # torn: the call that wrote it was killed
                continue
            self.found[entry["key"]] = entry["result"]
        if text and not text.endswith("\n"):  # a torn line ends here, so that the next one is whole
            with path.open("a") as file:
                file.write("\n")

    def key(self, *what):
        """Digest of anything that JSON can write, and the programs."""
        return hashlib.sha256(json.dumps([self.build, *what], sort_keys=True, default=str).encode()).hexdigest()[:24]

    def add(self, key, result):
        """Keeps a result."""
        self.found[key] = result
        with self.path.open("a") as file:
            file.write(json.dumps({"key": key, "result": result}) + "\n")
