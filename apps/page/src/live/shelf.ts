// The files that are here, in the groups they are opened by, and beside each what is wrong with it.
import { element, button } from "../elements/elements";
import type { Held } from "./file_kinds";
import type { Group } from "./groups";
import { plain } from "../drawing/text";
import { file_kind_spoken, group_kind_spoken, size_spoken } from "./spoken";
import { t } from "../texts/texts";

export interface ShelfOf {
  held: readonly Held[];
  groups: readonly Group[];
  faults: ReadonlyMap<string, string>; // by path
  open: string; // key of the group that is
  choose(group: Group): void;
}

const row_of = (one: Held, fault: string | undefined): HTMLElement =>
  element(
    "li",
    fault === undefined ? {} : { class: "faulty" },
    element("bdi", {}, plain(one.name, 200)),
    element("span", { class: "note" }, `${file_kind_spoken(one.kind)}, ${size_spoken(one.bytes)}`),
    ...(fault === undefined ? [] : [element("span", { class: "fault" }, plain(fault, 600))]),
  );

export const shelf_of = ({ held, groups, faults, open, choose }: ShelfOf): HTMLElement => {
  const tabs = groups.map((group) => {
    const tab = button(plain(group.title, 60), t.live_open_group({ title: plain(group.title, 200) }), () => choose(group));
    tab.setAttribute("aria-pressed", String(group.key === open));
    return element("li", {}, tab, element("span", { class: "note" }, group_kind_spoken(group.kind)));
  });
  const files = element(
    "details",
    { class: "live-files" },
    element("summary", {}, t.live_files({ count: held.length })),
    element("ul", {}, ...held.map((one) => row_of(one, faults.get(one.path)))),
  );
  files.open = faults.size > 0;
  return element("div", { class: "live-shelf" }, ...(groups.length > 1 ? [element("ul", { class: "groups" }, ...tabs)] : []), files);
};
