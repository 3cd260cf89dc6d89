"""Markdown of the reference pages from the program's own description (gearpod --reference)."""

TYPES = {"number": "number", "integer": "integer", "boolean": "true or false",
         "numbers": "list of numbers", "texts": "list of strings",
         "python": "list of Python files"}
SECTION_TITLES = {
    "gearbox": "teeth, bodies, bearings and damping", "operation": "torque, speed and their variation",
    "effects": "effects that are simulated", "fault": "kind, place and shape of the fault",
    "sensor": "sensor, encoders and noise", "features": "features to compute",
    "detection": "thresholds and intervals", "monitoring": "detectors that watch a gearbox over time",
    "life": "growth of the crack and the records of a life", "numerics": "accuracy and time integration",
    "ensemble": "number of gearboxes, seed and checkpoints"}


def cell(text):
    """Text of a table cell: a bar would end it, and marks would be read as Markdown."""
    for mark in "\\|*_<>[]`$":
        text = text.replace(mark, "\\" + mark)
    return text.replace("\n", " ")


def code(text):
    return f"`{text}`" if text else ""


def table(heads, rows):
    lines = ["| " + " | ".join(heads) + " |", "| " + " | ".join("---" for _ in heads) + " |"]
    lines += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def value_text(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list):
        return "[" + ", ".join(map(value_text, value)) + "]"
    if isinstance(value, float):
        return f"{value:g}"
    return str(value)


def sentence(text):
    text = text.strip()
    return text[:1].upper() + text[1:] + ("" if text.endswith(".") else ".") if text else ""


def commands(reference):
    parts = []
    for command in reference["commands"]:
        rows = []
        for option in command["options"]:
            name = option["name"]
            if option["type"] and not option["positional"]:
                name += f" {option['type']}"
            more = " Required." if option["required"] else ""
            more += " May be repeated." if option["several"] and not option["positional"] else ""
            rows.append([code(name), cell(sentence(option["meaning"])) + more])
        parts.append(f"## {command['name']}\n\n{sentence(command['meaning'])}\n\n"
                     + table(["option", "meaning"], rows))
    return "\n".join(parts)


def exit_codes(reference):
    return table(["code", "meaning"],
                 [[number, cell(text)] for number, text in reference["exit_codes"].items()])


def allowed(key):
    """Type, range and unit of a key's value."""
    if key["type"] == "choice":
        return " or ".join(code(f'"{choice}"') for choice in key["choices"])
    kind = (f"list of {{ {', '.join(field['name'] for field in key['fields'])} }}"
            if key["type"] == "tables" else TYPES[key["type"]])
    if key.get("ascending"):
        kind = "ascending " + kind
    unit = f", in {key['unit']}" if key["unit"] != "1" else ""
    return cell(f"{kind} {key['range']}".strip() + unit)


def key_entry(key):
    """One entry of a definition list: the key, what it may hold, what it means."""
    facts = [allowed(key)]
    if key["required"]:
        facts.append("required")
    elif "default" in key:
        facts.append("default " + code(value_text(key["default"])))
    if key["random"]:
        facts.append("may be random")
    if key["condition"]:
        facts.append(cell(key["condition"]))
    return f"{code(key['name'].rpartition('.')[2])}\n: *Value:* {'; '.join(facts)}.\\\n  {cell(sentence(key['meaning']))}\n"


def keys(reference):
    parts = []
    for section in reference["sections"]:
        if section == "random":
            continue
        tables = {"": []}  # entries by table of the section
        for key in reference["keys"]:
            if key["section"] == section:
                tables.setdefault(key["name"].rpartition(".")[0], []).append(key_entry(key))
        parts.append(f"({section}-keys)=\n## [{section}]: {SECTION_TITLES.get(section, '')}\n\n" + "\n".join(tables.pop("")))
        parts += [f"### [{section}.{name}]\n\n" + "\n".join(entries) for name, entries in tables.items()]
    return "\n".join(parts)


def distributions(reference):
    return table(["distribution", "parameters"],
                 [[code(f'"{law["name"]}"'), cell(law["parameters"])]
                  for law in reference["distributions"]])


def features(reference):
    groups = (("Basic features", lambda f: f["basic"]),
              ("Features of the time signal", lambda f: not f["basic"] and f["compared"] == "nothing"),
              ("Features of the change since the baseline record", lambda f: f["compared"] == "change"),
              ("Ratios to the baseline record", lambda f: f["compared"] == "baseline"))
    parts = []
    for title, chosen in groups:
        rows = [[code(feature["name"]), cell(feature["title"]), cell(feature["unit"]), feature["alarm"],
                 cell(sentence(feature["definition"]))]
                for feature in reference["features"] if chosen(feature)]
        parts.append(f"## {title}\n\n" + table(["feature", "in headlines: the", "unit", "alarm side", "definition and source"], rows))
    return "\n".join(parts)


def fragments(reference):
    return {"commands.md": commands(reference), "exit_codes.md": exit_codes(reference),
            "keys.md": keys(reference), "distributions.md": distributions(reference),
            "features.md": features(reference)}
