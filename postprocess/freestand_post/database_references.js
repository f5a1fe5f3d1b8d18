// Ours beside somebody else's: medians of each reference's own demand and intensity, with their intervals.
const THEIRS = "#1d2430", SLOT = 10;
const diamond = (x, y) => `<path class="theirs-mark" fill="${THEIRS}" d="M${x} ${y - 6}l5 6l-5 6l-5 -6Z"/>`;
const circle = (x, y, colour, full) => `<circle class="dot" cx="${x}" cy="${y}" r="4" fill="${full ? colour : "#fff"}" stroke="${colour}" stroke-width="1.6"/>`;
const arrow = (x, y, colour, way, name = "") => `<path${name && ` class="${name}"`} fill="${colour}" d="M${x} ${y - 4.5}l${way * 8} 4.5l${way * -8} 4.5Z"/>`;
const cap = (x, y, colour) => `<line x1="${x}" x2="${x}" y1="${y - 3.5}" y2="${y + 3.5}" stroke="${colour}" stroke-width="1.2"/>`;
const whisker = (low, high, y, colour, from = true, to = true) => `<line x1="${low}" x2="${high}" y1="${y}" y2="${y}" stroke="${colour}" stroke-width="2"/>` + (from ? cap(low, y, colour) : "") + (to ? cap(high, y, colour) : "");
const mark = (id, y, words, drawing) => `<g class="mark" data-id="${escape(id)}" data-y="${y}"><title>${escape(words)}</title>${drawing}</g>`;

function markOfTheirs(theirs, x, y) {
  const {reference_id: id, reference_median: median, reference_dispersion: dispersion} = theirs;
  return mark(id, y, `${id}: median ${text(median)}, dispersion ${text(dispersion)}`,
    `<line x1="${x(median * Math.exp(-dispersion))}" x2="${x(median * Math.exp(dispersion))}" y1="${y}" y2="${y}" stroke="${THEIRS}" stroke-width="7" opacity="0.18"/>` + diamond(x(median), y));
}
function markOfOurs(one, x, y, word) {
  const {entry, curve, median, colour} = one;
  const place = (value) => x(value === Infinity ? curve.im_most : value === -Infinity ? curve.im_least : value);
  const [low, high] = [place(median.low), place(median.high)];
  const drawing = whisker(low, high, y, colour, Number.isFinite(median.low), Number.isFinite(median.high)) +
    (median.high === Infinity ? arrow(high, y, colour, 1, "beyond") : "") + (median.low === -Infinity ? arrow(low, y, colour, -1, "beyond") : "") +
    (Number.isFinite(median.value) ? circle(x(median.value), y, colour, isClear(median)) : "");
  const range = median.low === Infinity || median.high === -Infinity ? "" : " " + interval(median, curve);
  return mark(entry.id, y, `${entry.id}: median ${limit(median.value, curve)}${unit(word)}${range}, by ${median.by === "lognormal" ? `its lognormal of dispersion ${text(curve.dispersion)}` : "its points"}${remark(median) && "; " + remark(median)}`, drawing);
}

// How ours lie to theirs, by intervals alone.
function compared(all, floor) {
  const above = all.filter((one) => one.median.low > one.theirs).length, below = all.filter((one) => one.median.high < one.theirs).length, rest = all.length - above - below;
  const many = (n) => n !== all.length ? `${n} of our ${all.length} medians` : n === 1 ? "Our median" : n === 2 ? "Both of our medians" : `All ${n} of our medians`;
  const lies = (n) => n === 1 ? "lies" : "lie", on = floor ? ` on floor ${floor}` : "";
  const told = [[above, "above theirs"], [below, "below theirs"]].filter(([n]) => n).map(([n, where], i) => i ? `${n} ${where}` : `${many(n)} ${lies(n)} ${where}${on}`);
  if (rest) told.push(told.length ? `${rest} within the interval ${rest === 1 ? "is" : "are"} not parted from theirs` : `${many(rest)}${on} ${rest === 1 ? "is" : "are"} not parted from theirs by the intervals`);
  const clear = all.filter((one) => isClear(one.median)).sort((a, b) => a.median.value / a.theirs - b.median.value / b.theirs);
  const ratio = ({median, theirs}) => `${three(median.value / theirs)} [${three(median.low / theirs)}, ${three(median.high / theirs)}]`;
  const [least, most] = [clear[0], clear[clear.length - 1]], open = all.filter((one) => one.median.high === Infinity).length, loose = all.length - clear.length - open;
  const parts = [clear.length > 1 ? `${clear.length === all.length ? "" : `${clear.length} clear ones are `}${ratio(least)} to ${ratio(most)} times theirs` : clear.length ? `${clear.length === all.length ? "" : "the clear one is "}${ratio(least)} times theirs` : "",
    open ? `${open} ${open === 1 ? "is" : "are"}, or may be, beyond what was swept` : "", loose ? `${loose} ${loose === 1 ? "is" : "are"} unclear, since the curve is flat at 1/2 or falls below it again` : ""].filter(Boolean);
  return told.join(", ") + (parts.length ? ": " + parts.join("; ") : "");
}

