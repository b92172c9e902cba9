// Exact fractions. Every float is a fraction, so from floats everything without a root is computed
// without rounding; this decides what a figure draws as right.
(function () {
  "use strict";

  const word = new DataView(new ArrayBuffer(8));

  // The bits of a float.
  function bits(x) {
    word.setFloat64(0, x);
    return word.getBigUint64(0);
  }

  function fromBits(b) {
    word.setBigUint64(0, b);
    return word.getFloat64(0);
  }

  function gcd(a, b) {
    while (b) [a, b] = [b, a % b];
    return a;
  }

  const magnitude = (n) => (n < 0n ? -n : n);
  // The number of bits of a number that is not negative.
  function length(n) {
    const digits = n.toString(16);
    return 4 * digits.length - Math.clz32(parseInt(digits[0], 16)) + 28;
  }

  // Longer denominators are divided by what they have in common with the numerator; to do so each
  // time would take most of the time.
  const LONG = 1n << 2000n;

  class Fraction {
    // Expects d > 0.
    constructor(n, d = 1n) {
      [this.n, this.d] = [n, d];
      if (d !== 1n && (d & (d - 1n)) === 0n) this.halve();
      else if (d > LONG) this.reduce();
    }

    // The denominator is a power of two, as that of each float.
    halve() {
      if (this.n === 0n) {
        this.d = 1n;
        return;
      }
      const [twos, most] = [this.n & -this.n, this.d].map(length);
      const shift = BigInt(Math.min(twos, most) - 1);
      [this.n, this.d] = [this.n >> shift, this.d >> shift];
    }

    // Divides by what both have in common.
    reduce() {
      const common = gcd(magnitude(this.n), this.d);
      [this.n, this.d] = [this.n / common, this.d / common];
      return this;
    }

    // The value of a finite float.
    static of(x) {
      if (x instanceof Fraction) return x;
      if (!Number.isFinite(x)) throw new RangeError(`${x} is no fraction`);
      const b = bits(x);
      const biased = Number((b >> 52n) & 0x7ffn);
      const digits = b & 0xfffffffffffffn;
      const whole = biased === 0 ? digits : digits | 0x10000000000000n;
      const exponent = Math.max(biased, 1) - 1075;
      const signed = b >> 63n ? -whole : whole;
      return exponent < 0 ? new Fraction(signed, 1n << BigInt(-exponent)) : new Fraction(signed << BigInt(exponent));
    }

    add(q) {
      if (this.d === q.d) return new Fraction(this.n + q.n, this.d);
      return new Fraction(this.n * q.d + q.n * this.d, this.d * q.d);
    }
    sub(q) {
      if (this.d === q.d) return new Fraction(this.n - q.n, this.d);
      return new Fraction(this.n * q.d - q.n * this.d, this.d * q.d);
    }
    mul(q) {
      return new Fraction(this.n * q.n, this.d * q.d);
    }
    div(q) {
      const n = this.n * q.d;
      const d = this.d * q.n;
      return d < 0n ? new Fraction(-n, -d) : new Fraction(n, d);
    }
    neg() {
      return new Fraction(-this.n, this.d);
    }
    abs() {
      return new Fraction(magnitude(this.n), this.d);
    }
    sign() {
      return this.n > 0n ? 1 : this.n < 0n ? -1 : 0;
    }
    cmp(q) {
      const difference = this.n * q.d - q.n * this.d;
      return difference > 0n ? 1 : difference < 0n ? -1 : 0;
    }

    // The root of a fraction that is not negative, rounded down at 2^-places times its size.
    root(places = 160) {
      if (this.n === 0n) return new Fraction(0n);
      const shift = BigInt(Math.max(0, places - (length(this.n) - length(this.d)) / 2) | 0);
      return new Fraction(isqrt((this.n << (2n * shift)) / this.d), 1n << shift);
    }

    // The nearest float; of two at the same distance the even one. Not for results that are
    // denormal.
    number() {
      if (this.n === 0n) return 0;
      const n = magnitude(this.n);
      let exponent = length(n) - length(this.d) - 53;
      const divided = (e) => {
        const [top, bottom] = e < 0 ? [n << BigInt(-e), this.d] : [n, this.d << BigInt(e)];
        return [top / bottom, top % bottom, bottom];
      };
      let [whole, rest, bottom] = divided(exponent);
      if (length(whole) > 53) [whole, rest, bottom] = divided(++exponent);
      else if (length(whole) < 53) [whole, rest, bottom] = divided(--exponent);
      const half = 2n * rest - bottom;
      if (half > 0n || (half === 0n && whole & 1n)) whole += 1n;
      const value = Number(whole) * 2 ** Math.trunc(exponent / 2) * 2 ** (exponent - Math.trunc(exponent / 2));
      return this.n < 0n ? -value : value;
    }

    // "digits" significant decimal digits, rounded; with an exponent if that is shorter.
    decimal(digits) {
      if (this.n === 0n) return "0";
      const n = magnitude(this.n);
      let power = n.toString().length - this.d.toString().length;
      const scaled = (p) => {
        const shift = digits - 1 - p;
        const [top, bottom] = shift >= 0 ? [n * 10n ** BigInt(shift), this.d] : [n, this.d * 10n ** BigInt(-shift)];
        return (2n * top + bottom) / (2n * bottom);
      };
      let whole = scaled(power);
      if (whole < 10n ** BigInt(digits - 1)) whole = scaled(--power);
      if (whole >= 10n ** BigInt(digits)) whole = scaled(++power);
      return (this.n < 0n ? "-" : "") + placed(whole.toString(), power);
    }

    // A short decimal that is exact, such as 4.5; a short fraction, such as 1/3; else 12 digits.
    toString() {
      const short = this.decimal(12).replace(/(\.\d*?)0+($|e)/, "$1$2").replace(/\.($|e)/, "$1");
      const { n, d } = this.reduce();
      const fraction = `${n}/${d}`;
      const isExact = Fraction.of(Number(short)).cmp(this) === 0;
      return isExact || fraction.length > 9 ? short : fraction;
    }
  }

  // Digits d.ddd times 10^power.
  function placed(digits, power) {
    if (power < -5 || power > 15) {
      return `${digits[0]}.${digits.slice(1)}e${power}`;
    }
    if (power < 0) return `0.${"0".repeat(-power - 1)}${digits}`;
    if (power + 1 >= digits.length) return digits + "0".repeat(power + 1 - digits.length);
    return `${digits.slice(0, power + 1)}.${digits.slice(power + 1)}`;
  }

  // Newton's method, from above.
  function isqrt(n) {
    if (n < 2n) return n;
    let x = 1n << BigInt((length(n) + 1) >> 1);
    for (;;) {
      const next = (x + n / x) >> 1n;
      if (next >= x) return x;
      x = next;
    }
  }

  const vector = {
    of: (v) => v.map(Fraction.of),
    sub: (a, b) => a.map((x, i) => x.sub(b[i])),
    dot: (a, b) => a.map((x, i) => x.mul(b[i])).reduce((sum, x) => sum.add(x)),
    cross: (a, b) =>
      [[1, 2], [2, 0], [0, 1]].map(([i, j]) => a[i].mul(b[j]).sub(a[j].mul(b[i]))),
  };

  Explore.part("exact", { Fraction, vector, bits, fromBits });
})();
