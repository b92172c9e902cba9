"use strict";
// From world space to pixels, for the boxes that are drawn over a picture.

const minus = (a, b) => a.map((x, i) => x - b[i]);
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** Solves x a + y b + z c = d by Cramer's rule; null if there is no unique solution. */
function solve(a, b, c, d) {
  const det = dot(a, cross(b, c));
  if (!(Math.abs(det) > 1e-12)) return null;
  return [dot(d, cross(b, c)), dot(a, cross(d, c)), dot(a, cross(b, d))].map((x) => x / det);
}

/**
 * The projection from world space to [column, row] of a picture, as a function; null if the rays do not
 * start at one point. Before normalising, directions are A + x B + y C. The rays [o, d] of the four corner
 * pixels, row by row from the bottom left, determine A, B and C up to a common factor.
 */
function projection(width, height, rays) {
  if (!rays || rays.some(([o]) => o.join() !== rays[0][0].join())) return null;
  const origin = rays[0][0];
  const [d00, d10, d01, d11] = rays.map(([, d]) => d);
  const lengths = solve(d10, d01, d11.map((x) => -x), d00);
  if (!lengths) return null;
  const [across, up] = [d10.map((x) => x * lengths[0]), d01.map((x) => x * lengths[1])];
  const b = minus(across, d00).map((x) => x / (width - 1));
  const c = minus(up, d00).map((x) => x / (height - 1));
  return (point) => {
    const solved = solve(d00, b, c, minus(point, origin));
    if (!solved || !(solved[0] > 0)) return null;
    return [solved[1] / solved[0], solved[2] / solved[0]];
  };
}

/** The edges of a box, as pairs of corners; none if a corner is infinite. */
function edges([min, max]) {
  if (![...min, ...max].every(Number.isFinite)) return [];
  const corner = (i) => [0, 1, 2].map((axis) => (i & (1 << axis) ? max : min)[axis]);
  const pairs = [];
  for (let i = 0; i < 8; i++) {
    for (const bit of [1, 2, 4]) if (!(i & bit)) pairs.push([corner(i), corner(i | bit)]);
  }
  return pairs;
}

/** Whether a box contains another one. */
const contains = ([min, max], [from, to]) => min.every((x, axis) => x <= from[axis] && to[axis] <= max[axis]);
