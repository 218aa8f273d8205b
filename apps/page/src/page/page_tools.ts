// What a reader may choose for the whole page: its language, light or dark.
import { appearance } from "./appearance";
import { element } from "../elements/elements";
import { language_choice } from "./language_choice";
import type { Shared } from "./shared";

export const page_tools = (shared: Shared): HTMLElement =>
  element("div", { class: "page-tools" }, language_choice(), appearance(shared));
