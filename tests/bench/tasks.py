#!/usr/bin/python3
"""Time of a new user's tasks: runs tests/tasks/user_tasks.sh, which checks their results.

    tests/bench/tasks.py [--small] [--build build] [--json FILE]

--small takes a few gearboxes of each study.
"""
import re

from measuring import arguments, finished, parsed, show, table

COMMANDS = {
    "datasheet_to_pod": "`new planetary`, `run`, `report --html`",
    "record_length_and_interval": "`run --set sensor.record_s=10 --set detection.record_interval_h=24`",
    "one_false_alarm_a_year": "`describe --full --set detection.false_alarms_per_1000_h=0.114`",
    "compare_two_sensors": "`run`, `run --set`, `compare --html`",
    "signals_in_python": '`gearpod.open("a.h5").signals(3)`',
    "own_feature": "`tests/tasks/own_feature.py`",
    "recording_in_g": "`features recording.csv --sensor-unit g`",
    "own_csv_with_tachometer": "`features tachometer.csv --tachometer`",
    "pdf_for_a_manager": "`report --pdf`",
    "sweep": "`sweep --vary`, three points",
    "more_gearboxes": "`run --resume --instances 7000`",
    "array_of_jobs": "`run --part 1/2`, `2/2`, `merge`",
    "published_figure": "`python3 -m gearpod.published liang-fig-5-8`",
}


def main() -> None:
    parser = arguments(__doc__, 1)
    parser.add_argument("--small", action="store_true")
    options = parsed(parser)
    text = finished(["tests/tasks/user_tasks.sh", options.program, "."] + ["small"] * options.small).output
    found = re.findall(r"^(\w+) +([\d.]+) s, of processors +([\d.]+) s$", text, re.MULTILINE)
    rows = [[name.replace("_", " "), COMMANDS[name], float(wall), float(busy)] for name, wall, busy in found]
    show({"tables": [table(["task", "commands", "s", "processor s"], rows)], "ratios": {}}, options)


if __name__ == "__main__":
    main()
