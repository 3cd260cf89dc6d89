"""Reads a stage of a gear-unit model in REXS (www.rexs.info, versions 1.0 to 1.6) as a datasheet.

The program contains this file and starts it as a process for `gearpod new --rexs FILE`. The argument is the file.
Standard input is a JSON object with the options that choose a stage or replace values. Standard output is a JSON
object with the datasheet's values under the names of the program's structs, notes, names of the values for
messages, and problems. Only lxml is needed.
"""

# mypy: ignore-errors

import collections
import io
import itertools
import json
import math
import os
import re
import resource
import stat
import sys

LARGEST_FILE, MOST_TAGS, DEEPEST_NESTING = 64 << 20, 2_000_000, 16  # a matrix has seven levels
MOST_MEMORY, MOST_SECONDS = 4 << 30, 15
MOST_PROBLEMS, MOST_STAGES, MOST_PAIRS = 1000, 200, 200
NEWEST_VERSION = 6  # of 1.x
LAST_LINE = 65535  # libxml2 counts no further; a remainder of 0 is no line
BLANKS = " \t\r\n"
NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")

# Versions of REXS differ in the spelling.
SHIFTS = ("addendum_modification_coefficient", "profile_shift_coefficient")
SHIFTS_MM = ("addendum_modification", "profile_shift")
HELICES = ("helix_angle_reference_diameter", "helix_angle")
DISTANCES = ("center_distance", "centre_distance")
COUNTS = ("number_of_teeth", "number_of_planets")  # whole numbers

# Factors that convert the attributes to the first unit. Blanks in units do not matter. "mum" is REXS's micrometre.
UNITS = {name: units for names, units in (
    ((*SHIFTS, "number_of_teeth", "number_of_planets", "poisson_ratio"), {"none": 1.0, "": 1.0, "-": 1.0, "1": 1.0, "%": 0.01}),
    ((*SHIFTS_MM, *DISTANCES, "normal_module", "face_width", "common_face_width", "tip_diameter"),
     {"mm": 1.0, "m": 1e3, "mum": 1e-3, "um": 1e-3, "\u00b5m": 1e-3, "\u03bcm": 1e-3, "cm": 10.0, "dm": 100.0, "in": 25.4}),
    ((*HELICES, "normal_pressure_angle", "rotating_angle_around_neg_u_axis"),
     {"deg": 1.0, "\u00b0": 1.0, "rad": 180.0 / math.pi, "mrad": 0.18 / math.pi}),
    (("elastic_modulus",), {"N/mm^2": 1e6, "MPa": 1e6, "GPa": 1e9, "Pa": 1.0, "kPa": 1e3, "N/m^2": 1.0, "kN/mm^2": 1e9,
                            "N/mm\u00b2": 1e6, "N/m\u00b2": 1.0}),
    (("radial_stiffness",), {"N/m": 1.0, "N/mm": 1e3, "N/mum": 1e6, "N/um": 1e6, "kN/mm": 1e6, "kN/m": 1e3, "MN/m": 1e6}),
    (("rotational_speed",), {"1/min": 1.0, "rpm": 1.0, "U/min": 1.0, "rev/min": 1.0, "min^-1": 1.0, "1/s": 60.0, "Hz": 60.0,
                             "rad/s": 30.0 / math.pi}),
    (("torque_around_u_axis",), {"Nm": 1.0, "kNm": 1e3, "Nmm": 1e-3, "MNm": 1e6})) for name in names}

# By the study's keys: attributes that messages name, and texts of notes on values that a model lacks.
OF_STAGE = {"normal_module_mm": ("normal_module", ""), "module_mm": ("normal_module", ""),
            "pressure_angle_deg": ("normal_pressure_angle", "normal pressure angle (20 deg)"),
            "helix_angle_deg": (HELICES[0], "helix angle (0 deg)"), "face_width_mm": ("face_width", "face width"),
            "centre_distance_mm": (DISTANCES[0], "centre distance"), "young_modulus_Pa": ("elastic_modulus", "Young's modulus"),
            "poisson_ratio": ("poisson_ratio", "Poisson's ratio")}
OF_GEAR = {"teeth": "number_of_teeth", "shift": SHIFTS[0], "tip_mm": "tip_diameter"}

# Attributes that place a component in space or describe it to a user.
IGNORED = {"support_vector", "u_axis_vector", "v_axis_vector", "w_axis_vector", "reference_component_for_position",
           "u_coordinate_on_shaft", "u_coordinate_on_shaft_inner_side", "u_coordinate_on_shaft_outer_side", "display_color",
           "rotating_angle_around_neg_u_axis", "name"}


class Unusable(Exception):
    """Ends the reading of a model. The arguments state a last problem: what is wrong, the remedy and the line."""


class Attribute:
    def __init__(self, node):
        self.id, self.unit, self.used = node.get("id", ""), node.get("unit", "").strip(BLANKS), False
        self.line = node.sourceline % LAST_LINE
        array, matrix = (node.find(kind) is not None for kind in ("array", "matrix")) if len(node) else (False, False)
        self.scalar = not array and not matrix
        text = node.findtext("array[1]/c") if array else "matrix" if matrix else node.text  # the first value of an array counts
        self.text = (text or "").strip(BLANKS)
        value = float(self.text) if NUMBER.fullmatch(self.text) else math.inf
        self.value = value if math.isfinite(value) else None


