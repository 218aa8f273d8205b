// What the program wrote on two machines, held together: the same keys and strings, and numbers to 1e-9 of their size.
// A number that is nothing but rounding has no size of its own: below 1e-12 of the largest number beside it - in the
// same list, or in the same object and what that holds - it may differ. kTiny is the size below which nothing is told apart.
const kRelative = 1e-9;
const kRounding = 1e-12;
const kTiny = 1e-15;

const kOfTheDay = new Set(["made_on"]);

const size_of = (value) => {
  if (typeof value === "number") return Math.abs(value);
  if (typeof value !== "object" || value === null) return 0;
  let most = 0;
  for (const one of Object.values(value)) most = Math.max(most, size_of(one));
  return most;
};

const kind_of = (value) => (Array.isArray(value) ? "list" : value === null ? "null" : typeof value);

// Lines that say where a and b differ; `size` is of the numbers around.
export function* differences(a, b, place = "", size = 0) {
  const [kind, other] = [kind_of(a), kind_of(b)];
  if (kind !== other) yield `${place}: ${kind} ${JSON.stringify(a)?.slice(0, 60)} and ${other} ${JSON.stringify(b)?.slice(0, 60)}`;
  else if (kind === "number") {
    const apart = Math.abs(a - b);
    if (apart > Math.max(kTiny, kRounding * size, kRelative * Math.max(Math.abs(a), Math.abs(b)))) {
      yield `${place}: ${a} and ${b}, ${(apart / Math.max(Math.abs(a), Math.abs(b))).toExponential(1)} of it`;
    }
  } else if (kind === "list") {
    if (a.length !== b.length) yield `${place}: ${a.length} and ${b.length} entries`;
    const around = Math.max(...a.map((one) => (typeof one === "number" ? Math.abs(one) : 0)), 0) || 0;
    for (let k = 0; k < Math.min(a.length, b.length); ++k) yield* differences(a[k], b[k], `${place}[${k}]`, around);
  } else if (kind === "object") {
    const around = size_of(a);
    for (const key of new Set([...Object.keys(a), ...Object.keys(b)])) {
      if (!(key in a) || !(key in b)) yield `${place}.${key}: only in the ${key in a ? "first" : "second"}`;
      else if (!kOfTheDay.has(key)) yield* differences(a[key], b[key], `${place}.${key}`, around);
    }
  } else if (a !== b) yield `${place}: ${JSON.stringify(a).slice(0, 300)} and ${JSON.stringify(b).slice(0, 300)}`;
}

// A table or a sentence: its numbers as numbers, all else to the letter.
export const as_values = (text) => {
  try {
    return JSON.parse(text);
  } catch {
    return text.split("\n").map((line) => line.split(/([,;\s]+)/).map((word) => (/^-?\d+\.\d+(e[-+]?\d+)?$/i.test(word) ? Number(word) : word)));
  }
};
