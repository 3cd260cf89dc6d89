"""REXS models for tests, written attribute by attribute so that tests can change any of them."""

from xml.sax.saxutils import escape


class Model:
    def __init__(self):
        self.version, self.load_spectrum, self.prologue = "1.4", "", ""
        self.types, self.attributes = {}, {}  # by component id; an attribute is (unit, text)
        self.relations = []  # type and component ids by role

    def add(self, name, kind, **attributes):
        self.types[name] = kind
        for key, value in attributes.items():
            self.set(name, key, *value)

    def set(self, name, key, unit, text):
        self.attributes.setdefault(name, {})[key] = unit, text

    def relate(self, kind, **parts):
        self.relations.append((kind, parts))

    def text(self):
        lines = ['<?xml version="1.0" encoding="UTF-8"?>', self.prologue, f'<model version="{self.version}">', "<relations>"]
        for number, (kind, parts) in enumerate(self.relations):
            refs = "".join(f'<ref id="{name}" role="{role}"/>' for role, name in parts.items())
            lines.append(f'<relation id="{number}" type="{kind}">{refs}</relation>')
        lines += ["</relations>", "<components>"]
        for name, kind in sorted(self.types.items()):
            lines.append(f'<component id="{name}" type="{kind}">')
            lines += [f'<attribute id="{key}" unit="{unit}">{escape(str(text))}</attribute>'
                      for key, (unit, text) in sorted(self.attributes.get(name, {}).items())]
            lines.append("</component>")
        return "\n".join(lines + ["</components>", self.load_spectrum, "</model>", ""])

    def add_gear(self, name, kind, shaft, teeth, module_mm):
        self.add(name, kind, number_of_teeth=("none", teeth), normal_module=("mm", module_mm), face_width=("mm", 20),
                 normal_pressure_angle=("deg", 20))
        self.relate("assembly", assembly=shaft, part=name)
        self.relate("reference", origin=name, referenced=90)

    def load(self, shaft, speed_rpm, torque_N_m):
        self.set(shaft, "rotational_speed", "1 / min", speed_rpm)
        self.add(80, "external_load", torque_around_u_axis=("N m", torque_N_m), defines_torque=("none", "true"))
        self.relate("assembly", assembly=shaft, part=80)


def planetary():
    """20/28/76 teeth, three planets. Ids: stage 1, sun 10, ring 11, planets 21 to 23, their pairs with the sun 31 to 33
    and with the ring 41 to 43, shafts of sun 50, ring 51 and carrier 52, planets 61 to 63, pins 71 to 73, load 80,
    steel 90, bearings 101 to 103, casing 2."""
    model = Model()
    model.add(1, "planetary_stage")
    model.add(2, "gear_casing")
    for shaft in (50, 51, 52, 61, 62, 63, 71, 72, 73):
        model.add(shaft, "shaft")
    model.add(90, "material", elastic_modulus=("N / mm^2", 210000), poisson_ratio=("none", 0.29))
    model.add_gear(10, "cylindrical_gear", 50, 20, 2)
    model.add_gear(11, "ring_gear", 51, 76, 2)
    for shaft in (50, 51):
        model.relate("central_shaft", planetary_stage=1, shaft=shaft)
    model.relate("planet_carrier_shaft", planetary_stage=1, shaft=52)
    for i in (1, 2, 3):
        model.add_gear(20 + i, "cylindrical_gear", 60 + i, 28, 2)
        for pair, gear_1, gear_2 in ((30 + i, 10, 20 + i), (40 + i, 20 + i, 11)):
            model.add(pair, "cylindrical_stage", center_distance=("mm", 48),
                      rotating_angle_around_neg_u_axis=("deg", 120 * i))
            model.relate("assembly", assembly=1, part=pair)
            model.relate("stage", stage=pair, gear_1=gear_1, gear_2=gear_2)
        model.add(100 + i, "concept_bearing", radial_stiffness=("N / m", 2.5e8))
        model.relate("side", outer_part=60 + i, inner_part=70 + i, assembly=100 + i)
        model.relate("planet_shaft", planetary_stage=1, shaft=60 + i)
    model.load(50, 1500, 30.5)
    model.set(50, "defines_speed", "none", "true")
    return model


def two_pairs():
    """Ids: stages 1 (gears 10 and 11, 23 to 67 teeth) and 2 (gears 12 and 13, 20 to 76 teeth), shafts 50 to 52, load 80,
    steel 90."""
    model = Model()
    for shaft in (50, 51, 52):
        model.add(shaft, "shaft")
    model.add(90, "material", elastic_modulus=("N / mm^2", 206000))
    for name, shaft, teeth, module_mm in ((10, 50, 23, 1), (11, 51, 67, 1), (12, 51, 20, 1.5), (13, 52, 76, 1.5)):
        model.add_gear(name, "cylindrical_gear", shaft, teeth, module_mm)
    model.set(10, "helix_angle_reference_diameter", "deg", 30)
    model.set(11, "helix_angle_reference_diameter", "deg", -30)
    for stage, distance in ((1, 53), (2, 72)):
        model.add(stage, "cylindrical_stage", center_distance=("mm", distance))
        model.relate("stage", stage=stage, gear_1=8 + 2 * stage, gear_2=9 + 2 * stage)
    model.load(50, 1400, 4.7)
    return model


def gear_set(sun, planet, ring, planets=3, module=1, helix=0, centre_distance=None, face_width=None, sun_shift=None,
             planet_shift=None, ring_shift=None):
    """Model with the values of a datasheet. The ring's teeth and helix are negative, as some programs write them."""
    model = Model()
    model.add(1, "planetary_stage")
    for shaft in (50, 51, 52, 60):
        model.add(shaft, "shaft")
    model.relate("planet_carrier_shaft", planetary_stage=1, shaft=52)

    def gear(name, kind, shaft, teeth, shift, sign=1):
        model.add(name, kind, number_of_teeth=("none", sign * teeth), normal_module=("mm", module),
                  normal_pressure_angle=("deg", 20), helix_angle_reference_diameter=("deg", sign * helix),
                  addendum_modification_coefficient=("none", "" if shift is None else shift),
                  face_width=("mm", "" if face_width is None else face_width))
        model.relate("assembly", assembly=shaft, part=name)

    gear(10, "cylindrical_gear", 50, sun, sun_shift)
    gear(11, "ring_gear", 51, ring, ring_shift, -1)
    for i in range(1, planets + 1):
        gear(100 + i, "cylindrical_gear", 60, planet, planet_shift)
        for pair, gear_1, gear_2 in ((200 + i, 10, 100 + i), (300 + i, 100 + i, 11)):
            model.add(pair, "cylindrical_stage",
                      center_distance=("mm", "" if centre_distance is None else centre_distance))
            model.relate("assembly", assembly=1, part=pair)
            model.relate("stage", stage=pair, gear_1=gear_1, gear_2=gear_2)
    return model
