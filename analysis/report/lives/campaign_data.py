"""JSON of gearpod lives, with derived values used by its page."""

from words import count, number, percent


def millimetres(metres):
    return None if metres is None else 1e3 * metres


class CampaignData:
    def __init__(self, data):
        self.data = data
        self.worked = [life for life in data["lives"] if life["status"] == 0]
        self.ended = [k for k, life in enumerate(self.worked) if life["end_h"] is not None]
        # Time at which the crack starts.
        self.crack_h = data["baseline_records"] * data["interval_h"]
        self.last_mm = 1e3 * data["last_depth_m"]

    def names(self):
        return list(dict.fromkeys(one["feature"] for one in self.data["monitored"]))

    def of(self, feature):
        return [one for one in self.data["monitored"] if one["feature"] == feature]

    def best_of(self, feature):
        """Detector of a feature that finds the most, then at the smallest depth."""
        return min(self.of(feature), key=_order)

    def best(self):
        """Best detector over all features; None where no threshold could be set."""
        known = [one for one in self.data["monitored"] if one["threshold"] is not None]
        return min(known, key=_order) if known else None

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

    def sentence(self):
        best, ends = self.best(), len(self.ended)
        rate = number(self.data["false_alarms_per_1000_h"])
        if best is None:
            return (f"The healthy lives are too few for a threshold at {rate} false alarms per "
                    "1000 hours.")
        if not ends:
            return "No tooth breaks within its records, so nothing can be found before the end."
        low, high = best["share_bounds"]
        text = (f"{best['feature']} by {best['detector']} finds {count(best['found'])} of "
                f"{count(ends)} cracks before the tooth breaks ({percent(low)} to {percent(high)})")
        if best["warning_50_h"] is not None:
            text += (f", half of those found at least {number(best['warning_50_h'])} hours "
                     f"before, 90\u00a0% at least {number(best['warning_90_h'])} hours")
        alarms = best["false_alarms"]
        if alarms["per_1000_h"] is None:
            return text + (f", at {rate} false alarms per 1000 hours (not counted, for lack of "
                           "healthy lives).")
        low, high = (number(bound) for bound in alarms["bounds"])
        return text + (f", at {number(alarms['per_1000_h'])} false alarms per 1000 hours ({low} "
                       f"to {high}; set to {rate}).")


def _order(monitored):
    deep = float("inf")
    depth = [deep if monitored[key] is None else monitored[key]
             for key in ("depth_90_m", "depth_50_m")]
    return (-monitored["found"], *depth)
