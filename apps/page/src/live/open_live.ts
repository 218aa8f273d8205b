// The page with the program in it: files come in, the program is asked, and the page shows what it answers.
import { catalogue_of } from "./catalogue";
import { plan_words, type Subject } from "./commands";
import { dropped_of, type Dropped } from "./dropped_files";
import { button, element } from "../elements/elements";
import type { Engine, Sample } from "../engine";
import type { Held } from "./file_kinds";
import { folder_as_session, groups_of, type Group } from "./groups";
import { head_bar } from "./head_bar";
import { intake_of } from "./intake";
import { open_store, type Kept } from "./kept_files";
import { loop_of, type Loop } from "./loop";
import type { Planned, PlannedFiles } from "./next_test";
import type { PageState } from "../figure/page_state";
import type { Report } from "../report";
import { saves_of } from "./saves";
import { ago_spoken } from "./spoken";
import { shelf_of } from "./shelf";
import type { Inside } from "../shell";
import { start_of } from "./start";
import { answer_of, Refused, runs_with } from "./subject_runs";
import { targets_in } from "./targets";
import { tour } from "./tour";
import { tour_steps } from "./tour_steps";
import { Interrupted, work_with } from "./work";
import { t } from "../texts/texts";

// What the page does for it.
export interface LivePage {
  state: PageState; // of the page as it is drawn now
  show(report: Report, loop: Loop | null): void; // in the place of the one before; a loop stands for the first screen
  clear(): void;
  on_command(act: (command: string) => void): void; // what a button does that says a command
  given: Report | null; // with which the page was made
  page_with(report: Report, inside: Inside | null): string; // a page of a report, as a file
}

