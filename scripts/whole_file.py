"""Files that a repeated command reads back: whole or not there, however the one before was cut short."""
import os


def write_whole(path, text):
    """Puts a text in the place of the file at `path`, brought to the disk beside it and then renamed."""
    part = path.with_name(path.name + ".part")
    with open(part, "w", encoding="utf-8") as file:
        file.write(text)
        file.flush()
        os.fsync(file.fileno())
    part.replace(path)