function drawReferences() {
  if (!document.getElementById("references")) return;
  const floor = choice("floor"), entries = data.entries.map((e, i) => ({...e, at: i})).filter((e) => e.reference_source && e.floor === floor);
  const frictions = unique(entries.map((e) => e.mu_k)).sort((a, b) => a - b);
  const table = [["reference", "id", "floor", "friction_mu", "median", "median_lower", "median_upper", "median_by", "remark", "dispersion", "reference_median", "reference_dispersion"]];
  const full = (value) => value, all = [];
  const groups = unique(entries.map((e) => e.reference_id)).map((id) => entries.filter((e) => e.reference_id === id).sort((a, b) => a.mu_k - b.mu_k));
  const rows = groups.map((mine) => mine.map((e) => {
    const curve = data.curves.find((c) => c.entry === e.at && c.im === e.reference_intensity && c.demand === e.reference_demand && (e.reference_capacity === null || c.capacity === e.reference_capacity));
    const median = medianOf(curve), limits = median ? [median.value, median.low, median.high].map((value) => limit(value, curve, full)) : ["", "", ""];
    table.push([e.reference_id, e.id, e.floor, e.mu_k, ...limits, median ? median.by : "", remark(median), median && median.by === "lognormal" ? curve.dispersion : null, e.reference_median, e.reference_dispersion]);
    return {entry: e, curve, median, theirs: e.reference_median, colour: colours[frictions.indexOf(e.mu_k) % colours.length]};
  }).filter((one) => one.median));
  rows.forEach((row) => all.push(...row));
  const swept = ({median, curve}) => [median.value, median.low, median.high].map((value) => value === Infinity ? curve.im_most : value === -Infinity ? curve.im_least : value);
  const values = all.flatMap(swept).concat(entries.flatMap((e) => [-1, 1].map((way) => e.reference_median * Math.exp(way * e.reference_dispersion)))).filter((v) => v > 0);
  const [low, high] = [Math.min(...values) / 1.05, Math.max(...values) * 1.05];
  const tall = SLOT * (1 + Math.max(...rows.map((row) => row.length))) + 8;
  const place = rowsOf(groups.map(([e]) => (e.description.split(":")[0] || e.reference_id).slice(0, 34)), tall);
  const x = (v) => place.from + (place.to - place.from) * Math.log(v / low) / Math.log(high / low);
  const word = entries.length ? of(data.intensities, entries[0].reference_intensity) : null;
  let drawing = place.drawing;
  groups.forEach(([first], i) => {
    const y = (slot) => place.top(i) + 4 + SLOT * (slot + 0.5);
    drawing += markOfTheirs(first, x, y(0)) + rows[i].map((one, k) => markOfOurs(one, x, y(k + 1), word)).join("");
  });
  for (const v of ticks(low, high, place.to - place.from)) drawing += `<line class="axis" x1="${x(v)}" x2="${x(v)}" y1="${place.end}" y2="${place.end + 4}"/><text class="tick" x="${x(v)}" y="${place.end + 17}" text-anchor="middle">${text(v)}</text>`;
  if (word) drawing += `<text x="${(place.from + place.to) / 2}" y="${place.end + 36}" text-anchor="middle">${escape(`median ${word.symbol}${word.unit === "1" ? "" : ` (${word.unit})`} of: ${entries[0].reference_demand.replace("_", " ")}`)}</text>`;
  const hollow = all.some((one) => Number.isFinite(one.median.value) && !isClear(one.median)), open = all.some((one) => one.median.high === Infinity || one.median.low === -Infinity);
  const told = legend([[diamond, "theirs; bar: 16 to 84 %"], ...frictions.map((mu, i) => [(a, b) => circle(a, b, colours[i % colours.length], true), "ours, μ = " + text(mu)]),
    [(a, b) => whisker(a - 8, a + 8, b, "#626b78"), `its ${Math.round(1000 * data.confidence) / 10} % interval`],
    ...(hollow ? [[(a, b) => circle(a, b, "#626b78", false), "unclear"]] : []), ...(open ? [[(a, b) => arrow(a - 4, b, "#626b78", 1), "beyond what was swept"]] : [])], place.end + 44);
  show("references", place.end + 44 + told.height, drawing + told.drawing, all.length ? compared(all, floor) : "Ours have no median of what theirs are of: no curve, or bins with too few samples",
    `Medians beside those of ${unique(entries.map((e) => e.reference_source)).join(", ")}: where a curve first reaches 1/2, and from where its band does to where all of its band does. Hollow: unclear, since the curve is flat about 1/2 or falls below it again. Choose another floor above to see what it changes.`, table);
}