class Component:
    def __init__(self, node, model):
        self.id, self.type, self.name = (node.get(key, "") for key in ("id", "type", "name"))
        self.label, self.line, self.considered, self.attributes = f"{self.type} {self.id}", node.sourceline % LAST_LINE, False, {}
        for new in map(Attribute, node.iterfind("attribute")):
            old = self.attributes.setdefault(new.id, new)
            if (old.text, old.unit) != (new.text, new.unit):
                model.problem(f"{self.label}: {new.id}", f"occurs twice, as {old.text} {old.unit} and as {new.text} {new.unit}",
                              "keep one of them", new.line)

    def find(self, *names):
        """Attribute with the first of these names that it has, used from now on; or None. Empty ones count as missing."""
        found = next((self.attributes[name] for name in names if name in self.attributes and self.attributes[name].text), None)
        if found:
            found.used = True
        return found


def content(path):
    """Bytes of a REXS file. Refuses other formats and files that are too large."""
    data, whole, smaller = b"", "name a REXS file (*.rexs)", "export the model without meshes and results"
    try:
        found = os.stat(path)
        if stat.S_ISREG(found.st_mode) and found.st_size <= LARGEST_FILE:
            with open(path, "rb") as opened:
                data = opened.read(LARGEST_FILE)
    except OSError as error:
        raise Unusable(f"cannot be read ({error.strerror})", "name an existing REXS file (*.rexs)") from error
    start = data.lstrip(BLANKS.encode() + b"\xef\xbb\xbf")
    for condition, *problem in (
            (stat.S_ISDIR(found.st_mode), "is a folder", whole),
            (not stat.S_ISREG(found.st_mode), "is a device, a pipe or a socket", whole),
            (found.st_size > LARGEST_FILE, f"has {found.st_size >> 20} MB; models of gear units with up to "
             f"{LARGEST_FILE >> 20} MB are read", smaller),
            (data.startswith(b"PK\x03\x04"), "is a ZIP archive (.rexsz); unpack it and name the .rexs file in it"),
            (data.startswith(b"\x1f\x8b"), "is compressed by gzip; unpack it"), (not start, "is empty"),
            (start[:1] == b"{", "is JSON; export the model as XML (.rexs)"),
            (data.count(b"<") > MOST_TAGS, f"has more than {MOST_TAGS} XML tags, too many for a gear unit", smaller)):
        if condition:
            raise Unusable(*problem)
    return data


def root_of(data):
    """Root element of a model, all names without namespaces. Refuses document type declarations (they define entities)
    and texts that are too deep."""
    from lxml import etree
    depth, root = 0, None
    try:
        for event, node in etree.iterparse(io.BytesIO(data), ("start", "end"), no_network=True, load_dtd=False,
                                           resolve_entities=False, huge_tree=False, remove_comments=True, remove_pis=True):
            root = node if root is None else root
            depth += 1 if event == "start" else -1
            if depth == 1 and root.getroottree().docinfo.internalDTD is not None:
                raise Unusable("has a document type declaration (DOCTYPE), which REXS does not have",
                               "remove it; entities that it defines are not expanded")
            if depth > DEEPEST_NESTING:
                raise Unusable(f"has elements nested more than {DEEPEST_NESTING} deep")
            if event == "end" and node.tag[0] == "{":
                node.tag = node.tag.rpartition("}")[2]
    except etree.XMLSyntaxError as error:
        first = next(iter(error.error_log.filter_from_errors()), None)
        what, line = (first.message, first.line) if first else (error.msg, 0)
        raise Unusable(f"is not well-formed XML ({what})", "", line) from error
    if root.tag != "model":
        raise Unusable(f"is XML, but not REXS: its root is <{root.tag}>", "a REXS file has the root <model>",
                       root.sourceline % LAST_LINE)
    return root


