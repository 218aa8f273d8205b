// What is asked of the program about what is looked at, and what it answers: the report, the search, a step forth and
// back.
import { look_words, model_words, setting_text, try_words, type Setting, type Subject } from "./commands";
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

// Keys of a report, to put in the place of its own.
export type Part = Partial<Report>;

export interface Runs {
  report(subject: Subject): Promise<Report>; // with the fit
  fitted(subject: Subject): Promise<Part>; // of another model
  search(subject: Subject, progress: (line: string) => void): Promise<Part>;
  set(subject: Subject, settings: readonly Setting[]): Promise<Part>;
  add(subject: Subject, effects: readonly string[]): Promise<Part>; // the fit alone: no file is written
  revise(subject: Subject, model: string): Promise<Part & { sentence: string; supported: boolean }>; // the file too
  take_back(subject: Subject): Promise<void>; // what was added, and is in no file
  try(subject: Subject, effect: string): Promise<string>; // what it would change
  undo(model: string): Promise<void>;
  free_name(folder: string, name: string): string;
}

export const runs_with = (engine: Engine, work: Work): Runs => ({
  report: async (subject) =>
    answer_of(await work.call({ call: "report", words: look_words(subject) }, { what: t.live_reading })),
  fitted: async (subject) =>
    answer_of(await work.call({ call: "fitted", words: model_words(subject) }, { what: t.live_reading })),
  search: async (subject, progress) =>
    answer_of(await work.call({ call: "search", words: model_words(subject) }, { what: t.live_searching, progress })),
  set: async (subject, settings) => {
    const call = { call: "hold", words: model_words(subject), settings: settings.map(setting_text) };
    return answer_of(await work.call(call, { what: t.live_moving }));
  },
  add: async (subject, effects) =>
    answer_of(
      await work.call({ call: "add", words: model_words(subject), effects }, { what: t.live_adding({ effect: effects.join(", ") }) }),
    ),
  revise: async (subject, model) =>
    answer_of(await work.call({ call: "revise", words: model_words(subject), model }, { what: t.live_testing })),
  take_back: async (subject) => {
    answer_of(await work.call({ call: "take_back", words: model_words(subject) }, { what: t.live_undoing }));
  },
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
