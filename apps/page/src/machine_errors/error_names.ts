// Names of the errors as a machinist reads them: "backlash_a_pos" in the plane ZX is "backlash Z +".
import { axes_of_plane } from "../drawing/angles";
import { plain } from "../drawing/text";

export const error_name = (name: string, plane: string | undefined): string => {
  const [a, b] = axes_of_plane(plane);
  const words: Record<string, string> = { a, b, pos: "+", neg: "−" };
  const read = name.split("_").map((word) => (Object.hasOwn(words, word) ? (words[word] ?? word) : word));
  return plain(read.join(" "), 60);
};

// "um/m" as pictures write it.
export const unit_shown = (unit: string): string => plain(unit, 20).replace(/^um\b/, "µm");
