// The verdict of a diagnosis: the program's sentences, in the page's language.
import type { Diagnosed } from "../report";
import { all_said, said, type Sentence } from "../texts/texts";

export interface Said {
  before: readonly Sentence[]; // what was not used
  verdict: Sentence; // and all that follows
  also: Sentence; // of that, about a slow drift: its size, or where it is the verdict, what to do; "": there is none
}

export const said_of = (found: Diagnosed): Said => ({
  before: all_said(found.not_used, found.not_used_message),
  verdict: said(found.conclusion, found.conclusion_message),
  also: found.slow_drift === "" ? "" : said(found.slow_drift, found.slow_drift_message),
});

// All of it in one paragraph, as on the terminal.
export const verdict_of = (found: Diagnosed): Sentence => said(found.sentence, found.message);
