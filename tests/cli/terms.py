"""Words of statistics: those that are printed stand in `ballbar effects --terms`, and no others; the first sentence of a verdict
has none but the error and the noise.

    python3 terms.py PROGRAM SOURCE_FOLDER

Printed is what the transcripts of tests/cli expect on standard output, but JSON and help, and what the page's sources
hold in quotes.
"""
import pathlib
import re
import subprocess
import sys

sys.dont_write_bytecode = True  # beside the sources
import transcript  # noqa: E402

program, source = sys.argv[1], pathlib.Path(sys.argv[2])

# Every word of statistics that is known to be one, and how it stands in a text.
WORDS = {
    "2 ln B": r"\b2 ln B\b", "AIC": r"\bAIC\b", "BIC": r"\bBIC\b", "MAE": r"\bMAE\b", "P": r"\bP\b(?! [a-z]*axis)",
    "p": r"\bp (?:[=<]|below)|p value", "R2": r"\bR2\b", "RMSE": r"\bRMSE\b", "autocorrelation": r"\b[Aa]utocorrelation",
    "bias": r"\bbias\b", "chi^2": r"\bchi\^2", "coherence": r"\b[Cc]oherence\b", "confidence": r"\bconfidence\b",
    "correlation": r"\b[Cc]orrelat", "credible": r"\bcredible\b", "discrepancy": r"\bdiscrepancy\b",
    "evidence": r"\bevidence\b", "forecast": r"\b[Ff]orecasts?\b",
    "left out": r"\b([Hh]eld|[Ll]eft)[ -]out\b", "independent": r"\bindependent ones\b",
    "likelihood": r"\blikelihood\b",
    "misfit": r"\bmisfit\b", "noise": r"\bnoise\b",
    "periodogram": r"\bperiodogram\b", "posterior": r"\bposterior\b", "prior": r"\b[Pp]rior\b",
    "quantile": r"\bquantiles?\b", "RMS": r"\bRMS\b", "robust": r"\brobust\b", "sigma": r"\bsigmas?\b",
    "significant": r"\bsignificant\b", "standard deviation": r"\bstandard deviations?\b",
    "variance": r"\bvariance\b", "white": r"\bwhite\b", "whitened": r"\bwhitened\b",
}  # fmt: skip


def words_in(text):
    return {word for word, pattern in WORDS.items() if re.search(pattern, text)}


def literals(text):
    """What stands in quotes, one literal after another as one."""
    text = re.sub(r"(?m)^\s*(//|import ).*$", "", text)
    return re.sub(r'"\s*"', "", " ".join(re.findall(r'"(?:[^"\\\n]|\\.)*"|`[^`]*`', text)))


printed = {}  # word: where
outputs = [(section.name, step.expected.stdout) for section in transcript.all_sections().values() for step in section.steps]
for name, text in outputs:
    if name.startswith(("help", "effects-terms")) or text.startswith(("{", "[")):
        continue
    text = "\n".join(line for line in text.split("\n") if not re.match(r'\s*("|[a-z_]+ = |#)', line))
    for word in words_in(text):
        printed.setdefault(word, f"section {name}")
for page in [*sorted((source / "apps/page/src").rglob("*.ts")), source / "apps/page/src/texts/en.toml"]:
    for line in page.read_text(encoding="utf-8").split("\n"):
        spoken = " ".join(one for one in re.findall(r'"(?:[^"\\]|\\.)*"|`[^`]*`', line) if " " in one)
        if line.lstrip().startswith(("//", "import", "#")):
            continue
        for word in words_in(re.sub(r"\$?\{[^}]*\}", "", spoken)):
            printed.setdefault(word, str(page.relative_to(source)))

page = subprocess.run([program, "effects", "--terms"], stdout=subprocess.PIPE, text=True, check=True).stdout
terms = {line.split("  ")[0] for line in page.split("\n")[1:] if line and not line.startswith(" ")}
faults = [f"{where} prints {word}, which `ballbar effects --terms` does not explain" for word, where in printed.items()
          if word not in terms]
faults += [f"`ballbar effects --terms` explains {term}, which nothing prints" for term in sorted(terms - set(printed))]

# First sentences: of every kind of verdict, as its test has them, and of the transcripts.
first = []
verdicts = (source / "tests/apps/diagnose/diagnosis_sentence_test.cpp").read_text(encoding="utf-8")
for expected in re.findall(r'EXPECT_EQ\(sentence_of\(found\),\s*((?:"[^"]*"\s*)+)\)', verdicts):
    first.append(re.sub(r'"\s*"', "", expected).strip('" \n'))
for kind in ("named", "probable", "driver", "equivalent", "unexplained", "nothing", "untestable"):
    if f"Verdict::{kind}" not in verdicts:
        faults.append(f"no first sentence of the verdict {kind} is tested")
for _, text in outputs:
    first += [re.sub(r"\s+", " ", one) for one in
              re.findall(r"(?ms)^(The data (?:do not )?support .*?\. |Remaining error .*?\.(?= |$)|(?:Missing|Probably missing) from .*?\.(?= |$)|"
                         r"In the model .*?\.(?= |$)|The circularity is .*?\.(?= [A-Z]|$))", text)]
for sentence in first:
    told = re.split(r"\.(?= [A-Z])", sentence)[0]
    for word in sorted(words_in(told) - {"RMS", "noise"}):
        faults.append(f"a verdict begins with {word}: {told}")
if len(first) < 20:
    faults.append(f"only {len(first)} first sentences were found")

print("\n".join(faults) or f"{len(terms)} terms, each printed; {len(first)} first sentences without one")
sys.exit(bool(faults))
