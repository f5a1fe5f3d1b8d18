"""A problem that the user can act on, as one line: "problem (why): what to do"."""

USAGE = 2  # wrong command line
DATA = 3   # a result file that cannot be used
CURE = 74  # something has to be cured before going on helps: a full disk


class Problem(Exception):
    def __init__(self, text, exit_code=DATA):
        super().__init__(text)
        self.exit_code = exit_code
