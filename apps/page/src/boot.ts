// The start of a page that contains the program: its script is compressed, like the module.
import { gunzipped } from "./packed";

const begin = async (): Promise<void> => {
  const carrier = document.getElementById("page-script");
  if (!carrier?.textContent) throw new Error("the page is not whole");
  if (typeof DecompressionStream === "undefined") throw new Error("this browser is from before 2023");
  const script = new TextDecoder().decode(await gunzipped(carrier.textContent));
  carrier.textContent = script; // as a saved page has it
  const element = document.createElement("script");
  element.src = URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
  document.body.append(element);
};

begin().catch((error: unknown) => {
  const message = document.createElement("p");
  message.setAttribute("role", "alert");
  message.textContent = `This page cannot be shown: ${String(error)}`;
  document.body.append(message);
});
