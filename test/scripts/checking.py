"""What the check_*.py scripts share: how checks are run and told."""


def report(checks):
    """Runs checks, an iterable of (name, (error, tolerance)); prints a line each and 'N passed, N failed'.

    Instead of (error, tolerance) a check that cannot be made gives the reason, as text: it is told as skipped, and counted so.
    Returns the exit code: 1 when one failed, and when its error is not a number.
    """
    passed = failed = skipped = 0
    for name, result in checks:
        if isinstance(result, str):
            skipped += 1
            print(f"skipped {name}: {result}")
            continue
        error, tolerance = result
        good = bool(error <= tolerance)
        passed, failed = passed + good, failed + (not good)
        print(f"{'ok  ' if good else 'FAIL'} {name}: error {error:.2e}, allowed {tolerance:.2e}")
    print(f"{passed} passed, {failed} failed" + (f", {skipped} skipped" if skipped else ""))
    return 1 if failed else 0