export const open_live = async (engine: Engine, page: LivePage): Promise<void> => {
  const told = element("p", { class: "live-told", role: "alert" });
  const tell = (text: string): void => {
    told.textContent = text;
  };
  const work = work_with(engine, (text) => page.state.say(text));
  const runs = runs_with(engine, work);
  const store = await open_store();
  const intake = intake_of(engine, work, store);
  let subject: Subject | null = null;
  let report: Report | null = null;
  let loop: Loop | null = null;

  const place = element("div", { class: "live" });
  document.body.prepend(place);
  const reason = (error: unknown): string =>
    error instanceof Interrupted ? t.live_stopped({ what: error.message }) : error instanceof Refused || error instanceof DOMException ? error.message : t.live_failed({ why: error instanceof Error ? error.message : String(error) });
  const attempt = async (act: () => Promise<void>): Promise<void> => {
    tell("");
    try {
      await act();
    } catch (error) {
      tell(reason(error));
    }
  };

  const keep_state = (): void => {
    if (!subject) return;
    const { group, model, target } = subject;
    store?.say({ when: Date.now(), title: group.title, group: group.key, model, target }).catch(() => undefined);
  };

  const saves = saves_of({
    subject: () => subject,
    report: () => report,
    page_with: page.page_with,
    bytes_of: (path) => engine.get(path),
    async table_of({ data }) {
      const ran = await work.run(["drift", ...data, "--out", "drift.csv"], { what: t.live_reading });
      return ran.status === 0 ? engine.get("drift.csv") : ran.err;
    },
    fault: tell,
  });

  // What the program says of a file alone; "": nothing against it.
  const fault_of = async (path: string): Promise<string> => {
    try {
      answer_of(await work.run(["report", path, "--json"], { what: t.live_checking({ name: path }) }));
      return "";
    } catch (error) {
      if (error instanceof Refused) return error.message;
      throw error;
    }
  };
  // Of several tests those that can be read; what is wrong with the others stands beside them.
  const without_faulty = async (group: Group): Promise<Group> => {
    const sound: string[] = [];
    for (const path of group.data) {
      const fault = await fault_of(path);
      if (fault === "") sound.push(path);
      else intake.faults().set(path, fault);
    }
    return { ...group, data: sound };
  };

  const plan = async (of: Subject, hours: number): Promise<PlannedFiles | string> => {
    try {
      const folder = runs.free_name("plans", "plan");
      const planned = answer_of<Planned>(await work.run(plan_words(of, hours, folder), { what: t.live_planning }));
      const paths = engine.list().flatMap(({ path }) => (path.startsWith(`${folder}/`) ? [path] : []));
      const files = await Promise.all(paths.map(async (path) => ({ name: path.slice(path.lastIndexOf("/") + 1), bytes: await engine.get(path) })));
      return { plan: planned, files };
    } catch (error) {
      return reason(error);
    }
  };

  const catalogue = catalogue_of(engine);
  const make_loop = async (of: Subject, first: Report): Promise<Loop | null> => {
    const checked = first.check?.targets.map(({ target }) => target) ?? [];
    const targets = checked.length > 0 ? checked : of.group.kind === "recordings" ? [] : targets_in(first);
    if (targets.length === 0) return null;
    return loop_of({
      subject: { ...of, target: of.target || (targets.length > 1 || checked.length === 0 ? (targets[0] ?? "") : "") },
      targets,
      runs,
      work,
      catalogue: await catalogue,
      page: page.state,
      bytes_of: (path) => engine.get(path),
      put: (path, bytes) => engine.put(path, bytes),
      plan,
      changed(now, next) {
        const model_changed = next.model !== "" && (next.model !== subject?.model || report !== now);
        report = now;
        subject = next;
        if (model_changed) void intake.written(next.model);
        keep_state();
        page.show(now, loop);
        draw_head();
      },
    });
  };

  const show = async (next: Subject): Promise<void> => {
    const first = await runs.report(next);
    subject = next;
    report = first;
    loop = await make_loop(next, first);
    if (!loop) {
      keep_state();
      page.show(first, null);
      draw_head();
      return;
    }
    loop.show(first);
    if (next.model !== "") void loop.search();
  };

  const open = (group: Group, as: Partial<Subject> = {}): Promise<void> =>
    attempt(async () => {
      work.stop();
      if (group.kind === "report") return open_page(group);
      const model = group.models.length === 1 ? (group.models[0]?.path ?? "") : "";
      const next: Subject = { group, data: group.data, model, target: "", compared: "", ...as };
      try {
        await show(next);
      } catch (error) {
        if (!(error instanceof Refused)) throw error;
        const sound = group.kind === "recordings" && group.data.length > 1 ? await without_faulty(group) : group;
        if (sound.data.length > 0 && sound.data.length < group.data.length) return show({ ...next, group: sound, data: sound.data });
        if (sound === group) intake.faults().set(group.files[0]?.path ?? group.key, error.message);
        leave(error.message);
      }
    });

  const carried_group = (page_group: Group, files: readonly Held[], data: readonly string[]): Group => {
    const [first] = files.filter(({ path }) => data.includes(path));
    const kind = first?.kind === "recording" ? "recordings" : first?.kind === "series" ? "series" : first?.kind === "runs" ? "runs" : "session";
    const made = { key: data.join("\n"), title: page_group.title, kind, data, files, models: files.filter((one) => one.kind === "model") } as const;
    groups_of_samples.set(made.key, made);
    return made;
  };

  const open_page = async (group: Group): Promise<void> => {
    const [file] = group.files;
    if (!file) return;
    try {
      const { read, held, data, model } = await intake.carried(file);
      if (data.length > 0) return await open(carried_group(group, held, data), { model });
      subject = { group, data: [], model: "", target: "", compared: "" };
      report = read.report;
      loop = null;
      page.show(report, null);
      draw_head();
    } catch (error) {
      intake.faults().set(file.path, error instanceof Error ? error.message : String(error));
      leave(intake.faults().get(file.path) ?? "");
    }
  };

  const came = async (paths: readonly string[]): Promise<void> => {
    for (const one of intake.held()) {
      if (!paths.includes(one.path) || one.kind !== "other" || intake.faults().has(one.path)) continue;
      if (/\.(md|sh|py|svg|png|jpe?g)$|(^|\/)[A-Z]+$/i.test(one.name) || one.head.includes('"ballbar-')) continue; // beside data
      const fault = await fault_of(one.path);
      if (fault !== "") intake.faults().set(one.path, fault);
    }
    const groups = groups_of(intake.held());
    const next = groups.find(({ files }) => files.some(({ path }) => paths.includes(path)));
    if (next) await open(next);
    else leave("");
  };

  // What was kept is of other files: either it is gone on with, or it goes.
  const anew = async (): Promise<void> => {
    leave_tour();
    if (intake.held().length > 0) return;
    place.querySelector(".kept")?.remove();
    await store?.clear().catch(() => undefined);
  };
  const take = (dropped: readonly Dropped[]): void =>
    void attempt(async () => {
      if (dropped.length === 0) return tell(t.live_nothing_in_it);
      await anew();
      await came((await intake.take(dropped)).map(({ path }) => path));
    });

  const open_sample = (sample: Sample): Promise<void> =>
    attempt(async () => {
      await anew();
      const held = await intake.sample(sample);
      const data = sample.data.map((word) => `${sample.name}/${word}`);
      const kinds = new Set(held.filter(({ path }) => data.includes(path)).map(({ kind }) => kind));
      const kind = kinds.has("recording") ? "recordings" : kinds.has("series") ? "series" : "session";
      const models = held.filter((one) => one.kind === "model");
      const group: Group = { key: data.join("\n"), title: sample.name, kind, data, files: held, models };
      groups_of_samples.set(group.key, group);
      await open(group, { model: sample.model === undefined ? "" : `${sample.name}/${sample.model}` });
    });
  const groups_of_samples = new Map<string, Group>();

  const groups_now = (): Group[] => {
    const of_samples = [...groups_of_samples.values()];
    const files = new Set(of_samples.flatMap((group) => group.files.map(({ path }) => path)));
    return [...of_samples, ...groups_of(intake.held().filter(({ path }) => !files.has(path)))];
  };

  let touring: { leave(): void } | null = null;
  const leave_tour = (): void => {
    touring?.leave();
    touring = null;
  };
  const take_tour = (sample: Sample): void => {
    void open_sample(sample).then(() => {
      touring = tour(tour_steps({ loop: () => loop, saves: saves.element }));
    });
  };

  const again = (kept: Kept): Promise<void> =>
    attempt(async () => {
      await intake.again(kept);
      const { group: key, model, target, title } = kept.state;
      const groups = groups_of(intake.held());
      const files = intake.held();
      const data = key.split("\n");
      const named = { key, title, kind: "session", data, files, models: files.filter(({ kind }) => kind === "model") } as const;
      await open(groups.find((one) => one.key === key) ?? named, { model, target });
    });

  const to_start = async (): Promise<void> => {
    leave_tour();
    work.stop();
    await intake.clear();
    groups_of_samples.clear();
    leave("");
  };

  const head = head_bar({
    take,
    close: () => void attempt(to_start),
    undo: () => void loop?.undo(),
    redo: () => void loop?.redo(),
    stop: () => work.stop(),
    saves: saves.element,
    work: work.element,
    told,
    dropped_of,
  });
  place.append(head.element);

  page.on_command((command) => {
    if (!loop?.act(command)) tell(command.startsWith("ballbar history ") ? t.live_test_again : t.live_for_terminal({ command }));
  });

  const draw_head = (): void => {
    start.hidden = true;
    const faults = intake.faults();
    const shelf = shelf_of({ held: intake.held(), groups: groups_now(), faults, open: subject?.group.key ?? "", choose: (group) => void open(group) });
    saves.renew();
    head.show({
      shelf,
      subject,
      compared: groups_now().filter(({ key, kind }) => key !== subject?.group.key && (kind === "session" || kind === "series")),
      folder: subject ? folder_as_session(subject.group) : "",
      choose: (as) => subject && void open(subject.group, { ...subject, ...as, target: "" }),
    });
  };

  // Back to the first screen, with what is here, and why.
  const leave = (why: string): void => {
    subject = null;
    report = null;
    loop = null;
    page.clear();
    const { held, faults } = { held: intake.held(), faults: intake.faults() };
    saves.renew();
    head.show(
      held.length === 0
        ? null
        : { shelf: shelf_of({ held, groups: groups_now(), faults, open: "", choose: (group) => void open(group) }), subject: null, compared: [], folder: "", choose: () => undefined },
    );
    start.hidden = false;
    tell(why);
  };

  const samples = await engine.samples();
  const hidden_effect = samples.find(({ name }) => name === "hidden-effect");
  const start = start_of({
    samples,
    take,
    sample: (sample) => void open_sample(sample),
    tour: hidden_effect ? () => take_tour(hidden_effect) : null,
  });
  place.append(start);

  if (page.given) {
    report = page.given;
    page.show(report, null);
    draw_head();
  }
  if (!store) {
    start.append(element("p", { class: "note" }, t.live_not_kept));
    return;
  }
  const kept = await store.kept().catch(() => null);
  if (!kept || page.given) return;
  const offer = element(
    "div",
    { class: "kept buttons" },
    button(t.live_continue_with({ files: kept.files.length, ago: ago_spoken(Date.now() - kept.state.when) }), "", () => {
      offer.remove();
      void again(kept);
    }),
    button(t.live_delete_kept, t.live_delete_title, () => {
      offer.remove();
      void store.clear().then(() => tell(t.live_deleted));
    }),
  );
  start.querySelector("h1")?.after(offer);
};
