// The candidates of a diagnosis: what is proposed first, then by P. A candidate's place in this order is how picture and
// table name it.
import type { Candidate, Diagnosed } from "../report";
import { plain } from "../drawing/text";

export interface Ranked {
  candidate: Candidate;
  starred: boolean; // proposed: what the button adds or tries
  drawn: boolean; // of the set that is drawn
  alone: boolean; // fitted alone beside the model, not with others of its set
  key: string; // its place, as text
  name: string; // short, to be written beside a curve: "1* lagged_expansion(T_room_degC)"
}

// The set that is drawn: the best one, or the closest that the catalogue comes, which is not accepted.
export type SetName = "best" | "closest";

// null: none is, for nothing was found.
export const set_name = ({ verdict }: Diagnosed): SetName | null => {
  switch (verdict) {
    case "nothing":
      return null;
    case "named":
    case "probable":
    case "equivalent":
      return "best";
    default:
      return "closest";
  }
};

export const best_set = (found: Diagnosed): Candidate[] =>
  set_name(found) === null ? [] : found.candidates.filter((candidate) => candidate.in_best_set);

export const ranked_candidates = (found: Diagnosed): Ranked[] => {
  const set = best_set(found);
  const together = found.candidates.filter((candidate) => candidate.in_best_set).length;
  const proposed = found.next_action?.labels ?? [];
  const is_proposed = ({ label }: Candidate): boolean => proposed.includes(label);
  return [...found.candidates]
    .sort((a, b) => Number(is_proposed(b)) - Number(is_proposed(a)) || (b.p ?? 0) - (a.p ?? 0))
    .map((candidate, k) => {
      const starred = is_proposed(candidate);
      return {
        candidate,
        starred,
        drawn: set.includes(candidate),
        alone: candidate.in_best_set && together === 1,
        key: String(k),
        name: `${k + 1}${starred ? "*" : "."} ${plain(candidate.label, 44)}`,
      };
    });
};
