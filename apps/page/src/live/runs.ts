// Commands one after the other, with their progress, and a button and a key that stop them. Work that is soon done shows
// nothing.
import { type Engine, Failed, type Ran, Stopped, type Watch } from "../engine";
import { button, element } from "../elements/elements";
import { duration_spoken } from "./spoken";
import type { Message } from "../texts/messages";
import { said, type Sentence, t } from "../texts/texts";
import { type Group, last_part } from "./files";
import { answer_without_advice, type LogWords, without_advice } from "./log_words";
import type { HypothesesPart, Plan, Report, SignalGap, TestHead } from "../report";
import type { Stretch } from "./history_of_steps";

const kSoon_ms = 300;

export interface Job {
  what(): string; // "Searching what is missing", in the page's language
  progress?: (line: string) => void;
}

export interface Work {
  readonly element: HTMLElement;
  run(command: readonly string[], job: Job): Promise<Ran>; // throws Interrupted, or what the engine threw
  call(call: object, job: Job): Promise<Ran>; // likewise
  during<T>(what: () => string, work: (share: (of_it: number) => void) => Promise<T>): Promise<T>; // of work that cannot be stopped
  stop(): void;
  busy(): boolean;
  rewrite(): void; // in another language
}

// With what was being done.
export class Interrupted extends Error {
  constructor(readonly what: () => string) {
    super(what());
  }
}

// "12 of 40"
const share_of = (line: string): number | null => {
  const [, part, whole] = /(\d+) of (\d+)/.exec(line) ?? [];
  return part !== undefined && whole !== undefined && Number(whole) > 0 ? Number(part) / Number(whole) : null;
};

export const work_with = (engine: Engine, say: (text: string) => void): Work => {
  const text = element("span", { class: "what" });
  const bar = element("progress", { max: "1" });
  const stop = button(t.live_stop, t.live_stop_title, () => made.stop());
  const shown = element("div", { class: "live-work" }, text, bar, stop);
  shown.hidden = true;
  shown.dataset.waiting = "0";
  const stopping = new Set<AbortController>(); // of what runs and what waits
  let last: Promise<unknown> = Promise.resolve();
  let waiting = 0;
  let write = (): void => undefined; // what is done, and how far it is

  // How far it is, as it tells itself: `to` takes a share, and from two of them on the time to go is known.
  const show = (what_now: () => string, can_stop: boolean): { hide(): void; to(share: number): void } => {
    const began = performance.now();
    let first: { share: number; at: number } | null = null; // of this stage
    let now: { share: number; at: number } | null = null;
    write = () => {
      const what = what_now();
      const seconds = Math.round((performance.now() - began) / 1000);
      const left_ms = first && now && now.share > first.share ? ((now.at - first.at) * (1 - now.share)) / (now.share - first.share) - (performance.now() - now.at) : null;
      bar.setAttribute("aria-label", what);
      text.textContent =
        seconds < 1
          ? what
          : left_ms === null || !now
            ? t.live_since({ what, seconds })
            : t.live_to_go({ what, seconds, percent: Math.round(100 * now.share), left: duration_spoken(Math.max(0, left_ms)) });
    };
    bar.removeAttribute("value");
    stop.hidden = !can_stop;
    write();
    const soon = setTimeout(() => {
      shown.hidden = false;
      say(what_now());
    }, kSoon_ms);
    const clock = setInterval(write, 1000);
    return {
      hide() {
        clearTimeout(soon);
        clearInterval(clock);
        shown.hidden = true;
      },
      to(share) {
        if (!Number.isFinite(share)) return; // of an empty file
        const at = performance.now();
        if (first === null || (now && share < now.share)) first = { share, at };
        now = { share, at };
        bar.value = share;
      },
    };
  };

  // Each waits for the one before, whatever became of it.
  const queued = <T>(work: () => Promise<T>): Promise<T> => {
    const count = (more: number): void => {
      waiting += more;
      shown.dataset.waiting = String(waiting);
    };
    count(1);
    const mine = last.then(work, work).finally(() => count(-1));
    last = mine.catch(() => undefined);
    return mine;
  };

  const stoppable = ({ what, progress }: Job, ask: (watch: Watch) => Promise<Ran>): Promise<Ran> => {
    const mine = new AbortController();
    stopping.add(mine);
    return queued(async () => {
      const { hide, to } = show(what, true);
      const take_line = (line: string): void => {
        const share = share_of(line);
        if (share !== null) to(share);
        progress?.(line);
      };
      try {
        return await ask({ progress: take_line, stop: mine.signal });
      } catch (error) {
        throw error instanceof Stopped ? new Interrupted(what) : error;
      } finally {
        stopping.delete(mine);
        hide();
      }
    });
  };

  const made: Work = {
    element: shown,
    run: (command, job) => stoppable(job, (watch) => engine.run(command, watch)),
    call: (call, job) => stoppable(job, (watch) => engine.call(call, watch)),
    during: (what, work) =>
      queued(async () => {
        const { hide, to } = show(what, false);
        try {
          return await work(to);
        } finally {
          hide();
        }
      }),
    stop() {
      for (const one of stopping) one.abort();
    },
    busy: () => waiting > 0,
    rewrite() {
      stop.textContent = t.live_stop;
      stop.title = t.live_stop_title;
      write();
    },
  };
  return made;
};

