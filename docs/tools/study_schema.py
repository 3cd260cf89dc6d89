"""JSON schema of a study file: study_schema.py PROGRAM [FILE]

Made from the program's table of keys (gearpod --reference). Writes to FILE, or to stdout. The copy in
studies/study.schema.json is checked against the program by test `docs-schema`.
"""

import json
import pathlib
import re
import subprocess
import sys

PARAMETER = re.compile(r"(\w+) \((number|integer|list of numbers)([^)]*)\)")
FILE_COLUMN = {"type": "object", "properties": {"file": {"type": "string"}, "column": {"type": "string"}},
               "required": ["file", "column"], "additionalProperties": False}
PYTHON_FEATURE = {"type": "object",
                  "properties": {name: {"type": "string"} for name in
                                 ("file", "sha256", "name", "title", "unit", "alarm", "uses", "doc")},
                  "required": ["file", "sha256", "name"], "additionalProperties": False}


def whole(value):
    """Whole bounds as integers, as people write them."""
    return int(value) if float(value).is_integer() and abs(value) < 1e15 else value


def bounded(schema, key):
    for side, name in (("low", "inimum"), ("high", "aximum")):
        if key[side] is not None:
            first = "m" if not key[f"{side}_open"] else "exclusiveM"
            schema[first + name] = whole(key[side])
    return schema


def field_schema(field):
    if "choices" in field:
        return {"enum": field["choices"]}
    if field["type"] == "word":
        return {"type": "string", "pattern": "^[a-z0-9-]+$"}
    if field["type"] == "text":
        return {"type": "string"}
    if field["type"] == "numbers":
        return {"anyOf": [{"type": "array", "items": {"type": "number"}}, FILE_COLUMN]}
    return {"type": field["type"]}


def table_schema(fields):
    return {"type": "object", "properties": {field["name"]: field_schema(field) for field in fields},
            "required": [field["name"] for field in fields if field["required"]],
            "additionalProperties": False}


def value_schema(key):
    kind = key["type"]
    if kind in ("number", "integer"):
        return bounded({"type": kind}, key)
    if kind == "boolean":
        return {"type": "boolean"}
    if kind == "choice":
        return {"type": "string", "enum": key["choices"]}
    if kind == "texts":
        return {"type": "array", "items": {"type": "string"}}
    if kind == "tables":
        return {"type": "array", "items": table_schema(key["fields"])}
    if kind == "python":
        return {"type": "array", "items": {"anyOf": [{"type": "string"}, PYTHON_FEATURE]}}
    numbers = {"type": "array", "items": bounded({"type": "number"}, key)}
    return {"anyOf": [numbers, FILE_COLUMN]}


def key_schema(key):
    schema = value_schema(key)
    unit = "" if key["unit"] == "1" else f" [{key['unit']}]"
    schema["description"] = key["meaning"] + unit
    if "default" in key:
        schema["default"] = key["default"]
    return schema


def insert(properties, name, schema):
    """Puts a dotted name, such as sun.mass_kg, into nested tables."""
    first, _, rest = name.partition(".")
    if not rest:
        properties[first] = schema
        return
    table = properties.setdefault(first, {"type": "object", "properties": {},
                                          "additionalProperties": False})
    insert(table["properties"], rest, schema)


def section_schema(keys):
    properties = {}
    for key in keys:
        insert(properties, key["name"], key_schema(key))
    return {"type": "object", "properties": properties, "additionalProperties": False}


def distribution_schema(distribution):
    properties = {"distribution": {"const": distribution["name"]},
                  "per": {"enum": ["gearbox", "assembly", "record"]}}
    required = ["distribution"]
    from_file = "file (path" in distribution["parameters"]
    for name, kind, more in PARAMETER.findall(distribution["parameters"]):
        properties[name] = ({"type": "array", "items": {"type": "number"}}
                            if kind == "list of numbers" else {"type": kind})
        if "optional" not in more and not from_file:
            required.append(name)
    if from_file:
        properties.update(file={"type": "string"}, column={"type": "string"})
    return {"type": "object", "properties": properties, "required": required,
            "additionalProperties": False}


def random_schema(reference):
    sections = {}
    for key in reference["keys"]:
        if key["random"]:
            table = sections.setdefault(key["section"], {"type": "object", "properties": {},
                                                         "additionalProperties": False})
            insert(table["properties"], key["name"],
                   {"$ref": "#/definitions/distribution", "description": key["meaning"]})
    pair = {"type": "object",
            "properties": {"between": {"type": "array", "items": {"type": "string"},
                                       "minItems": 2, "maxItems": 2},
                           "rank": {"type": "number", "exclusiveMinimum": -1,
                                    "exclusiveMaximum": 1}},
            "required": ["between", "rank"], "additionalProperties": False}
    return {"type": "object", "additionalProperties": False,
            "properties": {**sections, "correlations": {"type": "array", "items": pair}}}


def study_schema(reference):
    properties = {"title": {"type": "string", "description": "title of the study"}}
    for section in reference["sections"]:
        properties[section] = (random_schema(reference) if section == "random" else
                               section_schema(key for key in reference["keys"]
                                              if key["section"] == section))
    return {"$schema": "http://json-schema.org/draft-07/schema#", "title": "gearpod study",
            "type": "object", "properties": properties, "additionalProperties": False,
            "definitions": {"distribution": {
                "anyOf": [distribution_schema(law) for law in reference["distributions"]]}}}


def text_of(program):
    reference = json.loads(subprocess.run([program, "--reference"], check=True, capture_output=True,
                                          text=True).stdout)
    return json.dumps(study_schema(reference), indent=1) + "\n"


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    if len(sys.argv) == 3:
        pathlib.Path(sys.argv[2]).write_text(text_of(sys.argv[1]), encoding="utf-8")
    else:
        sys.stdout.write(text_of(sys.argv[1]))
