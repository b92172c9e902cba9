// Sine, cosine and tangent with the bits of the crate `libm`, which the course computes with. What
// a browser's Math.sin returns differs from browser to browser.
//
// Ported from libm 0.2 (MIT), which is a port of FreeBSD's msun, lib/msun/src: s_sin.c, s_cos.c,
// s_tan.c, k_sin.c, k_cos.c, k_tan.c, e_rem_pio2.c. Their notice:
//
//   Copyright (C) 1993, 2004 by Sun Microsystems, Inc. All rights reserved.
//   Developed at SunPro, a Sun Microsystems, Inc. business.
//   Permission to use, copy, modify, and distribute this software is freely granted, provided that
//   this notice is preserved.
//
// Angles up to 2^20 quarter turns only, far more than any figure needs: the reduction of larger
// ones is not ported, and such an angle is an error.
(function () {
  "use strict";

  const words = new DataView(new ArrayBuffer(8));

  function high(x) {
    words.setFloat64(0, x);
    return words.getUint32(0);
  }

  function withoutLowWord(x) {
    words.setFloat64(0, x);
    words.setUint32(4, 0);
    return words.getFloat64(0);
  }

  const magnitude = (x) => high(x) & 0x7fffffff;

  const S = [
    -1.66666666666666324348e-1, 8.33333333332248946124e-3, -1.98412698298579493134e-4,
    2.75573137070700676789e-6, -2.50507602534068634195e-8, 1.58969099521155010221e-10,
  ];

  // Sine of x + y on [-π/4, π/4], y being the tail of x.
  function kernelSin(x, y, hasTail) {
    const z = x * x;
    const w = z * z;
    const r = S[1] + z * (S[2] + z * S[3]) + z * w * (S[4] + z * S[5]);
    const v = z * x;
    return hasTail ? x - (z * (0.5 * y - v * r) - y - v * S[0]) : x + v * (S[0] + z * r);
  }

  const C = [
    4.16666666666666019037e-2, -1.38888888888741095749e-3, 2.48015872894767294178e-5,
    -2.75573143513906633035e-7, 2.08757232129817482790e-9, -1.13596475577881948265e-11,
  ];

  // Cosine of x + y on [-π/4, π/4].
  function kernelCos(x, y) {
    const z = x * x;
    const w = z * z;
    const r = z * (C[0] + z * (C[1] + z * C[2])) + w * w * (C[3] + z * (C[4] + z * C[5]));
    const half = 0.5 * z;
    const first = 1 - half;
    const rest = z * r - x * y;
    return first + (1 - first - half + rest);
  }

  const T = [
    3.33333333333334091986e-1, 1.33333333333201242699e-1, 5.39682539762260521377e-2,
    2.18694882948595424599e-2, 8.86323982359930005737e-3, 3.59207910759131235356e-3,
    1.45620945432529025516e-3, 5.88041240820264096874e-4, 2.46463134818469906812e-4,
    7.81794442939557092300e-5, 7.14072491382608190305e-5, -1.85586374855275456654e-5,
    2.59073051863633712884e-5,
  ];
  const PIO4 = 7.85398163397448278999e-1;
  const PIO4_LOW = 3.06161699786838301793e-17;

  // Tangent of x + y on [-π/4, π/4], or -1 divided by it if `odd`.
  function kernelTan(x, y, odd) {
    const isBig = magnitude(x) >= 0x3fe59428;
    const isNegative = high(x) >>> 31 !== 0;
    if (isBig) {
      if (isNegative) [x, y] = [-x, -y];
      x = PIO4 - x + (PIO4_LOW - y);
      y = 0;
    }
    const z = x * x;
    const w = z * z;
    const even = T[1] + w * (T[3] + w * (T[5] + w * (T[7] + w * (T[9] + w * T[11]))));
    const rest = z * (T[2] + w * (T[4] + w * (T[6] + w * (T[8] + w * (T[10] + w * T[12])))));
    const s = z * x;
    const r = y + z * (s * (even + rest) + y) + s * T[0];
    const sum = x + r;
    if (isBig) {
      const sign = odd ? -1 : 1;
      const v = sign - 2 * (x + (r - (sum * sum) / (sum + sign)));
      return isNegative ? -v : v;
    }
    if (!odd) return sum;
    const top = withoutLowWord(sum);
    const tail = r - (top - x);
    const a = -1 / sum;
    const a0 = withoutLowWord(a);
    return a0 + a * (1 + a0 * top + a0 * tail);
  }

  const TO_INT = 1.5 / 2.2204460492503131e-16;
  const INV_PIO2 = 6.36619772367581382433e-1;
  const PIO2_1 = 1.57079632673412561417;
  const PIO2_1T = 6.07710050650619224932e-11;
  const PIO2_2 = 6.07710050630396597660e-11;
  const PIO2_2T = 2.02226624879595063154e-21;
  const PIO2_3 = 2.02226624871116645580e-21;
  const PIO2_3T = 8.47842766036889956997e-32;

  // [n, y0, y1] with x = n·π/2 + y0 + y1, for |x| above π/4.
  function reduce(x) {
    const ix = magnitude(x);
    if (ix >= 0x413921fb) throw new RangeError(`the reduction of the angle ${x} is not ported`);
    // Multiples of π/2 up to 4, unless x is so near to one that digits cancel.
    const near = [0x3ff921fb, 0x400921fb, 0x4012d97c, 0x401921fb];
    const ends = [0x4002d97c, 0x400f6a7a, 0x4015fdbc, 0x401c463b];
    const small = ends.findIndex((end) => ix <= end);
    const cancels = small < 2 ? (ix & 0xfffff) === 0x921fb : ix === near[small];
    if (small < 0 || cancels) return reduceMedium(x, ix);
    const n = x < 0 ? -(small + 1) : small + 1;
    const z = x - n * PIO2_1;
    const tail = n * PIO2_1T;
    const y0 = z - tail;
    return [n, y0, z - y0 - tail];
  }

  function reduceMedium(x, ix) {
    const n = x * INV_PIO2 + TO_INT - TO_INT;
    let r = x - n * PIO2_1;
    let w = n * PIO2_1T;
    let y0 = r - w;
    const lost = () => (ix >> 20) - ((high(y0) >> 20) & 0x7ff);
    if (lost() > 16) {
      let t = r;
      w = n * PIO2_2;
      r = t - w;
      w = n * PIO2_2T - (t - r - w);
      y0 = r - w;
      if (lost() > 49) {
        t = r;
        w = n * PIO2_3;
        r = t - w;
        w = n * PIO2_3T - (t - r - w);
        y0 = r - w;
      }
    }
    return [n, y0, r - y0 - w];
  }

  function sin(x) {
    const ix = magnitude(x);
    if (ix <= 0x3fe921fb) return ix < 0x3e500000 ? x : kernelSin(x, 0, false);
    if (ix >= 0x7ff00000) return NaN;
    const [n, y0, y1] = reduce(x);
    const value = n & 1 ? kernelCos(y0, y1) : kernelSin(y0, y1, true);
    return n & 2 ? -value : value;
  }

  function cos(x) {
    const ix = magnitude(x);
    if (ix <= 0x3fe921fb) return ix < 0x3e46a09e ? 1 : kernelCos(x, 0);
    if (ix >= 0x7ff00000) return NaN;
    const [n, y0, y1] = reduce(x);
    const value = n & 1 ? kernelSin(y0, y1, true) : kernelCos(y0, y1);
    return (n + 1) & 2 ? -value : value;
  }

  function tan(x) {
    const ix = magnitude(x);
    if (ix <= 0x3fe921fb) return ix < 0x3e400000 ? x : kernelTan(x, 0, false);
    if (ix >= 0x7ff00000) return NaN;
    const [n, y0, y1] = reduce(x);
    return kernelTan(y0, y1, (n & 1) !== 0);
  }

  Explore.part("libm", { sin, cos, tan });
})();
