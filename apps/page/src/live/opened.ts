// The open data: a group of files with its report and its interactive model, and the faults of files.
import { catalogue_of } from "./catalogue";
import { type Columns, columns_with } from "./columns";
import { answer_of, Interrupted, look_words, reason, Refused, type Runs, type Subject, type Work } from "./runs";
import { with_said } from "./log_words";
import type { Engine, Sample } from "../engine";
import { type Group, groups_of, type Held, is_within, last_part } from "./files";
import type { Intake, Kept, Store } from "./intake";
import type { LivePage } from "./live_page";
import { type Loop, loop_of } from "./loop";
import type { Report, TestHead } from "../report";
import { look_at, type Other, others_of, relation_of } from "./tests";
import { t } from "../texts/texts";
import { extent } from "../drawing/columns";
import { files_of } from "../drawing/command";

export interface OpenedOf {
  engine: Engine;
  work: Work;
  runs: Runs;
  intake: Intake;
  store: Store | null;
  page: LivePage;
  tell(text: string): void; // what went wrong; "": nothing
  drawn(): void; // another report is on the page
  left(why: string): void; // none is
}

export interface Opened {
  columns: Columns;
  subject(): Subject | null;
  report(): Report | null;
  loop(): Loop | null;
  groups(): Group[];
  tests(group: Group): readonly TestHead[]; // that are known
  others(): Other[]; // what is looked at may be compared with
  // Opens tests of the group, or compares two, by their names or paths; null: they are not here.
  opening(tests: Pick<Subject, "data" | "compared">): (() => void) | null;
  open(group: Group, as?: Partial<Subject>): Promise<void>;
  diagnose(): Promise<void>; // without a model: what every model has before its first effect
  came(paths: readonly string[]): Promise<void>; // files that are new
  sample(sample: Sample): Promise<void>;
  again(kept: Kept): Promise<void>;
  show(report: Report): void; // that nothing is behind
  rewrite(): void; // in another language
  leave(why: string): void;
  forget(): void;
  unsaved(): boolean; // whether something was done by hand that is in no file yet
  saved(): void;
}

const kShort_ms = 3000; // to fit

// Such lie beside data, and are no data.
const is_no_data = ({ name, head }: Held): boolean =>
  /\.(md|sh|py|svg|png|jpe?g)$|(^|\/)[A-Z]+$/i.test(name) || head.includes('"ballbar-');

const kind_of_data = (files: readonly Held[], data: readonly string[]): Group["kind"] => {
  switch (files.find(({ path }) => data.some((word) => is_within(word, path)))?.kind) {
    case "recording":
      return "recordings";
    case "series":
      return "series";
    case "runs":
      return "runs";
    default:
      return "session"; // its file, or its folder
  }
};

