"""The page of the module as a notebook: its cells are run by Jupyter, and what each prints stands below it.

    python3 readme_test.py [--update]
"""
import os
import pathlib
import re
import sys
import tempfile

try:
    import nbclient
    import nbformat
except ImportError:
    print("Passed over: nbclient is not installed.")
    sys.exit(0)

PAGE = pathlib.Path("apps/python/README.md").resolve()
CELL = re.compile(r"(?ms)^```python notebook( picture)?\n(.*?)^```\n(?:\n```text\n(.*?)^```\n)?")

text = PAGE.read_text(encoding="utf-8")
cells = list(CELL.finditer(text))
notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell[2]) for cell in cells])
with tempfile.TemporaryDirectory() as folder:  # where a cell may write
    os.symlink(pathlib.Path("sample-runs").resolve(), f"{folder}/sample-runs")
    nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": folder}}).execute()

wrong, parts, end = 0, [], 0
for cell, run in zip(cells, notebook.cells):
    said = "".join(one["text"] for one in run.outputs if one["output_type"] == "stream" and one["name"] == "stdout")
    pictures = [one["data"]["text/html"] for one in run.outputs if "<svg" in one.get("data", {}).get("text/html", "")]
    if bool(cell[1]) != bool(pictures):
        wrong += 1
        print(f"--- expected {'a' if cell[1] else 'no'} picture, found {len(pictures)}:\n{cell[2]}")
    if said != (cell[3] or ""):
        wrong += 1
        print(f"--- {PAGE.name} says\n{cell[3] or ''}--- it prints\n{said}")
    parts += [text[end : cell.start()], f"```python notebook{cell[1] or ''}\n{cell[2]}```\n"]
    if said:
        parts.append(f"\n```text\n{said}```\n")
    end = cell.end()
if "--update" in sys.argv:
    PAGE.write_text("".join([*parts, text[end:]]), encoding="utf-8")
print(f"{len(cells)} cells run, {wrong} differences")
sys.exit(1 if wrong and "--update" not in sys.argv or not cells else 0)
