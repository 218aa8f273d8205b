// The candidates of a diagnosis in the order of the terminal's table: the best set first, then by evidence; after them
// what an unexplained misfit goes with. A candidate's place in this order is how picture and tables name it.
import type { Candidate, Diagnosed } from "../report";
import { plain } from "../drawing/text";

export interface Ranked {
  candidate: Candidate;
  key: string; // its place, as text
  name: string; // short, to be written beside a curve: "1* lagged_expansion(T_room_degC)"
}

const by_rank = (a: Candidate, b: Candidate): number =>
  a.in_best_set !== b.in_best_set ? (a.in_best_set ? -1 : 1) : (b.evidence ?? 0) - (a.evidence ?? 0);

export const ranked_candidates = (found: Diagnosed): Ranked[] =>
  [...found.candidates].sort(by_rank).map((candidate, k) => ({
    candidate,
    key: String(k),
    name: `${k + 1}${candidate.in_best_set ? "*" : "."} ${plain(candidate.label, 44)}`,
  }));

export const ranked_companions = (found: Diagnosed): Ranked[] =>
  found.goes_with.map((candidate, k) => ({
    candidate,
    key: String(found.candidates.length + k),
    name: `goes with ${plain(candidate.label, 44)}`,
  }));
