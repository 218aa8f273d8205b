// Commands one after the other, with their progress, and a button and a key that stop them. Work that is soon done shows
// nothing.
import { Stopped, type Engine, type Ran, type Watch } from "../engine";
import { button, element } from "../elements/elements";
import { t } from "../texts/texts";

const kSoon_ms = 300;

export interface Job {
  what: string; // "Searching what is missing"
  progress?: (line: string) => void;
}

export interface Work {
  readonly element: HTMLElement;
  run(command: readonly string[], job: Job): Promise<Ran>; // throws Interrupted, or what the engine threw
  call(call: object, job: Job): Promise<Ran>; // likewise
  during<T>(what: string, work: (share: (of_it: number) => void) => Promise<T>): Promise<T>; // of work that cannot be stopped
  stop(): void;
  busy(): boolean;
  rewrite(): void; // in another language
}

// With what was being done.
export class Interrupted extends Error {}

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

  const show = (what: string, can_stop: boolean): (() => void) => {
    const began = performance.now();
    text.textContent = what;
    bar.removeAttribute("value");
    bar.setAttribute("aria-label", what);
    stop.hidden = !can_stop;
    const soon = setTimeout(() => {
      shown.hidden = false;
      say(what);
    }, kSoon_ms);
    const clock = setInterval(() => {
      text.textContent = t.live_since({ what, seconds: Math.round((performance.now() - began) / 1000) });
    }, 1000);
    return () => {
      clearTimeout(soon);
      clearInterval(clock);
      shown.hidden = true;
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
      const hide = show(what, true);
      const told = (line: string): void => {
        const share = share_of(line);
        if (share !== null) bar.value = share;
        progress?.(line);
      };
      try {
        return await ask({ progress: told, stop: mine.signal });
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
        const hide = show(what, false);
        try {
          return await work((share) => (bar.value = share));
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
    },
  };
  return made;
};
