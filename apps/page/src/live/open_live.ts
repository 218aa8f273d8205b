// The page with the program: takes files, runs the program, and shows the results.
import { type Dropped, folder_as_session } from "./files";
import { asked } from "./question";
import { button, element } from "../elements/elements";
import { plain } from "../drawing/text";
import type { Engine, Sample } from "../engine";
import { head_bar, type HeadBar, shelf_of } from "./head_bar";
import { doing_of } from "./actions";
import { intake_of, type Kept, open_store } from "./intake";
import { file_chooser, listen, start_of } from "./start";
import type { LivePage } from "./live_page";
import { with_said } from "./log_words";
import { opened_with } from "./opened";
import { answer_of, reason, runs_with, work_with } from "./runs";
import { type Saves, saves_of } from "./saves";
import { save } from "../figure/files";
import { ago_spoken } from "./spoken";
import { tour, tour_steps } from "./tour";
import { t, when_spoken } from "../texts/texts";

export const open_live = async (engine: Engine, page: LivePage): Promise<void> => {
  const place = element("div", { class: "live" });
  document.body.prepend(place);
  const message = element("p", { class: "live-told", role: "alert" });
  const tell = (text: string): void => {
    message.textContent = text;
  };
  const work = work_with(engine, (text) => page.state.say(text));
  const runs = runs_with(engine, work);
  const store = await open_store();
  const intake = intake_of(engine, work, store);
  const samples = await engine.samples();
  let kept: Kept | null = page.given ? null : ((await store?.kept().catch(() => null)) ?? null);
  let touring: { leave(): void } | null = null;
  let head: HeadBar;
  let start: HTMLElement;
  let saves: Saves;

  const attempt = async (act: () => Promise<void>): Promise<void> => {
    tell("");
    try {
      await act();
    } catch (error) {
      tell(reason(error));
    }
  };
  const leave_tour = (): void => {
    touring?.leave();
    touring = null;
  };

  const draw_head = (): void => {
    const held = intake.held();
    const groups = opened.groups();
    const of = opened.subject();
    const subject = of && { ...of, group: groups.find(({ key }) => key === of.group.key) ?? of.group };
    start.hidden = opened.report() !== null;
    saves.renew();
    if (held.length === 0 && !opened.report()) return head.show(null);
    head.show({
      shelf: shelf_of({ held, groups, faults: intake.faults(), open: subject?.group.key ?? "", choose: (group) => void opened.open(group) }),
      subject,
      compared: groups.filter(({ key, kind }) => key !== subject?.group.key && (kind === "session" || kind === "series")),
      tests: subject ? opened.tests(subject.group) : [],
      others: opened.others(),
      folder: subject ? folder_as_session(subject.group) : "",
      choose: (as) => subject && void opened.open(subject.group, { ...subject, ...as, target: "" }),
    });
  };

  const opened = opened_with({
    engine,
    work,
    runs,
    intake,
    store,
    page,
    tell,
    drawn: draw_head,
    left(why) {
      draw_head();
      tell(why);
    },
  });

  // Whether what is in no file may go.
  const may_go = async (): Promise<boolean> => {
    if (!opened.unsaved()) return true;
    const answer = await asked(t.live_ask_unsaved, [["save", t.live_ask_save], ["delete", t.live_ask_delete], ["stay", t.live_ask_stay]]);
    if (answer === "save") await saves.save_all();
    return answer === "save" || answer === "delete";
  };
  const deleted_if_asked = async ({ state }: Kept): Promise<boolean> =>
    (await asked(t.live_ask_kept({ title: plain(state.title, 80) }), [["delete", t.live_ask_delete], ["stay", t.live_ask_stay]])) === "delete";
  // That of a closed tab stays as it is.
  const kept_may_go = async (): Promise<boolean> => !kept?.own || !kept.state.unsaved || deleted_if_asked(kept);

  const forget_kept = (): void => {
    kept = null;
    start.querySelector(".kept")?.remove();
  };
  // What was kept is of other files: either it is gone on with, or it goes, where it is this tab's. false: it is to stay.
  const anew = async (): Promise<boolean> => {
    leave_tour();
    if (intake.held().length > 0) return true;
    if (!(await kept_may_go())) return false;
    forget_kept();
    await store?.clear().catch(() => undefined);
    return true;
  };
  const take = (dropped: readonly Dropped[]): void =>
    void attempt(async () => {
      if (dropped.length === 0) return tell(t.live_nothing_in_it);
      if (!(await anew())) return;
      await opened.came((await intake.take(dropped)).map(({ path }) => path));
    });
  const open_sample = async (sample: Sample): Promise<void> => {
    if (await anew()) await opened.sample(sample);
  };
  const take_tour = async (sample: Sample): Promise<void> => {
    await open_sample(sample);
    if (!opened.report()) return;
    touring = tour(tour_steps({ loop: () => opened.loop(), saves: saves.element }));
  };
  const close = (): void =>
    void attempt(async () => {
      leave_tour();
      if (!(await may_go())) return;
      work.stop();
      await intake.clear();
      opened.forget();
      opened.leave("");
    });

  const offer_of = (of: Kept): HTMLElement =>
    element(
      "div",
      { class: "kept buttons" },
      button(t.live_continue_with({ files: of.files.length, ago: ago_spoken(Date.now() - of.state.when) }), "", () => {
        forget_kept();
        void (store?.go_on(of.record) ?? Promise.resolve()).then(() => opened.again(of));
      }),
      button(t.live_delete_kept, t.live_delete_title, () =>
        void attempt(async () => {
          if (of.state.unsaved && !(await deleted_if_asked(of))) return;
          forget_kept();
          await store?.clear(of.record);
          tell(t.live_deleted);
        }),
      ),
    );

  const write = (): void => {
    saves = saves_of({
      subject: () => opened.subject(),
      report: () => opened.report(),
      page_with: page.page_with,
      bytes_of: (path) => engine.get(path),
      model_text: (subject) => runs.model_text(subject),
      saved: () => opened.saved(),
      async table_of({ data, log }) {
        const ran = await work.run(["drift", ...data, ...with_said(log, "max-gap", ""), "--out", "drift.csv"], { what: () => t.live_reading });
        return ran.status === 0 ? engine.get("drift.csv") : ran.err;
      },
      fault: tell,
    });
    head = head_bar({ take, close, saves: saves.element, columns: opened.columns.button, work: work.element, message });
    const toured = samples.find(({ name }) => name === "hidden-effect");
    start = start_of({
      samples,
      take,
      sample: (sample) => void open_sample(sample),
      tour: toured ? () => void take_tour(toured) : null,
    });
    if (kept) start.querySelector(".drop")?.before(offer_of(kept));
    if (!store) start.append(element("p", { class: "note" }, t.live_not_kept));
    opened.columns.rewrite();
    place.replaceChildren(head.element, opened.columns.element, start);
    draw_head();
  };

  write();
  // What the browser keeps is there again after a reload.
  addEventListener("beforeunload", (event) => {
    if (opened.unsaved() && !intake.keeps()) event.preventDefault();
  });
  listen({ take, undo: () => void opened.loop()?.undo(), redo: () => void opened.loop()?.redo(), stop: () => work.stop() });
  // The file chooser must open while the click is handled.
  const again = file_chooser((files) => take(files));
  page.on_action((action) =>
    doing_of(action, {
      opened,
      test_again: again,
      save_of: (words, file) =>
        attempt(async () => {
          answer_of(await work.run([...words, "--json"], { what: () => t.live_reading }));
          save(file, new Blob([new Uint8Array(await engine.get(file))], { type: "text/csv" }));
        }),
    }),
  );
  if (page.given) opened.show(page.given);
  when_spoken(() => {
    leave_tour();
    work.rewrite();
    write();
    opened.rewrite();
  });
};
