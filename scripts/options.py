"""The command line of the scripts: a wrong one ends with 64, as in the solver, and is answered with the nearest option."""
import argparse
import difflib


class Parser(argparse.ArgumentParser):
    """An argument parser without abbreviations, whose errors end with 64."""

    def __init__(self, *arguments, **named):
        super().__init__(*arguments, allow_abbrev=False, **named)

    def error(self, message):
        self.exit(64, f"{self.prog}: {message}; see {self.prog} --help\n")

    def parse_known_args(self, args=None, namespace=None):
        known, left = super().parse_known_args(args, namespace)
        for word in left:
            if word.startswith("-"):
                self.refuse(word.split("=")[0])
        return known, left

    def refuse(self, option):
        """Ends with what the option may have been meant for."""
        known = [name for action in self._actions for name in action.option_strings if name.startswith("--")]
        like = difflib.get_close_matches(option, known, 1)
        self.error(f"{option}: there is no such option" + (f"; did you mean '{like[0]}'?" if like else ""))
