"""The JSON schema of study files: check_schema.py PROGRAM SOURCES

The stored schema is the one that the program's table of keys gives, every shipped study satisfies it
and names it, and a misspelt key or a wrong type does not satisfy it.
"""

import copy
import json
import pathlib
import sys
import tomllib

try:
    import jsonschema
except ImportError:
    print("python3-jsonschema is not installed")
    sys.exit(77)


def problems(program, sources):
    sys.path.insert(0, str(sources / "docs" / "tools"))
    import study_schema
    stored = sources / "studies" / "study.schema.json"
    text = stored.read_text(encoding="utf-8")
    if text != study_schema.text_of(program):
        yield (f"{stored} is not what the program says; make it anew with\n"
               f"  docs/tools/study_schema.py PROGRAM {stored}")
    check = jsonschema.Draft7Validator(json.loads(text))
    studies = sorted((sources / "studies").glob("*.toml"))
    for path in studies + sorted((sources / "studies" / "published").glob("*.toml")):
        text = path.read_text(encoding="utf-8")
        for error in check.iter_errors(tomllib.loads(text)):
            yield f"{path}: {'.'.join(map(str, error.path))}: {error.message[:200]}"
        if path in studies and not text.startswith("#:schema study.schema.json\n"):
            yield f"{path} does not begin with #:schema study.schema.json"
    good = tomllib.loads(studies[0].read_text(encoding="utf-8"))
    for section, key, value in (("gearbox", "sun_theet", 3), ("gearbox", "sun", {"teeth": "many"}),
                                ("sensor", "sampling_Hz", -1), ("spelling", "key", 1)):
        wrong = copy.deepcopy(good)
        wrong.setdefault(section, {})[key] = value
        if check.is_valid(wrong):
            yield f"the schema accepts {section}.{key} = {value!r}"


if __name__ == "__main__":
    found = list(problems(sys.argv[1], pathlib.Path(sys.argv[2])))
    print("\n".join(found) or "the schema and the studies agree")
    sys.exit(1 if found else 0)
