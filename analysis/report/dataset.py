"""Dataset of results for machine learning: features with labels, severity and identity of the gearbox,
split by gearbox (CSV), stored signals (CSV) and a data card (Markdown)."""

import collections
import math

import h5py
from tables import csv_text
from words import printable

SPLITS = ("train", "validation", "test")
GROUPS = ("threshold", "graded", "neither")
NA4 = ("na4 compares with the mean of the first eight gearboxes of the threshold sample, which are in any "
       "split.")


def number(value):
    """Shortest text of a number; empty if it is not finite."""
    return (repr(float(value)).removesuffix(".0") if math.isfinite(value) else "")


class Dataset:
    """Rows of a results file. `report`: its JSON with the identity of each row under "dataset"."""

    def __init__(self, report, file):
        self.report, self.file, self.source = report, file, report["dataset"]
        self.recorded = self.source["recorded"]
        self.size = report["detection"]["size"]["name"]
        self.inputs = [entry["name"] for entry in self.source["inputs"]]
        self.features = [entry["name"] for entry in report["features"]]
        self.noise = [number(level) for level in file["noise_levels"][()]]
        self.variants = list(file.get("variants", ()))
        self.columns = self._columns()
        self.lines = {split: [] for split in SPLITS}
        self.gearboxes = {split: {} for split in SPLITS}  # of each, whether a record has the fault
        self.records = collections.Counter()
        self.failed = 0
        self._read()

    def _columns(self):
        """Name, role, unit and meaning of each column."""
        columns = [
            ("row", "identity", "1", "row of the results file" if self.recorded else
             "row in the results of the whole study, as in `simulate --instance`"),
            ("gearbox", "identity", "", "specimen; all its rows are in one split"),
            ("group", "identity", "", "threshold: sets thresholds in reports, graded: test gearbox, "
                                      "neither: of unknown state"),
            ("record", "identity", "1", "number of the record of this gearbox, from 0"),
            ("sensor", "condition", "", "accelerometer; transmission error is the same for all"),
            ("noise_level", "condition", "1", "factor on the noise of accelerometer and encoders")]
        if "other_fault" in self.variants:
            columns.append(("other_fault", "condition", "1",
                            "1: the record has the study's faulty bearing in addition"))
        columns.append(("faulty", "label", "1", "1: the gear has the fault, 0: healthy"))

        def add(name, *rest):
            while name in (column[0] for column in columns):
                name = "results_" + name
            columns.append((name, *rest))

        for entry in self.source["inputs"]:
            severe = entry["name"] == self.size
            add(entry["name"], "severity" if severe else "input", entry["unit"],
                "size of the fault, 0: healthy" if severe else entry["meaning"])
        for feature in self.report["features"]:
            add(feature["name"], "feature", feature["unit"],
                f"{feature['title']} ({feature['doc']})" if feature["doc"] else "feature in Python")
        return columns

    def _read(self):
        instances = self.file["instances"]
        status, group = self.file["status"][()], instances["group"][()]
        inputs = [instances[name][()] for name in self.inputs]
        groups = [("first", self.file["features"])] + [(name, self.file["variants"][name])
                                                      for name in self.variants]
        sensors = [("first" if name == "other_fault" else name.removeprefix("sensor_"), name == "other_fault",
                    [features[feature][()] for feature in self.features]) for name, features in groups]
        sizes = instances[self.size][()] if self.size in self.inputs else [0.0] * len(status)
        for place, (row, gearbox, record, split) in enumerate(self.source["rows"]):
            if status[place] != 0:
                self.failed += 1
                continue
            kind = GROUPS[group[place]]
            faulty = kind == "graded" and (self.recorded or sizes[place] > 0)
            self.gearboxes[split][gearbox] = faulty or self.gearboxes[split].get(gearbox, False)
            self.records[split] += 1
            values = [number(column[place]) for column in inputs]
            for sensor, bearing, features in sensors:
                if bearing and kind != "threshold":
                    continue
                for n, level in enumerate(self.noise):
                    self.lines[split].append(
                        [row, gearbox, kind, record, sensor, level]
                        + ([int(bearing)] if "other_fault" in self.variants else [])
                        + ["" if kind == "neither" else int(faulty)] + values
                        + [number(column[place, n]) for column in features])

    def signals(self):
        """Name and text of the stored signals of each row."""
        for place, group in self.file.get("signals", {}).items():
            head = [f"{name} [{column.attrs['unit']}]" for name, column in group.items()]
            lines = zip(*(column[()] for column in group.values()))
            yield (f"signals_{self.source['rows'][int(place)][0]}.csv",
                   csv_text([head, *([f"{value:.17g}" for value in line] for line in lines)]))

    def card(self, signals):
        provenance = self.report["provenance"]
        source = {"study": (self.report["title"] or "without a title") + " (study.toml)",
                  "conditions": self.report["assumptions"], "fault": self.report["fault"],
                  "results computed by": self.source["computed_by"],
                  "dataset written by": self.source["written_by"],
                  "seed": provenance.get("seed"), "part of the study": provenance.get("part"),
                  "state of the run": provenance.get("state")}
        splits = [(f"{split}.csv", len(self.gearboxes[split]), sum(self.gearboxes[split].values()),
                   self.records[split]) for split in SPLITS]
        recorded = self.recorded
        limits = [
            signals and f"Signals of {signals} rows are in signals_ROW.csv.",
            "The dataset has no signals; they are in the recordings." if recorded else
            "Other signals are not included: `gearpod simulate study.toml --instance ROW --out FILE.h5` "
            "computes those of a row, bit for bit.",
            f"Columns with the role `input` are known to the "
            f"{'list of recordings' if recorded else 'simulation'}; a monitor may not know them.",
            "Rows of one gearbox are not independent: noise levels scale the same noise.",
            "Baseline records are contained in the features own_..., change_... and baseline_correlation "
            "only.",
            self.failed and f"{self.failed} records failed and are left out.",
            not recorded and any(name.endswith("na4") for name in self.features) and NA4,
            "Labels and sizes are those of the list of recordings." if recorded else
            "No gearbox was measured. Values hold for the study's gearboxes and assumptions, and for one "
            "kind of fault.",
            "A gearbox is seen once or a few times, not while its fault grows."]
        return f"""# Dataset of gearpod

Features of {'recordings' if recorded else 'simulated gearboxes'} with labels, for machine learning.

## Source

{markdown(('entry', 'value'), [entry for entry in source.items() if entry[1]])}
## Splits

Each file holds whole gearboxes: every record, noise level and sensor of a gearbox. {
    'The name of the gearbox decides.' if recorded else
    'The seed and the number of the gearbox decide, so that a larger ensemble keeps the splits.'
} A line is one record at one noise level and one sensor.

{markdown(('file', 'gearboxes', 'of these with a fault', 'records'), splits)}
## Columns

All numbers are in SI units; an empty field has no value. columns.csv holds this table.

{markdown(('column', 'role', 'unit', 'meaning'), self.columns)}
## Limits

""" + "".join(f"- {limit}\n" for limit in limits if limit)


def markdown(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "".join("| " + " | ".join(printable(str(cell)) for cell in line) + " |\n" for line in lines)


def files(report):
    """Name and text of each file of the dataset."""
    with h5py.File(report["dataset"]["file"]) as file:
        dataset = Dataset(report, file)
        signals = dict(dataset.signals())
    names = [column[0] for column in dataset.columns]
    provenance = report["provenance"]
    study = provenance.get("measured_by_study" if dataset.recorded else "study", "")
    return {"README.md": dataset.card(len(signals)),
            **{f"{split}.csv": csv_text([names] + dataset.lines[split]) for split in SPLITS},
            "columns.csv": csv_text([("column", "role", "unit", "meaning"), *dataset.columns]),
            "study.toml": "# Study of a dataset, with all defaults\n" + study, **signals}
