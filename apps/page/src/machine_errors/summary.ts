// All tests in one table: of each the numbers of ISO 230-4 against the limits of its file, its largest error and what
// mending that gains. A column a test, as they are few; many have a row each.
import { type ErrorTest, ranked_errors, type RankedError } from "./error_curves";
import { error_name, group_name, leading_group, unit_shown } from "./error_names";
import { once_each } from "../recordings/recording_groups";
import { plain } from "../drawing/text";
import { decimals_for, shown, with_sigma } from "../drawing/theme";
import type { TextTable } from "../picture";
import type { FitPart, Report, Result } from "../report";
import { t } from "../texts/texts";

const kColumns = 4; // tests

interface Iso {
  rows: readonly Result[]; // of both directions, else of the only one
  both: boolean;
}

// Of the pair that a test's first recordings are, else of its recording alone.
export const iso_of = ({ pairs = [], results }: FitPart, { part }: ErrorTest): Iso => {
  const pair = pairs.findIndex((places) => places.every((place) => part.recordings.includes(place)));
  const is_pair = ({ rows }: FitPart["results"][number]): boolean => rows.some(({ key }) => key === "g_ccw_um");
  const of_pairs = results.filter(is_pair);
  const both = pair < 0 ? undefined : of_pairs[pair];
  const alone = results.filter((one) => !is_pair(one))[part.recordings[0] ?? -1];
  return { rows: (both ?? alone)?.rows ?? [], both: both !== undefined };
};

const row_of = ({ rows }: Iso, key: string): Result | undefined => rows.find((row) => row.key === key);

// The circular deviation G, direction by direction.
const circular_deviations = (iso: Iso, test: ErrorTest): { direction: string; row: Result }[] => {
  const keys = iso.both ? ["g_ccw_um", "g_cw_um"] : ["circularity_um"];
  return keys.flatMap((key) => {
    const row = row_of(iso, key);
    const direction = key === "g_ccw_um" ? "CCW" : key === "g_cw_um" ? "CW" : (test.recordings[0]?.direction ?? "");
    return row ? [{ direction, row }] : [];
  });
};

export const limit_text = ({ limits }: Result): string => {
  const [lower, upper] = limits ?? [null, null];
  if (lower === null && upper === null) return "–";
  if (lower === null) return `≤ ${shown(upper)}`;
  return upper === null ? `≥ ${shown(lower)}` : `${shown(lower)} … ${shown(upper)}`;
};

// Numbers of one kind, as of both directions: "6.65 / 6.38", with their limit and by it the worst judgement.
const order = ["fail", "warning", "pass"] as const;
const judged = (rows: readonly Result[]): string => {
  if (rows.length === 0) return "–";
  const values = rows.map(({ ours, decimals }) => shown(ours, decimals)).join(" / ");
  const judgement = order.find((one) => rows.some((row) => row.judgement === one));
  const limits = [...new Set(rows.map(limit_text).filter((text) => text !== "–"))].join(", ");
  return judgement ? `${values} (${limits}: ${t.judgements[judgement]})` : values;
};

// The circular deviation G of the direction that is out more.
const largest_g_um = ({ recordings }: ErrorTest): number => Math.max(...recordings.map(({ circularity_um }) => circularity_um ?? 0));

// The test that is out most, by the number that stands first; there is one.
export const worst_of = (tests: readonly ErrorTest[]): ErrorTest =>
  tests.reduce((worst, test) => (largest_g_um(test) > largest_g_um(worst) ? test : worst));

const planes_of = (tests: readonly ErrorTest[]): string[] => tests.map(({ recordings: [first] }) => first?.plane ?? "");
const of_planes = (tests: readonly ErrorTest[]): boolean => new Set(planes_of(tests)).size === tests.length;

const test_names = (tests: readonly ErrorTest[]): string[] => {
  return of_planes(tests)
    ? planes_of(tests)
    : once_each(tests.map(({ recordings: [first] }) => plain(`${first?.plane}, ${first?.test}`, 40)));
};

// The one to mend first: of those that are significant, where none gains.
const largest_error = ({ part }: ErrorTest): RankedError | undefined =>
  ranked_errors(part).find(({ first }) => first.rank !== null || first.significant === true);

const largest_of = (test: ErrorTest): string => {
  const group = leading_group(test.part);
  if (group) return group_name(group, test.recordings[0]?.plane);
  const largest = largest_error(test);
  return largest ? error_name(largest.effect, test.recordings[0]?.plane) : "–";
};