class Model:
    """Components with attributes, and relations between components, with the problems and notes that arise when they are read."""

    def __init__(self):
        self.problems, self.notices = [], []  # each as line, key, what is wrong, remedy
        self.notes, self.lacking, self.components, self.options = [], [], {}, {}
        # Relations, each as components by role: all by type, and by type, role and component.
        self.relations, self.index = collections.defaultdict(list), collections.defaultdict(list)

    def read(self, path):
        root = root_of(content(path))
        self.version, line = root.get("version", ""), root.sourceline % LAST_LINE
        known = re.fullmatch(r"1\.([0-9]{1,9})", self.version)
        if not known:
            self.problem("model", f"version {self.version} of REXS is not known" if self.version else "states no version",
                         "export the model in version 1.0 to 1.6", line)
        elif int(known[1]) > NEWEST_VERSION:
            self.notices.append((line, "model", f"version {self.version} is newer than 1.{NEWEST_VERSION}, the newest that "
                                 "this program knows", "attributes that were renamed since count as missing"))
        for new in (Component(node, self) for node in root.iterfind("components[1]/component")):
            if self.components.setdefault(new.id, new) is not new:
                self.problem(new.label, "the id occurs twice", "give every component its own id", new.line)
        for node in root.iterfind("relations[1]/relation"):
            kind, relation = node.get("type", ""), {}
            for role, name in ((ref.get("role", ""), ref.get("id", "")) for ref in node.iterfind("ref")):
                relation.setdefault(role, self.components.get(name))
                if name not in self.components:
                    self.problem(f"relation {kind}", f"component {name} ({role}) does not exist", "", node.sourceline % LAST_LINE)
            self.relations[kind].append(relation)
            for role, component in relation.items():
                self.index[kind, role, component].append(relation)
        self.load_cases = [(node.get("id", ""), [Component(child, self) for child in node.iterfind("component")])
                           for node in root.iterfind("load_spectrum/load_case")]
        if self.problems:
            raise Unusable

    def problem(self, key, what, remedy="", line=0):
        if len(self.problems) < MOST_PROBLEMS and (line, key, what, remedy) not in self.problems:
            self.problems.append((line, key, what, remedy))

    def reject(self, component, attribute, what, remedy=""):
        self.problem(f"{component.label}: {attribute}", what, remedy, (component.find(attribute) or component).line)

    def parts(self, kind, *roles):
        """Components with these roles in each relation of a type; None for those that it lacks."""
        return [[relation.get(role) for role in roles] for relation in self.relations[kind]]

    def related(self, kind, role, component, to):
        """Components with the role `to` in relations in which a component has the role `role`."""
        found = dict.fromkeys(relation.get(to) for relation in self.index[kind, role, component])
        return [part for part in found if part]

    def shaft_of(self, part):
        """Shaft that carries a gear, load or other part, in a list; [] if there is none."""
        return [whole for whole in self.related("assembly", "part", part, "assembly") if whole.type == "shaft"][:1]

    def number(self, component, *names):
        """Number of the first of these attributes that the component has, in the unit that the datasheet has; None
        if it has none. A value that is no finite number, or has another unit, is a problem."""
        attribute, units = component.find(*names), UNITS[names[0]]
        if attribute is None:
            return None
        value, factor = attribute.value if attribute.scalar else None, units.get(re.sub("[ \t]", "", attribute.unit))
        if value is None:
            self.reject(component, attribute.id, f"must be a number, but is {attribute.text}" if attribute.scalar
                        else "must be one number, but is an array")
        if factor is None:
            self.reject(component, attribute.id, f"unit {attribute.unit} is not known" if attribute.unit
                        else "states no unit", "the units known here are " + ", ".join(filter(None, units)))
        number = None if None in (value, factor) else value * factor
        if number is None or names[0] not in COUNTS:
            return number
        if number != round(number) or abs(number) > 1e6:
            return self.reject(component, names[0], f"must be a whole number, but is {number:g}")
        return int(number)

    def flag(self, component, name):
        """True for "true"; None if the attribute is missing. Of an array, for its first value."""
        attribute = component.find(name)
        return attribute and attribute.text in ("true", "1")

    def same(self, stated, attribute, other, remedy=""):
        """First of values, each with the component that states it; None without any. Values that differ are problems."""
        for value, component in stated:
            first, by = stated[0]
            if abs(value - first) > 1e-6 * max(1.0, abs(first)):
                self.reject(component, attribute, f"is {value:.9g}, but {other.format(by.label, first)}", remedy)
        return stated[0][0] if stated else None

    def common(self, components, *names):
        """Value that several components give, such as both flanks of a gear."""
        stated = [(new, component) for component in components if (new := self.number(component, *names)) is not None]
        return self.same(stated, names[0], "{} has {:.9g}", "a study has one value for both")

    def apply_load_case(self, name):
        """Replaces attributes by those of the chosen load case, or of the only one."""
        ids = [case for case, _ in self.load_cases]
        chosen = [components for case, components in self.load_cases if (case == name if name else len(ids) == 1)]
        if chosen:
            self.notes.append(f"load case {name or ids[0]}")
            for loaded in chosen[-1]:
                if loaded.id in self.components:
                    self.components[loaded.id].attributes |= loaded.attributes
        elif name:
            self.problem("--load-case", f"the model has no load case {name}", "it has " + (", ".join(ids) or "none"))
        elif ids:
            self.problem("--load-case", f"the model has {len(ids)} load cases", "choose one: " + ", ".join(ids))

    def unused(self):
        """Attributes of considered components that were not used, and components that were not considered, a line for each type."""
        attributes, types = collections.defaultdict(dict), collections.Counter()
        for component in self.components.values():
            types[component.type] += not component.considered
            for attribute in component.attributes.values() if component.considered else []:
                if not attribute.used and attribute.id not in IGNORED and attribute.text not in ("", "false") and attribute.value != 0.0:
                    unit = "" if attribute.unit == "none" else " " + attribute.unit
                    here = attribute.text + unit if attribute.scalar else "an array"
                    if attributes[component.type].setdefault(attribute.id, here) != here:
                        attributes[component.type][attribute.id] = "several values"
        lines = [f"{kind}: " + ", ".join(f"{name} ({value})" for name, value in sorted(values.items()))
                 for kind, values in sorted(attributes.items())]
        others = ", ".join(f"{number} {kind}" for kind, number in sorted(types.items()) if number)
        return lines + (["components: " + others] if others else [])


