"""No text that a person reads has wording that needs a second reading (libballbar/README.md, Style).

    python3 plain_words.py SOURCE_FOLDER

Read are the literals and the comments of the sources, the pages of text, and the transcripts of the terminal. Each entry is a pattern, an
example that it finds, and the better wording.
"""
import pathlib
import re
import sys

WORDS = [
    (r"lacks? nothing", "lacks nothing that these data show", "Something is probably still missing (94 %)."),
    (r"no (?:true )?model could", "what no model could explain", "8.4 times the noise"),
    (r"little as any model", "as little as any model could", "as small as the noise"),
    (r"[Oo]ut of the noise", "Out of the noise stand squareness", "Significant: squareness"),
    (r"stands? out (?:of|on)|[Nn]othing stands out", "No form stands out of what is left", "The residual shows no further pattern."),
    (r"results? alone\b", "stored results alone", "only stored results"),
    (r"; these are read", "found none; these are read", "showing the stored results instead"),
    (r"nothing else was there", "nothing else was there to say it", "a sentence that says what it means"),
    (r"(?:B|A) stands ", "x of B stands 0.45 um below", "x of B is 0.45 um below A"),
    (r"[Ww]hat is left\b", "What is left has a memory", "The residual changes slowly"),
    (r"ha(?:s|ve) a memory|with a memory", "noise with a memory", "autocorrelated noise; changes slowly"),
    (r"[Ww]hat a (?:true )?model leaves", "What a model leaves", "residual"),
    (r"\bsaid to be\b", "said to be left out", "CMake lists what is left out"),
    (r"(?:is|was|be|were|are) taken for", "what it is taken for", "is read as"),
    (r"makes? a shell", "What makes a shell complete", "Print a shell completion script"),
    (r"is its file\b", "A folder of tests is its file", "Keep all tests of a machine in one folder"),
    (r"drives? something", "T1 drives something", "T1 drives about 5 um (99 %)"),
    (r"form is open\. It may be", "Its form is open. It may be: A, or B", "most likely A (71 %)"),
    (r"either way that no", "3 um either way that no effect explains", "+-3 um that no known effect explains"),
    (r"(?:alone|it) it is not\b", "The housing alone it is not", "the housing alone does not explain it"),
    (r"below it is on", "below it is on the PATH", "the examples assume it is on your PATH"),
    (r"\btold (?:apart )?from\b", "told from all others", "separated from"),
    (r"\b[Tt]old (?:apart )?by\b", "Told apart by", "Distinguished by"),
    (r"\b(?:are|is) not told\b", "the errors are not told", "are not known"),
    (r"[Aa]s good as \S+ independent", "as good as 120 independent ones", "worth 120 independent values"),
    (r"bought up to", "is bought up to here", "adds"),
    (r"[Ll]ogs of others", "Logs of others", "Import"),
    (r"of others:", "of others: A, B", "also possible: A, B"),
    (r"\bcounts from\b", "counts from 8.5", "the threshold is 8.5"),
    (r"no paper's equation", "no paper's equation", "not from a paper"),
    (r"nobody logged", "that nobody logged", "that is not logged"),
    (r"questions were asked", "32 questions were asked", "32 quantities tested"),
    (r"answered with yes", "3 answered with yes", "3 significant"),
    (r"differs? clearly", "Nothing differs clearly", "No significant difference"),
    (r"first to mend", "first to mend", "main error"),
    (r"result for a program", "the result for a program", "print the result as JSON"),
    (r"which is neither", "found 'x', which is neither", "'x' is neither a command nor a file."),
    (r"was set right", "and was set right", "and was corrected"),
    (r"left as they are", "they were left as they are", "unchanged"),
    (r"Taken so:|Please look at:|Mended or", "Taken so:", "Guessed: / Please check: / Corrected or assumed:"),
    (r"on the way to one", "2 on the way to one", "2 drifting towards one"),
    (r"with those below", "folders with those below", "searched recursively"),
    (r"\b(?:a|one) (?:row|folder) a \w+", "a row a test", "one row per test"),
    (r"never made twice", "a set-up is never made twice alike", "no two set-ups are equal"),
    (r"goes before (?:what|the file)", "goes before what the file states", "overrides the file"),
    (r"does not tell\b|hardly tell", "where it does not tell", "default: detected; determine poorly"),
    (r"how slowly \w+ \w+ follows", "how slowly the body follows", "time constant of the body"),
    (r"\blags \w+'s\b", "z of B lags A's by 115 s", "z of B is 115 s late"),
    (r"both state\b", "differs by more than both state", "differs by more than the uncertainty"),
    (r"samples cannot tell", "these samples cannot tell which", "The samples cannot show which."),
    (r"known as measured", "No column is known as measured", "No measured column was found"),
    (r"the time runs on", "the time runs on", "the time continues"),
    (r"passed over", "rows passed over", "ignored"),
    (r"in all places alike|moves? all of them alike", "its error moves all of them alike", "shifts all scales alike"),
    (r"the words of statistics", "the words of statistics", "the statistical terms"),
    (r"our own verdicts instead|effects said", "effects said", "effects reported"),
    (r"come nearer to 0|came nearer to 0", "came nearer to 0 together", "decreased together"),
    (r"if it goes on\b", "on 2027-03-01 if it goes on", "if the trend continues"),
]  # fmt: skip

