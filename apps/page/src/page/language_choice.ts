// The choice of the page's language. It is kept in the page alone, until it is closed.
import { element } from "../elements/elements";
import { language, languages, speak, t, when_spoken } from "../texts/texts";

export const language_choice = (): HTMLSelectElement => {
  const select = element("select", { class: "language" });
  for (const one of languages) select.add(new Option(one.name, one.language));
  select.addEventListener("change", () => {
    const chosen = languages.find((one) => one.language === select.value);
    if (chosen) speak(chosen.language);
  });
  const name = (): void => {
    select.setAttribute("aria-label", t.page_language);
    select.value = language;
  };
  when_spoken(name);
  name();
  return select;
};
