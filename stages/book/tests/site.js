// node site.js FOLDER [--published]: reads the whole site in Chromium without a network, as a reader would.
// Prints what is wrong; the exit code is 1 if something is.
"use strict";
const { existsSync, readFileSync, readdirSync } = require("node:fs");
const { dirname, join, relative, resolve } = require("node:path");
const { pathToFileURL } = require("node:url");
const { Browser } = require("./explore/chromium.js");

const [folder, ...options] = process.argv.slice(2);
const site = resolve(folder);
const published = options.includes("--published");

const wrong = [];
const expect = (condition, what) => condition || wrong.push(what);
const address = (page) => pathToFileURL(join(site, page)).href;

const pages = readdirSync(site, { recursive: true })
    .map(String)
    .filter((page) => page.endsWith(".html") && !["print.html", "index.html"].includes(page))
    .sort();
expect(pages.length > 25, `found ${pages.length} pages`);

/** Links lead to files, their fragments to elements. On a published site no link leaves it, but for the web. */
function checkLinks(page) {
    const html = readFileSync(join(site, page), "utf8");
    const main = html.slice(html.indexOf("<main>"), html.indexOf("</main>"));
    for (const [, , link] of main.matchAll(/ (href|src)="([^"]*)"/g)) {
        if (/^(https?|data):/.test(link)) continue;
        const [path, fragment] = link.split("#");
        const target = path === "" ? join(site, page) : resolve(dirname(join(site, page)), decodeURIComponent(path));
        const inside = !relative(site, target).startsWith("..");
        expect(existsSync(target), `${page}: ${link} leads nowhere`);
        expect(inside || !published, `${page}: ${link} leads out of the site`);
        if (fragment && inside && existsSync(target)) {
            expect(readFileSync(target, "utf8").includes(`id="${fragment}"`), `${page}: ${link} names no section`);
        }
    }
}

/** What a page of a chapter must be at any width; evaluated in the page. */
const LAYOUT = `(() => {
    const found = [];
    const children = { mfrac: 2, mroot: 2, msub: 2, msup: 2, munder: 2, mover: 2, msubsup: 3, munderover: 3 };
    for (const [name, count] of Object.entries(children))
        for (const element of document.querySelectorAll("main " + name))
            if (element.children.length !== count) found.push(name + " has " + element.children.length + " children");
    for (const math of document.querySelectorAll("main math")) {
        if (math.querySelector("merror")) found.push("a formula is an error: " + math.textContent);
        const after = math.nextSibling ?? math.parentElement.nextSibling;
        if (!math.closest(".joined, [display=block]") && after?.nodeType === 3 && /^[,.;:]/.test(after.data))
            found.push("a sign after a formula can start a line: " + after.data.slice(0, 20));
    }
    for (const joined of document.querySelectorAll("main .joined"))
        if (joined.offsetParent && joined.getBoundingClientRect().height > 90) found.push("broken: " + joined.textContent);
    for (const image of document.querySelectorAll("main img"))
        if (image.offsetParent && image.naturalWidth === 0) found.push("no picture: " + image.getAttribute("src"));
    const width = document.documentElement.clientWidth;
    if (document.scrollingElement.scrollWidth > width)
        found.push("wider than the window: " + document.scrollingElement.scrollWidth + " > " + width);
    for (const code of document.querySelectorAll("main pre > code"))
        if (code.scrollWidth > code.clientWidth + 1) found.push("code is cut: " + code.textContent.slice(0, 60));
    const functions = document.querySelector("main h1 + .table-wrapper");
    if (functions && functions.scrollWidth > functions.clientWidth + 1) found.push("the table of functions is cut");
    for (const sheet of document.querySelectorAll("main .sheet")) {
        const boxes = [...sheet.children].map((panel) => panel.getBoundingClientRect());
        if (boxes.some((box) => box.width < 60 || Math.abs(box.width / box.height - 4 / 3) > 0.05))
            found.push("a panel has " + boxes.map((box) => box.width + "x" + box.height));
        const stacked = boxes.every((box, i) => i === 0 || box.top >= boxes[i - 1].bottom);
        if (stacked !== width < 600) found.push("panels are " + (stacked ? "" : "not ") + "below each other");
    }
    return found;
})()`;

