"""The blocks of the module's page, run one after the other as a notebook; what each prints stands below it.

    python3 readme_test.py [--update]
"""
import contextlib
import io
import pathlib
import re
import sys

PAGE = pathlib.Path("apps/python/README.md")
BLOCK = re.compile(r"(?ms)^```python notebook\n(.*?)^```\n(?:\n```text\n(.*?)^```\n)?")

text = PAGE.read_text(encoding="utf-8")
names, wrong, blocks, parts, end = {}, 0, 0, [], 0
for block in BLOCK.finditer(text):
    blocks += 1
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(compile(block[1], str(PAGE), "exec"), names)  # noqa: S102
    expected = block[2] or ""
    if out.getvalue() != expected:
        wrong += 1
        print(f"--- {PAGE} says\n{expected}--- it prints\n{out.getvalue()}")
    parts += [text[end : block.start()], f"```python notebook\n{block[1]}```\n"]
    if out.getvalue():
        parts.append(f"\n```text\n{out.getvalue()}```\n")
    end = block.end()
if "--update" in sys.argv:
    PAGE.write_text("".join([*parts, text[end:]]), encoding="utf-8")
print(f"{blocks} blocks run, {wrong} differences")
sys.exit(1 if wrong and "--update" not in sys.argv or blocks == 0 else 0)
