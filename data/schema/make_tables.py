#!/usr/bin/env python3
"""Writes what the schemas say of every key as tables for people: NAME.md for each NAME.schema.json.

usage: make_tables.py          writes them
       make_tables.py --check  compares with what is there; a key without a description is a fault, too
"""

import json
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
AS_MEASURED = "by the names of `measurements`"  # in the description of an object: its keys are those of laboratory files
NAMES = ("lab", "study", "apparatus", "application", "card", "case", "laws")


def number_of(value):
    return str(value) if isinstance(value, int) and not 1e6 <= value < 1e15 else f"{value:g}".replace("e+0", "e").replace("e-0", "e-")


def range_of(schema):
    low, above, high = (schema.get(key) for key in ("minimum", "exclusiveMinimum", "maximum"))
    ends = [] if low is None else [f"from {number_of(low)}"]
    ends += [] if above is None else [f"above {number_of(above)}"]
    ends += [] if high is None else [f"to {number_of(high)}"]
    return " ".join(ends)


class Tables:
    def __init__(self, schema):
        self.schema = schema
        self.rows = {}  # by path
        self.faults = []

    def resolved(self, schema):
        """Without the reference, if it is one to a definition that is no object."""
        name = schema.get("$ref", "").removeprefix("#/definitions/")
        target = self.schema.get("definitions", {}).get(name)
        return {**target, **{key: schema[key] for key in schema if key != "$ref"}} if target and not self.has_keys(target) else schema

    def has_keys(self, schema):
        return any(key in schema for key in ("properties", "oneOf")) or isinstance(schema.get("additionalProperties"), dict)

    def value_of(self, schema):
        """What may stand there, in words."""
        schema = self.resolved(schema)
        if schema.get("$ref", "#")[0] != "#":  # of another schema: "laws.schema.json#/properties/normal"
            file, key = schema["$ref"].split(".schema.json#/properties/")
            return f"as [{key}]({file}.md)"
        if "$ref" in schema:
            place, name = schema["$ref"].removeprefix("#/").rsplit("/", 1)
            return f"as [{name}](#{name.lower()})" if place == "definitions" else f"as `{name}`"
        if "const" in schema:
            return f"`{json.dumps(schema['const'])}`"
        if "enum" in schema:
            return ", ".join(f"`{json.dumps(word)}`" for word in schema["enum"])
        if "value" in schema.get("oneOf", [{}])[0].get("properties", {}):
            return self.value_of(schema["oneOf"][0]["properties"]["value"])
        choices = schema.get("anyOf", schema.get("allOf", schema.get("oneOf")))
        if choices:
            words = [self.value_of(one) for one in choices]
            return " or ".join(sorted(set(words), key=words.index))
        kinds = schema.get("type", "")
        words = [{"object": "{ }", "array": "list", "string": "text", "boolean": "true, false"}.get(kind, kind)
                 for kind in ([kinds] if isinstance(kinds, str) else kinds)]
        text = " or ".join(words)
        if "items" in schema and not self.has_keys(schema["items"]):
            text += f" of {self.value_of(schema['items'])}"
        return " ".join(filter(None, [text, range_of(schema)]))

    def add(self, path, schema, required, told):
        description = schema.get("description") or self.resolved(schema).get("description")
        key = path.rsplit(".", 1)[-1]
        if not description:
            if f"`{key}`" not in told and AS_MEASURED not in told:
                self.faults.append(f"{path} has no description")
            return
        row = self.rows.setdefault(path, [description, [], []])
        row[1].append(self.value_of(schema))
        row[2].append(required)

    def walk(self, schema, path="", told=""):
        """Adds the keys of an object and below it. `told`: what the descriptions above it say."""
        schema = self.resolved(schema)
        told += schema.get("description", "")
        for key, one in schema.get("properties", {}).items():
            self.add(path + key, one, key in schema.get("required", []), told)
            self.walk(one, f"{path}{key}.", told)
        for choice in ("oneOf", "anyOf", "allOf"):
            for one in schema.get(choice, []):
                self.walk(one, path, told)
        for part, sign in (("items", "[]."), ("additionalProperties", ".NAME.")):
            if isinstance(schema.get(part), dict):
                self.walk(schema[part], path[:-1] + sign if path else sign[1:], told)

    def table(self, schema):
        self.rows = {}
        self.walk(schema)
        lines = ["| key | value | meaning |", "|---|---|---|"]
        for path, (description, values, required) in self.rows.items():
            values = " or ".join(sorted(set(values), key=values.index))
            lines.append(f"| `{path}`{'' if all(required) else ' (optional)'} | {values} | {description} |".replace("||", "| |"))
        return lines if self.rows else []

    def text(self, name):
        lines = [f"# {self.schema['title'][0].upper() + self.schema['title'][1:]}", "", self.schema["description"], "",
                 f"`make_tables.py` generates this page from `{name}.schema.json`. Each key is given with its full path, e.g. "
                 "`apparatus.reading.height`. In a path, `[]` stands for any element of a list, and `NAME` stands for any name. Some "
                 "objects have several forms, and a key may exist in only some of these forms. `(optional)` marks a key that may be "
                 "omitted in at least one form of its object.", ""]
        lines += self.table(self.schema)
        for part, schema in sorted(self.schema.get("definitions", {}).items()):
            if self.has_keys(schema):
                lines += ["", f"## {part}", ""] + ([schema["description"], ""] if "description" in schema else []) + self.table(schema)
        return "\n".join(lines) + "\n"


def main(check):
    faults = []
    for name in NAMES:
        tables = Tables(json.loads((HERE / f"{name}.schema.json").read_text()))
        text = tables.text(name)
        faults += [f"{name}.schema.json: {fault}" for fault in tables.faults]
        file = HERE / f"{name}.md"
        if not check:
            file.write_text(text)
        elif not file.exists() or file.read_text() != text:
            faults.append(f"{file.name} is not what {name}.schema.json gives: run data/schema/make_tables.py")
    print("\n".join(faults) or "every key has its description and its row")
    return 1 if faults else 0


if __name__ == "__main__":
    if sys.argv[1:] not in ([], ["--check"]):
        sys.exit(__doc__)
    sys.exit(main("--check" in sys.argv))
