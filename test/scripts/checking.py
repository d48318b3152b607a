"""What the check_*.py scripts share: how checks are run and told."""


def report(checks):
    """Runs checks, an iterable of (name, (error, tolerance)); prints a line each and 'N passed, N failed'.

    Returns the exit code: 1 when one failed, and when its error is not a number.
    """
    passed = failed = 0
    for name, (error, tolerance) in checks:
        good = bool(error <= tolerance)
        passed, failed = passed + good, failed + (not good)
        print(f"{'ok  ' if good else 'FAIL'} {name}: error {error:.2e}, allowed {tolerance:.2e}")
    print(f"{passed} passed, {failed} failed")
    return 1 if failed else 0