// The command lines that the page runs, and those that the program proposes.

// Ballbar tests: a row each, or over time, as the history of their machine; "": their errors and circles on one page.
export type View = "" | "table" | "history";

// What is looked at.
export interface Subject {
  group: Group;
  data: readonly string[]; // words: the group's own, or the folder it lies in
  model: string; // path; "": none
  target: string; // "": the model's own, or all
  compared: readonly string[]; // data to compare with; none: it is not compared
  view: View; // of ballbar tests
  tolerance_um: number | null; // of their circularity
  log: LogWords; // how a log among them is read
  targets: readonly string[]; // its columns to explain, by their headers; none: all that are measured
  left_out: readonly Stretch[]; // readings that are not fitted
}

const targeted = ({ group, target }: Subject): string[] =>
  target === "" || group.kind === "recordings" ? [] : ["--target", target];

const of_model = (subject: Subject): string[] =>
  subject.model === "" ? [] : ["--model", subject.model, ...targeted(subject)];

const of_rows = ({ left_out }: Subject): string[] =>
  left_out.map(({ from_s, to_s }) => `--leave-out-times=${from_s}..${to_s}`);

// What is looked at, as behind `ballbar report`.
export const look_words = (subject: Subject): string[] => [
  ...subject.data,
  ...subject.log,
  ...of_rows(subject),
  ...of_model(subject),
  ...subject.compared.flatMap((word) => ["--compare", word]),
];

// The same with a model in any case: without a file what every model has before its first effect.
export const model_words = (subject: Subject): string[] => [
  ...look_words(subject),
  ...(subject.model === "" ? ["--diagnose", ...targeted(subject)] : []),
];

export interface Setting {
  effect: string;
  parameter: string;
  value: number;
}

// What a hand does to a model, beside adding effects.
export interface HandChange {
  removed?: readonly string[]; // labels of effects
  held?: readonly Setting[];
  freed?: readonly Setting[]; // from these values on
}

// What could be added.
export interface EffectChoice {
  effect: string;
  columns: readonly (readonly string[])[]; // each choice, in the order of the effect's inputs
  labels: readonly string[]; // of each choice
}

// As --set has it.
export const setting_text = ({ effect, parameter, value }: Setting): string => `${effect}.${parameter}=${value}`;

const of_model_and_target = (subject: Subject): string[] => [
  ...subject.data,
  ...subject.log,
  ...of_rows(subject),
  ...(subject.model === "" ? targeted(subject) : of_model(subject)),
];

// A label that holds a comma within a column's name could not be typed.
export const can_be_typed = (columns: readonly string[]): boolean => columns.every((column) => !column.includes(","));

// Of a set of effects.
export const set_key = (effects: readonly string[]): string => effects.join("\n");

export const try_words = (subject: Subject, effects: readonly string[]): string[] => [
  "add", ...effects, ...of_model_and_target(subject), "--dry-run", "--json",
];

export const plan_words = (subject: Subject, hours: number, folder: string): string[] => [
  "plan", ...of_model_and_target(subject), "--hours", String(hours), "--out", folder, "--json",
];

// What is asked of the program about what is looked at, and what it answers: the report, the search, a step forth and
// back.

// What the program said why it did not.
export class Refused extends Error {}

interface Said {
  sentence: string;
  message?: Message[];
}

const sentence_of = ({ err, status }: Ran): string => {
  const lines = err.trim().split("\n");
  const fault = lines.filter((line) => line.startsWith("ballbar: ")).at(-1) ?? lines.at(-1) ?? "";
  return fault.replace(/^ballbar: /, "") || t.live_ended_with({ status });
};

export const answer_of = <T>(ran: Ran): T => {
  if (ran.status !== 0) throw new Refused(sentence_of(ran));
  return answer_without_advice(JSON.parse(ran.out) as T);
};

export interface PlannedFiles {
  plan: Plan;
  files: readonly { name: string; bytes: Uint8Array }[]; // that the program wrote
}

// Keys of a report, to put in the place of its own.
export type Part = Partial<Report>;

