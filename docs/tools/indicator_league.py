"""League of indicators: which of them finds which fault in the same random gearboxes.

    indicator_league.py PROGRAM OUT [--healthy N] [--faulty N] [--seeds A,B] [--page FILE] [--picture FILE]

Runs studies/indicator-league.toml with each fault, with another band and with a second seed, measures
the processor time of each indicator, and writes the generated part of the page (Markdown) and the
picture (SVG). Results in the folder OUT are continued. Needs numpy, scipy, h5py, matplotlib.
"""

import argparse
import json
import pathlib
import re
import resource
import subprocess
import sys

import numpy as np

SOURCES = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(SOURCES / "analysis" / "python"), str(SOURCES / "docs" / "tools")]
import gearpod  # noqa: E402
import league_statistics as statistics  # noqa: E402
import league_tables as tables  # noqa: E402

STUDY = SOURCES / "studies" / "indicator-league.toml"
BEGIN, END = "<!-- generated: begin -->", "<!-- generated: end -->"
RATES = (0.05, 0.01, 0.001)
LOW_BAND_HZ = 400
CRACK = 'kind = "crack"\n{}\ndepth_mm = 0\nangle_deg = 45\ncrack_law = "fracture-mechanics"\n'
PLANET = 'member = "planet"\nside = "ring"\nplanet = 1'
PITS = 'kind = "pitting"\n{}\npit_width_mm = 0\npit_length_mm = 2\npit_radius_mm = {}\npit_depth_mm = 0.5\n'
SPATIAL = ('kind = "spatial-crack"\n' + PLANET + '\nstage = 0\ngrowth_depth_mm = [1.5, 3, 3]\n'
           'growth_end_depth_mm = [0, 0, 3]\ngrowth_length_mm = [19.05, 38.1, 38.1]\n'
           'growth_height_mm = [0, 0, 0]\ngrowth_end_height_mm = [0, 0, 0]\nangle_deg = 45\n'
           'end_angle_deg = 45\ncrack_law = "fracture-mechanics"\n')
# Name, words, section [fault], random size.
FAULTS = (
    ("planet-crack", "crack of a planet tooth, 1, 2, 3 mm", CRACK.format(PLANET), "depth_mm", [1, 2, 3]),
    ("sun-crack", "crack of a sun tooth, 1, 2, 3 mm", CRACK.format('member = "sun"'), "depth_mm", [1, 2, 3]),
    ("ring-crack", "crack of a ring tooth, 1, 2, 3 mm", CRACK.format('member = "ring"'), "depth_mm", [1, 2, 3]),
    ("spatial-crack", "crack of a planet tooth from one end face, stages 1, 2, 3", SPATIAL, "stage", [1, 2, 3]),
    ("chip", "chipped planet tooth, 8, 16, 24 mm wide", 'kind = "chip"\n' + PLANET + "\nchip_mm = 0\n",
     "chip_mm", [8, 16, 24]),
    ("pitting", "pits on a planet tooth, 12, 24, 36 mm wide", PITS.format(PLANET, 40), "pit_width_mm", [12, 24, 36]),
    ("sun-pitted", "pits on 12 neighbouring sun teeth, 12, 24, 36 mm wide", PITS.format('member = "sun"\nteeth = 12', 48),
     "pit_width_mm", [12, 24, 36]),
    ("worn-sun", "worn flanks of all sun teeth, 5, 10, 20 um", 'kind = "wear"\nmember = "sun"\nwear_um = 0\n',
     "wear_um", [5, 10, 20]),
)

# Faults whose healthy gearboxes are integrated too: a step ends at each edge of the pits, and at the pitch
# point of worn flanks, so that the same healthy gearboxes differ by the error of the steps.
OWN_HEALTHY = ("pitting", "sun-pitted", "worn-sun")


def study_of(fault):
    """Text of the study with a fault."""
    _, _, section, key, sizes = fault
    text = re.sub(r"\[fault\]\n.*?\n\n", "[fault]\n" + section + "\n", STUDY.read_text(encoding="utf-8"), flags=re.S)
    return re.sub(r"^fault\.depth_mm = .*$", f'fault.{key} = {{ distribution = "levels", values = {sizes} }}', text,
                  flags=re.M)


class Runs:
    """Runs of the program in a folder, with the processor seconds of each, which the folder keeps."""

    def __init__(self, program, folder):
        self.program, self.folder = program, folder
        folder.mkdir(parents=True, exist_ok=True)
        self.kept = folder / "processor-seconds.json"
        self.seconds = json.loads(self.kept.read_text(encoding="utf-8")) if self.kept.exists() else {}

    def run(self, name, text, options):
        """Path of the results of a study; finished results are used again."""
        study, results = self.folder / f"{name}.toml", self.folder / f"{name}.h5"
        study.write_text(text, encoding="utf-8")
        command = [str(self.program), "run", str(study), "--out", str(results), "--quiet", *options]
        if results.exists() or results.with_suffix(".h5.part").exists():
            command.append("--resume")
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        ended = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        if ended.returncode != 0:
            sys.exit(f"{' '.join(command)}\n{ended.stdout}")
        print(f"{name}: {seconds:.0f} processor seconds", flush=True)
        self.seconds[name] = self.seconds.get(name, 0.0) + seconds
        self.kept.write_text(json.dumps(self.seconds), encoding="utf-8")
        return results


