// What the catalogue says of an error, with the axes of the machine: its cause, what tells it apart, its remedy.
import { ranked_errors, type ErrorTest } from "./error_curves";
import { error_name, unit_shown } from "./error_names";
import { capital } from "../drawing/text";
import { decimals_for, shown, with_sigma } from "../drawing/theme";
import type { Leaf } from "../picture";
import { explained_by, type Sentence, t } from "../texts/texts";

// "backlash of X: 3.88 ± 0.17 µm (+), 3.45 ± 0.13 µm (−); correcting it lowers the circularity from 6.7 to 4.8 µm."
const gain_text = ({ part, recordings }: ErrorTest, effect: string): string => {
  const one = ranked_errors(part).find((ranked) => ranked.effect === effect);
  if (!one) return "";
  const plane = recordings[0]?.plane;
  const values = one.rows.map(
    ({ name, value, sigma, unit }) =>
      `${one.rows.length > 1 ? `${error_name(name, plane)}: ` : ""}${with_sigma(value, sigma, Math.min(4, decimals_for(value, sigma)))} ${unit_shown(unit)}`,
  );
  const { significant, rank, circularity_without_um: without } = one.first;
  const takes =
    rank === null
      ? t.errors_takes_nothing
      : t.errors_takes({ from: shown(part.circularity_um, 2), to: shown(without, 2) });
  const gain = significant === true ? takes : t.errors_not_significant;
  return t.errors_here_text({ values: values.join(", "), gain });
};

export const error_page = (test: ErrorTest, effect: string): Leaf | null => {
  const page = test.part.pages?.find((one) => one.effect === effect);
  if (!page) return null;
  const plane = test.recordings[0]?.plane;
  const others = page.confused_with.map((name) => error_name(name, plane)).join(", ");
  const explained = (key: "summary" | "cause" | "signature" | "separated_by" | "remedy"): Sentence =>
    page[key] === "" ? "" : explained_by("recording", effect, key, page[key], plane);
  const all = [
    { name: t.errors_here, text: gain_text(test, effect) },
    { name: t.errors_cause, text: explained("cause") },
    { name: t.errors_signature, text: explained("signature") },
    { name: t.errors_confused, text: others },
    { name: t.errors_told_apart, text: explained("separated_by") },
    { name: t.errors_remedy_name, text: explained("remedy") },
  ];
  return {
    title: capital(error_name(effect, plane)),
    summary: explained("summary"),
    parts: all.filter(({ text }) => (typeof text === "string" ? text : text.english) !== ""),
  };
};