BAD = re.compile("|".join(f"(?:{pattern})" for pattern, _, _ in WORDS))
LITERALS = re.compile(r"""(?:"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*'|`[^`]*`)(?:\s*"(?:[^"\\\n]|\\.)*")*""")
COMMENT = re.compile(r"(?m)(?:^|(?<=\s))(?://|#(?!include)).*$")
# Lines of a comment that follow each other are one text.
COMMENTS = re.compile(r"(?m)(?:^[ \t]*//.*\n)+|(?<=\s)//.*$")
SOURCES = {".cpp", ".hpp", ".ts", ".py"}


def texts(path, text):
    """What a person reads of a file, each with the place where it stands."""
    if path.suffix == ".txt":
        yield from ((found.start(), found[0]) for found in re.finditer(r"(?m)^  .*$", text))
    elif path.suffix == ".md":
        text = re.sub(r"(?ms)^## Style$.*?(?=^## )", lambda style: "\n" * style[0].count("\n"), text)  # with bad examples
        yield from ((found.start(), found[0].replace("\n", " ")) for found in re.finditer(r"(?:.+\n?)+", text))
    else:
        for found in LITERALS.finditer(COMMENT.sub(lambda comment: " " * len(comment[0]), text)):
            yield found.start(), re.sub(r'"\s*"', "", found[0])
        if path.suffix in (".cpp", ".hpp"):
            for found in COMMENTS.finditer(text):
                yield found.start(), re.sub(r"\s*\n\s*// ?", " ", found[0])


def files(source):
    for part in ("libballbar", "formats", "apps"):
        for path in source.glob(f"{part}/**/*"):
            if path.suffix in SOURCES and "node_modules" not in path.parts and "engine" not in path.parts:
                yield path
    for part in ("", "libballbar/**/", "formats/**/", "apps/**/", "sample-runs/**/", "tests/**/"):
        yield from (path for path in source.glob(f"{part}README.md") if "node_modules" not in path.parts)
    yield from source.glob("tests/cli/*.txt")
    yield source / "formats/messages/en.toml"


def better(found):
    return next(better for pattern, _, better in WORDS if re.search(pattern, found))


wrong = [f"{pattern}: expected to find its example, found nothing in: {example}"
         for pattern, example, _ in WORDS if not re.search(pattern, example)]
read = 0
for path in sorted(set(files(pathlib.Path(sys.argv[1])))):
    text = path.read_text(encoding="utf-8")
    read += 1
    if path.suffix in (".txt", ".md") and not BAD.search(re.sub(r"\s+", " ", text)):
        continue
    for place, one in texts(path, text):
        for found in BAD.finditer(one):
            line = text.count("\n", 0, place) + 1
            wrong.append(f"{path.relative_to(sys.argv[1])}:{line}: expected words such as {better(found[0])!r}, found {found[0]!r}")
print("\n".join(wrong + [f"{read} files, {len(wrong)} texts to write anew"]))
sys.exit(1 if wrong or not read else 0)