class Stage:
    """Gears that mesh. `first` and `second`: sun and ring of a planetary stage, gear_1 and gear_2 of a cylindrical
    one. A planetary stage has its gear pairs by mesh; a cylindrical one is its own pair, each with both gears.
    `obstacle`: reason why no study can be written."""

    def __init__(self, model, component, pairs):
        self.model, self.component, self.kind = model, component, component.type.removesuffix("_stage")
        self.first, self.second, self.planets, self.first_pairs, self.second_pairs, self.teeth = None, None, [], [], [], ""
        nameless = [pair for pair, *gears in pairs if None in gears]
        if self.kind not in ("planetary", "cylindrical"):
            self.obstacle = "only planetary and cylindrical stages are simulated"
        elif len(pairs) > MOST_PAIRS:
            self.obstacle = f"it has {len(pairs)} gear pairs"
        elif nameless:
            self.obstacle = ("it" if nameless[0] is component else nameless[0].label) + " names no gear_1 or no gear_2"
        else:
            self.obstacle = self.sort(pairs)
        if self.first:
            teeth = [gear.find("number_of_teeth") and abs(model.number(gear, "number_of_teeth") or 0)
                     for gear in (self.first, *self.planets[:1], self.second)]
            self.teeth = "/".join("?" if number is None else str(number) for number in teeth) + " teeth"
            self.teeth += f", {len(self.planets)} planet{'s' * (len(self.planets) > 1)}" if self.planets else ""

    def sort(self, pairs):
        """Finds the members and sorts the pairs by mesh. Returns the obstacle."""
        if self.kind == "cylindrical":
            (pair, self.first, self.second), = pairs
            self.first_pairs = [pair]
            return "internal gears on fixed shafts are not simulated" if "ring_gear" in (self.first.type, self.second.type) else ""
        suns, planets, rings, inner = {}, {}, {}, []  # dicts keep the order
        for pair, *gears in pairs:
            if "ring_gear" in [gear.type for gear in gears]:
                ring, planet = sorted(gears, key=lambda gear: gear.type != "ring_gear")
                rings[ring] = planets[planet] = True
                self.second_pairs.append(pair)
            else:
                inner.append((pair, *gears))
        for pair, gear_1, gear_2 in reversed(inner):
            if (gear_1 in planets) == (gear_2 in planets):
                which = "both planets" if gear_1 in planets else "neither of them with a ring"
                return (f"in {pair.label} {gear_1.label} and {gear_2.label} mesh, {which}, so that the planets are stepped "
                        "or paired")
            suns[gear_2 if gear_1 in planets else gear_1] = True
        if (len(suns), len(rings)) != (1, 1):
            return f"it has {len(suns)} suns and {len(rings)} rings, not one of each"
        (self.first,), (self.second,), self.planets, self.first_pairs = suns, rings, list(planets), [pair for pair, *_ in inner]
        if len(planets) == len(inner) == len(self.second_pairs):
            return ""
        return f"{len(planets)} planets have {len(inner)} meshes with the sun and {len(self.second_pairs)} with the ring"

    def description(self):
        """For example "9 (Planetenstufe [9], planetary, 17/22/61 teeth, 3 planets)"."""
        kind = "planetary" if self.kind == "planetary" else self.component.type
        obstacle = f"; not possible: {self.obstacle}" if self.obstacle else ""
        return f"{self.component.id} ({', '.join(filter(None, [self.component.name, kind, self.teeth]))}{obstacle})"

    def carriers(self):
        return self.model.related("planet_carrier_shaft", "planetary_stage", self.component, "shaft")

    def ends(self):
        """Shafts of the first member, and of the second: the carrier of a planetary stage."""
        return [self.model.shaft_of(self.first), self.carriers() if self.planets else self.model.shaft_of(self.second)]

    def datasheet(self, load):
        """Values under the names of the program's structs, and the gears by the names that they have in a study."""
        model = self.model
        first, second = (self.second, self.first) if load.second_drives and not self.planets else (self.first, self.second)
        gears = {"sun": [first], "planet": self.planets, "ring": [second]} if self.planets else {"pinion": [first], "gear": [second]}
        members = {member: Gear(model, parts) for member, parts in gears.items()}
        values = {member: gear.teeth for member, gear in members.items()} | self.shared_values(list(members.values()))
        for gear in members.values():
            self.check_tip(gear)
        if self.planets:
            values["planets"] = self.number_of_planets()
        for name in () if self.planets else {"input", "planets"} & set(model.options):
            model.problem(f"--{name}", "a gear pair has none", "leave it out for a cylindrical stage")
        for planet in self.planets:
            self.bearings(model.shaft_of(planet))  # all count as considered
        shafts = {member: model.shaft_of(parts[0]) for member, parts in gears.items()}
        shafts |= {"carrier": self.carriers()} if self.planets else {}
        owners = {"planet": "planets'", "pinion": "driving gear's", "gear": "driven gear's"}
        owners = {member: owners.get(member, f"{member}'s") for member in shafts}
        stiffness = {member: self.bearings(held, re.sub("'s?$", "", owners[member])) for member, held in shafts.items()}
        for key, title, numbers in (("shift", "shift", {member: gear.shift for member, gear in members.items()}),
                                    ("tip_mm", "tip circle", {member: gear.tip for member, gear in members.items()}),
                                    ("bearing_N_m", "bearing stiffness", stiffness)):
            values |= {f"{member}_{key}": value for member, value in numbers.items()}
            model.lacking += [f"{owners[member]} {title}" for member, value in numbers.items() if value is None]
        if self.planets:
            values["input"] = load.drive_other(model, members["sun"], members["ring"])
        else:
            model.lacking.append("shafts, motor and load")
            model.notes.append(f"{first.label} drives (the study's pinion)")
        model.notes += load.notes
        return values | load.values(model), members

    def shared_values(self, gears):
        """Values that all gears of the stage share."""
        model, pairs = self.model, self.first_pairs + self.second_pairs
        gear_data = [data for pair in pairs for data in model.related("stage_gear_data", "stage", pair, "stage_gear_data")]
        for part in [self.component] + pairs + gear_data:
            part.considered = True
        for data in gear_data:
            data.find("is_driving_gear")
        stated = {name: [(gear.values[name], gear.component) for gear in gears if gear.values[name] is not None]
                  for name in gears[0].values}
        values = {name: model.same(stated[name], OF_STAGE[name][0], "that of {} is {:.9g}; meshing gears have the same")
                  for name in ("module_mm", "pressure_angle_deg", "helix_angle_deg")}
        values["centre_distance_mm"] = (distance := model.common(pairs, *DISTANCES)) and abs(distance)
        for pair, meshing in ((self.first_pairs[0], gears[:2]), *((pair, gears[1:]) for pair in self.second_pairs[:1])):
            self.check_centre_distance(pair, values, *meshing)
        width = values["face_width_mm"] = self.combined(stated["face_width_mm"], min, "face widths {}; a study has one, the common "
                                                        "{:g} mm", " mm", model.common(pairs, "common_face_width"))
        for name, title in (("young_modulus_Pa", "Young's modulus, Pa"), ("poisson_ratio", "Poisson's ratio")):
            # The mean of stiffnesses in series.
            values[name] = self.combined(stated[name], lambda numbers: len(numbers) / sum(1.0 / number for number in numbers),
                                         title + ": {}; a study has one value, their harmonic mean {:.6g}")
        if self.kind == "cylindrical":
            first, second = (model.number(gear, *HELICES) or 0.0 for gear in (self.first, self.second))
            if first * second > 0.0:
                model.reject(self.second, HELICES[0], f"{second:g} and {first:g} deg of {self.first.label} have the same "
                             "sign; external gears on parallel shafts have opposite hands")
        values |= {name: model.options[name] for name in ("face_width_mm", "addendum", "quality") if name in model.options}
        model.lacking += [text for name, (_, text) in OF_STAGE.items() if text and values[name] is None]
        model.lacking += [] if "quality" in values else ["tooth quality"]
        values["helix_deg"] = values.pop("helix_angle_deg")
        if "face_width_mm" in model.options and width is not None:
            model.notes.append(f"an option replaces the model's face width of {width:g} mm")
        return values

    def combined(self, stated, combine, note, unit="", value=None):
        """Combination of values, each with the component that states it, or a given value. Notes values that differ."""
        numbers = [number for number, _ in stated]
        if value is None and numbers:
            value = combine(numbers) if len(set(numbers)) > 1 else numbers[0]
        if any(number != value for number in numbers):
            self.model.notes.append(note.format(", ".join(f"{number:.6g}{unit} of {by.label}" for number, by in stated), value))
        return value

    def check_centre_distance(self, pair, values, gear_1, gear_2):
        """Rejects a centre distance that does not fit the teeth and shifts of two gears, with the one that does. Notes
        a small backlash."""
        distance, module, number = values["centre_distance_mm"], values["module_mm"], gear_1.teeth + gear_2.side * gear_2.teeth
        if None in (distance, module, gear_1.shift, gear_2.shift) or not (module > 0.0 and gear_1.teeth and gear_2.teeth and number):
            return
        helix = math.radians(values["helix_angle_deg"] or 0.0)
        normal = 20.0 if values["pressure_angle_deg"] is None else values["pressure_angle_deg"]
        angle = math.atan(math.tan(math.radians(normal)) / math.cos(helix))
        shift = (gear_1.shift + gear_2.shift) * math.cos(helix)
        working = angle if shift == 0.0 else inverse_involute(math.tan(angle) - angle + 2.0 * math.tan(angle) * shift / number)
        fits = 0.5 * abs(number) * module / math.cos(helix) * math.cos(angle) / math.cos(working)
        # Backlash in modules: larger distances open external meshes and close internal ones. Shifts are rounded to two
        # decimals; no allowance of tooth thickness is 0.1.
        gap = gear_2.side * (distance - fits) * 2.0 * math.tan(angle) / module
        if 0.01 < gap <= 0.1:
            self.model.notes.append(f"{gear_1.component.label} and {gear_2.component.label} have a backlash of about "
                                    f"{gap * module:.3g} mm at {distance:.6g} mm")
        elif not -0.01 <= gap <= 0.1:
            self.model.reject(pair, DISTANCES[0], f"is {distance:.6g} mm, but {gear_1.teeth} and {gear_2.teeth} teeth with "
                              f"shifts of {gear_1.shift:g} and {gear_2.shift:g} fit at {fits:.6g} mm", "correct the distance, the "
                              "teeth or the shifts (a positive shift makes teeth thicker, also those of a ring: ISO 21771)")

    def check_tip(self, gear):
        """Rejects a tip circle that no gear has. The option --addendum replaces tip circles."""
        if gear.tip is None or not gear.teeth:
            return
        if "addendum" in self.model.options:
            self.model.notes.append(f"an option replaces the tip diameter of {gear.component.label}, {gear.tip:g} mm")
            gear.tip = None
            return
        helix, module = math.radians(gear.values["helix_angle_deg"] or 0.0), gear.values["module_mm"] or 0.0
        reference, shift = gear.teeth / math.cos(helix), 2.0 * (gear.shift or 0.0)  # in modules
        root, far = (module * (reference + gear.side * (shift + beyond)) for beyond in (-2.5, 4.0))
        angle = math.atan(math.tan(math.radians(gear.values["pressure_angle_deg"] or 0.0)) / math.cos(helix))
        base = module * reference * math.cos(angle)
        for wrong, why in ((gear.side * (gear.tip - root) <= 0.0,
                            f"lies {'in' if gear.side == 1 else 'out'}side the root circle, {root:.6g} mm"),
                           (gear.tip <= base, f"lies inside the base circle, {base:.6g} mm"),
                           (gear.side * (far - gear.tip) < 0.0, "is more than two modules away from the reference circle")):
            if wrong:
                self.model.reject(gear.component, "tip_diameter", f"{gear.tip:g} mm {why}",
                                  "remove it from the model, and the rule is used, or give --addendum")
                return

    def bearings(self, shafts, member=""):
        """Radial stiffness of all bearings between these shafts and other parts. None without bearings, or if any of
        them is rigid or has none; a note on the member names these."""
        total, unusable = 0.0, []
        for bearing, *parts in self.model.parts("side", "assembly", "inner_part", "outer_part"):
            if bearing and "bearing" in bearing.type and set(shafts) & set(parts):
                bearing.considered = True
                stiffness = self.model.number(bearing, "radial_stiffness")
                if stiffness is not None and 0.0 < stiffness < 1e13:
                    total += stiffness
                else:
                    unusable.append(bearing.label + ("" if stiffness is None else f" ({stiffness:g} N/m)"))
        if unusable and member:
            self.model.notes.append(f"bearings of the {member} that are rigid or state no radial stiffness, replaced by the "
                                    "rule: " + ", ".join(unusable))
        return None if unusable else total or None

    def number_of_planets(self):
        """Number of planets: given as an option, stated or modelled. Rejects a turning ring. Notes planets that are not
        spaced equally."""
        model, ring = self.model, self.model.shaft_of(self.second)
        turning = [f"its {shaft.label} turns at {speed:.6g} rpm" for shaft in ring if (speed := model.number(shaft, "rotational_speed"))]
        turning += [f"{held.label} stands still instead (rotational_speed 0)" for _ in ring
                    for held in self.carriers() + model.shaft_of(self.first)
                    if model.number(held, "rotational_speed") == 0.0 and model.flag(held, "defines_speed")]
        if turning:
            model.problem(self.component.label, f"the ring is not the fixed member: {turning[0]}",
                          "new writes studies with a fixed ring; edit operation.fixed in one")
        modelled, stated = len(self.planets), model.number(self.component, "number_of_planets")
        given, here = model.options.get("planets"), (3 if modelled == 1 else modelled) if stated is None else stated
        if stated is not None and modelled > 1 and stated != modelled:
            model.reject(self.component, "number_of_planets", f"is {stated}, but the model has {modelled} planet gears",
                         "correct one of them")
        if modelled == 1 and stated is None and given is None:
            model.lacking.append("number of planets (3; the model has one planet gear)")
        if given not in (None, here) and modelled > 1:
            model.notes.append(f"an option replaces the model's number of planets, {here}")
        angles = [model.number(pair, "rotating_angle_around_neg_u_axis") for pair in self.first_pairs]
        angles = sorted(angle % 360.0 for angle in angles if angle is not None)
        if any(abs(angle - angles[0] - 360.0 * i / len(angles)) > 0.5 for i, angle in enumerate(angles)):
            listed = ", ".join(f"{angle - angles[0]:.4g}" for angle in angles)
            model.notes.append(f"planets at {listed} deg; the study spaces them equally or as nearly as the teeth allow "
                               "(gearbox.planet_positions_deg)")
        return here if given is None else given


