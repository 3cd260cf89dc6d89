"""JSON of gearpod lives, with derived values used by its page."""

from report import Findings
from words import number


def millimetres(metres):
    return None if metres is None else 1e3 * metres


class CampaignData(Findings):
    def __init__(self, data):
        super().__init__(data)
        self.worked = [life for life in data["lives"] if life["status"] == 0]
        self.ended = [k for k, life in enumerate(self.worked) if life["end_h"] is not None]
        # Time at which the crack starts.
        self.crack_h = data["baseline_records"] * data["interval_h"]
        self.last_mm = 1e3 * data["last_depth_m"]

    def names(self):
        return list(dict.fromkeys(one["feature"] for one in self.data["monitored"]))

    def best_of(self, feature):
        """Detector of a feature that ranks first."""
        return next(one for one in self.data["monitored"]
                    if one["feature"] == feature and one["best_of_feature"])

    def best(self):
        """Feature and detector that rank first; None where none has a rank."""
        return self.data["monitored"][self.data["ranking"][0]] if self.data["ranking"] else None

    def warnings(self, monitored):
        """Hours from the alarm to the end for every life that ends; None without an alarm."""
        return [None if monitored["alarm_h"][k] is None else
                self.worked[k]["end_h"] - monitored["alarm_h"][k]
                for k in self.ended] if monitored["alarm_h"] else []

    def depth_at_end(self, life):
        """Depth at the end in mm: the last depth of the study, or that of the last record if the
        tooth breaks before the next one."""
        interval = self.data["interval_h"]
        if life["end_h"] < life["hours"][-1] + interval * (1 - 1e-9):
            return self.last_mm
        return 1e3 * (life["depth_m"][-1] or self.data["first_depth_m"])

    @staticmethod
    def alarm_h(monitored, k):
        """Time of the first alarm in the k-th valid life; None without an alarm, or if `monitored`
        is None."""
        return monitored["alarm_h"][k] if monitored and monitored["alarm_h"] else None

    def depth_text(self, metres):
        return f"> {number(self.last_mm)}" if metres is None else number(1e3 * metres)