/** The same for paper. */
const PAPER = `(() => {
    const found = [];
    for (const code of document.querySelectorAll("main pre, main pre > code"))
        if (code.scrollWidth > code.clientWidth + 1) found.push("code is cut: " + code.textContent.slice(0, 60));
    for (const details of document.querySelectorAll("main details"))
        if (details.lastElementChild.getBoundingClientRect().height < 10) found.push("answers are not printed");
    if (getComputedStyle(document.getElementById("chapters")).display !== "none") found.push("the list of chapters is printed");
    return found;
})()`;

/** Opens a page, does something with it, and notes what the console says. */
async function on(browser, path, options, name, use) {
    const page = await browser.open(address(path), options);
    await use(page);
    for (const complaint of page.complaints) wrong.push(`${name}: ${complaint}`);
    await page.close();
}

const note = async (page, name, expression) => {
    for (const found of await page.value(expression)) wrong.push(`${name}: ${found}`);
};

async function chapters(browser) {
    for (const path of pages) {
        checkLinks(path);
        for (const width of [1280, 768, 390]) {
            const name = `${path} at ${width} pixels`;
            await on(browser, path, { width }, name, (page) => note(page, name, LAYOUT));
        }
        const name = `${path} on paper`;
        await on(browser, path, { width: 760, media: "print" }, name, (page) => note(page, name, PAPER));
    }
}

/** The page with the whole book, and the paper that comes of a chapter. */
async function paper(browser) {
    await on(browser, "introduction.html", {}, "print.html", async (page) => {
        // The page prints itself.
        await page.send("Page.addScriptToEvaluateOnNewDocument", { source: "window.print = () => {};" });
        await page.send("Page.navigate", { url: address("print.html") });
        await page.until("location.pathname.endsWith('print.html') && document.readyState === 'complete'");
        const formulas = await page.value("document.querySelectorAll('main math').length");
        expect(formulas > 500, `print.html has ${formulas} formulas`);
    });
    await on(browser, "part1/task3.html", {}, "a printed chapter", async (page) => {
        const { data } = await page.send("Page.printToPDF", { preferCSSPageSize: true });
        expect(data.length > 100_000, "a chapter cannot be printed");
    });
}

/** The search, by keyboard. */
async function search(browser) {
    await on(browser, "introduction.html", {}, "the search", async (page) => {
        await page.key("s");
        await page.until("document.activeElement.matches('#search input')");
        await page.send("Input.insertText", { text: "watertight" });
        const links = "[...document.querySelectorAll('#search li a')].map((a) => a.getAttribute('href'))";
        await page.until(`${links}.length > 0`);
        const results = await page.value(links);
        expect(results.some((link) => link.includes("part1/task3.html")), `the search for "watertight" finds ${results}`);
        await page.key("ArrowDown");
        await page.value("void setTimeout(() => document.activeElement.click())");
        await page.until("location.pathname.endsWith('.html') && !location.pathname.endsWith('introduction.html') && document.readyState === 'complete'");
        await page.until("CSS.highlights.get('search')?.size > 0");
    });
}

/** Without a script the list of chapters opens, and marks the page. */
async function withoutScript(browser) {
    const options = { width: 390, script: false };
    await on(browser, "part1/task3.html", options, "a page without a script", async (page) => {
        const list = "document.getElementById('chapters')";
        const isShown = `${list}.getClientRects().length > 0`;
        expect(!(await page.value(isShown)), "the list of chapters covers a narrow page");
        await page.value("document.querySelector('[popovertarget=chapters]').click()");
        expect(await page.value(isShown), "the list of chapters does not open");
        const current = await page.value(`${list}.querySelector('[aria-current=page]').getAttribute('href')`);
        expect(current === "../part1/task3.html", `the list of chapters marks ${current}`);
        const links = await page.value(`${list}.querySelectorAll('a[href]').length`);
        expect(links > pages.length, `the list of chapters has ${links} links`);
        const dead = await page.value("[...document.querySelectorAll('.scripted')].some((button) => button.offsetParent)");
        expect(!dead, "a button does nothing");
    });
}