def stages_of(model):
    """All stages, those within a planetary stage excepted."""
    pairs = {pair[0]: pair for pair in model.parts("stage", "stage", "gear_1", "gear_2")}
    planetary, within = collections.defaultdict(list), set()
    for whole, part in model.parts("assembly", "assembly", "part"):
        if whole and whole.type == "planetary_stage" and part in pairs and part not in within:
            within.add(part)
            planetary[whole].append(pairs[part])
    return [Stage(model, part, planetary[part] if part.type == "planetary_stage" else [pairs.get(part, (part, None, None))])
            for part in model.components.values()
            if part.type.endswith("_stage") and (part.type == "planetary_stage" or part not in within)]


def chosen_stage(model, stages):
    """Stage that the option names, or the only one that is possible. Refuses with a list of all."""
    if not stages:
        raise Unusable("has no gear stages", "name a model with a planetary or cylindrical stage")
    if len(stages) > MOST_STAGES:
        raise Unusable(f"has {len(stages)} gear stages", f"models of up to {MOST_STAGES} are read")
    name, remedy = model.options.get("stage", ""), "the model has "
    found = [stage for stage in stages if (stage.component.id == name if name else not stage.obstacle)]
    if len(found) > 1:
        what, remedy = f"the model has {len(stages)} stages", "choose one: "
    elif not found:
        what = f"there is no stage {name}" if name else "no stage of the model can be simulated"
    elif found[0].obstacle:
        what = f"stage {name} is not possible: {found[0].obstacle}"
    else:
        return found[0]
    model.problem("--stage", what, remedy + "; ".join(stage.description() for stage in stages))
    raise Unusable


