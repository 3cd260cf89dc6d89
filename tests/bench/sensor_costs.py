#!/usr/bin/python3
"""What each sensor, each part of the background and a stage cost: whole runs on one thread.

    tests/bench/sensor_costs.py [--rounds 5] [--instances 64] [--study studies/planet-crack-ideal.toml]
                                [--build build] [--shafts] [--json FILE]

A round runs the study without any of them, then with each, in turn. Ratios are processor time over that
of the same round's study without any. With --shafts, for
studies that integrate every mesh period, it measures stages with and without an elastic shaft.
"""
import statistics
import tempfile

from measuring import arguments, number, parsed, processor_s, ratio, show, table

BEARING = ('sensor.bearings=[{fault="inner", shaft="sun", elements=9, diameter_ratio=0.2, '
           'amplitude_m_s2=2, resonance_Hz=600, role="%s"}]')
STAGE = ('sensor.stages=[{name="first", study="studies/first-stage.toml", shaft="sun", '
         'stage_shaft="carrier", gain=0.3, role="%s"%s}]')
ADDED = {
    "two tones": ['sensor.tones=[{frequency_Hz=50, amplitude_m_s2=0.1}, '
                  '{shaft="sun", order=2, amplitude_m_s2=0.1}]'],
    "an additional sensor": ['sensor.additional=[{name="side", angle_deg=90}]'],
    "three additional sensors": ['sensor.additional=[{name="a", angle_deg=90}, '
                                 '{name="b", angle_deg=180}, {name="c", angle_deg=270}]'],
    "two modes of the housing": ["sensor.housing_modes=[{frequency_Hz=240, damping=0.03, "
                                 "participation=1}, {frequency_Hz=520, damping=0.02, participation=1}]"],
    "two modes of the housing and one of the ring": ["sensor.housing_modes=[{frequency_Hz=240, damping=0.03, "
                               "participation=1}, {frequency_Hz=520, damping=0.02, participation=1, "
                               "nodal_diameters=2}]"],
    "two modes of the housing, with forces in two bearings": ["sensor.housing_modes=[{frequency_Hz=240, damping=0.03, "
                                   "participation=1, sun_bearing_per_kg=0.02, carrier_bearing_per_kg=0.01}, "
                                   "{frequency_Hz=520, damping=0.02, participation=1}]"],
    "a measured response": ["sensor.response_Hz=[1, 1000]", "sensor.response_gain=[1, 2]",
                            "sensor.response_phase_deg=[0, 90]"],
    "a bearing in the background": [BEARING % "background"],
    "a bearing as another fault, in the healthy half": [BEARING % "other_fault"],
    "a neighbouring stage": [STAGE % ("background", "")],
    "a neighbouring stage as another fault": [STAGE % ("other_fault", "")],
    "a background by its spectrum": ["sensor.background_Hz=[20, 1000]",
                                     "sensor.background_density_m_s2_per_sqrt_Hz=[0.01, 0.001]"],
}

DOUBLE = 'numerics.precision="double"'
ELASTIC = ", shaft_stiffness_N_m_rad=1.2e4"
SHAFTS = {
    "double precision": [DOUBLE],
    "a neighbouring stage": [STAGE % ("background", "")],
    "a neighbouring stage as another fault": [STAGE % ("other_fault", "")],
    "a stage with an elastic shaft": [DOUBLE, STAGE % ("background", ELASTIC)],
    "a stage with an elastic shaft as another fault": [DOUBLE, STAGE % ("other_fault", ELASTIC)],
}


def main() -> None:
    parser = arguments(__doc__, 5)
    parser.add_argument("--instances", type=int, default=64)
    parser.add_argument("--study", default="studies/planet-crack-ideal.toml")
    parser.add_argument("--shafts", action="store_true", help="stages with and without elastic shafts only")
    options = parsed(parser)
    parts = SHAFTS if options.shafts else ADDED
    values: dict[str, list[float]] = {name: [] for name in parts}
    alone = []
    with tempfile.TemporaryDirectory() as folder:
        command = [options.program, "run", options.study, "--quiet", "--force",
                   "--out", folder + "/r.h5", "--instances", str(options.instances),
                   "--set", f"ensemble.threshold_instances={options.instances}",
                   "--set", "numerics.threads=1"]
        for _ in range(options.rounds):
            alone.append(processor_s(command))
            for name, settings in parts.items():
                added = [text for setting in settings for text in ("--set", setting)]
                values[name].append(processor_s(command + added) / alone[-1])
    ratios = {name: ratio(ratios) for name, ratios in values.items()}
    rows = [["none", f"{number(500 * statistics.median(alone) / options.instances)} ms per gearbox"]]
    rows += [[name, one] for name, one in ratios.items()]
    show({"tables": [table(["part", "time over that without it"], rows)], "ratios": ratios}, options)


if __name__ == "__main__":
    main()
