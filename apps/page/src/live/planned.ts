// A plan of the program, with the files that it wrote.
import { plan_words } from "./commands";
import type { Engine } from "../engine";
import type { NextTestOf, Planned } from "./next_test";
import { reason } from "./reason";
import { answer_of, type Runs } from "./subject_runs";
import type { Work } from "./work";
import { t } from "../texts/texts";

export const planned_with =
  (engine: Engine, work: Work, runs: Runs): NextTestOf["plan"] =>
  async (subject, hours) => {
    try {
      const folder = runs.free_name("plans", "plan");
      const plan = answer_of<Planned>(await work.run(plan_words(subject, hours, folder), { what: t.live_planning }));
      const paths = engine.list().flatMap(({ path }) => (path.startsWith(`${folder}/`) ? [path] : []));
      const name_of = (path: string): string => path.slice(path.lastIndexOf("/") + 1);
      const files = await Promise.all(paths.map(async (path) => ({ name: name_of(path), bytes: await engine.get(path) })));
      return { plan, files };
    } catch (error) {
      return reason(error);
    }
  };