export const opened_with = ({ engine, work, runs, intake, store, page, tell, drawn, left }: OpenedOf): Opened => {
  let subject: Subject | null = null;
  let report: Report | null = null;
  let loop: Loop | null = null;
  let last: Subject | null = null; // that was opened, or was to be
  const read_as = new Map<string, Pick<Subject, "log" | "targets">>(); // by group
  const stated = new Map<string, Group>(); // groups that are not found but said: of samples, of saved pages
  let unsaved = false;
  const models = new Map<string, string>(); // the text of each as it came in, or was saved
  const catalogue = catalogue_of(engine);
  const columns = columns_with({
    work,
    read: (group, as) => open(group, { ...(last?.group.key === group.key ? (subject ?? last) : {}), ...as, target: "" }),
  });

  // Why, with files by their own names.
  const why = (error: unknown): string => intake.held().reduce((text, { path, name }) => text.replaceAll(path, name), reason(error));
  // One that the next stopped has nothing to tell.
  let attempts = 0;
  const attempt = async (act: () => Promise<void>): Promise<void> => {
    const mine = ++attempts;
    tell("");
    try {
      await act();
    } catch (error) {
      if (error instanceof Interrupted && mine !== attempts) return;
      if (report) tell(why(error));
      else leave(why(error));
    }
  };

  const tests = new Map<string, readonly TestHead[]>(); // by group
  const tests_known = ({ key }: Group): readonly TestHead[] => tests.get(key) ?? [];
  const tests_of = async (group: Group): Promise<readonly TestHead[]> => {
    if (group.kind !== "recordings") return [];
    const known = tests.get(group.key);
    if (known) return known;
    try {
      const found = await runs.tests(group.data);
      tests.set(group.key, found);
      return found;
    } catch (error) {
      if (error instanceof Refused) return []; // it is told when they are opened
      throw error;
    }
  };
  // Of these files, in whatever group.
  const tests_in = (files: readonly string[]): TestHead[] =>
    [...tests.values()].flat().filter((test) => files_of(test).some((file) => files.includes(file)));

  const group_of = (title: string, files: readonly Held[], data: readonly string[]): Group => {
    const models = files.filter(({ kind }) => kind === "model" || kind === "trained");
    const group = { key: data.join("\n"), title, kind: kind_of_data(files, data), data, files, models };
    stated.set(group.key, group);
    return group;
  };

  const keep_state = (): void => {
    page.made_with(subject ? look_words({ ...subject, data: [] }).join(" ") : "");
    if (!subject) return;
    const { group, model, target, data, log, targets, compared, view, tolerance_um, left_out } = subject;
    // Of one of several tests the group, from which it is chosen again.
    const words = group.kind === "recordings" && compared.length === 0 ? group.data : data;
    const saved_model = model === "" ? undefined : (models.get(model) ?? ""); // made here: nothing is saved
    const state = { when: Date.now(), title: group.title, data: words, model, target, log, targets, compared, view, tolerance_um, left_out, unsaved };
    store?.say({ ...state, ...(saved_model === undefined ? {} : { saved_model }) }).catch(() => undefined);
  };

  const text_of = async (model: string): Promise<string> => new TextDecoder().decode(await engine.get(model).catch(() => new Uint8Array()));
  // An effect that was added and taken back leaves nothing to save.
  const note_change = async (model: string): Promise<void> => {
    await intake.written(model);
    unsaved = (await text_of(model)) !== (models.get(model) ?? "");
    keep_state();
  };

  // What the program says of a file alone; "": nothing against it.
  const fault_of = async (path: string): Promise<string> => {
    try {
      answer_of(await work.run(["report", path, "--json"], { what: () => t.live_checking({ name: path }) }));
      return "";
    } catch (error) {
      if (error instanceof Refused) return why(error);
      throw error;
    }
  };
  // Those that can be read; what is wrong with the others stands beside them.
  const sound_of = async (paths: readonly string[]): Promise<string[]> => {
    const sound: string[] = [];
    for (const path of paths) {
      const fault = await fault_of(path);
      if (fault === "") sound.push(path);
      else intake.faults().set(path, fault);
    }
    return sound;
  };
  // What the program left out, and why, stands beside these files too.
  const note_skipped = async ({ files }: Group, { skipped = [] }: Report): Promise<void> => {
    const paths = files.map(({ path }) => path);
    await sound_of(paths.filter((path) => skipped.some(({ file }) => path.endsWith(`/${file}`))));
  };

  const make_loop = async (of: Subject, first: Report): Promise<Loop | null> => {
    const checked = first.check?.targets.map(({ target }) => target) ?? [];
    const all = checked.length > 0 ? checked : of.group.kind === "recordings" ? [] : targets_in(first);
    const wanted = columns.targets(of).filter((target) => all.includes(target) || (checked.length === 0 && measured_in(first).some(({ name }) => name === target)));
    const targets = wanted.length > 0 ? wanted : all;
    if (targets.length === 0) return null;
    const chosen = of.target || (targets.length > 1 || checked.length === 0 || wanted.length > 0 ? (targets[0] ?? "") : "");
    const made = loop_of({
      subject: { ...of, target: chosen },
      targets,
      runs,
      work,
      catalogue: await catalogue,
      page: page.state,
      bytes_of: (path) => engine.get(path),
      put: (path, bytes) => engine.put(path, bytes),
      has_unit: (target) => measured_in(first).every(({ name, unit }) => name !== target || unit !== ""),
      state_unit: () => columns.button.click(),
      across(gap_s, search) {
        const of = last;
        if (!of) return;
        void open(of.group, { ...of, log: with_said(of.log, "max-gap", `${gap_s}s`) }).then(() => {
          if (search && of.model === "") void loop?.search(); // with a model it is made by itself
        });
      },
      add_figure: (figure) => page.add(figure),
      changed(now, next) {
        if (loop !== made) return; // an answer about what is no longer open
        if (next.model !== "" && report !== now && (report !== null || next.model !== subject?.model)) note_change(next.model).catch(() => undefined); // it was closed meanwhile
        const again = report !== null;
        report = now;
        subject = next;
        keep_state();
        page.show(now, loop, again);
        drawn();
      },
    });
    return made;
  };

  const show_alone = (next: Subject | null, first: Report): void => {
    subject = next;
    report = first;
    loop = null;
    keep_state();
    page.forget();
    page.show(first, null, false);
    drawn();
  };

  const show = async (next: Subject): Promise<void> => {
    const began = performance.now();
    const first = await runs.report(next);
    const took_ms = performance.now() - began;
    await note_skipped(next.group, first);
    page.forget();
    const its_loop = await make_loop(next, first);
    if (!its_loop) return show_alone(next, first);
    subject = next;
    report = null;
    loop = its_loop;
    loop.show(first);
    // Of many rows and models the search takes minutes: then it is asked for.
    if (next.model !== "" && took_ms < kShort_ms) void loop.search();
  };

  const leave = (why: string): void => {
    subject = null;
    report = null;
    loop = null;
    page.clear();
    left(why);
  };

  const open_page = async (group: Group): Promise<void> => {
    const [file] = group.files;
    if (!file) return;
    try {
      const { read, held, data, model } = await intake.files_of_page(file);
      if (data.length > 0) return await open(group_of(group.title, held, data), { model, log: read.log });
      show_alone({ group, data: [], model: "", target: "", compared: [], view: "", tolerance_um: null, log: [], targets: [], left_out: [] }, read.report);
    } catch (error) {
      intake.faults().set(file.path, why(error));
      leave(why(error));
    }
  };

  const open = (group: Group, as: Partial<Subject> = {}): Promise<void> =>
    attempt(async () => {
      work.stop();
      if (group.kind === "report") {
        columns.forget();
        return open_page(group);
      }
      const [model] = group.models.length === 1 ? group.models.map(({ path }) => path) : [""];
      const heads = await tests_of(group);
      const look = as.data || as.compared || as.view !== undefined || model !== "" ? {} : look_at(heads);
      const next: Subject = {
        group, data: group.data, model: model ?? "", target: "", compared: [], view: "", tolerance_um: null, log: [], targets: [], left_out: [],
        ...read_as.get(group.key), ...look, ...as,
      };
      if (next.model !== "" || next.compared.length > 0) next.view = "";
      if (last?.group.key === group.key && last.log.join("\n") !== next.log.join("\n")) unsaved = true; // columns, by hand
      last = next;
      if (next.model !== "" && !models.has(next.model)) models.set(next.model, await text_of(next.model));
      read_as.set(group.key, { log: next.log, targets: next.targets });
      try {
        await columns.understand(next);
        if (group.kind === "series") intake.faults().delete(group.data[0] ?? "");
        await show(next);
        columns.ask();
      } catch (error) {
        if (!(error instanceof Refused)) throw error;
        // What was measured is shown all the same.
        if (next.model !== "" && (await runs.gap(next).catch(() => null))) {
          await show({ ...next, model: "" });
          return loop?.refused(error);
        }
        const cut = columns.refused(error.message);
        if (cut !== null) {
          intake.faults().set(group.data[0] ?? group.key, cut);
          return leave("");
        }
        // Not of one kind after all: the first by itself.
        const alone = group.kind === "runs" && group.data.length > 1 ? groups().find(({ key }) => key === group.data[0]) : undefined;
        if (alone) {
          tell(why(error));
          return open(alone);
        }
        const several = group.kind === "recordings" && group.data.length > 1;
        const sound = several ? { ...group, data: await sound_of(group.data) } : group;
        if (sound.data.length > 0 && sound.data.length < group.data.length) {
          return show({ ...next, group: sound, data: sound.data });
        }
        if (sound === group) intake.faults().set(group.files[0]?.path ?? group.key, why(error));
        leave(why(error));
      }
    });

  const diagnose = (): Promise<void> =>
    attempt(async () => {
      if (!subject || !report) return;
      const [of, shown] = [subject, report];
      const with_fit = { ...shown, ...(await runs.fitted(of)) };
      const its_loop = await make_loop(of, with_fit);
      if (!its_loop || report !== shown) return;
      report = null;
      loop = its_loop;
      loop.show(with_fit);
      await loop.search();
    });

  // A model that was made here lies beside its data.
  const with_new_models = (group: Group): Group => {
    const folder = group.data[0]?.replace(/[^/]*$/, "") ?? "";
    const made = intake.held().filter(({ path, kind }) => kind === "model" && path.startsWith(folder) && !group.models.some((one) => one.path === path));
    return { ...group, models: [...group.models, ...made] };
  };

  // Of ballbar tests that come to others: before and after, or parts of one machine.
  const open_beside = async (next: Group): Promise<void> => {
    const before = subject;
    if (!before || before.group.kind !== "recordings" || next.kind !== "recordings" || before.model !== "") return open(next);
    const came = await tests_of(next).catch(() => []);
    const seen = tests_in(before.compared.length > 0 ? before.compared : before.data);
    const relation = relation_of(seen, came);
    if (relation.kind === "pair") {
      return open(before.group, { data: relation.before.flatMap(files_of), compared: relation.after.flatMap(files_of), view: "" });
    }
    if (relation.kind === "apart") return open(next);
    const files = [...before.group.files, ...next.files];
    const data = [...before.group.data, ...next.data];
    stated.delete(before.group.key);
    await open(group_of(`${before.group.title} + ${next.files.length}`, files, data));
    if (relation.planes.length > 0) tell(t.change_is_summary({ planes: relation.planes.join(", ") }));
  };

  const groups = (): Group[] => {
    const of_stated = [...stated.values()].map(with_new_models);
    const files = new Set(of_stated.flatMap((group) => group.files.map(({ path }) => path)));
    return [...of_stated, ...groups_of(intake.held().filter(({ path }) => !files.has(path)))];
  };

  return {
    columns,
    subject: () => subject,
    report: () => report,
    loop: () => loop,
    groups,
    tests: tests_known,
    others: () => (subject ? others_of(subject, tests, groups()) : []),
    opening(tests) {
      if (!subject) return null;
      const { group } = subject;
      const near = [...subject.compared, ...subject.data, ...tests_known(group).flatMap(files_of)]; // of an archive those inside
      const [data, compared] = [tests.data, tests.compared].map((files) => files.map((file) => near.find((path) => path === file || last_part(path) === file) ?? ""));
      if (!data || !compared || [...data, ...compared].includes("")) return null;
      return () => void open(group, { data, compared, view: "", model: "" });
    },
    open,
    diagnose,
    async came(paths) {
      for (const one of intake.held()) {
        if (!paths.includes(one.path) || one.kind !== "other" || intake.faults().has(one.path) || is_no_data(one)) continue;
        await sound_of([one.path]);
      }
      const next = groups().find(({ files }) => files.some(({ path }) => paths.includes(path)));
      if (next) await open_beside(next);
      else if (subject) drawn();
      else leave("");
    },
    sample: (sample) =>
      attempt(async () => {
        const data = sample.data.map((word) => `${sample.name}/${word}`);
        const group = group_of(sample.name, await intake.sample(sample), data);
        await open(group, { model: sample.model === undefined ? "" : `${sample.name}/${sample.model}` });
      }),
    again: (kept) =>
      attempt(async () => {
        await intake.again(kept);
        unsaved = kept.state.unsaved ?? false;
        const { data, model, target, title, log = [], targets = [], compared = [], view, tolerance_um = null, left_out = [], saved_model } = kept.state;
        if (saved_model !== undefined) models.set(model, saved_model);
        const found = groups_of(intake.held()).find(({ key }) => key === data.join("\n"));
        const look: Partial<Subject> = compared.length > 0 ? { data, compared, view: "" } : view === undefined ? {} : { view };
        await open(found ?? group_of(title, intake.held(), compared.length > 0 ? [...data, ...compared] : data), { model, target, log, targets, tolerance_um, left_out, ...look });
      }),
    show: (given) => show_alone(null, given),
    rewrite() {
      if (!report) return;
      if (loop) loop.rewrite();
      else page.show(report, null, true);
    },
    leave,
    forget() {
      stated.clear();
      tests.clear();
      read_as.clear();
      last = null;
      models.clear();
      unsaved = false;
      columns.forget();
    },
    unsaved: () => unsaved,
    saved() {
      unsaved = false;
      const model = subject?.model ?? "";
      if (model === "") return keep_state();
      void text_of(model).then((text) => {
        models.set(model, text);
        keep_state();
      });
    },
  };
};

// Columns that a model may explain.

const axis = /^(.*)_(um|urad|mm)$/;

const measured_in = ({ signals }: Report): Report["signals"][number]["columns"] => signals.flatMap(({ columns }) => columns.filter(({ role }) => role === "measured"));

// Those of a drift, or the measured columns of a series; the one that moves most first; lengths before others.
export const targets_in = (report: Report): string[] => {
  const ranges = new Map<string, number>();
  const hold = (name: string, values: readonly (number | null)[]): void => {
    const known = values.filter((value): value is number => value !== null);
    if (known.length < 2) return;
    const [least, largest] = extent([known]);
    ranges.set(name, largest - least);
  };
  for (const name of Object.keys(report.drift?.points[0] ?? {})) {
    if (axis.test(name) && !/sigma|correction|change|shift/.test(name)) hold(name, report.drift?.points.map((point) => point[name] ?? null) ?? []);
  }
  if (ranges.size === 0) {
    const measured = measured_in(report);
    const lengths = measured.filter(({ name }) => axis.test(name));
    for (const { name, values } of lengths.length > 0 ? lengths : measured) hold(name, values);
  }
  return [...ranges].sort(([, a], [, b]) => b - a).map(([name]) => name);
};
