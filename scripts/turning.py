"""The scale of the motion at which a slope turns from standing to failing, on one grid."""
STRIDE = 1.25  # factor of the scale by which the other side is looked for


def turning(fails_at, fails, runs):
    """Bracket of the turning scale, by halving its logarithm: (greatest that stands, least that fails, runs made).

    fails_at(scale) runs the slope; fails: what it does at 1. A side that was not found within that many runs is None.
    """
    stands_at, fails_from = (None, 1.0) if fails else (1.0, None)
    made = 0
    while made < runs:
        if stands_at is None:
            scale = fails_from / STRIDE
        elif fails_from is None:
            scale = stands_at * STRIDE
        else:
            scale = (stands_at * fails_from)**0.5
        scale = float(f"{scale:.4g}")
        made += 1
        if fails_at(scale):
            fails_from = scale
        else:
            stands_at = scale
    return stands_at, fails_from, made


def in_words(stands, fails):
    """A bracket for people: how many times as strong as the given motion is the one at which the slope turns."""
    if stands is None:
        return f"less than {fails:g} times"
    if fails is None:
        return f"more than {stands:g} times"
    return f"{stands:g} to {fails:g} times"
