"""The JSON Schema of model files is valid, the models keep to it, and wrong models do not all pass.

Two tools judge: `jsonschema`, and `tombi`, which is what editors use on TOML files.
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tomllib

import jsonschema

root = pathlib.Path(__file__).resolve().parent.parent
work = pathlib.Path(sys.argv[1])
schema_file = root / "docs" / "reference" / "schema.json"
schema = json.loads(schema_file.read_text(encoding="utf-8"))
models = sorted((root / "models").glob("*.toml"))
assert models, "no models"

validator = jsonschema.Draft202012Validator
assert schema.get("$schema") == "https://json-schema.org/draft/2020-12/schema", schema.get("$schema")
validator.check_schema(schema)

bad = []
for path in models:
    for error in validator(schema).iter_errors(tomllib.loads(path.read_text(encoding="utf-8"))):
        bad.append(f"{path.name}: {error.json_path}: {error.message}")
assert not bad, "\n".join(bad)

refused = 0
for path in sorted((root / "models" / "wrong").glob("*.toml")):
    try:
        model = tomllib.loads(path.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, RecursionError):
        continue
    refused += not validator(schema).is_valid(model)
assert refused > 0, "the schema refuses nothing"

shutil.rmtree(work, ignore_errors=True)
work.mkdir(parents=True)
shutil.copy(schema_file, work / "schema.json")
for path in models:
    shutil.copy(path, work / path.name)
(work / "tombi.toml").write_text(
    '[[schemas]]\npath = "schema.json"\ninclude = ["*.toml"]\n\n[schema]\nenabled = true\nstrict = false\n',
    encoding="utf-8",
)
tombi = pathlib.Path(sys.executable).parent / "tombi"
command = [str(tombi), "lint", "--offline", *[path.name for path in models]]
result = subprocess.run(command, cwd=work, capture_output=True, text=True)
assert result.returncode == 0, result.stdout + result.stderr

# A tool that found no schema would be content with anything.
(work / models[0].name).write_text('format = 1\nnonsense = "yes"\n', encoding="utf-8")
result = subprocess.run([str(tombi), "lint", "--offline", models[0].name], cwd=work, capture_output=True, text=True)
assert result.returncode != 0, "tombi does not see the schema"

print(f"    {len(models)} models keep to the schema; it refuses {refused} of the wrong ones by itself")