class Gear:
    """Values of one gear, or of equal ones such as all planets; missing ones are None. Internal gears have positive
    numbers. Shifts follow ISO 21771."""

    def __init__(self, model, gears):
        self.component, self.side = gears[0], -1 if gears[0].type == "ring_gear" else 1
        # Versions differ in whether gears or flanks state angles and shifts.
        parts = gears + [flank for gear in gears for side in ("left", "right")
                         for flank in model.related("flank", "gear", gear, side)]
        made_of = [material for gear in gears for material in model.related("reference", "origin", gear, "referenced")
                   if material.type == "material"]
        for part in parts + made_of:
            part.considered = True
        self.teeth = min(abs(model.common(gears, "number_of_teeth") or 0), 10001)
        for name in ("number_of_teeth", "normal_module"):
            if not any(gear.find(name) for gear in gears):
                model.reject(self.component, name, "is missing")
        self.values = {
            "module_mm": model.common(gears, "normal_module"), "helix_angle_deg": (helix := model.common(gears, *HELICES)) and abs(helix),
            "pressure_angle_deg": model.common(parts, "normal_pressure_angle"),
            "face_width_mm": model.common(gears, "face_width"),
            "young_modulus_Pa": max(model.common(made_of, "elastic_modulus") or 0.0, 0.0) or None,
            "poisson_ratio": max(model.common(made_of, "poisson_ratio") or 0.0, 0.0) or None}
        tip, module = model.common(parts, "tip_diameter"), self.values["module_mm"]
        self.tip = tip and abs(tip)
        self.shift, shift_mm = model.common(parts, *SHIFTS), model.common(parts, *SHIFTS_MM)
        if shift_mm is not None and module:
            from_mm = shift_mm / module
            if self.shift is not None and abs(self.shift - from_mm) > 1e-3:
                model.reject(parts[0], SHIFTS_MM[0], f"{shift_mm:.6g} mm are {from_mm:.6g} modules, but the coefficient is "
                             f"{self.shift:.6g}", "correct one of them")
            self.shift = from_mm if self.shift is None else self.shift


