// What a page does with a script: theme, search, keys, buttons that copy code. All else is there without it.
"use strict";
(() => {
  const root = document.documentElement;
  const toBook = document.currentScript.dataset.toBook;
  // A browser may refuse to store what pages from a folder ask for.
  const stored = (use) => { try { return use(localStorage); } catch { return null; } };
  root.classList.add("js");
  root.dataset.theme = stored((store) => store.getItem("first-light-theme")) ?? "";

  const make = (tag, properties = {}, ...children) => {
    const element = Object.assign(document.createElement(tag), properties);
    element.append(...children);
    return element;
  };

  /** The button names the theme that it switches to. */
  function themes() {
    const button = document.getElementById("theme");
    const system = matchMedia("(prefers-color-scheme: dark)");
    const isDark = () => (root.dataset.theme || (system.matches ? "dark" : "light")) === "dark";
    const show = () => { button.textContent = isDark() ? "Light" : "Dark"; };
    button.addEventListener("click", () => {
      root.dataset.theme = isDark() ? "light" : "dark";
      stored((store) => store.setItem("first-light-theme", root.dataset.theme));
      show();
    });
    system.addEventListener("change", show);
    show();
  }

  function copyButtons() {
    for (const code of document.querySelectorAll("pre > code")) {
      const button = make("button", { className: "copy", textContent: "Copy" });
      button.addEventListener("click", async () => {
        try {
          await navigator.clipboard.writeText(code.textContent);
          button.textContent = "Copied";
        } catch {
          getSelection().selectAllChildren(code);
          button.textContent = "Selected";
        }
        setTimeout(() => { button.textContent = "Copy"; }, 1500);
      });
      code.parentElement.append(button);
    }
  }

  function keys() {
    const open = (id) => document.getElementById(id).showPopover();
    const follow = (relation) => document.querySelector(`a[rel=${relation}]`)?.click();
    const actions = {
      ArrowLeft: () => follow("prev"), ArrowRight: () => follow("next"),
      s: () => open("search"), "/": () => open("search"), "?": () => open("keys"),
    };
    document.addEventListener("keydown", (event) => {
      const isTyped = event.target.closest("input, select, textarea, [popover]");
      if (event.defaultPrevented || isTyped || event.ctrlKey || event.altKey || event.metaKey || !actions[event.key]) return;
      event.preventDefault();
      actions[event.key]();
    });
  }

  /** The words of a search, and whether a word of a text begins with each. */
  const wordsOf = (text) => text.toLowerCase().split(/[^\p{L}\p{N}_]+/u).filter(Boolean);
  const beginning = (word) => new RegExp(`(?<![\\p{L}\\p{N}_])${word}`, "iu");

  /** What is found, best first. A word in a heading counts more than one in the text. */
  function found(words) {
    const patterns = words.map(beginning);
    const results = [];
    for (const [address, chapter, title, text] of window.sections) {
      let score = 0;
      for (const pattern of patterns) {
        const inTitle = pattern.test(title) ? 30 : pattern.test(chapter) ? 10 : 0;
        const inText = text.split(new RegExp(pattern, "giu")).length - 1;
        if (inTitle + inText === 0) { score = 0; break; }
        score += inTitle + Math.min(inText, 8);
      }
      if (score > 0) results.push({ address, chapter, title, text, score });
    }
    return results.sort((a, b) => b.score - a.score);
  }

  /** Some words of `text` around the first of `words` that is in it. Those found are marked. */
  function excerpt(text, words) {
    const first = words.map((word) => text.search(beginning(word))).find((at) => at >= 0) ?? 0;
    const start = first < 80 ? 0 : text.indexOf(" ", first - 80) + 1;
    const piece = (start > 0 ? "… " : "") + text.slice(start, start + 220).replace(/ \S*$/, " …");
    const any = new RegExp(`(${words.map((word) => beginning(word).source + "[\\p{L}\\p{N}_]*").join("|")})`, "giu");
    return piece.split(any).map((part, at) => (at % 2 === 1 ? make("mark", {}, part) : part));
  }

  const MOST_RESULTS = 20;

  function search() {
    const box = document.getElementById("search");
    const input = box.querySelector("input");
    const show = () => {
      const words = wordsOf(input.value);
      const results = words.length > 0 && window.sections ? found(words) : [];
      const counted = results.length > MOST_RESULTS ? `the best ${MOST_RESULTS} of ${results.length} sections` : `${results.length} sections`;
      box.querySelector("[role=status]").textContent = words.length > 0 && window.sections ? counted : "";
      box.querySelector("ol").replaceChildren(...results.slice(0, MOST_RESULTS).map(({ address, chapter, title, text }) => {
        const [page, section] = address.split("#");
        const href = `${toBook}${page}?search=${encodeURIComponent(words.join(" "))}${section ? `#${section}` : ""}`;
        const name = title === chapter ? title : `${chapter} › ${title}`;
        return make("li", {}, make("a", { href, textContent: name }), make("p", {}, ...excerpt(text, words)));
      }));
    };
    let isAsked = false;
    box.addEventListener("toggle", () => {
      if (isAsked) return;
      isAsked = true;
      document.head.append(make("script", { src: `${toBook}search.js`, onload: show }));
    });
    input.addEventListener("input", show);
    // Through the results with the arrows, as in a list.
    box.addEventListener("keydown", (event) => {
      const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
      const links = [input, ...box.querySelectorAll("a")];
      const at = links.indexOf(document.activeElement) + (step ?? 0);
      if (event.key === "Enter" && document.activeElement === input) links[1]?.click();
      if (!step || !links[at]) return;
      event.preventDefault();
      links[at].focus();
    });
    // A link to the page that is shown leads to its section.
    box.addEventListener("click", (event) => event.target.closest("a") && box.hidePopover());
  }

  /** The words that the reader searched are marked on the page that was found. */
  function marks() {
    const words = wordsOf(new URLSearchParams(location.search).get("search") ?? "");
    if (words.length === 0 || !CSS.highlights) return;
    const any = new RegExp(words.map((word) => beginning(word).source + "[\\p{L}\\p{N}_]*").join("|"), "giu");
    const texts = document.createTreeWalker(document.querySelector("main"), NodeFilter.SHOW_TEXT);
    const ranges = [];
    while (texts.nextNode()) {
      for (const match of texts.currentNode.data.matchAll(any)) {
        const range = document.createRange();
        range.setStart(texts.currentNode, match.index);
        range.setEnd(texts.currentNode, match.index + match[0].length);
        ranges.push(range);
      }
    }
    CSS.highlights.set("search", new Highlight(...ranges));
  }

  /** The section that is read is marked in the list of chapters, which shows the current one. */
  function place() {
    const links = new Map([...document.querySelectorAll("#chapters .sections a")].map((link) => [link.hash.slice(1), link]));
    const headings = [...document.querySelectorAll("main h2")];
    const show = () => {
      const above = headings.filter((heading) => heading.getBoundingClientRect().top < innerHeight / 3);
      for (const [id, link] of links) link.classList.toggle("here", id === above.at(-1)?.id);
    };
    const current = () => document.querySelector("#chapters [aria-current]")?.scrollIntoView({ block: "center" });
    document.getElementById("chapters").addEventListener("toggle", current);
    document.getElementById("chapters").addEventListener("click", (event) => event.target.hash && event.currentTarget.hidePopover());
    addEventListener("scroll", show, { passive: true });
    if (!location.hash) current();
    show();
  }

  document.addEventListener("DOMContentLoaded", () => {
    for (const part of [themes, copyButtons, keys, search, marks, place]) part();
    // The page with all chapters is for paper.
    if (document.querySelector("main > section")) addEventListener("load", () => print());
  });
})();
