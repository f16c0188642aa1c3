"""Writes `flexura/_tables.pyi`: the tables of the model file as methods, each key a keyword, from the schema.

    python python/tables.py          rewrites it
    python python/tables.py --check  fails where it is out of date
"""

from __future__ import annotations

import json
import keyword
import sys
import textwrap
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

# The package that is installed is meant, not its sources beside this file, which lack the native part.
sys.path[:] = [place for place in sys.path if Path(place).resolve() != Path(__file__).resolve().parent]
import flexura  # noqa: E402

STUB = Path(__file__).parent / "flexura" / "_tables.pyi"

HEAD = '''"""The tables of the model file as methods. Written by `python/tables.py` from the schema."""

from typing import Any

from ._references import Handle

# A number (SI), a text with a unit, a quantity of pint, or a formula.
Number = Any

class Tables:
'''


def named(schema: Mapping[str, Any]) -> Any:
    """What stands in a named table, or None."""
    for part in schema.get("allOf", [schema]):
        inner = part.get("additionalProperties")
        if isinstance(inner, dict):
            return inner
    return None


def keys(schema: Mapping[str, Any]) -> dict[str, tuple[str, str]]:
    """The keys of a table, of all its kinds, with their type and description."""
    found: dict[str, tuple[str, str]] = {}
    for part in [schema, *schema.get("oneOf", [])]:
        for key, entry in part.get("properties", {}).items():
            if key not in found:
                found[key] = (kind(entry), first_sentence(entry))
    return found


def kind(entry: Mapping[str, Any]) -> str:
    """The type of a key, as far as Python can say it."""
    text = json.dumps(entry)
    if '"#/$defs/number"' in text and '"array"' not in text and '"object"' not in text:
        return "Number"
    return "Any"


def first_sentence(entry: Mapping[str, Any]) -> str:
    text = entry.get("description") or next((part.get("description", "") for part in entry.get("oneOf", [])), "")
    if "const" in entry:
        return "What kind it is."
    return str(text).split(". ")[0].rstrip(".") + "."


def wrapped(text: str, before: str) -> list[str]:
    return textwrap.wrap(text, 116, initial_indent=before, subsequent_indent=before + "    ")


def methods() -> Iterator[str]:
    for table, schema in json.loads(flexura.schema())["properties"].items():
        inner = named(schema)
        if inner is None:
            continue
        found = keys(inner)
        doc = str(inner.get("description") or schema["description"].split(" Named ")[0]).strip()
        if not found:
            yield f"    def {table}(self, name: Any, value: Number, /) -> Handle:"
            yield from wrapped(f'"""{doc}"""', "        ")
            continue
        yield f"    def {table}("
        yield "        self,"
        yield "        name: str,"
        yield "        /,"
        yield "        *,"
        words = {key + "_" * keyword.iskeyword(key): entry for key, entry in found.items() if key.isidentifier()}
        for key, (type_, _) in words.items():
            yield f"        {key}: {type_} = ...,"
        yield "        **keys: Any,"
        yield "    ) -> Handle:"
        yield from wrapped(f'"""{doc}', "        ")
        yield ""
        for key, (_, sentence) in found.items():
            yield from wrapped(f"{key}: {sentence}", "        ")
        yield '        """'


def text() -> str:
    return HEAD + "\n".join(methods()) + "\n"


if __name__ == "__main__":
    if "--check" not in sys.argv:
        STUB.write_text(text(), encoding="utf-8")
    elif STUB.read_text(encoding="utf-8") != text():
        sys.exit(f"{STUB} is out of date: run `python python/tables.py` with the package installed")
