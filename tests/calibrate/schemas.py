"""The schemas of data/schema, with references to other schemas resolved."""

import json


def whole(part, folder):
    if isinstance(part, list):
        return [whole(one, folder) for one in part]
    if not isinstance(part, dict):
        return part
    file, _, place = part.get("$ref", "#").partition("#")
    if file:
        target = json.loads((folder / file).read_text(encoding="utf-8"))
        for key in place.strip("/").split("/"):
            target = target[key]
        part = {**target, **{key: value for key, value in part.items() if key != "$ref"}}
    return {key: whole(value, folder) for key, value in part.items()}


def schema(data, name):
    """`data`: the data folder; `name`: "lab", "study", ..."""
    folder = data / "schema"
    return whole(json.loads((folder / f"{name}.schema.json").read_text(encoding="utf-8")), folder)
