"""Tables and picture of the league of indicators."""

import textwrap

import numpy as np
import scipy.stats

import league_statistics as statistics

LISTED = 12        # indicators in the table of all faults
BASELINE = ("own_", "change_", "baseline_")
KINDS = ("record", "own_", "change_")


def table(head, rows):
    lines = ["| " + " | ".join(map(str, row)) + " |" for row in [head, ["---"] * len(head), *rows]]
    return "\n".join(lines)


def percent(share):
    return f"{100 * share:.0f}"


class League:
    def __init__(self, season, again, low_band, low_band_Hz, faults, rates, costs):
        self.season, self.again, self.low_band, self.low_band_Hz = season, again, low_band, low_band_Hz
        self.faults, self.rates, self.costs = faults, rates, costs
        self.names = np.array(season.names)
        self.baseline = np.array([name.startswith(BASELINE) for name in season.names])
        self.loudest = len(season.levels) - 1
        self.areas = {(fault[0], level): season.aucs(fault[0], level)
                      for fault in faults for level in range(len(season.levels))}
        # Detected shares and their intervals at the first rate and the largest noise.
        self.shares = np.array([self.share(fault[0], rates[0]) for fault in faults])
        self.bounds = np.array([statistics.share_interval(self.healthy(fault[0]), self.faulty(fault[0]), rates[0])
                                for fault in faults])

    def healthy(self, fault, level=None):
        return self.season.healthy[fault][:, :, self.loudest if level is None else level]

    def faulty(self, fault, level=None):
        return self.season.values[fault][:, :, self.loudest if level is None else level]

    def share(self, fault, rate, level=None):
        return statistics.detected_share(self.healthy(fault, level), self.faulty(fault, level), rate)

    # Sections of the page.

    def sample(self):
        count, faulty = self.counts()
        rows = []
        for rate in self.rates:
            rank = statistics.threshold_rank(count, rate)
            if rank is None:
                rows.append([f"{rate:g}", "none", f"at least {round(1 / rate) - 1} healthy gearboxes are needed"])
            else:
                low, high = statistics.rate_interval(count, rank)
                rows.append([f"{rate:g}", f"value {rank} of {count}", f"[{low:.2g}, {high:.2g}]"])
        return (f"{self.season.conditions} {count} healthy gearboxes, {faulty} with each fault (a third of each size), "
                f"{len(self.names)} indicators.\n\n"
                + table(["false-alarm rate", "threshold", "95 % interval of its rate"], rows))

    def counts(self):
        """Numbers of healthy gearboxes and of gearboxes with each fault."""
        first = self.faults[0][0]
        return len(self.season.healthy[first]), len(self.season.values[first])

    def leaders(self):
        rows = []
        for name, words, *_ in self.faults:
            for level in reversed(range(len(self.season.levels))):
                for with_baseline in (False, True):
                    chosen = np.flatnonzero(self.baseline == with_baseline)
                    areas = self.areas[name, level].only(chosen)
                    best = int(np.argmax(areas.area))
                    low, high = areas.intervals()
                    shares = []
                    for rate in self.rates:
                        if self.share(name, rate, level) is None:
                            shares.append("-")
                            continue
                        bounds = statistics.share_interval(self.healthy(name, level)[:, chosen], self.faulty(name, level)[:, chosen],
                                                           rate)[:, best]
                        shares.append(f"{percent(self.share(name, rate, level)[chosen][best])} "
                                      f"[{percent(bounds[0])}, {percent(bounds[1])}]")
                    alike = int(areas.indistinguishable_from_best().sum()) - 1
                    rows.append([words if not with_baseline and level == self.loudest else "", f"x {self.season.levels[level]:g}",
                                 f"`{self.names[chosen][best]}`",
                                 f"{areas.area[best]:.3f} [{low[best]:.3f}, {high[best]:.3f}]", *shares, alike])
        return table(["fault", "noise", "best", "AUC"] + [f"detected % at {rate:g}" for rate in self.rates]
                     + ["not distinguishable from it"], rows)

    def overall(self):
        order = np.argsort(-self.shares.mean(axis=0), kind="stable")[:LISTED]
        rows = [[f"`{self.names[i]}`", percent(self.shares[:, i].mean())]
                + [f"{percent(self.shares[f, i])} [{percent(self.bounds[f, 0, i])}, {percent(self.bounds[f, 1, i])}]"
                   for f in range(len(self.faults))] for i in order]
        return table(["indicator", "mean"] + [fault[0] for fault in self.faults], rows)

    def orders(self):
        first, top = self.faults[0][0], self.loudest
        season, again = self.season, self.again
        exponents, healthy = season.exponents[first], season.healthy_exponents
        rows = []

        def add(condition, some, others):
            tau = scipy.stats.kendalltau(some.area, others.area).statistic
            leaders = [", ".join(f"`{self.names[i]}`" for i in np.argsort(-areas.area, kind="stable")[:3])
                       for areas in (some, others)]
            rows.append([condition, f"{tau:.2f}", *leaders])

        add("other gearboxes (second seed)", season.aucs(first, top), again.aucs(first, top))
        add(f"noise x {season.levels[top]:g}, x {season.levels[0]:g}", season.aucs(first, top), season.aucs(first, 0))
        add(f"low-pass of the study, {self.low_band_Hz} Hz", season.aucs(first, top), self.low_band.aucs(first, top))
        add("every second gearbox, the others", season.aucs(first, top, slice(0, None, 2), slice(0, None, 2)),
            season.aucs(first, top, slice(1, None, 2), slice(1, None, 2)))
        add("path exponent above 0, below", season.aucs(first, top, healthy > 0, exponents > 0),
            season.aucs(first, top, healthy <= 0, exponents <= 0))
        return table(["conditions", "Kendall's tau", "first three under the first", "under the second"], rows)

    def second_seed(self):
        """Counts differences from the best that a second seed finds within the first one's interval."""
        inside = both = pairs = 0
        for name, *_ in self.faults:
            for level in range(len(self.season.levels)):
                best = int(np.argmax(self.areas[name, level].area))
                difference, deviation = self.areas[name, level].differences(best)
                other, other_deviation = self.again.aucs(name, level).differences(best)
                varied = (deviation > 0) & (other_deviation > 0)
                off = np.abs(difference - other)[varied]
                inside += int((off <= 1.96 * deviation[varied]).sum())
                both += int((off <= 1.96 * np.hypot(deviation, other_deviation)[varied]).sum())
                pairs += int(varied.sum())
        return (f"A second seed draws other gearboxes. Of {pairs} differences in AUC between the best indicator of a fault and another "
                f"one, {inside} ({percent(inside / pairs)} %) lie within the first seed's 95 % interval; 83 % are expected, "
                f"because both seeds scatter. {both} ({percent(both / pairs)} %) lie within the interval of the difference of both seeds; "
                "95 % are expected.")

    def cost_table(self):
        order = sorted(self.costs, key=lambda name: -self.costs[name])
        shown = [name for name in order if self.costs[name] >= 1.0]
        rest = len(order) - len(shown)
        return (table(["indicator", "processor ms per record and noise level"],
                      [[f"`{name}`", f"{self.costs[name]:.1f}"] for name in shown])
                + f"\n\nThe other {rest} take less than 1 ms more than `sensor_rms`. `own_` takes the same again for the baseline record.")

    def text(self, seconds):
        return "\n\n".join([
            f"`/usr/bin/python3 docs/tools/indicator_league.py build/gearpod league --healthy {self.counts()[0]} "
            f"--faulty {self.counts()[1]}` took {seconds:.0f} processor seconds.",
            "## Sample and thresholds", self.sample(),
            "## Best indicator of each fault, without and with a baseline", self.leaders(),
            f"## Detected shares, noise x {self.season.levels[self.loudest]:g}, false-alarm rate {self.rates[0]:g}, per cent",
            self.overall(), "## When the order changes", self.orders(),
            "## Check by a second seed", self.second_seed(), "## Cost", self.cost_table()])

    def draw(self, path):
        """Picture: indicators by faults, coloured by detected share; a frame marks those that are not
        distinguishable from the best of the fault."""
        import matplotlib
        matplotlib.use("Agg")
        matplotlib.rcParams["svg.hashsalt"] = "league"
        import matplotlib.pyplot as plt
        column = {name: i for i, name in enumerate(self.names)}
        alike = np.array([self.areas[fault[0], self.loudest].indistinguishable_from_best() for fault in self.faults])
        bases = sorted({self.base(name) for name in self.names},
                       key=lambda base: -max(self.shares[:, i].mean() for n, i in column.items() if self.base(n) == base))
        columns = [(f, kind) for f in range(len(self.faults)) for kind in KINDS]
        grid = np.full((len(bases), len(columns)), np.nan)
        figure, axes = plt.subplots(figsize=(16.5, 23.4))
        for r, base in enumerate(bases):
            for c, (f, kind) in enumerate(columns):
                names = {"record": [base], "own_": ["own_" + base], "change_": ["change_" + base, "baseline_" + base]}[kind]
                for i in (column[name] for name in names if name in column):
                    grid[r, c] = 100 * self.shares[f, i]
                    low, high = 100 * self.bounds[f, :, i]
                    axes.text(c, r, f"{grid[r, c]:.0f}\n{low:.0f}-{high:.0f}", ha="center", va="center", fontsize=7,
                              color="white" if grid[r, c] > 55 else "black")
                    if alike[f, i]:
                        axes.add_patch(plt.Rectangle((c - 0.46, r - 0.46), 0.92, 0.92, fill=False, edgecolor="#d55e00", linewidth=2))
        image = axes.imshow(grid, cmap="YlGnBu", vmin=0, vmax=100, aspect="auto")
        axes.set_yticks(range(len(bases)), bases)
        axes.set_xticks(range(len(columns)), ["record", "ratio", "change"] * len(self.faults), rotation=90)
        axes.xaxis.tick_top()
        for f, fault in enumerate(self.faults):
            axes.text(3 * f + 1, -2.4, textwrap.fill(fault[1], 22), ha="center", va="bottom", fontsize=9)
            axes.axvline(3 * f - 0.5, color="black", linewidth=1.2)
        figure.colorbar(image, ax=axes, label="detected faults, %", shrink=0.4, pad=0.01)
        figure.text(0.08, 0.035, textwrap.fill(
            f"Detected faults in % with 95 % intervals, at a false-alarm rate of {self.rates[0]:g} and noise x "
            f"{self.season.levels[self.loudest]:g}. record: one record against other gearboxes; ratio: record over its own baseline (own_); "
            "change: record less its own baseline (change_, baseline_). Orange: AUC not distinguishable from the best of the fault "
            f"(DeLong, Holm). {self.counts()[0]} healthy gearboxes, "
            f"{self.counts()[1]} with each fault. {self.season.conditions}", 190), fontsize=9)
        figure.subplots_adjust(left=0.15, right=0.98, top=0.9, bottom=0.07)
        figure.savefig(path, metadata={"Date": None})

    @staticmethod
    def base(name):
        for start in BASELINE:
            name = name.removeprefix(start)
        return name
