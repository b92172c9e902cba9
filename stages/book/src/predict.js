// The questions of a chapter as choices. Answers stay in this browser.
"use strict";
(() => {
  const hash = (text) => [...text].reduce((sum, c) => (sum * 31 + c.codePointAt(0)) % 65521, 7);
  for (const form of document.querySelectorAll("form[data-predict]")) {
    const key = `first-light-predict-${form.dataset.predict}`;
    // A browser may refuse to store what pages from a folder ask for.
    const stored = (use) => { try { return use(localStorage); } catch { return null; } };
    let given = stored((store) => JSON.parse(store.getItem(key))) ?? {};
    const fields = [...form.querySelectorAll("fieldset")].map((field) => {
      const choices = [...field.querySelectorAll("button")];
      const right = choices.find((choice) => choice.dataset.why === undefined);
      const status = field.querySelector("[role=status]");
      const question = field.dataset.question;
      const show = () => {
        const chosen = choices[given[question]];
        choices.forEach((choice) => {
          choice.setAttribute("aria-pressed", String(choice === chosen));
          choice.disabled = chosen !== undefined && choice !== chosen;
        });
        const why = chosen?.dataset.why;
        status.textContent = !chosen ? "" : why ? `No. ${why} Right is: ${right.textContent}` : "Right.";
      };
      choices.forEach((choice, at) => choice.addEventListener("click", () => {
        given[question] = at;
        stored((store) => store.setItem(key, JSON.stringify(given)));
        show();
      }));
      // In another order for each question, which stays.
      const place = (choice) => hash(form.dataset.predict + question + choice.textContent);
      [...choices].sort((a, b) => place(a) - place(b)).forEach((choice) => field.insertBefore(choice, status));
      return show;
    });
    const again = Object.assign(document.createElement("button"), { type: "button", textContent: "Forget my answers" });
    again.addEventListener("click", () => {
      given = {};
      stored((store) => store.removeItem(key));
      fields.forEach((show) => show());
    });
    form.append(again);
    fields.forEach((show) => show());
    form.hidden = false;
  }
})();
