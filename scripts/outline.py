"""From curves as drawn to lines y(x), as a case has them: joined, snapped to each other, checked. Lengths in m."""
import numpy as np
from scipy.spatial import cKDTree

from drawing import Curve, at
from resolved_case import Refused


def without_repeats(points, tolerance):
    """The points of a curve, without those that lie where the one before does."""
    keep = np.append(True, np.linalg.norm(np.diff(points, axis=0), axis=1) > 1e-3 * tolerance)
    return points[keep]


def joined(curves, tolerance):
    """Curves of the same layer that go on where another one ends made one; those that end where they begin are closed."""
    pending, whole = [Curve(c.name, without_repeats(c.points, tolerance), c.closed, c.where) for c in curves], []
    near = lambda a, b: np.linalg.norm(a - b) <= tolerance
    while pending:
        curve, parts, grown = pending.pop(0), 1, True
        while grown and not near(curve.points[0], curve.points[-1]):
            grown = False
            for other in [c for c in pending if c.name == curve.name]:
                both = [(a, b) for a in (curve.points, curve.points[::-1]) for b in (other.points, other.points[::-1]) if near(a[-1], b[0])]
                if both and not near(other.points[0], other.points[-1]):
                    curve.points = np.concatenate([both[0][0], both[0][1][1:]])
                    pending = [c for c in pending if c is not other]
                    parts, grown = parts + 1, True
                    break
        if parts > 1:
            curve.where += f" and {parts - 1} more"
        if near(curve.points[0], curve.points[-1]) and len(curve.points) > 3:
            curve.points, curve.closed = curve.points[:-1], True
        whole.append(curve)
    return whole


def snapped(curves, tolerance):
    """Curves whose points lie on the points, or else the segments, of other curves that are as near as the tolerance."""
    points = np.concatenate([c.points for c in curves])
    owner = np.repeat(np.arange(len(curves)), [len(c.points) for c in curves])
    moved = np.zeros(len(points), dtype=bool)
    tree, original = cKDTree(points), points.copy()
    for k in range(len(points)):
        if not moved[k]:
            near = [j for j in tree.query_ball_point(original[k], tolerance) if j > k and owner[j] != owner[k] and not moved[j]]
            points[near], moved[near] = points[k], True
    tree, whole = cKDTree(points), []
    for k, curve in enumerate(curves):
        own = points[owner == k]
        ends = np.concatenate([own[1:], own[:1]]) if curve.closed else own[1:]
        pieces = []
        for a, b in zip(own, ends):
            pieces += [a[None], on_segment(a, b, points, owner != k, tree, tolerance)]
        pieces += [] if curve.closed else [own[-1:]]
        whole.append(Curve(curve.name, without_repeats(np.concatenate(pieces), tolerance), curve.closed, curve.where))
    return whole


def on_segment(a, b, points, foreign, tree, tolerance):
    """Points of other curves that lie on the segment from a to b, but for its ends, in their order."""
    length = np.linalg.norm(b - a)
    if length <= 2 * tolerance:
        return np.empty((0, 2))
    near = [j for j in tree.query_ball_point((a + b) / 2, length / 2 + tolerance) if foreign[j]]
    along = (points[near] - a) @ (b - a) / length
    aside = np.abs((points[near] - a) @ np.array([a[1] - b[1], b[0] - a[0]]) / length)
    good = (along > tolerance) & (along < length - tolerance) & (aside <= tolerance)
    return points[near][good][np.argsort(along[good], kind="stable")]


def refuse_crossing(curve):
    """Refuses a curve that crosses itself."""
    own = curve.points
    starts, ends = (own, np.roll(own, -1, axis=0)) if curve.closed else (own[:-1], own[1:])
    if (np.diff(own[:, 0]) > 0).all() and not curve.closed:
        return
    turn = lambda a, b, c: (b[..., 0] - a[..., 0]) * (c[..., 1] - a[..., 1]) - (b[..., 1] - a[..., 1]) * (c[..., 0] - a[..., 0])
    for k in range(len(starts) - 2):
        a, b, c, d = starts[k], ends[k], starts[k + 2:], ends[k + 2:]
        cross = (turn(a, b, c) * turn(a, b, d) < 0) & (turn(c, d, a) * turn(c, d, b) < 0)
        if cross.any():
            j = np.flatnonzero(cross)[0]
            share = turn(c[j], d[j], a) / (turn(c[j], d[j], a) - turn(c[j], d[j], b))
            raise Refused(65, f"{curve.where}: crosses itself at {at(*(a + share * (b - a)))}; draw it without the loop")


def rising(points, tolerance, where, notes):
    """x, y of a chain as a line whose x grows: what is vertical is made to lean by a tenth of the tolerance."""
    lean = 0.1 * tolerance
    if points[0, 0] > points[-1, 0]:
        points = points[::-1]
    highest = np.maximum.accumulate(points[:, 0])
    back = np.flatnonzero(points[:, 0] < highest - lean)
    if back.size:
        k = back[0]
        raise Refused(65, f"{where}: hangs over, or turns back, at {at(*points[k - 1])}: a line of a case has one height at each x; "
                          "draw a vertical face there, or cut what is closed into two outlines")
    x, y = highest, points[:, 1]
    groups = np.split(np.arange(len(x)), np.flatnonzero(np.diff(x) > lean) + 1)
    rows = []
    for group in groups:
        middle = x[group].mean()
        if len(group) == 1 or abs(y[group[-1]] - y[group[0]]) <= lean:
            rows.append((middle, y[group[0]]))
            continue
        left = middle - lean / 2 if group[0] else x[0]
        right = left + lean
        if group[-1] == len(x) - 1 and group[0]:
            left, right = x[-1] - lean, x[-1]
        rows += [(left, y[group[0]]), (right, y[group[-1]])]
        notes.append(f"{where}: is vertical at x = {middle:.6g} m, from y = {y[group[0]]:.6g} m to {y[group[-1]]:.6g} m; it is made to lean by "
                     f"{1000 * lean:.2g} mm, and within a cell it is a slope to the programs")
    x, y = np.array(rows).T
    return x, y


def chains(curve, tolerance, notes):
    """(x, y) of the upper and of the lower edge of a closed curve."""
    ring = curve.points
    after = np.roll(ring, -1, axis=0)
    if (ring[:, 0] * after[:, 1] - ring[:, 1] * after[:, 0]).sum() < 0:
        ring = ring[::-1]  # anticlockwise: the lower edge runs to the right
    left, right = ring[:, 0].min(), ring[:, 0].max()
    edges = [np.flatnonzero(np.abs(ring[:, 0] - side) <= 0.1 * tolerance) for side in (left, right)]
    lowest = [edge[np.argmin(ring[edge, 1])] for edge in edges]
    highest = [edge[np.argmax(ring[edge, 1])] for edge in edges]
    walk = lambda a, b: ring[(a + np.arange((b - a) % len(ring) + 1)) % len(ring)]
    both = []
    for chain in (walk(highest[1], highest[0])[::-1], walk(lowest[0], lowest[1])):
        chain = chain.copy()
        chain[0, 0], chain[-1, 0] = left, right
        if len(chain) < 2:
            raise Refused(65, f"{curve.where}: encloses nothing")
        both.append(rising(chain, tolerance, curve.where, notes))
    return both
