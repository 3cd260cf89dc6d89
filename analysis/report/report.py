"""The report's JSON (gearpod report --json), with derived values used by several parts of the
page."""

from words import Sizes

FEWEST = 10  # fewest healthy and faulty gearboxes for statements on detection


class Report:
    def __init__(self, data):
        self.data = data
        self.sizes = Sizes(data["detection"]["size"])
        self.levels = data["noise"]["levels"]
        self.reference = data["noise"]["reference"]
        self.detection = data["detection"]["features"]
        self.reliability = data["reliability"]
        self.confidence = data["detection"]["confidence"]
        self.names = [feature["name"] for feature in data["features"]]

    def title(self):
        return self.data.get("title") or "Detection study"

    def reliable(self, feature, level):
        """Entry of a feature at a noise level in the reliability part, by number."""
        return self.reliability["features"][feature]["levels"][level]

    def cells(self, feature, level):
        return self.detection[feature]["levels"][level]["sizes"]

    def feature_number(self, name):
        return self.names.index(name)

    def smallest_fault(self, level):
        if self.reliability:
            return self.reliability["levels"][level]["smallest_fault"]
        # Without curves: the smallest size demonstrated by the tested rates alone. Of equal sizes,
        # the feature that finds most.
        tested = [(at["reliable_size"][1], -sum(cell["pd"] or 0 for cell in at["sizes"]), name)
                  for name, at in ((f["name"], f["levels"][level]) for f in self.detection)
                  if at["reliable_size"]]
        if not tested:
            return None
        size, _, name = min(tested)
        return {"feature": name, "size": size, "from_curve": False, "source": None}

    def without_threshold(self, level):
        """True if no feature has a threshold at the level; a missing smallest fault then carries no
        information."""
        return all(f["levels"][level]["threshold"] is None for f in self.detection)

    def unit(self, name):
        return self.data["features"][self.feature_number(name)]["unit"]

    def order(self, level):
        """Numbers of the features in order of rank, those without a rank last."""
        if not self.reliability:
            return list(range(len(self.names)))
        ranks = [rank["name"] for rank in self.reliability["levels"][level]["ranking"]["ranks"]]
        ranked = [self.feature_number(name) for name in ranks]
        return ranked + [f for f in range(len(self.names)) if f not in ranked]

    def sample(self):
        """Number of healthy and of faulty gearboxes with a value, for the feature and noise that
        have most."""
        healthy = faulty = 0
        for feature in self.detection:
            for level in feature["levels"]:
                graded = [cell for cell in level["sizes"] if cell["size_high"] > 0]
                sound = [cell for cell in level["sizes"] if cell["size_high"] == 0]
                faulty = max(faulty, sum(cell["tested"] for cell in graded))
                healthy = max(healthy, level["threshold_sample"]
                              + sum(cell["tested"] for cell in sound))
        return healthy, faulty

    def unassessable_reason(self):
        """Reason why detection cannot be assessed, or None."""
        healthy, faulty = self.sample()
        if not self.names or not self.levels:
            return "The study computes no feature, so there is nothing to detect a fault with."
        if healthy == 0 and faulty == 0:
            return "No gearbox has a value of any feature, so detection cannot be assessed."
        if faulty == 0:
            return ("No gearbox of this study has a fault, so detection cannot be assessed; only "
                    "healthy gearboxes are shown.")
        if healthy == 0:
            return ("No healthy gearbox has a value, so no alarm threshold can be set and "
                    "detection cannot be assessed.")
        if all(self.without_threshold(n) for n in range(len(self.levels))):
            return self.data["detection"]["shortage"]
        if min(healthy, faulty) < FEWEST:
            return (f"Only {healthy} healthy and {faulty} faulty gearboxes have values; at least "
                    f"{FEWEST} of each are needed to assess detection.")
        return None