def inverse_involute(value):
    """Angle a > 0 with tan a - a = value, by Newton's method from above; 0 if there is none."""
    angle, new = 0.0, min(math.pow(3.0 * value, 1.0 / 3.0), 1.57) if value > 0.0 else 0.0
    while new != angle and (angle == 0.0 or new < angle):
        angle, new = new, new - (math.tan(new) - new - value) / math.tan(new) ** 2
    return angle


class Load:
    """Speed and torque at the driving member of a stage, followed from the shafts that state them through gear pairs,
    planetary stages with a fixed ring, and couplings. Losses are neglected. Torque and speed of the same sense drive.
    Without a torque, a stage's driving gear, else its sun or gear_1, drives. Speeds that contradict each other are
    problems."""

    def __init__(self, model, stages, stage):
        self.speed, self.torque, self.notes, self.links, self.coupled = None, None, [], collections.defaultdict(list), []
        self.connect_shafts(model, stages)
        gear_data = model.related("stage_gear_data", "gear", stage.second, "stage_gear_data")
        self.second_drives = stage.kind == "cylindrical" and any(model.flag(data, "is_driving_gear") for data in gear_data)
        speeds, torques, ends = {}, [], stage.ends()
        for part in model.components.values():
            if part.type == "shaft" and (speed := model.number(part, "rotational_speed")):
                speeds[part] = speed
            elif part.type == "external_load":
                part.considered = True
                defines, _ = model.flag(part, "defines_torque"), model.flag(part, "transmits_torque")
                torque = model.number(part, "torque_around_u_axis")
                torques += [(not defines, shaft, part, torque) for shaft in model.shaft_of(part) if torque]
        if torques:
            self.follow_torque(speeds, sorted(torques, key=lambda torque: torque[0]), ends)
        for driver in ends[self.second_drives][:1]:
            self.follow_speed(model, speeds, driver)

    def connect_shafts(self, model, stages):
        """Lists the shafts that each shaft turns, with their speed divided by its own."""
        connected = []
        for stage in stages:
            if stage.first and stage.second:
                first, second = (abs(model.number(gear, "number_of_teeth") or 0) for gear in (stage.first, stage.second))
                whole = first + second if stage.planets else second
                connected += [(*shafts, first / whole) for shafts in itertools.product(*stage.ends()) if whole]
        for between, *shafts in model.parts("side", "assembly", "inner_part", "outer_part"):
            if between and between.type.endswith("coupling") and model.flag(between, "is_engaged") is not False:
                self.coupled += [shafts] if all(shaft and shaft.type == "shaft" for shaft in shafts) else []
        connected += [(*shafts, 1.0) for shafts in self.coupled]
        for a, b, ratio in connected:
            if a is not b and ratio > 0.0:
                self.links[a].append((b, ratio))
                self.links[b].append((a, 1.0 / ratio))

    def reached_from(self, start):
        """Ratio of the speed of each shaft that can be reached to that of `start`, and the number of links between
        them. Ratios that no gear unit has end the search."""
        reached, waiting = {start: (1.0, 0)}, collections.deque([start])
        while waiting:
            here = waiting.popleft()
            ratio, number = reached[here]
            for shaft, faster in self.links.get(here, []):
                if shaft not in reached and 1e-30 < ratio * faster < 1e30:
                    reached[shaft] = ratio * faster, number + 1
                    waiting.append(shaft)
        return reached

    def follow_torque(self, speeds, torques, ends):
        """Takes the first torque, preferably one that defines the load; notes others that differ."""
        (_, shaft, by, torque), *others = torques
        reached = self.reached_from(shaft)
        first, second = (min((reached[shaft] for shaft in side if shaft in reached), key=lambda at: at[1], default=None)
                         for side in ends)
        if first and second:
            drives = speeds.get(shaft, torque) * torque > 0.0
            self.second_drives = (second[1] < first[1]) == drives
            self.torque = abs(torque) / (second if self.second_drives else first)[0]
            self.notes.append(f"torque from {by.label} ({torque:.6g} N m)")
        for _, other, load, value in others:
            expected = abs(torque) / reached[other][0] if other in reached else abs(value)
            if abs(abs(value) - expected) > 0.2 * expected:  # losses lower a torque
                self.notes.append(f"{repr(value).removesuffix('.0')} N m of {load.label} are not used; "
                                  f"{expected:.6g} N m follow from {by.label}")

    def follow_speed(self, model, speeds, driver):
        reached = self.reached_from(driver)
        followed = [(abs(speed) / reached[shaft][0], shaft, speed) for shaft, speed in speeds.items() if shaft in reached]
        for self.speed, source, first in followed[:1]:
            self.notes.append(f"speed from {source.label} ({first:.6g} rpm)")
        for here, shaft, speed in followed[1:]:
            if abs(here - self.speed) > 0.01 * here:
                model.reject(shaft, "rotational_speed", f"{speed:.6g} rpm contradict {first:.6g} rpm of {source.label}: the "
                             f"stage's driving shaft would turn at {here:.6g} and at {self.speed:.6g} rpm", "correct one of them")

    def drive_other(self, model, sun, ring):
        """Driving member of a planetary stage: the model's, or with the balancing load that of an option."""
        modelled = "carrier" if self.second_drives else "sun"
        given = model.options.get("input", modelled)
        if given == modelled or not sun.teeth:
            return modelled
        faster = 1.0 + ring.teeth / sun.teeth
        faster = 1.0 / faster if modelled == "sun" else faster
        if None not in (self.speed, self.torque):
            model.notes.append(f"an option replaces the model's input, the {modelled}")
        self.speed = self.speed and self.speed * faster
        self.torque = self.torque and self.torque / faster
        return given

    def values(self, model):
        """Torque, speed and power: given ones, completed by the model's."""
        given = {name: model.options[name] for name in ("torque_N_m", "speed_rpm", "power_kW") if name in model.options}
        stated = [("torque_N_m", self.torque, "torque", "N m"), ("speed_rpm", self.speed, "speed", "rpm")]
        for name, value, _, _ in reversed(stated):
            if len(given) < 2 and value is not None:
                given.setdefault(name, value)
        lacks = [title for _, value, title, _ in stated if value is None]
        if len(given) > 1:
            model.notes += [f"an option replaces the model's {title} of {value:.6g} {unit}"
                            for name, value, title, unit in stated if value not in (None, given.get(name))]
        elif len(lacks) == 2:
            model.problem("--torque, --speed, --power", "the model states neither torque nor speed of the stage",
                          "give two of the three, for the driving member")
        else:
            has = "speed" if lacks == ["torque"] else "torque"
            model.problem("--torque, --speed, --power", f"the model states a {has}, but no {lacks[0]} of the stage",
                          f"give --{lacks[0]} or --power")
        return given


