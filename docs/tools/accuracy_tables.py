"""Prints the tables of docs/validation/work-precision.md: accuracy_tables.py JSON...

Each file is the output of `gearpod accuracy STUDY --json FILE`.
"""

import json
import math
import sys


def number(value, digits=2):
    return "-" if value is None else f"{value:.{digits}g}"


def time_text(seconds):
    return f"{1e3 * seconds:.3g} ms"


def detection_text(setting):
    detection = setting.get("detection")
    if detection is None:
        return "-"
    return f"{detection['pd_change']:.2g} (± {detection['pd_half_width']:.2g})"


def worst_text(errors):
    if not errors["worst_feature"]:
        return "0"
    worst = max(errors["features"], key=lambda name: errors["features"][name] or 0.0)
    return f"{number(errors['worst_feature'])}, `{worst}`"


def shown_settings(report):
    """The study's own setting, and the fastest one of the frontier in each decade of the error."""
    fastest = {}
    for setting in report["settings"]:
        if "refused" in setting or not setting["error"]["worst_feature"]:
            continue
        decade = math.floor(math.log10(setting["error"]["worst_feature"]))
        if setting["frontier"] and (decade not in fastest or
                                    setting["gearbox_s"] < fastest[decade]["gearbox_s"]):
            fastest[decade] = setting
    chosen = list(fastest.values())
    chosen += [setting for setting in report["settings"]
               if setting["name"] == report["own"] and "refused" not in setting
               and setting not in chosen]
    return sorted(chosen, key=lambda setting: setting["gearbox_s"])


def print_frontier(report):
    print("| setting | time of a gearbox | sensor | worst feature | over its scatter "
          "| change of Pd |")
    print("| --- | --- | --- | --- | --- | --- |")
    for setting in shown_settings(report):
        error = setting["error"]
        mark = " (the study's own)" if setting["name"] == report["own"] else ""
        print(f"| {setting['name']}{mark} | {time_text(setting['gearbox_s'])} "
              f"| {number(error['sensor'])} "
              f"| {worst_text(error)} "
              f"| {number(error['worst_of_scatter'])} | {detection_text(setting)} |")
    print()


def print_effects(report):
    print("| effect | in the study | time | sensor signal | largest change of a feature "
          "| over its scatter | needed |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for effect in report.get("effects", []):
        inside = "yes" if effect["in_study"] else "no"
        if "refused" in effect:
            print(f"| {effect['effect']} | {inside} | not measured: {effect['refused']} | | | | |")
            continue
        change = effect["change"]
        print(f"| {effect['effect']} | {inside} | {number(effect['time_ratio'], 3)} "
              f"| {number(change['sensor'])} "
              f"| {worst_text(change)} "
              f"| {number(change['worst_of_scatter'])} "
              f"| {'yes' if effect['needed'] else 'no'} |")
    print()


def main():
    for path in sys.argv[1:]:
        with open(path, encoding="utf-8") as file:
            report = json.load(file)
        print(f"## {report['title']}\n\n{report['headline']}\n")
        print_frontier(report)
        print_effects(report)
        for left_out in report["left_out"]:
            print(f"Left out: {left_out}")
        print()


if __name__ == "__main__":
    main()
