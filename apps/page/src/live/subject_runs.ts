// What is asked of the program about what is looked at, and what it answers: the report, the search, a step forth and
// back.
import { add_words, report_words, search_words, set_words, try_words, type Setting, type Subject } from "./commands";
import type { Engine, Ran } from "../engine";
import type { Report } from "../report";
import type { Work } from "./work";
import { t } from "../texts/texts";

// What the program said why it did not.
export class Refused extends Error {}

const sentence_of = ({ err, status }: Ran): string => {
  const lines = err.trim().split("\n");
  const fault = lines.filter((line) => line.startsWith("ballbar: ")).at(-1) ?? lines.at(-1) ?? "";
  return fault.replace(/^ballbar: /, "") || t.live_ended_with({ status });
};

export const answer_of = <T>(ran: Ran): T => {
  if (ran.status !== 0) throw new Refused(sentence_of(ran));
  return JSON.parse(ran.out) as T;
};

export interface Added {
  revisions: { sentence: string }[];
}

export interface Runs {
  report(subject: Subject): Promise<Report>;
  search(subject: Subject, progress: (line: string) => void): Promise<Report>;
  set(subject: Subject, settings: readonly Setting[]): Promise<Report>;
  add(subject: Subject, effects: readonly string[], model: string): Promise<Added>;
  try(subject: Subject, effect: string): Promise<string>; // what it would change
  undo(model: string): Promise<void>;
  free_name(folder: string, name: string): string;
}

export const runs_with = (engine: Engine, work: Work): Runs => ({
  report: async (subject) => answer_of(await work.run(report_words(subject), { what: t.live_reading })),
  search: async (subject, progress) => answer_of(await work.run(search_words(subject), { what: t.live_searching, progress })),
  set: async (subject, settings) => answer_of(await work.run(set_words(subject, settings), { what: t.live_moving })),
  add: async (subject, effects, model) =>
    answer_of(await work.run(add_words(subject, effects, model), { what: t.live_adding({ effect: effects.join(", ") }) })),
  try: async (subject, effect) =>
    answer_of<{ sentence: string }>(await work.run(try_words(subject, effect), { what: t.live_trying({ effect }) })).sentence,
  async undo(model) {
    const ran = await work.run(["undo", "--model", model], { what: t.live_undoing });
    if (ran.status !== 0) throw new Refused(sentence_of(ran));
  },
  free_name(folder, name) {
    const taken = new Set(engine.list().map(({ path }) => path));
    const [stem = name, ending = ""] = name.split(/(?=\.[a-z]+$)/);
    let free = `${folder}/${name}`;
    for (let number = 2; taken.has(free); ++number) free = `${folder}/${stem}-${number}${ending}`;
    return free;
  },
});