def neighbours_of(model, stages, chosen):
    """Stages that shafts or engaged couplings connect with the chosen one, from it outwards: id, id of the nearer stage
    at the common shaft, and the members at its ends there and here."""
    ends, coupled = {}, []
    for stage in (stage for stage in stages if not stage.obstacle):
        load = Load(model, stages, stage)
        coupled = [*map(set, load.coupled)]  # the same for each
        names = ("sun", "carrier") if stage.planets else ("gear", "pinion") if load.second_drives else ("pinion", "gear")
        ends[stage] = [*zip(names, map(set, stage.ends()))]
    found, seen = [], [chosen]
    for here in seen:  # grows
        for there in ends:
            for (name, shafts), (other, others) in itertools.product(ends[here], ends[there]):
                joined = shafts & others or any(pair & shafts and pair & others for pair in coupled)
                if joined and there not in seen:
                    found.append((there.component.id, here.component.id, name, other))
                    seen.append(there)
    return found


def reply_to(model):
    """Datasheet of the chosen stage, with notes and names for messages. Raises Unusable if the model has problems."""
    model.apply_load_case(model.options.get("load_case", ""))
    stages = stages_of(model)
    stage = chosen_stage(model, stages)
    values, members = stage.datasheet(Load(model, stages, stage))
    if model.problems:
        raise Unusable
    lacking = ", ".join([*model.lacking, "gear bodies, masses and inertias", "damping", "sensor and noise"])
    rest = [f"ot in the model, by rule or chosen: {lacking}"] + [f"ot taken from the model: {line}" for line in model.unused()]
    head = f"Stage {stage.description()} of {model.options['name']} (REXS {model.version})."
    names = {f"gearbox.{key}": f"{stage.component.label}: {attribute}" for key, (attribute, _) in OF_STAGE.items()} | \
        {f"gearbox.{member}.{key}": f"{gear.component.label}: {attribute}" for member, gear in members.items()
         for key, attribute in OF_GEAR.items()} | {"operation.pinion_speed_rpm": "--speed"}
    return {"kind": stage.kind, "id": stage.component.id,
            "neighbours": neighbours_of(model, stages, stage) if model.options.get("train") else [],
            "names": names, "values": {name: value for name, value in values.items() if value is not None},
            "notes": [head] + model.notes + ["N" + line for line in rest],
            "notices": model.notices + [(0, "", line, "") for line in model.notes + ["n" + line for line in rest]]}


def main():
    for what, most in ((resource.RLIMIT_AS, MOST_MEMORY), (resource.RLIMIT_CPU, MOST_SECONDS)):
        hard = resource.getrlimit(what)[1]
        resource.setrlimit(what, (most if hard == resource.RLIM_INFINITY else min(most, hard), hard))
    model, reply = Model(), {}
    try:
        model.read(sys.argv[1])
        model.options = json.load(sys.stdin)
        reply = reply_to(model)
        json.dumps(reply, allow_nan=False)
    except Unusable as last:
        if last.args:
            model.problem("", *last.args)
    except ImportError as error:
        model.problem("", f"cannot be read: {sys.executable}: {error}",
                      "install python3-lxml, or name a Python 3 with lxml in GEARPOD_PYTHON")
    except MemoryError:
        model.problem("", "needs more memory than reading a model may use", "export the model without meshes and results")
    except (ArithmeticError, ValueError):
        model.problem("", "has values that no gear unit can have")
    json.dump({**(reply if not model.problems else {}), "problems": model.problems}, sys.stdout)


if __name__ == "__main__":
    main()
