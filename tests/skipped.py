"""What of the tests was skipped or left out, a line for each reason: the last lines of tests/run.sh.

    python3 skipped.py RESULTS CONFIGURED

RESULTS is what `ctest --output-junit` wrote, CONFIGURED what CMake said. Parts of tests that Node.js, a README or a
transcript skipped are counted too.
"""
import re
import sys
import xml.etree.ElementTree as tree

kNames = 3  # shown of a reason


def reason_of(case):
    """Why ctest has not run it to the end."""
    text = case.findtext("system-out") or ""
    of_google = re.search(r": Skipped\n(.+)", text)
    if of_google:
        return of_google[1].strip()
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return lines[-1].removeprefix("skipped: ") if lines else case.find("skipped").get("message", "")


def parts_of(text):
    """(reason, part) of what a test that ran has skipped itself."""
    for line in text.splitlines():
        # As Node.js reports by default where nobody looks: TAP in version 18, a list from version 20 on.
        by_node = re.fullmatch(r"\s*ok \d+ - (.*?) # SKIP ?(.*)", line) or re.fullmatch(r"\s*﹣ (.*?)(?: \([\d.]+ms\))? # (.*)", line)
        if by_node:
            yield by_node[2] or "said by the test", by_node[1]
        by_readme = re.fullmatch(r"(\S+): passed over what needs (.*)", line)
        if by_readme:
            yield f"python3 lacks {by_readme[2]}", f"a block of {by_readme[1]}"
        by_transcript = re.fullmatch(r"section (\S+) skipped: (.*)", line)
        if by_transcript:
            yield by_transcript[2], by_transcript[1]


def skipped_in(results):
    """{reason: names}"""
    found = {}
    for case in tree.parse(results).iter("testcase"):
        name = case.get("name").partition(" # ")[0].rstrip()  # GoogleTest adds the bytes of a parameter
        if case.find("skipped") is not None:
            found.setdefault(reason_of(case), []).append(name)
        else:
            for reason, part in parts_of(case.findtext("system-out") or ""):
                found.setdefault(reason, []).append(f"{name} ({part})")
    return found


def left_out_in(configured):
    with open(configured, encoding="utf-8", errors="replace") as lines:
        for line in lines:
            said = re.fullmatch(r"-- (?:Left out: (.*)|(tests/.*))", line.rstrip("\n"))
            if said:
                yield f"Left out: {said[1]}" if said[1] else said[2]


def main(results, configured):
    skipped, left_out = skipped_in(results), list(left_out_in(configured))
    if not skipped and not left_out:
        print("Nothing was skipped or left out.")
    for line in left_out:
        print(line)
    for reason, names in sorted(skipped.items()):
        more = f" and {len(names) - kNames} more" if len(names) > kNames else ""
        print(f"Skipped ({len(names)}), {reason}: {', '.join(names[:kNames])}{more}")


if __name__ == "__main__":
    main(*sys.argv[1:])
