// Why something was not done, in words for a reader.
import { Failed } from "../engine";
import { Refused } from "./subject_runs";
import { Interrupted } from "./work";
import { t } from "../texts/texts";

export const reason = (error: unknown): string => {
  const text = error instanceof Error ? error.message : String(error);
  if (error instanceof Interrupted) return t.live_stopped({ what: text });
  if (error instanceof Refused) return text;
  if (!(error instanceof Failed)) return text;
  return /memory|bad_alloc|OOM/i.test(text) ? t.live_out_of_memory : t.live_failed({ why: text });
};
