// What the program wrote on two machines, held together: the same keys and strings, and numbers to 1e-9. Of what:
//   of the number itself;
//   in a list, of the largest in the list: residuals and correlations near zero are differences of what is large;
//   beside a sigma, of the sigma: that far below it a value means nothing;
//   of a probability, of one.
// Numbers that are written with seven digits, as the points of pictures, may be neighbours where both lie at the border:
// of a list at most one in a hundred, which holds to 1e-9 what was there before it was rounded.
const kRelative = 1e-9;
const kTiny = 1e-15;
const kDigits = 7;
const kBorders = 0.01;
const kFewBorders = 3;

const kOfTheDay = new Set(["made_on"]);
const kProbability = /^(p|p_\w+|chance|share)$/;

const largest = (value) =>
  typeof value === "number" ? Math.abs(value) : Array.isArray(value) ? value.reduce((most, one) => Math.max(most, largest(one)), 0) : 0;

const sigma_beside = (object) =>
  Object.entries(object).reduce((most, [key, value]) => (key.includes("sigma") && typeof value === "number" ? Math.max(most, Math.abs(value)) : most), 0);

const kind_of = (value) => (Array.isArray(value) ? "list" : value === null ? "null" : typeof value);
const is_short = (value) => typeof value === "number" && Number(value.toPrecision(kDigits)) === value;
const unit_of_last = (value) => 10 ** (Math.floor(Math.log10(Math.abs(value))) - kDigits + 1);
const are_neighbours = (a, b) => is_short(a) && is_short(b) && Math.abs(a - b) < 1.001 * unit_of_last(Math.max(Math.abs(a), Math.abs(b)));
const shown = (value) => JSON.stringify(value)?.slice(0, 300);

const are_same = (a, b, size) => Math.abs(a - b) <= Math.max(kTiny, kRelative * Math.max(Math.abs(a), Math.abs(b), size));

function* of_lists(a, b, place, size) {
  if (a.length !== b.length) yield `${place}: ${a.length} and ${b.length} entries`;
  const around = Math.max(size, largest(a));
  const count = Math.min(a.length, b.length);
  let borders = 0;
  for (let k = 0; k < count; ++k) {
    if (typeof a[k] === "number" && typeof b[k] === "number" && !are_same(a[k], b[k], around) && are_neighbours(a[k], b[k])) ++borders;
    else yield* differences(a[k], b[k], `${place}[${k}]`, around);
  }
  if (borders > Math.max(kFewBorders, kBorders * count)) yield `${place}: ${borders} of ${count} differ in the last of ${kDigits} digits`;
}

// Lines that say where a and b differ; `size` is of the numbers around.
export function* differences(a, b, place = "", size = 0) {
  const [kind, other] = [kind_of(a), kind_of(b)];
  if (kind !== other) yield `${place}: ${kind} ${shown(a)} and ${other} ${shown(b)}`;
  else if (kind === "number") {
    if (!are_same(a, b, size)) yield `${place}: ${a} and ${b}, ${(Math.abs(a - b) / Math.max(Math.abs(a), Math.abs(b))).toExponential(1)} of it`;
  } else if (kind === "list") yield* of_lists(a, b, place, size);
  else if (kind === "object") {
    const sigma = sigma_beside(a);
    for (const key of new Set([...Object.keys(a), ...Object.keys(b)])) {
      if (!(key in a) || !(key in b)) yield `${place}.${key}: only in the ${key in a ? "first" : "second"}`;
      else if (!kOfTheDay.has(key)) yield* differences(a[key], b[key], `${place}.${key}`, kProbability.test(key) ? 1 : sigma);
    }
  } else if (a !== b) yield `${place}: ${shown(a)} and ${shown(b)}`;
}

// A table or a sentence: its numbers as numbers, all else to the letter.
export const as_values = (text) => {
  try {
    return JSON.parse(text);
  } catch {
    return text.split("\n").map((line) => line.split(/([,;\s]+)/).map((word) => (/^-?\d+\.\d+(e[-+]?\d+)?$/i.test(word) ? Number(word) : word)));
  }
};
