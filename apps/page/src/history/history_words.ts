// What the program writes into the table of a history, in the language of the page.
import { typed_name } from "../machine_errors/error_names";
import { named, t, with_decimal_sign } from "../texts/texts";

export const typed = (quantity: string): string => typed_name(quantity, 120);

export const heading_of = (heading: string): string => named(t.history_headings, heading);

const kDate = /^(\S+) \((\S+) to (\S+)\)$/; // "2026-03-01 (2025-12-01 to open)"
const kYears = /^not within (\S+) years$/;
const kRange = /^(?:(\S+) )?to (\S+)$/; // "-5 to 10", "to 5"
const kFrom = /^from (\S+)$/;
const kOf = /^(squareness|scale) (\S+)$/; // "squareness XY"

// A cell: a number, a name, or one of few phrases.
export const table_text = (text: string): string => {
  const date = kDate.exec(text);
  if (date) return t.history_span({ at: date[1] ?? "", from: date[2] ?? "", to: date[3] === "open" ? t.history_open : (date[3] ?? "") });
  const years = kYears.exec(text);
  if (years) return t.history_not_within({ years: years[1] ?? "" });
  const range = kRange.exec(text);
  const [from, to] = [with_decimal_sign(range?.[1] ?? ""), with_decimal_sign(range?.[2] ?? "")];
  if (range) return from === "" ? t.history_to({ limit: to }) : t.several_from_to({ from, to });
  const least = kFrom.exec(text);
  if (least) return t.history_at_least({ limit: with_decimal_sign(least[1] ?? "") });
  const of = kOf.exec(text);
  if (of) return `${named(t.history_words, of[1] ?? "")} ${of[2] ?? ""}`;
  return with_decimal_sign(named(t.history_words, text));
};
