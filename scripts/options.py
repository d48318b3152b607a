"""The command line of the Python scripts: a wrong one ends with 64, as the programs do, and the nearest option is named."""
import argparse
import difflib
import os
import sys


class Parser(argparse.ArgumentParser):
    """An argument parser without abbreviations, whose errors end with 64."""

    def __init__(self, *arguments, **named):
        """As argparse.ArgumentParser, which would take --mot for --motion. Started by seismpm, it goes by the name that it was given there."""
        named["prog"] = os.environ.pop("SEISMPM_COMMAND", named.get("prog"))
        super().__init__(*arguments, allow_abbrev=False, **named)

    def error(self, message):
        """Ends with 64 and the message."""
        self.exit(64, f"{self.prog}: {message}; see {self.prog} --help\n")

    def parse_known_args(self, args=None, namespace=None):
        """Parses, once every option is known to be one."""
        for word in sys.argv[1:] if args is None else args:
            option = word.split("=")[0]
            if word == "--":
                break
            if option.startswith("--") and option not in self._option_string_actions:
                self.refuse(option)
        return super().parse_known_args(args, namespace)

    def refuse(self, option):
        """Ends with 64 and the option that may have been meant."""
        like = difflib.get_close_matches(option, self._option_string_actions, 1)
        self.error(f"{option}: there is no such option" + (f"; did you mean '{like[0]}'?" if like else ""))
