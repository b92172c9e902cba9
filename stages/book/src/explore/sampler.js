// The course's random numbers, `kit::PixelSampler` with independent or stratified samples: a hash of
// seed, pixel, sample and dimension, so a figure shows the numbers that the student's code gets.
(function () {
  "use strict";

  // 64-bit numbers as two halves [high, low] of 32 bits.
  const xor = (a, b) => [a[0] ^ b[0], a[1] ^ b[1]];
  const shifted = ([high, low], bits) => [high >>> bits, (low >>> bits) | (high << (32 - bits))];

  function plus(a, b) {
    const low = (a[1] >>> 0) + (b[1] >>> 0);
    return [(a[0] + b[0] + Math.floor(low / 4294967296)) | 0, low | 0];
  }

  function times(a, b) {
    const [a1, a0] = [a[1] >>> 16, a[1] & 0xffff];
    const [b1, b0] = [b[1] >>> 16, b[1] & 0xffff];
    const middle = a1 * b0 + ((a0 * b0) >>> 16);
    const carry = a0 * b1 + (middle & 0xffff);
    const top = a1 * b1 + Math.floor(middle / 65536) + Math.floor(carry / 65536);
    return [(top + Math.imul(a[0], b[1]) + Math.imul(a[1], b[0])) | 0, Math.imul(a[1], b[1])];
  }

  // The finalizer of SplitMix64 (Steele, Lea, Flood, 2014).
  function mix(x) {
    x = plus(x, [0x9e3779b9, 0x7f4a7c15]);
    x = times(xor(x, shifted(x, 30)), [0xbf58476d, 0x1ce4e5b9]);
    x = times(xor(x, shifted(x, 27)), [0x94d049bb, 0x133111eb]);
    return xor(x, shifted(x, 31));
  }

  // Element i of permutation p of 0..l (Kensler, 2013), on 32 bits.
  function permute(i, l, p) {
    let w = 1;
    while (w < l) w *= 2;
    w -= 1;
    const grow = (factor) => (i = Math.imul(i, factor) >>> 0);
    const fold = (shift, mask) => (i = (i ^ ((mask === undefined ? p >>> shift : (i & mask) >>> shift))) >>> 0);
    do {
      i = (i ^ p) >>> 0;
      grow(0xe170893d);
      fold(16);
      fold(4, w);
      fold(8);
      grow(0x0929eb3f);
      fold(23);
      fold(1, w);
      grow(1 | (p >>> 27));
      grow(0x6935fa69);
      fold(11, w);
      grow(0x74dcb303);
      fold(2, w);
      grow(0x9e501cc3);
      fold(2, w);
      grow(0xc860a3df);
      i = (i & w) >>> 0;
      i = (i ^ (i >>> 5)) >>> 0;
    } while (i >= l);
    return (i + p) % l;
  }

  // The largest divisor of n that is not above its root.
  function columnsOf(n) {
    let columns = Math.floor(Math.sqrt(n));
    while (n % columns !== 0) columns -= 1;
    return columns;
  }

  const BELOW_ONE = 1 - Number.EPSILON / 2;

  class PixelSampler {
    // `strata` is the number of samples that a pixel is divided for; 0 means independent samples.
    constructor(x, y, seed, strata = 0) {
      this.strata = strata;
      this.key = mix(xor([y, x], mix([0, seed])));
      this.samples = 0;
      this.dimension = 0;
    }

    // The position of the next sample in its pixel.
    getSample() {
      this.samples += 1;
      this.dimension = 0;
      return this.next2d();
    }

    // The next number of this sample, in [0, 1).
    next1d() {
      const [high, low] = mix(xor(this.key, mix([this.samples, this.dimension])));
      this.dimension += 1;
      // 53 bits.
      return ((high >>> 0) * 2097152 + (low >>> 11)) / 9007199254740992;
    }

    next2d() {
      if (this.strata === 0) return [this.next1d(), this.next1d()];
      const n = this.strata;
      const key = mix(xor(this.key, mix([0, this.dimension])));
      const jitter = [this.next1d(), this.next1d()];
      const index = this.samples - 1;
      const order = mix(xor(key, [0, Math.floor(index / n)]))[1] >>> 0;
      const cell = permute(index % n, n, order);
      const columns = columnsOf(n);
      const within = (cell, cells, jitter) => Math.min((cell + jitter) / cells, BELOW_ONE);
      return [within(cell % columns, columns, jitter[0]), within(Math.floor(cell / columns), n / columns, jitter[1])];
    }
  }

  Explore.part("sampler", { PixelSampler });
})();