export interface Runs {
  report(subject: Subject): Promise<Report>; // with the fit; or the history
  tests(data: readonly string[]): Promise<TestHead[]>; // the ballbar tests among files
  fitted(subject: Subject): Promise<Part>; // of another model
  search(subject: Subject, progress: (line: string) => void): Promise<Part>;
  set(subject: Subject, settings: readonly Setting[]): Promise<Part>;
  add(subject: Subject, effects: readonly string[]): Promise<Part>; // the fit alone: no file is written
  // Into the file, if the data support it, or keep is true.
  revise(subject: Subject, model: string, keep: boolean): Promise<Part & Said & { kept: boolean }>;
  rmse_with(subject: Subject, effects: readonly string[]): Promise<number>; // that add would leave, um
  change(subject: Subject, change: HandChange): Promise<Part>; // the fit alone, as add
  take_back(subject: Subject): Promise<void>; // what was added or changed, and is in no file
  choices(subject: Subject): Promise<readonly EffectChoice[]>;
  compare(subject: Subject, hypotheses: readonly (readonly string[])[]): Promise<HypothesesPart>;
  try(subject: Subject, effects: readonly string[]): Promise<() => Sentence>; // what they would change
  plan(subject: Subject, hours: number): Promise<PlannedFiles>; // of the next test
  gap(subject: Subject): Promise<SignalGap | null>; // the longest, where a fit is refused for such; null: not for them
  undo(model: string): Promise<void>;
  model_text(subject: Subject): Promise<string>; // its file, beginning with the values that are fitted
  free_name(folder: string, name: string): string;
}

export const runs_with = (engine: Engine, work: Work): Runs => {
  const call = async <T>(name: string, words: string[], job: Job, more: object = {}): Promise<T> =>
    answer_of<T>(await work.call({ call: name, words, ...more }, job));
  const made: Runs = {
    report: (subject) =>
      subject.view === ""
        ? call("report", look_words(subject), { what: () => t.live_reading })
        : call(subject.view, [...subject.data, ...subject.log], { what: () => t.live_reading }, {
            title: subject.group.title,
            ...(subject.tolerance_um === null ? {} : { tolerance_um: subject.tolerance_um }),
          }),
    tests: async (data) => (await call<{ tests: TestHead[] }>("tests", [...data], { what: () => t.live_reading })).tests,
    fitted: (subject) => call("fitted", model_words(subject), { what: () => t.live_reading }),
    search: (subject, progress) => call("search", model_words(subject), { what: () => t.live_searching, progress }),
    set: (subject, settings) =>
      call("hold", model_words(subject), { what: () => t.live_moving }, { settings: settings.map(setting_text) }),
    add: (subject, effects) =>
      call("add", model_words(subject), { what: () => t.live_adding({ effect: effects.join(", ") }) }, { effects }),
    revise: (subject, model, keep) => call("revise", model_words(subject), { what: () => t.live_testing }, { model, keep }),
    rmse_with: async (subject, effects) =>
      (await call<{ rmse_um: number }>("with", model_words(subject), { what: () => t.live_promising }, { effects })).rmse_um,
    change: (subject, { removed = [], held = [], freed = [] }) =>
      call("change", model_words(subject), { what: () => t.hands_fitting }, { removed, held: held.map(setting_text), freed: freed.map(setting_text) }),
    choices: async (subject) =>
      (await call<{ effects: EffectChoice[] }>("choices", model_words(subject), { what: () => t.live_reading })).effects,
    compare: (subject, hypotheses) => call("compare", model_words(subject), { what: () => t.hands_comparing }, { hypotheses }),
    take_back: (subject) => call("take_back", model_words(subject), { what: () => t.live_undoing }),
    try: async (subject, effects) => {
      const ran = await work.run(try_words(subject, effects), { what: () => t.live_trying({ effect: effects.join(", ") }) });
      const { sentence, message } = answer_of<Said>(ran);
      return () => said(sentence, message);
    },
    async plan(subject, hours) {
      const folder = made.free_name("plans", "plan");
      const plan = answer_of<Plan>(await work.run(plan_words(subject, hours, folder), { what: () => t.live_planning }));
      const paths = engine.list().flatMap(({ path }) => (path.startsWith(`${folder}/`) ? [path] : []));
      return { plan, files: await Promise.all(paths.map(async (path) => ({ name: last_part(path), bytes: await engine.get(path) }))) };
    },
    gap: async ({ data, log }) => (await call<{ gap: SignalGap | null }>("gaps", [...data, ...log], { what: () => t.live_reading })).gap,
    model_text: async (subject) => (await call<{ text: string }>("text", model_words(subject), { what: () => t.live_reading })).text,
    async undo(model) {
      const ran = await work.run(["undo", "--model", model], { what: () => t.live_undoing });
      if (ran.status !== 0) throw new Refused(sentence_of(ran));
    },
    free_name(folder, name) {
      const taken = new Set(engine.list().map(({ path }) => path));
      const [stem = name, ending = ""] = name.split(/(?=\.[a-z]+$)/);
      let free = `${folder}/${name}`;
      for (let number = 2; taken.has(free); ++number) free = `${folder}/${stem}-${number}${ending}`;
      return free;
    },
  };
  return made;
};

// Why something was not done, in words for a reader.

export const reason = (error: unknown): string => {
  const text = error instanceof Error ? error.message : String(error);
  if (error instanceof Interrupted) return t.live_stopped({ what: error.what() });
  if (error instanceof Refused) return /^std::|bad_alloc/.test(text) ? t.live_too_much : without_advice(text) || t.live_refused;
  if (!(error instanceof Failed)) return text;
  return /memory|bad_alloc|OOM/i.test(text) ? t.live_out_of_memory : t.live_failed({ why: text });
};
