// Names of the errors as a machinist reads them: "backlash_a_pos" in the plane ZX is "backlash Z +". Of several
// in one text each.
import { axes_of_plane } from "../drawing/angles";
import { plain } from "../drawing/text";

export const error_name = (name: string, plane: string | undefined, most = 60): string => {
  const [a, b] = axes_of_plane(plane);
  const words: Record<string, string> = { a, b, pos: "+", neg: "−" };
  const read = (word: string): string => (Object.hasOwn(words, word) ? (words[word] ?? word) : word);
  const operators = { "-": " less ", "+": " plus " } as const;
  const spaced = name.replace(/(?<=\w)[-+](?=\w)/g, (one) => operators[one as keyof typeof operators]);
  return plain(spaced.replace(/\w*_\w*/g, (one) => one.split("_").map(read).join(" ")), most);
};

// "um/m" as pictures write it.
export const unit_shown = (unit: string): string => plain(unit, 20).replace(/^um\b/, "µm");