/** Other keys: to the next chapter and back, and help. */
async function keys(browser) {
    await on(browser, "part1/task1.html", {}, "the keys", async (page) => {
        const at = (path) => page.until(`location.pathname.endsWith('${path}') && document.readyState === 'complete'`);
        await page.key("ArrowRight");
        await at("part1/task2.html");
        await page.key("ArrowLeft");
        await at("part1/task1.html");
        await page.key("?");
        await page.until("document.getElementById('keys').offsetHeight > 0");
        await page.send("Page.navigate", { url: address("part2/task2.html") });
        await page.until("document.querySelector('.explore-live [data-point]') !== null");
        await page.value("document.querySelector('.explore-live [data-point]').focus()");
        await page.key("ArrowRight");
        await at("part2/task2.html");
    });
}

/** Themes: what the system prefers, and what the reader chooses, which stays. */
async function themes(browser) {
    const brightness = `(() => {
        const colour = getComputedStyle(document.documentElement).backgroundColor.match(/[0-9.]+/g).map(Number);
        return (colour[0] + colour[1] + colour[2]) / 765;
    })()`;
    await on(browser, "part1/task3.html", { dark: true }, "the dark theme", async (page) => {
        expect((await page.value(brightness)) < 0.3, "the page is bright where the system is dark");
        const features = [{ name: "prefers-color-scheme", value: "dark" }];
        await page.send("Emulation.setEmulatedMedia", { media: "print", features });
        expect((await page.value(brightness)) > 0.8, "a page is printed dark");
        await page.send("Emulation.setEmulatedMedia", { media: "screen", features });
        await page.value("document.getElementById('theme').click()");
        expect((await page.value(brightness)) > 0.8, "the light theme is dark");
    });
    await on(browser, "part2/task1.html", { dark: true }, "the chosen theme", async (page) => {
        expect((await page.value(brightness)) > 0.8, "the chosen theme is forgotten");
        await page.until("document.querySelectorAll('pre .copy').length > 0");
        expect((await page.value("document.querySelectorAll('pre .keyword').length")) > 0, "code is not highlighted");
        const links = "[...document.querySelectorAll('main a')].map((a) => a.href).filter((link) => link.endsWith('.rs'))";
        const sources = await page.value(links);
        expect((sources.length === 0) === published, `links to sources: ${sources}`);
    });
    await on(browser, "part2/task2.html", {}, "a figure to explore", async (page) => {
        await page.until("document.querySelector('.explore-live') !== null");
    });
}

/** The questions before a derivation: a wrong answer gets its reason, and is still there after a reload. */
async function predictions(browser) {
    await on(browser, "part1/task3.html", {}, "the questions", async (page) => {
        const status = "document.querySelector('form.predict [role=status]').textContent";
        const wrongChoice = "document.querySelector('form.predict [data-why]')";
        await page.until("document.querySelector('form.predict')?.hidden === false");
        expect((await page.value(status)) === "", "a question is answered before the reader does");
        await page.value(`${wrongChoice}.click()`);
        expect(/^No\. .+ Right is: /.test(await page.value(status)), "a wrong answer gets no reason");
        await page.send("Page.reload");
        await page.until(`document.readyState === 'complete' && document.querySelector('form.predict')?.hidden === false`);
        expect(/^No\. /.test(await page.value(status)), "an answer is forgotten");
        await page.value("document.querySelector('form.predict > button').click()");
        expect((await page.value(status)) === "", "an answer cannot be forgotten");
        await page.value("document.querySelector('form.predict fieldset button:not([data-why])').click()");
        expect((await page.value(status)) === "Right.", "the right answer is not right");
    });
}

async function main() {
    const browser = await Browser.start();
    for (const part of [chapters, paper, search, withoutScript, keys, themes, predictions]) await part(browser);
    await browser.stop();
    for (const what of wrong) console.error(what);
    console.log(`${pages.length} pages of ${folder} at three widths and on paper: ${wrong.length} faults`);
    process.exitCode = wrong.length === 0 ? 0 : 1;
}

main();
