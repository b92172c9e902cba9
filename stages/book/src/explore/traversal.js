// Part 2, Task 3: the traversal of the worked example's tree, step by step.
(function () {
  "use strict";

  const CHILDREN = { A: ["B", "C"], B: ["D", "E"], C: ["F", "G"] };
  const NODES = ["A", "B", "C", "D", "E", "F", "G"];
  // The primitive of a leaf is a line between two corners of its box.
  const LINES = {
    D: [[1, -1], [6.5, 1.75]],
    E: [[4, 2.5], [6, 0.5]],
    F: [[3, 3], [6, 0]],
    G: [[7, 1], [8, 2]],
  };

  const ends = (points, i) => {
    const values = points.map((p) => p[i]);
    return [Math.min(...values), Math.max(...values)];
  };
  const leavesBelow = (node) => (LINES[node] ? [node] : CHILDREN[node].flatMap(leavesBelow));
  const boxOf = (node) => {
    const points = leavesBelow(node).flatMap((leaf) => LINES[leaf]);
    return [ends(points, 0), ends(points, 1)];
  };

  // Where a ray enters the boxes and hits the lines, in exact fractions; null for a miss.
  function geometry(o, d) {
    const { Fraction } = Explore.parts.exact;
    const of = Fraction.of;
    const entry = (node) => {
      let [first, last] = [of(0), null];
      for (const [i, [low, high]] of boxOf(node).entries()) {
        if (d[i] === 0) {
          if (o[i] < low || o[i] > high) return null;
          continue;
        }
        const [near, far] = d[i] > 0 ? [low, high] : [high, low];
        const [enter, leave] = [near, far].map((plane) => of(plane).sub(of(o[i])).div(of(d[i])));
        if (enter.cmp(first) > 0) first = enter;
        if (last === null || leave.cmp(last) < 0) last = leave;
      }
      return last === null || first.cmp(last) <= 0 ? first : null;
    };
    const hit = (leaf) => {
      const [p, q] = LINES[leaf];
      const along = [of(q[0] - p[0]), of(q[1] - p[1])];
      const from = [of(p[0]).sub(of(o[0])), of(p[1]).sub(of(o[1]))];
      const [dx, dy] = d.map(of);
      const determinant = dx.mul(along[1]).sub(dy.mul(along[0]));
      if (determinant.sign() === 0) return null;
      const t = from[0].mul(along[1]).sub(from[1].mul(along[0])).div(determinant);
      const place = from[0].mul(dy).sub(from[1].mul(dx)).div(determinant);
      return t.sign() >= 0 && place.sign() >= 0 && place.cmp(of(1)) <= 0 ? t : null;
    };
    return {
      entries: Object.fromEntries(NODES.map((node) => [node, entry(node)])),
      hits: Object.fromEntries(Object.keys(LINES).map((leaf) => [leaf, hit(leaf)])),
    };
  }

  // All steps of a traversal, each as a sentence and the state after it. The codes: "near" and
  // "far" visit the nearer or the farther child first; "stop" ends with the first hit; "long" does
  // not shorten the ray that boxes are tested with.
  function walk({ entries, hits }, code) {
    const steps = [];
    const now = { end: null, result: null, tests: 0, leaves: [], waiting: [], marks: {} };
    const beyond = (t) => code !== "long" && now.end !== null && t.cmp(now.end) > 0;
    const record = (words, current = null) => {
      const { waiting, marks, leaves } = now;
      steps.push({ ...now, words, current, waiting: [...waiting], marks: { ...marks }, leaves: [...leaves] });
    };
    const test = (node) => {
      now.tests += 1;
      const entered = entries[node] && !beyond(entries[node]);
      if (!entered) now.marks[node] = "missed";
      return entered;
    };
    const tell = (node) => {
      if (!entries[node]) return `${node} is missed`;
      return now.marks[node] === "missed"
        ? `${node} is entered at ${entries[node]}, beyond the end of the ray: missed`
        : `${node} is entered at ${entries[node]}`;
    };

    const atRoot = test("A");
    record(`Test the box of the root: ${tell("A")}.`, atRoot ? "A" : null);
    let node = atRoot ? "A" : null;
    while (node) {
      now.marks[node] = "visited";
      let next = null;
      if (LINES[node]) {
        now.leaves.push(node);
        const t = hits[node];
        const isHit = t && (now.end === null || t.cmp(now.end) <= 0);
        if (isHit) [now.end, now.result] = [t, node];
        const outcome = isHit ? `is hit at ${t}, and the ray ends there now` : t ? `would be hit at ${t}, beyond the end of the ray` : "is missed";
        record(`${node} is a leaf: its primitive ${outcome}.`, node);
        if (isHit && code === "stop") {
          record(`This code stops here, with ${now.waiting.length ? `${now.waiting.map((w) => w.node).join(" and ")} still waiting` : "nothing waiting"}.`);
          return steps;
        }
      } else {
        const inside = CHILDREN[node].filter(test);
        const both = inside.length === 2;
        const nearer = both && entries[inside[0]].cmp(entries[inside[1]]) > 0 ? inside[1] : inside[0];
        next = both && code === "far" ? inside.find((child) => child !== nearer) : nearer;
        const later = both ? inside.find((child) => child !== next) : null;
        if (later) {
          now.waiting.push({ node: later, entry: entries[later] });
          now.marks[later] = "waiting";
        }
        const tests = `Test both boxes below ${node}: ${CHILDREN[node].map(tell).join(", ")}.`;
        record(tests + (later ? ` Go on with ${next}; ${later} waits.` : next ? ` Go on with ${next}.` : ""), next);
      }
      while (!next && now.waiting.length > 0) {
        const top = now.waiting.pop();
        if (beyond(top.entry)) {
          now.marks[top.node] = "missed";
          record(`Pop ${top.node}: its entry ${top.entry} is beyond ${now.end}. Forget it.`);
        } else {
          next = top.node;
          delete now.marks[next];
          record(`Pop ${next}: its entry ${top.entry} is not beyond ${now.end ?? "the end of the ray"}. Visit it.`, next);
        }
      }
      node = next;
    }
    record(now.result ? `Nothing waits: the closest hit is that of ${now.result}, at ${now.end}.` : "Nothing waits: the ray misses.");
    return steps;
  }

  const CODES = [
    ["near", "nearer child first"],
    ["far", "farther child first"],
    ["stop", "stops at the first hit"],
    ["long", "never shortens the ray for boxes"],
  ];
  const PLACES = { A: [4, 2.6], B: [2, 1.4], C: [6, 1.4], D: [1, 0.2], E: [3, 0.2], F: [5, 0.2], G: [7, 0.2] };
  const COLOURS = { D: "green", E: "purple", F: "blue", G: "orange", B: "soft", C: "soft", A: "soft" };

  function start(ui) {
    const scene = ui.stage({
      label: "The boxes of the leaves D, E, F and G, their primitives, and the ray",
      x: [-0.5, 8.75],
      y: [-1.35, 3.35],
      ratio: (width) => (width < 500 ? 0.6 : 0.44),
      margin: 6,
    });
    scene.handle({ key: "o", name: "o", label: "origin of the ray", value: [0, 1.5], snap: 0.25, dx: -4, dy: -16 });
    scene.handle({ key: "tip", name: "d", label: "tip of the direction d", value: [1, 1.5], colour: "red", snap: 0.25, dx: -4, dy: -16 });
    const tree = ui.stage({
      label: "The tree of the nodes A to G, each with its entry",
      x: [0.2, 8.3],
      y: [-0.55, 3],
      ratio: (width) => (width < 500 ? 0.52 : 0.34),
      stretch: true,
      margin: 4,
    });
    const say = ui.sentence();
    ui.state.step = 0;
    let count = 1;
    const [back, forward, end] = ui.buttons([
      ["◀ Back", () => (ui.state.step = Math.max(0, ui.state.step - 1))],
      ["Step ▶", () => (ui.state.step = Math.min(count - 1, ui.state.step + 1))],
      ["To the end", () => (ui.state.step = count - 1)],
    ]);
    ui.choice({ key: "code", label: "The code", value: "near", options: CODES });
    const show = ui.table({ caption: "After this step" });

    ui.render = (state) => {
      const d = [state.tip[0] - state.o[0], state.tip[1] - state.o[1]];
      if (d[0] === 0 && d[1] === 0) {
        say("The direction is 0: move its tip.");
        return show([]);
      }
      const world = geometry(state.o, d);
      const steps = walk(world, state.code);
      count = steps.length;
      state.step = Math.min(state.step, count - 1);
      const step = steps[state.step];
      const isLast = state.step === count - 1;
      back.disabled = state.step === 0;
      forward.disabled = end.disabled = isLast;

      const truth = Object.values(world.hits).filter(Boolean).reduce((a, b) => (a && a.cmp(b) <= 0 ? a : b), null);
      const same = truth === null ? step.end === null : step.end !== null && step.end.cmp(truth) === 0;
      const verdict = isLast ? (same ? " ✓ That is the closest hit." : ` ✗ The closest hit is at ${truth}.`) : "";
      say(`Step ${state.step + 1} of ${count}: ${step.words}${truth === null ? "" : verdict}`);
      show([
        ["stack, top first", step.waiting.length ? [...step.waiting].reverse().map((w) => `${w.node} (${w.entry})`).join(", ") : "empty"],
        ["end of the ray, t_max", String(step.end ?? "∞")],
        ["hit that is kept", step.result ? `${step.result}, t = ${step.end}` : "none"],
        ["box tests", String(step.tests)],
        ["leaves tested", step.leaves.length ? `${step.leaves.length}: ${step.leaves.join(", ")}` : "0"],
      ]);
      drawScene(scene, state, d, step);
      drawTree(tree, world, step);
    };
  }

  function drawScene(stage, { o }, d, step) {
    for (const node of ["D", "E", "F", "G"]) {
      const [[x0, x1], [y0, y1]] = boxOf(node);
      const colour = COLOURS[node];
      const mark = step.marks[node];
      if (mark === "visited") stage.rect([x0, y0], [x1, y1], `tint ${colour}`);
      if (mark === "waiting") stage.rect([x0, y0], [x1, y1], `hatch-${colour}`);
      stage.rect([x0, y0], [x1, y1], `edge ${colour}${mark === "missed" ? " dash" : ""}`);
      stage.line(LINES[node], `${colour} thick`);
    }
    for (const node of ["B", "C"]) {
      const [[x0, x1], [y0, y1]] = boxOf(node);
      const gap = 0.1;
      stage.rect([x0 - gap, y0 - gap], [x1 + gap, y1 + gap], "edge soft dash");
      stage.words([node === "B" ? x0 : x1, node === "B" ? y0 : y1], node, "soft strong", { dx: node === "B" ? 12 : -12, dy: node === "B" ? -6 : 16 });
    }
    const names = { D: [1.35, -0.35], E: [5.75, 2.25], F: [3.25, 2.1], G: [7.8, 1.2] };
    for (const [node, at] of Object.entries(names)) stage.words(at, node, `${COLOURS[node]} strong`, { dy: 5 });
    const at = (t) => [o[0] + t * d[0], o[1] + t * d[1]];
    const last = step.end === null ? 60 : step.end.number();
    stage.line([at(last), at(60)], "soft dash");
    stage.line([at(0), at(last)], "ink");
    if (step.end !== null) {
      stage.circle(at(last), 6, "solid red");
      stage.words(at(last), "t_max", "red strong", { dy: 24 });
    }
  }

  const SIGNS = { visited: "✓", waiting: "waits", missed: "✗" };

  function drawTree(stage, { entries, hits }, step) {
    for (const [node, children] of Object.entries(CHILDREN)) {
      for (const child of children) stage.line([PLACES[node], PLACES[child]], "soft");
    }
    const isNarrow = stage.w < 500;
    for (const node of NODES) {
      const at = PLACES[node];
      const colour = LINES[node] ? COLOURS[node] : "ink";
      stage.circle(at, isNarrow ? 13 : 16, `hollow ${colour}`);
      if (step.current === node) stage.circle(at, isNarrow ? 17 : 21, "edge red");
      if (step.marks[node] === "visited") stage.circle(at, isNarrow ? 13 : 16, `tint ${colour}`);
      stage.words(at, node, `${colour} strong`, { dy: 5 });
      const entry = entries[node] ? `entry ${entries[node]}` : "missed";
      const side = { dx: isNarrow ? 17 : 22, anchor: "start" };
      stage.words(at, isNarrow && LINES[node] ? String(entries[node] ?? "✗") : entry, "ink small", { ...side, dy: 0 });
      const sign = SIGNS[step.marks[node]];
      if (sign) stage.words(at, sign, `${sign === "✗" ? "red" : "ink"} small strong`, { ...side, dy: 15 });
      if (LINES[node]) {
        const words = hits[node] ? `hit ${hits[node]}` : "no hit";
        stage.words(at, words, `${step.result === node ? "red strong" : "ink"} small`, { dy: isNarrow ? 30 : 34 });
      }
    }
  }

  Explore.figure("traversal", { needs: ["exact"], kernels: {}, geometry, walk, start });
})();