def oriented(results, group):
    """Values, gearboxes x indicators x noise levels, larger towards the alarm. No value: no alarm."""
    rows = results.rows(group)
    values = np.stack([results.feature(name)[rows] * (1.0 if results.alarms[name] == "high" else -1.0)
                       for name in results.features], axis=1)
    return np.where(np.isnan(values), -np.inf, values)


class Season:
    """Healthy gearboxes and those with each fault, of one seed and band."""

    def __init__(self, runs, seed, arguments, faults, name="", options=()):
        self.values, self.exponents, self.healthy = {}, {}, {}
        for number, fault in enumerate(faults):
            measured = number == 0 or fault[0] in OWN_HEALTHY
            healthy = arguments.healthy if measured else min(16, arguments.healthy)
            path = runs.run(f"{fault[0]}-{seed}{name}", study_of(fault),
                               ["--seed", str(seed), "--instances", str(arguments.faulty),
                                "--set", f"ensemble.threshold_instances={healthy}", *options])
            results = gearpod.open(path)
            if number == 0:
                self.names, self.levels = results.features, results.noise_levels
                self.healthy_exponents = results.input("path_exponent")[results.rows("threshold")]
                self.conditions = results.report()["assumptions"]
            values = oriented(results, "threshold")
            self.healthy[fault[0]] = values if measured else self.healthy[faults[0][0]]
            if not np.array_equal(values, self.healthy[fault[0]][:healthy]):
                sys.exit(f"{path}: its healthy gearboxes differ from those of {faults[0][0]}")
            self.values[fault[0]] = oriented(results, "graded")
            self.exponents[fault[0]] = results.input("path_exponent")[results.rows("graded")]

    def aucs(self, fault, level, healthy=slice(None), faulty=slice(None)):
        return statistics.delong(self.healthy[fault][healthy, :, level], self.values[fault][faulty, :, level])


def costs(runs, names):
    """Processor milliseconds of each indicator, per record and noise level: a run with this indicator
    at many noise levels less a run with sensor_rms."""
    levels, gearboxes = 20, 17
    options = ["--instances", "16", "--set", "ensemble.threshold_instances=1",
               "--set", f"sensor.noise_levels={[1 + 0.01 * n for n in range(levels)]}"]
    used = r"use = \[.*?\]\nbaseline_torque_scatter = .*?\n"
    seconds_of = {}
    for name in ["sensor_rms"] + [name for name in names if not name.startswith(("own_", "change_", "baseline_"))]:
        text = re.sub(used, f'use = ["{name}"]\n', study_of(FAULTS[0]), flags=re.S)
        if f"cost-{name}" not in runs.seconds:
            runs.run(f"cost-{name}", text, options)
        seconds_of[name] = runs.seconds[f"cost-{name}"]
    return {name: 1000 * max(0.0, seconds - seconds_of["sensor_rms"]) / (levels * gearboxes) for name, seconds in seconds_of.items()}


def write_page(path, text):
    """Replaces the generated part of the page."""
    page = path.read_text(encoding="utf-8")
    head, rest = page.split(BEGIN)
    path.write_text(head + BEGIN + "\n\n" + text + "\n" + END + rest.split(END)[1], encoding="utf-8")


def main(words=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--healthy", type=int, default=1008)
    parser.add_argument("--faulty", type=int, default=192)
    parser.add_argument("--seeds", default="51,52", help="the second one checks the intervals of the first")
    parser.add_argument("--page", type=pathlib.Path, default=SOURCES / "docs" / "validation" / "indicator-league.md")
    parser.add_argument("--picture", type=pathlib.Path, default=SOURCES / "docs" / "_static" / "indicator-league.svg")
    arguments = parser.parse_args(words)
    if statistics.threshold_rank(arguments.healthy, RATES[0]) is None:
        parser.error(f"--healthy {arguments.healthy}: too few for a false-alarm rate of {RATES[0]:g}; at least 19 are needed")
    if not arguments.page.exists() or BEGIN not in arguments.page.read_text(encoding="utf-8"):
        parser.error(f"--page {arguments.page}: no page with the lines {BEGIN} and {END}")
    runs = Runs(arguments.program.resolve(), arguments.out.resolve())
    first, second = (int(seed) for seed in arguments.seeds.split(","))
    season = Season(runs, first, arguments, FAULTS)
    again = Season(runs, second, arguments, FAULTS)
    low_band = Season(runs, first, arguments, FAULTS[:1], "-low-band",
                      ["--set", f"sensor.low_pass_Hz={LOW_BAND_HZ}"])
    league = tables.League(season, again, low_band, LOW_BAND_HZ, FAULTS, RATES, costs(runs, season.names))
    write_page(arguments.page, league.text(sum(runs.seconds.values())))
    league.draw(arguments.picture)


if __name__ == "__main__":
    main()