const without_largest = (test: ErrorTest): string =>
  shown((leading_group(test.part) ?? largest_error(test)?.first)?.circularity_without_um, 2);

const value_of = ({ part }: ErrorTest, name: string): string => {
  const row = part.errors.find((one) => one.name === name);
  return row ? `${with_sigma(row.value, row.sigma, Math.min(2, decimals_for(row.value, row.sigma)))} ${unit_shown(row.unit)}` : "–";
};

interface Quantity {
  name: string;
  of: (test: ErrorTest) => string;
  brief?: boolean; // of many tests too
}

const quantities = (fit: FitPart): Quantity[] => {
  const found = (test: ErrorTest, keys: readonly string[]): Result[] => keys.flatMap((key) => row_of(iso_of(fit, test), key) ?? []);
  const by_keys = (...keys: string[]) => (test: ErrorTest) => judged(found(test, keys));
  const from_to = (least: string, most: string) => (test: ErrorTest): string => {
    const [from, to] = found(test, [least, most]);
    return from && to ? `${shown(from.ours, from.decimals)} … ${shown(to.ours, to.decimals)}` : "–";
  };
  const without = (test: ErrorTest): string => {
    const [one, all] = [without_largest(test), shown(test.part.circularity_without_all_um, 2)];
    return one === all ? one : `${one} / ${all}`;
  };
  return [
    { name: t.errors_g, of: (test) => judged(circular_deviations(iso_of(fit, test), test).map(({ row }) => row)), brief: true },
    { name: t.errors_g_both, of: by_keys("bidirectional_2005_um") },
    { name: t.errors_both_runs, of: ({ part }) => shown(part.circularity_um, 2) },
    { name: t.errors_f_ccw, of: from_to("f_min_ccw_um", "f_max_ccw_um") },
    { name: t.errors_f_cw, of: from_to("f_min_cw_um", "f_max_cw_um") },
    { name: t.errors_hysteresis, of: by_keys("h_um") },
    { name: t.errors_largest, of: largest_of, brief: true },
    { name: t.errors_g_mended, of: without, brief: true },
    { name: t.errors_squareness, of: (test) => value_of(test, "squareness"), brief: true },
  ];
};

export const summary_table = ({ fit }: Report, tests: readonly ErrorTest[], picture: string): TextTable | undefined => {
  if (!fit) return undefined;
  const names = test_names(tests);
  const few = tests.length <= kColumns;
  const rows = quantities(fit).filter(({ of, brief }) => (few || brief) && tests.some((test) => of(test) !== "–"));
  const title = tests.length === 1 ? t.errors_summary_of({ test: names[0] ?? "" }) : t.errors_summary({ n: tests.length });
  if (few) {
    return { title, heading: ["µm", ...names], rows: rows.map(({ name, of }) => [name, ...tests.map(of)]) };
  }
  return {
    title,
    heading: [t.errors_test, ...rows.map(({ name }) => name)],
    rows: tests.map((test, k) => [names[k] ?? "", ...rows.map(({ of }) => of(test))]),
    choose: { picture, key: "test", values: tests.map(({ value }) => value), focus_keeps: true },
    at_first: 6,
  };
};

// "Circular deviation G by ISO 230-4: 6.65 µm CCW, 6.38 µm CW; the file's limit is 10 µm: pass."
export const headline = ({ fit }: Report, tests: readonly ErrorTest[], test: ErrorTest): string => {
  const iso = fit ? iso_of(fit, test) : { rows: [], both: false };
  const each = circular_deviations(iso, test);
  if (each.length === 0) return t.errors_circularity_is({ value: shown(test.part.circularity_um, 2) });
  const g = each.map(({ direction, row }) => `${shown(row.ours, row.decimals)} µm ${direction}`.trim()).join(", ");
  const judgement = order.find((one) => each.some(({ row }) => row.judgement === one));
  const limit = each.map(({ row }) => limit_text(row)).find((text) => text !== "–") ?? "";
  const told = judgement ? t.errors_headline_limit({ limit, judgement: t.judgements[judgement] }) : "";
  const plane = test.recordings[0]?.plane ?? "";
  if (tests.length === 1) return t.errors_headline({ plane, g, told });
  const name = test_names(tests)[tests.indexOf(test)] ?? "";
  if (test !== worst_of(tests)) return t.errors_headline({ plane: name, g, told });
  const worst = { name, n: tests.length, g, told };
  return of_planes(tests) ? t.errors_headline_worst_plane(worst) : t.errors_headline_worst_test(worst);
};
