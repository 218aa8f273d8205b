// A question before something is deleted that is in no file yet. By keyboard too; Escape is "no".
import { button, element } from "../elements/elements";

export type Answers<T extends string> = readonly (readonly [T, string])[]; // what it is, and what its button says

// null: it was left without an answer.
export const asked = <T extends string>(question: string, answers: Answers<T>): Promise<T | null> =>
  new Promise((answered) => {
    let answer: T | null = null;
    const box: HTMLDialogElement = element(
      "dialog",
      { class: "live-question", "aria-labelledby": "live-question-text" },
      element("p", { id: "live-question-text" }, question),
      element(
        "div",
        { class: "buttons" },
        ...answers.map(([value, label]) =>
          button(label, "", () => {
            answer = value;
            box.close();
          }),
        ),
      ),
    );
    box.addEventListener("keydown", (event) => event.stopPropagation()); // Escape is not the page's, either
    box.addEventListener("close", () => {
      box.remove();
      answered(answer);
    });
    document.body.append(box);
    box.showModal();
  });
