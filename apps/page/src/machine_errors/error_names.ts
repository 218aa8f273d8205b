// Names of the errors as a machinist reads them: "backlash_a_pos" in the plane ZX is "backlash of Z, +", in the language
// of the page. Of several in one text each.
import { axes_of_plane } from "../drawing/angles";
import { plain } from "../drawing/text";
import type { MachineErrorsPart } from "../report";
import { language, named, t } from "../texts/texts";

export const error_name = (name: string, plane: string | undefined, most = 60): string => {
  if (name.includes("_or_")) {
    const members = name.split("_or_").map((member) => error_name(member, plane, most));
    return plain(members.join(t.errors_or), most);
  }
  const [a, b] = axes_of_plane(plane);
  const axes: Record<string, string> = { a, b };
  const sides: Record<string, string> = { pos: "+", neg: "−", fwd: "→", rev: "←" };
  // What it is, and where: the axis, the side.
  const read = (one: string): string => {
    const [, whole = one, number] = /^(.*)_of_recording_(\d+)$/.exec(one) ?? [];
    const parts = whole.split("_");
    const those = (known: Record<string, string>): string[] => parts.flatMap((part) => (Object.hasOwn(known, part) ? [known[part] ?? ""] : []));
    const what = parts.filter((part) => !Object.hasOwn(axes, part) && !Object.hasOwn(sides, part)).join("_");
    const name = named(t.effects, what).replaceAll("_", " ");
    const [axis] = those(axes);
    const read_name = [axis === undefined ? name : t.errors_of_axis({ name, axis }), ...those(sides)].join(" ");
    return number === undefined ? read_name : t.errors_of_recording({ name: read_name, number });
  };
  const is_name = (word: string): boolean => word.includes("_") || Object.hasOwn(t.effects, word);
  const operators = { "-": ` ${t.errors_less} `, "+": ` ${t.errors_plus} ` } as const;
  // Names first, so that no word of an operator is taken for one.
  const parts = name.split(/(?<=\w)([-+])(?=\w)/);
  const spaced = parts.map((part, k) =>
    k % 2 === 1 ? operators[part as keyof typeof operators] : part.replace(/[a-z]\w*/g, (word) => (is_name(word) ? read(word) : word)),
  );
  return plain(spaced.join("").replaceAll(" with ", ` ${t.errors_with} `), most);
};

type ErrorGroup = MachineErrorsPart["error_groups"][number];

// Errors that the readings cannot separate: "squareness or servo mismatch".
export const group_name = ({ effects }: ErrorGroup, plane: string | undefined): string =>
  effects.map((effect) => error_name(effect, plane)).join(t.errors_or);

// The group that comes before every error; a report of an older program has none.
export const leading_group = ({ error_groups, errors }: MachineErrorsPart): ErrorGroup | undefined =>
  (error_groups ?? []).find(({ rank }) => rank === 1 || !errors.some(({ significant }) => significant === true));

// A name that is typed into commands, "lagged_expansion(T_room_degC)" or "backlash_a_pos". On a page that is not in
// English it stands after what it means.
export const typed_name = (typed: string, most: number): string => {
  const id = /^\w+/.exec(typed)?.[0] ?? "";
  const name = error_name(id, undefined);
  if (language === "en" || name === id.replaceAll("_", " ")) return plain(typed, most);
  return plain(typed === id ? `${name} (${typed})` : `${name}, ${typed}`, most);
};

// An effect in the page's language, without the name that is typed: "delayed expansion (T_room_degC)". An element that
// shows it says the typed one in its title. One of a run has its number, "offset_of_run 2".
export const plain_name = (label: string, most: number): string => {
  const [, id = "", columns = ""] = /^(\w+)\s*(\(.*|\d+)?$/s.exec(label) ?? [];
  if (!Object.hasOwn(t.effects, id)) return typed_name(label, most);
  return plain(`${named(t.effects, id)}${columns === "" ? "" : ` ${columns}`}`, most);
};

// "gain_um_per_K" is a gain.
export const parameter_name = (name: string): string => {
  const stem = name.replace(/_(um|mm|ms|s|Hz|deg|ppm|unit|per)(_.*)?$/, "");
  return plain(named(t.parameters, stem), 40).replaceAll("_", " ") || plain(name, 40);
};

// With the name that is typed, on a page that is not in English.
export const typed_parameter = (name: string): string =>
  language === "en" ? plain(name, 60) : plain(`${parameter_name(name)} (${name})`, 60);

// "um/m" as pictures write it.
export const unit_shown = (unit: string): string => plain(unit, 20).replace(/^um\b/, "µm");
