// What a curve says, by the rule of `freestand query` and exports.
const [IM, P, LOW, HIGH, N] = [0, 1, 2, 3, 4];  // of a point
// Probability and band at an intensity, as `freestand query` and exports read the curve: its lognormal where that is adequate, else
// straight lines over the intensity between the points, from 0 at 0 (level to a first one from which it falls); nothing outside of what was swept.
function at(curve, im) {
  const points = curve ? curve.points : [];
  if (!points.length || im < curve.im_least * (1 - 1e-6) || im > curve.im_most * (1 + 1e-6)) return null;
  const next = points.findIndex((p) => p[IM] >= im), last = points[points.length - 1];
  const b = next < 0 ? last : points[next], a = next > 0 ? points[next - 1] : next < 0 || byLognormal(curve) ? b : points.some((p) => p[HIGH] < b[LOW]) ? [0, b[P], b[LOW], 1] : [0, 0, 0, b[HIGH]];
  const t = b === a ? 1 : (im - a[IM]) / (b[IM] - a[IM]), between = (value) => (1 - t) * value(a) + t * value(b);
  if (!byLognormal(curve)) return [P, LOW, HIGH].map((i) => between((p) => p[i]));
  const fitted = (x) => phi(Math.log(x / curve.median) / curve.dispersion), here = fitted(im);  // its band goes along
  const [low, high] = [LOW, HIGH].map((i) => here + between((p) => p[i] - p[P]));
  return [here, Math.max(0, Math.min(low, here)), Math.min(1, Math.max(high, here))];
}
const byLognormal = (curve) => curve.family === "lognormal" && curve.dispersion > 0;
const ruleOf = (curve) => !curve ? "" : byLognormal(curve) ? "read by its lognormal, which is adequate" : "read by straight lines between its points over the intensity; what it does between them no band holds";
// What the rule draws: [im, probability, lower, upper], finely, with the points themselves in it.
function trace(curve) {
  const ims = curve.points.flatMap((p, i) => i ? [1, 2, 3, 4, 5, 6, 7, 8].map((k) => curve.points[i - 1][IM] * (p[IM] / curve.points[i - 1][IM]) ** (k / 8)) : [p[IM]]);
  return ims.map((im) => [im, ...(at(curve, im) ?? [])]).filter((p) => p.length > 1);
}
// Standard normal distribution (Abramowitz and Stegun 26.2.17; error below 1e-7).
function phi(z) {
  const t = 1 / (1 + 0.2316419 * Math.abs(z));
  const tail = Math.exp(-z * z / 2) / Math.sqrt(2 * Math.PI) * t * (0.31938153 + t * (-0.356563782 + t * (1.781477937 + t * (-1.821255978 + t * 1.330274429))));
  return z > 0 ? 1 - tail : tail;
}

// Where half go beyond the capacity, with its interval: value, low, high; infinite where it lies beyond what was swept. By the lognormal
// where the curve is read by it, with its standard error; else where the curve first reaches 1/2, and for the interval where its upper and its
// lower limit do. flat: the curve does not rise all along the interval; falls: where it is below 1/2 again, null where it is not.
function medianOf(curve) {
  if (!curve || !curve.points.length) return null;
  if (byLognormal(curve) && !curve.extrapolated && curve.median_se !== null) {
    const half = Math.exp(data.normal * curve.median_se / curve.median);
    return {value: curve.median, low: curve.median / half, high: curve.median * half, by: "lognormal", flat: false, falls: null};
  }
  const nodes = [[curve.im_least, ...at(curve, curve.im_least)], ...trace(curve), [curve.im_most, ...at(curve, curve.im_most)]];
  const [value, low, high] = [P, HIGH, LOW].map((i) => firstAt(nodes, i));
  const below = value < Infinity ? curve.points.find((p) => p[IM] > value && p[P] < 0.5) : undefined;
  const flat = curve.points.some((p, i) => i && p[IM] > low && curve.points[i - 1][IM] < high && p[P] <= curve.points[i - 1][P]);
  return {value, low, high, by: "points", flat, falls: below ? below[IM] : null};
}
function firstAt(nodes, i) {
  const next = nodes.findIndex((node) => node[i] >= 0.5);
  if (next < 1) return next < 0 ? Infinity : -Infinity;
  const [a, b] = [nodes[next - 1], nodes[next]];
  return a[IM] + (b[IM] - a[IM]) * (0.5 - a[i]) / (b[i] - a[i]);
}
// Is it clear where it is? Not where its interval is open, the curve is flat about 1/2 or falls below it again.
const isClear = (median) => Number.isFinite(median.low) && Number.isFinite(median.high) && !median.flat && median.falls === null;
// "2.98", "> 3.93": within what was swept, or beyond it.
const three = (value) => value >= 0.001 && value < 1000 ? value.toPrecision(3) : text(value);
const limit = (value, curve, shown = three) => value === Infinity ? "> " + shown(curve.im_most) : value === -Infinity ? "< " + shown(curve.im_least) : shown(value);
const interval = (median, curve) => `[${limit(median.low, curve)}, ${limit(median.high, curve)}]`;
const sayMedian = (median, curve) => !median ? "–" : median.low === Infinity || median.high === -Infinity ? limit(median.value, curve) : `${limit(median.value, curve)} ${interval(median, curve)}`;
const remark = (median) => !median ? "" : [median.flat ? "does not rise where 1/2 lies within its band" : "", median.falls !== null ? `is below 1/2 again at ${text(median.falls)}` : ""].filter(Boolean).join("; ");
