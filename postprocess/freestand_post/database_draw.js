// What the pictures are made of: axes, rows of marks, keys. A picture is as wide as its place, and narrow on a telephone.
const TOP = 16, BOTTOM = 46, WIDEST = 900, NARROW = 640;
let WIDTH = WIDEST, LEFT = 62, RIGHT = 190, narrow = false;

function measure() {
  WIDTH = Math.max(300, Math.min(WIDEST, document.querySelector(".drawing").clientWidth || WIDEST));
  narrow = WIDTH < NARROW;
  [LEFT, RIGHT] = narrow ? [34, 12] : [62, 190];
}

function ticks(low, high, room) {
  const upTo = (digits) => {
    const all = [];
    for (let decade = Math.floor(Math.log10(low)); decade <= Math.log10(high); ++decade)
      for (const digit of digits) if (digit * 10 ** decade >= low * 0.999 && digit * 10 ** decade <= high * 1.001) all.push(digit * 10 ** decade);
    return all;
  };
  const all = upTo([1, 2, 5]), most = room / 34;
  return all.length > most ? upTo([1]) : all.length < 4 ? upTo([1, 1.5, 2, 3, 4, 5, 6, 8]).slice(0, most) : all;
}
function frame(height, x, y, label) {  // of a probability over an intensity
  let made = "";
  for (const p of [0, 0.2, 0.4, 0.6, 0.8, 1])
    made += `<line class="rule" x1="${LEFT}" x2="${WIDTH - RIGHT}" y1="${y(p)}" y2="${y(p)}"/><text class="tick" x="${LEFT - 8}" y="${y(p) + 4}" text-anchor="end">${p}</text>`;
  for (const v of ticks(...x.range, WIDTH - LEFT - RIGHT))
    made += `<line class="axis" x1="${x(v)}" x2="${x(v)}" y1="${height - BOTTOM}" y2="${height - BOTTOM + 5}"/><text class="tick" x="${x(v)}" y="${height - BOTTOM + 19}" text-anchor="middle">${text(v)}</text>`;
  return made + `<line class="axis" x1="${LEFT}" x2="${WIDTH - RIGHT}" y1="${height - BOTTOM}" y2="${height - BOTTOM}"/>` +
    `<text x="${(LEFT + WIDTH - RIGHT) / 2}" y="${height - 8}" text-anchor="middle">${escape(label)}</text>`;
}
function logScale(low, high) {
  const scale = (value) => LEFT + (WIDTH - LEFT - RIGHT) * Math.log(value / low) / Math.log(high / low);
  scale.range = [low, high];
  scale.back = (place) => low * (high / low) ** ((place - LEFT) / (WIDTH - LEFT - RIGHT));
  return scale;
}
const path = (points) => points.map(([x, y], i) => `${i ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("");

function show(name, height, drawing, finding, reading, table) {
  const figure = document.getElementById(name);
  figure.querySelector(".drawing").innerHTML = `<svg viewBox="0 0 ${WIDTH} ${height}" role="img" aria-label="${escape(finding)}">${drawing}</svg>`;
  figure.querySelector(".finding").textContent = finding;
  figure.querySelector(".reading").textContent = reading;
  figure.querySelector(".readout").textContent = "";
  const cell = (value) => value === null || value === undefined ? "" : /[",\n]/.test(value) ? `"${String(value).replace(/"/g, '""')}"` : value;
  figure.querySelector(".download").href = "data:text/csv;charset=utf-8," + encodeURIComponent(table.map((row) => row.map(cell).join(",")).join("\n") + "\n");
  return figure;
}
// Labels at the right end, kept apart.
function labels(entries) {
  const sorted = entries.slice().sort((a, b) => a.y - b.y);
  sorted.forEach((label, i) => { label.at = i ? Math.max(label.y, sorted[i - 1].at + 15) : label.y; });
  return sorted.map(({at, y, colour, words, bold}) => `<path d="M${WIDTH - RIGHT} ${y}L${WIDTH - RIGHT + 10} ${at}" stroke="${colour}" fill="none" stroke-width="0.8"/>` +
    `<text x="${WIDTH - RIGHT + 14}" y="${at + 4}" style="fill:${colour};font-weight:${bold ? 700 : 400}">${escape(words)}</text>`).join("");
}
// A legend below a picture: [glyph(x, y), words], in as many lines as it takes. {drawing, height}.
function legend(items, top) {
  let [x, y] = [LEFT, top + 14], drawing = "";
  for (const [glyph, words] of items) {
    const wide = 34 + 6.7 * words.length;  // of letters of 12 px
    if (x > LEFT && x + wide > WIDTH) [x, y] = [LEFT, y + 19];
    drawing += `${glyph(x + 8, y - 4)}<text x="${x + 22}" y="${y}">${escape(words)}</text>`;
    x += wide;
  }
  return {drawing, height: y + 8 - top};
}

// Rows below one another, one a label, each `tall`: their labels to the left of them, on a telephone above them. top(i): where the marks of a row begin.
function rowsOf(names, tall) {
  const [from, to] = narrow ? [18, WIDTH - 18] : [LEFT + 135, WIDTH - 35], above = narrow ? 15 : 0;
  const top = (i) => TOP + (tall + above) * i + above;
  const drawing = names.map((name, i) => `<line class="rule" x1="${from - 5}" x2="${to + 5}" y1="${top(i) + tall / 2}" y2="${top(i) + tall / 2}"/>` +
    (narrow ? `<text x="${from - 5}" y="${top(i)}">` : `<text x="${from - 15}" y="${top(i) + tall / 2 + 4}" text-anchor="end">`) + `${escape(name)}</text>`).join("");
  return {from, to, top, drawing, end: TOP + (tall + above) * names.length};
}
