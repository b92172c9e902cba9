// Goes from change to change (n, p), shows golden or actual (a, b), accepts and refuses (y, x), and writes
// the command that stores what is accepted.

const changes = [...document.querySelectorAll("article[data-case]")];
const decisions = new Map();
let current = -1;

/** Goes to a change. */
function go(to) {
  if (!changes.length) return;
  changes[current]?.classList.remove("current");
  current = Math.min(Math.max(to, 0), changes.length - 1);
  changes[current].classList.add("current");
  changes[current].scrollIntoView();
  changes[current].focus({ preventScroll: true });
  summarize();
}

/** Accepts or refuses a change; doing so again takes it back. */
function decide(article, how) {
  const buttons = [...article.querySelectorAll("[data-decide]")];
  const button = buttons.find((button) => button.dataset.decide === how);
  if (!button || button.disabled) return;
  if (decisions.get(article) === how) decisions.delete(article);
  else decisions.set(article, how);
  for (const button of buttons) {
    button.setAttribute("aria-pressed", String(decisions.get(article) === button.dataset.decide));
  }
  article.dataset.decided = decisions.get(article) ?? "";
  summarize();
}

/** The decided changes of each task: articles and whether they are all of the task's. */
function byTask(how) {
  const tasks = new Map();
  for (const article of changes) {
    if (decisions.get(article) !== how) continue;
    const { task } = article.dataset;
    if (!tasks.has(task)) tasks.set(task, []);
    tasks.get(task).push(article);
  }
  return [...tasks].map(([task, articles]) => {
    const all = Number(document.getElementById(task).dataset.changed);
    return { task, articles, whole: articles.length === all };
  });
}

function summarize() {
  const count = (how) => [...decisions.values()].filter((decision) => decision === how).length;
  const at = current < 0 ? `${changes.length} changed` : `${current + 1} of ${changes.length}`;
  const output = document.querySelector(".topbar output");
  if (output) output.textContent = `${at} · ${count("accept")} accepted, ${count("refuse")} refused`;
  const write = (name, text, none) => {
    const out = document.querySelector(`[data-out=${name}]`);
    if (out) out.textContent = text || none;
  };
  const accepted = byTask("accept");
  const keys = accepted.flatMap(({ task, articles, whole }) =>
    whole ? [task] : articles.map((article) => `${task}/${article.dataset.case}`));
  write("command", keys.length ? `cargo grader bless ${keys.join(" ")}` : "", "# nothing is accepted yet");
  const why = document.querySelector(".why")?.value.trim();
  const lines = accepted.map(({ task, articles }) => {
    const meanings = articles.slice(0, 3).map(({ dataset }) => `${dataset.case}: ${dataset.meaning}`);
    if (articles.length > 3) meanings.push(`and ${articles.length - 3} more`);
    return `- Goldens of \`${task}\` changed${why ? `, because ${why}` : ""} (${meanings.join("; ")}).`;
  });
  write("changelog", lines.join("\n"), "# nothing is accepted yet");
  const refused = byTask("refuse").flatMap(({ articles }) =>
    articles.map(({ dataset }) => `${dataset.task}/${dataset.case}: ${dataset.meaning}`));
  write("refused", refused.join("\n"), "# nothing is refused");
}

for (const article of changes) {
  for (const button of article.querySelectorAll("[data-decide]")) {
    button.addEventListener("click", () => decide(article, button.dataset.decide));
  }
}
for (const button of document.querySelectorAll("[data-go]")) {
  button.addEventListener("click", () => go(current + Number(button.dataset.go)));
}
document.querySelector("[data-all]")?.addEventListener("click", () => {
  for (const article of changes) if (decisions.get(article) !== "accept") decide(article, "accept");
});
document.querySelector(".why")?.addEventListener("input", summarize);
for (const box of document.querySelectorAll(".copy")) {
  const button = box.querySelector("button");
  button.addEventListener("click", async () => {
    const pre = box.querySelector("pre");
    try {
      await navigator.clipboard.writeText(pre.textContent);
      button.textContent = "copied";
    } catch {
      // A browser may forbid it to files: select the text instead.
      getSelection().selectAllChildren(pre);
    }
    setTimeout(() => (button.textContent = "copy"), 1500);
  });
}
addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("input, textarea")) return;
  const article = changes[current] ?? document.querySelector(".picture");
  const actions = {
    n: () => go(current + 1),
    p: () => go(current - 1),
    a: () => viewers.get(article)?.show("golden"),
    b: () => viewers.get(article)?.show("actual"),
    y: () => article && decide(article, "accept"),
    x: () => article && decide(article, "refuse"),
  };
  actions[event.key]?.();
});
for (const [index, article] of changes.entries()) {
  article.addEventListener("pointerdown", () => {
    changes[current]?.classList.remove("current");
    article.classList.add("current");
    current = index;
    summarize();
  });
}
summarize();
