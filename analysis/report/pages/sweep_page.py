"""Page of gearpod sweep: a study at every combination of the values of some keys."""

from functools import partial

from pages import sweep_grid
from pages.sweep_grid import MOST_LINES, Grid
from words import Sizes, noise


class Swept(Grid):
    def __init__(self, data):
        super().__init__(data)
        first = self.points[0]
        self.sizes = Sizes({"name": first["size_name"],
                            "unit": "m" if first["size_unit"] == "mm" else first["size_unit"]})
        self.sizes.factor = 1.0  # the points' sizes are in the displayed unit
        self.level = first["shown_level"]

    def smallest(self, point, level):
        """Smallest fault found, and the curve's a90 with its bounds of the feature that finds it."""
        at = next((at for at in point["smallest_fault"] if at["noise_level"] == level), None)
        if not at or at["size"] is None:
            return None
        found = self.feature(point, at["feature"], level)
        if at["from_curve"] and found and found["a90"] is not None:
            return found["a90"], found["a90_lower"], found["a90_bound"]
        return (at["size"],) * 3

    def feature(self, point, name, level):
        return next((f for f in point["features"]
                     if f["feature"] == name and f["noise_level"] == level), None)


def _by_noise(swept, page):
    levels = sorted({at["noise_level"] for p in swept.points for at in p["smallest_fault"]})
    # The reference level, and as many of the others as can be distinguished.
    chosen = sorted([swept.level] + [v for v in levels if v != swept.level][:MOST_LINES - 1])
    return sweep_grid.figure(
        swept, page, f"a90 over {swept.along.name} by noise", swept.sizes.axis(),
        "Lower is better: the size that the best feature finds with 90\u00a0% probability (a90) with its "
        f"bounds, each one-sided at {swept.confidence}; the upper bound is the smallest fault found. A mark "
        "without bounds is a tested size. An arrow: no bound within the tested sizes. No mark: no tested "
        "size is found.", [(noise(level), partial(swept.smallest, level=level)) for level in chosen],
        "points", "No fault size is found in any study.")


def _by_feature(swept, page, key, title, axis, how, ends):
    def value(point, name):
        entry = swept.feature(point, name, swept.level)
        # Only the bounds of a90 are open where they are missing.
        missing = None if key == "a90" else entry and entry[key]
        return entry and (entry[key], *(missing if entry[end] is None else entry[end] for end in ends))

    names = swept.data["order"]
    if len(names) > MOST_LINES:
        how += f" The chart shows the {MOST_LINES} features that are best most often."
    title = f"{title} over {swept.along.name} at {noise(swept.level)}"
    return sweep_grid.figure(swept, page, title, axis, how,
                             [(name, partial(value, name=name)) for name in names[:MOST_LINES]],
                             "features", f"{title}: no feature has one.")


def parts(data, page):
    """Title, headline sentence, HTML of the answer, HTML of the sections."""
    swept = Swept(data)
    body = ""
    if swept.level is not None:
        body += page.section("found", "Smallest fault found", _by_noise(swept, page))
        body += page.section("features", "Features", _by_feature(
            swept, page, "a90", "a90", f"a90{', ' + swept.sizes.unit if swept.sizes.unit else ''}",
            "The size that the fitted curve finds with 90\u00a0% probability, with its one-sided bounds at "
            f"{swept.confidence}. An arrow: no bound within the tested sizes. No mark: there is no curve, or "
            "it does not reach 90\u00a0% within the tested sizes.",
            ("a90_lower", "a90_bound")) + _by_feature(
            swept, page, "auc", "Area under the ROC", "Area under the ROC",
            "Share of pairs of a faulty and a healthy gearbox that the feature ranks correctly, all fault "
            f"sizes together, with its interval at {swept.confidence}; 0.5 is chance.",
            ("auc_lower", "auc_upper")))
    return sweep_grid.parts(swept, page, "Sweep", body)
